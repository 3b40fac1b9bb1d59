//! `explain`: what an instruction, a register, a modifier, a version, a rule, a hardware model or a numeric choice means.

use super::{Failure, Format, Outcome, print, print_json};
use anstyle::{AnsiColor, Style};
use serde_json::{Value, json};
use texcrd::explain::{self, Page, Part, Role, Subject};
use texcrd::isa::Version;

/// Tells what an instruction, a register, a modifier, a version, a rule, a hardware model or a numeric choice means.
///
/// Names are what stands in listings and messages: lrp, mul_x2, r0, oPos, c[a0.x], _bx2, 1-, .rgb, +, ps.1.4, B3; opcodes also as
/// 0x12 and D3DSIO_LRP; and what --model and --policy take: gf3, rcp-zero. Without a name, everything that can be asked for.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  texcrd explain                        what can be asked for
  texcrd explain lrp
  texcrd explain texld --in ps.1.4      as one version has it
  texcrd explain mul_x2_sat -- -r0_bx2.a
  texcrd explain policies               every numeric choice with its values
  texcrd explain gf3                    what a hardware model does to numbers
  texcrd explain B3 --format json")]
pub(super) struct Arguments {
    /// What to explain; what begins with a minus sign stands behind `--`.
    #[arg(value_name = "NAME")]
    names: Vec<String>,
    /// Only what this version has, where it has it.
    #[arg(long = "in", value_name = "VERSION", value_parser = version)]
    by: Option<Version>,
    /// How results are written.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

/// The value parser of `--in`.
fn version(text: &str) -> Result<Version, String> {
    let named = explain::subjects(text).unwrap_or_default();
    match named[..] {
        [Subject::Version(version)] => Ok(version),
        _ => {
            let names: Vec<&str> = Version::all().map(Version::name).collect();
            Err(format!("a version is one of {}", names.join(", ")))
        }
    }
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    if arguments.names.is_empty() {
        return show(arguments, "list", &explain::index(), false);
    }
    let mut unknown = false;
    let mut first = true;
    for name in &arguments.names {
        match explain::subjects(name) {
            Ok(subjects) => {
                for subject in subjects {
                    let page = subject.page(arguments.by);
                    show(arguments, subject.kind(), &page, !first)?;
                    first = false;
                }
            }
            Err(none) => {
                unknown = true;
                let list = match none.near.is_empty() && none.owner.is_none() {
                    true => "; `texcrd explain` lists what there is",
                    false => "",
                };
                anstream::eprintln!("error: {none}{list}");
            }
        }
    }
    match unknown {
        true => Err(Failure::Rejected),
        false => Ok(()),
    }
}

fn show(arguments: &Arguments, kind: &str, page: &Page, another: bool) -> Outcome {
    if arguments.format == Format::Json {
        return print_json(&to_json(kind, page));
    }
    let gap = if another { "\n\n" } else { "" };
    print(&format!("{gap}{}", page.styled(width(), styled)))
}

/// How wide a page may be: as the terminal is, but no wider than is good to read; 80 in a pipe.
fn width() -> usize {
    const USUAL: usize = 80;
    const WIDEST: usize = 100;
    #[cfg(feature = "tui")]
    let terminal = ratatui::crossterm::terminal::size()
        .ok()
        .map(|(columns, _)| columns.into());
    #[cfg(not(feature = "tui"))]
    let terminal = None;
    use std::io::IsTerminal;
    let shown = std::io::stdout().is_terminal();
    terminal.filter(|_| shown).unwrap_or(USUAL).min(WIDEST)
}

/// A piece as a terminal shows it; `anstream` takes the colours out where there is none.
fn styled(role: Role, text: &str) -> String {
    let style = match role {
        Role::Name => Style::new()
            .bold()
            .fg_color(Some(AnsiColor::BrightCyan.into())),
        Role::Heading => Style::new().bold(),
        Role::Label => Style::new().dimmed(),
        Role::Listing => Style::new().fg_color(Some(AnsiColor::Green.into())),
        Role::Plain => return text.to_string(),
    };
    format!("{style}{text}{style:#}")
}

fn to_json(kind: &str, page: &Page) -> Value {
    let parts: Vec<Value> = (page.parts.iter())
        .map(|part| match part {
            Part::Heading(text) => json!({ "heading": text }),
            Part::Paragraph(text) => json!({ "text": text }),
            Part::Facts(facts) => {
                let facts = facts.iter().map(|fact| json!([fact.label, fact.text]));
                json!({ "facts": facts.collect::<Vec<_>>() })
            }
            Part::Listing(text) => json!({ "listing": text }),
        })
        .collect();
    json!({
        "name": page.name,
        "kind": kind,
        "title": page.title,
        "parts": parts,
        "see": page.see,
    })
}

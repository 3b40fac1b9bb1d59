//! `check`: parse, validate, repair.

use super::{Failure, Format, Outcome, diagnostics, dialect, files, print, print_json};
use serde_json::json;
use std::path::Path;
use texcrd::diagnostic::{Diagnostic, SourceMap, any_error};
use texcrd::isa::ShaderKind;
use texcrd::policy::Dialect;
use texcrd::program::Program;
use texcrd::validate::{Statistics, Usage};
use texcrd::{listing, syntax, validate};

/// Says everything that is wrong with listings.
///
/// Scanning errors (`1rp` for `lrp`, `rl` for `r1`, lost semicolons and mnemonics) are met on purpose.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  texcrd check shader.psh
  texcrd check --fix scanned.psh        repair the file where only one thing can have been meant
  texcrd check --stats shader.vsh       slots used of slots allowed
  texcrd check --format json *.psh      one object a diagnostic; with --stats one more a file")]
pub(super) struct Arguments {
    /// Listings; `-` is standard input.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<String>,
    /// Apply the repairs that are certain and leave the rest. Files are rewritten in place; of standard input the repaired
    /// text is printed.
    #[arg(long)]
    fix: bool,
    /// Print slots used of slots allowed, registers and stages.
    #[arg(long)]
    stats: bool,
    /// How results are written.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
    /// Whose rules: d3d8, d3d9 or lenient.
    #[arg(long, value_parser = dialect, default_value = "d3d8")]
    dialect: Dialect,
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    let mut rejected = false;
    for path in &arguments.files {
        rejected |= !check(arguments, path)?;
    }
    if rejected {
        return Err(Failure::Rejected);
    }
    Ok(())
}

/// Whether the listing is accepted.
fn check(arguments: &Arguments, path: &str) -> Result<bool, Failure> {
    let mut bytes = files::read(path)?;
    if arguments.fix {
        bytes = fix(path, bytes)?;
    }
    let mut sources = SourceMap::new();
    let file = sources
        .add(files::name(path), bytes)
        .map_err(|e| Failure::Input(e.to_string()))?;
    let checked = listing::check(file, arguments.dialect);
    report(arguments, &sources, &checked.diagnostics)?;
    if arguments.stats
        && let Some(program) = &checked.program
    {
        statistics(arguments, files::name(path), program)?;
    }
    Ok(!any_error(&checked.diagnostics))
}

/// Repairs a listing until nothing certain is left to repair, and writes it back.
fn fix(path: &str, original: Vec<u8>) -> Result<Vec<u8>, Failure> {
    // One repair can uncover the next: a lost semicolon hides what stands in the line.
    const ROUNDS: usize = 8;
    let mut bytes = original.clone();
    let mut repaired = 0;
    for _ in 0..ROUNDS {
        let mut sources = SourceMap::new();
        let file = sources
            .add(files::name(path), bytes.clone())
            .map_err(|e| Failure::Input(e.to_string()))?;
        let (fixed, count) = syntax::apply_fixes(file, &syntax::parse(file).diagnostics);
        if count == 0 {
            break;
        }
        repaired += count;
        bytes = fixed;
    }
    // What came from standard input goes to standard output, repaired or not.
    if path == "-" || bytes != original {
        files::write(Path::new(path), &bytes)?;
    }
    if repaired > 0 {
        let plural = if repaired == 1 { "" } else { "s" };
        anstream::eprintln!("{}: {repaired} repair{plural}", files::name(path));
    }
    Ok(bytes)
}

fn report(arguments: &Arguments, sources: &SourceMap, found: &[Diagnostic]) -> Outcome {
    if arguments.format == Format::Json {
        for diagnostic in found {
            print_json(&diagnostics::to_json(sources, diagnostic))?;
        }
        return Ok(());
    }
    let mut text = diagnostics::render(sources, found);
    let name = sources.files().last().map_or("", |f| f.name());
    let summary = diagnostics::summary(found);
    text.push_str(&format!(
        "{name}: {}\n",
        summary.as_deref().unwrap_or("no complaints")
    ));
    // With --fix the repaired text of standard input goes to standard output.
    if arguments.fix && name == files::name("-") {
        anstream::eprint!("{text}");
        return Ok(());
    }
    print(&text)
}

fn statistics(arguments: &Arguments, name: &str, program: &Program) -> Outcome {
    let statistics = validate::statistics(program);
    match arguments.format {
        Format::Json => print_json(&json!({ "file": name, "stats": to_json(&statistics) })),
        Format::Text => print(&to_text(&statistics)),
    }
}

fn to_text(statistics: &Statistics) -> String {
    let of = |usage: Usage| format!("{} of {}", usage.used, usage.allowed);
    let list = |numbers: &[u32]| -> String {
        let numbers: Vec<_> = numbers.iter().map(u32::to_string).collect();
        numbers.join(", ")
    };
    let mut text = format!("{}\n", statistics.version);
    for (i, phase) in statistics.phases.iter().enumerate() {
        let label = match (statistics.version.kind(), statistics.phases.len()) {
            (ShaderKind::Pixel, 2..) => format!("phase {}", i + 1),
            _ => "slots".to_string(),
        };
        let amount = match statistics.version.kind() {
            ShaderKind::Vertex => of(phase.arithmetic),
            ShaderKind::Pixel => format!(
                "{} texture, {} arithmetic",
                of(phase.texture),
                of(phase.arithmetic)
            ),
        };
        text.push_str(&format!("  {label:<13} {amount}\n"));
    }
    for usage in statistics.files.iter().filter(|f| !f.numbers.is_empty()) {
        let names: Vec<_> = (usage.numbers.iter())
            .map(|n| usage.file.register_name(*n))
            .collect();
        let prefix = usage.file.row().prefix;
        text.push_str(&format!(
            "  {:<13} {} of {}: {}\n",
            format!("{prefix}#"),
            names.len(),
            usage.allowed,
            names.join(" ")
        ));
    }
    if statistics.relative {
        text.push_str("  c[a0.x + n]   any constant may be read\n");
    }
    for (label, numbers) in [
        ("stages", &statistics.stages),
        ("coordinates", &statistics.coordinate_sets),
    ] {
        if !numbers.is_empty() {
            text.push_str(&format!("  {label:<13} {}\n", list(numbers)));
        }
    }
    text
}

fn to_json(statistics: &Statistics) -> serde_json::Value {
    let of = |usage: Usage| json!({ "used": usage.used, "allowed": usage.allowed });
    let phases: Vec<_> = (statistics.phases.iter())
        .map(|p| json!({ "arithmetic": of(p.arithmetic), "texture": of(p.texture) }))
        .collect();
    let files: serde_json::Map<_, _> = (statistics.files.iter())
        .map(|f| {
            let usage = json!({ "used": f.numbers, "allowed": f.allowed });
            (f.file.row().prefix.to_string(), usage)
        })
        .collect();
    json!({
        "version": statistics.version.name(),
        "phases": phases,
        "registers": files,
        "relative": statistics.relative,
        "stages": statistics.stages,
        "coordinate_sets": statistics.coordinate_sets,
    })
}

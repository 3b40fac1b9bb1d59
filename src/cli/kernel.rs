//! `kernel`: what becomes of a listing before it runs.

use super::computing::Computing;
use super::shaders::{Reading, not_one};
use super::{Failure, Outcome, diagnostics, files, print};
use texcrd::diagnostic::{SourceMap, any_error};
use texcrd::kernel::{self, Plan};
use texcrd::program::Program;

/// Prints what runs: the steps of each shader as the debugger takes them, and as whole frames are drawn with them.
///
/// The first part has a line for each step, behind the number of the line that it came from. The second works on rows (`n7`), single
/// components of many pixels or vertices at a time: rows that are filled beforehand, the steps that are taken once a draw, those
/// that are taken for every batch, and the rows that are left as results. In `mul n3, n1, n2 | n6, n4, n5` one step does the same to two
/// sets of rows, and the first row of each is the one that is written; a sample writes four, and has `_` for those that nobody reads.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  texcrd kernel asm/stained_glass/stained_glass.psh
  texcrd kernel shader.psh --model gf3
  texcrd kernel effects.fx --shader Water/P0/PixelShader")]
pub(super) struct Arguments {
    /// A listing, tokens, or a file with shaders in it; `-` is standard input.
    #[arg(value_name = "FILE")]
    file: String,
    #[command(flatten)]
    computing: Computing,
    #[command(flatten)]
    reading: Reading,
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    let mut sources = SourceMap::new();
    let opened = arguments.reading.open(&mut sources, &arguments.file)?;
    if opened.shaders.is_empty() {
        return Err(not_one(&opened, &arguments.file));
    }
    let (checked, found) =
        (arguments.reading).check_all(&mut sources, &arguments.file, &opened, false)?;
    anstream::eprint!("{}", diagnostics::render(&sources, &found));
    if any_error(&found) {
        return Err(Failure::Rejected);
    }
    let several = opened.shaders.len() > 1;
    let mut text = String::new();
    for ((name, _), checked) in opened.shaders.iter().zip(&checked) {
        // A vertex declaration has nothing that runs.
        let Some(program) = checked.accepted() else {
            continue;
        };
        if several {
            text.push_str(&format!("{name}\n\n"));
        }
        text.push_str(&shown(program, &sources, arguments)?);
        if several {
            text.push('\n');
        }
    }
    print(&text)
}

fn shown(program: &Program, sources: &SourceMap, arguments: &Arguments) -> Result<String, Failure> {
    let kernel = kernel::lower(program, &arguments.computing.lowering())
        .map_err(|error| Failure::Input(format!("{}: {error}", files::name(&arguments.file))))?;
    let plan = Plan::new(&kernel);
    let spans: Vec<_> = program.instructions().map(|i| i.span).collect();
    let line_of = |origin: usize| {
        let place = spans.get(origin).map(|span| sources.written(*span));
        place
            .and_then(|span| sources.locate(span))
            .map(|at| at.line)
    };
    let numbered = |(origin, text): &(usize, String)| match line_of(*origin) {
        Some(line) => format!("{line:>6}  {text}\n"),
        None => format!("        {text}\n"),
    };
    let plain = |text: String| format!("        {text}\n");
    let steps = plan.lines();
    let (once, every) = steps.split_at(plan.once().min(steps.len()));
    let mut text = format!("{}: {} steps\n", program.version, kernel.steps.len());
    text.extend(kernel.lines().iter().map(numbered));
    text.push_str(&format!(
        "rows: {} steps over {} rows\n",
        every.len(),
        plan.rows()
    ));
    text.push_str("filled beforehand:\n");
    text.extend(wrapped(plan.loads()).into_iter().map(plain));
    if !once.is_empty() {
        text.push_str("once a draw:\n");
        text.extend(once.iter().map(numbered));
    }
    text.push_str("for every batch:\n");
    text.extend(every.iter().map(numbered));
    text.push_str("left:\n");
    text.extend(plan.results().into_iter().map(plain));
    Ok(text)
}

/// Short texts behind each other, as many on a line as fit.
fn wrapped(texts: Vec<String>) -> Vec<String> {
    const WIDTH: usize = 92;
    let mut lines: Vec<String> = Vec::new();
    for text in texts {
        match lines.last_mut() {
            Some(line) if line.len() + 2 + text.len() <= WIDTH => {
                line.push_str(", ");
                line.push_str(&text);
            }
            _ => lines.push(text),
        }
    }
    lines
}

//! `check`: parse, validate, repair.

use super::shaders::{Reading, not_one};
use super::{Failure, Files, Format, Outcome, diagnostics, files, print, print_json, stats};
use serde_json::json;
use std::path::Path;
use texcrd::diagnostic::{Diagnostic, SourceMap, any_error};
use texcrd::program::Program;
use texcrd::{extract, validate};

/// Says everything that is wrong with listings.
///
/// Scanning errors (`1rp` for `lrp`, `rl` for `r1`, lost semicolons and mnemonics) are met on purpose.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  texcrd check shader.psh
  texcrd check --fix scanned.psh        repair the file where only one thing can have been meant
  texcrd check --stats shader.vsh       slots used of slots allowed
  texcrd check -I include -D FOG water.psh      a listing for the preprocessor
  texcrd check water.fx renderer.cpp    every shader of an effect and of a source of C
  texcrd check --format json *.psh      one object a diagnostic; with --stats one more a file")]
pub(super) struct Arguments {
    /// Listings, effects, sources of C, tokens; `-` is standard input.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<String>,
    /// Apply the repairs that are certain and leave the rest. Files are rewritten in place; of standard input the repaired
    /// text is printed.
    #[arg(long)]
    fix: bool,
    /// Print slots used of slots allowed, registers, what texture stages need, full read ports and pairs that could be.
    #[arg(long)]
    stats: bool,
    /// How results are written.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
    #[command(flatten)]
    reading: Reading,
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    let mut outcome = Files::default();
    for path in &arguments.files {
        let Some(bytes) = outcome.read(path) else {
            continue;
        };
        match check(arguments, path, bytes) {
            Ok(true) => {}
            Ok(false) => outcome.refuse(),
            Err(failure @ Failure::Input(_)) => {
                failure.tell();
                outcome.refuse();
            }
            Err(failure) => return Err(failure),
        }
    }
    outcome.outcome()
}

/// Whether all shaders of a file are accepted.
fn check(arguments: &Arguments, path: &str, mut bytes: Vec<u8>) -> Result<bool, Failure> {
    if arguments.fix {
        bytes = fix(arguments, path, bytes)?;
    }
    let mut sources = SourceMap::new();
    let opened = arguments.reading.open_bytes(&mut sources, path, bytes)?;
    let (all, found) = arguments
        .reading
        .check_all(&mut sources, path, &opened, false)?;
    if opened.shaders.is_empty() && !any_error(&found) {
        return Err(not_one(&opened, path));
    }
    report(arguments, &sources, files::name(path), &found)?;
    if arguments.stats {
        let several = opened.file.shaders.len() > 1;
        for ((name, _), checked) in opened.shaders.iter().zip(&all) {
            if let Some(program) = &checked.program {
                let name = Some(name.as_str()).filter(|_| several);
                statistics(arguments, &sources, files::name(path), name, program)?;
            }
        }
    }
    Ok(!any_error(&found))
}

/// Repairs a file until nothing certain is left to repair, and writes it back.
fn fix(arguments: &Arguments, path: &str, original: Vec<u8>) -> Result<Vec<u8>, Failure> {
    let read = |sources: &mut SourceMap, bytes: Vec<u8>| {
        let opened = arguments.reading.open_bytes(sources, path, bytes)?;
        let (_, found) = arguments.reading.check_all(sources, path, &opened, true)?;
        Ok((opened.file, found))
    };
    let (bytes, repaired) = extract::repair(original.clone(), read)?;
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

fn report(arguments: &Arguments, sources: &SourceMap, name: &str, found: &[Diagnostic]) -> Outcome {
    if arguments.format == Format::Json {
        return diagnostics::tell(Format::Json, sources, found);
    }
    let mut text = diagnostics::render(sources, found);
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

/// `shader`: its name, if it is one of several.
fn statistics(
    arguments: &Arguments,
    sources: &SourceMap,
    file: &str,
    shader: Option<&str>,
    program: &Program,
) -> Outcome {
    let counted = validate::statistics(program);
    match (arguments.format, shader) {
        (Format::Json, None) => {
            print_json(&json!({ "file": file, "stats": stats::to_json(sources, &counted) }))
        }
        (Format::Json, Some(name)) => print_json(
            &json!({ "file": file, "shader": name, "stats": stats::to_json(sources, &counted) }),
        ),
        (Format::Text, None) => print(&stats::to_text(sources, &counted)),
        (Format::Text, Some(name)) => {
            print(&format!("{name}: {}", stats::to_text(sources, &counted)))
        }
    }
}

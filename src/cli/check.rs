//! `check`: parse, validate, repair.

use super::shaders::{Reading, not_one};
use super::{Failure, Format, Outcome, diagnostics, files, print, print_json};
use serde_json::json;
use std::path::Path;
use texcrd::diagnostic::{Diagnostic, SourceMap, any_error};
use texcrd::isa::ShaderKind;
use texcrd::program::Program;
use texcrd::validate::{Statistics, Usage};
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
    /// Print slots used of slots allowed, registers and stages.
    #[arg(long)]
    stats: bool,
    /// How results are written.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
    #[command(flatten)]
    reading: Reading,
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

/// Whether all shaders of a file are accepted.
fn check(arguments: &Arguments, path: &str) -> Result<bool, Failure> {
    let mut bytes = files::read(path)?;
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
                statistics(arguments, files::name(path), name, program)?;
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
    file: &str,
    shader: Option<&str>,
    program: &Program,
) -> Outcome {
    let statistics = validate::statistics(program);
    match (arguments.format, shader) {
        (Format::Json, None) => print_json(&json!({ "file": file, "stats": to_json(&statistics) })),
        (Format::Json, Some(name)) => {
            print_json(&json!({ "file": file, "shader": name, "stats": to_json(&statistics) }))
        }
        (Format::Text, None) => print(&to_text(&statistics)),
        (Format::Text, Some(name)) => print(&format!("{name}: {}", to_text(&statistics))),
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

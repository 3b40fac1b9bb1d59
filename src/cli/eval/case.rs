//! The invocations of a shader unit test.

use super::told::Run;
use super::{Arguments, json_of, text_of};
use crate::cli::{Failure, Format, Outcome, diagnostics, files, print, print_json};
use serde_json::{Map, json};
use std::path::Path;
use texcrd::case::{Case, Invocation, record};
use texcrd::scene::DirectoryResolver;

/// Whether a file is a case by its name.
pub(super) fn is_case(path: &str) -> bool {
    let extension = Path::new(path).extension();
    extension.is_some_and(|e| e.eq_ignore_ascii_case("toml") || e.eq_ignore_ascii_case("json"))
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    let path = &arguments.file;
    if !arguments.set.is_empty() {
        let why = "only of a listing; a shader unit test has its own values";
        return Err(Failure::Io(format!("--set: {why}")));
    }
    let bytes = files::read(path)?;
    let resolver = DirectoryResolver::new(Path::new(path).parent().unwrap_or(Path::new("")));
    let models = arguments.computing.models();
    let mut cases = Vec::new();
    for model in &models {
        let options = (arguments.computing).loading(*model, arguments.reading.dialect);
        let case = Case::load(files::name(path), &bytes, &resolver, &options);
        let case = case.map_err(|error| {
            anstream::eprint!(
                "{}",
                diagnostics::render(&error.sources, &error.diagnostics)
            );
            Failure::Rejected
        })?;
        let own = case.pixel.as_ref().map(|shader| shader.kernel.model);
        if let Some(own) = own.filter(|own| own != model && models.len() > 1) {
            let why = format!("{path} is a case of the model {own} itself");
            return Err(Failure::Input(why));
        }
        cases.push(case);
    }
    let Some(first) = cases.first() else {
        return Ok(());
    };
    anstream::eprint!("{}", diagnostics::render(first.sources(), first.warnings()));
    let count = first.invocations.len();
    let wanted = match arguments.invocation {
        None => 1..=count,
        Some(number) if (1..=count).contains(&number) => number..=number,
        Some(number) => {
            let why = format!("--invocation {number}: {path} has {count}");
            return Err(Failure::Io(why));
        }
    };
    for number in wanted {
        let invocations: Vec<(&Case, &Invocation)> = (cases.iter())
            .filter_map(|case| Some((case, case.invocations.get(number - 1)?)))
            .collect();
        tell(arguments, &invocations, number, count > 1)?;
    }
    Ok(())
}

/// Prints one invocation, under every model.
fn tell(
    arguments: &Arguments,
    invocations: &[(&Case, &Invocation)],
    number: usize,
    several: bool,
) -> Outcome {
    let (mut vertex, mut pixel) = (Vec::new(), Vec::new());
    for (case, invocation) in invocations {
        let told = record(case, invocation);
        vertex.extend(told.vertex.map(Run::new));
        pixel.extend(told.pixel.map(Run::new));
    }
    // A vertex shader computes with floats under every model.
    vertex.truncate(1);
    let name = invocations
        .first()
        .and_then(|(_, invocation)| invocation.name.as_ref());
    if arguments.format == Format::Json {
        let mut object = Map::new();
        object.insert("invocation".into(), json!(number));
        object.insert("name".into(), json!(name));
        for (key, runs) in [("vertex", &vertex), ("pixel", &pixel)] {
            if !runs.is_empty() {
                object.insert(key.into(), json_of(runs, arguments.trace));
            }
        }
        return print_json(&object.into());
    }
    let mut out = String::new();
    if several {
        let gap = if number > 1 && arguments.invocation.is_none() {
            "\n"
        } else {
            ""
        };
        let name = name.map_or(String::new(), |name| format!(": {name}"));
        out.push_str(&format!("{gap}// invocation {number}{name}\n"));
    }
    for runs in [&vertex, &pixel] {
        if let Some(first) = runs.first() {
            if !vertex.is_empty() && !pixel.is_empty() {
                out.push_str(&format!("// {}\n", first.version()));
            }
            out.push_str(&text_of(runs, arguments.trace));
        }
    }
    print(out.trim_end_matches('\n'))?;
    print("\n")
}

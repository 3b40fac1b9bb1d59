//! `eval`: one invocation on the CPU.

mod case;
mod several;
mod told;

use super::computing::Several;
use super::given::{self, Runnable};
use super::shaders::Reading;
use super::{Failure, Format, Outcome, diagnostics, print, print_json};
use serde_json::{Value, json};
use texcrd::debug::{Listing, ListingSubject, Subject};
use texcrd::isa::{Version, WriteMask};
use texcrd::kernel;
use texcrd::validate;
use told::Run;

/// Runs a listing once, with values set by hand, or the invocations of a shader unit test, and prints the registers.
///
/// With a listing no texture is bound: a sample is opaque black, as Direct3D 8 had it. A test case (.toml or .json, docs/cases.md)
/// brings its inputs, constants, textures and states. --trace prints every number that went into each instruction.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  texcrd eval shader.psh --set t0=0.5,0.25,0,1 --set c1=1,0,0,1
  texcrd eval shader.vsh --set v0=1,2,3 --trace
  texcrd eval shader.psh --set v0=0.5 --trace --model gf3,float    where the two part first
  texcrd eval case.toml --trace --invocation 2                     a shader unit test, step by step
  echo 'ps.1.1 mul r0, v0, c0' | texcrd eval - --set v0=1 --set c0=0.5 --format json")]
pub(super) struct Arguments {
    /// A listing, or a file with shaders in it, all of which are run, or a shader unit test (.toml, .json); `-` is a listing from
    /// standard input.
    #[arg(value_name = "FILE")]
    file: String,
    /// Sets an input or a constant: v#, t# (texture coordinates) or c#. One number fills all four components; of
    /// two or three the rest is 0, 0, 1 as for vertex data. Of several shaders those take it that have the register.
    #[arg(
        long = "set",
        value_name = "REG=X[,Y[,Z[,W]]]",
        allow_hyphen_values = true
    )]
    set: Vec<String>,
    /// Print what every instruction read, computed and wrote.
    #[arg(long)]
    trace: bool,
    /// Of a shader unit test only this invocation, from 1.
    #[arg(long, value_name = "N")]
    invocation: Option<usize>,
    /// How results are written.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
    #[command(flatten)]
    computing: Several,
    #[command(flatten)]
    reading: Reading,
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    if case::is_case(&arguments.file) {
        return case::run(arguments);
    }
    if arguments.invocation.is_some() {
        return Err(Failure::Io(
            "--invocation: only of a shader unit test".into(),
        ));
    }
    let models = arguments.computing.models();
    let first = models.first().copied().unwrap_or_default();
    let options = arguments.computing.lowering(first);
    let all = given::load_all(&arguments.file, &arguments.reading, &options)?;
    let versions: Vec<Version> = all.shaders.iter().map(|s| s.program.version).collect();
    let given = given::given_each(&arguments.set, &versions)?;
    let several = all.shaders.len() > 1 || all.refused;
    for (shader, given) in all.shaders.into_iter().zip(&given) {
        let Runnable {
            name,
            program,
            kernel,
        } = shader;
        let set = given.constants.iter().map(|(number, _)| *number);
        let unset = validate::unset_constants(&program, set);
        anstream::eprint!("{}", diagnostics::render(&all.sources, &unset));
        let mut kernels = vec![kernel];
        for model in models.iter().skip(1) {
            let kernel = kernel::lower(&program, &arguments.computing.lowering(*model))
                .map_err(|e| Failure::Input(e.to_string()))?;
            kernels.push(kernel);
        }
        let run = |kernel| {
            let listing = Listing {
                sources: &all.sources,
                program: &program,
                kernel,
            };
            let given = given.clone();
            let subject = Subject::Listing(ListingSubject { listing, given });
            subject.record(&[]).pop().map(Run::new)
        };
        let runs: Vec<Run<'_>> = kernels.iter().filter_map(run).collect();
        tell(arguments, &runs, several.then_some(&name))?;
    }
    match all.refused {
        true => Err(Failure::Rejected),
        false => Ok(()),
    }
}

/// The runs of a shader, one a model, as JSON.
fn json_of(runs: &[Run<'_>], with_trace: bool) -> Value {
    match runs {
        [run] => run.json(with_trace),
        runs => several::json(runs, with_trace),
    }
}

/// As text.
fn text_of(runs: &[Run<'_>], with_trace: bool) -> String {
    match runs {
        [run] => run.text(with_trace),
        runs => several::text(runs, with_trace),
    }
}

/// Prints the runs of a shader, one a model; `name`: what it is called, if it is one of several.
fn tell(arguments: &Arguments, runs: &[Run<'_>], name: Option<&String>) -> Outcome {
    if arguments.format == Format::Json {
        let mut object = json_of(runs, arguments.trace);
        if let Some(name) = name {
            object["shader"] = json!(name);
        }
        return print_json(&object);
    }
    let text = text_of(runs, arguments.trace);
    match name {
        Some(name) => print(&format!("// {name}\n{text}\n")),
        None => print(&text),
    }
}

/// The components of a mask in the shortest form that reads back to the same bits.
fn numbers(value: [f32; 4], mask: WriteMask) -> String {
    let texts: Vec<String> = mask.components().map(|c| value[c].to_string()).collect();
    texts.join(", ")
}

/// JSON has no infinities and no NaN; they are written as strings.
pub(super) fn json_number(number: f32) -> Value {
    let text = number.to_string();
    // Through its text, so that the shortest form that reads back to the same 32 bits is printed.
    match text.parse::<f64>() {
        Ok(double) if double.is_finite() => json!(double),
        _ => json!(text),
    }
}

/// As [`json_number`].
pub(super) fn json_vector(value: [f32; 4]) -> Value {
    Value::Array(value.into_iter().map(json_number).collect())
}

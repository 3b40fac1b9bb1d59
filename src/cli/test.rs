//! `test`: shader unit tests.

use super::computing::Computing;
use super::eval::json_number;
use super::{Failure, Format, Outcome, diagnostics, dialect, files, print, print_json, scene};
use clap::ValueEnum;
use serde_json::{Value, json};
use std::fs;
use std::path::Path;
use texcrd::case::{Case, CaseError, Invocation, OnGpu, Origin, Verdict, Wrong};
use texcrd::gpu::{Device, GpuError};
use texcrd::policy::Dialect;
use texcrd::scene::DirectoryResolver;

/// Folders nest at most this deep; deeper ones are probably links that lead in circles.
const MAX_DEPTH: usize = 32;

/// Runs shader unit tests: cases that say what a listing computes from given inputs.
///
/// The format is described in docs/cases.md. Of a wrong number the instruction that wrote it is told.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  texcrd test tests/conformance
  texcrd test my_shader.toml other.json
  texcrd test tests/conformance --filter texbem
  texcrd test cases --on both                 on the CPU and on the GPU
  texcrd test cases --quiet                   failures and the summary only
  texcrd test cases --format json             one object a case

A case, lrp.toml:
  ps = \"ps.1.1\\nlrp r0, c0, v0, v1\"
  ps_constants.c0 = [0.25, 0.25, 0.25, 0.25]
  inputs.v0 = [1, 0, 0, 1]
  inputs.v1 = [0, 1, 0, 1]
  expect.r0 = [0.25, 0.75, 0, 1]

Exit status: 0 every case passes, 1 one fails or cannot be read as a case, 2 usage or I/O.")]
pub(super) struct Arguments {
    /// Cases, or folders of them: every .toml and .json below, in the order of their names. `-` is standard input.
    #[arg(required = true, value_name = "CASE")]
    cases: Vec<String>,
    /// Run only the cases whose path or name has this text in it.
    #[arg(long, value_name = "TEXT")]
    filter: Option<String>,
    /// Where the shaders run.
    #[arg(long, value_enum, default_value_t)]
    on: On,
    /// The GPU: its number in `texcrd adapters`, or a part of its name. Without it the first one.
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
    /// Do not tell of cases that pass.
    #[arg(short, long)]
    quiet: bool,
    /// How results are written.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
    /// Whose rules the listings are judged by: d3d8, d3d9 or lenient.
    #[arg(long, value_parser = dialect, default_value = "d3d8")]
    dialect: Dialect,
    #[command(flatten)]
    computing: Computing,
}

/// What runs the shaders.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum On {
    /// The interpreter.
    #[default]
    Cpu,
    /// A GPU, or a software adapter, through WGSL.
    Gpu,
    /// One after the other; a case passes if it does on both.
    Both,
}

/// One of the two.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    Cpu,
    Gpu,
}

impl Side {
    fn name(self) -> &'static str {
        match self {
            Self::Cpu => "cpu",
            Self::Gpu => "gpu",
        }
    }
}

impl On {
    fn sides(self) -> &'static [Side] {
        match self {
            Self::Cpu => &[Side::Cpu],
            Self::Gpu => &[Side::Gpu],
            Self::Both => &[Side::Cpu, Side::Gpu],
        }
    }
}

/// How many cases came out how.
#[derive(Default)]
struct Counts {
    passed: usize,
    /// Those of the passed ones that only gave another result that is accepted.
    accepted: usize,
    failed: usize,
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    let sides = arguments.on.sides();
    let device = match (sides.contains(&Side::Gpu), &arguments.adapter) {
        (true, adapter) => Some(scene::device(adapter.as_deref())?),
        (false, None) => None,
        (false, Some(_)) => {
            let message = "--adapter: only with --on gpu or --on both";
            return Err(Failure::Io(message.into()));
        }
    };
    let mut on_gpu = device.as_ref().map(OnGpu::new);
    let mut paths = Vec::new();
    for path in &arguments.cases {
        if path != "-" && Path::new(path).is_dir() {
            collect(Path::new(path), 0, &mut paths)?;
        } else {
            paths.push(path.clone());
        }
    }
    let mut counts = Counts::default();
    let mut failures = String::new();
    // What ends the run early; what ran before is told all the same.
    let mut stopped = None;
    for path in &paths {
        let bytes = match files::read(path) {
            Ok(bytes) => bytes,
            Err(failure) => {
                stopped = Some(failure);
                break;
            }
        };
        let folder = Path::new(path).parent().unwrap_or(Path::new(""));
        let options = arguments.computing.loading(arguments.dialect);
        let resolver = DirectoryResolver::new(folder);
        let loaded = Case::load(files::name(path), &bytes, &resolver, &options);
        let name = loaded.as_ref().map_or("", |case| case.name.as_str());
        if let Some(text) = &arguments.filter
            && ![path, name].iter().any(|s| contains(s, text))
        {
            continue;
        }
        let result = match loaded {
            Ok(case) => {
                let runs = sides.iter().map(|side| {
                    let verdicts = match (side, &mut on_gpu) {
                        (Side::Gpu, Some(gpu)) => gpu.check(&case),
                        _ => Ok(case.check()),
                    };
                    (*side, verdicts)
                });
                let runs: Vec<SideRun> = runs.collect();
                if let Some((_, Err(error))) = runs.last()
                    && let Some(message) = fatal(path, error, device.as_ref())
                {
                    stopped = Some(Failure::Io(message));
                    break;
                }
                Ok((case, runs))
            }
            Err(error) => Err(error),
        };
        counts.add(&result);
        match arguments.format {
            Format::Json => {
                for object in to_json(path, &result) {
                    print_json(&object)?;
                }
            }
            Format::Text => {
                let line = line(path, &result);
                if !arguments.quiet || !line.starts_with("ok") {
                    print(&line)?;
                }
                failures.push_str(&details(path, &result));
            }
        }
    }
    if counts.passed + counts.failed == 0 {
        if let Some(failure) = stopped {
            return Err(failure);
        }
        let what = match &arguments.filter {
            Some(text) => format!("no case has `{text}` in its path or name"),
            None => "there are no cases".to_owned(),
        };
        return Err(Failure::Io(what));
    }
    if arguments.format == Format::Text {
        if !failures.is_empty() {
            print(&format!("\n{failures}"))?;
        }
        let adapter = device.map(|device| device.adapter().to_string());
        print(&counts.summary(arguments.on, adapter.as_deref()))?;
    }
    if let Some(failure) = stopped {
        return Err(failure);
    }
    if counts.failed > 0 {
        return Err(Failure::Rejected);
    }
    Ok(())
}

/// What is told where an error of the GPU is one that the cases behind would meet as well.
fn fatal(path: &str, error: &GpuError, device: Option<&Device>) -> Option<String> {
    let adapter = device?.adapter();
    match error {
        GpuError::Lost(_) => Some(format!("{path}: {error}")),
        GpuError::Limit { .. } if !adapter.float_targets => Some(format!(
            "{path}: the adapter {adapter} cannot draw into 32-bit floats, in which registers are looked at; \
             it runs only cases that expect nothing but `frame`"
        )),
        _ => None,
    }
}

/// The cases below a folder.
fn collect(folder: &Path, depth: usize, paths: &mut Vec<String>) -> Outcome {
    let failed = |e: std::io::Error| Failure::Io(format!("{}: {e}", folder.display()));
    if depth > MAX_DEPTH {
        let message = format!("{}: folders nest too deep", folder.display());
        return Err(Failure::Io(message));
    }
    let mut entries = fs::read_dir(folder)
        .and_then(|entries| entries.collect::<Result<Vec<_>, _>>())
        .map_err(failed)?;
    entries.sort_by_key(fs::DirEntry::file_name);
    for entry in entries {
        let path = entry.path();
        let is_case = (path.extension()).is_some_and(|extension| {
            ["toml", "json"]
                .iter()
                .any(|known| extension.eq_ignore_ascii_case(known))
        });
        if path.is_dir() {
            collect(&path, depth + 1, paths)?;
        } else if is_case {
            paths.push(path.display().to_string());
        }
    }
    Ok(())
}

fn contains(text: &str, part: &str) -> bool {
    text.to_lowercase().contains(&part.to_lowercase())
}

/// What came of a case on one side, invocation by invocation.
type SideRun = (Side, Result<Vec<Verdict>, GpuError>);
type Ran = Result<(Case, Vec<SideRun>), Box<CaseError>>;

/// How a case came out on one side, in a word.
fn outcome((_, run): &SideRun) -> &'static str {
    match run {
        Err(_) => "error",
        Ok(verdicts) if !verdicts.iter().all(Verdict::passes) => "failed",
        Ok(verdicts) if verdicts.iter().all(|v| *v == Verdict::Passed) => "passed",
        Ok(_) => "accepted",
    }
}

/// How a case came out on all sides: the worst of its outcomes.
fn worst(ran: &Ran) -> &'static str {
    let Ok((_, runs)) = ran else {
        return "error";
    };
    let came = |what: &&str| runs.iter().any(|run| outcome(run) == *what);
    let worst = ["error", "failed", "accepted"].into_iter().find(came);
    worst.unwrap_or("passed")
}

impl Counts {
    fn add(&mut self, ran: &Ran) {
        match worst(ran) {
            "passed" => self.passed += 1,
            "accepted" => {
                self.passed += 1;
                self.accepted += 1;
            }
            _ => self.failed += 1,
        }
    }

    fn summary(&self, on: On, adapter: Option<&str>) -> String {
        let Self {
            passed,
            accepted,
            failed,
        } = self;
        let apart = match accepted {
            0 => String::new(),
            _ => format!(" ({accepted} of those that passed by another accepted result)"),
        };
        let place = match (on, adapter) {
            (On::Both, Some(adapter)) => format!(" on cpu and gpu, {adapter}"),
            (_, Some(adapter)) => format!(" on gpu, {adapter}"),
            (_, None) => String::new(),
        };
        format!("{passed} passed, {failed} failed{apart}{place}\n")
    }
}

/// One line a case.
fn line(path: &str, ran: &Ran) -> String {
    let path = files::name(path);
    let (mark, name) = match (worst(ran), ran) {
        (_, Err(_)) => ("ERROR", String::new()),
        ("passed", Ok((case, _))) => ("ok", title(path, case)),
        ("accepted", Ok((case, _))) => ("ok, accepted", title(path, case)),
        ("error", Ok((case, _))) => ("ERROR", title(path, case)),
        (_, Ok((case, _))) => ("FAILED", title(path, case)),
    };
    format!("{mark:<6} {path}{name}\n")
}

/// The name of a case behind its path, unless it is the path.
fn title(path: &str, case: &Case) -> String {
    if case.name == path {
        return String::new();
    }
    format!(": {}", case.name)
}

/// What a person must know of a case that did not simply pass.
fn details(path: &str, ran: &Ran) -> String {
    let (case, runs) = match ran {
        Ok(ran) => ran,
        Err(error) => return diagnostics::render(&error.sources, &error.diagnostics),
    };
    let path = files::name(path);
    let title = title(path, case);
    let mut text = String::new();
    for (side, run) in runs {
        let on = side.name();
        let verdicts = match run {
            Ok(verdicts) => verdicts,
            Err(error) => {
                text.push_str(&format!("error on {on}: {path}{title}: {error}\n\n"));
                continue;
            }
        };
        for (number, (invocation, verdict)) in case.invocations.iter().zip(verdicts).enumerate() {
            let which = which(case, number, invocation);
            let place = format!("{path}:{}{title}{which}", invocation.line);
            match verdict {
                Verdict::Passed => {}
                Verdict::Accepted(other) => text.push_str(&format!(
                    "accepted on {on}: {place}: it gave result {} of `accept`\n\n",
                    other + 1
                )),
                Verdict::Failed(wrong) => {
                    text.push_str(&format!("failed on {on}: {place}\n"));
                    wrong.iter().for_each(|entry| text.push_str(&told(entry)));
                    text.push('\n');
                }
            }
        }
    }
    text
}

/// Which of several invocations, for people.
fn which(case: &Case, number: usize, invocation: &Invocation) -> String {
    match &invocation.name {
        Some(name) => format!(", {name}"),
        None if case.invocations.len() > 1 => format!(", invocation {}", number + 1),
        None => String::new(),
    }
}

fn told(wrong: &Wrong) -> String {
    match wrong {
        Wrong::Number {
            quantity,
            component,
            expected,
            actual,
            difference,
            tolerance,
            origin,
        } => {
            let mut place = quantity.to_string();
            if let Some(letter) = quantity.letter(*component) {
                place.push('.');
                place.push(letter);
            }
            let difference = if difference.is_finite() {
                let [difference, tolerance] = [*difference, *tolerance].map(number);
                format!(", off by {difference} (tolerance {tolerance})")
            } else {
                String::new()
            };
            let born = match origin {
                Some(origin) => format!("{} {}", origin.how, place_of(origin)),
                None => "no instruction writes it".to_owned(),
            };
            let [expected, actual] = [*expected, *actual].map(|x| number(x.into()));
            format!(
                "  {place:<7} expected {expected}, got {actual}{difference}\n          {born}\n"
            )
        }
        Wrong::Killed { expected: true, .. } => {
            "  killed  expected true: no texkill discarded the pixel\n".to_owned()
        }
        Wrong::Killed { origin, .. } => {
            let by = origin.as_ref().map_or_else(String::new, |origin| {
                format!("\n          {} {}", origin.how, place_of(origin))
            });
            format!("  killed  expected false{by}\n")
        }
    }
}

/// A number with the digits that tell it from other 32-bit floats: very small and very large ones with an exponent.
fn number(exact: f64) -> String {
    let short = exact as f32;
    match short.abs() {
        // The difference of two floats may be larger than any of them.
        size if size.is_infinite() && exact.is_finite() => format!("{exact:.3e}"),
        size if size != 0.0 && size.is_finite() && !(1e-5..1e7).contains(&size) => {
            format!("{short:e}")
        }
        _ => short.to_string(),
    }
}

fn place_of(origin: &Origin) -> String {
    let Origin {
        listing,
        line,
        text,
        ..
    } = origin;
    format!("`{text}` ({listing}, line {line})")
}

/// A case for programs: an object for each side.
fn to_json(path: &str, ran: &Ran) -> Vec<Value> {
    let file = files::name(path);
    match ran {
        Ok((case, runs)) => runs.iter().map(|run| run_json(file, case, run)).collect(),
        Err(error) => {
            let diagnostics: Vec<Value> = (error.diagnostics.iter())
                .map(|diagnostic| diagnostics::to_json(&error.sources, diagnostic))
                .collect();
            vec![json!({
                "file": file,
                "name": null,
                "on": null,
                "outcome": worst(ran),
                "diagnostics": diagnostics,
            })]
        }
    }
}

fn run_json(file: &str, case: &Case, run: &SideRun) -> Value {
    let (side, result) = run;
    let mut object = json!({
        "file": file,
        "name": case.name,
        "on": side.name(),
        "outcome": outcome(run),
    });
    match result {
        Ok(verdicts) => object["invocations"] = invocations_json(case, verdicts).into(),
        Err(error) => object["error"] = error.to_string().into(),
    }
    object
}

fn invocations_json(case: &Case, verdicts: &[Verdict]) -> Vec<Value> {
    (case.invocations.iter().zip(verdicts).enumerate())
        .map(|(number, (invocation, verdict))| {
            let mut object = json!({
                "invocation": number + 1,
                "name": invocation.name,
                "line": invocation.line,
            });
            match verdict {
                Verdict::Passed => object["outcome"] = json!("passed"),
                Verdict::Accepted(other) => {
                    object["outcome"] = json!("accepted");
                    object["accepted"] = json!(other + 1);
                }
                Verdict::Failed(wrong) => {
                    object["outcome"] = json!("failed");
                    let wrong = wrong.iter().map(wrong_json);
                    object["wrong"] = wrong.collect();
                }
            }
            object
        })
        .collect()
}

fn wrong_json(wrong: &Wrong) -> Value {
    let (mut object, origin) = match wrong {
        Wrong::Number {
            quantity,
            component,
            expected,
            actual,
            difference,
            tolerance,
            origin,
        } => (
            json!({
                "register": quantity.to_string(),
                "component": quantity.letter(*component).map(String::from),
                "expected": json_number(*expected),
                "actual": json_number(*actual),
                "difference": if difference.is_finite() { json!(difference) } else { Value::Null },
                "tolerance": tolerance,
            }),
            origin,
        ),
        Wrong::Killed { expected, origin } => (
            json!({ "register": "killed", "expected": expected, "actual": !expected }),
            origin,
        ),
    };
    object["written_by"] = match origin {
        Some(Origin {
            listing,
            line,
            text,
            how,
        }) => json!({ "listing": listing, "line": line, "text": text, "how": how }),
        None => Value::Null,
    };
    object
}

//! `fuzz-match`: generated shaders on the CPU and on a GPU.

use super::computing::Computing;
use super::{Failure, Format, Outcome, filters, generate, print, print_json, scene};
use clap::Args;
use serde_json::{Value, json};
use std::fmt::Write;
use std::time::Instant;
use texcrd::generate::{Precision, Textures};
use texcrd::gpu::Device;
use texcrd::isa::Version;
use texcrd::matching::{self, Coverage, Group, MatchError, Mismatch, Plan, Report};
use texcrd::policy::{Model, Policies, Policy};

/// Compares the CPU with a GPU on generated shaders: every number that they compute, each with a bound of its own.
///
/// A shader on which the two part is made as small as it can be and printed as a test case (docs/cases.md). Which
/// difference is allowed to which number, and why, is told in docs/matching.md.
#[derive(Args)]
#[command(disable_version_flag = true)]
#[command(after_help = "\
Examples:
  texcrd fuzz-match --count 100000 --seed 1
  texcrd fuzz-match --count 5000 --seed 1 --version ps.1.4
  texcrd fuzz-match --version ps.1.4 --seed 1234      one shader again
  texcrd fuzz-match --count 5000 --model gf3          with the numbers of a GeForce 3

Exit status: 0 no mismatch, 1 a mismatch, 2 usage or I/O.")]
pub(super) struct Arguments {
    /// How many shaders
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..))]
    count: u64,
    /// Seed of the first shader; those of the others follow from it
    #[arg(long, value_name = "S", default_value_t = 0)]
    seed: u64,
    /// Only shaders of this version; may be repeated [default: all, in turns]
    #[arg(long = "version", value_name = "VERSION", value_parser = generate::version)]
    versions: Vec<Version>,
    /// Which GPU: a number of `texcrd adapters`, or a part of its name
    #[arg(long, value_name = "ADAPTER")]
    adapter: Option<String>,
    /// How many pipelines are made at a time [default: one a core for software adapters, else 1]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(1..=64))]
    jobs: Option<u8>,
    /// How many of the mismatches are made small and printed as cases
    #[arg(long, value_name = "N", default_value_t = 3)]
    shrink: usize,
    #[command(flatten)]
    computing: Computing,
    /// How results are written
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    let begun = Instant::now();
    let devices = devices(arguments)?;
    let Some(device) = devices.first() else {
        return Err(Failure::Io("no device".into()));
    };
    let plan = Plan {
        count: arguments.count,
        seed: arguments.seed,
        versions: match arguments.versions.as_slice() {
            [] => Version::all().collect(),
            some => some.to_vec(),
        },
        precision: precision(device),
        model: arguments.computing.model(),
        policies: arguments.computing.policies(),
        weights: generate::weights(&arguments.computing),
    };
    let bar = scene::progress_bar();
    bar.set_length(plan.count);
    bar.set_message("shaders");
    let report = matching::run(&devices, &plan, None, &|done| bar.inc(done)).map_err(failure)?;
    bar.finish_and_clear();
    let large = report.mismatches.iter().take(arguments.shrink);
    let bar = scene::progress_bar();
    bar.set_length(large.len() as u64);
    bar.set_message("mismatches made small");
    let mut small = Vec::new();
    for mismatch in large {
        small.push(matching::shrink(device, mismatch, None).map_err(failure)?);
        bar.inc(1);
    }
    bar.finish_and_clear();
    let seconds = begun.elapsed().as_secs_f64();
    let adapter = device.adapter().to_string();
    let textures = Textures::with_model(plan.model).map_err(|e| Failure::Input(e.to_string()))?;
    match arguments.format {
        Format::Text => print(&text(&plan, &report, &small, &adapter, seconds, &textures))?,
        Format::Json => print_json(&json(&plan, &report, &small, &adapter, seconds, &textures))?,
    }
    match report.mismatches.is_empty() {
        true => Ok(()),
        false => Err(Failure::Rejected),
    }
}

fn failure(error: MatchError) -> Failure {
    Failure::Io(error.to_string())
}

/// One device a thread: software adapters compile on the thread that draws.
fn devices(arguments: &Arguments) -> Result<Vec<Device>, Failure> {
    let first = scene::device(arguments.adapter.as_deref())?;
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let jobs = match arguments.jobs {
        Some(jobs) => usize::from(jobs),
        None if first.adapter().kind == "software" => cores.min(64),
        None => 1,
    };
    let mut devices = vec![first];
    while devices.len() < jobs {
        devices.push(scene::device(arguments.adapter.as_deref())?);
    }
    Ok(devices)
}

/// What may be asked of a device. Mesa's software adapter filters with 8 bits, results included, unless it is told not to:
/// then a sample may be off by 1.5 steps of 1/255.
fn precision(device: &Device) -> Precision {
    let usual = Precision::default();
    match device.adapter().name.contains("llvmpipe") && !filters::are_exact() {
        true => Precision {
            sample: 1.5 / 255.0,
            ..usual
        },
        false => usual,
    }
}

/// The options that say with what numbers shaders compute, where that is not as usual.
fn computing(plan: &Plan) -> String {
    let mut options = String::new();
    if plan.model != Model::default() {
        let _ = write!(options, " --model {}", plan.model);
    }
    for policy in Policy::all() {
        let value = policy.get(&plan.policies);
        if value != policy.get(&Policies::default()) {
            let _ = write!(options, " --policy {}={value}", policy.name);
        }
    }
    options
}

fn text(
    plan: &Plan,
    report: &Report,
    small: &[Mismatch],
    adapter: &str,
    seconds: f64,
    textures: &Textures,
) -> String {
    let mut text = String::new();
    for (mismatch, whole) in small.iter().zip(&report.mismatches) {
        let version = mismatch.subject.generated.program.version;
        let _ = writeln!(
            text,
            "mismatch: {version}, seed {}; again with `texcrd fuzz-match --version {version} --seed {}{}`",
            mismatch.seed,
            mismatch.seed,
            computing(plan)
        );
        let _ = writeln!(text, "\nas generated:\n{}", whole.subject.generated.listing);
        let _ = writeln!(text, "made small, as a case:\n");
        let _ = writeln!(text, "{}", matching::case_text(mismatch, textures));
    }
    for mismatch in report.mismatches.iter().skip(small.len()) {
        let version = mismatch.subject.generated.program.version;
        let first = mismatch.differences.first();
        let first = first.map(|d| matching::describe(&mismatch.subject, d));
        let first = first.unwrap_or_default();
        let _ = writeln!(text, "mismatch: {version}, seed {}: {first}", mismatch.seed);
    }
    let comparison = &report.comparison;
    let shaders = match report.shaders {
        1 => "1 shader".to_owned(),
        count => format!("{count} shaders"),
    };
    let with = match computing(plan) {
        with if with.is_empty() => with,
        with => format!(" with{with}"),
    };
    let _ = writeln!(
        text,
        "{shaders}{with}, CPU against {adapter}, {seconds:.0} s"
    );
    let _ = writeln!(
        text,
        "  {} numbers compared, {:.2} % equal to the bit; a difference took {:.0} % of its bound at most",
        comparison.numbers,
        100.0 * comparison.equal as f64 / comparison.numbers.max(1) as f64,
        100.0 * comparison.share,
    );
    let _ = writeln!(text, "  reached, of what there is:");
    let _ = write!(text, "    {:8}", "");
    for group in Group::ALL {
        let _ = write!(text, " {:>12}", group.name());
    }
    let _ = writeln!(text);
    for version in &plan.versions {
        let _ = write!(text, "    {:8}", version.name());
        for group in Group::ALL {
            let (reached, all) = report.coverage.reached(*version, group);
            let cell = if all == 0 {
                "-".into()
            } else {
                format!("{reached}/{all}")
            };
            let _ = write!(text, " {cell:>12}");
        }
        let _ = writeln!(text);
    }
    let mismatches = report.mismatches.len();
    let _ = match mismatches {
        0 => writeln!(text, "no mismatch"),
        1 => writeln!(text, "1 mismatch"),
        _ => writeln!(text, "{mismatches} mismatches"),
    };
    text
}

fn json(
    plan: &Plan,
    report: &Report,
    small: &[Mismatch],
    adapter: &str,
    seconds: f64,
    textures: &Textures,
) -> Value {
    let comparison = &report.comparison;
    let coverage: serde_json::Map<_, _> = (plan.versions.iter())
        .map(|version| {
            (
                version.name().to_owned(),
                coverage(&report.coverage, *version),
            )
        })
        .collect();
    let policies: serde_json::Map<_, _> = Policy::all()
        .map(|policy| (policy.name.to_owned(), json!(policy.get(&plan.policies))))
        .collect();
    let mismatches: Vec<_> = (report.mismatches.iter().enumerate())
        .map(|(number, mismatch)| {
            let small = small.get(number);
            let differences = mismatch.differences.iter();
            json!({
                "version": mismatch.subject.generated.program.version.name(),
                "number": mismatch.number,
                "seed": mismatch.seed,
                "listing": mismatch.subject.generated.listing,
                "differences": differences
                    .map(|d| matching::describe(&mismatch.subject, d))
                    .collect::<Vec<_>>(),
                "small_listing": small.map(|small| &small.subject.generated.listing),
                "case": small.map(|small| matching::case_text(small, textures)),
            })
        })
        .collect();
    json!({
        "adapter": adapter,
        "seed": plan.seed,
        "model": plan.model.name(),
        "policies": policies,
        "shaders": report.shaders,
        "seconds": seconds,
        "numbers": comparison.numbers,
        "equal": comparison.equal,
        "largest_share_of_bound": comparison.share,
        "coverage": coverage,
        "mismatches": mismatches,
    })
}

/// In how many shaders of a version what occurred, by groups; 0 for what none had.
fn coverage(coverage: &Coverage, version: Version) -> Value {
    let possible = Coverage::possible(version);
    let groups = Group::ALL.into_iter().map(|group| {
        let of_group = possible.iter().filter(|(g, _)| *g == group);
        let counts: serde_json::Map<_, _> = of_group
            .map(|(_, name)| (name.clone(), json!(coverage.of(version, group, name))))
            .collect();
        (group.name().to_owned(), Value::Object(counts))
    });
    Value::Object(groups.collect())
}

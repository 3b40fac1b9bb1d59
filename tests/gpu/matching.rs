//! Generated shaders: what `texcrd fuzz-match` does, in small, and that it would find what is wrong.

use texcrd::generate::{Precision, Textures, Weights};
use texcrd::gpu::Device;
use texcrd::isa::Version;
use texcrd::matching::{self, Change, Mismatch, Plan, Report};
use texcrd::policy::{Model, Policies};

fn plan(count: u64, versions: Vec<Version>) -> Plan {
    Plan {
        count,
        seed: 20_020_501,
        versions,
        // What WGSL and Vulkan promise, derived in docs/matching.md.
        precision: Precision::default(),
        model: Model::default(),
        policies: Policies::default(),
        weights: Weights::default(),
    }
}

fn run(devices: &[Device], plan: &Plan, change: Option<Change<'_>>) -> Report {
    match matching::run(devices, plan, change, &|_| ()) {
        Ok(report) => report,
        Err(error) => panic!("{error}"),
    }
}

fn listing(mismatch: &Mismatch) -> &str {
    &mismatch.subject.generated.listing
}

#[test]
fn generated_shaders_match() {
    let Some(device) = crate::device() else {
        return;
    };
    let mut devices = vec![device];
    if devices[0].adapter().kind == "software" {
        // It compiles on the thread that draws.
        devices.extend(crate::device());
    }
    let plan = plan(2100, Version::all().collect());
    let report = run(&devices, &plan, None);
    let textures = Textures::new().expect("textures of sizes that fit");
    for mismatch in &report.mismatches {
        println!("{}", matching::case_text(mismatch, &textures));
    }
    assert_eq!(report.mismatches.len(), 0);
    assert_eq!(report.shaders, 2100);
    let comparison = &report.comparison;
    println!(
        "{} numbers, {} equal, at most {:.2} of a bound",
        comparison.numbers, comparison.equal, comparison.share
    );
    // Four invocations of `r0` or `oPos` at least, but for what texkill takes out.
    assert!(comparison.numbers > 16 * 2100, "{comparison:?}");
    for version in Version::all() {
        // 300 shaders of a version hold every instruction, and everything else that is not rare.
        let missing = report.coverage.missing(version);
        let rare = |group| group == matching::Group::Masks;
        let missing: Vec<_> = missing.iter().filter(|(group, _)| !rare(*group)).collect();
        assert!(missing.is_empty(), "{version}: {missing:?}");
    }
}

/// Runs shaders of a version with another listing on the GPU: the paths must part, and what is left of one of the shaders
/// must still hold what was changed and hardly anything else.
fn is_found(version: Version, changed: &str, instead: &str, most: usize) {
    let Some(device) = crate::device() else {
        return;
    };
    let devices = [device];
    let change = |listing: &str| listing.replace(changed, instead);
    let report = run(&devices, &plan(32, vec![version]), Some(&change));
    assert!(report.mismatches.len() > 1, "{changed}");
    let innocent = (report.mismatches.iter()).find(|m| !listing(m).contains(changed));
    assert!(innocent.is_none(), "{innocent:?}");
    let small = matching::shrink(&devices[0], &report.mismatches[0], Some(&change));
    let small = small.unwrap_or_else(|error| panic!("{error}"));
    println!("{}", listing(&small));
    assert!(!small.differences.is_empty());
    assert!(listing(&small).contains(changed), "{}", listing(&small));
    let count = small.subject.generated.program.instructions().count();
    assert!(count <= most, "{}", listing(&small));
}

#[test]
fn another_instruction_is_found() {
    // What is needed beside it: the rest of r0.
    is_found(Version::Ps11, "mul ", "add ", 2);
}

#[test]
fn another_modifier_is_found() {
    // Constants take no modifiers: something has to be loaded first, and what is loaded fills three components.
    is_found(Version::Ps14, "_bias", "_bx2", 3);
}

#[test]
fn another_component_is_found() {
    is_found(Version::Vs11, "dp3 ", "dp4 ", 2);
}

#[test]
fn another_texture_instruction_is_found() {
    // What is loaded, and what takes it to r0.
    is_found(Version::Ps12, "texcoord ", "tex ", 2);
}

#[test]
fn a_pixel_that_is_not_discarded_is_found() {
    is_found(Version::Ps13, "texkill", "tex", 2);
}

/// The command, from outside: everything that a program may want to read, and one shader again by its seed.
#[test]
fn the_command_tells_what_was_compared() {
    if crate::device().is_none() {
        return;
    }
    let run = |arguments: &[&str]| {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_texcrd"));
        let ran = command.arg("fuzz-match").args(arguments).output();
        let ran = ran.expect("the program starts");
        let out = String::from_utf8(ran.stdout).expect("results are UTF-8");
        (ran.status.code(), out)
    };
    let (status, out) = run(&["--count", "14", "--seed", "5", "--format", "json"]);
    assert_eq!(status, Some(0), "{out}");
    let told: serde_json::Value = serde_json::from_str(&out).expect("one JSON object");
    assert_eq!((&told["shaders"], &told["seed"]), (&14.into(), &5.into()));
    assert_eq!(told["mismatches"], serde_json::json!([]));
    assert!(told["numbers"].as_u64() > Some(100), "{out}");
    for version in Version::all() {
        // Two shaders of each version; every pixel shader writes r0.
        let registers = &told["coverage"][version.name()]["registers"];
        let always = match version.kind() {
            texcrd::isa::ShaderKind::Vertex => "oPos",
            texcrd::isa::ShaderKind::Pixel => "r0",
        };
        assert_eq!(registers[always], 2, "{registers}");
    }
    let (status, out) = run(&["--version", "ps.1.4", "--seed", "77"]);
    assert_eq!(status, Some(0), "{out}");
    assert!(out.starts_with("1 shader,"), "{out}");
    assert!(out.ends_with("no mismatch\n"), "{out}");
    assert_eq!(run(&["--version", "ps.2.0"]).0, Some(2));
}

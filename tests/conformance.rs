//! The suite of shader unit tests in `tests/conformance`: all of it passes, and it leaves no instruction out.
#![cfg(feature = "scene")]
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may panic")]

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use texcrd::case::{Case, Verdict};
use texcrd::isa::{Opcode, Version};
use texcrd::scene::{DirectoryResolver, LoadOptions, Shader};

fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("the folder can be read") {
        let path = entry.expect("its entries too").path();
        if path.is_dir() {
            files(&path, found);
        } else if path.extension().is_some_and(|e| e == "toml" || e == "json") {
            found.push(path);
        }
    }
}

fn cases() -> Vec<(String, Case)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/conformance");
    let mut paths = Vec::new();
    files(&root, &mut paths);
    paths.sort();
    (paths.iter())
        .map(|path| {
            let name = path.strip_prefix(&root).unwrap().display().to_string();
            let bytes = fs::read(path).expect("a case can be read");
            let resolver = DirectoryResolver::new(path.parent().expect("it lies in a folder"));
            let case = Case::load(&name, &bytes, &resolver, &LoadOptions::default());
            (name, case.unwrap_or_else(|error| panic!("{error}")))
        })
        .collect()
}

#[test]
fn every_case_passes() {
    let mut failures = String::new();
    let cases = cases();
    assert!(cases.len() >= 150, "only {} cases", cases.len());
    for (path, case) in &cases {
        for (invocation, verdict) in case.invocations.iter().zip(case.check()) {
            // What other drivers gave is written down for other implementations; this one gives what is expected.
            if verdict != Verdict::Passed {
                let line = invocation.line;
                failures.push_str(&format!("{path}:{line}: {verdict:#?}\n"));
            }
        }
    }
    assert!(failures.is_empty(), "{failures}");
}

#[test]
fn every_instruction_of_every_version_is_in_two_cases_or_more() {
    let mut counts: BTreeMap<(Opcode, Version), usize> = Opcode::all()
        .flat_map(|opcode| {
            opcode
                .versions()
                .iter()
                .map(move |version| ((opcode, version), 0))
        })
        .collect();
    for (_, case) in cases() {
        for Shader { program, .. } in [&case.vertex, &case.pixel].into_iter().flatten() {
            let mut opcodes: Vec<Opcode> = program.instructions().map(|i| i.opcode).collect();
            opcodes.extend(program.definitions().map(|_| Opcode::Def));
            opcodes.extend(program.declarations().map(|_| Opcode::Dcl));
            opcodes.sort_unstable();
            opcodes.dedup();
            for opcode in opcodes {
                *counts.entry((opcode, program.version)).or_default() += 1;
            }
        }
    }
    let rare: Vec<String> = (counts.iter())
        .filter(|(_, count)| **count < 2)
        .map(|((opcode, version), count)| format!("{} in {version}: {count}", opcode.mnemonic()))
        .collect();
    assert!(rare.is_empty(), "too few cases of {rare:?}");
}

#[test]
fn names_are_told_apart() {
    let mut names: Vec<String> = cases().into_iter().map(|(_, case)| case.name).collect();
    names.sort_unstable();
    let twice: Vec<_> = names.windows(2).filter(|pair| pair[0] == pair[1]).collect();
    assert!(twice.is_empty(), "{twice:?}");
}

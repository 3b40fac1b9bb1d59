//! The suite of shader unit tests in `tests/conformance`: all of it passes, and it leaves nothing out.
#![cfg(feature = "scene")]
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may panic")]

use std::collections::BTreeMap;
use suite::cases;
use texcrd::case::Verdict;
use texcrd::diagnostic::SourceMap;
use texcrd::isa::{Opcode, Version};
use texcrd::scene::Shader;
use texcrd::{bytecode, syntax};

#[path = "conformance/coverage/mod.rs"]
mod coverage;
#[path = "conformance/suite.rs"]
mod suite;

#[test]
fn every_case_passes() {
    let mut failures = String::new();
    let cases = cases();
    assert!(cases.len() >= 1200, "only {} cases", cases.len());
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

/// Listing → tokens → listing → tokens: the second tokens are the first, the second listing prints as the first does.
#[test]
fn every_listing_comes_back_from_tokens() {
    let mut count = 0;
    for (path, case) in cases() {
        for shader in case.vertex.iter().chain(&case.pixel) {
            let words = bytecode::encode(&shader.program).unwrap();
            let decoded = bytecode::decode(&words);
            assert_eq!(decoded.diagnostics, [], "{path}");
            let listing = syntax::print(&decoded.program.unwrap());
            let mut sources = SourceMap::new();
            let parsed = syntax::parse(sources.add("listing", listing.as_str()).unwrap());
            let program = parsed.program.unwrap();
            assert_eq!(bytecode::encode(&program).unwrap(), words, "{path}");
            assert_eq!(syntax::print(&program), listing, "{path}");
            count += 1;
        }
    }
    assert!(count >= 1200, "only {count} shaders");
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

/// Values come from a rule, from a published figure, or from arithmetic, and the case says which. JSON has no comments.
#[test]
fn every_case_says_where_its_values_come_from() {
    let text = |path: &str| std::fs::read_to_string(suite::root().join(path)).unwrap();
    let says = |text: String| text.lines().any(|line| line.starts_with("# "));
    let silent: Vec<String> = (cases().into_iter())
        .map(|(path, _)| path)
        .filter(|path| path.ends_with(".toml") && !says(text(path)))
        .collect();
    assert!(silent.is_empty(), "{silent:#?}");
}

#[test]
fn names_are_told_apart() {
    let mut names: Vec<String> = cases().into_iter().map(|(_, case)| case.name).collect();
    names.sort_unstable();
    let twice: Vec<_> = names.windows(2).filter(|pair| pair[0] == pair[1]).collect();
    assert!(twice.is_empty(), "{twice:?}");
}

//! Mutated listings and token streams. `docs/fuzzing.md` says how to run more of them.
#![allow(unreachable_pub, reason = "the crate in `fuzz` shares these modules")]

mod judge;
mod mutate;
mod seeds;

use judge::Seen;
use seeds::Seeds;
use std::fmt::{Debug, Formatter};
use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};
use texcrd::bytecode;
use texcrd::generate::Random;

/// No input may take longer than this, unoptimised on a busy machine.
const LONGEST: Duration = Duration::from_secs(120);

/// What inputs a run has found that do not survive, by seed.
#[derive(Default)]
struct Findings(Vec<String>);

impl Findings {
    /// Judges what a seed gives; nothing if that is a finding.
    fn judge<T: Debug, R: Default>(&mut self, seed: u64, input: T, what: impl Fn(&T) -> R) -> R {
        let start = Instant::now();
        let result = catch_unwind(AssertUnwindSafe(|| what(&input)));
        let taken = start.elapsed();
        if result.is_err() || taken > LONGEST {
            let finding = format!("seed {seed} in {taken:?}: {input:?}");
            eprintln!("{finding}");
            self.0.push(finding);
        }
        result.unwrap_or_default()
    }

    #[track_caller]
    fn are_none(self) {
        let count = self.0.len();
        assert!(count == 0, "{count} findings:\n{}", self.0.join("\n"));
    }
}

/// A text that is readable in a message.
struct Listing(Vec<u8>);

impl Debug for Listing {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        Debug::fmt(&String::from_utf8_lossy(&self.0), f)
    }
}

#[track_caller]
fn listings(seeds: Range<u64>) -> Seen {
    let (known, mut findings) = (Seeds::default(), Findings::default());
    let mut seen = Seen::default();
    for seed in seeds {
        let text = Listing(mutate::text(&mut Random::new(seed), &known));
        seen.add(findings.judge(seed, text, |text| judge::file(&text.0)));
    }
    findings.are_none();
    seen
}

/// How many of the streams are valid.
#[track_caller]
fn streams(seeds: Range<u64>) -> usize {
    let (known, mut findings) = (Seeds::default(), Findings::default());
    let mut valid = 0;
    for seed in seeds {
        let words = mutate::stream(&mut Random::new(seed), &known);
        valid += usize::from(findings.judge(seed, words, |words| judge::words(words)));
    }
    findings.are_none();
    valid
}

/// What is mutated is as good as it is said to be: without that, mutants would all be refused at their first line.
#[test]
fn seeds_are_accepted() {
    let known = Seeds::default();
    let refused: Vec<_> = (known.texts.iter())
        .filter(|text| judge::file(text).accepted == 0)
        .map(|text| String::from_utf8_lossy(text))
        .collect();
    // A scanner's errors, and a vertex declaration as macros and in digits, which is no shader.
    assert_eq!(refused.len(), 3, "{refused:#?}");
    let valid = known.streams.iter().filter(|words| judge::words(words));
    assert_eq!(valid.count(), known.streams.len() - 1);
}

#[test]
fn mutated_listings() {
    let seen = listings(0..150);
    assert!(
        seen.accepted > 30 && seen.accepted < seen.shaders,
        "{seen:?}"
    );
}

#[test]
fn mutated_streams() {
    let valid = streams(0..1500);
    assert!((100..1400).contains(&valid), "{valid}");
}

/// Streams in the forms in which files have them.
#[test]
fn mutated_streams_in_files() {
    let (known, mut findings) = (Seeds::default(), Findings::default());
    for seed in 0..60 {
        let words = mutate::stream(&mut Random::new(seed), &known);
        let (bytes, text) = (bytecode::to_bytes(&words), bytecode::to_hex(&words));
        findings.judge(seed, bytes, |bytes| judge::file(bytes));
        findings.judge(seed, text, |text| judge::file(text.as_bytes()));
    }
    findings.are_none();
}

/// How many inputs the long runs take, from the environment.
fn count(name: &str, usual: u64) -> Range<u64> {
    let given = std::env::var(name).ok().and_then(|text| text.parse().ok());
    0..given.unwrap_or(usual)
}

#[test]
#[ignore = "a long run, for an optimised build"]
fn many_mutated_listings() {
    let seeds = count("TEXCRD_LISTINGS", 100_000);
    let (start, count) = (Instant::now(), seeds.end);
    let seen = listings(seeds);
    eprintln!("{count} listings in {:?}: {seen:?}", start.elapsed());
}

#[test]
#[ignore = "a long run, for an optimised build"]
fn many_mutated_streams() {
    let seeds = count("TEXCRD_STREAMS", 1_000_000);
    let (start, count) = (Instant::now(), seeds.end);
    let valid = streams(seeds);
    eprintln!("{count} streams in {:?}: {valid} valid", start.elapsed());
}

//! Mutated listings and token streams. `docs/fuzzing.md` says how to run more of them.
#![allow(unreachable_pub, reason = "the crate in `fuzz` shares these modules")]

mod judge;
mod mutate;
mod seeds;

use judge::Seen;
use seeds::Seeds;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};
use texcrd::bytecode;
use texcrd::generate::Random;

/// No input may take longer than this, unoptimised on a busy machine.
const LONGEST: Duration = Duration::from_secs(20);

/// Judges what a seed gives; a finding names the seed.
#[track_caller]
fn judged<T, R>(seed: u64, input: T, what: impl Fn(&T) -> R) -> R
where
    T: std::fmt::Debug,
{
    let start = Instant::now();
    let Ok(result) = catch_unwind(AssertUnwindSafe(|| what(&input))) else {
        panic!("seed {seed}: {input:?}");
    };
    let taken = start.elapsed();
    assert!(taken < LONGEST, "seed {seed} took {taken:?}: {input:?}");
    result
}

fn listings(seeds: std::ops::Range<u64>) -> Seen {
    let known = Seeds::new();
    let mut seen = Seen::default();
    for seed in seeds {
        let text = mutate::text(&mut Random::new(seed), &known);
        seen.add(judged(seed, text, |text| judge::file(text)));
    }
    seen
}

/// How many of the streams are valid.
fn streams(seeds: std::ops::Range<u64>) -> usize {
    let known = Seeds::new();
    let mut valid = 0;
    for seed in seeds {
        let words = mutate::stream(&mut Random::new(seed), &known);
        valid += usize::from(judged(seed, words, |words| judge::words(words)));
    }
    valid
}

/// What is mutated is as good as it is said to be: without that, mutants would all be refused at their first line.
#[test]
fn seeds_are_accepted() {
    let known = Seeds::new();
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
        seen.accepted > 50 && seen.accepted < seen.shaders,
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
    let known = Seeds::new();
    for seed in 0..60 {
        let words = mutate::stream(&mut Random::new(seed), &known);
        judged(seed, bytecode::to_bytes(&words), |bytes| judge::file(bytes));
        judged(seed, bytecode::to_hex(&words), |text| {
            judge::file(text.as_bytes())
        });
    }
}

/// How many inputs the long runs take, from the environment.
fn count(name: &str, usual: u64) -> std::ops::Range<u64> {
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

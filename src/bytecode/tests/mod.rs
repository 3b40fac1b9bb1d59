//! Tests of tokens, by subject.

mod broken;
mod constructs;
mod declarations;
mod examples;
mod inputs;
mod listings;
mod trips;

use super::*;
use crate::diagnostic::{Diagnostic, SourceMap};
use crate::program::Program;
use crate::syntax;

/// Reads a listing in which nothing is wrong with the text.
#[track_caller]
fn program(listing: &str) -> Program {
    let mut sources = SourceMap::new();
    let parsed = syntax::parse(sources.add("listing", listing).unwrap());
    assert_eq!(parsed.diagnostics, [], "{listing}");
    parsed.program.unwrap()
}

/// The tokens of a listing.
#[track_caller]
fn assembled(listing: &str) -> Vec<u32> {
    encode(&program(listing)).unwrap()
}

/// The listing of tokens of which nothing is to be said.
#[track_caller]
fn listed(words: &[u32]) -> String {
    let decoded = decode(words);
    assert_eq!(decoded.diagnostics, [], "{words:08X?}");
    assert_eq!(decoded.length, words.len());
    syntax::print(&decoded.program.unwrap())
}

/// Tokens of text with a comment behind `;` in each line: what stands in the tables of the specification.
#[track_caller]
fn words(text: &str) -> Vec<u32> {
    let lines = text.lines().map(|line| line.split(';').next().unwrap());
    let digits = lines.flat_map(str::split_whitespace);
    digits
        .map(|word| u32::from_str_radix(word, 16).unwrap())
        .collect()
}

/// Rule, first token and message of each diagnostic.
fn told(diagnostics: &[Diagnostic]) -> Vec<(&'static str, u32, &str)> {
    let one = |d: &Diagnostic| (d.rule.id, d.span.start);
    let lines = diagnostics.iter().map(|d| (one(d), d.message.as_str()));
    lines
        .map(|((rule, at), message)| (rule, at, message))
        .collect()
}

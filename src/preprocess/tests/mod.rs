//! Tests of the preprocessor, by subject. Expected texts are worked out by hand from the rules of C and of syntax.md, section 7.

mod bounds;
mod directives;
mod macros;
mod places;

use super::{Options, Preprocessed, preprocess};
use crate::diagnostic::{Diagnostic, SourceMap};
use std::collections::BTreeMap;

/// Preprocesses a text that is the second of its map, with files that it may include.
fn run(text: &str, files: &[(&str, &str)], definitions: &[&str]) -> (SourceMap, Preprocessed) {
    let mut sources = SourceMap::new();
    sources.add("before", "ps.1.4\n").unwrap();
    let file = sources.add("listing", text).unwrap().span();
    let files: BTreeMap<String, Vec<u8>> = files
        .iter()
        .map(|(name, text)| (name.to_string(), text.as_bytes().to_vec()))
        .collect();
    let definitions: Vec<_> = definitions.iter().map(|d| d.parse().unwrap()).collect();
    let options = Options {
        definitions: &definitions,
        resolver: &files,
    };
    let done = preprocess(&mut sources, file, &options);
    (sources, done)
}

/// What comes out of a text that has nothing to report, blank lines left out.
#[track_caller]
fn out(text: &str) -> String {
    out_of(text, &[], &[])
}

#[track_caller]
fn out_of(text: &str, files: &[(&str, &str)], definitions: &[&str]) -> String {
    let (sources, done) = run(text, files, definitions);
    assert_eq!(done.diagnostics, []);
    lines(&sources.text(done.text.unwrap()))
}

fn lines(text: &str) -> String {
    let lines = text.lines().map(str::trim_end).filter(|l| !l.is_empty());
    lines.map(|l| format!("{l}\n")).collect()
}

/// `file:line:column rule message` of each diagnostic.
fn told(text: &str, files: &[(&str, &str)]) -> Vec<String> {
    let (sources, done) = run(text, files, &[]);
    let one = |d: &Diagnostic| {
        let at = sources.locate(d.span).unwrap();
        format!(
            "{}:{}:{} {} {}",
            at.file, at.line, at.column, d.rule.id, d.message
        )
    };
    done.diagnostics.iter().map(one).collect()
}

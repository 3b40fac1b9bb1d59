//! Tests of reading, repairing and printing listings, by subject.

mod damage;
mod grammar;
mod layout;
mod robust;
mod round_trip;
mod scans;
mod tokens;
mod unsure;
mod unusual;

use super::{Parsed, apply_fixes, parse};
use crate::diagnostic::{Diagnostic, SourceMap};
use crate::program::{Instruction, Program};

/// Reads a text that is the second of its map, so that spans do not begin at 0.
fn read(text: impl AsRef<[u8]>) -> (SourceMap, Parsed) {
    let mut map = SourceMap::new();
    map.add("before", "ps.1.4\n").unwrap();
    let parsed = parse(map.add("listing", text.as_ref()).unwrap());
    (map, parsed)
}

fn diagnostics(text: impl AsRef<[u8]>) -> Vec<Diagnostic> {
    read(text).1.diagnostics
}

/// Rule and text of each diagnostic.
fn found(text: impl AsRef<[u8]>) -> Vec<(&'static str, String)> {
    let (map, parsed) = read(text);
    let one = |d: &Diagnostic| (d.rule.id, map.text(d.span).into_owned());
    parsed.diagnostics.iter().map(one).collect()
}

/// Reads a text that has nothing to report.
fn accepted(text: impl AsRef<[u8]>) -> Program {
    let parsed = read(text).1;
    assert_eq!(parsed.diagnostics, [], "a text that should be accepted");
    parsed.program.unwrap()
}

/// The only instruction of a text that has nothing to report.
fn only(text: &str) -> Instruction {
    let program = accepted(text);
    let mut instructions = program.instructions();
    let first = instructions.next().unwrap().clone();
    assert!(instructions.next().is_none());
    first
}

/// The text after one round of certain repairs, with their number.
fn repaired(text: impl AsRef<[u8]>) -> (String, usize) {
    let (map, parsed) = read(text);
    let (bytes, count) = apply_fixes(&map, &map.files()[1], &parsed.diagnostics);
    (String::from_utf8(bytes).unwrap(), count)
}

/// The message of each diagnostic with place, help and repair, a line each.
fn told(text: impl AsRef<[u8]>) -> String {
    let (map, parsed) = read(text);
    let one = |d: &Diagnostic| {
        let at = map.locate(d.span).unwrap();
        let help = d
            .help
            .as_deref()
            .map_or(String::new(), |h| format!(" ({h})"));
        let fix = d.fix.as_ref().map_or(String::new(), |f| {
            let sure = if f.certain { "!" } else { "?" };
            format!(" [{:?} -> {:?}{sure}]", map.text(f.span), f.replacement)
        });
        format!(
            "{}:{} {} {}{help}{fix}\n",
            at.line, at.column, d.rule.id, d.message
        )
    };
    parsed.diagnostics.iter().map(one).collect()
}

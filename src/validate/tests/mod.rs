//! The rules on listings that break them and on listings that just do not.

mod cases;
mod dialects;
mod listings;
mod natural;
mod room;

use crate::diagnostic::{Diagnostic, SourceMap};
use crate::listing;
use crate::policy::Dialect;
use crate::program::Program;
use crate::rules::Example;

/// The program of a listing that can be read.
pub(in crate::validate) fn program(text: &str) -> Program {
    let mut map = SourceMap::new();
    let parsed = crate::syntax::parse(map.add("listing", text).unwrap());
    let said: Vec<&str> = parsed
        .diagnostics
        .iter()
        .map(|d| d.message.as_str())
        .collect();
    parsed
        .program
        .filter(|_| said.is_empty())
        .unwrap_or_else(|| panic!("{text}\n{said:?}"))
}

/// A listing in one line, as the rule list has its examples.
struct Marked(Example);

impl Marked {
    fn new(line: &str) -> Self {
        Self(Example::new(line))
    }

    /// What is said of it but for S11 and P23: its inputs are declared beside it, as they were for Direct3D 8, and what it
    /// loads it need not use.
    fn judge(&self, dialect: Dialect) -> Vec<Diagnostic> {
        let mut map = SourceMap::new();
        let file = map.add("listing", self.0.text.as_str()).unwrap();
        let mut found = listing::check(file, dialect).diagnostics;
        found.retain(|d| !["S11", "P23"].contains(&d.rule.id));
        found
    }
}

/// The identifiers of what is said of a listing in one line.
fn ids(line: &str, dialect: Dialect) -> Vec<&'static str> {
    let found = Marked::new(line).judge(dialect);
    found.iter().map(|d| d.rule.id).collect()
}

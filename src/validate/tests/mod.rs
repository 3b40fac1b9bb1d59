//! The rules on listings that break them and on listings that just do not.

mod cases;
mod dialects;
mod listings;

use crate::diagnostic::{Diagnostic, SourceMap, Span};
use crate::policy::Dialect;
use crate::program::Program;
use crate::validate::validate;

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

/// A listing in one line: `|` ends a line, `*3` behind a line repeats it, braces mark what is to be complained of.
struct Marked {
    text: String,
    marks: Vec<Span>,
}

impl Marked {
    fn new(line: &str) -> Self {
        let mut marked = Marked {
            text: String::new(),
            marks: Vec::new(),
        };
        for part in line.split('|') {
            let (part, times) = match part.rsplit_once('*') {
                Some((part, times)) => (part, times.trim().parse().unwrap()),
                None => (part, 1),
            };
            for _ in 0..times {
                marked.push(part.trim());
            }
        }
        marked
    }

    fn push(&mut self, part: &str) {
        let mut start = 0;
        for letter in part.chars() {
            let here = self.text.len() as u32;
            match letter {
                '{' => start = here,
                '}' => self.marks.push(Span::new(start, here)),
                other => self.text.push(other),
            }
        }
        self.text.push('\n');
    }

    fn judge(&self, dialect: Dialect) -> Vec<Diagnostic> {
        validate(&program(&self.text), dialect)
    }
}

/// The identifiers of what is said of a listing in one line.
fn ids(line: &str, dialect: Dialect) -> Vec<&'static str> {
    let found = Marked::new(line).judge(dialect);
    found.iter().map(|d| d.rule.id).collect()
}

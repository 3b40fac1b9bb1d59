//! Collecting diagnostics in bounded number.

use super::rules;
use crate::diagnostic::{Diagnostic, Rule, Span};

/// How many diagnostics a text gets before the rest is left out.
pub(super) const MOST: usize = 100;

/// The diagnostics of one text.
#[derive(Default)]
pub(super) struct Reports {
    list: Vec<Diagnostic>,
    more: Option<Span>,
}

impl Reports {
    /// Adds one, unless there are enough. Returns its number, to add to its help later.
    pub(super) fn push(&mut self, diagnostic: Diagnostic) -> Option<usize> {
        if self.full() {
            self.more.get_or_insert(diagnostic.span);
            return None;
        }
        self.list.push(diagnostic);
        Some(self.list.len() - 1)
    }

    /// Whether no more are taken.
    pub(super) fn full(&self) -> bool {
        self.list.len() >= MOST
    }

    /// Where the first breach of a rule is.
    pub(super) fn first(&self, rule: &'static Rule) -> Option<Span> {
        let of = |d: &&Diagnostic| std::ptr::eq(d.rule, rule);
        self.list.iter().find(of).map(|d| d.span)
    }

    /// Adds a sentence to the help of diagnostic `at`.
    pub(super) fn add_help(&mut self, at: usize, sentence: &str) {
        if let Some(diagnostic) = self.list.get_mut(at) {
            diagnostic.help = Some(match diagnostic.help.take() {
                Some(help) => format!("{help}; {sentence}"),
                None => sentence.to_string(),
            });
        }
    }

    /// All in the order of the text; if there were too many, the last one says so. `rest` is where reading stopped.
    pub(super) fn finish(self, rest: Option<Span>) -> Vec<Diagnostic> {
        let full = self.full();
        let mut list = self.list;
        list.sort_by_key(|d| d.span.start);
        if let Some(span) = self.more.or(rest.filter(|_| full)) {
            let message = format!("further errors are not shown: there are more than {MOST}");
            list.push(Diagnostic::error(&rules::TOO_MANY, span, message));
        }
        list
    }
}

/// Text for a message: in backquotes, shortened, control characters and unreadable bytes replaced.
pub(super) fn quote(bytes: &[u8]) -> String {
    const LONGEST: usize = 40;
    let mut end = bytes.len().min(LONGEST);
    // Not in the middle of a character of UTF-8.
    while end > 0 && end < bytes.len() && bytes[end] & 0xC0 == 0x80 {
        end -= 1;
    }
    let text: String = String::from_utf8_lossy(&bytes[..end])
        .chars()
        .map(|c| if c.is_control() { '\u{FFFD}' } else { c })
        .collect();
    let dots = if end < bytes.len() { "…" } else { "" };
    format!("`{text}{dots}`")
}

/// Names as a list in backquotes.
pub(super) fn names<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    let quoted: Vec<String> = names.into_iter().map(|n| format!("`{n}`")).collect();
    quoted.join(", ")
}

/// Names of which one is meant.
pub(super) fn alternatives(names: &[String]) -> String {
    let quoted: Vec<String> = names.iter().map(|n| format!("`{n}`")).collect();
    quoted.join(" or ")
}

/// `1 operand`, `2 operands`.
pub(super) fn counted(count: usize, what: &str) -> String {
    let s = if count == 1 { "" } else { "s" };
    format!("{count} {what}{s}")
}

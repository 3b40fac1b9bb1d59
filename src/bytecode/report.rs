//! What is said of one stream.

use super::rules;
use crate::diagnostic::{Diagnostic, Rule, Severity, Span};

/// How many diagnostics a stream gets before the rest is left out.
pub(super) const MOST: usize = 100;

/// The diagnostics of one stream; their spans count tokens.
#[derive(Default)]
pub(super) struct Reports {
    list: Vec<Diagnostic>,
}

impl Reports {
    /// Whether no more are taken.
    pub(super) fn full(&self) -> bool {
        self.list.len() > MOST
    }

    /// Says something of token `at`; `help` may be empty.
    pub(super) fn tell(
        &mut self,
        severity: Severity,
        rule: &'static Rule,
        at: usize,
        message: &str,
        help: &str,
    ) {
        if self.full() {
            return;
        }
        let span = tokens(at, at + 1);
        if self.list.len() == MOST {
            let message = format!("further errors are not shown: there are more than {MOST}");
            self.list
                .push(Diagnostic::error(&rules::MANY, span, message));
            return;
        }
        let message = format!("token {at} (byte {}): {message}", at as u64 * 4);
        let report = Diagnostic::new(severity, rule, span, message);
        self.list.push(match help {
            "" => report,
            _ => report.with_help(help),
        });
    }

    pub(super) fn error(&mut self, rule: &'static Rule, at: usize, message: &str, help: &str) {
        self.tell(Severity::Error, rule, at, message, help);
    }

    pub(super) fn warning(&mut self, rule: &'static Rule, at: usize, message: &str, help: &str) {
        self.tell(Severity::Warning, rule, at, message, help);
    }

    pub(super) fn finish(self) -> Vec<Diagnostic> {
        self.list
    }
}

/// The span of tokens `from` to before `to`.
pub(super) fn tokens(from: usize, to: usize) -> Span {
    Span::new(from as u32, to as u32)
}

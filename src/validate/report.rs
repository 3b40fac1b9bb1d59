//! What was found in one program.

use crate::diagnostic::{Diagnostic, Severity, Span};
use crate::policy::Dialect;
use crate::program::Register;
use crate::rules::model::Code;
use std::collections::HashSet;

/// How many breaches of a rule are told of one program.
const MOST_OF_A_RULE: u32 = 100;

/// What was found so far.
pub(super) struct Report {
    dialect: Dialect,
    found: Vec<(Code, Diagnostic)>,
    /// Registers of which it was said that the version does not have them.
    missing: HashSet<Register>,
    counts: [u32; Code::COUNT],
}

impl Report {
    pub(super) fn new(dialect: Dialect) -> Self {
        Self {
            dialect,
            found: Vec::new(),
            missing: HashSet::new(),
            counts: [0; Code::COUNT],
        }
    }

    /// Whether the dialect has a rule.
    pub(super) fn has(&self, code: Code) -> bool {
        code.severity(self.dialect).is_some()
    }

    /// Adds a breach, as severe as the dialect has it.
    pub(super) fn breach(
        &mut self,
        code: Code,
        span: Span,
        message: impl Into<String>,
        help: impl Into<String>,
    ) {
        let Some(severity) = code.severity(self.dialect) else {
            return;
        };
        let count = &mut self.counts[code.of() as usize];
        *count = count.saturating_add(1);
        if *count > MOST_OF_A_RULE {
            return;
        }
        let mut help = help.into();
        let was_let_pass = code.severity(Dialect::D3d8) != Some(Severity::Error);
        if self.dialect == Dialect::D3d9 && severity == Severity::Error && was_let_pass {
            // The note says why what Direct3D 8 let pass is an error.
            help = format!("{help} ({})", code.note().trim_end_matches('.'));
        }
        let found = Diagnostic::new(severity, code.rule(), span, message);
        self.found.push((code, found.with_help(help)));
    }

    /// Whether this is the first time that a register is missed; it is told once, however often it is named.
    pub(super) fn misses(&mut self, register: Register) -> bool {
        self.missing.insert(register)
    }

    /// Everything that was found, by position, without what only follows from something else.
    pub(super) fn finish(self) -> Vec<Diagnostic> {
        let unwritten = |code: Code| matches!(code, Code::I1 | Code::I1Vertex | Code::I4);
        // An operand that cannot stand where it does need not have been written.
        let misplaced =
            |code: Code| !unwritten(code) && code.severity(Dialect::D3d8) == Some(Severity::Error);
        let places = self.found.iter().filter(|(code, _)| misplaced(*code));
        let places: HashSet<Span> = places.map(|(_, d)| d.span).collect();
        // What is refused may be what should have written the rest of r0.
        let refused = self
            .found
            .iter()
            .any(|(_, d)| d.severity == Severity::Error);
        let follows = |code: Code, span: Span| {
            unwritten(code) && places.contains(&span) || code == Code::S6Component && refused
        };
        let kept = self
            .found
            .into_iter()
            .filter(|(code, d)| !follows(*code, d.span));
        let mut diagnostics: Vec<Diagnostic> = kept.map(|(_, diagnostic)| diagnostic).collect();
        diagnostics.sort_by_key(|d| (d.span, d.rule.id));
        diagnostics
    }
}

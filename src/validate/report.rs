//! What was found in one program.

use crate::diagnostic::{Diagnostic, Severity, Span};
use crate::policy::Dialect;
use crate::rules::model::Code;

/// Why a breach that Direct3D 8 let pass is an error.
const ONLY_LATER: &str = "Direct3D 8 accepted it; Direct3D 9 refuses it";

/// How many breaches of a rule are told of one program.
const MOST_OF_A_RULE: u32 = 100;

/// What was found so far.
pub(super) struct Report {
    dialect: Dialect,
    diagnostics: Vec<Diagnostic>,
    counts: [u32; Code::COUNT],
}

impl Report {
    pub(super) fn new(dialect: Dialect) -> Self {
        Self {
            dialect,
            diagnostics: Vec::new(),
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
            help = format!("{help} ({ONLY_LATER})");
        }
        let found = Diagnostic::new(severity, code.rule(), span, message);
        self.diagnostics.push(found.with_help(help));
    }

    /// Everything that was found, by position.
    pub(super) fn finish(mut self) -> Vec<Diagnostic> {
        self.diagnostics.sort_by_key(|d| (d.span, d.rule.id));
        self.diagnostics
    }
}

//! A listing on its way through parser and validator.

use crate::diagnostic::{Diagnostic, SourceFile, any_error};
use crate::policy::Dialect;
use crate::program::Program;
use crate::{syntax, validate};

/// What became of a listing.
#[derive(Clone, Debug, PartialEq)]
pub struct Checked {
    /// The shader, as far as it could be read.
    pub program: Option<Program>,
    /// Everything that is wrong with it, by position.
    pub diagnostics: Vec<Diagnostic>,
}

impl Checked {
    /// The shader, if nothing refuses it.
    pub fn accepted(&self) -> Option<&Program> {
        if any_error(&self.diagnostics) {
            return None;
        }
        self.program.as_ref()
    }
}

/// Parses a listing and validates what could be read of it.
///
/// What follows only from lines that could not be read (a register that they seem to write is not written, say) is
/// not told again.
pub fn check(file: &SourceFile, dialect: Dialect) -> Checked {
    let options = syntax::Options {
        lenient: dialect == Dialect::Lenient,
        ..Default::default()
    };
    let parsed = syntax::parse_with(file, options);
    let mut diagnostics = parsed.diagnostics.clone();
    diagnostics.extend(syntax::unread(file, &parsed));
    if let Some(program) = &parsed.program {
        let unread: Vec<_> = (parsed.damaged.iter())
            .map(|damage| (damage.span, damage.destination))
            .collect();
        diagnostics.extend(validate::validate_around(program, dialect, &unread));
    }
    diagnostics.sort_by_key(|d| (d.span.start, d.span.end));
    Checked {
        program: parsed.program,
        diagnostics,
    }
}

//! A listing on its way through parser and validator.

use crate::diagnostic::{Diagnostic, Rule, SourceFile, any_error};
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

/// Whether a rule looks at what other instructions do: what they write, where they stand, what they are paired with.
fn judges_the_whole(rule: &Rule) -> bool {
    let about_order = ["I", "T", "C"].iter().any(|group| rule.id.starts_with(group));
    about_order || ["S6", "S7", "S8", "S9", "S10"].contains(&rule.id)
}

/// Parses a listing and validates what could be read of it.
///
/// Where lines were too damaged to be read, rules about the shader as a whole (what is never written, what comes
/// before what) are not judged: what the lost lines did is not known.
pub fn check(file: &SourceFile, dialect: Dialect) -> Checked {
    let parsed = syntax::parse(file);
    let mut diagnostics = parsed.diagnostics;
    if let Some(program) = &parsed.program {
        let whole = parsed.damaged.is_empty();
        let found = validate::validate(program, dialect);
        diagnostics.extend(found.into_iter().filter(|d| whole || !judges_the_whole(d.rule)));
    }
    diagnostics.sort_by_key(|d| (d.span.start, d.span.end));
    Checked {
        program: parsed.program,
        diagnostics,
    }
}

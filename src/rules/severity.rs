//! How severe breaches are: what there is to choose from.

use crate::diagnostic::Severity;
use crate::policy::Dialect;

/// Severity in each dialect, in the order of [`Dialect`]; `None`: nothing is said.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Severities([Option<Severity>; 3]);

impl Severities {
    pub(super) fn of(self, dialect: Dialect) -> Option<Severity> {
        self.0[dialect as usize]
    }
}

const E: Option<Severity> = Some(Severity::Error);
const W: Option<Severity> = Some(Severity::Warning);

/// Has no meaning that could be run.
pub(super) const REFUSED: Severities = Severities([E, E, E]);
/// Both runtimes refuse it; what it would do is clear all the same.
pub(super) const MEANT: Severities = Severities([E, E, W]);
/// Direct3D 8 took it against its own documents; Direct3D 9 refuses it.
pub(super) const LATER: Severities = Severities([W, E, W]);
/// Against the documents; no runtime is known to refuse it.
pub(super) const ADVICE: Severities = Severities([W, W, W]);
/// Only Direct3D 9 has the rule.
pub(super) const STRICT: Severities = Severities([None, E, None]);
/// Against the documents of Direct3D 9 alone; no runtime is known to refuse it.
pub(super) const STRICT_ADVICE: Severities = Severities([None, W, None]);
/// Another rule speaks, or nothing can break it.
pub(super) const SILENT: Severities = Severities([None, None, None]);

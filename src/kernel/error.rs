//! What cannot be lowered.

use crate::diagnostic::Span;
use std::fmt;

/// A shader has no meaning: it breaks a rule that even the lenient dialect cannot bend.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LowerError {
    /// The text that has no meaning.
    pub span: Span,
    /// Why.
    pub message: String,
}

impl LowerError {
    pub(super) fn new(span: Span, message: impl Into<String>) -> Self {
        Self {
            span,
            message: message.into(),
        }
    }
}

impl fmt::Display for LowerError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for LowerError {}

//! What texcrd has to say about a listing: rule, place, message and, where it can be known, the repair.
//!
//! This room knows nothing of shaders. A [`Rule`] is a row of the rule list ([`crate::rules`]) or of scene files;
//! a [`Diagnostic`] is one breach of it at one [`Span`]; a [`SourceMap`] turns spans into lines and columns,
//! also of texts that a preprocessor made of others.
//! The rules' identifiers are stable: they are printed, documented and never reused.

mod origin;
mod source;

pub use origin::{Derivation, Expansion, Note, Piece};
pub use source::{Location, SourceFile, SourceMap, Span, TooLarge};

/// A rule with its stable identifier.
///
/// Identifiers are those of the shader model's rule list (`B1` … `D5`), `P…` for text that is not a listing and
/// `K…` for tokens that are not a shader; scene files have their own.
#[derive(Debug, PartialEq, Eq)]
pub struct Rule {
    /// The stable identifier, such as `B3`.
    pub id: &'static str,
    /// The rule itself in one sentence, as a person would be told it.
    pub rule: &'static str,
}

/// How bad a breach is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// The listing runs; Direct3D's own documents would have it otherwise.
    Warning,
    /// The listing is refused.
    Error,
}

impl Severity {
    /// `error` or `warning`.
    pub fn name(self) -> &'static str {
        match self {
            Severity::Warning => "warning",
            Severity::Error => "error",
        }
    }
}

/// A replacement of text that repairs a breach.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fix {
    /// The text to replace; empty for an insertion.
    pub span: Span,
    /// What to write there.
    pub replacement: String,
    /// Whether nothing else can have been meant, so that it may be applied without asking.
    pub certain: bool,
}

/// One breach of a rule at one place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Whether the listing is refused for it.
    pub severity: Severity,
    /// The rule that is broken.
    pub rule: &'static Rule,
    /// The text that breaks it.
    pub span: Span,
    /// What is wrong, in the words of this listing.
    pub message: String,
    /// What to write instead, or why the rule exists.
    pub help: Option<String>,
    /// The repair, where there is one.
    pub fix: Option<Fix>,
}

impl Diagnostic {
    /// A breach that refuses the listing.
    pub fn error(rule: &'static Rule, span: Span, message: impl Into<String>) -> Self {
        Self::new(Severity::Error, rule, span, message)
    }

    /// A breach that is only told.
    pub fn warning(rule: &'static Rule, span: Span, message: impl Into<String>) -> Self {
        Self::new(Severity::Warning, rule, span, message)
    }

    /// A breach of the given severity.
    pub fn new(
        severity: Severity,
        rule: &'static Rule,
        span: Span,
        message: impl Into<String>,
    ) -> Self {
        Self {
            severity,
            rule,
            span,
            message: message.into(),
            help: None,
            fix: None,
        }
    }

    /// The same with a help text.
    #[must_use]
    pub fn with_help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// The same with a repair.
    #[must_use]
    pub fn with_fix(mut self, fix: Fix) -> Self {
        self.fix = Some(fix);
        self
    }
}

/// Whether any of these refuses the listing.
pub fn any_error(diagnostics: &[Diagnostic]) -> bool {
    diagnostics.iter().any(|d| d.severity == Severity::Error)
}

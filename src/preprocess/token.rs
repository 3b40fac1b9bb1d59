//! Words and signs on their way through the expansion of macros.

use super::scan::Kind as Lexical;
use super::scan::Lexeme;
use crate::diagnostic::{SourceMap, Span};
use std::borrow::Cow;

/// Bytes of a token with where they were written.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    pub(super) source: Span,
    /// The expansion that put them where they are.
    pub(super) expansion: Option<u32>,
}

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Name,
    Number,
    /// Blanks and comments that stay as they are written.
    Blank,
    /// White space that is one blank, whatever was written.
    Space,
    /// The end of a line.
    NewLine,
    /// A line end within a macro.
    Break,
    Text,
    Sign,
    /// Behind the last.
    End,
}

/// A word or sign.
#[derive(Clone, Debug)]
pub(super) struct Token {
    pub(super) kind: Kind,
    pub(super) part: Part,
    /// Further parts of a name that was put together.
    pub(super) more: Vec<Part>,
    /// Whether it is a name that is no macro here and stays none.
    pub(super) painted: bool,
    /// Whether it belongs to what stands before it without a blank.
    pub(super) glued: bool,
    /// Whether it is the first of a line of the text.
    pub(super) first: bool,
}

impl Token {
    pub(super) fn of(lexeme: Lexeme) -> Self {
        let kind = match lexeme.kind {
            Lexical::Name => Kind::Name,
            Lexical::Number => Kind::Number,
            Lexical::Blank => Kind::Blank,
            Lexical::NewLine => Kind::NewLine,
            Lexical::Splice => Kind::Break,
            Lexical::Text => Kind::Text,
            Lexical::Sign => Kind::Sign,
            Lexical::End => Kind::End,
        };
        Self {
            kind,
            part: Part {
                source: lexeme.span,
                expansion: None,
            },
            more: Vec::new(),
            painted: false,
            glued: false,
            first: lexeme.first,
        }
    }

    /// Whether it is white space of any kind.
    pub(super) fn is_space(&self) -> bool {
        matches!(
            self.kind,
            Kind::Blank | Kind::Space | Kind::NewLine | Kind::Break
        )
    }

    pub(super) fn span(&self) -> Span {
        self.part.source
    }

    pub(super) fn parts(&self) -> impl Iterator<Item = Part> {
        std::iter::once(self.part).chain(self.more.iter().copied())
    }

    pub(super) fn text<'a>(&self, sources: &'a SourceMap) -> Cow<'a, [u8]> {
        let first = sources.bytes(self.part.source);
        if self.more.is_empty() {
            return Cow::Borrowed(first);
        }
        let mut text = first.to_vec();
        for part in &self.more {
            text.extend_from_slice(sources.bytes(part.source));
        }
        Cow::Owned(text)
    }

    pub(super) fn is(&self, sources: &SourceMap, sign: &[u8]) -> bool {
        self.kind == Kind::Sign && sources.bytes(self.part.source) == sign
    }
}

/// Without the white space at either end.
pub(super) fn trimmed(mut tokens: &[Token]) -> &[Token] {
    while let [first, rest @ ..] = tokens
        && first.is_space()
    {
        tokens = rest;
    }
    while let [rest @ .., last] = tokens
        && last.is_space()
    {
        tokens = rest;
    }
    tokens
}

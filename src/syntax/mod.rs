//! Listings: reading them, saying what is wrong with them, repairing and printing them.
//!
//! The way of a text: `lexer` (bytes to tokens, `nom`), `prologue` (the version), `statement`, `list`, `operand`,
//! `index`, `meaning`, `declare` (instructions). What a word means is in `names`; what a scanner or a typist makes of one in
//! `confuse`; what can be said about operands without mnemonic in `lost`. Comments are dropped, but for those that `comment`
//! reads: they belong to the tokens of a shader. Line ends are white space to the grammar,
//! but they are where reading starts again after damage, so that one damaged place is one diagnostic.

mod comment;
mod confuse;
mod declare;
mod fix;
mod format;
mod guess;
mod index;
mod lexer;
mod list;
mod lost;
mod meaning;
mod names;
mod operand;
mod parser;
mod printer;
mod prologue;
mod report;
mod statement;
mod unread;

#[cfg(test)]
mod tests;

pub(crate) use confuse::distance;
pub use fix::apply_fixes;
pub use format::format;
pub(crate) use format::format_block;
pub(crate) use guess::{is_listing, is_source, later_model, no_shader};
pub(crate) use names::foreign_mnemonic;
pub use printer::{print, print_instruction};
pub(crate) use prologue::{begins_with_version, is_utf16, not_text};
pub use unread::unread;

use crate::diagnostic::{Diagnostic, SourceFile, Span, TooLarge};
use crate::isa::Version;
use crate::preprocess::scan::without_nul;
use crate::program::{Program, Register, Statement};
use crate::rules::text as rules;
use parser::Parser;
use report::Reports;
use std::borrow::Cow;

/// How a text is read.
#[derive(Clone, Copy, Debug, Default)]
pub struct Options {
    /// The version of a text that has no version instruction (fragments that a program joins before assembling them).
    pub version: Option<Version>,
    /// Whether what can be passed over without changing what the rest means, such as `_sat` on a source, is told as a
    /// warning instead of an error.
    pub lenient: bool,
    /// Whether names may have been defined that are not known, so that nothing is said of words that may be such names.
    pub names_missing: bool,
}

/// What was read from a text.
#[derive(Clone, Debug)]
pub struct Parsed {
    /// The shader without the statements that could not be read. `None` if its version is not known.
    pub program: Option<Program>,
    /// What is wrong with the text, in its order; at most 101.
    pub diagnostics: Vec<Diagnostic>,
    /// The statements that are not in `program`: what is said of the registers which they seem to write
    /// (uninitialised, never written) follows from the damage.
    pub damaged: Vec<Damage>,
}

/// A statement that could not be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Damage {
    /// Where it stands.
    pub span: Span,
    /// The register that it seems to write.
    pub destination: Option<Register>,
}

/// What is said of a text that is too long for a listing. It is not among the sources, so it has no place.
pub(crate) fn too_long(error: &TooLarge) -> Diagnostic {
    Diagnostic::error(&rules::NOT_A_LISTING, Span::default(), error.to_string())
}

/// Reads a listing that begins with its version.
///
/// Never fails: whatever cannot be read is a diagnostic, all of them at once. Time and memory are linear in the length
/// of the text.
pub fn parse(file: &SourceFile) -> Parsed {
    parse_with(file, Options::default())
}

/// Reads a listing.
pub fn parse_with(file: &SourceFile, options: Options) -> Parsed {
    let base = file.span().start;
    let bytes = file.bytes();
    let text = without_nul(bytes);
    let mut reports = Reports::default();
    if let Some((what, help)) = prologue::not_text(text) {
        let message = format!("this is no listing but {what}");
        let mut report = Diagnostic::error(&rules::NOT_A_LISTING, file.span().at_start(), message);
        if !help.is_empty() {
            report = report.with_help(help);
        }
        return Parsed {
            program: None,
            diagnostics: vec![report],
            damaged: Vec::new(),
        };
    }
    let lexed = lexer::lex(text, base, &mut reports);
    let words = ascii(text);
    // Whatever stands behind a comment without end is not read.
    let hidden = reports.first(&rules::COMMENT_OPEN);
    let hidden = hidden.map(|span| Damage {
        span,
        destination: None,
    });
    let mut parser = Parser {
        text,
        words: &words,
        base,
        tokens: lexed.tokens,
        end: lexed.end,
        at: 0,
        version: options.version.unwrap_or(Version::Vs11),
        names_missing: lexed.names_missing || options.names_missing,
        reports,
        statements: Vec::new(),
        damaged: hidden.into_iter().collect(),
        lost: Vec::new(),
        strays: Vec::new(),
        lenient: options.lenient,
    };
    let mut comments = lexed.comments;
    let heading = parser.heading(options.version);
    if let Some(heading) = &heading {
        parser.version = heading.version;
        parser.statements();
    }
    let rest = Some(parser.span(parser.peek())).filter(|_| parser.peek().kind != lexer::Kind::End);
    let program = heading.filter(|h| !h.guessed).map(|heading| Program {
        version: heading.version,
        version_span: heading.span,
        comments: {
            for comment in &mut comments {
                let before = |s: &Statement| s.span().start < comment.span.start;
                comment.before = parser.statements.partition_point(before);
            }
            comments
        },
        statements: parser.statements,
        span: file.span(),
    });
    Parsed {
        program,
        diagnostics: parser.reports.finish(rest),
        damaged: parser.damaged,
    }
}

/// The text with something else in the place of what is not ASCII, unless it is UTF-8: comments are in legacy code pages.
fn ascii(text: &[u8]) -> Cow<'_, str> {
    let byte = |b: &u8| if b.is_ascii() { char::from(*b) } else { '?' };
    match std::str::from_utf8(text) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => Cow::Owned(text.iter().map(byte).collect()),
    }
}

//! What a text is that may be a listing, a program or an effect, without reading it.

use super::lexer::{self, Kind, Token};
use super::names::{self, VersionText};
use super::report::Reports;
use super::rules;
use crate::diagnostic::{Diagnostic, Span};
use crate::isa::Opcode;

/// Whether a string of a program is a listing. Programs name versions in lists of profiles and in messages, too: what
/// stands behind the version in its line is an instruction or nothing.
pub(crate) fn is_listing(text: &[u8]) -> bool {
    let tokens = lexer::lex_some(text, 2, &mut Reports::default());
    match tokens[..] {
        [version, behind, ..] => behind.kind != Kind::End && heads_listing(version, behind, text),
        _ => false,
    }
}

/// Whether a text is an effect or a source of C and no listing: braces stand in it, and no line that can only be a version.
pub(crate) fn is_source(text: &[u8]) -> bool {
    let tokens = lexer::tokens(text);
    let mut braces = false;
    for (at, &token) in tokens.iter().enumerate() {
        let bytes = bytes_of(token, text);
        match (token.kind, tokens.get(at + 1)) {
            (Kind::Version, Some(&behind))
                if token.first
                    && names::version(bytes) != VersionText::Unknown
                    && heads_listing(token, behind, text) =>
            {
                return false;
            }
            (Kind::Junk, _) => braces |= bytes.contains(&b'{') || bytes.contains(&b'}'),
            _ => {}
        }
    }
    braces
}

/// Where the version of a later shader model stands with which a text begins; `None` if it begins otherwise.
pub(crate) fn later_model(text: &[u8]) -> Option<Span> {
    let tokens = lexer::lex_some(text, 1, &mut Reports::default());
    let version = tokens.first().filter(|t| t.kind == Kind::Version)?;
    let major = bytes_of(*version, text).get(3)?;
    (b'2'..=b'5')
        .contains(major)
        .then_some(Span::new(version.start, version.end))
}

/// What is said of a file in which shaders were looked for in vain.
pub(crate) fn no_shader(at: Span) -> Diagnostic {
    let message = "this is a program or an effect, and no shader in assembly stands in it";
    let help = "shaders are looked for in blocks `asm { … }`, in strings that begin with a version, and in arrays of tokens";
    Diagnostic::error(&rules::NOT_A_LISTING, at, message).with_help(help)
}

/// Whether a version stands alone in its line, or with an instruction behind it.
fn heads_listing(version: Token, behind: Token, text: &[u8]) -> bool {
    let word = std::str::from_utf8(bytes_of(behind, text)).unwrap_or("");
    let stem = word.split_once('_').map_or(word, |(stem, _)| stem);
    let instruction = behind.kind == Kind::Word && Opcode::from_mnemonic(stem).is_some();
    let alone = behind.first || behind.kind == Kind::End;
    version.kind == Kind::Version && (alone || instruction)
}

fn bytes_of(token: Token, text: &[u8]) -> &[u8] {
    text.get(token.start as usize..token.end as usize)
        .unwrap_or(&[])
}

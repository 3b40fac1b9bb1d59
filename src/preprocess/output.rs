//! The text that comes out, with where each of its bytes comes from.

use super::scan::is_word;
use super::token::{Kind, Part, Token};
use crate::diagnostic::{Derivation, Expansion, Piece, SourceMap, Span};

/// The text so far.
#[derive(Debug, Default)]
pub(super) struct Output {
    pub(super) bytes: Vec<u8>,
    derivation: Derivation,
    /// Where the source of the last piece ends, if what stands there belongs to it.
    end: Option<Part>,
}

impl Output {
    /// Notes a use of a macro; gives its number.
    pub(super) fn expansion(&mut self, name: String, at: Span, within: Option<u32>) -> u32 {
        let outermost = within
            .and_then(|within| self.outermost(within))
            .unwrap_or(at);
        self.derivation.expansions.push(Expansion {
            name,
            at,
            within,
            outermost,
        });
        self.derivation.expansions.len() as u32 - 1
    }

    /// The use of the outermost macro that leads to an expansion.
    pub(super) fn outermost(&self, expansion: u32) -> Option<Span> {
        let expansion = self.derivation.expansions.get(expansion as usize)?;
        Some(expansion.outermost)
    }

    /// Adds a token.
    pub(super) fn push(&mut self, token: &Token, sources: &SourceMap) {
        match token.kind {
            Kind::End => {}
            Kind::Space => self.write(token.part, b" "),
            Kind::Break => self.write(token.part, b"\n"),
            _ => {
                let text = sources.bytes(token.part.source);
                self.keep_apart(token, text);
                self.write(token.part, text);
                for part in &token.more {
                    self.write(*part, sources.bytes(part.source));
                }
            }
        }
    }

    /// Two words that expansion brings together stay two.
    fn keep_apart(&mut self, token: &Token, text: &[u8]) {
        let words = self.bytes.last().is_some_and(|b| is_word(*b))
            && text.first().is_some_and(|b| is_word(*b));
        let same = self.end.is_some_and(|end| continues(end, token.part));
        if words && !same && !token.glued {
            let part = Part {
                source: token.part.source.at_start(),
                ..token.part
            };
            self.write(part, b" ");
        }
    }

    fn write(&mut self, part: Part, text: &[u8]) {
        if text.is_empty() {
            return;
        }
        let copied = text.len() as u32 == part.source.end - part.source.start;
        let joins = copied && self.end.is_some_and(|end| continues(end, part));
        match self.derivation.pieces.last_mut().filter(|_| joins) {
            Some(last) => last.source.end = part.source.end,
            None => self.derivation.pieces.push(Piece {
                start: self.bytes.len() as u32,
                source: part.source,
                expansion: part.expansion,
            }),
        }
        self.bytes.extend_from_slice(text);
        self.end = copied.then_some(part);
    }

    pub(super) fn finish(self) -> (Vec<u8>, Derivation) {
        (self.bytes, self.derivation)
    }
}

/// Whether one part stands right behind another in the same text.
fn continues(end: Part, part: Part) -> bool {
    end.source.end == part.source.start && end.expansion == part.expansion
}

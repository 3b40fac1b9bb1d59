//! Strings of C, with where each of their bytes is written.

use crate::diagnostic::{Derivation, Piece, Span};

/// The text that literals, one behind the other, stand for.
#[derive(Debug, Default)]
pub(super) struct Joined {
    pub(super) bytes: Vec<u8>,
    derivation: Derivation,
    /// Where the source of the last piece ends if that piece is a copy.
    end: Option<u32>,
}

impl Joined {
    /// Adds a literal, quotes included, that stands at `base`.
    pub(super) fn add(&mut self, literal: &[u8], base: u32) {
        if literal.starts_with(b"R") {
            let open = literal
                .iter()
                .position(|b| *b == b'(')
                .map_or(literal.len(), |at| at + 1);
            let close = literal
                .iter()
                .rposition(|b| *b == b')')
                .unwrap_or(literal.len());
            let inner = literal.get(open..close).unwrap_or(&[]);
            return self.push(inner, Span::new(base + open as u32, base + close as u32));
        }
        let inner = literal.get(1..).unwrap_or(&[]);
        let inner = inner.strip_suffix(b"\"").unwrap_or(inner);
        let mut at = 0;
        while let Some(rest) = inner.get(at..).filter(|rest| !rest.is_empty()) {
            let plain = rest.iter().position(|b| *b == b'\\').unwrap_or(rest.len());
            let start = base + 1 + at as u32;
            if plain > 0 {
                let copied = rest.get(..plain).unwrap_or(rest);
                self.push(copied, Span::new(start, start + plain as u32));
                at += plain;
                continue;
            }
            let (byte, length) = escape(rest);
            let source = Span::new(start, start + length as u32);
            match byte {
                Some(byte) => self.push(&[byte], source),
                None => self.end = None,
            }
            at += length;
        }
    }

    fn push(&mut self, text: &[u8], source: Span) {
        if text.is_empty() {
            return;
        }
        let copied = text.len() as u32 == source.end - source.start;
        let joins = copied && self.end == Some(source.start);
        match self.derivation.pieces.last_mut().filter(|_| joins) {
            Some(last) => last.source.end = source.end,
            None => self.derivation.pieces.push(Piece {
                start: self.bytes.len() as u32,
                source,
                expansion: None,
            }),
        }
        self.bytes.extend_from_slice(text);
        self.end = copied.then_some(source.end);
    }

    pub(super) fn finish(self) -> (Vec<u8>, Derivation) {
        (self.bytes, self.derivation)
    }
}

/// What a backslash and what follows it stand for, and how long they are; `None` for a line that is continued.
fn escape(rest: &[u8]) -> (Option<u8>, usize) {
    let numeric = |digits: &[u8], radix: u32, before: usize| {
        let text = std::str::from_utf8(digits).unwrap_or("");
        let value = u32::from_str_radix(text, radix).unwrap_or(0);
        // What does not fit a byte is cut off, as compilers do.
        (Some(value as u8), before + digits.len())
    };
    match rest.get(1) {
        Some(b'n') => (Some(b'\n'), 2),
        Some(b't') => (Some(b'\t'), 2),
        Some(b'r') => (Some(b'\r'), 2),
        Some(b'a' | b'b' | b'f' | b'v') => (Some(b' '), 2),
        Some(b'x') => {
            let digits = rest.get(2..).unwrap_or(&[]);
            let length = digits
                .iter()
                .take(8)
                .take_while(|b| b.is_ascii_hexdigit())
                .count();
            numeric(digits.get(..length).unwrap_or(&[]), 16, 2)
        }
        Some(b'0'..=b'7') => {
            let digits = rest.get(1..).unwrap_or(&[]);
            let length = digits
                .iter()
                .take(3)
                .take_while(|b| (b'0'..=b'7').contains(*b))
                .count();
            numeric(digits.get(..length).unwrap_or(&[]), 8, 1)
        }
        Some(b'\n') => (None, 2),
        Some(b' ' | b'\t' | b'\r') => {
            let blanks = rest
                .iter()
                .skip(1)
                .take_while(|b| matches!(b, b' ' | b'\t' | b'\r'))
                .count();
            match rest.get(1 + blanks) {
                Some(b'\n') => (None, blanks + 2),
                _ => (rest.get(1).copied(), 2),
            }
        }
        Some(same) => (Some(*same), 2),
        None => (Some(b'\\'), 1),
    }
}

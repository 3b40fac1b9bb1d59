//! The words around a place, whatever is wrong with the listing there: what hovers, completion and signatures go by.
//!
//! The parser of listings gives up statements that it cannot read, which is what a statement is while it is typed.

use std::ops::Range;
use texcrd::isa::{Opcode, RegisterFile};

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Letters, digits and underscores, a letter first.
    Word,
    /// The same with points, a digit first.
    Number,
    Sign(char),
}

/// A word, a number or a sign.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Token {
    pub kind: Kind,
    /// Where it stands in the document.
    pub at: Range<usize>,
}

/// A line of a listing.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Line {
    pub tokens: Vec<Token>,
    /// Where comments stand, those that end with the line to its end.
    pub comments: Vec<Range<usize>>,
}

/// An instruction in a line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Statement {
    pub opcode: Opcode,
    /// The mnemonic with its suffixes.
    pub mnemonic: Range<usize>,
    /// Whether a `+` stands before it.
    pub pair: bool,
    /// The numbers of the tokens behind the mnemonic.
    pub operands: Range<usize>,
}

/// Splits a mnemonic from its suffixes: `mul_x2_sat` is `mul` with `_x2_sat`.
pub(super) fn mnemonic(word: &str) -> Option<(Opcode, &str)> {
    let end = word.find('_').unwrap_or(word.len());
    let (base, suffixes) = word.split_at(end);
    Some((Opcode::from_mnemonic(base)?, suffixes))
}

/// Splits a register from its suffix: `r0_bx2` is `r0` with `_bx2`.
pub(super) fn register(word: &str) -> Option<((RegisterFile, u32), &str)> {
    let end = word.find('_').unwrap_or(word.len());
    let (base, suffix) = word.split_at(end);
    Some((RegisterFile::named(base)?, suffix))
}

/// The line of a shader that holds a place; `strings` if it stands in strings of C.
pub(super) fn line_at(text: &str, region: &Range<usize>, strings: bool, offset: usize) -> Line {
    let bytes = text.as_bytes();
    let end = region.end.min(bytes.len());
    let mut line = Line::default();
    let mut at = region.start;
    while let Some(rest) = bytes.get(at..end).filter(|rest| !rest.is_empty()) {
        let (what, length) = measure(rest, strings);
        let here = at..at + length;
        match what {
            What::LineEnd if offset <= at => return line,
            What::LineEnd => line = Line::default(),
            What::Blank => {}
            What::Comment => {
                // A comment of several lines belongs to the lines of both its ends.
                if rest.get(..length).is_some_and(|c| c.contains(&b'\n')) && offset >= here.end {
                    line = Line::default();
                }
                line.comments.push(here);
            }
            What::Token(kind) => line.tokens.push(Token { kind, at: here }),
        }
        at += length;
    }
    line
}

enum What {
    LineEnd,
    Blank,
    Comment,
    Token(Kind),
}

/// What stands first, and how long it is.
fn measure(rest: &[u8], strings: bool) -> (What, usize) {
    let run = |is: fn(&u8) -> bool| rest.iter().take_while(|b| is(b)).count();
    let line = || {
        rest.iter()
            .position(|b| matches!(b, b'\n' | b'\r'))
            .unwrap_or(rest.len())
    };
    match rest {
        [b'\n', ..] => (What::LineEnd, 1),
        [b'\\', b'n', ..] if strings => (What::LineEnd, 2),
        [b'"', ..] if strings => (What::Blank, 1),
        [b';', ..] => (What::Comment, line()),
        [b'/', b'/', ..] => (What::Comment, line()),
        [b'/', b'*', ..] => {
            let end = rest.windows(2).skip(2).position(|w| w == b"*/");
            (What::Comment, end.map_or(rest.len(), |end| end + 4))
        }
        [first, ..] if first.is_ascii_whitespace() => (What::Blank, 1),
        [first, ..] if first.is_ascii_digit() => (
            What::Token(Kind::Number),
            run(|b| b.is_ascii_alphanumeric() || matches!(b, b'_' | b'.')),
        ),
        [first, ..] if first.is_ascii_alphabetic() || *first == b'_' => (
            What::Token(Kind::Word),
            run(|b| b.is_ascii_alphanumeric() || *b == b'_'),
        ),
        [first, ..] if first.is_ascii() => (What::Token(Kind::Sign(char::from(*first))), 1),
        _ => (What::Token(Kind::Sign('?')), run(|b| !b.is_ascii()).max(1)),
    }
}

impl Token {
    pub(super) fn is(&self, sign: char) -> bool {
        self.kind == Kind::Sign(sign)
    }

    pub(super) fn text<'t>(&self, text: &'t str) -> &'t str {
        text.get(self.at.clone()).unwrap_or_default()
    }
}

impl Line {
    /// The token that a place lies in, or at whose end it lies.
    pub(super) fn touched(&self, offset: usize) -> Option<usize> {
        let holds = |token: &Token| token.at.start <= offset && offset <= token.at.end;
        let word = |token: &Token| !matches!(token.kind, Kind::Sign(_));
        let found = self.tokens.iter().position(|t| holds(t) && word(t));
        found.or_else(|| {
            self.tokens
                .iter()
                .position(|t| holds(t) && offset < t.at.end)
        })
    }

    /// Whether a place lies in a comment.
    pub(super) fn in_comment(&self, text: &str, offset: usize) -> bool {
        self.comments.iter().any(|comment| {
            let closed = text
                .get(comment.clone())
                .is_some_and(|c| c.len() > 3 && c.ends_with("*/"));
            let end = if closed { comment.end } else { comment.end + 1 };
            comment.start < offset && offset < end
        })
    }

    /// Whether the line belongs to the preprocessor.
    pub(super) fn is_directive(&self) -> bool {
        self.tokens.first().is_some_and(|token| token.is('#'))
    }

    /// The instructions of the line.
    pub(super) fn statements(&self, text: &str) -> Vec<Statement> {
        let mut found: Vec<Statement> = Vec::new();
        let mut before: Option<&Token> = None;
        for (at, token) in self.tokens.iter().enumerate() {
            let operand = before.is_some_and(|b| [',', '.', '[', '-'].into_iter().any(|s| b.is(s)));
            let opcode =
                mnemonic(token.text(text)).filter(|_| token.kind == Kind::Word && !operand);
            if let Some((opcode, _)) = opcode {
                let pair = before.is_some_and(|b| b.is('+'));
                if let Some(last) = found.last_mut() {
                    last.operands.end = if pair { at - 1 } else { at };
                }
                found.push(Statement {
                    opcode,
                    mnemonic: token.at.clone(),
                    pair,
                    operands: at + 1..self.tokens.len(),
                });
            }
            before = Some(token);
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(text: &str, offset: usize) -> Line {
        line_at(text, &(0..text.len()), false, offset)
    }

    fn words<'t>(line: &Line, text: &'t str) -> Vec<&'t str> {
        line.tokens.iter().map(|t| t.text(text)).collect()
    }

    #[test]
    fn a_line_is_the_one_that_holds_the_place() {
        let text = "ps.1.1\nmov r0.a, 1-v0_bx2 ; c\nadd";
        assert_eq!(words(&line(text, 6), text), ["ps", ".", "1.1"]);
        let second = line(text, 7);
        assert_eq!(
            words(&second, text),
            ["mov", "r0", ".", "a", ",", "1", "-", "v0_bx2"]
        );
        assert!(!second.in_comment(text, 26) && second.in_comment(text, 29));
        assert_eq!(words(&line(text, text.len()), text), ["add"]);
    }

    #[test]
    fn comments_of_several_lines_hide_what_is_in_them() {
        let text = "a /* b\nc */ d\ne";
        assert_eq!(words(&line(text, 13), text), ["d"]);
        assert!(line(text, 5).in_comment(text, 5));
        assert!(line(text, 8).in_comment(text, 8));
        assert!(!line(text, 11).in_comment(text, 11));
    }

    #[test]
    fn strings_of_c_end_their_lines_themselves() {
        let text = "\"ps.1.1\\n\" \"mov r0, v0\\n\"";
        let found = line_at(text, &(0..text.len()), true, 14);
        assert_eq!(words(&found, text), ["mov", "r0", ",", "v0"]);
    }

    #[test]
    fn statements_stand_side_by_side() {
        let text = "mul_x2 r0, v0, exp + mov r0.a, t0 tex t1";
        let line = line(text, 0);
        let found = line.statements(text);
        let shown: Vec<_> = (found.iter())
            .map(|s| {
                (
                    s.opcode,
                    s.pair,
                    words(&line, text)[s.operands.clone()].join(""),
                )
            })
            .collect();
        let expected = [
            (Opcode::Mul, false, "r0,v0,exp".to_string()),
            (Opcode::Mov, true, "r0.a,t0".to_string()),
            (Opcode::Tex, false, "t1".to_string()),
        ];
        assert_eq!(shown, expected);
    }
}

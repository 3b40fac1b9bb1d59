//! Bytes to tokens.
//!
//! Bytes, not characters: comments of the time are in legacy code pages. White space and comments are dropped; each
//! token knows whether it begins a line, because lines help to recover from damage though the grammar has none.

use super::names::Stem;
use super::report::{Reports, quote};
use super::{comment, rules};
use crate::diagnostic::{Diagnostic, Span};
use crate::program::Comment;
use nom::branch::alt;
use nom::bytes::complete::{tag, tag_no_case, take_until, take_while, take_while1};
use nom::character::complete::{digit0, digit1, one_of};
use nom::combinator::{map, opt, recognize, rest, value};
use nom::{IResult, Parser};

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// `ps.1.4`, `vs_1_1` and everything that begins like one.
    Version,
    /// Letters, digits and underscores; digits first too if it is no number (`1rp`).
    Word,
    /// A number without its sign.
    Number,
    Comma,
    Dot,
    Plus,
    Minus,
    /// A dash of typesetting that stands for a minus.
    Dash,
    Open,
    Close,
    Colon,
    /// A run of bytes that no listing holds outside of comments.
    Junk,
    /// Behind the last token.
    End,
}

/// A token.
#[derive(Clone, Copy, Debug)]
pub(super) struct Token {
    pub(super) kind: Kind,
    /// Offset in the text.
    pub(super) start: u32,
    pub(super) end: u32,
    /// Line from 1.
    pub(super) line: u32,
    /// Whether it is the first of its line.
    pub(super) first: bool,
    /// What it names, if it is a word.
    pub(super) stem: Stem,
}

/// The tokens of a text, whatever is wrong with it.
pub(super) fn tokens(text: &[u8]) -> Vec<Token> {
    lex_up_to(text, 0, MOST_TOKENS, &mut Reports::default()).tokens
}

/// The tokens of a text.
pub(super) struct Lexed {
    /// Never empty: `end` is the last.
    pub(super) tokens: Vec<Token>,
    /// A token of [`Kind::End`].
    pub(super) end: Token,
    /// Whether a directive was met that may define names.
    pub(super) names_missing: bool,
    /// The comments that belong to the tokens of the shader; before which statement they stand is not known yet.
    pub(super) comments: Vec<Comment>,
}

/// More tokens than the largest text of instructions that any version takes, by far; bounds the memory.
const MOST_TOKENS: usize = 1 << 20;

/// How long a word or sign is with the white space behind it, roughly, in a listing with some comments; and how many
/// tokens room is made for at once, so that a long comment does not take any.
const BYTES_A_TOKEN: usize = 4;
const FIRST_TOKENS: usize = 256;

/// The first tokens of a text, `most` or one more.
pub(super) fn lex_some(text: &[u8], most: usize, reports: &mut Reports) -> Vec<Token> {
    lex_up_to(text, 0, most, reports).tokens
}

/// Splits a text into tokens.
pub(super) fn lex(text: &[u8], base: u32, reports: &mut Reports) -> Lexed {
    lex_up_to(text, base, MOST_TOKENS, reports)
}

fn lex_up_to(text: &[u8], base: u32, most: usize, reports: &mut Reports) -> Lexed {
    let mut lexer = Lexer {
        text,
        base,
        line: 1,
        reports,
        directives: Vec::new(),
        comments: Vec::new(),
    };
    let mut tokens = Vec::with_capacity((text.len() / BYTES_A_TOKEN).min(FIRST_TOKENS));
    let mut rest = text.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(text);
    let mut first = true;
    let end = loop {
        let (after, new_line) = lexer.skip_space(rest, first);
        first |= new_line;
        rest = after;
        let start = lexer.offset(rest);
        // `any_token` fails only at the end of the text.
        let Ok((after, kind)) = any_token(rest) else {
            break start;
        };
        if tokens.len() == most {
            let message = format!(
                "more than {MOST_TOKENS} words and signs: no listing is so long, the rest is not read"
            );
            let span = Span::new(base + start, base + start + 1);
            lexer
                .reports
                .push(Diagnostic::error(&rules::NOT_A_LISTING, span, message));
            break start;
        }
        let word = rest.get(..rest.len() - after.len()).unwrap_or(rest);
        tokens.push(Token {
            kind,
            start,
            end: lexer.offset(after),
            line: lexer.line,
            first,
            stem: match kind {
                Kind::Word => Stem::of(word),
                _ => Stem::NONE,
            },
        });
        rest = after;
        first = false;
    };
    let end = Token {
        kind: Kind::End,
        start: end,
        end,
        line: lexer.line,
        first: true,
        stem: Stem::NONE,
    };
    tokens.push(end);
    Lexed {
        tokens,
        end,
        names_missing: !lexer.directives.is_empty(),
        comments: lexer.comments,
    }
}

struct Lexer<'a, 'r> {
    text: &'a [u8],
    base: u32,
    line: u32,
    reports: &'r mut Reports,
    /// Names of the directives that were refused so far: one report each.
    directives: Vec<String>,
    comments: Vec<Comment>,
}

impl<'a> Lexer<'a, '_> {
    fn offset(&self, rest: &[u8]) -> u32 {
        (self.text.len() - rest.len()) as u32
    }

    /// Skips white space, comments and directives; tells whether a line ended.
    fn skip_space(&mut self, mut rest: &'a [u8], mut first: bool) -> (&'a [u8], bool) {
        let mut new_line = false;
        // Whether a line that begins with `;@` continues the last comment of the tokens.
        let mut open = false;
        loop {
            // The first byte says what can stand here.
            match rest {
                [b'\n', after @ ..] => {
                    self.line += 1;
                    rest = after;
                    new_line = true;
                    first = true;
                }
                [b';', ..] | [b'/', b'/', ..] => {
                    let (after, text) = to_line_end(rest).unwrap_or((&[], rest));
                    open = self.token_comment(text, self.offset(rest), open);
                    rest = after;
                }
                [b'/', b'*', ..] => {
                    let after = self.block_comment(rest);
                    let lines = rest[..rest.len() - after.len()].iter();
                    let lines = lines.filter(|b| **b == b'\n').count() as u32;
                    self.line += lines;
                    new_line |= lines > 0;
                    first |= lines > 0;
                    rest = after;
                }
                [b'#', ..] if first => rest = self.directive(rest),
                // A no-break space, in UTF-8 and in the code pages of the time.
                [0xC2, 0xA0, after @ ..] | [0xA0, after @ ..] => rest = after,
                [blank, ..] if is_blank(*blank) => {
                    rest = blanks(rest).map_or(&[], |(after, _)| after);
                }
                _ => return (rest, new_line),
            }
        }
    }

    /// A line comment, if it belongs to the tokens of the shader or continues one that does.
    fn token_comment(&mut self, text: &[u8], at: u32, open: bool) -> bool {
        let Some((line, content)) = comment::line(text, open) else {
            return false;
        };
        let start = self.base + at;
        if line == comment::Line::First {
            let span = Span::new(start, start);
            self.comments.push(Comment {
                before: 0,
                words: Vec::new(),
                span,
            });
        }
        let Some(comment) = self.comments.last_mut() else {
            return false;
        };
        comment.span.end = start + text.trim_ascii_end().len() as u32;
        if let Err(fault) = comment::read(content, &mut comment.words) {
            let first = comment.span.end - fault.left as u32;
            let span = Span::new(first, first + fault.length as u32);
            let report = Diagnostic::error(&rules::TOKEN_COMMENT, span, fault.message);
            self.reports.push(report.with_help(fault.help));
        }
        true
    }

    fn block_comment(&mut self, rest: &'a [u8]) -> &'a [u8] {
        if let Ok((after, _)) = closed_comment(rest) {
            return after;
        }
        let start = self.base + self.offset(rest);
        let message = "this comment has no end: everything behind it is lost";
        let report = Diagnostic::error(&rules::COMMENT_OPEN, Span::new(start, start + 2), message)
            .with_help("write */ where the comment ends");
        self.reports.push(report);
        &[]
    }

    /// A line that begins with `#`, with the lines that it is continued on.
    fn directive(&mut self, rest: &'a [u8]) -> &'a [u8] {
        let (mut after, (name, _)) = match directive_name(rest) {
            Ok((after, name)) => (after, (name, ())),
            Err(_) => (&rest[1..], (&rest[..0], ())),
        };
        let text = String::from_utf8_lossy(name).to_ascii_lowercase();
        if !matches!(text.as_str(), "line" | "pragma" | "") && !self.directives.contains(&text) {
            let start = self.base + self.offset(rest);
            let span = Span::new(start, self.base + self.offset(after));
            let message = format!(
                "#{} stands behind the preprocessor",
                quote(name).trim_matches('`')
            );
            let help =
                "macros cannot make directives, and this text may not have been preprocessed";
            let report = Diagnostic::error(&rules::UNSEEN_DIRECTIVE, span, message).with_help(help);
            self.reports.push(report);
            if self.directives.len() < 64 {
                self.directives.push(text);
            }
        }
        loop {
            let line;
            (after, line) = to_line_end(after).unwrap_or((&[], after));
            let line = line.strip_suffix(b"\r").unwrap_or(line);
            match after.strip_prefix(b"\n") {
                Some(next) if line.ends_with(b"\\") => {
                    self.line += 1;
                    after = next;
                }
                _ => return after,
            }
        }
    }
}

// --- the grammar of single tokens ---

/// Whether a byte is a blank within a line, as the end-of-file mark of DOS is.
fn is_blank(b: u8) -> bool {
    matches!(b, b' ' | b'\t' | b'\r' | 0x0B | 0x0C | 0x1A)
}

fn blanks(input: &[u8]) -> IResult<&[u8], &[u8]> {
    take_while(is_blank).parse(input)
}

fn to_line_end(input: &[u8]) -> IResult<&[u8], &[u8]> {
    alt((take_until("\n"), rest)).parse(input)
}

fn closed_comment(input: &[u8]) -> IResult<&[u8], &[u8]> {
    recognize((tag("/*"), take_until("*/"), tag("*/"))).parse(input)
}

fn directive_name(input: &[u8]) -> IResult<&[u8], &[u8]> {
    let (input, _) = (tag("#"), take_while(|b| b == b' ' || b == b'\t')).parse(input)?;
    take_while(|b: u8| b.is_ascii_alphanumeric() || b == b'_').parse(input)
}

fn is_word(b: u8) -> bool {
    b.is_ascii_alphanumeric() || matches!(b, b'_' | b'|')
}

/// `vs` or `ps`, perhaps with the `x` of the Xbox, a separator and what follows without a blank.
fn version(input: &[u8]) -> IResult<&[u8], Kind> {
    let (input, _) = (
        opt(tag_no_case("x")),
        alt((tag_no_case("vs"), tag_no_case("ps"))),
        one_of("._"),
        one_of("0123456789lIiOo|"),
        take_while(|b: u8| is_word(b) || b == b'.'),
    )
        .parse(input)?;
    Ok((input, Kind::Version))
}

/// A number without sign.
pub(super) fn number(input: &[u8]) -> IResult<&[u8], &[u8]> {
    recognize((
        alt((
            recognize((digit1, opt((tag("."), digit0)))),
            recognize((tag("."), digit1)),
        )),
        opt((one_of("eE"), opt(one_of("+-")), digit1)),
        opt(one_of("fF")),
    ))
    .parse(input)
}

/// A number, or a word that begins like one.
fn number_or_word(input: &[u8]) -> IResult<&[u8], Kind> {
    let (after, text) = number(input)?;
    let (rest, tail) = take_while(is_word).parse(after)?;
    let kind = if tail.is_empty() {
        Kind::Number
    } else if text.starts_with(b".") {
        // `.2x` behind a register is a dot with letters; the parser puts them together.
        return map(tag("."), |_| Kind::Dot).parse(input);
    } else {
        Kind::Word
    };
    Ok((rest, kind))
}

fn word(input: &[u8]) -> IResult<&[u8], Kind> {
    value(Kind::Word, take_while1(is_word)).parse(input)
}

/// En dash, em dash, hyphen and minus sign in UTF-8, and the en dash of code page 1252.
fn dash(input: &[u8]) -> IResult<&[u8], Kind> {
    value(
        Kind::Dash,
        alt((
            tag(&b"\xE2\x80\x90"[..]),
            tag(&b"\xE2\x80\x93"[..]),
            tag(&b"\xE2\x80\x94"[..]),
            tag(&b"\xE2\x88\x92"[..]),
            tag(&b"\x96"[..]),
        )),
    )
    .parse(input)
}

fn junk(input: &[u8]) -> IResult<&[u8], Kind> {
    let plain =
        |b: u8| !(is_word(b) || b.is_ascii_whitespace() || b",.+-[]:;#/\x0B\x1A\x96".contains(&b));
    // A single `/` or `#` is one too: what they begin was tried before.
    let one = alt((tag("/"), tag("#")));
    value(Kind::Junk, alt((take_while1(plain), one))).parse(input)
}

/// One token of any kind. Its first bytes say which are to be tried.
fn any_token(input: &[u8]) -> IResult<&[u8], Kind> {
    match input {
        [b',', after @ ..] => Ok((after, Kind::Comma)),
        [b'0'..=b'9', ..] | [b'.', b'0'..=b'9', ..] => number_or_word(input),
        [b'.', after @ ..] => Ok((after, Kind::Dot)),
        [b'v' | b'V' | b'p' | b'P', b's' | b'S', ..]
        | [b'x' | b'X', b'v' | b'V' | b'p' | b'P', ..] => alt((version, word)).parse(input),
        [first, ..] if is_word(*first) => word(input),
        [b'+', after @ ..] => Ok((after, Kind::Plus)),
        [b'-', after @ ..] => Ok((after, Kind::Minus)),
        [b'[', after @ ..] => Ok((after, Kind::Open)),
        [b']', after @ ..] => Ok((after, Kind::Close)),
        [b':', after @ ..] => Ok((after, Kind::Colon)),
        _ => alt((dash, junk)).parse(input),
    }
}

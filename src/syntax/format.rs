//! The layout of listings: blanks between words, columns of operands and of comments.
//!
//! A listing is laid out line by line as it is written: nothing is joined or divided, no word is spelled otherwise, and
//! lines that are not understood (damaged ones, uses of macros with arguments, block comments within instructions) stay as
//! they are. So do lines for the preprocessor.

use super::lexer::{self, Kind, Token};
use crate::isa::Opcode;
use crate::preprocess::scan::{self, Language, Scanner};
use std::collections::HashMap;

/// Code that is longer does not move the comments of the lines around it.
const LONGEST: usize = 48;

/// A listing, laid out.
///
/// * Instructions begin their lines, as do `+` and comments that stand alone.
/// * One blank stands behind a comma and between words, none around points and signs.
/// * Comments behind instructions stand in one column from blank line to blank line.
/// * Operands stand in one column in those parts of a listing in which a line has them in one, as the articles often did;
///   elsewhere one blank stands before them.
///
/// The result is laid out itself: a second time changes nothing. What is read from it is what was read before.
pub fn format(text: &[u8]) -> Vec<u8> {
    // What stands behind the text stays.
    let end = scan::without_nul(text).len();
    let (listing, behind) = text.split_at_checked(end).unwrap_or((text, &[]));
    let (mark, listing) = match listing.strip_prefix(b"\xEF\xBB\xBF") {
        Some(rest) => (&b"\xEF\xBB\xBF"[..], rest),
        None => (&[][..], listing),
    };
    if super::not_text(listing).is_some() {
        return text.to_vec();
    }
    let mut laid_out = lay_out(listing, b"");
    if !laid_out.is_empty() && !laid_out.ends_with(b"\n") {
        laid_out.push(b'\n');
    }
    [mark, &laid_out, behind].concat()
}

/// A listing between the braces of a block, laid out: what stands in the lines of the braces stays.
pub(crate) fn format_block(text: &[u8]) -> Vec<u8> {
    let first = text.iter().position(|b| *b == b'\n').map(|at| at + 1);
    let last = text.iter().rposition(|b| *b == b'\n').map(|at| at + 1);
    let (Some(first), Some(last)) = (first, last) else {
        return text.to_vec();
    };
    let (before, rest) = text.split_at(first);
    let (inner, behind) = rest.split_at(last - first);
    // Behind a comment that is still open, nothing is known.
    let open = |text: &[u8]| lexemes(text).iter().any(|l| l.open);
    if open(before) || open(inner) {
        return text.to_vec();
    }
    let blank = |b: &u8| matches!(b, b' ' | b'\t');
    let indents = inner.split(|b| *b == b'\n').filter_map(|line| {
        let indent = line.iter().take_while(|b| blank(b)).count();
        let code = line
            .get(indent)
            .is_some_and(|b| !b.is_ascii_whitespace() && !matches!(b, b';' | b'#' | b'/'));
        line.get(..indent).filter(|_| code)
    });
    let indent = indents.min_by_key(|indent| indent.len()).unwrap_or(b"");
    [before, &lay_out(inner, indent), behind].concat()
}

fn lexemes(text: &[u8]) -> Vec<scan::Lexeme> {
    let mut scanner = Scanner::new(text.into(), 0, Language::Listing);
    let mut all = Vec::new();
    loop {
        let lexeme = scanner.next();
        if lexeme.kind == scan::Kind::End {
            return all;
        }
        // The line of a directive ends where the preprocessor ends it.
        let directive = lexeme.first && text.get(lexeme.span.start as usize) == Some(&b'#');
        scanner.directive = (scanner.directive || directive) && lexeme.kind != scan::Kind::NewLine;
        all.push(lexeme);
    }
}

/// A line as it is written.
enum Line<'a> {
    /// As it stands.
    Kept(&'a [u8]),
    Blank,
    /// A comment alone; `behind` if it goes on with the comment behind the code of the line before.
    Comment {
        text: &'a [u8],
        behind: bool,
    },
    Code(Code<'a>),
}

struct Code<'a> {
    /// The mnemonic, with its `+`, if what follows may stand in a column.
    head: Vec<u8>,
    rest: Vec<u8>,
    /// Whether more than one blank stands behind the mnemonic.
    apart: bool,
    comment: Option<&'a [u8]>,
}

impl Code<'_> {
    /// The code with its operands behind a mnemonic of `width`.
    fn text(&self, width: usize) -> Vec<u8> {
        let mut text = self.head.clone();
        if !self.rest.is_empty() && !text.is_empty() {
            text.resize(text.len().max(width) + 1, b' ');
        }
        text.extend_from_slice(&self.rest);
        text
    }
}

fn lay_out(text: &[u8], indent: &[u8]) -> Vec<u8> {
    let laid_out = arranged(text, indent);
    // Nothing may be read otherwise than before.
    let read = |text: &[u8]| -> Vec<(Kind, bool, Vec<u8>)> {
        let bytes = |t: &Token| {
            text.get(t.start as usize..t.end as usize)
                .unwrap_or(&[])
                .to_vec()
        };
        lexer::tokens(text)
            .iter()
            .map(|t| (t.kind, t.first, bytes(t)))
            .collect()
    };
    match read(text) == read(&laid_out) {
        true => laid_out,
        false => text.to_vec(),
    }
}

fn arranged(text: &[u8], indent: &[u8]) -> Vec<u8> {
    let lines = read(text, indent.len());
    let mut out = Vec::with_capacity(text.len() + text.len() / 4);
    let mut ends = text.split_inclusive(|b| *b == b'\n');
    let mut part = &lines[..];
    while !part.is_empty() {
        // From blank line to blank line.
        let length = part
            .iter()
            .position(|l| matches!(l, Line::Blank))
            .unwrap_or(part.len())
            .max(1);
        let (here, behind) = part.split_at(length);
        let codes = || {
            here.iter().filter_map(|l| {
                if let Line::Code(code) = l {
                    Some(code)
                } else {
                    None
                }
            })
        };
        let apart = codes().any(|code| code.apart && !code.head.is_empty());
        let heads = codes().filter(|_| apart).map(|code| code.head.len());
        let width = heads.max().unwrap_or(0);
        let lengths = codes()
            .filter(|code| code.comment.is_some())
            .map(|code| code.text(width).len());
        let column = lengths
            .filter(|length| *length <= LONGEST)
            .max()
            .unwrap_or(0)
            + 1;
        for line in here {
            let start = out.len();
            match line {
                Line::Kept(text) => out.extend_from_slice(text),
                Line::Blank => {}
                Line::Comment { text, behind } => {
                    out.extend_from_slice(indent);
                    if *behind {
                        out.resize(out.len() + column, b' ');
                    }
                    out.extend_from_slice(text);
                }
                Line::Code(code) => {
                    out.extend_from_slice(indent);
                    let mut text = code.text(width);
                    if let Some(comment) = code.comment {
                        text.resize((text.len() + 1).max(column), b' ');
                        text.extend_from_slice(comment);
                    }
                    out.extend_from_slice(&text);
                }
            }
            while out.len() > start && out.last().is_some_and(|b| matches!(b, b' ' | b'\t')) {
                out.pop();
            }
            let end = ends.next().unwrap_or(b"");
            let from = end.len()
                - if end.ends_with(b"\r\n") {
                    2
                } else {
                    usize::from(end.ends_with(b"\n"))
                };
            out.extend_from_slice(end.get(from..).unwrap_or(b""));
        }
        part = behind;
    }
    out
}

/// The lines of a text; those that are not begun by a line end are none.
fn read(text: &[u8], indent: usize) -> Vec<Line<'_>> {
    let tokens = lexer::tokens(text);
    // By line: where its comment begins, and whether it stays as it is.
    let mut comments: HashMap<usize, usize> = HashMap::new();
    let mut kept: HashMap<usize, bool> = HashMap::new();
    let starts: Vec<usize> = std::iter::once(0)
        .chain(
            text.iter()
                .enumerate()
                .filter(|(_, b)| **b == b'\n')
                .map(|(at, _)| at + 1),
        )
        .collect();
    let line_of = |offset: usize| {
        starts
            .partition_point(|start| *start <= offset)
            .saturating_sub(1)
    };
    let mut directive = false;
    for lexeme in lexemes(text) {
        let (start, end) = (lexeme.span.start as usize, lexeme.span.end as usize);
        let bytes = text.get(start..end).unwrap_or(&[]);
        let line = line_of(start);
        directive |= lexeme.first && bytes == b"#";
        if directive || bytes.starts_with(b"/*") {
            (line..=line_of(end.saturating_sub(1))).for_each(|line| {
                kept.insert(line, true);
            });
        } else if lexeme.kind == scan::Kind::Blank
            && (bytes.starts_with(b";") || bytes.starts_with(b"//"))
        {
            comments.insert(line, start);
        }
        directive &= lexeme.kind != scan::Kind::NewLine;
    }
    let mut lines = Vec::with_capacity(starts.len());
    let mut rest = &tokens[..];
    for (number, start) in starts.iter().copied().enumerate() {
        let end = starts.get(number + 1).copied().unwrap_or(text.len());
        let whole = text.get(start..end).unwrap_or(&[]);
        let whole = whole.strip_suffix(b"\n").unwrap_or(whole);
        let whole = whole.strip_suffix(b"\r").unwrap_or(whole);
        if number + 1 == starts.len() && whole.is_empty() {
            break;
        }
        let count = rest
            .iter()
            .take_while(|t| (t.start as usize) < end && t.kind != Kind::End)
            .count();
        let (mine, others) = rest.split_at(count);
        rest = others;
        let comment = comments.get(&number).copied();
        let comment_text = comment
            .and_then(|at| text.get(at..start + whole.len()))
            .map(<[u8]>::trim_ascii_end);
        let last_has_comment = match lines.last() {
            Some(Line::Code(code)) => code.comment.is_some(),
            Some(Line::Comment { behind, .. }) => *behind,
            _ => false,
        };
        let line = match (mine, comment_text) {
            _ if kept.contains_key(&number) => Line::Kept(whole),
            ([], Some(text)) => Line::Comment {
                text,
                behind: last_has_comment && comment.unwrap_or(start) > start + indent,
            },
            ([], None) if whole.trim_ascii().is_empty() => Line::Blank,
            (mine, comment) => match code(text, mine, comment) {
                Some(code) if covers(text, (start, start + whole.len()), mine, comment) => {
                    Line::Code(code)
                }
                _ => Line::Kept(whole),
            },
        };
        lines.push(line);
    }
    lines
}

/// Whether a line holds nothing but tokens, a comment and blanks.
fn covers(text: &[u8], line: (usize, usize), tokens: &[Token], comment: Option<&[u8]>) -> bool {
    let (Some(first), Some(last)) = (tokens.first(), tokens.last()) else {
        return false;
    };
    let blank = |range: std::ops::Range<usize>| {
        let blank = |b: &u8| matches!(b, b' ' | b'\t' | b'\r');
        text.get(range)
            .is_some_and(|between| between.iter().all(blank))
    };
    let between = tokens.windows(2).all(|w| match w {
        [a, b] => blank(a.end as usize..b.start as usize),
        _ => true,
    });
    let behind = text
        .get(last.end as usize..line.1)
        .unwrap_or(&[])
        .trim_ascii_start();
    between
        && blank(line.0..first.start as usize)
        && match comment {
            Some(comment) => behind.starts_with(comment),
            None => behind.is_empty(),
        }
}

/// The code of a line; `None` if it is not the beginning of an instruction, or holds what no listing holds.
fn code<'a>(text: &[u8], tokens: &[Token], comment: Option<&'a [u8]>) -> Option<Code<'a>> {
    let bytes = |token: &Token| {
        text.get(token.start as usize..token.end as usize)
            .unwrap_or(&[])
    };
    let known = |t: &Token| !matches!(t.kind, Kind::Junk | Kind::Colon | Kind::Dash | Kind::End);
    let plus = usize::from(tokens.first()?.kind == Kind::Plus);
    let mnemonic = tokens.get(plus)?;
    let opcode = match mnemonic.kind {
        Kind::Version if plus == 0 => None,
        Kind::Word => Some(opcode(bytes(mnemonic))?),
        _ => return None,
    };
    if !tokens.iter().all(known) {
        return None;
    }
    // Declarations do not stand in the column of the others.
    let column = opcode.is_some_and(|op| !matches!(op, Opcode::Def | Opcode::Dcl));
    let mut code = Code {
        head: Vec::new(),
        rest: Vec::new(),
        apart: false,
        comment,
    };
    let mut depth = 0usize;
    for (at, token) in tokens.iter().enumerate() {
        if column && at == plus + 1 && token.kind != Kind::Plus {
            code.head = std::mem::take(&mut code.rest);
            code.apart = token.start > mnemonic.end + 1;
        } else if at > 0 && spaced(text, tokens, at, depth) {
            code.rest.push(b' ');
        }
        match token.kind {
            Kind::Open => depth += 1,
            Kind::Close => depth = depth.saturating_sub(1),
            _ => {}
        }
        code.rest.extend_from_slice(bytes(token));
    }
    Some(code)
}

fn opcode(word: &[u8]) -> Option<Opcode> {
    let word = std::str::from_utf8(word).ok()?;
    Opcode::from_mnemonic(word.split('_').next().unwrap_or(word))
}

/// Whether a blank stands before token `at`, which is not the first; `depth`: how many brackets are open.
fn spaced(text: &[u8], tokens: &[Token], at: usize, depth: usize) -> bool {
    use Kind::{Close, Comma, Dot, Minus, Number, Open, Plus, Word};
    let kind = |at: usize| tokens.get(at).map(|t| t.kind);
    let (Some(before), Some(token)) = (tokens.get(at - 1), tokens.get(at)) else {
        return false;
    };
    let gap = before.end < token.start;
    // A sign that belongs to what follows it, in an index.
    let sign = at >= 2 && kind(at - 2) == Some(Open);
    let letter = |t: &Token| {
        text.get(t.start as usize)
            .is_some_and(u8::is_ascii_alphabetic)
    };
    match (before.kind, token.kind) {
        (Open, _) | (_, Close | Comma) => false,
        (Comma, _) => true,
        (Plus | Minus, _) => depth > 0 && !sign,
        (_, Plus) => true,
        // `1-r0`; numbers may have lost a comma.
        (Number, Minus) if depth == 0 && kind(at + 1) == Some(Word) => false,
        (_, Minus) if depth > 0 => true,
        (Word, Open) => false,
        (Word | Close, Dot) => false,
        (Dot, Word) if letter(token) => false,
        _ => gap,
    }
}

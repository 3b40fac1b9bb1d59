//! Bytes to the words and signs that a preprocessor looks at.

use crate::diagnostic::Span;
use std::sync::Arc;

/// What a word or sign is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Letters, digits and underscores.
    Name,
    /// A digit with the letters, digits and points behind it.
    Number,
    /// Blanks within a line; comments.
    Blank,
    /// The end of a line.
    NewLine,
    /// A backslash at the end of a line, with the line end: in directives, and anywhere in C.
    Splice,
    /// A string with its quotes; only where strings are looked for.
    Text,
    /// One byte.
    Sign,
    /// Behind the last.
    End,
}

/// A word or sign.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lexeme {
    pub(crate) kind: Kind,
    /// Where it stands in the sources.
    pub(crate) span: Span,
    /// Whether it is a comment that has no end.
    pub(crate) open: bool,
    /// Whether only blanks stand before it in its line.
    pub(crate) first: bool,
}

/// Which language a text is in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Language {
    /// Assembly: `;` begins a comment, quotes are signs.
    Listing,
    /// C, C++ or an effect, with assembly between the braces of `asm { … }`.
    Host,
}

/// Where the braces of `asm { … }` are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Block {
    Outside,
    /// Behind the word.
    Announced,
    Inside,
}

impl Block {
    /// Where they are behind a word or sign.
    fn behind(self, kind: Kind, text: &[u8]) -> Self {
        match (self, kind) {
            (block, Kind::Blank | Kind::NewLine | Kind::Splice) => block,
            (Block::Inside, Kind::Sign) if text == b"}" => Block::Outside,
            (Block::Inside, _) => Block::Inside,
            (Block::Announced, Kind::Sign) if text == b"{" => Block::Inside,
            (_, Kind::Name) if text.eq_ignore_ascii_case(b"asm") => Block::Announced,
            _ => Block::Outside,
        }
    }
}

/// Splits a text.
#[derive(Clone, Debug)]
pub(crate) struct Scanner {
    text: Arc<[u8]>,
    base: u32,
    at: usize,
    /// Behind the last byte that is text.
    end: usize,
    language: Language,
    block: Block,
    first: bool,
    /// Whether raw strings of C++ are looked for: not behind one that has no end.
    raw: bool,
    /// Whether a directive is read: lines are continued, and strings have their quotes.
    pub(crate) directive: bool,
}

impl Scanner {
    pub(crate) fn new(text: Arc<[u8]>, base: u32, language: Language) -> Self {
        let end = without_nul(&text).len();
        let at = if text.starts_with(b"\xEF\xBB\xBF") {
            3
        } else {
            0
        };
        Self {
            text,
            base,
            at,
            end,
            language,
            block: Block::Outside,
            first: true,
            raw: language == Language::Host,
            directive: false,
        }
    }

    /// Whether the bytes that are read are assembly.
    fn in_listing(&self) -> bool {
        self.language == Language::Listing || self.block == Block::Inside
    }

    /// The next word or sign; [`Kind::End`] at the end.
    pub(crate) fn next(&mut self) -> Lexeme {
        let rest = self.text.get(self.at.min(self.end)..self.end);
        let rest = rest.unwrap_or(&[]);
        let (kind, length) = self.measure(rest);
        let start = self.base + self.at as u32;
        let open = kind == Kind::Blank
            && rest.starts_with(b"/*")
            && !closed(rest.get(..length).unwrap_or(rest));
        let lexeme = Lexeme {
            kind,
            span: Span::new(start, start + length as u32),
            open,
            first: self.first,
        };
        if self.language == Language::Host {
            self.raw &= kind == Kind::Text || !self.begins_raw(rest);
            self.block = self.block.behind(kind, rest.get(..length).unwrap_or(&[]));
        }
        self.at += length;
        match kind {
            Kind::NewLine => self.first = true,
            Kind::Blank | Kind::End => {}
            _ => self.first = false,
        }
        lexeme
    }

    /// Reads what was read last, a line end or nothing, once more.
    pub(crate) fn put_back(&mut self, last: Lexeme) {
        self.at = (last.span.start - self.base) as usize;
        self.first = last.first;
    }

    /// Whether what was read last opens a block of assembly.
    pub(crate) fn inside_block(&self) -> bool {
        self.block == Block::Inside
    }

    /// Whether strings are looked for.
    fn has_strings(&self) -> bool {
        self.directive || !self.in_listing()
    }

    /// Whether a raw string begins here, unless it has no end.
    fn begins_raw(&self, rest: &[u8]) -> bool {
        rest.starts_with(b"R\"") && self.has_strings() && self.raw
    }

    fn measure(&self, rest: &[u8]) -> (Kind, usize) {
        let Some(&first) = rest.first() else {
            return (Kind::End, 0);
        };
        if self.begins_raw(rest)
            && let Some(length) = raw_string(rest)
        {
            return (Kind::Text, length);
        }
        match first {
            b'\n' => (Kind::NewLine, 1),
            b'\r' if rest.starts_with(b"\r\n") => (Kind::NewLine, 2),
            b'\\' if (self.directive || !self.in_listing()) && splice(rest).is_some() => {
                (Kind::Splice, splice(rest).unwrap_or(1))
            }
            b';' if self.in_listing() => (Kind::Blank, self.line(rest)),
            b'/' if rest.starts_with(b"//") => (Kind::Blank, self.line(rest)),
            b'/' if rest.starts_with(b"/*") => {
                let behind = rest.get(2..).unwrap_or(&[]);
                let end = find(behind, b"*/").map_or(rest.len(), |at| at + 4);
                (Kind::Blank, end)
            }
            b'"' | b'\'' if self.has_strings() => (Kind::Text, quoted(rest)),
            _ if is_blank(first) => (
                Kind::Blank,
                rest.iter().take_while(|b| is_blank(**b)).count(),
            ),
            _ if first.is_ascii_alphabetic() || first == b'_' => {
                (Kind::Name, rest.iter().take_while(|b| is_word(**b)).count())
            }
            _ if begins_number(rest) => (Kind::Number, number(rest)),
            _ => (Kind::Sign, 1),
        }
    }

    /// The length of a comment that ends with its line.
    fn line(&self, rest: &[u8]) -> usize {
        let end = rest.iter().position(|b| *b == b'\n').unwrap_or(rest.len());
        let line = rest.get(..end).unwrap_or(rest);
        let line = line.strip_suffix(b"\r").unwrap_or(line);
        if !self.directive {
            return line.len();
        }
        // A directive goes on behind a comment.
        let trimmed = line.trim_ascii_end();
        match trimmed.strip_suffix(b"\\") {
            Some(comment) if end < rest.len() => comment.len(),
            _ => line.len(),
        }
    }
}

/// A text without what stands behind it: some listings were cut out of programs with the NUL at their end, and a line end
/// or the end-of-file mark of DOS came behind that.
pub(crate) fn without_nul(bytes: &[u8]) -> &[u8] {
    let is_end = |b: &u8| matches!(b, 0 | 0x1A) || is_blank(*b) || *b == b'\n';
    let end = bytes
        .iter()
        .rposition(|b| !is_end(b))
        .map_or(0, |at| at + 1);
    let (text, behind) = bytes.split_at_checked(end).unwrap_or((bytes, &[]));
    match behind.iter().position(|b| *b == 0) {
        Some(nul) => bytes.get(..end + nul).unwrap_or(text),
        None => bytes,
    }
}

pub(crate) fn is_word(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_'
}

fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\r' | 0x0B | 0x0C)
}

fn find(text: &[u8], what: &[u8]) -> Option<usize> {
    text.windows(what.len()).position(|w| w == what)
}

fn closed(comment: &[u8]) -> bool {
    comment.len() >= 4 && comment.ends_with(b"*/")
}

/// The length of a backslash with the line end behind it.
fn splice(rest: &[u8]) -> Option<usize> {
    let blanks = rest.iter().skip(1).take_while(|b| is_blank(**b)).count();
    (rest.get(1 + blanks) == Some(&b'\n')).then_some(blanks + 2)
}

/// The length of a string, which ends with its line at the latest unless the line is continued.
fn quoted(rest: &[u8]) -> usize {
    let quote = rest.first();
    let mut at = 1;
    while let Some(byte) = rest.get(at) {
        match byte {
            b'\\' => at += splice(rest.get(at..).unwrap_or(&[])).unwrap_or(2).max(2),
            b'\n' => return at,
            _ if Some(byte) == quote => return at + 1,
            _ => at += 1,
        }
    }
    rest.len()
}

/// The length of `R"name(…)name"`.
fn raw_string(rest: &[u8]) -> Option<usize> {
    let behind = rest.strip_prefix(b"R\"")?;
    // As long as C++ has it.
    let name = behind.iter().take(17).position(|b| *b == b'(')?;
    let mut end = vec![b')'];
    end.extend_from_slice(behind.get(..name)?);
    end.push(b'"');
    let at = find(behind, &end)?;
    Some(2 + at + end.len())
}

fn begins_number(rest: &[u8]) -> bool {
    match rest {
        [b'.', digit, ..] | [digit, ..] => digit.is_ascii_digit(),
        _ => false,
    }
}

fn number(rest: &[u8]) -> usize {
    let mut at = 0;
    while let Some(byte) = rest.get(at) {
        let sign = matches!(byte, b'+' | b'-')
            && at > 0
            && matches!(rest.get(at - 1), Some(b'e' | b'E'))
            && !rest.starts_with(b"0x")
            && !rest.starts_with(b"0X");
        if !(is_word(*byte) || *byte == b'.' || sign) {
            break;
        }
        at += 1;
    }
    at
}

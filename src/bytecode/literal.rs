//! Tokens as text: hexadecimal numbers, and the initializers of arrays in C sources.

use super::macros::{self, Misfit};
use super::rules;
use crate::diagnostic::{Diagnostic, Span};

/// Words with where each stands in the text.
#[derive(Clone, Debug, Default)]
pub(super) struct Words {
    pub(super) words: Vec<u32>,
    pub(super) spans: Vec<Span>,
}

impl Words {
    fn push(&mut self, word: u32, span: Span) {
        self.words.push(word);
        self.spans.push(span);
    }
}

/// An array of a C source.
pub(super) struct Array {
    pub(super) name: String,
    pub(super) words: Words,
    pub(super) fault: Option<Diagnostic>,
}

/// A word of C, hexadecimal digits, or one sign.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Token<'a> {
    text: &'a [u8],
    start: usize,
}

impl Token<'_> {
    fn is(&self, sign: u8) -> bool {
        self.text == [sign]
    }

    fn name(&self) -> Option<&str> {
        let begins = self.text.first()?.is_ascii_alphabetic() || self.text.starts_with(b"_");
        std::str::from_utf8(self.text).ok().filter(|_| begins)
    }
}

/// Splits a text into tokens; comments, strings and lines of the preprocessor are passed over.
#[derive(Clone)]
struct Scanner<'a> {
    text: &'a [u8],
    at: usize,
    base: u32,
    /// Whether `;` begins a comment, as in listings.
    semicolons: bool,
}

impl<'a> Scanner<'a> {
    fn new(text: &'a [u8], base: u32, semicolons: bool) -> Self {
        let at = if text.starts_with(b"\xEF\xBB\xBF") {
            3
        } else {
            0
        };
        Self {
            text,
            at,
            base,
            semicolons,
        }
    }

    fn rest(&self) -> &'a [u8] {
        self.text.get(self.at..).unwrap_or(&[])
    }

    /// Goes behind the next of these bytes, or to the end.
    fn skip_past(&mut self, end: &[u8]) {
        let found = self.rest().windows(end.len()).position(|w| w == end);
        self.at = found.map_or(self.text.len(), |at| self.at + at + end.len());
    }

    fn span(&self, token: Token<'_>) -> Span {
        let start = self.base + token.start as u32;
        Span::new(start, start + token.text.len() as u32)
    }

    fn next(&mut self) -> Option<Token<'a>> {
        loop {
            let rest = self.rest();
            let first = *rest.first()?;
            match first {
                _ if first.is_ascii_whitespace() => self.at += 1,
                b';' if self.semicolons => self.skip_past(b"\n"),
                b'/' if rest.starts_with(b"//") => self.skip_past(b"\n"),
                b'/' if rest.starts_with(b"/*") => {
                    self.at += 2;
                    self.skip_past(b"*/");
                }
                b'#' => self.directive(),
                b'"' | b'\'' => self.string(first),
                _ => break,
            }
        }
        let (rest, start) = (self.rest(), self.at);
        let part = |b: &u8| b.is_ascii_alphanumeric() || *b == b'_';
        // The point of a number belongs to it, so that a float is one token that is none.
        let number = rest.first().is_some_and(u8::is_ascii_digit);
        let inside = |b: &u8| part(b) || number && *b == b'.';
        let length = rest.iter().take_while(|b| inside(b)).count().max(1);
        self.at += length;
        let text = rest.get(..length)?;
        Some(Token { text, start })
    }

    fn directive(&mut self) {
        loop {
            let start = self.at;
            self.skip_past(b"\n");
            let line = self
                .text
                .get(start..self.at)
                .unwrap_or(&[])
                .trim_ascii_end();
            if !line.ends_with(b"\\") || self.at == start {
                return;
            }
        }
    }

    fn string(&mut self, quote: u8) {
        self.at += 1;
        while let Some(&byte) = self.text.get(self.at) {
            self.at += if byte == b'\\' { 2 } else { 1 };
            // A string without end is none; it must not take the rest of the text with it.
            if byte == quote || byte == b'\n' {
                return;
            }
        }
    }
}

/// The token of a word of hexadecimal text: eight digits, or up to eight behind `0x`.
fn hexadecimal(text: &[u8]) -> Option<u32> {
    let text = std::str::from_utf8(text).ok()?;
    let behind = text.strip_prefix("0x").or_else(|| text.strip_prefix("0X"));
    let digits = match behind {
        Some(digits) => digits.trim_end_matches(['u', 'U', 'l', 'L']),
        None => text,
    };
    let fits = match behind {
        Some(_) => (1..=8).contains(&digits.len()),
        None => digits.len() == 8,
    };
    let all = digits.bytes().all(|b| b.is_ascii_hexdigit());
    u32::from_str_radix(digits, 16).ok().filter(|_| fits && all)
}

/// A number of C.
fn number(text: &[u8]) -> Option<u32> {
    if text.starts_with(b"0x") || text.starts_with(b"0X") {
        return hexadecimal(text);
    }
    let digits = std::str::from_utf8(text).ok()?;
    let digits = digits.trim_end_matches(['u', 'U', 'l', 'L']);
    let octal = digits.len() > 1 && digits.starts_with('0');
    let all = digits.bytes().all(|b| b.is_ascii_digit());
    let radix = if octal { 8 } else { 10 };
    u32::from_str_radix(digits, radix).ok().filter(|_| all)
}

/// What a text begins with.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Beginning {
    /// A hexadecimal token.
    Hex,
    /// A macro of a vertex declaration.
    Macro,
    Other,
}

/// What a text begins with, behind comments and an opening brace.
pub(super) fn beginning(text: &[u8]) -> Beginning {
    let mut scanner = Scanner::new(text, 0, true);
    let mut first = scanner.next();
    if first.is_some_and(|t| t.is(b'{')) {
        first = scanner.next();
    }
    match first {
        Some(t) if hexadecimal(t.text).is_some() => Beginning::Hex,
        Some(t) if t.text.starts_with(macros::PREFIX.as_bytes()) => Beginning::Macro,
        _ => Beginning::Other,
    }
}

/// Reads hexadecimal text: tokens with blanks, commas or braces between them.
pub(super) fn hex(text: &[u8], base: u32) -> (Words, Option<Diagnostic>) {
    let mut scanner = Scanner::new(text, base, true);
    let mut words = Words::default();
    while let Some(token) = scanner.next() {
        if matches!(token.text, b"," | b"{" | b"}") {
            continue;
        }
        let span = scanner.span(token);
        let Some(word) = hexadecimal(token.text) else {
            let fault = no_number(&words, token, span, "a token has eight hexadecimal digits");
            return (words, Some(fault));
        };
        words.push(word, span);
    }
    (words, None)
}

fn no_number(words: &Words, token: Token<'_>, span: Span, help: &str) -> Diagnostic {
    let text = String::from_utf8_lossy(token.text.get(..40).unwrap_or(token.text));
    let message = format!("token {}: `{text}` is no token", words.words.len());
    Diagnostic::error(&rules::TEXT, span, message).with_help(help)
}

/// Reads the elements of a declaration that stand in no array.
pub(super) fn elements(text: &[u8], base: u32) -> (Words, Option<Diagnostic>) {
    let mut scanner = Scanner::new(text, base, false);
    if let Some(first) = scanner.clone().next()
        && first.is(b'{')
    {
        scanner.next();
    }
    let mut words = Words::default();
    let fault = initializer(&mut scanner, &mut words).err();
    (words, fault)
}

/// The arrays of a C source that hold tokens: those whose first element is one with which a stream begins.
pub(super) fn arrays(text: &[u8], base: u32, begins: impl Fn(&[u32]) -> bool) -> Vec<Array> {
    /// How far `name[…] = {` was read.
    enum Read {
        Nothing,
        Name,
        Size,
        Sized,
        Equals,
    }
    let mut scanner = Scanner::new(text, base, false);
    let mut found = Vec::new();
    let mut name = "";
    let mut read = Read::Nothing;
    while let Some(token) = scanner.next() {
        read = match (read, token.text) {
            (Read::Name, b"[") => Read::Size,
            (Read::Size, b"]") => Read::Sized,
            (Read::Size, _) => Read::Size,
            (Read::Sized, b"=") => Read::Equals,
            (Read::Equals, b"{") => {
                let behind = scanner.clone();
                let mut words = Words::default();
                let fault = initializer(&mut scanner, &mut words).err();
                if begins(&words.words) {
                    let name = name.to_string();
                    found.push(Array { name, words, fault });
                } else {
                    scanner = behind;
                }
                Read::Nothing
            }
            _ => match std::str::from_utf8(token.text) {
                Ok(text) if token.name().is_some() => {
                    name = text;
                    Read::Name
                }
                _ => Read::Nothing,
            },
        };
    }
    found
}

/// Reads elements up to the closing brace or the end of the text.
fn initializer(scanner: &mut Scanner<'_>, words: &mut Words) -> Result<(), Diagnostic> {
    const HELP: &str =
        "an array of tokens holds whole numbers, and macros of d3d8types.h that make tokens";
    while let Some(token) = scanner.next() {
        let span = scanner.span(token);
        if token.is(b'}') || token.is(b';') {
            return Ok(());
        }
        match (number(token.text), token.name()) {
            (Some(word), _) => words.push(word, span),
            (None, Some(name)) if macros::named(name).is_some() => {
                let (word, span) = call(scanner, words, name, span)?;
                words.push(word, span);
            }
            _ => return Err(no_number(words, token, span, HELP)),
        }
        let Some(behind) = scanner.next() else {
            return Ok(());
        };
        if behind.is(b'}') || behind.is(b';') {
            return Ok(());
        }
        if !behind.is(b',') {
            let span = scanner.span(behind);
            return Err(no_number(
                words,
                behind,
                span,
                "a comma stands between two tokens",
            ));
        }
    }
    Ok(())
}

/// Reads the arguments of a macro; gives its token and where the whole stands.
fn call(
    scanner: &mut Scanner<'_>,
    words: &Words,
    name: &str,
    start: Span,
) -> Result<(u32, Span), Diagnostic> {
    const HELP: &str = "arguments are numbers, D3DVSDE_ registers and D3DVSDT_ types";
    let fault = |span: Span, message: String| {
        let message = format!("token {}: {message}", words.words.len());
        Diagnostic::error(&rules::TEXT, span, message)
    };
    let cut = || fault(start, format!("`{name}` stands without its arguments"));
    let open = scanner.next().filter(|t| t.is(b'(')).ok_or_else(cut)?;
    let mut arguments = Vec::new();
    let mut spans = Vec::new();
    let mut close = scanner.next().ok_or_else(cut)?;
    while !close.is(b')') {
        let span = scanner.span(close);
        let constant = close.name().and_then(macros::constant);
        let Some(argument) = number(close.text).or(constant) else {
            return Err(no_number(words, close, span, HELP));
        };
        // No macro takes more than two.
        if arguments.len() < 3 {
            arguments.push(argument);
            spans.push(span);
        }
        close = scanner.next().ok_or_else(cut)?;
        if close.is(b',') {
            close = scanner.next().ok_or_else(cut)?;
        }
    }
    let whole = start.to(scanner.span(open)).to(scanner.span(close));
    let Some(found) = macros::named(name) else {
        return Err(cut());
    };
    match found.token(&arguments) {
        Ok(token) => Ok((token, whole)),
        Err(Misfit::Count(count)) => {
            let s = if count == 1 { "" } else { "s" };
            let message = format!("`{}` takes {count} argument{s}", found.name());
            Err(fault(whole, message))
        }
        Err(Misfit::Argument(at, most)) => {
            let span = spans.get(at).copied().unwrap_or(whole);
            let message = format!("this argument of `{}` is at most {most}", found.name());
            Err(fault(span, message))
        }
    }
}

//! Streams in what people have: binary files, hexadecimal text, arrays in C sources.

use super::literal::{self, Beginning, Words};
use super::rules;
use super::{Declaration, END, HEX_LINE, MOST_TOKENS, to_hex};
use crate::diagnostic::{Diagnostic, SourceFile, SourceMap, Span, TooLarge, any_error};
use crate::isa::Version;
use crate::preprocess::scan::without_nul;
use crate::syntax;

/// How tokens are written in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Words of four bytes, the lowest first, as `.vso`, `.pso` and compiled `.vsh` and `.psh` have them.
    Binary,
    /// Hexadecimal text: eight digits a token, with or without `0x`, with blanks or commas between them.
    Hex,
    /// The elements of a vertex declaration: `D3DVSD_STREAM(0), D3DVSD_REG(0, D3DVSDT_FLOAT3), …, D3DVSD_END()`.
    Elements,
    /// A C source with arrays of tokens: `DWORD dwShader[] = { 0xffff0101, … };`.
    Arrays,
}

/// What a stream is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StreamKind {
    /// A shader.
    Shader,
    /// A vertex declaration.
    Declaration,
}

/// A stream with where each of its tokens stands.
#[derive(Clone, Debug)]
pub struct Stream {
    /// The name of the array that it stands in.
    pub name: Option<String>,
    /// What it is, as far as its first token tells.
    pub kind: StreamKind,
    /// Its tokens.
    pub words: Vec<u32>,
    /// What could not be read of it as words.
    pub(super) fault: Option<Diagnostic>,
    /// Where the tokens stand.
    spans: Vec<Span>,
}

/// The streams of a file.
#[derive(Clone, Debug)]
pub struct Input {
    /// How they are written.
    pub form: Form,
    /// The streams in order.
    pub streams: Vec<Stream>,
}

/// Says how tokens are written in a file; `None` if it holds none: a listing, or something else.
pub fn recognize(bytes: &[u8]) -> Option<Form> {
    if syntax::is_utf16(bytes) {
        return None;
    }
    if is_binary(bytes) {
        return Some(Form::Binary);
    }
    match literal::beginning(bytes) {
        Beginning::Hex => Some(Form::Hex),
        Beginning::Macro => Some(Form::Elements),
        Beginning::Other => {
            let any = !literal::arrays(bytes, 0, begins).is_empty();
            any.then_some(Form::Arrays)
        }
    }
}

/// Whether bytes are words and no text: they begin with a token that is a version or nearly, hold a zero, or end with the end
/// token. Texts were cut out of programs with zeros behind them.
fn is_binary(bytes: &[u8]) -> bool {
    let (words, extra) = bytes.as_chunks::<4>();
    let word = |bytes: &[u8; 4]| u32::from_le_bytes(*bytes);
    let version = words
        .first()
        .is_some_and(|first| matches!(word(first) >> 16, 0xFFFE | 0xFFFF));
    let ended = extra.is_empty() && words.last().is_some_and(|last| word(last) == END);
    let text = without_nul(bytes);
    version || ended || text.contains(&0) || (text.is_empty() && !bytes.is_empty())
}

/// Whether a token is a version, of whatever shader model.
fn is_version(word: u32) -> bool {
    matches!(word >> 16, 0xFFFE | 0xFFFF) && (1..=3).contains(&(word >> 8 & 0xFF))
}

/// Whether a stream begins with a version or as a vertex declaration.
fn begins(words: &[u32]) -> bool {
    words.first().is_some_and(|w| is_version(*w)) || Declaration::begins(words)
}

/// Finds the streams of a file and adds it to the sources, so that diagnostics can point into it. Of a binary file,
/// which has no lines, one token a line is added in hexadecimal digits.
///
/// `None`, and nothing is added, if the file holds no tokens: see [`recognize`].
///
/// # Errors
/// [`TooLarge`] if the file is longer than [`SourceMap::MAX_BYTES`]. Of a binary file only what a stream can have is
/// looked at, so that no file is too large.
pub fn read(sources: &mut SourceMap, name: &str, bytes: &[u8]) -> Result<Option<Input>, TooLarge> {
    let Some(form) = recognize(bytes) else {
        return Ok(None);
    };
    if form == Form::Binary {
        let stream = binary(sources, name, bytes)?;
        let streams = vec![stream];
        return Ok(Some(Input { form, streams }));
    }
    let base = sources.add(name, bytes)?.span().start;
    let streams = match form {
        Form::Arrays => {
            let arrays = literal::arrays(bytes, base, begins);
            let one =
                |array: literal::Array| Stream::of(Some(array.name), array.words, array.fault);
            arrays.into_iter().map(one).collect()
        }
        Form::Hex | Form::Binary => {
            let (words, fault) = literal::hex(bytes, base);
            vec![Stream::of(None, words, fault)]
        }
        Form::Elements => {
            let (words, fault) = literal::elements(bytes, base);
            vec![Stream::of(None, words, fault)]
        }
    };
    Ok(Some(Input { form, streams }))
}

/// Says that a file holds no tokens, at `span`, where it begins.
pub fn no_tokens(span: Span) -> Diagnostic {
    let message = "this holds no tokens";
    let help = "`dis` takes binary files, hexadecimal text and arrays in C sources (`asm` makes tokens of a listing)";
    Diagnostic::error(&rules::TEXT, span, message).with_help(help)
}

fn binary(sources: &mut SourceMap, name: &str, bytes: &[u8]) -> Result<Stream, TooLarge> {
    let (chunks, extra) = bytes.as_chunks::<4>();
    let chunks = chunks.get(..READ_TOKENS).unwrap_or(chunks);
    let words: Vec<u32> = chunks.iter().map(|c| u32::from_le_bytes(*c)).collect();
    let mut stream = Stream::of_words(sources, name, &words)?;
    if !extra.is_empty() {
        let s = if extra.len() == 1 { "" } else { "s" };
        let message = format!(
            "the file has {} byte{s} behind its last whole token",
            extra.len()
        );
        let help = "it may be cut short, or was written as text, which changes line ends";
        let end = sources
            .files()
            .last()
            .map_or(Span::default(), SourceFile::span);
        stream.fault =
            Some(Diagnostic::error(&rules::BYTES, end.at_end(), message).with_help(help));
    }
    Ok(stream)
}

/// How many tokens of a stream are looked at: one more than it may have, so that it is seen to be too long.
const READ_TOKENS: usize = MOST_TOKENS + 1;

impl Stream {
    /// The stream of these words. A text is added to the sources, so that diagnostics can point into it: one token a line, in
    /// hexadecimal digits. Whether it is a shader or a vertex declaration is told by its first token.
    ///
    /// # Errors
    /// [`TooLarge`] if the sources are full. Of a stream that is longer than [`MOST_TOKENS`] only the beginning is kept.
    pub fn of_words(sources: &mut SourceMap, name: &str, words: &[u32]) -> Result<Self, TooLarge> {
        let words = words.get(..READ_TOKENS).unwrap_or(words).to_vec();
        let file = sources.add(name, to_hex(&words))?.span();
        let line = |at: usize| {
            let start = file.start + (at * HEX_LINE) as u32;
            Span::new(start, start + HEX_LINE as u32 - 1)
        };
        let spans = (0..words.len()).map(line).collect();
        Ok(Self::of(None, Words { words, spans }, None))
    }

    fn of(name: Option<String>, words: Words, fault: Option<Diagnostic>) -> Self {
        let Words { words, spans } = words;
        let known = words.first().copied().and_then(Version::from_token);
        let kind = match known.is_none() && Declaration::begins(&words) {
            true => StreamKind::Declaration,
            false => StreamKind::Shader,
        };
        Self {
            name,
            kind,
            words,
            fault,
            spans,
        }
    }

    /// Where a span of tokens lies in the sources.
    pub fn place(&self, tokens: Span) -> Span {
        let end = || {
            self.spans
                .last()
                .map_or(Span::default(), |last| last.at_end())
        };
        let first = self.spans.get(tokens.start as usize);
        let last = (tokens.end as usize).checked_sub(1);
        let last = last.and_then(|last| self.spans.get(last));
        match (first, last) {
            (Some(first), Some(last)) => first.to(*last),
            (Some(first), None) => *first,
            _ => end(),
        }
    }

    /// Diagnostics of tokens, in their places in the sources.
    pub fn placed(&self, diagnostics: Vec<Diagnostic>) -> Vec<Diagnostic> {
        let place = |mut diagnostic: Diagnostic| {
            diagnostic.span = self.place(diagnostic.span);
            diagnostic
        };
        diagnostics.into_iter().map(place).collect()
    }

    /// What is said of its tokens, in its places, with what could not be read as tokens.
    pub(super) fn with_fault(&self, reports: Vec<Diagnostic>) -> Vec<Diagnostic> {
        let mut diagnostics = self.placed(reports);
        match &self.fault {
            // What follows from words that could not be read is not told again.
            Some(fault) if fault.rule.id == rules::TEXT.id => diagnostics = vec![fault.clone()],
            Some(fault) if !any_error(&diagnostics) => diagnostics.push(fault.clone()),
            _ => {}
        }
        diagnostics
    }

    /// The stream as a vertex declaration, or as a piece of one, with everything that is wrong with it, in its places.
    pub fn decode_fragment(&self) -> (Declaration, Vec<Diagnostic>) {
        let (declaration, reports) = Declaration::decode_fragment(&self.words);
        (declaration, self.with_fault(reports))
    }
}

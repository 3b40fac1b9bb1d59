//! Texts and places in them.

use super::origin::{Derivation, Origin};
use std::borrow::Cow;
use std::fmt;
use std::sync::{Arc, OnceLock};

/// A half-open range of bytes in the common address space of a [`SourceMap`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Span {
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
}

impl Span {
    /// The range `start..end`.
    pub const fn new(start: u32, end: u32) -> Self {
        Self { start, end }
    }

    /// The smallest span that holds both.
    #[must_use]
    pub fn to(self, other: Span) -> Span {
        Span::new(self.start.min(other.start), self.end.max(other.end))
    }

    /// The empty span at the start of this one.
    #[must_use]
    pub fn at_start(self) -> Span {
        Span::new(self.start, self.start)
    }

    /// The empty span at the end of this one.
    #[must_use]
    pub fn at_end(self) -> Span {
        Span::new(self.end, self.end)
    }
}

/// A text is larger than a [`SourceMap`] takes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TooLarge {
    /// The text's name.
    pub name: String,
    /// Its length in bytes.
    pub length: u64,
}

impl fmt::Display for TooLarge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{}: {} bytes are more than a listing can have (at most {} bytes are read)",
            self.name,
            self.length,
            SourceMap::MAX_BYTES
        )
    }
}

impl std::error::Error for TooLarge {}

/// One text.
///
/// Texts are bytes: listings of the time hold comments in legacy code pages.
#[derive(Clone, Debug)]
pub struct SourceFile {
    name: String,
    pub(super) bytes: Arc<[u8]>,
    pub(super) base: u32,
    /// Where its lines begin: looked for when somebody asks, which of most texts nobody does.
    line_starts: OnceLock<Vec<u32>>,
    pub(super) origin: Origin,
}

impl SourceFile {
    /// The name it was added under.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The text.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// The text, to be kept while others are added.
    pub(crate) fn shared_bytes(&self) -> Arc<[u8]> {
        Arc::clone(&self.bytes)
    }

    /// The span of the whole text.
    pub fn span(&self) -> Span {
        Span::new(self.base, self.base + self.bytes.len() as u32)
    }

    fn line_starts(&self) -> &[u32] {
        self.line_starts.get_or_init(|| {
            let newlines = self.bytes.iter().enumerate().filter(|(_, b)| **b == b'\n');
            std::iter::once(0)
                .chain(newlines.map(|(i, _)| i as u32 + 1))
                .collect()
        })
    }

    /// The bytes of line `line` (from 1), without its line end; empty if there is no such line.
    pub fn line(&self, line: usize) -> &[u8] {
        let starts = self.line_starts();
        let Some(&start) = line.checked_sub(1).and_then(|i| starts.get(i)) else {
            return &[];
        };
        let end = starts
            .get(line)
            .map_or(self.bytes.len(), |&next| next as usize);
        let text = self.bytes.get(start as usize..end).unwrap_or(&[]);
        let text = text.strip_suffix(b"\n").unwrap_or(text);
        text.strip_suffix(b"\r").unwrap_or(text)
    }

    /// Offset of the first byte of line `line` (from 1) within this text.
    pub fn line_start(&self, line: usize) -> u32 {
        line.checked_sub(1)
            .and_then(|i| self.line_starts().get(i))
            .copied()
            .unwrap_or(self.bytes.len() as u32)
    }

    /// The line (from 1) that holds the byte at this offset within the text; the last one behind the end.
    pub fn line_at(&self, offset: u32) -> usize {
        let offset = offset.min(self.bytes.len() as u32);
        self.line_starts().partition_point(|&start| start <= offset)
    }

    fn location(&self, offset: u32) -> (usize, usize) {
        let offset = offset.min(self.bytes.len() as u32);
        let line = self.line_at(offset);
        let start = self.line_start(line);
        let before = self
            .bytes
            .get(start as usize..offset as usize)
            .unwrap_or(&[]);
        (line, text_of(before).chars().count() + 1)
    }
}

/// A place for people: a file, a line and a column, both from 1; columns count characters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Location<'a> {
    /// The text's name.
    pub file: &'a str,
    /// First line of the span.
    pub line: usize,
    /// First column of the span.
    pub column: usize,
    /// Line of the end of the span.
    pub end_line: usize,
    /// Column one past the end of the span.
    pub end_column: usize,
}

/// The texts of one run, laid one after the other in a common address space, so that a [`Span`] names its text too.
#[derive(Clone, Debug, Default)]
pub struct SourceMap {
    files: Vec<SourceFile>,
}

impl SourceMap {
    /// The longest text that is taken. The longest listings known have some hundred lines.
    pub const MAX_BYTES: usize = 4 << 20;

    /// An empty map.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a text.
    ///
    /// # Errors
    /// [`TooLarge`] if the text has more than [`Self::MAX_BYTES`] bytes, or all together leave the address space.
    pub fn add(
        &mut self,
        name: impl Into<String>,
        bytes: impl Into<Vec<u8>>,
    ) -> Result<&SourceFile, TooLarge> {
        self.add_from(name.into(), bytes.into(), Origin::Written)
    }

    /// Adds a text that another one includes at `at`.
    ///
    /// # Errors
    /// As [`Self::add`].
    pub fn add_included(
        &mut self,
        name: impl Into<String>,
        bytes: impl Into<Vec<u8>>,
        at: Span,
    ) -> Result<&SourceFile, TooLarge> {
        self.add_from(name.into(), bytes.into(), Origin::Included(at))
    }

    /// Adds a text that was made of texts of this map. Its places are told as those of what it was made of.
    ///
    /// # Errors
    /// As [`Self::add`].
    pub fn add_derived(
        &mut self,
        name: impl Into<String>,
        bytes: impl Into<Vec<u8>>,
        derivation: Derivation,
    ) -> Result<&SourceFile, TooLarge> {
        self.add_from(name.into(), bytes.into(), Origin::Derived(derivation))
    }

    fn add_from(
        &mut self,
        name: String,
        bytes: Vec<u8>,
        origin: Origin,
    ) -> Result<&SourceFile, TooLarge> {
        // One byte lies between two texts, so that an empty span at the end of one is not the start of the next.
        let base = self.files.last().map_or(0, |f| f.span().end + 1);
        if bytes.len() > Self::MAX_BYTES || u64::from(base) + bytes.len() as u64 >= u32::MAX.into()
        {
            let length = bytes.len() as u64;
            return Err(TooLarge { name, length });
        }
        let at = self.files.len();
        self.files.push(SourceFile {
            name,
            bytes: bytes.into(),
            base,
            line_starts: OnceLock::new(),
            origin,
        });
        Ok(&self.files[at])
    }

    /// All texts in the order in which they were added.
    pub fn files(&self) -> &[SourceFile] {
        &self.files
    }

    /// The text that holds this offset.
    pub fn file_of(&self, offset: u32) -> Option<&SourceFile> {
        self.files.get(self.number_of(offset)?)
    }

    pub(super) fn number_of(&self, offset: u32) -> Option<usize> {
        let behind = self.files.partition_point(|f| f.base <= offset);
        behind.checked_sub(1)
    }

    /// Where a span was [written](Self::written), for people. `None` only if the map is empty.
    pub fn locate(&self, span: Span) -> Option<Location<'_>> {
        let span = self.written(span);
        let file = self.file_of(span.start)?;
        let (line, column) = file.location(span.start - file.base);
        let (end_line, end_column) = file.location(span.end.max(span.start) - file.base);
        Some(Location {
            file: &file.name,
            line,
            column,
            end_line,
            end_column,
        })
    }

    /// The text of a span as it was read, unreadable bytes replaced: of a derived text what it says, not what it was
    /// made of.
    pub fn text(&self, span: Span) -> Cow<'_, str> {
        text_of(self.bytes(span))
    }

    /// The bytes of a span; empty if it lies in no text.
    pub fn bytes(&self, span: Span) -> &[u8] {
        let bytes = self.file_of(span.start).and_then(|f| {
            let range =
                (span.start - f.base) as usize..(span.end.max(span.start) - f.base) as usize;
            f.bytes.get(range)
        });
        bytes.unwrap_or(&[])
    }
}

/// Bytes as text; what is not UTF-8 is shown as U+FFFD.
fn text_of(bytes: &[u8]) -> Cow<'_, str> {
    String::from_utf8_lossy(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_counted_from_one_and_in_characters() {
        let mut map = SourceMap::new();
        map.add("a", "ps.1.4\r\n; \u{e4}\u{e4} x\n").unwrap();
        map.add("b", "mov").unwrap();
        let base = map.files()[1].span().start;
        let x = map.locate(Span::new(15, 16)).unwrap();
        assert_eq!((x.file, x.line, x.column, x.end_column), ("a", 2, 6, 7));
        let m = map.locate(Span::new(base, base + 3)).unwrap();
        assert_eq!((m.file, m.line, m.column, m.end_column), ("b", 1, 1, 4));
        assert_eq!(map.text(Span::new(base, base + 3)), "mov");
        assert_eq!(map.files()[0].line(1), b"ps.1.4");
        assert_eq!(map.files()[0].line(3), b"");
        assert_eq!(map.files()[0].line(9), b"");
    }

    #[test]
    fn a_text_that_is_no_listing_is_refused() {
        let mut map = SourceMap::new();
        assert!(map.add("big", vec![0; SourceMap::MAX_BYTES + 1]).is_err());
        assert!(map.add("fits", vec![0; SourceMap::MAX_BYTES]).is_ok());
    }
}

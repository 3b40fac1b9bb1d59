//! Places in texts as the protocol counts them: lines from 0, and in lines units of an encoding.

use serde::{Deserialize, Serialize};

/// A place between two characters.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize,
)]
pub(super) struct Position {
    pub line: u32,
    pub character: u32,
}

/// From one place to another.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub(super) struct Range {
    pub start: Position,
    pub end: Position,
}

/// In what the characters of a line are counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Encoding {
    Utf8,
    #[default]
    Utf16,
    Utf32,
}

impl Encoding {
    /// The encoding of this name in the protocol.
    pub(super) fn named(name: &str) -> Option<Self> {
        let all = [Self::Utf8, Self::Utf16, Self::Utf32];
        all.into_iter().find(|encoding| encoding.name() == name)
    }

    /// Its name in the protocol.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Utf8 => "utf-8",
            Self::Utf16 => "utf-16",
            Self::Utf32 => "utf-32",
        }
    }

    fn width(self, character: char) -> u32 {
        match self {
            Self::Utf8 => character.len_utf8() as u32,
            Self::Utf16 => character.len_utf16() as u32,
            Self::Utf32 => 1,
        }
    }
}

/// Part of a line, from a character on.
#[derive(Clone, Copy, Debug)]
struct Mark {
    /// Its first byte in the text.
    start: u32,
    line: u32,
    /// What stands before it in its line, in units of the encoding.
    column: u32,
}

/// The lines of a text.
///
/// Lines end where the protocol says: `\n`, `\r\n`, `\r`. Texts of files may hold bytes that are no UTF-8; each run of them
/// that a reader would show as U+FFFD counts as that.
#[derive(Clone, Debug)]
pub(super) struct Lines {
    encoding: Encoding,
    /// One for each line and for each so many bytes of a long one, so that no place takes long to find.
    marks: Vec<Mark>,
    length: u32,
}

/// How many bytes of a line are counted for one place at most, but for a character.
const STRIDE: usize = 1024;

impl Lines {
    pub(super) fn new(text: &[u8], encoding: Encoding) -> Self {
        let mut marks = vec![Mark {
            start: 0,
            line: 0,
            column: 0,
        }];
        let (mut line, mut column, mut at, mut since) = (0, 0, 0, 0);
        let mut after_return = false;
        for (character, length) in characters(text) {
            let new_line = match character {
                // The end of the line began with the byte before.
                '\n' if after_return => {
                    if let Some(last) = marks.last_mut() {
                        last.start += 1;
                    }
                    after_return = false;
                    at += 1;
                    since = at;
                    continue;
                }
                '\n' | '\r' => true,
                _ => false,
            };
            after_return = character == '\r';
            at += length;
            if new_line {
                line += 1;
                column = 0;
            } else {
                column += encoding.width(character);
            }
            if new_line || at - since >= STRIDE {
                since = at;
                marks.push(Mark {
                    start: at as u32,
                    line,
                    column,
                });
            }
        }
        Self {
            encoding,
            marks,
            length: text.len() as u32,
        }
    }

    /// In what columns are counted.
    pub(super) fn encoding(&self) -> Encoding {
        self.encoding
    }

    /// The place of a byte.
    pub(super) fn position(&self, text: &[u8], offset: usize) -> Position {
        let offset = offset.min(self.length as usize);
        let at = (self.marks).partition_point(|mark| mark.start as usize <= offset);
        let Some(mark) = at.checked_sub(1).and_then(|at| self.marks.get(at)) else {
            return Position::default();
        };
        let before = text.get(mark.start as usize..offset).unwrap_or(&[]);
        let counted = characters(before).filter(|(c, _)| !matches!(c, '\r' | '\n'));
        let width: u32 = counted.map(|(c, _)| self.encoding.width(c)).sum();
        Position {
            line: mark.line,
            character: mark.column + width,
        }
    }

    /// The places of a range of bytes.
    pub(super) fn range(&self, text: &[u8], range: &std::ops::Range<usize>) -> Range {
        Range {
            start: self.position(text, range.start),
            end: self.position(text, range.end),
        }
    }

    /// The byte at a place; behind the end of a line that of its end, behind the text that of its end.
    pub(super) fn offset(&self, text: &[u8], position: Position) -> usize {
        let before = |mark: &Mark| (mark.line, mark.column) <= (position.line, position.character);
        let at = self.marks.partition_point(before);
        let Some(mark) = at.checked_sub(1).and_then(|at| self.marks.get(at)) else {
            return 0;
        };
        if mark.line < position.line {
            return self.length as usize;
        }
        let mut at = mark.start as usize;
        let mut column = mark.column;
        for (character, length) in characters(text.get(at..).unwrap_or(&[])) {
            let width = self.encoding.width(character);
            if matches!(character, '\r' | '\n') || column + width > position.character {
                break;
            }
            at += length;
            column += width;
        }
        at
    }
}

/// The characters of bytes with how many bytes each has; U+FFFD for those that are no UTF-8.
fn characters(text: &[u8]) -> impl Iterator<Item = (char, usize)> + '_ {
    text.utf8_chunks().flat_map(|chunk| {
        let lost = Some((char::REPLACEMENT_CHARACTER, chunk.invalid().len()));
        let valid = chunk.valid().chars().map(|c| (c, c.len_utf8()));
        valid.chain(lost.filter(|(_, length)| *length > 0))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(line: u32, character: u32) -> Position {
        Position { line, character }
    }

    #[test]
    fn columns_are_counted_in_the_encoding() {
        // ä has two bytes and one unit of UTF-16, 😀 four and two.
        let text = "a\u{e4}\u{1f600}b\nc".as_bytes();
        for (encoding, column) in [
            (Encoding::Utf8, 7),
            (Encoding::Utf16, 4),
            (Encoding::Utf32, 3),
        ] {
            let lines = Lines::new(text, encoding);
            assert_eq!(lines.position(text, 7), at(0, column));
            assert_eq!(lines.offset(text, at(0, column)), 7);
            assert_eq!(lines.position(text, 9), at(1, 0));
            assert_eq!(lines.offset(text, at(1, 0)), 9);
        }
        // Within a character is before it.
        let lines = Lines::new(text, Encoding::Utf16);
        assert_eq!(lines.offset(text, at(0, 3)), 3);
    }

    #[test]
    fn all_ends_of_lines_are_ends() {
        let text = b"a\r\nb\rc\nd";
        let lines = Lines::new(text, Encoding::Utf16);
        for (offset, place) in [
            (0, at(0, 0)),
            (1, at(0, 1)),
            (3, at(1, 0)),
            (5, at(2, 0)),
            (7, at(3, 0)),
            (8, at(3, 1)),
        ] {
            assert_eq!(lines.position(text, offset), place);
            assert_eq!(lines.offset(text, place), offset);
        }
        // Between the two bytes of a line end is the end of the line.
        assert_eq!(lines.position(text, 2), at(0, 1));
        // What is too far is the end of the line, or of the text.
        assert_eq!(lines.offset(text, at(0, 99)), 1);
        assert_eq!(lines.offset(text, at(1, 99)), 4);
        assert_eq!(lines.offset(text, at(9, 0)), 8);
    }

    #[test]
    fn bytes_of_other_encodings_count_as_what_is_shown_for_them() {
        let text = b"\xe4\xe4 x";
        let lines = Lines::new(text, Encoding::Utf16);
        assert_eq!(lines.position(text, 3), at(0, 3));
        assert_eq!(lines.offset(text, at(0, 3)), 3);
    }

    #[test]
    fn long_lines_are_found_by_their_parts() {
        let text = "\u{e4}".repeat(5000);
        let text = text.as_bytes();
        let lines = Lines::new(text, Encoding::Utf16);
        assert_eq!(lines.position(text, 8002), at(0, 4001));
        assert_eq!(lines.offset(text, at(0, 4001)), 8002);
        assert_eq!(lines.offset(text, at(0, 70000)), 10000);
        assert_eq!(lines.offset(text, at(1, 0)), 10000);
    }

    #[test]
    fn an_empty_text_has_one_line() {
        let lines = Lines::new(b"", Encoding::Utf8);
        assert_eq!(lines.position(b"", 7), at(0, 0));
        assert_eq!(lines.offset(b"", at(3, 3)), 0);
    }
}

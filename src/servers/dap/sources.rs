//! The texts of a program as the client knows them: files by path, what is in no file by number.

use super::client::Client;
use super::protocol::{
    Answer, Handled, LoadedSources, Range, Refusal, Source, SourceArguments, SourceText,
};
use std::path::{Path, PathBuf};
use texcrd::debug::Listing;
use texcrd::diagnostic::{Location, SourceFile, SourceMap, Span};

/// The texts of a [`SourceMap`], in its order.
pub(super) struct Sources<'a> {
    map: &'a SourceMap,
    files: Vec<File>,
}

/// What the client knows a text by.
struct File {
    source: Source,
    /// The file on disk, links followed; `None` if the text is in none.
    key: Option<PathBuf>,
}

/// A text as breakpoints remember it beyond a restart.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Key {
    /// A file on disk.
    File(PathBuf),
    /// Text number so-and-so of the program.
    Number(i64),
}

impl Key {
    /// The text that a client means; `None` if it means none.
    pub(super) fn of(source: &Source) -> Option<Self> {
        match (source.source_reference, &source.path) {
            (Some(number), _) if number > 0 => Some(Self::Number(number)),
            (_, Some(path)) => {
                let path = Path::new(path);
                let real = std::fs::canonicalize(path);
                Some(Self::File(real.unwrap_or_else(|_| path.to_path_buf())))
            }
            _ => None,
        }
    }
}

impl<'a> Sources<'a> {
    pub(super) fn new(map: &'a SourceMap) -> Self {
        let files = map.files().iter().enumerate();
        let files = files.map(|(i, file)| File::new(i, file.name())).collect();
        Self { map, files }
    }

    /// The text of the map that is meant.
    pub(super) fn find(&self, key: &Key) -> Option<&'a SourceFile> {
        let number = match key {
            Key::File(path) => {
                let is_it = |file: &File| file.key.as_ref() == Some(path);
                self.files.iter().position(is_it)?
            }
            Key::Number(number) => usize::try_from(number - 1).ok()?,
        };
        self.map.files().get(number)
    }

    /// The text that a span lies in, as the client knows it.
    pub(super) fn source(&self, span: Span) -> Option<Source> {
        let file = self.map.file_of(span.start)?;
        let same = |other: &SourceFile| other.span() == file.span();
        let number = self.map.files().iter().position(same)?;
        Some(self.files.get(number)?.source.clone())
    }

    /// Where a span lies, in the client's counting.
    pub(super) fn range(&self, span: Span, client: &Client) -> Range {
        let (Some(file), Some(at)) = (self.map.file_of(span.start), self.map.locate(span)) else {
            return Range::default();
        };
        let Location {
            line,
            column,
            end_line,
            end_column,
            ..
        } = at;
        Range {
            line: client.line(line),
            column: client.column(units(file, line, column)),
            end_line: client.line(end_line),
            end_column: client.column(units(file, end_line, end_column)),
        }
    }

    /// The instructions of a listing that stand in a text: line, number, span.
    pub(super) fn instructions<'l>(
        &'l self,
        listing: &'l Listing<'_>,
        text: &'l SourceFile,
    ) -> impl Iterator<Item = (usize, usize, Span)> + 'l {
        let inside = |span: Span| (text.span().start..=text.span().end).contains(&span.start);
        let instructions = listing.program.instructions().enumerate();
        instructions
            .filter(move |(_, i)| inside(i.span))
            .filter_map(|(number, i)| Some((self.map.locate(i.span)?.line, number, i.span)))
    }

    /// `loadedSources`
    pub(super) fn loaded(&self) -> Handled {
        let sources = self.files.iter().map(|file| file.source.clone()).collect();
        Ok(Answer::of(&LoadedSources { sources }))
    }

    /// `source`
    pub(super) fn text(&self, arguments: &SourceArguments) -> Handled {
        let asked = Source {
            source_reference: Some(arguments.source_reference),
            ..arguments.source.clone().unwrap_or_default()
        };
        let found = Key::of(&asked).and_then(|key| self.find(&key));
        let file = found.ok_or_else(|| Refusal::request("there is no such text"))?;
        Ok(Answer::of(&SourceText {
            content: String::from_utf8_lossy(file.bytes()).into_owned(),
            mime_type: "text/plain",
        }))
    }
}

impl File {
    fn new(number: usize, name: &str) -> Self {
        let on_disk = std::fs::canonicalize(name).ok().filter(|key| key.is_file());
        let Some(key) = on_disk else {
            let source = Source {
                name: Some(name.to_string()),
                path: None,
                source_reference: Some(number as i64 + 1),
            };
            return Self { source, key: None };
        };
        // Not the key: a person should see the path as they write it, on Windows without `\\?\`.
        let path = std::path::absolute(name).unwrap_or_else(|_| key.clone());
        let short = path
            .file_name()
            .map(|name| name.to_string_lossy().into_owned());
        let source = Source {
            name: Some(short.unwrap_or_else(|| name.to_string())),
            path: Some(path.to_string_lossy().into_owned()),
            source_reference: None,
        };
        Self {
            source,
            key: Some(key),
        }
    }
}

/// A column that counts characters as one that counts the protocol's units, those of UTF-16; both from 1.
fn units(file: &SourceFile, line: usize, column: usize) -> usize {
    let text = String::from_utf8_lossy(file.line(line));
    let before = text.chars().take(column.saturating_sub(1));
    before.map(char::len_utf16).sum::<usize>() + 1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_count_units_of_utf_16() {
        let mut map = SourceMap::new();
        // U+1D11E takes four bytes, two units; ä two bytes, one unit.
        map.add("x", "/*\u{1d11e}ä*/ mov r0, c0").unwrap();
        let sources = Sources::new(&map);
        let client = Client::new(&Default::default()).unwrap();
        let range = sources.range(Span::new(11, 14), &client);
        assert_eq!((range.column, range.end_column), (9, 12));
        let source = sources.source(Span::new(11, 14)).unwrap();
        assert_eq!((source.path, source.source_reference), (None, Some(1)));
    }
}

//! The documents that the client has open: their texts as it has them, saved or not.

use super::message::Refusal;
use super::text::{Encoding, Lines, Range};
use super::uri;
use serde::Deserialize;
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// What all open documents may hold together, in bytes. The text of one that does not fit is not kept.
const MOST_BYTES: usize = 256 << 20;

/// What the changes of one notification may have to move, in bytes.
const MOST_MOVED: usize = 1 << 30;

/// A document with its text.
#[derive(Clone, Debug)]
pub(super) struct Document {
    pub uri: String,
    /// Where it lies, if it is a file.
    pub path: Option<PathBuf>,
    /// The client's name of its language.
    pub language: String,
    /// The client's number of the text.
    pub version: i64,
    pub text: String,
    pub lines: Lines,
    /// Whether changes got lost, so that the text is not the client's any more.
    pub lost: bool,
}

impl Document {
    /// The ending of its name, in small letters.
    pub(super) fn extension(&self) -> String {
        let name = self.uri.rsplit('/').next().unwrap_or_default();
        let ending = name.rsplit_once('.').map_or("", |(_, ending)| ending);
        ending.to_ascii_lowercase()
    }

    /// What it is called: its path, or its address.
    pub(super) fn name(&self) -> String {
        let path = self.path.as_ref().map(|path| path.display().to_string());
        path.unwrap_or_else(|| self.uri.clone())
    }
}

/// A document as `textDocument/didOpen` gives it.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Opened {
    uri: String,
    #[serde(default)]
    language_id: String,
    #[serde(default)]
    version: i64,
    text: String,
}

impl Opened {
    pub(super) fn uri(&self) -> &str {
        &self.uri
    }
}

/// A change as `textDocument/didChange` gives it.
#[derive(Debug, Deserialize)]
pub(super) struct Change {
    /// What is replaced; all of the text if it is left out.
    range: Option<Range>,
    text: String,
}

/// All documents that are open, by their addresses.
#[derive(Debug, Default)]
pub(super) struct Documents {
    open: HashMap<String, Document>,
    by_path: HashMap<PathBuf, String>,
    bytes: usize,
    pub encoding: Encoding,
}

impl Documents {
    pub(super) fn get(&self, uri: &str) -> Option<&Document> {
        self.open.get(uri)
    }

    /// The open document at a path.
    pub(super) fn at(&self, path: &Path) -> Option<&Document> {
        let document = self.get(self.by_path.get(&uri::plain(path))?)?;
        Some(document).filter(|document| !document.lost)
    }

    pub(super) fn uris(&self) -> impl Iterator<Item = &str> {
        self.open.keys().map(String::as_str)
    }

    /// Takes a document; one that is open already is replaced.
    pub(super) fn open(&mut self, opened: Opened) {
        self.close(&opened.uri);
        let path = uri::path_of(&opened.uri);
        if let Some(path) = &path {
            self.by_path.insert(uri::plain(path), opened.uri.clone());
        }
        let document = Document {
            path,
            language: opened.language_id,
            version: opened.version,
            text: String::new(),
            lines: Lines::new(b"", self.encoding),
            lost: false,
            uri: opened.uri.clone(),
        };
        self.open.insert(opened.uri.clone(), document);
        self.set(&opened.uri, opened.text);
    }

    /// Gives a document another text.
    fn set(&mut self, uri: &str, text: String) {
        let Some(document) = self.open.get_mut(uri) else {
            return;
        };
        self.bytes -= document.text.len();
        document.lost = self.bytes.saturating_add(text.len()) > MOST_BYTES;
        document.text = if document.lost { String::new() } else { text };
        document.lines = Lines::new(document.text.as_bytes(), self.encoding);
        self.bytes += document.text.len();
    }

    /// Applies changes, one after the other.
    ///
    /// # Errors
    /// There is no such document, or they are too much work; its text is lost then until it is sent whole.
    pub(super) fn change(
        &mut self,
        uri: &str,
        version: i64,
        changes: Vec<Change>,
    ) -> Result<(), Refusal> {
        let mut moved = 0;
        for change in changes {
            let document = self.open.get_mut(uri);
            let document = document.ok_or_else(|| Refusal::failed(format!("{uri} is not open")))?;
            document.version = version;
            let Some(range) = change.range else {
                self.set(uri, change.text);
                continue;
            };
            if document.lost {
                continue;
            }
            let place = |position| document.lines.offset(document.text.as_bytes(), position);
            let (a, b) = (place(range.start), place(range.end));
            let (start, end) = (a.min(b), a.max(b));
            moved += document.text.len() + change.text.len();
            let mut text = std::mem::take(&mut document.text);
            self.bytes -= text.len();
            // Places are never within a character.
            if moved > MOST_MOVED || !(text.is_char_boundary(start) && text.is_char_boundary(end)) {
                document.lost = true;
                let why = format!(
                    "{uri}: these changes are too much at once; close it and open it again"
                );
                return Err(Refusal::failed(why));
            }
            text.replace_range(start..end, &change.text);
            self.set(uri, text);
        }
        Ok(())
    }

    /// Forgets a document.
    pub(super) fn close(&mut self, uri: &str) {
        let Some(document) = self.open.remove(uri) else {
            return;
        };
        self.bytes -= document.text.len();
        if let Some(path) = &document.path {
            self.by_path.remove(&uri::plain(path));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::text::Position;
    use super::*;

    fn opened(text: &str) -> Documents {
        let mut documents = Documents::default();
        documents.open(Opened {
            uri: "file:///a.psh".into(),
            language_id: "d3d8asm".into(),
            version: 1,
            text: text.into(),
        });
        documents
    }

    fn change(range: Option<[u32; 4]>, text: &str) -> Change {
        let at = |line, character| Position { line, character };
        Change {
            range: range.map(|[a, b, c, d]| Range {
                start: at(a, b),
                end: at(c, d),
            }),
            text: text.into(),
        }
    }

    #[test]
    fn changes_come_one_after_the_other_in_units_of_the_encoding() {
        let mut documents = opened("ps.1.1 ; \u{1f600}\u{e4}\r\nmov r0, v0");
        let changes = vec![
            change(Some([0, 11, 0, 12]), "o"),
            change(Some([1, 0, 1, 3]), "add"),
            change(Some([1, 10, 9, 9]), ", v1\n"),
        ];
        documents.change("file:///a.psh", 2, changes).unwrap();
        let document = documents.get("file:///a.psh").unwrap();
        assert_eq!(document.text, "ps.1.1 ; \u{1f600}o\r\nadd r0, v0, v1\n");
        assert_eq!(document.version, 2);
        documents
            .change("file:///a.psh", 3, vec![change(None, "vs.1.1")])
            .unwrap();
        assert_eq!(documents.get("file:///a.psh").unwrap().text, "vs.1.1");
        assert_eq!(documents.bytes, 6);
    }

    #[test]
    fn ranges_that_there_are_not_do_no_harm() {
        let mut documents = opened("ab\ncd");
        let far = u32::MAX;
        let changes = vec![
            change(Some([1, 1, 0, 1]), "-"),
            change(Some([far, far, far, far]), "!"),
        ];
        documents.change("file:///a.psh", 2, changes).unwrap();
        assert_eq!(documents.get("file:///a.psh").unwrap().text, "a-d!");
        assert!(
            documents
                .change("file:///b.psh", 1, vec![change(None, "")])
                .is_err()
        );
    }

    #[test]
    fn open_documents_are_found_by_path_and_forgotten_when_closed() {
        let mut documents = opened("x");
        let path = Path::new("/shaders/../a.psh");
        assert_eq!(
            documents.at(path).map(|d| d.text.as_str()),
            Some("x").filter(|_| cfg!(unix))
        );
        documents.close("file:///a.psh");
        assert!(documents.at(path).is_none());
        assert_eq!((documents.bytes, documents.uris().count()), (0, 0));
    }
}

//! The lines of the listing as comments.

use super::Stage;
use crate::diagnostic::{SourceFile, Span};

/// The longest line that is quoted, in characters; what is longer ends in `…`.
const LONGEST: usize = 160;

/// Gives out the lines of a listing once and in their order.
pub(super) struct Lines<'a> {
    file: Option<&'a SourceFile>,
    /// The next line that has not been given out, from 1.
    next: usize,
    /// The last line of the shader.
    last: usize,
    stage: &'a Stage<'a>,
}

impl<'a> Lines<'a> {
    pub(super) fn new(stage: &'a Stage<'a>) -> Self {
        let span = stage.program.span;
        let file = stage.source.file_of(span.start);
        let lines = stage.source.locate(span).map_or((1, 0), |l| {
            // A shader that ends with a line end does not reach into the next line.
            (
                l.line,
                l.end_line - usize::from(l.end_column == 1 && l.end_line > l.line),
            )
        });
        Self {
            file,
            next: lines.0,
            last: lines.1,
            stage,
        }
    }

    /// The name of the listing.
    pub(super) fn name(&self) -> String {
        self.file
            .map_or(String::new(), |file| readable(file.name().as_bytes()))
    }

    /// Comments for the line on which a statement begins and for all lines before it that were not given out yet.
    pub(super) fn up_to(&mut self, statement: Span) -> Vec<String> {
        let Some(location) = self.stage.source.locate(statement) else {
            return Vec::new();
        };
        let here = self.stage.source.file_of(statement.start);
        if here.map(SourceFile::span) == self.file.map(SourceFile::span) {
            return self.until(location.end_line.max(location.line));
        }
        // The statement came from another text, a file that was included for example.
        let text = readable(here.map_or(&[][..], |file| file.line(location.line)));
        vec![format!(
            "// {}:{}: {text}",
            readable(location.file.as_bytes()),
            location.line
        )]
    }

    /// Comments for the lines behind the last statement.
    pub(super) fn rest(&mut self) -> Vec<String> {
        self.until(self.last)
    }

    fn until(&mut self, last: usize) -> Vec<String> {
        let Some(file) = self.file else {
            return Vec::new();
        };
        let first = self.next;
        self.next = self.next.max(last.saturating_add(1));
        (first..self.next)
            .map(|number| (number, readable(file.line(number))))
            .filter(|(_, text)| !text.is_empty())
            .map(|(number, text)| format!("// {number}: {text}"))
            .collect()
    }
}

/// Text that stays within one comment: white space of every kind (line ends of WGSL among it) is one blank, control
/// characters are replaced.
fn readable(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(bytes);
    let mut line = String::with_capacity(text.len().min(2 * LONGEST));
    let mut count = 0;
    for word in text.split_whitespace() {
        let blank = if line.is_empty() { None } else { Some(' ') };
        for character in blank.into_iter().chain(word.chars()) {
            if count == LONGEST {
                line.push('…');
                return line;
            }
            count += 1;
            line.push(match character.is_control() {
                true => char::REPLACEMENT_CHARACTER,
                false => character,
            });
        }
    }
    line
}

//! The lines of the listing as comments.

use super::Stage;
use crate::diagnostic::{SourceFile, Span};
use std::fmt::Arguments;

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
        // Of a text that macros have made, what was written is quoted.
        let mut span = stage.source.written(stage.program.span);
        let file = stage
            .source
            .file_of(stage.source.written(stage.program.version_span).start);
        if let Some(file) = file.filter(|file| file.span().to(span) != file.span()) {
            // It begins in a file that is included.
            span = file.span();
        }
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

    /// Quotes the line on which a statement begins and all lines before it that were not given out yet.
    pub(super) fn up_to(&mut self, statement: Span, push: &mut dyn FnMut(Arguments<'_>)) {
        let statement = self.stage.source.written(statement);
        let Some(here) = self.stage.source.file_of(statement.start) else {
            return;
        };
        let line_at = |place: u32| here.line_at(place.saturating_sub(here.span().start));
        if Some(here.span()) == self.file.map(SourceFile::span) {
            return self.until(line_at(statement.end.max(statement.start)), push);
        }
        // The statement came from another text, a file that was included for example.
        let number = line_at(statement.start);
        let (name, text) = (
            readable(here.name().as_bytes()),
            readable(here.line(number)),
        );
        push(format_args!("// {name}:{number}: {text}"));
    }

    /// Quotes the lines behind the last statement.
    pub(super) fn rest(&mut self, push: &mut dyn FnMut(Arguments<'_>)) {
        self.until(self.last, push);
    }

    fn until(&mut self, last: usize, push: &mut dyn FnMut(Arguments<'_>)) {
        let Some(file) = self.file else {
            return;
        };
        let first = self.next;
        self.next = self.next.max(last.saturating_add(1));
        for number in first..self.next {
            let text = readable(file.line(number));
            if !text.is_empty() {
                push(format_args!("// {number}: {text}"));
            }
        }
    }
}

/// Text that stays within one comment: white space of every kind (line ends of WGSL among it) is one blank, control
/// characters are replaced.
fn readable(bytes: &[u8]) -> String {
    let is_plain = |byte: &u8| matches!(byte, b'\t' | b' '..=b'~');
    match std::str::from_utf8(bytes) {
        // Nearly all lines; each of their characters is one byte.
        Ok(text) if bytes.len() <= LONGEST && bytes.iter().all(is_plain) => {
            let mut line = String::with_capacity(text.len());
            for word in text.split_ascii_whitespace() {
                if !line.is_empty() {
                    line.push(' ');
                }
                line.push_str(word);
            }
            line
        }
        _ => cleaned(&String::from_utf8_lossy(bytes)),
    }
}

fn cleaned(text: &str) -> String {
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

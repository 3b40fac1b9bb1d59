//! Texts that were made of other texts, and the way back.

use super::{SourceFile, SourceMap, Span};

/// Part of a derived text: what it was made of.
///
/// It reaches to the start of the next piece. A piece that is as long as its source is a copy of it, byte by byte; of
/// another (the `\n` of a string in C, a blank for a comment) every place is the whole source.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Piece {
    /// Offset of its first byte in the derived text.
    pub start: u32,
    /// What it was made of.
    pub source: Span,
    /// The number of the expansion that put it there; `None` for text that stands where it was written.
    pub expansion: Option<u32>,
}

/// A use of a macro.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Expansion {
    /// The name of the macro.
    pub name: String,
    /// Where it is used, arguments included.
    pub at: Span,
    /// The expansion that this use stands in.
    pub within: Option<u32>,
    /// Where the outermost of the macros around it is used.
    pub outermost: Span,
}

/// How a derived text was made.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Derivation {
    /// Its pieces by their start; the first starts at 0.
    pub pieces: Vec<Piece>,
    /// The expansions that pieces name. An expansion stands within one with a smaller number.
    pub expansions: Vec<Expansion>,
}

/// Where a text comes from.
#[derive(Clone, Debug, Default)]
pub(super) enum Origin {
    /// Somebody wrote it.
    #[default]
    Written,
    /// Somebody wrote it, and another text includes it at this place.
    Included(Span),
    /// It was made of other texts.
    Derived(Derivation),
}

/// Something to add to what is said of a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// What it is.
    pub message: String,
    /// Where; `None` if it is about the place itself.
    pub span: Option<Span>,
}

/// How many steps of macros in macros, or files in files, are told of one place.
const MOST_NOTES: usize = 6;

impl Derivation {
    fn at(&self, offset: u32) -> Option<usize> {
        let behind = self.pieces.partition_point(|p| p.start <= offset);
        behind.checked_sub(1)
    }

    /// Piece `at` with where it ends, in a text of this length.
    fn piece(&self, at: usize, length: u32) -> Option<(&Piece, u32)> {
        let piece = self.pieces.get(at)?;
        let end = self.pieces.get(at + 1).map_or(length, |next| next.start);
        Some((piece, end))
    }

    /// What part of a piece was made of, in its own text.
    fn source(&self, at: usize, length: u32, range: (u32, u32)) -> Option<Span> {
        let (piece, end) = self.piece(at, length)?;
        if end - piece.start != piece.source.end - piece.source.start {
            return Some(piece.source);
        }
        let place =
            |offset: u32| piece.source.start + (offset.clamp(piece.start, end) - piece.start);
        Some(Span::new(place(range.0), place(range.1)))
    }

    /// The pieces of a range: the first and the last one.
    fn pieces_of(&self, range: (u32, u32)) -> Option<(usize, usize)> {
        let mut first = self.at(range.0)?;
        if range.0 < range.1 {
            return Some((first, self.at(range.1 - 1)?));
        }
        // An empty place between two pieces belongs to the one that stands where it was written.
        let piece = self.pieces.get(first)?;
        let made = |at: usize| self.pieces.get(at).is_none_or(|p| p.expansion.is_some());
        if piece.start == range.0 && first > 0 && made(first) && !made(first - 1) {
            first -= 1;
        }
        Some((first, first))
    }
}

impl SourceMap {
    /// Where the text of a span was written by a person: the span itself, unless its text was made of another. What a
    /// macro has made was written where the macro is used.
    pub fn written(&self, span: Span) -> Span {
        let mut span = span;
        // Texts are made of those that were added before them.
        while let Some(next) = self.one_back(span) {
            span = next;
        }
        span
    }

    fn derived(&self, span: Span) -> Option<(&SourceFile, &Derivation, (u32, u32))> {
        let file = self.file_of(span.start)?;
        let Origin::Derived(derivation) = &file.origin else {
            return None;
        };
        let length = file.bytes.len() as u32;
        let start = (span.start - file.base).min(length);
        let end = (span.end.max(span.start) - file.base).min(length);
        Some((file, derivation, (start, end)))
    }

    /// As [`Self::written`], by one text.
    fn one_back(&self, span: Span) -> Option<Span> {
        let (file, derivation, range) = self.derived(span)?;
        let length = file.bytes.len() as u32;
        let (first, last) = derivation.pieces_of(range)?;
        let place = |at: usize| {
            let piece = derivation.pieces.get(at)?;
            match piece.expansion {
                Some(made) => Some(derivation.expansions.get(made as usize)?.outermost),
                None => derivation.source(at, length, range),
            }
        };
        let (start, end) = (place(first)?, place(last)?);
        // An argument with what the macro puts behind it, or the other way round: the outer place, or the argument.
        let within = |a: Span, b: Span| b.start <= a.start && a.end <= b.end;
        let joins = !within(start, end)
            && !within(end, start)
            && start.start <= end.end
            && self.number_of(start.start) == self.number_of(end.end);
        let earlier = start.start.max(start.end) < file.base;
        // A derivation that does not lead to an earlier text leads nowhere.
        earlier.then(|| {
            if joins {
                Span::new(start.start, end.end)
            } else {
                start
            }
        })
    }

    /// Where the text of a span can be changed: `None` if it was made by a macro, or of several places.
    pub fn editable(&self, span: Span) -> Option<Span> {
        let mut span = span;
        while let Some((file, derivation, range)) = self.derived(span) {
            let length = file.bytes.len() as u32;
            let (first, last) = derivation.pieces_of(range)?;
            let (piece, end) = derivation.piece(first, length)?;
            let copied = end - piece.start == piece.source.end - piece.source.start;
            let source = derivation.source(first, length, range)?;
            let own = first == last && copied && piece.expansion.is_none();
            if !own || source.end >= file.base {
                return None;
            }
            span = source;
        }
        Some(span)
    }

    /// What leads from the place where the text of a span was written to that text: macros and files that include it.
    pub fn notes(&self, span: Span) -> Vec<Note> {
        let mut notes = Vec::new();
        let mut here = span;
        while let Some((file, derivation, range)) = self.derived(here) {
            self.expansion_notes(file, derivation, range, &mut notes);
            match self.one_back(here) {
                Some(next) => here = next,
                None => break,
            }
        }
        let reads = self.text(span);
        if !notes.is_empty() && reads != self.text(here) && !reads.trim().is_empty() {
            const LONGEST: usize = 100;
            let words: Vec<&str> = reads.split_whitespace().collect();
            let reads = words.join(" ");
            if reads.len() <= LONGEST {
                let message = format!("expanded, this reads `{reads}`");
                notes.insert(
                    0,
                    Note {
                        message,
                        span: None,
                    },
                );
            }
        }
        for _ in 0..MOST_NOTES {
            match self.file_of(here.start).map(|file| &file.origin) {
                Some(Origin::Included(at)) => {
                    let message = "the file is included here".to_string();
                    here = *at;
                    notes.push(Note {
                        message,
                        span: Some(here),
                    });
                }
                _ => break,
            }
        }
        notes
    }

    /// The macros that made the first part of a range which a macro has made, the outermost first.
    fn expansion_notes(
        &self,
        file: &SourceFile,
        derivation: &Derivation,
        range: (u32, u32),
        notes: &mut Vec<Note>,
    ) {
        let Some((first, last)) = derivation.pieces_of(range) else {
            return;
        };
        let made = (first..=last).find_map(|at| Some((at, derivation.pieces.get(at)?.expansion?)));
        let Some((at, innermost)) = made else {
            return;
        };
        let length = file.bytes.len() as u32;
        let Some(mut place) = derivation.source(at, length, range) else {
            return;
        };
        // What the same expansion made behind it, as far as the range goes.
        for next in at + 1..=last {
            let same = derivation
                .pieces
                .get(next)
                .is_some_and(|p| p.expansion == Some(innermost));
            match derivation.source(next, length, range) {
                Some(source)
                    if same && self.number_of(source.start) == self.number_of(place.start) =>
                {
                    place = place.to(source);
                }
                _ => break,
            }
        }
        let mut chain = Vec::new();
        let mut expansion = Some(innermost);
        while let Some(here) = expansion.and_then(|i| derivation.expansions.get(i as usize)) {
            let message = format!("in the expansion of `{}`, defined here", here.name);
            chain.push(Note {
                message,
                span: Some(place),
            });
            place = here.at;
            expansion = here.within;
        }
        notes.extend(chain.into_iter().rev().take(MOST_NOTES));
    }
}

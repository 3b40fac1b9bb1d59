//! Macros and included files, by the lines that name them.

use super::analysis::Analysis;
use super::directives;
use super::documents::Document;
use std::ops::Range;
use texcrd::diagnostic::Span;

/// A definition of a macro.
#[derive(Clone, Debug)]
pub(super) struct Definition {
    pub name: Span,
    /// The directive as it is written.
    pub text: String,
    /// Whether it takes arguments.
    pub arguments: bool,
    /// What is defined.
    pub word: String,
}

/// Every definition of a macro in a document and the files that it includes, those of the files first.
pub(super) fn all(analysis: &Analysis) -> Vec<Definition> {
    let (own, files): (Vec<_>, Vec<_>) = analysis.texts().partition(|file| analysis.is_root(file));
    let mut found = Vec::new();
    for file in files.into_iter().chain(own) {
        let (bytes, base) = (file.bytes(), file.span().start);
        for defined in directives::all(bytes)
            .iter()
            .filter_map(|d| d.defines(bytes))
        {
            let text = bytes.get(defined.at.clone()).unwrap_or(&[]);
            let name = defined.name_at;
            found.push(Definition {
                name: Span::new(base + name.start as u32, base + name.end as u32),
                text: String::from_utf8_lossy(text).into_owned(),
                arguments: defined.arguments,
                word: defined.name,
            });
        }
    }
    found
}

/// The definitions of a macro that may hold at a byte of the document: those before it, or all if there are none.
pub(super) fn definitions(analysis: &Analysis, name: &str, offset: usize) -> Vec<Definition> {
    let mut found = all(analysis);
    found.retain(|definition| definition.word == name);
    let here = analysis.span(&(offset..offset));
    let own = |d: &Definition| analysis.written(d.name).is_some();
    // Of the document's own the last one before counts; which of those in conditions it is, is not known here.
    let before = |d: &Definition| !own(d) || d.name.start <= here.start;
    if found.iter().any(before) {
        found.retain(before);
    }
    found
}

/// Where the name of a macro stands that a place lies in.
pub(super) fn name_at(
    analysis: &Analysis,
    document: &Document,
    offset: usize,
) -> Option<Range<usize>> {
    let bytes = document.text.as_bytes();
    let word = |b: &u8| b.is_ascii_alphanumeric() || *b == b'_';
    let start = bytes
        .get(..offset)?
        .iter()
        .rposition(|b| !word(b))
        .map_or(0, |at| at + 1);
    let length = bytes.get(start..)?.iter().take_while(|b| word(b)).count();
    let name = document
        .text
        .get(start..start + length)
        .filter(|name| !name.is_empty())?;
    let all = all(analysis);
    let is = |name: &str| all.iter().any(|definition| definition.word == name);
    if is(name) {
        return Some(start..start + length);
    }
    // A macro with the suffix of a source modifier is the macro.
    let end = name
        .rfind('_')
        .filter(|end| is(name.get(..*end).unwrap_or_default()))?;
    (offset <= start + end).then_some(start..start + end)
}

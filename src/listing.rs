//! A listing on its way through preprocessor, parser and validator.

use crate::diagnostic::{Diagnostic, SourceFile, SourceMap, Span, any_error};
use crate::policy::Dialect;
use crate::preprocess::{self, Preprocessed, preprocess};
use crate::program::Program;
use crate::rules::{model, text as rules};
use crate::{syntax, validate};

/// What became of a listing.
#[derive(Clone, Debug, PartialEq)]
pub struct Checked {
    /// The shader, as far as it could be read. `None` if there is no telling what it is: its version is not known, or lines
    /// of it may be macros that are not known.
    pub program: Option<Program>,
    /// Everything that is wrong with it, by position.
    pub diagnostics: Vec<Diagnostic>,
}

impl Checked {
    /// The shader, if nothing refuses it.
    pub fn accepted(&self) -> Option<&Program> {
        if any_error(&self.diagnostics) {
            return None;
        }
        self.program.as_ref()
    }
}

/// How a listing is read.
#[derive(Clone, Copy, Default)]
pub struct Options<'a> {
    /// By whose rules it is judged.
    pub dialect: Dialect,
    /// Whether only that is judged which the assembler itself refused: the text, and what [`validate::assembles`] says
    /// of it; not the other rules of the shader model. Of tokens nothing is judged then.
    pub unchecked: bool,
    /// Whether names may have been defined that are not known here.
    pub names_missing: bool,
    /// What the preprocessor is given.
    pub preprocess: preprocess::Options<'a>,
}

/// Parses and validates a listing in which nothing is left for the preprocessor. See [`read`] for those of people.
///
/// What follows only from lines that could not be read (a register that they seem to write is not written, say) is
/// not told again.
pub fn check(file: &SourceFile, dialect: Dialect) -> Checked {
    let options = Options {
        dialect,
        ..Default::default()
    };
    check_around(file, &options, &[])
}

/// Preprocesses, parses and validates a listing, one of the sources.
///
/// Where it has directives, the spans of its program lie in a text that is added to the sources, which know where each part
/// of it was written.
pub fn read(sources: &mut SourceMap, file: Span, options: &Options<'_>) -> Checked {
    let bytes = sources
        .file_of(file.start)
        .map_or(&[][..], SourceFile::bytes);
    let preprocessed = match preprocess::is_needed(bytes, &options.preprocess)
        && syntax::not_text(bytes).is_none()
    {
        true => preprocess(sources, file, &options.preprocess),
        false => Preprocessed {
            text: Some(file),
            diagnostics: Vec::new(),
            lost: Vec::new(),
        },
    };
    check_preprocessed(sources, preprocessed, options)
}

/// Parses and validates what a preprocessor left.
fn check_preprocessed(
    sources: &SourceMap,
    preprocessed: Preprocessed,
    options: &Options<'_>,
) -> Checked {
    let text = preprocessed
        .text
        .and_then(|text| sources.file_of(text.start));
    let mut checked = match text {
        Some(text) => check_around(text, options, &preprocessed.lost),
        None => Checked {
            program: None,
            diagnostics: Vec::new(),
        },
    };
    let mut found = preprocessed.diagnostics;
    if let (true, Some(program)) = (options.unchecked, &checked.program) {
        found.extend(validate::assembles(program));
    }
    if !found.is_empty() {
        checked.diagnostics.splice(0..0, found);
        checked.diagnostics.sort_by_key(|d| sources.written(d.span));
    }
    checked
}

/// As [`check`], of a text in which something is missing at these places.
pub(crate) fn check_around(file: &SourceFile, options: &Options<'_>, lost: &[Span]) -> Checked {
    let parsed = syntax::parse_with(
        file,
        syntax::Options {
            lenient: options.dialect == Dialect::Lenient,
            names_missing: options.names_missing || !lost.is_empty(),
            ..Default::default()
        },
    );
    let mut diagnostics = parsed.diagnostics.clone();
    if let (None, Some(first)) = (&parsed.program, lost.first()) {
        // The version may stand in what is missing.
        let hidden = |d: &Diagnostic| d.rule.id == model::S1.id && first.start <= d.span.start;
        diagnostics.retain(|d| !hidden(d));
    }
    if !options.unchecked {
        diagnostics.extend(syntax::unread(file, &parsed));
        if let Some(program) = &parsed.program {
            let mut unread: Vec<_> = (parsed.damaged.iter())
                .map(|damage| (damage.span, damage.destination))
                .collect();
            unread.extend(lost.iter().map(|place| (*place, None)));
            diagnostics.extend(validate::validate_around(program, options.dialect, &unread));
        }
    }
    // Otherwise it has been said what is wrong with them.
    let unknown = match any_error(&diagnostics) {
        true => &[][..],
        false => &parsed.damaged,
    };
    diagnostics.extend(unknown.iter().take(MOST_UNKNOWN).map(|damage| {
        let message = "this may be a macro of a file that could not be read";
        let report = Diagnostic::warning(&rules::MAYBE_MACRO, damage.span, message);
        report.with_help("name the folder of the file with -I; without it there is no whole shader")
    }));
    diagnostics.sort_by_key(|d| (d.span.start, d.span.end));
    Checked {
        program: parsed.program.filter(|_| unknown.is_empty()),
        diagnostics,
    }
}

/// Of how many lines it is said that they may be macros.
const MOST_UNKNOWN: usize = 100;

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    /// The identifiers of what is said of a listing that may include `open.h`, a comment without end.
    fn said(text: &str) -> Vec<&'static str> {
        let mut sources = SourceMap::new();
        let file = sources.add("listing", text).unwrap().span();
        let files = BTreeMap::from([("open.h".to_string(), b"/* open\n".to_vec())]);
        let mut options = Options::default();
        options.preprocess.resolver = &files;
        let checked = read(&mut sources, file, &options);
        checked.diagnostics.iter().map(|d| d.rule.id).collect()
    }

    /// What the preprocessor could not read may have held the version, and what writes r0.
    #[test]
    fn nothing_is_missed_that_may_stand_in_what_is_lost() {
        for (text, id) in [
            ("ps.1.1\n#define M(a,b) mov a, b\nM(r0, v0", "P31"),
            ("#if (1\nps.1.1\n#endif\nmov r0, v0\n", "P27"),
            ("#if FOO(\nps.1.1\n#endif\nmov r0, v0\n", "P27"),
            ("ps.1.1\n#if (1\nmov r0, v0\n#endif\n", "P27"),
            ("#ifdef\nps.1.1\n#endif\nmov r0, v0\n", "P26"),
            ("#include \"open.h\"\nps.1.1\nmov r0, v0\n", "P6"),
            ("ps.1.1\n#include \"open.h\"\nmov r0, v0\n", "P6"),
            ("/* open\nps.1.1\nmov r0, v0\n", "P6"),
        ] {
            assert_eq!(said(text), [id], "{text}");
        }
        // Nothing was lost before these.
        assert_eq!(said("mov r0, v0\n#if (1\n#endif\n"), ["S1", "P27"]);
        assert_eq!(said("#if 1\n#endif\nmov r0, v0\n"), ["S1"]);
    }
}

//! What can be wrong with a scene or a shader test, and where.

use std::fmt;
use std::ops::Range;

use crate::diagnostic::{Diagnostic, Rule, Severity, SourceMap, Span};

/// The rules of scene files and shader tests.
pub mod rules {
    use crate::diagnostic::Rule;

    /// Text that is not TOML.
    pub static SYNTAX: Rule = Rule {
        id: "F1",
        rule: "a scene file is TOML in UTF-8, a shader test TOML or JSON",
    };
    /// A key that the table does not have.
    pub static KEY: Rule = Rule {
        id: "F2",
        rule: "a table has only the keys that the format gives it",
    };
    /// A value of the wrong kind, shape or range.
    pub static VALUE: Rule = Rule {
        id: "F3",
        rule: "a value has the kind, the shape and the range that its key asks for",
    };
    /// A key that must be there.
    pub static MISSING: Rule = Rule {
        id: "F4",
        rule: "what a table cannot do without must be written",
    };
    /// A mesh, texture, target, draw, attribute or meaning that there is not.
    pub static NAME: Rule = Rule {
        id: "F5",
        rule: "a name must be that of something that exists",
    };
    /// The same thing said twice.
    pub static TWICE: Rule = Rule {
        id: "F6",
        rule: "a name, a register or a source is given once",
    };
    /// A file that cannot be read.
    pub static FILE: Rule = Rule {
        id: "F7",
        rule: "the files that a scene or a test names must be readable",
    };
    /// A file or a request from which nothing can be made.
    pub static CONTENT: Rule = Rule {
        id: "F8",
        rule: "meshes and textures must be such that they can be built",
    };
    /// Render targets that wait for each other.
    pub static CYCLE: Rule = Rule {
        id: "F9",
        rule: "a render target is finished before a draw reads it",
    };
    /// A shader of the wrong kind, or one without a meaning.
    pub static SHADER: Rule = Rule {
        id: "F10",
        rule: "where a shader stands it is of the right kind and can be run",
    };
    /// More of something than a scene may have.
    pub static LIMIT: Rule = Rule {
        id: "F11",
        rule: "a file keeps within the limits of its format",
    };
    /// A stage that is sampled and empty.
    pub static UNBOUND: Rule = Rule {
        id: "F12",
        rule: "a stage that a shader samples should have a texture; without one it reads opaque black",
    };
    /// An input register that nothing feeds.
    pub static UNFED: Rule = Rule {
        id: "F14",
        rule: "an input register that a vertex shader reads should be fed by the declaration; otherwise it reads (0, 0, 0, 1)",
    };
    /// Something that is written and has no effect.
    pub static IDLE: Rule = Rule {
        id: "F13",
        rule: "what is written should have an effect",
    };
}

/// Why a scene or a shader test was refused: every problem that was found, in the file and in the listings that it names.
#[derive(Clone, Debug)]
pub struct SceneError {
    /// The scene file and the listings, for the places.
    pub sources: SourceMap,
    /// The problems, warnings among them.
    pub diagnostics: Vec<Diagnostic>,
}

impl fmt::Display for SceneError {
    /// One line a problem, `file:line:column: error[code]: message`, and its help below it.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (number, diagnostic) in self.diagnostics.iter().enumerate() {
            if number > 0 {
                f.write_str("\n")?;
            }
            if let Some(place) = self.sources.locate(diagnostic.span) {
                write!(f, "{}:{}:{}: ", place.file, place.line, place.column)?;
            }
            let (severity, id) = (diagnostic.severity.name(), diagnostic.rule.id);
            write!(f, "{severity}[{id}]: {}", diagnostic.message)?;
            if let Some(help) = &diagnostic.help {
                write!(f, "\n  help: {help}")?;
            }
        }
        Ok(())
    }
}

impl std::error::Error for SceneError {}

/// After so many errors no more are told.
const MOST_ERRORS: usize = 100;

/// Longer messages are cut off: a name in them may be as long as the file.
const MOST_LETTERS: usize = 1000;

/// Collects problems while a scene is read.
#[derive(Debug, Default)]
pub(crate) struct Problems {
    list: Vec<Diagnostic>,
    errors: usize,
}

impl Problems {
    /// The range of a value of a scene file as a span: [`super::include::parse`] has made it one of the source map.
    pub(crate) fn span(&self, range: Range<usize>) -> Span {
        // Source maps hold less than 4 GiB, so that no offset in them is larger.
        Span::new(range.start as u32, range.end as u32)
    }

    /// Whether there are so many errors that looking for more helps nobody.
    pub(crate) fn full(&self) -> bool {
        self.errors >= MOST_ERRORS
    }

    /// Adds a problem, unless there are too many.
    pub(crate) fn push(&mut self, mut diagnostic: Diagnostic) {
        if self.full() {
            return;
        }
        self.errors += usize::from(diagnostic.severity == Severity::Error);
        for text in std::iter::once(&mut diagnostic.message).chain(&mut diagnostic.help) {
            if let Some((end, _)) = text.char_indices().nth(MOST_LETTERS) {
                text.truncate(end);
                text.push('…');
            }
        }
        self.list.push(diagnostic);
    }

    pub(crate) fn error(&mut self, rule: &'static Rule, span: Span, message: impl Into<String>) {
        self.push(Diagnostic::error(rule, span, message));
    }

    pub(crate) fn warning(&mut self, rule: &'static Rule, span: Span, message: impl Into<String>) {
        self.push(Diagnostic::warning(rule, span, message));
    }

    /// An error with advice, if there is any.
    pub(crate) fn error_with(
        &mut self,
        rule: &'static Rule,
        span: Span,
        message: impl Into<String>,
        help: Option<String>,
    ) {
        let mut diagnostic = Diagnostic::error(rule, span, message);
        diagnostic.help = help;
        self.push(diagnostic);
    }

    pub(crate) fn any_error(&self) -> bool {
        self.errors > 0
    }

    /// The problems in the order of their places, errors before warnings at the same place.
    pub(crate) fn into_sorted(mut self) -> Vec<Diagnostic> {
        self.list
            .sort_by_key(|d| (d.span.start, d.severity != Severity::Error));
        self.list
    }
}

/// The name among `known` that was probably meant by `given`: at most a third of its letters differ.
pub(crate) fn nearest<'a>(
    given: &str,
    known: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    let allowed = (given.chars().count() / 3).max(1);
    known
        .into_iter()
        .filter(|name| name.len().abs_diff(given.len()) <= 4 * allowed)
        .map(|name| (edits(given, name), name))
        .filter(|(distance, _)| *distance <= allowed)
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, name)| name)
}

/// A list of more names than this helps nobody.
const MOST_NAMES: usize = 40;

/// `did you mean …?`, or else the list of what there is.
pub(crate) fn advice<'a>(
    given: &str,
    known: impl IntoIterator<Item = &'a str> + Clone,
) -> Option<String> {
    if let Some(name) = nearest(given, known.clone()) {
        return Some(format!("did you mean `{name}`?"));
    }
    let names: Vec<String> = known
        .into_iter()
        .take(MOST_NAMES + 1)
        .map(|name| format!("`{name}`"))
        .collect();
    let readable = (1..=MOST_NAMES).contains(&names.len());
    readable.then(|| format!("there are {}", names.join(", ")))
}

/// What was probably meant, for a message of `serde` about a name that it does not know: it gives the name and then the
/// names that there are, each between backquotes.
pub(crate) fn advice_from(message: &str) -> Option<String> {
    if !message.starts_with("unknown ") {
        return None;
    }
    let mut names = message.split('`').skip(1).step_by(2);
    let given = names.next()?;
    nearest(given, names).map(|name| format!("did you mean `{name}`?"))
}

/// Insertions, deletions, replacements and swaps of neighbours that turn one name into the other.
fn edits(a: &str, b: &str) -> usize {
    // Names longer than any of the format's are not compared letter by letter.
    let [a, b]: [Vec<char>; 2] = [a, b].map(|s| s.chars().take(64).collect());
    let mut rows = [
        vec![0; b.len() + 1],
        (0..=b.len()).collect::<Vec<usize>>(),
        vec![0; b.len() + 1],
    ];
    for (i, &x) in a.iter().enumerate() {
        let [before, last, row] = &mut rows;
        row[0] = i + 1;
        for (j, &y) in b.iter().enumerate() {
            let mut best = (last[j] + usize::from(x != y))
                .min(last[j + 1] + 1)
                .min(row[j] + 1);
            if i > 0 && j > 0 && x == b[j - 1] && a[i - 1] == y {
                best = best.min(before[j - 1] + 1);
            }
            row[j + 1] = best;
        }
        rows.rotate_left(1);
    }
    rows[1][b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_name_is_found_or_none() {
        let known = ["position", "projection", "fov"];
        assert_eq!(nearest("positon", known), Some("position"));
        assert_eq!(nearest("fvo", known), Some("fov"));
        assert_eq!(nearest("texture", known), None);
        assert_eq!(edits("kitten", "sitting"), 3);
        assert_eq!(edits("", "abc"), 3);
    }
}

//! Diagnostics for people and as JSON.

use super::{Format, Outcome, print_json};
use annotate_snippets::{Annotation, AnnotationKind, Level, Renderer, Snippet};
use serde_json::json;
use texcrd::diagnostic::{Diagnostic, Fix, Severity, SourceMap, Span};

/// How much of a long line is shown around the place that is meant, in bytes on either side.
const CONTEXT: usize = 100;

/// Says diagnostics beside a result: to people on standard error, to programs as objects on standard output, one a line.
pub(super) fn tell(format: Format, sources: &SourceMap, diagnostics: &[Diagnostic]) -> Outcome {
    match format {
        Format::Text => {
            anstream::eprint!("{}", render(sources, diagnostics));
            Ok(())
        }
        Format::Json => {
            let mut all = diagnostics.iter();
            all.try_for_each(|diagnostic| print_json(&to_json(sources, diagnostic)))
        }
    }
}

/// Diagnostics as a person reads them: each with its place, the line, a caret, the rule and the help.
pub(super) fn render(sources: &SourceMap, diagnostics: &[Diagnostic]) -> String {
    let mut text = String::new();
    for diagnostic in diagnostics {
        text.push_str(&render_one(sources, diagnostic));
        text.push_str("\n\n");
    }
    text
}

fn render_one(sources: &SourceMap, diagnostic: &Diagnostic) -> String {
    let level = match diagnostic.severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
    };
    let title = level
        .primary_title(diagnostic.message.as_str())
        .id(diagnostic.rule.id);
    let place = snippet(sources, diagnostic.span, AnnotationKind::Primary);
    let mut group = title
        .element(place)
        .element(Level::NOTE.with_name("rule").message(diagnostic.rule.rule));
    if let Some(help) = &diagnostic.help {
        group = group.element(Level::HELP.message(help.as_str()));
    }
    if let Some(fix) = &diagnostic.fix
        && fix.certain
        && sources.editable(fix.span).is_some()
    {
        let fixed = if sources.text(fix.span).is_empty() {
            format!("`check --fix` inserts `{}`", fix.replacement)
        } else {
            let before = sources.text(fix.span);
            format!("`check --fix` writes `{}` for `{before}`", fix.replacement)
        };
        group = group.element(Level::NOTE.with_name("fix").message(fixed));
    }
    let mut groups = vec![];
    for note in sources.notes(diagnostic.span) {
        match note.span {
            None => group = group.element(Level::NOTE.message(note.message)),
            Some(span) => {
                let title = Level::NOTE.secondary_title(note.message);
                groups.push(title.element(snippet(sources, span, AnnotationKind::Context)));
            }
        }
    }
    groups.insert(0, group);
    Renderer::styled().render(&groups)
}

/// A place with its line.
fn snippet<'a>(
    sources: &SourceMap,
    span: Span,
    kind: AnnotationKind,
) -> Snippet<'a, Annotation<'a>> {
    let window = Window::of(sources, span);
    Snippet::source(window.text)
        .line_start(window.line)
        .path(window.file)
        .annotation(kind.span(window.start..window.end))
}

/// The part of a line that is shown, readable whatever bytes it holds.
struct Window {
    file: String,
    line: usize,
    text: String,
    /// The place within `text`.
    start: usize,
    end: usize,
}

impl Window {
    /// The first line of a span, cut to the surroundings of the place.
    fn of(sources: &SourceMap, span: Span) -> Self {
        let span = sources.written(span);
        let (Some(file), Some(at)) = (sources.file_of(span.start), sources.locate(span)) else {
            return Self {
                file: String::new(),
                line: 1,
                text: String::new(),
                start: 0,
                end: 0,
            };
        };
        let line = file.line(at.line);
        let offset = (span.start - file.span().start) as usize;
        let start = offset
            .saturating_sub(file.line_start(at.line) as usize)
            .min(line.len());
        let end = (start + (span.end.saturating_sub(span.start)) as usize).min(line.len());
        let first = start.saturating_sub(CONTEXT);
        let last = (end.min(start + CONTEXT) + CONTEXT).min(line.len());
        let readable = |range: std::ops::Range<usize>| {
            let bytes = line.get(range).unwrap_or_default();
            String::from_utf8_lossy(bytes)
                .replace(|c: char| c.is_control() && c != '\t', "\u{fffd}")
        };
        let before = readable(first..start);
        let marked = readable(start..end.min(last));
        let after = readable(end.min(last)..last);
        Self {
            file: at.file.to_string(),
            line: at.line,
            start: before.len(),
            end: before.len() + marked.len(),
            text: before + &marked + &after,
        }
    }
}

/// One diagnostic as the command line's contract has it.
pub(super) fn to_json(sources: &SourceMap, diagnostic: &Diagnostic) -> serde_json::Value {
    let at = sources.locate(diagnostic.span);
    // What a macro has made cannot be repaired where it is used.
    let editable = |fix: &&Fix| sources.editable(fix.span).is_some();
    let fix = diagnostic.fix.as_ref().filter(editable).map(|fix| {
        let place = sources.locate(fix.span);
        json!({
            "line": place.as_ref().map(|at| at.line),
            "column": place.as_ref().map(|at| at.column),
            "end_line": place.as_ref().map(|at| at.end_line),
            "end_column": place.as_ref().map(|at| at.end_column),
            "replacement": fix.replacement,
            "certain": fix.certain,
        })
    });
    let notes: Vec<_> = (sources.notes(diagnostic.span).into_iter())
        .map(|note| {
            let at = note.span.and_then(|span| sources.locate(span));
            json!({
                "file": at.as_ref().map(|at| at.file),
                "line": at.as_ref().map(|at| at.line),
                "column": at.as_ref().map(|at| at.column),
                "message": note.message,
            })
        })
        .collect();
    json!({
        "file": at.as_ref().map(|at| at.file),
        "line": at.as_ref().map(|at| at.line),
        "column": at.as_ref().map(|at| at.column),
        "end_line": at.as_ref().map(|at| at.end_line),
        "end_column": at.as_ref().map(|at| at.end_column),
        "severity": diagnostic.severity.name(),
        "code": diagnostic.rule.id,
        "message": diagnostic.message,
        "help": diagnostic.help,
        "fix": fix,
        "notes": notes,
    })
}

/// `2 errors, 1 warning`; `None` if there is nothing to count.
pub(super) fn summary(diagnostics: &[Diagnostic]) -> Option<String> {
    let count = |severity| {
        diagnostics
            .iter()
            .filter(|d| d.severity == severity)
            .count()
    };
    let plural = |n: usize, what: &str| match n {
        0 => None,
        1 => Some(format!("1 {what}")),
        n => Some(format!("{n} {what}s")),
    };
    let parts: Vec<_> = [
        plural(count(Severity::Error), "error"),
        plural(count(Severity::Warning), "warning"),
    ]
    .into_iter()
    .flatten()
    .collect();
    (!parts.is_empty()).then(|| parts.join(", "))
}

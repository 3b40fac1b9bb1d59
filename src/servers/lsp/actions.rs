//! Repairs and layout, as edits of a document.

use super::analysis::{Analysis, World};
use super::client::Client;
use super::documents::Document;
use super::publish;
use serde_json::{Value, json};
use std::ops::Range;
use texcrd::diagnostic::Fix;
use texcrd::extract::{self, Layout};

/// The kind of the action that applies all certain repairs.
pub(super) const FIX_ALL: &str = "source.fixAll.texcrd";
const QUICK_FIX: &str = "quickfix";

/// A text that replaces another.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Edit {
    pub at: Range<usize>,
    pub text: String,
}

/// The code actions for a part of a document: a quick fix for each repair there, preferred where it is certain, and one for all
/// certain repairs of the document. `only`: kinds that the client wants; all if there are none.
pub(super) fn actions(
    world: &World<'_>,
    analysis: &Analysis,
    document: &Document,
    part: &Range<usize>,
    only: &[String],
    client: &Client,
) -> Vec<Value> {
    // Without literals actions are commands, and there are none here.
    if !client.action_literals || !analysis.ours {
        return Vec::new();
    }
    let wanted = |kind: &str| {
        let covers = |o: &String| {
            kind == o
                || kind
                    .strip_prefix(o.as_str())
                    .is_some_and(|rest| rest.starts_with('.'))
        };
        only.is_empty() || only.iter().any(covers)
    };
    let mut all = Vec::new();
    if wanted(QUICK_FIX) {
        for diagnostic in &analysis.diagnostics {
            let Some(fix) = &diagnostic.fix else { continue };
            let at = analysis.written(diagnostic.span);
            let Some(at) = at.filter(|at| at.start <= part.end && part.start <= at.end) else {
                continue;
            };
            let Some(edit) = edit_of(analysis, fix) else {
                continue;
            };
            let range = document.lines.range(document.text.as_bytes(), &at);
            all.push(json!({
                "title": title(document, &edit),
                "kind": QUICK_FIX,
                "isPreferred": fix.certain,
                "diagnostics": [publish::one(analysis, diagnostic, range, client)],
                "edit": workspace_edit(document, &[edit], client),
            }));
        }
    }
    // It reads the document again, so it is only made where it is asked for or something can be repaired.
    let certain =
        |d: &texcrd::diagnostic::Diagnostic| d.fix.as_ref().is_some_and(|fix| fix.certain);
    if wanted(FIX_ALL)
        && analysis.diagnostics.iter().any(certain)
        && let Some(repaired) = world.repaired(document)
    {
        let edits = edits(&document.text, &repaired);
        if !edits.is_empty() {
            all.push(json!({
                "title": "Apply all certain repairs",
                "kind": FIX_ALL,
                "edit": workspace_edit(document, &edits, client),
            }));
        }
    }
    all
}

/// A repair in the document; `None` if it cannot be written there as it stands.
fn edit_of(analysis: &Analysis, fix: &Fix) -> Option<Edit> {
    let at = analysis.editable(fix.span)?;
    // In strings of C these would have to be written otherwise.
    let plain = |c: char| !c.is_control() && !matches!(c, '"' | '\\');
    let fits = !analysis.in_strings() || fix.replacement.chars().all(plain);
    fits.then(|| Edit {
        at,
        text: fix.replacement.clone(),
    })
}

fn title(document: &Document, edit: &Edit) -> String {
    let old = document.text.get(edit.at.clone()).unwrap_or_default();
    let short = |text: &str| text.trim().chars().take(40).collect::<String>();
    match (short(old).as_str(), short(&edit.text).as_str()) {
        ("", new) => format!("Insert `{new}`"),
        (old, "") => format!("Remove `{old}`"),
        (old, new) => format!("Replace `{old}` by `{new}`"),
    }
}

fn workspace_edit(document: &Document, edits: &[Edit], client: &Client) -> Value {
    let edits = text_edits(document, edits);
    match client.versioned_edits {
        true => json!({ "documentChanges": [{
            "textDocument": { "uri": document.uri, "version": document.version },
            "edits": edits,
        }] }),
        false => json!({ "changes": { &document.uri: edits } }),
    }
}

/// Edits as the protocol has them.
pub(super) fn text_edits(document: &Document, edits: &[Edit]) -> Value {
    let bytes = document.text.as_bytes();
    let one = |edit: &Edit| json!({ "range": document.lines.range(bytes, &edit.at), "newText": edit.text });
    json!(edits.iter().map(one).collect::<Vec<_>>())
}

/// The layout of a document, of the lines that a range touches.
pub(super) fn format(analysis: &Analysis, document: &Document, part: &Range<usize>) -> Vec<Edit> {
    if !analysis.ours {
        return Vec::new();
    }
    let Layout::Done(text) = extract::format(document.text.as_bytes()) else {
        return Vec::new();
    };
    let mut edits = edits(&document.text, &text);
    let line = |offset| {
        document
            .lines
            .position(document.text.as_bytes(), offset)
            .line
    };
    let (first, last) = (line(part.start), line(part.end));
    edits.retain(|edit| line(edit.at.start) <= last && first <= line(edit.at.end));
    edits
}

/// What makes one text of another: the lines that differ where as many stay, else all between what is the same at both ends.
pub(super) fn edits(old: &str, new: &[u8]) -> Vec<Edit> {
    let Ok(new) = std::str::from_utf8(new) else {
        return Vec::new();
    };
    let before: Vec<&str> = old.split_inclusive('\n').collect();
    let after: Vec<&str> = new.split_inclusive('\n').collect();
    let mut edits = Vec::new();
    if before.len() == after.len() {
        let mut at = 0;
        for (before, after) in before.iter().zip(&after) {
            if before != after {
                edits.push(narrowed(at, before, after));
            }
            at += before.len();
        }
        return edits;
    }
    if old != new {
        edits.push(narrowed(0, old, new));
    }
    edits
}

/// The edit of a text at a place without what is the same at both ends.
fn narrowed(at: usize, old: &str, new: &str) -> Edit {
    let same = |(a, b): &(char, char)| a == b;
    let length = |(c, _): (char, char)| c.len_utf8();
    let start: usize = old
        .chars()
        .zip(new.chars())
        .take_while(same)
        .map(length)
        .sum();
    let (old_rest, new_rest) = (
        old.get(start..).unwrap_or_default(),
        new.get(start..).unwrap_or_default(),
    );
    let end: usize = old_rest
        .chars()
        .rev()
        .zip(new_rest.chars().rev())
        .take_while(same)
        .map(length)
        .sum();
    Edit {
        at: at + start..at + old.len() - end,
        text: new_rest
            .get(..new_rest.len() - end)
            .unwrap_or_default()
            .to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn applied(old: &str, edits: &[Edit]) -> String {
        let mut text = old.to_string();
        for edit in edits.iter().rev() {
            text.replace_range(edit.at.clone(), &edit.text);
        }
        text
    }

    #[test]
    fn edits_make_the_new_text_and_touch_little() {
        for (old, new, count) in [
            ("a\nb  c\nd\n", "a\nb c\nd\n", 1),
            ("a", "a\n", 1),
            ("\u{e4}x\r\n\u{e4}", "\u{f6}x\r\n\u{f6}", 2),
            ("a\nb\nc\n", "a\nx\ny\nc\n", 1),
            ("", "", 0),
            ("aaa", "aa", 1),
            ("ab\nab\n", "ab\n", 1),
        ] {
            let made = edits(old, new.as_bytes());
            assert_eq!(applied(old, &made), new);
            assert_eq!(made.len(), count, "{made:?}");
        }
        // Between the two blanks nothing is left but one of them.
        let made = edits("b  c\n", b"b c\n");
        assert_eq!(
            made,
            [Edit {
                at: 2..3,
                text: String::new()
            }]
        );
    }
}

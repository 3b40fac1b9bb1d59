//! Definitions, references, highlights.

use super::analysis::{Analysis, World};
use super::documents::Document;
use super::text::Range as Places;
use super::{directives, macros, registers};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use texcrd::validate::UseKind;

fn location((uri, range): (String, Places)) -> Value {
    json!({ "uri": uri, "range": range })
}

/// Where what stands at a byte is defined: the file of an `#include`, the `#define` of a macro, what gave a register its value.
pub(super) fn definition(
    world: &World<'_>,
    analysis: &Analysis,
    document: &Document,
    offset: usize,
) -> Value {
    let bytes = document.text.as_bytes();
    let all = directives::all(bytes);
    let here = all
        .iter()
        .find(|d| d.at.start <= offset && offset <= d.at.end);
    if let Some((path, angled)) = here.and_then(|directive| directive.includes(bytes)) {
        let uri = world.included(document, &path, angled);
        return json!(
            uri.map(|uri| vec![location((uri, Places::default()))])
                .unwrap_or_default()
        );
    }
    if let Some(at) = macros::name_at(analysis, document, offset) {
        let name = document.text.get(at.clone()).unwrap_or_default();
        let found = macros::definitions(analysis, name, at.start);
        let places = found
            .iter()
            .filter_map(|definition| analysis.place(definition.name));
        return json!(places.map(location).collect::<Vec<_>>());
    }
    let Some((shader, used)) = registers::use_at(analysis, &document.text, offset) else {
        return Value::Null;
    };
    let found = registers::definitions(shader, used);
    let places = found.iter().filter_map(|u| analysis.place(u.span));
    json!(places.map(location).collect::<Vec<_>>())
}

/// Every use of the register at a byte; those that only give it a value left out if they are not wanted.
pub(super) fn references(
    analysis: &Analysis,
    document: &Document,
    offset: usize,
    declarations: bool,
) -> Value {
    let Some((shader, used)) = registers::use_at(analysis, &document.text, offset) else {
        return Value::Null;
    };
    let wanted = |kind| declarations || !matches!(kind, UseKind::Define | UseKind::Declare);
    let mut places: Vec<(String, Places)> = registers::same(shader, used)
        .filter(|u| wanted(u.kind))
        .filter_map(|u| analysis.place(u.span))
        .collect();
    places.dedup();
    json!(places.into_iter().map(location).collect::<Vec<_>>())
}

/// Every read and write of the register at a byte, in this document.
pub(super) fn highlights(analysis: &Analysis, document: &Document, offset: usize) -> Value {
    let Some((shader, used)) = registers::use_at(analysis, &document.text, offset) else {
        return Value::Null;
    };
    let mut found: BTreeMap<(usize, usize), u8> = BTreeMap::new();
    for u in registers::same(shader, used) {
        let Some(at) = analysis.written(u.span) else {
            continue;
        };
        // What a macro does stands in one place: that it writes is more than that it reads.
        let kind = match u.kind {
            UseKind::Read | UseKind::Declare => READ,
            UseKind::Write | UseKind::Define => WRITE,
        };
        let here = found.entry((at.start, at.end)).or_insert(kind);
        *here = kind.max(*here);
    }
    let bytes = document.text.as_bytes();
    let one = |((start, end), kind): ((usize, usize), u8)| json!({ "range": document.lines.range(bytes, &(start..end)), "kind": kind });
    json!(found.into_iter().map(one).collect::<Vec<_>>())
}

/// Numbers of the protocol.
const READ: u8 = 2;
const WRITE: u8 = 3;

//! Signatures: the operands of an instruction while they are typed.

use super::analysis::Analysis;
use super::client::Client;
use super::documents::Document;
use super::words;
use serde_json::{Value, json};
use texcrd::explain;

/// The operands of the instruction that a byte lies in, and which of them it is.
pub(super) fn signature(
    analysis: &Analysis,
    document: &Document,
    offset: usize,
    client: &Client,
) -> Value {
    let text = &document.text;
    let Some(shader) = analysis.shader_at(offset).filter(|shader| shader.listing) else {
        return Value::Null;
    };
    let line = words::line_at(text, &shader.region, analysis.in_strings(), offset);
    let statements = line.statements(text);
    let here = statements.iter().rev().find(|s| s.mnemonic.end < offset);
    let version = shader.program.as_ref().map(|program| program.version);
    let Some((statement, version)) = here.zip(version).filter(|_| !line.in_comment(text, offset))
    else {
        return Value::Null;
    };
    let Some(form) = statement.opcode.form(version) else {
        return Value::Null;
    };
    let names = explain::operand_names(statement.opcode, form);
    let tokens = line.tokens.get(statement.operands.clone()).unwrap_or(&[]);
    let active = tokens
        .iter()
        .filter(|t| t.is(',') && t.at.start < offset)
        .count();
    if active >= names.len() {
        return Value::Null;
    }
    let parameters: Vec<Value> = names.iter().map(|name| json!({ "label": name })).collect();
    json!({
        "signatures": [{
            "label": explain::written(statement.opcode, form),
            "documentation": client.markup(&format!("`{}`", form.formula)),
            "parameters": parameters,
        }],
        "activeSignature": 0,
        "activeParameter": active,
    })
}

//! Symbols of a document, and what can be folded in it.

use super::analysis::{Analysis, Shader};
use super::client::Client;
use super::documents::Document;
use super::{directives, macros};
use serde_json::{Value, json};
use std::ops::Range;
use texcrd::extract::Form;
use texcrd::isa::Opcode;
use texcrd::program::{Program, Statement};

/// Numbers of the protocol.
const NAMESPACE: u8 = 3;
const FUNCTION: u8 = 12;
const VARIABLE: u8 = 13;
const CONSTANT: u8 = 14;

/// A symbol.
struct Symbol {
    name: String,
    detail: String,
    kind: u8,
    /// All of it.
    at: Range<usize>,
    /// What to go to.
    name_at: Range<usize>,
    children: Vec<Symbol>,
}

/// The shaders of a document with their declarations and phases, and its macros.
pub(super) fn symbols(analysis: &Analysis, document: &Document, client: &Client) -> Value {
    if !analysis.ours {
        return json!([]);
    }
    let shaders = analysis
        .shaders
        .iter()
        .map(|shader| of_shader(analysis, shader));
    let macros = macros::all(analysis).into_iter().filter_map(|definition| {
        let at = analysis.written(definition.name)?;
        Some(Symbol {
            name: definition.word,
            detail: "macro".to_string(),
            kind: if definition.arguments {
                FUNCTION
            } else {
                CONSTANT
            },
            at: at.clone(),
            name_at: at,
            children: Vec::new(),
        })
    });
    let mut all: Vec<Symbol> = shaders.chain(macros).collect();
    all.sort_by_key(|symbol| symbol.at.start);
    let mut told = Vec::new();
    for symbol in all {
        match client.nested_symbols {
            true => told.push(nested(document, symbol)),
            false => flat(document, symbol, None, &mut told),
        }
    }
    json!(told)
}

fn of_shader(analysis: &Analysis, shader: &Shader) -> Symbol {
    let program = shader.program.as_ref();
    let version = program.map_or("shader", |program| program.version.name());
    let alone = analysis.form == Form::Listing;
    let version_at = program.and_then(|program| analysis.written(program.version_span));
    Symbol {
        name: if alone {
            version.to_string()
        } else {
            shader.name.clone()
        },
        detail: if alone {
            String::new()
        } else {
            version.to_string()
        },
        kind: FUNCTION,
        name_at: version_at.unwrap_or(shader.region.start..shader.region.start),
        children: program
            .filter(|_| shader.listing)
            .map_or(Vec::new(), |p| parts(analysis, shader, p)),
        at: shader.region.clone(),
    }
}

/// The declarations of a shader, and its phases if it has two.
fn parts(analysis: &Analysis, shader: &Shader, program: &Program) -> Vec<Symbol> {
    let one = |name: String, detail: String, kind, span, name_span| {
        let at = analysis.written(span)?;
        let name_at = analysis.written(name_span).unwrap_or(at.clone());
        Some(Symbol {
            name,
            detail,
            kind,
            at,
            name_at,
            children: Vec::new(),
        })
    };
    let mut found = Vec::new();
    for statement in &program.statements {
        match statement {
            Statement::Def(def) => {
                let value = def.value.map(|number| number.to_string()).join(", ");
                found.extend(one(
                    def.register.to_string(),
                    value,
                    CONSTANT,
                    def.span,
                    def.register_span,
                ));
            }
            Statement::Dcl(dcl) => {
                let usage = format!("{}{}", dcl.usage.name(), dcl.usage_index);
                found.extend(one(
                    dcl.register.to_string(),
                    usage,
                    VARIABLE,
                    dcl.span,
                    dcl.span,
                ));
            }
            Statement::Instruction(_) => {}
        }
    }
    for (name, at) in ["first phase", "second phase"]
        .into_iter()
        .zip(phases(analysis, shader, program))
    {
        found.push(Symbol {
            name: name.to_string(),
            detail: String::new(),
            kind: NAMESPACE,
            name_at: at.start..at.start,
            at,
            children: Vec::new(),
        });
    }
    found.sort_by_key(|symbol| symbol.at.start);
    found
}

/// Where the phases of a shader stand, if it has two: from the first to the last of their instructions, `phase` with the second.
fn phases(analysis: &Analysis, shader: &Shader, program: &Program) -> Vec<Range<usize>> {
    let at = |span| analysis.written(span);
    let spans: Vec<_> = program
        .instructions()
        .map(|i| (i.opcode == Opcode::Phase, i.span))
        .collect();
    let Some(middle) = spans.iter().position(|(is_phase, _)| *is_phase) else {
        return Vec::new();
    };
    let (first, second) = spans.split_at(middle);
    let part = |part: &[(bool, texcrd::diagnostic::Span)]| {
        let start = at(part.first()?.1)?.start;
        let end = at(part.last()?.1)?.end;
        let end = end.min(shader.region.end);
        (start <= end).then_some(start..end)
    };
    match (part(first), part(second)) {
        (Some(first), Some(second)) => vec![first, second],
        _ => Vec::new(),
    }
}

/// A symbol that stands within another has to lie in it, and its name in itself.
fn nested(document: &Document, symbol: Symbol) -> Value {
    let bytes = document.text.as_bytes();
    let at = symbol.at.start.min(symbol.name_at.start)..symbol.at.end.max(symbol.name_at.end);
    let children = symbol
        .children
        .into_iter()
        .map(|child| nested(document, child));
    json!({
        "name": symbol.name,
        "detail": symbol.detail,
        "kind": symbol.kind,
        "range": document.lines.range(bytes, &at),
        "selectionRange": document.lines.range(bytes, &symbol.name_at),
        "children": children.collect::<Vec<_>>(),
    })
}

fn flat(document: &Document, symbol: Symbol, within: Option<&str>, told: &mut Vec<Value>) {
    let range = document.lines.range(document.text.as_bytes(), &symbol.at);
    let mut one = json!({
        "name": symbol.name,
        "kind": symbol.kind,
        "location": { "uri": document.uri, "range": range },
    });
    if let Some(within) = within {
        one["containerName"] = json!(within);
    }
    told.push(one);
    for child in symbol.children {
        flat(document, child, Some(&symbol.name), told);
    }
}

/// What can be folded: shaders in other files, phases, conditions, comments of several lines.
pub(super) fn folds(analysis: &Analysis, document: &Document) -> Value {
    if !analysis.ours {
        return json!([]);
    }
    let bytes = document.text.as_bytes();
    let line = |offset| document.lines.position(bytes, offset).line;
    let lines = |at: &Range<usize>| (line(at.start), line(at.end));
    let mut found: Vec<(u32, u32, &str)> = Vec::new();
    for shader in analysis.shaders.iter().filter(|shader| shader.listing) {
        if analysis.form != Form::Listing {
            let (start, end) = lines(&shader.region);
            // The line of the brace that closes a block stays.
            let end = if analysis.in_strings() {
                end
            } else {
                end.saturating_sub(1)
            };
            found.push((start, end, "region"));
        }
        let phases = shader
            .program
            .as_ref()
            .map_or(Vec::new(), |p| phases(analysis, shader, p));
        found.extend(
            phases
                .iter()
                .map(lines)
                .map(|(start, end)| (start, end, "region")),
        );
    }
    let conditions = directives::conditions(bytes, &document.lines);
    found.extend(
        conditions
            .into_iter()
            .map(|(start, end)| (start, end, "region")),
    );
    if analysis.form == Form::Listing {
        found.extend(
            comments(&document.text)
                .into_iter()
                .map(|(start, end)| (start, end, "comment")),
        );
    }
    found.retain(|(start, end, _)| start < end);
    let one = |(start, end, kind)| json!({ "startLine": start, "endLine": end, "kind": kind });
    json!(found.into_iter().map(one).collect::<Vec<_>>())
}

/// Lines, from 0, that hold comments only, as far as they follow each other.
fn comments(text: &str) -> Vec<(u32, u32)> {
    let (mut found, mut open): (Vec<(u32, u32)>, bool) = (Vec::new(), false);
    for (number, line) in text.lines().enumerate() {
        let (number, line) = (number as u32, line.trim());
        let begins = line.starts_with("/*");
        let comment = open || begins || line.starts_with(';') || line.starts_with("//");
        if open || begins {
            open = !line.contains("*/");
        }
        match found.last_mut() {
            Some((_, end)) if comment && *end + 1 == number => *end = number,
            _ if comment => found.push((number, number)),
            _ => {}
        }
    }
    found
}

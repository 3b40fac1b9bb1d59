//! Hovers.

use super::analysis::Analysis;
use super::client::Client;
use super::documents::Document;
use super::words::{self, Kind};
use super::{macros, registers};
use serde_json::{Value, json};
use std::ops::Range;
use texcrd::explain;
use texcrd::isa::modifier::ResultSuffix;
use texcrd::isa::{Opcode, SourceModifier};
use texcrd::program::Usage;

/// What there is to say of the word at a byte of a document.
pub(super) fn hover(
    analysis: &Analysis,
    document: &Document,
    offset: usize,
    client: &Client,
) -> Value {
    let found = of_macro(analysis, document, offset)
        .or_else(|| of_word(analysis, document, offset, client));
    let Some((text, at)) = found else {
        return Value::Null;
    };
    let range = document.lines.range(document.text.as_bytes(), &at);
    json!({ "contents": client.markup(&text), "range": range })
}

type Hover = (String, Range<usize>);

fn of_macro(analysis: &Analysis, document: &Document, offset: usize) -> Option<Hover> {
    let at = macros::name_at(analysis, document, offset)?;
    let name = document.text.get(at.clone())?;
    let mut text = String::new();
    for found in macros::definitions(analysis, name, at.start) {
        let shown: String = found.text.chars().take(LONGEST).collect();
        text.push_str(&format!("```c\n{shown}\n```\n"));
        if let Some((uri, range)) = analysis.place(found.name) {
            let file = uri.rsplit('/').next().unwrap_or_default();
            text.push_str(&format!(
                "\ndefined in {file}, line {}\n\n",
                range.start.line + 1
            ));
        }
    }
    (!text.is_empty()).then_some((text, at))
}

/// The most of a macro that is shown, in characters.
const LONGEST: usize = 2000;

fn of_word(
    analysis: &Analysis,
    document: &Document,
    offset: usize,
    client: &Client,
) -> Option<Hover> {
    let text = &document.text;
    let shader = analysis.shader_at(offset).filter(|shader| shader.listing)?;
    let line = words::line_at(text, &shader.region, analysis.in_strings(), offset);
    if line.is_directive() || line.in_comment(text, offset) {
        return None;
    }
    let version = shader.program.as_ref().map(|program| program.version);
    let version_at = shader
        .program
        .as_ref()
        .and_then(|p| analysis.editable(p.version_span));
    if let (Some(version), Some(at)) = (version, version_at)
        && at.start <= offset
        && offset <= at.end
    {
        return Some((client.page(&explain::version(version)), at));
    }
    let touched = line.touched(offset)?;
    let token = line.tokens.get(touched)?;
    let word = token.text(text);
    let statements = line.statements(text);
    if statements.iter().any(|s| s.mnemonic == token.at) {
        let (opcode, suffixes) = words::mnemonic(word)?;
        let start = token.at.end - suffixes.len();
        if opcode == Opcode::Dcl {
            let name = suffixes.trim_start_matches('_');
            let usage = Usage::from_name(name.trim_end_matches(|c: char| c.is_ascii_digit()));
            let page = usage.map_or_else(
                || explain::instruction(opcode, version),
                explain::declaration,
            );
            return Some((client.page(&page), token.at.clone()));
        }
        if offset > start && !suffixes.is_empty() {
            return result_suffix(suffixes, start, offset, client);
        }
        let page = explain::instruction(opcode, version);
        return Some((client.page(&page), token.at.clone()));
    }
    if let Some((_, suffix)) = words::register(word).filter(|_| token.kind == Kind::Word) {
        let start = token.at.end - suffix.len();
        if offset > start && !suffix.is_empty() {
            let page = explain::modifier(SourceModifier::from_text("", suffix)?);
            return Some((client.page(&page), start..token.at.end));
        }
    }
    if let Some((shader, used)) = registers::use_at(analysis, text, offset) {
        let at = analysis.editable(used.span)?;
        let mut page = String::new();
        for fact in registers::holds(analysis, shader, used) {
            page.push_str(&format!("{fact}  \n"));
        }
        if !page.is_empty() {
            page.push_str("\n---\n\n");
        }
        let register = used.register;
        let general = explain::register(register.file, Some(register.index), version);
        page.push_str(&client.page(&general));
        return Some((page, at));
    }
    let ((file, index), _) = words::register(word)?;
    let page = explain::register(file, Some(index), version);
    Some((client.page(&page), token.at.clone()))
}

/// The suffix of a mnemonic that a place lies in.
fn result_suffix(suffixes: &str, start: usize, offset: usize, client: &Client) -> Option<Hover> {
    let mut at = start;
    for part in suffixes.split('_').skip(1) {
        let here = at..at + 1 + part.len();
        if offset <= here.end {
            let row = ResultSuffix::all().find(|row| row.suffix.trim_start_matches('_') == part)?;
            return Some((client.page(&explain::result(row)), here));
        }
        at = here.end;
    }
    None
}

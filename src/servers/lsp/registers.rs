//! Registers of a document: which one stands at a place, who gave it its value, who reads it.

use super::analysis::{Analysis, Shader};
use std::ops::Range;
use texcrd::isa::RegisterFile;
use texcrd::program::Statement;
use texcrd::validate::{Use, UseKind, origins};

/// The use of a register at a byte of the document.
pub(super) fn use_at<'a>(
    analysis: &'a Analysis,
    text: &str,
    offset: usize,
) -> Option<(&'a Shader, &'a Use)> {
    let shader = analysis.shader_at(offset)?;
    let here = |u: &&Use| {
        analysis
            .editable(u.span)
            .is_some_and(|at| at.start <= offset && offset <= at.end)
    };
    let found: Vec<&Use> = shader.uses().iter().filter(here).collect();
    // Between the brackets of `c[a0.x + 2]` is the address, outside of them the constant.
    let brackets = |u: &Use| -> Option<Range<usize>> {
        let at = analysis.editable(u.span)?;
        let operand = text.get(at.clone())?;
        Some(at.start + operand.find('[')?..at.start + operand.find(']')?)
    };
    let inside = found
        .first()
        .and_then(|u| brackets(u))
        .is_some_and(|b| b.contains(&offset));
    let address = |u: &&&Use| (u.register.file == RegisterFile::Addr) == inside;
    let found = found.iter().find(address).or(found.first())?;
    Some((shader, found))
}

/// The uses of a register in a shader, in the order of the text.
pub(super) fn same<'s>(shader: &'s Shader, of: &'s Use) -> impl Iterator<Item = &'s Use> {
    shader.uses().iter().filter(|u| u.register == of.register)
}

/// Where the value of a use comes from: for a constant its `def`, for an input its `dcl`; for what is read the last writes of
/// its components; for what is written all writes.
pub(super) fn definitions<'s>(shader: &'s Shader, of: &'s Use) -> Vec<&'s Use> {
    let given = |u: &&Use| matches!(u.kind, UseKind::Define | UseKind::Declare);
    let given: Vec<&Use> = same(shader, of).filter(given).collect();
    if !given.is_empty() {
        return given;
    }
    match of.kind {
        UseKind::Read => origins(shader.uses(), of),
        _ => same(shader, of)
            .filter(|u| u.kind == UseKind::Write)
            .collect(),
    }
}

/// What a register holds at a place, in Markdown: one line a fact.
pub(super) fn holds(analysis: &Analysis, shader: &Shader, of: &Use) -> Vec<String> {
    let Some(program) = &shader.program else {
        return Vec::new();
    };
    let letters = program.letters();
    let line = |u: &Use| {
        let statement = program.statements.get(u.statement)?;
        let (_, place) = analysis.place(statement.span())?;
        let text = match statement {
            Statement::Instruction(instruction) => instruction.text(&analysis.sources),
            other => analysis
                .sources
                .text(other.span())
                .split_whitespace()
                .collect::<Vec<_>>()
                .join(" "),
        };
        Some(format!(
            "line {}: `{}`",
            place.start.line + 1,
            text.replace('`', "'")
        ))
    };
    let mut facts = Vec::new();
    let defined = same(shader, of).any(|u| u.kind == UseKind::Define);
    match of.register.file {
        RegisterFile::Const if of.register.relative => {
            facts.push("Which constant it is, `a0.x` says when the shader runs.".to_string());
        }
        RegisterFile::Const if !defined => {
            facts.push("No `def` gives it a value: the program sets it.".to_string());
        }
        RegisterFile::Const => {
            let given = same(shader, of).filter(|u| u.kind == UseKind::Define);
            facts.extend(
                given
                    .filter_map(line)
                    .map(|line| format!("Defined in {line}")),
            );
        }
        RegisterFile::Input => {
            let given = same(shader, of).filter(|u| u.kind == UseKind::Declare);
            facts.extend(
                given
                    .filter_map(line)
                    .map(|line| format!("Declared in {line}")),
            );
        }
        _ if of.kind == UseKind::Read => {
            let mut open = of.components;
            for origin in origins(shader.uses(), of) {
                let part = origin.components.and(open);
                open = open.without(origin.components);
                let name = format!("{}{}", of.register, part.text(letters));
                facts.extend(line(origin).map(|line| format!("`{name}` was written in {line}")));
            }
            let comes_in = of.register.file == RegisterFile::Texture;
            if !open.is_empty() && !comes_in {
                let name = format!("{}{}", of.register, open.text(letters));
                facts.push(format!("Nothing has written `{name}` here."));
            }
        }
        _ => {
            let readers: Vec<String> = readers(shader, of).into_iter().filter_map(line).collect();
            facts.extend(readers.into_iter().map(|line| format!("Read in {line}")));
        }
    }
    facts
}

/// The reads that get a value which is written here, the first ones.
fn readers<'s>(shader: &'s Shader, of: &'s Use) -> Vec<&'s Use> {
    const MOST: usize = 8;
    let mut later: Vec<&Use> = same(shader, of).filter(|u| u.group > of.group).collect();
    // Both halves of a pair read before either writes.
    later.sort_by_key(|u| (u.group, u.kind == UseKind::Write));
    let (mut open, mut found) = (of.components, Vec::new());
    for u in later {
        if open.is_empty() || found.len() == MOST {
            break;
        }
        match u.kind {
            UseKind::Read if !u.components.and(open).is_empty() => found.push(u),
            UseKind::Write => open = open.without(u.components),
            _ => {}
        }
    }
    found
}

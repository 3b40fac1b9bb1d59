//! Listings, and what stands in tokens for them.

use super::page::Fact;
use crate::bytecode;
use crate::diagnostic::SourceMap;
use crate::isa::Version;
use crate::program::{Program, Statement};
use crate::syntax;

/// The listing of an example of the table.
pub(super) fn listing(version: Version, example: &str) -> String {
    format!("{version}\n{example}\n")
}

/// The first statement of an example that `is` says it is, with its tokens word by word, each with what it holds. `None` if the
/// example has no such statement, which a test rules out.
pub(super) fn of_first(
    version: Version,
    example: &str,
    is: impl Fn(&Statement) -> bool,
) -> Option<(String, Vec<Fact>)> {
    let mut sources = SourceMap::new();
    let file = sources.add("example", listing(version, example)).ok()?;
    let program = syntax::parse(file).program?;
    let statement = program.statements.iter().find(|s| is(s))?.clone();
    let text = line(version, statement.clone());
    let alone = Program {
        statements: vec![statement],
        comments: Vec::new(),
        ..program
    };
    let words = bytecode::encode(&alone).ok()?;
    // What comes back says what is in the tokens, which is not always what was written.
    let decoded = bytecode::decode(&words).program?.statements.pop()?;
    let held = line(version, decoded);
    let inner = words.get(1..words.len().checked_sub(1)?)?;
    let facts = inner.iter().zip(labels(&held));
    let facts = facts.map(|(word, held)| Fact::new(format!("{word:08X}"), held));
    Some((text, facts.collect()))
}

/// One statement as a listing has it.
fn line(version: Version, statement: Statement) -> String {
    let program = Program {
        version,
        version_span: Default::default(),
        statements: vec![statement],
        comments: Vec::new(),
        span: Default::default(),
    };
    let text = syntax::print(&program);
    text.lines().nth(1).unwrap_or_default().to_string()
}

/// What each word of a statement holds: mnemonic, operands, numbers. Suffixes of the mnemonic are in the destination, the usage
/// of a `dcl` has a word of its own.
fn labels(line: &str) -> Vec<String> {
    let (mnemonic, operands) = line.split_once(' ').unwrap_or((line, ""));
    let (mnemonic, suffixes) = match mnemonic.find('_') {
        Some(at) => mnemonic.split_at(at),
        None => (mnemonic, ""),
    };
    let mut labels = vec![mnemonic.to_string()];
    let mut operands: Vec<String> = (operands.split(", "))
        .filter(|operand| !operand.is_empty())
        .map(str::to_string)
        .collect();
    if let Some(usage) = suffixes.strip_prefix('_').filter(|_| mnemonic == "dcl") {
        labels.push(usage.to_string());
    } else if let Some(destination) = operands.first_mut().filter(|_| !suffixes.is_empty()) {
        *destination = format!("{destination}, {suffixes}");
    }
    labels.append(&mut operands);
    labels
}

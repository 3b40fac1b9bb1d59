//! Which things a name means.

use super::page::Page;
use super::subject::Subject;
use crate::bytecode::{Macro, register_named};
use crate::isa::modifier::ResultSuffix;
use crate::isa::operand::{RGBA, XYZW};
use crate::isa::{Notation, Opcode, RegisterFile, SourceModifier, Version};
use crate::policy::Policy;
use crate::program::Usage;
use crate::rules;
use crate::syntax::{distance, foreign_mnemonic};
use std::fmt;

/// A name that means nothing here.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unknown {
    /// The name as it was given.
    pub name: String,
    /// Names that differ little from it; a few.
    pub near: Vec<String>,
    /// Where it belongs, if it is an instruction that Direct3D 8 does not have.
    pub owner: Option<&'static str>,
}

impl fmt::Display for Unknown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.owner {
            Some(owner) => write!(f, "`{}` is an instruction of {owner}", self.name)?,
            None => write!(f, "there is nothing called `{}`", self.name)?,
        }
        if !self.near.is_empty() {
            let near: Vec<String> = self.near.iter().map(|name| format!("`{name}`")).collect();
            write!(f, "; did you mean {}?", crate::isa::enumerate(&near, "or"))?;
        }
        Ok(())
    }
}

impl std::error::Error for Unknown {}

/// The pages of everything that a name means; with `version` only what this one has of it, where it has it.
///
/// Names are what listings hold, in any case of letters: mnemonics with and without suffixes, registers with and without numbers,
/// whole operands, modifiers, masks, versions; identifiers of rules, which are told from registers by their capital: `R5` and `r5`;
/// opcodes as `0x12` and `D3DSIO_LRP`; hardware models and numeric choices: `gf3`, `rcp-zero`, `policies`.
///
/// # Errors
/// [`Unknown`], with names that are near.
pub fn find(name: &str, version: Option<Version>) -> Result<Vec<Page>, Unknown> {
    let subjects = subjects(name)?;
    Ok(subjects
        .iter()
        .map(|subject| subject.page(version))
        .collect())
}

/// What a name means: mostly one thing, of `mul_x2` and `-r0.a` its parts, of `_x2` both. See [`find`].
///
/// # Errors
/// [`Unknown`], with names that are near.
pub fn subjects(name: &str) -> Result<Vec<Subject>, Unknown> {
    // The longest of them, an operand with everything, is far shorter.
    const LONGEST: usize = 64;
    let text = name.trim().to_ascii_lowercase();
    // Some rules are called as registers are.
    let as_written = rules::find(name.trim()).filter(|_| text != name.trim());
    let found = match as_written {
        Some(rule) => vec![Subject::Rule(rule)],
        None if text.len() <= LONGEST => meant(&text),
        None => Vec::new(),
    };
    if !found.is_empty() {
        return Ok(found);
    }
    Err(Unknown {
        near: near(&text),
        owner: foreign_mnemonic(&text),
        name: name.trim().chars().take(LONGEST).collect(),
    })
}

/// What a name in lower case means; the first way of reading that gives something.
fn meant(text: &str) -> Vec<Subject> {
    let ways: [fn(&str) -> Vec<Subject>; 11] = [
        // Before registers: r200 is none.
        model,
        |text| version(text).map(Subject::Version).into_iter().collect(),
        opcodes_of_token,
        of_header,
        mnemonic,
        notation,
        modifier,
        |text| register(text).into_iter().collect(),
        |text| rules::find(text).map(Subject::Rule).into_iter().collect(),
        component_letters,
        operand,
    ];
    let mut found = ways.iter().map(|way| way(text));
    let found = found.find(|found| !found.is_empty()).unwrap_or_default();
    // `def` and `logp` are an instruction and what is chosen of it.
    found.into_iter().chain(policy(text)).collect()
}

/// `ps.1.4`, `ps_1_4`, `ps14`.
fn version(text: &str) -> Option<Version> {
    let bare = |text: &str| text.replace(['.', '_'], "");
    Version::all().find(|version| bare(version.name()) == bare(text))
}

/// `0x12` and `d3dsio_lrp`: every instruction with the token.
fn opcodes_of_token(text: &str) -> Vec<Subject> {
    let token = match (text.strip_prefix("0x"), text.strip_prefix("d3dsio_")) {
        (Some(digits), _) => u16::from_str_radix(digits, 16).ok(),
        (None, Some(name)) => Opcode::from_mnemonic(name).map(|opcode| opcode.row().token),
        (None, None) => None,
    };
    let with_token = |opcode: &Opcode| token.is_some_and(|token| opcode.row().token == token);
    let all = Opcode::all().filter(with_token);
    all.map(Subject::Instruction).collect()
}

/// `models`, `--model`, `gf3`.
fn model(text: &str) -> Vec<Subject> {
    match (text.trim_start_matches('-'), text.parse()) {
        (_, Ok(model)) => vec![Subject::Model(Some(model))],
        ("model" | "models", _) => vec![Subject::Model(None)],
        _ => Vec::new(),
    }
}

/// `policies`, `--policy`, `rcp-zero`, `scalar=x`.
fn policy(text: &str) -> Option<Subject> {
    if matches!(text.trim_start_matches('-'), "policy" | "policies") {
        return Some(Subject::Policy(None));
    }
    let (name, value) = match text.split_once('=') {
        Some((name, value)) => (name.trim(), Some(value.trim())),
        None => (text, None),
    };
    let has = |policy: &&Policy| {
        value.is_none_or(|value| policy.values().iter().any(|known| known.name == value))
    };
    let policy = Policy::named(name).filter(has)?;
    Some(Subject::Policy(Some(policy)))
}

/// `d3dvsd_reg`, `d3dvsde_normal`, `d3dvsdt_float3`.
fn of_header(text: &str) -> Vec<Subject> {
    if let Some(register) = register_named(text) {
        return vec![Subject::Register(RegisterFile::Input, Some(register))];
    }
    let is = |name: &str| name.eq_ignore_ascii_case(text);
    let named = |of: &&Macro| is(of.name()) || of.types().any(|(name, _)| is(name));
    Macro::all().filter(named).map(Subject::Macro).collect()
}

/// `lrp`, `mul_x2_sat`, `dcl_texcoord3`.
fn mnemonic(text: &str) -> Vec<Subject> {
    let (stem, suffixes) = match text.find('_') {
        Some(at) => text.split_at(at),
        None => (text, ""),
    };
    let Some(opcode) = Opcode::from_mnemonic(stem) else {
        return Vec::new();
    };
    let mut found = vec![Subject::Instruction(opcode)];
    for part in suffixes.split('_').skip(1) {
        let declared = (opcode == Opcode::Dcl).then(|| usage(part)).flatten();
        let suffix = ResultSuffix::all().find(|row| row.suffix.trim_start_matches('_') == part);
        match (declared, suffix) {
            (Some(usage), _) => found = vec![Subject::Declaration(usage)],
            (None, Some(suffix)) => found.push(Subject::Result(suffix)),
            (None, None) => return Vec::new(),
        }
    }
    found
}

/// `position`, `texcoord3`.
fn usage(text: &str) -> Option<Usage> {
    Usage::from_name(text.trim_end_matches(|c: char| c.is_ascii_digit()))
}

fn notation(text: &str) -> Vec<Subject> {
    let named = |notation: &Notation| notation.row().names.contains(&text);
    let found = Notation::all().filter(named);
    found.map(Subject::Notation).collect()
}

/// `_bx2`, `bx2`, `-`, `1-`, `sat`: of sources and of results.
fn modifier(text: &str) -> Vec<Subject> {
    let split = |text: &'_ str| -> Option<SourceModifier> {
        let (prefix, suffix) = prefix_of(text);
        let suffix = match suffix.strip_prefix('_') {
            None if !suffix.is_empty() => format!("_{suffix}"),
            _ => suffix.to_string(),
        };
        SourceModifier::from_text(prefix, &suffix).filter(|m| *m != SourceModifier::None)
    };
    let source = split(text).map(Subject::Modifier);
    let result = ResultSuffix::all()
        .find(|row| row.suffix.trim_start_matches('_') == text.trim_start_matches('_'))
        .map(Subject::Result);
    source.into_iter().chain(result).collect()
}

/// What stands in front of a register, and the rest.
fn prefix_of(text: &str) -> (&'static str, &str) {
    ["1-", "-"]
        .into_iter()
        .find_map(|prefix| Some((prefix, text.strip_prefix(prefix)?)))
        .unwrap_or(("", text))
}

/// `r0`, `r#`, `r`, `oPos`, `oT`.
fn register(text: &str) -> Option<Subject> {
    if let Some((file, index)) = RegisterFile::named(text) {
        return Some(Subject::Register(file, Some(index)));
    }
    let letters = text.trim_end_matches('#');
    let named = |file: &RegisterFile| {
        file.row().prefix.eq_ignore_ascii_case(letters)
            || file.any_name().eq_ignore_ascii_case(text)
    };
    let file = RegisterFile::all().find(named)?;
    Some(Subject::Register(file, None))
}

/// `.rgb`: behind a destination a write mask, behind a source a swizzle.
fn component_letters(text: &str) -> Vec<Subject> {
    let is_letters = |letters: &str| {
        let of = |set: [char; 4]| letters.chars().all(|c| set.contains(&c));
        (1..=4).contains(&letters.len()) && (of(XYZW) || of(RGBA))
    };
    match text.strip_prefix('.') {
        Some(letters) if is_letters(letters) => [Notation::WriteMask, Notation::Swizzle]
            .map(Subject::Notation)
            .into(),
        _ => Vec::new(),
    }
}

/// A whole operand: `-r0_bx2.a`, `c[a0.x + 4].w`, `oT0.xy`.
fn operand(text: &str) -> Vec<Subject> {
    let (prefix, rest) = prefix_of(text);
    let (rest, index) = match (rest.find('['), rest.rfind(']')) {
        (Some(open), Some(close)) if open < close => {
            let index = rest.get(open + 1..close).unwrap_or_default();
            let mut without = rest.get(..open).unwrap_or_default().to_string();
            without += rest.get(close + 1..).unwrap_or_default();
            (without, Some(index.trim().to_string()))
        }
        (None, None) => (rest.to_string(), None),
        _ => return Vec::new(),
    };
    let (rest, letters) = match rest.find('.') {
        Some(at) => rest.split_at(at),
        None => (&*rest, ""),
    };
    let (stem, suffix) = match rest.find('_') {
        Some(at) => rest.split_at(at),
        None => (rest, ""),
    };
    let Some(register) = register(stem) else {
        return Vec::new();
    };
    let mut found = vec![register];
    match index.as_deref().map(|index| index.parse::<u32>()) {
        Some(Ok(index)) => {
            if let Subject::Register(file, _) = register {
                found = vec![Subject::Register(file, Some(index))];
            }
        }
        Some(Err(_)) => found.push(Subject::Notation(Notation::Relative)),
        None => {}
    }
    let modifier = SourceModifier::from_text(prefix, suffix);
    match modifier {
        Some(SourceModifier::None) => {}
        Some(modifier) => found.push(Subject::Modifier(modifier)),
        None => return Vec::new(),
    }
    let behind = component_letters(letters);
    if behind.is_empty() && !letters.is_empty() {
        return Vec::new();
    }
    // What is modified is a source.
    let modified = !matches!(modifier, Some(SourceModifier::None)) || index.is_some();
    found.extend(behind.into_iter().filter(|notation| {
        !(modified && matches!(notation, Subject::Notation(Notation::WriteMask)))
    }));
    found
}

/// Names that differ from a text by a slip of the hand, the nearest first, or that begin with it.
fn near(text: &str) -> Vec<String> {
    const MOST: usize = 4;
    const SHORTEST: usize = 3;
    if text.chars().count() < SHORTEST {
        return Vec::new();
    }
    let furthest = if text.len() > 4 { 2 } else { 1 };
    let mut all: Vec<(usize, String)> = Subject::all()
        .map(|subject| subject.name())
        .filter(|name| name.len() >= SHORTEST)
        .map(|name| match name.to_ascii_lowercase().starts_with(text) {
            true => (furthest, name),
            false => (distance(text, &name), name),
        })
        .filter(|(apart, _)| *apart <= furthest)
        .collect();
    all.sort();
    all.truncate(MOST);
    all.into_iter().map(|(_, name)| name).collect()
}

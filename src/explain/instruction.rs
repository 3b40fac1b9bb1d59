//! Pages of instructions.

use super::page::{Fact, Page};
use super::{encoding, rule};
use crate::isa::modifier::ResultSuffix;
use crate::isa::opcode::{Class, Form, ModifierRule, Pairing, Slots, SourceShape};
use crate::isa::operand::MaskSet;
use crate::isa::{
    FileSet, Opcode, RegisterFile, ShaderKind, SourceModifier, Version, VersionSet, WriteMask,
    enumerate,
};
use crate::program::{Statement, Usage, letters};

/// What the letters of formulas stand for, in the order in which it is told.
const LEGEND: [(&str, &str); 7] = [
    ("[m", "m is the number of the destination"),
    ("TC[", "TC[m] are the texture coordinates m"),
    ("S[", "S[m](p) is the texture of stage m at p"),
    (
        "row 0",
        "row 0 and row 1 are what the pads before it computed",
    ),
    (
        "row i",
        "row i is the register i places behind s1, d.i the component i of d",
    ),
    (
        "M00",
        "M00 to M11 are the bump matrix of the destination's stage",
    ),
    ("LS", "LS and LO are luminance scale and offset of stage m"),
];

/// What an instruction does: meaning, formula, slots, operands, tokens, rules, an example, for every group of versions that has
/// it; with `version` only as this one has it, if it does.
pub fn instruction(opcode: Opcode, version: Option<Version>) -> Page {
    let row = opcode.row();
    let mut page = Page::new(row.mnemonic, row.title);
    let only = version.and_then(|version| opcode.form(version));
    let forms: Vec<&Form> = row
        .forms
        .iter()
        .filter(|form| only.is_none_or(|only| std::ptr::eq(only, *form)))
        .collect();
    page.paragraph(row.meaning);
    let mut facts = vec![
        Fact::new("versions", opcode.versions().to_string()),
        Fact::new("token", format!("0x{:02X}", row.token)),
    ];
    // What is the same in all forms is said once.
    let one = |of: &dyn Fn(&Form) -> String| match &forms[..] {
        [first, rest @ ..] => rest.iter().all(|form| of(form) == of(first)),
        [] => false,
    };
    let one_text = one(&|form| written(opcode, form));
    let one_formula = one(&|form| form.formula.to_string());
    if let Some(form) = forms.first() {
        if one_text {
            facts.push(Fact::new("written", written(opcode, form)));
        }
        if one_formula {
            facts.extend(formula(form));
        }
    }
    page.facts(facts);
    for form in &forms {
        if forms.len() > 1 {
            page.heading(form.versions.to_string());
        }
        page.paragraph(form.note);
        let mut facts = Vec::new();
        if !one_text {
            facts.push(Fact::new("written", written(opcode, form)));
        }
        if !one_formula {
            facts.extend(formula(form));
        }
        facts.push(Fact::new("slots", slots(form)));
        facts.extend(operands(form));
        page.facts(facts);
        let shown = version.filter(|version| form.versions.contains(*version));
        if let Some(shown) = shown.or_else(|| form.versions.iter().last()) {
            page.listing(encoding::listing(shown, form.example).trim_end());
        }
    }
    if let Some(form) = forms.last()
        && let Some(version) = form.versions.iter().last()
        && let Some((line, words)) =
            encoding::of_first(version, form.example, |statement| is(statement, opcode))
    {
        page.heading(format!("Tokens of {line} in {version}"));
        page.facts(words);
    }
    rule::mention(&mut page, row.mnemonic);
    page.see = row.see.iter().map(|o| o.mnemonic().to_string()).collect();
    page
}

/// Whether a statement is one of this opcode.
pub(super) fn is(statement: &Statement, opcode: Opcode) -> bool {
    match statement {
        Statement::Instruction(i) => i.opcode == opcode,
        Statement::Def(_) => opcode == Opcode::Def,
        Statement::Dcl(_) => opcode == Opcode::Dcl,
    }
}

/// The formula, and what its letters stand for.
fn formula(form: &Form) -> Vec<Fact> {
    let mut facts = vec![Fact::new("formula", form.formula)];
    let told = LEGEND
        .iter()
        .filter(|(part, _)| form.formula.contains(part));
    let told: Vec<&str> = told.map(|(_, text)| *text).collect();
    if !told.is_empty() {
        facts.push(Fact::new("where", told.join("; ")));
    }
    facts
}

/// An instruction as it is written, with the names of its operands in the formula: `mad d, s0, s1, s2`.
pub fn written(opcode: Opcode, form: &Form) -> String {
    let mnemonic = match opcode {
        Opcode::Dcl => "dcl_usage",
        _ => opcode.mnemonic(),
    };
    let operands = operand_names(opcode, form).join(", ");
    format!("{mnemonic} {operands}").trim_end().to_string()
}

/// The operands of an instruction by their names in its formula, in the order in which they are written.
pub fn operand_names(opcode: Opcode, form: &Form) -> Vec<String> {
    match opcode {
        Opcode::Def => return ["c#", "x", "y", "z", "w"].map(str::to_string).to_vec(),
        Opcode::Dcl => return vec!["v#".to_string()],
        _ => {}
    }
    let destination = form
        .destination
        .map(|_| match form.formula.contains("t(m)") {
            true => "t(m)".to_string(),
            false => "d".to_string(),
        });
    let sources = (0..form.sources.len()).map(|i| format!("s{i}"));
    destination.into_iter().chain(sources).collect()
}

/// The slots that a form takes of those that its versions have.
fn slots(form: &Form) -> String {
    let Some(version) = form.versions.iter().last().map(Version::row) else {
        return String::new();
    };
    let within = if version.phases > 1 {
        " in a phase"
    } else {
        ""
    };
    let mut parts = Vec::new();
    if form.arithmetic_slots > 0 {
        let kind = match version.kind {
            ShaderKind::Vertex => "",
            ShaderKind::Pixel => " arithmetic",
        };
        let (used, all) = (form.arithmetic_slots, version.arithmetic_slots);
        parts.push(format!("{used} of {all}{kind}{within}"));
    }
    if form.texture_slots > 0 {
        let (used, all) = (form.texture_slots, version.texture_slots);
        parts.push(format!("{used} of {all} texture{within}"));
    }
    let mut text = match parts.is_empty() {
        true => "none".to_string(),
        false => parts.join(", "),
    };
    if let Some(most) = form.most {
        text += &format!("; at most {most} in a shader");
    }
    text
}

/// Destination, modifiers of the result, sources and pairing of a form.
fn operands(form: &Form) -> Vec<Fact> {
    let mut facts = Vec::new();
    let Some(version) = form.versions.iter().last() else {
        return facts;
    };
    let kind = version.kind();
    let pixel_arithmetic = kind == ShaderKind::Pixel && form.class == Class::Arithmetic;
    if let Some(shape) = form.destination {
        let mut text = files(shape.files, "or");
        if shape.written {
            text += &format!("; {}", masks(shape.masks, kind));
        } else {
            text += "; looked at, not written";
        }
        facts.push(Fact::new("d", text));
        if pixel_arithmetic {
            let suffixes = ResultSuffix::all().filter(|row| row.versions.contains(version));
            let suffixes: Vec<&str> = suffixes.map(|row| row.suffix).collect();
            facts.push(Fact::new("result", enumerate(&suffixes, "and")));
        }
    }
    let mut next = 0;
    for alike in form.sources.chunk_by(|a, b| a == b) {
        let (first, last) = (next, next + alike.len() - 1);
        next += alike.len();
        let label = match alike.len() {
            1 => format!("s{first}"),
            2 => format!("s{first}, s{last}"),
            _ => format!("s{first} to s{last}"),
        };
        facts.extend(
            alike
                .first()
                .map(|s| Fact::new(label, source(s, form, version))),
        );
    }
    if pixel_arithmetic && form.destination.is_some() {
        let text = match form.pairing {
            Pairing::Never => "no",
            Pairing::Color => "as the half for colour",
            Pairing::Either => "as either half",
        };
        facts.push(Fact::new("in a pair", text));
    }
    facts
}

fn files(files: FileSet, last: &str) -> String {
    let names: Vec<String> = files.iter().map(RegisterFile::any_name).collect();
    enumerate(&names, last)
}

fn masks(masks: MaskSet, kind: ShaderKind) -> String {
    if masks == MaskSet::ANY {
        return "any mask".to_string();
    }
    if masks == MaskSet::FULL {
        return "no mask".to_string();
    }
    let names: Vec<String> = masks.iter().map(|mask| letters_of(mask, kind)).collect();
    format!("mask {}", enumerate(&names, "or"))
}

/// The letters of components, of all four, too.
fn letters_of(mask: WriteMask, kind: ShaderKind) -> String {
    let letters = letters(kind);
    let named = mask.components().filter_map(|c| letters.get(c));
    std::iter::once(&'.').chain(named).collect()
}

fn source(shape: &SourceShape, form: &Form, version: Version) -> String {
    let kind = version.kind();
    let mut parts = vec![files(shape.files, "or")];
    parts.push(match shape.slots {
        Slots::Masked => "reads what the mask names".to_string(),
        Slots::Fixed(slots) => format!("reads {}", letters_of(slots, kind)),
    });
    let having = |has: &dyn Fn(SourceModifier) -> bool| -> String {
        let all = SourceModifier::all().filter(|modifier| has(*modifier));
        let names: Vec<String> = (all.filter(|m| *m != SourceModifier::None))
            // A sign goes in front of most others; that is told on its page.
            .filter(|m| m.row().prefix.is_empty() || m.row().suffix.is_empty())
            .map(super::modifier::name)
            .collect();
        enumerate(&names, "and")
    };
    parts.push(match shape.modifiers {
        ModifierRule::Arithmetic => {
            format!(
                "takes {}",
                having(&|m| m.row().arithmetic.contains(version))
            )
        }
        ModifierRule::Coordinates => {
            let here = |file: RegisterFile| shape.files.contains(file);
            let has = |m: SourceModifier| {
                m.row().coordinates.contains(version) && m.row().divides.is_some_and(here)
            };
            format!("takes {}", having(&has))
        }
        ModifierRule::Bx2(versions) => {
            let bx2 = super::modifier::name(SourceModifier::Bx2);
            match versions.both(form.versions) {
                VersionSet::NONE => "takes no modifier".to_string(),
                all if all == form.versions => format!("takes {bx2}"),
                some => format!("takes {bx2} in {some}"),
            }
        }
        ModifierRule::Matrix => "takes no swizzle and no modifier".to_string(),
        ModifierRule::Plain => "takes no modifier".to_string(),
    });
    parts.join("; ")
}

/// What a `dcl` with this usage is called.
pub(super) fn declaration_name(usage: Usage) -> String {
    format!("{}_{}", Opcode::Dcl.mnemonic(), usage.name())
}

/// What a `dcl` with this usage says.
pub fn declaration(usage: Usage) -> Page {
    let name = declaration_name(usage);
    let mut page = Page::new(&name, Opcode::Dcl.row().title);
    page.paragraph(Opcode::Dcl.row().meaning);
    let mut facts = vec![
        Fact::new("versions", Opcode::Dcl.versions().to_string()),
        Fact::new(
            "usage",
            format!("{} in bits 3:0 of the usage token", usage.code()),
        ),
        Fact::new("index", "0 to 15, in bits 19:16; without one 0"),
    ];
    let indexed = (0..16).filter_map(|index| Some((index, usage.default_register(index)?)));
    let registers: Vec<String> = indexed
        .map(|(index, register)| {
            let input = RegisterFile::Input.register_name(register);
            match index {
                0 => format!("{} in {input}", usage.name()),
                _ => format!("{}{index} in {input}", usage.name()),
            }
        })
        .collect();
    let register = match registers.is_empty() {
        true => "Direct3D 8 has no register of its own for it".to_string(),
        false => enumerate(&registers, "and"),
    };
    facts.push(Fact::new("without dcl", register));
    page.facts(facts);
    let version = Opcode::Dcl.versions().iter().last();
    let example = format!("{name} v0");
    if let Some(version) = version
        && let Some((line, words)) = encoding::of_first(version, &example, |s| is(s, Opcode::Dcl))
    {
        page.heading(format!("Tokens of {line}"));
        page.facts(words);
    }
    page.see = vec![Opcode::Dcl.mnemonic().to_string()];
    page
}

//! Everything that has a page.

use super::page::Page;
use crate::bytecode::Macro;
use crate::isa::modifier::ResultSuffix;
use crate::isa::register::RAST_OUT;
use crate::isa::{Notation, Opcode, RegisterFile, SourceModifier, Version};
use crate::policy::{Model, Policy};
use crate::program::Usage;
use crate::rules::{self, Entry};

/// Something that has a page.
#[derive(Clone, Copy, Debug)]
pub enum Subject {
    /// An instruction.
    Instruction(Opcode),
    /// A `dcl` with its usage.
    Declaration(Usage),
    /// A register file, or one register of it by its number.
    Register(RegisterFile, Option<u32>),
    /// What modifies a source.
    Modifier(SourceModifier),
    /// What modifies a result.
    Result(&'static ResultSuffix),
    /// What is written around registers and instructions.
    Notation(Notation),
    /// A version.
    Version(Version),
    /// A rule.
    Rule(&'static Entry),
    /// A macro that makes a token.
    Macro(&'static Macro),
    /// A hardware model, or all of them.
    Model(Option<Model>),
    /// A numeric choice, or all of them.
    Policy(Option<&'static Policy>),
}

impl Subject {
    /// Every subject, registers by files, the outputs to the rasterizer one by one.
    pub fn all() -> impl Iterator<Item = Subject> {
        let instructions = Opcode::all().map(Subject::Instruction);
        let declarations = Usage::all().map(|(usage, _)| Subject::Declaration(usage));
        let registers = RegisterFile::all().flat_map(|file| {
            let single = match file {
                RegisterFile::RastOut => RAST_OUT.len() as u32,
                _ => 0,
            };
            let whole = (single == 0).then_some(Subject::Register(file, None));
            let each = (0..single).map(move |i| Subject::Register(file, Some(i)));
            whole.into_iter().chain(each)
        });
        let written = |modifier: &SourceModifier| *modifier != SourceModifier::None;
        let modifiers = SourceModifier::all().filter(written).map(Subject::Modifier);
        instructions
            .chain(declarations)
            .chain(registers)
            .chain(modifiers)
            .chain(ResultSuffix::all().map(Subject::Result))
            .chain(Notation::all().map(Subject::Notation))
            .chain(Version::all().map(Subject::Version))
            .chain(Macro::all().map(Subject::Macro))
            .chain(
                [None]
                    .into_iter()
                    .chain(Model::all().map(Some))
                    .map(Subject::Model),
            )
            .chain(
                [None]
                    .into_iter()
                    .chain(Policy::all().map(Some))
                    .map(Subject::Policy),
            )
            .chain(rules::all().map(Subject::Rule))
    }

    /// What it is called; [`super::find`] finds it by this name.
    pub fn name(&self) -> String {
        match *self {
            Subject::Instruction(opcode) => opcode.mnemonic().to_string(),
            Subject::Declaration(usage) => super::instruction::declaration_name(usage),
            Subject::Register(file, None) => file.any_name(),
            Subject::Register(file, Some(index)) => file.register_name(index),
            Subject::Modifier(modifier) => super::modifier::name(modifier),
            Subject::Result(row) => row.suffix.to_string(),
            Subject::Notation(notation) => notation.row().names.first().map_or("", |n| n).into(),
            Subject::Version(version) => version.name().to_string(),
            Subject::Rule(entry) => entry.rule.id.to_string(),
            Subject::Macro(of) => of.name().to_string(),
            Subject::Model(model) => model.map_or("models", Model::name).to_string(),
            Subject::Policy(policy) => policy.map_or("policies", |policy| policy.name).to_string(),
        }
    }

    /// What kind of thing it is: `instruction`, `register`, `modifier`, `notation`, `version`, `rule`,
    /// `macro`, `model`, `policy`.
    pub fn kind(&self) -> &'static str {
        match self {
            Subject::Instruction(_) | Subject::Declaration(_) => "instruction",
            Subject::Register(..) => "register",
            Subject::Modifier(_) | Subject::Result(_) => "modifier",
            Subject::Notation(_) => "notation",
            Subject::Version(_) => "version",
            Subject::Rule(_) => "rule",
            Subject::Macro(_) => "macro",
            Subject::Model(_) => "model",
            Subject::Policy(_) => "policy",
        }
    }

    /// What is said of it, by one version alone if that has it.
    pub fn page(&self, version: Option<Version>) -> Page {
        match *self {
            Subject::Instruction(opcode) => super::instruction(opcode, version),
            Subject::Declaration(usage) => super::declaration(usage),
            Subject::Register(file, index) => super::register(file, index, version),
            Subject::Modifier(modifier) => super::modifier(modifier),
            Subject::Result(row) => super::result(row),
            Subject::Notation(notation) => super::notation(notation, version),
            Subject::Version(version) => super::version(version),
            Subject::Rule(rule) => super::rule(rule),
            Subject::Macro(of) => super::token_macro(of),
            Subject::Model(None) => super::models(),
            Subject::Model(Some(model)) => super::model(model),
            Subject::Policy(None) => super::policies(),
            Subject::Policy(Some(policy)) => super::policy(policy),
        }
    }
}

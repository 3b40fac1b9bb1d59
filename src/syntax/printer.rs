//! Shaders as text, in one canonical form.

use super::comment;
use crate::isa::operand::XYZW;
use crate::isa::{ShaderKind, Swizzle, WriteMask};
use crate::program::{
    Dcl, Def, Destination, Instruction, Item, Program, Source, Statement, letters,
};

/// The listing of a shader: what [`super::parse`] reads back as the same shader, spans apart.
///
/// Lower case, dots in the version, one statement a line, shift before saturation, `+` at the start of the line, masks
/// and swizzles in `rgba` for pixel and `xyzw` for vertex shaders, left out where they say nothing, repeats at their end
/// collapsed. Numbers are the shortest text that gives the same bits; of infinities and NaNs, which are mostly found in
/// tokens, the bits themselves. Comments of a token stream stand behind `;@comment`.
pub fn print(program: &Program) -> String {
    let kind = program.version.kind();
    let mut text = format!("{}\n", program.version);
    for item in program.items() {
        match item {
            Item::Statement(Statement::Instruction(i)) => text += &print_instruction(i, kind),
            Item::Statement(Statement::Def(d)) => text += &print_def(d),
            Item::Statement(Statement::Dcl(d)) => text += &print_dcl(d),
            Item::Comment(c) => text += &comment::print(&c.words),
        }
        text.push('\n');
    }
    text
}

/// One instruction as [`print()`] writes it, with its `+` and without a line end.
pub fn print_instruction(instruction: &Instruction, kind: ShaderKind) -> String {
    let letters = letters(kind);
    let plus = if instruction.co_issue { "+" } else { "" };
    let mnemonic = instruction.opcode.mnemonic();
    let mut text = format!("{plus}{mnemonic}{}", instruction.result.text());
    let destination = instruction.destination.iter();
    let operands: Vec<String> = destination
        .map(|d| print_destination(d, letters))
        .chain(instruction.sources.iter().map(|s| print_source(s, letters)))
        .collect();
    if !operands.is_empty() {
        text.push(' ');
        text += &operands.join(", ");
    }
    text
}

fn print_destination(destination: &Destination, letters: [char; 4]) -> String {
    format!("{}{}", destination.register, destination.mask.text(letters))
}

fn print_source(source: &Source, letters: [char; 4]) -> String {
    let Source {
        register,
        swizzle,
        modifier,
        ..
    } = source;
    let row = modifier.row();
    let swizzle: Swizzle = *swizzle;
    format!(
        "{}{register}{}{}",
        row.prefix,
        row.suffix,
        swizzle.text(letters)
    )
}

fn print_def(def: &Def) -> String {
    let plus = if def.co_issue { "+" } else { "" };
    let values: Vec<String> = def.value.iter().map(|v| print_number(*v)).collect();
    format!("{plus}def {}, {}", def.register, values.join(", "))
}

fn print_dcl(dcl: &Dcl) -> String {
    let index = match dcl.usage_index {
        0 => String::new(),
        index => index.to_string(),
    };
    let mask: WriteMask = dcl.mask;
    format!(
        "dcl_{}{index} {}{}",
        dcl.usage.name(),
        dcl.register,
        mask.text(XYZW)
    )
}

/// The shortest decimal text that reads back as the same bits, or the bits of what has no decimal text.
fn print_number(value: f32) -> String {
    let size = value.abs();
    if !value.is_finite() {
        format!("0x{:08X}", value.to_bits())
    } else if value == 0.0 || (1e-5..1e9).contains(&size) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

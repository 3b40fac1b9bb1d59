//! Operand tokens, bit by bit.

use super::{OPERAND, rules};
use crate::diagnostic::Rule;
use crate::isa::{
    RegisterFile, ResultModifier, ShaderKind, SourceModifier, Swizzle, Version, WriteMask,
};
use crate::program::{Dcl, Destination, Register, Source, Usage};

/// Bits 10:0: the number of the register.
const NUMBER: u32 = 0x7FF;
/// Bits 12:11: the high part of the register type, which Direct3D 8 does not have.
const TYPE_HIGH: u32 = 3 << 11;
/// Bit 13: `a0.x` is added to the number.
const RELATIVE: u32 = 1 << 13;
/// Bits 15:14.
pub(super) const UNUSED: u32 = 3 << 14;
/// Bits 30:28: the register type.
const TYPE: u32 = 28;
/// Bits 19:16 of a destination: the write mask; of a source, with 23:20: the swizzle.
const COMPONENTS: u32 = 16;
/// Bits 23:20 of a destination: how the result is modified. Bit 20 saturates.
const RESULT: u32 = 20;
/// Bits 27:24: the shift of a destination as a number of four bits with sign, or the modifier of a source.
const MODIFIER: u32 = 24;
/// Bits 3:0 and 19:16 of a usage token: which element feeds the register of a `dcl`.
const USAGE: u32 = 0xF;
const USAGE_INDEX: u32 = 16;

/// What is wrong with an operand token, or with an operand that has none.
pub(super) struct Fault {
    pub(super) rule: &'static Rule,
    pub(super) message: String,
    pub(super) help: &'static str,
}

fn fault(rule: &'static Rule, message: String, help: &'static str) -> Fault {
    Fault {
        rule,
        message,
        help,
    }
}

/// Four bits from bit `shift` on.
const fn nibble(token: u32, shift: u32) -> u8 {
    (token >> shift & 0xF) as u8
}

fn register(token: u32, kind: ShaderKind) -> Result<Register, Fault> {
    let code = nibble(token, TYPE) & 7;
    let index = token & NUMBER;
    let high = token & TYPE_HIGH;
    let file = RegisterFile::from_code(code, kind).filter(|_| high == 0);
    let Some(file) = file else {
        let number = u32::from(code) | high >> 8;
        let shader = kind_name(kind);
        let message = format!("register type {number} of 0x{token:08X} is none of a {shader}");
        let help = match high {
            0 => "",
            _ => "bits 12:11 belong to the register types of later shader models",
        };
        return Err(fault(&rules::REGISTER, message, help));
    };
    if file == RegisterFile::RastOut && index > 2 {
        let message = format!("rasterizer output {index} of 0x{token:08X} does not exist");
        let help = "0 is oPos, 1 is oFog, 2 is oPts";
        return Err(fault(&rules::REGISTER, message, help));
    }
    Ok(Register::new(file, index))
}

/// Refuses a register that no listing of the version can name.
fn named(register: Register, token: u32, version: Version) -> Result<(), Fault> {
    let Register { file, index, .. } = register;
    if file.can_be_named(index, version) {
        return Ok(());
    }
    let name = file.register_name(index);
    let message = format!("0x{token:08X} names `{name}`, which {version} does not have");
    Err(fault(&rules::REGISTER, message, ""))
}

fn register_bits(register: Register, kind: ShaderKind) -> Result<u32, Fault> {
    let Register { file, index, .. } = register;
    let code = file.row().code;
    let none = |why: &str| {
        let name = file.register_name(index);
        fault(
            &rules::NO_TOKEN,
            format!("`{name}` has no token: {why}"),
            "",
        )
    };
    if !file.exists_in(kind) {
        return Err(none(&format!("a {} has no such register", kind_name(kind))));
    }
    if index > NUMBER || file == RegisterFile::RastOut && index > 2 {
        return Err(none("the number of a register has 11 bits"));
    }
    Ok(OPERAND | u32::from(code) << TYPE | index)
}

fn kind_name(kind: ShaderKind) -> &'static str {
    match kind {
        ShaderKind::Vertex => "vertex shader",
        ShaderKind::Pixel => "pixel shader",
    }
}

/// The destination of a token, with the modifiers of the result.
pub(super) fn destination(
    token: u32,
    version: Version,
) -> Result<(Register, WriteMask, ResultModifier), Fault> {
    let (register, mask, result) = written(token, version.kind())?;
    named(register, token, version)?;
    Ok((register, mask, result))
}

/// As [`destination`], of whatever number the register is.
fn written(token: u32, kind: ShaderKind) -> Result<(Register, WriteMask, ResultModifier), Fault> {
    let register = register(token, kind)?;
    if token & RELATIVE != 0 {
        let message = format!("bit 13 of 0x{token:08X} makes a destination relative to a0.x");
        return Err(fault(&rules::RELATIVE, message, ""));
    }
    let mask = WriteMask::from_bits(nibble(token, COMPONENTS));
    if mask.is_empty() {
        let message = format!("the write mask of 0x{token:08X}, bits 19:16, is empty");
        return Err(fault(&rules::MASK, message, ""));
    }
    // Four bits with sign: up, and down again arithmetically.
    let shift = (nibble(token, MODIFIER) << 4) as i8 >> 4;
    let saturate = nibble(token, RESULT);
    let result = ResultModifier {
        shift,
        saturate: saturate == 1,
    };
    let known = saturate <= 1 && (shift == 0 || result.shift_row().is_some());
    let plain = result == ResultModifier::NONE && saturate == 0;
    if !known || kind == ShaderKind::Vertex && !plain {
        let message = format!(
            "0x{token:08X} modifies the result in a way that a {} has not: bits 27:24 hold {}, 23:20 hold {saturate}",
            kind_name(kind),
            nibble(token, MODIFIER),
        );
        let help = match saturate & !1 {
            0 => "",
            _ => "partial precision (2) and centroid (4) belong to later shader models",
        };
        return Err(fault(&rules::MODIFIER, message, help));
    }
    Ok((register, mask, result))
}

/// The destination of a `dcl`, which takes no modifiers.
pub(super) fn declared(token: u32, version: Version) -> Result<(Register, WriteMask), Fault> {
    let (register, mask) = plain(token, version.kind())?;
    named(register, token, version)?;
    Ok((register, mask))
}

/// The destination of a `def`, which takes no modifiers. The assembler took any constant there.
pub(super) fn defined(token: u32, version: Version) -> Result<(Register, WriteMask), Fault> {
    let (register, mask) = plain(token, version.kind())?;
    if register.file != RegisterFile::Const {
        named(register, token, version)?;
    }
    Ok((register, mask))
}

fn plain(token: u32, kind: ShaderKind) -> Result<(Register, WriteMask), Fault> {
    let (register, mask, result) = written(token, kind)?;
    if result != ResultModifier::NONE {
        let message = format!("0x{token:08X} modifies the result of a declaration");
        return Err(fault(&rules::MODIFIER, message, ""));
    }
    Ok((register, mask))
}

/// The token of a destination with the modifiers of the result.
pub(super) fn destination_bits(
    destination: &Destination,
    result: ResultModifier,
    kind: ShaderKind,
) -> Result<u32, Fault> {
    let register = register_bits(destination.register, kind)?;
    if destination.register.relative {
        let message = "a destination that is relative to `a0.x` has no token".to_string();
        return Err(fault(&rules::NO_TOKEN, message, "only a source can be"));
    }
    if destination.mask.is_empty() {
        let message = "a destination without components has no token".to_string();
        return Err(fault(&rules::NO_TOKEN, message, ""));
    }
    let unknown = result.shift != 0 && result.shift_row().is_none();
    if unknown || kind == ShaderKind::Vertex && result != ResultModifier::NONE {
        return Err(no_result(result, kind));
    }
    let shift = u32::from(result.shift as u8 & 0xF) << MODIFIER;
    let saturate = u32::from(result.saturate) << RESULT;
    let mask = u32::from(destination.mask.bits()) << COMPONENTS;
    Ok(register | shift | saturate | mask)
}

/// Says that an instruction cannot modify its result so.
pub(super) fn no_result(result: ResultModifier, kind: ShaderKind) -> Fault {
    let text = result.text();
    let message = format!("`{text}` has no token here, in a {}", kind_name(kind));
    fault(&rules::NO_TOKEN, message, "")
}

/// The source of a token.
pub(super) fn source(
    token: u32,
    version: Version,
) -> Result<(Register, Swizzle, SourceModifier), Fault> {
    let kind = version.kind();
    let mut register = register(token, kind)?;
    named(register, token, version)?;
    register.relative = token & RELATIVE != 0;
    if register.relative && !may_be_relative(register, kind) {
        let name = register.file.register_name(register.index);
        let message = format!("bit 13 of 0x{token:08X} makes `{name}` relative to a0.x");
        return Err(fault(&rules::RELATIVE, message, ""));
    }
    let code = nibble(token, MODIFIER);
    let Some(modifier) = SourceModifier::from_code(code).filter(|m| has_modifier(*m, kind)) else {
        let message = format!(
            "source modifier {code} of 0x{token:08X}, bits 27:24, is none of a {}",
            kind_name(kind)
        );
        let help = match code {
            11.. => "the codes above 10 belong to later shader models",
            _ => "a vertex shader only negates",
        };
        return Err(fault(&rules::MODIFIER, message, help));
    };
    let swizzle = Swizzle::from_byte((token >> COMPONENTS & 0xFF) as u8);
    Ok((register, swizzle, modifier))
}

/// The token of a source.
pub(super) fn source_bits(source: &Source, kind: ShaderKind) -> Result<u32, Fault> {
    let Source {
        register,
        swizzle,
        modifier,
        ..
    } = *source;
    let bits = register_bits(register, kind)?;
    if register.relative && !may_be_relative(register, kind) {
        let message = format!("`{register}` has no token");
        let help = "only a constant that a vertex shader reads is addressed relative to a0.x";
        return Err(fault(&rules::NO_TOKEN, message, help));
    }
    if !has_modifier(modifier, kind) {
        let row = modifier.row();
        let message = format!(
            "`{}{register}{}` has no token in a vertex shader",
            row.prefix, row.suffix
        );
        return Err(fault(
            &rules::NO_TOKEN,
            message,
            "a vertex shader only negates",
        ));
    }
    let relative = if register.relative { RELATIVE } else { 0 };
    let swizzle = u32::from(swizzle.byte()) << COMPONENTS;
    Ok(bits | relative | swizzle | u32::from(modifier.row().code) << MODIFIER)
}

fn may_be_relative(register: Register, kind: ShaderKind) -> bool {
    register.file == RegisterFile::Const && kind == ShaderKind::Vertex
}

fn has_modifier(modifier: SourceModifier, kind: ShaderKind) -> bool {
    kind == ShaderKind::Pixel || matches!(modifier, SourceModifier::None | SourceModifier::Negate)
}

/// The usage and its index of the token behind a `dcl`.
pub(super) fn usage(token: u32) -> Result<(Usage, u8), Fault> {
    let index = nibble(token, USAGE_INDEX);
    let others = token & !(OPERAND | USAGE | 0xF << USAGE_INDEX);
    let usage = Usage::from_code(nibble(token, 0)).filter(|_| others == 0);
    usage.map(|usage| (usage, index)).ok_or_else(|| {
        let message = format!("0x{token:08X} is no usage of a vertex element");
        fault(&rules::USAGE, message, "")
    })
}

/// The usage token of a `dcl`.
pub(super) fn usage_bits(dcl: &Dcl) -> u32 {
    OPERAND | u32::from(dcl.usage.code()) | u32::from(dcl.usage_index & 0xF) << USAGE_INDEX
}

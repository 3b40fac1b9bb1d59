//! Token streams: shaders and vertex declarations as Direct3D 8 took them, read and written.
//!
//! A stream is a list of 32-bit words: a version token, instructions with their operands, comments, and an end token.
//! [`decode`] makes a [`Program`](crate::program::Program) of it and [`encode`] a stream of a program; [`disassemble`] goes
//! on to the listing. [`Declaration`] does both for the arrays of `D3DVSD_` tokens that tell where vertices come from.
//! [`read`] finds streams in what people have: binary files, hexadecimal text, arrays in C sources.
//!
//! # Which streams are valid
//!
//! A stream is valid if [`decode`] has nothing to say of it:
//!
//! * The first token is `0xFFFE0100`, `0xFFFE0101`, or `0xFFFF0100` to `0xFFFF0104`; the last is `0x0000FFFF`, and
//!   nothing follows it.
//! * An instruction token has bit 31 clear, an opcode in bits 15:0 and, where it is the second of a pair, bit 30.
//!   Bit 30 is never set in a vertex shader. Bits 29:16 are clear: the lengths and controls that they hold in later shader models do not exist yet. The opcode may
//!   be one that the version does not have, which is a matter of [`validate`](mod@crate::validate).
//! * As many operand tokens follow as the instruction has operands, each with bit 31 set: the register number in 10:0, a
//!   register type of the kind of shader in 30:28, 0 in 12:11 and 15:14. The assembler takes that register in this version:
//!   see [`RegisterFile::can_be_named`](crate::isa::RegisterFile::can_be_named). A destination has a write mask that is not empty,
//!   and in pixel shaders `_sat` and a shift of three bits at most. A source has a swizzle, one of the modifiers of the kind
//!   of shader, and, on constants of vertex shaders, the bit that adds `a0.x`.
//! * A `def` has a plain destination and four words, a `dcl` a usage token and a destination without modifiers.
//! * A comment token has bit 31 clear and `0xFFFE` in 15:0; it counts the words behind it in 30:16, which may be anything.
//! * A vertex shader has no subtraction: the assembler wrote `add` with a negated source. Its token is read, though, with
//!   a warning.
//! * There are at most [`MOST_TOKENS`] tokens and [`MOST_ITEMS`] instructions and comments: far more than any device
//!   took, and what bounds time and memory.
//!
//! ```
//! use texcrd::diagnostic::SourceMap;
//! use texcrd::{bytecode, syntax};
//!
//! let words = [0xFFFF0101, 0x00000001, 0x800F0000, 0x90FF0000, 0x0000FFFF];
//! let decoded = bytecode::decode(&words);
//! assert!(decoded.diagnostics.is_empty());
//! let listing = syntax::print(&decoded.program.expect("its version is known"));
//! assert_eq!(listing, "ps.1.1\nmov r0, v0.a\n");
//!
//! let mut sources = SourceMap::new();
//! let parsed = syntax::parse(sources.add("listing", listing).expect("a short text"));
//! let program = parsed.program.expect("it has a version");
//! assert_eq!(bytecode::encode(&program).expect("it has tokens"), words);
//! ```
//!
//! Of a valid stream, tokens → listing → tokens is the identity. What can be read all the same (bits that were ignored,
//! tokens behind the end) is a warning; it is lost.

mod constants;
mod declaration;
mod decode;
mod disassemble;
mod encode;
mod fields;
mod input;
mod literal;
mod macros;
mod report;

#[cfg(test)]
mod tests;

pub use constants::{put_constants, take_constants};
pub use declaration::{DataType, Declaration, Element, ElementKind};
pub use decode::{Decoded, decode};
pub use disassemble::{Disassembly, disassemble};
pub use encode::encode;
pub use input::{Form, Input, Stream, StreamKind, no_tokens, read, recognize};
pub use macros::Macro;
pub(crate) use macros::register_named;

use crate::rules::tokens as rules;

/// The token that ends a shader.
pub const END: u32 = 0x0000_FFFF;
/// The low half of a comment token.
const COMMENT: u32 = 0xFFFE;
/// Bit 31: set in operands, clear in instructions and comments.
const OPERAND: u32 = 1 << 31;

/// The most tokens that a stream may have: 1 MiB of them.
pub const MOST_TOKENS: usize = 1 << 18;
/// The most instructions, definitions, declarations and comments, or elements of a vertex declaration, that a stream may
/// hold. The longest shaders that a device took have 128 instructions. With both limits the listing of every valid stream
/// can be read again: it is shorter than a source may be.
pub const MOST_ITEMS: usize = 1 << 14;

/// Words as the old tools wrote them into files: little-endian.
pub fn to_bytes(words: &[u32]) -> Vec<u8> {
    words.iter().flat_map(|word| word.to_le_bytes()).collect()
}

/// Words as text, one token of eight hexadecimal digits a line.
pub fn to_hex(words: &[u32]) -> String {
    use std::fmt::Write;
    let mut text = String::with_capacity(words.len() * HEX_LINE);
    for word in words {
        // Writing into a string does not fail.
        let _ = writeln!(text, "{word:08X}");
    }
    text
}

/// Bytes of one line of [`to_hex`].
const HEX_LINE: usize = 9;

//! The instruction set as data: versions, register files, opcodes, modifiers, masks and limits.
//!
//! Everything that Direct3D 8 says about the *form* of a shader is a row of a table in this room: one row a
//! version, a register file, an opcode, a source modifier. The parser, the validator, the lowering, the encoder
//! and [`crate::explain`] read these rows; none of them repeats one. What an instruction *computes* is in
//! [`crate::semantics`].
//!
//! Each row also says in words what a person wants to know of it, with a listing that shows it.
//!
//! Adding an instruction is one row in [`opcode`], one meaning, one WGSL form and one test case.

mod list;
mod mnemonic;
pub mod modifier;
pub mod notation;
pub mod opcode;
pub mod operand;
pub mod register;
pub mod version;

#[cfg(test)]
pub(crate) mod tests;

pub(crate) use list::enumerate;
pub use modifier::{ResultModifier, SourceModifier};
pub use notation::Notation;
pub use opcode::{Class, Form, Opcode, OpcodeRow};
pub use operand::{MaskSet, Swizzle, WriteMask};
pub use register::{FileSet, RegisterFile};
pub use version::{ShaderKind, Version, VersionSet};

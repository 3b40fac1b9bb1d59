//! Opcodes: one row each, with one form for every group of versions in which it looks the same.
//!
//! The rows stand in `arithmetic`, `vertex` and `texture`, in the words of `vocabulary`.

mod arithmetic;
mod texture;
mod vertex;
mod vocabulary;

use super::operand::{MaskSet, WriteMask};
use super::register::FileSet;
use super::version::{Version, VersionSet};

/// An instruction. `tex` and `texld`, `texcoord` and `texcrd` share a token number but not a form.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[allow(
    missing_docs,
    reason = "each member is the mnemonic of its row, which says what it does"
)]
pub enum Opcode {
    Nop,
    Mov,
    Add,
    Sub,
    Mad,
    Mul,
    Rcp,
    Rsq,
    Dp3,
    Dp4,
    Min,
    Max,
    Slt,
    Sge,
    Exp,
    Log,
    Lit,
    Dst,
    Lrp,
    Frc,
    M4x4,
    M4x3,
    M3x4,
    M3x3,
    M3x2,
    Dcl,
    TexCoord,
    TexCrd,
    TexKill,
    Tex,
    TexLd,
    TexBem,
    TexBeml,
    TexReg2Ar,
    TexReg2Gb,
    TexM3x2Pad,
    TexM3x2Tex,
    TexM3x3Pad,
    TexM3x3Tex,
    TexM3x3Spec,
    TexM3x3VSpec,
    ExpP,
    LogP,
    Cnd,
    Def,
    TexReg2Rgb,
    TexDp3Tex,
    TexM3x2Depth,
    TexDp3,
    TexM3x3,
    TexDepth,
    Cmp,
    Bem,
    Phase,
}

/// What kind of instruction it is; budgets, order and modifiers depend on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// Computes from registers. Takes result modifiers in pixel shaders. `nop` is one.
    Arithmetic,
    /// Addresses a texture or works on texture coordinates.
    Texture,
    /// `phase`.
    Phase,
    /// `def` and `dcl`: no instruction at run time.
    Declaration,
}

/// Which half of a co-issued pair an instruction may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pairing {
    /// Neither.
    Never,
    /// The one that writes colour.
    Color,
    /// Either.
    Either,
}

/// The destination of an instruction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DestinationShape {
    /// Files that it may name.
    pub files: FileSet,
    /// Masks that the documents allow.
    pub masks: MaskSet,
    /// False for `texkill`, whose operand stands where a destination does but is only looked at.
    pub written: bool,
}

/// Which slots of a source an instruction uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slots {
    /// Those that the write mask has: the instruction works component by component.
    Masked,
    /// Always these.
    Fixed(WriteMask),
}

/// Which source modifiers an operand takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ModifierRule {
    /// Those that arithmetic has in the version.
    Arithmetic,
    /// `_bx2` in these versions, nothing else.
    Bx2(VersionSet),
    /// Those that divide coordinates.
    Coordinates,
    /// None, and no swizzle either: the operand names the first row of a matrix.
    Matrix,
    /// None.
    Plain,
}

/// One source of an instruction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SourceShape {
    /// Files that it may name.
    pub files: FileSet,
    /// Slots that are used.
    pub slots: Slots,
    /// Modifiers that it takes.
    pub modifiers: ModifierRule,
}

/// An instruction as one group of versions has it.
#[derive(Debug)]
pub struct Form {
    /// The versions.
    pub versions: VersionSet,
    /// Kind of instruction.
    pub class: Class,
    /// Slots it takes of the arithmetic budget (of the whole budget in vertex shaders).
    pub arithmetic_slots: u32,
    /// Slots it takes of the texture budget.
    pub texture_slots: u32,
    /// The destination, if it has one.
    pub destination: Option<DestinationShape>,
    /// The sources in order.
    pub sources: &'static [SourceShape],
    /// Which half of a pair it may be.
    pub pairing: Pairing,
    /// How often a shader may hold it, where that is limited.
    pub most: Option<u32>,
    /// Rows of the matrix it multiplies by; 0 if it is no matrix macro.
    pub rows: u32,
    /// What it computes: `d` is the destination, `s0` … the sources after swizzle and modifier, component by component
    /// where none is named. `m` is the number of the destination, `t(m)` its register, `TC[m]` the texture coordinates
    /// and `S[m](p)` the texture at p of the stage with that number.
    pub formula: &'static str,
    /// What is special about it in these versions, in sentences; empty if nothing is.
    pub note: &'static str,
    /// A listing in which it stands, without the version line; every one of the versions accepts it without a word.
    pub example: &'static str,
}

/// One opcode.
#[derive(Clone, Copy, Debug)]
pub struct OpcodeRow {
    /// The opcode that this row describes.
    pub opcode: Opcode,
    /// Its mnemonic, lower case.
    pub mnemonic: &'static str,
    /// Bits 15:0 of its instruction token.
    pub token: u16,
    /// What it is called in a few words.
    pub title: &'static str,
    /// What it is for, and what holds in all versions that have it, in sentences.
    pub meaning: &'static str,
    /// Instructions that stand in for it, go with it or are easily taken for it.
    pub see: &'static [Opcode],
    /// Its forms; no version is in two of them.
    pub forms: &'static [Form],
}

impl Opcode {
    /// Every opcode.
    pub fn all() -> impl Iterator<Item = Opcode> {
        OPCODES.iter().map(|row| row.opcode)
    }

    /// The row of this opcode.
    pub fn row(self) -> &'static OpcodeRow {
        &OPCODES[self as usize]
    }

    /// The mnemonic, lower case.
    pub fn mnemonic(self) -> &'static str {
        self.row().mnemonic
    }

    /// The form in this version, if the version has the instruction.
    pub fn form(self, version: Version) -> Option<&'static Form> {
        self.row()
            .forms
            .iter()
            .find(|form| form.versions.contains(version))
    }

    /// The versions that have the instruction.
    pub fn versions(self) -> VersionSet {
        self.row()
            .forms
            .iter()
            .fold(VersionSet::NONE, |set, form| set.and(form.versions))
    }

    /// The opcode with this token number in this version.
    pub fn from_token(token: u16, version: Version) -> Option<Self> {
        OPCODES
            .iter()
            .filter(|row| row.token == token)
            .map(|row| row.opcode)
            .find(|opcode| opcode.form(version).is_some())
    }

    /// The opcode that this token number stands for in a shader of this version, whether the version has it or not:
    /// a number that only one opcode has can mean nothing else.
    pub fn meant_by(token: u16, version: Version) -> Option<Self> {
        Self::from_token(token, version).or_else(|| {
            let mut all = OPCODES.iter().filter(|row| row.token == token);
            let first = all.next().filter(|_| all.next().is_none());
            first.map(|only| only.opcode)
        })
    }
}

impl Form {
    /// The slots of source `i` that are used when the destination has this mask.
    pub fn slots_read(&self, i: usize, mask: WriteMask) -> WriteMask {
        match self.sources.get(i).map(|s| s.slots) {
            Some(Slots::Masked) => mask,
            Some(Slots::Fixed(slots)) => slots,
            None => WriteMask::NONE,
        }
    }
}

const COUNT: usize = Opcode::Phase as usize + 1;

/// One row an opcode, in the order of [`Opcode`].
pub(super) static OPCODES: [OpcodeRow; COUNT] =
    in_order(&[&arithmetic::ROWS, &vertex::ROWS, &texture::ROWS]);

/// The rows of all groups, each at the place of its opcode. Does not compile if one is missing or there twice.
const fn in_order(groups: &[&[OpcodeRow]]) -> [OpcodeRow; COUNT] {
    let mut rows = [groups[0][0]; COUNT];
    let (mut count, mut group) = (0, 0);
    while group < groups.len() {
        let mut i = 0;
        while i < groups[group].len() {
            rows[groups[group][i].opcode as usize] = groups[group][i];
            count += 1;
            i += 1;
        }
        group += 1;
    }
    assert!(count == COUNT);
    let mut i = 0;
    while i < COUNT {
        assert!(rows[i].opcode as usize == i);
        i += 1;
    }
    rows
}

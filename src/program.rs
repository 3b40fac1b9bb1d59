//! The typed form of a shader that text and tokens share.
//!
//! A [`Program`] says what was written, not whether it is allowed: operands may name registers that the version
//! does not have. [`validate`](mod@crate::validate) judges it; [`crate::kernel`] lowers what was accepted.

use crate::diagnostic::{SourceMap, Span};
use crate::isa::operand::{RGBA, XYZW};
use crate::isa::{
    Opcode, RegisterFile, ResultModifier, ShaderKind, SourceModifier, Swizzle, Version, WriteMask,
};
use std::fmt;

/// A shader.
#[derive(Clone, Debug, PartialEq)]
pub struct Program {
    /// Its version.
    pub version: Version,
    /// Where the version instruction stands.
    pub version_span: Span,
    /// Everything after the version instruction, in order.
    pub statements: Vec<Statement>,
    /// The comments that a token stream carries, in order. Those that a person writes into a listing are no part of the
    /// shader.
    pub comments: Vec<Comment>,
    /// The whole text of the shader.
    pub span: Span,
}

impl Program {
    /// Statements and comments in the order of the token stream.
    pub fn items(&self) -> impl Iterator<Item = Item<'_>> {
        let mut comments = self.comments.iter().peekable();
        let mut statements = self.statements.iter().enumerate().peekable();
        std::iter::from_fn(move || {
            let next = statements.peek().map_or(usize::MAX, |(i, _)| *i);
            if let Some(comment) = comments.next_if(|c| c.before <= next) {
                return Some(Item::Comment(comment));
            }
            statements.next().map(|(_, s)| Item::Statement(s))
        })
    }

    /// The instructions in order, without declarations.
    pub fn instructions(&self) -> impl Iterator<Item = &Instruction> {
        self.statements.iter().filter_map(|s| match s {
            Statement::Instruction(i) => Some(i),
            Statement::Def(_) | Statement::Dcl(_) => None,
        })
    }

    /// The `def` instructions in order.
    pub fn definitions(&self) -> impl Iterator<Item = &Def> {
        self.statements.iter().filter_map(|s| match s {
            Statement::Def(d) => Some(d),
            Statement::Instruction(_) | Statement::Dcl(_) => None,
        })
    }

    /// The `dcl` instructions in order.
    pub fn declarations(&self) -> impl Iterator<Item = &Dcl> {
        self.statements.iter().filter_map(|s| match s {
            Statement::Dcl(d) => Some(d),
            Statement::Instruction(_) | Statement::Def(_) => None,
        })
    }

    /// The letters in which this kind of shader names components.
    pub fn letters(&self) -> [char; 4] {
        letters(self.version.kind())
    }
}

/// The letters in which a kind of shader names components: `xyzw` in vertex, `rgba` in pixel shaders.
pub fn letters(kind: ShaderKind) -> [char; 4] {
    match kind {
        ShaderKind::Vertex => XYZW,
        ShaderKind::Pixel => RGBA,
    }
}

/// One line of a shader.
#[derive(Clone, Debug, PartialEq)]
pub enum Statement {
    /// Something that runs, `phase` and `nop` included.
    Instruction(Instruction),
    /// `def c#, x, y, z, w`
    Def(Def),
    /// `dcl_usage# v#`
    Dcl(Dcl),
}

impl Statement {
    /// Where it stands.
    pub fn span(&self) -> Span {
        match self {
            Statement::Instruction(i) => i.span,
            Statement::Def(d) => d.span,
            Statement::Dcl(d) => d.span,
        }
    }
}

/// A comment of a token stream: debug text, a table of constants, anything.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Comment {
    /// The number of the statement that it stands before; that of statements if it stands behind the last.
    pub before: usize,
    /// What it holds, at most [`Comment::MOST_WORDS`].
    pub words: Vec<u32>,
    /// Where it stands.
    pub span: Span,
}

impl Comment {
    /// The most that one comment token can count.
    pub const MOST_WORDS: usize = 0x7FFF;
}

/// One thing of a token stream.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Item<'a> {
    /// A statement.
    Statement(&'a Statement),
    /// A comment.
    Comment(&'a Comment),
}

/// An instruction with its operands.
#[derive(Clone, Debug, PartialEq)]
pub struct Instruction {
    /// What it does.
    pub opcode: Opcode,
    /// Whether it runs together with the instruction before it (`+`).
    pub co_issue: bool,
    /// Shift and saturation of the result.
    pub result: ResultModifier,
    /// The destination; for `texkill` and `texdepth` the register that they look at.
    pub destination: Option<Destination>,
    /// The sources in order.
    pub sources: Vec<Source>,
    /// The whole instruction, a `+` in front not included.
    pub span: Span,
    /// The mnemonic with its suffixes.
    pub mnemonic_span: Span,
}

impl Instruction {
    /// The instruction as it stands in its listing, on one line, with its `+`.
    pub fn text(&self, sources: &SourceMap) -> String {
        let text = sources.text(self.span);
        let words: Vec<&str> = text.split_whitespace().collect();
        let plus = if self.co_issue { "+" } else { "" };
        format!("{plus}{}", words.join(" "))
    }
}

/// A destination operand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Destination {
    /// The register.
    pub register: Register,
    /// The components that are written; [`WriteMask::ALL`] if no mask is written.
    pub mask: WriteMask,
    /// The operand.
    pub span: Span,
}

/// A source operand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Source {
    /// The register.
    pub register: Register,
    /// Which component each slot reads.
    pub swizzle: Swizzle,
    /// What is done to the value.
    pub modifier: SourceModifier,
    /// The operand.
    pub span: Span,
}

/// A register, or for a relative operand the offset from `a0.x`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Register {
    /// The file.
    pub file: RegisterFile,
    /// The number within the file.
    pub index: u32,
    /// Whether `a0.x` is added to the number.
    pub relative: bool,
}

impl Register {
    /// Register `index` of a file.
    pub const fn new(file: RegisterFile, index: u32) -> Self {
        Self {
            file,
            index,
            relative: false,
        }
    }
}

impl fmt::Display for Register {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.relative, self.index) {
            (false, index) => f.write_str(&self.file.register_name(index)),
            (true, 0) => write!(f, "{}[a0.x]", self.file.row().prefix),
            (true, index) => write!(f, "{}[a0.x + {index}]", self.file.row().prefix),
        }
    }
}

/// `def`: the value of a constant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Def {
    /// The register; the validator demands a constant.
    pub register: Register,
    /// Its value.
    pub value: [f32; 4],
    /// Whether a `+` stands in front, which the validator refuses.
    pub co_issue: bool,
    /// The whole instruction.
    pub span: Span,
    /// The register operand.
    pub register_span: Span,
}

/// `dcl`: which vertex element feeds an input register (the later dialect; Direct3D 8 passes a declaration beside
/// the shader).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dcl {
    /// What the element means.
    pub usage: Usage,
    /// Which one of that meaning, 0 to 15.
    pub usage_index: u8,
    /// The register that it feeds.
    pub register: Register,
    /// The mask behind the register; it has no effect.
    pub mask: WriteMask,
    /// The whole instruction.
    pub span: Span,
}

/// The meaning of a vertex element (`D3DDECLUSAGE`).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Usage {
    /// `position`
    Position,
    /// `blendweight`
    BlendWeight,
    /// `blendindices`
    BlendIndices,
    /// `normal`
    Normal,
    /// `psize`
    PSize,
    /// `texcoord`
    TexCoord,
    /// `tangent`
    Tangent,
    /// `binormal`
    Binormal,
    /// `tessfactor`
    TessFactor,
    /// `positiont`
    PositionT,
    /// `color`
    Color,
    /// `fog`
    Fog,
    /// `depth`
    Depth,
    /// `sample`
    Sample,
}

/// The usages by their token number.
static USAGES: [(Usage, &str); 14] = [
    (Usage::Position, "position"),
    (Usage::BlendWeight, "blendweight"),
    (Usage::BlendIndices, "blendindices"),
    (Usage::Normal, "normal"),
    (Usage::PSize, "psize"),
    (Usage::TexCoord, "texcoord"),
    (Usage::Tangent, "tangent"),
    (Usage::Binormal, "binormal"),
    (Usage::TessFactor, "tessfactor"),
    (Usage::PositionT, "positiont"),
    (Usage::Color, "color"),
    (Usage::Fog, "fog"),
    (Usage::Depth, "depth"),
    (Usage::Sample, "sample"),
];

impl Usage {
    /// Every usage with its name, by token number.
    pub fn all() -> impl Iterator<Item = (Usage, &'static str)> {
        USAGES.iter().copied()
    }

    /// The name as it stands behind `dcl_`.
    pub fn name(self) -> &'static str {
        USAGES[self as usize].1
    }

    /// The usage of this name, in any case of letters.
    pub fn from_name(name: &str) -> Option<Self> {
        let row = USAGES.iter().find(|(_, n)| n.eq_ignore_ascii_case(name))?;
        Some(row.0)
    }

    /// The number in tokens.
    pub fn code(self) -> u8 {
        self as u8
    }

    /// The usage with this token number.
    pub fn from_code(code: u8) -> Option<Self> {
        USAGES.get(usize::from(code)).map(|row| row.0)
    }

    /// The input register that Direct3D 8 gives this element when nothing else is declared
    /// (`D3DVSDE_POSITION` …), if it has one.
    pub fn default_register(self, index: u8) -> Option<u32> {
        let index = u32::from(index);
        match (self, index) {
            (Usage::Position, 0) => Some(0),
            (Usage::BlendWeight, 0) => Some(1),
            (Usage::BlendIndices, 0) => Some(2),
            (Usage::Normal, 0) => Some(3),
            (Usage::PSize, 0) => Some(4),
            (Usage::Color, 0 | 1) => Some(5 + index),
            (Usage::TexCoord, 0..=7) => Some(7 + index),
            (Usage::Position, 1) => Some(15),
            _ => None,
        }
    }
}

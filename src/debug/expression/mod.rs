//! Expressions over the registers of a run: what `print`, `watch`, conditions and log messages are written in.
//!
//! The language is that of listings, with operators: registers with a swizzle in either alphabet and with source modifiers
//! (`1-r0`, `-r0_bx2.a`), `c[a0.x + 2]`, `+ - * /`, comparisons, `&& || !`, parentheses, which also put components together
//! (`(1, 0, 0, 1)`), and functions. Arithmetic is the shader's own, by the functions of [`semantics`](crate::semantics): a
//! product with zero is zero even against infinity and NaN, denormal results are zero, `min` and `max` of NaN give what the
//! instructions give. Only division is none of the shader's: `/` is that of IEEE 754.
//!
//! A number alone is taken for as many components as the other side has. Comparisons compare component by component and give
//! 1 or 0; a condition holds if any component is not zero.
//!
//! Files: `lex` (text to tokens), `parse` (tokens to a tree), `evaluate` (what the tree comes to), `function` (the functions),
//! `value` (numbers and how they are written), `log` (texts with expressions in them).

mod evaluate;
mod function;
mod lex;
mod log;
mod parse;
#[cfg(test)]
mod tests;
mod value;

pub use function::function_names;
pub use log::LogMessage;
pub use value::{Format, Value, number_text};

use super::moment::Target;
use super::run::{Listing, Registers, Run};
use super::session::Session;
use crate::isa::{RegisterFile, SourceModifier, Version, WriteMask};
use crate::kernel::Slot;
use crate::program::Register;
use std::fmt;
use std::ops::Range;
use std::str::FromStr;

/// An expression that has been read. Its text is at most [`Expression::MOST_TOKENS`] words and signs long.
#[derive(Clone, Debug)]
pub struct Expression {
    text: String,
    tree: Node,
}

/// Why an expression cannot be read, or has no value here.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExpressionError {
    /// What is wrong, for people.
    pub message: String,
    /// The bytes of the text that it is about.
    pub at: Range<usize>,
}

impl ExpressionError {
    fn new(at: Range<usize>, message: impl Into<String>) -> Self {
        Self {
            message: message.into(),
            at,
        }
    }
}

impl fmt::Display for ExpressionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for ExpressionError {}

/// What an expression looks at.
#[derive(Clone, Copy, Debug)]
pub struct Scope<'s> {
    /// The run.
    pub run: &'s Run<'s>,
    /// Its registers at a moment.
    pub registers: &'s Registers,
    /// The pixel of the quad, 0 to 3.
    pub lane: usize,
}

impl Session<'_> {
    /// The registers where one is, for the pixel that is looked at; `None` if there is no run.
    pub fn scope(&self) -> Option<Scope<'_>> {
        let run = self.run()?;
        Some(Scope {
            run,
            registers: self.registers(),
            lane: run.lane,
        })
    }
}

/// A part of an expression, with its place in the text.
#[derive(Clone, Debug, PartialEq)]
struct Node {
    kind: Kind,
    at: Range<usize>,
}

#[derive(Clone, Debug, PartialEq)]
enum Kind {
    Number(f32),
    Name(Name),
    /// `c[…]`
    Indexed(Box<Node>),
    /// Components of a value, by number.
    Swizzle(Box<Node>, Vec<u8>),
    /// A source modifier that stands behind: `_bx2`, `_dz`.
    Modifier(Box<Node>, SourceModifier),
    Negate(Box<Node>),
    Not(Box<Node>),
    Binary(Binary, Box<Node>, Box<Node>),
    Call(&'static function::Function, Vec<Node>),
    /// Components one behind the other.
    List(Vec<Node>),
}

/// What a word names.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Name {
    /// A register as listings write it.
    Register(RegisterFile, u32),
    /// `tc#`: the coordinates of a stage of `ps.1.0` to `ps.1.3`, also after `t#` has become what was sampled.
    Coordinates(u32),
    /// The depth that replaces the interpolated one.
    Depth,
    /// Whether `texkill` has discarded the pixel.
    Killed,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Binary {
    Or,
    And,
    Equal,
    Unequal,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    Add,
    Subtract,
    Multiply,
    Divide,
}

impl Expression {
    /// The most words and signs that an expression may have; it bounds how deep it nests.
    pub const MOST_TOKENS: usize = 500;

    /// The value for one pixel at one moment.
    ///
    /// # Errors
    /// A register that the version does not have, a component that a value does not have, sizes that do not fit together.
    pub fn evaluate(&self, scope: &Scope<'_>) -> Result<Value, ExpressionError> {
        evaluate::value(&self.tree, scope)
    }

    /// The register and components, if the expression is a register of this listing with a mask and nothing else: `r2.xz`, `c5`,
    /// `depth`. Of `t#` in `ps.1.0` to `ps.1.3` it is what is sampled; `tc#` are the coordinates.
    pub fn target(&self, listing: &Listing<'_>) -> Option<(Target, WriteMask)> {
        let version = listing.program.version;
        self.written_to(|name| name.target(version).ok())
    }

    /// As [`Self::target`], where one is: `t#` are the coordinates as long as nothing has been sampled.
    pub fn target_here(&self, scope: &Scope<'_>) -> Option<(Target, WriteMask)> {
        self.written_to(|name| name.target_here(scope).ok())
    }

    fn written_to(&self, target: impl Fn(Name) -> Option<Target>) -> Option<(Target, WriteMask)> {
        let (register, mask) = match &self.tree.kind {
            Kind::Swizzle(register, components) => (&register.kind, mask(components)?),
            register => (register, WriteMask::ALL),
        };
        let Kind::Name(name) = register else {
            return None;
        };
        let target = target(*name)?;
        // The depth is one number.
        let mask = if target == Target::Slot(Slot::DEPTH) {
            WriteMask::X
        } else {
            mask
        };
        Some((target, mask))
    }
}

/// Components that rise are a mask.
fn mask(components: &[u8]) -> Option<WriteMask> {
    let rises = components.windows(2).all(|pair| pair[0] < pair[1]);
    let bits = components.iter().fold(0, |bits, c| bits | 1 << (c & 3));
    rises.then(|| WriteMask::from_bits(bits))
}

impl Name {
    /// What can be written; an error in words where the version does not have it.
    fn target(self, version: Version) -> Result<Target, String> {
        let slot = match self {
            Self::Register(RegisterFile::Const, index) => return Ok(Target::Constant(index)),
            Self::Register(file, index) => Slot::of(Register::new(file, index), version),
            Self::Coordinates(stage) if stage < RegisterFile::Texture.count(version) => {
                Slot::texcoord(stage as usize)
            }
            Self::Coordinates(_) => None,
            Self::Depth => Some(Slot::DEPTH),
            Self::Killed => return Err("`killed` is no register".to_string()),
        };
        slot.map(Target::Slot).ok_or_else(|| self.missing(version))
    }

    fn target_here(self, scope: &Scope<'_>) -> Result<Target, String> {
        let version = scope.run.listing.program.version;
        let target = self.target(version)?;
        if let Self::Register(RegisterFile::Texture, index) = self
            && let Target::Slot(slot) = target
            && scope.registers.written(slot).is_empty()
            && let Some(coordinates) = Slot::texcoord(index as usize)
        {
            return Ok(Target::Slot(coordinates));
        }
        Ok(target)
    }

    /// Why the version does not have it.
    fn missing(self, version: Version) -> String {
        let (file, name) = match self {
            Self::Register(file, index) => (file, file.register_name(index)),
            Self::Coordinates(stage) => (RegisterFile::Texture, format!("tc{stage}")),
            Self::Depth | Self::Killed => return String::new(),
        };
        let range = match file.count(version) {
            0 => String::new(),
            count => format!("; it has {}", range_text(|i| file.register_name(i), count)),
        };
        format!("{version} has no {name}{range}")
    }
}

/// `r0`, `r0 and r1` or `r0 to r5`.
fn range_text(name: impl Fn(u32) -> String, count: u32) -> String {
    match count {
        0 | 1 => name(0),
        2 => format!("{} and {}", name(0), name(1)),
        _ => format!("{} to {}", name(0), name(count - 1)),
    }
}

impl FromStr for Expression {
    type Err = ExpressionError;

    fn from_str(text: &str) -> Result<Self, ExpressionError> {
        Ok(Self {
            text: text.trim().to_string(),
            tree: parse::parse(text)?,
        })
    }
}

impl fmt::Display for Expression {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

/// Two expressions are alike if their texts are.
impl PartialEq for Expression {
    fn eq(&self, other: &Self) -> bool {
        self.text == other.text
    }
}

//! The executable form of a shader: a straight line of steps.
//!
//! [`lower`] turns a [`Program`](crate::program::Program) into a [`Kernel`]. In a kernel nothing is implicit any
//! more: macros are expanded into their rows, an instruction that is spread over several lines (`texm3x3pad`,
//! `texm3x3pad`, `texm3x3tex`) has become dot products and one sample, scalar instructions name the one component
//! that they read, registers are numbered slots of one file. Every step keeps the instruction that it came from.
//!
//! What a step computes is in [`crate::semantics`]; [`crate::exec`] runs kernels, and the translators write them out. A
//! [`Plan`] is the same for many invocations at a time.

mod error;
mod lower;
mod plan;
mod show;
mod slot;
#[cfg(test)]
mod tests;
mod texture_ops;

pub use error::LowerError;
pub use lower::{MOST_VERTEX_CONSTANTS, Options, Projection, lower};
pub use plan::Plan;
pub(crate) use plan::{NO_ROW, Row, RowFinish, RowOp, RowStep, UniformValue};
pub use slot::{SLOT_COUNT, Slot};

use crate::isa::{ResultModifier, SourceModifier, Swizzle, Version, WriteMask};
use crate::policy::{Model, Policies};

/// A shader ready to run.
#[derive(Clone, Debug, PartialEq)]
pub struct Kernel {
    /// The version of the shader.
    pub version: Version,
    /// The numbers that it computes with; floats for vertex shaders.
    pub model: Model,
    /// The numeric choices that it was lowered with. [`Policies::scalar`] and [`Policies::logp`] are in its steps already.
    pub policies: Policies,
    /// The steps in order.
    pub steps: Vec<Step>,
    /// Constants that the shader defines itself (`def`), in order; the last of one register counts. Direct3D 8
    /// loads them when the shader is set, so that constants set later replace them, unless [`Policies::def`] says otherwise.
    pub definitions: Vec<(u32, [f32; 4])>,
    /// Slots that hold a fixed value before the first step: temporaries 0, outputs what Direct3D 8 gives
    /// outputs that are never written.
    pub presets: Vec<(Slot, [f32; 4])>,
    /// The components of each slot that some step writes.
    written: [WriteMask; SLOT_COUNT],
    /// The components of each slot that some step reads.
    read: [WriteMask; SLOT_COUNT],
    /// Which component of `oFog` is the factor: x unless only another one is written.
    pub fog_component: usize,
    /// Which component of `oPts` is the size.
    pub point_size_component: usize,
}

impl Kernel {
    /// The components of a slot that some step writes.
    pub fn written(&self, slot: Slot) -> WriteMask {
        self.written[slot.index()]
    }

    /// The components of a slot that some step reads.
    pub fn read(&self, slot: Slot) -> WriteMask {
        self.read[slot.index()]
    }

    /// The constants that the shader defines or names with a fixed number.
    pub fn constants(&self) -> impl Iterator<Item = u32> {
        let defined = self.definitions.iter().map(|(index, _)| *index);
        let named = self.steps.iter().flat_map(|s| &s.sources);
        defined.chain(named.filter_map(|operand| match operand.place {
            Place::Constant(index) => Some(index),
            _ => None,
        }))
    }

    /// Whether a pixel of this shader may be discarded by `texkill`.
    pub fn kills(&self) -> bool {
        self.steps.iter().any(|s| s.op == Op::Kill)
    }

    /// Whether the shader replaces the depth of the pixel.
    pub fn writes_depth(&self) -> bool {
        !self.written(Slot::DEPTH).is_empty()
    }

    /// The texture stages that are sampled, as bits.
    pub fn stages(&self) -> u8 {
        self.steps.iter().fold(0, |bits, step| match step.op {
            Op::Sample(stage) => bits | 1 << stage,
            _ => bits,
        })
    }
}

/// One step.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// What it computes.
    pub op: Op,
    /// Where the result goes; ignored by [`Op::Kill`].
    pub destination: Slot,
    /// Which components of the destination are written.
    pub mask: WriteMask,
    /// What it reads; as many as [`Op::sources`] says.
    pub sources: Vec<Operand>,
    /// Shift and saturation of the result.
    pub result: ResultModifier,
    /// The numbers that operands become when the step reads them, and whose source modifiers it has. Registers may hold
    /// others: what texture instructions leave in them under [`Model::Gf3`], colours and constants.
    pub reads: Model,
    /// The numbers that the result becomes behind shift and saturation.
    pub writes: Model,
    /// Whether the write waits until the next step that is not held has been computed. The halves of a co-issued
    /// pair and the rows of a matrix macro all read before any of them writes.
    pub held: bool,
    /// The instruction that the step came from: its number among [`Program::instructions`].
    ///
    /// [`Program::instructions`]: crate::program::Program::instructions
    pub origin: usize,
}

/// What a step reads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Operand {
    /// Where the value comes from.
    pub place: Place,
    /// Which component each slot of the operation reads.
    pub swizzle: Swizzle,
    /// What is done to the value then.
    pub modifier: SourceModifier,
}

impl Operand {
    /// A whole register.
    pub const fn slot(slot: Slot) -> Self {
        Self::new(Place::Slot(slot), Swizzle::IDENTITY)
    }

    /// One number in all components.
    pub const fn literal(value: f32) -> Self {
        Self::new(Place::Literal(value), Swizzle::IDENTITY)
    }

    /// A swizzled register without modifier.
    pub const fn new(place: Place, swizzle: Swizzle) -> Self {
        Self {
            place,
            swizzle,
            modifier: SourceModifier::None,
        }
    }
}

/// Where an operand comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// A register of the invocation.
    Slot(Slot),
    /// A constant. In a pixel shader constants are clamped to -1…1 when they are bound.
    Constant(u32),
    /// The constant whose number is `a0.x` plus this offset; (0, 0, 0, 0) outside of the constants there are.
    Relative(u32),
    /// The same number in all components.
    Literal(f32),
}

/// What a step computes; the meanings are in [`crate::semantics`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Op {
    /// s0
    Mov,
    /// s0 + s1
    Add,
    /// s0 − s1
    Sub,
    /// s0 · s1
    Mul,
    /// s0 · s1 + s2
    Mad,
    /// s0 · s1 + (1 − s0) · s2
    Lrp,
    /// The smaller
    Min,
    /// The larger
    Max,
    /// 1 where s0 < s1
    Slt,
    /// 1 where s0 ≥ s1
    Sge,
    /// s0 − ⌊s0⌋
    Frc,
    /// ⌊s0⌋ within the range of the address register
    Floor,
    /// s1 where s0 > 0.5, else s2
    Cnd,
    /// s1 where s0 ≥ 0, else s2
    Cmp,
    /// Three-component dot product in every component
    Dp3,
    /// Four-component dot product in every component
    Dp4,
    /// 1 / s0.x in every component; of 0 as [`Policies::of_zero`] says, as for the next ones
    Rcp,
    /// 1 / √|s0.x| in every component
    Rsq,
    /// 2 ^ s0.x in every component
    Exp,
    /// log₂ |s0.x| in every component
    Log,
    /// The four partial results of `expp`
    ExpP,
    /// The four partial results of `logp`
    LogP,
    /// Lighting coefficients
    Lit,
    /// Distance vector
    Dst,
    /// s0.xy / s0.z; a zero divisor gives 1
    DivideZ,
    /// s0.xy / s0.w; a zero divisor gives 1
    DivideW,
    /// s0.xyz / this component of s0, 2 or 3; a zero divisor gives 1. Unlike the divide modifiers of `ps.1.4`,
    /// `D3DTTFF_PROJECTED` leaves no component undefined: cubes and volumes need the third.
    Project(u8),
    /// s0.xy plus s1.xy through the bump matrix of the stage; z and w of s0 are kept
    Bump(u8),
    /// s0 times the luminance s1.z of the stage (`texbeml`)
    Luminance(u8),
    /// The vector s1 mirrored at the normal s0
    Reflect,
    /// What the texture of the stage holds at s0
    Sample(u8),
    /// Discards the pixel if x, y or z of s0 is negative
    Kill,
    /// The depth s0.x / s0.y, 1 for a zero divisor, clamped to 0…1; into x
    Depth,
}

impl Op {
    /// How many operands the step reads.
    pub const fn sources(self) -> usize {
        use Op::*;
        match self {
            Mad | Lrp | Cnd | Cmp => 3,
            Add | Sub | Mul | Min | Max | Slt | Sge | Dp3 | Dp4 | Dst | Bump(_) | Luminance(_)
            | Reflect => 2,
            Mov | Frc | Floor | Rcp | Rsq | Exp | Log | ExpP | LogP | Lit | DivideZ | DivideW
            | Project(_) | Sample(_) | Kill | Depth => 1,
        }
    }

    /// The slots of source `i` that the step uses when it writes the components of `mask`.
    pub const fn slots_read(self, i: usize, mask: WriteMask) -> WriteMask {
        use Op::*;
        match self {
            Mov | Add | Sub | Mul | Mad | Lrp | Min | Max | Slt | Sge | Frc | Floor | Cnd | Cmp => {
                mask
            }
            Dp3 | Reflect | Kill | Sample(_) => WriteMask::XYZ,
            Dp4 => WriteMask::ALL,
            Rcp | Rsq | Exp | Log | ExpP | LogP => WriteMask::X,
            Lit => WriteMask::from_bits(0b1011),
            Dst if i == 0 => WriteMask::from_bits(0b0110),
            Dst => WriteMask::from_bits(0b1010),
            DivideZ => WriteMask::XYZ,
            DivideW => WriteMask::from_bits(0b1011),
            Project(by) => WriteMask::XYZ
                .and(mask)
                .or(WriteMask::component(by as usize)),
            Bump(_) if i == 0 => WriteMask::ALL.and(mask).or(WriteMask::XY),
            Bump(_) | Depth => WriteMask::XY,
            Luminance(_) if i == 0 => mask,
            Luminance(_) => WriteMask::Z,
        }
    }
}

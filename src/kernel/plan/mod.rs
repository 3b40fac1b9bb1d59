//! A kernel made ready for many invocations at a time.
//!
//! A [`Kernel`](super::Kernel) works on registers of four components, for whoever wants to look at them. A [`Plan`] works on
//! *rows*: one number for each invocation. Every component of every result is a row of its own, so that
//!
//! * masks, swizzles and plain moves are gone: they only say which row is meant;
//! * components that nobody reads are not computed, and what is computed twice is computed once;
//! * what follows from constants alone is computed once a draw, not once a batch;
//! * rows are numbered densely and used again as soon as they are free, so that those of a batch fit into the nearest cache.
//!
//! What an operation means is said by [`crate::semantics`], for both forms; a plan leaves the same bits in the outputs as its
//! kernel does.
//!
//! Files: `graph` (components as values), `build` (from steps to values), `rows` (from values to rows), `show` (for people).

mod build;
mod graph;
mod rows;
mod show;
#[cfg(test)]
mod tests;

use super::{Kernel, Slot};
use crate::isa::{ResultModifier, SourceModifier};
use crate::policy::{Model, Policies};
use std::ops::Range;

/// The number of a row.
pub(crate) type Row = u32;

/// Stands for a row that nobody reads.
pub(crate) const NO_ROW: Row = Row::MAX;

/// A kernel as steps over rows.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// How the numeric choices of the kernel stand.
    pub(crate) policies: Policies,
    /// How many rows there are.
    pub(crate) rows: usize,
    /// The rows that hold the same number in all lanes before anything runs.
    pub(crate) uniforms: Vec<Uniform>,
    /// The rows that are loaded before every run.
    pub(crate) inputs: Vec<Input>,
    /// The steps: first those that follow from uniforms alone.
    pub(crate) steps: Vec<RowStep>,
    /// How many of them need to run only once for the same constants and textures.
    pub(crate) once: usize,
    /// The rows that the steps name: for each item those that it writes, then those that it reads.
    pub(crate) operands: Vec<Row>,
    /// What the shader leaves, by slot: one row a component.
    pub(crate) outputs: Vec<(Slot, [Row; 4])>,
    /// The kind of the shader, for the names of slots.
    kind: crate::isa::ShaderKind,
}

/// A row that holds one number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Uniform {
    pub(crate) row: Row,
    pub(crate) value: UniformValue,
}

/// What a uniform row holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum UniformValue {
    /// A component of a constant register.
    Constant(u32, u8),
    /// A number.
    Literal(f32),
}

/// A row that is loaded from outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Input {
    pub(crate) row: Row,
    pub(crate) slot: Slot,
    pub(crate) component: u8,
    /// Whether denormal numbers are to become zero on the way: a move of the input has been folded into its load.
    pub(crate) flushed: bool,
}

/// One operation on one or several sets of rows.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct RowStep {
    pub(crate) op: RowOp,
    pub(crate) finish: RowFinish,
    /// The numbers that the results become in the end.
    pub(crate) writes: Model,
    /// Its part of [`Plan::operands`]. It is done as often as there is what one item needs.
    pub(crate) operands: Range<usize>,
    /// The instruction that it came from.
    pub(crate) origin: usize,
    /// Of a sample: a number that all samples at the same coordinates have.
    pub(crate) place: usize,
}

/// What becomes of a result before it is written: shift, saturation, denormal numbers to zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum RowFinish {
    /// Nothing: it cannot be a denormal number, or it is no result but what an operand reads.
    Keep,
    /// Denormal numbers become zero.
    Flush,
    /// Everything.
    Full(ResultModifier),
}

/// What is computed of rows; the meanings are in [`crate::semantics`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum RowOp {
    /// s0
    Mov,
    /// A source modifier, of floats.
    Modify(SourceModifier),
    /// A source modifier as a model reads it.
    Operand(Model, SourceModifier),
    Add,
    Sub,
    Mul,
    Mad,
    Lrp,
    Min,
    Max,
    Slt,
    Sge,
    Frc,
    /// The floor that goes into `a0`.
    Address,
    Cnd,
    Cmp,
    /// Of s0, s1, s2 and s3, s4, s5.
    Dp3,
    /// Of s0 to s3 and s4 to s7.
    Dp4,
    Rcp,
    Rsq,
    Exp,
    Log,
    /// One component of `expp`.
    ExpP(u8),
    /// One component of `logp`.
    LogP(u8),
    /// The second component of `lit`.
    LitDiffuse,
    /// The third component of `lit`, of x, y and w.
    LitSpecular,
    /// s0 / s1 as coordinates are divided.
    Divide,
    /// Component x or y of s0, s1 plus s2, s3 through the bump matrix of a stage.
    Bump(u8, u8),
    /// s0 times the luminance s1 of a stage.
    Luminance(u8, Model),
    /// s3, s4, s5 mirrored at s0, s1, s2: three results.
    Reflect,
    /// What the texture of a stage holds at s0, s1, s2: four results.
    Sample(u8),
    /// A depth of s0 / s1.
    Depth,
    /// Discards where s0 is negative; no result.
    Kill,
    /// Component c of the constant whose number is s0 plus n.
    Relative(u32, u8),
}

impl RowOp {
    /// How many rows it reads.
    pub(crate) const fn sources(self) -> usize {
        use RowOp::*;
        match self {
            Mov | Modify(_) | Operand(..) | Frc | Address | Rcp | Rsq | Exp | Log | ExpP(_)
            | LogP(_) | LitDiffuse | Kill | Relative(..) => 1,
            Add | Sub | Mul | Min | Max | Slt | Sge | Divide | Luminance(..) | Depth => 2,
            Mad | Lrp | Cnd | Cmp | LitSpecular | Sample(_) => 3,
            Bump(..) => 4,
            Dp3 | Reflect => 6,
            Dp4 => 8,
        }
    }

    /// How many rows it writes.
    pub(crate) const fn results(self) -> usize {
        match self {
            Self::Kill => 0,
            Self::Reflect => 3,
            Self::Sample(_) => 4,
            _ => 1,
        }
    }
}

impl Plan {
    /// The plan of a kernel.
    pub fn new(kernel: &Kernel) -> Self {
        let graph = build::build(kernel);
        rows::place(kernel, &graph)
    }

    /// The components of inputs that are read.
    pub(crate) fn inputs(&self) -> impl Iterator<Item = (Slot, usize)> {
        let inputs = self.inputs.iter();
        inputs.map(|input| (input.slot, usize::from(input.component)))
    }

    /// The rows that a step writes and those that it reads, item by item.
    pub(crate) fn items(&self, step: &RowStep) -> impl Iterator<Item = (&[Row], &[Row])> {
        let results = step.op.results();
        let width = results + step.op.sources();
        (self.operands(step).chunks_exact(width)).map(move |item| item.split_at(results))
    }

    /// The rows that a step names: item by item those that it writes, then those that it reads.
    #[inline(always)]
    pub(crate) fn operands(&self, step: &RowStep) -> &[Row] {
        self.operands.get(step.operands.clone()).unwrap_or_default()
    }

    /// The rows of a slot that the shader leaves.
    pub(crate) fn output(&self, slot: Slot) -> Option<&[Row; 4]> {
        (self.outputs.iter())
            .find(|(of, _)| *of == slot)
            .map(|(_, rows)| rows)
    }
}

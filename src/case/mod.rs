//! Shader unit tests: a case says what a listing computes from given inputs.
//!
//! The format is described in `docs/cases.md`. [`Case::load`] reads a case from TOML or JSON; [`Case::check`] runs all
//! its invocations on the CPU and tells what came of each.
//!
//! Running and judging are apart: [`observe`] is the CPU's way to an [`Observed`], and [`judge`] compares any
//! `Observed` with what an invocation expects. The GPU's way, `OnGpu`, only has to give `Observed`s as well. Where a wrong
//! number was born is told by the trace of the CPU.
//!
//! Files, in the order of the data: `json` (JSON as the tree that TOML is read into), `read`, `registers` and `texture`
//! (the tree to a [`Case`]), `computing` (its model and policies), `quantity` (what can be expected), `run` (the CPU), `record`
//! (the same, step by step), `gpu` and `slack` (the GPU, and how far it may be off), `judge`.

mod computing;
#[cfg(feature = "gpu")]
mod gpu;
mod json;
mod judge;
mod quantity;
mod read;
mod record;
mod registers;
mod run;
#[cfg(feature = "gpu")]
mod slack;
mod texture;

#[cfg(test)]
mod tests;

use crate::diagnostic::{Diagnostic, SourceMap};
use crate::exec::STAGES;
use crate::raster::{RenderState, Surface};
use crate::scene::Shader;
use crate::semantics::BumpState;
use crate::texture::{Sampler, Texture};

pub use crate::scene::SceneError as CaseError;
#[cfg(feature = "gpu")]
pub use gpu::OnGpu;
pub use judge::{Verdict, Wrong, judge};
pub use quantity::Quantity;
pub use read::{DEFAULT_TOLERANCE, MAX_INVOCATIONS};
pub use record::{Told, record};
pub use run::{Observed, Origin, Run, Value, observe};

/// A shader unit test, ready to run.
#[derive(Clone, Debug)]
pub struct Case {
    /// Its name; that of the file where the case has none.
    pub name: String,
    /// The vertex shader.
    pub vertex: Option<Shader>,
    /// The pixel shader. There is at least one of the two.
    pub pixel: Option<Shader>,
    /// The texture stages.
    pub stages: [Stage; STAGES],
    /// The render states.
    pub state: RenderState,
    /// What the target holds before the pixel is drawn.
    pub target: Surface,
    /// The invocations, at least one.
    pub invocations: Vec<Invocation>,
    sources: SourceMap,
    warnings: Vec<Diagnostic>,
}

/// A texture stage of a case.
#[derive(Clone, Debug, Default)]
pub struct Stage {
    /// What is bound; a stage without a texture samples opaque black.
    pub texture: Option<Texture>,
    /// How it is sampled.
    pub sampler: Sampler,
    /// The bump mapping states.
    pub bump: BumpState,
}

/// One run of the shaders of a case.
#[derive(Clone, Debug)]
pub struct Invocation {
    /// Its name, if it has one.
    pub name: Option<String>,
    /// The line of the case at which it begins, from 1.
    pub line: usize,
    /// `v0` to `v15` of the vertex shader; (0, 0, 0, 1) where nothing is given.
    pub vertex_inputs: [[f32; 4]; 16],
    /// `v0` and `v1` of the pixel shader where there is no vertex shader, not clamped yet.
    pub colors: [[f32; 4]; 2],
    /// `t0` to `t7` where there is no vertex shader; (0, 0, 0, 1) where nothing is given.
    pub texcoords: [[f32; 4]; 8],
    /// Constants of the vertex shader, by register.
    pub vertex_constants: Vec<(u32, [f32; 4])>,
    /// Constants of the pixel shader, by register, not clamped yet.
    pub pixel_constants: Vec<(u32, [f32; 4])>,
    /// The largest absolute difference that passes.
    pub tolerance: f64,
    /// What must come out.
    pub expect: Expectation,
    /// Whole other results that pass as well: what some drivers of the time gave.
    pub accept: Vec<Expectation>,
}

/// What is expected of an invocation; what it does not speak of may be anything.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Expectation {
    /// The numbers.
    pub values: Vec<Expected>,
    /// Whether `texkill` discards the pixel.
    pub killed: Option<bool>,
}

/// The numbers expected of one quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Expected {
    /// Of what.
    pub quantity: Quantity,
    /// Its first components, one to four.
    pub components: Vec<f32>,
}

impl Expectation {
    /// This expectation, filled up with those of another one for quantities of which it does not speak.
    #[must_use]
    fn over(&self, base: &Self) -> Self {
        let mut values = self.values.clone();
        for other in &base.values {
            if !values.iter().any(|own| own.quantity == other.quantity) {
                values.push(other.clone());
            }
        }
        Self {
            values,
            killed: self.killed.or(base.killed),
        }
    }

    /// Whether it expects nothing.
    fn is_empty(&self) -> bool {
        self.values.is_empty() && self.killed.is_none()
    }
}

impl Invocation {
    /// What it expects or accepts, each quantity once.
    fn wanted(&self) -> Vec<Quantity> {
        let mut wanted: Vec<Quantity> = Vec::new();
        for expectation in std::iter::once(&self.expect).chain(&self.accept) {
            for Expected { quantity, .. } in &expectation.values {
                if !wanted.contains(quantity) {
                    wanted.push(*quantity);
                }
            }
        }
        wanted
    }
}

impl Case {
    /// The case file and the listings, for the places of [`Self::warnings`] and of programs.
    pub fn sources(&self) -> &SourceMap {
        &self.sources
    }

    /// What is allowed and yet worth telling, of the case and of its listings.
    pub fn warnings(&self) -> &[Diagnostic] {
        &self.warnings
    }

    /// Runs all invocations on the CPU. The verdicts are in the order of [`Self::invocations`].
    pub fn check(&self) -> Vec<Verdict> {
        let verdict = |invocation: &Invocation| {
            let run = observe(self, invocation);
            judge(invocation, &run.observed, |quantity, component| {
                run.origin(quantity, component)
            })
        };
        self.invocations.iter().map(verdict).collect()
    }
}

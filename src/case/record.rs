//! An invocation of a case step by step.

use super::run::{
    lone, pixel_environment, pixel_inputs, vertex_environment, vertex_inputs, without_vertex_shader,
};
use super::{Case, Invocation, Quantity};
use crate::debug::{self, Input, InputSource, Listing, Run, RunKind, tell_merge};
use crate::exec::Environment;
use crate::kernel::Slot;
use crate::raster::{RenderState, merge_lone, vertex_outputs};
use crate::scene::Shader;

/// The runs of an invocation, each with every step.
#[derive(Clone, Debug)]
pub struct Told<'a> {
    /// The run of the vertex shader.
    pub vertex: Option<Run<'a>>,
    /// The run of the pixel shader; behind its last instruction, where a case has render states or speaks of `frame`, the stages of
    /// the output merger.
    pub pixel: Option<Run<'a>>,
}

/// Runs the shaders of a case once, as [`observe`](super::observe) does, and keeps every step.
pub fn record<'a>(case: &'a Case, invocation: &Invocation) -> Told<'a> {
    let vertex = case.vertex.as_ref().map(|shader| {
        let inputs = vertex_inputs(invocation).map(|(slot, value)| (slot, value, value));
        let environment = vertex_environment(shader, invocation);
        run(case, shader, environment, inputs, InputSource::Given)
    });
    let (outputs, source) = match &vertex {
        Some(run) => {
            let registers = run.registers(usize::MAX);
            let outputs = vertex_outputs(run.listing.kernel, |slot| registers.slot(slot, 0));
            (outputs, InputSource::Output)
        }
        None => (without_vertex_shader(invocation), InputSource::Given),
    };
    let pixel = case.pixel.as_ref().map(|shader| {
        let environment = pixel_environment(case, shader, invocation);
        let mut run = run(case, shader, environment, pixel_inputs(&outputs), source);
        if case.state != RenderState::default() || invocation.wanted().contains(&Quantity::Frame) {
            let registers = run.registers(usize::MAX);
            let depth = registers.slot(Slot::DEPTH, 0)[0];
            let depth = shader.kernel.writes_depth().then_some(depth);
            let killed = registers.killed()[0];
            let color = registers.slot(Slot::R0, 0);
            let pixel = lone(&case.state, &outputs, color, depth, killed);
            if let Ok(merged) = merge_lone(&case.state, &pixel, &case.target) {
                tell_merge(&mut run, &merged.record);
            }
        }
        run
    });
    Told { vertex, pixel }
}

fn run<'a>(
    case: &'a Case,
    shader: &'a Shader,
    environment: Environment<'a>,
    inputs: impl Iterator<Item = (Slot, [f32; 4], [f32; 4])>,
    source: InputSource,
) -> Run<'a> {
    let kernel = &shader.kernel;
    let read = inputs.filter(|(slot, ..)| !kernel.read(*slot).is_empty());
    let inputs = read.map(|(slot, raw, value)| Input {
        slot,
        source,
        raw: [raw; 4],
        value: [value; 4],
    });
    let invocation = debug::Invocation {
        kind: RunKind::Listing,
        listing: Listing {
            program: &shader.program,
            kernel,
            sources: &case.sources,
        },
        environment,
        lane: 0,
        helpers: [false; 4],
        inputs: inputs.collect(),
    };
    debug::record(invocation, &[])
}

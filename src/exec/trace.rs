//! A run, recorded.

use super::environment::Environment;
use super::machine::{Lanes, Machine, Observer};
use crate::isa::WriteMask;
use crate::kernel::{Kernel, Slot};

/// One write of one step in one lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Change {
    /// The number of the step in the kernel.
    pub step: usize,
    /// The instruction that the step came from.
    pub instruction: usize,
    /// What was written.
    pub slot: Slot,
    /// Which components were written.
    pub mask: WriteMask,
    /// The register before.
    pub before: [f32; 4],
    /// The register after.
    pub after: [f32; 4],
}

/// Every write of a run in one lane, in order, and what came of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Trace {
    /// The writes.
    pub changes: Vec<Change>,
    /// The instruction that discarded the pixel, if one did.
    pub killed_by: Option<usize>,
}

impl Trace {
    /// Runs a kernel and records lane `lane`.
    pub fn record<const N: usize>(
        machine: &mut Machine<N>,
        kernel: &Kernel,
        environment: &Environment<'_>,
        lane: usize,
    ) -> Self {
        let mut recorder = Recorder {
            kernel,
            lane,
            trace: Trace {
                changes: Vec::with_capacity(kernel.steps.len()),
                killed_by: None,
            },
        };
        machine.run_observed(kernel, environment, usize::MAX, &mut recorder);
        recorder.trace
    }
}

struct Recorder<'a> {
    kernel: &'a Kernel,
    lane: usize,
    trace: Trace,
}

impl<const N: usize> Observer<N> for Recorder<'_> {
    fn wrote(&mut self, number: usize, before: &Lanes<N>, after: &Lanes<N>) {
        let step = &self.kernel.steps[number];
        let of_lane = |register: &Lanes<N>| {
            register.map(|component| component.get(self.lane).copied().unwrap_or(0.0))
        };
        self.trace.changes.push(Change {
            step: number,
            instruction: step.origin,
            slot: step.destination,
            mask: step.mask,
            before: of_lane(before),
            after: of_lane(after),
        });
    }

    fn killed(&mut self, number: usize, killed: &[bool; N]) {
        if killed.get(self.lane) == Some(&true) && self.trace.killed_by.is_none() {
            self.trace.killed_by = Some(self.kernel.steps[number].origin);
        }
    }
}

//! Many invocations at a time, for whole frames: the steps of a [`Plan`] over rows of lanes.
//!
//! The functions of [`crate::semantics`] are called in loops over the lanes of a row; [`Simd`] says for which vector
//! instructions the loops are compiled. The outputs have the same bits as those of a [`Machine`](super::Machine) that runs
//! the kernel, whatever the number of lanes.

mod reach;
mod rows;
mod samples;
mod step;
#[cfg(test)]
mod tests;

use super::environment::{Environment, STAGES};
use crate::kernel::{Plan, RowOp, RowStep, Slot, UniformValue};
use crate::semantics::flush;
use crate::simd::{Simd, Task};
use reach::{Greatest, Reach};
use rows::Rows;
use samples::Samples;
use step::Turn;

/// The rows of `N` invocations.
#[derive(Clone, Debug)]
pub struct Batch<const N: usize> {
    rows: Rows<N>,
    samples: Samples<N>,
    killed: [bool; N],
    reach: Reach,
    /// Whether all inputs, and the samples so far, are as small as `reach` wants them.
    within: bool,
}

impl<const N: usize> Default for Batch<N> {
    fn default() -> Self {
        Self {
            rows: Rows::default(),
            samples: Samples::default(),
            killed: [false; N],
            reach: Reach::default(),
            within: false,
        }
    }
}

impl<const N: usize> Batch<N> {
    /// Loads the constants, and computes what follows from them alone. Must come before [`Self::run`], and again when plan,
    /// constants or stages have changed.
    pub fn load(&mut self, plan: &Plan, environment: &Environment<'_>) {
        self.rows.resize(plan.rows);
        for uniform in &plan.uniforms {
            let value = match uniform.value {
                UniformValue::Literal(number) => number,
                UniformValue::Constant(index, component) => {
                    let constant = environment.constants.get(index as usize);
                    constant.map_or(0.0, |constant| constant[usize::from(component) & 3])
                }
            };
            self.rows.fill(uniform.row, value);
        }
        self.samples.load(plan, environment);
        // Once a draw: not worth a copy of its own for each set of instructions.
        self.within = false;
        self.steps(Simd::Baseline, plan, environment, 0..plan.once, N);
        self.reach = Reach::new(plan, &self.rows.first());
    }

    /// Loads an input: `component(slot, c)` is a component of a register in all lanes. It is asked only for what the shader
    /// needs.
    #[inline(always)]
    pub(crate) fn input<'r>(
        &mut self,
        plan: &Plan,
        component: impl Fn(Slot, usize) -> Option<&'r [f32; N]>,
    ) {
        let mut greatest = Greatest::default();
        for input in &plan.inputs {
            let Some(values) = component(input.slot, usize::from(input.component)) else {
                continue;
            };
            reach::raise(&mut greatest, values);
            let mut loaded = *values;
            if input.flushed {
                for number in &mut loaded {
                    *number = flush(*number);
                }
            }
            self.rows.set(input.row, &loaded);
        }
        self.within = self.reach.admits(&greatest);
    }

    /// Runs the first `lanes` lanes on the inputs that were loaded; the others may hold anything afterwards.
    pub fn run(&mut self, simd: Simd, plan: &Plan, environment: &Environment<'_>, lanes: usize) {
        simd.run(Run {
            batch: self,
            simd,
            plan,
            environment,
            lanes,
        });
    }

    /// As [`Self::run`], within a task for these instructions.
    #[inline(always)]
    pub(crate) fn run_here(
        &mut self,
        simd: Simd,
        plan: &Plan,
        environment: &Environment<'_>,
        lanes: usize,
    ) {
        self.killed = [false; N];
        self.steps(simd, plan, environment, plan.once..plan.steps.len(), lanes);
    }

    #[inline(always)]
    fn steps(
        &mut self,
        simd: Simd,
        plan: &Plan,
        environment: &Environment<'_>,
        steps: std::ops::Range<usize>,
        lanes: usize,
    ) {
        let first = steps.start;
        for (number, step) in (first..).zip(plan.steps.get(steps).unwrap_or_default()) {
            step::take(
                &mut self.rows,
                &mut self.killed,
                plan,
                step,
                environment,
                &mut self.samples,
                Turn {
                    number,
                    lanes,
                    finite: self.within && self.reach.is_finite(number),
                    simd,
                },
            );
            if let RowOp::Sample(stage) = step.op {
                let stage = &environment.stages[usize::from(stage) % STAGES];
                // What is packed is from 0 to 1, however it is filtered.
                let unit = |border: &f32| border.abs() <= 1.0;
                self.within &= match stage.texture {
                    Some(texture)
                        if !texture.format().is_packed()
                            || !stage.sampler.border.iter().all(unit) =>
                    {
                        self.is_within(plan, step)
                    }
                    _ => self.reach.admits(&[1.0_f32.to_bits(); 8]),
                };
            }
        }
    }

    /// Whether the results of a step are as small as is wanted.
    #[inline(always)]
    fn is_within(&self, plan: &Plan, step: &RowStep) -> bool {
        let results = plan.items(step).flat_map(|(results, _)| results);
        let mut greatest = Greatest::default();
        for row in results.filter_map(|row| self.rows.get(*row)) {
            reach::raise(&mut greatest, row);
        }
        self.reach.admits(&greatest)
    }

    /// The components that the shader leaves in a slot; of one that is no output of it nothing.
    pub fn output(&self, plan: &Plan, slot: Slot) -> [Option<&[f32; N]>; 4] {
        let rows = plan.output(slot).copied();
        std::array::from_fn(|c| rows.and_then(|rows| self.rows.get(rows[c])))
    }

    /// The lanes that `texkill` discarded in the last run.
    pub fn killed(&self) -> &[bool; N] {
        &self.killed
    }
}

/// A run as something that is compiled for each set of instructions.
struct Run<'a, 'e, const N: usize> {
    batch: &'a mut Batch<N>,
    simd: Simd,
    plan: &'a Plan,
    environment: &'a Environment<'e>,
    lanes: usize,
}

impl<const N: usize> Task for Run<'_, '_, N> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        (self.batch).run_here(self.simd, self.plan, self.environment, self.lanes);
    }
}

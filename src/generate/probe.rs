//! Runs a shader while it is written, with a bound on every register.

use super::approx::Approx;
use super::bound::{Bounds, Context, Sampling, modified};
use super::{INVOCATIONS, Options, Stage, Textures};
use crate::exec::{Environment, Machine, STAGES};
use crate::isa::{ResultModifier, SourceModifier, WriteMask};
use crate::kernel::{Kernel, Op, Operand, Place, SLOT_COUNT, Slot, Step};
use crate::policy::Model;

/// All registers of all invocations after some instructions, with how far executors may be apart on them.
#[derive(Clone)]
pub(crate) struct Probe {
    pub(crate) machine: Machine<INVOCATIONS>,
    /// The error of each component of each slot, slot by slot, invocation by invocation.
    errors: Vec<[[f64; 4]; INVOCATIONS]>,
}

/// Where operands are looked at: nothing is kept there from one instruction to the next.
const SCRATCH: Slot = Slot::COORDINATES;

impl Probe {
    /// The machine before the first instruction. Inputs are exact.
    pub(crate) fn new(inputs: &[(Slot, [[f32; 4]; INVOCATIONS])]) -> Self {
        let mut machine = Machine::new();
        for (slot, values) in inputs {
            for (lane, value) in values.iter().enumerate() {
                machine.set_lane(*slot, lane, *value);
            }
        }
        Self {
            machine,
            errors: vec![[[0.0; 4]; INVOCATIONS]; SLOT_COUNT],
        }
    }

    /// The same where a slot is known only roughly, in all invocations alike.
    #[cfg(feature = "gpu")]
    pub(crate) fn with_errors(mut self, slot: Slot, errors: [f64; 4]) -> Self {
        if let Some(known) = self.errors.get_mut(slot.index()) {
            *known = [errors; INVOCATIONS];
        }
        self
    }

    /// The error bounds of a slot.
    pub(crate) fn errors(&self, slot: Slot) -> [[f64; 4]; INVOCATIONS] {
        self.errors.get(slot.index()).copied().unwrap_or_default()
    }

    /// The state after the instructions from number `first` on; `None` if executors that are right may part there.
    pub(crate) fn after(
        &self,
        mut kernel: Kernel,
        first: usize,
        environment: &Environment<'_>,
        sampling: &dyn Sampling,
        options: &Options,
    ) -> Option<Probe> {
        let context = &Context {
            precision: &options.precision,
            of_zero: kernel.policies.of_zero,
            sampling,
        };
        let mut next = self.clone();
        let mut steps = std::mem::take(&mut kernel.steps);
        steps.retain(|step| step.origin >= first);
        kernel.presets.clear();
        // A group is what reads before any of it writes: steps that are held and the one after them.
        let mut rest = steps.as_slice();
        while !rest.is_empty() {
            let held = rest.iter().take_while(|step| step.held).count();
            let (group, after) = rest.split_at((held + 1).min(rest.len()));
            rest = after;
            let mut bounds = Vec::with_capacity(group.len());
            for step in group {
                bounds.push(next.bounds(&mut kernel, step, environment, context)?);
            }
            kernel.steps = group.to_vec();
            next.machine.run(&kernel, environment);
            for (step, bounds) in group.iter().zip(bounds) {
                next.keep(step, &bounds, context, options)?;
            }
        }
        Some(next)
    }

    /// The bounds of what a step computes.
    fn bounds(
        &mut self,
        kernel: &mut Kernel,
        step: &Step,
        environment: &Environment<'_>,
        context: &Context<'_>,
    ) -> Option<Bounds> {
        let mut sources = [[[Approx::ZERO; 4]; INVOCATIONS]; 3];
        for (i, (source, operand)) in sources.iter_mut().zip(&step.sources).enumerate() {
            let slots = step.op.slots_read(i, step.mask);
            *source = self.operand(kernel, step.reads, operand, slots, environment, context);
        }
        let [a, b, c] = sources;
        let mut bounds = [[Approx::ZERO; 4]; INVOCATIONS];
        for (lane, bound) in bounds.iter_mut().enumerate() {
            *bound = context.step(step, [a[lane], b[lane], c[lane]])?;
        }
        Some(bounds)
    }

    /// What an operand reads, with bounds. The interpreter itself reads it, so that modifiers, swizzles and relative
    /// addressing are not written a second time here.
    fn operand(
        &mut self,
        kernel: &mut Kernel,
        model: Model,
        operand: &Operand,
        slots: WriteMask,
        environment: &Environment<'_>,
        context: &Context<'_>,
    ) -> Bounds {
        let kept = *self.machine.register(SCRATCH);
        let mut read = |reads: Model, operand: Operand| {
            kernel.steps = vec![Step {
                op: Op::Mov,
                destination: SCRATCH,
                mask: slots,
                sources: vec![operand],
                result: ResultModifier::NONE,
                reads,
                writes: Model::Float,
                held: false,
                origin: 0,
            }];
            self.machine.run(kernel, environment);
            let values = *self.machine.register(SCRATCH);
            *self.machine.register_mut(SCRATCH) = kept;
            values
        };
        let values = read(model, *operand);
        // What lies in the register tells whether all executors round it alike.
        let stored = match model {
            Model::Float => values,
            _ => read(
                Model::Float,
                Operand {
                    modifier: SourceModifier::None,
                    ..*operand
                },
            ),
        };
        let errors = match operand.place {
            Place::Slot(slot) => self.errors(slot),
            Place::Constant(_) | Place::Relative(_) | Place::Literal(_) => [[0.0; 4]; INVOCATIONS],
        };
        let mut bounds = [[Approx::ZERO; 4]; INVOCATIONS];
        for slot in slots.components() {
            for (lane, bound) in bounds.iter_mut().enumerate() {
                let value = f64::from(values[slot][lane]);
                let error = errors[lane][operand.swizzle.slot(slot)];
                let stored = Approx::new(stored[slot][lane].into(), error);
                let error = stored.held(model, context.precision.rounding).error;
                bound[slot] = match operand.modifier {
                    SourceModifier::None => Approx::new(value, error),
                    modifier => modified(modifier, error, value, context.precision),
                };
            }
        }
        bounds
    }

    /// Takes over the bounds of a step that has run.
    fn keep(
        &mut self,
        step: &Step,
        bounds: &Bounds,
        context: &Context<'_>,
        options: &Options,
    ) -> Option<()> {
        if step.op == Op::Kill {
            return Some(());
        }
        let errors = self.errors.get_mut(step.destination.index())?;
        for (lane, bound) in bounds.iter().enumerate() {
            let values = self.machine.lane(step.destination, lane);
            for c in step.mask.components() {
                let value = f64::from(values[c]);
                let mut error = context.finish(step, bound[c]).error;
                if error > 0.0 && bound[c].value.abs() < f64::from(f32::MIN_POSITIVE) {
                    // The result, or what comes of it, may be flushed to zero.
                    error += f64::from(f32::MIN_POSITIVE);
                }
                let finite = value.is_finite() && error.is_finite();
                if !finite && options.largest_value == f64::INFINITY {
                    // No difference is small here: executors have the same or part.
                    errors[lane][c] = 0.0;
                    continue;
                }
                let near = error <= options.largest_error * value.abs().max(1.0);
                // What stands for infinity is the same everywhere.
                let endless = value.abs() == f64::from(context.of_zero.value()) && error == 0.0;
                // Written so that NaN is refused.
                if !(endless || value.abs() <= options.largest_value && near) {
                    return None;
                }
                errors[lane][c] = error;
            }
        }
        Some(())
    }
}

/// What a shader runs in.
pub(super) fn environment<'a>(
    constants: Vec<[f32; 4]>,
    stages: &[Stage; STAGES],
    textures: &'a Textures,
) -> Environment<'a> {
    Environment {
        constants,
        stages: std::array::from_fn(|i| textures.stage(&stages[i])),
    }
}

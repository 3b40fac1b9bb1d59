//! Registers and the step.

use super::environment::{Environment, STAGES};
use crate::isa::{SourceModifier, Swizzle, WriteMask};
use crate::kernel::{Kernel, Op, Operand, Place, SLOT_COUNT, Slot, Step};
use crate::policy::{Model, Policies, ZeroProduct};
use crate::semantics::{self, Finish, Ieee, Products, ZeroWins};
use crate::texture::sample_quads;
use std::ops::Range;

/// A register of `N` lanes, component by component.
pub type Lanes<const N: usize> = [[f32; N]; 4];

/// Sees what a run reads and writes.
pub trait Observer<const N: usize> {
    /// A step has been computed: what its operands read, modifiers applied, and the result before shift, saturation and
    /// mask. Slots that the step does not use hold anything.
    #[inline(always)]
    fn computed(&mut self, step: usize, sources: &[Lanes<N>; 3], result: &Lanes<N>) {
        let _ = (step, sources, result);
    }

    /// A step has been written. Steps that are held are told when they are written, in their order.
    ///
    /// `step` is its number in the kernel, `before` and `after` the whole destination register.
    fn wrote(&mut self, step: usize, before: &Lanes<N>, after: &Lanes<N>);

    /// `texkill` has looked at the pixels; `killed` is true for those that are discarded by now.
    fn killed(&mut self, step: usize, killed: &[bool; N]);
}

/// Sees nothing, costs nothing.
struct Unobserved;

impl<const N: usize> Observer<N> for Unobserved {
    fn wrote(&mut self, _: usize, _: &Lanes<N>, _: &Lanes<N>) {}
    fn killed(&mut self, _: usize, _: &[bool; N]) {}
}

/// At most this many steps of a group wait for its end: a matrix macro has four rows.
const MOST_HELD: usize = 4;

/// The registers of `N` invocations.
#[derive(Clone, Debug)]
pub struct Machine<const N: usize> {
    registers: Box<[Lanes<N>]>,
    killed: [bool; N],
}

impl<const N: usize> Default for Machine<N> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const N: usize> Machine<N> {
    /// A machine with all registers zero.
    pub fn new() -> Self {
        Self {
            registers: vec![[[0.0; N]; 4]; SLOT_COUNT].into_boxed_slice(),
            killed: [false; N],
        }
    }

    /// The content of a register.
    #[inline]
    pub fn register(&self, slot: Slot) -> &Lanes<N> {
        &self.registers[slot.index()]
    }

    /// The register, to load inputs into it.
    #[inline]
    pub fn register_mut(&mut self, slot: Slot) -> &mut Lanes<N> {
        &mut self.registers[slot.index()]
    }

    /// The content of a register in one lane; zero for lanes that do not exist.
    pub fn lane(&self, slot: Slot, lane: usize) -> [f32; 4] {
        self.register(slot)
            .map(|component| component.get(lane).copied().unwrap_or(0.0))
    }

    /// Loads a value into a register of one lane; lanes that do not exist are left alone.
    #[inline]
    pub fn set_lane(&mut self, slot: Slot, lane: usize, value: [f32; 4]) {
        if lane < N {
            set_lane(self.register_mut(slot), lane, value);
        }
    }

    /// Loads the same value into a register of every lane.
    pub fn load(&mut self, slot: Slot, value: [f32; 4]) {
        *self.register_mut(slot) = value.map(|component| [component; N]);
    }

    /// The lanes that `texkill` discarded in the last run.
    pub fn killed(&self) -> &[bool; N] {
        &self.killed
    }

    /// Runs a kernel. Inputs are what the registers hold; everything else that the kernel expects is loaded first.
    #[inline]
    pub fn run(&mut self, kernel: &Kernel, environment: &Environment<'_>) {
        self.run_observed(kernel, environment, usize::MAX, &mut Unobserved);
    }

    /// Runs the steps of the first `instructions` instructions and tells the observer of every write.
    pub fn run_observed(
        &mut self,
        kernel: &Kernel,
        environment: &Environment<'_>,
        instructions: usize,
        observer: &mut impl Observer<N>,
    ) {
        self.prepare(kernel);
        let end = (kernel.steps.iter()).position(|step| step.origin >= instructions);
        let steps = 0..end.unwrap_or(kernel.steps.len());
        self.run_steps(kernel, environment, steps, observer);
    }

    /// Loads what a kernel expects before its first step; nothing is killed yet. [`Self::run`] does it by itself.
    #[inline]
    pub fn prepare(&mut self, kernel: &Kernel) {
        self.killed = [false; N];
        for (slot, value) in &kernel.presets {
            self.load(*slot, *value);
        }
    }

    /// Runs some steps of a kernel and goes on from what the registers hold. What is held at the end of the range is written;
    /// steps beyond the end of the kernel are none.
    #[inline]
    pub fn run_steps(
        &mut self,
        kernel: &Kernel,
        environment: &Environment<'_>,
        steps: Range<usize>,
        observer: &mut impl Observer<N>,
    ) {
        let mut held: [(usize, Lanes<N>); MOST_HELD] = [(0, [[0.0; N]; 4]); MOST_HELD];
        let mut waiting = 0;
        let range = steps.start..steps.end.min(kernel.steps.len());
        let first = range.start;
        for (place, step) in kernel
            .steps
            .get(range)
            .unwrap_or_default()
            .iter()
            .enumerate()
        {
            let number = first + place;
            let sources = self.sources(step, environment);
            if step.op == Op::Kill {
                self.kill(&sources[0]);
                observer.computed(number, &sources, &[[0.0; N]; 4]);
                observer.killed(number, &self.killed);
                continue;
            }
            let result = Self::compute(&kernel.policies, step, &sources, environment);
            observer.computed(number, &sources, &result);
            if step.held && waiting < MOST_HELD {
                held[waiting] = (number, result);
                waiting += 1;
                continue;
            }
            for (number, result) in &held[..waiting] {
                self.commit(*number, &kernel.steps[*number], result, observer);
            }
            waiting = 0;
            self.commit(number, step, &result, observer);
        }
        // A run that stops inside a group still writes what was computed.
        for (number, result) in &held[..waiting] {
            self.commit(*number, &kernel.steps[*number], result, observer);
        }
    }

    #[inline]
    fn commit(
        &mut self,
        number: usize,
        step: &Step,
        result: &Lanes<N>,
        observer: &mut impl Observer<N>,
    ) {
        let register = &mut self.registers[step.destination.index()];
        let before = *register;
        let finish = Finish::new(step.result);
        for c in step.mask.components() {
            for (written, computed) in register[c].iter_mut().zip(&result[c]) {
                *written = finish.apply(*computed);
            }
        }
        if step.writes != Model::Float {
            for c in step.mask.components() {
                for written in &mut register[c] {
                    *written = semantics::held(step.writes, *written);
                }
            }
        }
        observer.wrote(number, &before, register);
    }

    fn kill(&mut self, s0: &Lanes<N>) {
        for (lane, killed) in self.killed.iter_mut().enumerate() {
            // −0 and NaN do not kill.
            *killed |= s0[..3].iter().any(|component| component[lane] < 0.0);
        }
    }

    /// What an operand reads into the slots of the mask, as numbers of a model.
    #[inline]
    fn fetch(
        &self,
        model: Model,
        operand: &Operand,
        slots: WriteMask,
        environment: &Environment<'_>,
    ) -> Lanes<N> {
        let constant = |index: usize| {
            environment
                .constants
                .get(index)
                .copied()
                .unwrap_or([0.0; 4])
        };
        let swizzle = operand.swizzle;
        let mut value = match operand.place {
            Place::Slot(slot) => swizzled(self.register(slot), swizzle, slots),
            Place::Constant(index) => {
                let constant = constant(index as usize).map(|component| [component; N]);
                swizzled(&constant, swizzle, slots)
            }
            Place::Relative(offset) => {
                let mut gathered = [[0.0; N]; 4];
                for lane in 0..N {
                    let a0 = self.register(Slot::ADDRESS)[0][lane] as i64;
                    let index = usize::try_from(a0 + i64::from(offset)).unwrap_or(usize::MAX);
                    set_lane(&mut gathered, lane, constant(index));
                }
                swizzled(&gathered, swizzle, slots)
            }
            Place::Literal(number) => [[number; N]; 4],
        };
        if model != Model::Float {
            for slot in slots.components() {
                for number in &mut value[slot] {
                    *number = semantics::operand(model, operand.modifier, *number);
                }
            }
        } else if operand.modifier != SourceModifier::None {
            for slot in slots.components() {
                for number in &mut value[slot] {
                    *number = semantics::modify(operand.modifier, *number);
                }
            }
        }
        value
    }

    #[inline]
    fn sources(&self, step: &Step, environment: &Environment<'_>) -> [Lanes<N>; 3] {
        let mut sources = [[[0.0; N]; 4]; 3];
        for (i, (source, operand)) in sources.iter_mut().zip(&step.sources).enumerate() {
            let slots = step.op.slots_read(i, step.mask);
            *source = self.fetch(step.reads, operand, slots, environment);
        }
        sources
    }

    /// The result of a step before it is finished. Components outside of the mask may hold anything.
    #[inline]
    fn compute(
        policies: &Policies,
        step: &Step,
        sources: &[Lanes<N>; 3],
        environment: &Environment<'_>,
    ) -> Lanes<N> {
        let mask = step.mask;
        let [a, b, c] = sources;
        match step.op {
            Op::Mov => *a,
            Op::Add => each(mask, |k, l| a[k][l] + b[k][l]),
            Op::Sub => each(mask, |k, l| a[k][l] - b[k][l]),
            Op::Mul | Op::Mad | Op::Lrp | Op::Dp3 | Op::Dp4 | Op::Lit | Op::Dst => {
                match policies.zero_product {
                    ZeroProduct::Zero => products::<N, ZeroWins>(step, sources),
                    ZeroProduct::Ieee => products::<N, Ieee>(step, sources),
                }
            }
            Op::Min => each(mask, |k, l| semantics::min(a[k][l], b[k][l])),
            Op::Max => each(mask, |k, l| semantics::max(a[k][l], b[k][l])),
            Op::Slt => each(mask, |k, l| semantics::slt(a[k][l], b[k][l])),
            Op::Sge => each(mask, |k, l| semantics::sge(a[k][l], b[k][l])),
            Op::Frc => each(mask, |k, l| semantics::frc(a[k][l])),
            Op::Floor => each(mask, |k, l| semantics::address(a[k][l])),
            Op::Cnd => each(mask, |k, l| semantics::cnd(a[k][l], b[k][l], c[k][l])),
            Op::Cmp => each(mask, |k, l| semantics::cmp(a[k][l], b[k][l], c[k][l])),
            Op::Rcp => replicate(|l| semantics::rcp(policies.of_zero, a[0][l])),
            Op::Rsq => replicate(|l| semantics::rsq(policies.of_zero, a[0][l])),
            Op::Exp => replicate(|l| semantics::exp(a[0][l])),
            Op::Log => replicate(|l| semantics::log(policies.of_zero, a[0][l])),
            Op::ExpP => vector(|l| semantics::expp(a[0][l])),
            Op::LogP => vector(|l| semantics::logp(policies.of_zero, a[0][l])),
            Op::DivideZ => vector(|l| divided(xyzw(a, l), a[2][l])),
            Op::DivideW => vector(|l| divided(xyzw(a, l), a[3][l])),
            Op::Project(by) => vector(|l| {
                let by = a[usize::from(by) & 3][l];
                let [x, y, ..] = divided(xyzw(a, l), by);
                [x, y, semantics::divide(a[2][l], by), 0.0]
            }),
            Op::Bump(stage) => {
                let state = &environment.stages[usize::from(stage) % STAGES].bump;
                vector(|l| {
                    let [x, y] = semantics::bump([a[0][l], a[1][l]], [b[0][l], b[1][l]], state);
                    [x, y, a[2][l], a[3][l]]
                })
            }
            Op::Luminance(stage) => {
                let state = &environment.stages[usize::from(stage) % STAGES].bump;
                each(mask, |k, l| {
                    semantics::luminance(step.reads, a[k][l], b[2][l], state)
                })
            }
            Op::Reflect => vector(|l| {
                let [x, y, z] = semantics::reflect(xyz(a, l), xyz(b, l));
                [x, y, z, 0.0]
            }),
            Op::Sample(stage) => {
                let stage = &environment.stages[usize::from(stage) % STAGES];
                let mut texels = [[0.0; N]; 4];
                let coordinates = [a[0], a[1], a[2]];
                sample_quads(stage.texture, &stage.sampler, &coordinates, &mut texels);
                texels
            }
            Op::Depth => vector(|l| [semantics::depth(a[0][l], a[1][l]), 0.0, 0.0, 0.0]),
            Op::Kill => [[0.0; N]; 4],
        }
    }
}

/// The operations that are made of products.
#[inline]
fn products<const N: usize, P: Products>(step: &Step, sources: &[Lanes<N>; 3]) -> Lanes<N> {
    use semantics::{dp3, dp4, dst, lit, lrp, mad};
    let mask = step.mask;
    let [a, b, c] = sources;
    match step.op {
        Op::Mad => each(mask, |k, l| mad::<P>(a[k][l], b[k][l], c[k][l])),
        Op::Lrp => each(mask, |k, l| lrp::<P>(a[k][l], b[k][l], c[k][l])),
        Op::Dp3 => replicate(|l| dp3::<P>(xyz(a, l), xyz(b, l))),
        Op::Dp4 => replicate(|l| dp4::<P>(xyzw(a, l), xyzw(b, l))),
        Op::Lit => vector(|l| lit::<P>(xyzw(a, l))),
        Op::Dst => vector(|l| dst::<P>(xyzw(a, l), xyzw(b, l))),
        _ => each(mask, |k, l| P::product(a[k][l], b[k][l])),
    }
}

#[inline(always)]
fn swizzled<const N: usize>(register: &Lanes<N>, swizzle: Swizzle, slots: WriteMask) -> Lanes<N> {
    let mut value = [[0.0; N]; 4];
    for slot in slots.components() {
        value[slot] = register[swizzle.slot(slot)];
    }
    value
}

/// Component by component.
#[inline(always)]
fn each<const N: usize>(mask: WriteMask, f: impl Fn(usize, usize) -> f32) -> Lanes<N> {
    let mut result = [[0.0; N]; 4];
    for component in mask.components() {
        for (lane, number) in result[component].iter_mut().enumerate() {
            *number = f(component, lane);
        }
    }
    result
}

/// One number for all components.
#[inline(always)]
fn replicate<const N: usize>(f: impl Fn(usize) -> f32) -> Lanes<N> {
    let mut number = [0.0; N];
    for (lane, number) in number.iter_mut().enumerate() {
        *number = f(lane);
    }
    [number; 4]
}

/// All components at once.
#[inline(always)]
fn vector<const N: usize>(f: impl Fn(usize) -> [f32; 4]) -> Lanes<N> {
    let mut result = [[0.0; N]; 4];
    for lane in 0..N {
        set_lane(&mut result, lane, f(lane));
    }
    result
}

#[inline(always)]
fn set_lane<const N: usize>(register: &mut Lanes<N>, lane: usize, value: [f32; 4]) {
    for (component, value) in register.iter_mut().zip(value) {
        component[lane] = value;
    }
}

#[inline(always)]
fn xyz<const N: usize>(register: &Lanes<N>, lane: usize) -> [f32; 3] {
    [register[0][lane], register[1][lane], register[2][lane]]
}

#[inline(always)]
fn xyzw<const N: usize>(register: &Lanes<N>, lane: usize) -> [f32; 4] {
    register.map(|component| component[lane])
}

/// Coordinates after a divide modifier. Only the first two components are defined.
#[inline(always)]
fn divided([x, y, ..]: [f32; 4], divisor: f32) -> [f32; 4] {
    [
        semantics::divide(x, divisor),
        semantics::divide(y, divisor),
        0.0,
        0.0,
    ]
}

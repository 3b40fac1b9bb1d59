//! How large the numbers in registers may become, and so where a product needs the rule that 0 times anything is 0.
//!
//! With finite factors the product of WGSL obeys that rule by itself. A factor may be infinite or NaN only behind an
//! operation that can overflow. So an upper bound of the magnitude is kept for every component of every register, and
//! the guarded product is written only where a bound is infinite and the other factor may be 0.
//!
//! Assumed of what comes from outside: see [`super`], "What is assumed".

use super::Options;
use crate::isa::{ResultModifier, ShaderKind, SourceModifier, WriteMask};
use crate::kernel::{Kernel, Op, Operand, Place, SLOT_COUNT, Slot, Step};
use crate::policy::{Model, Policies, ZeroProduct};
use std::collections::BTreeMap;

/// A number that may be infinite or NaN.
const UNBOUNDED: f64 = f64::INFINITY;
const LARGEST: f64 = f32::MAX as f64;

/// One component of a register at one moment: slot, component, how often it had been written.
type Moment = (Slot, usize, u32);

/// What is known about a component beside its magnitude, for the sake of normalised vectors.
#[derive(Clone, Debug, PartialEq)]
enum Fact {
    /// It is the sum of the squares of these.
    Square(Vec<Moment>),
    /// It is 1 over the root of the sum of the squares of these.
    InverseLength(Vec<Moment>),
    /// It is one of these over the root of the sum of their squares.
    Unit(Vec<Moment>),
}

/// What one slot of an operand may hold.
#[derive(Clone, Copy, Debug)]
struct Factor {
    most: f64,
    zero: bool,
}

/// The bounds of all registers between two steps.
#[derive(Clone, Debug)]
pub(super) struct Magnitudes {
    kind: ShaderKind,
    policies: Policies,
    /// The components that hold numbers of the shader's hardware model, by slot.
    held: [WriteMask; SLOT_COUNT],
    most: [[f64; 4]; SLOT_COUNT],
    writes: [[u32; 4]; SLOT_COUNT],
    /// By slot and component.
    facts: BTreeMap<(Slot, usize), Fact>,
    /// The constants whose values are known.
    known: BTreeMap<u32, [f32; 4]>,
    /// The largest magnitude of what comes from outside.
    outside: f64,
    /// The largest magnitude of a texel of each stage.
    texels: [f64; 8],
}

/// What a step leaves behind.
pub(super) struct Outcome {
    most: [f64; 4],
    facts: [Option<Fact>; 4],
}

impl Magnitudes {
    pub(super) fn new(kernel: &Kernel, known: BTreeMap<u32, [f32; 4]>, options: &Options) -> Self {
        let kind = kernel.version.kind();
        let outside = if options.wild_inputs {
            UNBOUNDED
        } else {
            Options::TAME.into()
        };
        let mut most = [[0.0; 4]; SLOT_COUNT];
        let inputs = (0..16).filter_map(Slot::input);
        let input = match kind {
            ShaderKind::Vertex => outside,
            ShaderKind::Pixel => 1.0,
        };
        inputs.for_each(|slot| most[slot.index()] = [input; 4]);
        let sets = (0..8).filter_map(Slot::texcoord);
        sets.for_each(|slot| most[slot.index()] = [outside; 4]);
        // Colours are brought into the model where they come in; registers are 0 at first.
        let mut held = [WriteMask::ALL; SLOT_COUNT];
        for slot in (0..8).filter_map(Slot::texcoord) {
            held[slot.index()] = WriteMask::NONE;
        }
        Self {
            kind,
            policies: kernel.policies,
            held,
            most,
            writes: [[0; 4]; SLOT_COUNT],
            facts: BTreeMap::new(),
            known,
            texels: (options.stages).map(|stage| if stage.wide_texels { outside } else { 1.0 }),
            outside,
        }
    }

    fn factor(&self, operand: &Operand, slot: usize) -> Factor {
        let component = operand.swizzle.slot(slot);
        let known = match operand.place {
            Place::Constant(index) => self.known.get(&index),
            _ => None,
        };
        let most = match operand.place {
            Place::Slot(slot) => self.most[slot.index()][component],
            Place::Literal(number) => f64::from(number.abs()),
            Place::Constant(_) => match known {
                Some(value) if value[component].is_finite() => f64::from(value[component].abs()),
                Some(_) => UNBOUNDED,
                None if self.kind == ShaderKind::Pixel => 1.0,
                None => self.outside,
            },
            Place::Relative(_) => self.outside,
        };
        let modified = match operand.modifier {
            SourceModifier::Bias | SourceModifier::BiasNegate => most + 0.5,
            SourceModifier::Bx2 | SourceModifier::Bx2Negate => 2.0 * most + 1.0,
            SourceModifier::Complement => most + 1.0,
            SourceModifier::X2 | SourceModifier::X2Negate => 2.0 * most,
            SourceModifier::None
            | SourceModifier::Negate
            | SourceModifier::Dz
            | SourceModifier::Dw => most,
        };
        let known = known.is_some() || matches!(operand.place, Place::Literal(_));
        let plain = matches!(
            operand.modifier,
            SourceModifier::None | SourceModifier::Negate
        );
        Factor {
            most: limited(modified),
            zero: !(known && plain && most > 0.0),
        }
    }

    /// The components of a register that hold numbers of the shader's hardware model by now.
    pub(super) fn held(&self, slot: Slot) -> WriteMask {
        self.held[slot.index()]
    }

    /// Whether a step needs products that are guarded against a factor of 0.
    pub(super) fn needs_guard(&self, step: &Step) -> bool {
        // Fixed-point numbers are finite.
        if step.reads != Model::Float || self.policies.zero_product == ZeroProduct::Ieee {
            return false;
        }
        let [Some(a), Some(b)] = [step.sources.first(), step.sources.get(1)] else {
            return false;
        };
        // Whether one factor may be 0 and the other infinite or NaN.
        let fails = |a: Factor, b: Factor| {
            (a.most == UNBOUNDED && b.zero) || (b.most == UNBOUNDED && a.zero)
        };
        let any_fails = |slots: WriteMask| {
            (slots.components()).any(|slot| fails(self.factor(a, slot), self.factor(b, slot)))
        };
        match step.op {
            Op::Mul | Op::Mad => any_fails(step.mask),
            Op::Dp3 => any_fails(WriteMask::XYZ) || self.factors_overflow(a, b, WriteMask::XYZ),
            Op::Dp4 => any_fails(WriteMask::ALL) || self.factors_overflow(a, b, WriteMask::ALL),
            Op::Dst => any_fails(WriteMask::Y.and(step.mask)),
            Op::Lrp => {
                let rest = |slot: usize| Factor {
                    most: limited(self.factor(a, slot).most + 1.0),
                    zero: true,
                };
                any_fails(step.mask)
                    || step.sources.get(2).is_some_and(|c| {
                        (step.mask.components()).any(|slot| fails(rest(slot), self.factor(c, slot)))
                    })
            }
            _ => false,
        }
    }

    /// Whether a dot product may come out as NaN when compilers factor it: x·a + x·b as x·(a + b), with an x of 0 and a sum
    /// beyond the largest number.
    fn factors_overflow(&self, a: &Operand, b: &Operand, slots: WriteMask) -> bool {
        let one_way = |x: &Operand, others: &Operand| {
            slots.components().any(|slot| {
                let same = |other: &usize| x.swizzle.slot(*other) == x.swizzle.slot(slot);
                let together: Vec<usize> = slots.components().filter(same).collect();
                let sum: f64 = (together.iter())
                    .map(|slot| self.factor(others, *slot).most)
                    .sum();
                together.len() > 1 && self.factor(x, slot).zero && limited(sum) == UNBOUNDED
            })
        };
        one_way(a, b) || one_way(b, a)
    }

    /// Whether no slot of an operand that the mask has is infinite or NaN.
    pub(super) fn is_finite(&self, operand: &Operand, slots: WriteMask) -> bool {
        (slots.components()).all(|slot| self.factor(operand, slot).most < UNBOUNDED)
    }

    /// Whether what a step computes is neither infinite nor NaN before it becomes a number of a model.
    pub(super) fn gives_finite(&self, step: &Step) -> bool {
        let scale = 2f64.powi(step.result.shift.into());
        // Saturation takes NaN to 0.
        step.result.saturate
            || (step.mask.components())
                .all(|component| limited(self.bound(step, component) * scale) < UNBOUNDED)
    }

    /// Whether a component of a register may be infinite or NaN by now.
    pub(super) fn may_be_infinite(&self, slot: Slot, component: usize) -> bool {
        self.most[slot.index()][component & 3] == UNBOUNDED
    }

    /// Whether what an operand reads into its first slot is a number that `i32` has as well, once it is rounded.
    pub(super) fn fits_i32(&self, operand: &Operand) -> bool {
        self.factor(operand, 0).most < 2f64.powi(31)
    }

    /// What a step leaves behind if it runs now.
    pub(super) fn outcome(&self, step: &Step) -> Outcome {
        let scale = 2f64.powi(step.result.shift.into());
        let mut most = [0.0; 4];
        for component in step.mask.components() {
            let bound = limited(self.bound(step, component) * scale);
            most[component] = if step.result.saturate { 1.0 } else { bound };
            most[component] = most[component].min(step.writes.most().into());
        }
        let facts = std::array::from_fn(|component| {
            let written = step.mask.has(component);
            written.then(|| self.fact(step, component)).flatten()
        });
        Outcome { most, facts }
    }

    /// Writes what a step left behind.
    pub(super) fn write(&mut self, step: &Step, outcome: Outcome) {
        let at = step.destination.index();
        self.held[at] = match step.writes {
            Model::Float => self.held[at].without(step.mask),
            Model::Gf3 | Model::R200 => self.held[at].or(step.mask),
        };
        for (component, fact) in outcome.facts.into_iter().enumerate() {
            if step.mask.has(component) {
                self.most[at][component] = outcome.most[component];
                self.writes[at][component] += 1;
                match fact {
                    Some(fact) => self.facts.insert((step.destination, component), fact),
                    None => self.facts.remove(&(step.destination, component)),
                };
            }
        }
    }

    fn bound(&self, step: &Step, component: usize) -> f64 {
        let of = |i: usize, slot: usize| {
            (step.sources.get(i)).map_or(UNBOUNDED, |operand| self.factor(operand, slot).most)
        };
        let product = |a: f64, b: f64| limited(if a == 0.0 || b == 0.0 { 0.0 } else { a * b });
        let (a, b, c) = (of(0, component), of(1, component), of(2, component));
        let scalar = of(0, 0);
        let dot = |n: usize| {
            let sum = (0..n).map(|i| product(of(0, i), of(1, i))).sum::<f64>();
            // No more than the product of the lengths.
            limited(sum).min(product(self.length(step, 0, n), self.length(step, 1, n)))
        };
        match step.op {
            Op::Mov => a,
            Op::Add | Op::Sub => a + b,
            Op::Mul if self.normalised(step, component).is_some() => 1.0,
            Op::Mul => product(a, b),
            Op::Mad => product(a, b) + c,
            Op::Lrp => product(a, b) + product(a + 1.0, c),
            Op::Min | Op::Max => a.max(b),
            Op::Cnd | Op::Cmp => b.max(c),
            Op::Slt | Op::Sge | Op::Depth => 1.0,
            Op::Frc if a < UNBOUNDED => 1.0,
            Op::Frc => UNBOUNDED,
            Op::Floor => a,
            Op::Dp3 => dot(3),
            Op::Dp4 => dot(4),
            Op::Rcp | Op::Rsq | Op::Log if scalar < UNBOUNDED => self.of_zero(),
            Op::Rcp | Op::Rsq | Op::Log => UNBOUNDED,
            Op::Exp => scalar.exp2(),
            Op::ExpP => [scalar.exp2(), 1.0, scalar.exp2(), 1.0][component],
            Op::LogP if scalar < UNBOUNDED => [self.of_zero(), 2.0, self.of_zero(), 1.0][component],
            Op::LogP => UNBOUNDED,
            Op::Lit => [1.0, scalar, self.specular(step), 1.0][component],
            Op::Dst => [1.0, product(of(0, 1), of(1, 1)), of(0, 2), of(1, 3)][component],
            Op::Bump(_) => a + product(self.outside, of(1, 0) + of(1, 1)),
            Op::Luminance(_) => product(a, product(self.outside, of(1, 2)) + self.outside),
            Op::Sample(stage) => self.texels[usize::from(stage) & 7],
            Op::DivideZ | Op::DivideW | Op::Project(_) | Op::Reflect | Op::Kill => UNBOUNDED,
        }
    }

    /// The magnitude of a reciprocal or a logarithm of 0.
    fn of_zero(&self) -> f64 {
        self.policies.of_zero.value().into()
    }

    /// The bound of the specular term of `lit`: finite where the power is known not to be negative.
    fn specular(&self, step: &Step) -> f64 {
        let Some(source) = step.sources.first() else {
            return UNBOUNDED;
        };
        let power = match (source.place, source.modifier) {
            (Place::Constant(index), SourceModifier::None) => (self.known.get(&index))
                .map(|value| f64::from(value[source.swizzle.slot(3)]))
                .filter(|power| *power >= 0.0),
            _ => None,
        };
        match power {
            Some(power) => self.factor(source, 1).most.powf(power.min(128.0)).max(1.0),
            None => UNBOUNDED,
        }
    }

    fn moments(&self, operand: &Operand, slots: WriteMask) -> Option<Vec<Moment>> {
        let Place::Slot(slot) = operand.place else {
            return None;
        };
        let moments = slots.components().map(|at| {
            let component = operand.swizzle.slot(at);
            (slot, component, self.writes[slot.index()][component])
        });
        Some(moments.collect())
    }

    /// What a step tells about a component that it writes.
    fn fact(&self, step: &Step, component: usize) -> Option<Fact> {
        if step.result != ResultModifier::NONE {
            return None;
        }
        let first = step.sources.first()?;
        match step.op {
            Op::Dp3 | Op::Dp4
                if step.sources.get(1) == Some(first) && first.modifier == SourceModifier::None =>
            {
                let slots = step.op.slots_read(0, step.mask);
                self.moments(first, slots).map(Fact::Square)
            }
            Op::Rsq if first.modifier == SourceModifier::None => match self.known_of(first, 0) {
                Some(Fact::Square(of)) => Some(Fact::InverseLength(of.clone())),
                _ => None,
            },
            Op::Mul => self.normalised(step, component).cloned().map(Fact::Unit),
            _ => None,
        }
    }

    /// What is known about the component that an operand reads into a slot.
    fn known_of(&self, operand: &Operand, slot: usize) -> Option<&Fact> {
        match operand.place {
            Place::Slot(register) => {
                let component = operand.swizzle.slot(slot);
                self.facts.get(&(register, component))
            }
            _ => None,
        }
    }

    /// The vector of which a product is a component divided by the vector's length.
    fn normalised(&self, step: &Step, component: usize) -> Option<&Vec<Moment>> {
        let [a, b] = step.sources.as_slice() else {
            return None;
        };
        let one_way = |vector: &Operand, length: &Operand| {
            let Some(Fact::InverseLength(of)) = self.known_of(length, component) else {
                return None;
            };
            let part = self.moments(vector, WriteMask::component(component))?;
            let plain = is_plain(vector) && is_plain(length);
            (plain && part.iter().all(|moment| of.contains(moment))).then_some(of)
        };
        one_way(a, b).or_else(|| one_way(b, a))
    }

    /// The greatest length of the vector that a step reads from source `i`, of `n` components.
    fn length(&self, step: &Step, i: usize, n: usize) -> f64 {
        let Some(operand) = step.sources.get(i) else {
            return UNBOUNDED;
        };
        let distinct = WriteMask::from_bits((1 << n) - 1);
        let distinct = operand.swizzle.reads(distinct).count() as usize == n;
        let first = self.known_of(operand, 0);
        let unit = matches!(first, Some(Fact::Unit(_)))
            && (1..n).all(|slot| self.known_of(operand, slot) == first);
        if unit && distinct && is_plain(operand) {
            return 1.0;
        }
        let squares = (0..n).map(|slot| self.factor(operand, slot).most.powi(2));
        limited(squares.sum::<f64>().sqrt())
    }
}

fn is_plain(operand: &Operand) -> bool {
    matches!(
        operand.modifier,
        SourceModifier::None | SourceModifier::Negate
    )
}

/// What is larger than any finite number may be infinite.
fn limited(bound: f64) -> f64 {
    // Written so that NaN, which sums of infinities could be, counts as unbounded too.
    if bound <= LARGEST { bound } else { UNBOUNDED }
}

//! What each step of a kernel becomes: one arm an operation, with the meaning of [`crate::semantics`].

use super::body::{Body, slots_read};
use super::by_hand::{Argument, ByHand};
use super::expression::{Binding, Expression, Value};
use super::helper::{Detail, Helper};
use super::layout::Field;
use crate::isa::WriteMask;
use crate::isa::operand::XYZW;
use crate::kernel::{Op, Step};
use crate::policy::{Model, ZeroProduct};
use crate::texture::TextureKind;

impl Body<'_> {
    /// The value that a step computes, before its result modifier: as many components as the mask has, or a scalar.
    pub(super) fn value(&mut self, step: &Step) -> Value {
        let mask = step.mask;
        let width = mask.count() as usize;
        // Sources by number; every step has as many as its operation reads.
        let source = |body: &mut Self, i: usize| {
            body.operand(step, i, slots_read(step.op, step.mask, i, body.options))
        };
        let one = |body: &mut Self, i: usize, slot: usize| {
            body.operand(step, i, WriteMask::component(slot))
        };
        let of_zero = self.stage.kernel.policies.of_zero;
        let guard = self.magnitudes.needs_guard(step);
        let whole = match step.op {
            Op::Mov => source(self, 0),
            Op::Add => source(self, 0).plus(&source(self, 1)),
            Op::Sub => source(self, 0).minus(&source(self, 1)),
            Op::Mul => {
                let (a, b) = (source(self, 0), source(self, 1));
                self.product(guard, &a, &b)
            }
            Op::Mad => {
                let (a, b) = (source(self, 0), source(self, 1));
                self.product(guard, &a, &b).plus(&source(self, 2))
            }
            Op::Lrp => {
                let (a, b, c) = (source(self, 0), source(self, 1), source(self, 2));
                let rest = Expression::number("1.0").minus(&a);
                let first = self.product(guard, &a, &b);
                first.plus(&self.product(guard, &rest, &c))
            }
            Op::Min => self.extreme(step, "min", "<"),
            Op::Max => self.extreme(step, "max", ">="),
            Op::Slt => truth(&source(self, 0), "<", &source(self, 1)),
            Op::Sge => truth(&source(self, 0), ">=", &source(self, 1)),
            Op::Frc => {
                let a = source(self, 0);
                a.minus(&a.map("floor"))
            }
            Op::Floor => {
                let x = source(self, 0);
                // WGSL leaves open what becomes of NaN.
                match (step.sources.first()).is_some_and(|x| self.magnitudes.fits_i32(x)) {
                    true => Expression::call("i32", &[x.map("floor").text], 1),
                    false => self.called(Helper::Address, &[x], 1),
                }
            }
            Op::Cnd | Op::Cmp => {
                let (operator, bound) = match step.op {
                    Op::Cnd => (">", "0.5"),
                    _ => (">=", "0.0"),
                };
                let (a, b, c) = (source(self, 0), source(self, 1), source(self, 2));
                let test = a.compared(operator, &Expression::number(bound));
                choice(&c, &b, &test)
            }
            Op::Dp3 => self.dot(step, guard, 3),
            Op::Dp4 => self.dot(step, guard, 4),
            Op::Rcp => {
                let x = source(self, 0);
                self.called(Helper::Rcp(of_zero), &[x], 1)
            }
            Op::Rsq => {
                let x = source(self, 0);
                self.called(Helper::Rsq(of_zero), &[x], 1)
            }
            Op::Log => {
                let x = source(self, 0);
                self.called(Helper::Log2(of_zero), &[x], 1)
            }
            Op::Exp => source(self, 0).map("exp2"),
            Op::ExpP => return self.partial_powers(step),
            Op::LogP => {
                let x = source(self, 0);
                let all = self.called(Helper::LogP(of_zero), &[x], 4);
                components(&all, mask)
            }
            Op::Lit => {
                let arguments = [one(self, 0, 0), one(self, 0, 1), one(self, 0, 3)];
                let ieee = self.stage.kernel.policies.zero_product == ZeroProduct::Ieee;
                let all = self.called(Helper::Lit { of_zero, ieee }, &arguments, 4);
                components(&all, mask)
            }
            Op::Dst => {
                let part = |component: usize| match component {
                    0 => Expression::number("1.0"),
                    1 => {
                        let (a, b) = (one(self, 0, 1), one(self, 1, 1));
                        self.product(guard, &a, &b)
                    }
                    2 => one(self, 0, 2),
                    _ => one(self, 1, 3),
                };
                return Value::Parts(mask.components().map(part).collect());
            }
            Op::DivideZ | Op::DivideW => {
                let divisor = if step.op == Op::DivideZ { 2 } else { 3 };
                let xy = self.operand(step, 0, WriteMask::XY);
                let arguments = [xy.spread(2), one(self, 0, divisor)];
                let xy = self.called(Helper::Divide(2), &arguments, 2);
                planar(
                    xy,
                    mask,
                    [Expression::number("0.0"), Expression::number("0.0")],
                )
            }
            Op::Project(by) => {
                // A 2D texture takes two of them, a cube or a volume three.
                let coordinates = self.operand(step, 0, mask).spread(width);
                let arguments = [coordinates, one(self, 0, by.into())];
                self.called(Helper::Divide(width), &arguments, width)
            }
            Op::Bump(stage) => {
                let at = self.operand(step, 0, WriteMask::XY);
                let (du, dv) = (one(self, 1, 0), one(self, 1, 1));
                let matrix = self.uniform(Field::Bump(stage));
                let row = |swizzle: &str| Expression::new(format!("{matrix}.{swizzle}"), 2);
                let offset = row("xy").times(&du).plus(&row("zw").times(&dv));
                let offset = Expression::new(format!("({})", offset.text), 2);
                let xy = at.plus(&offset);
                let rest = [2, 3].map(|slot| {
                    if mask.has(slot) {
                        one(self, 0, slot)
                    } else {
                        Expression::number("0.0")
                    }
                });
                planar(xy, mask, rest)
            }
            Op::Luminance(stage) => {
                let (a, l) = (source(self, 0), one(self, 1, 2));
                let state = self.uniform(Field::Luminance(stage));
                let part = |c: &str| Expression::new(format!("{state}.{c}"), 1);
                let factor = l.times(&part("x")).plus(&part("y"));
                match step.reads {
                    Model::Gf3 => a.times(&factor.map("saturate")),
                    Model::Float | Model::R200 => a.times(&factor),
                }
            }
            Op::Reflect => {
                let arguments = [source(self, 0).spread(3), source(self, 1).spread(3)];
                let all = self.called(Helper::Mirror, &arguments, 3);
                components(&all, mask)
            }
            Op::Depth => {
                let (z, w) = (one(self, 0, 0), one(self, 0, 1));
                let quotient = format!("saturate({} / {})", z.text, w.text);
                let test = format!("{} == 0.0", w.text);
                Expression::call("select", &[quotient, "1.0".into(), test], 1)
            }
            Op::Sample(_) | Op::Kill => Expression::number("0.0"),
        };
        debug_assert!(whole.width == 1 || whole.width == width, "{step:?}");
        Value::Whole(whole)
    }

    fn called(&mut self, helper: Helper, arguments: &[Expression], width: usize) -> Expression {
        let name = self.helpers.call(helper);
        let arguments: Vec<&str> = arguments.iter().map(|a| a.text.as_str()).collect();
        Expression::call(&name, &arguments, width)
    }

    fn product(&mut self, guard: bool, a: &Expression, b: &Expression) -> Expression {
        if !guard {
            return a.times(b);
        }
        let width = a.width.max(b.width);
        let factors = [a, b].map(|factor| factor.clone().spread(width));
        self.called(Helper::MulZero(width), &factors, width)
    }

    fn dot(&mut self, step: &Step, guard: bool, width: usize) -> Expression {
        let slots = step.op.slots_read(0, step.mask);
        let vectors = [0, 1].map(|i| self.operand(step, i, slots).spread(width));
        match (guard, self.options.exact_dots) {
            (true, _) => self.called(Helper::DotZero(width), &vectors, 1),
            (false, true) => self.called(Helper::Dot(width), &vectors, 1),
            (false, false) => Expression::call("dot", &vectors.map(|v| v.text), 1),
        }
    }

    /// `min` or `max`. Where an operand may be NaN the second one is what comes out, which WGSL does not promise.
    fn extreme(&mut self, step: &Step, function: &str, operator: &str) -> Expression {
        let [a, b] = step.sources.as_slice() else {
            return Expression::number("0.0");
        };
        let finite = [a, b]
            .iter()
            .all(|s| self.magnitudes.is_finite(s, step.mask));
        let [a, b] = [0, 1].map(|i| self.operand(step, i, step.mask));
        let width = a.width.max(b.width);
        let (a, b) = (a.spread(width), b.spread(width));
        if finite {
            return Expression::call(function, &[a.text, b.text], width);
        }
        choice(&b, &a, &a.compared(operator, &b))
    }

    /// `expp`, each component for itself unless the function for all of them is shorter.
    fn partial_powers(&mut self, step: &Step) -> Value {
        let Some(operand) = step.sources.first() else {
            return Value::Whole(Expression::number("0.0"));
        };
        let finite = self.magnitudes.is_finite(operand, WriteMask::X);
        if step.mask.has(2) || (step.mask.has(1) && !finite) {
            let x = self.operand(step, 0, WriteMask::X);
            let all = self.called(Helper::ExpP, &[x], 4);
            return Value::Whole(components(&all, step.mask));
        }
        let part = |component: usize| {
            if component == 3 {
                return Expression::number("1.0");
            }
            let x = self.operand(step, 0, WriteMask::X);
            let whole = x.map("floor");
            if component == 0 {
                whole.map("exp2")
            } else {
                x.minus(&whole)
            }
        };
        Value::Parts(step.mask.components().map(part).collect())
    }

    /// A sample.
    pub(super) fn sample(&mut self, step: &Step, stage: u8) {
        let state = self.options.stages[usize::from(stage) & 7];
        if state.texture.is_none() || step.sources.is_empty() {
            let black = Expression::new("vec4f(0.0, 0.0, 0.0, 1.0)", 4);
            return self.sampled(step, &black);
        }
        let slots = slots_read(step.op, step.mask, 0, self.options);
        // Coordinates are named x, y and z, whatever register holds them.
        let at = self.operand_named(step, 0, slots, XYZW);
        let at = at.spread(state.coordinates()).text;
        let by_hand = state
            .is_by_hand()
            .then(|| state.by_hand(self.options.level_zero));
        let texel = match by_hand.flatten() {
            Some(sample) => self.texel_by_hand(stage, sample, at),
            None => self.texel(stage, at),
        };
        self.sampled(step, &texel);
    }

    /// Assigns a sample.
    fn sampled(&mut self, step: &Step, texel: &Expression) {
        let value = Value::Whole(components(texel, step.mask));
        let value = self.finished(step, value);
        self.assign(step.destination, step.mask, value);
    }

    /// The call that reads a texture with its sampler.
    fn texel(&mut self, stage: u8, at: String) -> Expression {
        let state = self.options.stages[usize::from(stage) & 7];
        let detail = match (self.options.level_zero, state.lod_bias) {
            (true, _) => Detail::LevelZero,
            (false, true) => Detail::Bias,
            (false, false) => Detail::Plain,
        };
        let faces = state.texture == Some(TextureKind::Cube) && !state.seamless;
        let function = match detail {
            _ if faces => self.helpers.call(Helper::SampleFaces(detail)),
            Detail::LevelZero => "textureSampleLevel".into(),
            Detail::Bias => "textureSampleBias".into(),
            Detail::Plain => "textureSample".into(),
        };
        let mut arguments = vec![format!("texture{stage}"), format!("sampler{stage}"), at];
        match detail {
            Detail::LevelZero if !faces => arguments.push("0.0".into()),
            Detail::Bias => arguments.push(self.uniform(Field::LodBias(stage))),
            Detail::LevelZero | Detail::Plain => {}
        }
        Expression::call(&function, &arguments, 4)
    }

    /// The call that reads it texel by texel.
    fn texel_by_hand(&mut self, stage: u8, sample: ByHand, at: String) -> Expression {
        let function = self.helpers.call(Helper::ByHand(sample));
        let mut arguments = vec![format!("texture{stage}"), at];
        for argument in sample.takes() {
            arguments.push(match argument {
                Argument::Bias => self.uniform(Field::LodBias(stage)),
                Argument::Levels => self.uniform(Field::Levels(stage)),
                Argument::Border => self.uniform(Field::Border(stage)),
            });
        }
        Expression::call(&function, &arguments, 4)
    }
}

/// The components of a vector that the mask has.
fn components(vector: &Expression, mask: WriteMask) -> Expression {
    let wanted: Vec<usize> = mask.components().collect();
    if wanted.iter().copied().eq(0..vector.width) {
        return vector.clone();
    }
    let name = vector.within(Binding::Primary);
    super::operand::select(name, vector.width, &wanted, XYZW)
}

/// 1 where a comparison holds, else 0.
fn truth(a: &Expression, operator: &str, b: &Expression) -> Expression {
    let test = a.compared(operator, b);
    let number = match test.width {
        1 => "f32".to_string(),
        width => format!("vec{width}f"),
    };
    Expression::call(&number, &[test.text], test.width)
}

/// `yes` where a comparison holds, else `no`.
fn choice(no: &Expression, yes: &Expression, test: &Expression) -> Expression {
    let width = no.width.max(yes.width).max(test.width);
    let arguments = [
        no.clone().spread(width).text,
        yes.clone().spread(width).text,
        test.text.clone(),
    ];
    Expression::call("select", &arguments, width)
}

/// x and y with the third and fourth component where the mask has them.
fn planar(xy: Expression, mask: WriteMask, rest: [Expression; 2]) -> Expression {
    let [z, w] = rest;
    let plane = components(&xy, mask.and(WriteMask::XY));
    let extra = [(2, z), (3, w)].into_iter().filter(|(c, _)| mask.has(*c));
    let mut parts: Vec<String> = extra.map(|(_, part)| part.text).collect();
    if mask.and(WriteMask::XY) == WriteMask::XY && parts.is_empty() {
        return xy;
    }
    if !mask.and(WriteMask::XY).is_empty() {
        parts.insert(0, plane.text);
    }
    let width = mask.count() as usize;
    match parts.as_slice() {
        [only] if width == 1 => Expression::new(only.clone(), 1),
        _ => Expression::call(&format!("vec{width}f"), &parts, width),
    }
}

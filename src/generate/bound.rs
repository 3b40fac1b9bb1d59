//! What each step does to the bounds, and where it would tear executors apart.

use super::approx::{Approx, Precision, dot};
use super::textures::{CUBE_MARGIN, Textures};
use super::{INVOCATIONS, Stage};
use crate::exec::STAGES;
use crate::isa::{SourceModifier, WriteMask};
use crate::kernel::{Op, Step};
use crate::policy::{Model, OfZero};
use crate::semantics::BumpState;
use crate::texture::TextureKind;

/// Where bounds are worked out.
pub(crate) struct Context<'a> {
    pub(super) precision: &'a Precision,
    /// What stands for infinity where a reciprocal or a logarithm of 0 is asked for.
    pub(super) of_zero: OfZero,
    pub(super) sampling: &'a dyn Sampling,
}

/// What bounds must know of texture stages.
pub(crate) trait Sampling {
    /// The bump mapping states of a stage.
    fn bump(&self, stage: usize) -> &BumpState;

    /// How far a sample at such coordinates may be off in any channel. `None`: executors that are right may part here.
    fn error(&self, stage: usize, at: [Approx; 3], precision: &Precision) -> Option<f64>;
}

/// The textures of generated shaders.
pub(super) struct Gentle<'a> {
    pub(super) stages: &'a [Stage; STAGES],
    pub(super) textures: &'a Textures,
}

impl Sampling for Gentle<'_> {
    fn bump(&self, stage: usize) -> &BumpState {
        &self.stages[stage % STAGES].bump
    }

    fn error(&self, stage: usize, at: [Approx; 3], precision: &Precision) -> Option<f64> {
        let r = precision.rounding;
        let stage = &self.stages[stage % STAGES];
        let slope = self.textures.slope(stage.kind, stage.signed);
        // Weights of 8 bits may be rounded the other way.
        let step = self.textures.weight_step(stage.kind);
        let moved = |x: &Approx| x.error + r * x.value.abs() + step;
        let moved = match stage.kind {
            TextureKind::Texture2D => at[..2].iter().map(moved).sum::<f64>(),
            TextureKind::Volume => at.iter().map(moved).sum(),
            TextureKind::Cube => cube(at, r)? + 2.0 * step,
        };
        Some(slope * moved + precision.sample)
    }
}

/// A register of one invocation.
pub(super) type Quad = [Approx; 4];

/// Registers of all invocations, invocation by invocation.
pub(super) type Bounds = [Quad; INVOCATIONS];

/// The bound of an operand after its modifier; `before` is that of the register, `value` what the modifier gave.
pub(super) fn modified(
    modifier: SourceModifier,
    before: f64,
    value: f64,
    precision: &Precision,
) -> Approx {
    use SourceModifier::{Bias, BiasNegate, Bx2, Bx2Negate, Complement, X2, X2Negate};
    let rounding = precision.rounding;
    // Undoes the modifier, so that the rule of sums decides what is rounded.
    let (register, bias, factor) = match modifier {
        Bias => (value + 0.5, -0.5, 1.0),
        BiasNegate => (0.5 - value, -0.5, -1.0),
        Bx2 => (value / 2.0 + 0.5, -0.5, 2.0),
        Bx2Negate => (0.5 - value / 2.0, -0.5, -2.0),
        Complement => (1.0 - value, -1.0, -1.0),
        X2 | X2Negate => return Approx::new(value, 2.0 * before),
        _ => return Approx::new(value, before),
    };
    let sum = Approx::new(register, before).plus(Approx::exact(bias), rounding);
    Approx::new(value, sum.scale(factor).error)
}

impl Context<'_> {
    /// The result of a step in one invocation before it is finished. `None`: executors that are right may part
    /// here, because a number lies at a threshold or too near to a pole.
    pub(super) fn step(&self, step: &Step, sources: [Quad; 3]) -> Option<Quad> {
        let (op, mask, model) = (step.op, step.mask, step.reads);
        let r = self.precision.rounding;
        let [a, b, c] = sources;
        let each = |f: &dyn Fn(usize) -> Option<Approx>| -> Option<Quad> {
            let mut quad = [Approx::ZERO; 4];
            for component in mask.components() {
                quad[component] = f(component)?;
            }
            Some(quad)
        };
        let all = |value: Approx| Some([value; 4]);
        // Compilers may factor sums, 0·a + 0·b as 0·(a + b), which is NaN where the sum is infinite.
        let sums = matches!(
            op,
            Op::Add | Op::Sub | Op::Mad | Op::Lrp | Op::Dp3 | Op::Dp4 | Op::Reflect
        );
        let endless = |quad: &Quad| quad.iter().any(|x| x.value.abs() >= f64::from(f32::MAX));
        if sums && sources.iter().any(endless) {
            return None;
        }
        match op {
            Op::Mov => Some(a),
            Op::Add => each(&|k| Some(a[k].plus(b[k], r))),
            Op::Sub => each(&|k| Some(a[k].minus(b[k], r))),
            Op::Mul => each(&|k| Some(a[k].times(b[k], r))),
            Op::Mad => each(&|k| Some(a[k].times(b[k], r).plus(c[k], r))),
            Op::Lrp => each(&|k| {
                let rest = Approx::ONE.minus(a[k], r);
                Some(a[k].times(b[k], r).plus(rest.times(c[k], r), r))
            }),
            Op::Min => each(&|k| Some(either(a[k], b[k], a[k].value < b[k].value))),
            Op::Max => each(&|k| Some(either(a[k], b[k], a[k].value >= b[k].value))),
            Op::Slt | Op::Sge => each(&|k| {
                // Both are compared as they are, so the difference is not rounded.
                let difference = Approx::new(a[k].value - b[k].value, a[k].error + b[k].error);
                let less = difference.value < 0.0;
                let one = less == (op == Op::Slt);
                difference
                    .apart_from(0.0)
                    .then_some(if one { Approx::ONE } else { Approx::ZERO })
            }),
            Op::Frc => each(&|k| self.fraction(a[k])),
            Op::Floor => each(&|k| {
                let whole = Approx::exact(a[k].value.floor());
                a[k].whole_is_sure().then_some(whole)
            }),
            Op::Cnd => each(&|k| {
                let chosen = if a[k].value > 0.5 { b[k] } else { c[k] };
                a[k].apart_from(0.5).then_some(chosen)
            }),
            Op::Cmp => each(&|k| {
                let chosen = if a[k].value >= 0.0 { b[k] } else { c[k] };
                a[k].apart_from(0.0).then_some(chosen)
            }),
            Op::Dp3 => all(dot(&a[..3], &b[..3], r)),
            Op::Dp4 => all(dot(&a, &b, r)),
            Op::Rcp | Op::Rsq if a[0] == Approx::ZERO => all(number(self.of_zero.value())),
            Op::Log if a[0] == Approx::ZERO => all(number(-self.of_zero.value())),
            Op::Rcp => all(Approx::ONE.over(a[0], r)?),
            Op::Rsq => all(self.inverse_root(a[0])?),
            Op::Exp => all(a[0].exp2(r)),
            Op::Log => all(a[0].log2(self.precision)?),
            Op::ExpP => self.partial_exponent(a[0], mask),
            Op::LogP => self.partial_logarithm(a[0], mask),
            Op::Lit => self.lit(a, mask),
            Op::Dst => Some([Approx::ONE, a[1].times(b[1], r), a[2], b[3]]),
            Op::DivideZ => self.divided(a, a[2]),
            Op::DivideW => self.divided(a, a[3]),
            Op::Project(by) => {
                let by = a[usize::from(by) & 3];
                let [x, y, ..] = self.divided(a, by)?;
                Some([x, y, self.quotient(a[2], by)?, Approx::ZERO])
            }
            Op::Bump(stage) => {
                let [m00, m01, m10, m11] = self.sampling.bump(stage.into()).matrix.map(number);
                let moved = |base: Approx, u: Approx, v: Approx| {
                    base.plus(u.times(b[0], r).plus(v.times(b[1], r), r), r)
                };
                Some([moved(a[0], m00, m10), moved(a[1], m01, m11), a[2], a[3]])
            }
            Op::Luminance(stage) => {
                let bump = self.sampling.bump(stage.into());
                let scaled = b[2].times(number(bump.luminance_scale), r);
                let mut luminance = scaled.plus(number(bump.luminance_offset), r);
                if model == Model::Gf3 {
                    luminance = luminance.saturate();
                }
                each(&|k| Some(a[k].times(luminance, r)))
            }
            Op::Reflect => {
                let square = dot(&a[..3], &a[..3], r);
                let scale = dot(&a[..3], &b[..3], r).scale(2.0).over(square, r)?;
                let mirrored = |k: usize| scale.times(a[k], r).minus(b[k], r);
                Some([mirrored(0), mirrored(1), mirrored(2), Approx::ZERO])
            }
            Op::Sample(stage) => {
                let at = [a[0], a[1], a[2]];
                let error = self.sampling.error(stage.into(), at, self.precision)?;
                all(Approx::new(0.0, error))
            }
            Op::Kill => {
                let sure = a[..3].iter().all(|x| x.apart_from(0.0));
                sure.then_some([Approx::ZERO; 4])
            }
            Op::Depth => all(self.quotient(a[0], a[1])?.saturate()),
        }
    }

    /// Shift, saturation and the numbers of the model.
    pub(super) fn finish(&self, step: &Step, x: Approx) -> Approx {
        let x = x.scale(f64::from(step.result.shift).exp2());
        let x = if step.result.saturate {
            x.saturate()
        } else {
            x
        };
        match step.op {
            // Of a sample only the error is known here, so that it may lie anywhere between two steps.
            Op::Sample(_) => x.held_somewhere(step.writes),
            _ => x.held(step.writes, self.precision.rounding),
        }
    }

    fn fraction(&self, x: Approx) -> Option<Approx> {
        let whole = Approx::exact(x.value.floor());
        if x == whole {
            // However large it is: nothing is left, and nothing is rounded.
            return Some(Approx::ZERO);
        }
        let fraction = x.minus(whole, self.precision.rounding);
        x.whole_is_sure().then_some(fraction)
    }

    fn inverse_root(&self, x: Approx) -> Option<Approx> {
        let size = Approx::new(x.value.abs(), x.error);
        // Refuses what the reciprocal refuses.
        Approx::ONE.over(size, self.precision.rounding)?;
        let value = 1.0 / size.value.sqrt();
        let nearest = size.value - size.error;
        let inherited = 0.5 * size.error / (nearest * nearest.sqrt());
        Some(Approx::new(
            value,
            inherited + self.precision.rounding * value,
        ))
    }

    /// x / y as the coordinate modifiers divide: 1 for a divisor that is zero everywhere.
    fn quotient(&self, x: Approx, y: Approx) -> Option<Approx> {
        if y == Approx::ZERO {
            return Some(Approx::ONE);
        }
        x.over(y, self.precision.rounding)
    }

    fn divided(&self, a: Quad, divisor: Approx) -> Option<Quad> {
        let x = self.quotient(a[0], divisor)?;
        let y = self.quotient(a[1], divisor)?;
        Some([x, y, Approx::ZERO, Approx::ZERO])
    }

    fn partial_exponent(&self, x: Approx, mask: WriteMask) -> Option<Quad> {
        let r = self.precision.rounding;
        if mask.has(0) && !x.whole_is_sure() {
            return None;
        }
        let fraction = if mask.has(1) {
            self.fraction(x)?
        } else {
            Approx::ZERO
        };
        Some([
            Approx::exact(x.value.floor()).exp2(r),
            fraction,
            self.partial(x.exp2(r)),
            Approx::ONE,
        ])
    }

    fn partial_logarithm(&self, x: Approx, mask: WriteMask) -> Option<Quad> {
        if x == Approx::ZERO {
            let least = number(-self.of_zero.value());
            return Some([least, Approx::ONE, least, Approx::ONE]);
        }
        let logarithm = x.log2(self.precision)?;
        let power = logarithm.value.floor().exp2();
        let size = Approx::new(x.value.abs(), x.error);
        // Exponent and mantissa jump at powers of two.
        let sure = size.apart_from(power) && size.apart_from(2.0 * power);
        if (mask.has(0) || mask.has(1)) && !sure {
            return None;
        }
        let r = self.precision.rounding;
        let mantissa = size.over(Approx::exact(power), r)?;
        let exponent = Approx::exact(logarithm.value.floor());
        Some([exponent, mantissa, self.partial(logarithm), Approx::ONE])
    }

    /// A result of which the lowest bits are dropped.
    fn partial(&self, x: Approx) -> Approx {
        Approx::new(x.value, x.error + self.precision.partial * x.value.abs())
    }

    fn lit(&self, [x, y, _, w]: Quad, mask: WriteMask) -> Option<Quad> {
        let diffuse = if x.value > 0.0 {
            x
        } else {
            Approx::new(0.0, x.error)
        };
        let mut specular = Approx::ZERO;
        if mask.has(2) {
            if !x.apart_from(0.0) || !y.apart_from(0.0) {
                return None;
            }
            if x.value > 0.0 && y.value > 0.0 {
                let power = Approx::new(w.value.clamp(-127.996_09, 127.996_09), w.error);
                let r = self.precision.rounding;
                specular = power.times(y.log2(self.precision)?, r).exp2(r);
            }
        }
        Some([Approx::ONE, diffuse, specular, Approx::ONE])
    }
}

fn number(x: f32) -> Approx {
    Approx::exact(x.into())
}

/// The smaller or the larger of two: off by no more than the one that is chosen, or both, where they may change places.
fn either(a: Approx, b: Approx, first: bool) -> Approx {
    let (chosen, other) = if first { (a, b) } else { (b, a) };
    let apart = (a.value - b.value).abs() > a.error + b.error;
    let error = if apart {
        chosen.error
    } else {
        chosen.error.max(other.error)
    };
    Approx::new(chosen.value, error)
}

/// How far the place on the face of a cube may move. `None` near to an edge, where another face may be taken and
/// filters differ.
fn cube(at: [Approx; 3], rounding: f64) -> Option<f64> {
    let by_size = |a: &&Approx, b: &&Approx| a.value.abs().total_cmp(&b.value.abs());
    let major = at.iter().max_by(by_size)?;
    let size = major.value.abs();
    let reach = size * (1.0 - CUBE_MARGIN);
    let inside = at
        .iter()
        .filter(|x| x.value.abs() + x.error + major.error <= reach);
    if size < 1.0e-3 || size <= 2.0 * major.error || inside.count() != 2 {
        return None;
    }
    let error = at.iter().map(|x| x.error + rounding * size).sum::<f64>();
    // The place is (x / size + 1) / 2; the divisor is off, too.
    Some((error + major.error) / (size - major.error))
}

//! What happens before and after an operation.

use super::scalar::saturate;
use crate::isa::{ResultModifier, SourceModifier};
use crate::policy::Model;

/// The value of an operand after its source modifier. The divide modifiers are steps of their own and change
/// nothing here.
#[inline(always)]
pub fn modify(modifier: SourceModifier, x: f32) -> f32 {
    match modifier {
        SourceModifier::None | SourceModifier::Dz | SourceModifier::Dw => x,
        SourceModifier::Negate => -x,
        SourceModifier::Bias => x - 0.5,
        SourceModifier::BiasNegate => -(x - 0.5),
        SourceModifier::Bx2 => 2.0 * (x - 0.5),
        SourceModifier::Bx2Negate => -(2.0 * (x - 0.5)),
        SourceModifier::Complement => 1.0 - x,
        SourceModifier::X2 => 2.0 * x,
        SourceModifier::X2Negate => -(2.0 * x),
    }
}

/// A number as the registers of a model hold it: clamped to the range and rounded to the nearest step, halves up. NaN,
/// which fixed-point numbers do not have, becomes 0; so does −0. Floats are as they are.
#[inline(always)]
pub fn held(model: Model, x: f32) -> f32 {
    let Some(steps) = model.steps() else { return x };
    if x.is_nan() {
        return 0.0;
    }
    let x = x.clamp(-model.most(), model.most());
    // What lies on a step stays there: the product is off by less than half a step.
    (x * steps + 0.5).floor() / steps
}

/// What an operation of a model reads of a register: the number as the model [holds](held) it, after its source modifier.
///
/// The combiners of the GeForce 3 clamp before they map: `1-x` is 1 − x of x in 0…1, `_bias` and `_bx2` take negative
/// numbers for 0.
#[inline(always)]
pub fn operand(model: Model, modifier: SourceModifier, x: f32) -> f32 {
    let x = held(model, x);
    let x = match (model, modifier) {
        (Model::Gf3, SourceModifier::Complement) => saturate(x),
        (
            Model::Gf3,
            SourceModifier::Bias
            | SourceModifier::BiasNegate
            | SourceModifier::Bx2
            | SourceModifier::Bx2Negate,
        ) if x < 0.0 => 0.0,
        _ => x,
    };
    modify(modifier, x)
}

/// A pixel shader constant as the shader sees it: clamped to −1…1, whether it was set or defined.
#[inline(always)]
pub fn constant(x: f32) -> f32 {
    if x.is_nan() { x } else { x.clamp(-1.0, 1.0) }
}

/// The address register after `mov a0.x`: the floor, within 32-bit integers; NaN gives 0.
#[inline(always)]
pub fn address(x: f32) -> f32 {
    // A cast saturates and takes NaN to 0.
    x.floor() as i32 as f32
}

/// What is done to a result before it is written: the shift, then the saturation, then denormal numbers become
/// zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finish {
    scale: f32,
    saturate: bool,
}

impl Finish {
    /// The finish of these result modifiers.
    #[inline(always)]
    pub fn new(result: ResultModifier) -> Self {
        let scale = match result.shift {
            3.. => 8.0,
            2 => 4.0,
            1 => 2.0,
            0 => 1.0,
            -1 => 0.5,
            -2 => 0.25,
            _ => 0.125,
        };
        Self {
            scale,
            saturate: result.saturate,
        }
    }

    /// The result as it is written.
    #[inline(always)]
    pub fn apply(self, x: f32) -> f32 {
        let x = x * self.scale;
        let x = if self.saturate { saturate(x) } else { x };
        flush(x)
    }
}

/// Denormal numbers as zero of the same sign, everything else as it is.
#[inline(always)]
pub fn flush(x: f32) -> f32 {
    // Written so that NaN and both zeros pass.
    if x.abs() < f32::MIN_POSITIVE {
        0.0_f32.copysign(x)
    } else {
        x
    }
}

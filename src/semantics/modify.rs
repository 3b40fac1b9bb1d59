//! What happens before and after an operation.

use super::scalar::saturate;
use crate::isa::{ResultModifier, SourceModifier};

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
        // Written so that NaN and both zeros pass.
        if x.abs() < f32::MIN_POSITIVE {
            0.0 * x
        } else {
            x
        }
    }
}

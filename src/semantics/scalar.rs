//! Operations on single components.

use crate::policy::OfZero;

/// s0 · s1; +0 if either factor is zero, even against infinity and NaN, or if the product is nearer to zero than to any
/// other number.
///
/// The GeForce 3 demanded it and the hardware of the next generation kept it.
#[inline(always)]
pub fn mul(a: f32, b: f32) -> f32 {
    // Of a zero the sum makes the positive one, everything else it leaves as it is.
    if a == 0.0 || b == 0.0 {
        0.0
    } else {
        a * b + 0.0
    }
}

/// How the operations below that have such a parameter make their products. A
/// [`ZeroProduct`](crate::policy::ZeroProduct) says which is meant.
pub trait Products {
    /// s0 · s1.
    fn product(a: f32, b: f32) -> f32;

    /// s0 · s1 where it is added to a sum that is not −0: the sign of a zero does not matter there.
    #[inline(always)]
    fn further(a: f32, b: f32) -> f32 {
        Self::product(a, b)
    }
}

/// Products of IEEE 754.
#[derive(Clone, Copy, Debug)]
pub struct Ieee;

/// Products with the rule of [`mul`].
#[derive(Clone, Copy, Debug)]
pub struct ZeroWins;

/// Products with the rule of [`mul`] of factors that are neither infinite nor NaN: the same numbers for less work.
#[derive(Clone, Copy, Debug)]
pub struct OfFinite;

impl Products for Ieee {
    #[inline(always)]
    fn product(a: f32, b: f32) -> f32 {
        a * b
    }
}

impl Products for ZeroWins {
    #[inline(always)]
    fn product(a: f32, b: f32) -> f32 {
        mul(a, b)
    }
}

impl Products for OfFinite {
    #[inline(always)]
    fn product(a: f32, b: f32) -> f32 {
        a * b + 0.0
    }

    #[inline(always)]
    fn further(a: f32, b: f32) -> f32 {
        a * b
    }
}

/// s0 · s1 + s2, rounded after the product.
#[inline(always)]
pub fn mad<P: Products>(a: f32, b: f32, c: f32) -> f32 {
    P::product(a, b) + c
}

/// s0 · s1 + (1 − s0) · s2: exact at both ends.
#[inline(always)]
pub fn lrp<P: Products>(a: f32, b: f32, c: f32) -> f32 {
    P::product(a, b) + P::further(1.0 - a, c)
}

/// s0 < s1 ? s0 : s1; s1 where either is NaN.
#[inline(always)]
pub fn min(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// s0 ≥ s1 ? s0 : s1; s1 where either is NaN.
#[inline(always)]
pub fn max(a: f32, b: f32) -> f32 {
    if a >= b { a } else { b }
}

/// s0 < s1 ? 1 : 0; 0 where either is NaN.
#[inline(always)]
pub fn slt(a: f32, b: f32) -> f32 {
    if a < b { 1.0 } else { 0.0 }
}

/// s0 ≥ s1 ? 1 : 0; 0 where either is NaN.
#[inline(always)]
pub fn sge(a: f32, b: f32) -> f32 {
    if a >= b { 1.0 } else { 0.0 }
}

/// s0 − ⌊s0⌋; NaN for infinities. A tiny negative number may give exactly 1.
#[inline(always)]
pub fn frc(a: f32) -> f32 {
    a - a.floor()
}

/// s0 > 0.5 ? s1 : s2. Exactly 0.5 and NaN select s2.
#[inline(always)]
pub fn cnd(a: f32, b: f32, c: f32) -> f32 {
    if a > 0.5 { b } else { c }
}

/// s0 ≥ 0 ? s1 : s2. −0 selects s1, NaN s2.
#[inline(always)]
pub fn cmp(a: f32, b: f32, c: f32) -> f32 {
    if a >= 0.0 { b } else { c }
}

/// Whether a number counts as zero: denormal numbers do.
#[inline(always)]
fn is_zero(a: f32) -> bool {
    a.abs() < f32::MIN_POSITIVE
}

/// 1 / s0; the number that the policy has for either zero.
#[inline(always)]
pub fn rcp(of_zero: OfZero, a: f32) -> f32 {
    if is_zero(a) { of_zero.value() } else { 1.0 / a }
}

/// 1 / √|s0|; the number that the policy has for zero.
#[inline(always)]
pub fn rsq(of_zero: OfZero, a: f32) -> f32 {
    if is_zero(a) {
        of_zero.value()
    } else {
        1.0 / a.abs().sqrt()
    }
}

/// 2 ^ s0.
#[inline(always)]
pub fn exp(a: f32) -> f32 {
    a.exp2()
}

/// log₂ |s0|; for zero minus the number that the policy has.
#[inline(always)]
pub fn log(of_zero: OfZero, a: f32) -> f32 {
    if is_zero(a) {
        -of_zero.value()
    } else {
        a.abs().log2()
    }
}

/// x clamped to 0…1, NaN to 0.
#[inline(always)]
pub fn saturate(x: f32) -> f32 {
    let x = if x > 0.0 { x } else { 0.0 };
    if x < 1.0 { x } else { 1.0 }
}

/// x / y as the coordinate modifiers and the depth instructions divide: 1 for a zero divisor.
#[inline(always)]
pub fn divide(x: f32, y: f32) -> f32 {
    if y == 0.0 { 1.0 } else { x / y }
}

/// The depth of `texdepth` and `texm3x2depth`: x / y, 1 for a zero divisor, clamped to 0…1.
#[inline(always)]
pub fn depth(x: f32, y: f32) -> f32 {
    saturate(divide(x, y))
}

/// The number drops its eight lowest bits: what `expp` and `logp` keep of a full result (at least ten bits are
/// promised).
#[inline(always)]
pub(super) fn partial_precision(x: f32) -> f32 {
    if x.is_nan() {
        x
    } else {
        f32::from_bits(x.to_bits() & 0xFFFF_FF00)
    }
}

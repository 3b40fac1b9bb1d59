//! Operations that look at several components at once.

use super::scalar::{Products, ZeroWins, exp, log, mul, partial_precision, saturate};
use crate::policy::{Model, OfZero};

/// s0.x·s1.x + s0.y·s1.y + s0.z·s1.z, summed from left to right.
#[inline(always)]
pub fn dp3<P: Products>(a: [f32; 3], b: [f32; 3]) -> f32 {
    let p = |i: usize| P::further(a[i], b[i]);
    P::product(a[0], b[0]) + p(1) + p(2)
}

/// [`dp3`] plus s0.w·s1.w.
#[inline(always)]
pub fn dp4<P: Products>(a: [f32; 4], b: [f32; 4]) -> f32 {
    let p = |i: usize| P::further(a[i], b[i]);
    P::product(a[0], b[0]) + p(1) + p(2) + p(3)
}

/// (1, s0.y·s1.y, s0.z, s1.w): from (–, d², d², –) and (–, 1/d, –, 1/d) the attenuation terms (1, d, d², 1/d).
#[inline(always)]
pub fn dst<P: Products>(a: [f32; 4], b: [f32; 4]) -> [f32; 4] {
    [1.0, P::product(a[1], b[1]), a[2], b[3]]
}

/// The bound of the exponent of [`lit`]: 128 − 1/256.
const LIT_POWER: f32 = 127.996_09;

/// Diffuse and specular coefficients: (1, x, y^w, 1) for positive x = N·L, y = N·H and the power w, clamped to
/// ±127.9961. y is 0 unless x is positive, z unless both are; a power that is NaN counts as 0.
#[inline(always)]
pub fn lit<P: Products>(a: [f32; 4]) -> [f32; 4] {
    let [x, y, _, w] = a;
    let power = if w.is_nan() {
        0.0
    } else {
        w.clamp(-LIT_POWER, LIT_POWER)
    };
    let lit = x > 0.0;
    // Of 0 the logarithm does not matter.
    let specular = exp(P::product(power, log(OfZero::Largest, y)));
    [
        1.0,
        if lit { x } else { 0.0 },
        if lit && y > 0.0 { specular } else { 0.0 },
        1.0,
    ]
}

/// The partial results of `expp`: (2^⌊x⌋, x − ⌊x⌋, 2^x in partial precision, 1).
#[inline(always)]
pub fn expp(x: f32) -> [f32; 4] {
    let whole = x.floor();
    let fraction = if x.is_infinite() { 0.0 } else { x - whole };
    [exp(whole), fraction, partial_precision(exp(x)), 1.0]
}

/// The partial results of `logp` for v = |x|: (exponent, mantissa in 1…2, log₂ v in partial precision, 1).
///
/// Zero (and denormal) v: (−n, 1, −n, 1), n the number that the policy has. Infinite v: (∞, 1, ∞, 1).
#[inline(always)]
pub fn logp(of_zero: OfZero, x: f32) -> [f32; 4] {
    let v = x.abs();
    if v.is_nan() {
        return [v, v, v, 1.0];
    }
    if v < f32::MIN_POSITIVE {
        let least = -of_zero.value();
        return [least, 1.0, least, 1.0];
    }
    if v.is_infinite() {
        return [v, 1.0, v, 1.0];
    }
    let bits = v.to_bits();
    let exponent = (bits >> 23) as i32 - 127;
    let mantissa = f32::from_bits((bits & 0x007F_FFFF) | 0x3F80_0000);
    [
        exponent as f32,
        mantissa,
        partial_precision(log(of_zero, v)),
        1.0,
    ]
}

/// The vector `e` mirrored at the normal `n`, which need not have unit length: 2·(n·e)/(n·n)·n − e; −e where n is
/// zero.
#[inline(always)]
pub fn reflect(n: [f32; 3], e: [f32; 3]) -> [f32; 3] {
    let square = dp3::<ZeroWins>(n, n);
    let scale = if square == 0.0 {
        0.0
    } else {
        2.0 * dp3::<ZeroWins>(n, e) / square
    };
    [
        mul(scale, n[0]) - e[0],
        mul(scale, n[1]) - e[1],
        mul(scale, n[2]) - e[2],
    ]
}

/// The states of one texture stage that bump mapping reads. The default is all zero, as in Direct3D 8.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BumpState {
    /// `D3DTSS_BUMPENVMAT00`, `01`, `10`, `11`: the row vector (du, dv) is multiplied from the left, so that `01`
    /// takes du into v′.
    pub matrix: [f32; 4],
    /// `D3DTSS_BUMPENVLSCALE`
    pub luminance_scale: f32,
    /// `D3DTSS_BUMPENVLOFFSET`
    pub luminance_offset: f32,
}

/// s0.xy + (du, dv) · bump matrix, with (du, dv) = s1.xy.
#[inline(always)]
pub fn bump(s0: [f32; 2], s1: [f32; 2], state: &BumpState) -> [f32; 2] {
    let [m00, m01, m10, m11] = state.matrix;
    [
        s0[0] + (mul(m00, s1[0]) + mul(m10, s1[1])),
        s0[1] + (mul(m01, s1[0]) + mul(m11, s1[1])),
    ]
}

/// s0 · (luminance · scale + offset): what `texbeml` does to every component of its sample. Combiners clamp the factor to
/// 0…1.
#[inline(always)]
pub fn luminance(model: Model, s0: f32, luminance: f32, state: &BumpState) -> f32 {
    let factor = mul(luminance, state.luminance_scale) + state.luminance_offset;
    match model {
        Model::Gf3 => mul(s0, saturate(factor)),
        Model::Float | Model::R200 => mul(s0, factor),
    }
}

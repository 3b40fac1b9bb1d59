//! The meanings against arithmetic done by hand from the formulas of the shader model.

use super::*;
use crate::isa::{ResultModifier, SourceModifier};
use crate::policy::{Model, OfZero};

const INF: f32 = f32::INFINITY;
const NAN: f32 = f32::NAN;

/// Same number, or both NaN; told apart from `==` so that −0 and +0 differ.
#[track_caller]
fn same(actual: f32, expected: f32) {
    let equal = actual.to_bits() == expected.to_bits() || (actual.is_nan() && expected.is_nan());
    assert!(equal, "{actual:?} instead of {expected:?}");
}

#[track_caller]
fn same4(actual: [f32; 4], expected: [f32; 4]) {
    for (a, e) in actual.into_iter().zip(expected) {
        same(a, e);
    }
}

#[test]
fn a_product_with_zero_is_zero() {
    for other in [0.0, -0.0, 3.0, INF, -INF, NAN, f32::MAX] {
        same(mul(0.0, other), 0.0);
        same(mul(-0.0, other), 0.0);
        same(mul(other, 0.0), 0.0);
    }
    same(mul(-2.0, 3.0), -6.0);
    same(mad::<ZeroWins>(0.0, INF, 5.0), 5.0);
}

#[test]
fn a_product_too_small_for_any_number_is_zero() {
    same(mul(-1e-30, 1e-30), 0.0);
    // A denormal one keeps its sign.
    same(mul(-1e-20, 1e-20), -1e-40);
}

/// Of finite factors both rules give the same, in every sum.
#[test]
fn finite_factors_need_no_rule_of_zero() {
    let factors = [0.0, -0.0, 1.0, -1.0, 0.3, 1e-30, -1e-30, 1e38, -1e38];
    for a in factors {
        for b in factors {
            same(OfFinite::product(a, b), mul(a, b));
            for c in factors {
                same(mad::<OfFinite>(a, b, c), mad::<ZeroWins>(a, b, c));
                same(lrp::<OfFinite>(a, b, c), lrp::<ZeroWins>(a, b, c));
                let (v, w) = ([a, b, c, 0.0], [b, c, -0.0, a]);
                same(dp4::<OfFinite>(v, w), dp4::<ZeroWins>(v, w));
            }
        }
    }
}

#[test]
fn products_of_ieee_know_nan() {
    same(Ieee::product(0.0, INF), NAN);
    same(Ieee::product(-0.0, 3.0), -0.0);
    same(mad::<Ieee>(0.0, INF, 5.0), NAN);
    same(lrp::<Ieee>(1.0, 2.0, INF), NAN);
    same(dp3::<Ieee>([INF, 2.0, 0.0], [0.0, 3.0, 1.0]), NAN);
    same(
        dp4::<Ieee>([1.0, 2.0, 3.0, 7.0], [4.0, 5.0, 6.0, 8.0]),
        88.0,
    );
    same4(
        dst::<Ieee>([0.0, INF, 2.0, 0.0], [0.0, 0.0, 0.0, 3.0]),
        [1.0, NAN, 2.0, 3.0],
    );
    // 2 ^ (0 · ∞)
    same(lit::<Ieee>([1.0, INF, 0.0, 0.0])[2], NAN);
}

#[test]
fn infinity_of_zero_where_it_is_asked_for() {
    same(rcp(OfZero::Infinity, -0.0), INF);
    same(rsq(OfZero::Infinity, 0.0), INF);
    same(log(OfZero::Infinity, 1e-40), -INF);
    same4(logp(OfZero::Infinity, 0.0), [-INF, 1.0, -INF, 1.0]);
    same(rcp(OfZero::Infinity, 2.0), 0.5);
}

#[test]
fn mad_rounds_the_product_first() {
    // (1 + 2^-12)² = 1 + 2^-11 + 2^-24: the last term is lost when the product is rounded, kept when it is fused.
    let a = 1.0 + 2f32.powi(-12);
    same(mad::<ZeroWins>(a, a, -1.0), 2f32.powi(-11));
}

#[test]
fn lrp_is_exact_at_both_ends() {
    same(lrp::<ZeroWins>(0.0, 1e30, 0.3), 0.3);
    same(lrp::<ZeroWins>(1.0, 0.3, 1e30), 0.3);
    // 0.25·8 + 0.75·4 = 5
    same(lrp::<ZeroWins>(0.25, 8.0, 4.0), 5.0);
    // Outside of 0…1 it extrapolates: 2·3 + (−1)·1 = 5
    same(lrp::<ZeroWins>(2.0, 3.0, 1.0), 5.0);
}

#[test]
fn comparisons_with_nan_are_false() {
    same(min(NAN, 2.0), 2.0);
    same(max(NAN, 2.0), 2.0);
    same(min(1.0, NAN), NAN);
    same(slt(NAN, 1.0), 0.0);
    same(sge(NAN, 1.0), 0.0);
    same(cmp(NAN, 1.0, 2.0), 2.0);
    same(cnd(NAN, 1.0, 2.0), 2.0);
}

#[test]
fn selections_at_their_threshold() {
    same(slt(1.0, 1.0), 0.0);
    same(sge(1.0, 1.0), 1.0);
    same(cnd(0.5, 1.0, 2.0), 2.0);
    same(cnd(0.500_000_1, 1.0, 2.0), 1.0);
    same(cmp(-0.0, 1.0, 2.0), 1.0);
    same(cmp(-1e-30, 1.0, 2.0), 2.0);
}

#[test]
fn frc_counts_from_below() {
    same(frc(-0.25), 0.75);
    same(frc(2.75), 0.75);
    same(frc(INF), NAN);
}

#[test]
fn reciprocals() {
    same(rcp(OfZero::Largest, 1.0), 1.0);
    same(rcp(OfZero::Largest, -4.0), -0.25);
    same(rcp(OfZero::Largest, 0.0), f32::MAX);
    same(rcp(OfZero::Largest, -0.0), f32::MAX);
    same(rcp(OfZero::Largest, -INF), -0.0);
    same(rsq(OfZero::Largest, -1.0), 1.0);
    same(rsq(OfZero::Largest, 16.0), 0.25);
    same(rsq(OfZero::Largest, 0.0), f32::MAX);
    same(rsq(OfZero::Largest, INF), 0.0);
    // What listings rely on: zero times the reciprocal of zero is zero.
    same(mul(0.0, rcp(OfZero::Largest, 0.0)), 0.0);
}

#[test]
fn exponentials_and_logarithms() {
    same(exp(3.0), 8.0);
    same(exp(-INF), 0.0);
    same(log(OfZero::Largest, -8.0), 3.0);
    same(log(OfZero::Largest, 0.0), -f32::MAX);
    // 2.5: 2^2, 0.5, 2^2.5 = 5.656854 without its eight lowest bits, 1
    let full = 2f32.powf(2.5).to_bits() & 0xFFFF_FF00;
    same4(expp(2.5), [4.0, 0.5, f32::from_bits(full), 1.0]);
    same4(
        expp(-0.25),
        [
            0.5,
            0.75,
            f32::from_bits(2f32.powf(-0.25).to_bits() & 0xFFFF_FF00),
            1.0,
        ],
    );
    same4(expp(INF), [INF, 0.0, INF, 1.0]);
    same4(expp(-INF), [0.0, 0.0, 0.0, 1.0]);
    same4(expp(NAN), [NAN, NAN, NAN, 1.0]);
    // −12 = −1.5 · 2^3; log2 12 = 3.5849625 without its eight lowest bits
    let full = 12f32.log2().to_bits() & 0xFFFF_FF00;
    same4(
        logp(OfZero::Largest, -12.0),
        [3.0, 1.5, f32::from_bits(full), 1.0],
    );
    same4(logp(OfZero::Largest, 0.0), [-f32::MAX, 1.0, -f32::MAX, 1.0]);
    same4(
        logp(OfZero::Largest, 1e-40),
        [-f32::MAX, 1.0, -f32::MAX, 1.0],
    );
    same4(logp(OfZero::Largest, -INF), [INF, 1.0, INF, 1.0]);
    same4(logp(OfZero::Largest, NAN), [NAN, NAN, NAN, 1.0]);
}

#[test]
fn dots_sum_from_the_left() {
    // 1·4 + 2·5 + 3·6 = 32, + 7·8 = 88
    same(dp3::<ZeroWins>([1.0, 2.0, 3.0], [4.0, 5.0, 6.0]), 32.0);
    same(
        dp4::<ZeroWins>([1.0, 2.0, 3.0, 7.0], [4.0, 5.0, 6.0, 8.0]),
        88.0,
    );
    // (1e8 − 1e8) + 1 = 1, while 1e8 + (−1e8 + 1) would be 0 in 32 bits.
    same(dp3::<ZeroWins>([1e8, -1e8, 1.0], [1.0, 1.0, 1.0]), 1.0);
    same(dp3::<ZeroWins>([INF, 2.0, 0.0], [0.0, 3.0, NAN]), 6.0);
}

#[test]
fn distance_vector() {
    // d = 4: (–, 16, 16, –) and (–, 1/4, –, 1/4) give (1, 4, 16, 1/4).
    same4(
        dst::<ZeroWins>([NAN, 16.0, 16.0, NAN], [NAN, 0.25, NAN, 0.25]),
        [1.0, 4.0, 16.0, 0.25],
    );
    same4(
        dst::<ZeroWins>([0.0, INF, INF, 0.0], [0.0, 0.0, 0.0, NAN]),
        [1.0, 0.0, INF, NAN],
    );
}

#[test]
fn lighting_coefficients() {
    same4(
        lit::<ZeroWins>([0.5, 0.25, 9.0, 2.0]),
        [1.0, 0.5, 0.0625, 1.0],
    );
    same4(
        lit::<ZeroWins>([-0.5, 0.25, 0.0, 2.0]),
        [1.0, 0.0, 0.0, 1.0],
    );
    same4(
        lit::<ZeroWins>([0.5, -0.25, 0.0, 2.0]),
        [1.0, 0.5, 0.0, 1.0],
    );
    same4(lit::<ZeroWins>([0.5, 0.25, 0.0, 0.0]), [1.0, 0.5, 1.0, 1.0]);
    same4(lit::<ZeroWins>([0.0, 0.0, 0.0, 0.0]), [1.0, 0.0, 0.0, 1.0]);
    same4(lit::<ZeroWins>([0.5, 0.25, 0.0, NAN]), [1.0, 0.5, 1.0, 1.0]);
    same4(lit::<ZeroWins>([INF, INF, 0.0, 3.0]), [1.0, INF, INF, 1.0]);
    same4(lit::<ZeroWins>([NAN, 1.0, 0.0, 1.0]), [1.0, 0.0, 0.0, 1.0]);
    // The power is clamped to 127.9961: 2^127.9961 is finite, 2^1000 is not.
    assert!(lit::<ZeroWins>([1.0, 2.0, 0.0, 1000.0])[2].is_finite());
    assert!(lit::<ZeroWins>([1.0, 2.0, 0.0, 1000.0])[2] > 3e38);
}

#[test]
fn bump_matrix_takes_du_to_v_through_m01() {
    // Stage matrix (−1, 0; 2, 0): u' = u − du + 2·dv, v' = v. With (du, dv) = (−15, 15)/127 at (0.5, 0.5):
    // 0.5 + 45/127 = 0.8543307.
    let state = BumpState {
        matrix: [-1.0, 0.0, 2.0, 0.0],
        ..Default::default()
    };
    let [u, v] = bump([0.5, 0.5], [-15.0 / 127.0, 15.0 / 127.0], &state);
    assert!((u - 0.854_330_7).abs() < 1e-6, "{u}");
    same(v, 0.5);
    // Only M01 set: v' = v + M01·du.
    let state = BumpState {
        matrix: [0.0, 4.0, 0.0, 0.0],
        ..Default::default()
    };
    assert_eq!(bump([1.0, 1.0], [0.25, 8.0], &state), [1.0, 2.0]);
}

#[test]
fn luminance_scales_and_offsets() {
    let state = BumpState {
        luminance_scale: 0.5,
        luminance_offset: 0.25,
        ..Default::default()
    };
    // 0.8 · (1 · 0.5 + 0.25) = 0.6
    assert!((luminance(Model::Float, 0.8, 1.0, &state) - 0.6).abs() < 1e-7);
    // A factor of 1 · 2 + 0.25 is clamped by the combiners: 0.8 · 1.
    let state = BumpState {
        luminance_scale: 2.0,
        ..state
    };
    same(luminance(Model::Gf3, 0.8, 1.0, &state), 0.8);
    assert!((luminance(Model::R200, 0.8, 1.0, &state) - 1.8).abs() < 1e-6);
}

#[test]
fn reflection_needs_no_unit_normal() {
    // N = (0, 0, 2), E = (1, 0, 1): 2·2/4·(0, 0, 2) − E = (−1, 0, 1)
    assert_eq!(reflect([0.0, 0.0, 2.0], [1.0, 0.0, 1.0]), [-1.0, 0.0, 1.0]);
    assert_eq!(reflect([0.0; 3], [1.0, 2.0, 3.0]), [-1.0, -2.0, -3.0]);
}

#[test]
fn divisions_of_coordinates() {
    same(divide(3.0, 2.0), 1.5);
    same(divide(3.0, 0.0), 1.0);
    same(divide(0.0, -0.0), 1.0);
}

/// The rows that native drivers gave for `texdepth`: (r, g) to depth.
#[test]
fn depth_is_clamped() {
    let rows = [
        (0.25, 0.5, 0.5),
        (-1.0, 0.1, 0.0),
        (-0.25, -0.5, 0.5),
        (1.0, -0.1, 0.0),
        (1.0, 0.5, 1.0),
        (0.5, 0.0, 1.0),
        (0.25, 1.0, 0.25),
    ];
    for (r, g, expected) in rows {
        same(depth(r, g), expected);
    }
}

#[test]
fn source_modifiers() {
    let rows = [
        (SourceModifier::None, 0.75),
        (SourceModifier::Negate, -0.75),
        (SourceModifier::Bias, 0.25),
        (SourceModifier::BiasNegate, -0.25),
        (SourceModifier::Bx2, 0.5),
        (SourceModifier::Bx2Negate, -0.5),
        (SourceModifier::Complement, 0.25),
        (SourceModifier::X2, 1.5),
        (SourceModifier::X2Negate, -1.5),
    ];
    for (modifier, expected) in rows {
        same(modify(modifier, 0.75), expected);
    }
    // The float model does not clamp first: 2·(−1 − 0.5) = −3.
    same(modify(SourceModifier::Bx2, -1.0), -3.0);
}

/// Expected numbers: the rows of the specification's table of profiles, by hand.
#[test]
fn models_clamp_and_round() {
    // 64.25/255 is nearest to 64/255, −64.25/255 to −64/255; halves go up.
    same(held(Model::Gf3, 64.25 / 255.0), 64.0 / 255.0);
    same(held(Model::Gf3, -64.25 / 255.0), -64.0 / 255.0);
    same(held(Model::Gf3, 0.5), 128.0 / 255.0);
    same(held(Model::Gf3, -0.5), -127.0 / 255.0);
    // The lowest code, −256/255, lies below −1.
    same(held(Model::Gf3, -1.0039), -1.0);
    same(held(Model::Gf3, INF), 1.0);
    same(held(Model::Gf3, NAN), 0.0);
    same(held(Model::Gf3, -0.0), 0.0);
    same(held(Model::R200, 9.0), 8.0);
    same(held(Model::R200, -INF), -8.0);
    // 0.3 · 4096 = 1228.8
    same(held(Model::R200, 0.3), 1229.0 / 4096.0);
    same(held(Model::R200, 1e-4), 0.0);
    for x in [0.3, -7.0, INF, -0.0] {
        same(held(Model::Float, x), x);
    }
}

#[test]
fn what_lies_on_a_step_stays_there() {
    for (model, steps, most) in [(Model::Gf3, 255, 255), (Model::R200, 4096, 8 * 4096)] {
        for code in -most..=most {
            let x = code as f32 / steps as f32;
            same(held(model, x), x);
        }
    }
}

/// The mappings of the combiners, by hand from their formulas.
#[test]
fn combiners_clamp_before_they_map() {
    use SourceModifier::*;
    for (modifier, x, expected) in [
        // 1 − max(0, −0.502) = 1; 1 − 51/255 = 0.8
        (Complement, -0.5, 1.0),
        (Complement, 0.2, 0.8),
        // 2 · max(0, −1) − 1 = −1, where floats have −3
        (Bx2, -1.0, -1.0),
        (Bx2Negate, -1.0, 1.0),
        (Bx2, 1.0, 1.0),
        (Bias, -1.0, -0.5),
        (BiasNegate, -1.0, 0.5),
        (Negate, 2.0, -1.0),
        (None, 2.0, 1.0),
    ] {
        same(operand(Model::Gf3, modifier, x), expected);
    }
    // The Radeon 8500 maps as it stands: 2 · (−1 − 0.5) = −3.
    same(operand(Model::R200, Bx2, -1.0), -3.0);
    same(operand(Model::R200, Complement, -0.5), 1.5);
    same(operand(Model::Float, Complement, -0.5), 1.5);
}

#[test]
fn constants_are_clamped() {
    same(constant(2.0), 1.0);
    same(constant(-7.0), -1.0);
    same(constant(0.9), 0.9);
}

/// The rows that a native driver gave for `mov a0.x`.
#[test]
fn the_address_register_takes_the_floor() {
    for (x, expected) in [
        (-2.4, -3.0),
        (-1.6, -2.0),
        (-0.4, -1.0),
        (0.4, 0.0),
        (1.6, 1.0),
        (2.4, 2.0),
    ] {
        same(address(x), expected);
    }
    same(address(NAN), 0.0);
    same(address(INF), i32::MAX as f32);
}

#[test]
fn results_are_shifted_then_saturated_then_flushed() {
    let finish = |shift, saturate| Finish::new(ResultModifier { shift, saturate });
    same(finish(1, false).apply(0.75), 1.5);
    same(finish(1, true).apply(0.75), 1.0);
    same(finish(3, false).apply(-0.5), -4.0);
    same(finish(-3, false).apply(4.0), 0.5);
    same(finish(-1, true).apply(1.5), 0.75);
    same(finish(0, true).apply(-3.0), 0.0);
    same(finish(0, true).apply(NAN), 0.0);
    same(finish(0, false).apply(NAN), NAN);
    same(finish(0, false).apply(1e-40), 0.0);
    same(finish(0, false).apply(-0.0), -0.0);
}

//! Listings under the hardware models. Expected numbers are worked out by hand from the specification's table of profiles
//! and its notes on combiners; k/255 and k/4096 are the steps of the models.

use super::{Bench, colour};
use crate::policy::Model;

/// What a listing leaves in `r0` under a model, with colours and coordinates and a texture of one colour on stage 0.
fn r0(model: Model, listing: &str) -> [f32; 4] {
    let texture = colour([0.5, -0.5, 3.0, 0.1]);
    let mut bench = Bench::new(&[&texture], &[[0.25, -2.0, 9.5, 1.0]]);
    bench.options.model = model;
    bench.r0(listing)
}

fn steps_255(codes: [i32; 4]) -> [f32; 4] {
    codes.map(|code| code as f32 / 255.0)
}

fn steps_4096(codes: [i32; 4]) -> [f32; 4] {
    codes.map(|code| code as f32 / 4096.0)
}

#[test]
fn combiners_round_what_they_read_and_what_they_write() {
    // 0.5 is read as 128/255; its square is 64.25/255, which is written as 64/255. 0.1 is 26/255 (25.5, halves up), its
    // square 2.65/255; −0.3 is −76/255 (−76.5 up), its square 22.65/255; 1 is 1.
    let square = "ps.1.1\ndef c0, 0.5, -0.3, 0.1, 1\nmul r0, c0, c0\n";
    assert_eq!(r0(Model::Gf3, square), steps_255([64, 23, 3, 255]));
    // 0.5² = 0.25 = 1024/4096; 0.3 is 1229/4096 (1228.8, negative: −1228.8 is −1229): 368.75/4096; 0.1 is 410/4096: 41.04/4096.
    assert_eq!(r0(Model::R200, square), steps_4096([1024, 369, 41, 4096]));
    assert_eq!(r0(Model::Float, square), [0.25, 0.3 * 0.3, 0.1 * 0.1, 1.0]);
}

#[test]
fn nothing_is_clamped_between_product_and_sum() {
    // 1 + 1 · 1 − …: (1 · 1 + 1) is clamped in the end, but 1 · 1 + 1 of −1 is not clamped before: the shift comes first.
    let shifted = "ps.1.1\ndef c0, 1, -1, 0.2, 0.6\nmad_d2 r0, c0, c0, c0\n";
    // (1+1)/2 = 1; (1−1)/2 = 0; 51 · 51/255 = 10.2: (10.2 + 51)/2 = 30.6; 153 · 153/255 = 91.8: (91.8 + 153)/2 = 122.4
    assert_eq!(r0(Model::Gf3, shifted), steps_255([255, 0, 31, 122]));
    // Two instructions clamp in between: 1 + 1 is 1, and half of it 128/255 (127.5 up).
    let apart = "ps.1.1\ndef c0, 1, 1, 1, 1\nadd r0, c0, c0\nmov_d2 r0, r0\n";
    assert_eq!(r0(Model::Gf3, apart), steps_255([128; 4]));
    assert_eq!(r0(Model::Float, apart), [1.0; 4]);
}

#[test]
fn shifts_come_before_the_range() {
    let listing = "ps.1.1\ndef c0, 0.6, -0.6, 0.2, 0\nmov_x2 r0, c0\n";
    // 153/255 · 2 is beyond the range on both sides.
    assert_eq!(r0(Model::Gf3, listing), steps_255([255, -255, 102, 0]));
    let listing = "ps.1.1\ndef c0, 0.6, -0.6, 0.2, 0\nmov_x2_sat r0, c0\n";
    assert_eq!(r0(Model::Gf3, listing), steps_255([255, 0, 102, 0]));
    // 0.6 is 2458/4096 (2457.6), −0.6 is −2458/4096 (−2457.6); times 8 that is 4.8.
    let listing = "ps.1.4\ndef c0, 0.6, -0.6, 1, 0\nmov_x8 r0, c0\n";
    assert_eq!(
        r0(Model::R200, listing),
        steps_4096([19664, -19664, 32768, 0])
    );
}

#[test]
fn the_radeon_reaches_to_eight() {
    // 8 + 1 stays 8; the combiners stay at 1.
    let listing = "ps.1.4\ndef c0, 1, -1, 1, -1\nmov_x8 r0, c0\nadd r0, r0, c0\n";
    assert_eq!(r0(Model::R200, listing), [8.0, -8.0, 8.0, -8.0]);
    assert_eq!(r0(Model::Gf3, listing), [1.0, -1.0, 1.0, -1.0]);
    assert_eq!(r0(Model::Float, listing), [9.0, -9.0, 9.0, -9.0]);
}

#[test]
fn source_modifiers_of_combiners_clamp_first() {
    // 1 − max(0, −0.4) = 1 and 2 · max(0, −0.4) − 1 = −1; 1 − 0.4 = 153/255 and 2 · 102/255 − 1 = −51/255
    let listing = |modified: &str| format!("ps.1.1\ndef c0, -0.4, 0.4, 1, 0\nmov r0, {modified}\n");
    let gf3 = |modified: &str| r0(Model::Gf3, &listing(modified));
    assert_eq!(gf3("1-c0"), steps_255([255, 153, 0, 255]));
    assert_eq!(gf3("c0_bx2"), steps_255([-255, -51, 255, -255]));
    assert_eq!(gf3("-c0_bx2"), steps_255([255, 51, -255, 255]));
    // 0 − 0.5 = −127.5/255, half up; 102/255 − 127.5/255 = −25.5/255, half up.
    assert_eq!(gf3("c0_bias"), steps_255([-127, -25, 128, -127]));
    // The Radeon maps as it stands: −0.4 is −1638/4096.
    let r200 = r0(Model::R200, &listing("1-c0"));
    assert_eq!(r200, steps_4096([5734, 2458, 0, 4096]));
}

#[test]
fn texture_instructions_of_the_geforce_hand_on_floats() {
    // The texel (0.5, −0.5, 3, 0.1) is sampled as it is; the combiners read 128/255, −127/255, 1 and 26/255.
    assert_eq!(
        r0(Model::Gf3, "ps.1.1\ntex t0\nmov r0, t0\n"),
        steps_255([128, -127, 255, 26])
    );
    // texdp3: 0.25 · 0.5 + 2 · 0.5 + 9.5 · 3 = 29.625, which only the combiners clamp. texcoord clamps by itself.
    let dot = "ps.1.2\ntex t0\ntexdp3 t1, t0\nmov r0, t1\n";
    let texture = colour([0.5, -0.5, 3.0, 0.1]);
    let at = [[0.0; 4], [0.25, -2.0, 9.5, 1.0]];
    for (model, t1, r0) in [
        (Model::Float, 29.625, 29.625),
        (Model::Gf3, 29.625, 1.0),
        (Model::R200, 8.0, 8.0),
    ] {
        let mut bench = Bench::new(&[&texture], &at);
        bench.options.model = model;
        let machine = bench.run(dot, &[]);
        let slot = crate::kernel::Slot::texture(1).unwrap();
        assert_eq!(machine.lane(slot, 0), [t1; 4], "{model}");
        assert_eq!(machine.lane(crate::kernel::Slot::R0, 0), [r0; 4], "{model}");
    }
}

#[test]
fn registers_of_the_radeon_hold_coordinates_in_their_range() {
    // (0.25, −2, 9.5): the third is beyond 8.
    let listing = "ps.1.4\ntexcrd r0.rgb, t0\nmov r0.a, r0.r\n";
    assert_eq!(r0(Model::R200, listing), [0.25, -2.0, 8.0, 0.25]);
    assert_eq!(r0(Model::Float, listing), [0.25, -2.0, 9.5, 0.25]);
}

#[test]
fn vertex_shaders_and_kills_know_no_model() {
    let mut bench = Bench::new(&[], &[]);
    bench.options.model = Model::Gf3;
    let listing = "vs.1.1\ndef c0, 3.3, -7, 0.001, 1\nmov oPos, c0\n";
    let machine = bench.run(listing, &[]);
    let position = machine.lane(crate::kernel::Slot::POSITION, 0);
    assert_eq!(position, [3.3, -7.0, 0.001, 1.0]);
    // −0.001 would be 0 on a step of 1/255; texkill sees it as it is.
    let mut bench = Bench::new(&[], &[[0.5, -0.001, 0.0, 1.0]]);
    bench.options.model = Model::Gf3;
    assert_eq!(
        bench.run("ps.1.1\ntexkill t0\nmov r0, c0\n", &[]).killed(),
        &[true]
    );
}

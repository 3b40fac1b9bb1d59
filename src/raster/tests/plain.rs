//! The short ways through the merger against the long one, over everything that a quad can be.

use super::super::merger::{DepthTiming, depth_stencil, merge};
use super::super::pixel::QUADS;
use super::super::plain::{depth_stencil_block, is_plain};
use super::super::record::{Nobody, Watcher};
use super::super::target::{BLOCK, TILE};
use super::*;
use crate::generate::Random;

/// Looks on and forgets. Where somebody watches, everything goes the long way.
struct Onlooker;

impl Watcher for Onlooker {
    fn note(&mut self, _: u8, _: impl FnOnce(&mut MergeRecord, usize)) {}
}

/// What colours and depths may be: out of range, no numbers, on steps of 8 bits and between them.
const NUMBERS: [f32; 14] = [
    f32::NAN,
    f32::INFINITY,
    f32::NEG_INFINITY,
    -1.0,
    -0.0,
    0.0,
    1e-40,
    0.5 / 255.0,
    0.25,
    0.5,
    0.75,
    254.5 / 255.0,
    1.0,
    1.5,
];

const FUNCS: [Compare; 8] = [
    Compare::Never,
    Compare::Less,
    Compare::Equal,
    Compare::LessEqual,
    Compare::Greater,
    Compare::NotEqual,
    Compare::GreaterEqual,
    Compare::Always,
];

fn number(random: &mut Random) -> f32 {
    match random.chance(50) {
        true => random.pick(&NUMBERS).unwrap(),
        false => random.below(1024) as f32 / 1023.0,
    }
}

/// Some states, mostly those of the short ways.
fn state(random: &mut Random) -> RenderState {
    RenderState {
        depth: DepthState {
            enable: random.chance(80),
            write: random.chance(70),
            func: random.pick(&FUNCS).unwrap(),
            ..DepthState::default()
        },
        alpha_test: AlphaTest {
            enable: random.chance(20),
            reference: random.below(256) as u8,
            func: random.pick(&FUNCS).unwrap(),
        },
        blend: BlendState {
            enable: random.chance(20),
            source: BlendFactor::SrcAlpha,
            destination: BlendFactor::InvSrcAlpha,
            op: BlendOp::Add,
        },
        color_mask: match random.chance(70) {
            true => ColorMask::from_bits(0xf),
            false => ColorMask::from_bits(random.below(16) as u8),
        },
        fog: FogState {
            enable: random.chance(20),
            ..FogState::default()
        },
        stencil: StencilState {
            enable: random.chance(10),
            func: random.pick(&FUNCS).unwrap(),
            pass: StencilOp::Incr,
            ..StencilState::default()
        },
        ..RenderState::default()
    }
}

/// Quads all over a tile, no two in one place, and what a shader made of them.
fn quads(random: &mut Random) -> (PixelBatch, PixelResult) {
    let (mut batch, mut shaded) = (PixelBatch::empty(), PixelResult::new());
    batch.quads = 1 + random.below(QUADS as u32) as usize;
    let first = random.below(TILE * TILE / 4);
    for quad in 0..batch.quads {
        // 7 and the number of quads in a tile, a power of two, have no common divisor.
        let at = (first + 7 * quad as u32) % (TILE * TILE / 4);
        let [x, y] = [at % (TILE / 2) * 2, at / (TILE / 2) * 2].map(|v| v as i32);
        let live = match random.chance(50) {
            true => 0xf,
            false => random.below(16) as u8,
        };
        // Depths are in 0 to 1 when they come here.
        let z = std::array::from_fn(|_| unit(number(random)));
        batch.place(quad, x, y, live, &z);
    }
    if random.chance(40) {
        let [x, y] = [(); 2].map(|()| (random.below(TILE / BLOCK) * BLOCK) as i32);
        let z = std::array::from_fn(|_| unit(number(random)));
        batch.place_block(x, y, [true; LANES], &z);
    }
    for values in shaded.color.iter_mut().chain([&mut shaded.depth]) {
        values.fill_with(|| number(random));
    }
    batch.fog.fill_with(|| unit(number(random)));
    (batch, shaded)
}

/// Tests and merges as a tile is painted; how many pixels were written, and whether the colours could go the short way.
fn put(
    target: &mut Target,
    state: &RenderState,
    timing: DepthTiming,
    (mut batch, shaded): (PixelBatch, &PixelResult),
    watcher: &mut impl Watcher,
) -> (u64, bool) {
    let format = target.format();
    let tile = target.tiles_mut()[0].settled();
    if timing == DepthTiming::Early && batch.block && !watcher.watches() {
        let (x, y, z) = (batch.x[0], batch.y[0], batch.z);
        let passed = depth_stencil_block(tile, state, (x, y), &z);
        batch.place_block(x, y, passed, &z);
    } else if timing == DepthTiming::Early {
        for quad in 0..batch.quads {
            let (lane, z) = (4 * quad, batch.z.as_chunks().0[quad]);
            let place = (batch.x[lane], batch.y[lane]);
            let live = (0..4).fold(0, |mask, i| mask | u8::from(batch.live[lane + i]) << i);
            let passed = depth_stencil(tile, state, place, &z, live, watcher);
            batch.place(quad, place.0, place.1, passed, &z);
        }
    }
    let plain = is_plain(tile, format, state, timing, shaded);
    let written = merge(tile, format, state, timing, &batch, shaded, watcher);
    (written, plain)
}

/// Everything that a target of one tile holds; depths by their bits.
fn held(target: &Target) -> Vec<([u8; 4], u32, u8)> {
    let pixels = (0..TILE * TILE).map(|at| (at % TILE, at / TILE));
    let held = |(x, y)| {
        let depth = target.depth(x, y).unwrap();
        let (color, stencil) = (target.color(x, y), target.stencil(x, y));
        (color.unwrap(), depth.to_bits(), stencil.unwrap())
    };
    pixels.map(held).collect()
}

#[test]
fn short_ways_lead_where_the_long_one_does() {
    let mut random = Random::new(1);
    let (mut short, mut failed) = (0, 0);
    for round in 0..150 {
        let format = random.pick(&[
            ColorFormat::A8R8G8B8,
            ColorFormat::A8R8G8B8,
            ColorFormat::X8R8G8B8,
        ]);
        let mut both = [(); 2].map(|()| Target::new(TILE, TILE, format.unwrap()).unwrap());
        let holds = [round as u8, 90, 180, 255];
        for target in &mut both {
            target.clear(Some(holds), Some(0.5), Some(3));
        }
        // Later batches find what the ones before them left.
        for _ in 0..4 {
            let state = state(&mut random);
            let replaced = random.chance(20);
            let timing = DepthTiming::of(&state, replaced, random.chance(20));
            let (batch, mut shaded) = quads(&mut random);
            if timing != DepthTiming::Early {
                shaded.killed.fill_with(|| random.chance(20));
            }
            let [one, other] = &mut both;
            let watched = put(one, &state, timing, (batch.clone(), &shaded), &mut Onlooker);
            let alone = put(other, &state, timing, (batch, &shaded), &mut Nobody);
            assert_eq!(alone, watched, "{state:?}");
            short += u32::from(alone.1);
            failed += u32::from(alone.0 == 0);
        }
        let [one, other] = &both;
        assert!(held(other) == held(one), "round {round}");
    }
    // Of both kinds there were many, and not all of them wrote nothing.
    assert!(
        short > 60 && short < 540 && failed < 300,
        "{short} {failed}"
    );
}

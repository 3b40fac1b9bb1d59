//! The short ways through the output merger, for whole quads of which nobody wants to know more than the pixels.

use super::merger::{DepthTiming, to_byte};
use super::pixel::{LANES, PixelBatch, PixelResult};
use super::state::{Compare, RenderState};
use super::target::{ColorFormat, Tile, place_in_tile};
use super::unit;

/// The number of a quad in its tile.
#[inline(always)]
pub(super) fn quad_in_tile(x: i32, y: i32) -> usize {
    // Coordinates of quads are never negative, being within the scissor.
    place_in_tile(x as u32, y as u32) / 4
}

/// Bit i for each of four that holds.
#[inline(always)]
fn bits(holds: [bool; 4]) -> u8 {
    (0..4).fold(0, |mask, i| mask | u8::from(holds[i]) << i)
}

/// Which of four depths pass the test.
#[inline(always)]
pub(super) fn depths_pass(func: Compare, new: &[f32; 4], stored: &[f32; 4]) -> u8 {
    // The function is asked once for all four.
    let each =
        |passes: fn(&f32, &f32) -> bool| bits(std::array::from_fn(|i| passes(&new[i], &stored[i])));
    match func {
        Compare::Never => 0,
        Compare::Less => each(f32::lt),
        Compare::Equal => each(|a, b| a == b),
        Compare::LessEqual => each(f32::le),
        Compare::Greater => each(f32::gt),
        Compare::NotEqual => each(|a, b| a != b),
        Compare::GreaterEqual => each(f32::ge),
        Compare::Always => 0xf,
    }
}

/// The new ones of four where the mask has them, elsewhere the old ones.
#[inline(always)]
fn replaced(mask: u8, new: &[u32; 4], old: &[u32; 4]) -> [u32; 4] {
    // All ones or zeros, so that the four are one operation: a choice for each goes through memory.
    const TAKEN: [[u32; 4]; 16] = {
        let mut all = [[0; 4]; 16];
        let mut mask = 0;
        while mask < 16 {
            let mut i = 0;
            while i < 4 {
                all[mask][i] = if mask >> i & 1 == 1 { u32::MAX } else { 0 };
                i += 1;
            }
            mask += 1;
        }
        all
    };
    let taken = &TAKEN[usize::from(mask & 0xf)];
    std::array::from_fn(|i| new[i] & taken[i] | old[i] & !taken[i])
}

/// The depth test of a quad without stencil, nobody watching.
#[inline(always)]
pub(super) fn depth_alone(
    tile: &mut Tile,
    state: &RenderState,
    (x, y): (i32, i32),
    z: &[f32; 4],
    mask: u8,
) -> u8 {
    let Some(stored) = tile.depth.as_chunks_mut().0.get_mut(quad_in_tile(x, y)) else {
        return 0;
    };
    let passed = depths_pass(state.depth.func, z, stored) & mask;
    if state.depth.write {
        let (new, old) = (z.map(f32::to_bits), stored.map(f32::to_bits));
        *stored = replaced(passed, &new, &old).map(f32::from_bits);
    }
    passed
}

/// Whether colours go into the target as they are: nothing takes a pixel out behind the shader, nothing changes its colour,
/// every channel is written.
#[inline(always)]
pub(super) fn is_plain(
    tile: &Tile,
    format: ColorFormat,
    state: &RenderState,
    timing: DepthTiming,
    shaded: &PixelResult,
) -> bool {
    timing == DepthTiming::Early
        && !state.alpha_test.enable
        && !state.fog.enable
        && !state.blend.enable
        && (0..4).all(|channel| state.color_mask.writes(channel))
        && format == ColorFormat::A8R8G8B8
        && tile.more.is_empty()
        && shaded.shows_killed.is_empty()
}

/// As [`merge`] where [`is_plain`] holds.
#[inline(always)]
pub(super) fn put_plain(tile: &mut Tile, batch: &PixelBatch, shaded: &PixelResult) -> u64 {
    let [r, g, b, a] = &shaded.color;
    let mut pixels = [0_u32; LANES];
    for (lane, pixel) in pixels.iter_mut().enumerate() {
        let byte = |channel: &[f32; LANES]| u32::from(to_byte(unit(channel[lane])));
        *pixel = byte(r) | byte(g) << 8 | byte(b) << 16 | byte(a) << 24;
    }
    let mut written = 0;
    let quads = pixels
        .as_chunks::<4>()
        .0
        .iter()
        .zip(batch.live.as_chunks::<4>().0);
    for (quad, (colors, live)) in quads.enumerate().take(batch.quads) {
        let at = quad_in_tile(batch.x[4 * quad], batch.y[4 * quad]);
        let Some(stored) = tile.color.as_chunks_mut::<4>().0.get_mut(at) else {
            continue;
        };
        // Inside of a shape, where nearly all quads are, nothing is read.
        let (live, mut new) = (bits(*live), *colors);
        if live != 0xf {
            new = replaced(live, colors, &stored.map(u32::from_le_bytes));
        }
        *stored = new.map(u32::to_le_bytes);
        written += u64::from(live.count_ones());
    }
    written
}

//! The short ways through the output merger, for whole quads and blocks of which nobody wants to know more than the pixels.

use super::merger::{DepthTiming, depth_stencil, to_byte};
use super::pixel::{LANES, PixelBatch, PixelResult, lanes};
use super::record::Nobody;
use super::state::{Compare, RenderState};
use super::target::{ColorFormat, IN_BLOCK, Tile, place_in_tile};
use super::unit;

/// The number of what begins at a pixel in its tile: of a quad for `N` = 4, of a block for `N` = 64.
#[inline(always)]
pub(super) fn number_in_tile<const N: usize>(x: i32, y: i32) -> usize {
    // Coordinates of quads are never negative, being within the scissor.
    place_in_tile(x as u32, y as u32) / N
}

/// Bit i for each of four that holds.
#[inline(always)]
pub(super) fn bits(holds: &[bool; 4]) -> u8 {
    (0..4).fold(0, |mask, i| mask | u8::from(holds[i]) << i)
}

/// Which pixels of a quad, or of a block, pass a test.
#[inline(always)]
fn each<const N: usize>(
    new: &[f32; N],
    stored: &[f32; N],
    passes: impl Fn(f32, f32) -> bool,
) -> [bool; N] {
    let mut passed = [false; N];
    for ((passed, new), stored) in passed.iter_mut().zip(new).zip(stored) {
        *passed = passes(*new, *stored);
    }
    passed
}

/// Which depths of a quad, or of a block, pass the test.
#[inline(always)]
fn depths_pass<const N: usize>(func: Compare, new: &[f32; N], stored: &[f32; N]) -> [bool; N] {
    // The function is asked once for all of them.
    match func {
        Compare::Never => [false; N],
        Compare::Less => each(new, stored, |a, b| a < b),
        Compare::Equal => each(new, stored, |a, b| a == b),
        Compare::LessEqual => each(new, stored, |a, b| a <= b),
        Compare::Greater => each(new, stored, |a, b| a > b),
        Compare::NotEqual => each(new, stored, |a, b| a != b),
        Compare::GreaterEqual => each(new, stored, |a, b| a >= b),
        Compare::Always => [true; N],
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
    let stored = (tile.depth.as_chunks_mut().0).get_mut(number_in_tile::<4>(x, y));
    let Some(stored) = stored else {
        return 0;
    };
    let passed = bits(&depths_pass(state.depth.func, z, stored)) & mask;
    if state.depth.write {
        let (new, old) = (z.map(f32::to_bits), stored.map(f32::to_bits));
        *stored = replaced(passed, &new, &old).map(f32::from_bits);
    }
    passed
}

/// The same of a block. Returns which of its pixels pass.
#[inline(always)]
fn depth_alone_block(
    tile: &mut Tile,
    state: &RenderState,
    (x, y): (i32, i32),
    z: &[f32; LANES],
) -> [bool; LANES] {
    let stored = (tile.depth.as_chunks_mut().0).get_mut(number_in_tile::<LANES>(x, y));
    let Some(stored) = stored else {
        return [false; LANES];
    };
    let passed = depths_pass(state.depth.func, z, stored);
    if state.depth.write && passed == [true; LANES] {
        *stored = *z;
    } else if state.depth.write {
        for ((stored, new), passed) in stored.iter_mut().zip(z).zip(passed) {
            // Of bits, as in a quad: a choice becomes a jump for each pixel.
            let taken = u32::from(passed).wrapping_neg();
            *stored = f32::from_bits(new.to_bits() & taken | stored.to_bits() & !taken);
        }
    }
    passed
}

/// The depth and stencil test of a block, with their writes, nobody watching. Returns which of its pixels pass.
#[inline(always)]
pub(super) fn depth_stencil_block(
    tile: &mut Tile,
    state: &RenderState,
    (x, y): (i32, i32),
    z: &[f32; LANES],
) -> [bool; LANES] {
    if !state.stencil.enable {
        return match state.depth.enable {
            true => depth_alone_block(tile, state, (x, y), z),
            false => [true; LANES],
        };
    }
    let mut passed = [false; LANES];
    let quads = passed.as_chunks_mut().0.iter_mut().zip(z.as_chunks().0);
    for (quad, (passed, z)) in quads.enumerate() {
        let at = (x + IN_BLOCK[0][4 * quad], y + IN_BLOCK[1][4 * quad]);
        *passed = lanes(depth_stencil(tile, state, at, z, 0xf, &mut Nobody));
    }
    passed
}

/// Which of the pixels of a quad, or of a block, pass the depth test as things stand. Writes nothing.
#[inline(always)]
pub(super) fn depth_only<const N: usize>(
    tile: &Tile,
    state: &RenderState,
    (x, y): (i32, i32),
    z: &[f32; N],
) -> [bool; N] {
    if !state.depth.enable {
        return [true; N];
    }
    let stored = tile.depth.as_chunks().0.get(number_in_tile::<N>(x, y));
    stored.map_or([false; N], |stored| {
        depths_pass(state.depth.func, z, stored)
    })
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
    if batch.block
        && batch.live == [true; LANES]
        && let at = number_in_tile::<LANES>(batch.x[0], batch.y[0])
        && let Some(stored) = tile.color.as_chunks_mut::<LANES>().0.get_mut(at)
    {
        for (stored, pixel) in stored.iter_mut().zip(pixels) {
            *stored = pixel.to_le_bytes();
        }
        return LANES as u64;
    }
    let mut written = 0;
    let quads = pixels
        .as_chunks::<4>()
        .0
        .iter()
        .zip(batch.live.as_chunks::<4>().0);
    for (quad, (colors, live)) in quads.enumerate().take(batch.quads) {
        let at = number_in_tile::<4>(batch.x[4 * quad], batch.y[4 * quad]);
        let Some(stored) = tile.color.as_chunks_mut::<4>().0.get_mut(at) else {
            continue;
        };
        // Inside of a shape, where nearly all quads are, nothing is read.
        let (live, mut new) = (bits(live), *colors);
        if live != 0xf {
            new = replaced(live, colors, &stored.map(u32::from_le_bytes));
        }
        *stored = new.map(u32::to_le_bytes);
        written += u64::from(live.count_ones());
    }
    written
}

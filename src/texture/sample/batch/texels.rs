//! Reading texels and blending them.

use super::Places;
use super::axis::Grid;
use crate::texture::storage::{FloatStore, PackedStore, Store};

/// Texels in memory.
pub(super) trait Source<const N: usize>: Copy {
    /// What was read of a level.
    type Corners: Corners<N>;

    /// Reads the texels of all lanes. What lies outside of the texture reads as anything.
    fn corners<'r>(self, grid: &Grid<N>, read: &'r mut Read<N>) -> &'r Self::Corners;
}

/// Memory for the texels of a level.
#[derive(Clone, Debug)]
pub(super) struct Read<const N: usize> {
    /// The upper and the lower ones, two by two.
    pairs: [[u64; N]; 2],
    packed: PackedCorners<N>,
    floats: FloatCorners<N>,
}

impl<const N: usize> Default for Read<N> {
    fn default() -> Self {
        Self {
            pairs: [[0; N]; 2],
            packed: PackedCorners([[0; N]; 4]),
            floats: FloatCorners([[[0.0; N]; 4]; 4]),
        }
    }
}

/// The four texels of each lane.
pub(super) trait Corners<const N: usize> {
    /// What a channel must be divided by.
    const SCALE: f32;
    /// Whether all numbers are finite, so that a share of 0 leaves nothing of a texel.
    const FINITE: bool;

    /// A channel of one of the four.
    fn channel(&self, corner: usize, channel: usize, lane: usize) -> f32;
}

/// Words, corner by corner.
#[derive(Clone, Debug)]
pub(super) struct PackedCorners<const N: usize>([[u32; N]; 4]);

impl<const N: usize> Corners<N> for PackedCorners<N> {
    const SCALE: f32 = PackedStore::SCALE;
    const FINITE: bool = true;

    #[inline(always)]
    fn channel(&self, corner: usize, channel: usize, lane: usize) -> f32 {
        // A signed number, which is what processors convert.
        (self.0[corner][lane] >> (8 * channel) & 0xff) as i32 as f32
    }
}

/// The word at a place, and 0 where there is none.
#[inline(always)]
fn word(words: &[u32], at: u32) -> u64 {
    words.get(at as usize).map_or(0, |word| u64::from(*word))
}

/// A word and the next one, in one number.
#[inline(always)]
fn pair(words: &[u32], at: u32) -> u64 {
    let at = at as usize;
    // One comparison.
    match words.get(at..at + 2) {
        Some([low, high]) => u64::from(*low) | u64::from(*high) << 32,
        _ => 0,
    }
}

/// Both halves of each number. Two loops: the compiler runs out of registers in one.
#[inline(always)]
fn split<const N: usize>(pairs: &[u64; N], low: &mut [u32; N], high: &mut [u32; N]) {
    for (low, pair) in low.iter_mut().zip(pairs) {
        *low = *pair as u32;
    }
    for (high, pair) in high.iter_mut().zip(pairs) {
        *high = (*pair >> 32) as u32;
    }
}

impl<const N: usize> Source<N> for &[u32] {
    type Corners = PackedCorners<N>;

    #[inline(always)]
    fn corners<'r>(self, grid: &Grid<N>, read: &'r mut Read<N>) -> &'r PackedCorners<N> {
        let [upper_left, upper_right, lower_left, lower_right] = &grid.corners;
        let [upper, lower] = &mut read.pairs;
        if grid.point {
            for l in 0..N {
                upper[l] = word(self, upper_left[l]);
            }
        } else if grid.adjacent {
            for l in 0..N {
                upper[l] = pair(self, upper_left[l]);
                lower[l] = pair(self, lower_left[l]);
            }
        } else {
            for l in 0..N {
                upper[l] = word(self, upper_left[l]) | word(self, upper_right[l]) << 32;
                lower[l] = word(self, lower_left[l]) | word(self, lower_right[l]) << 32;
            }
        }
        let [upper_left, upper_right, lower_left, lower_right] = &mut read.packed.0;
        split(upper, upper_left, upper_right);
        split(lower, lower_left, lower_right);
        &read.packed
    }
}

/// Floats, corner by corner, channel by channel.
#[derive(Clone, Debug)]
pub(super) struct FloatCorners<const N: usize>([[[f32; N]; 4]; 4]);

impl<const N: usize> Corners<N> for FloatCorners<N> {
    const SCALE: f32 = FloatStore::SCALE;
    const FINITE: bool = false;

    #[inline(always)]
    fn channel(&self, corner: usize, channel: usize, lane: usize) -> f32 {
        self.0[corner][channel][lane]
    }
}

impl<const N: usize> Source<N> for &[[f32; 4]] {
    type Corners = FloatCorners<N>;

    #[inline(always)]
    fn corners<'r>(self, grid: &Grid<N>, read: &'r mut Read<N>) -> &'r FloatCorners<N> {
        let corners = &mut read.floats.0;
        let count = if grid.point { 1 } else { 4 };
        for (corner, places) in corners.iter_mut().zip(&grid.corners).take(count) {
            for (l, place) in places.iter().enumerate() {
                let texel = self.get(*place as usize).copied().unwrap_or_default();
                for (channel, value) in corner.iter_mut().zip(texel) {
                    channel[l] = value;
                }
            }
        }
        &read.floats
    }
}

/// One channel of one level, not yet divided.
#[inline(always)]
fn filtered<const N: usize, C: Corners<N>>(
    corners: &C,
    grid: &Grid<N>,
    channel: usize,
    lane: usize,
) -> f32 {
    let (a, b) = (
        corners.channel(0, channel, lane),
        corners.channel(1, channel, lane),
    );
    let (c, d) = (
        corners.channel(2, channel, lane),
        corners.channel(3, channel, lane),
    );
    let (x, y) = (grid.x[lane], grid.y[lane]);
    let upper = a + x * (b - a);
    let lower = c + x * (d - c);
    let value = upper + y * (lower - upper);
    // A share of nothing of what is not finite would be NaN.
    if !C::FINITE && x == 0.0 && y == 0.0 {
        a
    } else {
        value
    }
}

#[inline(always)]
fn level<const N: usize, C: Corners<N>>(
    corners: &C,
    grid: &Grid<N>,
    channel: usize,
    mut put: impl FnMut(usize, f32),
) {
    if grid.point {
        for l in 0..N {
            put(l, corners.channel(0, channel, l));
        }
    } else {
        for l in 0..N {
            put(l, filtered(corners, grid, channel, l));
        }
    }
}

/// The wanted channels of all lanes that are not odd.
#[inline(always)]
pub(super) fn read<const N: usize, S: Source<N>>(
    texels: S,
    places: &Places<N>,
    memory: &mut Read<N>,
    channels: [bool; 4],
    out: &mut [[f32; N]; 4],
) {
    let wanted = |channel: &usize| channels[*channel];
    let corners = texels.corners(&places.first, memory);
    for channel in (0..4).filter(wanted) {
        let out = &mut out[channel];
        if places.blended {
            level(corners, &places.first, channel, |l, value| out[l] = value);
        } else {
            level(corners, &places.first, channel, |l, value| {
                out[l] = value / S::Corners::SCALE
            });
        }
    }
    if !places.blended {
        return;
    }
    let corners = texels.corners(&places.second, memory);
    for channel in (0..4).filter(wanted) {
        let out = &mut out[channel];
        level(corners, &places.second, channel, |l, second| {
            let (first, blend) = (out[l], places.blend[l]);
            let value = first + blend * (second - first);
            let value = if !S::Corners::FINITE && blend == 0.0 {
                first
            } else {
                value
            };
            out[l] = value / S::Corners::SCALE;
        });
    }
}

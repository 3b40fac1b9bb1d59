//! Many lanes at a time: the steps of sampling as loops over rows, which compilers turn into vector instructions.
//!
//! Levels, texels and weights are found first ([`Places`]) and texels read afterwards ([`texels`]), so that samples with the
//! same coordinates share the first part. The arithmetic is that of one lane, operation by operation; what differs is how
//! whole numbers are found ([`floor`], [`int`]), which is exact in the range that is asked for. Lanes beyond it, and
//! everything that is seldom, are marked as [odd](Places::odd) and done quad by quad the other way.
//!
//! Files: `axis` (which texels of an axis), `levels` (which mip levels), `faces` (of cubes), `texels` (reading and blending).

mod axis;
mod faces;
mod levels;
#[cfg(test)]
mod tests;
mod texels;

use super::super::storage::Texels;
use super::{Choice, Sampler, Texture, TextureKind, UNBOUND, sample_quad};
use crate::simd::{Simd, Task};
use crate::texture::{AddressMode, Weights};
use axis::{Addressing, Axis, Grid};
use faces::Met;
use levels::{Detailed, LevelRows};
use texels::Read;

/// Texel coordinates up to here, exclusive, keep their halves: what [`floor`] and [`int`] can do.
const FAR: f32 = 4_194_304.0;

/// Largest whole number not above x, for x within ±[`FAR`]; of anything else any number.
#[inline(always)]
fn floor(x: f32) -> f32 {
    // Numbers of this size have no bits left below 1, so that the sum is rounded to a whole number.
    const SHIFT: f32 = 12_582_912.0;
    let nearest = (x + SHIFT) - SHIFT;
    nearest - if nearest > x { 1.0 } else { 0.0 }
}

/// The lowest 22 bits of a whole number within ±[`FAR`], as two's complement has them, and others above these.
#[inline(always)]
fn low_bits(x: f32) -> u32 {
    // 3 · 2²², of which a unit is the last bit and these bits are clear.
    (x + 12_582_912.0).to_bits()
}

/// A whole number from 0 to 2²³ − 1 as an integer; of anything else any integer.
#[inline(always)]
fn int(x: f32) -> u32 {
    (x + 8_388_608.0).to_bits() & 0x007f_ffff
}

/// Whether a bit is set in any lane.
#[inline(always)]
fn any_lane<const N: usize>(lanes: &[u32; N]) -> bool {
    let mut any = 0;
    for lane in lanes {
        any |= lane;
    }
    any != 0
}

/// Where N lanes read a texture: all of a sample that does not depend on what the texels hold.
///
/// It holds for every texture and sampler of which [`share_places`] says so.
#[derive(Clone, Debug)]
pub struct Places<const N: usize> {
    /// Not 0 in lanes whose quad has to be sampled by itself.
    odd: [u32; N],
    any_odd: bool,
    first: Grid<N>,
    /// Of meaning if [`Self::blended`].
    second: Grid<N>,
    /// Share of the second level.
    blend: [f32; N],
    blended: bool,
}

impl<const N: usize> Default for Places<N> {
    fn default() -> Self {
        Self {
            odd: [0; N],
            any_odd: false,
            first: Grid::default(),
            second: Grid::default(),
            blend: [0.0; N],
            blended: false,
        }
    }
}

/// Whether two textures with their samplers are read at the same places wherever coordinates are the same.
pub fn share_places(a: (&Texture, &Sampler), b: (&Texture, &Sampler)) -> bool {
    let sampler = Sampler {
        border: a.1.border,
        ..*b.1
    };
    a.0.kind == b.0.kind && a.0.levels == b.0.levels && *a.1 == sampler
}

/// What samples need while they are taken, used by one after the other.
#[derive(Clone, Debug)]
pub struct Memory<const N: usize> {
    met: Met<N>,
    detailed: Detailed<N>,
    rows: LevelRows<N>,
    across: Axis<N>,
    down: Axis<N>,
    read: Read<N>,
}

impl<const N: usize> Default for Memory<N> {
    fn default() -> Self {
        Self {
            met: Met::default(),
            detailed: Detailed::default(),
            rows: LevelRows::default(),
            across: Axis::default(),
            down: Axis::default(),
            read: Read::default(),
        }
    }
}

impl<const N: usize> Places<N> {
    #[inline(always)]
    fn find(
        &mut self,
        memory: &mut Memory<N>,
        texture: &Texture,
        sampler: &Sampler,
        coords: [&[f32; N]; 3],
    ) {
        self.odd = [0; N];
        let fixed = Choice::is_fixed(texture, sampler);
        let Memory {
            met,
            detailed,
            rows,
            across,
            down,
            ..
        } = memory;
        let ([mut u, mut v, _], mut modes) = (coords, [AddressMode::Clamp; 2]);
        match texture.kind {
            TextureKind::Texture2D => {
                met.face = [0; N];
                modes = [sampler.address[0], sampler.address[1]];
            }
            TextureKind::Cube => {
                faces::find(met, coords, &mut self.odd, !fixed);
                (u, v) = (&met.u, &met.v);
                if sampler.seamless {
                    // A texel beyond an edge is one of another face, which is for the other way to find.
                    modes = [AddressMode::Border; 2];
                }
            }
            TextureKind::Volume => {
                self.odd = [1; N];
                self.any_odd = true;
                return;
            }
        }
        match fixed {
            true => detailed.fixed(sampler),
            false => detailed.find(texture, sampler, u, v, &mut self.odd),
        }
        let size = texture.size();
        let addressing = |axis: usize| Addressing {
            half: detailed.half,
            coarse: sampler.weights == Weights::EightBits,
            mode: modes[axis],
            power_of_two: size[axis].is_power_of_two(),
        };
        let addressing = [addressing(0), addressing(1)];
        self.blended = detailed.is_blended();
        let grids = [
            (&detailed.first, &mut self.first),
            (&detailed.second, &mut self.second),
        ];
        let count = if self.blended { 2 } else { 1 };
        for (level, grid) in grids.into_iter().take(count) {
            rows.find(&texture.levels, level, &met.face);
            let [along_u, along_v] = addressing;
            across.find(u, &rows.width, along_u, &mut grid.x, &mut self.odd);
            down.find(v, &rows.height, along_v, &mut grid.y, &mut self.odd);
            grid.join(rows, across, down, detailed.is_point());
        }
        if self.blended {
            self.blend = detailed.blend;
        }
        self.any_odd = any_lane(&self.odd);
    }
}

/// A sample of `N` lanes, quads as in [`sample_quads`], as something that is compiled for each set of instructions.
pub struct Sample<'a, const N: usize> {
    /// The texture.
    pub texture: &'a Texture,
    /// How it is read.
    pub sampler: &'a Sampler,
    /// u, v, w.
    pub coords: [&'a [f32; N]; 3],
    /// Lanes from here on may receive anything.
    pub lanes: usize,
    /// Where the lanes are, or memory for it.
    pub places: &'a mut Places<N>,
    /// Memory for everything else.
    pub memory: &'a mut Memory<N>,
    /// Whether the places have been found already, by a sample at the same coordinates of which [`share_places`] holds.
    pub found: bool,
    /// The channels that are wanted; the others are left as they are.
    pub channels: [bool; 4],
    /// Receives r, g, b, a.
    pub out: &'a mut [[f32; N]; 4],
}

impl<const N: usize> Task for Sample<'_, N> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self {
            texture,
            sampler,
            coords,
            ..
        } = self;
        if !self.found {
            self.places.find(self.memory, texture, sampler, coords);
        }
        let places = &*self.places;
        let read = &mut self.memory.read;
        if texture.kind != TextureKind::Volume {
            match &texture.texels {
                Texels::Packed(words) => {
                    texels::read(words.as_slice(), places, read, self.channels, self.out)
                }
                Texels::Float(texels) => {
                    texels::read(texels.as_slice(), places, read, self.channels, self.out)
                }
            }
        }
        if places.any_odd {
            sample_odd(texture, sampler, coords, places, self.lanes, self.out);
        }
    }
}

/// Samples the quads that have odd lanes, each by itself.
#[inline(never)]
fn sample_odd<const N: usize>(
    texture: &Texture,
    sampler: &Sampler,
    coords: [&[f32; N]; 3],
    places: &Places<N>,
    lanes: usize,
    out: &mut [[f32; N]; 4],
) {
    let [u, v, w] = coords.map(|row| row.as_chunks::<4>().0);
    let odd = places.odd.as_chunks::<4>().0;
    for (quad, odd) in odd.iter().enumerate().take(lanes.div_ceil(4)) {
        if *odd == [0; 4] {
            continue;
        }
        let texels = sample_quad(
            texture,
            sampler,
            &std::array::from_fn(|i| [u[quad][i], v[quad][i], w[quad][i]]),
        );
        for (channel, out) in out.iter_mut().enumerate() {
            out.as_chunks_mut::<4>().0[quad] = texels.map(|texel| texel[channel]);
        }
    }
}

/// Samples a texture for N lanes at once.
///
/// `coords` are u, v, w (2D ignores w; a cube takes a direction of any length); `out` receives r, g, b, a.
/// Each four lanes from 4q on are the pixels (x, y), (x+1, y), (x, y+1), (x+1, y+1) of a quad, from which
/// their detail follows ([`details`](super::details)). Lanes that do not fill a quad (N = 1) have no derivatives: they are
/// magnified and read the largest level that the sampler allows.
/// Without a texture every lane reads (0, 0, 0, 1), as Direct3D 8 does for an empty stage.
/// Any coordinate is allowed: NaN counts as 0, infinities as the largest finite number.
pub fn sample_quads<const N: usize>(
    texture: Option<&Texture>,
    sampler: &Sampler,
    coords: &[[f32; N]; 3],
    out: &mut [[f32; N]; 4],
) {
    let Some(texture) = texture else {
        *out = UNBOUND.map(|value| [value; N]);
        return;
    };
    let alone = N - N % 4;
    if N > 4 {
        Simd::chosen().run(Sample {
            texture,
            sampler,
            coords: coords.each_ref(),
            lanes: alone,
            places: &mut Places::default(),
            memory: &mut Memory::default(),
            found: false,
            channels: [true; 4],
            out,
        });
    } else if N == 4 {
        let quad = std::array::from_fn(|lane| [coords[0][lane], coords[1][lane], coords[2][lane]]);
        let texels = sample_quad(texture, sampler, &quad);
        for (lane, texel) in texels.iter().enumerate() {
            for (channel, value) in out.iter_mut().zip(texel) {
                channel[lane] = *value;
            }
        }
    }
    for lane in alone..N {
        let coord = [coords[0][lane], coords[1][lane], coords[2][lane]];
        let texel = super::sample_at(Some(texture), sampler, coord, super::Detail::NONE);
        for (channel, value) in out.iter_mut().zip(texel) {
            channel[lane] = value;
        }
    }
}

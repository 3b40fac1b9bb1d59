//! Which mip levels the lanes read, and by which filter.

use super::{floor, int};
use crate::texture::sample::detail::lambda;
use crate::texture::sample::share;
use crate::texture::storage::Level;
use crate::texture::{Filter, MipFilter, Sampler, Texture, Weights};
use glam::{Vec4, Vec4Swizzles};

/// What [`Choice`](crate::texture::sample::Choice) says of one lane, of all.
#[derive(Clone, Debug)]
pub(super) struct Detailed<const N: usize> {
    /// 0.5 if the filter is linear, else 0.
    pub(super) half: f32,
    /// The numbers of the levels.
    pub(super) first: [f32; N],
    pub(super) second: [f32; N],
    /// The share of the second level.
    pub(super) blend: [f32; N],
    lambda: [f32; N],
}

impl<const N: usize> Default for Detailed<N> {
    fn default() -> Self {
        Self {
            half: 0.0,
            first: [0.0; N],
            second: [0.0; N],
            blend: [0.0; N],
            lambda: [0.0; N],
        }
    }
}

/// How far before a coordinate the middle of the first texel may lie.
fn half(filter: Filter) -> f32 {
    if filter.is_linear() { 0.5 } else { 0.0 }
}

impl<const N: usize> Detailed<N> {
    /// Where λ makes no difference.
    #[inline(always)]
    pub(super) fn fixed(&mut self, sampler: &Sampler) {
        self.half = half(sampler.mag);
        self.first = [0.0; N];
        self.blend = [0.0; N];
    }

    /// From the coordinates of quads on one plane each. Lanes with several probes are marked as odd.
    #[inline(always)]
    pub(super) fn find(
        &mut self,
        texture: &Texture,
        sampler: &Sampler,
        u: &[f32; N],
        v: &[f32; N],
        odd: &mut [u32; N],
    ) {
        let size = texture.levels.first().map_or([1; 3], |level| level.size);
        self.half = half(sampler.mag);
        let Self {
            first,
            second,
            blend,
            lambda: lambdas,
            ..
        } = self;
        squared_lengths(u, v, [size[0] as f32, size[1] as f32], lambdas);
        for l in &mut *lambdas {
            *l = lambda(*l, sampler.lod_bias);
        }
        if sampler.most_probes() > 1 {
            for (odd, lambda) in odd.iter_mut().zip(&*lambdas) {
                *odd |= u32::from(*lambda > 0.0);
            }
        }
        let (minified, magnified) = (half(sampler.min), half(sampler.mag));
        if minified != magnified {
            // A batch has one filter. Where it is magnified and minified, the lanes of the other one are odd.
            let mut any_minified = 0;
            for lambda in &*lambdas {
                any_minified |= u32::from(*lambda > 0.0);
            }
            if any_minified != 0 {
                self.half = minified;
                for (odd, lambda) in odd.iter_mut().zip(&*lambdas) {
                    *odd |= u32::from(*lambda > 0.0) ^ 1;
                }
            }
        }
        let last = texture.levels.len().saturating_sub(1);
        let largest = last.min(sampler.max_mip_level as usize) as f32;
        let last = last as f32;
        // NaN, which only a bias brings about, is the largest level.
        for level in &mut *lambdas {
            *level = if *level > largest { *level } else { largest };
            *level = if *level > last { last } else { *level };
        }
        let levels = lambdas;
        match sampler.mip {
            MipFilter::None => {
                *first = [0.0; N];
                *blend = [0.0; N];
            }
            MipFilter::Point => {
                for (first, level) in first.iter_mut().zip(levels) {
                    let nearest = floor(*level + 0.5);
                    *first = if nearest > last { last } else { nearest };
                }
                *blend = [0.0; N];
            }
            MipFilter::Linear => {
                for (l, level) in levels.iter().enumerate() {
                    let whole = floor(*level);
                    let next = whole + 1.0;
                    first[l] = whole;
                    second[l] = if next > last { last } else { next };
                    blend[l] = level - whole;
                }
                if sampler.weights == Weights::EightBits {
                    for blend in blend {
                        *blend = share::<true>(*blend);
                    }
                }
            }
        }
    }

    /// Whether no lane has a linear filter.
    #[inline(always)]
    pub(super) fn is_point(&self) -> bool {
        self.half == 0.0
    }

    /// Whether any lane reads two levels.
    #[inline(always)]
    pub(super) fn is_blended(&self) -> bool {
        any_bits(&self.blend)
    }
}

/// Whether a number is not 0 in any lane.
#[inline(always)]
fn any_bits<const N: usize>(lanes: &[f32; N]) -> bool {
    let mut any = 0;
    for lane in lanes {
        any |= lane.to_bits();
    }
    any != 0
}

/// The square of the longer derivative of each lane, in texels of a level of a size.
#[inline(always)]
fn squared_lengths<const N: usize>(
    u: &[f32; N],
    v: &[f32; N],
    size: [f32; 2],
    squared: &mut [f32; N],
) {
    let quads = u.as_chunks::<4>().0.iter().zip(v.as_chunks::<4>().0);
    for (squared, (u, v)) in squared.as_chunks_mut::<4>().0.iter_mut().zip(quads) {
        let (u, v) = (Vec4::from(*u), Vec4::from(*v));
        // To the other pixel of the row, and to the other one of the column.
        let row = [u.yyww() - u.xxzz(), v.yyww() - v.xxzz()];
        let column = [u.zwzw() - u.xyxy(), v.zwzw() - v.xyxy()];
        let (row, column) = (length(row, size), length(column, size));
        for (i, squared) in squared.iter_mut().enumerate() {
            *squared = if row[i] >= column[i] {
                row[i]
            } else {
                column[i]
            };
        }
    }
}

/// The squares of lengths in texels.
#[inline(always)]
fn length([u, v]: [Vec4; 2], size: [f32; 2]) -> [f32; 4] {
    let (u, v) = (u * size[0], v * size[1]);
    (u * u + v * v).to_array()
}

/// What is needed to know of the level of each lane.
#[derive(Clone, Debug)]
pub(super) struct LevelRows<const N: usize> {
    pub(super) width: [f32; N],
    pub(super) height: [f32; N],
    /// Texels from one row to the next.
    pub(super) stride: [u32; N],
    /// Where the face of the lane begins.
    pub(super) base: [u32; N],
}

impl<const N: usize> Default for LevelRows<N> {
    fn default() -> Self {
        Self {
            width: [0.0; N],
            height: [0.0; N],
            stride: [0; N],
            base: [0; N],
        }
    }
}

impl<const N: usize> LevelRows<N> {
    /// Looks up levels by their numbers.
    #[inline(always)]
    pub(super) fn find(&mut self, levels: &[Level], number: &[f32; N], face: &[u32; N]) {
        let bits = number[0].to_bits();
        let mut different = 0;
        for number in number {
            different |= number.to_bits() ^ bits;
        }
        // A texture has fewer than 2³² texels.
        if different == 0 {
            if let Some(level) = levels.get(int(number[0]) as usize) {
                let [width, height, _] = level.size;
                self.width = [width as f32; N];
                self.height = [height as f32; N];
                self.stride = [width; N];
                let (offset, face_len) = (level.offset as u32, level.face_len as u32);
                for (base, face) in self.base.iter_mut().zip(face) {
                    *base = offset.wrapping_add(face.wrapping_mul(face_len));
                }
            }
            return;
        }
        for l in 0..N {
            if let Some(level) = levels.get(int(number[l]) as usize) {
                let [width, height, _] = level.size;
                self.width[l] = width as f32;
                self.height[l] = height as f32;
                self.stride[l] = width;
                let start = face[l].wrapping_mul(level.face_len as u32);
                self.base[l] = (level.offset as u32).wrapping_add(start);
            }
        }
    }
}

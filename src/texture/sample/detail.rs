//! How much of a texture a pixel covers: the level of detail, and the probes of an anisotropic filter.

use crate::texture::cube::{direction_to_face, project_onto};
use crate::texture::{Sampler, Texture, TextureKind};

use super::finite;

/// What the derivatives of the coordinates say about one pixel.
///
/// A pixel covers a strip of the texture, as long as the longer of its two derivatives and as wide as the shorter one. An
/// anisotropic filter divides the strip into N equal parts and reads a probe in the middle of each; N is the ratio of the
/// two, rounded up, and at most `D3DTSS_MAXANISOTROPY`. Each probe is as long as an Nth of the strip, so that the level
/// is chosen by λ − log2 N. All other filters have one probe.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Detail {
    pub(super) lambda: f32,
    pub(super) probes: u8,
    /// The longer derivative in u, v, w, which the probes lie along; on a cube in u and v of the face.
    pub(super) along: [f32; 3],
}

impl Detail {
    /// λ of a pixel that has no neighbours: magnified, however large the bias.
    pub(super) const NONE: Self = Self {
        lambda: f32::NEG_INFINITY,
        probes: 1,
        along: [0.0; 3],
    };

    /// λ: log2 of the length of the longer derivative in texels of level 0, and the bias. Above 0 the texture is minified.
    pub fn lambda(&self) -> f32 {
        self.lambda
    }

    /// How many probes are read, 1 to 16.
    pub fn probes(&self) -> u32 {
        self.probes.into()
    }

    /// What chooses the mip levels: λ of one probe.
    pub(super) fn level(&self) -> f32 {
        match self.probes {
            0 | 1 => self.lambda,
            probes => self.lambda - log2(f32::from(probes)),
        }
    }

    /// Where the probes lie, as shares of [`Self::along`].
    pub(super) fn places(self) -> impl Iterator<Item = f32> {
        let count = f32::from(self.probes);
        (0..self.probes).map(move |probe| (f32::from(probe) + 0.5) / count - 0.5)
    }

    fn new(sampler: &Sampler, x: Derivative, y: Derivative) -> Self {
        let (longer, shorter) = if x.squared >= y.squared {
            (x, y)
        } else {
            (y, x)
        };
        let lambda = lambda(longer.squared, sampler.lod_bias);
        let most = sampler.most_probes();
        if most == 1 || lambda.is_nan() || lambda <= 0.0 {
            return Self {
                lambda,
                ..Self::NONE
            };
        }
        // Coordinates are not exact: what is hardly above a whole number is meant to be that number. The cast takes
        // infinity to the largest number and NaN, of two infinite derivatives, to 0.
        let ratio = (longer.squared / shorter.squared).sqrt();
        Self {
            lambda,
            probes: ((ratio - RATIO_SLACK).ceil() as u8).clamp(1, most),
            along: longer.step,
        }
    }
}

/// λ of a derivative whose length is the root of `squared`.
#[inline(always)]
pub(super) fn lambda(squared: f32, bias: f32) -> f32 {
    // log2 of a root is half the log2.
    0.5 * log2(squared) + bias
}

/// log2 of what is not negative, within 2⁻²³ of the true one for exponents near 0 and within half a unit of the last place beside
/// that; exact for powers of two, −∞ for zero, below −127 for numbers that are not normal.
///
/// It has no branch and calls nothing, so that loops over lanes become vector instructions.
#[inline(always)]
pub(super) fn log2(x: f32) -> f32 {
    const SIGNIFICAND: u32 = 0x007f_ffff;
    // log2(1 + t) / t for 1 + t from the root of a half to the root of two: a polynomial fitted so that the error of the
    // logarithm is least everywhere.
    const FIT: [f32; 9] = [
        1.442_694_9,
        -0.721_347_4,
        0.480_923_38,
        -0.360_706_12,
        0.287_627_34,
        -0.238_785_33,
        0.217_869_86,
        -0.208_847_3,
        0.122_501_35,
    ];
    let bits = x.to_bits();
    // Exponents change at the root of two, so that t lies around 0.
    let shifted = bits.wrapping_sub(0x3f35_04f3);
    let exponent = (shifted as i32) >> 23;
    let t = f32::from_bits((shifted & SIGNIFICAND).wrapping_add(0x3f35_04f3)) - 1.0;
    let fit = FIT.iter().rev().fold(0.0, |sum, factor| sum * t + factor);
    let found = exponent as f32 + t * fit;
    let found = if x == 0.0 { f32::NEG_INFINITY } else { found };
    if x == f32::INFINITY { x } else { found }
}

/// How far above a whole number the ratio of two derivatives may lie without another probe.
pub(crate) const RATIO_SLACK: f32 = 1.0 / 1024.0;

/// A λ that does not come from derivatives, bias included, of a pixel as long as it is wide.
impl From<f32> for Detail {
    fn from(lambda: f32) -> Self {
        Self {
            lambda,
            ..Self::NONE
        }
    }
}

/// The detail of each pixel of a 2×2 quad.
///
/// A pixel's derivatives are the steps to the other pixel of its row (lanes 0 and 1, 2 and 3) and to the other one of its
/// column. On a cube both are projected onto the face of the pixel itself, so that a quad across an edge has the derivative
/// of one plane; a pixel behind that plane counts as very far.
/// λ is −∞ where the coordinate does not change, and never NaN unless the bias is.
pub fn details(texture: &Texture, sampler: &Sampler, quad: &[[f32; 3]; 4]) -> [Detail; 4] {
    match texture.kind {
        TextureKind::Texture2D => {
            let flat = quad.map(|coord| [finite(coord[0]), finite(coord[1]), 0.0]);
            on_one_plane(texture, sampler, &flat)
        }
        TextureKind::Volume => on_one_plane(texture, sampler, &quad.map(|c| c.map(finite))),
        TextureKind::Cube => {
            let on = |face: usize| {
                let flat = quad.map(|direction| {
                    let [u, v] = project_onto(face, direction);
                    [u, v, 0.0]
                });
                on_one_plane(texture, sampler, &flat)
            };
            let faces = quad.map(|direction| direction_to_face(direction).0);
            if faces == [faces[0]; 4] {
                return on(faces[0]);
            }
            std::array::from_fn(|lane| on(faces[lane])[lane])
        }
    }
}

/// A step to a neighbour.
#[derive(Clone, Copy)]
struct Derivative {
    step: [f32; 3],
    /// The square of its length in texels of level 0.
    squared: f32,
}

/// [`details`] of coordinates that can be subtracted.
fn on_one_plane(texture: &Texture, sampler: &Sampler, quad: &[[f32; 3]; 4]) -> [Detail; 4] {
    let size = texture.levels[0].size.map(|edge| edge as f32);
    let derivative = |from: usize, to: usize| {
        let step: [f32; 3] = std::array::from_fn(|axis| quad[to][axis] - quad[from][axis]);
        let mut squared = 0.0;
        for axis in 0..3 {
            let texels = step[axis] * size[axis];
            squared += texels * texels;
        }
        Derivative { step, squared }
    };
    let rows = [derivative(0, 1), derivative(2, 3)];
    let columns = [derivative(0, 2), derivative(1, 3)];
    std::array::from_fn(|lane| Detail::new(sampler, rows[lane / 2], columns[lane % 2]))
}

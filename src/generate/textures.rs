//! The textures that generated shaders sample.

use crate::exec;
use crate::policy::Model;
use crate::texture::{
    Filter, Format, Sampler, Signed, Texture, TextureError, TextureKind, Weights,
};

/// One texture of every kind, unsigned and signed, 8 bits a channel.
///
/// They rise and fall gently and repeat without a seam, so that a small difference of coordinates is a small
/// difference of colour, and no two channels, axes and faces look the same, so that a wrong one shows.
#[derive(Clone, Debug)]
pub struct Textures {
    textures: Vec<(Texture, f64)>,
    weights: Weights,
}

/// Edge of the flat texture and of the faces of the cube, in texels.
const EDGE: u32 = 8;
/// Edge of the volume.
const DEPTH: u32 = 4;

const KINDS: [TextureKind; 3] = [
    TextureKind::Texture2D,
    TextureKind::Cube,
    TextureKind::Volume,
];

impl Textures {
    /// Makes the textures, as [`Model::Float`] samples them.
    ///
    /// # Errors
    /// None that can happen: the sizes fit the kinds.
    pub fn new() -> Result<Self, TextureError> {
        Self::with_model(Model::Float)
    }

    /// Makes the textures, as a hardware model decodes and filters them.
    ///
    /// # Errors
    /// As [`Textures::new`].
    pub fn with_model(model: Model) -> Result<Self, TextureError> {
        let codes = match model.has_lopsided_texels() {
            true => Signed::Lopsided,
            false => Signed::Symmetric,
        };
        let mut textures = Vec::with_capacity(2 * KINDS.len());
        for kind in KINDS {
            for signed in [false, true] {
                let texture = make(kind, signed, codes)?;
                let slope = slope(&texture);
                textures.push((texture, slope));
            }
        }
        let weights = match model.has_coarse_filters() {
            true => Weights::EightBits,
            false => Weights::Full,
        };
        Ok(Self { textures, weights })
    }

    fn row(&self, kind: TextureKind, signed: bool) -> Option<&(Texture, f64)> {
        let at = KINDS.iter().position(|k| *k == kind)?;
        self.textures.get(2 * at + usize::from(signed))
    }

    /// The texture of this kind; signed ones hold −1…1 (`Q8W8V8U8`), the others 0…1 (`Rgba8`).
    pub fn get(&self, kind: TextureKind, signed: bool) -> Option<&Texture> {
        self.row(kind, signed).map(|(texture, _)| texture)
    }

    /// How much a channel can change when one coordinate changes by 1 (of a cube: when the place on a face does).
    pub(super) fn slope(&self, kind: TextureKind, signed: bool) -> f64 {
        self.row(kind, signed).map_or(0.0, |(_, slope)| *slope)
    }

    /// How far apart coordinates are that make neighbouring weights; 0 where weights have all bits of a float.
    pub(super) fn weight_step(&self, kind: TextureKind) -> f64 {
        let edge = match kind {
            TextureKind::Volume => DEPTH,
            TextureKind::Texture2D | TextureKind::Cube => EDGE,
        };
        match self.weights {
            Weights::EightBits => 1.0 / (256.0 * f64::from(edge)),
            Weights::Full => 0.0,
        }
    }

    /// How they are sampled: linear filters without mip levels, wrapped. Point filters and mip levels would make
    /// steps where executors are allowed to differ.
    pub fn sampler(&self) -> Sampler {
        Sampler {
            mag: Filter::Linear,
            min: Filter::Linear,
            weights: self.weights,
            ..Sampler::default()
        }
    }

    /// A stage of the interpreter that samples the texture of this stage.
    pub(super) fn stage(&self, stage: &super::Stage) -> exec::Stage<'_> {
        exec::Stage {
            texture: self.get(stage.kind, stage.signed),
            sampler: self.sampler(),
            bump: stage.bump,
        }
    }
}

/// The nearest that a direction may come to the edge of a face, as a part of the largest component: half a texel,
/// where filters inside of the face and across its edge part.
pub(super) const CUBE_MARGIN: f64 = 1.0 / EDGE as f64;

fn make(kind: TextureKind, signed: bool, codes: Signed) -> Result<Texture, TextureError> {
    let size = match kind {
        TextureKind::Volume => [DEPTH; 3],
        TextureKind::Texture2D | TextureKind::Cube => [EDGE, EDGE, 1],
    };
    let faces = match kind {
        TextureKind::Cube => 6,
        TextureKind::Texture2D | TextureKind::Volume => 1,
    };
    let mut texels = Vec::new();
    for face in 0..faces {
        for z in 0..size[2] {
            for y in 0..size[1] {
                for x in 0..size[0] {
                    let at = [x, y, z];
                    texels.push(std::array::from_fn(|c| {
                        texel(at, size, face, c as u32, signed)
                    }));
                }
            }
        }
    }
    let format = if signed {
        Format::Q8W8V8U8
    } else {
        Format::Rgba8
    };
    Texture::from_texels_signed(kind, format, size, &[texels], codes)
}

/// A wave along each axis, out of step from channel to channel; each axis counts differently.
fn texel(at: [u32; 3], size: [u32; 3], face: u32, channel: u32, signed: bool) -> f32 {
    const SHARE: [f32; 3] = [0.4, 0.25, 0.15];
    let mut sum = 0.05 + 0.03 * face as f32;
    for (axis, share) in SHARE.into_iter().enumerate() {
        let n = size[axis];
        let place = (at[axis] + channel * (axis as u32 + 1)) % n;
        let half = (n / 2).max(1);
        sum += share * place.min(n - place) as f32 / half as f32;
    }
    if signed { 2.0 * sum - 1.0 } else { sum }
}

/// The steepest rise between neighbouring texels, the other side included, in the units of coordinates.
fn slope(texture: &Texture) -> f64 {
    let size = texture.size();
    let mut steepest = 0.0_f64;
    for face in 0..texture.face_count() {
        for z in 0..size[2] {
            for y in 0..size[1] {
                for x in 0..size[0] {
                    let Some(here) = texture.texel(face, 0, x, y, z) else {
                        continue;
                    };
                    for axis in 0..3 {
                        let mut next = [x, y, z];
                        next[axis] = (next[axis] + 1) % size[axis];
                        let [x, y, z] = next;
                        let Some(there) = texture.texel(face, 0, x, y, z) else {
                            continue;
                        };
                        for (a, b) in here.into_iter().zip(there) {
                            let rise = f64::from(a - b).abs() * f64::from(size[axis]);
                            steepest = steepest.max(rise);
                        }
                    }
                }
            }
        }
    }
    steepest
}

//! What a sample was made of, for debuggers: the same steps as sampling, told instead of blended.

use super::{Choice, Position, taps};
use crate::texture::{Filter, Sampler, Texture, Weights};

/// One texel of a sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tap {
    /// Face 0 to 5 of a cube, else 0.
    pub face: usize,
    /// Mip level.
    pub level: u32,
    /// Column, row and slice; none where the border colour stands for the texel.
    pub texel: Option<[u32; 3]>,
    /// Share of the texel in the sample, above 0; all shares add up to 1.
    pub weight: f32,
}

/// What one sample was made of.
#[derive(Debug, Clone, PartialEq)]
pub struct Footprint {
    /// The filter within a level that λ chose.
    pub filter: Filter,
    /// The face of a cube that the direction meets, else 0.
    pub face: usize,
    /// u, v, w in the texture or in the face, before the address mode.
    pub uvw: [f32; 3],
    /// The mip levels read and their shares.
    pub levels: Vec<(u32, f32)>,
    /// The texels read, larger level first; the same texel may be listed twice where an address mode repeats it.
    pub taps: Vec<Tap>,
}

/// Which texels [`super::sample_at`] with the same arguments reads, and how much of each. For debuggers.
pub fn footprint(texture: &Texture, sampler: &Sampler, coord: [f32; 3], lod: f32) -> Footprint {
    match sampler.weights {
        Weights::Full => of::<false>(texture, sampler, coord, lod),
        Weights::EightBits => of::<true>(texture, sampler, coord, lod),
    }
}

fn of<const COARSE: bool>(
    texture: &Texture,
    sampler: &Sampler,
    coord: [f32; 3],
    lod: f32,
) -> Footprint {
    let choice = Choice::new::<COARSE>(texture, sampler, lod);
    let position = Position::new(texture.kind, coord);
    let mut found = Vec::new();
    for (number, share) in choice.levels() {
        let level = &texture.levels[number];
        let taps = taps::<COARSE>(texture.kind, sampler, level, position, choice.filter);
        taps.each(|face, texel, weight| {
            found.push(Tap {
                face,
                level: number as u32,
                texel,
                weight: weight * share,
            });
        });
    }
    Footprint {
        filter: choice.filter,
        face: position.face,
        uvw: position.uvw,
        levels: choice
            .levels()
            .map(|(level, share)| (level as u32, share))
            .collect(),
        taps: found,
    }
}

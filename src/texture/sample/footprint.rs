//! What a sample was made of, for debuggers: the same steps as sampling, told instead of blended.

use super::{Choice, Detail, Position, taps};
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
    /// u, v, w in the texture or in the face, before the address mode; of the middle if there are several probes.
    pub uvw: [f32; 3],
    /// The mip levels read and their shares.
    pub levels: Vec<(u32, f32)>,
    /// The texels read, probe by probe, in each the larger level first; the same texel may be listed more than once, where
    /// probes lie close together or an address mode repeats it.
    pub taps: Vec<Tap>,
}

/// Which texels [`super::sample_at`] with the same arguments reads, and how much of each. For debuggers.
pub fn footprint(
    texture: &Texture,
    sampler: &Sampler,
    coord: [f32; 3],
    detail: impl Into<Detail>,
) -> Footprint {
    let detail = detail.into();
    match sampler.weights {
        Weights::Full => of::<false>(texture, sampler, coord, &detail),
        Weights::EightBits => of::<true>(texture, sampler, coord, &detail),
    }
}

fn of<const COARSE: bool>(
    texture: &Texture,
    sampler: &Sampler,
    coord: [f32; 3],
    detail: &Detail,
) -> Footprint {
    let choice = Choice::new::<COARSE>(texture, sampler, detail);
    let position = Position::new(texture.kind, coord);
    let mut found = Vec::new();
    let mut probe = |position| {
        for (number, share) in choice.levels() {
            let level = &texture.levels[number];
            let taps = taps::<COARSE>(texture.kind, sampler, level, position, choice.filter);
            taps.each(|face, texel, weight| {
                found.push(Tap {
                    face,
                    level: number as u32,
                    texel,
                    weight: weight * share / f32::from(detail.probes),
                });
            });
        }
    };
    match detail.probes {
        1 => probe(position),
        _ => (detail.places())
            .for_each(|share| probe(position.of_probe(texture.kind, detail.along, share))),
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

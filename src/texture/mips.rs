//! Mip levels made from level 0.

use super::format::{pack8, unpack8};
use super::storage::{Level, Texels, full_level_count, lay_out};
use super::{Texture, TextureError};

/// The source texels that one texel of the next level covers on one axis, with their share; unused ones weigh 0.
type Span = [(usize, f32); 3];

/// A texel of the halved axis covers `from / to` source texels: 2 when even, up to 3 when odd.
fn spans(from: u32, to: u32) -> Vec<Span> {
    (0..to)
        .map(|target| {
            // In units of 1/to of a source texel, so that overlaps are whole numbers.
            let (start, end) = (target * from, (target + 1) * from);
            let first = start / to;
            let mut span = [(first as usize, 0.0); 3];
            for (entry, source) in span.iter_mut().zip(first..from) {
                let overlap = end
                    .min((source + 1) * to)
                    .saturating_sub(start.max(source * to));
                if overlap > 0 {
                    *entry = (source as usize, overlap as f32 / from as f32);
                }
            }
            span
        })
        .collect()
}

/// Averages `source` down to `target`, all faces; `fetch` reads a texel, `finish` takes the mean.
fn reduce(
    source: &Level,
    target: &Level,
    faces: usize,
    fetch: impl Fn(usize) -> [f32; 4],
    mut finish: impl FnMut([f32; 4]),
) {
    let axes: [Vec<Span>; 3] =
        std::array::from_fn(|axis| spans(source.size[axis], target.size[axis]));
    for face in 0..faces {
        for z in &axes[2] {
            for y in &axes[1] {
                for x in &axes[0] {
                    let mut mean = [0.0; 4];
                    for &(k, weight_z) in z.iter().filter(|entry| entry.1 > 0.0) {
                        for &(j, weight_y) in y.iter().filter(|entry| entry.1 > 0.0) {
                            for &(i, weight_x) in x.iter().filter(|entry| entry.1 > 0.0) {
                                let weight = weight_x * weight_y * weight_z;
                                let texel = fetch(source.index(face, [i, j, k]));
                                for (sum, value) in mean.iter_mut().zip(texel) {
                                    *sum += weight * value;
                                }
                            }
                        }
                    }
                    finish(mean);
                }
            }
        }
    }
}

impl Texture {
    /// Replaces all levels below level 0 by means of the level above (box filter, within each face), down to 1×1×1.
    ///
    /// Where an edge is odd, a texel of the next level covers fractions of source texels, weighted by area. Each level
    /// is rounded to what the format holds (four-byte formats and DXT to 1/255, halves up) before the next is made.
    ///
    /// # Errors
    /// [`TextureError::TooLarge`] when the further levels do not fit; the texture is then unchanged.
    pub fn generate_mips(&mut self) -> Result<(), TextureError> {
        let (size, faces, format) = (self.size(), self.face_count(), self.format);
        let signed = self.signed;
        let count = full_level_count(size) as usize;
        let layout = lay_out(self.kind, format, size, count)?;
        let base_len = self.levels[0].face_len * faces;
        for pair in layout.windows(2) {
            let [source, target] = pair else { continue };
            let added = target.face_len * faces;
            match &mut self.texels {
                Texels::Packed(words) => {
                    if target.offset == base_len {
                        words.truncate(base_len);
                    }
                    let mut next = Vec::with_capacity(added);
                    reduce(
                        source,
                        target,
                        faces,
                        |index| unpack8(words[index]),
                        // Means of bytes are exact here up to the division, so that halves are met.
                        |mean| next.push(pack8(mean.map(|code| (code + 0.5).floor() / 255.0))),
                    );
                    words.append(&mut next);
                }
                Texels::Float(texels) => {
                    if target.offset == base_len {
                        texels.truncate(base_len);
                    }
                    let mut next = Vec::with_capacity(added);
                    let fetch = |index: usize| texels[index];
                    reduce(source, target, faces, fetch, |mean| {
                        next.push(format.quantize(mean, signed))
                    });
                    texels.append(&mut next);
                }
            }
        }
        self.levels = layout;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::{Format, TextureKind};

    fn grey(values: &[u8]) -> Vec<u8> {
        values.iter().flat_map(|&v| [v, v, v, 255]).collect()
    }

    #[test]
    fn even_edges_average_two_by_two_and_halves_round_up() {
        let mut texture = Texture::from_rgba8(4, 2, &grey(&[0, 1, 10, 20, 0, 1, 30, 40])).unwrap();
        texture.generate_mips().unwrap();
        assert_eq!(texture.level_count(), 3);
        // (0+1+0+1)/4 = 0.5 → 1; (10+20+30+40)/4 = 25; then (1+25)/2 = 13.
        let byte = |level, x| texture.texel(0, level, x, 0, 0).unwrap()[0] * 255.0;
        assert_eq!([byte(1, 0), byte(1, 1), byte(2, 0)], [1.0, 25.0, 13.0]);
        let again = texture.clone();
        texture.generate_mips().unwrap();
        assert_eq!(texture, again);
    }

    #[test]
    fn odd_edges_are_weighted_by_area() {
        // 5 → 2: the first covers texels 0, 1 and half of 2: (10 + 20 + 15)/2.5 = 18; the second (15 + 40 + 50)/2.5 = 42.
        let mut texture = Texture::from_rgba8(5, 1, &grey(&[10, 20, 30, 40, 50])).unwrap();
        texture.generate_mips().unwrap();
        let byte = |x| (texture.texel(0, 1, x, 0, 0).unwrap()[0] * 255.0).round();
        assert_eq!([byte(0), byte(1)], [18.0, 42.0]);
        assert_eq!(texture.level_size(2), Some([1, 1, 1]));
    }

    #[test]
    fn faces_do_not_mix_and_formats_hold_the_means() {
        // Face f has U = f/127 in all four texels; its 1×1 level is the same.
        let texels: Vec<_> = (0..24)
            .map(|i| [(i / 4) as f32 / 127.0, 0.0, 1.0, 1.0])
            .collect();
        let mut texture =
            Texture::from_texels(TextureKind::Cube, Format::V8U8, [2, 2, 1], &[texels]).unwrap();
        texture.generate_mips().unwrap();
        for face in 0..6 {
            assert_eq!(
                texture.texel(face, 1, 0, 0, 0),
                Some([face as f32 / 127.0, 0.0, 1.0, 1.0])
            );
        }
    }

    #[test]
    fn volumes_average_along_depth_too() {
        let texels: Vec<_> = (0..8).map(|i| [i as f32, 0.0, 0.0, 0.0]).collect();
        let mut texture =
            Texture::from_texels(TextureKind::Volume, Format::Rgba32F, [2, 2, 2], &[texels])
                .unwrap();
        texture.generate_mips().unwrap();
        assert_eq!(texture.texel(0, 1, 0, 0, 0), Some([3.5, 0.0, 0.0, 0.0]));
    }
}

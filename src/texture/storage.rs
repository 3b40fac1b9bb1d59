//! The texture itself: kind, size, levels, and the texels in one block of memory.

use super::format::{Layout, decode_word, pack8, unpack8};
use super::{Format, Signed, TextureError};

/// The longest edge of a texture, in texels.
pub const MAX_EDGE: u32 = 16384;

/// The most bytes that the decoded texels of one texture may take (1 GiB).
pub const MAX_BYTES: u64 = 1 << 30;

/// The three shapes of a Direct3D 8 texture. Names: `2d`, `cube`, `volume`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum TextureKind {
    /// Width × height.
    Texture2D,
    /// Six square faces in the order +X, −X, +Y, −Y, +Z, −Z.
    Cube,
    /// Width × height × depth.
    Volume,
}
super::sampler::names!(TextureKind, "texture kind", Texture2D "2d", Cube "cube", Volume "volume");

/// Where one mip level lies among the texels. Its faces follow each other, each slice by slice, row by row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Level {
    pub(super) size: [u32; 3],
    pub(super) offset: usize,
    pub(super) face_len: usize,
}

/// Decoded texels. Four bytes a texel are kept wherever they are exact: reading memory is what sampling costs.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Texels {
    Packed(Vec<u32>),
    Float(Vec<[f32; 4]>),
}

/// One way of keeping texels, so that sampling is compiled for each.
pub(super) trait Store: Copy {
    /// What a fetched value must be divided by.
    const SCALE: f32;
    /// The texel's channels times [`Self::SCALE`].
    fn fetch(self, index: usize) -> [f32; 4];
}

#[derive(Clone, Copy)]
pub(super) struct PackedStore<'a>(pub(super) &'a [u32]);
#[derive(Clone, Copy)]
pub(super) struct FloatStore<'a>(pub(super) &'a [[f32; 4]]);

impl Store for PackedStore<'_> {
    const SCALE: f32 = 255.0;
    #[inline(always)]
    fn fetch(self, index: usize) -> [f32; 4] {
        unpack8(self.0[index])
    }
}

impl Store for FloatStore<'_> {
    const SCALE: f32 = 1.0;
    #[inline(always)]
    fn fetch(self, index: usize) -> [f32; 4] {
        self.0[index]
    }
}

/// A texture: decoded texels of all faces and mip levels.
#[derive(Debug, Clone, PartialEq)]
pub struct Texture {
    pub(super) kind: TextureKind,
    pub(super) format: Format,
    pub(super) signed: Signed,
    pub(super) levels: Vec<Level>,
    pub(super) texels: Texels,
}

/// The size of mip level `level`: every edge halved, rounded down, at least 1.
pub(super) fn mip_size(size: [u32; 3], level: u32) -> [u32; 3] {
    size.map(|edge| edge.checked_shr(level).unwrap_or(0).max(1))
}

/// How many levels the size has down to 1×1×1.
pub(super) fn full_level_count(size: [u32; 3]) -> u32 {
    let longest = size.into_iter().max().unwrap_or(1);
    (u32::BITS - longest.leading_zeros()).max(1)
}

impl TextureKind {
    /// Faces of a level: six for a cube, else one.
    pub fn face_count(self) -> usize {
        if self == Self::Cube { 6 } else { 1 }
    }
}

/// Checks a shape before anything of its size is allocated, and lays out its levels.
pub(super) fn lay_out(
    kind: TextureKind,
    format: Format,
    size: [u32; 3],
    level_count: usize,
) -> Result<Vec<Level>, TextureError> {
    if size.iter().any(|edge| !(1..=MAX_EDGE).contains(edge)) {
        return Err(TextureError::Size(size));
    }
    let flat = kind != TextureKind::Volume && size[2] != 1;
    if flat || kind == TextureKind::Cube && size[0] != size[1] {
        return Err(TextureError::Shape { kind, size });
    }
    let most = full_level_count(size);
    if level_count == 0 || level_count > most as usize {
        return Err(TextureError::Levels {
            given: level_count,
            most,
        });
    }
    let texel_bytes = if format.is_packed() { 4 } else { 16 };
    let mut levels = Vec::with_capacity(level_count);
    let mut offset = 0u64;
    for size in (0..most)
        .take(level_count)
        .map(|level| mip_size(size, level))
    {
        let face_len: u64 = size.into_iter().map(u64::from).product();
        levels.push(Level {
            size,
            offset: offset as usize,
            face_len: face_len as usize,
        });
        offset += face_len * kind.face_count() as u64;
        if offset * texel_bytes > MAX_BYTES {
            return Err(TextureError::TooLarge {
                bytes: offset * texel_bytes,
            });
        }
    }
    Ok(levels)
}

fn check_amounts(
    unit: &'static str,
    pairs: impl Iterator<Item = (u64, usize)>,
) -> Result<(), TextureError> {
    for (level, (expected, given)) in pairs.enumerate() {
        if expected != given as u64 {
            return Err(TextureError::Amount {
                level,
                unit,
                expected,
                given: given as u64,
            });
        }
    }
    Ok(())
}

impl Texels {
    pub(super) fn with_capacity(format: Format, count: usize) -> Self {
        if format.is_packed() {
            Self::Packed(Vec::with_capacity(count))
        } else {
            Self::Float(Vec::with_capacity(count))
        }
    }

    /// Appends a texel that the format is known to hold exactly.
    pub(super) fn push(&mut self, texel: [f32; 4]) {
        match self {
            Self::Packed(words) => words.push(pack8(texel)),
            Self::Float(texels) => texels.push(texel),
        }
    }
}

impl Texture {
    /// A texture from texels given as numbers, each rounded to the nearest value that `format` holds.
    ///
    /// `size` is width, height, depth; depth is 1 except for volumes. `levels` holds level 0 and any further mip
    /// levels; each lists its texels row by row (slice by slice; face by face in the order +X, −X, +Y, −Y, +Z, −Z)
    /// as r, g, b, a in the units a shader reads: 0 to 1, −1 to 1 for signed channels. Channels that the format
    /// lacks are ignored; luminance is taken from r.
    ///
    /// # Errors
    /// A size that is 0, too large or does not fit the kind; a level with another number of texels than its size
    /// says; a compressed format.
    pub fn from_texels<L: AsRef<[[f32; 4]]>>(
        kind: TextureKind,
        format: Format,
        size: [u32; 3],
        levels: &[L],
    ) -> Result<Self, TextureError> {
        Self::from_texels_signed(kind, format, size, levels, Signed::default())
    }

    /// As [`Texture::from_texels`], of what signed channels hold when their codes stand for these numbers.
    ///
    /// # Errors
    /// As [`Texture::from_texels`].
    pub fn from_texels_signed<L: AsRef<[[f32; 4]]>>(
        kind: TextureKind,
        format: Format,
        size: [u32; 3],
        levels: &[L],
        signed: Signed,
    ) -> Result<Self, TextureError> {
        if format.is_compressed() {
            return Err(TextureError::CannotCompress(format));
        }
        let layout = lay_out(kind, format, size, levels.len())?;
        let faces = kind.face_count();
        let expected = layout.iter().map(|level| (level.face_len * faces) as u64);
        check_amounts(
            "texels",
            expected.zip(levels.iter().map(|list| list.as_ref().len())),
        )?;
        let count = levels.iter().map(|list| list.as_ref().len()).sum();
        let mut texels = Texels::with_capacity(format, count);
        for &texel in levels.iter().flat_map(|list| list.as_ref()) {
            texels.push(format.quantize(texel, signed));
        }
        Ok(Self {
            kind,
            format,
            signed,
            levels: layout,
            texels,
        })
    }

    /// A texture from memory as Direct3D keeps it: little-endian words, rows tightly packed, DXT in 4×4 blocks.
    ///
    /// `levels` as in [`Texture::from_texels`], each level's faces one after the other. Text files that list words as
    /// integers turn them into bytes with [`super::words_to_bytes`].
    ///
    /// # Errors
    /// As [`Texture::from_texels`]; and [`TextureError::NeedsFeature`] for DXT in a build without `scene`.
    pub fn from_raw<L: AsRef<[u8]>>(
        kind: TextureKind,
        format: Format,
        size: [u32; 3],
        levels: &[L],
    ) -> Result<Self, TextureError> {
        Self::from_raw_signed(kind, format, size, levels, Signed::default())
    }

    /// As [`Texture::from_raw`], with what the codes of signed channels stand for.
    ///
    /// # Errors
    /// As [`Texture::from_raw`].
    pub fn from_raw_signed<L: AsRef<[u8]>>(
        kind: TextureKind,
        format: Format,
        size: [u32; 3],
        levels: &[L],
        signed: Signed,
    ) -> Result<Self, TextureError> {
        let layout = lay_out(kind, format, size, levels.len())?;
        let faces = kind.face_count() as u64;
        let expected = layout.iter().map(|level| {
            let [width, height, depth] = level.size;
            format.byte_count(width, height, depth) * faces
        });
        check_amounts(
            "bytes",
            expected.zip(levels.iter().map(|bytes| bytes.as_ref().len())),
        )?;
        let count = layout.iter().map(|level| level.face_len).sum::<usize>() * faces as usize;
        let mut texels = Texels::with_capacity(format, count);
        for (level, bytes) in layout.iter().zip(levels) {
            let bytes = bytes.as_ref();
            match format.layout() {
                Layout::Word {
                    bytes: size,
                    channels,
                } => {
                    for texel in bytes.chunks_exact(size as usize) {
                        let mut word = [0; 4];
                        word[..texel.len()].copy_from_slice(texel);
                        texels.push(decode_word(u32::from_le_bytes(word), &channels, signed));
                    }
                }
                Layout::Float => {
                    for texel in bytes.chunks_exact(16) {
                        let mut value = [0.0; 4];
                        for (channel, bits) in value.iter_mut().zip(texel.chunks_exact(4)) {
                            let bits = [bits[0], bits[1], bits[2], bits[3]];
                            *channel = f32::from_le_bytes(bits);
                        }
                        texels.push(value);
                    }
                }
                Layout::Block { .. } => {
                    decode_blocks(format, bytes, level.size, faces as u32, &mut texels)?;
                }
            }
        }
        Ok(Self {
            kind,
            format,
            signed,
            levels: layout,
            texels,
        })
    }

    /// A 2D texture of format `rgba8` with one level, from bytes in the order r, g, b, a, row by row.
    ///
    /// # Errors
    /// A size of 0 or too large, or another number of bytes than 4 × width × height.
    pub fn from_rgba8(width: u32, height: u32, bytes: &[u8]) -> Result<Self, TextureError> {
        Self::from_raw(
            TextureKind::Texture2D,
            Format::Rgba8,
            [width, height, 1],
            &[bytes],
        )
    }

    /// 2D, cube or volume.
    pub fn kind(&self) -> TextureKind {
        self.kind
    }

    /// The format that the texels were stored in.
    pub fn format(&self) -> Format {
        self.format
    }

    /// Width, height and depth of level 0, in texels.
    pub fn size(&self) -> [u32; 3] {
        self.levels[0].size
    }

    /// Number of mip levels, at least 1.
    pub fn level_count(&self) -> u32 {
        self.levels.len() as u32
    }

    /// Width, height and depth of a mip level; none if there is no such level.
    pub fn level_size(&self, level: u32) -> Option<[u32; 3]> {
        self.levels.get(level as usize).map(|level| level.size)
    }

    /// Number of faces: 6 for a cube, else 1.
    pub fn face_count(&self) -> usize {
        self.kind.face_count()
    }

    /// All texels of a mip level as little-endian bytes, for a graphics card: face after face, slice after slice, row
    /// after row, without gaps. A texel is red, green, blue, alpha; each one byte for 0 to 1 if the format
    /// [is packed](Format::is_packed), else a 32-bit float. None if there is no such level.
    pub fn level_bytes(&self, level: u32) -> Option<Vec<u8>> {
        let level = self.levels.get(level as usize)?;
        let range = level.offset..level.offset + level.face_len * self.face_count();
        Some(match &self.texels {
            Texels::Packed(words) => (words.get(range)?.iter())
                .flat_map(|word| word.to_le_bytes())
                .collect(),
            Texels::Float(texels) => (texels.get(range)?.iter().flatten())
                .flat_map(|value| value.to_le_bytes())
                .collect(),
        })
    }

    /// One texel as a shader reads it; none outside the texture.
    pub fn texel(&self, face: usize, level: u32, x: u32, y: u32, z: u32) -> Option<[f32; 4]> {
        let level = self.levels.get(level as usize)?;
        let [width, height, depth] = level.size;
        if face >= self.face_count() || x >= width || y >= height || z >= depth {
            return None;
        }
        let index = level.index(face, [x as usize, y as usize, z as usize]);
        match &self.texels {
            Texels::Packed(words) => words
                .get(index)
                .map(|&word| unpack8(word).map(|code| code / 255.0)),
            Texels::Float(texels) => texels.get(index).copied(),
        }
    }
}

impl Level {
    /// Place of a texel among all texels of the texture. The coordinates must lie inside the level.
    #[inline(always)]
    pub(super) fn index(&self, face: usize, [x, y, z]: [usize; 3]) -> usize {
        let [width, height, _] = self.size.map(|edge| edge as usize);
        self.offset + face * self.face_len + (z * height + y) * width + x
    }
}

/// Appends the texels of one level's DXT blocks (`bytes` has been checked to hold exactly these).
#[cfg(feature = "scene")]
fn decode_blocks(
    format: Format,
    bytes: &[u8],
    [width, height, depth]: [u32; 3],
    faces: u32,
    texels: &mut Texels,
) -> Result<(), TextureError> {
    type Decode = fn(&[u8], &mut [u8], usize);
    let (block_bytes, decode): (usize, Decode) = match format {
        Format::Dxt1 => (8, bcdec_rs::bc1),
        Format::Dxt2 | Format::Dxt3 => (16, bcdec_rs::bc2),
        _ => (16, bcdec_rs::bc3),
    };
    let Texels::Packed(words) = texels else {
        return Ok(());
    };
    let (width, height) = (width as usize, height as usize);
    let blocks_wide = width.div_ceil(4);
    let slice_bytes = blocks_wide * height.div_ceil(4) * block_bytes;
    for slice in bytes
        .chunks_exact(slice_bytes)
        .take((depth * faces) as usize)
    {
        let base = words.len();
        words.resize(base + width * height, 0);
        for (number, block) in slice.chunks_exact(block_bytes).enumerate() {
            let mut decoded = [0u8; 64];
            decode(block, &mut decoded, 16);
            let (left, top) = (number % blocks_wide * 4, number / blocks_wide * 4);
            for (place, texel) in decoded.chunks_exact(4).enumerate() {
                let (x, y) = (left + place % 4, top + place / 4);
                // Blocks at the right and lower edge reach beyond a size that is no multiple of four.
                if x < width && y < height {
                    words[base + y * width + x] =
                        u32::from_le_bytes([texel[0], texel[1], texel[2], texel[3]]);
                }
            }
        }
    }
    Ok(())
}

#[cfg(not(feature = "scene"))]
fn decode_blocks(
    format: Format,
    _bytes: &[u8],
    _size: [u32; 3],
    _faces: u32,
    _texels: &mut Texels,
) -> Result<(), TextureError> {
    Err(TextureError::NeedsFeature {
        format,
        feature: "scene",
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use TextureKind::*;

    #[test]
    fn shapes_are_checked_before_memory_is_taken() {
        let none: &[[f32; 4]] = &[];
        let make =
            |kind, size| Texture::from_texels(kind, Format::Rgba8, size, &[none]).unwrap_err();
        assert_eq!(make(Texture2D, [0, 4, 1]), TextureError::Size([0, 4, 1]));
        assert_eq!(
            make(Texture2D, [16385, 1, 1]),
            TextureError::Size([16385, 1, 1])
        );
        assert_eq!(
            make(Cube, [4, 2, 1]),
            TextureError::Shape {
                kind: Cube,
                size: [4, 2, 1]
            }
        );
        assert_eq!(
            make(Texture2D, [4, 4, 2]),
            TextureError::Shape {
                kind: Texture2D,
                size: [4, 4, 2]
            }
        );
        // 16384³ · 4 bytes = 2^44.
        assert_eq!(
            make(Volume, [16384; 3]),
            TextureError::TooLarge { bytes: 1 << 44 }
        );
        let amount = TextureError::Amount {
            level: 0,
            unit: "texels",
            expected: 24,
            given: 0,
        };
        assert_eq!(make(Cube, [2, 2, 1]), amount);
        let many = Texture::from_texels(Texture2D, Format::Rgba8, [2, 1, 1], &[none, none, none]);
        assert_eq!(
            many.unwrap_err(),
            TextureError::Levels { given: 3, most: 2 }
        );
    }

    #[test]
    fn levels_of_odd_sizes_are_halved_and_rounded_down() {
        let levels = lay_out(Texture2D, Format::V8U8, [5, 3, 1], 3).unwrap();
        let sizes: Vec<_> = levels
            .iter()
            .map(|level| (level.size, level.offset))
            .collect();
        assert_eq!(sizes, [([5, 3, 1], 0), ([2, 1, 1], 15), ([1, 1, 1], 17)]);
        assert_eq!(full_level_count([5, 3, 1]), 3);
    }

    #[test]
    fn raw_words_and_texel_order() {
        // Two slices of a 2×1×2 volume, U = 127, −127, 0, 64.
        let bytes = super::super::words_to_bytes(Format::V8U8, &[0x7f, 0x81, 0, 0x40]).unwrap();
        let texture = Texture::from_raw(Volume, Format::V8U8, [2, 1, 2], &[bytes]).unwrap();
        assert_eq!(texture.texel(0, 0, 0, 0, 0), Some([1.0, 0.0, 1.0, 1.0]));
        assert_eq!(texture.texel(0, 0, 1, 0, 0), Some([-1.0, 0.0, 1.0, 1.0]));
        assert_eq!(
            texture.texel(0, 0, 1, 0, 1),
            Some([64.0 / 127.0, 0.0, 1.0, 1.0])
        );
        assert_eq!(texture.texel(0, 0, 2, 0, 0), None);
        assert_eq!(texture.texel(1, 0, 0, 0, 0), None);
        assert_eq!(texture.texel(0, 1, 0, 0, 0), None);
        let short = Texture::from_raw(Texture2D, Format::V8U8, [2, 1, 1], &[[0u8; 3]]);
        assert_eq!(
            short.unwrap_err(),
            TextureError::Amount {
                level: 0,
                unit: "bytes",
                expected: 4,
                given: 3
            }
        );
    }

    #[test]
    fn floats_are_kept_as_they_are() {
        let bits = [1.5f32, -3.0, 1e10, 0.25].map(f32::to_bits);
        let bytes = super::super::words_to_bytes(Format::Rgba32F, &bits).unwrap();
        let texture = Texture::from_raw(Texture2D, Format::Rgba32F, [1, 1, 1], &[bytes]).unwrap();
        assert_eq!(texture.texel(0, 0, 0, 0, 0), Some([1.5, -3.0, 1e10, 0.25]));
    }

    /// Codes times 255 and back: packing must give the byte back for each of the 256 values.
    #[test]
    fn packing_keeps_every_byte() {
        for code in 0..=255u32 {
            let value = unpack8(code * 0x0101_0101).map(|code| code / 255.0);
            assert_eq!(pack8(value), code * 0x0101_0101);
        }
    }

    #[cfg(feature = "scene")]
    #[test]
    fn dxt1_blocks_by_hand() {
        // c0 = 0xf800 (red) > c1 = 0x001f (blue): texels 0..3 take codes 0, 1, 2, 3 (code byte 0b11100100),
        // code 2 is 2/3 red + 1/3 blue = (170, 0, 85), code 3 the reverse. The other rows are code 0.
        let opaque = [0x00, 0xf8, 0x1f, 0x00, 0xe4, 0, 0, 0];
        let texture = Texture::from_raw(Texture2D, Format::Dxt1, [4, 4, 1], &[opaque]).unwrap();
        let byte = |v: u8| f32::from(v) / 255.0;
        let row: Vec<_> = (0..4)
            .map(|x| texture.texel(0, 0, x, 0, 0).unwrap())
            .collect();
        assert_eq!(row[0], [1.0, 0.0, 0.0, 1.0]);
        assert_eq!(row[1], [0.0, 0.0, 1.0, 1.0]);
        assert_eq!(row[2], [byte(170), 0.0, byte(85), 1.0]);
        assert_eq!(row[3], [byte(85), 0.0, byte(170), 1.0]);
        assert_eq!(texture.texel(0, 0, 2, 3, 0), Some([1.0, 0.0, 0.0, 1.0]));
        // c0 = blue < c1 = red: code 2 is the mean, code 3 transparent black. A 2×1 texture cuts the block off.
        let punched = [0x1f, 0x00, 0x00, 0xf8, 0x0e, 0, 0, 0];
        let texture = Texture::from_raw(Texture2D, Format::Dxt1, [2, 1, 1], &[punched]).unwrap();
        let mean = texture.texel(0, 0, 0, 0, 0).unwrap();
        assert!(
            (mean[0] - 0.5).abs() < 0.003 && (mean[2] - 0.5).abs() < 0.003 && mean[3] == 1.0,
            "{mean:?}"
        );
        assert_eq!(texture.texel(0, 0, 1, 0, 0), Some([0.0; 4]));
    }

    #[cfg(feature = "scene")]
    #[test]
    fn dxt3_and_dxt5_alpha_by_hand() {
        // DXT3: alpha nibbles 0x1, 0xf, ... ; colours all c0 = white.
        let mut block = [0u8; 16];
        block[0] = 0xf1;
        block[8..12].copy_from_slice(&[0xff, 0xff, 0, 0]);
        let texture = Texture::from_raw(Texture2D, Format::Dxt3, [4, 4, 1], &[block]).unwrap();
        assert_eq!(
            texture.texel(0, 0, 0, 0, 0),
            Some([1.0, 1.0, 1.0, 17.0 / 255.0])
        );
        assert_eq!(texture.texel(0, 0, 1, 0, 0), Some([1.0; 4]));
        // DXT5: a0 = 255 > a1 = 0, first codes 1 (a1) and 2 (6/7·255 = 218.57 → 219 or 218).
        let mut block = [0u8; 16];
        block[0] = 255;
        block[2] = 0b0001_0001;
        block[8..12].copy_from_slice(&[0xff, 0xff, 0, 0]);
        let texture = Texture::from_raw(Texture2D, Format::Dxt5, [4, 4, 1], &[block]).unwrap();
        assert_eq!(texture.texel(0, 0, 0, 0, 0), Some([1.0, 1.0, 1.0, 0.0]));
        let second = texture.texel(0, 0, 1, 0, 0).unwrap()[3];
        assert!((second - 6.0 / 7.0).abs() < 1.0 / 255.0, "{second}");
    }

    #[test]
    fn numbers_cannot_become_dxt() {
        let result = Texture::from_texels(Texture2D, Format::Dxt1, [1, 1, 1], &[[[0.0; 4]]]);
        assert_eq!(
            result.unwrap_err(),
            TextureError::CannotCompress(Format::Dxt1)
        );
    }

    #[cfg(not(feature = "scene"))]
    #[test]
    fn dxt_names_the_feature_that_is_missing() {
        let result = Texture::from_raw(Texture2D, Format::Dxt1, [1, 1, 1], &[[0u8; 8]]);
        assert!(result.unwrap_err().to_string().contains("`scene`"));
    }
}

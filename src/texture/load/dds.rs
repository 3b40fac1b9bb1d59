//! DDS files.

use ddsfile::{Caps2, D3D10ResourceDimension, Dds, DxgiFormat, MiscFlag};

use crate::texture::format::{Channel, Layout};
use crate::texture::storage::{lay_out, mip_size};
use crate::texture::{Format, Signed, Texture, TextureError, TextureKind};

fn broken(problem: impl std::fmt::Display) -> TextureError {
    TextureError::File {
        what: "DDS",
        problem: problem.to_string(),
    }
}

/// The texture of a DDS file: 2D, cube (all six faces) or volume, with its mip levels.
///
/// The format is told by a four-character code (`DXT1`, or a `D3DFORMAT` number such as 63 for Q8W8V8U8), by bit masks
/// (colour, luminance, alpha or bump), or by the DXGI number of a file with the later header (sRGB variants are read
/// without conversion, as Direct3D 8 would).
///
/// # Errors
/// [`TextureError::File`] when the file is broken, cut off, holds an array, an incomplete cube or a format that Direct3D 8
/// textures do not have; the size limits of textures. Memory is taken in proportion to the bytes given.
pub fn decode_dds(bytes: &[u8]) -> Result<Texture, TextureError> {
    decode_dds_signed(bytes, Signed::default())
}

/// As [`decode_dds`], with what the codes of signed channels stand for.
///
/// # Errors
/// As [`decode_dds`].
pub fn decode_dds_signed(bytes: &[u8], signed: Signed) -> Result<Texture, TextureError> {
    let dds = Dds::read(bytes).map_err(broken)?;
    let header = &dds.header;
    let (kind, format) = match &dds.header10 {
        Some(extension) => {
            let kind = match extension.resource_dimension {
                D3D10ResourceDimension::Texture3D => TextureKind::Volume,
                _ if extension.misc_flag.contains(MiscFlag::TEXTURECUBE) => TextureKind::Cube,
                _ => TextureKind::Texture2D,
            };
            if extension.array_size > 1 {
                return Err(broken("it holds an array of textures"));
            }
            (kind, dxgi_format(extension.dxgi_format))
        }
        None if header.caps2.contains(Caps2::VOLUME) => (TextureKind::Volume, legacy_format(bytes)),
        None if header.caps2.contains(Caps2::CUBEMAP) => {
            if !header.caps2.contains(Caps2::CUBEMAP_ALLFACES) {
                return Err(broken("the cube has not all of its six faces"));
            }
            (TextureKind::Cube, legacy_format(bytes))
        }
        None => (TextureKind::Texture2D, legacy_format(bytes)),
    };
    let format = format.ok_or_else(|| broken("its format is none of Direct3D 8's"))?;
    let depth = if kind == TextureKind::Volume {
        header.depth.unwrap_or(1)
    } else {
        1
    };
    let size = [header.width, header.height, depth];
    let level_count = header.mip_map_count.unwrap_or(1).max(1);
    // Checks the size and the count before anything is made of them.
    let layout = lay_out(kind, format, size, level_count as usize)?;
    // In the file each face has all its levels together; in a texture each level has all its faces.
    let mut levels = vec![Vec::new(); layout.len()];
    let mut rest = dds.data.as_slice();
    for _ in 0..kind.face_count() {
        for (level, number) in levels.iter_mut().zip(0..) {
            let [width, height, depth] = mip_size(size, number);
            let length = format.byte_count(width, height, depth) as usize;
            let (part, after) = rest.split_at_checked(length).ok_or_else(|| {
                broken(format!(
                    "it ends in the middle of level {number} ({width}x{height}x{depth} {format})"
                ))
            })?;
            level.extend_from_slice(part);
            rest = after;
        }
    }
    Texture::from_raw_signed(kind, format, size, &levels, signed)
}

/// Flags and masks of the file's pixel format. The container library forgets the flags of bump formats, and with them
/// their masks, so that the words are taken from their fixed places once it has accepted the header.
fn legacy_format(bytes: &[u8]) -> Option<Format> {
    const FLAGS_AT: usize = 80;
    const FOUR_CC: u32 = 0x4;
    let words: Vec<u32> = bytes
        .get(FLAGS_AT..FLAGS_AT + 28)?
        .chunks_exact(4)
        .map(|word| {
            word.iter()
                .rev()
                .fold(0, |all, &byte| all << 8 | u32::from(byte))
        })
        .collect();
    let &[flags, four_cc, bits, red, green, blue, alpha] = words.as_slice() else {
        return None;
    };
    if flags & FOUR_CC != 0 {
        return Format::from_d3d(four_cc);
    }
    let described = Described {
        flags,
        bits,
        masks: [red, green, blue, alpha],
    };
    Format::all().find(|format| described.is(*format))
}

/// A pixel format as a DDS header describes it without a code.
struct Described {
    flags: u32,
    bits: u32,
    masks: [u32; 4],
}

impl Described {
    const ALPHA_PIXELS: u32 = 0x1;
    const ALPHA: u32 = 0x2;
    const RGB: u32 = 0x40;
    const LUMINANCE: u32 = 0x2_0000;
    const BUMP_LUMINANCE: u32 = 0x4_0000;
    const BUMP_DUDV: u32 = 0x8_0000;

    /// Whether the header describes this format: the kind of its channels by a flag, their places by masks.
    fn is(&self, format: Format) -> bool {
        let Layout::Word { bytes, channels } = format.layout() else {
            return false;
        };
        // Not distinguishable from `v8u8` by masks; it comes by its number only.
        if bytes * 8 != self.bits || channels.contains(&Channel::UnitZ) {
            return false;
        }
        let signed = channels
            .iter()
            .any(|channel| matches!(channel, Channel::Snorm { .. }));
        let mut wanted = channels.map(field_mask);
        let luminance = wanted[0] != 0 && wanted[0] == wanted[1];
        let kind = match (signed, luminance) {
            // A signed format with an unsigned third channel is one with luminance.
            (true, _) if matches!(channels[2], Channel::Unorm { .. }) => Self::BUMP_LUMINANCE,
            (true, _) => Self::BUMP_DUDV,
            (false, true) => Self::LUMINANCE,
            (false, false) if wanted[0] == 0 => Self::ALPHA,
            (false, false) => Self::RGB,
        };
        if luminance {
            // Only the first mask counts, the others may repeat it or be 0.
            [wanted[1], wanted[2]] = [0; 2];
        }
        let given = |channel: usize| match channel {
            1 | 2 if luminance => 0,
            0..=2 if kind == Self::ALPHA => 0,
            // The alpha mask of a format without alpha may be anything.
            3 if self.flags & (Self::ALPHA_PIXELS | Self::ALPHA) == 0
                && kind != Self::BUMP_DUDV =>
            {
                0
            }
            _ => self.masks[channel],
        };
        self.flags & kind != 0 && (0..4).all(|channel| given(channel) == wanted[channel])
    }
}

/// The bits of a word that a channel occupies.
fn field_mask(channel: Channel) -> u32 {
    match channel {
        Channel::Unorm { shift, bits } | Channel::Snorm { shift, bits } => {
            u32::MAX >> (32 - bits) << shift
        }
        Channel::Zero | Channel::One | Channel::UnitZ => 0,
    }
}

/// The Direct3D 8 format that holds the same bits as a later one and reads the same.
fn dxgi_format(format: DxgiFormat) -> Option<Format> {
    Some(match format {
        DxgiFormat::B8G8R8A8_UNorm | DxgiFormat::B8G8R8A8_UNorm_sRGB => Format::A8R8G8B8,
        DxgiFormat::B8G8R8X8_UNorm | DxgiFormat::B8G8R8X8_UNorm_sRGB => Format::X8R8G8B8,
        DxgiFormat::R8G8B8A8_UNorm | DxgiFormat::R8G8B8A8_UNorm_sRGB => Format::Rgba8,
        DxgiFormat::R8G8B8A8_SNorm => Format::Q8W8V8U8,
        DxgiFormat::R8G8_SNorm => Format::V8U8,
        DxgiFormat::R16G16_SNorm => Format::V16U16,
        DxgiFormat::R32G32B32A32_Float => Format::Rgba32F,
        DxgiFormat::B5G6R5_UNorm => Format::R5G6B5,
        DxgiFormat::B5G5R5A1_UNorm => Format::A1R5G5B5,
        DxgiFormat::B4G4R4A4_UNorm => Format::A4R4G4B4,
        DxgiFormat::A8_UNorm => Format::A8,
        DxgiFormat::BC1_UNorm | DxgiFormat::BC1_UNorm_sRGB => Format::Dxt1,
        DxgiFormat::BC2_UNorm | DxgiFormat::BC2_UNorm_sRGB => Format::Dxt3,
        DxgiFormat::BC3_UNorm | DxgiFormat::BC3_UNorm_sRGB => Format::Dxt5,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A DDS file written word by word from the format's description.
    struct File {
        size: [u32; 3],
        levels: u32,
        caps2: u32,
        /// Flags, four-character code, bits, masks.
        pixel: [u32; 7],
        data: Vec<u8>,
    }

    impl File {
        fn new(width: u32, height: u32, pixel: [u32; 7], data: &[u8]) -> Self {
            Self {
                size: [width, height, 0],
                levels: 1,
                caps2: 0,
                pixel,
                data: data.to_vec(),
            }
        }

        fn bytes(&self) -> Vec<u8> {
            let [width, height, depth] = self.size;
            let mut words = vec![
                0x2053_4444,
                124,
                0x1007 | 0x2_0000 | 0x80_0000,
                height,
                width,
                0,
                depth,
                self.levels,
            ];
            words.extend([0; 11]);
            words.push(32);
            words.extend(self.pixel);
            words.extend([0x1008, self.caps2, 0, 0, 0]);
            let mut bytes: Vec<u8> = words.into_iter().flat_map(u32::to_le_bytes).collect();
            bytes.extend(&self.data);
            bytes
        }
    }

    const ARGB: [u32; 7] = [0x41, 0, 32, 0xff_0000, 0xff00, 0xff, 0xff00_0000];

    #[test]
    fn formats_by_flags_and_masks() {
        let cases = [
            (Format::A8R8G8B8, ARGB),
            (Format::X8R8G8B8, [0x40, 0, 32, 0xff_0000, 0xff00, 0xff, 0]),
            (
                Format::X8R8G8B8,
                [0x40, 0, 32, 0xff_0000, 0xff00, 0xff, 0xff00_0000],
            ),
            (
                Format::Rgba8,
                [0x41, 0, 32, 0xff, 0xff00, 0xff_0000, 0xff00_0000],
            ),
            (Format::R8G8B8, [0x40, 0, 24, 0xff_0000, 0xff00, 0xff, 0]),
            (Format::R5G6B5, [0x40, 0, 16, 0xf800, 0x7e0, 0x1f, 0]),
            (Format::A1R5G5B5, [0x41, 0, 16, 0x7c00, 0x3e0, 0x1f, 0x8000]),
            (Format::X1R5G5B5, [0x40, 0, 16, 0x7c00, 0x3e0, 0x1f, 0]),
            (Format::A4R4G4B4, [0x41, 0, 16, 0xf00, 0xf0, 0xf, 0xf000]),
            (Format::L8, [0x2_0000, 0, 8, 0xff, 0, 0, 0]),
            (Format::L8, [0x2_0000, 0, 8, 0xff, 0xff, 0xff, 0]),
            (Format::A8L8, [0x2_0001, 0, 16, 0xff, 0, 0, 0xff00]),
            (Format::A4L4, [0x2_0001, 0, 8, 0xf, 0, 0, 0xf0]),
            (Format::A8, [0x2, 0, 8, 0, 0, 0, 0xff]),
            (Format::V8U8, [0x8_0000, 0, 16, 0xff, 0xff00, 0, 0]),
            (Format::V16U16, [0x8_0000, 0, 32, 0xffff, 0xffff_0000, 0, 0]),
            (
                Format::Q8W8V8U8,
                [0x8_0000, 0, 32, 0xff, 0xff00, 0xff_0000, 0xff00_0000],
            ),
            (
                Format::A2W10V10U10,
                [0x8_0001, 0, 32, 0x3ff, 0xf_fc00, 0x3ff0_0000, 0xc000_0000],
            ),
            (
                Format::W11V11U10,
                [0x8_0000, 0, 32, 0x3ff, 0x1f_fc00, 0xffe0_0000, 0],
            ),
            (Format::L6V5U5, [0x4_0000, 0, 16, 0x1f, 0x3e0, 0xfc00, 0]),
            (
                Format::X8L8V8U8,
                [0x4_0000, 0, 32, 0xff, 0xff00, 0xff_0000, 0],
            ),
            (
                Format::Dxt1,
                [4, u32::from_le_bytes(*b"DXT1"), 0, 0, 0, 0, 0],
            ),
            (
                Format::Dxt4,
                [4, u32::from_le_bytes(*b"DXT4"), 0, 0, 0, 0, 0],
            ),
            (Format::Q8W8V8U8, [4, 63, 0, 0, 0, 0, 0]),
            (Format::V16U16, [4, 64, 0, 0, 0, 0, 0]),
            (Format::CxV8U8, [4, 117, 0, 0, 0, 0, 0]),
            (Format::Rgba32F, [4, 116, 0, 0, 0, 0, 0]),
        ];
        for (format, pixel) in cases {
            let texture = decode_dds(&File::new(1, 1, pixel, &[0; 16]).bytes());
            assert_eq!(
                texture.map(|texture| texture.format()),
                Ok(format),
                "{pixel:x?}"
            );
        }
        assert!(decode_dds(&File::new(1, 1, [4, 999, 0, 0, 0, 0, 0], &[0; 16]).bytes()).is_err());
        assert!(decode_dds(&File::new(1, 1, [0x40, 0, 32, 1, 2, 4, 0], &[0; 16]).bytes()).is_err());
    }

    #[test]
    fn a_signed_texel() {
        let file = File::new(1, 1, [0x8_0000, 0, 16, 0xff, 0xff00, 0, 0], &[0x80, 0x7f]);
        assert_eq!(
            decode_dds(&file.bytes()).unwrap().texel(0, 0, 0, 0, 0),
            Some([-1.0, 1.0, 1.0, 1.0])
        );
    }

    #[test]
    fn cube_faces_are_sorted_out_of_their_mip_chains() {
        // Face f: level 0 (2×2) all bytes 10f, level 1 (1×1) all bytes 10f + 1.
        let data: Vec<u8> = (0..6u8)
            .flat_map(|face| [[face * 10; 16].to_vec(), vec![face * 10 + 1; 4]].concat())
            .collect();
        let mut file = File::new(2, 2, ARGB, &data);
        (file.levels, file.caps2) = (2, 0xfe00);
        let cube = decode_dds(&file.bytes()).unwrap();
        assert_eq!((cube.kind(), cube.level_count()), (TextureKind::Cube, 2));
        for face in 0..6 {
            assert_eq!(
                cube.texel(face, 0, 1, 1, 0),
                Some([face as f32 * 10.0 / 255.0; 4])
            );
            assert_eq!(
                cube.texel(face, 1, 0, 0, 0),
                Some([(face as f32 * 10.0 + 1.0) / 255.0; 4])
            );
        }
        file.caps2 = 0x200 | 0x400;
        assert!(
            decode_dds(&file.bytes())
                .unwrap_err()
                .to_string()
                .contains("six faces")
        );
    }

    #[test]
    fn a_volume_with_mips() {
        let data: Vec<u8> = (0..8u8).chain([99]).flat_map(|v| [v; 4]).collect();
        let mut file = File::new(2, 2, ARGB, &data);
        (file.size[2], file.levels, file.caps2) = (2, 2, 0x20_0000);
        let volume = decode_dds(&file.bytes()).unwrap();
        assert_eq!(volume.size(), [2, 2, 2]);
        assert_eq!(volume.texel(0, 0, 1, 0, 1), Some([5.0 / 255.0; 4]));
        assert_eq!(volume.texel(0, 1, 0, 0, 0), Some([99.0 / 255.0; 4]));
    }

    #[test]
    fn a_dxt1_file_and_the_later_header() {
        // c0 = white, every code 0.
        let block = [0xff, 0xff, 0, 0, 0, 0, 0, 0];
        let old = File::new(
            4,
            4,
            [4, u32::from_le_bytes(*b"DXT1"), 0, 0, 0, 0, 0],
            &block,
        );
        assert_eq!(
            decode_dds(&old.bytes()).unwrap().texel(0, 0, 3, 3, 0),
            Some([1.0; 4])
        );
        // DXGI 51 = R8G8_SNORM, dimension 3 = 2D, no flags, one element.
        let mut data: Vec<u8> = [51u32, 3, 0, 1, 0]
            .into_iter()
            .flat_map(u32::to_le_bytes)
            .collect();
        data.extend([0x81, 0x40]);
        let new = File::new(
            1,
            1,
            [4, u32::from_le_bytes(*b"DX10"), 0, 0, 0, 0, 0],
            &data,
        );
        let texture = decode_dds(&new.bytes()).unwrap();
        assert_eq!(
            texture.texel(0, 0, 0, 0, 0),
            Some([-1.0, 64.0 / 127.0, 1.0, 1.0])
        );
    }

    #[test]
    fn broken_files_are_errors() {
        let bytes = File::new(2, 2, ARGB, &[7; 16]).bytes();
        for length in 0..bytes.len() {
            assert!(decode_dds(&bytes[..length]).is_err(), "{length} bytes");
        }
        let mut huge = File::new(16384, 16384, ARGB, &[]);
        assert!(decode_dds(&huge.bytes()).is_err());
        huge.size = [u32::MAX, u32::MAX, u32::MAX];
        huge.caps2 = 0x20_0000;
        assert!(decode_dds(&huge.bytes()).is_err());
        let mut many = File::new(2, 2, ARGB, &[7; 64]);
        many.levels = u32::MAX;
        assert!(decode_dds(&many.bytes()).is_err());
    }

    proptest::proptest! {
        #[test]
        fn damaged_headers_do_not_panic(at in 0usize..128, value: u32, caps2: u32) {
            let mut file = File::new(2, 2, ARGB, &[7; 64]);
            file.caps2 = caps2;
            let mut bytes = file.bytes();
            bytes[at..at + 4].copy_from_slice(&value.to_le_bytes());
            let _ = decode_dds(&bytes);
        }
    }
}

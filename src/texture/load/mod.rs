//! Textures from the bytes of files: pictures, DDS, and cubes put together from pictures.

mod cube;
#[cfg(feature = "scene")]
mod dds;

use std::io::Cursor;

use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits};

use super::{Format, MAX_BYTES, MAX_EDGE, Texture, TextureError, TextureKind};

pub use cube::{cube_from_cross, cube_from_equirectangular, cube_from_faces};
#[cfg(feature = "scene")]
pub use dds::{decode_dds, decode_dds_signed};

/// How many times larger than its file a picture may be. The densest honest case is a PNG of one colour and one bit a
/// pixel: compression 1032:1, times 32 for what a pixel becomes.
const MAX_EXPANSION: u64 = 1032 * 32;

fn broken(problem: impl std::fmt::Display) -> TextureError {
    TextureError::File {
        what: "picture",
        problem: problem.to_string(),
    }
}

/// The 2D texture, one level, of a PNG, JPEG, BMP, TGA or Radiance HDR picture.
///
/// The content tells the kind of file; `extension` (without a dot, any case) is needed only for TGA, which
/// has no mark of its own. HDR becomes `rgba32f`, everything else `rgba8` (16-bit channels are rounded to 8).
/// A picture without alpha has alpha 1. No colour space is converted, as Direct3D 8 converted none.
///
/// # Errors
/// [`TextureError::File`] for broken or unknown files, and those that claim a size far beyond what their bytes could
/// hold; the size limits of textures. Memory is taken in proportion to the bytes given.
pub fn decode_image(bytes: &[u8], extension: Option<&str>) -> Result<Texture, TextureError> {
    let hint = extension.and_then(ImageFormat::from_extension);
    let guess = image::guess_format(bytes).ok();
    // A TGA may begin like a kind that is not read here.
    let format = guess.filter(ImageFormat::reading_enabled).or(hint);
    let format =
        format.ok_or_else(|| broken("neither its content nor its name tells a known kind"))?;
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    let mut limits = Limits::default();
    limits.max_image_width = Some(MAX_EDGE);
    limits.max_image_height = Some(MAX_EDGE);
    limits.max_alloc = Some(MAX_BYTES);
    reader.limits(limits);
    let decoder = reader.into_decoder().map_err(broken)?;
    let (width, height) = decoder.dimensions();
    let claimed = decoder.total_bytes();
    if claimed > MAX_EXPANSION.saturating_mul(bytes.len() as u64) {
        return Err(broken(format!(
            "{width}x{height} pixels cannot come from {} bytes",
            bytes.len()
        )));
    }
    let picture = DynamicImage::from_decoder(decoder).map_err(broken)?;
    let size = [width, height, 1];
    match picture {
        DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_) => {
            let picture = picture.into_rgba32f();
            let texels: Vec<[f32; 4]> = picture.pixels().map(|pixel| pixel.0).collect();
            Texture::from_texels(TextureKind::Texture2D, Format::Rgba32F, size, &[texels])
        }
        _ => Texture::from_rgba8(width, height, picture.into_rgba8().as_raw()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(picture: &DynamicImage, format: ImageFormat) -> Vec<u8> {
        let mut bytes = Cursor::new(Vec::new());
        picture.write_to(&mut bytes, format).unwrap();
        bytes.into_inner()
    }

    fn two_pixels() -> DynamicImage {
        let picture = image::RgbImage::from_raw(2, 1, vec![255, 0, 51, 0, 102, 255]).unwrap();
        DynamicImage::ImageRgb8(picture)
    }

    #[test]
    fn pictures_of_each_kind() {
        for (format, hint) in [
            (ImageFormat::Png, None),
            (ImageFormat::Bmp, None),
            (ImageFormat::Tga, Some("TGA")),
        ] {
            let bytes = written(&two_pixels(), format);
            let texture = decode_image(&bytes, hint).unwrap();
            assert_eq!(
                (texture.format(), texture.size()),
                (Format::Rgba8, [2, 1, 1])
            );
            assert_eq!(
                texture.texel(0, 0, 0, 0, 0),
                Some([1.0, 0.0, 0.2, 1.0]),
                "{format:?}"
            );
            assert_eq!(
                texture.texel(0, 0, 1, 0, 0),
                Some([0.0, 0.4, 1.0, 1.0]),
                "{format:?}"
            );
        }
        let jpeg = written(&two_pixels(), ImageFormat::Jpeg);
        assert_eq!(decode_image(&jpeg, None).unwrap().size(), [2, 1, 1]);
    }

    #[test]
    fn hdr_keeps_values_above_one() {
        // A flat (uncompressed) Radiance pixel: mantissas 128, 64, 0 with exponent 130: 128/256·2^(130−128) = 2, 1, 0.
        let mut bytes = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n".to_vec();
        bytes.extend([128, 64, 0, 130]);
        let texture = decode_image(&bytes, Some("hdr")).unwrap();
        assert_eq!(texture.format(), Format::Rgba32F);
        assert_eq!(texture.texel(0, 0, 0, 0, 0), Some([2.0, 1.0, 0.0, 1.0]));
    }

    #[test]
    fn broken_pictures_are_errors() {
        let png = written(&two_pixels(), ImageFormat::Png);
        for length in 0..png.len() - 12 {
            assert!(
                decode_image(&png[..length], Some("png")).is_err(),
                "{length} bytes"
            );
        }
        assert!(decode_image(b"hello", None).is_err());
        // A TGA header that claims 16000×16000 true-colour pixels and holds none.
        let mut tga = [0u8; 18];
        tga[2] = 2;
        tga[12..16].copy_from_slice(&[0x80, 0x3e, 0x80, 0x3e]);
        tga[16] = 24;
        let message = decode_image(&tga, Some("tga")).unwrap_err().to_string();
        assert!(message.contains("16000x16000"), "{message}");
    }
}

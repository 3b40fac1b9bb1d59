//! Letters on pictures: the Noto Sans Mono of the crate `noto-sans-mono-bitmap`.

use image::RgbaImage;
use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster, get_raster_width};

const SIZE: RasterHeight = RasterHeight::Size16;
const WEIGHT: FontWeight = FontWeight::Regular;

/// The width of every letter in pixels.
pub(super) const WIDTH: u32 = get_raster_width(WEIGHT, SIZE) as u32;
/// The height of a row.
pub(super) const HEIGHT: u32 = SIZE.val() as u32;

/// The colour of letters.
const INK: [u8; 3] = [230, 230, 230];

/// Writes a row of letters, its upper left corner here. What is outside of the picture is left out; letters that the font
/// does not have become question marks.
pub(super) fn write(picture: &mut RgbaImage, [x, y]: [u32; 2], text: &str) {
    for (number, letter) in (0..).zip(text.chars()) {
        let glyph = get_raster(letter, WEIGHT, SIZE).or_else(|| get_raster('?', WEIGHT, SIZE));
        let left = x + number * WIDTH;
        for (row, shades) in (y..).zip(glyph.iter().flat_map(|glyph| glyph.rows())) {
            for (column, shade) in (left..).zip(shades) {
                if let Some(pixel) = picture.get_pixel_mut_checked(column, row) {
                    for (channel, ink) in pixel.0.iter_mut().zip(INK) {
                        let mixed = u32::from(*channel) * u32::from(255 - shade)
                            + u32::from(ink) * u32::from(*shade);
                        *channel = (mixed / 255) as u8;
                    }
                }
            }
        }
    }
}

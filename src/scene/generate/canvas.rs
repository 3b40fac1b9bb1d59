//! Painting a picture point by point.

use image::RgbaImage;

use super::noise::mix;

/// Red, green, blue and alpha, 0 to 1.
pub(super) type Color = [f32; 4];

/// An opaque colour.
pub(super) const fn rgb(r: f32, g: f32, b: f32) -> Color {
    [r, g, b, 1.0]
}

/// Between two colours.
pub(super) fn blend(a: Color, b: Color, t: f32) -> Color {
    std::array::from_fn(|i| mix(a[i], b[i], t))
}

/// A colour lighter or darker by a factor, alpha left alone.
pub(super) fn shade([r, g, b, a]: Color, factor: f32) -> Color {
    [r * factor, g * factor, b * factor, a]
}

/// One value per texel, worked out from the texture coordinates of the texel's centre. Rows are spread over all cores with
/// the feature `parallel`.
pub(super) fn plot<T: Send + Copy + Default>(
    size: [u32; 2],
    value: impl Fn(f32, f32) -> T + Sync,
) -> Vec<T> {
    let [width, height] = size;
    let mut texels = vec![T::default(); width as usize * height as usize];
    let row = |(y, row): (usize, &mut [T])| {
        let v = (y as f32 + 0.5) / height as f32;
        for (x, texel) in row.iter_mut().enumerate() {
            *texel = value((x as f32 + 0.5) / width as f32, v);
        }
    };
    let stride = (width as usize).max(1);
    #[cfg(feature = "parallel")]
    {
        use rayon::prelude::*;
        texels.par_chunks_mut(stride).enumerate().for_each(row);
    }
    #[cfg(not(feature = "parallel"))]
    texels.chunks_mut(stride).enumerate().for_each(row);
    texels
}

/// Paints a picture: `color` is asked for the texture coordinates of each texel's centre.
pub(super) fn paint(size: [u32; 2], color: impl Fn(f32, f32) -> Color + Sync) -> RgbaImage {
    let texels = plot(size, |u, v| color(u, v).map(to_byte));
    RgbaImage::from_raw(size[0], size[1], texels.into_flattened()).unwrap_or_default()
}

/// 0 to 1 as 0 to 255, to the nearest, halves up; what lies outside is clamped.
pub(super) fn to_byte(x: f32) -> u8 {
    (x.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
}

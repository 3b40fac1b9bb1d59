//! Height fields and the normal maps made from them.

use image::{GrayImage, RgbaImage};

use super::canvas::{paint, to_byte};
use super::noise::mix;

/// A relief: one height a texel, row by row.
#[derive(Debug, Clone, PartialEq)]
pub struct HeightField {
    size: [u32; 2],
    heights: Vec<f32>,
}

impl HeightField {
    /// A relief from its heights, row by row from the top; `None` if their number is not width × height.
    pub fn new(size: [u32; 2], heights: Vec<f32>) -> Option<Self> {
        let count = (size[0] as usize).checked_mul(size[1] as usize)?;
        (count > 0 && heights.len() == count).then_some(Self { size, heights })
    }

    /// Width and height in texels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The height of a texel; outside the picture the edge goes on, or the other side with `wrap`.
    fn at(&self, x: i64, y: i64, wrap: bool) -> f32 {
        let [width, height] = self.size.map(i64::from);
        let (x, y) = if wrap {
            (x.rem_euclid(width), y.rem_euclid(height))
        } else {
            (x.clamp(0, width - 1), y.clamp(0, height - 1))
        };
        self.heights
            .get((y * width + x) as usize)
            .copied()
            .unwrap_or(0.0)
    }

    /// The relief as a grey picture: height 0 black, 1 white, clamped.
    pub fn to_image(&self) -> GrayImage {
        let bytes = self.heights.iter().map(|h| to_byte(*h)).collect();
        GrayImage::from_raw(self.size[0], self.size[1], bytes).unwrap_or_default()
    }

    /// The normal map of the relief: `(-∂h/∂x · strength, -∂h/∂y · strength, 1)`, normalised, stored as `n · 0.5 + 0.5` in
    /// red, green and blue with alpha 1. x grows along u, y along v (down), z out of the picture. Derivatives are central
    /// differences per texel, so `strength` is how many texels high a height of 1 is. `wrap` joins opposite edges.
    pub fn normal_map(&self, strength: f32, wrap: bool) -> RgbaImage {
        let [width, height] = self.size;
        let slope = |high: f32, low: f32| -(high - low) * 0.5 * strength;
        let mut picture = RgbaImage::new(width, height);
        for (x, y, texel) in picture.enumerate_pixels_mut() {
            let (x, y) = (i64::from(x), i64::from(y));
            let n = glam::Vec3::new(
                slope(self.at(x + 1, y, wrap), self.at(x - 1, y, wrap)),
                slope(self.at(x, y + 1, wrap), self.at(x, y - 1, wrap)),
                1.0,
            );
            let [r, g, b] = n
                .normalize_or(glam::Vec3::Z)
                .to_array()
                .map(|c| to_byte(mix(0.5, 1.0, c)));
            texel.0 = [r, g, b, 255];
        }
        picture
    }
}

impl From<&GrayImage> for HeightField {
    /// Black is height 0, white 1.
    fn from(picture: &GrayImage) -> Self {
        let heights = picture
            .as_raw()
            .iter()
            .map(|b| f32::from(*b) / 255.0)
            .collect();
        Self {
            size: [picture.width(), picture.height()],
            heights,
        }
    }
}

/// The normal map of a flat surface: (128, 128, 255) everywhere.
pub(super) fn flat_normal(size: [u32; 2]) -> RgbaImage {
    paint(size, |_, _| [0.5, 0.5, 1.0, 1.0])
}

//! Textures that hold numbers: what listings of the gallery read instead of computing it.

use image::{Rgb, RgbImage};
use std::error::Error;

/// Texels of the table of square roots.
const ROOTS: u32 = 4096;

/// Writes the tables into the folders that use them.
///
/// # Errors
/// Files that cannot be written.
pub(crate) fn write() -> Result<(), Box<dyn Error>> {
    roots().save("asm/sphere/roots.png")?;
    ripples().save("asm/planar/ripples.png")?;
    Ok(())
}

/// The square root of each texel's coordinate, its centre: red + green / 256.
fn roots() -> RgbImage {
    RgbImage::from_fn(ROOTS, 1, |x, _| {
        let root = ((f64::from(x) + 0.5) / f64::from(ROOTS)).sqrt() * 255.0;
        let rest = (root.fract() * 256.0).floor();
        Rgb([root as u8, rest.min(255.0) as u8, 0])
    })
}

/// The edge of the ripples' normal map in texels.
const RIPPLES: u32 = 128;
/// Waves: how many across and down the map, so that it can be repeated; and the slope of each.
const WAVES: [([f64; 2], f64); 4] = [
    ([3.0, 1.0], 0.035),
    ([-1.0, 2.0], 0.03),
    ([2.0, -3.0], 0.02),
    ([1.0, 5.0], 0.012),
];

/// Normals of water: 0 to 1 for -1 to 1, x along u and y along v.
fn ripples() -> RgbImage {
    RgbImage::from_fn(RIPPLES, RIPPLES, |x, y| {
        let [u, v] = [x, y].map(|at| (f64::from(at) + 0.5) / f64::from(RIPPLES));
        let mut slope = [0.0, 0.0];
        for ([across, down], height) in WAVES {
            let wave = height * (std::f64::consts::TAU * (across * u + down * v)).cos();
            let length = f64::hypot(across, down);
            slope = [slope[0] + wave * across / length, slope[1] + wave * down / length];
        }
        let normal = glam::DVec3::new(slope[0], slope[1], 1.0).normalize();
        Rgb((normal * 127.5 + 128.0).to_array().map(|part| part as u8))
    })
}

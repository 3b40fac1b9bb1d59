//! Textures that hold numbers: what listings of the gallery read instead of computing it.

use image::{Rgb, RgbImage};
use std::error::Error;

/// Texels of the table of square roots.
const ROOTS: u32 = 256;

/// Writes the tables into the folders that use them.
///
/// # Errors
/// Files that cannot be written.
pub(crate) fn write() -> Result<(), Box<dyn Error>> {
    roots().save("asm/sphere/roots.png")?;
    ripples().save("asm/planar/ripples.png")?;
    std::fs::write("asm/showcases/waves.toml", waves())?;
    Ok(())
}

/// The square root of each texel's coordinate, its centre: what it is above 0.9, times ten.
fn roots() -> RgbImage {
    RgbImage::from_fn(ROOTS, 1, |x, _| {
        let root = ((f64::from(x) + 0.5) / f64::from(ROOTS)).sqrt();
        Rgb([((root - 0.9) * 2550.0 + 0.5).clamp(0.0, 255.0) as u8; 3])
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
        let (slope, _) = wave([u, v]);
        let normal = glam::DVec3::new(slope[0], slope[1], 1.0).normalize();
        Rgb((normal * 127.5 + 128.0).to_array().map(|part| part as u8))
    })
}

/// Slope of the water at a place of the map, and its height, both about -0.1 to 0.1.
fn wave([u, v]: [f64; 2]) -> ([f64; 2], f64) {
    let (mut slope, mut height) = ([0.0, 0.0], 0.0);
    for ([across, down], part) in WAVES {
        let (sine, cosine) = (std::f64::consts::TAU * (across * u + down * v)).sin_cos();
        let length = f64::hypot(across, down);
        slope = [
            slope[0] + part * cosine * across / length,
            slope[1] + part * cosine * down / length,
        ];
        height += part * sine;
    }
    (slope, height)
}

/// The edge of the map of [`waves`] in texels.
const PUSHED: u32 = 32;

/// The same water as `X8L8V8U8`: how far it pushes what is seen through it, signed, and how bright it makes it.
fn waves() -> String {
    let mut text = String::from(
        "# Waves for texbeml, X8L8V8U8: 0x00 luminance, v, u. Written by `cargo run --release --example gallery`.\n\n\
         [textures.waves]\nkind = \"2d\"\nformat = \"x8l8v8u8\"\n",
    );
    text += &format!("size = [{PUSHED}, {PUSHED}]\nraw = [\n");
    for y in 0..PUSHED {
        for x in 0..PUSHED {
            let place = [x, y].map(|at| (f64::from(at) + 0.5) / f64::from(PUSHED));
            let ([across, down], height) = wave(place);
            let signed =
                |slope: f64| u32::from((slope * 10.0 * 127.0).clamp(-127.0, 127.0) as i8 as u8);
            let luminance = ((0.5 + 5.0 * height) * 255.0).clamp(0.0, 255.0) as u32;
            let word = luminance << 16 | signed(down) << 8 | signed(across);
            text += &format!("0x{word:08x},{}", if x % 8 == 7 { "\n" } else { " " });
        }
    }
    text + "]\n"
}

//! The picture of the differences.

use super::{RgbaImage, Target};
use image::Rgba;

/// The colours of small and of great differences, inside triangles and on edges.
const INSIDE: [[f32; 3]; 2] = [[255.0, 220.0, 0.0], [255.0, 0.0, 0.0]];
const EDGES: [[f32; 3]; 2] = [[40.0, 100.0, 255.0], [0.0, 255.0, 255.0]];
/// Steps of 1/255 from which on a difference has the colour of great ones.
const GREAT: f32 = 32.0;
/// Steps from which on nothing of the picture shines through.
const COVERS: f32 = 8.0;

/// The picture of the CPU in dark grey, and over it the pixels that differ: inside triangles from yellow to red, on edges
/// from blue to cyan. A difference of 1/255, of which there are many, is only a tinge. Both scales are logarithmic.
pub(super) fn differences(cpu: &Target, gpu: &RgbaImage) -> RgbaImage {
    let mut picture = cpu.to_image();
    for ((x, y, pixel), other) in picture.enumerate_pixels_mut().zip(gpu.pixels()) {
        let [r, g, b, _] = pixel.0.map(f32::from);
        let channels = pixel.0.into_iter().zip(other.0);
        let difference = channels.map(|(a, b)| a.abs_diff(b)).max().unwrap_or(0);
        // Half of the brightness that an eye sees.
        let grey = (0.299 * r + 0.587 * g + 0.114 * b) / 2.0;
        let steps = f32::from(difference);
        let [small, great] = if cpu.inside(x, y) { INSIDE } else { EDGES };
        let share = (steps.max(1.0).ln() / GREAT.ln()).min(1.0);
        let opaque = ((1.0 + steps).ln() / (1.0 + COVERS).ln()).min(1.0).powi(2);
        let channel = |i: usize| {
            let color = small[i] + (great[i] - small[i]) * share;
            (grey + (color - grey) * opaque).round() as u8
        };
        *pixel = Rgba([channel(0), channel(1), channel(2), 255]);
    }
    picture
}

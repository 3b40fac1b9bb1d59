//! The texture of the treasure chest, by the regions that the mesh uses.

use image::RgbaImage;

use crate::mesh::ChestRegion;

use super::Parameters;
use super::canvas::{Color, blend, paint, rgb, shade};
use super::noise::{fractal, mix, smooth, value};
use super::wall::wood;

/// Paints the atlas: colours are light wood, dark wood, iron, brass; cells[1] is the number of planks.
pub(super) fn atlas(p: &Parameters) -> RgbaImage {
    paint(p.size, |u, v| {
        let inside = |region: &ChestRegion| {
            let (low, high) = region.corners();
            u >= low.x && u < high.x && v >= low.y && v < high.y
        };
        let Some(region) = ChestRegion::ALL.into_iter().find(inside) else {
            return rgb(0.0, 0.0, 0.0);
        };
        let (low, high) = region.corners();
        let (s, t) = (
            (u - low.x) / (high.x - low.x),
            (v - low.y) / (high.y - low.y),
        );
        match region {
            ChestRegion::Wood => planks(p, s, t),
            ChestRegion::Iron => metal(p, s, t, p.color(2), 0.75),
            ChestRegion::Brass => metal(p, s, t, p.color(3), 0.35),
            ChestRegion::Lock => lock(p, s, t),
            ChestRegion::Dark => shade(
                rgb(0.05, 0.035, 0.025),
                0.6 + 0.6 * fractal(s, t, [6, 6], 3, p.seed),
            ),
        }
    })
}

fn planks(p: &Parameters, s: f32, t: f32) -> Color {
    let count = p.cells[1];
    let y = t * count as f32;
    let side = (y - y.floor()).min(1.0 - (y - y.floor()));
    let edge = mix(0.15, 1.0, smooth(0.01, 0.05, side)) * mix(0.7, 1.0, smooth(0.0, 0.25, side));
    shade(
        wood(
            s,
            t,
            y.floor() as u32,
            count,
            p.seed,
            [p.color(0), p.color(1)],
        ),
        edge,
    )
}

/// Hammered metal; `wear` is how far rust or tarnish darkens it.
fn metal(p: &Parameters, s: f32, t: f32, color: Color, wear: f32) -> Color {
    let dents = value(s, t, [14, 14], p.seed ^ 0x1303);
    let tarnish = fractal(s, t, [5, 5], 5, p.seed ^ 0x4457);
    shade(color, (0.7 + 0.45 * dents) * mix(1.0, 0.45 + tarnish, wear))
}

/// The lock plate: an engraved rim, four rivets, and a keyhole.
fn lock(p: &Parameters, s: f32, t: f32) -> Color {
    let plate = metal(p, s, t, p.color(3), 0.35);
    let (x, y) = (s - 0.5, t - 0.5);
    let edge = 0.5 - x.abs().max(y.abs());
    let groove = mix(0.35, 1.0, smooth(0.0, 0.02, (edge - 0.09).abs()))
        * mix(0.5, 1.0, smooth(0.0, 0.04, edge));
    let rivet = ((x.abs() - 0.33).powi(2) + (y.abs() - 0.33).powi(2)).sqrt();
    let rivets = mix(1.35, 1.0, smooth(0.03, 0.045, rivet))
        * mix(0.45, 1.0, smooth(0.0, 0.015, (rivet - 0.055).abs()));
    // A round hole over a slot that widens downwards.
    let hole = (x * x + (y + 0.04).powi(2)).sqrt() - 0.075;
    let slot = if (-0.04..0.2).contains(&y) {
        x.abs() - 0.03 - 0.12 * y.max(0.0)
    } else {
        1.0
    };
    let key = hole.min(slot);
    let shield = ((x / 0.2).powi(2) + ((y - 0.03) / 0.27).powi(2)).sqrt();
    let ring = mix(0.4, 1.0, smooth(0.0, 0.05, (shield - 1.0).abs()));
    blend(
        rgb(0.02, 0.015, 0.01),
        shade(plate, groove * rivets * ring),
        smooth(-0.005, 0.012, key),
    )
}

//! The leaded window: one layout, from which the base map, the gloss map and the relief are made, so that they agree.
//!
//! The window is laid out in units of its shorter side, so that lead lines are as thick and the rosette as round in a tall
//! window as in a square one. From outside to inside: a border of small panes with square corners; diamonds; in each corner
//! a round pane; in the middle a rosette: a ring of 24 panes around twelve equal circles through the centre, whose
//! crossings make the petals, and a boss where they would all meet.

use std::f32::consts::TAU;

use glam::Vec2;

use super::canvas::{Color, blend, rgb, shade};
use super::noise::{fractal, hash, mix, random, smooth, value};

/// Half the width of a lead came.
const LEAD: f32 = 0.0062;
/// How far solder fills the corners where cames meet.
const SOLDER: f32 = 0.012;
const BORDER: f32 = 0.07;
const PETALS: u32 = 12;
/// Radius of the circle that holds the petals, and of the ring of panes around it.
const ROSETTE: f32 = 0.33;
const RING: f32 = 0.4;
const BOSS: f32 = 0.062;

const RUBY: Color = rgb(0.78, 0.03, 0.07);
const ORANGE: Color = rgb(0.95, 0.36, 0.03);
const GOLD: Color = rgb(0.98, 0.72, 0.10);
const EMERALD: Color = rgb(0.04, 0.52, 0.20);
const TEAL: Color = rgb(0.02, 0.50, 0.55);
const COBALT: Color = rgb(0.05, 0.14, 0.72);
const VIOLET: Color = rgb(0.40, 0.07, 0.55);
const STRAW: Color = rgb(0.93, 0.86, 0.58);
const MINT: Color = rgb(0.66, 0.87, 0.72);

/// What lies at a point of the window.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Spot {
    /// Distance to the middle of the nearest came, less where cames meet, because of the solder.
    pub(super) to_lead: f32,
    /// A number that all points of a pane share.
    pane: u32,
    /// The pane's glass.
    color: Color,
}

/// The two nearest cames so far.
struct Cames(f32, f32);

impl Cames {
    fn came(&mut self, distance: f32) {
        let d = distance.abs();
        if d < self.0 {
            *self = Self(d, self.0);
        } else if d < self.1 {
            self.1 = d;
        }
    }

    /// The distance to the nearest came, lowered smoothly where the second one is as near.
    fn soldered(&self) -> f32 {
        let h = (SOLDER - (self.1 - self.0)).max(0.0) / SOLDER;
        self.0 - h * h * SOLDER * 0.25
    }
}

/// A window of a given shape.
#[derive(Debug, Clone, Copy)]
pub(super) struct Window {
    /// Width and height in units of the shorter side.
    extent: Vec2,
    /// Texels a unit.
    resolution: f32,
    seed: u32,
}

impl Window {
    pub(super) fn new(size: [u32; 2], seed: u32) -> Self {
        let shorter = size[0].min(size[1]).max(1) as f32;
        Self {
            extent: Vec2::new(size[0] as f32, size[1] as f32) / shorter,
            resolution: shorter,
            seed,
        }
    }

    /// The layout.
    pub(super) fn spot(&self, u: f32, v: f32) -> Spot {
        let p = Vec2::new(u, v) * self.extent;
        let mut cames = Cames(f32::MAX, f32::MAX);
        // The frame's own came, half of it inside the picture.
        let edge = p.min(self.extent - p);
        cames.came(edge.x);
        cames.came(edge.y);
        let inward = edge.min_element();
        let (pane, color) = if inward < BORDER {
            self.border(p, edge, &mut cames)
        } else {
            self.field(p, &mut cames)
        };
        if edge.max_element() >= BORDER {
            cames.came(inward - BORDER);
        }
        Spot {
            to_lead: cames.soldered(),
            pane,
            color,
        }
    }

    /// The border: square corners, and between them panes of about twice the border's width.
    fn border(&self, p: Vec2, edge: Vec2, cames: &mut Cames) -> (u32, Color) {
        if edge.max_element() < BORDER {
            cames.came(edge.x - BORDER);
            cames.came(edge.y - BORDER);
            return (1, GOLD);
        }
        let upright = edge.x < edge.y;
        let (along, length) = if upright {
            (p.y, self.extent.y)
        } else {
            (p.x, self.extent.x)
        };
        let run = length - 2.0 * BORDER;
        // Odd, so that both ends of a side have the same colour.
        let count = ((run / (2.0 * BORDER) / 2.0).floor() * 2.0 + 1.0).max(1.0);
        let step = run / count;
        let place = (along - BORDER) / step;
        cames.came((place - place.round()) * step);
        let number = place.floor().clamp(0.0, count - 1.0) as u32;
        let side = if upright {
            2 + u32::from(p.x > self.extent.x * 0.5)
        } else {
            4 + u32::from(p.y > self.extent.y * 0.5)
        };
        (
            number * 8 + side,
            if number.is_multiple_of(2) {
                COBALT
            } else {
                RUBY
            },
        )
    }

    /// Everything inside the border.
    fn field(&self, p: Vec2, cames: &mut Cames) -> (u32, Color) {
        let q = p - self.extent * 0.5;
        let r = q.length();
        cames.came(r - RING);
        if r < RING {
            return rosette(q, r, cames);
        }
        // Round panes halfway between the ring and the corners.
        let corner = self.extent * 0.5 - BORDER;
        let seat = q.abs() - (corner - Vec2::splat(0.082));
        let distance = seat.length();
        cames.came(distance - 0.058);
        if distance < 0.058 {
            cames.came(distance - 0.03);
            return if distance < 0.03 {
                (101, GOLD)
            } else {
                (102, RUBY)
            };
        }
        // Diamonds: two families of parallel cames, the diamonds half as wide again as high.
        let (width, height) = (0.105, 0.15);
        let (a, b) = (q.x / width + q.y / height, q.x / width - q.y / height);
        let scale = Vec2::new(1.0 / width, 1.0 / height).length();
        cames.came((a - a.round()) / scale);
        cames.came((b - b.round()) / scale);
        let (i, j) = (a.floor() as i32 as u32, b.floor() as i32 as u32);
        let color = match random(i, j, self.seed ^ 0xD1A) {
            x if x < 0.5 => STRAW,
            x if x < 0.85 => MINT,
            _ => blend(GOLD, STRAW, 0.4),
        };
        (hash(i, j, 0xD1A), color)
    }

    /// How much of a texel is lead, 0 to 1, with an edge as soft as a texel.
    pub(super) fn lead(&self, spot: &Spot) -> f32 {
        let soft = (0.75 / self.resolution).min(LEAD);
        1.0 - smooth(LEAD - soft, LEAD + soft, spot.to_lead)
    }

    /// Base map: the colour of the glass and of the lead.
    pub(super) fn base(&self, u: f32, v: f32) -> Color {
        let spot = self.spot(u, v);
        let p = Vec2::new(u, v) * self.extent;
        let seed = self.seed ^ spot.pane.wrapping_mul(0x9E37);
        // Every pane is cut from a sheet of its own: own lightness, own direction of its streaks.
        let (sin, cos) = (random(spot.pane, 1, self.seed) * TAU).sin_cos();
        let along = Vec2::new(p.x * cos + p.y * sin, p.y * cos - p.x * sin);
        let streaks = fractal(along.x, along.y, [3, 14], 4, seed);
        let cloud = fractal(p.x, p.y, [9, 9], 3, self.seed ^ 0x77);
        let sheet = mix(0.82, 1.12, random(spot.pane, 2, self.seed));
        let light = sheet * (0.58 + 0.34 * smooth(0.22, 0.78, streaks) + 0.42 * cloud);
        // Glass is thicker and dirtier towards its lead.
        let rim = mix(0.55, 1.0, smooth(LEAD, LEAD + 0.022, spot.to_lead));
        // Where it is lightest, coloured glass also pales a little.
        let pale = smooth(0.6, 0.85, streaks) * 0.18;
        let glass = shade(blend(spot.color, rgb(1.0, 0.97, 0.9), pale), light * rim);
        let round = (spot.to_lead / LEAD).clamp(0.0, 1.0);
        let grime = value(p.x, p.y, [90, 90], self.seed ^ 0x1EAD);
        let lead = shade(
            rgb(0.105, 0.105, 0.115),
            (1.25 - 0.7 * round) * (0.75 + 0.5 * grime),
        );
        blend(glass, lead, self.lead(&spot))
    }

    /// Gloss map: bright on glass, dark on lead, grey.
    pub(super) fn gloss(&self, u: f32, v: f32) -> Color {
        let spot = self.spot(u, v);
        let p = Vec2::new(u, v) * self.extent;
        let wear = fractal(p.x, p.y, [7, 7], 4, self.seed ^ 0x6105);
        let glass = 0.72 + 0.22 * wear + 0.08 * (random(spot.pane, 3, self.seed) - 0.5);
        let g = mix(glass, 0.05, self.lead(&spot));
        rgb(g, g, g)
    }

    /// Height, 0 to 1: panes that swell and ripple a little below the rounded lead.
    pub(super) fn height(&self, u: f32, v: f32) -> f32 {
        let spot = self.spot(u, v);
        let p = Vec2::new(u, v) * self.extent;
        let seed = self.seed ^ spot.pane.wrapping_mul(0x85EB);
        let ripple = fractal(p.x, p.y, [11, 11], 2, seed) - 0.5;
        let hammer = value(p.x, p.y, [46, 46], self.seed ^ 0x4A33) - 0.5;
        let swell = smooth(0.0, 0.05, spot.to_lead);
        let glass = 0.28 + 0.16 * swell + 0.30 * ripple * swell + 0.035 * hammer;
        // A came is a rounded bar: a cosine, which meets the glass without an edge.
        let round = (spot.to_lead / (LEAD * 1.2)).clamp(0.0, 1.0);
        mix(glass, 1.0, 0.5 + 0.5 * (round * TAU * 0.5).cos())
    }
}

/// The rosette: how many of the twelve circles hold a point tells its ring, and which ones its petal.
fn rosette(q: Vec2, r: f32, cames: &mut Cames) -> (u32, Color) {
    let turn = (q.x.atan2(-q.y) / TAU).rem_euclid(1.0);
    cames.came(r - ROSETTE);
    if r >= ROSETTE {
        // Twice as many panes as petals around the petals.
        let place = turn * (2 * PETALS) as f32 + 0.5;
        cames.came((place - place.round()) / (2 * PETALS) as f32 * TAU * r);
        let number = place.floor() as u32 % (2 * PETALS);
        return (
            200 + number,
            if number.is_multiple_of(2) {
                GOLD
            } else {
                COBALT
            },
        );
    }
    cames.came(r - BOSS);
    if r < BOSS {
        cames.came(r - BOSS * 0.5);
        return if r < BOSS * 0.5 {
            (301, RUBY)
        } else {
            (302, GOLD)
        };
    }
    let (mut inside, mut mask) = (0_usize, 0_u32);
    for i in 0..PETALS {
        let (sin, cos) = (i as f32 / PETALS as f32 * TAU).sin_cos();
        let distance = q.distance(Vec2::new(sin, -cos) * (ROSETTE * 0.5)) - ROSETTE * 0.5;
        cames.came(distance);
        if distance < 0.0 {
            inside += 1;
            mask |= 1 << i;
        }
    }
    // From the rim to the boss.
    const RINGS: [Color; 7] = [TEAL, VIOLET, COBALT, EMERALD, GOLD, ORANGE, RUBY];
    (400 + mask, RINGS.get(inside).copied().unwrap_or(RUBY))
}

//! Walls and floors: bricks, stone, planks, plaster. All are seamless.

use image::RgbaImage;

use super::Parameters;
use super::canvas::{Color, blend, paint, rgb, shade};
use super::noise::{fractal, mix, random, smooth};

/// Rows of blocks with joints, every second row moved by half a block.
struct Masonry {
    /// Blocks in a row, and rows; rows are even, or the picture would not repeat.
    cells: [u32; 2],
    /// Half a joint, in parts of a row's height.
    joint: f32,
    seed: u32,
}

/// Where a point lies in [`Masonry`].
struct Block {
    /// Column and row.
    id: [u32; 2],
    /// 0 in the joint, 1 on the block.
    face: f32,
    /// 0 at the block's edge, 1 well inside.
    inner: f32,
}

impl Masonry {
    /// `aspect` is width by height of the picture, so that joints are as wide upright as level.
    fn at(&self, u: f32, v: f32, aspect: f32) -> Block {
        let [columns, rows] = self.cells.map(|c| c as f32);
        // Edges that are not quite straight, by a noise that repeats.
        let rough = 0.10 * (fractal(u, v, self.cells.map(|c| c * 3), 3, self.seed ^ 0xED6E) - 0.5);
        let y = v * rows;
        let row = y.floor();
        let x = u * columns + 0.5 * row.rem_euclid(2.0);
        let (fx, fy) = (x - x.floor(), y - row);
        let block_width = aspect * rows / columns;
        let edge = (fx.min(1.0 - fx) * block_width).min(fy.min(1.0 - fy)) + rough;
        Block {
            id: [
                (x.floor() as i64).rem_euclid(i64::from(self.cells[0])) as u32,
                row as u32,
            ],
            face: smooth(self.joint * 0.6, self.joint * 1.4, edge),
            inner: smooth(self.joint, self.joint + 0.25, edge),
        }
    }
}

fn masonry(p: &Parameters, joint: f32, mortar: Color, variety: [f32; 2]) -> RgbaImage {
    let [first, second] = [p.color(0), p.color(1)];
    let wall = Masonry {
        cells: [p.cells[0], p.cells[1].next_multiple_of(2)],
        joint,
        seed: p.seed,
    };
    let aspect = p.size[0] as f32 / p.size[1] as f32;
    let grains = wall.cells.map(|c| c * 4);
    paint(p.size, |u, v| {
        let block = wall.at(u, v, aspect);
        let pick = random(block.id[0], block.id[1], p.seed);
        let tone = mix(
            variety[0],
            variety[1],
            random(block.id[0], block.id[1], p.seed ^ 0x70AE),
        );
        let grain = fractal(u, v, grains, 5, p.seed ^ 0x6A);
        let pits = smooth(
            0.56,
            0.8,
            fractal(u, v, wall.cells.map(|c| c * 7), 3, p.seed ^ 0xB17),
        );
        let stone = shade(
            blend(first, second, pick),
            tone * (0.62 + 0.76 * grain) * mix(0.72, 1.0, block.inner) * (1.0 - 0.3 * pits),
        );
        let sand = 0.7 + 0.6 * fractal(u, v, wall.cells.map(|c| c * 8), 3, p.seed ^ 0x5A4D);
        blend(shade(mortar, sand), stone, block.face)
    })
}

/// A brick wall: cells are bricks in a row, and rows; two colours between which the bricks vary.
pub(super) fn bricks(p: &Parameters) -> RgbaImage {
    masonry(p, 0.07, rgb(0.52, 0.49, 0.44), [0.75, 1.15])
}

/// A wall of hewn stone: as [`bricks`], with narrow dark joints.
pub(super) fn stone(p: &Parameters) -> RgbaImage {
    masonry(p, 0.035, rgb(0.17, 0.16, 0.15), [0.8, 1.12])
}

/// Grain of a board that runs along u: fine fibres and wide, wavering rings. 0 to 1.
fn grain(u: f32, v: f32, board: u32, boards: u32, seed: u32) -> f32 {
    let own = seed ^ board.wrapping_mul(0x9E37_79B1);
    let waver = fractal(u, v, [2, boards * 2], 3, own) - 0.5;
    let rings = ((v * boards as f32 * 3.0 + waver * 3.5) * std::f32::consts::TAU).sin() * 0.5 + 0.5;
    let fibres = fractal(u, v, [5, boards * 24], 3, own ^ 0xF1);
    0.45 * rings + 0.55 * fibres
}

/// A board's colour at a point: light and dark wood by its grain.
pub(super) fn wood(
    u: f32,
    v: f32,
    board: u32,
    boards: u32,
    seed: u32,
    [light, dark]: [Color; 2],
) -> Color {
    let tone = mix(0.78, 1.12, random(board, 0, seed));
    shade(
        blend(
            dark,
            light,
            smooth(0.15, 0.85, grain(u, v, board, boards, seed)),
        ),
        tone,
    )
}

/// A plank floor: cells are joints along a board, and boards; light and dark colour of the wood. Boards run along u.
pub(super) fn planks(p: &Parameters) -> RgbaImage {
    let [lengths, boards] = p.cells;
    let aspect = p.size[0] as f32 / p.size[1] as f32;
    paint(p.size, |u, v| {
        let y = v * boards as f32;
        let row = y.floor() as u32;
        let x = u * lengths as f32 + random(row, 7, p.seed);
        let length = (x.floor() as i64).rem_euclid(i64::from(lengths)) as u32;
        let (fx, fy) = (x - x.floor(), y - y.floor());
        let board = row * lengths + length;
        let end = fx.min(1.0 - fx) / lengths as f32 * aspect * boards as f32;
        let side = fy.min(1.0 - fy);
        let gap = smooth(0.012, 0.035, side.min(end));
        let worn = mix(0.75, 1.0, smooth(0.0, 0.16, side.min(end)));
        // Two nails at each end of a board.
        let nail = |y: f32| ((end - 0.14).powi(2) + (fy - y).powi(2)).sqrt();
        let nails = smooth(0.025, 0.04, nail(0.25).min(nail(0.75)));
        shade(
            wood(u, v, board, boards, p.seed, [p.color(0), p.color(1)]),
            worn * mix(0.12, 1.0, gap) * mix(0.25, 1.0, nails),
        )
    })
}

/// Plaster: one colour, uneven, with trowel marks and fine cracks.
pub(super) fn plaster(p: &Parameters) -> RgbaImage {
    let cells = p.cells;
    paint(p.size, |u, v| {
        let clouds = fractal(u, v, cells, 5, p.seed);
        let trowel = fractal(u, v, [cells[0] * 2, cells[1] * 7], 3, p.seed ^ 0x7401);
        let crack = (fractal(u, v, cells, 4, p.seed ^ 0xC4A) - 0.5).abs();
        let dark = 1.0 - 0.22 * (1.0 - smooth(0.0, 0.006, crack)) * smooth(0.5, 0.6, clouds);
        shade(p.color(0), (0.78 + 0.3 * clouds + 0.14 * trowel) * dark)
    })
}

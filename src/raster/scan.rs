//! Which pixels a shape covers, quad by quad.

use super::points_lines::Line;
use super::setup::{Corner, SUBPIXELS};

/// The side of the blocks that are taken or left as a whole.
const BLOCK: i32 = 8;

/// A rectangle of pixels, its right and lower ends left out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Bounds {
    pub(super) x0: i32,
    pub(super) y0: i32,
    pub(super) x1: i32,
    pub(super) y1: i32,
}

impl Bounds {
    /// The pixels whose centres lie between the outermost corners.
    pub(super) fn around(corners: &[Corner]) -> Self {
        let range = |value: fn(&Corner) -> i64| {
            let least = corners.iter().map(value).min().unwrap_or(0);
            let greatest = corners.iter().map(value).max().unwrap_or(0);
            // Corners are within the guard band, so nothing is cut off here.
            (
                (-(-least).div_euclid(SUBPIXELS)) as i32,
                (greatest.div_euclid(SUBPIXELS) + 1) as i32,
            )
        };
        let (x0, x1) = range(|corner| corner.x);
        let (y0, y1) = range(|corner| corner.y);
        Self { x0, y0, x1, y1 }
    }

    /// What both have; `None` if that is nothing.
    pub(super) fn intersect(&self, other: &Self) -> Option<Self> {
        let common = Self {
            x0: self.x0.max(other.x0),
            y0: self.y0.max(other.y0),
            x1: self.x1.min(other.x1),
            y1: self.y1.min(other.y1),
        };
        (common.x0 < common.x1 && common.y0 < common.y1).then_some(common)
    }

    #[inline]
    pub(super) fn contains(&self, x: i32, y: i32) -> bool {
        (self.x0..self.x1).contains(&x) && (self.y0..self.y1).contains(&y)
    }

    /// Which of the pixels of the quad at (x, y) are inside.
    #[inline(always)]
    fn mask(&self, x: i32, y: i32) -> u8 {
        let left = x >= self.x0 && x < self.x1;
        let right = x + 1 >= self.x0 && x + 1 < self.x1;
        let upper = y >= self.y0 && y < self.y1;
        let lower = y + 1 >= self.y0 && y + 1 < self.y1;
        u8::from(upper && left)
            | u8::from(upper && right) << 1
            | u8::from(lower && left) << 2
            | u8::from(lower && right) << 3
    }
}

/// The inner side of an edge: `a·x + b·y + c ≥ 0` at pixel (x, y).
#[derive(Debug, Clone, Copy)]
pub(super) struct Edge {
    a: i64,
    b: i64,
    c: i64,
}

impl Edge {
    /// Of a clockwise triangle. A pixel on the edge itself is inside if the edge is a top or a left one.
    pub(super) fn new(from: &Corner, to: &Corner) -> Self {
        let (dx, dy) = (to.x - from.x, to.y - from.y);
        // Clockwise with y downwards: left edges go up, and the top edge goes to the right.
        let top_left = dy < 0 || (dy == 0 && dx > 0);
        Self {
            a: -dy * SUBPIXELS,
            b: dx * SUBPIXELS,
            c: dy * from.x - dx * from.y - i64::from(!top_left),
        }
    }

    #[inline(always)]
    fn at(&self, x: i32, y: i32) -> i64 {
        self.a * i64::from(x) + self.b * i64::from(y) + self.c
    }

    /// Whether no pixel (`None`), every one (`Some(true)`) or perhaps some of a square are inside.
    #[inline(always)]
    fn square(&self, x: i32, y: i32, side: i32) -> Option<bool> {
        let corner = self.at(x, y);
        let reach = i64::from(side - 1);
        if corner + (self.a.max(0) + self.b.max(0)) * reach < 0 {
            return None;
        }
        Some(corner + (self.a.min(0) + self.b.min(0)) * reach >= 0)
    }
}

/// What is covered within the bounds of a set-up.
#[derive(Debug, Clone, Copy)]
pub(super) enum Shape {
    /// All of it: a point.
    Rectangle,
    /// What is inside three edges.
    Triangle([Edge; 3]),
    /// One pixel in each column or row.
    Line(Line),
}

impl Shape {
    /// Whether a pixel within the bounds is covered.
    pub(super) fn covers(&self, x: i32, y: i32) -> bool {
        match self {
            Self::Rectangle => true,
            Self::Triangle(edges) => edges.iter().all(|edge| edge.at(x, y) >= 0),
            Self::Line(line) => line.covers(x, y),
        }
    }

    /// Whether anything of a square may be covered; may err on the side of yes.
    pub(super) fn touches(&self, x: i32, y: i32, side: i32) -> bool {
        match self {
            Self::Rectangle | Self::Line(_) => true,
            Self::Triangle(edges) => edges.iter().all(|edge| edge.square(x, y, side).is_some()),
        }
    }

    /// Calls `quad` with the position and the mask (bit 0 upper left, 1 upper right, 2 lower left, 3 lower right) of every
    /// quad of which something within `bounds` is covered, each once for areas.
    #[inline(always)]
    pub(super) fn scan(&self, bounds: &Bounds, mut quad: impl FnMut(i32, i32, u8)) {
        match self {
            Self::Rectangle => {
                for y in (bounds.y0 & !1..bounds.y1).step_by(2) {
                    for x in (bounds.x0 & !1..bounds.x1).step_by(2) {
                        quad(x, y, bounds.mask(x, y));
                    }
                }
            }
            Self::Triangle(edges) => {
                for y in (bounds.y0 & !(BLOCK - 1)..bounds.y1).step_by(BLOCK as usize) {
                    for x in (bounds.x0 & !(BLOCK - 1)..bounds.x1).step_by(BLOCK as usize) {
                        scan_block(edges, bounds, x, y, &mut quad);
                    }
                }
            }
            Self::Line(line) => line.scan(bounds, quad),
        }
    }
}

#[inline(always)]
fn scan_block(
    edges: &[Edge; 3],
    bounds: &Bounds,
    x0: i32,
    y0: i32,
    quad: &mut impl FnMut(i32, i32, u8),
) {
    let mut whole = true;
    for edge in edges {
        match edge.square(x0, y0, BLOCK) {
            None => return,
            Some(all) => whole &= all,
        }
    }
    let within =
        x0 >= bounds.x0 && y0 >= bounds.y0 && x0 + BLOCK <= bounds.x1 && y0 + BLOCK <= bounds.y1;
    // Quads outside of the bounds have an empty mask; leave out what can be left out without looking.
    let ys = y0.max(bounds.y0 & !1)..(y0 + BLOCK).min(bounds.y1);
    let xs = x0.max(bounds.x0 & !1)..(x0 + BLOCK).min(bounds.x1);
    for y in ys.step_by(2) {
        for x in xs.clone().step_by(2) {
            let mut mask = if whole { 0xf } else { quad_mask(edges, x, y) };
            if !within {
                mask &= bounds.mask(x, y);
            }
            if mask != 0 {
                quad(x, y, mask);
            }
        }
    }
}

#[inline(always)]
fn quad_mask(edges: &[Edge; 3], x: i32, y: i32) -> u8 {
    // A pixel is inside where no edge function is negative: where no sign bit is set.
    let mut signs = [0_i64; 4];
    for edge in edges {
        let at = edge.at(x, y);
        signs[0] |= at;
        signs[1] |= at + edge.a;
        signs[2] |= at + edge.b;
        signs[3] |= at + edge.a + edge.b;
    }
    signs
        .iter()
        .enumerate()
        .fold(0, |mask, (i, sign)| mask | u8::from(*sign >= 0) << i)
}

//! Which pixels a shape covers, quad by quad.

use super::points_lines::Line;
use super::setup::{Corner, SUBPIXELS};
use super::target;

/// The side of the blocks that are taken or left as a whole.
const BLOCK: i32 = target::BLOCK as i32;

const SUBPIXEL_BITS: u32 = SUBPIXELS.trailing_zeros();

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
    #[inline(always)]
    pub(super) fn around<const N: usize>(corners: &[Corner; N]) -> Self {
        let range = |values: [i64; N]| {
            let least = values.into_iter().fold(i64::MAX, i64::min);
            let greatest = values.into_iter().fold(i64::MIN, i64::max);
            // Corners are within the guard band, so nothing is cut off here.
            (
                ((least + SUBPIXELS - 1) >> SUBPIXEL_BITS) as i32,
                ((greatest >> SUBPIXEL_BITS) + 1) as i32,
            )
        };
        let (x0, x1) = range(corners.each_ref().map(|corner| corner.x));
        let (y0, y1) = range(corners.each_ref().map(|corner| corner.y));
        Self { x0, y0, x1, y1 }
    }

    /// What both have; `None` if that is nothing.
    #[inline(always)]
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

    /// The quads that have a pixel inside.
    #[inline(always)]
    fn in_quads(&self) -> Self {
        Self {
            x0: self.x0 & !1,
            y0: self.y0 & !1,
            x1: self.x1 + (self.x1 & 1),
            y1: self.y1 + (self.y1 & 1),
        }
    }

    /// Whether nothing of it is outside of another.
    #[inline(always)]
    fn within(&self, other: &Self) -> bool {
        self.x0 >= other.x0 && self.y0 >= other.y0 && self.x1 <= other.x1 && self.y1 <= other.y1
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
    #[inline(always)]
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

/// What [`Shape::scan`] finds. No pixel is in it twice.
#[derive(Default)]
pub(super) struct Covered {
    /// The first pixels of blocks that are covered as a whole.
    pub(super) blocks: Vec<(i32, i32)>,
    /// The first pixels of quads, and which of the four are covered: bit 0 upper left, 1 upper right, 2 lower left, 3 lower
    /// right. Of areas each comes once.
    pub(super) quads: Vec<(i32, i32, u8)>,
}

impl Covered {
    pub(super) fn clear(&mut self) {
        self.blocks.clear();
        self.quads.clear();
    }

    pub(super) fn is_empty(&self) -> bool {
        self.blocks.is_empty() && self.quads.is_empty()
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
    #[inline(always)]
    pub(super) fn touches(&self, x: i32, y: i32, side: i32) -> bool {
        match self {
            Self::Rectangle | Self::Line(_) => true,
            Self::Triangle(edges) => edges.iter().all(|edge| edge.square(x, y, side).is_some()),
        }
    }

    /// Adds everything within `bounds` that is covered. These are what the bounds of the shape have in common with a rectangle
    /// of whole quads; the scissor has already cut them.
    #[inline(always)]
    pub(super) fn scan(&self, bounds: &Bounds, scissor: &Bounds, found: &mut Covered) {
        let mut quad = |x, y, mask| found.quads.push((x, y, mask));
        match self {
            Self::Rectangle => {
                for y in (bounds.y0 & !1..bounds.y1).step_by(2) {
                    for x in (bounds.x0 & !1..bounds.x1).step_by(2) {
                        quad(x, y, bounds.mask(x, y));
                    }
                }
            }
            Self::Triangle(edges) => scan_triangle(edges, bounds, scissor, found),
            Self::Line(line) => line.scan(bounds, quad),
        }
    }
}

/// As [`Shape::scan`].
#[inline(always)]
fn scan_triangle(edges: &[Edge; 3], bounds: &Bounds, scissor: &Bounds, found: &mut Covered) {
    let Covered { blocks, quads } = found;
    let mut quad = |x, y, mask| quads.push((x, y, mask));
    let area = bounds.in_quads();
    if area.x1 - area.x0 <= BLOCK && area.y1 - area.y0 <= BLOCK {
        // Looking at the few quads is cheaper than looking whether one has to.
        return scan_quads(edges, &area, scissor, &mut quad);
    }
    let mut y = area.y0 & !(BLOCK - 1);
    while y < area.y1 {
        let mut x = area.x0 & !(BLOCK - 1);
        while x < area.x1 {
            let block = Bounds {
                x0: x,
                y0: y,
                x1: x + BLOCK,
                y1: y + BLOCK,
            };
            let covered = edges.each_ref().map(|edge| edge.square(x, y, BLOCK));
            if covered == [Some(true); 3] && block.within(scissor) && block.within(&area) {
                blocks.push((x, y));
            } else if !covered.contains(&None)
                && let Some(part) = block.intersect(&area)
            {
                scan_quads(edges, &part, scissor, &mut quad);
            }
            x += BLOCK;
        }
        y += BLOCK;
    }
}

/// The quads of an area of whole ones.
#[inline(always)]
fn scan_quads(
    edges: &[Edge; 3],
    area: &Bounds,
    scissor: &Bounds,
    quad: &mut impl FnMut(i32, i32, u8),
) {
    // Pixels beyond the bounds of the shape are outside of an edge. Those that the scissor takes may be inside of all.
    let cut = !area.within(scissor);
    // A pixel is inside where no edge function is negative: where no sign bit is set.
    let mut row: [[i64; 4]; 3] = edges.each_ref().map(|edge| {
        let at = edge.at(area.x0, area.y0);
        [at, at + edge.a, at + edge.b, at + edge.a + edge.b]
    });
    let (right, down) = (
        edges.each_ref().map(|edge| 2 * edge.a),
        edges.each_ref().map(|edge| 2 * edge.b),
    );
    let mut y = area.y0;
    while y < area.y1 {
        let mut at = row;
        let mut x = area.x0;
        while x < area.x1 {
            let signs: [i64; 4] = std::array::from_fn(|i| at[0][i] | at[1][i] | at[2][i]);
            let inside = (0..4).fold(0, |mask, i| mask | u8::from(signs[i] >= 0) << i);
            let mask = if cut {
                inside & scissor.mask(x, y)
            } else {
                inside
            };
            if mask != 0 {
                quad(x, y, mask);
            }
            for (at, right) in at.iter_mut().zip(right) {
                at.iter_mut().for_each(|at| *at += right);
            }
            x += 2;
        }
        for (row, down) in row.iter_mut().zip(down) {
            row.iter_mut().for_each(|row| *row += down);
        }
        y += 2;
    }
}

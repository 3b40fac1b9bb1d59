//! Points, which are squares, and lines, which are one pixel thin.

use super::scan::{Bounds, Shape};
use super::setup::{Corner, Linear, Owner, Planes, Setup, Stage};

/// A square around a corner. Its size is the vertex's or the state's, between the state's limits; its left and upper
/// sides belong to it, its right and lower ones do not, as with triangles.
pub(super) fn point(stage: &Stage, vertices: [u32; 3], corner: &Corner) -> Option<Setup> {
    let state = &stage.call.state.point;
    // A corner of a triangle drawn as points may be any of the three.
    let which = match corner.shares {
        [1.0, _] => 1,
        [_, 1.0] => 2,
        _ => 0,
    };
    let index = vertices[which];
    let size = stage.call.vertices.point_size(index).unwrap_or(state.size);
    // In this order a NaN becomes a limit, and limits the wrong way round do no harm.
    let size = f64::from(size.max(state.min).min(state.max));
    if size.is_nan() || size <= 0.0 {
        return None;
    }
    let [left, top] = corner.pixels().map(|center| center - size / 2.0);
    // A float that no integer holds becomes the nearest one that does, which the scissor then cuts.
    let bounds = Bounds {
        x0: left.ceil() as i32,
        y0: top.ceil() as i32,
        x1: (left + size).ceil() as i32,
        y1: (top + size).ceil() as i32,
    }
    .intersect(&stage.scissor)?;
    let mut planes = Planes::new(&[*corner], |[at]| Linear {
        at,
        dx: [0.0; 4],
        dy: [0.0; 4],
    });
    if state.sprite {
        // The shares of the vertices have no use in a point; its coordinates take their place.
        let [rightwards, downwards] = Planes::SHARES;
        planes = planes.changed(|linear| {
            for (share, start) in [(rightwards, left), (downwards, top)] {
                linear.at[share] = -start / size;
            }
            (linear.dx[rightwards], linear.dy[rightwards]) = (1.0 / size, 0.0);
            (linear.dx[downwards], linear.dy[downwards]) = (0.0, 1.0 / size);
        });
    }
    Some(Setup {
        owner: Owner {
            vertices: [index; 3],
            provoking: vertices[0],
            sprite: state.sprite,
        },
        bounds,
        shape: Shape::Rectangle,
        planes: planes.biased(stage.call.state.depth.bias),
    })
}

/// A line between two corners.
pub(super) fn line(stage: &Stage, vertices: [u32; 3], ends: &[Corner; 2]) -> Option<Setup> {
    let line = Line::new(ends)?;
    let around = Bounds::around(ends);
    let bounds = Bounds {
        // A pixel beside an end may be lit: its diamond reaches half a pixel.
        x0: around.x0 - 1,
        y0: around.y0 - 1,
        x1: around.x1 + 1,
        y1: around.y1 + 1,
    }
    .intersect(&stage.scissor)?;
    let planes = Planes::new(ends, |[from, to]| {
        let slope: [f64; 4] = std::array::from_fn(|i| (to[i] - from[i]) / (line.end - line.start));
        Linear {
            at: std::array::from_fn(|i| from[i] - slope[i] * line.start),
            dx: if line.steep { [0.0; 4] } else { slope },
            dy: if line.steep { slope } else { [0.0; 4] },
        }
    });
    Some(Setup {
        owner: Owner::of(vertices),
        bounds,
        shape: Shape::Line(line),
        planes: planes.biased(stage.call.state.depth.bias),
    })
}

/// A line by the diamond-exit rule: a pixel is lit if the line, going from its start to its end, leaves the diamond
/// |x - px| + |y - py| < 1/2 around the pixel's centre. So the last pixel of a line is left to the line that goes on from
/// there.
///
/// "Major" is the axis along which it is longer, x if they are equal; "minor" the other.
#[derive(Debug, Clone, Copy)]
pub(super) struct Line {
    /// Whether the major axis is y.
    steep: bool,
    /// The major coordinate of both ends, in pixels.
    start: f64,
    end: f64,
    /// The minor coordinate at the start, and its change for a step of 1 along the major axis.
    minor: f64,
    slope: f64,
}

impl Line {
    /// `None` if both ends are the same point, which leaves no diamond.
    fn new(ends: &[Corner; 2]) -> Option<Self> {
        let [from, to] = ends.map(|end| end.pixels());
        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
        if dx == 0.0 && dy == 0.0 {
            return None;
        }
        let steep = dy.abs() > dx.abs();
        let major = usize::from(steep);
        Some(Self {
            steep,
            start: from[major],
            end: to[major],
            minor: from[1 - major],
            slope: if steep { dx / dy } else { dy / dx },
        })
    }

    /// The minor coordinate of the pixel that is lit in a column (of a steep line: in a row).
    fn minor_at(&self, major: i32) -> Option<i32> {
        let center = f64::from(major);
        let minor = self.minor + self.slope * (center - self.start);
        // Half way between two pixels: the upper or left one.
        let pixel = (minor - 0.5).ceil();
        let offset = minor - pixel;
        // How far behind the column's centre the line leaves the diamond: through whichever side it meets first.
        let ahead = if self.end > self.start { 1.0 } else { -1.0 };
        let rise = self.slope * ahead;
        let side = |room: f64, approach: f64| {
            if approach > 0.0 {
                room / approach
            } else {
                f64::INFINITY
            }
        };
        let exit =
            center + ahead * side(0.5 - offset, 1.0 + rise).min(side(0.5 + offset, 1.0 - rise));
        // Distances along the line, so that both directions are alike.
        let (after_start, before_end) = ((exit - self.start) * ahead, (self.end - exit) * ahead);
        (after_start >= 0.0 && before_end > 0.0).then_some(pixel as i32)
    }

    pub(super) fn covers(&self, x: i32, y: i32) -> bool {
        let (major, minor) = if self.steep { (y, x) } else { (x, y) };
        self.minor_at(major) == Some(minor)
    }

    /// See [`Shape::scan`]. A quad may come twice where the line crosses into its neighbour and back, each pixel once.
    #[inline]
    pub(super) fn scan(&self, bounds: &Bounds, mut quad: impl FnMut(i32, i32, u8)) {
        let range = if self.steep {
            bounds.y0..bounds.y1
        } else {
            bounds.x0..bounds.x1
        };
        let mut open: Option<(i32, i32, u8)> = None;
        for major in range {
            let Some(minor) = self.minor_at(major) else {
                continue;
            };
            let (x, y) = if self.steep {
                (minor, major)
            } else {
                (major, minor)
            };
            if !bounds.contains(x, y) {
                continue;
            }
            let (quad_x, quad_y) = (x & !1, y & !1);
            let bit = 1 << ((y & 1) * 2 + (x & 1));
            match &mut open {
                Some((open_x, open_y, mask)) if (*open_x, *open_y) == (quad_x, quad_y) => {
                    *mask |= bit
                }
                _ => {
                    if let Some((x, y, mask)) = open.replace((quad_x, quad_y, bit)) {
                        quad(x, y, mask);
                    }
                }
            }
        }
        if let Some((x, y, mask)) = open {
            quad(x, y, mask);
        }
    }
}

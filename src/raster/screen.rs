//! Where vertices are on the screen: division by w and the viewport transform, once a vertex and not once a corner.

#[cfg(feature = "parallel")]
use rayon::prelude::*;

use super::clip::{Clipper, GUARD};
use super::pixel::LANES;
use super::setup::{SUBPIXELS, Stage};
use super::state::Viewport;
use super::vertices::{Row, Vertices};
use crate::simd::{Simd, Task};

/// The viewport transform of Direct3D 8.
pub(super) struct Projection {
    left: f64,
    top: f64,
    width: f64,
    height: f64,
    min_z: f64,
    /// The farther end of the depths less the nearer one.
    depth: f64,
}

/// A position on the screen.
pub(super) struct Spot {
    /// In subpixels, at most twice the guard band from the origin.
    pub(super) x: i32,
    pub(super) y: i32,
    /// Within the viewport's range.
    pub(super) z: f64,
    pub(super) w: f64,
}

impl Projection {
    pub(super) fn new(viewport: &Viewport) -> Self {
        let (min_z, max_z) = (f64::from(viewport.min_z), f64::from(viewport.max_z));
        Self {
            left: f64::from(viewport.x),
            top: f64::from(viewport.y),
            width: f64::from(viewport.width),
            height: f64::from(viewport.height),
            min_z,
            depth: max_z - min_z,
        }
    }

    /// Where a position of clip space is on the screen.
    #[inline(always)]
    pub(super) fn spot(&self, [x, y, z, w]: [f64; 4]) -> Spot {
        // Cuts near w = 0 are rounded too; whatever comes of that lies outside of every target.
        let w = w.max(f64::from(f32::MIN_POSITIVE));
        let snap = |v: f64| {
            let v = if v.is_nan() { 0.0 } else { v };
            // To the nearest subpixel. Made positive first, so that cutting off the fraction rounds downwards. The sum is
            // below 2³¹.
            let shift = 4.0 * GUARD * SUBPIXELS as f64;
            (v.clamp(-2.0 * GUARD, 2.0 * GUARD) * SUBPIXELS as f64 + 0.5 + shift) as i32
                - shift as i32
        };
        Spot {
            x: snap(self.left + (x / w + 1.0) * self.width / 2.0),
            y: snap(self.top + (1.0 - y / w) * self.height / 2.0),
            z: self.min_z + (z / w).clamp(0.0, 1.0) * self.depth,
            w,
        }
    }
}

/// The vertices of a block on the screen.
pub(super) struct ScreenBlock {
    /// On which planes' outer sides each is, a bit a plane: see [`Clipper::outside`].
    outside: [u16; LANES],
    x: [i32; LANES],
    y: [i32; LANES],
    z: [f64; LANES],
    w: [f64; LANES],
}

/// All vertices of a draw call on the screen.
pub(super) struct Screen(Vec<ScreenBlock>);

impl Screen {
    /// Of a draw call that goes on the screen in this way.
    pub(super) fn new(stage: &Stage, vertices: &Vertices, simd: Simd) -> Self {
        let blocks = vertices.len().div_ceil(LANES);
        let block = |number: usize| {
            simd.run(Project {
                clipper: &stage.clipper,
                projection: &stage.projection,
                positions: vertices.positions(number),
            })
        };
        #[cfg(feature = "parallel")]
        let blocks = (0..blocks).into_par_iter().with_min_len(16).map(block);
        #[cfg(not(feature = "parallel"))]
        let blocks = (0..blocks).map(block);
        Self(blocks.collect())
    }

    /// On which planes' outer sides a vertex is.
    #[inline(always)]
    pub(super) fn outside(&self, vertex: u32) -> u16 {
        let block = self.0.get(vertex as usize / LANES);
        block.map_or(u16::MAX, |block| block.outside[vertex as usize % LANES])
    }

    /// Where a vertex is.
    #[inline(always)]
    pub(super) fn place(&self, vertex: u32) -> [i32; 2] {
        let (block, lane) = (self.0.get(vertex as usize / LANES), vertex as usize % LANES);
        block.map_or([0; 2], |block| [block.x[lane], block.y[lane]])
    }

    /// The same with depth and w.
    #[inline(always)]
    pub(super) fn spot(&self, vertex: u32) -> Spot {
        let (block, lane) = (self.0.get(vertex as usize / LANES), vertex as usize % LANES);
        let [x, y] = self.place(vertex);
        let [z, w] = block.map_or([0.0, 1.0], |block| [block.z[lane], block.w[lane]]);
        Spot { x, y, z, w }
    }
}

/// A block of vertices, as something that is compiled for each set of instructions.
struct Project<'a> {
    clipper: &'a Clipper,
    projection: &'a Projection,
    positions: &'a [Row; 4],
}

impl Task for Project<'_> {
    type Output = ScreenBlock;

    #[inline(always)]
    fn run(self) -> ScreenBlock {
        let mut block = ScreenBlock {
            outside: self.clipper.outside(self.positions),
            x: [0; LANES],
            y: [0; LANES],
            z: [0.0; LANES],
            w: [0.0; LANES],
        };
        let [xs, ys, zs, ws] = self.positions;
        for lane in 0..LANES {
            let position = [xs[lane], ys[lane], zs[lane], ws[lane]];
            let spot = self.projection.spot(position.map(f64::from));
            block.x[lane] = spot.x;
            block.y[lane] = spot.y;
            block.z[lane] = spot.z;
            block.w[lane] = spot.w;
        }
        block
    }
}

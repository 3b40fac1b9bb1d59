//! From primitives to what is drawn on the screen: fixed-point edges, and planes for all that is interpolated.
//!
//! Screen positions are rounded to 1/8192 pixel before anything is derived from them. Edge functions are exact integers, so
//! each pixel belongs to exactly one of the triangles around a shared edge.

use super::clip::{ClipVertex, Clipper, SHARES};
use super::cover::ScreenPosition;
use super::pixel::{LANES, QUADS};
use super::points_lines;
use super::scan::{Bounds, Edge, Shape};
use super::screen::{Projection, Spot};
use super::state::{CullMode, DEPTH_BIAS_STEP, FillMode, Viewport};
use super::target::IN_BLOCK;
use super::{DrawCall, DrawError, Topology};

/// Subpixels of a pixel.
///
/// The documents round nothing, and steps of 1/256 are seen wherever a texture is made smaller: a coordinate that moves by
/// many texels a pixel moves by a part of one in half a step. These are as fine as edge functions of 64 bits allow between
/// corners in the guard band; yet positions that were meant to lie on pixel centres still come to lie there.
pub(super) const SUBPIXELS: i64 = 8192;

/// Four linear functions of the pixel position side by side, as [`Planes::INVERSE_W`] and those behind it name them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Linear {
    /// The values at pixel (0, 0).
    pub(super) at: [f64; 4],
    /// The changes for one pixel to the right.
    pub(super) dx: [f64; 4],
    /// The changes for one pixel downwards.
    pub(super) dy: [f64; 4],
}

/// A corner on the screen.
#[derive(Debug, Clone, Copy)]
pub(super) struct Corner {
    /// In subpixels.
    pub(super) x: i64,
    pub(super) y: i64,
    pub(super) z: f64,
    pub(super) w: f64,
    pub(super) shares: [f64; 2],
}

impl Corner {
    #[inline(always)]
    pub(super) fn new(spot: &Spot, shares: [f64; 2]) -> Self {
        Self {
            x: spot.x.into(),
            y: spot.y.into(),
            z: spot.z,
            w: spot.w,
            shares,
        }
    }

    /// The position in pixels.
    #[inline(always)]
    pub(super) fn pixels(&self) -> [f64; 2] {
        [self.x, self.y].map(|v| v as f64 / SUBPIXELS as f64)
    }
}

/// What is interpolated over one shape: four quantities. Attributes are not in here: they follow from the shares of the
/// vertices.
#[derive(Debug, Clone, Copy)]
pub(super) struct Planes {
    linear: Linear,
    /// What each quantity changes from the first pixel of a quad to the four of them.
    steps: [[f32; 4]; 4],
    pub(super) w_scale: f32,
    /// `inverse_w` is never taken smaller than this, lest it reach zero at a pixel beside the shape.
    inverse_w_floor: f32,
}

/// All quantities at the four pixels of a quad.
pub(super) type Quantities = [[f32; 4]; 4];

impl Planes {
    /// `w_scale / w`, so that its greatest value at a corner is 1.
    pub(super) const INVERSE_W: usize = 0;
    /// The shares of the second and third vertex, times that.
    pub(super) const SHARES: [usize; 2] = [1, 2];
    /// The depth.
    pub(super) const Z: usize = 3;

    /// From the quantities at each of the corners to their planes.
    #[inline(always)]
    pub(super) fn new<const N: usize>(
        corners: &[Corner; N],
        linear: impl Fn([[f64; 4]; N]) -> Linear,
    ) -> Self {
        let w_scale = corners
            .iter()
            .fold(f64::INFINITY, |least, corner| least.min(corner.w));
        let inverse_w = corners.map(|corner| w_scale / corner.w);
        let least = inverse_w.iter().fold(1.0, |least: f64, v| least.min(*v));
        let values = std::array::from_fn(|i| {
            let ([second, third], inverse_w) = (corners[i].shares, inverse_w[i]);
            [
                inverse_w,
                second * inverse_w,
                third * inverse_w,
                corners[i].z,
            ]
        });
        Self::of(
            linear(values),
            w_scale as f32,
            (least / 256.0).max(1e-30) as f32,
        )
    }

    #[inline(always)]
    fn of(linear: Linear, w_scale: f32, inverse_w_floor: f32) -> Self {
        let step = |i: usize| {
            let (dx, dy) = (linear.dx[i] as f32, linear.dy[i] as f32);
            // Adding -0 changes nothing.
            [-0.0, dx, dy, dx + dy]
        };
        Self {
            linear,
            steps: std::array::from_fn(step),
            w_scale,
            inverse_w_floor,
        }
    }

    /// The same with other planes for some of the quantities.
    pub(super) fn changed(self, change: impl FnOnce(&mut Linear)) -> Self {
        let mut linear = self.linear;
        change(&mut linear);
        Self::of(linear, self.w_scale, self.inverse_w_floor)
    }

    /// `D3DRS_ZBIAS` brings what is drawn nearer.
    #[inline(always)]
    pub(super) fn biased(mut self, bias: u8) -> Self {
        self.linear.at[Self::Z] -= f64::from(bias) * DEPTH_BIAS_STEP;
        self
    }

    #[inline(always)]
    pub(super) fn quad(&self, x: i32, y: i32) -> Quantities {
        let first: [f32; 4] = std::array::from_fn(|i| self.first(i, x, y));
        std::array::from_fn(|i| self.steps[i].map(|step| first[i] + step))
    }

    /// One quantity at the pixels of a block, quad by quad as [`Self::quad`] has it.
    #[inline(always)]
    pub(super) fn block(&self, which: usize, x: i32, y: i32) -> [f32; LANES] {
        let mut first = [0.0; QUADS];
        for (quad, first) in first.iter_mut().enumerate() {
            let [right, down] = [IN_BLOCK[0][4 * quad], IN_BLOCK[1][4 * quad]];
            *first = self.first(which, x + right, y + down);
        }
        // Two quads at a time, which are one vector of most machines: halves of one that are stored apart are slow to read.
        let steps: [f32; 8] = std::array::from_fn(|i| self.steps[which][i % 4]);
        let mut values = [0.0; LANES];
        for (values, first) in (values.as_chunks_mut().0.iter_mut()).zip(first.as_chunks::<2>().0) {
            let first: [f32; 8] = std::array::from_fn(|i| first[i / 4]);
            *values = std::array::from_fn::<f32, 8, _>(|i| first[i] + steps[i]);
        }
        values
    }

    /// A quantity at the first pixel of a quad.
    #[inline(always)]
    fn first(&self, which: usize, x: i32, y: i32) -> f32 {
        let (x, y) = (f64::from(x), f64::from(y));
        let Linear { at, dx, dy } = &self.linear;
        // In double precision: from the screen's origin a float would lose what a small triangle needs.
        (at[which] + dx[which] * x + dy[which] * y) as f32
    }

    /// A value of [`Self::INVERSE_W`] as it is divided by.
    #[inline(always)]
    pub(super) fn divisor(&self, inverse_w: f32) -> f32 {
        let floor = self.inverse_w_floor;
        if inverse_w > floor { inverse_w } else { floor }
    }
}

/// Where the attributes of a shape come from.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Owner {
    /// The vertices whose attributes are interpolated.
    pub(super) vertices: [u32; 3],
    /// The vertex that gives the colours of flat shading.
    pub(super) provoking: u32,
    /// Whether the coordinate sets are replaced by the position inside the point.
    pub(super) sprite: bool,
}

impl Owner {
    /// Of a triangle or a line: all is interpolated, or it is the first vertex that counts.
    #[inline(always)]
    pub(super) fn of(vertices: [u32; 3]) -> Self {
        Self {
            vertices,
            provoking: vertices[0],
            sprite: false,
        }
    }
}

/// A shape on the screen that is ready to be drawn.
#[derive(Debug, Clone, Copy)]
pub(super) struct Setup {
    pub(super) owner: Owner,
    /// What may be covered, within the scissor.
    pub(super) bounds: Bounds,
    pub(super) shape: Shape,
    pub(super) planes: Planes,
}

/// Memory for the corners of one primitive, used again for the next.
#[derive(Default)]
pub(super) struct Room {
    /// How many vertices the primitive has: 1, 2 or 3.
    vertices: usize,
    kept: Vec<ClipVertex>,
    corners: Vec<Corner>,
}

impl Room {
    /// Where vertex 0, 1 or 2 of the primitive is on the screen; none if clipping left nothing of it. A line repeats its
    /// last vertex, a point its only one.
    pub(super) fn screen(&self, vertex: usize) -> Option<ScreenPosition> {
        let place = vertex.min(self.vertices.checked_sub(1)?);
        let kept = self.kept.iter().zip(&self.corners);
        let own =
            |(kept, _): &(&ClipVertex, &Corner)| kept.original && kept.shares == SHARES[place];
        let (_, corner) = { kept }.find(own)?;
        let [x, y] = corner.pixels().map(|v| v as f32);
        let [z, w] = [corner.z, corner.w].map(|v| v as f32);
        Some(ScreenPosition { x, y, z, w })
    }
}

/// The part of a draw call that turns primitives into shapes.
pub(super) struct Stage<'a> {
    pub(super) call: DrawCall<'a>,
    pub(super) clipper: Clipper,
    pub(super) projection: Projection,
    /// The viewport, within the target.
    pub(super) scissor: Bounds,
}

impl<'a> Stage<'a> {
    /// For a target of a size.
    pub(super) fn new(call: DrawCall<'a>, size: (u32, u32)) -> Result<Self, DrawError> {
        let Viewport { min_z, max_z, .. } = call.viewport;
        if !min_z.is_finite() || !max_z.is_finite() {
            return Err(DrawError::ViewportDepth { min_z, max_z });
        }
        let viewport = Viewport {
            min_z: min_z.clamp(0.0, 1.0),
            max_z: max_z.clamp(0.0, 1.0),
            ..call.viewport
        };
        let end = |start: u32, length: u32, limit: u32| {
            i32::try_from(start.saturating_add(length).min(limit))
        };
        let scissor = Bounds {
            x0: i32::try_from(viewport.x).unwrap_or(i32::MAX),
            y0: i32::try_from(viewport.y).unwrap_or(i32::MAX),
            x1: end(viewport.x, viewport.width, size.0).unwrap_or(i32::MAX),
            y1: end(viewport.y, viewport.height, size.1).unwrap_or(i32::MAX),
        };
        Ok(Self {
            clipper: Clipper::new(&viewport, &call.state.clip_planes),
            projection: Projection::new(&viewport),
            call,
            scissor,
        })
    }

    /// The same, cut down to a part of the target. Shapes keep their planes and edges, only what may be covered is less.
    pub(super) fn within(self, part: &Bounds) -> Self {
        let nothing = Bounds {
            x0: 0,
            y0: 0,
            x1: 0,
            y1: 0,
        };
        let scissor = self.scissor.intersect(part).unwrap_or(nothing);
        Self { scissor, ..self }
    }

    /// Adds the shapes of a primitive, in drawing order.
    pub(super) fn primitive(&self, vertices: [u32; 3], room: &mut Room, shapes: &mut Vec<Setup>) {
        let positions = vertices.map(|index| self.call.vertices.position(index));
        let vertices_of_primitive = match self.call.topology {
            Topology::PointList => 1,
            Topology::LineList | Topology::LineStrip => 2,
            Topology::TriangleList | Topology::TriangleStrip | Topology::TriangleFan => 3,
        };
        room.vertices = vertices_of_primitive;
        let Room { kept, corners, .. } = room;
        self.clipper.clip(&positions[..vertices_of_primitive], kept);
        corners.clear();
        corners.extend(kept.iter().map(|corner| self.to_screen(corner)));
        match (vertices_of_primitive, &corners[..]) {
            (1, [corner]) => shapes.extend(points_lines::point(self, vertices, corner)),
            (2, [from, to]) => shapes.extend(points_lines::line(self, vertices, &[*from, *to])),
            (3, [_, _, _, ..]) => self.polygon(vertices, kept, corners, shapes),
            _ => {}
        }
    }

    /// What is left of a triangle, as area, edges or corners.
    fn polygon(
        &self,
        vertices: [u32; 3],
        kept: &[ClipVertex],
        corners: &[Corner],
        shapes: &mut Vec<Setup>,
    ) {
        let fan = |i: usize| [&corners[0], &corners[i], &corners[i + 1]];
        let area: i64 = (1..corners.len() - 1).map(|i| doubled_area(fan(i))).sum();
        if self.culls(area) {
            return;
        }
        if let (FillMode::Solid, [a, b, c]) = (self.call.state.fill, corners) {
            // Nearly always: nothing was cut off.
            shapes.extend(self.triangle(vertices, [*a, *b, *c]));
            return;
        }
        match self.call.state.fill {
            FillMode::Solid => shapes.extend((1..corners.len() - 1).filter_map(|i| {
                let part = fan(i);
                // Rounding may turn over a sliver of the polygon, which the rest of it then covers.
                (doubled_area(part).signum() == area.signum())
                    .then(|| self.triangle(vertices, part.map(|corner| *corner)))
                    .flatten()
            })),
            FillMode::Wireframe => shapes.extend((0..corners.len()).filter_map(|i| {
                let ends = [corners[i], corners[(i + 1) % corners.len()]];
                points_lines::line(self, vertices, &ends)
            })),
            FillMode::Point => shapes.extend(
                corners
                    .iter()
                    .zip(kept)
                    .filter(|(_, kept)| kept.original)
                    .filter_map(|(corner, _)| points_lines::point(self, vertices, corner)),
            ),
        }
    }

    /// Whether triangles of this area, positive for clockwise ones, are left out.
    #[inline(always)]
    pub(super) fn culls(&self, area: i64) -> bool {
        match self.call.state.cull {
            CullMode::None => area == 0,
            CullMode::Cw => area >= 0,
            CullMode::Ccw => area <= 0,
        }
    }

    fn triangle(&self, vertices: [u32; 3], corners: [Corner; 3]) -> Option<Setup> {
        let outline = Outline::new(corners);
        Some(Setup {
            owner: Owner::of(vertices),
            bounds: outline.bounds().intersect(&self.scissor)?,
            shape: Shape::Triangle(outline.edges()),
            planes: outline.planes().biased(self.call.state.depth.bias),
        })
    }

    fn to_screen(&self, corner: &ClipVertex) -> Corner {
        Corner::new(&self.projection.spot(corner.position), corner.shares)
    }
}

/// A triangle on the screen, its corners clockwise.
pub(super) struct Outline([Corner; 3]);

impl Outline {
    /// Of corners in any order.
    #[inline(always)]
    pub(super) fn new(mut corners: [Corner; 3]) -> Self {
        if doubled_area(corners.each_ref()) < 0 {
            corners.swap(1, 2);
        }
        Self(corners)
    }

    /// The pixels that may be covered.
    #[inline(always)]
    pub(super) fn bounds(&self) -> Bounds {
        Bounds::around(&self.0)
    }

    #[inline(always)]
    pub(super) fn edges(&self) -> [Edge; 3] {
        let [a, b, c] = &self.0;
        [Edge::new(a, b), Edge::new(b, c), Edge::new(c, a)]
    }

    #[inline(always)]
    pub(super) fn planes(&self) -> Planes {
        let corners = &self.0;
        let area = doubled_area(corners.each_ref()) as f64 / (SUBPIXELS * SUBPIXELS) as f64;
        let [[x0, y0], [x1, y1], [x2, y2]] = corners.each_ref().map(Corner::pixels);
        Planes::new(corners, |[v0, v1, v2]| {
            let dx: [f64; 4] = std::array::from_fn(|i| {
                ((v1[i] - v0[i]) * (y2 - y0) - (v2[i] - v0[i]) * (y1 - y0)) / area
            });
            let dy: [f64; 4] = std::array::from_fn(|i| {
                ((v2[i] - v0[i]) * (x1 - x0) - (v1[i] - v0[i]) * (x2 - x0)) / area
            });
            Linear {
                at: std::array::from_fn(|i| v0[i] - dx[i] * x0 - dy[i] * y0),
                dx,
                dy,
            }
        })
    }
}

/// Twice the area in square subpixels, positive for clockwise triangles on a screen whose y points down.
#[inline(always)]
pub(super) fn doubled_area(corners: [&Corner; 3]) -> i64 {
    let [a, b, c] = corners.map(|corner| [corner.x, corner.y]);
    (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
}

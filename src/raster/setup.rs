//! From primitives to what is drawn on the screen: fixed-point edges, and planes for all that is interpolated.
//!
//! Screen positions are rounded to 1/8192 pixel before anything is derived from them. Edge functions are exact integers, so
//! each pixel belongs to exactly one of the triangles around a shared edge.

use super::clip::{ClipVertex, Clipper, GUARD, SHARES};
use super::cover::ScreenPosition;
use super::points_lines;
use super::scan::{Bounds, Edge, Shape};
use super::state::{CullMode, DEPTH_BIAS_STEP, FillMode, Viewport};
use super::{DrawCall, DrawError, Topology, Vertex};

/// Subpixels of a pixel.
///
/// The documents round nothing, and steps of 1/256 are seen wherever a texture is made smaller: a coordinate that moves by
/// many texels a pixel moves by a part of one in half a step. These are as fine as edge functions of 64 bits allow between
/// corners in the guard band; yet positions that were meant to lie on pixel centres still come to lie there.
pub(super) const SUBPIXELS: i64 = 8192;

/// A linear function of the pixel position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Plane {
    /// The value at pixel (0, 0).
    pub(super) at: f64,
    /// The change for one pixel to the right.
    pub(super) dx: f64,
    /// The change for one pixel downwards.
    pub(super) dy: f64,
}

impl Plane {
    pub(super) fn constant(at: f64) -> Self {
        Self {
            at,
            dx: 0.0,
            dy: 0.0,
        }
    }
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
    /// The position in pixels.
    pub(super) fn pixels(&self) -> [f64; 2] {
        [self.x, self.y].map(|v| v as f64 / SUBPIXELS as f64)
    }
}

/// What is interpolated over one shape: four quantities side by side, as [`Planes::INVERSE_W`] and those behind it name
/// them. Attributes are not in here: they follow from the shares of the vertices.
#[derive(Debug, Clone, Copy)]
pub(super) struct Planes {
    /// The values at pixel (0, 0).
    at: [f64; 4],
    /// The changes for one pixel to the right.
    dx: [f64; 4],
    /// The changes for one pixel downwards.
    dy: [f64; 4],
    pub(super) w_scale: f32,
    /// `inverse_w` is never taken smaller than this, lest it reach zero at a pixel beside the shape.
    pub(super) inverse_w_floor: f32,
}

impl Planes {
    /// `w_scale / w`, so that its greatest value at a corner is 1.
    pub(super) const INVERSE_W: usize = 0;
    /// The shares of the second and third vertex, times that.
    pub(super) const SHARES: [usize; 2] = [1, 2];
    /// The depth.
    pub(super) const Z: usize = 3;

    /// Puts another plane in the place of a quantity.
    pub(super) fn set(&mut self, quantity: usize, plane: &Plane) {
        self.at[quantity] = plane.at;
        self.dx[quantity] = plane.dx;
        self.dy[quantity] = plane.dy;
    }

    /// A quantity at the pixels of quads, which begin at these places.
    #[inline(always)]
    pub(super) fn quads<const Q: usize>(
        &self,
        quantity: usize,
        x: &[i32; Q],
        y: &[i32; Q],
    ) -> [[f32; 4]; Q] {
        let (at, dx, dy) = (self.at[quantity], self.dx[quantity], self.dy[quantity]);
        // The first pixel in double precision: from the screen's origin a float would lose what a small triangle needs.
        let mut first = [0.0; Q];
        for ((first, x), y) in first.iter_mut().zip(x).zip(y) {
            *first = (at + dx * f64::from(*x) + dy * f64::from(*y)) as f32;
        }
        let (dx, dy) = (dx as f32, dy as f32);
        // −0 changes nothing that it is added to.
        let further = [-0.0, dx, dy, dx + dy];
        let mut quads = [[0.0; 4]; Q];
        for (quad, first) in quads.iter_mut().zip(first) {
            for (pixel, further) in quad.iter_mut().zip(further) {
                *pixel = first + further;
            }
        }
        quads
    }

    /// From the value of any linear quantity at each of the corners to its plane.
    pub(super) fn new<const N: usize>(
        corners: &[Corner; N],
        plane: impl Fn([f64; N]) -> Plane,
    ) -> Self {
        let w_scale = corners
            .iter()
            .fold(f64::INFINITY, |least, corner| least.min(corner.w));
        let inverse_w = corners.map(|corner| w_scale / corner.w);
        let least = inverse_w.iter().fold(1.0, |least: f64, v| least.min(*v));
        let share = |which: usize| {
            plane(std::array::from_fn(|i| {
                corners[i].shares[which] * inverse_w[i]
            }))
        };
        let z = plane(corners.map(|corner| corner.z));
        let of = [plane(inverse_w), share(0), share(1), z];
        Self {
            at: of.each_ref().map(|plane| plane.at),
            dx: of.each_ref().map(|plane| plane.dx),
            dy: of.each_ref().map(|plane| plane.dy),
            w_scale: w_scale as f32,
            inverse_w_floor: (least / 256.0).max(1e-30) as f32,
        }
    }
}

/// A shape on the screen that is ready to be drawn.
#[derive(Debug, Clone, Copy)]
pub(super) struct Setup {
    /// The vertices whose attributes are interpolated.
    pub(super) vertices: [u32; 3],
    /// The vertex that gives the colours of flat shading.
    pub(super) provoking: u32,
    /// Whether the coordinate sets are replaced by the position inside the point.
    pub(super) sprite: bool,
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
    viewport: Viewport,
    clipper: Clipper,
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
            call,
            viewport,
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
        let positions = vertices.map(|index| self.vertex(index).position);
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

    pub(super) fn vertex(&self, index: u32) -> &'a Vertex {
        &self.call.vertices[index as usize]
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
        let culled = match self.call.state.cull {
            CullMode::None => area == 0,
            CullMode::Cw => area >= 0,
            CullMode::Ccw => area <= 0,
        };
        if culled {
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

    fn triangle(&self, vertices: [u32; 3], mut corners: [Corner; 3]) -> Option<Setup> {
        if doubled_area(corners.each_ref()) < 0 {
            corners.swap(1, 2);
        }
        let bounds = Bounds::around(&corners).intersect(&self.scissor)?;
        let area = doubled_area(corners.each_ref()) as f64 / (SUBPIXELS * SUBPIXELS) as f64;
        let [[x0, y0], [x1, y1], [x2, y2]] = corners.map(|corner| corner.pixels());
        let planes = Planes::new(&corners, |[v0, v1, v2]| {
            let dx = ((v1 - v0) * (y2 - y0) - (v2 - v0) * (y1 - y0)) / area;
            let dy = ((v2 - v0) * (x1 - x0) - (v1 - v0) * (x2 - x0)) / area;
            Plane {
                at: v0 - dx * x0 - dy * y0,
                dx,
                dy,
            }
        });
        let [a, b, c] = &corners;
        Some(Setup {
            vertices,
            provoking: vertices[0],
            sprite: false,
            bounds,
            shape: Shape::Triangle([Edge::new(a, b), Edge::new(b, c), Edge::new(c, a)]),
            planes: self.biased(planes),
        })
    }

    /// `D3DRS_ZBIAS` brings what is drawn nearer.
    pub(super) fn biased(&self, mut planes: Planes) -> Planes {
        planes.at[Planes::Z] -= f64::from(self.call.state.depth.bias) * DEPTH_BIAS_STEP;
        planes
    }

    /// Division by w and the viewport transform of Direct3D 8.
    fn to_screen(&self, corner: &ClipVertex) -> Corner {
        let [x, y, z, w] = corner.position;
        // Cuts near w = 0 are rounded too; whatever comes of that lies outside of every target.
        let w = w.max(f64::from(f32::MIN_POSITIVE));
        let viewport = &self.viewport;
        let snap = |v: f64| {
            let v = if v.is_nan() { 0.0 } else { v };
            // To the nearest subpixel. Made positive first, so that cutting off the fraction rounds downwards.
            let shift = 4.0 * GUARD * SUBPIXELS as f64;
            (v.clamp(-2.0 * GUARD, 2.0 * GUARD) * SUBPIXELS as f64 + 0.5 + shift) as i64
                - shift as i64
        };
        let (min_z, max_z) = (f64::from(viewport.min_z), f64::from(viewport.max_z));
        Corner {
            x: snap(f64::from(viewport.x) + (x / w + 1.0) * f64::from(viewport.width) / 2.0),
            y: snap(f64::from(viewport.y) + (1.0 - y / w) * f64::from(viewport.height) / 2.0),
            z: min_z + (z / w).clamp(0.0, 1.0) * (max_z - min_z),
            w,
            shares: corner.shares,
        }
    }
}

/// Twice the area in square subpixels, positive for clockwise triangles on a screen whose y points down.
fn doubled_area(corners: [&Corner; 3]) -> i64 {
    let [a, b, c] = corners;
    (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y)
}

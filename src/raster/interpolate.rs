//! The inputs of pixels from those of vertices.
//!
//! Every attribute is `a0 + s1·(a1 - a0) + s2·(a2 - a0)` with the shares s1, s2 of the second and third vertex, made
//! perspective-correct once a pixel: shares over w and 1 over w are linear on the screen. So what is the same at all
//! vertices is the same, to the bit, at every pixel.

use std::ops::Range;

use glam::Vec4;

use super::pixel::{LANES, PixelBatch, PixelInputs, QUADS};
use super::setup::{Plane, Planes, Setup};
use super::state::ShadeMode;
use super::{Vertex, fog_unit, unit};

/// The value of a plane at the four pixels of a quad.
#[inline]
fn quad_values(plane: &Plane, x: i32, y: i32) -> [f32; 4] {
    // The first pixel in double precision: from the screen's origin a float would lose what a small triangle needs.
    let at = plane.value(x, y) as f32;
    let (dx, dy) = (plane.dx as f32, plane.dy as f32);
    [at, at + dx, at + dy, at + (dx + dy)]
}

/// The depths of a quad, each in 0 to 1.
#[inline]
pub(super) fn depths(setup: &Setup, x: i32, y: i32) -> [f32; 4] {
    quad_values(&setup.planes.z, x, y).map(unit)
}

/// What of the inputs is to be computed, and how.
#[derive(Debug, Clone, Copy)]
pub(super) struct Interpolator<'a> {
    pub(super) vertices: &'a [Vertex],
    pub(super) inputs: PixelInputs,
    pub(super) shade: ShadeMode,
    pub(super) fog: bool,
}

/// The shares of the second and of the third vertex at the four pixels of a quad, and `w / w_scale` there.
#[inline]
pub(super) fn quad_shares(planes: &Planes, x: i32, y: i32) -> ([[f32; 4]; 2], [f32; 4]) {
    let w = quad_values(&planes.inverse_w, x, y).map(|inverse_w| {
        let floor = planes.inverse_w_floor;
        1.0 / if inverse_w > floor { inverse_w } else { floor }
    });
    let shares = planes.shares.each_ref().map(|plane| {
        let over_w = quad_values(plane, x, y);
        std::array::from_fn(|i| over_w[i] * w[i])
    });
    (shares, w)
}

/// The shares of the second and of the third vertex at the pixels of each quad.
type Shares = [[[f32; 4]; QUADS]; 2];

impl Interpolator<'_> {
    /// Completes a batch whose quads have positions and depths. `setup` gives the set-up of each quad.
    pub(super) fn fill<'s>(&self, batch: &mut PixelBatch, setup: impl Fn(usize) -> &'s Setup) {
        let mut shares = [[[0.0; 4]; QUADS]; 2];
        let quads = batch.quads.min(QUADS);
        for quad in 0..quads {
            let planes = &setup(quad).planes;
            let (of_quad, w) = quad_shares(planes, batch.x[4 * quad], batch.y[4 * quad]);
            for (share, of_quad) in shares.iter_mut().zip(of_quad) {
                share[quad] = of_quad;
            }
            batch.w.as_chunks_mut().0[quad] = w.map(|w| w * planes.w_scale);
        }
        // Quads of one shape follow each other: fetch its vertices once for all of them.
        let mut first = 0;
        while first < quads {
            let shape = setup(first);
            let mut end = first + 1;
            while end < quads && std::ptr::eq(setup(end), shape) {
                end += 1;
            }
            self.fill_quads(batch, shape, &shares, first..end);
            first = end;
        }
    }

    fn fill_quads(
        &self,
        batch: &mut PixelBatch,
        setup: &Setup,
        shares: &Shares,
        quads: Range<usize>,
    ) {
        let vertex = |index: u32| &self.vertices[index as usize];
        let corners = setup.vertices.map(vertex);
        let colors = |color: fn(&Vertex) -> Vec4| match self.shade {
            ShadeMode::Gouraud => corners.map(|corner| color(corner).to_array().map(unit)),
            ShadeMode::Flat => [color(vertex(setup.provoking)).to_array().map(unit); 3],
        };
        // A colour is taken into 0 to 1 again, as pixel shaders read it.
        let limited =
            |values: &mut [f32; LANES], ends| mix(values, ends, shares, quads.clone(), unit);
        if self.inputs.diffuse {
            let ends = colors(|vertex| vertex.diffuse);
            for (component, values) in batch.diffuse.iter_mut().enumerate() {
                limited(values, ends.map(|end| end[component]));
            }
        }
        if self.inputs.specular {
            let ends = colors(|vertex| vertex.specular);
            for (component, values) in batch.specular.iter_mut().enumerate() {
                limited(values, ends.map(|end| end[component]));
            }
        }
        if self.fog {
            limited(&mut batch.fog, corners.map(|corner| fog_unit(corner.fog)));
        }
        for (set, coordinates) in batch.texcoords.iter_mut().enumerate() {
            if self.inputs.texcoords >> set & 1 == 0 {
                continue;
            }
            let ends = corners.map(|corner| corner.texcoords[set].to_array());
            for (component, values) in coordinates.iter_mut().enumerate() {
                let ends = match component {
                    _ if !setup.sprite => ends.map(|end| end[component]),
                    // In a sprite the shares are the position: 0 to 1 across and down.
                    0 => [0.0, 1.0, 0.0],
                    1 => [0.0, 0.0, 1.0],
                    _ => [0.0; 3],
                };
                mix(values, ends, shares, quads.clone(), |value| value);
            }
        }
    }
}

/// Values of the vertices to values of the pixels, each passed through `finish`.
#[inline]
fn mix(
    values: &mut [f32; LANES],
    [a0, a1, a2]: [f32; 3],
    shares: &Shares,
    quads: Range<usize>,
    finish: impl Fn(f32) -> f32,
) {
    let (to_second, to_third) = (a1 - a0, a2 - a0);
    let shares = shares[0][quads.clone()]
        .iter()
        .zip(&shares[1][quads.clone()]);
    let values = &mut values.as_chunks_mut::<4>().0[quads];
    for (value, (second, third)) in values.iter_mut().zip(shares) {
        *value = std::array::from_fn(|i| finish(a0 + second[i] * to_second + third[i] * to_third));
    }
}

//! The inputs of pixels from those of vertices.
//!
//! Every attribute is `a0 + s1·(a1 - a0) + s2·(a2 - a0)` with the shares s1, s2 of the second and third vertex, made
//! perspective-correct once a pixel: shares over w and 1 over w are linear on the screen. So what is the same at all
//! vertices is the same, to the bit, at every pixel.

use glam::Vec4;

use super::pixel::{Attribute, LANES, PixelBatch, PixelInputs, QUADS};
use super::setup::{Plane, Setup};
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

impl Interpolator<'_> {
    /// Completes a batch whose quads have positions and depths. `setup` gives the set-up of each quad.
    pub(super) fn fill<'s>(&self, batch: &mut PixelBatch, setup: impl Fn(usize) -> &'s Setup) {
        let mut shares = [[0.0; LANES]; 2];
        for quad in 0..batch.quads.min(QUADS) {
            let planes = &setup(quad).planes;
            let (x, y) = (batch.x[4 * quad], batch.y[4 * quad]);
            let inverse_w = quad_values(&planes.inverse_w, x, y);
            let [second, third] = [0, 1].map(|which| quad_values(&planes.shares[which], x, y));
            for i in 0..4 {
                let inverse_w = if inverse_w[i] > planes.inverse_w_floor {
                    inverse_w[i]
                } else {
                    planes.inverse_w_floor
                };
                let w = 1.0 / inverse_w;
                batch.w[4 * quad + i] = w * planes.w_scale;
                shares[0][4 * quad + i] = second[i] * w;
                shares[1][4 * quad + i] = third[i] * w;
            }
        }
        // Quads of one shape follow each other: fetch its vertices once for all of them.
        let mut first = 0;
        while first < batch.quads {
            let shape = setup(first);
            let mut end = first + 1;
            while end < batch.quads && std::ptr::eq(setup(end), shape) {
                end += 1;
            }
            self.fill_lanes(batch, shape, &shares, 4 * first..4 * end);
            first = end;
        }
    }

    fn fill_lanes(
        &self,
        batch: &mut PixelBatch,
        setup: &Setup,
        shares: &[[f32; LANES]; 2],
        lanes: std::ops::Range<usize>,
    ) {
        let vertex = |index: u32| &self.vertices[index as usize];
        let corners = setup.vertices.map(vertex);
        let colors = |color: fn(&Vertex) -> Vec4| match self.shade {
            ShadeMode::Gouraud => corners.map(|corner| color(corner).to_array().map(unit)),
            ShadeMode::Flat => [color(vertex(setup.provoking)).to_array().map(unit); 3],
        };
        if self.inputs.diffuse {
            blend_color(
                &mut batch.diffuse,
                &colors(|v| v.diffuse),
                shares,
                lanes.clone(),
            );
        }
        if self.inputs.specular {
            blend_color(
                &mut batch.specular,
                &colors(|v| v.specular),
                shares,
                lanes.clone(),
            );
        }
        for (set, coordinates) in batch.texcoords.iter_mut().enumerate() {
            if self.inputs.texcoords >> set & 1 == 0 {
                continue;
            }
            if setup.sprite {
                for (component, values) in coordinates.iter_mut().enumerate() {
                    match shares.get(component) {
                        Some(position) => {
                            values[lanes.clone()].copy_from_slice(&position[lanes.clone()])
                        }
                        None => values[lanes.clone()].fill(0.0),
                    }
                }
            } else {
                let ends = corners.map(|corner| corner.texcoords[set].to_array());
                for (component, values) in coordinates.iter_mut().enumerate() {
                    blend(
                        values,
                        ends.map(|end| end[component]),
                        shares,
                        lanes.clone(),
                    );
                }
            }
        }
        if self.fog {
            blend(
                &mut batch.fog,
                corners.map(|corner| fog_unit(corner.fog)),
                shares,
                lanes.clone(),
            );
            batch.fog[lanes]
                .iter_mut()
                .for_each(|fog| *fog = unit(*fog));
        }
    }
}

/// A colour is taken into 0 to 1 again, as pixel shaders read it.
fn blend_color(
    color: &mut Attribute,
    ends: &[[f32; 4]; 3],
    shares: &[[f32; LANES]; 2],
    lanes: std::ops::Range<usize>,
) {
    for (component, values) in color.iter_mut().enumerate() {
        blend(
            values,
            ends.map(|end| end[component]),
            shares,
            lanes.clone(),
        );
        values[lanes.clone()]
            .iter_mut()
            .for_each(|value| *value = unit(*value));
    }
}

#[inline]
fn blend(
    values: &mut [f32; LANES],
    [a0, a1, a2]: [f32; 3],
    shares: &[[f32; LANES]; 2],
    lanes: std::ops::Range<usize>,
) {
    let (to_second, to_third) = (a1 - a0, a2 - a0);
    let shares = shares[0][lanes.clone()]
        .iter()
        .zip(&shares[1][lanes.clone()]);
    for (value, (second, third)) in values[lanes].iter_mut().zip(shares) {
        *value = a0 + second * to_second + third * to_third;
    }
}

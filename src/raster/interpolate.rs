//! The inputs of pixels from those of vertices.
//!
//! Every attribute is `a0 + s1·(a1 - a0) + s2·(a2 - a0)` with the shares s1, s2 of the second and third vertex, made
//! perspective-correct once a pixel: shares over w and 1 over w are linear on the screen. So what is the same at all
//! vertices is the same, to the bit, at every pixel.

use std::ops::Range;

use glam::Vec4;

use super::pixel::{Attribute, LANES, PixelBatch, PixelInputs, QUADS};
use super::setup::{Planes, Setup};
use super::state::ShadeMode;
use super::{Vertex, fog_unit, unit};
use crate::isa::WriteMask;

/// The depths of a quad, each in 0 to 1.
#[inline(always)]
pub(super) fn depths(setup: &Setup, x: i32, y: i32) -> [f32; 4] {
    setup.planes.quad(x, y)[Planes::Z].map(unit)
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
#[inline(always)]
pub(super) fn quad_shares(planes: &Planes, x: i32, y: i32) -> ([[f32; 4]; 2], [f32; 4]) {
    let quantities = planes.quad(x, y);
    let floor = planes.inverse_w_floor;
    let w = quantities[Planes::INVERSE_W]
        .map(|inverse_w| 1.0 / if inverse_w > floor { inverse_w } else { floor });
    let share = |over_w: [f32; 4]| std::array::from_fn(|i| over_w[i] * w[i]);
    (Planes::SHARES.map(|which| share(quantities[which])), w)
}

/// The shares of the second and of the third vertex at the pixels of a batch.
type Shares = [[f32; LANES]; 2];

impl Interpolator<'_> {
    /// Completes a batch whose quads have positions and depths. `setup` gives the set-up of each quad.
    #[inline(always)]
    pub(super) fn fill<'s>(&self, batch: &mut PixelBatch, setup: impl Fn(usize) -> &'s Setup) {
        let mut shares = [[0.0; LANES]; 2];
        let quads = batch.quads.min(QUADS);
        for quad in 0..quads {
            let planes = &setup(quad).planes;
            let (of_quad, w) = quad_shares(planes, batch.x[4 * quad], batch.y[4 * quad]);
            for (share, of_quad) in shares.iter_mut().zip(of_quad) {
                share.as_chunks_mut().0[quad] = of_quad;
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

    #[inline(always)]
    fn fill_quads(
        &self,
        batch: &mut PixelBatch,
        setup: &Setup,
        shares: &Shares,
        quads: Range<usize>,
    ) {
        let vertex = |index: u32| &self.vertices[index as usize];
        let corners = setup.vertices.map(vertex);
        let part = Part {
            shares,
            lanes: 4 * quads.start..4 * quads.end,
        };
        let colors = |color: fn(&Vertex) -> Vec4| match self.shade {
            ShadeMode::Gouraud => corners.map(|corner| color(corner).to_array().map(unit)),
            ShadeMode::Flat => [color(vertex(setup.provoking)).to_array().map(unit); 3],
        };
        // A colour is taken into 0 to 1 again, as pixel shaders read it.
        let inputs = &self.inputs;
        if !inputs.diffuse.is_empty() {
            let ends = colors(|vertex| vertex.diffuse);
            part.mix(&mut batch.diffuse, inputs.diffuse, &ends, unit);
        }
        if !inputs.specular.is_empty() {
            let ends = colors(|vertex| vertex.specular);
            part.mix(&mut batch.specular, inputs.specular, &ends, unit);
        }
        if self.fog {
            let ends = corners.map(|corner| fog_unit(corner.fog));
            part.mix_component(&mut batch.fog, ends, unit);
        }
        for (set, coordinates) in batch.texcoords.iter_mut().enumerate() {
            let components = inputs.texcoords[set];
            if components.is_empty() {
                continue;
            }
            let ends = match setup.sprite {
                false => corners.map(|corner| corner.texcoords[set].to_array()),
                // In a sprite the shares are the position: 0 to 1 across and down.
                true => [[0.0; 4], [1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0]],
            };
            part.mix(coordinates, components, &ends, |value| value);
        }
    }
}

/// The pixels of a batch that belong to one shape.
struct Part<'a> {
    shares: &'a Shares,
    lanes: Range<usize>,
}

impl Part<'_> {
    /// Values of the vertices to values of the pixels, each passed through `finish`.
    #[inline(always)]
    fn mix(
        &self,
        values: &mut Attribute,
        components: WriteMask,
        ends: &[[f32; 4]; 3],
        finish: impl Fn(f32) -> f32,
    ) {
        for component in components.components() {
            let ends = ends.map(|end| end[component]);
            self.mix_component(&mut values[component], ends, &finish);
        }
    }

    #[inline(always)]
    fn mix_component(
        &self,
        values: &mut [f32; LANES],
        [a0, a1, a2]: [f32; 3],
        finish: impl Fn(f32) -> f32,
    ) {
        let (to_second, to_third) = (a1 - a0, a2 - a0);
        let value = |second: f32, third: f32| finish(a0 + second * to_second + third * to_third);
        let [second, third] = self.shares;
        if self.lanes == (0..LANES) {
            // Large triangles fill whole batches: a loop of known length.
            for lane in 0..LANES {
                values[lane] = value(second[lane], third[lane]);
            }
            return;
        }
        let shares = second
            .as_chunks::<4>()
            .0
            .iter()
            .zip(third.as_chunks::<4>().0);
        let (first, count) = (self.lanes.start / 4, self.lanes.len() / 4);
        let quads = values.as_chunks_mut::<4>().0.iter_mut().zip(shares);
        for (values, (second, third)) in quads.skip(first).take(count) {
            *values = std::array::from_fn(|i| value(second[i], third[i]));
        }
    }
}

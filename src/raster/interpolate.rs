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
    let [quad] = setup.planes.quads(Planes::Z, &[x], &[y]);
    quad.map(unit)
}

/// What of the inputs is to be computed, and how.
#[derive(Debug, Clone, Copy)]
pub(super) struct Interpolator<'a> {
    pub(super) vertices: &'a [Vertex],
    pub(super) inputs: PixelInputs,
    pub(super) shade: ShadeMode,
    pub(super) fog: bool,
}

/// The shares of the second and of the third vertex at the pixels of quads that begin at these places, and `w / w_scale`
/// there.
#[inline(always)]
pub(super) fn quad_shares<const Q: usize>(
    planes: &Planes,
    x: &[i32; Q],
    y: &[i32; Q],
) -> ([[[f32; 4]; Q]; 2], [[f32; 4]; Q]) {
    let floor = planes.inverse_w_floor;
    let mut w = planes.quads(Planes::INVERSE_W, x, y);
    for w in w.as_flattened_mut() {
        *w = 1.0 / if *w > floor { *w } else { floor };
    }
    let mut shares = [[[0.0; 4]; Q]; 2];
    for (share, which) in shares.iter_mut().zip(Planes::SHARES) {
        *share = planes.quads(which, x, y);
        for (share, w) in share.as_flattened_mut().iter_mut().zip(w.as_flattened()) {
            *share *= w;
        }
    }
    (shares, w)
}

/// The shares of the second and of the third vertex at the pixels of a batch.
type Shares = [[[f32; 4]; QUADS]; 2];

impl Interpolator<'_> {
    /// Completes a batch whose quads have positions and depths. `setup` gives the set-up of each quad.
    #[inline(always)]
    pub(super) fn fill<'s>(&self, batch: &mut PixelBatch, setup: impl Fn(usize) -> &'s Setup) {
        let quads = batch.quads.min(QUADS);
        if quads > 0 && run_end(quads, 0, &setup) == quads {
            // Large triangles fill whole batches: loops of known length, over what there is and what there is not.
            let shape = setup(0);
            let (mut x, mut y) = ([0; QUADS], [0; QUADS]);
            for (quad, (x, y)) in x.iter_mut().zip(&mut y).enumerate() {
                (*x, *y) = (batch.x[4 * quad], batch.y[4 * quad]);
            }
            let (shares, w) = quad_shares(&shape.planes, &x, &y);
            for (to, w) in batch.w.iter_mut().zip(w.as_flattened()) {
                *to = w * shape.planes.w_scale;
            }
            self.fill_quads(batch, shape, &shares, 0..QUADS);
            return;
        }
        let mut shares = [[[0.0; 4]; QUADS]; 2];
        let mut first = 0;
        while first < quads {
            let (shape, end) = (setup(first), run_end(quads, first, &setup));
            for quad in first..end {
                let (x, y) = (batch.x[4 * quad], batch.y[4 * quad]);
                let (of_quad, [w]) = quad_shares(&shape.planes, &[x], &[y]);
                for (share, [of_quad]) in shares.iter_mut().zip(of_quad) {
                    share[quad] = of_quad;
                }
                batch.w.as_chunks_mut().0[quad] = w.map(|w| w * shape.planes.w_scale);
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
        let part = Part { shares, quads };
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

/// The end of the quads from `first` on that have one shape: they follow each other.
#[inline(always)]
fn run_end<'s>(quads: usize, first: usize, setup: &impl Fn(usize) -> &'s Setup) -> usize {
    let shape = setup(first);
    let mut end = first + 1;
    while end < quads && std::ptr::eq(setup(end), shape) {
        end += 1;
    }
    end
}

/// The pixels of a batch that belong to one shape.
struct Part<'a> {
    shares: &'a Shares,
    quads: Range<usize>,
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
        if self.quads == (0..QUADS) {
            let shares = second.as_flattened().iter().zip(third.as_flattened());
            for (to, (second, third)) in values.iter_mut().zip(shares) {
                *to = value(*second, *third);
            }
            return;
        }
        let quads = values
            .as_chunks_mut::<4>()
            .0
            .iter_mut()
            .zip(second.iter().zip(third));
        let (first, count) = (self.quads.start, self.quads.len());
        for (values, (second, third)) in quads.skip(first).take(count) {
            *values = std::array::from_fn(|i| value(second[i], third[i]));
        }
    }
}

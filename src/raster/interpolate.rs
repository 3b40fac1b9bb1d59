//! The inputs of pixels from those of vertices.
//!
//! Every attribute is `a0 + s1·(a1 - a0) + s2·(a2 - a0)` with the shares s1, s2 of the second and third vertex, made
//! perspective-correct once a pixel: shares over w and 1 over w are linear on the screen. So what is the same at all
//! vertices is the same, to the bit, at every pixel.

use std::ops::Range;

use super::pixel::{LANES, PixelBatch, PixelInputs, QUADS};
use super::setup::{Owner, Planes, Quantities};
use super::state::ShadeMode;
use super::vertices::{Column, Output, Vertices};
use super::{fog_unit, unit};
use crate::isa::WriteMask;

/// The depths of a quad, each in 0 to 1.
#[inline(always)]
pub(super) fn depths(quantities: &Quantities) -> [f32; 4] {
    quantities[Planes::Z].map(unit)
}

/// The depths of a block, each in 0 to 1.
#[inline(always)]
pub(super) fn block_depths(planes: &Planes, x: i32, y: i32) -> [f32; LANES] {
    let mut depths = planes.block(Planes::Z, x, y);
    for depth in &mut depths {
        *depth = unit(*depth);
    }
    depths
}

/// What of the inputs is to be computed, and how.
pub(super) struct Interpolator<'a> {
    shade: ShadeMode,
    wanted: Vec<Wanted<'a>>,
}

/// A component that is interpolated, and where the vertices have it.
struct Wanted<'a> {
    output: Output,
    component: usize,
    ends: Column<'a>,
}

/// The shares of the second and of the third vertex at the pixels of a batch, and whose vertices these are.
pub(super) struct Shares {
    /// Times [`Self::inverse_w`] until [`Interpolator::fill`] divides them.
    of: [[f32; LANES]; 2],
    inverse_w: [f32; LANES],
    w_scale: [f32; LANES],
    /// The shapes of the batch in order, each with its first quad.
    runs: [(usize, Owner); QUADS],
    count: usize,
    /// The shape of the quads that come next, and whether it is the last of the runs.
    owner: Owner,
    open: bool,
}

impl Shares {
    /// Of a batch of no quads.
    #[inline(always)]
    pub(super) fn empty() -> Self {
        Self {
            of: [[0.0; LANES]; 2],
            inverse_w: [1.0; LANES],
            w_scale: [1.0; LANES],
            runs: [(0, Owner::default()); QUADS],
            count: 0,
            owner: Owner::default(),
            open: false,
        }
    }

    /// From here on quads are those of another shape.
    #[inline(always)]
    pub(super) fn begin(&mut self, owner: Owner) {
        self.owner = owner;
        self.open = false;
    }

    /// Puts a quad in its place.
    #[inline(always)]
    pub(super) fn place(&mut self, quad: usize, planes: &Planes, quantities: &Quantities) {
        for (share, which) in self.of.iter_mut().zip(Planes::SHARES) {
            share.as_chunks_mut().0[quad] = quantities[which];
        }
        let inverse_w = &quantities[Planes::INVERSE_W];
        self.inverse_w.as_chunks_mut::<4>().0[quad] =
            std::array::from_fn(|i| planes.divisor(inverse_w[i]));
        self.w_scale.as_chunks_mut().0[quad] = [planes.w_scale; 4];
        if !self.open {
            self.runs[self.count] = (quad, self.owner);
            self.count += 1;
            self.open = true;
        }
    }

    /// Puts the quads of a block in their places, which must be free.
    #[inline(always)]
    pub(super) fn place_block(&mut self, owner: Owner, planes: &Planes, x: i32, y: i32) {
        for (share, which) in self.of.iter_mut().zip(Planes::SHARES) {
            *share = planes.block(which, x, y);
        }
        let inverse_w = planes.block(Planes::INVERSE_W, x, y);
        for (divisor, inverse_w) in self.inverse_w.iter_mut().zip(inverse_w) {
            *divisor = planes.divisor(inverse_w);
        }
        self.w_scale = [planes.w_scale; LANES];
        self.runs[0] = (0, owner);
        self.count = 1;
    }

    /// The shares at the pixels of a quad, once the batch is filled.
    pub(super) fn of_quad(&self, quad: usize) -> [[f32; 4]; 2] {
        self.of.map(|share| share.as_chunks().0[quad])
    }

    /// Divides all shares by w; the batch is told the w.
    #[inline(always)]
    fn divide(&mut self, batch: &mut PixelBatch) {
        let [second, third] = &mut self.of;
        for lane in 0..LANES {
            let w = 1.0 / self.inverse_w[lane];
            second[lane] *= w;
            third[lane] *= w;
            batch.w[lane] = w * self.w_scale[lane];
        }
    }
}

impl<'a> Interpolator<'a> {
    /// For these inputs, and the fog of the vertices.
    pub(super) fn new(
        vertices: &'a Vertices,
        inputs: &PixelInputs,
        shade: ShadeMode,
        fog: bool,
    ) -> Self {
        let colors = [
            (Output::Diffuse, inputs.diffuse),
            (Output::Specular, inputs.specular),
        ];
        let sets = { inputs.texcoords.iter().enumerate() }
            .map(|(set, components)| (Output::Texcoords(set), *components));
        let fog = fog.then_some((Output::Fog, WriteMask::component(0)));
        let wanted =
            (colors.into_iter().chain(sets).chain(fog)).flat_map(|(output, components)| {
                { components.components() }.map(move |component| Wanted {
                    output,
                    component,
                    ends: vertices.column(output, component),
                })
            });
        Self {
            shade,
            wanted: wanted.collect(),
        }
    }

    /// Completes a batch whose quads are in their places. The shares are ready for the next one.
    #[inline(always)]
    pub(super) fn fill(&self, batch: &mut PixelBatch, shares: &mut Shares) {
        shares.divide(batch);
        let mut end = batch.quads.min(QUADS);
        // The vertices of a shape are fetched once for all of its quads.
        for run in (0..shares.count).rev() {
            let (first, owner) = &shares.runs[run];
            self.fill_quads(batch, owner, &shares.of, *first..end);
            end = *first;
        }
        shares.count = 0;
        shares.open = false;
    }

    #[inline(always)]
    fn fill_quads(
        &self,
        batch: &mut PixelBatch,
        owner: &Owner,
        shares: &[[f32; LANES]; 2],
        quads: Range<usize>,
    ) {
        let part = Part { shares, quads };
        let colored = match self.shade {
            ShadeMode::Gouraud => owner.vertices,
            ShadeMode::Flat => [owner.provoking; 3],
        };
        for wanted in &self.wanted {
            let component = wanted.component;
            let ends = |[a, b, c]: [u32; 3]| wanted.ends.at_three(a, b, c);
            match wanted.output {
                Output::Texcoords(set) => {
                    let ends = match (owner.sprite, component) {
                        (false, _) => ends(owner.vertices),
                        // In a sprite the shares are the position: 0 to 1 across and down.
                        (true, 0) => [0.0, 1.0, 0.0],
                        (true, 1) => [0.0, 0.0, 1.0],
                        (true, _) => [0.0; 3],
                    };
                    part.mix(&mut batch.texcoords[set][component], ends, |value| value);
                }
                Output::Fog => {
                    part.mix(&mut batch.fog, ends(owner.vertices).map(fog_unit), unit);
                }
                // A colour is taken into 0 to 1 again, as pixel shaders read it.
                Output::Specular => part.mix(
                    &mut batch.specular[component],
                    ends(colored).map(unit),
                    unit,
                ),
                _ => part.mix(&mut batch.diffuse[component], ends(colored).map(unit), unit),
            }
        }
    }
}

/// The pixels of a batch that belong to one shape.
struct Part<'a> {
    shares: &'a [[f32; LANES]; 2],
    quads: Range<usize>,
}

impl Part<'_> {
    /// A component at the vertices to the same at the pixels, passed through `finish`.
    #[inline(always)]
    fn mix(&self, values: &mut [f32; LANES], [a0, a1, a2]: [f32; 3], finish: impl Fn(f32) -> f32) {
        let (to_second, to_third) = (a1 - a0, a2 - a0);
        let value = |second: f32, third: f32| finish(a0 + second * to_second + third * to_third);
        let [second, third] = self.shares;
        if self.quads == (0..QUADS) {
            // Large triangles fill whole batches: a loop of known length.
            for lane in 0..LANES {
                values[lane] = value(second[lane], third[lane]);
            }
            return;
        }
        let (values, second, third) = (
            values.as_chunks_mut::<4>().0,
            second.as_chunks::<4>().0,
            third.as_chunks::<4>().0,
        );
        for quad in self.quads.start..self.quads.end.min(QUADS) {
            for i in 0..4 {
                values[quad][i] = value(second[quad][i], third[quad][i]);
            }
        }
    }
}

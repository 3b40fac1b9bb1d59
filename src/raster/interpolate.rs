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
    /// What is interpolated at the vertices of the shape whose pixels are next: in a batch of a block, of the block.
    ends: Vec<[f32; 3]>,
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
            ends: Vec::new(),
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

    /// Puts the quads of a block in their places. [`Interpolator::begin_blocks`] must have been told of their shape.
    #[inline(always)]
    pub(super) fn place_block(&mut self, planes: &Planes, x: i32, y: i32) {
        for (share, which) in self.of.iter_mut().zip(Planes::SHARES) {
            *share = planes.block(which, x, y);
        }
        let inverse_w = planes.block(Planes::INVERSE_W, x, y);
        for (divisor, inverse_w) in self.inverse_w.iter_mut().zip(inverse_w) {
            *divisor = planes.divisor(inverse_w);
        }
        self.w_scale = [planes.w_scale; LANES];
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

    /// Fetches what the vertices of a shape have, for all of its blocks.
    #[inline(always)]
    pub(super) fn begin_blocks(&self, owner: &Owner, shares: &mut Shares) {
        self.fetch(owner, &mut shares.ends);
    }

    /// Completes a batch whose quads are in their places. The shares are ready for the next one.
    #[inline(always)]
    pub(super) fn fill(&self, batch: &mut PixelBatch, shares: &mut Shares) {
        shares.divide(batch);
        if batch.block {
            self.mix(batch, &shares.ends, &shares.of, 0..QUADS);
            return;
        }
        let mut end = batch.quads.min(QUADS);
        // The vertices of a shape are fetched once for all of its quads.
        for run in (0..shares.count).rev() {
            let (first, owner) = &shares.runs[run];
            self.fetch(owner, &mut shares.ends);
            self.mix(batch, &shares.ends, &shares.of, *first..end);
            end = *first;
        }
        shares.count = 0;
        shares.open = false;
    }

    /// What is interpolated, at the vertices of a shape.
    #[inline(always)]
    fn fetch(&self, owner: &Owner, ends: &mut Vec<[f32; 3]>) {
        let colored = match self.shade {
            ShadeMode::Gouraud => owner.vertices,
            ShadeMode::Flat => [owner.provoking; 3],
        };
        ends.clear();
        for wanted in &self.wanted {
            let at = |[a, b, c]: [u32; 3]| wanted.ends.at_three(a, b, c);
            ends.push(match (wanted.output, owner.sprite, wanted.component) {
                // In a sprite the shares are the position: 0 to 1 across and down.
                (Output::Texcoords(_), true, 0) => [0.0, 1.0, 0.0],
                (Output::Texcoords(_), true, 1) => [0.0, 0.0, 1.0],
                (Output::Texcoords(_), true, _) => [0.0; 3],
                (Output::Texcoords(_), false, _) => at(owner.vertices),
                (Output::Fog, ..) => at(owner.vertices).map(fog_unit),
                _ => at(colored).map(unit),
            });
        }
    }

    /// From what the vertices of a shape have to its pixels.
    #[inline(always)]
    fn mix(
        &self,
        batch: &mut PixelBatch,
        ends: &[[f32; 3]],
        shares: &[[f32; LANES]; 2],
        quads: Range<usize>,
    ) {
        let part = Part { shares, quads };
        for (wanted, ends) in self.wanted.iter().zip(ends) {
            let component = wanted.component;
            match wanted.output {
                Output::Texcoords(set) => {
                    part.mix(&mut batch.texcoords[set][component], *ends, |value| value);
                }
                Output::Fog => part.mix(&mut batch.fog, *ends, unit),
                // A colour is taken into 0 to 1 again, as pixel shaders read it.
                Output::Specular => part.mix(&mut batch.specular[component], *ends, unit),
                _ => part.mix(&mut batch.diffuse[component], *ends, unit),
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

//! The samples of a batch: those at the same coordinates find their texels once.

use super::step::Turn;
use crate::exec::environment::{Environment, STAGES, Stage};
use crate::kernel::{Plan, RowOp};
use crate::texture::{Memory, Places, Sample, UNBOUND, sample_quads, share_places};

/// Where the samples of a plan are read, as far as they share it.
#[derive(Clone, Debug)]
pub(super) struct Samples<const N: usize> {
    /// Of each step what a sample does first; of other steps nothing of meaning.
    steps: Vec<Sharing>,
    /// The first is for those that nobody shares.
    places: Vec<Places<N>>,
    memory: Memory<N>,
    /// What was read last.
    texels: [[f32; N]; 4],
}

/// Which places a sample uses.
#[derive(Clone, Copy, Debug, Default)]
struct Sharing {
    places: usize,
    /// Whether a step before it has found them.
    found: bool,
}

impl<const N: usize> Default for Samples<N> {
    fn default() -> Self {
        Self {
            steps: Vec::new(),
            places: vec![Places::default()],
            memory: Memory::default(),
            texels: [[0.0; N]; 4],
        }
    }
}

impl<const N: usize> Samples<N> {
    /// Sees which samples of a plan find the same texels with the textures that are set.
    pub(super) fn load(&mut self, plan: &Plan, environment: &Environment<'_>) {
        let stage = |number: usize| match plan.steps.get(number)?.op {
            RowOp::Sample(stage) => {
                let stage = &environment.stages[usize::from(stage) % STAGES];
                Some((stage.texture?, &stage.sampler))
            }
            _ => None,
        };
        self.steps = vec![Sharing::default(); plan.steps.len()];
        self.places.truncate(1);
        for (number, step) in plan.steps.iter().enumerate() {
            let Some(own) = stage(number) else { continue };
            // What runs once leaves its places to be written over by the next batch of another draw.
            let first = if number < plan.once { 0 } else { plan.once };
            let same = (first..number).find(|other| {
                plan.steps[*other].place == step.place
                    && stage(*other).is_some_and(|other| share_places(own, other))
            });
            let Some(same) = same else { continue };
            if self.steps[same].places == 0 {
                self.steps[same].places = self.places.len();
                self.places.push(Places::default());
            }
            self.steps[number] = Sharing {
                places: self.steps[same].places,
                found: true,
            };
        }
    }

    /// Takes the sample of a step: the channels that are wanted; the others are anything.
    #[inline(always)]
    pub(super) fn take(
        &mut self,
        turn: Turn,
        stage: &Stage<'_>,
        coords: [&[f32; N]; 3],
        channels: [bool; 4],
    ) -> &[[f32; N]; 4] {
        let sharing = self.steps.get(turn.number).copied().unwrap_or_default();
        let out = &mut self.texels;
        match (stage.texture, self.places.get_mut(sharing.places)) {
            (Some(texture), Some(places)) if N > 4 && N.is_multiple_of(4) => {
                turn.simd.run(Sample {
                    texture,
                    sampler: &stage.sampler,
                    coords,
                    lanes: turn.lanes,
                    places,
                    memory: &mut self.memory,
                    found: sharing.found,
                    channels,
                    out,
                });
            }
            (None, _) => {
                for (channel, row) in out.iter_mut().enumerate() {
                    *row = [UNBOUND[channel]; N];
                }
            }
            (texture, _) => {
                let coords = [*coords[0], *coords[1], *coords[2]];
                sample_quads(texture, &stage.sampler, &coords, out);
            }
        }
        out
    }
}

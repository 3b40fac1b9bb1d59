//! One generated shader on both paths.

use super::MatchError;
use crate::diagnostic::SourceMap;
use crate::exec::{bind_constants, overrides_definitions};
use crate::generate::{self, Generated, INVOCATIONS, Outcome, Random, Textures};
use crate::gpu::{Batch, Device, GpuError, Program, Results, StageUniforms, Uniforms};
use crate::isa::ShaderKind;
use crate::kernel::{Kernel, Slot};
use crate::raster::{FogDistance, FogMode, RenderState};
use crate::semantics::saturate;
use crate::syntax;
use crate::wgsl::{self, Fog, Translation, translate};

/// A generated shader, and how it is translated.
#[derive(Clone, Debug)]
pub struct Subject {
    /// The shader with everything that it is run with.
    pub generated: Generated,
    /// What it was generated with.
    pub options: generate::Options,
    /// What it is translated with.
    pub translation: wgsl::Options,
}

/// What the GPU is given instead of a listing. It is how a test of the comparison itself makes the two paths differ.
pub type Change<'a> = &'a (dyn Fn(&str) -> String + Sync);

/// Where the paths part.
#[derive(Clone, Debug, PartialEq)]
pub enum Difference {
    /// The device does not take the translation.
    Refused(String),
    /// One path discards a pixel and the other does not.
    Killed {
        /// The invocation, from 0.
        invocation: usize,
        /// Whether the interpreter discards it.
        cpu: bool,
    },
    /// A number is further away than it may be.
    Number {
        /// The register.
        slot: Slot,
        /// The component, 0 to 3.
        component: usize,
        /// The invocation, from 0.
        invocation: usize,
        /// What the interpreter has.
        cpu: f32,
        /// What the GPU has.
        gpu: f32,
        /// How far it may be from the interpreter's.
        bound: f32,
    },
}

/// What a comparison found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Comparison {
    /// Where the paths part.
    pub differences: Vec<Difference>,
    /// How many numbers were compared.
    pub numbers: u64,
    /// How many of them have the same bits, or are zeros.
    pub equal: u64,
    /// The largest part of its bound that a difference took, of bounds that are not 0.
    pub share: f64,
}

impl Subject {
    /// The shader of a seed. The listing is the one that [`generate::shader`] writes with these options; `textures` are those of
    /// their model.
    pub fn new(options: generate::Options, seed: u64, textures: &Textures) -> Self {
        let version = options.version;
        let generated = generate::shader(&mut Random::new(seed), &options, textures);
        // Not the numbers that the shader was made of.
        let mut random = Random::new(!seed);
        let mut translation = wgsl::Options {
            level_zero: true,
            half_pixel: false,
            exact_dots: random.chance(50),
            overridable_definitions: random.chance(25) || overrides(&generated),
            fog: (version.kind() == ShaderKind::Vertex).then_some(Fog {
                table: FogMode::None,
                distance: FogDistance::Z,
            }),
            ..wgsl::Options::default()
        };
        let seamless = random.chance(50);
        for (stage, made) in translation.stages.iter_mut().zip(&generated.stages) {
            stage.texture = Some(made.kind);
            stage.seamless = seamless;
            stage.weights = textures.sampler().weights;
        }
        Self {
            generated,
            options,
            translation,
        }
    }

    /// The same with another program; none if what comes out of that cannot be compared.
    pub(super) fn with(
        &self,
        program: &crate::program::Program,
        textures: &Textures,
    ) -> Option<Self> {
        let generated = self.generated.with(program, &self.options, textures)?;
        Some(Self {
            generated,
            ..self.clone()
        })
    }

    /// The translation of its listing, with the constants that are bound.
    fn translated(
        &self,
        change: Option<Change<'_>>,
    ) -> Result<(Translation, Vec<[f32; 4]>), MatchError> {
        let listing = match change {
            Some(change) => change(&self.generated.listing),
            None => self.generated.listing.clone(),
        };
        let unreadable = || MatchError::Unreadable(listing.clone());
        let mut sources = SourceMap::new();
        let file = sources.add("generated", listing.as_str());
        let parsed = file.map(syntax::parse).map_err(|_| unreadable())?;
        let program = parsed.program.ok_or_else(unreadable)?;
        let kernel = self.generated.lower(&program).map_err(|_| unreadable())?;
        let stage = wgsl::Stage {
            program: &program,
            kernel: &kernel,
            source: &sources,
        };
        let (vertex, pixel) = match kernel.version.kind() {
            ShaderKind::Vertex => (Some(stage), None),
            ShaderKind::Pixel => (None, Some(stage)),
        };
        let translation = translate(vertex, pixel, &self.translation).map_err(|error| {
            MatchError::Gpu(GpuError::Translate {
                draw: listing.clone(),
                error,
            })
        })?;
        Ok((translation, self.constants(&kernel)))
    }

    fn constants(&self, kernel: &Kernel) -> Vec<[f32; 4]> {
        bind_constants(kernel, &self.generated.constants)
    }

    /// What the interpreter has of one component of an outcome, as the rasterizer takes it: colours and fog from 0 to 1.
    pub(super) fn expected(outcome: &Outcome, invocation: usize, component: usize) -> f32 {
        let value = outcome.values[invocation][component];
        let clamped = (0..2).filter_map(Slot::color_output).chain([Slot::FOG]);
        match clamped.into_iter().any(|slot| slot == outcome.slot) {
            true => saturate(value),
            false => value,
        }
    }

    /// Compares what the GPU left behind with what the interpreter did.
    pub fn compare(&self, results: &Results) -> Comparison {
        let mut comparison = Comparison::default();
        for invocation in 0..INVOCATIONS {
            let cpu = self.generated.killed[invocation];
            let gpu = results.killed.get(invocation) == Some(&true);
            if cpu != gpu {
                let killed = Difference::Killed { invocation, cpu };
                comparison.differences.push(killed);
            }
            if cpu || gpu {
                // Nothing is left of a pixel that is discarded.
                continue;
            }
            for outcome in &self.generated.outcomes {
                let found = results
                    .outputs
                    .iter()
                    .find(|(slot, _)| *slot == outcome.slot);
                let values = found.and_then(|(_, values)| values.get(invocation));
                for component in outcome.mask.components() {
                    let number = Difference::Number {
                        slot: outcome.slot,
                        component,
                        invocation,
                        cpu: Self::expected(outcome, invocation, component),
                        gpu: values.map_or(f32::NAN, |value| value[component]),
                        bound: outcome.errors[invocation][component],
                    };
                    comparison.take(number);
                }
            }
        }
        comparison
    }
}

/// Whether a constant is set that the shader defines, and replaces it.
fn overrides(generated: &Generated) -> bool {
    let kernel = generated.lower(&generated.program);
    kernel.is_ok_and(|kernel| {
        overrides_definitions(&kernel, &bind_constants(&kernel, &generated.constants))
    })
}

impl Comparison {
    fn take(&mut self, number: Difference) {
        let Difference::Number {
            cpu, gpu, bound, ..
        } = number
        else {
            return;
        };
        self.numbers += 1;
        // The sign of a zero is left to the GPU.
        if cpu == gpu {
            self.equal += 1;
            return;
        }
        // Numbers that are not normal may be flushed to zero.
        let off = (f64::from(cpu) - f64::from(gpu)).abs() - f64::from(f32::MIN_POSITIVE);
        let bound = f64::from(bound);
        // NaN is no nearer than anything.
        let near = off <= bound;
        if near && bound > 0.0 {
            self.share = self.share.max(off / bound);
        }
        if !near {
            self.differences.push(number);
        }
    }

    /// Takes over what another comparison found, but for the differences.
    pub(super) fn count(&mut self, other: &Self) {
        self.numbers += other.numbers;
        self.equal += other.equal;
        self.share = self.share.max(other.share);
    }
}

/// Runs shaders on a device, all in one pipeline, and compares. If the device does not take that pipeline, each has one for
/// itself, so that it is known which one it does not take.
pub fn compare(
    device: &Device,
    subjects: &[Subject],
    textures: &Textures,
    change: Option<Change<'_>>,
) -> Result<Vec<Comparison>, MatchError> {
    match run_together(subjects, textures, change, &|batch| batch.run(device)) {
        Ok(results) => Ok((subjects.iter().zip(&results))
            .map(|(subject, results)| subject.compare(results))
            .collect()),
        Err(MatchError::Gpu(GpuError::Device(why))) => match subjects {
            [_] => Ok(vec![Comparison {
                differences: vec![Difference::Refused(why)],
                ..Comparison::default()
            }]),
            _ => {
                let alone =
                    |subject| compare(device, std::slice::from_ref(subject), textures, change);
                let all = subjects.iter().map(alone);
                let all = all.collect::<Result<Vec<_>, _>>()?;
                Ok(all.into_iter().flatten().collect())
            }
        },
        Err(error) => Err(error),
    }
}

/// Puts shaders into one batch and has it run; gives what each left behind.
///
/// # Errors
/// Those of `run`, and [`MatchError`] for what cannot be translated.
pub fn run_together(
    subjects: &[Subject],
    textures: &Textures,
    change: Option<Change<'_>>,
    run: &dyn Fn(&Batch<'_>) -> Result<Vec<Results>, GpuError>,
) -> Result<Vec<Results>, MatchError> {
    let translated = subjects.iter().map(|subject| subject.translated(change));
    let translated = translated.collect::<Result<Vec<_>, _>>()?;
    let state = RenderState::default();
    let programs: Vec<_> = (subjects.iter().zip(&translated))
        .map(|(subject, (translation, constants))| {
            program(subject, translation, constants, &state, textures)
        })
        .collect();
    run(&Batch::new(&programs, INVOCATIONS)).map_err(MatchError::Gpu)
}

/// A shader as a batch takes it.
fn program<'a>(
    subject: &'a Subject,
    translation: &'a Translation,
    constants: &'a [[f32; 4]],
    state: &'a RenderState,
    textures: &'a Textures,
) -> Program<'a> {
    let generated = &subject.generated;
    let stages = &generated.stages;
    let vertex = translation.reflection.vertex.as_ref();
    Program {
        translation,
        uniforms: Uniforms {
            constants,
            state,
            viewport: [1.0; 2],
            stages: stages.map(|stage| StageUniforms {
                bump: stage.bump,
                ..StageUniforms::default()
            }),
        },
        textures: stages.each_ref().map(|stage| {
            let texture = textures.get(stage.kind, stage.signed)?;
            Some((texture, textures.sampler()))
        }),
        inputs: (generated.inputs.iter())
            .map(|(slot, values)| (*slot, values.as_slice()))
            .collect(),
        point_size: vertex.is_some_and(|vertex| vertex.point_size),
    }
}

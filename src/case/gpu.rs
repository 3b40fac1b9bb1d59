//! The GPU's way to run the invocations of a case.

use super::run::{slot_of, unsized_point, without_vertex_shader};
use super::slack::{Slack, each_texel};
use super::{Case, Invocation, Observed, Quantity, Value, Verdict, judge, observe};
use crate::exec::{self, bind_constants, overrides_definitions};
use crate::gpu::{Device, GpuError, InvocationInputs, Invocations, Shading, stage_options};
use crate::isa::ShaderKind;
use crate::kernel::{Kernel, Slot};
use crate::raster::fog_unit;
use crate::scene::Shader;
use crate::wgsl::{Observed as Registers, Options, Stage, Translation, translate};

/// Runs cases on a GPU. What can be kept from case to case is kept.
#[derive(Debug)]
pub struct OnGpu<'d> {
    invocations: Invocations<'d>,
    float_filtering: bool,
}

/// What shaders of a kind are asked for, in the order of the registers that are looked at.
struct Asked {
    quantities: Vec<(Quantity, Slot)>,
}

impl<'d> OnGpu<'d> {
    /// Cases on a device.
    pub fn new(device: &'d Device) -> Self {
        Self {
            invocations: Invocations::new(device),
            float_filtering: device.adapter().float_filtering,
        }
    }

    /// Runs all invocations of a case and judges them. The verdicts are in the order of [`Case::invocations`].
    ///
    /// # Errors
    /// What [`Self::observe`] gives.
    pub fn check(&mut self, case: &Case) -> Result<Vec<Verdict>, GpuError> {
        let observed = self.observe(case)?;
        let verdict = |(invocation, observed): (&Invocation, &Observed)| {
            judge(invocation, observed, |quantity, component| {
                observe(case, invocation).origin(quantity, component)
            })
        };
        Ok(case
            .invocations
            .iter()
            .zip(&observed)
            .map(verdict)
            .collect())
    }

    /// Runs all invocations of a case: the translations of its shaders, linked if there are two, each invocation as a point
    /// by itself.
    ///
    /// # Errors
    /// [`GpuError`] for what the device cannot do, and for what it reports.
    pub fn observe(&mut self, case: &Case) -> Result<Vec<Observed>, GpuError> {
        let inputs: Vec<InvocationInputs> = case
            .invocations
            .iter()
            .map(|one| inputs(case, one))
            .collect();
        let wanted: Vec<Quantity> = case
            .invocations
            .iter()
            .flat_map(Invocation::wanted)
            .collect();
        let mut observed = vec![Observed::default(); inputs.len()];
        let mut expected = case
            .invocations
            .iter()
            .flat_map(|one| std::iter::once(&one.expect).chain(&one.accept));
        let killed = expected.any(|expectation| expectation.killed.is_some());
        if killed || wanted.iter().any(|quantity| *quantity != Quantity::Frame) {
            let [vertex, pixel] =
                [ShaderKind::Vertex, ShaderKind::Pixel].map(|kind| Asked::of(case, kind, &wanted));
            let registers = Registers {
                vertex: vertex.slots(),
                pixel: pixel.slots(),
            };
            let options = options(case, &inputs, registers);
            let translation = translation(case, &options)?;
            let shading = shading(case, &translation);
            let seen = self.invocations.registers(&shading, &inputs)?;
            for (observed, seen) in observed.iter_mut().zip(&seen) {
                let numbers = vertex.values(case, &seen.vertex);
                let numbers = numbers
                    .chain(pixel.values(case, &seen.pixel))
                    .chain([(Quantity::Depth, [seen.depth, 0.0, 0.0, 0.0])]);
                observed.killed = seen.killed;
                observed.values.extend(numbers.map(value));
            }
        }
        if wanted.contains(&Quantity::Frame) {
            let options = options(case, &inputs, Registers::default()).with_state(&case.state);
            // A point by itself is not clipped.
            let options = Options {
                clip_planes: 0,
                ..options
            };
            let translation = translation(case, &options)?;
            let shading = shading(case, &translation);
            let frames = self.invocations.frames(&shading, &inputs, &case.target)?;
            for (observed, frame) in observed.iter_mut().zip(frames) {
                observed.stored = frame.map(|channel| f32::from(channel) / 255.0);
                observed
                    .values
                    .push(value((Quantity::Frame, observed.stored)));
            }
        }
        let slack = Slack::new(case, !self.float_filtering);
        for (invocation, observed) in case.invocations.iter().zip(&mut observed) {
            slack.fill(invocation, observed);
        }
        Ok(observed)
    }
}

fn value((quantity, numbers): (Quantity, [f32; 4])) -> Value {
    Value {
        quantity,
        numbers,
        slack: [0.0; 4],
    }
}

/// The shader of a kind.
fn shader(case: &Case, kind: ShaderKind) -> Option<&Shader> {
    match kind {
        ShaderKind::Vertex => case.vertex.as_ref(),
        ShaderKind::Pixel => case.pixel.as_ref(),
    }
}

impl Asked {
    fn of(case: &Case, kind: ShaderKind, wanted: &[Quantity]) -> Self {
        let mut quantities: Vec<(Quantity, Slot)> = Vec::new();
        let kernel = shader(case, kind).map(|shader| &shader.kernel);
        for quantity in wanted {
            let Quantity::Register(of, register) = quantity else {
                continue;
            };
            let known = quantities.iter().any(|(known, _)| known == quantity);
            let slot = kernel.filter(|_| *of == kind && !known);
            quantities
                .extend(slot.and_then(|kernel| Some((*quantity, slot_of(*register, kernel)?))));
        }
        Self { quantities }
    }

    fn slots(&self) -> Vec<Slot> {
        self.quantities.iter().map(|(_, slot)| *slot).collect()
    }

    /// The numbers that were seen, as they are compared.
    fn values<'a>(
        &'a self,
        case: &'a Case,
        seen: &'a [[f32; 4]],
    ) -> impl Iterator<Item = (Quantity, [f32; 4])> + 'a {
        self.quantities
            .iter()
            .zip(seen)
            .map(|((quantity, slot), seen)| {
                let unsized_point = (case.vertex.as_ref())
                    .is_some_and(|shader| unsized_point(&shader.kernel, *slot));
                let numbers = match unsized_point {
                    true => [case.state.point.size, 0.0, 0.0, 0.0],
                    false => quantity.as_compared(*seen),
                };
                (*quantity, numbers)
            })
    }
}

/// What goes into an invocation; the same as the CPU gets.
fn inputs(case: &Case, invocation: &Invocation) -> InvocationInputs {
    let lone = without_vertex_shader(invocation);
    let constants = |shader: &Option<Shader>, set: &[(u32, [f32; 4])]| {
        let bound = |shader: &Shader| bind_constants(&shader.kernel, set);
        shader.as_ref().map(bound).unwrap_or_default()
    };
    InvocationInputs {
        vertex: invocation.vertex_inputs,
        texcoords: lone.texcoords.map(|set| set.to_array()),
        colors: [lone.diffuse, lone.specular].map(|color| color.to_array()),
        fog: fog_unit(lone.fog),
        vertex_constants: constants(&case.vertex, &invocation.vertex_constants),
        pixel_constants: constants(&case.pixel, &invocation.pixel_constants),
    }
}

/// What is baked into the translation, without render states.
fn options(case: &Case, inputs: &[InvocationInputs], observed: Registers) -> Options {
    let overrides = |shader: &Option<Shader>, of: fn(&InvocationInputs) -> &[[f32; 4]]| {
        let differs = |kernel: &Kernel| {
            inputs
                .iter()
                .any(|one| overrides_definitions(kernel, of(one)))
        };
        shader
            .as_ref()
            .is_some_and(|shader| differs(&shader.kernel))
    };
    Options {
        stages: (case.stages.each_ref())
            .map(|stage| stage_options(stage.texture.as_ref(), &stage.sampler)),
        overridable_definitions: overrides(&case.vertex, |one| &one.vertex_constants)
            || overrides(&case.pixel, |one| &one.pixel_constants),
        half_pixel: false,
        mapped_depth: case.state.depth_mapping() != [1.0, 0.0],
        wild_inputs: is_wild(case, inputs),
        observed: Some(observed),
        ..Options::default()
    }
}

/// Whether something that goes in is infinite, NaN or beyond what translations take for granted.
fn is_wild(case: &Case, inputs: &[InvocationInputs]) -> bool {
    let wild = |number: f32| number.is_nan() || number.abs() > Options::TAME;
    let any = |registers: &[[f32; 4]]| registers.as_flattened().iter().any(|x| wild(*x));
    let inputs = inputs
        .iter()
        .any(|one| any(&one.vertex) || any(&one.texcoords) || any(&one.vertex_constants));
    let stages = case.stages.iter().any(|stage| {
        let bump = &stage.bump;
        let states = [bump.luminance_scale, bump.luminance_offset];
        let texels = || {
            let mut found = false;
            let texture = stage.texture.as_ref();
            if let Some(texture) = texture.filter(|texture| !texture.format().is_packed()) {
                each_texel(texture, |texel| found |= texel.into_iter().any(wild));
            }
            found
        };
        bump.matrix.into_iter().chain(states).any(wild) || texels()
    });
    inputs || stages
}

fn translation(case: &Case, options: &Options) -> Result<Translation, GpuError> {
    let of = |kind| {
        shader(case, kind).map(|shader| Stage {
            program: &shader.program,
            kernel: &shader.kernel,
            source: case.sources(),
        })
    };
    translate(of(ShaderKind::Vertex), of(ShaderKind::Pixel), options).map_err(|error| {
        GpuError::Translate {
            draw: case.name.clone(),
            error,
        }
    })
}

fn shading<'a>(case: &'a Case, translation: &'a Translation) -> Shading<'a> {
    Shading {
        translation,
        stages: case.stages.each_ref().map(|stage| exec::Stage {
            texture: stage.texture.as_ref(),
            sampler: stage.sampler,
            bump: stage.bump,
        }),
        state: &case.state,
    }
}

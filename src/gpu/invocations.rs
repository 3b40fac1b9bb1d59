//! Shaders run for inputs that are given, one invocation a pixel, and what they leave behind.

use super::buffers::{UniformArena, filled};
use super::harness::{Look, Rows, locations, with_entries};
use super::picture::{COLOR_FORMAT, Depth, Picture, depth_format, floats, number};
use super::pipeline::{Pipeline, Pipelines};
use super::state::fixed_state;
use super::texture::{GpuTexture, Samplers};
use super::{Device, GpuError, StageUniforms, Uniforms, VertexLayout};
use crate::exec::{STAGES, Stage};
use crate::isa::ShaderKind;
use crate::raster::{Compare, CullMode, FillMode, RenderState, Surface, Topology};
use crate::wgsl::{Resource, Translation};

/// What is run: the same for all invocations.
#[derive(Clone, Debug)]
pub struct Shading<'a> {
    /// The shaders: a vertex shader, a pixel shader, or both linked, translated with
    /// [`Options::observed`](crate::wgsl::Options::observed).
    pub translation: &'a Translation,
    /// What the texture stages hold; the translation must have been made for them.
    pub stages: [Stage<'a>; STAGES],
    /// The render states.
    pub state: &'a RenderState,
}

/// What goes into one invocation.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct InvocationInputs {
    /// `v0` to `v15` of a vertex shader.
    pub vertex: [[f32; 4]; 16],
    /// `t0` to `t7` where there is no vertex shader.
    pub texcoords: [[f32; 4]; 8],
    /// `v0` and `v1` where there is no vertex shader. The shader takes them into 0 to 1.
    pub colors: [[f32; 4]; 2],
    /// The fog factor where there is no vertex shader, 0 to 1.
    pub fog: f32,
    /// The constants of the vertex shader, as [`crate::exec::bind_constants`] gives them.
    pub vertex_constants: Vec<[f32; 4]>,
    /// Those of the pixel shader.
    pub pixel_constants: Vec<[f32; 4]>,
}

/// What one invocation left behind.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Seen {
    /// What the pixel shader returns, not clamped, also for a pixel that is discarded.
    pub color: [f32; 4],
    /// Whether the pixel was discarded.
    pub killed: bool,
    /// The depth that the depth buffer, of 32-bit floats from 0 to 1, gets, or would get of a pixel that is discarded.
    /// 0 without a pixel shader.
    pub depth: f32,
    /// The registers of the vertex shader that were asked for.
    pub vertex: Vec<[f32; 4]>,
    /// Those of the pixel shader.
    pub pixel: Vec<[f32; 4]>,
}

/// The width of the picture that results are drawn into.
const WIDTH: u32 = 256;
/// The most pixels of one picture.
const MOST: usize = 1 << 20;

/// Runs shaders for single invocations. Samplers are kept from one call to the next.
///
/// Every invocation is a point by itself, with w = 1: nothing is clipped and nothing interpolated, derivatives are 0, so
/// that textures are magnified.
#[derive(Debug)]
pub struct Invocations<'d> {
    device: &'d Device,
    samplers: Samplers,
}

impl<'d> Invocations<'d> {
    /// Invocations on a device.
    pub fn new(device: &'d Device) -> Self {
        Self {
            device,
            samplers: Samplers::default(),
        }
    }

    /// Runs the shaders and looks at registers, as 32-bit floats. Render states have no effect, except for what is
    /// baked into the translation.
    ///
    /// # Errors
    /// [`GpuError::Limit`] on a device that cannot draw into 32-bit floats; [`GpuError::Unsupported`] for a translation
    /// that was not made to be looked at; and what the device reports.
    pub fn registers(
        &mut self,
        shading: &Shading<'_>,
        inputs: &[InvocationInputs],
    ) -> Result<Vec<Seen>, GpuError> {
        if !self.device.adapter().float_targets {
            return Err(GpuError::Limit {
                what: "registers as 32-bit floats".into(),
                limit: "it cannot draw into such a target".into(),
            });
        }
        let rows = Rows::of(shading.translation, Look::Registers);
        let mut seen = Vec::with_capacity(inputs.len());
        for some in inputs.chunks((MOST / rows.count).max(1)) {
            let surface = Surface::default();
            let (colors, depths) = self.draw(shading, some, Look::Registers, &surface)?;
            let texels = floats(&colors);
            let depths: Vec<f32> = depths.chunks_exact(4).map(number).collect();
            let invocations = texels
                .chunks_exact(rows.count)
                .zip(depths.chunks_exact(rows.count));
            seen.extend(invocations.take(some.len()).map(|(texels, depths)| {
                let of =
                    |range: std::ops::Range<usize>| texels.get(range).unwrap_or_default().to_vec();
                Seen {
                    color: texels.get(1).copied().unwrap_or_default(),
                    killed: rows.has_pixel() && texels[0] == [0.0; 4],
                    // The second pixel is that of the first one, not discarded.
                    depth: match rows.has_pixel() {
                        true => depths.get(1).copied().unwrap_or_default(),
                        false => 0.0,
                    },
                    vertex: of(rows.vertex..rows.pixel),
                    pixel: of(rows.pixel..rows.count),
                }
            }));
        }
        Ok(seen)
    }

    /// Runs the shaders and gives what then stands in a target of 8 bits a channel that held this.
    ///
    /// # Errors
    /// As [`Self::registers`], but any device has such targets.
    pub fn frames(
        &mut self,
        shading: &Shading<'_>,
        inputs: &[InvocationInputs],
        surface: &Surface,
    ) -> Result<Vec<[u8; 4]>, GpuError> {
        let mut frames = Vec::with_capacity(inputs.len());
        for some in inputs.chunks(MOST) {
            let (colors, _) = self.draw(shading, some, Look::Color, surface)?;
            let texels = colors.chunks_exact(4).take(some.len());
            frames.extend(texels.map(|texel| [texel[0], texel[1], texel[2], texel[3]]));
        }
        Ok(frames)
    }

    /// Colours and depths of the pixels of all invocations.
    fn draw(
        &mut self,
        shading: &Shading<'_>,
        inputs: &[InvocationInputs],
        look: Look,
        surface: &Surface,
    ) -> Result<(Vec<u8>, Vec<u8>), GpuError> {
        let translation = shading.translation;
        let unsupported = |state: String| GpuError::Unsupported {
            draw: "invocations".into(),
            state,
        };
        if translation.reflection.baked.observed.is_none() {
            return Err(unsupported(
                "a translation with entry points of its own".into(),
            ));
        }
        if inputs.is_empty() {
            return Ok((Vec::new(), Vec::new()));
        }
        let device = self.device;
        let rows = Rows::of(translation, look).count as u32;
        let size = [WIDTH, (inputs.len() as u32 * rows).div_ceil(WIDTH)];
        device.check_size("a picture", size)?;
        let complete = with_entries(translation, look, size);
        let mut state = state(shading.state, look);
        state.color_mask = surface.format.written(state.color_mask);
        let holds = surface.stored();
        // As eight bits hold it, so that rounding is not left to the device.
        let clear = holds.color.map(|byte| f64::from(byte) / 255.0);
        let depth = depth_format(device, state.stencil.enable);
        let fixed =
            fixed_state(&state, Topology::TriangleList, depth, false).map_err(unsupported)?;
        let format = match look {
            Look::Color => COLOR_FORMAT,
            Look::Registers => wgpu::TextureFormat::Rgba32Float,
        };
        let locations = locations(&translation.reflection);
        let mut pipelines = Pipelines::default();
        let layout = VertexLayout::instances(&locations);
        let pipeline = pipelines.get(device, &complete, layout, fixed, format)?;
        let textures = self.textures(shading, pipeline)?;
        let draws = uniforms(device, shading, pipeline, inputs);
        let vertices = filled(
            device,
            &attributes(translation, &locations, inputs),
            wgpu::BufferUsages::VERTEX,
        );
        let after = match look {
            Look::Color => Depth::Dropped,
            Look::Registers => Depth::Read,
        };
        let picture = Picture::new(device, size, format, depth, after)
            .clearing_to(holds.depth, holds.stencil);
        let mut encoder = device.device.create_command_encoder(&Default::default());
        let mut commands = picture.begin(&mut encoder, Some(clear));
        commands.set_pipeline(&pipeline.pipeline);
        commands.set_bind_group(1, &textures, &[]);
        if !locations.is_empty() {
            commands.set_vertex_buffer(0, vertices.slice(..));
        }
        commands.set_stencil_reference(state.stencil.reference.into());
        for (group, instances) in draws {
            commands.set_bind_group(0, &group, &[]);
            commands.draw(0..3 * rows, instances);
        }
        drop(commands);
        picture.read(device, encoder)
    }

    /// The textures and samplers.
    fn textures(
        &mut self,
        shading: &Shading<'_>,
        pipeline: &Pipeline,
    ) -> Result<wgpu::BindGroup, GpuError> {
        let mut uploaded: [Option<GpuTexture>; STAGES] = [const { None }; STAGES];
        let mut bound = Vec::new();
        for binding in &shading.translation.reflection.bindings {
            let number = match &binding.resource {
                Resource::Uniform { .. } => continue,
                Resource::Texture { stage, .. } | Resource::Sampler { stage, .. } => {
                    usize::from(*stage) % STAGES
                }
            };
            let stage = &shading.stages[number];
            let Some(texture) = stage.texture else {
                continue;
            };
            let texture = match &mut uploaded[number] {
                Some(known) => known,
                place => place.insert(GpuTexture::upload(self.device, texture)?),
            };
            let resource =
                (self.samplers).bound(self.device, &binding.resource, texture, &stage.sampler);
            bound.extend(resource.map(|resource| (binding.binding, resource)));
        }
        let entries: Vec<_> = bound
            .iter()
            .map(|(binding, bound)| bound.entry(*binding))
            .collect();
        Ok(group(self.device, &pipeline.groups[1], &entries))
    }
}

fn group(
    device: &Device,
    layout: &wgpu::BindGroupLayout,
    entries: &[wgpu::BindGroupEntry<'_>],
) -> wgpu::BindGroup {
    device.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout,
        entries,
    })
}

/// The render states of a point by itself, which has no sides; of registers only the depth is written beside them.
fn state(state: &RenderState, look: Look) -> RenderState {
    let mut lone = match look {
        Look::Color => state.clone(),
        Look::Registers => RenderState::default(),
    };
    if look == Look::Registers {
        lone.depth.func = Compare::Always;
    }
    lone.cull = CullMode::None;
    lone.fill = FillMode::Solid;
    lone
}

/// The bind groups of the uniform blocks, each with the instances that it is for: neighbours with the same constants
/// share one.
fn uniforms(
    device: &Device,
    shading: &Shading<'_>,
    pipeline: &Pipeline,
    inputs: &[InvocationInputs],
) -> Vec<(wgpu::BindGroup, std::ops::Range<u32>)> {
    let same = |a: &InvocationInputs, b: &InvocationInputs| {
        // By bits, so that NaN is the same as itself.
        let bits = |constants: &[[f32; 4]]| {
            constants
                .as_flattened()
                .iter()
                .map(|c| c.to_bits())
                .collect::<Vec<_>>()
        };
        bits(&a.vertex_constants) == bits(&b.vertex_constants)
            && bits(&a.pixel_constants) == bits(&b.pixel_constants)
    };
    let stages = (shading.stages.each_ref())
        .map(|stage| StageUniforms::new(stage.texture, &stage.sampler, stage.bump));
    let mut arena = UniformArena::new(device);
    let mut draws = Vec::new();
    let mut first = 0;
    for some in inputs.chunk_by(same) {
        let mut places = Vec::new();
        for binding in &shading.translation.reflection.bindings {
            let Resource::Uniform { stage, .. } = &binding.resource else {
                continue;
            };
            let constants = some.first().map(|inputs| match stage {
                ShaderKind::Vertex => inputs.vertex_constants.as_slice(),
                ShaderKind::Pixel => inputs.pixel_constants.as_slice(),
            });
            let uniforms = Uniforms {
                constants: constants.unwrap_or_default(),
                state: shading.state,
                viewport: [1.0; 2],
                stages,
            };
            places.push((
                binding.binding,
                arena.push(&uniforms.block(&binding.resource)),
            ));
        }
        let end = first + some.len() as u32;
        draws.push((places, first..end));
        first = end;
    }
    let buffer = arena.upload(device);
    let grouped = draws.into_iter().map(|(places, instances)| {
        let entries: Vec<_> = (places.iter())
            .map(|(binding, place)| UniformArena::entry(&buffer, *binding, place))
            .collect();
        (group(device, &pipeline.groups[0], &entries), instances)
    });
    grouped.collect()
}

/// The content of the vertex buffer.
fn attributes(
    translation: &Translation,
    locations: &[u32],
    inputs: &[InvocationInputs],
) -> Vec<u8> {
    let has_vertex = translation.reflection.vertex.is_some();
    let value = |input: &InvocationInputs, location: usize| -> [f32; 4] {
        if has_vertex {
            return input.vertex.get(location).copied().unwrap_or_default();
        }
        let colors = location.checked_sub(8).and_then(|i| input.colors.get(i));
        let passed = input.texcoords.get(location).or(colors);
        passed.copied().unwrap_or([input.fog; 4])
    };
    inputs
        .iter()
        .flat_map(|input| {
            locations
                .iter()
                .map(move |location| value(input, *location as usize))
        })
        .flatten()
        .flat_map(f32::to_le_bytes)
        .collect()
}

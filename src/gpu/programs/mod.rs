//! Many shaders in one pipeline, each with inputs of its own, and what they leave behind as 32-bit floats.
//!
//! Making a pipeline costs a device far more than a few invocations of one. So the translations of many shaders become
//! functions of one fragment shader. Every pixel of a picture is a primitive of its own and shows one result of one
//! invocation of one shader; inputs are flat, so that they reach the shader as they are. Vertex shaders run there, too: as
//! functions of numbers they are the same. The text of the functions is that of the translations; `text` says what is
//! changed in it.

mod module;
mod text;

use super::buffers::filled;
use super::picture::{Depth, Picture, depth_format, floats};
use super::texture::{GpuTexture, view_dimension};
use super::{Device, GpuError, Uniforms};
use crate::kernel::Slot;
use crate::texture::{Sampler, Texture};
use crate::wgsl::Translation;
use module::{BLOCKS, FIRST_INPUT, FRAGMENT_ENTRY, Kept, Module, VERTEX_ENTRY, VIEWS};

/// One shader of a batch, with what it is run with.
#[derive(Clone, Debug)]
pub struct Program<'a> {
    /// The shader, translated alone. If it samples, with [`level_zero`](crate::wgsl::Options::level_zero); vertex shaders
    /// without [`half_pixel`](crate::wgsl::Options::half_pixel) leave `oPos` as it is.
    pub translation: &'a Translation,
    /// The content of its uniform block.
    pub uniforms: Uniforms<'a>,
    /// What each texture stage holds.
    pub textures: [Option<(&'a Texture, Sampler)>; 8],
    /// The registers that it reads, one value an invocation; 0 where there is none.
    pub inputs: Vec<(Slot, &'a [[f32; 4]])>,
    /// Whether `oPts` is wanted. The shader must write it.
    pub point_size: bool,
}

/// What a shader left behind.
#[derive(Clone, Debug, PartialEq)]
pub struct Results {
    /// `r0` and the depth, or the outputs that are passed on, one value an invocation. Scalars fill all four components.
    pub outputs: Vec<(Slot, Vec<[f32; 4]>)>,
    /// The invocations that were discarded.
    pub killed: Vec<bool>,
}

/// The module of a batch as WGSL, with everything that is bound to it.
pub struct Batch<'a> {
    module: Module<'a>,
    invocations: usize,
}

/// The width of the picture that the results are drawn into.
const WIDTH: u32 = 256;
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;

impl<'a> Batch<'a> {
    /// Puts shaders together, to be run `invocations` times each.
    pub fn new(programs: &[Program<'a>], invocations: usize) -> Self {
        Self {
            module: module::module(programs, invocations, WIDTH),
            invocations,
        }
    }

    /// The WGSL of the module.
    pub fn source(&self) -> &str {
        &self.module.source
    }

    /// The names of its entry points, vertex and fragment.
    pub fn entries(&self) -> [&'static str; 2] {
        [VERTEX_ENTRY, FRAGMENT_ENTRY]
    }

    /// Runs all shaders on all invocations.
    ///
    /// # Errors
    /// [`GpuError::Limit`] for more than the device can bind or draw into; and what the device reports.
    pub fn run(&self, device: &Device) -> Result<Vec<Results>, GpuError> {
        let module = (device.device).create_shader_module(wgpu::ShaderModuleDescriptor {
            label: None,
            source: wgpu::ShaderSource::Wgsl(self.source().into()),
        });
        self.run_module(device, &module)
    }

    /// Runs all shaders with a module that was made of [`Batch::source`] in another way.
    ///
    /// # Errors
    /// As [`Batch::run`].
    pub fn run_module(
        &self,
        device: &Device,
        module: &wgpu::ShaderModule,
    ) -> Result<Vec<Results>, GpuError> {
        self.check(device)?;
        let count = self.module.pixel_count();
        if count == 0 {
            return Ok(Vec::new());
        }
        let depth = depth_format(device, false);
        let layout = self.layout(device);
        let pipeline = self.pipeline(device, module, &layout, depth);
        device.check()?;
        let group = self.group(device, &layout)?;
        let pixels = filled(device, &self.module.pixels, wgpu::BufferUsages::VERTEX);
        let size = [WIDTH, self.module.height(WIDTH)];
        let picture = Picture::new(device, size, FORMAT, depth, Depth::Dropped);
        let mut encoder = device.device.create_command_encoder(&Default::default());
        let mut commands = picture.begin(&mut encoder, Some([0.0; 4]));
        commands.set_pipeline(&pipeline);
        commands.set_bind_group(0, &group, &[]);
        commands.set_vertex_buffer(0, pixels.slice(..));
        commands.draw(0..4, 0..count);
        drop(commands);
        let (bytes, _) = picture.read(device, encoder)?;
        Ok(self.results(floats(&bytes)))
    }

    fn pipeline(
        &self,
        device: &Device,
        module: &wgpu::ShaderModule,
        layout: &wgpu::BindGroupLayout,
        depth: wgpu::TextureFormat,
    ) -> wgpu::RenderPipeline {
        let layout = (device.device).create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &[Some(layout)],
            immediate_size: 0,
        });
        let number = |location: u32| wgpu::VertexAttribute {
            format: wgpu::VertexFormat::Uint32,
            offset: 4 * u64::from(location),
            shader_location: location,
        };
        let register = |i: usize| wgpu::VertexAttribute {
            format: wgpu::VertexFormat::Float32x4,
            offset: 8 + 16 * i as u64,
            shader_location: FIRST_INPUT + i as u32,
        };
        let attributes: Vec<_> = (0..FIRST_INPUT)
            .map(number)
            .chain((0..self.module.inputs).map(register))
            .collect();
        let buffer = wgpu::VertexBufferLayout {
            array_stride: self.module.stride() as u64,
            step_mode: wgpu::VertexStepMode::Instance,
            attributes: &attributes,
        };
        (device.device).create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: None,
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module,
                entry_point: Some(VERTEX_ENTRY),
                compilation_options: Default::default(),
                buffers: &[Some(buffer)],
            },
            primitive: wgpu::PrimitiveState {
                topology: wgpu::PrimitiveTopology::TriangleStrip,
                ..Default::default()
            },
            depth_stencil: Some(wgpu::DepthStencilState {
                format: depth,
                depth_write_enabled: Some(false),
                // Every pixel passes: depth 0 over 1. With a test there is one way for a pixel to be drawn; without any, Mesa's
                // software adapter compiles the shader a second time, for tiles that a primitive fills.
                depth_compare: Some(wgpu::CompareFunction::Less),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: Default::default(),
            fragment: Some(wgpu::FragmentState {
                module,
                entry_point: Some(FRAGMENT_ENTRY),
                compilation_options: Default::default(),
                targets: &[Some(FORMAT.into())],
            }),
            multiview_mask: None,
            cache: None,
        })
    }

    /// Refuses what the device cannot bind or draw into.
    fn check(&self, device: &Device) -> Result<(), GpuError> {
        let limits = device.device.limits();
        let most_views = (limits.max_sampled_textures_per_shader_stage)
            .min(limits.max_samplers_per_shader_stage);
        let registers = FIRST_INPUT as usize + self.module.inputs;
        let most_registers =
            (limits.max_vertex_attributes).min(limits.max_inter_stage_shader_variables);
        let needs = [
            (
                self.module.blocks.len() as u64,
                limits.max_uniform_buffer_binding_size,
                "bytes of constants",
            ),
            (
                self.module.views.len() as u64,
                most_views.into(),
                "textures",
            ),
            (registers as u64, most_registers.into(), "input registers"),
            (
                self.module.height(WIDTH).into(),
                limits.max_texture_dimension_2d.into(),
                "rows of results",
            ),
        ];
        if !device.adapter().float_targets {
            return Err(GpuError::Limit {
                what: "a batch of shaders with results as 32-bit floats".into(),
                limit: "it cannot draw into 32-bit floats".into(),
            });
        }
        match needs.into_iter().find(|(need, most, _)| need > most) {
            None => Ok(()),
            Some((need, most, of)) => Err(GpuError::Limit {
                what: format!("a batch of shaders with {need} {of}"),
                limit: format!("at most {most}"),
            }),
        }
    }

    fn layout(&self, device: &Device) -> wgpu::BindGroupLayout {
        let entry = |binding: u32, ty: wgpu::BindingType| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::FRAGMENT,
            ty,
            count: None,
        };
        let mut entries = Vec::new();
        if !self.module.blocks.is_empty() {
            let uniform = wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Uniform,
                has_dynamic_offset: false,
                min_binding_size: None,
            };
            entries.push(entry(BLOCKS, uniform));
        }
        for (binding, view) in (VIEWS..).step_by(2).zip(&self.module.views) {
            let texture = wgpu::BindingType::Texture {
                sample_type: wgpu::TextureSampleType::Float { filterable: true },
                view_dimension: view_dimension(view.dimension),
                multisampled: false,
            };
            let sampler = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering);
            entries.extend([entry(binding, texture), entry(binding + 1, sampler)]);
        }
        let label = None;
        let entries = &entries;
        (device.device)
            .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label, entries })
    }

    fn group(
        &self,
        device: &Device,
        layout: &wgpu::BindGroupLayout,
    ) -> Result<wgpu::BindGroup, GpuError> {
        let blocks = filled(device, &self.module.blocks, wgpu::BufferUsages::UNIFORM);
        let mut bound = Vec::with_capacity(self.module.views.len());
        for view in &self.module.views {
            let texture = GpuTexture::upload(device, view.texture)?;
            let sampler = texture.sampler_state(&view.sampler, view.clamps);
            let seen = texture.view(view.dimension, &view.sampler);
            bound.push((seen, sampler.create(device)));
        }
        let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
        let mut entries = Vec::new();
        if !self.module.blocks.is_empty() {
            entries.push(entry(BLOCKS, blocks.as_entire_binding()));
        }
        for (binding, (view, sampler)) in (VIEWS..).step_by(2).zip(&bound) {
            entries.extend([
                entry(binding, wgpu::BindingResource::TextureView(view)),
                entry(binding + 1, wgpu::BindingResource::Sampler(sampler)),
            ]);
        }
        Ok(
            (device.device).create_bind_group(&wgpu::BindGroupDescriptor {
                label: None,
                layout,
                entries: &entries,
            }),
        )
    }

    /// The results out of the picture.
    fn results(&self, texels: Vec<[f32; 4]>) -> Vec<Results> {
        let mut texels = texels.into_iter();
        let of = |kept: &Vec<Kept>| {
            let mut results = Results {
                outputs: Vec::new(),
                killed: vec![false; self.invocations],
            };
            for kept in kept {
                let values: Vec<[f32; 4]> = texels.by_ref().take(self.invocations).collect();
                match kept {
                    Kept::Register(slot) => results.outputs.push((*slot, values)),
                    Kept::Alive => {
                        results.killed = values.iter().map(|value| value[0] == 0.0).collect();
                    }
                }
            }
            results
        };
        self.module.results.iter().map(of).collect()
    }
}

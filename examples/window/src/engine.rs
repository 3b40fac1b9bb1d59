//! A small renderer of one's own that draws with old shader pairs.
//!
//! texcrd gives it, for each draw: the WGSL ([`translate`]), the bind group layouts ([`bind_group_layouts`]), the layout of
//! the vertex buffers ([`VertexLayout`]), what Direct3D's render states are in a pipeline ([`fixed_state`]), and frame by
//! frame the bytes of the uniform blocks ([`Uniforms`]). Window, device, textures and buffers are the engine's own.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use texcrd::exec::STAGES;
use texcrd::gpu::{
    StageUniforms, Uniforms, VertexLayout, bind_group_layouts, fixed_state, stage_options, wgpu,
};
use texcrd::isa::ShaderKind;
use texcrd::scene::{PreparedDraw, PreparedStage};
use texcrd::texture::{AddressMode, Filter, MipFilter, Sampler, Texture};
use texcrd::wgsl::{Dimension, Options, Resource, Stage, translate};
use wgpu::util::DeviceExt;
use wgpu::{CurrentSurfaceTexture, TextureUsages};
use winit::window::Window;

use crate::Failure;
use crate::glass::Glass;

const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

pub(crate) struct Engine {
    window: Arc<Window>,
    instance: wgpu::Instance,
    adapter: String,
    device: wgpu::Device,
    queue: wgpu::Queue,
    surface: wgpu::Surface<'static>,
    config: wgpu::SurfaceConfiguration,
    depth: wgpu::TextureView,
    /// One for each draw of the picture, in order.
    items: Vec<Item>,
    /// The first thing that the device complained about.
    complaint: Arc<Mutex<Option<String>>>,
}

/// What a draw needs on the device.
struct Item {
    pipeline: wgpu::RenderPipeline,
    groups: [wgpu::BindGroup; 2],
    /// The uniform blocks, to be written each frame.
    blocks: Vec<(Resource, wgpu::Buffer)>,
    /// What of the texture stages stands in them.
    stages: [StageUniforms; STAGES],
    vertices: Vec<wgpu::Buffer>,
    indices: wgpu::Buffer,
    index_count: u32,
}

impl Engine {
    pub(crate) fn new(window: Arc<Window>, glass: &Glass) -> Result<Self, Failure> {
        let display = Box::new(Arc::clone(&window));
        let mut description = wgpu::InstanceDescriptor::new_with_display_handle(display);
        description.flags = wgpu::InstanceFlags::empty();
        let instance = wgpu::Instance::new(description);
        let surface = instance.create_surface(Arc::clone(&window))?;
        let request = wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            compatible_surface: Some(&surface),
            ..Default::default()
        };
        let adapter = pollster::block_on(instance.request_adapter(&request)).map_err(|error| {
            format!(
                "no GPU adapter can draw into this window ({error}); a software one for Vulkan comes with the packages \
                 mesa-vulkan-drivers and libvulkan1 (Debian, Ubuntu)"
            )
        })?;
        let request = wgpu::DeviceDescriptor {
            required_limits: adapter.limits(),
            ..Default::default()
        };
        let (device, queue) = pollster::block_on(adapter.request_device(&request))?;
        let complaint = Arc::new(Mutex::new(None));
        let note = |complaint: &Mutex<Option<String>>, text: String| {
            let mut complaint = complaint.lock().unwrap_or_else(PoisonError::into_inner);
            complaint.get_or_insert(text);
        };
        let errors = Arc::clone(&complaint);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            note(&errors, error.to_string());
        }));
        let losses = Arc::clone(&complaint);
        device.set_device_lost_callback(move |_, reason| {
            note(&losses, format!("the device was lost: {reason}"));
        });

        let size = window.inner_size();
        let (width, height) = (size.width.max(1), size.height.max(1));
        let mut config = surface
            .get_default_config(&adapter, width, height)
            .ok_or("the adapter cannot draw into this window")?;
        // Shaders of the time computed with the numbers that the screen shows: nothing is to be converted.
        let formats = surface.get_capabilities(&adapter).formats;
        let plain = formats.iter().find(|format| !format.is_srgb());
        config.format = plain.copied().unwrap_or(config.format);
        config.present_mode = wgpu::PresentMode::AutoVsync;
        surface.configure(&device, &config);

        let mut engine = Self {
            window,
            instance,
            adapter: adapter.get_info().name,
            depth: depth(&device, &config),
            device,
            queue,
            surface,
            config,
            items: Vec::new(),
            complaint,
        };
        let picture = glass.picture([width, height], 0.0);
        for draw in picture.iter().flat_map(|picture| &picture.draws) {
            engine.items.push(engine.item(draw, glass)?);
        }
        engine.check()?;
        Ok(engine)
    }

    pub(crate) fn window(&self) -> &Window {
        &self.window
    }

    /// The name of the adapter.
    pub(crate) fn adapter(&self) -> &str {
        &self.adapter
    }

    /// Everything that a draw needs: shaders, layouts, pipeline, buffers, textures.
    fn item(&self, draw: &PreparedDraw<'_>, glass: &Glass) -> Result<Item, Failure> {
        let texture = |stage: &PreparedStage| glass.textures.get(stage.texture?)?.as_ref();
        let options = Options {
            stages: (draw.stages.each_ref())
                .map(|stage| stage_options(texture(stage), &stage.sampler)),
            ..Options::default()
        };
        let (vertex, pixel) = (stage_of(draw.vertex, glass), stage_of(draw.pixel, glass));
        let translation = translate(Some(vertex), Some(pixel), &options)?;
        let reflection = &translation.reflection;
        let layouts = bind_group_layouts(&self.device, reflection);
        let vertex_layout = VertexLayout::new(draw.declaration, &reflection.inputs, false);
        let fixed = fixed_state(&draw.state, draw.topology, DEPTH, false)?;
        let device = &self.device;
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(draw.name),
            source: wgpu::ShaderSource::Wgsl(translation.source.as_str().into()),
        });
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &[Some(&layouts[0]), Some(&layouts[1])],
            immediate_size: 0,
        });
        let buffers: Vec<_> = vertex_layout.buffers().into_iter().map(Some).collect();
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(draw.name),
            layout: Some(&pipeline_layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some(&options.vertex_entry),
                compilation_options: Default::default(),
                buffers: &buffers,
            },
            primitive: fixed.primitive,
            depth_stencil: Some(fixed.depth_stencil),
            multisample: Default::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some(&options.pixel_entry),
                compilation_options: Default::default(),
                targets: &[Some(wgpu::ColorTargetState {
                    format: self.config.format,
                    blend: fixed.blend,
                    write_mask: fixed.write_mask,
                })],
            }),
            multiview_mask: None,
            cache: None,
        });

        let buffer = |contents: &[u8], usage| {
            device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: None,
                contents,
                usage,
            })
        };
        let mut blocks = Vec::new();
        let mut bound: [Vec<(u32, Bound)>; 2] = Default::default();
        for binding in &reflection.bindings {
            let of_stage = |stage: u8| {
                let stage = &draw.stages[usize::from(stage)];
                texture(stage).map(|texture| (texture, &stage.sampler))
            };
            match &binding.resource {
                resource @ Resource::Uniform { size, .. } => {
                    let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
                    let block = buffer(&vec![0; *size as usize], usage);
                    bound[0].push((binding.binding, Bound::Block(block.clone())));
                    blocks.push((resource.clone(), block));
                }
                Resource::Texture { stage, dimension } => {
                    if let Some((texture, sampler)) = of_stage(*stage) {
                        let view = self.view(texture, *dimension, sampler)?;
                        bound[1].push((binding.binding, Bound::View(view)));
                    }
                }
                Resource::Sampler { stage, clamps } => {
                    if let Some((_, sampler)) = of_stage(*stage) {
                        let sampler = self.sampler(sampler, *clamps);
                        bound[1].push((binding.binding, Bound::Sampler(sampler)));
                    }
                }
            }
        }
        let group = |number: usize| {
            let entries: Vec<_> = (bound[number].iter())
                .map(|(binding, bound)| wgpu::BindGroupEntry {
                    binding: *binding,
                    resource: bound.resource(),
                })
                .collect();
            device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: None,
                layout: &layouts[number],
                entries: &entries,
            })
        };
        let indices = draw.mesh.indices();
        let index_bytes: Vec<u8> = indices.iter().flat_map(|i| i.to_le_bytes()).collect();
        Ok(Item {
            pipeline,
            groups: [group(0), group(1)],
            blocks,
            stages: (draw.stages.each_ref())
                .map(|stage| StageUniforms::new(texture(stage), &stage.sampler, stage.bump)),
            vertices: (vertex_layout.streams())
                .map(|stream| buffer(&stream.bytes(draw.mesh), wgpu::BufferUsages::VERTEX))
                .collect(),
            indices: buffer(&index_bytes, wgpu::BufferUsages::INDEX),
            index_count: indices.len() as u32,
        })
    }

    /// Uploads a texture and gives the view that a shader wants.
    fn view(
        &self,
        texture: &Texture,
        dimension: Dimension,
        sampler: &Sampler,
    ) -> Result<wgpu::TextureView, Failure> {
        if !texture.format().is_packed() {
            return Err("this engine has no textures of floats".into());
        }
        let [width, height, depth] = texture.size();
        let volume = dimension == Dimension::D3;
        let uploaded = self.device.create_texture_with_data(
            &self.queue,
            &wgpu::TextureDescriptor {
                label: None,
                size: wgpu::Extent3d {
                    width,
                    height,
                    depth_or_array_layers: depth * texture.face_count() as u32,
                },
                mip_level_count: texture.level_count(),
                sample_count: 1,
                dimension: if volume {
                    wgpu::TextureDimension::D3
                } else {
                    wgpu::TextureDimension::D2
                },
                format: wgpu::TextureFormat::Rgba8Unorm,
                usage: TextureUsages::TEXTURE_BINDING,
                view_formats: &[],
            },
            wgpu::util::TextureDataOrder::MipMajor,
            &(0..texture.level_count())
                .flat_map(|level| texture.level_bytes(level).unwrap_or_default())
                .collect::<Vec<u8>>(),
        );
        Ok(uploaded.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(match dimension {
                Dimension::D2 => wgpu::TextureViewDimension::D2,
                Dimension::D2Array => wgpu::TextureViewDimension::D2Array,
                Dimension::Cube => wgpu::TextureViewDimension::Cube,
                Dimension::D3 => wgpu::TextureViewDimension::D3,
            }),
            mip_level_count: (sampler.mip == MipFilter::None).then_some(1),
            ..Default::default()
        }))
    }

    /// A sampler that clamps where the shader counts on it.
    fn sampler(&self, sampler: &Sampler, clamps: [bool; 3]) -> wgpu::Sampler {
        let filter = |filter| match filter {
            Filter::Point => wgpu::FilterMode::Nearest,
            _ => wgpu::FilterMode::Linear,
        };
        let [u, v, w] = [0, 1, 2].map(|axis| match sampler.address[axis] {
            AddressMode::Wrap if !clamps[axis] => wgpu::AddressMode::Repeat,
            AddressMode::Mirror if !clamps[axis] => wgpu::AddressMode::MirrorRepeat,
            _ => wgpu::AddressMode::ClampToEdge,
        });
        self.device.create_sampler(&wgpu::SamplerDescriptor {
            address_mode_u: u,
            address_mode_v: v,
            address_mode_w: w,
            mag_filter: filter(sampler.mag),
            min_filter: filter(sampler.min),
            mipmap_filter: match sampler.mip {
                MipFilter::Linear => wgpu::MipmapFilterMode::Linear,
                _ => wgpu::MipmapFilterMode::Nearest,
            },
            ..Default::default()
        })
    }

    /// The window has another size now.
    pub(crate) fn resize(&mut self, [width, height]: [u32; 2]) {
        // A window that is put away has none.
        if width > 0 && height > 0 {
            let most = self.device.limits().max_texture_dimension_2d;
            (self.config.width, self.config.height) = (width.min(most), height.min(most));
            self.configure();
        }
    }

    fn configure(&mut self) {
        self.surface.configure(&self.device, &self.config);
        self.depth = depth(&self.device, &self.config);
    }

    /// Draws a frame and shows it. False if the window could not take one now.
    pub(crate) fn draw(&mut self, glass: &Glass, seconds: f32) -> Result<bool, Failure> {
        self.check()?;
        let (frame, stale) = match self.surface.get_current_texture() {
            CurrentSurfaceTexture::Success(frame) => (frame, false),
            CurrentSurfaceTexture::Suboptimal(frame) => (frame, true),
            CurrentSurfaceTexture::Outdated => {
                self.configure();
                return Ok(false);
            }
            CurrentSurfaceTexture::Lost => {
                self.surface = self.instance.create_surface(Arc::clone(&self.window))?;
                self.configure();
                return Ok(false);
            }
            CurrentSurfaceTexture::Timeout | CurrentSurfaceTexture::Occluded => {
                std::thread::sleep(Duration::from_millis(10));
                return Ok(false);
            }
            CurrentSurfaceTexture::Validation => {
                self.check()?;
                return Err("the window takes no frames".into());
            }
        };
        let size = [self.config.width, self.config.height];
        let Some(picture) = glass.picture(size, seconds) else {
            return Ok(false);
        };
        for (draw, item) in picture.draws.iter().zip(&self.items) {
            self.write_constants(draw, item);
        }
        let mut encoder = self.device.create_command_encoder(&Default::default());
        let [r, g, b, a] = picture.clear.map(f64::from);
        let view = frame.texture.create_view(&Default::default());
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color { r, g, b, a }),
                    store: wgpu::StoreOp::Store,
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.depth,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Discard,
                }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        for item in &self.items {
            pass.set_pipeline(&item.pipeline);
            for (number, group) in (0..).zip(&item.groups) {
                pass.set_bind_group(number, group, &[]);
            }
            for (slot, buffer) in (0..).zip(&item.vertices) {
                pass.set_vertex_buffer(slot, buffer.slice(..));
            }
            pass.set_index_buffer(item.indices.slice(..), wgpu::IndexFormat::Uint32);
            pass.draw_indexed(0..item.index_count, 0, 0..1);
        }
        drop(pass);
        self.queue.submit([encoder.finish()]);
        self.window.pre_present_notify();
        self.queue.present(frame);
        if stale {
            self.configure();
        }
        Ok(true)
    }

    /// `SetVertexShaderConstant` and `SetPixelShaderConstant` of a draw: the uniform blocks of its two shaders.
    fn write_constants(&self, draw: &PreparedDraw<'_>, item: &Item) {
        for (resource, block) in &item.blocks {
            let Resource::Uniform { stage, .. } = resource else {
                continue;
            };
            let uniforms = Uniforms {
                constants: match stage {
                    ShaderKind::Vertex => &draw.vertex_constants,
                    ShaderKind::Pixel => &draw.pixel_constants,
                },
                state: &draw.state,
                viewport: [self.config.width as f32, self.config.height as f32],
                stages: item.stages,
            };
            self.queue.write_buffer(block, 0, &uniforms.block(resource));
        }
    }

    /// Waits for the last frame.
    pub(crate) fn finish(&self) -> Result<(), Failure> {
        self.device.poll(wgpu::PollType::wait_indefinitely())?;
        self.check()
    }

    /// What the device has complained about.
    fn check(&self) -> Result<(), Failure> {
        let complaint = self.complaint.lock();
        match complaint.unwrap_or_else(PoisonError::into_inner).take() {
            Some(complaint) => Err(complaint.into()),
            None => Ok(()),
        }
    }
}

/// What a bind group holds.
enum Bound {
    Block(wgpu::Buffer),
    View(wgpu::TextureView),
    Sampler(wgpu::Sampler),
}

impl Bound {
    fn resource(&self) -> wgpu::BindingResource<'_> {
        match self {
            Self::Block(buffer) => buffer.as_entire_binding(),
            Self::View(view) => wgpu::BindingResource::TextureView(view),
            Self::Sampler(sampler) => wgpu::BindingResource::Sampler(sampler),
        }
    }
}

/// A shader of the scene as the translator takes it.
fn stage_of<'a>(shader: &'a texcrd::scene::Shader, glass: &'a Glass) -> Stage<'a> {
    Stage {
        program: &shader.program,
        kernel: &shader.kernel,
        source: glass.scene.sources(),
    }
}

/// A depth buffer for the surface.
fn depth(device: &wgpu::Device, config: &wgpu::SurfaceConfiguration) -> wgpu::TextureView {
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d {
            width: config.width,
            height: config.height,
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: DEPTH,
        usage: TextureUsages::RENDER_ATTACHMENT,
        view_formats: &[],
    });
    texture.create_view(&Default::default())
}

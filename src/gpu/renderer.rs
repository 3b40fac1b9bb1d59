//! A scene on the GPU.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use image::RgbaImage;

use super::buffers::{MeshBuffers, UniformArena};
use super::picture::{COLOR_FORMAT, Picture, depth_format};
use super::pipeline::Pipelines;
use super::state::fixed_state;
use super::texture::{GpuTexture, SamplerState};
use super::{Device, GpuError, StageUniforms, Uniforms, VertexLayout};
use crate::raster::{ShadeMode, Topology};
use crate::scene::{Output, Pass, PreparedDraw, Progress, Rendered, Scene, Shader, clear_color};
use crate::texture::{Format, Texture};
use crate::wgsl::{self, Fog, Options, Points, Resource, StageOptions, Translation, translate};

/// Draws scenes with a device. Pipelines and samplers are kept from one picture to the next.
#[derive(Debug)]
pub struct Renderer<'d> {
    device: &'d Device,
    pipelines: Pipelines,
    samplers: HashMap<SamplerState, wgpu::Sampler>,
}

impl<'d> Renderer<'d> {
    /// A renderer that has made nothing yet.
    pub fn new(device: &'d Device) -> Self {
        Self {
            device,
            pipelines: Pipelines::default(),
            samplers: HashMap::new(),
        }
    }

    /// Renders the picture of a scene, and before it the render targets that it needs, off-screen.
    ///
    /// `size` is width and height of the picture in pixels, instead of those of the scene; `progress` is called before
    /// each draw. What render targets hold is read back, and mip levels and diffuse cube maps are made of it by the same
    /// code as on the CPU, so that a difference between the two paths is one of drawing.
    ///
    /// # Errors
    /// [`GpuError`] for sizes and states that the device cannot do, and for what the device reports.
    pub fn render(
        &mut self,
        scene: &Scene,
        size: Option<[u32; 2]>,
        progress: &dyn Fn(Progress<'_>),
    ) -> Result<RgbaImage, GpuError> {
        let passes = scene.passes(size.unwrap_or(scene.size()));
        let mut frame = Frame::new(self, scene, &passes, progress);
        let mut picture = RgbaImage::new(0, 0);
        for pass in &passes {
            picture = frame.pass_and_keep(pass)?.unwrap_or(picture);
        }
        Ok(picture)
    }

    /// Renders what the picture of a scene reads from render targets, and gives all textures of the scene by the numbers
    /// that [`PreparedStage::texture`](crate::scene::PreparedStage::texture) holds, for an engine that draws the picture
    /// itself. None for what hangs on a render target that the picture does not need.
    ///
    /// # Errors
    /// As [`Self::render`].
    pub fn textures(&mut self, scene: &Scene) -> Result<Vec<Option<Texture>>, GpuError> {
        let mut passes = scene.passes(scene.size());
        passes.retain(|pass| pass.output != Output::Picture);
        let mut frame = Frame::new(self, scene, &passes, &|_| ());
        for pass in &passes {
            frame.pass_and_keep(pass)?;
        }
        let texture = |number| frame.rendered.texture(number).cloned();
        Ok((0..scene.textures().len()).map(texture).collect())
    }
}

/// The translation of a draw's shaders, linked, with all its states baked in.
///
/// # Errors
/// [`GpuError::Translate`].
fn translation(
    scene: &Scene,
    draw: &PreparedDraw<'_>,
    rendered: &Rendered<'_>,
) -> Result<Translation, GpuError> {
    let state = &draw.state;
    let stages = draw.stages.each_ref().map(|stage| {
        let texture = stage.texture.and_then(|number| rendered.texture(number));
        StageOptions {
            texture: texture.map(Texture::kind),
            seamless: stage.sampler.seamless,
            address: stage.sampler.address,
            filter: stage.sampler.mag,
            lod_bias: stage.sampler.lod_bias != 0.0,
            wide_texels: texture.is_some_and(|texture| texture.format() == Format::Rgba32F),
        }
    });
    let options = Options {
        stages,
        fog: state.fog.enable.then_some(Fog {
            table: state.fog.table,
            distance: state.fog.distance,
        }),
        alpha_test: state.alpha_test.enable.then_some(state.alpha_test.func),
        overridable_definitions: draw.overrides_definitions(),
        flat_shading: state.shade == ShadeMode::Flat,
        points: match (draw.topology, state.point.sprite) {
            (Topology::PointList, true) => Points::Sprites,
            (Topology::PointList, false) => Points::Quads,
            _ => Points::None,
        },
        clip_planes: state.clip_planes.iter().flatten().count() as u8,
        ..Options::default()
    };
    let (vertex, pixel) = (stage(scene, draw.vertex), stage(scene, draw.pixel));
    translate(Some(vertex), Some(pixel), &options).map_err(|error| GpuError::Translate {
        draw: draw.name.to_owned(),
        error,
    })
}

fn stage<'a>(scene: &'a Scene, shader: &'a Shader) -> wgsl::Stage<'a> {
    wgsl::Stage {
        program: &shader.program,
        kernel: &shader.kernel,
        source: scene.sources(),
    }
}

/// One picture while it is drawn.
struct Frame<'a, 'd> {
    renderer: &'a mut Renderer<'d>,
    scene: &'a Scene,
    rendered: Rendered<'a>,
    /// The textures on the device, by their number in the scene.
    textures: HashMap<usize, GpuTexture>,
    meshes: MeshBuffers,
    done: usize,
    total: usize,
    progress: &'a dyn Fn(Progress<'_>),
}

/// A draw that only has to be encoded.
struct Ready {
    pipeline: wgpu::RenderPipeline,
    groups: [wgpu::BindGroup; 2],
    vertices: Vec<wgpu::Buffer>,
    indices: Option<(wgpu::Buffer, u32)>,
    /// Vertices of one instance, and instances.
    counts: [u32; 2],
    stencil: u32,
}

impl<'a, 'd> Frame<'a, 'd> {
    fn new(
        renderer: &'a mut Renderer<'d>,
        scene: &'a Scene,
        passes: &[Pass<'_>],
        progress: &'a dyn Fn(Progress<'_>),
    ) -> Self {
        Self {
            renderer,
            scene,
            rendered: Rendered::new(scene),
            textures: HashMap::new(),
            meshes: MeshBuffers::default(),
            done: 0,
            total: passes.iter().map(|pass| pass.draws.len()).sum(),
            progress,
        }
    }

    /// Draws a pass; what goes into a render target is kept for the passes that read it, the picture is returned.
    fn pass_and_keep(&mut self, pass: &Pass<'_>) -> Result<Option<RgbaImage>, GpuError> {
        let drawn = self.pass(pass)?;
        match pass.output {
            Output::Picture => Ok(Some(drawn)),
            Output::Target { target, face } => {
                self.rendered.take_face(target, face, &drawn)?;
                Ok(None)
            }
        }
    }

    fn pass(&mut self, pass: &Pass<'_>) -> Result<RgbaImage, GpuError> {
        let device = self.renderer.device;
        let [width, height] = pass.size;
        if width == 0 || height == 0 {
            return Ok(RgbaImage::new(width, height));
        }
        device.check_size("a picture", pass.size)?;
        let stencil = pass.draws.iter().any(|draw| draw.state.stencil.enable);
        let depth = depth_format(device, stencil);
        let target = match pass.output {
            Output::Picture => None,
            Output::Target { target, .. } => self.scene.target(target).map(|info| info.name),
        };
        let mut translations = Vec::with_capacity(pass.draws.len());
        let mut arena = UniformArena::new(device);
        for draw in &pass.draws {
            let translation = translation(self.scene, draw, &self.rendered)?;
            let places = self.uniforms(draw, &translation, pass.size, &mut arena);
            translations.push((translation, places));
        }
        let uniforms = arena.upload(device);
        let mut ready = Vec::with_capacity(pass.draws.len());
        for (draw, (translation, places)) in pass.draws.iter().zip(&translations) {
            (self.progress)(Progress {
                done: self.done,
                total: self.total,
                target,
                draw: draw.name,
            });
            ready.extend(self.prepare(draw, translation, places, &uniforms, depth)?);
            self.done += 1;
        }
        let picture = Picture::new(device, pass.size, COLOR_FORMAT, depth);
        let mut encoder = device.device.create_command_encoder(&Default::default());
        // As eight bits hold it, so that rounding is not left to the device.
        let clear = clear_color(pass.clear).map(|byte| f64::from(byte) / 255.0);
        let mut commands = picture.begin(&mut encoder, clear);
        ready.iter().for_each(|draw| draw.encode(&mut commands));
        drop(commands);
        let bytes = picture.read(device, encoder)?;
        RgbaImage::from_raw(width, height, bytes)
            .ok_or_else(|| GpuError::Device("a picture came back incomplete".into()))
    }

    /// Puts the uniform blocks of a draw into the arena; gives their places by binding.
    fn uniforms(
        &self,
        draw: &PreparedDraw<'_>,
        translation: &Translation,
        size: [u32; 2],
        arena: &mut UniformArena,
    ) -> Vec<(u32, std::ops::Range<u64>)> {
        let stages = draw.stages.each_ref().map(|stage| {
            let texture = stage
                .texture
                .and_then(|number| self.rendered.texture(number));
            let border = stage.sampler.border;
            StageUniforms {
                bump: stage.bump,
                border: texture.map_or(border, |texture| texture.format().with_fill(border)),
                lod_bias: stage.sampler.lod_bias,
            }
        });
        let mut places = Vec::new();
        for binding in &translation.reflection.bindings {
            let constants = match &binding.resource {
                Resource::Uniform { stage, .. } => match stage {
                    crate::isa::ShaderKind::Vertex => &draw.vertex_constants,
                    crate::isa::ShaderKind::Pixel => &draw.pixel_constants,
                },
                Resource::Texture { .. } | Resource::Sampler { .. } => continue,
            };
            let uniforms = Uniforms {
                constants,
                state: &draw.state,
                viewport: size.map(|side| side as f32),
                stages,
            };
            places.push((
                binding.binding,
                arena.push(&uniforms.block(&binding.resource)),
            ));
        }
        places
    }

    /// Everything that a draw needs on the device; none if it draws nothing.
    fn prepare(
        &mut self,
        draw: &PreparedDraw<'_>,
        translation: &Translation,
        places: &[(u32, std::ops::Range<u64>)],
        uniforms: &wgpu::Buffer,
        depth: wgpu::TextureFormat,
    ) -> Result<Option<Ready>, GpuError> {
        let device = self.renderer.device;
        let points = draw.topology == Topology::PointList;
        let count = draw.mesh.vertex_count() as u32;
        let indices = self.meshes.indices(device, draw.mesh, draw.topology);
        if count == 0 || indices.as_ref().is_some_and(|(_, count)| *count == 0) {
            return Ok(None);
        }
        let wireframe = device.has(wgpu::Features::POLYGON_MODE_LINE);
        let fixed = fixed_state(&draw.state, draw.topology, depth, wireframe).map_err(|state| {
            GpuError::Unsupported {
                draw: draw.name.to_owned(),
                state,
            }
        })?;
        let inputs = &translation.reflection.inputs;
        let layout = VertexLayout::new(draw.declaration, inputs, points);
        let vertices = layout
            .streams()
            .map(|stream| self.meshes.stream(device, draw.mesh, stream))
            .collect();
        let bound = self.bound_textures(draw, translation)?;
        let pipeline =
            (self.renderer.pipelines).get(device, translation, layout, fixed, COLOR_FORMAT)?;
        let uniform_entries: Vec<_> = places
            .iter()
            .map(|(binding, place)| wgpu::BindGroupEntry {
                binding: *binding,
                resource: wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                    buffer: uniforms,
                    offset: place.start,
                    size: std::num::NonZeroU64::new(place.end - place.start),
                }),
            })
            .collect();
        let texture_entries: Vec<_> = bound
            .iter()
            .map(|(binding, bound)| wgpu::BindGroupEntry {
                binding: *binding,
                resource: match bound {
                    Bound::View(view) => wgpu::BindingResource::TextureView(view),
                    Bound::Sampler(sampler) => wgpu::BindingResource::Sampler(sampler),
                },
            })
            .collect();
        let group = |layout, entries: &[wgpu::BindGroupEntry<'_>]| {
            device.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: None,
                layout,
                entries,
            })
        };
        Ok(Some(Ready {
            groups: [
                group(&pipeline.groups[0], &uniform_entries),
                group(&pipeline.groups[1], &texture_entries),
            ],
            pipeline: pipeline.pipeline.clone(),
            vertices,
            indices,
            counts: if points { [4, count] } else { [count, 1] },
            stencil: draw.state.stencil.reference.into(),
        }))
    }

    /// The textures and samplers of a draw by binding, uploaded if they are not there yet.
    fn bound_textures(
        &mut self,
        draw: &PreparedDraw<'_>,
        translation: &Translation,
    ) -> Result<Vec<(u32, Bound)>, GpuError> {
        let device = self.renderer.device;
        let mut bound = Vec::new();
        for binding in &translation.reflection.bindings {
            let number = match &binding.resource {
                Resource::Uniform { .. } => continue,
                Resource::Texture { stage, .. } | Resource::Sampler { stage, .. } => {
                    usize::from(*stage)
                }
            };
            let Some(stage) = draw.stages.get(number) else {
                continue;
            };
            let source = |number| Some((number, self.rendered.texture(number)?));
            let Some((number, source)) = stage.texture.and_then(source) else {
                continue;
            };
            let texture = match self.textures.entry(number) {
                Entry::Occupied(known) => known.into_mut(),
                Entry::Vacant(place) => place.insert(GpuTexture::upload(device, source)?),
            };
            let resource = match &binding.resource {
                Resource::Sampler { clamps, .. } => {
                    let state = texture.sampler_state(&stage.sampler, *clamps);
                    let samplers = &mut self.renderer.samplers;
                    let sampler = samplers
                        .entry(state)
                        .or_insert_with(|| state.create(device));
                    Bound::Sampler(sampler.clone())
                }
                Resource::Texture { dimension, .. } => {
                    Bound::View(texture.view(*dimension, &stage.sampler))
                }
                Resource::Uniform { .. } => continue,
            };
            bound.push((binding.binding, resource));
        }
        Ok(bound)
    }
}

/// What is bound in group 1.
enum Bound {
    View(wgpu::TextureView),
    Sampler(wgpu::Sampler),
}

impl Ready {
    fn encode(&self, commands: &mut wgpu::RenderPass<'_>) {
        commands.set_pipeline(&self.pipeline);
        for (number, group) in (0..).zip(&self.groups) {
            commands.set_bind_group(number, group, &[]);
        }
        for (slot, buffer) in (0..).zip(&self.vertices) {
            commands.set_vertex_buffer(slot, buffer.slice(..));
        }
        commands.set_stencil_reference(self.stencil);
        match &self.indices {
            Some((buffer, count)) => {
                commands.set_index_buffer(buffer.slice(..), wgpu::IndexFormat::Uint32);
                commands.draw_indexed(0..*count, 0, 0..1);
            }
            None => commands.draw(0..self.counts[0], 0..self.counts[1]),
        }
    }
}

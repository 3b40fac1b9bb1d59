//! A scene on the GPU.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use image::RgbaImage;

use super::buffers::{MeshBuffers, UniformArena};
use super::picture::{COLOR_FORMAT, Picture, depth_format};
use super::pipeline::Pipelines;
use super::state::fixed_state;
use super::texture::{Bound, GpuTexture, Samplers, stage_options};
use super::{Device, GpuError, StageUniforms, Uniforms, VertexLayout};
use crate::raster::Topology;
use crate::scene::{
    Output, Pass, PreparedDraw, Progress, Rendered, Scene, Shader, TargetPicture, clear_color,
};
use crate::wgsl::{self, Options, Points, Resource, Translation, translate};

/// Draws scenes with a device. Pipelines and samplers are kept from one picture to the next.
#[derive(Debug)]
pub struct Renderer<'d> {
    device: &'d Device,
    pipelines: Pipelines,
    samplers: Samplers,
}

impl<'d> Renderer<'d> {
    /// A renderer that has made nothing yet.
    pub fn new(device: &'d Device) -> Self {
        Self {
            device,
            pipelines: Pipelines::default(),
            samplers: Samplers::default(),
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
        self.render_all(scene, size, &[], progress)
            .map(|(picture, _)| picture)
    }

    /// [`Renderer::render`], and what the render targets held, in the order in which they were drawn.
    ///
    /// Where `given` has a face of a target, everything that is drawn after it sees that instead of what was drawn. With
    /// the pictures of [`Scene::render_all`] each target and the picture are drawn from the same inputs as on the CPU, and
    /// a difference in one is not seen again in the next.
    ///
    /// # Errors
    /// As for [`Renderer::render`], and [`GpuError::Render`] for given pictures that cannot become a texture.
    pub fn render_all(
        &mut self,
        scene: &Scene,
        size: Option<[u32; 2]>,
        given: &[TargetPicture],
        progress: &dyn Fn(Progress<'_>),
    ) -> Result<(RgbaImage, Vec<TargetPicture>), GpuError> {
        let passes = scene.passes(size.unwrap_or(scene.size()));
        let total = passes.iter().map(|pass| pass.draws.len()).sum();
        let mut frame = Frame {
            renderer: self,
            scene,
            rendered: Rendered::new(scene),
            textures: HashMap::new(),
            meshes: MeshBuffers::default(),
            done: 0,
            total,
            progress,
        };
        let mut targets = Vec::new();
        let mut result = RgbaImage::new(0, 0);
        for pass in &passes {
            let picture = frame.pass(pass)?;
            match pass.output {
                Output::Picture => result = picture,
                Output::Target { target, face } => {
                    let is_this =
                        |given: &&TargetPicture| (given.target, given.face) == (target, face);
                    let seen = given.iter().find(is_this).map(|given| &given.picture);
                    frame
                        .rendered
                        .take_face(target, face, seen.unwrap_or(&picture))?;
                    targets.push(TargetPicture {
                        target,
                        face,
                        picture,
                    });
                }
            }
        }
        Ok((result, targets))
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
        stage_options(texture, &stage.sampler)
    });
    let options = Options {
        stages,
        overridable_definitions: draw.overrides_definitions(),
        points: match (draw.topology, state.point.sprite) {
            (Topology::PointList, true) => Points::Sprites,
            (Topology::PointList, false) => Points::Quads,
            _ => Points::None,
        },
        ..Options::default().with_state(state)
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

impl Frame<'_, '_> {
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
        let picture = Picture::new(device, pass.size, COLOR_FORMAT, depth, false);
        let mut encoder = device.device.create_command_encoder(&Default::default());
        // As eight bits hold it, so that rounding is not left to the device.
        let clear = clear_color(pass.clear).map(|byte| f64::from(byte) / 255.0);
        let mut commands = picture.begin(&mut encoder, clear);
        ready.iter().for_each(|draw| draw.encode(&mut commands));
        drop(commands);
        let (bytes, _) = picture.read(device, encoder)?;
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
            StageUniforms::new(texture, &stage.sampler, stage.bump)
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
            .map(|(binding, place)| UniformArena::entry(uniforms, *binding, place))
            .collect();
        let texture_entries: Vec<_> = bound
            .iter()
            .map(|(binding, bound)| bound.entry(*binding))
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
            let samplers = &mut self.renderer.samplers;
            let resource = samplers.bound(device, &binding.resource, texture, &stage.sampler);
            bound.extend(resource.map(|resource| (binding.binding, resource)));
        }
        Ok(bound)
    }
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

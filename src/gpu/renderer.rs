//! A scene on the GPU.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::ops::Range;

use image::RgbaImage;

use super::buffers::{MeshBuffers, UniformArena};
use super::picture::{COLOR_FORMAT, Depth, Picture, depth_format};
use super::pipeline::Pipelines;
use super::ready::{Ready, common};
use super::state::{FixedState, fixed_state};
use super::texture::{Bound, GpuTexture, Samplers, stage_options};
use super::{Device, GpuError, StageUniforms, Uniforms, VertexLayout};
use crate::raster::{MarkSet, RegisterPicture, RenderState, Topology};
use crate::scene::{
    Output, Pass, PreparedDraw, Progress, RenderOptions, Rendered, Scene, Shader, TargetPicture,
};
use crate::sheet::{self, Dressing, SheetTooLarge, Tile};
use crate::texture::Texture;
use crate::wgsl::{self, Options, Points, Resource, Shown, Translation, translate};

/// Draws scenes with a device. Pipelines and samplers are kept from one picture to the next.
#[derive(Debug)]
pub struct Renderer<'d> {
    pub(super) device: &'d Device,
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
    /// `progress` is called before each draw. What render targets hold is read back, and mip levels and diffuse cube maps
    /// are made of it by the same code as on the CPU, so that a difference between the two paths is one of drawing.
    ///
    /// # Errors
    /// [`GpuError`] for sizes and states that the device cannot do, for a draw to show that there is not, and for what
    /// the device reports.
    pub fn render(
        &mut self,
        scene: &Scene,
        options: &RenderOptions,
        progress: &dyn Fn(Progress<'_>),
    ) -> Result<RgbaImage, GpuError> {
        Ok(self.frame(scene, options, &[], progress)?.into_picture())
    }

    /// Renders like [`Self::render`], and keeps with the picture what the render targets held, and what is needed to ask
    /// for the registers of a pixel.
    ///
    /// Where `given` has a face of a target, everything that is drawn after it sees that instead of what was drawn. With
    /// [`Rendering::target_pictures`](crate::scene::Rendering::target_pictures) each target and the picture are drawn from
    /// the same inputs as on the CPU, and a difference in one is not seen again in the next.
    ///
    /// # Errors
    /// As [`Self::render`], and [`GpuError::Render`] for given pictures that cannot become a texture.
    pub fn frame<'r>(
        &'r mut self,
        scene: &'r Scene,
        options: &RenderOptions,
        given: &[TargetPicture],
        progress: &dyn Fn(Progress<'_>),
    ) -> Result<Frame<'r, 'd>, GpuError> {
        let size = options.size.unwrap_or(scene.size());
        let passes = scene.passes(size);
        let shown = scene.shown(options)?;
        let mut frame = Frame::new(self, scene, size);
        frame.passes(&passes, shown, given, progress)?;
        Ok(frame)
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
        let mut frame = Frame::new(self, scene, scene.size());
        frame.passes(&passes, None, &[], &|_| ())?;
        let texture = |number| frame.rendered.texture(number).cloned();
        Ok((0..scene.textures().len()).map(texture).collect())
    }
}

/// How far a frame is, and who is told.
pub(super) struct Steps<'p> {
    pub(super) done: usize,
    pub(super) total: usize,
    pub(super) progress: &'p dyn Fn(Progress<'_>),
}

/// The translation of a draw's shaders, linked, with all its states baked in; with a register in place of the colour if
/// one is to be shown.
///
/// # Errors
/// [`GpuError::Translate`].
fn translation(
    scene: &Scene,
    draw: &PreparedDraw<'_>,
    rendered: &Rendered<'_>,
    show: Option<Shown>,
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
        show,
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

/// A scene that was rendered on a GPU: its picture, and what is on the device for it.
pub struct Frame<'r, 'd> {
    pub(super) renderer: &'r mut Renderer<'d>,
    scene: &'r Scene,
    rendered: Rendered<'r>,
    /// The textures on the device, by their number in the scene.
    textures: HashMap<usize, GpuTexture>,
    meshes: MeshBuffers,
    size: [u32; 2],
    picture: RgbaImage,
    /// The pictures of registers that were asked for in place of the picture, with the marks that occurred.
    registers: Vec<(RgbaImage, MarkSet)>,
    targets: Vec<TargetPicture>,
}

/// A draw and how it is drawn.
pub(super) struct Planned<'p> {
    pub(super) draw: &'p PreparedDraw<'p>,
    pub(super) state: RenderState,
    /// The register that is drawn in place of the colour.
    pub(super) show: Option<Shown>,
    /// The format that it is drawn into.
    pub(super) format: wgpu::TextureFormat,
}

/// What a draw is drawn with.
pub(super) struct Drawing {
    translation: Translation,
    /// The places of the uniform blocks in the arena, by binding.
    places: Vec<(u32, Range<u64>)>,
    fixed: FixedState,
    format: wgpu::TextureFormat,
}

impl<'r, 'd> Frame<'r, 'd> {
    /// Nothing drawn yet.
    pub(super) fn new(renderer: &'r mut Renderer<'d>, scene: &'r Scene, size: [u32; 2]) -> Self {
        Self {
            renderer,
            scene,
            rendered: Rendered::new(scene),
            textures: HashMap::new(),
            meshes: MeshBuffers::default(),
            size,
            picture: RgbaImage::new(0, 0),
            registers: Vec::new(),
            targets: Vec::new(),
        }
    }

    /// The scene.
    pub fn scene(&self) -> &'r Scene {
        self.scene
    }

    /// The device.
    pub fn device(&self) -> &'d Device {
        self.renderer.device
    }

    /// The picture; if registers are shown, that of the first.
    pub fn picture(&self) -> &RgbaImage {
        let first = self.registers.first();
        first.map_or(&self.picture, |(picture, _)| picture)
    }

    /// The pictures of registers that were asked for, in their order; none if the picture itself was.
    pub fn register_pictures(&self) -> impl Iterator<Item = &RgbaImage> {
        self.registers.iter().map(|(picture, _)| picture)
    }

    /// The picture alone.
    fn into_picture(self) -> RgbaImage {
        let first = self.registers.into_iter().next();
        first.map_or(self.picture, |(picture, _)| picture)
    }

    /// The marks that occurred in the pictures of registers, picture by picture.
    pub fn marks(&self) -> Vec<MarkSet> {
        self.registers.iter().map(|(_, marks)| *marks).collect()
    }

    /// The pictures of registers on a sheet. The tiles are those whose pictures were asked for.
    ///
    /// # Errors
    /// [`SheetTooLarge`].
    pub fn sheet(&self, tiles: &[Tile], dressing: Dressing) -> Result<RgbaImage, SheetTooLarge> {
        let picture = |number: usize| match self.registers.get(number) {
            Some((picture, _)) => picture.clone(),
            None => RgbaImage::new(0, 0),
        };
        sheet::compose(tiles, self.size, dressing, &self.marks(), picture)
    }

    /// What the render targets held, face by face in the order in which they were drawn.
    pub fn targets(&self) -> &[TargetPicture] {
        &self.targets
    }

    /// Width and height of the picture in pixels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Draws passes in order and keeps what they give.
    pub(super) fn passes(
        &mut self,
        passes: &[Pass<'_>],
        shown: Option<(usize, &[RegisterPicture])>,
        given: &[TargetPicture],
        progress: &dyn Fn(Progress<'_>),
    ) -> Result<(), GpuError> {
        let times = |pass: &Pass<'_>| match (pass.output, shown) {
            (Output::Picture, Some((_, pictures))) => pictures.len(),
            _ => 1,
        };
        let mut steps = Steps {
            done: 0,
            total: (passes.iter().map(|pass| pass.draws.len() * times(pass))).sum(),
            progress,
        };
        for pass in passes {
            match (pass.output, shown) {
                (Output::Picture, Some((draw, pictures))) => {
                    for picture in pictures {
                        let drawn = self.register_picture(pass, draw, picture, &mut steps)?;
                        self.registers.push(drawn);
                    }
                }
                (Output::Picture, None) => self.picture = self.pass(pass, &mut steps)?,
                (Output::Target { target, face }, _) => {
                    let picture = self.pass(pass, &mut steps)?;
                    let is_this =
                        |given: &&TargetPicture| (given.target, given.face) == (target, face);
                    let seen = given.iter().find(is_this);
                    let seen = seen.map_or(&picture, |given| &given.picture);
                    self.rendered.take_face(target, face, seen)?;
                    self.targets.push(TargetPicture {
                        target,
                        face,
                        picture,
                    });
                }
            }
        }
        Ok(())
    }

    fn pass(&mut self, pass: &Pass<'_>, steps: &mut Steps<'_>) -> Result<RgbaImage, GpuError> {
        let device = self.renderer.device;
        let [width, height] = pass.size;
        if width == 0 || height == 0 {
            return Ok(RgbaImage::new(width, height));
        }
        let planned: Vec<_> = (pass.draws.iter())
            .map(|draw| Planned::plain(draw, pass))
            .collect();
        let depth = pass_depth(device, pass);
        let ready = self.ready(pass, &planned, depth, steps)?;
        let holds = pass.surface.stored();
        let picture = Picture::new(device, pass.size, COLOR_FORMAT, depth, Depth::Dropped)
            .clearing_to(holds.depth, holds.stencil);
        let mut encoder = device.device.create_command_encoder(&Default::default());
        let mut commands = picture.begin(&mut encoder, Some(clear_bytes(pass)));
        (ready.iter().flatten()).for_each(|draw| draw.encode(&mut commands));
        drop(commands);
        let (bytes, _) = picture.read(device, encoder)?;
        image(pass.size, bytes)
    }

    /// Gets the draws of a pass ready; none in the place of one that draws nothing.
    pub(super) fn ready(
        &mut self,
        pass: &Pass<'_>,
        planned: &[Planned<'_>],
        depth: wgpu::TextureFormat,
        steps: &mut Steps<'_>,
    ) -> Result<Vec<Option<Ready>>, GpuError> {
        let device = self.renderer.device;
        device.check_size("a picture", pass.size)?;
        let target = match pass.output {
            Output::Picture => None,
            Output::Target { target, .. } => self.scene.target(target).map(|info| info.name),
        };
        let mut arena = UniformArena::new(device);
        let drawings: Vec<_> = (planned.iter())
            .map(
                |Planned {
                     draw,
                     state,
                     show,
                     format,
                 }| {
                    let formats = (*format, depth);
                    self.drawing(draw, state, *show, pass.size, formats, &mut arena)
                },
            )
            .collect::<Result<_, _>>()?;
        let uniforms = arena.upload(device);
        let mut ready = Vec::with_capacity(planned.len());
        for (Planned { draw, .. }, drawing) in planned.iter().zip(&drawings) {
            (steps.progress)(Progress {
                done: steps.done.min(steps.total),
                total: steps.total,
                target,
                draw: draw.name,
            });
            ready.push(self.prepare(draw, drawing, pass.size, &uniforms)?);
            steps.done += 1;
        }
        Ok(ready)
    }

    /// What a draw is drawn with in these states, into a target of this size and these formats of colour and depth; its
    /// uniform blocks go into the arena. With a register in place of the colour if one is to be shown.
    ///
    /// # Errors
    /// [`GpuError::Translate`] and [`GpuError::Unsupported`].
    pub(super) fn drawing(
        &self,
        draw: &PreparedDraw<'_>,
        state: &RenderState,
        show: Option<Shown>,
        size: [u32; 2],
        (format, depth): (wgpu::TextureFormat, wgpu::TextureFormat),
        arena: &mut UniformArena,
    ) -> Result<Drawing, GpuError> {
        let translation = translation(self.scene, draw, &self.rendered, show)?;
        let wireframe = self.renderer.device.has(wgpu::Features::POLYGON_MODE_LINE);
        let fixed = fixed_state(state, draw.topology, depth, wireframe).map_err(|state| {
            GpuError::Unsupported {
                draw: draw.name.to_owned(),
                state,
            }
        })?;
        Ok(Drawing {
            places: self.uniforms(draw, &translation, size, arena),
            translation,
            fixed,
            format,
        })
    }

    /// Puts the uniform blocks of a draw into the arena; gives their places by binding.
    fn uniforms(
        &self,
        draw: &PreparedDraw<'_>,
        translation: &Translation,
        size: [u32; 2],
        arena: &mut UniformArena,
    ) -> Vec<(u32, Range<u64>)> {
        let stages = draw.stages.each_ref().map(|stage| {
            let texture = stage
                .texture
                .and_then(|number| self.rendered.texture(number));
            StageUniforms::new(texture, &stage.sampler, stage.bump)
        });
        let viewport = draw.state.viewport.on(size);
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
                viewport: [viewport.width, viewport.height].map(|side| side as f32),
                stages,
            };
            places.push((
                binding.binding,
                arena.push(&uniforms.block(&binding.resource)),
            ));
        }
        places
    }

    /// Everything that a draw needs on the device, to be drawn into a picture of this size; none if it draws nothing.
    ///
    /// # Errors
    /// [`GpuError::Limit`] for a viewport that is larger than the device's pictures; and what the device reports.
    pub(super) fn prepare(
        &mut self,
        draw: &PreparedDraw<'_>,
        drawing: &Drawing,
        size: [u32; 2],
        uniforms: &wgpu::Buffer,
    ) -> Result<Option<Ready>, GpuError> {
        let viewport = draw.state.viewport.on(size);
        let Some(scissor) = common([0, 0, size[0], size[1]], viewport.rectangle()) else {
            return Ok(None);
        };
        (self.renderer.device).check_size("a viewport", [viewport.width, viewport.height])?;
        let translation = &drawing.translation;
        let device = self.renderer.device;
        let points = draw.topology == Topology::PointList;
        let count = draw.mesh.vertex_count() as u32;
        let indices = self.meshes.indices(device, draw);
        if count == 0 || indices.as_ref().is_some_and(|(_, count)| *count == 0) {
            return Ok(None);
        }
        let inputs = &translation.reflection.inputs;
        let layout = VertexLayout::new(draw.declaration, inputs, points);
        let vertices = layout
            .streams()
            .map(|stream| self.meshes.stream(device, draw.mesh, stream))
            .collect();
        let bound = self.bound_textures(draw, translation)?;
        let fixed = drawing.fixed.clone();
        let pipelines = &mut self.renderer.pipelines;
        let pipeline = pipelines.get(device, translation, layout, fixed, drawing.format)?;
        let uniform_entries: Vec<_> = (drawing.places)
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
            corners: match &indices {
                _ if points => 0..4,
                Some((_, count)) => 0..*count,
                None => 0..count,
            },
            instances: if points { 0..count } else { 0..1 },
            indices: indices.map(|(buffer, _)| buffer),
            stencil: draw.state.stencil.reference.into(),
            viewport,
            scissor,
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

impl<'p> Planned<'p> {
    /// A draw of a pass as it is.
    pub(super) fn plain(draw: &'p PreparedDraw<'p>, pass: &Pass<'_>) -> Self {
        let mut state = draw.state.clone();
        state.color_mask = pass.surface.format.written(state.color_mask);
        Self {
            draw,
            state,
            show: None,
            format: COLOR_FORMAT,
        }
    }
}

/// The depth format of a pass.
pub(super) fn pass_depth(device: &Device, pass: &Pass<'_>) -> wgpu::TextureFormat {
    let stencil = pass.draws.iter().any(|draw| draw.state.stencil.enable);
    depth_format(device, stencil)
}

/// What a pass is cleared to: as eight bits hold it, so that rounding is not left to the device.
pub(super) fn clear_bytes(pass: &Pass<'_>) -> [f64; 4] {
    (pass.surface.stored().color).map(|byte| f64::from(byte) / 255.0)
}

/// A picture of the bytes that came back.
pub(super) fn image([width, height]: [u32; 2], bytes: Vec<u8>) -> Result<RgbaImage, GpuError> {
    RgbaImage::from_raw(width, height, bytes)
        .ok_or_else(|| GpuError::Device("a picture came back incomplete".into()))
}

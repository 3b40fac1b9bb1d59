//! What render targets become: textures.

use std::borrow::Cow;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use image::RgbaImage;

use super::prepare::{Pass, PreparedDraw};
use super::render::RenderError;
use super::{Scene, TextureSource};
use crate::exec::{Environment, Stage};
use crate::raster::{BatchProgram, DrawCall, PixelProgram, RenderState, Vertices, shade_vertices};
use crate::texture::load::cube_from_faces;
use crate::texture::{Texture, TextureError};

/// The textures of a scene while it is rendered: those that were loaded, and what render targets have become so far.
///
/// Whoever draws, CPU or GPU, gives the pictures back here, so that mip levels and diffuse cube maps are made by one code.
pub(crate) struct Rendered<'a> {
    scene: &'a Scene,
    /// The targets that are done, by number.
    targets: Vec<Option<Texture>>,
    /// What was made of targets, by the number of the texture.
    derived: Vec<Option<Texture>>,
    /// The faces of the target that is being rendered.
    faces: Vec<Texture>,
}

impl<'a> Rendered<'a> {
    pub(crate) fn new(scene: &'a Scene) -> Self {
        Self {
            scene,
            targets: vec![None; scene.targets.len()],
            derived: vec![None; scene.textures.len()],
            faces: Vec::new(),
        }
    }

    /// Takes the picture of one face of a target; with the last face the target becomes a texture.
    ///
    /// # Errors
    /// [`RenderError::Texture`] for a picture that is too large for a texture.
    pub(crate) fn take_face(
        &mut self,
        number: usize,
        face: usize,
        picture: &RgbaImage,
    ) -> Result<(), RenderError> {
        let Some(plan) = self.scene.targets.get(number) else {
            return Ok(());
        };
        let refused = |error: TextureError| RenderError::Texture {
            target: plan.name.clone(),
            error,
        };
        let (width, height) = picture.dimensions();
        let texture = Texture::from_rgba8(width, height, picture.as_raw()).map_err(refused)?;
        if face == 0 {
            self.faces.clear();
        }
        self.faces.push(texture);
        if self.faces.len() < plan.faces() {
            return Ok(());
        }
        let faces = std::mem::take(&mut self.faces);
        let mut texture = match <[Texture; 6]>::try_from(faces) {
            Ok(faces) => cube_from_faces(faces).map_err(refused)?,
            Err(mut faces) => match faces.pop() {
                Some(flat) => flat,
                None => return Ok(()),
            },
        };
        if plan.mipmaps {
            texture.generate_mips().map_err(refused)?;
        }
        for (entry, place) in self.scene.textures.iter().zip(&mut self.derived) {
            if let TextureSource::Irradiance { target, edge } = entry.source
                && target == number
            {
                *place = Some(texture.irradiance(edge).map_err(refused)?);
            }
        }
        if let Some(place) = self.targets.get_mut(number) {
            *place = Some(texture);
        }
        Ok(())
    }

    /// Runs the vertex shader of a draw, and puts together what its pixel shader needs.
    pub(crate) fn shade<'s>(&'s self, draw: &'s PreparedDraw<'_>) -> ShadedDraw<'s> {
        self.with_vertices(draw, Cow::Owned(shade(draw)))
    }

    /// The same of a draw whose vertex shader has run before.
    pub(super) fn with_vertices<'s>(
        &'s self,
        draw: &'s PreparedDraw<'_>,
        vertices: Cow<'s, Vertices>,
    ) -> ShadedDraw<'s> {
        let environment = Environment {
            constants: draw.pixel_constants.clone(),
            stages: draw.stages.each_ref().map(|stage| Stage {
                texture: stage.texture.and_then(|number| self.texture(number)),
                sampler: stage.sampler,
                bump: stage.bump,
            }),
        };
        ShadedDraw {
            draw,
            vertices,
            environment,
        }
    }

    /// A texture of the scene by its number; none if its render target is not done yet.
    pub(crate) fn texture(&self, number: usize) -> Option<&Texture> {
        match &self.scene.textures.get(number)?.source {
            TextureSource::Loaded(texture) => Some(texture),
            TextureSource::Target(target) => self.targets.get(*target)?.as_ref(),
            TextureSource::Irradiance { .. } => self.derived.get(number)?.as_ref(),
        }
    }
}

/// Runs the vertex shader of a draw over its whole mesh.
pub(super) fn shade(draw: &PreparedDraw<'_>) -> Vertices {
    shade_vertices(
        &draw.vertex.kernel,
        &draw.vertex.plan,
        &draw.vertex_environment(),
        draw.mesh.vertex_count(),
        |vertex, register| draw.input(vertex, register),
    )
}

/// A draw whose vertex shader has run, and what its pixel shader runs with.
#[derive(Clone, Debug)]
pub struct ShadedDraw<'a> {
    draw: &'a PreparedDraw<'a>,
    vertices: Cow<'a, Vertices>,
    environment: Environment<'a>,
}

impl<'a> ShadedDraw<'a> {
    /// The draw.
    pub fn draw(&self) -> &'a PreparedDraw<'a> {
        self.draw
    }

    /// What the vertex shader left of each vertex of the mesh.
    pub fn vertices(&self) -> &Vertices {
        &self.vertices
    }

    /// The constants, textures with their samplers, and bump mapping states of the pixel shader.
    pub fn environment(&self) -> &Environment<'a> {
        &self.environment
    }

    /// The pixel shader as it draws: on many pixels at a time.
    pub fn shader(&self) -> BatchProgram<'_> {
        BatchProgram::new(self.program(), &self.draw.pixel.plan)
    }

    /// The pixel shader with all that is set while it runs, for whoever looks at its registers.
    pub fn program(&self) -> PixelProgram<'_> {
        PixelProgram {
            kernel: &self.draw.pixel.kernel,
            environment: &self.environment,
        }
    }

    /// The draw call onto a target of this size. `state`: that of the draw, or one in its place.
    pub fn call<'c>(&'c self, state: &'c RenderState, size: [u32; 2]) -> DrawCall<'c> {
        DrawCall {
            viewport: state.viewport.on(size),
            state,
            topology: self.draw.topology,
            vertices: &self.vertices,
            indices: self.draw.indices(),
        }
    }
}

/// At most so many shaded vertices are kept. They take at most 184 bytes each.
const MOST_KEPT: usize = 1 << 20;

/// The vertices of draws whose vertex shader has run, for those who ask again.
pub(super) struct ShadedMeshes {
    /// By pass and draw.
    meshes: Vec<Vec<OnceLock<Vertices>>>,
    /// How many more may be kept.
    room: AtomicUsize,
}

impl ShadedMeshes {
    /// For the draws of these passes, of which none has run.
    pub(super) fn new(passes: &[Pass<'_>]) -> Self {
        let unknown = |pass: &Pass<'_>| pass.draws.iter().map(|_| OnceLock::new()).collect();
        Self {
            meshes: passes.iter().map(unknown).collect(),
            room: AtomicUsize::new(MOST_KEPT),
        }
    }

    /// The vertices of a draw, which stands at this place.
    pub(super) fn get(
        &self,
        pass: usize,
        place: usize,
        draw: &PreparedDraw<'_>,
    ) -> Cow<'_, Vertices> {
        let Some(mesh) = self.meshes.get(pass).and_then(|draws| draws.get(place)) else {
            return Cow::Owned(shade(draw));
        };
        if let Some(vertices) = mesh.get() {
            return Cow::Borrowed(vertices);
        }
        // Not within the lock: whoever waits for it may be the one that the shading waits for.
        let vertices = shade(draw);
        let taken = |room: usize| room.checked_sub(vertices.len());
        if self.room.fetch_update(Relaxed, Relaxed, taken).is_err() {
            return Cow::Owned(vertices);
        }
        Cow::Borrowed(mesh.get_or_init(|| vertices))
    }
}

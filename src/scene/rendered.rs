//! What render targets become: textures.

use image::RgbaImage;

use super::prepare::PreparedDraw;
use super::render::RenderError;
use super::{Scene, TextureSource};
use crate::exec::{Environment, Stage};
use crate::raster::{DrawCall, RenderState, Vertex, Viewport, shade_vertices};
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
    pub(crate) fn shade(&self, draw: &PreparedDraw<'_>) -> ShadedDraw<'_> {
        let for_vertices = Environment {
            constants: draw.vertex_constants.clone(),
            ..Environment::default()
        };
        let vertices = shade_vertices(
            &draw.vertex.kernel,
            &for_vertices,
            draw.mesh.vertex_count(),
            |vertex, register| draw.input(vertex, register),
        );
        let environment = Environment {
            constants: draw.pixel_constants.clone(),
            stages: draw.stages.each_ref().map(|stage| Stage {
                texture: stage.texture.and_then(|number| self.texture(number)),
                sampler: stage.sampler,
                bump: stage.bump,
            }),
        };
        ShadedDraw {
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

/// A draw whose vertex shader has run, and what its pixel shader runs with.
pub(crate) struct ShadedDraw<'a> {
    vertices: Vec<Vertex>,
    /// The constants, textures and stage states of the pixel shader.
    pub(crate) environment: Environment<'a>,
}

impl ShadedDraw<'_> {
    /// The draw call onto a target of this size.
    pub(crate) fn call<'c>(
        &'c self,
        draw: &'c PreparedDraw<'_>,
        state: &'c RenderState,
        [width, height]: [u32; 2],
    ) -> DrawCall<'c> {
        DrawCall {
            viewport: Viewport::full(width, height),
            state,
            topology: draw.topology,
            vertices: &self.vertices,
            indices: draw.indices(),
        }
    }
}

/// A colour of 0 to 1 as eight bits hold it: NaN is 0, halves go up.
pub(crate) fn clear_color(color: [f32; 4]) -> [u8; 4] {
    color.map(|value| (value.clamp(0.0, 1.0) * 255.0 + 0.5) as u8)
}

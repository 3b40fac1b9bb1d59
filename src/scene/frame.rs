//! A frame that is drawn again and again.

use super::Scene;
use super::prepare::{Output, Pass};
use super::render::{RenderError, Renderer};
use crate::raster::Target;
use glam::Mat4;

/// The picture of a scene with everything that is made once and not for each frame: the textures that render targets became,
/// the constants, the memory of the target.
///
/// [`Self::draw`] is then what a frame costs on the CPU.
pub struct PreparedFrame<'a> {
    renderer: Renderer<'a, 'static>,
    pass: Pass<'a>,
    picture: Target,
}

impl Scene {
    /// Draws the render targets that the picture needs, and gets ready to draw the picture in this size in pixels.
    ///
    /// # Errors
    /// As [`Scene::render`].
    pub fn prepare_frame(&self, size: [u32; 2]) -> Result<PreparedFrame<'_>, RenderError> {
        let [width, height] = size;
        let picture = Target::new(width, height, self.surface.format);
        let picture = picture.map_err(RenderError::Size)?;
        let mut renderer = Renderer::new(self, &|_| ());
        let mut passes = self.passes(size);
        let last = passes.pop();
        for pass in &passes {
            if let Output::Target { target, face } = pass.output {
                renderer.target(pass, target, face)?;
            }
        }
        Ok(PreparedFrame {
            renderer,
            pass: last.unwrap_or(Pass {
                output: Output::Picture,
                size,
                surface: self.surface,
                view: Mat4::IDENTITY,
                projection: Mat4::IDENTITY,
                draws: Vec::new(),
            }),
            picture,
        })
    }
}

impl PreparedFrame<'_> {
    /// Clears the target and draws: vertex shaders, rasterization, pixel shaders.
    ///
    /// # Errors
    /// [`RenderError::Draw`].
    pub fn draw(&mut self) -> Result<(), RenderError> {
        let holds = self.pass.surface.stored();
        let (color, depth, stencil) = (holds.color, holds.depth, holds.stencil);
        self.picture.clear(Some(color), Some(depth), Some(stencil));
        self.renderer.pass(&self.pass, None, &mut self.picture)
    }

    /// What was drawn last.
    pub fn picture(&self) -> &Target {
        &self.picture
    }
}

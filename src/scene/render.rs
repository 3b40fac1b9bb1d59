//! Rendering a scene on the CPU.

use std::fmt;

use image::RgbaImage;

use super::Scene;
use super::prepare::{Output, Pass, PreparedDraw};
use super::rendered::{Rendered, ShadedDraw, ShadedMeshes, clear_color};
use crate::raster::{ColorFormat, DrawError, RegisterPicture, Target, TargetTooLarge, draw};
use crate::texture::TextureError;

/// How a scene is rendered.
#[derive(Clone, Debug, Default)]
pub struct RenderOptions {
    /// Width and height of the picture, instead of those of the scene.
    pub size: Option<[u32; 2]>,
    /// A register to show instead of the colour of one draw.
    pub show: Option<Show>,
}

/// A register of one draw, shown in the picture. The draw then covers what is behind it: it is not blended, fogged or
/// alpha tested. All other draws stay as they are.
#[derive(Clone, Debug)]
pub struct Show {
    /// The draw by name; `None`: the last of the picture.
    pub draw: Option<String>,
    /// The register of its pixel shader, and how it is shown.
    pub picture: RegisterPicture,
}

/// One face of a render target, as a picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TargetPicture {
    /// The target by its number in the scene.
    pub target: usize,
    /// 0, or 0 to 5 in a cube: +X, −X, +Y, −Y, +Z, −Z.
    pub face: usize,
    /// What it holds.
    pub picture: RgbaImage,
}

/// One face of a render target, as it was drawn on the CPU.
pub struct DrawnTarget {
    /// The target by its number in the scene.
    pub target: usize,
    /// 0, or 0 to 5 in a cube: +X, −X, +Y, −Y, +Z, −Z.
    pub face: usize,
    /// Its buffers.
    pub drawn: Target,
}

/// How far the rendering of a scene is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Progress<'a> {
    /// Draws that are done.
    pub done: usize,
    /// Draws in all.
    pub total: usize,
    /// The render target that is drawn into now; `None`: the picture.
    pub target: Option<&'a str>,
    /// The draw that is drawn now.
    pub draw: &'a str,
}

/// Why a scene could not be rendered.
#[derive(Clone, Debug, PartialEq)]
pub enum RenderError {
    /// The picture has a size that is refused.
    Size(TargetTooLarge),
    /// A draw was refused.
    Draw {
        /// Its name.
        draw: String,
        /// Why.
        error: DrawError,
    },
    /// What a render target holds cannot become a texture.
    Texture {
        /// The name of the target.
        target: String,
        /// Why.
        error: TextureError,
    },
    /// The picture has no draw of which a register could be shown.
    NoSuchDraw {
        /// The name that was asked for; `None`: any.
        name: Option<String>,
        /// The draws that the picture has.
        known: Vec<String>,
    },
}

impl fmt::Display for RenderError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Size(error) => error.fmt(f),
            Self::Draw { draw, error } => write!(f, "draw `{draw}`: {error}"),
            Self::Texture { target, error } => write!(f, "render target `{target}`: {error}"),
            Self::NoSuchDraw { name: None, .. } => f.write_str("the picture has no draw to show"),
            Self::NoSuchDraw {
                name: Some(name),
                known,
            } => {
                let known = known.join(", ");
                write!(f, "the picture has no draw `{name}`; it has {known}")
            }
        }
    }
}

impl std::error::Error for RenderError {}

impl Scene {
    /// Renders the picture, and before it the render targets that it needs.
    ///
    /// `progress` is called before each draw.
    ///
    /// # Errors
    /// [`RenderError`] for a size that is refused, and for a draw to show that there is not.
    pub fn render(
        &self,
        options: &RenderOptions,
        progress: &dyn Fn(Progress<'_>),
    ) -> Result<Target, RenderError> {
        Ok(self.rendering(options, progress)?.into_picture())
    }

    /// Renders like [`Self::render`], and keeps with the picture what is needed to ask how a pixel of it came to be.
    ///
    /// # Errors
    /// As [`Self::render`].
    pub fn rendering(
        &self,
        options: &RenderOptions,
        progress: &dyn Fn(Progress<'_>),
    ) -> Result<Rendering<'_>, RenderError> {
        let [width, height] = options.size.unwrap_or(self.size);
        let picture = Target::new(width, height, ColorFormat::A8R8G8B8);
        let mut picture = picture.map_err(RenderError::Size)?;
        let passes = self.passes([width, height]);
        let shown = match &options.show {
            Some(show) => Some((self.shown_draw(show)?, show.picture)),
            None => None,
        };
        let mut renderer = Renderer {
            scene: self,
            rendered: Rendered::new(self),
            done: 0,
            total: passes.iter().map(|pass| pass.draws.len()).sum(),
            progress,
        };
        let mut targets = Vec::new();
        for pass in &passes {
            match pass.output {
                Output::Picture => renderer.pass(pass, shown, &mut picture)?,
                Output::Target { target, face } => {
                    let drawn = renderer.target(pass, target, face)?;
                    targets.push(DrawnTarget {
                        target,
                        face,
                        drawn,
                    });
                }
            }
        }
        Ok(Rendering {
            scene: self,
            picture,
            targets,
            rendered: renderer.rendered,
            shaded: ShadedMeshes::new(&passes),
            passes,
        })
    }

    /// Where in the picture's list the draw stands whose register is shown.
    pub(crate) fn shown_draw(&self, show: &Show) -> Result<usize, RenderError> {
        let name = |number: &usize| self.draws.get(*number).map(|draw| draw.name.as_str());
        let found = match &show.draw {
            Some(wanted) => (self.picture.iter()).rposition(|number| name(number) == Some(wanted)),
            None => self.picture.len().checked_sub(1),
        };
        found.ok_or_else(|| RenderError::NoSuchDraw {
            name: show.draw.clone(),
            known: (self.picture.iter().filter_map(name))
                .map(str::to_owned)
                .collect(),
        })
    }
}

/// A scene that was rendered on the CPU: its picture, and the textures that its render targets became.
pub struct Rendering<'a> {
    scene: &'a Scene,
    picture: Target,
    targets: Vec<DrawnTarget>,
    rendered: Rendered<'a>,
    passes: Vec<Pass<'a>>,
    shaded: ShadedMeshes,
}

impl<'a> Rendering<'a> {
    /// The scene.
    pub fn scene(&self) -> &'a Scene {
        self.scene
    }

    /// The picture.
    pub fn picture(&self) -> &Target {
        &self.picture
    }

    /// The picture alone.
    pub fn into_picture(self) -> Target {
        self.picture
    }

    /// The faces of the render targets, in the order in which they were drawn.
    pub fn targets(&self) -> &[DrawnTarget] {
        &self.targets
    }

    /// The same as pictures, for [`Renderer::frame`](crate::gpu::Renderer::frame).
    pub fn target_pictures(&self) -> Vec<TargetPicture> {
        let picture = |target: &DrawnTarget| TargetPicture {
            target: target.target,
            face: target.face,
            picture: target.drawn.to_image(),
        };
        self.targets.iter().map(picture).collect()
    }

    /// Width and height of the picture in pixels.
    pub fn size(&self) -> [u32; 2] {
        [self.picture.width(), self.picture.height()]
    }

    /// What was drawn, in order: [`Scene::passes`] for the size of the picture, which is the last of them.
    pub fn passes(&self) -> &[Pass<'a>] {
        &self.passes
    }

    /// The pass that drew the picture or a face of a render target; none if nothing of the kind was drawn.
    pub fn pass(&self, output: Output) -> Option<&Pass<'a>> {
        self.passes.iter().find(|pass| pass.output == output)
    }

    /// What was drawn into: colour, depth and stencil of the picture or of a face of a render target.
    pub fn drawn(&self, output: Output) -> Option<&Target> {
        match output {
            Output::Picture => Some(&self.picture),
            Output::Target { target, face } => (self.targets.iter())
                .find(|drawn| (drawn.target, drawn.face) == (target, face))
                .map(|drawn| &drawn.drawn),
        }
    }

    /// A draw of a pass with its vertices and with what its pixel shader runs with; none if there is no such draw.
    ///
    /// The vertex shader runs when a draw is asked for the first time. What it leaves is kept, up to 2²⁰ vertices in all.
    pub fn shaded(&self, output: Output, draw: usize) -> Option<ShadedDraw<'_>> {
        let pass = self.passes.iter().position(|pass| pass.output == output)?;
        let prepared = self.passes.get(pass)?.draws.get(draw)?;
        let vertices = self.shaded.get(pass, draw, prepared);
        Some(self.rendered.with_vertices(prepared, vertices))
    }
}

struct Renderer<'a, 'p> {
    scene: &'a Scene,
    rendered: Rendered<'a>,
    done: usize,
    total: usize,
    progress: &'p dyn Fn(Progress<'_>),
}

impl Renderer<'_, '_> {
    /// Renders a face of a target; with the last one it becomes a texture.
    fn target(
        &mut self,
        pass: &Pass<'_>,
        number: usize,
        face: usize,
    ) -> Result<Target, RenderError> {
        let [width, height] = pass.size;
        let target = Target::new(width, height, ColorFormat::A8R8G8B8);
        let mut target = target.map_err(RenderError::Size)?;
        self.pass(pass, None, &mut target)?;
        self.rendered.take_face(number, face, &target.to_image())?;
        Ok(target)
    }

    fn pass(
        &mut self,
        pass: &Pass<'_>,
        shown: Option<(usize, RegisterPicture)>,
        target: &mut Target,
    ) -> Result<(), RenderError> {
        target.clear(Some(clear_color(pass.clear)), Some(1.0), Some(0));
        for (place, prepared) in pass.draws.iter().enumerate() {
            let picture = shown
                .filter(|(at, _)| *at == place)
                .map(|(_, picture)| picture);
            (self.progress)(Progress {
                done: self.done,
                total: self.total,
                target: match pass.output {
                    Output::Picture => None,
                    Output::Target { target, .. } => self
                        .scene
                        .targets
                        .get(target)
                        .map(|target| target.name.as_str()),
                },
                draw: prepared.name,
            });
            self.draw(prepared, picture, target)?;
            self.done += 1;
        }
        Ok(())
    }

    fn draw(
        &self,
        prepared: &PreparedDraw<'_>,
        picture: Option<RegisterPicture>,
        target: &mut Target,
    ) -> Result<(), RenderError> {
        let shaded = self.rendered.shade(prepared);
        let mut state = prepared.state.clone();
        if picture.is_some() {
            state.blend.enable = false;
            state.fog.enable = false;
            state.alpha_test.enable = false;
        }
        let call = shaded.call(&state, [target.width(), target.height()]);
        let drawn = draw(target, &call, &shaded.program(picture));
        drawn.map(|_| ()).map_err(|error| RenderError::Draw {
            draw: prepared.name.to_owned(),
            error,
        })
    }
}

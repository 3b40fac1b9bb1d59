//! Rendering a scene on the CPU.

use std::fmt;

use image::RgbaImage;

use super::Scene;
use super::prepare::{Output, Pass, PreparedDraw};
use super::rendered::{Rendered, clear_color};
use crate::exec::{Environment, Stage};
use crate::raster::{
    ColorFormat, DrawCall, DrawError, PixelProgram, RegisterPicture, Target, TargetTooLarge,
    Viewport, draw, shade_vertices,
};
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

/// One face of a render target, as it was drawn.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TargetPicture {
    /// The target by its number in the scene.
    pub target: usize,
    /// 0, or 0 to 5 in a cube: +X, −X, +Y, −Y, +Z, −Z.
    pub face: usize,
    /// What it holds.
    pub picture: RgbaImage,
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
        self.render_all(options, progress)
            .map(|(picture, _)| picture)
    }

    /// [`Scene::render`], and what the render targets held, in the order in which they were drawn.
    ///
    /// # Errors
    /// As for [`Scene::render`].
    pub fn render_all(
        &self,
        options: &RenderOptions,
        progress: &dyn Fn(Progress<'_>),
    ) -> Result<(Target, Vec<TargetPicture>), RenderError> {
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
                    let picture = renderer.target(pass, target, face)?;
                    targets.push(TargetPicture {
                        target,
                        face,
                        picture,
                    });
                }
            }
        }
        Ok((picture, targets))
    }

    /// Where in the picture's list the draw stands whose register is shown.
    fn shown_draw(&self, show: &Show) -> Result<usize, RenderError> {
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

struct Renderer<'a> {
    scene: &'a Scene,
    rendered: Rendered<'a>,
    done: usize,
    total: usize,
    progress: &'a dyn Fn(Progress<'_>),
}

impl Renderer<'_> {
    /// Renders a face of a target; with the last one it becomes a texture.
    fn target(
        &mut self,
        pass: &Pass<'_>,
        number: usize,
        face: usize,
    ) -> Result<RgbaImage, RenderError> {
        let [width, height] = pass.size;
        let target = Target::new(width, height, ColorFormat::A8R8G8B8);
        let mut target = target.map_err(RenderError::Size)?;
        self.pass(pass, None, &mut target)?;
        let picture = target.to_image();
        self.rendered.take_face(number, face, &picture)?;
        Ok(picture)
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
        let for_vertices = Environment {
            constants: prepared.vertex_constants.clone(),
            ..Environment::default()
        };
        let count = prepared.mesh.vertex_count();
        let vertices = shade_vertices(
            &prepared.vertex.kernel,
            &for_vertices,
            count,
            |vertex, register| prepared.input(vertex, register),
        );
        let for_pixels = Environment {
            constants: prepared.pixel_constants.clone(),
            stages: std::array::from_fn(|i| {
                let stage = &prepared.stages[i];
                Stage {
                    texture: stage
                        .texture
                        .and_then(|number| self.rendered.texture(number)),
                    sampler: stage.sampler,
                    bump: stage.bump,
                }
            }),
        };
        let mut state = prepared.state.clone();
        if picture.is_some() {
            state.blend.enable = false;
            state.fog.enable = false;
            state.alpha_test.enable = false;
        }
        let call = DrawCall {
            viewport: Viewport::full(target.width(), target.height()),
            state: &state,
            topology: prepared.topology,
            vertices: &vertices,
            indices: prepared.indices(),
        };
        let shader = PixelProgram {
            kernel: &prepared.pixel.kernel,
            environment: &for_pixels,
            picture,
        };
        let drawn = draw(target, &call, &shader);
        drawn.map(|_| ()).map_err(|error| RenderError::Draw {
            draw: prepared.name.to_owned(),
            error,
        })
    }
}

//! Scenes: TOML files that say what is drawn with which listings, and their rendering.
//!
//! The format is described in `docs/scene.md`. [`Scene::load`] reads a scene file, and through a [`Resolver`] the files
//! that it names, into meshes, textures and kernels; every problem is reported at once, each with its place.
//! [`Scene::passes`] gives what there is to draw as plain data, for any back end; [`Scene::render`] draws it on the CPU.
//!
//! Files, in the order of the data: `section` and `error` (tables key by key, problems with their places), `resolve` and
//! `files` (bytes), `load` (the whole), `transform`, `mesh`, `texture`, `shader`, `constants`, `state`, `draw`, `target`
//! (its parts), `prepare` (passes), `render`, `rendered` (render targets as textures), `frame` (drawn again and again), `levels` (what other mip levels would make of it), `history` (of a pixel), `show` (which registers to picture); `generate` makes pictures by formula.

mod constants;
pub(crate) mod draw;
pub(crate) mod error;
pub(crate) mod files;
mod frame;
pub mod generate;
mod history;
pub(crate) mod include;
mod levels;
pub(crate) mod load;
mod mesh;
mod prepare;
mod render;
mod rendered;
mod resolve;
pub(crate) mod section;
pub(crate) mod shader;
mod show;
pub(crate) mod state;
mod target;
pub(crate) mod texture;
mod transform;

#[cfg(test)]
mod tests;

use glam::Vec3;

use crate::diagnostic::{Diagnostic, SourceMap};
use crate::policy::{Dialect, Model, Policies};
use crate::texture::Texture;

pub use draw::Declaration;
pub use error::{SceneError, rules};
pub use files::{MAX_SCENE_VERTICES, MAX_TEXELS};
pub use frame::PreparedFrame;
pub use history::{MAX_EVENTS, PixelEvent, PixelHistory};
pub use include::MAX_INCLUDES;
pub use levels::LevelRange;
pub use load::{MAX_DRAWS, MAX_ENTRIES};
pub use prepare::{Output, Pass, PreparedDraw, PreparedStage};
pub use render::{
    DrawnTarget, Progress, RenderError, RenderOptions, Rendering, Show, TargetPicture,
};
#[cfg(feature = "gpu")]
pub(crate) use rendered::Rendered;
pub use rendered::ShadedDraw;
pub use resolve::{DirectoryResolver, MAX_FILE_BYTES, Resolver};
pub use shader::Shader;
pub use show::{ShowExpression, WrongShow};
pub use target::MAX_TARGET_SIDE;

/// How a scene file is read.
#[derive(Clone, Copy, Debug, Default)]
pub struct LoadOptions {
    /// By whose rules the listings are judged.
    pub dialect: Dialect,
    /// The numbers that the pixel shaders compute with, and how the textures of the time were read.
    pub model: Model,
    /// What instructions do where documents and hardware did not agree.
    pub policies: Policies,
}

/// A scene, ready to be rendered: nothing of it lies in files any more.
#[derive(Clone, Debug)]
pub struct Scene {
    size: [u32; 2],
    surface: crate::raster::Surface,
    time: f32,
    light_direction: Vec3,
    camera: transform::Camera,
    meshes: Vec<crate::mesh::Mesh>,
    textures: Vec<TextureEntry>,
    targets: Vec<target::Target>,
    /// The targets by number, each after those that it reads.
    order: Vec<usize>,
    draws: Vec<draw::Draw>,
    /// The draws of the picture by number, in order.
    picture: Vec<usize>,
    sources: SourceMap,
    warnings: Vec<Diagnostic>,
}

/// A texture of a scene.
#[derive(Clone, Debug)]
pub struct TextureEntry {
    /// Its name in the scene file.
    pub name: String,
    /// Its texels, or where they come from.
    pub source: TextureSource,
}

/// Where the texels of a texture come from.
#[derive(Clone, Debug)]
pub enum TextureSource {
    /// They are here.
    Loaded(Texture),
    /// They are what the passes of this render target draw.
    Target(usize),
    /// They are the diffuse cube map ([`Texture::irradiance`]) of what the passes of this render target draw.
    Irradiance {
        /// The target.
        target: usize,
        /// The edge of the map's faces in texels.
        edge: u32,
    },
}

impl Scene {
    /// Width and height of the picture that the scene file asks for, in pixels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Turns the camera of the picture by so many degrees from where the scene file has it: around the vertical line, that of
    /// +Y, through the point that it looks at, clockwise as seen from above. The cameras of render targets stay.
    pub fn turn_camera(&mut self, degrees: f32) {
        self.camera.turn(degrees);
    }

    /// The textures, by the numbers that [`PreparedStage::texture`] holds.
    pub fn textures(&self) -> &[TextureEntry] {
        &self.textures
    }

    /// How many faces a render target has and whether mip levels are made of what was drawn: `None` if there is no such
    /// target.
    pub fn target(&self, number: usize) -> Option<TargetInfo<'_>> {
        self.targets.get(number).map(|target| TargetInfo {
            name: &target.name,
            size: target.size,
            faces: target.faces(),
            mipmaps: target.mipmaps,
        })
    }

    /// The scene file and the listings, for the places of [`Self::warnings`] and of programs.
    pub fn sources(&self) -> &SourceMap {
        &self.sources
    }

    /// What is allowed and yet worth telling, of the scene file and of its listings.
    pub fn warnings(&self) -> &[Diagnostic] {
        &self.warnings
    }
}

/// A render target, as a back end must make it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TargetInfo<'a> {
    /// Its name in the scene file.
    pub name: &'a str,
    /// Width and height of a face in pixels.
    pub size: [u32; 2],
    /// 1, or 6 for a cube.
    pub faces: usize,
    /// Whether mip levels are made of what was drawn.
    pub mipmaps: bool,
}

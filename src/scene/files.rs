//! The files that a scene names, read once, and what all of them together may take.

use std::collections::HashMap;
use std::sync::Arc;

use super::LoadOptions;
use super::error::{Problems, rules};
use super::resolve::Resolver;
use super::section::At;
use crate::diagnostic::{SourceMap, Span};
use crate::kernel;
use crate::mesh::Mesh;
use crate::program::Program;
use crate::texture::{Signed, Texture, Weights};

/// Most texels that the textures and render targets of a scene may have together, mip levels not counted (2²⁷).
pub const MAX_TEXELS: u64 = 1 << 27;

/// Most vertices that the meshes of a scene may have together (2²³).
pub const MAX_SCENE_VERTICES: usize = 1 << 23;

/// What reading a scene draws on.
pub(crate) struct Files<'r> {
    pub(crate) resolver: &'r dyn Resolver,
    pub(crate) options: LoadOptions,
    pub(crate) sources: SourceMap,
    /// Listings by the path that the scene file writes; `None` for those that cannot be used.
    pub(crate) programs: HashMap<String, Option<Arc<Program>>>,
    texels: u64,
    vertices: usize,
}

impl<'r> Files<'r> {
    pub(crate) fn new(resolver: &'r dyn Resolver, options: &LoadOptions) -> Self {
        Self {
            resolver,
            options: *options,
            sources: SourceMap::new(),
            programs: HashMap::new(),
            texels: 0,
            vertices: 0,
        }
    }

    /// What the file is loaded with, for files that choose for themselves.
    pub(crate) fn options_mut(&mut self) -> &mut LoadOptions {
        &mut self.options
    }

    /// What shaders are lowered with, whatever their texture stages are.
    pub(crate) fn lowering(&self) -> kernel::Options {
        kernel::Options {
            model: self.options.model,
            policies: self.options.policies,
            ..kernel::Options::default()
        }
    }

    /// What the codes of signed textures stand for under the model.
    pub(crate) fn signed(&self) -> Signed {
        match self.options.model.has_lopsided_texels() {
            true => Signed::Lopsided,
            false => Signed::Symmetric,
        }
    }

    /// How exact the filters of textures are under the model.
    pub(crate) fn weights(&self) -> Weights {
        match self.options.model.has_coarse_filters() {
            true => Weights::EightBits,
            false => Weights::Full,
        }
    }

    /// The bytes of a file.
    pub(crate) fn read(&self, path: &At<String>, problems: &mut Problems) -> Option<Vec<u8>> {
        match self.resolver.read(&path.value) {
            Ok(bytes) => Some(bytes),
            Err(error) => {
                let name = self.resolver.display_name(&path.value);
                let message = format!("`{name}` cannot be read: {error}");
                problems.error(&rules::FILE, path.span, message);
                None
            }
        }
    }

    /// Counts texels towards [`MAX_TEXELS`]; false, and a problem, beyond it.
    pub(crate) fn take_texels(&mut self, count: u64, span: Span, problems: &mut Problems) -> bool {
        self.texels = self.texels.saturating_add(count);
        if self.texels <= MAX_TEXELS {
            return true;
        }
        let message = format!("with this one the textures have more than {MAX_TEXELS} texels");
        problems.error(&rules::LIMIT, span, message);
        false
    }

    /// Counts a texture.
    pub(crate) fn take_texture(
        &mut self,
        texture: &Texture,
        span: Span,
        problems: &mut Problems,
    ) -> bool {
        let a_face: u64 = texture.size().into_iter().map(u64::from).product();
        self.take_texels(a_face * texture.face_count() as u64, span, problems)
    }

    /// Counts a mesh towards [`MAX_SCENE_VERTICES`]; false, and a problem, beyond it.
    pub(crate) fn take_mesh(&mut self, mesh: &Mesh, span: Span, problems: &mut Problems) -> bool {
        self.vertices = self.vertices.saturating_add(mesh.vertex_count());
        if self.vertices <= MAX_SCENE_VERTICES {
            return true;
        }
        let message =
            format!("with this one the meshes have more than {MAX_SCENE_VERTICES} vertices");
        problems.error(&rules::LIMIT, span, message);
        false
    }
}

/// The part of a path behind its last dot.
pub(crate) fn extension(path: &str) -> Option<&str> {
    path.rsplit(['/', '\\'])
        .next()?
        .rsplit_once('.')
        .map(|(_, extension)| extension)
}

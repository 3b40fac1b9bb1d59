//! What is baked into a translation, beside the shaders.

use crate::exec::STAGES;
use crate::raster::{Compare, FogDistance, FogMode};
use crate::texture::{AddressMode, Filter, TextureKind};

/// What a translation is made for. The default is Direct3D 8's default state with a 2D texture in every stage.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// The texture stages.
    pub stages: [StageOptions; STAGES],
    /// Fog, mixed in behind the pixel shader; `None` where it is off.
    pub fog: Option<Fog>,
    /// The alpha test; `None` where it is off. The reference is a field of the uniform block.
    pub alpha_test: Option<Compare>,
    /// Whether constants that a shader defines itself may be set from outside: then they are taken from the uniform
    /// block, where the caller puts what [`crate::exec::bind_constants`] returns.
    pub overridable_definitions: bool,
    /// Whether positions are moved by half a pixel, so that pixel centres lie where Direct3D 8 has them.
    pub half_pixel: bool,
    /// `D3DSHADE_FLAT`: the two colours come from the first vertex of a triangle.
    pub flat_shading: bool,
    /// What is drawn.
    pub points: Points,
    /// How many user clip planes are on, 0 to 6. What lies behind one is discarded pixel by pixel.
    pub clip_planes: u8,
    /// Whether dot products are written out as products and sums, so that their order is that of the specification;
    /// else they are the `dot` of WGSL, which leaves the order open.
    pub exact_dots: bool,
    /// Whether level 0 of a texture is read whatever its coordinates do from pixel to pixel: exact for textures of one
    /// level. Such a translation may sample where WGSL allows no derivatives: in branches, and beyond fragment shaders.
    pub level_zero: bool,
    /// Name of the vertex entry point.
    pub vertex_entry: String,
    /// Name of the pixel entry point.
    pub pixel_entry: String,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            stages: [StageOptions::default(); STAGES],
            fog: None,
            alpha_test: None,
            overridable_definitions: false,
            half_pixel: true,
            flat_shading: false,
            points: Points::None,
            clip_planes: 0,
            exact_dots: false,
            level_zero: false,
            vertex_entry: "vs_main".into(),
            pixel_entry: "ps_main".into(),
        }
    }
}

/// One texture stage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StageOptions {
    /// The shape of the texture that is bound; a stage without one samples opaque black.
    pub texture: Option<TextureKind>,
    /// Whether filters on a cube reach across its edges. Direct3D 8 parts stayed inside the face: without it a cube
    /// is bound as an array of six 2D layers with a sampler that clamps.
    pub seamless: bool,
    /// Address modes of u, v and w. `border` and `mirror_once` have no sampler in WebGPU and become shader code on
    /// top of one that clamps; the others are the sampler's business.
    pub address: [AddressMode; 3],
    /// How texels are combined: what a border looks like depends on it.
    pub filter: Filter,
    /// Whether `D3DTSS_MIPMAPLODBIAS` is a field of the uniform block; else it is 0.
    pub lod_bias: bool,
    /// Whether texels may lie outside of −1…1.
    pub wide_texels: bool,
}

impl Default for StageOptions {
    fn default() -> Self {
        Self {
            texture: Some(TextureKind::Texture2D),
            seamless: false,
            address: [AddressMode::Wrap; 3],
            filter: Filter::Linear,
            lod_bias: false,
            wide_texels: false,
        }
    }
}

impl StageOptions {
    /// A stage with this texture, everything else as in the default.
    pub fn with_texture(texture: Option<TextureKind>) -> Self {
        Self {
            texture,
            ..Self::default()
        }
    }

    /// Whether the texture is a cube of six separate faces.
    pub(super) fn separate_faces(&self) -> bool {
        self.texture == Some(TextureKind::Cube) && !self.seamless
    }

    /// How many components of the coordinates a sample takes.
    pub(super) fn coordinates(&self) -> usize {
        match self.texture {
            None => 0,
            Some(TextureKind::Texture2D) => 2,
            Some(TextureKind::Cube | TextureKind::Volume) => 3,
        }
    }
}

/// Fog as far as it is baked in. Colour, range and density are fields of the uniform block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fog {
    /// [`FogMode::None`]: the vertices say how much (`oFog`); else the distance does.
    pub table: FogMode,
    /// The distance of table fog.
    pub distance: FogDistance,
}

/// Whether triangles or points are drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Points {
    /// No points: `oPts` has no effect.
    #[default]
    None,
    /// Points, each drawn as a strip of two triangles: the vertex buffers step per instance, and every instance has
    /// four vertices.
    Quads,
    /// The same with `D3DRS_POINTSPRITEENABLE`: every coordinate set is (u, v, 0, 0), 0 to 1 across the point.
    Sprites,
}

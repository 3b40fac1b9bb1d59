//! What is baked into a translation, beside the shaders.

use crate::exec::STAGES;
use crate::isa::ShaderKind;
use crate::kernel::Slot;
use crate::raster::{Compare, FogDistance, FogMode, RenderState, ShadeMode};
use crate::texture::{AddressMode, Filter, MipFilter, TextureKind, Weights};

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
    /// Whether the depths of the viewport and the bias are not those of the default: then the depth that goes to the target
    /// is worked out in the pixel stage, from a field of the uniform block, and the viewport of WebGPU keeps the depths 0 to 1.
    /// A depth that the shader itself sets stays.
    pub mapped_depth: bool,
    /// `D3DSHADE_FLAT`: the two colours come from the first vertex of a triangle.
    pub flat_shading: bool,
    /// What is drawn.
    pub points: Points,
    /// How many user clip planes are on, 0 to 6. What lies behind one is discarded pixel by pixel.
    pub clip_planes: u8,
    /// Whether dot products are written out as products and sums, so that their order is that of the specification;
    /// else they are the `dot` of WGSL, which leaves the order open.
    pub exact_dots: bool,
    /// Whether vertex data, texture coordinates, vertex constants and stage states may be infinite, NaN or beyond
    /// [`Self::TAME`]: then more products are guarded by the rule that 0 times anything is 0.
    pub wild_inputs: bool,
    /// The registers that are looked at from outside: the stages become functions for an entry point that looks.
    pub observed: Option<Observed>,
    /// A register of the pixel shader that is returned in place of the colour. Neither fog nor the alpha test touch it.
    pub show: Option<Shown>,
    /// Whether level 0 of a texture is read whatever its coordinates do from pixel to pixel: exact for textures of one
    /// level. Such a translation may sample where WGSL allows no derivatives: in branches, and beyond fragment shaders.
    pub level_zero: bool,
    /// Name of the vertex entry point.
    pub vertex_entry: String,
    /// Name of the pixel entry point.
    pub pixel_entry: String,
}

impl Options {
    /// The largest magnitude of what comes from outside, unless [`Self::wild_inputs`] says otherwise.
    pub const TAME: f32 = 65536.0;

    /// These options with what of the render states is baked in.
    #[must_use]
    pub fn with_state(self, state: &RenderState) -> Self {
        let fog = &state.fog;
        let wild = |number: f32| !number.is_finite();
        Self {
            wild_inputs: self.wild_inputs
                || (fog.enable && [fog.start, fog.end, fog.density].into_iter().any(wild)),
            fog: state.fog.enable.then_some(Fog {
                table: state.fog.table,
                distance: state.fog.distance,
            }),
            mapped_depth: state.depth_mapping() != [1.0, 0.0],
            alpha_test: state.alpha_test.enable.then_some(state.alpha_test.func),
            flat_shading: state.shade == ShadeMode::Flat,
            clip_planes: state.clip_planes.iter().flatten().count() as u8,
            ..self
        }
    }
}

impl Default for Options {
    fn default() -> Self {
        Self {
            stages: [StageOptions::default(); STAGES],
            fog: None,
            alpha_test: None,
            overridable_definitions: false,
            half_pixel: true,
            mapped_depth: false,
            flat_shading: false,
            points: Points::None,
            clip_planes: 0,
            exact_dots: false,
            wild_inputs: false,
            observed: None,
            show: None,
            level_zero: false,
            vertex_entry: "vs_main".into(),
            pixel_entry: "ps_main".into(),
        }
    }
}

/// A register of a pixel shader as it is after some instructions: all four components, 0 where nothing has written them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shown {
    /// The register.
    pub slot: Slot,
    /// How many instructions run before it is looked at; `usize::MAX`: all.
    pub instructions: usize,
    /// Which of the pixels come through that are covered.
    pub pixels: ShownPixels,
}

/// Which pixels show a register.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShownPixels {
    /// All: the shader ends after the instructions, and a `texkill` among them has no effect.
    All,
    /// Those that the whole shader keeps. Where it replaces the depth, the depth is that of the whole shader.
    Kept,
    /// The others: those that `texkill` discards.
    Discarded,
}

/// Registers that are looked at from outside, as they are at the end of their shader.
///
/// A translation with them has no entry points: functions with the same names, parameters and results take their
/// place, of the same lines. Each leaves its registers in a module variable ([`Self::VERTEX`], [`Self::PIXEL`]), an array
/// of `vec4f` in this order, which only exists if there are any. Pixels are not discarded where the module variable `keep` is true, which only exists if the
/// pixel shader may discard any.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Observed {
    /// Registers of the vertex shader.
    pub vertex: Vec<Slot>,
    /// Registers of the pixel shader.
    pub pixel: Vec<Slot>,
}

impl Observed {
    /// The module variable with the registers of the vertex shader.
    pub const VERTEX: &'static str = "observed_vs";
    /// That with the registers of the pixel shader.
    pub const PIXEL: &'static str = "observed_ps";

    /// Those of one kind of shader.
    pub(super) fn of(&self, kind: ShaderKind) -> &[Slot] {
        match kind {
            ShaderKind::Vertex => &self.vertex,
            ShaderKind::Pixel => &self.pixel,
        }
    }

    /// The name of the variable that they are left in.
    pub(super) fn variable(kind: ShaderKind) -> &'static str {
        match kind {
            ShaderKind::Vertex => Self::VERTEX,
            ShaderKind::Pixel => Self::PIXEL,
        }
    }
}

/// One texture stage.
///
/// A sampler of WebGPU reads the texture where it can do what Direct3D 8 does; then address modes, filters and levels are
/// its own business, and nothing of them is baked in. Else there is no sampler, and the shader puts samples together itself,
/// texel by texel: for `border` and `mirror_once`, for `mirror` under a point filter, for weights of 8 bits, for anisotropic filters, where λ is to tell
/// magnified from minified before the largest level limits it, and where a bias may put λ in the middle between two levels,
/// which is to go to the smaller one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StageOptions {
    /// The shape of the texture that is bound; a stage without one samples opaque black.
    pub texture: Option<TextureKind>,
    /// Whether filters on a cube reach across its edges. Direct3D 8 parts stayed inside the face: without it a cube
    /// is bound as an array of six 2D layers with a sampler that clamps.
    pub seamless: bool,
    /// Address modes of u, v and w.
    pub address: [AddressMode; 3],
    /// The filter where the texture is magnified.
    pub mag: Filter,
    /// The filter where it is minified.
    pub min: Filter,
    /// How levels are chosen.
    pub mip: MipFilter,
    /// `D3DTSS_MAXMIPLEVEL`. Of a stage without a sampler the uniform block has the number.
    pub max_mip_level: u32,
    /// `D3DTSS_MAXANISOTROPY`, 1 to 16.
    pub max_anisotropy: u32,
    /// Whether `D3DTSS_MIPMAPLODBIAS` is a field of the uniform block; else it is 0.
    pub lod_bias: bool,
    /// Whether texels may lie outside of −1…1.
    pub wide_texels: bool,
    /// Whether all channels are bytes from 0 to 1 ([`crate::texture::Format::is_packed`]): where samples are put together
    /// texel by texel, filters then compute with whole numbers.
    pub byte_texels: bool,
    /// How exact the weights of linear filters are.
    pub weights: Weights,
}

impl Default for StageOptions {
    fn default() -> Self {
        Self {
            texture: Some(TextureKind::Texture2D),
            seamless: false,
            address: [AddressMode::Wrap; 3],
            mag: Filter::Linear,
            min: Filter::Linear,
            mip: MipFilter::None,
            max_mip_level: 0,
            max_anisotropy: 1,
            lod_bias: false,
            wide_texels: false,
            byte_texels: false,
            weights: Weights::Full,
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

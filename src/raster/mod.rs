//! What surrounds the shaders in Direct3D 8: clipping, viewport, culling, coverage, interpolation, depth and stencil,
//! alpha test, fog, blending.
//!
//! [`draw`] takes vertices as the vertex shader left them and a [`PixelShader`], of which it only knows what it reads and
//! what it may do. How either is executed is none of its business. [`cover`] answers for one pixel which primitives reach
//! it and with which inputs, by the same set-up and interpolation; [`LoneTarget`] draws them again, and its [`MergeRecord`]s
//! tell stage by stage what the merger did. [`BatchProgram`] and [`shade_vertices`] put kernels in the places of both,
//! [`PictureProgram`] one whose registers are pictured.
//!
//! Files, in the order of the data: `vertices`, `screen` (where these are on it), `assemble` (vertices to primitives), `clip`,
//! `setup` and `points_lines` (primitives to what has edges and planes on the screen), `bins` (which tiles), `scan` (which
//! pixels), `interpolate` (pixel inputs), `tiles` (the loop over all of it), `merger` (into the target) with `plain` (its short ways) and its `record`, `cover`, `replay`; `picture` (numbers to colours), `capture`.

mod assemble;
mod bins;
mod capture;
mod clip;
mod cover;
mod interpolate;
mod merger;
mod names;
mod picture;
mod pixel;
mod plain;
mod points_lines;
mod programmable;
mod record;
mod replay;
mod scan;
mod screen;
mod setup;
mod state;
mod target;
#[cfg(test)]
mod tests;
mod tiles;
mod vertices;

use glam::Vec4;

// A value taken into 0 to 1; NaN is 0.
use crate::semantics::saturate as unit;

pub use assemble::{DrawError, Topology};
pub use capture::PictureProgram;
pub use cover::{Fragment, Interpolation, ScreenPosition, cover};
pub use names::UnknownName;
pub use picture::{Look, Mark, MarkSet, RegisterPicture, Tone, View};
pub use pixel::{Attribute, LANES, PixelBatch, PixelInputs, PixelResult, PixelShader};
pub use programmable::{BatchProgram, PixelProgram, PixelTrace, shade_vertices, vertex_outputs};
pub use record::{
    AlphaTested, BlendWeight, Blended, ColorWritten, DepthTested, Fate, FogSource, Fogged,
    MergeRecord, StencilTested, Stored,
};
pub use replay::{LonePixel, LoneTarget, Merged, merge_lone};
pub use state::{
    AlphaTest, BlendFactor, BlendOp, BlendState, ColorMask, Compare, CullMode, DepthState,
    FillMode, FogDistance, FogMode, FogState, PointState, RenderState, ShadeMode, StencilOp,
    StencilState, Viewport, ViewportState,
};
pub use target::{ColorFormat, Surface, Target, TargetTooLarge, TooManyPlanes};
pub use tiles::{Statistics, draw};
pub use vertices::Vertices;

/// How many texture coordinate sets there are.
const SETS: usize = 8;

/// One vertex as the vertex shader left it. Colours and fog are taken into 0 to 1 here, not by the shader.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vertex {
    /// `oPos`, in clip space: what has -w ≤ x ≤ w, -w ≤ y ≤ w and 0 ≤ z ≤ w is seen.
    pub position: Vec4,
    /// `oD0`.
    pub diffuse: Vec4,
    /// `oD1`.
    pub specular: Vec4,
    /// `oT0` to `oT7`.
    pub texcoords: [Vec4; 8],
    /// `oFog`: 1 is clear, 0 is full fog.
    pub fog: f32,
    /// `oPts`, in pixels, if the shader wrote it.
    pub point_size: Option<f32>,
}

impl Default for Vertex {
    /// What the outputs hold that a vertex shader does not write: diffuse 1, everything else 0, no point size.
    fn default() -> Self {
        Self {
            position: Vec4::ZERO,
            diffuse: Vec4::ONE,
            specular: Vec4::ZERO,
            texcoords: [Vec4::ZERO; 8],
            fog: 0.0,
            point_size: None,
        }
    }
}

/// What one draw call draws, apart from the shader and the target.
#[derive(Debug, Clone, Copy)]
pub struct DrawCall<'a> {
    /// Where on the target clip space goes. Nothing is drawn outside of it.
    pub viewport: Viewport,
    /// The render states.
    pub state: &'a RenderState,
    /// How vertices make up primitives.
    pub topology: Topology,
    /// The vertices.
    pub vertices: &'a Vertices,
    /// Which vertices, in which order; `None`: all, as they come.
    pub indices: Option<&'a [u32]>,
}

/// A fog factor taken into 0 to 1; NaN is 1, which is clear.
#[inline]
pub(crate) fn fog_unit(value: f32) -> f32 {
    if value < 1.0 { unit(value) } else { 1.0 }
}

//! Scenes on the GPU, through `wgpu`, and the parts of that which an engine needs to draw with an old shader pair itself.
//!
//! [`adapters`] lists what there is to draw with, [`Device::open`] opens one, and a [`Renderer`] draws a
//! [`Scene`](crate::scene::Scene) with it into a picture; no window is needed. The WGSL is that of
//! [`crate::wgsl::translate`].
//!
//! # In an engine of one's own
//!
//! [`translate`](crate::wgsl::translate) gives the WGSL and a [`Reflection`](crate::wgsl::Reflection). From the reflection
//! follow the bind group layouts ([`bind_group_layouts`]), the vertex buffers ([`VertexLayout`], of a Direct3D 8 declaration)
//! and the content of the uniform blocks ([`Uniforms::block`]); from the render states the rest of the pipeline
//! ([`fixed_state`]). A scene's textures, with what its render targets hold, come from [`Renderer::textures`]. The example in
//! `examples/window` is such an engine.
//!
//! # What is not the same as on the CPU
//!
//! - The coverage of triangle edges and the level of detail ([`LEVEL_ERROR`]) are the device's own, within what WebGPU allows.
//! - Which pixels a line covers, and those of a wireframe, is up to the device.
//! - Floats are filtered as 16-bit ones where the device cannot filter 32-bit ones ([`AdapterInfo::float_filtering`]).
//! - A mip filter together with different `min` and `mag` filters decides between these behind `D3DTSS_MAXMIPLEVEL`.
//!
//! Files, in the order of the data: `error`, `device` (adapters), `state`, `vertex`, `uniform`, `texture` (what a draw
//! consists of), `pipeline`, `buffers`, `picture`, `ready`, `renderer`, `prepared` (a frame again and again); `differences` compares pictures,
//! `shown` makes pictures of registers, `registers` and `parting` look into one pixel, `invocations` runs shaders for single invocations, for tests, by way
//! of the entry points of `harness`, `programs` many shaders in one pipeline.

mod buffers;
mod device;
mod differences;
mod error;
mod harness;
mod invocations;
mod parting;
mod picture;
mod pipeline;
mod prepared;
mod programs;
mod ready;
mod registers;
mod renderer;
mod shown;
mod state;
mod texture;
mod uniform;
mod vertex;

pub use device::{AdapterInfo, Device, adapters};
pub use differences::{Differences, LEVEL_ERROR, WorstPixel};
pub use error::GpuError;
pub use invocations::{InvocationInputs, Invocations, Seen, Shading};
pub use parting::{
    FragmentComparison, LineComparison, MOST_FRAGMENTS, Pair, Parting, PixelComparison,
    SampledTexture, compare_pixel,
};
pub use pipeline::bind_group_layouts;
pub use prepared::PreparedFrame;
pub use programs::{Batch, Program, Results};
pub use registers::PixelRegisters;
pub use renderer::{Frame, Renderer};
pub use state::{FixedState, fixed_state};
pub use texture::stage_options;
pub use uniform::{StageUniforms, Uniforms};
pub use vertex::{Stream, VertexLayout, primitive_indices};
/// The version of `wgpu` that this crate draws with.
pub use wgpu;

//! Textures of Direct3D 8: formats, mip levels, 2D, cube and volume sampling.
//!
//! A [`Texture`] holds decoded texels, a [`Sampler`] the texture stage states that decide how they are read.
//! [`sample_quads`] reads many lanes at once (2×2 pixel quads, which give the level of detail), [`sample_at`] one
//! coordinate at a given level, and [`footprint`] tells which texels such a sample is made of.
//! The room knows nothing of shaders and opens no file: [`load`] takes bytes.

mod cube;
mod error;
mod format;
mod irradiance;
pub mod load;
mod mips;
mod sample;
mod sampler;
mod storage;

pub use cube::{CUBE_FACES, FaceAxes, SignedAxis, direction_to_face, face_to_direction};
pub use error::TextureError;
pub use format::{Format, Signed, words_to_bytes};
pub use irradiance::MAX_IRRADIANCE_EDGE;
pub use sample::{Detail, Footprint, Tap, details, footprint, sample_at, sample_quads};
pub use sample::{Memory, Places, Sample, share_places};
pub(crate) use sample::{RATIO_SLACK, UNBOUND};
pub use sampler::{AddressMode, Filter, MipFilter, Sampler, UnknownName, Weights};
pub use storage::{MAX_BYTES, MAX_EDGE, Texture, TextureKind};

//! Runs, translates and step-debugs the shader assembly of Direct3D 8.
//!
//! See `ARCHITECTURE.md` for the rooms and which may know of which.

#[cfg(feature = "scene")]
pub mod case;
pub mod diagnostic;
pub mod exec;
pub mod isa;
pub mod kernel;
pub mod listing;
pub mod mesh;
pub mod policy;
pub mod program;
pub mod raster;
#[cfg(feature = "scene")]
pub mod scene;
pub mod semantics;
pub mod syntax;
pub mod texture;
pub mod validate;

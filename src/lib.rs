//! Runs the shader assembly of Direct3D 8: `vs.1.0`, `vs.1.1` and `ps.1.0` to `ps.1.4`.
//!
//! [`parse`], [`validate()`], [`assemble`] and [`disassemble`] do what is asked for most, on plain texts and words:
//!
//! ```
//! let tokens = texcrd::assemble("ps.1.1\ntex t0\nmul r0, t0, v0")?;
//! assert_eq!(texcrd::disassemble(&tokens)?, "ps.1.1\ntex t0\nmul r0, t0, v0\n");
//! # Ok::<(), texcrd::Report>(())
//! ```
//!
//! The rooms behind them do more. A listing goes through [`listing::check`] to a [`program::Program`], through [`kernel::lower`] to a
//! [`kernel::Kernel`], and runs in an [`exec::Machine`]. [`scene::Scene`] puts listings, meshes and textures together
//! and renders them through [`raster`].
//!
//! [`bytecode`] reads and writes the tokens that Direct3D 8 took instead of listings.
//!
//! `ARCHITECTURE.md` in the repository says which room knows of which.

pub mod bytecode;
#[cfg(feature = "scene")]
pub mod case;
pub mod debug;
pub mod diagnostic;
pub mod exec;
pub mod explain;
pub mod extract;
mod front;
pub mod generate;
#[cfg(feature = "gpu")]
pub mod gpu;
pub mod isa;
pub mod kernel;
#[cfg(feature = "languages")]
pub mod languages;
pub mod listing;
#[cfg(feature = "gpu")]
pub mod matching;
pub mod mesh;
pub mod policy;
pub mod preprocess;
pub mod program;
pub mod raster;
pub mod rules;
#[cfg(feature = "scene")]
pub mod scene;
pub mod semantics;
#[cfg(feature = "scene")]
pub mod sheet;
pub mod simd;
pub mod syntax;
pub mod texture;
pub mod validate;
pub mod wgsl;

pub use front::{Report, assemble, disassemble, parse, validate};

/// The example of the first page, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct FirstPage;

//! What cannot be translated.

use crate::isa::{ShaderKind, Version};
use std::fmt;

/// A translation that was asked for does not exist.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TranslateError {
    /// Neither a vertex nor a pixel shader was given.
    Nothing,
    /// A shader stands in the place of the other kind.
    WrongKind {
        /// The place.
        place: ShaderKind,
        /// The version of the shader that stands there.
        version: Version,
    },
    /// An entry point cannot have this name: it is no identifier of WGSL, or the translation uses it itself.
    EntryPoint(String),
    /// There are at most six user clip planes.
    ClipPlanes(u8),
}

impl fmt::Display for TranslateError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Nothing => {
                f.write_str("there is neither a vertex nor a pixel shader to translate")
            }
            Self::WrongKind { place, version } => {
                let place = match place {
                    ShaderKind::Vertex => "vertex",
                    ShaderKind::Pixel => "pixel",
                };
                write!(f, "{version} is no {place} shader")
            }
            Self::EntryPoint(name) => write!(
                f,
                "an entry point cannot be named `{name}`: a name has letters, digits and single underscores, \
                 begins with a letter and ends in `_main`"
            ),
            Self::ClipPlanes(count) => {
                write!(f, "Direct3D 8 has 6 user clip planes, not {count}")
            }
        }
    }
}

impl std::error::Error for TranslateError {}

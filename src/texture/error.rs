//! What can be wrong with a texture.

use std::fmt;

use super::{Format, MAX_BYTES, MAX_EDGE, TextureKind};

/// Why a texture could not be made.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum TextureError {
    /// An edge is 0 or longer than [`MAX_EDGE`]. Holds width, height and depth.
    Size([u32; 3]),
    /// The kind has no such size: a cube face that is not square, a depth on a 2D texture or a cube.
    Shape {
        /// The kind that was asked for.
        kind: TextureKind,
        /// Width, height, depth.
        size: [u32; 3],
    },
    /// The texels would take more than [`MAX_BYTES`].
    TooLarge {
        /// The bytes that they would take.
        bytes: u64,
    },
    /// No level, or more levels than halving the size can give.
    Levels {
        /// Levels given.
        given: usize,
        /// The most that the size has.
        most: u32,
    },
    /// A level holds another amount of data than its size asks for.
    Amount {
        /// The level, 0 the largest.
        level: usize,
        /// What is counted: `texels` or `bytes`.
        unit: &'static str,
        /// The amount that the size asks for (all faces).
        expected: u64,
        /// The amount given.
        given: u64,
    },
    /// A list of words does not fill whole texels of the format.
    Words {
        /// The format.
        format: Format,
        /// What is wrong with the words.
        problem: String,
    },
    /// Texels given as numbers cannot be stored in a block-compressed format: there is no compressor.
    CannotCompress(Format),
    /// The format is decoded only by a build with this feature.
    NeedsFeature {
        /// The format.
        format: Format,
        /// The feature of the crate.
        feature: &'static str,
    },
    /// Textures that should become the faces of one cube differ from each other or are not square 2D textures.
    Faces(String),
    /// A file is broken, or holds something that cannot be a Direct3D 8 texture.
    File {
        /// The kind of file: `DDS`, `picture`.
        what: &'static str,
        /// What is wrong with it.
        problem: String,
    },
}

impl fmt::Display for TextureError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Size([w, h, d]) => {
                write!(
                    out,
                    "a texture of {w}x{h}x{d} texels: each edge must be 1 to {MAX_EDGE}"
                )
            }
            Self::Shape {
                kind,
                size: [w, h, d],
            } => match kind {
                TextureKind::Texture2D => write!(out, "a 2D texture has depth 1, not {d}"),
                TextureKind::Cube => write!(
                    out,
                    "a cube face is square and has depth 1: {w}x{h}x{d} is not"
                ),
                TextureKind::Volume => write!(out, "a volume cannot be {w}x{h}x{d}"),
            },
            Self::TooLarge { bytes } => {
                write!(
                    out,
                    "the texture would take {bytes} bytes; {MAX_BYTES} are allowed"
                )
            }
            Self::Levels { given, most } => {
                write!(out, "{given} mip levels given: this size has 1 to {most}")
            }
            Self::Amount {
                level,
                unit,
                expected,
                given,
            } => {
                write!(out, "level {level} needs {expected} {unit}, {given} given")
            }
            Self::Words { format, problem } => write!(out, "words of {format}: {problem}"),
            Self::CannotCompress(format) => {
                write!(
                    out,
                    "texels cannot be stored as {format}: give compressed blocks (raw words or a DDS file)"
                )
            }
            Self::NeedsFeature { format, feature } => {
                write!(
                    out,
                    "{format} is decoded only when the crate is built with the feature `{feature}`"
                )
            }
            Self::Faces(problem) => write!(out, "these cannot be the faces of a cube: {problem}"),
            Self::File { what, problem } => write!(out, "not a usable {what} file: {problem}"),
        }
    }
}

impl std::error::Error for TextureError {}

//! What a program must know to draw with a translation.

use super::layout::UniformField;
use super::options::Options;
use crate::isa::{ShaderKind, Version};
use crate::program::Usage;
use std::ops::Range;

/// The contract of a translation as plain data.
#[derive(Clone, Debug, PartialEq)]
pub struct Reflection {
    /// The vertex stage, if there is one.
    pub vertex: Option<StageReflection>,
    /// The pixel stage, if there is one.
    pub pixel: Option<StageReflection>,
    /// The vertex registers that are read.
    pub inputs: Vec<VertexInput>,
    /// What goes from the vertex to the pixel stage.
    pub varyings: Vec<Varying>,
    /// Whether the structure `Varyings` has the position, as `position`.
    pub position: bool,
    /// What is to be bound.
    pub bindings: Vec<Binding>,
    /// What was baked in: fog, alpha test, texture kinds and all the rest.
    pub baked: Options,
}

/// One stage.
#[derive(Clone, Debug, PartialEq)]
pub struct StageReflection {
    /// Name of the entry point.
    pub entry: String,
    /// Version of the shader.
    pub version: Version,
    /// The constants that are taken from the uniform block: ranges of register numbers. With relative addressing this
    /// is the whole file.
    pub constants: Vec<Range<u32>>,
    /// Whether constants are addressed through `a0`.
    pub relative: bool,
    /// The constants that the shader defines, in the order of their registers.
    pub definitions: Vec<Definition>,
    /// Whether the shader writes `oPts`, which has an effect only if points are drawn.
    pub point_size: bool,
    /// Whether the stage replaces the depth of the pixel.
    pub writes_depth: bool,
    /// Whether the stage may discard the pixel.
    pub discards: bool,
}

/// A constant that the shader defines itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Definition {
    /// The register.
    pub register: u32,
    /// Its value as the shader sees it.
    pub value: [f32; 4],
    /// Whether the value must be put into the uniform block; else it stands in the WGSL.
    pub in_uniform: bool,
}

/// A vertex register: a `vec4f` at `@location(register)`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VertexInput {
    /// The number of the register and of the location.
    pub register: u32,
    /// What a `dcl` says it holds: the usage and its index.
    pub usage: Option<(Usage, u8)>,
}

/// Something that is interpolated.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Varying {
    /// Name in the WGSL.
    pub name: String,
    /// The location.
    pub location: u32,
    /// How many components are passed.
    pub components: usize,
    /// Whether the first vertex of a primitive gives the value.
    pub flat: bool,
}

/// One binding.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Binding {
    /// The bind group.
    pub group: u32,
    /// The number within the group.
    pub binding: u32,
    /// Name in the WGSL.
    pub name: String,
    /// What is bound there.
    pub resource: Resource,
}

/// What is bound.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Resource {
    /// The uniform block of a stage.
    Uniform {
        /// Which stage reads it.
        stage: ShaderKind,
        /// Its fields by offset.
        fields: Vec<UniformField>,
        /// Bytes of the whole block.
        size: u32,
    },
    /// The texture of a stage, with filterable floats.
    Texture {
        /// The texture stage.
        stage: u8,
        /// Its shape.
        dimension: Dimension,
    },
    /// The sampler of a stage, a filtering one.
    Sampler {
        /// The texture stage.
        stage: u8,
        /// Whether the shader counts on an address mode of clamp, on these axes.
        clamps: [bool; 3],
    },
}

/// The shape of a texture view.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Dimension {
    /// Width × height.
    D2,
    /// Six layers: the faces +X, −X, +Y, −Y, +Z, −Z of a cube.
    D2Array,
    /// A cube.
    Cube,
    /// Width × height × depth.
    D3,
}

impl Dimension {
    /// Its WGSL type.
    pub fn wgsl(self) -> &'static str {
        match self {
            Self::D2 => "texture_2d<f32>",
            Self::D2Array => "texture_2d_array<f32>",
            Self::Cube => "texture_cube<f32>",
            Self::D3 => "texture_3d<f32>",
        }
    }

    /// Its name: `2d`, `2d-array`, `cube`, `3d`.
    pub fn name(self) -> &'static str {
        match self {
            Self::D2 => "2d",
            Self::D2Array => "2d-array",
            Self::Cube => "cube",
            Self::D3 => "3d",
        }
    }
}

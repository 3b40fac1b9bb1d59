//! What a case can expect: registers and what becomes of the pixel.

use crate::isa::register::{OFOG, OPTS};
use crate::isa::{FileSet, RegisterFile, ShaderKind, Version};
use crate::program::{Register, letters};
use crate::raster::fog_unit;
use crate::semantics::saturate;
use std::fmt;

/// Something that an expectation gives numbers for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// A register at the end of the shader: `r#` and `t#` of the pixel shader (of the vertex shader, where there is no
    /// pixel shader), `oPos`, `oT#`, `oD#`, `oFog`, `oPts` and `a0` of the vertex shader. `oD#` and `oFog` count as the
    /// rasterizer takes them, clamped to 0…1.
    Register(ShaderKind, Register),
    /// The depth of the pixel, 0 to 1.
    Depth,
    /// The pixel in the target after fog, alpha test, depth test, blending and write mask.
    Frame,
}

/// The files of which registers can be expected; inputs and constants are given, not computed.
const FILES: FileSet = FileSet::of(&[
    RegisterFile::Temp,
    RegisterFile::Texture,
    RegisterFile::RastOut,
    RegisterFile::AttrOut,
    RegisterFile::TexCrdOut,
    RegisterFile::Addr,
]);

impl Quantity {
    /// Everything that shaders of these versions can be asked for.
    pub(super) fn all(vertex: Option<Version>, pixel: Option<Version>) -> Vec<Self> {
        let mut all = Vec::new();
        // Temporaries are those of the pixel shader where there is one.
        for version in [pixel, vertex].into_iter().flatten() {
            for file in FILES.iter() {
                let hidden = pixel.is_some_and(|pixel| pixel != version);
                if hidden && file == RegisterFile::Temp {
                    continue;
                }
                all.extend(
                    (0..file.count(version))
                        .map(|index| Self::Register(version.kind(), Register::new(file, index))),
                );
            }
        }
        if pixel.is_some() {
            all.extend([Self::Depth, Self::Frame]);
        }
        all
    }

    /// How many components it has.
    pub fn components(self) -> usize {
        match self {
            Self::Register(_, register) if is_scalar(register) => 1,
            Self::Depth => 1,
            _ => 4,
        }
    }

    /// The numbers as they are compared: colours and fog as the rasterizer takes them.
    pub(super) fn as_compared(self, numbers: [f32; 4]) -> [f32; 4] {
        match self {
            Self::Register(_, register) => match (register.file, register.index) {
                (RegisterFile::RastOut, OFOG) => [fog_unit(numbers[0]), 0.0, 0.0, 0.0],
                (RegisterFile::AttrOut, _) => numbers.map(saturate),
                _ => numbers,
            },
            Self::Depth | Self::Frame => numbers,
        }
    }

    /// The letter of a component; `None` for what has only one.
    pub fn letter(self, component: usize) -> Option<char> {
        if self.components() == 1 {
            return None;
        }
        let kind = match self {
            Self::Register(kind, _) => kind,
            Self::Depth | Self::Frame => ShaderKind::Pixel,
        };
        letters(kind).get(component).copied()
    }
}

fn is_scalar(register: Register) -> bool {
    match register.file {
        RegisterFile::RastOut => matches!(register.index, OFOG | OPTS),
        RegisterFile::Addr => true,
        _ => false,
    }
}

impl fmt::Display for Quantity {
    /// The key under which a case expects it: `r0`, `oPos`, `depth`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Register(_, register) => register.fmt(f),
            Self::Depth => f.write_str("depth"),
            Self::Frame => f.write_str("frame"),
        }
    }
}

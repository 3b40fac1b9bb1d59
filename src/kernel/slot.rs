//! The register file of an invocation.

use crate::isa::register::{OFOG, OPOS, OPTS};
use crate::isa::{RegisterFile, ShaderKind, Version};
use crate::program::Register;

/// A register of an invocation: four components that differ from vertex to vertex or pixel to pixel.
///
/// Texture coordinates and texture registers are different slots: in `ps.1.0` to `ps.1.3` the coordinate set that
/// an instruction uses is named by its destination, while `t#` as a source is what an earlier instruction sampled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Slot(u8);

/// How many slots there are.
pub const SLOT_COUNT: usize = AT as usize + 2;

const V: u8 = 0;
const R: u8 = V + 16;
const TC: u8 = R + 12;
const T: u8 = TC + 8;
const RAST: u8 = T + 4;
const D: u8 = RAST + 3;
const OT: u8 = D + 2;
const A: u8 = OT + 8;
const ROW: u8 = A + 1;
const EYE: u8 = ROW + 1;
const AT: u8 = EYE + 1;

impl Slot {
    /// `oPos`
    pub const POSITION: Self = Self(RAST + OPOS as u8);
    /// `oFog`
    pub const FOG: Self = Self(RAST + OFOG as u8);
    /// `oPts`
    pub const POINT_SIZE: Self = Self(RAST + OPTS as u8);
    /// `a0`
    pub const ADDRESS: Self = Self(A);
    /// `r0`, the result of a pixel shader.
    pub const R0: Self = Self(R);
    /// The rows that `texm3x2pad`, `texm3x3pad` and what follows them compute.
    pub const ROW: Self = Self(ROW);
    /// The eye vector that `texm3x3vspec` collects.
    pub const EYE: Self = Self(EYE);
    /// Coordinates on their way to a sample.
    pub const COORDINATES: Self = Self(AT);
    /// The depth that replaces the interpolated one, in x.
    pub const DEPTH: Self = Self(AT + 1);

    /// Its place in the file.
    pub const fn index(self) -> usize {
        self.0 as usize
    }

    /// Every slot.
    pub fn all() -> impl Iterator<Item = Slot> {
        (0..SLOT_COUNT as u8).map(Slot)
    }

    /// `v#`, for numbers below 16.
    pub fn input(index: usize) -> Option<Self> {
        Self::at(V, index, 16)
    }

    /// `r#`, for numbers below 12.
    pub fn temp(index: usize) -> Option<Self> {
        Self::at(R, index, 12)
    }

    /// Interpolated texture coordinate set, for numbers below 8.
    pub fn texcoord(index: usize) -> Option<Self> {
        Self::at(TC, index, 8)
    }

    /// `t#` of `ps.1.0` to `ps.1.3` as a result, for numbers below 4.
    pub fn texture(index: usize) -> Option<Self> {
        Self::at(T, index, 4)
    }

    /// `oD#`, for numbers below 2.
    pub fn color_output(index: usize) -> Option<Self> {
        Self::at(D, index, 2)
    }

    /// `oT#`, for numbers below 8.
    pub fn texcoord_output(index: usize) -> Option<Self> {
        Self::at(OT, index, 8)
    }

    /// The number of an input, if it is one: the other way from [`Slot::input`].
    pub fn input_index(self) -> Option<usize> {
        self.within(V, R)
    }

    /// The number of an interpolated coordinate set: the other way from [`Slot::texcoord`].
    pub fn texcoord_index(self) -> Option<usize> {
        self.within(TC, T)
    }

    /// Whether the rasterizer takes it: `oPos`, `oFog`, `oPts`, `oD#`, `oT#` of a vertex shader, and [`Slot::DEPTH`]. The result
    /// of a pixel shader, `r0`, is a temporary as well and not among them.
    pub fn is_output(self) -> bool {
        self == Self::DEPTH || (RAST..A).contains(&self.0)
    }

    fn within(self, base: u8, end: u8) -> Option<usize> {
        (base..end)
            .contains(&self.0)
            .then(|| usize::from(self.0 - base))
    }

    fn at(base: u8, index: usize, count: usize) -> Option<Self> {
        (index < count).then(|| Self(base + index as u8))
    }

    /// The slot of a register of a shader; `None` for constants and for registers that the version does not have.
    pub fn of(register: Register, version: Version) -> Option<Self> {
        if register.index >= register.file.count(version) {
            return None;
        }
        let index = register.index as usize;
        match register.file {
            RegisterFile::Temp => Self::temp(index),
            RegisterFile::Input => Self::input(index),
            RegisterFile::Const => None,
            RegisterFile::Addr => Some(Self::ADDRESS),
            RegisterFile::Texture if version == Version::Ps14 => Self::texcoord(index),
            RegisterFile::Texture => Self::texture(index),
            RegisterFile::RastOut => Self::at(RAST, index, 3),
            RegisterFile::AttrOut => Self::color_output(index),
            RegisterFile::TexCrdOut => Self::texcoord_output(index),
        }
    }

    /// Whether the slot has no name in listings: it carries something between the steps of one instruction, or is
    /// [`Slot::DEPTH`].
    pub fn is_internal(self) -> bool {
        self.0 >= ROW
    }

    /// The name under which a person knows the slot in a shader of this kind.
    pub fn name(self, kind: ShaderKind) -> String {
        let files = [
            (V, R, RegisterFile::Input),
            (R, TC, RegisterFile::Temp),
            (TC, T, RegisterFile::Texture),
            (T, RAST, RegisterFile::Texture),
            (RAST, D, RegisterFile::RastOut),
            (D, OT, RegisterFile::AttrOut),
            (OT, A, RegisterFile::TexCrdOut),
            (A, ROW, RegisterFile::Addr),
        ];
        for (first, end, file) in files {
            if (first..end).contains(&self.0) {
                return file.register_name(u32::from(self.0 - first));
            }
        }
        let name = match self {
            Self::ROW => "row",
            Self::EYE => "eye",
            Self::DEPTH => "depth",
            _ => "coordinates",
        };
        debug_assert!(kind == ShaderKind::Pixel, "only pixel shaders have {name}");
        name.to_string()
    }

    /// What a slot holds before the first instruction when nothing else is loaded into it.
    ///
    /// Outputs that are never written: `oD0` (1, 1, 1, 1), all others 0; observed on hardware of the time.
    pub(super) fn default_value(self) -> [f32; 4] {
        if self.0 == D { [1.0; 4] } else { [0.0; 4] }
    }
}

//! What happens in a run: one moment, one change.

use crate::isa::WriteMask;
use crate::kernel::{Operand, Slot};
use crate::raster::{
    AlphaTested, Blended, ColorWritten, DepthTested, Fogged, StencilTested, Stored,
};
use crate::texture::Detail;

/// A register of the four pixels of a quad, pixel by pixel: (x, y), (x+1, y), (x, y+1), (x+1, y+1). A vertex or a listing run by
/// hand has the same values four times.
pub type Quad = [[f32; 4]; 4];

/// One thing that happens in a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Moment {
    /// The instruction, by its number among those of the program; `None` for what surrounds the shader.
    pub instruction: Option<usize>,
    /// What happens.
    pub event: Event,
    /// What it changes, if it changes anything.
    pub change: Option<Change>,
    /// What is remarkable about it, pixel by pixel.
    pub flags: [Flags; 4],
    /// Components of registers whose content is lost here without a new one: the alpha of `r#` at `phase`.
    pub lost: Vec<(Slot, WriteMask)>,
}

/// What kind of thing happens.
#[derive(Clone, Debug, PartialEq)]
pub enum Event {
    /// An input gets its value, before the first instruction.
    Input(InputSource),
    /// A step of the kernel. A macro such as `m4x4` has one for each of its rows, a texture instruction one for each of its parts.
    Step {
        /// Its number among the steps of the kernel.
        step: usize,
        /// What its operands read, in their order.
        reads: Vec<Read>,
        /// The result before shift, saturation and the numbers of a hardware model; meaningful in the components that are
        /// written, and not of a `texkill`.
        computed: Quad,
        /// What was sampled.
        sample: Option<Sample>,
        /// Which pixels `texkill` has discarded before and after this step; only of a `texkill`.
        killed: Option<([bool; 4], [bool; 4])>,
    },
    /// An instruction that computes nothing: `phase`, `nop`.
    Nothing,
    /// A person has set a value.
    Set,
    /// The rasterizer takes an output of a vertex into 0 to 1; only where that changes it.
    Taken,
    /// A stage of the output merger, behind the last instruction of a pixel shader.
    Merge(Box<MergeStage>),
}

/// What the output merger does with a pixel, stage by stage in this order. Stages that the render states switch off are absent,
/// and so is everything behind a test that is not passed.
#[derive(Clone, Debug, PartialEq)]
pub enum MergeStage {
    /// `texkill` took the pixel out.
    Killed,
    /// `r0` is taken into 0 to 1; only where that changes it.
    Clamp,
    /// The alpha test.
    AlphaTest(AlphaTested),
    /// The stencil test.
    Stencil(StencilTested),
    /// The depth test.
    Depth(DepthTested),
    /// Fog.
    Fog(Fogged),
    /// Blending with what the target holds.
    Blend(Blended),
    /// The target takes the colour.
    Write {
        /// The colour, and which channels of it are written.
        write: ColorWritten,
        /// What the target held before.
        before: Stored,
        /// What it holds now.
        after: Stored,
    },
}

/// Where an input comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum InputSource {
    /// It was given by hand, or is what nothing feeds.
    Given,
    /// An element of a vertex, filled up from (0, 0, 0, 1).
    Fetched,
    /// A value of the three vertices of a primitive: a0 + s1·(a1 − a0) + s2·(a2 − a0).
    Interpolated {
        /// The value at the vertices, as it goes into the interpolation.
        corners: [[f32; 4]; 3],
        /// The shares s1 and s2 of the second and third vertex, for each pixel of the quad.
        shares: [[f32; 2]; 4],
    },
    /// The place within a point sprite.
    Sprite,
    /// A vertex shader left it, and nothing was interpolated.
    Output,
}

/// What is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Target {
    /// A register of the invocation.
    Slot(Slot),
    /// A constant.
    Constant(u32),
}

/// A register before and after a moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Change {
    /// The register.
    pub target: Target,
    /// The components that are written.
    pub mask: WriteMask,
    /// The whole register before.
    pub before: Quad,
    /// The whole register after.
    pub after: Quad,
    /// The components that nothing has written before.
    pub first: WriteMask,
}

/// What one operand of a step read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Read {
    /// The operand.
    pub operand: Operand,
    /// The constant that a relative operand names, for each pixel; `None` outside of those there are, and for other operands.
    pub relative: [Option<u32>; 4],
    /// The slots of the operation that the step uses.
    pub slots: WriteMask,
    /// The values, swizzled, modifiers applied; meaningful in `slots`.
    pub values: Quad,
    /// The components of the register that nothing had written.
    pub uninitialised: WriteMask,
}

/// What a step sampled. The result is the change of its moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// The texture stage.
    pub stage: usize,
    /// u, v, w for each pixel.
    pub coordinates: [[f32; 3]; 4],
    /// Level of detail and probes for each pixel; the level is −∞ where the coordinates of the quad are all the same.
    pub detail: [Detail; 4],
}

/// What is remarkable about a moment for one pixel, component by component.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Flags {
    /// `_sat` changed the result.
    pub saturated: WriteMask,
    /// Some other clamp changed the value: of `texcoord`, of the address register, of a depth, of a colour on its way in or out,
    /// of a pixel shader's constant.
    pub clamped: WriteMask,
    /// The result is NaN, and nothing that was read is.
    pub nan: WriteMask,
    /// The result is infinite, or the largest number there is, which `rcp`, `rsq` and `log` of zero give in its place; and
    /// nothing that was read is.
    pub infinite: WriteMask,
    /// `c[a0.x + n]` named a constant that there is not; it reads (0, 0, 0, 0).
    pub out_of_range: bool,
    /// A component was read that nothing has written.
    pub uninitialised: bool,
}

impl Flags {
    /// What either of them says: the flags of several moments together.
    #[must_use]
    pub fn or(self, other: Self) -> Self {
        Self {
            saturated: self.saturated.or(other.saturated),
            clamped: self.clamped.or(other.clamped),
            nan: self.nan.or(other.nan),
            infinite: self.infinite.or(other.infinite),
            out_of_range: self.out_of_range || other.out_of_range,
            uninitialised: self.uninitialised || other.uninitialised,
        }
    }

    /// Whether nothing is remarkable.
    pub fn is_empty(self) -> bool {
        self == Self::default()
    }
}

impl Target {
    /// The slot, if it is one.
    pub fn slot(self) -> Option<Slot> {
        match self {
            Self::Slot(slot) => Some(slot),
            Self::Constant(_) => None,
        }
    }
}

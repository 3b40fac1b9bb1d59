//! For a debugger: what the merger did with one pixel, stage by stage.
//!
//! The merger itself fills the record in, through a [`Watcher`], so that what is told is what was done. When frames are
//! drawn [`Nobody`] watches, and the compiler leaves the telling out.

use super::state::{BlendFactor, BlendOp, ColorMask, Compare, FogDistance, FogMode, StencilOp};

/// What a pixel of a target holds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stored {
    /// Red, green, blue, alpha.
    pub color: [u8; 4],
    /// 0 to 1.
    pub depth: f32,
    /// The stencil value.
    pub stencil: u8,
}

/// What became of a shaded pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fate {
    /// It passed every test.
    Written,
    /// `texkill` took it out.
    Killed,
    /// The alpha test took it out.
    AlphaTest,
    /// The stencil test took it out.
    Stencil,
    /// The depth test took it out.
    Depth,
}

impl Fate {
    /// One word for it: `written`, `killed`, `alpha`, `stencil`, `depth`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Written => "written",
            Self::Killed => "killed",
            Self::AlphaTest => "alpha",
            Self::Stencil => "stencil",
            Self::Depth => "depth",
        }
    }
}

/// The way of one pixel through the merger.
///
/// The stages stand in the order in which they are done. One that a state switches off is absent, and so is one that the
/// pixel did not come to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MergeRecord {
    /// What the target held before.
    pub before: Stored,
    /// `r0` as the shader left it.
    pub shaded: [f32; 4],
    /// `r0` in 0 to 1 (NaN is 0), with which all stages work.
    pub clamped: [f32; 4],
    /// The depth that the shader gives, as it left it; `None` if it gives none.
    pub replaced_depth: Option<f32>,
    /// Whether `texkill` took the pixel out.
    pub killed: bool,
    /// The alpha test.
    pub alpha_test: Option<AlphaTested>,
    /// The stencil test. What the depth test says decides about its operation, too.
    pub stencil: Option<StencilTested>,
    /// The depth test.
    pub depth: Option<DepthTested>,
    /// Fog.
    pub fog: Option<Fogged>,
    /// Blending with what the target held.
    pub blend: Option<Blended>,
    /// The write of the colour. Always there if every test was passed.
    pub write: Option<ColorWritten>,
    /// What the target holds afterwards.
    pub after: Stored,
}

impl MergeRecord {
    /// What became of the pixel: the stage that took it out, if one did.
    pub fn fate(&self) -> Fate {
        match self {
            Self { killed: true, .. } => Fate::Killed,
            Self {
                alpha_test: Some(AlphaTested { passed: false, .. }),
                ..
            } => Fate::AlphaTest,
            Self {
                stencil: Some(StencilTested { passed: false, .. }),
                ..
            } => Fate::Stencil,
            Self {
                depth: Some(DepthTested { passed: false, .. }),
                ..
            } => Fate::Depth,
            _ => Fate::Written,
        }
    }
}

/// The alpha test of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AlphaTested {
    /// The alpha, rounded to 8 bits.
    pub alpha: u8,
    /// Alpha on the left, reference on the right.
    pub func: Compare,
    /// What it is compared with.
    pub reference: u8,
    /// Whether the pixel goes on.
    pub passed: bool,
}

/// The stencil test of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StencilTested {
    /// The stencil value of the target.
    pub stored: u8,
    /// The reference value.
    pub reference: u8,
    /// The bits of both that are compared.
    pub mask: u8,
    /// Reference on the left, stored value on the right.
    pub func: Compare,
    /// Whether the stencil test is passed; the depth test has still to be.
    pub passed: bool,
    /// What is done with the stored value: that of the state for a stencil test that fails, for a depth test that fails,
    /// or for both passed.
    pub op: StencilOp,
    /// The bits that the operation changes.
    pub write_mask: u8,
    /// The stencil value of the target afterwards.
    pub after: u8,
}

/// The depth test of a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DepthTested {
    /// The depth of the pixel, in 0 to 1: the shader's, if it gives one, or that of the primitive.
    pub incoming: f32,
    /// The depth of the target.
    pub stored: f32,
    /// Incoming on the left, stored on the right.
    pub func: Compare,
    /// Whether the pixel goes on.
    pub passed: bool,
    /// Whether pixels that pass leave their depth behind.
    pub write: bool,
    /// The depth of the target afterwards.
    pub after: f32,
}

/// Where the fog of a pixel comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FogSource {
    /// The factor of the vertices, interpolated.
    Vertex,
    /// The distance.
    Table {
        /// How the factor follows from it.
        mode: FogMode,
        /// What is taken for it.
        kind: FogDistance,
        /// The distance.
        distance: f32,
    },
}

/// Fog over a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fogged {
    /// Where it comes from.
    pub source: FogSource,
    /// The factor as it comes from there.
    pub factor: f32,
    /// The same in 0 to 1, NaN being 1: how much of the pixel's own colour is left.
    pub clear: f32,
    /// The colour of full fog, in 0 to 1.
    pub color: [f32; 3],
    /// Red, green and blue before.
    pub before: [f32; 3],
    /// `clear · before + (1 − clear) · color`.
    pub after: [f32; 3],
}

/// What a side of a blend is multiplied by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BlendWeight {
    /// The factor that counts: those of the state, but for `bothsrcalpha` and `bothinvsrcalpha`, which stand for two.
    pub factor: BlendFactor,
    /// Its value for red, green, blue and alpha.
    pub value: [f32; 4],
}

/// A pixel joined with what the target held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blended {
    /// The pixel's colour.
    pub source: [f32; 4],
    /// What the target held, in 0 to 1.
    pub target: [f32; 4],
    /// What source and target are multiplied by; `None` for `min` and `max`, which take both as they are.
    pub weights: Option<[BlendWeight; 2]>,
    /// How the two are joined.
    pub op: BlendOp,
    /// What comes of it, in 0 to 1.
    pub result: [f32; 4],
}

/// The colour as it goes into the target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ColorWritten {
    /// The colour after fog and blending.
    pub color: [f32; 4],
    /// The same rounded to 8 bits, to the nearest.
    pub bytes: [u8; 4],
    /// The channels that the state lets through.
    pub mask: ColorMask,
    /// The channels that are written: those of the mask that the target has.
    pub written: [bool; 4],
}

/// Is told what the merger does.
pub(super) trait Watcher {
    /// Something was done with the pixels of a quad that are in `mask`. `entry` writes it down for one of them, 0 to 3.
    fn note(&mut self, mask: u8, entry: impl FnOnce(&mut MergeRecord, usize));

    /// Whether anybody does: if not, whole quads may go a shorter way to the same result.
    #[inline(always)]
    fn watches(&self) -> bool {
        true
    }
}

/// Does not want to know.
pub(super) struct Nobody;

impl Watcher for Nobody {
    #[inline(always)]
    fn note(&mut self, _: u8, _: impl FnOnce(&mut MergeRecord, usize)) {}

    #[inline(always)]
    fn watches(&self) -> bool {
        false
    }
}

/// Writes down what becomes of one pixel of a batch of one quad.
pub(super) struct Recorder {
    pub(super) pixel: usize,
    pub(super) record: MergeRecord,
}

impl Watcher for Recorder {
    fn note(&mut self, mask: u8, entry: impl FnOnce(&mut MergeRecord, usize)) {
        if mask >> self.pixel & 1 == 1 {
            entry(&mut self.record, self.pixel);
        }
    }
}

//! One pixel of a target on its own: for a debugger one that is drawn again, for tests of shaders one without a primitive.

use super::cover::Fragment;
use super::merger::{DepthTiming, QuadColor, blend, fog, merge};
use super::pixel::{LANES, PixelBatch, PixelResult, PixelShader};
use super::record::{Fate, MergeRecord, Nobody, Recorder, Stored};
use super::state::RenderState;
use super::target::{ColorFormat, Surface, TILE, Target, TargetTooLarge};
use super::unit;

/// One pixel of a target: colour, depth and stencil. What [`cover`](super::cover()) finds at it goes in, in order.
pub struct LoneTarget {
    /// One tile. Only the place of the pixel in its tile counts.
    target: Target,
    place: (u32, u32),
}

impl LoneTarget {
    /// The pixel (column, row) of a target that holds this before anything is drawn; its depth is taken into 0 to 1.
    ///
    /// # Errors
    /// [`TargetTooLarge`], if the one tile should be too much.
    pub fn new(
        (x, y): (u32, u32),
        format: ColorFormat,
        holds: Stored,
    ) -> Result<Self, TargetTooLarge> {
        let mut target = Target::new(TILE, TILE, format)?;
        target.clear(Some(holds.color), Some(holds.depth), Some(holds.stencil));
        Ok(Self {
            target,
            place: (x % TILE, y % TILE),
        })
    }

    /// Shades and merges a primitive, as [`draw`](super::draw()) does, and tells what happened at each stage.
    ///
    /// The fragment must be of this pixel.
    pub fn draw(
        &mut self,
        state: &RenderState,
        fragment: &Fragment,
        shader: &dyn PixelShader,
    ) -> MergeRecord {
        let mut shaded = PixelResult::new();
        shader.shade(&fragment.batch, &mut shaded);
        let mut batch = fragment.batch.clone();
        for (lane, live) in batch.live.iter_mut().enumerate() {
            *live = lane == fragment.lane;
        }
        self.merge(state, &batch, &shaded, fragment.lane, shader.writes_depth())
    }

    /// Merges a pixel of a batch of one quad, in which it alone is live. `replaced`: whether the shader's depth counts.
    fn merge(
        &mut self,
        state: &RenderState,
        batch: &PixelBatch,
        shaded: &PixelResult,
        pixel: usize,
        replaced: bool,
    ) -> MergeRecord {
        // After the shader is right for all: whoever may be tested before it comes to the same result.
        let timing = DepthTiming::Late {
            reject: false,
            replaced,
        };
        let mut recorder = Recorder {
            pixel,
            record: MergeRecord {
                before: self.holds(),
                ..MergeRecord::default()
            },
        };
        let format = self.target.format();
        if let Some(tile) = self.target.tiles_mut().first_mut() {
            let tile = tile.settled();
            merge(tile, format, state, timing, batch, shaded, &mut recorder);
        }
        MergeRecord {
            after: self.holds(),
            ..recorder.record
        }
    }

    /// What the pixel holds now.
    pub fn holds(&self) -> Stored {
        let (x, y) = self.place;
        Stored {
            color: self.target.color(x, y).unwrap_or_default(),
            depth: self.target.depth(x, y).unwrap_or_default(),
            stencil: self.target.stencil(x, y).unwrap_or_default(),
        }
    }
}

/// A shaded pixel on its own, before the merger.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LonePixel {
    /// `r0`.
    pub color: [f32; 4],
    /// Whether `texkill` took it out.
    pub killed: bool,
    /// The depth of the primitive, 0 to 1. Table fog uses it, whatever the shader replaces it with.
    pub z: f32,
    /// The depth that the shader replaces it with.
    pub replaced_z: Option<f32>,
    /// The w of the position.
    pub w: f32,
    /// The fog factor of the vertices, 0 to 1.
    pub fog: f32,
}

/// What stands in the target after a [`LonePixel`].
#[derive(Debug, Clone, PartialEq)]
pub struct Merged {
    /// The colour in 0 to 1 before it is rounded to the steps of a target.
    pub exact: [f32; 4],
    /// The colour as a target of 8 bits a channel stores it.
    pub stored: [u8; 4],
    /// Whether the pixel reached the target, or else what took it out.
    pub fate: Fate,
    /// What was done with it, stage by stage.
    pub record: MergeRecord,
}

/// Takes one pixel through fog, alpha test, depth and stencil test, blending and the colour write mask, into a target that
/// holds `surface`.
///
/// # Errors
/// [`TargetTooLarge`], if the one pixel of the target should be too much.
pub fn merge_lone(
    state: &RenderState,
    pixel: &LonePixel,
    surface: &Surface,
) -> Result<Merged, TargetTooLarge> {
    let mut clear = surface.color.map(unit);
    if surface.format == ColorFormat::X8R8G8B8 {
        clear[3] = 1.0;
    }
    let mut target = LoneTarget::new((0, 0), surface.format, surface.stored())?;
    let mut batch = PixelBatch::empty();
    batch.place(0, 0, 0, 1, &[pixel.z; 4]);
    batch.quads = 1;
    batch.w = [pixel.w; LANES];
    batch.fog = [pixel.fog; LANES];
    let mut shaded = PixelResult::new();
    shaded.color = pixel.color.map(|channel| [channel; LANES]);
    shaded.killed = [pixel.killed; LANES];
    shaded.depth = [pixel.replaced_z.unwrap_or_default(); LANES];
    let record = target.merge(state, &batch, &shaded, 0, pixel.replaced_z.is_some());
    let fate = record.fate();
    let mut exact = clear;
    if fate == Fate::Written {
        let mut color: QuadColor = pixel.color.map(|channel| [unit(channel); 4]);
        fog(&mut color, &state.fog, &batch, 0, 1, &mut Nobody);
        // The target of the record is rounded, this one is not.
        if state.blend.enable {
            color = blend(&state.blend, &color, &clear.map(|channel| [channel; 4]));
        }
        for (channel, value) in exact.iter_mut().enumerate() {
            if (surface.format.written(state.color_mask)).writes(channel) {
                *value = color[channel][0];
            }
        }
    }
    Ok(Merged {
        exact,
        stored: record.after.color,
        fate,
        record,
    })
}

//! For a debugger: one pixel of a target, drawn again on its own.

use super::cover::Fragment;
use super::merger::{DepthTiming, merge};
use super::pixel::{PixelResult, PixelShader};
use super::state::RenderState;
use super::target::{ColorFormat, TILE, Target, TargetTooLarge};

/// What became of a primitive at a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fate {
    /// It passed every test.
    Written,
    /// `texkill` took the pixel out.
    Killed,
    /// The alpha, depth or stencil test took it out.
    Rejected,
}

/// One pixel of a target: colour, depth and stencil. What [`cover`](super::cover()) finds at it goes in, in order.
pub struct LoneTarget {
    /// One tile. Only the place of the pixel in its tile counts.
    target: Target,
    place: (u32, u32),
}

impl LoneTarget {
    /// The pixel of a target with alpha, cleared to this colour (red, green, blue, alpha), depth 1, stencil 0.
    ///
    /// # Errors
    /// [`TargetTooLarge`], if the one tile should be too much.
    pub fn new((x, y): (u32, u32), clear: [u8; 4]) -> Result<Self, TargetTooLarge> {
        let mut target = Target::new(TILE, TILE, ColorFormat::A8R8G8B8)?;
        target.clear(Some(clear), Some(1.0), Some(0));
        Ok(Self {
            target,
            place: (x % TILE, y % TILE),
        })
    }

    /// Shades and merges a primitive, as [`draw`](super::draw()) does.
    pub fn draw(
        &mut self,
        state: &RenderState,
        fragment: &Fragment,
        shader: &dyn PixelShader,
    ) -> Fate {
        let mut batch = fragment.batch.clone();
        let mut live = [false; super::LANES];
        if let Some(own) = live.get_mut(fragment.lane) {
            *own = true;
        }
        batch.live = live;
        let mut shaded = PixelResult::new();
        shader.shade(&batch, &mut shaded);
        if shaded.killed.get(fragment.lane) == Some(&true) {
            return Fate::Killed;
        }
        // After the shader is right for all: whoever may be tested before it comes to the same result.
        let timing = DepthTiming::Late {
            reject: false,
            replaced: shader.writes_depth(),
        };
        let format = self.target.format();
        let written = (self.target.tiles_mut().first_mut()).map_or(0, |tile| {
            merge(tile, format, state, timing, &batch, &shaded)
        });
        match written {
            0 => Fate::Rejected,
            _ => Fate::Written,
        }
    }

    /// Red, green, blue and alpha as they are now.
    pub fn color(&self) -> [u8; 4] {
        let (x, y) = self.place;
        self.target.color(x, y).unwrap_or_default()
    }
}

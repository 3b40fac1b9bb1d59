//! For a debugger: what happened at one pixel of a pass.

use std::collections::VecDeque;

use super::prepare::{Output, PreparedDraw};
use super::render::{RenderError, Rendering};
use crate::raster::{
    ColorFormat, DrawError, Fragment, LoneTarget, MergeRecord, Stored, Surface, cover,
};

/// At most so many primitives are told of one pixel, the last ones.
pub const MAX_EVENTS: usize = 4096;

/// Everything that covers a pixel of a pass.
#[derive(Clone, Debug, PartialEq)]
pub struct PixelHistory {
    /// The pass.
    pub output: Output,
    /// Column and row.
    pub pixel: [u32; 2],
    /// What its target stores.
    pub format: ColorFormat,
    /// What the pixel held before the first draw.
    pub clear: Stored,
    /// How many primitives came before [`Self::events`], which holds at most [`MAX_EVENTS`].
    pub left_out: usize,
    /// The primitives that cover the pixel, in the order of drawing, whatever became of them.
    pub events: Vec<PixelEvent>,
}

impl PixelHistory {
    /// What the pixel holds in the end.
    pub fn after(&self) -> Stored {
        (self.events.last()).map_or(self.clear, |event| event.merge.after)
    }
}

/// One primitive of one draw at a pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct PixelEvent {
    /// The draw, by its place in [`Pass::draws`](super::Pass::draws).
    pub draw: usize,
    /// The primitive, its vertices, and the inputs of the quad.
    pub fragment: Fragment,
    /// What the merger did, stage by stage, with the pixel before and after.
    pub merge: MergeRecord,
}

impl Rendering<'_> {
    /// Every primitive that covers a pixel of the picture, or of a face of a render target, in the order of drawing. What
    /// the last one leaves is what was drawn there; a register that was shown in place of a colour
    /// ([`Show`](super::Show)) is left out of account. Nothing covers pixels outside, and those of what was not drawn.
    ///
    /// # Errors
    /// As [`Scene::render`](super::Scene::render).
    pub fn history(&self, output: Output, [x, y]: [u32; 2]) -> Result<PixelHistory, RenderError> {
        let pass = self.pass(output);
        let surface = pass.map_or_else(Surface::default, |pass| pass.surface);
        let clear = surface.stored();
        let mut pixel =
            LoneTarget::new((x, y), surface.format, clear).map_err(RenderError::Size)?;
        let (mut events, mut left_out) = (VecDeque::new(), 0);
        for (number, draw) in pass.iter().flat_map(|pass| &pass.draws).enumerate() {
            let Some(shaded) = self.shaded(output, number) else {
                continue;
            };
            let size = pass.map_or([0; 2], |pass| pass.size);
            let call = shaded.call(&draw.state, size);
            let fragments =
                cover(&call, size.into(), (x, y)).map_err(|error| refused(draw, error))?;
            let shader = shaded.shader();
            for fragment in fragments {
                let merge = pixel.draw(&draw.state, &fragment, &shader);
                if events.len() == MAX_EVENTS {
                    events.pop_front();
                    left_out += 1;
                }
                events.push_back(PixelEvent {
                    draw: number,
                    fragment,
                    merge,
                });
            }
        }
        Ok(PixelHistory {
            output,
            pixel: [x, y],
            format: surface.format,
            clear,
            left_out,
            events: events.into(),
        })
    }
}

fn refused(draw: &PreparedDraw<'_>, error: DrawError) -> RenderError {
    RenderError::Draw {
        draw: draw.name.to_owned(),
        error,
    }
}

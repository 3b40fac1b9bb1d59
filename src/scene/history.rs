//! For a debugger: what happened at one pixel of a picture, and what its registers held.

use super::prepare::PreparedDraw;
use super::render::{RenderError, Rendering};
use super::rendered::clear_color;
use crate::raster::{Fate, LoneTarget, PixelProgram, PixelTrace, cover};

/// One primitive of one draw at a pixel of the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PixelEvent {
    /// The draw, by its place in the last of [`Scene::passes`](super::Scene::passes).
    pub draw: usize,
    /// Which primitive of it.
    pub primitive: usize,
    /// What became of it.
    pub fate: Fate,
    /// The pixel afterwards: red, green, blue, alpha.
    pub after: [u8; 4],
}

impl Rendering<'_> {
    /// Every primitive that covers a pixel of the picture, in the order of drawing. The last one's colour is that of the
    /// picture. Pixels outside of it are covered by nothing.
    ///
    /// # Errors
    /// As [`Scene::render`](super::Scene::render).
    pub fn history(&self, [x, y]: [u32; 2]) -> Result<Vec<PixelEvent>, RenderError> {
        let Some(pass) = self.scene().passes(self.size()).pop() else {
            return Ok(Vec::new());
        };
        let mut pixel =
            LoneTarget::new((x, y), clear_color(pass.clear)).map_err(RenderError::Size)?;
        let mut events = Vec::new();
        for (number, draw) in pass.draws.iter().enumerate() {
            let shaded = self.rendered().shade(draw);
            let shader = PixelProgram {
                kernel: &draw.pixel.kernel,
                environment: &shaded.environment,
            };
            let call = shaded.call(draw, &draw.state, self.size());
            let fragments = cover(&call, self.size().into(), (x, y));
            for fragment in fragments.map_err(|error| refused(draw, error))? {
                let fate = pixel.draw(&draw.state, &fragment, &shader);
                events.push(PixelEvent {
                    draw: number,
                    primitive: fragment.primitive,
                    fate,
                    after: pixel.color(),
                });
            }
        }
        Ok(events)
    }

    /// The registers of a pixel while the pixel shader runs for one primitive of a draw of the picture; none if that does
    /// not cover the pixel.
    ///
    /// # Errors
    /// As [`Scene::render`](super::Scene::render).
    pub fn trace(
        &self,
        draw: &PreparedDraw<'_>,
        primitive: usize,
        [x, y]: [u32; 2],
    ) -> Result<Option<PixelTrace>, RenderError> {
        let shaded = self.rendered().shade(draw);
        let shader = PixelProgram {
            kernel: &draw.pixel.kernel,
            environment: &shaded.environment,
        };
        let call = shaded.call(draw, &draw.state, self.size());
        let mut fragments =
            cover(&call, self.size().into(), (x, y)).map_err(|error| refused(draw, error))?;
        let found = fragments.find(|fragment| fragment.primitive == primitive);
        Ok(found.map(|fragment| shader.trace(&fragment.batch, fragment.lane)))
    }
}

fn refused(draw: &PreparedDraw<'_>, error: crate::raster::DrawError) -> RenderError {
    RenderError::Draw {
        draw: draw.name.to_owned(),
        error,
    }
}

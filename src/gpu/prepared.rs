//! A frame that is drawn again and again.

use std::time::{Duration, Instant};

use super::picture::{COLOR_FORMAT, Depth, Picture};
use super::ready::Ready;
use super::renderer::{Frame, Planned, Steps, clear_bytes, pass_depth};
use super::{GpuError, Renderer};
use crate::scene::{Output, Scene};

/// The picture of a scene with everything on the device that is made once and not for each frame: textures, those of render
/// targets included, meshes, constants, pipelines, the buffers that are drawn into.
pub struct PreparedFrame<'r, 'd> {
    frame: Frame<'r, 'd>,
    ready: Vec<Ready>,
    /// None for a picture without pixels.
    picture: Option<Picture>,
    clear: [f64; 4],
}

impl<'d> Renderer<'d> {
    /// Draws the render targets that the picture of a scene needs, and puts on the device what the picture in this size in
    /// pixels is drawn with.
    ///
    /// # Errors
    /// As [`Self::render`].
    pub fn prepare_frame<'r>(
        &'r mut self,
        scene: &'r Scene,
        size: [u32; 2],
    ) -> Result<PreparedFrame<'r, 'd>, GpuError> {
        let mut passes = scene.passes(size);
        let last = passes.pop().filter(|pass| pass.output == Output::Picture);
        let mut frame = Frame::new(self, scene, size);
        frame.passes(&passes, None, &[], &|_| ())?;
        let mut prepared = PreparedFrame {
            frame,
            ready: Vec::new(),
            picture: None,
            clear: [0.0; 4],
        };
        if let Some(pass) = last.filter(|pass| !pass.size.contains(&0)) {
            let device = prepared.frame.renderer.device;
            let depth = pass_depth(device, &pass);
            let planned: Vec<_> = (pass.draws.iter())
                .map(|draw| Planned::plain(draw, &pass))
                .collect();
            let mut steps = Steps {
                done: 0,
                total: 0,
                progress: &|_| (),
            };
            let ready = (prepared.frame).ready(&pass, &planned, depth, &mut steps)?;
            prepared.ready = ready.into_iter().flatten().collect();
            let picture = Picture::new(device, pass.size, COLOR_FORMAT, depth, Depth::Dropped);
            prepared.picture = Some(picture);
            prepared.clear = clear_bytes(&pass);
            // Uploads wait for the next submission.
            device.queue.submit([]);
            device.wait()?;
        }
        Ok(prepared)
    }
}

impl PreparedFrame<'_, '_> {
    /// Draws the picture, and gives the time from the submission of its commands until the device has done them. Nothing is
    /// read back.
    ///
    /// # Errors
    /// What the device reports.
    pub fn draw(&self) -> Result<Duration, GpuError> {
        let device = self.frame.device();
        let mut encoder = device.device.create_command_encoder(&Default::default());
        if let Some(picture) = &self.picture {
            let mut commands = picture.begin(&mut encoder, Some(self.clear));
            (self.ready.iter()).for_each(|draw| draw.encode(&mut commands));
        }
        let commands = encoder.finish();
        let start = Instant::now();
        device.queue.submit([commands]);
        device.wait()?;
        Ok(start.elapsed())
    }
}

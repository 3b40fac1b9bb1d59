//! The registers of one pixel: the pixel shader cut after each instruction and run again.

use super::buffers::UniformArena;
use super::picture::{Depth, Picture, content, depth_format, floats, readback};
use super::{Frame, GpuError};
use crate::kernel::Slot;
use crate::raster::{ColorMask, Compare};
use crate::scene::PreparedDraw;
use crate::wgsl::{Shown, ShownPixels};

/// What the registers of a pixel held.
#[derive(Clone, Debug, PartialEq)]
pub struct PixelRegisters {
    /// One value for each register that was asked for.
    pub values: Vec<[f32; 4]>,
    /// Whether `texkill` discards the pixel.
    pub killed: bool,
}

/// The most registers of one call. More than any shader that Direct3D 8 takes has writes.
const MOST: usize = 512;

/// What is drawn over; no shader gives these four numbers.
pub(super) const BARE: [f32; 4] = [-1.5e38, 1.25e38, -1.125e38, 1.75e38];

impl Frame<'_, '_> {
    /// What registers hold at a pixel of the picture where one primitive of a draw covers it; none if the device covers
    /// the pixel by no part of that primitive.
    ///
    /// `draw` is one of the last of [`Scene::passes`](crate::scene::Scene::passes) for this frame's size; `wanted` names
    /// registers and how many instructions have run before each is looked at. For each the pixel shader is cut there and
    /// the primitive is drawn again, in place and size as in the picture, into 32-bit floats, without any test.
    ///
    /// # Errors
    /// [`GpuError::Limit`] on a device that cannot draw into 32-bit floats, and for more than 512 registers; and as
    /// [`Renderer::render`](super::Renderer::render).
    pub fn registers(
        &mut self,
        draw: &PreparedDraw<'_>,
        primitive: usize,
        pixel: [u32; 2],
        wanted: &[(Slot, usize)],
    ) -> Result<Option<PixelRegisters>, GpuError> {
        let (device, size) = (self.device(), self.size());
        if !device.adapter().float_targets || wanted.len() > MOST {
            let limit = match device.adapter().float_targets {
                true => format!("at most {MOST}"),
                false => "it cannot draw into 32-bit floats".into(),
            };
            return Err(GpuError::Limit {
                what: format!("{} registers", wanted.len()),
                limit,
            });
        }
        if pixel[0] >= size[0] || pixel[1] >= size[1] {
            return Ok(None);
        }
        let mut state = draw.state.clone();
        (state.blend.enable, state.stencil.enable) = (false, false);
        // A depth test of any other kind would need the draws before.
        (state.depth.enable, state.depth.write) = (true, false);
        state.depth.func = Compare::Always;
        state.color_mask = ColorMask::ALL;
        let formats = (
            wgpu::TextureFormat::Rgba32Float,
            depth_format(device, false),
        );
        let shown = |slot, instructions, pixels| Shown {
            slot,
            instructions,
            pixels,
        };
        let cuts = (wanted.iter()).map(|(slot, most)| shown(*slot, *most, ShownPixels::All));
        // The first tells whether the pixel is covered, the second whether it is discarded.
        let whole =
            [ShownPixels::All, ShownPixels::Kept].map(|pixels| shown(Slot::R0, usize::MAX, pixels));
        let mut arena = UniformArena::new(device);
        let drawings: Vec<_> = (whole.into_iter().chain(cuts))
            .map(|show| self.drawing(draw, &state, Some(show), size, formats, &mut arena))
            .collect::<Result<_, _>>()?;
        let uniforms = arena.upload(device);
        let picture = Picture::new(device, size, formats.0, formats.1, Depth::Dropped);
        let buffer = readback(device, 16 * drawings.len() as u64);
        let mut encoder = device.device.create_command_encoder(&Default::default());
        let corner = pixel.map(|at| at & !1);
        let [width, height] = [0, 1].map(|axis| (size[axis] - corner[axis]).min(2));
        for (number, drawing) in drawings.iter().enumerate() {
            let ready = self.prepare(draw, drawing, size, &uniforms)?;
            let part = [corner[0], corner[1], width, height];
            let Some(ready) = ready
                .and_then(|ready| ready.within(part))
                .and_then(|ready| ready.primitive(draw.topology, primitive))
            else {
                return Ok(None);
            };
            // Whatever covers the pixel writes it, so that only the first two need a bare one.
            let clear = (number < whole.len()).then_some(BARE.map(f64::from));
            let mut commands = picture.begin(&mut encoder, clear);
            ready.encode(&mut commands);
            drop(commands);
            picture.copy_pixel(&mut encoder, pixel, &buffer, 16 * number as u64);
        }
        device.queue.submit([encoder.finish()]);
        device.check()?;
        let values = floats(&content(device, &buffer)?);
        let [covered, colored, values @ ..] = values.as_slice() else {
            return Ok(None);
        };
        Ok((*covered != BARE).then(|| PixelRegisters {
            values: values.to_vec(),
            killed: *colored == BARE,
        }))
    }
}

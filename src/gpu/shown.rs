//! Pictures of registers: the draw whose register is shown goes into 32-bit floats, and what comes back becomes colours by
//! the same code as on the CPU.

use image::{Rgba, RgbaImage};

use super::picture::{COLOR_FORMAT, Depth, Picture, floats};
use super::ready::Ready;
use super::registers::BARE;
use super::renderer::{Frame, Planned, Steps, clear_bytes, image, pass_depth};
use super::{Device, GpuError};
use crate::raster::{Mark, MarkSet, RegisterPicture, StencilOp};
use crate::scene::{Pass, Show};
use crate::wgsl::{Shown, ShownPixels};

/// What registers are drawn into.
const FLOATS: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;

/// The place of a pixel, and what a register holds there.
type Content = ([u32; 2], [f32; 4]);

impl Frame<'_, '_> {
    /// Draws a pass with a register of one of its draws in place of the colour; gives the marks that occurred, too.
    ///
    /// # Errors
    /// [`GpuError::Limit`] on a device that cannot draw into 32-bit floats; and as
    /// [`Renderer::render`](super::Renderer::render).
    pub(super) fn register_picture(
        &mut self,
        pass: &Pass<'_>,
        place: usize,
        register: &RegisterPicture,
        steps: &mut Steps<'_>,
    ) -> Result<(RgbaImage, MarkSet), GpuError> {
        let device = self.device();
        let [width, height] = pass.size;
        let Some(draw) = pass.draws.get(place).filter(|_| width > 0 && height > 0) else {
            return Ok((RgbaImage::new(width, height), MarkSet::default()));
        };
        if !device.adapter().float_targets {
            return Err(GpuError::Limit {
                what: "registers".into(),
                limit: "it cannot draw into 32-bit floats".into(),
            });
        }
        let shown = |pixels| Shown {
            slot: register.slot,
            instructions: register.instructions,
            pixels,
        };
        let mut planned: Vec<_> = (pass.draws.iter())
            .map(|draw| Planned::plain(draw, pass))
            .collect();
        let state = Show::state(&draw.state);
        let registers = Planned {
            draw,
            state: state.clone(),
            show: Some(shown(ShownPixels::Kept)),
            format: FLOATS,
        };
        planned.splice(place..=place, [registers]);
        let kernel = &draw.pixel.kernel;
        if register.killed && kernel.kills() {
            // Tested, but without a trace in depth and stencil.
            let mut state = state;
            state.depth.write = false;
            let stencil = &mut state.stencil;
            (stencil.pass, stencil.fail, stencil.depth_fail) =
                (StencilOp::Keep, StencilOp::Keep, StencilOp::Keep);
            planned.push(Planned {
                draw,
                state,
                show: Some(shown(ShownPixels::Discarded)),
                format: FLOATS,
            });
        }
        let depth = pass_depth(device, pass);
        let ready = self.ready(pass, &planned, depth, steps)?;
        let (scene, discarded) = ready.split_at(pass.draws.len());
        let (before, after) = scene.split_at(place);
        let Some((own, after)) = after.split_first() else {
            return Ok((RgbaImage::new(width, height), MarkSet::default()));
        };

        let holds = pass.surface.stored();
        let picture = Picture::new(device, pass.size, COLOR_FORMAT, depth, Depth::Kept)
            .clearing_to(holds.depth, holds.stencil);
        let mut encoder = device.device.create_command_encoder(&Default::default());
        let mut commands = picture.begin(&mut encoder, Some(clear_bytes(pass)));
        (before.iter().flatten()).for_each(|draw| draw.encode(&mut commands));
        drop(commands);
        let (bytes, _) = picture.read(device, encoder)?;
        let mut image = image(pass.size, bytes)?;

        let mut marks = MarkSet::default();
        let written = register.written(kernel);
        for (place, content) in drawn(device, &picture, own.as_ref())? {
            let (color, mark) = register.look.color(content, written, place);
            mark.into_iter().for_each(|mark| marks.insert(mark));
            set(&mut image, place, color);
        }
        for ready in discarded {
            for (place, _) in drawn(device, &picture, ready.as_ref())? {
                marks.insert(Mark::Killed);
                set(&mut image, place, Mark::Killed.color());
            }
        }
        if after.iter().flatten().next().is_some() {
            picture.fill(device, image.as_raw());
            let mut encoder = device.device.create_command_encoder(&Default::default());
            let mut commands = picture.resume(&mut encoder, None);
            (after.iter().flatten()).for_each(|draw| draw.encode(&mut commands));
            drop(commands);
            let (bytes, _) = picture.read(device, encoder)?;
            image = super::renderer::image(pass.size, bytes)?;
        }
        Ok((image, marks))
    }
}

fn set(image: &mut RgbaImage, [x, y]: [u32; 2], [r, g, b]: [u8; 3]) {
    if let Some(pixel) = image.get_pixel_mut_checked(x, y) {
        *pixel = Rgba([r, g, b, 255]);
    }
}

/// What a draw leaves of registers at the pixels that it covers, over the depth of a picture; nothing if it draws nothing.
fn drawn(
    device: &Device,
    picture: &Picture,
    ready: Option<&Ready>,
) -> Result<Vec<Content>, GpuError> {
    let Some(ready) = ready else {
        return Ok(Vec::new());
    };
    let registers = picture.with_color(device, FLOATS);
    let mut encoder = device.device.create_command_encoder(&Default::default());
    let mut commands = registers.resume(&mut encoder, Some(BARE.map(f64::from)));
    ready.encode(&mut commands);
    drop(commands);
    let (bytes, _) = registers.read(device, encoder)?;
    let [width, _] = registers.size();
    let place = |number: u32| [number % width, number / width];
    let texels = (0..).map(place).zip(floats(&bytes));
    Ok(texels.filter(|(_, content)| *content != BARE).collect())
}

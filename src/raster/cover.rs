//! For a debugger: what reaches one pixel.

use super::assemble::Primitives;
use super::interpolate::{Interpolator, depths};
use super::pixel::{PixelBatch, PixelInputs};
use super::setup::{Room, Setup, Stage};
use super::{DrawCall, DrawError};

/// One primitive at one pixel.
#[derive(Debug, Clone)]
pub struct Fragment {
    /// Which primitive of the draw call, from 0.
    pub primitive: usize,
    /// Its vertices, in the order of the primitive. A line repeats its last one, a point its only one.
    pub vertices: [u32; 3],
    /// All inputs of the quad that the pixel is in, to be shaded as it is.
    pub batch: Box<PixelBatch>,
    /// The pixel's own lane in the batch, 0 to 3.
    pub lane: usize,
}

/// The primitives of a draw call, onto a target of a size in pixels, that cover a pixel; in drawing order, before any
/// depth test. They are looked for as the iterator goes on.
///
/// Set-up, coverage and interpolation are those of [`draw`](super::draw), so the inputs agree to the bit.
///
/// # Errors
///
/// As for [`draw`](super::draw).
pub fn cover<'a>(
    call: &DrawCall<'a>,
    size: (u32, u32),
    pixel: (u32, u32),
) -> Result<impl Iterator<Item = Fragment> + 'a, DrawError> {
    let primitives = Primitives::new(call.topology, call.vertices.len(), call.indices)?;
    let stage = Stage::new(*call, size)?;
    let interpolator = Interpolator {
        vertices: call.vertices,
        inputs: PixelInputs::ALL,
        shade: call.state.shade,
        fog: true,
    };
    // Beyond what an integer holds there is no target, so nothing will be found.
    let [x, y] = [pixel.0, pixel.1].map(|v| i32::try_from(v).unwrap_or(i32::MAX));
    let mut room = Room::default();
    let fragments = (0..primitives.len()).flat_map(move |primitive| {
        let vertices = primitives.get(primitive);
        let mut shapes = Vec::new();
        stage.primitive(vertices, &mut room, &mut shapes);
        shapes.retain(|shape| shape.bounds.contains(x, y) && shape.shape.covers(x, y));
        shapes.into_iter().map(move |shape| {
            let (batch, lane) = inputs(&interpolator, &shape, x, y);
            Fragment {
                primitive,
                vertices,
                batch,
                lane,
            }
        })
    });
    Ok(fragments)
}

/// The quad around a pixel, and the pixel's lane in it.
fn inputs(interpolator: &Interpolator, shape: &Setup, x: i32, y: i32) -> (Box<PixelBatch>, usize) {
    let (left, top) = (x & !1, y & !1);
    let mask = (0..4).fold(0, |mask, i| {
        let (x, y) = (left + (i & 1), top + (i >> 1));
        mask | u8::from(shape.bounds.contains(x, y) && shape.shape.covers(x, y)) << i
    });
    let mut batch = Box::new(PixelBatch::empty());
    batch.place(0, left, top, mask, &depths(shape, left, top));
    batch.quads = 1;
    interpolator.fill(&mut batch, |_| shape);
    (batch, ((y & 1) * 2 + (x & 1)) as usize)
}

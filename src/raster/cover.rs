//! For a debugger: what reaches one pixel.

use std::rc::Rc;

use super::assemble::Primitives;
use super::interpolate::{Interpolator, Shares, depths};
use super::pixel::{PixelBatch, PixelInputs};
use super::scan::Bounds;
use super::setup::{Room, Setup, Stage};
use super::state::ShadeMode;
use super::{DrawCall, DrawError};

/// One primitive at one pixel.
#[derive(Debug, Clone, PartialEq)]
pub struct Fragment {
    /// Which primitive of the draw call, from 0.
    pub primitive: usize,
    /// Which of the primitive's parts that cover the pixel, from 0. Only of triangles that are drawn as edges or corners,
    /// whose parts meet, can there be more than one.
    pub part: usize,
    /// Its vertices, in the order of the primitive. A line repeats its last one, a point its only one.
    pub vertices: [u32; 3],
    /// Where these are on the screen; `None` for one that clipping cuts off.
    pub screen: [Option<ScreenPosition>; 3],
    /// How the inputs follow from those of the vertices.
    pub interpolation: Interpolation,
    /// All inputs of the quad that the pixel is in, to be shaded as it is. [`PixelBatch::live`] says which of its pixels
    /// the same part covers; the others are helpers.
    pub batch: Box<PixelBatch>,
    /// The pixel's own lane in the batch, 0 to 3.
    pub lane: usize,
}

impl Fragment {
    /// Which pixels of the quad are helpers: shaded only because differences between neighbours choose the mip level.
    pub fn helpers(&self) -> [bool; 4] {
        std::array::from_fn(|lane| self.batch.live.get(lane) == Some(&false))
    }
}

/// A vertex on the screen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ScreenPosition {
    /// The column, to the right, rounded to 1/8192 as coverage and interpolation see it; pixel centres are whole numbers.
    pub x: f32,
    /// The row, downwards, rounded in the same way.
    pub y: f32,
    /// The depth within the viewport's range, without the bias.
    pub z: f32,
    /// The w of the position.
    pub w: f32,
}

/// How a quad's inputs follow from those of vertices.
///
/// An attribute that is a0, a1 and a2 at [`Self::vertices`] is `a0 + s1 · (a1 - a0) + s2 · (a2 - a0)` at a pixel, in
/// this order and with every product and sum rounded, s1 and s2 being the pixel's [`Self::shares`]. Coordinate sets are
/// just that. Colours and fog are taken into 0 to 1 at the vertices and again at the pixel; NaN becomes 0 in a colour and 1
/// in the fog of a vertex.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interpolation {
    /// The vertices whose attributes are interpolated: those of the primitive; in a point three times the same one.
    pub vertices: [u32; 3],
    /// Under flat shading: the vertex whose colours all pixels have. Coordinates and fog are interpolated all the same.
    pub provoking: Option<u32>,
    /// Whether it is a point sprite: every coordinate set is then (s1, s2, 0, 0), whatever the vertices hold, and the
    /// shares go from 0 to 1 across and down the point.
    pub sprite: bool,
    /// The perspective-correct shares of the second and of the third vertex, each for the four pixels of the quad. The
    /// first vertex has the rest to 1. At helpers beside the primitive they may be negative or greater than 1.
    pub shares: [[f32; 4]; 2],
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
    // Beyond what an integer holds there is no target, so nothing will be found.
    let [x, y] = [pixel.0, pixel.1].map(|v| i32::try_from(v).unwrap_or(i32::MAX));
    let quad = (x & !1, y & !1);
    // Set-up ends early for what lies outside of the scissor, and leaves the same of what does not.
    let stage = Stage::new(*call, size)?.within(&Bounds {
        x0: quad.0,
        y0: quad.1,
        x1: quad.0.saturating_add(2),
        y1: quad.1.saturating_add(2),
    });
    let shade = call.state.shade;
    let interpolator = Rc::new(Interpolator::new(
        call.vertices,
        &PixelInputs::ALL,
        shade,
        true,
    ));
    let mut room = Room::default();
    let fragments = (0..primitives.len()).flat_map(move |primitive| {
        let vertices = primitives.get(primitive);
        let mut shapes = Vec::new();
        stage.primitive(vertices, &mut room, &mut shapes);
        shapes.retain(|shape| shape.bounds.contains(x, y) && shape.shape.covers(x, y));
        let interpolator = Rc::clone(&interpolator);
        let screen = match shapes.is_empty() {
            true => [None; 3],
            false => std::array::from_fn(|corner| room.screen(corner)),
        };
        (shapes.into_iter().enumerate()).map(move |(part, shape)| {
            let (batch, shares) = inputs(&interpolator, &shape, quad);
            Fragment {
                primitive,
                part,
                vertices,
                screen,
                interpolation: Interpolation {
                    vertices: shape.owner.vertices,
                    provoking: (shade == ShadeMode::Flat).then_some(shape.owner.provoking),
                    sprite: shape.owner.sprite,
                    shares,
                },
                batch,
                lane: ((y & 1) * 2 + (x & 1)) as usize,
            }
        })
    });
    Ok(fragments)
}

/// The inputs of a quad, and the shares of the vertices there.
fn inputs(
    interpolator: &Interpolator,
    shape: &Setup,
    (left, top): (i32, i32),
) -> (Box<PixelBatch>, [[f32; 4]; 2]) {
    let mask = (0..4).fold(0, |mask, i| {
        let (x, y) = (left + (i & 1), top + (i >> 1));
        mask | u8::from(shape.bounds.contains(x, y) && shape.shape.covers(x, y)) << i
    });
    let quantities = shape.planes.quad(left, top);
    let (mut batch, mut shares) = (Box::new(PixelBatch::empty()), Shares::empty());
    batch.place(0, left, top, mask, &depths(&quantities));
    shares.begin(shape.owner);
    shares.place(0, &shape.planes, &quantities);
    batch.quads = 1;
    interpolator.fill(&mut batch, &mut shares);
    (batch, shares.of_quad(0))
}

//! The loop over everything: primitives in drawing order are sorted into the tiles they touch, then each tile is drawn on
//! its own, on all cores if the feature `parallel` is on. Since a pixel lies in one tile, and a tile keeps the order, the
//! picture does not depend on how many cores there are.

#[cfg(feature = "parallel")]
use rayon::prelude::*;

use super::assemble::Primitives;
use super::interpolate::{Interpolator, depths};
use super::merger::{DepthTiming, depth_only, depth_stencil, merge};
use super::pixel::{PixelBatch, PixelResult, PixelShader, QUADS};
use super::record::Nobody;
use super::scan::Bounds;
use super::setup::{Room, Setup, Stage};
use super::state::FogMode;
use super::target::{ColorFormat, TILE, Target, Tile};
use super::{DrawCall, DrawError};
use crate::simd::{Simd, Task};

/// Primitives that are set up before any of them is drawn. Bounds the memory of a draw call of any length.
const CHUNK: usize = 1 << 14;

/// Primitives that one core sets up at a time. A triangle becomes at most 16 lines: each of the seven planes of the view and
/// the six of the user's adds one to its corners.
const PIECE: usize = 1 << 10;

/// Entries of all tiles' lists together, after which the tiles are drawn.
const MOST_ENTRIES: usize = 1 << 20;

/// What a draw call did. Independent of the number of cores.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Statistics {
    /// Primitives given.
    pub primitives: u64,
    /// Primitives of which something was left after clipping and culling that may cover pixels.
    pub drawn: u64,
    /// Quads shaded.
    pub quads: u64,
    /// Covered pixels shaded, so without those that were rejected before.
    pub shaded: u64,
    /// Pixels that passed every test, as often as they did.
    pub written: u64,
}

impl std::ops::Add for Statistics {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            primitives: self.primitives + other.primitives,
            drawn: self.drawn + other.drawn,
            quads: self.quads + other.quads,
            shaded: self.shaded + other.shaded,
            written: self.written + other.written,
        }
    }
}

/// Draws.
///
/// Memory beyond the target is bounded by a constant. Primitives with positions that are not finite are left out.
///
/// # Errors
///
/// [`DrawError`] for an index outside of the vertices and for a viewport whose depths are not finite; nothing is drawn
/// then.
pub fn draw(
    target: &mut Target,
    call: &DrawCall,
    shader: &dyn PixelShader,
) -> Result<Statistics, DrawError> {
    let primitives = Primitives::new(call.topology, call.vertices.len(), call.indices)?;
    let stage = Stage::new(*call, (target.width(), target.height()))?;
    let mut statistics = Statistics {
        primitives: primitives.len() as u64,
        ..Statistics::default()
    };
    if stage.scissor.intersect(&stage.scissor).is_none() {
        return Ok(statistics);
    }
    let vertex_fog = call.state.fog.enable && call.state.fog.table == FogMode::None;
    let painter = Painter {
        stage: &stage,
        shader,
        interpolator: Interpolator {
            vertices: call.vertices,
            inputs: shader.inputs(),
            shade: call.state.shade,
            fog: vertex_fog,
        },
        timing: DepthTiming::of(call.state, shader.writes_depth(), shader.may_kill()),
        format: target.format(),
        simd: Simd::chosen(),
    };
    let across = target.tiles_across();
    let tiles = target.tiles_mut();
    let mut lists: Vec<Vec<ShapeNumber>> = vec![Vec::new(); tiles.len()];
    for first in (0..primitives.len()).step_by(CHUNK) {
        let chunk = first..primitives.len().min(first + CHUNK);
        let (pieces, drawn) = set_up(&stage, &primitives, chunk);
        let shapes = Shapes(pieces);
        statistics.drawn += drawn;
        let mut entries = 0;
        for (number, shape) in shapes.numbered() {
            entries += sort_in(&mut lists, across, number, shape);
            if entries > MOST_ENTRIES {
                statistics = statistics + paint_all(&painter, tiles, across, &mut lists, &shapes);
                entries = 0;
            }
        }
        statistics = statistics + paint_all(&painter, tiles, across, &mut lists, &shapes);
    }
    Ok(statistics)
}

/// The shapes of some primitives in drawing order, piece by piece, and how many of the primitives have any.
fn set_up(
    stage: &Stage,
    primitives: &Primitives,
    range: std::ops::Range<usize>,
) -> (Vec<Vec<Setup>>, u64) {
    let piece = |first: usize| {
        let mut shapes = Vec::with_capacity(PIECE);
        let (mut room, mut drawn) = (Room::default(), 0);
        for i in first..range.end.min(first + PIECE) {
            let before = shapes.len();
            stage.primitive(primitives.get(i), &mut room, &mut shapes);
            drawn += u64::from(shapes.len() > before);
        }
        (shapes, drawn)
    };
    let firsts: Vec<usize> = range.clone().step_by(PIECE).collect();
    #[cfg(feature = "parallel")]
    let pieces: Vec<_> = firsts.into_par_iter().map(piece).collect();
    #[cfg(not(feature = "parallel"))]
    let pieces: Vec<_> = firsts.into_iter().map(piece).collect();
    let drawn = pieces.iter().map(|(_, drawn)| drawn).sum();
    (
        pieces.into_iter().map(|(shapes, _)| shapes).collect(),
        drawn,
    )
}

/// The shapes of a part of a draw call.
struct Shapes(Vec<Vec<Setup>>);

/// Which of them: the piece and the place in it.
#[derive(Clone, Copy, Default)]
struct ShapeNumber {
    piece: u16,
    place: u16,
}

impl Shapes {
    #[inline(always)]
    fn get(&self, number: ShapeNumber) -> &Setup {
        &self.0[usize::from(number.piece)][usize::from(number.place)]
    }

    fn numbered(&self) -> impl Iterator<Item = (ShapeNumber, &Setup)> {
        (0..).zip(&self.0).flat_map(|(piece, shapes)| {
            (0..)
                .zip(shapes)
                .map(move |(place, shape)| (ShapeNumber { piece, place }, shape))
        })
    }
}

/// Adds a shape to the lists of the tiles that it may touch; returns to how many.
fn sort_in(
    lists: &mut [Vec<ShapeNumber>],
    across: u32,
    number: ShapeNumber,
    shape: &Setup,
) -> usize {
    let side = TILE as i32;
    let Bounds { x0, y0, x1, y1 } = shape.bounds;
    let mut entries = 0;
    for tile_y in y0 / side..=(y1 - 1) / side {
        for tile_x in x0 / side..=(x1 - 1) / side {
            if shape.shape.touches(tile_x * side, tile_y * side, side)
                && let Some(list) =
                    lists.get_mut(tile_y as usize * across as usize + tile_x as usize)
            {
                list.push(number);
                entries += 1;
            }
        }
    }
    entries
}

/// Draws the lists of all tiles and empties them.
fn paint_all(
    painter: &Painter,
    tiles: &mut [Tile],
    across: u32,
    lists: &mut [Vec<ShapeNumber>],
    shapes: &Shapes,
) -> Statistics {
    let paint = |(number, (tile, list)): (usize, (&mut Tile, &mut Vec<ShapeNumber>))| {
        if list.is_empty() {
            return Statistics::default();
        }
        let place = |n: usize| n as i32 * TILE as i32;
        let (x0, y0) = (
            place(number % across as usize),
            place(number / across as usize),
        );
        let area = Bounds {
            x0,
            y0,
            x1: x0 + TILE as i32,
            y1: y0 + TILE as i32,
        };
        let statistics = painter.simd.run(Paint {
            painter,
            tile,
            area,
            list,
            shapes,
        });
        list.clear();
        statistics
    };
    #[cfg(feature = "parallel")]
    return tiles
        .par_iter_mut()
        .zip(lists)
        .enumerate()
        .with_max_len(2)
        .map(paint)
        .reduce(Statistics::default, |a, b| a + b);
    #[cfg(not(feature = "parallel"))]
    return tiles
        .iter_mut()
        .zip(lists)
        .enumerate()
        .map(paint)
        .fold(Statistics::default(), |a, b| a + b);
}

/// What drawing a tile needs to know of the draw call.
struct Painter<'a> {
    stage: &'a Stage<'a>,
    shader: &'a dyn PixelShader,
    interpolator: Interpolator<'a>,
    timing: DepthTiming,
    format: ColorFormat,
    simd: Simd,
}

/// A tile to be painted, as something that is compiled for each set of instructions.
struct Paint<'a, 'b> {
    painter: &'a Painter<'b>,
    tile: &'a mut Tile,
    area: Bounds,
    list: &'a [ShapeNumber],
    shapes: &'a Shapes,
}

impl Task for Paint<'_, '_> {
    type Output = Statistics;

    #[inline(always)]
    fn run(self) -> Statistics {
        let mut brush = Brush {
            painter: self.painter,
            tile: self.tile,
            shapes: self.shapes,
            batch: PixelBatch::empty(),
            owners: [ShapeNumber::default(); QUADS],
            shaded: PixelResult::new(),
            statistics: Statistics::default(),
        };
        let mut quads: Vec<(i32, i32, u8)> = Vec::new();
        for &number in self.list {
            let shape = self.shapes.get(number);
            if let Some(bounds) = shape.bounds.intersect(&self.area) {
                quads.clear();
                (shape.shape).scan(&bounds, |x, y, mask| quads.push((x, y, mask)));
                for &(x, y, mask) in &quads {
                    brush.quad(number, x, y, mask);
                }
            }
        }
        brush.flush();
        brush.statistics
    }
}

/// Collects quads of one tile and draws them a batch at a time.
struct Brush<'a, 'b> {
    painter: &'a Painter<'b>,
    tile: &'a mut Tile,
    shapes: &'a Shapes,
    batch: PixelBatch,
    /// The shape of each quad in the batch.
    owners: [ShapeNumber; QUADS],
    shaded: PixelResult,
    statistics: Statistics,
}

impl Brush<'_, '_> {
    #[inline(always)]
    fn quad(&mut self, number: ShapeNumber, x: i32, y: i32, mask: u8) {
        let state = self.painter.stage.call.state;
        let z = depths(self.shapes.get(number), x, y);
        let mask = match self.painter.timing {
            DepthTiming::Early => depth_stencil(self.tile, state, (x, y), &z, mask, &mut Nobody),
            DepthTiming::Late { reject: true, .. } => depth_only(self.tile, state, x, y, &z, mask),
            DepthTiming::Late { .. } => mask,
        };
        if mask == 0 {
            return;
        }
        // Before, not behind: there is one place only where a batch is drawn while quads come.
        if self.batch.quads == QUADS {
            self.flush();
        }
        let quad = self.batch.quads;
        self.owners[quad] = number;
        self.batch.place(quad, x, y, mask, &z);
        self.batch.quads += 1;
        self.statistics.shaded += u64::from(mask.count_ones());
    }

    #[inline(always)]
    fn flush(&mut self) {
        if self.batch.quads == 0 {
            return;
        }
        let painter = self.painter;
        let (owners, shapes) = (&self.owners, self.shapes);
        painter
            .interpolator
            .fill(&mut self.batch, |quad| shapes.get(owners[quad]));
        self.shaded.killed.fill(false);
        painter.shader.shade(&self.batch, &mut self.shaded);
        self.statistics.quads += self.batch.quads as u64;
        self.statistics.written += merge(
            self.tile,
            painter.format,
            painter.stage.call.state,
            painter.timing,
            &self.batch,
            &self.shaded,
            &mut Nobody,
        );
        self.batch.quads = 0;
    }
}

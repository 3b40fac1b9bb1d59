//! The loop over everything: primitives in drawing order are sorted into the tiles they touch, then each tile is drawn on
//! its own, on all cores if the feature `parallel` is on. Since a pixel lies in one tile, and a tile keeps the order, the
//! picture does not depend on how many cores there are.

use std::cell::Cell;

#[cfg(feature = "parallel")]
use rayon::prelude::*;

use super::assemble::Primitives;
use super::bins::{Bins, Sorter};
use super::interpolate::{Interpolator, Shares, block_depths, depths};
use super::merger::{DepthTiming, depth_stencil, merge};
use super::pixel::{LANES, PixelBatch, PixelResult, PixelShader, QUADS};
use super::plain::{bits, depth_only, depth_stencil_block, number_in_tile};
use super::record::Nobody;
use super::scan::{Bounds, Covered};
use super::screen::Screen;
use super::setup::{Owner, Planes, Quantities, Stage};
use super::state::{FillMode, FogMode};
use super::target::{BLOCK, ColorFormat, IN_BLOCK, TILE, Target, Tile};
use super::{DrawCall, DrawError, Topology};
use crate::simd::{Simd, Task};

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
/// Memory beyond the target is bounded by a constant and 26 bytes a vertex. Primitives with positions that are not finite are left out.
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
        interpolator: Interpolator::new(
            call.vertices,
            &shader.inputs(),
            call.state.shade,
            vertex_fog,
        ),
        timing: DepthTiming::of(call.state, shader.writes_depth(), shader.may_kill()),
        format: target.format(),
        simd: Simd::chosen(),
    };
    let fills = matches!(
        call.topology,
        Topology::TriangleList | Topology::TriangleStrip | Topology::TriangleFan
    ) && call.state.fill == FillMode::Solid;
    let screen = fills.then(|| Screen::new(&stage, call.vertices, painter.simd));
    let across = target.tiles_across() as usize;
    let tiles = target.tiles_mut();
    let sorter = Sorter {
        stage: &stage,
        primitives: &primitives,
        screen: screen.as_ref(),
        across,
        tiles: tiles.len(),
    };
    let mut first = 0;
    while first < primitives.len() {
        let bins = Bins::new(&sorter, first);
        statistics.drawn += bins.drawn();
        statistics = statistics + paint_all(&painter, tiles, &sorter, &bins);
        first = bins.end().unwrap_or(usize::MAX);
    }
    Ok(statistics)
}

/// Draws what was sorted into all tiles.
fn paint_all(painter: &Painter, tiles: &mut [Tile], sorter: &Sorter, bins: &Bins) -> Statistics {
    let paint = |(number, tile): (usize, &mut Tile)| {
        if bins.is_empty(number) {
            return Statistics::default();
        }
        let place = |n: usize| n as i32 * TILE as i32;
        let (x0, y0) = (place(number % sorter.across), place(number / sorter.across));
        let area = Bounds {
            x0,
            y0,
            x1: x0 + TILE as i32,
            y1: y0 + TILE as i32,
        };
        painter.simd.run(Paint {
            painter,
            tile: tile.settled(),
            number,
            area,
            sorter,
            bins,
        })
    };
    #[cfg(feature = "parallel")]
    return tiles
        .par_iter_mut()
        .enumerate()
        .with_max_len(2)
        .map(paint)
        .reduce(Statistics::default, |a, b| a + b);
    #[cfg(not(feature = "parallel"))]
    return tiles
        .iter_mut()
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
    number: usize,
    area: Bounds,
    sorter: &'a Sorter<'b>,
    bins: &'a Bins,
}

impl Task for Paint<'_, '_> {
    type Output = Statistics;

    #[inline(always)]
    fn run(self) -> Statistics {
        // Taken away, so that a shader that draws by itself finds another pair.
        let mut loads = LOADS.take().unwrap_or_default();
        let [pending, block] = &mut *loads;
        let mut brush = Brush {
            painter: self.painter,
            tile: self.tile,
            pending,
            waiting: 0,
            block,
            shaded: PixelResult::new(),
            statistics: Statistics::default(),
        };
        let stage = self.painter.stage;
        let mut covered = Covered::default();
        for (piece, entries) in self.bins.of(self.number) {
            for entry in entries {
                let Some(found) = piece.find(self.sorter, *entry) else {
                    continue;
                };
                let Some(bounds) = found.bounds().intersect(&self.area) else {
                    continue;
                };
                covered.clear();
                (found.shape()).scan(&bounds, &stage.scissor, &mut covered);
                if covered.is_empty() {
                    continue;
                }
                brush.shape(found.owner(), &found.planes(stage), &covered);
            }
        }
        brush.flush();
        let statistics = brush.statistics;
        LOADS.set(Some(loads));
        statistics
    }
}

thread_local! {
    /// What a tile is painted with, kept for the next: to fill 60 KB with nothing takes as long as many a tile.
    static LOADS: Cell<Option<Box<[Load; 2]>>> = const { Cell::new(None) };
}

/// Pixels on their way to the shader.
struct Load {
    batch: PixelBatch,
    shares: Shares,
}

impl Default for Load {
    fn default() -> Self {
        Self {
            batch: PixelBatch::empty(),
            shares: Shares::empty(),
        }
    }
}

/// Draws the shapes of one tile a batch at a time: whole blocks at once, other quads as soon as there are enough.
struct Brush<'a, 'b> {
    painter: &'a Painter<'b>,
    tile: &'a mut Tile,
    /// Quads that wait for others.
    pending: &'a mut Load,
    /// The blocks of the tile in which they lie: bit i is block i.
    waiting: u64,
    /// Where blocks come and go.
    block: &'a mut Load,
    shaded: PixelResult,
    statistics: Statistics,
}

const _: () = assert!((TILE / BLOCK).pow(2) <= u64::BITS);

/// The bit of [`Brush::waiting`] for the block around a pixel.
#[inline(always)]
fn bit_of_block(x: i32, y: i32) -> u64 {
    1 << number_in_tile::<LANES>(x, y)
}

impl Brush<'_, '_> {
    /// Draws what is covered of a shape. Its blocks come first: none of its quads lies in them.
    #[inline(always)]
    fn shape(&mut self, owner: Owner, planes: &Planes, covered: &Covered) {
        if !covered.blocks.is_empty() {
            (self.painter.interpolator).begin_blocks(&owner, &mut self.block.shares);
        }
        self.pending.shares.begin(owner);
        for &(x, y) in &covered.blocks {
            self.block(planes, x, y);
        }
        for &(x, y, mask) in &covered.quads {
            self.quad(planes, x, y, mask);
        }
    }

    #[inline(always)]
    fn block(&mut self, planes: &Planes, x: i32, y: i32) {
        let state = self.painter.stage.call.state;
        let z = block_depths(planes, x, y);
        let live = match self.painter.timing {
            DepthTiming::Early => depth_stencil_block(self.tile, state, (x, y), &z),
            DepthTiming::Late { reject: true, .. } => depth_only(self.tile, state, (x, y), &z),
            DepthTiming::Late { .. } => [true; LANES],
        };
        let mut pixels = LANES as u32;
        if live != [true; LANES] {
            let masks: [u8; QUADS] = std::array::from_fn(|quad| bits(&live.as_chunks().0[quad]));
            if masks.contains(&0) {
                // Quads of which nothing is left are not shaded.
                for (quad, mask) in masks.into_iter().enumerate().filter(|(_, mask)| *mask != 0) {
                    let (x, y) = (x + IN_BLOCK[0][4 * quad], y + IN_BLOCK[1][4 * quad]);
                    self.keep(planes, (x, y), mask, &planes.quad(x, y));
                }
                return;
            }
            pixels = masks.into_iter().map(u8::count_ones).sum();
        }
        if self.waiting & bit_of_block(x, y) != 0 {
            // Of earlier shapes, which come first.
            self.flush();
        }
        self.block.batch.place_block(x, y, live, &z);
        self.block.shares.place_block(planes, x, y);
        self.statistics.shaded += u64::from(pixels);
        self.statistics.quads += QUADS as u64;
        self.statistics.written += draw_load(self.painter, self.tile, self.block, &mut self.shaded);
    }

    #[inline(always)]
    fn quad(&mut self, planes: &Planes, x: i32, y: i32, mask: u8) {
        let state = self.painter.stage.call.state;
        let quantities = planes.quad(x, y);
        let z = depths(&quantities);
        let mask = match self.painter.timing {
            DepthTiming::Early => depth_stencil(self.tile, state, (x, y), &z, mask, &mut Nobody),
            DepthTiming::Late { reject: true, .. } => {
                bits(&depth_only(self.tile, state, (x, y), &z)) & mask
            }
            DepthTiming::Late { .. } => mask,
        };
        self.keep(planes, (x, y), mask, &quantities);
    }

    /// Lets the pixels in `mask` wait to be shaded.
    #[inline(always)]
    fn keep(&mut self, planes: &Planes, (x, y): (i32, i32), mask: u8, quantities: &Quantities) {
        if mask == 0 {
            return;
        }
        // Before, not behind: a quad that comes last is drawn with the batch.
        if self.pending.batch.quads == QUADS {
            self.flush();
        }
        let Load { batch, shares } = &mut *self.pending;
        let quad = batch.quads;
        batch.place(quad, x, y, mask, &depths(quantities));
        shares.place(quad, planes, quantities);
        batch.quads += 1;
        self.waiting |= bit_of_block(x, y);
        self.statistics.shaded += u64::from(mask.count_ones());
    }

    /// Draws the quads that wait.
    #[inline(always)]
    fn flush(&mut self) {
        if self.pending.batch.quads == 0 {
            return;
        }
        self.statistics.quads += self.pending.batch.quads as u64;
        self.statistics.written +=
            draw_load(self.painter, self.tile, self.pending, &mut self.shaded);
        self.pending.batch.quads = 0;
        self.waiting = 0;
    }
}

/// Shades a batch and puts it into its tile. Returns how many pixels were written.
#[inline(always)]
fn draw_load(painter: &Painter, tile: &mut Tile, load: &mut Load, shaded: &mut PixelResult) -> u64 {
    let finish = Finish {
        painter,
        tile,
        load,
        shaded,
    };
    // One function for all who call it, instead of a copy in each.
    painter.simd.run(finish)
}

/// A batch that is in its place, as something that is compiled for each set of instructions.
struct Finish<'a, 'b> {
    painter: &'a Painter<'b>,
    tile: &'a mut Tile,
    load: &'a mut Load,
    shaded: &'a mut PixelResult,
}

impl Task for Finish<'_, '_> {
    type Output = u64;

    #[inline(always)]
    fn run(self) -> u64 {
        let Load { batch, shares } = self.load;
        let painter = self.painter;
        (painter.interpolator).fill(batch, shares);
        self.shaded.killed.fill(false);
        painter.shader.shade(batch, self.shaded);
        merge(
            self.tile,
            painter.format,
            painter.stage.call.state,
            painter.timing,
            batch,
            self.shaded,
            &mut Nobody,
        )
    }
}

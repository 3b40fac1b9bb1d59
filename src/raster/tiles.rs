//! The loop over everything: primitives in drawing order are sorted into the tiles they touch, then each tile is drawn on
//! its own, on all cores if the feature `parallel` is on. Since a pixel lies in one tile, and a tile keeps the order, the
//! picture does not depend on how many cores there are.

#[cfg(feature = "parallel")]
use rayon::prelude::*;

use super::assemble::Primitives;
use super::bins::{Bins, Sorter};
use super::interpolate::{Interpolator, Shares, depths};
use super::merger::{DepthTiming, depth_only, depth_stencil, merge};
use super::pixel::{PixelBatch, PixelResult, PixelShader, QUADS};
use super::record::Nobody;
use super::scan::Bounds;
use super::screen::Screen;
use super::setup::{Planes, Stage};
use super::state::{FillMode, FogMode};
use super::target::{ColorFormat, TILE, Target, Tile};
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
        let mut brush = Brush {
            painter: self.painter,
            tile: self.tile,
            batch: PixelBatch::empty(),
            shares: Shares::empty(),
            shaded: PixelResult::new(),
            statistics: Statistics::default(),
        };
        let stage = self.painter.stage;
        let mut quads: Vec<(i32, i32, u8)> = Vec::new();
        for (piece, entries) in self.bins.of(self.number) {
            for entry in entries {
                let Some(found) = piece.find(self.sorter, *entry) else {
                    continue;
                };
                let Some(bounds) = found.bounds().intersect(&self.area) else {
                    continue;
                };
                quads.clear();
                (found.shape()).scan(&bounds, &stage.scissor, |x, y, mask| {
                    quads.push((x, y, mask));
                });
                if quads.is_empty() {
                    continue;
                }
                let planes = found.planes(stage);
                brush.shares.begin(found.owner());
                for &(x, y, mask) in &quads {
                    brush.quad(&planes, x, y, mask);
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
    batch: PixelBatch,
    shares: Shares,
    shaded: PixelResult,
    statistics: Statistics,
}

impl Brush<'_, '_> {
    #[inline(always)]
    fn quad(&mut self, planes: &Planes, x: i32, y: i32, mask: u8) {
        let state = self.painter.stage.call.state;
        let quantities = planes.quad(x, y);
        let z = depths(&quantities);
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
        self.batch.place(quad, x, y, mask, &z);
        self.shares.place(quad, planes, &quantities);
        self.batch.quads += 1;
        self.statistics.shaded += u64::from(mask.count_ones());
    }

    #[inline(always)]
    fn flush(&mut self) {
        if self.batch.quads == 0 {
            return;
        }
        let painter = self.painter;
        (painter.interpolator).fill(&mut self.batch, &mut self.shares);
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

//! Primitives in drawing order, sorted by the tiles they touch.
//!
//! Each core sorts a piece of the primitives by itself; a tile then goes over its part of each piece in order. Nearly every
//! triangle is kept as nothing but its number: what else is needed to draw it follows from its vertices on the screen, and
//! is cheaper to compute again in a tile than to write down and fetch.

use std::ops::Range;

#[cfg(feature = "parallel")]
use rayon::prelude::*;

use super::assemble::Primitives;
use super::clip::{Clipper, SHARES};
use super::scan::{Bounds, Shape};
use super::screen::Screen;
use super::setup::{Corner, Outline, Owner, Planes, Room, Setup, Stage, doubled_area};
use super::target::TILE;

/// Primitives that one core sorts at a time.
const PIECE: usize = 1 << 11;

/// Pieces that are sorted before any of their primitives is drawn. Bounds the memory of a draw call of any length.
const PIECES: usize = 32;

/// Entries in the tiles of a piece after which it ends early.
const MOST_ENTRIES: usize = 1 << 16;

/// Shapes in a piece, of primitives that are more than their number, after which it ends early. One primitive has at most 16:
/// each of the seven planes of the view and the six of the user's adds one to the corners of a triangle.
const MOST_SETUPS: usize = 1 << 11;

/// What the primitives of a draw call are sorted by.
pub(super) struct Sorter<'a> {
    pub(super) stage: &'a Stage<'a>,
    pub(super) primitives: &'a Primitives<'a>,
    /// The vertices on the screen, if the primitives are triangles that are filled.
    pub(super) screen: Option<&'a Screen>,
    /// How many tiles lie side by side, and how many there are.
    pub(super) across: usize,
    pub(super) tiles: usize,
}

/// Some primitives that follow each other, by the tiles they touch.
pub(super) struct Piece {
    primitives: Range<usize>,
    /// How many of them have shapes.
    drawn: u64,
    /// The shapes of primitives that are more than a number.
    setups: Vec<Setup>,
    /// Where in the entries those of each tile begin, and behind the last tile their end.
    starts: Vec<u32>,
    entries: Vec<Entry>,
}

/// A primitive, counted from the first of its piece, or with [`Self::SETUP`] one of the piece's set-ups.
#[derive(Clone, Copy, Default)]
pub(super) struct Entry(u32);

impl Entry {
    const SETUP: u32 = 1 << 31;
}

/// The pieces that are drawn next.
pub(super) struct Bins {
    pieces: Vec<Piece>,
}

impl Bins {
    /// The first primitives from one on: as many as memory allows, one at least.
    pub(super) fn new(sorter: &Sorter, first: usize) -> Self {
        let end = (sorter.primitives.len()).min(first.saturating_add(PIECES * PIECE));
        let ranges: Vec<_> = (first..end)
            .step_by(PIECE)
            .map(|first| first..end.min(first + PIECE))
            .collect();
        let piece = |range: &Range<usize>| sorter.piece(range.clone());
        #[cfg(feature = "parallel")]
        let pieces = ranges.par_iter().map(piece);
        #[cfg(not(feature = "parallel"))]
        let pieces = ranges.iter().map(piece);
        let mut pieces: Vec<Piece> = pieces.collect();
        // Behind one that ended early is a gap: what was sorted there is sorted again.
        let whole = |(piece, range): (&Piece, &Range<usize>)| piece.primitives == *range;
        if let Some(early) = pieces.iter().zip(&ranges).position(|pair| !whole(pair)) {
            pieces.truncate(early + 1);
        }
        Self { pieces }
    }

    /// The primitive behind the last one.
    pub(super) fn end(&self) -> Option<usize> {
        Some(self.pieces.last()?.primitives.end)
    }

    /// How many of the primitives have shapes.
    pub(super) fn drawn(&self) -> u64 {
        self.pieces.iter().map(|piece| piece.drawn).sum()
    }

    /// Whether nothing touches a tile.
    pub(super) fn is_empty(&self, tile: usize) -> bool {
        (self.pieces.iter()).all(|piece| piece.of(tile).is_empty())
    }

    /// What touches a tile, piece by piece, in drawing order.
    pub(super) fn of(&self, tile: usize) -> impl Iterator<Item = (&Piece, &[Entry])> {
        self.pieces.iter().map(move |piece| (piece, piece.of(tile)))
    }
}

impl Piece {
    fn of(&self, tile: usize) -> &[Entry] {
        let bounds = self.starts.get(tile..).and_then(<[u32]>::first_chunk);
        let entries = bounds.and_then(|[start, end]| {
            let range = *start as usize..*end as usize;
            self.entries.get(range)
        });
        entries.unwrap_or_default()
    }
}

impl Sorter<'_> {
    fn piece(&self, mut range: Range<usize>) -> Piece {
        let (mut room, mut setups, mut drawn) = (Room::default(), Vec::new(), 0);
        let mut touched: Vec<(u32, Entry)> = Vec::with_capacity(2 * range.len());
        for (number, primitive) in (0..).zip(range.clone()) {
            if touched.len() >= MOST_ENTRIES || setups.len() >= MOST_SETUPS {
                range.end = primitive;
                break;
            }
            let vertices = self.primitives.get(primitive);
            match self.simple(vertices) {
                Simple::Nothing => {}
                Simple::Triangle(corners, bounds) => {
                    drawn += 1;
                    let shape = || Shape::Triangle(Outline::new(corners).edges());
                    self.touch(&bounds, shape, Entry(number), &mut touched);
                }
                Simple::No => {
                    let before = setups.len();
                    self.stage.primitive(vertices, &mut room, &mut setups);
                    drawn += u64::from(setups.len() > before);
                    for (place, setup) in (0..).zip(&setups).skip(before) {
                        let entry = Entry(place | Entry::SETUP);
                        self.touch(&setup.bounds, || setup.shape, entry, &mut touched);
                    }
                }
            }
        }
        let (starts, entries) = by_tile(&touched, self.tiles);
        Piece {
            primitives: range,
            drawn,
            setups,
            starts,
            entries,
        }
    }

    /// Adds an entry for each tile that a shape with these bounds may touch.
    #[inline(always)]
    fn touch(
        &self,
        bounds: &Bounds,
        shape: impl Fn() -> Shape,
        entry: Entry,
        touched: &mut Vec<(u32, Entry)>,
    ) {
        const SIDE: i32 = TILE as i32;
        let (columns, rows) = (
            bounds.x0 / SIDE..=(bounds.x1 - 1) / SIDE,
            bounds.y0 / SIDE..=(bounds.y1 - 1) / SIDE,
        );
        let number = |x: i32, y: i32| (y as usize * self.across + x as usize) as u32;
        if columns.start() == columns.end() && rows.start() == rows.end() {
            touched.push((number(*columns.start(), *rows.start()), entry));
            return;
        }
        let shape = shape();
        for y in rows {
            for x in columns.clone() {
                if shape.touches(x * SIDE, y * SIDE, SIDE) {
                    touched.push((number(x, y), entry));
                }
            }
        }
    }

    /// A primitive that is looked at without being clipped, if it can be.
    #[inline(always)]
    fn simple(&self, vertices: [u32; 3]) -> Simple {
        let Some(screen) = self.screen else {
            return Simple::No;
        };
        let outside = vertices.map(|vertex| screen.outside(vertex));
        let [any, all] = [
            outside[0] | outside[1] | outside[2],
            outside[0] & outside[1] & outside[2],
        ];
        if any != 0 {
            return match all != 0 || any & Clipper::BROKEN != 0 {
                true => Simple::Nothing,
                false => Simple::No,
            };
        }
        let corners = corners(screen, vertices);
        if self.stage.culls(doubled_area(corners.each_ref())) {
            return Simple::Nothing;
        }
        match Bounds::around(&corners).intersect(&self.stage.scissor) {
            Some(bounds) => Simple::Triangle(corners, bounds),
            None => Simple::Nothing,
        }
    }
}

/// What a primitive is at first sight.
enum Simple {
    /// Nothing of it is seen.
    Nothing,
    /// A triangle of which nothing is cut off.
    Triangle([Corner; 3], Bounds),
    /// More than that.
    No,
}

/// The corners of a triangle of which nothing is cut off.
#[inline(always)]
fn corners(screen: &Screen, vertices: [u32; 3]) -> [Corner; 3] {
    std::array::from_fn(|i| Corner::new(&screen.spot(vertices[i]), SHARES[i]))
}

/// Sorts entries by tile, those of one tile as they came. Returns where each tile's begin.
fn by_tile(touched: &[(u32, Entry)], tiles: usize) -> (Vec<u32>, Vec<Entry>) {
    // One place more than is needed: while entries are put in, each start moves to its end, which is the next one's start.
    let mut starts = vec![0_u32; tiles + 2];
    for (tile, _) in touched {
        if let Some(count) = starts.get_mut(*tile as usize + 2) {
            *count += 1;
        }
    }
    let mut sum = 0;
    for start in &mut starts {
        sum += *start;
        *start = sum;
    }
    let mut entries = vec![Entry::default(); touched.len()];
    for (tile, entry) in touched {
        if let Some(next) = starts.get_mut(*tile as usize + 1)
            && let Some(place) = entries.get_mut(*next as usize)
        {
            *place = *entry;
            *next += 1;
        }
    }
    (starts, entries)
}

/// A shape in a tile, for whoever draws it.
pub(super) enum Found<'a> {
    /// A triangle of which nothing is cut off, and what may be covered of it.
    Triangle(Owner, Outline, Bounds),
    /// Any other shape.
    Setup(&'a Setup),
}

impl Piece {
    /// The shape of an entry.
    #[inline(always)]
    pub(super) fn find(&self, sorter: &Sorter, entry: Entry) -> Option<Found<'_>> {
        if entry.0 & Entry::SETUP != 0 {
            return self
                .setups
                .get((entry.0 & !Entry::SETUP) as usize)
                .map(Found::Setup);
        }
        let vertices = (sorter.primitives).get(self.primitives.start + entry.0 as usize);
        let outline = Outline::new(corners(sorter.screen?, vertices));
        let bounds = outline.bounds().intersect(&sorter.stage.scissor)?;
        Some(Found::Triangle(Owner::of(vertices), outline, bounds))
    }
}

impl Found<'_> {
    /// What may be covered.
    #[inline(always)]
    pub(super) fn bounds(&self) -> &Bounds {
        match self {
            Self::Triangle(_, _, bounds) => bounds,
            Self::Setup(setup) => &setup.bounds,
        }
    }

    #[inline(always)]
    pub(super) fn owner(&self) -> Owner {
        match self {
            Self::Triangle(owner, _, _) => *owner,
            Self::Setup(setup) => setup.owner,
        }
    }

    #[inline(always)]
    pub(super) fn shape(&self) -> Shape {
        match self {
            Self::Triangle(_, outline, _) => Shape::Triangle(outline.edges()),
            Self::Setup(setup) => setup.shape,
        }
    }

    /// What is interpolated over it.
    #[inline(always)]
    pub(super) fn planes(&self, stage: &Stage) -> Planes {
        match self {
            Self::Triangle(_, outline, _) => outline.planes().biased(stage.call.state.depth.bias),
            Self::Setup(setup) => setup.planes,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::{
        CullMode, DrawCall, FillMode, RenderState, Topology, Vertex, Vertices, Viewport,
    };
    use crate::simd::Simd;

    const SIDE: u32 = 8 * TILE;

    /// The primitives that each tile of a target of 8×8 tiles is given, batch by batch, and where the batches end: triangles
    /// over the whole target, each with vertices of its own.
    fn sorted(count: usize, fill: FillMode) -> (Vec<Vec<usize>>, Vec<usize>) {
        let corner = |x: f32, y: f32| Vertex {
            position: glam::vec4(x, y, 0.5, 1.0),
            ..Vertex::default()
        };
        let one = [corner(-1.0, 1.0), corner(4.0, 1.0), corner(-1.0, -4.0)];
        let vertices = Vertices::from(&one.repeat(count)[..]);
        let state = RenderState {
            cull: CullMode::None,
            fill,
            ..RenderState::default()
        };
        let call = DrawCall {
            viewport: Viewport::full(SIDE, SIDE),
            state: &state,
            topology: Topology::TriangleList,
            vertices: &vertices,
            indices: None,
        };
        let stage = Stage::new(call, (SIDE, SIDE)).unwrap();
        let primitives = Primitives::new(Topology::TriangleList, vertices.len(), None).unwrap();
        let screen = Screen::new(&stage, &vertices, Simd::chosen());
        let sorter = Sorter {
            stage: &stage,
            primitives: &primitives,
            screen: (fill == FillMode::Solid).then_some(&screen),
            across: 8,
            tiles: 64,
        };
        let (mut found, mut ends) = (vec![Vec::new(); 64], vec![0]);
        while ends[ends.len() - 1] < primitives.len() {
            let bins = Bins::new(&sorter, ends[ends.len() - 1]);
            for (tile, found) in found.iter_mut().enumerate() {
                for (piece, entry) in bins
                    .of(tile)
                    .flat_map(|(p, es)| es.iter().map(move |e| (p, e)))
                {
                    let owner = piece.find(&sorter, *entry).unwrap().owner();
                    found.push(owner.provoking as usize / 3);
                }
            }
            ends.push(bins.end().unwrap());
        }
        (found, ends)
    }

    #[test]
    fn each_tile_has_each_primitive_once_and_in_order() {
        // 64 tiles a triangle: 65536 entries are reached behind each 1024th.
        let (found, ends) = sorted(3000, FillMode::Solid);
        assert_eq!(ends, [0, 1024, 2048, 3000]);
        assert!(found.iter().all(|tile| tile.iter().copied().eq(0..3000)));
    }

    #[test]
    fn so_it_is_with_shapes_that_are_kept() {
        // Three lines a triangle: 2048 are reached behind each 683rd.
        let (found, ends) = sorted(2500, FillMode::Wireframe);
        assert_eq!(ends, [0, 683, 1366, 2049, 2500]);
        // Lines are in all tiles of the rectangle around them: the long edge everywhere, the upper and the left one there.
        let times = |tile: usize, times: usize| {
            let expected = (0..2500).flat_map(|i| std::iter::repeat_n(i, times));
            found[tile].iter().copied().eq(expected)
        };
        assert!(times(0, 3) && times(7, 2) && times(56, 2) && times(63, 1));
    }
}

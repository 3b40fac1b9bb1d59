//! Sampling: level of detail, address modes, filters.
//!
//! The order of the arithmetic is fixed, so that results are the same everywhere: `lerp(a, b, f) = a + f·(b − a)`,
//! along x first, then y, then z, then between mip levels; probes of an anisotropic filter are summed from one end to the
//! other. Four-byte texels are filtered as codes 0 to 255 and divided by 255 once at the end.
//!
//! Weights of 8 bits are compiled apart (`COARSE`), so that full ones need not ask for them.
//!
//! A sample goes through four steps, each used by every way to sample: [`Detail`] (λ and probes from the derivatives),
//! [`Choice`] (filter and levels from λ), [`Position`] (face and coordinate from the vector), [`Texel taps`](Taps) (which
//! texels of a level, how much of each).
//!
//! [`batch`] takes the same steps for many lanes at a time. What it does not know (probes, volumes, borders, coordinates
//! that are not numbers, quads across the edges of a cube) it leaves to the code in this file, quad by quad.

mod batch;
mod detail;
mod footprint;
#[cfg(test)]
mod tests;

use super::cube::{AcrossEdge, across_edge, direction_to_face, face_to_direction};
use super::storage::{FloatStore, Level, PackedStore, Store, Texels};
use super::{AddressMode, Filter, MipFilter, Sampler, Texture, TextureKind, Weights};

pub use batch::{Memory, Places, Sample, sample_quads, share_places};
pub(crate) use detail::RATIO_SLACK;
pub use detail::{Detail, details};
pub use footprint::{Footprint, Tap, footprint};

/// What a stage without a texture reads.
pub(crate) const UNBOUND: [f32; 4] = [0.0, 0.0, 0.0, 1.0];

/// A coordinate that arithmetic can be done with: NaN is 0, infinities are the largest finite numbers.
#[inline(always)]
pub(super) fn finite(value: f32) -> f32 {
    if value.is_nan() {
        0.0
    } else {
        value.clamp(f32::MIN, f32::MAX)
    }
}

#[inline(always)]
fn lerp(a: [f32; 4], b: [f32; 4], f: f32) -> [f32; 4] {
    std::array::from_fn(|channel| a[channel] + f * (b[channel] - a[channel]))
}

/// The share of the second of two texels or levels, as exact as the weights are.
#[inline(always)]
fn share<const COARSE: bool>(f: f32) -> f32 {
    if COARSE {
        (f * 256.0 + 0.5).floor() / 256.0
    } else {
        f
    }
}

/// Filter and mip levels, as λ decides them.
#[derive(Clone, Copy)]
struct Choice {
    filter: Filter,
    first: usize,
    second: usize,
    /// Share of the second level; 0 when only the first is read.
    blend: f32,
}

impl Choice {
    fn new<const COARSE: bool>(texture: &Texture, sampler: &Sampler, detail: &Detail) -> Self {
        let filter = if detail.lambda > 0.0 {
            sampler.min
        } else {
            sampler.mag
        };
        let last = texture.levels.len() - 1;
        let largest = last.min(sampler.max_mip_level as usize);
        let level = detail.level();
        let level = if level.is_nan() { 0.0 } else { level };
        let level = level.clamp(largest as f32, last as f32);
        let only = |level: usize| Self {
            filter,
            first: level,
            second: level,
            blend: 0.0,
        };
        match sampler.mip {
            MipFilter::None => only(0),
            MipFilter::Point => only(last.min((level + 0.5) as usize)),
            MipFilter::Linear => {
                let first = last.min(level as usize);
                Self {
                    filter,
                    first,
                    second: last.min(first + 1),
                    blend: share::<COARSE>(level - first as f32),
                }
            }
        }
    }

    /// Whether λ makes no difference, so that it need not be found.
    fn is_fixed(texture: &Texture, sampler: &Sampler) -> bool {
        sampler.mag.is_linear() == sampler.min.is_linear()
            && sampler.most_probes() == 1
            && (sampler.mip == MipFilter::None || texture.levels.len() == 1)
    }

    /// Levels and their shares.
    fn levels(self) -> impl Iterator<Item = (usize, f32)> {
        let second = (self.blend > 0.0).then_some((self.second, self.blend));
        [(self.first, 1.0 - self.blend)].into_iter().chain(second)
    }
}

/// Where a coordinate lies: the face, and u, v, w in 0 to 1 (2D and volume: any number).
#[derive(Clone, Copy)]
struct Position {
    face: usize,
    uvw: [f32; 3],
}

impl Position {
    #[inline(always)]
    fn new(kind: TextureKind, coord: [f32; 3]) -> Self {
        if kind == TextureKind::Cube {
            let (face, [u, v]) = direction_to_face(coord);
            Self {
                face,
                uvw: [u, v, 0.0],
            }
        } else {
            Self {
                face: 0,
                uvw: coord.map(finite),
            }
        }
    }

    /// The place of a probe. On a cube it is where the direction through its place in the plane of the face leads, so that
    /// one beyond the edge reads the neighbouring face.
    fn of_probe(self, kind: TextureKind, along: [f32; 3], share: f32) -> Self {
        let place = std::array::from_fn(|axis| self.uvw[axis] + along[axis] * share);
        if kind == TextureKind::Cube {
            Self::new(
                kind,
                face_to_direction(self.face, [finite(place[0]), finite(place[1])]),
            )
        } else {
            Self::new(kind, place)
        }
    }
}

/// An index that stands for the border colour.
const BORDER: i32 = -1;

/// The texels of one axis that a filter reads: their indices (or [`BORDER`]) and the share of the second.
#[derive(Clone, Copy)]
struct Pair {
    near: i32,
    far: i32,
    f: f32,
}

impl Pair {
    const FIRST: Self = Self {
        near: 0,
        far: 0,
        f: 0.0,
    };

    #[inline(always)]
    fn new<const COARSE: bool>(u: f32, n: u32, mode: AddressMode, filter: Filter) -> Self {
        let (i, f) = split::<COARSE>(u, n, filter);
        let near = address(i, n, mode);
        let far = if filter.is_linear() {
            address(i + 1, n, mode)
        } else {
            near
        };
        Self { near, far, f }
    }

    fn entries(self) -> [(i32, f32); 2] {
        [(self.near, 1.0 - self.f), (self.far, self.f)]
    }
}

/// Largest whole number not above x, for x within ±2^30.
#[inline(always)]
fn floor(x: f32) -> i32 {
    let whole = x as i32;
    whole - i32::from(whole as f32 > x)
}

/// The index before which a coordinate lies and the share of the next one; indices are not yet addressed.
#[inline(always)]
fn split<const COARSE: bool>(u: f32, n: u32, filter: Filter) -> (i32, f32) {
    // Far beyond any texel that a float can tell apart from its neighbour; keeps i + 1 and −1 − i in range.
    const FAR: f32 = 1_073_741_824.0;
    let x = u * n as f32;
    if filter.is_linear() {
        let x = (x - 0.5).clamp(-FAR, FAR);
        let i = floor(x);
        (i, share::<COARSE>(x - i as f32))
    } else {
        (floor(x.clamp(-FAR, FAR)), 0.0)
    }
}

/// The texel that index i stands for, on an axis of n texels.
#[inline(always)]
fn address(i: i32, n: u32, mode: AddressMode) -> i32 {
    let n = n as i32;
    if (0..n).contains(&i) {
        return i;
    }
    match mode {
        // Division is slow, and most textures have edges that are powers of two.
        AddressMode::Wrap if n & (n - 1) == 0 => i & (n - 1),
        AddressMode::Wrap => i.rem_euclid(n),
        AddressMode::Mirror => {
            let k = i.rem_euclid(2 * n);
            if k < n { k } else { 2 * n - 1 - k }
        }
        AddressMode::Clamp => i.clamp(0, n - 1),
        AddressMode::Border => BORDER,
        AddressMode::MirrorOnce => (if i < 0 { -1 - i } else { i }).min(n - 1),
    }
}

/// The texels of one level that a sample is made of.
enum Taps {
    /// On one face: all pairings of the indices of the axes.
    Grid { face: usize, axes: [Pair; 3] },
    /// Around the edge of a cube face: from the texel `x`, `y` (which may lie outside) two by two, and the shares of the
    /// right column and the lower row.
    Edge {
        face: usize,
        x: i32,
        y: i32,
        n: i32,
        f: [f32; 2],
    },
}

/// Finds the texels that `filter` reads around a position in one level.
#[inline(always)]
fn taps<const COARSE: bool>(
    kind: TextureKind,
    sampler: &Sampler,
    level: &Level,
    position: Position,
    filter: Filter,
) -> Taps {
    let Position { face, uvw } = position;
    let pair = |axis: usize, mode| Pair::new::<COARSE>(uvw[axis], level.size[axis], mode, filter);
    let [u, v, w] = sampler.address;
    let axes = match kind {
        TextureKind::Texture2D => [pair(0, u), pair(1, v), Pair::FIRST],
        TextureKind::Volume => [pair(0, u), pair(1, v), pair(2, w)],
        TextureKind::Cube => {
            if sampler.seamless
                && filter.is_linear()
                && let Some(edge) = edge_taps::<COARSE>(level, position)
            {
                return edge;
            }
            [
                pair(0, AddressMode::Clamp),
                pair(1, AddressMode::Clamp),
                Pair::FIRST,
            ]
        }
    };
    Taps::Grid { face, axes }
}

/// The four texels around a position near the edge of a cube face; none if all lie on the face.
fn edge_taps<const COARSE: bool>(
    level: &Level,
    Position {
        face,
        uvw: [u, v, _],
    }: Position,
) -> Option<Taps> {
    let n = level.size[0];
    let [(x, fx), (y, fy)] = [u, v].map(|u| split::<COARSE>(u, n, Filter::Linear));
    let inside = |i: i32| i >= 0 && i + 1 < n as i32;
    if inside(x) && inside(y) {
        return None;
    }
    Some(Taps::Edge {
        face,
        x,
        y,
        n: n as i32,
        f: [fx, fy],
    })
}

/// One face of one level. Functions rather than closures, which the compiler does not inline here.
#[derive(Clone, Copy)]
struct Grid<'a, S> {
    store: S,
    level: &'a Level,
    face: usize,
    border: [f32; 4],
}

impl<S: Store> Grid<'_, S> {
    #[inline(always)]
    fn fetch(&self, i: i32, j: i32, k: i32) -> [f32; 4] {
        if i | j | k < 0 {
            return self.border;
        }
        let place = [i as usize, j as usize, k as usize];
        self.store.fetch(self.level.index(self.face, place))
    }

    #[inline(always)]
    fn row(&self, x: Pair, j: i32, k: i32) -> [f32; 4] {
        lerp(self.fetch(x.near, j, k), self.fetch(x.far, j, k), x.f)
    }

    #[inline(always)]
    fn slice(&self, x: Pair, y: Pair, k: i32) -> [f32; 4] {
        lerp(self.row(x, y.near, k), self.row(x, y.far, k), y.f)
    }
}

/// The texels of a two by two block that reaches over an edge: upper left, upper right, lower left, lower right.
fn corners(face: usize, [x, y]: [i32; 2], n: i32) -> [AcrossEdge; 4] {
    [[x, y], [x + 1, y], [x, y + 1], [x + 1, y + 1]].map(|place| across_edge(face, place, n))
}

impl Taps {
    /// The filtered value, times the scale of the store. `border` is scaled already.
    #[inline(always)]
    fn value<S: Store>(&self, store: S, level: &Level, border: [f32; 4]) -> [f32; 4] {
        match self {
            Self::Grid {
                face,
                axes: [x, y, z],
            } => {
                let grid = Grid {
                    store,
                    level,
                    face: *face,
                    border,
                };
                if x.f == 0.0 && y.f == 0.0 && z.f == 0.0 {
                    return grid.fetch(x.near, y.near, z.near);
                }
                let near = grid.slice(*x, *y, z.near);
                if z.f == 0.0 {
                    near
                } else {
                    lerp(near, grid.slice(*x, *y, z.far), z.f)
                }
            }
            Self::Edge { face, x, y, n, f } => {
                let [a, b, c, d] = corners(*face, [*x, *y], *n).map(|corner| {
                    let mut sum = [0.0; 4];
                    for &(face, [x, y]) in corner.places() {
                        let texel = store.fetch(level.index(face, [x, y, 0]));
                        for (sum, value) in sum.iter_mut().zip(texel) {
                            *sum += value;
                        }
                    }
                    sum.map(|sum| sum / corner.places().len() as f32)
                });
                lerp(lerp(a, b, f[0]), lerp(c, d, f[0]), f[1])
            }
        }
    }

    /// Calls `visit` with face, texel (none: border) and share of every texel that counts.
    fn each(&self, mut visit: impl FnMut(usize, Option<[u32; 3]>, f32)) {
        let mut visit = |face, texel, weight| {
            if weight != 0.0 {
                visit(face, texel, weight);
            }
        };
        match self {
            Self::Grid {
                face,
                axes: [x, y, z],
            } => {
                for (k, weight_z) in z.entries() {
                    for (j, weight_y) in y.entries() {
                        for (i, weight_x) in x.entries() {
                            let texel = (i | j | k >= 0).then_some([i as u32, j as u32, k as u32]);
                            visit(*face, texel, weight_x * weight_y * weight_z);
                        }
                    }
                }
            }
            Self::Edge {
                face,
                x,
                y,
                n,
                f: [fx, fy],
            } => {
                let weights = [
                    (1.0 - fx) * (1.0 - fy),
                    fx * (1.0 - fy),
                    (1.0 - fx) * fy,
                    fx * fy,
                ];
                for (corner, weight) in corners(*face, [*x, *y], *n).into_iter().zip(weights) {
                    let share = weight / corner.places().len() as f32;
                    for &(face, [x, y]) in corner.places() {
                        visit(face, Some([x as u32, y as u32, 0]), share);
                    }
                }
            }
        }
    }
}

/// A texture with its sampler, compiled for one way of keeping texels and one of weighing them.
#[derive(Clone, Copy)]
struct Reader<'a, S, const COARSE: bool> {
    store: S,
    texture: &'a Texture,
    sampler: &'a Sampler,
    /// Border colour as the format would hold it, times the scale of the store.
    border: [f32; 4],
}

impl<'a, S: Store, const COARSE: bool> Reader<'a, S, COARSE> {
    fn new(store: S, texture: &'a Texture, sampler: &'a Sampler) -> Self {
        let border = texture
            .format
            .with_fill(sampler.border)
            .map(|value| value * S::SCALE);
        Self {
            store,
            texture,
            sampler,
            border,
        }
    }

    #[inline(always)]
    fn level(
        &self,
        kind: TextureKind,
        level: usize,
        position: Position,
        filter: Filter,
    ) -> [f32; 4] {
        let level = &self.texture.levels[level];
        taps::<COARSE>(kind, self.sampler, level, position, filter).value(
            self.store,
            level,
            self.border,
        )
    }

    /// One probe, times the scale of the store.
    #[inline(always)]
    fn probe(&self, kind: TextureKind, position: Position, choice: Choice) -> [f32; 4] {
        let value = self.level(kind, choice.first, position, choice.filter);
        if choice.blend > 0.0 {
            let second = self.level(kind, choice.second, position, choice.filter);
            lerp(value, second, choice.blend)
        } else {
            value
        }
    }

    #[inline(always)]
    fn sample(&self, kind: TextureKind, coord: [f32; 3], detail: &Detail) -> [f32; 4] {
        let choice = Choice::new::<COARSE>(self.texture, self.sampler, detail);
        let position = Position::new(kind, coord);
        let value = if detail.probes > 1 {
            self.probes(kind, position, choice, detail)
        } else {
            self.probe(kind, position, choice)
        };
        value.map(|value| value / S::SCALE)
    }

    /// The mean of all probes. Not inlined: few samples have more than one.
    #[inline(never)]
    fn probes(
        &self,
        kind: TextureKind,
        position: Position,
        choice: Choice,
        detail: &Detail,
    ) -> [f32; 4] {
        let mut sum = [0.0; 4];
        for share in detail.places() {
            let place = position.of_probe(kind, detail.along, share);
            let value = self.probe(kind, place, choice);
            for (sum, value) in sum.iter_mut().zip(value) {
                *sum += value;
            }
        }
        sum.map(|sum| sum / f32::from(detail.probes))
    }

    fn sample_at(&self, coord: [f32; 3], detail: &Detail) -> [f32; 4] {
        self.sample(self.texture.kind, coord, detail)
    }

    /// The four pixels of a quad.
    fn quad(&self, coords: &[[f32; 3]; 4]) -> [[f32; 4]; 4] {
        let found = match Choice::is_fixed(self.texture, self.sampler) {
            true => [Detail::NONE; 4],
            false => details(self.texture, self.sampler, coords),
        };
        std::array::from_fn(|lane| self.sample_at(coords[lane], &found[lane]))
    }
}

/// Calls a method of the reader that is compiled for a texture and its weights.
macro_rules! read {
    ($texture:expr, $sampler:expr, $($call:tt)*) => {
        match (&$texture.texels, $sampler.weights) {
            (Texels::Packed(words), Weights::Full) => {
                Reader::<_, false>::new(PackedStore(words), $texture, $sampler).$($call)*
            }
            (Texels::Packed(words), Weights::EightBits) => {
                Reader::<_, true>::new(PackedStore(words), $texture, $sampler).$($call)*
            }
            (Texels::Float(texels), Weights::Full) => {
                Reader::<_, false>::new(FloatStore(texels), $texture, $sampler).$($call)*
            }
            (Texels::Float(texels), Weights::EightBits) => {
                Reader::<_, true>::new(FloatStore(texels), $texture, $sampler).$($call)*
            }
        }
    };
}

/// Samples a texture for the pixels of one quad.
#[inline(never)]
fn sample_quad(texture: &Texture, sampler: &Sampler, coords: &[[f32; 3]; 4]) -> [[f32; 4]; 4] {
    read!(texture, sampler, quad(coords))
}

/// Samples a texture at one coordinate with a given detail, or a given λ (no bias is added to it).
///
/// λ > 0 takes the minification filter. Coordinates and results as in [`sample_quads`].
pub fn sample_at(
    texture: Option<&Texture>,
    sampler: &Sampler,
    coord: [f32; 3],
    detail: impl Into<Detail>,
) -> [f32; 4] {
    let Some(texture) = texture else {
        return UNBOUND;
    };
    let detail = detail.into();
    read!(texture, sampler, sample_at(coord, &detail))
}

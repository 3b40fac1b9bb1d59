//! Which texels of each axis the lanes read, and where they lie in memory.

use super::levels::{Detailed, LevelRows};
use super::{FAR, floor, int};
use crate::texture::AddressMode;
use crate::texture::sample::share;

/// The texels of one axis.
pub(super) struct Axis<const N: usize> {
    /// The index of the one before the coordinate.
    near: [f32; N],
    /// The index of the one behind it.
    far: [f32; N],
    /// The share of the latter.
    f: [f32; N],
    /// Whether each `far` follows its `near`.
    adjacent: bool,
}

impl<const N: usize> Axis<N> {
    /// Of coordinates on an axis of `n` texels. Marks what it cannot do as odd.
    #[inline(always)]
    pub(super) fn new(
        u: &[f32; N],
        n: &[f32; N],
        detailed: &Detailed<N>,
        mode: AddressMode,
        coarse: bool,
        odd: &mut [u32; N],
    ) -> Self {
        let mut axis = Self {
            near: [0.0; N],
            far: [0.0; N],
            f: [0.0; N],
            adjacent: true,
        };
        let half = &detailed.half;
        let mut outside = 0;
        for l in 0..N {
            let x = u[l] * n[l] - half[l];
            let i = floor(x);
            axis.near[l] = i;
            axis.far[l] = i + 1.0;
            axis.f[l] = if half[l] > 0.0 { x - i } else { 0.0 };
            // Also where it is not a number.
            odd[l] |= u32::from(!(x.abs() < FAR));
            outside |= u32::from(i < 0.0) | u32::from(i + 1.0 >= n[l]);
        }
        if coarse {
            axis.f = axis.f.map(share::<true>);
        }
        if outside != 0 {
            axis.adjacent = false;
            axis.address(n, mode, odd);
        }
        axis
    }

    /// Takes indices into the texture.
    #[inline(always)]
    fn address(&mut self, n: &[f32; N], mode: AddressMode, odd: &mut [u32; N]) {
        match mode {
            AddressMode::Wrap => {
                for (l, n) in n.iter().enumerate() {
                    let near = remainder(self.near[l], *n);
                    self.near[l] = near;
                    self.far[l] = if near + 1.0 >= *n { 0.0 } else { near + 1.0 };
                }
            }
            AddressMode::Mirror => self.each(n, |i, n| {
                let k = remainder(i, 2.0 * n);
                if k < n { k } else { 2.0 * n - 1.0 - k }
            }),
            AddressMode::Clamp => {
                self.each(n, |i, n| at_most(n - 1.0, if i < 0.0 { 0.0 } else { i }))
            }
            AddressMode::MirrorOnce => {
                self.each(n, |i, n| {
                    at_most(n - 1.0, if i < 0.0 { -1.0 - i } else { i })
                });
            }
            AddressMode::Border => {
                for l in 0..N {
                    let beyond = u32::from(self.near[l] < 0.0) | u32::from(self.far[l] >= n[l]);
                    odd[l] |= beyond;
                }
            }
        }
    }

    #[inline(always)]
    fn each(&mut self, n: &[f32; N], texel: impl Fn(f32, f32) -> f32) {
        for l in 0..N {
            self.near[l] = texel(self.near[l], n[l]);
            self.far[l] = texel(self.far[l], n[l]);
        }
    }
}

#[inline(always)]
fn at_most(most: f32, x: f32) -> f32 {
    if x > most { most } else { x }
}

/// i modulo n, from 0 to n − 1, of whole numbers within ±[`FAR`].
#[inline(always)]
fn remainder(i: f32, n: f32) -> f32 {
    // The quotient may be off by one, being rounded; products and differences of this size are exact.
    let r = i - floor(i * (1.0 / n)) * n;
    let r = if r < 0.0 { r + n } else { r };
    if r >= n { r - n } else { r }
}

/// The two by two texels that each lane reads in one level.
#[derive(Clone, Debug)]
pub(super) struct Grid<const N: usize> {
    /// The places of upper left, upper right, lower left and lower right among all texels.
    pub(super) corners: [[u32; N]; 4],
    /// The share of the right column.
    pub(super) x: [f32; N],
    /// The share of the lower row.
    pub(super) y: [f32; N],
    /// Whether right ones follow left ones in memory.
    pub(super) adjacent: bool,
    /// Whether all lanes read the first texel alone.
    pub(super) point: bool,
}

impl<const N: usize> Default for Grid<N> {
    fn default() -> Self {
        Self {
            corners: [[0; N]; 4],
            x: [0.0; N],
            y: [0.0; N],
            adjacent: false,
            point: false,
        }
    }
}

impl<const N: usize> Grid<N> {
    /// From both axes.
    #[inline(always)]
    pub(super) fn join(
        &mut self,
        rows: &LevelRows<N>,
        across: &Axis<N>,
        down: &Axis<N>,
        point: bool,
    ) {
        self.point = point;
        self.adjacent = across.adjacent;
        let [upper_left, upper_right, lower_left, lower_right] = &mut self.corners;
        // Odd lanes hold any numbers: nothing here may overflow loudly.
        for l in 0..N {
            let row = |j: f32| rows.base[l].wrapping_add(int(j).wrapping_mul(rows.stride[l]));
            let (upper, lower) = (row(down.near[l]), row(down.far[l]));
            let (left, right) = (int(across.near[l]), int(across.far[l]));
            upper_left[l] = upper.wrapping_add(left);
            upper_right[l] = upper.wrapping_add(right);
            lower_left[l] = lower.wrapping_add(left);
            lower_right[l] = lower.wrapping_add(right);
        }
        self.x = across.f;
        self.y = down.f;
    }
}

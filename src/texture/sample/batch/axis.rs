//! Which texels of each axis the lanes read, and where they lie in memory.

use super::levels::LevelRows;
use super::{FAR, floor, int, low_bits};
use crate::texture::AddressMode;
use crate::texture::sample::share;

/// The texels of one axis.
#[derive(Clone, Debug)]
pub(super) struct Axis<const N: usize> {
    /// The index of the one before the coordinate.
    near: [u32; N],
    /// The index of the one behind it.
    far: [u32; N],
    /// The former, not yet in the texture.
    index: [f32; N],
    /// Whether each `far` follows its `near`.
    adjacent: bool,
}

/// How coordinates become texels.
#[derive(Clone, Copy)]
pub(super) struct Addressing {
    /// 0.5 for a linear filter, else 0.
    pub(super) half: f32,
    /// Whether shares have 8 bits.
    pub(super) coarse: bool,
    pub(super) mode: AddressMode,
    /// Whether the axis has a power of two of texels in every level.
    pub(super) power_of_two: bool,
}

impl<const N: usize> Default for Axis<N> {
    fn default() -> Self {
        Self {
            near: [0; N],
            far: [0; N],
            index: [0.0; N],
            adjacent: false,
        }
    }
}

impl<const N: usize> Axis<N> {
    /// Finds those of coordinates on an axis of `n` texels, and the shares of the far ones. Marks what it cannot do as odd.
    #[inline(always)]
    pub(super) fn find(
        &mut self,
        u: &[f32; N],
        n: &[f32; N],
        addressing: Addressing,
        share_of_far: &mut [f32; N],
        odd: &mut [u32; N],
    ) {
        let Addressing { half, coarse, .. } = addressing;
        let (mut beyond, mut outside) = (0, 0);
        for l in 0..N {
            let x = u[l] * n[l] - half;
            let i = floor(x);
            self.index[l] = i;
            share_of_far[l] = x - i;
            // Also where it is not a number.
            beyond |= u32::from(x.abs() < FAR) ^ 1;
            outside |= u32::from(i < 0.0) | u32::from(i + 1.0 >= n[l]);
        }
        if beyond != 0 {
            for (l, odd) in odd.iter_mut().enumerate() {
                *odd |= u32::from((u[l] * n[l] - half).abs() < FAR) ^ 1;
            }
        }
        if half == 0.0 {
            *share_of_far = [0.0; N];
        } else if coarse {
            for f in share_of_far {
                *f = share::<true>(*f);
            }
        }
        self.adjacent = true;
        if outside == 0 {
            for (l, i) in self.index.iter().enumerate() {
                self.near[l] = int(*i);
                self.far[l] = self.near[l].wrapping_add(1);
            }
        } else {
            self.address(n, addressing, odd);
            let mut apart = 0;
            for l in 0..N {
                apart |= self.far[l] ^ self.near[l].wrapping_add(1);
            }
            self.adjacent = apart == 0;
        }
    }

    /// Takes indices into the texture.
    #[inline(always)]
    fn address(&mut self, n: &[f32; N], addressing: Addressing, odd: &mut [u32; N]) {
        match addressing.mode {
            AddressMode::Wrap if addressing.power_of_two => {
                for (l, n) in n.iter().enumerate() {
                    let mask = int(*n).wrapping_sub(1);
                    let near = low_bits(self.index[l]);
                    self.near[l] = near & mask;
                    self.far[l] = near.wrapping_add(1) & mask;
                }
            }
            AddressMode::Wrap => self.each(n, remainder),
            AddressMode::Mirror => self.each(n, |i, n| {
                let k = remainder(i, 2.0 * n);
                if k < n { k } else { 2.0 * n - 1.0 - k }
            }),
            AddressMode::Clamp => {
                self.each(n, |i, n| at_most(n - 1.0, if i < 0.0 { 0.0 } else { i }))
            }
            AddressMode::MirrorOnce => self.each(n, |i, n| {
                at_most(n - 1.0, if i < 0.0 { -1.0 - i } else { i })
            }),
            AddressMode::Border => {
                self.each(n, |i, _| i);
                for l in 0..N {
                    let beyond =
                        u32::from(self.index[l] < 0.0) | u32::from(self.index[l] + 1.0 >= n[l]);
                    odd[l] |= beyond;
                }
            }
        }
    }

    #[inline(always)]
    fn each(&mut self, n: &[f32; N], texel: impl Fn(f32, f32) -> f32) {
        for (l, n) in n.iter().enumerate() {
            self.near[l] = int(texel(self.index[l], *n));
            self.far[l] = int(texel(self.index[l] + 1.0, *n));
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
    /// Joins both axes, whose shares are there.
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
            let (base, stride) = (rows.base[l], rows.stride[l]);
            let upper = base.wrapping_add(down.near[l].wrapping_mul(stride));
            let lower = base.wrapping_add(down.far[l].wrapping_mul(stride));
            upper_left[l] = upper.wrapping_add(across.near[l]);
            upper_right[l] = upper.wrapping_add(across.far[l]);
            lower_left[l] = lower.wrapping_add(across.near[l]);
            lower_right[l] = lower.wrapping_add(across.far[l]);
        }
    }
}

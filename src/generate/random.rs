//! Random numbers that are the same everywhere.

/// A generator of random numbers: one seed gives the same numbers on every platform and in every version of this
/// crate's dependencies (SplitMix64: 64 bits of state, period 2⁶⁴). It is no source of secrets.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Random {
    state: u64,
}

impl Random {
    /// The generator of this seed. Neighbouring seeds give unrelated numbers.
    pub fn new(seed: u64) -> Self {
        Self { state: seed }
    }

    /// The next 32 bits.
    pub fn bits(&mut self) -> u32 {
        self.state = self.state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 32) as u32
    }

    /// A number from 0 to `end` − 1; 0 for an `end` of 0.
    pub fn below(&mut self, end: u32) -> u32 {
        // The high half of the product: no division, and for the small ends in use no bias worth the name.
        ((u64::from(self.bits()) * u64::from(end)) >> 32) as u32
    }

    /// True in so many of 100 cases.
    pub fn chance(&mut self, percent: u32) -> bool {
        self.below(100) < percent
    }

    /// A number from `low` to `high`, in 2²⁴ equal steps.
    pub fn between(&mut self, low: f32, high: f32) -> f32 {
        let unit = (self.bits() >> 8) as f32 / 16_777_216.0;
        low + (high - low) * unit
    }

    /// One of these, all equally likely.
    pub fn pick<T: Copy>(&mut self, items: &[T]) -> Option<T> {
        let at = self.below(u32::try_from(items.len()).unwrap_or(u32::MAX));
        items.get(at as usize).copied()
    }

    /// One of these, each as likely as its weight says; `None` if nothing has any.
    pub fn weighted<T: Copy>(&mut self, items: &[(T, u32)]) -> Option<T> {
        let total = items
            .iter()
            .fold(0_u32, |sum, (_, w)| sum.saturating_add(*w));
        let mut left = self.below(total);
        let fits = |(_, weight): &&(T, u32)| {
            let here = left < *weight;
            left = left.saturating_sub(*weight);
            here
        };
        items.iter().find(fits).map(|(item, _)| *item)
    }
}

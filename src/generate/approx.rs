//! Numbers with a bound of how far executors may part on them.

use crate::policy::Model;

/// How exact an executor is that is allowed to differ from the interpreter.
///
/// The default covers what WGSL and Vulkan promise and what filters of textures do in hardware; an executor that is
/// known to do better is held to more.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Precision {
    /// Relative error of one sum or product, of the sum of the sizes of its terms. Compilers may factor and contract
    /// expressions, so it is more than half a unit in the last place: 4 · 2⁻²³.
    pub rounding: f64,
    /// Absolute error of `log2` near 1, where a relative one says nothing (Vulkan: 2⁻²¹ in 0.5…2).
    pub logarithm: f64,
    /// Absolute error of a sample of [`super::Textures`] at exact coordinates: the weights of linear filters have
    /// as few as 8 bits.
    pub sample: f64,
    /// Relative error of the partial results of `expp` and `logp`, of which Direct3D 8 promises ten bits and the
    /// interpreter keeps fifteen.
    pub partial: f64,
}

impl Default for Precision {
    fn default() -> Self {
        Self {
            rounding: 4.0 * f64::from(f32::EPSILON),
            logarithm: 1.0 / 2_097_152.0,
            sample: 1.0 / 512.0,
            partial: 1.0 / 16_384.0,
        }
    }
}

/// A number and how far another executor may be from it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Approx {
    pub(crate) value: f64,
    pub(crate) error: f64,
}

impl Approx {
    pub(super) const ZERO: Self = Self::exact(0.0);
    pub(crate) const ONE: Self = Self::exact(1.0);

    pub(crate) const fn new(value: f64, error: f64) -> Self {
        Self { value, error }
    }

    pub(crate) const fn exact(value: f64) -> Self {
        Self::new(value, 0.0)
    }

    /// Whether every executor has this very number, and few enough bits that sums and products of such numbers are
    /// not rounded, however they are factored: 1/64 steps within ±16 have 10 bits, of the 24 of a float.
    fn is_coarse(self) -> bool {
        self.error == 0.0 && self.value.abs() <= 16.0 && (self.value * 64.0).fract() == 0.0
    }

    /// The result of an operation: exact if it and what it came from are coarse.
    fn result(self, from: &[Approx], inherited: f64, rounded: f64) -> Self {
        let kept = self.is_coarse() && from.iter().all(|a| a.is_coarse());
        let error = if kept { 0.0 } else { inherited + rounded };
        Self::new(self.value, error)
    }

    /// Whether all executors agree on which side of a threshold the number lies.
    ///
    /// Twice the bound, because the bound of what is at the threshold itself was worked out from rounded numbers.
    pub(crate) fn apart_from(self, threshold: f64) -> bool {
        self.error == 0.0 || (self.value - threshold).abs() > 2.0 * self.error
    }

    /// Whether all executors agree on the whole part.
    pub(super) fn whole_is_sure(self) -> bool {
        self.apart_from(self.value.floor()) && self.apart_from(self.value.ceil())
    }

    pub(super) fn negate(self) -> Self {
        Self::new(-self.value, self.error)
    }

    /// Times a power of two, which is exact.
    pub(crate) fn scale(self, by: f64) -> Self {
        Self::new(self.value * by, self.error * by.abs())
    }

    pub(crate) fn plus(self, other: Self, rounding: f64) -> Self {
        let rounded = rounding * (self.value.abs() + other.value.abs());
        Self::exact(self.value + other.value).result(
            &[self, other],
            self.error + other.error,
            rounded,
        )
    }

    pub(super) fn minus(self, other: Self, rounding: f64) -> Self {
        self.plus(other.negate(), rounding)
    }

    pub(crate) fn times(self, other: Self, rounding: f64) -> Self {
        let product = self.value * other.value;
        // A factor that is zero everywhere makes a zero everywhere.
        if self == Self::ZERO || other == Self::ZERO {
            return Self::ZERO;
        }
        let inherited = self.value.abs() * other.error
            + other.value.abs() * self.error
            + self.error * other.error;
        Self::exact(product).result(&[self, other], inherited, rounding * product.abs())
    }

    /// `None` where the divisor may be zero or is known only roughly.
    pub(crate) fn over(self, divisor: Self, rounding: f64) -> Option<Self> {
        let size = divisor.value.abs() - divisor.error;
        if divisor.value.abs() <= 2.0 * divisor.error || size < f64::from(f32::MIN_POSITIVE) {
            return None;
        }
        let quotient = self.value / divisor.value;
        let inherited = (self.error + quotient.abs() * divisor.error) / size;
        Some(Self::new(quotient, inherited + rounding * quotient.abs()))
    }

    /// 2 to this power.
    pub(super) fn exp2(self, rounding: f64) -> Self {
        let value = self.value.exp2();
        let inherited = value * (self.error.exp2() - 1.0);
        // Vulkan: 3 + 2·|x| units in the last place.
        Self::new(
            value,
            inherited + value * rounding * (1.0 + self.value.abs()),
        )
    }

    /// log₂ of the size; `None` where it may be zero.
    pub(super) fn log2(self, precision: &Precision) -> Option<Self> {
        let size = self.value.abs() - self.error;
        if self.value.abs() <= 2.0 * self.error || size < f64::from(f32::MIN_POSITIVE) {
            return None;
        }
        let value = self.value.abs().log2();
        let inherited = self.error / size * std::f64::consts::LOG2_E;
        let rounded = precision.logarithm.max(precision.rounding * value.abs());
        Some(Self::new(value, inherited + rounded))
    }

    /// As the registers of a model hold it: near the middle between two steps executors part by one.
    pub(super) fn held(self, model: Model, rounding: f64) -> Self {
        let Some(steps) = model.steps().map(f64::from) else {
            return self;
        };
        if self.value.is_nan() {
            return Self::ZERO;
        }
        let most = f64::from(model.most());
        let hold = |x: f64| (x.clamp(-most, most) * steps + 0.5).floor();
        // Where every executor has the same number and its product with the steps is exact, all of them round it alike. The
        // bound is a little more than it was worked out to be, because rounded numbers went into it.
        let reach = match self.is_coarse() {
            true => 0.0,
            false => SLIGHTLY_MORE * self.error + rounding * self.value.abs(),
        };
        let here = hold(self.value);
        let (below, above) = (hold(self.value - reach), hold(self.value + reach));
        let apart = (here - below).max(above - here) / steps;
        Self::new(here / steps, apart + divided(model, here / steps, rounding))
    }

    /// As the registers of a model hold a number of which only the error is known.
    pub(super) fn held_somewhere(self, model: Model) -> Self {
        match model.steps().map(f64::from) {
            Some(steps) if self.error > 0.0 => {
                let apart = (SLIGHTLY_MORE * self.error * steps).ceil();
                Self::new(self.value, apart / steps)
            }
            _ => self,
        }
    }

    /// Clamped to 0…1. Beyond the ends by more than the bound, all executors have the end.
    pub(crate) fn saturate(self) -> Self {
        let value = self.value.clamp(0.0, 1.0);
        let sure = self.value - self.error > 1.0 || self.value + self.error < 0.0;
        Self::new(value, if sure { 0.0 } else { self.error })
    }
}

/// What bounds are taken for where a step of a model hangs on them.
const SLIGHTLY_MORE: f64 = 1.01;

/// How far k / 255 may be from the nearest float: WGSL divides within a few units. 4096 is a power of two.
fn divided(model: Model, held: f64, rounding: f64) -> f64 {
    match model {
        Model::Gf3 if held.abs() < 1.0 => rounding * held.abs(),
        _ => 0.0,
    }
}

/// The sum of the products.
pub(super) fn dot(a: &[Approx], b: &[Approx], rounding: f64) -> Approx {
    let products = a.iter().zip(b).map(|(a, b)| a.times(*b, rounding));
    products.fold(Approx::ZERO, |sum, product| sum.plus(product, rounding))
}

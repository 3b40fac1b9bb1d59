//! One source, compiled for several sets of vector instructions, of which one is chosen while the program runs.
//!
//! This is the one corner of the crate with `unsafe`. What makes it sound is all here: a function that is compiled for a set
//! of instructions is only called when [`Simd::is_available`] has said that the processor has them.
//!
//! The code itself is plain loops over arrays; a [`Task`] is compiled once for each set by being inlined into a function
//! with that set switched on. Rust never contracts `a * b + c` nor reorders sums, so the results are the same bits in every set.
#![allow(
    unsafe_code,
    reason = "calls of functions with target features, checked beforehand"
)]

use std::fmt;
use std::str::FromStr;
use std::sync::atomic::{AtomicU8, Ordering::Relaxed};

/// A set of vector instructions. Each includes those before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Simd {
    /// What every processor of the target has: SSE2 on x86-64.
    Baseline,
    /// AVX2, eight floats at a time.
    Avx2,
    /// AVX-512 (F, BW, DQ, VL), sixteen floats at a time.
    Avx512,
}

/// The most that [`Simd::chosen`] may give, as a number.
static MOST: AtomicU8 = AtomicU8::new(u8::MAX);

impl Simd {
    /// All of them, the smallest first.
    pub const ALL: [Self; 3] = [Self::Baseline, Self::Avx2, Self::Avx512];

    /// Whether this processor has them.
    #[inline]
    pub fn is_available(self) -> bool {
        // Asked for every batch: one load.
        static LARGEST: AtomicU8 = AtomicU8::new(u8::MAX);
        let mut largest = LARGEST.load(Relaxed);
        if largest == u8::MAX {
            largest = Self::largest() as u8;
            LARGEST.store(largest, Relaxed);
        }
        self as u8 <= largest
    }

    /// The largest set that this processor has.
    #[cfg(target_arch = "x86_64")]
    fn largest() -> Self {
        let avx2 = is_x86_feature_detected!("avx2")
            && is_x86_feature_detected!("bmi1")
            && is_x86_feature_detected!("bmi2")
            && is_x86_feature_detected!("lzcnt")
            && is_x86_feature_detected!("popcnt");
        let avx512 = is_x86_feature_detected!("avx512f")
            && is_x86_feature_detected!("avx512bw")
            && is_x86_feature_detected!("avx512dq")
            && is_x86_feature_detected!("avx512vl");
        match (avx2, avx512) {
            (true, true) => Self::Avx512,
            (true, false) => Self::Avx2,
            (false, _) => Self::Baseline,
        }
    }

    /// The largest set that there is for this processor.
    #[cfg(not(target_arch = "x86_64"))]
    fn largest() -> Self {
        Self::Baseline
    }

    /// The largest set that the processor has, within what [`Self::limit`] allows.
    pub fn chosen() -> Self {
        let most = MOST.load(Relaxed);
        let allowed = |simd: &Self| *simd as u8 <= most && simd.is_available();
        let chosen = Self::ALL.into_iter().rev().find(allowed);
        chosen.unwrap_or(Self::Baseline)
    }

    /// Uses no larger set from now on, in all threads. For measurements: results do not depend on it.
    pub fn limit(self) {
        MOST.store(self as u8, Relaxed);
    }

    /// Its name: `sse2`, `avx2` or `avx512`; where the target is another one, the first is `plain`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Baseline if cfg!(target_arch = "x86_64") => "sse2",
            Self::Baseline => "plain",
            Self::Avx2 => "avx2",
            Self::Avx512 => "avx512",
        }
    }

    /// Runs a task with these instructions, or with the baseline if the processor does not have them.
    #[inline]
    pub fn run<T: Task>(self, task: T) -> T::Output {
        #[cfg(target_arch = "x86_64")]
        {
            if self == Self::Avx512 && self.is_available() {
                // SAFETY: the processor has all features that the function is compiled for.
                return unsafe { avx512(task) };
            }
            if self == Self::Avx2 && self.is_available() {
                // SAFETY: as above.
                return unsafe { avx2(task) };
            }
        }
        task.run()
    }
}

/// What is compiled once for each set of instructions: a piece of work with what it works on, for [`Simd::run`].
pub trait Task {
    /// What comes of it.
    type Output;

    /// Does it. To be marked `#[inline(always)]`, like everything of weight that it calls: what is not inlined is compiled for
    /// the baseline.
    fn run(self) -> Self::Output;
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,bmi1,bmi2,lzcnt,popcnt")]
fn avx2<T: Task>(task: T) -> T::Output {
    task.run()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512bw,avx512dq,avx512vl,avx2,bmi1,bmi2,lzcnt,popcnt")]
fn avx512<T: Task>(task: T) -> T::Output {
    task.run()
}

impl fmt::Display for Simd {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A set of instructions that none of the known ones is called.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownSimd;

impl fmt::Display for UnknownSimd {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names = Simd::ALL.map(Simd::name);
        write!(f, "write one of {}", names.join(", "))
    }
}

impl std::error::Error for UnknownSimd {}

impl FromStr for Simd {
    type Err = UnknownSimd;

    fn from_str(name: &str) -> Result<Self, UnknownSimd> {
        let is = |simd: &Self| simd.name().eq_ignore_ascii_case(name);
        Self::ALL.into_iter().find(is).ok_or(UnknownSimd)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Sum<'a>(&'a [f32; 64]);

    impl Task for Sum<'_> {
        type Output = [u32; 64];

        #[inline(always)]
        fn run(self) -> [u32; 64] {
            self.0.map(|x| (x * x + 0.1).to_bits())
        }
    }

    #[test]
    fn every_set_gives_the_same_bits() {
        let numbers: [f32; 64] = std::array::from_fn(|i| 1.0 / (i as f32 + 0.3));
        let expected = Simd::Baseline.run(Sum(&numbers));
        for simd in Simd::ALL {
            assert_eq!(simd.run(Sum(&numbers)), expected, "{simd}");
        }
    }

    #[test]
    fn sets_have_names_and_one_is_chosen() {
        for simd in Simd::ALL {
            assert_eq!(simd.name().to_uppercase().parse(), Ok(simd));
        }
        assert!("mmx".parse::<Simd>().is_err());
        assert!(Simd::chosen().is_available());
        assert!(Simd::Baseline.is_available());
    }
}

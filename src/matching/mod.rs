//! CPU and GPU on generated shaders: the same listings, the same inputs, and bounds of how far the numbers may be apart.
//!
//! [`run`] makes shaders of every version ([`crate::generate`]), runs them in the interpreter and, many to a pipeline, on
//! devices ([`crate::gpu::Batch`]), and compares every number that they leave behind with the bound that was worked
//! out for that number. A shader on which the paths part is made small ([`shrink`]) and can be written down as a test case
//! ([`case_text`]). `docs/matching.md` says which tolerance there is for what, and why.
//!
//! Files, in the order of the data: `subject` (one shader on both paths), `coverage`, `case`.

mod case;
mod coverage;
mod subject;

#[cfg(test)]
mod tests;

pub use case::{case_text, describe};
pub use coverage::{Coverage, Group};
pub use subject::{Change, Comparison, Difference, Subject, compare, run_together};

use crate::generate::{self, Precision, Textures, Weights};
use crate::gpu::{Device, GpuError};
use crate::isa::Version;
use crate::policy::{Model, Policies};
use crate::texture::TextureError;
use std::fmt;
use std::sync::Mutex;
use std::sync::PoisonError;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// How many shaders of a version share a pipeline. Compilers take more than twice as long for twice as much.
const BATCH: u64 = 16;

/// After so many shaders on which the paths part a run ends.
pub const MOST_MISMATCHES: usize = 100;

/// What is to be compared.
#[derive(Clone, Debug)]
pub struct Plan {
    /// How many shaders.
    pub count: u64,
    /// The seed of the first; those of the others follow from it.
    pub seed: u64,
    /// Their versions, in turns.
    pub versions: Vec<Version>,
    /// How exact the devices are.
    pub precision: Precision,
    /// The numbers that shaders compute with.
    pub model: Model,
    /// What they do where there is a choice.
    pub policies: Policies,
    /// How often what occurs in them.
    pub weights: Weights,
}

impl Plan {
    /// Version and seed of a shader by its number: the first has the seed of the plan, so that a plan of one shader is a
    /// way to have that one again.
    pub fn shader(&self, number: u64) -> Option<(Version, u64)> {
        let versions = self.versions.len() as u64;
        let version = self.versions.get(number.checked_rem(versions)? as usize)?;
        // An odd factor: all different. 53 bits, which every reader of JSON takes for a whole number.
        const FACTOR: u64 = 0xD134_2543_DE82_EF95;
        let seed = match number {
            0 => self.seed,
            _ => self.seed.wrapping_add(number.wrapping_mul(FACTOR)) & ((1 << 53) - 1),
        };
        Some((*version, seed))
    }

    /// What the shaders of a version are made with.
    pub fn options(&self, version: Version) -> generate::Options {
        generate::Options {
            precision: self.precision,
            model: self.model,
            policies: self.policies,
            weights: self.weights.clone(),
            ..generate::Options::new(version)
        }
    }

    /// The shaders of a unit of work, by their numbers: a batch of each version.
    fn unit(&self, unit: u64) -> Vec<Vec<u64>> {
        let versions = self.versions.len() as u64;
        let first = unit.saturating_mul(BATCH * versions);
        (0..versions)
            .map(|version| {
                (0..BATCH)
                    .map(|i| first.saturating_add(i * versions + version))
                    .filter(|number| *number < self.count)
                    .collect()
            })
            .collect()
    }

    fn units(&self) -> u64 {
        self.count
            .div_ceil(BATCH * (self.versions.len() as u64).max(1))
    }
}

/// What came of a run.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// How many shaders were compared: less than planned if there were too many mismatches.
    pub shaders: u64,
    /// The numbers that were compared. Its differences are empty.
    pub comparison: Comparison,
    /// What occurred in the shaders.
    pub coverage: Coverage,
    /// The shaders on which the paths part, in their order.
    pub mismatches: Vec<Mismatch>,
}

/// A shader on which the paths part.
#[derive(Clone, Debug)]
pub struct Mismatch {
    /// Its number in the run, from 0.
    pub number: u64,
    /// Its seed.
    pub seed: u64,
    /// The shader.
    pub subject: Subject,
    /// Where they part.
    pub differences: Vec<Difference>,
}

/// Why shaders could not be compared.
#[derive(Clone, Debug, PartialEq)]
pub enum MatchError {
    /// The device failed.
    Gpu(GpuError),
    /// The textures could not be made.
    Texture(TextureError),
    /// A listing could not be read back, which is a fault of this crate or of a [`Change`].
    Unreadable(String),
}

impl fmt::Display for MatchError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Gpu(error) => error.fmt(f),
            Self::Texture(error) => error.fmt(f),
            Self::Unreadable(listing) => write!(f, "a listing cannot be read back:\n{listing}"),
        }
    }
}

impl std::error::Error for MatchError {}

impl From<GpuError> for MatchError {
    fn from(error: GpuError) -> Self {
        Self::Gpu(error)
    }
}

/// Compares the shaders of a plan, one thread a device. `progress` is called with how many more are done.
///
/// The report does not depend on how many devices there are, unless the run ends early.
///
/// # Errors
/// [`MatchError`]; a mismatch is none.
pub fn run(
    devices: &[Device],
    plan: &Plan,
    change: Option<Change<'_>>,
    progress: &(dyn Fn(u64) + Sync),
) -> Result<Report, MatchError> {
    let textures = Textures::with_model(plan.model).map_err(MatchError::Texture)?;
    let next = AtomicU64::new(0);
    let stop = AtomicBool::new(false);
    let report = Mutex::new(Ok(Report::default()));
    let work = |device: &Device| {
        while !stop.load(Ordering::Relaxed) {
            let unit = next.fetch_add(1, Ordering::Relaxed);
            if unit >= plan.units() {
                break;
            }
            for batch in plan.unit(unit) {
                let done = self::batch(device, plan, &batch, &textures, change);
                let mut report = report.lock().unwrap_or_else(PoisonError::into_inner);
                let Ok(whole) = report.as_mut() else { return };
                match done {
                    Ok(part) => whole.add(part),
                    Err(error) => {
                        *report = Err(error);
                        stop.store(true, Ordering::Relaxed);
                        return;
                    }
                }
                if whole.mismatches.len() >= MOST_MISMATCHES {
                    stop.store(true, Ordering::Relaxed);
                }
                drop(report);
                progress(batch.len() as u64);
            }
        }
    };
    std::thread::scope(|scope| {
        for device in devices {
            scope.spawn(|| work(device));
        }
    });
    let mut report = report
        .into_inner()
        .unwrap_or_else(PoisonError::into_inner)?;
    report.mismatches.sort_by_key(|mismatch| mismatch.number);
    Ok(report)
}

impl Report {
    fn add(&mut self, part: Report) {
        self.shaders += part.shaders;
        self.comparison.count(&part.comparison);
        self.coverage.add(&part.coverage);
        self.mismatches.extend(part.mismatches);
    }
}

/// Compares some shaders of a plan in one pipeline.
fn batch(
    device: &Device,
    plan: &Plan,
    numbers: &[u64],
    textures: &Textures,
    change: Option<Change<'_>>,
) -> Result<Report, MatchError> {
    let made = numbers.iter().filter_map(|number| {
        let (version, seed) = plan.shader(*number)?;
        let subject = Subject::new(plan.options(version), seed, textures);
        Some(((*number, seed), subject))
    });
    let (names, subjects): (Vec<_>, Vec<_>) = made.unzip();
    let mut report = Report::default();
    let compared = compare(device, &subjects, textures, change)?;
    for (((number, seed), subject), comparison) in names.into_iter().zip(subjects).zip(compared) {
        report.shaders += 1;
        report.comparison.count(&comparison);
        report.coverage.count(&subject.generated, textures);
        if !comparison.differences.is_empty() {
            report.mismatches.push(Mismatch {
                number,
                seed,
                subject,
                differences: comparison.differences,
            });
        }
    }
    Ok(report)
}

/// The shader of a mismatch made as small as it can be while the paths still part on it, run on the device again and again.
///
/// # Errors
/// [`MatchError`], if the device fails.
pub fn shrink(
    device: &Device,
    mismatch: &Mismatch,
    change: Option<Change<'_>>,
) -> Result<Mismatch, MatchError> {
    let model = mismatch.subject.generated.model;
    let textures = Textures::with_model(model).map_err(MatchError::Texture)?;
    let mut failure = None;
    let mut best = mismatch.clone();
    let program = mismatch.subject.generated.program.clone();
    crate::generate::shrink(&program, &mut |program| {
        if failure.is_some() {
            return false;
        }
        let Some(subject) = mismatch.subject.with(program, &textures) else {
            return false;
        };
        match compare(device, std::slice::from_ref(&subject), &textures, change) {
            Ok(mut compared) => {
                let differences = compared.pop().map_or(Vec::new(), |c| c.differences);
                let fails = !differences.is_empty();
                if fails {
                    best.subject = subject;
                    best.differences = differences;
                }
                fails
            }
            // What a change makes of a smaller listing need not have a meaning.
            Err(MatchError::Unreadable(_)) => false,
            Err(error) => {
                failure = Some(error);
                false
            }
        }
    });
    match failure {
        Some(error) => Err(error),
        None => Ok(best),
    }
}

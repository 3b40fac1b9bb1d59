//! A listing that is run with values set by hand: what `eval` and `debug` have in common.

use super::shaders::{Reading, not_one};
use super::{Failure, computing, diagnostics};
use texcrd::debug::Given;
use texcrd::diagnostic::{SourceMap, any_error};
use texcrd::isa::Version;
use texcrd::kernel::{self, Kernel};
use texcrd::program::Program;

/// A listing that can run.
pub(super) struct Loaded {
    pub(super) sources: SourceMap,
    pub(super) program: Program,
    pub(super) kernel: Kernel,
}

/// Reads a listing, or the one shader of a file that is meant, and says what is wrong with it.
pub(super) fn load(
    path: &str,
    reading: &Reading,
    options: &kernel::Options,
) -> Result<Loaded, Failure> {
    let mut sources = SourceMap::new();
    let opened = reading.open(&mut sources, path)?;
    let (all, found) = reading.check_all(&mut sources, path, &opened, false)?;
    let [checked] = &all[..] else {
        if opened.shaders.is_empty() {
            anstream::eprint!("{}", diagnostics::render(&sources, &found));
        }
        return Err(not_one(&opened, path));
    };
    anstream::eprint!("{}", diagnostics::render(&sources, &found));
    let program = checked.program.as_ref().filter(|_| !any_error(&found));
    let Some(program) = program else {
        return Err(match diagnostics::summary(&found) {
            Some(summary) if any_error(&found) => Failure::Input(summary),
            _ => Failure::Rejected,
        });
    };
    computing::note(options.model, &[program]);
    let kernel = kernel::lower(program, options).map_err(|e| Failure::Input(e.to_string()))?;
    Ok(Loaded {
        program: program.clone(),
        kernel,
        sources,
    })
}

/// The values of `--set REG=X[,Y[,Z[,W]]]`.
pub(super) fn given(settings: &[String], version: Version) -> Result<Given, Failure> {
    let mut given = Given::default();
    for setting in settings {
        let wrong = |why: &str| Failure::Io(format!("--set {setting}: {why}"));
        let (name, numbers) = setting
            .split_once('=')
            .ok_or_else(|| wrong("write it as v0=1,2,3,4"))?;
        // What is not four numbers at most is said by `set`.
        let numbers = values(numbers).unwrap_or_default();
        given
            .set(version, name, &numbers)
            .map_err(|why| wrong(&why.to_string()))?;
    }
    Ok(given)
}

/// Numbers with commas between them; `inf` and `nan` are numbers, 1e99 is none.
fn values(numbers: &str) -> Option<Vec<f32>> {
    (numbers.split(','))
        .map(|n| n.trim().parse().ok())
        .map(|n: Option<f32>| n.filter(|n| n.is_finite() || !numbers.contains(char::is_numeric)))
        .collect()
}

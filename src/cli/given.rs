//! A listing that is run with values set by hand: what `eval` and `debug` have in common.

use super::shaders::{Opened, Reading, not_one};
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

/// The shaders of a file that can run.
pub(super) struct All {
    pub(super) sources: SourceMap,
    pub(super) shaders: Vec<Runnable>,
    /// Whether the file has others, which were refused.
    pub(super) refused: bool,
}

/// One of several shaders.
pub(super) struct Runnable {
    pub(super) name: String,
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
    if opened.shaders.len() > 1 {
        return Err(not_one(&opened, path));
    }
    let mut all = run_able(path, reading, options, sources, &opened)?;
    match all.shaders.pop() {
        Some(one) if !all.refused => Ok(Loaded {
            sources: all.sources,
            program: one.program,
            kernel: one.kernel,
        }),
        _ => Err(Failure::Rejected),
    }
}

/// Reads the shaders of a file that are meant, and says what is wrong with them.
pub(super) fn load_all(
    path: &str,
    reading: &Reading,
    options: &kernel::Options,
) -> Result<All, Failure> {
    let mut sources = SourceMap::new();
    let opened = reading.open(&mut sources, path)?;
    run_able(path, reading, options, sources, &opened)
}

fn run_able(
    path: &str,
    reading: &Reading,
    options: &kernel::Options,
    mut sources: SourceMap,
    opened: &Opened,
) -> Result<All, Failure> {
    let (all, found) = reading.check_all(&mut sources, path, opened, false)?;
    anstream::eprint!("{}", diagnostics::render(&sources, &found));
    if opened.shaders.is_empty() {
        return Err(not_one(opened, path));
    }
    let mut shaders = Vec::new();
    for ((name, _), checked) in opened.shaders.iter().zip(all) {
        let Some(program) = checked.accepted().cloned() else {
            continue;
        };
        let kernel = kernel::lower(&program, options).map_err(|e| Failure::Input(e.to_string()))?;
        shaders.push(Runnable {
            name: name.clone(),
            program,
            kernel,
        });
    }
    let refused = shaders.len() < opened.shaders.len() || any_error(&found);
    if shaders.is_empty() || any_error(&opened.file.diagnostics) {
        return Err(match diagnostics::summary(&found) {
            Some(summary) if any_error(&found) => Failure::Input(summary),
            _ => Failure::Rejected,
        });
    }
    let programs: Vec<&Program> = shaders.iter().map(|shader| &shader.program).collect();
    computing::note(options.model, &programs);
    Ok(All {
        sources,
        shaders,
        refused,
    })
}

/// The values of `--set REG=X[,Y[,Z[,W]]]` for a shader.
pub(super) fn given(settings: &[String], version: Version) -> Result<Given, Failure> {
    let mut all = given_each(settings, &[version])?;
    Ok(all.pop().unwrap_or_default())
}

/// The values of `--set` for several shaders: each takes those of registers that its version has. A register that none of
/// them has is a mistake.
pub(super) fn given_each(settings: &[String], versions: &[Version]) -> Result<Vec<Given>, Failure> {
    let mut all = vec![Given::default(); versions.len()];
    for setting in settings {
        let wrong = |why: &str| Failure::Io(format!("--set {setting}: {why}"));
        let (name, numbers) = setting
            .split_once('=')
            .ok_or_else(|| wrong("write it as v0=1,2,3,4"))?;
        // What is not four numbers at most is said by `set`.
        let numbers = values(numbers).unwrap_or_default();
        let mut taken = false;
        let mut refusal = None;
        for (given, version) in all.iter_mut().zip(versions) {
            match given.set(*version, name, &numbers) {
                Ok(()) => taken = true,
                Err(why) => refusal = refusal.or(Some(why)),
            }
        }
        if let (false, Some(why)) = (taken, refusal) {
            return Err(wrong(&why.to_string()));
        }
    }
    Ok(all)
}

/// Numbers with commas between them; `inf` and `nan` are numbers, 1e99 is none.
fn values(numbers: &str) -> Option<Vec<f32>> {
    (numbers.split(','))
        .map(|n| n.trim().parse().ok())
        .map(|n: Option<f32>| n.filter(|n| n.is_finite() || !numbers.contains(char::is_numeric)))
        .collect()
}

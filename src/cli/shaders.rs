//! The shaders of the files that commands are given, whatever the files are.

use super::{Failure, dialect, files};
use std::path::PathBuf;
use texcrd::diagnostic::{Diagnostic, SourceMap, TooLarge};
use texcrd::extract::{self, File, NotOne, Shader};
use texcrd::listing::{self, Checked};
use texcrd::policy::Dialect;
use texcrd::preprocess::{self, Definition, Folders};

/// How files with shaders are read.
#[derive(clap::Args)]
pub(super) struct Reading {
    /// Of a file with several shaders (an effect, a source of C), only this one: its name, its number from 1, or the
    /// technique or pass that it stands in. May be given several times.
    #[arg(long, value_name = "NAME|N")]
    shader: Vec<String>,
    /// Define a macro for the preprocessor, as `#define NAME VALUE` does; 1 without a value.
    #[arg(short = 'D', long = "define", value_name = "NAME[=VALUE]")]
    define: Vec<Definition>,
    /// Look for included files in this folder, too.
    #[arg(short = 'I', long = "include", value_name = "FOLDER")]
    include: Vec<PathBuf>,
    /// Whose rules: d3d8, d3d9 or lenient.
    #[arg(long, value_parser = dialect, default_value = "d3d8")]
    pub(super) dialect: Dialect,
}

/// A file and the shaders of it that are meant.
pub(super) struct Opened {
    pub(super) file: File,
    /// Their names and themselves.
    pub(super) shaders: Vec<(String, Shader)>,
}

/// The shaders of a file that are meant: those of these names, or all of them.
pub(super) fn pick(file: File, wanted: &[String], path: &str) -> Result<Opened, Failure> {
    let mut opened = Opened {
        file,
        shaders: Vec::new(),
    };
    let names = opened.file.names();
    let mut picked: Vec<usize> = Vec::new();
    for wanted in wanted {
        let found = opened.file.find(wanted);
        if found.is_empty() {
            let (wanted, list) = (wanted.clone(), opened.file.list());
            let unknown = NotOne::Unknown { wanted, list };
            return Err(Failure::Io(format!("{}: {unknown}", files::name(path))));
        }
        picked.extend(found);
    }
    if wanted.is_empty() {
        picked.extend(0..names.len());
    }
    picked.sort_unstable();
    picked.dedup();
    let one = |at: usize| Some((names.get(at)?.clone(), opened.file.shaders.get(at)?.clone()));
    opened.shaders = picked.into_iter().filter_map(one).collect();
    Ok(opened)
}

/// A file in which nothing was found, or from which one shader must be picked.
pub(super) fn not_one(opened: &Opened, path: &str) -> Failure {
    let name = files::name(path);
    match opened.shaders.len() {
        0 => Failure::Input(format!("{name}: {}", NotOne::Nothing)),
        _ => Failure::Io(format!(
            "{name}: this file holds several shaders: pick one with --shader, of {}",
            opened.file.list()
        )),
    }
}

pub(super) fn too_large(error: TooLarge) -> Failure {
    Failure::Input(error.to_string())
}

impl Reading {
    /// Reads a file and finds the shaders that are meant.
    pub(super) fn open(&self, sources: &mut SourceMap, path: &str) -> Result<Opened, Failure> {
        self.open_bytes(sources, path, files::read(path)?)
    }

    /// As [`Self::open`], of a file that has been read.
    pub(super) fn open_bytes(
        &self,
        sources: &mut SourceMap,
        path: &str,
        bytes: Vec<u8>,
    ) -> Result<Opened, Failure> {
        let resolver = self.folders(path);
        let options = preprocess::Options {
            definitions: &self.define,
            resolver: &resolver,
        };
        let file = extract::open(sources, files::name(path), bytes, &options).map_err(too_large)?;
        pick(file, &self.shader, path)
    }

    /// Reads and judges one shader of a file. `unchecked`: only its text is judged.
    pub(super) fn check(
        &self,
        sources: &mut SourceMap,
        path: &str,
        shader: &Shader,
        unchecked: bool,
    ) -> Result<Checked, Failure> {
        let resolver = self.folders(path);
        let options = listing::Options {
            dialect: self.dialect,
            unchecked,
            preprocess: preprocess::Options {
                definitions: &self.define,
                resolver: &resolver,
            },
            ..Default::default()
        };
        extract::check(sources, shader, &options).map_err(too_large)
    }

    /// Reads and judges all of an opened file: its programs, and everything that is to be said of it.
    pub(super) fn check_all(
        &self,
        sources: &mut SourceMap,
        path: &str,
        opened: &Opened,
        unchecked: bool,
    ) -> Result<(Vec<Checked>, Vec<Diagnostic>), Failure> {
        let mut found = opened.file.diagnostics.clone();
        let mut all = Vec::new();
        for (_, shader) in &opened.shaders {
            let checked = self.check(sources, path, shader, unchecked)?;
            // Files that several shaders share are told of once.
            for diagnostic in &checked.diagnostics {
                if !found.contains(diagnostic) {
                    found.push(diagnostic.clone());
                }
            }
            all.push(checked);
        }
        Ok((all, found))
    }

    fn folders<'a>(&'a self, path: &'a str) -> Folders<'a> {
        Folders {
            file: path,
            folders: &self.include,
        }
    }
}

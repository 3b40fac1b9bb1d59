//! Where included files come from.

use std::collections::BTreeMap;
use std::io;

/// A file that is included.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Included {
    /// How the resolver knows it: what it is given as `from` for the files that this one includes.
    pub path: String,
    /// What messages call it.
    pub name: String,
    /// What it holds.
    pub bytes: Vec<u8>,
}

/// Gives the files that listings include, wherever they lie.
pub trait Resolver {
    /// The file that `#include` names: `path` as it is written, `angled` if it stands in `<` `>`, `from` the
    /// [`Included::path`] of the file that includes it, `None` if that is the first text.
    ///
    /// # Errors
    /// Whatever keeps the file from being read; the text goes into the message.
    fn include(&self, path: &str, angled: bool, from: Option<&str>) -> io::Result<Included>;
}

/// No files: for texts that stand alone.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoFiles;

impl Resolver for NoFiles {
    fn include(&self, _: &str, _: bool, _: Option<&str>) -> io::Result<Included> {
        Err(io::Error::new(
            io::ErrorKind::NotFound,
            "no files can be read here",
        ))
    }
}

/// Files in memory, by the path that listings write.
impl Resolver for BTreeMap<String, Vec<u8>> {
    fn include(&self, path: &str, _: bool, _: Option<&str>) -> io::Result<Included> {
        let missing = || io::Error::new(io::ErrorKind::NotFound, "there is no such file");
        Ok(Included {
            path: path.to_string(),
            name: path.to_string(),
            bytes: self.get(path).ok_or_else(missing)?.clone(),
        })
    }
}

//! Files that listings include, on disk.

use super::resolve::{Included, Resolver};
use crate::diagnostic::SourceMap;
use std::fs;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// Looks for included files on disk: beside the file that includes them and in further folders, as compilers do. In angle
/// brackets the folders come first.
#[derive(Clone, Copy, Debug)]
pub struct Folders<'a> {
    /// The path of the file that is read; `-` is standard input, which lies in the current folder.
    pub file: &'a str,
    /// The further folders, those of `-I`, in their order.
    pub folders: &'a [PathBuf],
}

impl Resolver for Folders<'_> {
    fn include(&self, path: &str, angled: bool, from: Option<&str>) -> io::Result<Included> {
        self.include_beside(path, angled, from, &|_| None)
    }
}

impl Folders<'_> {
    /// As [`Resolver::include`], where somebody may have files open and have changed them: `open` gives the text of such a
    /// file, which goes before what the disk has at its place.
    ///
    /// # Errors
    /// There is no such file, or it cannot be read.
    pub fn include_beside(
        &self,
        path: &str,
        angled: bool,
        from: Option<&str>,
        open: &dyn Fn(&Path) -> Option<Vec<u8>>,
    ) -> io::Result<Included> {
        let from = Path::new(from.unwrap_or(if self.file == "-" { "" } else { self.file }));
        let own = from.parent().unwrap_or(Path::new("")).to_path_buf();
        let given = self.folders.iter().cloned();
        let folders: Vec<PathBuf> = match angled {
            true => given.chain([own]).collect(),
            false => std::iter::once(own).chain(given).collect(),
        };
        // Listings were written on Windows.
        let path = path.replace('\\', "/");
        let missing = || io::Error::new(io::ErrorKind::NotFound, "there is no such file");
        let found = folders.iter().find_map(|folder| {
            let named = folder.join(&path);
            if let Some(bytes) = open(&named) {
                return Some((named, Some(bytes)));
            }
            let place = place(folder, &path)?;
            let bytes = open(&place);
            Some((place, bytes))
        });
        let (place, bytes) = match found.ok_or_else(missing)? {
            (place, Some(bytes)) => (place, bytes),
            (place, None) => {
                // One byte more than the sources take, so that it is seen to be too long.
                let most = SourceMap::MAX_BYTES as u64 + 1;
                let mut bytes = Vec::new();
                fs::File::open(&place)?.take(most).read_to_end(&mut bytes)?;
                (place, bytes)
            }
        };
        let name = place.display().to_string();
        Ok(Included {
            path: name.clone(),
            name,
            bytes,
        })
    }
}

/// The file at a path below a folder. Where there is none, one whose name differs only in the case of letters will do, as
/// it did on Windows. Pipes and devices are no files.
fn place(folder: &Path, path: &str) -> Option<PathBuf> {
    let exact = folder.join(path);
    if exact.is_file() {
        return Some(exact);
    }
    let mut place = folder.to_path_buf();
    for part in Path::new(path).components() {
        let next = place.join(part);
        place = match next.exists() {
            true => next,
            false => alike(&place, part.as_os_str().to_str()?)?,
        };
    }
    place.is_file().then_some(place)
}

/// What is called so in a folder, but for the case of letters; the first by name.
fn alike(folder: &Path, name: &str) -> Option<PathBuf> {
    // More than a folder of shaders has.
    const LOOKED_AT: usize = 10_000;
    let folder = if folder == Path::new("") {
        Path::new(".")
    } else {
        folder
    };
    let same = |entry: &fs::DirEntry| {
        entry
            .file_name()
            .to_str()
            .is_some_and(|n| n.eq_ignore_ascii_case(name))
    };
    let entries = fs::read_dir(folder).ok()?.take(LOOKED_AT).flatten();
    entries.filter(same).map(|entry| entry.path()).min()
}

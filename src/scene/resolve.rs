//! Where the files come from that a scene names.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, Read};
use std::path::PathBuf;

/// The longest file that [`DirectoryResolver`] reads, in bytes (256 MiB).
pub const MAX_FILE_BYTES: u64 = 256 << 20;

/// Gives the bytes of the files that a scene names, wherever they lie.
pub trait Resolver {
    /// The bytes of a file; `path` as the scene file writes it, relative to the scene file.
    ///
    /// # Errors
    /// Whatever keeps the file from being read; the text goes into the message.
    fn read(&self, path: &str) -> io::Result<Vec<u8>>;

    /// The name under which messages speak of the file.
    fn display_name(&self, path: &str) -> String {
        path.to_owned()
    }
}

/// Files of a folder on disk.
#[derive(Clone, Debug)]
pub struct DirectoryResolver {
    root: PathBuf,
}

impl DirectoryResolver {
    /// Reads relative to `root`, the folder of the scene file. Absolute paths are taken as they are.
    pub fn new(root: impl Into<PathBuf>) -> Self {
        Self { root: root.into() }
    }
}

impl Resolver for DirectoryResolver {
    fn read(&self, path: &str) -> io::Result<Vec<u8>> {
        let mut bytes = Vec::new();
        File::open(self.root.join(path))?
            .take(MAX_FILE_BYTES + 1)
            .read_to_end(&mut bytes)?;
        if bytes.len() as u64 > MAX_FILE_BYTES {
            return Err(io::Error::other(format!(
                "it has more than {MAX_FILE_BYTES} bytes"
            )));
        }
        Ok(bytes)
    }

    fn display_name(&self, path: &str) -> String {
        self.root.join(path).display().to_string()
    }
}

/// Files in memory, by the path that the scene file writes.
impl Resolver for BTreeMap<String, Vec<u8>> {
    fn read(&self, path: &str) -> io::Result<Vec<u8>> {
        self.get(path)
            .cloned()
            .ok_or_else(|| io::Error::new(io::ErrorKind::NotFound, "there is no such file"))
    }
}

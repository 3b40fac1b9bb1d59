//! Reading listings and writing results.

use super::Failure;
use std::fs;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use texcrd::diagnostic::SourceMap;

/// Reads a listing; `-` is standard input. Of a file that is longer than any listing only so much is read as shows
/// that it is.
pub(super) fn read(path: &str) -> Result<Vec<u8>, Failure> {
    let most = SourceMap::MAX_BYTES as u64 + 1;
    let mut bytes = Vec::new();
    let read = match path {
        "-" => std::io::stdin().lock().take(most).read_to_end(&mut bytes),
        _ => fs::File::open(path).and_then(|file| file.take(most).read_to_end(&mut bytes)),
    };
    read.map_err(|e| Failure::Io(format!("{}: {e}", name(path))))?;
    Ok(bytes)
}

/// What a path is called in messages.
pub(super) fn name(path: &str) -> &str {
    if path == "-" { "<stdin>" } else { path }
}

/// Writes a file so that it is there whole or not at all: first beside its place, then moved onto it.
pub(super) fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let failed = |e: std::io::Error| Failure::Io(format!("{}: {e}", path.display()));
    if path == Path::new("-") {
        return std::io::stdout().write_all(bytes).map_err(failed);
    }
    // Devices and pipes cannot be replaced by a file.
    if fs::metadata(path).is_ok_and(|m| !m.is_file()) {
        return fs::write(path, bytes).map_err(failed);
    }
    let mut beside = path.as_os_str().to_owned();
    beside.push(format!(".{}.part", std::process::id()));
    let beside = PathBuf::from(beside);
    let written = fs::write(&beside, bytes).and_then(|()| fs::rename(&beside, path));
    if written.is_err() {
        // Nothing more can be done about a part that cannot be removed either.
        let _ = fs::remove_file(&beside);
    }
    written.map_err(failed)
}

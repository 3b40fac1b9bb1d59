//! Reading listings and writing results.

use super::Failure;
use std::fs;
use std::io::Read;
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

/// Writes a file so that it is there whole or not at all: first beside its place, then moved onto it. A link is
/// followed, and a file that is replaced keeps its permissions.
pub(super) fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let failed = |e: std::io::Error| Failure::Io(format!("{}: {e}", path.display()));
    if path == Path::new("-") {
        return super::print_bytes(bytes);
    }
    let place = target_of(path);
    let before = fs::metadata(&place).ok();
    // Devices and pipes cannot be replaced by a file.
    if before.as_ref().is_some_and(|m| !m.is_file()) {
        return fs::write(&place, bytes).map_err(failed);
    }
    if before.as_ref().is_some_and(|m| m.permissions().readonly()) {
        return Err(failed(std::io::ErrorKind::PermissionDenied.into()));
    }
    let mut beside = place.as_os_str().to_owned();
    beside.push(format!(".{}.part", std::process::id()));
    let beside = PathBuf::from(beside);
    let written = fs::write(&beside, bytes)
        .and_then(|()| match &before {
            Some(before) => fs::set_permissions(&beside, before.permissions()),
            None => Ok(()),
        })
        .and_then(|()| fs::rename(&beside, &place));
    if written.is_err() {
        // Nothing more can be done about a part that cannot be removed either.
        let _ = fs::remove_file(&beside);
    }
    written.map_err(failed)
}

/// Where a path leads, links followed, also where nothing is yet.
fn target_of(path: &Path) -> PathBuf {
    // A chain of links that is longer than this runs in a circle.
    const LONGEST: usize = 40;
    let mut place = path.to_path_buf();
    for _ in 0..LONGEST {
        let Ok(next) = fs::read_link(&place) else {
            break;
        };
        place = match place.parent() {
            Some(folder) => folder.join(next),
            None => next,
        };
    }
    place
}

/// Whether a file can be written there, as far as that can be told without writing it: before long work.
pub(super) fn can_be_written(path: &Path) -> Result<(), Failure> {
    let place = target_of(path);
    let folder = match place.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    if place.is_dir() {
        let why = std::io::ErrorKind::IsADirectory;
        return Err(Failure::Io(format!("{}: {why}", path.display())));
    }
    if path == Path::new("-") || folder.is_dir() {
        return Ok(());
    }
    let folder = folder.display();
    Err(Failure::Io(format!(
        "{}: there is no folder {folder}",
        path.display()
    )))
}

/// Refuses to write over one of the files that were read: a listing may be the only copy.
///
/// # Errors
/// [`Failure::Io`].
pub(super) fn is_no_input<'a>(
    path: &Path,
    inputs: impl IntoIterator<Item = &'a String>,
) -> Result<(), Failure> {
    let Ok(place) = fs::canonicalize(path) else {
        return Ok(());
    };
    let is_this = |input: &&String| fs::canonicalize(input).is_ok_and(|input| input == place);
    match inputs.into_iter().find(is_this) {
        Some(_) => Err(Failure::Io(format!(
            "{}: this file is read; write to another one",
            path.display()
        ))),
        None => Ok(()),
    }
}

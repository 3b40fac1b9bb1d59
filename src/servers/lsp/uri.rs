//! Addresses of documents, and the paths of those that are files.

use std::path::{Component, Path, PathBuf};

/// The path that a `file:` address names.
pub(super) fn path_of(uri: &str) -> Option<PathBuf> {
    let rest = uri.strip_prefix("file://")?;
    // What stands before the path is a machine; none, or this one.
    let slash = rest.find('/')?;
    let (machine, path) = rest.split_at(slash);
    let path = path.split(['?', '#']).next().unwrap_or_default();
    let path = String::from_utf8(decoded(path)).ok()?;
    if cfg!(windows) {
        let share = !machine.is_empty() && machine != "localhost";
        let drive = path.strip_prefix('/').unwrap_or(&path);
        return Some(match share {
            true => PathBuf::from(format!("//{machine}{path}")),
            false => PathBuf::from(drive),
        });
    }
    matches!(machine, "" | "localhost").then(|| PathBuf::from(path))
}

/// The address of a path.
pub(super) fn of_path(path: &Path) -> String {
    let text = path.display().to_string();
    let text = if cfg!(windows) {
        text.replace('\\', "/")
    } else {
        text
    };
    let mut uri = String::from("file://");
    if !text.starts_with('/') {
        uri.push('/');
    }
    for byte in text.bytes() {
        let plain = byte.is_ascii_alphanumeric() || b"/-._~".contains(&byte);
        match plain {
            true => uri.push(char::from(byte)),
            false => uri.push_str(&format!("%{byte:02X}")),
        }
    }
    uri
}

/// A path without `.` and `..`, as far as that can be told from its text: what tells whether two paths name one file.
pub(super) fn plain(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir if plain.file_name().is_some() => {
                plain.pop();
            }
            other => plain.push(other),
        }
    }
    plain
}

fn decoded(text: &str) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let Some((&first, behind)) = rest.split_first() {
        let digit = |at: usize| behind.get(at).and_then(|b| char::from(*b).to_digit(16));
        if let (b'%', Some(high), Some(low)) = (first, digit(0), digit(1)) {
            bytes.push((high * 16 + low) as u8);
            rest = behind.get(2..).unwrap_or(&[]);
        } else {
            bytes.push(first);
            rest = behind;
        }
    }
    bytes
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn files_have_addresses_and_addresses_files() {
        let path = Path::new("/a folder/w\u{e4}ter#1.psh");
        let uri = of_path(path);
        assert_eq!(uri, "file:///a%20folder/w%C3%A4ter%231.psh");
        assert_eq!(path_of(&uri).unwrap(), path);
        assert_eq!(
            path_of("file://localhost/a%2Fb").unwrap(),
            Path::new("/a/b")
        );
        for other in [
            "untitled:Untitled-1",
            "file://server/x",
            "file:///%FF",
            "",
            "file://",
        ] {
            assert_eq!(path_of(other), None, "{other}");
        }
    }

    #[test]
    fn paths_that_name_one_file_are_one() {
        assert_eq!(plain(Path::new("/a/./b/../c.inc")), Path::new("/a/c.inc"));
        assert_eq!(plain(Path::new("../x")), Path::new("../x"));
    }
}

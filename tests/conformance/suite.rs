//! The cases of `tests/conformance`, for the tests that run them.

use std::fs;
use std::path::{Path, PathBuf};
use texcrd::case::Case;
use texcrd::scene::{DirectoryResolver, LoadOptions};

fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("the folder can be read") {
        let path = entry.expect("its entries too").path();
        if path.is_dir() {
            files(&path, found);
        } else if path.extension().is_some_and(|e| e == "toml" || e == "json") {
            found.push(path);
        }
    }
}

/// The folder of the cases.
pub(crate) fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/conformance")
}

/// Every case with its path in the folder, in the order of the paths.
pub(crate) fn cases() -> Vec<(String, Case)> {
    let root = root();
    let mut paths = Vec::new();
    files(&root, &mut paths);
    paths.sort();
    (paths.iter())
        .map(|path| {
            let name = path
                .strip_prefix(&root)
                .expect("it lies below")
                .display()
                .to_string();
            let bytes = fs::read(path).expect("a case can be read");
            let resolver = DirectoryResolver::new(path.parent().expect("it lies in a folder"));
            let case = Case::load(&name, &bytes, &resolver, &LoadOptions::default());
            (name, case.unwrap_or_else(|error| panic!("{error}")))
        })
        .collect()
}

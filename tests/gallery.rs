//! The gallery of `asm/`: every scene loads, and no listing of ours has a warning.
#![allow(clippy::expect_used, reason = "a test that cannot go on has failed")]

use std::fs;
use std::path::{Path, PathBuf};
use texcrd::policy::Dialect;
use texcrd::scene::{DirectoryResolver, LoadOptions, Scene};

/// Files with this ending in the folders of the gallery; the restored listings apart, which are as they were printed.
fn files(ending: &str) -> Vec<PathBuf> {
    let list = |folder: &Path| -> Vec<PathBuf> {
        let entries = fs::read_dir(folder).expect("the folder can be read");
        entries
            .map(|entry| entry.expect("an entry").path())
            .collect()
    };
    let folders = list(&Path::new(env!("CARGO_MANIFEST_DIR")).join("asm"));
    let own = |folder: &PathBuf| folder.is_dir() && !folder.ends_with("stained_glass");
    let mut files: Vec<_> = (folders.iter().filter(|folder| own(folder)))
        .flat_map(|folder| list(folder))
        .filter(|file| file.extension().is_some_and(|found| found == ending))
        .collect();
    files.sort();
    files
}

#[test]
fn listings_have_no_warnings() {
    let listings = [files("vsh"), files("psh")].concat();
    assert!(listings.len() >= 30, "only {} listings", listings.len());
    for file in listings {
        let text = fs::read(&file).expect("the listing can be read");
        let text = String::from_utf8(text).expect("the listing is UTF-8");
        let report = texcrd::validate(text, Dialect::D3d8).to_string();
        assert_eq!(report, "", "{}", file.display());
    }
}

#[test]
fn scenes_load() {
    let mut count = 0;
    for file in files("toml") {
        let bytes = fs::read(&file).expect("the scene can be read");
        let name = file.display().to_string();
        // What scenes share draws nothing by itself, and has no camera.
        if !String::from_utf8_lossy(&bytes).contains("\n[camera]\n") {
            continue;
        }
        let folder = file.parent().expect("a file is in a folder");
        let resolver = DirectoryResolver::new(folder);
        let scene = Scene::load(&name, &bytes, &resolver, &LoadOptions::default());
        let scene = scene.unwrap_or_else(|error| panic!("{error}"));
        assert!(
            scene.warnings().is_empty(),
            "{name}: {:?}",
            scene.warnings()
        );
        count += 1;
    }
    assert!(count >= 25, "only {count} scenes");
}

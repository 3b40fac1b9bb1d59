//! What several benchmarks need.

use std::path::Path;
use texcrd::scene::{DirectoryResolver, LoadOptions, Scene};

/// A scene by its path in the repository.
pub(crate) fn scene(path: &str) -> Scene {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let path = folder.join(path);
    let bytes = std::fs::read(&path).expect("the scene is there");
    let resolver = DirectoryResolver::new(path.parent().unwrap_or(folder));
    Scene::load("scene", &bytes, &resolver, &LoadOptions::default()).expect("the scene is sound")
}

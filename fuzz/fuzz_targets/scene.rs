//! A scene file. There are no other files, so shaders and textures stand in it.
#![no_main]

use libfuzzer_sys::fuzz_target;
use std::collections::BTreeMap;
use texcrd::scene::{LoadOptions, Scene};

fuzz_target!(|bytes: &[u8]| {
    let files: BTreeMap<String, Vec<u8>> = BTreeMap::new();
    let loaded = Scene::load("scene.toml", bytes, &files, &LoadOptions::default());
    if let Err(error) = loaded {
        for diagnostic in &error.diagnostics {
            assert!(
                error.sources.locate(diagnostic.span).is_some(),
                "{diagnostic:?}"
            );
        }
    }
});

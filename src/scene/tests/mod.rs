mod broken;
mod camera;
mod definitions;
mod documented;
mod history;
mod meanings;
mod pictures;
mod pixels;
mod refused;
mod surroundings;
mod targets;

use std::collections::BTreeMap;

use super::{LoadOptions, RenderOptions, Scene, SceneError};
use crate::raster::Target;

type MemoryFiles = BTreeMap<String, Vec<u8>>;

/// The files that scenes of these tests name.
fn files() -> MemoryFiles {
    [
        ("flat.vsh", "vs.1.1\nmov oPos, v0\n"),
        ("c0.psh", "ps.1.1\nmov r0, c0\n"),
        ("stage0.psh", "ps.1.1\ntex t0\nmov r0, t0\n"),
        (
            "sub/a.psh",
            "ps.1.1\n#include \"b.inc\"\n#include \"none.inc\"\n",
        ),
        ("sub/b.inc", "#define R r0\nmov R, c0\nmov R, v9\n"),
        ("broken.psh", "ps.1.1\nmov r0, c0\nmvo r0, c0\n"),
    ]
    .into_iter()
    .map(|(name, text)| (name.to_owned(), text.as_bytes().to_vec()))
    .collect()
}

fn load(text: &str) -> Result<Scene, Box<SceneError>> {
    Scene::load(
        "scene.toml",
        text.as_bytes(),
        &files(),
        &LoadOptions::default(),
    )
}

fn loaded(text: &str) -> Scene {
    load(text).unwrap_or_else(|error| panic!("{error}"))
}

fn rendered(text: &str) -> Target {
    loaded(text)
        .render(&RenderOptions::default(), &|_| {})
        .unwrap()
}

/// All pixels, row by row.
fn pixels(target: &Target) -> Vec<[u8; 4]> {
    (0..target.height())
        .flat_map(|y| (0..target.width()).map(move |x| target.color(x, y).unwrap()))
        .collect()
}

/// A rectangle that covers clip space from (x0, y0), bottom left, to (x1, y1), clockwise from the front.
fn quad([x0, y0, x1, y1]: [f32; 4]) -> String {
    format!(
        "positions = [[{x0:?}, {y1:?}, 0.5], [{x1:?}, {y1:?}, 0.5], [{x1:?}, {y0:?}, 0.5], [{x0:?}, {y0:?}, 0.5]]\n\
         texcoords = [[0, 0], [1, 0], [1, 1], [0, 1]]\nindices = [0, 1, 2, 0, 2, 3]\n"
    )
}

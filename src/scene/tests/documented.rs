//! The description of the format.

use super::*;

const DOCUMENT: &str = include_str!("../../../docs/scene.md");

/// The TOML examples of the document.
fn examples() -> Vec<String> {
    let blocks = DOCUMENT.split("```toml\n").skip(1);
    blocks
        .map(|block| block.split("```").next().unwrap().to_owned())
        .collect()
}

#[test]
fn the_example_runs_and_shows_a_ball() {
    let examples = examples();
    assert_eq!(examples.len(), 1);
    let scene = loaded(&examples[0]);
    assert!(scene.warnings().is_empty(), "{:?}", scene.warnings());
    let picture = scene.render(&RenderOptions::default(), &|_| {}).unwrap();
    let clear = [26, 26, 51, 255];
    // The ball is around the middle, and nothing is in the corners.
    assert_ne!(picture.color(160, 120), Some(clear));
    assert_eq!(picture.color(0, 0), Some(clear));
    assert_eq!(picture.color(319, 239), Some(clear));
    // The light goes to the right and down: the upper left is brighter than the lower right, bricks and mortar together.
    let brightness = |x: u32, y: u32| -> u32 {
        let block = (0..30).flat_map(|j| (0..30).map(move |i| (x + i, y + j)));
        block
            .filter_map(|(x, y)| picture.color(x, y))
            .map(|[r, g, b, _]| u32::from(r) + u32::from(g) + u32::from(b))
            .sum()
    };
    assert!(brightness(120, 75) > 3 * brightness(170, 135));
}

/// The names between backquotes in the help of the problems of a scene that has a key called `zzzzzzzz` everywhere.
#[test]
fn every_key_is_described() {
    let unknown = "zzzzzzzz = 1";
    let kinds = [
        "texels = [[1]]",
        "generate = \"solid\"",
        "equirectangular = \"x\"",
        "irradiance = \"x\"",
    ];
    let textures: String = kinds
        .iter()
        .enumerate()
        .map(|(i, kind)| format!("[textures.t{i}]\n{kind}\n{unknown}\n"))
        .collect();
    let error = load(&format!(
        "{unknown}\n[camera]\n{unknown}\n[meshes.a]\npositions = []\n{unknown}\n[meshes.b]\nobj = \"x\"\n{unknown}\n{textures}\n\
         [targets.a]\n{unknown}\n[targets.a.camera]\n[targets.b]\nkind = \"cube\"\n{unknown}\n[[draw]]\n{unknown}\n\
         world = {{ {unknown} }}\n[draw.vs_constants]\nc0 = {{ {unknown} }}\n[draw.stages.0]\n{unknown}\n[draw.state]\n{unknown}\n\
         viewport = {{ {unknown} }}\nfog = {{ {unknown} }}\nstencil = {{ {unknown} }}\n"
    ))
    .unwrap_err();
    let helps = error
        .diagnostics
        .iter()
        .filter(|d| d.message.contains("zzzzzzzz"))
        .filter_map(|d| d.help.as_deref());
    let keys: std::collections::BTreeSet<&str> = helps
        .flat_map(|help| help.split('`').skip(1).step_by(2))
        .collect();
    assert!(keys.len() > 100, "{keys:?}");
    for key in keys {
        let inside_code = DOCUMENT.split('`').skip(1).step_by(2).any(|code| {
            code.split(|c: char| !c.is_alphanumeric() && c != '_')
                .any(|word| word == key)
        });
        assert!(inside_code, "`{key}` is not in docs/scene.md");
    }
}

#[test]
fn every_name_of_a_value_is_described() {
    use crate::raster::{BlendFactor, BlendOp, Compare, FogMode, Topology};
    let generators = crate::scene::generate::GENERATORS.iter().map(|g| g.name);
    let lists = [
        BlendFactor::NAMES,
        BlendOp::NAMES,
        Compare::NAMES,
        FogMode::NAMES,
        Topology::NAMES,
    ];
    for name in lists.into_iter().flatten().copied().chain(generators) {
        assert!(
            DOCUMENT.contains(&format!("`{name}`")),
            "`{name}` is not in docs/scene.md"
        );
    }
}

//! What an engine gets that draws the picture of a scene itself.

use texcrd::gpu::Renderer;
use texcrd::scene::{DirectoryResolver, LoadOptions, Scene};

/// The picture reads a texture of one texel and what `drawn` holds, and not what `unused` would hold.
const SCENE: &str = r#"
size = [4, 4]
draws = ["picture"]
[meshes.all]
positions = [[-2, -2, 0], [-2, 2, 0], [2, 2, 0], [-2, -2, 0], [2, 2, 0], [2, -2, 0]]
[textures.texel]
texels = [[1, 0, 0, 1]]
size = [1, 1]
[textures.target]
target = "drawn"
[textures.nothing]
target = "unused"
[targets.drawn]
size = 2
draws = ["green"]
[targets.unused]
size = 2
draws = ["green"]
[[draw]]
name = "green"
mesh = "all"
vs_text = "vs.1.1 mov oPos, v0"
ps_text = "ps.1.1 mov r0, c0"
ps_constants.c0 = [0, 1, 0, 1]
state = { cull = "none" }
[[draw]]
name = "picture"
mesh = "all"
vs_text = "vs.1.1 mov oPos, v0 mov oT0, v7 mov oT1, v7"
ps_text = "ps.1.1 tex t0 tex t1 add r0, t0, t1"
stages.0.texture = "texel"
stages.1.texture = "target"
"#;

#[test]
fn textures_of_a_scene_with_what_its_targets_hold() {
    let Some(device) = super::device() else {
        return;
    };
    let resolver = DirectoryResolver::new(".");
    let scene = Scene::load(
        "scene",
        SCENE.as_bytes(),
        &resolver,
        &LoadOptions::default(),
    );
    let scene = match scene {
        Ok(scene) => scene,
        Err(error) => panic!("{error}"),
    };
    let textures = Renderer::new(&device)
        .textures(&scene)
        .expect("they can be had");
    assert_eq!(textures.len(), scene.textures().len());
    for (entry, texture) in scene.textures().iter().zip(&textures) {
        let texel = |texture: &texcrd::texture::Texture| texture.texel(0, 0, 0, 0, 0);
        let expected = match entry.name.as_str() {
            "texel" => Some([1.0, 0.0, 0.0, 1.0]),
            "target" => Some([0.0, 1.0, 0.0, 1.0]),
            _ => None,
        };
        assert_eq!(texture.as_ref().and_then(texel), expected, "{}", entry.name);
    }
}

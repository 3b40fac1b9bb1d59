//! Pixels and vertices of scenes.

use super::*;
use crate::debug::pixel::{PixelSubject, Which};
use crate::debug::subject::Subject;
use crate::scene::{LoadOptions, RenderOptions, Scene};

/// Two triangles over the picture, half transparent over blue, and a third behind everything that fails the depth test.
const SCENE: &str = r#"
size = [4, 4]
clear = [0, 0, 1, 1]
[meshes.all]
positions = [[-1, 1, 0.5], [1, 1, 0.5], [1, -1, 0.5], [-1, 1, 0.5], [1, -1, 0.5], [-1, -1, 0.5]]
[meshes.far]
positions = [[-1, 1, 0.75], [1, 1, 0.75], [1, -1, 0.75]]
[textures.grey]
format = "rgba32f"
size = [1, 1]
texels = [[0.5, 0.5, 0.5, 1]]
[[draw]]
name = "front"
mesh = "all"
vs_text = "vs.1.1\nmov oPos, v0\nmov oD0, c0\nmov oT0, c1\n"
ps_text = "ps.1.1\ntex t0\nmul_x2 r0, v0, t0\n"
vs_constants.c0 = [1, 0.5, 0, 0.25]
vs_constants.c1 = [0.25, 0.75, 0, 1]
stages.0 = { texture = "grey" }
state = { alpha_blend = true, src_blend = "srcalpha", dest_blend = "invsrcalpha" }
[[draw]]
name = "behind"
mesh = "far"
vs_text = "vs.1.1\nmov oPos, v0\n"
ps_text = "ps.1.1\ndef c0, 1, 1, 1, 1\nmov r0, c0\n"
"#;

fn scene() -> Scene {
    let files = std::collections::BTreeMap::<String, Vec<u8>>::new();
    let options = LoadOptions::default();
    Scene::load("scene.toml", SCENE.as_bytes(), &files, &options)
        .unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn a_pixel_is_told_from_its_vertices_to_the_target() {
    let scene = scene();
    let rendering = scene.rendering(&RenderOptions::default(), &|_| {}).unwrap();
    let subject = PixelSubject::new(&rendering, [3, 1], &Which::default()).unwrap();
    let mut talk = Talk::new(Session::new(Subject::Pixel(subject)));
    let greeting = talk.console.greeting(&talk.session).to_string();
    let (title, rest) = greeting.split_once('\n').unwrap();
    assert!(title.starts_with("pixel 3,1: ps.1.1, "), "{greeting}");
    assert_eq!(
        rest,
        "   draw front, primitive 0, written   (2 primitives touch this pixel: `history`)\n\
         ->    2 tex t0\n"
    );
    let step = talk.say("step");
    assert!(
        step.contains("        stage 0: 2d 1×1 rgba32f at (0.25, 0.75), "),
        "{step}"
    );
    assert!(
        step.contains("          1 × texel 0,0: 0.5, 0.5, 0.5, 1\n"),
        "{step}"
    );
    talk.say("step");
    // 2·0.5·(1, 0.5, 0), 2·1·0.25; blended with a half over blue: (1 + 0)/2, (0.5 + 0)/2, (0 + 1)/2, (0.5 + 1)/2·… :
    // alpha 0.5·0.5 + 0.5·1 = 0.75. In bytes 127.5 to even 128, 63.75, 127.5, 191.25.
    talk.is(
        "finish",
        "   output merger: depth test\n        \
         0.5 lessequal 1: passed\n   \
            output merger: blend\n        \
         pixel  (1, 0.5, 0, 0.5) × srcalpha (0.5, 0.5, 0.5, 0.5)\n        \
         target (0, 0, 1, 1) × invsrcalpha (0.5, 0.5, 0.5, 0.5)\n        \
         add: 0.5, 0.25, 0.5, 0.75\n   \
            output merger: write\n        \
         now #804080 alpha 191 depth 0.5 stencil 0\n        \
         was #0000ff alpha 255 depth 1 stencil 0\n\
         -> end of pixel 3,1\n        \
         r0           = 1, 0.5, 0, 0.5\n",
    );
    let why = talk.say("why r0.r");
    assert!(
        why.contains("v0.r         = 1   the same at all vertices\n"),
        "{why}"
    );
    assert!(why.ends_with("   r0.r = 1\n"), "{why}");
    let quad = talk.say("quad v0.ra");
    assert!(quad.contains("   3,1 here             1, 0.25\n"), "{quad}");
    assert!(quad.contains("   2,0"), "{quad}");
    assert!(talk.say("quad").contains("r0\n"));
    let row = |head: &str, holds: &str| format!("{head:<40} {holds} stencil 0\n");
    let expected = [
        row("      clear", "#0000ff alpha 255 depth 1"),
        row(
            "->  1 front, primitive 0, written",
            "#804080 alpha 191 depth 0.5",
        ),
        row(
            "    2 behind, primitive 0, depth",
            "#804080 alpha 191 depth 0.5",
        ),
    ];
    talk.is("history", &expected.concat());
    // The runs of its vertices: there and back.
    assert!(talk.say("info runs").lines().count() == 4);
    assert!(talk.say("up 3").contains("(corner 1): vs.1.1, "));
    assert!(talk.say("down").contains("(corner 2): vs.1.1, "));
    talk.is("break ps:3", "breakpoint 1 at ps:3  mul_x2 r0, v0, t0\n");
    let arrived = talk.say("c");
    assert!(arrived.starts_with("pixel 3,1: ps.1.1, "), "{arrived}");
    assert!(arrived.contains("\nbreakpoint 1\n"), "{arrived}");
    let mut effect = |line: &str| talk.console.execute(&mut talk.session, line).effect;
    // t0 after the last instruction, r0 after the one that is named.
    let Some(Effect::Picture { draw, tiles, path }) = effect("show r0@3 t0 out.png") else {
        panic!("show is for the front");
    };
    let captions: Vec<&str> = tiles.iter().map(|tile| tile.caption.as_str()).collect();
    assert_eq!((draw.as_str(), path.as_str()), ("front", "out.png"));
    assert_eq!(captions, ["r0@3", "t0@2"]);
    let Some(Effect::Picture { path, .. }) = effect("show t0") else {
        panic!("show is for the front");
    };
    assert_eq!(path, "t0@2.png");
    talk.fails("show", "which register");
    talk.fails("show r9", "no r9");
}

#[test]
fn other_primitives_pixels_and_vertices() {
    let scene = scene();
    let rendering = scene.rendering(&RenderOptions::default(), &|_| {}).unwrap();
    let subject = PixelSubject::new(&rendering, [3, 1], &Which::default()).unwrap();
    let mut talk = Talk::new(Session::new(Subject::Pixel(subject)));
    assert!(
        talk.say("history 2")
            .contains("   draw behind, primitive 0, depth")
    );
    assert!(
        talk.say("finish")
            .contains("        0.75 lessequal 0.5: failed: nothing is written\n")
    );
    assert!(
        talk.say("pixel 0,3")
            .contains("   draw front, primitive 1, written\n")
    );
    talk.fails("history 9", "`9` is none of 1 to 1");
    talk.fails("pixel 4,0", "outside of the 4x4 picture");
    talk.fails("pixel 0,3 behind", "only front");
    talk.fails("pixel", "write it as");
    talk.fails("pixel 1", "write it as");
    let vertex = talk.say("vertex 1");
    assert!(vertex.starts_with("vertex 1: vs.1.1, "), "{vertex}");
    assert!(
        vertex.ends_with("   draw front\n->    2 mov oPos, v0\n"),
        "{vertex}"
    );
    talk.is("step", "      2 mov oPos, v0\n        oPos         = 1, 1, 0.5, 1   (first write)\n->    3 mov oD0, c0\n");
    assert!(talk.say("vertex 2 behind").contains("   draw behind\n"));
    talk.fails("vertex 3", "vertices 0 to 2");
    talk.fails("vertex x", "write it as");
    talk.fails("history", "a vertex has no history");
    talk.fails("quad", "only a pixel");
    assert!(
        talk.say("pixel 3,1 front")
            .contains("draw front, primitive 0")
    );
}

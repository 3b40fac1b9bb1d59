//! What is set around the shaders, and what of it reaches the passes.

use super::*;
use crate::raster::{ColorFormat, FogDistance, Surface, Viewport, ViewportState};

const DRAW: &str =
    "[[draw]]\nmesh = \"m\"\nvs = \"flat.vsh\"\nps = \"c0.psh\"\nps_constants.c0 = 1\n";

/// A scene of one draw over a mesh of three vertices.
fn scene(keys: &str, draw: &str) -> String {
    let positions = "[[-1, 1, 0], [1, 1, 0], [1, -1, 0]]";
    format!("{keys}\n[meshes.m]\npositions = {positions}\n{DRAW}{draw}\n")
}

#[track_caller]
fn refused(text: &str, said: &str) {
    let error = load(text).unwrap_err().to_string();
    assert!(error.contains(said), "{error}");
}

#[test]
fn what_a_target_holds_at_first() {
    let target = "[targets.t]\nsize = 4\ndraws = []\nformat = \"x8r8g8b8\"\nclear_stencil = 3\n\
                  [textures.t]\ntarget = \"t\"\n";
    let text = scene(
        &format!("clear_depth = 0.25\nclear_stencil = 0xff\n{target}"),
        "stages.0.texture = \"t\"",
    );
    let scene = loaded(&text);
    let passes = scene.passes([4, 4]);
    let [target, picture] = passes.as_slice() else {
        panic!("{}", passes.len());
    };
    let expected = Surface {
        format: ColorFormat::X8R8G8B8,
        color: [0.0; 4],
        depth: 1.0,
        stencil: 3,
    };
    assert_eq!(target.surface, expected);
    // Without alpha it reads 1.
    assert_eq!(target.surface.stored().color, [0, 0, 0, 255]);
    let expected = Surface {
        format: ColorFormat::A8R8G8B8,
        color: [0.0, 0.0, 0.0, 1.0],
        depth: 0.25,
        stencil: 255,
    };
    assert_eq!(picture.surface, expected);
    let other = |keys: &str| self::scene(keys, "");
    refused(
        &other("clear_depth = 1.5"),
        "`clear_depth` is 1.5; it must be 0 to 1",
    );
    refused(
        &other("clear_stencil = 256"),
        "`clear_stencil` is 256; it must be 0 to 255",
    );
    refused(
        &other("format = \"r5g6b5\""),
        "is one of a8r8g8b8, x8r8g8b8",
    );
}

#[test]
fn viewports_of_draws() {
    let of = |viewport: &str| {
        let scene = loaded(&scene("", &format!("state.viewport = {{ {viewport} }}")));
        scene.passes([4, 4])[0].draws[0].state.viewport
    };
    assert_eq!(of(""), ViewportState::default());
    let part = of("x = 1, y = 2, width = 3, height = 4, min_z = 0.5, max_z = 0.25");
    let on_target = Viewport {
        x: 1,
        y: 2,
        width: 3,
        height: 4,
        min_z: 0.5,
        max_z: 0.25,
    };
    assert_eq!(part.on([9, 9]), on_target);
    // Up to the end of the target; beyond it there is nothing.
    assert_eq!(of("x = 3").on([5, 7]).rectangle(), [3, 0, 2, 7]);
    assert_eq!(of("x = 6, height = 2").on([5, 7]).rectangle(), [6, 0, 0, 2]);
    for (viewport, said) in [
        ("min_z = -0.5", "`min_z` is -0.5; it must be 0 to 1"),
        ("max_z = nan", "`max_z` is NaN; it must be 0 to 1"),
        ("x = -1", "`x` is -1; it must be 0 to 16384"),
        ("width = 16385", "`width` is 16385; it must be 0 to 16384"),
        ("depth = 1", "has no key `depth`"),
    ] {
        refused(
            &scene("", &format!("state.viewport = {{ {viewport} }}")),
            said,
        );
    }
}

#[test]
fn states_by_hand() {
    let state = |keys: &str| {
        let scene = loaded(&scene("[camera]", &format!("[draw.state]\n{keys}")));
        scene.passes([4, 4])[0].draws[0].state.clone()
    };
    // A camera has a perspective projection, which asks for w.
    assert_eq!(state("fog = {}").fog.distance, FogDistance::W);
    let by_hand = state("fog = { distance = \"z\" }");
    assert_eq!(by_hand.fog.distance, FogDistance::Z);
    let stencil =
        state("stencil = { ref = 0x102, mask = 0xffffffff, write_mask = 0xff00 }").stencil;
    assert_eq!(
        (stencil.reference, stencil.mask, stencil.write_mask),
        (2, 255, 0)
    );
    let draw = |keys: &str| scene("", &format!("[draw.state]\n{keys}"));
    refused(
        &draw("stencil = { mask = -1 }"),
        "`mask` is -1; it must be 0 to 4294967295",
    );
    refused(&draw("clip_planes = [[nan, 0, 0, 0]]"), "`clip_planes`");
    refused(&draw("fog = { distance = \"y\" }"), "is one of z, w");
}

#[test]
fn further_coordinate_sets() {
    let mesh = "[meshes.m]\npositions = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\n\
                texcoords = [[1, 2, 3, 4], [1, 2], [5]]\n\
                texcoords3 = [[0.5], [0.5, 0.25, 0.125], [1, 2, 3, 4]]\n\
                speculars = [[1, 2, 3, 4], [0, 0, 0, 0], [0, 0, 0, 0]]\n";
    let fed = |declaration: &str, vs: &str, vertex: usize| {
        let draw = format!(
            "[[draw]]\nmesh = \"m\"\nvs_text = \"vs.1.1\\n{vs}mov oPos, v0\\n\"\nps = \"c0.psh\"\n{declaration}\n"
        );
        let scene = loaded(&format!("{mesh}{draw}"));
        let passes = scene.passes([4, 4]);
        passes[0].draws[0].inputs(vertex)
    };
    let by_name = "declaration = { v0 = \"position\", v1 = \"texcoord\", v2 = \"texcoord3\", v3 = \"specular\", v4 = \"texcoord7\" }";
    let [first, second, third] = [0, 1, 2].map(|vertex| fed(by_name, "", vertex));
    // What is missing comes from (0, 0, 0, 1); a set that the mesh does not have is the first one.
    assert_eq!(
        first[1..5],
        [
            [1.0, 2.0, 3.0, 4.0],
            [0.5, 0.0, 0.0, 1.0],
            [1.0, 2.0, 3.0, 4.0],
            [1.0, 2.0, 3.0, 4.0]
        ]
    );
    assert_eq!(
        second[1..4],
        [[1.0, 2.0, 0.0, 1.0], [0.5, 0.25, 0.125, 1.0], [0.0; 4]]
    );
    assert_eq!(third[1..3], [[5.0, 0.0, 0.0, 1.0], [1.0, 2.0, 3.0, 4.0]]);
    let declared = fed(
        "",
        "dcl_position v0\\ndcl_texcoord3 v5\\ndcl_color1 v6\\n",
        0,
    );
    assert_eq!(declared[5..7], [[0.5, 0.0, 0.0, 1.0], [1.0, 2.0, 3.0, 4.0]]);
    let broken = mesh.replace("[0.5], ", "[0, 0, 0, 0, 0], ");
    refused(
        &format!("{broken}{DRAW}"),
        "`texcoords3`: there are 5 entries",
    );
    let broken = mesh.replace("[0.5], ", "");
    refused(
        &format!("{broken}{DRAW}"),
        "3 positions but 2 values of `texcoord3`",
    );
}

#[test]
fn indices_of_a_draw() {
    // The corners of the picture, and a strip that names them in its own order.
    let corners =
        "[meshes.m]\npositions = [[-2, 2, 0], [2, 2, 0], [2, -2, 0], [-2, -2, 0]]\nindices = []\n";
    let drawn = |keys: &str| {
        let picture = rendered(&format!("size = [1, 1]\n{corners}{DRAW}{keys}\n"));
        pixels(&picture)[0] != [0, 0, 0, 255]
    };
    assert!(drawn(
        "topology = \"trianglestrip\"\nindices = [0, 1, 3, 2]"
    ));
    assert!(drawn("indices = [0, 1, 2, 0, 2, 3]"));
    // The other way round, and none.
    assert!(!drawn(
        "topology = \"trianglestrip\"\nindices = [1, 0, 2, 3]"
    ));
    assert!(!drawn("indices = []"));
    assert!(!drawn(""));
    let draw = |keys: &str| format!("{corners}{DRAW}{keys}\n");
    refused(
        &draw("indices = [0, 1, 4]"),
        "names vertex 4; the mesh has 4, from 0",
    );
    refused(
        &draw("topology = \"pointlist\"\nindices = [0]"),
        "points are drawn without `indices`",
    );
}

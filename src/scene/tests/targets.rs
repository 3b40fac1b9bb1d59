//! Render targets that later draws read.

use super::*;

const SAMPLE_2D: &str =
    "vs_text = \"vs.1.1\\nmov oPos, v0\\nmov oT0, v7\\n\"\nps = \"stage0.psh\"\n";

#[test]
fn a_target_is_drawn_before_it_is_read() {
    let left = quad([-1.0, -1.0, 0.0, 1.0]);
    let whole = quad([-1.0, -1.0, 1.0, 1.0]);
    // The outer target shows the inner one, whose left half is green; `unused` is not drawn, and the file's order is
    // not the order of drawing.
    let scene = loaded(&format!(
        r#"
size = [2, 1]
draws = ["show"]
[meshes.left]
{left}
[meshes.all]
{whole}
[textures.a]
target = "outer"
[textures.b]
target = "inner"
[targets.outer]
size = [4, 4]
draws = ["copy"]
[targets.inner]
size = 4
clear = [0, 0, 1, 1]
draws = ["green"]
[targets.unused]
size = 4
draws = ["green"]
[[draw]]
name = "show"
mesh = "all"
stages.0.texture = "a"
{SAMPLE_2D}
[[draw]]
name = "copy"
mesh = "all"
stages.0.texture = "b"
{SAMPLE_2D}
[[draw]]
name = "green"
mesh = "left"
vs = "flat.vsh"
ps = "c0.psh"
ps_constants.c0 = [0, 1, 0, 1]
"#
    ));
    let passes = scene.passes(scene.size());
    let outputs: Vec<_> = passes
        .iter()
        .map(|pass| match pass.output {
            crate::scene::Output::Picture => "picture",
            crate::scene::Output::Target { target, .. } => scene.target(target).unwrap().name,
        })
        .collect();
    assert_eq!(outputs, ["inner", "outer", "picture"]);
    let picture = scene.render(&RenderOptions::default(), &|_| {}).unwrap();
    assert_eq!(pixels(&picture), [[0, 255, 0, 255], [0, 0, 255, 255]]);
}

/// The direction through sc, tc of a face, from the table of the specification (for ma = ±1) turned round.
fn direction(face: usize, sc: f32, tc: f32) -> [f32; 3] {
    match face {
        0 => [1.0, -tc, -sc],
        1 => [-1.0, -tc, sc],
        2 => [sc, 1.0, tc],
        3 => [sc, -1.0, -tc],
        4 => [sc, -tc, 1.0],
        _ => [-sc, -tc, -1.0],
    }
}

#[test]
fn each_texel_of_a_cube_shows_its_own_direction() {
    // A marker stands in the direction of the texel (6, 2) of each 8×8 face, smaller than the texel: no turning or
    // mirroring of the face leaves it there. The picture unrolls the six faces side by side, texel by texel.
    let from = [10.0, 20.0, 30.0_f32];
    let middle = |texel: f32| (texel + 0.5) / 8.0 * 2.0 - 1.0;
    let (mut positions, mut colors, mut indices) = (Vec::new(), Vec::new(), Vec::new());
    for face in 0..6 {
        for (x, y) in [(-0.1, -0.1), (0.1, -0.1), (0.1, 0.1), (-0.1, 0.1)] {
            let at = direction(face, middle(6.0) + x, middle(2.0) + y);
            positions.push([0, 1, 2].map(|i| from[i] + 3.0 * at[i]));
            colors.push([0.2 * face as f32, 0.4, 0.6, 1.0]);
        }
        indices.extend([0, 1, 2, 0, 2, 3].map(|i| i + 4 * face));
    }
    let mut faces = String::new();
    for face in 0..6 {
        // Half a pixel to the left and up, so that pixel centres lie where texel centres are.
        let x = |pixel: f32| (pixel - 0.5) / 48.0 * 2.0 - 1.0;
        let y = |pixel: f32| 1.0 - (pixel - 0.5) / 8.0 * 2.0;
        let (left, right) = (x(8.0 * face as f32), x(8.0 * face as f32 + 8.0));
        let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        let directions = corners.map(|[sc, tc]| direction(face, sc, tc));
        let colors = directions.map(|[x, y, z]| [x, y, z, 1.0]);
        let (top, bottom) = (y(0.0), y(8.0));
        faces += &format!(
            "[meshes.face{face}]\npositions = [[{left:?}, {top:?}, 0], [{right:?}, {top:?}, 0], \
             [{right:?}, {bottom:?}, 0], [{left:?}, {bottom:?}, 0]]\ncolors = {colors:?}\nindices = [0, 1, 2, 0, 2, 3]\n\
             [[draw]]\nname = \"face{face}\"\nmesh = \"face{face}\"\nstages.0.texture = \"cube\"\n\
             vs_text = \"vs.1.1\\nmov oPos, v0\\nmov oT0, v5\\n\"\nps_text = \"ps.1.4\\ntexld r0, t0\\n\"\n"
        );
    }
    let target = rendered(&format!(
        r#"
size = [48, 8]
draws = ["face0", "face1", "face2", "face3", "face4", "face5"]
[textures.cube]
target = "around"
[targets.around]
kind = "cube"
size = 8
from = {from:?}
draws = ["markers"]
[meshes.markers]
positions = {positions:?}
colors = {colors:?}
indices = {indices:?}
{faces}
[[draw]]
name = "markers"
mesh = "markers"
vs_text = "vs.1.1\nm4x4 oPos, v0, c0\nmov oD0, v5\n"
ps_text = "ps.1.1\nmov r0, v0\n"
vs_constants.c0 = "world_view_projection"
"#
    ));
    for (number, pixel) in pixels(&target).into_iter().enumerate() {
        let (x, y) = (number % 48, number / 48);
        let expected = if (x % 8, y) == (6, 2) {
            [51 * (x / 8) as u8, 102, 153, 255]
        } else {
            [0; 4]
        };
        assert_eq!(pixel, expected, "face {}, texel {}, {y}", x / 8, x % 8);
    }
}

#[test]
fn fronts_face_the_point_from_which_a_cube_is_rendered() {
    // A box seen from inside, drawn with the default culling, fills every texel.
    let whole = quad([-1.0, -1.0, 1.0, 1.0]);
    let scene = |inside: bool, direction: &str| {
        format!(
            r#"
size = [1, 1]
draws = ["show"]
[textures.cube]
target = "around"
[targets.around]
kind = "cube"
size = 4
draws = ["box"]
[meshes.box]
shape = "box"
inside = {inside}
[meshes.all]
{whole}
[[draw]]
name = "box"
mesh = "box"
vs_text = "vs.1.1\nm4x4 oPos, v0, c0\n"
ps = "c0.psh"
ps_constants.c0 = 1
vs_constants.c0 = "world_view_projection"
[[draw]]
name = "show"
mesh = "all"
vs_text = "vs.1.1\nmov oPos, v0\nmov oT0, c0\n"
vs_constants.c0 = {direction}
ps_text = "ps.1.4\ntexld r0, t0\n"
stages.0.texture = "cube"
"#
        )
    };
    for direction in [
        "[1, 0, 0]",
        "[-1, 0, 0]",
        "[0, 1, 0]",
        "[0, -1, 0]",
        "[0, 0, 1]",
        "[0, 0, -1]",
    ] {
        assert_eq!(
            pixels(&rendered(&scene(true, direction))),
            [[255; 4]],
            "{direction}"
        );
        assert_eq!(
            pixels(&rendered(&scene(false, direction))),
            [[0; 4]],
            "{direction}"
        );
    }
}

#[test]
fn a_diffuse_cube_map_of_a_target() {
    // Surroundings of one colour light every surface in that colour.
    let whole = quad([-1.0, -1.0, 1.0, 1.0]);
    let target = rendered(&format!(
        r#"
size = [1, 1]
[textures.room]
target = "around"
[textures.diffuse]
irradiance = "room"
edge = 2
[targets.around]
kind = "cube"
size = 4
clear = [0.2, 0.4, 0.6, 1]
draws = []
[meshes.all]
{whole}
[[draw]]
mesh = "all"
vs_text = "vs.1.1\nmov oPos, v0\nmov oT0, v3\n"
ps_text = "ps.1.4\ntexld r0, t0\n"
stages.0.texture = "diffuse"
"#
    ));
    assert_eq!(pixels(&target), [[51, 102, 153, 255]]);
}

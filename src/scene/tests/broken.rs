//! Scenes that are refused: where, and with which words.

use super::*;

/// A draw that is in order, for scenes whose fault lies elsewhere.
pub(super) const DRAW: &str = "[[draw]]\nmesh = \"m\"\nvs = \"flat.vsh\"\nps = \"c0.psh\"\n";
pub(super) const MESH: &str = "[meshes.m]\nshape = \"plane\"\n";

/// Each line of the text of an error that begins with a place.
pub(super) fn lines(text: &str) -> Vec<String> {
    let error = load(text).err();
    let error = error.unwrap_or_else(|| panic!("this was accepted:\n{text}"));
    error.to_string().lines().map(str::to_owned).collect()
}

/// Checks that the only problem starts with the first text and that its help, or else its message, holds the second.
fn only(text: &str, start: &str, part: &str) {
    let lines = lines(text);
    let problems: Vec<_> = lines
        .iter()
        .filter(|line| line.contains(": error["))
        .collect();
    assert_eq!(problems.len(), 1, "{lines:#?}");
    assert!(
        problems[0].starts_with(start),
        "{:?} instead of {start:?}",
        problems[0]
    );
    assert!(lines.concat().contains(part), "{lines:#?} without {part:?}");
}

#[test]
fn the_scene_itself() {
    let all = format!("{MESH}{DRAW}");
    for (head, start, part) in [
        (
            "siz = [1, 1]\n",
            "1:1: error[F2]: the scene file has no key `siz`",
            "did you mean `size`?",
        ),
        (
            "size = [0, 5]\n",
            "1:8: error[F3]: a picture of 0 by 5",
            "1 to 16384",
        ),
        ("size = [99999, 5]\n", "1:8: error[F3]", "16384"),
        (
            "size = 5\n",
            "1:8: error[F3]: `size`:",
            "invalid type: integer `5`",
        ),
        (
            "size = [1, 2, 3]\n",
            "1:8: error[F3]: `size`:",
            "there are 3 entries where 2 must be",
        ),
        (
            "time = \"now\"\n",
            "1:8: error[F3]: `time`:",
            "invalid type: string \"now\"",
        ),
        (
            "draws = [\"1\", \"2\"]\n",
            "1:15: error[F5]: there is no draw `2`",
            "`1`",
        ),
        ("x = \"\n", "1:6: error[F1]", ""),
        (
            "clear = [1, 0, 0, 1]\nclear = [1, 0, 0, 1]\n",
            "2:1: error[F1]: duplicate key",
            "",
        ),
        (
            "camera = 3\n",
            "1:10: error[F3]: `camera` must be a table, not a number",
            "",
        ),
    ] {
        only(
            &format!("{head}{all}"),
            &format!("scene.toml:{start}"),
            part,
        );
    }
    only(
        "",
        "scene.toml:1:1: error[F4]: the scene file needs at least one `[[draw]]`",
        "",
    );
    only(
        "draw = 1",
        "scene.toml:1:8: error[F3]: `draw` must be a list of tables",
        "",
    );
}

#[test]
fn cameras_and_transforms() {
    let all = format!("{MESH}{DRAW}");
    for (camera, start, part) in [
        (
            "positon = [1, 2, 3]",
            "2:1: error[F2]: [camera] has no key `positon`",
            "did you mean `position`?",
        ),
        (
            "fov = 180",
            "2:7: error[F3]: `fov` is 180; it must be 1 to 179",
            "",
        ),
        (
            "look_at = [0, 0, 0]",
            "2:11: error[F3]: the camera must look at another point",
            "",
        ),
        ("up = [0, 0, 2]", "2:6: error[F3]: the camera must look", ""),
        (
            "near = 5\nfar = 5",
            "3:7: error[F3]: `near` is 5 and `far` is 5",
            "",
        ),
        (
            "view = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1]]",
            "2:37: error[F3]: row 3 of `view` has 3 numbers",
            "four rows of four",
        ),
        (
            "view = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]",
            "2:8: error[F3]: `view` has 3 rows",
            "",
        ),
        (
            "view = [1, 2, 3, 4]",
            "2:9: error[F3]: row 1 of `view` is not a list",
            "",
        ),
        (
            "projection = \"wide\"",
            "2:14: error[F3]: `projection` must be a matrix",
            "not a text",
        ),
        (
            "fov = 30\nprojection = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, nan]]",
            "3:1: error[F6]: `projection` already says what `fov` would",
            "",
        ),
    ] {
        let text = format!("[camera]\n{camera}\n{all}");
        let lines = lines(&text);
        assert!(
            lines[0].starts_with(&format!("scene.toml:{start}")),
            "{lines:#?}"
        );
        assert!(lines.concat().contains(part), "{lines:#?}");
    }
    only(
        &format!("{MESH}{DRAW}world = {{ scale = 1, rotation = [0, 0, 0] }}"),
        "scene.toml:7:22: error[F2]: `world` has no key `rotation`",
        "there are `scale`, `rotate`, `translate`",
    );
    only(
        &format!("{MESH}{DRAW}world = 3"),
        "scene.toml:7:9: error[F3]: `world` must be four rows",
        "not a number",
    );
    only(
        &format!("{MESH}{DRAW}world = {{ scale = 0 }}\nvs_constants.c1 = \"inverse_world\""),
        "scene.toml:8:19: error[F3]: this needs the inverse of a matrix that has none",
        "",
    );
}

#[test]
fn meshes() {
    for (mesh, start, part) in [
        (
            "shape = \"spere\"",
            "2:9: error[F3]: unknown variant `spere`",
            "did you mean `sphere`?",
        ),
        (
            "shape = \"sphere\"\nradus = 2",
            "3:1: error[F3]: unknown field `radus`",
            "did you mean `radius`?",
        ),
        (
            "shape = \"sphere\"\nradius = \"big\"",
            "3:10: error[F3]: `radius`: invalid type",
            "",
        ),
        (
            "shape = \"sphere\"\nradius = -2",
            "1:9: error[F8]: mesh `sphere`: `radius` is -2",
            "",
        ),
        (
            "obj = \"missing.obj\"",
            "2:7: error[F7]: `missing.obj` cannot be read",
            "no such file",
        ),
        (
            "obj = \"c0.psh\"",
            "1:9: error[F8]: `c0.psh`: OBJ file",
            "no face",
        ),
        (
            "",
            "1:9: error[F4]: [meshes.m] needs one of `shape`, `obj`, `positions`",
            "",
        ),
        (
            "shape = \"box\"\nobj = \"a\"",
            "1:9: error[F6]: a mesh is made from `shape` or from `obj`",
            "",
        ),
        (
            "positions = [[0, 0, 0]]\nindices = [0, 0, 1]",
            "1:9: error[F8]: index 2 names vertex 1",
            "",
        ),
        ("positions = [[0, 0]]", "2:14: error[F3]: `positions`:", ""),
    ] {
        only(
            &format!("[meshes.m]\n{mesh}\n{DRAW}"),
            &format!("scene.toml:{start}"),
            part,
        );
    }
}

#[test]
fn textures() {
    for (texture, start, part) in [
        (
            "file = \"wood.png\"",
            "2:8: error[F7]: `wood.png` cannot be read: there is no such file",
            "",
        ),
        (
            "file = \"c0.psh\"",
            "2:8: error[F8]: `c0.psh`: not a usable picture",
            "",
        ),
        (
            "generate = \"brick\"",
            "2:12: error[F8]: there is no texture generator `brick`",
            "bricks",
        ),
        (
            "generate = \"solid\"\nsize = [0, 1]",
            "2:12: error[F8]: generator `solid`: `size` is 0 by 1",
            "",
        ),
        ("faces = [\"a\", \"b\"]", "2:9: error[F3]: `faces`", ""),
        (
            "target = \"nowhere\"",
            "2:10: error[F5]: there is no render target `nowhere`",
            "",
        ),
        (
            "irradiance = \"t\"",
            "2:14: error[F8]: `t` is a diffuse cube map already",
            "",
        ),
        (
            "texels = [[1]]",
            "1:11: error[F4]: [textures.t] needs a `size`",
            "",
        ),
        (
            "texels = [[1]]\nsize = [2, 1]",
            "1:11: error[F8]: level 0 needs 2 texels, 1 given",
            "",
        ),
        (
            "texels = [[1]]\nsize = [1]",
            "3:8: error[F3]: `size` has 1 numbers",
            "",
        ),
        (
            "texels = [[1]]\nsize = [1, 1]\nformat = \"rgba9\"",
            "4:10: error[F3]: `format`",
            "rgba8",
        ),
        (
            "raw = [1]\ntexels = [[1]]",
            "1:11: error[F6]",
            "`texels` or from `raw`",
        ),
        (
            "mipmaps = true",
            "1:11: error[F4]: [textures.t] needs one of `file`",
            "",
        ),
    ] {
        let text = format!("[textures.t]\n{texture}\n{MESH}{DRAW}");
        let lines = lines(&text);
        assert!(
            lines[0].starts_with(&format!("scene.toml:{start}")),
            "{lines:#?}"
        );
        assert!(lines.concat().contains(part), "{lines:#?}");
    }
}

#[test]
fn draws() {
    for (draw, start, part) in [
        (
            "vs = \"flat.vsh\"\nps = \"c0.psh\"",
            "3:1: error[F4]: draw `1` needs a `mesh`",
            "",
        ),
        (
            "mesh = \"n\"\nvs = \"flat.vsh\"\nps = \"c0.psh\"",
            "4:8: error[F5]: there is no mesh `n`",
            "`m`",
        ),
        (
            "mesh = \"m\"\nvs = \"flat.vsh\"",
            "3:1: error[F4]: draw `1` needs a pixel shader, `ps` or `ps_text`",
            "",
        ),
        (
            "mesh = \"m\"\nps = \"c0.psh\"",
            "3:1: error[F4]: draw `1` needs a vertex shader",
            "",
        ),
        (
            "mesh = \"m\"\nvs = \"c0.psh\"\nps = \"c0.psh\"",
            "5:6: error[F10]: this is a ps.1.1 listing",
            "vertex shader",
        ),
        (
            "mesh = \"m\"\nvs = \"flat.vsh\"\nps = \"c0.psh\"\nps_text = \"\"",
            "7:11: error[F6]: `ps` already gives",
            "",
        ),
        (
            "mesh = \"m\"\nvs = \"flat.vsh\"\nps = \"c1.psh\"",
            "6:6: error[F7]: `c1.psh` cannot be read",
            "",
        ),
    ] {
        only(
            &format!("{MESH}[[draw]]\n{draw}\n"),
            &format!("scene.toml:{start}"),
            part,
        );
    }
    for (key, start, part) in [
        (
            "topology = \"triangles\"",
            "7:12: error[F3]: `topology`: `triangles` is no topology",
            "trianglelist",
        ),
        (
            "declaration = { v16 = \"normal\" }",
            "7:17: error[F2]: ",
            "`v0` to `v15`",
        ),
        (
            "declaration = { v0 = \"positoin\" }",
            "7:22: error[F5]: `positoin` is no mesh attribute",
            "did you mean `position`?",
        ),
        (
            "vs_constants = { c96 = 1 }",
            "7:18: error[F2]: ",
            "`c0` to `c95`",
        ),
        (
            "ps_constants = { c8 = 1 }",
            "7:18: error[F2]: ",
            "`c0` to `c7`",
        ),
        (
            "vs_constants = { c94 = \"world\" }",
            "7:24: error[F3]: `c94` fills c94 to c97",
            "c95",
        ),
        (
            "vs_constants = { c0 = \"world\", c3 = 1 }",
            "7:32: error[F6]: `c3` and `c0` both set c3",
            "registers = 3",
        ),
        (
            "vs_constants = { c0 = \"wrold_view\" }",
            "7:23: error[F5]: nothing is called `wrold_view`",
            "did you mean `world_view`?",
        ),
        (
            "vs_constants = { c0 = [1, 2, 3, 4, 5] }",
            "7:23: error[F3]: `c0` has 5 numbers",
            "four",
        ),
        (
            "vs_constants = { c0 = true }",
            "7:23: error[F3]: `c0` must be a number",
            "",
        ),
        (
            "vs_constants = { c0 = { meaning = \"time\", registers = 2 } }",
            "7:55: error[F3]: `registers` is 2",
            "1 to 1",
        ),
        ("stages.8.texture = \"t\"", "7:8: error[F2]: ", "`0` to `7`"),
        (
            "stages.0.texture = \"t\"",
            "7:20: error[F5]: there is no texture `t`",
            "",
        ),
        (
            "stages.0.addres = \"wrap\"",
            "7:10: error[F2]: ",
            "did you mean `address`?",
        ),
        (
            "stages.0.address = \"wrapped\"",
            "7:20: error[F3]: `address`",
            "mirror_once",
        ),
        ("stages.0.mip = 3", "7:16: error[F3]: `mip`", ""),
        (
            "state.z_bias = 17",
            "7:16: error[F3]: `z_bias` is 17; it must be 0 to 16",
            "",
        ),
        (
            "state.src_blend = \"source_alpha\"",
            "7:19: error[F3]: `src_blend`",
            "srcalpha",
        ),
        (
            "state.color_write = \"rgx\"",
            "7:21: error[F3]: `color_write`: `x`",
            "",
        ),
        (
            "state.fog.dencity = 1",
            "7:11: error[F2]: ",
            "did you mean `density`?",
        ),
    ] {
        only(
            &format!("{MESH}{DRAW}{key}\n"),
            &format!("scene.toml:{start}"),
            part,
        );
    }
    only(
        &format!("{MESH}{DRAW}name = \"a\"\n{DRAW}name = \"a\"\n"),
        "scene.toml:12:8: error[F6]: there are two draws called `a`",
        "",
    );
}

#[test]
fn targets() {
    let scene = |targets: &str| {
        format!(
            "{targets}\n[textures.a]\ntarget = \"a\"\n[textures.b]\ntarget = \"b\"\n{MESH}\
             [[draw]]\nname = \"reads_a\"\nmesh = \"m\"\nvs = \"flat.vsh\"\nps = \"stage0.psh\"\nstages.0.texture = \"a\"\n\
             [[draw]]\nname = \"reads_b\"\nmesh = \"m\"\nvs = \"flat.vsh\"\nps = \"stage0.psh\"\nstages.0.texture = \"b\"\n"
        )
    };
    let a = "[targets.a]\nsize = 4\ndraws = []\n";
    for (targets, start, part) in [
        (
            "[targets.a]\nsize = 4\ndraws = [\"reads_b\"]\n[targets.b]\nsize = 4\ndraws = [\"reads_a\"]\n",
            "1:10: error[F9]: these targets read each other: `a` reads `b` reads `a`",
            "",
        ),
        (
            &format!("{a}[targets.b]\nsize = 4\ndraws = [\"reads_b\"]"),
            "4:10: error[F9]: the target `b` is read by one of its own draws",
            "",
        ),
        (
            &format!("{a}[targets.b]\nsize = 4"),
            "4:10: error[F4]: [targets.b] needs `draws`",
            "",
        ),
        (
            &format!("{a}[targets.b]\ndraws = []"),
            "4:10: error[F4]: [targets.b] needs a `size`",
            "",
        ),
        (
            &format!("{a}[targets.b]\nsize = 5000\ndraws = []"),
            "5:8: error[F3]: a target of 5000 by 5000",
            "4096",
        ),
        (
            &format!("{a}[targets.b]\nkind = \"cube\"\nsize = [4, 5]\ndraws = []"),
            "6:8: error[F3]",
            "square",
        ),
        (
            &format!("{a}[targets.b]\nkind = \"3d\"\nsize = 4\ndraws = []"),
            "5:8: error[F3]: `kind`: a render target is",
            "",
        ),
        (
            &format!("{a}[targets.b]\nkind = \"cube\"\nsize = 4\ndraws = []\ncamera = {{}}"),
            "8:1: error[F2]: [targets.b] has no key `camera`",
            "",
        ),
        (
            &format!("{a}[targets.b]\nsize = 4\ndraws = []\nfrom = [0, 0, 0]"),
            "7:1: error[F2]: [targets.b] has no key `from`",
            "",
        ),
        (
            &format!("{a}[targets.b]\nsize = 4\ndraws = [\"reads\"]"),
            "6:10: error[F5]: there is no draw `reads`",
            "`reads_a`",
        ),
    ] {
        only(&scene(targets), &format!("scene.toml:{start}"), part);
    }
    let text = format!("[targets.t]\nsize = 4\ndraws = []\n{MESH}{DRAW}stages.0.texture = \"t\"\n");
    only(
        &text,
        "scene.toml:10:20: error[F5]: `t` is a render target",
        "[textures.t] with target = \"t\"",
    );
}

#[test]
fn all_problems_are_reported_at_once() {
    let lines = lines(
        "sise = [1, 1]\n[camera]\nfov = 500\nup = 3\n[meshes.m]\nshape = \"ball\"\n[[draw]]\nmesh = \"m\"\nps = \"missing.psh\"\n\
         state = { cull = \"both\", z_bais = 1 }\n",
    );
    let places: Vec<_> = lines
        .iter()
        .filter_map(|line| line.strip_prefix("scene.toml:"))
        .map(|line| line.split(' ').next().unwrap())
        .collect();
    // The draw's own line is where its vertex shader is missing.
    assert_eq!(
        places,
        [
            "1:1:", "3:7:", "4:6:", "6:9:", "7:1:", "9:6:", "10:18:", "10:26:"
        ]
    );
}

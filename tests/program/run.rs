//! `run`: scenes to pictures.

use super::{folder, texcrd};
use std::fs;
use std::path::Path;

/// Writes the files of a scene into a folder of its own and returns the scene's path and that of a picture.
pub(super) fn scene(test: &str, files: &[(&str, &str)]) -> (String, String) {
    let folder = folder(test);
    for (name, text) in files {
        fs::write(folder.join(name), text).expect("the file can be written");
    }
    let path = |name: &str| {
        folder
            .join(name)
            .to_str()
            .expect("a readable path")
            .to_string()
    };
    (path("scene.toml"), path("out.png"))
}

pub(super) fn pixel(path: &str, x: u32, y: u32) -> [u8; 4] {
    image::open(path)
        .expect("a picture")
        .to_rgba8()
        .get_pixel(x, y)
        .0
}

/// A rectangle over the left half of clip space in the colour of c0.
pub(super) const HALF: &str = r#"
size = [8, 4]
clear = [0, 0, 1, 1]
[meshes.half]
positions = [[-1, 1, 0.5], [0, 1, 0.5], [0, -1, 0.5], [-1, 1, 0.5], [0, -1, 0.5], [-1, -1, 0.5]]
[[draw]]
name = "half"
mesh = "half"
vs = "half.vsh"
ps_text = "ps.1.1\nmov r0, c0\n"
ps_constants = { c0 = [1, 0.5, 0, 1] }
"#;
pub(super) const HALF_VS: &str = "vs.1.1\nmov oPos, v0\nmov oT0, v0\n";

/// Pixel centres are whole numbers: x = (X + 1)·4, so that clip space −1…0 is pixels 0 to 3 and its right edge, exactly
/// on pixel 4, belongs to what would come next to it.
#[test]
fn a_rectangle() {
    let (scene, out) = scene(
        "run_rectangle",
        &[("scene.toml", HALF), ("half.vsh", HALF_VS)],
    );
    let ran = texcrd(&["run", &scene, "-o", &out]);
    assert_eq!(
        (ran.status, ran.err.as_str(), ran.out.as_str()),
        (0, "", "")
    );
    for y in 0..4 {
        // 0.5·255 = 127.5, to the nearest even.
        assert_eq!(pixel(&out, 3, y), [255, 128, 0, 255]);
        assert_eq!(pixel(&out, 4, y), [0, 0, 255, 255]);
    }
}

#[test]
fn another_size() {
    let (scene, out) = scene("run_size", &[("scene.toml", HALF), ("half.vsh", HALF_VS)]);
    assert_eq!(
        texcrd(&["run", &scene, "-o", &out, "--size", "20x2"]).status,
        0
    );
    assert_eq!(image::image_dimensions(&out).expect("a picture"), (20, 2));
    assert_eq!(pixel(&out, 9, 0), [255, 128, 0, 255]);
    assert_eq!(
        texcrd(&["run", &scene, "-o", &out, "--size", "20"]).status,
        2
    );
    // Sizes that no target can have.
    assert_eq!(
        texcrd(&["run", &scene, "-o", &out, "--size", "0x10"]).status,
        2
    );
    let ran = texcrd(&["run", &scene, "-o", &out, "--size", "100000x100000"]);
    assert_eq!(ran.status, 2);
    assert_eq!(
        image::image_dimensions(&out).expect("the old picture stands"),
        (20, 2)
    );
}

/// oT0 is the position: x from −1 to 0 over pixels 0 to 4, so −0.5 at pixel 2. Its absolute value is 128/255, twice
/// itself 255/255.
#[test]
fn a_register_instead_of_the_colour() {
    let (scene, out) = scene("run_show", &[("scene.toml", HALF), ("half.vsh", HALF_VS)]);
    let show = |more: &[&str]| {
        let mut arguments = vec!["run", &scene, "-o", &out, "--show"];
        arguments.extend(more);
        let ran = texcrd(&arguments);
        assert_eq!(ran.status, 0, "{}", ran.err);
        pixel(&out, 2, 2)
    };
    assert_eq!(show(&["oT0.x"]), [0, 0, 0, 255]);
    assert_eq!(show(&["oT0.x", "--abs"]), [128, 128, 128, 255]);
    assert_eq!(show(&["oT0.x", "--scale", "-2"]), [255, 255, 255, 255]);
    // y is 1 − 2·2/4 = 0, z is 0.5: the length of (−0.5, 0, 0.5) is 0.7071, 180/255.
    assert_eq!(show(&["oT0", "--mag"]), [180, 180, 180, 255]);
    assert_eq!(show(&["r0"]), [255, 128, 0, 255]);
    assert_eq!(show(&["r0@2"]), [255, 128, 0, 255]);
    for (wrong, status) in [
        ("r7", 2),
        ("x", 2),
        ("oPos", 2),
        ("oT9", 2),
        ("r0@0", 2),
        ("r0@99", 2),
    ] {
        let ran = texcrd(&["run", &scene, "-o", &out, "--show", wrong]);
        assert_eq!(ran.status, status, "{wrong}");
        assert!(ran.err.contains("--show"), "{}", ran.err);
    }
}

#[test]
fn shared_parts_are_included() {
    let files = [
        ("scene.toml", "include = [\"half.toml\"]\nsize = [8, 4]\n"),
        (
            "half.toml",
            &HALF.replace("size = [8, 4]\nclear = [0, 0, 1, 1]\n", ""),
        ),
        ("half.vsh", HALF_VS),
    ];
    let (scene_path, out) = scene("run_include", &files);
    let ran = texcrd(&["run", &scene_path, "-o", &out]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    assert_eq!(pixel(&out, 3, 0), [255, 128, 0, 255]);
    // What is wrong in an included file is told at its place in that file.
    let files = [
        (
            "scene.toml",
            "include = [\"half.toml\"]\n[meshes.half]\nshape = \"box\"\n",
        ),
        ("half.toml", &HALF.replace("c0 = [1", "c99 = [1")),
        ("half.vsh", HALF_VS),
    ];
    let (scene_path, out) = scene("run_include_wrong", &files);
    let ran = texcrd(&["run", &scene_path, "-o", &out]);
    assert_eq!(ran.status, 1);
    for part in [
        "half.toml:2:1",
        "half.toml:3:1",
        "half.toml:11",
        "c99",
        "scene.toml:2",
        "already",
    ] {
        assert!(ran.err.contains(part), "{part} in\n{}", ran.err);
    }
    assert!(!Path::new(&out).exists(), "no picture is written");
}

#[test]
fn what_is_wrong_has_a_place() {
    let files = [
        ("scene.toml", &*HALF.replace("mesh = ", "mash = ")),
        ("half.vsh", "vs.1.1\nmov oPos, r0\n"),
    ];
    let (scene, out) = scene("run_wrong", &files);
    let ran = texcrd(&["run", &scene, "-o", &out]);
    assert_eq!(ran.status, 1);
    for part in ["scene.toml:8:1", "mash", "mesh", "half.vsh:2:11", "I1"] {
        assert!(ran.err.contains(part), "{part} in\n{}", ran.err);
    }
    assert!(!Path::new(&out).exists(), "no picture is written");
}

#[test]
fn files_that_are_not_there() {
    let (scene, out) = scene("run_missing", &[("scene.toml", HALF)]);
    let ran = texcrd(&["run", &scene, "-o", &out]);
    assert_eq!(ran.status, 1);
    assert!(
        ran.err.contains("half.vsh") && ran.err.contains("scene.toml:9"),
        "{}",
        ran.err
    );
    assert_eq!(texcrd(&["run", "no/such.toml", "-o", &out]).status, 2);
    let (scene, _) = self::scene(
        "run_nowhere",
        &[("scene.toml", HALF), ("half.vsh", HALF_VS)],
    );
    assert_eq!(
        texcrd(&["run", &scene, "-o", "no/such/folder/out.png"]).status,
        2
    );
}

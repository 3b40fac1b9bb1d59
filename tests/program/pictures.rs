//! `run --show`: pictures of registers and contact sheets.

use super::run::{HALF, HALF_VS, pixel, scene};
use super::{gpu_is_off, texcrd};

fn half(test: &str) -> (String, String) {
    scene(test, &[("scene.toml", HALF), ("half.vsh", HALF_VS)])
}

/// oT0 is the position: x is −0.5 at pixel (2, 2), y is 0, z is 0.5.
#[test]
fn views() {
    let (scene, out) = half("pictures_views");
    let show = |more: &[&str]| {
        let mut arguments = vec!["run", &scene, "-o", &out, "--show"];
        arguments.extend(more);
        let ran = texcrd(&arguments);
        assert_eq!(ran.status, 0, "{}", ran.err);
        assert_eq!(image::image_dimensions(&out).expect("a picture"), (8, 4));
        pixel(&out, 2, 2)
    };
    // −0.5·0.5 + 0.5 = 0.25 is 63.75 steps of 1/255, 0 is 127.5 (to the even one), 0.5 is 191.25.
    assert_eq!(show(&["oT0", "--signed"]), [64, 128, 191, 255]);
    assert_eq!(show(&["oT0.xz"]), [0, 0, 128, 255]);
    // Channels: negative 0, zero half, positive full. One component in colours of its own.
    assert_eq!(show(&["oT0", "--sign"]), [0, 128, 255, 255]);
    assert_eq!(show(&["oT0.x", "--sign"]), [40, 110, 255, 255]);
    assert_eq!(
        show(&["oT0.x", "--sign", "--scale", "-1"]),
        [255, 150, 30, 255]
    );
    assert_eq!(show(&["oT0.y", "--sign"]), [96, 96, 96, 255]);
    // Below 0, and −0.5 · −4 = 2 above 1.
    assert_eq!(show(&["oT0.x", "--mark"]), [60, 60, 255, 255]);
    assert_eq!(
        show(&["oT0.x", "--mark", "--scale", "-4"]),
        [255, 60, 30, 255]
    );
    assert_eq!(show(&["oT0.x", "--mark", "--signed"]), [64, 64, 64, 255]);
    assert_eq!(show(&["r1"]), [120, 90, 0, 255]);
}

/// A gap of 8 around a tile, 16 for a row of the caption, 4 + 12 + 16 for the bar; a tile is at least 168 wide.
#[test]
fn a_sheet_of_one_instruction() {
    let (scene, out) = half("pictures_sheet");
    let size = |more: &[&str]| {
        let mut arguments = vec!["run", &scene, "-o", &out, "--show", "all"];
        arguments.extend(more);
        let ran = texcrd(&arguments);
        assert_eq!(ran.status, 0, "{}", ran.err);
        image::image_dimensions(&out).expect("a picture")
    };
    assert_eq!(size(&["--no-bar"]), (184, 8 + 16 + 4 + 8));
    assert_eq!(size(&["--size", "400x10"]), (416, 8 + 16 + 10 + 32 + 8));
    assert_eq!(size(&[]), (184, 8 + 16 + 4 + 32 + 8));
    // The picture is that of the register alone: the rectangle on the left, the clear colour on the right of it.
    assert_eq!(pixel(&out, 8 + 3, 24), [255, 128, 0, 255]);
    assert_eq!(pixel(&out, 8 + 4, 24), [0, 0, 255, 255]);
    // Stripes of red, green and blue from black on the left.
    let stripe = |y| [pixel(&out, 8, y), pixel(&out, 8 + 167, y)];
    let black = [0, 0, 0, 255];
    assert_eq!(stripe(32), [black, [255, 0, 0, 255]]);
    assert_eq!(stripe(36), [black, [0, 255, 0, 255]]);
    assert_eq!(stripe(43), [black, [0, 0, 255, 255]]);
}

/// A tile of a sheet is to the bit what `--show` gives for it alone.
#[test]
fn tiles_are_single_pictures() {
    let listing = "ps.1.4\ntexcrd r0.rgb, t0\n\n; nothing\nmul r1.rg, r0, c0\n+mov r1.a, c0.a\nadd r0.rg, r1, r0\n";
    let text = HALF.replace("ps.1.1\\nmov r0, c0\\n", &listing.replace('\n', "\\n"));
    let (scene, out) = scene(
        "pictures_tiles",
        &[("scene.toml", &text), ("half.vsh", HALF_VS)],
    );
    let draw = |more: &[&str]| {
        let mut arguments = vec!["run", &scene, "-o", &out];
        arguments.extend(more);
        let ran = texcrd(&arguments);
        assert_eq!(ran.status, 0, "{}", ran.err);
        image::open(&out).expect("a picture").to_rgba8()
    };
    for more in [
        &["--size", "170x60"][..],
        &["--size", "170x60", "--signed", "--mark"],
    ] {
        let with = |show: &str| draw(&[&["--show", show], more].concat());
        let sheet = draw(&[&["--show", "all", "--no-bar"], more].concat());
        // Tiles are 170 × (16 + 60). Two columns make 364×176, nearest to 1.6.
        assert_eq!(sheet.dimensions(), (8 + 2 * 178, 8 + 2 * 84));
        for (number, show) in ["r0@2", "r1.rg@5", "r1.a@6", "r0.rg@7"]
            .into_iter()
            .enumerate()
        {
            let alone = with(show);
            let (x, y) = (8 + number as u32 % 2 * 178, 24 + number as u32 / 2 * 84);
            let tile = image::imageops::crop_imm(&sheet, x, y, 170, 60).to_image();
            assert_eq!(tile, alone, "{show}");
        }
    }
    // Several make a sheet, too; one with a bar keeps the picture in the corner.
    let two = draw(&["--show", "r0@2", "--show", "r1.rg@5", "--size", "170x60"]);
    assert_eq!(two.dimensions(), (8 + 2 * 178, 8 + 16 + 60 + 32 + 8));
    let one = draw(&["--show", "r0@2", "--bar", "--size", "170x60"]);
    assert_eq!(one.dimensions(), (170, 60 + 32));
    let tile = image::imageops::crop_imm(&one, 0, 0, 170, 60).to_image();
    assert_eq!(tile, draw(&["--show", "r0@2", "--size", "170x60"]));
}

/// Pictures on a sheet are 320 wide unless a size is given: 640×480 becomes 320×240.
#[test]
fn sheets_are_made_of_small_pictures() {
    let text = HALF.replace("size = [8, 4]", "size = [640, 480]");
    let (scene, out) = scene(
        "pictures_small",
        &[("scene.toml", &text), ("half.vsh", HALF_VS)],
    );
    let ran = texcrd(&["run", &scene, "-o", &out, "--show", "all", "--no-bar"]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let size = image::image_dimensions(&out).expect("a picture");
    assert_eq!(size, (336, 16 + 16 + 240));
    assert_eq!(
        texcrd(&["run", &scene, "-o", &out, "--show", "r0"]).status,
        0
    );
    assert_eq!(
        image::image_dimensions(&out).expect("a picture"),
        (640, 480)
    );
}

#[test]
fn what_cannot_be_shown_is_said() {
    let (scene, out) = half("pictures_wrong");
    let wrong = |more: &[&str], part: &str| {
        let mut arguments = vec!["run", &scene, "-o", &out];
        arguments.extend(more);
        let ran = texcrd(&arguments);
        assert_eq!(ran.status, 2, "{more:?}: {}", ran.err);
        assert!(ran.err.contains(part), "{part} in {}", ran.err);
    };
    wrong(
        &["--show", "r0@1"],
        "line 1 is no instruction; the first one is on line 2",
    );
    wrong(&["--show", "r0", "--show", "r7"], "ps.1.1 has no r7");
    wrong(&["--show", "everything"], "or all for one");
    wrong(&["--show", "r0", "--abs", "--sign"], "--sign");
    wrong(
        &["--show", "r0", "--draw", "other"],
        "the picture has no draw `other`; it has half",
    );
    wrong(&["--signed"], "--show");
    let large = ["--show", "r0", "--show", "r1", "--size", "8192x8192"];
    wrong(&large, "2 pictures of 8192×8192 pixels are too many");
    let many = ["--show", "r0"].repeat(513);
    wrong(&many, "at most 512 pictures");
    assert!(
        !std::path::Path::new(&out).exists(),
        "no picture is written"
    );
}

#[test]
fn a_gpu_makes_the_same_sheet() {
    if gpu_is_off() {
        return;
    }
    let (scene, out) = half("pictures_gpu");
    let sheet = |on: &str| {
        let show = ["--show", "all", "--show", "r1", "--show", "oT0.x"];
        let ran = texcrd(&[&["run", &scene, "-o", &out, "--on", on], &show[..]].concat());
        assert_eq!(ran.status, 0, "{}", ran.err);
        image::open(&out).expect("a picture").to_rgba8()
    };
    // Constants, and a ramp in which no value is near to the middle between two steps of 1/255: -1, -0.75, -0.5, -0.25.
    assert_eq!(sheet("cpu"), sheet("gpu"));
}

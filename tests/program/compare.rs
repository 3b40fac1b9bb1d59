//! `compare`, `adapters`, `run --on gpu`: what needs a GPU, or a software adapter.

use super::{Ran, folder, gpu_is_off, texcrd};
use serde_json::Value;
use std::fs;

/// Two rectangles of one size, red at depth 0.75 and blue behind it, both with w = 4. If they are to part, the red one has a
/// user clip plane whose numbers are beyond those that translations take for granted: 3.4e38·z and -3.4e38·w are infinities in
/// 32-bit floats, whose sum is no number and not below 0, so that a GPU draws it. On the CPU their sum is negative, and blue
/// is seen.
fn parted(test: &str, part: bool) -> String {
    let draw = |color: &str, z: &str, more: &str| {
        format!(
            "[[draw]]\nname = \"{color}\"\nmesh = \"all\"\n\
             vs_text = \"vs.1.1\\nadd r0, v0, c0\\nmul oPos, r0, c1\\nmov oT0, v7\\n\"\n\
             ps_text = \"ps.1.1\\ntexcoord t0\\nmov r0, {color}\\n\"\n\
             vs_constants = {{ c0 = [0, 0, {z}, 0], c1 = 4 }}\n\
             ps_constants = {{ c0 = [1, 0, 0, 1], c1 = [0, 0, 1, 1] }}\n{more}\n"
        )
    };
    let plane = match part {
        true => "state = { clip_planes = [[0, 0, 3.4e38, -3.4e38]] }",
        false => "",
    };
    let text = format!(
        "size = [8, 8]\n[meshes.all]\n\
         positions = [[-1, 1, 0], [1, 1, 0], [1, -1, 0], [-1, -1, 0]]\nindices = [0, 1, 2, 0, 2, 3]\n{}{}",
        draw("c0", "0.75", plane),
        draw("c1", "0.8", ""),
    );
    let path = folder(test).join("scene.toml");
    fs::write(&path, text).expect("the file can be written");
    path.to_str().expect("a readable path").to_string()
}

/// Runs and reads what it prints.
fn json(arguments: &[&str]) -> (i32, Value) {
    let Ran { status, out, err } = texcrd(arguments);
    match serde_json::from_str(&out) {
        Ok(value) => (status, value),
        Err(error) => panic!("{error}\n{out}\n{err}"),
    }
}

#[test]
fn equal_pictures() {
    if gpu_is_off() {
        return;
    }
    let scene = parted("compare_equal", false);
    let ran = texcrd(&["compare", &scene, "--tolerance", "0"]);
    assert_eq!(ran.status, 0, "{}{}", ran.out, ran.err);
    for part in [
        "8x8",
        "inside    on edges",
        "no pixel inside triangles differs by more than 0",
    ] {
        assert!(ran.out.contains(part), "{part} in\n{}", ran.out);
    }
    assert!(!ran.out.contains("worst inside"), "{}", ran.out);
    let (status, report) = json(&["compare", &scene, "--format", "json"]);
    assert_eq!(
        (status, &report["passed"], &report["max"]),
        (0, &true.into(), &0.into())
    );
    assert_eq!(report["size"], serde_json::json!([8, 8]));
    assert_eq!(report["pixel"], Value::Null);
    assert_eq!(report["inside"]["pixels"], 64);
    // A pixel that is asked for is shown all the same: below the diagonal both draws lie with their second triangle.
    let ran = texcrd(&["compare", &scene, "--pixel", "2,5", "--all-lines"]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    for part in [
        "pixel 2,5, inside: CPU 255 0 0 255, GPU 255 0 0 255",
        "`c0`, primitive 1: 255 0 0 255",
        "`c1`, primitive 1: fails the depth test",
        "No instruction's registers part",
        "2     texcoord t0",
        "3     mov r0, c0",
    ] {
        assert!(ran.out.contains(part), "{part} in\n{}", ran.out);
    }
}

/// What differs is said to come after the shader.
#[test]
fn different_pictures() {
    if gpu_is_off() {
        return;
    }
    let scene = parted("compare_different", true);
    let picture = scene.replace("scene.toml", "differences.png");
    let (status, report) = json(&[
        "compare", &scene, "--pixel", "2,5", "-o", &picture, "--format", "json",
    ]);
    assert_eq!(status, 1, "{report}");
    let expected = [
        ("/passed", Value::from(false)),
        ("/max", 255.into()),
        ("/above_tolerance", 64.into()),
        ("/inside/above_tolerance", 64.into()),
        ("/on_edges/pixels", 0.into()),
        ("/channels/red/max", 255.into()),
        ("/channels/green/max", 0.into()),
        ("/histogram/0/difference", 255.into()),
        ("/histogram/0/pixels", 64.into()),
        ("/worst/cpu/2", 255.into()),
        ("/worst/gpu/0", 255.into()),
        ("/pixel/inside", true.into()),
        ("/pixel/covered_by/0/draw", "c1".into()),
        ("/pixel/covered_by/0/fate", "written".into()),
        ("/pixel/compared/0/draw", "c1".into()),
        ("/pixel/compared/0/covered_on_gpu", true.into()),
        ("/pixel/compared/0/parting", Value::Null),
        ("/pixel/compared/0/explanation", Value::Null),
        ("/pixel/compared/0/lines/1/text", "mov r0, c1".into()),
        ("/pixel/compared/0/lines/1/line", 3.into()),
        ("/pixel/compared/0/lines/1/writes/0/register", "r0".into()),
        (
            "/pixel/compared/0/lines/1/writes/0/gpu",
            serde_json::json!([0.0, 0.0, 1.0, 1.0]),
        ),
    ];
    for (place, value) in expected {
        assert_eq!(report.pointer(place), Some(&value), "{place} in {report}");
    }
    // The picture is there, whole, and nothing else: red, as all differences are great ones.
    let image = image::open(&picture).expect("a picture").to_rgba8();
    assert_eq!(
        (image.dimensions(), image.get_pixel(4, 4).0),
        ((8, 8), [255, 0, 0, 255])
    );
    let folder = std::path::Path::new(&scene).parent().expect("a folder");
    let files = fs::read_dir(folder).expect("it can be read").count();
    assert_eq!(files, 2, "a part is left in {folder:?}");
    let ran = texcrd(&["compare", &scene]);
    assert_eq!(ran.status, 1);
    for part in [
        "64 pixels inside triangles differ by more than 1",
        "after the shader",
        "worst inside at 0,0",
    ] {
        assert!(ran.out.contains(part), "{part} in\n{}", ran.out);
    }
    assert_eq!(texcrd(&["compare", &scene, "--tolerance", "255"]).status, 0);
}

/// The target holds what [`parted`] draws and differs everywhere; the picture shows the target and does not, because both
/// paths see that of the CPU. It is a difference all the same.
#[test]
fn render_targets_are_compared_by_themselves() {
    if gpu_is_off() {
        return;
    }
    let scene = parted("compare_target", true);
    let text = fs::read_to_string(&scene).expect("it was written");
    let draws = "draws = [\"mirror\"]\n[meshes.all]";
    let mirror = "\
        [targets.room]\nsize = [8, 8]\ndraws = [\"c0\", \"c1\"]\n\
        [textures.room]\ntarget = \"room\"\n\
        [[draw]]\nname = \"mirror\"\nmesh = \"all\"\nstages.0.texture = \"room\"\n\
        vs_text = \"vs.1.1\\nmov oPos, v0\\nmov oT0, v0\\n\"\n\
        ps_text = \"ps.1.1\\ntex t0\\nmov r0, t0\\n\"\n";
    fs::write(&scene, text.replace("[meshes.all]", draws) + mirror).expect("it can be written");
    let (status, report) = json(&["compare", &scene, "--format", "json"]);
    assert_eq!(status, 1, "{report}");
    for (place, value) in [
        ("/passed", Value::from(false)),
        ("/max", 0.into()),
        ("/targets/0/target", "room".into()),
        ("/targets/0/face", 0.into()),
        ("/targets/0/inside/above_tolerance", 64.into()),
        ("/pixel", Value::Null),
    ] {
        assert_eq!(report.pointer(place), Some(&value), "{place} in {report}");
    }
    let ran = texcrd(&["compare", &scene]);
    for part in [
        "render target `room`",
        "inside at most 255 (64 above 1)",
        "\nno pixel inside triangles differs by more than 1\nin render targets: 64 pixels",
    ] {
        assert!(ran.out.contains(part), "{part} in\n{}", ran.out);
    }
}

/// 11 texels on 8 pixels: ρ² is 1.891, whose logarithm is 0.919, and 0.891 with the linear mantissa of Mesa's software adapter.
/// Half of the difference, 0.014 of a level, is 3.6 steps of 1/255 from black to white.
#[test]
fn levels_of_detail_may_be_off() {
    if gpu_is_off() {
        return;
    }
    let folder = folder("compare_levels");
    let path = folder.join("scene.toml");
    let texels =
        |count: usize, value: u8| vec![format!("[{value}, {value}, {value}, 1]"); count].join(", ");
    let text = format!(
        "size = [8, 8]\n[meshes.all]\n\
         positions = [[-1, 1, 0], [1, 1, 0], [1, -1, 0], [-1, -1, 0]]\n\
         texcoords = [[0, 0], [1, 0], [1, 1], [0, 1]]\nindices = [0, 1, 2, 0, 2, 3]\n\
         [textures.steep]\nkind = \"2d\"\nsize = [11, 11]\ntexels = [{}]\nmips = [[{}], [{}], [{}]]\n\
         [[draw]]\nname = \"all\"\nmesh = \"all\"\n\
         vs_text = \"vs.1.1\\nmov oPos, v0\\nmov oT0.xy, v7\\n\"\n\
         ps_text = \"ps.1.1\\ntex t0\\nmov r0, t0\\n\"\n\
         [draw.stages]\n0 = {{ texture = \"steep\", filter = \"linear\", mip = \"linear\" }}\n",
        texels(121, 0),
        texels(25, 1),
        texels(4, 1),
        texels(1, 1),
    );
    fs::write(&path, text).expect("the file can be written");
    let scene = path.to_str().expect("a readable path");
    let (status, report) = json(&["compare", scene, "--format", "json"]);
    assert_eq!(status, 0, "{report}");
    assert_eq!(report["level_error"], 0.0625);
    let of = |report: &Value, key: &str| report["inside"][key].as_u64();
    assert_eq!(of(&report, "beyond_levels"), Some(0), "{report}");
    if of(&report, "above_tolerance") == Some(0) {
        eprintln!("the adapter has exact levels of detail: nothing to explain");
        return;
    }
    let ran = texcrd(&["compare", scene]);
    assert!(
        ran.out
            .contains(", levels of detail that are off by up to 0.0625 left out"),
        "{}",
        ran.out
    );
    let (status, report) = json(&["compare", scene, "--level-error", "0", "--format", "json"]);
    assert_eq!(status, 1, "{report}");
    assert_eq!(of(&report, "beyond_levels"), of(&report, "above_tolerance"));
}

#[test]
fn what_compare_refuses() {
    let scene = parted("compare_refused", false);
    let picture = scene.replace("scene.toml", "differences.png");
    // Before any drawing, and so without an adapter too.
    for (arguments, status, message) in [
        (vec!["no/such.toml"], 2, "no/such.toml"),
        (vec![&scene, "--tolerance", "256"], 2, "--tolerance"),
        (vec![&scene, "--pixel", "8,0"], 2, "outside"),
        (vec![&scene, "--pixel", "8"], 2, "--pixel"),
        (vec![&scene, "--level-error", "1.5"], 2, "--level-error"),
        (vec![&scene, "--level-error", "NaN"], 2, "--level-error"),
        (vec![&scene, "--part-tolerance=-1"], 2, "--part-tolerance"),
        (vec![&scene, "-o", "no/such/folder/d.png"], 2, "no folder"),
        (vec![&scene, "-o", "differences.jpg"], 2, "PNG"),
        (vec![&scene, "--adapter", "no such adapter"], 2, ""),
    ] {
        let mut all = vec!["compare"];
        all.extend(arguments);
        let ran = texcrd(&all);
        assert_eq!(
            (ran.status, ran.out.as_str()),
            (status, ""),
            "{all:?}: {}",
            ran.err
        );
        assert!(ran.err.contains(message), "{all:?}: {}", ran.err);
    }
    fs::write(&scene, "size = [8, 8]\n[[draw]]\nmesh = \"none\"\n")
        .expect("the file can be written");
    let ran = texcrd(&["compare", &scene, "-o", &picture]);
    assert_eq!((ran.status, ran.out.as_str()), (1, ""));
    assert!(ran.err.contains("scene.toml:3"), "{}", ran.err);
    assert!(!std::path::Path::new(&picture).exists());
}

#[test]
fn the_adapters() {
    if gpu_is_off() {
        return;
    }
    let (status, list) = json(&["adapters", "--format", "json"]);
    assert_eq!(status, 0);
    let list = list.as_array().expect("a list").clone();
    let ran = texcrd(&["adapters"]);
    assert_eq!(
        (ran.status, ran.out.lines().count()),
        (0, list.len()),
        "{}",
        ran.err
    );
    assert!(!list.is_empty());
    for (number, (line, adapter)) in ran.out.lines().zip(&list).enumerate() {
        let name = adapter["name"].as_str().expect("a name");
        assert!(line.starts_with(&format!("{number}  {name} (")), "{line}");
        for key in ["backend", "kind", "driver"] {
            assert!(adapter[key].is_string(), "{adapter}");
        }
        assert!(adapter["float_targets"].is_boolean() && adapter["float_filtering"].is_boolean());
    }
    let scene = parted("adapters_number", false);
    // One beyond the last; the message lists those that there are.
    let number = list.len().to_string();
    let ran = texcrd(&["compare", &scene, "--adapter", &number]);
    assert_eq!(ran.status, 2);
    let name = list[0]["name"].as_str().expect("a name");
    assert!(
        ran.err.contains("--adapter") && ran.err.contains(name),
        "{}",
        ran.err
    );
}

/// c1 is blue, and the picture of c0's draw after its first line shows nothing yet.
#[test]
fn registers_on_the_gpu() {
    if gpu_is_off() {
        return;
    }
    let scene = parted("run_gpu_show", false);
    let out = scene.replace("scene.toml", "out.png");
    let show = |more: &[&str]| {
        let mut arguments = vec!["run", &scene, "-o", &out, "--on", "gpu"];
        arguments.extend(more);
        let ran = texcrd(&arguments);
        assert_eq!(ran.status, 0, "{}", ran.err);
        image::open(&out)
            .expect("a picture")
            .to_rgba8()
            .get_pixel(2, 5)
            .0
    };
    assert_eq!(show(&[]), [255, 0, 0, 255]);
    assert_eq!(show(&["--show", "r0", "--draw", "c0"]), [255, 0, 0, 255]);
    // Nothing has written it by then.
    assert_eq!(show(&["--show", "r0@2", "--draw", "c0"]), [120, 90, 0, 255]);
    // What is negative after the factor is black.
    let [red, rest @ ..] = show(&[
        "--show", "r0", "--draw", "c0", "--mag", "--scale", "-0.4", "--abs",
    ]);
    assert_eq!((red, rest), (0, [0, 0, 255]));
}

//! Pictures of registers: those of the CPU, marks included.

use std::collections::BTreeMap;

use texcrd::gpu::Renderer;
use texcrd::raster::{Look, Tone, View};
use texcrd::scene::{LoadOptions, RenderOptions, Scene, Show, ShowExpression};
use texcrd::sheet::{Dressing, Tile};

/// t0 is (x/8, y/8) at pixel (x, y), t1.x is negative to the left of column 4, t2 is so large that twice of it is infinite.
const LISTING: &str = "\
ps.1.4
texcrd r0.rgb, t0
texcrd r2.rgb, t2
texkill t1
add r3.rgb, r2, r2
add r4.rgb, -r2, -r2
add r5.rgb, r3, r4
mul r1.r, r0, c0.r
+mov r1.a, c0.a
mov r0.a, c0
";

/// The depth of the pixel is 0.9·x/8 over 1: in front of what is drawn at 0.75 up to column 6, at 0.5 up to column 4.
const DEPTH: &str = "\
ps.1.4
texcrd r5.rgb, t0
mul r5.r, r5.r, c1.r
mov r5.g, c1.a
mov r1.rgb, r5
phase
texdepth r5
mov r0.rgb, r1
+mov r0.a, c0.a
";

/// A draw in front of the upper two rows, the one that is shown, one that is blended on the right half, one behind.
fn scene(listing: &str) -> Scene {
    let quad = |[left, low, right, high]: [f32; 4], z: f32| {
        format!(
            "{{ positions = [[{left:?}, {high:?}, {z:?}], [{right:?}, {high:?}, {z:?}], [{right:?}, {low:?}, {z:?}], \
             [{left:?}, {low:?}, {z:?}]], texcoords = [[0, 0], [1, 0], [1, 1], [0, 1]], indices = [0, 1, 2, 0, 2, 3] }}"
        )
    };
    let all = [-1.0, -1.0, 1.0, 1.0];
    let flat = |mesh: &str, color: &str, state: &str| {
        format!(
            "[[draw]]\nmesh = \"{mesh}\"\nvs_text = \"vs.1.1\\nmov oPos, v0\\n\"\nps_text = \"ps.1.1\\nmov r0, c0\\n\"\n\
             ps_constants.c0 = {color}\nstate = {{ {state} }}\n"
        )
    };
    let text = format!(
        r#"
size = [8, 8]
clear = [0, 0, 1, 1]
[meshes]
front = {}
whole = {}
right = {}
behind = {}
{}
[[draw]]
name = "shown"
mesh = "whole"
vs_text = "vs.1.1\nmov oPos, v0\nmov oT0, v7\nadd oT1, v7, c0\nmov oT2, c1\n"
ps_text = """{listing}"""
vs_constants = {{ c0 = [-0.5, 0, 0, 0], c1 = [3e38, 3e38, 3e38, 3e38] }}
ps_constants = {{ c0 = [0.5, 0.5, 0.5, 1], c1 = [0.9, 0.9, 0.9, 1] }}
state = {{ alpha_blend = true, src_blend = "zero", dest_blend = "zero", color_write = "g" }}
{}
{}
"#,
        quad([-1.0, 0.5, 1.0, 1.0], 0.25),
        quad(all, 0.5),
        quad([0.0, -1.0, 1.0, 1.0], 0.5),
        quad(all, 0.75),
        flat("front", "[0, 1, 0, 1]", ""),
        flat(
            "right",
            "[0, 0, 0.2, 0]",
            "alpha_blend = true, src_blend = \"one\", dest_blend = \"one\""
        ),
        flat("behind", "[1, 1, 1, 1]", ""),
    );
    let files: BTreeMap<String, Vec<u8>> = BTreeMap::new();
    match Scene::load(
        "scene.toml",
        text.as_bytes(),
        &files,
        &LoadOptions::default(),
    ) {
        Ok(scene) => scene,
        Err(error) => panic!("{error}"),
    }
}

fn tiles(scene: &Scene, look: Look, killed: bool) -> Vec<Tile> {
    let pass = scene.passes(scene.size()).pop().expect("the picture");
    let place = scene.shown_draw(Some("shown")).expect("it is there");
    let all = ["all", "oT1", "r1", "v0"].map(|text| {
        let expression: ShowExpression = text.parse().expect("a register");
        (expression.tiles(scene, &pass.draws[place], look, killed)).expect("it can be shown")
    });
    all.concat()
}

/// The registers are the same within rounding, so pictures may be a step apart; marks are the same.
#[test]
fn registers_as_pictures() {
    let Some(device) = crate::device() else {
        return;
    };
    let mut renderer = Renderer::new(&device);
    let dressing = Dressing {
        captions: false,
        bars: false,
        columns: None,
    };
    let looks = [
        (Look::default(), false),
        (
            Look {
                tone: Tone::Signed,
                marks_range: true,
                scale: 1.7,
                ..Look::default()
            },
            true,
        ),
        (
            Look {
                view: View::Magnitude,
                ..Look::default()
            },
            false,
        ),
    ];
    for listing in [LISTING, DEPTH] {
        let scene = scene(listing);
        for (look, killed) in looks {
            let tiles = tiles(&scene, look, killed);
            let options = RenderOptions {
                size: None,
                show: Some(Show {
                    draw: Some("shown".into()),
                    pictures: tiles.iter().map(|tile| tile.picture).collect(),
                }),
            };
            let cpu = scene.rendering(&options, &|_| ()).expect("the CPU renders");
            let gpu = renderer.frame(&scene, &options, &[], &|_| ());
            let gpu = gpu.expect("the GPU renders");
            let ours = cpu.sheet(&tiles, dressing).expect("it is small");
            let theirs = gpu.sheet(&tiles, dressing).expect("it is small");
            assert_eq!(gpu.marks(), cpu.marks());
            for (x, y, pixel) in theirs.enumerate_pixels() {
                let other = ours.get_pixel(x, y);
                let near = (pixel.0.iter().zip(other.0)).all(|(a, b)| a.abs_diff(b) <= 1);
                assert!(near, "{x}, {y} of {look:?}: {pixel:?} {other:?}\n{listing}");
            }
        }
    }
}

/// By hand: 6/8 and 2/8 in steps of 1/255 are 191 and 64, and a later draw adds 51 to blue; NaN is magenta, infinity cyan, and
/// of what is discarded white is seen behind, unless it is marked and nothing is drawn over the mark.
#[test]
fn colours_and_marks() {
    let Some(device) = crate::device() else {
        return;
    };
    let mut renderer = Renderer::new(&device);
    let scene = scene(LISTING);
    let tiles = tiles(&scene, Look::default(), true);
    let at = |renderer: &mut Renderer<'_>, caption: &str, x, y| {
        let tile = tiles.iter().find(|tile| tile.caption == caption);
        let options = RenderOptions {
            size: None,
            show: Some(Show {
                draw: Some("shown".into()),
                pictures: vec![tile.expect("there is such a tile").picture],
            }),
        };
        let picture = renderer.render(&scene, &options, &|_| ());
        picture.expect("the GPU renders").get_pixel(x, y).0
    };
    let r0 = "2 texcrd r0.rgb, t0";
    assert_eq!(at(&mut renderer, r0, 6, 2), [191, 64, 51, 255]);
    assert_eq!(at(&mut renderer, r0, 6, 1), [0, 255, 0, 255]);
    assert_eq!(at(&mut renderer, r0, 3, 2), [255; 4]);
    assert_eq!(
        at(&mut renderer, "5 add r3.rgb, r2, r2", 6, 2),
        [0, 255, 255, 255]
    );
    assert_eq!(
        at(&mut renderer, "7 add r5.rgb, r3, r4", 6, 2),
        [255, 0, 255, 255]
    );
    assert_eq!(at(&mut renderer, "r1", 6, 2), [120, 90, 51, 255]);
    // A draw that there is not.
    let options = RenderOptions {
        size: None,
        show: Some(Show {
            draw: Some("none".into()),
            pictures: vec![tiles[0].picture],
        }),
    };
    let refused = renderer.render(&scene, &options, &|_| ());
    let refused = refused.expect_err("there is no such draw").to_string();
    assert!(refused.contains("no draw `none`"), "{refused}");
}

//! Whole scenes, pixel by pixel by hand.

use std::cell::RefCell;

use super::*;
use crate::kernel::Slot;
use crate::raster::{Look, RegisterPicture};
use crate::scene::{Progress, Show};

const BLACK: [u8; 4] = [0, 0, 0, 255];

#[test]
fn a_rectangle_of_one_colour() {
    let half = quad([-1.0, -1.0, 0.0, 1.0]);
    let target = rendered(&format!(
        "size = [4, 2]\nclear = [0, 0, 0, 1]\n[meshes.half]\n{half}\n[[draw]]\nmesh = \"half\"\n\
         vs = \"flat.vsh\"\nps = \"c0.psh\"\nps_constants = {{ c0 = [0.2, 0.4, 0.6, 0.8] }}\n"
    ));
    // x from -1 to 0 is from 0 to 2 on the screen: of the pixel centres 0, 1, 2, 3 the first two are inside, and the
    // right edge is not. 0.2 · 255 = 51 and so on.
    let row = [[51, 102, 153, 204], [51, 102, 153, 204], BLACK, BLACK];
    assert_eq!(pixels(&target), [row, row].concat());
}

#[test]
fn a_frame_is_cleared_before_it_is_drawn_again() {
    let half = quad([-1.0, -1.0, 0.0, 1.0]);
    let scene = loaded(&format!(
        "size = [4, 1]\nclear = [0.2, 0, 0, 1]\n[meshes.half]\n{half}\n[[draw]]\nmesh = \"half\"\n\
         vs = \"flat.vsh\"\nps = \"c0.psh\"\nps_constants = {{ c0 = [0.2, 0.4, 0, 0] }}\n\
         state = {{ alpha_blend = true, src_blend = \"one\", dest_blend = \"one\" }}\n"
    ));
    let mut frame = scene.prepare_frame([4, 1]).unwrap();
    // 0.2 · 255 = 51, and the same again where something is drawn.
    let (drawn, clear) = ([102, 102, 0, 255], [51, 0, 0, 255]);
    for _ in 0..3 {
        frame.draw().unwrap();
        assert_eq!(pixels(frame.picture()), [drawn, drawn, clear, clear]);
    }
}

#[test]
fn a_texture_and_states() {
    // Two texels, green and blue, over the left and the right half; added to the red of the clear colour.
    let whole = quad([-1.0, -1.0, 1.0, 1.0]);
    let target = rendered(&format!(
        r#"
size = [4, 1]
clear = [1, 0, 0, 1]
[meshes.all]
{whole}
[textures.two]
texels = [[0, 1, 0], [0, 0, 1]]
size = [2, 1]
[[draw]]
mesh = "all"
vs_text = """
vs.1.1
mov oPos, v0
mov oT0, v7
"""
ps = "stage0.psh"
stages.0.texture = "two"
state = {{ alpha_blend = true, src_blend = "one", dest_blend = "one", color_write = "rg" }}
"#
    ));
    // u at the pixel centres is 0, 1/4, 1/2, 3/4. Blue is not written.
    let (left, right) = ([255, 255, 0, 255], [255, 0, 0, 255]);
    assert_eq!(pixels(&target), [left, left, right, right]);
}

#[test]
fn draws_are_drawn_in_the_order_of_the_list() {
    let scene = |draws: &str| {
        let whole = quad([-1.0, -1.0, 1.0, 1.0]);
        let draw = |name: &str, color: &str| {
            format!(
                "[[draw]]\nname = \"{name}\"\nmesh = \"all\"\nvs = \"flat.vsh\"\nps = \"c0.psh\"\n\
                 ps_constants.c0 = {color}\n"
            )
        };
        let (red, green) = (draw("red", "[1, 0, 0, 1]"), draw("green", "[0, 1, 0, 1]"));
        format!("size = [1, 1]\n{draws}\n[meshes.all]\n{whole}\n{red}{green}")
    };
    // Equal depths pass, so that the last one is seen.
    let (red, green) = ([255, 0, 0, 255], [0, 255, 0, 255]);
    assert_eq!(pixels(&rendered(&scene(""))), [green]);
    assert_eq!(
        pixels(&rendered(&scene("draws = [\"green\", \"red\"]"))),
        [red]
    );
    assert_eq!(pixels(&rendered(&scene("draws = [\"red\"]"))), [red]);
    assert_eq!(pixels(&rendered(&scene("draws = []"))), [BLACK]);
}

#[test]
fn attributes_reach_the_registers_that_the_declaration_names() {
    let scene = |declaration: &str, register: &str| {
        let whole = quad([-1.0, -1.0, 1.0, 1.0]);
        let text = format!("vs.1.1\\nmov oPos, v0\\nmov oD0, {register}\\n");
        format!(
            "size = [1, 1]\n[meshes.all]\n{whole}\ncolor = [0.2, 0.4, 0.6, 0.8]\n[[draw]]\nmesh = \"all\"\n{declaration}\n\
             vs_text = \"{text}\"\nps_text = \"ps.1.1\\nmov r0, v0\\n\"\n"
        )
    };
    let colour = [51, 102, 153, 204];
    assert_eq!(pixels(&rendered(&scene("", "v5"))), [colour]);
    // A position has w = 1; the register that nothing feeds is (0, 0, 0, 1).
    assert_eq!(pixels(&rendered(&scene("", "v0.w"))), [[255; 4]]);
    let own = "declaration = { v0 = \"position\", v11 = \"color\" }";
    assert_eq!(pixels(&rendered(&scene(own, "v11"))), [colour]);
    assert_eq!(pixels(&rendered(&scene(own, "v5"))), [BLACK]);
    assert_eq!(loaded(&scene(own, "v5")).warnings().len(), 1);
    // The facing side looks to -Z: the normal is (0, 0, -1), of which colours keep 0 to 1.
    assert_eq!(pixels(&rendered(&scene("", "-v3"))), [[0, 0, 255, 0]]);
}

#[test]
fn other_topologies_take_the_vertices_in_order() {
    // Points of one pixel at (-1, 1), the upper left pixel centre, and at (0, 0), the pixel (1, 1).
    let target = rendered(
        r#"
size = [2, 2]
[meshes.points]
positions = [[-1, 1, 0.5], [0, 0, 0.5]]
[[draw]]
mesh = "points"
topology = "pointlist"
vs = "flat.vsh"
ps = "c0.psh"
ps_constants.c0 = 1
"#,
    );
    assert_eq!(pixels(&target), [[255; 4], BLACK, BLACK, [255; 4]]);
}

#[test]
fn a_register_instead_of_the_colour_of_one_draw() {
    let left = quad([-1.0, -1.0, 0.0, 1.0]);
    let right = quad([0.0, -1.0, 1.0, 1.0]);
    let scene = loaded(&format!(
        r#"
size = [2, 1]
[meshes.left]
{left}
[meshes.right]
{right}
[[draw]]
name = "shown"
mesh = "left"
vs = "flat.vsh"
ps_text = "ps.1.1\nadd r1, c0, c0\nmov r0, c1\n"
ps_constants = {{ c0 = [0.1, 0.2, 0.3, 0.4], c1 = 1 }}
state = {{ alpha_blend = true, src_blend = "zero", dest_blend = "zero" }}
[[draw]]
mesh = "right"
vs = "flat.vsh"
ps_text = "ps.1.1\nmov r1, c0\nmov r0, r1\n"
ps_constants.c0 = 1
"#
    ));
    let show = |draw: Option<&str>| RenderOptions {
        size: None,
        show: Some(Show {
            draw: draw.map(str::to_owned),
            pictures: vec![RegisterPicture {
                slot: Slot::temp(1).unwrap(),
                instructions: 1,
                look: Look::default(),
                killed: false,
            }],
        }),
    };
    let picture = scene.render(&show(Some("shown")), &|_| {}).unwrap();
    assert_eq!(pixels(&picture), [[51, 102, 153, 255], [255; 4]]);
    // The last draw shows the same number. The first one multiplies everything by zero.
    let picture = scene.render(&show(None), &|_| {}).unwrap();
    assert_eq!(pixels(&picture), [[0; 4], [255; 4]]);
    let error = scene.render(&show(Some("other")), &|_| {}).err().unwrap();
    assert_eq!(
        error.to_string(),
        "the picture has no draw `other`; it has shown, 2"
    );
}

#[test]
fn size_and_progress() {
    let whole = quad([-1.0, -1.0, 1.0, 1.0]);
    let draw = "[[draw]]\nmesh = \"all\"\nvs = \"flat.vsh\"\nps = \"c0.psh\"\n";
    let scene = loaded(&format!(
        "size = [1, 1]\n[meshes.all]\n{whole}\n{draw}{draw}"
    ));
    let options = RenderOptions {
        size: Some([3, 2]),
        show: None,
    };
    let seen = RefCell::new(Vec::new());
    let progress = |p: Progress<'_>| {
        let line = format!("{}/{} {:?} {}", p.done, p.total, p.target, p.draw);
        seen.borrow_mut().push(line);
    };
    let picture = scene.render(&options, &progress).unwrap();
    assert_eq!((picture.width(), picture.height()), (3, 2));
    assert_eq!(*seen.borrow(), ["0/2 None 1", "1/2 None 2"]);
    let too_large = RenderOptions {
        size: Some([1 << 20, 1]),
        show: None,
    };
    assert!(scene.render(&too_large, &|_| {}).is_err());
}

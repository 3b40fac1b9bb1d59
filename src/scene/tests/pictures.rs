//! Pictures of registers, pixel by pixel by hand.

use super::*;
use crate::kernel::Slot;
use crate::raster::{Look, Mark, MarkSet, RegisterPicture};
use crate::scene::{RenderError, Rendering, Show, ShowExpression};
use crate::sheet::Tile;

const VERTEX: &str = "vs.1.1\nmov oPos, v0\nmov oT0, v7\nadd oT1, v7, c0\nmov oT2, c1\n";

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

/// Something in front of the upper two rows, then the draw that is shown over everything, then what is put here.
fn scene(listing: &str, after: &str) -> Scene {
    let front = quad([-1.0, 0.5, 1.0, 1.0]).replace("0.5]", "0.25]");
    let (whole, right) = (quad([-1.0, -1.0, 1.0, 1.0]), quad([0.0, -1.0, 1.0, 1.0]));
    let behind = whole.replace("0.5]", "0.75]");
    loaded(&format!(
        r#"
size = [8, 8]
clear = [0, 0, 1, 1]
[meshes]
front = {{ {} }}
whole = {{ {} }}
right = {{ {} }}
behind = {{ {} }}
[[draw]]
name = "front"
mesh = "front"
vs = "flat.vsh"
ps = "c0.psh"
ps_constants.c0 = [0, 1, 0, 1]
[[draw]]
name = "shown"
mesh = "whole"
vs_text = """{VERTEX}"""
ps_text = """{listing}"""
vs_constants = {{ c0 = [-0.5, 0, 0, 0], c1 = [3e38, 3e38, 3e38, 3e38] }}
ps_constants.c0 = [0.5, 0.5, 0.5, 1]
state = {{ alpha_blend = true, src_blend = "zero", dest_blend = "zero", color_write = "g" }}
{after}
"#,
        front.trim().replace('\n', ", "),
        whole.trim().replace('\n', ", "),
        right.trim().replace('\n', ", "),
        behind.trim().replace('\n', ", "),
    ))
}

/// Adds a fifth of blue on the right.
const ADDS: &str = r#"
[[draw]]
mesh = "right"
vs = "flat.vsh"
ps = "c0.psh"
ps_constants.c0 = [0, 0, 0.2, 0]
state = { alpha_blend = true, src_blend = "one", dest_blend = "one" }
"#;

fn tiles(scene: &Scene, expressions: &[&str], killed: bool) -> Vec<Tile> {
    let pass = scene.passes(scene.size()).pop().unwrap();
    let draw = &pass.draws[scene.shown_draw(Some("shown")).unwrap()];
    let tiles = expressions.iter().flat_map(|text| {
        let expression: ShowExpression = text.parse().unwrap();
        (expression.tiles(scene, draw, Look::default(), killed))
            .unwrap_or_else(|why| panic!("{why}"))
    });
    tiles.collect()
}

fn drawn<'s>(scene: &'s Scene, pictures: Vec<RegisterPicture>) -> Rendering<'s> {
    let options = RenderOptions {
        size: None,
        show: Some(Show {
            draw: Some("shown".into()),
            pictures,
        }),
    };
    scene.rendering(&options, &|_| {}).unwrap()
}

fn pictures(tiles: &[Tile]) -> Vec<RegisterPicture> {
    tiles.iter().map(|tile| tile.picture).collect()
}

#[test]
fn colours_and_marks() {
    let scene = scene(LISTING, ADDS);
    let shown = [
        "r0@2", "r3@5", "r5@7", "r1@8", "r1.r@8", "r4@2", "r3@3", "r0", "r0.a",
    ];
    let drawn = drawn(&scene, pictures(&tiles(&scene, &shown, false)));
    // The last draw adds 51 to blue, also to that of marks. Pixel (6, 2) is on a stripe: 8 is a multiple of 8.
    let [nan, infinite] = [[255, 0, 255, 255], [0, 255, 255, 255]];
    let unwritten = [120, 90, 51, 255];
    for (number, [at_6_2, at_5_2]) in [
        // 6/8, 2/8 and 5/8 in steps of 1/255: 191.25, 63.75, 159.375.
        [[191, 64, 51, 255], [159, 64, 51, 255]],
        [infinite; 2],
        [nan; 2],
        // 5/16 is 79.7.
        [unwritten, [80, 0, 51, 255]],
        // 6/16 is 95.6.
        [[96, 96, 147, 255], [80, 80, 131, 255]],
        [unwritten; 2],
        [unwritten; 2],
        [[191, 64, 51, 255], [159, 64, 51, 255]],
        [[255; 4]; 2],
    ]
    .into_iter()
    .enumerate()
    {
        let picture = drawn.picture().plane(number);
        assert_eq!(picture.get_pixel(6, 2).0, at_6_2, "{}", shown[number]);
        assert_eq!(picture.get_pixel(5, 2).0, at_5_2, "{}", shown[number]);
        // What is discarded shows what is behind it, at every instruction; what is hidden shows what hides it.
        assert_eq!(picture.get_pixel(3, 2).0, [0, 0, 255, 255]);
        assert_eq!(picture.get_pixel(3, 1).0, [0, 255, 0, 255]);
        assert_eq!(picture.get_pixel(5, 1).0, [0, 255, 0, 255]);
    }
    let only = |mark: Mark| {
        let mut set = MarkSet::default();
        set.insert(mark);
        set
    };
    let none = MarkSet::default();
    let unwritten = only(Mark::Unwritten);
    let marks = [
        none,
        only(Mark::Infinite),
        only(Mark::NotANumber),
        unwritten,
    ];
    assert_eq!(drawn.marks()[..4], marks);
    assert_eq!(drawn.marks()[4..], [none, unwritten, unwritten, none, none]);
}

/// What is discarded is marked where nothing is in front of it, and leaves no depth: what is drawn behind it later is seen.
#[test]
fn discarded_pixels() {
    let killed = |after: &str| {
        let scene = scene(LISTING, after);
        let drawn = drawn(&scene, pictures(&tiles(&scene, &["r0@2"], true)));
        let marked = drawn.marks()[0].contains(Mark::Killed);
        (drawn.picture().to_image(), marked)
    };
    let (picture, marked) = killed("");
    assert!(marked);
    assert_eq!(picture.get_pixel(3, 2).0, [130, 0, 50, 255]);
    assert_eq!(picture.get_pixel(4, 2).0, [128, 64, 0, 255]);
    assert_eq!(picture.get_pixel(3, 1).0, [0, 255, 0, 255]);
    let behind =
        "[[draw]]\nmesh = \"behind\"\nvs = \"flat.vsh\"\nps = \"c0.psh\"\nps_constants.c0 = 1\n";
    let (picture, _) = killed(behind);
    assert_eq!(picture.get_pixel(3, 2).0, [255; 4]);
    assert_eq!(picture.get_pixel(4, 2).0, [128, 64, 0, 255]);
}

#[test]
fn one_tile_an_instruction() {
    let scene = scene(LISTING, "");
    let tiles = tiles(&scene, &["all"], false);
    let captions: Vec<_> = tiles.iter().map(|tile| tile.caption.as_str()).collect();
    assert_eq!(
        captions,
        [
            "2 texcrd r0.rgb, t0",
            "3 texcrd r2.rgb, t2",
            "4 texkill t1",
            "5 add r3.rgb, r2, r2",
            "6 add r4.rgb, -r2, -r2",
            "7 add r5.rgb, r3, r4",
            "8 mul r1.r, r0, c0.r",
            "9 +mov r1.a, c0.a",
            "10 mov r0.a, c0"
        ]
    );
    let of = |number: usize| {
        let picture = tiles[number].picture;
        let components = picture.look.components.text(['x', 'y', 'z', 'w']);
        (
            picture.slot,
            components,
            picture.instructions,
            picture.killed,
        )
    };
    let temp = |index| Slot::temp(index).unwrap();
    assert_eq!(of(0), (temp(0), ".xyz".into(), 1, false));
    assert_eq!(of(2), (Slot::texcoord(1).unwrap(), ".xyz".into(), 3, true));
    assert_eq!(of(6), (temp(1), ".x".into(), 7, false));
    assert_eq!(of(7), (temp(1), ".w".into(), 8, false));
}

/// Matrices before `ps.1.4`: the lines that begin one show its rows so far.
#[test]
fn tiles_of_a_matrix() {
    let listing = "ps.1.1\ntex t0\ntexm3x3pad t1, t0\ntexm3x3pad t2, t0\ntexm3x3tex t3, t0\nnop\nmov r0, t3\n";
    let scene = scene(listing, "");
    let tiles = tiles(&scene, &["all"], false);
    let of = |tile: &Tile| {
        (
            tile.picture.slot,
            tile.picture.look.components.text(['x', 'y', 'z', 'w']),
        )
    };
    let all: Vec<_> = tiles.iter().map(of).collect();
    let texture = |index| Slot::texture(index).unwrap();
    let expected = [
        (texture(0), ""),
        (Slot::ROW, ".x"),
        (Slot::ROW, ".y"),
        (texture(3), ""),
        (Slot::R0, ""),
    ];
    assert_eq!(all, expected.map(|(slot, mask)| (slot, mask.to_string())));
}

/// Whatever is pictured beside it, a picture is the same to the bit.
#[test]
fn pictures_do_not_know_of_each_other() {
    for (listing, after) in [
        (LISTING, ADDS),
        (LISTING, ""),
        (
            "ps.1.4\ntexcrd r5.rgb, t0\nmov r1.rgb, r5\n+mov r1.a, c0.r\nphase\ntexdepth r5\nmov r0, r1.r\n",
            ADDS,
        ),
        (
            "ps.1.1\ntexcoord t0\ntexkill t1\nmul r1.rgb, t0, c0\n+mov r1.a, t0.b\nadd r0, r1, v0\n",
            ADDS,
        ),
    ] {
        let scene = scene(listing, after);
        for killed in [false, true] {
            let tiles = tiles(&scene, &["all", "oT2", "v0", "r1"], killed);
            let together = drawn(&scene, pictures(&tiles));
            for (number, tile) in tiles.iter().enumerate() {
                let alone = drawn(&scene, vec![tile.picture]);
                let (one, other) = (alone.picture().to_image(), together.picture().plane(number));
                assert_eq!(one, other, "{} of {listing}", tile.caption);
                assert_eq!(alone.marks()[0], together.marks()[number]);
            }
        }
    }
}

#[test]
fn what_cannot_be_shown() {
    let scene = scene(LISTING, "");
    let pass = scene.passes(scene.size()).pop().unwrap();
    let why = |text: &str| {
        let expression: ShowExpression = text.parse().unwrap();
        let shown = expression.tiles(&scene, &pass.draws[1], Look::default(), false);
        shown.unwrap_err().to_string()
    };
    assert_eq!(why("r6"), "ps.1.4 has no r6");
    assert_eq!(why("oT9"), "a vertex shader has no oT9");
    assert_eq!(
        why("r0@1"),
        "line 1 is no instruction; the first one is on line 2"
    );
    assert_eq!(
        why("r0@99"),
        "line 99 is no instruction; the last one is on line 10"
    );
    let picture = tiles(&scene, &["r0"], false)[0].picture;
    let options = RenderOptions {
        size: None,
        show: Some(Show {
            draw: None,
            pictures: vec![picture; 513],
        }),
    };
    let refused = scene.rendering(&options, &|_| {});
    assert!(matches!(refused, Err(RenderError::Planes(_))));
}

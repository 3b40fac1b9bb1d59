//! Which pixels are drawn.

use super::*;

/// All pixels of a rectangle, ends left out.
fn pixels([x0, y0, x1, y1]: [u32; 4]) -> Vec<(u32, u32)> {
    let row = |y| (x0..x1).map(move |x| (x, y));
    (y0..y1).flat_map(row).collect()
}

fn state(state: &str) -> String {
    format!("[draw.state]\n{state}\n")
}

/// fixed-function.md, 2.1 and 2.2.
#[test]
fn pixel_centres_and_the_fill_rule() {
    let device = crate::device();
    let mut both = Both::new(&device);
    let corners = [on(0.0, 0.0), on(5.0, 0.0), on(0.0, 5.0), on(5.0, 5.0)];
    let strip = draw(&corners, "topology = \"trianglestrip\"");
    both.lights("25 pixels", &[strip], pixels([0, 0, 5, 5]));
    let [a, b, c, d] = corners;
    // The diagonal is a left edge of the upper triangle: 5 + 4 + 3 + 2 + 1 pixels, and 10 are left.
    let upper = |x: &u32, y: &u32| x >= y;
    let [upper, lower]: [Vec<_>; 2] = [true, false].map(|above| {
        let all = pixels([0, 0, 5, 5]).into_iter();
        all.filter(|(x, y)| upper(x, y) == above).collect()
    });
    assert_eq!((upper.len(), lower.len()), (15, 10));
    both.lights("15 pixels", &[draw(&[a, b, d], "")], upper);
    both.lights("10 pixels", &[draw(&[a, d, c], "")], lower);
    // Centres 0 to 3 lie between -0.5 and 3.5.
    let shifted = rectangle([-0.5, -0.5, 3.5, 3.5], on(0.0, 0.0));
    both.lights("centres", &[draw(&shifted, "")], pixels([0, 0, 4, 4]));
    let between = rectangle([2.25, 0.0, 2.75, 9.0], on(0.0, 0.0));
    both.lights("between two centres", &[draw(&between, "")], vec![]);
}

/// fixed-function.md, 2.3 and 16: the default leaves out what runs counter-clockwise on the screen.
#[test]
fn culling() {
    let device = crate::device();
    let mut both = Both::new(&device);
    let clockwise = [on(0.0, 0.0), on(5.0, 0.0), on(5.0, 5.0)];
    let counter = [clockwise[0], clockwise[2], clockwise[1]];
    for (keys, sides) in [
        ("", [15, 0]),
        ("cull = \"ccw\"", [15, 0]),
        ("cull = \"cw\"", [0, 15]),
        ("cull = \"none\"", [15, 15]),
    ] {
        for (triangle, expected) in [clockwise, counter].iter().zip(sides) {
            for (path, lit) in both.covered(&[draw(triangle, &state(keys))]) {
                assert_eq!(lit.len(), expected, "`{keys}` on the {path}");
            }
        }
    }
    // Every second triangle of a strip is turned round, so that all face the same way; and so do those of a fan.
    let strip = [on(0.0, 0.0), on(5.0, 0.0), on(0.0, 5.0), on(5.0, 5.0)];
    let [a, b, c, d] = strip;
    let strip = draw(&strip, "topology = \"trianglestrip\"");
    both.lights("a strip", &[strip], pixels([0, 0, 5, 5]));
    let fan = draw(&[a, b, d, c], "topology = \"trianglefan\"");
    both.lights("a fan", &[fan], pixels([0, 0, 5, 5]));
    // The same strip through indices of the draw.
    let keys = "topology = \"trianglestrip\"\nindices = [3, 2, 1, 0]";
    let strip = draw(&[d, c, b, a], keys);
    both.lights("an indexed strip", &[strip], pixels([0, 0, 5, 5]));
}

/// fixed-function.md, 2: 0 ≤ z ≤ w, nothing behind the eye, user planes on clip-space positions.
#[test]
fn clipping() {
    let device = crate::device();
    let mut both = Both::new(&device);
    let slope = |left: f32, right: f32| {
        let mut quad = rectangle([0.0, 0.0, 16.0, 16.0], on(0.0, 0.0));
        for vertex in &mut quad {
            vertex.z = if vertex.at[0] > 0.0 { right } else { left };
        }
        quad
    };
    // z = (x - 8.5)/8: not before column 9.
    let near = slope(-17.0 / 16.0, 15.0 / 16.0);
    both.lights("near", &[draw(&near, "")], pixels([9, 0, 16, 16]));
    // z = 1 + (x - 8.5)/16: not behind column 8.
    let far = slope(1.0 - 8.5 / 16.0, 1.0 + 7.5 / 16.0);
    both.lights("far", &[draw(&far, "")], pixels([0, 0, 9, 16]));
    for w in [-1.0, 0.0] {
        let behind = Vertex { w, ..on(0.0, 0.0) };
        let quad = draw(&everywhere(behind), &state("cull = \"none\""));
        both.lights("behind the eye", &[quad], vec![]);
    }
    // x ≥ -w/4: from column 6 on, in which it is 0: that is kept. And y ≤ w/8, which row 7 is: from row 7 on.
    let planes = "clip_planes = [[1, 0, 0, 0.25], [0, -1, 0, 0.125]]";
    let like = Vertex {
        w: 2.0,
        ..on(0.0, 0.0)
    };
    let quad = draw(&everywhere(like), &state(planes));
    both.lights("user planes", &[quad], pixels([6, 7, 16, 16]));
}

/// fixed-function.md, 2: xs = X + (x/w + 1)·Width/2, ys = Y + (1 - y/w)·Height/2.
#[test]
fn viewports() {
    let device = crate::device();
    let mut both = Both::new(&device);
    let whole = everywhere(on(0.0, 0.0));
    for (viewport, expected) in [
        ("x = 3, y = 2, width = 4, height = 5", [3, 2, 7, 7]),
        // What lies beyond the target is not drawn.
        ("x = 3, y = 2, width = 4, height = 100", [3, 2, 7, 16]),
        // To the end of the target.
        ("x = 10, y = 12", [10, 12, 16, 16]),
        ("width = 7", [0, 0, 7, 16]),
        ("x = 16", [0; 4]),
        ("width = 0", [0; 4]),
        ("x = 9000, y = 3, width = 20", [0; 4]),
    ] {
        let keys = state(&format!("viewport = {{ {viewport} }}"));
        both.lights(viewport, &[draw(&whole, &keys)], pixels(expected));
    }
    // x/w and y/w from -1/2 to 1/2: xs = 2 + 1/2·4 to 2 + 3/2·4, ys = 4 + 1/2·2 to 4 + 3/2·2.
    let middle = rectangle([4.0, 4.0, 12.0, 12.0], on(0.0, 0.0));
    let keys = state("viewport = { x = 2, y = 4, width = 8, height = 4 }");
    both.lights("a part", &[draw(&middle, &keys)], pixels([4, 5, 8, 7]));
    // A draw without one after it is not held by it.
    let draws = [draw(&middle, &keys), draw(&whole, "")];
    both.lights("two draws", &draws, pixels([0, 0, 16, 16]));
    // Strips of pixels of points, too.
    let point = Vertex {
        size: 6.0,
        ..on(8.0, 8.0)
    };
    let keys = format!(
        "topology = \"pointlist\"\nvs_text = \"{VERTEX}{SIZED}\"\n{}",
        state("viewport = { x = 2, y = 4, width = 8, height = 4 }")
    );
    // Around (6, 6) from 3 to 9 both ways, of which the rows 4 to 7 are in the viewport.
    both.lights("a point", &[draw(&[point], &keys)], pixels([3, 4, 9, 8]));
}

/// fixed-function.md, 15.
#[test]
fn sizes_of_points() {
    let device = crate::device();
    let mut both = Both::new(&device);
    let points = |vertex: Vertex, sized: bool, keys: &str| {
        let vs = if sized { SIZED } else { "" };
        let keys = format!(
            "topology = \"pointlist\"\nvs_text = \"{VERTEX}{vs}\"\n{}",
            state(keys)
        );
        [draw(&[vertex], &keys)]
    };
    let at = on(4.0, 4.0);
    let sized = |size: f32| Vertex { size, ..at };
    for (what, vertex, writes, keys, expected) in [
        ("the default, 1", at, false, "", [4, 4, 5, 5]),
        // From 2 to 6: the right and the lower side do not belong to it.
        ("the state", at, false, "point_size = 4", [2, 2, 6, 6]),
        ("oPts", sized(4.0), true, "", [2, 2, 6, 6]),
        (
            "oPts before the state",
            sized(2.0),
            true,
            "point_size = 4",
            [3, 3, 5, 5],
        ),
        (
            "the most",
            sized(4.0),
            true,
            "point_size_max = 2",
            [3, 3, 5, 5],
        ),
        (
            "the most, of the state",
            at,
            false,
            "point_size = 9\npoint_size_max = 2",
            [3, 3, 5, 5],
        ),
        (
            "the least",
            sized(0.0),
            true,
            "point_size_min = 4",
            [2, 2, 6, 6],
        ),
        // From 3.5 to 4.5 and from 3.75 to 4.25 there is one centre, from 4.1 to 4.6 none.
        ("half a pixel", sized(0.5), true, "", [4, 4, 5, 5]),
        (
            "between centres",
            Vertex {
                at: [4.35, 4.35],
                ..sized(0.5)
            },
            true,
            "",
            [0; 4],
        ),
        ("nothing", sized(0.0), true, "", [0; 4]),
        (
            "culling is for triangles",
            sized(4.0),
            true,
            "cull = \"cw\"",
            [2, 2, 6, 6],
        ),
        // A point is clipped by its centre in depth and at user planes, by its pixels at the sides of the screen.
        (
            "behind the far plane",
            Vertex {
                z: 1.25,
                ..sized(4.0)
            },
            true,
            "",
            [0; 4],
        ),
        (
            "beside the screen",
            Vertex {
                at: [-1.0, 4.0],
                ..sized(4.0)
            },
            true,
            "",
            [0, 2, 1, 6],
        ),
        // x ≥ 0.
        (
            "on a user plane",
            Vertex {
                at: [8.0, 4.0],
                ..sized(4.0)
            },
            true,
            "clip_planes = [[1, 0, 0, 0]]",
            [6, 2, 10, 6],
        ),
        (
            "behind a user plane",
            Vertex {
                at: [7.0, 4.0],
                ..sized(4.0)
            },
            true,
            "clip_planes = [[1, 0, 0, 0]]",
            [0; 4],
        ),
    ] {
        both.lights(what, &points(vertex, writes, keys), pixels(expected));
    }
}

/// Lines along the axes: the last pixel is left to the line that goes on from there. Slanted lines, and which end of a line
/// is left out that goes to the left or up, are the device's business.
#[test]
fn lines() {
    let device = crate::device();
    let mut both = Both::new(&device);
    let line = |from: (f32, f32), to: (f32, f32)| {
        let ends = [on(from.0, from.1), on(to.0, to.1)];
        [draw(&ends, "topology = \"linelist\"")]
    };
    both.lights("right", &line((0.0, 2.0), (4.0, 2.0)), pixels([0, 2, 4, 3]));
    both.lights("down", &line((2.0, 0.0), (2.0, 3.0)), pixels([2, 0, 3, 3]));
    let strip = [on(0.0, 5.0), on(3.0, 5.0), on(8.0, 5.0)];
    let keys = "topology = \"linestrip\"";
    both.lights("a strip", &[draw(&strip, keys)], pixels([0, 5, 8, 6]));
    let indexed = draw(&strip, "topology = \"linestrip\"\nindices = [0, 2]");
    both.lights("indices", &[indexed], pixels([0, 5, 8, 6]));
}

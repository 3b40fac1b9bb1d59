//! Which pixels primitives cover.

use proptest::prelude::*;

use super::*;

/// All pixels of a rectangle, ends left out.
fn rectangle(x0: u32, y0: u32, x1: u32, y1: u32) -> Vec<(u32, u32)> {
    (y0..y1)
        .flat_map(|y| (x0..x1).map(move |x| (x, y)))
        .collect()
}

#[test]
fn the_fill_rule_examples_of_the_direct3d_documents() {
    let corners = [on(0.0, 0.0), on(5.0, 0.0), on(0.0, 5.0), on(5.0, 5.0)];
    let state = counting();
    assert_eq!(
        hits(Topology::TriangleStrip, &corners, &state),
        rectangle(0, 0, 5, 5)
    );
    let [a, b, c, d] = corners;
    let upper = hits(Topology::TriangleList, &[a, b, d], &state);
    let lower = hits(Topology::TriangleList, &[a, d, c], &state);
    assert_eq!(upper.len(), 15);
    assert_eq!(lower.len(), 10);
    // The diagonal is a left edge of the upper triangle.
    assert!(upper.contains(&(2, 2)));
}

/// Four triangles that make a rectangle of 2 by 4, here and a little aside. The pixels are those of Windows drivers, from Wine's
/// visual test of Direct3D 8, `test_filling_convention`.
#[test]
fn the_fill_rule_as_it_was_measured() {
    let step = 1.0 / 16.0;
    for (dx, dy, measured) in [
        (0.0, 0.0, ["....", "TT..", "LT..", "LR..", "LB..", "...."]),
        (-0.5, 0.5, ["....", "....", "TT..", "LR..", "LR..", "BB.."]),
        (step, 0.0, ["....", ".TT.", ".TR.", ".LR.", ".BR.", "...."]),
        (-step, 0.0, ["....", "TT..", "LT..", "LR..", "LB..", "...."]),
        (0.0, -step, ["....", "LT..", "LT..", "LB..", "LB..", "...."]),
        (0.0, step, ["....", "....", "LT..", "LT..", "LB..", "LB.."]),
    ] {
        let mut drawn = [[b'.'; 4]; 6];
        for (name, corners) in [
            (b'L', [(2, 1), (3, 3), (2, 5)]),
            (b'T', [(2, 1), (4, 1), (3, 3)]),
            (b'R', [(4, 1), (4, 5), (3, 3)]),
            (b'B', [(3, 3), (4, 5), (2, 5)]),
        ] {
            let corners = corners.map(|(x, y)| on(x as f32 + dx, y as f32 + dy));
            for (x, y) in hits(Topology::TriangleList, &corners, &counting()) {
                let pixel = &mut drawn[y as usize][x as usize - 2];
                assert_eq!(*pixel, b'.', "({x}, {y}) is drawn twice");
                *pixel = name;
            }
        }
        let drawn = drawn.map(|row| String::from_utf8(row.to_vec()).unwrap());
        assert_eq!(drawn, measured, "{dx}, {dy}");
    }
}

#[test]
fn pixel_centres_are_at_integers() {
    // From -0.5 to 3.5 are the centres 0 to 3.
    let quad = [on(-0.5, -0.5), on(3.5, -0.5), on(-0.5, 3.5), on(3.5, 3.5)];
    assert_eq!(
        hits(Topology::TriangleStrip, &quad, &counting()),
        rectangle(0, 0, 4, 4)
    );
    // Nothing between two centres.
    let thin = [on(2.25, 0.0), on(2.75, 0.0), on(2.25, 9.0), on(2.75, 9.0)];
    assert!(hits(Topology::TriangleStrip, &thin, &counting()).is_empty());
}

#[test]
fn culling_goes_by_the_winding_on_the_screen() {
    let clockwise = [on(0.0, 0.0), on(4.0, 0.0), on(4.0, 4.0)];
    let counter = [clockwise[0], clockwise[2], clockwise[1]];
    for (cull, draws_clockwise, draws_counter) in [
        (CullMode::None, true, true),
        (CullMode::Cw, false, true),
        (CullMode::Ccw, true, false),
    ] {
        let state = RenderState { cull, ..counting() };
        assert_eq!(
            !hits(Topology::TriangleList, &clockwise, &state).is_empty(),
            draws_clockwise
        );
        assert_eq!(
            !hits(Topology::TriangleList, &counter, &state).is_empty(),
            draws_counter
        );
    }
    // The odd triangle of a strip is turned over, so both face the same way: the 25 pixels of a square.
    let strip = [on(0.0, 0.0), on(5.0, 0.0), on(0.0, 5.0), on(5.0, 5.0)];
    let state = RenderState {
        cull: CullMode::Ccw,
        ..counting()
    };
    assert_eq!(hits(Topology::TriangleStrip, &strip, &state).len(), 25);
    let fan = [on(0.0, 0.0), on(5.0, 0.0), on(5.0, 5.0), on(0.0, 5.0)];
    assert_eq!(hits(Topology::TriangleFan, &fan, &state).len(), 25);
}

#[test]
fn the_viewport_is_a_place_and_a_limit() {
    let state = counting();
    let all = everywhere(on(0.0, 0.0));
    let viewport = Viewport {
        x: 3,
        y: 2,
        width: 4,
        height: 100,
        ..Viewport::full(0, 0)
    };
    let mut target = target();
    let shaded = Vertices::from(&all[..]);
    let call = DrawCall {
        viewport,
        ..call(&state, Topology::TriangleList, &shaded)
    };
    let statistics = draw(&mut target, &call, &tally()).unwrap();
    // 4 columns of the rows 2 to 15.
    assert_eq!(statistics.written, 4 * 14);
    assert_eq!(target.color(3, 2).unwrap()[0], 1);
    assert_eq!(target.color(2, 2).unwrap()[0], 0);
    assert_eq!(target.color(3, 1).unwrap()[0], 0);
}

#[test]
fn a_point_is_a_square() {
    let points = |state: &PointState, vertices: &[Vertex]| {
        let state = RenderState {
            point: *state,
            ..counting()
        };
        hits(Topology::PointList, vertices, &state)
    };
    let mut state = PointState::default();
    // Size 1 around (3, 3): from 2.5 to 3.5.
    assert_eq!(points(&state, &[on(3.0, 3.0)]), [(3, 3)]);
    state.size = 4.0;
    // From 2 to 6, so that 6 is left out: 4 by 4.
    assert_eq!(points(&state, &[on(4.0, 4.0)]), rectangle(2, 2, 6, 6));
    state.max = 2.0;
    assert_eq!(points(&state, &[on(4.0, 4.0)]), rectangle(3, 3, 5, 5));
    let of_vertex = Vertex {
        point_size: Some(0.5),
        ..on(4.0, 4.0)
    };
    assert_eq!(points(&state, &[of_vertex]), [(4, 4)]);
    state.min = 2.0;
    assert_eq!(points(&state, &[of_vertex]), rectangle(3, 3, 5, 5));
    // Cut by the target's edge; left out behind the far plane.
    assert_eq!(points(&state, &[on(0.0, 0.0)]), [(0, 0)]);
    assert!(points(&state, &[at(4.0, 4.0, 1.5, 1.0)]).is_empty());
}

#[test]
fn a_line_lights_each_diamond_that_it_leaves() {
    let line = |from: (f32, f32), to: (f32, f32)| {
        hits(
            Topology::LineList,
            &[on(from.0, from.1), on(to.0, to.1)],
            &counting(),
        )
    };
    // The last pixel is left to the next line, in every direction.
    assert_eq!(
        line((0.0, 2.0), (4.0, 2.0)),
        [(0, 2), (1, 2), (2, 2), (3, 2)]
    );
    assert_eq!(
        line((4.0, 2.0), (0.0, 2.0)),
        [(1, 2), (2, 2), (3, 2), (4, 2)]
    );
    assert_eq!(line((2.0, 0.0), (2.0, 3.0)), [(2, 0), (2, 1), (2, 2)]);
    assert_eq!(line((2.0, 3.0), (2.0, 0.0)), [(2, 1), (2, 2), (2, 3)]);
    assert_eq!(line((1.0, 1.0), (4.0, 4.0)), [(1, 1), (2, 2), (3, 3)]);
    assert_eq!(line((4.0, 1.0), (1.0, 4.0)), [(4, 1), (3, 2), (2, 3)]);
    // Slope 1/2: rows 0, 0.5, 1, 1.5; half way goes to the upper one.
    assert_eq!(
        line((0.0, 0.0), (4.0, 2.0)),
        [(0, 0), (1, 0), (2, 1), (3, 1)]
    );
    // From (3.25, 0.375) the line starts beyond the diamond of (3, 0): 0.25 + 0.375 > 1/2.
    assert_eq!(line((3.25, 0.375), (6.0, 0.375)), [(4, 0), (5, 0)]);
    // From (3.25, 0.125) it starts inside.
    assert_eq!(line((3.25, 0.125), (6.0, 0.125)), [(3, 0), (4, 0), (5, 0)]);
    assert!(line((3.0, 3.0), (3.0, 3.0)).is_empty());
    // A strip that goes on straight lights each pixel once.
    let strip = [on(0.0, 5.0), on(3.5, 5.0), on(8.0, 5.0)];
    assert_eq!(
        hits(Topology::LineStrip, &strip, &counting()),
        rectangle(0, 5, 8, 6)
    );
}

#[test]
fn edges_and_corners_instead_of_areas() {
    let triangle = [on(2.0, 2.0), on(6.0, 2.0), on(2.0, 6.0)];
    let state = RenderState {
        fill: FillMode::Wireframe,
        ..counting()
    };
    let mut expected = rectangle(2, 2, 6, 3); // (2,2) to (6,2), without the end
    expected.extend([(6, 2), (5, 3), (4, 4), (3, 5)]); // (6,2) to (2,6)
    expected.extend([(2, 6), (2, 5), (2, 4), (2, 3)]); // (2,6) to (2,2)
    expected.sort_by_key(|(x, y)| (*y, *x));
    assert_eq!(hits(Topology::TriangleList, &triangle, &state), expected);
    let state = RenderState {
        fill: FillMode::Point,
        ..counting()
    };
    assert_eq!(
        hits(Topology::TriangleList, &triangle, &state),
        [(2, 2), (6, 2), (2, 6)]
    );
}

#[test]
fn user_clip_planes_cut() {
    let mut state = counting();
    // Keeps x ≥ 0 in clip space: the right half of the screen.
    state.clip_planes[3] = Some(vec4(1.0, 0.0, 0.0, 0.0));
    let hits = hits(Topology::TriangleList, &everywhere(on(0.0, 0.0)), &state);
    assert_eq!(hits, rectangle(8, 0, 16, 16));
}

/// A net of vertices over a square that is a little larger than 128×128 pixels, moved about inside, with its triangles.
fn net(moves: &[(f32, f32, f32)], reach: f32) -> (Vec<Vertex>, Vec<u32>) {
    const N: u32 = 5;
    let mut vertices = Vec::new();
    for row in 0..N {
        for column in 0..N {
            let (dx, dy, w) = moves[(row * N + column) as usize];
            let place = |i: u32, d: f32| {
                let outer = i == 0 || i == N - 1;
                let even = (i as f32 / (N - 1) as f32) * 2.0 - 1.0;
                // Inner vertices stay within a fifth of a cell, so that no triangle turns over.
                if outer { even * reach } else { even + d * 0.1 }
            };
            // Outer rows and columns may be far away, but their vertices stay in line with the inner ones.
            let (x, y) = (place(column, dx), place(row, dy));
            vertices.push(Vertex {
                position: vec4(x, y, 0.5, 1.0) * w,
                ..Vertex::default()
            });
        }
    }
    let cells = (0..N - 1).flat_map(|row| (0..N - 1).map(move |column| row * N + column));
    let indices = cells
        .flat_map(|i| [i, i + 1, i + N, i + 1, i + N + 1, i + N])
        .collect();
    (vertices, indices)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// No pixel is hit twice and none is missed, whatever the vertices, with w of all sizes, and with outer vertices so
    /// far away that they are clipped.
    #[test]
    fn triangles_that_share_edges_cover_each_pixel_once(
        moves in prop::collection::vec((-1.0_f32..1.0, -1.0_f32..1.0, 0.01_f32..100.0), 25),
        reach in prop::sample::select(vec![1.02_f32, 3.0, 1e3, 1e5, 1e9]),
    ) {
        let (vertices, indices) = net(&moves, reach);
        let state = counting();
        let mut target = Target::new(128, 128, ColorFormat::A8R8G8B8).unwrap();
        let shaded = Vertices::from(&vertices[..]);
        let call = DrawCall {
            viewport: Viewport::full(128, 128),
            indices: Some(&indices),
            ..call(&state, Topology::TriangleList, &shaded)
        };
        let statistics = draw(&mut target, &call, &tally()).unwrap();
        prop_assert_eq!(statistics.written, 128 * 128);
        prop_assert!(target.to_image().pixels().all(|pixel| pixel.0[0] == 1));
    }

    /// Two triangles on both sides of an edge, each pixel at most once, wherever the edge is cut: by the near plane, the
    /// far plane, or behind the eye.
    #[test]
    fn a_cut_edge_is_cut_in_the_same_place_on_both_sides(
        [a, b, across] in prop::array::uniform3((-3.0_f32..3.0, -3.0_f32..3.0, -1.0_f32..2.0, -1.0_f32..3.0)),
    ) {
        let [a, b, across] = [a, b, across].map(|(x, y, z, w)| vec4(x, y, z, w));
        // From the eye, the third corners lie on different sides of the plane through the edge and the eye: moved from
        // the edge's centre by a vector and its opposite. So no ray meets both triangles.
        let [p, q, r] = [a, b, across].map(|v| glam::vec3(v.x, v.y, v.w));
        prop_assume!(p.cross(q).dot(r).abs() > 0.01);
        let middle = (a + b) / 2.0;
        let vertices = [a, b, middle + across, b, a, middle - across]
            .map(|position| Vertex { position, ..Vertex::default() });
        let hits = hits(Topology::TriangleList, &vertices, &counting());
        let mut once = hits.clone();
        once.dedup();
        prop_assert_eq!(hits, once);
    }
}

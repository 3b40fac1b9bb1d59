//! What pixel shaders are given.

use super::*;

/// The inputs of a pixel and the lane to look at, which must be covered once.
fn at_pixel(
    state: &RenderState,
    topology: Topology,
    vertices: &[Vertex],
    x: u32,
    y: u32,
) -> (Box<PixelBatch>, usize) {
    let shaded = Vertices::from(vertices);
    let call = call(state, topology, &shaded);
    let mut fragments: Vec<Fragment> = cover(&call, (16, 16), (x, y)).unwrap().collect();
    assert_eq!(fragments.len(), 1, "pixel {x}, {y}");
    let fragment = fragments.pop().unwrap();
    (fragment.batch, fragment.lane)
}

fn close(a: f32, b: f32) {
    assert!((a - b).abs() < 1e-6, "{a} is not {b}");
}

fn with(mut vertex: Vertex, value: f32) -> Vertex {
    vertex.texcoords[2] = Vec4::splat(value);
    vertex.diffuse = Vec4::splat(value);
    vertex.specular = Vec4::splat(value);
    vertex.fog = value;
    vertex
}

#[test]
fn all_but_depth_is_perspective_correct() {
    let triangle = [
        with(at(0.0, 0.0, 0.0, 1.0), 0.0),
        with(at(16.0, 0.0, 1.0, 3.0), 1.0),
        with(at(0.0, 16.0, 0.0, 1.0), 0.0),
    ];
    // Half way on the screen between w = 1 and w = 3: (1/2 · 1/3) / (1/2 · 1 + 1/2 · 1/3) = (1/6) / (2/3) = 1/4.
    let (batch, lane) = at_pixel(&open(), Topology::TriangleList, &triangle, 8, 0);
    for value in [
        batch.texcoords[2][3][lane],
        batch.diffuse[0][lane],
        batch.specular[3][lane],
        batch.fog[lane],
    ] {
        close(value, 0.25);
    }
    close(batch.w[lane], 1.5); // 1 / (2/3)
    close(batch.z[lane], 0.5); // linear
    assert_eq!(batch.texcoords[0][0][lane], 0.0);
    // The same on a line.
    let (batch, lane) = at_pixel(&open(), Topology::LineList, &triangle[..2], 8, 0);
    close(batch.texcoords[2][0][lane], 0.25);
    close(batch.w[lane], 1.5);
}

#[test]
fn the_quad_continues_beyond_the_edge() {
    // u = x / 16 at all pixels, so 9/16 beside pixel 8, covered or not; v = y / 16.
    let corner = |x: f32, y: f32| {
        let mut vertex = on(x, y);
        vertex.texcoords[0] = vec4(x / 16.0, y / 16.0, 0.0, 0.0);
        vertex
    };
    let triangle = [corner(0.0, 0.0), corner(8.5, 0.0), corner(0.0, 8.5)];
    let (batch, lane) = at_pixel(&open(), Topology::TriangleList, &triangle, 8, 0);
    assert_eq!(lane, 0);
    assert_eq!(batch.live[..4], [true, false, false, false]);
    assert_eq!((batch.x[3], batch.y[3]), (9, 1));
    for lane in 0..4 {
        close(batch.texcoords[0][0][lane], batch.x[lane] as f32 / 16.0);
        close(batch.texcoords[0][1][lane], batch.y[lane] as f32 / 16.0);
    }
}

#[test]
fn the_near_plane_cuts_without_moving_anything() {
    // z from -1 at the left to 1 at the right: only x ≥ 8 is left, where everything is as it was: t = x / 16.
    let triangle = [
        with(at(0.0, 0.0, -1.0, 1.0), 0.0),
        with(at(16.0, 0.0, 1.0, 1.0), 1.0),
        with(at(16.0, 16.0, 1.0, 1.0), 1.0),
    ];
    let hits = hits(Topology::TriangleList, &triangle, &counting());
    assert!(hits.iter().all(|(x, _)| *x >= 8));
    assert!(hits.contains(&(8, 0)));
    for x in [8, 12, 15] {
        let (batch, lane) = at_pixel(&open(), Topology::TriangleList, &triangle, x, 0);
        close(batch.texcoords[2][0][lane], x as f32 / 16.0);
        close(batch.z[lane], x as f32 / 8.0 - 1.0);
    }
}

#[test]
fn colours_are_limited_at_the_vertex_and_coordinates_are_not() {
    // Limited first, half way between 0 and 1 is 1/2; between -1 and 3 it would be 1.
    let triangle = [
        with(on(0.0, 0.0), -1.0),
        with(on(16.0, 0.0), 3.0),
        with(on(0.0, 16.0), -1.0),
    ];
    let (batch, lane) = at_pixel(&open(), Topology::TriangleList, &triangle, 8, 0);
    close(batch.diffuse[1][lane], 0.5);
    close(batch.specular[1][lane], 0.5);
    close(batch.fog[lane], 0.5);
    close(batch.texcoords[2][1][lane], 1.0);
}

#[test]
fn what_is_the_same_at_all_vertices_is_the_same_to_the_bit() {
    let triangle = [(0.3, 0.1, 0.7), (15.9, 3.3, 19.0), (4.1, 13.7, 3.3)]
        .map(|(x, y, w)| with(at(x, y, 0.4, w), 0.1));
    let (batch, _) = at_pixel(&open(), Topology::TriangleList, &triangle, 7, 5);
    for lane in 0..4 {
        assert_eq!(batch.texcoords[2][0][lane], 0.1);
        assert_eq!(batch.diffuse[0][lane], 0.1);
    }
}

#[test]
fn flat_shading_takes_the_colours_of_the_first_vertex() {
    let state = RenderState {
        shade: ShadeMode::Flat,
        ..open()
    };
    let numbered = |i: usize, x: f32, y: f32| with(on(x, y), i as f32 / 4.0);
    let strip = [
        numbered(0, 0.0, 0.0),
        numbered(1, 8.0, 0.0),
        numbered(2, 0.0, 8.0),
        numbered(3, 8.0, 8.0),
    ];
    // Triangle 0 of a strip has vertex 0, triangle 1 vertex 1.
    let (batch, lane) = at_pixel(&state, Topology::TriangleStrip, &strip, 2, 2);
    assert_eq!(batch.diffuse[0][lane], 0.0);
    // The coordinates are interpolated: i = x/8 + 2·y/8, so 6/8 of 1/4.
    close(batch.texcoords[2][0][lane], 6.0 / 8.0 / 4.0);
    let (batch, lane) = at_pixel(&state, Topology::TriangleStrip, &strip, 6, 6);
    assert_eq!(batch.diffuse[0][lane], 0.25);
    assert_eq!(batch.specular[0][lane], 0.25);
    // Triangle 0 of a fan is 1, 2, 0: vertex 1.
    let (batch, lane) = at_pixel(&state, Topology::TriangleFan, &strip[..3], 2, 2);
    assert_eq!(batch.diffuse[0][lane], 0.25);
    let (batch, lane) = at_pixel(&state, Topology::LineList, &strip[2..], 4, 8);
    assert_eq!(batch.diffuse[0][lane], 0.5);
}

#[test]
fn a_sprite_has_coordinates_of_its_own() {
    let mut state = open();
    state.point.size = 4.0;
    let vertex = with(on(4.0, 4.0), 0.75);
    // From 2 to 6 are 0 to 1: pixel 3 is a quarter, pixel 5 three quarters.
    state.point.sprite = true;
    let (batch, lane) = at_pixel(&state, Topology::PointList, &[vertex], 3, 5);
    for set in batch.texcoords {
        let coordinates = set.map(|component| component[lane]);
        assert_eq!(coordinates, [0.25, 0.75, 0.0, 0.0]);
    }
    assert_eq!(batch.diffuse[0][lane], 0.75);
    state.point.sprite = false;
    let (batch, lane) = at_pixel(&state, Topology::PointList, &[vertex], 3, 5);
    assert_eq!(batch.texcoords[2][1][lane], 0.75);
}

#[test]
fn the_depth_range_of_the_viewport_and_the_bias() {
    let mut state = open();
    let triangle = everywhere(at(0.0, 0.0, 0.5, 1.0));
    let viewport = Viewport {
        min_z: 0.25,
        max_z: 0.75,
        ..Viewport::full(16, 16)
    };
    let depth = |state: &RenderState| {
        let shaded = Vertices::from(&triangle[..]);
        let call = DrawCall {
            viewport,
            ..call(state, Topology::TriangleList, &shaded)
        };
        let fragment = cover(&call, (16, 16), (3, 3)).unwrap().next().unwrap();
        fragment.batch.z[fragment.lane]
    };
    close(depth(&state), 0.5);
    state.depth.bias = 16;
    // 16 steps of 1/65535.
    assert!((depth(&state) - (0.5 - 16.0 / 65535.0)).abs() < 1e-7);
    // The same as a state says it: 0.25 + 0.5·0.5 less 16 steps.
    (state.viewport.min_z, state.viewport.max_z) = (0.25, 0.75);
    assert_eq!(state.depth_mapping()[0], 0.5);
    assert!((state.depth_at(0.5) - depth(&state)).abs() < 1e-7);
    // z is taken into 0 to 1 before it, the depth behind it.
    assert!((state.depth_at(7.0) - (0.75 - 16.0 / 65535.0)).abs() < 1e-7);
    (state.viewport.min_z, state.viewport.max_z) = (0.0, 1.0);
    assert_eq!(state.depth_at(1.0 / 65535.0), 0.0);
    assert_eq!(RenderState::default().depth_mapping(), [1.0, 0.0]);
}

#[test]
fn fragments_come_in_order_with_their_vertices() {
    let quad = [on(0.0, 0.0), on(9.0, 0.0), on(0.0, 9.0)];
    let vertices = [
        quad[0],
        quad[1],
        quad[2],
        on(12.0, 12.0),
        quad[0],
        quad[1],
        quad[2],
    ];
    let indices = [0, 1, 2, 3, 3, 3, 4, 5, 6];
    let state = open();
    let shaded = Vertices::from(&vertices[..]);
    let call = DrawCall {
        indices: Some(&indices),
        ..call(&state, Topology::TriangleList, &shaded)
    };
    let found: Vec<_> = cover(&call, (16, 16), (1, 1))
        .unwrap()
        .map(|fragment| (fragment.primitive, fragment.vertices, fragment.lane))
        .collect();
    assert_eq!(found, [(0, [0, 1, 2], 3), (2, [4, 5, 6], 3)]);
    assert_eq!(cover(&call, (16, 16), (40, 1)).unwrap().count(), 0);
    assert_eq!(cover(&call, (16, 16), (u32::MAX, 1)).unwrap().count(), 0);
}

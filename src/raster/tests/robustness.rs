//! Any numbers at all, any order of work, any number of cores.

use proptest::prelude::*;

use super::*;

fn any_number() -> impl Strategy<Value = f32> {
    prop_oneof![
        6 => -2.0_f32..2.0,
        1 => prop::sample::select(vec![
            0.0, -0.0, 1.0, -1.0, f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, f32::MIN,
            f32::MIN_POSITIVE, 1e-45, 1e30, -1e30,
        ]),
        1 => any::<f32>(),
    ]
}

fn any_vertex() -> impl Strategy<Value = Vertex> {
    (
        prop::array::uniform4(any_number()),
        prop::array::uniform4(any_number()),
        any_number(),
        prop::option::of(any_number()),
    )
        .prop_map(|(position, attribute, fog, point_size)| Vertex {
            position: position.into(),
            diffuse: attribute.into(),
            specular: attribute.into(),
            texcoords: [attribute.into(); 8],
            fog,
            point_size,
        })
}

/// Vertices in front of the eye, with finite attributes.
fn sane_vertex() -> impl Strategy<Value = Vertex> {
    (
        (
            -20.0_f32..36.0,
            -20.0_f32..36.0,
            -0.2_f32..1.2,
            0.1_f32..10.0,
        ),
        prop::array::uniform4(0.0_f32..1.0),
    )
        .prop_map(|((x, y, z, w), attribute)| Vertex {
            diffuse: attribute.into(),
            texcoords: [Vec4::from(attribute) * 10.0; 8],
            fog: attribute[0],
            ..at(x, y, z, w)
        })
}

fn any_state() -> impl Strategy<Value = RenderState> {
    (
        prop::sample::select(CullMode::ALL),
        prop::sample::select(FillMode::ALL),
        prop::sample::select(ShadeMode::ALL),
        prop::sample::select(Compare::ALL),
        (any::<bool>(), any::<bool>(), any::<bool>()),
        prop::sample::select(StencilOp::ALL),
    )
        .prop_map(|(cull, fill, shade, func, (stencil, blend, fog), op)| {
            let mut state = RenderState {
                cull,
                fill,
                shade,
                ..RenderState::default()
            };
            state.depth.func = func;
            state.stencil.enable = stencil;
            state.stencil.func = func;
            state.stencil.reference = 3;
            state.stencil.pass = op;
            state.stencil.depth_fail = op;
            state.blend = BlendState {
                enable: blend,
                source: BlendFactor::SrcAlpha,
                destination: BlendFactor::InvSrcAlpha,
                op: BlendOp::Add,
            };
            state.fog.enable = fog;
            state.fog.color = [0.5, 0.0, 1.0];
            state
        })
}

/// Colour, depth (its bits) and stencil of a pixel.
type Contents = ([u8; 4], u32, u8);

/// Everything that a target holds.
fn contents(target: &Target) -> Vec<Contents> {
    let pixel = |x, y| {
        Some((
            target.color(x, y)?,
            target.depth(x, y)?.to_bits(),
            target.stencil(x, y)?,
        ))
    };
    (0..target.height())
        .flat_map(|y| (0..target.width()).map(move |x| (x, y)))
        .map(|(x, y)| pixel(x, y).unwrap())
        .collect()
}

fn diffuse(batch: &PixelBatch, lane: usize) -> [f32; 4] {
    batch.diffuse.map(|component| component[lane])
}

#[test]
fn blocks_wait_for_quads_of_earlier_triangles() {
    let tinted = |color: Vec4, corners: [Vertex; 3]| {
        corners.map(|corner| Vertex {
            diffuse: color,
            ..corner
        })
    };
    let part = tinted(Vec4::X, [on(0.0, 0.0), on(5.0, 0.0), on(0.0, 5.0)]);
    let all = tinted(Vec4::Y, everywhere(on(0.0, 0.0)));
    let colors = |triangles: [[Vertex; 3]; 2]| {
        let mut drawn = target();
        let vertices = Vertices::from(triangles.as_flattened());
        let state = open();
        let call = call(&state, Topology::TriangleList, &vertices);
        draw(&mut drawn, &call, &paint(diffuse)).unwrap();
        [(0, 0), (7, 7)].map(|(x, y)| drawn.color(x, y).unwrap())
    };
    let (red, green) = ([255, 0, 0, 0], [0, 255, 0, 0]);
    assert_eq!(colors([part, all]), [green, green]);
    assert_eq!(colors([all, part]), [red, green]);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn any_vertices_are_drawn_or_left_out(
        vertices in prop::collection::vec(any_vertex(), 0..9),
        state in any_state(),
        plane in prop::option::of(prop::array::uniform4(any_number())),
        topology in prop::sample::select(Topology::ALL),
        size in (0..40_u32, 0..40_u32),
        viewport in (0..20_u32, 0..20_u32, 0..40_u32, prop::sample::select(vec![0, 1, 33, u32::MAX])),
    ) {
        let mut state = state;
        state.clip_planes[0] = plane.map(Vec4::from);
        let mut target = Target::new(size.0, size.1, ColorFormat::A8R8G8B8).unwrap();
        let shaded = Vertices::from(&vertices[..]);
        let call = DrawCall {
            viewport: Viewport { x: viewport.0, y: viewport.1, width: viewport.2, height: viewport.3, ..Viewport::full(0, 0) },
            ..call(&state, topology, &shaded)
        };
        // Positions, depths and w are numbers for helpers too.
        let shader = paint(|batch: &PixelBatch, lane| {
            assert!(batch.z[lane].is_finite() && batch.w[lane].is_finite() && batch.w[lane] > 0.0);
            assert!(batch.diffuse.iter().all(|c| (0.0..=1.0).contains(&c[lane])));
            assert!((0.0..=1.0).contains(&batch.fog[lane]));
            diffuse(batch, lane)
        });
        let statistics = draw(&mut target, &call, &shader).unwrap();
        prop_assert!(statistics.written <= statistics.shaded);
        let found = cover(&call, size, (size.0 / 2, size.1 / 2)).unwrap().count();
        prop_assert!(found as u64 <= 3 * statistics.primitives);
    }

    /// Testing depth early or late is the same picture.
    #[test]
    fn early_and_late_depth_agree(
        vertices in prop::collection::vec(sane_vertex(), 3..60),
        state in any_state(),
    ) {
        let picture = |may_kill: bool| {
            let mut target = target();
            let shader = Paint { color: diffuse, may_kill };
            draw(&mut target, &call(&state, Topology::TriangleList, &Vertices::from(&vertices[..])), &shader).unwrap();
            contents(&target)
        };
        prop_assert!(picture(false) == picture(true));
    }

    /// One draw call of many triangles is many draw calls of one.
    #[test]
    fn drawing_order_is_kept(
        vertices in prop::collection::vec(sane_vertex(), 3..60),
        state in any_state(),
        may_kill in any::<bool>(),
    ) {
        let color = |batch: &PixelBatch, lane: usize| {
            // Coordinates of 0 to 10 stay numbers beside the triangle too.
            assert!(batch.texcoords.iter().flatten().all(|component| component[lane].is_finite()));
            diffuse(batch, lane)
        };
        let shader = Paint { color, may_kill };
        let mut together = target();
        draw(&mut together, &call(&state, Topology::TriangleList, &Vertices::from(&vertices[..])), &shader).unwrap();
        let mut apart = target();
        for triangle in vertices.chunks_exact(3) {
            draw(&mut apart, &call(&state, Topology::TriangleList, &Vertices::from(triangle)), &shader).unwrap();
        }
        prop_assert!(contents(&together) == contents(&apart));
    }

    /// What `cover` says of a pixel is what `draw` does there.
    #[test]
    fn cover_agrees_with_draw(
        vertices in prop::collection::vec(sane_vertex(), 3..30),
        topology in prop::sample::select(Topology::ALL),
        pixel in (0..16_u32, 0..16_u32),
    ) {
        let state = open();
        let shaded = Vertices::from(&vertices[..]);
        let call = call(&state, topology, &shaded);
        let mut drawn = target();
        let coordinate = |batch: &PixelBatch, lane: usize| batch.texcoords[5].map(|c| c[lane] / 10.0);
        draw(&mut drawn, &call, &paint(coordinate)).unwrap();
        let last = cover(&call, (16, 16), pixel).unwrap().last();
        let expected = last.map_or([0; 4], |fragment| {
            coordinate(&fragment.batch, fragment.lane).map(|v| (v * 255.0).round_ties_even() as u8)
        });
        prop_assert_eq!(drawn.color(pixel.0, pixel.1), Some(expected));
        let mut counted = target();
        let counting = counting();
        let call = DrawCall { state: &counting, ..call };
        draw(&mut counted, &call, &tally()).unwrap();
        let count = cover(&call, (16, 16), pixel).unwrap().count();
        prop_assert_eq!(counted.color(pixel.0, pixel.1).map(|c| usize::from(c[0])), Some(count));
    }
}

#[test]
fn errors_are_told_and_draw_nothing() {
    let state = open();
    let vertices = everywhere(on(0.0, 0.0));
    let mut target = target();
    let before = contents(&target);
    let shaded = Vertices::from(&vertices[..]);
    let wrong = DrawCall {
        indices: Some(&[0, 1, 2, 0, 1, 7]),
        ..call(&state, Topology::TriangleList, &shaded)
    };
    assert_eq!(
        draw(&mut target, &wrong, &tally()).unwrap_err().to_string(),
        "index 7 at position 5 is outside the 3 vertices"
    );
    let shaded = Vertices::from(&vertices[..]);
    let wrong = DrawCall {
        viewport: Viewport {
            min_z: f32::NAN,
            ..Viewport::full(16, 16)
        },
        ..call(&state, Topology::TriangleList, &shaded)
    };
    assert!(draw(&mut target, &wrong, &tally()).is_err());
    assert!(cover(&wrong, (16, 16), (0, 0)).is_err());
    assert!(contents(&target) == before);
}

#[test]
fn many_large_triangles_in_bounded_lists() {
    // Each of the triangles, more than are set up at a time, covers all six pixels.
    let state = counting();
    let one = everywhere(on(0.0, 0.0));
    let indices: Vec<u32> = (0..100_000_u32).flat_map(|_| [0, 1, 2]).collect();
    let mut target = Target::new(3, 2, ColorFormat::A8R8G8B8).unwrap();
    let shaded = Vertices::from(&one[..]);
    let call = DrawCall {
        indices: Some(&indices),
        ..call(&state, Topology::TriangleList, &shaded)
    };
    let statistics = draw(&mut target, &call, &tally()).unwrap();
    assert_eq!(statistics.drawn, 100_000);
    assert_eq!(statistics.written, 600_000);
}

#[cfg(feature = "parallel")]
#[test]
fn the_number_of_cores_changes_nothing() {
    // More triangles than are set up at a time, about as large as a tile, drawn over each other.
    let mut seed = 1_u32;
    let mut next = move || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (seed >> 8) as f32 / (1 << 24) as f32
    };
    let mut vertices = Vec::new();
    for _ in 0..17_000 {
        let (x, y) = (next() * 2.4 - 1.2, next() * 2.4 - 1.2);
        vertices.extend([(); 3].map(|()| Vertex {
            position: vec4(x + next() * 0.5, y + next() * 0.5, next(), 1.0) * (0.5 + next()),
            diffuse: vec4(next(), next(), next(), next()),
            ..Vertex::default()
        }));
    }
    let mut state = open();
    state.blend = BlendState {
        enable: true,
        source: BlendFactor::SrcAlpha,
        destination: BlendFactor::InvSrcAlpha,
        op: BlendOp::Add,
    };
    let picture = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| {
            let mut target = Target::new(150, 90, ColorFormat::A8R8G8B8).unwrap();
            let shaded = Vertices::from(&vertices[..]);
            let call = DrawCall {
                viewport: Viewport::full(150, 90),
                ..call(&state, Topology::TriangleList, &shaded)
            };
            let statistics = draw(&mut target, &call, &paint(diffuse)).unwrap();
            (contents(&target), statistics)
        })
    };
    assert!(picture(1) == picture(5));
}

//! How a pixel's inputs follow from those of the vertices, as a debugger is told.

use std::collections::HashMap;
use std::sync::Mutex;

use proptest::prelude::*;

use super::*;

fn fragments(
    state: &RenderState,
    topology: Topology,
    vertices: &[Vertex],
    pixel: (u32, u32),
) -> Vec<Fragment> {
    let shaded = Vertices::from(vertices);
    let call = call(state, topology, &shaded);
    cover(&call, (16, 16), pixel).unwrap().collect()
}

fn place(x: f32, y: f32, z: f32, w: f32) -> Option<ScreenPosition> {
    Some(ScreenPosition { x, y, z, w })
}

#[test]
fn shares_and_places_by_hand() {
    let triangle = [
        at(0.0, 0.0, 0.0, 1.0),
        at(16.0, 0.0, 1.0, 3.0),
        at(0.0, 16.0, 0.25, 1.0),
    ];
    let found = fragments(&open(), Topology::TriangleList, &triangle, (8, 0));
    let [fragment] = found.as_slice() else {
        panic!("{found:?}");
    };
    assert_eq!(
        (fragment.primitive, fragment.part, fragment.lane),
        (0, 0, 0)
    );
    let told = fragment.interpolation;
    assert_eq!(told.vertices, [0, 1, 2]);
    assert_eq!((told.provoking, told.sprite), (None, false));
    // Half way on the screen between w = 1 and w = 3: (1/2 · 1/3) / (1/2 · 1 + 1/2 · 1/3) = 1/4.
    assert!((told.shares[0][0] - 0.25).abs() < 1e-6);
    assert_eq!(told.shares[1][0], 0.0);
    // One to the right: (9/16 · 1/3) / (7/16 + 9/16 · 1/3) = 3/10. One down: of the third 1/16 over 7/16 + 1/2 · 1/3 + 1/16.
    assert!((told.shares[0][1] - 0.3).abs() < 1e-6);
    assert!((told.shares[1][2] - 0.0625 / (2.0 / 3.0)).abs() < 1e-6);
    assert_eq!(
        fragment.screen,
        [
            place(0.0, 0.0, 0.0, 1.0),
            place(16.0, 0.0, 1.0, 3.0),
            place(0.0, 16.0, 0.25, 1.0)
        ]
    );
    // Row 0 reaches column 15, row 1 column 14.
    assert_eq!(fragment.helpers(), [false; 4]);
    let found = fragments(&open(), Topology::TriangleList, &triangle, (14, 1));
    assert_eq!(found[0].helpers(), [false, false, false, true]);
}

#[test]
fn places_are_rounded_and_cut_vertices_have_none() {
    // 3.001 · 8192 = 24584.19, which is 24584; 7.003 · 8192 = 57368.58, which is 57369. The third is before the near plane.
    let triangle = [on(3.001, 7.003), on(15.0, 0.0), at(15.0, 15.0, -0.5, 1.0)];
    let found = fragments(&open(), Topology::TriangleList, &triangle, (10, 4));
    assert_eq!(
        found[0].screen,
        [
            place(24584.0 / 8192.0, 57369.0 / 8192.0, 0.5, 1.0),
            place(15.0, 0.0, 0.5, 1.0),
            None
        ]
    );
    // A line repeats its second vertex, a point its only one.
    let found = fragments(
        &open(),
        Topology::LineList,
        &[on(2.0, 4.0), on(8.0, 4.0)],
        (5, 4),
    );
    let end = place(8.0, 4.0, 0.5, 1.0);
    assert_eq!(found[0].screen, [place(2.0, 4.0, 0.5, 1.0), end, end]);
    let found = fragments(&open(), Topology::PointList, &[on(5.0, 4.0)], (5, 4));
    assert_eq!(found[0].screen, [place(5.0, 4.0, 0.5, 1.0); 3]);
}

#[test]
fn small_parts_of_a_pixel_count() {
    // u is 0 at x = 1/1024 and 1 sixteen pixels further: at column 8 it is (8 - 1/1024) / 16, which is less than 1/2 by
    // 2⁻¹⁴.
    let shift = 1.0 / 1024.0;
    let mut triangle = [on(shift, 0.0), on(16.0 + shift, 0.0), on(shift, 16.0)];
    triangle[1].texcoords[0] = Vec4::X;
    let found = fragments(&open(), Topology::TriangleList, &triangle, (8, 0));
    let u = found[0].batch.texcoords[0][0][found[0].lane];
    assert!((u - (0.5 - 1.0 / 16384.0)).abs() < 1e-6, "{u}");
    // Column 0 lies before the left edge.
    let beside = fragments(&open(), Topology::TriangleList, &triangle, (0, 0));
    assert_eq!(beside, []);
}

#[test]
fn edges_that_meet_are_parts_of_one_primitive() {
    let mut state = open();
    state.fill = FillMode::Point;
    state.point.size = 8.0;
    let triangle = [on(4.0, 4.0), on(6.0, 4.0), on(14.0, 14.0)];
    // The squares around the first two corners overlap.
    let found = fragments(&state, Topology::TriangleList, &triangle, (5, 5));
    let told: Vec<_> = (found.iter())
        .map(|f| (f.primitive, f.part, f.vertices, f.interpolation.vertices))
        .collect();
    assert_eq!(told, [(0, 0, [0, 1, 2], [0; 3]), (0, 1, [0, 1, 2], [1; 3])]);
}

fn any_vertex() -> impl Strategy<Value = Vertex> {
    (
        (
            -20.0_f32..36.0,
            -20.0_f32..36.0,
            -0.2_f32..1.2,
            0.1_f32..10.0,
        ),
        prop::array::uniform8(prop::array::uniform4(-10.0_f32..10.0)),
        prop::array::uniform4(-0.5_f32..1.5),
        prop::option::of(0.0_f32..12.0),
    )
        .prop_map(|((x, y, z, w), sets, color, point_size)| Vertex {
            texcoords: sets.map(Vec4::from),
            diffuse: color.into(),
            specular: Vec4::from(color) * 0.5,
            fog: color[0],
            point_size,
            ..at(x, y, z, w)
        })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// What the documentation of [`Interpolation`] says, to the bit.
    #[test]
    fn inputs_follow_from_what_is_told(
        vertices in prop::collection::vec(any_vertex(), 3..12),
        topology in prop::sample::select(Topology::ALL),
        fill in prop::sample::select(FillMode::ALL),
        shade in prop::sample::select(ShadeMode::ALL),
        sprite in any::<bool>(),
        pixel in (0..16_u32, 0..16_u32),
    ) {
        let mut state = RenderState { fill, shade, ..open() };
        state.point.sprite = sprite;
        for fragment in fragments(&state, topology, &vertices, pixel) {
            let Interpolation { vertices: of, provoking, sprite, shares: [s1, s2] } = fragment.interpolation;
            let corners = of.map(|index| vertices[index as usize]);
            let mixed = |[a0, a1, a2]: [f32; 3], i: usize| a0 + s1[i] * (a1 - a0) + s2[i] * (a2 - a0);
            for i in 0..4 {
                for set in 0..8 {
                    let expected = match sprite {
                        true => [s1[i], s2[i], 0.0, 0.0],
                        false => std::array::from_fn(|c| mixed(corners.map(|v| v.texcoords[set][c]), i)),
                    };
                    let got = fragment.batch.texcoords[set].map(|component| component[i]);
                    prop_assert_eq!(got.map(f32::to_bits), expected.map(f32::to_bits));
                }
                for (got, color) in [
                    (&fragment.batch.diffuse, (|v| v.diffuse) as fn(Vertex) -> Vec4),
                    (&fragment.batch.specular, |v| v.specular),
                ] {
                    let ends = match provoking {
                        Some(index) => [vertices[index as usize]; 3],
                        None => corners,
                    };
                    let expected: [f32; 4] =
                        std::array::from_fn(|c| unit(mixed(ends.map(|v| unit(color(v)[c])), i)));
                    let got = got.map(|component| component[i]);
                    prop_assert_eq!(got.map(f32::to_bits), expected.map(f32::to_bits));
                }
                let expected = unit(mixed(corners.map(|v| fog_unit(v.fog)), i));
                prop_assert_eq!(fragment.batch.fog[i].to_bits(), expected.to_bits());
            }
            prop_assert_eq!(provoking.is_some(), shade == ShadeMode::Flat);
            prop_assert!(!fragment.helpers()[fragment.lane]);
        }
    }
}

/// Writes down the bits of all inputs of the pixels it is given, and how many blocks there were.
#[derive(Default)]
struct Notes(Mutex<(Noted, usize)>);

/// By pixel.
type Noted = HashMap<(i32, i32), Vec<u32>>;

fn inputs_of(batch: &PixelBatch, lane: usize) -> Vec<u32> {
    let attributes = [&batch.diffuse, &batch.specular].into_iter();
    let rows = attributes.chain(&batch.texcoords).flatten();
    let rows = rows.chain([&batch.z, &batch.w, &batch.fog]);
    rows.map(|row| row[lane].to_bits()).collect()
}

impl PixelShader for Notes {
    fn inputs(&self) -> PixelInputs {
        PixelInputs::ALL
    }

    fn shade(&self, batch: &PixelBatch, _: &mut PixelResult) {
        let mut notes = self.0.lock().unwrap();
        notes.1 += usize::from(batch.block);
        for lane in (0..4 * batch.quads).filter(|lane| batch.live[*lane]) {
            let place = (batch.x[lane], batch.y[lane]);
            assert_eq!(notes.0.insert(place, inputs_of(batch, lane)), None);
        }
    }
}

proptest! {
    /// A debugger works out a quad, `draw` whole blocks.
    #[test]
    fn blocks_have_the_bits_of_quads(
        moved in prop::array::uniform3((-20.0_f32..0.0, -20.0_f32..0.0, 0.0_f32..1.0, 0.1_f32..10.0)),
        attributes in prop::array::uniform3(prop::array::uniform4(-3.0_f32..3.0)),
        flat in any::<bool>(),
    ) {
        let beyond = [(0.0, 0.0), (80.0, 0.0), (0.0, 80.0)];
        let vertices: [Vertex; 3] = std::array::from_fn(|i| {
            let ((x, y, z, w), attribute) = (moved[i], attributes[i]);
            Vertex {
                diffuse: attribute.into(),
                specular: (Vec4::from(attribute) / 3.0),
                texcoords: std::array::from_fn(|set| Vec4::from(attribute) * set as f32),
                fog: attribute[0],
                ..at(x + beyond[i].0, y + beyond[i].1, z, w)
            }
        });
        let state = RenderState {
            shade: if flat { ShadeMode::Flat } else { ShadeMode::Gouraud },
            fog: FogState { enable: true, ..FogState::default() },
            ..open()
        };
        let (shaded, notes) = (Vertices::from(&vertices[..]), Notes::default());
        draw(&mut target(), &call(&state, Topology::TriangleList, &shaded), &notes).unwrap();
        let (noted, blocks) = notes.0.into_inner().unwrap();
        // 16×16 pixels, all of them covered.
        prop_assert_eq!((noted.len(), blocks), (256, 4));
        for (x, y) in (0..256).map(|at| (at % 16, at / 16)) {
            let found = fragments(&state, Topology::TriangleList, &vertices, (x, y));
            let [fragment] = found.as_slice() else {
                panic!("{found:?}");
            };
            let expected = inputs_of(&fragment.batch, fragment.lane);
            prop_assert_eq!(&noted[&(x as i32, y as i32)], &expected);
        }
    }
}

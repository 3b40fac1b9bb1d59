//! What the merger tells of a pixel.

use proptest::prelude::*;

use super::*;

/// A shader of one colour and, if it gives one, depth.
struct Shader {
    color: [f32; 4],
    depth: Option<f32>,
    kills: fn(i32, i32) -> bool,
}

impl PixelShader for Shader {
    fn inputs(&self) -> PixelInputs {
        PixelInputs::ALL
    }

    fn shade(&self, batch: &PixelBatch, out: &mut PixelResult) {
        for lane in 0..4 * batch.quads {
            // The diffuse colour is 1 where nothing else is said.
            for (channel, value) in self.color.into_iter().enumerate() {
                out.color[channel][lane] = value * batch.diffuse[channel][lane];
            }
            out.depth[lane] = self.depth.unwrap_or_default();
            out.killed[lane] = (self.kills)(batch.x[lane], batch.y[lane]);
        }
    }

    fn writes_depth(&self) -> bool {
        self.depth.is_some()
    }
}

fn shader(color: [f32; 4]) -> Shader {
    Shader {
        color,
        depth: None,
        kills: |_, _| false,
    }
}

/// What the target of these tests holds.
const HOLDS: Stored = Stored {
    color: [0, 100, 200, 40],
    depth: 0.5,
    stencil: 0xf0,
};

/// The record of a pixel of depth 0.25 and w 2, with a fog factor of 0.25 at the vertices.
fn merged(state: &RenderState, shader: &Shader) -> MergeRecord {
    let like = Vertex {
        fog: 0.25,
        ..at(0.0, 0.0, 0.25, 2.0)
    };
    let vertices = everywhere(like);
    let shaded = Vertices::from(&vertices[..]);
    let call = call(state, Topology::TriangleList, &shaded);
    let fragment = cover(&call, (16, 16), (3, 2)).unwrap().next().unwrap();
    let mut target = LoneTarget::new((3, 2), ColorFormat::A8R8G8B8, HOLDS).unwrap();
    let record = target.draw(state, &fragment, shader);
    assert_eq!((record.before, record.after), (HOLDS, target.holds()));
    record
}

#[test]
fn a_plain_pixel_is_limited_rounded_and_written() {
    let record = merged(&open(), &shader([2.0, f32::NAN, -1.0, 0.5]));
    let [r, g, b, a] = record.shaded;
    assert!(g.is_nan());
    assert_eq!([r, b, a], [2.0, -1.0, 0.5]);
    let limited = [1.0, 0.0, 0.0, 0.5];
    // 127.5, of which the even neighbour is 128.
    let bytes = [255, 0, 0, 128];
    let expected = MergeRecord {
        before: HOLDS,
        shaded: record.shaded,
        clamped: limited,
        write: Some(ColorWritten {
            color: limited,
            bytes,
            mask: ColorMask::ALL,
            written: [true; 4],
        }),
        after: Stored {
            color: bytes,
            ..HOLDS
        },
        ..MergeRecord::default()
    };
    // A record that holds a NaN is not equal to itself.
    assert_eq!(format!("{record:?}"), format!("{expected:?}"));
    assert_eq!(record.fate(), Fate::Written);
}

#[test]
fn texkill_ends_it() {
    let mut state = RenderState::default();
    state.alpha_test.enable = true;
    let killing = Shader {
        kills: |x, y| (x, y) == (3, 2),
        ..shader([0.25; 4])
    };
    let record = merged(&state, &killing);
    let expected = MergeRecord {
        before: HOLDS,
        shaded: [0.25; 4],
        clamped: [0.25; 4],
        killed: true,
        after: HOLDS,
        ..MergeRecord::default()
    };
    assert_eq!(record, expected);
    assert_eq!(record.fate(), Fate::Killed);
}

#[test]
fn the_alpha_test_fails_at_8_bits() {
    let mut state = RenderState {
        cull: CullMode::None,
        ..RenderState::default()
    };
    state.alpha_test = AlphaTest {
        enable: true,
        reference: 127,
        func: Compare::Less,
    };
    // 126.6 is less than 127, but 8 bits hold 127.
    let record = merged(&state, &shader([1.0, 1.0, 1.0, 126.6 / 255.0]));
    let tested = AlphaTested {
        alpha: 127,
        func: Compare::Less,
        reference: 127,
        passed: false,
    };
    assert_eq!(record.alpha_test, Some(tested));
    assert_eq!(record.fate(), Fate::AlphaTest);
    assert_eq!((record.depth, record.write), (None, None));
    assert_eq!(record.after, HOLDS);
    // 126.4 is 126 there.
    let record = merged(&state, &shader([1.0, 1.0, 1.0, 126.4 / 255.0]));
    let tested = AlphaTested {
        alpha: 126,
        passed: true,
        ..tested
    };
    assert_eq!(record.alpha_test, Some(tested));
    assert_eq!(record.fate(), Fate::Written);
}

#[test]
fn the_depth_test_of_the_primitive_and_of_the_shader() {
    let mut state = RenderState {
        cull: CullMode::None,
        ..RenderState::default()
    };
    let tested = DepthTested {
        incoming: 0.25,
        stored: 0.5,
        func: Compare::LessEqual,
        passed: true,
        write: true,
        after: 0.25,
    };
    let record = merged(&state, &shader([1.0; 4]));
    assert_eq!((record.depth, record.replaced_depth), (Some(tested), None));
    assert_eq!(record.after.depth, 0.25);
    state.depth.write = false;
    let record = merged(&state, &shader([1.0; 4]));
    let without = DepthTested {
        write: false,
        after: 0.5,
        ..tested
    };
    assert_eq!(record.depth, Some(without));
    state.depth.write = true;
    // 1.5 is 1 in a depth buffer, and lies behind what is there.
    let deep = Shader {
        depth: Some(1.5),
        ..shader([1.0; 4])
    };
    let record = merged(&state, &deep);
    let behind = DepthTested {
        incoming: 1.0,
        passed: false,
        after: 0.5,
        ..tested
    };
    assert_eq!(record.replaced_depth, Some(1.5));
    assert_eq!((record.depth, record.write), (Some(behind), None));
    assert_eq!(record.fate(), Fate::Depth);
    assert_eq!(record.after, HOLDS);
}

#[test]
fn the_stencil_test_and_the_operation_that_it_chose() {
    let mut state = RenderState {
        cull: CullMode::None,
        ..RenderState::default()
    };
    state.stencil = StencilState {
        enable: true,
        func: Compare::Equal,
        reference: 0x35,
        mask: 0x0f,
        write_mask: 0x3c,
        fail: StencilOp::Invert,
        depth_fail: StencilOp::Incr,
        pass: StencilOp::Replace,
    };
    // 5 is not 0. Turned over f0 is 0f; of that the bits 3c are 0c, and c0 stays.
    let tested = StencilTested {
        stored: 0xf0,
        reference: 0x35,
        mask: 0x0f,
        func: Compare::Equal,
        passed: false,
        op: StencilOp::Invert,
        write_mask: 0x3c,
        after: 0xcc,
    };
    let record = merged(&state, &shader([1.0; 4]));
    assert_eq!((record.stencil, record.depth), (Some(tested), None));
    assert_eq!(record.fate(), Fate::Stencil);
    let after = Stored {
        stencil: 0xcc,
        ..HOLDS
    };
    assert_eq!(record.after, after);
    // The bits f0 of both are 30 and f0: less. Of 35 the bits 3c are 34, with c0 f4.
    state.stencil.mask = 0xf0;
    state.stencil.func = Compare::Less;
    let passed = StencilTested {
        mask: 0xf0,
        func: Compare::Less,
        passed: true,
        op: StencilOp::Replace,
        after: 0xf4,
        ..tested
    };
    let record = merged(&state, &shader([1.0; 4]));
    assert_eq!(record.stencil, Some(passed));
    assert_eq!(record.fate(), Fate::Written);
    // With a depth test that fails it is one more: f1, of which the bits 3c are those that were there.
    state.depth.func = Compare::Greater;
    let failed = StencilTested {
        op: StencilOp::Incr,
        after: 0xf0,
        ..passed
    };
    let record = merged(&state, &shader([1.0; 4]));
    assert_eq!(record.stencil, Some(failed));
    assert_eq!(record.depth.map(|depth| depth.passed), Some(false));
    assert_eq!(record.fate(), Fate::Depth);
    // Without a depth test both pass.
    state.depth.enable = false;
    let record = merged(&state, &shader([1.0; 4]));
    assert_eq!((record.stencil, record.depth), (Some(passed), None));
}

#[test]
fn fog_of_every_mode() {
    let mut state = open();
    let mut fogged = |fog: FogState| {
        state.fog = FogState {
            enable: true,
            color: [0.0, 1.0, 2.0],
            ..fog
        };
        let record = merged(&state, &shader([1.0, 0.5, 0.0, 0.5]));
        assert_eq!(record.write.map(|write| write.color[3]), Some(0.5));
        record.fog.unwrap()
    };
    let base = FogState {
        end: 0.5,
        density: 2.0,
        ..FogState::default()
    };
    let table = |mode, kind, distance| FogSource::Table {
        mode,
        kind,
        distance,
    };
    // (0.5 - 0.25) / 0.5 is a half: 1/2 + 0; 1/4 + 1/2; 0 + 1/2, the colour of fog ending at 1.
    let linear = FogState {
        table: FogMode::Linear,
        ..base
    };
    let half = Fogged {
        source: table(FogMode::Linear, FogDistance::Z, 0.25),
        factor: 0.5,
        clear: 0.5,
        color: [0.0, 1.0, 1.0],
        before: [1.0, 0.5, 0.0],
        after: [0.5, 0.75, 0.5],
    };
    assert_eq!(fogged(linear), half);
    // (0.5 - 2) / 0.5 is -3: nothing but fog.
    let full = Fogged {
        source: table(FogMode::Linear, FogDistance::W, 2.0),
        factor: -3.0,
        clear: 0.0,
        after: [0.0, 1.0, 1.0],
        ..half
    };
    let by_w = FogState {
        distance: FogDistance::W,
        ..linear
    };
    assert_eq!(fogged(by_w), full);
    // A quarter of the pixel's own colour: 1/4; 1/8 + 3/4; 3/4.
    let vertex = Fogged {
        source: FogSource::Vertex,
        factor: 0.25,
        clear: 0.25,
        after: [0.25, 0.875, 0.75],
        ..half
    };
    assert_eq!(fogged(base), vertex);
    // e^-(1/4 · 2), e^-(1/4 · 2)², e^-(2 · 2).
    for (mode, kind, distance, factor) in [
        (FogMode::Exp, FogDistance::Z, 0.25, 0.606_530_66),
        (FogMode::Exp2, FogDistance::Z, 0.25, 0.778_800_8),
        (FogMode::Exp, FogDistance::W, 2.0, 0.018_315_64),
    ] {
        let fog = fogged(FogState {
            table: mode,
            distance: kind,
            ..base
        });
        assert_eq!(fog.source, table(mode, kind, distance));
        // The exponential function of the system may be off by a unit in the last place: 6e-8 below 1.
        assert!((fog.factor - factor).abs() <= 6e-8, "{mode}: {fog:?}");
        assert_eq!((fog.clear, fog.after[0]), (fog.factor, fog.factor));
    }
    let nan = fogged(FogState {
        table: FogMode::Exp,
        density: f32::NAN,
        ..base
    });
    assert!(nan.factor.is_nan());
    assert_eq!((nan.clear, nan.after), (1.0, nan.before));
}

#[test]
fn blending_with_the_factors_that_count() {
    let mut state = open();
    state.blend = BlendState {
        enable: true,
        source: BlendFactor::SrcAlpha,
        destination: BlendFactor::InvSrcAlpha,
        op: BlendOp::Add,
    };
    let source = [1.0, 0.0, 0.5, 0.25];
    let record = merged(&state, &shader(source));
    let blend = record.blend.unwrap();
    assert_eq!(blend.source, source);
    assert_eq!(blend.target, [0.0, 100.0, 200.0, 40.0].map(|c| c / 255.0));
    let weight = |factor, value| BlendWeight {
        factor,
        value: [value; 4],
    };
    assert_eq!(
        blend.weights,
        Some([
            weight(BlendFactor::SrcAlpha, 0.25),
            weight(BlendFactor::InvSrcAlpha, 0.75),
        ])
    );
    assert_eq!(blend.op, BlendOp::Add);
    assert_eq!(blend.result[0], 0.25);
    // 63.75; 75; 31.875 + 150; 15.9375 + 30.
    let write = record.write.unwrap();
    assert_eq!(write.color, blend.result);
    assert_eq!(write.bytes, [64, 75, 182, 46]);
    assert_eq!(record.after.color, write.bytes);
    // One factor that stands for two, whatever the other says.
    state.blend.source = BlendFactor::BothInvSrcAlpha;
    let blend = merged(&state, &shader(source)).blend.unwrap();
    assert_eq!(
        blend.weights,
        Some([
            weight(BlendFactor::InvSrcAlpha, 0.75),
            weight(BlendFactor::SrcAlpha, 0.25),
        ])
    );
    assert_eq!(blend.result[0], 0.75);
    state.blend.op = BlendOp::Max;
    let record = merged(&state, &shader(source));
    assert_eq!(record.blend.and_then(|blend| blend.weights), None);
    // The greater of 0.5 and 200/255.
    assert_eq!(record.after.color, [255, 100, 200, 64]);
}

#[test]
fn the_mask_and_the_format_say_which_channels_are_written() {
    let mut state = open();
    // Red, blue and alpha.
    state.color_mask = ColorMask::from_bits(0b1101);
    let record = merged(&state, &shader([1.0; 4]));
    let write = record.write.unwrap();
    assert_eq!(write.mask, state.color_mask);
    assert_eq!(write.written, [true, false, true, true]);
    assert_eq!(write.bytes, [255; 4]);
    assert_eq!(record.after.color, [255, 100, 255, 255]);
    // What has no alpha channel holds 255 there.
    let vertices = everywhere(on(0.0, 0.0));
    let state = open();
    let shaded = Vertices::from(&vertices[..]);
    let call = call(&state, Topology::TriangleList, &shaded);
    let fragment = cover(&call, (16, 16), (3, 2)).unwrap().next().unwrap();
    let mut target = LoneTarget::new((3, 2), ColorFormat::X8R8G8B8, HOLDS).unwrap();
    let record = target.draw(&state, &fragment, &shader([0.0; 4]));
    assert_eq!(record.before.color, [0, 100, 200, 255]);
    let written = record.write.map(|write| write.written);
    assert_eq!(written, Some([true, true, true, false]));
    assert_eq!(record.after.color, [0, 0, 0, 255]);
}

fn fraction() -> impl Strategy<Value = f32> {
    prop_oneof![
        8 => -0.2_f32..1.2,
        1 => prop::sample::select(vec![0.0, 1.0, 0.5, f32::NAN, f32::INFINITY, -1e30]),
    ]
}

fn any_depth_and_stencil() -> impl Strategy<Value = (DepthState, StencilState)> {
    let compare = || prop::sample::select(Compare::ALL);
    let op = || prop::sample::select(StencilOp::ALL);
    let depth = (any::<bool>(), any::<bool>(), compare());
    let stencil = (
        any::<bool>(),
        compare(),
        any::<[u8; 3]>(),
        (op(), op(), op()),
    );
    (depth, stencil).prop_map(|(depth, stencil)| {
        let depth = DepthState {
            enable: depth.0,
            write: depth.1,
            func: depth.2,
            bias: 0,
        };
        let [reference, mask, write_mask] = stencil.2;
        let (fail, depth_fail, pass) = stencil.3;
        let stencil = StencilState {
            enable: stencil.0,
            func: stencil.1,
            reference,
            mask,
            write_mask,
            fail,
            depth_fail,
            pass,
        };
        (depth, stencil)
    })
}

fn any_fog() -> impl Strategy<Value = FogState> {
    (
        any::<bool>(),
        prop::array::uniform3(fraction()),
        prop::sample::select(FogMode::ALL),
        prop::sample::select(FogDistance::ALL),
        prop::array::uniform3(fraction()),
    )
        .prop_map(
            |(enable, color, table, distance, [start, end, density])| FogState {
                enable,
                color,
                table,
                distance,
                start,
                end,
                density,
            },
        )
}

fn any_merging() -> impl Strategy<Value = RenderState> {
    let factor = || prop::sample::select(BlendFactor::ALL);
    let blend = (
        any::<bool>(),
        factor(),
        factor(),
        prop::sample::select(BlendOp::ALL),
    );
    let alpha = (
        any::<bool>(),
        any::<u8>(),
        prop::sample::select(Compare::ALL),
    );
    (
        any_depth_and_stencil(),
        any_fog(),
        blend,
        alpha,
        any::<u8>(),
    )
        .prop_map(|((depth, stencil), fog, blend, alpha, mask)| RenderState {
            cull: CullMode::None,
            depth,
            stencil,
            fog,
            blend: BlendState {
                enable: blend.0,
                source: blend.1,
                destination: blend.2,
                op: blend.3,
            },
            alpha_test: AlphaTest {
                enable: alpha.0,
                reference: alpha.1,
                func: alpha.2,
            },
            color_mask: ColorMask::from_bits(mask),
            ..RenderState::default()
        })
}

fn any_triangle() -> impl Strategy<Value = Vec<Vertex>> {
    let vertex = (
        (-9.0_f32..25.0, -9.0_f32..25.0, -0.1_f32..1.1, 0.2_f32..3.0),
        prop::array::uniform4(fraction()),
        fraction(),
    );
    let vertex = vertex.prop_map(|((x, y, z, w), diffuse, fog)| Vertex {
        diffuse: diffuse.into(),
        fog,
        ..at(x, y, z, w)
    });
    prop::collection::vec(vertex, 6)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// Several draws with any states: each pixel's records end in what the frame holds, to the bit, and as many of them
    /// tell of pixels that were written as the frame has.
    #[test]
    fn records_are_what_is_drawn(
        draws in prop::collection::vec(
            (any_merging(), any_triangle(), prop::array::uniform4(fraction()), prop::option::of(fraction()), any::<bool>()),
            1..4,
        ),
        clear in (any::<[u8; 4]>(), 0.0_f32..=1.0, any::<u8>()),
        alpha in any::<bool>(),
    ) {
        let format = if alpha { ColorFormat::A8R8G8B8 } else { ColorFormat::X8R8G8B8 };
        let holds = Stored { color: clear.0, depth: clear.1, stencil: clear.2 };
        let draws: Vec<(RenderState, Vec<Vertex>, Shader)> = draws
            .into_iter()
            .map(|(state, vertices, color, depth, kills)| {
                let kills: fn(i32, i32) -> bool = if kills { |x, y| (x + y) % 3 == 0 } else { |_, _| false };
                (state, vertices, Shader { color, depth, kills })
            })
            .collect();
        let mut frame = Target::new(16, 16, format).unwrap();
        frame.clear(Some(holds.color), Some(holds.depth), Some(holds.stencil));
        let mut written = 0;
        for (state, vertices, shader) in &draws {
            let shaded = Vertices::from(&vertices[..]);
            let call = call(state, Topology::TriangleList, &shaded);
            written += draw(&mut frame, &call, shader).unwrap().written;
        }
        for (x, y) in (0..16).flat_map(|y| (0..16).map(move |x| (x, y))) {
            let mut lone = LoneTarget::new((x, y), format, holds).unwrap();
            for (state, vertices, shader) in &draws {
                let shaded = Vertices::from(&vertices[..]);
                let call = call(state, Topology::TriangleList, &shaded);
                for fragment in cover(&call, (16, 16), (x, y)).unwrap() {
                    let before = lone.holds();
                    let record = lone.draw(state, &fragment, shader);
                    consistent(&record, state)?;
                    prop_assert_eq!((record.before, record.after), (before, lone.holds()));
                    written -= u64::from(record.fate() == Fate::Written);
                }
            }
            let Stored { color, depth, stencil } = lone.holds();
            prop_assert_eq!(Some(color), frame.color(x, y));
            prop_assert_eq!(Some(depth.to_bits()), frame.depth(x, y).map(f32::to_bits));
            prop_assert_eq!(Some(stencil), frame.stencil(x, y));
        }
        prop_assert_eq!(written, 0);
    }
}

/// What a record says of its stages makes up what it says of the whole.
fn consistent(record: &MergeRecord, state: &RenderState) -> Result<(), TestCaseError> {
    let MergeRecord { before, after, .. } = record;
    let color = match record.write {
        Some(write) => std::array::from_fn(|channel| match write.written[channel] {
            true => write.bytes[channel],
            false => before.color[channel],
        }),
        None => before.color,
    };
    prop_assert_eq!(after.color, color);
    let depth = record.depth.map_or(before.depth, |depth| depth.after);
    prop_assert_eq!(after.depth.to_bits(), depth.to_bits());
    let stencil = record
        .stencil
        .map_or(before.stencil, |stencil| stencil.after);
    prop_assert_eq!(after.stencil, stencil);
    // What comes last before the write is what is written.
    let [r, g, b, a] = record.clamped;
    let [r, g, b] = record.fog.map_or([r, g, b], |fog| fog.after);
    let last = record.blend.map_or([r, g, b, a], |blend| blend.result);
    if let Some(write) = record.write {
        prop_assert_eq!(write.color.map(f32::to_bits), last.map(f32::to_bits));
    }
    let passed = record.fate() == Fate::Written;
    prop_assert_eq!(record.write.is_some(), passed);
    prop_assert_eq!(record.fog.is_some(), passed && state.fog.enable);
    prop_assert_eq!(record.blend.is_some(), passed && state.blend.enable);
    prop_assert_eq!(
        record.alpha_test.is_some(),
        !record.killed && state.alpha_test.enable
    );
    Ok(())
}

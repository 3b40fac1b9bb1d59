//! What is done with shaded pixels.

use super::*;

/// Draws one colour over all of a target.
fn fill(target: &mut Target, state: &RenderState, z: f32, color: [f32; 4]) -> Statistics {
    let vertices = everywhere(at(0.0, 0.0, z, 1.0));
    draw(
        target,
        &call(
            state,
            Topology::TriangleList,
            &Vertices::from(&vertices[..]),
        ),
        &paint(move |_, _| color),
    )
    .unwrap()
}

fn depth_on() -> RenderState {
    RenderState {
        cull: CullMode::None,
        ..RenderState::default()
    }
}

#[test]
fn colours_are_limited_and_rounded_to_8_bits() {
    let mut target = target();
    fill(&mut target, &open(), 0.5, [f32::NAN, 2.0, -1.0, 0.5]);
    // 0.5 · 255 = 127.5, of which the even neighbour is 128.
    assert_eq!(target.color(5, 5), Some([0, 255, 0, 128]));
    fill(
        &mut target,
        &open(),
        0.5,
        [126.6 / 255.0, 127.4 / 255.0, f32::INFINITY, 254.6 / 255.0],
    );
    assert_eq!(target.color(5, 5), Some([127, 127, 255, 255]));
}

#[test]
fn every_depth_comparison() {
    // Stored is 0.5; then whether 0.25, 0.5 and 0.75 pass.
    for (func, expected) in [
        (Compare::Never, [false, false, false]),
        (Compare::Less, [true, false, false]),
        (Compare::Equal, [false, true, false]),
        (Compare::LessEqual, [true, true, false]),
        (Compare::Greater, [false, false, true]),
        (Compare::NotEqual, [true, false, true]),
        (Compare::GreaterEqual, [false, true, true]),
        (Compare::Always, [true, true, true]),
    ] {
        for (z, passes) in [0.25, 0.5, 0.75].into_iter().zip(expected) {
            let mut state = depth_on();
            state.depth.func = func;
            let mut target = target();
            target.clear(None, Some(0.5), None);
            let statistics = fill(&mut target, &state, z, [1.0; 4]);
            assert_eq!(statistics.written == 256, passes, "{func} {z}");
            assert_eq!(target.depth(3, 3), Some(if passes { z } else { 0.5 }));
            state.depth.write = false;
            target.clear(None, Some(0.5), None);
            fill(&mut target, &state, z, [1.0; 4]);
            assert_eq!(target.depth(3, 3), Some(0.5));
        }
    }
    let mut state = depth_on();
    state.depth.enable = false;
    let mut target = target();
    target.clear(None, Some(0.1), None);
    assert_eq!(fill(&mut target, &state, 0.9, [1.0; 4]).written, 256);
    assert_eq!(target.depth(3, 3), Some(0.1));
}

#[test]
fn the_alpha_test_sees_8_bits() {
    let mut state = depth_on();
    state.alpha_test = AlphaTest {
        enable: true,
        reference: 127,
        func: Compare::Equal,
    };
    let mut written = |alpha: f32, func: Compare| {
        state.alpha_test.func = func;
        let mut target = target();
        let written = fill(&mut target, &state, 0.5, [0.0, 0.0, 0.0, alpha / 255.0]).written;
        // What fails leaves no depth either.
        assert_eq!(
            target.depth(0, 0),
            Some(if written > 0 { 0.5 } else { 1.0 })
        );
        written == 256
    };
    assert!(written(127.4, Compare::Equal));
    assert!(written(126.6, Compare::Equal));
    assert!(!written(127.6, Compare::Equal));
    assert!(!written(126.4, Compare::GreaterEqual));
    assert!(written(126.6, Compare::GreaterEqual));
    assert!(!written(127.4, Compare::Greater));
    assert!(!written(255.0, Compare::Never));
    assert!(written(0.0, Compare::NotEqual));
}

#[test]
fn the_colour_mask_spares_channels() {
    for bits in 0..16_u8 {
        let mut state = open();
        state.color_mask = ColorMask::from_bits(bits);
        let mut target = target();
        target.clear(Some([10, 20, 30, 40]), None, None);
        fill(&mut target, &state, 0.5, [1.0; 4]);
        let expected = [(1, 10), (2, 20), (4, 30), (8, 40)]
            .map(|(bit, old)| if bits & bit != 0 { 255 } else { old });
        assert_eq!(target.color(0, 0), Some(expected));
    }
}

#[test]
fn blending_reads_the_target() {
    let mut state = open();
    state.blend = BlendState {
        enable: true,
        source: BlendFactor::SrcAlpha,
        destination: BlendFactor::InvSrcAlpha,
        op: BlendOp::Add,
    };
    let mut target = target();
    target.clear(Some([0, 100, 200, 40]), None, None);
    fill(&mut target, &state, 0.5, [1.0, 0.0, 0.0, 0.25]);
    // 255/4 = 63.75; 75; 150; alpha 1/4 · 1/4 · 255 + 3/4 · 40 = 15.9375 + 30.
    assert_eq!(target.color(0, 0), Some([64, 75, 150, 46]));
    // Without alpha the target's alpha is 1, and stays it.
    let mut opaque = Target::new(16, 16, ColorFormat::X8R8G8B8).unwrap();
    opaque.clear(Some([255, 0, 0, 0]), None, None);
    state.blend.source = BlendFactor::Zero;
    state.blend.destination = BlendFactor::DestAlpha;
    fill(&mut opaque, &state, 0.5, [0.0; 4]);
    assert_eq!(opaque.color(0, 0), Some([255, 0, 0, 255]));
}

#[test]
fn table_fog_by_hand() {
    // White with alpha 0.5 in black fog: what is left is the factor. Depth 0.25, w 2.
    let fogged = |fog: FogState| {
        let state = RenderState { fog, ..open() };
        let vertices = [(0.0, 0.0), (40.0, 0.0), (0.0, 40.0)].map(|(x, y)| at(x, y, 0.25, 2.0));
        let mut target = target();
        let shader = paint(|_, _| [1.0, 1.0, 1.0, 0.5]);
        draw(
            &mut target,
            &call(
                &state,
                Topology::TriangleList,
                &Vertices::from(&vertices[..]),
            ),
            &shader,
        )
        .unwrap();
        let [r, _, _, a] = target.color(7, 7).unwrap();
        assert_eq!(a, 128);
        r
    };
    let fog = FogState {
        enable: true,
        start: 0.0,
        end: 0.5,
        density: 2.0,
        ..FogState::default()
    };
    let table = |table, distance| FogState {
        table,
        distance,
        ..fog
    };
    // (0.5 - 0.25) / 0.5 = 0.5.
    assert_eq!(fogged(table(FogMode::Linear, FogDistance::Z)), 128);
    // e^-0.5 = 0.60653, times 255 is 154.67.
    assert_eq!(fogged(table(FogMode::Exp, FogDistance::Z)), 155);
    // e^-0.25 = 0.77880, times 255 is 198.59.
    assert_eq!(fogged(table(FogMode::Exp2, FogDistance::Z)), 199);
    // e^-4 = 0.018316, times 255 is 4.67.
    assert_eq!(fogged(table(FogMode::Exp, FogDistance::W)), 5);
    // Both ends in one place: clear before it, full from there on.
    let step = |end| FogState {
        start: end,
        end,
        ..table(FogMode::Linear, FogDistance::Z)
    };
    assert_eq!(fogged(step(0.5)), 255);
    assert_eq!(fogged(step(0.25)), 0);
    // Not a number is clear.
    let nan = FogState {
        density: f32::NAN,
        ..table(FogMode::Exp, FogDistance::Z)
    };
    assert_eq!(fogged(nan), 255);
}

#[test]
fn vertex_fog_goes_to_the_fog_colour() {
    let mut state = open();
    state.fog.enable = true;
    state.fog.color = [0.0, 1.0, 0.0];
    let picture = |factor: f32| {
        let vertices = everywhere(Vertex {
            fog: factor,
            ..on(0.0, 0.0)
        });
        let mut target = target();
        let shader = paint(|_, _| [1.0, 0.0, 0.0, 0.0]);
        draw(
            &mut target,
            &call(
                &state,
                Topology::TriangleList,
                &Vertices::from(&vertices[..]),
            ),
            &shader,
        )
        .unwrap();
        target.color(2, 2).unwrap()
    };
    // A quarter of 255 is 63.75, three quarters 191.25.
    assert_eq!(picture(0.25), [64, 191, 0, 0]);
    assert_eq!(picture(0.0), [0, 255, 0, 0]);
    assert_eq!(picture(7.0), [255, 0, 0, 0]);
    assert_eq!(picture(f32::NAN), [255, 0, 0, 0]);
}

/// Kills the left half of the screen, and gives the rest a depth.
struct Half(Option<f32>);

impl PixelShader for Half {
    fn inputs(&self) -> PixelInputs {
        PixelInputs::NONE
    }

    fn shade(&self, batch: &PixelBatch, out: &mut PixelResult) {
        for lane in 0..4 * batch.quads {
            out.killed[lane] = batch.x[lane] < 8;
            out.depth[lane] = self.0.unwrap_or_default();
            for channel in &mut out.color {
                channel[lane] = 1.0;
            }
        }
    }

    fn writes_depth(&self) -> bool {
        self.0.is_some()
    }
}

#[test]
fn killed_pixels_leave_nothing_and_a_shader_may_set_the_depth() {
    let state = depth_on();
    let vertices = everywhere(on(0.0, 0.0));
    let shaded = Vertices::from(&vertices[..]);
    let call = call(&state, Topology::TriangleList, &shaded);
    let result = |shader: Half| {
        let mut target = target();
        let written = draw(&mut target, &call, &shader).unwrap().written;
        assert_eq!(target.color(7, 7), Some([0; 4]));
        assert_eq!(target.depth(7, 7), Some(1.0));
        (written, target.depth(8, 7).unwrap())
    };
    assert_eq!(result(Half(None)), (128, 0.5));
    assert_eq!(result(Half(Some(0.125))), (128, 0.125));
    assert_eq!(result(Half(Some(-3.0))), (128, 0.0));
    assert_eq!(result(Half(Some(f32::NAN))), (128, 0.0));
    // 1 is not greater than 1: LESSEQUAL passes.
    assert_eq!(result(Half(Some(9.0))), (128, 1.0));
}

#[test]
fn the_stencil_test_and_its_operations() {
    let stored = 0xf0;
    let after = |op: StencilOp, func: Compare, z: f32, write_mask: u8| {
        let mut state = depth_on();
        state.stencil = StencilState {
            enable: true,
            func,
            reference: 0x35,
            mask: 0x0f,
            write_mask,
            ..StencilState::default()
        };
        match (func, z) {
            (Compare::Never, _) => state.stencil.fail = op,
            (_, z) if z > 0.5 => state.stencil.depth_fail = op,
            _ => state.stencil.pass = op,
        }
        let mut target = target();
        target.clear(None, Some(0.5), Some(stored));
        let written = fill(&mut target, &state, z, [1.0; 4]).written;
        (target.stencil(4, 4).unwrap(), written == 256)
    };
    for (op, expected) in [
        (StencilOp::Keep, 0xf0),
        (StencilOp::Zero, 0),
        (StencilOp::Replace, 0x35),
        (StencilOp::IncrSat, 0xf1),
        (StencilOp::DecrSat, 0xef),
        (StencilOp::Invert, 0x0f),
        (StencilOp::Incr, 0xf1),
        (StencilOp::Decr, 0xef),
    ] {
        assert_eq!(
            after(op, Compare::Always, 0.25, 0xff),
            (expected, true),
            "{op}"
        );
        assert_eq!(
            after(op, Compare::Always, 0.75, 0xff),
            (expected, false),
            "{op}"
        );
        assert_eq!(
            after(op, Compare::Never, 0.25, 0xff),
            (expected, false),
            "{op}"
        );
    }
    // Only the lower four bits count: 5 against 0.
    assert!(after(StencilOp::Keep, Compare::Greater, 0.25, 0xff).1);
    assert!(!after(StencilOp::Keep, Compare::Equal, 0.25, 0xff).1);
    // Only the written bits change.
    assert_eq!(
        after(StencilOp::Replace, Compare::Always, 0.25, 0x0f).0,
        0xf5
    );
}

#[test]
fn stencil_values_stop_or_wrap() {
    for (op, stored, expected) in [
        (StencilOp::IncrSat, 255, 255),
        (StencilOp::Incr, 255, 0),
        (StencilOp::DecrSat, 0, 0),
        (StencilOp::Decr, 0, 255),
    ] {
        let mut state = open();
        state.stencil.enable = true;
        state.stencil.pass = op;
        let mut target = target();
        target.clear(None, None, Some(stored));
        fill(&mut target, &state, 0.5, [1.0; 4]);
        assert_eq!(target.stencil(9, 9), Some(expected), "{op}");
    }
}

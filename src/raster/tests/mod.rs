//! Tests of whole draw calls. Expected values are worked out by hand from the rules of Direct3D 8.

mod coverage;
mod inputs;
mod interpolation;
mod merging;
mod plain;
mod record;
mod robustness;

use glam::{Vec4, vec4};

use super::*;

/// A pixel shader that is a function of the batch and the lane.
pub(super) struct Paint<F> {
    pub(super) color: F,
    pub(super) may_kill: bool,
}

/// A shader that paints with a function and never kills.
pub(super) fn paint<F: Fn(&PixelBatch, usize) -> [f32; 4] + Sync>(color: F) -> Paint<F> {
    Paint {
        color,
        may_kill: false,
    }
}

impl<F: Fn(&PixelBatch, usize) -> [f32; 4] + Sync> PixelShader for Paint<F> {
    fn inputs(&self) -> PixelInputs {
        PixelInputs::ALL
    }

    fn shade(&self, batch: &PixelBatch, out: &mut PixelResult) {
        for lane in 0..4 * batch.quads {
            let color = (self.color)(batch, lane);
            for (channel, value) in color.into_iter().enumerate() {
                out.color[channel][lane] = value;
            }
        }
    }

    fn may_kill(&self) -> bool {
        self.may_kill
    }
}

/// A vertex that lands at a screen position of a 16×16 viewport, at a depth and with a w.
pub(super) fn at(x: f32, y: f32, z: f32, w: f32) -> Vertex {
    Vertex {
        position: vec4(x / 8.0 - 1.0, 1.0 - y / 8.0, z, 1.0) * w,
        ..Vertex::default()
    }
}

/// The same, flat at depth 0.5.
pub(super) fn on(x: f32, y: f32) -> Vertex {
    at(x, y, 0.5, 1.0)
}

/// States in which everything is drawn, over and over.
pub(super) fn open() -> RenderState {
    RenderState {
        cull: CullMode::None,
        depth: DepthState {
            enable: false,
            ..DepthState::default()
        },
        ..RenderState::default()
    }
}

/// The same, counting in the red channel how often a pixel is written by [`tally`].
pub(super) fn counting() -> RenderState {
    RenderState {
        blend: BlendState {
            enable: true,
            source: BlendFactor::One,
            destination: BlendFactor::One,
            op: BlendOp::Add,
        },
        ..open()
    }
}

/// The shader that goes with [`counting`].
pub(super) fn tally() -> impl PixelShader {
    paint(|_, _| [1.0 / 255.0, 0.0, 0.0, 0.0])
}

pub(super) fn call<'a>(
    state: &'a RenderState,
    topology: Topology,
    vertices: &'a Vertices,
) -> DrawCall<'a> {
    DrawCall {
        viewport: Viewport::full(16, 16),
        state,
        topology,
        vertices,
        indices: None,
    }
}

pub(super) fn target() -> Target {
    Target::new(16, 16, ColorFormat::A8R8G8B8).unwrap()
}

/// The pixels that a draw call writes, each as often as it does, row by row.
pub(super) fn hits(
    topology: Topology,
    vertices: &[Vertex],
    state: &RenderState,
) -> Vec<(u32, u32)> {
    let mut target = target();
    let shaded = Vertices::from(vertices);
    draw(&mut target, &call(state, topology, &shaded), &tally()).unwrap();
    let mut hits = Vec::new();
    for y in 0..16 {
        for x in 0..16 {
            let count = target.color(x, y).unwrap()[0];
            hits.extend(std::iter::repeat_n((x, y), count.into()));
        }
    }
    hits
}

/// A triangle over the whole 16×16 viewport, all vertices like the one given but for their places.
pub(super) fn everywhere(like: Vertex) -> [Vertex; 3] {
    let (z, w) = (like.position.z, like.position.w);
    [(0.0, 0.0), (40.0, 0.0), (0.0, 40.0)].map(|(x, y)| Vertex {
        position: at(x, y, z / w, w).position,
        ..like
    })
}

//! The render states of Direct3D 8 as those of a WebGPU pipeline.

use crate::raster::{
    BlendFactor, BlendOp, BlendState, ColorMask, Compare, CullMode, DepthState, FillMode,
    RenderState, StencilOp, StencilState, Topology,
};

/// The part of a pipeline that follows from render states. Two draws with equal ones may share a pipeline.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct FixedState {
    /// Topology, culling, fill mode.
    pub primitive: wgpu::PrimitiveState,
    /// Depth and stencil test.
    pub depth_stencil: wgpu::DepthStencilState,
    /// Blending; none where it is off.
    pub blend: Option<wgpu::BlendState>,
    /// The channels that are written.
    pub write_mask: wgpu::ColorWrites,
}

/// Maps render states. `points`: what is drawn are points as quads (see [`crate::wgsl::Points`]), strips without culling.
///
/// `D3DRS_ZBIAS` is not among them: its steps of 1/65535 come in with the translation
/// ([`Options::mapped_depth`](crate::wgsl::Options::mapped_depth)), because those of WebGPU become smaller near the eye.
///
/// # Errors
/// The name of a state that WebGPU cannot express: a fill mode of `point`, or of `wireframe` unless `wireframe` says
/// that the device can draw edges.
pub fn fixed_state(
    state: &RenderState,
    topology: Topology,
    depth_format: wgpu::TextureFormat,
    wireframe: bool,
) -> Result<FixedState, String> {
    let points = topology == Topology::PointList;
    let lines = matches!(topology, Topology::LineList | Topology::LineStrip);
    let polygon_mode = match state.fill {
        _ if points || lines => wgpu::PolygonMode::Fill,
        FillMode::Solid => wgpu::PolygonMode::Fill,
        FillMode::Wireframe if wireframe => wgpu::PolygonMode::Line,
        fill => return Err(format!("the fill mode `{}`", fill.name())),
    };
    Ok(FixedState {
        primitive: wgpu::PrimitiveState {
            topology: match topology {
                Topology::PointList => wgpu::PrimitiveTopology::TriangleStrip,
                // Strips and fans are drawn as lists, see `primitive_indices`.
                Topology::LineList | Topology::LineStrip => wgpu::PrimitiveTopology::LineList,
                Topology::TriangleList | Topology::TriangleStrip | Topology::TriangleFan => {
                    wgpu::PrimitiveTopology::TriangleList
                }
            },
            front_face: wgpu::FrontFace::Cw,
            cull_mode: match state.cull {
                _ if points || lines => None,
                CullMode::None => None,
                CullMode::Cw => Some(wgpu::Face::Front),
                CullMode::Ccw => Some(wgpu::Face::Back),
            },
            polygon_mode,
            ..Default::default()
        },
        depth_stencil: depth_stencil(&state.depth, &state.stencil, depth_format),
        blend: state.blend.enable.then(|| blend(&state.blend)),
        write_mask: write_mask(state.color_mask),
    })
}

fn compare(compare: Compare) -> wgpu::CompareFunction {
    match compare {
        Compare::Never => wgpu::CompareFunction::Never,
        Compare::Less => wgpu::CompareFunction::Less,
        Compare::Equal => wgpu::CompareFunction::Equal,
        Compare::LessEqual => wgpu::CompareFunction::LessEqual,
        Compare::Greater => wgpu::CompareFunction::Greater,
        Compare::NotEqual => wgpu::CompareFunction::NotEqual,
        Compare::GreaterEqual => wgpu::CompareFunction::GreaterEqual,
        Compare::Always => wgpu::CompareFunction::Always,
    }
}

fn stencil_op(op: StencilOp) -> wgpu::StencilOperation {
    match op {
        StencilOp::Keep => wgpu::StencilOperation::Keep,
        StencilOp::Zero => wgpu::StencilOperation::Zero,
        StencilOp::Replace => wgpu::StencilOperation::Replace,
        StencilOp::IncrSat => wgpu::StencilOperation::IncrementClamp,
        StencilOp::DecrSat => wgpu::StencilOperation::DecrementClamp,
        StencilOp::Invert => wgpu::StencilOperation::Invert,
        StencilOp::Incr => wgpu::StencilOperation::IncrementWrap,
        StencilOp::Decr => wgpu::StencilOperation::DecrementWrap,
    }
}

fn depth_stencil(
    depth: &DepthState,
    stencil: &StencilState,
    format: wgpu::TextureFormat,
) -> wgpu::DepthStencilState {
    let face = if stencil.enable {
        wgpu::StencilFaceState {
            compare: compare(stencil.func),
            fail_op: stencil_op(stencil.fail),
            depth_fail_op: stencil_op(stencil.depth_fail),
            pass_op: stencil_op(stencil.pass),
        }
    } else {
        wgpu::StencilFaceState::IGNORE
    };
    wgpu::DepthStencilState {
        format,
        depth_write_enabled: Some(depth.enable && depth.write),
        depth_compare: Some(if depth.enable {
            compare(depth.func)
        } else {
            wgpu::CompareFunction::Always
        }),
        stencil: wgpu::StencilState {
            front: face,
            back: face,
            read_mask: stencil.mask.into(),
            write_mask: stencil.write_mask.into(),
        },
        bias: wgpu::DepthBiasState::default(),
    }
}

fn blend_factor(factor: BlendFactor) -> wgpu::BlendFactor {
    match factor {
        BlendFactor::Zero => wgpu::BlendFactor::Zero,
        BlendFactor::One => wgpu::BlendFactor::One,
        BlendFactor::SrcColor => wgpu::BlendFactor::Src,
        BlendFactor::InvSrcColor => wgpu::BlendFactor::OneMinusSrc,
        // As the factor of the target the two combined ones mean what their names say of alpha.
        BlendFactor::SrcAlpha | BlendFactor::BothSrcAlpha => wgpu::BlendFactor::SrcAlpha,
        BlendFactor::InvSrcAlpha | BlendFactor::BothInvSrcAlpha => {
            wgpu::BlendFactor::OneMinusSrcAlpha
        }
        BlendFactor::DestAlpha => wgpu::BlendFactor::DstAlpha,
        BlendFactor::InvDestAlpha => wgpu::BlendFactor::OneMinusDstAlpha,
        BlendFactor::DestColor => wgpu::BlendFactor::Dst,
        BlendFactor::InvDestColor => wgpu::BlendFactor::OneMinusDst,
        BlendFactor::SrcAlphaSat => wgpu::BlendFactor::SrcAlphaSaturated,
    }
}

fn blend(state: &BlendState) -> wgpu::BlendState {
    let (source, destination) = match state.source {
        // These two say it for both sides.
        BlendFactor::BothSrcAlpha => (BlendFactor::SrcAlpha, BlendFactor::InvSrcAlpha),
        BlendFactor::BothInvSrcAlpha => (BlendFactor::InvSrcAlpha, BlendFactor::SrcAlpha),
        factor => (factor, state.destination),
    };
    let operation = match state.op {
        BlendOp::Add => wgpu::BlendOperation::Add,
        BlendOp::Subtract => wgpu::BlendOperation::Subtract,
        BlendOp::RevSubtract => wgpu::BlendOperation::ReverseSubtract,
        BlendOp::Min => wgpu::BlendOperation::Min,
        BlendOp::Max => wgpu::BlendOperation::Max,
    };
    // Minimum and maximum take the colours without factors; WebGPU wants to see that said.
    let (source, destination) = match state.op {
        BlendOp::Min | BlendOp::Max => (BlendFactor::One, BlendFactor::One),
        _ => (source, destination),
    };
    let component = wgpu::BlendComponent {
        src_factor: blend_factor(source),
        dst_factor: blend_factor(destination),
        operation,
    };
    wgpu::BlendState {
        color: component,
        alpha: component,
    }
}

fn write_mask(mask: ColorMask) -> wgpu::ColorWrites {
    let channels = [
        wgpu::ColorWrites::RED,
        wgpu::ColorWrites::GREEN,
        wgpu::ColorWrites::BLUE,
        wgpu::ColorWrites::ALPHA,
    ];
    let written = channels.into_iter().enumerate();
    written
        .filter(|(channel, _)| mask.writes(*channel))
        .fold(wgpu::ColorWrites::empty(), |all, (_, one)| all | one)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fixed(state: &RenderState) -> FixedState {
        let format = wgpu::TextureFormat::Depth32Float;
        fixed_state(state, Topology::TriangleList, format, false).unwrap()
    }

    #[test]
    fn counter_clockwise_is_what_direct3d_leaves_out() {
        let mut state = RenderState::default();
        assert_eq!(fixed(&state).primitive.cull_mode, Some(wgpu::Face::Back));
        state.cull = CullMode::Cw;
        assert_eq!(fixed(&state).primitive.cull_mode, Some(wgpu::Face::Front));
        assert_eq!(fixed(&state).primitive.front_face, wgpu::FrontFace::Cw);
    }

    #[test]
    fn the_combined_factor_replaces_that_of_the_target() {
        let mut state = RenderState::default();
        state.blend.enable = true;
        state.blend.source = BlendFactor::BothInvSrcAlpha;
        state.blend.destination = BlendFactor::DestColor;
        let blend = fixed(&state).blend.unwrap().color;
        assert_eq!(blend.src_factor, wgpu::BlendFactor::OneMinusSrcAlpha);
        assert_eq!(blend.dst_factor, wgpu::BlendFactor::SrcAlpha);
    }

    #[test]
    fn what_is_off_changes_nothing() {
        let mut state = RenderState::default();
        state.depth.enable = false;
        state.stencil.pass = StencilOp::Replace;
        let mapped = fixed(&state);
        assert_eq!(mapped.depth_stencil.depth_write_enabled, Some(false));
        assert_eq!(
            mapped.depth_stencil.depth_compare,
            Some(wgpu::CompareFunction::Always)
        );
        assert_eq!(
            mapped.depth_stencil.stencil.front,
            wgpu::StencilFaceState::IGNORE
        );
        assert_eq!(mapped.blend, None);
    }

    #[test]
    fn a_state_that_does_not_exist_is_named() {
        let state = RenderState {
            fill: FillMode::Point,
            ..RenderState::default()
        };
        let format = wgpu::TextureFormat::Depth32Float;
        let refused = fixed_state(&state, Topology::TriangleList, format, true);
        assert_eq!(refused.unwrap_err(), "the fill mode `point`");
        assert!(fixed_state(&state, Topology::PointList, format, false).is_ok());
    }
}

//! Render states and texture stage states of a scene file.

use glam::Vec4;
use toml::de::DeValue;

use super::error::{Problems, rules};
use super::section::{At, Exactly, Section, parse_name};
use crate::raster::{
    AlphaTest, BlendState, ColorMask, DepthState, FogDistance, FogState, PointState, RenderState,
    StencilState, Surface, Target, ViewportState,
};
use crate::semantics::BumpState;
use crate::texture::{Filter, Sampler, Weights};

/// Reads what a target holds before anything is drawn.
pub(crate) fn surface(s: &mut Section<'_>, color: [f32; 4], problems: &mut Problems) -> Surface {
    let default = Surface::default();
    Surface {
        format: s.named("format", default.format, problems),
        color: s.color_or("clear", color, problems),
        depth: s.ranged("clear_depth", 0.0..=1.0, default.depth, problems),
        stencil: s.ranged("clear_stencil", 0..=0xff, default.stencil.into(), problems) as u8,
    }
}

/// The render states of a draw.
#[derive(Default)]
pub(crate) struct States {
    pub(crate) state: RenderState,
    /// The distance of table fog, if it is set by hand; else the projection decides it.
    pub(crate) fog_distance: Option<FogDistance>,
}

/// Reads `[draw.state]`.
pub(crate) fn state(mut section: Section<'_>, problems: &mut Problems) -> States {
    let s = &mut section;
    let (fog, fog_distance) = s
        .table("fog", problems)
        .map(|table| fog(table, problems))
        .unwrap_or_default();
    let default = RenderState::default();
    let (depth, alpha, blend) = (
        DepthState::default(),
        AlphaTest::default(),
        BlendState::default(),
    );
    let point = PointState::default();
    let state = RenderState {
        cull: s.named("cull", default.cull, problems),
        shade: s.named("shade", default.shade, problems),
        fill: s.named("fill", default.fill, problems),
        depth: DepthState {
            enable: s.or("z_enable", depth.enable, problems),
            write: s.or("z_write", depth.write, problems),
            func: s.named("z_func", depth.func, problems),
            bias: s.ranged("z_bias", 0..=16, depth.bias, problems),
        },
        alpha_test: AlphaTest {
            enable: s.or("alpha_test", alpha.enable, problems),
            reference: s.or("alpha_ref", alpha.reference, problems),
            func: s.named("alpha_func", alpha.func, problems),
        },
        blend: BlendState {
            enable: s.or("alpha_blend", blend.enable, problems),
            source: s.named("src_blend", blend.source, problems),
            destination: s.named("dest_blend", blend.destination, problems),
            op: s.named("blend_op", blend.op, problems),
        },
        color_mask: color_mask(s, problems),
        fog,
        stencil: s
            .table("stencil", problems)
            .map_or_else(StencilState::default, |table| stencil(table, problems)),
        point: PointState {
            size: s.or("point_size", point.size, problems),
            min: s.or("point_size_min", point.min, problems),
            max: s.or("point_size_max", point.max, problems),
            sprite: s.or("point_sprite", point.sprite, problems),
        },
        clip_planes: clip_planes(s, problems),
        viewport: s
            .table("viewport", problems)
            .map_or_else(ViewportState::default, |table| viewport(table, problems)),
    };
    section.finish(problems);
    States {
        state,
        fog_distance,
    }
}

/// `viewport`: a part of the target in pixels, and its depths.
fn viewport(mut s: Section<'_>, problems: &mut Problems) -> ViewportState {
    let default = ViewportState::default();
    let whole = || 0..=i64::from(Target::MAX_SIDE);
    let mut side = |key, s: &mut Section<'_>| {
        let given = s.has(key);
        let length = s.ranged(key, whole(), 0, problems) as u32;
        given.then_some(length)
    };
    let [x, y] = ["x", "y"].map(|key| side(key, &mut s).unwrap_or_default());
    let [width, height] = ["width", "height"].map(|key| side(key, &mut s));
    let state = ViewportState {
        x,
        y,
        width,
        height,
        min_z: s.ranged("min_z", 0.0..=1.0, default.min_z, problems),
        max_z: s.ranged("max_z", 0.0..=1.0, default.max_z, problems),
    };
    s.finish(problems);
    state
}

/// `color_write`: letters of `rgba`, or the bits of Direct3D.
fn color_mask(section: &mut Section<'_>, problems: &mut Problems) -> ColorMask {
    let Some(node) = section.node("color_write") else {
        return ColorMask::ALL;
    };
    if let DeValue::String(letters) = node.value.get_ref() {
        let mut bits = 0;
        for letter in letters.chars() {
            match "rgba".find(letter.to_ascii_lowercase()) {
                Some(bit) => bits |= 1 << bit,
                None => {
                    let message = format!("`color_write`: `{letter}` is none of r, g, b, a");
                    problems.error(&rules::VALUE, node.span(problems), message);
                    break;
                }
            }
        }
        return ColorMask::from_bits(bits);
    }
    let Some(At { value, span }) = node.read::<u8>(problems) else {
        return ColorMask::ALL;
    };
    if value > 0xf {
        let message =
            format!("`color_write` is {value}; the bits of the four channels are 0 to 15");
        problems.error(&rules::VALUE, span, message);
    }
    ColorMask::from_bits(value)
}

fn fog(mut s: Section<'_>, problems: &mut Problems) -> (FogState, Option<FogDistance>) {
    let default = FogState::default();
    let by_hand = s.has("distance");
    let state = FogState {
        enable: s.or("enable", true, problems),
        color: fog_color(&mut s, default.color, problems),
        table: s.named("table", default.table, problems),
        distance: s.named("distance", default.distance, problems),
        start: s.or("start", default.start, problems),
        end: s.or("end", default.end, problems),
        density: s.or("density", default.density, problems),
    };
    // D3DRS_FOGVERTEXMODE is a state of the fixed-function vertex pipeline: a vertex shader's oFog replaces it.
    if let Some(At { span, .. }) = s.at::<String>("vertex", problems) {
        let message = "`vertex` has no effect: the vertex shader says the fog of its vertices";
        problems.warning(&rules::IDLE, span, message);
    }
    s.finish(problems);
    (state, by_hand.then_some(state.distance))
}

/// Red, green and blue. The alpha of `D3DRS_FOGCOLOR`, which may stand behind them, has no effect.
fn fog_color(s: &mut Section<'_>, default: [f32; 3], problems: &mut Problems) -> [f32; 3] {
    match s.peek("color") {
        Some(DeValue::Array(list)) if list.len() == 4 => {
            let [red, green, blue] = default;
            let [red, green, blue, _] = s.array_or("color", [red, green, blue, 0.0], problems);
            [red, green, blue]
        }
        _ => s.color_or("color", default, problems),
    }
}

fn stencil(mut s: Section<'_>, problems: &mut Problems) -> StencilState {
    let default = StencilState::default();
    let state = StencilState {
        enable: s.or("enable", true, problems),
        func: s.named("func", default.func, problems),
        reference: low_byte("ref", default.reference, &mut s, problems),
        mask: low_byte("mask", default.mask, &mut s, problems),
        write_mask: low_byte("write_mask", default.write_mask, &mut s, problems),
        fail: s.named("fail", default.fail, problems),
        depth_fail: s.named("z_fail", default.depth_fail, problems),
        pass: s.named("pass", default.pass, problems),
    };
    s.finish(problems);
    state
}

/// A state of 32 bits, of which those count that a stencil buffer has.
fn low_byte(key: &'static str, default: u8, s: &mut Section<'_>, problems: &mut Problems) -> u8 {
    let bits = s.ranged(key, 0..=i64::from(u32::MAX), default.into(), problems);
    (bits & 0xff) as u8
}

fn clip_planes(section: &mut Section<'_>, problems: &mut Problems) -> [Option<Vec4>; 6] {
    let mut planes = [None; 6];
    let Some(At { value, span }) = section.arrays::<f32, 4>("clip_planes", problems) else {
        return planes;
    };
    if value.len() > planes.len() {
        let message = format!("`clip_planes` has {} planes; there are six", value.len());
        problems.error(&rules::VALUE, span, message);
    }
    if value
        .as_flattened()
        .iter()
        .any(|number| !number.is_finite())
    {
        let message = "`clip_planes` holds an infinite number or one that is none";
        problems.error(&rules::VALUE, span, message);
    }
    for (plane, given) in planes.iter_mut().zip(value) {
        *plane = Some(Vec4::from_array(given));
    }
    planes
}

/// Reads how a texture is sampled: the address, filter and level keys of a stage.
pub(crate) fn sampler(s: &mut Section<'_>, weights: Weights, problems: &mut Problems) -> Sampler {
    let default = Sampler::default();
    let filter = s.node("filter").map(|node| filter_name(node, problems));
    let both = filter.unwrap_or_default();
    let mut axis_filter = |key, s: &mut Section<'_>| match s.node(key) {
        Some(node) => filter_name(node, problems),
        None => both,
    };
    let (min, mag) = (axis_filter("min", s), axis_filter("mag", s));
    let address = match s.node("address") {
        Some(node) if matches!(node.value.get_ref(), DeValue::Array(_)) => {
            let mut modes = default.address;
            if let Some(At { value, span }) = node.read::<Vec<String>>(problems) {
                if value.is_empty() || value.len() > 3 {
                    let message = format!(
                        "`address` has {} modes; there are up to three axes",
                        value.len()
                    );
                    problems.error(&rules::VALUE, span, message);
                }
                for (mode, name) in modes.iter_mut().zip(value) {
                    *mode = parse(&name, "address", span, problems).unwrap_or(*mode);
                }
            }
            modes
        }
        Some(node) => node.read::<String>(problems).map_or(default.address, |at| {
            let mode = parse(&at.value, "address", at.span, problems);
            [mode.unwrap_or_default(); 3]
        }),
        None => default.address,
    };
    Sampler {
        address,
        mag,
        min,
        mip: s.named("mip", default.mip, problems),
        lod_bias: s.or("lod_bias", default.lod_bias, problems),
        // Read wider than it is, so that one below 0 is told with its range.
        max_mip_level: s.ranged(
            "max_mip_level",
            0..=i64::from(u32::MAX),
            default.max_mip_level.into(),
            problems,
        ) as u32,
        max_anisotropy: s.ranged(
            "max_anisotropy",
            Sampler::ANISOTROPY,
            default.max_anisotropy,
            problems,
        ),
        border: s.color_or("border", default.border, problems),
        seamless: s.or("seamless", default.seamless, problems),
        weights,
    }
}

fn parse<T>(
    name: &str,
    key: &str,
    span: crate::diagnostic::Span,
    problems: &mut Problems,
) -> Option<T>
where
    T: std::str::FromStr,
    T::Err: std::fmt::Display,
{
    match parse_name(name) {
        Ok(value) => Some(value),
        Err(error) => {
            let error: T::Err = error;
            problems.error(&rules::VALUE, span, format!("`{key}`: {error}"));
            None
        }
    }
}

/// A filter. The cubic filters of Direct3D 8 are linear, as on all devices but those that had them.
fn filter_name(node: super::section::Node<'_>, problems: &mut Problems) -> Filter {
    let key = node.key.clone();
    let Some(At { value, span }) = node.read::<String>(problems) else {
        return Filter::default();
    };
    if parse_name::<Cubic>(&value).is_ok() {
        return Filter::Linear;
    }
    parse(&value, &key, span, problems).unwrap_or_default()
}

/// The filters that are done as another one.
struct Cubic;

impl std::str::FromStr for Cubic {
    type Err = ();

    fn from_str(name: &str) -> Result<Self, ()> {
        let cubic = ["flatcubic", "gaussiancubic"].contains(&name);
        cubic.then_some(Self).ok_or(())
    }
}

/// Reads the bump mapping keys of a stage.
pub(crate) fn bump(s: &mut Section<'_>, problems: &mut Problems) -> BumpState {
    let default = BumpState::default();
    // The four numbers, or the two rows: (m00, m01) and (m10, m11).
    let first = match s.peek("bump_mat") {
        Some(DeValue::Array(list)) => list.first().map(toml::Spanned::get_ref),
        _ => None,
    };
    let matrix = if let Some(DeValue::Array(_)) = first {
        let rows = s.array::<Exactly<f32, 2>, 2>("bump_mat", problems);
        rows.map_or(default.matrix, |At { value: [u, v], .. }| {
            [u.0[0], u.0[1], v.0[0], v.0[1]]
        })
    } else {
        s.array_or("bump_mat", default.matrix, problems)
    };
    BumpState {
        matrix,
        luminance_scale: s.or("lum_scale", default.luminance_scale, problems),
        luminance_offset: s.or("lum_offset", default.luminance_offset, problems),
    }
}

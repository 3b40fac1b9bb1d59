//! The vertex entry point.

use super::body::Body;
use super::helper::Helper;
use super::layout::Field;
use super::options::Points;
use super::varyings::Varyings;
use crate::kernel::{Kernel, Slot};
use std::fmt::Write;

/// The vertex registers that a kernel reads.
pub(super) fn inputs(kernel: &Kernel) -> impl Iterator<Item = u32> + '_ {
    (0..16).filter(|i| Slot::input(*i as usize).is_some_and(|slot| !kernel.read(slot).is_empty()))
}

/// The structure of the inputs, or nothing if there are none.
pub(super) fn input_structure(kernel: &Kernel) -> Option<String> {
    inputs(kernel).next()?;
    let mut text = String::from("struct VertexInput {\n");
    for i in inputs(kernel) {
        _ = writeln!(text, "    @location({i}) v{i}: vec4f,");
    }
    Some(text + "}\n")
}

/// The function. The body is complete afterwards.
pub(super) fn entry(body: &mut Body<'_>, varyings: &Varyings) -> String {
    body.statements();
    body.observe();
    outputs(body, varyings);
    let mut parameters = Vec::new();
    if body.options.points != Points::None {
        parameters.push("@builtin(vertex_index) corner: u32");
    }
    if inputs(body.stage.kernel).next().is_some() {
        parameters.push("in: VertexInput");
    }
    let (name, parameters) = (&body.options.vertex_entry, parameters.join(", "));
    let attribute = match body.options.observed {
        None => "@vertex\n",
        Some(_) => "",
    };
    format!("{attribute}fn {name}({parameters}) -> Varyings {{\n")
}

fn outputs(body: &mut Body<'_>, varyings: &Varyings) {
    let options = body.options;
    body.push("");
    if options.points != Points::None {
        corner(body);
    }
    body.push("var out: Varyings;");
    position(body);
    let sprite = options.points == Points::Sprites;
    for (set, components) in varyings.sets.into_iter().enumerate() {
        let Some(slot) = Slot::texcoord_output(set).filter(|_| components > 0) else {
            continue;
        };
        let value = if sprite {
            adapted("across", 2, components)
        } else {
            adapted(&body.name(slot), body.width(slot), components)
        };
        body.push(format!("out.t{set} = {value};"));
    }
    for (i, slot) in (0..2).filter_map(|i| Some((i, Slot::color_output(i)?))) {
        if varyings.colors[i] {
            let value = match (body.width(slot), i) {
                (0, 0) => "vec4f(1.0)".into(),
                (0, _) => "vec4f()".into(),
                _ => format!("saturate({})", body.name(slot)),
            };
            body.push(format!("out.v{i} = {value};"));
        }
    }
    if varyings.fog {
        let value = match body.width(Slot::FOG) {
            0 => "0.0".to_string(),
            // WGSL leaves open what becomes of NaN, which is clear in Direct3D.
            _ if (body.magnitudes).may_be_infinite(Slot::FOG, body.stage.kernel.fog_component) => {
                let name = body.helpers.call(Helper::FogFactor);
                format!("{name}({})", body.name(Slot::FOG))
            }
            _ => format!("saturate({})", body.name(Slot::FOG)),
        };
        body.push(format!("out.fog = {value};"));
    }
    let planes = usize::from(options.clip_planes);
    for first in (0..planes).step_by(4) {
        let field = body.uniform(Field::ClipPlanes);
        let position = position_name(body);
        let distances: Vec<String> = (first..first + 4)
            .map(|plane| match plane < planes {
                true => format!("dot({position}, {field}[{plane}])"),
                false => "0.0".into(),
            })
            .collect();
        body.push(format!(
            "out.clip{} = vec4f({});",
            first / 4,
            distances.join(", ")
        ));
    }
    body.push("return out;");
}

fn position_name(body: &Body<'_>) -> String {
    match body.width(Slot::POSITION) {
        0 => "vec4f()".into(),
        _ => body.name(Slot::POSITION),
    }
}

/// The corner of the point that this vertex is.
fn corner(body: &mut Body<'_>) {
    let size = match body.width(Slot::POINT_SIZE) {
        0 => body.uniform(Field::PointSize),
        _ => body.name(Slot::POINT_SIZE),
    };
    let (min, max) = (body.uniform(Field::PointMin), body.uniform(Field::PointMax));
    body.push("// Corner 0 to 3 of the point: upper left, upper right, lower left, lower right.");
    body.push("let across = vec2f(f32(corner & 1u), f32(corner >> 1u));");
    body.push(format!("let size = min(max({size}, {min}), {max});"));
    body.push("let offset = vec2f(across.x - 0.5, 0.5 - across.y) * size;");
}

/// Clip space to clip space: from Direct3D's pixel centres to those of WebGPU, and to the corner of a point.
fn position(body: &mut Body<'_>) {
    let name = position_name(body);
    let points = body.options.points != Points::None;
    let half = body.options.half_pixel;
    if !half && !points || body.width(Slot::POSITION) == 0 {
        body.push(format!("out.position = {name};"));
        return;
    }
    let viewport = body.uniform(Field::Viewport);
    let shift = match (half, points) {
        (true, false) => {
            body.push("// Direct3D 8 has pixel centres at whole coordinates: half a pixel to the right and down.");
            "vec2f(1.0, -1.0)".to_string()
        }
        (true, true) => {
            body.push("// In clip space a pixel is two parts of the viewport; half of one goes to Direct3D 8's pixel centres.");
            "(2.0 * offset + vec2f(1.0, -1.0))".into()
        }
        (false, _) => "2.0 * offset".into(),
    };
    body.push(format!("let shift = {shift} / {viewport};"));
    body.push(format!(
        "out.position = vec4f({name}.xy + shift * {name}.w, {name}.zw);"
    ));
}

/// A vector of one width as one of another: cut off, or filled with 0.
fn adapted(name: &str, from: usize, to: usize) -> String {
    let zeros = |count: usize| vec!["0.0"; count].join(", ");
    let kept: String = "xyzw".chars().take(to).collect();
    match from {
        0 => format!("vec{to}f()"),
        _ if from == to => name.to_string(),
        _ if from > to => format!("{name}.{kept}"),
        _ => format!("vec{to}f({name}, {})", zeros(to - from)),
    }
}

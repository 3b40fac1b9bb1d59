//! The pixel entry point.

use super::body::Body;
use super::expression::Expression;
use super::helper::Helper;
use super::layout::Field;
use super::options::{Fog, Options, ShownPixels};
use super::varyings::Varyings;
use crate::kernel::Kernel;
use crate::raster::{Compare, FogDistance, FogMode};

/// Whether the stage sets the depth: the shader does, or the viewport and the bias ask for it.
pub(super) fn writes_depth(kernel: &Kernel, options: &Options) -> bool {
    kernel.writes_depth() || options.mapped_depth
}

/// The structure of what the stage returns, if that is more than a colour.
pub(super) fn output_structure(writes_depth: bool) -> Option<&'static str> {
    writes_depth.then_some(
        "struct PixelOutput {\n    @location(0) color: vec4f,\n    @builtin(frag_depth) depth: f32,\n}\n",
    )
}

/// The head of the function. The body is complete afterwards.
pub(super) fn entry(body: &mut Body<'_>, varyings: &Varyings) -> String {
    body.statements();
    let mark = body.mark();
    body.observe();
    tests(body, varyings);
    let depth = depth(body);
    let result = match body.shown() {
        Some(shown) => body.shown_content(shown.slot),
        None => {
            if let Some(fog) = body.options.fog {
                apply_fog(body, fog, &depth.of_position);
            }
            "r0".into()
        }
    };
    if body.mark() > mark {
        body.insert_blank(mark);
    }
    body.push(match &depth.written {
        Some(depth) => format!("return PixelOutput({result}, {depth});"),
        None => format!("return {result};"),
    });
    let parameter = match varyings.reach_pixel() {
        true => "in: Varyings",
        false => "",
    };
    let (attribute, place) = match body.options.observed {
        None => ("@fragment\n", "@location(0) "),
        Some(_) => ("", ""),
    };
    let result = match depth.written {
        Some(_) => "PixelOutput".to_string(),
        None => format!("{place}vec4f"),
    };
    let name = &body.options.pixel_entry;
    format!("{attribute}fn {name}({parameter}) -> {result} {{\n")
}

/// The depths of a pixel.
struct Depths {
    /// That of the primitive, as fog takes it.
    of_position: String,
    /// That which the stage sets.
    written: Option<String>,
}

/// Works out the depth of the primitive, where that is not simply the position's and somebody asks for it.
fn depth(body: &mut Body<'_>) -> Depths {
    let shader_writes = body.stage.kernel.writes_depth();
    let fog = (body.options.fog).filter(|_| body.shown().is_none());
    let fogged =
        fog.is_some_and(|fog| fog.table != FogMode::None && fog.distance == FogDistance::Z);
    let own = shader_writes.then(|| "depth".to_string());
    if !body.options.mapped_depth || shader_writes && !fogged {
        return Depths {
            of_position: "in.position.z".into(),
            written: own,
        };
    }
    let mapping = body.uniform(Field::DepthMapping);
    let name = "depth_of_position";
    body.push(format!(
        "let {name} = saturate(in.position.z * {mapping}.x + {mapping}.y);"
    ));
    Depths {
        of_position: name.into(),
        written: own.or_else(|| Some(name.into())),
    }
}

/// Everything that takes the pixel out, behind all sampling, which must not come after it.
fn tests(body: &mut Body<'_>, varyings: &Varyings) {
    let mut conditions = Vec::new();
    let shown = body.shown();
    if body.discards_all() {
        body.note_discard();
        return match body.options.observed {
            None => body.push("discard;"),
            Some(_) => body.push("if !keep {\n        discard;\n    }"),
        };
    }
    if body.asks_for_kill() {
        let discarded = shown.is_some_and(|shown| shown.pixels == ShownPixels::Discarded);
        conditions.push(if discarded { "!killed" } else { "killed" }.to_string());
    }
    for first in (0..varyings.clip).step_by(4) {
        conditions.push(format!("any(in.clip{} < vec4f())", first / 4));
    }
    if let Some(alpha) = (body.options.alpha_test)
        .filter(|_| shown.is_none())
        .and_then(|compare| alpha_fails(body, compare))
    {
        conditions.push(alpha);
    }
    if !conditions.is_empty() {
        body.note_discard();
        let condition = conditions.join(" || ");
        body.push(match body.options.observed {
            None => format!("if {condition} {{"),
            Some(_) => format!("if ({condition}) && !keep {{"),
        });
        body.push("    discard;");
        body.push("}");
    }
}

/// The condition under which the alpha test takes the pixel out, in 8 bits as the target has them.
fn alpha_fails(body: &mut Body<'_>, compare: Compare) -> Option<String> {
    let fails = match compare {
        // What never passes is discarded as a whole.
        Compare::Always | Compare::Never => return None,
        Compare::Less => ">=",
        Compare::Equal => "!=",
        Compare::LessEqual => ">",
        Compare::Greater => "<=",
        Compare::NotEqual => "==",
        Compare::GreaterEqual => "<",
    };
    let reference = body.uniform(Field::AlphaReference);
    Some(format!("round(saturate(r0.a) * 255.0) {fails} {reference}"))
}

/// Mixes the fog in. 1 is clear.
fn apply_fog(body: &mut Body<'_>, fog: Fog, depth: &str) {
    let distance = match fog.distance {
        FogDistance::Z => depth,
        FogDistance::W => "(1.0 / in.position.w)",
    };
    let factor = match fog.table {
        FogMode::None => "in.fog".to_string(),
        FogMode::Exp => format!("exp(-{distance} * {})", body.uniform(Field::FogDensity)),
        FogMode::Exp2 => {
            let density = body.uniform(Field::FogDensity);
            body.push(format!("let depth_of_fog = {distance} * {density};"));
            "exp(-depth_of_fog * depth_of_fog)".into()
        }
        FogMode::Linear => {
            let (start, end) = (body.uniform(Field::FogStart), body.uniform(Field::FogEnd));
            let name = body.helpers.call(Helper::LinearFog);
            let distance = distance
                .trim_start_matches('(')
                .trim_end_matches(')')
                .to_string();
            Expression::call(&name, &[distance, start, end], 1).text
        }
    };
    let color = body.uniform(Field::FogColor);
    // Only states that are not finite make table fog NaN, which is clear.
    let clamped = match fog.table != FogMode::None && body.options.wild_inputs {
        true => body.helpers.call(Helper::FogFactor),
        false => "saturate".into(),
    };
    body.push(format!("let clear = {clamped}({factor});"));
    body.push(format!(
        "r0 = vec4f(clear * saturate(r0.rgb) + (1.0 - clear) * {color}, r0.a);"
    ));
}

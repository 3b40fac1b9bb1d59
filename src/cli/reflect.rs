//! The contract of a translation as JSON.

use serde_json::{Value, json};
use texcrd::isa::ShaderKind;
use texcrd::wgsl::{Binding, Options, Points, Reflection, Resource, StageReflection};

/// Everything that a program must know to draw with a translation.
pub(super) fn reflection(reflection: &Reflection) -> Value {
    let inputs: Vec<_> = (reflection.inputs.iter())
        .map(|input| {
            json!({
                "register": format!("v{}", input.register),
                "location": input.register,
                "usage": input.usage.map(|(usage, _)| usage.name()),
                "usage_index": input.usage.map(|(_, index)| index),
            })
        })
        .collect();
    let varyings: Vec<_> = (reflection.varyings.iter())
        .map(|varying| {
            json!({
                "name": varying.name,
                "location": varying.location,
                "components": varying.components,
                "flat": varying.flat,
            })
        })
        .collect();
    json!({
        "vertex": reflection.vertex.as_ref().map(stage),
        "pixel": reflection.pixel.as_ref().map(stage),
        "inputs": inputs,
        "varyings": varyings,
        "bindings": reflection.bindings.iter().map(binding).collect::<Vec<_>>(),
        "baked": baked(&reflection.baked, reflection),
    })
}

fn stage(stage: &StageReflection) -> Value {
    let constants: Vec<_> = (stage.constants.iter())
        .map(|range| json!({ "first": range.start, "count": range.len() }))
        .collect();
    let definitions: Vec<_> = (stage.definitions.iter())
        .map(|definition| {
            json!({
                "register": format!("c{}", definition.register),
                // JSON has no infinities: these are null.
                "value": definition.value,
                "in_uniform": definition.in_uniform,
            })
        })
        .collect();
    json!({
        "entry": stage.entry,
        "version": stage.version.to_string(),
        "constants": constants,
        "relative": stage.relative,
        "definitions": definitions,
        "point_size": stage.point_size,
        "writes_depth": stage.writes_depth,
        "discards": stage.discards,
    })
}

fn kind_name(kind: ShaderKind) -> &'static str {
    match kind {
        ShaderKind::Vertex => "vertex",
        ShaderKind::Pixel => "pixel",
    }
}

fn binding(binding: &Binding) -> Value {
    let mut object = json!({
        "group": binding.group,
        "binding": binding.binding,
        "name": binding.name,
    });
    let about = match &binding.resource {
        Resource::Uniform {
            stage,
            fields,
            size,
        } => {
            let fields: Vec<_> = fields
                .iter()
                .map(|field| {
                    json!({
                        "name": field.name,
                        "type": field.wgsl_type,
                        "offset": field.offset,
                        "size": field.size,
                    })
                })
                .collect();
            json!({
                "kind": "uniform",
                "shader": kind_name(*stage),
                "size": size,
                "fields": fields,
            })
        }
        Resource::Texture { stage, dimension } => json!({
            "kind": "texture",
            "stage": stage,
            "dimension": dimension.name(),
        }),
        Resource::Sampler { stage, clamps } => json!({
            "kind": "sampler",
            "stage": stage,
            "clamps": clamps,
        }),
    };
    if let (Value::Object(object), Value::Object(about)) = (&mut object, about) {
        object.extend(about);
    }
    object
}

/// The states that stand in the text; of texture stages only those that are sampled.
fn baked(options: &Options, reflection: &Reflection) -> Value {
    let sampled = |number: usize| {
        (reflection.bindings.iter()).any(|binding| match &binding.resource {
            Resource::Texture { stage, .. } => usize::from(*stage) == number,
            Resource::Uniform { .. } | Resource::Sampler { .. } => false,
        })
    };
    let stages: serde_json::Map<String, Value> = (options.stages.iter().enumerate())
        .filter(|(number, _)| sampled(*number))
        .map(|(number, stage)| {
            let state = json!({
                "texture": stage.texture.map(|kind| kind.to_string()),
                "address": stage.address.map(|mode| mode.to_string()),
                "mag": stage.mag.to_string(),
                "min": stage.min.to_string(),
                "mip": stage.mip.to_string(),
                "max_mip_level": stage.max_mip_level,
                "max_anisotropy": stage.max_anisotropy,
                "seamless": stage.seamless,
                "lod_bias": stage.lod_bias,
                "wide_texels": stage.wide_texels,
            });
            (number.to_string(), state)
        })
        .collect();
    json!({
        "stages": stages,
        "fog": options.fog.map(|fog| json!({
            "table": fog.table.name(),
            "distance": fog.distance.name(),
        })),
        "alpha_test": options.alpha_test.map(|compare| compare.name()),
        "half_pixel": options.half_pixel,
        "flat_shading": options.flat_shading,
        "points": match options.points {
            Points::None => None,
            Points::Quads => Some("quads"),
            Points::Sprites => Some("sprites"),
        },
        "clip_planes": options.clip_planes,
        "overridable_definitions": options.overridable_definitions,
    })
}

//! What a translation tells about itself.

use super::support::{Shader, valid, valid_pair, validate};
use crate::isa::ShaderKind;
use crate::kernel::Slot;
use crate::program::Usage;
use crate::raster::{Compare, FogDistance, FogMode, RenderState};
use crate::texture::TextureKind;
use crate::wgsl::{
    Binding, Dimension, Field, Fog, Observed, Options, Points, Resource, StageOptions,
    TranslateError, Translation, translate,
};

fn everything() -> Options {
    Options {
        fog: Some(Fog {
            table: FogMode::Linear,
            distance: FogDistance::W,
        }),
        alpha_test: Some(Compare::Greater),
        points: Points::Quads,
        clip_planes: 5,
        stages: [StageOptions {
            lod_bias: true,
            ..StageOptions::default()
        }; 8],
        ..Options::default()
    }
}

/// The offsets and sizes of the blocks in the reflection are those that the module has.
fn check_blocks(translation: &Translation) -> Vec<Field> {
    let module = super::support::validate(&translation.source);
    let mut all = Vec::new();
    for binding in &translation.reflection.bindings {
        let Resource::Uniform { fields, size, .. } = &binding.resource else {
            continue;
        };
        let variable = module
            .global_variables
            .iter()
            .find(|(_, v)| v.name.as_ref() == Some(&binding.name));
        let naga::TypeInner::Struct { members, span } = &module.types[variable.unwrap().1.ty].inner
        else {
            panic!("{} is no structure", binding.name);
        };
        assert_eq!(span, size);
        let expected: Vec<_> = members
            .iter()
            .map(|m| (m.name.clone().unwrap(), m.offset))
            .collect();
        let told: Vec<_> = fields.iter().map(|f| (f.name.clone(), f.offset)).collect();
        assert_eq!(told, expected);
        all.extend(fields.iter().map(|field| field.field));
    }
    all
}

#[test]
fn fields_lie_where_the_module_has_them() {
    let vs = Shader::new("vs.1.1\nm4x4 oPos, v0, c0\nmov oT0, v7\nmov oFog.x, c20.x\n");
    let ps = Shader::new(
        "ps.1.1\ntex t0\ntexbeml t1, t0\ntexbem t2, t0\nmul r0, t1, c2\nadd r0, r0, t2\n",
    );
    let fields = check_blocks(&valid_pair(&vs, &ps, &everything()));
    use Field::*;
    assert_eq!(
        fields,
        [
            Constants,
            Viewport,
            PointSize,
            PointMin,
            PointMax,
            ClipPlanes,
            Constants,
            Bump(1),
            Bump(2),
            Luminance(1),
            LodBias(0),
            LodBias(1),
            LodBias(2),
            AlphaReference,
            FogColor,
            FogStart,
            FogEnd,
        ]
    );
    check_blocks(&valid_pair(&vs, &ps, &Options::default()));
}

#[test]
fn reflection_of_a_pair() {
    let vs = Shader::new(
        "vs.1.1\ndcl_position v0\ndcl_texcoord0 v7\ndef c4, 1, 0, 0, 0\nm4x4 oPos, v0, c0\nmov oT0, v7\nmov oT1, c9\n\
         mov oT2, c10\nmul oD0, c4, c12\n",
    );
    let ps = Shader::new(
        "ps.1.4\ndef c0, 1, 2, -3, 0.5\ntexld r1, t0\ntexcrd r0.rgb, t2\nmul r0, r1, c0\n",
    );
    let mut options = Options::default();
    options.stages[1] = StageOptions::with_texture(Some(TextureKind::Cube));
    let reflection = valid_pair(&vs, &ps, &options).reflection;
    let inputs: Vec<_> = reflection
        .inputs
        .iter()
        .map(|i| (i.register, i.usage))
        .collect();
    assert_eq!(
        inputs,
        [
            (0, Some((Usage::Position, 0))),
            (7, Some((Usage::TexCoord, 0)))
        ]
    );
    // The pixel shader reads three components of both sets (a cube, and texcrd), no colour and no t1.
    let varyings: Vec<_> = reflection
        .varyings
        .iter()
        .map(|v| (v.name.as_str(), v.location, v.components))
        .collect();
    assert_eq!(varyings, [("t0", 0, 3), ("t2", 2, 3)]);
    let (vertex, pixel) = (reflection.vertex.unwrap(), reflection.pixel.unwrap());
    assert_eq!(vertex.constants, [0..4, 9..11, 12..13]);
    assert_eq!(vertex.definitions.len(), 1);
    assert!(pixel.constants.is_empty() && !pixel.discards && !pixel.writes_depth);
    // Pixel constants are clamped.
    assert_eq!(pixel.definitions[0].value, [1.0, 1.0, -1.0, 0.5]);
    let places: Vec<_> = (reflection.bindings.iter())
        .map(|b| (b.group, b.binding, b.name.as_str()))
        .collect();
    assert_eq!(
        places,
        [(0, 0, "vs"), (1, 2, "texture1"), (1, 3, "sampler1")]
    );
    assert!(matches!(
        reflection.bindings[1].resource,
        Resource::Texture {
            stage: 1,
            dimension: Dimension::D2Array
        }
    ));
}

#[test]
fn definitions_that_may_be_replaced_lie_in_the_block() {
    let options = Options {
        overridable_definitions: true,
        ..Options::default()
    };
    let t = valid("ps.1.1\ndef c3, 1, 0, 0, 1\nmov r0, c3\n", &options);
    assert!(!t.source.contains("const c3"));
    let pixel = t.reflection.pixel.unwrap();
    assert_eq!(pixel.constants, std::slice::from_ref(&(3..4)));
    assert!(pixel.definitions[0].in_uniform);
    // The last definition of a register counts.
    let twice = valid(
        "ps.1.1\ndef c3, 1, 0, 0, 1\ndef c3, 0, 1, 0, 1\nmov r0, c3\n",
        &Options::default(),
    );
    assert!(
        twice
            .source
            .contains("const c3 = vec4f(0.0, 1.0, 0.0, 1.0);")
    );
    assert_eq!(twice.source.matches("const c3").count(), 1);
}

#[test]
fn only_what_is_used_is_bound() {
    let t = valid(
        "ps.1.1\ntex t0\nmov r0, t0\n",
        &Options {
            stages: [StageOptions::with_texture(None); 8],
            ..Options::default()
        },
    );
    assert!(t.reflection.bindings.is_empty() && t.reflection.varyings.is_empty());
    assert!(t.source.contains("t0 = vec4f(0.0, 0.0, 0.0, 1.0);"));
}

/// Stages that were translated apart pass whole vectors at fixed locations.
#[test]
fn stages_translated_apart_fit_together() {
    let vertex = valid(
        "vs.1.1\nmov oPos, v0\nmov oT3.xy, v7\nmov oD1, v5\n",
        &Options::default(),
    );
    let pixel = valid(
        "ps.1.4\ntexld r0, t3\nmul r0, r0, v1\n",
        &Options::default(),
    );
    assert_eq!(vertex.reflection.varyings, pixel.reflection.varyings);
    let locations: Vec<_> = vertex
        .reflection
        .varyings
        .iter()
        .map(|v| (v.location, v.components))
        .collect();
    assert_eq!(locations, [(3, 4), (9, 4)]);
}

#[test]
fn outputs_that_nobody_wrote_have_the_values_of_direct3d() {
    let vs = Shader::new("vs.1.1\nmov oPos, v0\n");
    let ps = Shader::new("ps.1.1\ntex t0\nmad r0, t0, v0, v1\n");
    let options = Options {
        fog: Some(Fog {
            table: FogMode::None,
            distance: FogDistance::Z,
        }),
        ..Options::default()
    };
    let source = valid_pair(&vs, &ps, &options).source;
    for line in [
        "out.t0 = vec2f();",
        "out.v0 = vec4f(1.0);",
        "out.v1 = vec4f();",
        "out.fog = 0.0;",
    ] {
        assert!(source.contains(line), "{line}\n{source}");
    }
}

#[test]
fn what_has_no_translation_is_refused() {
    let vs = Shader::new("vs.1.1\nmov oPos, v0\n");
    let refused = |vertex: bool, pixel: bool, options: &Options| {
        translate(
            vertex.then(|| vs.stage()),
            pixel.then(|| vs.stage()),
            options,
        )
        .unwrap_err()
    };
    assert_eq!(
        refused(false, false, &Options::default()),
        TranslateError::Nothing
    );
    let wrong = refused(false, true, &Options::default());
    assert!(matches!(
        wrong,
        TranslateError::WrongKind {
            place: ShaderKind::Pixel,
            ..
        }
    ));
    assert_eq!(wrong.to_string(), "vs.1.1 is no pixel shader");
    for name in ["", "main", "fn", "1_main", "a b_main", "vs", "ps_main"] {
        let options = Options {
            vertex_entry: name.into(),
            ..Options::default()
        };
        assert_eq!(
            refused(true, false, &options),
            TranslateError::EntryPoint(name.into())
        );
    }
    let options = Options {
        clip_planes: 7,
        ..Options::default()
    };
    assert_eq!(
        refused(true, false, &options),
        TranslateError::ClipPlanes(7)
    );
}

/// `t2` is read by nothing and `r1` is not part of the colour; both are left where they can be seen, and the function
/// is no entry point.
#[test]
fn registers_can_be_looked_at() {
    let vs = Shader::new("vs.1.1\nmov r3, v0\nmov oPos, r3\nmov a0.x, v0.x\nmov oFog.y, v0.x\n");
    let ps = Shader::new("ps.1.1\ntexkill t1\nmul r1, v0, v0\nmov r0, r1\n");
    let observed = Observed {
        vertex: [
            Slot::temp(3),
            Some(Slot::ADDRESS),
            Some(Slot::FOG),
            Slot::color_output(0),
        ]
        .into_iter()
        .flatten()
        .collect(),
        pixel: [Slot::temp(1), Slot::texcoord(2)]
            .into_iter()
            .flatten()
            .collect(),
    };
    let options = Options {
        observed: Some(observed),
        ..Options::default()
    };
    let source = valid_pair(&vs, &ps, &options).source;
    for line in [
        "observed_vs[0] = r3;",
        "observed_vs[1] = vec4f(f32(a0));",
        "observed_vs[2] = vec4f(oFog);",
        // What nothing writes is as Direct3D 8 leaves it: oD0 is 1.
        "var oD0 = vec4f(1.0);",
        "observed_vs[3] = oD0;",
        "observed_ps[0] = r1;",
        "observed_ps[1] = in.t2;",
        "if (killed) && !keep {",
    ] {
        assert!(source.contains(line), "{line} in\n{source}");
    }
    assert!(
        !source.contains("@vertex") && !source.contains("@fragment"),
        "{source}"
    );
}

/// Relative addressing reads the block, so that what `def` gives has to be put there: the first lines say so.
#[test]
fn moved_definitions_are_told_where_the_block_is() {
    let listing = "vs.1.1\ndef c7, 1, -0.5, 0, 2\nmov a0.x, v0.x\nmov oPos, c[a0.x]\n";
    let source = valid(listing, &Options::default()).source;
    let head = source.split("struct").next().unwrap_or_default();
    assert!(
        head.contains("c7 is 1.0, -0.5, 0.0, 2.0 by its def"),
        "{head}"
    );
    let fixed = valid(
        "vs.1.1\ndef c7, 1, -0.5, 0, 2\nmov oPos, c7\n",
        &Options::default(),
    );
    assert!(!fixed.source.contains("by its def"), "{}", fixed.source);
}

/// 65536 times 65536 is finite; what may be anything needs the rule that 0 times anything is 0.
#[test]
fn wild_inputs_are_guarded() {
    let source = |wild_inputs| {
        let options = Options {
            wild_inputs,
            ..Options::default()
        };
        valid("vs.1.1\nmul oPos, v0, c0\n", &options).source
    };
    assert!(!source(false).contains("mul_zero"));
    assert!(
        source(true).contains("mul_zero4(in.v0, vs.c[0])"),
        "{}",
        source(true)
    );
}

/// A stage samples at as many components as its own texture has, whatever the others are.
#[test]
fn textures_of_different_shapes_pass_what_each_needs() {
    let vs = Shader::new("vs.1.1\nmov oPos, v0\nmov oT1, v1\nmov oT2, v2\n");
    let ps = Shader::new("ps.1.1\ntex t0\ntexbem t1, t0\ntexbem t2, t0\nadd r0, t1, t2\n");
    let kinds = [TextureKind::Cube, TextureKind::Texture2D].map(Some);
    let passed = |first, second| -> Vec<(u32, usize)> {
        let mut options = Options::default();
        options.stages[1] = StageOptions::with_texture(first);
        options.stages[2] = StageOptions::with_texture(second);
        let varyings = valid_pair(&vs, &ps, &options).reflection.varyings;
        { varyings.iter() }
            .filter(|varying| varying.location > 0)
            .map(|varying| (varying.location, varying.components))
            .collect()
    };
    assert_eq!(passed(kinds[0], kinds[1]), [(1, 3), (2, 2)]);
    assert_eq!(passed(kinds[1], kinds[0]), [(1, 2), (2, 3)]);
    assert_eq!(passed(kinds[0], None), [(1, 3)]);
    assert_eq!(passed(None, kinds[1]), [(2, 2)]);
}

/// Without derivatives: nothing is left of the functions that take them, whatever the textures and biases are.
#[test]
fn level_zero_is_read_explicitly() {
    let listing = Shader::new("ps.1.4\ntexld r0, t0\ntexld r1, t1\nadd r0, r0, r1\n");
    for kind in [
        TextureKind::Texture2D,
        TextureKind::Cube,
        TextureKind::Volume,
    ] {
        for varied in [false, true] {
            let stage = StageOptions {
                seamless: varied,
                lod_bias: varied,
                ..StageOptions::with_texture(Some(kind))
            };
            let options = Options {
                stages: [stage; 8],
                level_zero: true,
                ..Options::default()
            };
            let translation = listing.translate(&options);
            validate(&translation.source);
            for implicit in [
                "textureSample(",
                "textureSampleBias",
                "Grad",
                "dpdx",
                "lod_bias",
            ] {
                assert!(
                    !translation.source.contains(implicit),
                    "{}",
                    translation.source
                );
            }
            assert!(translation.source.contains("textureSampleLevel"));
        }
    }
}

/// A bias or another range of depths makes the pixel stage set the depth, and fog go by it, but not that of a shader.
#[test]
fn depths_are_mapped_in_the_pixel_stage() {
    let vs = Shader::new("vs.1.1\nmov oPos, v0\n");
    let plain = Shader::new("ps.1.1\nmov r0, v0\n");
    let own = Shader::new("ps.1.4\ntexcrd r5.rgb, t0\nphase\ntexdepth r5\nmov r0, v0\n");
    let mut state = RenderState::default();
    let mapped = |state: &RenderState| Options::default().with_state(state);
    assert!(!mapped(&state).mapped_depth);
    state.depth.bias = 1;
    assert!(mapped(&state).mapped_depth);
    state.depth.bias = 0;
    state.viewport.min_z = 0.5;
    let field = |translation: &Translation| {
        let fields = |binding: &Binding| match &binding.resource {
            Resource::Uniform { fields, .. } => fields.clone(),
            _ => Vec::new(),
        };
        let all = translation.reflection.bindings.iter().flat_map(fields);
        all.into_iter()
            .any(|field| field.field == Field::DepthMapping)
    };
    let translation = valid_pair(&vs, &plain, &mapped(&state));
    assert!(field(&translation));
    assert!(
        translation
            .reflection
            .pixel
            .is_some_and(|pixel| pixel.writes_depth)
    );
    // A shader with a depth of its own leaves the field out, unless fog asks for it.
    assert!(!field(&valid_pair(&vs, &own, &mapped(&state))));
    state.fog.enable = true;
    state.fog.table = FogMode::Linear;
    assert!(field(&valid_pair(&vs, &own, &mapped(&state))));
    state.fog.distance = FogDistance::W;
    assert!(!field(&valid_pair(&vs, &own, &mapped(&state))));
}

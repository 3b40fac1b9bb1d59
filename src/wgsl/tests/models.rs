//! Translations under the hardware models: where numbers are brought into steps, and where they need not be.

use super::support::{Shader, validate};
use crate::isa::{Opcode, Version};
use crate::kernel;
use crate::policy::Model;
use crate::texture::TextureKind;
use crate::wgsl::{Options, StageOptions};

fn translated(model: Model, listing: &str, options: &Options) -> String {
    let lowering = kernel::Options {
        model,
        ..kernel::Options::default()
    };
    let source = Shader::projected(listing, &lowering)
        .translate(options)
        .source;
    validate(&source);
    source
}

fn line<'s>(source: &'s str, start: &str) -> &'s str {
    let found = (source.lines()).find(|line| line.trim_start().starts_with(start));
    found
        .unwrap_or_else(|| panic!("no line {start}\n{source}"))
        .trim()
}

#[test]
fn numbers_are_rounded_once() {
    let listing = "ps.1.1\ndef c0, 0.5, -2, 0.1, 1\ntex t0\nmul_x2 r0, t0, v0\nmad r0.rgb, r0, c0, t0\nmov r0.a, r0\n";
    let source = translated(Model::Gf3, listing, &Options::default());
    // 0.5 is 128/255, 0.1 is 26/255 (25.5 up); −2 is clamped.
    assert!(
        source.contains(&format!(
            "const c0 = vec4f({:?}, -1.0, {:?}, 1.0);",
            128.0f32 / 255.0,
            26.0f32 / 255.0
        )),
        "{source}"
    );
    assert_eq!(
        line(&source, "let v0"),
        "let v0 = gf3_vec4(saturate(in.v0));"
    );
    // What is sampled is no number of the combiners; colours and registers are.
    assert_eq!(
        line(&source, "r0 = gf3"),
        "r0 = gf3_vec4(gf3_vec4(t0) * v0 * 2.0);"
    );
    assert!(
        source.contains("gf3_vec3(r0.rgb * c0.rgb + gf3_vec3(t0.rgb))"),
        "{source}"
    );
    // A number that is handed on is rounded already.
    assert_eq!(line(&source, "r0.a ="), "r0.a = r0.a;");
    let plain = translated(Model::Float, listing, &Options::default());
    assert!(
        !plain.contains("gf3") && !plain.contains("floor"),
        "{plain}"
    );
}

#[test]
fn combiners_clamp_before_they_map() {
    let listing = "ps.1.1\nmov r0, v0\nmul r0.rgb, 1-r0, r0_bx2\n+mov r0.a, -r0_bias\n";
    let source = translated(Model::Gf3, listing, &Options::default());
    for part in [
        "1.0 - saturate(r0.rgb)",
        "2.0 * max(r0.rgb, vec3f()) - 1.0",
        "0.5 - max(r0.a, 0.0)",
    ] {
        assert!(source.contains(part), "{part}\n{source}");
    }
    let source = translated(Model::R200, listing, &Options::default());
    assert!(
        !source.contains("max(") && source.contains("r200_vec4(saturate(in.v0))"),
        "{source}"
    );
}

#[test]
fn constants_from_outside_are_rounded_where_they_come_in() {
    let options = Options {
        overridable_definitions: true,
        ..Options::default()
    };
    let listing = "ps.1.1\ndef c0, 1, 1, 1, 1\nmul r0, v0, c0\n";
    let let_c0 = |model| line(&translated(model, listing, &options), "let c0").to_string();
    assert_eq!(let_c0(Model::Gf3), "let c0 = gf3_vec4(ps.c[0]);");
    assert_eq!(
        let_c0(Model::R200),
        "let c0 = r200_vec4(clamp(ps.c[0], vec4f(-1.0), vec4f(1.0)));"
    );
    // The eye of texm3x3spec is a float, and so the combiners round the constant where they read it.
    let listing = "ps.1.1\ntex t0\ntexm3x3pad t1, t0\ntexm3x3pad t2, t0\ntexm3x3spec t3, t0, c0\nmul r0, t3, c0\n";
    let mut options = Options::default();
    options.stages[3] = StageOptions::with_texture(Some(TextureKind::Cube));
    let source = translated(Model::Gf3, listing, &options);
    assert_eq!(
        line(&source, "let c0"),
        "let c0 = clamp(ps.c[0], vec4f(-1.0), vec4f(1.0));"
    );
    assert!(source.contains("gf3_vec4(c0)"), "{source}");
}

#[test]
fn registers_of_the_radeon_are_rounded_whoever_writes_them() {
    let listing = "ps.1.4\ntexld r0, t0\ntexcrd r1.rgb, t1\nphase\ntexld r2, r1\nadd r0, r0, r2\n";
    let source = translated(Model::R200, listing, &Options::default());
    assert_eq!(
        line(&source, "r0 = r200"),
        "r0 = r200_vec4(textureSample(texture0, sampler0, in.t0.xy));"
    );
    assert!(source.contains("r0 = r200_vec4(r0 + r2);"), "{source}");
    assert!(source.contains("r200_vec3(in.t1"), "{source}");
}

/// Every instruction with every source modifier gives a module that is valid under every model.
#[test]
fn everything_translates_under_every_model() {
    for version in Version::all().filter(|version| version.kind() == crate::isa::ShaderKind::Pixel)
    {
        for opcode in [
            Opcode::Mov,
            Opcode::Add,
            Opcode::Sub,
            Opcode::Mul,
            Opcode::Mad,
            Opcode::Lrp,
            Opcode::Dp3,
            Opcode::Dp4,
            Opcode::Cnd,
            Opcode::Cmp,
        ] {
            let Some(form) = opcode.form(version) else {
                continue;
            };
            for source in [
                "r0", "-r0", "r0_bias", "-r0_bias", "r0_bx2", "-r0_bx2", "1-r0", "r0_x2", "-r0_x2",
            ] {
                if source.contains("_x2") && version != Version::Ps14 {
                    continue;
                }
                for mask in ["", ".rgb", ".a"] {
                    let sources = vec![source; form.sources.len()].join(", ");
                    let listing = format!(
                        "{version}\nmov r0, v0\n{}_x2_sat r1{mask}, {sources}\nmov r0, r1\n",
                        opcode.mnemonic()
                    );
                    for model in Model::all() {
                        translated(model, &listing, &Options::default());
                    }
                }
            }
        }
    }
}

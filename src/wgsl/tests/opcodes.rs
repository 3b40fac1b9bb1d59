//! Every instruction of every version, with its modifiers, becomes WGSL that `naga` accepts.

use super::support::{Shader, valid, valid_pair};
use crate::kernel;
use crate::kernel::Projection;
use crate::raster::{Compare, FogDistance, FogMode};
use crate::texture::{AddressMode, Filter, TextureKind};
use crate::wgsl::{Fog, Options, Points, StageOptions};

/// Options that differ in what they make of stages, constants and dot products.
fn variants() -> Vec<Options> {
    let kinds = [
        None,
        Some(TextureKind::Texture2D),
        Some(TextureKind::Cube),
        Some(TextureKind::Volume),
    ];
    let mut variants = Vec::new();
    for kind in kinds {
        for varied in [false, true] {
            let stage = StageOptions {
                seamless: varied,
                lod_bias: varied,
                wide_texels: varied,
                ..StageOptions::with_texture(kind)
            };
            variants.push(Options {
                stages: [stage; 8],
                exact_dots: varied,
                overridable_definitions: varied,
                flat_shading: varied,
                half_pixel: !varied,
                ..Options::default()
            });
        }
    }
    variants
}

#[test]
fn vertex_instructions() {
    let scalar = ["rcp", "rsq", "exp", "log", "expp", "logp"];
    let (one, two) = (
        ["mov", "lit", "frc"],
        [
            "add", "sub", "mul", "min", "max", "slt", "sge", "dp3", "dp4", "dst",
        ],
    );
    let masks = ["", ".x", ".y", ".w", ".xy", ".xz", ".yzw", ".xyz", ".xw"];
    let mut lines = Vec::new();
    for mask in masks {
        for name in scalar {
            lines.push(format!("{name} r1{mask}, v0.y"));
            lines.push(format!("{name} oT1{mask}, -r2.w"));
        }
        for name in one {
            if name != "frc" || [".y", ".xy"].contains(&mask) {
                lines.push(format!("{name} r1{mask}, r2.zyxw"));
            }
        }
        for name in two {
            lines.push(format!("{name} r1{mask}, v0, -r2.wzyx"));
            lines.push(format!("{name} oT0{mask}, c5.x, -r2.y"));
            // What rcp left may be infinite, so that products are guarded.
            lines.push(format!("{name} r3{mask}, r4.xyyz, v0"));
        }
        lines.push(format!("mad r1{mask}, v0, -r2.x, -c3"));
        lines.push(format!("mad r1{mask}, r4, v0, r2"));
    }
    for (name, mask) in [
        ("m4x4", ""),
        ("m4x3", ".xyz"),
        ("m3x4", ""),
        ("m3x3", ".xyz"),
        ("m3x2", ".xy"),
    ] {
        lines.push(format!("{name} r1{mask}, v0, c4"));
        // The destination is a source.
        lines.push(format!("{name} r2{mask}, r2, c4"));
        lines.push(format!("{name} oPos{mask}, -v0.wzyx, c4"));
    }
    lines.extend(
        [
            "nop",
            "mov oPts, c1",
            "mov oPts.x, c1.y",
            "mov oFog, c1.w",
            "mov oFog.x, r2.y",
        ]
        .map(String::from),
    );
    lines.extend(["mov a0.x, v0.y", "mov a0.x, c1"].map(String::from));
    for line in &lines {
        let listing = format!(
            "vs.1.1\ndef c1, 0, 0.5, 1, 2\nmov oPos, v0\nmov r2, v1\nmov r1, v0\nmul r4, r2, c7\nmul r4, r4, r4\n\
             mul r4, r4, r4\nmul r4, r4, r4\n{line}\nadd oD0, r1, c1\n"
        );
        for exact_dots in [false, true] {
            let options = Options {
                exact_dots,
                ..Options::default()
            };
            valid(&listing, &options);
        }
    }
}

#[test]
fn relative_addressing() {
    let listing = "vs.1.1\ndef c3, 1, 2, 3, 4\nmov a0.x, v1.x\nm4x4 oPos, v0, c[a0.x + 12]\nadd oD0, c[a0.x], -c3\n";
    let t = valid(listing, &Options::default());
    assert!(t.source.contains("constant_at(a0 + 15)") && t.source.contains("constant_at(a0)"));
    let vertex = t.reflection.vertex.unwrap();
    // The whole file of 96 registers, the defined one among them.
    assert_eq!(vertex.constants, std::slice::from_ref(&(0..96)));
    assert!(vertex.relative);
    assert!(vertex.definitions[0].in_uniform);
    assert!(t.source.contains("index >= 96"));
}

#[test]
fn pixel_arithmetic() {
    let two = ["add", "sub", "mul", "dp3"];
    let sources = [
        "r0", "-r0", "t0_bias", "-t0_bias", "t0_bx2", "-t0_bx2", "1-t0", "c0.a", "v0.a",
    ];
    let results = ["", "_x2", "_x4", "_d2", "_sat", "_x2_sat"];
    let masks = ["", ".rgb", ".a"];
    for version in ["ps.1.0", "ps.1.1", "ps.1.2", "ps.1.3"] {
        let newer = ["ps.1.2", "ps.1.3"].contains(&version);
        let mut lines = Vec::new();
        for mask in masks {
            for source in sources {
                let result = results[lines.len() % results.len()];
                for name in two.iter().filter(|name| **name != "dp3" || mask != ".a") {
                    lines.push(format!("{name}{result} r1{mask}, {source}, t1"));
                    lines.push(format!("{name}{result} r1{mask}, t1, {source}"));
                }
                lines.push(format!("mov{result} r1{mask}, {source}"));
                lines.push(format!("mad{result} r1{mask}, r0, {source}, t1"));
                lines.push(format!("mad{result} r1{mask}, r0, t1, {source}"));
                lines.push(format!("lrp{result} r1{mask}, {source}, t0, t1"));
                lines.push(format!("lrp{result} r1{mask}, t0, t1, {source}"));
                lines.push(format!("cnd{result} r1{mask}, r0.a, {source}, t1"));
                if newer {
                    lines.push(format!("cmp{result} r1{mask}, {source}, t1, -t0"));
                    lines.push(format!("dp4{result} r1, {source}, t1"));
                }
            }
        }
        for line in lines {
            let listing = format!(
                "{version}\ndef c0, 0.5, 1, 0, -1\ntex t0\ntex t1\nmov r0, t0\n{line}\nadd r0, r1, c3\n"
            );
            valid(&listing, &Options::default());
        }
    }
}

#[test]
fn pixel_arithmetic_of_1_4() {
    let sources = [
        "r1",
        "-r1",
        "r1_bias",
        "-r1_bx2.g",
        "1-r1.b",
        "r1_x2",
        "-r1_x2",
        "c0.a",
        "v0.a",
    ];
    let results = ["", "_x2", "_x8", "_d8", "_d4_sat", "_sat"];
    for mask in ["", ".r", ".g", ".rb", ".gba", ".rgb", ".a"] {
        for (i, source) in sources.iter().enumerate() {
            let result = results[i % results.len()];
            for line in [
                format!("mov{result} r2{mask}, {source}"),
                format!("add{result} r2{mask}, {source}, r0"),
                format!("sub{result} r2{mask}, r0, {source}"),
                format!("mul{result} r2{mask}, r0, {source}"),
                format!("mad{result} r2{mask}, {source}, r0, {source}"),
                format!("lrp{result} r2{mask}, {source}, r0, {source}"),
                format!("cnd{result} r2{mask}, {source}, r0, c1"),
                format!("cmp{result} r2{mask}, r0, {source}, r0.g"),
                format!("dp4{result} r2{mask}, r0, {source}"),
            ] {
                let listing = format!(
                    "ps.1.4\ndef c0, 0.5, 1, 0, -1\ntexld r0, t0\ntexld r1, t1\nmov r2, r1\n{line}\nmov r0, r2\n"
                );
                valid(&listing, &Options::default());
            }
        }
    }
}

#[test]
fn texture_instructions() {
    let listings = [
        "ps.1.1\ntex t0\ntexbem t1, t0\ntexbeml t2, t0\ntexcoord t3\nadd r0, t1, t3\n",
        "ps.1.1\ntex t0\ntexreg2ar t1, t0\ntexreg2gb t2, t0\ntexkill t3\nadd r0, t1, t2\n",
        "ps.1.1\ntex t0\ntexm3x2pad t1, t0_bx2\ntexm3x2tex t2, t0_bx2\nmov r0, t2\n",
        "ps.1.1\ntex t0\ntexm3x3pad t1, t0_bx2\ntexm3x3pad t2, t0_bx2\ntexm3x3tex t3, t0_bx2\nmov r0, t3\n",
        "ps.1.1\ntex t0\ntexm3x3pad t1, t0\ntexm3x3pad t2, t0\ntexm3x3spec t3, t0, c0\nmov r0, t3\n",
        "ps.1.1\ntex t0\ntexm3x3pad t1, t0\ntexm3x3pad t2, t0\ntexm3x3vspec t3, t0\nmov r0, t3\n",
        "ps.1.2\ntex t0\ntexreg2rgb t1, t0\ntexdp3tex t2, t0_bx2\ntexdp3 t3, t0\nadd r0, t2, t3\n",
        "ps.1.2\ntex t0\ntexm3x3pad t1, t0\ntexm3x3pad t2, t0\ntexm3x3 t3, t0\nmov r0, t3\n",
        "ps.1.3\ntex t0\ntexm3x2pad t1, t0\ntexm3x2depth t2, t0\nmov r0, t0\n",
        "ps.1.4\ntexld r0, t0_dw.xyw\ntexcrd r1.rgb, t1\ntexcrd r2.rg, t2_dw.xyw\ntexld r3, t3.xyw\nphase\n\
         texld r4, r0_dz\ntexld r5, r1\ntexkill r1\ntexkill t4\nmov r0, r4\n",
        "ps.1.4\ntexcrd r5.rgb, t0\nphase\ntexdepth r5\nmov r0, c0\n",
        "ps.1.4\ntexld r1, t1\ntexcrd r0.rgb, t0\nbem r2.rg, r0, r1\nmov r2.b, c0\nphase\ntexld r3, r2\nmov r0, r3\n",
    ];
    for listing in listings {
        for options in variants() {
            valid(listing, &options);
        }
    }
}

#[test]
fn projected_stages() {
    let options = kernel::Options {
        projection: [
            Projection::Third,
            Projection::Fourth,
            Projection::None,
            Projection::None,
            Projection::None,
            Projection::None,
            Projection::None,
            Projection::None,
        ],
        ..kernel::Options::default()
    };
    let shader = Shader::projected(
        "ps.1.1\ntex t0\ntex t1\ntexbem t2, t1\nadd r0, t0, t2\n",
        &options,
    );
    for options in variants() {
        super::support::validate(&shader.translate(&options).source);
    }
    let t = shader.translate(&Options::default());
    assert!(
        t.source
            .contains("coordinates = divide(in.t0.xy, in.t0.z);"),
        "{}",
        t.source
    );
    assert!(
        t.source
            .contains("coordinates = divide(in.t1.xy, in.t1.w);"),
        "{}",
        t.source
    );
}

#[test]
fn address_modes_without_sampler() {
    let modes = [
        AddressMode::Border,
        AddressMode::MirrorOnce,
        AddressMode::Wrap,
    ];
    for kind in [
        TextureKind::Texture2D,
        TextureKind::Volume,
        TextureKind::Cube,
    ] {
        for u in modes {
            for v in modes {
                for filter in [Filter::Point, Filter::Linear] {
                    let stage = StageOptions {
                        address: [u, v, u],
                        mag: filter,
                        min: filter,
                        ..StageOptions::with_texture(Some(kind))
                    };
                    let options = Options {
                        stages: [stage; 8],
                        ..Options::default()
                    };
                    valid("ps.1.4\ntexld r0, t0\n", &options);
                    valid("ps.1.1\ntex t0\ntexbem t1, t0\nmov r0, t1\n", &options);
                }
            }
        }
    }
}

#[test]
fn states_around_the_shaders() {
    let vs = Shader::new(
        "vs.1.1\nm4x4 oPos, v0, c0\nmov oT0.x, v7\nmov oFog.x, v0.z\nmov oPts.x, v1.x\nmov oD0.xyz, v5\n",
    );
    let bare = Shader::new("vs.1.1\nmov oPos, v0\n");
    let ps = Shader::new("ps.1.1\ntex t0\nmul r0, t0, v0\nadd r0, r0, v1\n");
    let deep =
        Shader::new("ps.1.4\ntexcrd r5.rgb, t0\ntexkill t1\nphase\ntexdepth r5\nmov r0, v0\n");
    let tables = [FogMode::None, FogMode::Exp, FogMode::Exp2, FogMode::Linear];
    for (i, table) in tables.into_iter().enumerate() {
        for distance in [FogDistance::Z, FogDistance::W] {
            for points in [Points::None, Points::Quads, Points::Sprites] {
                for compare in Compare::ALL {
                    let options = Options {
                        fog: Some(Fog { table, distance }),
                        alpha_test: Some(*compare),
                        points,
                        clip_planes: [0, 1, 4, 6][i],
                        half_pixel: compare.number() % 2 == 0,
                        flat_shading: compare.number() % 3 == 0,
                        ..Options::default()
                    };
                    for vertex in [&vs, &bare] {
                        for pixel in [&ps, &deep] {
                            valid_pair(vertex, pixel, &options);
                        }
                    }
                    super::support::validate(&vs.translate(&options).source);
                    super::support::validate(&ps.translate(&options).source);
                }
            }
        }
    }
}

#[test]
fn constants_that_cannot_be_computed_beforehand() {
    // The product of the two constants overflows, which WGSL refuses in what the compiler evaluates.
    valid(
        "vs.1.1\ndef c0, 3e38, 3e38, 3e38, 3e38\ndef c1, 1e10, 0, 0, 1\nmul r0, c0, c0\nmad oPos, c1, c1, r0\n",
        &Options::default(),
    );
    valid(
        "vs.1.1\ndef c0, 3e38, 0, 1, 200\nexp r0, c0.w\nexpp r0.y, c0\nmov oPos, r0\n",
        &Options::default(),
    );
    valid(
        "vs.1.1\ndef c0, 0, 0, 0, 0\nrcp r0, c0.w\nrsq r1, c0.w\nlog r2, c0.w\nadd r0, r0, r1\nadd oPos, r0, r2\n",
        &Options::default(),
    );
    // Listings cannot hold them, tokens can.
    let mut shader = Shader::new("vs.1.1\ndef c0, 1, 1, 1, 1\nmul oPos, v0, c0\n");
    shader.redefine([f32::INFINITY, f32::NEG_INFINITY, 1e-40, -0.0]);
    let source = shader.translate(&Options::default()).source;
    super::support::validate(&source);
    assert!(
        source.contains("vec4u(0x7f800000, 0xff800000, 0x000116c2, 0x80000000)"),
        "{source}"
    );
    // An infinite factor needs the guard.
    assert!(source.contains("oPos = mul_zero4(in.v0, c0);"), "{source}");
}

#[test]
fn what_only_the_lenient_dialect_takes() {
    // Coordinates as texels, a constant beyond the file, an address register that nobody wrote.
    valid("ps.1.1\nadd r0, t0, t1\n", &Options::default());
    let t = valid(
        "vs.1.1\nadd oPos, v0, c200\nmov oD0, c[a0.x]\n",
        &Options::default(),
    );
    assert!(t.source.contains("in.v0 + vec4f()"));
    valid(
        "vs.1.1\nm3x2 oFog.xy, v0, c0\nmov oPos, v0\nmov oT3.xz, v0\n",
        &Options::default(),
    );
    valid("ps.1.4\n", &Options::default());
    valid("vs.1.1\n", &Options::default());
}

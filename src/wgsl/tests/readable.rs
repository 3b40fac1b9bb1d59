//! How translations look.

use super::support::{Shader, check_form, valid, valid_pair};
use crate::texture::TextureKind;
use crate::wgsl::number::literal;
use crate::wgsl::{Options, StageOptions};

const VERTEX: &str = include_str!("../../../asm/stained_glass/stained_glass.vsh");
const PIXEL: &str = include_str!("../../../asm/stained_glass/stained_glass.psh");

/// The pane of the article, with its two cube maps.
fn pane() -> String {
    let mut options = Options::default();
    for stage in [2, 4] {
        options.stages[stage] = StageOptions {
            seamless: stage == 4,
            ..StageOptions::with_texture(Some(TextureKind::Cube))
        };
    }
    valid_pair(&Shader::new(VERTEX), &Shader::new(PIXEL), &options).source
}

/// The one function of a bare listing, without comments, declarations and empty lines.
fn statements(listing: &str) -> Vec<String> {
    let source = valid(listing, &Options::default()).source;
    let (_, function) = super::support::functions(&source).pop().unwrap();
    (function.lines().skip(1))
        .map(str::trim)
        .filter(|line| !line.is_empty() && !line.starts_with("//") && !line.starts_with("var "))
        .map(String::from)
        .collect()
}

/// The expected text was read line by line beside the listings; whoever changes it reads it again.
#[test]
fn stained_glass() {
    let actual = pane();
    if actual != include_str!("stained_glass.wgsl") {
        let beside = concat!(env!("CARGO_MANIFEST_DIR"), "/target/stained_glass.wgsl");
        std::fs::write(beside, &actual).unwrap();
        panic!("the translation has changed: compare it with {beside}");
    }
}

#[test]
fn every_line_is_quoted_once_and_in_order() {
    let source = pane();
    check_form(VERTEX, "vs_main", &source);
    check_form(PIXEL, "ps_main", &source);
}

#[test]
fn a_quoted_line_stays_one_comment() {
    // Line ends of WGSL that are none in a listing, and a byte of a legacy code page.
    let listing = "ps.1.1\n\n  mov   r0, c0 ; a\u{b}b\u{2028}discard;\u{85}c\r\n; tail\n";
    let source = valid(listing, &Options::default()).source;
    assert!(
        source.contains("// 3: mov r0, c0 ; a b discard; c\n"),
        "{source}"
    );
    assert!(source.contains("// 4: ; tail\n"), "{source}");
    let long = format!("ps.1.1\nmov r0, c0 ; {}\n", "x".repeat(100_000));
    assert!(valid(&long, &Options::default()).source.len() < 2000);
}

/// Numbers read back to the same bits, by the rule for literals without suffix (64 bits first) and with `f`.
#[test]
fn numbers_read_back() {
    let mut bits = 0x9e37_79b9u32;
    let mut values = vec![
        0.0,
        -0.0,
        0.9,
        1.0,
        0.1,
        f32::MAX,
        f32::MIN,
        f32::MIN_POSITIVE,
        1e-45,
        16_777_216.0,
    ];
    for _ in 0..20_000 {
        bits = bits.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        values.push(f32::from_bits(bits));
    }
    for value in values.into_iter().filter(|value| value.is_finite()) {
        let text = literal(value).unwrap();
        let read = match text.strip_suffix('f') {
            Some(single) => single.parse::<f32>().unwrap(),
            None => {
                let wide: f64 = text.parse().unwrap();
                assert!(wide.abs() <= f64::from(f32::MAX), "{text}");
                wide as f32
            }
        };
        assert_eq!(read.to_bits(), value.to_bits(), "{text}");
        assert!(text.len() <= format!("{value:?}").len() + 1);
    }
    assert_eq!(literal(0.9).unwrap(), "0.9");
    assert_eq!(literal(f32::NAN), None);
}

/// The same through `naga`: what it reads is what was meant.
#[test]
fn constants_arrive_in_the_module() {
    let values = [
        [0.1, -0.0, 1e-40, f32::MAX],
        [1e-45, 3.0e-7, -16_777_216.0, 0.333_333_34],
    ];
    for value in values {
        let mut shader = Shader::new("vs.1.1\ndef c0, 1, 1, 1, 1\nadd oPos, v0, c0\n");
        shader.redefine(value);
        let module = super::support::validate(&shader.translate(&Options::default()).source);
        let literals: Vec<u32> = (module.entry_points[0].function.expressions.iter())
            .filter_map(|(_, expression)| match expression {
                naga::Expression::Literal(naga::Literal::F32(number)) => Some(number.to_bits()),
                _ => None,
            })
            .collect();
        for number in value {
            assert!(
                literals.contains(&number.to_bits()),
                "{number:?} is not in {literals:x?}"
            );
        }
    }
}

#[test]
fn pairs_read_before_they_write() {
    // r0.a takes the red that the first half replaces: the product waits.
    let listing = "ps.1.1\ntex t0\nmov r0, t0\nmul r0.rgb, r0, t0\n+mov r0.a, r0.b\n";
    assert_eq!(
        statements(listing),
        [
            "t0 = textureSample(texture0, sampler0, in.t0.xy);",
            "r0 = t0;",
            "let r0_rgb = r0.rgb * t0.rgb;",
            "r0.a = r0.b;",
            "r0 = vec4f(r0_rgb, r0.a);",
            "return r0;",
        ]
    );
}

#[test]
fn matrix_rows_read_before_they_write() {
    let lines = statements("vs.1.1\nmov r3, v0\nm3x3 r3.xyz, r3, c5\nmov oPos, r3\n");
    assert_eq!(
        lines[1],
        "r3 = vec4f(dot(r3.xyz, vs.c[5].xyz), dot(r3.xyz, vs.c[6].xyz), dot(r3.xyz, vs.c[7].xyz), r3.w);"
    );
}

#[test]
fn products_are_guarded_only_where_a_factor_may_be_infinite() {
    let guards = |listing: &str| {
        valid(listing, &Options::default())
            .source
            .matches("_zero")
            .count()
    };
    // A vector over its own length is not longer than 1, and the cosine of two such vectors is not either.
    let lit = "vs.1.1\ndp3 r1.w, v3, v3\nrsq r1.w, r1.w\nmul r1.xyz, v3, r1.w\ndp3 r2.w, v0, v0\nrsq r3.w, r2.w\n\
               mul r2.xyz, v0, r3.w\ndp3 r3.x, r1, r2\nrcp r3.y, v1.x\nmul r3.x, r3.x, r3.y\nmul oD0, r3.x, c9\n\
               mov oPos, v0\n";
    assert_eq!(guards(lit), 0);
    // 65536 to the eighth power is 2^128, more than any float: the product of two such numbers needs the guard, and
    // so does one with any number that may be 0; one with a constant that is not 0 does not.
    let power = "vs.1.1\ndef c1, 2, 2, 2, 2\nmul r0, v0, v0\nmul r0, r0, r0\nmul r0, r0, r0\n";
    assert_eq!(guards(&format!("{power}mov oPos, r0\n")), 0);
    assert_eq!(guards(&format!("{power}mul oPos, r0, c1\n")), 0);
    // The helper and its call.
    assert_eq!(guards(&format!("{power}mul oPos, r0, v1\n")), 2);
    assert_eq!(guards(&format!("{power}mad oPos, v1, r0, v2\n")), 2);
    assert!(guards(&format!("{power}dp4 oPos, v1, r0\n")) >= 3);
    // A vector that is not divided by its own length.
    let other = "vs.1.1\ndp3 r1.w, v3, v3\nrsq r1.w, r1.w\nmul r1, v0, r1.w\nmul oPos, r1, v1\n";
    assert_eq!(guards(other), 2);
    // The register was written again between the length and its use.
    let stale = "vs.1.1\nmov r0, v3\ndp3 r1.w, r0, r0\nrsq r1.w, r1.w\nmov r0, v0\nmul r1, r0, r1.w\nmul oPos, r1, v1\n";
    assert_eq!(guards(stale), 2);
}

#[test]
fn masks_with_gaps() {
    assert_eq!(
        statements("ps.1.4\ntexld r0, t0\nmul r0.ra, r0, c1\n"),
        [
            "let c1 = clamp(ps.c[1], vec4f(-1.0), vec4f(1.0));",
            "r0 = textureSample(texture0, sampler0, in.t0.xy);",
            "{",
            "let ra = r0.ra * c1.ra;",
            "r0.r = ra.x;",
            "r0.a = ra.y;",
            "}",
            "return r0;",
        ]
    );
}

#[test]
fn discards_come_last() {
    let lines = statements("ps.1.1\ntexkill t0\ntex t1\ntexkill t2\nmov r0, t1\n");
    assert_eq!(
        lines,
        [
            "killed = any(in.t0.xyz < vec3f());",
            "t1 = textureSample(texture1, sampler1, in.t1.xy);",
            "killed = killed || any(in.t2.xyz < vec3f());",
            "r0 = t1;",
            "if killed {",
            "discard;",
            "}",
            "return r0;",
        ]
    );
}

#[test]
fn a_test_that_nothing_passes_asks_for_nothing() {
    let options = Options {
        alpha_test: Some(crate::raster::Compare::Never),
        ..Options::default()
    };
    let source = valid("ps.1.1\ntexkill t0\nmov r0, c0\n", &options).source;
    assert!(source.contains("\n    discard;\n"), "{source}");
    assert!(
        !source.contains("killed") && !source.contains("if "),
        "{source}"
    );
}

#[test]
fn what_is_nan_is_spelled_out_where_it_may_come_up() {
    let fog = Options {
        fog: Some(crate::wgsl::Fog {
            table: crate::raster::FogMode::None,
            distance: crate::raster::FogDistance::Z,
        }),
        ..Options::default()
    };
    let listing = "vs.1.1\nmov oPos, v0\nmov a0.x, v1.x\nmov oD0, c[a0.x]\nmov oFog, v2.x\n";
    let source = |wild_inputs| {
        let options = Options {
            wild_inputs,
            ..fog.clone()
        };
        let ps = Shader::new("ps.1.1\nmov r0, v0\n");
        valid_pair(&Shader::new(listing), &ps, &options).source
    };
    for line in ["a0 = i32(floor(in.v1.x));", "out.fog = saturate(oFog);"] {
        assert!(source(false).contains(line), "{line}\n{}", source(false));
    }
    for line in ["a0 = address(in.v1.x);", "out.fog = fog_factor(oFog);"] {
        assert!(source(true).contains(line), "{line}\n{}", source(true));
    }
}

#[test]
fn a_definition_that_is_clamped_says_so() {
    let source = |listing| valid(listing, &Options::default()).source;
    let clamped = source("ps.1.1\ndef c0, 2, 0, 0, 1\nmov r0, c0\n");
    assert!(clamped.contains("are clamped to -1…1"), "{clamped}");
    let kept = source("ps.1.1\ndef c0, 1, 0, -1, 1\nmov r0, c0\n");
    assert!(!kept.contains("clamped"), "{kept}");
}

#[test]
fn what_an_instruction_writes_in_parts_is_one_assignment() {
    assert_eq!(
        statements("ps.1.1\ntexcoord t0\nmov r0, t0\n"),
        [
            "t0 = vec4f(saturate(in.t0.xyz), 1.0);",
            "r0 = t0;",
            "return r0;",
        ]
    );
    let lookup = "ps.1.2\ntex t0\ntexdp3tex t1, t0\nmov r0, t1\n";
    assert_eq!(
        statements(lookup)[1],
        "coordinates = vec2f(dot(in.t1.xyz, t0.rgb), 0.0);"
    );
    let reflection =
        "ps.1.1\ntex t0\ntexm3x3pad t1, t0\ntexm3x3pad t2, t0\ntexm3x3vspec t3, t0\nmov r0, t3\n";
    assert_eq!(
        statements(reflection)[4],
        "eye = vec3f(in.t1.w, in.t2.w, in.t3.w);"
    );
}

#[test]
fn a_definition_that_is_left_to_others_says_so() {
    let listing = "vs.1.1\ndef c9, 1, 2, 3, 4\nmov a0.x, v1.x\nmov oPos, c[a0.x]\n";
    let source = valid(listing, &Options::default()).source;
    let (_, rest) = source.split_once("// 2: def c9, 1, 2, 3, 4\n").unwrap();
    let next = rest.lines().next().unwrap().trim();
    assert!(
        next.starts_with("// c9 is in the uniform block"),
        "{source}"
    );
}

//! Programs that nobody would write.

use super::support::{Shader, check_form, validate};
use crate::texture::{AddressMode, TextureKind};
use crate::wgsl::{Options, StageOptions};
use proptest::prelude::*;

const MASKS: [&str; 15] = [
    "", ".x", ".y", ".z", ".w", ".xy", ".xz", ".xw", ".yz", ".yw", ".zw", ".xyz", ".xyw", ".xzw",
    ".yzw",
];

fn one_of(texts: &'static [&'static str]) -> impl Strategy<Value = &'static str> {
    proptest::sample::select(texts)
}

fn operands(count: usize, sources: BoxedStrategy<String>) -> impl Strategy<Value = String> {
    proptest::collection::vec(sources, count).prop_map(|sources| sources.join(", "))
}

fn vertex_line() -> impl Strategy<Value = String> {
    const SWIZZLES: &[&str] = &["", ".x", ".w", ".wzyx", ".xxyz", ".yzw"];
    const FROM: &[&str] = &[
        "r0",
        "r1",
        "r2",
        "v0",
        "v3",
        "c4",
        "c9",
        "c[a0.x + 3]",
        "-r1",
        "-c4",
        "-v0",
    ];
    const TO: &[&str] = &[
        "r0", "r1", "r2", "oPos", "oD0", "oD1", "oT0", "oT7", "oFog", "oPts",
    ];
    let source = (one_of(FROM), one_of(SWIZZLES))
        .prop_map(|(r, s)| format!("{r}{s}"))
        .boxed();
    let write = (one_of(TO), one_of(&MASKS)).prop_map(|(r, m)| format!("{r}{m}"));
    let by_count = prop_oneof![
        (
            one_of(&["mov", "lit", "rcp", "rsq", "exp", "log", "expp", "logp"]),
            Just(1usize)
        ),
        (
            one_of(&[
                "add", "sub", "mul", "min", "max", "slt", "sge", "dp3", "dp4", "dst"
            ]),
            Just(2)
        ),
        (Just("mad"), Just(3)),
    ];
    let plain = (by_count, write).prop_flat_map(move |((name, count), to)| {
        operands(count, source.clone()).prop_map(move |from| format!("{name} {to}, {from}"))
    });
    let matrix = (
        one_of(&[
            "m4x4 r0",
            "m4x3 r1.xyz",
            "m3x4 r2",
            "m3x3 r0.xyz",
            "m3x2 r1.xy",
        ]),
        one_of(&["r0", "r1", "-v0"]),
    )
        .prop_map(|(name, from)| format!("{name}, {from}, c20"));
    prop_oneof![8 => plain, 1 => matrix, 1 => Just("mov a0.x, r0.y".to_string())]
}

fn pixel_line() -> impl Strategy<Value = String> {
    const FROM: &[&str] = &[
        "r0", "r1", "r2", "v0", "v1", "c0", "c7", "-r0", "1-r1", "r2_bx2", "-r0_bx2", "r1_bias",
        "-r1_bias", "r0_x2", "-r2_x2", "c0.a", "r1.g", "1-v0.b", "-c7.r",
    ];
    const RESULTS: &[&str] = &["", "", "_sat", "_x2", "_x8_sat", "_d8"];
    let source = one_of(FROM).prop_map(String::from).boxed();
    let by_count = prop_oneof![
        (Just("mov"), Just(1usize)),
        (one_of(&["add", "sub", "mul", "dp3", "dp4"]), Just(2)),
        (one_of(&["mad", "lrp", "cnd", "cmp"]), Just(3)),
    ];
    let write = (one_of(&["r0", "r1", "r2"]), one_of(&MASKS)).prop_map(|(r, m)| format!("{r}{m}"));
    (by_count, one_of(RESULTS), write).prop_flat_map(move |((name, count), result, to)| {
        operands(count, source.clone()).prop_map(move |from| format!("{name}{result} {to}, {from}"))
    })
}

fn options() -> impl Strategy<Value = Options> {
    let kind = proptest::option::of(proptest::sample::select(vec![
        TextureKind::Texture2D,
        TextureKind::Cube,
        TextureKind::Volume,
    ]));
    let mode = proptest::sample::select(vec![
        AddressMode::Wrap,
        AddressMode::Border,
        AddressMode::MirrorOnce,
    ]);
    (kind, mode, any::<[bool; 5]>()).prop_map(|(texture, mode, [a, b, c, d, e])| Options {
        stages: [StageOptions {
            texture,
            seamless: a,
            address: [mode; 3],
            lod_bias: b,
            ..StageOptions::default()
        }; 8],
        exact_dots: c,
        overridable_definitions: d,
        level_zero: e,
        ..Options::default()
    })
}

fn check(listing: &str, entry: &str, options: &Options) {
    let source = Shader::new(listing).translate(options).source;
    validate(&source);
    check_form(listing, entry, &source);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn vertex_programs(lines in proptest::collection::vec(vertex_line(), 1..24), options in options()) {
        check(&format!("vs.1.1\ndef c9, 1e30, 0, -2, 128\n{}\n", lines.join("\n")), "vs_main", &options);
    }

    #[test]
    fn pixel_programs(
        lines in proptest::collection::vec((pixel_line(), any::<bool>()), 1..16),
        options in options(),
    ) {
        let mut body = String::new();
        let mut paired = true;
        for (line, pair) in &lines {
            // A pair has two halves.
            paired = !paired && *pair;
            body.push_str(&format!("{}{line}\n", if paired { "+" } else { "" }));
        }
        let listing = format!("ps.1.4\ndef c0, 0.5, 1, 0, -1\ntexld r0, t0\ntexld r1, t1_dw.xyw\n{body}");
        check(&listing, "ps_main", &options);
    }
}

//! `eval`: arithmetic done by hand against what the program prints.

use super::{Ran, texcrd, texcrd_with_input};
use serde_json::Value;

/// Runs a listing and returns what it prints as JSON.
#[track_caller]
fn eval(listing: &str, settings: &[&str]) -> Value {
    let mut arguments = vec!["eval", "-", "--format", "json", "--trace"];
    for setting in settings {
        arguments.extend(["--set", setting]);
    }
    let Ran { status, out, err } = texcrd_with_input(&arguments, listing.as_bytes());
    assert_eq!(status, 0, "{err}");
    serde_json::from_str(&out).expect("one JSON object")
}

/// The register holds these numbers, to one part in a million.
#[track_caller]
fn holds(result: &Value, register: &str, expected: &[f64]) {
    let actual = result["registers"][register]
        .as_array()
        .unwrap_or_else(|| panic!("no register {register} in {result}"));
    for (i, expected) in expected.iter().enumerate() {
        let actual = actual[i].as_f64().expect("a number");
        assert!(
            (actual - expected).abs() <= 1e-6 * expected.abs().max(1.0),
            "{register}[{i}] is {actual} instead of {expected}"
        );
    }
}

/// lrp: s0·s1 + (1 − s0)·s2 with weight 0.25 of (1, 0, 0): 0.25·1 + 0.75·0.4 = 0.55; 0.75·0.8 = 0.6.
#[test]
fn lrp() {
    let result = eval(
        "ps.1.1\nlrp r0, c0.a, c1, v0\n",
        &["c0=0,0,0,0.25", "c1=1,0,0,1", "v0=0.4,0.8,1,0"],
    );
    holds(&result, "r0", &[0.55, 0.6, 0.75, 0.25]);
}

/// The weight belongs to the second source: at 0 the third is taken.
#[test]
fn lrp_at_its_ends() {
    let listing = "ps.1.4\ntexcrd r1.rgb, t0\nmov r1.a, c0.a\nlrp r0, c1, c0, r1\n";
    let result = eval(listing, &["c0=0.5,0.5,0.5,0.5", "c1=0,1,0,1", "t0=3,4,5,1"]);
    holds(&result, "r0", &[3.0, 0.5, 5.0, 0.5]);
}

/// The article's refraction: lrp 0.9 of −eye and 0.1 of −normal. Eye (0, 0.6, −0.8), normal (0, 0, −1):
/// y = −0.54, z = 0.72 + 0.1 = 0.82.
#[test]
fn lrp_of_the_article() {
    let listing = "ps.1.4\ndef c0, 0.9f, 0.0f, 0.0f, 0.0f\ntexcrd r1.rgb, t4\ntexcrd r4.rgb, t1\n\
        lrp r0.rgb, c0.r, -r1, -r4\n+mov r0.a, c0.r\n";
    let result = eval(listing, &["t4=0,0.6,-0.8", "t1=0,0,-1"]);
    holds(&result, "r0", &[0.0, -0.54, 0.82, 0.9]);
}

/// dp3 writes only what its mask names: row by row the product of a matrix.
/// (1, 2, 3)·(1, 0, −1) = −2 to r, (0.5, 0.5, 0.5)·(1, 0, −1) = 0 to g, (0, 0, 2)·(1, 0, −1) = −2 to b.
#[test]
fn dp3_under_masks() {
    let listing = "ps.1.4\ntexcrd r1.rgb, t1\ntexcrd r2.rgb, t2\ntexcrd r3.rgb, t3\ntexcrd r4.rgb, t4\n\
        dp3 r0.r, r1, r4\ndp3 r0.g, r2, r4\ndp3 r0.b, r3, r4\nmov r0.a, c0\n";
    let result = eval(
        listing,
        &[
            "t1=1,2,3",
            "t2=0.5,0.5,0.5",
            "t3=0,0,2",
            "t4=1,0,-1",
            "c0=0.25",
        ],
    );
    holds(&result, "r0", &[-2.0, 0.0, -2.0, 0.25]);
}

/// _bx2: 2·(x − 0.5). dp3 of (1, 0.5, 0)_bx2 = (1, 0, −1) with itself is 2, halved 1.
#[test]
fn bx2() {
    let result = eval("ps.1.1\ndp3_d2 r0, v0_bx2, v0_bx2\n", &["v0=1,0.5,0,1"]);
    holds(&result, "r0", &[1.0; 4]);
    // −(2·(0.25 − 0.5)) = 0.5
    let result = eval("ps.1.1\nmov r0, -v0_bx2\n", &["v0=0.25"]);
    holds(&result, "r0", &[0.5; 4]);
}

/// Colour and alpha survive a phase differently; the second phase computes with the colour of the first.
/// Phase 1: (0.25, 0.5, 0.75) + 0.25; phase 2: times v0 = 0.5.
#[test]
fn phase() {
    let listing = "ps.1.4\ntexcrd r1.rgb, t0\nadd r1.rgb, r1, c0\nphase\nmul r0.rgb, r1, v0\n+mov r0.a, v0.b\n";
    let result = eval(listing, &["t0=0.25,0.5,0.75", "c0=0.25", "v0=0.5"]);
    holds(&result, "r0", &[0.25, 0.375, 0.5, 0.5]);
}

/// m4x4: each row of the constants against the vector. Rows (1,0,0,1), (0,2,0,0), (0,0,3,0), (0,0,0,1) and (1,2,3,1):
/// 1 + 1, 4, 9, 1.
#[test]
fn m4x4() {
    let result = eval(
        "vs.1.1\nm4x4 oPos, v0, c0\n",
        &[
            "v0=1,2,3,1",
            "c0=1,0,0,1",
            "c1=0,2,0,0",
            "c2=0,0,3,0",
            "c3=0,0,0,1",
        ],
    );
    holds(&result, "oPos", &[2.0, 4.0, 9.0, 1.0]);
}

/// Source and destination may be the same register: all rows read before any is written. A rotation by 90° about z
/// takes (1, 2, 3) to (−2, 1, 3).
#[test]
fn m3x3_in_place() {
    let listing = "vs.1.1\nmov r3, v0\nm3x3 r3, r3, c5\nmov oPos, r3\n";
    let result = eval(
        listing,
        &["v0=1,2,3,7", "c5=0,-1,0,0", "c6=1,0,0,0", "c7=0,0,1,0"],
    );
    holds(&result, "oPos", &[-2.0, 1.0, 3.0, 7.0]);
}

/// rsq normalises: |(3, 4, 0)| = 5, rsq 25 = 0.2, so (0.6, 0.8, 0).
#[test]
fn rsq() {
    let listing = "vs.1.0\ndp3 r11.x, v0, v0\nrsq r11.y, r11.x\nmul r0, v0, r11.y\nmov oPos, r0\n";
    let result = eval(listing, &["v0=3,4,0,1"]);
    holds(&result, "r11", &[25.0, 0.2]);
    holds(&result, "oPos", &[0.6, 0.8, 0.0, 0.2]);
}

/// Scalar instructions read w when nothing selects a component: rsq of 1/4 is 2.
#[test]
fn scalar_sources_read_w() {
    let result = eval(
        "vs.1.1\nrsq r0, v0\nrcp r1, v0.xyz\nmov oPos, r0\n",
        &["v0=4,9,5,0.25"],
    );
    holds(&result, "oPos", &[2.0; 4]);
    // .xyz is .xyzz, its w slot is z: 1/5.
    holds(&result, "r1", &[0.2; 4]);
}

/// Both halves of a pair read before either writes: `r0.a` is still 0.25 (not more than 0.5) for `cnd`.
#[test]
fn co_issue() {
    let listing = "ps.1.1\nmov r0, c2\nmov r0.a, c0\n+cnd r0.rgb, r0.a, c0, c1\n";
    let result = eval(listing, &["c0=1", "c1=0.5", "c2=0.25"]);
    holds(&result, "r0", &[0.5, 0.5, 0.5, 1.0]);
}

/// Shift, then saturation: 0.75·2 = 1.5 is clamped to 1, 0.25·2 = 0.5.
#[test]
fn shift_and_saturate() {
    let result = eval("ps.1.1\nmov_x2_sat r0, v0\n", &["v0=0.75,0.25,0,1"]);
    holds(&result, "r0", &[1.0, 0.5, 0.0, 1.0]);
}

/// Constants of pixel shaders are clamped to −1…1, those of vertex shaders are not.
#[test]
fn constants() {
    let result = eval("ps.1.4\nmov r0, c0\n", &["c0=3,-7,0.5,1"]);
    holds(&result, "r0", &[1.0, -1.0, 0.5, 1.0]);
    let result = eval("vs.1.1\nmov oPos, c0\n", &["c0=3,-7,0.5,1"]);
    holds(&result, "oPos", &[3.0, -7.0, 0.5, 1.0]);
}

/// `mov a0.x` takes the floor: −1.4 + 3 addresses c1 (−2 + 3); out of range reads zero.
#[test]
fn relative_addressing() {
    let listing = "vs.1.1\nmov a0.x, v1.x\nmov r0, c[a0.x + 3]\nmov r1, c[a0.x]\nmov oPos, r0\n";
    let result = eval(listing, &["v1=-1.4", "c1=1,2,3,4"]);
    holds(&result, "oPos", &[1.0, 2.0, 3.0, 4.0]);
    holds(&result, "r1", &[0.0; 4]);
}

/// Outputs that are never written: diffuse 1, specular 0.
#[test]
fn defaults_of_outputs() {
    let result = eval(
        "vs.1.1\nmov oPos, v0\nmov oD0.x, v0\nmov oT1.xy, v0\n",
        &["v0=0.5"],
    );
    holds(&result, "oD0", &[0.5, 1.0, 1.0, 1.0]);
    holds(&result, "oT1", &[0.5, 0.5, 0.0, 0.0]);
}

/// Without a texture a sample is opaque black.
#[test]
fn nothing_bound() {
    let result = eval("ps.1.1\ntex t0\nmov r0, t0\n", &["t0=0.5"]);
    holds(&result, "r0", &[0.0, 0.0, 0.0, 1.0]);
}

#[test]
fn texkill_and_texdepth() {
    let listing = "ps.1.4\ntexkill t0\nmov r0, c0\n";
    assert_eq!(eval(listing, &["t0=0.5,-0.1,0"])["killed"], true);
    assert_eq!(eval(listing, &["t0=0.5,0.1,0,-1"])["killed"], false);
    let listing = "ps.1.4\ntexcrd r5.rgb, t0\nphase\ntexdepth r5\nmov r0, c0\n";
    // 0.25 / 0.5
    assert_eq!(eval(listing, &["t0=0.25,0.5,0"])["depth"], 0.5);
}

#[test]
fn the_trace_tells_line_and_writes() {
    let result = eval(
        "ps.1.1\n\nmov r0.rgb, v0\n+mov r0.a, c0\n",
        &["v0=0.5", "c0=0.25"],
    );
    let trace = result["trace"].as_array().expect("a list");
    assert_eq!(trace.len(), 2);
    assert_eq!(trace[0]["line"], 3);
    assert_eq!(trace[0]["text"], "mov r0.rgb, v0");
    assert_eq!(trace[1]["line"], 4);
    assert_eq!(trace[1]["text"], "+mov r0.a, c0");
    assert_eq!(trace[1]["writes"]["r0"][3], 0.25);
}

#[test]
fn wrong_settings_are_explained() {
    for (setting, why) in [
        ("t9=1", "ps.1.1 has no t9"),
        ("r0=1", "v#, t# and c# can be set"),
        ("v0", "write it as"),
        ("v0=1,2,3,4,5", "one to four numbers"),
        ("v0=abc", "one to four numbers"),
    ] {
        let ran = texcrd_with_input(&["eval", "-", "--set", setting], b"ps.1.1\nmov r0, v0\n");
        assert_eq!(ran.status, 2, "{setting}");
        assert!(ran.err.contains(why), "{setting}: {}", ran.err);
    }
}

#[test]
fn a_refused_listing_is_not_run() {
    let ran = texcrd_with_input(&["eval", "-"], b"ps.1.1\nmov r0, r7\n");
    assert_eq!(ran.status, 1);
    assert!(ran.err.contains("O1"), "{}", ran.err);
    assert!(ran.out.is_empty());
}

/// Devices had 96 constants or more; what is beyond them is a warning in the lenient dialect and can be set.
#[test]
fn constants_beyond_those_of_every_device() {
    let arguments = [
        "eval",
        "-",
        "--format",
        "json",
        "--dialect",
        "lenient",
        "--set",
        "c200=1,2,3,4",
    ];
    let ran = texcrd_with_input(&arguments, b"vs.1.1\nmov oPos, c200\n");
    assert_eq!(ran.status, 0, "{}", ran.err);
    let result: Value = serde_json::from_str(&ran.out).expect("one object");
    holds(&result, "oPos", &[1.0, 2.0, 3.0, 4.0]);
}

/// What passes between the steps of one instruction is nobody's register; depth is one number.
#[test]
fn the_trace_names_what_listings_name() {
    let listing = "ps.1.4\ntexcrd r5.rg, t1_dw.xyw\nphase\nmov r0, c0\n";
    let trace = &eval(listing, &["t1=1,2,3,4"])["trace"];
    let names: Vec<_> = trace[0]["writes"]
        .as_object()
        .expect("writes")
        .keys()
        .collect();
    assert_eq!(names, ["r5"]);
    let listing = "ps.1.4\ntexcrd r5.rgb, t0\nphase\ntexdepth r5\nmov r0, c0\n";
    let trace = &eval(listing, &["t0=0.25,0.5,0"])["trace"];
    assert_eq!(trace[2]["writes"]["depth"], 0.5);
}

/// I7: a vertex constant that nobody sets is 0, and eval says so; those that are defined, set or only reached through
/// a0.x are not named, and pixel shaders have no such rule.
#[test]
fn constants_that_nobody_sets() {
    let listing = b"vs.1.1\ndef c9, 1, 1, 1, 1\nm4x4 oPos, v0, c0\nmov a0.x, v1.x\n\
        mov oD0, c[a0.x + 40]\nmul oT0, v7, c9\nmov oD1, c4\n";
    let ran = texcrd_with_input(
        &["eval", "-", "--set", "c1=0,1,0,0", "--set", "c4=1"],
        listing,
    );
    assert_eq!(ran.status, 0, "{}", ran.err);
    let said = ran.err.matches("[I7]").count();
    assert_eq!(said, 1, "{}", ran.err);
    for part in ["warning[I7]", "c0, c2 and c3", "<stdin>:3:16"] {
        assert!(ran.err.contains(part), "{part} in\n{}", ran.err);
    }
    let ran = texcrd_with_input(&["eval", "-"], b"ps.1.1\nmov r0, c0\n");
    assert!(!ran.err.contains("I7"), "{}", ran.err);
}

/// Everything that a result can be worked out from: what was read behind modifiers, and the sum before shift and saturation. Twice
/// 0.5 · 0.75 + 0.25 is 1.25, and saturated 1; twice 0.5 · −0.5 + 0.25 is 0.
#[test]
fn the_trace_shows_what_went_in() {
    let listing = "ps.1.1\nmov r1, c1\nmad_x2_sat r0, v0, r1_bx2, c0\n";
    let set = ["v0=0.5", "c1=0.875,0.25,0.875,0.875", "c0=0.25"];
    let result = eval(listing, &set);
    assert_eq!(result["inputs"]["v0"][0], 0.5);
    assert_eq!(result["constants"]["c1"][1], 0.25);
    let step = &result["trace"][1]["steps"][0];
    let reads: Vec<(&str, f64, f64)> = (step["reads"].as_array().expect("a list").iter())
        .map(|read| {
            let number = |i: usize| read["values"][i].as_f64().expect("a number");
            (
                read["operand"].as_str().expect("a name"),
                number(0),
                number(1),
            )
        })
        .collect();
    assert_eq!(
        reads,
        [("v0", 0.5, 0.5), ("r1_bx2", 0.75, -0.5), ("c0", 0.25, 0.25)]
    );
    assert_eq!(step["computed"][0], 0.625);
    assert_eq!(step["notes"][0], "r0.rba was saturated to 0…1");
    assert_eq!(step["values"], serde_json::json!([1.0, 0.0, 1.0, 1.0]));
    // What is written as it was computed is told once.
    assert_eq!(result["trace"][0]["steps"][0]["computed"], Value::Null);
    let text = texcrd_with_input(
        &[
            "eval", "-", "--trace", "--set", "v0=0.5", "--set", "c1=0.875", "--set", "c0=0.25",
        ],
        listing.as_bytes(),
    );
    for line in [
        "      v0           = 0.5, 0.5, 0.5, 0.5   given\n",
        "        r1_bx2     = 0.75, 0.75, 0.75, 0.75\n",
        "        computed   = 0.625, 0.625, 0.625, 0.625\n",
        "      r0           = 1, 1, 1, 1\n",
    ] {
        assert!(text.out.contains(line), "{line}{}", text.out);
    }
}

/// A case brings its textures and states. The texel (0, 0, 1) moves nothing; its luminance, 2 · 1 + 0.25, is clamped under this model.
#[test]
fn cases_are_traced() {
    let case = "tests/conformance/models/gf3_texbeml.toml";
    let ran = texcrd(&["eval", case, "--trace"]);
    assert_eq!((ran.status, ran.err.as_str()), (0, ""));
    for line in [
        "        bump matrix of stage 1 = 1, 0, 0, 1 (M00, M01, M10, M11)\n",
        "      coordinates.rgb = 0, 0, 0\n",
        "        factor of stage 1 = 1 × 2 + 0.25 = 2.25, taken into 0 to 1 (L × scale + offset)\n",
        "        stage 1: 2d 1×1 rgba32f at (0, 0), the same all over the quad\n",
        "        1 × texel 0,0: 0.4, 0.2, -0.6, 1\n",
    ] {
        assert!(ran.out.contains(line), "{line}{}", ran.out);
    }
    assert!(
        ran.out.ends_with("t1    = 0.4, 0.2, -0.6, 1\n"),
        "{}",
        ran.out
    );
    // One invocation of several, both shaders, and what became of the pixel.
    let case = "tests/conformance/states/fog_before_blend.toml";
    let ran = texcrd(&["eval", case, "--trace", "--invocation", "1"]);
    for line in [
        "// vs.1.1\n",
        "// ps.1.1\n",
        "   of the vertex shader\n",
        "   output merger: fog\n        factor 0.5 (of the vertices), colour 0, 0, 1\n",
        "   output merger: blend\n",
    ] {
        assert!(ran.out.contains(line), "{line}{}", ran.out);
    }
    let ran = texcrd(&["eval", case, "--trace", "--format", "json"]);
    let object: Value = serde_json::from_str(&ran.out).expect("one object");
    assert_eq!(object["vertex"]["registers"]["oFog"][0], 0.5);
    assert_eq!(
        object["pixel"]["behind"][1]["occasion"],
        "output merger: fog"
    );
    assert_eq!(texcrd(&["eval", case, "--invocation", "9"]).status, 2);
    assert_eq!(texcrd(&["eval", case, "--set", "v0=1"]).status, 2);
    let ran = texcrd(&["eval", "Cargo.toml"]);
    assert_eq!(ran.status, 1);
}

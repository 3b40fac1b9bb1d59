//! `--model`: numbers of period hardware on the command line.

use super::run::{HALF, HALF_VS, pixel, scene};
use super::{texcrd, texcrd_with_input};
use serde_json::Value;

/// 0.5 is 128/255 under gf3; its square, 64.25/255, is written as 64/255 = 0.2509804. The colour of the second line is
/// 1 under both, so that they part at the third.
const SQUARE: &str = "ps.1.1\nmov r1, v1\nmul r0, v0, v0\n";

#[test]
fn eval_says_where_two_models_part_first() {
    let arguments = [
        "eval", "-", "--set", "v0=0.5", "--set", "v1=1", "--trace", "--model",
    ];
    let ran = texcrd_with_input(
        &[&arguments[..], &["gf3,float"]].concat(),
        SQUARE.as_bytes(),
    );
    assert_eq!((ran.status, ran.err.as_str()), (0, ""));
    let told = "gf3 and float part first at line 3, mul r0, v0, v0: r0.r is 0.2509804 under gf3, 0.25 under float\n";
    assert!(ran.out.ends_with(told), "{}", ran.out);
    assert!(
        ran.out.contains("r1           = 1, 1, 1, 1\n"),
        "{}",
        ran.out
    );
    assert!(
        ran.out.contains("r0           = gf3    0.2509804, 0.2509804, 0.2509804, 0.2509804\n                     float  0.25, 0.25, 0.25, 0.25\n"),
        "{}",
        ran.out
    );
    // 0.5² = 1024/4096.
    let ran = texcrd_with_input(
        &[&arguments[..], &["r200,float"]].concat(),
        SQUARE.as_bytes(),
    );
    assert!(
        ran.out.ends_with("r200 and float do not part\n"),
        "{}",
        ran.out
    );
    let json = [&arguments[..], &["float,gf3,r200", "--format", "json"]].concat();
    let ran = texcrd_with_input(&json, SQUARE.as_bytes());
    let told: Value = serde_json::from_str(&ran.out).expect("JSON");
    assert_eq!(told["models"][1]["model"], "gf3");
    assert_eq!(told["models"][1]["trace"][1]["writes"]["r0"][0], 0.2509804);
    let parting = &told["parting"];
    assert_eq!(
        (
            &parting["line"],
            &parting["register"],
            &parting["component"]
        ),
        (&Value::from(3), &Value::from("r0"), &Value::from("r"))
    );
    assert_eq!(parting["values"]["r200"], 0.25);
}

/// −0.0001 is −0.41 steps of r200, so 0, which kills no pixel.
#[test]
fn models_may_part_in_what_they_discard() {
    let listing = "ps.1.4\ntexcrd r0.rgb, t0\nphase\ntexkill r0\nmov r0, v0\n";
    let arguments = [
        "eval",
        "-",
        "--set",
        "t0=1,-0.0001,1,1",
        "--model",
        "float,r200",
    ];
    let ran = texcrd_with_input(&arguments, listing.as_bytes());
    assert!(
        ran.out.contains("float: killed by texkill r0\n"),
        "{}",
        ran.out
    );
    assert!(!ran.out.contains("r200: killed"), "{}", ran.out);
    // The register parts before the pixel does.
    assert!(ran.out.contains("part first at line 2"), "{}", ran.out);
}

#[test]
fn one_model_for_one_listing() {
    let ran = texcrd_with_input(
        &["eval", "-", "--set", "v0=0.5", "--model", "gf3"],
        SQUARE.as_bytes(),
    );
    assert!(ran.out.starts_with("r0    = 0.2509804,"), "{}", ran.out);
    let ran = texcrd_with_input(&["eval", "-", "--model", "nv20"], SQUARE.as_bytes());
    assert_eq!(ran.status, 2);
    assert!(ran.err.contains("one of float, gf3, r200"), "{}", ran.err);
    let ran = texcrd_with_input(&["eval", "-", "--model", "gf3"], b"ps.1.4\nmov r0, c0\n");
    assert!(ran.err.contains("had ps.1.4"), "{}", ran.err);
    let ran = texcrd_with_input(&["translate", "-", "--model", "gf3"], SQUARE.as_bytes());
    assert!(ran.out.contains("gf3_vec4(v0 * v0)"), "{}", ran.out);
    let ran = texcrd_with_input(
        &[
            "debug",
            "-",
            "--set",
            "v0=0.5",
            "--model",
            "gf3",
            "-x",
            "finish",
            "-x",
            "print r0.r",
        ],
        SQUARE.as_bytes(),
    );
    assert!(ran.out.contains("0.2509804"), "{}{}", ran.out, ran.err);
}

/// What stands in a register is shown as it is; what is computed from it by hand is a float: 2 · 64/255.
#[test]
fn expressions_of_the_debugger_are_floats() {
    let print = ["-x", "finish", "-x", "print r0.r * 2 + 0.001"];
    let debug = ["debug", "-", "--set", "v0=0.5", "--model", "gf3"];
    let ran = texcrd_with_input(&[&debug[..], &print].concat(), SQUARE.as_bytes());
    assert!(ran.out.contains("0.5029608"), "{}{}", ran.out, ran.err);
}

/// A case that names its model and policies has them whatever the command line says. A name that there is not is its error.
#[test]
fn cases_name_their_model() {
    let case = "model = \"gf3\"\npolicies.def = \"always\"\nps = \"ps.1.1\\ndef c0, 1, 1, 1, 1\\nmul r0, v0, c0\"\n\
                ps_constants.c0 = 0\ninputs.v0 = 0.5\nexpect.r0 = 0.5019608\n";
    for model in ["float", "gf3", "r200"] {
        let ran = texcrd_with_input(&["test", "-", "--model", model], case.as_bytes());
        assert_eq!(ran.status, 0, "{}", ran.out);
    }
    for (from, to, said) in [
        ("gf3", "gf4", "there is no hardware model `gf4`"),
        (
            "\"always\"",
            "\"never\"",
            "there is no value of def `never`",
        ),
        ("policies.def", "policies.deff", "there is no policy `deff`"),
    ] {
        let ran = texcrd_with_input(&["test", "-"], case.replace(from, to).as_bytes());
        assert_eq!(ran.status, 1, "{}", ran.out);
        assert!(
            ran.out.contains(said) || ran.err.contains(said),
            "{}{}",
            ran.out,
            ran.err
        );
    }
}

#[test]
fn cases_run_under_a_model() {
    let case = b"ps = \"ps.1.1\\nmul r0, v0, v0\"\ninputs.v0 = 0.5\nexpect.r0 = 0.2509804\n";
    let passes = |model: &str| texcrd_with_input(&["test", "-", "--model", model], case).status;
    assert_eq!((passes("gf3"), passes("float")), (0, 1));
}

/// Half of (1 + 1) is 1 as a float, and 128/255 where 1 + 1 is clamped to 1. Targets store 255 and 128.
#[test]
fn a_sheet_of_models() {
    let half = HALF.replace("mov r0, c0", "add r0, c0.a, c0.a\\nmov_d2 r0, r0");
    let (scene, out) = scene(
        "run_models",
        &[("scene.toml", &half), ("half.vsh", HALF_VS)],
    );
    for (model, red) in [("float", 255), ("gf3", 128), ("r200", 255)] {
        let ran = texcrd(&["run", &scene, "-o", &out, "--model", model]);
        assert_eq!((ran.status, ran.err.as_str()), (0, ""));
        assert_eq!(pixel(&out, 1, 1)[0], red, "{model}");
    }
    let ran = texcrd(&["run", &scene, "-o", &out, "--model", "float,gf3,r200,gf3"]);
    assert_eq!((ran.status, ran.err.as_str()), (0, ""));
    let sheet = image::open(&out).expect("a picture").to_rgba8();
    // The alpha of r0 is its colour.
    let count = |all: u8| sheet.pixels().filter(|p| p.0 == [all; 4]).count();
    // 16 pixels of each of the three pictures, each model once; letters have other colours.
    assert_eq!((count(255), count(128)), (32, 16));
    // Side by side: three in a row.
    assert!(
        sheet.width() > 2 * sheet.height(),
        "{:?}",
        sheet.dimensions()
    );
}

//! `--policy`: numeric choices on the command line, against what the choices mean.

use super::texcrd_with_input;
use serde_json::Value;

/// What `eval` gives for a register under a policy.
#[track_caller]
fn register(listing: &str, name: &str, set: &[&str], policy: &str) -> Value {
    let mut arguments = vec!["eval", "-", "--format", "json", "--policy", policy];
    for setting in set {
        arguments.extend(["--set", setting]);
    }
    let ran = texcrd_with_input(&arguments, listing.as_bytes());
    assert_eq!(ran.status, 0, "{}", ran.err);
    let object: Value = serde_json::from_str(&ran.out).expect("JSON");
    object["registers"][name].clone()
}

/// 0 · ∞, with the infinity made by 1e38 · 1e38.
#[test]
fn zero_times_infinity() {
    let listing = "vs.1.1\nmov oPos, v0\nmul r0, v0.x, v0.x\nmul oT0, r0, v0.y\n";
    let product = |policy| register(listing, "oT0", &["v0=1e38,0,0,0"], policy)[0].clone();
    assert_eq!(product("zero-product=zero"), 0.0);
    assert_eq!(product("zero-product=ieee"), "NaN");
}

#[test]
fn the_reciprocal_of_zero() {
    let listing = "vs.1.1\nmov oPos, v0\nrcp oT0, v0.x\nlog oT1, v0.x\n";
    let of = |name, policy| register(listing, name, &["v0=0"], policy)[0].clone();
    assert_eq!(of("oT0", "rcp-zero=infinity"), "inf");
    assert_eq!(of("oT1", "rcp-zero=infinity"), "-inf");
    assert_eq!(of("oT0", "rcp-zero=largest"), 3.4028235e38);
}

/// v0 = (2, 0, 0, 4): 1/4 by w, 1/2 by x. A condition in the alpha of r0 is no scalar source.
#[test]
fn the_slot_of_scalar_instructions() {
    let listing = "vs.1.1\nmov oPos, v0\nrcp oT0, v0\n";
    let rcp = |policy| register(listing, "oT0", &["v0=2,0,0,4"], policy)[0].clone();
    assert_eq!(
        (rcp("scalar=w"), rcp("scalar=x")),
        (0.25.into(), 0.5.into())
    );
    let listing = "ps.1.1\nmov r0, v0\ncnd r0, r0.a, c0, c1\n";
    let picked = register(listing, "r0", &["v0=0,0,0,1", "c0=1", "c1=0"], "scalar=x");
    assert_eq!(picked[0], 1.0);
}

/// 8 = 1 · 2³: (3, 1, 3, 1), or 3 four times.
#[test]
fn the_layout_of_logp() {
    let listing = "vs.1.1\nmov oPos, v0\nlogp oT0, v0.x\n";
    let logp = |policy| register(listing, "oT0", &["v0=8"], policy).to_string();
    assert_eq!(logp("logp=parts"), "[3.0,1.0,3.0,1.0]");
    assert_eq!(logp("logp=logarithm"), "[3.0,3.0,3.0,3.0]");
}

#[test]
fn the_lifetime_of_definitions() {
    let listing = "ps.1.1\ndef c0, 0.25, 0, 0, 1\nmov r0, c0\n";
    let red = |policy| register(listing, "r0", &["c0=0.5,0,0,1"], policy)[0].clone();
    assert_eq!(
        (red("def=when-set"), red("def=always")),
        (0.5.into(), 0.25.into())
    );
}

#[test]
fn wrong_settings_are_refused() {
    for (setting, said) in [
        ("rcp", "NAME=VALUE"),
        ("rcp=1", "zero-product, rcp-zero, scalar, logp, def"),
        ("logp=half", "parts, logarithm"),
    ] {
        let ran = texcrd_with_input(&["eval", "-", "--policy", setting], b"ps.1.1\nmov r0, c0\n");
        assert_eq!(ran.status, 2);
        assert!(ran.err.contains(said), "{}", ran.err);
    }
}

#[test]
fn translations_follow() {
    let listing = "vs.1.1\nmov oPos, v0\nrcp r0, v0.x\nmul r1, r0, r0\nmul oT1, r1, v0\n";
    let run = |policy| {
        let arguments = ["translate", "-", "--policy", policy];
        let ran = texcrd_with_input(&arguments, listing.as_bytes());
        assert_eq!(ran.status, 0, "{}", ran.err);
        ran.out
    };
    // The square of the reciprocal may be infinite, and is guarded where 0 times it is 0.
    assert!(run("zero-product=zero").contains("mul_zero"));
    assert!(!run("zero-product=ieee").contains("mul_zero"));
    assert!(run("rcp-zero=infinity").contains("infinity()"));
    assert!(!run("rcp-zero=largest").contains("infinity()"));
    assert!(run("scalar=x").contains("rcp(in.v0.x)"));
}

/// Whoever makes or compares generated shaders takes models and policies, and says which.
#[test]
fn generated_shaders_follow() {
    let listing = |arguments: &[&str]| {
        let ran = super::texcrd(
            &[
                &["generate", "--version", "vs.1.1", "--seed", "3"],
                arguments,
            ]
            .concat(),
        );
        assert_eq!(ran.status, 0, "{}", ran.err);
        ran.out
    };
    assert!(listing(&[]).starts_with("vs.1.1\n"));
    assert_eq!(listing(&[]), listing(&["--policy", "scalar=w"]));
    assert!(listing(&["--policy", "scalar=x", "--model", "gf3"]).starts_with("vs.1.1\n"));
    let ran = super::texcrd(&["fuzz-match", "--policy", "rcp"]);
    assert_eq!(ran.status, 2);
}

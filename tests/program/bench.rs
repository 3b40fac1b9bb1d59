//! `texcrd bench`: the form of what it says. How fast anything is, is for BENCHMARKS.md.

use super::texcrd;

const SCENE: &str = "benches/scenes/arithmetic.toml";

#[test]
fn times_of_the_cpu_as_json() {
    let ran = texcrd(&[
        "bench",
        SCENE,
        "--size",
        "64x32",
        "--frames",
        "2",
        "--adapter",
        "none",
        "--simd",
        "sse2",
        "--format",
        "json",
    ]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let said: serde_json::Value = serde_json::from_str(&ran.out).expect("the result is JSON");
    assert_eq!(said["scene"], SCENE);
    assert_eq!(said["size"], serde_json::json!([64, 32]));
    assert!(said["cpu"]["median_ms"].as_f64().expect("a time") > 0.0);
    assert!(said["cpu"]["threads"].as_u64().expect("a number") > 0);
    let simd = said["cpu"]["simd"].as_str().expect("a name");
    assert!(simd == "sse2" || !cfg!(target_arch = "x86_64"), "{simd}");
    assert_eq!(said["adapters"], serde_json::json!([]));
}

#[test]
fn every_adapter_is_compared_with_the_cpu() {
    let ran = texcrd(&["adapters", "--format", "json"]);
    if ran.status != 0 {
        // No adapter on this machine.
        return;
    }
    let known: serde_json::Value = serde_json::from_str(&ran.out).expect("the list is JSON");
    let ran = texcrd(&[
        "bench", SCENE, "--size", "64x32", "--frames", "3", "--format", "json",
    ]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let said: serde_json::Value = serde_json::from_str(&ran.out).expect("the result is JSON");
    let cpu = said["cpu"]["median_ms"].as_f64().expect("a time");
    let adapters = said["adapters"].as_array().expect("a list");
    assert_eq!(adapters.len(), known.as_array().expect("a list").len());
    for (adapter, known) in adapters.iter().zip(known.as_array().into_iter().flatten()) {
        assert_eq!(adapter["name"], known["name"]);
        let time = adapter["median_ms"].as_f64().expect("a time");
        let ratio = adapter["cpu_is_faster_by"].as_f64().expect("a ratio");
        // Both times are rounded to a thousandth.
        let bound = 0.001 + ratio * (0.001 / cpu + 0.001 / time);
        assert!((ratio - time / cpu).abs() < bound, "{said}");
    }
}

#[test]
fn what_cannot_be_measured_is_refused() {
    for (arguments, why) in [
        (&["--simd", "mmx"][..], "write one of"),
        (&["--frames", "0"][..], "--frames"),
        (&["--seconds", "-1"][..], "no time"),
        (&["--adapter", "no such card"][..], "--adapter"),
    ] {
        let ran = texcrd(&[&["bench", SCENE][..], arguments].concat());
        assert_eq!(ran.status, 2, "{arguments:?}");
        assert!(ran.err.contains(why), "{}", ran.err);
        assert_eq!(ran.out, "");
    }
}

//! `generate`: listings that other commands take.

use super::{texcrd, texcrd_with_input};

#[test]
fn what_is_generated_is_accepted() {
    for version in ["vs.1.0", "vs_1_1", "ps.1.0", "PS.1.2", "ps.1.4"] {
        for seed in ["1", "2", "3"] {
            let made = texcrd(&["generate", "--version", version, "--seed", seed]);
            assert_eq!((made.status, made.err.as_str()), (0, ""));
            let heading = made.out.lines().next().expect("a listing has lines");
            assert_eq!(heading, version.to_lowercase().replace('_', "."));
            let checked = texcrd_with_input(&["check", "-"], made.out.as_bytes());
            assert_eq!(checked.status, 0, "{}", made.out);
            let again = texcrd(&["generate", "--version", version, "--seed", seed]);
            assert_eq!(again.out, made.out);
        }
    }
}

#[test]
fn unknown_versions_are_refused() {
    let ran = texcrd(&["generate", "--version", "ps.2.0"]);
    assert_eq!(ran.status, 2);
    assert!(ran.err.contains("ps.1.4"), "{}", ran.err);
}

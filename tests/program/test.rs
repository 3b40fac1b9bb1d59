//! `test`: shader unit tests as people run them.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may panic")]

use super::{folder, gpu_is_off, texcrd, texcrd_with_input};
use serde_json::Value;
use std::fs;

const GOOD: &str = "name = \"a copy\"\nps = \"ps.1.1\\nmov r0, v0\"\ninputs.v0 = [0.5, 0.25, 0, 1]\nexpect.r0 = [0.5, 0.25, 0, 1]\n";

/// A folder with a case that passes, one that fails, one that is accepted, one that is none, and something else.
fn cases(test: &str) -> String {
    let folder = folder(test);
    fs::create_dir(folder.join("deeper")).unwrap();
    let write = |name: &str, text: &str| fs::write(folder.join(name), text).unwrap();
    write(
        "b.toml",
        &GOOD
            .replace("r0 = [0.5", "r0 = [0.75")
            .replace("a copy", "a wrong copy"),
    );
    write("deeper/a.toml", GOOD);
    write(
        "a.json",
        "{\"ps\": \"ps.1.1\\nmov r0, c0\", \"expect\": {\"r0\": [1]}, \"accept\": [{\"r0\": [0]}]}",
    );
    write("c.toml", &GOOD.replace("inputs", "input"));
    write("notes.txt", "not a case");
    folder.display().to_string()
}

#[test]
fn failures_are_told_with_the_instruction() {
    let folder = cases("test-text");
    let ran = texcrd(&["test", &folder]);
    assert_eq!(ran.status, 1, "{}", ran.err);
    let lines: Vec<&str> = ran.out.lines().collect();
    assert!(
        lines[0].starts_with("ok, accepted") && lines[0].ends_with("a.json"),
        "{}",
        ran.out
    );
    assert!(lines[1].starts_with("FAILED") && lines[1].ends_with("b.toml: a wrong copy"));
    assert!(lines[2].starts_with("ERROR") && lines[2].ends_with("c.toml"));
    assert!(lines[3].starts_with("ok ") && lines[3].ends_with("a.toml: a copy"));
    for said in [
        "it gave result 1 of `accept`",
        "r0.r    expected 0.75, got 0.5, off by 0.25 (tolerance 1e-6)",
        "written by `mov r0, v0`",
        "b.toml, `ps`, line 2",
        "c.toml has no key `input`",
        "did you mean `inputs`?",
    ] {
        assert!(ran.out.contains(said), "{said}: {}", ran.out);
    }
    let summary = "2 passed, 2 failed (1 of those that passed by another accepted result)";
    assert_eq!(*lines.last().unwrap(), summary);
}

#[test]
fn a_filter_looks_at_path_and_name() {
    let folder = cases("test-filter");
    for (filter, passed) in [("DEEPER", 1), ("a copy", 1), ("a.", 2)] {
        let ran = texcrd(&["test", &folder, "--filter", filter, "--quiet"]);
        assert_eq!(ran.status, 0, "{}{}", ran.out, ran.err);
        assert!(
            ran.out.contains(&format!("{passed} passed, 0 failed")),
            "{}",
            ran.out
        );
        assert!(!ran.out.contains("ok  "), "{}", ran.out);
    }
    let ran = texcrd(&["test", &folder, "--filter", "nothing like this"]);
    assert_eq!(ran.status, 2);
    assert!(
        ran.err.contains("no case has `nothing like this`"),
        "{}",
        ran.err
    );
}

#[test]
fn json_is_one_object_a_case() {
    let folder = cases("test-json");
    let ran = texcrd(&["test", &folder, "--format", "json"]);
    assert_eq!(ran.status, 1);
    let objects: Vec<Value> = (ran.out.lines())
        .map(|line| serde_json::from_str(line).expect("an object a line"))
        .collect();
    let outcomes: Vec<&str> = objects
        .iter()
        .map(|o| o["outcome"].as_str().unwrap())
        .collect();
    assert_eq!(outcomes, ["accepted", "failed", "error", "passed"]);
    assert_eq!(objects[0]["invocations"][0]["accepted"], 1);
    assert_eq!(objects[3]["name"], "a copy");
    assert_eq!(objects[2]["diagnostics"][0]["line"], 3);
    let wrong = &objects[1]["invocations"][0]["wrong"][0];
    assert_eq!(
        (&wrong["register"], &wrong["component"]),
        (&"r0".into(), &"r".into())
    );
    assert_eq!(
        (&wrong["expected"], &wrong["actual"]),
        (&0.75.into(), &0.5.into())
    );
    assert_eq!(wrong["written_by"]["line"], 2);
    assert_eq!(wrong["written_by"]["text"], "mov r0, v0");
}

#[test]
fn a_case_from_standard_input() {
    let ran = texcrd_with_input(&["test", "-"], GOOD.as_bytes());
    assert_eq!(
        (ran.status, ran.out.as_str()),
        (0, "ok     <stdin>: a copy\n1 passed, 0 failed\n")
    );
}

#[test]
fn what_cannot_be_read_is_no_failure_of_a_case() {
    let ran = texcrd(&["test", "there/is/no/such.toml"]);
    assert_eq!(ran.status, 2);
    let empty = folder("test-empty").display().to_string();
    assert_eq!(texcrd(&["test", &empty]).status, 2);
    assert_eq!(texcrd(&["test", "x.toml", "--on", "moon"]).status, 2);
    let ran = texcrd(&["test", "-", "--adapter", "0"]);
    assert_eq!(ran.status, 2);
    assert!(ran.err.contains("--on gpu or --on both"), "{}", ran.err);
}

#[test]
fn what_ran_before_a_file_that_cannot_be_read_is_told() {
    let folder = folder("test-unread");
    let good = folder.join("good.toml").display().to_string();
    fs::write(&good, GOOD).unwrap();
    let ran = texcrd(&["test", &good, "there/is/no/such.toml"]);
    assert_eq!(ran.status, 2, "{}", ran.err);
    assert!(ran.out.ends_with("1 passed, 0 failed\n"), "{}", ran.out);
    assert!(ran.err.contains("such.toml"), "{}", ran.err);
}

#[test]
fn numbers_are_told_with_few_digits() {
    let text = "vs = \"vs.1.1\\nmov oPos, v0\"\ninputs.v0 = [2147483520, 1e-20, 0.5, 0]\nexpect.oPos = [2147483648, 1, 0.25]\n";
    let ran = texcrd_with_input(&["test", "-"], text.as_bytes());
    for said in [
        // The float below 2^31 is 128 less.
        "expected 2.1474836e9, got 2.1474835e9, off by 128 (tolerance 1e-6)",
        "expected 1, got 1e-20, off by 1 (",
        "expected 0.25, got 0.5, off by 0.25 (",
    ] {
        assert!(ran.out.contains(said), "{said}: {}", ran.out);
    }
}

#[test]
fn both_sides_are_told_apart() {
    if gpu_is_off() {
        return;
    }
    let folder = cases("test-both");
    let ran = texcrd(&["test", &folder, "--on", "both"]);
    assert_eq!(ran.status, 1, "{}{}", ran.out, ran.err);
    for said in [
        "FAILED",
        "failed on cpu: ",
        "failed on gpu: ",
        "accepted on cpu: ",
        "accepted on gpu: ",
        "2 passed, 2 failed",
        " on cpu and gpu, ",
    ] {
        assert!(ran.out.contains(said), "{said}: {}", ran.out);
    }
    // A line for each case, not for each side; the same wrong number and the same instruction from both.
    let lines = ran.out.lines().take_while(|line| !line.is_empty());
    assert_eq!(lines.count(), 4, "{}", ran.out);
    for twice in ["r0.r    expected 0.75, got 0.5", "written by `mov r0, v0`"] {
        assert_eq!(ran.out.matches(twice).count(), 2, "{}", ran.out);
    }
}

#[test]
fn json_has_an_object_for_each_side() {
    if gpu_is_off() {
        return;
    }
    let folder = cases("test-both-json");
    let arguments = ["--filter", "b.toml", "--on", "both", "--format", "json"];
    let ran = texcrd(&[&["test", folder.as_str()], &arguments[..]].concat());
    assert_eq!(ran.status, 1, "{}", ran.err);
    let objects: Vec<Value> = (ran.out.lines())
        .map(|line| serde_json::from_str(line).expect("an object a line"))
        .collect();
    let sides: Vec<&str> = objects.iter().map(|o| o["on"].as_str().unwrap()).collect();
    assert_eq!(sides, ["cpu", "gpu"]);
    for object in &objects {
        let wrong = &object["invocations"][0]["wrong"][0];
        assert_eq!(
            (&wrong["expected"], &wrong["actual"]),
            (&0.75.into(), &0.5.into())
        );
        assert_eq!(wrong["written_by"]["line"], 2);
    }
    // Tolerances are those that were applied. A `mov` is exact on either side.
    assert_eq!(objects[1]["invocations"][0]["wrong"][0]["tolerance"], 1e-6);
}

#[test]
fn one_side_alone() {
    if gpu_is_off() {
        return;
    }
    let ran = texcrd_with_input(&["test", "-", "--on", "gpu"], GOOD.as_bytes());
    assert_eq!(ran.status, 0, "{}{}", ran.out, ran.err);
    let said = ran
        .out
        .starts_with("ok     <stdin>: a copy\n1 passed, 0 failed on gpu, ");
    assert!(said, "{}", ran.out);
}

/// With the GPU switched off for tests this still holds: there is no such adapter.
#[test]
fn an_adapter_that_is_not_there() {
    let arguments = ["test", "-", "--on", "gpu", "--adapter", "no such card"];
    let ran = texcrd_with_input(&arguments, GOOD.as_bytes());
    assert_eq!((ran.status, ran.out.as_str()), (2, ""));
    assert!(ran.err.contains("adapter"), "{}", ran.err);
}

//! `check`: what it says of good, damaged and hopeless listings.

use super::{folder, texcrd, texcrd_with_input};
use serde_json::Value;
use std::fs;
use std::time::{Duration, Instant};

/// The diagnostics of a listing as (line, code, severity).
#[track_caller]
fn diagnostics(path: &str) -> Vec<(u64, String, String)> {
    let ran = texcrd(&["check", "--format", "json", path]);
    ran.out
        .lines()
        .map(|line| {
            let object: Value = serde_json::from_str(line).expect("one object a line");
            let text = |key: &str| object[key].as_str().expect(key).to_string();
            (
                object["line"].as_u64().expect("line"),
                text("code"),
                text("severity"),
            )
        })
        .collect()
}

fn lines_of(found: &[(u64, String, String)], severity: &str) -> Vec<u64> {
    (found.iter().filter(|d| d.2 == severity))
        .map(|d| d.0)
        .collect()
}

#[test]
fn the_restored_listings_are_accepted() {
    let pixel = texcrd(&["check", "asm/stained_glass/stained_glass.psh"]);
    assert_eq!((pixel.status, pixel.err.as_str()), (0, ""));
    assert_eq!(diagnostics("asm/stained_glass/stained_glass.psh"), []);
    // RESTORED.md explains each of these.
    let vertex = diagnostics("asm/stained_glass/stained_glass.vsh");
    let expected = [(28, "O19"), (44, "O19"), (45, "I1")]
        .map(|(line, code)| (line, code.to_string(), "warning".to_string()));
    assert_eq!(vertex, expected);
}

/// One error for each place that RESTORED.md lists, and none beside them. The lines are those of its tables.
#[test]
fn the_scanned_vertex_shader() {
    let found = diagnostics("asm/stained_glass/scanned/stained_glass.vsh");
    let damaged = [
        1, 9, 11, 12, 14, 16, 21, 23, 25, 31, 34, 38, 41, 46, 47, 54, 59,
    ];
    assert_eq!(lines_of(&found, "error"), damaged);
    assert_eq!(lines_of(&found, "warning"), [36, 64]);
}

/// The three lost dot products leave three registers that are loaded and never read: r0, r2, r3.
#[test]
fn the_scanned_pixel_shader() {
    let found = diagnostics("asm/stained_glass/scanned/stained_glass.psh");
    assert_eq!(lines_of(&found, "error"), [5, 15, 15, 27, 29, 29, 31]);
    assert_eq!(lines_of(&found, "warning"), [4, 10, 11]);
}

#[test]
fn what_is_certain_is_repaired() {
    let folder = folder("check_fix");
    for name in ["stained_glass.vsh", "stained_glass.psh"] {
        let copy = folder.join(name);
        fs::copy(format!("asm/stained_glass/scanned/{name}"), &copy).expect("a copy");
        let copy = copy.to_str().expect("a readable path");
        assert_eq!(texcrd(&["check", "--fix", copy]).status, 1);
    }
    let read = |name: &str| fs::read_to_string(folder.join(name)).expect("still there");
    let pixel = read("stained_glass.psh");
    for repaired in [
        "texcrd r1.rgb, t4\n",
        "\nlrp r2.rgb, c0.r, -r1, -r4;",
        "r3, r4_x2, r1",
    ] {
        assert!(pixel.contains(repaired), "{repaired} in\n{pixel}");
    }
    let vertex = read("stained_glass.vsh");
    assert!(vertex.starts_with("; Sample vertex shader"));
    assert!(vertex.contains("; - Vertex Position"));
    // What was not certain stands as it stood.
    assert!(vertex.contains("     r8, c28, -v0\n"));
    // A second repair finds nothing to do.
    let again = folder.join("stained_glass.vsh");
    texcrd(&["check", "--fix", again.to_str().expect("a readable path")]);
    assert_eq!(read("stained_glass.vsh"), vertex);
}

#[test]
fn standard_input_is_repaired_to_standard_output() {
    let ran = texcrd_with_input(&["check", "--fix", "-"], b"ps.1.1\nmov rO, vl\n");
    assert_eq!(ran.out, "ps.1.1\nmov r0, v1\n", "{}", ran.err);
    assert_eq!(ran.status, 0);
}

/// Two texture instructions of six, one pair of eight, and so on, counted by hand.
#[test]
fn statistics() {
    let ran = texcrd(&[
        "check",
        "--stats",
        "--format",
        "json",
        "asm/stained_glass/stained_glass.psh",
    ]);
    let object: Value = serde_json::from_str(ran.out.trim()).expect("one object");
    let phases = &object["stats"]["phases"];
    let used = |phase: usize, what: &str| phases[phase][what]["used"].as_u64();
    assert_eq!(
        (used(0, "texture"), used(0, "arithmetic")),
        (Some(6), Some(5))
    );
    assert_eq!(
        (used(1, "texture"), used(1, "arithmetic")),
        (Some(4), Some(2))
    );
    let stages = object["stats"]["stages"].as_array().expect("a list");
    let numbers: Vec<_> = stages.iter().map(|s| s["stage"].as_u64()).collect();
    assert_eq!(numbers, [0, 2, 3, 4, 5].map(Some));
}

/// Textures, full ports and possible pairs, with the lines of the file. Worked out by hand.
#[test]
fn statistics_of_stages_ports_and_pairs() {
    let listing = b"ps.1.1\ntex t0\n; a comment\ntexbem t1, t0\nmul r0.rgb, t1, c0\nmov r0.a, c1\nmad r0, c0, c1, r0\n";
    let ran = texcrd_with_input(&["check", "--stats", "-"], listing);
    assert_eq!(ran.status, 0, "{}", ran.err);
    for line in [
        "  stage 0       2D, cube or volume, line 2\n",
        "  stage 1       2D, line 4\n",
        "  ports full    2 of 2 c# at once: line 7\n",
        "  could pair    lines 5 and 6, for 1 slot less\n",
    ] {
        assert!(ran.out.contains(line), "{line} in\n{}", ran.out);
    }
    let ran = texcrd_with_input(&["check", "--stats", "--format", "json", "-"], listing);
    let object: Value = serde_json::from_str(ran.out.trim()).expect("one object");
    let stats = &object["stats"];
    assert_eq!(
        stats["stages"],
        serde_json::json!([
            { "stage": 0, "textures": "2D, cube or volume", "lines": [2] },
            { "stage": 1, "textures": "2D", "lines": [4] },
        ])
    );
    assert_eq!(
        stats["full_ports"],
        serde_json::json!([{ "file": "c", "allowed": 2, "pairs": false, "lines": [7] }])
    );
    assert_eq!(
        stats["possible_pairs"],
        serde_json::json!([{ "lines": [5, 6], "saves": 1 }])
    );
}

#[test]
fn diagnostics_are_read_by_people() {
    let ran = texcrd_with_input(&["check", "-"], b"ps.1.1\ntex t0\nmul r0, t0, v9\n");
    assert_eq!(ran.status, 1);
    for part in [
        "error[O1]",
        "<stdin>:3:13",
        "mul r0, t0, v9",
        "^^",
        "1 error",
    ] {
        assert!(ran.out.contains(part), "{part} in\n{}", ran.out);
    }
    // No colours in a pipe.
    assert!(!ran.out.contains('\u{1b}'));
}

/// Whatever it is given, it says what is wrong, soon and without falling over.
#[test]
fn hopeless_input() {
    let mut noise = Vec::new();
    let mut state = 1u32;
    for _ in 0..200_000 {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        noise.push((state >> 24) as u8);
    }
    let mut long_line = b"ps.1.1\n".to_vec();
    long_line.extend(std::iter::repeat_n(b'x', 1_000_000));
    let inputs: [(&str, Vec<u8>); 9] = [
        ("nothing", Vec::new()),
        ("a line end", b"\n".to_vec()),
        ("noise", noise),
        ("50 MB", vec![b'm'; 50 << 20]),
        ("a long line", long_line),
        ("zeros", vec![0; 1 << 20]),
        ("an open comment", b"ps.1.1 /* mov r0, v0".to_vec()),
        (
            "brackets",
            [b"vs.1.1\nmov r0, ".to_vec(), vec![b'['; 100_000]].concat(),
        ),
        ("a PNG", b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR".to_vec()),
    ];
    for (what, input) in inputs {
        let began = Instant::now();
        let ran = texcrd_with_input(&["check", "-"], &input);
        assert_eq!(ran.status, 1, "{what}: {}", ran.err);
        assert!(!ran.err.contains("panicked"), "{what}: {}", ran.err);
        let said = ran.out.len() + ran.err.len();
        assert!(
            (20..200_000).contains(&said),
            "{what}: {said} bytes were said"
        );
        // Generous: this is to find what never ends, not to measure.
        assert!(began.elapsed() < Duration::from_secs(60), "{what}");
    }
}

#[test]
fn usage_and_missing_files() {
    assert_eq!(texcrd(&["check"]).status, 2);
    let ran = texcrd(&["check", "no/such/file.psh"]);
    assert_eq!(ran.status, 2);
    assert!(ran.err.contains("no/such/file.psh"), "{}", ran.err);
    assert_eq!(texcrd(&["check", "--dialect", "d3d7", "-"]).status, 2);
}

/// A repaired file stays what it was: a link stays a link, permissions stay.
#[cfg(unix)]
#[test]
fn a_repaired_file_keeps_its_identity() {
    use std::os::unix::fs::PermissionsExt;
    let folder = folder("check_fix_identity");
    let (real, link) = (folder.join("real.psh"), folder.join("link.psh"));
    fs::write(&real, "ps.1.1\nmov r0, vl\n").expect("a file");
    fs::set_permissions(&real, fs::Permissions::from_mode(0o640)).expect("permissions");
    std::os::unix::fs::symlink("real.psh", &link).expect("a link");
    let ran = texcrd(&["check", "--fix", link.to_str().expect("a readable path")]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    assert_eq!(
        fs::read_to_string(&real).expect("still there"),
        "ps.1.1\nmov r0, v1\n"
    );
    assert!(
        fs::symlink_metadata(&link)
            .expect("still there")
            .is_symlink()
    );
    let mode = fs::metadata(&real)
        .expect("still there")
        .permissions()
        .mode();
    assert_eq!(mode & 0o777, 0o640);
    // What must not be written is not.
    fs::write(&real, "ps.1.1\nmov r0, vl\n").expect("a file");
    fs::set_permissions(&real, fs::Permissions::from_mode(0o440)).expect("permissions");
    assert_eq!(
        texcrd(&["check", "--fix", real.to_str().expect("a readable path")]).status,
        2
    );
    assert_eq!(
        fs::read_to_string(&real).expect("still there"),
        "ps.1.1\nmov r0, vl\n"
    );
}

#[test]
fn programs_can_read_the_repair() {
    let ran = texcrd_with_input(&["check", "--format", "json", "-"], b"ps.1.1\nmov r0, vl\n");
    let object: Value = serde_json::from_str(ran.out.trim()).expect("one object");
    let fix = &object["fix"];
    assert_eq!(fix["replacement"], "v1");
    assert_eq!(fix["certain"], true);
    assert_eq!(
        (fix["line"].as_u64(), fix["column"].as_u64()),
        (Some(2), Some(9))
    );
}

#[test]
fn a_file_that_cannot_be_read_does_not_stop_the_others() {
    let folder = folder("check_missing");
    let wrong = folder.join("wrong.psh");
    std::fs::write(&wrong, "ps.1.1\nmov r0, r1\n").expect("a file");
    let missing = folder.join("missing.psh");
    let (wrong, missing) = (
        wrong.to_str().expect("a readable path"),
        missing.to_str().expect("a readable path"),
    );
    let ran = texcrd(&["check", missing, wrong]);
    assert_eq!(ran.status, 2);
    assert!(ran.err.contains("missing.psh"), "{}", ran.err);
    assert!(ran.out.contains("error[I1]"), "{}", ran.out);
    let ran = texcrd(&["fmt", "--check", missing, wrong]);
    assert_eq!(ran.status, 2);
}

/// Where nothing can be written, whatever is written fails.
#[cfg(target_os = "linux")]
#[test]
fn results_that_cannot_be_written_are_an_error() {
    let full = std::fs::OpenOptions::new().write(true).open("/dev/full");
    let ran = std::process::Command::new(env!("CARGO_BIN_EXE_texcrd"))
        .args(["asm", "asm/stained_glass/stained_glass.psh"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .stdout(full.expect("it is there"))
        .output()
        .expect("it runs");
    assert_eq!(ran.status.code(), Some(2));
    let err = String::from_utf8_lossy(&ran.stderr);
    assert!(err.contains("standard output"), "{err}");
}

//! The language server in a real editor: Neovim, without its screen. Says so and passes where there is none.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use serde_json::{Value, json};
use std::fs;
use std::process::Command;

/// `1rp` is no instruction, and ps.1.1 has no r9. The character in the comment has two units of UTF-16, and four bytes.
const LISTING: &str =
    "ps.1.1\ndef c0, 1, 0.5, 0, 1\n1rp r0, v0, v1, c0\nadd /* \u{1f600} */ r9, r0, v0\n";

#[test]
fn a_session_in_neovim() {
    if Command::new("nvim").arg("--version").output().is_err() {
        eprintln!("nvim is missing: the language server was not tried in an editor");
        return;
    }
    let folder = std::env::temp_dir().join(format!("texcrd-editor-{}", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    let (listing, report) = (folder.join("shader.psh"), folder.join("report.json"));
    fs::write(&listing, LISTING).unwrap();
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/editor/session.lua");
    let output = Command::new("nvim")
        .args(["--headless", "-n", "-u", "NONE", "-i", "NONE"])
        .args(["-c", &format!("luafile {script}")])
        .env("TEXCRD", env!("CARGO_BIN_EXE_texcrd"))
        .env("LISTING", &listing)
        .env("REPORT", &report)
        // What Neovim keeps between sessions goes away with the folder.
        .env("XDG_STATE_HOME", &folder)
        .env("XDG_CACHE_HOME", &folder)
        .env("XDG_DATA_HOME", &folder)
        .output()
        .unwrap();
    let said = fs::read_to_string(&report);
    let _ = fs::remove_dir_all(&folder);
    let said = said.unwrap_or_else(|_| panic!("{}", String::from_utf8_lossy(&output.stderr)));
    let found: Value = serde_json::from_str(&said).unwrap();
    assert_eq!(found["problem"], Value::Null);

    // Neovim counts columns in bytes: `add /* ____ */ ` are 15.
    assert_eq!(found["diagnostics"], json!(["O1 3:15-3:17", "P8 2:0-2:3"]));
    assert_eq!(found["action"], "Replace `1rp` by `lrp`");
    assert_eq!(found["repaired"], "lrp r0, v0, v1, c0");
    let hover = found["hover"].as_str().unwrap();
    assert!(hover.contains("s0 + s1"), "{hover}");
    // r0 is written by `lrp` and read by `add`, where Neovim's default, UTF-16, has 17 units before it.
    assert_eq!(found["highlights"], json!(["3 2:4-2:6", "2 3:17-3:19"]));
    // c0 leads to its `def` in the second line.
    assert_eq!(found["cursor"], json!([2, 4]));
    // The colour pipe, the alpha pipe, or both.
    assert_eq!(found["completion"], json!(["rgb", "a", "rgba"]));
    let lines = found["lines"].as_array().unwrap();
    assert_eq!(lines.last().unwrap(), "mov r0.rgb, r1");
    assert_eq!(found["exit"], 0);
}

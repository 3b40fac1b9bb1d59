//! The program, run as people run it.
#![allow(clippy::expect_used, reason = "a test that cannot go on has failed")]

mod asm;
mod bench;
mod check;
mod compare;
mod debug;
mod dis;
mod eval;
mod explain;
mod generate;
mod hosts;
mod kernel;
mod models;
mod pictures;
mod policies;
mod run;
mod test;
mod tokens;
mod translate;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// What a run of the program left.
struct Ran {
    status: i32,
    out: String,
    err: String,
}

/// Runs the program in the project's folder with this standard input.
fn texcrd_with_input(arguments: &[&str], input: &[u8]) -> Ran {
    let mut child = Command::new(env!("CARGO_BIN_EXE_texcrd"))
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut stdin = child.stdin.take().expect("standard input is a pipe");
    let input = input.to_vec();
    // In a thread of its own: a program that refuses early does not read to the end.
    let writer = std::thread::spawn(move || {
        let _ = stdin.write_all(&input);
    });
    let Output {
        status,
        stdout,
        stderr,
    } = child.wait_with_output().expect("the program ends");
    writer.join().expect("the input is written");
    Ran {
        status: status.code().expect("no signal ended it"),
        out: String::from_utf8(stdout).expect("results are UTF-8"),
        err: String::from_utf8_lossy(&stderr).into_owned(),
    }
}

fn texcrd(arguments: &[&str]) -> Ran {
    texcrd_with_input(arguments, b"")
}

/// A folder of its own for one test, made empty.
fn folder(test: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(test);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("the folder can be made");
    folder
}

/// Whether tests with a GPU are switched off, which is said.
fn gpu_is_off() -> bool {
    let off = std::env::var("TEXCRD_GPU").is_ok_and(|value| value == "off");
    if off {
        eprintln!("SKIPPED: TEXCRD_GPU=off");
    }
    off
}

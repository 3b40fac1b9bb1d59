//! The debugger in a real terminal: `tmux` gives one that can be looked into. Says so and passes where there is none.

#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod tmux;

use std::fs;
use std::process::Command;
use tmux::Terminal;

/// Starts the debugger and waits for its screen.
fn debug(terminal: &Terminal, listing: &str, values: &str) {
    fs::write(terminal.folder.join("shader.psh"), listing).unwrap();
    let program = env!("CARGO_BIN_EXE_texcrd");
    terminal.start(&format!("'{program}' debug shader.psh {values}"));
    terminal.wait("the debugger", |screen| screen.contains("Listing"));
}

/// Sends the program that was started a signal.
fn kill(terminal: &Terminal, signal: &str) {
    let pid = fs::read_to_string(terminal.folder.join("pid")).unwrap();
    let killed = Command::new("kill").args([signal, pid.trim()]).status();
    assert!(killed.unwrap().success());
}

/// Lines 2, 3, 4 have the instructions.
const LISTING: &str = "ps.1.1\nmov r0, v0\nadd r0, r0, r0\nmul r0, r0, c0\n";

/// The line with the mark of the next instruction.
fn next_line(screen: &str) -> Option<String> {
    let line = screen.lines().find(|line| line.contains("->"))?;
    let text = line.split("->").nth(1)?;
    Some(text.split('│').next()?.trim().to_string())
}

#[test]
fn steps_and_a_signal_in_a_real_terminal() {
    let Some(terminal) = Terminal::new("steps") else {
        return;
    };
    debug(&terminal, LISTING, "--set v0=0.25,0.125,0.5,1 --set c0=0.5");
    let at = |line: &'static str| move |screen: &str| next_line(screen).as_deref() == Some(line);
    let screen = terminal.wait("the start", at("2›mov r0, v0"));
    assert_eq!(screen.lines().count(), 24, "{screen}");
    assert_eq!(terminal.state(), "1 0 1");

    terminal.keys(&["n"]);
    let screen = terminal.wait("a step", at("3›add r0, r0, r0"));
    // r0 = v0, the numbers with four decimals, and the marks of what changed.
    let register = screen.lines().find(|line| line.contains("│r0 ")).unwrap();
    for number in ["*0.2500", "*0.1250", "*0.5000", "*1.0000"] {
        assert!(register.contains(number), "{screen}");
    }
    // A function key, as terminals send it, and a command.
    terminal.keys(&["F10"]);
    terminal.wait("F10", at("4›mul r0, r0, c0"));
    terminal.keys(&["b"]);
    terminal.wait("a step back", at("3›add r0, r0, r0"));
    terminal.keys(&[":"]);
    terminal.type_line("print r0.x + 1");
    terminal.wait("an answer", |screen| screen.contains("1.25"));
    terminal.keys(&["Escape"]);
    terminal.keys(&["?"]);
    terminal.wait("the help", |screen| {
        screen.contains("over the next instruction")
    });
    terminal.keys(&["Escape"]);
    terminal.wait("the listing", at("3›add r0, r0, r0"));

    terminal.ok(&["resize-window", "-t", "main", "-x", "50", "-y", "10"]);
    terminal.wait("a kind word", |screen| {
        screen.contains("This terminal has 50 columns")
    });
    terminal.ok(&["resize-window", "-t", "main", "-x", "120", "-y", "40"]);
    // The last row is that of the keys again.
    terminal.wait("a large screen", |screen| {
        let last = screen.lines().nth(39).unwrap_or_default();
        last.contains("q quit") && at("3›add r0, r0, r0")(screen)
    });

    kill(&terminal, "-TERM");
    terminal.is_usable();
}

#[test]
fn stopped_and_woken() {
    let Some(terminal) = Terminal::new("stopped") else {
        return;
    };
    debug(&terminal, LISTING, "--set v0=1");
    terminal.keys(&["n"]);
    let at_add = |screen: &str| next_line(screen).as_deref() == Some("3›add r0, r0, r0");
    terminal.wait("a step", at_add);
    terminal.keys(&["C-z"]);
    terminal.is_usable();
    terminal.type_line("fg");
    terminal.wait("the debugger again", at_add);
    assert_eq!(terminal.state(), "1 0 1");
    terminal.keys(&["n"]);
    terminal.wait("a step", |screen| {
        next_line(screen).as_deref() == Some("4›mul r0, r0, c0")
    });
    terminal.keys(&["q"]);
    terminal.is_usable();
    // The other signals, each on a fresh start.
    for signal in ["-INT", "-HUP"] {
        debug(&terminal, LISTING, "--set v0=1");
        kill(&terminal, signal);
        terminal.is_usable();
    }
}

//! The debugger in a real terminal: `tmux` gives one that can be looked into. Says so and passes where there is none.

#![cfg(unix)]

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// How long something may take to appear: machines that test are slow and do other things.
const PATIENCE: Duration = Duration::from_secs(30);

/// A terminal of 80 columns and 24 rows with a shell in it.
struct Terminal {
    socket: String,
    folder: PathBuf,
}

impl Terminal {
    /// `None`, said aloud, where there is no `tmux`.
    fn new(name: &str) -> Option<Self> {
        if Command::new("tmux").arg("-V").output().is_err() {
            eprintln!("tmux is missing: the debugger was not tried in a terminal");
            return None;
        }
        let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("terminal_{name}"));
        fs::create_dir_all(&folder).unwrap();
        let terminal = Self {
            socket: format!("texcrd-test-{}-{name}", std::process::id()),
            folder,
        };
        let shell = "env PS1='$ ' ENV= TERM=tmux-256color bash --norc --noprofile -i";
        let size = ["-x", "80", "-y", "24"];
        let session = ["new-session", "-d", "-s", "main"];
        terminal.ok(&[&session[..], &size, &[shell]].concat());
        // Its last line would take one of the 24 rows.
        terminal.ok(&["set", "-g", "status", "off"]);
        terminal.ok(&["resize-window", "-t", "main", "-x", "80", "-y", "24"]);
        terminal.wait("the shell", |screen| screen.trim_end().ends_with('$'));
        Some(terminal)
    }

    fn tmux(&self, arguments: &[&str]) -> Output {
        let mut command = Command::new("tmux");
        command
            .args(["-L", &self.socket, "-f", "/dev/null"])
            .args(arguments);
        // Not inside of a multiplexer that the tests may run in.
        command.env_remove("TMUX").output().unwrap()
    }

    fn ok(&self, arguments: &[&str]) -> String {
        let output = self.tmux(arguments);
        let error = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "tmux {arguments:?}: {error}");
        String::from_utf8_lossy(&output.stdout).into_owned()
    }

    fn screen(&self) -> String {
        self.ok(&["capture-pane", "-p", "-t", "main"])
    }

    /// Keys by the names that tmux has for them.
    fn keys(&self, keys: &[&str]) {
        self.ok(&[&["send-keys", "-t", "main"], keys].concat());
    }

    /// Text, and then Enter.
    fn type_line(&self, text: &str) {
        self.ok(&["send-keys", "-t", "main", "-l", text]);
        self.keys(&["Enter"]);
    }

    /// Waits until the screen is as it should be.
    #[track_caller]
    fn wait(&self, what: &str, is: impl Fn(&str) -> bool) -> String {
        let end = Instant::now() + PATIENCE;
        loop {
            let screen = self.screen();
            if is(&screen) {
                return screen;
            }
            assert!(Instant::now() < end, "waited for {what}:\n{screen}");
            sleep(Duration::from_millis(50));
        }
    }

    /// Whether the alternate screen is on, the cursor is shown, the mouse is listened to.
    fn state(&self) -> String {
        let format = "#{alternate_on} #{cursor_flag} #{mouse_any_flag}";
        self.ok(&["display", "-p", "-t", "main", format])
            .trim()
            .to_string()
    }

    /// Starts the debugger; the shell within leaves its process number behind.
    fn debug(&self, listing: &str, values: &str) {
        fs::write(self.folder.join("shader.psh"), listing).unwrap();
        let program = env!("CARGO_BIN_EXE_texcrd");
        let script = format!("echo $$ > pid; exec '{program}' debug shader.psh {values}");
        fs::write(self.folder.join("start"), script).unwrap();
        self.type_line(&format!("cd '{}'; clear", self.folder.display()));
        self.type_line("sh ./start");
        self.wait("the debugger", |screen| screen.contains("Listing"));
    }

    fn signal(&self, signal: &str) {
        let pid = fs::read_to_string(self.folder.join("pid")).unwrap();
        let killed = Command::new("kill").args([signal, pid.trim()]).status();
        assert!(killed.unwrap().success());
    }

    /// The shell has its terminal back: main screen, cursor, no mouse, and what is typed is shown, line by line.
    #[track_caller]
    fn is_usable(&self) {
        self.wait("the shell again", |screen| !screen.contains("Listing"));
        assert_eq!(self.state(), "0 1 0");
        self.type_line("clear");
        self.type_line(
            "stty -a | tr ' ;' '\\n\\n' | grep -xE -- '-?(echo|icanon|isig|opost)' | tr '\\n' ' '",
        );
        let screen = self.wait("the modes", |screen| screen.contains("isig"));
        // Each on, none with a `-` before it; the order is that of stty.
        for mode in ["echo", "icanon", "isig", "opost"] {
            assert!(!screen.contains(&format!("-{mode} ")), "{screen}");
        }
        self.type_line("clear; echo here$((1 + 1))");
        self.wait("an echo", |screen| {
            screen.lines().any(|line| line == "here2")
        });
    }
}

impl Drop for Terminal {
    fn drop(&mut self) {
        let _ = self.tmux(&["kill-server"]);
    }
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
    terminal.debug(LISTING, "--set v0=0.25,0.125,0.5,1 --set c0=0.5");
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

    terminal.signal("-TERM");
    terminal.is_usable();
}

#[test]
fn stopped_and_woken() {
    let Some(terminal) = Terminal::new("stopped") else {
        return;
    };
    terminal.debug(LISTING, "--set v0=1");
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
        terminal.debug(LISTING, "--set v0=1");
        terminal.signal(signal);
        terminal.is_usable();
    }
}

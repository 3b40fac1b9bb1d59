//! A terminal that can be looked into: `tmux`. Also used by the tests of `src/tui`.

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// How long something may take to appear: machines that test are slow and do other things.
const PATIENCE: Duration = Duration::from_secs(30);

/// A terminal of 80 columns and 24 rows with a shell in it.
pub(crate) struct Terminal {
    socket: String,
    /// A folder of its own.
    pub(crate) folder: PathBuf,
}

impl Terminal {
    /// `None`, said aloud, where there is no `tmux`.
    pub(crate) fn new(name: &str) -> Option<Self> {
        if Command::new("tmux").arg("-V").output().is_err() {
            eprintln!("tmux is missing: the debugger was not tried in a terminal");
            return None;
        }
        let folder =
            std::env::temp_dir().join(format!("texcrd-terminal-{}-{name}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let terminal = Self {
            socket: format!("texcrd-test-{}-{name}", std::process::id()),
            folder,
        };
        let shell =
            "env PS1='$ ' ENV= TERM=tmux-256color RUST_BACKTRACE=0 bash --norc --noprofile -i";
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

    pub(crate) fn ok(&self, arguments: &[&str]) -> String {
        let output = self.tmux(arguments);
        let error = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "tmux {arguments:?}: {error}");
        String::from_utf8_lossy(&output.stdout).into_owned()
    }

    fn screen(&self) -> String {
        self.ok(&["capture-pane", "-p", "-t", "main"])
    }

    /// Keys by the names that tmux has for them. A key right behind Escape would be Alt and that key, as terminals send it.
    pub(crate) fn keys(&self, keys: &[&str]) {
        self.ok(&[&["send-keys", "-t", "main"], keys].concat());
        if keys.last() == Some(&"Escape") {
            sleep(Duration::from_millis(500));
        }
    }

    /// Text, and then Enter.
    pub(crate) fn type_line(&self, text: &str) {
        self.ok(&["send-keys", "-t", "main", "-l", text]);
        self.keys(&["Enter"]);
    }

    /// Waits until the screen is as it should be.
    #[track_caller]
    pub(crate) fn wait(&self, what: &str, is: impl Fn(&str) -> bool) -> String {
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
    pub(crate) fn state(&self) -> String {
        let format = "#{alternate_on} #{cursor_flag} #{mouse_any_flag}";
        self.ok(&["display", "-p", "-t", "main", format])
            .trim()
            .to_string()
    }

    /// Runs a program with the folder as its own; the shell within leaves its process number behind.
    pub(crate) fn start(&self, command: &str) {
        let script = format!(
            "cd '{}'; echo $$ > pid; exec {command}",
            self.folder.display()
        );
        fs::write(self.folder.join("start"), script).unwrap();
        self.type_line(&format!("clear; sh '{}/start'", self.folder.display()));
    }

    /// The shell has its terminal back: main screen, cursor, no mouse, and what is typed is shown, line by line.
    #[track_caller]
    pub(crate) fn is_usable(&self) {
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
        let _ = fs::remove_dir_all(&self.folder);
    }
}

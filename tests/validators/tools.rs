//! Programs of others, where they are installed.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;

/// A program that takes files as its last arguments and refuses with its exit status.
pub(crate) struct Tool {
    program: PathBuf,
    arguments: Vec<String>,
    /// How many files one run takes.
    at_once: usize,
}

/// A file for a tool.
pub(crate) struct Input {
    /// Where the content came from.
    pub(crate) name: String,
    /// What the tool knows the kind of file by.
    pub(crate) extension: &'static str,
    pub(crate) content: Vec<u8>,
}

impl Tool {
    /// The program that an environment variable names, or one of this name on the path.
    pub(crate) fn find(
        variable: &str,
        name: &str,
        arguments: &[&str],
        at_once: usize,
    ) -> Option<Self> {
        let program = match std::env::var_os(variable) {
            Some(path) => PathBuf::from(path),
            None => on_path(name)?,
        };
        Some(Self {
            program,
            arguments: arguments.iter().map(ToString::to_string).collect(),
            at_once,
        })
    }

    /// Whether a run without files succeeds.
    pub(crate) fn works(&self) -> bool {
        let output = Command::new(&self.program).args(&self.arguments).output();
        output.is_ok_and(|output| output.status.success())
    }

    /// Gives all files to the tool, on all cores, and panics with what it says of those that it refuses. `folder` is
    /// where they are written, below the folder for temporary files of the tests.
    pub(crate) fn accept_all(&self, folder: &str, inputs: &[Input]) {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(folder);
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).expect("the folder can be made");
        let files: Vec<PathBuf> = (inputs.iter().enumerate())
            .map(|(number, input)| {
                let path = folder.join(format!("{number}.{}", input.extension));
                fs::write(&path, &input.content).expect("the file can be written");
                path
            })
            .collect();
        let chunks = Mutex::new(files.chunks(self.at_once).zip(inputs.chunks(self.at_once)));
        let refused = Mutex::new(Vec::new());
        std::thread::scope(|scope| {
            for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
                scope.spawn(|| {
                    loop {
                        let next = chunks.lock().unwrap().next();
                        let Some((files, inputs)) = next else { break };
                        if let Some(said) = self.refuses(files) {
                            let of = inputs.iter().zip(files);
                            let of: Vec<String> = of
                                .map(|(input, file)| format!("{} ({})", input.name, file.display()))
                                .collect();
                            refused
                                .lock()
                                .unwrap()
                                .push(format!("{}:\n{said}", of.join(", ")));
                        }
                    }
                });
            }
        });
        let refused = refused.into_inner().unwrap();
        assert!(
            refused.is_empty(),
            "{} refuses {} of {} runs\n{}",
            self.program.display(),
            refused.len(),
            inputs.len().div_ceil(self.at_once),
            refused.into_iter().take(5).collect::<Vec<_>>().join("\n")
        );
    }

    /// What the tool says if it does not take these files.
    fn refuses(&self, files: &[PathBuf]) -> Option<String> {
        let output = Command::new(&self.program)
            .args(&self.arguments)
            .args(files)
            .output()
            .unwrap_or_else(|error| panic!("{}: {error}", self.program.display()));
        if output.status.success() {
            return None;
        }
        let said = [output.stdout, output.stderr].concat();
        Some(String::from_utf8_lossy(&said).into_owned())
    }
}

/// The program of this name on the path.
fn on_path(name: &str) -> Option<PathBuf> {
    let name = format!("{name}{}", std::env::consts::EXE_SUFFIX);
    let path = std::env::var_os("PATH")?;
    let mut places = std::env::split_paths(&path).map(|folder| folder.join(&name));
    places.find(|program| program.is_file())
}

/// Says that a test does nothing, past the capture of the test harness, which would hide it.
pub(crate) fn skipped(what: &str, how: &str) {
    let _ = writeln!(std::io::stderr(), "SKIPPED: {what}. {how}");
}

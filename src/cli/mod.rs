//! The command line: one file a command, thin.
//!
//! Results go to standard output, talk to standard error. Exit status: 0 done; 1 the input is wrong or a check
//! failed; 2 usage or input and output.

mod adapters;
mod asm;
mod baked;
mod bench;
mod check;
mod compare;
mod computing;
#[cfg(feature = "servers")]
mod dap;
mod debug;
mod diagnostics;
mod dis;
mod eval;
mod explain;
mod files;
mod filters;
mod fmt;
mod frames;
mod fuzz_match;
mod generate;
mod given;
mod kernel;
#[cfg(feature = "servers")]
mod lsp;
mod reflect;
mod run;
mod scene;
mod shaders;
mod stats;
mod test;
mod translate;

use clap::{Parser, Subcommand, ValueEnum};
use std::fmt::{Display, Formatter};
use std::process::ExitCode;
use texcrd::policy::Dialect;

/// Runs, checks and translates the shader assembly of Direct3D 8: vs.1.0, vs.1.1 and ps.1.0 to ps.1.4.
#[derive(Parser)]
#[command(version, propagate_version = true, arg_required_else_help = true)]
#[command(after_help = "\
Examples:
  texcrd run asm/stained_glass/scene.toml -o stained_glass.png
  texcrd check --stats shader.psh
  texcrd explain lrp
  texcrd translate shader.vsh shader.psh -o shader.wgsl
  texcrd compare asm/stained_glass/figure5.toml
  texcrd eval shader.psh --set t0=0.5,0.25,0,1 --trace
  texcrd debug scene.toml --pixel 665,136
  texcrd test tests/conformance

`-` is standard input. Exit status: 0 done, 1 the input is wrong, 2 usage or I/O.")]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Adapters(adapters::Arguments),
    Asm(asm::Arguments),
    Bench(bench::Arguments),
    Check(check::Arguments),
    Compare(compare::Arguments),
    #[cfg(feature = "servers")]
    Dap(dap::Arguments),
    Debug(debug::Arguments),
    Dis(dis::Arguments),
    Eval(eval::Arguments),
    Explain(explain::Arguments),
    Fmt(fmt::Arguments),
    FuzzMatch(fuzz_match::Arguments),
    Generate(generate::Arguments),
    Kernel(kernel::Arguments),
    #[cfg(feature = "servers")]
    Lsp(lsp::Arguments),
    Run(run::Arguments),
    Translate(translate::Arguments),
    Test(test::Arguments),
}

/// How results are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum Format {
    /// For people.
    #[default]
    Text,
    /// For programs.
    Json,
}

/// A command ends without having done what it was asked for.
enum Failure {
    /// The input is wrong; what is wrong has been said already.
    Rejected,
    /// The input is wrong for this reason.
    Input(String),
    /// A file could not be read or written, or the arguments do not fit together.
    Io(String),
}

impl Display for Failure {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        match self {
            Failure::Rejected => Ok(()),
            Failure::Input(message) | Failure::Io(message) => f.write_str(message),
        }
    }
}

impl Failure {
    /// Says why on standard error, unless that has been done.
    fn tell(&self) {
        let message = self.to_string();
        if !message.is_empty() {
            anstream::eprintln!("error: {message}");
        }
    }
}

/// What became of several files, of which each that cannot be read or is refused is told of while the others go on.
#[derive(Default)]
struct Files {
    refused: bool,
    unreadable: bool,
}

impl Files {
    /// The content of a file; of one that cannot be read it is said why.
    fn read(&mut self, path: &str) -> Option<Vec<u8>> {
        let read = files::read(path);
        self.unreadable |= read.is_err();
        read.inspect_err(Failure::tell).ok()
    }

    /// Notes that a file was refused.
    fn refuse(&mut self) {
        self.refused = true;
    }

    /// How the command ends.
    fn outcome(&self) -> Outcome {
        match (self.unreadable, self.refused) {
            // It has been said which.
            (true, _) => Err(Failure::Io(String::new())),
            (false, true) => Err(Failure::Rejected),
            (false, false) => Ok(()),
        }
    }
}

type Outcome = Result<(), Failure>;

/// Parses the arguments and runs the command.
pub(crate) fn main() -> ExitCode {
    let command = Arguments::parse().command;
    if let Command::Compare(_) | Command::FuzzMatch(_) | Command::Run(_) | Command::Test(_) =
        command
    {
        filters::make_exact();
    }
    let outcome = match command {
        Command::Adapters(arguments) => adapters::run(&arguments),
        Command::Asm(arguments) => asm::run(&arguments),
        Command::Bench(arguments) => bench::run(&arguments),
        Command::Dis(arguments) => dis::run(&arguments),
        Command::Compare(arguments) => compare::run(&arguments),
        Command::Debug(arguments) => debug::run(&arguments),
        Command::Check(arguments) => check::run(&arguments),
        #[cfg(feature = "servers")]
        Command::Dap(arguments) => dap::run(&arguments),
        Command::Eval(arguments) => eval::run(&arguments),
        Command::Explain(arguments) => explain::run(&arguments),
        Command::Fmt(arguments) => fmt::run(&arguments),
        Command::FuzzMatch(arguments) => fuzz_match::run(&arguments),
        Command::Generate(arguments) => generate::run(&arguments),
        #[cfg(feature = "servers")]
        Command::Lsp(arguments) => lsp::run(&arguments),
        Command::Kernel(arguments) => kernel::run(&arguments),
        Command::Run(arguments) => run::run(&arguments),
        Command::Translate(arguments) => translate::run(&arguments),
        Command::Test(arguments) => test::run(&arguments),
    };
    let Err(failure) = outcome else {
        return ExitCode::SUCCESS;
    };
    failure.tell();
    match failure {
        Failure::Rejected | Failure::Input(_) => ExitCode::from(1),
        Failure::Io(_) => ExitCode::from(2),
    }
}

/// The value parser of `--dialect`.
fn dialect(text: &str) -> Result<Dialect, String> {
    text.parse().map_err(|e| format!("{e}"))
}

/// Writes a result to standard output.
fn print(text: &str) -> Outcome {
    print_to(anstream::stdout(), text.as_bytes())
}

/// Writes a result that is no text to standard output.
fn print_bytes(bytes: &[u8]) -> Outcome {
    print_to(std::io::stdout(), bytes)
}

/// A reader that has gone away is no fault of ours.
fn print_to(mut stream: impl std::io::Write, bytes: &[u8]) -> Outcome {
    match stream.write_all(bytes).and_then(|()| stream.flush()) {
        Err(e) if e.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(Failure::Io(format!("standard output: {e}")))
        }
        _ => Ok(()),
    }
}

/// Prints a JSON value on one line.
fn print_json(value: &serde_json::Value) -> Outcome {
    print(&format!("{value}\n"))
}

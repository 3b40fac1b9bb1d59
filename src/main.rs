//! The program `texcrd`: runs, checks and steps shader listings of Direct3D 8.

mod cli;
#[cfg(feature = "servers")]
mod servers;
#[cfg(feature = "tui")]
mod tui;

use std::process::ExitCode;

fn main() -> ExitCode {
    cli::main()
}

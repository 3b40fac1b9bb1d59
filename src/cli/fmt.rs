//! `fmt`: lays listings out.

use super::{Files, Outcome, files};
use std::path::Path;
use texcrd::extract::{self, Layout};

/// Lays listings out: comments and blank lines stay, comments behind instructions and operands stand in columns.
///
/// Of effects the blocks of assembly are laid out; listings in strings of C stay as they are.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  texcrd fmt water.psh water.fx         in place
  texcrd fmt --check *.psh              which ones would change
  texcrd fmt - < water.psh              to standard output")]
pub(super) struct Arguments {
    /// Listings and effects, which are rewritten in place; `-` is standard input, laid out to standard output.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<String>,
    /// Change nothing; name the files that would change, and end with 1 if there are any.
    #[arg(long)]
    check: bool,
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    let mut outcome = Files::default();
    for path in &arguments.files {
        let Some(bytes) = outcome.read(path) else {
            continue;
        };
        let name = files::name(path);
        let laid_out = match extract::format(&bytes) {
            Layout::Done(text) => text,
            Layout::AsItIs(why) => {
                anstream::eprintln!("{name}: {why}");
                bytes.clone()
            }
            Layout::Nothing(why) => {
                anstream::eprintln!("error: {name}: {why}");
                outcome.refuse();
                continue;
            }
        };
        let changed = laid_out != bytes;
        if arguments.check {
            if changed {
                super::print(&format!("{name}\n"))?;
                outcome.refuse();
            }
        } else if path == "-" || changed {
            files::write(Path::new(path), &laid_out)?;
        }
    }
    outcome.outcome()
}

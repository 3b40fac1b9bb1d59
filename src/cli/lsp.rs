//! `lsp`: the language server, for editors.

use super::{Failure, Outcome};
use crate::servers::lsp;
use std::io;

/// Serves an editor: the language server protocol on standard input and output.
///
/// Editors start this themselves; docs/editors.md says how they are told to. It ends with `exit`, or with its input.
#[derive(clap::Args)]
pub(super) struct Arguments {
    /// Accepted because editors pass it: standard input and output are all there is.
    #[arg(long, hide = true)]
    stdio: bool,
}

pub(super) fn run(_: &Arguments) -> Outcome {
    let input = io::BufReader::new(io::stdin());
    match lsp::serve(input, io::stdout().lock()) {
        Ok(true) => Ok(()),
        // The protocol wants 1 where nobody has said `shutdown`.
        Ok(false) => Err(Failure::Rejected),
        // An editor that has gone away is no fault of ours.
        Err(e) if e.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        Err(e) => Err(Failure::Io(format!("standard output: {e}"))),
    }
}

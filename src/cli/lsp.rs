//! `lsp`: the language server, for editors.

use super::includes::Folders;
use super::{Failure, Outcome};
use crate::servers::lsp::{self, Search, Tools};
use std::io;
use texcrd::preprocess::{Included, Resolver};

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
    match lsp::serve(input, io::stdout().lock(), Tools { include }) {
        Ok(true) => Ok(()),
        // The protocol wants 1 where nobody has said `shutdown`.
        Ok(false) => Err(Failure::Rejected),
        // An editor that has gone away is no fault of ours.
        Err(e) if e.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        Err(e) => Err(Failure::Io(format!("standard output: {e}"))),
    }
}

fn include(
    search: &Search<'_>,
    path: &str,
    angled: bool,
    from: Option<&str>,
) -> io::Result<Included> {
    let folders = Folders {
        file: search.file,
        folders: search.folders,
        open: search.open,
    };
    folders.include(path, angled, from)
}

//! `dap`: the debug adapter, for editors.

use super::{Failure, Outcome, diagnostics, files};
use crate::servers::dap::{self, Tools};
use texcrd::diagnostic::{Diagnostic, SourceMap};

/// Serves an editor: the debug adapter protocol on standard input and output.
///
/// Editors start this themselves; docs/editors.md says how they are told to. It ends with its input.
#[derive(clap::Args)]
pub(super) struct Arguments {}

pub(super) fn run(_: &Arguments) -> Outcome {
    let (input, output) = (std::io::stdin().lock(), std::io::stdout().lock());
    match dap::serve(input, output, TOOLS) {
        // An editor that has gone away is no fault of ours.
        Err(e) if e.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(Failure::Io(format!("standard output: {e}")))
        }
        _ => Ok(()),
    }
}

const TOOLS: Tools = Tools {
    rendered,
    write: |path, bytes| files::write(path, bytes).map_err(|failure| failure.to_string()),
};

/// A diagnostic as the command line shows it.
fn rendered(sources: &SourceMap, diagnostic: &Diagnostic, colours: bool) -> String {
    let text = diagnostics::render(sources, std::slice::from_ref(diagnostic));
    match colours {
        true => text,
        false => anstream::adapter::strip_str(&text).to_string(),
    }
}

//! The servers that editors talk to on standard input and output.
//!
//! `frame` is the way in which both the debug adapter and the language server protocols put messages into a stream; `dap` is the
//! debug adapter, `lsp` the language server. A server reads from and writes to whatever it is given, so that tests talk to it without a process.

pub(crate) mod dap;
mod frame;
pub(crate) mod lsp;

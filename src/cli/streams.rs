//! Which of several shaders of one file is meant.

use super::Failure;
use texcrd::bytecode::{Input, Stream};

/// The shader that `--shader` names, by its name or its number from 1; without it all of the file.
pub(super) fn pick(input: Input, wanted: Option<&str>) -> Result<Vec<Stream>, Failure> {
    let names = names(&input.streams);
    let mut streams = input.streams;
    let Some(wanted) = wanted else {
        return Ok(streams);
    };
    let named = names.iter().position(|name| name == wanted);
    let numbered = || wanted.parse::<usize>().ok()?.checked_sub(1);
    match named.or_else(numbered).filter(|at| *at < streams.len()) {
        Some(at) => Ok(vec![streams.swap_remove(at)]),
        None => Err(Failure::Io(format!(
            "there is no shader `{wanted}`; it is one of {}",
            names.join(", ")
        ))),
    }
}

/// What the shaders of a file are called: the names of their arrays, or their numbers.
pub(super) fn names(streams: &[Stream]) -> Vec<String> {
    let name = |(at, stream): (usize, &Stream)| {
        let name = stream.name.clone();
        name.unwrap_or_else(|| (at + 1).to_string())
    };
    streams.iter().enumerate().map(name).collect()
}

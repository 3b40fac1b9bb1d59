//! The tables against lists written down from the specification, independently of the tables.
//!
//! Each list is text in which a row of the specification is a line, so that it can be compared with the
//! specification by eye.

mod modifiers;
pub(crate) mod opcodes;
mod registers;

use super::Version;

/// The version of a column heading such as `1.3` with its kind: `vs.1.1`, `ps.1.4`.
fn version(name: &str) -> Version {
    Version::all().find(|v| v.name() == name).unwrap()
}

/// The versions of a word such as `ps.1.2-1.4`, `vs.1.1`, `vs`, `ps`, `all`.
pub(crate) fn versions(word: &str) -> Vec<Version> {
    let list: &[&str] = match word {
        "all" => &[
            "vs.1.0", "vs.1.1", "ps.1.0", "ps.1.1", "ps.1.2", "ps.1.3", "ps.1.4",
        ],
        "vs" => &["vs.1.0", "vs.1.1"],
        "ps" => &["ps.1.0", "ps.1.1", "ps.1.2", "ps.1.3", "ps.1.4"],
        "ps.1.0-1.3" => &["ps.1.0", "ps.1.1", "ps.1.2", "ps.1.3"],
        "ps.1.2-1.3" => &["ps.1.2", "ps.1.3"],
        "none" => &[],
        one => return vec![version(one)],
    };
    list.iter().copied().map(version).collect()
}

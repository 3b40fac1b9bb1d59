//! Repairs, until there is nothing left to repair.

use super::File;
use crate::diagnostic::{Diagnostic, SourceMap};
use crate::syntax;

/// How often a text is read again: one repair can uncover the next, as a lost semicolon hides what stands in the line.
const ROUNDS: usize = 8;

/// Applies every certain repair to a file, and those that come to light when it is read again. Gives the text, and how many
/// repairs were applied.
///
/// `read` opens the file and says what is wrong with those of its shaders that are meant.
///
/// # Errors
/// Those of `read`.
pub fn repair<E>(
    mut bytes: Vec<u8>,
    mut read: impl FnMut(&mut SourceMap, Vec<u8>) -> Result<(File, Vec<Diagnostic>), E>,
) -> Result<(Vec<u8>, usize), E> {
    let mut repaired = 0;
    for _ in 0..ROUNDS {
        let mut sources = SourceMap::new();
        let (file, found) = read(&mut sources, bytes.clone())?;
        // Tokens have nothing to repair.
        let own = sources.file_of(file.span.start);
        let Some(own) = own.filter(|own| own.bytes() == bytes) else {
            break;
        };
        let (fixed, count) = syntax::apply_fixes(&sources, own, &found);
        if count == 0 {
            break;
        }
        repaired += count;
        bytes = fixed;
    }
    Ok((bytes, repaired))
}

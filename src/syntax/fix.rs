//! Applying repairs to a text.

use crate::diagnostic::{Diagnostic, SourceFile, SourceMap};

/// The text with every certain repair applied, and how many they were.
///
/// Of two repairs of the same place the first is applied; a second call after reading the result again does the other.
/// Repairs that lie in another text are left out, and those of what a macro has made. In texts that were taken out of
/// another, such as a string of C, what would have to be written otherwise there is left as it is.
pub fn apply_fixes(
    sources: &SourceMap,
    file: &SourceFile,
    diagnostics: &[Diagnostic],
) -> (Vec<u8>, usize) {
    let bytes = file.bytes();
    let base = file.span().start;
    let mut fixes: Vec<(usize, usize, &str)> = diagnostics
        .iter()
        .filter_map(|d| d.fix.as_ref())
        .filter(|fix| fix.certain)
        .filter_map(|fix| {
            let span = sources.editable(fix.span)?;
            let plain = |c: char| !c.is_control() && !matches!(c, '"' | '\\');
            if span != fix.span && !fix.replacement.chars().all(plain) {
                return None;
            }
            let start = span.start.checked_sub(base)? as usize;
            let end = span.end.checked_sub(base)? as usize;
            (start <= end && end <= bytes.len()).then_some((start, end, fix.replacement.as_str()))
        })
        .collect();
    fixes.sort_by_key(|(start, end, _)| (*start, *end));
    let mut out = Vec::with_capacity(bytes.len());
    let (mut done, mut count) = (0, 0);
    let mut last_start = None;
    for (start, end, replacement) in fixes {
        // Two insertions at one place would stand in no known order.
        if start < done || last_start == Some(start) {
            continue;
        }
        out.extend_from_slice(bytes.get(done..start).unwrap_or(&[]));
        out.extend_from_slice(replacement.as_bytes());
        last_start = Some(start);
        done = end;
        count += 1;
    }
    out.extend_from_slice(bytes.get(done..).unwrap_or(&[]));
    (out, count)
}

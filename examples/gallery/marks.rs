//! Texts in Markdown files that programs write.

use std::error::Error;
use std::path::Path;

const END: &str = "<!-- end -->";

/// Puts a text between a line of a page and the next `<!-- end -->`; a page without the line stays as it is.
pub(crate) fn put(page: &Path, begin: &str, text: &str) -> Result<(), Box<dyn Error>> {
    let name = page.display();
    let Ok(old) = std::fs::read_to_string(page) else {
        eprintln!("{name} is missing");
        return Ok(());
    };
    let Some((before, rest)) = old.split_once(begin) else {
        return Ok(());
    };
    let (_, after) = rest
        .split_once(END)
        .ok_or_else(|| format!("{name}: no line `{END}`"))?;
    std::fs::write(page, format!("{before}{begin}\n{text}{END}{after}"))?;
    Ok(())
}

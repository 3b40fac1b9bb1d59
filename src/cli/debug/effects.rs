//! What the console leaves to its front.

use crate::cli::{Failure, files};
use std::path::Path;
use texcrd::debug::{Effect, Text};

/// Does it, and gives what there is to say.
pub(super) fn perform(effect: &Effect, inputs: &[String]) -> Result<Text, Failure> {
    let mut text = Text::default();
    match effect {
        Effect::Write {
            path,
            text: content,
        } => {
            let place = Path::new(path);
            files::is_no_input(place, inputs)?;
            files::write(place, content.as_bytes())?;
            if path != "-" {
                text.line(format!("written: {path}"));
            }
        }
        Effect::Picture { shows, .. } => {
            return Err(Failure::Input(format!(
                "pictures are drawn by `texcrd run --show {}`",
                shows.join(" --show ")
            )));
        }
    }
    Ok(text)
}

//! What the console leaves to its front.

use crate::cli::{Failure, files, run, scene};
use std::path::Path;
use texcrd::debug::{Effect, Session, Subject, Text};
use texcrd::scene::{RenderOptions, Show};
use texcrd::sheet::{Dressing, Tile};

/// Does it, and gives what there is to say. `inputs` are files that nothing may be written over.
pub(super) fn perform(
    effect: &Effect,
    session: &Session<'_>,
    inputs: &[String],
) -> Result<Text, Failure> {
    let path = match effect {
        Effect::Write { path, text } => {
            let place = Path::new(path);
            files::is_no_input(place, inputs)?;
            files::write(place, text.as_bytes())?;
            path
        }
        Effect::Picture { draw, tiles, path } => {
            picture(session, draw, tiles, Path::new(path))?;
            path
        }
    };
    let mut text = Text::default();
    if path != "-" {
        text.line(format!("written: {path}"));
    }
    Ok(text)
}

/// Draws registers of one draw over the whole frame: one in the size of the picture, several smaller on a sheet.
fn picture(session: &Session<'_>, draw: &str, tiles: &[Tile], path: &Path) -> Result<(), Failure> {
    let rendering = match session.subject() {
        Subject::Listing(_) => return Err(Failure::Input("there is no picture".into())),
        Subject::Pixel(subject) => subject.rendering(),
        Subject::Vertex(subject) => subject.rendering(),
    };
    files::can_be_written(path)?;
    let sheet = tiles.len() > 1;
    let size = match sheet {
        true => run::shrunk(rendering.size()),
        false => rendering.size(),
    };
    let options = RenderOptions {
        size: Some(size),
        show: Some(Show {
            draw: Some(draw.to_string()),
            pictures: tiles.iter().map(|tile| tile.picture).collect(),
        }),
    };
    // Without a bar, which would be drawn over a screen.
    let drawn = (rendering.scene().rendering(&options, &|_| {}))
        .map_err(|error| Failure::Input(format!("show: {error}")))?;
    let dressing = Dressing {
        captions: true,
        bars: true,
        columns: None,
    };
    let image = match sheet {
        true => drawn
            .sheet(tiles, dressing)
            .map_err(|error| Failure::Input(format!("show: {error}")))?,
        false => drawn.picture().to_image(),
    };
    scene::write_png(path, &image)
}

//! Contact sheets: pictures of registers side by side, each with its caption, a scale bar that says which colour is which
//! number, and a legend of what is marked in it.
//!
//! Files: `layout` (what stands where), `bar` (scale bars and legends), `text` (letters on pictures).

mod bar;
mod layout;
#[cfg(test)]
mod tests;
mod text;

pub use layout::{Layout, SheetTooLarge};

use crate::raster::{MarkSet, RegisterPicture};
use image::{GenericImage, Rgba, RgbaImage};

/// What is on a tile.
#[derive(Clone, Debug, PartialEq)]
pub struct Tile {
    /// What stands above it.
    pub caption: String,
    /// The register that it shows.
    pub picture: RegisterPicture,
}

/// What a sheet has beside the pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dressing {
    /// The captions of the tiles, and room around each. Without them the first picture is in the upper left corner.
    pub captions: bool,
    /// Scale bars and legends below the pictures.
    pub bars: bool,
}

/// The colour of the sheet where there is nothing.
const PAPER: Rgba<u8> = Rgba([24, 24, 30, 255]);

/// Puts pictures of one size on a sheet. `marks` and `picture` give what occurred in each picture and the picture itself;
/// pictures are asked for one after the other, so that only one of them is held.
///
/// # Errors
/// [`SheetTooLarge`] beyond [`Layout::MAX_PIXELS`].
pub fn compose(
    tiles: &[Tile],
    size: [u32; 2],
    dressing: Dressing,
    marks: &[MarkSet],
    mut picture: impl FnMut(usize) -> RgbaImage,
) -> Result<RgbaImage, SheetTooLarge> {
    let layout = Layout::new(tiles, size, dressing, marks)?;
    let [width, height] = layout.size();
    let mut sheet = RgbaImage::from_pixel(width, height, PAPER);
    for (number, tile) in tiles.iter().enumerate() {
        let picture = picture(number);
        let [x, y] = layout.picture(number);
        // Both have the size that the layout was made for; a picture of another one leaves its place empty.
        let _ = sheet.copy_from(&picture, x, y);
        for (row, line) in layout.caption(tile).iter().enumerate() {
            let [x, y] = layout.caption_row(number, row);
            text::write(&mut sheet, [x, y], line);
        }
        if dressing.bars {
            let at = layout.bar(number);
            let width = layout.bar_width();
            bar::draw(&mut sheet, at, width, &tile.picture.look);
            let marks = marks.get(number).copied().unwrap_or_default();
            bar::legend(&mut sheet, layout.legend(number), marks, &picture);
        }
    }
    Ok(sheet)
}

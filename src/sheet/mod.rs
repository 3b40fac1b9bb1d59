//! Contact sheets: pictures of registers side by side, each with its caption, a scale bar that says which colour is which
//! number, and a legend of what is marked in it.
//!
//! ```
//! use std::collections::BTreeMap;
//! use texcrd::raster::Look;
//! use texcrd::scene::{LoadOptions, RenderOptions, Scene, Show, ShowExpression};
//! use texcrd::sheet::Dressing;
//!
//! let text = r#"
//! size = [64, 48]
//! [meshes.all]
//! positions = [[-1, 1, 0], [1, 1, 0], [1, -1, 0]]
//! [[draw]]
//! mesh = "all"
//! vs_text = "vs.1.1\nmov oPos, v0\nmov oT0, v0\n"
//! ps_text = "ps.1.4\ntexcrd r1.rgb, t0\nmul r0.rgb, r1, r1\n+mov r0.a, r1.b\n"
//! "#;
//! let no_files: BTreeMap<String, Vec<u8>> = BTreeMap::new();
//! let scene = Scene::load("scene.toml", text.as_bytes(), &no_files, &LoadOptions::default())?;
//!
//! // One tile for each instruction of the last draw. The last pass is the picture.
//! let all: ShowExpression = "all".parse()?;
//! let pass = scene.passes(scene.size()).pop().expect("every scene has a picture");
//! let tiles = all.tiles(&scene, &pass.draws[scene.shown_draw(None)?], Look::default(), false)?;
//! assert_eq!(tiles[1].caption, "3 mul r0.rgb, r1, r1");
//!
//! let pictures = tiles.iter().map(|tile| tile.picture).collect();
//! let options = RenderOptions { size: None, show: Some(Show { draw: None, pictures }) };
//! let drawn = scene.rendering(&options, &|_| {})?;
//! assert_eq!(drawn.picture().plane(1).dimensions(), (64, 48));
//! let sheet = drawn.sheet(&tiles, Dressing { captions: true, bars: true, columns: None })?;
//! assert!(sheet.width() > 3 * 64);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Files: `layout` (what stands where), `bar` (scale bars and legends), `text` (letters on pictures).

mod bar;
mod layout;
#[cfg(test)]
mod tests;
mod text;

pub use layout::{Layout, SheetTooLarge};

use crate::raster::{MarkSet, RegisterPicture};
use image::{Rgba, RgbaImage};

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
    /// How many pictures stand side by side; without it as many as bring the shape of the sheet nearest to that of a screen.
    pub columns: Option<u32>,
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
        place(&mut sheet, &picture, [x, y]);
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

/// Puts a picture on the sheet, its upper left corner here; what would not fit is left out.
fn place(sheet: &mut RgbaImage, picture: &RgbaImage, [x, y]: [u32; 2]) {
    let bytes = |pixels: u32| 4 * pixels as usize;
    let (across, own) = (bytes(sheet.width()), bytes(picture.width()));
    if across == 0 || own == 0 {
        return;
    }
    let rows = sheet.chunks_exact_mut(across).skip(y as usize);
    for (row, pixels) in rows.zip(picture.chunks_exact(own)) {
        for (to, from) in row.iter_mut().skip(bytes(x)).zip(pixels) {
            *to = *from;
        }
    }
}

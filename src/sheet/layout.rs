//! What stands where on a sheet.

use super::{Dressing, Tile, bar, text};
use crate::raster::{MarkSet, Target};
use std::fmt;

/// The room around a tile with captions.
const GAP: u32 = 8;
/// A tile is at least so wide that captions and bars can be read.
const LEAST_WIDTH: u32 = 24 * text::WIDTH;
/// A caption has at most so many rows.
const MOST_ROWS: usize = 3;
/// Sheets are as near as can be to this ratio of width to height.
const RATIO: f64 = 1.6;

/// A sheet of a size that this crate refuses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SheetTooLarge {
    /// How many pictures.
    pub pictures: usize,
    /// The size of each.
    pub size: [u32; 2],
}

impl fmt::Display for SheetTooLarge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (count, [width, height]) = (self.pictures, self.size);
        write!(
            f,
            "a sheet of {count} pictures of {width}×{height} pixels is too large: at most {} pixels in all",
            Layout::MAX_PIXELS
        )
    }
}

impl std::error::Error for SheetTooLarge {}

/// Where the tiles of a sheet are: in rows from left to right, all of one size. A tile has, from above: the caption, the
/// picture, the scale bar, the legend.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layout {
    columns: u32,
    rows: u32,
    /// The size of the pictures.
    picture: [u32; 2],
    /// The size of a tile, without the gap.
    tile: [u32; 2],
    caption_rows: u32,
    gap: u32,
}

impl Layout {
    /// The largest number of pixels of a sheet, which take 4 bytes each.
    pub const MAX_PIXELS: u64 = 2 * Target::MAX_PIXELS;

    /// The layout for these tiles, with pictures of this size in which these marks may occur.
    ///
    /// # Errors
    /// [`SheetTooLarge`].
    pub fn new(
        tiles: &[Tile],
        size: [u32; 2],
        dressing: Dressing,
        marks: &[MarkSet],
    ) -> Result<Self, SheetTooLarge> {
        let refused = SheetTooLarge {
            pictures: tiles.len(),
            size,
        };
        let count = u32::try_from(tiles.len()).map_err(|_| refused)?.max(1);
        let [width, height] = size;
        // Beyond this nothing below could be added up.
        if size.iter().any(|side| *side > Target::MAX_SIDE) || tiles.len() > Target::MAX_PLANES {
            return Err(refused);
        }
        let least = match dressing.captions || dressing.bars {
            true => LEAST_WIDTH,
            false => 0,
        };
        let mut layout = Self {
            columns: 1,
            rows: count,
            picture: size,
            tile: [width.max(least), height],
            caption_rows: 0,
            gap: if dressing.captions { GAP } else { 0 },
        };
        if dressing.captions {
            let rows = tiles.iter().map(|tile| layout.wrapped(tile).len()).max();
            layout.caption_rows = rows.unwrap_or(0) as u32;
        }
        layout.tile[1] += layout.caption_rows * text::HEIGHT;
        if dressing.bars {
            let rows = marks.iter().map(|marks| marks.iter().count()).max();
            layout.tile[1] += bar::HEIGHT + rows.unwrap_or(0) as u32 * text::HEIGHT;
        }
        let off = |columns: u32| {
            let [width, height] = layout.with_columns(columns, count).sides();
            (width as f64 / height as f64 / RATIO).ln().abs()
        };
        let best = (1..=count).min_by(|a, b| off(*a).total_cmp(&off(*b)));
        let wanted = dressing.columns.map(|columns| columns.clamp(1, count));
        let layout = layout.with_columns(wanted.or(best).unwrap_or(1), count);
        let [width, height] = layout.sides();
        match width.saturating_mul(height) <= Self::MAX_PIXELS {
            true => Ok(layout),
            false => Err(refused),
        }
    }

    fn with_columns(&self, columns: u32, count: u32) -> Self {
        Self {
            columns,
            rows: count.div_ceil(columns),
            ..self.clone()
        }
    }

    /// Both sides, before it is known that they are small enough.
    fn sides(&self) -> [u64; 2] {
        let side = |count: u32, tile: u32| {
            u64::from(count) * u64::from(tile + self.gap) + u64::from(self.gap)
        };
        [
            side(self.columns, self.tile[0]).max(1),
            side(self.rows, self.tile[1]).max(1),
        ]
    }

    /// Width and height of the sheet in pixels.
    pub fn size(&self) -> [u32; 2] {
        // Within the limit on pixels, so within 32 bits.
        self.sides().map(|side| side as u32)
    }

    /// How many tiles stand side by side.
    pub fn columns(&self) -> u32 {
        self.columns
    }

    /// The upper left pixel of a tile.
    fn tile(&self, number: usize) -> [u32; 2] {
        let number = number as u32;
        let place = [number % self.columns, number / self.columns];
        [0, 1].map(|axis| self.gap + place[axis] * (self.tile[axis] + self.gap))
    }

    /// The upper left pixel of the picture of a tile.
    pub fn picture(&self, number: usize) -> [u32; 2] {
        self.caption_row(number, self.caption_rows as usize)
    }

    /// The upper left pixel of a row of its caption.
    pub(super) fn caption_row(&self, number: usize, row: usize) -> [u32; 2] {
        let [x, y] = self.tile(number);
        [x, y + row as u32 * text::HEIGHT]
    }

    /// The upper left pixel of its scale bar.
    pub(super) fn bar(&self, number: usize) -> [u32; 2] {
        let [x, y] = self.picture(number);
        [x, y + self.picture[1]]
    }

    /// How wide the scale bars are.
    pub(super) fn bar_width(&self) -> u32 {
        self.tile[0]
    }

    /// The upper left pixel of its legend.
    pub(super) fn legend(&self, number: usize) -> [u32; 2] {
        let [x, y] = self.bar(number);
        [x, y + bar::HEIGHT]
    }

    /// The rows of a caption; none if there are no captions.
    pub(super) fn caption(&self, tile: &Tile) -> Vec<String> {
        match self.caption_rows {
            0 => Vec::new(),
            _ => self.wrapped(tile),
        }
    }

    /// A caption broken between words into rows; what is too long ends in dots.
    fn wrapped(&self, tile: &Tile) -> Vec<String> {
        let most = (self.tile[0] / text::WIDTH).max(4) as usize;
        let mut rows: Vec<String> = Vec::new();
        for word in tile.caption.split_whitespace() {
            match rows.last_mut() {
                Some(row) if row.chars().count() + 1 + word.chars().count() <= most => {
                    row.push(' ');
                    row.push_str(word);
                }
                _ => rows.push(word.to_owned()),
            }
        }
        let cut = rows.len() > MOST_ROWS;
        rows.truncate(MOST_ROWS);
        let last = rows.len().saturating_sub(1);
        for (number, row) in rows.iter_mut().enumerate() {
            if row.chars().count() > most || (cut && number == last) {
                *row = row.chars().take(most - 3).chain("...".chars()).collect();
            }
        }
        rows
    }
}

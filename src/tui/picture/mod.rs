//! Pictures in a terminal: as real pixels where it can, as half blocks elsewhere.
//!
//! Views say where a picture stands and what it shows ([`Placed`]); for terminals with real pixels [`Pictures`] turns that into
//! what is sent, and sends nothing again that is there already. Files: `crop` (which part of a picture, how large), `ask` (what
//! the terminal can), `kitty`, `iterm`, `sixel` (the three ways to send pixels), `base64`.

mod ask;
mod base64;
mod crop;
mod iterm;
mod kitty;
mod sixel;

pub(super) use ask::{Answers, ask};
pub(super) use crop::{Canvas, Crop};

use image::RgbImage;
use ratatui::layout::Rect;
use std::str::FromStr;

/// How pictures reach the terminal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Protocol {
    /// As characters: two pixels above each other in a cell.
    Blocks,
    /// The graphics protocol of kitty.
    Kitty,
    /// The graphics of DEC's terminals.
    Sixel,
    /// The inline images of iTerm2.
    Iterm,
}

impl FromStr for Protocol {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        match name {
            "blocks" => Ok(Self::Blocks),
            "kitty" => Ok(Self::Kitty),
            "sixel" => Ok(Self::Sixel),
            "iterm2" => Ok(Self::Iterm),
            _ => Err("one of blocks, kitty, sixel, iterm2".to_string()),
        }
    }
}

/// A picture of real pixels and the cells that it covers.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Placed {
    /// The cells.
    pub area: Rect,
    /// The pixels, one of the terminal each.
    pub image: RgbImage,
}

/// What a terminal shows as real pixels.
#[derive(Debug)]
pub(super) struct Pictures {
    protocol: Protocol,
    cell: Option<[u16; 2]>,
    shown: Vec<Placed>,
}

impl Pictures {
    /// Pictures go out through `protocol`; through half blocks if nobody knows how many pixels a cell has.
    pub(super) fn new(protocol: Protocol, cell: Option<[u16; 2]>) -> Self {
        let cell = cell.filter(|[w, h]| protocol != Protocol::Blocks && *w > 0 && *h > 0);
        Self {
            protocol,
            cell,
            shown: Vec::new(),
        }
    }

    /// Width and height of a cell in pixels; `None` where pictures are half blocks.
    pub(super) fn cell(&self) -> Option<[u16; 2]> {
        self.cell
    }

    /// The cells have another size from now on, if it is known.
    pub(super) fn resize(&mut self, cell: Option<[u16; 2]>) {
        self.cell = cell.filter(|[w, h]| *w > 0 && *h > 0).or(self.cell);
    }

    /// Whether something is shown in cells that `next` uses otherwise: then the screen has to be drawn from scratch.
    pub(super) fn leaves_traces(&self, next: &[Placed]) -> bool {
        let stays = |old: &Placed| next.iter().any(|new| new.area == old.area);
        !self.shown.iter().all(stays)
    }

    /// The screen has been cleared; what takes away those pictures that live beside the characters.
    pub(super) fn clear(&mut self) -> String {
        self.shown.clear();
        match self.protocol {
            Protocol::Kitty => kitty::DELETE_ALL.to_string(),
            _ => String::new(),
        }
    }

    /// What shows these pictures; nothing for those that are there.
    pub(super) fn show(&mut self, next: Vec<Placed>) -> String {
        let mut out = String::new();
        for (number, placed) in next.iter().enumerate() {
            if self.shown.contains(placed) {
                continue;
            }
            out += &format!("\x1b[{};{}H", placed.area.y + 1, placed.area.x + 1);
            out += &match self.protocol {
                Protocol::Kitty => kitty::encode(&placed.image, number as u32 + 1),
                Protocol::Iterm => iterm::encode(&placed.image),
                Protocol::Sixel => sixel::encode(&placed.image),
                Protocol::Blocks => String::new(),
            };
        }
        self.shown = next;
        out
    }
}

/// A picture as a PNG file; empty if it cannot be written, which for pictures in memory does not happen.
fn png(image: &RgbImage) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    match image.write_to(&mut bytes, image::ImageFormat::Png) {
        Ok(()) => bytes.into_inner(),
        Err(_) => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Rgb;

    fn placed(x: u16, colour: u8) -> Placed {
        Placed {
            area: Rect::new(x, 2, 3, 2),
            image: RgbImage::from_pixel(4, 4, Rgb([colour; 3])),
        }
    }

    #[test]
    fn a_picture_is_sent_once() {
        let mut pictures = Pictures::new(Protocol::Kitty, Some([8, 16]));
        let first = pictures.show(vec![placed(5, 0)]);
        // Row 3, column 6, from 1.
        assert!(first.starts_with("\x1b[3;6H\x1b_G"), "{first:?}");
        assert_eq!(pictures.show(vec![placed(5, 0)]), "");
        assert_ne!(pictures.show(vec![placed(5, 9)]), "");
        assert!(!pictures.leaves_traces(&[placed(5, 1)]));
        assert!(pictures.leaves_traces(&[placed(6, 9)]));
        assert!(pictures.leaves_traces(&[]));
        assert_eq!(pictures.clear(), kitty::DELETE_ALL);
        assert!(!pictures.leaves_traces(&[]));
    }

    #[test]
    fn without_the_size_of_a_cell_there_are_blocks() {
        assert_eq!(Pictures::new(Protocol::Sixel, None).cell(), None);
        assert_eq!(Pictures::new(Protocol::Sixel, Some([8, 0])).cell(), None);
        assert_eq!(Pictures::new(Protocol::Blocks, Some([8, 16])).cell(), None);
    }
}

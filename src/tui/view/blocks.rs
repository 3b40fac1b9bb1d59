//! Pictures in half blocks: two pixels in a cell. Without colours a character as bright as both.

use crate::tui::picture::{Canvas, Placed};
use crate::tui::theme::{Theme, brightness, shade};
use image::{Rgb, RgbImage};
use ratatui::buffer::Buffer;
use ratatui::style::Style;

/// Draws a picture, as characters or, where a cell has a size in pixels, as one of real ones. `marks` are pixels of the
/// picture that are pointed at; `sign` does so in half blocks.
pub(super) fn draw(
    canvas: &Canvas,
    at: impl Fn(u32, u32) -> [u8; 3],
    marks: &[[u32; 2]],
    sign: &str,
    look: (Theme, Option<[u16; 2]>),
    buf: &mut Buffer,
) -> Option<Placed> {
    let (theme, cell) = look;
    let mut image = canvas.draw(at);
    if cell.is_some() {
        let covered = marks.iter().filter_map(|mark| canvas.target_of(*mark));
        covered.for_each(|covered| outline(&mut image, covered));
        return Some(Placed {
            area: canvas.area,
            image,
        });
    }
    for position in canvas.area.positions() {
        let x = u32::from(position.x - canvas.area.x);
        let y = u32::from(position.y - canvas.area.y) * 2;
        let pixel = |y: u32| image.get_pixel_checked(x, y).map(|pixel| pixel.0);
        let (Some(upper), lower) = (pixel(y), pixel(y + 1)) else {
            continue;
        };
        let cell = &mut buf[position];
        match theme.colour(upper) {
            Some(colour) => {
                let style = Style::default().fg(colour);
                let below = lower.and_then(|lower| theme.colour(lower));
                cell.set_symbol("▀");
                cell.set_style(below.map_or(style, |below| style.bg(below)));
            }
            None => {
                cell.set_char(shade(mean(upper, lower.unwrap_or(upper))));
            }
        }
    }
    for [x, y] in marks.iter().filter_map(|mark| canvas.cell_of(*mark)) {
        let pixel = |y: u32| {
            let row = y - u32::from(canvas.area.y) * 2;
            image.get_pixel_checked(u32::from(x - canvas.area.x), row)
        };
        let upper = pixel(u32::from(y) * 2).map_or([0; 3], |pixel| pixel.0);
        let cell = &mut buf[(x, y)];
        cell.set_symbol(sign);
        if let Some(ground) = theme.colour(upper) {
            let contrast = if brightness(upper) < 128 {
                [255; 3]
            } else {
                [0; 3]
            };
            let style = Style::default().bg(ground);
            cell.set_style(theme.colour(contrast).map_or(style, |c| style.fg(c)));
        }
    }
    None
}

fn mean(a: [u8; 3], b: [u8; 3]) -> [u8; 3] {
    std::array::from_fn(|i| a[i].midpoint(b[i]))
}

/// How large a mark is at least, in pixels of the terminal.
const MARK: u32 = 9;

/// A frame of white within black around some pixels, which stand out from everything.
fn outline(image: &mut RgbImage, covered: [[u32; 2]; 2]) {
    let [x, y] = covered.map(|[first, last]| {
        let missing = MARK.saturating_sub(last - first + 1).div_ceil(2) + 1;
        (
            i64::from(first) - i64::from(missing),
            i64::from(last) + i64::from(missing),
        )
    });
    for (grown, colour) in [(0, Rgb([255; 3])), (1, Rgb([0; 3]))] {
        let ([left, right], [top, bottom]) =
            ([x.0 - grown, x.1 + grown], [y.0 - grown, y.1 + grown]);
        let horizontal = (left..=right).flat_map(|x| [(x, top), (x, bottom)]);
        let vertical = (top..=bottom).flat_map(|y| [(left, y), (right, y)]);
        for (x, y) in horizontal.chain(vertical) {
            if let (Ok(x), Ok(y)) = (u32::try_from(x), u32::try_from(y))
                && let Some(pixel) = image.get_pixel_mut_checked(x, y)
            {
                *pixel = colour;
            }
        }
    }
}

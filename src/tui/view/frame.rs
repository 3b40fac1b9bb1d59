//! The frame as a small picture, with the pixel marked.

use super::{Screen, blocks, clean, put};
use crate::tui::picture::{Canvas, Crop, Placed};
use image::RgbaImage;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use texcrd::debug::Style;

/// The frame that is debugged.
pub(in crate::tui) struct Frame {
    /// The picture.
    pub image: RgbaImage,
    /// The pixel that is marked: the one that is recorded, unless nothing is drawn there.
    pub mark: [u32; 2],
    /// Why the marked pixel is not recorded.
    pub refusal: Option<String>,
}

/// Rows or columns of text beside the picture.
const TEXT: [u16; 2] = [13, 4];

/// The place of the picture and that of the text: below where it is high, beside it otherwise.
fn divide(area: Rect) -> (Rect, Rect) {
    let [width, height] = TEXT;
    if area.height >= 14 {
        let picture = Rect {
            height: area.height - height,
            ..area
        };
        let text = Rect {
            y: picture.bottom(),
            height,
            ..area
        };
        (picture, text)
    } else {
        let picture = Rect {
            width: area.width.saturating_sub(width + 1),
            ..area
        };
        let text = Rect {
            x: picture.right() + 1,
            width: area.width.saturating_sub(picture.width + 1),
            ..area
        };
        (picture, text)
    }
}

/// Where the frame stands in its pane.
pub(in crate::tui) fn canvas(
    area: Rect,
    frame: &Frame,
    zoom: u32,
    cell: Option<[u16; 2]>,
) -> Option<Canvas> {
    let crop = Crop::around(frame.image.dimensions().into(), frame.mark, zoom);
    Canvas::new(divide(area).0, crop, cell)
}

pub(super) fn draw(
    screen: &Screen<'_, '_>,
    buf: &mut Buffer,
    area: Rect,
    pictures: &mut Vec<Placed>,
) -> String {
    let Some(frame) = screen.frame else {
        let lines = [
            "No frame: this is not a pixel of a",
            "scene. `texcrd debug SCENE --pixel X,Y`",
            "shows one.",
        ];
        for (row, line) in lines.into_iter().enumerate() {
            put(buf, area, row, Line::from(line));
        }
        return String::new();
    };
    let zoom = screen.model.frame_zoom;
    let Some(canvas) = canvas(area, frame, zoom, screen.cell) else {
        return String::new();
    };
    let at = |x: u32, y: u32| {
        let pixel = frame.image.get_pixel_checked(x, y);
        pixel.map_or([0; 3], |pixel| [pixel[0], pixel[1], pixel[2]])
    };
    let look = (screen.theme, screen.cell);
    pictures.extend(blocks::draw(&canvas, at, &[frame.mark], "┼", look, buf));
    let [x, y] = frame.mark;
    let [red, green, blue] = at(x, y);
    let colours = screen.theme.style(&Style::Swatch([red, green, blue]));
    let mut lines = vec![
        Line::from(format!("{x}, {y}")),
        Line::from(vec![
            Span::raw(format!("#{red:02x}{green:02x}{blue:02x} ")),
            Span::styled("  ", colours),
        ]),
        Line::from(if zoom > 1 {
            format!("zoom {zoom}x")
        } else {
            String::new()
        }),
    ];
    if let Some(refusal) = &frame.refusal {
        let room = divide(area).1;
        let words = super::output::words(&clean(refusal), usize::from(room.width));
        let style = screen.theme.style(&Style::Error);
        lines.extend(words.into_iter().map(|line| Line::styled(line, style)));
    }
    for (row, line) in lines.into_iter().enumerate() {
        put(buf, divide(area).1, row, line);
    }
    format!("{x}, {y}")
}

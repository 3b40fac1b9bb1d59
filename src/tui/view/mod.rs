//! What the screen shows: one file a pane. Everything here reads; nothing changes.

mod blocks;
mod frame;
mod help;
mod listing;
mod output;
mod prompt;
mod quad;
mod registers;
mod status;
mod texture;
mod watches;

pub(super) use frame::{Frame, canvas as frame_canvas};
pub(super) use help::lines as help_lines;
pub(super) use listing::{Page, top as listing_top};
pub(super) use output::wrapped as wrapped_output;
pub(super) use registers::rows as register_rows;

use super::layout::{Layout, Pane, SMALLEST, body};
use super::model::Model;
use super::picture::Placed;
use super::theme::{Colours, Theme};
use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};
use ratatui::text::{Line, Span};
use std::ops::Range;
use texcrd::debug::{Console, Session, Style};

/// Everything that is shown.
#[derive(Clone, Copy)]
pub(super) struct Screen<'s, 'a> {
    /// Where one is.
    pub session: &'s Session<'a>,
    /// Breakpoints and watches.
    pub console: &'s Console,
    /// The state of the screen.
    pub model: &'s Model,
    /// The frame that the pixel is one of.
    pub frame: Option<&'s Frame>,
    /// How things look.
    pub theme: Theme,
    /// Width and height of a cell in pixels; `None` where pictures are half blocks.
    pub cell: Option<[u16; 2]>,
}

impl Screen<'_, '_> {
    /// Draws everything; what is left are the pictures of real pixels and the place of the cursor.
    pub(super) fn draw(&self, buf: &mut Buffer) -> (Vec<Placed>, Option<Position>) {
        let area = *buf.area();
        let Some(layout) = Layout::new(area, self.model.view, self.frame.is_some()) else {
            too_small(buf, area);
            return (Vec::new(), None);
        };
        if let Some(first) = self.model.help {
            help::draw(buf, area, self.theme, first);
            return (Vec::new(), None);
        }
        status::draw(self, buf, layout.status);
        for rule in &layout.rules {
            for position in rule.positions() {
                buf[position].set_symbol("│");
            }
        }
        let mut pictures = Vec::new();
        let shared = layout.shared().map(|(pane, _)| pane);
        for (pane, area) in &layout.panes {
            let room = body(*area);
            let right = match pane {
                Pane::Listing => listing::draw(self, buf, room),
                Pane::Registers => registers::draw(self, buf, room),
                Pane::Output => output::draw(self, buf, room),
                Pane::Watches => watches::draw(self, buf, room),
                Pane::Frame => frame::draw(self, buf, room, &mut pictures),
                Pane::Texture => texture::draw(self, buf, room, &mut pictures),
                Pane::Quad => quad::draw(self, buf, room),
            };
            if shared == Some(*pane) {
                self.tabs(buf, *area, &layout);
            } else {
                self.heading(buf, *area, *pane, &right);
            }
        }
        let cursor = prompt::draw(self, buf, layout.prompt);
        (pictures, cursor)
    }

    fn has_focus(&self, pane: Pane) -> bool {
        self.model.focus == pane && !self.model.typing
    }

    /// The first row of a pane: its name on the left, something about it on the right.
    fn heading(&self, buf: &mut Buffer, area: Rect, pane: Pane, right: &str) {
        let focused = self.has_focus(pane);
        self.rule(buf, area, focused);
        let name = if focused {
            format!("[{}]", pane.name())
        } else {
            format!(" {} ", pane.name())
        };
        let style = self.theme.heading(focused);
        buf.set_stringn(area.x + 1, area.y, &name, usize::from(area.width), style);
        let left = name.chars().count() + 2;
        let right = clipped(right, usize::from(area.width).saturating_sub(left + 3));
        if !right.is_empty() {
            let x = area
                .right()
                .saturating_sub(right.chars().count() as u16 + 3);
            buf.set_stringn(
                x,
                area.y,
                format!(" {right} "),
                usize::from(area.width),
                ratatui::style::Style::default(),
            );
        }
    }

    /// The heading of the place that several panes share.
    fn tabs(&self, buf: &mut Buffer, area: Rect, layout: &Layout) {
        let shown = layout.shared().map(|(pane, _)| pane);
        self.rule(buf, area, shown.is_some_and(|pane| self.has_focus(pane)));
        for (pane, columns, text) in tabs(layout) {
            let focused = shown == Some(pane) && self.has_focus(pane);
            let sides = match (focused, shown == Some(pane)) {
                (true, _) => ["[", "]"],
                (false, true) => ["‹", "›"],
                (false, false) => [" ", " "],
            };
            let text = sides.join(&text);
            let style = self.theme.heading(focused);
            buf.set_stringn(columns.start, area.y, text, columns.len(), style);
        }
    }

    fn rule(&self, buf: &mut Buffer, area: Rect, focused: bool) {
        let line = if focused { "═" } else { "─" };
        let style = self.theme.heading(focused);
        for x in area.left()..area.right() {
            buf[(x, area.y)].set_symbol(line).set_style(style);
        }
    }
}

/// The names in the heading of the shared place, with the columns they stand in.
pub(super) fn tabs(layout: &Layout) -> Vec<(Pane, Range<u16>, String)> {
    let Some((_, area)) = layout.shared() else {
        return Vec::new();
    };
    let mut x = area.x;
    let mut found = Vec::new();
    for (number, pane) in layout.shares() {
        let text = format!("{} {}", number + 1, pane.name());
        // One more on each side, for what tells the one that is shown.
        let end = (x + text.chars().count() as u16 + 2).min(area.right());
        found.push((pane, x..end, text));
        x = end;
    }
    found
}

/// What a screen without room says.
fn too_small(buf: &mut Buffer, area: Rect) {
    let [width, height] = SMALLEST;
    let lines = [
        format!(
            "This terminal has {} columns and {} rows.",
            area.width, area.height
        ),
        format!("The debugger needs {width} and {height}: please make it larger."),
        "q quits; `texcrd debug --plain` needs no room.".to_string(),
    ];
    // Words go on in the next row: there may be very few columns.
    let wrapped = lines
        .iter()
        .flat_map(|line| output::words(line, usize::from(area.width)));
    for (row, line) in wrapped.enumerate().take(usize::from(area.height)) {
        put(buf, area, row, Line::from(line));
    }
}

/// A row of a pane; nothing below its end.
fn put(buf: &mut Buffer, area: Rect, row: usize, line: Line<'_>) {
    if row < usize::from(area.height) {
        buf.set_line(area.x, area.y + row as u16, &line, area.width);
    }
}

/// A line of the debugger's text.
fn line<'t>(line: &'t texcrd::debug::Line, theme: Theme) -> Line<'t> {
    let pieces = line.pieces.iter();
    pieces
        .map(|piece| match piece.style {
            // A field of its colour where there are colours.
            Style::Swatch(_) if theme.colours != Colours::None => {
                Span::styled("  ", theme.style(&piece.style))
            }
            _ => Span::styled(piece.text.as_str(), theme.style(&piece.style)),
        })
        .collect()
}

/// Text from outside, as it can stand on a screen: no control characters, tabs as spaces.
fn clean(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\t' => out.extend(std::iter::repeat_n(' ', 8 - out.chars().count() % 8)),
            c if c.is_control() => out.push('·'),
            c => out.push(c),
        }
    }
    out
}

/// The beginning of a text, with `…` for what is missing.
fn clipped(text: &str, width: usize) -> String {
    if text.chars().count() <= width {
        return text.to_string();
    }
    let kept: String = text.chars().take(width.saturating_sub(1)).collect();
    if width == 0 { kept } else { kept + "…" }
}

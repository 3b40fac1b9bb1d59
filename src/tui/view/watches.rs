//! The watches: expressions, and what they are here.

use super::{Screen, line, put};
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Line;

pub(super) fn draw(screen: &Screen<'_, '_>, buf: &mut Buffer, area: Rect) -> String {
    let shown = screen.console.watches(screen.session);
    if shown.lines.is_empty() {
        let lines = ["No watches. `:watch r0.rgb` adds one", "that is shown here at every step."];
        for (row, line) in lines.into_iter().enumerate() {
            put(buf, area, row, Line::from(line));
        }
    }
    let height = usize::from(area.height);
    let first = screen.model.watches.min(shown.lines.len().saturating_sub(height));
    for (row, text) in shown.lines.iter().skip(first).take(height).enumerate() {
        put(buf, area, row, line(text, screen.theme));
    }
    String::new()
}

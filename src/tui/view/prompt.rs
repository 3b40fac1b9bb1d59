//! The command line, what Tab found, and the hint where nobody types.

use super::{Screen, put};
use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};
use ratatui::style::{Modifier, Style};
use ratatui::text::{Line, Span};

/// What stands before the line.
const SIGN: &str = "(texcrd) ";

/// What the line says while nobody types.
const HINT: &str = " n next  s step  b back  c continue  : command  Tab pane  ? help  q quit";

/// Draws the line; gives the place of the cursor if it is in it.
pub(super) fn draw(screen: &Screen<'_, '_>, buf: &mut Buffer, area: Rect) -> Option<Position> {
    let (model, theme) = (screen.model, screen.theme);
    if !model.typing {
        let dim = theme.style(&texcrd::debug::Style::Dim);
        put(buf, area, 0, Line::styled(HINT, dim));
        return None;
    }
    let text = model.prompt.text();
    let before = model.prompt.before_cursor().chars().count();
    // A long line is shown from where the cursor still is in sight.
    let room = usize::from(area.width).saturating_sub(SIGN.len() + 1);
    let first = before.saturating_sub(room);
    let visible: String = text.chars().skip(first).take(room + 1).collect();
    let mut spans = vec![Span::raw(SIGN)];
    let empty = text.is_empty();
    spans.push(Span::raw(visible));
    if empty {
        let dim = theme.style(&texcrd::debug::Style::Dim);
        spans.push(Span::styled(
            "  Enter repeats, Tab completes, Esc: back to the panes",
            dim,
        ));
    }
    put(buf, area, 0, Line::from(spans));
    candidates(screen, buf, area);
    let x = area.x + (SIGN.len() + before - first) as u16;
    Some(Position::new(x.min(area.right().saturating_sub(1)), area.y))
}

/// What the line can become, in the row above.
fn candidates(screen: &Screen<'_, '_>, buf: &mut Buffer, area: Rect) {
    let prompt = &screen.model.prompt;
    let found = prompt.candidates();
    if found.is_empty() || area.y == 0 {
        return;
    }
    let row = Rect {
        y: area.y - 1,
        ..area
    };
    let style = Style::default().add_modifier(Modifier::REVERSED);
    for x in row.left()..row.right() {
        buf[(x, row.y)].reset();
    }
    buf.set_style(row, style);
    let first = prompt.chosen().unwrap_or(0);
    let mut text = String::new();
    for (number, candidate) in found.iter().enumerate().skip(first) {
        // What completion changes is the last word.
        let word = candidate.split(' ').next_back().unwrap_or(candidate);
        let word = if prompt.chosen() == Some(number) {
            format!("[{word}]")
        } else {
            format!(" {word} ")
        };
        text += &word;
    }
    let text = super::clipped(&text, usize::from(row.width));
    buf.set_stringn(row.x, row.y, text, usize::from(row.width), style);
}

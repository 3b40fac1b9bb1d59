//! The help: every key, and what the marks mean.

use super::{clipped, put};
use crate::tui::keys::{PANES, PROMPT, entries};
use crate::tui::theme::Theme;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use texcrd::debug::Style;

/// What the marks mean.
const MARKS: [(&str, &str); 7] = [
    ("->", "the next instruction"),
    ("*", "what the last step did: the line, the components"),
    ("● ○", "a breakpoint, one that is off"),
    ("›", "the cursor line"),
    ("-", "a component that nothing has written"),
    ("┼ x", "the pixel in the frame, the texels in the texture"),
    (
        "t0in",
        "ps.1.0 to 1.3: the coordinates that t0 is sampled at",
    ),
];

/// What the mouse does.
const MOUSE: [(&str, &str); 3] = [
    ("click", "on a line: breakpoint; on the frame: pixel"),
    ("", "on a heading: that pane"),
    ("wheel", "scrolls; on a picture: enlarges"),
];

/// Columns of the keys.
const KEYS: usize = 26;

/// The lines of the help: a heading, or keys and what they do.
pub(in crate::tui) fn lines() -> Vec<(String, String)> {
    let mut lines = Vec::new();
    let mut section = |name: &str, rows: Vec<(String, &str)>| {
        if !lines.is_empty() {
            lines.push((String::new(), String::new()));
        }
        lines.push((name.to_string(), String::new()));
        lines.extend(
            rows.into_iter()
                .map(|(keys, says)| (keys, says.to_string())),
        );
    };
    let owned = |rows: &[(&str, &'static str)]| {
        let rows = rows.iter().map(|(key, says)| (key.to_string(), *says));
        rows.collect::<Vec<_>>()
    };
    section(
        "In the panes (a letter without a meaning begins a command)",
        entries(PANES),
    );
    section(
        "In the command line (`help` tells of the commands)",
        entries(PROMPT),
    );
    section("Marks", owned(&MARKS));
    section("Mouse", owned(&MOUSE));
    lines
}

pub(super) fn draw(buf: &mut Buffer, area: Rect, theme: Theme, first: usize) {
    let lines = lines();
    let rows = usize::from(area.height).saturating_sub(1);
    let first = first.min(lines.len().saturating_sub(rows));
    let more = lines.len() - first > rows;
    let hint = if more || first > 0 {
        " Help: arrows, PgUp, PgDn scroll; Esc closes"
    } else {
        " Help: Esc closes"
    };
    buf.set_style(Rect { height: 1, ..area }, theme.cursor());
    buf.set_stringn(
        area.x,
        area.y,
        hint,
        usize::from(area.width),
        theme.cursor(),
    );
    let body = Rect {
        y: area.y + 1,
        height: area.height.saturating_sub(1),
        ..area
    };
    for (row, (keys, says)) in lines.iter().skip(first).take(rows).enumerate() {
        let line = if says.is_empty() {
            Line::styled(keys.clone(), theme.style(&Style::Strong))
        } else {
            let width = usize::from(area.width).saturating_sub(KEYS + 3);
            Line::from(vec![
                Span::styled(format!("  {keys:<KEYS$} "), theme.style(&Style::Marked)),
                Span::raw(clipped(says, width)),
            ])
        };
        put(buf, body, row, line);
    }
}

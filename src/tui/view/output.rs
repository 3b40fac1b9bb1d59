//! What the commands said, the latest at the bottom.

use super::{Screen, line, put};
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

/// Breaks a text into lines of at most `width` characters, between words where it can.
pub(super) fn words(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    let mut current = String::new();
    for word in text.split(' ') {
        let (have, need) = (current.chars().count(), word.chars().count());
        if have > 0 && have + 1 + need > width {
            lines.push(std::mem::take(&mut current));
        } else if have > 0 {
            current.push(' ');
        }
        for c in word.chars() {
            if current.chars().count() >= width.max(1) {
                lines.push(std::mem::take(&mut current));
            }
            current.push(c);
        }
    }
    lines.push(current);
    lines
}

/// Breaks a line into rows of at most `width` characters; what goes on is set in by two.
fn rows<'t>(line: Line<'t>, width: usize) -> Vec<Line<'t>> {
    if line.width() <= width {
        return vec![line];
    }
    let mut rows = Vec::new();
    let mut row: Vec<Span<'t>> = Vec::new();
    let mut used = 0;
    for span in line.spans {
        let mut text = String::new();
        for c in span.content.chars() {
            if used >= width.max(3) {
                row.push(Span::styled(std::mem::take(&mut text), span.style));
                rows.push(Line::from(std::mem::take(&mut row)));
                row.push(Span::raw("  "));
                used = 2;
            }
            text.push(c);
            used += 1;
        }
        row.push(Span::styled(text, span.style));
    }
    rows.push(Line::from(row));
    rows
}

/// How many rows the output takes.
pub(in crate::tui) fn wrapped(output: &[texcrd::debug::Line], width: u16) -> usize {
    let length = |line: &texcrd::debug::Line| -> usize {
        line.pieces.iter().map(|p| p.text.chars().count()).sum()
    };
    let width = usize::from(width).max(3);
    // As `rows` breaks them: the first row has all columns, the others two less.
    let rows = |length: usize| 1 + length.saturating_sub(width).div_ceil(width - 2);
    output.iter().map(|line| rows(length(line))).sum()
}

pub(super) fn draw(screen: &Screen<'_, '_>, buf: &mut Buffer, area: Rect) -> String {
    let (height, width) = (usize::from(area.height), usize::from(area.width));
    let below = screen.model.output_below;
    // From the end, as far as there is room: the output may be long.
    let mut shown: Vec<Line<'_>> = Vec::new();
    for text in screen.model.output.iter().rev() {
        if shown.len() >= height + below {
            break;
        }
        shown.extend(rows(line(text, screen.theme), width).into_iter().rev());
    }
    let skipped = below.min(shown.len().saturating_sub(height));
    let visible = shown.into_iter().skip(skipped).take(height);
    let mut visible: Vec<Line<'_>> = visible.collect();
    visible.reverse();
    for (row, line) in visible.into_iter().enumerate() {
        put(buf, area, row, line);
    }
    if skipped > 0 {
        format!("{skipped} more ↓")
    } else {
        String::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use texcrd::debug::{Piece, Style};

    #[test]
    fn words_stay_whole_where_they_fit() {
        assert_eq!(words("make it larger", 7), ["make it", "larger"]);
        assert_eq!(words("largest", 4), ["larg", "est"]);
        assert_eq!(words("", 4), [""]);
        assert!(words("a b", 0).len() >= 2);
    }

    #[test]
    fn rows_are_counted_as_they_are_broken() {
        for length in 0..60 {
            let text = texcrd::debug::Line {
                pieces: vec![Piece {
                    text: "x".repeat(length),
                    style: Style::Plain,
                }],
            };
            let line = Line::from("x".repeat(length));
            assert_eq!(wrapped(&[text], 10), rows(line, 10).len(), "{length}");
        }
    }
}

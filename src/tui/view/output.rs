//! What the commands said, the latest at the bottom.

use super::{Screen, line, put};
use crate::tui::theme::Theme;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::text::{Line, Span};
use std::ops::Range;

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

/// What goes on in a further row is set in by so many columns.
const INDENT: usize = 2;

/// Where a line of these characters breaks into rows of at most `width`: between words where there is one to break behind.
fn breaks(text: &[char], width: usize) -> Vec<Range<usize>> {
    let width = width.max(INDENT + 1);
    let mut rows = Vec::new();
    let mut start = 0;
    let mut room = width;
    while text.len() - start > room {
        let row = &text[start..=start + room];
        let blank = row.iter().rposition(|c| *c == ' ');
        // Blanks at the beginning are no place to break at.
        let blank = blank.filter(|at| row[..*at].iter().any(|c| *c != ' '));
        let end = start + blank.unwrap_or(room);
        rows.push(start..end);
        start = end + text[end..].iter().take_while(|c| **c == ' ').count();
        room = width - INDENT;
    }
    rows.push(start..text.len());
    rows
}

/// Breaks a line into rows.
fn rows(line: &Line<'_>, width: usize) -> Vec<Line<'static>> {
    let styled = |span: &Span<'_>| {
        let style = span.style;
        let characters: Vec<(char, Style)> = span.content.chars().map(|c| (c, style)).collect();
        characters
    };
    let all: Vec<(char, Style)> = line.spans.iter().flat_map(styled).collect();
    let text: Vec<char> = all.iter().map(|(c, _)| *c).collect();
    let row = |(number, range): (usize, Range<usize>)| {
        let runs = all[range].chunk_by(|a, b| a.1 == b.1);
        let spans = runs.map(|run| {
            let text: String = run.iter().map(|(c, _)| c).collect();
            Span::styled(text, run[0].1)
        });
        let indent = (number > 0).then(|| Span::raw(" ".repeat(INDENT)));
        indent.into_iter().chain(spans).collect()
    };
    breaks(&text, width)
        .into_iter()
        .enumerate()
        .map(row)
        .collect()
}

/// How many rows the output takes.
pub(in crate::tui) fn wrapped(output: &[texcrd::debug::Line], width: u16, theme: Theme) -> usize {
    let width = usize::from(width);
    output
        .iter()
        .map(|text| rows(&line(text, theme), width).len())
        .sum()
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
        shown.extend(rows(&line(text, screen.theme), width).into_iter().rev());
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

    #[test]
    fn words_stay_whole_where_they_fit() {
        assert_eq!(words("make it larger", 7), ["make it", "larger"]);
        assert_eq!(words("largest", 4), ["larg", "est"]);
        assert_eq!(words("", 4), [""]);
        assert!(words("a b", 0).len() >= 2);
    }

    #[test]
    fn lines_break_between_words() {
        let broken = |text: &str| -> Vec<String> {
            let rows = rows(&Line::from(text.to_string()), 10).into_iter();
            rows.map(|row| row.to_string()).collect()
        };
        assert_eq!(broken("0123456789"), ["0123456789"]);
        assert_eq!(broken("r0 = 0.25, 0.5"), ["r0 = 0.25,", "  0.5"]);
        assert_eq!(broken("   0123456789"), ["   0123456", "  789"]);
        assert_eq!(broken("one two three"), ["one two", "  three"]);
        assert_eq!(broken(""), [""]);
    }

    #[test]
    fn styles_survive_a_break() {
        let bold = Style::default().bold();
        let line = Line::from(vec![Span::raw("r0 = "), Span::styled("0.25, 0.5", bold)]);
        let rows = rows(&line, 10);
        assert_eq!(rows[0].spans[1], Span::styled("0.25,", bold));
        assert_eq!(rows[1].spans[1], Span::styled("0.5", bold));
    }
}

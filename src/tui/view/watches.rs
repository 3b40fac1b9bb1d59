//! The watches: expressions, and what they are here.

use super::registers::colour;
use super::{Screen, put};
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use texcrd::debug::{Format, Style};

pub(super) fn draw(screen: &Screen<'_, '_>, buf: &mut Buffer, area: Rect) -> String {
    let (theme, displays) = (screen.theme, screen.console.displays());
    if displays.is_empty() {
        let lines = [
            "No watches. `:display r0.rgb` adds one,",
            "shown here at every step.",
        ];
        for (row, line) in lines.into_iter().enumerate() {
            put(buf, area, row, Line::from(line));
        }
    }
    let height = usize::from(area.height);
    let first = screen
        .model
        .watches
        .min(displays.len().saturating_sub(height));
    let scope = screen.session.scope();
    for (row, display) in displays.iter().skip(first).take(height).enumerate() {
        let mut spans = vec![
            Span::styled(format!("{}: ", display.id), theme.style(&Style::Dim)),
            Span::styled(
                format!("{} ", display.expression),
                theme.style(&Style::Strong),
            ),
        ];
        let value = scope
            .as_ref()
            .map(|scope| display.expression.evaluate(scope));
        match value {
            Some(Ok(value)) => {
                spans.push(Span::raw(format!("= {}", value.text(display.format))));
                if display.format == Format::Colour {
                    let swatch = Style::Swatch(colour(value.numbers));
                    spans.push(Span::raw(" "));
                    spans.push(Span::styled("  ", theme.style(&swatch)));
                }
            }
            Some(Err(error)) => {
                spans.push(Span::styled(error.message, theme.style(&Style::Error)));
            }
            None => {}
        }
        put(buf, area, row, Line::from(spans));
    }
    String::new()
}

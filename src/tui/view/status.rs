//! The line above all: what is debugged, and where one is in it.

use super::{Screen, clean, clipped};
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};
use texcrd::debug::RunKind;

pub(super) fn draw(screen: &Screen<'_, '_>, buf: &mut Buffer, area: Rect) {
    let style = Style::default().add_modifier(Modifier::REVERSED);
    buf.set_style(area, style);
    let session = screen.session;
    let Some(run) = session.run() else {
        buf.set_string(area.x, area.y, " nothing to debug", style);
        return;
    };
    let what = match run.kind {
        RunKind::Listing => "values set by hand".to_string(),
        RunKind::Vertex {
            corner: Some(corner),
            vertex,
        } => format!("corner {corner}: vertex {vertex}"),
        RunKind::Vertex { vertex, .. } => format!("vertex {vertex}"),
        RunKind::Pixel { pixel: [x, y] } => format!("pixel {x}, {y}"),
    };
    let place = session.position();
    let right = format!("{} of {}  ? help ", place.at, run.moments.len());
    let file = run.listing.sources.file_of(run.listing.program.span.start);
    let file = file.map_or(String::new(), |file| clean(file.name()));
    // Its folders take room that the rest needs.
    let file = file.rsplit(['/', '\\']).next().unwrap_or_default();
    let runs = session.runs().len();
    let which = if runs > 1 {
        format!("  run {} of {runs}", place.run + 1)
    } else {
        String::new()
    };
    let edited = if session.edits().is_empty() {
        ""
    } else {
        "  values set"
    };
    let left = format!(
        " {file}  {}  {what}{which}{edited}",
        run.listing.program.version
    );
    let room = usize::from(area.width).saturating_sub(right.chars().count() + 1);
    buf.set_stringn(area.x, area.y, clipped(&left, room), room, style);
    let x = area.right().saturating_sub(right.chars().count() as u16);
    buf.set_stringn(x, area.y, right, usize::from(area.width), style);
}

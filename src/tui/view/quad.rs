//! The four pixels that run together: a register in each, and its differences, which choose the mip level.

use super::registers::{register, slot_name};
use super::{Screen, put};
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use texcrd::debug::{RunKind, Session, Style, Target};
use texcrd::isa::{ShaderKind, WriteMask};
use texcrd::kernel::Slot;

/// The register that changed last, or else the result.
fn target(session: &Session<'_>) -> Option<Target> {
    let run = session.run()?;
    let done = run.moments.iter().take(session.position().at);
    let changed = done.rev().find_map(|moment| moment.change);
    let result = match run.listing.kind() {
        ShaderKind::Pixel => Slot::R0,
        ShaderKind::Vertex => Slot::POSITION,
    };
    Some(changed.map_or(Target::Slot(result), |change| change.target))
}

pub(super) fn draw(screen: &Screen<'_, '_>, buf: &mut Buffer, area: Rect) -> String {
    let session = screen.session;
    let (Some(run), Some(target)) = (session.run(), target(session)) else {
        return String::new();
    };
    let theme = screen.theme;
    let name = match target {
        Target::Slot(slot) => slot_name(slot, run.listing.program.version),
        Target::Constant(index) => format!("c{index}"),
    };
    if !matches!(run.kind, RunKind::Pixel { .. }) {
        let lines = [
            "Only the pixels of a scene run in quads;",
            "this invocation runs alone.",
        ];
        for (row, line) in lines.into_iter().enumerate() {
            put(buf, area, row, Line::from(line));
        }
        return name;
    }
    let RunKind::Pixel { pixel: [x, y] } = run.kind else {
        return name;
    };
    let lane = run.lane & 3;
    let values = session.registers().target(target);
    let written = match target {
        Target::Slot(slot) => session.registers().written(slot),
        Target::Constant(_) => WriteMask::ALL,
    };
    // The first pixel of the quad is that of even coordinates.
    let (left, top) = (x & !1, y & !1);
    put(
        buf,
        area,
        0,
        Line::from(vec![
            Span::styled(name.clone(), theme.style(&Style::Strong)),
            Span::raw(format!("  from {left}, {top}  (> the pixel, h helper)")),
        ]),
    );
    for (other, value) in values.into_iter().enumerate() {
        let mark = if other == lane { '>' } else { ' ' };
        let helper = if run.helpers[other] { 'h' } else { ' ' };
        let label = format!("{mark}{},{}{helper}", other & 1, other >> 1);
        let shown = register(&label, value, [written, WriteMask::NONE], screen);
        put(buf, area, other + 1, shown);
    }
    // In the row and in the column of the pixel itself, as its level of detail is found.
    let difference = |a: usize, b: usize| std::array::from_fn(|c| values[b][c] - values[a][c]);
    let (row, column) = (lane & 2, lane & 1);
    for (line, (label, value)) in [
        ("d/dx", difference(row, row + 1)),
        ("d/dy", difference(column, column + 2)),
    ]
    .into_iter()
    .enumerate()
    {
        let mut spans = vec![Span::raw(format!("{label:<5}"))];
        spans.extend(super::registers::numbers(
            value,
            written,
            WriteMask::NONE,
            screen,
        ));
        put(buf, area, line + 5, Line::from(spans));
    }
    name
}

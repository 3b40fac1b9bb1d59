//! The registers: inputs, temporaries, outputs and the constants in use, what the last step changed, and their colours.

use super::{Screen, put};
use crate::tui::number::{WIDTH, short};
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use std::collections::BTreeSet;
use texcrd::debug::{Event, Flags, Moment, Session, Style, Target};
use texcrd::isa::{ShaderKind, Version, WriteMask};
use texcrd::kernel::Slot;

/// A register.
pub(in crate::tui) struct Row {
    name: String,
    value: [f32; 4],
    /// The components that hold something.
    written: WriteMask,
    /// The components that the last step has written.
    pub changed: WriteMask,
}

/// The moments of the last step that have happened: all rows of a macro, both halves of a pair.
fn last_step<'s>(session: &'s Session<'_>) -> &'s [Moment] {
    let Some(run) = session.run() else {
        return &[];
    };
    let at = session.position().at;
    let Some(last) = at.checked_sub(1) else {
        return &[];
    };
    let instruction = run.moments.get(last).and_then(|moment| moment.instruction);
    let group = if instruction.is_some() {
        run.group(last).start..at
    } else {
        last..at
    };
    run.moments.get(group).unwrap_or(&[])
}

/// What a person calls a slot. Coordinates of `ps.1.0` to `ps.1.3` have the name of what is sampled with them.
pub(super) fn slot_name(slot: Slot, version: Version) -> String {
    let name = slot.name(version.kind());
    if slot.texcoord_index().is_some() && version != Version::Ps14 {
        format!("{name}in")
    } else {
        name
    }
}

/// The registers that the shader uses, in the order in which they are shown.
pub(in crate::tui) fn rows(session: &Session<'_>) -> Vec<Row> {
    let Some(run) = session.run() else {
        return Vec::new();
    };
    let (registers, kernel) = (session.registers(), run.listing.kernel);
    let steps = last_step(session);
    let changed = |target: Target| {
        let changes = steps.iter().filter_map(|moment| moment.change);
        let masks = changes.filter(|c| c.target == target).map(|c| c.mask);
        masks.fold(WriteMask::NONE, WriteMask::or)
    };
    let used = |slot: &Slot| {
        let result = run.listing.kind() == ShaderKind::Pixel && *slot == Slot::R0;
        let touched = !(kernel.read(*slot).is_empty() && kernel.written(*slot).is_empty());
        (touched || result) && (!slot.is_internal() || *slot == Slot::DEPTH)
    };
    let slots = Slot::all().filter(used).map(|slot| Row {
        name: slot_name(slot, run.listing.program.version),
        value: registers.slot(slot, run.lane),
        written: registers.written(slot),
        changed: changed(Target::Slot(slot)),
    });
    // What a relative operand has found so far is in use, too, and so is what was set by hand.
    let done = run.moments.iter().take(session.position().at);
    let relative = done.clone().flat_map(|moment| match &moment.event {
        Event::Step { reads, .. } => reads.as_slice(),
        _ => &[],
    });
    let relative = relative.filter_map(|read| read.relative[run.lane & 3]);
    let set = done.filter_map(|moment| match moment.change?.target {
        Target::Constant(index) => Some(index),
        Target::Slot(_) => None,
    });
    let constants: BTreeSet<u32> = kernel.constants().chain(relative).chain(set).collect();
    let constants = constants.into_iter().map(|index| Row {
        name: format!("c{index}"),
        value: registers.constant(index),
        written: WriteMask::ALL,
        changed: changed(Target::Constant(index)),
    });
    slots.chain(constants).collect()
}

/// Columns of a name.
const NAME: usize = 5;

/// The numbers of a register, with `*` before those that are `changed` and `-` for those that are not `written`.
pub(super) fn numbers(
    value: [f32; 4],
    written: WriteMask,
    changed: WriteMask,
    screen: &Screen<'_, '_>,
) -> Vec<Span<'static>> {
    let number = |c: usize| {
        let new = changed.has(c);
        let text = if written.has(c) {
            short(value[c])
        } else {
            "-".to_string()
        };
        let meaning = if written.has(c) && !value[c].is_finite() {
            Style::Remarkable
        } else if new {
            Style::Changed
        } else if !written.has(c) {
            Style::Dim
        } else {
            Style::Plain
        };
        let mark = if new { '*' } else { ' ' };
        // The mark stands at the number, not at the edge of its column.
        let text = format!("{:>width$}", format!("{mark}{text}"), width = WIDTH + 1);
        Span::styled(text, screen.theme.style(&meaning))
    };
    (0..4).map(number).collect()
}

/// The colour of a value, for a swatch.
pub(super) fn colour(value: [f32; 4]) -> [u8; 3] {
    // A cast of NaN gives 0.
    std::array::from_fn(|c| (value[c].clamp(0.0, 1.0) * 255.0 + 0.5) as u8)
}

/// A line with a name, four numbers and a swatch.
pub(super) fn register(
    name: &str,
    value: [f32; 4],
    [written, changed]: [WriteMask; 2],
    screen: &Screen<'_, '_>,
) -> Line<'static> {
    let theme = screen.theme;
    let meaning = if changed.is_empty() {
        Style::Plain
    } else {
        Style::Changed
    };
    let mut spans = vec![Span::styled(
        format!("{name:<NAME$}"),
        theme.style(&meaning),
    )];
    spans.extend(numbers(value, written, changed, screen));
    if theme.colour([0; 3]).is_some() && !written.is_empty() {
        spans.push(Span::styled(
            "  ",
            theme.style(&Style::Swatch(colour(value))),
        ));
    }
    Line::from(spans)
}

/// Draws the pane; gives what is remarkable about the last step for its heading.
pub(super) fn draw(screen: &Screen<'_, '_>, buf: &mut Buffer, area: Rect) -> String {
    let rows = rows(screen.session);
    let height = usize::from(area.height);
    let most = rows.len().saturating_sub(height);
    let first = screen.model.registers.unwrap_or_else(|| {
        let new = rows.iter().rposition(|row| !row.changed.is_empty());
        new.map_or(0, |new| (new + 1).saturating_sub(height))
    });
    let first = first.min(most);
    for (line, row) in rows.iter().skip(first).take(height).enumerate() {
        let shown = register(&row.name, row.value, [row.written, row.changed], screen);
        put(buf, area, line, shown);
    }
    let more = match rows.len() - first.min(rows.len()) > height {
        true => "  more ↓",
        false if first > 0 => "  more ↑",
        false => "",
    };
    format!("{}{more}", remarks(screen.session))
}

/// What is remarkable about the last step for the pixel that is looked at.
fn remarks(session: &Session<'_>) -> String {
    let Some(run) = session.run() else {
        return String::new();
    };
    let lane = run.lane & 3;
    let all = (last_step(session).iter()).fold(Flags::default(), |all, m| all.or(m.flags[lane]));
    let letters = run.listing.program.letters();
    let masks = [
        (all.nan, "NaN"),
        (all.infinite, "inf"),
        (all.saturated, "sat"),
        (all.clamped, "clamp"),
    ];
    let masks = masks.into_iter().filter(|(mask, _)| !mask.is_empty());
    let components =
        |mask: WriteMask| -> String { mask.components().map(|c| letters[c]).collect() };
    let mut words: Vec<String> = masks
        .map(|(mask, name)| format!("{name} {}", components(mask)))
        .collect();
    let plain = [
        (all.out_of_range, "range"),
        (all.uninitialised, "uninit"),
        (session.registers().killed()[lane], "killed"),
    ];
    words.extend(
        plain
            .iter()
            .filter(|(is, _)| *is)
            .map(|(_, name)| name.to_string()),
    );
    words.join(", ")
}

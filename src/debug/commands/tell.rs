//! Moments in words.

use super::{merge, sample};
use crate::debug::expression::{Format, Value, number_text};
use crate::debug::moment::{Event, InputSource, Moment, Quad, Read, Target};
use crate::debug::run::{Registers, Run, RunKind};
use crate::debug::session::Direction;
use crate::debug::text::{Line, Style, Text};
use crate::isa::{ShaderKind, Swizzle, WriteMask};
use crate::kernel::{Place, Slot};
use crate::program::letters;
use std::ops::Range;

/// How wide names of registers are.
const NAME_WIDTH: usize = 12;
/// What stands before what a moment did.
const INDENT: &str = "        ";

/// Which run it is: `pixel 665,136`, `vertex 17 (corner 2)`.
pub(super) fn run_name(run: &Run<'_>) -> String {
    match run.kind {
        RunKind::Listing => "listing".to_string(),
        RunKind::Vertex {
            corner: None,
            vertex,
        } => format!("vertex {vertex}"),
        RunKind::Vertex {
            corner: Some(corner),
            vertex,
        } => format!("vertex {vertex} (corner {})", corner + 1),
        RunKind::Pixel { pixel: [x, y] } => format!("pixel {x},{y}"),
    }
}

/// The heading of a run.
pub(super) fn run_title(run: &Run<'_>) -> Line {
    let file = super::place::file_name(&run.listing).unwrap_or("");
    let version = run.listing.program.version;
    Line::styled(run_name(run), Style::Strong).plain(format!(": {version}, {file}"))
}

/// The name of what is written.
pub(super) fn target_name(target: Target, kind: ShaderKind) -> String {
    match target {
        Target::Slot(slot) => slot.name(kind),
        Target::Constant(index) => format!("c{index}"),
    }
}

/// `.rg`, in the letters of the kind; nothing for all of a register, and for the depth, which is one number.
pub(super) fn mask_text(target: Target, mask: WriteMask, kind: ShaderKind) -> String {
    match target {
        Target::Slot(Slot::DEPTH) => String::new(),
        _ => mask.text(letters(kind)),
    }
}

/// The components of a mask.
pub(super) fn numbers(value: [f32; 4], mask: WriteMask) -> String {
    let texts: Vec<String> = mask.components().map(|c| number_text(value[c])).collect();
    texts.join(", ")
}

/// The components of a register, a dash for those that nothing has written.
pub(super) fn register_text(value: [f32; 4], written: WriteMask) -> String {
    let texts = value.iter().enumerate().map(|(c, x)| match written.has(c) {
        true => number_text(*x),
        false => "-".to_string(),
    });
    texts.collect::<Vec<_>>().join(", ")
}

/// A name and what stands behind it.
pub(super) fn named(name: &str) -> Line {
    Line::styled(format!("{INDENT}{name:<NAME_WIDTH$} = "), Style::Plain)
}

/// A remark below an instruction.
pub(super) fn remark(text: impl Into<String>, style: Style) -> Line {
    Line::from(INDENT).and(text, style)
}

/// The line of an instruction, with what stands before it.
pub(super) fn instruction(run: &Run<'_>, number: usize, mark: &str, style: Style) -> Line {
    let line = run.listing.line(number);
    Line::styled(format!("{mark:<3}{line:>4} "), style).and(run.listing.text(number), style)
}

/// What happened in some moments of a run, in the order in which one went through them.
pub(super) fn moments(run: &Run<'_>, range: Range<usize>, direction: Direction) -> Text {
    /// More instructions than this at once are too many to read.
    const MOST: usize = 24;
    let mut groups: Vec<Range<usize>> = Vec::new();
    let mut at = range.start;
    while at < range.end {
        let group = run.group(at);
        // Inputs are told one by one.
        let end = match run.moments.get(at).map(|moment| moment.instruction) {
            Some(Some(_)) => group.end.clamp(at + 1, range.end),
            _ => at + 1,
        };
        groups.push(at..end);
        at = end;
    }
    if direction == Direction::Backward {
        groups.reverse();
    }
    let mut text = Text::default();
    let left_out = groups.len().saturating_sub(MOST);
    if left_out > 0 {
        text.line(remark(format!("({left_out} more before)"), Style::Dim));
    }
    for group in groups.into_iter().skip(left_out) {
        text.append(group_of_moments(run, group, direction));
    }
    text
}

/// Moments of one instruction.
fn group_of_moments(run: &Run<'_>, group: Range<usize>, direction: Direction) -> Text {
    let mut text = Text::default();
    let moments = run.moments.get(group.clone()).unwrap_or(&[]);
    let Some(first) = moments.first() else {
        return text;
    };
    let heading = heading(run, first);
    text.line(match direction {
        Direction::Forward => heading,
        Direction::Backward => heading.and("   undone", Style::Dim),
    });
    for change in changes(moments) {
        text.line(change_line(run, &change, first, direction));
    }
    if direction == Direction::Forward {
        for number in group {
            text.append(details(run, number, Detail::Full));
        }
    }
    text
}

/// What a moment is.
pub(super) fn heading(run: &Run<'_>, moment: &Moment) -> Line {
    match moment.instruction {
        Some(number) => instruction(run, number, "", Style::Plain),
        None => Line::from(format!("   {}", around(moment))),
    }
}

/// What a moment that belongs to no instruction is called.
pub(super) fn around(moment: &Moment) -> String {
    match &moment.event {
        Event::Input(_) => "input".to_string(),
        Event::Set => "set by hand".to_string(),
        Event::Taken => "taken into 0…1 by the rasterizer".to_string(),
        Event::Merge(stage) => format!("output merger: {}", merge::name(stage)),
        Event::Step { .. } | Event::Nothing => String::new(),
    }
}

/// The changes of some moments to one register, taken together.
struct Joined {
    target: Target,
    mask: WriteMask,
    before: Quad,
    after: Quad,
    first: WriteMask,
}

fn changes(moments: &[Moment]) -> Vec<Joined> {
    let mut joined: Vec<Joined> = Vec::new();
    for change in moments.iter().filter_map(|moment| moment.change) {
        match joined.iter_mut().find(|j| j.target == change.target) {
            Some(known) => {
                known.mask = known.mask.or(change.mask);
                known.after = change.after;
                known.first = known.first.or(change.first);
            }
            None => joined.push(Joined {
                target: change.target,
                mask: change.mask,
                before: change.before,
                after: change.after,
                first: change.first,
            }),
        }
    }
    joined
}

fn change_line(run: &Run<'_>, change: &Joined, moment: &Moment, direction: Direction) -> Line {
    let kind = run.listing.kind();
    let name = target_name(change.target, kind) + &mask_text(change.target, change.mask, kind);
    let (mut old, mut new) = (change.before[run.lane & 3], change.after[run.lane & 3]);
    if direction == Direction::Backward {
        (old, new) = (new, old);
    }
    let line = named(&name).and(numbers(new, change.mask), Style::Changed);
    let with_swatch = |line| swatch(line, kind, change.mask, new);
    if let (Event::Input(source), Direction::Forward) = (&moment.event, direction) {
        let source = source_text(*source, run.lane, change.mask);
        return with_swatch(line.and(source, Style::Dim));
    }
    let same = |c: usize| old[c].to_bits() == new[c].to_bits();
    let was = if change.first == change.mask && direction == Direction::Forward {
        "   (first write)".to_string()
    } else if change.mask.components().all(same) {
        "   (as before)".to_string()
    } else {
        format!("   (was {})", numbers(old, change.mask))
    };
    with_swatch(line.and(was, Style::Dim))
}

/// A field of the colour at the end of a line, where a pixel shader writes one.
pub(super) fn swatch(line: Line, kind: ShaderKind, mask: WriteMask, value: [f32; 4]) -> Line {
    if kind == ShaderKind::Pixel && mask.contains(WriteMask::XYZ) {
        return line.plain(" ").swatch(Value::vector(value).colour());
    }
    line
}

/// Where some components of an input come from.
pub(super) fn source_text(source: InputSource, lane: usize, mask: WriteMask) -> String {
    match source {
        InputSource::Given => "   given".to_string(),
        InputSource::Fetched => "   of the vertex".to_string(),
        InputSource::Output => "   of the vertex shader".to_string(),
        InputSource::Interpolated { corners, shares } => {
            let [b, c] = shares[lane & 3];
            let corners = corners.map(|corner| numbers(corner, mask));
            if corners[0] == corners[1] && corners[0] == corners[2] {
                return "   the same at all vertices".to_string();
            }
            format!(
                "   interpolated: {} × ({}), {} × ({}), {} × ({})",
                number_text(1.0 - b - c),
                corners[0],
                number_text(b),
                corners[1],
                number_text(c),
                corners[2]
            )
        }
        InputSource::Sprite => "   of the point sprite".to_string(),
    }
}

/// How much is told of a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Detail {
    /// Its texels, too.
    Full,
    /// Where it was taken.
    Short,
}

/// What is remarkable about a moment, and what it sampled.
pub(super) fn details(run: &Run<'_>, number: usize, detail: Detail) -> Text {
    let mut text = Text::default();
    let Some(moment) = run.moments.get(number) else {
        return text;
    };
    if let Event::Step {
        sample: Some(sample),
        ..
    } = &moment.event
    {
        text.append(sample::lines(run, sample, detail));
    }
    if let Event::Merge(stage) = &moment.event {
        text.append(merge::lines(stage));
    }
    for words in remarks(run, moment) {
        text.line(remark(words, Style::Remarkable));
    }
    text
}

/// The flags of a moment in words.
pub(super) fn remarks(run: &Run<'_>, moment: &Moment) -> Vec<String> {
    let kind = run.listing.kind();
    let flags = moment.flags[run.lane & 3];
    let mut words = Vec::new();
    if let Some(change) = &moment.change {
        let name = target_name(change.target, kind);
        let rows = [
            (flags.nan, "became NaN"),
            (flags.infinite, "became infinite"),
            (flags.saturated, "was saturated to 0…1"),
            (flags.clamped, "was clamped"),
        ];
        for (mask, what) in rows.iter().filter(|(mask, _)| !mask.is_empty()) {
            let components = mask_text(change.target, *mask, kind);
            words.push(format!("{name}{components} {what}"));
        }
    }
    if let Event::Step { reads, killed, .. } = &moment.event {
        for read in reads {
            words.extend(read_remark(run, read));
        }
        if let Some((before, after)) = killed
            && after[run.lane & 3]
            && !before[run.lane & 3]
        {
            words.push("the pixel is discarded".to_string());
        }
    }
    for (slot, mask) in &moment.lost {
        let components = mask_text(Target::Slot(*slot), *mask, kind);
        words.push(format!(
            "{}{components} is lost at `phase`",
            slot.name(kind)
        ));
    }
    words
}

fn read_remark(run: &Run<'_>, read: &Read) -> Option<String> {
    let kind = run.listing.kind();
    match read.operand.place {
        Place::Relative(_) if read.relative[run.lane & 3].is_none() => Some(format!(
            "{} is out of range: it reads 0, 0, 0, 0",
            place_name(read, run)
        )),
        Place::Slot(slot) if !read.uninitialised.is_empty() => {
            let target = Target::Slot(slot);
            let components = mask_text(target, read.uninitialised, kind);
            Some(format!(
                "{}{components} is read, and nothing has written it",
                slot.name(kind)
            ))
        }
        _ => None,
    }
}

/// The register of an operand.
pub(super) fn place_name(read: &Read, run: &Run<'_>) -> String {
    match read.operand.place {
        Place::Slot(slot) => slot.name(run.listing.kind()),
        Place::Constant(index) => format!("c{index}"),
        Place::Relative(offset) => format!("c[a0.x + {offset}]"),
        Place::Literal(number) => number_text(number),
    }
}

/// An operand and its value, in the slots that matter: `c0.r = 0.9`. Nothing for a number that the program did not write.
pub(super) fn read_text(run: &Run<'_>, read: &Read, slots: WriteMask) -> Option<String> {
    if matches!(read.operand.place, Place::Literal(_)) {
        return None;
    }
    let (components, shown) = read_components(run, read, slots)?;
    let row = read.operand.modifier.row();
    let values = read.values[run.lane & 3];
    Some(format!(
        "{}{}{}{components}{} = {}",
        row.prefix,
        place_name(read, run),
        row.suffix,
        relative_text(run, read),
        numbers(values, shown)
    ))
}

/// The letters behind an operand, and the slots whose numbers are shown: one of those that all read the same component. Nothing
/// if the step uses none.
pub(super) fn read_components(
    run: &Run<'_>,
    read: &Read,
    slots: WriteMask,
) -> Option<(String, WriteMask)> {
    let slots = slots.and(read.slots);
    if slots.is_empty() {
        return None;
    }
    let all_one = |slots: WriteMask| {
        let mut components = slots
            .components()
            .map(|slot| read.operand.swizzle.slot(slot));
        let first = components.next();
        components.all(|c| Some(c) == first)
    };
    let shown = if all_one(slots) {
        slots
            .components()
            .next()
            .map_or(slots, WriteMask::component)
    } else {
        slots
    };
    let letters = letters(run.listing.kind());
    let components = if shown == WriteMask::ALL && read.operand.swizzle == Swizzle::IDENTITY {
        String::new()
    } else {
        let named = shown
            .components()
            .map(|slot| letters[read.operand.swizzle.slot(slot)]);
        std::iter::once('.').chain(named).collect()
    };
    Some((components, shown))
}

/// Which constant a relative operand names, ` (c12)`; nothing for others.
pub(super) fn relative_text(run: &Run<'_>, read: &Read) -> String {
    match (read.operand.place, read.relative[run.lane & 3]) {
        (Place::Relative(_), Some(index)) => format!(" (c{index})"),
        _ => String::new(),
    }
}

/// What comes out of a run, as it stands in some registers: the outputs that the shader writes.
pub(super) fn results(run: &Run<'_>, registers: &Registers) -> Text {
    let kind = run.listing.kind();
    let mut text = Text::default();
    for slot in outputs(run) {
        let value = registers.slot(slot, run.lane);
        let target = Target::Slot(slot);
        let mask = match slot {
            Slot::R0 => WriteMask::ALL,
            _ => run.listing.kernel.written(slot),
        };
        let name = target_name(target, kind) + &mask_text(target, mask, kind);
        text.line(swatch(
            named(&name).plain(numbers(value, mask)),
            kind,
            mask,
            value,
        ));
    }
    if registers.killed()[run.lane & 3] {
        text.line(remark("the pixel is discarded", Style::Remarkable));
    }
    text
}

/// What a run leaves behind: of a pixel shader `r0` and the depth, of a vertex shader its outputs.
pub(super) fn outputs(run: &Run<'_>) -> Vec<Slot> {
    let kernel = run.listing.kernel;
    let result = (run.listing.kind() == ShaderKind::Pixel).then_some(Slot::R0);
    let written = Slot::all().filter(|slot| slot.is_output() && !kernel.written(*slot).is_empty());
    result.into_iter().chain(written).collect()
}

/// A value in a format, what is to be noted about it, and a field of its colour where that is asked for.
pub(super) fn value_line(name: &str, value: &Value, format: Format, note: &str) -> Line {
    let line = Line::from(format!("{name} = ")).plain(value.text(format));
    let line = line.and(note, Style::Dim);
    match format {
        Format::Colour => line.plain(" ").swatch(value.colour()),
        _ => line,
    }
}

//! `set`, `unset`, `diff`: other values, and what comes of them.

use super::{Arguments, Console, Fault, Outcome, explain, tell, travel};
use crate::debug::expression::{Expression, Scope, Value};
use crate::debug::moment::{Event, MergeStage, Moment, Quad, Target};
use crate::debug::run::{Registers, Run};
use crate::debug::session::Session;
use crate::debug::text::{Line, Style, Text};
use crate::isa::{ShaderKind, WriteMask};
use crate::semantics;

/// More values set by hand than this are refused.
const MOST_EDITS: usize = 1000;

/// `set r0.rgb = EXPR`, for every pixel of the quad.
pub(super) fn set(
    console: &mut Console,
    session: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    // `set var` is gdb's longer form.
    let text = arguments
        .text
        .strip_prefix("var ")
        .unwrap_or(arguments.text);
    let (register, value) = text
        .split_once('=')
        .ok_or("write it as set r0.rgb = 1, 0.5, 0")?;
    if session.edits().len() >= MOST_EDITS {
        return Err(format!("{MOST_EDITS} values are set already; `unset` forgets them").into());
    }
    let (target, mask) = explain::register(session, register.trim())?;
    let expression: Expression = value.parse()?;
    let scope = session.scope().ok_or("there is no run")?;
    let mut quad: Quad = [[0.0; 4]; 4];
    for (lane, pixel) in quad.iter_mut().enumerate() {
        let value = expression.evaluate(&Scope { lane, ..scope })?;
        *pixel = spread(&value, mask)?;
    }
    if let Target::Constant(_) = target {
        // A constant is the same for all of them: the value of the pixel that is looked at.
        quad = [quad[scope.lane & 3]; 4];
    }
    let run = scope.run;
    let kind = run.listing.kind();
    let asked = quad;
    if let (Target::Constant(_), ShaderKind::Pixel) = (target, kind) {
        // As when the constant is set before the shader runs.
        quad = quad.map(|value| value.map(semantics::constant));
    }
    let name = tell::target_name(target, kind) + &tell::mask_text(target, mask, kind);
    let (lane, before) = (run.lane & 3, scope.registers.target(target));
    if !session.set(target, mask, quad) {
        return Err("not between the parts of an instruction, nor between the halves of a pair: they read before any of them \
                    writes. `next` goes behind them"
            .into());
    }
    let after = session.registers().target(target)[lane];
    let mut text = Text::default();
    let line = tell::named(&name).and(tell::numbers(after, mask), Style::Changed);
    let was = format!("   (was {})", tell::numbers(before[lane], mask));
    text.line(tell::swatch(line.and(was, Style::Dim), kind, mask, after));
    if asked != quad {
        let words = "clamped to −1…1, as Direct3D 8 clamps the constants of a pixel shader";
        text.line(tell::remark(words, Style::Remarkable));
    }
    text.append(travel::arrival(console, session));
    Ok(text.into())
}

/// The components of a value in the places of a mask: one number for all, as many as the mask has in its order, or four of which
/// the mask takes its own, as a destination does.
fn spread(value: &Value, mask: WriteMask) -> Result<[f32; 4], Fault> {
    let wanted = mask.count() as usize;
    if value.count == 1 || value.count == 4 {
        return Ok(value.widened(4).numbers);
    }
    if value.count != wanted {
        return Err(format!("{} components are set to {} numbers", wanted, value.count).into());
    }
    let mut spread = [0.0; 4];
    for (component, number) in mask.components().zip(value.components()) {
        spread[component] = *number;
    }
    Ok(spread)
}

pub(super) fn unset(
    console: &mut Console,
    session: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    arguments.nothing()?;
    let count = session.edits().len();
    if count == 0 {
        return Err("nothing is set by hand".into());
    }
    session.unset();
    let mut text = Text::default();
    text.line(format!("{count} forgotten"));
    text.append(travel::arrival(console, session));
    Ok(text.into())
}

/// `diff`: the run before anything was set, beside the run as it is now.
pub(super) fn diff(
    _: &mut Console,
    session: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    arguments.nothing()?;
    let original = session
        .original()
        .ok_or("nothing is set by hand: there is one run only")?;
    let mut text = Text::default();
    for (old, new) in original.iter().zip(session.runs()) {
        text.append(difference(old, new));
    }
    if text.is_empty() {
        text.line("no value is different");
    }
    Ok(text.into())
}

/// Where two recordings of one run part, and what comes out of both. Nothing if nothing is set in it and they do not.
fn difference(old: &Run<'_>, new: &Run<'_>) -> Text {
    let mut text = Text::default();
    let set = |moment: &&Moment| moment.event == Event::Set;
    let lane = new.lane & 3;
    for moment in new.moments.iter().filter(set) {
        let Some(change) = &moment.change else {
            continue;
        };
        let kind = new.listing.kind();
        let name = tell::target_name(change.target, kind)
            + &tell::mask_text(change.target, change.mask, kind);
        let value = tell::numbers(change.after[lane], change.mask);
        text.line(Line::from(format!("   set {name} = {value}")));
    }
    let steps = |run: &'_ Run<'_>| -> Vec<usize> {
        let numbers = run.moments.iter().enumerate();
        numbers
            .filter(|(_, moment)| !set(moment))
            .map(|(number, _)| number)
            .collect()
    };
    let pairs = steps(old).into_iter().zip(steps(new));
    let parted = pairs.into_iter().find_map(|(a, b)| {
        let (a, b) = (old.moments.get(a)?, new.moments.get(b)?);
        parts(a, b, lane).then_some((a, b))
    });
    let results = results(old, new);
    if text.is_empty() && parted.is_none() && results.is_empty() {
        return text;
    }
    text.lines.insert(0, tell::run_title(new));
    match parted {
        Some((a, b)) => text.append(parting(new, a, b)),
        None => text.line("   every other value is the same"),
    }
    text.append(results);
    text
}

/// Whether the same moment of two recordings writes something else, or kills another pixel.
fn parts(old: &Moment, new: &Moment, lane: usize) -> bool {
    let written = |moment: &Moment| {
        moment.change.map(|change| {
            let mask = change.mask.components();
            mask.map(|c| change.after[lane][c].to_bits())
                .collect::<Vec<_>>()
        })
    };
    let killed = |moment: &Moment| match moment.event {
        Event::Step { killed, .. } => killed.map(|(_, after)| after[lane]),
        _ => None,
    };
    written(old) != written(new) || killed(old) != killed(new)
}

fn parting(run: &Run<'_>, old: &Moment, new: &Moment) -> Text {
    let mut text = Text::default();
    let kind = run.listing.kind();
    text.line(match new.instruction {
        Some(number) => Line::styled("   they part at", Style::Strong).joined(tell::instruction(
            run,
            number,
            "",
            Style::Strong,
        )),
        None => Line::styled("   they part at the inputs", Style::Strong),
    });
    let lane = run.lane & 3;
    if let (Some(a), Some(b)) = (&old.change, &new.change) {
        let name = tell::target_name(b.target, kind) + &tell::mask_text(b.target, b.mask, kind);
        let before = tell::numbers(a.after[lane], b.mask);
        text.line(two_values(
            &name,
            &before,
            &tell::numbers(b.after[lane], b.mask),
        ));
    }
    text
}

fn two_values(name: &str, old: &str, new: &str) -> Line {
    tell::named(name)
        .and(new, Style::Changed)
        .and(format!("   (old run: {old})"), Style::Dim)
}

/// What the target holds behind a run of a pixel.
fn held(run: &Run<'_>) -> Option<String> {
    run.moments
        .iter()
        .rev()
        .find_map(|moment| match &moment.event {
            Event::Merge(stage) => match stage.as_ref() {
                MergeStage::Write { after, .. } => {
                    let [r, g, b, a] = after.color;
                    Some(format!("#{r:02x}{g:02x}{b:02x} alpha {a}"))
                }
                _ => None,
            },
            _ => None,
        })
}

/// The results of both that differ.
fn results(old: &Run<'_>, new: &Run<'_>) -> Text {
    let mut text = Text::default();
    let (a, b): (Registers, Registers) = (old.registers(usize::MAX), new.registers(usize::MAX));
    let (kind, lane) = (new.listing.kind(), new.lane & 3);
    for slot in tell::outputs(new) {
        let (x, y) = (a.slot(slot, lane), b.slot(slot, lane));
        if x.map(f32::to_bits) != y.map(f32::to_bits) {
            let all = WriteMask::ALL;
            text.line(two_values(
                &slot.name(kind),
                &tell::numbers(x, all),
                &tell::numbers(y, all),
            ));
        }
    }
    if let [Some(x), Some(y)] = [held(old), held(new)]
        && x != y
    {
        text.line(two_values("the target", &x, &y));
    }
    if a.killed()[lane] != b.killed()[lane] {
        let word = |killed: bool| if killed { "discarded" } else { "kept" };
        let (old, new) = (word(a.killed()[lane]), word(b.killed()[lane]));
        text.line(two_values("the pixel", old, new));
    }
    if !text.is_empty() {
        text.lines
            .insert(0, Line::styled("   results", Style::Strong));
    }
    text
}

//! `why` and `quad`: where a value comes from, and what the neighbours hold.

use super::{Arguments, Console, Fault, Outcome, sample, tell};
use crate::debug::expression::Expression;
use crate::debug::moment::{Event, Target};
use crate::debug::run::{Run, RunKind};
use crate::debug::session::Session;
use crate::debug::text::{Line, Style, Text};
use crate::debug::why::{Cause, why as slice};
use crate::isa::{ShaderKind, WriteMask};
use crate::kernel::Slot;

/// The register with components that a text names where one is.
pub(super) fn register(session: &Session<'_>, text: &str) -> Result<(Target, WriteMask), Fault> {
    let scope = session.scope().ok_or("there is no run")?;
    let expression: Expression = text.parse()?;
    // What the version does not have is told before that it is no register.
    expression.evaluate(&scope)?;
    let target = expression.target_here(&scope);
    target.ok_or_else(|| format!("`{text}` is no register with components, such as r0.rg").into())
}

/// `why r0.r`: the instructions that made a value, in their order, each with what it wrote and what it read.
pub(super) fn why(
    _: &mut Console,
    session: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    let run = session.run().ok_or("there is no run")?;
    let kind = run.listing.kind();
    let (target, mask) = match (arguments.text, kind) {
        ("", ShaderKind::Pixel) => (Target::Slot(Slot::R0), WriteMask::ALL),
        ("", ShaderKind::Vertex) => return Err("why what? `why oPos.x`".into()),
        (text, _) => register(session, text)?,
    };
    let slice = slice(run, session.position().at, target, mask);
    let mut text = Text::default();
    let mut last = None;
    for cause in &slice.causes {
        let Some(moment) = run.moments.get(cause.moment) else {
            continue;
        };
        let heading = (moment.instruction, std::mem::discriminant(&moment.event));
        if last != Some(heading) {
            text.line(tell::heading(run, moment));
        }
        last = Some(heading);
        text.append(cause_lines(run, cause));
    }
    for (slot, mask) in &slice.unwritten {
        let target = Target::Slot(*slot);
        let name = tell::target_name(target, kind) + &tell::mask_text(target, *mask, kind);
        let words = format!("{name} was never written");
        text.line(tell::remark(words, Style::Remarkable));
    }
    let name = tell::target_name(target, kind) + &tell::mask_text(target, mask, kind);
    let value = session.registers().target(target)[run.lane & 3];
    if slice.causes.is_empty() {
        let words = format!(
            "{name} = {}: no instruction has made it",
            tell::numbers(value, mask)
        );
        text.line(Line::from(words));
        return Ok(text.into());
    }
    let line = Line::styled(
        format!("   {name} = {}", tell::numbers(value, mask)),
        Style::Strong,
    );
    text.line(tell::swatch(line, kind, mask, value));
    Ok(text.into())
}

/// What a moment wrote of a value, and from what.
fn cause_lines(run: &Run<'_>, cause: &Cause) -> Text {
    let kind = run.listing.kind();
    let mut text = Text::default();
    let Some((moment, change)) =
        (run.moments.get(cause.moment)).and_then(|moment| Some((moment, moment.change.as_ref()?)))
    else {
        return text;
    };
    let name =
        tell::target_name(change.target, kind) + &tell::mask_text(change.target, cause.mask, kind);
    let value = change.after[run.lane & 3];
    let line = tell::named(&name).plain(tell::numbers(value, cause.mask));
    let line = match &moment.event {
        Event::Input(source) => {
            line.and(tell::source_text(*source, run.lane, cause.mask), Style::Dim)
        }
        Event::Step {
            step,
            reads,
            sample,
            ..
        } => {
            let step = run.listing.kernel.steps.get(*step);
            let (source, used) = match sample {
                Some(sample) => {
                    let (source, used) = sample::source(run, sample);
                    (format!("{source} at "), used)
                }
                None => (String::new(), WriteMask::ALL),
            };
            let texts = reads.iter().enumerate().filter_map(|(i, read)| {
                let slots = step.map_or(read.slots, |step| step.op.slots_read(i, cause.mask));
                tell::read_text(run, read, slots.and(used))
            });
            let texts: Vec<String> = texts.collect();
            match texts.is_empty() {
                true => line,
                false => line.and(format!("   from {source}{}", texts.join(", ")), Style::Dim),
            }
        }
        _ => line,
    };
    text.line(line);
    text.append(tell::details(run, cause.moment, tell::Detail::Short));
    text
}

/// `quad`: registers of all four pixels.
pub(super) fn quad(
    _: &mut Console,
    session: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    let run = session.run().ok_or("there is no run")?;
    let pixels = pixels(run).ok_or(match run.kind {
        RunKind::Vertex {
            corner: Some(_), ..
        } => "this is a vertex: only a pixel has a quad, and `down` goes to it",
        _ => "only a pixel of a scene has a quad",
    })?;
    let kind = run.listing.kind();
    let mut rows: Vec<(Target, WriteMask)> = Vec::new();
    for word in arguments.words() {
        let scope = session.scope().ok_or("there is no run")?;
        let expression: Expression = word.parse()?;
        expression.evaluate(&scope)?;
        let target = expression.target_here(&scope);
        rows.push(target.ok_or_else(|| format!("`{word}` is no register with a mask"))?);
    }
    if rows.is_empty() {
        let done = run.moments.get(..session.position().at).unwrap_or(&[]);
        for change in done.iter().filter_map(|moment| moment.change) {
            match rows.iter_mut().find(|(target, _)| *target == change.target) {
                Some((_, mask)) => *mask = mask.or(change.mask),
                None => rows.push((change.target, change.mask)),
            }
        }
    }
    let mut text = Text::default();
    for (target, mask) in rows {
        let name = tell::target_name(target, kind) + &tell::mask_text(target, mask, kind);
        text.line(Line::styled(name, Style::Strong));
        let quad = session.registers().target(target);
        for (lane, value) in quad.iter().enumerate() {
            let line = Line::from(format!(
                "   {:<20} {}",
                pixels[lane],
                tell::numbers(*value, mask)
            ));
            text.line(tell::swatch(line, kind, mask, *value));
        }
    }
    text.append(last_level(session, run, &pixels));
    Ok(text.into())
}

/// What the pixels of the quad are called; `None` where there is no quad.
fn pixels(run: &Run<'_>) -> Option<[String; 4]> {
    let RunKind::Pixel { pixel: [x, y] } = run.kind else {
        return None;
    };
    Some(std::array::from_fn(|lane| {
        let (column, row) = ((x & !1) + (lane as u32 & 1), (y & !1) + (lane as u32 >> 1));
        let what = match (lane == run.lane, run.helpers[lane]) {
            (true, _) => " here",
            (false, true) => " helper",
            (false, false) => "",
        };
        format!("{column},{row}{what}")
    }))
}

/// The levels of detail of the last sample before the place.
fn last_level(session: &Session<'_>, run: &Run<'_>, pixels: &[String; 4]) -> Text {
    let mut text = Text::default();
    let done = run.moments.get(..session.position().at).unwrap_or(&[]);
    let last = done.iter().rev().find_map(|moment| match &moment.event {
        Event::Step {
            sample: Some(sample),
            ..
        } => Some((moment.instruction?, *sample)),
        _ => None,
    });
    let Some((instruction, sample)) = last else {
        return text;
    };
    let line = run.listing.line(instruction);
    text.line(Line::styled(
        format!("stage {}, line {line}", sample.stage),
        Style::Strong,
    ));
    for (pixel, detail) in pixels.iter().zip(sample.detail) {
        text.line(format!("   {pixel:<20} {}", sample::detail_text(&detail)));
    }
    text
}

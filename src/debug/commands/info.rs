//! `info`: registers, constants, inputs, outputs, textures, the phase, the budget, and what is set up.

use super::{Arguments, Console, Fault, Outcome, look, sample, stopping, table, tell, travel};
use crate::debug::moment::{Event, Target};
use crate::debug::run::Run;
use crate::debug::session::Session;
use crate::debug::text::{Line, Style, Text};
use crate::exec::Stage;
use crate::isa::{Opcode, ShaderKind, WriteMask};
use crate::kernel::{Place, Slot};
use crate::semantics;
use crate::validate::{Usage, statistics};

/// A topic of `info`.
pub(super) struct Topic {
    pub(super) name: &'static str,
    pub(super) summary: &'static str,
    tell: fn(&Console, &Session<'_>, &Run<'_>) -> Text,
}

/// The topics, a row each.
pub(super) static TOPICS: [Topic; 13] = [
    row(
        "registers",
        "temporaries, what was sampled, the address register",
        |_, s, r| registers(s, r),
    ),
    row(
        "constants",
        "the constants that the shader names",
        |_, s, r| constants(s, r),
    ),
    row(
        "inputs",
        "what the shader is given, and where it comes from",
        |_, s, r| inputs(s, r),
    ),
    row("outputs", "what the shader leaves behind", |_, s, r| {
        outputs(s, r)
    }),
    row(
        "textures",
        "the stages, their textures and states",
        |_, _, r| textures(r),
    ),
    row("phase", "the phase of the next instruction", |_, s, r| {
        phase(s, r)
    }),
    row(
        "budget",
        "instruction slots used of those allowed",
        |_, _, r| budget(r),
    ),
    row("line", "where one is", |_, s, _| travel::location(s)),
    row(
        "runs",
        "the runs of the vertices and of the pixel",
        |_, s, _| travel::runs(s),
    ),
    row(
        "breakpoints",
        "breakpoints, watchpoints, log points, what is caught",
        |c, s, _| stopping::list(c, s),
    ),
    row("watchpoints", "the same", |c, s, _| stopping::list(c, s)),
    row(
        "display",
        "the expressions that are shown after each stop",
        |c, s, _| display(c, s),
    ),
    row(
        "all",
        "registers, constants, inputs, outputs, textures, phase, budget",
        all,
    ),
];

const fn row(
    name: &'static str,
    summary: &'static str,
    tell: fn(&Console, &Session<'_>, &Run<'_>) -> Text,
) -> Topic {
    Topic {
        name,
        summary,
        tell,
    }
}

pub(super) fn info(
    console: &mut Console,
    session: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    if arguments.text.is_empty() {
        let mut text = Text::default();
        for topic in &TOPICS {
            text.line(
                Line::styled(format!("info {:<12}", topic.name), Style::Strong)
                    .plain(topic.summary),
            );
        }
        return Ok(text.into());
    }
    let topic = topic(arguments.text)?;
    let run = session.run().ok_or("there is no run")?;
    Ok((topic.tell)(console, session, run).into())
}

/// The topic that a word or the beginning of one names; the first of several.
fn topic(word: &str) -> Result<&'static Topic, Fault> {
    let lower = word.to_ascii_lowercase();
    // What gdb means by these.
    let lower = match lower.as_str() {
        "frame" => "line",
        "b" => "breakpoints",
        other => other,
    };
    let found = TOPICS.iter().find(|topic| topic.name.starts_with(lower));
    found.ok_or_else(|| {
        let names = TOPICS.iter().map(|topic| topic.name);
        table::unknown("topic of info", word, names)
    })
}

fn all(console: &Console, session: &Session<'_>, run: &Run<'_>) -> Text {
    let mut text = Text::default();
    for topic in TOPICS.iter().take(7) {
        text.line(Line::styled(topic.name, Style::Strong));
        text.append((topic.tell)(console, session, run));
    }
    text
}

/// A register with its four components. What the last moment wrote is marked.
fn register(session: &Session<'_>, run: &Run<'_>, slot: Slot) -> Line {
    let kind = run.listing.kind();
    let registers = session.registers();
    let value = registers.slot(slot, run.lane);
    let written = registers.written(slot);
    let changed = session.last_moment().and_then(|moment| moment.change);
    let changed = changed.is_some_and(|change| change.target == Target::Slot(slot));
    let style = if changed {
        Style::Changed
    } else {
        Style::Plain
    };
    let line = Line::from(format!("   {:<5} ", slot.name(kind)));
    line.and(tell::register_text(value, written), style)
}

/// As [`register`], with a field of the colour at the end.
fn register_line(session: &Session<'_>, run: &Run<'_>, slot: Slot) -> Line {
    let value = session.registers().slot(slot, run.lane);
    let written = session.registers().written(slot);
    let line = register(session, run, slot);
    tell::swatch(line, run.listing.kind(), written, value)
}

fn used(run: &Run<'_>, slot: Slot) -> bool {
    let kernel = run.listing.kernel;
    !kernel.written(slot).is_empty() || !kernel.read(slot).is_empty()
}

/// Nothing is there.
fn none(text: Text, words: &str) -> Text {
    if !text.is_empty() {
        return text;
    }
    Text {
        lines: vec![Line::styled(format!("   {words}"), Style::Dim)],
    }
}

fn is_input(slot: Slot) -> bool {
    slot.input_index().is_some() || slot.texcoord_index().is_some()
}

fn registers(session: &Session<'_>, run: &Run<'_>) -> Text {
    let result = (run.listing.kind() == ShaderKind::Pixel).then_some(Slot::R0);
    let slots = Slot::all().filter(|slot| {
        let named = !slot.is_internal() && !slot.is_output() && !is_input(*slot);
        named && (used(run, *slot) || result == Some(*slot))
    });
    let mut text = Text {
        lines: slots
            .map(|slot| register_line(session, run, slot))
            .collect(),
    };
    if session.registers().killed()[run.lane & 3] {
        text.line(Line::styled("   the pixel is discarded", Style::Remarkable));
    }
    none(text, "the shader uses none")
}

fn constants(session: &Session<'_>, run: &Run<'_>) -> Text {
    let kernel = run.listing.kernel;
    let registers = session.registers();
    let relative = (kernel.steps.iter())
        .flat_map(|step| &step.sources)
        .any(|operand| matches!(operand.place, Place::Relative(_)));
    let mut numbers: Vec<u32> = kernel.constants().collect();
    if relative {
        // Any of them may be read: those that are set.
        let all = 0..registers.constant_count() as u32;
        numbers.extend(all.filter(|index| registers.constant(*index) != [0.0; 4]));
    }
    numbers.sort_unstable();
    numbers.dedup();
    let lines = numbers.into_iter().map(|index| {
        let value = registers.constant(index);
        let defined = kernel
            .definitions
            .iter()
            .rev()
            .find(|(number, _)| *number == index);
        let bound = |defined: [f32; 4]| match run.listing.kind() {
            ShaderKind::Vertex => defined,
            ShaderKind::Pixel => defined.map(semantics::constant),
        };
        let origin = match defined.map(|(_, defined)| *defined) {
            Some(defined) if defined == value => "   def".to_string(),
            Some(defined) if bound(defined) == value => {
                let written = tell::numbers(defined, WriteMask::ALL);
                format!("   def {written}, clamped to −1…1")
            }
            Some(_) => "   set over its def".to_string(),
            None => String::new(),
        };
        let line = Line::from(format!(
            "   {:<5} {}",
            format!("c{index}"),
            tell::numbers(value, WriteMask::ALL)
        ));
        line.and(origin, Style::Dim)
    });
    let text = Text {
        lines: lines.collect(),
    };
    none(text, "the shader names none")
}

fn inputs(session: &Session<'_>, run: &Run<'_>) -> Text {
    let mut text = Text::default();
    for moment in &run.moments {
        let (Event::Input(source), Some(change)) = (&moment.event, &moment.change) else {
            continue;
        };
        let Some(slot) = change.target.slot() else {
            continue;
        };
        let words = tell::source_text(*source, run.lane, WriteMask::ALL);
        text.line(register(session, run, slot).and(words, Style::Dim));
    }
    none(text, "the shader reads none")
}

fn outputs(session: &Session<'_>, run: &Run<'_>) -> Text {
    let slots = tell::outputs(run);
    Text {
        lines: slots
            .into_iter()
            .map(|slot| register_line(session, run, slot))
            .collect(),
    }
}

fn textures(run: &Run<'_>) -> Text {
    let mut text = Text::default();
    let stages = run.listing.kernel.stages();
    for (number, stage) in run.environment.stages.iter().enumerate() {
        if stages >> number & 1 == 1 {
            text.line(stage_line(number, stage));
        }
    }
    none(text, "the shader samples none")
}

fn stage_line(number: usize, stage: &Stage<'_>) -> Line {
    let Some(texture) = stage.texture else {
        return Line::from(format!("   stage {number}: no texture, opaque black"));
    };
    let sampler = &stage.sampler;
    let levels = match texture.level_count() {
        1 => "1 level".to_string(),
        count => format!("{count} levels"),
    };
    let [u, v, w] = sampler.address;
    let address = if u == v && v == w {
        u.to_string()
    } else {
        format!("{u}, {v}, {w}")
    };
    Line::from(format!(
        "   stage {number}: {}, {levels}; min {}, mag {}, mip {}, {address}",
        sample::texture_text(texture),
        sampler.min,
        sampler.mag,
        sampler.mip
    ))
}

/// The number of the `phase` instruction, if there is one.
fn phase_instruction(run: &Run<'_>) -> Option<usize> {
    let mut instructions = run.listing.program.instructions();
    instructions.position(|instruction| instruction.opcode == Opcode::Phase)
}

fn phase(session: &Session<'_>, run: &Run<'_>) -> Text {
    let words = match (phase_instruction(run), session.next_instruction()) {
        (None, _) => format!("{} has one phase", run.listing.program.version),
        (Some(_), None) => "behind the second phase".to_string(),
        (Some(phase), Some(next)) => {
            let which = if next <= phase { "first" } else { "second" };
            let line = run.listing.line(phase);
            format!("{which} phase; `phase` stands on line {line}")
        }
    };
    Text {
        lines: vec![Line::from(format!("   {words}"))],
    }
}

fn budget(run: &Run<'_>) -> Text {
    let statistics = statistics(run.listing.program);
    let of = |usage: Usage| format!("{} of {}", usage.used, usage.allowed);
    let phases = statistics.phases.len();
    let mut text = Text::default();
    for (number, slots) in statistics.phases.iter().enumerate() {
        let phase = match phases {
            1 => String::new(),
            _ => format!("phase {}: ", number + 1),
        };
        text.line(match run.listing.kind() {
            ShaderKind::Vertex => format!("   {} slots", of(slots.arithmetic)),
            ShaderKind::Pixel => format!(
                "   {phase}{} arithmetic slots, {} texture slots",
                of(slots.arithmetic),
                of(slots.texture)
            ),
        });
    }
    text
}

fn display(console: &Console, session: &Session<'_>) -> Text {
    none(look::displayed(console, session), "nothing is displayed")
}

/// The registers and constants that the shader names: for completion.
pub(super) fn register_names(session: &Session<'_>) -> Vec<String> {
    let Some(run) = session.run() else {
        return Vec::new();
    };
    let kind = run.listing.kind();
    let slots = Slot::all().filter(|slot| !slot.is_internal() && used(run, *slot));
    let mut names: Vec<String> = slots.map(|slot| slot.name(kind)).collect();
    names.extend(
        run.listing
            .kernel
            .constants()
            .map(|index| format!("c{index}")),
    );
    names.sort();
    names.dedup();
    names
}

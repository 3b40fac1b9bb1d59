//! Inlay hints: the slots that are used.

use super::analysis::{Analysis, Shader};
use super::documents::Document;
use super::settings::Hints;
use serde_json::{Value, json};
use std::ops::Range;
use texcrd::isa::{Opcode, ShaderKind};
use texcrd::program::Program;
use texcrd::validate::{self, PhaseSlots, SlotUse, Usage};

/// The hints in a part of a document.
///
/// Behind the version, and behind `phase` for what follows it, stands what the phase uses of what it may use; behind each
/// instruction that takes more or less than one slot, how many. [`Hints::Running`] puts what is used so far behind every one.
pub(super) fn hints(
    analysis: &Analysis,
    document: &Document,
    part: &Range<usize>,
    which: Hints,
) -> Vec<Value> {
    if which == Hints::Off {
        return Vec::new();
    }
    let mut found = Vec::new();
    for shader in analysis.shaders.iter().filter(|shader| shader.listing) {
        if shader.region.end < part.start || part.end < shader.region.start {
            continue;
        }
        if let Some(program) = &shader.program {
            of_shader(analysis, shader, program, which, &mut found);
        }
    }
    // What an instruction of a macro takes stands behind the use of the macro.
    let mut shown: Vec<(usize, Hint)> = Vec::new();
    for (at, hint) in found {
        match shown.last_mut().filter(|(last, _)| *last == at) {
            Some((_, last)) => last.join(hint),
            None => shown.push((at, hint)),
        }
    }
    let bytes = document.text.as_bytes();
    let here = shown
        .into_iter()
        .filter(|(at, _)| part.start <= *at && *at <= part.end);
    let one = |(at, hint): (usize, Hint)| {
        let label = hint.label()?;
        Some(json!({
            "position": document.lines.position(bytes, at),
            "label": label,
            "paddingLeft": true,
            "tooltip": hint.tooltip,
        }))
    };
    here.filter_map(one).collect()
}

/// What stands behind a place.
struct Hint {
    cost: u32,
    so_far: Option<String>,
    totals: Option<String>,
    tooltip: &'static str,
}

impl Hint {
    fn join(&mut self, next: Hint) {
        self.cost = self.cost.saturating_add(next.cost);
        self.so_far = next.so_far.or(self.so_far.take());
        self.totals = next.totals.or(self.totals.take());
    }

    fn label(&self) -> Option<String> {
        let cost = (self.cost > 1 && self.totals.is_none()).then(|| format!("{} slots", self.cost));
        let parts: Vec<String> = [self.totals.clone(), cost, self.so_far.clone()]
            .into_iter()
            .flatten()
            .collect();
        (!parts.is_empty()).then(|| parts.join(", "))
    }
}

fn of_shader(
    analysis: &Analysis,
    shader: &Shader,
    program: &Program,
    which: Hints,
    found: &mut Vec<(usize, Hint)>,
) {
    let statistics = validate::statistics(program);
    let kind = program.version.kind();
    let mut totals = statistics.phases.iter().map(|phase| text(kind, phase));
    let mut total = |span| {
        let at = analysis.written(span)?.end;
        let hint = Hint {
            cost: 0,
            so_far: None,
            totals: Some(totals.next()?),
            tooltip: "slots used of slots allowed",
        };
        Some((at.clamp(shader.region.start, shader.region.end), hint))
    };
    found.extend(total(program.version_span));
    let slots = validate::slots(program);
    let mut phases = program
        .instructions()
        .filter(|i| i.opcode == Opcode::Phase)
        .peekable();
    for used in &slots {
        if let Some(phase) = phases.next_if(|phase| phase.span == used.span) {
            found.extend(total(phase.span));
            continue;
        }
        let Some(at) = analysis.written(used.span) else {
            continue;
        };
        let so_far = (statistics.phases.get(used.phase))
            .filter(|_| which == Hints::Running && used.arithmetic + used.texture > 0)
            .map(|phase| running(used, phase));
        let hint = Hint {
            cost: used.arithmetic + used.texture,
            so_far,
            totals: None,
            tooltip: "slots that this takes",
        };
        found.push((at.end, hint));
    }
}

fn running(used: &SlotUse, phase: &PhaseSlots) -> String {
    let of = |so_far: u32, usage: Usage| format!("{so_far}/{}", usage.allowed);
    match used.texture > used.arithmetic {
        true => of(used.texture_so_far, phase.texture),
        false => of(used.arithmetic_so_far, phase.arithmetic),
    }
}

/// `3/4 texture, 5/8 arithmetic`; in a vertex shader `17/128 slots`.
fn text(kind: ShaderKind, phase: &PhaseSlots) -> String {
    let of = |usage: Usage| format!("{}/{}", usage.used, usage.allowed);
    match kind {
        ShaderKind::Vertex => format!("{} slots", of(phase.arithmetic)),
        ShaderKind::Pixel => format!(
            "{} texture, {} arithmetic",
            of(phase.texture),
            of(phase.arithmetic)
        ),
    }
}

//! B1 to B10: how much a shader may hold.

use super::listing::{Line, Listing, Phase, ordinal};
use super::report::Report;
use crate::isa::{Form, Opcode, ShaderKind, SourceModifier, Version};
use crate::rules::model::Code;

/// Slots that a phase takes.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Slots {
    pub(super) arithmetic: u32,
    pub(super) texture: u32,
}

/// Slots of both phases, `[first, second]`; a version without phases has only the second.
pub(super) fn slots(listing: &Listing) -> [Slots; 2] {
    let mut sums = [Slots::default(); 2];
    for group in listing.groups() {
        let (cost, sum) = (cost(group), &mut sums[phase_index(group)]);
        sum.arithmetic = sum.arithmetic.saturating_add(cost.arithmetic);
        sum.texture = sum.texture.saturating_add(cost.texture);
    }
    sums
}

pub(super) fn phase_index(group: &[Line]) -> usize {
    group.first().map_or(1, |line| line.phase as usize)
}

/// Slots of what runs at once: both halves of a pair share theirs.
pub(super) fn cost(group: &[Line]) -> Slots {
    let forms = group.iter().filter_map(|line| line.form);
    forms.fold(Slots::default(), |cost, form| Slots {
        arithmetic: cost.arithmetic.max(form.arithmetic_slots),
        texture: cost.texture.max(form.texture_slots),
    })
}

/// Arithmetic slots of these lines if they run one by one.
pub(super) fn slots_apart(lines: &[Line]) -> u32 {
    lines.chunks(1).map(|line| cost(line).arithmetic).sum()
}

/// Arithmetic slots of these lines if they run at once.
pub(super) fn slots_joined(lines: &[Line]) -> u32 {
    cost(lines).arithmetic
}

pub(super) fn check(listing: &Listing, report: &mut Report) {
    let over = most_of_an_instruction(listing, report);
    slots_of_phases(listing, &over, report);
    divisions_by_z(listing, report);
}

/// B6, B7, B8, B10. Returns the instructions over their number, which then do not count against the slots: one
/// fault, one message.
fn most_of_an_instruction(listing: &Listing, report: &mut Report) -> Vec<Opcode> {
    let mut over = Vec::new();
    let mut counts: Vec<(Opcode, u32)> = Vec::new();
    for (line, form) in listing.known() {
        let opcode = line.instruction.opcode;
        let Some(most) = form.most else { continue };
        let code = match opcode {
            Opcode::Dp4 => Code::B6,
            Opcode::Cmp => Code::B7,
            Opcode::Bem => Code::B8,
            Opcode::Phase => Code::B10,
            // A limit without a rule of its own is kept by the slots.
            _ => continue,
        };
        let at = counts.iter().position(|(o, _)| *o == opcode);
        let at = at.unwrap_or_else(|| {
            counts.push((opcode, 0));
            counts.len() - 1
        });
        counts[at].1 += 1;
        if counts[at].1 == most + 1 {
            over.push(opcode);
            report.breach(
                code,
                line.instruction.mnemonic_span,
                format!(
                    "{} takes {most} {}; this is the {}",
                    listing.version,
                    opcode.mnemonic(),
                    ordinal(most + 1)
                ),
                instead_of(opcode),
            );
        }
    }
    over
}

/// What to write where an instruction may not stand again.
fn instead_of(opcode: Opcode) -> &'static str {
    match opcode {
        Opcode::Dp4 => {
            "a dp3 and a mad for the fourth component do the same; ps.1.4 has no such limit"
        }
        Opcode::Cmp => "cnd selects too, by r0.a; ps.1.4 has no such limit",
        Opcode::Bem => {
            "the second perturbation can be written as two mad with the matrix in a constant"
        }
        _ => "a shader has two phases; remove this one",
    }
}

/// B1 to B5. The instruction that goes over the limit is named, and only the first.
fn slots_of_phases(listing: &Listing, over: &[Opcode], report: &mut Report) {
    let limit = listing.version.row();
    let totals = slots(listing);
    let mut sums = [Slots::default(); 2];
    for group in listing.groups() {
        let Some(line) = group.first() else { continue };
        if over.contains(&line.instruction.opcode) {
            continue;
        }
        let (cost, phase) = (cost(group), phase_index(group));
        let (before, total) = (sums[phase], totals[phase]);
        sums[phase].arithmetic = before.arithmetic.saturating_add(cost.arithmetic);
        sums[phase].texture = before.texture.saturating_add(cost.texture);
        let crosses = |before: u32, now: u32, limit: u32| before <= limit && now > limit;
        let now = sums[phase];
        if crosses(before.arithmetic, now.arithmetic, limit.arithmetic_slots) {
            arithmetic_over(listing, line, total.arithmetic, report);
        }
        if crosses(before.texture, now.texture, limit.texture_slots) {
            texture_over(listing, line, total.texture, report);
        }
    }
}

fn arithmetic_over(listing: &Listing, line: &Line, total: u32, report: &mut Report) {
    let limit = listing.version.row().arithmetic_slots;
    let span = line.instruction.mnemonic_span;
    let version = listing.version;
    if version.kind() == ShaderKind::Vertex {
        report.breach(
            Code::B1,
            span,
            format!("{version} takes {limit} slots; this shader takes {total}, and the limit is passed here"),
            "macros count as they expand: exp and log 10, frc 3, m4x4 and m3x4 4, m4x3 and m3x3 3, m3x2 2",
        );
        return;
    }
    let code = if version == Version::Ps14 {
        Code::B5
    } else {
        Code::B3
    };
    report.breach(
        code,
        span,
        format!(
            "{version} takes {limit} arithmetic slots{}; {} takes {total}, and the limit is passed here",
            in_a_phase(listing),
            this_part(listing, line)
        ),
        more_room(
            listing,
            line,
            "a colour and an alpha instruction joined by + count once",
            "8 arithmetic slots in each of two phases",
        ),
    );
}

fn texture_over(listing: &Listing, line: &Line, total: u32, report: &mut Report) {
    let limit = listing.version.row().texture_slots;
    let code = if listing.version == Version::Ps14 {
        Code::B4
    } else {
        Code::B2
    };
    report.breach(
        code,
        line.instruction.mnemonic_span,
        format!(
            "{} takes {limit} texture instructions{}; this is the {} of {total}",
            listing.version,
            in_a_phase(listing),
            ordinal(limit + 1)
        ),
        more_room(
            listing,
            line,
            "leave one out",
            "6 texture instructions in each of two phases",
        ),
    );
}

fn in_a_phase(listing: &Listing) -> &'static str {
    if listing.version == Version::Ps14 {
        " in a phase"
    } else {
        ""
    }
}

fn this_part(listing: &Listing, line: &Line) -> &'static str {
    match (listing.has_phase, line.phase) {
        (false, _) => "this shader",
        (true, Phase::First) => "the first phase",
        (true, Phase::Second) => "the second phase",
    }
}

/// Where more instructions find room.
fn more_room(listing: &Listing, line: &Line, shorter: &str, in_ps_1_4: &str) -> String {
    if listing.version != Version::Ps14 {
        return format!("{shorter}; ps.1.4 takes {in_ps_1_4}");
    }
    let phase = match (listing.has_phase, line.phase) {
        (false, _) => "a shader with a phase instruction has the room twice",
        (true, Phase::First) => "the second phase has room of its own",
        (true, Phase::Second) => "the first phase has room of its own",
    };
    format!("{shorter}; {phase}")
}

/// B9.
fn divisions_by_z(listing: &Listing, report: &mut Report) {
    const MOST: usize = 2;
    let divides = |(line, _): (&Line<'_>, &'static Form)| {
        let mut sources = line.instruction.sources.iter();
        let found = sources.find(|s| s.modifier == SourceModifier::Dz);
        found.map(|s| s.span)
    };
    if listing.version != Version::Ps14 {
        return;
    }
    if let Some(span) = listing.known().filter_map(divides).nth(MOST) {
        report.breach(
            Code::B9,
            span,
            "ps.1.4 takes _dz twice; this is the 3rd",
            "divide in the vertex shader, or read t#_dw.xyw, which may stand any number of times",
        );
    }
}

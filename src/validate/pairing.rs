//! C1 to C7: instructions that run together.

use super::listing::{Line, Listing, Read};
use super::ports;
use super::report::Report;
use crate::isa::opcode::Pairing;
use crate::isa::{Opcode, Version, WriteMask};
use crate::program::Statement;
use crate::rules::model::Code;

pub(super) fn check(listing: &Listing, report: &mut Report) {
    vertex_shaders_have_no_pairs(listing, report);
    if !listing.is_pixel() {
        return;
    }
    definitions_stand_alone(listing, report);
    let mut previous: Option<&Line> = None;
    for line in &listing.lines {
        let hidden = previous.map_or(listing.program.version_span, |l| l.instruction.span);
        if line.instruction.co_issue
            && !line.joined
            && !listing.hides_between(hidden, line.instruction.span)
        {
            not_joined(listing, previous, line, report);
        }
        previous = Some(line);
    }
    for group in listing.groups() {
        let [first, second] = group else { continue };
        if halves_may_pair(listing, first, second, report) {
            masks_are_apart(listing, first, second, report);
            registers_are_one(listing, first, second, report);
        }
    }
}

/// C1.
pub(super) fn vertex_shaders_have_no_pairs(listing: &Listing, report: &mut Report) {
    if listing.is_pixel() {
        return;
    }
    for statement in &listing.program.statements {
        let (opcode, span) = match statement {
            Statement::Instruction(i) if i.co_issue => (i.opcode, i.mnemonic_span),
            Statement::Def(def) if def.co_issue => (Opcode::Def, def.span),
            _ => continue,
        };
        report.breach(
            Code::C1,
            span,
            format!(
                "{} has no pairs; + stands before {}",
                listing.version,
                opcode.mnemonic()
            ),
            "leave the + out",
        );
    }
}

/// C7 for `def`.
fn definitions_stand_alone(listing: &Listing, report: &mut Report) {
    for statement in &listing.program.statements {
        if let Statement::Def(def) = statement
            && def.co_issue
        {
            report.breach(
                Code::C7,
                def.span,
                "def cannot be half of a pair",
                "leave the + out",
            );
        }
    }
}

/// C2, C7: a `+` that joins nothing.
fn not_joined(listing: &Listing, previous: Option<&Line>, line: &Line, report: &mut Report) {
    let span = line.instruction.mnemonic_span;
    if line.form.is_some() && !line.is_arithmetic() {
        report.breach(
            Code::C7,
            span,
            format!("{} cannot be half of a pair", line.mnemonic()),
            "leave the + out",
        );
        return;
    }
    let message = match previous {
        None => "+ stands before the first instruction, with nothing to join".to_string(),
        Some(before) if before.joined => format!(
            "{} before it is already the second half of a pair",
            before.mnemonic()
        ),
        Some(before) => format!("{} before it cannot be half of a pair", before.mnemonic()),
    };
    let help = format!(
        "leave the + out; {} runs one colour and one alpha instruction at once",
        listing.version
    );
    report.breach(Code::C2, span, message, help);
}

/// C6. Returns whether both instructions are such as form pairs.
fn halves_may_pair(listing: &Listing, first: &Line, second: &Line, report: &mut Report) -> bool {
    let mut may = true;
    for half in [first, second] {
        let message = match (half.form, why_alone(half)) {
            (None, _) => return false,
            (_, None) => continue,
            (_, Some(message)) => message,
        };
        may = false;
        report.breach(
            Code::C6,
            half.instruction.mnemonic_span,
            message,
            format!("{} runs it on its own, without +", listing.version),
        );
    }
    may
}

/// Why an arithmetic instruction is no half of a pair.
fn why_alone(half: &Line) -> Option<String> {
    let mask = half.instruction.destination.map(|d| d.mask);
    match half.form?.pairing {
        Pairing::Never => Some(format!("{} cannot be half of a pair", half.mnemonic())),
        Pairing::Color if mask.is_some_and(|m| m.has(3)) => Some(format!(
            "{} writes alpha; in a pair it writes colour",
            half.mnemonic()
        )),
        _ => None,
    }
}

/// Whether two instructions that follow each other, and are in no pair, could be one that computes the same.
pub(super) fn could_pair(listing: &Listing, first: &Line, second: &Line) -> bool {
    let halves = [first, second];
    let may = |half: &&Line| half.is_arithmetic() && !half.paired && why_alone(half).is_none();
    let destinations = (
        first.instruction.destination,
        second.instruction.destination,
    );
    let (true, (Some(a), Some(b))) = (listing.is_pixel() && halves.iter().all(may), destinations)
    else {
        return false;
    };
    // Both halves read before either writes.
    let waits = first.writes().is_some_and(|(register, mask)| {
        let reads = listing.reads(second);
        let waits = |r: &Read| r.register == register && !r.components.and(mask).is_empty();
        reads.iter().any(waits)
    });
    !waits
        && masks_fit(first, a.mask)
        && masks_fit(second, b.mask)
        && are_apart(listing.version, a.mask, b.mask)
        && (listing.version != Version::Ps10 || a.register == b.register)
        && ports::pair_is_within(listing, first, second)
}

/// Whether an instruction may write such a mask on its own.
fn masks_fit(line: &Line, mask: WriteMask) -> bool {
    let shape = line.form.and_then(|form| form.destination);
    shape.is_none_or(|shape| shape.masks.contains(mask))
}

/// Whether of two masks one is that of a colour half and the other that of an alpha half.
fn are_apart(version: Version, a: WriteMask, b: WriteMask) -> bool {
    let is_color = |m: WriteMask| match version {
        Version::Ps14 => !m.has(3),
        _ => m == WriteMask::XYZ,
    };
    let apart = |color: WriteMask, alpha: WriteMask| is_color(color) && alpha == WriteMask::W;
    apart(a, b) || apart(b, a)
}

/// C3, C4.
fn masks_are_apart(listing: &Listing, first: &Line, second: &Line, report: &mut Report) {
    let (Some(a), Some(b)) = (
        first.instruction.destination,
        second.instruction.destination,
    ) else {
        return;
    };
    // M7 speaks of a mask that the instruction does not have on its own.
    let fit = masks_fit(first, a.mask) && masks_fit(second, b.mask);
    if !fit || are_apart(listing.version, a.mask, b.mask) {
        return;
    }
    let (code, color) = match listing.version {
        Version::Ps14 => (Code::C4, "some of r, g and b"),
        _ => (Code::C3, ".rgb"),
    };
    report.breach(
        code,
        b.span,
        format!(
            "this pair writes {} and {}; one half writes {color}, the other .a",
            listing.mask(a.mask),
            listing.mask(b.mask)
        ),
        "write the masks so, or leave the + out",
    );
}

/// C5.
fn registers_are_one(listing: &Listing, first: &Line, second: &Line, report: &mut Report) {
    let (Some(a), Some(b)) = (
        first.instruction.destination,
        second.instruction.destination,
    ) else {
        return;
    };
    if listing.version == Version::Ps10 && a.register != b.register {
        report.breach(
            Code::C5,
            b.span,
            format!(
                "this pair of ps.1.0 writes {} and {}",
                a.register, b.register
            ),
            "write the same register in both halves; from ps.1.1 on they may differ",
        );
    }
}

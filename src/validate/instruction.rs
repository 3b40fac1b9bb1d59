//! O5, O12, O14 to O22: what single instructions ask of their operands beyond what their rows say.

use super::listing::{Line, Listing, Phase};
use super::modifiers::allowed_masks;
use super::report::Report;
use crate::isa::opcode::{ModifierRule, Slots};
use crate::isa::{
    Form, Opcode, RegisterFile, SourceModifier, Swizzle, Version, VersionSet, WriteMask,
};
use crate::program::{Register, Source};
use crate::rules::model::Code;

/// Rules on one instruction as a whole.
pub(super) fn check(listing: &Listing, line: &Line, form: &Form, report: &mut Report) {
    let opcode = line.instruction.opcode;
    match opcode {
        Opcode::TexCrd => texcrd_mask(listing, line, report),
        Opcode::TexDepth => texdepth(listing, line, report),
        Opcode::Cnd => condition(listing, line, report),
        Opcode::Cmp => cmp_destination(listing, line, report),
        Opcode::Bem => bem(listing, line, report),
        Opcode::Frc => frc_mask(listing, line, form, report),
        Opcode::Mov => address_mask(listing, line, report),
        _ if form.rows > 0 => matrix(listing, line, form, report),
        _ if !listing.is_pixel() => scalar_source(listing, line, form, report),
        _ => {}
    }
}

/// O12 on the mask.
fn texcrd_mask(listing: &Listing, line: &Line, report: &mut Report) {
    let Some(destination) = line.instruction.destination else {
        return;
    };
    let (right, text) = if line.divides() {
        (WriteMask::XY, ".rg")
    } else {
        (WriteMask::XYZ, ".rgb")
    };
    if destination.mask == right {
        return;
    }
    let code = if destination.mask == WriteMask::ALL {
        Code::O12NoMask
    } else {
        Code::O12
    };
    report.breach(
        code,
        destination.span,
        format!(
            "texcrd writes {text} here, not {}",
            listing.mask(destination.mask)
        ),
        format!(
            "write {}{text}; alpha is left undefined",
            destination.register
        ),
    );
}

/// O14.
fn texdepth(listing: &Listing, line: &Line, report: &mut Report) {
    let Some(destination) = line.instruction.destination else {
        return;
    };
    let right = Register::new(RegisterFile::Temp, 5);
    let mut code = Code::O14;
    let message = if destination.register.file == RegisterFile::Temp
        && destination.register != right
        && listing.exists(destination.register)
    {
        format!("texdepth takes r5, not {}", destination.register)
    } else if line.phase == Phase::First {
        "texdepth stands before phase".to_string()
    } else if destination.register == right
        && !listing.has_phase
        && !listing.hides_write(right, destination.span)
    {
        code = Code::O14NoPhase;
        "texdepth stands in a shader without phase".to_string()
    } else {
        return;
    };
    report.breach(
        code,
        destination.span,
        message,
        "write r5.rg before phase and texdepth r5 after it",
    );
}

/// Whether source `i` is the condition of a `cnd` that asks `r0.a` only.
pub(super) fn is_condition_of_cnd(version: Version, line: &Line, i: usize) -> bool {
    i == 0 && line.instruction.opcode == Opcode::Cnd && VersionSet::PS_1_0_TO_1_3.contains(version)
}

/// O15.
fn condition(listing: &Listing, line: &Line, report: &mut Report) {
    let Some(source) = line.instruction.sources.first() else {
        return;
    };
    let is_r0_a = source.register == Register::new(RegisterFile::Temp, 0)
        && source.swizzle == Swizzle::replicate(3)
        && source.modifier == SourceModifier::None;
    // O3 refuses a0.
    let readable = source.register.file != RegisterFile::Addr;
    if is_condition_of_cnd(listing.version, line, 0) && readable && !is_r0_a {
        report.breach(
            Code::O15,
            source.span,
            format!("cnd of {} asks r0.a only", listing.version),
            "write the condition to r0.a first; ps.1.4 asks any register",
        );
    }
}

/// O17.
fn cmp_destination(listing: &Listing, line: &Line, report: &mut Report) {
    let Some(destination) = line.instruction.destination else {
        return;
    };
    let read = |s: &&Source| s.register == destination.register;
    if let (true, Some(source)) = (
        VersionSet::PS_1_2_TO_1_3.contains(listing.version),
        line.instruction.sources.iter().find(read),
    ) {
        report.breach(
            Code::O17,
            source.span,
            format!(
                "cmp of {} cannot read {}, the register that it writes",
                listing.version, source.register
            ),
            "write to another register",
        );
    }
}

/// O18 on the mask.
fn bem(listing: &Listing, line: &Line, report: &mut Report) {
    let Some(destination) = line.instruction.destination else {
        return;
    };
    if destination.mask != WriteMask::XY {
        report.breach(
            Code::O18,
            destination.span,
            format!("bem writes .rg, not {}", listing.mask(destination.mask)),
            format!("write {}.rg", destination.register),
        );
    }
}

/// O18 on the phase; of a second bem B8 speaks.
pub(super) fn first_bem(listing: &Listing, report: &mut Report) {
    let is_bem = |(line, _): &(&Line, &Form)| line.instruction.opcode == Opcode::Bem;
    let Some((line, _)) = listing.known().find(is_bem) else {
        return;
    };
    let destination = line.instruction.destination;
    let mask_fits = destination.is_none_or(|d| d.mask == WriteMask::XY);
    if line.phase == Phase::Second && mask_fits {
        let help = if listing.has_phase {
            "move it up before phase"
        } else {
            "put phase behind it: a shader without phase is all second phase"
        };
        report.breach(
            Code::O18,
            line.instruction.mnemonic_span,
            "bem stands in the second phase",
            help,
        );
    }
}

/// O22.
fn frc_mask(listing: &Listing, line: &Line, form: &Form, report: &mut Report) {
    if let (Some(destination), Some(shape)) = (line.instruction.destination, form.destination)
        && !shape.masks.contains(destination.mask)
    {
        report.breach(
            Code::O22,
            destination.span,
            format!("frc writes {} here", listing.mask(destination.mask)),
            format!("the documents have {}", allowed_masks(listing, shape)),
        );
    }
}

/// O5 on the mask.
fn address_mask(listing: &Listing, line: &Line, report: &mut Report) {
    if let Some(destination) = line.instruction.destination
        && destination.register.file == RegisterFile::Addr
        && destination.mask != WriteMask::X
        && listing.exists(destination.register)
    {
        report.breach(
            Code::O5,
            destination.span,
            format!("a0 has no {}", listing.mask(destination.mask)),
            "write mov a0.x",
        );
    }
}

/// O19, O20.
fn matrix(listing: &Listing, line: &Line, form: &Form, report: &mut Report) {
    let (Some(destination), Some(shape)) = (line.instruction.destination, form.destination) else {
        return;
    };
    let name = line.mnemonic();
    if !shape.masks.contains(destination.mask) {
        let rows = form.rows;
        report.breach(
            Code::O19Mask,
            destination.span,
            format!(
                "{name} has {rows} rows and is written to {}",
                listing.mask(destination.mask)
            ),
            format!(
                "write {}{}; only those components get a value",
                destination.register,
                allowed_masks(listing, shape)
            ),
        );
    }
    for (source, shape) in line.instruction.sources.iter().zip(form.sources) {
        let plain = source.swizzle == Swizzle::IDENTITY && source.modifier == SourceModifier::None;
        if shape.modifiers == ModifierRule::Matrix && !plain {
            report.breach(
                Code::O19,
                source.span,
                format!("{name} takes its matrix without swizzle and sign"),
                "change the vector instead, which may have both",
            );
        }
    }
    let is_own = |r: &&super::listing::Read| r.register == destination.register;
    if let Some(own) = listing.reads(line).iter().find(is_own) {
        report.breach(
            Code::O20,
            own.span,
            format!("{name} reads {} while it writes it", destination.register),
            "all rows are computed from the old value here; write to another register",
        );
    }
}

/// O21.
fn scalar_source(listing: &Listing, line: &Line, form: &Form, report: &mut Report) {
    for (source, shape) in line.instruction.sources.iter().zip(form.sources) {
        let is_scalar = shape.slots == Slots::Fixed(WriteMask::W);
        if is_scalar && source.swizzle.replicated().is_none() {
            let letters = listing.program.letters();
            let read = letters[source.swizzle.slot(3)];
            report.breach(
                Code::O21,
                source.span,
                format!(
                    "{} reads one component, here {}.{read}",
                    line.mnemonic(),
                    source.register
                ),
                format!(
                    "write {}.{read}, or the component that is meant",
                    source.register
                ),
            );
        }
    }
}

/// O5: `a0.x` has a value when it is used.
pub(super) fn address_is_written(listing: &Listing, report: &mut Report) {
    if listing.version != Version::Vs11 {
        return;
    }
    for line in &listing.lines {
        let relative = |s: &&Source| s.register.relative;
        if let Some(source) = line.instruction.sources.iter().find(relative) {
            let address = Register::new(RegisterFile::Addr, 0);
            if listing.hides_write(address, source.span) {
                return;
            }
            report.breach(
                Code::O5Unwritten,
                source.span,
                "a0.x is used before it is written",
                "mov a0.x, from the register that holds the number, comes first",
            );
            return;
        }
        if line.writes_file(RegisterFile::Addr) {
            return;
        }
    }
}

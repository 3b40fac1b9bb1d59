//! I1 to I5, T13, S6, S7: which component of which temporary holds a value, line by line.

use super::listing::{Line, Listing, Phase, Read};
use super::report::Report;
use crate::isa::{Opcode, RegisterFile, WriteMask};
use crate::program::Register;
use crate::rules::model::Code;

/// What is known of one `r#`.
#[derive(Clone, Copy)]
struct Temporary {
    /// Components that hold a value.
    written: WriteMask,
    /// Components that `phase` took away.
    lost_to_phase: WriteMask,
    /// Components that `texcrd` left undefined.
    lost_to_texcrd: WriteMask,
    /// Components that `texdepth` used up.
    lost_to_depth: WriteMask,
    /// Components that held a value at `phase`.
    before_phase: WriteMask,
    /// Whether a texture instruction of the second phase has written it.
    sampled_after_phase: bool,
    /// Components of which it was said that they hold nothing.
    told: WriteMask,
    /// Whether it was said that texld cannot read it.
    told_of_texld: bool,
    /// Whether it was said that texkill may not read it.
    told_of_texkill: bool,
}

impl Temporary {
    const EMPTY: Self = Self {
        written: WriteMask::NONE,
        lost_to_phase: WriteMask::NONE,
        lost_to_texcrd: WriteMask::NONE,
        lost_to_depth: WriteMask::NONE,
        before_phase: WriteMask::NONE,
        sampled_after_phase: false,
        told: WriteMask::NONE,
        told_of_texld: false,
        told_of_texkill: false,
    };

    fn write(&mut self, mask: WriteMask) {
        self.written = self.written.or(mask);
        self.lost_to_phase = self.lost_to_phase.without(mask);
        self.lost_to_texcrd = self.lost_to_texcrd.without(mask);
        self.lost_to_depth = self.lost_to_depth.without(mask);
    }

    /// `texcrd` gives the whole register new contents, of which some have no value.
    fn write_coordinates(&mut self, mask: WriteMask) {
        self.write(WriteMask::ALL);
        self.written = mask;
        self.lost_to_texcrd = WriteMask::ALL.without(mask);
    }

    fn pass_phase(&mut self) {
        let alpha = self.written.and(WriteMask::W);
        self.written = self.written.without(alpha);
        self.lost_to_phase = self.lost_to_phase.or(alpha);
        self.before_phase = self.written;
    }

    fn pass_depth(&mut self) {
        self.written = WriteMask::NONE;
        self.lost_to_depth = WriteMask::ALL;
    }
}

/// No version has more temporaries; a listing that names more breaks O1.
const TEMPORARIES: usize = 16;

pub(super) fn check(listing: &Listing, report: &mut Report) {
    let mut temporaries = [Temporary::EMPTY; TEMPORARIES];
    for group in listing.groups() {
        // Both halves of a pair read before either writes.
        for line in group {
            reads(listing, line, &mut temporaries, report);
        }
        for line in group {
            writes(line, &mut temporaries);
        }
    }
    if listing.is_pixel() {
        result_is_written(listing, &temporaries[0], report);
    }
}

fn reads(
    listing: &Listing,
    line: &Line,
    temporaries: &mut [Temporary; TEMPORARIES],
    report: &mut Report,
) {
    for read in listing.reads(line) {
        if read.register.file != RegisterFile::Temp
            || read.register.relative
            || !listing.exists(read.register)
            || listing.hides_write(read.register, read.span)
        {
            continue;
        }
        let Some(temporary) = temporaries.get_mut(read.register.index as usize) else {
            continue;
        };
        let opcode = line.instruction.opcode;
        // Of a texkill that reads what was never written I1 to I5 say more.
        let holds = read.components.without(temporary.written).is_empty();
        if opcode == Opcode::TexLd || opcode == Opcode::TexKill && holds {
            dependent_read(listing, line, read, temporary, report);
        } else {
            component_read(listing, read, temporary, report);
        }
    }
}

/// I1, I2, I3, I5. Each component is named once.
fn component_read(listing: &Listing, read: &Read, temporary: &mut Temporary, report: &mut Report) {
    let register = read.register;
    let mut missing = read
        .components
        .without(temporary.written)
        .without(temporary.told);
    if missing.is_empty() {
        return;
    }
    temporary.told = temporary.told.or(missing);
    let losses = [
        (Code::I5, temporary.lost_to_depth),
        (Code::I2, temporary.lost_to_phase),
        (Code::I3, temporary.lost_to_texcrd),
        (unwritten_code(listing), WriteMask::ALL),
    ];
    for (code, lost) in losses {
        let these = missing.and(lost);
        missing = missing.without(lost);
        if these.is_empty() {
            continue;
        }
        let name = listing.name(register, these);
        let (message, help) = match code {
            Code::I5 => (
                format!("{name} is read after texdepth has used it up"),
                "read it before, or write it again".to_string(),
            ),
            Code::I2 => (
                format!("{name} is read, but phase has lost it"),
                "write it again after phase; r, g and b outlast phase, alpha does not".to_string(),
            ),
            Code::I3 => (
                format!("{name} is read, but texcrd has left it undefined"),
                "texcrd writes .rgb, divided by w only .rg; write the rest with mov".to_string(),
            ),
            _ => unwritten(listing, register, &name, temporary),
        };
        report.breach(code, read.span, message, help);
    }
}

fn unwritten_code(listing: &Listing) -> Code {
    if listing.is_pixel() {
        Code::I1
    } else {
        Code::I1Vertex
    }
}

/// Message and help on components that nothing has written.
fn unwritten(
    listing: &Listing,
    register: Register,
    name: &str,
    temporary: &Temporary,
) -> (String, String) {
    let message = if temporary.written.is_empty() {
        format!("{name} is read, but nothing has been written to it")
    } else {
        let written = listing.name(register, temporary.written);
        format!("{name} is read, but only {written} has been written")
    };
    let help = if listing.is_pixel() {
        "write it first, or read other components with a mask or selector"
    } else {
        "it holds 0 here, as the hardware of the time had it; write it first, or leave the component out of the write mask"
    };
    (message, help.to_string())
}

/// T13.
fn dependent_read(
    listing: &Listing,
    line: &Line,
    read: &Read,
    temporary: &mut Temporary,
    report: &mut Report,
) {
    let (code, told) = match line.instruction.opcode {
        Opcode::TexKill => (Code::T13Kill, temporary.told_of_texkill),
        _ => (Code::T13, false),
    };
    if line.phase == Phase::First || temporary.told_of_texld || told {
        return; // O11 speaks of the first phase.
    }
    let name = line.mnemonic();
    let register = read.register;
    let missing = WriteMask::XYZ.without(temporary.before_phase);
    let (message, help) = if temporary.sampled_after_phase {
        (
            format!("{name} reads {register}, which was sampled in the same phase"),
            format!(
                "sample before phase what {name} reads after it: only one level of dependent reads is possible"
            ),
        )
    } else if !listing.has_phase {
        (
            format!("{name} reads {register}, but the shader has no phase before it"),
            format!("compute {register} before a phase instruction and put {name} behind it"),
        )
    } else if !missing.is_empty() {
        (
            format!(
                "{name} reads {register}, but {} was not written before phase",
                listing.name(register, missing)
            ),
            "write r, g and b before phase, for a flat texture too".to_string(),
        )
    } else {
        return;
    };
    match code {
        Code::T13Kill => temporary.told_of_texkill = true,
        _ => temporary.told_of_texld = true,
    }
    report.breach(code, read.span, message, help);
}

fn writes(line: &Line, temporaries: &mut [Temporary; TEMPORARIES]) {
    if line.instruction.opcode == Opcode::Phase && line.form.is_some() {
        // Of a second phase instruction B10 speaks.
        if line.phase == Phase::Second {
            return;
        }
        temporaries.iter_mut().for_each(Temporary::pass_phase);
        return;
    }
    let Some(destination) = line.instruction.destination else {
        return;
    };
    if destination.register.file != RegisterFile::Temp {
        return;
    }
    let Some(temporary) = temporaries.get_mut(destination.register.index as usize) else {
        return;
    };
    if line.instruction.opcode == Opcode::TexDepth {
        temporary.pass_depth();
    }
    let Some((_, mask)) = line.writes() else {
        return;
    };
    if line.is_texture() && line.phase == Phase::Second {
        temporary.sampled_after_phase = true;
    }
    if line.instruction.opcode == Opcode::TexCrd {
        temporary.write_coordinates(mask);
    } else {
        temporary.write(mask);
    }
}

/// S6, S7.
fn result_is_written(listing: &Listing, r0: &Temporary, report: &mut Report) {
    let span = listing.program.version_span;
    let result = Register::new(RegisterFile::Temp, 0);
    if listing.hides_write(result, listing.program.span.at_end()) {
        return;
    }
    let lost = r0.lost_to_phase.or(r0.lost_to_texcrd).or(r0.lost_to_depth);
    if r0.written.or(lost).is_empty() {
        if listing.misdirects() {
            return;
        }
        report.breach(
            Code::S6,
            span,
            "this shader never writes r0, the colour of the pixel",
            "the last instruction usually writes r0",
        );
        return;
    }
    let mut missing = WriteMask::ALL.without(r0.written);
    if listing.has_phase && missing.has(3) {
        missing = missing.without(WriteMask::W);
        report.breach(
            Code::S7,
            span,
            "r0.a is not written after phase, so the alpha of the pixel is undefined",
            "write it in the second phase, such as mov r0.a, c0",
        );
    }
    if !missing.is_empty() {
        report.breach(
            Code::S6Component,
            span,
            format!(
                "{} is never written, so that part of the pixel's colour is undefined",
                listing.name(result, missing)
            ),
            "write all of r0",
        );
    }
}

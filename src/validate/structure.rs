//! S2 to S14: which instructions stand where, and what a shader has to write.

use super::listing::{Listing, Phase};
use super::report::Report;
use crate::isa::register::OPOS;
use crate::isa::{Opcode, RegisterFile, Version, WriteMask};
use crate::program::{Destination, Register, Statement};
use crate::rules::model::Code;
use std::collections::HashSet;

pub(super) fn check(listing: &Listing, report: &mut Report) {
    instructions_exist(listing, report);
    version_is_offered(listing, report);
    definitions_come_first(listing, report);
    textures_come_first(listing, report);
    if !listing.is_pixel() {
        position_is_written(listing, report);
        coordinates_have_no_gaps(listing, report);
        inputs_are_declared(listing, report);
    }
}

/// S13 on versions that can be read.
fn version_is_offered(listing: &Listing, report: &mut Report) {
    let version = listing.version;
    let newer = match version {
        Version::Vs10 => Version::Vs11,
        Version::Ps10 => Version::Ps11,
        _ => return,
    };
    report.breach(
        Code::S13Oldest,
        listing.program.version_span,
        format!("the documents of Direct3D 9 do not offer {version}"),
        format!("write {newer}, which has all that {version} has"),
    );
}

/// S14, S5.
fn instructions_exist(listing: &Listing, report: &mut Report) {
    for declaration in listing
        .program
        .declarations()
        .filter(|_| listing.is_pixel())
    {
        report.breach(
            Code::S14,
            declaration.span,
            format!("{} has no dcl", listing.version),
            format!("{} have it", Opcode::Dcl.versions()),
        );
    }
    for line in listing.lines.iter().filter(|l| l.form.is_none()) {
        let opcode = line.instruction.opcode;
        let code = if opcode == Opcode::Phase {
            Code::S5
        } else {
            Code::S14
        };
        let known = opcode.versions();
        let have = match known.iter().count() {
            1 => "alone has",
            _ => "have",
        };
        let help = match instead_of(opcode, listing.version) {
            Some(instead) => format!("{known} {have} it; {} has {instead}", listing.version),
            None => format!("{known} {have} it"),
        };
        report.breach(
            code,
            line.instruction.mnemonic_span,
            format!("{} has no {}", listing.version, opcode.mnemonic()),
            help,
        );
    }
}

/// The instruction that does the same in this version.
fn instead_of(opcode: Opcode, version: Version) -> Option<&'static str> {
    let instead = match opcode {
        Opcode::TexLd => Opcode::Tex,
        Opcode::Tex => Opcode::TexLd,
        Opcode::TexCrd => Opcode::TexCoord,
        Opcode::TexCoord => Opcode::TexCrd,
        Opcode::TexDepth => Opcode::TexM3x2Depth,
        Opcode::TexM3x2Depth => Opcode::TexDepth,
        Opcode::Cmp => Opcode::Cnd,
        Opcode::Slt | Opcode::Sge => Opcode::Cmp,
        Opcode::TexBem => Opcode::Bem,
        Opcode::Bem => Opcode::TexBem,
        _ => return None,
    };
    instead.form(version).map(|_| instead.mnemonic())
}

/// S2. Of definitions and declarations that stand together the first is named.
fn definitions_come_first(listing: &Listing, report: &mut Report) {
    let mut instruction = None;
    let mut told = false;
    for statement in &listing.program.statements {
        let (what, register, span) = match statement {
            Statement::Instruction(i) => {
                instruction = instruction.or(Some(i.opcode.mnemonic()));
                told = false;
                continue;
            }
            Statement::Def(def) => ("definition", def.register, def.span),
            // Of one in a pixel shader S14 speaks.
            Statement::Dcl(_) if listing.is_pixel() => continue,
            Statement::Dcl(dcl) => ("declaration", dcl.register, dcl.span),
        };
        if let (Some(first), false) = (instruction, told) {
            report.breach(
                Code::S2,
                span,
                format!("the {what} of {register} stands behind the first instruction, {first}"),
                "move it up, right behind the version",
            );
            told = true;
        }
    }
}

/// S3, S4. Of texture instructions that stand together the first is named.
fn textures_come_first(listing: &Listing, report: &mut Report) {
    let mut arithmetic = None;
    let mut told = false;
    for line in &listing.lines {
        if line.instruction.opcode == Opcode::Phase {
            (arithmetic, told) = (None, false);
        } else if line.is_arithmetic() {
            arithmetic = arithmetic.or(Some(line.mnemonic()));
            told = false;
        } else if line.instruction.co_issue {
            // C7 speaks of a texture instruction behind a +.
        } else if let (true, Some(first), false) = (line.is_texture(), arithmetic, told) {
            told = true;
            let (code, help) = match (listing.version, listing.has_phase, line.phase) {
                (Version::Ps14, false, _) => (Code::S4, "move it up, or put phase before it"),
                (Version::Ps14, true, Phase::First) => {
                    (Code::S4, "move it up, or down behind phase")
                }
                (Version::Ps14, true, Phase::Second) => (Code::S4, "move it up to phase"),
                _ => (
                    Code::S3,
                    "move it up; of the pixel shaders only ps.1.4 reads textures again, after phase",
                ),
            };
            report.breach(
                code,
                line.instruction.mnemonic_span,
                format!("{} stands behind the arithmetic {first}", line.mnemonic()),
                help,
            );
        }
    }
}

/// Destinations in a file, with the components that get a value.
fn writes_to<'a>(
    listing: &'a Listing,
    file: RegisterFile,
) -> impl Iterator<Item = (Destination, WriteMask)> + 'a {
    listing.lines.iter().filter_map(move |line| {
        let (register, mask) = line.writes()?;
        let destination = line.instruction.destination?;
        (register.file == file).then_some((destination, mask))
    })
}

/// S8, S9.
fn position_is_written(listing: &Listing, report: &mut Report) {
    let mut written = WriteMask::NONE;
    let mut last = None;
    for (destination, mask) in writes_to(listing, RegisterFile::RastOut) {
        if destination.register.index == OPOS {
            written = written.or(mask);
            last = Some(destination);
        }
    }
    let position = Register::new(RegisterFile::RastOut, OPOS);
    if listing.hides_write(position, listing.program.span.at_end()) {
        return;
    }
    let Some(last) = last else {
        if listing.misdirects() {
            return;
        }
        report.breach(
            Code::S8,
            listing.program.version_span,
            "this shader never writes oPos, the position of the vertex",
            "such as: m4x4 oPos, v0, c0",
        );
        return;
    };
    let missing = WriteMask::ALL.without(written);
    if !missing.is_empty() {
        report.breach(
            Code::S9,
            last.span,
            format!("oPos{} is never written", listing.mask(missing)),
            "a component that is not written is 0 here",
        );
    }
}

/// S11. Each input is named once.
fn inputs_are_declared(listing: &Listing, report: &mut Report) {
    let declarations = listing.program.declarations();
    let mut known: HashSet<Register> = declarations.map(|d| d.register).collect();
    // Without any, all may be declared beside the shader.
    let code = match known.is_empty() {
        true => Code::S11,
        false => Code::S11Partly,
    };
    if !report.has(code) {
        return;
    }
    for read in listing.lines.iter().flat_map(|line| listing.reads(line)) {
        let register = read.register;
        let is_input = register.file == RegisterFile::Input && listing.exists(register);
        if is_input
            && !register.relative
            && known.insert(register)
            && !listing.hides_write(register, listing.program.span.at_end())
        {
            report.breach(
                code,
                read.span,
                format!("{register} is read, but no dcl_ says what comes in there"),
                format!(
                    "write such as dcl_position {register} behind the version; for Direct3D 8 an array of D3DVSD_ tokens beside the shader says it"
                ),
            );
        }
    }
}

/// S10.
fn coordinates_have_no_gaps(listing: &Listing, report: &mut Report) {
    let file = RegisterFile::TexCrdOut;
    let mut sets: Vec<(Option<Destination>, WriteMask)> = Vec::new();
    sets.resize_with(file.count(listing.version) as usize, || {
        (None, WriteMask::NONE)
    });
    for (destination, mask) in writes_to(listing, file) {
        if let Some(set) = sets.get_mut(destination.register.index as usize) {
            *set = (set.0.or(Some(destination)), set.1.or(mask));
        }
    }
    let mut gap = None;
    for (i, (first, mask)) in sets.into_iter().enumerate() {
        let Some(first) = first else {
            let register = Register::new(file, i as u32);
            if !listing.hides_write(register, listing.program.span.at_end()) {
                gap = gap.or(Some(i));
            }
            continue;
        };
        if let Some(gap) = gap {
            report.breach(
                Code::S10,
                first.span,
                format!("oT{i} is written, oT{gap} before it is not"),
                format!("write oT{gap} too, or use the lower number"),
            );
            return;
        }
        // A prefix of xyzw is one less than a power of two.
        if !(mask.bits() + 1).is_power_of_two() {
            report.breach(
                Code::S10,
                first.span,
                format!("of oT{i} only {} is written", listing.mask(mask)),
                "write .x, .xy, .xyz or all four components",
            );
        }
    }
}

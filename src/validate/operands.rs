//! O1 to O26: which registers an operand may name.

use super::listing::{Line, Listing, Phase};
use super::modifiers::allowed_masks;
use super::report::Report;
use crate::diagnostic::Span;
use crate::isa::enumerate;
use crate::isa::opcode::{ModifierRule, Slots};
use crate::isa::register::{Access, OFOG, OPTS, VERTEX_CONSTANTS};
use crate::isa::{
    Class, Form, Opcode, RegisterFile, SourceModifier, Swizzle, Version, VersionSet, WriteMask,
};
use crate::program::{Destination, Register, Source, Statement};
use crate::rules::model::Code;

/// How many constants software vertex processing has; there is no storage beyond.
const MOST_VERTEX_CONSTANTS: u32 = 256;

pub(super) fn check(listing: &Listing, report: &mut Report) {
    if listing.has_texture_stages() {
        // Of what goes beyond the number of stages B2 speaks.
        let slots = listing.version.row().texture_slots as usize;
        let beyond = listing.lines.iter().filter(|l| l.is_texture()).skip(slots);
        for destination in beyond.filter_map(|l| l.instruction.destination) {
            report.misses(destination.register);
        }
    }
    first_bem(listing, report);
    for def in listing.program.definitions() {
        let register = def.register;
        if register.file != RegisterFile::Const || register.relative {
            report.breach(
                Code::O25,
                def.register_span,
                format!("def names {register}, which is no constant"),
                "def sets a constant, such as c0",
            );
        } else {
            register_exists(listing, register, def.register_span, Code::O25, report);
        }
    }
    for declaration in listing.program.declarations() {
        let (register, span) = (declaration.register, declaration.span);
        if register.file != RegisterFile::Input {
            report.breach(
                Code::O1,
                span,
                format!("{} has no input {register}", listing.version),
                "dcl declares v#",
            );
        } else {
            register_exists(listing, register, span, Code::O1, report);
        }
    }
    for (line, form) in listing.known() {
        if let Some(destination) = line.instruction.destination {
            check_destination(listing, line, form, destination, report);
        }
        for (i, source) in line.instruction.sources.iter().enumerate() {
            check_source(listing, line, form, i, source, report);
        }
        instruction(listing, line, form, report);
    }
    address_is_written(listing, report);
}

/// O1 and, of `def`, O25 on what no assembler of the version takes, wherever it stands. It took a `def` of any constant.
pub(super) fn can_be_named(listing: &Listing, report: &mut Report) {
    let mut judge = |register: Register, span: Span, code: Code| {
        let Register { file, index, .. } = register;
        if !file.can_be_named(index, listing.version) {
            register_exists(listing, register, span, code, report);
        }
    };
    for statement in &listing.program.statements {
        match statement {
            Statement::Def(def) if def.register.file == RegisterFile::Const => {}
            Statement::Def(def) => judge(def.register, def.register_span, Code::O25),
            Statement::Dcl(dcl) => judge(dcl.register, dcl.span, Code::O1),
            Statement::Instruction(instruction) => {
                if let Some(destination) = &instruction.destination {
                    judge(destination.register, destination.span, Code::O1);
                }
                for source in &instruction.sources {
                    judge(source.register, source.span, Code::O1);
                }
            }
        }
    }
}

/// O1, O4, O26; `def` has O25. Returns whether it does exist.
fn register_exists(
    listing: &Listing,
    register: Register,
    span: Span,
    code: Code,
    report: &mut Report,
) -> bool {
    if listing.exists(register) {
        return true;
    }
    let version = listing.version;
    let count = register.file.count(version);
    if !report.misses(register) {
        return false;
    }
    if register.file == RegisterFile::Addr && register.index == 0 && version == Version::Vs10 {
        report.breach(
            Code::O4,
            span,
            "vs.1.0 has no address register",
            "vs.1.1 has it",
        );
        return false;
    }
    if register.file == RegisterFile::Const && !listing.is_pixel() {
        let code = if register.index < MOST_VERTEX_CONSTANTS {
            Code::O26
        } else {
            Code::O26Beyond
        };
        report.breach(
            code,
            span,
            format!("{register} is beyond the {VERTEX_CONSTANTS} constants that every device has"),
            format!(
                "use c0 to c{}; c{} is the last that any device has",
                VERTEX_CONSTANTS - 1,
                MOST_VERTEX_CONSTANTS - 1
            ),
        );
        return false;
    }
    let help = match count {
        0 => format!("{} has {}", version, files_of(version)),
        1 => format!("{version} has {}", register.file.register_name(0)),
        _ => format!(
            "{version} has {} to {}",
            register.file.register_name(0),
            register.file.register_name(count - 1)
        ),
    };
    report.breach(code, span, format!("{version} has no {register}"), help);
    false
}

/// The register files of a version, for people.
fn files_of(version: Version) -> String {
    let names: Vec<String> = RegisterFile::all()
        .filter(|f| f.count(version) > 0)
        .map(RegisterFile::any_name)
        .collect();
    enumerate(&names, "and")
}

fn check_destination(
    listing: &Listing,
    line: &Line,
    form: &Form,
    destination: Destination,
    report: &mut Report,
) {
    let Some(shape) = form.destination else {
        return;
    };
    let (register, span) = (destination.register, destination.span);
    if register.relative {
        report.breach(
            Code::O6,
            span,
            format!("{register} is a destination; only sources are relative to a0.x"),
            "write to a register by its number",
        );
        return;
    }
    let opcode = line.instruction.opcode;
    // Of an a0 that no version could have here O5 tells more than O4, and of a constant O2 more than O26.
    let misplaced = match register.file {
        RegisterFile::Addr => opcode != Opcode::Mov,
        RegisterFile::Const => true,
        _ => false,
    };
    if !misplaced && !register_exists(listing, register, span, Code::O1, report) {
        return;
    }
    if shape.files.contains(register.file) {
        let early = listing.version == Version::Ps14 && line.phase == Phase::First;
        if early && opcode == Opcode::TexKill {
            first_phase_register(line, register, span, report);
        }
        if is_one_number(register) && destination.mask != WriteMask::ALL {
            report.breach(
                Code::O24Number,
                span,
                format!("{register} is one number and takes no mask"),
                format!("write {register}"),
            );
        }
        return;
    }
    let code = match (form.class, register.file) {
        (Class::Texture, _) => texture_operand(opcode, listing.version),
        (_, RegisterFile::Addr) => Code::O5,
        (_, RegisterFile::Texture) => Code::O8Written,
        _ => Code::O2,
    };
    let files: Vec<String> = shape
        .files
        .iter()
        .filter(|f| f.count(listing.version) > 0)
        .map(RegisterFile::any_name)
        .collect();
    let files = enumerate(&files, "or");
    let (message, help) = match code {
        Code::O5 => (
            format!("{} cannot write a0", line.mnemonic()),
            "compute in r# and mov a0.x, r#.x".to_string(),
        ),
        Code::O2 => (
            format!("{register} cannot be written: {}", only_read(register.file)),
            format!("write to {files}"),
        ),
        _ => (
            format!("{} does not take {register} here", line.mnemonic()),
            format!("it takes {files}"),
        ),
    };
    report.breach(code, span, message, help);
}

/// Whether a register is `oFog` or `oPts`.
pub(super) fn is_one_number(register: Register) -> bool {
    register.file == RegisterFile::RastOut && matches!(register.index, OFOG | OPTS)
}

fn only_read(file: RegisterFile) -> &'static str {
    match file {
        RegisterFile::Const => "constants are set by def or from outside",
        RegisterFile::Input => "inputs come from the stage before",
        _ => "it is only read",
    }
}

/// The rule on the registers of a texture instruction.
fn texture_operand(opcode: Opcode, version: Version) -> Code {
    match opcode {
        Opcode::TexCrd => Code::O12,
        Opcode::TexDepth => Code::O14Register,
        _ if version == Version::Ps14 => Code::O11,
        _ => Code::O10,
    }
}

fn check_source(
    listing: &Listing,
    line: &Line,
    form: &Form,
    i: usize,
    source: &Source,
    report: &mut Report,
) {
    let (register, span) = (source.register, source.span);
    let Some(shape) = form.sources.get(i) else {
        return;
    };
    if register.relative && !relative_source(listing, source, report) {
        return;
    }
    let opcode = line.instruction.opcode;
    let mut last = register;
    if shape.modifiers == ModifierRule::Matrix {
        last.index = last.index.saturating_add(form.rows.saturating_sub(1));
    }
    // Of an a0 that no version could have here O3 tells more than O4.
    if register.file != RegisterFile::Addr
        && !register_exists(listing, last, span, Code::O1, report)
    {
        return;
    }
    // Of a register that cannot be read at all O3 tells more than O15, which a dialect may take.
    if is_condition_of_cnd(listing.version, line, i) && register.file != RegisterFile::Addr {
        return; // O15 says what stands there.
    }
    if !shape.files.contains(register.file) {
        let (code, help) = wrong_source(listing, form, opcode, register.file);
        if code == Code::O9 && line.phase == Phase::Second {
            return; // A bem in the second phase; O18 says so.
        }
        if code == Code::O8 && listing.written_coordinates.contains(&register) {
            return; // What should have written it is at fault.
        }
        let message = match code {
            Code::O3 => format!("{register} can be written, not read"),
            Code::O9 => format!("{register} is read before phase"),
            _ => format!("{} does not read {register} here", line.mnemonic()),
        };
        report.breach(code, span, message, help);
        return;
    }
    if listing.version == Version::Ps14 && line.phase == Phase::First {
        first_phase_register(line, register, span, report);
    }
}

/// O4, O6. Returns whether relative addressing is in place.
fn relative_source(listing: &Listing, source: &Source, report: &mut Report) -> bool {
    let (code, message, help) = if source.register.file != RegisterFile::Const || listing.is_pixel()
    {
        (
            Code::O6,
            format!("{} cannot be relative to a0.x", source.register),
            "only c# of vertex shaders is, as c[a0.x + 4]",
        )
    } else if listing.version == Version::Vs10 {
        (
            Code::O4,
            "vs.1.0 has no relative addressing".to_string(),
            "vs.1.1 has it",
        )
    } else {
        return true;
    };
    let address = Register::new(RegisterFile::Addr, 0);
    if code != Code::O4 || report.misses(address) {
        report.breach(code, source.span, message, help);
    }
    false
}

/// The rule that a source of the wrong file breaks, and what stands there instead.
fn wrong_source(
    listing: &Listing,
    form: &Form,
    opcode: Opcode,
    file: RegisterFile,
) -> (Code, &'static str) {
    if file.access(listing.version) == Access::Write {
        let help = match file {
            RegisterFile::Addr => "a0.x is only used within c[a0.x + …]",
            _ => "compute in r# and mov the result to the output",
        };
        return (Code::O3, help);
    }
    if form.class == Class::Texture {
        return match (opcode, file) {
            (Opcode::TexM3x3Spec, _) => (Code::O10, "it takes t#, t# and c#, such as t3, t0, c0"),
            (_, RegisterFile::Const) => (
                Code::O13,
                "only texm3x3spec reads one; mov it to a register with arithmetic",
            ),
            (Opcode::TexCrd, _) => (Code::O12, "it reads t#"),
            (Opcode::TexLd, _) => (Code::O11, "it reads t#, after phase also r#"),
            _ => (Code::O10, "it reads t#"),
        };
    }
    match file {
        RegisterFile::Texture => (Code::O8, "bring it into r# with texld or texcrd first"),
        // Of arithmetic only bem does not read v#, for it stands before phase.
        _ => (Code::O9, "v# is read after phase"),
    }
}

/// O9, O11: what is there only after `phase`.
fn first_phase_register(line: &Line, register: Register, span: Span, report: &mut Report) {
    match register.file {
        RegisterFile::Input => report.breach(
            Code::O9,
            span,
            format!("{register} is read before phase"),
            "colours are read after phase; coordinates come in at any time, by texcrd from t#",
        ),
        RegisterFile::Temp
            if matches!(line.instruction.opcode, Opcode::TexLd | Opcode::TexKill) =>
        {
            let name = line.mnemonic();
            report.breach(
                Code::O11Phase,
                span,
                format!("{name} reads {register} before phase"),
                format!(
                    "before phase {name} reads t#; move it behind phase to read what was computed"
                ),
            );
        }
        _ => {}
    }
}

/// Rules on one instruction as a whole.
fn instruction(listing: &Listing, line: &Line, form: &Form, report: &mut Report) {
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
fn first_bem(listing: &Listing, report: &mut Report) {
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
fn address_is_written(listing: &Listing, report: &mut Report) {
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

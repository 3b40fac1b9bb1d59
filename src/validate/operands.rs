//! O1 to O26: which registers an operand may name.

use super::instruction::{self, is_condition_of_cnd};
use super::listing::{Line, Listing, Phase};
use super::report::Report;
use crate::diagnostic::Span;
use crate::isa::enumerate;
use crate::isa::opcode::ModifierRule;
use crate::isa::register::{Access, OFOG, OPTS, VERTEX_CONSTANTS};
use crate::isa::{Class, Form, Opcode, RegisterFile, Version, WriteMask};
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
    instruction::first_bem(listing, report);
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
        instruction::check(listing, line, form, report);
    }
    instruction::address_is_written(listing, report);
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
            let code = match line.instruction.opcode {
                Opcode::TexKill => Code::O11Kill,
                _ => Code::O11Phase,
            };
            report.breach(
                code,
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

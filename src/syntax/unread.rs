//! Lines that are gone without a trace: what they would have read is loaded and never read.

use super::rules;
use super::{Damage, Parsed, names};
use crate::diagnostic::{Diagnostic, SourceFile, Span};
use crate::isa::{Class, Opcode, RegisterFile, ShaderKind, Version, WriteMask};
use crate::program::{Instruction, Register};

/// What a texture instruction has loaded and nothing has read yet.
struct Load {
    register: Register,
    /// Components that have not been overwritten.
    left: WriteMask,
    span: Span,
}

/// Warns of texture results in a pixel shader that are overwritten, or left behind, without having been read.
///
/// Statements that could not be read take part with the registers that they name: the first one is written, the others
/// are read.
pub fn unread(file: &SourceFile, parsed: &Parsed) -> Vec<Diagnostic> {
    let Some(program) = &parsed.program else {
        return Vec::new();
    };
    if program.version.kind() != ShaderKind::Pixel {
        return Vec::new();
    }
    let base = file.span().start;
    let text_of = |span: Span| {
        let range =
            span.start.saturating_sub(base) as usize..span.end.saturating_sub(base) as usize;
        String::from_utf8_lossy(file.bytes().get(range).unwrap_or(&[])).into_owned()
    };
    let mut walk = Walk {
        version: program.version,
        loads: Vec::new(),
        lost: Vec::new(),
    };
    let instructions: Vec<&Instruction> = program.instructions().collect();
    let mut damaged = parsed.damaged.iter().peekable();
    // What stands where a register should may have been one of those that were loaded.
    let misread = |d: &&Diagnostic| {
        d.rule.id == rules::REGISTER.id && d.severity == crate::diagnostic::Severity::Error
    };
    let mut misread = parsed.diagnostics.iter().filter(misread).peekable();
    let mut i = 0;
    while i < instructions.len() {
        while let Some(damage) = damaged.next_if(|d| d.span.start < instructions[i].span.start) {
            walk.damage(damage, &text_of(damage.span));
        }
        let paired = instructions.get(i + 1).is_some_and(|next| next.co_issue);
        let group = &instructions[i..i + 1 + usize::from(paired)];
        group.iter().for_each(|instruction| walk.reads(instruction));
        let end = group.last().map_or(0, |last| last.span.end);
        while let Some(word) = misread.next_if(|d| d.span.start < end) {
            walk.misread(&text_of(word.span));
        }
        group
            .iter()
            .for_each(|instruction| walk.writes(instruction));
        i += group.len();
    }
    for damage in damaged {
        walk.damage(damage, &text_of(damage.span));
    }
    for word in misread {
        walk.misread(&text_of(word.span));
    }
    walk.finish()
}

struct Walk {
    version: Version,
    loads: Vec<Load>,
    lost: Vec<(Register, Span)>,
}

impl Walk {
    fn reads(&mut self, instruction: &Instruction) {
        for source in &instruction.sources {
            self.read(source.register);
        }
        // texkill and texdepth look at their destination.
        if let Some(destination) = instruction.destination
            && matches!(instruction.opcode, Opcode::TexKill | Opcode::TexDepth)
        {
            self.read(destination.register);
        }
    }

    fn read(&mut self, register: Register) {
        self.loads.retain(|load| load.register != register);
    }

    fn writes(&mut self, instruction: &Instruction) {
        let form = instruction.opcode.form(self.version);
        let (Some(destination), Some(form)) = (instruction.destination, form) else {
            return;
        };
        let Some(shape) = form.destination else {
            return;
        };
        let register = destination.register;
        let exists = register.index < register.file.count(self.version);
        if !shape.written || !shape.files.contains(register.file) || !exists {
            return;
        }
        self.write(destination.register, destination.mask);
        // Pads and depths leave nothing in their register that could be read.
        let leaves_nothing = matches!(
            instruction.opcode,
            Opcode::TexM3x2Pad | Opcode::TexM3x3Pad | Opcode::TexM3x2Depth
        );
        let loads = form.class == Class::Texture && !leaves_nothing;
        if loads {
            self.loads.push(Load {
                register: destination.register,
                left: destination.mask,
                span: destination.span,
            });
        }
    }

    fn write(&mut self, register: Register, mask: WriteMask) {
        for load in &mut self.loads {
            if load.register == register {
                load.left = load.left.without(mask);
                if load.left.is_empty() {
                    self.lost.push((register, load.span));
                }
            }
        }
        self.loads.retain(|load| !load.left.is_empty());
    }

    fn damage(&mut self, damage: &Damage, text: &str) {
        let words = text.split(|c: char| !c.is_ascii_alphanumeric());
        let named: Vec<Register> = words.filter_map(register).collect();
        if named.is_empty() {
            // It may read anything.
            self.loads.clear();
        }
        let written = damage
            .destination
            .filter(|first| named.first() == Some(first));
        for register in &named[usize::from(written.is_some()).min(named.len())..] {
            self.read(*register);
        }
        if let Some(register) = written {
            self.write(register, WriteMask::ALL);
        }
    }

    /// A word that names no register: it may have read those of the same number, or any if it has none.
    fn misread(&mut self, word: &str) {
        let digits = word.get(1..).unwrap_or("");
        let numbers = names::whole_numbers(digits);
        let numbers: Vec<u32> = numbers.iter().filter_map(|n| n.parse().ok()).collect();
        self.loads
            .retain(|load| !numbers.is_empty() && !numbers.contains(&load.register.index));
    }

    fn finish(mut self) -> Vec<Diagnostic> {
        // r0 is what the shader returns.
        let result = Register::new(RegisterFile::Temp, 0);
        let left = self.loads.iter().filter(|load| load.register != result);
        self.lost
            .extend(left.map(|load| (load.register, load.span)));
        self.lost.sort_by_key(|(_, span)| *span);
        let warn = |(register, span): &(Register, Span)| {
            let message = format!("{register} is loaded here and never read");
            Diagnostic::warning(&rules::UNREAD, *span, message).with_help(
                "instructions that read it may have been lost; if none is missing, this one can go",
            )
        };
        self.lost.iter().map(warn).collect()
    }
}

/// `r#` and `t#` as a damaged statement names them.
fn register(word: &str) -> Option<Register> {
    let number = word.get(1..)?.parse().ok()?;
    let file = match word.as_bytes().first()? {
        b'r' | b'R' => RegisterFile::Temp,
        b't' | b'T' => RegisterFile::Texture,
        _ => return None,
    };
    Some(Register::new(file, number))
}

//! Programs to tokens.

use super::fields::{self, Fault};
use super::{COMMENT, END, MOST_ITEMS, MOST_TOKENS};
use super::{report, rules};
use crate::diagnostic::{Diagnostic, Span};
use crate::isa::{Opcode, ResultModifier, ShaderKind, SourceModifier, Version, WriteMask};
use crate::program::{
    Comment, Dcl, Def, Destination, Instruction, Item, Program, Register, Source, Statement,
};

/// Bit 30 of an instruction token: it runs together with the instruction before it.
pub(super) const CO_ISSUE: u32 = 1 << 30;

/// An opcode with a destination and two sources: what most statements are.
const WORDS_A_STATEMENT: usize = 4;

/// The tokens of a shader, from its version to its end.
///
/// What is allowed is not asked; a shader is refused only for what has no token. `sub` of a vertex shader becomes an `add`
/// whose second source is negated, as the assembler of Direct3D wrote it. A `def` of a vertex shader becomes a token, as
/// in Direct3D 9; Direct3D 8 gave it back as a piece of a vertex declaration.
///
/// # Errors
/// Everything that has no token, with the spans of the program.
pub fn encode(program: &Program) -> Result<Vec<u32>, Vec<Diagnostic>> {
    let mut encoder = Encoder {
        version: program.version,
        words: Vec::with_capacity(2 + WORDS_A_STATEMENT * program.statements.len()),
        faults: Vec::new(),
    };
    encoder.words.push(program.version.token());
    for item in program.items() {
        match item {
            Item::Statement(Statement::Instruction(i)) => encoder.instruction(i),
            Item::Statement(Statement::Def(d)) => encoder.definition(d),
            Item::Statement(Statement::Dcl(d)) => encoder.declaration(d),
            Item::Comment(c) => encoder.comment(c),
        }
        if encoder.faults.len() >= report::MOST {
            break;
        }
    }
    encoder.words.push(END);
    let items = program.statements.len() + program.comments.len();
    if items > MOST_ITEMS || encoder.words.len() > MOST_TOKENS {
        let message = "this shader is longer than a stream of tokens may be";
        let fault = Diagnostic::error(&rules::LONG, program.version_span, message);
        encoder.faults.push(fault);
    }
    match encoder.faults.is_empty() {
        true => Ok(encoder.words),
        false => Err(encoder.faults),
    }
}

struct Encoder {
    version: Version,
    words: Vec<u32>,
    faults: Vec<Diagnostic>,
}

impl Encoder {
    fn kind(&self) -> ShaderKind {
        self.version.kind()
    }

    /// Adds a token, or what is said instead of it.
    fn push(&mut self, token: Result<u32, Fault>, span: Span) {
        match token {
            Ok(token) => self.words.push(token),
            Err(fault) => self.fault(span, fault.message, fault.help),
        }
    }

    fn fault(&mut self, span: Span, message: String, help: &str) {
        let report = Diagnostic::error(&rules::NO_TOKEN, span, message);
        self.faults.push(match help {
            "" => report,
            _ => report.with_help(help),
        });
    }

    /// The token of an opcode.
    fn opcode(&mut self, opcode: Opcode, co_issue: bool, span: Span) {
        let token = opcode.row().token;
        // An opcode of the version has its number to itself.
        let own = opcode.form(self.version).is_some();
        let meant = match own {
            true => Some(opcode),
            false => Opcode::meant_by(token, self.version),
        };
        if meant != Some(opcode) {
            let message = format!("`{}` has no token in {}", opcode.mnemonic(), self.version);
            let help = meant.map(|other| {
                format!(
                    "its number, 0x{token:02X}, is that of `{}` there",
                    other.mnemonic()
                )
            });
            return self.fault(span, message, help.as_deref().unwrap_or(""));
        }
        let co_issue = if co_issue { CO_ISSUE } else { 0 };
        self.words.push(u32::from(token) | co_issue);
    }

    fn instruction(&mut self, i: &Instruction) {
        let kind = self.kind();
        let subtracts = i.opcode == Opcode::Sub && kind == ShaderKind::Vertex;
        let opcode = if subtracts { Opcode::Add } else { i.opcode };
        self.opcode(opcode, i.co_issue, i.mnemonic_span);
        let form = opcode.row().forms.first();
        let destination = form.is_some_and(|f| f.destination.is_some());
        let sources = form.map_or(0, |f| f.sources.len());
        let declares = matches!(opcode, Opcode::Def | Opcode::Dcl);
        if declares || i.destination.is_some() != destination || i.sources.len() != sources {
            let message = format!("`{}` with these operands has no token", opcode.mnemonic());
            return self.fault(i.span, message, "");
        }
        match &i.destination {
            Some(d) => self.push(fields::destination_bits(d, i.result, kind), d.span),
            None if i.result != ResultModifier::NONE => {
                let fault = fields::no_result(i.result, kind);
                self.fault(i.mnemonic_span, fault.message, fault.help);
            }
            None => {}
        }
        for (at, source) in i.sources.iter().enumerate() {
            let mut source = *source;
            if subtracts && at == 1 {
                source.modifier = match source.modifier {
                    SourceModifier::None => SourceModifier::Negate,
                    SourceModifier::Negate => SourceModifier::None,
                    // No modifier of a vertex shader; refused as one.
                    other => other,
                };
            }
            self.push(fields::source_bits(&source, kind), source.span);
        }
    }

    /// The destination of a `def` or a `dcl`.
    fn declared(&mut self, register: Register, mask: WriteMask, span: Span) {
        let destination = Destination {
            register,
            mask,
            span,
        };
        let token = fields::destination_bits(&destination, ResultModifier::NONE, self.kind());
        self.push(token, span);
    }

    fn definition(&mut self, def: &Def) {
        self.opcode(Opcode::Def, def.co_issue, def.span);
        self.declared(def.register, WriteMask::ALL, def.register_span);
        self.words.extend(def.value.map(f32::to_bits));
    }

    fn declaration(&mut self, dcl: &Dcl) {
        self.opcode(Opcode::Dcl, false, dcl.span);
        self.words.push(fields::usage_bits(dcl));
        self.declared(dcl.register, dcl.mask, dcl.span);
    }

    fn comment(&mut self, comment: &Comment) {
        let length = comment.words.len();
        if length > Comment::MOST_WORDS {
            let most = Comment::MOST_WORDS;
            let message = format!("a comment of {length} tokens has no token: at most {most} fit");
            return self.fault(comment.span, message, "write it as several");
        }
        self.words.push(COMMENT | (length as u32) << 16);
        self.words.extend(&comment.words);
    }
}

/// The source with these parts, its span in tokens.
pub(super) fn source_at(
    (register, swizzle, modifier): (Register, crate::isa::Swizzle, SourceModifier),
    at: usize,
) -> Source {
    Source {
        register,
        swizzle,
        modifier,
        span: report::tokens(at, at + 1),
    }
}

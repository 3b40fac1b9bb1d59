//! Tokens to programs.

use super::encode::{CO_ISSUE, source_at};
use super::fields::{self, Fault};
use super::report::{Reports, tokens};
use super::rules;
use super::{COMMENT, END, MOST_ITEMS, MOST_TOKENS, OPERAND};
use crate::diagnostic::Diagnostic;
use crate::isa::{Opcode, ResultModifier, ShaderKind, Version, WriteMask};
use crate::program::{Comment, Dcl, Def, Destination, Instruction, Program, Statement};
use crate::rules::model;

/// Bits 29:16 of an instruction token: controls, length and predication of later shader models.
const LATER: u32 = 0x3FFF_0000;

/// What was read from a stream.
#[derive(Clone, Debug)]
pub struct Decoded {
    /// The shader without what could not be read; `None` if its version is not known. Its spans count tokens: that of an
    /// operand is its one token, that of a statement all its tokens.
    pub program: Option<Program>,
    /// What is wrong with the stream, at most 101. Their spans count tokens, too.
    pub diagnostics: Vec<Diagnostic>,
    /// How many tokens were read, the end token included.
    pub length: usize,
}

/// Reads a stream from its version to its end.
///
/// Never fails, and never takes more memory than a small multiple of what is read. Everything that is wrong is told at
/// once: behind a damaged instruction reading goes on with the next token whose bit 31 is clear.
pub fn decode(words: &[u32]) -> Decoded {
    let mut reports = Reports::default();
    let first = words.first().copied();
    let Some(version) = first.and_then(Version::from_token) else {
        no_version(words, &mut reports);
        return Decoded {
            program: None,
            diagnostics: reports.finish(),
            length: 0,
        };
    };
    let mut decoder = Decoder {
        words: words.get(..MOST_TOKENS).unwrap_or(words),
        whole: words.len(),
        version,
        kind: version.kind(),
        at: 1,
        reports,
        statements: Vec::new(),
        comments: Vec::new(),
    };
    decoder.run();
    let length = decoder.at;
    Decoded {
        program: Some(Program {
            version,
            version_span: tokens(0, 1),
            statements: decoder.statements,
            comments: decoder.comments,
            span: tokens(0, length),
        }),
        diagnostics: decoder.reports.finish(),
        length,
    }
}

/// Says what the first token is that is no version of Direct3D 8.
fn no_version(words: &[u32], reports: &mut Reports) {
    let Some(&word) = words.first() else {
        return reports.error(&model::S13, 0, "the stream is empty", "");
    };
    let message = format!("0x{word:08X} is no version");
    let swapped = Version::from_token(word.swap_bytes());
    let help = match (word >> 16, word >> 8 & 0xFF) {
        _ if swapped.is_some() => {
            "the bytes of each token stand in the wrong order: the lowest comes first"
        }
        (0xFFFE | 0xFFFF, 2..=3) => "it is that of a later shader model",
        (0xFFFE | 0xFFFF, 1) => {
            "vertex shaders have the versions 1.0 and 1.1, pixel shaders 1.0 to 1.4"
        }
        (0xFEFF, _) => "it begins a compiled effect, in which shaders are embedded",
        _ if word == u32::from_le_bytes(*b"DXBC") => "it begins a shader of Direct3D 10 or later",
        _ => "a stream begins with 0xFFFE0100 or 0xFFFE0101, or with 0xFFFF0100 to 0xFFFF0104",
    };
    reports.error(&model::S13, 0, &message, help);
}

struct Decoder<'a> {
    words: &'a [u32],
    /// How many words there are, those that are too many included.
    whole: usize,
    version: Version,
    kind: ShaderKind,
    at: usize,
    reports: Reports,
    statements: Vec<Statement>,
    comments: Vec<Comment>,
}

/// Why an instruction is not read.
enum Stop {
    /// It is damaged; what is wrong was told, and reading goes on.
    Damaged,
    /// The stream ends in it.
    Ends,
}

impl Decoder<'_> {
    fn run(&mut self) {
        while !self.reports.full() {
            let Some(&word) = self.words.get(self.at) else {
                return self.cut(self.at, "the stream ends without the end token");
            };
            if word == END {
                self.at += 1;
                return self.behind();
            }
            if self.statements.len() + self.comments.len() == MOST_ITEMS {
                let message = format!("more than {MOST_ITEMS} instructions and comments");
                return self.reports.error(&rules::LONG, self.at, &message, "");
            }
            let read = match word & (OPERAND | 0xFFFF) {
                COMMENT => self.comment(word),
                _ if word & OPERAND != 0 => self.stray(word),
                _ => self.instruction(word),
            };
            match read {
                Ok(()) => {}
                // No token is read twice, so this ends.
                Err(Stop::Damaged) => self.skip_operands(),
                Err(Stop::Ends) => return,
            }
        }
    }

    /// Says that nothing follows token `at` - 1 where something should.
    fn cut(&mut self, at: usize, message: &str) {
        if self.whole > self.words.len() {
            let message = format!("more than {MOST_TOKENS} tokens");
            self.reports.error(&rules::LONG, at, &message, "");
        } else {
            let help = "the end is lost: 0x0000FFFF closes a shader";
            self.reports.error(&model::S12, at, message, help);
        }
    }

    /// Tokens behind the end.
    fn behind(&mut self) {
        let rest = self.whole - self.at;
        if rest > 0 {
            let message = format!(
                "{rest} behind the end token, which are not read",
                rest = counted(rest, "token")
            );
            let at = self.at;
            self.reports.warning(&rules::BEHIND, at, &message, "");
        }
    }

    fn skip_operands(&mut self) {
        while self.words.get(self.at).is_some_and(|w| w & OPERAND != 0) {
            self.at += 1;
        }
    }

    fn stray(&mut self, word: u32) -> Result<(), Stop> {
        let message = format!(
            "0x{word:08X} stands where an instruction should, but bit 31 makes it an operand"
        );
        let help = match self.statements.last() {
            Some(Statement::Instruction(i)) => format!(
                "`{}` before it has {} in {}",
                i.opcode.mnemonic(),
                counted(
                    i.sources.len() + usize::from(i.destination.is_some()),
                    "operand"
                ),
                self.version
            ),
            _ => String::new(),
        };
        self.reports.error(&rules::STRAY, self.at, &message, &help);
        Err(Stop::Damaged)
    }

    fn comment(&mut self, word: u32) -> Result<(), Stop> {
        let length = (word >> 16) as usize;
        let start = self.at;
        let Some(words) = self.words.get(start + 1..start + 1 + length) else {
            let left = self.whole - start - 1;
            let message = format!(
                "this comment has {}, but only {left} are left",
                counted(length, "token")
            );
            if self.whole > self.words.len() && left >= length {
                self.cut(start, "");
            } else {
                self.reports.error(&rules::COMMENT, start, &message, "");
            }
            return Err(Stop::Ends);
        };
        self.at += 1 + length;
        self.comments.push(Comment {
            before: self.statements.len(),
            words: words.to_vec(),
            span: tokens(start, self.at),
        });
        Ok(())
    }

    fn instruction(&mut self, word: u32) -> Result<(), Stop> {
        let start = self.at;
        let number = (word & 0xFFFF) as u16;
        self.at += 1;
        let Some(opcode) = Opcode::meant_by(number, self.version) else {
            let message = format!(
                "0x{number:04X} of 0x{word:08X} is no instruction of {}",
                self.version
            );
            let help = match number {
                0x19..=0x1E | 0x20..=0x30 | 0x5A..=0x60 => "it belongs to later shader models",
                0x4B => "this number was kept for an instruction that never came",
                0x40 | 0x42 => "it is one of pixel shaders",
                _ => "",
            };
            self.reports.error(&rules::OPCODE, start, &message, help);
            return Err(Stop::Damaged);
        };
        if word & LATER != 0 {
            let message = format!(
                "bits 29:16 of 0x{word:08X} are not clear; they are ignored, and not written again"
            );
            let help = "later shader models have the length of an instruction there";
            self.reports
                .warning(&rules::RESERVED, start, &message, help);
        }
        let co_issue = word & CO_ISSUE != 0;
        if co_issue && self.kind == ShaderKind::Vertex {
            let message =
                format!("bit 30 of 0x{word:08X} makes a pair, which a vertex shader does not have");
            self.reports.error(&rules::MODIFIER, start, &message, "");
        }
        match opcode {
            Opcode::Def => self.definition(start, co_issue),
            Opcode::Dcl => self.declaration(start, co_issue),
            _ => self.operands(start, opcode, co_issue),
        }
    }

    /// The next operand of an instruction that has `count`, as a token; `number` is which.
    fn operand(&mut self, opcode: Opcode, number: usize, count: usize) -> Result<u32, Stop> {
        let name = opcode.mnemonic();
        let Some(&word) = self.words.get(self.at) else {
            let message = format!(
                "the stream ends in `{name}`: {number} of {count} operand tokens are there"
            );
            self.cut(self.at, &message);
            return Err(Stop::Ends);
        };
        if word & OPERAND == 0 {
            let message = format!(
                "0x{word:08X} stands where operand {} of `{name}` should, but bit 31 is clear",
                number + 1
            );
            let help = format!(
                "`{name}` has {} in {}",
                counted(count, "operand"),
                self.version
            );
            self.reports
                .error(&rules::OPERANDS, self.at, &message, &help);
            return Err(Stop::Damaged);
        }
        self.at += 1;
        if word & fields::UNUSED != 0 && !(opcode == Opcode::Dcl && number == 0) {
            let message = format!(
                "bits 15:14 of 0x{word:08X} are not clear; they are ignored, and not written again"
            );
            self.reports
                .warning(&rules::RESERVED, self.at - 1, &message, "");
        }
        Ok(word)
    }

    /// What was read from the token before; says what is wrong with it.
    fn read<T>(&mut self, read: Result<T, Fault>) -> Option<T> {
        read.map_err(|fault| {
            let at = self.at - 1;
            self.reports
                .error(fault.rule, at, &fault.message, fault.help);
        })
        .ok()
    }

    fn operands(&mut self, start: usize, opcode: Opcode, co_issue: bool) -> Result<(), Stop> {
        let form = opcode.row().forms.first();
        let sources = form.map_or(0, |f| f.sources.len());
        let destinations = usize::from(form.is_some_and(|f| f.destination.is_some()));
        let count = destinations + sources;
        let mut whole = true;
        let mut instruction = Instruction {
            opcode,
            co_issue,
            result: ResultModifier::NONE,
            destination: None,
            sources: Vec::with_capacity(sources),
            span: tokens(start, start + 1 + count),
            mnemonic_span: tokens(start, start + 1),
        };
        for number in 0..count {
            let word = self.operand(opcode, number, count)?;
            let at = self.at - 1;
            if number < destinations {
                match self.read(fields::destination(word, self.version)) {
                    Some((register, mask, result)) => {
                        instruction.result = result;
                        let span = tokens(at, at + 1);
                        instruction.destination = Some(Destination {
                            register,
                            mask,
                            span,
                        });
                    }
                    None => whole = false,
                }
            } else {
                match self.read(fields::source(word, self.version)) {
                    Some(parts) => instruction.sources.push(source_at(parts, at)),
                    None => whole = false,
                }
            }
        }
        if opcode == Opcode::Sub && self.kind == ShaderKind::Vertex {
            let message = "no assembler wrote this token, `sub`, into a vertex shader";
            let help = "it is read all the same; written again it is `add` with a negated source";
            self.reports.warning(&rules::SUBTRACT, start, message, help);
        }
        if whole {
            self.statements.push(Statement::Instruction(instruction));
        }
        Ok(())
    }

    fn definition(&mut self, start: usize, co_issue: bool) -> Result<(), Stop> {
        let word = self.operand(Opcode::Def, 0, 5)?;
        let register = self.read(fields::defined(word, self.version));
        let bits = self.words.get(self.at..self.at + 4);
        let Some(value) = bits.and_then(|bits| <[u32; 4]>::try_from(bits).ok()) else {
            let numbers = counted(self.words.len() - self.at, "number");
            let message = format!("the stream ends in `def`, which has {numbers} instead of 4");
            self.cut(self.words.len(), &message);
            return Err(Stop::Ends);
        };
        self.at += 4;
        let Some((register, mask)) = register else {
            return Ok(());
        };
        if mask != WriteMask::ALL {
            let message = format!("`def` sets a whole register, but 0x{word:08X} masks it");
            self.reports
                .error(&rules::MASK, start + 1, &message, "bits 19:16 are all set");
            return Ok(());
        }
        self.statements.push(Statement::Def(Def {
            register,
            value: value.map(f32::from_bits),
            co_issue,
            span: tokens(start, self.at),
            register_span: tokens(start + 1, start + 2),
        }));
        Ok(())
    }

    fn declaration(&mut self, start: usize, co_issue: bool) -> Result<(), Stop> {
        let usage = self.operand(Opcode::Dcl, 0, 2)?;
        let usage = self.read(fields::usage(usage));
        let register = self.operand(Opcode::Dcl, 1, 2)?;
        let register = self.read(fields::declared(register, self.version));
        if co_issue {
            // Of a vertex shader it has been said.
            if self.kind == ShaderKind::Pixel {
                let message = "`dcl` runs together with no other instruction, but bit 30 is set";
                self.reports.error(&rules::MODIFIER, start, message, "");
            }
        } else if let Some(((usage, usage_index), (register, mask))) = usage.zip(register) {
            self.statements.push(Statement::Dcl(Dcl {
                usage,
                usage_index,
                register,
                mask,
                span: tokens(start, self.at),
            }));
        }
        Ok(())
    }
}

/// `1 token`, `2 tokens`.
fn counted(count: usize, what: &str) -> String {
    let s = if count == 1 { "" } else { "s" };
    format!("{count} {what}{s}")
}

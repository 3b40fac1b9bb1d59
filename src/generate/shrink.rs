//! Making a shader small.

use super::with_text;
use crate::isa::register::OPOS;
use crate::isa::{
    Opcode, RegisterFile, ResultModifier, ShaderKind, SourceModifier, Swizzle, WriteMask,
};
use crate::policy::Dialect;
use crate::program::{Destination, Instruction, Program, Register, Source, Statement};
use crate::syntax::print_instruction;
use crate::validate::validate;
use std::collections::BTreeSet;

/// How many smaller shaders are tried. One that fails is what the next are made from.
const MOST_TRIES: u32 = 4096;

/// Makes a shader on which something fails as small as can be while it still fails.
///
/// Ends the shader with an instruction whose result is that of the shader, removes instructions (halves first, then less),
/// then pairing, modifiers, masks and swizzles, replaces instructions by `mov` of a constant or of one of their sources,
/// destinations by `r0` or `oPos` and operands by `c0`, until nothing of that is possible or 4096 shaders were tried. What is tried
/// is valid: it breaks no rule of Direct3D 8 that `program` does not break, warnings included. `fails` says whether the
/// failure is there; it is not asked about `program` itself. The result has the spans of [`crate::syntax::print`]'s text.
pub fn shrink(program: &Program, fails: &mut dyn FnMut(&Program) -> bool) -> Program {
    let mut shrinking = Shrinking {
        best: program.clone(),
        broken: broken(program),
        fails,
        tries: MOST_TRIES,
    };
    loop {
        let cut = shrinking.cut();
        let removed = shrinking.remove();
        let simplified = shrinking.simplify();
        if !(cut || removed || simplified) {
            break;
        }
    }
    with_text(shrinking.best).1
}

/// The rules that a program breaks.
fn broken(program: &Program) -> BTreeSet<&'static str> {
    let found = validate(program, Dialect::D3d8);
    found.iter().map(|d| d.rule.id).collect()
}

struct Shrinking<'a> {
    best: Program,
    broken: BTreeSet<&'static str>,
    fails: &'a mut dyn FnMut(&Program) -> bool,
    tries: u32,
}

impl Shrinking<'_> {
    /// Takes a smaller shader if it is valid and fails.
    fn offer(&mut self, statements: Vec<Statement>) -> bool {
        if self.tries == 0 {
            return false;
        }
        self.tries -= 1;
        let candidate = Program {
            statements,
            ..self.best.clone()
        };
        // Some rules tell operands apart by their places.
        let (_, candidate) = with_text(candidate);
        let fails = broken(&candidate).is_subset(&self.broken) && (self.fails)(&candidate);
        if fails {
            self.best = candidate;
        }
        fails
    }

    /// Ends the shader early, with an instruction that writes the result of the shader instead of another register.
    fn cut(&mut self) -> bool {
        let kind = self.best.version.kind();
        for last in 0..self.best.statements.len().saturating_sub(1) {
            let mut statements = self.best.statements.clone();
            statements.truncate(last + 1);
            if let Some(Statement::Instruction(instruction)) = statements.last_mut()
                && let Some(destination) = &mut instruction.destination
            {
                destination.register = result_register(kind);
                destination.mask = WriteMask::ALL;
                instruction.co_issue = false;
                if self.offer(statements) {
                    return true;
                }
            }
        }
        false
    }

    /// Removes runs of statements, long ones first.
    fn remove(&mut self) -> bool {
        let mut any = false;
        let mut length = self.best.statements.len();
        while length > 0 {
            let mut at = 0;
            while at < self.best.statements.len() {
                let mut statements = self.best.statements.clone();
                let end = (at + length).min(statements.len());
                statements.drain(at..end);
                if self.offer(statements) {
                    any = true;
                } else {
                    at += 1;
                }
            }
            length /= 2;
        }
        any
    }

    /// Makes single statements plainer.
    fn simplify(&mut self) -> bool {
        let kind = self.best.version.kind();
        let mut any = false;
        let mut at = 0;
        while at < self.best.statements.len() {
            let mut number = 0;
            // The list is made anew whenever something was taken, and ends because each step is plainer.
            while let Some(plainer) = self
                .best
                .statements
                .get(at)
                .and_then(|s| plainer(s, kind, number))
            {
                let mut statements = self.best.statements.clone();
                statements[at] = plainer;
                if self.offer(statements) {
                    any = true;
                    number = 0;
                } else {
                    number += 1;
                }
            }
            at += 1;
        }
        any
    }
}

/// The plainer forms of a statement by number, the plainest first.
fn plainer(statement: &Statement, kind: ShaderKind, number: usize) -> Option<Statement> {
    let forms: Vec<Statement> = match statement {
        Statement::Instruction(i) => {
            // What is the same but for its place is no plainer.
            let text = |i: &Instruction| print_instruction(i, kind);
            let forms = plainer_instructions(i, kind).into_iter();
            forms
                .filter(|form| text(form) != text(i))
                .map(Statement::Instruction)
                .collect()
        }
        Statement::Def(def) => {
            let mut plain = *def;
            plain.value = [0.0; 4];
            let done = def.value == plain.value;
            (!done)
                .then_some(Statement::Def(plain))
                .into_iter()
                .collect()
        }
        Statement::Dcl(_) => Vec::new(),
    };
    forms.into_iter().nth(number)
}

/// What a shader is run for.
fn result_register(kind: ShaderKind) -> Register {
    match kind {
        ShaderKind::Pixel => Register::new(RegisterFile::Temp, 0),
        ShaderKind::Vertex => Register::new(RegisterFile::RastOut, OPOS),
    }
}

fn plainer_instructions(instruction: &Instruction, kind: ShaderKind) -> Vec<Instruction> {
    let mut forms = Vec::new();
    let constant = Source {
        register: Register::new(RegisterFile::Const, 0),
        swizzle: Swizzle::IDENTITY,
        modifier: SourceModifier::None,
        span: instruction.span,
    };
    if instruction.destination.is_some() {
        let mut moved = instruction.clone();
        moved.opcode = Opcode::Mov;
        moved.result = ResultModifier::NONE;
        moved.co_issue = false;
        moved.sources = vec![constant];
        forms.push(moved.clone());
        if instruction.opcode != Opcode::Mov {
            for source in &instruction.sources {
                moved.sources = vec![*source];
                forms.push(moved.clone());
            }
        }
    }
    let mut alone = instruction.clone();
    alone.co_issue = false;
    forms.push(alone);
    let mut plain = instruction.clone();
    plain.result = ResultModifier::NONE;
    forms.push(plain);
    let results = [
        ResultModifier {
            shift: 0,
            ..instruction.result
        },
        ResultModifier {
            saturate: false,
            ..instruction.result
        },
    ];
    for result in results {
        let mut form = instruction.clone();
        form.result = result;
        forms.push(form);
    }
    for (i, source) in instruction.sources.iter().enumerate() {
        let plainer = [
            constant,
            Source {
                modifier: SourceModifier::None,
                ..*source
            },
            Source {
                swizzle: Swizzle::IDENTITY,
                ..*source
            },
        ];
        for plainer in plainer {
            let mut form = instruction.clone();
            form.sources[i] = plainer;
            forms.push(form);
        }
    }
    if let Some(destination) = instruction.destination {
        let mut whole = instruction.clone();
        whole.destination = Some(Destination {
            mask: WriteMask::ALL,
            ..destination
        });
        forms.push(whole);
        // What writes the result makes another instruction that does so superfluous.
        let mut direct = instruction.clone();
        direct.destination = Some(Destination {
            register: result_register(kind),
            ..destination
        });
        forms.push(direct);
    }
    forms
}

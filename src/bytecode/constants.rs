//! Constants of vertex shaders: `def` in the shader, or `D3DVSD_CONST` in the declaration beside it.
//!
//! The assembler of Direct3D 8 left every `def` out of the tokens of a vertex shader and gave back a piece of a vertex
//! declaration that loads the same constants. Direct3D 9 has `def` as a token. What a device loads is the same.

use super::{Declaration, Element, ElementKind, rules};
use crate::diagnostic::{Diagnostic, Span};
use crate::isa::{RegisterFile, ShaderKind};
use crate::program::{Def, Program, Register, Statement};

/// The most constants that one `D3DVSD_CONST` can count.
const MOST_VALUES: usize = 15;
/// The last constant that it can name.
const LAST: u32 = 127;

/// Takes the `def`s out of a vertex shader and gives the elements that load the same constants in the same order, neighbours
/// together. A pixel shader keeps its own: its constants have no other place.
///
/// # Errors
/// A `def` of what no element can name, with its span: no constant, or one above c127. The shader is left as it was.
pub fn take_constants(program: &mut Program) -> Result<Declaration, Vec<Diagnostic>> {
    let mut declaration = Declaration::default();
    if program.version.kind() == ShaderKind::Pixel {
        return Ok(declaration);
    }
    let mut faults = Vec::new();
    for def in program.definitions() {
        let Register {
            file,
            index,
            relative,
        } = def.register;
        if file != RegisterFile::Const || relative || index > LAST {
            let message = format!("D3DVSD_CONST cannot load {}", def.register);
            let fault = Diagnostic::error(&rules::NO_TOKEN, def.register_span, message);
            faults.push(fault.with_help(format!("it loads c0 to c{LAST}")));
            continue;
        }
        declaration.load(index as u8, def.value, def.span);
    }
    if !faults.is_empty() {
        return Err(faults);
    }
    let is_def = |statement: &Statement| matches!(statement, Statement::Def(_));
    for comment in &mut program.comments {
        let before = program.statements.iter().take(comment.before);
        comment.before -= before.filter(|s| is_def(s)).count();
    }
    program.statements.retain(|statement| !is_def(statement));
    Ok(declaration)
}

/// Puts the constants that a declaration loads into a vertex shader, as `def`s in front of everything else. What else
/// the declaration has is passed over; a pixel shader is left as it is.
pub fn put_constants(program: &mut Program, declaration: &Declaration) {
    if program.version.kind() == ShaderKind::Pixel {
        return;
    }
    let definitions: Vec<Statement> = declaration
        .constants()
        .map(|(index, value)| {
            Statement::Def(Def {
                register: Register::new(RegisterFile::Const, index),
                value,
                co_issue: false,
                span: Span::default(),
                register_span: Span::default(),
            })
        })
        .collect();
    // Comments in front of everything stay there.
    for comment in program.comments.iter_mut().filter(|c| c.before > 0) {
        comment.before += definitions.len();
    }
    program.statements.splice(0..0, definitions);
}

impl Declaration {
    /// The constants that it loads, in order: register and value. Of one that is loaded twice the last counts.
    pub fn constants(&self) -> impl Iterator<Item = (u32, [f32; 4])> {
        let loads = self
            .elements
            .iter()
            .filter_map(|element| match &element.kind {
                ElementKind::Const { address, values } => Some((u32::from(*address), values)),
                _ => None,
            });
        loads.flat_map(|(address, values)| (address..).zip(values.iter().copied()))
    }

    /// Adds a constant: to the last element if it goes on there, or else as an element of its own.
    fn load(&mut self, register: u8, value: [f32; 4], span: Span) {
        if let Some(Element {
            kind: ElementKind::Const { address, values },
            span: whole,
        }) = self.elements.last_mut()
            && values.len() < MOST_VALUES
            && usize::from(*address) + values.len() == usize::from(register)
        {
            values.push(value);
            *whole = whole.to(span);
            return;
        }
        let kind = ElementKind::Const {
            address: register,
            values: vec![value],
        };
        self.elements.push(Element { kind, span });
    }
}

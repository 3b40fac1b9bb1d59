//! What steps read and write, as numbers of the shader's hardware model.

use super::body::Body;
use super::constants::bound_value;
use super::expression::{Expression, Value};
use super::helper::Helper;
use super::number;
use crate::isa::operand::XYZW;
use crate::isa::{SourceModifier, WriteMask};
use crate::kernel::{Op, Operand, Place, Step};
use crate::policy::Model;
use crate::semantics;

impl Body<'_> {
    /// What source `i` of a step reads into the slots of the mask: a scalar if all of them read the same component. 0 if
    /// the step has no such source.
    pub(super) fn operand(&mut self, step: &Step, i: usize, slots: WriteMask) -> Expression {
        let letters = match step.sources.get(i).map(|operand| operand.place) {
            Some(Place::Slot(slot)) => self.letters(slot),
            Some(Place::Constant(_)) => self.constant_letters(),
            _ => XYZW,
        };
        self.operand_named(step, i, slots, letters)
    }

    /// As [`Self::operand`], with these letters for the components of registers.
    pub(super) fn operand_named(
        &mut self,
        step: &Step,
        i: usize,
        slots: WriteMask,
        letters: [char; 4],
    ) -> Expression {
        let Some(operand) = step.sources.get(i) else {
            return Expression::number("0.0");
        };
        let components: Vec<usize> = slots
            .components()
            .map(|s| operand.swizzle.slot(s))
            .collect();
        let (name, width) = match operand.place {
            Place::Slot(slot) => (self.name(slot), self.width(slot)),
            Place::Constant(index) => (self.constant_name(index), 4),
            Place::Relative(offset) => (self.relative_constant(offset), 4),
            Place::Literal(value) => {
                let text = number::literal(value).unwrap_or_else(|| "0.0".into());
                return Expression::new(text, 1).modified(operand.modifier);
            }
        };
        let mut read = select(name, width, &components, letters);
        if !self.is_held(step.reads, operand, slots) {
            let finite = self.magnitudes.is_finite(operand, slots);
            read = self.held(step.reads, &read, finite);
        }
        if step.reads == Model::Gf3 {
            read = clamped(read, operand.modifier);
        }
        read.modified(operand.modifier)
    }

    /// The value of a step behind shift and saturation.
    pub(super) fn finished(&mut self, step: &Step, value: Value) -> Value {
        let value = value.finished(step.result);
        if step.writes == Model::Float || keeps_steps(step) {
            return value;
        }
        let whole = value.whole();
        let finite = self.magnitudes.gives_finite(step);
        Value::Whole(self.held(step.writes, &whole, finite))
    }

    /// A number as the registers of a model hold it. `finite`: it is not NaN.
    fn held(&mut self, model: Model, number: &Expression, finite: bool) -> Expression {
        let helper = match (model, finite) {
            (Model::Float, _) => return number.clone(),
            (_, true) => Helper::Held(model, number.width),
            (_, false) => Helper::HeldAny(model, number.width),
        };
        let name = self.helpers.call(helper);
        Expression::call(&name, &[number.text.as_str()], number.width)
    }

    /// Whether what an operand reads is known to be a number of the model.
    fn is_held(&self, model: Model, operand: &Operand, slots: WriteMask) -> bool {
        match operand.place {
            _ if model == Model::Float => true,
            Place::Slot(slot) => {
                let read = operand.swizzle.reads(slots);
                read.without(self.magnitudes.held(slot)).is_empty()
            }
            Place::Constant(index) => self.constant_model(index) == model,
            Place::Relative(_) | Place::Literal(_) => false,
        }
    }

    /// The numbers that a constant has in the translation: those of the model, unless a texture instruction wants it as it
    /// is, too.
    fn constant_model(&self, index: u32) -> Model {
        let kernel = self.stage.kernel;
        let as_it_is = kernel.steps.iter().any(|step| {
            let named = (step.sources.iter()).any(|s| s.place == Place::Constant(index));
            named && step.reads == Model::Float
        });
        if as_it_is { Model::Float } else { kernel.model }
    }

    /// The value of a constant that the shader defines.
    pub(super) fn defined_value(&self, index: u32, value: [f32; 4]) -> [f32; 4] {
        let model = self.constant_model(index);
        bound_value(self.kind(), value).map(|x| semantics::held(model, x))
    }

    /// A constant of a pixel shader that is set from outside.
    pub(super) fn uniform_constant(&mut self, index: u32, field: &str) -> Expression {
        let model = self.constant_model(index);
        let set = format!("{field}[{index}]");
        let clamped = match model {
            // The range of the model is that of constants.
            Model::Gf3 => Expression::new(set, 4),
            Model::Float | Model::R200 => {
                Expression::new(format!("clamp({set}, vec4f(-1.0), vec4f(1.0))"), 4)
            }
        };
        self.held(model, &clamped, true)
    }

    /// A colour that comes from the vertices.
    pub(super) fn color(&mut self, name: &str) -> Expression {
        let color = Expression::new(format!("saturate(in.{name})"), 4);
        self.held(self.stage.kernel.model, &color, true)
    }
}

/// What the combiners of the GeForce 3 do to a number before they map it.
fn clamped(x: Expression, modifier: SourceModifier) -> Expression {
    use SourceModifier::{Bias, BiasNegate, Bx2, Bx2Negate, Complement};
    match modifier {
        Complement => x.map("saturate"),
        Bias | BiasNegate | Bx2 | Bx2Negate => {
            let zero = match x.width {
                1 => "0.0".to_string(),
                width => format!("vec{width}f()"),
            };
            Expression::call("max", &[x.text.clone(), zero], x.width)
        }
        _ => x,
    }
}

/// Whether a step only hands on numbers that are of the model already.
fn keeps_steps(step: &Step) -> bool {
    let handed_on = match step.op {
        Op::Mov => step.sources.get(..1),
        Op::Cnd | Op::Cmp => step.sources.get(1..),
        _ => None,
    };
    let plain = |operand: &Operand| {
        matches!(
            operand.modifier,
            SourceModifier::None | SourceModifier::Negate
        )
    };
    step.reads == step.writes
        && step.result.shift == 0
        && handed_on.is_some_and(|operands| operands.iter().all(plain))
}

/// Components of a vector of `width` components: a scalar if they are all the same.
pub(super) fn select(
    mut name: String,
    width: usize,
    components: &[usize],
    letters: [char; 4],
) -> Expression {
    if width == 1 {
        return Expression::new(name, 1);
    }
    let first = components.first().copied().unwrap_or(0);
    let same = components.iter().all(|c| *c == first);
    if !same && components.iter().copied().eq(0..width) {
        return Expression::new(name, components.len());
    }
    let named = if same { &[first] } else { components };
    name.push('.');
    name.extend(named.iter().map(|c| letters[*c]));
    Expression::new(name, named.len())
}

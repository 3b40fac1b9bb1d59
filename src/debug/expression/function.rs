//! The functions of expressions.

use super::evaluate;
use super::value::Value;
use crate::policy::OfZero;
use crate::semantics;

/// One function.
#[derive(Debug)]
pub(super) struct Function {
    pub(super) name: &'static str,
    pub(super) body: Body,
}

/// What a function does.
#[derive(Debug)]
pub(super) enum Body {
    /// Component by component.
    One(fn(f32) -> f32),
    Two(fn(f32, f32) -> f32),
    Three(fn(f32, f32, f32) -> f32),
    /// The dot product of the first so many components.
    Dot(usize),
    /// Of as many components as there are.
    Whole(fn(Value) -> Value),
}

/// A row a function: those of the debugger, then the instructions that are functions.
static FUNCTIONS: [Function; 21] = [
    row("dp3", Body::Dot(3)),
    row("dp4", Body::Dot(4)),
    row("length", Body::Whole(length)),
    row("normalize", Body::Whole(normalize)),
    row("abs", Body::One(f32::abs)),
    row("min", Body::Two(semantics::min)),
    row("max", Body::Two(semantics::max)),
    row("sat", Body::One(semantics::saturate)),
    row("isnan", Body::One(|x| truth(x.is_nan()))),
    row("isinf", Body::One(|x| truth(x.is_infinite()))),
    row("floor", Body::One(f32::floor)),
    row("frc", Body::One(semantics::frc)),
    row("rcp", Body::One(|x| semantics::rcp(OfZero::Largest, x))),
    row("rsq", Body::One(|x| semantics::rsq(OfZero::Largest, x))),
    row("exp", Body::One(semantics::exp)),
    row("log", Body::One(|x| semantics::log(OfZero::Largest, x))),
    row("slt", Body::Two(semantics::slt)),
    row("sge", Body::Two(semantics::sge)),
    row("lrp", Body::Three(semantics::lrp::<semantics::ZeroWins>)),
    row("cnd", Body::Three(semantics::cnd)),
    row("cmp", Body::Three(semantics::cmp)),
];

const fn row(name: &'static str, body: Body) -> Function {
    Function { name, body }
}

/// The names of the functions that expressions know.
pub fn function_names() -> impl Iterator<Item = &'static str> {
    FUNCTIONS.iter().map(|function| function.name)
}

pub(super) fn named(name: &str) -> Option<&'static Function> {
    FUNCTIONS
        .iter()
        .find(|function| function.name.eq_ignore_ascii_case(name))
}

impl Function {
    /// How many arguments it takes.
    pub(super) fn arguments(&self) -> usize {
        match self.body {
            Body::One(_) | Body::Whole(_) => 1,
            Body::Two(_) | Body::Dot(_) => 2,
            Body::Three(_) => 3,
        }
    }
}

/// A function is like itself alone.
impl PartialEq for Function {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

pub(super) fn truth(holds: bool) -> f32 {
    f32::from(u8::from(holds))
}

fn length(value: Value) -> Value {
    Value::scalar(evaluate::dot(&value, &value, value.count).sqrt())
}

/// As shaders do it: times `rsq` of the square. A vector of zeros stays one.
fn normalize(value: Value) -> Value {
    let scale = semantics::rsq(OfZero::Largest, evaluate::dot(&value, &value, value.count));
    value.map(|x| semantics::mul(x, scale))
}

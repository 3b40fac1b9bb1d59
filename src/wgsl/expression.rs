//! Pieces of WGSL that know how tightly they bind and how wide they are.

use crate::isa::{ResultModifier, SourceModifier};
use std::borrow::Borrow;

/// How tightly the outermost operator of an expression binds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Binding {
    /// `a + b`
    Sum,
    /// `a * b`
    Product,
    /// `-a`
    Sign,
    /// A name, a number, a call.
    Primary,
}

/// An expression.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Expression {
    pub(super) text: String,
    binding: Binding,
    /// Components; 1 is a scalar, which stands for as many equal components as are wanted.
    pub(super) width: usize,
    /// The expression without its sign, if it has one, so that sums can take it. It binds like a product or tighter.
    unsigned: Option<String>,
}

impl Expression {
    pub(super) fn new(text: impl Into<String>, width: usize) -> Self {
        Self {
            text: text.into(),
            binding: Binding::Primary,
            width,
            unsigned: None,
        }
    }

    /// A call of a function that returns `width` components.
    pub(super) fn call<S: Borrow<str>>(function: &str, arguments: &[S], width: usize) -> Self {
        Self::new([function, "(", &arguments.join(", "), ")"].concat(), width)
    }

    fn operator(text: String, binding: Binding, width: usize) -> Self {
        Self {
            text,
            binding,
            width,
            unsigned: None,
        }
    }

    /// The text as an operand of an operator that binds like this.
    pub(super) fn within(&self, binding: Binding) -> String {
        if self.binding < binding {
            ["(", &self.text, ")"].concat()
        } else {
            self.text.clone()
        }
    }

    fn wider(&self, other: &Self) -> usize {
        self.width.max(other.width)
    }

    fn with_unsigned(mut self, unsigned: Option<String>) -> Self {
        self.unsigned = unsigned;
        self
    }

    pub(super) fn plus(&self, other: &Self) -> Self {
        let (left, width) = (&self.text, self.wider(other));
        // The bits are the same: only the sign of the product changes.
        let text = match &other.unsigned {
            Some(unsigned) => [left, " - ", unsigned].concat(),
            None => [left, " + ", &other.within(Binding::Product)].concat(),
        };
        Self::operator(text, Binding::Sum, width)
    }

    pub(super) fn minus(&self, other: &Self) -> Self {
        let (left, width) = (&self.text, self.wider(other));
        let text = match &other.unsigned {
            Some(unsigned) => [left, " + ", unsigned].concat(),
            // `--` is no operator of WGSL.
            None if other.text.starts_with('-') => [left, " - (", &other.text, ")"].concat(),
            None => [left, " - ", &other.within(Binding::Product)].concat(),
        };
        Self::operator(text, Binding::Sum, width)
    }

    pub(super) fn times(&self, other: &Self) -> Self {
        let left = self.within(Binding::Product);
        let right = other.within(Binding::Sign);
        let unsigned = match (&self.unsigned, &other.unsigned) {
            (Some(unsigned), None) => Some([unsigned, " * ", &right].concat()),
            (None, Some(unsigned)) => Some([&left, " * ", unsigned].concat()),
            _ => None,
        };
        let text = [left, right].join(" * ");
        Self::operator(text, Binding::Product, self.wider(other)).with_unsigned(unsigned)
    }

    /// `function(self)`, component by component.
    pub(super) fn map(&self, function: &str) -> Self {
        Self::call(function, &[self.text.as_str()], self.width)
    }

    pub(super) fn number(text: &str) -> Self {
        Self::new(text, 1)
    }

    /// With exactly `width` components.
    pub(super) fn spread(self, width: usize) -> Self {
        if self.width == width {
            self
        } else {
            Self::new(format!("vec{width}f({})", self.text), width)
        }
    }

    /// After a source modifier. The divide modifiers are steps of their own.
    pub(super) fn modified(self, modifier: SourceModifier) -> Self {
        let half = || Self::number("0.5");
        let one = || Self::number("1.0");
        let twice = |e: &Self| Self::number("2.0").times(e);
        match modifier {
            SourceModifier::None | SourceModifier::Dz | SourceModifier::Dw => self,
            SourceModifier::Negate => {
                let positive = self.within(Binding::Primary);
                Self::operator(["-", &positive].concat(), Binding::Sign, self.width)
                    .with_unsigned(Some(positive))
            }
            SourceModifier::Bias => self.minus(&half()),
            SourceModifier::BiasNegate => half().minus(&self),
            // 2·x − 1 has the bits of 2·(x − 0.5): doubling is exact.
            SourceModifier::Bx2 => twice(&self).minus(&one()),
            SourceModifier::Bx2Negate => one().minus(&twice(&self)),
            SourceModifier::Complement => one().minus(&self),
            SourceModifier::X2 => twice(&self),
            SourceModifier::X2Negate => {
                let doubled = format!("2.0 * {}", self.within(Binding::Sign));
                Self::operator(format!("-{doubled}"), Binding::Product, self.width)
                    .with_unsigned(Some(doubled))
            }
        }
    }

    /// After a result modifier: the shift, then the saturation.
    pub(super) fn finished(self, result: ResultModifier) -> Self {
        let factor = match result.shift {
            0 => None,
            1 => Some("2.0"),
            2 => Some("4.0"),
            3.. => Some("8.0"),
            -1 => Some("0.5"),
            -2 => Some("0.25"),
            _ => Some("0.125"),
        };
        let shifted = match factor {
            Some(factor) => {
                let text = format!("{} * {factor}", self.within(Binding::Product));
                Self::operator(text, Binding::Product, self.width)
            }
            None => self,
        };
        if result.saturate {
            shifted.map("saturate")
        } else {
            shifted
        }
    }

    /// `self` compared with `other`; what comes out is not a number any more.
    pub(super) fn compared(&self, operator: &str, other: &Self) -> Self {
        let width = self.wider(other);
        let [left, right] = [self, other].map(|side| side.clone().spread(width).text);
        let text = [&left, " ", operator, " ", &right].concat();
        Self::operator(text, Binding::Sum, width)
    }
}

/// The value of a step: one expression, or the components one by one.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Value {
    Whole(Expression),
    Parts(Vec<Expression>),
}

impl Value {
    /// As one expression.
    pub(super) fn whole(self) -> Expression {
        match self {
            Self::Whole(expression) => expression,
            Self::Parts(parts) => match <[Expression; 1]>::try_from(parts) {
                Ok([only]) => only,
                Err(parts) => construct(
                    parts.iter().map(|part| part.text.as_str()).collect(),
                    parts.len(),
                ),
            },
        }
    }

    pub(super) fn finished(self, result: ResultModifier) -> Self {
        if result == ResultModifier::NONE {
            self
        } else {
            Self::Whole(self.whole().finished(result))
        }
    }
}

/// A vector from parts that together have `width` components, a part a line where one line would be long.
pub(super) fn construct<S: Borrow<str>>(parts: Vec<S>, width: usize) -> Expression {
    const LONG: usize = 84;
    let length: usize = parts.iter().map(|part| part.borrow().len() + 2).sum();
    if length <= LONG {
        return Expression::call(&format!("vec{width}f"), &parts, width);
    }
    let lines: String = parts
        .iter()
        .map(|part| format!("        {},\n", part.borrow()))
        .collect();
    Expression::new(format!("vec{width}f(\n{lines}    )"), width)
}

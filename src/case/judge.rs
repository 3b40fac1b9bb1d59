//! What was observed against what is expected.

use super::{Expectation, Invocation, Observed, Origin, Quantity, Value};

/// What came of an invocation.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// It gave what is expected.
    Passed,
    /// It gave the other result of this number, from 0, that the case accepts.
    Accepted(usize),
    /// It gave something else.
    Failed(Vec<Wrong>),
}

impl Verdict {
    /// Whether the invocation passes, be it by another result that is accepted.
    pub fn passes(&self) -> bool {
        !matches!(self, Self::Failed(_))
    }
}

/// One thing that is not as expected.
#[derive(Clone, Debug, PartialEq)]
pub enum Wrong {
    /// A number.
    Number {
        /// Of what.
        quantity: Quantity,
        /// Which component, 0 to 3.
        component: usize,
        /// What was expected.
        expected: f32,
        /// What came out.
        actual: f32,
        /// The absolute difference; NaN if only one of the two is a number.
        difference: f64,
        /// The largest difference that would have passed.
        tolerance: f64,
        /// The instruction that wrote the number last; `None` if none did.
        origin: Option<Origin>,
    },
    /// Whether the pixel is discarded.
    Killed {
        /// What was expected.
        expected: bool,
        /// The instruction that discarded it, if one did.
        origin: Option<Origin>,
    },
}

/// Compares what an invocation gave with what it should give.
///
/// Two numbers agree if they are the same, infinities included, if both are NaN, or if they differ by no more than the
/// tolerance of the invocation, or by no more than [`Value::slack`]. For [`Quantity::Frame`] the number may also be that which a target of 8 bits a channel stores.
/// `origin(quantity, component)` tells where a number was born; it is asked only for wrong ones, with `None` for
/// whether the pixel is discarded.
pub fn judge(
    invocation: &Invocation,
    observed: &Observed,
    origin: impl Fn(Option<Quantity>, usize) -> Option<Origin>,
) -> Verdict {
    let mut wrong = compare(&invocation.expect, invocation.tolerance, observed);
    if wrong.is_empty() {
        return Verdict::Passed;
    }
    let other = (invocation.accept.iter())
        .position(|other| compare(other, invocation.tolerance, observed).is_empty());
    if let Some(number) = other {
        return Verdict::Accepted(number);
    }
    for entry in &mut wrong {
        match entry {
            Wrong::Number {
                quantity,
                component,
                origin: born,
                ..
            } => *born = origin(Some(*quantity), *component),
            Wrong::Killed { origin: born, .. } => *born = origin(None, 0),
        }
    }
    Verdict::Failed(wrong)
}

fn compare(expect: &Expectation, tolerance: f64, observed: &Observed) -> Vec<Wrong> {
    let mut wrong = Vec::new();
    if let Some(expected) = expect.killed
        && expected != observed.killed
    {
        let origin = None;
        wrong.push(Wrong::Killed { expected, origin });
    }
    for value in &expect.values {
        let quantity = value.quantity;
        let Value { numbers, slack, .. } = observed.value(quantity);
        let stored = match quantity {
            Quantity::Frame => observed.stored,
            _ => numbers,
        };
        for (component, &expected) in value.components.iter().enumerate().take(4) {
            let number = numbers[component];
            let tolerance = tolerance.max(slack[component]);
            if agrees(number, expected, tolerance) || agrees(stored[component], expected, tolerance)
            {
                continue;
            }
            wrong.push(Wrong::Number {
                quantity,
                component,
                expected,
                actual: number,
                difference: (f64::from(number) - f64::from(expected)).abs(),
                tolerance,
                origin: None,
            });
        }
    }
    wrong
}

fn agrees(actual: f32, expected: f32, tolerance: f64) -> bool {
    // Equal infinities have no difference.
    actual == expected
        || actual.is_nan() && expected.is_nan()
        || (f64::from(actual) - f64::from(expected)).abs() <= tolerance
}

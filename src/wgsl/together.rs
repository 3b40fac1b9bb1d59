//! Steps of one instruction that become one assignment.

use super::body::{Body, kept};
use super::expression::{Expression, Value, construct};
use crate::isa::WriteMask;
use crate::kernel::{Op, Operand, Place, Step};

/// How many of the first steps of an instruction can be written in one assignment: the rows of a matrix macro, which
/// read before any of them writes, or steps that write one component of a register after the other and do not read it.
pub(super) fn count(steps: &[Step]) -> usize {
    let Some(first) = steps.first() else {
        return 0;
    };
    let row = |step: &Step| matches!(step.op, Op::Dp3 | Op::Dp4) && step.mask.count() == 1;
    if steps.len() > 1
        && (steps.iter()).all(|step| row(step) && step.destination == first.destination)
    {
        return steps.len();
    }
    let place = Place::Slot(first.destination);
    let reads_it = |step: &Step| step.sources.iter().any(|source| source.place == place);
    let alone =
        |step: &Step| step.held || matches!(step.op, Op::Sample(_) | Op::Kill) || reads_it(step);
    if alone(first) {
        return 1;
    }
    let follows = |pair: &&[Step]| {
        let [before, step] = pair else { return false };
        let next = before.mask.components().last().map(|last| last + 1);
        step.destination == first.destination
            && !alone(step)
            && step.mask.components().next() == next
            && is_gapless(step.mask)
    };
    1 + (steps.windows(2))
        .take_while(|pair| is_gapless(first.mask) && follows(pair))
        .count()
}

fn is_gapless(mask: WriteMask) -> bool {
    let mut components = mask.components();
    let first = components.next();
    first.is_some_and(|first| components.zip(first + 1..).all(|(c, next)| c == next))
}

impl<'a> Body<'a> {
    /// Writes steps in one assignment.
    pub(super) fn together(&mut self, steps: &'a [Step]) {
        let mut written = WriteMask::NONE;
        let mut parts = Vec::new();
        let mut outcomes = Vec::new();
        for step in steps {
            let mask = kept(self.stage.kernel, self.options, step);
            if mask.is_empty() {
                continue;
            }
            written = written.or(mask);
            let step = Step {
                mask,
                ..step.clone()
            };
            let width = mask.count() as usize;
            let value = self.value(&step);
            let value = self.finished(&step, value).whole();
            parts.extend(match step.sources.as_slice() {
                [
                    Operand {
                        place: Place::Literal(_),
                        ..
                    },
                ] => vec![value.text; width],
                _ => vec![value.spread(width).text],
            });
            outcomes.push((self.magnitudes.outcome(&step), step));
        }
        if let [.., (_, last)] = outcomes.as_slice() {
            let width = written.count() as usize;
            let whole = match parts.as_slice() {
                [only] => Expression::new(only.clone(), width),
                _ => construct(parts.clone(), width),
            };
            let value = match self.width(last.destination) == width {
                true => Value::Whole(whole),
                false => Value::Parts(
                    parts
                        .into_iter()
                        .map(|part| Expression::new(part, 1))
                        .collect(),
                ),
            };
            self.assign(last.destination, written, value);
        }
        for (outcome, step) in outcomes {
            self.magnitudes.write(&step, outcome);
        }
    }
}

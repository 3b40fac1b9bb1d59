//! How far the numbers of a plan can go, and where that spares work.
//!
//! A zero wins against infinity and NaN, which costs more than the product itself. Where inputs are of the usual size neither
//! can come up: a bound of the magnitude of each row follows from those of the rows that it is computed of.

use crate::isa::{ResultModifier, SourceModifier};
use crate::kernel::{Plan, RowFinish, RowOp, RowStep};
use crate::policy::Model;

/// The limits of inputs that are tried, the first that is good enough being taken. Coordinates are seldom greater than the
/// first; to stay below the last is easy for colours only.
const LIMITS: [f32; 8] = [65536.0, 4096.0, 256.0, 64.0, 16.0, 8.0, 2.0, 1.0];

/// What is greater counts as infinite. So much below the greatest number that sums of bounds may be rounded.
const MOST: f32 = 1e36;

/// What follows from the constants of a draw.
#[derive(Clone, Debug, Default)]
pub(super) struct Reach {
    /// What the magnitudes of inputs and samples must not exceed.
    limit: f32,
    /// By step: whether all that it reads is finite then.
    finite: Vec<bool>,
}

impl Reach {
    /// Of a plan, `uniform` being the number in each row that is the same for the whole draw.
    pub(super) fn new(plan: &Plan, uniform: &[f32]) -> Self {
        let tries = LIMITS.map(|limit| Self {
            limit,
            finite: steps(plan, uniform, limit),
        });
        let count = |reach: &Self| reach.finite.iter().filter(|finite| **finite).count();
        let most = tries.last().map_or(0, count);
        let mut tries = tries.into_iter();
        tries.find(|reach| count(reach) >= most).unwrap_or_default()
    }

    /// Whether a step reads finite numbers only, if all inputs were [within](Self::admits).
    #[inline(always)]
    pub(super) fn is_finite(&self, step: usize) -> bool {
        self.finite.get(step).copied().unwrap_or_default()
    }

    /// Whether numbers are within the limit: `greatest` is what [`raise`] has made of them.
    #[inline(always)]
    pub(super) fn admits(&self, greatest: &Greatest) -> bool {
        greatest.iter().fold(0, |a, b| a.max(*b)) <= self.limit.to_bits()
    }
}

/// The greatest magnitudes of some numbers. They are told by their bits, which have the same order, with NaN behind infinity.
/// As many as one vector has: it stays in a register.
pub(super) type Greatest = [u32; 8];

/// Raises magnitudes to those of some numbers.
#[inline(always)]
pub(super) fn raise<const N: usize>(greatest: &mut Greatest, numbers: &[f32; N]) {
    let (vectors, rest) = numbers.as_chunks::<8>();
    for vector in vectors {
        raise_by(greatest, vector);
    }
    raise_by(greatest, rest);
}

#[inline(always)]
fn raise_by(greatest: &mut Greatest, numbers: &[f32]) {
    for (greatest, number) in greatest.iter_mut().zip(numbers) {
        *greatest = (*greatest).max(number.abs().to_bits());
    }
}

/// For each step, whether all that it reads is finite.
fn steps(plan: &Plan, uniform: &[f32], limit: f32) -> Vec<bool> {
    let bounded = |number: f32| {
        if number <= MOST {
            number
        } else {
            f32::INFINITY
        }
    };
    let mut rows: Vec<f32> = uniform.iter().map(|number| bounded(number.abs())).collect();
    rows.resize(plan.rows, f32::INFINITY);
    let set = |row: u32, bound: f32, rows: &mut Vec<f32>| {
        if let Some(place) = rows.get_mut(row as usize) {
            *place = bounded(bound);
        }
    };
    for input in &plan.inputs {
        set(input.row, limit, &mut rows);
    }
    let mut finite = vec![false; plan.once];
    for step in plan.steps.iter().skip(plan.once) {
        let mut all = true;
        for (results, sources) in plan.items(step) {
            let of: Vec<f32> = (sources.iter())
                .map(|row| rows.get(*row as usize).copied().unwrap_or(f32::INFINITY))
                .collect();
            all &= of.iter().all(|bound| bound.is_finite());
            for row in results {
                set(*row, result(step, &of, limit), &mut rows);
            }
        }
        finite.push(all);
    }
    finite
}

/// A bound of the results of a step, from those of its sources.
fn result(step: &RowStep, of: &[f32], limit: f32) -> f32 {
    if step.writes != Model::Float {
        return step.writes.most();
    }
    let bound = match step.op {
        // Looked at when it has come.
        RowOp::Sample(_) => return limit,
        op => operation(op, of),
    };
    match step.finish {
        RowFinish::Full(ResultModifier { saturate: true, .. }) => 1.0,
        RowFinish::Full(ResultModifier { shift, .. }) => bound * f32::from(shift.max(0)).exp2(),
        RowFinish::Keep | RowFinish::Flush => bound,
    }
}

/// The same of an operation alone; infinite where it is not worth knowing.
fn operation(op: RowOp, of: &[f32]) -> f32 {
    let products = |a: &[f32], b: &[f32]| a.iter().zip(b).map(|(a, b)| a * b).sum();
    match (op, of) {
        (RowOp::Mov, [a]) => *a,
        (RowOp::Modify(modifier), [a]) => modified(modifier, *a),
        (RowOp::Operand(model, modifier), _) => modified(modifier, model.most()),
        (RowOp::Add | RowOp::Sub, [a, b]) => a + b,
        (RowOp::Mul, [a, b]) => a * b,
        (RowOp::Mad, [a, b, c]) => a * b + c,
        (RowOp::Lrp, [a, b, c]) => a * b + (1.0 + a) * c,
        (RowOp::Min | RowOp::Max, [a, b]) => a.max(*b),
        (RowOp::Cnd | RowOp::Cmp, [_, b, c]) => b.max(*c),
        (RowOp::Slt | RowOp::Sge | RowOp::Depth, _) => 1.0,
        (RowOp::Frc, [a]) if a.is_finite() => 1.0,
        (RowOp::LitDiffuse, [a]) => *a,
        (RowOp::Dp3, [a @ .., _, _, _]) => products(a, &of[3.min(of.len())..]),
        (RowOp::Dp4, [a @ .., _, _, _, _]) => products(a, &of[4.min(of.len())..]),
        _ => f32::INFINITY,
    }
}

/// A bound behind a source modifier.
fn modified(modifier: SourceModifier, of: f32) -> f32 {
    match modifier {
        SourceModifier::None | SourceModifier::Dz | SourceModifier::Dw | SourceModifier::Negate => {
            of
        }
        SourceModifier::Bias | SourceModifier::BiasNegate => of + 0.5,
        SourceModifier::Bx2 | SourceModifier::Bx2Negate => 2.0 * (of + 0.5),
        SourceModifier::Complement => 1.0 + of,
        SourceModifier::X2 | SourceModifier::X2Negate => 2.0 * of,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::SourceMap;
    use crate::kernel::{Options, lower};
    use crate::syntax;

    fn reach(listing: &str) -> (Plan, Reach) {
        let mut sources = SourceMap::new();
        let parsed = syntax::parse(sources.add("test", listing).unwrap());
        let plan = Plan::new(&lower(&parsed.program.unwrap(), &Options::default()).unwrap());
        let reach = Reach::new(&plan, &[]);
        (plan, reach)
    }

    #[test]
    fn the_limit_is_the_greatest_at_which_nothing_overflows() {
        // The last of these reads the 8th power: of 65536 that is 2¹²⁸, of 4096 it is 2⁹⁶.
        let squares = "mul r0, v0, v0\n".to_owned() + &"mul r0, r0, r0\n".repeat(3);
        let (plan, reach) = reach(&format!("vs.1.1\n{squares}mov oPos, r0\n"));
        assert_eq!(reach.limit, 4096.0);
        assert!((0..plan.steps.len()).all(|step| reach.is_finite(step)));
        assert!(!reach.is_finite(plan.steps.len()));
    }

    #[test]
    fn behind_a_reciprocal_anything_may_come() {
        let (plan, reach) = reach(
            "vs.1.1\nmul r0, v0, v0\nrcp r1.x, r0.x\nmul r2, r0, r1.x\nmin r3, r2, r0\nmov oPos, r3\n",
        );
        let finite = |op: RowOp| {
            let of_op = plan
                .steps
                .iter()
                .enumerate()
                .filter(|(_, step)| step.op == op);
            of_op
                .map(|(number, _)| reach.is_finite(number))
                .collect::<Vec<_>>()
        };
        assert_eq!(finite(RowOp::Mul), [true, false]);
        assert_eq!(finite(RowOp::Min), [false]);
        // What does not help is not waited for.
        assert_eq!(reach.limit, 65536.0);
    }

    #[test]
    fn what_is_no_number_is_not_within_a_limit() {
        let reach = Reach {
            limit: 2.0,
            finite: Vec::new(),
        };
        for (number, admitted) in [
            (-2.0, true),
            (0.0, true),
            (2.5, false),
            (f32::NAN, false),
            (-f32::NAN, false),
            (f32::NEG_INFINITY, false),
        ] {
            let mut greatest = [0; 8];
            raise(&mut greatest, &[0.5, number, -1.0, 0.0]);
            assert_eq!(reach.admits(&greatest), admitted, "{number}");
        }
    }
}

//! One step of a plan.

use super::rows::Rows;
use super::samples::Samples;
use crate::exec::environment::{Environment, STAGES, Stage};
use crate::isa::{ResultModifier, SourceModifier};
use crate::kernel::{NO_ROW, Plan, Row, RowFinish, RowOp, RowStep};
use crate::policy::{Model, ZeroProduct};
use crate::semantics::{self, Finish, Ieee, OfFinite, Products, ZeroWins};
use crate::simd::Simd;

/// How a step is taken.
#[derive(Clone, Copy)]
pub(super) struct Turn {
    /// The number of the step in its plan.
    pub(super) number: usize,
    /// The lanes from here on may hold anything afterwards.
    pub(super) lanes: usize,
    /// Whether all that it reads is finite.
    pub(super) finite: bool,
    /// What samples are compiled for.
    pub(super) simd: Simd,
}

/// Takes a step.
#[inline(always)]
pub(super) fn take<const N: usize>(
    rows: &mut Rows<N>,
    killed: &mut [bool; N],
    plan: &Plan,
    step: &RowStep,
    environment: &Environment<'_>,
    samples: &mut Samples<N>,
    turn: Turn,
) {
    let ieee = plan.policies.zero_product == ZeroProduct::Ieee;
    let factors = match (ieee, turn.finite) {
        (true, _) => Factors::Ieee,
        (false, true) => Factors::Finite,
        (false, false) => Factors::Any,
    };
    let of_zero = plan.policies.of_zero;
    let bump = |stage: u8| environment.stages[usize::from(stage) % STAGES].bump;
    let mut on = On { rows, plan, step };
    use semantics as is;
    match step.op {
        RowOp::Mov => on.each(|[a]| a),
        // Nothing is done to what an operand reads, denormal or not; each modifier has a loop of its own.
        RowOp::Modify(modifier) => match modifier {
            SourceModifier::Negate => on.items(|[a]| is::modify(SourceModifier::Negate, a)),
            SourceModifier::Bx2 => on.items(|[a]| is::modify(SourceModifier::Bx2, a)),
            SourceModifier::X2 => on.items(|[a]| is::modify(SourceModifier::X2, a)),
            SourceModifier::Complement => on.items(|[a]| is::modify(SourceModifier::Complement, a)),
            SourceModifier::Bias => on.items(|[a]| is::modify(SourceModifier::Bias, a)),
            modifier => on.items(|[a]| is::modify(modifier, a)),
        },
        RowOp::Operand(model, modifier) => on.items(|[a]| is::operand(model, modifier, a)),
        RowOp::Add => on.each(|[a, b]| a + b),
        RowOp::Sub => on.each(|[a, b]| a - b),
        RowOp::Mul => on.products(
            factors,
            |[a, b]| Ieee::product(a, b),
            |[a, b]| OfFinite::product(a, b),
            |[a, b]| ZeroWins::product(a, b),
        ),
        RowOp::Mad => on.products(
            factors,
            |[a, b, c]| is::mad::<Ieee>(a, b, c),
            |[a, b, c]| is::mad::<OfFinite>(a, b, c),
            |[a, b, c]| is::mad::<ZeroWins>(a, b, c),
        ),
        RowOp::Lrp => on.products(
            factors,
            |[a, b, c]| is::lrp::<Ieee>(a, b, c),
            |[a, b, c]| is::lrp::<OfFinite>(a, b, c),
            |[a, b, c]| is::lrp::<ZeroWins>(a, b, c),
        ),
        RowOp::Dp3 => on.products(
            factors,
            |[a, b, c, d, e, f]| is::dp3::<Ieee>([a, b, c], [d, e, f]),
            |[a, b, c, d, e, f]| is::dp3::<OfFinite>([a, b, c], [d, e, f]),
            |[a, b, c, d, e, f]| is::dp3::<ZeroWins>([a, b, c], [d, e, f]),
        ),
        RowOp::Dp4 => on.products(
            factors,
            |[a, b, c, d, e, f, g, h]| is::dp4::<Ieee>([a, b, c, d], [e, f, g, h]),
            |[a, b, c, d, e, f, g, h]| is::dp4::<OfFinite>([a, b, c, d], [e, f, g, h]),
            |[a, b, c, d, e, f, g, h]| is::dp4::<ZeroWins>([a, b, c, d], [e, f, g, h]),
        ),
        RowOp::Min => on.each(|[a, b]| is::min(a, b)),
        RowOp::Max => on.each(|[a, b]| is::max(a, b)),
        RowOp::Slt => on.seldom(|[a, b]| is::slt(a, b)),
        RowOp::Sge => on.seldom(|[a, b]| is::sge(a, b)),
        RowOp::Frc => on.seldom(|[a]| is::frc(a)),
        RowOp::Address => on.seldom(|[a]| is::address(a)),
        RowOp::Cnd => on.each(|[a, b, c]| is::cnd(a, b, c)),
        RowOp::Cmp => on.each(|[a, b, c]| is::cmp(a, b, c)),
        RowOp::Rcp => on.seldom(|[a]| is::rcp(of_zero, a)),
        RowOp::Rsq => on.seldom(|[a]| is::rsq(of_zero, a)),
        RowOp::Exp => on.seldom(|[a]| is::exp(a)),
        RowOp::Log => on.seldom(|[a]| is::log(of_zero, a)),
        RowOp::ExpP(component) => on.seldom(|[a]| is::expp(a)[usize::from(component) & 3]),
        RowOp::LogP(component) => {
            on.seldom(|[a]| is::logp(of_zero, a)[usize::from(component) & 3]);
        }
        RowOp::LitDiffuse => on.seldom(|[x]| is::lit::<ZeroWins>([x, 0.0, 0.0, 0.0])[1]),
        RowOp::LitSpecular if ieee => on.seldom(|[x, y, w]| is::lit::<Ieee>([x, y, 0.0, w])[2]),
        RowOp::LitSpecular => on.seldom(|[x, y, w]| is::lit::<ZeroWins>([x, y, 0.0, w])[2]),
        RowOp::Divide => on.seldom(|[a, b]| is::divide(a, b)),
        RowOp::Bump(stage, component) => {
            let state = bump(stage);
            on.seldom(|[x, y, u, v]| is::bump([x, y], [u, v], &state)[usize::from(component) & 1]);
        }
        RowOp::Luminance(stage, model) => {
            let state = bump(stage);
            on.seldom(|[a, b]| is::luminance(model, a, b, &state));
        }
        RowOp::Depth => on.seldom(|[a, b]| is::depth(a, b)),
        RowOp::Reflect => on.reflect(),
        RowOp::Sample(stage) => {
            let stage = &environment.stages[usize::from(stage) % STAGES];
            on.sample(samples, turn, stage);
        }
        RowOp::Kill => {
            for (_, sources) in plan.items(step) {
                let row = sources.first().and_then(|row| on.rows.get(*row));
                for (killed, number) in killed.iter_mut().zip(row.into_iter().flatten()) {
                    // −0 and NaN do not kill.
                    *killed |= *number < 0.0;
                }
            }
        }
        RowOp::Relative(offset, component) => {
            let constant = |a0: f32| {
                let index = usize::try_from(a0 as i64 + i64::from(offset)).ok();
                let constant = index.and_then(|index| environment.constants.get(index));
                constant.map_or(0.0, |constant| constant[usize::from(component) & 3])
            };
            on.items(|[a0]| constant(a0));
        }
    }
    if step.writes != Model::Float {
        on.hold();
    }
}

/// What is known of the factors of products, or that it does not matter.
#[derive(Clone, Copy)]
enum Factors {
    /// Products are those of IEEE 754.
    Ieee,
    /// No infinity, no NaN.
    Finite,
    /// Nothing.
    Any,
}

/// A step with what it works on.
struct On<'a, const N: usize> {
    rows: &'a mut Rows<N>,
    plan: &'a Plan,
    step: &'a RowStep,
}

impl<const N: usize> On<'_, N> {
    /// The same operation on each lane of each item, behind it what the step does to results. One loop for results that only
    /// lose their denormal numbers, which are nearly all.
    #[inline(always)]
    fn each<const S: usize>(&mut self, f: impl Fn([f32; S]) -> f32) {
        match self.step.finish {
            RowFinish::Keep | RowFinish::Flush => {
                self.items(|sources| semantics::flush(f(sources)))
            }
            RowFinish::Full(_) => self.seldom(f),
        }
    }

    /// The same for operations that are made of products, by what is known of these.
    #[inline(always)]
    fn products<const S: usize>(
        &mut self,
        factors: Factors,
        ieee: impl Fn([f32; S]) -> f32,
        finite: impl Fn([f32; S]) -> f32,
        any: impl Fn([f32; S]) -> f32,
    ) {
        match factors {
            Factors::Ieee => self.seldom(ieee),
            Factors::Finite => self.each(finite),
            Factors::Any => self.each(any),
        }
    }

    /// The same with one loop for everything, for operations that are seldom many.
    #[inline(always)]
    fn seldom<const S: usize>(&mut self, f: impl Fn([f32; S]) -> f32) {
        let finish = Finish::new(match self.step.finish {
            RowFinish::Keep | RowFinish::Flush => ResultModifier::NONE,
            RowFinish::Full(modifier) => modifier,
        });
        self.items(|sources| finish.apply(f(sources)));
    }

    #[inline(always)]
    fn items<const S: usize>(&mut self, f: impl Fn([f32; S]) -> f32) {
        for item in self.plan.operands(self.step).chunks_exact(S + 1) {
            if let Some((to, from)) = item.split_first()
                && let Some(from) = from.first_chunk::<S>()
                && let Some(results) = self.rows.each_lane(*from, &f)
            {
                self.rows.set(*to, &results);
            }
        }
    }

    /// Several results at once.
    #[inline(always)]
    fn several<const S: usize, const R: usize>(
        &mut self,
        f: impl Fn([&[f32; N]; S]) -> [[f32; N]; R],
    ) {
        let none = [0.0; N];
        for (results, sources) in self.plan.items(self.step) {
            let values = f(std::array::from_fn(|i| {
                let row = sources.get(i).and_then(|row| self.rows.get(*row));
                row.unwrap_or(&none)
            }));
            self.leave(results, &values);
        }
    }

    /// Writes results, each behind what the step does to it.
    #[inline(always)]
    fn leave(&mut self, results: &[Row], values: &[[f32; N]]) {
        match self.step.finish {
            RowFinish::Keep | RowFinish::Flush => {
                self.rows.store(results, values, semantics::flush);
            }
            RowFinish::Full(modifier) => {
                let finish = Finish::new(modifier);
                self.rows.store(results, values, |x| finish.apply(x));
            }
        }
    }

    #[inline(always)]
    fn sample(&mut self, samples: &mut Samples<N>, turn: Turn, stage: &Stage<'_>) {
        let (plan, none) = (self.plan, [0.0; N]);
        for (results, sources) in plan.items(self.step) {
            let wanted = std::array::from_fn(|i| results.get(i).is_some_and(|row| *row != NO_ROW));
            let coordinates = std::array::from_fn(|i| {
                let row = sources.get(i).and_then(|row| self.rows.get(*row));
                row.unwrap_or(&none)
            });
            self.leave(results, samples.take(turn, stage, coordinates, wanted));
        }
    }

    #[inline(always)]
    fn reflect(&mut self) {
        self.several(|sources: [&[f32; N]; 6]| {
            let mut results = [[0.0; N]; 3];
            for lane in 0..N {
                let [a, b, c, d, e, f] = sources.map(|row| row[lane]);
                let mirrored = semantics::reflect([a, b, c], [d, e, f]);
                for (result, number) in results.iter_mut().zip(mirrored) {
                    result[lane] = number;
                }
            }
            results
        });
    }

    /// Results become numbers of the model that holds them.
    #[inline(always)]
    fn hold(&mut self) {
        let model = self.step.writes;
        for (results, _) in self.plan.items(self.step) {
            for row in results {
                self.rows.update(*row, |x| semantics::held(model, x));
            }
        }
    }
}

//! Executors that are right agree on comparable shaders: the interpreter with itself at any number of lanes, and with
//! one that computes the same steps in double precision and rounds nothing.

use super::*;
use crate::isa::SourceModifier;
use crate::kernel::{Op, Operand, Place, SLOT_COUNT, Step};
use crate::texture::sample_at;

/// Any NaN is like any other: its sign and its payload follow from the order in which a compiler lets the hardware add.
fn bits(value: [f32; 4]) -> [u32; 4] {
    value.map(|number| if number.is_nan() { f32::NAN } else { number }.to_bits())
}

#[test]
fn lanes_do_not_see_each_other() {
    let textures = Textures::new().unwrap();
    for version in Version::all() {
        for seed in 0..400 {
            let made = made(seed, &options(version, seed), &textures);
            let kernel = made.lower(&made.program).unwrap();
            let environment = made.environment(&kernel, &textures);
            let mut quad = Machine::<INVOCATIONS>::new();
            made.load(&mut quad, 0);
            quad.run(&kernel, &environment);
            for lane in 0..INVOCATIONS {
                let mut single = Machine::<1>::new();
                made.load(&mut single, lane);
                single.run(&kernel, &environment);
                for slot in Slot::all() {
                    let (a, b) = (single.lane(slot, 0), quad.lane(slot, lane));
                    assert_eq!(
                        bits(a),
                        bits(b),
                        "{version} seed {seed} {slot:?}\n{}",
                        made.listing
                    );
                }
                assert_eq!(single.killed()[0], made.killed[lane]);
            }
        }
    }
}

/// One invocation in double precision.
struct Exact<'a> {
    registers: Vec<[f64; 4]>,
    environment: Environment<'a>,
    killed: bool,
}

fn mul(a: f64, b: f64) -> f64 {
    if a == 0.0 || b == 0.0 { 0.0 } else { a * b }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| mul(*a, *b)).sum()
}

fn over(a: f64, b: f64) -> f64 {
    if b == 0.0 { 1.0 } else { a / b }
}

impl Exact<'_> {
    fn operand(&self, operand: &Operand) -> [f64; 4] {
        let constants = &self.environment.constants;
        let constant = |index: i64| {
            let at = usize::try_from(index).unwrap_or(usize::MAX);
            constants
                .get(at)
                .copied()
                .unwrap_or_default()
                .map(f64::from)
        };
        let register = match operand.place {
            Place::Slot(slot) => self.registers[slot.index()],
            Place::Constant(index) => constant(index.into()),
            Place::Relative(offset) => {
                let a0 = self.registers[Slot::ADDRESS.index()][0];
                constant(a0 as i64 + i64::from(offset))
            }
            Place::Literal(x) => [f64::from(x); 4],
        };
        std::array::from_fn(|i| {
            let x = register[operand.swizzle.slot(i)];
            match operand.modifier {
                SourceModifier::None | SourceModifier::Dz | SourceModifier::Dw => x,
                SourceModifier::Negate => -x,
                SourceModifier::Bias => x - 0.5,
                SourceModifier::BiasNegate => 0.5 - x,
                SourceModifier::Bx2 => 2.0 * x - 1.0,
                SourceModifier::Bx2Negate => 1.0 - 2.0 * x,
                SourceModifier::Complement => 1.0 - x,
                SourceModifier::X2 => 2.0 * x,
                SourceModifier::X2Negate => -2.0 * x,
            }
        })
    }

    fn step(&mut self, step: &Step) -> [f64; 4] {
        let mut sources = [[0.0; 4]; 3];
        for (source, operand) in sources.iter_mut().zip(&step.sources) {
            *source = self.operand(operand);
        }
        let [a, b, c] = sources;
        let each = |f: &dyn Fn(usize) -> f64| std::array::from_fn(f);
        // What stands for infinity behind 0.
        const LARGEST: f64 = f32::MAX as f64;
        match step.op {
            Op::Rcp | Op::Rsq if a[0] == 0.0 => [LARGEST; 4],
            Op::Log if a[0] == 0.0 => [-LARGEST; 4],
            Op::LogP if a[0] == 0.0 => [-LARGEST, 1.0, -LARGEST, 1.0],
            Op::Mov => a,
            Op::Add => each(&|k| a[k] + b[k]),
            Op::Sub => each(&|k| a[k] - b[k]),
            Op::Mul => each(&|k| mul(a[k], b[k])),
            Op::Mad => each(&|k| mul(a[k], b[k]) + c[k]),
            // The other of the two documented forms.
            Op::Lrp => each(&|k| mul(a[k], b[k] - c[k]) + c[k]),
            Op::Min => each(&|k| if a[k] < b[k] { a[k] } else { b[k] }),
            Op::Max => each(&|k| if a[k] >= b[k] { a[k] } else { b[k] }),
            Op::Slt => each(&|k| f64::from(u8::from(a[k] < b[k]))),
            Op::Sge => each(&|k| f64::from(u8::from(a[k] >= b[k]))),
            Op::Frc => each(&|k| a[k] - a[k].floor()),
            Op::Floor => each(&|k| a[k].floor()),
            Op::Cnd => each(&|k| if a[k] > 0.5 { b[k] } else { c[k] }),
            Op::Cmp => each(&|k| if a[k] >= 0.0 { b[k] } else { c[k] }),
            Op::Dp3 => [dot(&a[..3], &b[..3]); 4],
            Op::Dp4 => [dot(&a, &b); 4],
            Op::Rcp => [1.0 / a[0]; 4],
            Op::Rsq => [1.0 / a[0].abs().sqrt(); 4],
            Op::Exp => [a[0].exp2(); 4],
            Op::Log => [a[0].abs().log2(); 4],
            Op::ExpP => [a[0].floor().exp2(), a[0] - a[0].floor(), a[0].exp2(), 1.0],
            Op::LogP => {
                let exponent = a[0].abs().log2().floor();
                [
                    exponent,
                    a[0].abs() / exponent.exp2(),
                    a[0].abs().log2(),
                    1.0,
                ]
            }
            Op::Lit => {
                let power = a[3].clamp(-127.996_09, 127.996_09);
                let both = a[0] > 0.0 && a[1] > 0.0;
                [
                    1.0,
                    a[0].max(0.0),
                    if both { a[1].powf(power) } else { 0.0 },
                    1.0,
                ]
            }
            Op::Dst => [1.0, mul(a[1], b[1]), a[2], b[3]],
            Op::DivideZ => [over(a[0], a[2]), over(a[1], a[2]), 0.0, 0.0],
            Op::DivideW => [over(a[0], a[3]), over(a[1], a[3]), 0.0, 0.0],
            Op::Project(by) => {
                let by = a[usize::from(by)];
                [over(a[0], by), over(a[1], by), over(a[2], by), 0.0]
            }
            Op::Bump(stage) => {
                let m = self.environment.stages[usize::from(stage)].bump.matrix;
                let m = m.map(f64::from);
                let u = a[0] + m[0] * b[0] + m[2] * b[1];
                [u, a[1] + m[1] * b[0] + m[3] * b[1], a[2], a[3]]
            }
            Op::Luminance(stage) => {
                let bump = &self.environment.stages[usize::from(stage)].bump;
                let scale = f64::from(bump.luminance_scale);
                a.map(|x| x * (b[2] * scale + f64::from(bump.luminance_offset)))
            }
            Op::Reflect => {
                let scale = 2.0 * dot(&a[..3], &b[..3]) / dot(&a[..3], &a[..3]);
                each(&|k| if k < 3 { scale * a[k] - b[k] } else { 0.0 })
            }
            Op::Sample(stage) => {
                let stage = &self.environment.stages[usize::from(stage)];
                let at = [a[0], a[1], a[2]].map(|x| x as f32);
                sample_at(stage.texture, &stage.sampler, at, 0.0).map(f64::from)
            }
            Op::Kill => {
                self.killed |= a[..3].iter().any(|x| *x < 0.0);
                [0.0; 4]
            }
            Op::Depth => [over(a[0], a[1]).clamp(0.0, 1.0); 4],
        }
    }

    fn run(&mut self, kernel: &Kernel) {
        for (slot, value) in &kernel.presets {
            self.registers[slot.index()] = value.map(f64::from);
        }
        let mut waiting: Vec<(&Step, [f64; 4])> = Vec::new();
        for step in &kernel.steps {
            let result = self.step(step);
            waiting.push((step, result));
            if step.held {
                continue;
            }
            for (step, result) in waiting.drain(..).filter(|(s, _)| s.op != Op::Kill) {
                for c in step.mask.components() {
                    let x = result[c] * 2.0_f64.powi(step.result.shift.into());
                    let x = if step.result.saturate {
                        x.clamp(0.0, 1.0)
                    } else {
                        x
                    };
                    self.registers[step.destination.index()][c] = x;
                }
            }
        }
    }
}

#[test]
fn double_precision_comes_within_the_bounds() {
    let textures = Textures::new().unwrap();
    let (mut compared, mut exact) = (0, 0);
    for version in Version::all() {
        for seed in 0..1500 {
            let made = made(seed, &Options::new(version), &textures);
            let kernel = made.lower(&made.program).unwrap();
            for lane in 0..INVOCATIONS {
                let mut run = Exact {
                    registers: vec![[0.0; 4]; SLOT_COUNT],
                    environment: made.environment(&kernel, &textures),
                    killed: false,
                };
                for (slot, values) in &made.inputs {
                    run.registers[slot.index()] = values[lane].map(f64::from);
                }
                run.run(&kernel);
                let place = format!("{version} seed {seed} lane {lane}\n{}", made.listing);
                assert_eq!(run.killed, made.killed[lane], "{place}");
                for outcome in &made.outcomes {
                    for c in outcome.mask.components() {
                        let here = f64::from(outcome.values[lane][c]);
                        let there = run.registers[outcome.slot.index()][c];
                        let bound = f64::from(outcome.errors[lane][c]);
                        // Numbers that are not normal are flushed.
                        let apart = (here - there).abs() - f64::from(f32::MIN_POSITIVE);
                        assert!(
                            apart <= bound,
                            "{:?} {c}: {here} and {there} are further apart than {bound}\n{place}",
                            outcome.slot
                        );
                        compared += 1;
                        exact += u32::from(bound == 0.0);
                    }
                }
            }
        }
    }
    // The bounds say something: many results are exact, and none is looser than the options allow.
    assert!(
        compared > 100_000 && exact > compared / 20,
        "{exact} of {compared}"
    );
}

#[test]
fn bounds_stay_within_what_the_options_allow() {
    let textures = Textures::new().unwrap();
    for version in Version::all() {
        let options = Options::new(version);
        for seed in 0..300 {
            let made = made(seed, &options, &textures);
            for outcome in &made.outcomes {
                for lane in 0..INVOCATIONS {
                    for c in outcome.mask.components() {
                        let value = f64::from(outcome.values[lane][c]).abs();
                        let error = f64::from(outcome.errors[lane][c]);
                        // The reciprocal of 0 is the same everywhere.
                        let endless = value == f64::from(f32::MAX) && error == 0.0;
                        assert!(value <= options.largest_value || endless);
                        // 1.0001: the bound is rounded to a float.
                        assert!(error <= 1.0001 * options.largest_error * value.max(1.0));
                    }
                }
            }
        }
    }
}

/// The thresholds themselves: 0.5 for `cnd` and 0 for `cmp` are exact, so that a shader may ask about them, and a sum
/// that is rounded and near to them is refused.
#[test]
fn thresholds_are_met_exactly_or_not_at_all() {
    use super::super::approx::Approx;
    let r = Precision::default().rounding;
    let half = Approx::exact(0.25).plus(Approx::exact(0.25), r);
    assert_eq!(half, Approx::exact(0.5));
    assert!(half.apart_from(0.5));
    // 0.1 and 0.4 are no floats of few bits: 0.5 ± 4·2⁻²³·0.5 may be on either side.
    let rounded = Approx::exact(0.1).plus(Approx::exact(0.4), r);
    assert!(!rounded.apart_from(0.5) && rounded.apart_from(0.6));
    // 1 / 3 is rounded: within 4·2⁻²³ of its size.
    let third = Approx::ONE.over(Approx::exact(3.0), r).unwrap();
    assert!((third.error - r / 3.0).abs() < 1e-12);
    assert_eq!(Approx::ONE.over(Approx::new(0.001, 0.0006), r), None);
    // 2 · 3, off by 0.1 and 0.2: 2·0.2 + 3·0.1 + 0.1·0.2 = 0.72, and the rounding of 6.
    let product = Approx::new(2.0, 0.1).times(Approx::new(3.0, 0.2), r);
    assert!((product.error - (0.72 + 6.0 * r)).abs() < 1e-12);
}

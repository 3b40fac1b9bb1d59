//! Batches against machines: the same bits, for every number of lanes and every set of instructions.

use super::*;
use crate::exec::{Machine, bind_constants};
use crate::generate::{self, Generated, INVOCATIONS, Random, Textures};
use crate::isa::{ShaderKind, Version};
use crate::kernel::{self, Kernel, lower};
use crate::policy::{LogpLayout, Model, OfZero, Policies, ScalarSlot, ZeroProduct};

/// The bits of a number; NaN has no sign and no content.
fn bits(number: f32) -> u32 {
    match number.is_nan() {
        true => f32::NAN.to_bits(),
        false => number.to_bits(),
    }
}

/// What a listing is lowered with, at random.
fn options(random: &mut Random, shader: &Generated) -> kernel::Options {
    let mut one_of = |chance| random.chance(chance);
    let policies = Policies {
        zero_product: match one_of(30) {
            true => ZeroProduct::Ieee,
            false => ZeroProduct::Zero,
        },
        of_zero: match one_of(30) {
            true => OfZero::Infinity,
            false => OfZero::Largest,
        },
        scalar: match one_of(30) {
            true => ScalarSlot::X,
            false => ScalarSlot::W,
        },
        logp: match one_of(30) {
            true => LogpLayout::Logarithm,
            false => LogpLayout::Parts,
        },
        ..Policies::default()
    };
    kernel::Options {
        model: random
            .pick(&[Model::Float, Model::Float, Model::Gf3, Model::R200])
            .unwrap(),
        policies,
        projection: std::array::from_fn(|i| shader.stages[i].projection),
    }
}

/// Runs a kernel on both, on the inputs of the shader and others like them, and compares what is left.
fn agree<const N: usize>(
    random: &mut Random,
    shader: &Generated,
    kernel: &Kernel,
    plan: &Plan,
    textures: &Textures,
) {
    let environment = shader.environment(kernel, textures);
    let mut machine = Machine::<N>::new();
    // What is infinite or NaN in one lane must not change the others, nor what a zero makes of it.
    let wild = random.chance(25);
    for (slot, values) in &shader.inputs {
        for lane in 0..N {
            let mut value = values[lane % INVOCATIONS];
            if lane >= INVOCATIONS {
                value.rotate_left(random.below(4) as usize);
                if random.chance(10) {
                    // Denormal numbers must become zero where they pass a step, and nowhere else.
                    value[0] = f32::MIN_POSITIVE / 3.0;
                }
                if wild && random.chance(10) {
                    let wild = [f32::INFINITY, f32::NEG_INFINITY, f32::NAN, -1e30, 3e5, -0.0];
                    value[random.below(4) as usize] = random.pick(&wild).unwrap();
                }
            }
            machine.set_lane(*slot, lane, value);
        }
    }
    let inputs = machine.clone();
    machine.run(kernel, &environment);
    // Quads are whole; the last of them may be missing.
    let live = match N {
        64 => 4 * (1 + random.below(16) as usize),
        _ => N,
    };
    for simd in Simd::ALL {
        let mut batch = Batch::<N>::default();
        batch.load(plan, &environment);
        // The second run must find everything as the first did.
        for _ in 0..2 {
            batch.input(plan, |slot, c| inputs.register(slot).get(c));
            batch.run(simd, plan, &environment, live);
        }
        let (killed, of_machine) = (&batch.killed()[..live], &machine.killed()[..live]);
        assert_eq!(killed, of_machine, "{}", shader.listing);
        let outputs = plan.outputs.iter().map(|(slot, _)| *slot);
        for slot in outputs {
            let left = batch.output(plan, slot);
            for (c, expected) in machine.register(slot).iter().enumerate() {
                let Some(left) = left[c] else { continue };
                let place = format!("{} component {c}, {simd}", slot.name(kernel.version.kind()));
                assert_eq!(
                    left.map(bits)[..live],
                    expected.map(bits)[..live],
                    "{place}\n{}\n{:?}\n{plan}",
                    shader.listing,
                    (kernel.model, kernel.policies)
                );
            }
        }
    }
}

#[test]
fn batches_leave_the_bits_that_machines_leave() {
    let textures = Textures::new().unwrap();
    for seed in 0..1400 {
        let version = Version::all()
            .nth(seed as usize % Version::all().count())
            .unwrap();
        let mut random = Random::new(seed);
        let options_of_shader = generate::Options {
            comparable: false,
            ..generate::Options::new(version)
        };
        let shader = generate::shader(&mut random, &options_of_shader, &textures);
        let kernel = lower(&shader.program, &options(&mut random, &shader)).unwrap();
        let plan = Plan::new(&kernel);
        agree::<1>(&mut random, &shader, &kernel, &plan, &textures);
        agree::<4>(&mut random, &shader, &kernel, &plan, &textures);
        agree::<64>(&mut random, &shader, &kernel, &plan, &textures);
    }
}

/// Every output of the shader is there, and no component is missing.
#[test]
fn outputs_are_whole() {
    let textures = Textures::new().unwrap();
    for version in Version::all() {
        let options = generate::Options::new(version);
        let shader = generate::shader(&mut Random::new(7), &options, &textures);
        let kernel = shader.lower(&shader.program).unwrap();
        let plan = Plan::new(&kernel);
        let mut batch = Batch::<4>::default();
        let constants = bind_constants(&kernel, &shader.constants);
        let environment = Environment {
            constants,
            ..Environment::default()
        };
        batch.load(&plan, &environment);
        let outputs: &[Slot] = match version.kind() {
            ShaderKind::Pixel => &[Slot::R0],
            ShaderKind::Vertex => &[Slot::POSITION, Slot::FOG, Slot::POINT_SIZE],
        };
        for slot in outputs {
            assert!(batch.output(&plan, *slot).iter().all(Option::is_some));
        }
        assert_eq!(batch.output(&plan, Slot::ADDRESS), [None; 4]);
    }
}

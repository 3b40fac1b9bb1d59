//! The numbers that shaders are run with.

use super::Random;

/// Numbers at which something changes, all exact in few bits.
const EXACT: [f32; 8] = [0.0, -0.0, 0.5, 1.0, -1.0, 2.0, -0.5, 0.25];

/// Numbers on which executors are allowed to differ.
const WILD: [f32; 10] = [
    f32::INFINITY,
    f32::NEG_INFINITY,
    f32::NAN,
    f32::MAX,
    -f32::MAX,
    f32::MIN_POSITIVE,
    1.0e-40,
    1.0e20,
    -1.0e20,
    1.0e-20,
];

/// How often numbers are what, in percent.
#[derive(Clone, Copy)]
pub(super) struct Mixture {
    pub(super) exact: u32,
    pub(super) wild: u32,
}

/// A number from `low` to `high`, half of them in eighths, which sums and products of a few keep exact.
pub(super) fn number(random: &mut Random, mixture: Mixture, low: f32, high: f32) -> f32 {
    if random.chance(mixture.wild) {
        return random.pick(&WILD).unwrap_or_default();
    }
    let value = if random.chance(mixture.exact) {
        random.pick(&EXACT).unwrap_or_default()
    } else {
        let value = random.between(low, high);
        if random.chance(50) {
            (value * 8.0).round() / 8.0
        } else {
            value
        }
    };
    // `max` and `min` would lose the sign of a zero.
    if value < low || value > high {
        random.between(low, high)
    } else {
        value
    }
}

/// Four numbers.
pub(super) fn vector(random: &mut Random, mixture: Mixture, low: f32, high: f32) -> [f32; 4] {
    std::array::from_fn(|_| number(random, mixture, low, high))
}

/// A register of every invocation: all unlike, or all near to the first, so that they take the same way at most
/// comparisons and lie on the same face of a cube.
pub(super) fn spread<const N: usize>(
    random: &mut Random,
    mixture: Mixture,
    low: f32,
    high: f32,
) -> [[f32; 4]; N] {
    let first = vector(random, mixture, low, high);
    let near = random.chance(60);
    std::array::from_fn(|lane| {
        if lane == 0 {
            first
        } else if near {
            first.map(|x| {
                let scaled = x * random.between(0.875, 1.125);
                if scaled >= low && scaled <= high {
                    scaled
                } else {
                    x
                }
            })
        } else {
            vector(random, mixture, low, high)
        }
    })
}

//! Generated shaders are valid, varied, the same every time, and as comparable as they say.

mod coverage;
mod executors;
mod shrinking;

use super::*;
use crate::diagnostic::SourceMap;
use crate::policy::Dialect;
use crate::validate::validate;

/// The shader of a seed.
fn made(seed: u64, options: &Options, textures: &Textures) -> Generated {
    shader(&mut Random::new(seed), options, textures)
}

/// Options of a version, every second time for shaders that are not comparable.
fn options(version: Version, seed: u64) -> Options {
    Options {
        comparable: seed.is_multiple_of(2),
        ..Options::new(version)
    }
}

/// The program of a text that can be read.
fn program(text: &str) -> Program {
    let mut sources = SourceMap::new();
    let parsed = syntax::parse(sources.add("test", text).unwrap());
    assert_eq!(parsed.diagnostics, [], "{text}");
    parsed.program.unwrap()
}

/// The first numbers of the published SplitMix64 from the seed 1234567; a `Random` gives their high halves.
#[test]
fn random_numbers_are_those_of_the_published_generator() {
    let published: [u64; 5] = [
        6_457_827_717_110_365_317,
        3_203_168_211_198_807_973,
        9_817_491_932_198_370_423,
        4_593_380_528_125_082_431,
        16_408_922_859_458_223_821,
    ];
    let mut random = Random::new(1_234_567);
    for number in published {
        assert_eq!(random.bits(), (number >> 32) as u32);
    }
}

#[test]
fn random_choices_keep_to_their_bounds_and_weights() {
    let mut random = Random::new(1);
    assert_eq!(random.below(0), 0);
    assert_eq!(random.pick::<u8>(&[]), None);
    assert_eq!(random.weighted(&[(1, 0), (2, 0)]), None);
    let mut counts = [0_u32; 3];
    for _ in 0..10_000 {
        assert!(random.below(3) < 3);
        assert!((-2.0..=5.0).contains(&random.between(-2.0, 5.0)));
        counts[random.weighted(&[(0, 1), (1, 0), (2, 3)]).unwrap()] += 1;
    }
    // A quarter of 10,000 is 2,500 with a standard deviation of 43; five of them are 217.
    assert_eq!(counts[1], 0);
    assert!(counts[0].abs_diff(2500) < 217, "{counts:?}");
    assert!((0..100).all(|_| random.chance(100) && !random.chance(0)));
}

#[test]
fn generated_shaders_break_no_rule_and_read_back() {
    let textures = Textures::new().unwrap();
    for version in Version::all() {
        for seed in 0..1000 {
            let made = made(seed, &options(version, seed), &textures);
            let found = validate(&made.program, Dialect::D3d8);
            assert_eq!(found, [], "{version} seed {seed}\n{}", made.listing);
            assert_eq!(
                program(&made.listing),
                made.program,
                "{version} seed {seed}"
            );
            assert_eq!(syntax::print(&made.program), made.listing);
            assert!(!made.outcomes.is_empty());
        }
    }
}

#[test]
fn a_seed_gives_the_same_shader_again() {
    let textures = Textures::new().unwrap();
    for version in Version::all() {
        let mut listings = Vec::new();
        for seed in 0..50 {
            let options = options(version, seed);
            let (a, b) = (
                made(seed, &options, &textures),
                made(seed, &options, &textures),
            );
            assert_eq!(a.listing, b.listing);
            // NaN among wild inputs is not equal to itself, its text is.
            assert_eq!(format!("{a:?}"), format!("{b:?}"));
            listings.push(a.listing);
        }
        listings.sort();
        listings.dedup();
        assert!(listings.len() > 45, "{version}: {}", listings.len());
    }
}

//! The comparison without a device.

use super::*;
use crate::case::Case;
use crate::generate::Precision;
use crate::policy::Policy;
use crate::scene::{LoadOptions, Resolver};

struct Nothing;

impl Resolver for Nothing {
    fn read(&self, path: &str) -> std::io::Result<Vec<u8>> {
        panic!("{path}")
    }
}

fn plan(count: u64) -> Plan {
    Plan {
        count,
        seed: 7,
        versions: Version::all().collect(),
        precision: Precision::default(),
        model: Model::default(),
        policies: Policies::default(),
        weights: Weights::default(),
    }
}

/// A case holds everything that the result depends on: the interpreter meets its own expectations to the bit, also where
/// textures, bump stages and projections are in play.
#[test]
fn mismatches_become_cases_that_the_interpreter_passes() {
    let (mut checked, mut sampled) = (0, 0);
    for number in 0..210 {
        // Models and policies in turns: a case names those that are not the usual ones.
        let model = Model::all().nth(number as usize % 3).unwrap();
        let mut policies = Policies::default();
        for policy in Policy::all() {
            let values = policy.values();
            let value = values[(number / 3) as usize % values.len()].name;
            policies.set(&format!("{}={value}", policy.name)).unwrap();
        }
        let plan = Plan {
            model,
            policies,
            ..plan(210)
        };
        let textures = Textures::with_model(model).unwrap();
        let (version, seed) = plan.shader(number).unwrap();
        let subject = Subject::new(plan.options(version), seed, &textures);
        let mismatch = Mismatch {
            number,
            seed,
            subject,
            differences: vec![Difference::Killed {
                invocation: 0,
                cpu: true,
            }],
        };
        let text = case_text(&mismatch, &textures);
        let exact = (text.lines().filter(|line| !line.starts_with("tol")))
            .map(|line| format!("{line}\n"))
            .collect::<String>();
        let exact = format!("tol = 0\n{exact}");
        sampled += u32::from(exact.contains("[textures."));
        let case = Case::load(
            "case.toml",
            exact.as_bytes(),
            &Nothing,
            &LoadOptions::default(),
        );
        let case = case.unwrap_or_else(|error| panic!("{error}\n{exact}"));
        let verdicts = case.check();
        assert_eq!(verdicts.len(), crate::generate::INVOCATIONS);
        for verdict in verdicts {
            assert!(verdict.passes(), "{verdict:?}\n{exact}");
            checked += 1;
        }
    }
    assert!(checked == 840 && sampled > 60, "{checked} {sampled}");
}

#[test]
fn every_number_of_a_plan_is_in_one_unit() {
    for count in [0, 1, 16, 100, 113, 1000] {
        let plan = plan(count);
        let mut all: Vec<u64> = (0..plan.units())
            .flat_map(|unit| plan.unit(unit))
            .flatten()
            .collect();
        all.sort_unstable();
        assert_eq!(all, (0..count).collect::<Vec<_>>());
    }
}

#[test]
fn seeds_can_be_run_again_alone() {
    let long = plan(1000);
    let mut seeds: Vec<u64> = Vec::new();
    for number in 0..1000 {
        let (version, seed) = long.shader(number).unwrap();
        let alone = Plan {
            count: 1,
            seed,
            versions: vec![version],
            ..long.clone()
        };
        assert_eq!(alone.shader(0), Some((version, seed)));
        assert!(seed < 1 << 53);
        seeds.push(seed);
    }
    seeds.sort_unstable();
    seeds.dedup();
    assert_eq!(seeds.len(), 1000);
}

/// Nothing that the rows of the instruction set allow is out of the generator's reach.
#[test]
fn everything_that_is_possible_is_reached() {
    let textures = Textures::new().unwrap();
    for version in Version::all() {
        let mut coverage = Coverage::default();
        for seed in 0..1500 {
            let subject = Subject::new(plan(1).options(version), seed, &textures);
            coverage.count(&subject.generated, &textures);
        }
        assert_eq!(coverage.missing(version), [], "{version}");
        for group in Group::ALL {
            let (reached, all) = coverage.reached(version, group);
            assert_eq!(reached, all);
        }
    }
}

//! Numeric choices on the GPU, and generated shaders under every model and every value of a policy. Known answers are in the
//! cases of `tests/conformance/policies`; here what a case cannot hold.

use std::collections::BTreeMap;

use texcrd::generate::{Precision, Textures, Weights};
use texcrd::gpu::Renderer;
use texcrd::isa::{Opcode, ShaderKind, Version, VersionSet};
use texcrd::matching::{self, Plan, Report};
use texcrd::policy::{Model, Policies, Policy};
use texcrd::scene::{LoadOptions, RenderOptions, Scene};

fn plan(versions: impl Iterator<Item = Version>) -> Plan {
    Plan {
        count: 210,
        seed: 19_991_101,
        versions: versions.collect(),
        precision: Precision::default(),
        model: Model::default(),
        policies: Policies::default(),
        weights: Weights::default(),
    }
}

/// Runs a plan and fails on the first mismatch.
fn agree(plan: &Plan) -> Option<Report> {
    let mut devices = vec![crate::device()?];
    if devices[0].adapter().kind == "software" {
        // It compiles on the thread that draws.
        devices.extend(crate::device());
    }
    let report = matching::run(&devices, plan, None, &|_| ());
    let report = report.unwrap_or_else(|error| panic!("{error}"));
    let textures = Textures::with_model(plan.model).expect("textures of sizes that fit");
    for mismatch in &report.mismatches {
        println!("{}", matching::case_text(mismatch, &textures));
    }
    assert_eq!(
        report.mismatches.len(),
        0,
        "{} {:?}",
        plan.model,
        plan.policies
    );
    assert_eq!(report.shaders, plan.count);
    println!(
        "{} {:?}: {:?}",
        plan.model, plan.policies, report.comparison
    );
    Some(report)
}

fn under(model: Model) {
    let pixel = Version::all().filter(|version| version.kind() == ShaderKind::Pixel);
    let plan = Plan {
        model,
        ..plan(pixel)
    };
    let Some(report) = agree(&plan) else { return };
    // Most numbers are far from the middle between two steps.
    let comparison = &report.comparison;
    assert!(
        comparison.equal * 20 > comparison.numbers * 19,
        "{comparison:?}"
    );
    for version in &plan.versions {
        let missing = report.coverage.missing(*version);
        let rare = |group| group == matching::Group::Masks;
        let missing: Vec<_> = missing.iter().filter(|(group, _)| !rare(*group)).collect();
        assert!(missing.len() < 4, "{version}: {missing:?}");
    }
}

#[test]
fn generated_shaders_match_with_the_numbers_of_the_geforce() {
    under(Model::Gf3);
}

#[test]
fn generated_shaders_match_with_the_numbers_of_the_radeon() {
    under(Model::R200);
}

/// The bounds are not so wide that they would hide another model: with the numbers of one on the CPU and those of another on
/// the GPU hardly a shader passes.
#[test]
fn another_model_is_found() {
    let Some(device) = crate::device() else {
        return;
    };
    for (model, other) in [
        (Model::Gf3, Model::Float),
        (Model::R200, Model::Float),
        (Model::Gf3, Model::R200),
    ] {
        let plan = Plan {
            model,
            ..plan([Version::Ps11, Version::Ps14].into_iter())
        };
        let textures = Textures::with_model(model).expect("textures of sizes that fit");
        let subjects = (0..32).filter_map(|number| {
            let (version, seed) = plan.shader(number)?;
            let mut subject = matching::Subject::new(plan.options(version), seed, &textures);
            subject.generated.model = other;
            Some(subject)
        });
        let subjects: Vec<_> = subjects.collect();
        let mut apart = 0;
        for batch in subjects.chunks(16) {
            let compared = matching::compare(&device, batch, &textures, None);
            let compared = compared.unwrap_or_else(|error| panic!("{error}"));
            apart += compared
                .iter()
                .filter(|c| !c.differences.is_empty())
                .count();
        }
        // Some shaders only move constants that lie on steps of both.
        assert!(apart > 12, "{model} against {other}: {apart} of 32");
    }
}

/// Every value of every policy, with instructions and numbers on which it bears.
#[test]
fn generated_shaders_match_under_every_policy() {
    let wanted: [(&str, &[Opcode]); 5] = [
        (
            "zero-product",
            &[Opcode::Mul, Opcode::Dst, Opcode::Lit, Opcode::Rcp],
        ),
        (
            "rcp-zero",
            &[Opcode::Rcp, Opcode::Rsq, Opcode::Log, Opcode::LogP],
        ),
        (
            "scalar",
            &[Opcode::Rcp, Opcode::Exp, Opcode::ExpP, Opcode::Log],
        ),
        ("logp", &[Opcode::LogP]),
        ("def", &[]),
    ];
    for policy in Policy::all() {
        let found = wanted.iter().find(|(name, _)| *name == policy.name);
        let (_, opcodes) = found.unwrap_or_else(|| panic!("{} is not tested", policy.name));
        for value in policy.values() {
            let mut policies = Policies::default();
            let set = policies.set(&format!("{}={}", policy.name, value.name));
            set.expect("a value of the policy");
            let kinds = match policy.name {
                "def" | "zero-product" => Version::all().collect::<Vec<_>>(),
                _ => VersionSet::VS.iter().collect(),
            };
            let plan = Plan {
                policies,
                weights: Weights {
                    opcodes: opcodes.iter().map(|opcode| (*opcode, 20)).collect(),
                    exact_values: 50,
                    definitions: 60,
                    contested: 60,
                    bare_scalars: 50,
                    ..Weights::default()
                },
                ..plan(kinds.into_iter())
            };
            agree(&plan);
        }
    }
}

/// Definitions from draw to draw, as in the test of the same name on the CPU.
#[test]
fn definitions_stay_for_the_draws_behind() {
    let Some(device) = crate::device() else {
        return;
    };
    let files: BTreeMap<String, Vec<u8>> = [
        ("vs.vsh", "vs.1.1\nmov oPos, v0\n"),
        ("def.psh", "ps.1.1\ndef c0, 1, 0, 0, 1\nmov r0, c0\n"),
        ("read.psh", "ps.1.1\nmov r0, c0\n"),
    ]
    .into_iter()
    .map(|(name, text)| (name.to_owned(), text.as_bytes().to_vec()))
    .collect();
    let draws = [
        ("def.psh", ""),
        ("read.psh", ""),
        ("def.psh", "ps_constants.c0 = [0, 1, 1, 1]"),
        ("read.psh", ""),
    ];
    let mut text = "size = [4, 1]\nclear = [0, 0, 1, 1]\n".to_owned();
    for (place, (ps, set)) in draws.iter().enumerate() {
        let (left, right) = (place as f32 / 2.0 - 1.0, place as f32 / 2.0 - 0.5);
        text.push_str(&format!(
            "[[draw]]\nmesh = \"m{place}\"\nvs = \"vs.vsh\"\nps = \"{ps}\"\n{set}\n[meshes.m{place}]\n\
             positions = [[{left:?}, 1.0, 0.5], [{right:?}, 1.0, 0.5], [{right:?}, -1.0, 0.5], [{left:?}, -1.0, 0.5]]\n\
             indices = [0, 1, 2, 0, 2, 3]\n"
        ));
    }
    for (value, expected) in [
        (
            "when-set",
            [
                [255, 0, 0, 255],
                [255, 0, 0, 255],
                [0, 255, 255, 255],
                [0, 255, 255, 255],
            ],
        ),
        (
            "always",
            [[255, 0, 0, 255], [0; 4], [255, 0, 0, 255], [0; 4]],
        ),
    ] {
        let mut options = LoadOptions::default();
        let set = options.policies.set(&format!("def={value}"));
        set.expect("a value of the policy");
        let scene = Scene::load("scene.toml", text.as_bytes(), &files, &options);
        let scene = scene.unwrap_or_else(|error| panic!("{error}"));
        let options = RenderOptions::default();
        let drawn = Renderer::new(&device).render(&scene, &options, &|_| ());
        let drawn = drawn.unwrap_or_else(|error| panic!("{error}"));
        let pixels: Vec<[u8; 4]> = drawn.pixels().map(|pixel| pixel.0).collect();
        assert_eq!(pixels, expected, "def={value}");
    }
}

//! Hardware models and numeric choices (`registers.md`, section 4): each statement has a case that would notice if it did not hold.

use super::Checklist;
use super::probe::{Line, PROBES, Probe, lines};
use texcrd::case::Case;
use texcrd::isa::{Class, Opcode, RegisterFile, ShaderKind, SourceModifier, Version, VersionSet};
use texcrd::kernel::{Op, Operand, Place, Plan, Slot, lower};
use texcrd::policy::{Model, Policy};
use texcrd::scene::Shader;
use texcrd::texture::{Format, Signed, Texture, TextureKind, Weights};

/// The models of parts, each with the versions that they had.
const PARTS: [(Model, VersionSet); 2] = [
    (Model::Gf3, VersionSet::PS_1_0_TO_1_3),
    (Model::R200, VersionSet::PS_1_4),
];

fn of_model(model: Model) -> impl Iterator<Item = Line<'static>> {
    lines()
        .filter(move |line| line.kind() == ShaderKind::Pixel && line.shader.kernel.model == model)
}

fn class(line: &Line<'_>) -> Option<Class> {
    Some(line.opcode().form(line.version)?.class)
}

/// Every result is clamped and rounded behind each instruction (4.2, 4.3); what texture instructions leave in a register of the
/// Radeon, too.
#[test]
fn results_of_every_instruction() {
    let written = PARTS.into_iter().flat_map(|(model, versions)| {
        let fits = move |opcode: &Opcode| {
            versions.iter().any(|version| {
                opcode.form(version).is_some_and(|form| match form.class {
                    Class::Arithmetic => form.destination.is_some(),
                    Class::Texture => {
                        model == Model::R200 && matches!(opcode, Opcode::TexLd | Opcode::TexCrd)
                    }
                    _ => false,
                })
            })
        };
        let all = Opcode::all().filter(fits);
        all.map(move |opcode| format!("{model} {}", opcode.mnemonic()))
    });
    let mut list = Checklist::new("results of hardware models", written);
    for (model, _) in PARTS {
        for line in of_model(model) {
            let item = format!("{model} {}", line.opcode().mnemonic());
            list.tick(&item, || {
                line.notices_steps(|step| step.writes = Model::Float)
            });
        }
    }
    list.finish();
}

/// What a file of registers is called; none for what a shader does not name.
fn file(operand: &Operand) -> Option<&'static str> {
    let slots = |of: fn(usize) -> Option<Slot>| {
        (0..6)
            .filter_map(of)
            .any(|slot| operand.place == Place::Slot(slot))
    };
    match operand.place {
        Place::Constant(_) => Some("c#"),
        _ if slots(Slot::input) => Some("v#"),
        _ if slots(Slot::texture) => Some("t#"),
        _ => None,
    }
}

/// Arithmetic reads numbers of the model, whatever the register holds (4.2).
#[test]
fn what_arithmetic_reads() {
    let items = ["gf3 v#", "gf3 c#", "gf3 t#", "r200 v#", "r200 c#"];
    let mut list = Checklist::new("files that models read", items.map(str::to_string));
    for (model, _) in PARTS {
        for line in of_model(model).filter(|line| class(line) == Some(Class::Arithmetic)) {
            let steps = line.shader.kernel.steps.iter();
            let sources = steps
                .filter(|s| s.origin == line.number)
                .flat_map(|s| &s.sources);
            let files: Vec<&str> = sources.filter_map(file).collect();
            // Of one file alone, so that it is known what was noticed.
            let Some((first, others)) = files.split_first() else {
                continue;
            };
            if others.iter().all(|other| other == first) {
                list.tick(&format!("{model} {first}"), || {
                    line.notices_steps(|step| step.reads = Model::Float)
                });
            }
        }
    }
    list.finish();
}

/// Mappings of the GeForce 3 clamp first, others do not (4.2, 4.3).
#[test]
fn source_modifiers_of_every_model() {
    use SourceModifier::{Bias, BiasNegate, Bx2, Bx2Negate, Complement};
    let modifiers = [
        (
            Model::Gf3,
            vec![Complement, Bx2, Bx2Negate, Bias, BiasNegate],
        ),
        (Model::R200, vec![Complement, Bx2, Bias]),
        (Model::Float, vec![Complement, Bx2, Bias]),
    ];
    let name = |model: Model, modifier: SourceModifier| format!("{model} {modifier:?}");
    let items = modifiers
        .iter()
        .flat_map(|(model, all)| all.iter().map(|m| name(*model, *m)));
    let mut list = Checklist::new("source modifiers of models", items);
    for (model, all) in &modifiers {
        for line in of_model(*model) {
            // Registers hold steps of the model, so that only the mapping can differ.
            let other = match model {
                Model::Gf3 => Model::Float,
                Model::R200 | Model::Float => Model::Gf3,
            };
            let used = line.instruction.sources.iter();
            let used = used.filter(|s| s.register.file == RegisterFile::Temp);
            for modifier in used.map(|s| s.modifier).filter(|m| all.contains(m)) {
                list.tick(&name(*model, modifier), || {
                    line.notices_steps(|step| step.reads = other)
                });
            }
        }
    }
    list.finish();
}

/// Texture instructions of the GeForce 3 are floats, but for the product of texbeml (4.2).
#[test]
fn texture_instructions_are_floats() {
    let name = |op: Op| match op {
        Op::Sample(_) => Some("coordinates of a dependent read"),
        Op::Dp3 => Some("dot products"),
        Op::Kill => Some("texkill"),
        Op::Depth => Some("depth"),
        Op::Luminance(_) => Some("the factor of texbeml"),
        _ => None,
    };
    let all = [
        Op::Sample(0),
        Op::Dp3,
        Op::Kill,
        Op::Depth,
        Op::Luminance(0),
    ];
    let items = all.into_iter().filter_map(name).map(str::to_string);
    let mut list = Checklist::new("texture instructions of the GeForce 3", items);
    for line in of_model(Model::Gf3).filter(|line| class(line) == Some(Class::Texture)) {
        let steps = line.shader.kernel.steps.iter();
        let ops: Vec<Op> = (steps.filter(|s| s.origin == line.number))
            .map(|s| s.op)
            .collect();
        for op in ops {
            let Some(item) = name(op) else { continue };
            let other = match op {
                Op::Luminance(_) => Model::Float,
                _ => Model::Gf3,
            };
            list.tick(item, || {
                line.notices_steps(|step| {
                    if step.op == op {
                        step.reads = other;
                    }
                })
            });
        }
    }
    list.finish();
}

/// Vertex shaders compute with floats under every model (4.2).
#[test]
fn vertex_shaders_are_floats() {
    let items = PARTS.map(|(model, _)| format!("{model} vertex shaders"));
    let mut list = Checklist::new("vertex shaders under models", items);
    for probe in PROBES.iter().filter(|probe| probe.case.vertex.is_some()) {
        for (model, _) in PARTS {
            let named = probe.path.starts_with(&format!("models/{model}_"));
            list.tick(&format!("{model} vertex shaders"), || {
                named
                    && probe.notices(|case| {
                        let kernel = &mut case.vertex.as_mut().expect("a vertex shader").kernel;
                        kernel.steps.iter_mut().for_each(|step| step.writes = model);
                    })
            });
        }
    }
    list.finish();
}

/// The model that the pixel shader of a case computes with.
fn model_of(probe: &Probe) -> Option<Model> {
    Some(probe.case.pixel.as_ref()?.kernel.model)
}

/// What the largest codes of the channels of a format stand for.
fn largest(format: Format, signed: Signed) -> Option<[f32; 4]> {
    let (kind, ones) = (TextureKind::Texture2D, [[[1.0; 4]]]);
    let made = Texture::from_texels_signed(kind, format, [1, 1, 1], &ones, signed);
    made.ok()?.texel(0, 0, 0, 0, 0)
}

/// Whether a model shows how the signed codes of a format are read: 16 bits are more than the Radeon has.
fn shows(model: Model, format: Format) -> bool {
    let ends = [Signed::Symmetric, Signed::Lopsided].map(|signed| largest(format, signed));
    let least = match (model, model.steps()) {
        (Model::R200, Some(steps)) => 0.5 / steps,
        _ => 0.0,
    };
    match ends {
        [Some(a), Some(b)] => a.into_iter().zip(b).any(|(a, b)| a - b > least),
        _ => false,
    }
}

/// A texture of the same codes that stand for other numbers.
fn decoded_as(texture: &Texture, signed: Signed) -> Texture {
    let here = match signed {
        Signed::Symmetric => Signed::Lopsided,
        Signed::Lopsided => Signed::Symmetric,
    };
    let [from, to] = [here, signed].map(|signed| largest(texture.format(), signed));
    let (from, to) = (from.expect("a signed format"), to.expect("a signed format"));
    let [width, height, _] = texture.size();
    let texels: Vec<[f32; 4]> = (0..height)
        .flat_map(|y| (0..width).filter_map(move |x| texture.texel(0, 0, x, y, 0)))
        .map(|texel| std::array::from_fn(|c| (texel[c] * to[c] / from[c]).max(-1.0)))
        .collect();
    let size = texture.size();
    Texture::from_texels(texture.kind(), Format::Rgba32F, size, &[texels]).expect("the same size")
}

/// Signed texels of every format (4.2).
#[test]
fn signed_texels_of_every_format() {
    let item = |model: Model, format: Format| format!("{model} {}", format.name());
    let items = PARTS.into_iter().flat_map(|(model, _)| {
        let formats = Format::all().filter(move |format| shows(model, *format));
        formats.map(move |format| item(model, format))
    });
    let mut list = Checklist::new("signed formats of models", items);
    for probe in PROBES.iter() {
        let Some(model) = model_of(probe).filter(|_| probe.path.starts_with("models/")) else {
            continue;
        };
        let other = match model {
            Model::Gf3 => Signed::Symmetric,
            Model::Float | Model::R200 => Signed::Lopsided,
        };
        for (number, stage) in probe.case.stages.iter().enumerate() {
            let textures = stage.texture.iter();
            for texture in textures.filter(|texture| shows(model, texture.format())) {
                list.tick(&item(model, texture.format()), || {
                    let changed = decoded_as(texture, other);
                    probe.notices(|case| case.stages[number].texture = Some(changed))
                });
            }
        }
    }
    list.finish();
}

/// Weights of filters, for every kind of texture (4.2).
#[test]
fn filters_of_every_model() {
    let kinds = [
        TextureKind::Texture2D,
        TextureKind::Cube,
        TextureKind::Volume,
    ];
    let item = |model: Model, kind: TextureKind| format!("{model} {kind}");
    let items = Model::all().flat_map(|model| kinds.map(|kind| item(model, kind)));
    let mut list = Checklist::new("filters of models", items.collect::<Vec<_>>());
    for probe in PROBES.iter() {
        let Some(model) = model_of(probe) else {
            continue;
        };
        for (number, stage) in probe.case.stages.iter().enumerate() {
            let Some(texture) = &stage.texture else {
                continue;
            };
            let other = match stage.sampler.weights {
                Weights::Full => Weights::EightBits,
                Weights::EightBits => Weights::Full,
            };
            list.tick(&item(model, texture.kind()), || {
                probe.notices(|case: &mut Case| case.stages[number].sampler.weights = other)
            });
        }
    }
    list.finish();
}

/// What a policy is about (instructions.md; registers.md, 2.2), by kind of shader.
const POLICIES: [(&str, ShaderKind, &[Opcode]); 7] = [
    (
        "zero-product",
        ShaderKind::Vertex,
        &[
            Opcode::Mul,
            Opcode::Mad,
            Opcode::Dp3,
            Opcode::Dp4,
            Opcode::M3x2,
            Opcode::M3x3,
            Opcode::M3x4,
            Opcode::M4x3,
            Opcode::M4x4,
            Opcode::Dst,
            Opcode::Lit,
        ],
    ),
    (
        "zero-product",
        ShaderKind::Pixel,
        &[
            Opcode::Mul,
            Opcode::Mad,
            Opcode::Dp3,
            Opcode::Dp4,
            Opcode::Lrp,
        ],
    ),
    (
        "rcp-zero",
        ShaderKind::Vertex,
        &[Opcode::Rcp, Opcode::Rsq, Opcode::Log, Opcode::LogP],
    ),
    (
        "scalar",
        ShaderKind::Vertex,
        &[
            Opcode::Rcp,
            Opcode::Rsq,
            Opcode::Exp,
            Opcode::Log,
            Opcode::ExpP,
            Opcode::LogP,
        ],
    ),
    ("logp", ShaderKind::Vertex, &[Opcode::LogP]),
    ("def", ShaderKind::Vertex, &[Opcode::Def]),
    ("def", ShaderKind::Pixel, &[Opcode::Def]),
];

/// Whether a shader has an instruction or definition.
fn has(shader: &Shader, opcode: Opcode) -> bool {
    match opcode {
        Opcode::Def => shader.program.definitions().next().is_some(),
        _ => (shader.program.instructions()).any(|i| i.opcode == opcode),
    }
}

/// Every value of every numeric choice, on every instruction that it is about.
#[test]
fn every_value_of_every_policy() {
    let name = |policy: &str, value: &str, kind: ShaderKind, opcode: Opcode| {
        format!("{policy}={value} {kind:?} {}", opcode.mnemonic())
    };
    let mut items = Vec::new();
    for policy in Policy::all() {
        assert!(POLICIES.iter().any(|(about, ..)| *about == policy.name));
    }
    for (about, kind, opcodes) in POLICIES {
        let policy = Policy::named(about).expect("a policy");
        for value in policy.values() {
            items.extend(
                opcodes
                    .iter()
                    .map(|opcode| name(about, value.name, kind, *opcode)),
            );
        }
    }
    let mut list = Checklist::new("values of policies", items);
    for probe in PROBES.iter() {
        for (about, kind, opcodes) in POLICIES {
            let shader = probe.shaders().find(|s| s.program.version.kind() == kind);
            let Some(shader) = shader else { continue };
            let there: Vec<Opcode> = (opcodes.iter().copied())
                .filter(|opcode| has(shader, *opcode))
                .collect();
            // Of one alone, so that it is known what was noticed.
            let [opcode] = there[..] else { continue };
            let policy = Policy::named(about).expect("a policy");
            let value = policy.get(&shader.kernel.policies);
            list.tick(&name(about, value, kind, opcode), || {
                let others = policy.values().into_iter().filter(|v| v.name != value);
                others.into_iter().all(|other| {
                    let mut options = super::probe::options(shader);
                    let set = options.policies.set(&format!("{about}={}", other.name));
                    set.expect("a value of the policy");
                    let kernel = lower(&shader.program, &options).expect("it could be lowered");
                    probe.notices(|case| {
                        let changed = Shader {
                            program: shader.program.clone(),
                            plan: Plan::new(&kernel),
                            kernel,
                        };
                        match kind {
                            ShaderKind::Vertex => case.vertex = Some(changed),
                            ShaderKind::Pixel => case.pixel = Some(changed),
                        }
                    })
                })
            });
        }
    }
    list.finish();
}

/// Every version that a part had is run with its numbers somewhere.
#[test]
fn versions_of_every_part() {
    for (model, versions) in PARTS {
        let run: Vec<Version> = of_model(model).map(|line| line.version).collect();
        assert!(
            !run.is_empty() && run.iter().all(|version| versions.contains(*version)),
            "{model}"
        );
    }
}

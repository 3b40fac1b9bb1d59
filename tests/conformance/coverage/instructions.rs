//! Every row of the instruction table, told apart from every other, and what only instructions together show.

use super::Checklist;
use super::probe::{PROBES, instruction_set, lines, title};
use std::collections::BTreeSet;
use texcrd::isa::{Class, Opcode, ShaderKind, Version, WriteMask};
use texcrd::kernel::{Op, Place};
use texcrd::program::Statement;

#[test]
fn every_instruction_matters_somewhere() {
    let mut list = Checklist::new(
        "instructions",
        instruction_set().map(|(version, opcode)| title(version, opcode)),
    );
    for line in lines() {
        // What computes nothing is covered where it stands; that nothing comes of it the case says.
        let nothing = matches!(line.opcode(), Opcode::Nop | Opcode::Phase);
        list.tick(&line.title(), || nothing || line.is_seen());
    }
    for probe in PROBES.iter() {
        for shader in probe.shaders() {
            let version = shader.program.version;
            for dcl in shader.program.declarations() {
                let register = dcl.register;
                // A declaration names an input; it matters if the input is read.
                let read = (shader.program.instructions())
                    .any(|i| i.sources.iter().any(|source| source.register == register));
                list.tick(&title(version, Opcode::Dcl), || read);
            }
            for def in shader.program.definitions() {
                list.tick(&title(version, Opcode::Def), || {
                    probe.notices_listing(version.kind(), |program| {
                        program.statements.retain(|s| *s != Statement::Def(*def));
                    })
                });
            }
        }
    }
    list.finish();
}

/// The operations that arithmetic instructions of a kind of shader become.
fn operations(kind: ShaderKind) -> Vec<Op> {
    let mut all: Vec<Op> = Vec::new();
    for line in lines().filter(|line| line.kind() == kind) {
        let arithmetic = line
            .opcode()
            .form(line.version)
            .is_some_and(|form| form.class == Class::Arithmetic);
        for step in &line.shader.kernel.steps {
            // The stage of `bem` is no other operation.
            let known = all
                .iter()
                .any(|op| *op == step.op || name(*op) == name(step.op));
            if step.origin == line.number && arithmetic && !known {
                all.push(step.op);
            }
        }
    }
    all
}

fn name(op: Op) -> String {
    let text = format!("{op:?}");
    text.split('(').next().unwrap_or_default().to_owned()
}

/// Were an instruction another one with as many sources, some case of its version would fail.
#[test]
fn every_arithmetic_instruction_is_told_apart() {
    let by_kind = [ShaderKind::Vertex, ShaderKind::Pixel].map(|kind| (kind, operations(kind)));
    let others = |version: Version, op: Op| {
        let (_, all) = by_kind
            .iter()
            .find(|(kind, _)| *kind == version.kind())
            .expect("both kinds are there");
        all.iter()
            .copied()
            .filter(move |other| other.sources() == op.sources() && name(*other) != name(op))
    };
    let item =
        |line: &str, op: Op, other: Op| format!("{line} ({}) from {}", name(op), name(other));
    let mut wanted = BTreeSet::new();
    let mut work = Vec::new();
    for line in lines() {
        let arithmetic = line
            .opcode()
            .form(line.version)
            .is_some_and(|form| form.class == Class::Arithmetic);
        let steps = &line.shader.kernel.steps;
        let Some(op) = steps.iter().find(|s| s.origin == line.number).map(|s| s.op) else {
            continue;
        };
        if arithmetic {
            wanted.extend(others(line.version, op).map(|other| item(&line.title(), op, other)));
            work.push((line, op));
        }
    }
    let mut list = Checklist::new("pairs of instructions told apart", wanted);
    for (line, op) in work {
        for other in others(line.version, op) {
            list.tick(&item(&line.title(), op, other), || {
                line.notices_steps(|step| step.op = other)
            });
        }
    }
    list.finish();
}

/// Both halves of a pair read before either writes, whichever comes first and whatever of red, green and blue the colour half
/// writes.
#[test]
fn every_shape_of_a_pair_reads_before_it_writes() {
    let colors = |version: Version| -> Vec<WriteMask> {
        let all = (1..8).map(WriteMask::from_bits);
        all.filter(|mask| version == Version::Ps14 || *mask == WriteMask::XYZ)
            .collect()
    };
    let orders = ["colour first", "alpha first"];
    let item = |version: Version, mask: WriteMask, order: &str| {
        format!(
            "{version} pair with {}, {order}",
            mask.text(['r', 'g', 'b', 'a'])
        )
    };
    let pixel = || Version::all().filter(|version| version.kind() == ShaderKind::Pixel);
    let wanted = pixel().flat_map(|version| {
        // The alpha half of ps.1.0 reads nothing but alpha: it cannot see what the colour half did.
        let orders = if version == Version::Ps10 {
            &orders[1..]
        } else {
            &orders[..]
        };
        let of = move |mask| {
            orders
                .iter()
                .map(move |order| item(version, mask, order))
                .collect::<Vec<_>>()
        };
        colors(version).into_iter().flat_map(of).collect::<Vec<_>>()
    });
    let mut list = Checklist::new("shapes of pairs", wanted.collect::<Vec<_>>());
    for line in lines().filter(|line| line.instruction.co_issue) {
        let first = line
            .shader
            .program
            .instructions()
            .nth(line.number - 1)
            .expect("a pair has a first half");
        let first_mask = first.destination.map_or(WriteMask::NONE, |d| d.mask);
        let (mask, order) = match line.mask() == WriteMask::W {
            true => (first_mask, orders[0]),
            false => (line.mask(), orders[1]),
        };
        list.tick(&item(line.version, mask, order), || {
            line.notices(|instruction| instruction.co_issue = false)
        });
    }
    list.finish();
}

/// The rows of a matrix macro all read before any of them writes.
#[test]
fn every_matrix_macro_works_in_place() {
    let macros = instruction_set()
        .filter(|(version, opcode)| opcode.form(*version).is_some_and(|form| form.rows > 0));
    let mut list = Checklist::new(
        "matrix macros in place",
        macros.map(|(version, opcode)| title(version, opcode)),
    );
    for line in lines() {
        list.tick(&line.title(), || {
            line.notices_steps(|step| step.held = false)
        });
    }
    list.finish();
}

/// `c[a0.x + n]` in every instruction that reads constants.
#[test]
fn every_instruction_addresses_constants_by_a0() {
    let reads = |(version, opcode): &(Version, Opcode)| {
        let form = opcode.form(*version);
        *version == Version::Vs11 && form.is_some_and(|form| !form.sources.is_empty())
    };
    let wanted = instruction_set().filter(reads);
    let mut list = Checklist::new(
        "instructions with relative addresses",
        wanted.map(|(version, opcode)| title(version, opcode)),
    );
    for line in lines() {
        let relative = |source: &texcrd::program::Source| source.register.relative;
        if !line.instruction.sources.iter().any(relative) {
            continue;
        }
        list.tick(&line.title(), || {
            line.notices_steps(|step| {
                for operand in &mut step.sources {
                    if let Place::Relative(offset) = operand.place {
                        operand.place = Place::Constant(offset);
                    }
                }
            })
        });
    }
    list.finish();
}

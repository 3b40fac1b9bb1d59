//! Numbers that an instruction treats in a special way: each must be read where an expectation depends on what comes of it.
//!
//! Which they are, only the specification says; so there is a table here. The places are sections of `instructions.md` where nothing
//! else is said.

use super::Checklist;
use super::probe::{PROBES, instruction_set, lines, title};
use texcrd::isa::{Class, Opcode, ShaderKind, Version, WriteMask};
use texcrd::kernel::Op;

/// What the three sources of a step hold, and the slot that is looked at.
type Read<'a> = (&'a [[f32; 4]; 3], usize);
type Situation = (&'static str, fn(Read<'_>) -> bool);

/// Steps in which some numbers are special.
struct Row {
    /// The place in the specification.
    place: &'static str,
    /// The instructions.
    opcodes: &'static [Opcode],
    /// Their steps that are meant.
    steps: fn(Op) -> bool,
    situations: &'static [Situation],
}

const TINY: f32 = 1e-30;
const HUGE: f32 = 1e30;

fn is_negative_zero(x: f32) -> bool {
    x == 0.0 && x.is_sign_negative()
}

fn is_positive_zero(x: f32) -> bool {
    x == 0.0 && x.is_sign_positive()
}

const NUMBERS: [Situation; 9] = [
    ("0", |(s, k)| is_positive_zero(s[0][k])),
    ("-0", |(s, k)| is_negative_zero(s[0][k])),
    ("a negative number", |(s, k)| {
        s[0][k] < 0.0 && s[0][k].is_normal()
    }),
    ("a huge number", |(s, k)| {
        s[0][k].abs() >= HUGE && s[0][k].is_finite()
    }),
    ("a tiny number", |(s, k)| {
        s[0][k].is_normal() && s[0][k].abs() <= TINY
    }),
    ("a denormal number", |(s, k)| s[0][k].is_subnormal()),
    ("inf", |(s, k)| s[0][k] == f32::INFINITY),
    ("-inf", |(s, k)| s[0][k] == f32::NEG_INFINITY),
    ("NaN", |(s, k)| s[0][k].is_nan()),
];

/// 0 · inf, 0 · NaN, -0 · inf, whichever source is the zero.
const PRODUCTS: [Situation; 7] = [
    ("0 · inf", |(s, k)| {
        is_positive_zero(s[0][k]) && s[1][k].is_infinite()
    }),
    ("inf · 0", |(s, k)| {
        s[0][k].is_infinite() && is_positive_zero(s[1][k])
    }),
    ("0 · NaN", |(s, k)| {
        is_positive_zero(s[0][k]) && s[1][k].is_nan()
    }),
    ("NaN · 0", |(s, k)| {
        s[0][k].is_nan() && is_positive_zero(s[1][k])
    }),
    ("-0 · inf", |(s, k)| {
        is_negative_zero(s[0][k]) && s[1][k].is_infinite()
    }),
    ("inf · a number", |(s, k)| {
        s[0][k].is_infinite() && s[1][k].is_normal()
    }),
    ("NaN · a number", |(s, k)| {
        s[0][k].is_nan() && s[1][k].is_normal()
    }),
];

const OVERFLOW: [Situation; 2] = [
    ("a product that is too large", |(s, k)| {
        (s[0][k] * s[1][k]).is_infinite() && s[0][k].is_finite() && s[1][k].is_finite()
    }),
    ("a product that is denormal", |(s, k)| {
        (s[0][k] * s[1][k]).is_subnormal()
    }),
];

const SUMS: [Situation; 3] = [
    ("inf and -inf", |(s, k)| {
        s[0][k].is_infinite() && s[1][k].is_infinite()
    }),
    ("NaN", |(s, k)| s[0][k].is_nan() || s[1][k].is_nan()),
    ("inf and a number", |(s, k)| {
        s[0][k].is_infinite() && s[1][k].is_finite()
    }),
];

const COMPARED: [Situation; 5] = [
    ("NaN first", |(s, k)| s[0][k].is_nan()),
    ("NaN second", |(s, k)| s[1][k].is_nan()),
    ("equal numbers", |(s, k)| {
        s[0][k] == s[1][k] && s[0][k].is_normal()
    }),
    ("-0 and 0", |(s, k)| {
        is_negative_zero(s[0][k]) && is_positive_zero(s[1][k])
    }),
    ("equal infinities", |(s, k)| {
        s[0][k].is_infinite() && s[0][k] == s[1][k]
    }),
];

const PASSED: [Situation; 3] = [NUMBERS[6], NUMBERS[7], NUMBERS[8]];

/// Of `texkill`: any of the three.
const KILLED: [Situation; 7] = [
    ("0", |(s, _)| s[0][..3].iter().any(|x| is_positive_zero(*x))),
    ("-0", |(s, _)| {
        s[0][..3].iter().any(|x| is_negative_zero(*x))
    }),
    ("a tiny negative number", |(s, _)| {
        s[0][..3].iter().any(|x| *x < 0.0 && *x > -TINY * 2.0)
    }),
    ("inf", |(s, _)| s[0][..3].contains(&f32::INFINITY)),
    ("-inf", |(s, _)| s[0][..3].contains(&f32::NEG_INFINITY)),
    ("NaN", |(s, _)| s[0][..3].iter().any(|x| x.is_nan())),
    ("x, y and z each negative alone", |(s, _)| {
        s[0][2] < 0.0 && s[0][0] >= 0.0 && s[0][1] >= 0.0
    }),
];

const LIT: [Situation; 13] = [
    ("x is 0", |(s, _)| is_positive_zero(s[0][0])),
    ("x is -0", |(s, _)| is_negative_zero(s[0][0])),
    ("x is negative", |(s, _)| s[0][0] < 0.0),
    ("x is inf", |(s, _)| s[0][0] == f32::INFINITY),
    ("x is NaN", |(s, _)| s[0][0].is_nan()),
    ("y is 0", |(s, _)| {
        is_positive_zero(s[0][1]) && s[0][0] > 0.0
    }),
    ("y is negative", |(s, _)| s[0][1] < 0.0 && s[0][0] > 0.0),
    ("y is inf, w positive, negative, 0", |(s, _)| {
        s[0][1] == f32::INFINITY && s[0][3] == 0.0
    }),
    ("y is NaN", |(s, _)| s[0][1].is_nan() && s[0][0] > 0.0),
    ("w is 0", |(s, _)| s[0][3] == 0.0 && s[0][1] > 0.0),
    ("w is huge", |(s, _)| s[0][3] > 128.0 && s[0][3].is_finite()),
    ("w is far below 0", |(s, _)| s[0][3] < -128.0),
    ("w is NaN", |(s, _)| s[0][3].is_nan() && s[0][1] > 0.0),
];

const LRP: [Situation; 5] = [
    ("weight 0 of inf", |(s, k)| {
        s[0][k] == 0.0 && s[1][k].is_infinite()
    }),
    ("weight 1, inf for the rest", |(s, k)| {
        s[0][k] == 1.0 && s[2][k].is_infinite()
    }),
    ("a weight above 1", |(s, k)| s[0][k] > 1.0),
    ("a weight below 0", |(s, k)| s[0][k] < 0.0),
    ("a weight that is NaN", |(s, k)| s[0][k].is_nan()),
];

const CND: [Situation; 6] = [
    ("0.5", |(s, k)| s[0][k] == 0.5),
    ("just above 0.5", |(s, k)| {
        s[0][k] > 0.5 && s[0][k] < 0.500_001
    }),
    ("-1", |(s, k)| s[0][k] == -1.0),
    ("inf", |(s, k)| s[0][k] == f32::INFINITY),
    ("-inf", |(s, k)| s[0][k] == f32::NEG_INFINITY),
    ("NaN", |(s, k)| s[0][k].is_nan()),
];

const CMP: [Situation; 7] = [
    NUMBERS[0],
    NUMBERS[1],
    ("a tiny negative number", |(s, k)| {
        s[0][k] < 0.0 && s[0][k] >= -TINY
    }),
    ("a tiny positive number", |(s, k)| {
        s[0][k] > 0.0 && s[0][k] <= TINY
    }),
    NUMBERS[6],
    NUMBERS[7],
    NUMBERS[8],
];

const POWERS: [Situation; 2] = [
    ("a power too large", |(s, k)| {
        s[0][k] >= 128.0 && s[0][k].is_finite()
    }),
    ("a power too small", |(s, k)| {
        s[0][k] <= -150.0 && s[0][k].is_finite()
    }),
];

const FRACTION: [Situation; 7] = [
    NUMBERS[0],
    NUMBERS[1],
    ("a negative fraction", |(s, k)| {
        s[0][k] < 0.0 && s[0][k].fract() != 0.0
    }),
    NUMBERS[3],
    NUMBERS[6],
    NUMBERS[7],
    NUMBERS[8],
];

const DST: [Situation; 4] = [
    ("0 · inf in y", |(s, _)| {
        s[0][1] == 0.0 && s[1][1].is_infinite()
    }),
    ("0 · NaN in y", |(s, _)| {
        (s[0][1] == 0.0 && s[1][1].is_nan()) || (s[0][1].is_nan() && s[1][1] == 0.0)
    }),
    ("inf or NaN in z", |(s, _)| !s[0][2].is_finite()),
    ("inf or NaN in w", |(s, _)| !s[1][3].is_finite()),
];

/// s0.x / s0.y. A dot product is never -0, so that only a register can hold such a divisor.
const DEPTH: [Situation; 5] = [
    ("a divisor of 0", |(s, _)| is_positive_zero(s[0][1])),
    ("a negative divisor", |(s, _)| s[0][1] < 0.0),
    ("a depth beyond 1", |(s, _)| {
        s[0][1] > 0.0 && s[0][0] / s[0][1] > 1.0
    }),
    ("a depth below 0", |(s, _)| {
        s[0][1] != 0.0 && s[0][0] / s[0][1] < 0.0
    }),
    ("0 / 0", |(s, _)| s[0][0] == 0.0 && s[0][1] == 0.0),
];

fn any(_: Op) -> bool {
    true
}

const ROWS: &[Row] = &[
    Row {
        place: "0",
        opcodes: &[Opcode::Mul, Opcode::Mad],
        steps: any,
        situations: &PRODUCTS,
    },
    Row {
        place: "0",
        opcodes: &[Opcode::Dp3, Opcode::Dp4],
        steps: any,
        situations: &PRODUCTS,
    },
    Row {
        place: "0",
        opcodes: &[
            Opcode::M3x2,
            Opcode::M3x3,
            Opcode::M3x4,
            Opcode::M4x3,
            Opcode::M4x4,
        ],
        steps: any,
        situations: &PRODUCTS,
    },
    Row {
        place: "0, denormals",
        opcodes: &[Opcode::Mul],
        steps: any,
        situations: &OVERFLOW,
    },
    Row {
        place: "5",
        opcodes: &[Opcode::Lrp],
        steps: any,
        situations: &LRP,
    },
    Row {
        place: "2.1",
        opcodes: &[Opcode::Add, Opcode::Sub],
        steps: any,
        situations: &SUMS,
    },
    Row {
        place: "2.1",
        opcodes: &[Opcode::Mov],
        steps: |op| op == Op::Mov,
        situations: &PASSED,
    },
    Row {
        place: "0",
        opcodes: &[Opcode::Min, Opcode::Max],
        steps: any,
        situations: &[COMPARED[0], COMPARED[1]],
    },
    Row {
        place: "0",
        opcodes: &[Opcode::Slt, Opcode::Sge],
        steps: any,
        situations: &COMPARED,
    },
    Row {
        place: "2.1",
        opcodes: &[Opcode::Frc],
        steps: any,
        situations: &FRACTION,
    },
    Row {
        place: "2.3",
        opcodes: &[Opcode::Rcp, Opcode::Rsq, Opcode::Log],
        steps: any,
        situations: &NUMBERS,
    },
    Row {
        place: "2.3, 2.4",
        opcodes: &[Opcode::Exp, Opcode::ExpP],
        steps: any,
        situations: &NUMBERS,
    },
    Row {
        place: "2.3, 2.4",
        opcodes: &[Opcode::Exp, Opcode::ExpP],
        steps: any,
        situations: &POWERS,
    },
    Row {
        place: "2.5",
        opcodes: &[Opcode::LogP],
        steps: any,
        situations: &NUMBERS,
    },
    Row {
        place: "2.6",
        opcodes: &[Opcode::Dst],
        steps: any,
        situations: &DST,
    },
    Row {
        place: "2.7",
        opcodes: &[Opcode::Lit],
        steps: any,
        situations: &LIT,
    },
    Row {
        place: "5",
        opcodes: &[Opcode::Cnd],
        steps: any,
        situations: &CND,
    },
    Row {
        place: "5",
        opcodes: &[Opcode::Cmp],
        steps: any,
        situations: &CMP,
    },
    Row {
        place: "6, 7.2",
        opcodes: &[Opcode::TexKill],
        steps: any,
        situations: &KILLED,
    },
    Row {
        place: "6, 7.2",
        opcodes: &[Opcode::TexDepth, Opcode::TexM3x2Depth],
        steps: |op| op == Op::Depth,
        situations: &DEPTH,
    },
    Row {
        place: "7.2",
        opcodes: &[Opcode::TexDepth],
        steps: |op| op == Op::Depth,
        situations: &[("a divisor of -0", |(s, _)| is_negative_zero(s[0][1]))],
    },
    Row {
        place: "6",
        opcodes: &[Opcode::TexCoord],
        steps: |op| op == Op::Mov,
        situations: &[
            NUMBERS[2],
            ("a number above 1", |(s, k)| {
                s[0][k] > 1.0 && s[0][k].is_finite()
            }),
            NUMBERS[6],
            NUMBERS[7],
            NUMBERS[8],
        ],
    },
    Row {
        place: "6",
        opcodes: &[Opcode::TexM3x3Spec, Opcode::TexM3x3VSpec],
        steps: |op| op == Op::Reflect,
        situations: &[
            ("a normal of 0", |(s, _)| s[0][..3] == [0.0; 3]),
            ("a normal that is not of unit length", |(s, _)| {
                s[0][..3].iter().map(|x| x * x).sum::<f32>() > 1.5
            }),
        ],
    },
];

#[test]
fn every_special_number() {
    let item = |title: &str, row: &Row, name: &str| format!("{title} of {name} ({})", row.place);
    let wanted = instruction_set().flat_map(|(version, opcode)| {
        let rows = ROWS.iter().filter(move |row| row.opcodes.contains(&opcode));
        rows.flat_map(move |row| {
            let names = row.situations.iter().map(|(name, _)| name);
            names.map(move |name| item(&title(version, opcode), row, name))
        })
    });
    let mut list = Checklist::new("special numbers", wanted);
    for line in lines() {
        let rows: Vec<&Row> = (ROWS.iter())
            .filter(|row| row.opcodes.contains(&line.opcode()))
            .collect();
        if rows.is_empty() {
            continue;
        }
        let steps = &line.shader.kernel.steps;
        let matters: [Vec<usize>; 4] = std::array::from_fn(|component| line.matters(component));
        for (invocation, number, sources) in line.probe.reads(line.kind()) {
            let step = &steps[number];
            if step.origin != line.number {
                continue;
            }
            let slots = step.op.slots_read(0, step.mask);
            // Component by component what is read in a slot counts if the result in that slot does; else any result does.
            let own = slots == step.mask && step.op.slots_read(0, WriteMask::X) == WriteMask::X;
            let own = own
                && !matches!(
                    step.op,
                    Op::Rcp | Op::Rsq | Op::Exp | Op::Log | Op::ExpP | Op::LogP
                );
            let counts = |slot: usize| match own {
                true => matters[slot].contains(&invocation),
                false => matters.iter().any(|seen| seen.contains(&invocation)),
            };
            for row in rows.iter().filter(|row| (row.steps)(step.op)) {
                for (name, holds) in row.situations {
                    list.tick(&item(&line.title(), row, name), || {
                        slots
                            .components()
                            .any(|slot| counts(slot) && holds((&sources, slot)))
                    });
                }
            }
        }
    }
    list.finish();
}

/// `a0.x` is the floor, whatever the number (registers.md, 2.3).
#[test]
fn every_special_address() {
    let situations = [
        FRACTION[0],
        FRACTION[1],
        FRACTION[2],
        NUMBERS[3],
        NUMBERS[6],
        NUMBERS[7],
        NUMBERS[8],
    ];
    let mut list = Checklist::new(
        "addresses",
        situations.iter().map(|(name, _)| (*name).to_owned()),
    );
    for line in lines().filter(|line| line.kind() == ShaderKind::Vertex) {
        let steps = &line.shader.kernel.steps;
        for (invocation, number, sources) in line.probe.reads(line.kind()) {
            let step = &steps[number];
            if step.origin != line.number || step.op != Op::Floor {
                continue;
            }
            for (name, holds) in situations {
                list.tick(name, || {
                    holds((&sources, 0)) && line.matters(0).contains(&invocation)
                });
            }
        }
    }
    list.finish();
}

/// `_sat` of what is no ordinary number (modifiers.md, 8).
#[test]
fn every_special_number_saturated() {
    let names = [
        "NaN",
        "inf",
        "-inf",
        "a number above 1",
        "a negative number",
    ];
    let versions = || Version::all().filter(|version| version.kind() == ShaderKind::Pixel);
    let item = |version: Version, name: &str| format!("{version} _sat of {name}");
    let wanted = versions().flat_map(|version| names.map(|name| item(version, name)));
    let mut list = Checklist::new("saturated numbers", wanted.collect::<Vec<_>>());
    for line in lines().filter(|line| line.instruction.result.saturate) {
        // Only of `mov` what is read is what is saturated.
        let form = line.opcode().form(line.version).expect("it has one");
        if line.opcode() != Opcode::Mov || form.class != Class::Arithmetic {
            continue;
        }
        for (invocation, number, [source, ..]) in line.probe.reads(line.kind()) {
            if line.shader.kernel.steps[number].origin != line.number {
                continue;
            }
            for component in line.mask().components() {
                let x = source[component];
                let name = match x {
                    _ if x.is_nan() => names[0],
                    f32::INFINITY => names[1],
                    f32::NEG_INFINITY => names[2],
                    _ if x > 1.0 => names[3],
                    _ if x < 0.0 => names[4],
                    _ => continue,
                };
                list.tick(&item(line.version, name), || {
                    line.matters(component).contains(&invocation)
                });
            }
        }
    }
    list.finish();
}

/// Constants of pixel shaders are clamped to -1…1 wherever they come from (registers.md, 3.2).
#[test]
fn every_constant_beyond_its_range() {
    let item = |version: Version, name: &str, from: &str| format!("{version} {name} from {from}");
    let versions = Version::all().filter(|version| version.kind() == ShaderKind::Pixel);
    let wanted = versions.flat_map(|version| {
        ["above 1", "below -1"]
            .into_iter()
            .flat_map(move |name| ["def", "the program"].map(move |from| item(version, name, from)))
    });
    let mut list = Checklist::new("constants beyond their range", wanted);
    for probe in PROBES.iter() {
        let Some(shader) = &probe.case.pixel else {
            continue;
        };
        let version = shader.program.version;
        let beyond = |value: [f32; 4]| {
            let above = value.iter().any(|x| *x > 1.0).then_some("above 1");
            let below = value.iter().any(|x| *x < -1.0).then_some("below -1");
            [above, below].into_iter().flatten()
        };
        let defined = shader
            .kernel
            .definitions
            .iter()
            .map(|(_, value)| (*value, "def"));
        let invocations = probe.case.invocations.iter();
        let set = invocations.flat_map(|i| {
            i.pixel_constants
                .iter()
                .map(|(_, value)| (*value, "the program"))
        });
        for (value, from) in defined.chain(set) {
            for name in beyond(value) {
                list.tick(&item(version, name, from), || {
                    probe.lines().any(|line| line.is_seen())
                });
            }
        }
    }
    list.finish();
}

//! What fails becomes small.

use super::*;
use crate::isa::VersionSet;

/// A shader that contains an opcode, made as small as it can be with it.
fn smallest(version: Version, opcode: Opcode) -> String {
    let textures = Textures::new().unwrap();
    let has = |program: &Program| program.instructions().any(|i| i.opcode == opcode);
    let large = (0..)
        .map(|seed| made(seed, &Options::new(version), &textures).program)
        .find(|program| has(program) && program.statements.len() > 8)
        .unwrap();
    let small = shrink(&large, &mut |program| has(program));
    assert_eq!(
        validate(&small, Dialect::D3d8),
        [],
        "{}",
        syntax::print(&small)
    );
    assert_eq!(program(&syntax::print(&small)), small);
    syntax::print(&small)
}

#[test]
fn a_failure_shrinks_to_the_instruction_that_causes_it() {
    assert_eq!(
        smallest(Version::Ps14, Opcode::Cnd),
        "ps.1.4\ncnd r0, c0, c0, c0\n"
    );
    assert_eq!(
        smallest(Version::Ps11, Opcode::Cnd),
        "ps.1.1\nmov r0, c0\ncnd r0, r0.a, c0, c0\n"
    );
    assert_eq!(
        smallest(Version::Vs11, Opcode::Dp4),
        "vs.1.1\ndp4 oPos, c0, c0\n"
    );
}

#[test]
fn what_belongs_together_shrinks_together() {
    for version in VersionSet::PS_1_0_TO_1_3.iter() {
        let small = smallest(version, Opcode::TexM3x3Tex);
        let lines: Vec<&str> = small.lines().skip(1).collect();
        // A source, two pads, the last row and the result.
        let mnemonics: Vec<&str> = lines.iter().map(|l| l.split(' ').next().unwrap()).collect();
        assert!(
            matches!(
                mnemonics[..],
                [
                    "tex" | "texcoord",
                    "texm3x3pad",
                    "texm3x3pad",
                    "texm3x3tex",
                    "mov"
                ]
            ),
            "{small}"
        );
    }
}

#[test]
fn shrinking_ends_and_keeps_what_cannot_be_smaller() {
    let text = "ps.1.4\nmov r0, c0\n";
    assert_eq!(syntax::print(&shrink(&program(text), &mut |_| true)), text);
    // Nothing else fails: the same shader comes back.
    let long = "ps.1.1\ntex t0\nmul_sat r0.rgb, t0_bx2, v0\n+mov r0.a, 1-t0\n";
    assert_eq!(syntax::print(&shrink(&program(long), &mut |_| false)), long);
    // A shader that breaks a rule may go on to break it, and no other.
    let broken = "ps.1.1\ntex t0\nadd r0, r1, t0\nmul r0, r0, t0\n";
    let small = shrink(&program(broken), &mut |p| {
        validate(p, Dialect::D3d8).iter().any(|d| d.rule.id == "I1")
    });
    // `r1` is what was never written.
    assert_eq!(syntax::print(&small), "ps.1.1\nmov r0, r1\n");
}

#[test]
fn another_program_runs_with_the_same_surroundings() {
    let textures = Textures::new().unwrap();
    for version in Version::all() {
        for seed in 0..50 {
            let options = options(version, seed);
            let made = made(seed, &options, &textures);
            let again = made.with(&made.program, &options, &textures).unwrap();
            assert_eq!(format!("{:?}", again), format!("{made:?}"));
        }
    }
    let options = Options::new(Version::Ps14);
    let made = made(1, &options, &textures);
    let moved = program("ps.1.4\ndef c0, 0.25, 0.5, -1, 0.125\nmov_x2 r0, c0\n");
    let moved = made.with(&moved, &options, &textures).unwrap();
    // Twice the constant, exactly.
    assert_eq!(
        moved.outcomes[0].values,
        [[0.5, 1.0, -2.0, 0.25]; INVOCATIONS]
    );
    assert_eq!(moved.outcomes[0].errors, [[0.0; 4]; INVOCATIONS]);
    // 0.1 + 0.4 − 0.5 is zero, or not, by rounding: no two executors need agree on its sign.
    let listing = "ps.1.4\ndef c0, 0.1, 0.1, 0.1, 0.1\ndef c1, 0.4, 0.4, 0.4, 0.4\n\
                   add r0, c0, c1\ncmp r0, r0_bias, c0, c1\n";
    assert!(made.with(&program(listing), &options, &textures).is_none());
    let anything = Options {
        comparable: false,
        ..options
    };
    let rounded = made.with(&program(listing), &anything, &textures).unwrap();
    assert_eq!(rounded.outcomes[0].errors[0][0], f32::INFINITY);
}

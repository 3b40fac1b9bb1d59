//! What `--stats` says of textures, read ports and pairs. Expected values are counted by hand.

use super::program;
use crate::isa::RegisterFile;
use crate::rules::Example;
use crate::validate::{Coordinates, Statistics, statistics};

/// The statistics of a listing in one line, and its lines, from 1 on as spans are told of.
fn of(
    line: &str,
) -> (
    Statistics,
    impl Fn(crate::diagnostic::Span) -> (usize, usize),
) {
    let text = Example::new(line).text;
    let counted = statistics(&program(&text));
    let number = move |at: u32| 1 + text[..at as usize].matches('\n').count();
    (counted, move |span| (number(span.start), number(span.end)))
}

/// Stage and coordinates of each stage of a listing.
fn stages(line: &str) -> Vec<(u32, Coordinates)> {
    let stages = of(line).0.stages;
    stages
        .into_iter()
        .map(|s| (s.stage, s.coordinates))
        .collect()
}

#[test]
fn stages_need_the_textures_that_their_instructions_take() {
    use Coordinates::{Any, Three, Two};
    // The formulas of instructions.md, section 5: how many coordinates S[m] is given.
    let matrix = "ps.1.1 | tex t0 | texm3x3pad t1, t0 | texm3x3pad t2, t0 | texm3x3vspec t3, t0 | mov r0, t3";
    assert_eq!(stages(matrix), [(0, Any), (3, Three)]);
    let flat =
        "ps.1.1 | tex t0 | texbem t1, t0 | texm3x2pad t2, t0 | texm3x2tex t3, t0 | mov r0, t3";
    assert_eq!(stages(flat), [(0, Any), (1, Two), (3, Two)]);
    let colors =
        "ps.1.2 | tex t0 | texreg2ar t1, t0 | texreg2rgb t2, t0 | texdp3tex t3, t0 | mov r0, t3";
    assert_eq!(stages(colors), [(0, Any), (1, Two), (2, Any), (3, Two)]);
    // A cube that is sampled in the first phase, a projection that makes stage 1 flat in the second.
    let phases = "ps.1.4 | texld r0, t0 | texld r1, t1.xyw | texcrd r2.rgb, t2 | phase | texld r1, t1_dw.xyw | texld r2, r2_dz | mov r0, r1";
    assert_eq!(stages(phases), [(0, Any), (1, Two), (2, Two)]);
    let (counted, line) = of(phases);
    let samples: Vec<_> = counted.stages[1]
        .samples
        .iter()
        .map(|s| line(*s).0)
        .collect();
    assert_eq!(samples, [3, 6]);
    // Neither pads nor coordinates sample.
    assert_eq!(stages("ps.1.1 | texcoord t0 | texkill t1 | mov r0, t0"), []);
}

#[test]
fn ports_are_full_where_as_many_registers_are_read_as_may_be() {
    let full = |line: &str| {
        let (counted, number) = of(line);
        let one = |f: &crate::validate::FullPorts| {
            let places: Vec<_> = f.places.iter().map(|s| number(*s)).collect();
            (f.file, f.allowed, f.pairs, places)
        };
        counted.full_ports.iter().map(one).collect::<Vec<_>>()
    };
    use RegisterFile::{Const, Input, Texture};
    // ps.1.1 reads two c# and two t# at once; t0 twice is one register. Its v# never run out.
    let ps = "ps.1.1 | tex t0 | tex t1 | mul r0, t0, t1 | mad r0, c0, c1, r0 | mad r0, t0, t0, v0";
    assert_eq!(
        full(ps),
        [
            (Const, 2, false, vec![(5, 5)]),
            (Texture, 2, false, vec![(4, 4)])
        ]
    );
    // Both halves together read three.
    let pair = "ps.1.1 | tex t0 | mul r0.rgb, c0, t0 | +mad r0.a, c1, c2, t0";
    assert_eq!(
        full(pair),
        [
            (Const, 2, false, vec![(4, 4)]),
            (Const, 3, true, vec![(3, 4)])
        ]
    );
    // A vertex shader reads one c# and one v#, in each row of a matrix too.
    let vs = "vs.1.1 | m4x4 oPos, v0, c0 | mov r0, c4 | add r0, r0, r0";
    assert_eq!(
        full(vs),
        [
            (Input, 1, false, vec![(2, 2)]),
            (Const, 1, false, vec![(2, 2), (3, 3)])
        ]
    );
}

/// The pairs that a listing could have: the line of the second half, and the slots it saves.
fn pairs(line: &str) -> Vec<(usize, u32)> {
    let (counted, number) = of(line);
    let pairs = counted.possible_pairs.iter();
    pairs
        .map(|pair| (number(pair.second).0, pair.saves))
        .collect()
}

#[test]
fn neighbours_that_could_be_a_pair_are_found() {
    assert_eq!(
        pairs("ps.1.1 | tex t0 | mul r0.rgb, t0, v0 | mov r0.a, t0"),
        [(4, 1)]
    );
    // They already are one; one instruction is in one pair only.
    assert_eq!(
        pairs("ps.1.1 | tex t0 | mul r0.rgb, t0, v0 | +mov r0.a, t0"),
        []
    );
    assert_eq!(
        pairs("ps.1.1 | mov r0.a, v0 | mov r0.rgb, v0 | mov r1.a, v0"),
        [(3, 1)]
    );
    let four =
        "ps.1.1 | tex t0 | mov r0.a, t0 | mul r0.rgb, t0, v0 | mov r1.a, v0 | add r1.rgb, t0, v0";
    assert_eq!(pairs(four), [(4, 1), (6, 1)]);
    // The second reads what the first has just written: r0.a, not r0.rgb.
    assert_eq!(
        pairs("ps.1.1 | tex t0 | mov r0.a, t0 | mul r0.rgb, t0, r0.a"),
        []
    );
    assert_eq!(
        pairs("ps.1.1 | tex t0 | mov r0, t0 | mov r0.a, v0 | mul r0.rgb, t0, r0"),
        [(5, 1)]
    );
    // The first may read what the second writes, for it reads before.
    assert_eq!(
        pairs("ps.1.1 | tex t0 | mov r0, t0 | mul r0.rgb, t0, r0.a | mov r0.a, v0"),
        [(5, 1)]
    );
    // Both write colour; all components; part of the colour, which only ps.1.4 pairs.
    assert_eq!(pairs("ps.1.1 | mov r0.rgb, v0 | mov r1.rgb, v1"), []);
    assert_eq!(pairs("ps.1.1 | mov r0, v0 | mov r1.a, v1"), []);
    assert_eq!(
        pairs("ps.1.4 | mov r0, c0 | mov r0.rg, c1 | mov r0.a, c2"),
        [(4, 1)]
    );
    // Different registers in ps.1.0; dp4, which stands alone; dp3, which writes colour in a pair.
    assert_eq!(pairs("ps.1.0 | mov r0.rgb, v0 | mov r1.a, v0"), []);
    assert_eq!(pairs("ps.1.1 | mov r0.rgb, v0 | mov r1.a, v0"), [(3, 1)]);
    assert_eq!(pairs("ps.1.4 | dp4 r0.rgb, c0, c1 | mov r0.a, c0"), []);
    assert_eq!(
        pairs("ps.1.4 | dp3 r0.rgb, c0, c1 | mov r0.a, c0"),
        [(3, 1)]
    );
    assert_eq!(pairs("ps.1.4 | mov r0.rgb, c0 | dp3 r0.a, c0, c1"), []);
    // Four constants are too many for a pair, three are not.
    assert_eq!(pairs("ps.1.1 | mul r0.rgb, c0, c1 | mul r0.a, c2, c3"), []);
    assert_eq!(
        pairs("ps.1.1 | mul r0.rgb, c0, c1 | mul r0.a, c2, c1"),
        [(3, 1)]
    );
    // cmp of ps.1.2 takes two slots: with a mul beside it the mul is free, with a second cmp two are saved.
    assert_eq!(
        pairs("ps.1.2 | mul r0.rgb, v0, v1 | cmp r0.a, v0, v1, c0"),
        [(3, 1)]
    );
    assert_eq!(
        pairs("ps.1.2 | cmp r0.rgb, v0, v1, c0 | cmp r0.a, v0, v1, c0"),
        [(3, 2)]
    );
    // What is between them keeps them apart; so does phase. Vertex shaders have no pairs.
    assert_eq!(pairs("ps.1.4 | mov r0.rgb, c0 | phase | mov r0.a, c0"), []);
    assert_eq!(
        pairs("vs.1.1 | mov oPos, v0 | mov r0.xyz, v0 | mov r0.w, v0"),
        []
    );
}

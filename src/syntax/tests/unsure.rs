//! Repairs that are certain because nothing else can have been meant, and those that are not.

use super::*;
use crate::syntax::{Options, parse_with, unread};

/// What certain repairs make of one statement, which has one diagnostic.
#[track_caller]
fn becomes(version: &str, damaged: &str, expected: &str) {
    let text = format!("{version}\n{damaged}\nnop\n");
    let told = told(&text);
    let (repaired, _) = repaired(&text);
    assert_eq!(repaired, format!("{version}\n{expected}\nnop\n"), "{told}");
    assert_eq!(found(&text).len(), 1, "{told}");
    if damaged != expected {
        accepted(repaired);
    }
}

/// One diagnostic, whose repair is only offered. The help says what may be meant and does not say that it must be.
#[track_caller]
fn offers(version: &str, damaged: &str, replacement: &str) {
    becomes(version, damaged, damaged);
    let text = format!("{version}\n{damaged}\nnop\n");
    let told = told(&text);
    let diagnostics = diagnostics(&text);
    let fix = diagnostics[0].fix.as_ref().expect(&told);
    assert_eq!(fix.replacement, replacement, "{told}");
    assert!(!told.contains("must be"), "{told}");
}

#[test]
fn a_split_number_is_joined_where_four_numbers_result() {
    becomes(
        "ps.1.4",
        "def c0, 0. 5, 0.5, 1, 1",
        "def c0, 0.5, 0.5, 1, 1",
    );
    becomes(
        "ps.1.4",
        "def c0, 1, -0. 5, 0.5, 1",
        "def c0, 1, -0.5, 0.5, 1",
    );
    // Three numbers if joined, four with a comma.
    offers("ps.1.4", "def c0, 0. 5, 0.5, 1", "0.5");
    let text = "ps.1.4\ndef c0, 1, -0. 5, 0.5, 1\n";
    let program = read(text).1.program.unwrap();
    assert_eq!(
        program.definitions().next().unwrap().value,
        [1.0, -0.5, 0.5, 1.0]
    );
}

#[test]
fn letters_with_two_readings_are_only_offered() {
    // `xyzw` and `xwzw`; in a mask only the first is in order.
    offers("vs.1.1", "mov r0, v0.xvzw", "xyzw");
    becomes("vs.1.1", "mov r0.xvzw, v0", "mov r0.xyzw, v0");
    // `y` or `w`.
    offers("vs.1.1", "mov r0.v, v0", "y");
    // `w`, since `yy` names one component twice.
    becomes("vs.1.1", "mov r0.xyvv, v0", "mov r0.xyw, v0");
}

#[test]
fn digits_with_two_readings_are_only_offered() {
    offers("ps.1.4", "def c0, S.0f, 0, 0, 0", "5.0f");
    offers("ps.1.4", "def c0, B, 0, 0, 0", "8");
    becomes("ps.1.4", "def c0, G, 0, 0, 0", "def c0, 6, 0, 0, 0");
    // r5 and r8; of cB, c8 and c13; of rB, only r8 is a register of the version.
    offers("vs.1.1", "mov rS, v0", "r5");
    offers("vs.1.1", "mov r0, cB", "c8");
    becomes("vs.1.1", "mov rB, v0", "mov r8, v0");
    // Nothing has written r1; ps.1.4 has no c12.
    offers("ps.1.4", "mov r0, rl", "r1");
    offers("ps.1.4", "mov r0, c 12", "c12");
}

#[test]
fn a_stroke_is_a_comment_only_behind_a_whole_instruction() {
    for text in ["def c1, 1/2, 0, 0, 0", "mov r0, r1 / r2", "mul r0, r1 / 2"] {
        let whole = format!("ps.1.4\n{text}\nnop\n");
        assert_eq!(repaired(&whole), (whole.clone(), 0), "{}", told(&whole));
        assert_eq!(found(&whole).len(), 1, "{}", told(&whole));
    }
    becomes("ps.1.4", "mov r0, r1 / copy it", "mov r0, r1 // copy it");
}

#[test]
fn blanks_that_are_lost_or_won() {
    becomes("ps.1.4", "texcrdr1.rgb, t1", "texcrd r1.rgb, t1");
    becomes("ps.1.4", "mulr0.rgb, r0, r1", "mul r0.rgb, r0, r1");
    becomes(
        "ps.1.4",
        "mul_x2_satr0.rgb, r0, r1",
        "mul_x2_sat r0.rgb, r0, r1",
    );
    becomes("ps.1.4", "defc0, 1,0,0,0", "def c0, 1,0,0,0");
    becomes("ps.1.4", "dp 3 r0.rgb, r0, r1", "dp3 r0.rgb, r0, r1");
    becomes("ps.1.4", "mu l r0.rgb, r0, r1", "mul r0.rgb, r0, r1");
    becomes("ps.1.4", "ad d_sat r0, r0, r1", "add_sat r0, r0, r1");
    becomes("ps.1.4", "de f c0, 1, 0, 0, 0", "def c0, 1, 0, 0, 0");
    becomes("ps.1.4", "phas e", "phase");
    becomes("ps.1.4", "tex ld r0, t0", "texld r0, t0");
    becomes("vs.1.1", "exp p r0, v0.x", "expp r0, v0.x");
    becomes("ps.1.4", "mov r0.rg b, r1", "mov r0.rgb, r1");
    becomes("vs.1.1", "mov r0.x y, v0", "mov r0.xy, v0");
    becomes("vs.1.1", "add r0, v0.xyz w, v1", "add r0, v0.xyzw, v1");
    offers("vs.1.1", "mov r0, v0.x y", "xy");
}

#[test]
fn signs_that_stand_for_others() {
    becomes("ps.1.4", "mad r0.rgb. r0, r1, c0", "mad r0.rgb, r0, r1, c0");
    offers("ps.1.4", "mul r0.rgb, r0; r1", ",");
    // A comment is one.
    assert_eq!(found("ps.1.4\nmul r0.rgb, r0, r1; r1\n"), []);
    becomes("vs.1.1", "mov r0, c[a0.x+ 1O]", "mov r0, c[a0.x+ 10]");
    becomes("vs.1.1", "mov r0, c[a0.x + l0]", "mov r0, c[a0.x + 10]");
    offers("vs.1.1", "mov r0, c[a0.x + S]", "5");
    becomes("ps.1.4", "\u{201C}mov r0, r1", "mov r0, r1");
    becomes("ps.1.4", "*mov r0, r1", "*mov r0, r1");
    for version in ["ps.1,4", "ps,1.4"] {
        assert_eq!(repaired(format!("{version}\nnop\n")).0, "ps.1.4\nnop\n");
    }
}

#[test]
fn dashes_are_read_as_minus() {
    for dash in ["\u{2013}", "\u{2212}"] {
        for (damaged, expected) in [
            (format!("mov r0, {dash}r1"), "mov r0, -r1"),
            (format!("mov r0, 1{dash}r0"), "mov r0, 1-r0"),
            (format!("def c0, {dash}1, 0, 0, 0"), "def c0, -1, 0, 0, 0"),
        ] {
            becomes("ps.1.4", &damaged, expected);
            let text = format!("ps.1.4\n{damaged}\n");
            let parsed = read(&text).1;
            assert_eq!(parsed.diagnostics[0].rule.id, "P22");
            assert!(!crate::diagnostic::any_error(&parsed.diagnostics));
            assert_eq!(parsed.program.unwrap().statements.len(), 1);
        }
    }
}

#[test]
fn a_saturated_source_is_read_without_its_suffix() {
    let (map, parsed) = read("ps.1.1\nmul r0.rgb, r0_sat, r1\n");
    let [d] = &parsed.diagnostics[..] else {
        panic!("{:?}", parsed.diagnostics);
    };
    assert_eq!(d.rule.id, "P15");
    assert!(crate::diagnostic::any_error(&parsed.diagnostics));
    assert_eq!(parsed.program.unwrap().instructions().count(), 1);
    let lenient = parse_with(
        &map.files()[1],
        Options {
            lenient: true,
            ..Options::default()
        },
    );
    assert_eq!(lenient.diagnostics.len(), 1);
    assert!(!crate::diagnostic::any_error(&lenient.diagnostics));
}

/// A lone `q` is the fourth component of other languages (stpq) as likely as a `g`; within a word it is a `g`.
#[test]
fn a_lone_q_has_no_certain_repair() {
    let (_, parsed) = read("ps.1.4\nmov r0, v0.q\n");
    let [d] = &parsed.diagnostics[..] else {
        panic!("{:?}", parsed.diagnostics);
    };
    assert_eq!(d.rule.id, "P14");
    assert!(d.fix.as_ref().is_some_and(|fix| !fix.certain));
    assert_eq!(d.help.as_deref(), Some("did you mean `g` or `a`?"));
    becomes("ps.1.4", "mov r0.rqb, v0", "mov r0.rgb, v0");
}

#[test]
fn damage_is_not_told_twice() {
    let warnings = |text: &str| {
        let (map, parsed) = read(text);
        unread(&map.files()[1], &parsed).len()
    };
    let load = "ps.1.4\ntexld r0, t0\ntexld r1, t1\n";
    assert_eq!(warnings(&format!("{load}mul r0.rgb, r0, c1\n")), 1);
    // What `cl` and `q1` were may have been r1.
    assert_eq!(warnings(&format!("{load}mul r0.rgb, r0, cl\n")), 0);
    assert_eq!(warnings(&format!("{load}mul r0.rgb, r0, q1\n")), 0);
    assert_eq!(warnings(&format!("{load}mul\n")), 0);
    // What is damaged here says that it is no r1.
    assert_eq!(warnings(&format!("{load}mul r0.rgb, r0, c2_foo\n")), 1);
    assert_eq!(warnings(&format!("{load}mul r0.rgb, r0, q2\n")), 1);
}

//! Severities by dialect, and messages.

use super::{Marked, ids};
use crate::diagnostic::{Severity, any_error};
use crate::policy::Dialect;

/// Severity in `d3d8`, `d3d9` and `lenient` (error, warning, nothing) of the first thing said of a listing.
/// The first column is the severity column of the limits; the others follow from what it says of the assemblers.
const SEVERITIES: &str = "
B3  E E W  ps.1.1 | mul r0, v0, v0 *9
S2  W E W  ps.1.1 | tex t0 | def c0, 0, 0, 0, 0 | mul r0, t0, c0
S2  W E W  vs.1.1 | dcl_position v0 | mov oPos, v0 | dcl_color v1
S13 - W -  ps.1.0 | mov r0, v0
S13 - W -  vs.1.0 | mov oPos, v0
O24 - E -  vs.1.1 | mov oPos, v0 | mov oFog.x, v0.x
O24 - E -  vs.1.1 | mov oPos, v0 | mov oPts.x, v0.x
O24 - - -  vs.1.1 | mov oPos, v0 | mov oFog, v0.x
O11 W W W  ps.1.4 | texcrd r1.rgb, t0 | texkill r1 | phase | mov r0, v0
T13 W W W  ps.1.4 | phase | texld r1, t0 | texkill r1 | mov r0, v0
O14 W W W  ps.1.4 | texcrd r5.rgb, t0 | texdepth r5 | mov r0, c0
S6  E E W  ps.1.1 | mov r1, v0
S7  W W W  ps.1.4 | phase | mov r0.rgb, c0
S9  W E W  vs.1.1 | mov oPos.xyz, v0
S10 - E -  vs.1.1 | mov oPos, v0 | mov oT1, v7
S14 E E E  ps.1.1 | cmp r0, v0, c0, c1
O1  E E E  ps.1.1 | mov r0, v2
O4  E E W  vs.1.0 | mov oPos, v0 | mov a0.x, v1.x
O3  E E E  vs.1.0 | mov oPos, v0 | add r0, v0, a0.x
O5  E E E  vs.1.0 | mov oPos, v0 | exp a0.x, v0.x
O8  E E W  ps.1.4 | mul r0, c0, t0
O8  E E E  ps.1.4 | mov t0, c0 | mov r0, c0
O12 W W W  ps.1.4 | texcrd r1, t0 | mov r0, c0
O12 E E E  ps.1.4 | texcrd r1.g, t0 | mov r0, c0
O14 E E W  ps.1.4 | texcrd r0.rgb, t0 | phase | texdepth r0 | mov r0, c0
O14 E E E  ps.1.4 | phase | texdepth t0 | mov r0, c0
O15 E E W  ps.1.1 | mov r0, v0 | cnd r0, v0, v0, v1
O1  E E E  ps.1.1 | mov r0, v0 | cnd r0, r5, v0, v1
O19 E E W  vs.1.1 | m4x4 oPos, v0, c0.wzyx
O19 W W W  vs.1.1 | mov oPos, v0 | m3x3 r0, v0, c0
O20 W E W  vs.1.1 | mov r0, v0 | m4x4 r0, r0, c0 | mov oPos, r0
O21 W E W  vs.1.1 | mov oPos, v0 | rsq r0, v0
O26 E E W  vs.1.1 | mov oPos, c255
O26 E E E  vs.1.1 | mov oPos, c256
M1  E E W  ps.1.1 | mul r0, v0, v0_x2
M1  E E E  ps.1.1 | mul r0, v0, v0_dz
M12 E E W  ps.1.4 | texld r0, t0_dz
M12 E E E  ps.1.4 | mov r1, c0 | mov r0, r1_dz
M6  W E W  ps.1.1 | mov r0, -c0
M11 E E W  ps.1.4 | texld r0, t0 | texld r1, t0.xyw
M11 W W W  ps.1.4 | texld r0, t0 | phase | texld r0, t0.xyw
T4  E E E  ps.1.1 | tex t0 | texm3x2tex t1, t0 | mov r0, t1
T9  E E W  ps.1.1 | tex t0 | texbem t1, t0 | mul r0, t1, t0
I1  E E W  ps.1.1 | mov r0, r1
I1  W E W  vs.1.1 | mov oPos, r0
C3  E E W  ps.1.1 | mov r0, v0 | +mov r0.a, v1
";

#[test]
fn severities_follow_the_dialect() {
    for line in SEVERITIES.lines().filter(|l| !l.is_empty()) {
        let (head, listing) = line.split_at(line.find("ps.").or(line.find("vs.")).unwrap());
        let words: Vec<&str> = head.split_whitespace().collect();
        for (dialect, want) in Dialect::all().zip(&words[1..]) {
            let found = Marked::new(listing).judge(dialect);
            let got = found
                .iter()
                .find(|d| d.rule.id == words[0])
                .map(|d| d.severity);
            let want = match *want {
                "E" => Some(Severity::Error),
                "W" => Some(Severity::Warning),
                _ => None,
            };
            assert_eq!(got, want, "{line}: {dialect}");
        }
    }
}

#[test]
fn the_later_assembler_says_that_it_is_the_later_one() {
    let listing = Marked::new("ps.1.1 | mov r0, -c0");
    let help = listing.judge(Dialect::D3d9)[0].help.clone().unwrap();
    assert!(
        help.contains("Direct3D 8 took it against its own documents"),
        "{help}"
    );
    let help = listing.judge(Dialect::D3d8)[0].help.clone().unwrap();
    assert!(!help.contains("Direct3D 9"), "{help}");
}

/// What messages and help texts say: a listing, words that stand in the first message or help.
const WORDS: &[(&str, &[&str])] = &[
    (
        "ps.1.1 | tex t0 | tex t1 | tex t2 | tex t3 | tex t3 | mov r0, t0",
        &[
            "ps.1.1 takes 4 texture instructions",
            "5th of 5",
            "ps.1.4 takes 6",
        ],
    ),
    (
        "ps.1.1 | mul r0, v0, v0 *11",
        &["8 arithmetic slots", "takes 11"],
    ),
    (
        "vs.1.1 | mov oPos, v0 | mov r0, v0 *199",
        &["128 slots", "takes 200"],
    ),
    (
        "ps.1.4 | texld r0, t0 *7",
        &["6 texture instructions in a phase", "7th"],
    ),
    (
        "ps.1.1 | cmp r0, v0, v0, v1",
        &["ps.1.1 has no cmp", "ps.1.2 to ps.1.4", "cnd"],
    ),
    (
        "ps.1.1 | mov r0, v0 | mov r2, v0",
        &["ps.1.1 has no r2", "r0 to r1"],
    ),
    (
        "ps.1.1 | add r0, v0, r1.a",
        &["r1.a is read", "nothing has been written"],
    ),
    (
        "vs.1.1 | m3x3 r0.xyz, v0, c0 | mov oPos, r0",
        &["r0.w is read", "only r0.xyz has been written"],
    ),
    (
        "ps.1.4 | texld r0, t0 | phase | mov r0, r0",
        &["r0.a is read", "phase has lost it"],
    ),
    (
        "vs.1.1 | mov oPos, v0 | add r0, c0, c1",
        &["c0 and c1", "one c#", "vs.1.1"],
    ),
    (
        "ps.1.0 | tex t0 | tex t1 | mul r0, t0, t1",
        &["t0 and t1", "one t#", "ps.1.1 reads two"],
    ),
    (
        "ps.1.1 | mov r0, v0 | mov r0.rg, v0",
        &["mov of ps.1.1", ".rg", ".rgb, .a or .rgba"],
    ),
    ("vs.1.1 | mov oPos, v0 | rsq r0.x, v0", &["v0.w"]),
    (
        "ps.1.4 | texkill t0.xyz | mov r0, c0",
        &["texkill writes nothing", "write t0"],
    ),
    ("ps.1.1 | mul_d4 r0, v0, v0", &["no _d4", "ps.1.4"]),
    (
        "ps.1.1 | tex t0 | texm3x3pad t1, t0 | tex t2 | mov r0, t2",
        &["texm3x3pad t1", "tex t2", "texm3x3pad t2"],
    ),
];

#[test]
fn messages_name_what_they_speak_of() {
    for (line, words) in WORDS {
        let found = Marked::new(line).judge(Dialect::D3d8);
        let first = &found[0];
        let said = format!("{} / {}", first.message, first.help.as_deref().unwrap());
        for word in *words {
            assert!(said.contains(word), "{line}: `{word}` is not in: {said}");
        }
    }
}

/// Section 11 of the limits: what is accepted and what is not.
const CORPUS: &[(&str, &[&str], bool)] = &[
    ("ps.1.0 | tex t0 | mul r0, t0, v0", &[], true),
    ("ps.1.0 | tex t0 | tex t1 | mul r0, t0, t1", &["R6"], false),
    ("ps.1.1 | tex t0 | tex t1 | mul r0, t0, t1", &[], true),
    (
        "ps.1.1 | tex t0 | texbem t1, t0 | add r0, t1, t0",
        &["T9"],
        false,
    ),
    (
        "ps.1.1 | texcoord t0 | mov r0, t0 | cnd r0, r0.a, c1, c2",
        &[],
        true,
    ),
    ("ps.1.1 | cmp r0, t0, c0, c1", &["S14"], false),
    ("ps.1.4 | texld r0, t0 | mov r0, r0", &[], true),
    (
        "ps.1.4 | texld r0, t0 | phase | mov r0.rgb, r0",
        &["S7"],
        true,
    ),
    ("ps.1.4 | texld r0, t0 | phase | mov r0, r0", &["I2"], false),
    (
        "ps.1.4 | mov r0, c0 | mul r0, r0, v0 | phase | mov r0, c0",
        &["O9"],
        false,
    ),
    ("vs.1.0 | m4x4 oPos, v0, c0 | mov oD0, v5", &[], true),
    (
        "vs.1.1 | mov oPos, v0 | mov a0.x, v1.x | mov r0, c[a0.x+8]",
        &[],
        true,
    ),
    (
        "vs.1.0 | mov oPos, v0 | mov a0.x, v1.x | mov r0, c[a0.x+8]",
        &["O4"],
        false,
    ),
    ("vs.1.1 | mov oPos, v0 | add r0, c0, c1", &["R1"], false),
    (
        "vs.1.1 | dp4 oPos.x, v0, c0 | dp4 oPos.y, v0, c1 | dp4 oPos.z, v0, c2 | dp4 oPos.w, v0, c3",
        &[],
        true,
    ),
];

#[test]
fn the_corpus_of_the_limits_is_judged_as_written_there() {
    for (line, want, accepted) in CORPUS {
        assert_eq!(ids(line, Dialect::D3d8), *want, "{line}");
        let found = Marked::new(line).judge(Dialect::D3d8);
        assert_eq!(!any_error(&found), *accepted, "{line}");
    }
}

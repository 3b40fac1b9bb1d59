//! More listings that break one rule alone, with the place in braces, and that just break none, beside those of the rule list.

use super::Marked;
use crate::policy::Dialect;
use crate::rules;

/// `ID:` a listing that breaks the rule at the braces and no other; `ID ok:` one that breaks none.
const CASES: &str = "
B1: vs.1.1 | mov oPos, v0 | exp r0, v0.x *12 | frc r0.xy, v0 *2 | {m3x2} r0.xy, v0, c0
B1 ok: vs.1.1 | def c0, 0, 0, 0, 0 | mov oPos, v0 | exp r0, v0.x *12 | frc r0.xy, v0 *2 | nop
B3: ps.1.2 | cmp r0, v0, v1, v1 *3 | mul r0, v0, v0 *2 | {mul} r0, v0, v0
B3: ps.1.1 | tex t0 | texbeml t1, t0 | mul r0, t1, v0 *7 | {mul} r0, t1, v0
B3 ok: ps.1.1 | nop *9 | mul r0, v0, v0 *8
B5: ps.1.4 | bem r0.rg, c0, c1 | mul r0, c0, c0 *6 | {mul} r0, c0, c0 | phase | mov r0, c0
B6 ok: ps.1.4 | dp4 r0, c0, c1 *5
S9 ok: vs.1.1 | dp4 oPos.x, v0, c0 | dp4 oPos.y, v0, c1 | dp4 oPos.z, v0, c2 | dp4 oPos.w, v0, c3
S10 d3d9: vs.1.1 | mov oPos, v0 | mov {oT0.y}, v7
O1: ps.1.4 | mov r0, {c8}
O1: vs.1.0 | mov oPos, v0 | mov {a1.x}, v0
O1: vs.1.1 | mov r9, v0 | mov r10, v0 | mov r11, v0 | m4x4 oPos, v0, {r9}
O1 ok: ps.1.4 | mov r0, c7
O2: vs.1.1 | mov {v0}, c0 | mov oPos, v0
O2: vs.1.1 | mov {c255}, v0 | mov oPos, v0
O3: ps.1.3 | mov r0, v0 | cnd r0, {a0.a}, v0, v1
O4: vs.1.0 | mov oPos, v0 | mov {a0.x}, v1.x
O5: vs.1.1 | mov oPos, v0 | mov {a0}, v0
O5: vs.1.1 | mov oPos, v0 | mov r0, {c[a0.x + 2]} | mov r0, c[a0.x + 2]
O9 ok: ps.1.4 | mul r0, c0, v0
O10: ps.1.1 | tex {r0} | mov r0, v0
O11: ps.1.4 | texcrd r1.rgb, t0 | texkill {r1} | phase | mov r0, v0
O11 ok: ps.1.4 | texcrd r1.rgb, t0 | texkill t1 | phase | texkill r1 | mov r0, v0
O12: ps.1.4 | texcrd {r1.rgb}, t0_dw.xyw | mov r0, c0
O12: ps.1.4 | texcrd r1.rgb, {r2} | mov r0, c0
O13: ps.1.1 | tex t0 | texbem t1, {c0} | mov r0, t1
O14: ps.1.4 | texcrd r5.rgb, t0 | texdepth {r5} | phase | mov r0, c0
O15: ps.1.1 | mov r0, v0 | cnd r0, {r0}, v0, v1
O15 ok: ps.1.4 | mov r1, c0 | cnd r0, r1, c0, c1
O17 ok: ps.1.4 | mov r0, c0 | cmp r0, r0, c0, c1
O18: ps.1.4 | {bem} r0.rg, c0, c1 | mov r0, c0
O25: ps.1.1 | def {r0}, 0, 0, 0, 0 | mov r0, v0
O26: vs.1.1 | m4x4 oPos, v0, {c93}
M1: ps.1.1 | mul r0, v0, {v0_x2}
M1 ok: ps.1.4 | mul_x8_sat r0, v0, v0_x2
M3: ps.1.1 | tex t0 | texm3x2pad t1, {1-t0} | texm3x2tex t2, t0 | mov r0, t2
M3: ps.1.4 | texld r0, {t0_bx2}
M7 ok: ps.1.4 | mov r0, v0 | mov r0.r, c0
M9: ps.1.0 | mov r0, v0 | mov r0.a, {v0.b}
M9: ps.1.1 | mov r0, {v0.r}
M10: ps.1.4 | texld r0, {t0.x}
M10: ps.1.4 | texcrd r0.rgb, t0 | phase | texld r1, {r0.xyw} | mov r0, r1
M12: ps.1.4 | texld r0, {t0_dw}
R1: vs.1.1 | mov a0.x, v0 | mov oPos, v0 | add r0, c2, {c[a0.x + 2]}
R1: vs.1.1 | m4x4 oPos, c8, {c0}
R2: vs.1.1 | m4x4 oPos, v0, {v1}
R6: ps.1.0 | mul r0, v0, {v1}
T3: ps.1.1 | tex t0 | texbem t1, {t2} | tex t2 | mov r0, t2
T4: ps.1.1 | tex t0 | texm3x2pad t1, t0 | {texm3x2tex} t3, t0 | mov r0, t3
T4: ps.1.1 | tex t0 | {texm3x2tex} t1, t0 | mov r0, t1
T5: ps.1.1 | tex t0 | {texm3x3vspec} t3, t0 | mov r0, t3
T9 ok: ps.1.1 | tex t0 | texbem t1, t0 | mov t0, v0 | add r0, t1, t0
T13: ps.1.4 | texcrd r0.rg, t0_dw.xyw | phase | texld r1, {r0} | mov r0, r1
T13: ps.1.4 | texld r0, t0 | phase | texld r1, t1 | texld r2, {r1} | mov r0, r2
T13: ps.1.4 | texcrd r0.rgb, t0 | texld r1, {r0} | mov r0, r1
T13: ps.1.4 | texcrd r1.rgb, t0 | texkill {r1} | mov r0, v0
T13: ps.1.4 | texcrd r1.rgb, t0 | phase | texld r1, t0 | texkill {r1} | texkill r1 | mov r0, v0
I1: ps.1.4 | phase | texkill {r1} | mov r0, v0
I1: vs.1.1 | m3x3 r0.xyz, v0, c0 | mov oPos, {r0} | mov oT0, r0
I1: ps.1.1 | mov r0.rgb, v0 | +mov r0.a, {r0.a}
I1 ok: vs.1.1 | m3x3 r0.xyz, v0, c0 | mov oPos, v0 | mov oT0.xyz, r0 | dp3 oT1.x, r0, r0
I1 ok: vs.1.1 | mov oPos, v0 | mov r0.x, v0 | mov oFog, r0 | mov oPts, r0
I3: ps.1.4 | texcrd r1.rg, t0_dw.xyw | mov r0, {r1.b}
I4 ok: ps.1.1 | mov t0, v0 | mov r0, t0
C2: ps.1.1 | tex t0 | +{mov} r0, t0
C2: ps.1.1 | mov r0.rgb, v0 | +mov r0.a, v0 | +{mov} r0.rgb, v1
C6: ps.1.4 | mov r0, c0 | mov r0.rgb, c1 | +{dp3} r0.a, c0, c1
C7: ps.1.1 | mov r0, v0 | +{nop}
";

/// The cases: identifier, dialect, whether nothing may be said, listing.
fn cases() -> impl Iterator<Item = (&'static str, Dialect, bool, &'static str)> {
    let lines = CASES.lines().filter(|l| !l.is_empty());
    lines.map(|line| {
        let (head, listing) = line.split_once(':').unwrap();
        let words: Vec<&str> = head.split(' ').collect();
        let dialect = if words.contains(&"d3d9") {
            Dialect::D3d9
        } else {
            Dialect::D3d8
        };
        (words[0], dialect, words.contains(&"ok"), listing.trim())
    })
}

#[test]
fn listings_break_the_rule_that_they_are_made_to_break() {
    let mut wrong = Vec::new();
    for (id, dialect, ok, line) in cases() {
        let listing = Marked::new(line);
        let found = listing.judge(dialect);
        let want: Vec<_> = listing.0.marks.iter().map(|m| (id, *m)).collect();
        assert_eq!(want.is_empty(), ok, "{id}: {line}");
        let got: Vec<_> = found.iter().map(|d| (d.rule.id, d.span)).collect();
        if got != want {
            let said: Vec<_> = found
                .iter()
                .map(|d| (d.rule.id, d.span, &d.message))
                .collect();
            wrong.push(format!("{id}: {line}\n    {said:?} instead of {want:?}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn every_message_is_written_for_people() {
    // S10 and S11 speak in d3d9 only.
    let listed = rules::all().map(|entry| (entry.rule.id, Dialect::D3d9, false, entry.breaks));
    for (id, dialect, _, line) in cases().chain(listed.filter(|(.., line)| line.contains("s.1."))) {
        for found in Marked::new(line).judge(dialect) {
            let help = found.help.unwrap_or_default();
            assert!(
                !found.message.is_empty() && !help.is_empty(),
                "{id}: {line}"
            );
            let both = format!("{} {help}", found.message);
            // No placeholder, no doubled blank, no unnamed mask.
            for hole in ["  ", "{", "Some(", " ,", "does not write ;"] {
                assert!(!both.contains(hole), "{id}: {both}");
            }
            assert!(
                !found.message.ends_with('.') && !help.ends_with('.'),
                "{both}"
            );
        }
    }
}

//! The listings of the article, as scanned and as restored.

use super::*;
use crate::isa::RegisterFile;
use crate::program::Register;

const VSH: &str = include_str!("../../../asm/stained_glass/stained_glass.vsh");
const PSH: &str = include_str!("../../../asm/stained_glass/stained_glass.psh");
const VSH_SCAN: &[u8] = include_bytes!("../../../asm/stained_glass/scanned/stained_glass.vsh");
const PSH_SCAN: &[u8] = include_bytes!("../../../asm/stained_glass/scanned/stained_glass.psh");

#[test]
fn the_restored_listings_have_nothing_to_report() {
    // Counted in the text: 18 instructions and a def; 19 instructions, phase among them, and a def.
    let vsh = accepted(VSH);
    assert_eq!(vsh.instructions().count(), 18);
    assert_eq!(vsh.definitions().count(), 1);
    let psh = accepted(PSH);
    assert_eq!(psh.instructions().count(), 19);
    assert_eq!(psh.definitions().count(), 1);
    assert!(psh.instructions().last().unwrap().co_issue);
}

/// Line and rule of each diagnostic.
fn places(text: &[u8]) -> Vec<(usize, &'static str)> {
    let (map, parsed) = read(text);
    let place = |d: &Diagnostic| (map.locate(d.span).unwrap().line, d.rule.id);
    parsed.diagnostics.iter().map(place).collect()
}

#[test]
fn each_damaged_place_of_the_vertex_listing_has_one_diagnostic() {
    // By hand against the restored text. Comments without `;`: 1 (a `:`), 9, 11, 12, 14, 16, 21, 23, 25.
    // Operands without mnemonic: 31 mov, 34 add, 38 dp3 (it slipped to 40), 41 rsq, 46, 47 and 59 dp3.
    // 54: the dp3 of one of these.
    let expected = [1, 9, 11, 12, 14, 16, 21, 23, 25]
        .map(|line| (line, "P5"))
        .into_iter()
        .chain([31, 34, 38, 41, 46, 47].map(|line| (line, "P9")))
        .chain([(54, "P10"), (59, "P9")]);
    assert_eq!(places(VSH_SCAN), expected.collect::<Vec<_>>());
}

#[test]
fn each_damaged_place_of_the_pixel_listing_has_one_diagnostic() {
    // The three lost dp3 lines and the damaged comments leave nothing behind that could be pointed at.
    let expected = [
        (5, "P13"),  // rl
        (15, "P8"),  // 1rp
        (15, "P14"), // .rqb
        (27, "P9"),  // mul
        (29, "P9"),  // mad
        (29, "P15"), // r4 x2
        (31, "P9"),  // +mov
    ];
    assert_eq!(places(PSH_SCAN), expected);
}

#[test]
fn misread_letters_are_repaired_and_stay_so() {
    let (text, count) = repaired(PSH_SCAN);
    assert_eq!(count, 4);
    for line in [
        "texcrd r1.rgb, t4\n",
        "lrp r2.rgb, c0.r, -r1, -r4;",
        "r0.rgb, r3, r4_x2, r1 ;",
    ] {
        assert!(text.contains(line), "{line}");
    }
    assert_eq!(repaired(&text), (text, 0));
    let (text, count) = repaired(VSH_SCAN);
    assert_eq!(count, 9);
    assert!(text.starts_with("; Sample vertex"));
    assert!(text.contains("\n       ; - Vertex Tangent U\n"));
    assert!(text.contains("\n         ; - 0, .5, 1, 2\n"));
    assert_eq!(repaired(&text), (text, 0));
}

#[test]
fn what_is_known_of_a_lost_mnemonic_is_told() {
    let told = told(VSH_SCAN);
    let line = |number: usize| {
        let start = format!("{number}:");
        told.lines().find(|l| l.starts_with(&start)).unwrap()
    };
    // One source, one component: the scalar instructions and mov; the scan lost rsq.
    assert!(line(41).contains("`mov`, `rcp`, `rsq`, `exp`, `log`"));
    assert!(!line(41).contains("`add`") && !line(41).contains("`m3x3`"));
    assert!(line(38).contains("`dp3`, which stands alone below them in line 40"));
    assert!(line(59).contains("a `dp3` without operands stands in line 54"));
    assert!(line(59).contains("`oT3.x` is written by `dp3`"));
    assert!(line(54).contains("the operands in line 59 have no mnemonic"));
}

#[test]
fn what_the_damage_hides_is_known_to_the_caller() {
    let damaged = read(PSH_SCAN).1.damaged;
    let registers: Vec<_> = damaged.iter().map(|d| d.destination).collect();
    // Lines 27, 29 and 31. What was certainly misread is in the program.
    let temp = |index| Some(Register::new(RegisterFile::Temp, index));
    assert_eq!(registers, [temp(1), temp(0), temp(0)]);
}

/// One letter of a good listing changed: little is said of it, whatever the letter became. A sign that is lost or won
/// may damage two operands and the instruction with them.
#[test]
fn one_changed_letter_makes_no_cascade() {
    for listing in [VSH, PSH] {
        let code: Vec<&str> = listing
            .lines()
            .map(|line| line.split(';').next().unwrap().trim_end())
            .filter(|line| !line.is_empty())
            .collect();
        let code = code.join("\n");
        for at in 0..code.len() {
            for letter in ["", " ", ",", ".", "x", "q", "1", "O", "-", "(", ":", "\n"] {
                let text = [&code[..at], letter, &code[at + 1..]].concat();
                let found = found(&text);
                assert!(found.len() <= 3, "{at} {letter:?}\n{}", told(&text));
            }
        }
    }
}

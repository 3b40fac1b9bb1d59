//! What is said about damaged text, and how it is repaired.

use super::*;
use crate::isa::Version;
use crate::syntax::{Options, parse_with, rules};

/// A damaged line and what certain repairs make of it; each has one diagnostic.
const REPAIRS: [(&str, &str, &str); 38] = [
    ("ps.1.4", "1rp r2, c0, -r1, -r4", "lrp r2, c0, -r1, -r4"),
    ("ps.1.4", "Irp r2, c0, -r1, -r4", "lrp r2, c0, -r1, -r4"),
    ("ps.1.4", "mu1 r0, r1, r2", "mul r0, r1, r2"),
    ("ps.1.4", "mu1_sat r0, r1, r2", "mul_sat r0, r1, r2"),
    ("ps.1.4", "rnad r0, r1, r2, r3", "mad r0, r1, r2, r3"),
    ("ps.1.4", "acld r0, r1, r2", "add r0, r1, r2"),
    ("vs.1.1", "s1t r0, r1, r2", "slt r0, r1, r2"),
    ("vs.1.1", "m3xB r0, r1, r2", "m3xB r0, r1, r2"),
    ("ps.1.4", "mov rl, r0", "mov r1, r0"),
    ("ps.1.4", "mov r0, v0\nmov r1, rO", "mov r0, v0\nmov r1, r0"),
    ("ps.1.1", "tex tO", "tex t0"),
    ("vs.1.1", "mov r0, cl2", "mov r0, c12"),
    ("vs.1.1", "mov rll, v0", "mov r11, v0"),
    ("vs.1.1", "mov oDO, v0", "mov oD0, v0"),
    ("vs.1.1", "mov 0Pos, v0", "mov oPos, v0"),
    ("vs.1.1", "mov r0, c 12", "mov r0, c12"),
    ("vs.1.1", "mov r0, c[aO.x + 2]", "mov r0, c[a0.x + 2]"),
    ("ps.1.4", "mov r0.rqb, r1", "mov r0.rgb, r1"),
    ("vs.1.1", "mov r0.xvzw, v0", "mov r0.xyzw, v0"),
    ("vs.1.1", "mov r0, v0.xyzvv", "mov r0, v0.xyzw"),
    ("vs.1.1", "mov r0.x2, v0", "mov r0.xz, v0"),
    ("ps.1.4", "mad r0, r3, r4 x2, r1", "mad r0, r3, r4_x2, r1"),
    ("ps.1.4", "mul r0, r3, r4 bx2.a", "mul r0, r3, r4_bx2.a"),
    ("ps.1.4", "mul r0, r3, r4.bx2", "mul r0, r3, r4_bx2"),
    ("ps.1.4", "mul r0, r3, r4_bxZ", "mul r0, r3, r4_bx2"),
    ("ps.1.4", "mul r0, r3_b1as, r4", "mul r0, r3_bias, r4"),
    ("ps.1.4", "mul_xZ r0, r3, r4", "mul_x2 r0, r3, r4"),
    ("ps.1.4", "mul x2 r0, r3, r4", "mul_x2 r0, r3, r4"),
    ("ps.1.4", "mul_x2 sat r0, r3, r4", "mul_x2_sat r0, r3, r4"),
    ("ps.1.4", "mulx2 r0, r3, r4", "mul_x2 r0, r3, r4"),
    ("ps.1.4", "mul r0, r3 r4", "mul r0, r3, r4"),
    ("ps.1.4", "mul r0. r3, r4", "mul r0, r3, r4"),
    (
        "ps.1.4",
        "def c0, O.5, l.O, Z.0f, 2",
        "def c0, 0.5, 1.0, 2.0f, 2",
    ),
    ("ps.1.4", "c0, 0.9f, 0, 0, 0", "def c0, 0.9f, 0, 0, 0"),
    ("ps.1.4", "mov r0, r1 : copy it", "mov r0, r1 ; copy it"),
    ("ps.1.4", "mov r0, r1 / copy it", "mov r0, r1 // copy it"),
    (
        "ps.1.4",
        "mov r0, r1 copy the colour",
        "mov r0, r1 ; copy the colour",
    ),
    ("ps.1.4", "mov r0, \u{2013}r1", "mov r0, -r1"),
];

#[test]
fn certain_repairs() {
    for (version, damaged, expected) in REPAIRS {
        let (text, _) = repaired(format!("{version}\n{damaged}\nnop\n"));
        assert_eq!(
            text,
            format!("{version}\n{expected}\nnop\n"),
            "{}",
            told(format!("{version}\n{damaged}\nnop\n"))
        );
        let found = found(format!("{version}\n{damaged}\nnop\n"));
        let places = if damaged.starts_with("def") { 3 } else { 1 };
        assert_eq!(found.len(), places, "{damaged}: {found:?}");
        if damaged != expected {
            accepted(text);
        }
    }
}

#[test]
fn one_diagnostic_for_each_damaged_place_and_none_for_the_rest() {
    for (text, expected) in [
        ("mov r0, r1,\nmov r2, r3", vec!["P11"]),
        ("mov r0,, r1", vec!["P11"]),
        ("mov r0, r1, r2, r3\nmov r0", vec!["P10", "P10"]),
        ("dp3\ndp3\nr0, r1, r2", vec!["P10"]),
        (
            "foo r0, r1\nbar r0, rqq, q1\nmov r0, q2",
            vec!["P8", "P8", "P13", "P13", "P13"],
        ),
        ("mov q1, q2.rgb", vec!["P13", "P13"]),
        ("ps.1.4\nmov q0, q0", vec!["S1"]),
        ("label:\nnop", vec!["P8"]),
        ("call l0", vec!["P8"]),
        ("xmma r0, r1, r2, r3", vec!["P8"]),
        ("mul_pp r0, r1, r2", vec!["P12"]),
        ("phase_sat", vec!["P12"]),
        ("def\nnop", vec!["P10"]),
        ("{ }\n}}\n\"mov r0, r1\\n\"", vec!["P20", "P20", "P20"]),
        (
            "---------------\nsample the map\n- done",
            vec!["P5", "P5", "P5"],
        ),
        ("add the two together", vec!["P5"]),
        ("r0 holds the colour", vec!["P5"]),
        ("+dcl_color v0", vec!["P19"]),
        ("mov r0, r1 /* open", vec!["P6"]),
        ("mov r99999999999, r0", vec!["P13"]),
        ("mov r, r0", vec!["P13"]),
    ] {
        let found = found(format!("ps.1.4\n{text}\n"));
        let rules: Vec<_> = found.iter().map(|(rule, _)| *rule).collect();
        assert_eq!(rules, expected, "{text}: {found:?}");
    }
}

#[test]
fn versions_that_are_none() {
    for (text, certain) in [
        ("vs_1.1", Some("vs.1.1")),
        ("ps.l.4", Some("ps.1.4")),
        ("ps 1.4", Some("ps.1.4")),
        ("ps1.4", Some("ps.1.4")),
        ("p5.1.4", Some("ps.1.4")),
        ("vs.1.O", Some("vs.1.0")),
        ("vs,1,1", Some("vs.1.1")),
        ("vs.2.0", None),
        ("ps_3_0", None),
        ("ps.1.5", None),
        ("xvs.1.1", None),
    ] {
        let (map, parsed) = read(format!("{text}\nnop\n"));
        let [d] = &parsed.diagnostics[..] else {
            panic!("{text}: {:?}", parsed.diagnostics);
        };
        assert_eq!((d.rule.id, map.text(d.span).as_ref()), ("P3", text));
        let fix = d.fix.as_ref().filter(|f| f.certain);
        assert_eq!(fix.map(|f| f.replacement.as_str()), certain, "{text}");
        assert_eq!(parsed.program.is_some(), certain.is_some());
    }
}

#[test]
fn a_missing_version_is_said_once_unless_the_caller_knows_it() {
    let text = "mov oPos, v0\nmov oD0, v5\n";
    let (map, parsed) = read(text);
    assert_eq!(parsed.diagnostics.len(), 1);
    assert_eq!(parsed.diagnostics[0].rule.id, "S1");
    assert!(
        parsed.diagnostics[0]
            .help
            .as_ref()
            .unwrap()
            .contains("vs.1.1")
    );
    assert!(parsed.program.is_none());
    let version = Some(Version::Vs10);
    let parsed = parse_with(
        &map.files()[1],
        Options {
            version,
            ..Options::default()
        },
    );
    assert_eq!(parsed.diagnostics, []);
    assert_eq!(parsed.program.unwrap().version, Version::Vs10);
    assert_eq!(found("nop\nmov r0, v0\nps.1.1\nmov r0, v0\n").len(), 1);
}

#[test]
fn files_that_are_no_listings_are_named() {
    for (bytes, what) in [
        (&b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR"[..], "PNG"),
        (b"DDS |\0\0\0", "DDS"),
        (b"\x01\x01\xFE\xFF\x01\0\0\0", "tokens"),
        (b"\x04\x01\xFF\xFF\x42\0\0\0", "tokens"),
        (b"\xFF\xFEp\0s\0.\0", "UTF-16"),
        (b"a\0\0bc", "binary"),
        (b"", "empty"),
        (b" \r\n\t", "empty"),
        (b"; only this\n", "only comments"),
        (b"Dear reader, this is a letter.\n", "Dear reader"),
    ] {
        let parsed = read(bytes).1;
        assert_eq!(parsed.diagnostics.len(), 1, "{what}");
        assert!(
            parsed.diagnostics[0].message.contains(what),
            "{:?}",
            parsed.diagnostics
        );
        assert!(parsed.program.is_none());
    }
}

#[test]
fn many_errors_end_in_one_that_says_so() {
    let text = format!("ps.1.4\n{}", "mov q, q\n".repeat(1000));
    let found = diagnostics(text);
    assert_eq!(found.len(), 101);
    assert_eq!(found.iter().filter(|d| d.rule.id == "P21").count(), 1);
    assert_eq!(found[100].rule.id, "P21");
    // Exactly as many as are shown: nothing more is said.
    let text = format!("ps.1.4\n{}", "foo q, q\n".repeat(50));
    assert!(diagnostics(text).iter().all(|d| d.rule.id != "P21"));
}

#[test]
fn repairs_of_one_place_do_not_meet() {
    use crate::diagnostic::{Fix, Span};
    let mut map = SourceMap::new();
    map.add("a", "abcdef").unwrap();
    let fix = |start, end, text: &str, certain| {
        let span = Span::new(start, end);
        Diagnostic::error(&rules::NOT_A_LISTING, span, "").with_fix(Fix {
            span,
            replacement: text.to_string(),
            certain,
        })
    };
    let list = [
        fix(4, 5, "E", true),
        fix(1, 3, "X", true),
        fix(2, 4, "Y", true),
        fix(0, 0, "+", true),
        fix(5, 6, "no", false),
        fix(90, 91, "out", true),
    ];
    // 0: "+" before a; 1..3 becomes X; 2..4 overlaps and is left; 4..5 becomes E.
    assert_eq!(
        apply_fixes(&map, &map.files()[0], &list),
        (b"+aXdEf".to_vec(), 3)
    );
}

#[test]
fn the_form_of_messages() {
    let text = "vs.1.1\nr11.y, r11.x\nmuk r0, r1, r2\nmov r0, c[a0.x - 1]\nmul r0, r1\n";
    assert_eq!(
        told(text),
        "2:1 P9 no mnemonic stands before these operands (instructions of vs.1.1 that take them: \
         `mov`, `rcp`, `rsq`, `exp`, `log`, `lit`, `frc`, `expp`, `logp`)\n\
         3:1 P8 `muk` is no instruction (did you mean `mul`?) [\"muk\" -> \"mul\"?]\n\
         4:10 P16 the numbers in this index add up to less than 0, which no token can say\n\
         5:1 P10 `mul` takes 3 operands (a destination and 2 sources), but 2 are written \
         (instructions of vs.1.1 that take these operands: `mov`, `rcp`, `rsq`, `exp`, `log`, `lit`, `expp`, `logp`)\n"
    );
}

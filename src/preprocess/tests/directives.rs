//! Directives one by one.

use super::*;

#[test]
fn a_text_without_directives_is_left_alone() {
    let text = "ps.1.1 ; it's \"so\"\r\n/* mov\n r0 */ mov r0, v0 // end";
    let (sources, done) = run(text, &[], &[]);
    assert_eq!(sources.text(done.text.unwrap()), text);
    assert!(!super::super::is_needed(
        text.as_bytes(),
        &Options::default()
    ));
}

#[test]
fn definitions_hold_until_undef() {
    assert_eq!(
        out("#define A c1\nA\n#undef A\nA\n#undef NEVER\n"),
        "c1\nA\n"
    );
    // Blanks before and behind the #, comments behind the text.
    assert_eq!(
        out("  #  define A  c1 /* x */ . x  ; the first\nA\n"),
        "c1 . x\n"
    );
    assert_eq!(out("#define EMPTY\n[EMPTY]\n"), "[]\n");
    assert_eq!(out("\u{feff}#define A b\nA"), "b\n");
}

#[test]
fn definitions_from_outside() {
    let text = "#ifdef FOG\nfog FOG WHERE M(3)\n#endif\n";
    assert_eq!(
        out_of(text, &[], &["FOG", "WHERE=c2.x", "M(a)=c[a]"]),
        "fog 1 c2.x c[3]\n"
    );
    for bad in ["", "1A", "A B", "A(", "A=x\ny", "-"] {
        assert!(bad.parse::<super::super::Definition>().is_err(), "{bad:?}");
    }
}

#[test]
fn one_part_of_a_condition_is_read() {
    let text = "#if A == 1\none\n#elif A == 2\ntwo\n#elif A\nmore\n#else\nnone\n#endif\nend\n";
    for (value, expected) in [("1", "one"), ("2", "two"), ("3", "more"), ("0", "none")] {
        assert_eq!(
            out_of(text, &[], &[&format!("A={value}")]),
            format!("{expected}\nend\n")
        );
    }
    assert_eq!(
        out("#ifdef A\na\n#else\nb\n#endif\n#ifndef A\nc\n#else\nd\n#endif\n"),
        "b\nc\n"
    );
}

#[test]
fn nothing_is_read_in_parts_that_do_not_hold() {
    let text = "#if 0\n#define A 1\n#error no\n#include \"none\"\n#if 1\nx\n#else\ny\n#endif\n#elif\n#nonsense\n'\"\n#endif\nA\n";
    // The #elif without an expression is reached, so it is not passed over.
    assert_eq!(told(text, &[])[0].split(' ').nth(1), Some("P27"));
    let text = text.replace("#elif\n", "");
    assert_eq!(out(&text), "A\n");
    // A comment may hide directives; one with a semicolon is no comment of C.
    assert_eq!(out("#if 0\n/*\n#endif\n*/\nx\n#endif\ny\n"), "y\n");
    assert_eq!(out("#if 0\n; /*\n#endif\ny\n"), "y\n");
}

#[test]
fn expressions_are_those_of_c() {
    // Worked out by hand.
    for (expression, value) in [
        ("1 + 2 * 3 == 7", true),
        ("(1 + 2) * 3 == 9", true),
        ("10 - 2 - 3 == 5", true),
        ("1 << 4 == 16", true),
        ("7 / 2 == 3 && 7 % 2 == 1", true),
        ("-7 / 2 == -3", true),
        ("!0 && !!5", true),
        ("~0 == -1", true),
        ("0x10 == 16 && 010 == 8 && 10UL == 10", true),
        ("6 & 3 ^ 1 | 8", true),
        ("(6 & 3 ^ 1 | 8) == 11", true),
        ("1 ? 0 : 1", false),
        ("0 ? 1 / 0 : 2", true),
        ("0 && 1 / 0", false),
        ("1 || 1 / 0", true),
        ("UNKNOWN", false),
        ("defined A && defined(A) && !defined B", true),
        ("A > 1 && A <= 2 && A != 3 && A >= 2 && 1 < A", true),
        ("TWICE(A) == 4", true),
        ("defined TWICE", true),
        ("2 \\\n == 2 // so", true),
    ] {
        let text = format!(
            "#define A 2\n#define TWICE(x) (x + x)\n#if {expression}\nyes\n#else\nno\n#endif\n"
        );
        let expected = if value { "yes\n" } else { "no\n" };
        assert_eq!(out(&text), expected, "{expression}");
    }
}

#[test]
fn expressions_that_cannot_be_read() {
    for (expression, message) in [
        ("", "the expression ends where a value should stand"),
        ("1 +", "the expression ends where a value should stand"),
        ("1 2", "`2` stands behind the end of the expression"),
        ("1 / 0", "this divides by zero"),
        ("0.5", "`0.5` is no whole number"),
        ("(1", "this parenthesis is not closed"),
        ("defined", "no name follows `defined`"),
        ("1 ? 2", "no `:` follows this `?`"),
        ("\"a\"", "`\"a\"` stands where a value should"),
    ] {
        let (_, done) = run(&format!("#if {expression}\n#endif\n"), &[], &[]);
        let messages: Vec<&str> = done
            .diagnostics
            .iter()
            .map(|d| d.message.as_str())
            .collect();
        assert_eq!(messages, [message], "{expression}");
    }
}

#[test]
fn conditions_belong_together() {
    assert_eq!(
        told("#endif\n", &[]),
        ["listing:1:1 P26 no #if stands before this #endif"]
    );
    assert_eq!(
        told("x\n #else\n", &[]),
        ["listing:2:2 P26 no #if stands before this #else"]
    );
    assert_eq!(
        told("#if 1\nx\n", &[]),
        ["listing:1:1 P26 this condition has no #endif"]
    );
    assert_eq!(
        told("#if 1\n#else\n#else\n#endif\n", &[]),
        ["listing:3:1 P26 this #else stands behind the #else of its #if"]
    );
    // Each file has its own.
    assert_eq!(
        told(
            "#if 1\n#include \"a\"\n#endif\n",
            &[("a", "#endif\n#if 1\n")]
        ),
        [
            "a:1:1 P26 no #if stands before this #endif",
            "a:2:1 P26 this condition has no #endif"
        ]
    );
    assert_eq!(
        told("#ifdef\n#endif\n", &[]),
        ["listing:1:1 P26 #ifdef has no name"]
    );
}

#[test]
fn files_are_included() {
    let files = [
        ("consts.h", "#define A c1\nfrom consts"),
        ("sub/b.h", "#include <consts.h>\nB A\n"),
    ];
    assert_eq!(
        out_of("#include \"sub/b.h\"\nA\n", &files, &[]),
        "from consts\nB c1\nc1\n"
    );
    // Named by a macro.
    assert_eq!(
        out_of("#define F \"consts.h\"\n#include F\nA\n", &files, &[]),
        "from consts\nc1\n"
    );
    // With a guard, twice does no harm.
    let guarded = [(
        "g.h",
        "#ifndef G\n#define G\nonce\n#include \"g.h\"\n#endif\n",
    )];
    assert_eq!(
        out_of("#include \"g.h\"\n#include \"g.h\"\n", &guarded, &[]),
        "once\n"
    );
    assert_eq!(
        told(
            "x\n#include \"none.h\"\n#include none\n#include \"\"\n",
            &[("nul", "a\0b")]
        ),
        [
            "listing:2:10 P28 `none.h` cannot be read: there is no such file",
            "listing:3:10 P28 #include names no file",
            "listing:4:10 P28 #include names no file",
        ]
    );
    assert_eq!(
        told("#include \"nul\"\n", &[("nul", "a\0b")]),
        ["listing:1:10 P28 `nul` is no text"]
    );
}

#[test]
fn line_and_pragma_say_nothing_and_error_ends() {
    assert_eq!(
        out("#line 12 \"a\"\n# 13 \"b\"\n#pragma once\n#\na\n"),
        "a\n"
    );
    let (_, done) = run("a\n#error no fog: never\nb\n#endif\n", &[], &[]);
    assert_eq!(done.text, None);
    assert_eq!(done.diagnostics.len(), 1);
    assert_eq!(
        told("\n #error no fog: never\n", &[]),
        ["listing:2:2 P30 #error: no fog: never"]
    );
}

#[test]
fn what_is_no_directive() {
    assert_eq!(
        told("#defin A\n", &[]),
        ["listing:1:1 P25 `#defin` is no directive"]
    );
    assert_eq!(
        told("#define\n", &[]),
        ["listing:1:2 P25 #define has no name"]
    );
    assert_eq!(
        told("#define 1\n", &[]),
        ["listing:1:9 P25 #define has no name"]
    );
    assert_eq!(
        told("#define A(1) x\n", &[]),
        ["listing:1:9 P25 the parameters of this macro are no list of names"]
    );
    assert_eq!(
        told("#undef\n", &[]),
        ["listing:1:2 P25 #undef has no name"]
    );
    assert_eq!(
        told("#define A 1 /* x\nb\n", &[]),
        ["listing:1:13 P25 this comment has no end: everything behind it is lost"]
    );
    // A # that does not begin its line is no directive.
    assert_eq!(out("x #define A\n"), "x #define A\n");
}

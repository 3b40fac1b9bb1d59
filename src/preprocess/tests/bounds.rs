//! No text may panic, hang or fill the memory.

use super::*;
use proptest::prelude::*;
use std::time::{Duration, Instant};

/// Generous: this is to find what never ends, not to measure.
const SOON: Duration = Duration::from_secs(30);

#[track_caller]
fn ends(text: &str, files: &[(&str, &str)], rule: &str) {
    let began = Instant::now();
    let (sources, done) = run(text, files, &[]);
    assert!(began.elapsed() < SOON);
    let rules: Vec<&str> = done.diagnostics.iter().map(|d| d.rule.id).collect();
    assert_eq!(rules, [rule]);
    // The place is one of the text or of a file.
    assert!(sources.locate(done.diagnostics[0].span).is_some());
    assert_eq!(done.text, None);
}

#[test]
fn doubling_macros_end() {
    let mut text = String::from("#define A0 x x\n");
    for i in 1..60 {
        text += &format!("#define A{i} A{} A{}\n", i - 1, i - 1);
    }
    ends(&(text.clone() + "A59\n"), &[], "P29");
    // Also if nothing comes out, or if one word grows.
    ends(&(text.replace("x x", "") + "A59\n"), &[], "P29");
    let mut text = String::from("#define J(a) a##a\n#define D(a) J(a)\n");
    text += &(["D("; 40].concat() + "x" + &")".repeat(40) + "\n");
    ends(&text, &[], "P29");
}

#[test]
fn files_that_include_themselves_end() {
    ends(
        "#include \"a\"\n",
        &[("a", "x\n#include \"a\"\n#include \"a\"\n")],
        "P29",
    );
    ends(
        "#include \"a\"\n",
        &[("a", "#include \"b\"\n"), ("b", "#include \"a\"\n")],
        "P29",
    );
    // Not deep, but many.
    let files: Vec<(String, String)> = (0..20)
        .map(|i| {
            (
                format!("f{i}"),
                format!("#include \"f{}\"\n", i + 1).repeat(2),
            )
        })
        .chain([("f20".to_string(), String::new())])
        .collect();
    let files: Vec<(&str, &str)> = files
        .iter()
        .map(|(n, t)| (n.as_str(), t.as_str()))
        .collect();
    ends("#include \"f0\"\n", &files, "P29");
    // Large, and often.
    let large = "; comment\n".repeat(100_000);
    ends(&"#include \"a\"\n".repeat(8), &[("a", &large)], "P29");
}

#[test]
fn large_outputs_end() {
    let line = "y".repeat(1000);
    let text = format!("#define A {line} {line}\n{}", "A A A A\n".repeat(2000));
    ends(&text, &[], "P29");
}

#[test]
fn deep_texts_end() {
    let began = Instant::now();
    let deep = 20_000;
    let open = "(".repeat(deep);
    run(&format!("#if {open}1\n#endif\n"), &[], &[]);
    run(&format!("#if {}1\n#endif\n", "!".repeat(deep)), &[], &[]);
    run(&format!("#if {}1\n#endif\n", "1?".repeat(deep)), &[], &[]);
    run(&format!("#if {}1\n#endif\n", "1||".repeat(deep)), &[], &[]);
    run(&"#if 1\n".repeat(deep), &[], &[]);
    let calls = "M(".repeat(deep);
    run(&format!("#define M(x) x\n{calls}"), &[], &[]);
    run(
        &format!("#define M(x) x\n{calls}1{}\n", ")".repeat(deep)),
        &[],
        &[],
    );
    // A chain of macros, each used in the next.
    let chain: String = (1..deep)
        .map(|i| format!("#define A{i} A{}\n", i - 1))
        .collect();
    run(&format!("{chain}A{}\n", deep - 1), &[], &[]);
    run(&"#define M(x) M\nM(1)".repeat(deep), &[], &[]);
    assert!(began.elapsed() < SOON);
}

/// Words of which soups are made; `\n` is frequent, as directives begin lines.
const WORDS: [&str; 44] = [
    "\n",
    "\n",
    "\n",
    "#define ",
    "#define A",
    "#define M(x) ",
    "#define M(x, y) ",
    "#undef A",
    "#if ",
    "#ifdef A",
    "#ifndef M",
    "#elif ",
    "#else",
    "#endif",
    "#include \"a\"",
    "#include <b>",
    "#include A",
    "#line 3",
    "#error",
    "#pragma",
    "#",
    "##",
    "A",
    "B",
    "M",
    "M(",
    "(",
    ")",
    ",",
    "x",
    "y",
    "A_bx2",
    "1",
    "0x",
    "defined",
    "defined(A)",
    " ",
    "\\\n",
    "/*",
    "*/",
    ";",
    "//",
    "\"",
    "+&&|?:<",
];

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]
    #[test]
    fn soups(words in proptest::collection::vec(0..WORDS.len(), 0..120), more in proptest::collection::vec(0..WORDS.len(), 0..30)) {
        let text: String = words.iter().map(|w| WORDS[*w]).collect();
        let file: String = more.iter().map(|w| WORDS[*w]).collect();
        let (sources, done) = run(&text, &[("a", &file), ("b", "#define B(x) x A\n")], &[]);
        prop_assert!(done.diagnostics.len() <= 101);
        for d in &done.diagnostics {
            prop_assert!(sources.locate(d.span).is_some());
        }
        // Every place of what comes out leads to a text that somebody wrote.
        if let Some(text) = done.text {
            for at in text.start..=text.end {
                let span = crate::diagnostic::Span::new(at, (at + 3).min(text.end).max(at));
                let written = sources.written(span);
                prop_assert!(text.start == text.end || written.start < text.start);
                prop_assert!(written.start <= written.end);
                sources.notes(span);
            }
        }
    }

    #[test]
    fn bytes(bytes in proptest::collection::vec(any::<u8>(), 0..400)) {
        let mut sources = SourceMap::new();
        let text = [b"#define A(x) x\n#if 1\nA(", &bytes[..]].concat();
        let file = sources.add("listing", text).unwrap().span();
        preprocess(&mut sources, file, &Options::default());
    }
}

//! Where what comes out was written. Places were counted by hand.

use super::*;
use crate::diagnostic::Span;

/// Place and notes of the `nth` `word` of what comes out.
fn place(
    text: &str,
    files: &[(&str, &str)],
    word: &str,
    nth: usize,
) -> (String, Vec<String>, bool) {
    let (sources, done) = run(text, files, &[]);
    let whole = done.text.unwrap();
    let made = sources.text(whole).into_owned();
    let (at, _) = made.match_indices(word).nth(nth).unwrap();
    let span = Span::new(
        whole.start + at as u32,
        whole.start + (at + word.len()) as u32,
    );
    let tell = |span: Span| {
        let at = sources.locate(span).unwrap();
        format!(
            "{}:{}:{}-{}:{}",
            at.file, at.line, at.column, at.end_line, at.end_column
        )
    };
    let notes = sources.notes(span).into_iter();
    let notes = notes.map(|n| {
        format!("{} {}", n.message, n.span.map_or(String::new(), tell))
            .trim_end()
            .to_string()
    });
    (
        tell(span),
        notes.collect(),
        sources.editable(span).is_some(),
    )
}

#[test]
fn text_of_the_listing() {
    let text = "#define A c1\nmov r0, A\nadd r1, r0, A ; x\n";
    assert_eq!(
        place(text, &[], "r1", 0),
        ("listing:3:5-3:7".into(), vec![], true)
    );
    assert_eq!(
        place(text, &[], "; x", 0),
        ("listing:3:15-3:18".into(), vec![], true)
    );
}

#[test]
fn text_of_a_macro() {
    let text = "#define A -c1.q\nmov r0, A, r1\n";
    let (at, notes, own) = place(text, &[], "q", 0);
    assert_eq!(at, "listing:2:9-2:10");
    assert_eq!(
        notes,
        [
            "expanded, this reads `q`",
            "in the expansion of `A`, defined here listing:1:15-1:16"
        ]
    );
    assert!(!own);
    // A span that reaches over its ends is told with both.
    let (at, notes, own) = place(text, &[], "r0, -c1.q, r1", 0);
    assert_eq!(at, "listing:2:5-2:14");
    assert_eq!(notes[0], "expanded, this reads `r0, -c1.q, r1`");
    assert!(notes[1].ends_with("listing:1:11-1:16"));
    assert!(!own);
}

#[test]
fn text_of_an_argument() {
    let text = "#define TWICE(x) add x, x\n  TWICE(r0.q)\n";
    let (at, notes, _) = place(text, &[], "r0.q", 1);
    assert_eq!((at.as_str(), notes.len()), ("listing:2:9-2:13", 0));
    let (at, notes, _) = place(text, &[], "add", 0);
    assert_eq!(at, "listing:2:3-2:14");
    assert!(notes[1].ends_with("listing:1:18-1:21"), "{notes:?}");
}

/// An argument with what the macro puts behind it is told as the argument; what begins in the macro as its use.
#[test]
fn text_of_a_macro_and_an_argument() {
    let text = "#define M(d, s) mov d.x, s\n M(r0, c1)\n";
    let (at, notes, own) = place(text, &[], "r0.x", 0);
    assert_eq!((at.as_str(), own), ("listing:2:4-2:6", false));
    assert_eq!(notes[0], "expanded, this reads `r0.x`");
    let (at, _, _) = place(text, &[], "mov r0.x, c1", 0);
    assert_eq!(at, "listing:2:2-2:11");
}

#[test]
fn macros_in_macros_in_files() {
    let text = "\n#include \"a.h\"\nOUTER(r0)\nINNER\n";
    let files = [(
        "a.h",
        "; defs\n#define INNER c99\n#define OUTER(d) mov d, INNER\nlost text\n",
    )];
    let (at, notes, _) = place(text, &files, "c99", 0);
    assert_eq!(at, "listing:3:1-3:10");
    assert_eq!(
        notes,
        [
            "expanded, this reads `c99`",
            "in the expansion of `OUTER`, defined here a.h:3:25-3:30",
            "in the expansion of `INNER`, defined here a.h:2:15-2:18",
        ]
    );
    // Text of the file itself.
    let (at, notes, own) = place(text, &files, "lost", 0);
    assert_eq!(at, "a.h:4:1-4:5");
    assert_eq!(notes, ["the file is included here listing:2:10-2:15"]);
    assert!(own);
}

#[test]
fn a_macro_with_a_suffix() {
    let text = "#define T t0\nmov r0, T_bx2\n";
    let (at, _, _) = place(text, &[], "t0", 0);
    assert_eq!(at, "listing:2:9-2:10");
    let (at, notes, own) = place(text, &[], "_bx2", 0);
    assert_eq!(
        (at.as_str(), notes.len(), own),
        ("listing:2:10-2:14", 0, true)
    );
    let (at, _, own) = place(text, &[], "t0_bx2", 0);
    assert_eq!((at.as_str(), own), ("listing:2:9-2:14", false));
}

/// Every byte that was not made by a macro leads to the same byte.
#[test]
fn every_byte_of_a_listing() {
    let text = "; c\n#if 1\nvs.1.1\n#define A c1\n#endif\nmov r0, A\n/* x\n */ mov r1, A ; A\n";
    let (sources, done) = run(text, &[], &[]);
    let whole = done.text.unwrap();
    for at in whole.start..whole.end {
        let here = Span::new(at, at + 1);
        if let Some(own) = sources.editable(here) {
            assert_eq!(sources.text(own), sources.text(here));
        } else {
            // Of the two uses of A.
            assert!(["c", "1"].contains(&&*sources.text(here)));
        }
    }
}

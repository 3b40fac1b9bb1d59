//! No text may panic, hang or fill the memory.

use super::*;
use proptest::prelude::*;
use std::time::{Duration, Instant};

const LISTING: &str = include_str!("../../../asm/stained_glass/stained_glass.psh");
const SCAN: &[u8] = include_bytes!("../../../asm/stained_glass/scanned/stained_glass.vsh");

/// Reads, checks that every place is in the text, repairs, and prints what was read.
fn survives(text: &[u8]) -> usize {
    let (map, parsed) = read(text);
    let file = &map.files()[1];
    let whole = file.span();
    for d in &parsed.diagnostics {
        let spans = std::iter::once(d.span).chain(d.fix.iter().map(|f| f.span));
        for span in spans {
            assert!(
                whole.start <= span.start && span.start <= span.end && span.end <= whole.end,
                "{d:?} outside of {whole:?}"
            );
        }
    }
    apply_fixes(&map, file, &parsed.diagnostics);
    if let Some(program) = &parsed.program {
        crate::syntax::print(program);
    }
    assert!(parsed.diagnostics.len() <= 101);
    parsed.diagnostics.len()
}

proptest! {
    #[test]
    fn random_bytes(bytes in proptest::collection::vec(any::<u8>(), 0..2000)) {
        survives(&bytes);
        survives(&[b"ps.1.4\n", &bytes[..]].concat());
    }

    #[test]
    fn random_words(words in proptest::collection::vec(0_usize..WORDS.len(), 0..200), pixel: bool) {
        let mut text = String::from(if pixel { "ps.1.4\n" } else { "vs.1.1\n" });
        words.iter().for_each(|&w| text += WORDS[w]);
        survives(text.as_bytes());
    }

    #[test]
    fn random_changes(
        changes in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0..3), 1..30),
        scan: bool,
    ) {
        let mut text = if scan { SCAN.to_vec() } else { LISTING.as_bytes().to_vec() };
        for (at, byte, what) in changes {
            let at = at.index(text.len());
            match what {
                0 => text[at] = byte,
                1 => text.insert(at, byte),
                _ => { text.remove(at); }
            }
        }
        survives(&text);
    }
}

const WORDS: [&str; 48] = [
    "mov",
    " ",
    " ",
    "\n",
    "\n",
    ",",
    ", ",
    ".",
    "+",
    "-",
    "1-",
    "[",
    "]",
    "a0.x",
    "c12",
    "r1",
    "r",
    "t0",
    "oPos",
    "rgb",
    "xyzw",
    ".r",
    "_x2",
    "_sat",
    "x2",
    "def",
    "dcl",
    "dcl_",
    "position",
    "0.5",
    "1e99",
    "15",
    "99999999999",
    ":",
    ";",
    "//",
    "/*",
    "*/",
    "#",
    "#define",
    "phase",
    "dp3",
    "1rp",
    "rl",
    "texld",
    "foo",
    "\u{2013}",
    "ps.1.4",
];

/// Pieces that are repeated to make large texts.
const PIECES: [&str; 51] = [
    "v\n",
    "p p p p p\n",
    "#define X\nFOO r0\n",
    "FOO, r0\n",
    "x2",
    "mov r0, r1 ",
    "mov r0, r1\n",
    "nop ",
    "def c0, 1, 2, 3, 4 ",
    "mov r0 r1 ",
    "1rp r0 ",
    "r0 ",
    "foo ",
    "(",
    "-",
    "+",
    ",",
    ".",
    "[",
    "]",
    ":",
    "0",
    "9.",
    "a",
    "_",
    "/",
    "#",
    "# ",
    "#define ",
    "\\\n#",
    "*",
    "/*",
    "\n",
    "\r",
    " ",
    "\u{2013}",
    "\u{A0}",
    "1-",
    "r1,",
    "x2 ",
    "c[",
    "c[1+",
    "+mov ",
    "mul_x2",
    "_x2",
    "r0.",
    "e",
    "|",
    "vs.",
    "ps.1.4 ",
    "dcl_",
];

/// Each on its own, so that a quadratic step, which would take minutes here, is found. Linear reading takes some
/// tenths of a second, unoptimised; the limit is far above that, because a busy machine is no fault.
#[test]
fn long_repetitions_take_linear_time() {
    for piece in PIECES {
        for version in [
            "ps.1.4\n",
            "ps.1.4 def c0, ",
            "ps.1.4 mov r0, ",
            "ps.1.4\n#define X\n",
            "",
        ] {
            timed(
                version,
                piece,
                SourceMap::MAX_BYTES / 32,
                Duration::from_secs(60),
            );
        }
    }
}

#[test]
fn the_largest_texts_end_quickly() {
    for piece in ["(", "-", "mov r0, r1 ", "1rp r0\n"] {
        timed(
            "ps.1.4\n",
            piece,
            SourceMap::MAX_BYTES - 16,
            Duration::from_secs(60),
        );
    }
    timed(
        "",
        "\x07a",
        SourceMap::MAX_BYTES - 16,
        Duration::from_secs(60),
    );
}

fn timed(version: &str, piece: &str, size: usize, limit: Duration) {
    let text = version.to_string() + &piece.repeat(size / piece.len());
    let start = Instant::now();
    survives(text.as_bytes());
    assert!(start.elapsed() < limit, "{version:?} and {piece:?}");
}

#[test]
fn a_line_of_a_million_letters() {
    for piece in ["q", "1", "l", "r", "rn", "x2", "_x2"] {
        let text = format!(
            "ps.1.4\nmov {0}.{0}, {0}_{0}\n{0} r0, r1\n",
            piece.repeat(200_000)
        );
        let count = survives(text.as_bytes());
        assert!((1..10).contains(&count), "{piece}: {count}");
    }
}

#[test]
fn messages_stay_short() {
    let text = format!("ps.1.4\n{0} r0, {0}\n: {0}\n({0} {0})", "q".repeat(100_000));
    for d in diagnostics(text) {
        assert!(d.message.len() < 400 && d.help.is_none_or(|h| h.len() < 400));
    }
}

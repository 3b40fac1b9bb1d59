//! The layout of listings. Expected texts were written by hand.

use super::super::{format, format_block};
use super::*;
use proptest::prelude::*;

#[track_caller]
fn laid_out(text: &str) -> String {
    let once = format(text.as_bytes());
    assert_eq!(format(&once), once, "laid out twice");
    String::from_utf8(once).unwrap()
}

#[test]
fn blanks() {
    for (text, expected) in [
        ("ps.1.1\n  mul   r0 ,v0,  c1", "ps.1.1\nmul r0, v0, c1\n"),
        ("mov r0, 1 - v0\n", "mov r0, 1-v0\n"),
        ("mov r0,-v0 . rgb\n", "mov r0, -v0.rgb\n"),
        ("mov r0, c [ a0.x+3 -1 ]\n", "mov r0, c[a0.x + 3 - 1]\n"),
        ("mov r0, c8[ -1+a0 . x ].xy\n", "mov r0, c8[-1 + a0.x].xy\n"),
        ("def c0,1,-2 ,  .5f,0\n", "def c0, 1, -2, .5f, 0\n"),
        ("+ mov r0.a, v0\n", "+mov r0.a, v0\n"),
        (
            "mul r0.rgb, v0, v1   +\n  mov r0.a, v0",
            "mul r0.rgb, v0, v1 +\nmov r0.a, v0\n",
        ),
        ("ps.1.1 mov r0,v0 nop\n", "ps.1.1 mov r0, v0 nop\n"),
        ("  phase\n\tnop\n", "phase\nnop\n"),
        ("mov r0, v0  \r\n\r\nnop\r\n", "mov r0, v0\r\n\r\nnop\r\n"),
        ("", ""),
        ("\u{feff}ps.1.1\n nop", "\u{feff}ps.1.1\nnop\n"),
    ] {
        assert_eq!(laid_out(text), expected);
    }
}

#[test]
fn comments_stand_in_columns() {
    assert_eq!(
        laid_out(
            "; head\nps.1.1 ; version\n  tex t0 ;one\n; between\nmul r0, t0, v0;two\n     ; more of two\n; alone\n\nmov r0, r0 // other\n"
        ),
        "; head\n\
         ps.1.1         ; version\n\
         tex t0         ;one\n\
         ; between\n\
         mul r0, t0, v0 ;two\n\
         \x20              ; more of two\n\
         ; alone\n\
         \n\
         mov r0, r0 // other\n"
    );
    // A long line has its comment behind it and leaves the others where they are.
    let long = "def c0, 0.123456789, 0.123456789, 0.123456789, 0.12";
    assert_eq!(
        laid_out(&format!("{long}   ; long\nnop    ; short\n")),
        format!("{long} ; long\nnop ; short\n")
    );
}

#[test]
fn operands_stand_in_columns_where_they_did() {
    assert_eq!(
        laid_out(
            "mov  r0, c0\ntexcrd r1.rgb, t0\n+mov r1.a, c0\ndef c0, 0,0,0,0\n\nmov r0, c0\ntexcrd r1, t0\n"
        ),
        "mov    r0, c0\ntexcrd r1.rgb, t0\n+mov   r1.a, c0\ndef c0, 0, 0, 0, 0\n\nmov r0, c0\ntexcrd r1, t0\n"
    );
    // Mnemonics of one length need no second blank.
    assert_eq!(laid_out("mov   r0, c0\n"), "mov r0, c0\n");
}

#[test]
fn what_is_not_understood_stays() {
    let text = "#define  M( a )   mov r0,a \\\n   nop,x ; y\n#if  A\n  M( c0 ,c1 )\nmov r0 ,/* x */ c0\n/* a\n  mov r0 ,c0\n*/\n 1rp r0 ,c0\n  r0 ,c0\n\"ps.1.1\"  ,\n";
    assert_eq!(laid_out(text), text);
}

/// The article of the stained glass, whose comments stand in a column.
#[test]
fn listings_of_articles_are_read_as_before() {
    for name in ["stained_glass.psh", "stained_glass.vsh"] {
        let text = std::fs::read(format!(
            "{}/asm/stained_glass/{name}",
            env!("CARGO_MANIFEST_DIR")
        ))
        .unwrap();
        let text = String::from_utf8(text).unwrap();
        let formatted = laid_out(&text);
        let comments = |text: &str| text.matches(';').count();
        assert_eq!(comments(&formatted), comments(&text));
        let print = |text: &str| crate::syntax::print(&read(text).1.program.unwrap());
        assert_eq!(print(&formatted), print(&text));
    }
}

/// What `print` writes is laid out.
#[test]
fn printed_listings_are_laid_out() {
    let text = "vs.1.1\ndcl_position v0\ndef c0, 1, -0.5, 1e-7, 3\nmov a0.x, v0.x\nm4x4 oPos, v0, c[a0.x + 3]\nmov oD0, -c2.x\nnop\n";
    let printed = crate::syntax::print(&accepted(text));
    assert_eq!(laid_out(&printed), printed);
    let text =
        "ps.1.4\ntexld r0, t0_dw.xyw\nphase\nmul_x2_sat r0.rgb, 1-r0, r0_bx2.a\n+mov r0.a, -r0\n";
    let printed = crate::syntax::print(&accepted(text));
    assert_eq!(laid_out(&printed), printed);
}

#[test]
fn blocks_keep_their_first_and_last_line() {
    let block = |text: &str| String::from_utf8(format_block(text.as_bytes())).unwrap();
    assert_eq!(
        block(" vs.1.1\n      mov  oPos,v0 ;a\n\n    ; alone\n        dp3 r0.x , v0,v0\n    "),
        " vs.1.1\n      mov oPos, v0 ;a\n\n      ; alone\n      dp3 r0.x, v0, v0\n    "
    );
    assert_eq!(block(" ps.1.1 mov r0 ,v0 "), " ps.1.1 mov r0 ,v0 ");
}

proptest! {
    /// Laid out once is laid out, and the tokens are the same, whatever the text.
    #[test]
    fn soups(words in proptest::collection::vec(0..WORDS.len(), 0..100), indented: bool) {
        let text: String = words.iter().map(|w| WORDS[*w]).collect();
        let once = format(text.as_bytes());
        prop_assert_eq!(format(&once), once.clone(), "{:?}", text);
        let tokens = |text: &[u8]| -> Vec<Vec<u8>> {
            let all = super::super::lexer::tokens(text);
            all.iter().map(|t| text[t.start as usize..t.end as usize].to_vec()).collect()
        };
        prop_assert_eq!(tokens(&once), tokens(text.as_bytes()));
        if indented {
            format_block(text.as_bytes());
        }
    }
}

const WORDS: [&str; 40] = [
    "mov",
    "mul_x2",
    "def",
    "ps.1.1",
    " ",
    "  ",
    "\n",
    "\n",
    "\n",
    "\r\n",
    "r0",
    "c",
    "c0",
    ",",
    ",",
    ".",
    ".rgb",
    "[",
    "]",
    "a0.x",
    "+",
    "-",
    "1",
    "0.5",
    ".5",
    "1-",
    ";",
    "; comment",
    "// x",
    "/*",
    "*/",
    "#define A \\\n",
    "#if 0\n",
    "\\\n",
    "\t",
    "\"",
    "(",
    "nop",
    "M(",
    "\u{e4}",
];

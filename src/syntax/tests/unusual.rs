//! Texts as old tools and other systems left them.

use super::*;

/// Rules and lines of what is said of a text.
fn told(text: &[u8]) -> Vec<(&'static str, usize)> {
    let mut map = SourceMap::new();
    let file = map.add("a", text).unwrap().clone();
    let parsed = parse(&file);
    let place = |d: &Diagnostic| (d.rule.id, map.locate(d.span).unwrap().line);
    parsed.diagnostics.iter().map(place).collect()
}

#[test]
fn ends_of_files() {
    let listing = b"ps.1.1\r\nmov r0, v0\r\n";
    let ends: [&[u8]; 7] = [
        b"",
        b"\x1A",
        b"\0",
        b"\0\0\n",
        b"\0\x1A",
        b"\n \0\r\n\0\0",
        b"\x1A\0",
    ];
    for end in ends {
        assert_eq!(told(&[listing, end].concat()), [], "{end:?}");
    }
    assert_eq!(told(b"ps.1.1\nmov r0,\0 v0\n"), [("P1", 1)]);
}

#[test]
fn blanks_of_other_code_pages() {
    assert_eq!(told(b"ps.1.1\nmov\xA0r0,\xA0v0\n"), []);
    assert_eq!(told("ps.1.1\nmov\u{A0}r0, v0\n".as_bytes()), []);
}

#[test]
fn utf_16() {
    for text in [
        "ps.1.1\nmov r0, v0\n",
        "; water\nps.1.1\n",
        "\u{FEFF}ps.1.1\n",
    ] {
        let little: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
        let big: Vec<u8> = text.encode_utf16().flat_map(u16::to_be_bytes).collect();
        for bytes in [little, big] {
            assert_eq!(told(&bytes), [("P1", 1)]);
            assert_eq!(crate::bytecode::recognize(&bytes), None);
        }
    }
}

/// syntax.md, section 6: lines that disassemblers leave.
#[test]
fn debug_lines() {
    let text = b"ps_1_1\n    debug 3, 1\n#line 4 \"a.psh\"\nmov r0, v0\n  DEBUG\n";
    assert_eq!(told(text), []);
}

#[test]
fn indices_that_are_no_sums() {
    let index = |text: &str| told(format!("vs.1.1\nmov r0, {text}\n").as_bytes());
    for text in ["c[10*2]", "c[(10)]", "c[1 2]", "c[a0.x * 2]", "c[10/2].x"] {
        assert_eq!(index(text), [("P16", 2)], "{text}");
    }
    for text in ["c[10", "c[a0.x + 3, v0"] {
        assert_eq!(index(text)[0], ("P16", 2), "{text}");
    }
}

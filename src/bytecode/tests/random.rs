//! No stream and no file may panic, hang or fill the memory.

use super::*;
use crate::diagnostic::any_error;
use proptest::prelude::*;

/// Reads a stream both ways: what is said lies in it, and what is said nothing of comes back.
fn survives(words: &[u32]) {
    let decoded = decode(words);
    assert!(decoded.diagnostics.len() <= 101);
    for d in &decoded.diagnostics {
        assert!(d.span.start as usize <= words.len(), "{d:?}");
    }
    if let Some(program) = &decoded.program {
        assert!(program.statements.len() <= words.len());
        let listing = syntax::print(program);
        if decoded.diagnostics.is_empty() {
            let mut sources = SourceMap::new();
            let parsed = syntax::parse(sources.add("listing", listing.as_str()).unwrap());
            assert!(!any_error(&parsed.diagnostics), "{listing}");
            assert_eq!(encode(&parsed.program.unwrap()).unwrap(), words);
        } else {
            // What is left of a damaged stream has tokens all the same.
            assert!(encode(program).is_ok());
        }
    }
    let (declaration, found) = Declaration::decode(words);
    assert!(found.len() <= 101);
    if found.is_empty() {
        assert_eq!(declaration.encode().unwrap(), words);
    }
    declaration.check();
    declaration.print();
}

/// Reads a file of whatever.
fn survives_as_file(bytes: &[u8]) {
    let mut sources = SourceMap::new();
    let Some(input) = read(&mut sources, "file", bytes).unwrap() else {
        return;
    };
    for stream in &input.streams {
        survives(&stream.words);
        let made = disassemble(stream, &mut sources).unwrap();
        for d in &made.diagnostics {
            assert!(sources.locate(d.span).is_some(), "{d:?}");
        }
    }
}

/// A stream with a comment, both declarations, a pair and two phases.
#[rustfmt::skip]
const GOOD: [u32; 34] = [
    0xFFFF_0104, 0x0002_FFFE, 0x4241_5443, 0x0000_1C0A, 0x51, 0xA00F_0000, 0x3F80_0000, 0, 0x8000_0000, 0x7FC0_0001,
    0x42, 0x800F_0000, 0xB0E4_0000, 0x40, 0x8007_0001, 0xB0E4_0001, 0x04, 0x8117_0001, 0x84E4_0000, 0xA0E4_0000,
    0x81E4_0001, 0xFFFD, 0x42, 0x800F_0002, 0x89E4_0001, 0x05, 0x8007_0000, 0x80E4_0002, 0x90E4_0000, 0x4000_0001,
    0x8008_0000, 0x90E4_0000, 0xFFFE, 0xFFFF,
];

/// Words of which streams are made, so that random ones get far.
#[rustfmt::skip]
const WORDS: [u32; 24] = [
    0xFFFF, 0xFFFD, 0xFFFE, 0x0001_FFFE, 0x7FFF_FFFE, 0, 1, 4, 0x1F, 0x40,
    0x42, 0x51, 0x4000_0001, 0x800F_0000, 0x8000_0000, 0x80E4_0000, 0xA0E4_2000, 0xB0E4_0000, 0xC00F_0001, 0xFFFF_FFFF,
    0x2000_0000, 0x4002_0000, 0x8200_000A, 0xA100_0000,
];

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, ..ProptestConfig::default() })]

    #[test]
    fn random_words(mut words in proptest::collection::vec(any::<u32>(), 0..200), version: u8) {
        survives(&words);
        words.insert(0, 0xFFFE_0100 | u32::from(version % 5) | u32::from(version & 128) << 9);
        survives(&words);
        survives_as_file(&to_bytes(&words));
    }

    #[test]
    fn likely_words(
        picks in proptest::collection::vec(0..WORDS.len(), 0..60),
        vertex: bool,
        changes in proptest::collection::vec((any::<prop::sample::Index>(), 0_u32..32), 0..4),
    ) {
        let mut words = vec![if vertex { 0xFFFE_0101 } else { 0xFFFF_0104 }];
        words.extend(picks.iter().map(|at| WORDS[*at]));
        for (at, bit) in changes {
            let at = at.index(words.len());
            words[at] ^= 1 << bit;
        }
        survives(&words);
    }

    #[test]
    fn changed_streams(
        changes in proptest::collection::vec((any::<prop::sample::Index>(), any::<u32>(), 0..5), 1..6),
    ) {
        let mut words = GOOD.to_vec();
        for (at, word, what) in changes {
            let at = at.index(words.len());
            match what {
                0 => words[at] = word,
                1 => words[at] ^= 1 << (word % 32),
                2 => words.insert(at, word),
                3 => words.truncate(at + 1),
                _ if words.len() > 1 => { words.remove(at); }
                _ => {}
            }
        }
        survives(&words);
        survives_as_file(&to_bytes(&words));
        survives_as_file(to_hex(&words).as_bytes());
    }

    #[test]
    fn changed_text(
        changes in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0..3), 1..12),
        which in 0_usize..3,
    ) {
        let text = match which {
            0 => to_hex(&GOOD),
            1 => "/* x */ DWORD a[2] = { 0xffff0101, 0x0, 0xffff }; DWORD b[] = { D3DPS_VERSION(1, 1), D3DPS_END() };".into(),
            _ => "D3DVSD_STREAM(0), D3DVSD_REG(D3DVSDE_NORMAL, 2), D3DVSD_CONST(1, 1), 0, 1, 2, 3, D3DVSD_END()".into(),
        };
        let mut text = text.into_bytes();
        for (at, byte, what) in changes {
            let at = at.index(text.len());
            match what {
                0 => text[at] = byte,
                1 => text.insert(at, byte),
                _ => { text.remove(at); }
            }
        }
        survives_as_file(&text);
    }
}

#[test]
fn the_good_stream_is_good() {
    assert_eq!(decode(&GOOD).diagnostics, []);
    survives(&GOOD);
}

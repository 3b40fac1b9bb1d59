//! Source modifiers, result modifiers, masks and swizzles.

use super::versions;
use crate::isa::modifier::SHIFTS;
use crate::isa::operand::{RGBA, XYZW};
use crate::isa::{MaskSet, ResultModifier, SourceModifier, Swizzle, Version, WriteMask};

/// Section 2 of the modifier list: the text of a modified r0, code, versions in arithmetic, versions in which it
/// divides coordinates.
const SOURCES: &str = "
r0        0  all    none
-r0       1  all    none
r0_bias   2  ps     none
-r0_bias  3  ps     none
r0_bx2    4  ps     none
-r0_bx2   5  ps     none
1-r0      6  ps     none
r0_x2     7  ps.1.4 none
-r0_x2    8  ps.1.4 none
r0_dz     9  none   ps.1.4
r0_db     9  none   ps.1.4
r0_dw     10 none   ps.1.4
r0_da     10 none   ps.1.4
";

#[test]
fn source_modifiers_are_as_the_specification_lists_them() {
    let mut seen = vec![];
    for line in SOURCES.lines().filter(|l| !l.is_empty()) {
        let words: Vec<&str> = line.split_whitespace().collect();
        let (prefix, suffix) = words[0].split_once("r0").unwrap();
        let modifier = SourceModifier::from_text(prefix, suffix).expect(line);
        let row = modifier.row();
        assert_eq!(row.modifier, modifier, "the rows stand in order");
        assert_eq!(row.code.to_string(), words[1], "{line}");
        assert_eq!(SourceModifier::from_code(row.code), Some(modifier));
        let arithmetic: Vec<Version> = row.arithmetic.iter().collect();
        assert_eq!(arithmetic, versions(words[2]), "{line}");
        let coordinates: Vec<Version> = row.coordinates.iter().collect();
        assert_eq!(coordinates, versions(words[3]), "{line}");
        seen.push(modifier);
    }
    assert!(SourceModifier::all().all(|m| seen.contains(&m)));
    // Section 2.1: these do not combine; codes above 10 are of later models.
    for (prefix, suffix) in [
        ("1-", "_bx2"),
        ("1-", "_bias"),
        ("1-", "_x2"),
        ("-", "_dz"),
        ("-", "_dw"),
        ("-1-", ""),
        ("", "_abs"),
        ("", "_x4"),
    ] {
        assert_eq!(SourceModifier::from_text(prefix, suffix), None);
    }
    for code in 11..=255 {
        assert_eq!(SourceModifier::from_code(code), None);
    }
    let mut suffixes: Vec<&str> = SourceModifier::suffixes().collect();
    suffixes.sort_unstable();
    let listed = ["_bias", "_bx2", "_da", "_db", "_dw", "_dz", "_x2"];
    assert_eq!(suffixes, listed);
}

/// Section 1 of the modifier list: suffix, four-bit code, versions.
const RESULTS: &str = "
_x2 1  ps
_x4 2  ps
_x8 3  ps.1.4
_d2 15 ps
_d4 14 ps.1.4
_d8 13 ps.1.4
";

#[test]
fn result_modifiers_are_as_the_specification_lists_them() {
    let lines: Vec<&str> = RESULTS.lines().filter(|l| !l.is_empty()).collect();
    assert_eq!(SHIFTS.len(), lines.len());
    for line in lines {
        let words: Vec<&str> = line.split_whitespace().collect();
        let row = SHIFTS.iter().find(|s| s.suffix == words[0]).expect(line);
        // The code is the shift in two's complement of four bits.
        assert_eq!((row.shift & 15).to_string(), words[1], "{line}");
        for version in Version::all() {
            for saturate in [false, true] {
                let modifier = ResultModifier {
                    shift: row.shift,
                    saturate,
                };
                let listed = versions(words[2]).contains(&version);
                assert_eq!(modifier.exists_in(version), listed, "{line}: {version}");
            }
        }
    }
    let saturate = ResultModifier {
        shift: 0,
        saturate: true,
    };
    for version in Version::all() {
        assert!(ResultModifier::NONE.exists_in(version));
        assert_eq!(
            saturate.exists_in(version),
            versions("ps").contains(&version)
        );
    }
    let both = ResultModifier {
        shift: 1,
        saturate: true,
    };
    // Shift first, whatever the order in the text was.
    assert_eq!(both.text(), "_x2_sat");
    let none = ResultModifier {
        shift: 4,
        saturate: false,
    };
    assert!(Version::all().all(|v| !none.exists_in(v)));
}

#[test]
fn swizzles_have_the_bytes_of_the_token_list() {
    // Section 4.2 of the token list, and the encodings of section 12.1 of the grammar
    // (`dp4 r0.xw, r1.wzyx, r2.xxww`).
    for (components, byte, vertex, pixel) in [
        (&[0, 1, 2, 3][..], 0xE4, "", ""),
        (&[0], 0x00, ".x", ".r"),
        (&[1], 0x55, ".y", ".g"),
        (&[2], 0xAA, ".z", ".b"),
        (&[3], 0xFF, ".w", ".a"),
        (&[0, 1, 3], 0xF4, ".xyw", ".rga"),
        (&[0, 1, 2], 0xA4, ".xyz", ".rgb"),
        (&[3, 2, 1, 0], 0x1B, ".wzyx", ".abgr"),
        (&[0, 0, 3, 3], 0xF0, ".xxw", ".rra"),
        (&[0, 1], 0x54, ".xy", ".rg"),
        (&[2, 3, 0], 0x0E, ".zwx", ".bar"),
    ] {
        let swizzle = Swizzle::from_components(components).unwrap();
        assert_eq!(swizzle.byte(), byte, "{components:?}");
        assert_eq!(Swizzle::from_byte(byte), swizzle);
        assert_eq!(swizzle.text(XYZW), vertex);
        assert_eq!(swizzle.text(RGBA), pixel);
    }
    assert_eq!(Swizzle::XYZZ.byte(), 0xA4);
    assert_eq!(Swizzle::XYWW.byte(), 0xF4);
    for byte in 0..=255 {
        assert_eq!(Swizzle::from_byte(byte).byte(), byte);
    }
    assert_eq!(Swizzle::from_components(&[]), None);
    assert_eq!(Swizzle::from_components(&[4]), None);
    assert_eq!(Swizzle::from_components(&[0; 5]), None);
}

#[test]
fn a_swizzle_reads_only_the_slots_that_are_used() {
    let wzyx = Swizzle::from_byte(0x1B);
    assert_eq!(wzyx.reads(WriteMask::X), WriteMask::W);
    assert_eq!(wzyx.reads(WriteMask::XY).bits(), 0b1100);
    assert_eq!(Swizzle::replicate(1).reads(WriteMask::ALL), WriteMask::Y);
    assert_eq!(Swizzle::XYWW.reads(WriteMask::XYZ).bits(), 0b1011);
    assert_eq!(Swizzle::replicate(2).replicated(), Some(2));
    assert_eq!(Swizzle::XYZZ.replicated(), None);
}

#[test]
fn masks_are_bits_and_letters() {
    // Section 4.1 of the token list: bit 16 is x, bit 19 is w.
    for (bits, vertex, pixel) in [
        (0b0001, ".x", ".r"),
        (0b0010, ".y", ".g"),
        (0b1000, ".w", ".a"),
        (0b0111, ".xyz", ".rgb"),
        (0b1101, ".xzw", ".rba"),
        (0b1111, "", ""),
    ] {
        let mask = WriteMask::from_bits(bits);
        assert_eq!(mask.text(XYZW), vertex);
        assert_eq!(mask.text(RGBA), pixel);
        assert_eq!(mask.bits(), bits);
        assert_eq!(mask.count(), bits.count_ones());
    }
    assert_eq!(MaskSet::ANY.iter().count(), 15);
    let pipes: Vec<u8> = MaskSet::PIPES.iter().map(WriteMask::bits).collect();
    assert_eq!(pipes, [0b0111, 0b1000, 0b1111]);
    assert_eq!(WriteMask::ALL.without(WriteMask::XYZ), WriteMask::W);
    assert!(WriteMask::XYZ.contains(WriteMask::XY) && !WriteMask::XY.contains(WriteMask::XYZ));
}

//! Register files, versions and budgets.

use super::version;
use crate::isa::register::Access;
use crate::isa::{RegisterFile, ShaderKind, Version};

const COLUMNS: [&str; 7] = [
    "vs.1.0", "vs.1.1", "ps.1.0", "ps.1.1", "ps.1.2", "ps.1.3", "ps.1.4",
];

/// Sections 1 and 3.1 of the register list: file, type code, how many registers in each version (columns as in
/// `COLUMNS`), how many of them one instruction reads, what a shader does with them (`ps.1.4` last).
const SPEC: &str = "
r  0  12 12 2 2 2 2 6   3 3 2 2 2 2 3  rw rw
v  1  16 16 2 2 2 2 2   1 1 1 2 2 2 2  r  r
c  2  96 96 8 8 8 8 8   1 1 2 2 2 2 2  r  r
a  3   0  1 0 0 0 0 0   0 1 0 0 0 0 0  w  w
t  3   0  0 4 4 4 4 6   0 0 1 2 3 3 1  rw r
o  4   3  3 0 0 0 0 0   0 0 0 0 0 0 0  w  w
oD 5   2  2 0 0 0 0 0   0 0 0 0 0 0 0  w  w
oT 6   8  8 0 0 0 0 0   0 0 0 0 0 0 0  w  w
";

#[test]
fn every_file_is_as_the_specification_lists_it() {
    let mut files = RegisterFile::all();
    for line in SPEC.lines().filter(|l| !l.is_empty()) {
        let words: Vec<&str> = line.split_whitespace().collect();
        let file = files.next().expect(line);
        assert_eq!(file.row().file, file, "the rows stand in order");
        assert_eq!(file.row().prefix, words[0]);
        assert_eq!(file.row().code.to_string(), words[1], "{line}");
        for (i, name) in COLUMNS.iter().enumerate() {
            let version = version(name);
            assert_eq!(file.count(version).to_string(), words[2 + i], "{line}");
            assert_eq!(file.read_ports(version).to_string(), words[9 + i], "{line}");
            let access = match file.access(version) {
                Access::Read => "r",
                Access::Write => "w",
                Access::ReadWrite => "rw",
            };
            let listed = words[if *name == "ps.1.4" { 17 } else { 16 }];
            assert_eq!(access, listed, "{line}: {name}");
        }
    }
    assert_eq!(files.next(), None);
}

#[test]
fn type_codes_name_a_file_of_the_kind_of_shader() {
    use RegisterFile::*;
    let vertex = [Temp, Input, Const, Addr, RastOut, AttrOut, TexCrdOut];
    let pixel = [Temp, Input, Const, Texture];
    for code in 0..=255 {
        let at = usize::from(code);
        let of = |kind| RegisterFile::from_code(code, kind);
        assert_eq!(of(ShaderKind::Vertex), vertex.get(at).copied(), "{code}");
        assert_eq!(of(ShaderKind::Pixel), pixel.get(at).copied(), "{code}");
    }
}

#[test]
fn registers_have_the_names_of_listings() {
    // Section 5 of the register list.
    for (file, index, name) in [
        (RegisterFile::Temp, 3, "r3"),
        (RegisterFile::Input, 7, "v7"),
        (RegisterFile::Const, 20, "c20"),
        (RegisterFile::Addr, 0, "a0"),
        (RegisterFile::Texture, 2, "t2"),
        (RegisterFile::RastOut, 0, "oPos"),
        (RegisterFile::RastOut, 1, "oFog"),
        (RegisterFile::RastOut, 2, "oPts"),
        (RegisterFile::AttrOut, 1, "oD1"),
        (RegisterFile::TexCrdOut, 6, "oT6"),
    ] {
        assert_eq!(file.register_name(index), name);
    }
}

/// Section 1 of the token list and section 8 of the instruction list: version, token, arithmetic slots (all slots
/// of a vertex shader), texture slots, phases.
const VERSIONS: &str = "
vs.1.0 FFFE0100 128 0 1
vs.1.1 FFFE0101 128 0 1
ps.1.0 FFFF0100   8 4 1
ps.1.1 FFFF0101   8 4 1
ps.1.2 FFFF0102   8 4 1
ps.1.3 FFFF0103   8 4 1
ps.1.4 FFFF0104   8 6 2
";

#[test]
fn every_version_has_its_token_and_budget() {
    let mut all = Version::all();
    for line in VERSIONS.lines().filter(|l| !l.is_empty()) {
        let words: Vec<&str> = line.split_whitespace().collect();
        let version = all.next().expect(line);
        let row = version.row();
        assert_eq!(row.version, version, "the rows stand in order");
        assert_eq!(version.name(), words[0]);
        let token = u32::from_str_radix(words[1], 16).unwrap();
        assert_eq!(version.token(), token, "{line}");
        assert_eq!(Version::from_token(token), Some(version));
        assert_eq!(row.arithmetic_slots.to_string(), words[2], "{line}");
        assert_eq!(row.texture_slots.to_string(), words[3], "{line}");
        assert_eq!(row.phases.to_string(), words[4], "{line}");
        let minor = words[0][5..].parse().unwrap();
        assert_eq!(Version::from_parts(version.kind(), 1, minor), Some(version));
        let vertex = words[0].starts_with("vs");
        assert_eq!(version.kind() == ShaderKind::Vertex, vertex);
    }
    assert_eq!(all.next(), None);
    // Limit S13: no other number is a version.
    for token in [0xFFFE_0102, 0xFFFF_0105, 0xFFFE_0200, 0xFFFD_0101, 0] {
        assert_eq!(Version::from_token(token), None, "{token:08X}");
    }
    assert_eq!(Version::from_parts(ShaderKind::Pixel, 2, 0), None);
    assert_eq!(Version::from_parts(ShaderKind::Vertex, 1, 2), None);
}

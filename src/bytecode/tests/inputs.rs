//! What people have: which form it is, and where its diagnostics point.

use super::*;
use crate::diagnostic::any_error;
use crate::listing;
use crate::policy::Dialect;

/// A pixel shader of three instructions: `tex t0`, `mov r0, t0`, the end.
const SHADER: [u32; 7] = [
    0xFFFF_0101,
    0x42,
    0xB00F_0000,
    0x01,
    0x800F_0000,
    0xB0E4_0000,
    0xFFFF,
];
const LISTING: &str = "ps.1.1\ntex t0\nmov r0, t0\n";

#[track_caller]
fn input(bytes: &[u8]) -> (SourceMap, Input) {
    let mut sources = SourceMap::new();
    sources.add("before", "something else").unwrap();
    let input = read(&mut sources, "file", bytes).unwrap();
    assert_eq!(recognize(bytes), input.as_ref().map(|i| i.form));
    (sources, input.unwrap())
}

/// The listing of the one stream of a file.
#[track_caller]
fn listing_of(bytes: &[u8]) -> (Form, String) {
    let (mut sources, input) = input(bytes);
    let [stream] = &input.streams[..] else {
        panic!("{input:?}");
    };
    let made = disassemble(stream, None, &mut sources).unwrap();
    assert_eq!(made.diagnostics, []);
    (input.form, made.listing.unwrap())
}

/// What is told of the one stream of a file, with the text that it points at.
fn told_of(bytes: &[u8]) -> Vec<(&'static str, String, String)> {
    let (mut sources, input) = input(bytes);
    let made = disassemble(&input.streams[0], None, &mut sources).unwrap();
    assert!(made.listing.is_none() || !any_error(&made.diagnostics));
    let text = |d: &Diagnostic| sources.text(d.span).into_owned();
    let one = |d: &Diagnostic| (d.rule.id, text(d), d.message.clone());
    made.diagnostics.iter().map(one).collect()
}

#[test]
fn binary_files() {
    let bytes = to_bytes(&SHADER);
    // The version stands there with its lowest byte first.
    assert_eq!(bytes[..8], [0x01, 0x01, 0xFF, 0xFF, 0x42, 0, 0, 0]);
    assert_eq!(listing_of(&bytes), (Form::Binary, LISTING.to_string()));
    let declaration = to_bytes(&[0x2000_0000, 0x4002_0000, 0xFFFF_FFFF]);
    let expected =
        "D3DVSD_STREAM(0),\nD3DVSD_REG(D3DVSDE_POSITION, D3DVSDT_FLOAT3),\nD3DVSD_END()\n";
    assert_eq!(
        listing_of(&declaration),
        (Form::Binary, expected.to_string())
    );
}

#[test]
fn hexadecimal_text() {
    assert_eq!(
        listing_of(to_hex(&SHADER).as_bytes()),
        (Form::Hex, LISTING.to_string())
    );
    for text in [
        "ffff0101 00000042 b00f0000 00000001 800f0000 b0e40000 0000ffff",
        "0xFFFF0101, 0x42, 0xB00F0000,\r\n0x1, 0x800F0000, 0xB0E40000UL, 0xFFFF,",
        "; a shader\nFFFF0101 ; version\n00000042 B00F0000 // tex\n00000001 800F0000 B0E40000\n0000FFFF\n",
        "{ 0xffff0101, 0x00000042, 0xb00f0000, 0x00000001, 0x800f0000, 0xb0e40000, 0x0000ffff };",
        "\u{FEFF}FFFF0101 00000042 B00F0000 00000001 800F0000 B0E40000 0000FFFF\0\0",
    ] {
        let text = text.trim_end_matches('\0');
        assert_eq!(
            listing_of(text.as_bytes()),
            (Form::Hex, LISTING.to_string()),
            "{text}"
        );
    }
}

#[test]
fn arrays_in_c_sources() {
    let source = r#"
        #include "shaders.h" // DWORD no[] = { 0xffff0101, 0x0000ffff };
        #define MANY \
            dword not_this[] = { 0xffff0101 };
        const char *text = "DWORD nor[] = { 0xffff0101, 0x0000ffff };";
        int sizes[2] = { 1, 2 };
        float half[] = { 0.5f, 0.5f };
        static const DWORD dwOne[] = {
            0xffff0101, 0x00000042, 0xb00f0000, 0x00000001, 0x800f0000, 0xb0e40000, 0x0000ffff };
        DWORD dwTwo [ 3 ] = { D3DVS_VERSION(1, 1), 0x00000000, D3DVS_END() };
        DWORD* none = 0;
        DWORD decl[] = { D3DVSD_STREAM(0), D3DVSD_REG(0, D3DVSDT_FLOAT3), D3DVSD_END() };
        "#;
    let (mut sources, input) = input(source.as_bytes());
    assert_eq!(input.form, Form::Arrays);
    let names: Vec<_> = input
        .streams
        .iter()
        .map(|s| s.name.as_deref().unwrap())
        .collect();
    assert_eq!(names, ["dwOne", "dwTwo", "decl"]);
    let kinds: Vec<_> = input.streams.iter().map(|s| s.kind).collect();
    let (shader, declaration) = (StreamKind::Shader, StreamKind::Declaration);
    assert_eq!(kinds, [shader, shader, declaration]);
    let mut listing = |at: usize| {
        let made = disassemble(&input.streams[at], None, &mut sources).unwrap();
        made.listing.unwrap()
    };
    assert_eq!(listing(0), LISTING);
    assert_eq!(listing(1), "vs.1.1\nnop\n");
}

#[test]
fn what_holds_no_tokens() {
    for bytes in [
        &b""[..],
        b"ps.1.4\ntexld r0, t0\n",
        b"; FFFF0101\nps.1.1\nmov r0, v0",
        b"int main() { return 0; }",
        b"DWORD n[] = { 1, 2, 3 };",
        b"DWORD n[] = { };",
        b"\xFF\xFEp\0s\0.\0",
    ] {
        assert_eq!(recognize(bytes), None, "{bytes:?}");
        assert!(read(&mut SourceMap::new(), "x", bytes).unwrap().is_none());
    }
    // A listing that was cut out of a program with zeros behind it.
    assert_eq!(recognize(b"ps.1.1\nmov r0, v0\0\0\0"), None);
}

#[test]
fn diagnostics_point_into_the_file() {
    // An error in a C source is under the token as it is written there.
    let source =
        "DWORD dwPS[] = { 0xffff0101, 0x42, 0xb00f0000, 0x1, 0x80000000, 0xb0e40000, 0xffff };";
    let message = "token 4 (byte 16): the write mask of 0x80000000, bits 19:16, is empty";
    let expected = [("K8", "0x80000000".to_string(), message.to_string())];
    assert_eq!(told_of(source.as_bytes()), expected);
    // A binary file has a line of digits for each token.
    let mut broken = SHADER;
    broken[4] = 0x8000_0000;
    let expected = [("K8", "80000000".to_string(), message.to_string())];
    assert_eq!(told_of(&to_bytes(&broken)), expected);
    let (mut sources, input) = input(&to_bytes(&broken));
    let made = disassemble(&input.streams[0], None, &mut sources).unwrap();
    let at = sources.locate(made.diagnostics[0].span).unwrap();
    assert_eq!((at.file, at.line, at.column), ("file", 5, 1));
}

#[test]
fn text_that_is_no_token() {
    let expected = |text: &str, message: &str| vec![("K15", text.to_string(), message.to_string())];
    assert_eq!(
        told_of(b"FFFF0101 00000042 B00F000 0000FFFF"),
        expected("B00F000", "token 2: `B00F000` is no token")
    );
    assert_eq!(
        told_of(b"DWORD x[] = { 0xffff0101, 1.0f, 0xffff };"),
        expected("1.0f", "token 1: `1.0f` is no token")
    );
    assert_eq!(
        told_of(b"DWORD x[] = { 0xffff0101 0xffff };"),
        expected("0xffff", "token 1: `0xffff` is no token")
    );
    assert_eq!(
        told_of(b"D3DVSD_STREAM(16), D3DVSD_END()"),
        expected(
            "16",
            "token 0: this argument of `D3DVSD_STREAM` is at most 15"
        )
    );
    assert_eq!(
        told_of(b"D3DVSD_STREAM(0), D3DVSD_REG(1), D3DVSD_END()"),
        expected("D3DVSD_REG(1)", "token 1: `D3DVSD_REG` takes 2 arguments")
    );
    assert_eq!(
        told_of(b"D3DVSD_STREAM(0), D3DVSD_REG(0, FLOAT3), D3DVSD_END()"),
        expected("FLOAT3", "token 1: `FLOAT3` is no token")
    );
    assert_eq!(
        told_of(b"D3DVSD_STREAM(0), D3DVSD_END"),
        expected(
            "D3DVSD_END",
            "token 1: `D3DVSD_END` stands without its arguments"
        )
    );
}

#[test]
fn bytes_that_are_no_whole_token() {
    let mut bytes = to_bytes(&SHADER);
    bytes.push(10);
    let message = "the file has 1 byte behind its last whole token";
    assert_eq!(
        told_of(&bytes),
        [("K14", String::new(), message.to_string())]
    );
    // Cut in the middle of a token: that it is cut is what is said.
    let cut = &bytes[..bytes.len() - 4];
    let told = told_of(cut);
    assert_eq!((told.len(), told[0].0), (1, "S12"), "{told:?}");
}

/// The program of a disassembly points into its listing, as that of a listing does.
#[test]
fn validation_points_into_the_listing() {
    // r0 is read before it is written: `add r0, r0, v0`.
    let words = [
        0xFFFF_0101,
        2,
        0x800F_0000,
        0x80E4_0000,
        0x90E4_0000,
        0xFFFF,
    ];
    let (mut sources, input) = input(&to_bytes(&words));
    let made = disassemble(&input.streams[0], None, &mut sources).unwrap();
    assert_eq!(made.diagnostics, []);
    let file = sources.files().last().unwrap();
    assert_eq!(file.name(), "file (listing)");
    let checked = listing::check(file, Dialect::D3d8);
    let [found] = &checked.diagnostics[..] else {
        panic!("{checked:?}");
    };
    assert_eq!((found.rule.id, &*sources.text(found.span)), ("I1", "r0"));
    let at = sources.locate(found.span).unwrap();
    assert_eq!((at.file, at.line, at.column), ("file (listing)", 2, 9));
    assert_eq!(made.program, checked.program);
}

/// Words without a zero among them but those of the end token, which could be taken for zeros behind a text.
#[test]
fn binary_files_without_a_version() {
    for first in [0xFFFD_0101_u32, 0xFFFF_FFFF, 0xFFFE_7F7F, 0x7469_7865] {
        let words = [first, 0xFFFF];
        let bytes = to_bytes(&words);
        assert_eq!(recognize(&bytes), Some(Form::Binary));
        let told = told_of(&bytes);
        let message = format!("token 0 (byte 0): 0x{first:08X} is no version");
        assert_eq!(told, [("S13", format!("{first:08X}"), message)]);
        assert_eq!(told, told_of(to_hex(&words).as_bytes()));
    }
    assert_eq!(recognize(b"\xFF\xFF\xFF\xFF"), Some(Form::Binary));
}

/// A megabyte of zeros, as a file and behind a version.
#[test]
fn files_of_zeros() {
    let zeros = vec![0; 4 << 20];
    let told = told_of(&zeros);
    assert_eq!((told.len(), told[0].0), (1, "S13"));
    let started = [&to_bytes(&SHADER[..1])[..], &zeros].concat();
    let told = told_of(&started);
    assert_eq!((told.len(), told[0].0), (1, "K13"));
    // Behind the end they are not read.
    let ended = [&to_bytes(&SHADER)[..], &zeros].concat();
    let told = told_of(&ended);
    assert_eq!((told.len(), told[0].0), (1, "K3"));
}

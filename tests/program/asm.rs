//! `asm`: listings to tokens, and what is refused.

use super::{folder, texcrd, texcrd_with_input};
use std::fs;
use std::process::Command;

const LISTING: &[u8] = b"ps.1.1\ntex t0 ; the base\nmul_x2 r0, t0, v0\n";
/// By hand: version; `tex`, t0; `mul`, r0 with shift 1, t0, v0; end.
const TOKENS: [u32; 8] = [
    0xFFFF_0101,
    0x0000_0042,
    0xB00F_0000,
    0x0000_0005,
    0x810F_0000,
    0xB0E4_0000,
    0x90E4_0000,
    0x0000_FFFF,
];

fn hex(words: &[u32]) -> String {
    words.iter().map(|w| format!("{w:08X}\n")).collect()
}

#[test]
fn tokens_as_text() {
    let ran = texcrd_with_input(&["asm", "-", "--hex"], LISTING);
    assert_eq!((ran.status, ran.err.as_str()), (0, ""));
    assert_eq!(ran.out, hex(&TOKENS));
}

#[test]
fn tokens_as_a_file() {
    let folder = folder("asm_file");
    let (listing, out) = (folder.join("a.psh"), folder.join("a.pso"));
    fs::write(&listing, LISTING).expect("written");
    let (listing, path) = (listing.to_str().expect("text"), out.to_str().expect("text"));
    let ran = texcrd(&["asm", listing, "-o", path]);
    assert_eq!(
        (ran.status, ran.out.as_str(), ran.err.as_str()),
        (0, "", "")
    );
    let bytes: Vec<u8> = TOKENS.iter().flat_map(|w| w.to_le_bytes()).collect();
    assert_eq!(fs::read(&out).expect("there"), bytes);
    // The old file stays as it is if something is wrong, and the listing is never written over.
    let ran = texcrd_with_input(&["asm", "-", "-o", path], b"ps.1.1\nmov r0, r1\n");
    assert_eq!(ran.status, 1);
    assert_eq!(fs::read(&out).expect("there"), bytes);
    let ran = texcrd(&["asm", listing, "-o", listing]);
    assert_eq!(ran.status, 2, "{}", ran.err);
    assert_eq!(fs::read(listing).expect("there"), LISTING);
    // A file of tokens is taken, too.
    let ran = texcrd(&["asm", path, "--hex"]);
    assert_eq!((ran.status, ran.out), (0, hex(&TOKENS)));
    let ran = texcrd(&["asm", path, "--hex", "-o", listing]);
    assert_eq!((ran.status, ran.out.as_str()), (0, ""));
    assert_eq!(fs::read_to_string(listing).expect("there"), hex(&TOKENS));
}

#[test]
fn tokens_into_a_pipe() {
    let folder = folder("asm_pipe");
    let listing = folder.join("a.psh");
    fs::write(&listing, LISTING).expect("written");
    let ran = Command::new(env!("CARGO_BIN_EXE_texcrd"))
        .arg("asm")
        .arg(&listing)
        .output()
        .expect("it runs");
    let bytes: Vec<u8> = TOKENS.iter().flat_map(|w| w.to_le_bytes()).collect();
    assert_eq!(ran.stdout, bytes);
}

/// `r1` is read before it is written, which has a token. `tex` in ps.1.4 has none; and `r9`, `+` in a vertex shader and two
/// shifts never came through the assembler (syntax.md, section 12.2).
#[test]
fn rules_are_left_out_on_request() {
    let listing = b"ps.1.1\nmov r0, r1\n";
    let ran = texcrd_with_input(&["asm", "-", "--hex"], listing);
    assert_eq!((ran.status, ran.out.as_str()), (1, ""));
    assert!(ran.err.contains("I1"), "{}", ran.err);
    let ran = texcrd_with_input(&["asm", "--unchecked", "-", "--hex"], listing);
    assert_eq!((ran.status, ran.err.as_str()), (0, ""));
    assert_eq!(
        ran.out,
        hex(&[0xFFFF_0101, 1, 0x800F_0000, 0x80E4_0001, 0xFFFF])
    );
    // A row of a matrix that no register holds is found by the validator alone.
    let ran = texcrd_with_input(
        &["asm", "--unchecked", "-", "--hex"],
        b"vs.1.1\nm3x2 r0, v0, v15\n",
    );
    assert_eq!((ran.status, ran.err.as_str()), (0, ""));
    for (listing, code) in [
        (&b"ps.1.3\nmov r5, r0\n"[..], "O1"),
        (b"ps.1.3\ntex t5\n", "O1"),
        (b"vs.1.1\n+add r0.a, r0, r2\n", "C1"),
        (b"ps.1.3\nmov_x2_x2 r0, r1\n", "P12"),
    ] {
        let ran = texcrd_with_input(&["asm", "--unchecked", "-", "--hex"], listing);
        assert_eq!((ran.status, ran.out.as_str()), (1, ""));
        let errors = ran.err.matches("error").count();
        assert!(ran.err.contains(code) && errors == 1, "{}", ran.err);
    }
    let ran = texcrd_with_input(&["asm", "--unchecked", "-", "--hex"], b"ps.1.4\ntex t0\n");
    assert_eq!((ran.status, ran.out.as_str()), (1, ""));
    for part in [
        "K18",
        "`tex` has no token in ps.1.4",
        "<stdin>:2:1",
        "that of `texld`",
    ] {
        assert!(ran.err.contains(part), "{part} in\n{}", ran.err);
    }
    // What cannot be read has no tokens either.
    let ran = texcrd_with_input(&["asm", "--unchecked", "-", "--hex"], b"ps.1.1\n1rp r0\n");
    assert_eq!((ran.status, ran.out.as_str()), (1, ""));
}

/// A modifier on a constant: the runtime of Direct3D 8 took it, the assembler of Direct3D 9 does not.
#[test]
fn dialects() {
    let listing = b"ps.1.1\nmov r0, -c0\n";
    let ran = texcrd_with_input(&["asm", "-", "--hex"], listing);
    assert_eq!(
        ran.out,
        hex(&[0xFFFF_0101, 1, 0x800F_0000, 0xA1E4_0000, 0xFFFF])
    );
    let ran = texcrd_with_input(&["asm", "-", "--hex", "--dialect", "d3d9"], listing);
    assert_eq!((ran.status, ran.out.as_str()), (1, ""), "{}", ran.err);
}

#[test]
fn vertex_declarations() {
    let text = b"D3DVSD_STREAM(0), D3DVSD_REG(D3DVSDE_POSITION, D3DVSDT_FLOAT3), D3DVSD_END()";
    let ran = texcrd_with_input(&["asm", "-", "--hex"], text);
    assert_eq!(
        ran.out,
        hex(&[0x2000_0000, 0x4002_0000, 0xFFFF_FFFF]),
        "{}",
        ran.err
    );
    let twice = b"D3DVSD_REG(16, D3DVSDT_FLOAT3), D3DVSD_END()";
    let ran = texcrd_with_input(&["asm", "-", "--hex"], twice);
    assert_eq!(ran.status, 1);
    assert!(
        ran.err.contains("D2") && ran.err.contains("v16"),
        "{}",
        ran.err
    );
    let ran = texcrd_with_input(&["asm", "-", "--hex", "--unchecked"], twice);
    assert_eq!(ran.out, hex(&[0x4002_0010, 0xFFFF_FFFF]));
}

/// The restored listings and the room's: to tokens, to a listing, and to the same tokens again.
#[test]
fn listings_of_the_repository_come_back() {
    for listing in [
        "stained_glass.psh",
        "stained_glass.vsh",
        "room.psh",
        "room.vsh",
    ] {
        let path = format!("asm/stained_glass/{listing}");
        let tokens = texcrd(&["asm", "--hex", &path]).out;
        let printed = texcrd_with_input(&["dis", "-"], tokens.as_bytes());
        assert_eq!((printed.status, printed.err.as_str()), (0, ""));
        let again = texcrd_with_input(&["asm", "--hex", "-"], printed.out.as_bytes());
        assert!(tokens.lines().count() > 8, "{path}");
        assert_eq!(again.out, tokens, "{path}");
    }
}

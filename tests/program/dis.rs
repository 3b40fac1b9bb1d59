//! `dis`: tokens to listings, and what is said of broken ones.

use super::{texcrd, texcrd_with_input};

#[test]
fn hexadecimal_text() {
    let text = b"0xffff0101, 0x42, 0xb00f0000, 0x1, 0x800f0000, 0xb0ff0000, 0xffff";
    let ran = texcrd_with_input(&["dis", "-"], text);
    assert_eq!((ran.status, ran.err.as_str()), (0, ""));
    assert_eq!(ran.out, "ps.1.1\ntex t0\nmov r0, t0.a\n");
}

const SOURCE: &[u8] = b"DWORD dwVS[] = { 0xfffe0101, 0, 0xffff };\n\
    DWORD decl[] = { D3DVSD_STREAM(1), D3DVSD_END() };\n\
    DWORD dwPS[] = { 0xffff0104, 0xfffd, 0xffff };\n";

#[test]
fn arrays_in_c_sources() {
    let ran = texcrd_with_input(&["dis", "-"], SOURCE);
    assert_eq!((ran.status, ran.err.as_str()), (0, ""));
    let expected = "// dwVS\nvs.1.1\nnop\n\n// decl\nD3DVSD_STREAM(1),\nD3DVSD_END()\n\n// dwPS\nps.1.4\nphase\n";
    assert_eq!(ran.out, expected);
    for (name, listing) in [("dwPS", "ps.1.4\nphase\n"), ("1", "vs.1.1\nnop\n")] {
        let ran = texcrd_with_input(&["dis", "-", "--shader", name], SOURCE);
        assert_eq!((ran.status, ran.out.as_str()), (0, listing));
    }
    let ran = texcrd_with_input(&["dis", "-", "--shader", "4"], SOURCE);
    assert_eq!(ran.status, 2);
    assert!(
        ran.err.contains("1 (dwVS), 2 (decl), 3 (dwPS)"),
        "{}",
        ran.err
    );
    // As text all of them come, one after the other; tokens of several shaders do not go into one file.
    let ran = texcrd_with_input(&["asm", "-", "--hex", "--unchecked"], SOURCE);
    assert_eq!(
        ran.out,
        "// dwVS\nFFFE0101\n00000000\n0000FFFF\n// decl\n20000001\nFFFFFFFF\n\
         // dwPS\nFFFF0104\n0000FFFD\n0000FFFF\n"
    );
    let ran = texcrd_with_input(&["asm", "-", "-o", "never-written.vso"], SOURCE);
    assert_eq!(ran.status, 2);
    assert!(ran.err.contains("--shader"), "{}", ran.err);
    let ran = texcrd_with_input(
        &["asm", "-", "--hex", "--unchecked", "--shader", "dwPS"],
        SOURCE,
    );
    assert_eq!(ran.out, "FFFF0104\n0000FFFD\n0000FFFF\n");
}

#[test]
fn broken_streams() {
    // A binary file: two tokens and the first byte of a third.
    let bytes = [1, 1, 0xFF, 0xFF, 0x42, 0, 0, 0, 0];
    let ran = texcrd_with_input(&["dis", "-"], &bytes);
    assert_eq!((ran.status, ran.out.as_str()), (1, ""));
    for part in [
        "error[S12]: token 2 (byte 8): the stream ends in `tex`: 0 of 1 operand tokens are there",
        "the end is lost: 0x0000FFFF closes a shader",
    ] {
        assert!(ran.err.contains(part), "{part} in\n{}", ran.err);
    }
    // Text: the place is that in the text.
    let ran = texcrd_with_input(
        &["dis", "-"],
        b"FFFF0101\n  00000001 80000000 90E40000 0000FFFF\n",
    );
    assert_eq!((ran.status, ran.out.as_str()), (1, ""));
    for part in ["error[K8]: token 2 (byte 8)", "<stdin>:2:12", "^^^^^^^^"] {
        assert!(ran.err.contains(part), "{part} in\n{}", ran.err);
    }
    // A warning does not keep the listing back.
    let ran = texcrd_with_input(&["dis", "-"], b"FFFF0101 00000000 0000FFFF 12345678");
    assert_eq!((ran.status, ran.out.as_str()), (0, "ps.1.1\nnop\n"));
    assert!(
        ran.err.contains("warning[K3]: token 3 (byte 12)"),
        "{}",
        ran.err
    );
}

#[test]
fn declarations_are_recognised_or_told() {
    let ran = texcrd_with_input(&["dis", "-"], b"20000000 40020000 FFFFFFFF");
    let expected =
        "D3DVSD_STREAM(0),\nD3DVSD_REG(D3DVSDE_POSITION, D3DVSDT_FLOAT3),\nD3DVSD_END()\n";
    assert_eq!(ran.out, expected);
    // One that begins with what no declaration begins with.
    let ran = texcrd_with_input(&["dis", "-"], b"C0000000 FFFFFFFF");
    assert!(ran.err.contains("S13"), "{}", ran.err);
    let ran = texcrd_with_input(&["dis", "-", "--declaration"], b"C0000000 FFFFFFFF");
    assert!(ran.err.contains("K19"), "{}", ran.err);
}

#[test]
fn listings_are_no_tokens() {
    let ran = texcrd(&["dis", "asm/stained_glass/room.psh"]);
    assert_eq!((ran.status, ran.out.as_str()), (1, ""));
    assert!(ran.err.contains("this holds no tokens"), "{}", ran.err);
    // Programs are told, too, as `check` and `asm` do.
    for text in [&b""[..], b"ps.1.1\nmov r0, v0\n", b"int main() {}"] {
        let ran = texcrd_with_input(&["dis", "-", "--format", "json"], text);
        assert_eq!((ran.status, ran.err.as_str()), (1, ""));
        let object: serde_json::Value = serde_json::from_str(&ran.out).expect("one object");
        assert_eq!(
            (&object["code"], &object["line"]),
            (&"K15".into(), &1.into())
        );
    }
}

/// What `dis` says nothing of, `asm --unchecked` takes back; what it could not is told, by token.
#[test]
fn what_asm_refuses_is_told() {
    for (tokens, part) in [
        (
            "FFFF0101 00000001 800F0005 90E40000 0000FFFF",
            "error[K7]: token 2",
        ),
        (
            "FFFF0104 00000001 800F0000 A0E4000F 0000FFFF",
            "error[K7]: token 3",
        ),
        (
            "FFFE0101 40000001 800F0000 90E40000 0000FFFF",
            "error[K9]: token 1",
        ),
    ] {
        let ran = texcrd_with_input(&["dis", "-"], tokens.as_bytes());
        assert_eq!((ran.status, ran.out.as_str()), (1, ""));
        assert!(ran.err.contains(part), "{part} in\n{}", ran.err);
    }
    for listing in [
        "ps.1.1\ndef r2, 1, 1, 1, 1\n",
        "ps.1.1\nmov c8, v0\n",
        "vs.1.1\n+def c0, 1, 1, 1, 1\n",
    ] {
        let asm = ["asm", "-", "--hex", "--unchecked"];
        let ran = texcrd_with_input(&asm, listing.as_bytes());
        assert_eq!((ran.status, ran.out.as_str()), (1, ""), "{listing}");
    }
}

/// As much as the program reads of 100 MB of zeros, alone and behind a version: refused at once.
#[test]
fn zeros() {
    let started = std::time::Instant::now();
    let zeros = vec![0; 5 << 20];
    let ran = texcrd_with_input(&["dis", "-"], &zeros);
    assert_eq!(ran.status, 1);
    assert!(
        ran.err
            .contains("token 0 (byte 0): 0x00000000 is no version"),
        "{}",
        ran.err
    );
    let ran = texcrd_with_input(&["dis", "-"], &[&[1, 1, 0xFF, 0xFF][..], &zeros].concat());
    assert_eq!(ran.status, 1);
    assert!(ran.err.contains("error[K13]"), "{}", ran.err);
    // A guard against reading that is not linear, not a measurement.
    assert!(started.elapsed().as_secs() < 60);
}

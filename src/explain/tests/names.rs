//! What names mean.

use crate::explain::{Subject, find, subjects};
use crate::isa::{Opcode, Version};

fn named(name: &str) -> String {
    let found = subjects(name).unwrap_or_else(|unknown| panic!("{unknown}"));
    let names: Vec<String> = found.iter().map(Subject::name).collect();
    names.join(" ")
}

#[test]
fn everything_is_found_by_its_name() {
    for subject in Subject::all() {
        let name = subject.name();
        assert!(named(&name).split(' ').any(|found| name == found), "{name}");
    }
    for opcode in Opcode::all() {
        let upper = opcode.mnemonic().to_uppercase();
        assert_eq!(named(&upper).split(' ').next(), Some(opcode.mnemonic()));
        for version in Version::all() {
            let page = find(&upper, Some(version)).unwrap().remove(0);
            assert_eq!(page.name, opcode.mnemonic());
        }
    }
}

#[test]
fn names_are_what_people_type() {
    for (name, meant) in [
        ("LRP", "lrp"),
        (" texm3x3vspec ", "texm3x3vspec"),
        ("mul_x2", "mul _x2"),
        ("mul_x2_sat", "mul _x2 _sat"),
        ("dcl_position", "dcl_position"),
        ("dcl_texcoord3", "dcl_texcoord"),
        ("_bx2", "_bx2"),
        ("bx2", "_bx2"),
        ("_x2", "_x2 _x2"),
        ("_db", "_dz"),
        ("sat", "_sat"),
        ("1-", "1-"),
        ("-", "-"),
        ("r0", "r0"),
        ("r#", "r#"),
        ("r", "r#"),
        ("oPos", "oPos"),
        ("OT0", "oT0"),
        ("oD", "oD#"),
        ("o", "oPos, oFog, oPts"),
        ("a0", "a0"),
        ("a0.x", "a0 mask swizzle"),
        ("c12", "c12"),
        ("c[12].w", "c12 swizzle"),
        ("c[a0.x + 4]", "c# c[a0.x]"),
        ("-r0_bx2.a", "r0 -_bx2 swizzle"),
        ("1-t0", "t0 1-"),
        ("oT0.xy", "oT0 mask swizzle"),
        (".rgb", "mask swizzle"),
        ("+", "+"),
        ("ps.1.4", "ps.1.4"),
        ("PS_1_4", "ps.1.4"),
        ("phase", "phase"),
        ("models", "models"),
        ("--model", "models"),
        ("GF3", "gf3"),
        ("policies", "policies"),
        ("--policy", "policies"),
        ("rcp-zero", "rcp-zero"),
        ("Scalar=x", "scalar"),
        // An instruction, and what is chosen of it.
        ("logp", "logp logp"),
        ("def", "def def"),
        ("0x12", "lrp"),
        ("0x40", "texcoord texcrd"),
        ("D3DSIO_TEX", "tex texld"),
        ("D3DVSDE_NORMAL", "v3"),
        ("D3DVSDT_FLOAT3", "D3DVSD_REG"),
        ("d3dvsd_reg", "D3DVSD_REG"),
        ("b3", "B3"),
        ("K4", "K4"),
        // The capital tells the rule from the register.
        ("r5", "r5"),
        ("R5", "R5"),
        ("c1", "c1"),
        ("C1", "C1"),
        // P2 was given up for S1.
        ("P2", "S1"),
    ] {
        assert_eq!(named(name), meant, "{name}");
    }
}

#[test]
fn what_is_unknown_may_be_near_something() {
    for (name, near) in [("lpr", "lrp"), ("1rp", "lrp"), ("texm3x3v", "texm3x3vspec")] {
        let unknown = find(name, None).unwrap_err();
        assert!(unknown.near.iter().any(|n| n == near), "{unknown}");
        assert!(unknown.to_string().contains(&format!("`{near}`")));
    }
    assert!(
        find("rcpzero", None)
            .unwrap_err()
            .near
            .iter()
            .any(|n| n == "rcp-zero")
    );
    // The instructions of other models have owners.
    assert!(find("nrm", None).unwrap_err().owner.is_some());
    let long = "x".repeat(10_000);
    for name in [
        "",
        " ",
        ".",
        "_",
        "[",
        "]",
        "c[",
        "c]",
        "][",
        "1-.",
        "-_",
        "é",
        "0x",
        "0xfffff",
        "mul_",
        "mul__x2",
        ".xyzwx",
        ".xg",
        "r0.q",
        "scalar=z",
        "gf3=1",
        "=",
        "r4294967296",
        &long,
    ] {
        let unknown = find(name, None).unwrap_err();
        assert!(unknown.to_string().len() < 200, "{name}");
    }
}

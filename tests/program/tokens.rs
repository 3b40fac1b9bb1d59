//! Tokens for other programs, constants beside a vertex shader, and tokens where commands take listings.

use super::{folder, texcrd, texcrd_with_input};
use serde_json::{Value, json};
use std::fs;

/// One JSON value a line.
fn objects(text: &str) -> Vec<Value> {
    text.lines()
        .map(|line| serde_json::from_str(line).expect("JSON"))
        .collect()
}

#[test]
fn asm_as_json() {
    let ran = texcrd_with_input(&["asm", "-", "--format", "json"], b"ps.1.1\nmov r0, v0.a\n");
    assert_eq!((ran.status, ran.err.as_str()), (0, ""));
    // By hand: version; mov, r0, v0 with every component from w (0xFF); end.
    let tokens = [0xFFFF_0101_u32, 1, 0x800F_0000, 0x90FF_0000, 0xFFFF];
    let expected = json!({"file": "<stdin>", "shader": "1", "version": "ps.1.1", "tokens": tokens});
    assert_eq!(objects(&ran.out), [expected]);
}

/// What is wrong comes as `check` prints it, between the results of the shaders that have tokens.
#[test]
fn diagnostics_of_asm_and_dis_are_those_of_check() {
    let source = b"char *a = \"ps.1.1\\nmov r0, r9\\n\";\nchar *b = \"ps.1.1\\nmov r0, v0\\n\";\n";
    let checked = texcrd_with_input(&["check", "-", "--format", "json"], source);
    let ran = texcrd_with_input(&["asm", "-", "--format", "json"], source);
    assert_eq!((ran.status, ran.err.as_str()), (1, ""));
    let (told, made): (Vec<Value>, Vec<Value>) = objects(&ran.out)
        .into_iter()
        .partition(|object| object.get("code").is_some());
    assert_eq!(told, objects(&checked.out));
    assert_eq!(
        (told[0]["code"].as_str(), told[0]["line"].as_u64()),
        (Some("O1"), Some(1))
    );
    let names: Vec<_> = made
        .iter()
        .map(|object| object["shader"].as_str())
        .collect();
    assert_eq!(names, [Some("b")]);

    let stream = b"FFFF0101 00000001 80000000 90E40000 0000FFFF";
    let checked = texcrd_with_input(&["check", "-", "--format", "json"], stream);
    let ran = texcrd_with_input(&["dis", "-", "--format", "json"], stream);
    assert_eq!((ran.status, ran.err.as_str()), (1, ""));
    assert_eq!(objects(&ran.out), objects(&checked.out));
    assert_eq!(objects(&ran.out)[0]["code"], "K8");
}

#[test]
fn dis_as_json() {
    let source =
        b"DWORD a[] = { 0xffff0104, 0xfffd, 0xffff }; DWORD d[] = { 0x20000001, 0xffffffff };";
    let ran = texcrd_with_input(&["dis", "-", "--format", "json"], source);
    assert_eq!((ran.status, ran.err.as_str()), (0, ""));
    let expected = [
        json!({"file": "<stdin>", "shader": "a", "version": "ps.1.4", "listing": "ps.1.4\nphase\n"}),
        json!({
            "file": "<stdin>", "shader": "d", "version": "declaration",
            "listing": "D3DVSD_STREAM(1),\nD3DVSD_END()\n",
        }),
    ];
    assert_eq!(objects(&ran.out), expected);
}

/// The tokens without `def`, the constants beside them, and both together as the listing that they were.
#[test]
fn constants_beside_a_vertex_shader() {
    let folder = folder("asm_constants");
    let path = |name: &str| folder.join(name).display().to_string();
    let listing = "vs.1.1\ndef c4, 0, 0.5, 1, 2\nadd r0, v0, c4\nmov oPos, r0\n";
    fs::write(path("a.vsh"), listing).expect("written");
    let (stream, constants) = (path("a.vso"), path("a.inc"));
    let ran = texcrd(&[
        "asm",
        &path("a.vsh"),
        "-o",
        &stream,
        "--constants",
        &constants,
    ]);
    assert_eq!((ran.status, ran.err.as_str()), (0, ""));
    // By hand: one constant (bits 28:25) from 4 on, 0.5 is 0x3F000000, 1 is 0x3F800000, 2 is 0x40000000.
    let text = "D3DVSD_CONST(4, 1),\n    0x00000000, 0x3F000000, 0x3F800000, 0x40000000, // c4 = 0.0, 0.5, 1.0, 2.0\n";
    assert_eq!(fs::read_to_string(&constants).expect("there"), text);
    let ran = texcrd(&["dis", &stream]);
    assert_eq!(ran.out, "vs.1.1\nadd r0, v0, c4\nmov oPos, r0\n");
    let ran = texcrd(&["dis", &stream, "--constants", &constants]);
    assert_eq!((ran.status, ran.err.as_str()), (0, ""));
    assert_eq!(ran.out, listing);
    // As words, and within a whole declaration.
    let ran = texcrd(&[
        "asm",
        &path("a.vsh"),
        "--format",
        "json",
        "--constants",
        &constants,
    ]);
    let object = &objects(&ran.out)[0];
    let words = [0x8200_0004_u32, 0, 0x3F00_0000, 0x3F80_0000, 0x4000_0000];
    assert_eq!(object["constants"], json!(words));
    assert_eq!(object["tokens"].as_array().map(Vec::len), Some(9));
    let whole = format!(
        "DWORD d[] = {{ D3DVSD_STREAM(0), D3DVSD_REG(0, D3DVSDT_FLOAT3),\n{text}D3DVSD_END() }};"
    );
    fs::write(path("d.h"), whole).expect("written");
    let ran = texcrd(&["dis", &stream, "--constants", &path("d.h")]);
    assert_eq!((ran.status, ran.out.as_str()), (0, listing), "{}", ran.err);
    // What holds no declaration is refused, and so is a constant that none can name.
    let ran = texcrd(&["dis", &stream, "--constants", &path("a.vsh")]);
    assert_eq!((ran.status, ran.out.as_str()), (1, ""));
    let ran = texcrd_with_input(
        &[
            "asm",
            "-",
            "--unchecked",
            "--hex",
            "--constants",
            &path("b.inc"),
        ],
        b"vs.1.1\ndef c200, 1, 1, 1, 1\n",
    );
    assert_eq!((ran.status, ran.out.as_str()), (1, ""));
    assert!(ran.err.contains("K18"), "{}", ran.err);
    assert!(!folder.join("b.inc").exists());
    // A shader without any has an empty piece, which is one.
    let ran = texcrd_with_input(
        &["asm", "-", "--hex", "--constants", &path("c.inc")],
        b"vs.1.1\nmov oPos, v0\n",
    );
    assert_eq!(ran.status, 0, "{}", ran.err);
    let ran = texcrd(&["dis", &stream, "--constants", &path("c.inc")]);
    assert_eq!(ran.status, 0, "{}", ran.err);
}

#[test]
fn declarations_without_a_shader() {
    let text = b"D3DVSD_STREAM(0), D3DVSD_REG(3, D3DVSDT_FLOAT4), D3DVSD_END()";
    let ran = texcrd_with_input(&["dis", "-"], text);
    assert_eq!((ran.status, ran.err.as_str()), (0, ""));
    let ran = texcrd_with_input(&["dis", "-", "--fixed-function"], text);
    assert_eq!(ran.status, 0);
    for part in [
        "warning[D5]",
        "D3DVSDE_NORMAL is loaded as D3DVSDT_FLOAT4",
        "<stdin>:1:19",
    ] {
        assert!(ran.err.contains(part), "{part} in\n{}", ran.err);
    }
}

/// By hand: ps.1.1; mov, r0, c0; end.
const COPY: [u32; 5] = [0xFFFF_0101, 1, 0x800F_0000, 0xA0E4_0000, 0xFFFF];

/// A compiled shader where a listing may stand: in every command that takes a file, in cases and in scenes.
#[test]
fn tokens_wherever_listings_are_taken() {
    let folder = folder("tokens_everywhere");
    let path = |name: &str| folder.join(name).display().to_string();
    let bytes: Vec<u8> = COPY.iter().flat_map(|word| word.to_le_bytes()).collect();
    fs::write(path("a.pso"), bytes).expect("written");
    fs::write(
        path("case.toml"),
        "ps_file = \"a.pso\"\nps_constants.c0 = [0.5, 0.25, 0, 1]\nexpect.r0 = [0.5, 0.25, 0, 1]\n",
    )
    .expect("written");
    fs::write(
        path("scene.toml"),
        "size = [4, 4]\n[meshes.all]\nshape = \"box\"\n[[draw]]\nmesh = \"all\"\n\
         vs_text = \"vs.1.1\\nmov oPos, v0\"\nps = \"a.pso\"\nstate.cull = \"none\"\nps_constants.c0 = [1, 0, 0, 1]\n",
    )
    .expect("written");
    let shader = path("a.pso");
    for (arguments, part) in [
        (vec!["check", &shader], "no complaints"),
        (
            vec!["eval", &shader, "--set", "c0=0.5"],
            "r0    = 0.5, 0.5, 0.5, 0.5",
        ),
        (vec!["translate", &shader], "mov r0, c0"),
        (
            vec!["debug", &shader, "-x", "finish", "-x", "print r0.r"],
            "r0.r",
        ),
        (vec!["test", &path("case.toml")], "1 passed, 0 failed"),
        (
            vec![
                "debug",
                &path("scene.toml"),
                "--pixel",
                "1,1",
                "-x",
                "finish",
                "-x",
                "info registers",
            ],
            "mov r0, c0",
        ),
    ] {
        let ran = texcrd(&arguments);
        assert_eq!(ran.status, 0, "{arguments:?}: {}{}", ran.out, ran.err);
        assert!(ran.out.contains(part), "{arguments:?}: {}", ran.out);
    }
    // Nothing is laid out that has no lines, and it is said what to do.
    let ran = texcrd(&["fmt", &shader]);
    assert_eq!(ran.status, 1);
    assert!(ran.err.contains("`dis`"), "{}", ran.err);
}

/// A case names one shader; a file with several does not say which.
#[test]
fn a_case_with_a_file_of_several_shaders() {
    let folder = folder("case_several");
    let path = |name: &str| folder.join(name).display().to_string();
    let one = "technique T { pass P { PixelShader = asm { ps.1.1 mov r0, v0 }; } }\n";
    let case = "ps_file = \"a.fx\"\ninputs.v0 = [1, 0, 0, 1]\nexpect.r0 = [1, 0, 0, 1]\n";
    fs::write(path("case.toml"), case).expect("written");
    fs::write(path("a.fx"), one).expect("written");
    let ran = texcrd(&["test", &path("case.toml")]);
    assert_eq!(ran.status, 0, "{}{}", ran.out, ran.err);
    fs::write(path("a.fx"), one.replace('T', "A") + one).expect("written");
    let ran = texcrd(&["test", &path("case.toml")]);
    assert_eq!(ran.status, 1);
    assert!(
        ran.out.contains("A/P/PixelShader, T/P/PixelShader"),
        "{}{}",
        ran.out,
        ran.err
    );
}

/// A line that may be a macro of a file that is not there: `check` lets it pass, but half a shader has no tokens.
#[test]
fn half_a_shader_has_no_tokens() {
    let effect = b"#include \"common.fxh\"\ntechnique T { pass P { VertexShader = asm {\n\
                   vs.1.1\nTRANSFORM\nmov oD0, v5\n}; } }\n";
    let ran = texcrd_with_input(&["check", "-"], effect);
    assert_eq!(ran.status, 0, "{}", ran.out);
    for part in ["warning[P28]", "warning[P33]", "<stdin>:4:1"] {
        assert!(ran.out.contains(part), "{part} in\n{}", ran.out);
    }
    for command in [
        &["asm", "-", "--hex"][..],
        &["eval", "-"],
        &["translate", "-"],
    ] {
        let ran = texcrd_with_input(command, effect);
        assert_eq!((ran.status, ran.out.as_str()), (1, ""), "{command:?}");
        assert!(ran.err.contains("P33"), "{command:?}: {}", ran.err);
    }
    // With what is missing it is whole.
    let ran = texcrd_with_input(
        &["asm", "-", "--hex", "-D", "TRANSFORM=mov oPos, v0"],
        effect,
    );
    assert_eq!(ran.status, 0, "{}", ran.err);
}

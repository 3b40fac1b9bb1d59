//! Listings for the preprocessor, effects and sources of C, through the commands. Expected texts were written by hand.

use super::{folder, texcrd, texcrd_with_input};
use std::fs;

const CONSTANTS: &str = "\
#define LIGHT -c8
#define XFORM(dst, src) \\
    dp4 dst.x, src, c0 \\
    dp4 dst.yzw, src, cQ
";

/// The whole of what is said, with its carets: in what a macro made, in text of the listing, in a macro's half of an operand,
/// and in an included file.
#[test]
fn diagnostics_point_at_what_was_written() {
    let folder = folder("hosts_macros");
    let listing = folder.join("a.vsh");
    fs::create_dir_all(folder.join("include")).expect("a folder");
    fs::write(folder.join("include/consts.h"), CONSTANTS).expect("a file");
    let text = "#include \"Consts.h\"\n#ifdef FOG\nvs.1.1\n#endif\nXFORM(oPos, v0)\nmov oD0, -LIGHT.w\nmov oD1, v0 ; LIGHT\n";
    fs::write(&listing, text).expect("a file");
    let path = listing.to_str().expect("a readable path");
    let include = folder.join("include");
    let include = include.to_str().expect("a readable path");
    let ran = texcrd(&["check", "-I", include, "-D", "FOG", path]);
    assert_eq!(ran.status, 1);
    let expected = format!(
        "error[P13]: `cQ` is no register
 --> {path}:5:1
  |
5 | XFORM(oPos, v0)
  | ^^^^^^^^^^^^^^^
  |
  = rule: An operand is a register: r# v# t# c# a0, or oPos oFog oPts oD# oT#.
  = help: it must be `c0`
  = note: expanded, this reads `cQ`
note: in the expansion of `XFORM`, defined here
 --> {include}/consts.h:4:23
  |
4 |     dp4 dst.yzw, src, cQ
  |                       --

error[P15]: 2 minus signs stand before one register
 --> {path}:6:10
  |
6 | mov oD0, -LIGHT.w
  |          ^^^^^^
  |
  = rule: A source takes - or 1- in front or, in pixel shaders, one of _bias _bx2 _x2 _dz _dw behind the register, with - only before the first three.
  = help: two cancel out: write one or none
  = note: expanded, this reads `--`
note: in the expansion of `LIGHT`, defined here
 --> {include}/consts.h:1:15
  |
1 | #define LIGHT -c8
  |               -

{path}: 2 errors
"
    );
    assert_eq!(ran.out, expected);
    // Without the definition there is no version, without the folder no file; nothing follows from the missing file.
    let ran = texcrd(&["check", "-D", "FOG", "--format", "json", path]);
    let lines: Vec<&str> = ran.out.lines().collect();
    assert!(
        lines[0].contains("\"P28\"") && lines[0].contains("\"line\":1"),
        "{}",
        ran.out
    );
    assert!(!ran.out.contains("\"P13\""), "{}", ran.out);
}

#[test]
fn errors_of_included_files_tell_who_includes_them() {
    let folder = folder("hosts_include");
    fs::write(folder.join("body.inc"), "mov r0, v9\n").expect("a file");
    let listing = folder.join("a.psh");
    fs::write(&listing, "ps.1.1\n  #include \"body.inc\"\n").expect("a file");
    let ran = texcrd(&["check", listing.to_str().expect("a readable path")]);
    for part in [
        "body.inc:1:9",
        "1 | mov r0, v9",
        "note: the file is included here",
        "a.psh:2:12",
        "2 |   #include \"body.inc\"",
    ] {
        assert!(ran.out.contains(part), "{part} in\n{}", ran.out);
    }
    // Repairs are made in the file that is checked, not in those that it includes, and not in what macros make.
    fs::write(folder.join("body.inc"), "mov r0, vl\n").expect("a file");
    fs::write(
        &listing,
        "#define V vl\nps.1.1\nmov r0, vl\nmul r0, r0, V\n#include \"body.inc\"\n",
    )
    .expect("a file");
    let ran = texcrd(&["check", "--fix", listing.to_str().expect("a readable path")]);
    assert_eq!(ran.status, 1);
    assert_eq!(
        fs::read_to_string(&listing).expect("still there"),
        "#define V vl\nps.1.1\nmov r0, v1\nmul r0, r0, V\n#include \"body.inc\"\n"
    );
    assert_eq!(
        fs::read_to_string(folder.join("body.inc")).expect("still there"),
        "mov r0, vl\n"
    );
}

const EFFECT: &str = "#define C 4\ntechnique T { pass P {\n  VertexShader = asm {\n    vs.1.1\n    mov oPos,v0  ; place\n    mov oD0, c[C] ; colour\n  };\n  PixelShader = asm {\n    ps.1.1\n    mov r0, v0\n  };\n} }\n";

#[test]
fn commands_take_effects() {
    let with = |arguments: &[&str]| texcrd_with_input(arguments, EFFECT.as_bytes());
    let checked = with(&["check", "--stats", "-"]);
    assert_eq!(checked.status, 0, "{}", checked.out);
    for part in [
        "no complaints",
        "T/P/VertexShader: vs.1.1",
        "T/P/PixelShader: ps.1.1",
    ] {
        assert!(checked.out.contains(part), "{}", checked.out);
    }
    // mov oPos, v0; mov oD0, c4 by the tables of the token format.
    let tokens = with(&["asm", "--hex", "-", "--shader", "1"]);
    assert_eq!(
        tokens.out,
        "FFFE0101\n00000001\nC00F0000\n90E40000\n00000001\nD00F0000\nA0E40004\n0000FFFF\n"
    );
    let both = with(&["asm", "--hex", "-"]);
    assert!(
        both.out.contains("// T/P/PixelShader\nFFFF0101\n"),
        "{}",
        both.out
    );
    assert_eq!(with(&["asm", "-"]).status, 2);
    // All shaders are run, and each takes what its version has: v0 both, v2 only the vertex shader. c4 is not set, so oD0 is 0.
    let several = with(&["eval", "-", "--set", "v0=0.5", "--set", "v2=1"]);
    assert_eq!(several.status, 0, "{}", several.err);
    assert_eq!(
        several.out,
        "// T/P/VertexShader\noPos  = 0.5, 0.5, 0.5, 0.5\noD0   = 0, 0, 0, 0\n\n\
         // T/P/PixelShader\nr0    = 0.5, 0.5, 0.5, 0.5\n\n"
    );
    assert!(several.err.contains("I7"), "{}", several.err);
    assert_eq!(with(&["eval", "-", "--set", "v16=1"]).status, 2);
    // Of two shaders one of which is refused the other is run all the same.
    let half = EFFECT.replace("mov r0, v0", "mov r0, r1");
    let half = texcrd_with_input(&["eval", "-", "--format", "json"], half.as_bytes());
    assert_eq!((half.status, half.out.lines().count()), (1, 1));
    assert!(half.out.contains(r#""shader":"T/P/VertexShader""#));
    let one = with(&[
        "eval",
        "-",
        "--shader",
        "t/p/pixelshader",
        "--set",
        "v0=0.5",
    ]);
    assert_eq!(
        (one.status, one.out.as_str()),
        (0, "r0    = 0.5, 0.5, 0.5, 0.5\n")
    );
    // A trace tells the lines of the file and what was run.
    let trace = with(&["eval", "-", "--shader", "1", "--trace"]);
    assert!(trace.out.contains("   6  mov oD0, c[4]"), "{}", trace.out);
    // Both stages of the pass in one module.
    let wgsl = with(&["translate", "-"]);
    assert_eq!(wgsl.status, 0, "{}", wgsl.err);
    assert!(
        wgsl.out.contains("// 6: mov oD0, c[C] ; colour"),
        "{}",
        wgsl.out
    );
    // With a pass more: two modules, the first of both stages, each behind the names of its shaders.
    let more = EFFECT.replace(
        "} }",
        "} pass Q { PixelShader = asm { ps.1.1 mov r0, v1 }; } }",
    );
    let wgsl = texcrd_with_input(&["translate", "-"], more.as_bytes());
    assert_eq!(wgsl.status, 0, "{}", wgsl.err);
    let headings = [
        "// T/P/VertexShader, T/P/PixelShader\n",
        "// T/Q/PixelShader\n",
    ];
    let places = headings.map(|heading| wgsl.out.find(heading));
    assert!(
        places[0] == Some(0) && places[1] > places[0],
        "{}",
        wgsl.out
    );
    assert_eq!(wgsl.out.matches("fn ps_main").count(), 2);
    assert_eq!(
        texcrd_with_input(&["translate", "-", "-o", "none.wgsl"], more.as_bytes()).status,
        2
    );
    assert_eq!(with(&["check", "-", "--shader", "Q"]).status, 2);
}

#[test]
fn listings_and_effects_are_laid_out() {
    let expected = EFFECT.replace("mov oPos,v0  ; place", "mov oPos, v0  ; place");
    let ran = texcrd_with_input(&["fmt", "-"], EFFECT.as_bytes());
    assert_eq!((ran.status, ran.out.as_str()), (0, expected.as_str()));
    let folder = folder("hosts_fmt");
    let (untidy, tidy) = (folder.join("a.psh"), folder.join("b.psh"));
    fs::write(&untidy, "ps.1.1\n  mov r0,v0").expect("a file");
    fs::write(&tidy, "ps.1.1\nmov r0, v0\n").expect("a file");
    let (a, b) = (
        untidy.to_str().expect("a path"),
        tidy.to_str().expect("a path"),
    );
    let ran = texcrd(&["fmt", "--check", a, b]);
    assert_eq!((ran.status, ran.out), (1, format!("{a}\n")));
    assert_eq!(
        fs::read_to_string(&untidy).expect("still there"),
        "ps.1.1\n  mov r0,v0"
    );
    assert_eq!(texcrd(&["fmt", a, b]).status, 0);
    assert_eq!(texcrd(&["fmt", "--check", a, b]).status, 0);
    assert_eq!(
        fs::read_to_string(&untidy).expect("still there"),
        "ps.1.1\nmov r0, v0\n"
    );
    let string = texcrd_with_input(&["fmt", "-"], b"char *s = \"ps.1.1\\nmov r0,v0\";\n");
    // What has no layout of ours comes through a pipe as it is.
    let same = "char *s = \"ps.1.1\\nmov r0,v0\";\n";
    assert_eq!((string.status, string.out.as_str()), (0, same));
    assert!(string.err.contains("stand in strings"), "{}", string.err);
}

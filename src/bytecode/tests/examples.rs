//! Streams that were put together by hand, word by word, against the listings that they stand for.

use super::*;

/// The listing has these tokens, and the tokens, listed, give the listing of the same shader.
#[track_caller]
fn same(listing: &str, tokens: &str) {
    let words = words(tokens);
    let given = assembled(listing);
    assert_eq!(given, words, "\n{given:08X?}\n{words:08X?}\n{listing}");
    assert_eq!(listed(&words), syntax::print(&program(listing)));
}

/// The first worked example of the specification.
#[test]
fn two_phases() {
    same(
        "ps.1.4
         def c0, 0.5, 0.5, 0.5, 1.0
         texld r0, t0
         texcrd r1.rgb, t1
         mad_x2_sat r1.rgb, r0_bx2, c0, -r1
         phase
         texld r2, r1_dz
         mul r0.rgb, r2, v0
         +mov r0.a, v0",
        "FFFF0104                            ; pixel shader 1.4
         00000051 A00F0000                   ; def, c0 with all four components
         3F000000 3F000000 3F000000 3F800000 ; 0.5, 0.5, 0.5, 1
         00000042 800F0000 B0E40000          ; texld, r0, t0
         00000040 80070001 B0E40001          ; texcrd, r1 with the mask xyz, t1
         00000004 81170001                   ; mad, r1 with xyz, saturated, shift 1
         84E40000 A0E40000 81E40001          ; r0 with modifier 4, c0, r1 with modifier 1
         0000FFFD                            ; phase
         00000042 800F0002 89E40001          ; texld, r2, r1 with modifier 9
         00000005 80070000 80E40002 90E40000 ; mul, r0 with xyz, r2, v0
         40000001 80080000 90E40000          ; mov with the co-issue bit, r0 with w, v0
         0000FFFF",
    );
}

/// The second one: a vertex shader of Direct3D 8.
#[test]
fn a_vertex_shader_with_an_address() {
    same(
        "vs.1.1
         m4x4 oPos, v0, c0
         mov a0.x, v1.x
         mul r0, v5, c[a0.x+8]
         mov oD0, r0
         mov oFog.x, c4.w",
        "FFFE0101                            ; vertex shader 1.1
         00000014 C00F0000 90E40000 A0E40000 ; m4x4, oPos: file 4 number 0, v0, c0
         00000001 B0010000 90000001          ; mov, a0 with x: file 3, v1 with xxxx
         00000005 800F0000 90E40005 A0E42008 ; mul, r0, v5, c8 with the relative bit
         00000001 D00F0000 80E40000          ; mov, oD0: file 5, r0
         00000001 C0010001 A0FF0004          ; mov, oFog with x: file 4 number 1, c4 with wwww
         0000FFFF",
    );
}

/// The third one.
#[test]
fn bump_mapping() {
    same(
        "ps.1.1
         tex t0
         texm3x2pad t1, t0_bx2
         texm3x2tex t2, t0_bx2
         dp3_sat r0, t0_bx2, v0_bx2
         mul_d2 r0.rgb, r0, 1-t2.a",
        "FFFF0101
         00000042 B00F0000                   ; tex, t0
         00000047 B00F0001 B4E40000          ; texm3x2pad, t1, t0 with modifier 4
         00000048 B00F0002 B4E40000          ; texm3x2tex, t2, t0 with modifier 4
         00000008 801F0000 B4E40000 94E40000 ; dp3, r0 saturated, t0 and v0 with modifier 4
         00000005 8F070000 80E40000 B6FF0002 ; mul, r0 with xyz and shift -1, r0, t2 with modifier 6 and wwww
         0000FFFF",
    );
}

/// Streams that the runtime of the time took in published tests.
#[test]
fn tokens_that_the_runtime_took() {
    same(
        "ps.1.1\ntexcoord t0\ncnd r0, r0.a, c1, c2\n+cnd r0.rgb, r0.a, c1, c2",
        "FFFF0101
         00000040 B00F0000                            ; texcoord, t0
         00000050 800F0000 80FF0000 A0E40001 A0E40002 ; cnd, r0, r0 with wwww, c1, c2
         40000050 80070000 80FF0000 A0E40001 A0E40002 ; the same with xyz, beside it
         0000FFFF",
    );
    same(
        "vs.1.1\ndp4 oPos.x, v0, c0\nmul oFog, r0.x, c0.x",
        "FFFE0101
         00000009 C0010000 90E40000 A0E40000 ; dp4, oPos with x, v0, c0
         00000005 C00F0001 80000000 A0000000 ; mul, oFog with all, r0 and c0 with xxxx
         0000FFFF",
    );
}

/// The operands of one instruction, behind its opcode.
#[track_caller]
fn operands(version: &str, line: &str, tokens: &str) {
    let given = assembled(&format!("{version}\n{line}"));
    let operands = given.get(2..given.len() - 1).unwrap();
    assert_eq!(operands, words(tokens), "{line}\n{given:08X?}");
}

/// What an assembler of the time made of single lines, validation off.
#[test]
fn single_lines() {
    operands("ps.1.3", "mov r0, 1 - r1", "800F0000 86E40001");
    operands("ps.1.3", "mov_x2_sat r0, 1 - r1", "811F0000 86E40001");
    operands("ps.1.1", "mov_d4 r0, r1", "8E0F0000 80E40001");
    operands("ps.1.3", "mov_d8 r0, -r1", "8D0F0000 81E40001");
    operands("ps.1.3", "mov_x4_sat r0.a, -r1_bx2.a", "82180000 85FF0001");
    operands("ps.1.3", "mov_sat r0, -r1_x2", "801F0000 88E40001");
    operands("ps.1.3", "tex_x2 t0", "B10F0000");
    operands("ps.1.3", "texbem_d4 t1, t0", "BE0F0001 B0E40000");
    operands("ps.1.3", "texreg2ar_x4 t0, t1", "B20F0000 B0E40001");
    operands("ps.1.4", "texcrd r0, t0", "800F0000 B0E40000");
    operands("ps.1.4", "texcrd_sat r4, t3", "801F0004 B0E40003");
    operands("ps.1.4", "texld r5, c0", "800F0005 A0E40000");
    operands("ps.1.4", "texdepth_x2 r5", "810F0005");
    operands("ps.1.4", "bem r1.rg, c0, r0", "80030001 A0E40000 80E40000");
    operands("ps.1.4", "bem_d2 r1, c0, r0", "8F0F0001 A0E40000 80E40000");
    operands(
        "ps.1.3",
        "cnd r0, r1, r0, v0",
        "800F0000 80E40001 80E40000 90E40000",
    );
    operands("vs.1.1", "dcl_position0 v0", "80000000 900F0000");
    operands("vs.1.1", "dcl_color0 v1", "8000000A 900F0001");
    operands("vs.1.1", "dcl_normal12 v15", "800C0003 900F000F");
    operands("vs.1.1", "mov r0, c4[ 2 ]", "800F0000 A0E40006");
    operands("vs.1.1", "mov r0, c[ 2 + 10 + 12 ]", "800F0000 A0E40018");
    operands("vs.1.1", "mov r0, c[ 2 + a0.x + 12 ]", "800F0000 A0E4200E");
    operands("vs.1.1", "mov r0, c1[a0.x + 2]", "800F0000 A0E42003");
    operands(
        "vs.1.1",
        "dp4 r0.xw, r1.wzyx, r2.xxww",
        "80090000 801B0001 80F00002",
    );
    // The common swizzles: xyw is F4, xyz is A4, and none is E4.
    operands("ps.1.4", "texld r0, t0.xyw", "800F0000 B0F40000");
    operands("ps.1.4", "texld r0, t0.xyz", "800F0000 B0A40000");
    operands("ps.1.4", "texcrd r0.rg, t0_dw.xyw", "80030000 BAF40000");
    // The files of registers in the top digit.
    operands("vs.1.1", "mov oT6.xy, -c95.y", "E0030006 A155005F");
    operands("vs.1.1", "mov oPts.x, v15.z", "C0010002 90AA000F");
}

/// The assembler had no subtraction for vertex shaders: it added what was negated.
#[test]
fn a_vertex_shader_subtracts_by_adding() {
    let tokens = "FFFE0101
        00000002 800F0000 90E40000 A1E40001 ; add, r0, v0, c1 negated
        00000002 800F0000 91E40000 A0E40001 ; add, r0, v0 negated, c1 not
        0000FFFF";
    let listing = "vs.1.1\nsub r0, v0, c1\nsub r0, -v0, -c1";
    assert_eq!(assembled(listing), words(tokens));
    let added = "vs.1.1\nadd r0, v0, -c1\nadd r0, -v0, c1\n";
    assert_eq!(listed(&words(tokens)), added);
    // In a pixel shader it is an instruction of its own.
    operands("ps.1.1", "sub r0, v0, c1", "800F0000 90E40000 A0E40001");
    assert_eq!(assembled("ps.1.1\nsub r0, v0, c1")[1], 3);
}

/// Every number of a `def` stands as its bits: sign of zero, denormals, infinities, NaN.
#[test]
fn numbers_to_the_bit() {
    let tokens = "FFFF0101
        00000051 A00F0003 80000000 00000001 7F800000 FF800000 ; -0, smallest denormal, both infinities
        00000051 A00F0004 7FC00001 FFFFFFFF 7F7FFFFF 3DCCCCCD ; NaNs, the largest number, 0.1
        0000FFFF";
    let listing = "ps.1.1
def c3, -0, 1e-45, 0x7F800000, 0xFF800000
def c4, 0x7FC00001, 0xFFFFFFFF, 3.4028235e38, 0.1
";
    assert_eq!(listed(&words(tokens)), listing);
    assert_eq!(assembled(listing), words(tokens));
}

#[test]
fn comments_stand_where_they_stood() {
    let tokens = "FFFF0101
        0003FFFE 42415443 0000001C 00007870 ; a comment of three words: CTAB, 28, px
        00000042 B00F0000                   ; tex
        0000FFFE                            ; a comment without words
        0001FFFE 0000FFFF                   ; one that holds an end token
        00000001 800F0000 B0E40000          ; mov
        0002FFFE 22215C0A 00000000          ; one that holds a line end, a backslash, ! and a quote
        0000FFFF";
    let listing = r#"ps.1.1
;@comment "CTAB" 0000001C 00007870
tex t0
;@comment
;@comment 0000FFFF
mov r0, t0
;@comment "\n\\!\"" 00000000
"#;
    assert_eq!(listed(&words(tokens)), listing);
    assert_eq!(assembled(listing), words(tokens));
    // What a person writes is no token.
    let talk = "ps.1.1 ; @comment \"no\"\n;@commentary\n;@ no\nmov r0, v0 // yes\n";
    assert_eq!(assembled(talk).len(), 5);
}

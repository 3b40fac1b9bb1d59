//! What is a listing: `spec/syntax.md`, section by section.

use super::*;
use crate::isa::{Opcode, RegisterFile, SourceModifier, Swizzle, Version, WriteMask};
use crate::program::{Register, Source, Usage};

fn line(version: &str, line: &str) -> Instruction {
    only(&format!("{version}\n{line}\n"))
}

fn source(version: &str, operand: &str) -> Source {
    line(version, &format!("mov r0, {operand}")).sources[0]
}

#[test]
fn both_spellings_of_every_version() {
    for version in Version::all() {
        let dots = version.name().to_string();
        for text in [dots.clone(), dots.replace('.', "_"), dots.to_uppercase()] {
            assert_eq!(accepted(&text).version, version, "{text}");
        }
    }
}

/// Section 12.1: assembles, whatever a validator says.
const ASSEMBLES: [(&str, &str); 47] = [
    ("ps.1.3", "mov r0, 1 - r1"),
    ("ps.1.3", "mov_x2_sat r0, 1 - r1"),
    ("ps.1.1", "mov_d4 r0, r1"),
    ("ps.1.3", "mov_d8 r0, -r1"),
    ("ps.1.3", "mov_x4_sat r0.a, -r1_bx2.a"),
    ("ps.1.3", "mov_sat r0, -r1_x2"),
    ("ps.1.3", "tex_x2 t0"),
    ("ps.1.3", "texcoord_x2 t0"),
    ("ps.1.3", "texbem_d4 t1,t0"),
    ("ps.1.3", "texreg2ar_x4 t0,t1"),
    ("ps.1.3", "texm3x3pad_x2 t1, t0"),
    ("ps.1.4", "texcrd r0, t0"),
    ("ps.1.4", "texcrd_sat r4, t3"),
    ("ps.1.4", "texld r5, c0"),
    ("ps.1.4", "texld r5, r2_dz"),
    ("ps.1.4", "texdepth_x2 r5"),
    ("ps.1.4", "bem r1.rg, c0, r0"),
    ("ps.1.4", "bem_d2 r1, c0, r0"),
    ("ps.1.3", "cnd r0, r1, r0, v0"),
    ("vs.1.1", "mov r0, c4[ 2 ]"),
    ("vs.1.1", "mov r0, c[ 2 + 10 + 12 ]"),
    ("vs.1.1", "mov r0, c[ 2 + a0.x + 12 ]"),
    ("vs.1.1", "mov r0, c[ 2 + a0.x - 1 ]"),
    ("vs.1.1", "mov r0, c1[a0.x + 2]"),
    ("vs.1.1", "mov r0, c0[ 1 + 2 + 3 + 4 ]"),
    ("vs.1.1", "dp4 r0.xw, r1.wzyx, r2.xxww"),
    ("vs.1.1", "add r0, v0, v1"),
    ("vs.1.1", "add r0, r1, r2"),
    ("vs.1.1", "m4x4 oPos, v0, c[16]"),
    ("ps.1.1", "MUL_SAT R0.RGB, T0, V0.A"),
    ("ps.1.1", "mul\tr0 . rgb ,\r\n t0\n, v0"),
    ("ps.1.1", "mul r0.rgb,t0,v0"),
    ("ps.1.1", "texkill t0"),
    ("ps.1.4", "phase"),
    ("ps.1.1", "nop"),
    ("ps.1.2", "texm3x2pad t1, t0_bx2"),
    ("vs.1.0", "mov oFog.x, v0.x"),
    ("vs.1.0", "mov oPts, v0.x"),
    ("vs.1.0", "mov OPOS.xyz, v0"),
    ("vs.1.0", "mov oD1, v[5]"),
    ("ps.1.4", "texld r0, t1_dw.xyw"),
    ("ps.1.4", "texld r0, t1_da.xyw"),
    ("ps.1.4", "texld r0, r3_db.xyz"),
    ("ps.1.1", "mov r0, -v0_bx2"),
    ("ps.1.1", "mov r0, c3.aaaa"),
    ("ps.1.1", "texld r0, t0"),
    ("ps.1.1", "mov r0, r1 ; ' \" /* #define"),
];

#[test]
fn what_assembles_is_read() {
    for (version, text) in ASSEMBLES {
        line(version, text);
    }
}

/// Section 12.2: never assembles, and no rule of the shader model is needed to say so.
const NEVER: [(&str, &str, &str); 31] = [
    ("ps.1.3", "mov_x2_x2 r0, r1", "P12"),
    ("ps.1.4", "texld r5, -r2_dz", "P15"),
    ("ps.1.3", "mov r1, 2 - r0", "P15"),
    ("vs.1.1", "mov r2, 1 - r1", "O23"),
    ("vs.1.1", "mov r2, r1_x2", "O23"),
    ("vs.1.1", "mov r2, r1_abs", "P15"),
    ("vs.1.1", "mov r1.abcd, r0", "P14"),
    ("vs.1.1", "mov r0, r1.xyzwx", "P14"),
    ("vs.1.1", "mov r0, r1.", "P14"),
    ("vs.1.1", "mov r0.xxyz, r1", "O24"),
    ("vs.1.1", "mov r0.yx, r1", "O24"),
    ("vs.1.1", "mov r0, r1.xg", "P14"),
    ("vs.1.1", "mov r0, r1.stp", "P14"),
    ("ps.1.3", "add oC0, r0, r1", "P13"),
    ("vs.1.1", "mov r0, c0[ a0 ]", "O6"),
    ("vs.1.1", "mov r0, c0[ a0.y ]", "O6"),
    ("vs.1.1", "mov r0, c[ a0.x + 3.4 ]", "P16"),
    ("vs.1.1", "mov r0, c[ a0.x - 1 ]", "P16"),
    ("vs.1.1", "mov r0, c[ 5 - a0.x ]", "P16"),
    ("vs.1.1", "mov r0, c[ a0.x + a0.x ]", "P16"),
    ("vs.1.1", "mov r0, c[]", "P16"),
    ("vs.1.1", "mov r0, c[a0.x", "P16"),
    ("vs.1.1", "mov r0, c[4294967295 + 1]", "P16"),
    ("any", "mov r0, r1, r2", "P10"),
    ("vs.1.1", "mov r0, s0", "P13"),
    ("ps.1.1", "mov r0, -1-r1", "M4"),
    ("ps.1.1", "mov r0, 1-r1_bx2", "M4"),
    ("ps.1.1", "mov r0, --r1", "P15"),
    ("ps.1.1", "mul r0, r0_sat, r1", "P15"),
    ("vs.1.1", "mov_sat r0, r1", "O23"),
    ("ps.1.1", "mov r0, 0.5", "P13"),
];

#[test]
fn what_never_assembles_has_one_diagnostic_each() {
    for (version, text, rule) in NEVER {
        let version = if version == "any" { "ps.1.4" } else { version };
        let found = found(format!("{version}\n{text}\nnop\n"));
        let rules: Vec<_> = found.iter().map(|(rule, _)| *rule).collect();
        assert_eq!(rules, [rule], "{text}");
    }
}

#[test]
fn judged_later() {
    // Section 12.2 too, but each is a rule of the shader model; reading only states what was written.
    let text = "ps.1.3\nmov r5, r0\ntex t5\nvs";
    assert_eq!(found(text).len(), 1);
    accepted("vs.1.1\nadd r0, r0, r2\n+add r0.w, r0, r2\nmov r0, r0[ a0.x ]\nmov r0, v[ a0.x ]");
    accepted("ps.1.1\ncmp r0, t0, c0, c1\nm4x4 r0, r0, c0\nrsq r0, r0\n");
}

#[test]
fn operands_mean_what_they_say() {
    let s = source("ps.1.4", "-r1_x2.r");
    assert_eq!(s.modifier, SourceModifier::X2Negate);
    assert_eq!(s.swizzle, Swizzle::replicate(0));
    assert_eq!(
        source("ps.1.1", "1-t0.a").modifier,
        SourceModifier::Complement
    );
    let s = source("vs.1.1", "-c[a0.x+4].wzyx");
    assert_eq!(s.modifier, SourceModifier::Negate);
    assert_eq!(s.swizzle, Swizzle::new([3, 2, 1, 0]));
    let relative = |index| Register {
        relative: true,
        ..Register::new(RegisterFile::Const, index)
    };
    assert_eq!(s.register, relative(4));
    // c8[3 + 2 + a0.x + 5]: 8 + 3 + 2 + 5.
    assert_eq!(
        source("vs.1.1", "c8[3 + 2 + a0.x + 5]").register,
        relative(18)
    );
    assert_eq!(source("vs.1.1", "c12[a0.x]").register, relative(12));
    assert_eq!(source("vs.1.1", "c[45 + a0.x]").register, relative(45));
    assert_eq!(
        source("vs.1.1", "c4[2]").register,
        Register::new(RegisterFile::Const, 6)
    );
    assert_eq!(
        source("vs.1.1", "v0.zwx").swizzle,
        Swizzle::new([2, 3, 0, 0])
    );
    let i = line("ps.1.4", "mul_x8_sat r1.gb, r0, r2.rgb");
    assert_eq!((i.result.shift, i.result.saturate), (3, true));
    assert_eq!(i.destination.unwrap().mask, WriteMask::from_bits(0b0110));
    assert_eq!(i.sources[1].swizzle, Swizzle::XYZZ);
    // Either order of the suffixes.
    assert_eq!(line("ps.1.1", "mul_sat_d2 r0, r1, r0").result.shift, -1);
    assert_eq!(
        line("ps.1.2", "texm3x2pad t1, t0").opcode,
        Opcode::TexM3x2Pad
    );
}

#[test]
fn numbers() {
    let program =
        accepted("vs.1.1\ndef c2, 0, 0., .5f, -1.0e+05F\ndef c0, 1e-3, +2, -0, 0.250000\n");
    let values: Vec<_> = program.definitions().map(|d| d.value).collect();
    assert_eq!(values, [[0.0, 0.0, 0.5, -1.0e5], [1e-3, 2.0, 0.0, 0.25]]);
    for wrong in ["1e999", "0x10", "1.2.3", "-", "abc"] {
        let found = found(format!("vs.1.1\ndef c0, 1, {wrong}, 0, 0\n"));
        assert_eq!(found.len(), 1, "{wrong}: {found:?}");
        assert_eq!(found[0].0, "P17", "{wrong}");
    }
    for wrong in ["1, 2, 3", "1, 2, 3, 4, 5", "0,9f, 0.0f, 0.0f, 0.0f"] {
        assert_eq!(found(format!("vs.1.1\ndef c0, {wrong}\nnop"))[0].0, "O25");
    }
}

#[test]
fn warnings_for_spellings_that_the_documents_do_not_have() {
    for text in ["def c1  0,0,0,0", "mov r0, 1.0-r1", "mov r0, t0.a_bx2"] {
        let parsed = read(format!("ps.1.1\n{text}\n")).1;
        assert_eq!(parsed.diagnostics.len(), 1, "{text}");
        assert_eq!(parsed.diagnostics[0].rule.id, "P22");
        assert_eq!(
            parsed.diagnostics[0].severity,
            crate::diagnostic::Severity::Warning
        );
        assert_eq!(parsed.program.unwrap().statements.len(), 1);
    }
}

#[test]
fn co_issue_in_front_alone_and_behind() {
    for text in [
        "add r0.rgb, r0, r1\n+mov r0.a, t0",
        "add r0.rgb, r0, r1\n + mov r0.a, t0",
        "add r0.rgb, r0, r1\n+ ; alone\n\n mov r0.a, t0",
        "add r0.rgb, r0, r1 +\nmov r0.a, t0",
        "add r0.rgb, r0, r1 + mov r0.a, t0",
    ] {
        let program = accepted(format!("ps.1.1\n{text}"));
        let flags: Vec<_> = program.instructions().map(|i| i.co_issue).collect();
        assert_eq!(flags, [false, true], "{text}");
    }
    assert_eq!(found("ps.1.1\nmov r0, v0\n+"), [("P19", "+".to_string())]);
    assert_eq!(found("ps.1.1\nmov r0.rgb, v0\n++mov r0.a, v0").len(), 1);
}

#[test]
fn lines_mean_nothing() {
    let one = accepted("ps.1.1 tex t0 mul r0, t0, v0 + mov r1.a, v0");
    assert_eq!(one.statements.len(), 3);
    let program =
        accepted("\u{FEFF}; one\r\n// two\r\n/* three\r\n */ ps_1_1\r\ntex\r\nt0 // x\r\n\0");
    assert_eq!(program.instructions().count(), 1);
    accepted(b"; \xE4\xF6 in a code page\nps.1.1\n// \x96 \xA0\n".as_slice());
    accepted("#line 1 \"file\"\n#pragma x \\\n mov\nvs.1.1\n  #  line 3\nnop");
}

#[test]
fn declarations() {
    let program = accepted(
        "vs_1_1\ndcl_position0 v0\ndcl_position v1\ndcl_normal12 v15\ndcl_texcoord1 v7.xy\n",
    );
    let read: Vec<_> = program
        .declarations()
        .map(|d| (d.usage, d.usage_index, d.register.index, d.mask))
        .collect();
    let all = WriteMask::ALL;
    assert_eq!(
        read,
        [
            (Usage::Position, 0, 0, all),
            (Usage::Position, 0, 1, all),
            (Usage::Normal, 12, 15, all),
            (Usage::TexCoord, 1, 7, WriteMask::XY),
        ]
    );
    for wrong in [
        "dcl v0",
        "dcl_colour v0",
        "dcl_color16 v0",
        "dcl_color v0, v1",
        "dcl_color",
    ] {
        assert_eq!(found(format!("vs_1_1\n{wrong}\nnop")).len(), 1, "{wrong}");
    }
}

#[test]
fn directives_are_named_and_the_names_they_define_are_not_reported() {
    let text = "vs.1.1\n#define LIGHT c8\n#define A \\\n b\nmov r0, LIGHT\nmov r1, c[CV_X]\nFETCH(r0)\nmov r2, r0\n";
    let (_, parsed) = read(text);
    assert_eq!(parsed.diagnostics.len(), 1);
    assert!(parsed.diagnostics[0].message.contains("#define"));
    assert_eq!(parsed.program.unwrap().statements.len(), 1);
}

#[test]
fn spans_point_at_the_text() {
    let text = "ps.1.4\n +mul_x2 r0.rgb , -r1_bx2.a, c[ 2 ] ; x\n";
    let (map, parsed) = read(text);
    let program = parsed.program.unwrap();
    let i = program.instructions().next().unwrap();
    assert_eq!(map.text(program.version_span), "ps.1.4");
    assert_eq!(map.text(program.span), text);
    assert_eq!(map.text(i.span), "mul_x2 r0.rgb , -r1_bx2.a, c[ 2 ]");
    assert_eq!(map.text(i.mnemonic_span), "mul_x2");
    assert_eq!(map.text(i.destination.unwrap().span), "r0.rgb");
    assert_eq!(map.text(i.sources[0].span), "-r1_bx2.a");
    assert_eq!(map.text(i.sources[1].span), "c[ 2 ]");
}

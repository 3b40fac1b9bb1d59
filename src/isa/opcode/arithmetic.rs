//! The rows of what both kinds of shader have, and of the arithmetic that only pixel shaders have.

use super::vocabulary::*;
use super::{Class, Opcode, OpcodeRow, Pairing};
use crate::isa::operand::MaskSet;
use crate::isa::register::{FileSet, RegisterFile};
use crate::isa::version::Version;
use Opcode::*;

const DOT3: &str = "d = s0.r * s1.r + s0.g * s1.g + s0.b * s1.b";
const DOT4: &str = "d = s0.r * s1.r + s0.g * s1.g + s0.b * s1.b + s0.a * s1.a";
const INTERPOLATED: &str = "d = s0 * s1 + (1 - s0) * s2";

#[rustfmt::skip]
pub(super) static ROWS: [OpcodeRow; 15] = [
    op(Nop, ("nop", 0x00), "no operation", &[],
        "Does nothing and has no operands.", &[
        bare(VS, Class::Arithmetic, "nothing").costs(1, 0)
            .shown("m4x4 oPos, v0, c0\nnop"),
        bare(PS, Class::Arithmetic, "nothing").costs(0, 0)
            .shown("mov r0, v0\nnop"),
    ]),
    op(Mov, ("mov", 0x01), "copy", &[],
        "Copies a register, with swizzle and modifiers of the source on the way.", &[
        vs(V1, "d = s0").of(Version::Vs10.only())
            .shown("m4x4 oPos, v0, c0\nmov oD0, v5"),
        vs(V1, "d = s0; a0.x = floor(s0.x)").of(Version::Vs11.only()).to(VS_OUT_A0, MaskSet::ANY)
            .noted("It alone writes the address register, with the mask .x. The number is rounded down, so that -0.4 \
                    becomes -1 and 1.6 becomes 1; NaN becomes 0.")
            .shown("mov a0.x, v1.x\nm4x4 oPos, v0, c[a0.x]\nmov oD0, v5"),
        ps13(P1, "d = s0").shown("tex t0\nmov r0, t0"),
        ps14(Q1, "d = s0").shown("texld r0, t0\nmov r0.a, c0.r"),
    ]),
    op(Add, ("add", 0x02), "addition", &[Sub, Mad],
        "Adds two registers component by component.", &[
        vs(V2, "d = s0 + s1").shown("m4x4 r0, v0, c0\nadd oPos, r0, c4"),
        ps13(P2, "d = s0 + s1").shown("tex t0\nadd r0, t0, v0"),
        ps14(Q2, "d = s0 + s1").shown("texld r0, t0\nadd r0.rgb, r0, c0"),
    ]),
    op(Sub, ("sub", 0x03), "subtraction", &[Add],
        "Subtracts the second source from the first, component by component.", &[
        vs(V2, "d = s0 - s1")
            .noted("It has no token of its own in vertex shaders: the assembler wrote an add with the second source negated, \
                    and what comes back from the tokens is that add.")
            .shown("m4x4 oPos, v0, c0\nsub oT0.xyz, c4, v0"),
        ps13(P2, "d = s0 - s1").shown("tex t0\nsub r0, t0, v0"),
        ps14(Q2, "d = s0 - s1").shown("texld r0, t0\nsub r0.rgb, c0, r0"),
    ]),
    op(Mad, ("mad", 0x04), "multiplication and addition", &[Mul, Add, Lrp],
        "Multiplies two registers and adds a third, component by component. The product is rounded before the sum. A product \
         with a factor of 0 is 0, even against infinity.", &[
        vs(V3, "d = s0 * s1 + s2").shown("m4x4 oPos, v0, c0\nmad oT0.xy, v7, c4.xy, c4.zw"),
        ps13(P3, "d = s0 * s1 + s2").shown("tex t0\nmad r0, t0, v0, c0"),
        ps14(Q3, "d = s0 * s1 + s2").shown("texld r0, t0\nmad r0.rgb, r0, v0, c0"),
    ]),
    op(Mul, ("mul", 0x05), "multiplication", &[Mad],
        "Multiplies two registers component by component. A product with a factor of 0 is 0, even against infinity.", &[
        vs(V2, "d = s0 * s1").shown("m4x4 oPos, v0, c0\nmul oD0, v5, c4"),
        ps13(P2, "d = s0 * s1").shown("tex t0\nmul r0, t0, v0"),
        ps14(Q2, "d = s0 * s1").shown("texld r0, t0\nmul r0.rgb, r0, v0"),
    ]),
    op(Dp3, ("dp3", 0x08), "dot product of three components", &[Dp4, M3x3, TexDp3],
        "Multiplies the first three components of two registers, adds the products from left to right and writes the sum to \
         every component of the write mask. A negative sum stays negative; _sat in pixel shaders and max in vertex shaders \
         clamp it.", &[
        vs(&[fixed(VS_IN, XYZ), fixed(VS_IN, XYZ)], "d = s0.x * s1.x + s0.y * s1.y + s0.z * s1.z")
            .shown("m4x4 oPos, v0, c0\ndp3 r0.x, v3, c4\nmax oD0, r0.x, c5.x"),
        ps13(&[fixed(RTVC, XYZ), fixed(RTVC, XYZ)], DOT3).to(RT, MaskSet::of(&[XYZW, XYZ])).pairs(Pairing::Color)
            .noted("Without a write mask it writes the sum to alpha, too. It runs in the colour pipe: .a alone is no mask of it.")
            .shown("tex t0\ndp3_sat r0, t0_bx2, v0_bx2"),
        ps14(&[fixed(RVC, XYZ), fixed(RVC, XYZ)], DOT3).pairs(Pairing::Color)
            .noted("Without a write mask it writes the sum to alpha, too.")
            .shown("texld r0, t0\ndp3_sat r0.rgb, r0_bx2, c0"),
    ]),
    op(Dp4, ("dp4", 0x09), "dot product of four components", &[Dp3, M4x4],
        "Multiplies two registers component by component, adds the products from left to right and writes the sum to every \
         component of the write mask.", &[
        vs(&[fixed(VS_IN, XYZW), fixed(VS_IN, XYZW)], "d = s0.x * s1.x + s0.y * s1.y + s0.z * s1.z + s0.w * s1.w")
            .shown("dp4 oPos.x, v0, c0\ndp4 oPos.y, v0, c1\ndp4 oPos.z, v0, c2\ndp4 oPos.w, v0, c3"),
        ps13(&[fixed(RTVC, XYZW), fixed(RTVC, XYZW)], DOT4).of(PS12).costs(2, 0).at_most(4).pairs(Pairing::Never)
            .shown("tex t0\ndp4 r0, t0, c0"),
        ps14(&[fixed(RVC, XYZW), fixed(RVC, XYZW)], DOT4).pairs(Pairing::Never)
            .shown("texld r0, t0\ndp4 r0.a, r0, c0"),
    ]),
    op(Lrp, ("lrp", 0x12), "linear interpolation", &[Mad, Cnd, Cmp],
        "Mixes the second and the third source; the first is the weight of the second. At 1 the result is exactly the second \
         source, at 0 exactly the third. A weight outside of 0 to 1 goes on beyond them along the same line.", &[
        ps13(P3, INTERPOLATED).shown("tex t0\nlrp r0, v0.a, t0, c0"),
        ps14(Q3, INTERPOLATED).shown("texld r0, t0\ntexld r1, t1\nlrp r0.rgb, c0.r, r0, r1"),
    ]),
    op(Cnd, ("cnd", 0x50), "choice by comparison with one half", &[Cmp, Lrp],
        "Takes the second source where the condition is greater than 0.5, else the third. Exactly 0.5 and NaN take the third.", &[
        ps13(&[fixed(R, W), masked(RTVC), masked(RTVC)], "d = r0.a > 0.5 ? s1 : s2")
            .noted("The condition is r0.a and nothing else, one number for all components. In a pair it is the r0.a from before \
                    the pair.")
            .shown("tex t0\nmov r0, t0\ncnd r0, r0.a, c0, v0"),
        ps14(Q3, "d = s0 > 0.5 ? s1 : s2")
            .noted("Each component has its own condition.")
            .shown("texld r0, t0\ncnd r0.rgb, r0.a, c0, c1"),
    ]),
    op(Def, ("def", 0x51), "definition of a constant", &[Dcl],
        "Gives a constant register four numbers before anything runs. It stands before all instructions that run. Of two \
         definitions of a register the last holds.", &[
        form(VS, Class::Declaration, C, MaskSet::FULL, &[], "d = (x, y, z, w)")
            .noted("Direct3D 8 gave it back beside the tokens, as D3DVSD_CONST of the vertex declaration: it loads the register \
                    when the shader is set, and what the program sets later replaces it.")
            .shown("def c4, 0, 0.5, 1, 2\nm4x4 oPos, v0, c0\nmul oD0, v5, c4.y"),
        form(PS, Class::Declaration, C, MaskSet::FULL, &[], "d = (x, y, z, w)")
            .noted("Numbers outside of -1 to 1 are clamped when they are read.")
            .shown("def c0, 1, 0.5, 0, 1\nmul r0, v0, c0"),
    ]),
    op(Dcl, ("dcl", 0x1F), "declaration of a vertex element", &[Def],
        "Says which element of a vertex feeds an input register: by its usage, dcl_position, dcl_texcoord3 and so on, where the \
         number behind the usage is its index. It is of Direct3D 9; Direct3D 8 passed a vertex declaration beside the shader. A \
         listing with dcl binds its inputs by usage, one without by number. Its mask has no effect.", &[
        form(VS, Class::Declaration, FileSet::of(&[RegisterFile::Input]), MaskSet::ANY, &[], "d = element of the vertex with this usage")
            .shown("dcl_position v0\ndcl_texcoord v7\nm4x4 oPos, v0, c0\nmov oT0, v7"),
    ]),
    op(Cmp, ("cmp", 0x58), "choice by sign", &[Cnd, Lrp],
        "Takes, component by component, the second source where the first is 0 or greater, else the third. -0 counts as 0; NaN \
         takes the third.", &[
        ps13(P3, "d = s0 >= 0 ? s1 : s2").of(PS12).costs(2, 0).at_most(3)
            .noted("It cannot write a register that it reads.")
            .shown("tex t0\nsub r1, t0, c0\ncmp r0, r1, t0, v0"),
        ps14(Q3, "d = s0 >= 0 ? s1 : s2")
            .shown("texld r0, t0\ncmp r0.rgb, r0_bias, c0, c1"),
    ]),
    op(Bem, ("bem", 0x59), "bump mapping of coordinates", &[TexBem, TexLd, Phase],
        "Moves texture coordinates by a vector that goes through the bump matrix of the stage with the number of the destination \
         (D3DTSS_BUMPENVMAT00 to D3DTSS_BUMPENVMAT11). The texld behind phase then samples there. It stands before phase.", &[
        form(PS14, Class::Arithmetic, R, MaskSet::of(&[XY]), &[fixed(RC, XY), fixed(RC, XY)],
            "d.r = s0.r + M00 * s1.r + M10 * s1.g; d.g = s0.g + M01 * s1.r + M11 * s1.g").costs(2, 0).at_most(1)
            .shown("texld r0, t0\ntexcrd r1.rgb, t1\nbem r1.rg, r1, r0\nphase\ntexld r1, r1\nmov r0, r1"),
    ]),
    op(Phase, ("phase", 0xFFFD), "end of the first phase", &[TexLd, Bem],
        "Divides a shader into two phases with budgets of their own, each with its texture instructions in front. Behind it texld \
         reads what the first phase computed, and v0 and v1 can be read. The alpha of every r# is lost there; red, green and blue \
         stay. A shader without it has only the second phase.", &[
        bare(PS14, Class::Phase, "ends the first phase").at_most(1)
            .shown("texld r0, t0\nmad r1.rgb, r0, c0, c1\nphase\ntexld r1, r1\nmul r0, r1, v0"),
    ]),
];

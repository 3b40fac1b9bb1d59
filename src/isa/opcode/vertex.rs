//! The rows of the arithmetic that only vertex shaders have.

use super::vocabulary::*;
use super::{Opcode, OpcodeRow};
use crate::isa::operand::{MaskSet, WriteMask};
use Opcode::*;

const ROW_DP4: &str = "d.i = dp4(s0, row i of s1)";
const ROW_DP3: &str = "d.i = dp3(s0, row i of s1)";

#[rustfmt::skip]
pub(super) static ROWS: [OpcodeRow; 18] = [
    op(Rcp, ("rcp", 0x06), "reciprocal", &[Rsq],
        "Divides 1 by one component and writes the result to every component of the write mask. The component is the one that the \
         swizzle selects, .w where none is written. Of 0 and -0 it is the largest number, 3.4e38, so that 0 * rcp(0) stays 0; of \
         an infinity 0.", &[
        vs(VSCALAR, "d = 1 / s0.w")
            .shown("m4x4 r0, v0, c0\nmov oPos, r0\nrcp r1.x, r0.w\nmul oT0.xy, r0, r1.x"),
    ]),
    op(Rsq, ("rsq", 0x07), "reciprocal of the square root", &[Rcp, Dp3],
        "Divides 1 by the square root of the absolute value of one component: with dp3 and mul it makes a vector one long. The \
         component is the one that the swizzle selects, .w where none is written. Of 0 it is the largest number, 3.4e38.", &[
        vs(VSCALAR, "d = 1 / sqrt(abs(s0.w))")
            .shown("m4x4 oPos, v0, c0\ndp3 r0.w, v3, v3\nrsq r0.w, r0.w\nmul oT0.xyz, v3, r0.w"),
    ]),
    op(Min, ("min", 0x0A), "the smaller of two", &[Max, Slt],
        "Takes the smaller of two numbers, component by component; the second where one is NaN.", &[
        vs(V2, "d = s0 < s1 ? s0 : s1")
            .shown("m4x4 oPos, v0, c0\nmin oD0, v5, c4"),
    ]),
    op(Max, ("max", 0x0B), "the greater of two", &[Min, Sge],
        "Takes the greater of two numbers, component by component; the second where one is NaN. With 0 it clamps a dp3 of light.", &[
        vs(V2, "d = s0 >= s1 ? s0 : s1")
            .shown("m4x4 oPos, v0, c0\ndp3 r0.x, v3, c4\nmax oD0, r0.x, c5.x"),
    ]),
    op(Slt, ("slt", 0x0C), "set if less than", &[Sge, Min],
        "Writes 1 where the first source is less than the second and 0 where it is not, component by component; 0 where one is NaN.", &[
        vs(V2, "d = s0 < s1 ? 1 : 0")
            .shown("m4x4 oPos, v0, c0\nslt r0, v5, c4\nmul oD0, r0, c5"),
    ]),
    op(Sge, ("sge", 0x0D), "set if greater or equal", &[Slt, Max],
        "Writes 1 where the first source is greater than the second or equal and 0 where it is less, component by component; 0 where \
         one is NaN.", &[
        vs(V2, "d = s0 >= s1 ? 1 : 0")
            .shown("m4x4 oPos, v0, c0\nsge r0, v5, c4\nmul oD0, r0, c5"),
    ]),
    op(Exp, ("exp", 0x0E), "power of two, exact", &[ExpP, Log],
        "Raises 2 to one component, with 21 bits at least, and writes the result to every component of the write mask. The \
         component is the one that the swizzle selects, .w where none is written. It was a macro; expp takes a tenth of its slots.", &[
        vs(VSCALAR, "d = 2 ^ s0.w").costs(10, 0)
            .shown("m4x4 r0, v0, c0\nmov oPos, r0\nmul r1.x, r0.w, c4.x\nexp oFog.x, r1.x"),
    ]),
    op(Log, ("log", 0x0F), "logarithm to the base of two, exact", &[LogP, Exp],
        "Takes the logarithm of the absolute value of one component, with 21 bits at least. The component is the one that the swizzle \
         selects, .w where none is written. Of 0 it is the smallest number, -3.4e38. It was a macro; logp takes a tenth of its slots.", &[
        vs(VSCALAR, "d = log2(abs(s0.w))").costs(10, 0)
            .shown("m4x4 oPos, v0, c0\nlog r0.x, v1.x\nmul r0.x, r0.x, c4.x\nexp oFog.x, r0.x"),
    ]),
    op(Lit, ("lit", 0x10), "lighting coefficients", &[Dst, Dp3],
        "Makes the factors of diffuse and specular light: x of the source is the cosine between normal and light, y that between \
         normal and half vector, w the power of the highlight. z of the source is not read. y and z of the result are 0 where the \
         light is behind, z also where the half vector is.", &[
        vs(&[fixed(VS_IN, WriteMask::from_bits(0b1011))],
            "d = (1, max(s0.x, 0), s0.x > 0 && s0.y > 0 ? s0.y ^ clamp(s0.w, -127.9961, 127.9961) : 0, 1)")
            .shown("m4x4 oPos, v0, c0\ndp3 r0.x, v3, c4\ndp3 r0.y, v3, c5\nmov r0.w, c6.x\nlit r1, r0\nmul oD0, r1.y, c7\nmul oD1, r1.z, c8"),
    ]),
    op(Dst, ("dst", 0x11), "distance vector", &[Lit, Rcp],
        "Makes (1, d, d^2, 1/d) of d^2 in the first source and 1/d in the second, for lights that grow weaker with the distance: a \
         dp3 of it with three factors is the divisor of the attenuation.", &[
        vs(&[fixed(VS_IN, WriteMask::from_bits(0b0110)), fixed(VS_IN, WriteMask::from_bits(0b1010))],
            "d = (1, s0.y * s1.y, s0.z, s1.w)")
            .shown("m4x4 oPos, v0, c0\nsub r0.xyz, c4, v0\ndp3 r0.w, r0, r0\nrsq r1.w, r0.w\ndst r2, r0.w, r1.w\ndp3 r2.w, r2, c5\nrcp oD0, r2.w"),
    ]),
    op(Frc, ("frc", 0x13), "fraction", &[ExpP],
        "Takes what is left of a number above the next whole number below: of -0.25 it is 0.75. Of an infinity it is NaN. It was a \
         macro; y of expp is the fraction of one component for one slot.", &[
        vs(V1, "d = s0 - floor(s0)").costs(3, 0).to(VS_OUT, MaskSet::of(&[WriteMask::Y, XY]))
            .shown("m4x4 oPos, v0, c0\nfrc oT0.xy, v7"),
    ]),
    op(M4x4, ("m4x4", 0x14), "product with a matrix of 4 rows of 4", &[Dp4, M4x3, M3x4],
        "Writes to each component the dp4 of the first source with one of four registers that follow each other; the second source \
         names the first of them. It stands for four dp4. All rows are computed before one is written.", &[
        vs_matrix(4, XYZW, &[fixed(VS_IN, XYZW), matrix(XYZW)], ROW_DP4)
            .shown("m4x4 oPos, v0, c0"),
    ]),
    op(M4x3, ("m4x3", 0x15), "product with a matrix of 3 rows of 4", &[Dp4, M4x4, M3x3],
        "Writes to each of x, y and z the dp4 of the first source with one of three registers that follow each other; the second \
         source names the first of them. It stands for three dp4. All rows are computed before one is written.", &[
        vs_matrix(3, XYZ, &[fixed(VS_IN, XYZW), matrix(XYZW)], ROW_DP4)
            .shown("m4x3 r0.xyz, v0, c4\nmov r0.w, c8.x\nm4x4 oPos, r0, c0"),
    ]),
    op(M3x4, ("m3x4", 0x16), "product with a matrix of 4 rows of 3", &[Dp3, M3x3, M4x4],
        "Writes to each component the dp3 of the first source with one of four registers that follow each other; the second source \
         names the first of them. It stands for four dp3. All rows are computed before one is written.", &[
        vs_matrix(4, XYZW, &[fixed(VS_IN, XYZ), matrix(XYZ)], ROW_DP3)
            .shown("m3x4 r0, v0, c0\nadd oPos, r0, c4"),
    ]),
    op(M3x3, ("m3x3", 0x17), "product with a matrix of 3 rows of 3", &[Dp3, M3x2, M4x3],
        "Writes to each of x, y and z the dp3 of the first source with one of three registers that follow each other; the second \
         source names the first of them: the way to turn a normal. It stands for three dp3. All rows are computed before one is \
         written.", &[
        vs_matrix(3, XYZ, &[fixed(VS_IN, XYZ), matrix(XYZ)], ROW_DP3)
            .shown("m4x4 oPos, v0, c0\nm3x3 oT0.xyz, v3, c4"),
    ]),
    op(M3x2, ("m3x2", 0x18), "product with a matrix of 2 rows of 3", &[Dp3, M3x3],
        "Writes to x and y the dp3 of the first source with one of two registers that follow each other; the second source names the \
         first of them. It stands for two dp3. Both rows are computed before one is written.", &[
        vs_matrix(2, XY, &[fixed(VS_IN, XYZ), matrix(XYZ)], ROW_DP3)
            .shown("m4x4 oPos, v0, c0\nm3x2 oT0.xy, v7, c4"),
    ]),
    op(ExpP, ("expp", 0x4E), "power of two, in parts", &[Exp, LogP, Frc],
        "Takes one component apart: x is 2 to its whole part, y its fraction, z 2 to the power of it with 10 bits at least, w 1. \
         The component is the one that the swizzle selects, .w where none is written.", &[
        vs(VSCALAR, "d = (2 ^ floor(s0.w), s0.w - floor(s0.w), 2 ^ s0.w, 1)")
            .noted("z loses its eight lowest bits here, as the documents compute it.")
            .shown("m4x4 oPos, v0, c0\nexpp r0.z, v1.x\nmov oFog.x, r0.z"),
    ]),
    op(LogP, ("logp", 0x4F), "logarithm to the base of two, in parts", &[Log, ExpP],
        "Takes the absolute value of one component apart: x is its exponent, y its mantissa from 1 to 2, z its logarithm with 10 bits \
         at least, w 1. Of 0 it gives (-3.4e38, 1, -3.4e38, 1). The component is the one that the swizzle selects, .w where none is \
         written. The documents of Direct3D 9 have the logarithm in all \
         components.", &[
        vs(VSCALAR, "d = (floor(log2(abs(s0.w))), abs(s0.w) / 2 ^ floor(log2(abs(s0.w))), log2(abs(s0.w)), 1)")
            .noted("z loses its eight lowest bits here, as the documents compute it.")
            .shown("m4x4 oPos, v0, c0\nlogp r0.z, v1.x\nmul oFog.x, r0.z, c4.x"),
    ]),
];

//! The rows of the texture instructions of pixel shaders.

use super::vocabulary::*;
use super::{Class, ModifierRule, Opcode, OpcodeRow, Slots};
use crate::isa::operand::{MaskSet, WriteMask};
use crate::isa::version::VersionSet;
use Opcode::*;

#[rustfmt::skip]
pub(super) static ROWS: [OpcodeRow; 21] = [
    op(TexCoord, ("texcoord", 0x40), "texture coordinates as a colour", &[TexCrd, Tex],
        "Takes the texture coordinates with the number of the destination as a colour, clamped to 0 to 1; alpha is 1. What the vertex \
         does not have of them is 0. Nothing is sampled.", &[
        tex13(&[], "t(m) = (clamp(TC[m].uvw, 0, 1), 1)")
            .shown("texcoord t0\nmov r0, t0"),
    ]),
    op(TexCrd, ("texcrd", 0x40), "texture coordinates into a register", &[TexCoord, TexLd],
        "Copies texture coordinates into a working register, without clamping them to 0 to 1. What it does not write is undefined \
         behind it: alpha, and with _dw blue as well.", &[
        form(PS14, Class::Texture, R, MaskSet::of(&[XYZ, XY]), &[coordinates(T)], "d = s0")
            .noted("Its coordinates are t#.xyz, t#.xyw or, divided by the fourth, t#_dw.xyw; the last goes with the mask .rg.")
            .shown("texcrd r0.rgb, t0\nmov r0.a, c0.r"),
    ]),
    op(TexKill, ("texkill", 0x41), "discarding of pixels", &[Tex, TexLd],
        "Discards the pixel if one of three numbers is less than 0; -0 is not. It writes nothing: its operand is only looked at, \
         though it stands where a destination does.", &[
        tex13(&[], "discards the pixel if TC[m].u < 0 or TC[m].v < 0 or TC[m].w < 0").only_looks()
            .noted("It looks at the texture coordinates with the number of the register, never at what was sampled with them, and what \
                    t# holds behind it is not defined. The texture of the stage has no part in it.")
            .shown("texkill t0\nmov r0, v0"),
        form(PS14, Class::Texture, RT, MaskSet::FULL, &[], "discards the pixel if d.r < 0 or d.g < 0 or d.b < 0").only_looks()
            .noted("Of t# it looks at the texture coordinates, of r#, behind phase, at what was computed.")
            .shown("texkill t1\ntexld r0, t0\nmov r0.a, c0.r"),
    ]),
    op(Tex, ("tex", 0x42), "sampling of a texture", &[TexLd, TexCoord],
        "Samples the texture of the stage with the number of the destination at the texture coordinates of the same number. They are \
         divided by the last one where D3DTTFF_PROJECTED is set. A stage without texture gives opaque black.", &[
        tex13(&[], "t(m) = S[m](TC[m])")
            .shown("tex t0\nmul r0, t0, v0"),
    ]),
    op(TexLd, ("texld", 0x42), "sampling of a texture", &[Tex, TexCrd, Phase],
        "Samples the texture of the stage with the number of the destination at the coordinates in its source: texture coordinates of \
         any number, or behind phase a working register whose xyz was written before phase, which makes a dependent read. A stage \
         without texture gives opaque black. D3DTTFF_PROJECTED has no effect.", &[
        form(PS14, Class::Texture, R, MaskSet::FULL, &[coordinates(RT)], "d = S[m](s0)")
            .noted("Its coordinates are t#.xyz, t#.xyw, divided t#_dw.xyw, r#.xyz, or divided r#_dz.xyz. One t# is read with the same \
                    three components everywhere.")
            .shown("texld r0, t0\nmul r1.rgb, r0, c0\nphase\ntexld r1, r1\nmov r0, r1"),
    ]),
    op(TexBem, ("texbem", 0x43), "bump mapping", &[TexBeml, Bem],
        "Samples at texture coordinates moved by a vector: red and green of the source, as signed numbers, go through the bump matrix \
         of the stage that is sampled (D3DTSS_BUMPENVMAT00 to D3DTSS_BUMPENVMAT11). M01 takes red to v, M10 green to u. With \
         D3DTTFF_PROJECTED the coordinates are divided before they are moved. Only texbem and texbeml may read the source again.", &[
        tex13(&[texel(XY, VersionSet::NONE)],
            "t(m) = S[m](TC[m].u + M00 * s0.r + M10 * s0.g, TC[m].v + M01 * s0.r + M11 * s0.g)")
            .shown("tex t0\ntexbem t1, t0\nmov r0, t1"),
    ]),
    op(TexBeml, ("texbeml", 0x44), "bump mapping with luminance", &[TexBem, Bem],
        "Does what texbem does and multiplies the colour by blue of the source, the luminance of formats such as L6V5U5, scaled and \
         moved by D3DTSS_BUMPENVLSCALE (LS) and D3DTSS_BUMPENVLOFFSET (LO) of the stage that is sampled. Alpha is multiplied, too.", &[
        tex13(&[texel(XYZ, VersionSet::NONE)],
            "t(m) = S[m](TC[m].u + M00 * s0.r + M10 * s0.g, TC[m].v + M01 * s0.r + M11 * s0.g) * (s0.b * LS + LO)").costs(1, 1)
            .noted("Beside its texture slot it takes an arithmetic one.")
            .shown("tex t0\ntexbeml t1, t0\nmov r0, t1"),
    ]),
    op(TexReg2Ar, ("texreg2ar", 0x45), "sampling at alpha and red", &[TexReg2Gb, TexReg2Rgb],
        "Samples at the alpha and the red of another texture: a lookup in a table by two of its channels.", &[
        tex13(&[texel(WriteMask::from_bits(0b1001), VersionSet::NONE)], "t(m) = S[m](s0.a, s0.r)")
            .shown("tex t0\ntexreg2ar t1, t0\nmov r0, t1"),
    ]),
    op(TexReg2Gb, ("texreg2gb", 0x46), "sampling at green and blue", &[TexReg2Ar, TexReg2Rgb],
        "Samples at the green and the blue of another texture: a lookup in a table by two of its channels.", &[
        tex13(&[texel(WriteMask::from_bits(0b0110), VersionSet::NONE)], "t(m) = S[m](s0.g, s0.b)")
            .shown("tex t0\ntexreg2gb t1, t0\nmov r0, t1"),
    ]),
    op(TexReg2Rgb, ("texreg2rgb", 0x52), "sampling at red, green and blue", &[TexReg2Ar, TexReg2Gb],
        "Samples at the colour of another texture: in a cube or a volume all three numbers count, in a flat texture the first two.", &[
        tex13(&[texel(XYZ, PS12)], "t(m) = S[m](s0.r, s0.g, s0.b)").of(PS12)
            .shown("tex t0\ntexreg2rgb t1, t0\nmov r0, t1"),
    ]),
    op(TexM3x2Pad, ("texm3x2pad", 0x47), "first row of a matrix of 2 rows", &[TexM3x2Tex, TexM3x2Depth],
        "Computes the first row of a product with a matrix of two rows: a dot product of the texture coordinates with the colour of a \
         texture before it. texm3x2tex or texm3x2depth of the next stage follows at once. Its stage samples nothing, and its \
         destination cannot be read.", &[
        tex13(ROW, "row 0 = dp3(TC[m], s0)")
            .shown("tex t0\ntexm3x2pad t1, t0_bx2\ntexm3x2tex t2, t0_bx2\nmov r0, t2"),
    ]),
    op(TexM3x2Tex, ("texm3x2tex", 0x48), "sampling at a product with a matrix of 2 rows", &[TexM3x2Pad, TexM3x2Depth, TexM3x3Tex],
        "Computes the second row, a dot product as in texm3x2pad before it, and samples at both.", &[
        tex13(ROW, "t(m) = S[m](row 0, dp3(TC[m], s0))")
            .shown("tex t0\ntexm3x2pad t1, t0_bx2\ntexm3x2tex t2, t0_bx2\nmov r0, t2"),
    ]),
    op(TexM3x2Depth, ("texm3x2depth", 0x54), "depth from a product with a matrix of 2 rows", &[TexM3x2Pad, TexDepth],
        "Computes the second row, a dot product as in texm3x2pad before it, and replaces the depth of the pixel by the first row \
         divided by the second, clamped to 0 to 1. A second row of 0 gives 1. Nothing is sampled, and its destination cannot be read.", &[
        tex13(&[texel(XYZ, PS12)], "z = row 0; w = dp3(TC[m], s0); depth = w == 0 ? 1 : clamp(z / w, 0, 1)").of(VersionSet::PS_1_3)
            .shown("tex t0\ntexm3x2pad t1, t0\ntexm3x2depth t2, t0\nmov r0, v0"),
    ]),
    op(TexM3x3Pad, ("texm3x3pad", 0x49), "first or second row of a matrix of 3 rows", &[TexM3x3Tex, TexM3x3Spec, TexM3x3VSpec, TexM3x3],
        "Computes a row of a product with a matrix of three rows: a dot product of the texture coordinates with the colour of a texture \
         before it. It stands twice, in stages that follow each other, and the instruction for the third row comes behind at once. \
         Its stage samples nothing, and its destination cannot be read.", &[
        tex13(ROW, "row 0 or row 1 = dp3(TC[m], s0)")
            .shown("tex t0\ntexm3x3pad t1, t0_bx2\ntexm3x3pad t2, t0_bx2\ntexm3x3tex t3, t0_bx2\nmov r0, t3"),
    ]),
    op(TexM3x3Tex, ("texm3x3tex", 0x4A), "sampling at a product with a matrix of 3 rows", &[TexM3x3Pad, TexM3x3Spec, TexM3x3VSpec, TexM3x2Tex],
        "Computes the third row, a dot product as in the two texm3x3pad before it, and samples a cube or a volume at all three: with a \
         normal map and the vectors of the surface as texture coordinates, at the normal in the world.", &[
        tex13(ROW, "t(m) = S[m](row 0, row 1, dp3(TC[m], s0))")
            .shown("tex t0\ntexm3x3pad t1, t0_bx2\ntexm3x3pad t2, t0_bx2\ntexm3x3tex t3, t0_bx2\nmov r0, t3"),
    ]),
    op(TexM3x3Spec, ("texm3x3spec", 0x4C), "sampling at a reflection, with an eye that stays", &[TexM3x3VSpec, TexM3x3Tex, TexM3x3Pad],
        "Computes the third row, so that the rows are a normal, reflects the vector to the eye at it and samples a cube there. The vector \
         is the same for all pixels, a constant, and points from the surface to the eye. The normal need not be one long; one of no \
         length gives the vector negated.", &[
        tex13(&[texel(XYZ, PS13), source(C, Slots::Fixed(XYZ), ModifierRule::Plain)],
            "N = (row 0, row 1, dp3(TC[m], s0)); t(m) = S[m](2 * dot(N, s1) / dot(N, N) * N - s1)")
            .shown("tex t0\ntexm3x3pad t1, t0_bx2\ntexm3x3pad t2, t0_bx2\ntexm3x3spec t3, t0_bx2, c0\nmov r0, t3"),
    ]),
    op(TexM3x3VSpec, ("texm3x3vspec", 0x4D), "sampling at a reflection, with an eye for each pixel", &[TexM3x3Spec, TexM3x3Tex, TexM3x3Pad],
        "Computes the third row, so that the rows are a normal, reflects the vector to the eye at it and samples a cube there. The vector \
         stands in the fourth components of the three texture coordinates and points from the surface to the eye. The normal need not \
         be one long; one of no length gives the vector negated.", &[
        tex13(ROW,
            "N = (row 0, row 1, dp3(TC[m], s0)); E = (TC[m-2].q, TC[m-1].q, TC[m].q); t(m) = S[m](2 * dot(N, E) / dot(N, N) * N - E)")
            .shown("tex t0\ntexm3x3pad t1, t0_bx2\ntexm3x3pad t2, t0_bx2\ntexm3x3vspec t3, t0_bx2\nmov r0, t3"),
    ]),
    op(TexM3x3, ("texm3x3", 0x56), "product with a matrix of 3 rows", &[TexM3x3Pad, TexM3x3Tex, TexDp3],
        "Computes the third row, a dot product as in the two texm3x3pad before it, and leaves the product as a colour; alpha is 1. \
         Nothing is sampled and nothing clamped.", &[
        tex13(&[texel(XYZ, PS12)], "t(m) = (row 0, row 1, dp3(TC[m], s0), 1)").of(PS12)
            .shown("tex t0\ntexm3x3pad t1, t0_bx2\ntexm3x3pad t2, t0_bx2\ntexm3x3 t3, t0_bx2\nmov r0, t3"),
    ]),
    op(TexDp3, ("texdp3", 0x55), "dot product with texture coordinates", &[TexDp3Tex, Dp3, TexM3x3],
        "Takes the dot product of the texture coordinates with the colour of another texture, in all four components. Nothing is \
         sampled.", &[
        tex13(&[texel(XYZ, PS12)], "t(m) = dp3(TC[m], s0)").of(PS12)
            .shown("tex t0\ntexdp3 t1, t0_bx2\nmov r0, t1"),
    ]),
    op(TexDp3Tex, ("texdp3tex", 0x53), "sampling at a dot product", &[TexDp3, TexM3x2Tex],
        "Takes the dot product of the texture coordinates with the colour of another texture and samples there, with 0 for the other \
         coordinates: a lookup in a table of one row.", &[
        tex13(&[texel(XYZ, PS12)], "t(m) = S[m](dp3(TC[m], s0), 0, 0)").of(PS12)
            .shown("tex t0\ntexdp3tex t1, t0_bx2\nmov r0, t1"),
    ]),
    op(TexDepth, ("texdepth", 0x57), "depth from a register", &[TexM3x2Depth, Phase],
        "Replaces the depth of the pixel by the red of r5 divided by its green, clamped to 0 to 1; a green of 0 gives 1. It stands behind \
         phase, and r5 cannot be read behind it.", &[
        form(PS14, Class::Texture, R, MaskSet::FULL, &[], "depth = d.g == 0 ? 1 : clamp(d.r / d.g, 0, 1)").only_looks()
            .shown("texld r0, t0\ntexcrd r5.rgb, t1\nphase\ntexdepth r5\nmov r0.a, c0.r"),
    ]),
];

//! Opcodes: one row each, with one form for every group of versions in which it looks the same.

use super::operand::{MaskSet, WriteMask};
use super::register::{FileSet, RegisterFile};
use super::version::{Version, VersionSet};

/// An instruction. `tex` and `texld`, `texcoord` and `texcrd` share a token number but not a form.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[allow(
    missing_docs,
    reason = "each member is the mnemonic of its row, which says what it does"
)]
pub enum Opcode {
    Nop,
    Mov,
    Add,
    Sub,
    Mad,
    Mul,
    Rcp,
    Rsq,
    Dp3,
    Dp4,
    Min,
    Max,
    Slt,
    Sge,
    Exp,
    Log,
    Lit,
    Dst,
    Lrp,
    Frc,
    M4x4,
    M4x3,
    M3x4,
    M3x3,
    M3x2,
    Dcl,
    TexCoord,
    TexCrd,
    TexKill,
    Tex,
    TexLd,
    TexBem,
    TexBeml,
    TexReg2Ar,
    TexReg2Gb,
    TexM3x2Pad,
    TexM3x2Tex,
    TexM3x3Pad,
    TexM3x3Tex,
    TexM3x3Spec,
    TexM3x3VSpec,
    ExpP,
    LogP,
    Cnd,
    Def,
    TexReg2Rgb,
    TexDp3Tex,
    TexM3x2Depth,
    TexDp3,
    TexM3x3,
    TexDepth,
    Cmp,
    Bem,
    Phase,
}

/// What kind of instruction it is; budgets, order and modifiers depend on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// Computes from registers. Takes result modifiers in pixel shaders. `nop` is one.
    Arithmetic,
    /// Addresses a texture or works on texture coordinates.
    Texture,
    /// `phase`.
    Phase,
    /// `def` and `dcl`: no instruction at run time.
    Declaration,
}

/// Which half of a co-issued pair an instruction may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pairing {
    /// Neither.
    Never,
    /// The one that writes colour.
    Color,
    /// Either.
    Either,
}

/// The destination of an instruction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DestinationShape {
    /// Files that it may name.
    pub files: FileSet,
    /// Masks that the documents allow.
    pub masks: MaskSet,
    /// False for `texkill`, whose operand stands where a destination does but is only looked at.
    pub written: bool,
}

/// Which slots of a source an instruction uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slots {
    /// Those that the write mask has: the instruction works component by component.
    Masked,
    /// Always these.
    Fixed(WriteMask),
}

/// Which source modifiers an operand takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ModifierRule {
    /// Those that arithmetic has in the version.
    Arithmetic,
    /// `_bx2` in these versions, nothing else.
    Bx2(VersionSet),
    /// Those that divide coordinates.
    Coordinates,
    /// None, and no swizzle either: the operand names the first row of a matrix.
    Matrix,
    /// None.
    Plain,
}

/// One source of an instruction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SourceShape {
    /// Files that it may name.
    pub files: FileSet,
    /// Slots that are used.
    pub slots: Slots,
    /// Modifiers that it takes.
    pub modifiers: ModifierRule,
}

/// An instruction as one group of versions has it.
#[derive(Debug)]
pub struct Form {
    /// The versions.
    pub versions: VersionSet,
    /// Kind of instruction.
    pub class: Class,
    /// Slots it takes of the arithmetic budget (of the whole budget in vertex shaders).
    pub arithmetic_slots: u32,
    /// Slots it takes of the texture budget.
    pub texture_slots: u32,
    /// The destination, if it has one.
    pub destination: Option<DestinationShape>,
    /// The sources in order.
    pub sources: &'static [SourceShape],
    /// Which half of a pair it may be.
    pub pairing: Pairing,
    /// How often a shader may hold it, where that is limited.
    pub most: Option<u32>,
    /// Rows of the matrix it multiplies by; 0 if it is no matrix macro.
    pub rows: u32,
    /// What it computes, in the notation of [`crate::isa`]: `d` destination, `s0` … sources.
    pub formula: &'static str,
}

/// One opcode.
#[derive(Debug)]
pub struct OpcodeRow {
    /// The opcode that this row describes.
    pub opcode: Opcode,
    /// Its mnemonic, lower case.
    pub mnemonic: &'static str,
    /// Bits 15:0 of its instruction token.
    pub token: u16,
    /// Its forms; no version is in two of them.
    pub forms: &'static [Form],
}

impl Opcode {
    /// Every opcode.
    pub fn all() -> impl Iterator<Item = Opcode> {
        OPCODES.iter().map(|row| row.opcode)
    }

    /// The row of this opcode.
    pub fn row(self) -> &'static OpcodeRow {
        &OPCODES[self as usize]
    }

    /// The mnemonic, lower case.
    pub fn mnemonic(self) -> &'static str {
        self.row().mnemonic
    }

    /// The form in this version, if the version has the instruction.
    pub fn form(self, version: Version) -> Option<&'static Form> {
        self.row()
            .forms
            .iter()
            .find(|form| form.versions.contains(version))
    }

    /// The versions that have the instruction.
    pub fn versions(self) -> VersionSet {
        self.row()
            .forms
            .iter()
            .fold(VersionSet::NONE, |set, form| set.and(form.versions))
    }

    /// The opcode with this token number in this version.
    pub fn from_token(token: u16, version: Version) -> Option<Self> {
        OPCODES
            .iter()
            .filter(|row| row.token == token)
            .map(|row| row.opcode)
            .find(|opcode| opcode.form(version).is_some())
    }

    /// The opcode that this token number stands for in a shader of this version, whether the version has it or not:
    /// a number that only one opcode has can mean nothing else.
    pub fn meant_by(token: u16, version: Version) -> Option<Self> {
        Self::from_token(token, version).or_else(|| {
            let mut all = OPCODES.iter().filter(|row| row.token == token);
            let first = all.next().filter(|_| all.next().is_none());
            first.map(|only| only.opcode)
        })
    }
}

impl Form {
    /// The slots of source `i` that are used when the destination has this mask.
    pub fn slots_read(&self, i: usize, mask: WriteMask) -> WriteMask {
        match self.sources.get(i).map(|s| s.slots) {
            Some(Slots::Masked) => mask,
            Some(Slots::Fixed(slots)) => slots,
            None => WriteMask::NONE,
        }
    }
}

// --- the vocabulary of the rows ---

use RegisterFile::{Addr, AttrOut, Const, Input, RastOut, Temp, TexCrdOut, Texture};

const XY: WriteMask = WriteMask::XY;
const XYZ: WriteMask = WriteMask::XYZ;
const XYZW: WriteMask = WriteMask::ALL;
const W: WriteMask = WriteMask::W;
const VS: VersionSet = VersionSet::VS;
const PS: VersionSet = VersionSet::PS;
const PS13: VersionSet = VersionSet::PS_1_0_TO_1_3;
const PS12: VersionSet = VersionSet::PS_1_2_TO_1_3;
const PS14: VersionSet = VersionSet::PS_1_4;

const VS_OUT: FileSet = FileSet::of(&[Temp, RastOut, AttrOut, TexCrdOut]);
const VS_OUT_A0: FileSet = FileSet::of(&[Temp, RastOut, AttrOut, TexCrdOut, Addr]);
const VS_IN: FileSet = FileSet::of(&[Temp, Input, Const]);
const R: FileSet = FileSet::of(&[Temp]);
const T: FileSet = FileSet::of(&[Texture]);
const C: FileSet = FileSet::of(&[Const]);
const RT: FileSet = FileSet::of(&[Temp, Texture]);
const RTVC: FileSet = FileSet::of(&[Temp, Texture, Input, Const]);
const RVC: FileSet = FileSet::of(&[Temp, Input, Const]);
const RC: FileSet = FileSet::of(&[Temp, Const]);

const fn source(files: FileSet, slots: Slots, modifiers: ModifierRule) -> SourceShape {
    SourceShape {
        files,
        slots,
        modifiers,
    }
}

const fn arithmetic(files: FileSet, slots: Slots) -> SourceShape {
    source(files, slots, ModifierRule::Arithmetic)
}

const fn fixed(files: FileSet, slots: WriteMask) -> SourceShape {
    arithmetic(files, Slots::Fixed(slots))
}

const fn masked(files: FileSet) -> SourceShape {
    arithmetic(files, Slots::Masked)
}

const fn matrix(slots: WriteMask) -> SourceShape {
    source(VS_IN, Slots::Fixed(slots), ModifierRule::Matrix)
}

/// The t# source of a texture instruction of `ps.1.0` to `ps.1.3`, with `_bx2` in these versions.
const fn texel(slots: WriteMask, bx2: VersionSet) -> SourceShape {
    source(T, Slots::Fixed(slots), ModifierRule::Bx2(bx2))
}

const fn coordinates(files: FileSet) -> SourceShape {
    source(files, Slots::Fixed(XYZ), ModifierRule::Coordinates)
}

const fn form(
    versions: VersionSet,
    class: Class,
    files: FileSet,
    masks: MaskSet,
    sources: &'static [SourceShape],
    formula: &'static str,
) -> Form {
    let (arithmetic_slots, texture_slots) = match class {
        Class::Arithmetic => (1, 0),
        Class::Texture => (0, 1),
        Class::Phase | Class::Declaration => (0, 0),
    };
    Form {
        versions,
        class,
        arithmetic_slots,
        texture_slots,
        destination: Some(DestinationShape {
            files,
            masks,
            written: true,
        }),
        sources,
        pairing: Pairing::Never,
        most: None,
        rows: 0,
        formula,
    }
}

const fn vs(sources: &'static [SourceShape], formula: &'static str) -> Form {
    form(
        VS,
        Class::Arithmetic,
        VS_OUT,
        MaskSet::ANY,
        sources,
        formula,
    )
}

const fn vs_matrix(
    rows: u32,
    mask: WriteMask,
    sources: &'static [SourceShape],
    formula: &'static str,
) -> Form {
    let mut form = form(
        VS,
        Class::Arithmetic,
        VS_OUT,
        MaskSet::of(&[mask]),
        sources,
        formula,
    );
    form.rows = rows;
    form.arithmetic_slots = rows;
    form
}

/// Arithmetic of `ps.1.0` to `ps.1.3`.
const fn ps13(sources: &'static [SourceShape], formula: &'static str) -> Form {
    let form = form(
        PS13,
        Class::Arithmetic,
        RT,
        MaskSet::PIPES,
        sources,
        formula,
    );
    form.pairs(Pairing::Either)
}

/// Arithmetic of `ps.1.4`.
const fn ps14(sources: &'static [SourceShape], formula: &'static str) -> Form {
    let form = form(PS14, Class::Arithmetic, R, MaskSet::ANY, sources, formula);
    form.pairs(Pairing::Either)
}

/// A texture instruction of `ps.1.0` to `ps.1.3`.
const fn tex13(sources: &'static [SourceShape], formula: &'static str) -> Form {
    form(PS13, Class::Texture, T, MaskSet::FULL, sources, formula)
}

const fn bare(versions: VersionSet, class: Class, formula: &'static str) -> Form {
    let mut form = form(versions, class, FileSet::NONE, MaskSet::FULL, &[], formula);
    form.destination = None;
    form
}

impl Form {
    const fn of(mut self, versions: VersionSet) -> Self {
        self.versions = versions;
        self
    }

    const fn costs(mut self, arithmetic: u32, texture: u32) -> Self {
        self.arithmetic_slots = arithmetic;
        self.texture_slots = texture;
        self
    }

    const fn at_most(mut self, most: u32) -> Self {
        self.most = Some(most);
        self
    }

    const fn pairs(mut self, pairing: Pairing) -> Self {
        self.pairing = pairing;
        self
    }

    const fn to(mut self, files: FileSet, masks: MaskSet) -> Self {
        self.destination = Some(DestinationShape {
            files,
            masks,
            written: true,
        });
        self
    }

    const fn only_looks(mut self) -> Self {
        if let Some(mut shape) = self.destination {
            shape.written = false;
            self.destination = Some(shape);
        }
        self
    }
}

const fn op(
    opcode: Opcode,
    mnemonic: &'static str,
    token: u16,
    forms: &'static [Form],
) -> OpcodeRow {
    OpcodeRow {
        opcode,
        mnemonic,
        token,
        forms,
    }
}

const V1: &[SourceShape] = &[masked(VS_IN)];
const V2: &[SourceShape] = &[masked(VS_IN), masked(VS_IN)];
const V3: &[SourceShape] = &[masked(VS_IN), masked(VS_IN), masked(VS_IN)];
const VSCALAR: &[SourceShape] = &[fixed(VS_IN, W)];
const P1: &[SourceShape] = &[masked(RTVC)];
const P2: &[SourceShape] = &[masked(RTVC), masked(RTVC)];
const P3: &[SourceShape] = &[masked(RTVC), masked(RTVC), masked(RTVC)];
const Q1: &[SourceShape] = &[masked(RVC)];
const Q2: &[SourceShape] = &[masked(RVC), masked(RVC)];
const Q3: &[SourceShape] = &[masked(RVC), masked(RVC), masked(RVC)];
const ROW: &[SourceShape] = &[texel(XYZ, PS13)];

/// One row an opcode, in the order of [`Opcode`].
#[rustfmt::skip]
pub(super) static OPCODES: [OpcodeRow; 54] = [
    op(Opcode::Nop, "nop", 0x00, &[
        bare(VS, Class::Arithmetic, "nothing").costs(1, 0),
        bare(PS, Class::Arithmetic, "nothing").costs(0, 0),
    ]),
    op(Opcode::Mov, "mov", 0x01, &[
        vs(V1, "d = s0").of(Version::Vs10.only()),
        vs(V1, "d = s0; a0.x = floor(s0.x)").of(Version::Vs11.only()).to(VS_OUT_A0, MaskSet::ANY),
        ps13(P1, "d = s0"), ps14(Q1, "d = s0"),
    ]),
    op(Opcode::Add, "add", 0x02, &[vs(V2, "d = s0 + s1"), ps13(P2, "d = s0 + s1"), ps14(Q2, "d = s0 + s1")]),
    op(Opcode::Sub, "sub", 0x03, &[vs(V2, "d = s0 - s1"), ps13(P2, "d = s0 - s1"), ps14(Q2, "d = s0 - s1")]),
    op(Opcode::Mad, "mad", 0x04, &[vs(V3, "d = s0 * s1 + s2"), ps13(P3, "d = s0 * s1 + s2"), ps14(Q3, "d = s0 * s1 + s2")]),
    op(Opcode::Mul, "mul", 0x05, &[vs(V2, "d = s0 * s1"), ps13(P2, "d = s0 * s1"), ps14(Q2, "d = s0 * s1")]),
    op(Opcode::Rcp, "rcp", 0x06, &[vs(VSCALAR, "d = 1 / s0.w")]),
    op(Opcode::Rsq, "rsq", 0x07, &[vs(VSCALAR, "d = 1 / sqrt(abs(s0.w))")]),
    op(Opcode::Dp3, "dp3", 0x08, &[
        vs(&[fixed(VS_IN, XYZ), fixed(VS_IN, XYZ)], "d = s0.x * s1.x + s0.y * s1.y + s0.z * s1.z"),
        ps13(&[fixed(RTVC, XYZ), fixed(RTVC, XYZ)], "d = s0.r * s1.r + s0.g * s1.g + s0.b * s1.b")
            .to(RT, MaskSet::of(&[XYZW, XYZ])).pairs(Pairing::Color),
        ps14(&[fixed(RVC, XYZ), fixed(RVC, XYZ)], "d = s0.r * s1.r + s0.g * s1.g + s0.b * s1.b").pairs(Pairing::Color),
    ]),
    op(Opcode::Dp4, "dp4", 0x09, &[
        vs(&[fixed(VS_IN, XYZW), fixed(VS_IN, XYZW)], "d = s0.x * s1.x + s0.y * s1.y + s0.z * s1.z + s0.w * s1.w"),
        ps13(&[fixed(RTVC, XYZW), fixed(RTVC, XYZW)], "d = s0.r * s1.r + s0.g * s1.g + s0.b * s1.b + s0.a * s1.a")
            .of(PS12).costs(2, 0).at_most(4).pairs(Pairing::Never),
        ps14(&[fixed(RVC, XYZW), fixed(RVC, XYZW)], "d = s0.r * s1.r + s0.g * s1.g + s0.b * s1.b + s0.a * s1.a").pairs(Pairing::Never),
    ]),
    op(Opcode::Min, "min", 0x0A, &[vs(V2, "d = s0 < s1 ? s0 : s1")]),
    op(Opcode::Max, "max", 0x0B, &[vs(V2, "d = s0 >= s1 ? s0 : s1")]),
    op(Opcode::Slt, "slt", 0x0C, &[vs(V2, "d = s0 < s1 ? 1 : 0")]),
    op(Opcode::Sge, "sge", 0x0D, &[vs(V2, "d = s0 >= s1 ? 1 : 0")]),
    op(Opcode::Exp, "exp", 0x0E, &[vs(VSCALAR, "d = 2 ^ s0.w").costs(10, 0)]),
    op(Opcode::Log, "log", 0x0F, &[vs(VSCALAR, "d = log2(abs(s0.w))").costs(10, 0)]),
    op(Opcode::Lit, "lit", 0x10, &[vs(&[fixed(VS_IN, WriteMask::from_bits(0b1011))],
        "d = (1, max(s0.x, 0), s0.x > 0 && s0.y > 0 ? s0.y ^ clamp(s0.w, -127.9961, 127.9961) : 0, 1)")]),
    op(Opcode::Dst, "dst", 0x11, &[vs(&[fixed(VS_IN, WriteMask::from_bits(0b0110)), fixed(VS_IN, WriteMask::from_bits(0b1010))],
        "d = (1, s0.y * s1.y, s0.z, s1.w)")]),
    op(Opcode::Lrp, "lrp", 0x12, &[ps13(P3, "d = s0 * s1 + (1 - s0) * s2"), ps14(Q3, "d = s0 * s1 + (1 - s0) * s2")]),
    op(Opcode::Frc, "frc", 0x13, &[vs(V1, "d = s0 - floor(s0)").costs(3, 0).to(VS_OUT, MaskSet::of(&[WriteMask::Y, XY]))]),
    op(Opcode::M4x4, "m4x4", 0x14, &[vs_matrix(4, XYZW, &[fixed(VS_IN, XYZW), matrix(XYZW)], "d.i = dp4(s0, row i of s1)")]),
    op(Opcode::M4x3, "m4x3", 0x15, &[vs_matrix(3, XYZ, &[fixed(VS_IN, XYZW), matrix(XYZW)], "d.i = dp4(s0, row i of s1)")]),
    op(Opcode::M3x4, "m3x4", 0x16, &[vs_matrix(4, XYZW, &[fixed(VS_IN, XYZ), matrix(XYZ)], "d.i = dp3(s0, row i of s1)")]),
    op(Opcode::M3x3, "m3x3", 0x17, &[vs_matrix(3, XYZ, &[fixed(VS_IN, XYZ), matrix(XYZ)], "d.i = dp3(s0, row i of s1)")]),
    op(Opcode::M3x2, "m3x2", 0x18, &[vs_matrix(2, XY, &[fixed(VS_IN, XYZ), matrix(XYZ)], "d.i = dp3(s0, row i of s1)")]),
    op(Opcode::Dcl, "dcl", 0x1F, &[form(VS, Class::Declaration, FileSet::of(&[Input]), MaskSet::ANY, &[], "binds v# to a vertex element by usage")]),
    op(Opcode::TexCoord, "texcoord", 0x40, &[tex13(&[], "t(m) = (clamp(TC[m].uvw, 0, 1), 1)")]),
    op(Opcode::TexCrd, "texcrd", 0x40, &[form(PS14, Class::Texture, R, MaskSet::of(&[XYZ, XY]), &[coordinates(T)], "r(m) = coordinates s0")]),
    op(Opcode::TexKill, "texkill", 0x41, &[
        tex13(&[], "discards the pixel if TC[m].u < 0, TC[m].v < 0 or TC[m].w < 0").only_looks(),
        form(PS14, Class::Texture, RT, MaskSet::FULL, &[], "discards the pixel if any of the register's xyz < 0").only_looks(),
    ]),
    op(Opcode::Tex, "tex", 0x42, &[tex13(&[], "t(m) = S[m](TC[m])")]),
    op(Opcode::TexLd, "texld", 0x42, &[form(PS14, Class::Texture, R, MaskSet::FULL, &[coordinates(RT)], "r(m) = S[m](coordinates s0)")]),
    op(Opcode::TexBem, "texbem", 0x43, &[tex13(&[texel(XY, VersionSet::NONE)], "t(m) = S[m](TC[m].uv + bump matrix of stage m * s0.rg)")]),
    op(Opcode::TexBeml, "texbeml", 0x44, &[tex13(&[texel(XYZ, VersionSet::NONE)],
        "t(m) = S[m](TC[m].uv + bump matrix of stage m * s0.rg) * (s0.b * luminance scale + luminance offset)").costs(1, 1)]),
    op(Opcode::TexReg2Ar, "texreg2ar", 0x45, &[tex13(&[texel(WriteMask::from_bits(0b1001), VersionSet::NONE)], "t(m) = S[m](s0.a, s0.r)")]),
    op(Opcode::TexReg2Gb, "texreg2gb", 0x46, &[tex13(&[texel(WriteMask::from_bits(0b0110), VersionSet::NONE)], "t(m) = S[m](s0.g, s0.b)")]),
    op(Opcode::TexM3x2Pad, "texm3x2pad", 0x47, &[tex13(ROW, "row 0 = dp3(TC[m], s0)")]),
    op(Opcode::TexM3x2Tex, "texm3x2tex", 0x48, &[tex13(ROW, "t(m) = S[m](row 0, dp3(TC[m], s0))")]),
    op(Opcode::TexM3x3Pad, "texm3x3pad", 0x49, &[tex13(ROW, "next row = dp3(TC[m], s0)")]),
    op(Opcode::TexM3x3Tex, "texm3x3tex", 0x4A, &[tex13(ROW, "t(m) = S[m](row 0, row 1, dp3(TC[m], s0))")]),
    op(Opcode::TexM3x3Spec, "texm3x3spec", 0x4C, &[tex13(&[texel(XYZ, PS13), source(C, Slots::Fixed(XYZ), ModifierRule::Plain)],
        "N = (row 0, row 1, dp3(TC[m], s0)); t(m) = S[m](2 * dot(N, s1) / dot(N, N) * N - s1)")]),
    op(Opcode::TexM3x3VSpec, "texm3x3vspec", 0x4D, &[tex13(ROW,
        "N = (row 0, row 1, dp3(TC[m], s0)); E = (TC[m-2].q, TC[m-1].q, TC[m].q); t(m) = S[m](2 * dot(N, E) / dot(N, N) * N - E)")]),
    op(Opcode::ExpP, "expp", 0x4E, &[vs(VSCALAR, "d = (2 ^ floor(s0.w), s0.w - floor(s0.w), 2 ^ s0.w at 10 bits, 1)")]),
    op(Opcode::LogP, "logp", 0x4F, &[vs(VSCALAR, "d = (exponent of s0.w, mantissa of s0.w, log2(abs(s0.w)) at 10 bits, 1)")]),
    op(Opcode::Cnd, "cnd", 0x50, &[
        ps13(&[fixed(R, W), masked(RTVC), masked(RTVC)], "d = r0.a > 0.5 ? s1 : s2"),
        ps14(Q3, "d = s0 > 0.5 ? s1 : s2"),
    ]),
    op(Opcode::Def, "def", 0x51, &[form(VersionSet::ALL, Class::Declaration, C, MaskSet::FULL, &[], "d = four numbers")]),
    op(Opcode::TexReg2Rgb, "texreg2rgb", 0x52, &[tex13(&[texel(XYZ, PS12)], "t(m) = S[m](s0.r, s0.g, s0.b)").of(PS12)]),
    op(Opcode::TexDp3Tex, "texdp3tex", 0x53, &[tex13(&[texel(XYZ, PS12)], "t(m) = S[m](dp3(TC[m], s0), 0, 0)").of(PS12)]),
    op(Opcode::TexM3x2Depth, "texm3x2depth", 0x54, &[tex13(&[texel(XYZ, PS12)],
        "z = row 0; w = dp3(TC[m], s0); depth = w == 0 ? 1 : z / w").of(VersionSet::PS_1_3)]),
    op(Opcode::TexDp3, "texdp3", 0x55, &[tex13(&[texel(XYZ, PS12)], "t(m) = dp3(TC[m], s0)").of(PS12)]),
    op(Opcode::TexM3x3, "texm3x3", 0x56, &[tex13(&[texel(XYZ, PS12)], "t(m) = (row 0, row 1, dp3(TC[m], s0), 1)").of(PS12)]),
    op(Opcode::TexDepth, "texdepth", 0x57, &[form(PS14, Class::Texture, R, MaskSet::FULL, &[], "depth = r5.g == 0 ? 1 : r5.r / r5.g").only_looks()]),
    op(Opcode::Cmp, "cmp", 0x58, &[
        ps13(P3, "d = s0 >= 0 ? s1 : s2").of(PS12).costs(2, 0).at_most(3),
        ps14(Q3, "d = s0 >= 0 ? s1 : s2"),
    ]),
    op(Opcode::Bem, "bem", 0x59, &[form(PS14, Class::Arithmetic, R, MaskSet::of(&[XY]), &[fixed(RC, XY), fixed(RC, XY)],
        "d.rg = s0.rg + bump matrix of stage d * s1.rg").costs(2, 0).at_most(1)]),
    op(Opcode::Phase, "phase", 0xFFFD, &[bare(PS14, Class::Phase, "ends the first phase").at_most(1)]),
];

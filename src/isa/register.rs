//! Register files.

use super::version::{ShaderKind, Version, VersionSet};

/// A register file. The name of a member is its name in `d3d8types.h`, where `a0` and `t#` share a type code.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum RegisterFile {
    /// `r#`: temporaries; `r0` of a pixel shader is its result.
    Temp,
    /// `v#`: vertex elements of a vertex shader, interpolated colours of a pixel shader.
    Input,
    /// `c#`: constants.
    Const,
    /// `a0`: the address register of a vertex shader.
    Addr,
    /// `t#`: texture coordinates, and in `ps.1.0` to `ps.1.3` what was sampled with them.
    Texture,
    /// `oPos`, `oFog`, `oPts`: what the rasterizer takes.
    RastOut,
    /// `oD#`: colours of a vertex.
    AttrOut,
    /// `oT#`: texture coordinates of a vertex.
    TexCrdOut,
}

/// What a shader may do with a register file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Access {
    /// Only as a source.
    Read,
    /// Only as a destination.
    Write,
    /// As both.
    ReadWrite,
}

/// Numbers that differ from version to version: one value for each of `vs.1.0`, `vs.1.1`, `ps.1.0` to `ps.1.4`.
pub type PerVersion = [u16; 7];

/// One register file.
#[derive(Debug)]
pub struct FileRow {
    /// The file that this row describes.
    pub file: RegisterFile,
    /// Its name in messages.
    pub name: &'static str,
    /// The letters before the number; for [`RegisterFile::RastOut`] the register names are in [`RAST_OUT`].
    pub prefix: &'static str,
    /// The register type of tokens (bits 30:28).
    pub code: u8,
    /// How many registers a version has; 0: the version has no such file.
    pub count: PerVersion,
    /// How many different registers of the file one instruction may read; 0: it cannot be read by arithmetic.
    pub read_ports: PerVersion,
    /// What a shader may do with it.
    pub access: Access,
    /// What it is in groups of versions; every version that has the file is in one of them.
    pub forms: &'static [FileForm],
}

/// A register file as one group of versions has it.
#[derive(Debug)]
pub struct FileForm {
    /// The versions.
    pub versions: VersionSet,
    /// What it holds, who fills it and who reads it, in sentences.
    pub meaning: &'static str,
    /// What it holds before the shader writes it; of an output, what is taken if the shader never does.
    pub before: &'static str,
    /// Which numbers it holds.
    pub range: &'static str,
    /// A listing in which it stands, without the version line; every one of the versions accepts it without a word.
    pub example: &'static str,
}

/// One register of [`RegisterFile::RastOut`].
#[derive(Debug)]
pub struct RastOutRow {
    /// Its name.
    pub name: &'static str,
    /// What it is; the versions are those of the file.
    pub form: FileForm,
}

/// The registers of [`RegisterFile::RastOut`] by number.
#[rustfmt::skip]
pub static RAST_OUT: [RastOutRow; 3] = [
    RastOutRow { name: "oPos", form: FileForm {
        versions: VersionSet::VS,
        meaning: "The position of the vertex in clip space, all four components: it is clipped and divided by w. Every vertex shader \
                  writes it.",
        before: "it must be written",
        range: "32-bit floats",
        example: "m4x4 oPos, v0, c0",
    } },
    RastOutRow { name: "oFog", form: FileForm {
        versions: VersionSet::VS,
        meaning: "How much of the fog leaves the pixel free: 1 is no fog, 0 nothing but fog. It is one number, the x of what is written, \
                  with the mask .x or none, and it is interpolated.",
        before: "0, nothing but fog, where fog is enabled and no fog table computes it",
        range: "clamped to 0 to 1",
        example: "m4x4 r0, v0, c0\nmov oPos, r0\nmad oFog.x, r0.w, c4.x, c4.y",
    } },
    RastOutRow { name: "oPts", form: FileForm {
        versions: VersionSet::VS,
        meaning: "The size of a point in pixels. It is one number, the x of what is written, with the mask .x or none.",
        before: "D3DRS_POINTSIZE",
        range: "clamped to D3DRS_POINTSIZE_MIN to D3DRS_POINTSIZE_MAX",
        example: "m4x4 oPos, v0, c0\nmov oPts.x, c4.x",
    } },
];
/// Number of `oPos` in [`RegisterFile::RastOut`].
pub const OPOS: u32 = 0;
/// Number of `oFog` in [`RegisterFile::RastOut`].
pub const OFOG: u32 = 1;
/// Number of `oPts` in [`RegisterFile::RastOut`].
pub const OPTS: u32 = 2;

/// How many vertex shader constants every device of Direct3D 8 has (`D3DCAPS8.MaxVertexShaderConst`, minimum).
pub const VERTEX_CONSTANTS: u32 = 96;

use Access::{Read, ReadWrite, Write};

/// One row a file. Counts and ports: the register tables of the Direct3D 8.1 documents.
#[rustfmt::skip]
static FILES: [FileRow; 8] = {
    use RegisterFile::*;
    const VS: VersionSet = VersionSet::VS;
    const PS: VersionSet = VersionSet::PS;
    const PS13: VersionSet = VersionSet::PS_1_0_TO_1_3;
    const PS14: VersionSet = VersionSet::PS_1_4;
    const UNDEFINED: &str = "undefined; a component is written before it is read";
    const WORKING: &str = "32-bit floats; devices promised -1 to 1 at least (D3DCAPS8.MaxPixelShaderValue)";
    [
        row(Temp, ("temporary", "r", 0), [12, 12, 2, 2, 2, 2, 6], [3, 3, 2, 2, 2, 2, 3], ReadWrite, &[
            file(VS, "Working registers.", UNDEFINED, "32-bit floats",
                "m4x4 r0, v0, c0\nadd oPos, r0, c4"),
            file(PS13, "Working registers. What r0 holds at the end is the result: the colour of the pixel and its alpha.", UNDEFINED, WORKING,
                "tex t0\nmul r1, t0, v0\nadd r0, r1, c0"),
            file(PS14, "Working registers. A texld into r# samples the stage of its number, and behind phase it samples at the coordinates that \
                        the first phase left in an r#. What r0 holds at the end is the result: the colour of the pixel and its alpha. phase \
                        loses the alpha of all of them.",
                UNDEFINED, "32-bit floats; devices promised -8 to 8 at least (D3DCAPS8.MaxPixelShaderValue)",
                "texld r0, t0\ntexld r1, t1\nmul r0.rgb, r0, r1"),
        ]),
        row(Input, ("input", "v", 1), [16, 16, 2, 2, 2, 2, 2], [1, 1, 1, 2, 2, 2, 2], Read, &[
            file(VS, "The elements of a vertex. The vertex declaration says which element feeds which register; what it does not say is as \
                      D3DVSDE_POSITION and its kin number them. Components that an element does not have are 0, w is 1.",
                "(0, 0, 0, 1) where no element feeds it", "32-bit floats",
                "m4x4 oPos, v0, c0\nmov oD0, v5"),
            file(PS13, "v0 is the diffuse, v1 the specular colour: oD0 and oD1 of the vertex shader, interpolated.",
                "filled for every pixel", "0 to 1, in 8 bits at least",
                "tex t0\nmul r0, t0, v0"),
            file(PS14, "v0 is the diffuse, v1 the specular colour: oD0 and oD1 of the vertex shader, interpolated. They can be read behind phase; \
                        a shader without phase is all behind it.",
                "filled for every pixel", "0 to 1, in 8 bits at least",
                "texld r0, t0\nmul r0, r0, v0"),
        ]),
        row(Const, ("constant", "c", 2), [96, 96, 8, 8, 8, 8, 8], [1, 1, 2, 2, 2, 2, 2], Read, &[
            file(VS, "Numbers that are the same for all vertices, set by the program (SetVertexShaderConstant), by def or by D3DVSD_CONST of the \
                      vertex declaration. It is the only file that is addressed relative to a0.x; beyond its end it reads (0, 0, 0, 0). \
                      Every device has this many (D3DCAPS8.MaxVertexShaderConst), the largest 256.",
                "(0, 0, 0, 0)", "32-bit floats",
                "def c4, 0.5, 0.5, 0.5, 1\nm4x4 oPos, v0, c0\nmul oD0, v5, c4"),
            file(PS, "Numbers that are the same for all pixels, set by the program (SetPixelShaderConstant) or by def.",
                "(0, 0, 0, 0)", "clamped to -1 to 1 when they are read",
                "def c0, 1, 0.5, 0, 1\nmul r0, v0, c0"),
        ]),
        row(Addr, ("address", "a", 3), [0, 1, 0, 0, 0, 0, 0], [0, 1, 0, 0, 0, 0, 0], Write, &[
            file(VersionSet::VS_1_1, "A whole number that c[a0.x + n] adds to the number of a constant. It has the component x alone, and mov alone \
                                      writes it, rounding down.",
                "undefined; it is written before it is used", "whole numbers of 32 bits; NaN becomes 0",
                "mov a0.x, v1.x\nm4x4 oPos, v0, c[a0.x]"),
        ]),
        row(Texture, ("texture", "t", 3), [0, 0, 4, 4, 4, 4, 6], [0, 0, 1, 2, 3, 3, 1], ReadWrite, &[
            file(PS13, "Two things under one name. As the destination of a texture instruction the number names the texture coordinates and the \
                        stage; behind it t# holds what was sampled or computed there, four numbers that arithmetic and later texture \
                        instructions read and arithmetic may overwrite.",
                "undefined; a texture instruction fills it", WORKING,
                "tex t0\nmul t0, t0, v0\nmov r0, t0"),
            file(PS14, "Texture coordinates: oT# of the vertex shader, interpolated. Only texld, texcrd and texkill read them.",
                "filled for every pixel; a component that the vertex does not have is 0, the fourth 1",
                "32-bit floats; devices promised -8 to 8 at least (D3DCAPS8.MaxTextureRepeat)",
                "texld r0, t1\nmul r0, r0, v0"),
        ]),
        row(RastOut, ("rasterizer output", "o", 4), [3, 3, 0, 0, 0, 0, 0], [0; 7], Write, &[
            file(VS, "What the rasterizer takes of a vertex beside colours and coordinates.",
                "each has a value of its own", "each has a range of its own",
                "m4x4 r0, v0, c0\nmov oPos, r0\nmov oFog.x, r0.z\nmov oPts.x, c4.x"),
        ]),
        row(AttrOut, ("colour output", "oD", 5), [2, 2, 0, 0, 0, 0, 0], [0; 7], Write, &[
            file(VS, "The colours of a vertex: oD0 is the diffuse, oD1 the specular one. Interpolated they are v0 and v1 of the pixel shader.",
                "oD0 (1, 1, 1, 1), oD1 (0, 0, 0, 0), component by component", "clamped to 0 to 1 before they are interpolated",
                "m4x4 oPos, v0, c0\nmov oD0, v5\nmov oD1, v6"),
        ]),
        row(TexCrdOut, ("texture coordinate output", "oT", 6), [8, 8, 0, 0, 0, 0, 0], [0; 7], Write, &[
            file(VS, "Texture coordinates of a vertex. Interpolated they are those of the pixel shader with the same number.",
                "(0, 0, 0, 0), component by component", "32-bit floats",
                "m4x4 oPos, v0, c0\nmov oT0, v7"),
        ]),
    ]
};

const fn file(
    versions: VersionSet,
    meaning: &'static str,
    before: &'static str,
    range: &'static str,
    example: &'static str,
) -> FileForm {
    FileForm {
        versions,
        meaning,
        before,
        range,
        example,
    }
}

const fn row(
    file: RegisterFile,
    (name, prefix, code): (&'static str, &'static str, u8),
    count: PerVersion,
    read_ports: PerVersion,
    access: Access,
    forms: &'static [FileForm],
) -> FileRow {
    FileRow {
        file,
        name,
        prefix,
        code,
        count,
        read_ports,
        access,
        forms,
    }
}

impl RegisterFile {
    /// Every file.
    pub fn all() -> impl Iterator<Item = RegisterFile> {
        FILES.iter().map(|row| row.file)
    }

    /// The row of this file.
    pub fn row(self) -> &'static FileRow {
        &FILES[self as usize]
    }

    /// How many registers of this file the version has; 0: none.
    pub fn count(self, version: Version) -> u32 {
        self.row().count[version as usize].into()
    }

    /// Whether the assembler of a version takes the register of this number, validated or not: one that the version has, any
    /// constant of a vertex shader, of which devices have different numbers (D3DCAPS8.MaxVertexShaderConst), and `a0` of a
    /// vertex shader, which only the validator misses in vs.1.0.
    pub fn can_be_named(self, index: u32, version: Version) -> bool {
        match (self, version.kind()) {
            (Self::Const, ShaderKind::Vertex) => true,
            (Self::Addr, ShaderKind::Vertex) => index < self.count(Version::Vs11),
            _ => index < self.count(version),
        }
    }

    /// How many different registers of this file one instruction of the version may read.
    pub fn read_ports(self, version: Version) -> u32 {
        self.row().read_ports[version as usize].into()
    }

    /// What a shader of this version may do with the file. `ps.1.4` only reads its texture coordinates.
    pub fn access(self, version: Version) -> Access {
        if self == RegisterFile::Texture && version == Version::Ps14 {
            return Read;
        }
        self.row().access
    }

    /// The versions that have the file.
    pub fn versions(self) -> VersionSet {
        Version::all()
            .filter(|v| self.count(*v) > 0)
            .fold(VersionSet::NONE, |set, v| set.and(v.only()))
    }

    /// The file of a token's register type in a shader of this kind.
    pub fn from_code(code: u8, kind: ShaderKind) -> Option<Self> {
        let of_code = |file: &RegisterFile| file.row().code == code;
        Self::all()
            .filter(of_code)
            .find(|file| file.exists_in(kind))
    }

    /// Whether a version of this kind has the file.
    pub const fn exists_in(self, kind: ShaderKind) -> bool {
        let set = match kind {
            ShaderKind::Vertex => Self::OF_VERTEX_SHADERS,
            ShaderKind::Pixel => Self::OF_PIXEL_SHADERS,
        };
        set.contains(self)
    }

    const OF_VERTEX_SHADERS: FileSet = of_versions(VersionSet::VS);
    const OF_PIXEL_SHADERS: FileSet = of_versions(VersionSet::PS);

    /// The name of register `index` of this file as listings write it: `r3`, `a0`, `oPos`, `oT2`.
    pub fn register_name(self, index: u32) -> String {
        if self == RegisterFile::RastOut
            && let Some(row) = RAST_OUT.get(index as usize)
        {
            return row.name.to_string();
        }
        // With room for the letters that mostly follow.
        let mut name = String::with_capacity(16);
        name.push_str(self.row().prefix);
        match char::from_digit(index, 10) {
            Some(digit) => name.push(digit),
            None => name.push_str(&index.to_string()),
        }
        name
    }

    /// What its registers are called when any of them is meant: `r#`, `oPos, oFog, oPts`.
    pub fn any_name(self) -> String {
        match self {
            RegisterFile::RastOut => RAST_OUT.each_ref().map(|row| row.name).join(", "),
            RegisterFile::Addr => self.register_name(0),
            _ => format!("{}#", self.row().prefix),
        }
    }

    /// What this version says of a register of the file, where its registers differ of that one; `None` if the version does not
    /// have the file.
    pub fn form(self, index: Option<u32>, version: Version) -> Option<&'static FileForm> {
        let mut own = self.forms(index);
        own.find(|form| form.versions.contains(version))
    }

    /// What all groups of versions say of a register of the file, where its registers differ of that one.
    pub fn forms(self, index: Option<u32>) -> impl Iterator<Item = &'static FileForm> {
        let own = match (self, index) {
            (RegisterFile::RastOut, Some(index)) => RAST_OUT.get(index as usize),
            _ => None,
        };
        let own = own.map(|row| &row.form);
        let all = self.row().forms.iter().filter(move |_| own.is_none());
        own.into_iter().chain(all)
    }

    /// The register that listings write like this, in letters of either case, whether a version has it or not: the other way from
    /// [`Self::register_name`].
    pub fn named(name: impl AsRef<[u8]>) -> Option<(Self, u32)> {
        let name = name.as_ref();
        match Self::parts(name) {
            Some((file, digits)) => Some((file, number(digits)?)),
            None => Some((Self::RastOut, rast_out(name)?)),
        }
    }

    /// The file of the registers that begin with the letters of this name, in either case, and the digits behind
    /// them, which may be none. `None` if it is not letters of a file with digits alone behind them.
    pub fn parts(name: &[u8]) -> Option<(Self, &[u8])> {
        // Letters are one or two.
        let letters = match name {
            [_] | [_, b'0'..=b'9', ..] => 1,
            _ => 2,
        };
        let (letters, digits) = name.split_at_checked(letters)?;
        let key = Some(prefix_key(letters)?);
        let whole = digits.iter().all(u8::is_ascii_digit);
        let row = PREFIX_KEYS
            .iter()
            .position(|other| *other == key)
            .filter(|_| whole);
        Some((FILES.get(row?)?.file, digits))
    }

    /// The set that holds only this file.
    pub const fn only(self) -> FileSet {
        FileSet(1 << self as u8)
    }
}

/// The letters before a number, one or two, as a number of its own: the same for letters of either case.
const fn prefix_key(letters: &[u8]) -> Option<u16> {
    match letters {
        [one] => Some(one.to_ascii_lowercase() as u16),
        [one, two] => {
            let high = (one.to_ascii_lowercase() as u16) << 8;
            Some(high | two.to_ascii_lowercase() as u16)
        }
        _ => None,
    }
}

/// [`prefix_key`] of each file whose registers have numbers.
static PREFIX_KEYS: [Option<u16>; FILES.len()] = {
    let mut keys = [None; FILES.len()];
    let mut i = 0;
    while i < FILES.len() {
        if !matches!(FILES[i].file, RegisterFile::RastOut) {
            keys[i] = prefix_key(FILES[i].prefix.as_bytes());
            assert!(keys[i].is_some(), "a prefix is one or two letters");
        }
        i += 1;
    }
    keys
};

/// The register of [`RegisterFile::RastOut`] with this name, in letters of either case.
pub(crate) fn rast_out(name: &[u8]) -> Option<u32> {
    let same = |row: &RastOutRow| row.name.as_bytes().eq_ignore_ascii_case(name);
    let number = RAST_OUT.iter().position(same)?;
    Some(number as u32)
}

/// The number that digits write, if it is one of 32 bits.
pub(crate) fn number(digits: &[u8]) -> Option<u32> {
    if digits.is_empty() {
        return None;
    }
    digits.iter().try_fold(0u32, |number, digit| {
        let digit = char::from(*digit).to_digit(10)?;
        number.checked_mul(10)?.checked_add(digit)
    })
}

/// The files that one of these versions has.
const fn of_versions(versions: VersionSet) -> FileSet {
    let (mut bits, mut file) = (0, 0);
    while file < FILES.len() {
        let mut version = 0;
        while version < FILES[file].count.len() {
            if FILES[file].count[version] > 0 && versions.has_number(version) {
                bits |= FILES[file].file.only().0;
            }
            version += 1;
        }
        file += 1;
    }
    FileSet(bits)
}

/// A set of register files: those that an operand may name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FileSet(u8);

impl FileSet {
    /// No file.
    pub const NONE: Self = Self(0);

    /// The set of these files.
    pub const fn of(files: &[RegisterFile]) -> Self {
        let mut bits = 0;
        let mut i = 0;
        while i < files.len() {
            bits |= files[i].only().0;
            i += 1;
        }
        Self(bits)
    }

    /// Whether the file is in the set.
    pub const fn contains(self, file: RegisterFile) -> bool {
        self.0 & file.only().0 != 0
    }

    /// The files of the set.
    pub fn iter(self) -> impl Iterator<Item = RegisterFile> {
        RegisterFile::all().filter(move |f| self.contains(*f))
    }
}

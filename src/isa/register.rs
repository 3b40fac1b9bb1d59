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
}

/// The registers of [`RegisterFile::RastOut`] by number.
pub const RAST_OUT: [&str; 3] = ["oPos", "oFog", "oPts"];
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
    [
        row(Temp, "temporary", "r", 0, [12, 12, 2, 2, 2, 2, 6], [3, 3, 2, 2, 2, 2, 3], ReadWrite),
        row(Input, "input", "v", 1, [16, 16, 2, 2, 2, 2, 2], [1, 1, 1, 2, 2, 2, 2], Read),
        row(Const, "constant", "c", 2, [96, 96, 8, 8, 8, 8, 8], [1, 1, 2, 2, 2, 2, 2], Read),
        row(Addr, "address", "a", 3, [0, 1, 0, 0, 0, 0, 0], [0, 1, 0, 0, 0, 0, 0], Write),
        row(Texture, "texture", "t", 3, [0, 0, 4, 4, 4, 4, 6], [0, 0, 1, 2, 3, 3, 1], ReadWrite),
        row(RastOut, "rasterizer output", "o", 4, [3, 3, 0, 0, 0, 0, 0], [0; 7], Write),
        row(AttrOut, "colour output", "oD", 5, [2, 2, 0, 0, 0, 0, 0], [0; 7], Write),
        row(TexCrdOut, "texture coordinate output", "oT", 6, [8, 8, 0, 0, 0, 0, 0], [0; 7], Write),
    ]
};

const fn row(
    file: RegisterFile,
    name: &'static str,
    prefix: &'static str,
    code: u8,
    count: PerVersion,
    read_ports: PerVersion,
    access: Access,
) -> FileRow {
    FileRow {
        file,
        name,
        prefix,
        code,
        count,
        read_ports,
        access,
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
            && let Some(name) = RAST_OUT.get(index as usize)
        {
            return (*name).to_string();
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
        let digit = name.iter().position(u8::is_ascii_digit);
        let (letters, digits) = name.split_at_checked(digit.unwrap_or(name.len()))?;
        let key = prefix_key(letters)?;
        let row = FILES.get(PREFIX_KEYS.iter().position(|other| *other == key)?)?;
        let whole = digits.iter().all(u8::is_ascii_digit);
        whole.then_some((row.file, digits))
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

/// [`prefix_key`] of each file; 0, which is none, where registers have names instead of numbers.
static PREFIX_KEYS: [u16; FILES.len()] = {
    let mut keys = [0; FILES.len()];
    let mut i = 0;
    while i < FILES.len() {
        if !matches!(FILES[i].file, RegisterFile::RastOut) {
            keys[i] = match prefix_key(FILES[i].prefix.as_bytes()) {
                Some(key) => key,
                None => panic!("a prefix is one or two letters"),
            };
        }
        i += 1;
    }
    keys
};

/// The register of [`RegisterFile::RastOut`] with this name, in letters of either case.
pub(crate) fn rast_out(name: &[u8]) -> Option<u32> {
    let same = |other: &&str| other.as_bytes().eq_ignore_ascii_case(name);
    let number = RAST_OUT.iter().position(|other| same(&other))?;
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

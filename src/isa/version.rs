//! Shader versions and their budgets.

use std::fmt;

/// Vertex or pixel shader.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ShaderKind {
    /// `vs.1.x`.
    Vertex,
    /// `ps.1.x`.
    Pixel,
}

/// A shader version of Direct3D 8.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Version {
    /// `vs.1.0`: as `vs.1.1` without the address register.
    Vs10,
    /// `vs.1.1`.
    Vs11,
    /// `ps.1.0`.
    Ps10,
    /// `ps.1.1`.
    Ps11,
    /// `ps.1.2`.
    Ps12,
    /// `ps.1.3`.
    Ps13,
    /// `ps.1.4`: two phases, six texture coordinates, `texld` and `texcrd`.
    Ps14,
}

/// What one version is called and how much a shader of it may hold.
#[derive(Debug)]
pub struct VersionRow {
    /// The version that this row describes.
    pub version: Version,
    /// Vertex or pixel shader.
    pub kind: ShaderKind,
    /// The digit after the last dot; the major number is always 1.
    pub minor: u8,
    /// The text of the version instruction, with dots.
    pub name: &'static str,
    /// Most arithmetic slots of one phase (of the whole shader where there are no phases); for vertex shaders
    /// all instruction slots.
    pub arithmetic_slots: u32,
    /// Most texture slots of one phase; 0 for vertex shaders.
    pub texture_slots: u32,
    /// How many phases the shader may have.
    pub phases: u32,
    /// What is special about it, in sentences.
    pub meaning: &'static str,
    /// A small whole shader without the version line.
    pub example: &'static str,
}

/// One row a version. Slots: the instruction tables of the Direct3D 8.1 documents.
#[rustfmt::skip]
static VERSIONS: [VersionRow; 7] = [
    row(Version::Vs10, "vs.1.0", (128, 0, 1),
        "The first vertex shaders: one straight run of instructions on registers of four 32-bit floats. It is vs.1.1 without the \
         address register, and no hardware asked for it.",
        "m4x4 oPos, v0, c0\nmov oD0, v5\nmov oT0, v7"),
    row(Version::Vs11, "vs.1.1", (128, 0, 1),
        "The vertex shaders of Direct3D 8: one straight run of instructions on registers of four 32-bit floats. The address register \
         a0.x picks constants by a number of the vertex.",
        "m4x4 oPos, v0, c0\nmov a0.x, v1.x\nmul oD0, v5, c[a0.x + 8]\nmov oT0, v7"),
    row(Version::Ps10, "ps.1.0", (8, 4, 1),
        "The pixel shaders of hardware that was not built: ps.1.1 with one read port for t#, one for v#, no selector .b, and pairs \
         that write one register.",
        "tex t0\nmul r0, t0, v0"),
    row(Version::Ps11, "ps.1.1", (8, 4, 1),
        "The pixel shaders of the GeForce 3: up to four texture instructions, one a stage and in the order of the stages, then up to \
         eight of arithmetic.",
        "def c0, 0.5, 0.5, 0.5, 1\ntex t0\ntex t1\nmul r0, t0, v0\nmad r0, t1, c0, r0"),
    row(Version::Ps12, "ps.1.2", (8, 4, 1),
        "ps.1.1 with cmp, dp4, texdp3, texdp3tex, texm3x3 and texreg2rgb, a third read port for t#, and _bx2 on most texture \
         instructions.",
        "tex t0\ntexdp3 t1, t0_bx2\nmul r0, t1, v0"),
    row(Version::Ps13, "ps.1.3", (8, 4, 1),
        "The pixel shaders of the GeForce 4: ps.1.2 with texm3x2depth.",
        "tex t0\ntexm3x2pad t1, t0\ntexm3x2depth t2, t0\nmov r0, v0"),
    row(Version::Ps14, "ps.1.4", (8, 6, 2),
        "The pixel shaders of the Radeon 8500, another machine than ps.1.3: texld and texcrd bring textures and coordinates into r#, \
         arithmetic works on r# with any write mask, and after phase all of it starts again, so that textures can be sampled \
         where the first phase computed.",
        "texld r0, t0\nmad r1.rgb, r0_bx2, c0, r0\nphase\ntexld r1, r1\nmul r0, r1, v0"),
];

const fn row(
    version: Version,
    name: &'static str,
    (arithmetic_slots, texture_slots, phases): (u32, u32, u32),
    meaning: &'static str,
    example: &'static str,
) -> VersionRow {
    let (kind, minor) = match version {
        Version::Vs10 => (ShaderKind::Vertex, 0),
        Version::Vs11 => (ShaderKind::Vertex, 1),
        Version::Ps10 => (ShaderKind::Pixel, 0),
        Version::Ps11 => (ShaderKind::Pixel, 1),
        Version::Ps12 => (ShaderKind::Pixel, 2),
        Version::Ps13 => (ShaderKind::Pixel, 3),
        Version::Ps14 => (ShaderKind::Pixel, 4),
    };
    VersionRow {
        version,
        kind,
        minor,
        name,
        arithmetic_slots,
        texture_slots,
        phases,
        meaning,
        example,
    }
}

impl Version {
    /// Every version, oldest first.
    pub fn all() -> impl Iterator<Item = Version> {
        VERSIONS.iter().map(|row| row.version)
    }

    /// The row of this version.
    pub fn row(self) -> &'static VersionRow {
        &VERSIONS[self as usize]
    }

    /// Vertex or pixel shader.
    pub fn kind(self) -> ShaderKind {
        self.row().kind
    }

    /// The text of the version instruction with dots, such as `ps.1.4`.
    pub fn name(self) -> &'static str {
        self.row().name
    }

    /// The version token: `0xFFFE01mm` for vertex, `0xFFFF01mm` for pixel shaders.
    pub fn token(self) -> u32 {
        let kind = match self.kind() {
            ShaderKind::Vertex => 0xFFFE_0100,
            ShaderKind::Pixel => 0xFFFF_0100,
        };
        kind | u32::from(self.row().minor)
    }

    /// The version with these numbers, if Direct3D 8 has it.
    pub fn from_parts(kind: ShaderKind, major: u32, minor: u32) -> Option<Self> {
        VERSIONS
            .iter()
            .find(|row| row.kind == kind && major == 1 && u32::from(row.minor) == minor)
            .map(|row| row.version)
    }

    /// The version of a version token.
    pub fn from_token(token: u32) -> Option<Self> {
        Self::all().find(|v| v.token() == token)
    }

    /// The set that holds only this version.
    pub const fn only(self) -> VersionSet {
        VersionSet(1 << self as u8)
    }
}

impl fmt::Display for Version {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A set of versions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VersionSet(u8);

impl VersionSet {
    /// No version.
    pub const NONE: Self = Self(0);
    /// `vs.1.0` and `vs.1.1`.
    pub const VS: Self = Version::Vs10.only().and(Version::Vs11.only());
    /// `vs.1.1` alone.
    pub const VS_1_1: Self = Version::Vs11.only();
    /// `ps.1.0` to `ps.1.3`: one phase, texture registers with fixed stages.
    pub const PS_1_0_TO_1_3: Self = Version::Ps10.only().and(Self::PS_1_1_TO_1_3);
    /// `ps.1.1` to `ps.1.3`.
    pub const PS_1_1_TO_1_3: Self = Version::Ps11.only().and(Self::PS_1_2_TO_1_3);
    /// `ps.1.2` and `ps.1.3`.
    pub const PS_1_2_TO_1_3: Self = Version::Ps12.only().and(Version::Ps13.only());
    /// `ps.1.0` and `ps.1.1`.
    pub const PS_1_0_TO_1_1: Self = Version::Ps10.only().and(Version::Ps11.only());
    /// `ps.1.0` alone.
    pub const PS_1_0: Self = Version::Ps10.only();
    /// `ps.1.3` alone.
    pub const PS_1_3: Self = Version::Ps13.only();
    /// `ps.1.4` alone.
    pub const PS_1_4: Self = Version::Ps14.only();
    /// Every pixel shader version.
    pub const PS: Self = Self::PS_1_0_TO_1_3.and(Self::PS_1_4);
    /// Every version.
    pub const ALL: Self = Self::VS.and(Self::PS);

    /// The union of both.
    #[must_use]
    pub const fn and(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// The versions that are in both.
    #[must_use]
    pub const fn both(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    /// Whether the version is in the set.
    pub const fn contains(self, version: Version) -> bool {
        self.has_number(version as usize)
    }

    /// Whether the version that is so many behind the oldest is in the set.
    pub(super) const fn has_number(self, number: usize) -> bool {
        self.0 as usize >> number & 1 != 0
    }

    /// The versions of the set, oldest first.
    pub fn iter(self) -> impl Iterator<Item = Version> {
        Version::all().filter(move |v| self.contains(*v))
    }
}

/// The versions for people: `vs.1.0 and vs.1.1`, `ps.1.0 to ps.1.3`.
impl fmt::Display for VersionSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let all: Vec<Version> = self.iter().collect();
        let follows =
            |a: &Version, b: &Version| a.kind() == b.kind() && *a as usize + 1 == *b as usize;
        let mut parts = Vec::new();
        for run in all.chunk_by(follows) {
            match run {
                [first, _, .., last] => parts.push(format!("{first} to {last}")),
                few => parts.extend(few.iter().map(Version::to_string)),
            }
        }
        f.write_str(&super::enumerate(&parts, "and"))
    }
}

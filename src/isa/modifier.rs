//! Source modifiers and result modifiers.

use super::register::RegisterFile;
use super::version::{Version, VersionSet};

/// What happens to an operand after it is read and swizzled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum SourceModifier {
    /// x
    #[default]
    None,
    /// −x
    Negate,
    /// x − 0.5
    Bias,
    /// −(x − 0.5)
    BiasNegate,
    /// 2·(x − 0.5)
    Bx2,
    /// −(2·(x − 0.5))
    Bx2Negate,
    /// 1 − x
    Complement,
    /// 2·x
    X2,
    /// −2·x
    X2Negate,
    /// Coordinates divided by the third component.
    Dz,
    /// Coordinates divided by the fourth component.
    Dw,
}

/// One source modifier.
#[derive(Debug)]
pub struct SourceModifierRow {
    /// The modifier that this row describes.
    pub modifier: SourceModifier,
    /// Its code in source tokens (bits 27:24).
    pub code: u8,
    /// What stands before the register: nothing, `-` or `1-`.
    pub prefix: &'static str,
    /// What stands behind the register, as it is printed.
    pub suffix: &'static str,
    /// Another spelling of the suffix that is read; empty if there is none.
    pub alias: &'static str,
    /// Versions in which arithmetic instructions take it.
    pub arithmetic: VersionSet,
    /// Versions in which it divides texture coordinates.
    pub coordinates: VersionSet,
    /// The file whose registers it divides; `None` if it does not divide.
    pub divides: Option<RegisterFile>,
    /// The value as a formula in x.
    pub formula: &'static str,
    /// What it is for, in sentences.
    pub meaning: &'static str,
    /// A listing in which it stands, without the version line, that the newest version that has it accepts without a word.
    pub example: &'static str,
}

#[rustfmt::skip]
static SOURCE_MODIFIERS: [SourceModifierRow; 11] = {
    use SourceModifier::*;
    const NO: VersionSet = VersionSet::NONE;
    const PS: VersionSet = VersionSet::PS;
    const PS14: VersionSet = VersionSet::PS_1_4;
    [
        row(None, 0, ("", "", ""), (VersionSet::ALL, NO), "x",
            "The source as it is.",
            "mov r0, v0"),
        row(Negate, 1, ("-", "", ""), (VersionSet::ALL, NO), "-x",
            "Turns the sign of a source. It goes together with _bias, _bx2 and _x2 and is applied after them. It is the only modifier \
             of vertex shaders.",
            "texld r0, t0\nadd r0.rgb, c0, -r0"),
        row(Bias, 2, ("", "_bias", ""), (PS, NO), "x - 0.5",
            "Moves 0 to 1 to -0.5 to 0.5.",
            "texld r0, t0\nadd r0.rgb, r0_bias, c0"),
        row(BiasNegate, 3, ("-", "_bias", ""), (PS, NO), "-(x - 0.5)",
            "Moves 0 to 1 to -0.5 to 0.5 and turns the sign.",
            "texld r0, t0\nadd r0.rgb, -r0_bias, c0"),
        row(Bx2, 4, ("", "_bx2", ""), (PS, NO), "2 * (x - 0.5)",
            "Spreads 0 to 1 to -1 to 1: what unpacks normals that are stored as colours. Texture instructions of ps.1.0 to ps.1.3 have \
             it on the sources that say so.",
            "texld r0, t0\ndp3_sat r0.rgb, r0_bx2, c0"),
        row(Bx2Negate, 5, ("-", "_bx2", ""), (PS, NO), "-(2 * (x - 0.5))",
            "Spreads 0 to 1 to -1 to 1 and turns the sign.",
            "texld r0, t0\ndp3_sat r0.rgb, -r0_bx2, c0"),
        row(Complement, 6, ("1-", "", ""), (PS, NO), "1 - x",
            "Takes what is missing to 1: the negative of a colour, the other weight of a mixture. It goes together with no other \
             modifier.",
            "texld r0, t0\nmul r0.rgb, 1-r0, c0"),
        row(X2, 7, ("", "_x2", ""), (PS14, NO), "2 * x",
            "Doubles a source. Behind a mnemonic the same letters double the result.",
            "texld r0, t0\nadd r0.rgb, r0_x2, c0"),
        row(X2Negate, 8, ("-", "_x2", ""), (PS14, NO), "-2 * x",
            "Doubles a source and turns the sign.",
            "texld r0, t0\nadd r0.rgb, -r0_x2, c0"),
        row(Dz, 9, ("", "_dz", "_db"), (NO, PS14), "(x / z, y / z)",
            "Divides the first two components of r# by the third before texld samples there, at most twice in a shader. What is divided by \
             0 becomes 1. It stands alone or with .xyz and goes together with no other modifier.",
            "texcrd r1.rgb, t1\nphase\ntexld r0, r1_dz\nmov r0.a, c0.r"),
        row(Dw, 10, ("", "_dw", "_da"), (NO, PS14), "(x / w, y / w)",
            "Divides the first two components of t# by the fourth: projected textures. What is divided by 0 becomes 1. It stands with .xyw \
             and goes together with no other modifier.",
            "texld r0, t0_dw.xyw\nmov r0.a, c0.r"),
    ]
};

const fn row(
    modifier: SourceModifier,
    code: u8,
    (prefix, suffix, alias): (&'static str, &'static str, &'static str),
    (arithmetic, coordinates): (VersionSet, VersionSet),
    formula: &'static str,
    meaning: &'static str,
    example: &'static str,
) -> SourceModifierRow {
    SourceModifierRow {
        modifier,
        code,
        prefix,
        suffix,
        alias,
        arithmetic,
        coordinates,
        divides: match modifier {
            SourceModifier::Dz => Some(RegisterFile::Temp),
            SourceModifier::Dw => Some(RegisterFile::Texture),
            _ => None,
        },
        formula,
        meaning,
        example,
    }
}

impl SourceModifierRow {
    /// The versions that have it in one place or the other.
    pub const fn versions(&self) -> VersionSet {
        self.arithmetic.and(self.coordinates)
    }

    /// How it is written around a register of this name: `-r0_bx2`.
    pub fn around(&self, register: &str) -> String {
        format!("{}{register}{}", self.prefix, self.suffix)
    }
}

impl SourceModifier {
    /// Every modifier, by code.
    pub fn all() -> impl Iterator<Item = SourceModifier> {
        SOURCE_MODIFIERS.iter().map(|row| row.modifier)
    }

    /// The row of this modifier.
    pub fn row(self) -> &'static SourceModifierRow {
        &SOURCE_MODIFIERS[self as usize]
    }

    /// The modifier with this token code.
    pub fn from_code(code: u8) -> Option<Self> {
        SOURCE_MODIFIERS
            .get(usize::from(code))
            .map(|row| row.modifier)
    }

    /// The modifier written with this prefix (nothing, `-`, `1-`) and suffix (nothing or `_…`, either spelling).
    pub fn from_text(prefix: &str, suffix: &str) -> Option<Self> {
        let fits = |row: &&SourceModifierRow| {
            row.prefix == prefix
                && (row.suffix == suffix || (!row.alias.is_empty() && row.alias == suffix))
        };
        SOURCE_MODIFIERS.iter().find(fits).map(|row| row.modifier)
    }

    /// Every suffix that is read, with its underscore, in both spellings.
    pub fn suffixes() -> impl Iterator<Item = &'static str> {
        SOURCE_MODIFIERS
            .iter()
            .filter(|row| row.prefix.is_empty())
            .flat_map(|row| [row.suffix, row.alias])
            .filter(|text| !text.is_empty())
    }
}

/// What happens to a result before it is written: first the shift, then the saturation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct ResultModifier {
    /// Power of two that the result is multiplied by, -3 to 3.
    pub shift: i8,
    /// Whether the result is clamped to 0…1.
    pub saturate: bool,
}

/// One suffix of a mnemonic that modifies the result.
#[derive(Debug)]
pub struct ResultSuffix {
    /// The power of two; 0 for the saturation.
    pub shift: i8,
    /// The suffix of the mnemonic.
    pub suffix: &'static str,
    /// Versions that have it.
    pub versions: VersionSet,
    /// The result as a formula in x.
    pub formula: &'static str,
    /// What it is for, in sentences.
    pub meaning: &'static str,
    /// A listing in which it stands, without the version line, that the newest version that has it accepts without a word.
    pub example: &'static str,
}

/// The shifts, one row each.
#[rustfmt::skip]
pub static SHIFTS: [ResultSuffix; 6] = [
    shift(1, "_x2", VersionSet::PS, "2 * x", "Doubles the result.",
        "texld r0, t0\nmul_x2 r0.rgb, r0, v0"),
    shift(2, "_x4", VersionSet::PS, "4 * x", "Multiplies the result by 4.",
        "texld r0, t0\nmul_x4 r0.rgb, r0, v0"),
    shift(3, "_x8", VersionSet::PS_1_4, "8 * x", "Multiplies the result by 8.",
        "texld r0, t0\nmul_x8 r0.rgb, r0, v0"),
    shift(-1, "_d2", VersionSet::PS, "x / 2", "Halves the result.",
        "texld r0, t0\nadd_d2 r0.rgb, r0, v0"),
    shift(-2, "_d4", VersionSet::PS_1_4, "x / 4", "Divides the result by 4.",
        "texld r0, t0\nadd_d4 r0.rgb, r0, v0"),
    shift(-3, "_d8", VersionSet::PS_1_4, "x / 8", "Divides the result by 8.",
        "texld r0, t0\nadd_d8 r0.rgb, r0, v0"),
];

/// The suffix that saturates.
pub static SATURATION: ResultSuffix = ResultSuffix {
    shift: 0,
    suffix: "_sat",
    versions: VersionSet::PS,
    formula: "clamp(x, 0, 1)",
    meaning: "Clamps the result to 0 to 1; NaN becomes 0. With a shift it is applied after it, whichever stands first.",
    example: "texld r0, t0\ndp3_sat r0.rgb, r0_bx2, c0",
};

const fn shift(
    shift: i8,
    suffix: &'static str,
    versions: VersionSet,
    formula: &'static str,
    meaning: &'static str,
    example: &'static str,
) -> ResultSuffix {
    ResultSuffix {
        shift,
        suffix,
        versions,
        formula,
        meaning,
        example,
    }
}

impl ResultSuffix {
    /// Every suffix.
    pub fn all() -> impl Iterator<Item = &'static ResultSuffix> {
        SHIFTS.iter().chain([&SATURATION])
    }
}

impl ResultModifier {
    /// No shift, no saturation.
    pub const NONE: Self = Self {
        shift: 0,
        saturate: false,
    };

    /// The row of this shift; `None` for no shift and for shifts that no version has.
    pub fn shift_row(self) -> Option<&'static ResultSuffix> {
        SHIFTS.iter().find(|row| row.shift == self.shift)
    }

    /// The rows of its suffixes, in the order in which they are written: the shift first.
    pub fn rows(self) -> impl Iterator<Item = &'static ResultSuffix> {
        let saturation = self.saturate.then_some(&SATURATION);
        self.shift_row().into_iter().chain(saturation)
    }

    /// Whether the version has this modifier on arithmetic instructions.
    pub fn exists_in(self, version: Version) -> bool {
        let known = self.shift == 0 || self.shift_row().is_some();
        known && self.rows().all(|row| row.versions.contains(version))
    }

    /// The suffixes of the mnemonic, shift first.
    pub fn text(self) -> String {
        self.rows().map(|row| row.suffix).collect()
    }
}

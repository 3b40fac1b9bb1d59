//! Source modifiers and result modifiers.

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
    /// The value as a formula in x.
    pub formula: &'static str,
}

static SOURCE_MODIFIERS: [SourceModifierRow; 11] = {
    use SourceModifier::*;
    const NO: VersionSet = VersionSet::NONE;
    const PS: VersionSet = VersionSet::PS;
    const PS14: VersionSet = VersionSet::PS_1_4;
    [
        row(None, 0, "", "", "", VersionSet::ALL, NO, "x"),
        row(Negate, 1, "-", "", "", VersionSet::ALL, NO, "-x"),
        row(Bias, 2, "", "_bias", "", PS, NO, "x - 0.5"),
        row(BiasNegate, 3, "-", "_bias", "", PS, NO, "-(x - 0.5)"),
        row(Bx2, 4, "", "_bx2", "", PS, NO, "2 * (x - 0.5)"),
        row(Bx2Negate, 5, "-", "_bx2", "", PS, NO, "-(2 * (x - 0.5))"),
        row(Complement, 6, "1-", "", "", PS, NO, "1 - x"),
        row(X2, 7, "", "_x2", "", PS14, NO, "2 * x"),
        row(X2Negate, 8, "-", "_x2", "", PS14, NO, "-2 * x"),
        row(Dz, 9, "", "_dz", "_db", NO, PS14, "x / z, y / z"),
        row(Dw, 10, "", "_dw", "_da", NO, PS14, "x / w, y / w"),
    ]
};

#[allow(clippy::too_many_arguments)]
const fn row(
    modifier: SourceModifier,
    code: u8,
    prefix: &'static str,
    suffix: &'static str,
    alias: &'static str,
    arithmetic: VersionSet,
    coordinates: VersionSet,
    formula: &'static str,
) -> SourceModifierRow {
    SourceModifierRow {
        modifier,
        code,
        prefix,
        suffix,
        alias,
        arithmetic,
        coordinates,
        formula,
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
pub struct ShiftRow {
    /// The power of two.
    pub shift: i8,
    /// The suffix of the mnemonic.
    pub suffix: &'static str,
    /// Versions that have it.
    pub versions: VersionSet,
}

/// The suffix that saturates; every pixel shader version has it.
pub const SATURATE_SUFFIX: &str = "_sat";

/// The shifts, one row each.
pub static SHIFTS: [ShiftRow; 6] = [
    shift(1, "_x2", VersionSet::PS),
    shift(2, "_x4", VersionSet::PS),
    shift(3, "_x8", VersionSet::PS_1_4),
    shift(-1, "_d2", VersionSet::PS),
    shift(-2, "_d4", VersionSet::PS_1_4),
    shift(-3, "_d8", VersionSet::PS_1_4),
];

const fn shift(shift: i8, suffix: &'static str, versions: VersionSet) -> ShiftRow {
    ShiftRow {
        shift,
        suffix,
        versions,
    }
}

impl ResultModifier {
    /// No shift, no saturation.
    pub const NONE: Self = Self {
        shift: 0,
        saturate: false,
    };

    /// The row of this shift; `None` for no shift and for shifts that no version has.
    pub fn shift_row(self) -> Option<&'static ShiftRow> {
        SHIFTS.iter().find(|row| row.shift == self.shift)
    }

    /// Whether the version has this modifier on arithmetic instructions.
    pub fn exists_in(self, version: Version) -> bool {
        let shift = self.shift == 0
            || self
                .shift_row()
                .is_some_and(|row| row.versions.contains(version));
        shift && (!self.saturate || VersionSet::PS.contains(version))
    }

    /// The suffixes of the mnemonic, shift first.
    pub fn text(self) -> String {
        let shift = self.shift_row().map_or("", |row| row.suffix);
        let saturate = if self.saturate { SATURATE_SUFFIX } else { "" };
        format!("{shift}{saturate}")
    }
}

//! What is written around registers and instructions and is no name: masks, selectors, `+`, `c[a0.x + n]`.

use super::version::VersionSet;

/// A notation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Notation {
    /// Letters behind a destination.
    WriteMask,
    /// Letters behind a source.
    Swizzle,
    /// `+` between two instructions.
    CoIssue,
    /// `c[a0.x + n]`
    Relative,
}

/// One notation.
#[derive(Debug)]
pub struct NotationRow {
    /// The notation that this row describes.
    pub notation: Notation,
    /// What it is called, the first being what it is called here, the rest what it is called elsewhere and how it is written.
    pub names: &'static [&'static str],
    /// What it is in a few words.
    pub title: &'static str,
    /// What holds in all versions, in sentences.
    pub meaning: &'static str,
    /// How tokens hold it.
    pub token: &'static str,
    /// What it is in groups of versions.
    pub forms: &'static [NotationForm],
}

/// A notation as one group of versions has it.
#[derive(Debug)]
pub struct NotationForm {
    /// The versions.
    pub versions: VersionSet,
    /// What is allowed, in sentences.
    pub meaning: &'static str,
    /// A listing in which it stands, without the version line; every one of the versions accepts it without a word.
    pub example: &'static str,
}

/// One row a notation, in the order of [`Notation`].
#[rustfmt::skip]
static NOTATIONS: [NotationRow; 4] = {
    const PS13: VersionSet = VersionSet::PS_1_0_TO_1_3;
    const PS14: VersionSet = VersionSet::PS_1_4;
    [
        NotationRow {
            notation: Notation::WriteMask,
            names: &["mask", "write mask", "writemask"],
            title: "the components that an instruction writes",
            meaning: "Letters behind a destination, in order and none twice; without them all four components are written. xyzw and rgba \
                      mean the same and do not mix. The other components keep what they hold.",
            token: "bits 19:16 of a destination token: x is bit 16, w is bit 19",
            forms: &[
                form(VersionSet::VS, "Any mask. Matrix macros have one component a row, frc has .y or .xy, a0 has .x.",
                    "m4x4 oPos, v0, c0\nmov oT0.xy, v7"),
                form(PS13, "Arithmetic has .rgba, .rgb or .a: there is a pipe for colour and one for alpha. Texture instructions have none.",
                    "tex t0\nmul r0.rgb, t0, v0\nmov r0.a, t0"),
                form(PS14, "Arithmetic has any mask, bem only .rg. texcrd has .rgb, with a divided source .rg; the other texture \
                            instructions have none.",
                    "texld r0, t0\nmul r0.rg, r0, v0"),
            ],
        },
        NotationRow {
            notation: Notation::Swizzle,
            names: &["swizzle", "selector"],
            title: "the components that a source reads",
            meaning: "Letters behind a source, behind its modifier. The first letter says what takes the place of x, the second that of \
                      y; the last is repeated, so that one letter fills all four. xyzw and rgba mean the same and do not mix. It is \
                      applied before the modifier.",
            token: "bits 23:16 of a source token, two bits a component, x lowest: 0 reads x, 3 reads w; 0xE4 is none",
            forms: &[
                form(VersionSet::VS, "Any letters in any order, but on the matrix of a macro. rcp, rsq, exp, log, expp and logp read one \
                                      component and name it by one letter.",
                    "m4x4 oPos, v0, c0\nmov oD0, v5.zyxw"),
                form(VersionSet::PS_1_0, ".a on arithmetic, for all components.",
                    "tex t0\nmul r0, t0, v0.a"),
                form(VersionSet::PS_1_1_TO_1_3, ".a on arithmetic, for all components, and .b where the result goes into .a alone.",
                    "tex t0\nmul r0.rgb, t0, v0.a\nmov r0.a, t0.b"),
                form(PS14, "One of .r, .g, .b and .a on arithmetic. texld and texcrd read t# as .xyz or .xyw and r# as .xyz.",
                    "texld r0, t0.xyz\nmul r0.rgb, r0, r0.a"),
            ],
        },
        NotationRow {
            notation: Notation::CoIssue,
            names: &["+", "pair", "co-issue", "coissue", "co-issued", "pairing"],
            title: "two instructions at once",
            meaning: "A + in front of an arithmetic instruction joins it to the one before: one computes colour while the other computes \
                      alpha. Both read before either writes, and together they take one slot. It may stand behind the first \
                      instruction or on a line of its own. The pair reads at most three registers of a file.",
            token: "bit 30 of the second instruction token",
            forms: &[
                form(VersionSet::PS_1_0, "One half writes .rgb, the other .a, of one register.",
                    "tex t0\nmul r0.rgb, t0, v0\n+mov r0.a, t0"),
                form(VersionSet::PS_1_1_TO_1_3, "One half writes .rgb, the other .a. dp3 is the half for colour, dp4 is neither.",
                    "tex t0\nmul r0.rgb, t0, v0\n+mov r0.a, t0"),
                form(PS14, "One half writes some of r, g and b, the other .a. dp3 is the half for colour, dp4 and bem are neither.",
                    "texld r0, t0\nmul r0.rgb, r0, v0\n+mov r0.a, c0.r"),
            ],
        },
        NotationRow {
            notation: Notation::Relative,
            names: &["c[a0.x]", "relative addressing", "relative", "index"],
            title: "a constant whose number is computed",
            meaning: "Reads the constant whose number is a0.x plus n. Outside of the constants that there are it reads (0, 0, 0, 0). n may be \
                      a sum and stand on either side: c[3 + a0.x + 4] and c4[a0.x + 3] both mean c[a0.x + 7]. Only sources are \
                      addressed so, and mov a0.x comes before.",
            token: "bit 13 of a source token; n stands where the number does",
            forms: &[
                form(VersionSet::VS_1_1, "c[a0.x + n] is a source like any other constant; different n count as different registers.",
                    "mov a0.x, v1.x\nm4x4 oPos, v0, c0\nmul oD0, v5, c[a0.x + 8]"),
            ],
        },
    ]
};

const fn form(versions: VersionSet, meaning: &'static str, example: &'static str) -> NotationForm {
    NotationForm {
        versions,
        meaning,
        example,
    }
}

impl Notation {
    /// Every notation.
    pub fn all() -> impl Iterator<Item = Notation> {
        NOTATIONS.iter().map(|row| row.notation)
    }

    /// The row of this notation.
    pub fn row(self) -> &'static NotationRow {
        &NOTATIONS[self as usize]
    }
}

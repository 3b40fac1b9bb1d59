//! The words in which the rows are written: sets of files, shapes of sources, forms of groups of versions.

use super::{
    Class, DestinationShape, Form, ModifierRule, Opcode, OpcodeRow, Pairing, Slots, SourceShape,
};
use crate::isa::operand::{MaskSet, WriteMask};
use crate::isa::register::{FileSet, RegisterFile};
use crate::isa::version::VersionSet;

use RegisterFile::{Addr, AttrOut, Const, Input, RastOut, Temp, TexCrdOut, Texture};

pub(super) const XY: WriteMask = WriteMask::XY;
pub(super) const XYZ: WriteMask = WriteMask::XYZ;
pub(super) const XYZW: WriteMask = WriteMask::ALL;
pub(super) const W: WriteMask = WriteMask::W;
pub(super) const VS: VersionSet = VersionSet::VS;
pub(super) const PS: VersionSet = VersionSet::PS;
pub(super) const PS13: VersionSet = VersionSet::PS_1_0_TO_1_3;
pub(super) const PS12: VersionSet = VersionSet::PS_1_2_TO_1_3;
pub(super) const PS14: VersionSet = VersionSet::PS_1_4;

pub(super) const VS_OUT: FileSet = FileSet::of(&[Temp, RastOut, AttrOut, TexCrdOut]);
pub(super) const VS_OUT_A0: FileSet = FileSet::of(&[Temp, RastOut, AttrOut, TexCrdOut, Addr]);
pub(super) const VS_IN: FileSet = FileSet::of(&[Temp, Input, Const]);
pub(super) const R: FileSet = FileSet::of(&[Temp]);
pub(super) const T: FileSet = FileSet::of(&[Texture]);
pub(super) const C: FileSet = FileSet::of(&[Const]);
pub(super) const RT: FileSet = FileSet::of(&[Temp, Texture]);
pub(super) const RTVC: FileSet = FileSet::of(&[Temp, Texture, Input, Const]);
pub(super) const RVC: FileSet = FileSet::of(&[Temp, Input, Const]);
pub(super) const RC: FileSet = FileSet::of(&[Temp, Const]);

pub(super) const fn source(files: FileSet, slots: Slots, modifiers: ModifierRule) -> SourceShape {
    SourceShape {
        files,
        slots,
        modifiers,
    }
}

pub(super) const fn arithmetic(files: FileSet, slots: Slots) -> SourceShape {
    source(files, slots, ModifierRule::Arithmetic)
}

pub(super) const fn fixed(files: FileSet, slots: WriteMask) -> SourceShape {
    arithmetic(files, Slots::Fixed(slots))
}

pub(super) const fn masked(files: FileSet) -> SourceShape {
    arithmetic(files, Slots::Masked)
}

pub(super) const fn matrix(slots: WriteMask) -> SourceShape {
    source(VS_IN, Slots::Fixed(slots), ModifierRule::Matrix)
}

/// The t# source of a texture instruction of `ps.1.0` to `ps.1.3`, with `_bx2` in these versions.
pub(super) const fn texel(slots: WriteMask, bx2: VersionSet) -> SourceShape {
    source(T, Slots::Fixed(slots), ModifierRule::Bx2(bx2))
}

pub(super) const fn coordinates(files: FileSet) -> SourceShape {
    source(files, Slots::Fixed(XYZ), ModifierRule::Coordinates)
}

pub(super) const fn form(
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
        note: "",
        example: "",
    }
}

pub(super) const fn vs(sources: &'static [SourceShape], formula: &'static str) -> Form {
    form(
        VS,
        Class::Arithmetic,
        VS_OUT,
        MaskSet::ANY,
        sources,
        formula,
    )
}

pub(super) const fn vs_matrix(
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
pub(super) const fn ps13(sources: &'static [SourceShape], formula: &'static str) -> Form {
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
pub(super) const fn ps14(sources: &'static [SourceShape], formula: &'static str) -> Form {
    let form = form(PS14, Class::Arithmetic, R, MaskSet::ANY, sources, formula);
    form.pairs(Pairing::Either)
}

/// A texture instruction of `ps.1.0` to `ps.1.3`.
pub(super) const fn tex13(sources: &'static [SourceShape], formula: &'static str) -> Form {
    form(PS13, Class::Texture, T, MaskSet::FULL, sources, formula)
}

pub(super) const fn bare(versions: VersionSet, class: Class, formula: &'static str) -> Form {
    let mut form = form(versions, class, FileSet::NONE, MaskSet::FULL, &[], formula);
    form.destination = None;
    form
}

impl Form {
    pub(super) const fn of(mut self, versions: VersionSet) -> Self {
        self.versions = versions;
        self
    }

    pub(super) const fn costs(mut self, arithmetic: u32, texture: u32) -> Self {
        self.arithmetic_slots = arithmetic;
        self.texture_slots = texture;
        self
    }

    pub(super) const fn at_most(mut self, most: u32) -> Self {
        self.most = Some(most);
        self
    }

    pub(super) const fn pairs(mut self, pairing: Pairing) -> Self {
        self.pairing = pairing;
        self
    }

    pub(super) const fn to(mut self, files: FileSet, masks: MaskSet) -> Self {
        self.destination = Some(DestinationShape {
            files,
            masks,
            written: true,
        });
        self
    }

    /// The form with a listing that shows it.
    pub(super) const fn shown(mut self, example: &'static str) -> Self {
        self.example = example;
        self
    }

    /// The form with what is special about it.
    pub(super) const fn noted(mut self, note: &'static str) -> Self {
        self.note = note;
        self
    }

    pub(super) const fn only_looks(mut self) -> Self {
        if let Some(mut shape) = self.destination {
            shape.written = false;
            self.destination = Some(shape);
        }
        self
    }
}

/// A row: names, title, its relatives, meaning, forms.
pub(super) const fn op(
    opcode: Opcode,
    (mnemonic, token): (&'static str, u16),
    title: &'static str,
    see: &'static [Opcode],
    meaning: &'static str,
    forms: &'static [Form],
) -> OpcodeRow {
    OpcodeRow {
        opcode,
        mnemonic,
        token,
        title,
        meaning,
        see,
        forms,
    }
}

pub(super) const V1: &[SourceShape] = &[masked(VS_IN)];
pub(super) const V2: &[SourceShape] = &[masked(VS_IN), masked(VS_IN)];
pub(super) const V3: &[SourceShape] = &[masked(VS_IN), masked(VS_IN), masked(VS_IN)];
pub(super) const VSCALAR: &[SourceShape] = &[fixed(VS_IN, W)];
pub(super) const P1: &[SourceShape] = &[masked(RTVC)];
pub(super) const P2: &[SourceShape] = &[masked(RTVC), masked(RTVC)];
pub(super) const P3: &[SourceShape] = &[masked(RTVC), masked(RTVC), masked(RTVC)];
pub(super) const Q1: &[SourceShape] = &[masked(RVC)];
pub(super) const Q2: &[SourceShape] = &[masked(RVC), masked(RVC)];
pub(super) const Q3: &[SourceShape] = &[masked(RVC), masked(RVC), masked(RVC)];
pub(super) const ROW: &[SourceShape] = &[texel(XYZ, PS13)];

//! The texture instructions of `ps.1.0` to `ps.1.3`: one a stage, in the order of the stages.

use super::maker::{Maker, TRIES, instruction, texture_source};
use super::operand::destination;
use crate::isa::opcode::ModifierRule;
use crate::isa::{Class, Opcode, RegisterFile, SourceModifier, Swizzle, Version, WriteMask};
use crate::program::{Instruction, Register};
use crate::texture::TextureKind;

/// The rows before the last one of a matrix, by the instruction of the last.
fn pads(opcode: Opcode) -> &'static [Opcode] {
    match opcode {
        Opcode::TexM3x2Tex | Opcode::TexM3x2Depth => &[Opcode::TexM3x2Pad],
        Opcode::TexM3x3Tex | Opcode::TexM3x3Spec | Opcode::TexM3x3VSpec | Opcode::TexM3x3 => {
            &[Opcode::TexM3x3Pad, Opcode::TexM3x3Pad]
        }
        _ => &[],
    }
}

/// Whether it has two coordinates only, which is enough for a flat texture alone.
fn is_flat(opcode: Opcode) -> bool {
    matches!(
        opcode,
        Opcode::TexBem
            | Opcode::TexBeml
            | Opcode::TexReg2Ar
            | Opcode::TexReg2Gb
            | Opcode::TexM3x2Tex
            | Opcode::TexDp3Tex
    )
}

impl Maker<'_> {
    /// Fills the stages, each with what it may hold, or with nothing.
    pub(super) fn fill_stages(&mut self) {
        let count = RegisterFile::Texture.count(self.version);
        let mut stage = 0;
        while stage < count {
            stage += if self.random.chance(self.weights().textures) {
                self.fill_stage(stage, count).max(1)
            } else {
                1
            };
        }
    }

    /// Returns how many stages were used.
    fn fill_stage(&mut self, stage: u32, count: u32) -> u32 {
        for _ in 0..TRIES {
            let opcodes = self.stage_opcodes(stage, count);
            let Some(opcode) = self.random.weighted(&opcodes) else {
                return 0;
            };
            let Some(group) = self.texture_group(opcode, stage) else {
                continue;
            };
            let used = group.len() as u32;
            if self.offer(group) {
                return used;
            }
        }
        0
    }

    /// What may stand at a stage, pads by the instruction that they lead to.
    fn stage_opcodes(&self, stage: u32, count: u32) -> Vec<(Opcode, u32)> {
        let kind = |last: u32| self.stages.get(last as usize).map(|s| s.kind);
        Opcode::all()
            .filter_map(|opcode| {
                let form = opcode.form(self.version)?;
                let pad = matches!(opcode, Opcode::TexM3x2Pad | Opcode::TexM3x3Pad);
                if form.class != Class::Texture || pad {
                    return None;
                }
                let last = stage + pads(opcode).len() as u32;
                let bumps = matches!(opcode, Opcode::TexBem | Opcode::TexBeml);
                let sources =
                    form.sources.is_empty() || !self.registers.texels(stage, bumps).is_empty();
                let fits = last < count
                    && sources
                    && (!is_flat(opcode) || kind(last) == Some(TextureKind::Texture2D));
                // What needs stages before it has fewer places to stand.
                let weight = match form.sources.len() {
                    0 => 2,
                    _ => 3 * (1 + pads(opcode).len() as u32),
                };
                fits.then(|| (opcode, weight * self.weights().of(opcode)))
            })
            .collect()
    }

    /// An instruction with the pads before it; all rows read the same `t#` (T6).
    fn texture_group(&mut self, opcode: Opcode, stage: u32) -> Option<Vec<Instruction>> {
        let mut rows = pads(opcode).to_vec();
        rows.push(opcode);
        let bumps = matches!(opcode, Opcode::TexBem | Opcode::TexBeml);
        let texel = self.random.pick(&self.registers.texels(stage, bumps));
        let mut group = Vec::with_capacity(rows.len());
        let signed = self.random.chance(50);
        for (row, opcode) in rows.into_iter().enumerate() {
            let form = opcode.form(self.version)?;
            let mut sources = Vec::new();
            for shape in form.sources {
                if shape.files.contains(RegisterFile::Const) {
                    let count = RegisterFile::Const.count(self.version);
                    let eye = self.random.below(count);
                    let none = SourceModifier::None;
                    let eye = texture_source(RegisterFile::Const, eye, Swizzle::IDENTITY, none);
                    sources.push(eye);
                    continue;
                }
                let takes = |versions: crate::isa::VersionSet, version: Version| {
                    versions.contains(version) && signed
                };
                let modifier = match shape.modifiers {
                    ModifierRule::Bx2(versions) if takes(versions, self.version) => {
                        SourceModifier::Bx2
                    }
                    _ => SourceModifier::None,
                };
                let file = RegisterFile::Texture;
                sources.push(texture_source(file, texel?, Swizzle::IDENTITY, modifier));
            }
            let register = Register::new(RegisterFile::Texture, stage + row as u32);
            let to = destination(register, WriteMask::ALL);
            group.push(instruction(opcode, Some(to), sources));
        }
        Some(group)
    }
}

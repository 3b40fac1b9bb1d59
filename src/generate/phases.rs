//! The texture instructions of `ps.1.4`, which name their coordinates.

use super::maker::{Maker, TRIES, instruction, texture_source};
use super::operand::destination;
use crate::isa::{Opcode, RegisterFile, SourceModifier, Swizzle, WriteMask};
use crate::program::{Instruction, Register, Source};
use crate::texture::TextureKind;

/// The register of `texdepth` (O14).
const DEPTH: Register = Register::new(RegisterFile::Temp, 5);
/// How often a shader may divide by the third component (B9).
const DIVISIONS: u32 = 2;

impl Maker<'_> {
    /// Texture instructions at the start of a phase.
    pub(super) fn fill_phase(&mut self) {
        for _ in 0..self.texture_left {
            if !self.random.chance(self.weights().textures) {
                continue;
            }
            for _ in 0..TRIES {
                let found = self.phase_instruction();
                if found.is_some_and(|instruction| self.offer(vec![instruction])) {
                    break;
                }
            }
        }
    }

    fn phase_instruction(&mut self) -> Option<Instruction> {
        let weight =
            |maker: &Self, opcode: Opcode, times: u32| (opcode, times * maker.weights().of(opcode));
        let depth = self.registers.has_phase
            && !self.registers.first_phase
            && self
                .registers
                .temporary(DEPTH.index)
                .contains(WriteMask::XY);
        let opcodes = [
            weight(self, Opcode::TexLd, 6),
            weight(self, Opcode::TexCrd, 2),
            weight(self, Opcode::TexKill, 1),
            weight(self, Opcode::TexDepth, if depth { 2 } else { 0 }),
        ];
        match self.random.weighted(&opcodes)? {
            Opcode::TexLd => self.load(),
            Opcode::TexCrd => self.coordinates(),
            Opcode::TexKill => self.kill(),
            opcode => {
                let register = destination(DEPTH, WriteMask::ALL);
                Some(instruction(opcode, Some(register), Vec::new()))
            }
        }
    }

    /// `texld` from coordinates, after `phase` also from what was computed before it.
    fn load(&mut self) -> Option<Instruction> {
        let count = RegisterFile::Temp.count(self.version);
        let stage = self.random.below(count);
        let flat = self.stages.get(stage as usize)?.kind == TextureKind::Texture2D;
        let computed = self.computed_before();
        let dependent = !computed.is_empty() && self.random.chance(60);
        let source = if dependent {
            let register = self.random.pick(&computed)?;
            let divides = flat && self.divisions() < DIVISIONS && self.random.chance(30);
            let modifier = if divides {
                SourceModifier::Dz
            } else {
                SourceModifier::None
            };
            let swizzle = self.random.pick(&[Swizzle::IDENTITY, Swizzle::XYZZ])?;
            texture_source(RegisterFile::Temp, register, swizzle, modifier)
        } else {
            self.coordinate_set(flat)?
        };
        let to = destination(Register::new(RegisterFile::Temp, stage), WriteMask::ALL);
        Some(instruction(Opcode::TexLd, Some(to), vec![source]))
    }

    fn divisions(&self) -> u32 {
        let sources = self.program.instructions().flat_map(|i| &i.sources);
        sources.filter(|s| s.modifier == SourceModifier::Dz).count() as u32
    }

    /// `t#`, which is read as `.xyz` or as `.xyw` in the whole shader (M11).
    fn coordinate_set(&mut self, may_divide: bool) -> Option<Source> {
        let file = RegisterFile::Texture;
        let index = self.random.below(file.count(self.version));
        let all = self.program.instructions().flat_map(|i| &i.sources);
        let mut before = all.filter(|s| s.register == Register::new(file, index));
        let with_w = match before.next() {
            Some(source) => source.swizzle == Swizzle::XYWW,
            None => self.random.chance(40),
        };
        let (swizzle, modifier) = if with_w {
            let divides = may_divide && self.random.chance(50);
            let modifier = if divides {
                SourceModifier::Dw
            } else {
                SourceModifier::None
            };
            (Swizzle::XYWW, modifier)
        } else {
            let swizzle = self.random.pick(&[Swizzle::IDENTITY, Swizzle::XYZZ])?;
            (swizzle, SourceModifier::None)
        };
        Some(texture_source(file, index, swizzle, modifier))
    }

    /// `texcrd`, whose mask depends on whether it divides (O12).
    fn coordinates(&mut self) -> Option<Instruction> {
        let source = self.coordinate_set(true)?;
        let mask = if source.modifier == SourceModifier::Dw {
            WriteMask::XY
        } else {
            WriteMask::XYZ
        };
        let count = RegisterFile::Temp.count(self.version);
        // The register of texdepth now and then, so that it has something to divide.
        let wants_depth = self.random.chance(self.weights().depth);
        let index = if wants_depth && self.registers.first_phase {
            DEPTH.index
        } else {
            self.random.below(count)
        };
        let to = destination(Register::new(RegisterFile::Temp, index), mask);
        Some(instruction(Opcode::TexCrd, Some(to), vec![source]))
    }

    /// The `r#` that texture instructions may read: after `phase` those that were computed before it (T13).
    fn computed_before(&self) -> Vec<u32> {
        match self.registers.first_phase {
            true => Vec::new(),
            false => self.registers.dependent(),
        }
    }

    /// `texkill` of coordinates or of what was computed before `phase`.
    fn kill(&mut self) -> Option<Instruction> {
        let mut registers: Vec<Register> = (0..RegisterFile::Texture.count(self.version))
            .map(|i| Register::new(RegisterFile::Texture, i))
            .collect();
        let computed = self.computed_before().into_iter();
        registers.extend(computed.map(|i| Register::new(RegisterFile::Temp, i)));
        let register = self.random.pick(&registers)?;
        let looked_at = destination(register, WriteMask::ALL);
        Some(instruction(Opcode::TexKill, Some(looked_at), Vec::new()))
    }
}

//! What may be read: which components of which register hold a value.

use crate::isa::register::OPOS;
use crate::isa::{Class, Form, Opcode, RegisterFile, ShaderKind, Version, VersionSet, WriteMask};
use crate::program::{Instruction, Register};

const TEMPORARIES: usize = 12;
const STAGES: usize = 4;
const SETS: usize = 8;

/// One `t#` of `ps.1.0` to `ps.1.3`.
#[derive(Clone, Copy)]
struct Texel {
    written: WriteMask,
    /// Components that `texbem` or `texbeml` has read: nothing else may (T9).
    bumped: WriteMask,
    /// Whether a texture instruction that depends on no other has left all of it: only such are read by texture
    /// instructions, since longer chains are warned of (T12).
    plain: bool,
}

/// The registers of a shader that is being written.
#[derive(Clone)]
pub(super) struct Registers {
    version: Version,
    temporaries: [WriteMask; TEMPORARIES],
    /// What held a value at `phase`.
    before_phase: [WriteMask; TEMPORARIES],
    /// Whether a texture instruction of the second phase has written it.
    sampled: [bool; TEMPORARIES],
    texels: [Texel; STAGES],
    /// Whether `a0.x` has a value.
    pub(super) address: bool,
    /// Components of `oPos`.
    pub(super) position: WriteMask,
    /// Components of `oT#`.
    pub(super) coordinates: [WriteMask; SETS],
    /// `ps.1.4`: whether the first phase is being written.
    pub(super) first_phase: bool,
    /// Whether the shader has `phase`.
    pub(super) has_phase: bool,
}

impl Registers {
    pub(super) fn new(version: Version, first_phase: bool) -> Self {
        Self {
            version,
            temporaries: [WriteMask::NONE; TEMPORARIES],
            before_phase: [WriteMask::NONE; TEMPORARIES],
            sampled: [false; TEMPORARIES],
            texels: [Texel {
                written: WriteMask::NONE,
                bumped: WriteMask::NONE,
                plain: false,
            }; STAGES],
            address: false,
            position: WriteMask::NONE,
            coordinates: [WriteMask::NONE; SETS],
            first_phase,
            has_phase: first_phase,
        }
    }

    fn has_stages(&self) -> bool {
        VersionSet::PS_1_0_TO_1_3.contains(self.version)
    }

    /// The components of a temporary that hold a value.
    pub(super) fn temporary(&self, index: u32) -> WriteMask {
        let at = self.temporaries.get(index as usize);
        at.copied().unwrap_or(WriteMask::NONE)
    }

    /// The components that arithmetic may read.
    pub(super) fn readable(&self, register: Register) -> WriteMask {
        if !register.relative && register.index >= register.file.count(self.version) {
            return WriteMask::NONE;
        }
        match register.file {
            RegisterFile::Temp => self.temporary(register.index),
            RegisterFile::Const => WriteMask::ALL,
            RegisterFile::Input if self.first_phase => WriteMask::NONE,
            RegisterFile::Input => WriteMask::ALL,
            RegisterFile::Texture if self.has_stages() => {
                let texel = self.texels.get(register.index as usize);
                texel.map_or(WriteMask::NONE, |t| t.written.without(t.bumped))
            }
            _ => WriteMask::NONE,
        }
    }

    /// The `t#` that a texture instruction at this stage may read.
    pub(super) fn texels(&self, stage: u32, bumps: bool) -> Vec<u32> {
        let usable = |t: &Texel| t.plain && (bumps || t.bumped.is_empty());
        let below = self.texels.iter().take(stage as usize).enumerate();
        let found = below.filter(|(_, t)| usable(t));
        found.map(|(i, _)| i as u32).collect()
    }

    /// The `r#` that `texld` may read in the second phase of `ps.1.4`.
    pub(super) fn dependent(&self) -> Vec<u32> {
        let usable = |r: &usize| {
            !self.sampled[*r]
                && self.before_phase[*r].contains(WriteMask::XYZ)
                && self.temporaries[*r].contains(WriteMask::XYZ)
        };
        (0..TEMPORARIES).filter(usable).map(|r| r as u32).collect()
    }

    /// What an instruction does to the registers.
    pub(super) fn apply(&mut self, instruction: &Instruction, form: &Form) {
        if form.class == Class::Phase {
            self.pass_phase();
            return;
        }
        let Some(destination) = instruction.destination else {
            return;
        };
        let at = destination.register.index as usize;
        if form.class == Class::Texture && self.has_stages() {
            self.texture_stage(instruction, at);
            return;
        }
        let mask = destination.mask;
        match destination.register.file {
            RegisterFile::Temp => {
                let Some(temporary) = self.temporaries.get_mut(at) else {
                    return;
                };
                *temporary = match instruction.opcode {
                    Opcode::TexKill => return,
                    Opcode::TexDepth => WriteMask::NONE,
                    // What it does not write has no value any more.
                    Opcode::TexCrd => mask,
                    _ => temporary.or(mask),
                };
                if form.class == Class::Texture && !self.first_phase {
                    self.sampled[at] = true;
                }
            }
            RegisterFile::Texture => {
                if let Some(texel) = self
                    .texels
                    .get_mut(at)
                    .filter(|_| form.class != Class::Texture)
                {
                    texel.written = texel.written.or(mask);
                    texel.bumped = texel.bumped.without(mask);
                }
            }
            RegisterFile::Addr => self.address = true,
            RegisterFile::RastOut if destination.register.index == OPOS => {
                self.position = self.position.or(mask);
            }
            RegisterFile::TexCrdOut => {
                if let Some(set) = self.coordinates.get_mut(at) {
                    *set = set.or(mask);
                }
            }
            _ => {}
        }
    }

    fn pass_phase(&mut self) {
        for temporary in &mut self.temporaries {
            *temporary = temporary.without(WriteMask::W);
        }
        self.before_phase = self.temporaries;
        self.first_phase = false;
    }

    fn texture_stage(&mut self, instruction: &Instruction, at: usize) {
        let bumps = matches!(instruction.opcode, Opcode::TexBem | Opcode::TexBeml);
        let read = instruction
            .sources
            .first()
            .map(|s| s.register.index as usize);
        if let Some(texel) = read.and_then(|r| self.texels.get_mut(r)).filter(|_| bumps) {
            texel.bumped = WriteMask::ALL;
        }
        let Some(texel) = self.texels.get_mut(at) else {
            return;
        };
        let readable = !matches!(
            instruction.opcode,
            Opcode::TexKill | Opcode::TexM3x2Pad | Opcode::TexM3x3Pad | Opcode::TexM3x2Depth
        );
        texel.plain = readable && instruction.sources.is_empty();
        texel.written = if readable {
            WriteMask::ALL
        } else {
            WriteMask::NONE
        };
    }

    /// The components of the result that have no value yet: of `r0`, or of `oPos`.
    pub(super) fn missing(&self) -> WriteMask {
        let written = match self.version.kind() {
            ShaderKind::Pixel => self.temporary(0),
            ShaderKind::Vertex => self.position,
        };
        WriteMask::ALL.without(written)
    }
}

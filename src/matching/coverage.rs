//! What occurs in shaders, against everything that could.

use crate::exec::Machine;
use crate::generate::{Generated, INVOCATIONS, Textures};
use crate::isa::modifier::SHIFTS;
use crate::isa::register::VERTEX_CONSTANTS;
use crate::isa::{
    Class, Opcode, RegisterFile, ResultModifier, ShaderKind, SourceModifier, Version, WriteMask,
};
use crate::kernel::{Place, Projection, Slot};
use crate::program::{Register, letters};
use crate::texture::TextureKind;
use std::collections::BTreeMap;

/// A kind of things that are counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Group {
    /// Instructions by their mnemonics.
    Instructions,
    /// Write masks of each instruction that takes more than one.
    Masks,
    /// Source modifiers.
    Modifiers,
    /// Shifts and saturation.
    Results,
    /// Pairs with either half first, and phases.
    Structure,
    /// Registers that are written.
    Registers,
    /// Kinds of textures that are sampled, and projections.
    Textures,
    /// Ways that are taken: discarded or not, constants addressed within and outside of those there are.
    Ways,
}

impl Group {
    /// All groups.
    pub const ALL: [Self; 8] = [
        Self::Instructions,
        Self::Masks,
        Self::Modifiers,
        Self::Results,
        Self::Structure,
        Self::Registers,
        Self::Textures,
        Self::Ways,
    ];

    /// Its name: `instructions`, `masks` and so on.
    pub fn name(self) -> &'static str {
        match self {
            Self::Instructions => "instructions",
            Self::Masks => "masks",
            Self::Modifiers => "modifiers",
            Self::Results => "results",
            Self::Structure => "structure",
            Self::Registers => "registers",
            Self::Textures => "textures",
            Self::Ways => "ways",
        }
    }
}

/// In how many shaders of each version what occurs.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Coverage {
    counts: BTreeMap<(&'static str, Group, String), u64>,
}

impl Coverage {
    /// How many shaders of a version have something.
    pub fn of(&self, version: Version, group: Group, name: &str) -> u64 {
        let key = (version.name(), group, name.to_owned());
        self.counts.get(&key).copied().unwrap_or(0)
    }

    /// Takes over the counts of another.
    pub(super) fn add(&mut self, other: &Self) {
        for (key, count) in &other.counts {
            *self.counts.entry(key.clone()).or_default() += count;
        }
    }

    /// Counts what occurs in a shader.
    pub(super) fn count(&mut self, generated: &Generated, textures: &Textures) {
        let version = generated.program.version;
        let mut found = occurring(generated, textures);
        found.sort();
        found.dedup();
        for (group, name) in found {
            *self
                .counts
                .entry((version.name(), group, name))
                .or_default() += 1;
        }
    }

    /// Everything that shaders of a version can have, from the rows of [`crate::isa`].
    pub fn possible(version: Version) -> Vec<(Group, String)> {
        let mut all = Vec::new();
        let mut push = |group: Group, name: String| all.push((group, name));
        for opcode in Opcode::all() {
            let Some(form) = opcode.form(version) else {
                continue;
            };
            if form.class == Class::Declaration {
                continue;
            }
            push(Group::Instructions, opcode.mnemonic().into());
            let shape = form.destination.filter(|_| form.class == Class::Arithmetic);
            for mask in shape.iter().flat_map(|shape| shape.masks.iter()) {
                push(Group::Masks, masked(opcode, mask, version));
            }
        }
        let has = |modifier: &SourceModifier| {
            let row = modifier.row();
            row.arithmetic.and(row.coordinates).contains(version)
        };
        let modifiers = SourceModifier::all().filter(has);
        modifiers.for_each(|m| push(Group::Modifiers, named(m)));
        let shifts = SHIFTS.iter().map(|row| row.shift).chain([0]);
        let results = shifts
            .flat_map(|shift| [false, true].map(|saturate| ResultModifier { shift, saturate }));
        let there = results.filter(|r| *r != ResultModifier::NONE && r.exists_in(version));
        there.for_each(|result| push(Group::Results, result.text()));
        match version.kind() {
            ShaderKind::Vertex => {
                let files = [
                    RegisterFile::Temp,
                    RegisterFile::Addr,
                    RegisterFile::RastOut,
                    RegisterFile::AttrOut,
                    RegisterFile::TexCrdOut,
                ];
                for file in files {
                    for index in 0..file.count(version) {
                        push(
                            Group::Registers,
                            register(Register::new(file, index), version),
                        );
                    }
                }
                if RegisterFile::Addr.count(version) > 0 {
                    push(Group::Ways, INSIDE.into());
                    push(Group::Ways, OUTSIDE.into());
                }
            }
            ShaderKind::Pixel => {
                for pair in [COLOR_FIRST, ALPHA_FIRST] {
                    push(Group::Structure, pair.into());
                }
                if version.row().phases > 1 {
                    for phases in [ONE_PHASE, TWO_PHASES] {
                        push(Group::Structure, phases.into());
                    }
                }
                for index in 0..RegisterFile::Temp.count(version) {
                    let temp = Register::new(RegisterFile::Temp, index);
                    push(Group::Registers, register(temp, version));
                }
                for kind in [
                    TextureKind::Texture2D,
                    TextureKind::Cube,
                    TextureKind::Volume,
                ] {
                    for signed in [false, true] {
                        push(Group::Textures, sampled(kind, signed));
                    }
                }
                if Opcode::Tex.form(version).is_some() {
                    push(Group::Textures, PROJECTED.into());
                }
                for way in [KILLED, KEPT] {
                    push(Group::Ways, way.into());
                }
            }
        }
        all
    }

    /// What shaders of a version can have and none had.
    pub fn missing(&self, version: Version) -> Vec<(Group, String)> {
        let mut possible = Self::possible(version);
        possible.retain(|(group, name)| self.of(version, *group, name) == 0);
        possible
    }

    /// How much of a group occurred in a version, and how much there is.
    pub fn reached(&self, version: Version, group: Group) -> (usize, usize) {
        let possible = Self::possible(version);
        let of_group = possible.iter().filter(|(g, _)| *g == group);
        let (mut reached, mut all) = (0, 0);
        for (_, name) in of_group {
            all += 1;
            reached += usize::from(self.of(version, group, name) > 0);
        }
        (reached, all)
    }
}

const COLOR_FIRST: &str = "pair, colour first";
const ALPHA_FIRST: &str = "pair, alpha first";
const ONE_PHASE: &str = "one phase";
const TWO_PHASES: &str = "two phases";
const PROJECTED: &str = "projected";
const KILLED: &str = "discarded";
const KEPT: &str = "texkill, not discarded";
const INSIDE: &str = "c[a0.x] that there is";
const OUTSIDE: &str = "c[a0.x] that there is not";

fn masked(opcode: Opcode, mask: WriteMask, version: Version) -> String {
    format!(
        "{}.{}",
        opcode.mnemonic(),
        mask.text(letters(version.kind()))
    )
}

fn named(modifier: SourceModifier) -> String {
    let row = modifier.row();
    format!("{}x{}", row.prefix, row.suffix)
}

fn sampled(kind: TextureKind, signed: bool) -> String {
    format!("{kind}{}", if signed { ", signed" } else { "" })
}

fn register(register: Register, version: Version) -> String {
    Slot::of(register, version).map_or_else(String::new, |slot| slot.name(version.kind()))
}

fn occurring(generated: &Generated, textures: &Textures) -> Vec<(Group, String)> {
    let program = &generated.program;
    let version = program.version;
    let mut all = Vec::new();
    let instructions: Vec<_> = program.instructions().collect();
    for (number, instruction) in instructions.iter().enumerate() {
        let opcode = instruction.opcode;
        all.push((Group::Instructions, opcode.mnemonic().to_owned()));
        if let Some(destination) = instruction.destination {
            all.push((Group::Masks, masked(opcode, destination.mask, version)));
            all.push((Group::Registers, register(destination.register, version)));
        }
        for source in &instruction.sources {
            all.push((Group::Modifiers, named(source.modifier)));
        }
        all.push((Group::Results, instruction.result.text()));
        let first = number.checked_sub(1).and_then(|n| instructions.get(n));
        if let Some(first) = first.filter(|_| instruction.co_issue) {
            let alpha = first.destination.is_some_and(|d| d.mask == WriteMask::W);
            let pair = if alpha { ALPHA_FIRST } else { COLOR_FIRST };
            all.push((Group::Structure, pair.to_owned()));
        }
    }
    if version.row().phases > 1 {
        let two = instructions.iter().any(|i| i.opcode == Opcode::Phase);
        let phases = if two { TWO_PHASES } else { ONE_PHASE };
        all.push((Group::Structure, phases.to_owned()));
    }
    let Ok(kernel) = generated.lower(program) else {
        return all;
    };
    let stages = kernel.stages();
    for (number, stage) in generated.stages.iter().enumerate() {
        if stages >> number & 1 == 1 {
            all.push((Group::Textures, sampled(stage.kind, stage.signed)));
            if stage.projection != Projection::None {
                all.push((Group::Textures, PROJECTED.to_owned()));
            }
        }
    }
    if kernel.kills() {
        for killed in generated.killed {
            all.push((Group::Ways, if killed { KILLED } else { KEPT }.to_owned()));
        }
    }
    let offsets = (kernel.steps.iter().flat_map(|step| &step.sources)).filter_map(|source| {
        match source.place {
            Place::Relative(offset) => Some(offset),
            _ => None,
        }
    });
    // The address at the end stands for that at the read: shaders seldom write it twice.
    let mut machine = None;
    for offset in offsets {
        let machine = machine.get_or_insert_with(|| {
            let mut machine = Machine::<INVOCATIONS>::new();
            generated.load(&mut machine, 0);
            machine.run(&kernel, &generated.environment(&kernel, textures));
            machine
        });
        for lane in 0..INVOCATIONS {
            let index = f64::from(machine.lane(Slot::ADDRESS, lane)[0]) + f64::from(offset);
            let inside = (0.0..f64::from(VERTEX_CONSTANTS)).contains(&index);
            all.push((
                Group::Ways,
                if inside { INSIDE } else { OUTSIDE }.to_owned(),
            ));
        }
    }
    all
}

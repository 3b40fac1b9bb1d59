//! How much of what a version offers a shader uses.

use super::budgets;
use super::listing::{Line, Listing};
use crate::isa::{Opcode, RegisterFile, Version};
use crate::program::Program;
use std::collections::BTreeSet;

/// An amount of a budget.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Usage {
    /// How much is used; more than allowed if the shader breaks a rule.
    pub used: u32,
    /// How much the version allows.
    pub allowed: u32,
}

/// The slots of one phase.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PhaseSlots {
    /// Arithmetic slots, a pair counted once; in a vertex shader all slots, macros counted as they expand.
    pub arithmetic: Usage,
    /// Texture slots; 0 of 0 in a vertex shader.
    pub texture: Usage,
}

/// The registers of one file that a shader names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileUsage {
    /// The file.
    pub file: RegisterFile,
    /// The numbers that are named, each once, in order. The rows of a matrix count, relative operands do not:
    /// which register they name is known only when the shader runs.
    pub numbers: Vec<u32>,
    /// How many registers the version has.
    pub allowed: u32,
}

/// What a shader uses, for `check --stats`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Statistics {
    /// The version, which the allowed amounts are of.
    pub version: Version,
    /// Slots, one entry a phase: two if the shader has `phase`, otherwise one.
    pub phases: Vec<PhaseSlots>,
    /// Every file that the version has.
    pub files: Vec<FileUsage>,
    /// Pixel shaders: the texture stages that are sampled, in order.
    pub stages: Vec<u32>,
    /// Pixel shaders: the sets of texture coordinates that are read, in order.
    pub coordinate_sets: Vec<u32>,
    /// Whether constants are addressed relative to `a0.x`, so that all of them may be read.
    pub relative: bool,
}

/// Counts what a shader uses. Works on shaders that break rules, too.
pub fn statistics(program: &Program) -> Statistics {
    let listing = Listing::new(program, &[]);
    let limit = listing.version.row();
    let slots = budgets::slots(&listing);
    let phases = if listing.has_phase {
        &slots[..]
    } else {
        &slots[1..]
    };
    let phases = phases.iter().map(|slots| PhaseSlots {
        arithmetic: Usage {
            used: slots.arithmetic,
            allowed: limit.arithmetic_slots,
        },
        texture: Usage {
            used: slots.texture,
            allowed: limit.texture_slots,
        },
    });
    let named = named_registers(&listing);
    let files = RegisterFile::all().filter(|f| f.count(listing.version) > 0);
    let mut stages = BTreeSet::new();
    let mut coordinate_sets = BTreeSet::new();
    for line in &listing.lines {
        stages.extend(sampled_stage(line));
        coordinate_sets.extend(read_coordinates(&listing, line));
    }
    Statistics {
        version: listing.version,
        phases: phases.collect(),
        files: files
            .map(|file| FileUsage {
                file,
                numbers: named
                    .iter()
                    .filter(|(f, _)| *f == file)
                    .map(|(_, n)| *n)
                    .collect(),
                allowed: file.count(listing.version),
            })
            .collect(),
        stages: stages.into_iter().collect(),
        coordinate_sets: coordinate_sets.into_iter().collect(),
        relative: program
            .instructions()
            .any(|i| i.sources.iter().any(|s| s.register.relative)),
    }
}

/// The registers that instructions and definitions name, by file and number.
fn named_registers(listing: &Listing) -> BTreeSet<(RegisterFile, u32)> {
    let mut named = BTreeSet::new();
    let definitions = listing.program.definitions().map(|d| d.register);
    let destinations = listing
        .lines
        .iter()
        .filter_map(|l| l.instruction.destination);
    let reads = listing.lines.iter().flat_map(|line| listing.reads(line));
    let registers = definitions
        .chain(destinations.map(|d| d.register))
        .chain(reads.map(|r| r.register));
    for register in registers {
        if register.relative {
            named.insert((RegisterFile::Addr, 0));
        } else {
            named.insert((register.file, register.index));
        }
    }
    named
}

/// The stage that a line samples.
fn sampled_stage(line: &Line) -> Option<u32> {
    let samples = !matches!(
        line.instruction.opcode,
        Opcode::TexCoord
            | Opcode::TexCrd
            | Opcode::TexKill
            | Opcode::TexM3x2Pad
            | Opcode::TexM3x3Pad
            | Opcode::TexM3x2Depth
            | Opcode::TexDp3
            | Opcode::TexM3x3
            | Opcode::TexDepth
    );
    let destination = line.instruction.destination?;
    (line.is_texture() && samples).then_some(destination.register.index)
}

/// The coordinate set that a line reads: in `ps.1.4` the `t#` it names, before that the one of its own number.
fn read_coordinates(listing: &Listing, line: &Line) -> Option<u32> {
    if !line.is_texture() {
        return None;
    }
    let destination = line.instruction.destination?;
    if listing.has_texture_stages() {
        let from_a_color = matches!(
            line.instruction.opcode,
            Opcode::TexReg2Ar | Opcode::TexReg2Gb | Opcode::TexReg2Rgb
        );
        return (!from_a_color).then_some(destination.register.index);
    }
    let mut registers = std::iter::once(destination.register)
        .chain(line.instruction.sources.iter().map(|s| s.register));
    let coordinates = registers.find(|r| r.file == RegisterFile::Texture)?;
    Some(coordinates.index)
}

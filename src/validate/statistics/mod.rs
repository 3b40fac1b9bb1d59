//! How much of what a version offers a shader uses.

mod room;
mod stages;

pub use room::{FullPorts, PossiblePair};
pub use stages::{Coordinates, Stage};

use super::budgets;
use super::listing::Listing;
use crate::diagnostic::Span;
use crate::isa::{RegisterFile, Version};
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
    /// Pixel shaders: the texture stages that are sampled, in order, with what each needs.
    pub stages: Vec<Stage>,
    /// Pixel shaders: the sets of texture coordinates that are read, in order.
    pub coordinate_sets: Vec<u32>,
    /// Whether constants are addressed relative to `a0.x`, so that all of them may be read.
    pub relative: bool,
    /// Where as many registers of a file are read at once as may be.
    pub full_ports: Vec<FullPorts>,
    /// Pixel shaders: neighbours that could be a pair, in order; no instruction is in two of them.
    pub possible_pairs: Vec<PossiblePair>,
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
        stages: stages::sampled(&listing),
        coordinate_sets: stages::coordinate_sets(&listing),
        relative: program
            .instructions()
            .any(|i| i.sources.iter().any(|s| s.register.relative)),
        full_ports: room::full_ports(&listing),
        possible_pairs: room::possible_pairs(&listing),
    }
}

/// The slots of what runs at once: an instruction or a pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SlotUse {
    /// The last instruction of it.
    pub span: Span,
    /// The number of its phase in [`Statistics::phases`].
    pub phase: usize,
    /// What it takes, as [`PhaseSlots`] counts.
    pub arithmetic: u32,
    /// What it takes of the texture slots.
    pub texture: u32,
    /// The arithmetic slots of the phase up to here, its own included.
    pub arithmetic_so_far: u32,
    /// The texture slots of the phase up to here.
    pub texture_so_far: u32,
}

/// The slots of a program, one instruction or pair after the other.
pub fn slots(program: &Program) -> Vec<SlotUse> {
    let listing = Listing::new(program, &[]);
    let mut so_far = [budgets::Slots::default(); 2];
    let mut all = Vec::new();
    for group in listing.groups() {
        let Some(last) = group.last() else { continue };
        let (cost, at) = (budgets::cost(group), budgets::phase_index(group));
        let sum = &mut so_far[at];
        sum.arithmetic = sum.arithmetic.saturating_add(cost.arithmetic);
        sum.texture = sum.texture.saturating_add(cost.texture);
        all.push(SlotUse {
            span: last.instruction.span,
            phase: if listing.has_phase { at } else { 0 },
            arithmetic: cost.arithmetic,
            texture: cost.texture,
            arithmetic_so_far: sum.arithmetic,
            texture_so_far: sum.texture,
        });
    }
    all
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

#[cfg(test)]
mod tests {
    use super::super::tests::program;
    use super::*;

    fn told(text: &str) -> Vec<(usize, u32, u32, u32, u32)> {
        let one = |s: SlotUse| {
            let so_far = (s.arithmetic_so_far, s.texture_so_far);
            (s.phase, s.arithmetic, s.texture, so_far.0, so_far.1)
        };
        slots(&program(text)).into_iter().map(one).collect()
    }

    #[test]
    fn slots_are_counted_by_phase_and_pairs_once() {
        // The costs are those of the instruction tables: cmp of ps.1.2 takes two, m4x4 four, exp ten.
        let pixel = told("ps.1.2 tex t0 cmp r0, t0, v0, v1 mov r0.rgb, v0 +mov r0.a, v1");
        let expected = [(0, 0, 1, 0, 1), (0, 2, 0, 2, 1), (0, 1, 0, 3, 1)];
        assert_eq!(pixel, expected);
        let vertex = told("vs.1.1 m4x4 oPos, v0, c0 exp r0, c4.w");
        assert_eq!(vertex, [(0, 4, 0, 4, 0), (0, 10, 0, 14, 0)]);
        let phases = told("ps.1.4 texcrd r0.rgb, t0 phase mov r0, c0");
        let expected = [(0, 0, 1, 0, 1), (0, 0, 0, 0, 1), (1, 1, 0, 1, 0)];
        assert_eq!(phases, expected);
    }
}

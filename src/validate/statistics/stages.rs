//! Texture stages: which are sampled, and what textures they need.

use super::super::listing::{Line, Listing};
use crate::diagnostic::Span;
use crate::isa::{Opcode, RegisterFile, SourceModifier};
use std::collections::{BTreeMap, BTreeSet};

/// With how many coordinates a stage is sampled, as far as a shader says.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Coordinates {
    /// Two: a 2D texture.
    Two,
    /// Three: a cube or a volume.
    Three,
    /// The instruction has three and the texture takes as many as it needs; which one is bound no shader says.
    Any,
}

impl Coordinates {
    /// The textures that it can be, for people.
    pub fn textures(self) -> &'static str {
        match self {
            Coordinates::Two => "2D",
            Coordinates::Three => "cube or volume",
            Coordinates::Any => "2D, cube or volume",
        }
    }
}

/// A texture stage that is sampled.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stage {
    /// Its number.
    pub stage: u32,
    /// What its texture needs. If one instruction decides it and another leaves it open, what the one decides.
    pub coordinates: Coordinates,
    /// The instructions that sample it.
    pub samples: Vec<Span>,
}

/// The stages that are sampled, in order.
pub(super) fn sampled(listing: &Listing) -> Vec<Stage> {
    let mut stages: BTreeMap<u32, Stage> = BTreeMap::new();
    for line in &listing.lines {
        let Some((stage, coordinates)) = sample(line) else {
            continue;
        };
        let entry = stages.entry(stage).or_insert(Stage {
            stage,
            coordinates,
            samples: Vec::new(),
        });
        if entry.coordinates == Coordinates::Any {
            entry.coordinates = coordinates;
        }
        entry.samples.push(line.instruction.span);
    }
    stages.into_values().collect()
}

/// The stage that a line samples, and with what.
fn sample(line: &Line) -> Option<(u32, Coordinates)> {
    let coordinates = match line.instruction.opcode {
        Opcode::Tex | Opcode::TexReg2Rgb => Coordinates::Any,
        // What is divided has a third component that is not defined.
        Opcode::TexLd if divided(line) => Coordinates::Two,
        Opcode::TexLd => Coordinates::Any,
        // texdp3tex has one coordinate, for one row of a 2D texture.
        Opcode::TexBem
        | Opcode::TexBeml
        | Opcode::TexReg2Ar
        | Opcode::TexReg2Gb
        | Opcode::TexM3x2Tex
        | Opcode::TexDp3Tex => Coordinates::Two,
        Opcode::TexM3x3Tex | Opcode::TexM3x3Spec | Opcode::TexM3x3VSpec => Coordinates::Three,
        _ => return None,
    };
    let destination = line.instruction.destination?;
    line.is_texture()
        .then_some((destination.register.index, coordinates))
}

/// Whether a coordinate is divided by another.
fn divided(line: &Line) -> bool {
    let mut sources = line.instruction.sources.iter();
    sources.any(|s| matches!(s.modifier, SourceModifier::Dz | SourceModifier::Dw))
}

/// The sets of coordinates that are read, in order.
pub(super) fn coordinate_sets(listing: &Listing) -> Vec<u32> {
    let sets = listing.lines.iter();
    let sets: BTreeSet<u32> = sets
        .filter_map(|line| read_coordinates(listing, line))
        .collect();
    sets.into_iter().collect()
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

//! A program as the rules look at it: lines with their form, phase and place in a pair.

use super::operands::is_one_number;
use crate::diagnostic::Span;
use crate::isa::opcode::ModifierRule;
use crate::isa::{
    Class, Form, Opcode, RegisterFile, ShaderKind, SourceModifier, Version, VersionSet, WriteMask,
};
use crate::program::{Destination, Instruction, Program, Register};
use std::collections::{HashMap, HashSet};

/// A part of a `ps.1.4` shader. A shader without `phase` is all second phase.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Phase {
    /// Before `phase`.
    First,
    /// After it, and in every version that has no phases.
    Second,
}

/// An instruction with what the tables say of it.
#[derive(Clone, Copy)]
pub(super) struct Line<'p> {
    pub(super) instruction: &'p Instruction,
    /// Its form in the version; `None` if the version does not have it (S14 and S5 say so).
    pub(super) form: Option<&'static Form>,
    pub(super) phase: Phase,
    /// Whether it is the second half of a pair with the line before it.
    pub(super) joined: bool,
    /// Whether it is half of a pair, the first or the second.
    pub(super) paired: bool,
    /// Where its reads begin and end among those of the listing.
    reads: (usize, usize),
}

/// A register that an instruction reads.
pub(super) struct Read {
    pub(super) register: Register,
    /// The components that have an effect on what is written.
    pub(super) components: WriteMask,
    pub(super) span: Span,
    /// The row of the matrix that reads it; 0 outside of matrix macros.
    pub(super) row: u32,
}

/// A program, line by line.
pub(super) struct Listing<'p> {
    pub(super) program: &'p Program,
    pub(super) version: Version,
    pub(super) lines: Vec<Line<'p>>,
    pub(super) has_phase: bool,
    /// The `t#` that something in `ps.1.4` is written to, which cannot be.
    pub(super) written_coordinates: HashSet<Register>,
    /// What the lines read, one after the other.
    reads: Vec<Read>,
    unread: Unread,
}

/// Statements that could not be read.
struct Unread {
    /// Where they begin, in order.
    starts: Vec<u32>,
    /// Where the first begins that seems to write a register; `None`: nobody knows which.
    first: HashMap<Option<Register>, u32>,
}

impl Unread {
    fn new(unread: &[(Span, Option<Register>)]) -> Self {
        let mut starts: Vec<u32> = unread.iter().map(|(span, _)| span.start).collect();
        starts.sort_unstable();
        let mut first = HashMap::new();
        for (span, register) in unread {
            let at = first.entry(*register).or_insert(span.start);
            *at = span.start.min(*at);
        }
        Self { starts, first }
    }
}

impl<'p> Listing<'p> {
    pub(super) fn new(program: &'p Program, unread: &[(Span, Option<Register>)]) -> Self {
        let version = program.version;
        let is_phase = |i: &Instruction| i.opcode == Opcode::Phase;
        let has_phase = version == Version::Ps14 && program.instructions().any(is_phase);
        let mut phase = if has_phase {
            Phase::First
        } else {
            Phase::Second
        };
        let most = program.statements.len();
        let mut lines: Vec<Line<'p>> = Vec::with_capacity(most);
        let mut reads = Vec::with_capacity(2 * most);
        for instruction in program.instructions() {
            let mut line = Line {
                instruction,
                form: instruction.opcode.form(version),
                phase,
                joined: false,
                paired: false,
                reads: (reads.len(), 0),
            };
            line.add_reads(&mut reads);
            line.reads.1 = reads.len();
            line.joined = instruction.co_issue
                && line.can_pair()
                && lines.last().is_some_and(|l| l.can_pair() && !l.joined);
            line.paired = line.joined;
            if let (true, Some(first)) = (line.joined, lines.last_mut()) {
                first.paired = true;
            }
            lines.push(line);
            if is_phase(instruction) {
                phase = Phase::Second;
            }
        }
        let destinations = lines
            .iter()
            .filter(|l| version == Version::Ps14 && l.instruction.opcode != Opcode::TexKill);
        let destinations = destinations.filter_map(|l| Some(l.instruction.destination?.register));
        let written_coordinates = destinations.filter(|r| r.file == RegisterFile::Texture);
        Self {
            program,
            version,
            written_coordinates: written_coordinates.collect(),
            lines,
            has_phase,
            reads,
            unread: Unread::new(unread),
        }
    }

    /// What a line reads, the rows of a matrix one by one.
    pub(super) fn reads(&self, line: &Line) -> &[Read] {
        self.reads.get(line.reads.0..line.reads.1).unwrap_or(&[])
    }

    pub(super) fn is_pixel(&self) -> bool {
        self.version.kind() == ShaderKind::Pixel
    }

    /// Whether the texture registers are also results and stages have a fixed order: `ps.1.0` to `ps.1.3`.
    pub(super) fn has_texture_stages(&self) -> bool {
        VersionSet::PS_1_0_TO_1_3.contains(self.version)
    }

    /// What runs at once, in order: single lines and pairs.
    pub(super) fn groups(&self) -> impl Iterator<Item = &[Line<'p>]> {
        self.lines.chunk_by(|_, next| next.joined)
    }

    /// Lines whose instruction the version has.
    pub(super) fn known(&self) -> impl Iterator<Item = (&Line<'p>, &'static Form)> {
        self.lines.iter().filter_map(|l| Some((l, l.form?)))
    }

    /// A register with some of its components, as text.
    pub(super) fn name(&self, register: Register, components: WriteMask) -> String {
        format!("{register}{}", components.text(self.program.letters()))
    }

    /// A mask as text; `.rgba` or `.xyzw` for the full one.
    pub(super) fn mask(&self, mask: WriteMask) -> String {
        if mask == WriteMask::ALL {
            std::iter::once('.').chain(self.program.letters()).collect()
        } else {
            mask.text(self.program.letters())
        }
    }

    /// Whether a statement before a place or at it, which could not be read, may have written a register.
    pub(super) fn hides_write(&self, register: Register, before: Span) -> bool {
        let at = |register| self.unread.first.get(&register);
        let mut starts = [at(None), at(Some(register))].into_iter().flatten();
        starts.any(|start| *start <= before.start)
    }

    /// Whether a statement that could not be read may be a texture instruction.
    pub(super) fn hides_texture_instructions(&self) -> bool {
        let may = |to: &Option<Register>| to.is_none_or(|to| to.file == RegisterFile::Texture);
        self.unread.first.keys().any(may)
    }

    /// Whether a statement between two places could not be read.
    pub(super) fn hides_between(&self, from: Span, to: Span) -> bool {
        let starts = &self.unread.starts;
        let next = starts.get(starts.partition_point(|start| *start < from.start));
        next.is_some_and(|start| *start <= to.start)
    }

    /// Whether an instruction writes to a register that it cannot write to: its result was meant for another.
    pub(super) fn misdirects(&self) -> bool {
        self.known().any(|(line, form)| {
            let shape = form.destination.filter(|shape| shape.written);
            shape
                .zip(line.instruction.destination)
                .is_some_and(|(shape, destination)| {
                    let register = destination.register;
                    !shape.files.contains(register.file) || !self.exists(register)
                })
        })
    }

    /// Whether the version has this register.
    pub(super) fn exists(&self, register: Register) -> bool {
        register.relative || register.index < register.file.count(self.version)
    }
}

impl Line<'_> {
    pub(super) fn mnemonic(&self) -> &'static str {
        self.instruction.opcode.mnemonic()
    }

    /// Whether it is arithmetic that computes something.
    pub(super) fn is_arithmetic(&self) -> bool {
        self.form
            .is_some_and(|f| f.class == Class::Arithmetic && f.destination.is_some())
    }

    pub(super) fn is_texture(&self) -> bool {
        self.form.is_some_and(|f| f.class == Class::Texture)
    }

    /// Whether it stands where a half of a pair can stand. Instructions of other versions do, so that they do not
    /// make their neighbours look wrong.
    fn can_pair(&self) -> bool {
        self.form.is_none() || self.is_arithmetic()
    }

    fn add_reads(&self, reads: &mut Vec<Read>) {
        let Some(form) = self.form else {
            return;
        };
        let mask = self.instruction.destination.map_or(WriteMask::ALL, used);
        if let (Some(shape), Some(looked_at)) = (form.destination, self.instruction.destination)
            && !shape.written
            // Without r# among its registers it looks at the coordinates that come in, not at a register.
            && shape.files.contains(RegisterFile::Temp)
        {
            reads.push(Read {
                register: looked_at.register,
                components: self.looks_at(),
                span: looked_at.span,
                row: 0,
            });
        }
        for (i, source) in self.instruction.sources.iter().enumerate() {
            // A register of the wrong file is one fault, which the rules on operands tell.
            let Some(shape) = form.sources.get(i) else {
                continue;
            };
            if !shape.files.contains(source.register.file) {
                continue;
            }
            let matrix = shape.modifiers == ModifierRule::Matrix;
            let components = source.swizzle.reads(form.slots_read(i, mask));
            let rows = if matrix { form.rows } else { 1 };
            for row in (0..rows).filter(|row| !matrix || mask.has(*row as usize)) {
                let mut register = source.register;
                register.index = register.index.saturating_add(row);
                reads.push(Read {
                    register,
                    components,
                    span: source.span,
                    row,
                });
            }
        }
    }

    /// The components of its register that `texkill` and `texdepth` look at.
    fn looks_at(&self) -> WriteMask {
        match self.instruction.opcode {
            Opcode::TexDepth => WriteMask::XY,
            _ => WriteMask::XYZ,
        }
    }

    /// What it writes: the register and the components that get a value.
    pub(super) fn writes(&self) -> Option<(Register, WriteMask)> {
        let destination = self.instruction.destination?;
        let Some(form) = self.form else {
            return Some((destination.register, destination.mask));
        };
        if form.destination.is_none_or(|shape| !shape.written) {
            return None;
        }
        let mask = match self.instruction.opcode {
            // Without a mask it is taken as `.rgb`; alpha is never written.
            Opcode::TexCrd if self.divides() => destination.mask.and(WriteMask::XY),
            Opcode::TexCrd => destination.mask.and(WriteMask::XYZ),
            _ if form.rows > 0 => destination.mask.and(first(form.rows)),
            // They have no mask; M13 speaks of one that is written.
            _ if form.class == Class::Texture => WriteMask::ALL,
            _ => destination.mask,
        };
        Some((destination.register, mask))
    }

    /// Whether a coordinate of it is divided by `w`.
    pub(super) fn divides(&self) -> bool {
        let mut sources = self.instruction.sources.iter();
        sources.any(|s| s.modifier == SourceModifier::Dw)
    }

    /// Whether it names a register of this file as its destination.
    pub(super) fn writes_file(&self, file: RegisterFile) -> bool {
        self.writes().is_some_and(|(r, _)| r.file == file)
    }
}

/// The components of a destination that have an effect: `oFog` and `oPts` are one number, x if no mask is written.
fn used(destination: Destination) -> WriteMask {
    if is_one_number(destination.register) && destination.mask == WriteMask::ALL {
        WriteMask::X
    } else {
        destination.mask
    }
}

/// The first `rows` components.
fn first(rows: u32) -> WriteMask {
    (0..rows.min(4) as usize)
        .map(WriteMask::component)
        .fold(WriteMask::NONE, WriteMask::or)
}

/// `1st`, `2nd`, `5th`.
pub(super) fn ordinal(n: u32) -> String {
    let ending = match (n % 10, n % 100) {
        (_, 11..=13) => "th",
        (1, _) => "st",
        (2, _) => "nd",
        (3, _) => "rd",
        _ => "th",
    };
    format!("{n}{ending}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_as_people_do() {
        let ordinals = [1, 2, 3, 4, 11, 12, 13, 21, 101, 111, 122].map(ordinal);
        assert_eq!(
            ordinals.join(" "),
            "1st 2nd 3rd 4th 11th 12th 13th 21st 101st 111th 122nd"
        );
    }
}

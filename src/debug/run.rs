//! A recorded invocation, and its registers at any moment of it.

use super::moment::{Change, Event, Moment, Quad, Target};
use crate::diagnostic::{Location, SourceMap, Span};
use crate::exec::Environment;
use crate::isa::{ShaderKind, WriteMask};
use crate::kernel::{Kernel, SLOT_COUNT, Slot};
use crate::program::{Instruction, Program};
use std::ops::Range;

/// A shader as it was written, and as it runs.
#[derive(Clone, Copy, Debug)]
pub struct Listing<'a> {
    /// What was written.
    pub program: &'a Program,
    /// What runs.
    pub kernel: &'a Kernel,
    /// The texts that the spans of the program point into.
    pub sources: &'a SourceMap,
}

impl<'a> Listing<'a> {
    /// Whether it is a vertex or a pixel shader.
    pub fn kind(&self) -> ShaderKind {
        self.program.version.kind()
    }

    /// An instruction by its number.
    pub fn instruction(&self, number: usize) -> Option<&'a Instruction> {
        self.program.instructions().nth(number)
    }

    /// Where an instruction stands.
    pub fn location(&self, instruction: usize) -> Option<Location<'a>> {
        self.sources.locate(self.instruction(instruction)?.span)
    }

    /// The line, from 1, on which an instruction begins; 0 if there is no such instruction.
    pub fn line(&self, instruction: usize) -> usize {
        self.location(instruction).map_or(0, |at| at.line)
    }

    /// The instructions that begin on a line, or else on the next line that has one.
    pub fn instructions_at(&self, line: usize) -> Range<usize> {
        let lines: Vec<usize> = (self.program.instructions())
            .map(|i| self.line_of(i.span))
            .collect();
        let Some(found) = lines.iter().copied().filter(|at| *at >= line).min() else {
            return 0..0;
        };
        let first = lines.iter().position(|at| *at == found).unwrap_or(0);
        let count = lines[first..].iter().take_while(|at| **at == found).count();
        first..first + count
    }

    fn line_of(&self, span: Span) -> usize {
        self.sources.locate(span).map_or(0, |at| at.line)
    }

    /// The text of an instruction on one line, with its `+`.
    pub fn text(&self, instruction: usize) -> String {
        let Some(instruction) = self.instruction(instruction) else {
            return String::new();
        };
        let text = self.sources.text(instruction.span);
        let plus = if instruction.co_issue { "+" } else { "" };
        let words: Vec<_> = text.split_whitespace().collect();
        format!("{plus}{}", words.join(" "))
    }
}

/// Which invocation of its subject a run is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RunKind {
    /// A listing with values set by hand.
    Listing,
    /// The vertex shader, for one vertex.
    Vertex {
        /// The corner of the primitive, 0 to 2, if the subject is a pixel.
        corner: Option<usize>,
        /// The vertex by its number in the mesh.
        vertex: u32,
    },
    /// The pixel shader.
    Pixel {
        /// Column and row in the picture.
        pixel: [u32; 2],
    },
}

/// One invocation, recorded.
#[derive(Clone, Debug)]
pub struct Run<'a> {
    /// Which one.
    pub kind: RunKind,
    /// The shader.
    pub listing: Listing<'a>,
    /// Its constants, textures and stage states, before any was set by hand.
    pub environment: Environment<'a>,
    /// The pixel of the quad that is looked at, 0 to 3.
    pub lane: usize,
    /// Which pixels of the quad are helpers: not covered by the primitive, shaded for the differences only.
    pub helpers: [bool; 4],
    /// The registers before the first moment.
    pub initial: Registers,
    /// What happened, in order.
    pub moments: Vec<Moment>,
}

impl Run<'_> {
    /// The registers after the first `at` moments; after all if there are not so many.
    pub fn registers(&self, at: usize) -> Registers {
        let mut registers = self.initial.clone();
        for moment in self.moments.iter().take(at) {
            registers.apply(moment);
        }
        registers
    }

    /// The moments of the instruction that moment `at` belongs to: its rows. Moments around the shader belong together as far as
    /// they are of one kind.
    pub fn group(&self, at: usize) -> Range<usize> {
        let Some(moment) = self.moments.get(at) else {
            return at..at;
        };
        let same = |other: &Moment| {
            other.instruction == moment.instruction
                && std::mem::discriminant(&other.event) == std::mem::discriminant(&moment.event)
        };
        let before = self.moments[..at].iter().rev().take_while(|m| same(m));
        let after = self.moments[at..].iter().take_while(|m| same(m));
        at - before.count()..at + after.count()
    }

    /// Where the first instruction begins.
    pub fn first_instruction(&self) -> usize {
        let found = self.moments.iter().position(|m| m.instruction.is_some());
        found.unwrap_or(self.moments.len())
    }
}

/// All registers of an invocation at one moment.
#[derive(Clone, Debug, PartialEq)]
pub struct Registers {
    slots: Box<[Quad]>,
    written: Box<[WriteMask]>,
    constants: Vec<[f32; 4]>,
    killed: [bool; 4],
}

impl Registers {
    /// Everything zero and never written.
    pub(super) fn new(constants: Vec<[f32; 4]>) -> Self {
        Self {
            slots: vec![[[0.0; 4]; 4]; SLOT_COUNT].into_boxed_slice(),
            written: vec![WriteMask::default(); SLOT_COUNT].into_boxed_slice(),
            constants,
            killed: [false; 4],
        }
    }

    /// A register of the four pixels.
    pub fn quad(&self, slot: Slot) -> Quad {
        self.slots.get(slot.index()).copied().unwrap_or_default()
    }

    /// A register of one pixel, 0 to 3.
    pub fn slot(&self, slot: Slot, lane: usize) -> [f32; 4] {
        self.quad(slot)[lane & 3]
    }

    /// A constant; (0, 0, 0, 0) outside of those there are.
    pub fn constant(&self, index: u32) -> [f32; 4] {
        let found = self.constants.get(index as usize);
        found.copied().unwrap_or_default()
    }

    /// How many constants there are.
    pub fn constant_count(&self) -> usize {
        self.constants.len()
    }

    /// What a change can be made to, of the four pixels.
    pub fn target(&self, target: Target) -> Quad {
        match target {
            Target::Slot(slot) => self.quad(slot),
            Target::Constant(index) => [self.constant(index); 4],
        }
    }

    /// The components of a register that hold something: an input, or what an instruction has written.
    pub fn written(&self, slot: Slot) -> WriteMask {
        self.written.get(slot.index()).copied().unwrap_or_default()
    }

    /// The pixels that `texkill` has discarded.
    pub fn killed(&self) -> [bool; 4] {
        self.killed
    }

    pub(super) fn load(&mut self, slot: Slot, value: Quad) {
        if let Some(place) = self.slots.get_mut(slot.index()) {
            *place = value;
        }
    }

    pub(super) fn mark_written(&mut self, slot: Slot, mask: WriteMask) {
        if let Some(place) = self.written.get_mut(slot.index()) {
            *place = place.or(mask);
        }
    }

    fn unmark(&mut self, slot: Slot, mask: WriteMask) {
        if let Some(place) = self.written.get_mut(slot.index()) {
            *place = place.without(mask);
        }
    }

    fn put(&mut self, target: Target, value: Quad) {
        match target {
            Target::Slot(slot) => self.load(slot, value),
            Target::Constant(index) => {
                if let Some(constant) = self.constants.get_mut(index as usize) {
                    *constant = value[0];
                }
            }
        }
    }

    /// One moment on.
    pub fn apply(&mut self, moment: &Moment) {
        if let Some(Change {
            target,
            after,
            mask,
            ..
        }) = moment.change
        {
            self.put(target, after);
            if let Some(slot) = target.slot() {
                self.mark_written(slot, mask);
            }
        }
        for (slot, mask) in &moment.lost {
            self.unmark(*slot, *mask);
        }
        if let Event::Step {
            killed: Some((_, after)),
            ..
        } = moment.event
        {
            self.killed = after;
        }
    }

    /// One moment back: the opposite of [`Self::apply`], to the bit.
    pub fn undo(&mut self, moment: &Moment) {
        if let Event::Step {
            killed: Some((before, _)),
            ..
        } = moment.event
        {
            self.killed = before;
        }
        for (slot, mask) in &moment.lost {
            self.mark_written(*slot, *mask);
        }
        if let Some(Change {
            target,
            before,
            first,
            ..
        }) = moment.change
        {
            self.put(target, before);
            if let Some(slot) = target.slot() {
                self.unmark(slot, first);
            }
        }
    }
}

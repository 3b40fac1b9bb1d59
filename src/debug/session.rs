//! A session: where one is in the runs of a subject, and how one moves.

use super::moment::{Event, Moment, Quad, Target};
use super::record::Edit;
use super::run::{Registers, Run};
use super::subject::Subject;
use crate::isa::WriteMask;

/// A place between two moments.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Position {
    /// The run.
    pub run: usize,
    /// How many of its moments have happened.
    pub at: usize,
}

/// A way to go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// As the shader runs.
    Forward,
    /// The other way.
    Backward,
}

/// The runs of a subject, and a place in them.
#[derive(Clone, Debug)]
pub struct Session<'a> {
    subject: Subject<'a>,
    runs: Vec<Run<'a>>,
    /// The runs as they were before anything was set by hand.
    original: Option<Vec<Run<'a>>>,
    edits: Vec<Edit>,
    position: Position,
    registers: Registers,
}

impl<'a> Session<'a> {
    /// Records the subject; the place is the first instruction of its last run.
    pub fn new(subject: Subject<'a>) -> Self {
        let runs = subject.record(&[]);
        let position = subject.start(&runs);
        let registers = registers(&runs, position);
        Self {
            subject,
            runs,
            original: None,
            edits: Vec::new(),
            position,
            registers,
        }
    }

    /// Goes on with another subject, from its start. What was set by hand is forgotten.
    pub fn replace(&mut self, subject: Subject<'a>) {
        *self = Self::new(subject);
    }

    /// What is debugged.
    pub fn subject(&self) -> &Subject<'a> {
        &self.subject
    }

    /// The runs in order.
    pub fn runs(&self) -> &[Run<'a>] {
        &self.runs
    }

    /// The runs as they were before anything was set by hand; `None` if nothing is.
    pub fn original(&self) -> Option<&[Run<'a>]> {
        self.original.as_deref()
    }

    /// What was set by hand.
    pub fn edits(&self) -> &[Edit] {
        &self.edits
    }

    /// The run that the place is in; `None` only if the subject has no run.
    pub fn run(&self) -> Option<&Run<'a>> {
        self.runs.get(self.position.run)
    }

    /// The place.
    pub fn position(&self) -> Position {
        self.position
    }

    /// The registers at the place.
    pub fn registers(&self) -> &Registers {
        &self.registers
    }

    /// What happens next; `None` at the end of a run.
    pub fn next_moment(&self) -> Option<&Moment> {
        self.run()?.moments.get(self.position.at)
    }

    /// What happened last; `None` at the beginning of a run.
    pub fn last_moment(&self) -> Option<&Moment> {
        self.run()?.moments.get(self.position.at.checked_sub(1)?)
    }

    /// The instruction that comes next in the run; at its end `None`.
    pub fn next_instruction(&self) -> Option<usize> {
        let moments = self.run()?.moments.get(self.position.at..)?;
        moments.iter().find_map(|moment| moment.instruction)
    }

    /// One moment on: a row of a macro, an input, an instruction. From the end of a run to the beginning of the next one.
    /// `false` at the very end, where nothing moves.
    pub fn step(&mut self) -> bool {
        if let Some(moment) = self
            .runs
            .get(self.position.run)
            .and_then(|run| run.moments.get(self.position.at))
        {
            self.registers.apply(moment);
            self.position.at += 1;
            return true;
        }
        match self.runs.get(self.position.run + 1) {
            Some(run) => {
                self.registers = run.initial.clone();
                self.position = Position {
                    run: self.position.run + 1,
                    at: 0,
                };
                true
            }
            None => false,
        }
    }

    /// One moment back: exactly undoes [`Self::step`]. `false` at the very beginning.
    pub fn back(&mut self) -> bool {
        let Position { run, at } = self.position;
        if let Some(at) = at.checked_sub(1) {
            if let Some(moment) = self.runs.get(run).and_then(|run| run.moments.get(at)) {
                self.registers.undo(moment);
            }
            self.position.at = at;
            return true;
        }
        match run.checked_sub(1) {
            Some(run) => {
                let at = self.runs.get(run).map_or(0, |run| run.moments.len());
                self.go_to(Position { run, at });
                true
            }
            None => false,
        }
    }

    /// One moment in a direction.
    pub fn advance(&mut self, direction: Direction) -> bool {
        match direction {
            Direction::Forward => self.step(),
            Direction::Backward => self.back(),
        }
    }

    /// Over a whole instruction with all its rows, in a direction; over all that surrounds the shader and is of one kind.
    /// `false` where nothing moves.
    pub fn next(&mut self, direction: Direction) -> bool {
        let at = match direction {
            Direction::Forward => Some(self.position.at),
            Direction::Backward => self.position.at.checked_sub(1),
        };
        let group = match (self.run(), at) {
            (Some(run), Some(at)) => run.group(at),
            _ => 0..0,
        };
        if group.is_empty() {
            return self.advance(direction);
        }
        let at = match direction {
            Direction::Forward => group.end,
            Direction::Backward => group.start,
        };
        self.go_to(Position {
            at,
            ..self.position
        });
        true
    }

    /// To a place; one beyond an end is the end.
    pub fn go_to(&mut self, position: Position) {
        let run = position.run.min(self.runs.len().saturating_sub(1));
        let most = self.runs.get(run).map_or(0, |run| run.moments.len());
        self.position = Position {
            run,
            at: position.at.min(most),
        };
        self.registers = registers(&self.runs, self.position);
    }

    /// Whether a value can be set here: not between the rows of a macro or the halves of a pair, which read before any writes.
    pub fn can_set(&self) -> bool {
        let Some(run) = self.run() else {
            return false;
        };
        let held = match self.last_moment().map(|moment| &moment.event) {
            Some(Event::Step { step, .. }) => run
                .listing
                .kernel
                .steps
                .get(*step)
                .is_some_and(|step| step.held),
            _ => false,
        };
        !held
    }

    /// Sets components of a register or a constant here, for each pixel of the quad, and runs on from here; the place is then
    /// behind the moment that sets. What was recorded before the first value was set stays in [`Self::original`].
    ///
    /// `false`, and nothing done, where [`Self::can_set`] says no.
    pub fn set(&mut self, target: Target, mask: WriteMask, value: Quad) -> bool {
        if !self.can_set() {
            return false;
        }
        let Position { run, at } = self.position;
        let after = self.run().map_or(0, |run| {
            let set = |moment: &&Moment| moment.event == Event::Set;
            at - run.moments.iter().take(at).filter(set).count()
        });
        let edit = Edit {
            run,
            after,
            target,
            mask,
            value,
        };
        // Behind what was set in the same place before, ahead of what was set later in the run.
        let key = |edit: &Edit| (edit.run, edit.after);
        let place = self.edits.partition_point(|other| key(other) <= key(&edit));
        self.edits.insert(place, edit);
        let recorded = self.subject.record(&self.edits);
        let old = std::mem::replace(&mut self.runs, recorded);
        self.original.get_or_insert(old);
        // Values that were set in the same place before may have been undone by stepping back: go behind all of them.
        let sets = self
            .edits
            .iter()
            .filter(|other| key(other) <= (run, after) && other.run == run);
        let at = after + sets.count();
        self.go_to(Position { run, at });
        true
    }

    /// Forgets everything that was set by hand; the place is the same as far as it still is.
    pub fn unset(&mut self) {
        if let Some(original) = self.original.take() {
            let Position { run, at } = self.position;
            let passed = self.run().map_or(0, |run| {
                let moments = run.moments.iter().take(at);
                moments.filter(|moment| moment.event == Event::Set).count()
            });
            self.runs = original;
            self.edits.clear();
            self.go_to(Position {
                run,
                at: at - passed,
            });
        }
    }
}

fn registers(runs: &[Run<'_>], position: Position) -> Registers {
    let run = runs.get(position.run);
    run.map_or_else(
        || Registers::new(Vec::new()),
        |run| run.registers(position.at),
    )
}

//! Breakpoints, watchpoints, and running until something happens.

use super::expression::{Expression, LogMessage, Scope};
use super::moment::{Event, Moment, Target};
use super::run::{Registers, Run};
use super::session::{Direction, Position, Session};
use crate::isa::{ShaderKind, WriteMask};
use std::fmt;
use std::str::FromStr;

/// Something that can happen to a value, and that one can run to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Occurrence {
    /// A result is NaN, and nothing that was read is.
    Nan,
    /// A result is infinite, or the largest number, and nothing that was read is.
    Infinite,
    /// A value is clamped or saturated, and differs for it.
    Clamp,
    /// A component is read that nothing has written.
    Uninitialised,
    /// `c[a0.x + n]` names a constant that there is not.
    OutOfRange,
    /// A texture is sampled.
    Sample,
}

/// Every occurrence with its name in commands.
static OCCURRENCES: [(Occurrence, &str); 6] = [
    (Occurrence::Nan, "nan"),
    (Occurrence::Infinite, "inf"),
    (Occurrence::Clamp, "clamp"),
    (Occurrence::Uninitialised, "uninit"),
    (Occurrence::OutOfRange, "range"),
    (Occurrence::Sample, "sample"),
];

impl Occurrence {
    /// Every occurrence.
    pub fn all() -> impl Iterator<Item = Self> {
        OCCURRENCES.iter().map(|(occurrence, _)| *occurrence)
    }

    /// Its name in commands.
    pub fn name(self) -> &'static str {
        let row = OCCURRENCES
            .iter()
            .find(|(occurrence, _)| *occurrence == self);
        row.map_or("", |(_, name)| name)
    }

    /// Whether it happens at a moment, to a pixel of the quad.
    pub fn happens(self, moment: &Moment, lane: usize) -> bool {
        let flags = moment.flags[lane & 3];
        match self {
            Self::Nan => !flags.nan.is_empty(),
            Self::Infinite => !flags.infinite.is_empty(),
            Self::Clamp => !flags.clamped.or(flags.saturated).is_empty(),
            Self::Uninitialised => flags.uninitialised,
            Self::OutOfRange => flags.out_of_range,
            Self::Sample => matches!(
                moment.event,
                Event::Step {
                    sample: Some(_),
                    ..
                }
            ),
        }
    }
}

impl fmt::Display for Occurrence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A word that names no [`Occurrence`], or a text that is no [`HitCount`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NotUnderstood(String);

impl fmt::Display for NotUnderstood {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for NotUnderstood {}

impl FromStr for Occurrence {
    type Err = NotUnderstood;

    fn from_str(text: &str) -> Result<Self, NotUnderstood> {
        let row = OCCURRENCES
            .iter()
            .find(|(_, name)| name.eq_ignore_ascii_case(text));
        row.map(|(occurrence, _)| *occurrence).ok_or_else(|| {
            let names: Vec<_> = OCCURRENCES.iter().map(|(_, name)| *name).collect();
            NotUnderstood(format!("`{text}` is none of {}", names.join(", ")))
        })
    }
}

/// Which hits of a breakpoint count. The n-th hit is the n-th from the beginning of the recording, whichever way one came.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum HitCount {
    /// All.
    #[default]
    Any,
    /// `3` or `== 3`: the third.
    Exactly(u32),
    /// `>= 3` or `> 2`: the third and all after it.
    AtLeast(u32),
    /// `% 3`: every third.
    Every(u32),
}

impl HitCount {
    /// Whether the hit of this number, from 1, counts.
    pub fn counts(self, hit: u32) -> bool {
        match self {
            Self::Any => true,
            Self::Exactly(n) => hit == n,
            Self::AtLeast(n) => hit >= n,
            Self::Every(n) => hit.checked_rem(n) == Some(0),
        }
    }
}

impl FromStr for HitCount {
    type Err = NotUnderstood;

    fn from_str(text: &str) -> Result<Self, NotUnderstood> {
        let text = text.trim();
        let wrong = || {
            NotUnderstood(format!(
                "`{text}` is no hit count: write 3, == 3, >= 3, > 3 or % 3"
            ))
        };
        let (sign, number) =
            text.split_at(text.find(|c: char| c.is_ascii_digit()).ok_or_else(wrong)?);
        let number: u32 = number.parse().map_err(|_| wrong())?;
        match sign.trim() {
            "" | "=" | "==" => Ok(Self::Exactly(number)),
            ">=" => Ok(Self::AtLeast(number)),
            ">" => number.checked_add(1).map(Self::AtLeast).ok_or_else(wrong),
            "%" if number > 0 => Ok(Self::Every(number)),
            _ => Err(wrong()),
        }
    }
}

impl fmt::Display for HitCount {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Any => Ok(()),
            Self::Exactly(n) => write!(f, "== {n}"),
            Self::AtLeast(n) => write!(f, ">= {n}"),
            Self::Every(n) => write!(f, "% {n}"),
        }
    }
}

/// When a breakpoint or watchpoint acts, and how.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Action {
    /// Its number, for people.
    pub id: u32,
    /// Whether it acts at all.
    pub enabled: bool,
    /// What must be true: some component not zero. A condition that cannot be evaluated where it is looked at is false.
    pub condition: Option<Expression>,
    /// Which of the hits, conditions met, count.
    pub hits: HitCount,
    /// A message to write instead of stopping.
    pub log: Option<LogMessage>,
}

/// Stops before an instruction.
#[derive(Clone, Debug, PartialEq)]
pub struct Breakpoint {
    /// In which shader.
    pub kind: ShaderKind,
    /// The instruction.
    pub instruction: usize,
    /// When and how.
    pub action: Action,
}

/// Stops where a value changes.
#[derive(Clone, Debug, PartialEq)]
pub struct Watchpoint {
    /// In which shader.
    pub kind: ShaderKind,
    /// The register.
    pub target: Target,
    /// The components that are watched.
    pub mask: WriteMask,
    /// When and how. The condition is looked at after the change.
    pub action: Action,
}

/// Everything that stops one who travels.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stops {
    /// Breakpoints.
    pub breakpoints: Vec<Breakpoint>,
    /// Watchpoints.
    pub watchpoints: Vec<Watchpoint>,
    /// What stops wherever it happens.
    pub occurrences: Vec<Occurrence>,
}

/// Where one travels to, if nothing stops one before.
#[derive(Clone, Debug, PartialEq)]
pub enum Until {
    /// To the end of the last run, or the beginning of the first.
    End,
    /// To the end of the run that one is in, or its beginning.
    RunEnd,
    /// Until this happens.
    Occurrence(Occurrence),
    /// To an instruction.
    Instruction {
        /// In which shader.
        kind: ShaderKind,
        /// Which one.
        instruction: usize,
    },
    /// To a place.
    Position(Position),
}

/// Why one stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// At the breakpoint of this number.
    Breakpoint(u32),
    /// At the watchpoint of this number.
    Watchpoint(u32),
    /// This happened.
    Occurrence(Occurrence),
    /// One is where one wanted to be.
    Reached,
    /// There is nothing further this way.
    End,
}

/// How a travel went.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Travel {
    /// Why it ended; more than one reason where several meet.
    pub reasons: Vec<Reason>,
    /// What breakpoints logged on the way, and where.
    pub logs: Vec<(Position, String)>,
    /// The moment that a watchpoint or an occurrence speaks of: just passed.
    pub moment: Option<Position>,
}

impl Session<'_> {
    /// Goes on in a direction until something stops, at least by one moment where there is one.
    ///
    /// Breakpoints stop before their instruction, in both directions. Watchpoints and occurrences stop right behind the moment when
    /// going forward, and right before it when going backward, so that stepping over it shows what happens.
    pub fn travel(&mut self, direction: Direction, stops: &Stops, until: &Until) -> Travel {
        let mut travel = Travel::default();
        loop {
            let from = self.position();
            if !self.advance(direction) {
                travel.reasons.push(Reason::End);
                return travel;
            }
            let here = self.position();
            // Between two runs nothing happens.
            let passed = (from.run == here.run).then(|| Position {
                run: here.run,
                at: from.at.min(here.at),
            });
            let mut reasons = Vec::new();
            if let Some(passed) = passed {
                self.look_at_moment(stops, until, passed, &mut reasons, &mut travel.logs);
                if !reasons.is_empty() {
                    travel.moment = Some(passed);
                }
            }
            self.look_at_place(stops, &mut reasons, &mut travel.logs);
            let arrived = match until {
                Until::Position(position) => here == *position,
                Until::Instruction { kind, instruction } => self.arrives_at(*kind, *instruction),
                Until::RunEnd => match direction {
                    Direction::Forward => self.next_moment().is_none(),
                    Direction::Backward => here.at == 0,
                },
                Until::End | Until::Occurrence(_) => false,
            };
            if arrived {
                reasons.push(Reason::Reached);
            }
            if !reasons.is_empty() {
                travel.reasons = reasons;
                return travel;
            }
        }
    }

    /// What stops at the moment that was just passed.
    fn look_at_moment(
        &self,
        stops: &Stops,
        until: &Until,
        passed: Position,
        reasons: &mut Vec<Reason>,
        logs: &mut Vec<(Position, String)>,
    ) {
        let Some((run, moment)) =
            (self.runs().get(passed.run)).and_then(|run| Some((run, run.moments.get(passed.at)?)))
        else {
            return;
        };
        let wanted = match until {
            Until::Occurrence(occurrence) => Some(occurrence),
            _ => None,
        };
        for occurrence in Occurrence::all() {
            let asked = wanted == Some(&occurrence) || stops.occurrences.contains(&occurrence);
            if asked && occurrence.happens(moment, run.lane) {
                reasons.push(Reason::Occurrence(occurrence));
            }
        }
        for watchpoint in &stops.watchpoints {
            let hit = |position: Position, registers: &Registers| {
                watchpoint.hits(self.runs(), position, registers)
            };
            if let Some(log) = self.acts(&watchpoint.action, passed, true, &hit) {
                match log {
                    Some(text) => logs.push((passed, text)),
                    None => reasons.push(Reason::Watchpoint(watchpoint.action.id)),
                }
            }
        }
    }

    /// What stops where one is now.
    fn look_at_place(
        &self,
        stops: &Stops,
        reasons: &mut Vec<Reason>,
        logs: &mut Vec<(Position, String)>,
    ) {
        let here = self.position();
        for breakpoint in &stops.breakpoints {
            let hit = |position: Position, _: &Registers| {
                let run = self.runs().get(position.run);
                run.is_some_and(|run| {
                    arrives(run, position.at, breakpoint.kind, breakpoint.instruction)
                })
            };
            if let Some(log) = self.acts(&breakpoint.action, here, false, &hit) {
                match log {
                    Some(text) => logs.push((here, text)),
                    None => reasons.push(Reason::Breakpoint(breakpoint.action.id)),
                }
            }
        }
    }

    fn arrives_at(&self, kind: ShaderKind, instruction: usize) -> bool {
        let here = self.position();
        self.run()
            .is_some_and(|run| arrives(run, here.at, kind, instruction))
    }

    /// Whether an action acts at a position that `hit` accepts, and the text that it logs if it logs.
    ///
    /// `hit` is given the registers that conditions see: those at the position, or with `after` those behind its moment.
    fn acts(
        &self,
        action: &Action,
        at: Position,
        after: bool,
        hit: &dyn Fn(Position, &Registers) -> bool,
    ) -> Option<Option<String>> {
        if !action.enabled {
            return None;
        }
        let meets = |run: &Run<'_>, position: Position, registers: &Registers| {
            let scope = Scope {
                run,
                registers,
                lane: run.lane,
            };
            hit(position, registers)
                && (action.condition.as_ref()).is_none_or(|condition| {
                    condition
                        .evaluate(&scope)
                        .is_ok_and(|value| value.is_true())
                })
        };
        let run = self.runs().get(at.run)?;
        let registers = run.registers(at.at + usize::from(after));
        if !meets(run, at, &registers) {
            return None;
        }
        if action.hits != HitCount::Any {
            let mut count = 0;
            for (number, run) in self.runs().iter().enumerate().take(at.run + 1) {
                let mut registers = run.initial.clone();
                let end = if number == at.run {
                    at.at + 1
                } else {
                    run.moments.len() + 1
                };
                for place in 0..end {
                    if after && let Some(moment) = run.moments.get(place) {
                        registers.apply(moment);
                    }
                    let position = Position {
                        run: number,
                        at: place,
                    };
                    count += u32::from(meets(run, position, &registers));
                    if !after && let Some(moment) = run.moments.get(place) {
                        registers.apply(moment);
                    }
                }
            }
            if !action.hits.counts(count) {
                return None;
            }
        }
        let scope = Scope {
            run,
            registers: &registers,
            lane: run.lane,
        };
        Some(action.log.as_ref().map(|log| log.text(&scope)))
    }
}

impl Watchpoint {
    /// Whether the moment at a position changes what is watched; `after` are the registers behind it.
    fn hits(&self, runs: &[Run<'_>], position: Position, after: &Registers) -> bool {
        let Some((run, moment)) =
            (runs.get(position.run)).and_then(|run| Some((run, run.moments.get(position.at)?)))
        else {
            return false;
        };
        let Some(change) = (moment.change.as_ref()).filter(|change| change.target == self.target)
        else {
            return false;
        };
        let (old, new) = (
            change.before[run.lane & 3],
            after.target(self.target)[run.lane & 3],
        );
        run.listing.kind() == self.kind
            && (self.mask.components()).any(|c| old[c].to_bits() != new[c].to_bits())
    }
}

/// Whether an instruction of a kind of shader begins after the first `at` moments of a run.
fn arrives(run: &Run<'_>, at: usize, kind: ShaderKind, instruction: usize) -> bool {
    let of = |moment: Option<&Moment>| moment.and_then(|moment| moment.instruction);
    let before = at.checked_sub(1).and_then(|at| run.moments.get(at));
    run.listing.kind() == kind
        && of(run.moments.get(at)) == Some(instruction)
        && of(before) != Some(instruction)
}

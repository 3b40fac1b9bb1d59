//! Moving through the runs, and what is said on arrival.

use super::{Arguments, Console, Fault, Outcome, Reply, look, place, tell};
use crate::debug::moment::Event;
use crate::debug::run::Run;
use crate::debug::session::{Direction, Position, Session};
use crate::debug::stops::{Occurrence, Reason, Until};
use crate::debug::text::{Line, Style, Text};

use Direction::{Backward, Forward};

/// What happened on the way.
#[derive(Default)]
struct Journey {
    logs: Vec<String>,
    reasons: Vec<Reason>,
    /// The moment that made one stop.
    cause: Option<Position>,
}

impl Journey {
    /// Whether something other than the goal made one stop.
    fn is_over(&self) -> bool {
        self.reasons.iter().any(|reason| *reason != Reason::Reached)
    }
}

/// How much is told of the way.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Tell {
    /// Every moment.
    All,
    /// The last moment only.
    Last,
}

pub(super) fn step(
    console: &mut Console,
    session: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    in_steps(console, session, arguments, Forward, one_moment)
}

pub(super) fn reverse_step(
    console: &mut Console,
    session: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    in_steps(console, session, arguments, Backward, one_moment)
}

pub(super) fn next(
    console: &mut Console,
    session: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    in_steps(console, session, arguments, Forward, one_instruction)
}

pub(super) fn reverse_next(
    console: &mut Console,
    session: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    in_steps(console, session, arguments, Backward, one_instruction)
}

/// The place one moment away; `None` at the end of everything.
fn one_moment(session: &Session<'_>, direction: Direction) -> Option<Position> {
    let Position { run, at } = session.position();
    let length = |run: usize| session.runs().get(run).map(|run| run.moments.len());
    match direction {
        Forward if at < length(run)? => Some(Position { run, at: at + 1 }),
        Forward => length(run + 1).map(|_| Position {
            run: run + 1,
            at: 0,
        }),
        Backward => match at.checked_sub(1) {
            Some(at) => Some(Position { run, at }),
            None => {
                let run = run.checked_sub(1)?;
                Some(Position {
                    run,
                    at: length(run)?,
                })
            }
        },
    }
}

/// The place behind, or before, all rows of an instruction.
fn one_instruction(session: &Session<'_>, direction: Direction) -> Option<Position> {
    let next = one_moment(session, direction)?;
    let here = session.position();
    let run = session.run().filter(|_| next.run == here.run);
    let group = run.map(|run| run.group(here.at.min(next.at)));
    let Some(group) = group.filter(|group| !group.is_empty()) else {
        return Some(next);
    };
    let at = match direction {
        Forward => group.end,
        Backward => group.start,
    };
    Some(Position { at, ..next })
}

/// Several steps; a breakpoint, a watchpoint or what is caught ends them early.
fn in_steps(
    console: &mut Console,
    session: &mut Session<'_>,
    arguments: &Arguments<'_>,
    direction: Direction,
    target: fn(&Session<'_>, Direction) -> Option<Position>,
) -> Outcome {
    let count = arguments.count()?;
    let from = session.position();
    let mut journey = Journey::default();
    for _ in 0..count {
        let Some(target) = target(session, direction) else {
            journey.reasons.push(Reason::End);
            break;
        };
        go(
            console,
            session,
            direction,
            &Until::Position(target),
            &mut journey,
        );
        if journey.is_over() {
            break;
        }
    }
    Ok(report(console, session, from, direction, journey, Tell::All).into())
}

fn go(
    console: &Console,
    session: &mut Session<'_>,
    direction: Direction,
    until: &Until,
    journey: &mut Journey,
) {
    let travel = session.travel(direction, &console.stops, until);
    journey
        .logs
        .extend(travel.logs.into_iter().map(|(_, text)| text));
    journey.reasons = travel.reasons;
    journey.cause = travel.moment;
}

/// Goes until something, and tells the last moment.
fn go_until(
    console: &mut Console,
    session: &mut Session<'_>,
    direction: Direction,
    until: &Until,
) -> Outcome {
    let from = session.position();
    let mut journey = Journey::default();
    go(console, session, direction, until, &mut journey);
    Ok(report(console, session, from, direction, journey, Tell::Last).into())
}

pub(super) fn resume(
    console: &mut Console,
    session: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    arguments.nothing()?;
    go_until(console, session, Forward, &Until::End)
}

pub(super) fn reverse_resume(
    console: &mut Console,
    session: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    arguments.nothing()?;
    go_until(console, session, Backward, &Until::End)
}

pub(super) fn until(
    console: &mut Console,
    session: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    until_in(console, session, arguments, Forward)
}

pub(super) fn reverse_until(
    console: &mut Console,
    session: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    until_in(console, session, arguments, Backward)
}

fn until_in(
    console: &mut Console,
    session: &mut Session<'_>,
    arguments: &Arguments<'_>,
    direction: Direction,
) -> Outcome {
    if arguments.text.is_empty() {
        return in_steps(console, session, arguments, direction, one_instruction);
    }
    let until = match arguments.text.parse::<Occurrence>() {
        Ok(occurrence) => Until::Occurrence(occurrence),
        Err(_) => {
            let place = place::place(session, arguments.text).map_err(|Fault(why)| {
                let names: Vec<_> = Occurrence::all().map(Occurrence::name).collect();
                format!("{why}; or what to wait for: {}", names.join(", "))
            })?;
            Until::Instruction {
                kind: place.kind,
                instruction: place.instruction,
            }
        }
    };
    go_until(console, session, direction, &until)
}

pub(super) fn advance(
    console: &mut Console,
    session: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    if arguments.text.is_empty() {
        return Err("advance to which line?".into());
    }
    let place = place::place(session, arguments.text)?;
    let until = Until::Instruction {
        kind: place.kind,
        instruction: place.instruction,
    };
    go_until(console, session, Forward, &until)
}

pub(super) fn finish(
    console: &mut Console,
    session: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    arguments.nothing()?;
    go_until(console, session, Forward, &Until::RunEnd)
}

pub(super) fn reverse_finish(
    console: &mut Console,
    session: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    arguments.nothing()?;
    go_until(console, session, Backward, &Until::RunEnd)
}

/// `start`, `run`: to the first instruction of the first run, or of run N.
pub(super) fn start(
    console: &mut Console,
    session: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    let run = match arguments.text {
        "" => 0,
        _ => run_number(session, arguments.text)?,
    };
    Ok(enter(console, session, run))
}

/// `frame`: the runs, or another one.
pub(super) fn frame(
    console: &mut Console,
    session: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    if arguments.text.is_empty() {
        return Ok(runs(session).into());
    }
    let run = run_number(session, arguments.text)?;
    Ok(enter(console, session, run))
}

pub(super) fn up(
    console: &mut Console,
    session: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    let count = arguments.count()? as usize;
    let run = session.position().run.checked_sub(count);
    let run = run.ok_or("no run comes before: `info runs` lists them")?;
    Ok(call(console, session, run))
}

pub(super) fn down(
    console: &mut Console,
    session: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    let count = arguments.count()? as usize;
    let run = session.position().run.saturating_add(count);
    if run >= session.runs().len() {
        return Err("no run comes behind: `info runs` lists them".into());
    }
    Ok(call(console, session, run))
}

/// Runs are counted from 1.
fn run_number(session: &Session<'_>, text: &str) -> Result<usize, Fault> {
    let number = text.parse::<usize>().ok().and_then(|n| n.checked_sub(1));
    number
        .filter(|number| *number < session.runs().len())
        .ok_or_else(|| format!("`{text}` is no run: `info runs` lists them").into())
}

/// To where one was in another run, or else to its end: what it left is what one asks for.
fn call(console: &mut Console, session: &mut Session<'_>, number: usize) -> Reply {
    let Position { run, at } = session.position();
    console.left.insert(run, at);
    let end = || {
        session
            .runs()
            .get(number)
            .map_or(0, |run| run.moments.len())
    };
    let at = console.left.get(&number).copied().unwrap_or_else(end);
    arrive(console, session, Position { run: number, at })
}

/// To the first instruction of a run, without looking at what lies between.
fn enter(console: &Console, session: &mut Session<'_>, number: usize) -> Reply {
    let at = session.runs().get(number).map_or(0, Run::first_instruction);
    arrive(console, session, Position { run: number, at })
}

fn arrive(console: &Console, session: &mut Session<'_>, position: Position) -> Reply {
    session.go_to(position);
    let mut text = Text::default();
    if let Some(run) = session.run() {
        text.line(tell::run_title(run));
    }
    text.append(arrival(console, session));
    text.into()
}

/// The runs of the subject, the one where one is marked.
pub(super) fn runs(session: &Session<'_>) -> Text {
    let mut text = Text::default();
    for (number, run) in session.runs().iter().enumerate() {
        let here = number == session.position().run;
        let mark = if here { "->" } else { "" };
        let title = tell::run_title(run);
        let mut line = Line::from(format!("{mark:<3}{:>2}  ", number + 1));
        line.pieces.extend(title.pieces);
        text.line(line.and(format!(", {} moments", run.moments.len()), Style::Dim));
    }
    text
}

/// `goto`: to a line or a moment, without looking at what lies between.
pub(super) fn goto(
    console: &mut Console,
    session: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    let here = session.position();
    let position = match (arguments.text, arguments.text.strip_prefix('@')) {
        ("", _) => return Err("go where? To a line, or to moment @N of this run".into()),
        (_, Some(moment)) => {
            let most = session.run().map_or(0, |run| run.moments.len());
            let at = moment.parse().ok().filter(|at| *at <= most);
            let at = at.ok_or_else(|| format!("moments of this run are @0 to @{most}"))?;
            Position { at, ..here }
        }
        (text, None) => {
            let place = place::place(session, text)?;
            place::position(session, place).ok_or("this instruction does not run")?
        }
    };
    session.go_to(position);
    let mut text = Text::default();
    if position.run != here.run
        && let Some(run) = session.run()
    {
        text.line(tell::run_title(run));
    }
    text.append(arrival(console, session));
    Ok(text.into())
}

/// What is said at a stop: why, what has changed, where one is, what is displayed.
fn report(
    console: &mut Console,
    session: &Session<'_>,
    from: Position,
    direction: Direction,
    journey: Journey,
    how: Tell,
) -> Text {
    let mut text = Text::default();
    for log in journey.logs {
        text.line(log);
    }
    let here = session.position();
    if here.run != from.run
        && let Some(run) = session.run()
    {
        text.line(tell::run_title(run));
    }
    for reason in &journey.reasons {
        if let Some(words) = reason_text(console, session, *reason, direction) {
            text.line(Line::styled(words, Style::Strong));
        }
    }
    if let Some(run) = session.run() {
        // Of another run only what lies on this side of its border.
        let (low, high) = match direction {
            Forward if here.run != from.run => (0, here.at),
            Forward => (from.at, here.at),
            Backward if here.run != from.run => (here.at, run.moments.len()),
            Backward => (here.at, from.at),
        };
        let range = match (how, direction) {
            _ if low >= high => low..low,
            (Tell::All, _) => low..high,
            (Tell::Last, Forward) => run.group(high - 1).start.max(low)..high,
            (Tell::Last, Backward) => low..run.group(low).end.min(high),
        };
        text.append(tell::moments(run, range, direction));
    }
    text.append(arrival(console, session));
    for reason in &journey.reasons {
        if let Reason::Breakpoint(id) = reason
            && let Some(at) = console.temporary.iter().position(|other| other == id)
        {
            console.temporary.remove(at);
            console
                .stops
                .breakpoints
                .retain(|point| point.action.id != *id);
        }
    }
    text
}

fn reason_text(
    console: &Console,
    session: &Session<'_>,
    reason: Reason,
    direction: Direction,
) -> Option<String> {
    match reason {
        Reason::Breakpoint(id) => Some(format!("breakpoint {id}")),
        Reason::Watchpoint(id) => {
            let point = console
                .stops
                .watchpoints
                .iter()
                .find(|point| point.action.id == id)?;
            let name = super::stopping::watched(point);
            Some(format!("watchpoint {id}: {name}"))
        }
        Reason::Occurrence(what) => Some(format!("stopped at {}", what.name())),
        Reason::Reached => None,
        Reason::End => match direction {
            Backward => Some("this is the beginning".to_string()),
            // The results follow.
            Forward if session.run().is_some() => Some("this is the end".to_string()),
            Forward => None,
        },
    }
}

/// Where one is, and what is displayed.
pub(super) fn arrival(console: &Console, session: &Session<'_>) -> Text {
    let mut text = location(session);
    if !console.quiet_displays {
        text.append(look::displayed(console, session));
    }
    text
}

/// What comes next.
pub(super) fn location(session: &Session<'_>) -> Text {
    let mut text = Text::default();
    let Some(run) = session.run() else {
        text.line("there is no run");
        return text;
    };
    let at = session.position().at;
    let Some(moment) = session.next_moment() else {
        let name = tell::run_name(run);
        text.line(Line::styled(format!("-> end of {name}"), Style::Marked));
        text.append(tell::results(run, session.registers()));
        return text;
    };
    if let Some(number) = moment.instruction {
        let line = tell::instruction(run, number, "->", Style::Marked);
        // Values that were set by hand may stand between the parts.
        let parts = run.moments.iter().enumerate();
        let parts = parts.filter(|(_, other)| other.instruction == Some(number));
        let (before, all) = parts.fold((0, 0), |(before, all), (other, _)| {
            (before + usize::from(other < at), all + 1)
        });
        text.line(match all {
            1 => line,
            _ => line.and(format!("   (part {} of {all})", before + 1), Style::Dim),
        });
        return text;
    }
    let what = tell::around(moment);
    let words = match (&moment.event, &moment.change) {
        (Event::Input(_), Some(change)) => {
            let name = tell::target_name(change.target, run.listing.kind());
            format!("-> {what} {name}")
        }
        _ => format!("-> {what}"),
    };
    text.line(Line::styled(words, Style::Marked));
    text
}

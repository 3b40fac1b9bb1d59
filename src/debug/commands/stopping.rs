//! Breakpoints, watchpoints, log points, and what is caught.

use super::{Arguments, Console, Fault, Outcome, Reply, place, tell};
use crate::debug::expression::{Expression, LogMessage};
use crate::debug::session::Session;
use crate::debug::stops::{Action, Breakpoint, HitCount, Occurrence, Watchpoint};
use crate::debug::text::{Line, Style, Text};

/// More breakpoints and watchpoints than this are refused.
const MOST_STOPS: usize = 1000;

impl Console {
    fn action(&mut self, condition: Option<Expression>, log: Option<LogMessage>) -> Action {
        Action {
            id: self.new_stop(),
            enabled: true,
            condition,
            hits: HitCount::Any,
            log,
        }
    }

    fn room_for_a_stop(&self) -> Result<(), Fault> {
        if self.stops.breakpoints.len() + self.stops.watchpoints.len() < MOST_STOPS {
            return Ok(());
        }
        Err(format!("there are {MOST_STOPS} breakpoints and watchpoints already").into())
    }

    fn actions(&mut self) -> impl Iterator<Item = &mut Action> {
        let breakpoints = self
            .stops
            .breakpoints
            .iter_mut()
            .map(|point| &mut point.action);
        let watchpoints = self
            .stops
            .watchpoints
            .iter_mut()
            .map(|point| &mut point.action);
        breakpoints.chain(watchpoints)
    }

    fn action_of(&mut self, id: u32) -> Result<&mut Action, Fault> {
        let found = self.actions().find(|action| action.id == id);
        found.ok_or_else(|| format!("there is no breakpoint or watchpoint {id}").into())
    }
}

/// Sets a breakpoint and tells where.
fn set(
    console: &mut Console,
    session: &Session<'_>,
    text: &str,
    condition: Option<Expression>,
    log: Option<LogMessage>,
) -> Result<(u32, Line), Fault> {
    console.room_for_a_stop()?;
    let place = place::place(session, text)?;
    let action = console.action(condition, log);
    let id = action.id;
    console.stops.breakpoints.push(Breakpoint {
        kind: place.kind,
        instruction: place.instruction,
        action,
    });
    let at = place::text(session, place);
    let listing = place::listing(session, place.kind);
    let instruction = listing.map(|listing| listing.text(place.instruction));
    let line = Line::from(format!(
        " {id} at {at}  {}",
        instruction.unwrap_or_default()
    ));
    Ok((id, line))
}

/// A word before a line.
fn headed(word: &str, line: Line) -> Line {
    Line::from(word).joined(line)
}

pub(super) fn breakpoint(
    console: &mut Console,
    session: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    let (text, condition) = place::condition(arguments.text)?;
    let (_, line) = set(console, session, text, condition, None)?;
    Ok(headed("breakpoint", line).into())
}

pub(super) fn temporary(
    console: &mut Console,
    session: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    let (text, condition) = place::condition(arguments.text)?;
    let (id, line) = set(console, session, text, condition, None)?;
    console.temporary.push(id);
    Ok(headed("temporary breakpoint", line).into())
}

/// `dprintf 12,"r0 is {r0}"`
pub(super) fn log_point(
    console: &mut Console,
    session: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    let usage = "write it as dprintf 12,\"r0 is {r0}\"";
    let (text, message) = arguments.text.split_once(',').ok_or(usage)?;
    let message = message.trim();
    let quoted = message
        .strip_prefix('"')
        .and_then(|rest| rest.strip_suffix('"'));
    let message = quoted.unwrap_or(message).parse()?;
    let (_, line) = set(console, session, text, None, Some(message))?;
    Ok(headed("log point", line).into())
}

pub(super) fn watchpoint(
    console: &mut Console,
    session: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    console.room_for_a_stop()?;
    let (text, condition) = place::condition(arguments.text)?;
    let run = session.run().ok_or("there is no run")?;
    let kind = run.listing.kind();
    let expression: Expression = text.parse()?;
    let scope = session.scope().ok_or("there is no run")?;
    // What the version does not have is told before that it is no register.
    expression.evaluate(&scope)?;
    let (target, mask) = expression.target(&run.listing).ok_or(
        "watch takes a register with components, such as r0.rg; display shows any expression after every stop",
    )?;
    let action = console.action(condition, None);
    let id = action.id;
    let point = Watchpoint {
        kind,
        target,
        mask,
        action,
    };
    let name = watched(&point);
    console.stops.watchpoints.push(point);
    Ok(format!("watchpoint {id}: {name}").into())
}

/// What a watchpoint watches.
pub(super) fn watched(point: &Watchpoint) -> String {
    let components = tell::mask_text(point.target, point.mask, point.kind);
    tell::target_name(point.target, point.kind) + &components
}

/// The numbers of an argument; all there are if it is empty.
fn numbers(console: &mut Console, arguments: &Arguments<'_>) -> Result<Vec<u32>, Fault> {
    if arguments.text.is_empty() {
        return Ok(console.actions().map(|action| action.id).collect());
    }
    let mut ids = Vec::new();
    for word in arguments.words() {
        let id = word.parse();
        let id = id.map_err(|_| format!("`{word}` is no number of a breakpoint"))?;
        console.action_of(id)?;
        ids.push(id);
    }
    Ok(ids)
}

pub(super) fn delete(
    console: &mut Console,
    _: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    let ids = numbers(console, arguments)?;
    let stays = |action: &Action| !ids.contains(&action.id);
    console
        .stops
        .breakpoints
        .retain(|point| stays(&point.action));
    console
        .stops
        .watchpoints
        .retain(|point| stays(&point.action));
    console.temporary.retain(|id| !ids.contains(id));
    Ok(told(&ids, "deleted"))
}

pub(super) fn enable(
    console: &mut Console,
    _: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    switch(console, arguments, true)
}

pub(super) fn disable(
    console: &mut Console,
    _: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    switch(console, arguments, false)
}

fn switch(console: &mut Console, arguments: &Arguments<'_>, enabled: bool) -> Outcome {
    let ids = numbers(console, arguments)?;
    for action in console.actions().filter(|action| ids.contains(&action.id)) {
        action.enabled = enabled;
    }
    Ok(told(&ids, if enabled { "enabled" } else { "disabled" }))
}

fn told(ids: &[u32], what: &str) -> Reply {
    if ids.is_empty() {
        return "there are no breakpoints and watchpoints"
            .to_string()
            .into();
    }
    let ids: Vec<String> = ids.iter().map(u32::to_string).collect();
    format!("{what}: {}", ids.join(", ")).into()
}

/// Splits `ID REST`.
fn numbered<'t>(arguments: &Arguments<'t>, usage: &str) -> Result<(u32, &'t str), Fault> {
    let text = arguments.text;
    let end = text.find(char::is_whitespace).unwrap_or(text.len());
    let (id, rest) = text.split_at(end);
    let id = id.parse().map_err(|_| format!("write it as {usage}"))?;
    Ok((id, rest.trim()))
}

pub(super) fn condition(
    console: &mut Console,
    _: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    let (id, text) = numbered(arguments, "condition 1 r0.x > 1")?;
    let condition = match text.strip_prefix("if ").unwrap_or(text) {
        "" => None,
        text => Some(text.parse()?),
    };
    let words = match &condition {
        None => format!("{id} stops always"),
        Some(condition) => format!("{id} stops only if {condition}"),
    };
    console.action_of(id)?.condition = condition;
    Ok(words.into())
}

pub(super) fn ignore(
    console: &mut Console,
    _: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    let (id, text) = numbered(arguments, "ignore 1 2")?;
    let count: u32 = text.parse().map_err(|_| "write it as ignore 1 2")?;
    console.action_of(id)?.hits = match count {
        0 => HitCount::Any,
        _ => HitCount::AtLeast(count.saturating_add(1)),
    };
    let hits = if count == 1 { "hit" } else { "hits" };
    Ok(format!("{id} passes over its first {count} {hits}").into())
}

pub(super) fn hits(
    console: &mut Console,
    _: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    let (id, text) = numbered(arguments, "hits 1 >= 3")?;
    let hits = match text {
        "" => HitCount::Any,
        _ => text.parse().map_err(|why| format!("{why}"))?,
    };
    console.action_of(id)?.hits = hits;
    Ok(format!("{id} stops at {}", hits_text(hits)).into())
}

fn hits_text(hits: HitCount) -> String {
    match hits {
        HitCount::Any => "every hit".to_string(),
        HitCount::Exactly(count) => format!("hit {count} only"),
        HitCount::AtLeast(count) => format!("hit {count} and later ones"),
        HitCount::Every(count) => format!("every {count}th hit"),
    }
}

/// `catch nan`, `catch`
pub(super) fn catch(
    console: &mut Console,
    _: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    let mut wanted = Vec::new();
    for word in arguments.words() {
        wanted.push(occurrence(word)?);
    }
    for what in wanted {
        if !console.stops.occurrences.contains(&what) {
            console.stops.occurrences.push(what);
        }
    }
    Ok(caught(console))
}

pub(super) fn uncatch(
    console: &mut Console,
    _: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    if arguments.text.is_empty() {
        console.stops.occurrences.clear();
    }
    let mut unwanted = Vec::new();
    for word in arguments.words() {
        unwanted.push(occurrence(word)?);
    }
    console
        .stops
        .occurrences
        .retain(|what| !unwanted.contains(what));
    Ok(caught(console))
}

fn occurrence(word: &str) -> Result<Occurrence, Fault> {
    let names: Vec<_> = Occurrence::all().map(Occurrence::name).collect();
    let known = word.parse::<Occurrence>().ok();
    known.ok_or_else(|| format!("`{word}`: what can be caught is {}", names.join(", ")).into())
}

fn caught(console: &Console) -> Reply {
    let names: Vec<_> = console
        .stops
        .occurrences
        .iter()
        .map(|what| what.name())
        .collect();
    match names.is_empty() {
        true => "nothing is caught".to_string().into(),
        false => format!("caught: {}", names.join(", ")).into(),
    }
}

/// `info break`, `info watch`: all of them, by number.
pub(super) fn list(console: &Console, session: &Session<'_>) -> Text {
    let mut rows: Vec<(u32, Line)> = Vec::new();
    for point in &console.stops.breakpoints {
        let place = place::Place {
            kind: point.kind,
            instruction: point.instruction,
        };
        let what = match (
            &point.action.log,
            console.temporary.contains(&point.action.id),
        ) {
            (Some(_), _) => "log point",
            (None, true) => "temporary",
            (None, false) => "breakpoint",
        };
        let at = place::text(session, place);
        let listing = place::listing(session, place.kind);
        let instruction = listing.map(|listing| listing.text(place.instruction));
        let text = format!("{at}  {}", instruction.unwrap_or_default());
        rows.push((point.action.id, row(what, &text, &point.action)));
    }
    for point in &console.stops.watchpoints {
        rows.push((
            point.action.id,
            row("watchpoint", &watched(point), &point.action),
        ));
    }
    rows.sort_by_key(|(id, _)| *id);
    let mut text = Text::default();
    if rows.is_empty() {
        text.line("there are no breakpoints and watchpoints");
    }
    text.lines.extend(rows.into_iter().map(|(_, line)| line));
    if !console.stops.occurrences.is_empty() {
        text.append(caught(console).text);
    }
    text
}

fn row(what: &str, at: &str, action: &Action) -> Line {
    let mut line = Line::from(format!("{:>3}  {what:<11} {at}", action.id));
    if let Some(condition) = &action.condition {
        line = line.plain(format!("   if {condition}"));
    }
    if action.hits != HitCount::Any {
        line = line.plain(format!("   at {}", hits_text(action.hits)));
    }
    if let Some(log) = &action.log {
        line = line.plain(format!("   \"{log}\""));
    }
    match action.enabled {
        true => line,
        false => line.and("   disabled", Style::Dim),
    }
}

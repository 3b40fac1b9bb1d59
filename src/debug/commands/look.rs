//! `print`, `display`, `list`, `where`: what is looked at where one is.

use super::{Arguments, Console, Display, Fault, Outcome, Reply, place, tell, travel};
use crate::debug::expression::{Expression, Format, Scope};
use crate::debug::run::Listing;
use crate::debug::session::Session;
use crate::debug::text::{Line, Style, Text};

/// More displays than this are refused.
const MOST_DISPLAYS: usize = 100;

pub(super) fn print(
    _: &mut Console,
    session: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    if arguments.text.is_empty() {
        return Err("print what? `print r0.rgb`, `print/x c1`, `print dp3(r0, r1)`".into());
    }
    let expression: Expression = arguments.text.parse()?;
    let format = arguments.format.unwrap_or_default();
    Ok(value_line(session, &expression, format)?.into())
}

/// `r0.rg = 0.5, 0.25`
fn value_line(
    session: &Session<'_>,
    expression: &Expression,
    format: Format,
) -> Result<Line, Fault> {
    let scope = session.scope().ok_or("there is no run")?;
    let value = expression.evaluate(&scope)?;
    let note = unwritten(expression, &scope).map_or(String::new(), |name| {
        format!("   (nothing has written {name})")
    });
    Ok(tell::value_line(
        &expression.to_string(),
        &value,
        format,
        &note,
    ))
}

/// The components of a register that nothing has written, if the expression is a register alone and there are some.
fn unwritten(expression: &Expression, scope: &Scope<'_>) -> Option<String> {
    let (target, mask) = expression.target_here(scope)?;
    let unwritten = mask.without(scope.registers.written(target.slot()?));
    if unwritten.is_empty() {
        return None;
    }
    let kind = scope.run.listing.kind();
    Some(tell::target_name(target, kind) + &tell::mask_text(target, unwritten, kind))
}

pub(super) fn display(
    console: &mut Console,
    session: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    if arguments.text.is_empty() {
        return Ok(displayed(console, session).into());
    }
    if console.displays.len() >= MOST_DISPLAYS {
        return Err(format!("{MOST_DISPLAYS} expressions are displayed already").into());
    }
    let expression: Expression = arguments.text.parse()?;
    console.last_display += 1;
    let display = Display {
        id: console.last_display,
        expression,
        format: arguments.format.unwrap_or_default(),
    };
    let line = display_line(session, &display);
    console.displays.push(display);
    Ok(line.into())
}

/// The displays with their values. One that has no value here, because it names registers of the other shader, says so.
pub(super) fn displayed(console: &Console, session: &Session<'_>) -> Text {
    Text {
        lines: (console.displays.iter())
            .map(|display| display_line(session, display))
            .collect(),
    }
}

fn display_line(session: &Session<'_>, display: &Display) -> Line {
    let mut line = Line::styled(format!("{:>3}: ", display.id), Style::Dim);
    match value_line(session, &display.expression, display.format) {
        Ok(value) => line.pieces.extend(value.pieces),
        Err(Fault(why)) => line = line.and(format!("{}: {why}", display.expression), Style::Dim),
    }
    line
}

pub(super) fn undisplay(
    console: &mut Console,
    _: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    let mut ids = Vec::new();
    for word in arguments.words() {
        let id = word.parse::<u32>().ok();
        let known = id.filter(|id| console.displays.iter().any(|display| display.id == *id));
        ids.push(known.ok_or_else(|| format!("`{word}` is no number of a display"))?);
    }
    let all = ids.is_empty();
    console
        .displays
        .retain(|display| !all && !ids.contains(&display.id));
    Ok(format!("{} left", console.displays.len()).into())
}

/// `list`: the lines around the next instruction, then those that follow; `list LINE`: the lines around one.
pub(super) fn list(
    console: &mut Console,
    session: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    /// Lines shown at once, and how many of them stand before the one in the middle.
    const SHOWN: usize = 11;
    const BEFORE: usize = 5;
    let (listing, first) = match (arguments.text, console.listed) {
        ("", Some((kind, line))) => {
            let listing = place::listing(session, kind).ok_or("there is no listing")?;
            (listing, line)
        }
        ("", None) => {
            let listing = session.run().ok_or("there is no run")?.listing;
            let last = listing.program.instructions().count().saturating_sub(1);
            let line = listing.line(session.next_instruction().unwrap_or(last));
            (listing, line.saturating_sub(BEFORE))
        }
        (text, _) => {
            let place = place::place(session, text)?;
            let listing = place::listing(session, place.kind).ok_or("there is no listing")?;
            // Around the line that was named, whether an instruction stands there or not.
            let named = text
                .rsplit(':')
                .next()
                .and_then(|line| line.trim().parse::<usize>().ok());
            let line = named.unwrap_or_else(|| listing.line(place.instruction));
            (listing, line.saturating_sub(BEFORE))
        }
    };
    let first = first.max(1);
    let last = last_line(&listing);
    if first > last {
        return Err(format!("the listing has {last} lines").into());
    }
    let end = last.min(first + SHOWN - 1);
    let mut text = Text::default();
    for line in first..=end {
        text.line(source_line(console, session, &listing, line));
    }
    console.listed = Some((listing.kind(), end + 1));
    Ok(text.into())
}

fn last_line(listing: &Listing<'_>) -> usize {
    let file = listing.sources.file_of(listing.program.span.start);
    file.map_or(0, |file| {
        let end = file.span().end - file.span().start;
        let last = file.line_at(end);
        // What stands behind the last line end is no line.
        if file.line(last).is_empty() {
            last - 1
        } else {
            last
        }
    })
}

/// A line of the source, with `->` where one is and `*` where a breakpoint stands.
fn source_line(
    console: &Console,
    session: &Session<'_>,
    listing: &Listing<'_>,
    line: usize,
) -> Line {
    let kind = listing.kind();
    let here = session.run().is_some_and(|run| {
        let next = session.next_instruction();
        run.listing.kind() == kind && next.is_some_and(|next| listing.line(next) == line)
    });
    let stops = console.stops.breakpoints.iter().any(|point| {
        point.kind == kind && listing.line(point.instruction) == line && point.action.enabled
    });
    let source = listing.sources.file_of(listing.program.span.start);
    let source = source.map_or(&[][..], |file| file.line(line));
    let arrow = if here { "->" } else { "  " };
    let star = if stops { "*" } else { " " };
    let style = if here { Style::Marked } else { Style::Plain };
    let source = String::from_utf8_lossy(source).replace('\t', "    ");
    Line::styled(format!("{arrow}{star}{line:>4} {source}"), style)
}

pub(super) fn whereabouts(
    console: &mut Console,
    session: &mut Session<'_>,
    arguments: &Arguments<'_>,
) -> Outcome {
    arguments.nothing()?;
    let mut text = Text::default();
    if let Some(run) = session.run() {
        let at = session.position().at;
        let title = tell::run_title(run);
        text.line(title.and(
            format!(", moment {at} of {}", run.moments.len()),
            Style::Dim,
        ));
    }
    text.append(travel::arrival(console, session));
    Ok(text.into())
}

pub(super) fn quit(_: &mut Console, _: &mut Session<'_>, _: &Arguments<'_>) -> Outcome {
    Ok(Reply {
        quit: true,
        ..Reply::default()
    })
}

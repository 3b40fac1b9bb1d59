//! Breakpoints: on lines, on registers, on what is remarkable.

use super::adapter::{Adapter, expression};
use super::protocol::{
    Answer, Breakpoint, BreakpointEvent, BreakpointLocations, BreakpointLocationsArguments,
    Breakpoints, DataBreakpoint, DataBreakpointInfo, DataBreakpointInfoArguments, Event, Handled,
    Refusal, SetBreakpointsArguments, SetDataBreakpointsArguments,
    SetExceptionBreakpointsArguments, SourceBreakpoint,
};
use super::sources::Key;
use texcrd::debug::{
    Action, Console, HitCount, Listing, LogMessage, Occurrence, Target, Watchpoint,
};
use texcrd::diagnostic::{SourceFile, Span};
use texcrd::isa::{ShaderKind, WriteMask};

/// The most breakpoints of one kind. Editors set as many as a person has patience for.
const MOST: usize = 1000;

/// What the client wants to stop at. It outlives a restart.
#[derive(Debug, Default)]
pub(super) struct Wanted {
    lines: Vec<Line>,
    data: Vec<Data>,
    /// What stops, by the client's wish or by command.
    pub console: Console,
    /// The numbers of those breakpoints and watchpoints in the console that stand here.
    placed: Vec<u32>,
}

#[derive(Debug)]
struct Line {
    key: Option<Key>,
    asked: SourceBreakpoint,
    /// What the client knows of it.
    told: Breakpoint,
}

#[derive(Debug)]
struct Data {
    asked: DataBreakpoint,
    told: Breakpoint,
}

impl Wanted {
    /// A breakpoint of which nothing is known before the program is there.
    fn pending(&mut self) -> Breakpoint {
        Breakpoint {
            id: Some(self.console.new_stop()),
            message: Some("nothing is launched yet".to_string()),
            reason: Some("pending"),
            ..Breakpoint::default()
        }
    }

    /// `setBreakpoints`: those of one text, instead of those before. What they come to is not known yet.
    ///
    /// # Errors
    /// They are too many.
    pub(super) fn set_lines(&mut self, arguments: &SetBreakpointsArguments) -> Handled {
        let key = Key::of(&arguments.source);
        let bare = arguments
            .lines
            .iter()
            .flatten()
            .map(|line| SourceBreakpoint {
                line: *line,
                ..SourceBreakpoint::default()
            });
        let asked = match &arguments.breakpoints {
            Some(breakpoints) => breakpoints.clone(),
            None => bare.collect(),
        };
        self.lines.retain(|line| line.key != key);
        few(self.lines.len() + asked.len())?;
        for asked in asked {
            let told = self.pending();
            let key = key.clone();
            self.lines.push(Line { key, asked, told });
        }
        let of_this = self.lines.iter().filter(|line| line.key == key);
        Ok(answer(of_this.map(|line| &line.told)))
    }

    /// `setDataBreakpoints`, in the same way.
    ///
    /// # Errors
    /// They are too many.
    pub(super) fn set_data(&mut self, arguments: &SetDataBreakpointsArguments) -> Handled {
        few(arguments.breakpoints.len())?;
        self.data.clear();
        for asked in &arguments.breakpoints {
            let told = self.pending();
            let asked = asked.clone();
            self.data.push(Data { asked, told });
        }
        Ok(answer(self.data.iter().map(|data| &data.told)))
    }

    /// `setExceptionBreakpoints`
    pub(super) fn set_occurrences(
        &mut self,
        arguments: &SetExceptionBreakpointsArguments,
    ) -> Handled {
        let occurrences = &mut self.console.stops.occurrences;
        occurrences.clear();
        let mut breakpoints = Vec::new();
        for name in arguments.filters.iter().take(MOST) {
            let found = Occurrence::all().find(|occurrence| occurrence.name() == name);
            let unknown = || format!("there is no filter `{name}`");
            breakpoints.push(Breakpoint {
                verified: found.is_some(),
                message: found.is_none().then(unknown),
                ..Breakpoint::default()
            });
            occurrences.extend(found);
        }
        Ok(answer(breakpoints.iter()))
    }
}

fn few(count: usize) -> Result<(), Refusal> {
    if count <= MOST {
        return Ok(());
    }
    Err(Refusal::request(format!(
        "more than {MOST} breakpoints are not taken"
    )))
}

fn answer<'b>(breakpoints: impl Iterator<Item = &'b Breakpoint>) -> Answer {
    let breakpoints = breakpoints.cloned().collect();
    Answer::of(&Breakpoints { breakpoints })
}

/// A breakpoint that there can be, and what the client is told of it.
type Found<T> = (T, Breakpoint);

impl<'a> Adapter<'_, 'a> {
    pub(super) fn set_breakpoints(&mut self, arguments: &SetBreakpointsArguments) -> Handled {
        self.wanted.set_lines(arguments)?;
        self.resolve();
        let key = Key::of(&arguments.source);
        let of_this = self.wanted.lines.iter().filter(|line| line.key == key);
        Ok(answer(of_this.map(|line| &line.told)))
    }

    pub(super) fn set_data_breakpoints(
        &mut self,
        arguments: &SetDataBreakpointsArguments,
    ) -> Handled {
        self.wanted.set_data(arguments)?;
        self.resolve();
        Ok(answer(self.wanted.data.iter().map(|data| &data.told)))
    }

    pub(super) fn set_exception_breakpoints(
        &mut self,
        arguments: &SetExceptionBreakpointsArguments,
    ) -> Handled {
        let answer = self.wanted.set_occurrences(arguments)?;
        self.resolve();
        Ok(answer)
    }

    /// Puts what the client wants into the stops of the session. Events for those breakpoints of which the client knows something
    /// else.
    pub(super) fn resolve(&mut self) -> Vec<Event> {
        let lines: Vec<_> = (self.wanted.lines.iter())
            .map(|line| self.line(line))
            .collect();
        let data: Vec<_> = (self.wanted.data.iter())
            .map(|data| self.data(data))
            .collect();
        let Wanted {
            lines: own_lines,
            data: own_data,
            console,
            placed,
        } = &mut *self.wanted;
        let stops = &mut console.stops;
        stops
            .breakpoints
            .retain(|other| !placed.contains(&other.action.id));
        stops
            .watchpoints
            .retain(|other| !placed.contains(&other.action.id));
        placed.clear();
        let mut events = Vec::new();
        for (line, found) in own_lines.iter_mut().zip(lines) {
            let told = told(&line.told, found, |breakpoint| {
                placed.push(breakpoint.action.id);
                stops.breakpoints.push(breakpoint);
            });
            events.extend(changed(&mut line.told, told));
        }
        for (data, found) in own_data.iter_mut().zip(data) {
            let told = told(&data.told, found, |watchpoint| {
                placed.push(watchpoint.action.id);
                stops.watchpoints.push(watchpoint);
            });
            events.extend(changed(&mut data.told, told));
        }
        events
    }

    /// Forgets the breakpoints of the client that a command has deleted. Events for each.
    pub(super) fn deleted(&mut self) -> Vec<Event> {
        let Wanted {
            lines,
            data,
            console,
            placed,
        } = &mut *self.wanted;
        let stops = &console.stops;
        let left: Vec<u32> = (stops.breakpoints.iter().map(|stop| stop.action.id))
            .chain(stops.watchpoints.iter().map(|stop| stop.action.id))
            .collect();
        let gone = |told: &Breakpoint| {
            told.id
                .is_some_and(|id| placed.contains(&id) && !left.contains(&id))
        };
        let told = (lines.iter().map(|line| &line.told)).chain(data.iter().map(|data| &data.told));
        let removed = told.filter(|told| gone(told)).map(|told| {
            let breakpoint = Breakpoint {
                id: told.id,
                ..Breakpoint::default()
            };
            let reason = "removed";
            Event::new("breakpoint", &BreakpointEvent { reason, breakpoint })
        });
        let events = removed.collect();
        lines.retain(|line| !gone(&line.told));
        data.retain(|data| !gone(&data.told));
        placed.retain(|id| left.contains(id));
        events
    }

    fn line(&self, line: &Line) -> Result<Found<texcrd::debug::Breakpoint>, String> {
        let asked = &line.asked;
        let key = line.key.as_ref().ok_or("the breakpoint is in no text")?;
        let text = self.sources.find(key);
        let text = text.ok_or("this text is no part of what is debugged")?;
        let wanted = self.client.line_of(asked.line);
        let column = asked.column.map(|column| self.client.column_of(column));
        let listings = self.listings();
        let instruction = listings.iter().find_map(|listing| {
            let place = self.instruction(listing, text, wanted, column)?;
            Some((listing, place))
        });
        let (listing, (number, span)) = instruction.ok_or("no instruction stands here or below")?;
        let action = action(
            line.told.id,
            asked.condition.as_deref(),
            asked.hit_condition.as_deref(),
            asked.log_message.as_deref(),
        )?;
        let (source, range) = self.place_of(span);
        let breakpoint = texcrd::debug::Breakpoint {
            kind: listing.kind(),
            instruction: number,
            action,
        };
        let told = Breakpoint {
            id: line.told.id,
            verified: true,
            source,
            range: Some(range),
            ..Breakpoint::default()
        };
        Ok((breakpoint, told))
    }

    /// The first instruction of a text on a line, from a column on if there is one, or else on the next line that has one.
    fn instruction(
        &self,
        listing: &Listing<'_>,
        text: &SourceFile,
        line: usize,
        column: Option<usize>,
    ) -> Option<(usize, Span)> {
        let on_line = self
            .sources
            .instructions(listing, text)
            .filter(|(at, ..)| *at >= line);
        let places: Vec<_> = on_line.collect();
        let first = places.iter().map(|(line, ..)| *line).min()?;
        let on_it = || places.iter().filter(|(line, ..)| *line == first);
        let behind = on_it().find(|(_, _, span)| {
            let range = self.sources.range(*span, self.client);
            column.is_none_or(|column| self.client.column_of(range.column) >= column)
        });
        let (_, number, span) = behind.or(on_it().next())?;
        Some((*number, *span))
    }

    pub(super) fn breakpoint_locations(
        &mut self,
        arguments: &BreakpointLocationsArguments,
    ) -> Handled {
        let first = self.client.line_of(arguments.line);
        let last = arguments
            .end_line
            .map_or(first, |line| self.client.line_of(line));
        let text = Key::of(&arguments.source).and_then(|key| self.sources.find(&key));
        let mut spans = Vec::new();
        if let Some(text) = text {
            for listing in &self.listings() {
                let places = self.sources.instructions(listing, text);
                let inside = places.filter(|(line, ..)| (first..=last).contains(line));
                spans.extend(inside.map(|(_, _, span)| span));
            }
        }
        spans.sort_unstable();
        let breakpoints = spans.into_iter();
        let breakpoints = breakpoints.map(|span| self.sources.range(span, self.client));
        let breakpoints = breakpoints.collect();
        Ok(Answer::of(&BreakpointLocations { breakpoints }))
    }

    pub(super) fn data_breakpoint_info(
        &mut self,
        arguments: &DataBreakpointInfoArguments,
    ) -> Handled {
        let name = &arguments.name;
        let found = match arguments.variables_reference {
            Some(reference) if reference > 0 => {
                self.settable(reference, name)?.map(|(view, set)| {
                    let kind = view.run.listing.kind();
                    (kind, set.target, set.mask, set.name)
                })
            }
            _ => {
                let view = self.view_of(arguments.frame_id)?;
                let target = expression(name)?.target_here(&view.scope(view.run.lane));
                let name = name.trim().to_string();
                target.map(|(target, mask)| (view.run.listing.kind(), target, mask, name))
            }
        };
        let Some((kind, target, mask, name)) = found else {
            return Ok(Answer::of(&DataBreakpointInfo {
                data_id: None,
                description: format!("`{name}` is no register that could be watched"),
                access_types: Vec::new(),
                can_persist: false,
            }));
        };
        Ok(Answer::of(&DataBreakpointInfo {
            data_id: Some(data_id(kind, target, mask)),
            description: name,
            access_types: vec!["write"],
            can_persist: true,
        }))
    }

    fn data(&self, data: &Data) -> Result<Found<Watchpoint>, String> {
        let asked = &data.asked;
        if asked
            .access_type
            .as_deref()
            .is_some_and(|access| access != "write")
        {
            return Err("registers are watched for changes only".to_string());
        }
        let (kind, target, mask) = watched(&asked.data_id).ok_or("there is no such register")?;
        let action = action(
            data.told.id,
            asked.condition.as_deref(),
            asked.hit_condition.as_deref(),
            None,
        )?;
        let watchpoint = Watchpoint {
            kind,
            target,
            mask,
            action,
        };
        let told = Breakpoint {
            id: data.told.id,
            verified: true,
            ..Breakpoint::default()
        };
        Ok((watchpoint, told))
    }
}

/// What the client is to be told of a breakpoint; one that there can be is kept.
fn told<T>(
    before: &Breakpoint,
    found: Result<Found<T>, String>,
    keep: impl FnOnce(T),
) -> Breakpoint {
    match found {
        Ok((breakpoint, told)) => {
            keep(breakpoint);
            told
        }
        Err(message) => Breakpoint {
            id: before.id,
            message: Some(message),
            reason: Some("failed"),
            ..Breakpoint::default()
        },
    }
}

/// Replaces what the client knows of a breakpoint; an event if that is something else.
fn changed(known: &mut Breakpoint, told: Breakpoint) -> Option<Event> {
    if *known == told {
        return None;
    }
    known.clone_from(&told);
    Some(Event::new(
        "breakpoint",
        &BreakpointEvent {
            reason: "changed",
            breakpoint: told,
        },
    ))
}

/// What a breakpoint does; texts that are empty are none.
fn action(
    id: Option<u32>,
    condition: Option<&str>,
    hits: Option<&str>,
    log: Option<&str>,
) -> Result<Action, String> {
    let written = |text: Option<&str>| {
        text.map(str::trim)
            .filter(|t| !t.is_empty())
            .map(str::to_string)
    };
    let condition = written(condition).map(|text| expression(&text)).transpose();
    let hits = written(hits)
        .map(|text| text.parse::<HitCount>())
        .transpose();
    let log = written(log)
        .map(|text| text.parse::<LogMessage>())
        .transpose();
    Ok(Action {
        id: id.unwrap_or_default(),
        enabled: true,
        condition: condition.map_err(|refusal| refusal.message)?,
        hits: hits
            .map_err(|error| error.to_string())?
            .unwrap_or(HitCount::Any),
        log: log.map_err(|error| error.to_string())?,
    })
}

/// A register of a kind of shader as a text that the client keeps, also beyond this session: `pixel r0 3`.
fn data_id(kind: ShaderKind, target: Target, mask: WriteMask) -> String {
    let kind = match kind {
        ShaderKind::Vertex => "vertex",
        ShaderKind::Pixel => "pixel",
    };
    let register = match target {
        Target::Slot(slot) => format!("s{}", slot.index()),
        Target::Constant(index) => format!("c{index}"),
    };
    format!("{kind} {register} {}", mask.bits())
}

/// The other way from [`data_id`].
fn watched(id: &str) -> Option<(ShaderKind, Target, WriteMask)> {
    let mut words = id.split(' ');
    let kind = match words.next()? {
        "vertex" => ShaderKind::Vertex,
        "pixel" => ShaderKind::Pixel,
        _ => return None,
    };
    let register = words.next()?;
    let target = match register.split_at_checked(1)? {
        ("s", index) => {
            let index: usize = index.parse().ok()?;
            Target::Slot(texcrd::kernel::Slot::all().nth(index)?)
        }
        ("c", index) => Target::Constant(index.parse().ok()?),
        _ => return None,
    };
    let bits: u8 = words.next()?.parse().ok()?;
    let mask = WriteMask::from_bits(bits);
    (words.next().is_none() && mask.bits() == bits && bits != 0).then_some((kind, target, mask))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn registers_come_back_from_their_texts() {
        for slot in texcrd::kernel::Slot::all() {
            let there = (ShaderKind::Pixel, Target::Slot(slot), WriteMask::XY);
            assert_eq!(watched(&data_id(there.0, there.1, there.2)), Some(there));
        }
        let there = (ShaderKind::Vertex, Target::Constant(95), WriteMask::ALL);
        assert_eq!(watched(&data_id(there.0, there.1, there.2)), Some(there));
        for wrong in [
            "",
            "pixel",
            "pixel s0",
            "pixel s999 1",
            "pixel s0 0",
            "pixel s0 16",
            "pixel x0 1",
            "pixel s0 1 1",
            "pixel ä 1",
        ] {
            assert_eq!(watched(wrong), None, "{wrong}");
        }
    }
}

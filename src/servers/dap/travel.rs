//! Moving through the recording, and telling the client where that led.

use super::adapter::{Adapter, THREAD};
use super::protocol::{
    Answer, Category, Continued, Event, ExceptionDetails, ExceptionFilter, ExceptionInfo, Exited,
    GotoArguments, GotoTarget, GotoTargets, GotoTargetsArguments, Granularity, Handled, Output,
    Refusal, StepArguments, Stopped,
};
use super::sources::Key;
use texcrd::debug::{Direction, Occurrence, Position, Reason, RunKind, Travel, Until};
use texcrd::isa::ShaderKind;

/// The filters that the client offers to people, with the words for them.
pub(super) fn filters() -> impl Iterator<Item = ExceptionFilter> {
    Occurrence::all().map(|occurrence| {
        let (label, description) = words(occurrence);
        ExceptionFilter {
            filter: occurrence.name(),
            label,
            description,
            default: occurrence == Occurrence::Nan,
        }
    })
}

/// What an occurrence is called, and what it means.
fn words(occurrence: Occurrence) -> (&'static str, &'static str) {
    match occurrence {
        Occurrence::Nan => (
            "NaN is born",
            "An instruction makes NaN, and nothing that it read was NaN.",
        ),
        Occurrence::Infinite => (
            "Infinity is born",
            "An instruction makes an infinite number, or the largest one that rcp, rsq and log of 0 give in its place, out of smaller ones.",
        ),
        Occurrence::Clamp => (
            "A value is clamped",
            "_sat or another clamp makes a value another one.",
        ),
        Occurrence::Uninitialised => (
            "Uninitialised read",
            "A component of a register is read that nothing has written.",
        ),
        Occurrence::OutOfRange => (
            "Constant out of range",
            "c[a0.x + n] names a constant that there is not; it reads 0, 0, 0, 0.",
        ),
        Occurrence::Sample => ("A texture is sampled", "An instruction samples a texture."),
    }
}

impl Adapter<'_, '_> {
    /// `configurationDone`: the client is ready, the program runs.
    pub(super) fn start(&mut self) -> Handled {
        if self.started {
            return Err(Refusal::here("it runs already"));
        }
        Ok(Answer::done(self.run()))
    }

    /// Begins: stops at the first instruction, or runs on to whatever there is to stop at.
    ///
    /// Of a pixel that first instruction is the pixel shader's, unless a breakpoint waits in the vertex shader, which runs before.
    pub(super) fn run(&mut self) -> Vec<Event> {
        self.started = true;
        let waits = |kind| {
            let mut breakpoints = self.wanted.console.stops.breakpoints.iter();
            breakpoints.any(|breakpoint| breakpoint.kind == kind)
        };
        let entry = self.arguments.stop_on_entry.unwrap_or(true);
        let debugged = !self.arguments.no_debug.unwrap_or(false);
        if entry && debugged {
            let first = self.session.runs().first();
            if let Some(first) = first.filter(|_| waits(ShaderKind::Vertex)) {
                let at = first.first_instruction();
                self.session.go_to(Position { run: 0, at });
            }
            return vec![stopped("entry", None)];
        }
        self.session.go_to(Position::default());
        if debugged {
            return self.travel(Direction::Forward, &Until::End);
        }
        // Without debugging nothing stops; what is wanted is kept for another time.
        let stops = std::mem::take(&mut self.wanted.console.stops);
        let mut events = self.travel(Direction::Forward, &Until::End);
        self.wanted.console.stops = stops;
        let results = self
            .wanted
            .console
            .execute(&mut self.session, "info outputs");
        events.insert(0, Event::output(Category::Stdout, results.text.to_string()));
        events
    }

    pub(super) fn next(&mut self, arguments: &StepArguments) -> Handled {
        self.step(
            Direction::Forward,
            arguments.granularity.unwrap_or_default(),
        )
    }

    pub(super) fn step_back(&mut self, arguments: &StepArguments) -> Handled {
        self.step(
            Direction::Backward,
            arguments.granularity.unwrap_or_default(),
        )
    }

    pub(super) fn step_in(&mut self) -> Handled {
        self.step(Direction::Forward, Granularity::Instruction)
    }

    /// `stepOut`: to the end of the run, or from there to the end of the next one.
    pub(super) fn step_out(&mut self) -> Handled {
        self.check_started()?;
        Ok(Answer::done(
            self.travel(Direction::Forward, &Until::RunEnd),
        ))
    }

    fn step(&mut self, direction: Direction, granularity: Granularity) -> Handled {
        self.check_started()?;
        let here = self.session.position();
        let line = self.line_of_here();
        // The session itself knows how far a step goes; then the way there is gone past all stops.
        let moved = match granularity {
            Granularity::Instruction => self.session.advance(direction),
            Granularity::Statement => self.session.next(direction),
            Granularity::Line => {
                let moved = self.session.next(direction);
                while moved
                    && self.line_of_here() == line
                    && self.session.position().run == here.run
                {
                    if !self.session.next(direction) {
                        break;
                    }
                }
                moved
            }
        };
        let target = self.session.position();
        self.session.go_to(here);
        Ok(self.travel_to(direction, moved.then_some(target)))
    }

    fn line_of_here(&self) -> Option<usize> {
        let run = self.session.run()?;
        Some(run.listing.line(self.session.next_instruction()?))
    }

    fn travel_to(&mut self, direction: Direction, target: Option<Position>) -> Answer {
        let events = match target {
            Some(target) => self.travel(direction, &Until::Position(target)),
            None => {
                self.leave();
                vec![at_an_end(direction)]
            }
        };
        Answer::done(events)
    }

    /// `continue`
    pub(super) fn go_on(&mut self) -> Handled {
        self.go(Direction::Forward)
    }

    /// `reverseContinue`
    pub(super) fn go_back(&mut self) -> Handled {
        self.go(Direction::Backward)
    }

    fn go(&mut self, direction: Direction) -> Handled {
        self.check_started()?;
        let events = self.travel(direction, &Until::End);
        let body = Continued {
            all_threads_continued: true,
        };
        Ok(Answer::then(&body, events))
    }

    /// `pause`: whoever can ask for it finds the program stopped already.
    pub(super) fn pause(&mut self) -> Handled {
        self.check_started()?;
        Ok(Answer::done(vec![stopped("pause", None)]))
    }

    pub(super) fn restart_frame(&mut self, frame: i64) -> Handled {
        self.check_started()?;
        let view = self.view_of(Some(frame))?;
        let (run, at) = (view.number, view.run.first_instruction());
        self.leave();
        self.session.go_to(Position { run, at });
        Ok(Answer::done(vec![stopped("restart", None)]))
    }

    pub(super) fn goto_targets(&mut self, arguments: &GotoTargetsArguments) -> Handled {
        let line = self.client.line_of(arguments.line);
        let text = Key::of(&arguments.source).and_then(|key| self.sources.find(&key));
        let text = text.ok_or_else(|| Refusal::here("this text is no part of what is debugged"))?;
        let several = self.session.runs().len() > 1;
        let mut found = Vec::new();
        for (number, run) in self.session.runs().iter().enumerate() {
            let on_line = self
                .sources
                .instructions(&run.listing, text)
                .filter(|(at, ..)| *at == line);
            for (_, instruction, span) in on_line {
                let is_it = |m: &texcrd::debug::Moment| m.instruction == Some(instruction);
                let Some(at) = run.moments.iter().position(is_it) else {
                    continue;
                };
                let of = match run.kind {
                    _ if !several => String::new(),
                    RunKind::Vertex { vertex, .. } => format!(" of vertex {vertex}"),
                    RunKind::Pixel { .. } | RunKind::Listing => " of the pixel".to_string(),
                };
                let label = format!("{}{of}", run.listing.text(instruction));
                found.push((Position { run: number, at }, label, span));
            }
        }
        let mut targets = Vec::new();
        for (position, label, span) in found {
            targets.push(GotoTarget {
                id: self.target(position),
                label,
                range: self.sources.range(span, self.client),
                instruction_pointer_reference: format!("{}:{}", position.run, position.at),
            });
        }
        Ok(Answer::of(&GotoTargets { targets }))
    }

    /// The number of a place that `goto` can lead to.
    fn target(&mut self, position: Position) -> i64 {
        let known = self.targets.iter().position(|target| *target == position);
        let number = known.unwrap_or_else(|| {
            self.targets.push(position);
            self.targets.len() - 1
        });
        number as i64 + 1
    }

    pub(super) fn goto(&mut self, arguments: &GotoArguments) -> Handled {
        self.check_started()?;
        let number = usize::try_from(arguments.target_id.saturating_sub(1)).ok();
        let target = number.and_then(|number| self.targets.get(number)).copied();
        let target = target.ok_or_else(|| Refusal::here("there is no such target"))?;
        self.leave();
        self.session.go_to(target);
        Ok(Answer::done(vec![stopped("goto", None)]))
    }

    pub(super) fn exception_info(&mut self) -> Handled {
        let (occurrence, at) = self
            .occurred
            .ok_or_else(|| Refusal::here("nothing remarkable has happened"))?;
        let (label, description) = words(occurrence);
        let moment = at.and_then(|at| {
            let run = self.session.runs().get(at.run)?;
            Some((run, run.moments.get(at.at)?))
        });
        let (mut message, mut register) = (description.to_string(), None);
        if let Some((run, moment)) = moment {
            if let Some(instruction) = moment.instruction {
                let (line, text) = (run.listing.line(instruction), run.listing.text(instruction));
                message = format!("line {line}: {text}");
            }
            let target = moment.change.map(|change| change.target);
            register = target.map(|target| super::values::name(target, &run.listing));
        }
        Ok(Answer::of(&ExceptionInfo {
            exception_id: occurrence.name(),
            description: format!("{label}: {message}"),
            break_mode: "always",
            details: ExceptionDetails {
                message,
                type_name: occurrence.name(),
                evaluate_name: register,
            },
        }))
    }

    fn check_started(&self) -> Result<(), Refusal> {
        match self.started {
            true => Ok(()),
            false => Err(Refusal::here("it does not run before `configurationDone`")),
        }
    }

    /// Goes, and tells what came of it.
    pub(super) fn travel(&mut self, direction: Direction, until: &Until) -> Vec<Event> {
        self.leave();
        let travel = self
            .session
            .travel(direction, &self.wanted.console.stops, until);
        let mut events = self.logged(&travel);
        if travel.reasons.contains(&Reason::End) {
            events.extend(self.ended(direction, until));
        } else {
            events.push(self.arrived(&travel));
        }
        events
    }

    /// What log points said on the way.
    pub(super) fn logged(&self, travel: &Travel) -> Vec<Event> {
        let log = |(position, text): &(Position, String)| {
            let run = self.session.runs().get(position.run);
            let instruction = run.and_then(|run| {
                let number = run.moments.get(position.at)?.instruction?;
                run.listing.instruction(number)
            });
            let mut output = Output {
                category: Category::Stdout,
                output: format!("{text}\n"),
                ..Output::default()
            };
            if let Some(instruction) = instruction {
                let (source, range) = self.place_of(instruction.span);
                output.source = source;
                (output.line, output.column) = (Some(range.line), Some(range.column));
            }
            Event::new("output", &output)
        };
        travel.logs.iter().map(log).collect()
    }

    /// There was nothing more this way. Where `continue` finds nothing to stop at, the program is done, once; whoever steps, or
    /// goes back, stands at the end of the recording.
    fn ended(&mut self, direction: Direction, until: &Until) -> Vec<Event> {
        let done = (direction, until) == (Direction::Forward, &Until::End);
        if !done || self.ended {
            return vec![at_an_end(direction)];
        }
        self.ended = true;
        vec![
            Event::new("exited", &Exited { exit_code: 0 }),
            Event::bare("terminated"),
        ]
    }

    /// Why it stopped, the most telling reason first.
    fn arrived(&mut self, travel: &Travel) -> Event {
        let (mut watched, mut broken) = (Vec::new(), Vec::new());
        for reason in &travel.reasons {
            match reason {
                Reason::Watchpoint(id) => watched.push(*id),
                Reason::Breakpoint(id) => broken.push(*id),
                Reason::Occurrence(occurrence) => {
                    self.occurred = Some((*occurrence, travel.moment))
                }
                Reason::Reached | Reason::End => {}
            }
        }
        let stop = match (self.occurred, watched.is_empty(), broken.is_empty()) {
            (Some((occurrence, _)), ..) => Stopped {
                text: Some(occurrence.name().to_string()),
                ..stop("exception", Some(words(occurrence).0))
            },
            (None, false, _) => stop("data breakpoint", None),
            (None, true, false) => stop("breakpoint", None),
            (None, true, true) => stop("step", None),
        };
        let stop = Stopped {
            hit_breakpoint_ids: [watched, broken].concat(),
            ..stop
        };
        Event::new("stopped", &stop)
    }
}

fn at_an_end(direction: Direction) -> Event {
    let words = match direction {
        Direction::Forward => "At the end",
        Direction::Backward => "At the beginning",
    };
    stopped("step", Some(words))
}

fn stop(reason: &'static str, description: Option<&str>) -> Stopped {
    Stopped {
        reason,
        description: description.map(str::to_string),
        thread_id: THREAD,
        all_threads_stopped: true,
        ..Stopped::default()
    }
}

/// The program stands.
pub(super) fn stopped(reason: &'static str, description: Option<&str>) -> Event {
    Event::new("stopped", &stop(reason, description))
}

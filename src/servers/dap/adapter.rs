//! A program that was launched, and what the client asks of it.

use super::Tools;
use super::breakpoints::Wanted;
use super::client::Client;
use super::protocol;
use super::protocol::{
    Answer, FrameArguments, Handled, LaunchArguments, Range, Refusal, Request, Source, StackFrame,
    StackTrace, StackTraceArguments, Thread, Threads,
};
use super::sources::Sources;
use super::variables::Containers;
use std::path::PathBuf;
use texcrd::debug::{
    Event, Expression, Listing, MergeStage, Occurrence, Position, Registers, Run, RunKind, Scope,
    Session,
};
use texcrd::diagnostic::Span;

/// The only thread's number.
pub(super) const THREAD: i64 = 1;

/// A launched program.
pub(super) struct Adapter<'w, 'a> {
    pub(super) session: Session<'a>,
    pub(super) sources: Sources<'a>,
    pub(super) client: &'a Client,
    pub(super) arguments: &'a LaunchArguments,
    pub(super) tools: Tools,
    pub(super) wanted: &'w mut Wanted,
    /// What the client can ask for the content of, since the last stop.
    pub(super) containers: Containers,
    /// Where `goto` can lead, by number.
    pub(super) targets: Vec<Position>,
    /// The registers at the stop before, and their run.
    pub(super) before: Option<(usize, Registers)>,
    /// What the last stop was about, if it was something remarkable.
    pub(super) occurred: Option<(Occurrence, Option<Position>)>,
    /// Whether the client has said that it is ready.
    pub(super) started: bool,
    /// Whether the client was told that the program is done.
    pub(super) ended: bool,
}

/// A run as the client looks at it through a frame of the stack.
pub(super) struct View<'v> {
    /// The number of the run.
    pub number: usize,
    pub run: &'v Run<'v>,
    pub registers: std::borrow::Cow<'v, Registers>,
    /// How many moments have happened.
    pub at: usize,
}

impl View<'_> {
    /// What expressions look at, for one pixel of the quad.
    pub(super) fn scope(&self, lane: usize) -> Scope<'_> {
        Scope {
            run: self.run,
            registers: &self.registers,
            lane,
        }
    }
}

impl<'w, 'a> Adapter<'w, 'a> {
    pub(super) fn new(
        session: Session<'a>,
        sources: Sources<'a>,
        client: &'a Client,
        arguments: &'a LaunchArguments,
        tools: Tools,
        wanted: &'w mut Wanted,
    ) -> Self {
        Self {
            session,
            sources,
            client,
            arguments,
            tools,
            wanted,
            containers: Containers::default(),
            targets: Vec::new(),
            before: None,
            occurred: None,
            started: false,
            ended: false,
        }
    }

    /// Does what a request asks for.
    ///
    /// # Errors
    /// [`Refusal`] if it cannot be done.
    pub(super) fn handle(&mut self, request: &Request) -> Handled {
        match request.command.as_str() {
            "configurationDone" => self.start(),
            "setBreakpoints" => self.set_breakpoints(&request.read()?),
            "breakpointLocations" => self.breakpoint_locations(&request.read()?),
            "setExceptionBreakpoints" => self.set_exception_breakpoints(&request.read()?),
            "dataBreakpointInfo" => self.data_breakpoint_info(&request.read()?),
            "setDataBreakpoints" => self.set_data_breakpoints(&request.read()?),
            "threads" => Ok(self.threads()),
            "stackTrace" => Ok(self.stack_trace(&request.read()?)),
            "scopes" => self.scopes(request.read::<FrameArguments>()?.frame_id),
            "variables" => self.variables(&request.read()?),
            "setVariable" => self.set_variable(&request.read()?),
            "setExpression" => self.set_expression(&request.read()?),
            "evaluate" => self.evaluate(&request.read()?),
            "completions" => self.completions(&request.read()?),
            "next" => self.next(&request.read()?),
            "stepIn" => self.step_in(),
            "stepOut" => self.step_out(),
            "stepBack" => self.step_back(&request.read()?),
            "continue" => self.go_on(),
            "reverseContinue" => self.go_back(),
            "pause" => self.pause(),
            "gotoTargets" => self.goto_targets(&request.read()?),
            "goto" => self.goto(&request.read()?),
            "restartFrame" => self.restart_frame(request.read::<FrameArguments>()?.frame_id),
            "exceptionInfo" => self.exception_info(),
            "loadedSources" => self.sources.loaded(),
            "source" => self.sources.text(&request.read()?),
            other => Err(Refusal::request(format!(
                "there is no request `{other}` here"
            ))),
        }
    }

    fn threads(&self) -> Answer {
        let name = match self.session.runs().last().map(|run| run.kind) {
            Some(RunKind::Pixel { pixel: [x, y] }) => format!("pixel {x},{y}"),
            Some(RunKind::Vertex { vertex, .. }) => format!("vertex {vertex}"),
            Some(RunKind::Listing) | None => "shader".to_string(),
        };
        let threads = vec![Thread { id: THREAD, name }];
        Answer::of(&Threads { threads })
    }

    /// A frame for the run that one is in, and below it one for each run whose results went into it, at its end.
    fn stack_trace(&self, arguments: &StackTraceArguments) -> Answer {
        let number = |number: Option<i64>| number.and_then(|n| usize::try_from(n).ok());
        let first = number(arguments.start_frame).unwrap_or(0);
        let most = number(arguments.levels)
            .filter(|n| *n > 0)
            .unwrap_or(usize::MAX);
        let runs = self.session.position().run;
        let all = (0..=runs).rev().filter_map(|run| self.view(run));
        let frames: Vec<StackFrame> = all.map(|view| self.frame(&view)).collect();
        Answer::of(&StackTrace {
            total_frames: frames.len(),
            stack_frames: frames.into_iter().skip(first).take(most).collect(),
        })
    }

    fn frame(&self, view: &View<'_>) -> StackFrame {
        let (instruction, stage) = place(view);
        let name = match view.run.kind {
            RunKind::Listing => format!("{} shader", view.run.listing.program.version),
            RunKind::Pixel { pixel: [x, y] } => format!("pixel shader of pixel {x},{y}"),
            RunKind::Vertex {
                corner: Some(corner),
                vertex,
            } => format!("vertex shader of vertex {vertex} (corner {})", corner + 1),
            RunKind::Vertex { vertex, .. } => format!("vertex shader of vertex {vertex}"),
        };
        let span = view.run.listing.instruction(instruction).map(|i| i.span);
        let (source, range) = span.map_or_else(Default::default, |span| self.place_of(span));
        StackFrame {
            id: frame_id(view.number),
            name: format!("{name}{stage}"),
            source,
            range,
            can_restart: true,
            instruction_pointer_reference: format!("{}:{}", view.number, view.at),
            presentation_hint: None,
        }
    }

    /// Where a span lies, as the client says it.
    pub(super) fn place_of(&self, span: Span) -> (Option<Source>, Range) {
        let source = self.sources.source(span);
        (source, self.sources.range(span, self.client))
    }

    /// A run as it is seen: the one that one is in where one is, those before it at their end.
    pub(super) fn view(&self, number: usize) -> Option<View<'_>> {
        let run = self.session.runs().get(number)?;
        let position = self.session.position();
        let (registers, at) = match number.cmp(&position.run) {
            std::cmp::Ordering::Equal => {
                let registers = std::borrow::Cow::Borrowed(self.session.registers());
                (registers, position.at)
            }
            std::cmp::Ordering::Less => {
                let at = run.moments.len();
                (std::borrow::Cow::Owned(run.registers(at)), at)
            }
            std::cmp::Ordering::Greater => return None,
        };
        Some(View {
            number,
            run,
            registers,
            at,
        })
    }

    /// The run that a frame shows; that of the place where one is if none is named.
    ///
    /// # Errors
    /// There is no such frame.
    pub(super) fn view_of(&self, frame: Option<i64>) -> Result<View<'_>, Refusal> {
        let number = match frame {
            Some(id) => usize::try_from(id.saturating_sub(frame_id(0))).ok(),
            None => Some(self.session.position().run),
        };
        let view = number.and_then(|number| self.view(number));
        view.ok_or_else(|| Refusal::here("there is no such frame"))
    }

    /// The listings that run, each once.
    pub(super) fn listings(&self) -> Vec<Listing<'a>> {
        let mut listings: Vec<Listing<'a>> = Vec::new();
        for run in self.session.runs() {
            let known = |other: &Listing<'a>| std::ptr::eq(other.program, run.listing.program);
            if !listings.iter().any(known) {
                listings.push(run.listing);
            }
        }
        listings
    }

    /// The folder that relative paths of a person start from.
    pub(super) fn folder(&self) -> PathBuf {
        PathBuf::from(self.arguments.cwd.as_deref().unwrap_or_default())
    }

    /// Forgets what belonged to the stop before, and keeps its registers to compare with.
    pub(super) fn leave(&mut self) {
        self.before = Some((
            self.session.position().run,
            self.session.registers().clone(),
        ));
        self.occurred = None;
        self.renew();
    }

    /// Forgets what the client may ask for the content of.
    pub(super) fn renew(&mut self) {
        self.containers = Containers::default();
        self.targets.clear();
    }

    /// Tells a client that can be told that values are others now.
    pub(super) fn invalidated(&self) -> Vec<protocol::Event> {
        if !self.client.invalidated {
            return Vec::new();
        }
        let areas = vec!["stacks", "variables"];
        vec![protocol::Event::new(
            "invalidated",
            &protocol::Invalidated { areas },
        )]
    }
}

/// Reads an expression that a person wrote.
///
/// # Errors
/// What is wrong with it.
pub(super) fn expression(text: &str) -> Result<Expression, Refusal> {
    text.parse().map_err(|error| {
        let message = format!("`{}`: {error}", text.trim());
        Refusal::text(message)
    })
}

/// The number of a frame by that of its run.
pub(super) fn frame_id(run: usize) -> i64 {
    run as i64 + 1
}

/// The instruction at which a run stands, and what to say if it is not before one: of the inputs the first, at the end the last.
fn place(view: &View<'_>) -> (usize, &'static str) {
    let moments = &view.run.moments;
    let next = moments.iter().skip(view.at).find_map(|m| m.instruction);
    match next {
        Some(instruction) if view.at < view.run.first_instruction() => (instruction, ", inputs"),
        Some(instruction) => (instruction, ""),
        None => {
            let last = view.run.listing.program.instructions().count();
            (last.saturating_sub(1), behind(view))
        }
    }
}

/// What happens next behind the last instruction.
fn behind(view: &View<'_>) -> &'static str {
    match view.run.moments.get(view.at).map(|moment| &moment.event) {
        Some(Event::Taken) => ", outputs",
        Some(Event::Merge(stage)) => match stage.as_ref() {
            MergeStage::Killed => ", discarded",
            MergeStage::Clamp => ", clamp of the colour",
            MergeStage::AlphaTest(_) => ", alpha test",
            MergeStage::Stencil(_) => ", stencil test",
            MergeStage::Depth(_) => ", depth test",
            MergeStage::Fog(_) => ", fog",
            MergeStage::Blend(_) => ", blending",
            MergeStage::Write { .. } => ", write",
        },
        _ => ", at its end",
    }
}

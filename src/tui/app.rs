//! The front: what events do to the session and to the screen.

use super::keys::{self, Action};
use super::layout::{Layout, Pane, VIEWS};
use super::model::{Model, scrolled};
use super::picture::Canvas;
use super::prompt::Edit;
use super::theme::Theme;
use super::view::{self, Frame, Page, Screen};
use ratatui::crossterm::event::{Event, MouseButton, MouseEvent, MouseEventKind};
use ratatui::layout::Rect;
use texcrd::debug::{Console, Effect, PixelSubject, Position, Run, Session, Subject, Text, Which};
use texcrd::program::Program;
use texcrd::scene::Rendering;

/// Lines that one turn of the wheel moves.
const WHEEL: isize = 3;

/// What only the terminal can do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Request {
    /// Draw everything again.
    Redraw,
    /// Stop until the shell wakes the program.
    Suspend,
    /// End.
    Quit,
}

/// The screen as events meet it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Surface {
    /// Its cells.
    pub area: Rect,
    /// Width and height of a cell in pixels; `None` where pictures are half blocks.
    pub cell: Option<[u16; 2]>,
    /// How things look.
    pub theme: Theme,
}

/// The front.
pub(super) struct App<'a> {
    pub(super) session: Session<'a>,
    pub(super) console: Console,
    pub(super) model: Model,
    pub(super) frame: Option<Frame>,
    /// Whether the marked pixel is to be recorded.
    moved: bool,
    /// The pixel that was recorded last.
    recorded: Option<[u32; 2]>,
    /// Does what the console leaves to its front.
    perform: Perform<'a>,
}

/// Does what a console leaves to its front; gives what there is to say of it, or why it could not be done.
pub(crate) type Perform<'a> = Box<dyn FnMut(&Effect, &Session<'a>) -> Result<Text, String> + 'a>;

impl<'a> App<'a> {
    /// A front for a session.
    pub(super) fn new(session: Session<'a>, mut console: Console, perform: Perform<'a>) -> Self {
        // They have a pane of their own.
        console.quiet_displays = true;
        let frame = rendering(&session).map(|rendering| Frame {
            image: rendering.picture().to_image(),
            mark: rendering.size().map(|edge| edge / 2),
            refusal: None,
        });
        let mut app = Self {
            model: Model::new(frame.is_some()),
            session,
            console,
            frame,
            moved: false,
            recorded: None,
            perform,
        };
        let greeting = app.console.greeting(&app.session);
        app.model.say(greeting);
        app.follow_frame();
        app.follow();
        app
    }

    /// What is shown now.
    pub(super) fn screen(&self, theme: Theme, cell: Option<[u16; 2]>) -> Screen<'_, 'a> {
        Screen {
            session: &self.session,
            console: &self.console,
            model: &self.model,
            frame: self.frame.as_ref(),
            theme,
            cell,
        }
    }

    fn layout(&self, surface: Surface) -> Option<Layout> {
        Layout::new(surface.area, self.model.view, self.frame.is_some())
    }

    /// Something happened.
    pub(super) fn handle(&mut self, event: &Event, surface: Surface) -> Option<Request> {
        match event {
            Event::Key(key) => {
                let action = keys::action(key, self.model.typing)?;
                self.act(action, surface)
            }
            Event::Mouse(mouse) => {
                self.mouse(mouse, surface);
                None
            }
            Event::Paste(text) => self.paste(text),
            _ => None,
        }
    }

    /// Every line but the last is run, as if it had been typed.
    fn paste(&mut self, text: &str) -> Option<Request> {
        self.model.typing = true;
        for c in text.chars() {
            if c == '\n' || c == '\r' {
                if !self.model.prompt.text().is_empty() && self.enter() {
                    return Some(Request::Quit);
                }
            } else {
                self.model.prompt.edit(Edit::Insert(c));
            }
        }
        None
    }

    fn act(&mut self, action: Action, surface: Surface) -> Option<Request> {
        if let Some(first) = self.model.help {
            return self.help(action, first, surface);
        }
        let layout = self.layout(surface);
        match action {
            Action::Quit => return Some(Request::Quit),
            Action::Redraw => return Some(Request::Redraw),
            Action::Suspend => return Some(Request::Suspend),
            // On a screen that says only that it is too small one would not see what one does.
            _ if layout.is_none() => {}
            Action::Run(command) => return self.run(command),
            Action::Repeat => return self.run(""),
            Action::RunToCursor => {
                let line = self.model.cursor;
                return self.run_to(line);
            }
            Action::ToggleBreakpoint => self.toggle(self.model.cursor),
            Action::Cycle { forward } => {
                let panes = layout.map(|layout| layout.panes).unwrap_or_default();
                let panes: Vec<Pane> = panes.iter().map(|(pane, _)| *pane).collect();
                self.model.cycle(&panes, forward);
            }
            Action::View(number) => {
                if let Some(view) = VIEWS.get(number) {
                    self.model.show(*view);
                }
            }
            Action::Move(x, y) => self.go(x, y, surface),
            Action::Page(pages) => {
                let room = layout.and_then(|layout| layout.body(self.model.focus));
                let rows = room.map_or(1, |room| isize::from(room.height as i16).max(2) - 1);
                self.scroll(self.model.focus, rows * pages as isize, surface);
            }
            Action::Far { end } => {
                let lines = if end { isize::MAX } else { isize::MIN };
                self.scroll(self.model.focus, lines, surface);
            }
            Action::Pixel(x, y) => self.move_pixel(x, y),
            Action::Zoom { closer } => self.model.zoom(self.model.focus, closer),
            Action::Type => self.model.typing = true,
            Action::TypeFirst(c) => {
                self.model.typing = true;
                self.model.prompt.edit(Edit::Clear);
                self.model.prompt.edit(Edit::Insert(c));
            }
            Action::Edit(edit) => self.model.prompt.edit(edit),
            Action::Enter => return self.enter().then_some(Request::Quit),
            Action::Complete => {
                let (console, session) = (&self.console, &self.session);
                let candidates = |line: &str| {
                    let start = line.get(..Console::word_start(line)).unwrap_or(line);
                    let words = console.complete(session, line).into_iter();
                    words.map(|word| format!("{start}{word}")).collect()
                };
                self.model.prompt.complete(candidates);
            }
            Action::Leave => {
                self.model.typing = false;
                self.model.prompt.edit(Edit::Clear);
            }
            Action::Help => self.model.help = Some(0),
        }
        None
    }

    /// While the help is shown, keys scroll or close it.
    fn help(&mut self, action: Action, first: usize, surface: Surface) -> Option<Request> {
        let rows = usize::from(surface.area.height.saturating_sub(1));
        let most = view::help_lines().len().saturating_sub(rows);
        let page = rows.max(2) as isize - 1;
        let lines = match action {
            Action::Move(_, y) => y as isize,
            Action::Page(pages) => pages as isize * page,
            Action::Far { end: true } => isize::MAX,
            Action::Far { end: false } => isize::MIN,
            Action::Redraw => return Some(Request::Redraw),
            Action::Suspend => return Some(Request::Suspend),
            _ => {
                self.model.help = None;
                return None;
            }
        };
        self.model.help = Some(scrolled(first, lines, most));
        None
    }

    /// Runs the command line. Whether it quits.
    fn enter(&mut self) -> bool {
        let line = self.model.prompt.enter();
        self.run(&line).is_some()
    }

    /// Runs a command.
    fn run(&mut self, command: &str) -> Option<Request> {
        if !command.trim().is_empty() {
            self.model.echo(command);
        }
        let before = self.here();
        let reply = self.console.execute(&mut self.session, command);
        self.model.say(reply.text);
        if let Some(effect) = reply.effect {
            match (self.perform)(&effect, &self.session) {
                Ok(text) => self.model.say(text),
                Err(why) => self.model.complain(why),
            }
        }
        self.follow_frame();
        // Looking at something leaves what is scrolled where it is.
        if self.here() != before {
            self.follow();
        }
        reply.quit.then_some(Request::Quit)
    }

    /// The place, and what runs there.
    fn here(&self) -> (Position, Option<*const Program>) {
        let program = self
            .session
            .run()
            .map(|run| std::ptr::from_ref(run.listing.program));
        (self.session.position(), program)
    }

    /// The mark goes where the session has gone.
    fn follow_frame(&mut self) {
        // Commands go to other pixels, too; where nothing is drawn, the mark alone has moved.
        if let (Some(frame), Subject::Pixel(subject)) = (&mut self.frame, self.session.subject())
            && !self.moved
            && (frame.refusal.is_none() || self.recorded != Some(subject.history().pixel))
        {
            frame.mark = subject.history().pixel;
            frame.refusal = None;
            self.recorded = Some(frame.mark);
        }
    }

    /// The listing and the registers go where the session has gone.
    fn follow(&mut self) {
        self.model.registers = None;
        if let Some(page) = Page::of(&self.session) {
            let next = self.session.next_instruction();
            let last = page.instructions.len().checked_sub(1);
            let line = next
                .or(last)
                .and_then(|instruction| page.line_of(instruction));
            self.model.cursor = line.unwrap_or(1);
        }
    }

    fn run_to(&mut self, line: usize) -> Option<Request> {
        let page = Page::of(&self.session)?;
        // The next line that has an instruction, as breakpoints have it.
        let ahead = |target: &usize| *target >= line;
        let target = page.instructions.iter().copied().filter(ahead).min()?;
        let here = self
            .session
            .next_instruction()
            .and_then(|next| page.line_of(next));
        let backwards = here.is_none_or(|here| target < here);
        let command = if backwards { "reverse-until" } else { "until" };
        self.run(&format!("{command} {target}"))
    }

    /// Sets a breakpoint on a line, or deletes those that are there.
    fn toggle(&mut self, line: usize) {
        let (Some(page), Some(run)) = (Page::of(&self.session), self.session.run()) else {
            return;
        };
        let ahead = page.instructions.iter().copied().filter(|at| *at >= line);
        let Some(target) = ahead.min() else {
            self.model
                .complain(format!("no instruction on line {line} or below"));
            return;
        };
        let kind = run.listing.kind();
        let here = self.console.stops.breakpoints.iter().filter(|breakpoint| {
            breakpoint.kind == kind && page.line_of(breakpoint.instruction) == Some(target)
        });
        let ids: Vec<u32> = here.map(|breakpoint| breakpoint.action.id).collect();
        if ids.is_empty() {
            self.run(&format!("break {target}"));
        }
        for id in ids {
            self.run(&format!("delete {id}"));
        }
    }

    /// The arrow keys in the pane that has the focus.
    fn go(&mut self, x: i32, y: i32, surface: Surface) {
        match self.model.focus {
            Pane::Frame => self.move_pixel(x, y),
            pane => self.scroll(pane, y as isize, surface),
        }
    }

    /// Scrolls a pane.
    fn scroll(&mut self, pane: Pane, lines: isize, surface: Surface) {
        let layout = self.layout(surface);
        let Some(room) = layout.and_then(|layout| layout.body(pane)) else {
            return;
        };
        let rows = usize::from(room.height);
        let model = &mut self.model;
        match pane {
            Pane::Listing => {
                let most = Page::of(&self.session).map_or(1, |page| page.lines);
                model.cursor = scrolled(model.cursor, lines, most).max(1);
            }
            Pane::Registers => {
                let shown = view::register_rows(&self.session);
                let most = shown.len().saturating_sub(rows);
                let first = model.registers.unwrap_or_else(|| {
                    let new = shown.iter().rposition(|row| !row.changed.is_empty());
                    new.map_or(0, |new| (new + 1).saturating_sub(rows))
                });
                model.registers = Some(scrolled(first, lines, most));
            }
            Pane::Output => {
                let all = view::wrapped_output(&model.output, room.width, surface.theme);
                let most = all.saturating_sub(rows);
                model.output_below = scrolled(model.output_below, lines.saturating_neg(), most);
            }
            Pane::Watches => {
                let all = self.console.displays().len();
                model.watches = scrolled(model.watches, lines, all.saturating_sub(rows));
            }
            Pane::Frame | Pane::Texture | Pane::Quad => {}
        }
    }

    /// Marks another pixel; [`Self::settle`] records it.
    fn move_pixel(&mut self, x: i32, y: i32) {
        let Some(frame) = &self.frame else {
            return;
        };
        let [column, row] = frame.mark;
        self.mark([
            column.saturating_add_signed(x),
            row.saturating_add_signed(y),
        ]);
    }

    fn mark(&mut self, pixel: [u32; 2]) {
        let Some(frame) = &mut self.frame else {
            return;
        };
        let (width, height) = frame.image.dimensions();
        let pixel = [
            pixel[0].min(width.saturating_sub(1)),
            pixel[1].min(height.saturating_sub(1)),
        ];
        if pixel != frame.mark {
            frame.mark = pixel;
            self.moved = true;
        }
    }

    /// Records the marked pixel, once all that has happened is done.
    pub(super) fn settle(&mut self) {
        if !std::mem::take(&mut self.moved) {
            return;
        }
        let (Some(frame), Some(rendering)) = (&mut self.frame, rendering(&self.session)) else {
            return;
        };
        let before = Place::of(&self.session);
        match PixelSubject::new(rendering, frame.mark, &Which::default()) {
            Ok(subject) => {
                frame.refusal = None;
                self.session.replace(Subject::Pixel(subject));
                if let Some(place) = before {
                    place.find(&mut self.session);
                }
                self.follow_frame();
                self.follow();
            }
            Err(why) => frame.refusal = Some(why.to_string()),
        }
    }

    fn mouse(&mut self, mouse: &MouseEvent, surface: Surface) {
        let Some(layout) = self.layout(surface) else {
            return;
        };
        let (x, y) = (mouse.column, mouse.row);
        let lines = match mouse.kind {
            MouseEventKind::Down(MouseButton::Left) => {
                return match self.model.help {
                    Some(_) => self.model.help = None,
                    None => self.click(x, y, &layout, surface),
                };
            }
            // The pixel follows the pointer.
            MouseEventKind::Drag(MouseButton::Left) if self.model.help.is_none() => {
                return self.choose_pixel(x, y, &layout, surface);
            }
            MouseEventKind::ScrollUp => -WHEEL,
            MouseEventKind::ScrollDown => WHEEL,
            _ => return,
        };
        if let Some(first) = self.model.help {
            self.help(Action::Move(0, lines as i32), first, surface);
            return;
        }
        match layout.at(x, y) {
            Some(pane @ (Pane::Frame | Pane::Texture)) => self.model.zoom(pane, lines < 0),
            Some(pane) => self.scroll(pane, lines, surface),
            None => {}
        }
    }

    fn click(&mut self, x: u16, y: u16, layout: &Layout, surface: Surface) {
        if layout.prompt.contains((x, y).into()) {
            self.model.typing = true;
            return;
        }
        let mut tabs = view::tabs(layout).into_iter();
        let heading = layout.shared().is_some_and(|(_, area)| area.y == y);
        if let Some((pane, ..)) = tabs.find(|(_, columns, _)| heading && columns.contains(&x)) {
            self.model.show(pane);
            return;
        }
        let Some(pane) = layout.at(x, y) else {
            return;
        };
        self.model.focus = pane;
        self.model.typing = false;
        let Some(room) = layout
            .body(pane)
            .filter(|room| room.contains((x, y).into()))
        else {
            return;
        };
        match pane {
            Pane::Listing => {
                let lines = Page::of(&self.session).map_or(0, |page| page.lines);
                let top = view::listing_top(usize::from(room.height), lines, self.model.cursor);
                let line = top + usize::from(y - room.y);
                if line <= lines {
                    self.toggle(line);
                }
            }
            Pane::Frame => self.choose_pixel(x, y, layout, surface),
            _ => {}
        }
    }

    fn choose_pixel(&mut self, x: u16, y: u16, layout: &Layout, surface: Surface) {
        let (Some(room), Some(frame)) = (layout.body(Pane::Frame), &self.frame) else {
            return;
        };
        let canvas = view::frame_canvas(room, frame, self.model.frame_zoom, surface.cell);
        if let Some(pixel) = canvas.and_then(|canvas: Canvas| canvas.pixel_at(x, y)) {
            self.mark(pixel);
        }
    }
}

/// The scene that is debugged, as it was rendered.
fn rendering<'a>(session: &Session<'a>) -> Option<&'a Rendering<'a>> {
    match session.subject() {
        Subject::Listing(_) => None,
        Subject::Pixel(subject) => Some(subject.rendering()),
        Subject::Vertex(subject) => Some(subject.rendering()),
    }
}

/// A place in the last run, which another pixel may have as well.
struct Place {
    /// Where its program lies: the same one has the same instructions.
    program: *const Program,
    /// How many moments after the first instruction begins.
    after: usize,
}

impl Place {
    /// `None` outside of the instructions of the last run.
    fn of(session: &Session<'_>) -> Option<Self> {
        let Position { run, at } = session.position();
        let last = session
            .runs()
            .last()
            .filter(|_| run + 1 == session.runs().len())?;
        Some(Self {
            program: last.listing.program,
            after: at.checked_sub(last.first_instruction())?,
        })
    }

    /// Goes there, if the last run is one of the same program.
    fn find(&self, session: &mut Session<'_>) {
        let same = |run: &&Run<'_>| std::ptr::eq(run.listing.program, self.program);
        let run = session.runs().len().saturating_sub(1);
        if let Some(last) = session.runs().last().filter(same) {
            let at = last.first_instruction() + self.after;
            session.go_to(Position { run, at });
        }
    }
}

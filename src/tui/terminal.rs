//! The terminal: entered, and given back as it was whatever happens: at the end, after a panic, before a signal takes effect.
//!
//! What has to be undone is kept in statics, because panics and signals come from anywhere. Everything that is drawn goes out in
//! one piece under a lock, so that giving back never ends up in the middle of a sequence.

#[cfg(unix)]
mod signals;

use super::picture::{Answers, Pictures, Placed, Protocol, ask};
use super::theme::{Colours, Theme};
use ratatui::backend::CrosstermBackend;
use ratatui::buffer::Buffer;
use ratatui::crossterm::cursor::{Hide, Show};
use ratatui::crossterm::event::{
    self, DisableBracketedPaste, DisableMouseCapture, EnableBracketedPaste, EnableMouseCapture,
    Event, KeyCode, KeyModifiers,
};
use ratatui::crossterm::style::ResetColor;
use ratatui::crossterm::terminal::{
    BeginSynchronizedUpdate, EndSynchronizedUpdate, EnterAlternateScreen, LeaveAlternateScreen,
    disable_raw_mode, enable_raw_mode, window_size,
};
use ratatui::crossterm::{Command, queue};
use ratatui::layout::{Position, Rect};
use std::io::{self, IsTerminal, Write};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, Once, PoisonError};
use std::time::Duration;

/// Whether the terminal is in the state that [`Terminal::enter`] put it into.
static INSIDE: AtomicBool = AtomicBool::new(false);

/// Whether pictures of kitty's protocol may be on the screen.
static KITTY: AtomicBool = AtomicBool::new(false);

/// Whether everything has to be drawn again.
static STALE: AtomicBool = AtomicBool::new(false);

/// Held while something is sent.
static SENDING: Mutex<()> = Mutex::new(());

/// How long the terminal may take to say what it can: long enough for a slow line, and nothing waits for it but the first screen.
const PATIENCE: Duration = Duration::from_secs(1);

/// Whether there is a terminal that the front can be shown on.
pub(crate) fn available() -> bool {
    let dumb = std::env::var("TERM").map_or(cfg!(unix), |term| term == "dumb" || term.is_empty());
    io::stdin().is_terminal() && io::stdout().is_terminal() && !dumb
}

/// A terminal that is drawn on.
pub(super) struct Terminal {
    inner: ratatui::Terminal<CrosstermBackend<Outbox>>,
    pictures: Pictures,
    late: LateAnswers,
}

impl Terminal {
    /// Takes the terminal over. Pictures go through `protocol`, or else through the best that the terminal says it knows.
    pub(super) fn enter(theme: Theme, protocol: Option<Protocol>) -> io::Result<Self> {
        static ONCE: Once = Once::new();
        ONCE.call_once(|| {
            let previous = std::panic::take_hook();
            std::panic::set_hook(Box::new(move |info| {
                leave();
                previous(info);
            }));
        });
        #[cfg(unix)]
        signals::listen()?;
        enter()?;
        // From here on the terminal is given back even if something fails.
        let mut guard = Guard(true);
        let variable = |name: &str| std::env::var(name).ok();
        let known = cell_size();
        let to_ask = match protocol {
            None => worth_asking(theme, variable),
            Some(protocol) => protocol != Protocol::Blocks && known.is_none(),
        };
        let answers = if to_ask {
            ask(PATIENCE)
        } else {
            Answers::default()
        };
        let protocol = protocol.unwrap_or_else(|| best(theme, variable, answers));
        KITTY.store(protocol == Protocol::Kitty, Ordering::SeqCst);
        let cell = known.or(answers.cell);
        let mut inner = ratatui::Terminal::new(CrosstermBackend::new(Outbox(Vec::new())))?;
        let area = Rect::from((Position::ORIGIN, inner.size()?));
        inner.resize(area)?;
        guard.0 = false;
        Ok(Self {
            inner,
            pictures: Pictures::new(protocol, cell),
            late: LateAnswers::default(),
        })
    }

    /// Width and height in cells.
    pub(super) fn area(&mut self) -> io::Result<Rect> {
        Ok(Rect::from((Position::ORIGIN, self.inner.size()?)))
    }

    /// Width and height of a cell in pixels; `None` where pictures are half blocks.
    pub(super) fn cell(&self) -> Option<[u16; 2]> {
        self.pictures.cell()
    }

    /// Draws a screen: `screen` draws the characters and gives the pictures and the place of the cursor.
    pub(super) fn draw(
        &mut self,
        screen: impl Fn(&mut Buffer) -> (Vec<Placed>, Option<Position>),
    ) -> io::Result<()> {
        if STALE.swap(false, Ordering::SeqCst) {
            self.clear()?;
        }
        let mut placed = self.draw_characters(&screen)?;
        if self.pictures.leaves_traces(&placed) {
            self.clear()?;
            placed = self.draw_characters(&screen)?;
        }
        let pictures = self.pictures.show(placed);
        if !pictures.is_empty() {
            // The cursor comes back to where the characters left it.
            let backend = self.inner.backend_mut();
            write!(backend, "\x1b7{pictures}\x1b8")?;
            Write::flush(backend)?;
        }
        Ok(())
    }

    fn draw_characters(
        &mut self,
        screen: &impl Fn(&mut Buffer) -> (Vec<Placed>, Option<Position>),
    ) -> io::Result<Vec<Placed>> {
        let mut placed = Vec::new();
        self.inner.draw(|frame| {
            let (pictures, cursor) = screen(frame.buffer_mut());
            placed = pictures;
            if let Some(cursor) = cursor {
                frame.set_cursor_position(cursor);
            }
        })?;
        Ok(placed)
    }

    /// The next draw starts from an empty screen.
    pub(super) fn redraw(&mut self) {
        STALE.store(true, Ordering::SeqCst);
    }

    fn clear(&mut self) -> io::Result<()> {
        let gone = self.pictures.clear();
        self.inner.backend_mut().write_all(gone.as_bytes())?;
        let area = self.area()?;
        self.inner.resize(area)
    }

    /// Waits for something to happen.
    pub(super) fn wait(&mut self) -> io::Result<Event> {
        loop {
            let event = event::read()?;
            if self.sieve(&event) {
                return Ok(event);
            }
        }
    }

    /// Something that has happened already.
    pub(super) fn pending(&mut self) -> io::Result<Option<Event>> {
        while event::poll(Duration::ZERO)? {
            let event = event::read()?;
            if self.sieve(&event) {
                return Ok(Some(event));
            }
        }
        Ok(None)
    }

    /// Whether an event is one for the program.
    fn sieve(&mut self, event: &Event) -> bool {
        if let Event::Resize(..) = event {
            // The size of the letters may be another one, too.
            if self.pictures.cell().is_some() {
                self.pictures.resize(cell_size());
            }
            self.redraw();
        }
        !self.late.swallow(event)
    }

    /// Stops the program as the shell's key for it does, until the shell wakes it.
    pub(super) fn suspend(&mut self) {
        #[cfg(unix)]
        signals::suspend();
    }
}

impl Drop for Terminal {
    fn drop(&mut self) {
        leave();
    }
}

/// Gives the terminal back if it is dropped armed.
struct Guard(bool);

impl Drop for Guard {
    fn drop(&mut self) {
        if self.0 {
            leave();
        }
    }
}

/// Puts the terminal into the state that the front needs.
fn enter() -> io::Result<()> {
    enable_raw_mode()?;
    INSIDE.store(true, Ordering::SeqCst);
    let mut bytes = Vec::new();
    queue!(
        bytes,
        EnterAlternateScreen,
        EnableMouseCapture,
        EnableBracketedPaste,
        Hide
    )?;
    let sent = send(&bytes);
    if sent.is_err() {
        leave();
    }
    sent
}

/// Puts the terminal back into the state it was in; nothing if it is.
fn leave() {
    // A thread that dies or hangs while it sends must not keep the terminal from being given back.
    let mut sending = SENDING.try_lock();
    for _ in 0..50 {
        if sending.is_ok() {
            break;
        }
        std::thread::sleep(Duration::from_millis(10));
        sending = SENDING.try_lock();
    }
    if !INSIDE.swap(false, Ordering::SeqCst) {
        return;
    }
    let mut text = String::new();
    if KITTY.load(Ordering::SeqCst) {
        text += &Pictures::new(Protocol::Kitty, None).clear();
    }
    let commands: [&dyn Fn(&mut String) -> std::fmt::Result; 6] = [
        &|f| EndSynchronizedUpdate.write_ansi(f),
        &|f| DisableBracketedPaste.write_ansi(f),
        &|f| DisableMouseCapture.write_ansi(f),
        &|f| ResetColor.write_ansi(f),
        &|f| Show.write_ansi(f),
        &|f| LeaveAlternateScreen.write_ansi(f),
    ];
    // Writing into a String does not fail.
    let _ = commands.iter().try_for_each(|command| command(&mut text));
    // There is nobody to tell if the terminal has gone away. The mode first: sending may hang where setting does not.
    let _ = disable_raw_mode();
    let _ = write_out(text.as_bytes());
}

/// Sends bytes to the terminal, in one piece; drops them once it has been given back.
fn send(bytes: &[u8]) -> io::Result<()> {
    let _sending = SENDING.lock().unwrap_or_else(PoisonError::into_inner);
    if INSIDE.load(Ordering::SeqCst) {
        write_out(bytes)?;
    }
    Ok(())
}

/// Past the lock of the standard library, which a thread that hangs may hold.
#[cfg(unix)]
fn write_out(mut bytes: &[u8]) -> io::Result<()> {
    while !bytes.is_empty() {
        match rustix::io::write(rustix::stdio::stdout(), bytes) {
            Ok(count) => bytes = bytes.get(count..).unwrap_or(&[]),
            Err(rustix::io::Errno::INTR) => {}
            Err(error) => return Err(error.into()),
        }
    }
    Ok(())
}

#[cfg(not(unix))]
fn write_out(bytes: &[u8]) -> io::Result<()> {
    let mut out = io::stdout().lock();
    out.write_all(bytes)?;
    out.flush()
}

/// Collects what is drawn, so that it goes out in one piece.
struct Outbox(Vec<u8>);

impl Write for Outbox {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        if self.0.is_empty() {
            return Ok(());
        }
        let mut whole = Vec::with_capacity(self.0.len() + 16);
        queue!(whole, BeginSynchronizedUpdate)?;
        whole.append(&mut self.0);
        queue!(whole, EndSynchronizedUpdate)?;
        send(&whole)
    }
}

/// Width and height of a cell in pixels, if the system knows it.
fn cell_size() -> Option<[u16; 2]> {
    let size = window_size().ok()?;
    let cell = [
        size.width.checked_div(size.columns)?,
        size.height.checked_div(size.rows)?,
    ];
    cell.iter().all(|edge| *edge > 0).then_some(cell)
}

/// Whether a terminal is of a kind that may know pictures and does not take the question for text.
fn worth_asking(theme: Theme, variable: impl Fn(&str) -> Option<String>) -> bool {
    let term = variable("TERM").unwrap_or_default();
    let screen = term.starts_with("screen") && variable("TMUX").is_none();
    theme.colours > Colours::Sixteen && !screen && term != "linux"
        || ["xterm", "mlterm", "contour"].contains(&term.as_str()) && theme.colours != Colours::None
}

/// The best way to show pictures. What a terminal says by itself counts more than its name, but for those that say little.
fn best(theme: Theme, variable: impl Fn(&str) -> Option<String>, answers: Answers) -> Protocol {
    let is = |name: &str, value: &str| variable(name).is_some_and(|found| found.starts_with(value));
    let iterm = is("TERM_PROGRAM", "iTerm") || is("LC_TERMINAL", "iTerm2");
    if theme.colours == Colours::None {
        Protocol::Blocks
    } else if answers.kitty && !is("TERM_PROGRAM", "WezTerm") {
        Protocol::Kitty
    } else if (iterm && !is("TERM_PROGRAM", "tmux")) || is("TERM_PROGRAM", "WezTerm") {
        Protocol::Iterm
    } else if answers.sixel {
        Protocol::Sixel
    } else {
        Protocol::Blocks
    }
}

/// Swallows answers that come after one has stopped waiting: kitty's looks like keys, from `Alt-_` to `Alt-\`.
#[derive(Debug, Default)]
struct LateAnswers {
    inside: bool,
}

impl LateAnswers {
    fn swallow(&mut self, event: &Event) -> bool {
        let Event::Key(key) = event else {
            return false;
        };
        let alt = key.modifiers.contains(KeyModifiers::ALT);
        match key.code {
            KeyCode::Char('_') if alt => self.inside = true,
            KeyCode::Char('\\') if alt && self.inside => {
                self.inside = false;
                return true;
            }
            // Whoever does press Alt-_ gets out with any key that is no character.
            KeyCode::Char(_) => {}
            _ => self.inside = false,
        }
        self.inside
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ratatui::crossterm::event::KeyEvent;

    fn theme(colours: Colours) -> Theme {
        Theme { colours }
    }

    #[test]
    fn the_way_of_pictures() {
        let environment = |pairs: &'static [(&str, &str)]| {
            move |name: &str| {
                let found = pairs.iter().find(|(other, _)| *other == name);
                found.map(|(_, value)| value.to_string())
            }
        };
        let both = Answers {
            kitty: true,
            sixel: true,
            ..Answers::default()
        };
        let sixel = Answers {
            kitty: false,
            ..both
        };
        let deep = theme(Colours::True);
        let nothing = environment(&[]);
        assert_eq!(best(deep, nothing, both), Protocol::Kitty);
        assert_eq!(best(deep, nothing, sixel), Protocol::Sixel);
        assert_eq!(best(deep, nothing, Answers::default()), Protocol::Blocks);
        assert_eq!(best(theme(Colours::None), nothing, both), Protocol::Blocks);
        let iterm = environment(&[("TERM_PROGRAM", "iTerm.app")]);
        assert_eq!(best(deep, iterm, sixel), Protocol::Iterm);
        // Within tmux the terminal around it is out of reach.
        let tmux = environment(&[("TERM_PROGRAM", "tmux"), ("LC_TERMINAL", "iTerm2")]);
        assert_eq!(best(deep, tmux, Answers::default()), Protocol::Blocks);
    }

    #[test]
    fn late_answers_are_no_keys() {
        let mut late = LateAnswers::default();
        let mut swallowed =
            |c, modifiers| late.swallow(&Event::Key(KeyEvent::new(KeyCode::Char(c), modifiers)));
        let (none, alt) = (KeyModifiers::NONE, KeyModifiers::ALT);
        assert!(!swallowed('n', none));
        assert!(swallowed('_', alt));
        for c in "Gi=31;OK".chars() {
            assert!(swallowed(c, none));
        }
        assert!(swallowed('\\', alt));
        assert!(!swallowed('n', none));
        assert!(!swallowed('\\', alt));
    }
}

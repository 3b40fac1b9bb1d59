//! The line mode: commands from a script, or typed, with answers below them.

use super::effects;
use crate::cli::{Failure, Outcome, files, print};
use anstyle::{AnsiColor, Color, RgbColor, Style as Ansi};
use rustyline::completion::Completer;
use rustyline::error::ReadlineError;
use rustyline::highlight::Highlighter;
use rustyline::hint::Hinter;
use rustyline::history::MemHistory;
use rustyline::validate::Validator;
use rustyline::{Context, Editor, Helper};
use std::cell::RefCell;
use std::io::BufRead;
use std::rc::Rc;
use texcrd::debug::{Console, Reply, Session, Style, Text};

/// What stands before a command.
const PROMPT: &str = "(texcrd) ";

/// A console with its session.
struct State<'a> {
    console: Console,
    session: Session<'a>,
}

impl State<'_> {
    fn execute(&mut self, line: &str) -> Reply {
        self.console.execute(&mut self.session, line)
    }
}

/// The line mode.
pub(super) struct Front<'a> {
    /// Shared with what completes lines.
    state: Rc<RefCell<State<'a>>>,
    /// The file that was given, which nothing may be written over.
    inputs: [String; 1],
    coloured: bool,
}

impl<'a> Front<'a> {
    pub(super) fn new(session: Session<'a>, file: &str) -> Self {
        let console = Console::new();
        let choice = anstream::AutoStream::choice(&std::io::stdout());
        Self {
            state: Rc::new(RefCell::new(State { console, session })),
            inputs: [file.to_string()],
            coloured: choice != anstream::ColorChoice::Never,
        }
    }

    /// Says what is debugged and where one is.
    pub(super) fn greet(&self) -> Outcome {
        let state = self.state.borrow();
        let text = state.console.greeting(&state.session);
        drop(state);
        self.say(&text)
    }

    fn say(&self, text: &Text) -> Outcome {
        print(&if self.coloured {
            painted(text)
        } else {
            text.to_string()
        })
    }

    /// Does one command of a script, its text above its answer; whether the session goes on.
    ///
    /// # Errors
    /// Also where the command cannot be done; `place` is where it stands.
    pub(super) fn scripted(&mut self, line: &str, place: &str) -> Result<bool, Failure> {
        let echo = format!("{PROMPT}{}", line.trim());
        print(&format!("{}\n", echo.trim_end()))?;
        let reply = self.state.borrow_mut().execute(line);
        if reply.failed {
            let why = reply.text.to_string();
            return Err(Failure::Input(format!("{place}: {}", why.trim_end())));
        }
        self.say(&reply.text)?;
        if let Some(effect) = &reply.effect {
            let text = effects::perform(effect, &self.state.borrow().session, &self.inputs);
            let text = text.map_err(|why| Failure::Input(format!("{place}: {why}")))?;
            self.say(&text)?;
        }
        Ok(!reply.quit)
    }

    /// Does the lines of a file; `-` is standard input, whose lines are done as they come.
    pub(super) fn script(&mut self, path: &str) -> Outcome {
        let name = files::name(path);
        if path == "-" {
            for (number, line) in std::io::stdin().lock().split(b'\n').enumerate() {
                let line = line.map_err(|e| Failure::Io(format!("{name}: {e}")))?;
                if !self.scripted_line(&line, name, number)? {
                    return Ok(());
                }
            }
            return Ok(());
        }
        let bytes = files::read(path)?;
        let bytes = bytes.strip_suffix(b"\n").unwrap_or(&bytes);
        for (number, line) in bytes.split(|byte| *byte == b'\n').enumerate() {
            if !self.scripted_line(line, name, number)? {
                return Ok(());
            }
        }
        Ok(())
    }

    fn scripted_line(&mut self, line: &[u8], name: &str, number: usize) -> Result<bool, Failure> {
        let line = String::from_utf8_lossy(line);
        self.scripted(&line, &format!("{name}:{}", number + 1))
    }

    /// Asks for commands on a terminal until one ends the session.
    pub(super) fn interactive(&mut self) -> Outcome {
        let failed = |e: ReadlineError| Failure::Io(format!("the terminal: {e}"));
        let history = MemHistory::new();
        let mut editor =
            Editor::with_history(rustyline::Config::default(), history).map_err(failed)?;
        editor.set_helper(Some(Completing {
            state: Rc::clone(&self.state),
        }));
        loop {
            let line = match editor.readline(PROMPT) {
                Ok(line) => line,
                // What was typed is forgotten, as in other programs.
                Err(ReadlineError::Interrupted) => continue,
                Err(ReadlineError::Eof) => return Ok(()),
                Err(e) => return Err(failed(e)),
            };
            if !line.trim().is_empty() {
                // A history that is full is no reason to stop.
                let _ = editor.add_history_entry(&line);
            }
            let reply = self.state.borrow_mut().execute(&line);
            self.say(&reply.text)?;
            if let Some(effect) = &reply.effect {
                let done = effects::perform(effect, &self.state.borrow().session, &self.inputs);
                match done {
                    Ok(text) => self.say(&text)?,
                    Err(why) => anstream::eprintln!("{why}"),
                }
            }
            if reply.quit {
                return Ok(());
            }
        }
    }
}

/// Completes commands from what is debugged.
struct Completing<'a> {
    state: Rc<RefCell<State<'a>>>,
}

impl Helper for Completing<'_> {}
impl Highlighter for Completing<'_> {}
impl Validator for Completing<'_> {}
impl Hinter for Completing<'_> {
    type Hint = String;
}

impl Completer for Completing<'_> {
    type Candidate = String;

    fn complete(
        &self,
        line: &str,
        position: usize,
        _: &Context<'_>,
    ) -> rustyline::Result<(usize, Vec<String>)> {
        let line = line.get(..position).unwrap_or(line);
        let state = self.state.borrow();
        let words = state.console.complete(&state.session, line);
        Ok((Console::word_start(line), words))
    }
}

/// A text in the colours of a terminal.
fn painted(text: &Text) -> String {
    let mut out = String::new();
    for line in &text.lines {
        for piece in &line.pieces {
            let style = ansi(piece.style);
            let shown = match piece.style {
                Style::Swatch(_) => "  ",
                _ => &piece.text,
            };
            out.push_str(&format!("{style}{shown}{style:#}"));
        }
        out.push('\n');
    }
    out
}

fn ansi(style: Style) -> Ansi {
    let colour = |colour: AnsiColor| Ansi::new().fg_color(Some(Color::Ansi(colour)));
    match style {
        Style::Plain => Ansi::new(),
        Style::Dim => Ansi::new().dimmed(),
        Style::Strong => Ansi::new().bold(),
        Style::Changed => colour(AnsiColor::Yellow),
        Style::Marked => colour(AnsiColor::Green).bold(),
        Style::Remarkable => colour(AnsiColor::Magenta).bold(),
        Style::Error => colour(AnsiColor::Red).bold(),
        Style::Swatch([r, g, b]) => Ansi::new().bg_color(Some(Color::Rgb(RgbColor(r, g, b)))),
    }
}

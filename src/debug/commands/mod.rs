//! The command language: what is typed, in the words of `gdb` where it has them, and what is answered.
//!
//! A [`Console`] keeps what belongs to a person and not to a run: breakpoints, displays, the last command. It is given lines and
//! a [`Session`], and gives back a [`Reply`] each; every front that takes commands has one. It opens no file and knows no
//! terminal: what a front must do itself is the [`Effect`] of a reply.
//!
//! Files: `table` (the commands, a row each: dispatch, help and completion all read it), `place` (lines and conditions),
//! `travel` (moving), `stopping` (breakpoints and watchpoints), `look` (print, display, list), `info`, `explain` (why, quad),
//! `change` (set, diff), `account` (steps number by number), `export`, `scene` (pixel, vertex, history), `complete`; and for words `tell` (moments), `sample` (what was
//! sampled), `merge` (the output merger).

mod account;
mod change;
mod complete;
mod explain;
mod export;
mod info;
mod look;
mod merge;
mod place;
mod sample;
mod scene;
mod stopping;
mod table;
mod tell;
#[cfg(test)]
mod tests;

mod travel;

pub use account::{Account, account, occasion};
pub use table::{CommandHelp, command_help};

use super::expression::{Expression, ExpressionError, Format};
use super::session::Session;
use super::stops::Stops;
use super::text::{Line, Style, Text};
use crate::isa::ShaderKind;
#[cfg(feature = "scene")]
use crate::sheet::Tile;
use std::collections::BTreeMap;
use table::Command;

/// What a person has set up, beside the session.
#[derive(Clone, Debug, Default)]
pub struct Console {
    /// Breakpoints, watchpoints, and what is caught.
    pub stops: Stops,
    /// Whether the front shows what is displayed by itself, so that answers to commands leave it out.
    pub quiet_displays: bool,
    displays: Vec<Display>,
    /// Breakpoints that are deleted when they are hit.
    temporary: Vec<u32>,
    /// The last number that was given to a breakpoint or a watchpoint, and to a display.
    last_stop: u32,
    last_display: u32,
    /// What an empty line repeats.
    repeat: Option<String>,
    /// The listing and the line that `list` goes on with.
    listed: Option<(ShaderKind, usize)>,
    /// Where one was in the runs that `up` and `down` left.
    left: BTreeMap<usize, usize>,
}

/// An expression that is shown after every stop.
#[derive(Clone, Debug, PartialEq)]
pub struct Display {
    /// Its number.
    pub id: u32,
    /// The expression.
    pub expression: Expression,
    /// How its value is written.
    pub format: Format,
}

/// The answer to a command.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reply {
    /// What is said.
    pub text: Text,
    /// Whether the session is to be ended.
    pub quit: bool,
    /// Whether the command could not be done; the text says why.
    pub failed: bool,
    /// What the front has to do.
    pub effect: Option<Effect>,
}

/// What only a front can do.
#[derive(Clone, Debug, PartialEq)]
pub enum Effect {
    /// Write a file.
    Write {
        /// Its path, as it was typed.
        path: String,
        /// Its content.
        text: String,
    },
    /// Picture registers over the whole frame: one picture, or a sheet of several.
    #[cfg(feature = "scene")]
    Picture {
        /// The draw whose registers are shown.
        draw: String,
        /// What to show.
        tiles: Vec<Tile>,
        /// Where the picture goes.
        path: String,
    },
}

/// Why a command cannot be done.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Fault(String);

impl From<String> for Fault {
    fn from(message: String) -> Self {
        Self(message)
    }
}

impl From<&str> for Fault {
    fn from(message: &str) -> Self {
        Self(message.to_string())
    }
}

impl From<ExpressionError> for Fault {
    fn from(why: ExpressionError) -> Self {
        Self(why.message)
    }
}

type Outcome = Result<Reply, Fault>;

impl From<Text> for Reply {
    fn from(text: Text) -> Self {
        Self {
            text,
            ..Self::default()
        }
    }
}

impl From<Line> for Reply {
    fn from(line: Line) -> Self {
        Text { lines: vec![line] }.into()
    }
}

impl From<String> for Reply {
    fn from(line: String) -> Self {
        Line::from(line).into()
    }
}

/// What stands behind the name of a command.
#[derive(Clone, Copy, Debug)]
struct Arguments<'t> {
    /// The text, without blanks at its ends.
    text: &'t str,
    /// The format behind a slash: `print/x`.
    format: Option<Format>,
}

impl<'t> Arguments<'t> {
    fn words(&self) -> impl Iterator<Item = &'t str> {
        self.text.split_whitespace()
    }

    /// Refuses arguments.
    fn nothing(&self) -> Result<(), Fault> {
        match self.text {
            "" => Ok(()),
            text => Err(format!("`{text}`: this command takes nothing").into()),
        }
    }

    /// A number of times; once if nothing is said.
    fn count(&self) -> Result<u32, Fault> {
        if self.text.is_empty() {
            return Ok(1);
        }
        let count = self.text.parse().ok().filter(|count| *count > 0);
        count.ok_or_else(|| format!("`{}` is no number of times", self.text).into())
    }
}

impl Console {
    /// The longest line that is taken, in bytes.
    pub const LONGEST_LINE: usize = 4096;

    /// Nothing set up.
    pub fn new() -> Self {
        Self::default()
    }

    /// What is shown after every stop.
    pub fn displays(&self) -> &[Display] {
        &self.displays
    }

    /// Does what a line says. An empty line does the last command again, if it is one that is worth repeating; a line that begins
    /// with `#` is a remark.
    pub fn execute(&mut self, session: &mut Session<'_>, line: &str) -> Reply {
        let line = line.trim();
        if line.starts_with('#') {
            return Reply::default();
        }
        if line.is_empty() {
            return match self.repeat.clone() {
                Some(last) => self.dispatch(session, &last),
                None => Reply::default(),
            };
        }
        self.repeat = None;
        self.dispatch(session, line)
    }

    fn dispatch(&mut self, session: &mut Session<'_>, line: &str) -> Reply {
        let outcome = parse(line).and_then(|(command, arguments)| {
            if command.repeats {
                self.repeat = Some(line.to_string());
            }
            let before = session.position();
            let outcome = (command.run)(self, session, &arguments);
            if session.position() != before {
                self.listed = None;
            }
            outcome
        });
        outcome.unwrap_or_else(|Fault(message)| Reply {
            text: Text {
                lines: vec![Line::styled(message, Style::Error)],
            },
            failed: true,
            ..Reply::default()
        })
    }

    /// What is said when a session begins: what is debugged, and where one is.
    pub fn greeting(&self, session: &Session<'_>) -> Text {
        let mut text = Text::default();
        if let Some(run) = session.run() {
            text.line(tell::run_title(run));
        }
        text.append(scene::touched(session));
        text.append(travel::arrival(self, session));
        text
    }

    /// The number of a new breakpoint or watchpoint, also for those that a front puts into [`Self::stops`] itself.
    pub fn new_stop(&mut self) -> u32 {
        self.last_stop += 1;
        self.last_stop
    }
}

/// Finds the command of a line.
fn parse(line: &str) -> Result<(&'static Command, Arguments<'_>), Fault> {
    if line.len() > Console::LONGEST_LINE {
        return Err("the line is too long".into());
    }
    let end = line
        .find(|c: char| c.is_whitespace() || c == '/')
        .unwrap_or(line.len());
    let (word, rest) = line.split_at(end);
    let command = table::find(word)?;
    let (format, text) = match rest.strip_prefix('/') {
        None => (None, rest),
        Some(rest) if command.takes_format => {
            let end = rest.find(char::is_whitespace).unwrap_or(rest.len());
            let (letter, text) = rest.split_at(end);
            let format = letter
                .parse()
                .map_err(|why| format!("`/{letter}`: {why}"))?;
            (Some(format), text)
        }
        Some(_) => return Err(format!("{} takes no format", command.name).into()),
    };
    Ok((
        command,
        Arguments {
            text: text.trim(),
            format,
        },
    ))
}

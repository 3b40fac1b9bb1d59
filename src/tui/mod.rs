//! The debugger in a terminal: listing, registers, watches, pictures, and a command line, all at once.
//!
//! It drives the same [`Session`] and the same [`Console`] as the line mode: keys are commands of the console, so that whatever
//! a key does can be typed, too. Everything but `terminal` is a function of the state and knows no terminal.
//!
//! Files: `app` (what events do), `keys` (which key does what), `model` (the state of the screen), `prompt` (the command line),
//! `layout` (what stands where), `view/` (what it looks like, one file a pane), `theme` (colours), `number`, `picture/` (pictures in
//! a terminal), `terminal` (taken over and given back).

mod app;
mod keys;
mod layout;
mod model;
mod number;
mod picture;
mod prompt;
mod terminal;
#[cfg(test)]
mod tests;
mod theme;
mod view;

pub(crate) use app::Perform;
pub(crate) use picture::Protocol;
pub(crate) use terminal::available;

use app::{App, Request, Surface};
use std::io;
use terminal::Terminal;
use texcrd::debug::{Console, Session};
use theme::Theme;

/// How many events are taken before the screen is drawn again, so that a key that repeats faster than the screen can follow
/// does not leave it behind.
const MOST_AT_ONCE: usize = 256;

/// Shows a session until one quits. `perform` does what the console leaves to its front. Pictures go through `protocol`, or else through the best that the terminal knows.
///
/// # Errors
/// The terminal cannot be read or written. It has been given back then.
pub(crate) fn run<'a>(
    session: Session<'a>,
    console: Console,
    perform: Perform<'a>,
    protocol: Option<Protocol>,
) -> io::Result<()> {
    let theme = Theme::of_environment(|name| std::env::var(name).ok());
    let mut app = App::new(session, console, perform);
    let mut terminal = Terminal::enter(theme, protocol)?;
    loop {
        let cell = terminal.cell();
        terminal.draw(|buf| app.screen(theme, cell).draw(buf))?;
        let mut event = Some(terminal.wait()?);
        let mut left = MOST_AT_ONCE;
        while let Some(happened) = event {
            let surface = Surface {
                area: terminal.area()?,
                cell: terminal.cell(),
                theme,
            };
            match app.handle(&happened, surface) {
                Some(Request::Quit) => return Ok(()),
                Some(Request::Redraw) => terminal.redraw(),
                Some(Request::Suspend) => terminal.suspend(),
                None => {}
            }
            left -= 1;
            event = if left > 0 { terminal.pending()? } else { None };
        }
        app.settle();
    }
}

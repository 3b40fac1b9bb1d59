//! A panic while the screen is shown, in a real terminal.

#[path = "../../../tests/terminal/tmux.rs"]
mod tmux;

use super::*;
use crate::tui::picture::Protocol;
use crate::tui::terminal;

/// What the panic says.
const WORDS: &str = "as the test asked for";

#[test]
#[ignore = "run in a terminal, by the test below"]
fn panics_on_the_screen() {
    let owned = Owned::new(LISTING);
    let app = owned.app(&[]);
    let theme = Theme {
        colours: Colours::None,
    };
    let mut terminal = terminal::Terminal::enter(theme, Some(Protocol::Blocks)).unwrap();
    let screen = app.screen(theme, None);
    terminal.draw(|buf| screen.draw(buf)).unwrap();
    panic!("{WORDS}");
}

#[test]
fn a_panic_gives_the_terminal_back() {
    let Some(terminal) = tmux::Terminal::new("panic") else {
        return;
    };
    let program = std::env::current_exe().unwrap();
    let test = "tui::tests::panic::panics_on_the_screen";
    terminal.start(&format!(
        "'{}' --ignored --nocapture --exact {test}",
        program.display()
    ));
    // On the main screen, where it can be read; the alternate one would have taken it away.
    terminal.wait("the panic", |screen| {
        screen.contains(WORDS) && screen.contains("1 failed")
    });
    terminal.is_usable();
}

//! Which key does what. The help is made of these tables.

use super::prompt::Edit;
use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyEventKind, KeyModifiers};

/// What a key asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Action {
    /// A command line of the debugger.
    Run(&'static str),
    /// What was run last, again.
    Repeat,
    /// Runs to the line of the cursor, in whichever direction it lies.
    RunToCursor,
    /// Sets or deletes a breakpoint on the line of the cursor.
    ToggleBreakpoint,
    /// The focus moves on, or back.
    Cycle {
        /// On.
        forward: bool,
    },
    /// A view by its number in [`super::layout::VIEWS`].
    View(usize),
    /// So many columns and rows in the pane that has the focus.
    Move(i32, i32),
    /// So many pages in the pane that has the focus.
    Page(i32),
    /// To the beginning of what the pane shows, or to its end.
    Far {
        /// To the end.
        end: bool,
    },
    /// Another pixel of the frame.
    Pixel(i32, i32),
    /// Enlarges or shrinks a picture.
    Zoom {
        /// Enlarges.
        closer: bool,
    },
    /// What is typed goes into the command line.
    Type,
    /// A character that begins a command.
    TypeFirst(char),
    /// The command line changes.
    Edit(Edit),
    /// The command line is run.
    Enter,
    /// The command line is completed.
    Complete,
    /// Out of the command line, out of the help.
    Leave,
    /// Shows the help.
    Help,
    /// Draws everything again.
    Redraw,
    /// Stops the program until the shell wakes it.
    Suspend,
    /// Ends the program.
    Quit,
}

/// A key with what is held with it.
type Key = (KeyCode, KeyModifiers);

/// Keys that do the same.
pub(super) struct Binding {
    keys: &'static [Key],
    /// What it does, for the help; bindings in a row with the same words are one entry of it.
    pub says: &'static str,
    action: Action,
}

const NONE: KeyModifiers = KeyModifiers::NONE;
const SHIFT: KeyModifiers = KeyModifiers::SHIFT;
const CTRL: KeyModifiers = KeyModifiers::CONTROL;
const ALT: KeyModifiers = KeyModifiers::ALT;

const fn char(c: char) -> Key {
    (KeyCode::Char(c), NONE)
}
const fn control(c: char) -> Key {
    (KeyCode::Char(c), CTRL)
}
const fn plain(code: KeyCode) -> Key {
    (code, NONE)
}
const fn function(number: u8, modifiers: KeyModifiers) -> Key {
    (KeyCode::F(number), modifiers)
}

const fn bind(keys: &'static [Key], says: &'static str, action: Action) -> Binding {
    Binding { keys, says, action }
}

/// The keys while a pane has the focus.
pub(super) static PANES: &[Binding] = &[
    bind(
        &[function(10, NONE), char('n')],
        "over the next instruction",
        Action::Run("next"),
    ),
    bind(
        &[function(11, NONE), char('s')],
        "one step: a row of a macro",
        Action::Run("step"),
    ),
    bind(
        &[function(10, SHIFT), char('N')],
        "back over an instruction",
        Action::Run("reverse-next"),
    ),
    bind(
        &[function(11, SHIFT), char('b')],
        "one step back",
        Action::Run("back"),
    ),
    bind(
        &[function(5, NONE), char('c')],
        "continue to a breakpoint",
        Action::Run("continue"),
    ),
    bind(
        &[function(5, SHIFT), char('r')],
        "continue backwards",
        Action::Run("reverse-continue"),
    ),
    bind(
        &[function(10, CTRL), char('g')],
        "run to the cursor line, either way",
        Action::RunToCursor,
    ),
    bind(
        &[function(9, NONE)],
        "breakpoint on the cursor line",
        Action::ToggleBreakpoint,
    ),
    bind(
        &[plain(KeyCode::Enter)],
        "repeat the last command",
        Action::Repeat,
    ),
    bind(&[char(':')], "command line", Action::Type),
    bind(
        &[plain(KeyCode::Tab)],
        "next pane, previous pane",
        Action::Cycle { forward: true },
    ),
    bind(
        &[plain(KeyCode::BackTab)],
        "next pane, previous pane",
        Action::Cycle { forward: false },
    ),
    bind(
        &[char('1')],
        "watches, frame, texture, quad",
        Action::View(0),
    ),
    bind(
        &[char('2')],
        "watches, frame, texture, quad",
        Action::View(1),
    ),
    bind(
        &[char('3')],
        "watches, frame, texture, quad",
        Action::View(2),
    ),
    bind(
        &[char('4')],
        "watches, frame, texture, quad",
        Action::View(3),
    ),
    bind(
        &[plain(KeyCode::Up)],
        "cursor, scroll; in the frame: pixel",
        Action::Move(0, -1),
    ),
    bind(
        &[plain(KeyCode::Down)],
        "cursor, scroll; in the frame: pixel",
        Action::Move(0, 1),
    ),
    bind(
        &[plain(KeyCode::Left)],
        "cursor, scroll; in the frame: pixel",
        Action::Move(-1, 0),
    ),
    bind(
        &[plain(KeyCode::Right)],
        "cursor, scroll; in the frame: pixel",
        Action::Move(1, 0),
    ),
    bind(
        &[plain(KeyCode::PageUp)],
        "a page up, a page down",
        Action::Page(-1),
    ),
    bind(
        &[plain(KeyCode::PageDown)],
        "a page up, a page down",
        Action::Page(1),
    ),
    bind(
        &[plain(KeyCode::Home)],
        "to the beginning, to the end",
        Action::Far { end: false },
    ),
    bind(
        &[plain(KeyCode::End)],
        "to the beginning, to the end",
        Action::Far { end: true },
    ),
    bind(
        &[(KeyCode::Up, SHIFT), (KeyCode::Up, ALT)],
        "next pixel, from any pane",
        Action::Pixel(0, -1),
    ),
    bind(
        &[(KeyCode::Down, SHIFT), (KeyCode::Down, ALT)],
        "next pixel, from any pane",
        Action::Pixel(0, 1),
    ),
    bind(
        &[(KeyCode::Left, SHIFT), (KeyCode::Left, ALT)],
        "next pixel, from any pane",
        Action::Pixel(-1, 0),
    ),
    bind(
        &[(KeyCode::Right, SHIFT), (KeyCode::Right, ALT)],
        "next pixel, from any pane",
        Action::Pixel(1, 0),
    ),
    bind(
        &[(KeyCode::Up, CTRL)],
        "16 pixels on",
        Action::Pixel(0, -16),
    ),
    bind(
        &[(KeyCode::Down, CTRL)],
        "16 pixels on",
        Action::Pixel(0, 16),
    ),
    bind(
        &[(KeyCode::Left, CTRL)],
        "16 pixels on",
        Action::Pixel(-16, 0),
    ),
    bind(
        &[(KeyCode::Right, CTRL)],
        "16 pixels on",
        Action::Pixel(16, 0),
    ),
    bind(
        &[char('+'), char('=')],
        "enlarge the picture",
        Action::Zoom { closer: true },
    ),
    bind(
        &[char('-')],
        "shrink the picture",
        Action::Zoom { closer: false },
    ),
    bind(&[char('?'), function(1, NONE)], "this help", Action::Help),
    bind(&[plain(KeyCode::Esc)], "close the help", Action::Leave),
    bind(&[control('l')], "draw the screen again", Action::Redraw),
    bind(&[control('z')], "suspend", Action::Suspend),
    bind(
        &[char('q'), control('c'), control('d')],
        "quit",
        Action::Quit,
    ),
];

/// The keys of the command line, before those of [`PANES`] that are not characters.
pub(super) static PROMPT: &[Binding] = &[
    bind(
        &[plain(KeyCode::Enter)],
        "run; an empty line repeats",
        Action::Enter,
    ),
    bind(
        &[plain(KeyCode::Esc), control('c')],
        "back to the panes",
        Action::Leave,
    ),
    bind(
        &[plain(KeyCode::Tab)],
        "complete; again: the next one",
        Action::Complete,
    ),
    bind(
        &[plain(KeyCode::Up), control('p')],
        "earlier line, later line",
        Action::Edit(Edit::Earlier),
    ),
    bind(
        &[plain(KeyCode::Down), control('n')],
        "earlier line, later line",
        Action::Edit(Edit::Later),
    ),
    bind(
        &[plain(KeyCode::Left), control('b')],
        "left, right",
        Action::Edit(Edit::Left),
    ),
    bind(
        &[plain(KeyCode::Right), control('f')],
        "left, right",
        Action::Edit(Edit::Right),
    ),
    bind(
        &[plain(KeyCode::Home), control('a')],
        "beginning, end",
        Action::Edit(Edit::Home),
    ),
    bind(
        &[plain(KeyCode::End), control('e')],
        "beginning, end",
        Action::Edit(Edit::End),
    ),
    bind(
        &[plain(KeyCode::Backspace), control('h')],
        "delete",
        Action::Edit(Edit::Backspace),
    ),
    bind(
        &[plain(KeyCode::Delete)],
        "delete",
        Action::Edit(Edit::Delete),
    ),
    bind(
        &[control('w')],
        "delete a word",
        Action::Edit(Edit::DeleteWord),
    ),
    bind(
        &[control('u')],
        "delete the line",
        Action::Edit(Edit::Clear),
    ),
    bind(
        &[control('k')],
        "delete to the end",
        Action::Edit(Edit::ClearRight),
    ),
];

/// What a key asks for, while a pane has the focus or while one is `typing` a command.
pub(super) fn action(event: &KeyEvent, typing: bool) -> Option<Action> {
    if event.kind == KeyEventKind::Release {
        return None;
    }
    let mut modifiers = event.modifiers & (SHIFT | CTRL | ALT);
    // These are what they are because Shift was held; terminals do not agree on telling so.
    if matches!(event.code, KeyCode::Char(_) | KeyCode::BackTab) {
        modifiers -= SHIFT;
    }
    let key = (event.code, modifiers);
    let in_table = |table: &[Binding]| {
        let found = table.iter().find(|binding| binding.keys.contains(&key));
        found.map(|binding| binding.action)
    };
    let typed = match key {
        (KeyCode::Char(c), NONE) => Some(c),
        _ => None,
    };
    match (typing, typed) {
        (true, Some(c)) => Some(Action::Edit(Edit::Insert(c))),
        (true, None) => in_table(PROMPT).or_else(|| in_table(PANES)),
        (false, typed) => in_table(PANES).or_else(|| {
            let command = typed.filter(|c| c.is_ascii_alphabetic());
            command.map(Action::TypeFirst)
        }),
    }
}

/// The entries of a table for the help: the keys, and what they do.
pub(super) fn entries(table: &[Binding]) -> Vec<(String, &'static str)> {
    let rows = table.chunk_by(|a, b| a.says == b.says);
    let entry = |row: &[Binding]| {
        let mut names: Vec<String> = Vec::new();
        for key in row.iter().flat_map(|binding| binding.keys) {
            let name = name(*key);
            if !names.contains(&name) {
                names.push(name);
            }
        }
        (names.join(" "), row[0].says)
    };
    rows.map(entry).collect()
}

/// The name of a key; the arrows have one together.
fn name((code, modifiers): Key) -> String {
    let name = match code {
        KeyCode::Char(c) if modifiers == CTRL => c.to_ascii_uppercase().to_string(),
        KeyCode::Char(c) => c.to_string(),
        KeyCode::F(number) => format!("F{number}"),
        KeyCode::Up | KeyCode::Down | KeyCode::Left | KeyCode::Right => "arrows".to_string(),
        KeyCode::BackTab => "Shift-Tab".to_string(),
        KeyCode::PageUp => "PgUp".to_string(),
        KeyCode::PageDown => "PgDn".to_string(),
        other => other.to_string(),
    };
    let held = [(CTRL, "Ctrl-"), (ALT, "Alt-"), (SHIFT, "Shift-")];
    let held = held.iter().filter(|(held, _)| modifiers.contains(*held));
    held.map(|(_, name)| *name).collect::<String>() + &name
}

#[cfg(test)]
mod tests {
    use super::super::layout::VIEWS;
    use super::*;

    fn press(code: KeyCode, modifiers: KeyModifiers, typing: bool) -> Option<Action> {
        action(&KeyEvent::new(code, modifiers), typing)
    }

    #[test]
    fn the_keys_of_debuggers() {
        let pressed = |code, modifiers| press(code, modifiers, false);
        assert_eq!(pressed(KeyCode::F(10), NONE), Some(Action::Run("next")));
        assert_eq!(pressed(KeyCode::F(11), SHIFT), Some(Action::Run("back")));
        assert_eq!(
            pressed(KeyCode::Char('N'), SHIFT),
            Some(Action::Run("reverse-next"))
        );
        assert_eq!(pressed(KeyCode::Char('?'), SHIFT), Some(Action::Help));
        assert_eq!(
            pressed(KeyCode::Char('p'), NONE),
            Some(Action::TypeFirst('p'))
        );
        assert_eq!(pressed(KeyCode::Char('7'), NONE), None);
        assert_eq!(pressed(KeyCode::Left, ALT), Some(Action::Pixel(-1, 0)));
        let released = KeyEvent::new_with_kind(KeyCode::F(10), NONE, KeyEventKind::Release);
        assert_eq!(action(&released, false), None);
    }

    #[test]
    fn the_command_line_takes_characters_and_leaves_function_keys() {
        let typed = |code, modifiers| press(code, modifiers, true);
        assert_eq!(
            typed(KeyCode::Char('q'), NONE),
            Some(Action::Edit(Edit::Insert('q')))
        );
        assert_eq!(
            typed(KeyCode::Char('?'), SHIFT),
            Some(Action::Edit(Edit::Insert('?')))
        );
        assert_eq!(typed(KeyCode::Tab, NONE), Some(Action::Complete));
        assert_eq!(typed(KeyCode::Up, NONE), Some(Action::Edit(Edit::Earlier)));
        assert_eq!(typed(KeyCode::Up, SHIFT), Some(Action::Pixel(0, -1)));
        assert_eq!(typed(KeyCode::F(10), NONE), Some(Action::Run("next")));
        assert_eq!(typed(KeyCode::Char('c'), CTRL), Some(Action::Leave));
    }

    #[test]
    fn no_key_has_two_meanings() {
        for table in [PANES, PROMPT] {
            let keys: Vec<Key> = table.iter().flat_map(|b| b.keys).copied().collect();
            for (number, key) in keys.iter().enumerate() {
                assert!(!keys[..number].contains(key), "{key:?}");
            }
        }
        let views = PANES.iter().filter(|b| matches!(b.action, Action::View(_)));
        assert_eq!(views.count(), VIEWS.len());
    }
}

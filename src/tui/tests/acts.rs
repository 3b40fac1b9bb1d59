//! What keys and the mouse do to the session.

use super::*;
use crate::tui::layout::Pane;

const NONE: KeyModifiers = KeyModifiers::NONE;
const SHIFT: KeyModifiers = KeyModifiers::SHIFT;
const CONTROL: KeyModifiers = KeyModifiers::CONTROL;

/// The line of the next instruction; `None` at the end.
fn line(app: &App<'_>) -> Option<usize> {
    let listing = app.session.run().unwrap().listing;
    app.session
        .next_instruction()
        .map(|next| listing.line(next))
}

/// Instructions on lines 2 to 5; `m4x4` has four rows.
const VERTEX: &str = "vs.1.1\nmov r0, v0\nm4x4 r1, r0, c0\nmov r2, r1\nmov oPos, r2\n";

#[test]
fn keys_step_in_both_directions() {
    let owned = Owned::new(VERTEX);
    let mut app = owned.app(&[("v0", &[1.0])]);
    assert_eq!(line(&app), Some(2));
    keys(&mut app, "n");
    assert_eq!(line(&app), Some(3));
    keys(&mut app, "ss");
    assert_eq!(line(&app), Some(3), "two of four rows");
    press(&mut app, KeyCode::F(10), NONE);
    assert_eq!(line(&app), Some(4));
    press(&mut app, KeyCode::F(11), SHIFT);
    assert_eq!(line(&app), Some(3), "one row back");
    keys(&mut app, "n");
    keys(&mut app, "N");
    assert_eq!(line(&app), Some(3));
    press(&mut app, KeyCode::F(5), NONE);
    assert_eq!(line(&app), None);
    press(&mut app, KeyCode::F(5), SHIFT);
    assert_eq!(app.session.position().at, 0);
    keys(&mut app, "n");
    keys(&mut app, "\n");
    assert_eq!(line(&app), Some(3), "Enter repeats");
}

#[test]
fn breakpoints_and_the_cursor() {
    let owned = Owned::new(VERTEX);
    let mut app = owned.app(&[]);
    for _ in 0..2 {
        press(&mut app, KeyCode::Down, NONE);
    }
    assert_eq!(app.model.cursor, 4);
    press(&mut app, KeyCode::F(9), NONE);
    assert_eq!(app.console.stops.breakpoints.len(), 1);
    assert_eq!(app.model.cursor, 4, "the cursor stays");
    assert!(find(&app, "●    4›mov r2, r1").is_some());
    keys(&mut app, "c");
    assert_eq!(line(&app), Some(4));
    press(&mut app, KeyCode::F(9), NONE);
    assert_eq!(app.console.stops.breakpoints.len(), 0);
    // To a line before, and to one behind.
    press(&mut app, KeyCode::Home, NONE);
    press(&mut app, KeyCode::Down, NONE);
    keys(&mut app, "g");
    assert_eq!(line(&app), Some(2));
    press(&mut app, KeyCode::End, NONE);
    press(&mut app, KeyCode::F(10), CONTROL);
    assert_eq!(line(&app), Some(5));
    press(&mut app, KeyCode::F(9), NONE);
    keys(&mut app, "r");
    assert_eq!(app.console.stops.breakpoints.len(), 1);
    // A click on a line does the same.
    let place = find(&app, "mov r2, r1").unwrap();
    click(&mut app, place.0, place.1);
    assert_eq!(app.console.stops.breakpoints.len(), 2);
    let place = find(&app, "mov r2, r1").unwrap();
    click(&mut app, place.0, place.1);
    assert_eq!(app.console.stops.breakpoints.len(), 1);
}

#[test]
fn typing_reaches_the_console() {
    let owned = Owned::new(VERTEX);
    let mut app = owned.app(&[("v0", &[3.0])]);
    // `p` has no meaning as a key, so that it begins a command.
    keys(&mut app, "print v0.x * 2\n");
    assert!(app.model.typing, "the command line keeps what is typed");
    assert!(find(&app, "> print v0.x * 2").is_some());
    assert!(find(&app, "= 6").is_some());
    keys(&mut app, "next\n");
    assert_eq!(line(&app), Some(3));
    keys(&mut app, "\n");
    assert_eq!(line(&app), Some(4), "an empty line repeats");
    press(&mut app, KeyCode::Up, NONE);
    assert_eq!(app.model.prompt.text(), "next");
    keys(&mut app, "\x1b");
    assert!(!app.model.typing);
    assert_eq!(keys(&mut app, ":quit\n"), Some(Request::Quit));
    keys(&mut app, "\x1b");
    assert_eq!(keys(&mut app, "q"), Some(Request::Quit));
    assert_eq!(
        press(&mut app, KeyCode::Char('z'), CONTROL),
        Some(Request::Suspend)
    );
}

#[test]
fn lines_that_are_pasted_are_run() {
    let owned = Owned::new(VERTEX);
    let mut app = owned.app(&[]);
    handle(
        &mut app,
        Event::Paste("next\nnext\r\nprint r".to_string()),
        SMALL,
    );
    assert_eq!(line(&app), Some(4));
    assert_eq!(app.model.prompt.text(), "print r");
}

#[test]
fn tab_completes_commands() {
    let owned = Owned::new(VERTEX);
    let mut app = owned.app(&[]);
    keys(&mut app, ":reverse-c\t");
    assert_eq!(app.model.prompt.text().trim_end(), "reverse-continue");
}

#[test]
fn tab_goes_through_the_panes() {
    let owned = Owned::new(VERTEX);
    let mut app = owned.app(&[]);
    let mut seen = vec![app.model.focus];
    for _ in 0..3 {
        keys(&mut app, "\t");
        seen.push(app.model.focus);
    }
    let all = [Pane::Listing, Pane::Registers, Pane::Output, Pane::Watches];
    assert_eq!(seen, all);
    keys(&mut app, "4");
    assert_eq!(app.model.focus, Pane::Quad);
    let (x, y) = find(&app, "3 Texture").unwrap();
    click(&mut app, x, y);
    assert_eq!(app.model.focus, Pane::Texture);
    let (x, y) = find(&app, "Registers").unwrap();
    click(&mut app, x, y);
    assert_eq!(app.model.focus, Pane::Registers);
}

#[test]
fn the_pixel_moves() {
    let scene = scene();
    let rendering = rendering(&scene);
    let mut app = pixel_app(&rendering, [1, 4]);
    keys(&mut app, "n");
    // From the listing with a key held, from the frame without.
    press(&mut app, KeyCode::Right, SHIFT);
    assert_eq!(recorded(&app), Some([2, 4]));
    assert_eq!(line(&app), Some(3), "at the same instruction as before");
    press(&mut app, KeyCode::Down, NONE);
    assert_eq!(recorded(&app), Some([2, 4]));
    keys(&mut app, "2");
    press(&mut app, KeyCode::Up, NONE);
    assert_eq!(recorded(&app), Some([2, 3]));
    // At the edge of the frame it stays.
    press(&mut app, KeyCode::Left, CONTROL);
    assert_eq!(recorded(&app), Some([0, 3]));
    press(&mut app, KeyCode::Left, NONE);
    assert_eq!(recorded(&app), Some([0, 3]));
    // The quad ends at 0.5 of clip space: pixel 6 of 8 is the first that nothing covers.
    press(&mut app, KeyCode::Right, CONTROL);
    assert_eq!(recorded(&app), Some([0, 3]));
    assert_eq!(app.frame.as_ref().unwrap().mark, [7, 3]);
    assert!(app.frame.as_ref().unwrap().refusal.is_some());
    press(&mut app, KeyCode::Left, NONE);
    press(&mut app, KeyCode::Left, NONE);
    assert_eq!(recorded(&app), Some([5, 3]));
    assert_eq!(app.frame.as_ref().unwrap().refusal, None);
}

#[test]
fn the_mouse_chooses_a_pixel() {
    let scene = scene();
    let rendering = rendering(&scene);
    let mut app = pixel_app(&rendering, [1, 4]);
    let (x, y) = find(&app, "┼").unwrap();
    // Half blocks make 6 rows of pixels 1 each high in a pane of at least 7 rows: a cell further right is not further than a pixel.
    click(&mut app, x + 4, y);
    let [column, _] = recorded(&app).unwrap();
    assert!(column > 1, "{column}");
    assert_eq!(app.model.focus, Pane::Frame);
    mouse(&mut app, MouseEventKind::Drag(MouseButton::Left), x, y);
    assert_eq!(recorded(&app).map(|[column, _]| column), Some(1));
    mouse(&mut app, MouseEventKind::ScrollUp, x, y);
    assert_eq!(app.model.frame_zoom, 2);
    keys(&mut app, "-");
    assert_eq!(app.model.frame_zoom, 1);
}

#[test]
fn the_output_scrolls() {
    let owned = Owned::new(VERTEX);
    let mut app = owned.app(&[]);
    keys(&mut app, ":");
    for number in 0..40 {
        keys(&mut app, &format!("print {number} + 100\n"));
    }
    keys(&mut app, "\x1b");
    assert!(find(&app, "print 39 + 100").is_some());
    keys(&mut app, "\t\t");
    assert_eq!(app.model.focus, Pane::Output);
    press(&mut app, KeyCode::Home, NONE);
    assert!(find(&app, "> print 0 + 100").is_some());
    press(&mut app, KeyCode::End, NONE);
    assert!(find(&app, "print 39 + 100").is_some());
    let (x, y) = find(&app, "Output").unwrap();
    mouse(&mut app, MouseEventKind::ScrollUp, x, y + 2);
    assert_eq!(app.model.output_below, 3);
}

/// Numbers that look random: the generator of Numerical Recipes.
fn random(state: &mut u32) -> u32 {
    *state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
    *state >> 8
}

fn any_event(state: &mut u32) -> Event {
    const KEYS: [KeyCode; 14] = [
        KeyCode::Up,
        KeyCode::Down,
        KeyCode::Left,
        KeyCode::Right,
        KeyCode::Home,
        KeyCode::End,
        KeyCode::PageUp,
        KeyCode::PageDown,
        KeyCode::Enter,
        KeyCode::Tab,
        KeyCode::BackTab,
        KeyCode::Esc,
        KeyCode::Backspace,
        KeyCode::Delete,
    ];
    const MICE: [MouseEventKind; 4] = [
        MouseEventKind::Down(MouseButton::Left),
        MouseEventKind::Drag(MouseButton::Left),
        MouseEventKind::ScrollUp,
        MouseEventKind::ScrollDown,
    ];
    let modifiers = [NONE, NONE, SHIFT, CONTROL][random(state) as usize % 4];
    let key = |code| Event::Key(KeyEvent::new(code, modifiers));
    match random(state) % 8 {
        0 => Event::Mouse(MouseEvent {
            kind: MICE[random(state) as usize % 4],
            column: (random(state) % 130) as u16,
            row: (random(state) % 45) as u16,
            modifiers,
        }),
        1..=3 => key(KeyCode::Char(char::from(32 + (random(state) % 95) as u8))),
        4 => key(KeyCode::F(1 + (random(state) % 12) as u8)),
        5 => {
            let commands = [
                "watch r0.x",
                "info registers",
                "history",
                "display t0",
                "set r0 = 1",
                "vertex 2",
                "pixel 3,3",
            ];
            Event::Paste(format!(
                "{}\n",
                commands[random(state) as usize % commands.len()]
            ))
        }
        _ => key(KEYS[random(state) as usize % KEYS.len()]),
    }
}

#[test]
fn no_sequence_of_events_is_too_much() {
    let scene = scene();
    let rendering = rendering(&scene);
    let areas = [SMALL, LARGE, Rect::new(0, 0, 72, 18), Rect::new(0, 0, 9, 3)];
    for seed in 0..6 {
        let mut state = seed;
        let mut app = pixel_app(&rendering, [1, 4]);
        for number in 0..400 {
            let area = areas[(number / 25) % areas.len()];
            handle(&mut app, any_event(&mut state), area);
            let mut buffer = Buffer::empty(area);
            let theme = Theme {
                colours: Colours::Indexed,
            };
            let cell = (number % 16 == 0).then_some([7, 15]);
            app.screen(theme, cell).draw(&mut buffer);
        }
    }
}

//! The screens, drawn into memory, and what keys and the mouse do.

mod acts;
#[cfg(unix)]
mod panic;
mod screens;

use super::app::{App, Request, Surface};
use super::theme::{Colours, Theme};
use ratatui::Terminal;
use ratatui::backend::TestBackend;
use ratatui::buffer::Buffer;
use ratatui::crossterm::event::{
    Event, KeyCode, KeyEvent, KeyModifiers, MouseButton, MouseEvent, MouseEventKind,
};
use ratatui::layout::Rect;
use std::collections::BTreeMap;
use texcrd::debug::{
    Console, Effect, Given, Listing, ListingSubject, PixelSubject, Session, Subject, Which,
};
use texcrd::diagnostic::SourceMap;
use texcrd::kernel::{self, Kernel};
use texcrd::policy::Dialect;
use texcrd::program::Program;
use texcrd::scene::{LoadOptions, RenderOptions, Rendering, Scene};

/// A listing that owns what it points into.
struct Owned {
    sources: SourceMap,
    program: Program,
    kernel: Kernel,
}

impl Owned {
    fn new(text: &str) -> Self {
        let mut sources = SourceMap::new();
        let file = sources.add("shader.psh", text).unwrap();
        let checked = texcrd::listing::check(file, Dialect::Lenient);
        let program = checked.accepted().expect(text).clone();
        let kernel = kernel::lower(&program, &kernel::Options::default()).unwrap();
        Self {
            sources,
            program,
            kernel,
        }
    }

    fn app(&self, values: &[(&str, &[f32])]) -> App<'_> {
        let mut given = Given::default();
        for (name, numbers) in values {
            given.set(self.program.version, name, numbers).unwrap();
        }
        let listing = Listing {
            program: &self.program,
            kernel: &self.kernel,
            sources: &self.sources,
        };
        let subject = Subject::Listing(ListingSubject { listing, given });
        let perform = |_: &Effect, _: &Session<'_>| Err("not in these tests".to_string());
        App::new(Session::new(subject), Console::new(), Box::new(perform))
    }
}

/// Two phases of ps.1.4; comments, a definition, and more registers than a small pane has rows.
const LISTING: &str = "\
; what the tests step through
ps.1.4
def c1, 0.5, 0.25, 0, 1
texcrd r0.rgb, t0
mul r1.rgb, r0, c0\t; scaled
phase
mov r0.rgb, r1
+mov r0.a, c1.b
add_sat r0.rgb, r0, c1
";

/// A scene of 8×6 pixels: a texture of 4×4 texels over all of it, times a constant, and nothing in the two columns on the right.
const SCENE: &str = r#"
size = [8, 6]

[meshes.wall]
positions = [[-1, 1, 0.5], [0.5, 1, 0.5], [0.5, -1, 0.5], [-1, -1, 0.5]]
texcoords = [[0, 0], [1, 0], [1, 1], [0, 1]]
indices = [0, 1, 2, 0, 2, 3]

[textures.dots]
size = [4, 4]
texels = [
    [1, 0, 0, 1], [0, 1, 0, 1], [0, 0, 1, 1], [1, 1, 0, 1],
    [0, 0, 0, 1], [1, 1, 1, 1], [0, 0, 0, 1], [1, 1, 1, 1],
    [1, 1, 1, 1], [0, 0, 0, 1], [1, 1, 1, 1], [0, 0, 0, 1],
    [0, 1, 1, 1], [1, 0, 1, 1], [0.5, 0.5, 0.5, 1], [0.25, 0.25, 0.25, 1],
]

[[draw]]
name = "wall"
mesh = "wall"
vs_text = """
vs.1.1
mov oPos, v0
mov oT0.xy, v7
"""
ps_text = """
ps.1.1
tex t0
mul r0, t0, c0
"""
[draw.ps_constants]
c0 = [1, 0.5, 0.25, 1]
[draw.stages.0]
texture = "dots"
filter = "linear"
"#;

fn scene() -> Scene {
    let files: BTreeMap<String, Vec<u8>> = BTreeMap::new();
    let options = LoadOptions::default();
    Scene::load("scene.toml", SCENE.as_bytes(), &files, &options).unwrap()
}

fn rendering(scene: &Scene) -> Rendering<'_> {
    scene.rendering(&RenderOptions::default(), &|_| {}).unwrap()
}

fn pixel_app<'a>(rendering: &'a Rendering<'a>, pixel: [u32; 2]) -> App<'a> {
    let subject = PixelSubject::new(rendering, pixel, &Which::default()).unwrap();
    let session = Session::new(Subject::Pixel(subject));
    let perform = |_: &Effect, _: &Session<'_>| Err("not in these tests".to_string());
    App::new(session, Console::new(), Box::new(perform))
}

/// The pixel that is recorded.
fn recorded(app: &App<'_>) -> Option<[u32; 2]> {
    match app.session.subject() {
        Subject::Pixel(subject) => Some(subject.history().pixel),
        _ => None,
    }
}

const SMALL: Rect = Rect::new(0, 0, 80, 24);
const LARGE: Rect = Rect::new(0, 0, 120, 40);

/// What the screen would show.
fn drawn(app: &App<'_>, area: Rect, colours: Colours) -> Buffer {
    let mut terminal = Terminal::new(TestBackend::new(area.width, area.height)).unwrap();
    let screen = app.screen(Theme { colours }, None);
    let draw = |frame: &mut ratatui::Frame<'_>| {
        let (pictures, _) = screen.draw(frame.buffer_mut());
        assert_eq!(pictures, []);
    };
    terminal.draw(draw).unwrap();
    terminal.backend().buffer().clone()
}

/// The characters of a screen, without blanks at the ends of lines.
fn text(buffer: &Buffer) -> String {
    let area = buffer.area();
    let row = |y: u16| -> String {
        let row = (0..area.width).map(|x| buffer[(x, y)].symbol());
        row.collect::<String>().trim_end().to_string() + "\n"
    };
    (0..area.height).map(row).collect()
}

fn handle(app: &mut App<'_>, event: Event, area: Rect) -> Option<Request> {
    let surface = Surface {
        area,
        cell: None,
        theme: Theme {
            colours: Colours::None,
        },
    };
    let asked = app.handle(&event, surface);
    app.settle();
    asked
}

fn press(app: &mut App<'_>, code: KeyCode, modifiers: KeyModifiers) -> Option<Request> {
    handle(app, Event::Key(KeyEvent::new(code, modifiers)), SMALL)
}

/// Presses keys: characters as they are, `\n` for Enter, `\t` for Tab, `\x1b` for Escape.
fn keys(app: &mut App<'_>, keys: &str) -> Option<Request> {
    let mut asked = None;
    for c in keys.chars() {
        let code = match c {
            '\n' => KeyCode::Enter,
            '\t' => KeyCode::Tab,
            '\x1b' => KeyCode::Esc,
            c => KeyCode::Char(c),
        };
        asked = asked.or(press(app, code, KeyModifiers::NONE));
    }
    asked
}

fn mouse(app: &mut App<'_>, kind: MouseEventKind, x: u16, y: u16) {
    let event = MouseEvent {
        kind,
        column: x,
        row: y,
        modifiers: KeyModifiers::NONE,
    };
    handle(app, Event::Mouse(event), SMALL);
}

fn click(app: &mut App<'_>, x: u16, y: u16) {
    mouse(app, MouseEventKind::Down(MouseButton::Left), x, y);
}

/// The place of a text on a small screen; the first from above.
fn find(app: &App<'_>, wanted: &str) -> Option<(u16, u16)> {
    let shown = text(&drawn(app, SMALL, Colours::None));
    let mut lines = shown.lines().enumerate();
    lines.find_map(|(row, line)| {
        let before = line.split_once(wanted)?.0;
        Some((before.chars().count() as u16, row as u16))
    })
}

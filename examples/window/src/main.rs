//! Spins the stained-glass window of the article in a window of the desktop, as an engine would that draws with old shader
//! pairs in its own `wgpu` renderer.
//!
//! `cargo run --release --manifest-path examples/window/Cargo.toml`; Escape ends it. `--frames N` ends after N frames and
//! says how long one took. Under X11 a library is needed that not every system has: `libxkbcommon-x11-0` (Debian, Ubuntu).
//!
//! `engine` is the engine: it takes WGSL, layouts and uniform blocks from texcrd and everything else into its own hands.
//! `glass` is what it draws.

mod engine;
mod glass;

use std::process::ExitCode;
use std::sync::Arc;
use std::time::Instant;

use winit::application::ApplicationHandler;
use winit::dpi::LogicalSize;
use winit::error::EventLoopError;
use winit::event::{ElementState, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop};
use winit::keyboard::{Key, NamedKey};
use winit::window::{Window, WindowId};

use engine::Engine;
use glass::Glass;

/// What ends the program early, in words for people.
type Failure = Box<dyn std::error::Error>;

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("error: {failure}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<(), Failure> {
    let frames = frames(std::env::args().skip(1))?;
    let events = EventLoop::new().map_err(|error| match error {
        // What the system says names files of `winit`.
        EventLoopError::Os(_) => Failure::from(
            "no window system can be reached; on Linux, DISPLAY or WAYLAND_DISPLAY says where it is",
        ),
        other => other.into(),
    })?;
    events.set_control_flow(ControlFlow::Poll);
    let mut app = App {
        glass: Glass::load()?,
        frames,
        engine: None,
        start: Instant::now(),
        drawn: 0,
        failure: None,
    };
    events.run_app(&mut app)?;
    match app.failure {
        Some(failure) => Err(failure),
        None => Ok(()),
    }
}

/// How many frames are asked for.
fn frames(mut arguments: impl Iterator<Item = String>) -> Result<Option<u32>, Failure> {
    match (arguments.next().as_deref(), arguments.next()) {
        (None, _) => Ok(None),
        (Some("--frames"), Some(number)) => match number.parse() {
            Ok(number) if number > 0 => Ok(Some(number)),
            _ => Err(format!("`{number}` is no number of frames").into()),
        },
        _ => Err("it takes nothing but `--frames N`".into()),
    }
}

struct App {
    glass: Glass,
    frames: Option<u32>,
    /// There is one as soon as there is a window.
    engine: Option<Engine>,
    start: Instant,
    drawn: u32,
    failure: Option<Failure>,
}

impl App {
    fn open(&self, events: &ActiveEventLoop) -> Result<Engine, Failure> {
        let [width, height] = self.glass.scene.size();
        let attributes = Window::default_attributes()
            .with_title("Stained glass, 2002")
            .with_inner_size(LogicalSize::new(width, height));
        let window = Arc::new(events.create_window(attributes)?);
        Engine::new(window, &self.glass)
    }

    fn draw(&mut self, events: &ActiveEventLoop) -> Result<(), Failure> {
        let Some(engine) = &mut self.engine else {
            return Ok(());
        };
        let seconds = self.start.elapsed().as_secs_f32();
        if engine.draw(&self.glass, seconds)? {
            self.drawn += 1;
        }
        if self.frames.is_some_and(|frames| self.drawn >= frames) {
            engine.finish()?;
            let each = self.start.elapsed().as_secs_f64() * 1000.0 / f64::from(self.drawn);
            println!(
                "{} frames on {}, {each:.2} ms each",
                self.drawn,
                engine.adapter()
            );
            events.exit();
        }
        Ok(())
    }

    fn handle(&mut self, events: &ActiveEventLoop, result: Result<(), Failure>) {
        if let Err(failure) = result {
            self.failure = Some(failure);
            events.exit();
        }
    }
}

impl ApplicationHandler for App {
    fn resumed(&mut self, events: &ActiveEventLoop) {
        if self.engine.is_some() {
            return;
        }
        let opened = self.open(events).map(|engine| {
            engine.window().request_redraw();
            self.engine = Some(engine);
            self.start = Instant::now();
        });
        self.handle(events, opened);
    }

    fn window_event(&mut self, events: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        match event {
            WindowEvent::CloseRequested => events.exit(),
            WindowEvent::KeyboardInput { event, .. } => {
                let pressed = event.state == ElementState::Pressed;
                if pressed && event.logical_key == Key::Named(NamedKey::Escape) {
                    events.exit();
                }
            }
            WindowEvent::Resized(size) => {
                if let Some(engine) = &mut self.engine {
                    engine.resize([size.width, size.height]);
                }
            }
            WindowEvent::RedrawRequested => {
                let drawn = self.draw(events);
                self.handle(events, drawn);
                if let Some(engine) = &self.engine {
                    engine.window().request_redraw();
                }
            }
            _ => {}
        }
    }
}

//! `debug`: through a shader step by step, forwards and backwards.

mod effects;
mod line;

use super::computing::Computing;
use super::given::{self, Loaded};
use super::shaders::Reading;
use super::{Failure, Outcome, scene};
use std::io::IsTerminal;
use texcrd::debug::{
    Listing, ListingSubject, PixelSubject, Session, Subject, VertexSubject, Which,
};
use texcrd::scene::RenderOptions;

/// Steps through a shader, forwards and backwards, register by register.
///
/// A scene file (.toml) is drawn, and one pixel of it debugged: the vertex shader of its three vertices, its own shader, the output
/// merger. A listing is run with values set by hand. `help` lists the commands; docs/debug.md has more.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  texcrd debug asm/stained_glass/scene.toml --pixel 665,136
  texcrd debug scene.toml --vertex 17 --draw pane
  texcrd debug shader.psh --set t0=0.5,0.25,0,1 --set c1=1,0,0,1
  texcrd debug scene.toml --pixel 320,240 -x 'finish' -x 'why r0'
  texcrd debug shader.psh --script commands.txt

Exit status: 1 also if a command of a script cannot be done.")]
pub(super) struct Arguments {
    /// A scene file (.toml), or a listing; `-` is a listing from standard input.
    #[arg(value_name = "FILE")]
    file: String,
    /// The pixel of the picture: column and row from the upper left. Without one, the middle.
    #[arg(long, value_name = "X,Y", value_parser = pixel, conflicts_with = "vertex")]
    pixel: Option<[u32; 2]>,
    /// A vertex instead of a pixel, by its number in the mesh.
    #[arg(long, value_name = "N")]
    vertex: Option<u32>,
    /// The draw, by its name. Without one, the last that wrote the pixel.
    #[arg(long, value_name = "NAME")]
    draw: Option<String>,
    /// The primitive of the draw, by its number.
    #[arg(long, value_name = "N", conflicts_with = "vertex")]
    primitive: Option<usize>,
    /// Width and height in pixels instead of those of the scene.
    #[arg(long, value_name = "WxH", value_parser = scene::size)]
    size: Option<[u32; 2]>,
    /// Sets an input or a constant of a listing: v#, t# (texture coordinates) or c#. One number fills all four components; of
    /// two or three the rest is 0, 0, 1 as for vertex data.
    #[arg(
        long = "set",
        value_name = "REG=X[,Y[,Z[,W]]]",
        allow_hyphen_values = true
    )]
    set: Vec<String>,
    /// Does a command and ends; may be given several times, and comes before a script.
    #[arg(short = 'x', long = "command", value_name = "COMMAND")]
    commands: Vec<String>,
    /// Does the commands of a file, a line each, and ends; `-` is standard input.
    #[arg(long, value_name = "FILE")]
    script: Option<String>,
    /// Asks for commands line by line, instead of showing everything on a whole screen.
    #[arg(long)]
    plain: bool,
    /// How the screen shows pictures: blocks, kitty, sixel or iterm2. Without it, the best that the terminal says it knows.
    #[cfg(feature = "tui")]
    #[arg(long, value_name = "WAY", conflicts_with = "plain")]
    pictures: Option<crate::tui::Protocol>,
    #[command(flatten)]
    computing: Computing,
    #[command(flatten)]
    reading: Reading,
}

/// The value parser of `--pixel`.
fn pixel(text: &str) -> Result<[u32; 2], String> {
    let parse = || {
        let (x, y) = text.split_once(',')?;
        Some([x.trim().parse().ok()?, y.trim().parse().ok()?])
    };
    parse().ok_or_else(|| format!("`{text}` is no pixel: write 640,480"))
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    if arguments.script.as_deref() == Some("-") && arguments.file == "-" {
        let why = "standard input is the listing already";
        return Err(Failure::Io(format!("--script -: {why}")));
    }
    if is_scene(&arguments.file) {
        of_scene(arguments)
    } else {
        of_listing(arguments)
    }
}

/// Scene files are TOML, and named so; listings are named in many ways.
fn is_scene(path: &str) -> bool {
    let extension = std::path::Path::new(path).extension();
    extension.is_some_and(|extension| extension.eq_ignore_ascii_case("toml"))
}

fn of_listing(arguments: &Arguments) -> Outcome {
    let of_scenes = [
        ("--pixel", arguments.pixel.is_some()),
        ("--vertex", arguments.vertex.is_some()),
        ("--draw", arguments.draw.is_some()),
        ("--primitive", arguments.primitive.is_some()),
        ("--size", arguments.size.is_some()),
    ];
    if let Some((name, _)) = of_scenes.iter().find(|(_, given)| *given) {
        return Err(Failure::Io(format!("{name}: only of a scene (.toml)")));
    }
    let Loaded {
        sources,
        program,
        kernel,
    } = given::load(
        &arguments.file,
        &arguments.reading,
        &arguments.computing.lowering(),
    )?;
    let given = given::given(&arguments.set, program.version)?;
    let subject = ListingSubject {
        listing: Listing {
            program: &program,
            kernel: &kernel,
            sources: &sources,
        },
        given,
    };
    converse(arguments, Session::new(Subject::Listing(subject)))
}

fn of_scene(arguments: &Arguments) -> Outcome {
    if !arguments.set.is_empty() {
        let why = "only of a listing; `set` changes values of a pixel";
        return Err(Failure::Io(format!("--set: {why}")));
    }
    let path = &arguments.file;
    let scene = scene::load(
        path,
        &arguments.computing.loading(arguments.reading.dialect),
    )?;
    let options = RenderOptions {
        size: arguments.size,
        ..RenderOptions::default()
    };
    let rendering = scene::draw_on_cpu(&scene, path, &options)?;
    let subject = match arguments.vertex {
        Some(vertex) => {
            VertexSubject::new(&rendering, vertex, arguments.draw.as_deref()).map(Subject::Vertex)
        }
        None => {
            let pixel = arguments
                .pixel
                .unwrap_or(rendering.size().map(|side| side / 2));
            let which = Which {
                draw: arguments.draw.clone(),
                primitive: arguments.primitive,
            };
            PixelSubject::new(&rendering, pixel, &which).map(Subject::Pixel)
        }
    };
    let subject = subject.map_err(|why| Failure::Input(format!("{path}: {why}")))?;
    converse(arguments, Session::new(subject))
}

/// Does the commands that were given, or asks for some.
fn converse(arguments: &Arguments, session: Session<'_>) -> Outcome {
    let given = !arguments.commands.is_empty() || arguments.script.is_some();
    #[cfg(feature = "tui")]
    if !given && !arguments.plain && arguments.file != "-" && crate::tui::available() {
        let inputs = [arguments.file.clone()];
        let perform = move |effect: &texcrd::debug::Effect, session: &Session<'_>| {
            effects::perform(effect, session, &inputs).map_err(|why| why.to_string())
        };
        let console = texcrd::debug::Console::new();
        let shown = crate::tui::run(session, console, Box::new(perform), arguments.pictures);
        return shown.map_err(|why| Failure::Io(format!("the terminal: {why}")));
    }
    let mut front = line::Front::new(session, &arguments.file);
    front.greet()?;
    for command in &arguments.commands {
        if !front.scripted(command, "--command")? {
            return Ok(());
        }
    }
    match &arguments.script {
        Some(path) => front.script(path),
        None if given => Ok(()),
        None if arguments.file != "-"
            && std::io::stdin().is_terminal()
            && std::io::stdout().is_terminal() =>
        {
            front.interactive()
        }
        None if arguments.file == "-" => Ok(()),
        None => front.script("-"),
    }
}

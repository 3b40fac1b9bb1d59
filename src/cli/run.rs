//! `run`: a scene to a picture.

use super::show::Show;
use super::{Failure, Outcome, diagnostics, dialect, files};
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use texcrd::diagnostic::{Diagnostic, SourceFile};
use texcrd::policy::Dialect;
use texcrd::raster::{RegisterPicture, Target};
use texcrd::scene::{DirectoryResolver, LoadOptions, PreparedDraw, RenderOptions, Scene};

/// Renders a scene on the CPU and writes a PNG.
///
/// The scene file is described in docs/scene.md. `--show` pictures a register of one draw instead of its colour.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  texcrd run asm/stained_glass/scene.toml -o stained_glass.png
  texcrd run scene.toml -o small.png --size 320x240
  texcrd run asm/stained_glass/figure5.toml -o figure4.png --show oT5 --mag
  texcrd run scene.toml -o r2.png --show r2@12 --abs --scale 0.5")]
pub(super) struct Arguments {
    /// The scene file.
    #[arg(value_name = "SCENE")]
    scene: String,
    /// Where the picture goes; `-` is standard output.
    #[arg(short, long, value_name = "OUT.png", value_parser = picture)]
    output: PathBuf,
    /// Width and height in pixels instead of those of the scene.
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<[u32; 2]>,
    /// Picture a register: r2@12 is r2 after line 12 of the pixel shader, oT5 an output of the vertex shader as it
    /// reaches the pixel, r0.a one component as grey.
    #[arg(long, value_name = "EXPR")]
    show: Option<Show>,
    /// The draw whose register is pictured; without it the last one.
    #[arg(long, value_name = "NAME", requires = "show")]
    draw: Option<String>,
    /// Show the length of (x, y, z) as grey.
    #[arg(long, requires = "show")]
    mag: bool,
    /// Show absolute values.
    #[arg(long, requires = "show")]
    abs: bool,
    /// Multiply what is shown.
    #[arg(
        long,
        value_name = "FACTOR",
        default_value_t = 1.0, value_parser = scale,
        allow_hyphen_values = true,
        requires = "show"
    )]
    scale: f32,
    /// Whose rules the listings are judged by: d3d8, d3d9 or lenient.
    #[arg(long, value_parser = dialect, default_value = "d3d8")]
    dialect: Dialect,
}

/// The value parser of `--size`.
fn size(text: &str) -> Result<[u32; 2], String> {
    let wrong = || format!("`{text}` is no size: write 1280x960");
    let (width, height) = text.split_once(['x', 'X']).ok_or_else(wrong)?;
    let number = |text: &str| text.parse::<u32>().map_err(|_| wrong());
    let size = [number(width)?, number(height)?];
    let [pixels, most] = [
        size.map(u64::from).iter().product(),
        Target::MAX_PIXELS as u64,
    ];
    if size.contains(&0) || size.iter().any(|side| *side > Target::MAX_SIDE) || pixels > most {
        let side = Target::MAX_SIDE;
        return Err(format!(
            "a picture has 1 to {side} pixels a side and at most {most} in all"
        ));
    }
    Ok(size)
}

/// The value parser of `--scale`.
fn scale(text: &str) -> Result<f32, String> {
    let number = text.parse().ok().filter(|n: &f32| n.is_finite());
    number.ok_or_else(|| format!("`{text}` is no number"))
}

/// The value parser of `-o`: what is written is a PNG, whatever the file is called.
fn picture(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let other =
        (path.extension().and_then(|e| e.to_str())).filter(|e| !e.eq_ignore_ascii_case("png"));
    match other {
        Some(other) if image::ImageFormat::from_extension(other).is_some() => Err(format!(
            "a PNG is written, so the file cannot end in .{other}"
        )),
        _ => Ok(path),
    }
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    files::can_be_written(&arguments.output)?;
    let scene = load(arguments)?;
    let show = match &arguments.show {
        Some(show) => Some(register(arguments, show, &scene)?),
        None => None,
    };
    let options = RenderOptions {
        size: arguments.size,
        show,
    };
    let bar = progress_bar();
    let target = scene
        .render(&options, &|progress| {
            bar.set_length(progress.total as u64);
            bar.set_position(progress.done as u64);
            bar.set_message(match progress.target {
                Some(target) => format!("{} into {target}", progress.draw),
                None => progress.draw.to_string(),
            });
        })
        .map_err(|e| Failure::Input(format!("{}: {e}", arguments.scene)))?;
    bar.finish_and_clear();

    let mut png = Vec::new();
    let encoder =
        PngEncoder::new_with_quality(&mut png, CompressionType::Best, FilterType::Adaptive);
    (target.to_image().write_with_encoder(encoder))
        .map_err(|e| Failure::Input(format!("the picture cannot be written as PNG: {e}")))?;
    files::write(&arguments.output, &png)
}

/// Reads the scene and says what is wrong with it.
fn load(arguments: &Arguments) -> Result<Scene, Failure> {
    let bytes = files::read(&arguments.scene)?;
    let folder = Path::new(&arguments.scene)
        .parent()
        .unwrap_or(Path::new(""));
    let resolver = DirectoryResolver::new(folder);
    let options = LoadOptions {
        dialect: arguments.dialect,
    };
    match Scene::load(files::name(&arguments.scene), &bytes, &resolver, &options) {
        Ok(scene) => {
            warn(&scene);
            Ok(scene)
        }
        Err(error) => {
            anstream::eprint!(
                "{}",
                diagnostics::render(&error.sources, &error.diagnostics)
            );
            let summary = diagnostics::summary(&error.diagnostics).unwrap_or_default();
            Err(Failure::Input(format!("{}: {summary}", arguments.scene)))
        }
    }
}

/// Warnings of the scene file in full; those of its listings are counted: whoever draws a picture is not about to
/// change a listing, and `check` tells them.
fn warn(scene: &Scene) {
    let file = |warning: &Diagnostic| {
        scene
            .sources()
            .file_of(warning.span.start)
            .map(SourceFile::name)
    };
    let is_listing = |warning: &&Diagnostic| !warning.rule.id.starts_with('F');
    let (listings, own): (Vec<_>, Vec<_>) = scene.warnings().iter().partition(is_listing);
    let own: Vec<Diagnostic> = own.into_iter().cloned().collect();
    anstream::eprint!("{}", diagnostics::render(scene.sources(), &own));
    for of_file in listings.chunk_by(|a, b| file(a) == file(b)) {
        let of_file: Vec<Diagnostic> = of_file.iter().map(|d| (*d).clone()).collect();
        if let (Some(first), Some(summary)) = (of_file.first(), diagnostics::summary(&of_file)) {
            let name = file(first).unwrap_or_default();
            anstream::eprintln!("{name}: {summary} (`texcrd check {name}` shows them)");
        }
    }
}

/// The register to show, as the pixel shader of its draw has it.
fn register(
    arguments: &Arguments,
    show: &Show,
    scene: &Scene,
) -> Result<texcrd::scene::Show, Failure> {
    let wrong = |why: String| Failure::Io(format!("--show: {why}"));
    let passes = scene.passes(arguments.size.unwrap_or(scene.size()));
    let draws = passes.last().map(|pass| pass.draws.as_slice());
    let draws: &[PreparedDraw<'_>] = draws.unwrap_or_default();
    let draw = match &arguments.draw {
        Some(name) => draws.iter().rfind(|draw| draw.name == name),
        None => draws.last(),
    };
    let draw = draw.ok_or_else(|| {
        let names: Vec<_> = draws.iter().map(|draw| draw.name).collect();
        wrong(format!("the picture has the draws {}", names.join(", ")))
    })?;
    let program = &draw.pixel.program;
    let slot = show.slot(program.version).map_err(wrong)?;
    let instructions = match show.line {
        None => usize::MAX,
        Some(line) => {
            let of = |span| scene.sources().locate(span).map_or(0, |at| at.line);
            let last = of(program.span.at_end());
            if line == 0 || line > last {
                let message = format!("the listing has the lines 1 to {last}, not {line}");
                return Err(wrong(message));
            }
            let runs = program.instructions().filter(|i| of(i.span) <= line);
            runs.count()
        }
    };
    Ok(texcrd::scene::Show {
        draw: Some(draw.name.to_string()),
        picture: RegisterPicture {
            slot,
            instructions,
            view: show.view(arguments.mag),
            absolute: arguments.abs,
            scale: arguments.scale,
        },
    })
}

/// A bar on a terminal, nothing in a pipe.
fn progress_bar() -> ProgressBar {
    let bar = ProgressBar::no_length();
    if !std::io::stderr().is_terminal() {
        bar.set_draw_target(ProgressDrawTarget::hidden());
    }
    if let Ok(style) = ProgressStyle::with_template("{bar:30} {pos}/{len} {msg}") {
        bar.set_style(style);
    }
    bar
}

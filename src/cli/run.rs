//! `run`: a scene to a picture.

use super::show::Show;
use super::{Failure, Outcome, dialect, files, scene};
use clap::ValueEnum;
use std::path::PathBuf;
use texcrd::gpu::Renderer;
use texcrd::policy::Dialect;
use texcrd::raster::RegisterPicture;
use texcrd::scene::{PreparedDraw, RenderOptions, Scene};

/// Who draws.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum Path {
    /// The interpreter and rasterizer of this program.
    #[default]
    Cpu,
    /// A GPU, or a software adapter, through WGSL.
    Gpu,
}

/// Renders a scene on the CPU or the GPU and writes a PNG.
///
/// The scene file is described in docs/scene.md. `--show` pictures a register of one draw instead of its colour.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  texcrd run asm/stained_glass/scene.toml -o stained_glass.png
  texcrd run scene.toml -o small.png --size 320x240
  texcrd run asm/stained_glass/figure5.toml -o figure4.png --show oT5 --mag
  texcrd run scene.toml -o gpu.png --on gpu
  texcrd run scene.toml -o r2.png --show r2@12 --abs --scale 0.5
  texcrd run scene.toml -o r2.png --show r2@12 --on gpu")]
pub(super) struct Arguments {
    /// The scene file.
    #[arg(value_name = "SCENE")]
    scene: String,
    /// Where the picture goes; `-` is standard output.
    #[arg(short, long, value_name = "OUT.png", value_parser = scene::picture)]
    output: PathBuf,
    /// Width and height in pixels instead of those of the scene.
    #[arg(long, value_name = "WxH", value_parser = scene::size)]
    size: Option<[u32; 2]>,
    /// Who draws.
    #[arg(long, value_enum, default_value_t)]
    on: Path,
    /// The GPU: its number in `texcrd adapters`, or a part of its name. Without it the first one.
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
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

/// The value parser of `--scale`.
fn scale(text: &str) -> Result<f32, String> {
    let number = text.parse().ok().filter(|n: &f32| n.is_finite());
    number.ok_or_else(|| format!("`{text}` is no number"))
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    if arguments.on == Path::Cpu && arguments.adapter.is_some() {
        return Err(Failure::Io("--adapter: only with --on gpu".into()));
    }
    files::can_be_written(&arguments.output)?;
    let scene = scene::load(&arguments.scene, arguments.dialect)?;
    let show = match &arguments.show {
        Some(show) => Some(register(arguments, show, &scene)?),
        None => None,
    };
    let options = RenderOptions {
        size: arguments.size,
        show,
    };
    let picture = match arguments.on {
        Path::Cpu => (scene::draw_on_cpu(&scene, &arguments.scene, &options)?)
            .picture()
            .to_image(),
        Path::Gpu => {
            let device = scene::device(arguments.adapter.as_deref())?;
            let mut renderer = Renderer::new(&device);
            let frame = scene::draw_on_gpu(&mut renderer, &scene, &arguments.scene, &options, &[])?;
            frame.picture().clone()
        }
    };
    scene::write_png(&arguments.output, &picture)
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

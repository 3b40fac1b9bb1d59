//! `run`: a scene to a picture, or to pictures of registers.

use super::computing::Several;
use super::frames::{Motion, animated};
use super::{Failure, Outcome, dialect, files, scene};
use clap::ValueEnum;
use image::RgbaImage;
use std::path::PathBuf;
use texcrd::gpu::Renderer;
use texcrd::kernel::Slot;
use texcrd::policy::{Dialect, Model};
use texcrd::raster::{Look, MarkSet, RegisterPicture, Target, Tone, View};
use texcrd::scene::{RenderOptions, Scene, Show, ShowExpression};
use texcrd::sheet::{self, Dressing, SheetTooLarge, Tile};

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
/// The scene file is described in docs/scene.md. `--show` pictures registers of one draw instead of its colour: a picture
/// of one, a contact sheet of several. docs/pictures.md says what the colours mean.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  texcrd run asm/stained_glass/scene.toml -o stained_glass.png
  texcrd run scene.toml -o small.png --size 320x240
  texcrd run asm/stained_glass/figure5.toml -o figure4.png --show oT5 --mag
  texcrd run asm/stained_glass/scene.toml -o sheet.png --show all
  texcrd run scene.toml -o sheet.png --show r2@12 --show r2@14 --signed
  texcrd run scene.toml -o r2.png --show r2.r@12 --sign --bar
  texcrd run scene.toml -o gpu.png --show r2@12 --on gpu
  texcrd run scene.toml -o models.png --model float,gf3,r200
  texcrd run asm/reflection/per_pixel.toml -o ball.png --frames 60
  texcrd run asm/stained_glass/figure5.toml -o window.png --size 320x240 --frames 24 --swing 30")]
pub(super) struct Arguments {
    /// The scene file.
    #[arg(value_name = "SCENE")]
    scene: String,
    /// Where the picture goes; `-` is standard output.
    #[arg(short, long, value_name = "OUT.png", value_parser = scene::picture)]
    output: PathBuf,
    /// Width and height in pixels instead of those of the scene. Of a contact sheet: those of each picture on it, which
    /// otherwise are at most 320 pixels wide.
    #[arg(long, value_name = "WxH", value_parser = scene::size)]
    size: Option<[u32; 2]>,
    /// Who draws.
    #[arg(long, value_enum, default_value_t)]
    on: Path,
    /// The GPU: its number in `texcrd adapters`, or a part of its name. Without it the first one.
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
    /// Picture a register: r2@12 is r2 after line 12 of the pixel shader, oT5 an output of the vertex shader as it
    /// reaches the pixel, r0.a one component as grey. `all` is one picture for each instruction. Several make a contact
    /// sheet.
    #[arg(long, value_name = "EXPR")]
    show: Vec<ShowExpression>,
    /// The draw whose registers are pictured; without it the last one.
    #[arg(long, value_name = "NAME", requires = "show")]
    draw: Option<String>,
    /// Show the length of the components as grey.
    #[arg(long, requires = "show")]
    mag: bool,
    /// Show absolute values.
    #[arg(long, requires = "show")]
    abs: bool,
    /// Show -1 as black, 0 as mid grey and 1 as white.
    #[arg(long, requires = "show", conflicts_with = "abs")]
    signed: bool,
    /// Show only which numbers are negative, 0 and positive.
    #[arg(long, requires = "show", conflicts_with_all = ["abs", "signed"])]
    sign: bool,
    /// Multiply what is shown.
    #[arg(
        long,
        value_name = "FACTOR",
        default_value_t = 1.0, value_parser = scale,
        allow_hyphen_values = true,
        requires = "show"
    )]
    scale: f32,
    /// Mark in colours of their own what is too dark or too bright to be seen, and what `texkill` discards. NaN, infinite
    /// and unwritten numbers are marked in any case.
    #[arg(long, requires = "show")]
    mark: bool,
    /// Draw a scale bar and a legend of the marks below the picture; contact sheets have them.
    #[arg(long, requires = "show")]
    bar: bool,
    /// Draw none on a contact sheet.
    #[arg(long, requires = "show", conflicts_with = "bar")]
    no_bar: bool,
    #[command(flatten)]
    motion: Motion,
    /// Whose rules the listings are judged by: d3d8, d3d9 or lenient.
    #[arg(long, value_parser = dialect, default_value = "d3d8")]
    dialect: Dialect,
    #[command(flatten)]
    computing: Several,
}

/// Pictures on a contact sheet are at most so wide, unless a size is given.
const SHEET_WIDTH: u32 = 320;

/// The value parser of `--scale`.
fn scale(text: &str) -> Result<f32, String> {
    let number = text
        .parse()
        .ok()
        .filter(|n: &f32| n.is_finite() && *n != 0.0);
    number.ok_or_else(|| format!("`{text}` is no number other than 0"))
}

impl Arguments {
    /// How registers are shown.
    fn look(&self) -> Look {
        Look {
            view: match self.mag {
                true => View::Magnitude,
                false => View::Color,
            },
            tone: match (self.abs, self.signed, self.sign) {
                (true, ..) => Tone::Absolute,
                (_, true, _) => Tone::Signed,
                (_, _, true) => Tone::Sign,
                (false, false, false) => Tone::Plain,
            },
            scale: self.scale,
            marks_range: self.mark,
            ..Look::default()
        }
    }

    /// Whether a contact sheet is made of these tiles.
    fn is_sheet(&self, tiles: &[Tile]) -> bool {
        tiles.len() > 1 || self.show.iter().any(ShowExpression::is_all)
    }
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    if arguments.on == Path::Cpu && arguments.adapter.is_some() {
        return Err(Failure::Io("--adapter: only with --on gpu".into()));
    }
    files::can_be_written(&arguments.output)?;
    let models = arguments.computing.models();
    let several = models.len() > 1;
    if let Some(count) = arguments.motion.frames {
        let [model] = models[..] else {
            return Err(Failure::Io("--frames: with one --model only".into()));
        };
        return animate(arguments, model, count);
    }
    let mut sheet = Sheet::default();
    let mut dressing = Dressing {
        captions: several,
        bars: false,
        // Models are to be compared.
        columns: several.then_some(models.len() as u32),
    };
    for (number, model) in models.iter().enumerate() {
        let options = arguments.computing.loading(*model, arguments.dialect);
        let scene = match number {
            0 => scene::load(&arguments.scene, &options)?,
            _ => scene::load_again(&arguments.scene, &options)?,
        };
        let tiles = tiles(arguments, &scene)?;
        let shown = arguments.is_sheet(&tiles);
        if number == 0 {
            dressing.captions = several || shown;
            dressing.bars =
                !tiles.is_empty() && (dressing.captions || arguments.bar) && !arguments.no_bar;
            sheet.size = (arguments.size).unwrap_or_else(|| match dressing.captions {
                true => shrunk(scene.size()),
                false => scene.size(),
            });
            let planes = tiles.len().max(1) * models.len();
            Target::check_planes(sheet.size, planes).map_err(|error| {
                let option = if several { "--model" } else { "--show" };
                Failure::Io(format!("{option}: {error}; a smaller --size helps"))
            })?;
        }
        sheet.draw(arguments, &scene, tiles)?;
        if several {
            sheet.name(*model);
        }
    }
    sheet.side_by_side(models.len());
    let dressed = dressing.captions || dressing.bars;
    let picture = match (dressed, sheet.pictures.first()) {
        (false, Some(picture)) => picture.clone(),
        _ => sheet
            .compose(dressing)
            .map_err(|error| Failure::Io(format!("the sheet: {error}")))?,
    };
    scene::write_png(&arguments.output, &picture)
}

/// Draws the scene again and again with a moving camera, into one file.
fn animate(arguments: &Arguments, model: Model, count: u32) -> Outcome {
    let options = arguments.computing.loading(model, arguments.dialect);
    let mut scene = scene::load(&arguments.scene, &options)?;
    let size = arguments.size.unwrap_or(scene.size());
    let file = animated(size, count, |number| {
        scene.turn_camera(arguments.motion.angle(number, count));
        let mut frame = Sheet {
            size,
            ..Sheet::default()
        };
        frame.draw(arguments, &scene, Vec::new())?;
        Ok(frame.pictures.pop().unwrap_or_default())
    })?;
    files::write(&arguments.output, &file)
}

/// Pictures and what is said of each.
#[derive(Default)]
struct Sheet {
    size: [u32; 2],
    tiles: Vec<Tile>,
    pictures: Vec<RgbaImage>,
    marks: Vec<MarkSet>,
    /// How many tiles have been named after their model.
    named: usize,
}

impl Sheet {
    /// Draws a scene: the registers of the tiles, or its picture if there are none.
    fn draw(&mut self, arguments: &Arguments, scene: &Scene, tiles: Vec<Tile>) -> Outcome {
        let options = RenderOptions {
            size: Some(self.size),
            show: Some(Show {
                draw: arguments.draw.clone(),
                pictures: tiles.iter().map(|tile| tile.picture).collect(),
            })
            .filter(|_| !tiles.is_empty()),
        };
        match arguments.on {
            Path::Cpu => {
                let drawn = scene::draw_on_cpu(scene, &arguments.scene, &options)?;
                let planes = 0..tiles.len().max(1);
                self.pictures
                    .extend(planes.map(|plane| drawn.picture().plane(plane)));
                self.marks.extend(drawn.marks());
            }
            Path::Gpu => {
                let device = scene::device(arguments.adapter.as_deref())?;
                let mut renderer = Renderer::new(&device);
                let frame =
                    scene::draw_on_gpu(&mut renderer, scene, &arguments.scene, &options, &[])?;
                match tiles.is_empty() {
                    true => self.pictures.push(frame.picture().clone()),
                    false => self.pictures.extend(frame.register_pictures().cloned()),
                }
                self.marks.extend(frame.marks());
            }
        }
        self.tiles.extend(tiles);
        // The finished picture is what is left in r0, and has neither bar nor marks.
        self.tiles.resize_with(self.pictures.len(), || Tile {
            caption: String::new(),
            picture: RegisterPicture {
                slot: Slot::R0,
                instructions: usize::MAX,
                look: Look::default(),
                killed: false,
            },
        });
        self.marks.resize(self.pictures.len(), MarkSet::default());
        Ok(())
    }

    /// Puts the pictures of one register under several models next to each other; they were drawn model by model.
    fn side_by_side(&mut self, models: usize) {
        let each = self.pictures.len() / models.max(1);
        if models < 2 || each < 2 {
            return;
        }
        let order = (0..each).flat_map(|tile| (0..models).map(move |model| model * each + tile));
        let order: Vec<usize> = order.collect();
        let pick = |number: &usize| self.pictures.get(*number).cloned();
        self.pictures = order.iter().filter_map(pick).collect();
        self.tiles = (order.iter())
            .filter_map(|number| self.tiles.get(*number).cloned())
            .collect();
        self.marks = (order.iter())
            .filter_map(|number| self.marks.get(*number).copied())
            .collect();
    }

    /// Names the tiles that came last after the model that they were drawn with.
    fn name(&mut self, model: Model) {
        for tile in self.tiles.iter_mut().skip(self.named) {
            tile.caption = match tile.caption.as_str() {
                "" => model.to_string(),
                caption => format!("{model}: {caption}"),
            };
        }
        self.named = self.tiles.len();
    }

    fn compose(&self, dressing: Dressing) -> Result<RgbaImage, SheetTooLarge> {
        let picture = |number: usize| match self.pictures.get(number) {
            Some(picture) => picture.clone(),
            None => RgbaImage::new(0, 0),
        };
        sheet::compose(&self.tiles, self.size, dressing, &self.marks, picture)
    }
}

/// A size of the same shape that is at most as wide as pictures on a sheet.
pub(super) fn shrunk([width, height]: [u32; 2]) -> [u32; 2] {
    let least = width.min(SHEET_WIDTH);
    let height = u64::from(height) * u64::from(least) / u64::from(width.max(1));
    [least, (height as u32).max(1)]
}

/// What is pictured, expression after expression.
fn tiles(arguments: &Arguments, scene: &Scene) -> Result<Vec<Tile>, Failure> {
    let Some(first) = arguments.show.first() else {
        return Ok(Vec::new());
    };
    let place = (scene.shown_draw(arguments.draw.as_deref()))
        .map_err(|error| Failure::Io(format!("--draw: {error}")))?;
    let mut passes = scene.passes(scene.size());
    let draws = passes.pop().map(|pass| pass.draws).unwrap_or_default();
    let Some(draw) = draws.get(place) else {
        return Ok(Vec::new());
    };
    let mut tiles = Vec::new();
    for expression in &arguments.show {
        let shown = expression.tiles(scene, draw, arguments.look(), arguments.mark);
        tiles.extend(shown.map_err(|why| Failure::Io(format!("--show: {why}")))?);
    }
    if tiles.is_empty() {
        let (name, all) = (draw.name, first);
        return Err(Failure::Io(format!(
            "--show {all}: the pixel shader of `{name}` has no instruction that writes a register"
        )));
    }
    Ok(tiles)
}

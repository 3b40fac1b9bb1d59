//! `compare`: a scene on both paths.

mod json;
mod picture;
mod text;

use super::computing::Computing;
use super::{Failure, Format, Outcome, dialect, files, print, print_json, scene};
use image::RgbaImage;
use std::path::PathBuf;
use texcrd::diagnostic::Span;
use texcrd::gpu::{
    Differences, FragmentComparison, GpuError, LEVEL_ERROR, LineComparison, PixelComparison,
    Renderer, compare_pixel,
};
use texcrd::kernel::Slot;
use texcrd::policy::Dialect;
use texcrd::program::Program;
use texcrd::raster::Target;
use texcrd::scene::{Output, PreparedDraw, RenderOptions, Rendering, Scene, TargetPicture};

/// Renders a scene on the CPU and on the GPU and says where they differ, and where a pixel's registers part.
///
/// Differences are in steps of 1/255, of pixels inside triangles and of those on edges apart: which triangle covers a
/// pixel on an edge is a matter of rounding, and no two rasterizers agree on all. The exit status is 1 if a pixel inside
/// differs by more than the tolerance, in the picture or in a render target, and levels of detail that are a little off do
/// not explain it. What samples render targets reads those of the CPU on both paths.
///
/// Of the worst pixel, or another one, the registers are shown on both sides, and the first instruction whose registers
/// part: the pixel shader is cut after each of its instructions and run again on the GPU.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  texcrd compare asm/stained_glass/scene.toml
  texcrd compare scene.toml --tolerance 8 -o differences.png
  texcrd compare scene.toml --pixel 120,84 --all-lines
  texcrd compare scene.toml --level-error 0 --tolerance 3
  texcrd compare scene.toml --adapter llvmpipe --format json

docs/compare.md says how to read what is printed.")]
pub(super) struct Arguments {
    /// The scene file.
    #[arg(value_name = "SCENE")]
    scene: String,
    /// The greatest difference of a channel that is accepted, 0 to 255.
    #[arg(long, value_name = "N", default_value_t = 1)]
    tolerance: u8,
    /// Do not accept greater differences on edges of triangles either.
    #[arg(long)]
    strict: bool,
    /// By how many mip levels the level of detail of the GPU may be off, 0 to 1; 0: not at all. Where a pixel differs by
    /// more than the tolerance, the CPU draws with the levels of each stage moved that far either way, and only what lies
    /// beyond all of that counts.
    #[arg(long, value_name = "LEVELS", default_value_t = LEVEL_ERROR, value_parser = level_error)]
    level_error: f32,
    /// Where a picture of the differences goes: over the dark picture, yellow to red inside triangles, blue on edges.
    #[arg(short, long, value_name = "DIFF.png", value_parser = scene::picture)]
    output: Option<PathBuf>,
    /// Width and height in pixels instead of those of the scene.
    #[arg(long, value_name = "WxH", value_parser = scene::size)]
    size: Option<[u32; 2]>,
    /// The pixel whose registers are compared, column and row from the upper left one, 0,0; without it the worst one
    /// inside a triangle, or else the worst.
    #[arg(long, value_name = "X,Y", value_parser = pixel)]
    pixel: Option<[u32; 2]>,
    /// Registers part if they differ by more than this times the larger of both, or this if both are below 1. The
    /// default is 2^-16: a little above what rounding in interpolation and filtering is worth.
    #[arg(long, value_name = "T", default_value_t = 1.0 / 65536.0, value_parser = part_tolerance)]
    part_tolerance: f32,
    /// List the difference of every register that an instruction writes, line by line.
    #[arg(long)]
    all_lines: bool,
    /// The GPU: its number in `texcrd adapters`, or a part of its name. Without it the first one.
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
    /// How results are written.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
    /// Whose rules the listings are judged by: d3d8, d3d9 or lenient.
    #[arg(long, value_parser = dialect, default_value = "d3d8")]
    dialect: Dialect,
    #[command(flatten)]
    computing: Computing,
}

/// The channels of a picture, in order.
const CHANNELS: [&str; 4] = ["red", "green", "blue", "alpha"];

/// The value parser of `--pixel`.
fn pixel(text: &str) -> Result<[u32; 2], String> {
    let number = |text: &str| text.trim().parse::<u32>().ok();
    let parsed = text.split_once(',').map(|(x, y)| (number(x), number(y)));
    match parsed {
        Some((Some(x), Some(y))) => Ok([x, y]),
        _ => Err(format!("`{text}` is no pixel: write 120,84")),
    }
}

/// The value parser of `--part-tolerance`.
fn part_tolerance(text: &str) -> Result<f32, String> {
    let number = text
        .parse()
        .ok()
        .filter(|n: &f32| n.is_finite() && *n >= 0.0);
    number.ok_or_else(|| format!("`{text}` is no tolerance: write a number of 0 or more"))
}

/// The value parser of `--level-error`.
fn level_error(text: &str) -> Result<f32, String> {
    let number = text.parse().ok().filter(|n: &f32| (0.0..=1.0).contains(n));
    number.ok_or_else(|| format!("`{text}` is no part of a level: write a number from 0 to 1"))
}

/// What was found out.
struct Findings<'a> {
    arguments: &'a Arguments,
    scene: &'a Scene,
    size: [u32; 2],
    adapter: String,
    all: Differences,
    picture: Compared,
    targets: Vec<TargetFace>,
    pixel: Option<Pixel>,
}

/// A face of a render target.
struct TargetFace {
    target: String,
    face: usize,
    compared: Compared,
}

/// The pixels of a picture, those inside triangles and those on edges.
struct Compared {
    inside: Differences,
    edges: Differences,
    /// What is left of the differences when levels of detail may be off; none if nothing had to be explained, or there are
    /// no mip levels that could.
    beyond_levels: Option<[Differences; 2]>,
}

impl Compared {
    /// Compares what was drawn.
    fn new(
        arguments: &Arguments,
        rendering: &Rendering<'_>,
        output: Output,
        gpu: &RgbaImage,
    ) -> Result<Self, Failure> {
        let unequal = || Failure::Input("the two pictures are not of one size".into());
        let cpu = rendering.drawn(output).ok_or_else(unequal)?;
        let [inside, edges] = Differences::inside_and_on_edges(cpu, gpu).ok_or_else(unequal)?;
        let error = arguments.level_error;
        let apart = [&inside, &edges].map(|found| found.above(arguments.tolerance));
        let range = match error == 0.0 || apart == [0, 0] {
            true => None,
            false => (rendering.level_range(output, &[-error, error]))
                .map_err(|error| Failure::Input(format!("{}: {error}", arguments.scene)))?,
        };
        Ok(Self {
            beyond_levels: range.and_then(|range| Differences::beyond_levels(cpu, &range, gpu)),
            inside,
            edges,
        })
    }

    /// What counts: the differences inside triangles and on edges that levels do not explain.
    fn judged(&self) -> [&Differences; 2] {
        let all = || [&self.inside, &self.edges];
        self.beyond_levels
            .as_ref()
            .map_or_else(all, |[inside, edges]| [inside, edges])
    }

    /// How many pixels differ by more than is accepted.
    fn above(&self, arguments: &Arguments) -> u64 {
        let [inside, edges] = self.judged().map(|found| found.above(arguments.tolerance));
        inside + if arguments.strict { edges } else { 0 }
    }
}

/// The pixel that was looked into.
struct Pixel {
    inside: bool,
    cpu: [u8; 4],
    gpu: [u8; 4],
    /// What the registers are, or why they could not be had.
    comparison: Result<PixelComparison, GpuError>,
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    if let Some(path) = &arguments.output {
        if path.as_os_str() == "-" {
            return Err(Failure::Io(
                "-o -: standard output is for the differences in words; write the picture to a file".into(),
            ));
        }
        files::can_be_written(path)?;
    }
    let loaded = scene::load(
        &arguments.scene,
        &arguments.computing.loading(arguments.dialect),
    )?;
    let size = arguments.size.unwrap_or(loaded.size());
    if let Some([x, y]) = (arguments.pixel).filter(|[x, y]| *x >= size[0] || *y >= size[1]) {
        let [width, height] = size;
        return Err(Failure::Io(format!(
            "--pixel: the picture is {width}x{height}, so that {x},{y} lies outside"
        )));
    }
    let device = scene::device(arguments.adapter.as_deref())?;
    let options = RenderOptions {
        size: arguments.size,
        show: None,
    };
    let cpu = scene::draw_on_cpu(&loaded, &arguments.scene, &options)?;
    let mut renderer = Renderer::new(&device);
    // The same render targets for both, so that a difference in one is told once, where it arises.
    let given = cpu.target_pictures();
    let mut gpu = scene::draw_on_gpu(&mut renderer, &loaded, &arguments.scene, &options, &given)?;
    let image = cpu.picture().to_image();
    let unequal = || Failure::Input("the two pictures are not of one size".into());
    let all = Differences::between(&image, gpu.picture()).ok_or_else(unequal)?;
    let picture = Compared::new(arguments, &cpu, Output::Picture, gpu.picture())?;
    let targets = gpu.targets().iter().map(|on_gpu| {
        let TargetPicture {
            target,
            face,
            ref picture,
        } = *on_gpu;
        Ok(TargetFace {
            target: loaded
                .target(target)
                .map_or("", |target| target.name)
                .to_string(),
            face,
            compared: Compared::new(arguments, &cpu, Output::Target { target, face }, picture)?,
        })
    });
    let targets = targets.collect::<Result<_, Failure>>()?;
    let [judged, _] = picture.judged();
    let worst = judged.worst.or(picture.inside.worst).or(all.worst);
    let worst = worst.map(|worst| [worst.x, worst.y]);
    let pixel = (arguments.pixel.or(worst)).map(|[x, y]| Pixel {
        inside: cpu.picture().inside(x, y),
        cpu: image.get_pixel(x, y).0,
        gpu: gpu.picture().get_pixel(x, y).0,
        comparison: compare_pixel(&cpu, &mut gpu, [x, y]),
    });
    let findings = Findings {
        arguments,
        scene: &loaded,
        size,
        adapter: device.adapter().to_string(),
        all,
        picture,
        targets,
        pixel,
    };
    match arguments.format {
        Format::Text => print(&text::report(&findings))?,
        Format::Json => print_json(&json::report(&findings))?,
    }
    if let Some(path) = &arguments.output {
        scene::write_png(path, &picture::differences(cpu.picture(), gpu.picture()))?;
    }
    match findings.passed() {
        true => Ok(()),
        false => Err(Failure::Rejected),
    }
}

impl Findings<'_> {
    /// How many pixels of the picture, and of render targets, differ by more than is accepted.
    fn above(&self) -> [u64; 2] {
        let targets = self.targets.iter();
        [
            self.picture.above(self.arguments),
            targets
                .map(|face| face.compared.above(self.arguments))
                .sum(),
        ]
    }

    fn passed(&self) -> bool {
        self.above() == [0, 0]
    }

    /// The draws of the picture.
    fn draws(&self) -> Vec<PreparedDraw<'_>> {
        let pass = self.scene.passes(self.size).pop();
        pass.map(|pass| pass.draws).unwrap_or_default()
    }

    /// The file and the line of a place in a listing.
    fn place(&self, span: Span) -> (&str, usize) {
        let found = self.scene.sources().locate(span);
        found.map_or(("", 0), |at| (at.file, at.line))
    }

    /// An instruction as it stands in the listing.
    fn instruction(&self, line: &LineComparison) -> String {
        let text = self.scene.sources().text(line.span);
        let words: Vec<&str> = text.split_whitespace().collect();
        words.join(" ")
    }
}

/// What a register is called. Up to `ps.1.3` `t0` is a texture register; its coordinates are `oT0`, as `--show` has it.
fn register_name(program: &Program, slot: Slot) -> String {
    let set = (0..8).find(|set| Slot::texcoord(*set) == Some(slot));
    match set {
        Some(set) if program.version != texcrd::isa::Version::Ps14 => format!("oT{set}"),
        _ => slot.name(program.version.kind()),
    }
}

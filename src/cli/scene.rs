//! What commands that draw scenes have in common: reading, progress, writing of pictures.

use super::{Failure, Outcome, computing, diagnostics, files};
use image::RgbaImage;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use texcrd::diagnostic::{Diagnostic, SourceFile};
use texcrd::gpu::{Device, Frame, GpuError, Renderer};
use texcrd::raster::Target;
use texcrd::scene::{
    DirectoryResolver, LoadOptions, Progress, RenderOptions, Rendering, Scene, TargetPicture,
};

/// The value parser of `--size`.
pub(super) fn size(text: &str) -> Result<[u32; 2], String> {
    let wrong = || format!("`{text}` is no size: write 1280x960");
    let (width, height) = text.split_once(['x', 'X']).ok_or_else(wrong)?;
    let number = |text: &str| text.parse::<u32>().map_err(|_| wrong());
    let size = [number(width)?, number(height)?];
    let [pixels, most] = [size.map(u64::from).iter().product(), Target::MAX_PIXELS];
    if size.contains(&0) || size.iter().any(|side| *side > Target::MAX_SIDE) || pixels > most {
        let side = Target::MAX_SIDE;
        return Err(format!(
            "a picture has 1 to {side} pixels a side and at most {most} in all"
        ));
    }
    Ok(size)
}

/// The value parser of `-o`: what is written is a PNG, whatever the file is called.
pub(super) fn picture(text: &str) -> Result<PathBuf, String> {
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

/// Reads the scene and says what is wrong with it.
pub(super) fn load(path: &str, options: &LoadOptions) -> Result<Scene, Failure> {
    let scene = load_again(path, options)?;
    warn(&scene);
    Ok(scene)
}

/// As [`load`], of a scene whose warnings have been told.
pub(super) fn load_again(path: &str, options: &LoadOptions) -> Result<Scene, Failure> {
    let bytes = files::read(path)?;
    let folder = Path::new(path).parent().unwrap_or(Path::new(""));
    let resolver = DirectoryResolver::new(folder);
    match Scene::load(files::name(path), &bytes, &resolver, options) {
        Ok(scene) => {
            computing::note_scene(options.model, &scene);
            Ok(scene)
        }
        Err(error) => {
            anstream::eprint!(
                "{}",
                diagnostics::render(&error.sources, &error.diagnostics)
            );
            let summary = diagnostics::summary(&error.diagnostics).unwrap_or_default();
            Err(Failure::Input(format!("{}: {summary}", path)))
        }
    }
}

/// Warnings of the scene file in full; those of its listings are counted: whoever draws a picture is not about to
/// change a listing, and `check` tells them.
fn warn(scene: &Scene) {
    let file = |warning: &Diagnostic| {
        scene
            .sources()
            .file_of(scene.sources().written(warning.span).start)
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

/// Opens the adapter that `--adapter` names.
pub(super) fn device(adapter: Option<&str>) -> Result<Device, Failure> {
    Device::open(adapter).map_err(|error| match error {
        GpuError::NoSuchAdapter { .. } => Failure::Io(format!("--adapter: {error}")),
        _ => Failure::Io(error.to_string()),
    })
}

/// Draws a scene on the CPU, with a bar while it lasts.
pub(super) fn draw_on_cpu<'s>(
    scene: &'s Scene,
    path: &str,
    options: &RenderOptions,
) -> Result<Rendering<'s>, Failure> {
    let bar = progress_bar();
    let drawn = scene.rendering(options, &|progress| show(&bar, &progress));
    bar.finish_and_clear();
    drawn.map_err(|error| Failure::Input(format!("{path}: {error}")))
}

/// Draws a scene on the GPU, with a bar while it lasts; what is given of render targets is seen instead of what was drawn.
pub(super) fn draw_on_gpu<'r, 'd>(
    renderer: &'r mut Renderer<'d>,
    scene: &'r Scene,
    path: &str,
    options: &RenderOptions,
    given: &[TargetPicture],
) -> Result<Frame<'r, 'd>, Failure> {
    let bar = progress_bar();
    let drawn = renderer.frame(scene, options, given, &|progress| show(&bar, &progress));
    bar.finish_and_clear();
    drawn.map_err(|error| Failure::Input(format!("{path}: {error}")))
}

/// Writes a picture as PNG.
pub(super) fn write_png(path: &Path, picture: &RgbaImage) -> Outcome {
    /// Pixels from which on compressing well would take longer than drawing.
    const MANY: u64 = 3 << 19;
    let mut png = Vec::new();
    let compression = match u64::from(picture.width()) * u64::from(picture.height()) < MANY {
        true => CompressionType::Default,
        false => CompressionType::Fast,
    };
    let encoder = PngEncoder::new_with_quality(&mut png, compression, FilterType::Adaptive);
    (picture.write_with_encoder(encoder))
        .map_err(|e| Failure::Input(format!("the picture cannot be written as PNG: {e}")))?;
    files::write(path, &png)
}

/// Shows on a bar how far a picture is.
pub(super) fn show(bar: &ProgressBar, progress: &Progress<'_>) {
    bar.set_length(progress.total as u64);
    bar.set_position(progress.done as u64);
    bar.set_message(match progress.target {
        Some(target) => format!("{} into {target}", progress.draw),
        None => progress.draw.to_string(),
    });
}

/// A bar on a terminal, nothing in a pipe.
pub(super) fn progress_bar() -> ProgressBar {
    let bar = ProgressBar::no_length();
    if !std::io::stderr().is_terminal() {
        bar.set_draw_target(ProgressDrawTarget::hidden());
    }
    if let Ok(style) = ProgressStyle::with_template("{bar:30} {pos}/{len} {msg}") {
        bar.set_style(style);
    }
    bar
}

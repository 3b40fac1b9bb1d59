//! `bench`: how long a frame takes on the CPU and on every adapter.

use super::computing::Computing;
use super::{Failure, Format, Outcome, dialect, print, print_json, scene};
use serde_json::json;
use std::time::{Duration, Instant};
use texcrd::gpu::{self, Device, PreparedFrame, Renderer};
use texcrd::policy::Dialect;
use texcrd::scene::Scene;
use texcrd::simd::Simd;

/// Times the CPU and every GPU adapter on the same picture of a scene, in turns.
///
/// A frame is the picture itself, from its vertices to the last pixel in the target, on all cores. What is made once is done
/// before and not counted on either side: reading, translating, uploading, render targets and the textures they become. Nothing
/// is read back or written. On a GPU it is the time from submission to the fence. Software adapters are taken as they are:
/// their driver filters as it does by default.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  texcrd bench asm/stained_glass/scene.toml --size 1920x1080
  texcrd bench scene.toml --simd sse2 --seconds 20
  texcrd bench scene.toml --frames 100 --format json")]
pub(super) struct Arguments {
    /// The scene file.
    #[arg(value_name = "SCENE")]
    scene: String,
    /// Width and height in pixels instead of those of the scene.
    #[arg(long, value_name = "WxH", value_parser = scene::size)]
    size: Option<[u32; 2]>,
    /// Only this adapter: its number in `texcrd adapters`, or a part of its name. `none`: no adapter, only the CPU.
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
    /// The most that the CPU may use: sse2, avx2 or avx512. Without it what the processor has.
    #[arg(long, value_name = "SET")]
    simd: Option<Simd>,
    /// How many frames each side draws; without it as many as fit into the time.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    frames: Option<u32>,
    /// About how long all sides together may take, in seconds; each draws three frames at least.
    #[arg(long, value_name = "SECONDS", default_value_t = 10.0, value_parser = seconds, allow_hyphen_values = true, conflicts_with = "frames")]
    seconds: f64,
    /// How results are written.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
    /// Whose rules the listings are judged by: d3d8, d3d9 or lenient.
    #[arg(long, value_parser = dialect, default_value = "d3d8")]
    dialect: Dialect,
    #[command(flatten)]
    computing: Computing,
}

/// The value parser of `--seconds`.
fn seconds(text: &str) -> Result<f64, String> {
    let number = text.parse().ok();
    let number = number.filter(|n: &f64| *n > 0.0 && *n <= 86_400.0);
    number.ok_or_else(|| format!("`{text}` is no time: write 0.5 to 86400"))
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    if let Some(simd) = arguments.simd {
        if !simd.is_available() {
            let message = format!("--simd: this processor has no {simd}");
            return Err(Failure::Io(message));
        }
        simd.limit();
    }
    let options = arguments.computing.loading(arguments.dialect);
    let scene = scene::load(&arguments.scene, &options)?;
    let size = arguments.size.unwrap_or(scene.size());
    let failed =
        |error: &dyn std::fmt::Display| Failure::Input(format!("{}: {error}", arguments.scene));
    let mut on_cpu = scene.prepare_frame(size).map_err(|error| failed(&error))?;
    let devices = devices(arguments.adapter.as_deref())?;
    let mut renderers: Vec<_> = devices.iter().map(Renderer::new).collect();
    let mut sides = Vec::new();
    for (device, renderer) in devices.iter().zip(&mut renderers) {
        match first_frame(renderer, &scene, size) {
            Ok(frame) => sides.push(Side::new(device, frame)),
            // Others may do better.
            Err(error) => anstream::eprintln!("{}: {error}", device.adapter()),
        }
    }
    let bar = scene::progress_bar();
    // The first frame touches memory for the first time.
    on_cpu.draw().map_err(|error| failed(&error))?;
    let mut cpu = Vec::new();
    let start = Instant::now();
    let done = |rounds: usize| match arguments.frames {
        Some(frames) => rounds >= frames as usize,
        None => rounds >= 3 && start.elapsed().as_secs_f64() >= arguments.seconds,
    };
    while !done(cpu.len()) {
        bar.set_message(format!("frame {}", cpu.len() + 1));
        let before = Instant::now();
        on_cpu.draw().map_err(|error| failed(&error))?;
        cpu.push(before.elapsed());
        for side in &mut sides {
            let time = side.frame.draw();
            side.times.push(time.map_err(|error| failed(&error))?);
        }
    }
    bar.finish_and_clear();
    report(arguments, size, cpu, sides)
}

/// The devices of all adapters, or of the one that is meant. One that cannot be opened is told of and left out.
fn devices(wanted: Option<&str>) -> Result<Vec<Device>, Failure> {
    match wanted {
        Some("none") => Ok(Vec::new()),
        Some(name) => Ok(vec![scene::device(Some(name))?]),
        None => {
            let mut devices = Vec::new();
            for number in 0..gpu::adapters().len() {
                match Device::open(Some(&number.to_string())) {
                    Ok(device) => devices.push(device),
                    Err(error) => anstream::eprintln!("{error}"),
                }
            }
            Ok(devices)
        }
    }
}

/// An adapter and what it took.
struct Side<'r, 'd> {
    name: &'d str,
    frame: PreparedFrame<'r, 'd>,
    times: Vec<Duration>,
}

impl<'r, 'd> Side<'r, 'd> {
    fn new(device: &'d Device, frame: PreparedFrame<'r, 'd>) -> Self {
        Self {
            name: &device.adapter().name,
            frame,
            times: Vec::new(),
        }
    }
}

/// Gets a frame ready and draws it once: drivers compile shaders when they are first used.
fn first_frame<'r, 'd>(
    renderer: &'r mut Renderer<'d>,
    scene: &'r Scene,
    size: [u32; 2],
) -> Result<PreparedFrame<'r, 'd>, gpu::GpuError> {
    let frame = renderer.prepare_frame(scene, size)?;
    frame.draw()?;
    Ok(frame)
}

/// The median in milliseconds: of an even number the mean of the middle two.
fn median(mut times: Vec<Duration>) -> f64 {
    times.sort_unstable();
    let ms = |at: usize| times.get(at).map_or(0.0, |time| time.as_secs_f64() * 1e3);
    let half = times.len() / 2;
    match times.len() % 2 {
        0 => (ms(half.saturating_sub(1)) + ms(half)) / 2.0,
        _ => ms(half),
    }
}

fn report(
    arguments: &Arguments,
    [width, height]: [u32; 2],
    cpu: Vec<Duration>,
    sides: Vec<Side<'_, '_>>,
) -> Outcome {
    let frames = cpu.len();
    let (cpu, simd, threads) = (median(cpu), Simd::chosen(), rayon::current_num_threads());
    let sides: Vec<_> = (sides.into_iter())
        .map(|side| (side.name, median(side.times)))
        .collect();
    let rounded = |number: f64| (number * 1000.0).round() / 1000.0;
    match arguments.format {
        Format::Json => {
            let adapters: Vec<_> = (sides.iter())
                .map(|(name, median)| {
                    json!({
                        "name": name,
                        "median_ms": rounded(*median),
                        "cpu_is_faster_by": rounded(median / cpu),
                    })
                })
                .collect();
            print_json(&json!({
                "scene": arguments.scene,
                "size": [width, height],
                "cpu": {
                    "median_ms": rounded(cpu),
                    "threads": threads,
                    "simd": simd.name(),
                },
                "adapters": adapters,
            }))
        }
        Format::Text => {
            let plural = |count: usize| if count == 1 { "" } else { "s" };
            let mut text = format!(
                "{} at {width}×{height}, {frames} frame{} on each side\n\
                 CPU, {simd}, {threads} thread{}: {cpu:.2} ms\n",
                arguments.scene,
                plural(frames),
                plural(threads),
            );
            for (name, median) in sides {
                let ratio = median / cpu;
                text.push_str(&format!(
                    "{name}: {median:.2} ms, {ratio:.2} times the CPU's\n"
                ));
            }
            print(&text)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians_are_those_of_the_middle() {
        let of =
            |times: &[u64]| median(times.iter().map(|ms| Duration::from_millis(*ms)).collect());
        assert_eq!(of(&[5, 1, 3]), 3.0);
        assert_eq!(of(&[4, 1, 3, 8]), 3.5);
        assert_eq!(of(&[]), 0.0);
    }
}

//! `compare`: a scene on both paths.

use super::{Failure, Format, Outcome, dialect, files, print, print_json, scene};
use image::{Rgba, RgbaImage};
use serde_json::json;
use std::path::PathBuf;
use texcrd::gpu::Differences;
use texcrd::policy::Dialect;
use texcrd::scene::RenderOptions;

/// Renders a scene on the CPU and on the GPU and says where they differ.
///
/// Differences are in steps of 1/255. The exit status is 1 if one is above the tolerance.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  texcrd compare asm/stained_glass/figure5.toml --size 320x240
  texcrd compare scene.toml --tolerance 8 -o differences.png
  texcrd compare scene.toml --adapter llvmpipe --format json")]
pub(super) struct Arguments {
    /// The scene file.
    #[arg(value_name = "SCENE")]
    scene: String,
    /// The greatest difference of a channel that is accepted, 0 to 255.
    #[arg(long, value_name = "N", default_value_t = 1)]
    tolerance: u8,
    /// Where a picture of the differences goes: black is equal, every step of 1/255 is 16 brighter.
    #[arg(short, long, value_name = "DIFF.png", value_parser = scene::picture)]
    output: Option<PathBuf>,
    /// Width and height in pixels instead of those of the scene.
    #[arg(long, value_name = "WxH", value_parser = scene::size)]
    size: Option<[u32; 2]>,
    /// The GPU: its number in `texcrd adapters`, or a part of its name. Without it the first one.
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
    /// How results are written.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
    /// Whose rules the listings are judged by: d3d8, d3d9 or lenient.
    #[arg(long, value_parser = dialect, default_value = "d3d8")]
    dialect: Dialect,
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    if let Some(path) = &arguments.output {
        files::can_be_written(path)?;
    }
    let loaded = scene::load(&arguments.scene, arguments.dialect)?;
    let device = scene::device(arguments.adapter.as_deref())?;
    let options = RenderOptions {
        size: arguments.size,
        show: None,
    };
    let bar = scene::progress_bar();
    let cpu = loaded
        .render(&options, &|progress| scene::show(&bar, &progress))
        .map_err(|e| Failure::Input(format!("{}: {e}", arguments.scene)))?
        .to_image();
    bar.finish_and_clear();
    let gpu = scene::draw_on_gpu(&device, &loaded, &arguments.scene, arguments.size)?;
    let differences = Differences::between(&cpu, &gpu)
        .ok_or_else(|| Failure::Input("the two pictures are not of one size".into()))?;
    let adapter = device.adapter().to_string();
    match arguments.format {
        Format::Text => print(&text(&differences, &adapter, arguments.tolerance))?,
        Format::Json => print_json(&json(&differences, &adapter, arguments))?,
    }
    if let Some(path) = &arguments.output {
        scene::write_png(path, &picture(&cpu, &gpu))?;
    }
    match differences.max() <= arguments.tolerance {
        true => Ok(()),
        false => Err(Failure::Rejected),
    }
}

const CHANNELS: [&str; 4] = ["red", "green", "blue", "alpha"];

fn text(differences: &Differences, adapter: &str, tolerance: u8) -> String {
    let pixels = differences.pixels();
    let mut text = format!("{pixels} pixels, CPU against {adapter}, in steps of 1/255\n");
    for ((name, max), mean) in
        (CHANNELS.iter().zip(differences.max_of_channel)).zip(differences.mean_of_channel())
    {
        text.push_str(&format!("  {name:<5}  max {max:>3}  mean {mean:.4}\n"));
    }
    text.push_str("  pixels by their greatest difference:\n");
    for (step, count) in differences.counts() {
        let share = 100.0 * count as f64 / pixels.max(1) as f64;
        text.push_str(&format!("    {step:>3}  {count:>9}  {share:.3} %\n"));
    }
    if let Some(worst) = &differences.worst {
        text.push_str(&format!(
            "  worst at {}, {}: CPU {:?}, GPU {:?}\n",
            worst.x, worst.y, worst.cpu, worst.gpu
        ));
    }
    let above = differences.above(tolerance);
    text.push_str(&match above {
        0 => format!("no pixel differs by more than {tolerance}\n"),
        1 => format!("1 pixel differs by more than {tolerance}\n"),
        _ => format!("{above} pixels differ by more than {tolerance}\n"),
    });
    text
}

fn json(differences: &Differences, adapter: &str, arguments: &Arguments) -> serde_json::Value {
    let channels: serde_json::Map<_, _> = (CHANNELS.iter())
        .zip(differences.max_of_channel)
        .zip(differences.mean_of_channel())
        .map(|((name, max), mean)| (name.to_string(), json!({ "max": max, "mean": mean })))
        .collect();
    let histogram: Vec<_> = (differences.counts())
        .map(|(step, count)| json!({ "difference": step, "pixels": count }))
        .collect();
    json!({
        "scene": arguments.scene,
        "adapter": adapter,
        "pixels": differences.pixels(),
        "tolerance": arguments.tolerance,
        "above_tolerance": differences.above(arguments.tolerance),
        "max": differences.max(),
        "channels": channels,
        "histogram": histogram,
        "worst": differences.worst.map(|worst| json!({
            "x": worst.x, "y": worst.y, "cpu": worst.cpu, "gpu": worst.gpu,
        })),
    })
}

fn picture(cpu: &RgbaImage, gpu: &RgbaImage) -> RgbaImage {
    RgbaImage::from_fn(cpu.width(), cpu.height(), |x, y| {
        let (a, b) = (cpu.get_pixel(x, y).0, gpu.get_pixel(x, y).0);
        let of = |channel: usize| a[channel].abs_diff(b[channel]).saturating_mul(16);
        Rgba([of(0), of(1), of(2), 255])
    })
}

//! How the cost of a frame grows: with its pixels, with its triangles, with threads and sets of instructions.
//!
//! `cargo bench --no-default-features --features scene,parallel --bench scaling` prints the tables of BENCHMARKS.md; with
//! `-- --write` it puts them there and draws the plots of docs/benchmarks. It takes two to three minutes. All sides of a
//! comparison draw in turns, and numbers are medians.
#![allow(
    clippy::expect_used,
    reason = "a benchmark that cannot go on has failed"
)]

#[path = "../examples/gallery/marks.rs"]
mod marks;
#[path = "../examples/gallery/plot.rs"]
mod plot;
mod shared;

use plot::{Axis, Line, plot};
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::error::Error;
use std::fmt::Write;
use std::path::Path;
use std::sync::mpsc::channel;
use std::thread;
use std::time::{Duration, Instant};
use texcrd::scene::{LoadOptions, PreparedFrame, Scene};
use texcrd::simd::Simd;

/// How long the sides of a comparison draw together, and how long if they have not drawn three frames each by then.
const TIME: [Duration; 2] = [Duration::from_millis(1500), Duration::from_secs(6)];
/// The sides of the squares, as powers of two.
const SIDES: std::ops::RangeInclusive<u32> = 8..=12;
/// Columns and rows of a patch of quads: 1,000 triangles and then always ten times as many.
const PATCHES: [[u32; 2]; 4] = [[25, 20], [100, 50], [250, 200], [1000, 500]];
/// The scenes of the project's limits, and the sizes that these are about.
const SCENES: [(&str, &str, [u32; 2]); 3] = [
    ("arithmetic", "benches/scenes/arithmetic.toml", [1920, 1080]),
    ("triangles", "benches/scenes/triangles.toml", [1024, 768]),
    (
        "stained glass",
        "asm/stained_glass/scene.toml",
        [1920, 1080],
    ),
];
const TRIANGLES: &str = include_str!("scenes/triangles.toml");

/// Median times in milliseconds of `count` sides that draw in turns.
fn in_turns(count: usize, mut draw: impl FnMut(usize) -> Duration) -> Vec<f64> {
    // The first frame touches memory for the first time.
    for side in 0..count {
        draw(side);
    }
    let mut times = vec![Vec::new(); count];
    let start = Instant::now();
    while times[0].is_empty() || start.elapsed() < TIME[usize::from(times[0].len() < 3)] {
        for (side, times) in times.iter_mut().enumerate() {
            times.push(draw(side));
        }
    }
    let median = |mut times: Vec<Duration>| {
        times.sort_unstable();
        times[times.len() / 2].as_secs_f64() * 1e3
    };
    times.into_iter().map(median).collect()
}

fn timed(frame: &mut PreparedFrame<'_>) -> Duration {
    let before = Instant::now();
    frame.draw().expect("it can be drawn");
    before.elapsed()
}

/// The same picture of a scene on each of some pools of threads.
fn on(pools: &[ThreadPool], scene: &Scene, size: [u32; 2]) -> Vec<f64> {
    thread::scope(|scope| {
        // A frame stays on the thread that it was made on.
        let side = |pool| {
            let (go, gone) = channel();
            let (tell, told) = channel();
            let draw = move || {
                let mut frame = scene.prepare_frame(size).expect("it can be drawn");
                for () in gone {
                    // Nobody listens any more: the measurement is over.
                    let _ = tell.send(timed(&mut frame));
                }
            };
            scope.spawn(move || ThreadPool::install(pool, draw));
            (go, told)
        };
        let sides: Vec<_> = pools.iter().map(side).collect();
        in_turns(sides.len(), |side| {
            let (go, told) = &sides[side];
            go.send(()).expect("the thread waits");
            told.recv().expect("it draws")
        })
    })
}

/// A table with its plot, by the names of their files.
struct Shown {
    name: &'static str,
    table: String,
    plot: Option<String>,
}

fn row(table: &mut String, cells: &[String]) {
    // Writing into a string does not fail.
    let _ = writeln!(table, "| {} |", cells.join(" | "));
}

fn table(heads: &[&str]) -> String {
    let mut table = String::new();
    row(
        &mut table,
        &heads.iter().map(ToString::to_string).collect::<Vec<_>>(),
    );
    row(&mut table, &vec!["---".to_string(); heads.len()]);
    table
}

/// An axis from 0 that has room above the highest of some numbers.
fn up(name: &'static str, lines: &[Line]) -> Axis {
    let points = lines.iter().flat_map(|line| &line.points);
    let most = points.fold(1e-3_f64, |most, [_, up]| most.max(*up)) * 1.5;
    let power = 10_f64.powf((most / 8.0).log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0].map(|step| step * power);
    let step = steps.into_iter().find(|step| most / step <= 8.0);
    let step = step.unwrap_or(most);
    Axis {
        name,
        end: (most / step).ceil() * step,
        step,
        label: |number| format!("{}", (number * 1000.0).round() / 1000.0),
    }
}

/// On one pool of threads alone: what grows with the picture is not about threads.
fn pixels(pools: &[ThreadPool]) -> Shown {
    let scenes = [
        ("arithmetic", SCENES[0].1),
        ("one texture", "benches/scenes/textured.toml"),
        ("stained glass", SCENES[2].1),
    ];
    let mut lines = scenes.map(|(name, _)| Line {
        name: name.to_string(),
        points: Vec::new(),
    });
    let loaded = scenes.map(|(_, path)| shared::scene(path));
    let mut text = table(&[&["ns a pixel"], scenes.map(|(name, _)| name).as_slice()].concat());
    for (number, power) in SIDES.enumerate() {
        let side = 1 << power;
        let mut cells = vec![format!("{side}×{side}")];
        for (line, scene) in lines.iter_mut().zip(&loaded) {
            let ms = on(pools, scene, [side, side]);
            let ns = ms[0] * 1e6 / f64::from(side * side);
            line.points.push([number as f64, ns]);
            cells.push(format!("{ns:.1}"));
        }
        row(&mut text, &cells);
    }
    let across = Axis {
        name: "side of the square picture in pixels",
        end: SIDES.count() as f64 - 0.7,
        step: 1.0,
        label: |number| (1_u32 << (*SIDES.start() + number as u32)).to_string(),
    };
    let up = up("time of a frame / pixels, ns", &lines);
    Shown {
        name: "pixels",
        table: text,
        plot: Some(plot(&across, &up, &lines)),
    }
}

fn triangles(pools: &[ThreadPool]) -> Shown {
    let mut lines = ["1 thread", "2 threads"].map(|name| Line {
        name: name.to_string(),
        points: Vec::new(),
    });
    let mut text = table(&["triangles", "picture", "1 thread", "2 threads"]);
    for (number, [columns, rows]) in PATCHES.into_iter().enumerate() {
        let listing = TRIANGLES
            .replace("columns = 250", &format!("columns = {columns}"))
            .replace("rows = 200", &format!("rows = {rows}"));
        let files = texcrd::scene::DirectoryResolver::new(".");
        let scene = Scene::load("scene", listing.as_bytes(), &files, &LoadOptions::default());
        let scene = scene.expect("the scene is sound");
        // As many pixels a triangle in each picture.
        let count = 2 * columns * rows;
        let [width, height] = SCENES[1]
            .2
            .map(|side| (f64::from(side) * (f64::from(count) / 1e5).sqrt()) as u32);
        let mut cells = vec![count.to_string(), format!("{width}×{height}")];
        for (line, ms) in lines.iter_mut().zip(on(pools, &scene, [width, height])) {
            let ns = ms * 1e6 / f64::from(count);
            line.points.push([number as f64, ns]);
            cells.push(format!("{ns:.0} ns"));
        }
        row(&mut text, &cells);
    }
    let across = Axis {
        name: "triangles",
        end: PATCHES.len() as f64 - 0.7,
        step: 1.0,
        label: |number| 10_u32.pow(number as u32 + 3).to_string(),
    };
    Shown {
        name: "triangles",
        table: text,
        plot: Some(plot(
            &across,
            &up("time of a frame / triangles, ns", &lines),
            &lines,
        )),
    }
}

fn threads(pools: &[ThreadPool]) -> Shown {
    let mut text = table(&["ms a frame", "1 thread", "2 threads", "times as fast"]);
    for (name, path, size) in SCENES {
        let times = on(pools, &shared::scene(path), size);
        let faster = times[0] / times[1];
        let mut cells = vec![format!("{name}, {}×{}", size[0], size[1])];
        cells.extend(times.iter().map(|ms| format!("{ms:.1}")));
        cells.push(format!("{faster:.2}"));
        row(&mut text, &cells);
    }
    Shown {
        name: "threads",
        table: text,
        plot: None,
    }
}

fn instructions() -> Shown {
    let sets: Vec<Simd> = Simd::ALL.into_iter().filter(|s| s.is_available()).collect();
    let mut heads = vec!["ms a frame"];
    heads.extend(sets.iter().map(|simd| simd.name()));
    let mut text = table(&heads);
    let mut lines = Vec::new();
    for (name, path, size) in SCENES {
        let scene = shared::scene(path);
        let mut frame = scene.prepare_frame(size).expect("it can be drawn");
        let times = in_turns(sets.len(), |side| {
            sets[side].limit();
            timed(&mut frame)
        });
        let mut cells = vec![format!("{name}, {}×{}", size[0], size[1])];
        cells.extend(times.iter().map(|ms| format!("{ms:.1}")));
        row(&mut text, &cells);
        let points = times.iter().enumerate();
        lines.push(Line {
            name: name.to_string(),
            points: points
                .map(|(set, ms)| [set as f64, times[0] / ms])
                .collect(),
        });
    }
    let across = Axis {
        name: "set of instructions",
        end: sets.len().max(2) as f64 - 0.7,
        step: 1.0,
        label: |number| {
            Simd::ALL
                .get(number as usize)
                .map_or("", |simd| simd.name())
                .to_string()
        },
    };
    Shown {
        name: "instructions",
        table: text,
        plot: Some(plot(
            &across,
            &up("times as fast as with the first set", &lines),
            &lines,
        )),
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let asked = |flag: &str| std::env::args().any(|argument| argument == flag);
    if asked("--test") {
        // Whoever tests all targets has no minutes for this.
        return Ok(());
    }
    let pool = |threads| ThreadPoolBuilder::new().num_threads(threads).build();
    let pools = [pool(1)?, pool(2)?];
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let parts: [fn(&[ThreadPool]) -> Shown; 4] = [
        |pools| pixels(&pools[1..]),
        triangles,
        threads,
        |_| instructions(),
    ];
    for part in parts {
        let shown = part(&pools);
        println!("{}", shown.table);
        if asked("--write") {
            let begin = format!(
                "<!-- {}: written by the benchmark `scaling` -->",
                shown.name
            );
            marks::put(&root.join("BENCHMARKS.md"), &begin, &shown.table)?;
            if let Some(plot) = shown.plot {
                let folder = root.join("docs/benchmarks");
                std::fs::create_dir_all(&folder)?;
                std::fs::write(folder.join(format!("{}.svg", shown.name)), plot)?;
            }
        }
    }
    Ok(())
}

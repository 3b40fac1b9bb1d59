//! How much memory a frame takes beside its textures and its target: each scene in a process of its own.
//!
//! `cargo bench --no-default-features --features scene,parallel --bench memory`; BENCHMARKS.md says what came out. The peak is that of
//! the whole process, from its start over reading the scene and making its textures to the last pixel; Linux tells it. What must be there is
//! worked out: four bytes a texel (all textures of these scenes are kept so), nine bytes a pixel of a target, for colour, depth
//! and stencil. Meshes are not taken off.
#![allow(
    clippy::expect_used,
    reason = "a benchmark that cannot go on has failed"
)]

mod shared;

use std::process::Command;
use texcrd::scene::{Scene, TextureSource};

const SIZE: [u32; 2] = [1920, 1080];
const MIB: f64 = 1_048_576.0;

/// The bytes of the textures and targets of a scene.
fn needed(scene: &Scene) -> f64 {
    let area = |[width, height]: [u32; 2]| f64::from(width) * f64::from(height);
    // All levels together are a third more than the first.
    let texels = |size, faces: usize| 4.0 * area(size) * faces as f64 * 4.0 / 3.0;
    let of_texture = |source: &TextureSource| match source {
        TextureSource::Loaded(texture) => {
            let [width, height, _] = texture.size();
            texels([width, height], texture.face_count())
        }
        TextureSource::Target(number) => scene.target(*number).map_or(0.0, |target| {
            texels(target.size, target.faces) + 9.0 * area(target.size)
        }),
        TextureSource::Irradiance { edge, .. } => texels([*edge; 2], 6),
    };
    let textures = scene.textures().iter();
    9.0 * area(SIZE) + textures.map(|entry| of_texture(&entry.source)).sum::<f64>()
}

/// The most memory that this process has had, in MiB.
fn peak() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kib: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kib / 1024.0)
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    if arguments.iter().any(|argument| argument == "--test") {
        return;
    }
    if let [_, scene, path] = arguments.as_slice()
        && scene == "--scene"
    {
        let scene = shared::scene(path);
        let mut frame = scene.prepare_frame(SIZE).expect("it can be drawn");
        frame.draw().expect("it can be drawn");
        let Some(peak) = peak() else {
            println!("| {path} | this system does not tell |");
            return;
        };
        let needed = needed(&scene) / MIB;
        let more = peak - needed;
        println!("| {path} | {peak:.0} | {needed:.0} | {more:.0} |");
        return;
    }
    println!("| MiB, 1920×1080 | peak | textures and targets | above |");
    println!("| --- | --- | --- | --- |");
    let program = std::env::current_exe().expect("this program lies somewhere");
    for path in [
        "benches/scenes/arithmetic.toml",
        "benches/scenes/triangles.toml",
        "asm/stained_glass/scene.toml",
    ] {
        let child = Command::new(&program).args(["--scene", path]).status();
        assert!(child.expect("it can be started again").success(), "{path}");
    }
}

//! One frame against a contact sheet of its whole shader, in pictures of 640×480: of the stained glass, and of a shader that
//! does nothing but arithmetic on every pixel, where the pictures cost most compared with the frame.
//!
//! `cargo bench --no-default-features --features scene,parallel --bench pictures`; BENCHMARKS.md says what came out. *frame* and
//! *sheet* begin with a loaded scene: with the cube map of the room, if there is one. *as PNG* encodes what came out as
//! `texcrd run` does.
#![allow(
    clippy::expect_used,
    missing_docs,
    reason = "a benchmark that cannot go on has failed, and criterion's macro makes a function"
)]

use std::collections::BTreeMap;
use std::hint::black_box;
use std::path::Path;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use image::RgbaImage;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use texcrd::raster::Look;
use texcrd::scene::{
    DirectoryResolver, LoadOptions, RenderOptions, Resolver, Scene, Show, ShowExpression,
};
use texcrd::sheet::{Dressing, Tile};

const SIZE: [u32; 2] = [640, 480];

/// A rectangle over the whole picture; 8 + 8 instructions and one sample.
const ARITHMETIC: &str = r#"
size = [640, 480]
[meshes.all]
positions = [[-1, 1, 0.5], [1, 1, 0.5], [1, -1, 0.5], [-1, -1, 0.5]]
texcoords = [[0, 0], [1, 0], [1, 1], [0, 1]]
indices = [0, 1, 2, 0, 2, 3]
[[draw]]
mesh = "all"
vs_text = "vs.1.1\nmov oPos, v0\nmov oT0, v7\nmov oT1, v7\n"
ps_text = """
ps.1.4
texcrd r0.rgb, t0
texcrd r1.rgb, t1
mul r2.rgb, r0, r1
mad r3.rgb, r2, c0, r1
lrp r4.rgb, c0, r3, r0
add r5.rgb, r4, r2
dp3 r1.rgb, r5, r3
mul r2.rgb, r1, r4
phase
mad r0.rgb, r2, c1, r5
sub r1.rgb, r0, r2
lrp r3.rgb, c1, r1, r0
mul r4.rgb, r3, c0
add r5.rgb, r4, r1
mad r2.rgb, r5, r4, r3
mul r0.rgb, r2, r5
+mov r0.a, c0.a
"""
ps_constants = { c0 = [0.5, 0.25, 0.75, 1], c1 = [0.3, 0.6, 0.9, 1] }
"#;

fn load(text: &[u8], files: &dyn Resolver) -> Scene {
    let loaded = Scene::load("scene.toml", text, files, &LoadOptions::default());
    loaded.unwrap_or_else(|error| panic!("{error}"))
}

fn stained_glass() -> Scene {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("asm/stained_glass");
    let text = std::fs::read(folder.join("scene.toml")).expect("the scene is there");
    load(&text, &DirectoryResolver::new(&folder))
}

fn arithmetic() -> Scene {
    let files: BTreeMap<String, Vec<u8>> = BTreeMap::new();
    load(ARITHMETIC.as_bytes(), &files)
}

/// One tile for each instruction of the last draw.
fn tiles(scene: &Scene) -> Vec<Tile> {
    let pass = scene.passes(SIZE).pop().expect("the picture");
    let draw = pass.draws.last().expect("a draw");
    let all: ShowExpression = "all".parse().expect("it is a word");
    (all.tiles(scene, draw, Look::default(), false)).expect("the shader has instructions")
}

fn sheet(scene: &Scene, tiles: &[Tile]) -> RgbaImage {
    let options = RenderOptions {
        size: Some(SIZE),
        show: Some(Show {
            draw: None,
            pictures: tiles.iter().map(|tile| tile.picture).collect(),
        }),
    };
    let dressing = Dressing {
        captions: true,
        bars: true,
        columns: None,
    };
    let drawn = scene.rendering(&options, &|_| ()).expect("it is drawn");
    drawn.sheet(tiles, dressing).expect("it is not too large")
}

fn frame(scene: &Scene) -> RgbaImage {
    let options = RenderOptions {
        size: Some(SIZE),
        show: None,
    };
    (scene.render(&options, &|_| ()).expect("it is drawn")).to_image()
}

fn png(picture: &RgbaImage, compression: CompressionType) -> Vec<u8> {
    let mut png = Vec::new();
    let encoder = PngEncoder::new_with_quality(&mut png, compression, FilterType::Adaptive);
    (picture.write_with_encoder(encoder)).expect("memory takes it");
    png
}

fn measured(c: &mut Criterion, name: &str, scene: &Scene) {
    let tiles = tiles(scene);
    let (one, all) = (frame(scene), sheet(scene, &tiles));
    let [width, height] = [all.width(), all.height()];
    println!("{name}: {} tiles, a sheet of {width}x{height}", tiles.len());
    let mut group = c.benchmark_group(name);
    (group.sample_size(10)).measurement_time(Duration::from_secs(8));
    group.bench_function("frame", |b| b.iter(|| black_box(frame(scene))));
    group.bench_function("sheet", |b| b.iter(|| black_box(sheet(scene, &tiles))));
    group.bench_function("frame as PNG", |b| {
        b.iter(|| black_box(png(&one, CompressionType::Default)));
    });
    group.bench_function("sheet as PNG", |b| {
        b.iter(|| black_box(png(&all, CompressionType::Fast)));
    });
    group.finish();
}

fn pictures(c: &mut Criterion) {
    measured(c, "stained glass", &stained_glass());
    measured(c, "arithmetic", &arithmetic());
}

criterion_group!(benches, pictures);
criterion_main!(benches);

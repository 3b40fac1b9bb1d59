//! One frame of the stained glass against a contact sheet of its whole shader, in pictures of 640×480.
//!
//! `cargo bench --no-default-features --features scene,parallel --bench pictures`; BENCHMARKS.md says what came out. Both
//! include everything between a loaded scene and a PNG in memory: the cube map of the room, the picture, and encoding it as
//! `texcrd run` does.
#![allow(
    clippy::expect_used,
    missing_docs,
    reason = "a benchmark that cannot go on has failed, and criterion's macro makes a function"
)]

use std::hint::black_box;
use std::path::Path;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use image::RgbaImage;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use texcrd::raster::Look;
use texcrd::scene::{DirectoryResolver, LoadOptions, RenderOptions, Scene, Show, ShowExpression};
use texcrd::sheet::{Dressing, Tile};

const SIZE: [u32; 2] = [640, 480];

fn scene() -> Scene {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("asm/stained_glass");
    let text = std::fs::read(folder.join("scene.toml")).expect("the scene is there");
    let files = DirectoryResolver::new(&folder);
    let loaded = Scene::load("scene.toml", &text, &files, &LoadOptions::default());
    loaded.expect("nothing is wrong with it")
}

/// One tile for each instruction of the pane's pixel shader.
fn tiles(scene: &Scene) -> Vec<Tile> {
    let pass = scene.passes(SIZE).pop().expect("the picture");
    let draw = pass.draws.last().expect("the pane");
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

fn pictures(c: &mut Criterion) {
    let scene = scene();
    let tiles = tiles(&scene);
    let (one, all) = (frame(&scene), sheet(&scene, &tiles));
    let [width, height] = [all.width(), all.height()];
    println!("{} tiles, a sheet of {width}x{height}", tiles.len());
    let mut group = c.benchmark_group("640x480");
    group
        .sample_size(20)
        .measurement_time(Duration::from_secs(10));
    group.bench_function("frame", |b| b.iter(|| black_box(frame(&scene))));
    group.bench_function("sheet", |b| b.iter(|| black_box(sheet(&scene, &tiles))));
    group.bench_function("frame as PNG", |b| {
        b.iter(|| black_box(png(&one, CompressionType::Default)));
    });
    group.bench_function("sheet as PNG", |b| {
        b.iter(|| black_box(png(&all, CompressionType::Fast)));
    });
    group.finish();
}

criterion_group!(benches, pictures);
criterion_main!(benches);

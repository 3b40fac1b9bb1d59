//! What a debugger does while one waits: finding and recording a pixel, stepping, `why`.
//!
//! `cargo bench --no-default-features --features scene,parallel --bench debug`; BENCHMARKS.md says what came out. The pixel is one of the stained-glass scene at 1280×960, where
//! two draws meet. `another pixel` is what moving the mark costs: history, recording and a session.
#![allow(
    clippy::expect_used,
    reason = "a benchmark that cannot go on has failed"
)]

use std::hint::black_box;
use std::path::Path;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use texcrd::debug::{Direction, PixelSubject, Session, Stops, Subject, Target, Until, Which, why};
use texcrd::isa::WriteMask;
use texcrd::kernel::Slot;
use texcrd::scene::{DirectoryResolver, LoadOptions, RenderOptions, Scene};

const PIXEL: [u32; 2] = [640, 480];

fn debugging(criterion: &mut Criterion) {
    let path = Path::new("asm/stained_glass/scene.toml");
    let bytes = std::fs::read(path).expect("the scene of the first article");
    let files = DirectoryResolver::new("asm/stained_glass");
    let scene =
        Scene::load("scene.toml", &bytes, &files, &LoadOptions::default()).expect("a scene");
    let options = RenderOptions {
        size: Some([1280, 960]),
        show: None,
    };
    let rendering = scene.rendering(&options, &|_| {}).expect("a picture");
    let subject =
        || PixelSubject::new(&rendering, PIXEL, &Which::default()).expect("a drawn pixel");
    let mut group = criterion.benchmark_group("debug");
    group
        .sample_size(20)
        .measurement_time(Duration::from_secs(3));
    group.bench_function("another pixel", |bencher| {
        bencher.iter(|| black_box(Session::new(Subject::Pixel(subject()))));
    });
    let subject = Subject::Pixel(subject());
    group.bench_function("record", |bencher| {
        bencher.iter(|| black_box(subject.record(&[])))
    });
    let mut session = Session::new(subject.clone());
    let moments: usize = session.runs().iter().map(|run| run.moments.len()).sum();
    println!("{moments} moments in {} runs", session.runs().len());
    let stops = Stops::default();
    group.bench_function("all the way back and forth", |bencher| {
        bencher.iter(|| {
            session.travel(Direction::Backward, &stops, &Until::End);
            session.travel(Direction::Forward, &stops, &Until::End)
        });
    });
    let run = session.runs().last().expect("the run of the pixel");
    group.bench_function("why", |bencher| {
        bencher.iter(|| {
            why(
                black_box(run),
                usize::MAX,
                Target::Slot(Slot::R0),
                WriteMask::X,
            )
        });
    });
    group.finish();
}

criterion_group!(benches, debugging);
criterion_main!(benches);

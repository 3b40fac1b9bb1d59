//! What a debugger does while one waits: finding and recording a pixel, stepping, `why`.
//!
//! `cargo bench --no-default-features --features scene,parallel --bench debug`; BENCHMARKS.md says what came out. The pixel is one of
//! the stained-glass scene at 1280×960, where two draws meet. `another pixel` is what moving the mark costs: history, recording and
//! a session. `steps` records the listings of the scene with values set by hand; the elements are steps of a quad.
#![allow(
    clippy::expect_used,
    reason = "a benchmark that cannot go on has failed"
)]

mod shared;

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use texcrd::debug::{
    Direction, Event, Given, Listing, ListingSubject, PixelSubject, Run, Session, Stops, Subject,
    Target, Until, Which, why,
};
use texcrd::diagnostic::SourceMap;
use texcrd::isa::WriteMask;
use texcrd::kernel::{Options, Slot, lower};
use texcrd::scene::RenderOptions;
use texcrd::syntax;

const PIXEL: [u32; 2] = [640, 480];
const VERTEX: &str = include_str!("../asm/stained_glass/stained_glass.vsh");
const PIXEL_SHADER: &str = include_str!("../asm/stained_glass/stained_glass.psh");

fn debugging(criterion: &mut Criterion) {
    let scene = shared::scene("asm/stained_glass/scene.toml");
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
    group.throughput(Throughput::Elements(steps(&subject.record(&[]))));
    group.bench_function("record", |bencher| {
        bencher.iter(|| black_box(subject.record(&[])))
    });
    let mut session = Session::new(subject.clone());
    group.throughput(Throughput::Elements(1));
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

/// How many steps of kernels were recorded.
fn steps(runs: &[Run<'_>]) -> u64 {
    let moments = runs.iter().flat_map(|run| &run.moments);
    let steps = moments.filter(|moment| matches!(moment.event, Event::Step { .. }));
    steps.count() as u64
}

fn recording(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("steps");
    for (name, text) in [
        ("stained_glass.vsh", VERTEX),
        ("stained_glass.psh", PIXEL_SHADER),
    ] {
        let mut sources = SourceMap::new();
        let parsed = syntax::parse(sources.add(name, text).expect("it is short"));
        let program = parsed.program.expect("it is a listing");
        let kernel = lower(&program, &Options::default()).expect("it has a meaning");
        let subject = Subject::Listing(ListingSubject {
            listing: Listing {
                program: &program,
                kernel: &kernel,
                sources: &sources,
            },
            given: Given::default(),
        });
        group.throughput(Throughput::Elements(steps(&subject.record(&[]))));
        group.bench_function(name, |bencher| {
            bencher.iter(|| black_box(subject.record(&[])));
        });
    }
    group.finish();
}

criterion_group!(benches, debugging, recording);
criterion_main!(benches);

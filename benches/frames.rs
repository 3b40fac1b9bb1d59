//! What a frame is made of: lowering, plans, batches of every operation, triangles, whole frames.
//!
//! `cargo bench --no-default-features --features scene,parallel --bench frames`; BENCHMARKS.md says what came out. *batch* runs a
//! listing of sixteen times the same instruction on 64 lanes that hold zeros; *frame* begins with everything prepared, as
//! `texcrd bench` does.
#![allow(
    clippy::expect_used,
    missing_docs,
    reason = "a benchmark that cannot go on has failed, and criterion's macro makes a function"
)]

use std::hint::black_box;
use std::path::Path;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use texcrd::diagnostic::SourceMap;
use texcrd::exec::{Batch, Environment, bind_constants};
use texcrd::kernel::{Kernel, Options, Plan, lower};
use texcrd::scene::{DirectoryResolver, LoadOptions, Scene};
use texcrd::simd::Simd;
use texcrd::syntax;

const STAINED_GLASS: &str = include_str!("../asm/stained_glass/stained_glass.psh");

fn kernel(listing: &str) -> Kernel {
    let mut sources = SourceMap::new();
    let parsed = syntax::parse(sources.add("bench", listing).expect("it is short"));
    let program = parsed.program.expect("it is a listing");
    lower(&program, &Options::default()).expect("it has a meaning")
}

/// Sixteen of an instruction, each of which reads what the one before it left.
fn sixteen(instruction: &str) -> String {
    let body = format!("{instruction}\n").repeat(16);
    format!("vs.1.1\nmov r0, v0\nmov r1, v1\n{body}mov oPos, r0\n")
}

fn plans(c: &mut Criterion) {
    let kernel = kernel(STAINED_GLASS);
    c.bench_function("plan/stained glass", |b| {
        b.iter(|| Plan::new(black_box(&kernel)));
    });
}

fn batches(c: &mut Criterion) {
    let mut group = c.benchmark_group("batch");
    group.throughput(Throughput::Elements(16 * 64));
    for instruction in [
        "add r0, r0, v1",
        "mul r0, r0, v1",
        "mad r0, r0, v1, v2",
        "dp3 r0, r0, v1",
        "dp4 r0, r0, v1",
        "min r0, r0, v1",
        "slt r0, r0, v1",
        "rcp r0.x, r0.x",
        "rsq r0.x, r0.x",
        "expp r0, r0.x",
        "logp r0, r0.x",
        "lit r0, r0",
    ] {
        let kernel = kernel(&sixteen(instruction));
        let plan = Plan::new(&kernel);
        let environment = Environment {
            constants: bind_constants(&kernel, &[]),
            ..Environment::default()
        };
        let mut batch = Batch::<64>::default();
        batch.load(&plan, &environment);
        let simd = Simd::chosen();
        let name = instruction.split(' ').next().unwrap_or_default();
        group.bench_function(BenchmarkId::from_parameter(name), |b| {
            b.iter(|| batch.run(simd, black_box(&plan), &environment, 64));
        });
    }
    group.finish();
}

fn scene(path: &str) -> Scene {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let path = folder.join(path);
    let bytes = std::fs::read(&path).expect("the scene is there");
    let resolver = DirectoryResolver::new(path.parent().unwrap_or(folder));
    Scene::load("scene", &bytes, &resolver, &LoadOptions::default()).expect("the scene is sound")
}

fn frames(c: &mut Criterion) {
    let mut group = c.benchmark_group("frame");
    group.sample_size(10);
    for (name, path) in [
        ("stained glass", "asm/stained_glass/scene.toml"),
        ("arithmetic", "benches/scenes/arithmetic.toml"),
    ] {
        let scene = scene(path);
        for side in [256_u32, 1024] {
            let mut frame = scene.prepare_frame([side; 2]).expect("it can be drawn");
            group.throughput(Throughput::Elements(u64::from(side) * u64::from(side)));
            group.bench_function(BenchmarkId::new(name, side), |b| {
                b.iter(|| frame.draw().expect("it can be drawn"));
            });
        }
    }
    let triangles = scene("benches/scenes/triangles.toml");
    let mut frame = (triangles.prepare_frame(triangles.size())).expect("it can be drawn");
    group.throughput(Throughput::Elements(100_000));
    group.bench_function("triangles/100000", |b| {
        b.iter(|| frame.draw().expect("it can be drawn"));
    });
    group.finish();
}

criterion_group!(benches, plans, batches, frames);
criterion_main!(benches);

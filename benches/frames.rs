//! What a frame is made of: lowering, plans, batches of every operation, a step by itself, triangles, whole frames.
//!
//! `cargo bench --no-default-features --features scene,parallel --bench frames`; BENCHMARKS.md says what came out. *batch* runs a
//! listing of sixteen times the same instruction on 64 lanes that hold zeros, *step* on the four of the interpreter that a debugger
//! watches, with nobody watching; *triangle* draws many of one kind in one colour, each shaded as it comes; *frame* begins with everything prepared, as
//! `texcrd bench` does.
#![allow(
    clippy::expect_used,
    missing_docs,
    reason = "a benchmark that cannot go on has failed, and criterion's macro makes a function"
)]

mod shared;

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use texcrd::diagnostic::SourceMap;
use texcrd::exec::{Batch, Environment, Machine, bind_constants};
use texcrd::kernel::{Kernel, Options, Plan, lower};
use texcrd::raster::{
    ColorFormat, CullMode, DrawCall, PixelBatch, PixelInputs, PixelResult, PixelShader,
    RenderState, Target, Topology, Vertex, Vertices, draw,
};
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

const INSTRUCTIONS: [&str; 12] = [
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
];

fn batches(c: &mut Criterion) {
    let mut group = c.benchmark_group("batch");
    group.throughput(Throughput::Elements(16 * 64));
    for instruction in INSTRUCTIONS {
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

fn steps(c: &mut Criterion) {
    let mut group = c.benchmark_group("step");
    for instruction in INSTRUCTIONS {
        let kernel = kernel(&sixteen(instruction));
        let environment = Environment {
            constants: bind_constants(&kernel, &[]),
            ..Environment::default()
        };
        let mut machine = Machine::<4>::new();
        group.throughput(Throughput::Elements(kernel.steps.len() as u64));
        let name = instruction.split(' ').next().unwrap_or_default();
        group.bench_function(BenchmarkId::from_parameter(name), |b| {
            b.iter(|| machine.run(black_box(&kernel), &environment));
        });
    }
    group.finish();
}

/// White, whatever the inputs are.
struct White;

impl PixelShader for White {
    fn inputs(&self) -> PixelInputs {
        PixelInputs::NONE
    }

    fn shade(&self, _: &PixelBatch, out: &mut PixelResult) {
        out.color = [[1.0; texcrd::raster::LANES]; 4];
    }

    fn may_kill(&self) -> bool {
        false
    }
}

/// The side of the target of the triangles.
const SIDE: u32 = 512;

/// Triangles with legs of so many pixels in rows over the target. `behind`: how many of the corners of each are in front of the nearest plane.
fn grid(count: usize, leg: f32, behind: usize) -> Vertices {
    let clip = |pixels: f32| 2.0 * pixels / SIDE as f32 - 1.0;
    let across = (SIDE as f32 / leg) as usize;
    let corners = |number: usize| {
        let x = (number % across) as f32 * leg + 0.25;
        let y = (number / across % across) as f32 * leg + 0.25;
        let places = [[x, y], [x + leg, y], [x, y + leg]];
        std::array::from_fn::<_, 3, _>(|corner| {
            let [x, y] = places[corner].map(clip);
            let z = if corner < behind { -0.5 } else { 0.5 };
            Vertex {
                position: [x, -y, z, 1.0].into(),
                ..Vertex::default()
            }
        })
    };
    let corners: Vec<Vertex> = (0..count).flat_map(corners).collect();
    Vertices::from(&corners[..])
}

fn triangles(c: &mut Criterion) {
    let mut group = c.benchmark_group("triangle");
    let state = RenderState {
        cull: CullMode::None,
        ..RenderState::default()
    };
    for (name, vertices) in [
        ("small, 8 pixels", grid(10_000, 4.0, 0)),
        ("middling, 512 pixels", grid(200, 32.0, 0)),
        ("large, half of 512×512", grid(1, 511.0, 0)),
        ("small, one corner clipped", grid(10_000, 4.0, 1)),
        ("small, two corners clipped", grid(10_000, 4.0, 2)),
        ("small, out of sight", grid(10_000, 4.0, 3)),
    ] {
        let mut target = Target::new(SIDE, SIDE, ColorFormat::A8R8G8B8).expect("it is not large");
        let call = DrawCall {
            viewport: state.viewport.on([SIDE; 2]),
            state: &state,
            topology: Topology::TriangleList,
            vertices: &vertices,
            indices: None,
        };
        group.throughput(Throughput::Elements(vertices.len() as u64 / 3));
        group.bench_function(name, |b| {
            b.iter(|| draw(&mut target, black_box(&call), &White).expect("it can be drawn"));
        });
    }
    group.finish();
}

fn frames(c: &mut Criterion) {
    let mut group = c.benchmark_group("frame");
    group.sample_size(10);
    for (name, path) in [
        ("stained glass", "asm/stained_glass/scene.toml"),
        ("arithmetic", "benches/scenes/arithmetic.toml"),
    ] {
        let scene = shared::scene(path);
        for side in [256_u32, 1024] {
            let mut frame = scene.prepare_frame([side; 2]).expect("it can be drawn");
            group.throughput(Throughput::Elements(u64::from(side) * u64::from(side)));
            group.bench_function(BenchmarkId::new(name, side), |b| {
                b.iter(|| frame.draw().expect("it can be drawn"));
            });
        }
    }
    let triangles = shared::scene("benches/scenes/triangles.toml");
    let mut frame = (triangles.prepare_frame(triangles.size())).expect("it can be drawn");
    group.throughput(Throughput::Elements(100_000));
    group.bench_function("triangles/100000", |b| {
        b.iter(|| frame.draw().expect("it can be drawn"));
    });
    group.finish();
}

criterion_group!(benches, plans, batches, steps, triangles, frames);
criterion_main!(benches);

//! The front end: from a text to tokens and back.
//!
//! `cargo bench --no-default-features --bench front`; BENCHMARKS.md says what came out. `text to tokens` is the whole way
//! of a listing: it is added to the sources, preprocessed where it has directives, parsed, judged and encoded.
#![allow(
    clippy::expect_used,
    reason = "a benchmark that cannot go on has failed"
)]

use std::fmt::Write;
use std::hint::black_box;

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use texcrd::diagnostic::{SourceFile, SourceMap};
use texcrd::listing::{self, Options};
use texcrd::policy::Dialect;
use texcrd::program::Program;
use texcrd::{bytecode, extract, preprocess, syntax, validate};

/// Two phases: a normal map, and a map of specular powers read through what the first phase computed.
const PIXEL: &str = include_str!("bumped.psh");

/// A matrix out of a palette of bones, a light, fog.
const VERTEX: &str = "\
vs.1.1
; Skinning with one bone a vertex, one lamp, fog by depth.
;   c0-c3   world * view * projection        c4  light direction
;   c5      diffuse colour                   c6  fog: end, 1/(end - start)
;   c20...  bones, three rows each
def c7, 0, 1, 3, 0.5
mul r0.x, v1.x, c7.z         // three rows a bone
mov a0.x, r0.x
dp4 r1.x, v0, c[a0.x + 20]   // position in the world
dp4 r1.y, v0, c[a0.x + 21]
dp4 r1.z, v0, c[a0.x + 22]
mov r1.w, c7.y
m4x4 oPos, r1, c0            // to clip space
dp3 r2.x, v3, c[a0.x + 20]   // normal in the world
dp3 r2.y, v3, c[a0.x + 21]
dp3 r2.z, v3, c[a0.x + 22]
dp3 r2.w, r2, r2
rsq r2.w, r2.w
mul r2.xyz, r2, r2.w
dp3 r3.x, r2, -c4            // N.L
max r3.x, r3.x, c7.x
mul oD0.xyz, r3.x, c5
mov oD0.w, c7.y
sub r4.x, c6.x, r1.z
mul oFog.x, r4.x, c6.y
mov oT0.xy, v7
";

/// The listing of [`VERTEX`] with names for its registers, as many tools were told to read it.
const NAMED: &str = "\
#define ZERO   c7.x
#define ONE    c7.y
#define LIGHT  c4
#define ROW(n) c[a0.x + 20 + n]
vs.1.1
def c7, 0, 1, 3, 0.5
mul r0.x, v1.x, c7.z
mov a0.x, r0.x
dp4 r1.x, v0, ROW(0)
dp4 r1.y, v0, ROW(1)
dp4 r1.z, v0, ROW(2)
mov r1.w, ONE
m4x4 oPos, r1, c0
dp3 r2.x, v3, ROW(0)
dp3 r2.y, v3, ROW(1)
dp3 r2.z, v3, ROW(2)
dp3 r2.w, r2, r2
rsq r2.w, r2.w
mul r2.xyz, r2, r2.w
dp3 r3.x, r2, -LIGHT
max r3.x, r3.x, ZERO
mul oD0.xyz, r3.x, c5
mov oD0.w, ONE
sub r4.x, c6.x, r1.z
mul oFog.x, r4.x, c6.y
mov oT0.xy, v7
";

fn tokens(text: &str) -> Vec<u32> {
    let mut sources = SourceMap::new();
    let file = sources.add("shader", text).expect("a short text").span();
    let checked = listing::read(&mut sources, file, &Options::default());
    let program = (checked.accepted()).unwrap_or_else(|| panic!("{:?}", checked.diagnostics));
    bytecode::encode(program).expect("it was accepted")
}

fn program(text: &str) -> (SourceMap, Program) {
    let mut sources = SourceMap::new();
    let file = sources.add("shader", text).expect("a short text").span();
    let checked = listing::read(&mut sources, file, &Options::default());
    let program = checked.accepted().expect("it is valid").clone();
    (sources, program)
}

/// Listings of 20 instructions, step by step and all the way.
fn short(c: &mut Criterion) {
    for (name, text) in [("ps.1.4", PIXEL), ("vs.1.1", VERTEX)] {
        let (sources, program) = program(text);
        let file = sources.files().first().expect("it was added");
        let mut group = c.benchmark_group(format!("{name}, 20 instructions"));
        group.bench_function("parse", |b| b.iter(|| syntax::parse(black_box(file))));
        group.bench_function("validate", |b| {
            b.iter(|| validate::validate(black_box(&program), Dialect::D3d8));
        });
        group.bench_function("encode", |b| {
            b.iter(|| bytecode::encode(black_box(&program)))
        });
        group.bench_function("text to tokens", |b| b.iter(|| tokens(black_box(text))));
        group.bench_function("layout", |b| {
            b.iter(|| syntax::format(black_box(text).as_bytes()));
        });
        let words = bytecode::encode(&program).expect("it is valid");
        group.bench_function("tokens to listing", |b| {
            b.iter(|| {
                let decoded = bytecode::decode(black_box(&words));
                syntax::print(&decoded.program.expect("it has a version"))
            });
        });
        group.finish();
    }
    let mut group = c.benchmark_group("vs.1.1, 20 instructions with macros");
    group.bench_function("text to tokens", |b| b.iter(|| tokens(black_box(NAMED))));
    group.finish();
}

/// Checks every shader of a file; gives how many there are.
fn check(name: &str, bytes: Vec<u8>) -> usize {
    let mut sources = SourceMap::new();
    let options = Options::default();
    let file = extract::open(&mut sources, name, bytes, &preprocess::Options::default());
    let file = file.expect("it is short enough");
    for shader in &file.shaders {
        let checked = extract::check(&mut sources, shader, &options).expect("it is short enough");
        black_box(checked);
    }
    file.shaders.len()
}

/// A listing behind a mebibyte of comments.
fn commented() -> String {
    let line = "; what every line of this long comment says is that it is one, and no more\n";
    line.repeat((1 << 20) / line.len()) + PIXEL
}

/// As [`commented`], in one comment with stars.
fn starred() -> String {
    let line = " * what every line of this long comment says is that it is one, and no more\n";
    format!("/*\n{} */\n{PIXEL}", line.repeat((1 << 20) / line.len()))
}

/// A source of C with a hundred listings in strings.
fn source() -> String {
    let mut text = String::new();
    for i in 0..100 {
        // Writing into a string does not fail.
        let _ = writeln!(text, "static const char shader{i}[] =");
        for line in if i % 2 == 0 { PIXEL } else { VERTEX }.lines() {
            let _ = writeln!(text, "    \"{line}\\n\"");
        }
        text.push_str("    ;\n\n");
    }
    text
}

/// An effect of about 500 lines: macros, techniques with passes, twenty listings.
fn effect() -> String {
    let mut text = String::from("#define ONE c7.y\n#define LIGHT c4\n\n");
    for i in 0..10 {
        let vertex = VERTEX.replace("-c4", "-LIGHT").replace("c7.y", "ONE");
        let _ = write!(
            text,
            "technique T{i}\n{{\n    pass P0\n    {{\n        VertexShader = asm\n        {{\n{vertex}        }};\n        PixelShader = asm\n        {{\n{PIXEL}        }};\n    }}\n}}\n\n",
        );
    }
    text
}

/// The same many instructions that no shader can hold: read and judged to the end.
fn instructions() -> String {
    let line = "mad r0.xyz, r1, c[a0.x + 12], -v3.zyxw ; on and on\n";
    let head = "vs.1.1\nmov a0.x, v0.x\nmov r1, v1\nmov oPos, r1\n";
    head.to_string() + &line.repeat((1 << 20) / line.len())
}

/// Long texts, by byte.
fn long(c: &mut Criterion) {
    for (name, text, shaders) in [
        ("1 MiB of comments", commented(), 1),
        ("1 MiB in one comment", starred(), 1),
        ("1 MiB of instructions", instructions(), 1),
        ("source of C with 100 shaders", source(), 100),
        ("effect with 20 shaders", effect(), 20),
    ] {
        assert_eq!(check(name, text.clone().into_bytes()), shaders, "{name}");
        let mut group = c.benchmark_group(name);
        group.throughput(Throughput::Bytes(text.len() as u64));
        group.bench_function("check", |b| {
            b.iter_batched(
                || text.clone().into_bytes(),
                |bytes| check(name, bytes),
                BatchSize::LargeInput,
            );
        });
        group.bench_function("layout", |b| {
            b.iter(|| extract::format(black_box(text.as_bytes())));
        });
        group.finish();
    }
}

/// A source file alone, to see what the sources cost.
fn added(c: &mut Criterion) {
    let text = commented();
    let mut group = c.benchmark_group("1 MiB of comments");
    group.throughput(Throughput::Bytes(text.len() as u64));
    group.bench_function("added to the sources", |b| {
        b.iter_batched(
            || text.clone().into_bytes(),
            |bytes| {
                let mut sources = SourceMap::new();
                sources.add("text", bytes).map(SourceFile::span)
            },
            BatchSize::LargeInput,
        );
    });
    group.finish();
}

criterion_group!(benches, short, long, added);
criterion_main!(benches);

//! From two listings to WGSL: the steps of the way and the whole of it.
//!
//! `cargo bench --no-default-features --bench translate`; BENCHMARKS.md says what came out. `translate` starts from
//! shaders that were parsed and lowered before and ends with text and reflection; `text to WGSL` is everything that is
//! needed for two texts.
#![allow(
    clippy::expect_used,
    reason = "a benchmark that cannot go on has failed"
)]

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use texcrd::diagnostic::SourceMap;
use texcrd::kernel::{self, Kernel, lower};
use texcrd::policy::Dialect;
use texcrd::program::Program;
use texcrd::texture::TextureKind;
use texcrd::wgsl::{Options, Stage, StageOptions, Translation, translate};
use texcrd::{listing, syntax, validate};

/// Two listings and what is bound to the texture stages.
struct Pair {
    name: &'static str,
    vertex: &'static str,
    pixel: &'static str,
    options: Options,
}

fn pairs() -> [Pair; 3] {
    let mut pane = Options::default();
    for stage in [2, 4] {
        pane.stages[stage] = StageOptions::with_texture(Some(TextureKind::Cube));
    }
    [
        Pair {
            name: "20 instructions",
            vertex: LIT,
            pixel: DETAILED,
            options: Options::default(),
        },
        Pair {
            name: "20 instructions each",
            vertex: TANGENT_SPACE,
            pixel: BUMPED,
            options: Options::default(),
        },
        Pair {
            name: "stained glass",
            vertex: include_str!("../asm/stained_glass/stained_glass.vsh"),
            pixel: include_str!("../asm/stained_glass/stained_glass.psh"),
            options: pane,
        },
    ]
}

/// 12 instructions: transformation, diffuse light and a rim.
const LIT: &str = "\
vs.1.1
def c8, 0, 1, 0, 0
m4x4 oPos, v0, c0            ; to clip space
mov  oT0.xy, v7              ; base texture
add  oT1.xy, v7, c9          ; detail texture, scrolled
dp3  r0.x, v3, c4            ; N.L
max  r0.x, r0.x, c8.x
mad  oD0, r0.x, c6, v5       ; diffuse light on top of what was baked
add  r1, c5, -v0             ; to the eye
dp3  r1.w, r1, r1
rsq  r1.w, r1.w
mul  r1.xyz, r1, r1.w        ; normalised
dp3  r1.x, r1, v3            ; N.V
mul  oD1, r1.x, c10          ; rim light
";

/// 8 instructions: a base and a detail texture under the light of [`LIT`].
const DETAILED: &str = "\
ps.1.1
def c1, 0.3, 0.59, 0.11, 0
tex  t0                      ; base
tex  t1                      ; detail
mul_x2 r0.rgb, t0, t1        ; base * detail * 2
+mov r0.a, t0
dp3  r1.rgb, r0, c1          ; grey
lrp  r0.rgb, c0.a, r0, r1    ; faded
mad_sat r0.rgb, r0, v0, v1   ; lit
mul  r0.a, r0.a, c0.a
";

/// 20 instructions: light and half-angle vectors in tangent space.
const TANGENT_SPACE: &str = "\
vs.1.1
def c12, 0.5, 1, 0, 0
m4x4 oPos, v0, c0            ; to clip space
mov  oT0.xy, v7              ; base texture
mov  oT1.xy, v7              ; normal map
m4x3 r0.xyz, v0, c4          ; position in the world
m3x3 r1.xyz, v3, c4          ; normal
m3x3 r2.xyz, v8, c4          ; tangent
mul  r3.xyz, r1.zxyw, r2.yzxw
mad  r3.xyz, r1.yzxw, r2.zxyw, -r3 ; binormal
add  r4.xyz, c8, -r0         ; to the lamp
dp3  r4.w, r4, r4
rsq  r4.w, r4.w
mul  r4.xyz, r4, r4.w        ; L
dp3  r5.x, r2, r4
dp3  r5.y, r3, r4
dp3  r5.z, r1, r4            ; L in tangent space
mad  oT2.xyz, r5, c12.x, c12.x ; 0 to 1
add  r6.xyz, c9, -r0         ; to the eye
dp3  r6.x, r1, r6
mul  oD0.xyz, r6.x, c10
mov  oD0.w, c12.y
";

/// 20 instructions: bump mapping in two phases, with a map of specular powers read through what the first computed.
const BUMPED: &str = include_str!("bumped.psh");

/// A listing with all that became of it.
struct Shader {
    sources: SourceMap,
    program: Program,
    kernel: Kernel,
}

impl Shader {
    fn new(name: &str, text: &str) -> Self {
        let mut sources = SourceMap::new();
        let file = sources.add(name, text).expect("a short text");
        let checked = listing::check(file, Dialect::D3d8);
        let program = (checked.accepted())
            .unwrap_or_else(|| panic!("{name}: {:?}", checked.diagnostics))
            .clone();
        let kernel = lower(&program, &kernel::Options::default()).expect("it was accepted");
        Self {
            sources,
            program,
            kernel,
        }
    }

    fn stage(&self) -> Stage<'_> {
        Stage {
            program: &self.program,
            kernel: &self.kernel,
            source: &self.sources,
        }
    }
}

fn linked(vertex: &Shader, pixel: &Shader, options: &Options) -> Translation {
    translate(Some(vertex.stage()), Some(pixel.stage()), options).expect("it was accepted")
}

fn way(c: &mut Criterion) {
    for pair in pairs() {
        let shaders = [("pair.vsh", pair.vertex), ("pair.psh", pair.pixel)]
            .map(|(name, text)| Shader::new(name, text));
        let [vertex, pixel] = &shaders;
        let files = || shaders.iter().map(|shader| &shader.sources.files()[0]);
        let mut group = c.benchmark_group(pair.name);
        group.bench_function("parse", |b| {
            b.iter(|| files().for_each(|file| drop(black_box(syntax::parse(file)))));
        });
        group.bench_function("validate", |b| {
            b.iter(|| {
                for shader in &shaders {
                    black_box(validate::validate(&shader.program, Dialect::D3d8));
                }
            });
        });
        group.bench_function("lower", |b| {
            b.iter(|| {
                for shader in &shaders {
                    black_box(lower(&shader.program, &kernel::Options::default())).ok();
                }
            });
        });
        group.bench_function("translate", |b| {
            b.iter(|| linked(vertex, pixel, black_box(&pair.options)));
        });
        group.bench_function("text to WGSL", |b| {
            b.iter(|| {
                let vertex = Shader::new("pair.vsh", black_box(pair.vertex));
                let pixel = Shader::new("pair.psh", black_box(pair.pixel));
                linked(&vertex, &pixel, &pair.options)
            });
        });
        group.finish();
    }
}

criterion_group!(benches, way);
criterion_main!(benches);

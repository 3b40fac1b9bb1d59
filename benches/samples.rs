//! A sample of each kind: 2D, cube and volume, every filter and every choice of levels, packed texels and floats.
//!
//! `cargo bench --no-default-features --features scene,parallel --bench samples`; BENCHMARKS.md says what came out. The lanes are quads
//! along the rows of a picture in which a pixel covers about one and a half texels, so that levels are blended where they can be; for the anisotropic
//! filter it is four times as tall. Times are for one pixel, on one thread.
#![allow(
    clippy::expect_used,
    missing_docs,
    reason = "a benchmark that cannot go on has failed, and criterion's macro makes a function"
)]

use std::hint::black_box;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use texcrd::raster::LANES;
use texcrd::simd::{Simd, Task};
use texcrd::texture::{Filter, Format, MipFilter, Sampler, Texture, TextureKind, sample_quads};

/// How many batches a measurement goes over.
const BATCHES: usize = 64;

type Coordinates = [[f32; LANES]; 3];

/// All batches, as what is compiled for each set of instructions.
struct Sampling<'a> {
    texture: &'a Texture,
    sampler: &'a Sampler,
    batches: &'a [Coordinates],
}

impl Task for Sampling<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let mut texels = [[0.0; LANES]; 4];
        for coordinates in self.batches {
            sample_quads(Some(self.texture), self.sampler, coordinates, &mut texels);
            black_box(&mut texels);
        }
    }
}

/// A texture of 64 Ki texels (a cube: six times 16 Ki) with all its levels.
fn texture(kind: TextureKind, format: Format) -> Texture {
    let size = match kind {
        TextureKind::Texture2D => [256, 256, 1],
        TextureKind::Cube => [128, 128, 1],
        TextureKind::Volume => [64, 64, 16],
    };
    let count = size.iter().product::<u32>() as usize * kind.face_count();
    let texel = |i: usize| [1, 3, 7, 11].map(|factor| (i * factor % 256) as f32 / 255.0);
    let level: Vec<_> = (0..count).map(texel).collect();
    let texture = Texture::from_texels(kind, format, size, &[level]);
    let mut texture = texture.expect("the sizes are right");
    texture.generate_mips().expect("they can be made");
    texture
}

/// Where the pixels of all batches look: each batch is a row of eight quads, `step` and `down` are how far neighbours to the right and below
/// are apart, in parts of the texture.
fn batches(kind: TextureKind, step: f32, down: f32) -> Vec<Coordinates> {
    let place = |batch: usize, lane: usize| {
        let x = lane / 4 * 2 + lane % 2 + batch % 8 * (LANES / 2);
        let y = lane / 2 % 2 + batch / 8 * 2;
        [0.1 + x as f32 * step, 0.1 + y as f32 * down]
    };
    let coordinate = |batch: usize, lane: usize| {
        let [u, v] = place(batch, lane);
        match kind {
            TextureKind::Texture2D => [u, v, 0.0],
            // Around the corner between two faces.
            TextureKind::Cube => [1.0 - u, 2.0 * v - 0.7, u],
            TextureKind::Volume => [u, v, 0.5 * u + 0.3 * v],
        }
    };
    let of = |batch| {
        let mut coordinates = [[0.0; LANES]; 3];
        for lane in 0..LANES {
            for (row, number) in coordinates.iter_mut().zip(coordinate(batch, lane)) {
                row[lane] = number;
            }
        }
        coordinates
    };
    (0..BATCHES).map(of).collect()
}

fn samples(c: &mut Criterion) {
    let mut ways = Vec::new();
    for (filter, name) in [(Filter::Point, "point"), (Filter::Linear, "linear")] {
        for mip in [MipFilter::None, MipFilter::Point, MipFilter::Linear] {
            let sampler = Sampler {
                mag: filter,
                min: filter,
                mip,
                ..Sampler::default()
            };
            ways.push((format!("{name}, mip {mip}"), sampler, 1.0));
        }
    }
    let anisotropic = Sampler {
        mag: Filter::Linear,
        min: Filter::Anisotropic,
        mip: MipFilter::Linear,
        max_anisotropy: 4,
        ..Sampler::default()
    };
    ways.push(("anisotropic 4, mip linear".to_string(), anisotropic, 4.0));
    for (kind, name, edge) in [
        (TextureKind::Texture2D, "2D", 256.0),
        (TextureKind::Cube, "cube", 256.0),
        (TextureKind::Volume, "volume", 64.0),
    ] {
        for (format, texels) in [(Format::Rgba8, "packed"), (Format::Rgba32F, "float")] {
            let texture = texture(kind, format);
            let mut group = c.benchmark_group(format!("{name}, {texels}"));
            group
                .sample_size(20)
                .warm_up_time(Duration::from_millis(200))
                .measurement_time(Duration::from_millis(800))
                .throughput(Throughput::Elements((BATCHES * LANES) as u64));
            for (way, sampler, taller) in &ways {
                let batches = batches(kind, 1.5 / edge, taller * 1.5 / edge);
                group.bench_function(BenchmarkId::from_parameter(way), |b| {
                    b.iter(|| {
                        Simd::chosen().run(Sampling {
                            texture: black_box(&texture),
                            sampler,
                            batches: &batches,
                        });
                    });
                });
            }
            group.finish();
        }
    }
}

criterion_group!(benches, samples);
criterion_main!(benches);

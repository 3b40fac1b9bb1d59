//! What interpreting costs: the pixel shader of the stained glass as the plan of its kernel runs it, and written by hand, over the
//! same sampler and the pixels of the scene at 1920×1080.
//!
//! `cargo bench --no-default-features --features scene,parallel --bench fused`; BENCHMARKS.md says what came out. Both sides take the
//! batches of the rasterizer, are compiled for the same instructions, take turns on one thread, and must give the same bits.
//! Only full batches are taken, so that neither need leave out pixels.
#![allow(
    clippy::expect_used,
    reason = "a benchmark that cannot go on has failed"
)]

mod shared;

use std::hint::black_box;
use std::sync::Mutex;
use std::time::{Duration, Instant};

use texcrd::exec::{Environment, Stage};
use texcrd::isa::SourceModifier::{Bx2, X2};
use texcrd::raster::{
    Attribute, BatchProgram, ColorFormat, LANES, PixelBatch, PixelInputs, PixelProgram,
    PixelResult, PixelShader, Target, draw,
};
use texcrd::scene::{Output, RenderOptions, Rendering};
use texcrd::semantics::{OfFinite, Products, dp3, flush, lrp, mad, modify};
use texcrd::simd::{Simd, Task};
use texcrd::texture::{Memory, MipFilter, Places, Sample, share_places};

const SIZE: [u32; 2] = [1920, 1080];
/// So many batches are measured at a time: less than a millisecond, in which a busy machine seldom turns to something else.
const PIECE: usize = 64;

/// `asm/stained_glass/stained_glass.psh`, written by hand by somebody who knows that all its numbers are finite.
struct Fused<'a> {
    environment: &'a Environment<'a>,
    simd: Simd,
    /// Where the three textures at `t0` are read: found by the first, if all of them share it.
    shared: Places<LANES>,
    sharing: [bool; 2],
    /// Where the cube maps are read.
    alone: Places<LANES>,
    memory: Memory<LANES>,
}

impl<'a> Fused<'a> {
    fn new(environment: &'a Environment<'a>, simd: Simd) -> Self {
        let read = |stage: &'a Stage<'a>| Some((stage.texture?, &stage.sampler));
        let first = read(&environment.stages[0]);
        let sharing = [3, 5].map(|other: usize| {
            let other = read(&environment.stages[other]);
            (first.zip(other)).is_some_and(|(first, other)| share_places(first, other))
        });
        Self {
            environment,
            simd,
            shared: Places::default(),
            sharing,
            alone: Places::default(),
            memory: Memory::default(),
        }
    }

    fn shade(&mut self, pixels: &PixelBatch, out: &mut PixelResult) {
        self.simd.run(ByHand {
            shader: self,
            pixels,
            out,
        });
    }
}

/// One batch of it.
struct ByHand<'s, 'a> {
    shader: &'s mut Fused<'a>,
    pixels: &'s PixelBatch,
    out: &'s mut PixelResult,
}

const RGB: [bool; 4] = [true, true, true, false];

#[inline(always)]
fn sampled(
    simd: Simd,
    stage: &Stage<'_>,
    coords: [&[f32; LANES]; 3],
    places: &mut Places<LANES>,
    memory: &mut Memory<LANES>,
    found: bool,
    channels: [bool; 4],
) -> Attribute {
    let mut texels = [[0.0; LANES]; 4];
    let Some(texture) = stage.texture else {
        texels[3] = [1.0; LANES];
        return texels;
    };
    simd.run(Sample {
        texture,
        sampler: &stage.sampler,
        coords,
        lanes: LANES,
        places,
        memory,
        found,
        channels,
        out: &mut texels,
    });
    texels
}

impl Task for ByHand<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Fused {
            environment: Environment { constants, stages },
            simd,
            shared,
            sharing: [base_shares, gloss_shares],
            alone,
            memory,
        } = self.shader;
        let simd = *simd;
        let [at, row0, row1, row2, eye, shift, ..] = &self.pixels.texcoords;
        let index = constants.first().map_or(0.0, |c0| c0[0]);
        let at = [&at[0], &at[1], &at[2]];
        let normal = sampled(simd, &stages[0], at, shared, memory, false, RGB);
        // The normal in the world, and the refracted view from the middle of the cube map.
        let mut turned = [[0.0; LANES]; 3];
        let mut refracted = [[0.0; LANES]; 3];
        for lane in 0..LANES {
            let n: [f32; 3] = std::array::from_fn(|c| modify(Bx2, flush(normal[c][lane])));
            for (c, row) in [row0, row1, row2].into_iter().enumerate() {
                let row = std::array::from_fn(|c| flush(row[c][lane]));
                let world = flush(dp3::<OfFinite>(row, n));
                let mixed = flush(lrp::<OfFinite>(index, -flush(eye[c][lane]), -world));
                turned[c][lane] = world;
                refracted[c][lane] = flush(flush(shift[c][lane]) + mixed);
            }
        }
        let reflection = sampled(
            simd,
            &stages[2],
            refracted.each_ref(),
            alone,
            memory,
            false,
            RGB,
        );
        let diffuse = sampled(
            simd,
            &stages[4],
            turned.each_ref(),
            alone,
            memory,
            false,
            RGB,
        );
        // Those that do not share find their own places, and must not take those of `t0` away.
        let (base, gloss) = (&stages[3], &stages[5]);
        let base = match *base_shares {
            true => sampled(simd, base, at, shared, memory, true, [true; 4]),
            false => sampled(simd, base, at, alone, memory, false, [true; 4]),
        };
        let gloss = match *gloss_shares {
            true => sampled(simd, gloss, at, shared, memory, true, RGB),
            false => sampled(simd, gloss, at, alone, memory, false, RGB),
        };
        for c in 0..3 {
            for lane in 0..LANES {
                let specular = flush(OfFinite::product(
                    flush(gloss[c][lane]),
                    flush(reflection[c][lane]),
                ));
                let light = modify(X2, flush(diffuse[c][lane]));
                let color = mad::<OfFinite>(flush(base[c][lane]), light, specular);
                self.out.color[c][lane] = flush(color);
            }
        }
        self.out.color[3] = base[3].map(flush);
    }
}

/// Keeps the full batches of some tiles of the picture.
struct Keep<'a> {
    program: BatchProgram<'a>,
    kept: Mutex<Vec<PixelBatch>>,
}

/// The tile of a batch: its row and its column.
fn tile(pixels: &PixelBatch) -> [i32; 2] {
    [pixels.y[0] / 64, pixels.x[0] / 64]
}

impl PixelShader for Keep<'_> {
    fn inputs(&self) -> PixelInputs {
        self.program.inputs()
    }

    fn shade(&self, pixels: &PixelBatch, _: &mut PixelResult) {
        let [row, column] = tile(pixels);
        if pixels.quads == LANES / 4 && (column + 2 * row) % 5 == 0 {
            let mut kept = self.kept.lock().expect("nobody failed with it");
            kept.push(pixels.clone());
        }
    }

    fn may_kill(&self) -> bool {
        false
    }
}

/// The environment of a draw of the picture, its shader's inputs in drawing order within each tile, and its program.
fn pane<T>(
    rendering: &Rendering<'_>,
    then: impl FnOnce(PixelProgram<'_>, &texcrd::kernel::Plan, Vec<PixelBatch>) -> T,
) -> T {
    let pass = rendering.pass(Output::Picture).expect("there is a picture");
    let number = pass.draws.iter().position(|draw| draw.name == "pane");
    let shaded = number.and_then(|number| rendering.shaded(Output::Picture, number));
    let shaded = shaded.expect("the scene has a pane");
    let keep = Keep {
        program: shaded.shader(),
        kept: Mutex::default(),
    };
    let [width, height] = rendering.size();
    let mut target = Target::new(width, height, ColorFormat::A8R8G8B8).expect("it is not large");
    let state = &shaded.draw().state;
    let call = shaded.call(state, rendering.size());
    draw(&mut target, &call, &keep).expect("it can be drawn");
    let mut batches = keep.kept.into_inner().expect("nobody failed with it");
    // Within a tile they come in drawing order.
    batches.sort_by_key(tile);
    then(shaded.program(), &shaded.draw().pixel.plan, batches)
}

/// Shades all batches and gives the time.
fn timed(
    mut shade: impl FnMut(&PixelBatch, &mut PixelResult),
    batches: &[PixelBatch],
    out: &mut PixelResult,
) -> Duration {
    let start = Instant::now();
    for batch in batches {
        shade(black_box(batch), out);
        black_box(&mut *out);
    }
    start.elapsed()
}

fn median(times: &mut [Duration]) -> Duration {
    times.sort_unstable();
    times.get(times.len() / 2).copied().unwrap_or_default()
}

fn main() {
    // A test of all targets only asks whether it runs.
    let rounds = match std::env::args().any(|argument| argument == "--test") {
        true => 1,
        false => 31,
    };
    let scene = shared::scene("asm/stained_glass/scene.toml");
    let options = RenderOptions {
        size: Some(SIZE),
        show: None,
    };
    let rendering = scene.rendering(&options, &|_| {}).expect("a picture");
    pane(&rendering, |program, plan, batches| {
        let pixels = batches.len() * LANES;
        println!(
            "{pixels} pixels of the pane, {PIECE} batches at a time, medians of {rounds} rounds, ns a pixel, one thread"
        );
        println!("| | instructions | plan | by hand | ratio |");
        println!("| --- | --- | --- | --- | --- |");
        for (name, change) in [
            ("as in the scene", (|_| ()) as fn(&mut Stage<'_>)),
            ("without mip levels", |stage| {
                stage.sampler.mip = MipFilter::None;
            }),
            ("without textures", |stage| stage.texture = None),
        ] {
            let mut environment = program.environment.clone();
            environment.stages.iter_mut().for_each(change);
            for simd in Simd::ALL.into_iter().filter(|simd| simd.is_available()) {
                simd.limit();
                let program = PixelProgram {
                    kernel: program.kernel,
                    environment: &environment,
                };
                let interpreted = BatchProgram::new(program, plan);
                let mut fused = Fused::new(&environment, simd);
                let [mut a, mut b] = [PixelResult::new(), PixelResult::new()];
                for batch in &batches {
                    interpreted.shade(batch, &mut a);
                    fused.shade(batch, &mut b);
                    let bits = |out: &PixelResult| out.color.map(|row| row.map(f32::to_bits));
                    assert_eq!(bits(&a), bits(&b), "{name}, {simd}");
                }
                let [mut plans, mut hands] = [Vec::new(), Vec::new()];
                for pixels in batches.chunks(PIECE) {
                    let [mut of_plan, mut of_hand] = [Vec::new(), Vec::new()];
                    for round in 0..rounds {
                        let mut plan = || {
                            let shade = |pixels: &_, out: &mut _| interpreted.shade(pixels, out);
                            of_plan.push(timed(shade, pixels, &mut a));
                        };
                        let mut hand = || {
                            let shade = |pixels: &_, out: &mut _| fused.shade(pixels, out);
                            of_hand.push(timed(shade, pixels, &mut b));
                        };
                        // Whoever comes second finds the texels in the cache.
                        if round % 2 == 0 {
                            plan();
                            hand();
                        } else {
                            hand();
                            plan();
                        }
                    }
                    plans.push(median(&mut of_plan));
                    hands.push(median(&mut of_hand));
                }
                let ns = |times: &[Duration]| {
                    times.iter().sum::<Duration>().as_secs_f64() * 1e9 / pixels as f64
                };
                let (plans, hands) = (ns(&plans), ns(&hands));
                let ratio = plans / hands;
                println!("| {name} | {simd} | {plans:.1} | {hands:.1} | {ratio:.2} |");
            }
        }
    });
}

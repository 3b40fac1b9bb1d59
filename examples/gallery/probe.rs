//! What a pixel shader looks up where: it runs as in the picture, and an observer notes the coordinates of its samples.

use std::sync::Mutex;
use texcrd::exec::{Lanes, Machine, Observer};
use texcrd::kernel::{Kernel, Op};
use texcrd::raster::{
    ColorFormat, LANES, PixelBatch, PixelInputs, PixelProgram, PixelResult, PixelShader, Target,
    draw,
};
use texcrd::scene::{Output, Rendering};

/// The last look of a pixel into the texture of a stage.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Lookup {
    /// The coordinates that the sampler was given, after any division.
    pub(crate) at: [f32; 3],
    /// The alpha that was there.
    pub(crate) alpha: f32,
}

/// A pixel in which the draw is seen.
#[derive(Clone, Debug)]
pub(crate) struct Seen {
    pub(crate) pixel: [u32; 2],
    /// In the order of the stages that were asked for.
    pub(crate) lookups: Vec<Lookup>,
}

/// The pixels of the picture in which a draw is seen, with what it looks up in these stages; none if there is no such draw.
pub(crate) fn seen(rendering: &Rendering<'_>, name: &str, stages: &[u8]) -> Option<Vec<Seen>> {
    let pass = rendering.pass(Output::Picture)?;
    let number = pass.draws.iter().position(|draw| draw.name == name)?;
    let shaded = rendering.shaded(Output::Picture, number)?;
    let [width, height] = rendering.size();
    let probe = Probe {
        program: shaded.program(),
        stages,
        width,
        found: Mutex::new(vec![None; (width * height) as usize]),
    };
    let mut target = Target::new(width, height, ColorFormat::A8R8G8B8).ok()?;
    target.clear(None, Some(1.0), Some(0));
    draw(
        &mut target,
        &shaded.call(&shaded.draw().state, [width, height]),
        &probe,
    )
    .ok()?;
    let found = probe.found.into_inner().ok()?;
    let picture = rendering.picture();
    let seen = found.into_iter().enumerate().filter_map(|(at, found)| {
        let (depth, lookups) = found?;
        let pixel = [at as u32 % width, at as u32 / width];
        // What was drawn here and has the depth that the picture has here is what is seen.
        let visible = picture.depth(pixel[0], pixel[1]) == Some(depth);
        visible.then_some(Seen { pixel, lookups })
    });
    Some(seen.collect())
}

/// The nearest depth of a pixel so far, and what was looked up there.
type Found = Option<(f32, Vec<Lookup>)>;

struct Probe<'a> {
    program: PixelProgram<'a>,
    stages: &'a [u8],
    width: u32,
    found: Mutex<Vec<Found>>,
}

impl PixelShader for Probe<'_> {
    fn inputs(&self) -> PixelInputs {
        self.program.inputs()
    }

    fn shade(&self, batch: &PixelBatch, out: &mut PixelResult) {
        let mut machine = Machine::<LANES>::new();
        self.program.load(&mut machine, batch);
        let mut watch = Watch {
            kernel: self.program.kernel,
            stages: self.stages,
            lookups: vec![[Lookup::default(); LANES]; self.stages.len()],
        };
        let (kernel, environment) = (self.program.kernel, self.program.environment);
        machine.run_observed(kernel, environment, usize::MAX, &mut watch);
        out.killed = *machine.killed();
        let Ok(mut found) = self.found.lock() else {
            return;
        };
        for lane in (0..4 * batch.quads).filter(|lane| batch.live[*lane] && !out.killed[*lane]) {
            let at = batch.y[lane] as usize * self.width as usize + batch.x[lane] as usize;
            let Some(place) = found.get_mut(at) else {
                continue;
            };
            if place
                .as_ref()
                .is_none_or(|(depth, _)| batch.z[lane] < *depth)
            {
                let lookups = watch.lookups.iter().map(|lanes| lanes[lane]).collect();
                *place = Some((batch.z[lane], lookups));
            }
        }
    }
}

struct Watch<'a> {
    kernel: &'a Kernel,
    stages: &'a [u8],
    lookups: Vec<[Lookup; LANES]>,
}

impl Observer<LANES> for Watch<'_> {
    fn computed(&mut self, step: usize, sources: &[Lanes<LANES>; 3], result: &Lanes<LANES>) {
        let Some(Op::Sample(stage)) = self.kernel.steps.get(step).map(|step| step.op) else {
            return;
        };
        for (wanted, lookups) in self.stages.iter().zip(&mut self.lookups) {
            if *wanted == stage {
                for (lane, lookup) in lookups.iter_mut().enumerate() {
                    lookup.at = [0, 1, 2].map(|component| sources[0][component][lane]);
                    lookup.alpha = result[3][lane];
                }
            }
        }
    }

    fn wrote(&mut self, _: usize, _: &Lanes<LANES>, _: &Lanes<LANES>) {}

    fn killed(&mut self, _: usize, _: &[bool; LANES]) {}
}

//! A pixel shader of which registers are pictured while it runs: all pictures in one run.

use super::picture::{Mark, MarkSet, RegisterPicture};
use super::programmable::{MACHINE, PixelProgram};
use super::{Attribute, LANES, PixelBatch, PixelInputs, PixelResult, PixelShader};
use crate::exec::{Lanes, Observer};
use crate::isa::WriteMask;
use crate::kernel::Slot;
use std::sync::atomic::{AtomicU8, Ordering};

/// A pixel shader that gives pictures of registers in place of its colour: picture k goes into plane k of a target that was
/// [split](super::Target::split) into as many.
pub struct PictureProgram<'a> {
    program: PixelProgram<'a>,
    shots: Vec<Shot>,
    /// The registers that are pictured.
    slots: Vec<Slot>,
    /// For each step the pictures whose register is complete when it has written.
    complete: Vec<Vec<usize>>,
}

/// A picture with what is known of it beforehand.
struct Shot {
    picture: RegisterPicture,
    written: WriteMask,
    /// Whether its register holds from the start what is shown.
    at_start: bool,
    /// The marks that were set, as bits.
    marks: AtomicU8,
}

impl<'a> PictureProgram<'a> {
    /// The program with these pictures.
    pub fn new(program: PixelProgram<'a>, pictures: &[RegisterPicture]) -> Self {
        let kernel = program.kernel;
        let mut complete = vec![Vec::new(); kernel.steps.len()];
        let mut shots = Vec::with_capacity(pictures.len());
        for (number, picture) in pictures.iter().enumerate() {
            let last = picture.last_write(kernel);
            if let Some(pictures) = last.and_then(|step| complete.get_mut(step)) {
                pictures.push(number);
            }
            shots.push(Shot {
                picture: *picture,
                written: picture.written(kernel),
                at_start: last.is_none(),
                marks: AtomicU8::new(0),
            });
        }
        let mut slots: Vec<_> = pictures.iter().map(|picture| picture.slot).collect();
        slots.sort_unstable();
        slots.dedup();
        Self {
            program,
            shots,
            slots,
            complete,
        }
    }

    /// The marks that pixels of each picture had so far, those included that something was drawn over.
    pub fn marks(&self) -> Vec<MarkSet> {
        let marks = |shot: &Shot| MarkSet::from_bits(shot.marks.load(Ordering::Relaxed));
        self.shots.iter().map(marks).collect()
    }

    /// Paints the picture of a register that is complete.
    fn paint(&self, number: usize, register: &Lanes<LANES>, to: &mut Canvas<'_>) {
        let Some(shot) = self.shots.get(number) else {
            return;
        };
        let batch = to.batch;
        let Some(plane) = to.result.plane_mut(number) else {
            return;
        };
        let look = &shot.picture.look;
        if look
            .channels(register, shot.written, &batch.live, plane)
            .is_some()
        {
            return;
        }
        let mut marks = MarkSet::default();
        let live = batch.live.iter().take(4 * batch.quads);
        for (lane, _) in live.enumerate().filter(|(_, live)| **live) {
            let place = [batch.x[lane], batch.y[lane]].map(|at| at as u32);
            let content = register.map(|component| component[lane]);
            let (color, mark) = look.color(content, shot.written, place);
            put(plane, lane, color);
            mark.into_iter().for_each(|mark| marks.insert(mark));
        }
        shot.marks.fetch_or(marks.bits(), Ordering::Relaxed);
    }

    /// Gives discarded pixels their mark.
    fn mark_killed(&self, to: &mut Canvas<'_>) {
        let killed = to.result.killed;
        for (number, shot) in self.shots.iter().enumerate() {
            if !shot.picture.killed || !killed.contains(&true) {
                continue;
            }
            let mut marks = MarkSet::default();
            marks.insert(Mark::Killed);
            shot.marks.fetch_or(marks.bits(), Ordering::Relaxed);
            to.result.shows_killed.push(number);
            if let Some(plane) = to.result.plane_mut(number) {
                for (lane, _) in killed.iter().enumerate().filter(|(_, killed)| **killed) {
                    put(plane, lane, Mark::Killed.color());
                }
            }
        }
    }
}

/// A colour of bytes, opaque, as the merger finds it back.
fn put(plane: &mut Attribute, lane: usize, color: [u8; 3]) {
    let [r, g, b] = color.map(|byte| f32::from(byte) / 255.0);
    for (channel, value) in plane.iter_mut().zip([r, g, b, 1.0]) {
        channel[lane] = value;
    }
}

/// What is painted on, for which pixels.
struct Canvas<'b> {
    batch: &'b PixelBatch,
    result: &'b mut PixelResult,
}

/// Paints while the shader runs.
struct Painter<'p, 'b> {
    program: &'p PictureProgram<'p>,
    canvas: Canvas<'b>,
}

impl Observer<LANES> for Painter<'_, '_> {
    fn wrote(&mut self, step: usize, _: &Lanes<LANES>, after: &Lanes<LANES>) {
        for number in self.program.complete.get(step).into_iter().flatten() {
            self.program.paint(*number, after, &mut self.canvas);
        }
    }

    fn killed(&mut self, _: usize, _: &[bool; LANES]) {}
}

impl PixelShader for PictureProgram<'_> {
    fn inputs(&self) -> PixelInputs {
        self.program.inputs_with(&self.slots)
    }

    fn shade(&self, batch: &PixelBatch, out: &mut PixelResult) {
        out.planes(self.shots.len());
        out.shows_killed.clear();
        MACHINE.with_borrow_mut(|machine| {
            for slot in &self.slots {
                // A register that the shader never touches is zero, not what the last batch left in it.
                machine.load(*slot, [0.0; 4]);
            }
            self.program.load_with(machine, batch, &self.slots);
            let canvas = Canvas { batch, result: out };
            let mut painter = Painter {
                program: self,
                canvas,
            };
            for (number, shot) in self.shots.iter().enumerate().filter(|(_, s)| s.at_start) {
                let register = machine.register(shot.picture.slot);
                self.paint(number, register, &mut painter.canvas);
            }
            self.program.run(machine, &mut painter);
            PixelProgram::finish(machine, painter.canvas.result);
            self.mark_killed(&mut painter.canvas);
        });
    }

    fn writes_depth(&self) -> bool {
        self.program.writes_depth()
    }

    fn may_kill(&self) -> bool {
        self.program.may_kill()
    }
}

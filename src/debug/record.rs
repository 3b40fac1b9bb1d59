//! How an invocation is recorded.

use super::moment::{Change, Event, Flags, InputSource, Moment, Quad, Read, Sample, Target};
use super::run::{Listing, Registers, Run, RunKind};
use crate::exec::{Environment, Lanes, Machine, Observer};
use crate::isa::{Opcode, ResultModifier, WriteMask};
use crate::kernel::{Op, Operand, Place, Slot, Step};
use crate::semantics::{self, Finish};
use crate::texture::{Detail, details};
use std::ops::Range;
use std::rc::Rc;

/// A shader with everything that it runs with.
#[derive(Clone, Debug)]
pub struct Invocation<'a> {
    /// Which one it is.
    pub kind: RunKind,
    /// The shader.
    pub listing: Listing<'a>,
    /// Its constants, textures and stage states.
    pub environment: Environment<'a>,
    /// The pixel of the quad that is looked at, 0 to 3.
    pub lane: usize,
    /// Which pixels of the quad are helpers.
    pub helpers: [bool; 4],
    /// The inputs, in the order in which they are told.
    pub inputs: Vec<Input>,
}

/// An input of an invocation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Input {
    /// The register.
    pub slot: Slot,
    /// Where the value comes from.
    pub source: InputSource,
    /// The value as it comes.
    pub raw: Quad,
    /// The value as the shader reads it: a colour in a pixel shader is clamped to 0…1.
    pub value: Quad,
}

/// A value that a person sets in the middle of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edit {
    /// The run, by its number in the session.
    pub run: usize,
    /// After how many moments, those that only set values not counted. A place within the rows of a macro or the halves of a pair,
    /// which read before any of them writes, is moved to their end.
    pub after: usize,
    /// What is set.
    pub target: Target,
    /// Which components.
    pub mask: WriteMask,
    /// The values, for each pixel of the quad; a constant takes those of the first.
    pub value: Quad,
}

/// Runs a shader for a quad and records every moment. `edits`, of this run alone, are laid in where they belong, in their order.
pub fn record<'a>(invocation: Invocation<'a>, edits: &[Edit]) -> Run<'a> {
    let Invocation {
        kind,
        listing,
        environment,
        lane,
        helpers,
        inputs,
    } = invocation;
    let kernel = listing.kernel;
    let mut machine = Machine::<4>::new();
    machine.prepare(kernel);
    let mut initial = Registers::new(environment.constants.clone());
    for slot in Slot::all() {
        initial.load(slot, by_pixel(machine.register(slot)));
    }
    let mut recorder = Recorder {
        listing,
        environment: Rc::new(environment.clone()),
        registers: initial.clone(),
        moments: Vec::with_capacity(inputs.len() + kernel.steps.len()),
        computed: Vec::new(),
    };
    let mut edits = Edits {
        left: edits,
        done: 0,
    };
    for input in &inputs {
        edits.lay_in(&mut recorder, &mut machine);
        *machine.register_mut(input.slot) = by_component(&input.value);
        recorder.input(input);
        edits.done += 1;
    }
    let mut next = 0;
    for group in groups(&kernel.steps) {
        let origin = kernel.steps[group.start].origin;
        for instruction in next..origin {
            edits.lay_in(&mut recorder, &mut machine);
            recorder.nothing(instruction);
            edits.done += 1;
        }
        next = kernel.steps[group.end - 1].origin + 1;
        edits.lay_in(&mut recorder, &mut machine);
        edits.done += group.len();
        let environment = Rc::clone(&recorder.environment);
        machine.run_steps(kernel, &environment, group, &mut recorder);
    }
    for instruction in next..listing.program.instructions().count() {
        edits.lay_in(&mut recorder, &mut machine);
        recorder.nothing(instruction);
        edits.done += 1;
    }
    edits.done = usize::MAX;
    edits.lay_in(&mut recorder, &mut machine);
    Run {
        kind,
        listing,
        environment,
        lane,
        helpers,
        initial,
        moments: recorder.moments,
    }
}

/// The steps that read before any of them writes, together; each other step alone.
fn groups(steps: &[Step]) -> Vec<Range<usize>> {
    let mut groups = Vec::new();
    let mut start = 0;
    for (number, step) in steps.iter().enumerate() {
        if !step.held || number + 1 == steps.len() {
            groups.push(start..number + 1);
            start = number + 1;
        }
    }
    groups
}

/// The edits that are still to come.
struct Edits<'e> {
    left: &'e [Edit],
    /// The moments so far, without those that set values.
    done: usize,
}

impl Edits<'_> {
    fn lay_in(&mut self, recorder: &mut Recorder<'_>, machine: &mut Machine<4>) {
        while let Some((edit, left)) = self.left.split_first()
            && edit.after <= self.done
        {
            self.left = left;
            recorder.edit(edit, machine);
        }
    }
}

struct Recorder<'a> {
    listing: Listing<'a>,
    /// Shared with the step that runs; a constant that is set by hand makes a new one.
    environment: Rc<Environment<'a>>,
    registers: Registers,
    moments: Vec<Moment>,
    /// Steps that are computed, but not written: what they read, their results.
    computed: Vec<(usize, Vec<Read>, Quad)>,
}

impl Recorder<'_> {
    fn push(&mut self, moment: Moment) {
        self.registers.apply(&moment);
        self.moments.push(moment);
    }

    fn change(&self, target: Target, mask: WriteMask, value: &Quad) -> Change {
        let before = self.registers.target(target);
        let mut after = before;
        for (after, value) in after.iter_mut().zip(value) {
            for c in mask.components() {
                after[c] = value[c];
            }
        }
        let written = target
            .slot()
            .map_or(WriteMask::ALL, |slot| self.registers.written(slot));
        Change {
            target,
            mask,
            before,
            after,
            first: mask.without(written),
        }
    }

    fn input(&mut self, input: &Input) {
        let flags = std::array::from_fn(|pixel| Flags {
            clamped: differing(&input.raw[pixel], &input.value[pixel]),
            ..Flags::default()
        });
        let change = self.change(Target::Slot(input.slot), WriteMask::ALL, &input.value);
        self.push(Moment {
            instruction: None,
            event: Event::Input(input.source),
            change: Some(change),
            flags,
            lost: Vec::new(),
        });
    }

    fn nothing(&mut self, instruction: usize) {
        let opcode = self.listing.instruction(instruction).map(|i| i.opcode);
        let mut lost = Vec::new();
        if opcode == Some(Opcode::Phase) {
            let alpha = WriteMask::component(3);
            lost.extend(
                ((0..).map_while(Slot::temp))
                    .filter(|slot| self.registers.written(*slot).contains(alpha))
                    .map(|slot| (slot, alpha)),
            );
        }
        self.push(Moment {
            instruction: Some(instruction),
            event: Event::Nothing,
            change: None,
            flags: Default::default(),
            lost,
        });
    }

    fn edit(&mut self, edit: &Edit, machine: &mut Machine<4>) {
        let change = self.change(edit.target, edit.mask, &edit.value);
        match edit.target {
            Target::Slot(slot) => *machine.register_mut(slot) = by_component(&change.after),
            Target::Constant(index) => {
                let environment = Rc::make_mut(&mut self.environment);
                if let Some(place) = environment.constants.get_mut(index as usize) {
                    *place = change.after[0];
                }
            }
        }
        self.push(Moment {
            instruction: None,
            event: Event::Set,
            change: Some(change),
            flags: Default::default(),
            lost: Vec::new(),
        });
    }

    fn read(&self, operand: &Operand, slots: WriteMask, values: Quad) -> Read {
        let mut relative = [None; 4];
        let mut uninitialised = WriteMask::NONE;
        match operand.place {
            Place::Slot(slot) => {
                uninitialised = operand
                    .swizzle
                    .reads(slots)
                    .without(self.registers.written(slot));
            }
            Place::Relative(offset) => {
                for (pixel, relative) in relative.iter_mut().enumerate() {
                    let index =
                        self.registers.slot(Slot::ADDRESS, pixel)[0] as i64 + i64::from(offset);
                    *relative = u32::try_from(index)
                        .ok()
                        .filter(|index| (*index as usize) < self.environment.constants.len());
                }
            }
            Place::Constant(_) | Place::Literal(_) => {}
        }
        Read {
            operand: *operand,
            relative,
            slots,
            values,
            uninitialised,
        }
    }

    fn sample(&self, step: &Step, reads: &[Read]) -> Option<Sample> {
        let (Op::Sample(stage), Some(read)) = (step.op, reads.first()) else {
            return None;
        };
        let stage = usize::from(stage);
        let coordinates = read.values.map(|[u, v, w, _]| [u, v, w]);
        let bound = self.environment.stages.get(stage)?;
        let none = Detail::from(f32::NEG_INFINITY);
        let detail = bound.texture.map_or([none; 4], |texture| {
            details(texture, &bound.sampler, &coordinates)
        });
        Some(Sample {
            stage,
            coordinates,
            detail,
        })
    }

    fn take(&mut self, step: usize) -> (Vec<Read>, Quad) {
        let place = self
            .computed
            .iter()
            .position(|(number, ..)| *number == step);
        place.map_or_else(Default::default, |place| {
            let (_, reads, result) = self.computed.remove(place);
            (reads, result)
        })
    }

    fn flags(&self, step: &Step, reads: &[Read], result: &Quad, change: &Change) -> [Flags; 4] {
        // Only instructions with `_sat` saturate; where the kernel does it for another one, that one clamps.
        let asked = self
            .listing
            .instruction(step.origin)
            .is_some_and(|i| i.result.saturate);
        let free = Finish::new(ResultModifier {
            saturate: false,
            ..step.result
        });
        std::array::from_fn(|pixel| {
            let shifted = result[pixel].map(|x| free.apply(x));
            let result = shifted.map(|x| semantics::held(step.writes, x));
            let after = change.after[pixel];
            let mut flags = Flags {
                out_of_range: reads.iter().any(|read| {
                    matches!(read.operand.place, Place::Relative(_))
                        && read.relative[pixel].is_none()
                }),
                uninitialised: reads.iter().any(|read| !read.uninitialised.is_empty()),
                ..Flags::default()
            };
            for c in step.mask.components() {
                let this = WriteMask::component(c);
                let saturated = step.result.saturate && differs(result[c], after[c]);
                if saturated && asked {
                    flags.saturated = flags.saturated.or(this);
                } else if saturated
                    || shifted[c].abs() > step.writes.most()
                    || clamps(step, reads, pixel)
                {
                    flags.clamped = flags.clamped.or(this);
                }
                let among = |is: fn(f32) -> bool| {
                    reads.iter().enumerate().any(|(i, read)| {
                        let slots = step.op.slots_read(i, this);
                        slots.components().any(|slot| is(read.values[pixel][slot]))
                    })
                };
                if after[c].is_nan() && !among(f32::is_nan) {
                    flags.nan = flags.nan.or(this);
                }
                if is_infinite(after[c]) && !among(is_infinite) {
                    flags.infinite = flags.infinite.or(this);
                }
            }
            flags
        })
    }
}

/// Whether a step that has a range of its own came to its end: the address register, the depth.
fn clamps(step: &Step, reads: &[Read], pixel: usize) -> bool {
    let Some(read) = reads.first() else {
        return false;
    };
    let [x, y, ..] = read.values[pixel];
    match step.op {
        Op::Floor => differs(x.floor(), semantics::address(x)),
        Op::Depth => y != 0.0 && differs(x / y, semantics::depth(x, y)),
        _ => false,
    }
}

impl Observer<4> for Recorder<'_> {
    fn computed(&mut self, number: usize, sources: &[Lanes<4>; 3], result: &Lanes<4>) {
        let Some(step) = self.listing.kernel.steps.get(number) else {
            return;
        };
        let reads = (step.sources.iter().zip(sources).enumerate())
            .map(|(i, (operand, values))| {
                self.read(operand, step.op.slots_read(i, step.mask), by_pixel(values))
            })
            .collect();
        self.computed.push((number, reads, by_pixel(result)));
    }

    fn wrote(&mut self, number: usize, _: &Lanes<4>, after: &Lanes<4>) {
        let (reads, result) = self.take(number);
        let Some(step) = self.listing.kernel.steps.get(number) else {
            return;
        };
        let change = self.change(Target::Slot(step.destination), step.mask, &by_pixel(after));
        let flags = self.flags(step, &reads, &result, &change);
        let sample = self.sample(step, &reads);
        self.push(Moment {
            instruction: Some(step.origin),
            event: Event::Step {
                step: number,
                reads,
                computed: result,
                sample,
                killed: None,
            },
            change: Some(change),
            flags,
            lost: Vec::new(),
        });
    }

    fn killed(&mut self, number: usize, killed: &[bool; 4]) {
        let (reads, _) = self.take(number);
        let Some(step) = self.listing.kernel.steps.get(number) else {
            return;
        };
        let uninitialised = reads.iter().any(|read| !read.uninitialised.is_empty());
        let before = self.registers.killed();
        self.push(Moment {
            instruction: Some(step.origin),
            event: Event::Step {
                step: number,
                reads,
                computed: Quad::default(),
                sample: None,
                killed: Some((before, *killed)),
            },
            change: None,
            flags: [Flags {
                uninitialised,
                ..Flags::default()
            }; 4],
            lost: Vec::new(),
        });
    }
}

/// Infinite, or the largest number there is, which `rcp` of zero gives in its place.
fn is_infinite(x: f32) -> bool {
    x.abs() >= f32::MAX
}

/// Whether two numbers differ in value; NaN is like NaN, −0 like 0.
fn differs(a: f32, b: f32) -> bool {
    a != b && !(a.is_nan() && b.is_nan())
}

fn differing(a: &[f32; 4], b: &[f32; 4]) -> WriteMask {
    (0..4)
        .filter(|c| differs(a[*c], b[*c]))
        .fold(WriteMask::NONE, |mask, c| mask.or(WriteMask::component(c)))
}

fn by_pixel(register: &Lanes<4>) -> Quad {
    std::array::from_fn(|pixel| register.map(|component| component[pixel]))
}

fn by_component(register: &Quad) -> Lanes<4> {
    std::array::from_fn(|c| register.map(|pixel| pixel[c]))
}

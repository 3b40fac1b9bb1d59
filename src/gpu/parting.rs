//! One pixel on both paths: where do the registers part?

use std::collections::BTreeMap;

use super::{Frame, GpuError, PixelRegisters};
use crate::diagnostic::Span;
use crate::isa::WriteMask;
use crate::kernel::{Kernel, Op, Place, Slot, Step};
use crate::raster::{Fate, PixelTrace};
use crate::scene::{Output, PixelEvent, PixelHistory, PreparedDraw, Rendering, Scene};

/// A register, or a part of it, on both paths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// The register.
    pub slot: Slot,
    /// The components that count; the others are not compared.
    pub mask: WriteMask,
    /// What the interpreter has.
    pub cpu: [f32; 4],
    /// What the device has.
    pub gpu: [f32; 4],
}

impl Pair {
    /// The greatest difference of a component; infinite between a number and what is none, 0 between two that are none.
    pub fn difference(&self) -> f32 {
        self.greatest(|_, _| 1.0)
    }

    /// The greatest difference of a component relative to the larger of both, or to 1 if both are smaller.
    pub fn relative_difference(&self) -> f32 {
        self.greatest(|a, b| a.abs().max(b.abs()).max(1.0))
    }

    fn greatest(&self, scale: impl Fn(f32, f32) -> f32) -> f32 {
        let of = |component: usize| match (self.cpu[component], self.gpu[component]) {
            (a, b) if a == b || a.is_nan() && b.is_nan() => 0.0,
            (a, b) if a.is_finite() && b.is_finite() => (a - b).abs() / scale(a, b),
            _ => f32::INFINITY,
        };
        self.mask.components().map(of).fold(0.0, f32::max)
    }
}

/// A texture that an instruction samples.
#[derive(Clone, Debug, PartialEq)]
pub struct SampledTexture {
    /// The texture stage.
    pub stage: u8,
    /// The name of the texture in the scene.
    pub name: String,
}

/// One instruction of a pixel shader on both paths.
#[derive(Clone, Debug, PartialEq)]
pub struct LineComparison {
    /// Its number among the instructions of the program.
    pub instruction: usize,
    /// Where it stands.
    pub span: Span,
    /// The registers that it reads, before it; those components that it reads.
    pub reads: Vec<Pair>,
    /// The registers that it writes, after it; those components that it writes.
    pub writes: Vec<Pair>,
    /// What it samples.
    pub samples: Vec<SampledTexture>,
    /// Of a `texkill`: whether it discards the pixel on the CPU and on the GPU.
    pub kills: Option<[bool; 2]>,
}

impl LineComparison {
    /// The greatest relative difference of what it writes; infinite where one path discards the pixel.
    pub fn relative_difference(&self) -> f32 {
        match self.kills {
            Some([cpu, gpu]) if cpu != gpu => f32::INFINITY,
            _ => greatest(&self.writes),
        }
    }
}

fn greatest(pairs: &[Pair]) -> f32 {
    let differences = pairs.iter().map(Pair::relative_difference);
    differences.fold(0.0, f32::max)
}

/// Where two runs of a pixel shader part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Parting<'a> {
    /// Nowhere.
    Nowhere,
    /// Before the first instruction: interpolated inputs differ, and so vertex shader or interpolation do.
    Inputs,
    /// This is the first instruction that leaves different registers.
    Line(&'a LineComparison),
}

/// One primitive of one draw at a pixel, on both paths.
#[derive(Clone, Debug, PartialEq)]
pub struct FragmentComparison {
    /// What it is, and what became of it on the CPU.
    pub event: PixelEvent,
    /// Whether the device covers the pixel by this primitive. If not, there is nothing in the lists below.
    pub covered: bool,
    /// The interpolated inputs that the pixel shader reads, as it sees them.
    pub inputs: Vec<Pair>,
    /// The instructions in order.
    pub lines: Vec<LineComparison>,
    /// Whether the pixel is discarded on the CPU and on the GPU.
    pub killed: [bool; 2],
}

impl FragmentComparison {
    /// The first place where registers are apart by more than a relative difference
    /// ([`Pair::relative_difference`]), infinities and discarded pixels always.
    pub fn parting(&self, tolerance: f32) -> Parting<'_> {
        if greatest(&self.inputs) > tolerance {
            return Parting::Inputs;
        }
        let parted = |line: &&LineComparison| line.relative_difference() > tolerance;
        match self.lines.iter().find(parted) {
            Some(line) => Parting::Line(line),
            None => Parting::Nowhere,
        }
    }

    /// The instruction that explains the difference of the colour: the first that leaves registers apart by a quarter or
    /// more of what `r0` is apart in the end. What parts before it parts by less, as rounding does, and it is this
    /// instruction that makes much of little. None if `r0` does not part by more than the tolerance.
    pub fn explanation(&self, tolerance: f32) -> Option<&LineComparison> {
        let killed = self.killed[0] != self.killed[1];
        let end = self.registers().into_iter().find(|p| p.slot == Slot::R0);
        let end = end.map_or(0.0, |pair| pair.relative_difference());
        let end = if killed { f32::INFINITY } else { end };
        let explains = |line: &&LineComparison| line.relative_difference() >= end / 4.0;
        (self.lines.iter().find(explains)).filter(|_| end > tolerance)
    }

    /// The registers at the end of the shader that it has written, with all components written so far.
    pub fn registers(&self) -> Vec<Pair> {
        let mut registers: BTreeMap<Slot, Pair> = BTreeMap::new();
        for write in self.lines.iter().flat_map(|line| &line.writes) {
            let before = registers.get(&write.slot).map(|pair| pair.mask);
            let mask = write.mask.or(before.unwrap_or(WriteMask::NONE));
            registers.insert(write.slot, Pair { mask, ..*write });
        }
        let internal = |pair: &Pair| pair.slot.is_internal() && pair.slot != Slot::DEPTH;
        registers.into_values().filter(|p| !internal(p)).collect()
    }
}

/// A pixel of a picture on both paths.
#[derive(Clone, Debug, PartialEq)]
pub struct PixelComparison {
    /// Column and row.
    pub pixel: [u32; 2],
    /// Everything that covers it on the CPU.
    pub history: PixelHistory,
    /// What of it may be seen, compared: from the last that is not blended on, at most [`MOST_FRAGMENTS`].
    pub fragments: Vec<FragmentComparison>,
}

/// At most so many primitives of one pixel are compared, the last ones.
pub const MOST_FRAGMENTS: usize = 4;

/// Compares the registers of one pixel of a picture, instruction by instruction: on the GPU the shader is cut after each
/// and run again.
///
/// Both sides must have been rendered from the same scene and in one size, or from two that differ in their listings
/// only; instructions are paired by their number. A difference that comes out of a render target is told from one that
/// arises in the picture if the GPU was given the targets of the CPU.
///
/// # Errors
/// As [`Frame::registers`] and [`Rendering::history`].
pub fn compare_pixel(
    cpu: &Rendering<'_>,
    gpu: &mut Frame<'_, '_>,
    pixel: [u32; 2],
) -> Result<PixelComparison, GpuError> {
    let gpu_scene = gpu.scene();
    let gpu_pass = gpu_scene.passes(cpu.size()).pop();
    let history = cpu.history(Output::Picture, pixel)?;
    let cpu_draw = |event: &PixelEvent| cpu.pass(Output::Picture)?.draws.get(event.draw);
    let blends = |event: &PixelEvent| cpu_draw(event).is_some_and(|draw| draw.state.blend.enable);
    let opaque = |event: &PixelEvent| event.merge.fate() == Fate::Written && !blends(event);
    let first = history.events.iter().rposition(opaque).unwrap_or(0);
    let seen: Vec<&PixelEvent> = (history.events.iter().skip(first))
        .filter(|event| matches!(event.merge.fate(), Fate::Written | Fate::Killed))
        .collect();
    let mut fragments = Vec::new();
    for event in &seen[seen.len().saturating_sub(MOST_FRAGMENTS)..] {
        let (Some(on_cpu), Some(on_gpu)) = (
            cpu.shaded(Output::Picture, event.draw),
            gpu_pass
                .as_ref()
                .and_then(|pass| pass.draws.get(event.draw)),
        ) else {
            continue;
        };
        let fragment = &event.fragment;
        let trace = (on_cpu.program()).trace(&fragment.batch, fragment.lane);
        let on_cpu = on_cpu.draw();
        let wanted = wanted(&on_cpu.pixel.kernel, &trace);
        let registers = gpu.registers(on_gpu, fragment.primitive, pixel, &wanted)?;
        let texture = |stage| sampled(on_cpu, stage, cpu.scene());
        fragments.push(paired(event, on_cpu, &trace, registers.as_ref(), &texture));
    }
    Ok(PixelComparison {
        pixel,
        history,
        fragments,
    })
}

/// The registers to ask the device for: the inputs, then what each instruction writes, after it.
fn wanted(kernel: &Kernel, trace: &PixelTrace) -> Vec<(Slot, usize)> {
    let inputs = trace.inputs.iter().map(|(slot, _)| (*slot, 0));
    let written = instructions(kernel).flat_map(|(instruction, steps)| {
        let slots = destinations(steps).into_keys();
        slots.map(move |slot| (slot, instruction + 1))
    });
    inputs.chain(written).collect()
}

/// The instructions that do something, with their steps.
fn instructions(kernel: &Kernel) -> impl Iterator<Item = (usize, &[Step])> {
    let same = |a: &Step, b: &Step| a.origin == b.origin;
    let chunks = kernel.steps.chunk_by(same);
    chunks.filter_map(|steps| Some((steps.first()?.origin, steps)))
}

/// What some steps write.
fn destinations(steps: &[Step]) -> BTreeMap<Slot, WriteMask> {
    let mut masks = BTreeMap::new();
    for step in steps.iter().filter(|step| step.op != Op::Kill) {
        let mask = masks.entry(step.destination).or_insert(WriteMask::NONE);
        *mask = step.mask.or(*mask);
    }
    masks
}

/// What some steps read of what was there before them.
fn sources(steps: &[Step]) -> BTreeMap<Slot, WriteMask> {
    let mut masks = BTreeMap::new();
    for (number, step) in steps.iter().enumerate() {
        for (i, operand) in step.sources.iter().enumerate() {
            let Place::Slot(slot) = operand.place else {
                continue;
            };
            let own = |before: &Step| before.destination == slot && before.op != Op::Kill;
            if steps[..number].iter().any(own) {
                continue;
            }
            let read = operand.swizzle.reads(step.op.slots_read(i, step.mask));
            let mask = masks.entry(slot).or_insert(WriteMask::NONE);
            *mask = read.or(*mask);
        }
    }
    masks
}

/// Puts what the interpreter did beside what the device said.
fn paired(
    event: &PixelEvent,
    draw: &PreparedDraw<'_>,
    trace: &PixelTrace,
    registers: Option<&PixelRegisters>,
    texture: &dyn Fn(u8) -> Option<SampledTexture>,
) -> FragmentComparison {
    let kernel = &draw.pixel.kernel;
    let Some(registers) = registers else {
        return FragmentComparison {
            event: event.clone(),
            covered: false,
            inputs: Vec::new(),
            lines: Vec::new(),
            killed: [event.merge.killed, false],
        };
    };
    let mut values = registers.values.iter().copied();
    // The registers as they are, on both sides.
    let mut now: BTreeMap<Slot, Pair> = BTreeMap::new();
    for ((slot, cpu), gpu) in trace.inputs.iter().zip(values.by_ref()) {
        let pair = Pair {
            slot: *slot,
            mask: kernel.read(*slot),
            cpu: *cpu,
            gpu,
        };
        now.insert(*slot, pair);
    }
    let inputs = now.values().copied().collect();
    let spans: Vec<Span> = draw.pixel.program.instructions().map(|i| i.span).collect();
    let mut lines = Vec::new();
    for (instruction, steps) in instructions(kernel) {
        let reads: Vec<Pair> = (sources(steps).into_iter())
            .filter_map(|(slot, mask)| {
                Some(Pair {
                    mask,
                    ..*now.get(&slot)?
                })
            })
            .collect();
        let mut writes = Vec::new();
        for ((slot, mask), gpu) in destinations(steps).into_iter().zip(values.by_ref()) {
            let own = |change: &&crate::exec::Change| {
                change.instruction == instruction && change.slot == slot
            };
            if let Some(change) = trace.trace.changes.iter().rev().find(own) {
                let cpu = change.after;
                writes.push(Pair {
                    slot,
                    mask,
                    cpu,
                    gpu,
                });
            }
        }
        now.extend(writes.iter().map(|pair| (pair.slot, *pair)));
        let killing = steps.iter().any(|step| step.op == Op::Kill);
        let negative = |value: [f32; 4]| value[..3].iter().any(|component| *component < 0.0);
        lines.push(LineComparison {
            instruction,
            span: spans
                .get(instruction)
                .copied()
                .unwrap_or(draw.pixel.program.span),
            kills: killing.then(|| {
                [|pair: &Pair| pair.cpu, |pair: &Pair| pair.gpu]
                    .map(|side| reads.iter().any(|pair| negative(side(pair))))
            }),
            samples: (steps.iter())
                .filter_map(|step| match step.op {
                    Op::Sample(stage) => texture(stage),
                    _ => None,
                })
                .collect(),
            reads,
            writes,
        });
    }
    settle_kills(&mut lines, registers.killed);
    FragmentComparison {
        event: event.clone(),
        covered: true,
        inputs,
        lines,
        killed: [event.merge.killed, registers.killed],
    }
}

/// Makes what the lines say of the device agree with what it did: whether a component is negative may hang by a thread.
fn settle_kills(lines: &mut [LineComparison], killed: bool) {
    let told = lines
        .iter()
        .any(|line| line.kills.is_some_and(|[_, gpu]| gpu));
    let mut kills = lines.iter_mut().filter_map(|line| line.kills.as_mut());
    match (told, killed) {
        (true, false) => kills.for_each(|[_, gpu]| *gpu = false),
        (false, true) => {
            if let Some([_, gpu]) = kills.next_back() {
                *gpu = true;
            }
        }
        _ => {}
    }
}

/// The texture of a stage.
fn sampled(draw: &PreparedDraw<'_>, stage: u8, scene: &Scene) -> Option<SampledTexture> {
    let number = draw.stages.get(usize::from(stage))?.texture?;
    let name = scene.textures().get(number)?.name.clone();
    Some(SampledTexture { stage, name })
}

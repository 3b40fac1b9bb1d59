//! Kernels in their places around the rasterizer: vertices from a vertex shader, pixels from a pixel shader.

use super::vertices::{Layout, Output, Row};
use super::{
    Attribute, LANES, PixelBatch, PixelInputs, PixelResult, PixelShader, SETS, Vertex, Vertices,
};
use crate::exec::{Batch, Environment, Lanes, Machine, Observer, Trace};
use crate::isa::WriteMask;
use crate::kernel::{Kernel, Plan, Slot};
use crate::semantics;
use crate::simd::{Simd, Task};
use glam::Vec4;
use std::cell::RefCell;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

/// How many input registers a vertex shader has.
const INPUTS: usize = 16;

/// Runs a vertex shader over `count` vertices.
///
/// `fetch(vertex, register)` is the content of input register `v#`, 0 to 15, already expanded to four components; it
/// is asked only for registers that the shader reads. `plan` is that of `kernel`.
pub fn shade_vertices(
    kernel: &Kernel,
    plan: &Plan,
    environment: &Environment<'_>,
    count: usize,
    fetch: impl Fn(usize, usize) -> [f32; 4] + Sync,
) -> Vertices {
    let inputs: Vec<usize> = (0..INPUTS)
        .filter(|i| Slot::input(*i).is_some_and(|slot| !kernel.read(slot).is_empty()))
        .collect();
    let simd = Simd::chosen();
    let shader = number();
    let mut vertices = Vertices::new(count, |output| {
        slot_of(output).is_some_and(|slot| !kernel.written(slot).is_empty())
    });
    let layout = vertices.layout();
    let block = |fetched: &mut Fetched, (number, rows): (usize, &mut [Row])| {
        let first = number * LANES;
        let lanes = LANES.min(count - first);
        for register in &inputs {
            for lane in 0..lanes {
                let value = fetch(first + lane, *register);
                for (lanes, number) in fetched[*register].iter_mut().zip(value) {
                    lanes[lane] = number;
                }
            }
        }
        ROWS.with_borrow_mut(|batch| {
            simd.run(ShadeVertices {
                simd,
                batch: batch.of(shader, plan, environment),
                kernel,
                plan,
                environment,
                fetched,
                lanes,
                rows,
                layout,
            });
        });
    };
    let empty = || Box::new([[[0.0; LANES]; 4]; INPUTS]);
    let (rows, stride) = vertices.blocks_mut();
    #[cfg(feature = "parallel")]
    {
        use rayon::prelude::*;
        rows.par_chunks_mut(stride)
            .with_min_len(8)
            .enumerate()
            .for_each_init(empty, |fetched, rows| block(fetched, rows));
    }
    #[cfg(not(feature = "parallel"))]
    {
        let mut fetched = empty();
        let blocks = rows.chunks_mut(stride).enumerate();
        blocks.for_each(|rows| block(&mut fetched, rows));
    }
    vertices
}

/// What input registers hold for a block of vertices.
type Fetched = [[Row; 4]; INPUTS];

/// The register that becomes an output.
fn slot_of(output: Output) -> Option<Slot> {
    match output {
        Output::Position => Some(Slot::POSITION),
        Output::Diffuse => Slot::color_output(0),
        Output::Specular => Slot::color_output(1),
        Output::Fog => Some(Slot::FOG),
        Output::PointSize => Some(Slot::POINT_SIZE),
        Output::Texcoords(set) => Slot::texcoord_output(set),
    }
}

/// A block of vertices, as something that is compiled for each set of instructions.
struct ShadeVertices<'a, 'e> {
    simd: Simd,
    batch: &'a mut Batch<LANES>,
    kernel: &'a Kernel,
    plan: &'a Plan,
    environment: &'a Environment<'e>,
    fetched: &'a Fetched,
    lanes: usize,
    rows: &'a mut [Row],
    layout: Layout,
}

impl Task for ShadeVertices<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self {
            batch,
            kernel,
            plan,
            rows,
            ..
        } = self;
        batch.input(plan, |slot, component| {
            self.fetched.get(slot.input_index()?)?.get(component)
        });
        batch.run_here(self.simd, plan, self.environment, self.lanes);
        for output in Output::all() {
            let first = match output {
                Output::Fog => kernel.fog_component,
                Output::PointSize => kernel.point_size_component,
                _ => 0,
            };
            let Some(slot) = slot_of(output) else {
                continue;
            };
            let left = batch.output(plan, slot);
            for (component, row) in (first..).zip(self.layout.rows(rows, output)) {
                *row = left[component & 3]
                    .copied()
                    .unwrap_or([output.default(); LANES]);
            }
        }
    }
}

/// What a vertex shader leaves to the rasterizer, its registers being what `of` gives.
pub fn vertex_outputs(kernel: &Kernel, of: impl Fn(Slot) -> [f32; 4]) -> Vertex {
    let component = |slot: Slot, component: usize| of(slot)[component & 3];
    let of = |slot: Slot| Vec4::from(of(slot));
    let color = |i: usize| Slot::color_output(i).map_or(Vec4::ZERO, of);
    let mut texcoords = [Vec4::ZERO; SETS];
    for (i, set) in texcoords.iter_mut().enumerate() {
        *set = Slot::texcoord_output(i).map_or(Vec4::ZERO, of);
    }
    let sized = !kernel.written(Slot::POINT_SIZE).is_empty();
    Vertex {
        position: of(Slot::POSITION),
        diffuse: color(0),
        specular: color(1),
        texcoords,
        fog: component(Slot::FOG, kernel.fog_component),
        point_size: sized.then(|| component(Slot::POINT_SIZE, kernel.point_size_component)),
    }
}

thread_local! {
    /// The registers of a batch, kept from one to the next: a kernel loads what it reads before it reads it.
    pub(super) static MACHINE: RefCell<Machine<LANES>> = RefCell::new(Machine::new());
    /// The rows of a batch, with the constants of the shader that ran last on this thread.
    static ROWS: RefCell<LoadedBatch> = RefCell::default();
}

/// A number that no other shader with its constants has.
fn number() -> u64 {
    static NEXT: AtomicU64 = AtomicU64::new(1);
    NEXT.fetch_add(1, Relaxed)
}

/// A batch and the number of the shader whose constants it holds.
#[derive(Default)]
struct LoadedBatch {
    shader: u64,
    batch: Batch<LANES>,
}

impl LoadedBatch {
    /// The batch, loaded for the shader with this number.
    #[inline]
    fn of(&mut self, shader: u64, plan: &Plan, environment: &Environment<'_>) -> &mut Batch<LANES> {
        if self.shader != shader {
            self.batch.load(plan, environment);
            self.shader = shader;
        }
        &mut self.batch
    }
}

/// A pixel shader with everything that is set while it runs.
pub struct PixelProgram<'a> {
    /// The shader.
    pub kernel: &'a Kernel,
    /// Its textures, stage states and constants.
    pub environment: &'a Environment<'a>,
}

/// The registers of one pixel while its shader runs.
#[derive(Clone, Debug, PartialEq)]
pub struct PixelTrace {
    /// The interpolated inputs that the shader reads, as it sees them.
    pub inputs: Vec<(Slot, [f32; 4])>,
    /// Every write.
    pub trace: Trace,
}

impl PixelProgram<'_> {
    /// The coordinate sets that the shader reads, and those among some other slots.
    fn texcoords(&self, others: &[Slot]) -> impl Iterator<Item = (usize, Slot)> {
        (0..SETS)
            .filter_map(|i| Some((i, Slot::texcoord(i)?)))
            .filter(move |(_, slot)| others.contains(slot) || !self.kernel.read(*slot).is_empty())
    }

    /// An interpolated colour, if the shader reads it or it is among some other slots.
    fn color(&self, index: usize, others: &[Slot]) -> Option<Slot> {
        Slot::input(index)
            .filter(|slot| others.contains(slot) || !self.kernel.read(*slot).is_empty())
    }

    /// What is to be interpolated for the shader: the components that it reads.
    pub fn inputs(&self) -> PixelInputs {
        self.inputs_with(&[])
    }

    /// What is to be interpolated for the shader, and for whoever looks at these slots.
    pub(super) fn inputs_with(&self, others: &[Slot]) -> PixelInputs {
        let read = |slot: Option<Slot>| match slot {
            Some(slot) if others.contains(&slot) => WriteMask::ALL,
            Some(slot) => self.kernel.read(slot),
            None => WriteMask::NONE,
        };
        PixelInputs {
            diffuse: read(Slot::input(0)),
            specular: read(Slot::input(1)),
            texcoords: std::array::from_fn(|set| read(Slot::texcoord(set))),
        }
    }

    /// Puts the inputs that the shader reads, of the first `N` lanes of a batch, into their registers: of a
    /// [`Machine<4>`](Machine) the first quad.
    pub fn load<const N: usize>(&self, machine: &mut Machine<N>, batch: &PixelBatch) {
        self.load_with(machine, batch, &[]);
    }

    /// The same, and those that whoever looks at these slots wants to see.
    pub(super) fn load_with<const N: usize>(
        &self,
        machine: &mut Machine<N>,
        batch: &PixelBatch,
        others: &[Slot],
    ) {
        for (i, slot) in self.texcoords(others) {
            fill(machine.register_mut(slot), &batch.texcoords[i], |value| {
                value
            });
        }
        for (i, color) in [&batch.diffuse, &batch.specular].into_iter().enumerate() {
            if let Some(slot) = self.color(i, others) {
                // Interpolated colours reach the shader in 0 to 1.
                fill(machine.register_mut(slot), color, semantics::saturate);
            }
        }
    }

    /// Runs the shader on what was loaded.
    pub(super) fn run(&self, machine: &mut Machine<LANES>, observer: &mut impl Observer<LANES>) {
        machine.run_observed(self.kernel, self.environment, usize::MAX, observer);
    }

    /// Takes over what decides whether pixels are seen.
    pub(super) fn finish(machine: &Machine<LANES>, out: &mut PixelResult) {
        out.killed = *machine.killed();
        // Only looked at if the shader writes it.
        out.depth = machine.register(Slot::DEPTH)[0];
    }

    /// Whether the shader replaces the depth of the pixel.
    pub(super) fn writes_depth(&self) -> bool {
        self.kernel.writes_depth()
    }

    /// Whether it may discard the pixel.
    pub(super) fn may_kill(&self) -> bool {
        self.kernel.kills()
    }

    /// Runs the shader for a batch and records one lane.
    pub fn trace(&self, batch: &PixelBatch, lane: usize) -> PixelTrace {
        let mut machine = Machine::<LANES>::new();
        self.load(&mut machine, batch);
        let sets = self.texcoords(&[]).map(|(_, slot)| slot);
        let colors = (0..2).filter_map(|i| self.color(i, &[]));
        let inputs = (sets.chain(colors))
            .map(|slot| (slot, machine.lane(slot, lane)))
            .collect();
        PixelTrace {
            inputs,
            trace: Trace::record(&mut machine, self.kernel, self.environment, lane),
        }
    }
}

/// A pixel shader as it runs in whole frames: the steps of its plan on many pixels at a time.
pub struct BatchProgram<'a> {
    program: PixelProgram<'a>,
    plan: &'a Plan,
    simd: Simd,
    number: u64,
}

impl<'a> BatchProgram<'a> {
    /// The program with the plan of its kernel.
    pub fn new(program: PixelProgram<'a>, plan: &'a Plan) -> Self {
        Self {
            program,
            plan,
            simd: Simd::chosen(),
            number: number(),
        }
    }
}

impl PixelShader for BatchProgram<'_> {
    fn inputs(&self) -> PixelInputs {
        let mut inputs = PixelInputs::NONE;
        for (slot, component) in self.plan.inputs() {
            let read = match slot.texcoord_index() {
                Some(set) => inputs.texcoords.get_mut(set),
                None if slot.input_index() == Some(0) => Some(&mut inputs.diffuse),
                None => Some(&mut inputs.specular),
            };
            if let Some(read) = read {
                *read = read.or(WriteMask::component(component));
            }
        }
        inputs
    }

    fn shade(&self, pixels: &PixelBatch, out: &mut PixelResult) {
        let (plan, environment) = (self.plan, self.program.environment);
        ROWS.with_borrow_mut(|rows| {
            self.simd.run(ShadePixels {
                simd: self.simd,
                batch: rows.of(self.number, plan, environment),
                plan,
                environment,
                pixels,
                out,
            });
        });
    }

    fn writes_depth(&self) -> bool {
        self.program.writes_depth()
    }

    fn may_kill(&self) -> bool {
        self.program.may_kill()
    }
}

/// A batch of pixels, as something that is compiled for each set of instructions.
struct ShadePixels<'a, 'e> {
    simd: Simd,
    batch: &'a mut Batch<LANES>,
    plan: &'a Plan,
    environment: &'a Environment<'e>,
    pixels: &'a PixelBatch,
    out: &'a mut PixelResult,
}

impl Task for ShadePixels<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self {
            batch,
            plan,
            pixels,
            out,
            ..
        } = self;
        // Interpolated colours are in 0 to 1 already.
        batch.input(plan, |slot, component| {
            let attribute = match slot.texcoord_index() {
                Some(set) => pixels.texcoords.get(set)?,
                None if slot.input_index()? == 0 => &pixels.diffuse,
                None => &pixels.specular,
            };
            attribute.get(component)
        });
        batch.run_here(self.simd, plan, self.environment, 4 * pixels.quads);
        for (channel, row) in out.color.iter_mut().zip(batch.output(plan, Slot::R0)) {
            *channel = row.copied().unwrap_or([0.0; LANES]);
        }
        out.killed = *batch.killed();
        if let [Some(depth), ..] = batch.output(plan, Slot::DEPTH) {
            out.depth = *depth;
        }
    }
}

/// Puts the first lanes of an attribute into a register.
#[inline]
fn fill<const N: usize>(
    register: &mut Lanes<N>,
    attribute: &Attribute,
    finish: impl Fn(f32) -> f32,
) {
    for (values, given) in register.iter_mut().zip(attribute) {
        for (value, given) in values.iter_mut().zip(given) {
            *value = finish(*given);
        }
    }
}

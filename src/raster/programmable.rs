//! Kernels in their places around the rasterizer: vertices from a vertex shader, pixels from a pixel shader.

use super::{Attribute, LANES, PixelBatch, PixelInputs, PixelResult, PixelShader, Vertex};
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
/// How many texture coordinate sets there are.
const SETS: usize = 8;

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
) -> Vec<Vertex> {
    let inputs: Vec<(usize, Slot)> = (0..INPUTS)
        .filter_map(|i| Some((i, Slot::input(i)?)))
        .filter(|(_, slot)| !kernel.read(*slot).is_empty())
        .collect();
    let simd = Simd::chosen();
    let shader = number();
    let batch = |(number, vertices): (usize, &mut [Vertex])| {
        let first = number * LANES;
        let mut fetched = [[[0.0; LANES]; 4]; INPUTS];
        for (register, _) in &inputs {
            for lane in 0..vertices.len() {
                let value = fetch(first + lane, *register);
                for (lanes, number) in fetched[*register].iter_mut().zip(value) {
                    lanes[lane] = number;
                }
            }
        }
        ROWS.with_borrow_mut(|rows| {
            simd.run(ShadeVertices {
                simd,
                batch: rows.of(shader, plan, environment),
                kernel,
                plan,
                environment,
                fetched: &fetched,
                vertices,
            });
        });
    };
    // What no output is written to is what a vertex has by itself.
    let mut vertices = vec![Vertex::default(); count];
    #[cfg(feature = "parallel")]
    {
        use rayon::prelude::*;
        vertices
            .par_chunks_mut(LANES)
            .with_min_len(8)
            .enumerate()
            .for_each(batch);
    }
    #[cfg(not(feature = "parallel"))]
    vertices.chunks_mut(LANES).enumerate().for_each(batch);
    vertices
}

/// A batch of vertices, as something that is compiled for each set of instructions.
struct ShadeVertices<'a, 'e> {
    simd: Simd,
    batch: &'a mut Batch<LANES>,
    kernel: &'a Kernel,
    plan: &'a Plan,
    environment: &'a Environment<'e>,
    fetched: &'a [[[f32; LANES]; 4]; INPUTS],
    vertices: &'a mut [Vertex],
}

impl Task for ShadeVertices<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self {
            batch,
            kernel,
            plan,
            vertices,
            ..
        } = self;
        batch.input(plan, |slot, component| {
            self.fetched.get(slot.input_index()?)?.get(component)
        });
        batch.run_here(self.simd, plan, self.environment, vertices.len());
        for (slot, component) in [
            (Slot::FOG, kernel.fog_component),
            (Slot::POINT_SIZE, kernel.point_size_component),
        ] {
            let row = batch.output(plan, slot)[component & 3];
            if let Some(row) = row.filter(|_| !kernel.written(slot).is_empty()) {
                for (vertex, number) in vertices.iter_mut().zip(row) {
                    match slot {
                        Slot::FOG => vertex.fog = *number,
                        _ => vertex.point_size = Some(*number),
                    }
                }
            }
        }
        let mut take = |slot: Option<Slot>, place: fn(&mut Vertex, usize) -> &mut Vec4, n| {
            let Some(slot) = slot.filter(|slot| !kernel.written(*slot).is_empty()) else {
                return;
            };
            if let [Some(x), Some(y), Some(z), Some(w)] = batch.output(plan, slot) {
                for (lane, vertex) in vertices.iter_mut().enumerate().take(LANES) {
                    *place(vertex, n) = Vec4::new(x[lane], y[lane], z[lane], w[lane]);
                }
            }
        };
        take(Some(Slot::POSITION), |vertex, _| &mut vertex.position, 0);
        take(Slot::color_output(0), |vertex, _| &mut vertex.diffuse, 0);
        take(Slot::color_output(1), |vertex, _| &mut vertex.specular, 0);
        for set in 0..SETS {
            let slot = Slot::texcoord_output(set);
            take(slot, |vertex, set| &mut vertex.texcoords[set], set);
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

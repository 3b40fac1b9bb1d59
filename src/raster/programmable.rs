//! Kernels in their places around the rasterizer: vertices from a vertex shader, pixels from a pixel shader.

use super::{Attribute, LANES, PixelBatch, PixelInputs, PixelResult, PixelShader, Vertex};
use crate::exec::{Environment, Lanes, Machine, Observer, Trace};
use crate::kernel::{Kernel, Slot};
use crate::semantics;
use glam::Vec4;
use std::cell::RefCell;

/// How many input registers a vertex shader has.
const INPUTS: usize = 16;
/// How many texture coordinate sets there are.
const SETS: usize = 8;

/// Runs a vertex shader over `count` vertices.
///
/// `fetch(vertex, register)` is the content of input register `v#`, 0 to 15, already expanded to four components; it
/// is asked only for registers that the shader reads.
pub fn shade_vertices(
    kernel: &Kernel,
    environment: &Environment<'_>,
    count: usize,
    fetch: impl Fn(usize, usize) -> [f32; 4] + Sync,
) -> Vec<Vertex> {
    let inputs: Vec<(usize, Slot)> = (0..INPUTS)
        .filter_map(|i| Some((i, Slot::input(i)?)))
        .filter(|(_, slot)| !kernel.read(*slot).is_empty())
        .collect();
    let batch = |number: usize| -> Vec<Vertex> {
        let first = number * LANES;
        let live = count.saturating_sub(first).min(LANES);
        MACHINE.with_borrow_mut(|machine| {
            for (register, slot) in &inputs {
                for lane in 0..live {
                    machine.set_lane(*slot, lane, fetch(first + lane, *register));
                }
            }
            machine.run(kernel, environment);
            (0..live)
                .map(|lane| vertex_outputs(kernel, |slot| machine.lane(slot, lane)))
                .collect()
        })
    };
    let batches = count.div_ceil(LANES);
    #[cfg(feature = "parallel")]
    let vertices = {
        use rayon::prelude::*;
        (0..batches).into_par_iter().flat_map_iter(batch).collect()
    };
    #[cfg(not(feature = "parallel"))]
    let vertices = (0..batches).flat_map(batch).collect();
    vertices
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
    static MACHINE: RefCell<Machine<LANES>> = RefCell::new(Machine::new());
}

/// A register shown instead of the pixel's colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RegisterPicture {
    /// The register.
    pub slot: Slot,
    /// How many instructions run before it is looked at; `usize::MAX`: all.
    pub instructions: usize,
    /// What of it is shown.
    pub view: View,
    /// Whether the absolute value is shown.
    pub absolute: bool,
    /// What the value is multiplied by.
    pub scale: f32,
}

/// What of a register is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum View {
    /// x, y and z as red, green and blue.
    #[default]
    Color,
    /// One component (0 to 3) as grey.
    Component(usize),
    /// The length of (x, y, z) as grey.
    Magnitude,
    /// All four components as they are, also of pixels that `texkill` discards: for comparisons, not for eyes.
    Exact,
}

impl RegisterPicture {
    /// The colour that stands for a register's content.
    fn color(&self, register: [f32; 4]) -> [f32; 4] {
        let [x, y, z, w] = register;
        let shown = match self.view {
            View::Color => [x, y, z, 1.0],
            View::Component(c) => [register[c & 3]; 4],
            View::Magnitude => [Vec4::new(x, y, z, 0.0).length(); 4],
            View::Exact => [x, y, z, w],
        };
        let [r, g, b, a] = shown.map(|value| {
            let value = if self.absolute { value.abs() } else { value };
            value * self.scale
        });
        [r, g, b, if self.view == View::Exact { a } else { 1.0 }]
    }
}

/// A pixel shader with everything that is set while it runs.
pub struct PixelProgram<'a> {
    /// The shader.
    pub kernel: &'a Kernel,
    /// Its textures, stage states and constants.
    pub environment: &'a Environment<'a>,
    /// A register to show instead of the colour.
    pub picture: Option<RegisterPicture>,
}

/// The registers of one pixel while its shader runs.
#[derive(Clone, Debug, PartialEq)]
pub struct PixelTrace {
    /// The interpolated inputs that the shader reads, as it sees them.
    pub inputs: Vec<(Slot, [f32; 4])>,
    /// Every write.
    pub trace: Trace,
}

/// Sees nothing.
struct Nothing;

impl Observer<LANES> for Nothing {
    fn wrote(&mut self, _: usize, _: &Lanes<LANES>, _: &Lanes<LANES>) {}
    fn killed(&mut self, _: usize, _: &[bool; LANES]) {}
}

impl PixelProgram<'_> {
    fn texcoords(&self) -> impl Iterator<Item = (usize, Slot)> {
        let shown = self.picture.map(|p| p.slot);
        (0..SETS)
            .filter_map(|i| Some((i, Slot::texcoord(i)?)))
            .filter(move |(_, slot)| Some(*slot) == shown || !self.kernel.read(*slot).is_empty())
    }

    fn color(&self, index: usize) -> Option<Slot> {
        let shown = self.picture.map(|p| p.slot);
        Slot::input(index)
            .filter(|slot| Some(*slot) == shown || !self.kernel.read(*slot).is_empty())
    }

    /// Puts the inputs that the shader reads, of the first `N` lanes of a batch, into their registers: of a
    /// [`Machine<4>`](Machine) the first quad.
    pub fn load<const N: usize>(&self, machine: &mut Machine<N>, batch: &PixelBatch) {
        for (i, slot) in self.texcoords() {
            *machine.register_mut(slot) = lanes(&batch.texcoords[i], |value| value);
        }
        for (i, color) in [&batch.diffuse, &batch.specular].into_iter().enumerate() {
            if let Some(slot) = self.color(i) {
                // Interpolated colours reach the shader in 0 to 1.
                *machine.register_mut(slot) = lanes(color, semantics::saturate);
            }
        }
    }

    /// Runs the shader for a batch and records one lane.
    pub fn trace(&self, batch: &PixelBatch, lane: usize) -> PixelTrace {
        let mut machine = Machine::<LANES>::new();
        self.load(&mut machine, batch);
        let sets = self.texcoords().map(|(_, slot)| slot);
        let colors = (0..2).filter_map(|i| self.color(i));
        let inputs = (sets.chain(colors))
            .map(|slot| (slot, machine.lane(slot, lane)))
            .collect();
        PixelTrace {
            inputs,
            trace: Trace::record(&mut machine, self.kernel, self.environment, lane),
        }
    }
}

impl PixelShader for PixelProgram<'_> {
    fn inputs(&self) -> PixelInputs {
        PixelInputs {
            diffuse: self.color(0).is_some(),
            specular: self.color(1).is_some(),
            texcoords: self.texcoords().fold(0, |bits, (i, _)| bits | 1 << i),
        }
    }

    fn shade(&self, batch: &PixelBatch, out: &mut PixelResult) {
        MACHINE.with_borrow_mut(|machine| {
            if let Some(picture) = &self.picture {
                // A register that the shader never touches is shown as zero, not as the last batch left it.
                machine.load(picture.slot, [0.0; 4]);
            }
            self.load(machine, batch);
            match &self.picture {
                None => {
                    machine.run(self.kernel, self.environment);
                    out.color = *machine.register(Slot::R0);
                }
                Some(picture) => {
                    let most = picture.instructions;
                    machine.run_observed(self.kernel, self.environment, most, &mut Nothing);
                    for lane in 0..LANES {
                        let color = picture.color(machine.lane(picture.slot, lane));
                        for (component, value) in out.color.iter_mut().zip(color) {
                            component[lane] = value;
                        }
                    }
                }
            }
            if !matches!(&self.picture, Some(picture) if picture.view == View::Exact) {
                out.killed = *machine.killed();
            }
            if self.kernel.writes_depth() {
                out.depth = machine.register(Slot::DEPTH)[0];
            }
        });
    }

    fn writes_depth(&self) -> bool {
        self.kernel.writes_depth()
    }

    fn may_kill(&self) -> bool {
        self.kernel.kills()
    }
}

/// The first lanes of an attribute; lanes that it does not have are 0.
#[inline]
fn lanes<const N: usize>(attribute: &Attribute, finish: impl Fn(f32) -> f32) -> Lanes<N> {
    let of = |component: &[f32; LANES], lane| component.get(lane).copied().map_or(0.0, &finish);
    (attribute.each_ref()).map(|component| std::array::from_fn(|lane| of(component, lane)))
}

//! How far a GPU may be from what a case expects though all is right.
//!
//! The interpreter fixes every bit; WGSL does not. So every invocation is run once more on the CPU with a running error
//! analysis (that of [`crate::generate`]): each register carries how far an executor with the precision that WGSL and
//! Vulkan promise may be from it. What is computed from few bits without rounding, as most numbers of a good
//! case are, has a bound of 0. The bounds only widen the tolerance where it is smaller; a `tol` of the case that is larger
//! stays.
//!
//! Where executors that are right may part altogether (a number too near to the threshold of a comparison or to a texel's
//! edge) nothing is widened, and the case is judged as on the CPU: what it expects there must be exact.
//!
//! - *Arithmetic*: [`Precision`]'s default says what is promised.
//! - *Infinities and NaN*: WGSL allows a compiler to assume that there are none. The translation spells out with
//!   comparisons and bits what Direct3D 8 does with them, so nothing is widened.
//! - *Denormal numbers* may be flushed, as the interpreter does; they are below every tolerance.
//! - *Samples*, *depth*, *frames*: the constants below.

use super::run::{slot_of, without_vertex_shader};
use super::{Case, Invocation, Observed, Quantity};
use crate::exec::{Environment, STAGES, Stage, bind_constants};
use crate::generate::{Approx, INVOCATIONS, Options, Precision, Probe, Sampling};
use crate::isa::{RegisterFile, ShaderKind};
use crate::kernel::{Kernel, Slot};
use crate::raster::{FogDistance, Vertex};
use crate::scene::Shader;
use crate::semantics::BumpState;
use crate::texture::{AddressMode, Filter, Texture, TextureKind};

/// Weights of linear filters have as few as 8 bits in hardware; Direct3D asks for no more. A coordinate is rounded to
/// the nearest of them, and once more when it is split into texel and weight.
const WEIGHT: f64 = 1.0 / 256.0;

/// A half float has 11 bits: what a device without filters for 32-bit floats keeps of texels that 8 bits do not hold.
const HALF: f64 = 1.0 / 2048.0;

/// The depth buffer holds 32-bit floats of 0 to 1, and a depth is interpolated, if only between equal ones: a unit of 2⁻²⁴
/// for each.
const DEPTH: f64 = 1.0 / 8_388_608.0;

/// Direct3D 10 and Vulkan store a colour in 8 bits to within 0.6 of a step.
const STORED: f64 = 0.6 / 255.0;

/// Blending may be worked out with the 8 bits of the target: two products, each rounded to half a step; and what was in
/// the target is itself rounded to half a step, as a colour and once more as a factor.
const BLENDED: f64 = 2.0 / 255.0;

/// What a case has in common for all its invocations.
pub(super) struct Slack<'a> {
    case: &'a Case,
    textures: Textures<'a>,
}

impl<'a> Slack<'a> {
    /// `halves`: whether the device keeps texels that 8 bits do not hold as 16-bit floats.
    pub(super) fn new(case: &'a Case, halves: bool) -> Self {
        let textures = Textures::new(case, halves);
        Self { case, textures }
    }

    /// Fills in [`super::Value::slack`] of what an invocation gave.
    pub(super) fn fill(&self, invocation: &Invocation, observed: &mut Observed) {
        fill(self.case, &self.textures, invocation, observed);
    }
}

fn fill(case: &Case, textures: &Textures<'_>, invocation: &Invocation, observed: &mut Observed) {
    let vertex = case.vertex.as_ref().map(|shader| {
        let set = &invocation.vertex_constants;
        let inputs = invocation.vertex_inputs.iter().enumerate();
        let inputs = inputs.filter_map(|(i, value)| Some((Slot::input(i)?, *value, [0.0; 4])));
        run(shader, textures, set, inputs.collect())
    });
    // Where the vertex shader cannot be bounded, nothing behind it can.
    let outputs = match &vertex {
        None => Some(Outputs::given(&without_vertex_shader(invocation))),
        Some(run) => run
            .as_ref()
            .zip(case.vertex.as_ref())
            .map(|(probe, shader)| Outputs::of(&shader.kernel, probe)),
    };
    let pixel = case
        .pixel
        .as_ref()
        .zip(outputs.as_ref())
        .and_then(|(shader, outputs)| {
            run(
                shader,
                textures,
                &invocation.pixel_constants,
                outputs.to_pixel(),
            )
        });
    let vertex = vertex.flatten();
    for value in &mut observed.values {
        let of = |probe: &Option<Probe>, slot: Option<Slot>| match (probe, slot) {
            (Some(probe), Some(slot)) => probe.errors(slot)[0],
            _ => [0.0; 4],
        };
        value.slack = match value.quantity {
            Quantity::Register(kind, register) => {
                let (shader, probe) = match kind {
                    ShaderKind::Vertex => (&case.vertex, &vertex),
                    ShaderKind::Pixel => (&case.pixel, &pixel),
                };
                let slot = shader.as_ref().and_then(|s| slot_of(register, &s.kernel));
                let errors = of(probe, slot);
                match (shader, register.file) {
                    (Some(shader), RegisterFile::RastOut) => scalar(&shader.kernel, slot, errors),
                    _ => errors,
                }
            }
            Quantity::Depth => {
                let written = case.pixel.as_ref().is_some_and(|s| s.kernel.writes_depth());
                let error = match written {
                    true => of(&pixel, Some(Slot::DEPTH))[0],
                    false => outputs
                        .as_ref()
                        .map_or(0.0, |outputs| outputs.depth().error),
                };
                // The range of the viewport and the bias are rounded once more.
                [error + 2.0 * DEPTH, 0.0, 0.0, 0.0]
            }
            Quantity::Frame => frame(case, of(&pixel, Some(Slot::R0)), outputs.as_ref()),
        };
    }
}

/// `oFog` and `oPts` have the one component that counts in the first place.
fn scalar(kernel: &Kernel, slot: Option<Slot>, errors: [f64; 4]) -> [f64; 4] {
    match slot {
        Some(Slot::FOG) => [errors[kernel.fog_component & 3], 0.0, 0.0, 0.0],
        Some(Slot::POINT_SIZE) => [errors[kernel.point_size_component & 3], 0.0, 0.0, 0.0],
        _ => errors,
    }
}

/// The bound of a pixel in the target, from that of `r0`.
fn frame(case: &Case, color: [f64; 4], outputs: Option<&Outputs>) -> [f64; 4] {
    let state = &case.state;
    let rounding = Precision::default().rounding;
    let alpha = color[3];
    // Clear · colour + (1 − clear) · fog, with all of them in 0…1: no more than the errors of both. The exponential is
    // flatter than its exponent, which is off by a few roundings.
    let fog = match (state.fog.enable, outputs) {
        (true, Some(outputs)) => {
            let scale = f64::from(state.fog.density).abs().max(1.0);
            let span = f64::from(state.fog.end - state.fog.start).abs();
            let slope = if span > 0.0 {
                scale.max(1.0 / span)
            } else {
                scale
            };
            let distance = match state.fog.distance {
                // The range of the viewport and the bias are a product and a sum more.
                FogDistance::Z => outputs.depth().error + 2.0 * rounding,
                // The device has 1 over it, and divides again.
                FogDistance::W => {
                    let w = outputs.position[3];
                    w.error + 4.0 * rounding * w.value.abs()
                }
            };
            (outputs.fog.1 + distance) * slope + 4.0 * rounding
        }
        _ => 0.0,
    };
    color.map(|channel| {
        let mixed = channel + fog;
        match state.blend.enable {
            // The new colour counts as itself and as a factor, of itself and of what is there; so does its alpha.
            true => STORED + BLENDED + 3.0 * mixed + 2.0 * alpha,
            false => STORED + mixed,
        }
    })
}

/// Runs a shader with bounds. `None`: executors that are right may part.
fn run(
    shader: &Shader,
    textures: &Textures<'_>,
    set: &[(u32, [f32; 4])],
    inputs: Vec<(Slot, [f32; 4], [f64; 4])>,
) -> Option<Probe> {
    let kernel = &shader.kernel;
    let environment = Environment {
        constants: bind_constants(kernel, set),
        stages: textures.stages.clone(),
    };
    let presets = kernel.presets.iter().copied();
    let given = inputs.iter().map(|(slot, value, _)| (*slot, *value));
    let start: Vec<_> = (presets.chain(given))
        .map(|(slot, value)| (slot, [value; INVOCATIONS]))
        .collect();
    let mut probe = Probe::new(&start);
    for (slot, _, errors) in inputs {
        probe = probe.with_errors(slot, errors);
    }
    let options = Options {
        largest_value: f64::INFINITY,
        largest_error: f64::INFINITY,
        ..Options::new(kernel.version)
    };
    probe.after(kernel.clone(), 0, &environment, textures, &options)
}

/// What goes to the pixel shader, with bounds.
struct Outputs {
    position: [Approx; 4],
    /// `v0`, `v1`, then the coordinate sets.
    registers: Vec<(Slot, [f32; 4], [f64; 4])>,
    /// The fog of the vertices, and its bound.
    fog: (f64, f64),
}

impl Outputs {
    /// Those of a case without a vertex shader: known to the bit.
    fn given(vertex: &Vertex) -> Self {
        Self::new(vertex, |_| [0.0; 4], [0.0; 4], 0.0)
    }

    fn of(kernel: &Kernel, probe: &Probe) -> Self {
        let vertex = crate::raster::vertex_outputs(kernel, |slot| probe.machine.lane(slot, 0));
        let errors = |slot: Option<Slot>| slot.map_or([0.0; 4], |slot| probe.errors(slot)[0]);
        let fog = errors(Some(Slot::FOG))[kernel.fog_component & 3];
        Self::new(&vertex, errors, errors(Some(Slot::POSITION)), fog)
    }

    fn new(
        vertex: &Vertex,
        errors: impl Fn(Option<Slot>) -> [f64; 4],
        position: [f64; 4],
        fog: f64,
    ) -> Self {
        let exact = vertex.position.to_array();
        let colors = [vertex.diffuse, vertex.specular].into_iter().enumerate();
        let colors = colors.filter_map(|(i, color)| {
            let color = color.to_array().map(crate::semantics::saturate);
            Some((Slot::input(i)?, color, errors(Slot::color_output(i))))
        });
        let sets = vertex.texcoords.iter().enumerate().filter_map(|(i, set)| {
            let errors = errors(Slot::texcoord_output(i));
            Some((Slot::texcoord(i)?, set.to_array(), errors))
        });
        Self {
            position: std::array::from_fn(|i| Approx::new(exact[i].into(), position[i])),
            registers: colors.chain(sets).collect(),
            fog: (vertex.fog.into(), fog),
        }
    }

    fn to_pixel(&self) -> Vec<(Slot, [f32; 4], [f64; 4])> {
        self.registers.clone()
    }

    /// z / w; a w near to 0 has no bound, and what comes of it is one of the ends.
    fn depth(&self) -> Approx {
        let [_, _, z, w] = self.position;
        let depth = z.over(w, Precision::default().rounding);
        depth.unwrap_or(Approx::exact(0.0)).saturate()
    }
}

/// The texture stages of a case.
struct Textures<'a> {
    stages: [Stage<'a>; STAGES],
    /// How far a texel may be off, and how far two are apart at most, the border among them.
    texels: [(f64, f64); STAGES],
}

impl<'a> Textures<'a> {
    fn new(case: &'a Case, halves: bool) -> Self {
        let stages: [Stage<'a>; STAGES] = std::array::from_fn(|i| Stage {
            texture: case.stages[i].texture.as_ref(),
            sampler: case.stages[i].sampler,
            bump: case.stages[i].bump,
        });
        let texels = std::array::from_fn(|i| texels(&stages[i], halves));
        Self { stages, texels }
    }
}

/// How far a texel of a stage may be off, and how far any two are apart, channel by channel.
fn texels(stage: &Stage<'_>, halves: bool) -> (f64, f64) {
    let Some(texture) = stage.texture else {
        return (0.0, 0.0);
    };
    let border = texture.format().with_fill(stage.sampler.border);
    let (mut least, mut most) = (border, border);
    each_texel(texture, |texel| {
        for (channel, value) in texel.into_iter().enumerate() {
            least[channel] = least[channel].min(value);
            most[channel] = most[channel].max(value);
        }
    });
    let apart = (0..4)
        .map(|i| f64::from(most[i]) - f64::from(least[i]))
        .fold(0.0, f64::max);
    let largest = least
        .iter()
        .chain(&most)
        .fold(0.0, |all: f64, x| all.max(f64::from(x.abs())));
    let packed = texture.format().is_packed();
    let off = if halves && !packed {
        HALF * largest
    } else {
        0.0
    };
    (off, apart)
}

/// Shows every texel of every level.
pub(super) fn each_texel(texture: &Texture, mut see: impl FnMut([f32; 4])) {
    for level in 0..texture.level_count() {
        let [width, height, depth] = texture.level_size(level).unwrap_or_default();
        for face in 0..texture.face_count() {
            for z in 0..depth {
                for y in 0..height {
                    for x in 0..width {
                        texture
                            .texel(face, level, x, y, z)
                            .into_iter()
                            .for_each(&mut see);
                    }
                }
            }
        }
    }
}

impl Sampling for Textures<'_> {
    fn bump(&self, stage: usize) -> &BumpState {
        &self.stages[stage % STAGES].bump
    }

    fn error(&self, stage: usize, at: [Approx; 3], precision: &Precision) -> Option<f64> {
        let (off, apart) = self.texels[stage % STAGES];
        let stage = &self.stages[stage % STAGES];
        let Some(texture) = stage.texture else {
            return Some(0.0);
        };
        let size = texture.size();
        let axes: Vec<(Approx, u32)> = match texture.kind() {
            TextureKind::Texture2D => at.into_iter().zip(size).take(2).collect(),
            TextureKind::Volume => at.into_iter().zip(size).collect(),
            TextureKind::Cube => on_face(at, precision.rounding)?
                .map(|x| (x, size[0]))
                .to_vec(),
        };
        let mut moved = 0.0;
        for (x, size) in axes {
            moved += self::moved(x, size, stage.sampler.mag, precision.rounding)?;
        }
        let border = stage.sampler.address.contains(&AddressMode::Border);
        // The border is mixed in by the shader: two products and a sum.
        let mixed = if border {
            4.0 * precision.rounding
        } else {
            0.0
        };
        Some(off + apart * moved.min(1.0) + mixed * apart)
    }
}

/// The share by which neighbouring texels may count more or less along one axis. `None`: another texel may be read.
fn moved(x: Approx, size: u32, filter: Filter, rounding: f64) -> Option<f64> {
    let size = f64::from(size);
    let place = x.scale(size);
    let off = place.error + rounding * place.value.abs();
    match filter {
        Filter::Linear | Filter::Anisotropic => Some(off + WEIGHT),
        Filter::Point if x.error == 0.0 => Some(0.0),
        Filter::Point => {
            let edge = (place.value - place.value.round()).abs();
            (edge > 2.0 * off).then_some(0.0)
        }
    }
}

/// Where a direction meets the face of a cube, 0 to 1 on both axes. `None`: another face may be met.
fn on_face(at: [Approx; 3], rounding: f64) -> Option<[Approx; 2]> {
    let (major, _) =
        (at.iter().enumerate()).max_by(|(_, a), (_, b)| a.value.abs().total_cmp(&b.value.abs()))?;
    let size = Approx::new(at[major].value.abs(), at[major].error);
    let mut others = at
        .into_iter()
        .enumerate()
        .filter(|(i, _)| *i != major)
        .map(|(_, x)| x);
    let mut place = || {
        let x = others.next()?;
        let apart = Approx::new(size.value - x.value.abs(), size.error + x.error);
        apart.apart_from(0.0).then_some(())?;
        Some(
            x.over(size, rounding)?
                .plus(Approx::ONE, rounding)
                .scale(0.5),
        )
    };
    Some([place()?, place()?])
}

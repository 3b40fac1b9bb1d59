//! The CPU's way to run an invocation.

use super::{Case, Invocation, Quantity};
use crate::exec::{Environment, Machine, Stage, Trace, bind_constants};
use crate::isa::{RegisterFile, ShaderKind};
use crate::kernel::{Kernel, Slot};
use crate::program::Register;
use crate::raster::{
    self, ColorMask, Fate, LonePixel, MergeRecord, RenderState, Vertex, fog_unit, merge_lone,
    vertex_outputs,
};
use crate::scene::Shader;
use crate::semantics::saturate;

/// What an invocation gave.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Observed {
    /// The quantities that the invocation expects or accepts.
    pub values: Vec<Value>,
    /// Whether the pixel was discarded by `texkill`.
    pub killed: bool,
    /// [`Quantity::Frame`] as a target of 8 bits a channel stores it, divided by 255.
    pub stored: [f32; 4],
}

/// What came out of one quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Value {
    /// Of what.
    pub quantity: Quantity,
    /// Its components; a quantity of one number has it in the first.
    pub numbers: [f32; 4],
    /// How far each may be off though all is right, on an executor whose arithmetic is not specified to the bit: the
    /// tolerance, where that of the invocation is smaller. 0 on the CPU.
    pub slack: [f64; 4],
}

impl Observed {
    /// What came out of a quantity; zeros for one that was not asked for.
    pub fn value(&self, quantity: Quantity) -> Value {
        let found = self.values.iter().find(|value| value.quantity == quantity);
        found.copied().unwrap_or(Value {
            quantity,
            numbers: [0.0; 4],
            slack: [0.0; 4],
        })
    }
}

/// Where a number was born: the instruction that wrote it last.
#[derive(Clone, Debug, PartialEq)]
pub struct Origin {
    /// What the listing is called.
    pub listing: String,
    /// The line in it, from 1.
    pub line: usize,
    /// The instruction, on one line.
    pub text: String,
    /// How the number comes from the instruction, with what became of the pixel behind the shader: `written by`,
    /// `discarded by`, `the alpha test rejected the pixel; r0 was written by`.
    pub how: String,
}

/// A finished run on the CPU.
#[derive(Debug)]
pub struct Run<'a> {
    /// What came out.
    pub observed: Observed,
    /// What the fixed function made of `r0`.
    merging: Option<String>,
    case: &'a Case,
    vertex: Option<Recorded<'a>>,
    pixel: Option<Recorded<'a>>,
}

/// A shader that has run.
#[derive(Debug)]
struct Recorded<'a> {
    shader: &'a Shader,
    machine: Machine<1>,
    trace: Trace,
}

/// Runs the shaders of a case once.
///
/// With both shaders the outputs of the vertex shader are the inputs of the pixel shader, as if the primitive were one
/// point: nothing is clipped and nothing is interpolated, colours and fog are clamped as the rasterizer clamps them. The
/// point has no neighbours, so that textures are magnified.
pub fn observe<'a>(case: &'a Case, invocation: &Invocation) -> Run<'a> {
    let vertex = case.vertex.as_ref().map(|shader| {
        record(
            shader,
            &vertex_environment(shader, invocation),
            vertex_inputs(invocation),
        )
    });
    let outputs = match &vertex {
        Some(run) => vertex_outputs(&run.shader.kernel, |slot| run.machine.lane(slot, 0)),
        None => without_vertex_shader(invocation),
    };
    let pixel = case.pixel.as_ref().map(|shader| {
        let inputs = pixel_inputs(&outputs).map(|(slot, _, value)| (slot, value));
        record(shader, &pixel_environment(case, shader, invocation), inputs)
    });
    let mut run = Run {
        observed: Observed::default(),
        merging: None,
        case,
        vertex,
        pixel,
    };
    run.collect(invocation, &outputs);
    run
}

/// What a vertex shader runs with, beside its inputs.
pub(super) fn vertex_environment(shader: &Shader, invocation: &Invocation) -> Environment<'static> {
    Environment {
        constants: bind_constants(&shader.kernel, &invocation.vertex_constants),
        ..Environment::default()
    }
}

/// What a pixel shader runs with, beside its inputs.
pub(super) fn pixel_environment<'a>(
    case: &'a Case,
    shader: &Shader,
    invocation: &Invocation,
) -> Environment<'a> {
    Environment {
        constants: bind_constants(&shader.kernel, &invocation.pixel_constants),
        stages: std::array::from_fn(|i| Stage {
            texture: case.stages[i].texture.as_ref(),
            sampler: case.stages[i].sampler,
            bump: case.stages[i].bump,
        }),
    }
}

/// The inputs of a vertex shader.
pub(super) fn vertex_inputs(invocation: &Invocation) -> impl Iterator<Item = (Slot, [f32; 4])> {
    let inputs = invocation.vertex_inputs.iter().enumerate();
    inputs.filter_map(|(i, value)| Some((Slot::input(i)?, *value)))
}

/// The inputs of a pixel shader: as they come, and as the shader reads them.
pub(super) fn pixel_inputs(outputs: &Vertex) -> impl Iterator<Item = (Slot, [f32; 4], [f32; 4])> {
    let colors = [outputs.diffuse, outputs.specular].into_iter().enumerate();
    let colors = colors.filter_map(|(i, color)| {
        let color = color.to_array();
        Some((Slot::input(i)?, color, color.map(saturate)))
    });
    let sets = outputs.texcoords.iter().enumerate();
    let sets = sets.filter_map(|(i, set)| {
        let set = set.to_array();
        Some((Slot::texcoord(i)?, set, set))
    });
    colors.chain(sets)
}

/// The pixel as the output merger takes it.
pub(super) fn lone(
    state: &RenderState,
    outputs: &Vertex,
    color: [f32; 4],
    replaced_z: Option<f32>,
    killed: bool,
) -> LonePixel {
    LonePixel {
        color,
        killed,
        z: state.depth_at(outputs.position.z / outputs.position.w),
        replaced_z,
        w: outputs.position.w,
        fog: fog_unit(outputs.fog),
    }
}

/// What stands for a vertex where no vertex shader runs: a point on the near plane whose fog is the alpha of its
/// specular colour, as Direct3D takes it from vertices that no transformation gives a distance.
pub(super) fn without_vertex_shader(invocation: &Invocation) -> Vertex {
    let [diffuse, specular] = invocation.colors;
    Vertex {
        position: glam::Vec4::W,
        diffuse: diffuse.into(),
        specular: specular.into(),
        texcoords: invocation.texcoords.map(glam::Vec4::from),
        fog: specular[3],
        point_size: None,
    }
}

/// What the fixed function did with a shaded pixel other than to store its colour.
fn merging(state: &RenderState, fate: Fate) -> Option<String> {
    match fate {
        Fate::Written => {}
        // That is told of the instruction that did it.
        Fate::Killed => return None,
        Fate::AlphaTest | Fate::Stencil | Fate::Depth => {
            return Some(format!("the {} test rejected the pixel", fate.name()));
        }
    }
    let steps = [
        (state.fog.enable, "fog"),
        (state.blend.enable, "blending"),
        (state.color_mask != ColorMask::ALL, "the colour mask"),
    ];
    let steps: Vec<&str> = steps
        .iter()
        .filter(|step| step.0)
        .map(|step| step.1)
        .collect();
    (!steps.is_empty()).then(|| format!("after {}", steps.join(" and ")))
}

fn record<'a>(
    shader: &'a Shader,
    environment: &Environment<'_>,
    inputs: impl Iterator<Item = (Slot, [f32; 4])>,
) -> Recorded<'a> {
    let mut machine = Machine::new();
    for (slot, value) in inputs {
        machine.load(slot, value);
    }
    let trace = Trace::record(&mut machine, &shader.kernel, environment, 0);
    Recorded {
        shader,
        machine,
        trace,
    }
}

/// Where a register is at the end of a shader.
pub(super) fn slot_of(register: Register, kernel: &Kernel) -> Option<Slot> {
    let slot = Slot::of(register, kernel.version)?;
    // What no texture instruction has written holds its coordinates.
    let untouched = register.file == RegisterFile::Texture && kernel.written(slot).is_empty();
    match Slot::texcoord(register.index as usize) {
        Some(set) if untouched => Some(set),
        _ => Some(slot),
    }
}

/// Whether a slot is `oPts` of a shader that does not write it: then the size is that of the render states.
pub(super) fn unsized_point(kernel: &Kernel, slot: Slot) -> bool {
    slot == Slot::POINT_SIZE && kernel.written(slot).is_empty()
}

impl Run<'_> {
    /// Takes out what the invocation speaks of.
    fn collect(&mut self, invocation: &Invocation, outputs: &Vertex) {
        let state = &self.case.state;
        let replaced_z = self.pixel.as_ref().and_then(|run| {
            let writes = run.shader.kernel.writes_depth();
            writes.then(|| run.machine.lane(Slot::DEPTH, 0)[0])
        });
        let pixel = self.pixel.as_ref();
        let killed = pixel.is_some_and(|run| run.trace.killed_by.is_some());
        let color = pixel.map(|run| run.machine.lane(Slot::R0, 0));
        let lone = lone(
            state,
            outputs,
            color.unwrap_or_default(),
            replaced_z,
            killed,
        );
        let (z, target) = (lone.z, &self.case.target);
        // A target of one pixel is never too large.
        let merged = merge_lone(state, &lone, target).unwrap_or(raster::Merged {
            exact: target.color,
            stored: [0; 4],
            fate: Fate::Killed,
            record: MergeRecord::default(),
        });
        self.merging = merging(state, merged.fate);
        let value = |quantity: Quantity| Value {
            quantity,
            numbers: match quantity {
                Quantity::Register(..) => self.register(quantity),
                Quantity::Depth => [replaced_z.unwrap_or(z), 0.0, 0.0, 0.0],
                Quantity::Frame => merged.exact,
            },
            slack: [0.0; 4],
        };
        let values = invocation.wanted().into_iter().map(value).collect();
        self.observed = Observed {
            values,
            killed,
            stored: merged.stored.map(|channel| f32::from(channel) / 255.0),
        };
    }

    /// A register at the end, as it is compared.
    fn register(&self, quantity: Quantity) -> [f32; 4] {
        let Some((run, slot)) = self.place(quantity) else {
            return [0.0; 4];
        };
        let lane = run.machine.lane(slot, 0);
        let first = match slot {
            Slot::FOG => run.shader.kernel.fog_component,
            Slot::POINT_SIZE => run.shader.kernel.point_size_component,
            _ => return quantity.as_compared(lane),
        };
        match unsized_point(&run.shader.kernel, slot) {
            true => [self.case.state.point.size, 0.0, 0.0, 0.0],
            false => quantity.as_compared([lane[first & 3], 0.0, 0.0, 0.0]),
        }
    }

    /// The run that a quantity belongs to, and where in its machine it is.
    fn place(&self, quantity: Quantity) -> Option<(&Recorded<'_>, Slot)> {
        let Quantity::Register(kind, register) = quantity else {
            let pixel = self.pixel.as_ref()?;
            return match quantity {
                Quantity::Depth if pixel.shader.kernel.writes_depth() => Some((pixel, Slot::DEPTH)),
                Quantity::Depth => Some((self.vertex.as_ref()?, Slot::POSITION)),
                _ => Some((pixel, Slot::R0)),
            };
        };
        let run = match kind {
            ShaderKind::Vertex => self.vertex.as_ref()?,
            ShaderKind::Pixel => self.pixel.as_ref()?,
        };
        Some((run, slot_of(register, &run.shader.kernel)?))
    }

    /// The instruction that wrote a component of a quantity last; of [`Quantity::Frame`], the component of `r0` that it
    /// is made of. `None` for the quantity: the instruction that discarded the pixel.
    pub fn origin(&self, quantity: Option<Quantity>, component: usize) -> Option<Origin> {
        let Some(quantity) = quantity else {
            let run = self.pixel.as_ref()?;
            let how = "discarded by".to_owned();
            let origin = self.instruction(run, run.trace.killed_by?)?;
            return Some(Origin { how, ..origin });
        };
        if quantity == Quantity::Frame && self.observed.killed {
            return self.origin(None, component);
        }
        let (run, slot) = self.place(quantity)?;
        let component = match slot {
            Slot::FOG => run.shader.kernel.fog_component,
            Slot::POINT_SIZE => run.shader.kernel.point_size_component,
            // The depth that no shader replaces is oPos.z / oPos.w.
            Slot::POSITION if quantity == Quantity::Depth => 2,
            _ => component,
        };
        let writes = run.trace.changes.iter().filter(|c| c.slot == slot);
        let last = writes
            .rev()
            .find(|c| c.mask.components().any(|written| written == component));
        let mut origin = self.instruction(run, last?.instruction)?;
        if let (Quantity::Frame, Some(merging)) = (quantity, &self.merging) {
            origin.how = format!("{merging}; r0 was written by");
        }
        Some(origin)
    }

    fn instruction(&self, run: &Recorded<'_>, number: usize) -> Option<Origin> {
        let instruction = run.shader.program.instructions().nth(number)?;
        let at = self.case.sources.locate(instruction.span)?;
        Some(Origin {
            listing: at.file.to_owned(),
            line: at.line,
            text: instruction.text(&self.case.sources),
            how: "written by".to_owned(),
        })
    }
}

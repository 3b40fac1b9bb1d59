//! Cases, and ways to spoil them: what a case tests is what it notices.

use crate::suite::cases;
use std::collections::HashMap;
use std::sync::{Arc, LazyLock, Mutex};
use texcrd::case::{Case, Invocation, judge, observe};
use texcrd::exec::{Environment, Lanes, Machine, Observer, Stage, bind_constants};
use texcrd::isa::{Opcode, ResultModifier, ShaderKind, Version, WriteMask};
use texcrd::kernel::{Kernel, Op, Operand, Options, Plan, Projection, Slot, Step, lower};
use texcrd::program::{Instruction, Program, Statement};
use texcrd::raster::vertex_outputs;
use texcrd::scene::Shader;
use texcrd::semantics::saturate;

/// All cases of the suite.
pub(super) static PROBES: LazyLock<Vec<Probe>> = LazyLock::new(|| {
    let probe = |(path, case)| Probe {
        path,
        case,
        matters: Mutex::default(),
    };
    cases().into_iter().map(probe).collect()
});

/// Numbers that are put in the place of a result. No case expects them; clamped to 0…1 they differ.
const POISONS: [f32; 2] = [77.25, -77.25];

/// One case.
pub(super) struct Probe {
    pub(super) path: String,
    pub(super) case: Case,
    /// What [`Line::matters`] has found out, by kind of listing, instruction and component.
    matters: Mutex<HashMap<(ShaderKind, usize, usize), Vec<usize>>>,
}

/// One instruction of a case.
#[derive(Clone, Copy)]
pub(super) struct Line<'a> {
    pub(super) probe: &'a Probe,
    pub(super) shader: &'a Shader,
    pub(super) version: Version,
    /// Its number among the instructions of its listing.
    pub(super) number: usize,
    pub(super) instruction: &'a Instruction,
}

/// Every instruction of every case.
pub(super) fn lines() -> impl Iterator<Item = Line<'static>> {
    PROBES.iter().flat_map(Probe::lines)
}

impl Probe {
    pub(super) fn shaders(&self) -> impl Iterator<Item = &Shader> {
        self.case.vertex.iter().chain(&self.case.pixel)
    }

    pub(super) fn lines(&self) -> impl Iterator<Item = Line<'_>> {
        self.shaders().flat_map(move |shader| {
            let instructions = shader.program.instructions().enumerate();
            instructions.map(move |(number, instruction)| Line {
                probe: self,
                shader,
                version: shader.program.version,
                number,
                instruction,
            })
        })
    }

    /// Whether some invocation fails when the case is changed like this.
    pub(super) fn notices(&self, spoil: impl FnOnce(&mut Case)) -> bool {
        !self.noticing(spoil).is_empty()
    }

    /// The numbers of the invocations that fail when the case is changed like this.
    pub(super) fn noticing(&self, spoil: impl FnOnce(&mut Case)) -> Vec<usize> {
        let mut case = self.case.clone();
        spoil(&mut case);
        let fails = |invocation: &Invocation| {
            let run = observe(&case, invocation);
            !judge(invocation, &run.observed, |_, _| None).passes()
        };
        let invocations = case.invocations.iter().enumerate();
        invocations
            .filter(|(_, invocation)| fails(invocation))
            .map(|(number, _)| number)
            .collect()
    }

    /// Whether the case fails when a listing is changed like this. A listing that cannot be run then says nothing.
    pub(super) fn notices_listing(
        &self,
        kind: ShaderKind,
        spoil: impl FnOnce(&mut Program),
    ) -> bool {
        let Some(shader) = self.shaders().find(|s| s.program.version.kind() == kind) else {
            return false;
        };
        let mut program = (*shader.program).clone();
        spoil(&mut program);
        let Ok(kernel) = lower(&program, &options(shader)) else {
            return false;
        };
        self.notices(|case| {
            let shader = Shader {
                plan: Plan::new(&kernel),
                program: Arc::new(program),
                kernel,
            };
            *slot_of(case, kind) = Some(shader);
        })
    }

    /// What every step of a listing read in every invocation: invocation, step, sources with their modifiers.
    pub(super) fn reads(&self, kind: ShaderKind) -> Vec<(usize, usize, [[f32; 4]; 3])> {
        let mut all = Vec::new();
        for (number, invocation) in self.case.invocations.iter().enumerate() {
            let mut reader = Reader::default();
            self.run(kind, invocation, &mut reader);
            all.extend(reader.0.into_iter().map(|(step, s)| (number, step, s)));
        }
        all
    }

    /// Runs a listing of an invocation as the cases are run.
    fn run(&self, kind: ShaderKind, invocation: &Invocation, reader: &mut Reader) {
        let mut vertex = Machine::<1>::new();
        if let Some(shader) = &self.case.vertex {
            for (i, value) in invocation.vertex_inputs.iter().enumerate() {
                vertex.load(Slot::input(i).expect("an input"), *value);
            }
            let environment = Environment {
                constants: bind_constants(&shader.kernel, &invocation.vertex_constants),
                ..Environment::default()
            };
            let mut nobody = Reader::default();
            let seen = if kind == ShaderKind::Vertex {
                &mut *reader
            } else {
                &mut nobody
            };
            vertex.run_observed(&shader.kernel, &environment, usize::MAX, seen);
        }
        let Some(shader) = self.case.pixel.as_ref() else {
            return;
        };
        if kind == ShaderKind::Vertex {
            return;
        }
        let (mut colors, mut sets) = (invocation.colors, invocation.texcoords);
        if let Some(shader) = &self.case.vertex {
            let outputs = vertex_outputs(&shader.kernel, |slot| vertex.lane(slot, 0));
            colors = [outputs.diffuse, outputs.specular].map(|color| color.to_array());
            sets = outputs.texcoords.map(|set| set.to_array());
        }
        let mut machine = Machine::<1>::new();
        for (i, color) in colors.into_iter().enumerate() {
            machine.load(Slot::input(i).expect("a colour"), color.map(saturate));
        }
        for (i, set) in sets.into_iter().enumerate() {
            machine.load(Slot::texcoord(i).expect("a coordinate set"), set);
        }
        let environment = Environment {
            constants: bind_constants(&shader.kernel, &invocation.pixel_constants),
            stages: std::array::from_fn(|i| Stage {
                texture: self.case.stages[i].texture.as_ref(),
                sampler: self.case.stages[i].sampler,
                bump: self.case.stages[i].bump,
            }),
        };
        machine.run_observed(&shader.kernel, &environment, usize::MAX, reader);
    }
}

/// Writes down what steps read.
#[derive(Default)]
struct Reader(Vec<(usize, [[f32; 4]; 3])>);

impl Observer<1> for Reader {
    fn computed(&mut self, step: usize, sources: &[Lanes<1>; 3], _: &Lanes<1>) {
        let lane = |source: &Lanes<1>| source.map(|component| component[0]);
        self.0.push((step, [0, 1, 2].map(|i| lane(&sources[i]))));
    }
    fn wrote(&mut self, _: usize, _: &Lanes<1>, _: &Lanes<1>) {}
    fn killed(&mut self, _: usize, _: &[bool; 1]) {}
}

impl Line<'_> {
    pub(super) fn opcode(&self) -> Opcode {
        self.instruction.opcode
    }

    pub(super) fn kind(&self) -> ShaderKind {
        self.version.kind()
    }

    /// `ps.1.1 add`
    pub(super) fn title(&self) -> String {
        title(self.version, self.opcode())
    }

    pub(super) fn mask(&self) -> WriteMask {
        self.instruction
            .destination
            .map_or(WriteMask::NONE, |d| d.mask)
    }

    /// Whether the case fails when this instruction is changed like this.
    pub(super) fn notices(&self, spoil: impl FnOnce(&mut Instruction)) -> bool {
        self.probe.notices_listing(self.kind(), |program| {
            let mut instructions = program.statements.iter_mut().filter_map(|s| match s {
                Statement::Instruction(i) => Some(i),
                _ => None,
            });
            spoil(instructions.nth(self.number).expect("it is in the listing"));
        })
    }

    /// Whether the case fails when the steps of this instruction are changed like this.
    pub(super) fn notices_steps(&self, mut spoil: impl FnMut(&mut Step)) -> bool {
        self.probe.notices(|case| {
            let shader = slot_of(case, self.kind()).as_mut().expect("a listing");
            let steps = shader.kernel.steps.iter_mut();
            steps
                .filter(|step| step.origin == self.number)
                .for_each(&mut spoil);
        })
    }

    /// The invocations whose expectation depends on what this instruction gives in a component.
    pub(super) fn matters(&self, component: usize) -> Vec<usize> {
        let key = (self.kind(), self.number, component);
        let known = || self.probe.matters.lock().expect("no test fails in here");
        if let Some(found) = known().get(&key) {
            return found.clone();
        }
        let mut all: Vec<usize> = POISONS
            .into_iter()
            .flat_map(|poison| {
                self.probe.noticing(|case| {
                    let shader = slot_of(case, self.kind()).as_mut().expect("a listing");
                    poisoned(&mut shader.kernel, self.number, component, poison);
                })
            })
            .collect();
        all.sort_unstable();
        all.dedup();
        known().insert(key, all.clone());
        all
    }

    /// Whether what this instruction gives matters at all.
    pub(super) fn is_seen(&self) -> bool {
        (0..4).any(|component| !self.matters(component).is_empty())
    }
}

/// Puts a number into one component of whatever the steps of an instruction write, after each of them. Of `texkill` it becomes
/// what is looked at.
fn poisoned(kernel: &mut Kernel, instruction: usize, component: usize, poison: f32) {
    let mut steps = Vec::with_capacity(kernel.steps.len() + 1);
    for step in kernel.steps.drain(..) {
        let here = step.origin == instruction;
        if here && step.op == Op::Kill {
            steps.push(Step {
                sources: vec![Operand::literal(poison)],
                ..step
            });
            continue;
        }
        let mask = step.mask.and(WriteMask::component(component));
        let after = (here && !mask.is_empty()).then(|| Step {
            op: Op::Mov,
            mask,
            sources: vec![Operand::literal(poison)],
            result: ResultModifier::NONE,
            ..step.clone()
        });
        steps.push(step);
        steps.extend(after);
    }
    kernel.steps = steps;
}

fn slot_of(case: &mut Case, kind: ShaderKind) -> &mut Option<Shader> {
    match kind {
        ShaderKind::Vertex => &mut case.vertex,
        ShaderKind::Pixel => &mut case.pixel,
    }
}

/// What a listing was lowered with: which stages are projected can be seen in what came of it.
pub(super) fn options(shader: &Shader) -> Options {
    let mut options = Options {
        model: shader.kernel.model,
        policies: shader.kernel.policies,
        ..Options::default()
    };
    for (number, instruction) in shader.program.instructions().enumerate() {
        if !PROJECTED.contains(&instruction.opcode) {
            continue;
        }
        let Some(destination) = instruction.destination else {
            continue;
        };
        if let Some(projection) = projection(&shader.kernel, number) {
            options.projection[destination.register.index as usize] = projection;
        }
    }
    options
}

/// What `D3DTTFF_PROJECTED` acts on (fixed-function.md, 6).
pub(super) const PROJECTED: [Opcode; 3] = [Opcode::Tex, Opcode::TexBem, Opcode::TexBeml];

/// By which component an instruction divides its coordinates.
pub(super) fn projection(kernel: &Kernel, instruction: usize) -> Option<Projection> {
    let mut steps = kernel.steps.iter().filter(|s| s.origin == instruction);
    steps.find_map(|step| match step.op {
        Op::DivideZ | Op::Project(2) => Some(Projection::Third),
        Op::DivideW | Op::Project(_) => Some(Projection::Fourth),
        _ => None,
    })
}

/// `ps.1.1 add`
pub(super) fn title(version: Version, opcode: Opcode) -> String {
    format!("{version} {}", opcode.mnemonic())
}

/// Every instruction of every version.
pub(super) fn instruction_set() -> impl Iterator<Item = (Version, Opcode)> {
    Opcode::all().flat_map(|opcode| {
        let versions = Version::all().filter(move |version| opcode.versions().contains(*version));
        versions.map(move |version| (version, opcode))
    })
}

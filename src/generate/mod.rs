//! Random valid shaders, for comparing executors, for round trips and for fuzzing.
//!
//! [`shader`] writes a shader of one version from a seed. It is valid because of how it is written: every choice is made
//! among what the rows of [`crate::isa`] and the rules of Direct3D 8 allow at that place. [`validate`](mod@crate::validate) has
//! nothing to say of it, not even a warning.
//!
//! # Comparable shaders
//!
//! Executors round differently, and some instructions turn a difference in the last bit into another colour: `cnd`,
//! `cmp`, `slt`, `sge`, `frc`, `texkill`, the floor of `mov a0.x`, the poles of `rcp`, `rsq`, `log` and of divisions, the
//! edges of a cube, reads at coordinates that were computed. With [`Options::comparable`] the interpreter runs
//! every instruction as soon as it is written, on all invocations, and carries a bound for each component: how far
//! an executor of a given [`Precision`] may be from it (running error analysis). An instruction is not taken and
//! another chosen where a number is nearer to a threshold than twice its bound, where a result is beyond
//! [`Options::largest_value`], or its bound beyond [`Options::largest_error`]. A number at the very threshold passes
//! if it is exact: an input, or computed from inputs of few bits without rounding. The bounds come with the results
//! ([`Outcome::errors`]): they are the tolerance of a comparison, number by number.
//!
//! [`shrink`] makes a shader on which something fails as small as it can be with the failure still there.

mod approx;
mod bound;
mod maker;
mod operand;
mod phases;
mod probe;
mod random;
mod registers;
mod shrink;
mod stages;
mod textures;
mod values;

#[cfg(test)]
mod tests;

pub use approx::Precision;
// Bounds of shaders that were not generated.
pub use random::Random;
pub use shrink::shrink;
pub use textures::Textures;
#[cfg(feature = "gpu")]
pub(crate) use {approx::Approx, bound::Sampling, probe::Probe};

use crate::diagnostic::SourceMap;
use crate::exec::{Environment, Machine, STAGES, bind_constants};
use crate::isa::{Opcode, RegisterFile, ShaderKind, Version, WriteMask};
use crate::kernel::{self, Kernel, LowerError, Projection, Slot};
use crate::policy::{DefLifetime, Model, Policies};
use crate::program::{Def, Program, Register, Statement};
use crate::semantics::BumpState;
use crate::syntax;
use crate::texture::TextureKind;
use maker::{HERE, Maker, instruction};
use std::ops::RangeInclusive;

/// How many invocations a shader is generated with: the pixels of a quad, or as many vertices.
pub const INVOCATIONS: usize = 4;

/// What is to be generated.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// The version of the shader.
    pub version: Version,
    /// How many arithmetic instructions and pairs are wanted, in each phase; fewer where the version has no room.
    /// What makes the result complete (the rest of `oPos` or `r0`) comes on top.
    pub instructions: RangeInclusive<u32>,
    /// How often what is chosen.
    pub weights: Weights,
    /// Whether executors that are right come to the same results within [`Outcome::errors`]; see [`crate::generate`].
    /// Without it infinities, NaN and any sizes occur ([`Weights::wild_values`]).
    pub comparable: bool,
    /// How exact the executors are.
    pub precision: Precision,
    /// The numbers that they compute with.
    pub model: Model,
    /// What they do where there is a choice.
    pub policies: Policies,
    /// Comparable shaders: the largest number that is computed; where it is infinite, infinities and NaN are, too.
    pub largest_value: f64,
    /// Comparable shaders: the largest bound of a number within ±1; of larger ones relative to their size.
    pub largest_error: f64,
}

impl Options {
    /// Comparable shaders of this version, of middling length.
    pub fn new(version: Version) -> Self {
        Self {
            version,
            instructions: match version.kind() {
                ShaderKind::Vertex => 2..=20,
                ShaderKind::Pixel => 0..=8,
            },
            weights: Weights::default(),
            comparable: true,
            precision: Precision::default(),
            model: Model::default(),
            policies: Policies::default(),
            largest_value: 1.0e6,
            largest_error: 0.05,
        }
    }
}

/// How often what is chosen. All but [`Weights::opcodes`] in percent.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Weights {
    /// Weights of opcodes against each other; those that are not named have 4, `nop` 1. 0 keeps one out.
    pub opcodes: Vec<(Opcode, u32)>,
    /// Source modifiers.
    pub modifiers: u32,
    /// Selectors and swizzles.
    pub swizzles: u32,
    /// Write masks where all components could be written.
    pub masks: u32,
    /// Result shifts.
    pub shifts: u32,
    /// `_sat`.
    pub saturation: u32,
    /// Pairs among arithmetic.
    pub pairs: u32,
    /// Shaders of `ps.1.4` with two phases.
    pub phases: u32,
    /// Shaders that begin with `mov a0.x`; and the weight of constants read by way of it, where a temporary has 24.
    pub relative: u32,
    /// Constants that the shader defines itself.
    pub definitions: u32,
    /// Constants among those that are set from outside as well: [`Policies::def`] says which number counts.
    pub contested: u32,
    /// Stages (slots of a phase) with a texture instruction.
    pub textures: u32,
    /// Stages with a cube.
    pub cubes: u32,
    /// Stages with a volume.
    pub volumes: u32,
    /// Flat stages with `D3DTTFF_PROJECTED`.
    pub projections: u32,
    /// `texcrd` that prepare a `texdepth`.
    pub depth: u32,
    /// Sources of scalar instructions of which no letter says what is read, as `rcp r0, r1`: the validator warns of them
    /// (O21), so that there are none unless they are asked for.
    pub bare_scalars: u32,
    /// Numbers at which something changes: 0, −0, 0.5, 1 and the like.
    pub exact_values: u32,
    /// Infinities, NaN, denormal, huge and tiny numbers; only in shaders that are not comparable.
    pub wild_values: u32,
}

impl Default for Weights {
    fn default() -> Self {
        Self {
            opcodes: Vec::new(),
            modifiers: 30,
            swizzles: 40,
            masks: 40,
            shifts: 20,
            saturation: 20,
            pairs: 30,
            phases: 65,
            relative: 40,
            definitions: 30,
            contested: 25,
            textures: 70,
            cubes: 25,
            volumes: 15,
            projections: 15,
            depth: 25,
            bare_scalars: 0,
            exact_values: 15,
            wild_values: 15,
        }
    }
}

impl Weights {
    /// The weight of an opcode.
    pub fn of(&self, opcode: Opcode) -> u32 {
        let named = self.opcodes.iter().find(|(o, _)| *o == opcode);
        let usual = if opcode == Opcode::Nop { 1 } else { 4 };
        named.map_or(usual, |(_, weight)| *weight)
    }
}

/// What a texture stage has to hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stage {
    /// The kind of the texture.
    pub kind: TextureKind,
    /// Whether its channels are signed.
    pub signed: bool,
    /// The bump mapping states.
    pub bump: BumpState,
    /// `D3DTTFF_PROJECTED`
    pub projection: Projection,
}

/// A register that a shader leaves something in for what comes after it.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// The register.
    pub slot: Slot,
    /// The components that count.
    pub mask: WriteMask,
    /// What the interpreter has, invocation by invocation.
    pub values: [[f32; 4]; INVOCATIONS],
    /// How far from it another executor may be; infinite for shaders that are not comparable.
    pub errors: [[f32; 4]; INVOCATIONS],
}

/// A shader with everything that it is run with.
#[derive(Clone, Debug)]
pub struct Generated {
    /// The shader; its spans are places in `listing`, as the first text of a [`SourceMap`].
    pub program: Program,
    /// The shader as text.
    pub listing: String,
    /// The vertex elements, or colours and coordinate sets, of every invocation. All that the version has.
    pub inputs: Vec<(Slot, [[f32; 4]; INVOCATIONS])>,
    /// The constants that are set from outside. Few of those that the shader defines are among them.
    pub constants: Vec<(u32, [f32; 4])>,
    /// The numbers that it computes with.
    pub model: Model,
    /// What it does where there is a choice.
    pub policies: Policies,
    /// What the texture stages hold; only those that [`Kernel::stages`] or a bump instruction names matter.
    pub stages: [Stage; STAGES],
    /// The results: outputs that are written, or `r0` and the depth that is written.
    pub outcomes: Vec<Outcome>,
    /// The invocations that `texkill` discards; their outcomes count all the same.
    pub killed: [bool; INVOCATIONS],
}

impl Generated {
    /// The kernel of the shader, for its stages.
    ///
    /// # Errors
    /// None for a program that [`shader`] made; programs made from it may break rules.
    pub fn lower(&self, program: &Program) -> Result<Kernel, LowerError> {
        kernel::lower(program, &lowering(self.model, self.policies, &self.stages))
    }

    /// What the interpreter runs a kernel of this shader in.
    pub fn environment<'a>(&self, kernel: &Kernel, textures: &'a Textures) -> Environment<'a> {
        let constants = bind_constants(kernel, &self.constants);
        probe::environment(constants, &self.stages, textures)
    }

    /// Another program with the same inputs, constants and stages: a smaller one, say, or the first instructions of
    /// this one. Its results and their bounds are worked out anew.
    ///
    /// `None` if it has no meaning, or is to be comparable and executors that are right may part on it: then what
    /// they make of it says nothing.
    pub fn with(&self, program: &Program, options: &Options, textures: &Textures) -> Option<Self> {
        let kernel = self.lower(program).ok()?;
        let environment = self.environment(&kernel, textures);
        let probe = if options.comparable {
            let start = probe::Probe::new(&self.inputs);
            let stages = &self.stages;
            let gentle = bound::Gentle { stages, textures };
            Some(start.after(kernel, 0, &environment, &gentle, options)?)
        } else {
            None
        };
        let (listing, program) = with_text(program.clone());
        let mut changed = Self {
            program,
            listing,
            ..self.clone()
        };
        changed.run(textures, probe.as_ref());
        Some(changed)
    }

    /// Works out the results.
    fn run(&mut self, textures: &Textures, probe: Option<&probe::Probe>) {
        let Ok(kernel) = self.lower(&self.program) else {
            return;
        };
        let environment = self.environment(&kernel, textures);
        let mut machine = Machine::<INVOCATIONS>::new();
        self.load(&mut machine, 0);
        machine.run(&kernel, &environment);
        self.killed = *machine.killed();
        self.outcomes = outcomes(&kernel, &machine, probe);
    }

    /// Loads invocation `first` into lane 0, the next into lane 1 and so on, as many as there are of both.
    pub fn load<const N: usize>(&self, machine: &mut Machine<N>, first: usize) {
        for (slot, values) in &self.inputs {
            for (lane, value) in values.iter().skip(first).take(N).enumerate() {
                machine.set_lane(*slot, lane, *value);
            }
        }
    }
}

/// What a shader is lowered with.
fn lowering(model: Model, policies: Policies, stages: &[Stage; STAGES]) -> kernel::Options {
    kernel::Options {
        projection: std::array::from_fn(|i| stages[i].projection),
        model,
        policies,
    }
}

/// Writes a shader. The same seed and options give the same shader, on every platform whose `exp2` and `log2` agree
/// in the first bits: comparable shaders are chosen by what they compute.
///
/// `textures` are those of [`Options::model`].
pub fn shader(random: &mut Random, options: &Options, textures: &Textures) -> Generated {
    let version = options.version;
    let two_phases = version.row().phases > 1 && random.chance(options.weights.phases);
    let mut maker = Maker::new(random, options, textures, two_phases);
    match (version.kind(), version) {
        (ShaderKind::Vertex, _) => vertex(&mut maker),
        (_, Version::Ps14) => {
            if two_phases {
                maker.fill_phase();
                arithmetic(&mut maker, |_| 0);
                maker.offer(vec![instruction(Opcode::Phase, None, Vec::new())]);
                maker.arithmetic_left = version.row().arithmetic_slots;
                maker.texture_left = version.row().texture_slots;
            }
            maker.fill_phase();
            pixel(&mut maker);
        }
        _ => {
            maker.fill_stages();
            pixel(&mut maker);
        }
    }
    finish(maker)
}

/// As many arithmetic instructions as are wanted; `reserved` says how many slots have to stay free.
fn arithmetic(maker: &mut Maker, reserved: impl Fn(&Maker) -> u32) {
    let (least, most) = (
        *maker.options.instructions.start(),
        *maker.options.instructions.end(),
    );
    let wanted = least
        + maker
            .random
            .below(most.saturating_sub(least).saturating_add(1));
    for _ in 0..wanted {
        let reserved = reserved(maker);
        maker.any_arithmetic(reserved);
    }
}

/// Arithmetic, and the rest of `r0`.
fn pixel(maker: &mut Maker) {
    arithmetic(maker, |maker| {
        u32::from(!maker.registers.missing().is_empty())
    });
    let result = Register::new(RegisterFile::Temp, 0);
    maker.fill(result, maker.registers.missing());
}

/// Arithmetic, the rest of `oPos`, and what is missing between the coordinate sets.
fn vertex(maker: &mut Maker) {
    let sets = RegisterFile::TexCrdOut.count(maker.version);
    let addresses = RegisterFile::Addr.count(maker.version) > 0;
    // Left to chance, few shaders would have an address before they are at their end.
    if addresses && maker.random.chance(maker.weights().relative) {
        maker.fill(Register::new(RegisterFile::Addr, 0), WriteMask::X);
    }
    arithmetic(maker, |_| 1 + sets);
    let position = Register::new(RegisterFile::RastOut, crate::isa::register::OPOS);
    maker.fill(position, maker.registers.missing());
    let written = maker.registers.coordinates;
    let end = written.iter().rposition(|mask| !mask.is_empty());
    for (set, mask) in written
        .iter()
        .enumerate()
        .take(end.map_or(0, |last| last + 1))
    {
        // x up to the last component that is written (S10).
        let last = mask.components().last().unwrap_or(1);
        let prefix = WriteMask::from_bits(((1_u16 << (last + 1)) - 1) as u8);
        let register = Register::new(RegisterFile::TexCrdOut, set as u32);
        maker.fill(register, prefix.without(*mask));
    }
}

/// Puts definitions in front, gives the shader a text, and runs it.
fn finish(maker: Maker) -> Generated {
    let options = maker.kernel_options();
    let all = maker.constants.values.clone();
    let mut program = maker.program;
    let used = constants_read(&program, &options, all.len());
    let defined = maker.constants.defined;
    let is_defined = |index: u32| defined.get(index as usize) == Some(&true);
    let value = |index: u32| all.get(index as usize).copied().unwrap_or_default();
    let (inside, outside): (Vec<u32>, Vec<u32>) = used.into_iter().partition(|i| is_defined(*i));
    // Some are defined and set: one of both numbers counts, and the other would show.
    let share = maker.options.weights.contested;
    let contested: Vec<u32> = (inside.iter().copied())
        .filter(|_| maker.random.chance(share))
        .collect();
    let idle = |index: u32| value(index).map(|x| 0.75 - x);
    let always = maker.options.policies.def == DefLifetime::Always;
    let definitions = inside.into_iter().map(|index| {
        let idles = !always && contested.contains(&index);
        Statement::Def(Def {
            register: Register::new(RegisterFile::Const, index),
            value: if idles { idle(index) } else { value(index) },
            co_issue: false,
            span: HERE,
            register_span: HERE,
        })
    });
    program.statements = definitions.chain(program.statements).collect();
    let (listing, program) = with_text(program);
    let probe = maker.probe;
    let mut generated = Generated {
        program,
        listing,
        inputs: maker.inputs,
        constants: (outside.into_iter().map(|i| (i, value(i))))
            .chain(
                contested
                    .iter()
                    .map(|i| (*i, if always { idle(*i) } else { value(*i) })),
            )
            .collect(),
        model: maker.options.model,
        policies: maker.options.policies,
        stages: maker.stages,
        outcomes: Vec::new(),
        killed: [false; INVOCATIONS],
    };
    generated.run(maker.textures, probe.as_ref());
    generated
}

/// The constants that a shader may read, in order: those that it names, or all if `a0.x` is added to any.
fn constants_read(program: &Program, options: &kernel::Options, count: usize) -> Vec<u32> {
    let relative = program
        .instructions()
        .any(|i| i.sources.iter().any(|s| s.register.relative));
    if relative {
        return (0..count as u32).collect();
    }
    let kernel = kernel::lower(program, options);
    let mut named: Vec<u32> = kernel.iter().flat_map(Kernel::constants).collect();
    named.sort_unstable();
    named.dedup();
    named
}

/// The shader as text, and the shader with its places in the text. A shader that no text can express (a definition
/// of infinity) is left as it is.
fn with_text(program: Program) -> (String, Program) {
    let listing = syntax::print(&program);
    let mut sources = SourceMap::new();
    let parsed = sources
        .add("generated", listing.as_str())
        .map(syntax::parse);
    let read = parsed.ok().filter(|p| p.diagnostics.is_empty());
    (listing, read.and_then(|p| p.program).unwrap_or(program))
}

fn outcomes(
    kernel: &Kernel,
    machine: &Machine<INVOCATIONS>,
    probe: Option<&probe::Probe>,
) -> Vec<Outcome> {
    let outputs: Vec<(Slot, WriteMask)> = match kernel.version.kind() {
        ShaderKind::Vertex => {
            let scalars = [Slot::POSITION, Slot::FOG, Slot::POINT_SIZE];
            let colors = (0..2).filter_map(Slot::color_output);
            let sets = (0..8).filter_map(Slot::texcoord_output);
            let all = scalars.into_iter().chain(colors).chain(sets);
            // Fog and point size are one number each, whichever component it is written to.
            let counted = |slot: Slot| match slot {
                Slot::FOG => WriteMask::component(kernel.fog_component),
                Slot::POINT_SIZE => WriteMask::component(kernel.point_size_component),
                _ => WriteMask::ALL,
            };
            all.map(|slot| (slot, kernel.written(slot).and(counted(slot))))
                .collect()
        }
        ShaderKind::Pixel => vec![
            (Slot::R0, WriteMask::ALL),
            (Slot::DEPTH, kernel.written(Slot::DEPTH)),
        ],
    };
    let written = outputs.into_iter().filter(|(_, mask)| !mask.is_empty());
    written
        .map(|(slot, mask)| Outcome {
            slot,
            mask,
            values: std::array::from_fn(|lane| machine.lane(slot, lane)),
            errors: match probe {
                Some(probe) => probe.errors(slot).map(|lane| lane.map(|e| e as f32)),
                None => [[f32::INFINITY; 4]; INVOCATIONS],
            },
        })
        .collect()
}

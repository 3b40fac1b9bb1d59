//! A shader while it is written: instructions are offered one by one or in groups, and taken if they fit.

use super::bound::Gentle;
use super::operand::{Ports, Role, Want, source};
use super::probe::{self, Probe};
use super::registers::Registers;
use super::textures::Textures;
use super::values::{self, Mixture};
use super::{INVOCATIONS, Options, Random, Stage, Weights};
use crate::diagnostic::Span;
use crate::exec::{STAGES, bind_constants};
use crate::isa::modifier::SHIFTS;
use crate::isa::opcode::Pairing;
use crate::isa::{
    Class, Form, Opcode, RegisterFile, ResultModifier, ShaderKind, SourceModifier, Swizzle,
    Version, VersionSet, WriteMask,
};
use crate::kernel::{self, Kernel, Projection, Slot};
use crate::program::{Destination, Instruction, Program, Register, Statement};

/// What is written has no text yet.
pub(super) const HERE: Span = Span::new(0, 0);

/// How often an instruction is chosen anew before its place stays empty.
pub(super) const TRIES: u32 = 16;

/// The constants of a shader.
pub(super) struct Constants {
    /// The value of every constant of the version.
    pub(super) values: Vec<[f32; 4]>,
    /// Whether the shader itself defines it.
    pub(super) defined: Vec<bool>,
    /// The numbers that operands name.
    pub(super) pool: Vec<u32>,
}

/// The shader and everything that decides what may come next.
pub(super) struct Maker<'a> {
    pub(super) random: &'a mut Random,
    pub(super) options: &'a Options,
    pub(super) version: Version,
    /// The instructions so far.
    pub(super) program: Program,
    pub(super) registers: Registers,
    pub(super) constants: Constants,
    pub(super) inputs: Vec<(Slot, [[f32; 4]; INVOCATIONS])>,
    pub(super) stages: [Stage; STAGES],
    /// Swizzles that vertex shaders of this run use.
    pub(super) turned: Vec<Swizzle>,
    /// Slots that are left in the phase.
    pub(super) arithmetic_left: u32,
    pub(super) texture_left: u32,
    /// How often each opcode is there that has a limit.
    counts: Vec<Opcode>,
    pub(super) textures: &'a Textures,
    /// The state after the last instruction; none if nothing is to be compared.
    pub(super) probe: Option<Probe>,
}

impl<'a> Maker<'a> {
    pub(super) fn new(
        random: &'a mut Random,
        options: &'a Options,
        textures: &'a Textures,
        first_phase: bool,
    ) -> Self {
        let version = options.version;
        let weights = &options.weights;
        let mixture = Mixture {
            exact: weights.exact_values,
            wild: if options.comparable {
                0
            } else {
                weights.wild_values
            },
        };
        let constants = constants(random, options, mixture);
        let inputs = inputs(random, version, mixture);
        let stages = std::array::from_fn(|_| stage(random, weights));
        let turned = (0..6).map(|_| Swizzle::from_byte(random.below(256) as u8));
        let turned = turned.collect();
        let probe = options.comparable.then(|| Probe::new(&inputs));
        Self {
            random,
            options,
            version,
            program: Program {
                version,
                version_span: HERE,
                statements: Vec::new(),
                comments: Vec::new(),
                span: HERE,
            },
            registers: Registers::new(version, first_phase),
            constants,
            inputs,
            stages,
            turned,
            arithmetic_left: version.row().arithmetic_slots,
            texture_left: version.row().texture_slots,
            counts: Vec::new(),
            textures,
            probe,
        }
    }

    pub(super) fn weights(&self) -> &'a Weights {
        &self.options.weights
    }

    /// What the shader is lowered with.
    pub(super) fn kernel_options(&self) -> kernel::Options {
        super::lowering(self.options.model, self.options.policies, &self.stages)
    }

    /// The constants as a run of this kernel has them.
    pub(super) fn bound_constants(&self, kernel: &Kernel) -> Vec<[f32; 4]> {
        let numbers = 0_u32..;
        let set: Vec<_> = numbers.zip(self.constants.values.iter().copied()).collect();
        bind_constants(kernel, &set)
    }

    /// Takes instructions if there is room for them and executors agree on them. Returns whether they were taken.
    pub(super) fn offer(&mut self, group: Vec<Instruction>) -> bool {
        let forms: Option<Vec<&'static Form>> = (group.iter())
            .map(|instruction| instruction.opcode.form(self.version))
            .collect();
        let Some(forms) = forms else { return false };
        let paired = group.iter().any(|i| i.co_issue);
        let slots = |cost: fn(&Form) -> u32| {
            let costs = forms.iter().map(|form| cost(form));
            if paired {
                costs.max().unwrap_or(0)
            } else {
                costs.sum()
            }
        };
        let arithmetic = slots(|form| form.arithmetic_slots);
        let texture = slots(|form| form.texture_slots);
        let mut counts = self.counts.clone();
        for (instruction, form) in group.iter().zip(&forms) {
            let Some(most) = form.most else { continue };
            counts.push(instruction.opcode);
            let there = counts.iter().filter(|o| **o == instruction.opcode).count();
            if there > most as usize {
                return false;
            }
        }
        if arithmetic > self.arithmetic_left || texture > self.texture_left {
            return false;
        }
        let first = self.program.statements.len();
        let statements = group.iter().cloned().map(Statement::Instruction);
        self.program.statements.extend(statements);
        if let Some(before) = &self.probe {
            let Some(after) = self.probed(before, first) else {
                self.program.statements.truncate(first);
                return false;
            };
            self.probe = Some(after);
        }
        self.counts = counts;
        self.arithmetic_left -= arithmetic;
        self.texture_left -= texture;
        for (instruction, form) in group.iter().zip(forms) {
            self.registers.apply(instruction, form);
        }
        true
    }

    /// Runs what was written from statement `first` on.
    fn probed(&self, before: &Probe, first: usize) -> Option<Probe> {
        let kernel = kernel::lower(&self.program, &self.kernel_options()).ok()?;
        let constants = self.bound_constants(&kernel);
        let environment = probe::environment(constants, &self.stages, self.textures);
        let gentle = Gentle {
            stages: &self.stages,
            textures: self.textures,
        };
        before.after(kernel, first, &environment, &gentle, self.options)
    }

    /// An arithmetic instruction of this opcode, with a destination of its own choice unless one is given.
    pub(super) fn arithmetic(
        &mut self,
        opcode: Opcode,
        role: Role,
        given: Option<Destination>,
        ports: &mut Ports,
    ) -> Option<Instruction> {
        let form = opcode.form(self.version)?;
        let mut instruction = instruction(opcode, None, Vec::new());
        if form.destination.is_none() {
            return Some(instruction);
        }
        let destination = match given {
            Some(destination) => destination,
            None => self.destination(form, role)?,
        };
        instruction.destination = Some(destination);
        instruction.result = self.result();
        let old_pixel = VersionSet::PS_1_0_TO_1_3.contains(self.version);
        for (i, shape) in form.sources.iter().enumerate() {
            let slots = form.slots_read(i, destination.mask);
            if opcode == Opcode::Cnd && i == 0 && old_pixel {
                let condition = Register::new(RegisterFile::Temp, 0);
                if !self.registers.readable(condition).contains(slots) {
                    return None;
                }
                ports.read(condition);
                let alpha = source(condition, Swizzle::replicate(3));
                instruction.sources.push(alpha);
                continue;
            }
            let want = Want {
                shape: *shape,
                slots,
                destination,
                apart: form.rows > 0 || (opcode == Opcode::Cmp && old_pixel),
                rows: form.rows,
                vector: instruction.sources.first().map(|s| s.register),
            };
            instruction.sources.push(self.source(&want, ports)?);
        }
        Some(instruction)
    }

    /// Shift and saturation that the version has.
    fn result(&mut self) -> ResultModifier {
        let version = self.version;
        if version.kind() == ShaderKind::Vertex {
            return ResultModifier::NONE;
        }
        let shifts: Vec<i8> = (SHIFTS.iter())
            .filter(|row| row.versions.contains(version))
            .map(|row| row.shift)
            .collect();
        let shifted = self.random.chance(self.weights().shifts);
        ResultModifier {
            shift: self.random.pick(&shifts).filter(|_| shifted).unwrap_or(0),
            saturate: self.random.chance(self.weights().saturation),
        }
    }

    /// The arithmetic opcodes of the version that may be this half of a pair, with their weights.
    pub(super) fn opcodes(&self, role: Role) -> Vec<(Opcode, u32)> {
        let fits = |form: &Form| match (role, form.pairing) {
            (Role::Alone, _) | (_, Pairing::Either) => true,
            (Role::Color, Pairing::Color) => true,
            (_, Pairing::Color | Pairing::Never) => false,
        };
        // bem stands before phase.
        let in_phase = |opcode: Opcode| opcode != Opcode::Bem || self.registers.first_phase;
        Opcode::all()
            .filter(|opcode| in_phase(*opcode))
            .filter_map(|opcode| {
                let form = opcode.form(self.version)?;
                let arithmetic = form.class == Class::Arithmetic;
                (arithmetic && fits(form)).then(|| (opcode, self.weights().of(opcode)))
            })
            .collect()
    }

    /// Offers one arithmetic instruction, or a pair, that leaves `reserved` slots. Returns whether one was taken.
    pub(super) fn any_arithmetic(&mut self, reserved: u32) -> bool {
        if self.arithmetic_left <= reserved {
            return false;
        }
        for _ in 0..TRIES {
            let pixel = self.version.kind() == ShaderKind::Pixel;
            let group = if pixel && self.random.chance(self.weights().pairs) {
                self.pair()
            } else {
                let opcodes = self.opcodes(Role::Alone);
                let mut ports = Ports::new(self.version);
                let opcode = self.random.weighted(&opcodes);
                opcode
                    .and_then(|o| self.arithmetic(o, Role::Alone, None, &mut ports))
                    .map(|instruction| vec![instruction])
            };
            let Some(group) = group else { continue };
            let needs = |i: &Instruction| {
                let form = i.opcode.form(self.version);
                form.map_or(0, |form| form.arithmetic_slots)
            };
            let needed = group.iter().map(needs).max().unwrap_or(0);
            let fits = needed + reserved <= self.arithmetic_left;
            if fits && self.offer(group) {
                return true;
            }
        }
        false
    }

    /// A colour and an alpha instruction that run together, either first.
    fn pair(&mut self) -> Option<Vec<Instruction>> {
        let mut roles = [Role::Color, Role::Alpha];
        if self.random.chance(50) {
            roles.reverse();
        }
        let mut ports = Ports::new(self.version);
        let mut pair: Vec<Instruction> = Vec::with_capacity(2);
        for role in roles {
            let opcodes = self.opcodes(role);
            let opcode = self.random.weighted(&opcodes)?;
            let form = opcode.form(self.version)?;
            let mut destination = self.destination(form, role)?;
            // ps.1.0 writes one register with both halves (C5).
            if self.version == Version::Ps10
                && let Some(before) = pair.first().and_then(|i| i.destination)
            {
                destination.register = before.register;
            }
            let mut half = self.arithmetic(opcode, role, Some(destination), &mut ports)?;
            half.destination?;
            half.co_issue = !pair.is_empty();
            pair.push(half);
            ports.next_half();
        }
        Some(pair)
    }

    /// Moves something into components that have to hold a value.
    pub(super) fn fill(&mut self, register: Register, mask: WriteMask) {
        if mask.is_empty() {
            return;
        }
        let destination = super::operand::destination(register, mask);
        for _ in 0..TRIES {
            let mut ports = Ports::new(self.version);
            let given = Some(destination);
            let filled = self.arithmetic(Opcode::Mov, Role::Alone, given, &mut ports);
            if filled.is_some_and(|i| self.offer(vec![i])) {
                return;
            }
        }
        // A plain constant is exact and of moderate size, so that nothing speaks against it.
        let first = self.constants.pool.first().copied().unwrap_or_default();
        let constant = source(Register::new(RegisterFile::Const, first), Swizzle::IDENTITY);
        let plain = instruction(Opcode::Mov, Some(destination), vec![constant]);
        self.offer(vec![plain]);
    }
}

fn constants(random: &mut Random, options: &Options, mixture: Mixture) -> Constants {
    let version = options.version;
    let count = RegisterFile::Const.count(version);
    // Definitions of pixel shaders are clamped to −1…1, which shows only in numbers beyond.
    let reach = match version.kind() {
        ShaderKind::Vertex => 4.0,
        ShaderKind::Pixel => 1.5,
    };
    let mut values: Vec<[f32; 4]> = (0..count)
        .map(|_| values::vector(random, mixture, -reach, reach))
        .collect();
    let pool: Vec<u32> = match version.kind() {
        ShaderKind::Pixel => (0..count).collect(),
        ShaderKind::Vertex => (0..8).map(|_| random.below(count)).collect(),
    };
    let mut defined: Vec<bool> = (0..count)
        .map(|index| {
            // What no operand names is only reached by way of a0.x.
            let share = if pool.contains(&index) { 1 } else { 8 };
            random.chance(options.weights.definitions / share)
        })
        .collect();
    // Infinities and NaN have no text, so that no definition can hold them.
    for (value, defined) in values.iter().zip(&mut defined) {
        *defined &= value.iter().all(|x| x.is_finite());
    }
    // One that everything can fall back to.
    if let Some(first) = pool.first().and_then(|at| values.get_mut(*at as usize)) {
        *first = [0.5, 0.25, -0.5, 1.0];
    }
    Constants {
        values,
        defined,
        pool,
    }
}

fn inputs(
    random: &mut Random,
    version: Version,
    mixture: Mixture,
) -> Vec<(Slot, [[f32; 4]; INVOCATIONS])> {
    let mut inputs = Vec::new();
    let registers = RegisterFile::Input.count(version) as usize;
    let (low, high) = match version.kind() {
        ShaderKind::Vertex => (-4.0, 4.0),
        // Interpolated colours are clamped.
        ShaderKind::Pixel => (0.0, 1.0),
    };
    let colors = match version.kind() {
        ShaderKind::Vertex => mixture,
        ShaderKind::Pixel => Mixture { wild: 0, ..mixture },
    };
    for slot in (0..registers).filter_map(Slot::input) {
        inputs.push((slot, values::spread(random, colors, low, high)));
    }
    let sets = RegisterFile::Texture.count(version) as usize;
    for slot in (0..sets).filter_map(Slot::texcoord) {
        let mut set: [[f32; 4]; INVOCATIONS] = values::spread(random, mixture, -2.0, 2.0);
        // Most coordinates are projected by something positive.
        if random.chance(70) {
            for lane in &mut set {
                lane[3] = lane[3].abs().max(0.5);
            }
        }
        inputs.push((slot, set));
    }
    inputs
}

fn stage(random: &mut Random, weights: &Weights) -> Stage {
    use crate::texture::TextureKind::{Cube, Texture2D, Volume};
    let flat = 100_u32
        .saturating_sub(weights.cubes)
        .saturating_sub(weights.volumes);
    let kinds = [
        (Texture2D, flat),
        (Cube, weights.cubes),
        (Volume, weights.volumes),
    ];
    let eighths = |random: &mut Random| random.below(17) as f32 / 8.0 - 1.0;
    let projections = [Projection::Third, Projection::Fourth];
    let kind = random.weighted(&kinds).unwrap_or(Texture2D);
    // Only flat coordinates have a component left over to be divided by.
    let projected = kind == Texture2D && random.chance(weights.projections);
    Stage {
        kind,
        signed: random.chance(50),
        bump: crate::semantics::BumpState {
            matrix: std::array::from_fn(|_| eighths(random)),
            luminance_scale: eighths(random),
            luminance_offset: eighths(random),
        },
        projection: random
            .pick(&projections)
            .filter(|_| projected)
            .unwrap_or_default(),
    }
}

/// An instruction without a place in a text.
pub(super) fn instruction(
    opcode: Opcode,
    destination: Option<Destination>,
    sources: Vec<crate::program::Source>,
) -> Instruction {
    Instruction {
        opcode,
        co_issue: false,
        result: ResultModifier::NONE,
        destination,
        sources,
        span: HERE,
        mnemonic_span: HERE,
    }
}

/// A source of a texture instruction.
pub(super) fn texture_source(
    file: RegisterFile,
    index: u32,
    swizzle: Swizzle,
    modifier: SourceModifier,
) -> crate::program::Source {
    crate::program::Source {
        modifier,
        ..source(Register::new(file, index), swizzle)
    }
}

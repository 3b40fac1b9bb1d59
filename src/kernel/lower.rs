//! From a program to a kernel.

use super::texture_ops;
use super::{Kernel, LowerError, Op, Operand, Place, SLOT_COUNT, Slot, Step};
use crate::isa::{
    Class, FileSet, Form, MaskSet, Opcode, RegisterFile, ResultModifier, ShaderKind,
    SourceModifier, Swizzle, Version, WriteMask,
};
use crate::policy::{LogpLayout, Model, Policies};
use crate::program::{Destination, Instruction, Program, Register, Source};

/// What a kernel is made for, beside the shader itself.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// `D3DTTFF_PROJECTED` of each stage; honoured by `tex`, `texbem` and `texbeml`.
    pub projection: [Projection; 8],
    /// The numbers that a pixel shader computes with.
    pub model: Model,
    /// What instructions do where documents and hardware did not agree.
    pub policies: Policies,
}

/// Which component divides the coordinates of a stage before it is sampled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Projection {
    /// None.
    #[default]
    None,
    /// The third, as for coordinates with three components.
    Third,
    /// The fourth.
    Fourth,
}

/// Lowers a program.
///
/// A program that [`validate`](mod@crate::validate) accepts can always be lowered. One that it refuses can as long as
/// it has a meaning; order, budgets, read ports and initialisation do not matter here. A temporary that is read
/// before it is written reads 0, a `t#` that no texture instruction wrote reads its interpolated coordinates.
///
/// # Errors
/// [`LowerError`] for the first instruction that has no meaning: one that the version does not have, with operands
/// that it does not take, or with registers that do not exist.
pub fn lower(program: &Program, options: &Options) -> Result<Kernel, LowerError> {
    // vs.1.0 is vs.1.1 without the address register; whether a shader may use it is the validator's business.
    let version = match program.version {
        Version::Vs10 => Version::Vs11,
        version => version,
    };
    let mut lowering = Lowering::new(version, options);
    for def in program.definitions() {
        if def.register.file != RegisterFile::Const || def.register.relative {
            return Err(LowerError::new(def.register_span, "def defines a constant"));
        }
        constant(version, def.register)
            .map_err(|message| LowerError::new(def.register_span, message))?;
        lowering.definitions.push((def.register.index, def.value));
    }
    let instructions: Vec<&Instruction> = program.instructions().collect();
    for (origin, instruction) in instructions.iter().enumerate() {
        lowering.origin = origin;
        lowering
            .instruction(instruction)
            .map_err(|message| LowerError::new(instruction.span, message))?;
        let paired_with_next = instructions.get(origin + 1).is_some_and(|i| i.co_issue);
        if !paired_with_next {
            lowering.end_group();
        }
    }
    Ok(lowering.finish())
}

/// How many constants a vertex shader can name where there are more than the 96 of every device: software vertex
/// processing had this many.
pub const MOST_VERTEX_CONSTANTS: u32 = 256;

/// The limit of the constants that a shader can name at all.
fn constant(version: Version, register: Register) -> Result<u32, String> {
    // The 96 that every device has are the validator's business.
    let count = match version.kind() {
        ShaderKind::Vertex => MOST_VERTEX_CONSTANTS,
        ShaderKind::Pixel => RegisterFile::Const.count(version),
    };
    if register.index < count {
        Ok(register.index)
    } else {
        Err(format!("{version} has no constant {register}"))
    }
}

pub(super) struct Lowering<'a> {
    pub(super) version: Version,
    pub(super) options: &'a Options,
    definitions: Vec<(u32, [f32; 4])>,
    steps: Vec<Step>,
    /// Where the steps begin that read before any of them writes.
    group: usize,
    /// Whether the steps of the group run side by side; those of a texture instruction follow one another.
    parallel: bool,
    /// The numbers of the shader: floats for a vertex shader.
    model: Model,
    /// The instruction that is being lowered.
    origin: usize,
    /// Whether it is arithmetic.
    arithmetic: bool,
    /// Rows that `texm3x2pad` and `texm3x3pad` have left in [`Slot::ROW`] so far.
    pub(super) rows: usize,
}

impl<'a> Lowering<'a> {
    fn new(version: Version, options: &'a Options) -> Self {
        Self {
            version,
            options,
            definitions: Vec::new(),
            steps: Vec::new(),
            group: 0,
            parallel: true,
            model: match version.kind() {
                ShaderKind::Vertex => Model::Float,
                ShaderKind::Pixel => options.model,
            },
            origin: 0,
            arithmetic: false,
            rows: 0,
        }
    }

    /// Adds a step without result modifier.
    pub(super) fn push(
        &mut self,
        op: Op,
        destination: Slot,
        mask: WriteMask,
        sources: Vec<Operand>,
    ) {
        self.push_result(op, destination, mask, sources, ResultModifier::NONE);
    }

    pub(super) fn push_result(
        &mut self,
        op: Op,
        destination: Slot,
        mask: WriteMask,
        sources: Vec<Operand>,
        result: ResultModifier,
    ) {
        let (reads, writes) = self.numbers(op, destination);
        self.steps.push(Step {
            op,
            destination,
            mask,
            sources,
            result,
            reads,
            writes,
            held: false,
            origin: self.origin,
        });
    }

    /// The numbers that a step reads and writes.
    ///
    /// Arithmetic has those of the model. Coordinates and what is computed of them on the way to a sample are floats under
    /// every model. A register of the Radeon 8500 holds numbers of one kind, whoever writes them; the texture unit of the
    /// GeForce 3 hands floats to other texture instructions, and only the combiners, which read them, round.
    fn numbers(&self, op: Op, destination: Slot) -> (Model, Model) {
        match (op, self.model) {
            (Op::Kill | Op::Depth, _) => (Model::Float, Model::Float),
            // The factor of `texbeml` takes an arithmetic slot: it is a product of the combiners.
            (Op::Luminance(_), model) => (model, model),
            (_, model) if self.arithmetic => (model, model),
            (_, Model::R200) if !destination.is_internal() => (Model::Float, Model::R200),
            _ => (Model::Float, Model::Float),
        }
    }

    /// Ends the group of steps that read before any of them writes, and holds those whose result a later step of
    /// the group would otherwise see.
    fn end_group(&mut self) {
        let group = self.steps.get_mut(self.group..).unwrap_or_default();
        if self.parallel {
            let overwrites = |i: usize| {
                let step = &group[i];
                (group[i + 1..].iter()).any(|later| reads(later, step.destination, step.mask))
            };
            // What comes before a held step is held too, so that nothing is written while it waits.
            if let Some(last) = (0..group.len()).rev().find(|i| overwrites(*i)) {
                for step in &mut group[..=last] {
                    step.held = true;
                }
            }
        }
        self.group = self.steps.len();
        self.parallel = true;
    }

    fn instruction(&mut self, instruction: &Instruction) -> Result<(), String> {
        let opcode = instruction.opcode;
        let form = opcode
            .form(self.version)
            .ok_or_else(|| format!("{} has no {}", self.version, opcode.mnemonic()))?;
        if instruction.sources.len() != form.sources.len() {
            let (has, takes) = (instruction.sources.len(), form.sources.len());
            return Err(format!(
                "{} takes {takes} sources, not {has}",
                opcode.mnemonic()
            ));
        }
        let Some(shape) = form.destination else {
            return Ok(());
        };
        let destination = instruction
            .destination
            .ok_or_else(|| format!("{} needs a destination", opcode.mnemonic()))?;
        if destination.register.relative || !shape.files.contains(destination.register.file) {
            return Err(format!(
                "{} cannot have {} as destination",
                opcode.mnemonic(),
                destination.register
            ));
        }
        for (source, shape) in instruction.sources.iter().zip(form.sources) {
            if !may_name(form, shape.files, source.register.file) {
                return Err(format!(
                    "{} cannot read {} there",
                    opcode.mnemonic(),
                    source.register
                ));
            }
        }
        let slot = self.slot(destination.register)?;
        self.arithmetic = form.class == Class::Arithmetic;
        match form.class {
            Class::Texture => {
                self.parallel = false;
                texture_ops::lower(self, instruction, destination.register.index as usize, slot)
            }
            Class::Arithmetic => self.arithmetic(instruction, form, destination, slot),
            Class::Phase | Class::Declaration => Ok(()),
        }
    }

    fn arithmetic(
        &mut self,
        instruction: &Instruction,
        form: &Form,
        destination: Destination,
        slot: Slot,
    ) -> Result<(), String> {
        let mask = destination.mask;
        let sources = (instruction.sources.iter())
            .map(|s| self.operand(s))
            .collect::<Result<Vec<_>, _>>()?;
        if form.rows > 0 {
            return self.matrix(instruction, form, destination, slot, sources[0]);
        }
        let op = match instruction.opcode {
            Opcode::Mov if destination.register.file == RegisterFile::Addr => Op::Floor,
            Opcode::Mov => Op::Mov,
            Opcode::Add => Op::Add,
            Opcode::Sub => Op::Sub,
            Opcode::Mad => Op::Mad,
            Opcode::Mul => Op::Mul,
            Opcode::Lrp => Op::Lrp,
            Opcode::Min => Op::Min,
            Opcode::Max => Op::Max,
            Opcode::Slt => Op::Slt,
            Opcode::Sge => Op::Sge,
            Opcode::Frc => Op::Frc,
            Opcode::Cmp => Op::Cmp,
            Opcode::Cnd => Op::Cnd,
            Opcode::Dp3 => Op::Dp3,
            Opcode::Dp4 => Op::Dp4,
            Opcode::Lit => Op::Lit,
            Opcode::Dst => Op::Dst,
            Opcode::Rcp => Op::Rcp,
            Opcode::Rsq => Op::Rsq,
            Opcode::Exp => Op::Exp,
            Opcode::Log => Op::Log,
            Opcode::ExpP => Op::ExpP,
            Opcode::LogP => match self.options.policies.logp {
                LogpLayout::Parts => Op::LogP,
                LogpLayout::Logarithm => Op::Log,
            },
            Opcode::Bem => Op::Bump(stage(destination.register.index as usize)),
            other => return Err(format!("{} is no arithmetic", other.mnemonic())),
        };
        let sources = sources
            .into_iter()
            .enumerate()
            .map(|(i, s)| self.spread(instruction, form, i, s))
            .collect();
        self.push_result(op, slot, mask, sources, instruction.result);
        Ok(())
    }

    /// Operands of which an instruction uses one component only read that component in every slot.
    ///
    /// Scalar instructions take the w slot of the swizzled source, unless the policy says otherwise: the pseudo-code of the
    /// DirectX 8 documents does, and shipped programs relied on it. `cnd` before `ps.1.4` takes the alpha of `r0`.
    fn spread(
        &self,
        instruction: &Instruction,
        form: &Form,
        i: usize,
        mut operand: Operand,
    ) -> Operand {
        if form.slots_read(i, WriteMask::NONE) == WriteMask::W && instruction.opcode != Opcode::Dp4
        {
            let slot = match self.version.kind() {
                ShaderKind::Vertex => self.options.policies.scalar.slot(),
                ShaderKind::Pixel => 3,
            };
            operand.swizzle = Swizzle::replicate(operand.swizzle.slot(slot) as u8);
        }
        operand
    }

    /// A matrix macro: one dot product a row, all from the values before the first is written.
    ///
    /// Row `i` goes to component `i` where the mask has it; components beyond the rows keep their value, also
    /// under a wider mask than the documents ask for.
    fn matrix(
        &mut self,
        instruction: &Instruction,
        form: &Form,
        destination: Destination,
        slot: Slot,
        vector: Operand,
    ) -> Result<(), String> {
        let op = match instruction.opcode {
            Opcode::M4x4 | Opcode::M4x3 => Op::Dp4,
            _ => Op::Dp3,
        };
        for row in 0..form.rows {
            let mask = WriteMask::component(row as usize).and(destination.mask);
            if mask.is_empty() {
                continue;
            }
            let mut source = instruction.sources[1];
            source.register.index = source.register.index.saturating_add(row);
            let matrix = self.operand(&source)?;
            self.push_result(op, slot, mask, vec![vector, matrix], instruction.result);
        }
        Ok(())
    }

    /// The slot of a register.
    pub(super) fn slot(&self, register: Register) -> Result<Slot, String> {
        Slot::of(register, self.version)
            .ok_or_else(|| format!("{} has no {register}", self.version))
    }

    /// A source as an operand. Every modifier but the divide modifiers has a meaning everywhere; whether the version
    /// has it is the validator's business.
    pub(super) fn operand(&self, source: &Source) -> Result<Operand, String> {
        let register = source.register;
        let place = match register.file {
            RegisterFile::Const if !register.relative => {
                Place::Constant(constant(self.version, register)?)
            }
            RegisterFile::Const if self.version == Version::Vs11 => Place::Relative(register.index),
            _ if register.relative => {
                return Err(format!("{} cannot address {register}", self.version));
            }
            _ => Place::Slot(self.slot(register)?),
        };
        if is_divide(source.modifier) {
            let suffix = source.modifier.row().suffix;
            return Err(format!("{register}{suffix} is not divided here"));
        }
        Ok(Operand {
            place,
            swizzle: source.swizzle,
            modifier: source.modifier,
        })
    }

    fn finish(mut self) -> Kernel {
        let mut read = [WriteMask::NONE; SLOT_COUNT];
        let mut written = [WriteMask::NONE; SLOT_COUNT];
        let mut coordinates_as_texels = Vec::new();
        for step in &self.steps {
            for (i, operand) in step.sources.iter().enumerate() {
                let components = operand_reads(step, i, operand);
                if let Place::Relative(_) = operand.place {
                    let a0 = Slot::ADDRESS.index();
                    read[a0] = read[a0].or(WriteMask::X);
                }
                let Place::Slot(slot) = operand.place else {
                    continue;
                };
                let unwritten = components.without(written[slot.index()]);
                if let Some(set) = texcoord_of(slot)
                    && !unwritten.is_empty()
                    && !coordinates_as_texels.contains(&(set, slot))
                {
                    coordinates_as_texels.push((set, slot));
                }
                read[slot.index()] = read[slot.index()].or(components);
            }
            let at = step.destination.index();
            if step.op != Op::Kill {
                written[at] = written[at].or(step.mask);
            }
        }
        self.arithmetic = false;
        for (set, slot) in coordinates_as_texels {
            let (reads, writes) = self.numbers(Op::Mov, slot);
            let load = Step {
                op: Op::Mov,
                destination: slot,
                mask: WriteMask::ALL,
                sources: vec![Operand::slot(set)],
                result: ResultModifier::NONE,
                reads,
                writes,
                held: false,
                origin: 0,
            };
            self.steps.insert(0, load);
            read[set.index()] = WriteMask::ALL;
            written[slot.index()] = WriteMask::ALL;
        }
        let kind = self.version.kind();
        let presets = Slot::all()
            .filter(|slot| is_preset(*slot, kind, &read, &written))
            .map(|slot| (slot, slot.default_value()))
            .collect();
        Kernel {
            version: self.version,
            model: self.model,
            policies: self.options.policies,
            fog_component: scalar_component(written[Slot::FOG.index()]),
            point_size_component: scalar_component(written[Slot::POINT_SIZE.index()]),
            steps: self.steps,
            definitions: self.definitions,
            presets,
            written,
            read,
        }
    }
}

/// Whether a source has a meaning. Arithmetic that reads what it should not (coordinates in `ps.1.4`, colours in `bem`,
/// a condition of `cnd` that is not in `r0`) is against the rules and clear all the same.
fn may_name(form: &Form, files: FileSet, file: RegisterFile) -> bool {
    let holds_numbers = matches!(
        file,
        RegisterFile::Temp | RegisterFile::Input | RegisterFile::Const | RegisterFile::Texture
    );
    files.contains(file) || (form.class == Class::Arithmetic && form.rows == 0 && holds_numbers)
}

/// The components that a step reads of its source `i`.
fn operand_reads(step: &Step, i: usize, operand: &Operand) -> WriteMask {
    operand.swizzle.reads(step.op.slots_read(i, step.mask))
}

/// Whether a step reads any of these components of a slot.
fn reads(step: &Step, slot: Slot, mask: WriteMask) -> bool {
    (step.sources.iter().enumerate()).any(|(i, operand)| {
        operand.place == Place::Slot(slot) && !operand_reads(step, i, operand).and(mask).is_empty()
    })
}

/// The coordinate set with the number of a texture register.
fn texcoord_of(slot: Slot) -> Option<Slot> {
    let index = (0..4).find(|i| Slot::texture(*i) == Some(slot))?;
    Slot::texcoord(index)
}

/// Slots that hold something before the first step: temporaries that are used or returned, and all outputs.
fn is_preset(
    slot: Slot,
    kind: ShaderKind,
    read: &[WriteMask; SLOT_COUNT],
    written: &[WriteMask; SLOT_COUNT],
) -> bool {
    let used = !read[slot.index()].is_empty() || !written[slot.index()].is_empty();
    let temporary = (0..12).any(|i| Slot::temp(i) == Some(slot));
    let texel = (0..4).any(|i| Slot::texture(i) == Some(slot));
    let output = (0..8).any(|i| Slot::texcoord_output(i) == Some(slot))
        || (0..2).any(|i| Slot::color_output(i) == Some(slot))
        || [Slot::POSITION, Slot::FOG, Slot::POINT_SIZE].contains(&slot);
    match kind {
        ShaderKind::Vertex => output || ((temporary || slot == Slot::ADDRESS) && used),
        ShaderKind::Pixel => {
            ((temporary || texel || slot == Slot::ROW) && used) || slot == Slot::R0
        }
    }
}

/// `oFog` and `oPts` are one number: x, or the only component that is written.
fn scalar_component(written: WriteMask) -> usize {
    let single = MaskSet::of(&[WriteMask::Y, WriteMask::Z, WriteMask::W]);
    let component = written.components().next().unwrap_or(0);
    if single.contains(written) {
        component
    } else {
        0
    }
}

/// A texture stage as it is kept in an [`Op`].
pub(super) fn stage(index: usize) -> u8 {
    (index & 7) as u8
}

/// The divide modifiers belong to coordinates; arithmetic has none of them.
fn is_divide(modifier: SourceModifier) -> bool {
    modifier.row().divides.is_some()
}

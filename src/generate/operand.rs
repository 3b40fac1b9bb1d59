//! Choosing destinations and sources that the tables and the rules allow.

use super::maker::{HERE, Maker};
use crate::isa::opcode::{ModifierRule, Slots, SourceShape};
use crate::isa::register::OPOS;
use crate::isa::{
    Form, RegisterFile, ShaderKind, SourceModifier, Swizzle, Version, VersionSet, WriteMask,
};
use crate::program::{Destination, Register, Source};

/// How many registers of a file both halves of a pair may read together (R11).
const PORTS_OF_A_PAIR: usize = 3;

/// Which half of a pair an instruction is to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    Alone,
    Color,
    Alpha,
}

/// The registers that an instruction, and the half before it, read.
pub(super) struct Ports {
    version: Version,
    own: Vec<Register>,
    pair: Vec<Register>,
}

impl Ports {
    pub(super) fn new(version: Version) -> Self {
        Self {
            version,
            own: Vec::new(),
            pair: Vec::new(),
        }
    }

    /// Goes on to the second half of a pair.
    pub(super) fn next_half(&mut self) {
        self.own.clear();
    }

    pub(super) fn read(&mut self, register: Register) {
        for list in [&mut self.own, &mut self.pair] {
            if !list.contains(&register) {
                list.push(register);
            }
        }
    }

    /// Whether one more register is within the ports of the instruction and of the pair.
    fn allow(&self, register: Register) -> bool {
        let fits = |list: &[Register], most: usize| {
            let of_file = list.iter().filter(|r| r.file == register.file);
            list.contains(&register) || of_file.count() < most
        };
        let ports = register.file.read_ports(self.version) as usize;
        fits(&self.own, ports) && fits(&self.pair, PORTS_OF_A_PAIR)
    }
}

/// What a source is wanted for.
pub(super) struct Want {
    pub(super) shape: SourceShape,
    /// The slots that are used.
    pub(super) slots: WriteMask,
    pub(super) destination: Destination,
    /// Whether the destination may not be read.
    pub(super) apart: bool,
    /// Rows, of a matrix.
    pub(super) rows: u32,
    /// The vector that the matrix is multiplied with.
    pub(super) vector: Option<Register>,
}

impl Maker<'_> {
    /// The mask and register that an instruction writes.
    pub(super) fn destination(&mut self, form: &Form, role: Role) -> Option<Destination> {
        let shape = form.destination?;
        let fits = |mask: &WriteMask| match role {
            Role::Alone => true,
            Role::Alpha => *mask == WriteMask::W,
            Role::Color => !mask.has(3),
        };
        let masks: Vec<WriteMask> = shape.masks.iter().filter(fits).collect();
        let whole = masks.contains(&WriteMask::ALL) && !self.random.chance(self.weights().masks);
        let mask = if whole {
            WriteMask::ALL
        } else {
            self.random.pick(&masks)?
        };
        let files: Vec<(RegisterFile, u32)> = (shape.files.iter())
            .filter(|file| file.count(self.version) > 0)
            .map(|file| (file, file_weight(file)))
            .collect();
        let file = self.random.weighted(&files)?;
        let count = file.count(self.version);
        let index = match file {
            RegisterFile::Addr => {
                return Some(destination(Register::new(file, 0), WriteMask::X));
            }
            // oFog and oPts are one number, which a matrix or a mask without x does not give.
            RegisterFile::RastOut => {
                let number = form.rows == 0 && shape.masks.contains(WriteMask::X);
                if number && self.random.chance(50) {
                    let mask = if mask == WriteMask::ALL {
                        mask
                    } else {
                        WriteMask::X
                    };
                    let index = 1 + self.random.below(count - 1);
                    return Some(destination(Register::new(file, index), mask));
                }
                OPOS
            }
            // The low sets are wanted most: every gap below has to be filled.
            RegisterFile::TexCrdOut => {
                let end = 1 + self.random.below(count);
                self.random.below(end)
            }
            RegisterFile::Temp if self.random.chance(40) => 0,
            // Few registers are read again more often than many.
            RegisterFile::Temp if self.random.chance(70) => self.random.below(count.min(4)),
            _ => self.random.below(count),
        };
        Some(destination(Register::new(file, index), mask))
    }

    /// A source, or nothing if no register fits.
    pub(super) fn source(&mut self, want: &Want, ports: &mut Ports) -> Option<Source> {
        if want.shape.modifiers == ModifierRule::Matrix {
            return self.matrix(want);
        }
        let bare =
            self.weights().bare_scalars > 0 && self.random.chance(self.weights().bare_scalars);
        let mut candidates: Vec<(Register, u32)> = Vec::new();
        for file in want.shape.files.iter() {
            for index in self.numbers(file) {
                candidates.push((
                    Register::new(file, index),
                    source_weight(file, self.version),
                ));
            }
        }
        if let Some(relative) = self.relative(&want.shape) {
            candidates.push((relative, self.weights().relative));
        }
        candidates.retain(|(register, _)| {
            !(want.apart && *register == want.destination.register)
                && ports.allow(*register)
                && !self.swizzles(want, *register, bare).is_empty()
        });
        let register = self.random.weighted(&candidates)?;
        let swizzles = self.swizzles(want, register, bare);
        let plain = swizzles.contains(&Swizzle::IDENTITY);
        let swizzle = if plain && !self.random.chance(self.weights().swizzles) {
            Swizzle::IDENTITY
        } else {
            self.random.pick(&swizzles)?
        };
        ports.read(register);
        Some(Source {
            register,
            swizzle,
            modifier: self.modifier(register),
            span: HERE,
        })
    }

    /// The numbers of a file that sources are chosen from.
    fn numbers(&self, file: RegisterFile) -> Vec<u32> {
        match file {
            RegisterFile::Const => self.constants.pool.clone(),
            _ => (0..file.count(self.version)).collect(),
        }
    }

    /// A constant by way of `a0.x`, in and out of the range there is.
    fn relative(&mut self, shape: &SourceShape) -> Option<Register> {
        if !self.registers.address || !shape.files.contains(RegisterFile::Const) {
            return None;
        }
        let count = RegisterFile::Const.count(self.version);
        let index = match self.random.below(4) {
            0 => self.random.below(4),
            1 => count - self.random.below(4),
            _ => self.random.below(count),
        };
        Some(Register {
            file: RegisterFile::Const,
            index,
            relative: true,
        })
    }

    /// The swizzles with which a register can be read there; of vertex shaders a few of them. `bare`: scalar instructions, too,
    /// have any.
    fn swizzles(&self, want: &Want, register: Register, bare: bool) -> Vec<Swizzle> {
        let readable = self.registers.readable(register);
        let one = |c: usize| Swizzle::replicate(c as u8);
        let mut swizzles: Vec<Swizzle> = match (self.version.kind(), self.version) {
            (ShaderKind::Vertex, _) => {
                let scalar = want.shape.slots == Slots::Fixed(WriteMask::W) && !bare;
                let mut some: Vec<Swizzle> = readable.components().map(one).collect();
                if !scalar {
                    some.push(Swizzle::IDENTITY);
                    some.extend(self.turned.iter().copied());
                }
                some
            }
            (_, Version::Ps14) => {
                let mut all: Vec<Swizzle> = (0..4).map(one).collect();
                all.push(Swizzle::IDENTITY);
                all
            }
            (_, version) => {
                let mut some = vec![Swizzle::IDENTITY, one(3)];
                if version != Version::Ps10 && want.destination.mask == WriteMask::W {
                    some.push(one(2));
                }
                some
            }
        };
        // Which slot a scalar instruction reads is a choice: both hold something.
        let slots = match want.shape.slots {
            Slots::Fixed(WriteMask::W) => want.slots.or(WriteMask::X),
            _ => want.slots,
        };
        swizzles.retain(|swizzle| readable.contains(swizzle.reads(slots)));
        swizzles
    }

    /// A modifier that the version has; constants of pixel shaders take none (M5, M6).
    fn modifier(&mut self, register: Register) -> SourceModifier {
        let pixel = self.version.kind() == ShaderKind::Pixel;
        if (pixel && register.file == RegisterFile::Const)
            || !self.random.chance(self.weights().modifiers)
        {
            return SourceModifier::None;
        }
        let version = self.version;
        let fits =
            |m: &SourceModifier| *m != SourceModifier::None && m.row().arithmetic.contains(version);
        let modifiers: Vec<SourceModifier> = SourceModifier::all().filter(fits).collect();
        self.random.pick(&modifiers).unwrap_or_default()
    }

    /// The first row of a matrix: so many registers that are all readable and none of them the destination.
    fn matrix(&mut self, want: &Want) -> Option<Source> {
        let vector = want.vector?;
        let mut candidates: Vec<(Register, u32)> = Vec::new();
        for file in want.shape.files.iter() {
            // Each row reads the vector, too: the file has one port for both (R1, R2).
            if file == vector.file && file.read_ports(self.version) < 2 {
                continue;
            }
            let last = file.count(self.version).saturating_sub(want.rows);
            for index in self.numbers(file) {
                let first = Register::new(file, index.min(last));
                let row = |row: u32| Register::new(file, first.index + row);
                let fits = (0..want.rows).map(row).all(|register| {
                    register != want.destination.register
                        && self.registers.readable(register).contains(want.slots)
                });
                if fits {
                    candidates.push((first, source_weight(file, self.version)));
                }
            }
        }
        if vector.file != RegisterFile::Const
            && let Some(relative) = self.relative(&want.shape)
        {
            candidates.push((relative, self.weights().relative));
        }
        let register = self.random.weighted(&candidates)?;
        Some(source(register, Swizzle::IDENTITY))
    }
}

/// How often a file is written, among those that an instruction may write.
fn file_weight(file: RegisterFile) -> u32 {
    match file {
        RegisterFile::Temp => 50,
        RegisterFile::Texture => 10,
        RegisterFile::Addr => 15,
        _ => 12,
    }
}

/// How often a register of a file is read, among those that an instruction may read.
fn source_weight(file: RegisterFile, version: Version) -> u32 {
    match file {
        RegisterFile::Temp | RegisterFile::Texture => 24,
        RegisterFile::Input if VersionSet::VS.contains(version) => 4,
        RegisterFile::Input => 16,
        _ => 4,
    }
}

/// A destination without a place in a text.
pub(super) fn destination(register: Register, mask: WriteMask) -> Destination {
    Destination {
        register,
        mask,
        span: HERE,
    }
}

/// A source without modifier and without a place in a text.
pub(super) fn source(register: Register, swizzle: Swizzle) -> Source {
    Source {
        register,
        swizzle,
        modifier: SourceModifier::None,
        span: HERE,
    }
}

//! The values that a listing is run with by hand.

use super::moment::{InputSource, Quad};
use super::record::Input;
use crate::isa::{RegisterFile, ShaderKind, Version};
use crate::kernel::{Kernel, MOST_VERTEX_CONSTANTS, Slot};
use crate::semantics;
use std::fmt;

/// Inputs and constants of a listing, set by name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Given {
    /// The inputs, as they were given.
    pub inputs: Vec<(Slot, [f32; 4])>,
    /// The constants, in the order in which they were given; the last of one number counts.
    pub constants: Vec<(u32, [f32; 4])>,
}

/// Why a value was not taken.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum GivenError {
    /// Only `v#`, `t#` and `c#` can be given.
    Name,
    /// The version has no such register.
    NoRegister {
        /// The version.
        version: Version,
        /// The register.
        name: String,
    },
    /// There are not one to four numbers.
    Numbers,
}

impl fmt::Display for GivenError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Name => f.write_str("v#, t# and c# can be set"),
            Self::NoRegister { version, name } => write!(f, "{version} has no {name}"),
            Self::Numbers => f.write_str("one to four numbers stand behind the `=`"),
        }
    }
}

impl std::error::Error for GivenError {}

impl Given {
    /// Gives a register a value: `v#`, `t#` (texture coordinates) or `c#`. One number fills all four components; of two or three
    /// the rest is 0, 0, 1 as for vertex data.
    ///
    /// # Errors
    /// [`GivenError`].
    pub fn set(&mut self, version: Version, name: &str, numbers: &[f32]) -> Result<(), GivenError> {
        let value = match *numbers {
            [x] => [x; 4],
            [x, y] => [x, y, 0.0, 1.0],
            [x, y, z] => [x, y, z, 1.0],
            [x, y, z, w] => [x, y, z, w],
            _ => return Err(GivenError::Numbers),
        };
        let (file, index) = RegisterFile::named(name.trim()).ok_or(GivenError::Name)?;
        let given = [
            RegisterFile::Input,
            RegisterFile::Texture,
            RegisterFile::Const,
        ];
        if !given.contains(&file) {
            return Err(GivenError::Name);
        }
        if index >= most(file, version) {
            return Err(GivenError::NoRegister {
                version,
                name: file.register_name(index),
            });
        }
        let slot = match file {
            RegisterFile::Const => {
                self.constants.push((index, value));
                return Ok(());
            }
            RegisterFile::Input => Slot::input(index as usize),
            _ => Slot::texcoord(index as usize),
        };
        self.inputs.extend(slot.map(|slot| (slot, value)));
        Ok(())
    }

    /// The inputs that a kernel reads. What is not given is (0, 0, 0, 1), as what no vertex element feeds; colours reach a pixel
    /// shader clamped to 0…1.
    pub fn inputs(&self, kernel: &Kernel) -> Vec<Input> {
        let pixel = kernel.version.kind() == ShaderKind::Pixel;
        let input = |slot: &Slot| {
            let given = self.inputs.iter().rev().find(|(other, _)| other == slot);
            let raw = given.map_or([0.0, 0.0, 0.0, 1.0], |(_, value)| *value);
            let clamped = pixel && slot.input_index().is_some();
            let value = if clamped {
                raw.map(semantics::saturate)
            } else {
                raw
            };
            let (raw, value): (Quad, Quad) = ([raw; 4], [value; 4]);
            Input {
                slot: *slot,
                source: InputSource::Given,
                raw,
                value,
            }
        };
        let slots = (0..)
            .map_while(Slot::input)
            .chain((0..).map_while(Slot::texcoord));
        let read: Vec<Slot> = slots
            .filter(|slot| !kernel.read(*slot).is_empty())
            .collect();
        read.iter().map(input).collect()
    }
}

/// How many registers of a file can be set. Vertex shaders can name constants up to 255, where a device has them.
fn most(file: RegisterFile, version: Version) -> u32 {
    match (file, version.kind()) {
        (RegisterFile::Const, ShaderKind::Vertex) => MOST_VERTEX_CONSTANTS,
        _ => file.count(version),
    }
}

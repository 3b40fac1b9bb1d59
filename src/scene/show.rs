//! `r2@12`: which registers to picture, as people write it.

use super::Scene;
use super::prepare::PreparedDraw;
use crate::diagnostic::SourceMap;
use crate::isa::operand::{RGBA, XYZW};
use crate::isa::{Opcode, RegisterFile, Version, WriteMask};
use crate::kernel::{Kernel, Op, Place, Slot};
use crate::program::{Instruction, Register};
use crate::raster::{Look, RegisterPicture};
use crate::sheet::Tile;
use std::fmt;
use std::str::FromStr;

/// What is to be pictured: a register at a place of a pixel shader, such as `r2@12`, `r0.a` or `oT5`, or `all`.
#[derive(Clone, Debug, PartialEq)]
pub struct ShowExpression {
    /// As it was written.
    text: String,
    what: What,
}

#[derive(Clone, Debug, PartialEq)]
enum What {
    /// After each instruction what it wrote.
    All,
    Register {
        file: RegisterFile,
        index: u32,
        components: WriteMask,
        /// The line of the instruction after which it is looked at; none: at the end.
        line: Option<usize>,
    },
}

/// Why something cannot be pictured.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WrongShow(String);

impl fmt::Display for WrongShow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for WrongShow {}

impl fmt::Display for ShowExpression {
    /// As it was written.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

impl FromStr for ShowExpression {
    type Err = WrongShow;

    fn from_str(text: &str) -> Result<Self, WrongShow> {
        let what = if text.eq_ignore_ascii_case("all") {
            What::All
        } else {
            register(text).ok_or_else(|| {
                WrongShow(format!(
                    "`{text}` is no register at a line: write r2@12, r0.a, r1.rg, t5, v0 or oT5, or all for one after \
                     each instruction"
                ))
            })?
        };
        Ok(Self {
            text: text.to_owned(),
            what,
        })
    }
}

/// A register with its components and its line.
fn register(text: &str) -> Option<What> {
    let (register, line) = match text.split_once('@') {
        Some((register, line)) => (register, Some(line.parse().ok()?)),
        None => (text, None),
    };
    let (name, components) = match register.split_once('.') {
        Some((name, letters)) => (name, mask(letters, XYZW).or_else(|| mask(letters, RGBA))?),
        None => (register, WriteMask::XYZ),
    };
    let files = [
        RegisterFile::TexCrdOut,
        RegisterFile::AttrOut,
        RegisterFile::Temp,
        RegisterFile::Texture,
        RegisterFile::Input,
    ];
    let (file, index) = RegisterFile::named(name).filter(|(file, _)| files.contains(file))?;
    Some(What::Register {
        file,
        index,
        components,
        line,
    })
}

/// Components by their letters, in the order of a write mask.
fn mask(text: &str, letters: [char; 4]) -> Option<WriteMask> {
    let mut mask = WriteMask::NONE;
    let mut next = 0;
    for letter in text.chars() {
        let at = letters
            .iter()
            .position(|l| *l == letter)
            .filter(|at| *at >= next)?;
        mask = mask.or(WriteMask::component(at));
        next = at + 1;
    }
    Some(mask).filter(|mask| !mask.is_empty())
}

impl ShowExpression {
    /// Whether it stands for a picture after each instruction.
    pub fn is_all(&self) -> bool {
        self.what == What::All
    }

    /// What it stands for in the pixel shader of a draw: one tile, or one for each instruction. `look` says how, its
    /// components apart; `killed` is [`RegisterPicture::killed`].
    ///
    /// Outputs of the vertex shader are those that reach the pixel: interpolated. After an instruction what it wrote is
    /// shown; of `texkill` the register that it tests, with the pixels marked that it discards, and of an instruction that
    /// only begins a matrix what the matrix has so far. `phase` and `nop` have no tile.
    ///
    /// # Errors
    /// [`WrongShow`] for registers that the version does not have, and for lines without an instruction.
    pub fn tiles(
        &self,
        scene: &Scene,
        draw: &PreparedDraw<'_>,
        look: Look,
        killed: bool,
    ) -> Result<Vec<Tile>, WrongShow> {
        let sources = scene.sources();
        let (program, kernel) = (&draw.pixel.program, &draw.pixel.kernel);
        let with = |components| Look { components, ..look };
        match self.what {
            What::All => {
                let instructions = program.instructions().enumerate();
                let tile = |(number, instruction): (usize, &Instruction)| {
                    let (slot, components) = result(kernel, number, instruction)?;
                    let line = line_of(sources, instruction);
                    Some(Tile {
                        caption: format!("{line} {}", instruction.text(sources)),
                        picture: RegisterPicture {
                            slot,
                            instructions: number + 1,
                            look: with(components),
                            killed: killed || instruction.opcode == Opcode::TexKill,
                        },
                    })
                };
                Ok(instructions.filter_map(tile).collect())
            }
            What::Register {
                file,
                index,
                components,
                line,
            } => {
                let lines: Vec<_> = (program.instructions())
                    .map(|instruction| line_of(sources, instruction))
                    .collect();
                let instructions = match line {
                    None => usize::MAX,
                    Some(line) if lines.contains(&line) => {
                        lines.iter().filter(|other| **other <= line).count()
                    }
                    Some(line) => return Err(no_instruction(line, &lines)),
                };
                let picture = RegisterPicture {
                    slot: slot(program.version, file, index)?,
                    instructions,
                    look: with(components),
                    killed,
                };
                let caption = self.text.clone();
                Ok(vec![Tile { caption, picture }])
            }
        }
    }
}

fn line_of(sources: &SourceMap, instruction: &Instruction) -> usize {
    sources.locate(instruction.span).map_or(0, |at| at.line)
}

/// Names the instructions on both sides of a line that has none.
fn no_instruction(line: usize, lines: &[usize]) -> WrongShow {
    let before = lines.iter().filter(|other| **other < line).max();
    let after = lines.iter().filter(|other| **other > line).min();
    WrongShow(match (before, after) {
        (Some(before), Some(after)) => format!(
            "line {line} is no instruction; the one before it is on line {before}, the one after it on line {after}"
        ),
        (Some(before), None) => {
            format!("line {line} is no instruction; the last one is on line {before}")
        }
        (None, Some(after)) => {
            format!("line {line} is no instruction; the first one is on line {after}")
        }
        (None, None) => "the listing has no instruction".to_string(),
    })
}

/// Where a pixel shader of this version has a register.
fn slot(version: Version, file: RegisterFile, index: u32) -> Result<Slot, WrongShow> {
    let number = index as usize;
    let (slot, whose) = match file {
        RegisterFile::TexCrdOut => (Slot::texcoord(number), "a vertex shader".to_string()),
        RegisterFile::AttrOut => {
            let color = Slot::input(number).filter(|_| number < 2);
            (color, "a vertex shader".to_string())
        }
        file => (
            Slot::of(Register::new(file, index), version),
            version.to_string(),
        ),
    };
    slot.ok_or_else(|| WrongShow(format!("{whose} has no {}", file.register_name(index))))
}

/// What there is to see after an instruction: the register that it wrote, and the components.
fn result(kernel: &Kernel, number: usize, instruction: &Instruction) -> Option<(Slot, WriteMask)> {
    if matches!(instruction.opcode, Opcode::Phase | Opcode::Nop) {
        return None;
    }
    let own = || {
        kernel
            .steps
            .iter()
            .filter(move |step| step.origin == number)
    };
    let last = own().next_back()?;
    if last.op == Op::Kill {
        let tested = last.sources.first()?;
        return match tested.place {
            Place::Slot(slot) => Some((slot, WriteMask::XYZ)),
            Place::Constant(_) | Place::Relative(_) | Place::Literal(_) => None,
        };
    }
    let slot = last.destination;
    let masks = own().filter(|step| step.destination == slot);
    Some((
        slot,
        masks.fold(WriteMask::NONE, |mask, step| mask.or(step.mask)),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(text: &str) -> What {
        text.parse::<ShowExpression>().unwrap().what
    }

    fn slot_in(text: &str, version: Version) -> Option<Slot> {
        let What::Register { file, index, .. } = parsed(text) else {
            return None;
        };
        slot(version, file, index).ok()
    }

    fn components(text: &str) -> u8 {
        let What::Register { components, .. } = parsed(text) else {
            return 0;
        };
        (components.components()).fold(0, |bits, component| bits | 1 << component)
    }

    #[test]
    fn registers_and_places() {
        assert_eq!(parsed("ALL"), What::All);
        assert!(matches!(
            parsed("r2@12"),
            What::Register { line: Some(12), .. }
        ));
        assert_eq!(slot_in("r2@12", Version::Ps14), Slot::temp(2));
        assert_eq!(slot_in("r5", Version::Ps11), None);
        assert_eq!(slot_in("oT9", Version::Ps14), None);
        assert_eq!(slot_in("oT5", Version::Ps14), Slot::texcoord(5));
        assert_eq!(slot_in("t1", Version::Ps14), Slot::texcoord(1));
        assert_eq!(slot_in("t1", Version::Ps11), Slot::texture(1));
        assert_eq!(slot_in("OD1.a", Version::Ps11), Slot::input(1));
        for (text, bits) in [
            ("r0", 0b0111),
            ("oD1.a", 0b1000),
            ("r0.rg", 0b0011),
            ("r0.xz@3", 0b0101),
            ("r0.rgba", 0b1111),
        ] {
            assert_eq!(components(text), bits, "{text}");
        }
    }

    #[test]
    fn everything_else_is_refused() {
        for text in [
            "", "r", "x0", "r2@", "r2@x", "r0.q", "r0.yx", "r0.xx", "r0.xg", "r0.", "c0", "oPos",
            "oD2.x.y", "é0", "all@3",
        ] {
            let parsed = text.parse::<ShowExpression>();
            assert!(parsed.is_err(), "{text}: {parsed:?}");
        }
    }

    #[test]
    fn lines_without_an_instruction_are_told_of() {
        let told = |line| no_instruction(line, &[3, 4, 4, 9]).to_string();
        assert!(told(2).contains("the first one is on line 3"));
        assert!(told(6).contains("line 4, the one after it on line 9"));
        assert!(told(12).contains("the last one is on line 9"));
    }
}

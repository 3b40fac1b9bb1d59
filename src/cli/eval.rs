//! `eval`: one invocation on the CPU.

use super::shaders::{Reading, not_one};
use super::{Failure, Format, Outcome, diagnostics, print, print_json};
use serde_json::{Map, Value, json};
use texcrd::diagnostic::{SourceMap, any_error};
use texcrd::exec::{Environment, Machine, Trace, bind_constants};
use texcrd::isa::{RegisterFile, ShaderKind, Version, WriteMask};
use texcrd::kernel::{self, Kernel, Slot};
use texcrd::program::{Instruction, Program};

/// Runs a listing once, with values set by hand, and prints its registers.
///
/// No texture is bound: a sample is opaque black, as Direct3D 8 had it.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  texcrd eval shader.psh --set t0=0.5,0.25,0,1 --set c1=1,0,0,1
  texcrd eval shader.vsh --set v0=1,2,3 --trace
  echo 'ps.1.1 mul r0, v0, c0' | texcrd eval - --set v0=1 --set c0=0.5 --format json")]
pub(super) struct Arguments {
    /// A listing, or a file with shaders in it; `-` is standard input.
    #[arg(value_name = "FILE")]
    file: String,
    /// Sets an input or a constant: v#, t# (texture coordinates) or c#. One number fills all four components; of
    /// two or three the rest is 0, 0, 1 as for vertex data.
    #[arg(
        long = "set",
        value_name = "REG=X[,Y[,Z[,W]]]",
        allow_hyphen_values = true
    )]
    set: Vec<String>,
    /// Print what every instruction wrote.
    #[arg(long)]
    trace: bool,
    /// How results are written.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
    #[command(flatten)]
    reading: Reading,
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    let mut sources = SourceMap::new();
    let path = &arguments.file;
    let opened = arguments.reading.open(&mut sources, path)?;
    let (all, found) = arguments
        .reading
        .check_all(&mut sources, path, &opened, false)?;
    let [checked] = &all[..] else {
        if opened.shaders.is_empty() {
            anstream::eprint!("{}", diagnostics::render(&sources, &found));
        }
        return Err(not_one(&opened, path));
    };
    anstream::eprint!("{}", diagnostics::render(&sources, &found));
    let program = checked.program.as_ref().filter(|_| !any_error(&found));
    let Some(program) = program else {
        return Err(match diagnostics::summary(&found) {
            Some(summary) if any_error(&found) => Failure::Input(summary),
            _ => Failure::Rejected,
        });
    };
    let kernel = kernel::lower(program, &kernel::Options::default())
        .map_err(|e| Failure::Input(e.to_string()))?;

    let mut machine = Machine::<1>::new();
    let constants = load(&arguments.set, program.version, &mut machine)?;
    let environment = Environment {
        constants: bind_constants(&kernel, &constants),
        ..Default::default()
    };
    let trace = Trace::record(&mut machine, &kernel, &environment, 0);
    let run = Run {
        sources: &sources,
        program,
        kernel: &kernel,
        machine: &machine,
        trace: &trace,
    };
    match arguments.format {
        Format::Json => print_json(&run.json(arguments.trace)),
        Format::Text => print(&run.text(arguments.trace)),
    }
}

/// Loads the inputs and returns the constants.
fn load(
    settings: &[String],
    version: Version,
    machine: &mut Machine<1>,
) -> Result<Vec<(u32, [f32; 4])>, Failure> {
    for i in 0..16 {
        // What no vertex element feeds reads (0, 0, 0, 1).
        for slot in [Slot::input(i), Slot::texcoord(i)].into_iter().flatten() {
            machine.load(slot, [0.0, 0.0, 0.0, 1.0]);
        }
    }
    let mut constants = Vec::new();
    for setting in settings {
        let wrong = |why: &str| Failure::Io(format!("--set {setting}: {why}"));
        let (name, numbers) = setting
            .split_once('=')
            .ok_or_else(|| wrong("write it as v0=1,2,3,4"))?;
        let value =
            value(numbers).ok_or_else(|| wrong("one to four numbers stand behind the `=`"))?;
        let (file, index) =
            register(name.trim()).ok_or_else(|| wrong("v#, t# and c# can be set"))?;
        if index >= most(file, version) {
            return Err(wrong(&format!(
                "{version} has no {}",
                file.register_name(index)
            )));
        }
        let slot = match file {
            RegisterFile::Const => {
                constants.push((index, value));
                continue;
            }
            RegisterFile::Input => Slot::input(index as usize),
            _ => Slot::texcoord(index as usize),
        };
        // Interpolated colours reach a pixel shader clamped.
        let clamped = file == RegisterFile::Input && version.kind() == ShaderKind::Pixel;
        let value = if clamped {
            value.map(texcrd::semantics::saturate)
        } else {
            value
        };
        if let Some(slot) = slot {
            machine.load(slot, value);
        }
    }
    Ok(constants)
}

/// How many registers of a file can be set. Vertex shaders can name constants up to 255, where a device has them.
fn most(file: RegisterFile, version: Version) -> u32 {
    match (file, version.kind()) {
        (RegisterFile::Const, ShaderKind::Vertex) => kernel::MOST_VERTEX_CONSTANTS,
        _ => file.count(version),
    }
}

fn register(name: &str) -> Option<(RegisterFile, u32)> {
    let files = [
        RegisterFile::Input,
        RegisterFile::Texture,
        RegisterFile::Const,
    ];
    files.into_iter().find_map(|file| {
        let (prefix, index) = name.split_at_checked(file.row().prefix.len())?;
        let fits = prefix.eq_ignore_ascii_case(file.row().prefix);
        Some((file, index.parse().ok().filter(|_| fits)?))
    })
}

fn value(numbers: &str) -> Option<[f32; 4]> {
    let numbers: Vec<f32> = (numbers.split(','))
        .map(|n| n.trim().parse().ok())
        .map(|n: Option<f32>| n.filter(|n| n.is_finite() || !numbers.contains(char::is_numeric)))
        .collect::<Option<_>>()?;
    match *numbers.as_slice() {
        [x] => Some([x; 4]),
        [x, y] => Some([x, y, 0.0, 1.0]),
        [x, y, z] => Some([x, y, z, 1.0]),
        [x, y, z, w] => Some([x, y, z, w]),
        _ => None,
    }
}

/// A finished run, ready to be told.
struct Run<'a> {
    sources: &'a SourceMap,
    program: &'a Program,
    kernel: &'a Kernel,
    machine: &'a Machine<1>,
    trace: &'a Trace,
}

/// What one instruction wrote, one entry a register.
struct Written<'a> {
    instruction: &'a Instruction,
    line: usize,
    registers: Vec<(Slot, WriteMask, [f32; 4])>,
}

impl Run<'_> {
    fn kind(&self) -> ShaderKind {
        self.kernel.version.kind()
    }

    /// The registers that a listing can name and that the run wrote, and the result in any case.
    fn registers(&self) -> impl Iterator<Item = (String, [f32; 4])> {
        let result = (self.kind() == ShaderKind::Pixel).then_some(Slot::R0);
        Slot::all()
            .filter(|slot| !slot.is_internal())
            .filter(move |slot| Some(*slot) == result || !self.kernel.written(*slot).is_empty())
            .map(|slot| (slot.name(self.kind()), self.machine.lane(slot, 0)))
    }

    fn depth(&self) -> Option<f32> {
        self.kernel
            .writes_depth()
            .then(|| self.machine.lane(Slot::DEPTH, 0)[0])
    }

    /// Instruction by instruction, those included that wrote nothing.
    fn steps(&self) -> impl Iterator<Item = Written<'_>> {
        self.program
            .instructions()
            .enumerate()
            .map(|(number, instruction)| {
                let mut registers: Vec<(Slot, WriteMask, [f32; 4])> = Vec::new();
                let named = |slot: Slot| !slot.is_internal() || slot == Slot::DEPTH;
                let changes = self.trace.changes.iter();
                for change in changes.filter(|c| c.instruction == number && named(c.slot)) {
                    match registers.iter_mut().find(|(slot, ..)| *slot == change.slot) {
                        Some((_, mask, value)) => {
                            *mask = mask.or(change.mask);
                            *value = change.after;
                        }
                        None => registers.push((change.slot, change.mask, change.after)),
                    }
                }
                let line = self
                    .sources
                    .locate(instruction.span)
                    .map_or(0, |at| at.line);
                Written {
                    instruction,
                    line,
                    registers,
                }
            })
    }

    /// The text of an instruction on one line.
    fn instruction_text(&self, instruction: &Instruction) -> String {
        let text = self.sources.text(instruction.span);
        let plus = if instruction.co_issue { "+" } else { "" };
        let words: Vec<_> = text.split_whitespace().collect();
        format!("{plus}{}", words.join(" "))
    }

    fn text(&self, with_trace: bool) -> String {
        let mut out = String::new();
        if with_trace {
            for step in self.steps() {
                let text = self.instruction_text(step.instruction);
                out.push_str(&format!("{:>4}  {text}\n", step.line));
                for (slot, mask, value) in &step.registers {
                    let components = if *slot == Slot::DEPTH {
                        String::new()
                    } else {
                        self.mask(*mask)
                    };
                    let name = format!("{}{components}", slot.name(self.kind()));
                    out.push_str(&format!("      {name:<12} = {}\n", numbers(*value, *mask)));
                }
            }
            out.push('\n');
        }
        for (name, value) in self.registers() {
            out.push_str(&format!("{name:<5} = {}\n", numbers(value, WriteMask::ALL)));
        }
        if let Some(depth) = self.depth() {
            out.push_str(&format!("depth = {depth}\n"));
        }
        if let Some(instruction) = self
            .trace
            .killed_by
            .and_then(|i| self.program.instructions().nth(i))
        {
            let text = self.instruction_text(instruction);
            out.push_str(&format!("killed by {text}\n"));
        }
        out
    }

    fn mask(&self, mask: WriteMask) -> String {
        mask.text(self.program.letters())
    }

    fn json(&self, with_trace: bool) -> Value {
        let registers: Map<String, Value> = self
            .registers()
            .map(|(name, value)| (name, json_vector(value)))
            .collect();
        let mut object = json!({
            "registers": registers,
            "killed": self.trace.killed_by.is_some(),
            "depth": self.depth().map(json_number),
        });
        if with_trace {
            let steps: Vec<Value> = self
                .steps()
                .map(|step| {
                    let value = |slot: Slot, value: [f32; 4]| match slot {
                        Slot::DEPTH => json_number(value[0]),
                        _ => json_vector(value),
                    };
                    let writes: Map<String, Value> = (step.registers.iter())
                        .map(|(slot, _, written)| (slot.name(self.kind()), value(*slot, *written)))
                        .collect();
                    json!({
                        "line": step.line,
                        "text": self.instruction_text(step.instruction),
                        "writes": writes,
                    })
                })
                .collect();
            object["trace"] = Value::Array(steps);
        }
        object
    }
}

/// The components of a mask in the shortest form that reads back to the same bits.
fn numbers(value: [f32; 4], mask: WriteMask) -> String {
    let texts: Vec<String> = mask.components().map(|c| value[c].to_string()).collect();
    texts.join(", ")
}

/// JSON has no infinities and no NaN; they are written as strings.
pub(super) fn json_number(number: f32) -> Value {
    let text = number.to_string();
    // Through its text, so that the shortest form that reads back to the same 32 bits is printed.
    match text.parse::<f64>() {
        Ok(double) if double.is_finite() => json!(double),
        _ => json!(text),
    }
}

/// As [`json_number`].
pub(super) fn json_vector(value: [f32; 4]) -> Value {
    Value::Array(value.into_iter().map(json_number).collect())
}

//! `eval`: one invocation on the CPU.

mod several;

use super::computing::Several;
use super::given::{self, Runnable};
use super::shaders::Reading;
use super::{Failure, Format, Outcome, diagnostics, print, print_json};
use serde_json::{Map, Value, json};
use texcrd::debug::Given;
use texcrd::diagnostic::SourceMap;
use texcrd::exec::{Environment, Machine, Trace, bind_constants};
use texcrd::isa::{ShaderKind, Version, WriteMask};
use texcrd::kernel::{self, Kernel, Slot};
use texcrd::program::{Instruction, Program};
use texcrd::validate;

/// Runs a listing once, with values set by hand, and prints its registers.
///
/// No texture is bound: a sample is opaque black, as Direct3D 8 had it.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  texcrd eval shader.psh --set t0=0.5,0.25,0,1 --set c1=1,0,0,1
  texcrd eval shader.vsh --set v0=1,2,3 --trace
  texcrd eval shader.psh --set v0=0.5 --trace --model gf3,float    where the two part first
  echo 'ps.1.1 mul r0, v0, c0' | texcrd eval - --set v0=1 --set c0=0.5 --format json")]
pub(super) struct Arguments {
    /// A listing, or a file with shaders in it, all of which are run; `-` is standard input.
    #[arg(value_name = "FILE")]
    file: String,
    /// Sets an input or a constant: v#, t# (texture coordinates) or c#. One number fills all four components; of
    /// two or three the rest is 0, 0, 1 as for vertex data. Of several shaders those take it that have the register.
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
    computing: Several,
    #[command(flatten)]
    reading: Reading,
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    let models = arguments.computing.models();
    let first = models.first().copied().unwrap_or_default();
    let options = arguments.computing.lowering(first);
    let all = given::load_all(&arguments.file, &arguments.reading, &options)?;
    let versions: Vec<Version> = all.shaders.iter().map(|s| s.program.version).collect();
    let given = given::given_each(&arguments.set, &versions)?;
    let several = all.shaders.len() > 1 || all.refused;
    for (shader, given) in all.shaders.into_iter().zip(&given) {
        let Runnable {
            name,
            program,
            kernel,
        } = shader;
        let set = given.constants.iter().map(|(number, _)| *number);
        let unset = validate::unset_constants(&program, set);
        anstream::eprint!("{}", diagnostics::render(&all.sources, &unset));
        let listing = Listing {
            sources: &all.sources,
            program: &program,
        };
        let mut runs = vec![Run::new(listing, kernel, given)];
        for model in models.iter().skip(1) {
            let kernel = kernel::lower(&program, &arguments.computing.lowering(*model))
                .map_err(|e| Failure::Input(e.to_string()))?;
            runs.push(Run::new(listing, kernel, given));
        }
        tell(arguments, &runs, several.then_some(&name))?;
    }
    match all.refused {
        true => Err(Failure::Rejected),
        false => Ok(()),
    }
}

/// Prints the runs of a shader, one a model; `name`: what it is called, if it is one of several.
fn tell(arguments: &Arguments, runs: &[Run<'_>], name: Option<&String>) -> Outcome {
    if arguments.format == Format::Json {
        let mut object = match runs {
            [run] => run.json(arguments.trace),
            runs => several::json(runs, arguments.trace),
        };
        if let Some(name) = name {
            object["shader"] = json!(name);
        }
        return print_json(&object);
    }
    let text = match runs {
        [run] => run.text(arguments.trace),
        runs => several::text(runs, arguments.trace),
    };
    match name {
        Some(name) => print(&format!("// {name}\n{text}\n")),
        None => print(&text),
    }
}

/// What is run, as it was written.
#[derive(Clone, Copy)]
struct Listing<'a> {
    sources: &'a SourceMap,
    program: &'a Program,
}

/// A finished run, ready to be told.
struct Run<'a> {
    listing: Listing<'a>,
    kernel: Kernel,
    machine: Machine<1>,
    trace: Trace,
}

/// What one instruction wrote, one entry a register.
struct Written<'a> {
    instruction: &'a Instruction,
    line: usize,
    registers: Vec<(Slot, WriteMask, [f32; 4])>,
}

impl<'a> Run<'a> {
    fn new(listing: Listing<'a>, kernel: Kernel, given: &Given) -> Self {
        let mut machine = Machine::<1>::new();
        for input in given.inputs(&kernel) {
            let [value, ..] = input.value;
            machine.load(input.slot, value);
        }
        let environment = Environment {
            constants: bind_constants(&kernel, &given.constants),
            ..Default::default()
        };
        let trace = Trace::record(&mut machine, &kernel, &environment, 0);
        Self {
            listing,
            kernel,
            machine,
            trace,
        }
    }

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
        self.listing
            .program
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
                    .listing
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

    fn text(&self, with_trace: bool) -> String {
        let mut out = String::new();
        if with_trace {
            for step in self.steps() {
                let text = step.instruction.text(self.listing.sources);
                out.push_str(&format!("{:>4}  {text}\n", step.line));
                for (slot, mask, value) in &step.registers {
                    let name = self.name(*slot, *mask);
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
        if let Some(text) = self.killed_by() {
            out.push_str(&format!("killed by {text}\n"));
        }
        out
    }

    /// The instruction that discarded the pixel.
    fn killed_by(&self) -> Option<String> {
        let killed_by = self.trace.killed_by?;
        let instruction = self.listing.program.instructions().nth(killed_by)?;
        Some(instruction.text(self.listing.sources))
    }

    /// A register with the components that were written.
    fn name(&self, slot: Slot, mask: WriteMask) -> String {
        let components = match slot {
            Slot::DEPTH => String::new(),
            _ => mask.text(self.listing.program.letters()),
        };
        slot.name(self.kind()) + &components
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
                        "text": step.instruction.text(self.listing.sources),
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

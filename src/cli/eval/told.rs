//! A finished run as text and as JSON.

use super::{json_number, json_vector, numbers};
use serde_json::{Map, Value, json};
use texcrd::debug::{self, Account, Event, Moment, Registers};
use texcrd::isa::{ShaderKind, WriteMask};
use texcrd::kernel::Slot;
use texcrd::policy::Model;
use texcrd::program::Instruction;

/// A finished run, ready to be told.
pub(super) struct Run<'a> {
    run: debug::Run<'a>,
    end: Registers,
}

/// One write of a step.
pub(super) struct Change {
    /// The instruction, by its number.
    pub(super) instruction: usize,
    pub(super) slot: Slot,
    pub(super) mask: WriteMask,
    pub(super) after: [f32; 4],
}

/// What one instruction wrote, one entry a register.
pub(super) struct Written<'a> {
    /// Its number.
    pub(super) number: usize,
    pub(super) instruction: &'a Instruction,
    pub(super) line: usize,
    pub(super) registers: Vec<(Slot, WriteMask, [f32; 4])>,
}

impl<'a> Run<'a> {
    pub(super) fn new(run: debug::Run<'a>) -> Self {
        let end = run.registers(run.moments.len());
        Self { run, end }
    }

    pub(super) fn kind(&self) -> ShaderKind {
        self.run.listing.kind()
    }

    /// The hardware model.
    pub(super) fn model(&self) -> Model {
        self.run.listing.kernel.model
    }

    /// The version of the shader.
    pub(super) fn version(&self) -> &'static str {
        self.run.listing.program.version.name()
    }

    /// The letters of its components.
    pub(super) fn letters(&self) -> [char; 4] {
        self.run.listing.program.letters()
    }

    /// The registers that a listing can name and that the run wrote, and the result in any case.
    pub(super) fn registers(&self) -> impl Iterator<Item = (String, [f32; 4])> {
        let result = (self.kind() == ShaderKind::Pixel).then_some(Slot::R0);
        let kernel = self.run.listing.kernel;
        Slot::all()
            .filter(|slot| !slot.is_internal())
            .filter(move |slot| Some(*slot) == result || !kernel.written(*slot).is_empty())
            .map(|slot| (slot.name(self.kind()), self.register(slot)))
    }

    fn register(&self, slot: Slot) -> [f32; 4] {
        let value = self.end.slot(slot, self.run.lane);
        // What the output merger does with r0 is told apart.
        let merged = |moment: &&Moment| matches!(moment.event, Event::Merge(_));
        let first = self.run.moments.iter().find(merged);
        match first.and_then(|moment| moment.change) {
            Some(change) if change.target.slot() == Some(slot) => change.before[self.run.lane & 3],
            _ => value,
        }
    }

    pub(super) fn depth(&self) -> Option<f32> {
        let writes = self.run.listing.kernel.writes_depth();
        writes.then(|| self.register(Slot::DEPTH)[0])
    }

    /// Every write of an instruction into a register that listings know, in order.
    pub(super) fn changes(&self) -> impl Iterator<Item = Change> {
        self.run.moments.iter().filter_map(|moment| {
            let (instruction, change) = (moment.instruction?, moment.change?);
            let slot = change.target.slot()?;
            let named = !slot.is_internal() || slot == Slot::DEPTH;
            named.then_some(Change {
                instruction,
                slot,
                mask: change.mask,
                after: change.after[self.run.lane & 3],
            })
        })
    }

    /// Instruction by instruction, those included that wrote nothing.
    pub(super) fn steps(&self) -> impl Iterator<Item = Written<'_>> {
        let instructions = self.run.listing.program.instructions();
        instructions.enumerate().map(|(number, instruction)| {
            let mut registers: Vec<(Slot, WriteMask, [f32; 4])> = Vec::new();
            for change in self.changes().filter(|c| c.instruction == number) {
                match registers.iter_mut().find(|(slot, ..)| *slot == change.slot) {
                    Some((_, mask, value)) => {
                        *mask = mask.or(change.mask);
                        *value = change.after;
                    }
                    None => registers.push((change.slot, change.mask, change.after)),
                }
            }
            Written {
                number,
                instruction,
                line: self.run.listing.line(number),
                registers,
            }
        })
    }

    /// The text of an instruction.
    pub(super) fn instruction(&self, instruction: &Instruction) -> String {
        instruction.text(self.run.listing.sources)
    }

    /// The moments of an instruction, each with what went into it.
    fn accounts(&self, instruction: usize) -> Vec<Account> {
        let moments = self.run.moments.iter().enumerate();
        moments
            .filter(|(_, moment)| moment.instruction == Some(instruction))
            .map(|(number, _)| debug::account(&self.run, number))
            .collect()
    }

    /// The moments before the first instruction, or those behind the last.
    fn around(&self, before: bool) -> Vec<(&Moment, Account)> {
        let first = self.run.first_instruction();
        let moments = self.run.moments.iter().enumerate();
        moments
            .filter(|(number, moment)| moment.instruction.is_none() && (*number < first) == before)
            .map(|(number, moment)| (moment, debug::account(&self.run, number)))
            .collect()
    }

    /// The constants that the shader names, as it reads them.
    fn constants(&self) -> Vec<(String, [f32; 4])> {
        let mut named: Vec<u32> = self.run.listing.kernel.constants().collect();
        named.sort_unstable();
        named.dedup();
        let bound = &self.run.environment.constants;
        let value = |index: &u32| bound.get(*index as usize).copied().unwrap_or_default();
        (named.iter())
            .map(|index| (format!("c{index}"), value(index)))
            .collect()
    }

    pub(super) fn text(&self, with_trace: bool) -> String {
        let mut out = String::new();
        if with_trace {
            self.trace(&mut out);
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

    fn trace(&self, out: &mut String) {
        for (_, account) in self.around(true) {
            let from: Vec<&str> = account.notes.iter().map(|(_, text)| &**text).collect();
            if let Some((name, values)) = &account.written {
                push(
                    out,
                    WRITTEN,
                    name,
                    &format!("{}   {}", list(values), from.join("; ")),
                );
            }
        }
        for (name, value) in self.constants() {
            push(out, WRITTEN, &name, &numbers(value, WriteMask::ALL));
        }
        for step in self.steps() {
            self.push_heading(out, &step, "");
            self.push_details(out, &step);
        }
        for (moment, account) in self.around(false) {
            out.push_str(&format!("   {}\n", debug::occasion(moment)));
            push_account(out, &account);
        }
    }

    /// The line of an instruction; `mark` stands in front of it.
    pub(super) fn push_heading(&self, out: &mut String, step: &Written<'_>, mark: &str) {
        let text = self.instruction(step.instruction);
        let line = step.line.to_string();
        let width = 4_usize.saturating_sub(mark.chars().count());
        out.push_str(&format!("{mark}{line:>width$}  {text}\n"));
    }

    /// What an instruction read, computed and wrote, step by step, and the registers that several steps wrote.
    pub(super) fn push_details(&self, out: &mut String, step: &Written<'_>) {
        self.push_inner(out, step, true);
        for (slot, mask, value) in &step.registers {
            let writes = self.changes();
            let parts = writes.filter(|c| c.instruction == step.number && c.slot == *slot);
            if !parts.map(|part| part.mask).any(|part| part == *mask) {
                push(
                    out,
                    WRITTEN,
                    &self.name(*slot, *mask),
                    &numbers(*value, *mask),
                );
            }
        }
    }

    /// The same without registers that listings can name, unless they are wanted.
    pub(super) fn push_inner(&self, out: &mut String, step: &Written<'_>, registers: bool) {
        for mut account in self.accounts(step.number) {
            let named = |name: &str| {
                let file = name.split('.').next().unwrap_or_default();
                step.registers
                    .iter()
                    .any(|(slot, ..)| slot.name(self.kind()) == file)
            };
            account.written = account
                .written
                .filter(|(name, _)| registers || !named(name));
            push_account(out, &account);
        }
    }

    /// The instruction that discarded the pixel.
    pub(super) fn killed_by(&self) -> Option<String> {
        let number = self.killed_at()?;
        let instruction = self.run.listing.instruction(number)?;
        Some(self.instruction(instruction))
    }

    /// Its number.
    pub(super) fn killed_at(&self) -> Option<usize> {
        let lane = self.run.lane & 3;
        let mut moments = self.run.moments.iter();
        let killing = moments.find(|moment| match moment.event {
            Event::Step {
                killed: Some((_, after)),
                ..
            } => after[lane],
            _ => false,
        });
        killing?.instruction
    }

    /// A register with the components that were written.
    pub(super) fn name(&self, slot: Slot, mask: WriteMask) -> String {
        let components = match slot {
            Slot::DEPTH => String::new(),
            _ => mask.text(self.letters()),
        };
        slot.name(self.kind()) + &components
    }

    pub(super) fn json(&self, with_trace: bool) -> Value {
        let registers: Map<String, Value> = self
            .registers()
            .map(|(name, value)| (name, json_vector(value)))
            .collect();
        let mut object = json!({
            "registers": registers,
            "killed": self.killed_at().is_some(),
            "depth": self.depth().map(json_number),
        });
        if with_trace {
            object["trace"] = self.steps().map(|step| self.step_json(&step)).collect();
            let constants = self.constants().into_iter();
            let constants = constants.map(|(name, value)| (name, json_vector(value)));
            object["constants"] = Value::Object(constants.collect());
            let inputs = self.around(true);
            let inputs = inputs
                .iter()
                .filter_map(|(_, account)| account.written.as_ref());
            let inputs = inputs.map(|(name, values)| (name.clone(), json_numbers(values)));
            object["inputs"] = Value::Object(inputs.collect());
            let behind: Vec<Value> = (self.around(false).iter())
                .map(|(moment, account)| {
                    let mut object = account_json(account);
                    object["occasion"] = json!(debug::occasion(moment));
                    object
                })
                .collect();
            if !behind.is_empty() {
                object["behind"] = Value::Array(behind);
            }
        }
        object
    }

    fn step_json(&self, step: &Written<'_>) -> Value {
        let value = |slot: Slot, value: [f32; 4]| match slot {
            Slot::DEPTH => json_number(value[0]),
            _ => json_vector(value),
        };
        let writes: Map<String, Value> = (step.registers.iter())
            .map(|(slot, _, written)| (slot.name(self.kind()), value(*slot, *written)))
            .collect();
        let accounts = self.accounts(step.number);
        let steps: Vec<Value> = accounts.iter().map(account_json).collect();
        json!({
            "line": step.line,
            "text": self.instruction(step.instruction),
            "writes": writes,
            "steps": steps,
        })
    }
}

/// How far what was read stands to the right, and what was written.
const READ: usize = 8;
const WRITTEN: usize = 6;

/// A line with a name and what it is; all of them stand in one column.
fn push(out: &mut String, indent: usize, name: &str, text: &str) {
    const COLUMN: usize = 19;
    let width = COLUMN - 1 - indent;
    out.push_str(&format!("{:indent$}{name:<width$} = {text}\n", ""));
}

/// An account, a line each number or vector.
fn push_account(out: &mut String, account: &Account) {
    for (name, values) in &account.reads {
        push(out, READ, name, &list(values));
    }
    for (name, text) in &account.notes {
        match name.is_empty() {
            true => out.push_str(&format!("{:READ$}{text}\n", "")),
            false => push(out, READ, name, text),
        }
    }
    if let Some(values) = &account.computed {
        push(out, READ, "computed", &list(values));
    }
    if let Some((name, values)) = &account.written {
        push(out, WRITTEN, name, &list(values));
    }
}

fn list(values: &[f32]) -> String {
    let texts: Vec<String> = values.iter().map(|x| debug::number_text(*x)).collect();
    texts.join(", ")
}

fn account_json(account: &Account) -> Value {
    let reads: Vec<Value> = (account.reads.iter())
        .map(|(operand, values)| json!({ "operand": operand, "values": json_numbers(values) }))
        .collect();
    let notes: Vec<Value> = (account.notes.iter())
        .map(|(name, text)| match name.is_empty() {
            true => json!(text),
            false => json!(format!("{name} = {text}")),
        })
        .collect();
    let written = account.written.as_ref();
    json!({
        "reads": reads,
        "notes": notes,
        "computed": account.computed.as_ref().map(|values| json_numbers(values)),
        "register": written.map(|(name, _)| name),
        "values": written.map(|(_, values)| json_numbers(values)),
    })
}

fn json_numbers(values: &[f32]) -> Value {
    values.iter().map(|number| json_number(*number)).collect()
}

//! One listing under several hardware models, side by side.

use super::told::{Run, Written};
use super::{json_number, numbers};
use serde_json::{Map, Value, json};
use texcrd::isa::WriteMask;
use texcrd::kernel::Slot;

/// Where runs part first: what an instruction wrote, or whether it discarded the pixel.
struct Parting {
    /// The number of the instruction.
    instruction: usize,
    /// The register and the component; none where only some of the runs are killed.
    written: Option<(Slot, usize)>,
}

/// The first number that is not the same in all runs. The kernels of all models have the same steps.
fn parting(runs: &[Run<'_>]) -> Option<Parting> {
    let (first, others) = runs.split_first()?;
    let all: Vec<Vec<_>> = others.iter().map(|run| run.changes().collect()).collect();
    let parted = first.changes().enumerate().find_map(|(number, change)| {
        let parts = |c: &usize| {
            all.iter().any(|changes| {
                let other = changes.get(number);
                other.is_none_or(|other| differ(other.after[*c], change.after[*c]))
            })
        };
        let component = change.mask.components().find(parts)?;
        Some(Parting {
            instruction: change.instruction,
            written: Some((change.slot, component)),
        })
    });
    let killed = others
        .iter()
        .filter(|run| run.killed_at() != first.killed_at())
        .flat_map(|run| run.killed_at().into_iter().chain(first.killed_at()))
        .min()
        .map(|instruction| Parting {
            instruction,
            written: None,
        });
    match (parted, killed) {
        (Some(parted), Some(killed)) if killed.instruction < parted.instruction => Some(killed),
        (parted, killed) => parted.or(killed),
    }
}

/// Whether two numbers are not the same; NaN is NaN, and zero has no sign.
fn differ(a: f32, b: f32) -> bool {
    a != b && !(a.is_nan() && b.is_nan())
}

/// The number of a register that an instruction has written, behind it.
fn number_at(run: &Run<'_>, parting: &Parting) -> Option<f32> {
    let (slot, component) = parting.written?;
    let change = run.changes().find(|change| {
        change.instruction == parting.instruction
            && change.slot == slot
            && change.mask.has(component)
    });
    change.map(|change| change.after[component])
}

/// All runs as text: each register once, with the numbers of the models below each other where they are not the same.
pub(super) fn text(runs: &[Run<'_>], with_trace: bool) -> String {
    let Some((first, _)) = runs.split_first() else {
        return String::new();
    };
    let width = runs.iter().map(|run| run.model().name().len()).max();
    let width = width.unwrap_or(0);
    let mut out = String::new();
    if with_trace {
        let all: Vec<Vec<_>> = runs.iter().map(|run| run.steps().collect()).collect();
        let parting = parting(runs).map(|parting| parting.instruction);
        for step in first.steps() {
            let mark = if parting == Some(step.number) {
                "->"
            } else {
                ""
            };
            first.push_heading(&mut out, &step, mark);
            let number = step.number;
            if parting == Some(number) {
                // Why they part: what went in under each.
                for run in runs {
                    out.push_str(&format!("      {}\n", run.model()));
                    run.push_inner(&mut out, &step, false);
                }
            }
            for (place, (slot, mask, _)) in step.registers.iter().enumerate() {
                let name = format!("      {:<12} = ", first.name(*slot, *mask));
                let of = |steps: &Vec<Written<'_>>| {
                    let written = steps.get(number)?.registers.get(place)?;
                    Some(written.2)
                };
                let values: Vec<[f32; 4]> = all.iter().filter_map(of).collect();
                push(&mut out, runs, &name, &values, *mask, width);
            }
        }
        out.push('\n');
    }
    let registers: Vec<Vec<(String, [f32; 4])>> =
        runs.iter().map(|run| run.registers().collect()).collect();
    for (place, (name, _)) in first.registers().enumerate() {
        let values = registers.iter().filter_map(|all| all.get(place));
        let values: Vec<[f32; 4]> = values.map(|(_, value)| *value).collect();
        push(
            &mut out,
            runs,
            &format!("{name:<5} = "),
            &values,
            WriteMask::ALL,
            width,
        );
    }
    if first.depth().is_some() {
        let depths = runs.iter().filter_map(Run::depth);
        let values: Vec<[f32; 4]> = depths.map(|depth| [depth; 4]).collect();
        push(&mut out, runs, "depth = ", &values, WriteMask::X, width);
    }
    for run in runs {
        if let Some(text) = run.killed_by() {
            out.push_str(&format!("{}: killed by {text}\n", run.model()));
        }
    }
    out.push_str(&told(runs));
    out
}

/// The numbers of all models: on one line if they are the same, else on a line each.
fn push(
    out: &mut String,
    runs: &[Run<'_>],
    name: &str,
    values: &[[f32; 4]],
    mask: WriteMask,
    width: usize,
) {
    let Some((first, others)) = values.split_first() else {
        return;
    };
    let same = |other: &[f32; 4]| mask.components().all(|c| !differ(other[c], first[c]));
    if others.iter().all(same) {
        return out.push_str(&format!("{name}{}\n", numbers(*first, mask)));
    }
    for (place, (run, value)) in runs.iter().zip(values).enumerate() {
        let before = match place {
            0 => name.to_string(),
            _ => " ".repeat(name.chars().count()),
        };
        let (model, value) = (run.model().name(), numbers(*value, mask));
        out.push_str(&format!("{before}{model:<width$}  {value}\n"));
    }
}

/// Where the runs part first, in words.
fn told(runs: &[Run<'_>]) -> String {
    let names: Vec<&str> = runs.iter().map(|run| run.model().name()).collect();
    let all = names.join(" and ");
    let Some(parting) = parting(runs) else {
        return format!("{all} do not part\n");
    };
    let Some((first, _)) = runs.split_first() else {
        return String::new();
    };
    let Some((line, text)) = place(first, &parting) else {
        return String::new();
    };
    let what = match parting.written {
        None => "the pixel is discarded under some of them only".to_string(),
        Some((slot, component)) => {
            let name = first.name(slot, WriteMask::component(component));
            let values: Vec<String> = runs
                .iter()
                .filter_map(|run| Some((run.model(), number_at(run, &parting)?)))
                .map(|(model, number)| format!("{number} under {model}"))
                .collect();
            format!("{name} is {}", values.join(", "))
        }
    };
    format!("{all} part first at line {line}, {text}: {what}\n")
}

/// Line and text of the instruction at which runs part.
fn place(run: &Run<'_>, parting: &Parting) -> Option<(usize, String)> {
    let step = run.steps().nth(parting.instruction)?;
    Some((step.line, run.instruction(step.instruction)))
}

/// All runs as JSON: `models` has the object of each, with its name; `parting` says where they part first, or is null.
pub(super) fn json(runs: &[Run<'_>], with_trace: bool) -> Value {
    let models: Vec<Value> = runs
        .iter()
        .map(|run| {
            let mut object = run.json(with_trace);
            object["model"] = json!(run.model().name());
            object
        })
        .collect();
    json!({ "models": models, "parting": parting_json(runs) })
}

fn parting_json(runs: &[Run<'_>]) -> Option<Value> {
    let (parting, first) = (parting(runs)?, runs.first()?);
    let (line, text) = place(first, &parting)?;
    let values: Map<String, Value> = runs
        .iter()
        .filter_map(|run| {
            let number = number_at(run, &parting)?;
            Some((run.model().name().to_string(), json_number(number)))
        })
        .collect();
    let letters = first.letters();
    let register = parting.written.map(|(slot, _)| slot.name(first.kind()));
    let component = (parting.written)
        .filter(|(slot, _)| *slot != Slot::DEPTH)
        .and_then(|(_, component)| letters.get(component).map(char::to_string));
    Some(json!({
        "line": line,
        "text": text,
        "register": register,
        "component": component,
        "values": values,
    }))
}

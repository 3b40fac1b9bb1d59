//! A plan for people.

use super::{NO_ROW, Plan, Row, RowFinish, RowOp, UniformValue};
use crate::isa::modifier::SHIFTS;
use crate::isa::operand::XYZW;
use crate::isa::{RegisterFile, SourceModifier};
use crate::policy::Model;
use std::fmt::{self, Display, Formatter};

impl Plan {
    /// How many rows a batch has: one number for each invocation each.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// The steps, each with the number of the instruction that it came from and a line that shows it: `mad n7, n3, n1, n2`.
    ///
    /// Several sets of rows of one step stand behind each other, with `|` between them. The first
    /// [`Self::once`] steps are taken once a draw.
    pub fn lines(&self) -> Vec<(usize, String)> {
        let rows = |rows: &[Row]| {
            let names = rows.iter().map(|row| match *row {
                NO_ROW => "_".to_owned(),
                row => format!("n{row}"),
            });
            names.collect::<Vec<_>>().join(", ")
        };
        (self.steps.iter())
            .map(|step| {
                let name = name(step.op);
                let finish = match step.finish {
                    RowFinish::Keep | RowFinish::Flush => String::new(),
                    RowFinish::Full(result) => {
                        let shift = SHIFTS.iter().find(|row| row.shift == result.shift);
                        let saturation = if result.saturate { "_sat" } else { "" };
                        format!("{}{saturation}", shift.map_or("", |row| row.suffix))
                    }
                };
                let model = match step.writes {
                    Model::Float => String::new(),
                    model => format!(" ({model})"),
                };
                let items: Vec<_> = (self.items(step))
                    .map(|(results, sources)| {
                        let comma = if results.is_empty() { "" } else { ", " };
                        format!("{}{comma}{}", rows(results), rows(sources))
                    })
                    .collect();
                let line = format!("{name}{finish} {}{model}", items.join(" | "));
                (step.origin, line)
            })
            .collect()
    }

    /// How many of the steps are taken once a draw, because they follow from constants alone.
    pub fn once(&self) -> usize {
        self.once
    }

    /// The rows that are filled before the steps, a line each: `n3 = c0.y`.
    pub fn loads(&self) -> Vec<String> {
        let uniforms = self.uniforms.iter().map(|uniform| {
            let value = match uniform.value {
                UniformValue::Constant(index, component) => {
                    let register = RegisterFile::Const.register_name(index);
                    format!("{register}.{}", letter(component))
                }
                UniformValue::Literal(number) => number.to_string(),
            };
            format!("n{} = {value}", uniform.row)
        });
        let inputs = self.inputs.iter().map(|input| {
            let slot = input.slot.name(self.kind);
            format!("n{} = {slot}.{}", input.row, letter(input.component))
        });
        uniforms.chain(inputs).collect()
    }

    /// The rows that are left in the end, a line each register: `r0 = n3, n4, n5, n1`.
    pub fn results(&self) -> Vec<String> {
        (self.outputs.iter())
            .map(|(slot, rows)| {
                let name = slot.name(self.kind);
                let rows = rows.iter().filter(|row| **row != NO_ROW);
                let rows: Vec<_> = rows.map(|row| format!("n{row}")).collect();
                format!("{name} = {}", rows.join(", "))
            })
            .collect()
    }
}

fn letter(component: u8) -> char {
    XYZW[usize::from(component) & 3]
}

/// The name of an operation.
fn name(op: RowOp) -> String {
    use RowOp::*;
    let name = match op {
        Mov => "mov",
        Modify(modifier) | Operand(Model::Float, modifier) => return modified(modifier),
        Operand(model, SourceModifier::None) => return model.to_string(),
        Operand(model, modifier) => return format!("{} of {model}", modified(modifier)),
        Add => "add",
        Sub => "sub",
        Mul => "mul",
        Mad => "mad",
        Lrp => "lrp",
        Min => "min",
        Max => "max",
        Slt => "slt",
        Sge => "sge",
        Frc => "frc",
        Address => "address",
        Cnd => "cnd",
        Cmp => "cmp",
        Dp3 => "dp3",
        Dp4 => "dp4",
        Rcp => "rcp",
        Rsq => "rsq",
        Exp => "exp",
        Log => "log",
        ExpP(component) => return format!("expp.{}", letter(component)),
        LogP(component) => return format!("logp.{}", letter(component)),
        LitDiffuse => "lit.y",
        LitSpecular => "lit.z",
        Divide => "divide",
        Bump(stage, component) => return format!("bump{stage}.{}", letter(component)),
        Luminance(stage, _) => return format!("luminance{stage}"),
        Reflect => "reflect",
        Sample(stage) => return format!("sample{stage}"),
        Depth => "depth",
        Kill => "kill",
        Relative(offset, component) => return format!("c[a0 + {offset}].{}", letter(component)),
    };
    name.to_owned()
}

/// A source modifier as a formula.
fn modified(modifier: SourceModifier) -> String {
    format!("({})", modifier.row().formula)
}

impl Display for Plan {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let steps = self.lines();
        let lines = (self.loads().into_iter())
            .chain(steps.into_iter().map(|(_, line)| line))
            .chain(self.results());
        lines.into_iter().try_for_each(|line| writeln!(f, "{line}"))
    }
}

//! A kernel for people.

use super::{Kernel, Op, Place, Step};
use crate::isa::modifier::SHIFTS;
use crate::isa::operand::{RGBA, XYZW};
use crate::isa::{RegisterFile, ShaderKind};
use crate::policy::Model;

impl Kernel {
    /// The steps, each with the number of the instruction that it came from and a line that shows it, much as a listing would:
    /// `dp3_sat r0.rgb, r1_bx2, c0`.
    ///
    /// Operations that no instruction is called like have names of their own (`sample2`, `divide_z`); a step that waits with its
    /// result until the next one has read ends in `; held`, one that leaves other numbers than floats in their model.
    pub fn lines(&self) -> Vec<(usize, String)> {
        let line = |step: &Step| (step.origin, self.line(step));
        self.steps.iter().map(line).collect()
    }

    fn line(&self, step: &Step) -> String {
        let kind = self.version.kind();
        let letters = match kind {
            ShaderKind::Vertex => XYZW,
            ShaderKind::Pixel => RGBA,
        };
        let mut line = name(step.op);
        if let Some(shift) = (SHIFTS.iter()).find(|row| row.shift == step.result.shift) {
            line.push_str(shift.suffix);
        }
        if step.result.saturate {
            line.push_str("_sat");
        }
        let destination =
            (step.op != Op::Kill).then(|| step.destination.name(kind) + &step.mask.text(letters));
        let sources = step.sources.iter().map(|operand| {
            let register = match operand.place {
                Place::Slot(slot) => slot.name(kind),
                Place::Constant(index) => RegisterFile::Const.register_name(index),
                Place::Relative(offset) => format!("c[a0.x + {offset}]"),
                Place::Literal(number) => number.to_string(),
            };
            operand.modifier.row().around(&register) + &operand.swizzle.text(letters)
        });
        let operands: Vec<String> = destination.into_iter().chain(sources).collect();
        line.push(' ');
        line.push_str(&operands.join(", "));
        let notes = [
            step.held.then(|| "held".to_owned()),
            (step.writes != Model::Float).then(|| step.writes.to_string()),
        ];
        let notes: Vec<String> = notes.into_iter().flatten().collect();
        if !notes.is_empty() {
            line.push_str(" ; ");
            line.push_str(&notes.join(", "));
        }
        line
    }
}

/// The name of an operation.
fn name(op: Op) -> String {
    let name = match op {
        Op::Mov => "mov",
        Op::Add => "add",
        Op::Sub => "sub",
        Op::Mul => "mul",
        Op::Mad => "mad",
        Op::Lrp => "lrp",
        Op::Min => "min",
        Op::Max => "max",
        Op::Slt => "slt",
        Op::Sge => "sge",
        Op::Frc => "frc",
        Op::Floor => "address",
        Op::Cnd => "cnd",
        Op::Cmp => "cmp",
        Op::Dp3 => "dp3",
        Op::Dp4 => "dp4",
        Op::Rcp => "rcp",
        Op::Rsq => "rsq",
        Op::Exp => "exp",
        Op::Log => "log",
        Op::ExpP => "expp",
        Op::LogP => "logp",
        Op::Lit => "lit",
        Op::Dst => "dst",
        Op::DivideZ => "divide_z",
        Op::DivideW => "divide_w",
        Op::Project(2) => "project_z",
        Op::Project(_) => "project_w",
        Op::Bump(stage) => return format!("bump{stage}"),
        Op::Luminance(stage) => return format!("luminance{stage}"),
        Op::Reflect => "reflect",
        Op::Sample(stage) => return format!("sample{stage}"),
        Op::Kill => "kill",
        Op::Depth => "depth",
    };
    name.to_owned()
}

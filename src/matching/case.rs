//! A mismatch as a shader unit test.

use super::{Difference, Mismatch, Subject};
use crate::generate::{Generated, INVOCATIONS, Stage, Textures};
use crate::isa::ShaderKind;
use crate::kernel::{Projection, Slot};
use crate::policy::{Model, Policies, Policy};
use crate::semantics::BumpState;
use crate::texture::{Texture, TextureKind};
use std::fmt::Write;

/// The mismatch as a case in the format of `docs/cases.md`, in TOML: the listing with all that it is run with, and the
/// interpreter's results as expectations. Where the GPU differs is said in comments.
pub fn case_text(mismatch: &Mismatch, textures: &Textures) -> String {
    let subject = &mismatch.subject;
    let generated = &subject.generated;
    let version = generated.program.version;
    let vertex = version.kind() == ShaderKind::Vertex;
    let mut text = String::new();
    for difference in &mismatch.differences {
        for line in describe(subject, difference).lines() {
            let _ = writeln!(text, "# {line}");
        }
    }
    let _ = writeln!(text, "name = \"{version}, seed {}\"", mismatch.seed);
    computing_text(&mut text, generated);
    let (shader, constants) = if vertex {
        ("vs", "vs_constants")
    } else {
        ("ps", "ps_constants")
    };
    let _ = writeln!(text, "{shader} = \"\"\"\n{}\"\"\"", generated.listing);
    let kernel = generated.lower(&generated.program).ok();
    let sampled = kernel.as_ref().map_or(0, |kernel| kernel.stages());
    for (number, stage) in generated.stages.iter().enumerate() {
        if sampled >> number & 1 == 1
            && let Some(texture) = textures.get(stage.kind, stage.signed)
        {
            texture_text(&mut text, number, texture);
        }
        stage_text(&mut text, number, stage, version.kind(), sampled);
    }
    if !generated.constants.is_empty() {
        let _ = writeln!(text, "[{constants}]");
        for (number, value) in &generated.constants {
            let _ = writeln!(text, "c{number} = {}", list(value));
        }
    }
    for invocation in 0..INVOCATIONS {
        invocation_text(&mut text, mismatch, invocation);
    }
    text
}

/// The model and the policies, where they are not the usual ones.
fn computing_text(text: &mut String, generated: &Generated) {
    if generated.model != Model::default() {
        let _ = writeln!(text, "model = \"{}\"", generated.model);
    }
    let usual = Policies::default();
    for policy in Policy::all() {
        let value = policy.get(&generated.policies);
        if value != policy.get(&usual) {
            let _ = writeln!(text, "policies.{} = \"{value}\"", policy.name);
        }
    }
}

fn invocation_text(text: &mut String, mismatch: &Mismatch, invocation: usize) {
    let generated = &mismatch.subject.generated;
    let kind = generated.program.version.kind();
    text.push_str("\n[[invocation]]\n");
    let outcomes = generated.outcomes.iter();
    let bounds = outcomes.flat_map(|outcome| {
        let errors = outcome.errors[invocation];
        outcome.mask.components().map(move |c| errors[c])
    });
    // One tolerance for all numbers of an invocation: a case has no other.
    let tolerance = bounds.fold(0.0, f32::max);
    if tolerance.is_finite() {
        let _ = writeln!(text, "tol = {tolerance:?}");
    }
    for (slot, values) in &generated.inputs {
        let read = mismatch.subject.reads(*slot);
        if read {
            let name = slot.name(kind);
            let _ = writeln!(text, "inputs.{name} = {}", list(&values[invocation]));
        }
    }
    if generated.killed[invocation] {
        text.push_str("expect.killed = true\n");
        return;
    }
    for outcome in &generated.outcomes {
        let value: [f32; 4] =
            std::array::from_fn(|component| Subject::expected(outcome, invocation, component));
        let last = outcome.mask.components().last().unwrap_or(0);
        let (name, number) = match outcome.slot {
            Slot::DEPTH => ("depth".to_owned(), Some(value[0])),
            // The component that counts.
            Slot::FOG | Slot::POINT_SIZE => (outcome.slot.name(kind), Some(value[last])),
            slot => (slot.name(kind), None),
        };
        let _ = match number {
            Some(number) => writeln!(text, "expect.{name} = {}", toml_number(number)),
            None => writeln!(text, "expect.{name} = {}", list(&value[..=last])),
        };
    }
}

impl Subject {
    /// Whether the shader reads a register.
    pub(super) fn reads(&self, slot: Slot) -> bool {
        let kernel = self.generated.lower(&self.generated.program);
        kernel.is_ok_and(|kernel| !kernel.read(slot).is_empty())
    }
}

fn texture_text(text: &mut String, number: usize, texture: &Texture) {
    let [width, height, depth] = texture.size();
    let size = match texture.kind() {
        TextureKind::Volume => format!("[{width}, {height}, {depth}]"),
        TextureKind::Texture2D | TextureKind::Cube => format!("[{width}, {height}]"),
    };
    let _ = writeln!(
        text,
        "[textures.{number}]\nkind = \"{}\"\nformat = \"{}\"\nsize = {size}\ntexels = [",
        texture.kind(),
        texture.format().name()
    );
    for face in 0..texture.face_count() {
        for z in 0..depth {
            for y in 0..height {
                let row = (0..width).filter_map(|x| texture.texel(face, 0, x, y, z));
                let row: Vec<String> = row.map(|texel| list(&texel)).collect();
                let _ = writeln!(text, "  {},", row.join(", "));
            }
        }
    }
    let _ = writeln!(text, "]\n[samplers.{number}]\nfilter = \"linear\"");
}

fn stage_text(text: &mut String, number: usize, stage: &Stage, kind: ShaderKind, sampled: u8) {
    let projected = stage.projection != Projection::None && sampled >> number & 1 == 1;
    let bumps = stage.bump != BumpState::default();
    if kind == ShaderKind::Vertex || !(projected || bumps) {
        return;
    }
    let _ = writeln!(text, "[stages.{number}]");
    if bumps {
        let bump = &stage.bump;
        let _ = writeln!(text, "bump_mat = {}", list(&bump.matrix));
        let _ = writeln!(text, "lum_scale = {}", toml_number(bump.luminance_scale));
        let _ = writeln!(text, "lum_offset = {}", toml_number(bump.luminance_offset));
    }
    if projected {
        let count = match stage.projection {
            Projection::Third => 3,
            _ => 4,
        };
        let _ = writeln!(text, "projected = true\ncount = {count}");
    }
}

/// The shortest text that reads back to the same float.
fn toml_number(number: f32) -> String {
    match number {
        n if n.is_nan() => "nan".into(),
        n if n.is_infinite() => if n > 0.0 { "inf" } else { "-inf" }.into(),
        n => format!("{n:?}"),
    }
}

fn list(values: &[f32]) -> String {
    let numbers: Vec<String> = values.iter().map(|n| toml_number(*n)).collect();
    format!("[{}]", numbers.join(", "))
}

/// A difference as a line for people.
pub fn describe(subject: &Subject, difference: &Difference) -> String {
    let kind = subject.generated.program.version.kind();
    match difference {
        Difference::Refused(why) => format!("the device does not take the translation: {why}"),
        Difference::Killed { invocation, cpu } => {
            let path = if *cpu { "CPU" } else { "GPU" };
            let number = invocation + 1;
            format!("invocation {number}: only the {path} discards the pixel")
        }
        Difference::Number {
            slot,
            component,
            invocation,
            cpu,
            gpu,
            bound,
        } => {
            let name = match *slot {
                Slot::DEPTH => "depth".to_owned(),
                Slot::FOG | Slot::POINT_SIZE => slot.name(kind),
                slot => {
                    let letter = crate::program::letters(kind)[component & 3];
                    format!("{}.{letter}", slot.name(kind))
                }
            };
            let off = (f64::from(*cpu) - f64::from(*gpu)).abs();
            format!(
                "invocation {}: {name} is {cpu:?} on the CPU and {gpu:?} on the GPU, {off:.3e} apart, may be {bound:.3e}",
                invocation + 1
            )
        }
    }
}

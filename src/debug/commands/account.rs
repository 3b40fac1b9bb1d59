//! Accounts of steps: every number that went into a result, so that it can be followed by hand with the specification open.

use super::{merge, sample, tell};
use crate::debug::expression::number_text;
use crate::debug::moment::{Event, Moment, Read, Sample, Target};
use crate::debug::run::Run;
use crate::isa::{Version, WriteMask};
use crate::kernel::{Op, Place, Slot, Step};
use crate::policy::Model;
use crate::semantics::BumpState;
use crate::texture::TextureKind;

/// What went into one moment of a run, and what came of it, for the pixel that is looked at.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Account {
    /// What operands read, in their order: their text, and the numbers behind swizzle, modifier and, under a hardware model,
    /// rounding. `TC[m]` are the texture coordinates m; `row`, `eye` and `coordinates` pass between the steps of one
    /// instruction.
    pub reads: Vec<(String, Vec<f32>)>,
    /// What else went in, each with what it is called: a bump matrix, what was sampled where, what an operation is. Sentences have
    /// an empty name.
    pub notes: Vec<(String, String)>,
    /// The result before shift, saturation and the numbers of the model, where they change it.
    pub computed: Option<Vec<f32>>,
    /// The register that was written, with the components, and their numbers.
    pub written: Option<(String, Vec<f32>)>,
}

/// The account of one moment of a run; empty for a moment that there is not.
pub fn account(run: &Run<'_>, number: usize) -> Account {
    let Some(moment) = run.moments.get(number) else {
        return Account::default();
    };
    let lane = run.lane & 3;
    let mut account = Account {
        written: written(run, moment),
        ..Account::default()
    };
    match &moment.event {
        Event::Step {
            step,
            reads,
            computed,
            sample: sampled,
            ..
        } => {
            let Some(step) = run.listing.kernel.steps.get(*step) else {
                return account;
            };
            account.reads = reads.iter().filter_map(|read| read_of(run, read)).collect();
            account.notes.extend(operation(step, reads, run));
            let after = moment.change.as_ref().map(|change| change.after[lane]);
            let computed = computed[lane];
            let differs = |c: usize| after.is_some_and(|after| tell_apart(after[c], computed[c]));
            if step.op != Op::Kill && step.mask.components().any(differs) {
                account.computed = Some(components(computed, step.mask));
            }
            if let Some(sampled) = sampled {
                let lines = sample::lines(run, sampled, tell::Detail::Full).to_string();
                let mut lines = lines.lines().map(|line| line.trim().to_owned());
                let first = lines.next();
                let all = first.into_iter().chain(sampler(run, sampled)).chain(lines);
                let all = all.map(|line| (String::new(), line));
                account.notes.extend(all);
            }
        }
        Event::Merge(stage) => {
            let lines = merge::lines(stage).to_string();
            let lines = lines
                .lines()
                .map(|line| (String::new(), line.trim().to_owned()));
            account.notes.extend(lines);
        }
        Event::Input(source) => {
            let source = tell::source_text(*source, lane, WriteMask::ALL);
            account
                .notes
                .push((String::new(), source.trim().to_owned()));
        }
        Event::Nothing | Event::Set | Event::Taken => {}
    }
    let remarks = tell::remarks(run, moment).into_iter();
    account
        .notes
        .extend(remarks.map(|words| (String::new(), words)));
    account
}

/// What a moment outside of instructions is called: `input`, `output merger: fog`.
pub fn occasion(moment: &Moment) -> String {
    tell::around(moment)
}

/// Whether two numbers are not the same; NaN is NaN, and zero has no sign.
fn tell_apart(a: f32, b: f32) -> bool {
    a != b && !(a.is_nan() && b.is_nan())
}

fn components(value: [f32; 4], mask: WriteMask) -> Vec<f32> {
    mask.components().map(|c| value[c]).collect()
}

fn written(run: &Run<'_>, moment: &Moment) -> Option<(String, Vec<f32>)> {
    let change = moment.change.as_ref()?;
    let mask = tell::mask_text(change.target, change.mask, run.listing.kind());
    let name = match change.target {
        Target::Slot(slot) => slot_name(run, slot),
        target => tell::target_name(target, run.listing.kind()),
    };
    let value = change.after[run.lane & 3];
    let mask_of = match change.target {
        Target::Slot(Slot::DEPTH) => WriteMask::X,
        _ => change.mask,
    };
    Some((name + &mask, components(value, mask_of)))
}

/// The name of a slot, told apart from others of the same name: before `ps.1.4` coordinates are no `t#`.
fn slot_name(run: &Run<'_>, slot: Slot) -> String {
    let version = run.listing.program.version;
    match slot.texcoord_index() {
        Some(set) if version != Version::Ps14 => format!("TC[{set}]"),
        _ => slot.name(run.listing.kind()),
    }
}

/// What an operand read; none of a number that the listing does not hold.
fn read_of(run: &Run<'_>, read: &Read) -> Option<(String, Vec<f32>)> {
    let place = match read.operand.place {
        Place::Literal(_) => return None,
        Place::Slot(slot) => slot_name(run, slot),
        Place::Constant(_) | Place::Relative(_) => tell::place_name(read, run),
    };
    let (components, shown) = tell::read_components(run, read, read.slots)?;
    let row = read.operand.modifier.row();
    let relative = tell::relative_text(run, read);
    let text = format!("{}{place}{}{components}{relative}", row.prefix, row.suffix);
    let values = read.values[run.lane & 3];
    Some((text, self::components(values, shown)))
}

/// How a texture is sampled; nothing where there is none.
fn sampler(run: &Run<'_>, sampled: &Sample) -> Option<String> {
    let stage = run.environment.stages.get(sampled.stage)?;
    let (texture, sampler) = (stage.texture?, stage.sampler);
    let filter = match sampled.detail[run.lane & 3].lambda() > 0.0 {
        true => format!("{} filter, {} levels", sampler.min, sampler.mip),
        false => format!("{} filter", sampler.mag),
    };
    let axes = match texture.kind() {
        TextureKind::Texture2D => 2,
        TextureKind::Volume => 3,
        TextureKind::Cube => 0,
    };
    let mut modes: Vec<String> = (sampler.address.iter().take(axes))
        .map(ToString::to_string)
        .collect();
    modes.dedup();
    Some(match modes.is_empty() {
        true => filter,
        false => format!("{filter}, {}", modes.join(" and ")),
    })
}

/// What a step does where its instruction does not say it, and the states that go in.
fn operation(step: &Step, reads: &[Read], run: &Run<'_>) -> Vec<(String, String)> {
    let bump = |stage: u8| -> BumpState {
        let stage = run.environment.stages.get(usize::from(stage));
        stage.map(|stage| stage.bump).unwrap_or_default()
    };
    let note = |name: &str, text: String| (name.to_owned(), text);
    let numbers = |values: &[f32]| {
        let texts: Vec<String> = values.iter().map(|x| number_text(*x)).collect();
        texts.join(", ")
    };
    let internal = step.destination.is_internal();
    match step.op {
        Op::Bump(stage) => vec![note(
            &format!("bump matrix of stage {stage}"),
            format!("{} (M00, M01, M10, M11)", numbers(&bump(stage).matrix)),
        )],
        Op::Luminance(stage) => {
            let state = bump(stage);
            let (scale, offset) = (state.luminance_scale, state.luminance_offset);
            let luminance = reads
                .get(1)
                .map_or(0.0, |read| read.values[run.lane & 3][2]);
            let factor = luminance * scale + offset;
            let clamped = match step.reads {
                Model::Gf3 => ", taken into 0 to 1",
                Model::Float | Model::R200 => "",
            };
            let (l, s, o) = (
                number_text(luminance),
                number_text(scale),
                number_text(offset),
            );
            vec![note(
                &format!("factor of stage {stage}"),
                format!(
                    "{l} × {s} + {o} = {}{clamped} (L × scale + offset)",
                    number_text(factor)
                ),
            )]
        }
        Op::Dp3 if internal => vec![note("", "dot product of three components".into())],
        Op::DivideZ => vec![note("", "divided by the third; 1 where that is 0".into())],
        Op::DivideW => vec![note("", "divided by the fourth; 1 where that is 0".into())],
        Op::Reflect => vec![note("", "mirrored: 2 · (N·E) / (N·N) · N - E".into())],
        Op::Depth => vec![note(
            "",
            "first over second, 1 where that is 0; taken into 0 to 1".into(),
        )],
        Op::Floor => vec![note("", "rounded down".into())],
        _ => Vec::new(),
    }
}

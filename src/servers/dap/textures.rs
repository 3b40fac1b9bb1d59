//! Texture stages as variables: what is bound, how it is sampled, what was sampled last.

use super::adapter::View;
use super::values;
use super::variables::{Container, Item};
use texcrd::debug::{Event, Moment, Sample, Value, number_text};
use texcrd::exec::Stage;
use texcrd::kernel::Op;
use texcrd::texture::{Filter, Texture, TextureKind};

/// The stages that the shader samples.
pub(super) fn stages(view: &View<'_>, hex: bool) -> Vec<Item> {
    let used = view.run.listing.kernel.stages();
    let used = (0..8).filter(|stage| used >> stage & 1 != 0);
    let item = |stage: usize| {
        let bound = view.run.environment.stages.get(stage);
        let texture = bound.and_then(|bound| bound.texture);
        let count = self::stage(view, stage, hex).len();
        let content = Container::Stage {
            run: view.number,
            stage,
        };
        Item {
            content: Some((content, count, 0)),
            ..Item::fact(&format!("stage {stage}"), summary(texture))
        }
    };
    used.map(item).collect()
}

/// What there is to say about a stage.
pub(super) fn stage(view: &View<'_>, stage: usize, hex: bool) -> Vec<Item> {
    let mut items = Vec::new();
    let Some(bound) = view.run.environment.stages.get(stage) else {
        return items;
    };
    if let Some(texture) = bound.texture {
        let size = size(texture);
        items.push(Item::fact("kind", texture.kind().to_string()));
        items.push(Item::fact("format", texture.format().to_string()));
        items.push(Item::fact("size", size));
        items.push(Item::fact("levels", texture.level_count().to_string()));
    }
    items.extend(sampler(bound));
    let uses = |op: Op| {
        view.run
            .listing
            .kernel
            .steps
            .iter()
            .any(|step| step.op == op)
    };
    let number = stage as u8;
    if uses(Op::Bump(number)) {
        let matrix = Value::vector(bound.bump.matrix);
        items.push(Item::fact("bump matrix", matrix.text(values::format(hex))));
    }
    if uses(Op::Luminance(number)) {
        for (name, x) in [
            ("luminance scale", bound.bump.luminance_scale),
            ("luminance offset", bound.bump.luminance_offset),
        ] {
            items.push(Item::fact(name, Value::scalar(x).text(values::format(hex))));
        }
    }
    if let Some((moment, sample)) = last_sample(view, stage) {
        let lane = view.run.lane & 3;
        let [u, v, w] = sample.coordinates[lane];
        let coordinates = Value {
            numbers: [u, v, w, 0.0],
            count: match bound.texture.map(Texture::kind) {
                Some(TextureKind::Cube | TextureKind::Volume) => 3,
                Some(TextureKind::Texture2D) | None => 2,
            },
        };
        items.push(Item::fact(
            "coordinates",
            values::with_marks(&coordinates, hex, &[]),
        ));
        let level = match sample.detail[lane].lambda() {
            level if level == f32::NEG_INFINITY => {
                "of the largest: the same place in all pixels".to_string()
            }
            level => Value::scalar(level).text(values::format(hex)),
        };
        items.push(Item::fact("level of detail", level));
        if let Some(change) = moment.change {
            let sampled = Value::vector(change.after[lane]);
            items.push(Item::fact(
                "sampled",
                values::with_marks(&sampled, hex, &[]),
            ));
        }
    }
    items
}

/// The last sample of a stage so far.
fn last_sample<'v>(view: &View<'v>, stage: usize) -> Option<(&'v Moment, Sample)> {
    let so_far = view.run.moments.iter().take(view.at).rev();
    let samples = so_far.filter_map(|moment| match &moment.event {
        Event::Step {
            sample: Some(sample),
            ..
        } => Some((moment, *sample)),
        _ => None,
    });
    samples
        .into_iter()
        .find(|(_, sample)| sample.stage == stage)
}

fn summary(texture: Option<&Texture>) -> String {
    match texture {
        Some(texture) => format!("{} {} {}", texture.kind(), size(texture), texture.format()),
        None => "nothing: opaque black".to_string(),
    }
}

fn size(texture: &Texture) -> String {
    let [width, height, depth] = texture.size();
    match texture.kind() {
        TextureKind::Volume => format!("{width}x{height}x{depth}"),
        TextureKind::Texture2D | TextureKind::Cube => format!("{width}x{height}"),
    }
}

fn sampler(bound: &Stage<'_>) -> Vec<Item> {
    let sampler = &bound.sampler;
    let axes = match bound.texture.map(Texture::kind) {
        // Cube textures ignore it.
        Some(TextureKind::Cube) => 0,
        Some(TextureKind::Volume) => 3,
        Some(TextureKind::Texture2D) | None => 2,
    };
    let address: Vec<String> = sampler
        .address
        .iter()
        .take(axes)
        .map(ToString::to_string)
        .collect();
    let mut items = vec![Item::fact(
        "filter",
        format!(
            "{} larger, {} smaller, {} between levels",
            sampler.mag, sampler.min, sampler.mip
        ),
    )];
    if axes > 0 {
        items.push(Item::fact("address", address.join(", ")));
    }
    if sampler.lod_bias != 0.0 {
        items.push(Item::fact(
            "bias of the level",
            number_text(sampler.lod_bias),
        ));
    }
    if sampler.min == Filter::Anisotropic {
        let most = sampler.max_anisotropy.to_string();
        items.push(Item::fact("most probes", most));
    }
    if sampler.max_mip_level != 0 {
        items.push(Item::fact(
            "largest level",
            sampler.max_mip_level.to_string(),
        ));
    }
    items
}

//! What was sampled, in words.

use super::tell::{Detail, numbers, remark};
use crate::debug::expression::number_text;
use crate::debug::moment::Sample;
use crate::debug::run::Run;
use crate::debug::text::{Style, Text};
use crate::exec::Stage;
use crate::isa::WriteMask;
use crate::texture::{self, CUBE_FACES, Tap, Texture, TextureKind, footprint};

/// The texels of a sample that are told one by one.
const MOST_TEXELS: usize = 4;

/// Two to six lines about a sample; in short only that there is no texture.
pub(super) fn lines(run: &Run<'_>, sample: &Sample, detail: Detail) -> Text {
    let mut text = Text::default();
    let stage = sample.stage;
    let coordinates = sample.coordinates[run.lane & 3];
    let Some(Stage {
        texture: Some(texture),
        sampler,
        ..
    }) = run.environment.stages.get(stage)
    else {
        text.line(remark(
            format!("stage {stage}: no texture, opaque black"),
            Style::Remarkable,
        ));
        return text;
    };
    if detail == Detail::Short {
        return text;
    }
    let used = used_coordinates(texture);
    let [u, v, w] = coordinates;
    let covered = sample.detail[run.lane & 3];
    text.line(remark(
        format!(
            "stage {stage}: {} at ({}), {}",
            texture_text(texture),
            numbers([u, v, w, 0.0], used),
            detail_text(&covered),
        ),
        Style::Plain,
    ));
    let mut taps = footprint(texture, sampler, coordinates, covered).taps;
    taps.retain(|tap| tap.weight > 0.0);
    // The heaviest first; of equally heavy ones the order of reading stays.
    taps.sort_by(|a, b| b.weight.total_cmp(&a.weight));
    for tap in taps.iter().take(MOST_TEXELS) {
        text.line(remark(tap_text(texture, sampler.border, tap), Style::Dim));
    }
    if let Some(more) = taps.len().checked_sub(MOST_TEXELS).filter(|more| *more > 0) {
        text.line(remark(format!("  and {more} more texels"), Style::Dim));
    }
    text
}

/// The texture of a stage in a few words, and the coordinates that count there.
pub(super) fn source(run: &Run<'_>, sample: &Sample) -> (String, WriteMask) {
    let stage = sample.stage;
    let texture = run
        .environment
        .stages
        .get(stage)
        .and_then(|stage| stage.texture);
    match texture {
        None => (format!("stage {stage}"), WriteMask::XYZ),
        Some(texture) => {
            let words = format!("stage {stage} ({})", texture_text(texture));
            (words, used_coordinates(texture))
        }
    }
}

fn used_coordinates(texture: &Texture) -> WriteMask {
    match texture.kind() {
        TextureKind::Texture2D => WriteMask::XY,
        TextureKind::Cube | TextureKind::Volume => WriteMask::XYZ,
    }
}

/// `cube 128×128 a8r8g8b8`.
pub(super) fn texture_text(texture: &Texture) -> String {
    let [width, height, depth] = texture.size();
    let size = match texture.kind() {
        TextureKind::Volume => format!("{width}×{height}×{depth}"),
        TextureKind::Texture2D | TextureKind::Cube => format!("{width}×{height}"),
    };
    format!("{} {size} {}", texture.kind(), texture.format())
}

/// The level of detail in words, and the probes where there are several.
pub(super) fn detail_text(detail: &texture::Detail) -> String {
    let level = detail.lambda();
    if level == f32::NEG_INFINITY {
        return "the same all over the quad".to_string();
    }
    let text = format!("level of detail {}", number_text(level));
    match detail.probes() {
        1 => text,
        probes => format!("{text}, {probes} probes"),
    }
}

/// One texel with its share.
fn tap_text(texture: &Texture, border: [f32; 4], tap: &Tap) -> String {
    let share = number_text(tap.weight);
    let Some([x, y, z]) = tap.texel else {
        let border = numbers(border, WriteMask::ALL);
        return format!("  {share} × the border: {border}");
    };
    let place = match texture.kind() {
        TextureKind::Texture2D => format!("{x},{y}"),
        TextureKind::Volume => format!("{x},{y},{z}"),
        TextureKind::Cube => format!("{x},{y} of face {}", face_name(tap.face)),
    };
    let level = match texture.level_count() {
        1 => String::new(),
        _ => format!(" of level {}", tap.level),
    };
    let value = texture.texel(tap.face, tap.level, x, y, z);
    let value = numbers(value.unwrap_or_default(), WriteMask::ALL);
    format!("  {share} × texel {place}{level}: {value}")
}

/// `+X` to `−Z`.
fn face_name(face: usize) -> String {
    let Some(axes) = CUBE_FACES.get(face) else {
        return face.to_string();
    };
    let sign = if axes.ma.negative { '−' } else { '+' };
    format!("{sign}{}", ["X", "Y", "Z"][axes.ma.axis % 3])
}

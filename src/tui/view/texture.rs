//! The last sample: its stage and coordinates, the level of the texture with the texels that were touched, and what they hold.

use super::registers::colour;
use super::{Screen, blocks, put};
use crate::tui::number::short;
use crate::tui::picture::{Canvas, Crop, Placed};
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use texcrd::debug::{Event, Run, Sample, Session, Style};
use texcrd::texture::{Footprint, Texture, TextureKind, footprint};

/// The last sample before the place.
fn last_sample<'s, 'a>(session: &'s Session<'a>) -> Option<(&'s Run<'a>, Sample)> {
    let run = session.run()?;
    let done = run.moments.iter().take(session.position().at);
    let sample = done.rev().find_map(|moment| match &moment.event {
        Event::Step { sample, .. } => *sample,
        _ => None,
    });
    Some((run, sample?))
}

/// The place of the picture and that of the text.
fn divide(area: Rect) -> (Rect, Rect) {
    if area.height >= 16 {
        // What is said of a sample of two levels has eleven rows.
        let height = area.height - (area.height / 2).min(11);
        let text = Rect {
            y: area.y + height,
            height: area.height - height,
            ..area
        };
        (Rect { height, ..area }, text)
    } else {
        let width = (area.height * 2).min(area.width / 2);
        let text = Rect {
            x: area.x + width + 1,
            width: area.width.saturating_sub(width + 1),
            ..area
        };
        (Rect { width, ..area }, text)
    }
}

pub(super) fn draw(
    screen: &Screen<'_, '_>,
    buf: &mut Buffer,
    area: Rect,
    pictures: &mut Vec<Placed>,
) -> String {
    let Some((run, sample)) = last_sample(screen.session) else {
        put(buf, area, 0, Line::from("Nothing has been sampled so far."));
        return String::new();
    };
    let lane = run.lane & 3;
    let stage = format!("stage {}", sample.stage);
    let stages = &run.environment.stages;
    let bound = stages.get(sample.stage).and_then(|s| Some((s.texture?, s)));
    let Some((texture, bound)) = bound else {
        let lines = [
            format!("{stage}: no texture is bound,"),
            "a sample is opaque black.".to_string(),
        ];
        for (row, line) in lines.into_iter().enumerate() {
            put(buf, area, row, Line::from(line));
        }
        return stage;
    };
    let found = footprint(
        texture,
        &bound.sampler,
        sample.coordinates[lane],
        sample.detail[lane],
    );
    let (room, text) = divide(area);
    pictures.extend(picture(screen, buf, room, texture, &found));
    let lines = lines(screen, texture, &sample, &found, text.width);
    for (row, line) in lines.into_iter().enumerate() {
        put(buf, text, row, line);
    }
    stage
}

/// The level that has the largest share, the face and slice of its first texel, and the texels of it that were touched.
fn shown(found: &Footprint) -> (u32, usize, u32, Vec<[u32; 2]>) {
    let heavier = |a: &&(u32, f32), b: &&(u32, f32)| a.1.total_cmp(&b.1);
    let level = found
        .levels
        .iter()
        .max_by(heavier)
        .map_or(0, |(level, _)| *level);
    let taps = || found.taps.iter().filter(|tap| tap.level == level);
    let first = taps().find_map(|tap| Some((tap.face, tap.texel?[2])));
    let (face, slice) = first.unwrap_or((found.face, 0));
    let same = taps().filter(|tap| tap.face == face);
    let texels = same
        .filter_map(|tap| tap.texel)
        .filter(|texel| texel[2] == slice);
    let texels = texels.map(|[x, y, _]| [x, y]).collect();
    (level, face, slice, texels)
}

fn picture(
    screen: &Screen<'_, '_>,
    buf: &mut Buffer,
    room: Rect,
    texture: &Texture,
    found: &Footprint,
) -> Option<Placed> {
    let (level, face, slice, texels) = shown(found);
    let [width, height, _] = texture.level_size(level)?;
    let centre = texels.first().copied().unwrap_or([width / 2, height / 2]);
    let crop = Crop::around([width, height], centre, screen.model.texture_zoom);
    let canvas = Canvas::new(room, crop, screen.cell)?;
    let at = |x: u32, y: u32| {
        let texel = texture.texel(face, level, x, y, slice).unwrap_or_default();
        colour(texel)
    };
    let look = (screen.theme, screen.cell);
    blocks::draw(&canvas, at, &texels, "x", look, buf)
}

/// From so many columns on there is room for what a texel holds.
const NUMBERS: u16 = 34;

fn lines(
    screen: &Screen<'_, '_>,
    texture: &Texture,
    sample: &Sample,
    found: &Footprint,
    columns: u16,
) -> Vec<Line<'static>> {
    let theme = screen.theme;
    let lane = screen.session.run().map_or(0, |run| run.lane & 3);
    let [u, v, w] = sample.coordinates[lane];
    let (level, face, ..) = shown(found);
    let [width, height, depth] = texture.size();
    let (size, coordinates) = match texture.kind() {
        TextureKind::Texture2D => (format!("{width}x{height}"), vec![u, v]),
        TextureKind::Cube => (format!("cube {width}, face {face}"), vec![u, v, w]),
        TextureKind::Volume => (format!("{width}x{height}x{depth}"), vec![u, v, w]),
    };
    let coordinates: Vec<String> = coordinates.into_iter().map(short).collect();
    let levels: Vec<String> = found
        .levels
        .iter()
        .map(|(level, share)| format!("{level}:{:.0}%", share * 100.0))
        .collect();
    let mut lines = vec![
        Line::from(format!("stage {}  {size}", sample.stage)),
        Line::from(format!("at {}", coordinates.join(" "))),
        Line::from(format!(
            "lod {}  {}",
            short(sample.detail[lane].lambda()),
            levels.join(" ")
        )),
    ];
    let mut taps: Vec<_> = found.taps.iter().collect();
    taps.sort_by(|a, b| b.weight.total_cmp(&a.weight));
    for tap in taps {
        let value = tap
            .texel
            .map(|[x, y, z]| (texture.texel(tap.face, tap.level, x, y, z), [x, y]));
        let (place, value) = match value {
            Some((value, [x, y])) => (format!("{x},{y}"), value.unwrap_or_default()),
            None => ("border".to_string(), [0.0; 4]),
        };
        // Only where it is another than the one of the picture.
        let other = if tap.level == level {
            String::new()
        } else {
            format!("/{}", tap.level)
        };
        let mut spans = vec![
            Span::raw(format!("{:<9}", format!("{place}{other}"))),
            Span::raw(format!("{:>4.0}% ", tap.weight * 100.0)),
        ];
        if tap.texel.is_some() {
            spans.push(Span::styled(
                "  ",
                theme.style(&Style::Swatch(colour(value))),
            ));
        }
        if columns >= NUMBERS {
            let numbers = value.map(|number| format!(" {number:.2}"));
            spans.extend(numbers.map(Span::raw));
        } else if tap.texel.is_some() {
            let [red, green, blue] = colour(value);
            spans.push(Span::raw(format!(" #{red:02x}{green:02x}{blue:02x}")));
        }
        lines.push(Line::from(spans));
    }
    lines
}

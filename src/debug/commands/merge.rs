//! The output merger, stage by stage, in words.

use super::tell::{numbers, remark};
use crate::debug::expression::number_text;
use crate::debug::moment::MergeStage;
use crate::debug::text::{Line, Style, Text};
use crate::isa::WriteMask;
use crate::raster::{BlendWeight, Compare, FogSource, Stored};

/// What a stage is called.
pub(super) fn name(stage: &MergeStage) -> &'static str {
    match stage {
        MergeStage::Killed => "texkill",
        MergeStage::Clamp => "clamp",
        MergeStage::AlphaTest(_) => "alpha test",
        MergeStage::Stencil(_) => "stencil test",
        MergeStage::Depth(_) => "depth test",
        MergeStage::Fog(_) => "fog",
        MergeStage::Blend(_) => "blend",
        MergeStage::Write { .. } => "write",
    }
}

/// What a stage did.
pub(super) fn lines(stage: &MergeStage) -> Text {
    let mut text = Text::default();
    match stage {
        MergeStage::Killed => text.line(remark(
            "the pixel is discarded: nothing is written",
            Style::Remarkable,
        )),
        // Its change tells everything.
        MergeStage::Clamp => {}
        MergeStage::AlphaTest(test) => {
            let (alpha, reference) = (test.alpha.to_string(), test.reference.to_string());
            text.line(tested(&alpha, test.func, &reference, test.passed));
        }
        MergeStage::Stencil(test) => {
            let masked = |value: u8| match test.mask {
                0xff => value.to_string(),
                mask => format!("({value} & {mask})"),
            };
            let (reference, stored) = (masked(test.reference), masked(test.stored));
            text.line(tested(&reference, test.func, &stored, test.passed));
            let words = format!("{}: the stencil is {} now", test.op, test.after);
            text.line(remark(words, Style::Dim));
        }
        MergeStage::Depth(test) => {
            let (incoming, stored) = (number_text(test.incoming), number_text(test.stored));
            text.line(tested(&incoming, test.func, &stored, test.passed));
        }
        MergeStage::Fog(fog) => {
            let source = match fog.source {
                FogSource::Vertex => "of the vertices".to_string(),
                FogSource::Table { mode, distance, .. } => {
                    format!("{mode} at distance {}", number_text(distance))
                }
            };
            let three = |[r, g, b]: [f32; 3]| numbers([r, g, b, 0.0], WriteMask::XYZ);
            text.line(remark(
                format!(
                    "factor {} ({source}), colour {}",
                    number_text(fog.clear),
                    three(fog.color)
                ),
                Style::Plain,
            ));
            text.line(remark(
                format!("{}   (was {})", three(fog.after), three(fog.before)),
                Style::Changed,
            ));
        }
        MergeStage::Blend(blend) => {
            let weight = |side: Option<BlendWeight>| match side {
                Some(weight) => format!(
                    " × {} ({})",
                    weight.factor,
                    numbers(weight.value, WriteMask::ALL)
                ),
                None => String::new(),
            };
            let [source, target] = match blend.weights {
                Some([source, target]) => [Some(source), Some(target)],
                None => [None, None],
            };
            let side = |what: &str, value: [f32; 4], by: Option<BlendWeight>| {
                let words = format!("{what} ({}){}", numbers(value, WriteMask::ALL), weight(by));
                remark(words, Style::Plain)
            };
            text.line(side("pixel ", blend.source, source));
            text.line(side("target", blend.target, target));
            let result = numbers(blend.result, WriteMask::ALL);
            text.line(remark(format!("{}: {result}", blend.op), Style::Changed));
        }
        MergeStage::Write {
            write,
            before,
            after,
        } => {
            text.line(stored("now", after));
            text.line(stored("was", before));
            if write.written != [true; 4] {
                let letters = "rgba".chars().zip(write.written);
                let written: String = letters.filter(|(_, on)| *on).map(|(c, _)| c).collect();
                let words = match written.as_str() {
                    "" => "no channel is written".to_string(),
                    channels => format!("only {channels} is written"),
                };
                text.line(remark(words, Style::Dim));
            }
        }
    }
    text
}

fn tested(left: &str, func: Compare, right: &str, passed: bool) -> Line {
    let (word, style) = match passed {
        true => ("passed", Style::Plain),
        false => ("failed: nothing is written", Style::Remarkable),
    };
    remark(format!("{left} {func} {right}: {word}"), style)
}

fn stored(word: &str, stored: &Stored) -> Line {
    remark(word, Style::Plain).joined(stored_line(stored))
}

/// What a pixel of a target holds.
pub(super) fn stored_line(stored: &Stored) -> Line {
    let [r, g, b, a] = stored.color;
    let depth = number_text(stored.depth);
    Line::from(format!(" #{r:02x}{g:02x}{b:02x} alpha {a}"))
        .and(
            format!(" depth {depth} stencil {} ", stored.stencil),
            Style::Dim,
        )
        .swatch([r, g, b])
}

//! Which colour is which number: scale bars, and legends of marks.

use super::text;
use crate::isa::WriteMask;
use crate::isa::operand::RGBA;
use crate::raster::{Look, Mark, MarkSet, Tone, View};
use image::{Rgba, RgbaImage};

/// The room between a picture and its bar.
const ABOVE: u32 = 4;
/// The height of the coloured part.
const COLORED: u32 = 12;
/// The height of a bar with its room and its numbers.
pub(super) const HEIGHT: u32 = ABOVE + COLORED + text::HEIGHT;

/// Draws the scale bar of a look: from the left the numbers from the darkest to the brightest, below them the first and
/// the last of them, and between these what is shown. The scale of the look is taken into account: the numbers are those in
/// the register.
pub(super) fn draw(sheet: &mut RgbaImage, [x, y]: [u32; 2], width: u32, look: &Look) {
    let below = y + ABOVE + COLORED;
    let steps = Steps::of(look);
    for column in 0..width {
        let number = steps.at(column, width);
        for row in 0..COLORED {
            let color = color(look, number, row);
            set(sheet, x + column, y + ABOVE + row, color);
        }
    }
    match steps {
        Steps::Range(_) => {
            let [least, most] = numbers(look);
            text::write(sheet, [x, below], &least);
            text::write(sheet, [right(x + width, &most), below], &most);
            let shown = shown(look);
            text::write(sheet, [centred(x + width / 2, &shown), below], &shown);
        }
        Steps::Signs(signs) => {
            let part = width / signs.len().max(1) as u32;
            for (place, sign) in (0..).zip(signs) {
                let label = ["< 0", "0", "> 0"][(sign + 1.0) as usize % 3];
                let middle = x + place * part + part / 2;
                text::write(sheet, [centred(middle, label), below], label);
            }
        }
    }
}

/// Names the marks that occurred in a picture, with their colours and how many pixels of it have them.
pub(super) fn legend(sheet: &mut RgbaImage, [x, y]: [u32; 2], marks: MarkSet, picture: &RgbaImage) {
    const SWATCH: u32 = 10;
    let mut top = y;
    for mark in marks.iter() {
        let color = mark.color();
        let pixels = picture
            .pixels()
            .filter(|pixel| pixel.0[..3] == color)
            .count();
        // What it was seen in may have been drawn over.
        if pixels == 0 {
            continue;
        }
        let middle = top + (text::HEIGHT - SWATCH) / 2;
        for row in 0..SWATCH {
            (0..SWATCH).for_each(|column| set(sheet, x + column, middle + row, color));
        }
        let label = match mark {
            // Of these only stripes may be coloured.
            Mark::Unwritten => mark.name().to_string(),
            _ => format!("{}: {pixels} px", mark.name()),
        };
        text::write(sheet, [x + SWATCH + text::WIDTH, top], &label);
        top += text::HEIGHT;
    }
}

/// The numbers along a bar, after the scale.
enum Steps {
    /// All from the one to the other.
    Range([f32; 2]),
    /// One for each sign.
    Signs(&'static [f32]),
}

impl Steps {
    fn of(look: &Look) -> Self {
        let length = look.view == View::Magnitude;
        match look.tone.range() {
            // No length is negative.
            Some([_, most]) if length => Self::Range([0.0, most]),
            Some(range) => Self::Range(range),
            None if length => Self::Signs(&[0.0, 1.0]),
            None => Self::Signs(&[-1.0, 0.0, 1.0]),
        }
    }

    fn at(&self, column: u32, width: u32) -> f32 {
        match self {
            Self::Range([least, most]) => {
                let share = column as f32 / width.saturating_sub(1).max(1) as f32;
                least + (most - least) * share
            }
            Self::Signs(signs) => {
                let place = column as usize * signs.len() / width.max(1) as usize;
                signs.get(place).copied().unwrap_or(1.0)
            }
        }
    }
}

/// The colour of a number, in a row of a bar: one stripe for each channel if they show different numbers.
fn color(look: &Look, number: f32, row: u32) -> [u8; 3] {
    let shown = look.shown();
    // The number is what comes after the scale.
    let plain = Look {
        scale: 1.0,
        marks_range: false,
        ..*look
    };
    let first = shown.components().next().unwrap_or(0);
    // A length is that of a vector along an axis.
    let register: [f32; 4] = match look.view {
        View::Magnitude => std::array::from_fn(|c| if c == first { number } else { 0.0 }),
        View::Color => [number; 4],
    };
    let (color, _) = plain.color(register, WriteMask::ALL, [0, 0]);
    if look.is_grey() {
        return color;
    }
    let stripe = (row * shown.count() / COLORED) as usize;
    let channel = shown.components().nth(stripe).unwrap_or(first);
    std::array::from_fn(|c| if c == channel { color[c] } else { 0 })
}

/// The numbers in the register that the two ends of a bar stand for.
pub(super) fn numbers(look: &Look) -> [String; 2] {
    let ends = match Steps::of(look) {
        Steps::Range(ends) => ends,
        Steps::Signs(_) => [-1.0, 1.0],
    };
    ends.map(|end| in_register(look, end))
}

/// A number after the scale, as it stands in the register.
fn in_register(look: &Look, scaled: f32) -> String {
    match (scaled == 0.0, look.scale == 0.0) {
        (true, _) => "0".into(),
        // Nothing becomes as bright as that.
        (false, true) => "-".into(),
        (false, false) => short(scaled / look.scale),
    }
}

/// A number with four digits.
fn short(number: f32) -> String {
    if !(1e-3..1e5).contains(&number.abs()) {
        return format!("{number:.3e}");
    }
    let digits = 3 - number.abs().log10().floor() as i32;
    let text = format!("{number:.*}", digits.max(0) as usize);
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_string(),
        false => text,
    }
}

/// What the numbers are.
fn shown(look: &Look) -> String {
    let letters: Vec<String> = (look.shown().components())
        .map(|c| RGBA[c & 3].to_string())
        .collect();
    let letters = letters.join(" ");
    match (look.view, look.tone) {
        (View::Magnitude, _) => format!("|({letters})|"),
        (View::Color, Tone::Absolute) => format!("|{}|", letters.replace(' ', "| |")),
        (View::Color, _) => letters,
    }
}

/// Where a text begins that ends here.
fn right(end: u32, text: &str) -> u32 {
    end.saturating_sub(text.chars().count() as u32 * text::WIDTH)
}

/// Where a text begins whose middle is here.
fn centred(middle: u32, text: &str) -> u32 {
    middle.saturating_sub(text.chars().count() as u32 * text::WIDTH / 2)
}

fn set(sheet: &mut RgbaImage, x: u32, y: u32, [r, g, b]: [u8; 3]) {
    if let Some(pixel) = sheet.get_pixel_mut_checked(x, y) {
        *pixel = Rgba([r, g, b, 255]);
    }
}

//! Sixel graphics: bands of six rows, one colour of a palette after the other.
//!
//! The palette is a cube of 6×6×6 colours, and what lies between them is dithered in an ordered pattern: a picture of a frame
//! moves with every key, so that coding it has to be quick and the same pixel has to look the same each time.

use image::RgbImage;
use std::collections::BTreeMap;

/// Steps of a channel in the palette.
const STEPS: u32 = 6;

/// Thresholds of a 4×4 pattern, in sixteenths.
const PATTERN: [[u32; 4]; 4] = [[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]];

/// The colour of the palette for a pixel.
fn palette(image: &RgbImage, x: u32, y: u32) -> u32 {
    let threshold = PATTERN[(y & 3) as usize][(x & 3) as usize];
    let step = |channel: u8| {
        // In 255ths of a step; the threshold, between a 32nd and 31 of them, decides about the rest.
        let scaled = u32::from(channel) * (STEPS - 1);
        let rest = scaled % 255;
        scaled / 255 + u32::from(rest * 32 > (2 * threshold + 1) * 255)
    };
    let [red, green, blue] = image.get_pixel(x, y).0.map(step);
    (red * STEPS + green) * STEPS + blue
}

/// What shows a picture at the cursor.
pub(super) fn encode(image: &RgbImage) -> String {
    let (width, height) = image.dimensions();
    // Cells that no pixel covers keep what they have; a pixel is as wide as it is high.
    let mut out = format!("\x1bP0;1;0q\"1;1;{width};{height}");
    let mut defined = [false; (STEPS * STEPS * STEPS) as usize];
    for top in (0..height).step_by(6) {
        let mut rows: BTreeMap<u32, Vec<u8>> = BTreeMap::new();
        for y in top..height.min(top + 6) {
            for x in 0..width {
                let row = rows
                    .entry(palette(image, x, y))
                    .or_insert_with(|| vec![0; width as usize]);
                row[x as usize] |= 1 << (y - top);
            }
        }
        for (color, sixels) in &rows {
            if !std::mem::replace(&mut defined[*color as usize], true) {
                let percent = |step: u32| step * 100 / (STEPS - 1);
                let (red, rest) = (color / (STEPS * STEPS), color % (STEPS * STEPS));
                let (green, blue) = (rest / STEPS, rest % STEPS);
                let [red, green, blue] = [red, green, blue].map(percent);
                out += &format!("#{color};2;{red};{green};{blue}");
            }
            out += &format!("#{color}");
            for run in sixels.chunk_by(|a, b| a == b) {
                let sixel = char::from(63 + run[0]);
                match run.len() {
                    count @ 0..=3 => out.extend(std::iter::repeat_n(sixel, count)),
                    count => out += &format!("!{count}{sixel}"),
                }
            }
            // Back to the left: the next colour of the same band.
            out.push('$');
        }
        out.push('-');
    }
    out + "\x1b\\"
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Rgb;

    #[test]
    fn a_flat_picture() {
        // White is the last colour, 215; a band of 6 rows is 63 + 63, one of the two left over 63 + 3.
        let image = RgbImage::from_pixel(5, 8, Rgb([255; 3]));
        let expected = "\x1bP0;1;0q\"1;1;5;8#215;2;100;100;100#215!5~$-#215!5B$-\x1b\\".to_string();
        assert_eq!(encode(&image), expected);
    }

    /// What a terminal would show: the percentages of each pixel, by the format's own words.
    fn decoded(text: &str, width: usize, height: usize) -> Vec<Vec<Option<[u32; 3]>>> {
        let mut shown = vec![vec![None; width]; height];
        let mut palette = BTreeMap::new();
        let body = text.split_once("\"1;1;").unwrap().1;
        let mut rest = body[body.find('#').unwrap()..]
            .strip_suffix("\x1b\\")
            .unwrap();
        let (mut x, mut top, mut color) = (0, 0, 0);
        let numbers = |rest: &mut &str| -> Vec<u32> {
            let end = rest
                .find(|c: char| !c.is_ascii_digit() && c != ';')
                .unwrap();
            let (numbers, left) = rest.split_at(end);
            *rest = left;
            numbers.split(';').map(|n| n.parse().unwrap()).collect()
        };
        while let Some(c) = rest.chars().next() {
            rest = &rest[1..];
            let (count, sixel) = match c {
                '#' => {
                    let found = numbers(&mut rest);
                    color = found[0];
                    if let [_, 2, red, green, blue] = found[..] {
                        palette.insert(color, [red, green, blue]);
                    }
                    continue;
                }
                '$' => {
                    x = 0;
                    continue;
                }
                '-' => {
                    (x, top) = (0, top + 6);
                    continue;
                }
                '!' => {
                    let count = numbers(&mut rest)[0];
                    let sixel = rest.chars().next().unwrap();
                    rest = &rest[1..];
                    (count, sixel)
                }
                sixel => (1, sixel),
            };
            for _ in 0..count {
                for row in (0..6).filter(|row| (sixel as u32 - 63) >> row & 1 == 1) {
                    assert_eq!(shown[top + row][x], None, "a pixel is drawn once");
                    shown[top + row][x] = Some(palette[&color]);
                }
                x += 1;
            }
        }
        shown
    }

    #[test]
    fn every_pixel_is_within_a_step_of_its_colour() {
        // 40 columns of red, 15 rows of green (two bands and a half), blue against both.
        let image = RgbImage::from_fn(40, 15, |x, y| {
            Rgb([x as u8 * 6, y as u8 * 17, 255 - (x + y) as u8 * 4])
        });
        let shown = decoded(&encode(&image), 40, 15);
        for (x, y, pixel) in image.enumerate_pixels() {
            let color = shown[y as usize][x as usize].expect("every pixel is drawn");
            for (channel, percent) in pixel.0.into_iter().zip(color) {
                // A step of the palette is a fifth, 20%.
                let wanted = f64::from(channel) / 2.55;
                assert!((wanted - f64::from(percent)).abs() <= 20.0, "{x}, {y}");
            }
        }
    }

    #[test]
    fn between_two_colours_half_of_the_pixels_have_each() {
        // 26·5 of 255 is a little more than half a step: of the thresholds 1/32, 3/32 … 31/32 eight lie below.
        let image = RgbImage::from_pixel(4, 4, Rgb([0, 0, 26]));
        let all = (0..16).map(|i| palette(&image, i % 4, i / 4));
        assert_eq!(all.sum::<u32>(), 8);
    }
}

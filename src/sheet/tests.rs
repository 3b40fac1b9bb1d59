//! Where things stand, and what is drawn there; worked out by hand.

use super::*;
use crate::kernel::Slot;
use crate::raster::{Look, Mark, Tone, View};

const SIZE: [u32; 2] = [100, 50];
const ALL: Dressing = Dressing {
    captions: true,
    bars: true,
    columns: None,
};
const BARE: Dressing = Dressing {
    captions: false,
    bars: false,
    columns: None,
};

fn tile(caption: &str, look: Look) -> Tile {
    Tile {
        caption: caption.to_owned(),
        picture: RegisterPicture {
            slot: Slot::R0,
            instructions: 0,
            look,
            killed: false,
        },
    }
}

fn tiles(count: usize) -> Vec<Tile> {
    vec![tile("1 mov r0, c0", Look::default()); count]
}

fn blank(_: usize) -> RgbaImage {
    RgbaImage::from_pixel(SIZE[0], SIZE[1], Rgba([7, 7, 7, 255]))
}

/// A letter is 7×16, the gap is 8, a bar 4 + 12 + 16. A tile is at least 24 letters wide: 168, and so high as caption,
/// picture and bar: 16 + 50 + 32 = 98.
#[test]
fn tiles_stand_in_rows() {
    assert_eq!([text::WIDTH, text::HEIGHT], [7, 16]);
    let layout = Layout::new(&tiles(3), SIZE, ALL, &[]).unwrap();
    // In one, two, three columns the sheet is 184×326, 360×220, 536×114: the second is nearest to 1.6.
    assert_eq!((layout.columns(), layout.size()), (2, [360, 220]));
    assert_eq!(layout.picture(0), [8, 24]);
    assert_eq!(layout.picture(1), [8 + 176, 24]);
    assert_eq!(layout.picture(2), [8, 24 + 106]);
    assert_eq!(layout.bar(2), [8, 24 + 106 + 50]);
    // Without anything beside the pictures there is no room between them. 100×100 is nearer to 1.6 than 200×50.
    let layout = Layout::new(&tiles(2), SIZE, BARE, &[]).unwrap();
    assert_eq!(layout.size(), [100, 100]);
    assert_eq!(layout.picture(1), [0, 50]);
    // Room for the legend of the picture with most marks.
    let mut marks = MarkSet::default();
    marks.insert(Mark::NotANumber);
    marks.insert(Mark::Infinite);
    let layout = Layout::new(&tiles(3), SIZE, ALL, &[MarkSet::default(), marks]).unwrap();
    assert_eq!(layout.size(), [360, 220 + 2 * 2 * 16]);
    assert_eq!(layout.legend(0), [8, 24 + 50 + 32]);
}

#[test]
fn captions_are_broken_between_words() {
    let rows = |caption: &str| {
        let tiles = [tile(caption, Look::default())];
        let layout = Layout::new(&tiles, SIZE, ALL, &[]).unwrap();
        layout.caption(&tiles[0])
    };
    assert_eq!(rows("12 lrp r2, c0, r1, r4"), ["12 lrp r2, c0, r1, r4"]);
    assert_eq!(
        rows("12 lrp_x2_sat r2.rgb, c0.r, -r1, 1-r4"),
        ["12 lrp_x2_sat r2.rgb,", "c0.r, -r1, 1-r4"]
    );
    // 24 letters fit, the last three are dots where more were.
    let long = "a".repeat(30);
    assert_eq!(rows(&long), [format!("{}...", "a".repeat(21))]);
    let many = rows(&"word ".repeat(40));
    assert_eq!(many.len(), 3);
    assert!(many[2].ends_with("..."), "{many:?}");
    assert!(rows("").is_empty());
}

#[test]
fn too_large_is_refused() {
    let refused = |count, size| Layout::new(&tiles(count), size, ALL, &[]).is_err();
    assert!(!refused(1, [4096, 4096]));
    // 16 times 2²³ pixels and what is around them is more than 2²⁷.
    assert!(refused(16, [4096, 2048]));
    assert!(refused(1, [u32::MAX, 1]));
    assert!(refused(513, [1, 1]));
    let none = compose(&[], [0, 0], BARE, &[], blank).unwrap();
    assert_eq!(none.dimensions(), (1, 1));
}

#[test]
fn pictures_and_captions_are_where_they_belong() {
    let two = [
        tile("1 mov r0, c0", Look::default()),
        tile("", Look::default()),
    ];
    let sheet = compose(&two, SIZE, ALL, &[], blank).unwrap();
    let layout = Layout::new(&two, SIZE, ALL, &[]).unwrap();
    for number in 0..2 {
        let [x, y] = layout.picture(number);
        assert_eq!(sheet.get_pixel(x, y).0, [7, 7, 7, 255]);
        assert_eq!(sheet.get_pixel(x + 99, y + 49).0, [7, 7, 7, 255]);
        assert_ne!(sheet.get_pixel(x + 100, y + 49).0, [7, 7, 7, 255]);
    }
    // What is written above the first tile: ink over its letters only. Above the second there is none.
    let inked = |[left, top]: [u32; 2], width: u32| {
        let places = (left..left + width).flat_map(|x| (top..top + 16).map(move |y| (x, y)));
        places
            .filter(|(x, y)| *sheet.get_pixel(*x, *y) != PAPER)
            .count()
    };
    let [first, second] = [0, 1].map(|number| layout.caption_row(number, 0));
    assert!(inked(first, 12 * 7) > 100);
    assert_eq!(inked([first[0] + 12 * 7, first[1]], 12 * 7), 0);
    assert_eq!(inked(second, 168), 0);
}

#[test]
fn letters_differ_and_strange_ones_are_question_marks() {
    let written = |text: &str| {
        let mut picture = RgbaImage::from_pixel(14, 16, PAPER);
        text::write(&mut picture, [0, 0], text);
        picture
    };
    assert_ne!(written("r0"), written("r1"));
    assert_eq!(written("漢x"), written("?x"));
    // Beyond the edge nothing happens.
    assert_eq!(written("r0more"), written("r0"));
}

/// The colours of a bar of 101 pixels, in the three stripes.
fn bar(look: Look) -> [Vec<[u8; 4]>; 3] {
    let mut sheet = RgbaImage::from_pixel(101, 40, PAPER);
    bar::draw(&mut sheet, [0, 0], 101, &look);
    [4, 8, 15].map(|y| (0..101).map(|x| sheet.get_pixel(x, y).0).collect())
}

#[test]
fn bars_show_the_numbers_from_dark_to_bright() {
    let [red, green, blue] = bar(Look::default());
    for (row, channel) in [(red, 0), (green, 1), (blue, 2)] {
        for (x, byte) in [(0, 0), (20, 51), (40, 102), (100, 255)] {
            let mut expected = [0, 0, 0, 255];
            expected[channel] = byte;
            assert_eq!(row[x], expected, "{channel} {x}");
        }
    }
    // A scale changes the numbers below it, not the bar.
    let grey = Look {
        view: View::Magnitude,
        scale: 7.0,
        ..Look::default()
    };
    let [row, _, other] = bar(grey);
    assert_eq!(row[20], [51, 51, 51, 255]);
    assert_eq!(row, other);
    // Mid grey is in the middle: 127.5, to the even one.
    let signed = Look {
        components: crate::isa::WriteMask::W,
        tone: Tone::Signed,
        ..Look::default()
    };
    let [row, ..] = bar(signed);
    assert_eq!([row[0], row[50], row[100]].map(|p| p[0]), [0, 128, 255]);
    let sign = Look {
        tone: Tone::Sign,
        ..signed
    };
    let [row, ..] = bar(sign);
    let [negative, zero, positive] = [row[0], row[50], row[100]].map(|p| [p[0], p[1], p[2]]);
    assert_eq!(
        [negative, zero, positive],
        [Tone::NEGATIVE, Tone::ZERO, Tone::POSITIVE]
    );
}

/// Numbers below a bar are those in the register: what is white is 1 after the scale.
#[test]
fn numbers_of_bars() {
    let ends = |tone, scale| {
        let look = Look {
            tone,
            scale,
            ..Look::default()
        };
        bar::numbers(&look)
    };
    assert_eq!(ends(Tone::Plain, 1.0), ["0", "1"]);
    assert_eq!(ends(Tone::Plain, 2.0), ["0", "0.5"]);
    assert_eq!(ends(Tone::Absolute, 0.03), ["0", "33.33"]);
    assert_eq!(ends(Tone::Signed, 4.0), ["-0.25", "0.25"]);
    assert_eq!(ends(Tone::Signed, -1.0), ["1", "-1"]);
    assert_eq!(ends(Tone::Plain, 1e-9), ["0", "1.000e9"]);
    assert_eq!(ends(Tone::Plain, 0.0), ["0", "-"]);
    assert_eq!(ends(Tone::Plain, 1.0 / 1024.0), ["0", "1024"]);
}

#[test]
fn legends_name_what_is_there() {
    let mut marks = MarkSet::default();
    marks.insert(Mark::NotANumber);
    marks.insert(Mark::Infinite);
    let mut picture = blank(0);
    picture.put_pixel(3, 3, Rgba([0, 255, 255, 255]));
    let mut sheet = RgbaImage::from_pixel(200, 40, PAPER);
    bar::legend(&mut sheet, [0, 0], marks, &picture);
    // NaN was drawn over; so infinity is in the first row, its swatch 10×10 in the middle of 16.
    assert_eq!(sheet.get_pixel(0, 3).0, [0, 255, 255, 255]);
    assert_eq!(sheet.get_pixel(9, 12).0, [0, 255, 255, 255]);
    assert_eq!(*sheet.get_pixel(10, 12), PAPER);
    assert!((16..40).all(|y| (0..200).all(|x| *sheet.get_pixel(x, y) == PAPER)));
}

/// Three pictures of 64×32 in a row of three: as wide as three tiles, as high as one.
#[test]
fn columns_can_be_wanted() {
    let wanted = |columns| Dressing {
        columns: Some(columns),
        ..BARE
    };
    let tiles = tiles(3);
    let layout = |columns| Layout::new(&tiles, [64, 32], wanted(columns), &[]).unwrap();
    assert_eq!((layout(3).columns(), layout(3).size()), (3, [192, 32]));
    assert_eq!((layout(1).columns(), layout(1).size()), (1, [64, 96]));
    // More than there are would be empty.
    assert_eq!((layout(9).columns(), layout(0).columns()), (3, 1));
}

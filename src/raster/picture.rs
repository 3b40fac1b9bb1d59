//! Registers as pictures: which colour a number gets. The only place that says it, for every front and both paths.

use super::merger::to_byte;
use super::{Attribute, LANES};
use crate::isa::WriteMask;
use crate::kernel::{Kernel, Op, Slot};

/// A register of a pixel shader, shown instead of the pixel's colour.
///
/// The pixels are those of the frame: the whole shader runs, so that `texkill` and a depth of the shader's own decide what
/// is seen whatever instruction the register is looked at after.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RegisterPicture {
    /// The register.
    pub slot: Slot,
    /// How many instructions run before it is looked at; `usize::MAX`: all.
    pub instructions: usize,
    /// What of it is shown, and how.
    pub look: Look,
    /// Whether pixels that `texkill` discards have the colour of [`Mark::Killed`] where they would be seen; else what is
    /// behind them is seen, as in the frame.
    pub killed: bool,
}

impl RegisterPicture {
    /// The steps that run before the register is looked at and write it.
    fn writes<'k>(&self, kernel: &'k Kernel) -> impl Iterator<Item = (usize, WriteMask)> + 'k {
        let Self {
            slot, instructions, ..
        } = *self;
        let steps = kernel.steps.iter().enumerate();
        steps
            .take_while(move |(_, step)| step.origin < instructions)
            .filter(move |(_, step)| step.destination == slot && step.op != Op::Kill)
            .map(|(number, step)| (number, step.mask))
    }

    /// The number of the step after which the register holds what is shown; none if it does from the start.
    pub(super) fn last_write(&self, kernel: &Kernel) -> Option<usize> {
        self.writes(kernel).last().map(|(number, _)| number)
    }

    /// The components that hold a value when the register is looked at: those that some instruction has written by then,
    /// and all of an interpolated input.
    pub fn written(&self, kernel: &Kernel) -> WriteMask {
        if self.slot.texcoord_index().is_some() || self.slot.input_index().is_some() {
            return WriteMask::ALL;
        }
        let masks = self.writes(kernel).map(|(_, mask)| mask);
        masks.fold(WriteMask::NONE, WriteMask::or)
    }
}

/// What of a register is shown, and which number is which colour. The default shows x, y and z as red, green and blue.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// The components. A single one is shown as grey. Beside others, w has no colour, but counts in a magnitude.
    pub components: WriteMask,
    /// Whether the components are shown, or their length.
    pub view: View,
    /// Which numbers are dark and which are bright.
    pub tone: Tone,
    /// What the numbers are multiplied by first. Finite.
    pub scale: f32,
    /// Whether numbers that are too small or too large for the tone are marked; else they are as dark or bright as can be.
    pub marks_range: bool,
}

impl Default for Look {
    fn default() -> Self {
        Self {
            components: WriteMask::XYZ,
            view: View::Color,
            tone: Tone::Plain,
            scale: 1.0,
            marks_range: false,
        }
    }
}

/// Whether the components of a register are shown, or their length.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum View {
    /// x, y and z as red, green and blue; those that are not shown are black. A single component as grey.
    #[default]
    Color,
    /// The length of the vector of the components, as grey.
    Magnitude,
}

/// Which numbers are dark and which are bright, after the scale.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tone {
    /// 0 is black, 1 is white.
    #[default]
    Plain,
    /// The same of the absolute value, which is taken before the scale: a negative scale makes all of it black.
    Absolute,
    /// −1 is black, 0 is mid grey, 1 is white.
    Signed,
    /// Only the sign. Of several components each channel is 0 where it is negative, half where it is 0, full where it is
    /// positive; of one component or a length: [`Tone::NEGATIVE`], [`Tone::ZERO`], [`Tone::POSITIVE`].
    Sign,
}

impl Tone {
    /// The colour of a negative number as [`Tone::Sign`] shows it.
    pub const NEGATIVE: [u8; 3] = [40, 110, 255];
    /// That of 0 and of −0.
    pub const ZERO: [u8; 3] = [96, 96, 96];
    /// That of a positive number.
    pub const POSITIVE: [u8; 3] = [255, 150, 30];

    /// The numbers, after the scale, that are as dark and as bright as can be; none for the sign.
    pub fn range(self) -> Option<[f32; 2]> {
        match self {
            Self::Plain | Self::Absolute => Some([0.0, 1.0]),
            Self::Signed => Some([-1.0, 1.0]),
            Self::Sign => None,
        }
    }

    /// How bright a number is: 0 to 1 within the range, beyond it outside.
    fn brightness(self, value: f32, scale: f32) -> f32 {
        let scaled = value * scale;
        match self {
            Self::Plain => scaled,
            Self::Absolute => value.abs() * scale,
            Self::Signed => scaled * 0.5 + 0.5,
            Self::Sign if scaled < 0.0 => 0.0,
            Self::Sign if scaled > 0.0 => 1.0,
            Self::Sign => 0.5,
        }
    }
}

/// Something about a pixel that no brightness can show.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Mark {
    /// A component that is shown has not been written yet. Where others have been, only stripes have this colour.
    Unwritten,
    /// A component that is shown is NaN.
    NotANumber,
    /// A component that is shown is infinite.
    Infinite,
    /// A number is too large for the tone ([`Look::marks_range`]).
    Above,
    /// A number is too small for it.
    Below,
    /// `texkill` discards the pixel ([`RegisterPicture::killed`]).
    Killed,
}

impl Mark {
    /// Every mark; the first one that is true of a pixel is shown.
    pub const ALL: [Self; 6] = [
        Self::Unwritten,
        Self::NotANumber,
        Self::Infinite,
        Self::Above,
        Self::Below,
        Self::Killed,
    ];

    /// Red, green and blue of the mark.
    pub fn color(self) -> [u8; 3] {
        match self {
            Self::Unwritten => [120, 90, 0],
            Self::NotANumber => [255, 0, 255],
            Self::Infinite => [0, 255, 255],
            Self::Above => [255, 60, 30],
            Self::Below => [60, 60, 255],
            Self::Killed => [130, 0, 50],
        }
    }

    /// What a legend calls it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Unwritten => "not written",
            Self::NotANumber => "NaN",
            Self::Infinite => "infinite",
            Self::Above => "above the scale",
            Self::Below => "below the scale",
            Self::Killed => "discarded",
        }
    }
}

/// A set of marks: those that occurred in a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MarkSet(u8);

impl MarkSet {
    /// The set as bits.
    pub(super) const fn bits(self) -> u8 {
        self.0
    }

    /// The set that [`Self::bits`] gave.
    pub(super) const fn from_bits(bits: u8) -> Self {
        Self(bits)
    }

    /// Adds a mark.
    pub fn insert(&mut self, mark: Mark) {
        self.0 |= 1 << mark as u8;
    }

    /// Whether a mark is in the set.
    pub fn contains(self, mark: Mark) -> bool {
        self.0 & 1 << mark as u8 != 0
    }

    /// The marks in the set.
    pub fn iter(self) -> impl Iterator<Item = Mark> {
        (Mark::ALL.into_iter()).filter(move |mark| self.contains(*mark))
    }
}

/// Stripes of [`Mark::Unwritten`] come every so many pixels, from the lower left to the upper right.
const STRIPES: u32 = 8;
/// So many pixels of these are the stripe.
const STRIPE: u32 = 2;

impl Look {
    /// The components that a colour or a length is made of.
    pub fn shown(&self) -> WriteMask {
        let colored = self.components.and(WriteMask::XYZ);
        match self.view {
            View::Color if !colored.is_empty() => colored,
            _ => self.components,
        }
    }

    /// Whether all channels show the same number.
    pub fn is_grey(&self) -> bool {
        self.view == View::Magnitude || self.shown().count() < 2
    }

    /// The colour of a register's content, and what it marks if it marks anything. `written` are the components that hold a
    /// value; the others count as 0. The place is that of the pixel.
    pub fn color(
        &self,
        register: [f32; 4],
        written: WriteMask,
        [x, y]: [u32; 2],
    ) -> ([u8; 3], Option<Mark>) {
        let shown = self.shown();
        let known = shown.and(written);
        let marked = |mark: Mark| (mark.color(), Some(mark));
        let striped = known != shown && x.wrapping_add(y) % STRIPES < STRIPE;
        if known.is_empty() || striped {
            return marked(Mark::Unwritten);
        }
        let value = |c: usize| if known.has(c) { register[c & 3] } else { 0.0 };
        let values: [f32; 4] = std::array::from_fn(value);
        if values.iter().any(|value| value.is_nan()) {
            return marked(Mark::NotANumber);
        }
        if values.iter().any(|value| value.is_infinite()) {
            return marked(Mark::Infinite);
        }
        let grey = match self.view {
            View::Magnitude => Some(length(values)),
            View::Color if self.is_grey() => Some(values.iter().sum()),
            View::Color => None,
        };
        let bright = |value: f32| self.tone.brightness(value, self.scale);
        // Channels that show nothing are black.
        let channels = match grey {
            Some(value) => [bright(value); 3],
            None => std::array::from_fn(|c| if shown.has(c) { bright(values[c]) } else { 0.0 }),
        };
        if self.marks_range && channels.iter().any(|channel| *channel > 1.0) {
            return marked(Mark::Above);
        }
        if self.marks_range && channels.iter().any(|channel| *channel < 0.0) {
            return marked(Mark::Below);
        }
        let color = match (self.tone, grey) {
            (Tone::Sign, Some(_)) if channels[0] < 0.5 => Tone::NEGATIVE,
            (Tone::Sign, Some(_)) if channels[0] > 0.5 => Tone::POSITIVE,
            (Tone::Sign, Some(_)) => Tone::ZERO,
            _ => channels.map(|channel| to_byte(super::unit(channel))),
        };
        (color, None)
    }
}

impl Look {
    /// How bright the channels of a batch are, as [`Self::color`] has them before they become bytes: most batches of most
    /// pictures at once. None, with nothing of meaning in `channels`, if a pixel that is live may need a mark or a colour
    /// that is no brightness.
    pub(super) fn channels(
        &self,
        register: &Attribute,
        written: WriteMask,
        live: &[bool; LANES],
        channels: &mut Attribute,
    ) -> Option<()> {
        let shown = self.shown();
        let grey_sign = self.tone == Tone::Sign && self.is_grey();
        if self.marks_range || grey_sign || shown.and(written) != shown {
            return None;
        }
        for c in shown.components() {
            let finite = |(value, live): (&f32, &bool)| value.is_finite() | !live;
            let all = register[c & 3].iter().zip(live).map(finite);
            if !all.fold(true, |all, finite| all & finite) {
                return None;
            }
        }
        let [red, green, blue, alpha] = channels;
        *alpha = [1.0; LANES];
        if !self.is_grey() {
            for (c, channel) in [red, green, blue].into_iter().enumerate() {
                match shown.has(c) {
                    true => self.tone.of_lanes(&register[c], self.scale, channel),
                    false => *channel = [0.0; LANES],
                }
            }
            return Some(());
        }
        let mut values = [0.0; LANES];
        match (self.view, shown.components().next()) {
            (View::Color, Some(c)) => values = register[c & 3],
            (View::Color, None) => {}
            (View::Magnitude, _) => {
                for (lane, value) in values.iter_mut().enumerate() {
                    let of = |c: usize| if shown.has(c) { register[c][lane] } else { 0.0 };
                    *value = length(std::array::from_fn(of));
                }
            }
        }
        self.tone.of_lanes(&values, self.scale, red);
        (*green, *blue) = (*red, *red);
        Some(())
    }
}

impl Tone {
    /// [`Self::brightness`] of many numbers.
    fn of_lanes(self, values: &[f32; LANES], scale: f32, to: &mut [f32; LANES]) {
        #[inline(always)]
        fn each(values: &[f32; LANES], to: &mut [f32; LANES], of: impl Fn(f32) -> f32) {
            for (value, to) in values.iter().zip(to) {
                *to = of(*value);
            }
        }
        // A loop of its own for each, with nothing to decide in it.
        match self {
            Self::Plain => each(values, to, |value| Self::Plain.brightness(value, scale)),
            Self::Absolute => each(values, to, |value| Self::Absolute.brightness(value, scale)),
            Self::Signed => each(values, to, |value| Self::Signed.brightness(value, scale)),
            Self::Sign => each(values, to, |value| Self::Sign.brightness(value, scale)),
        }
    }
}

/// In double precision, so that the square of a large number is no infinity.
fn length(values: [f32; 4]) -> f32 {
    let squares = values.map(|value| f64::from(value).powi(2));
    squares.iter().sum::<f64>().sqrt() as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    const AT: [u32; 2] = [5, 5];

    fn color(look: &Look, register: [f32; 4]) -> [u8; 3] {
        let (color, mark) = look.color(register, WriteMask::ALL, AT);
        assert_eq!(mark, None, "{look:?} {register:?}");
        color
    }

    fn mark(look: &Look, register: [f32; 4]) -> Option<Mark> {
        let (color, mark) = look.color(register, WriteMask::ALL, AT);
        assert!(mark.is_none_or(|mark| mark.color() == color));
        mark
    }

    fn of(components: u8) -> Look {
        Look {
            components: WriteMask::from_bits(components),
            ..Look::default()
        }
    }

    /// In steps of 1/255: 0.2 is 51, 0.4 is 102, 0.6 is 153, 0.8 is 204.
    #[test]
    fn components_as_colours() {
        let register = [0.2, 0.4, 0.6, 0.8];
        assert_eq!(color(&Look::default(), register), [51, 102, 153]);
        assert_eq!(color(&of(0b1111), register), [51, 102, 153]);
        assert_eq!(color(&of(0b0011), register), [51, 102, 0]);
        assert_eq!(color(&of(0b0110), register), [0, 102, 153]);
        assert_eq!(color(&of(0b0010), register), [102; 3]);
        assert_eq!(color(&of(0b1000), register), [204; 3]);
        // w has no colour of its own beside x.
        assert_eq!(color(&of(0b1001), register), [51; 3]);
        // Beyond 0 to 1 a plain picture is as dark or bright as can be.
        assert_eq!(color(&Look::default(), [-1.0, 2.0, -0.0, 0.0]), [0, 255, 0]);
    }

    #[test]
    fn tones_and_scale() {
        let with = |tone, scale| Look {
            tone,
            scale,
            ..Look::default()
        };
        let register = [-0.2, 0.4, 0.0, 0.0];
        assert_eq!(color(&with(Tone::Plain, 1.0), register), [0, 102, 0]);
        assert_eq!(color(&with(Tone::Plain, -2.0), register), [102, 0, 0]);
        assert_eq!(color(&with(Tone::Absolute, 1.0), register), [51, 102, 0]);
        assert_eq!(color(&with(Tone::Absolute, 2.0), register), [102, 204, 0]);
        assert_eq!(color(&with(Tone::Absolute, -2.0), register), [0; 3]);
        // −0.2·0.5 + 0.5 = 0.4, 0.4·0.5 + 0.5 = 0.7 (178.5, to the even one), 0 is 127.5, to the even one.
        assert_eq!(color(&with(Tone::Signed, 1.0), register), [102, 178, 128]);
        // −0.4·0.5 + 0.5 = 0.3 (76.5), 0.8·0.5 + 0.5 = 0.9 (229.5).
        let [r, g, b] = color(&with(Tone::Signed, 2.0), register);
        assert!([76, 77].contains(&r) && [229, 230].contains(&g) && b == 128);
        assert_eq!(color(&with(Tone::Sign, 1.0), register), [0, 255, 128]);
        assert_eq!(color(&with(Tone::Sign, -1.0), register), [255, 0, 128]);
        let one = Look {
            components: WriteMask::X,
            ..with(Tone::Sign, 1.0)
        };
        for (number, expected) in [
            (-1e-30, Tone::NEGATIVE),
            (-0.0, Tone::ZERO),
            (0.0, Tone::ZERO),
            (1e-30, Tone::POSITIVE),
        ] {
            assert_eq!(color(&one, [number, 9.0, -9.0, 9.0]), expected);
        }
    }

    #[test]
    fn magnitudes() {
        let long = |components, scale| Look {
            components: WriteMask::from_bits(components),
            view: View::Magnitude,
            scale,
            ..Look::default()
        };
        // √(0.12² + 0.16²) = 0.2; with 0.48 in w √(0.04 + 0.2304) = 0.52.
        let register = [0.12, -0.16, 0.0, 0.48];
        assert_eq!(color(&long(0b0111, 1.0), register), [51; 3]);
        assert_eq!(color(&long(0b0111, 4.0), register), [204; 3]);
        // 0.52·255 = 132.6.
        assert_eq!(color(&long(0b1111, 1.0), register), [133; 3]);
        // The length of one component is its absolute value: 0.16·255 = 40.8.
        assert_eq!(color(&long(0b0010, 1.0), register), [41; 3]);
        // The square of 1e30 is no float, but the length is.
        assert_eq!(color(&long(0b0111, 1e-30), [1e30, 0.0, 0.0, 0.0]), [255; 3]);
    }

    #[test]
    fn what_is_no_number_is_marked() {
        let nan = f32::NAN;
        let infinite = f32::NEG_INFINITY;
        for tone in [Tone::Plain, Tone::Absolute, Tone::Signed, Tone::Sign] {
            for view in [View::Color, View::Magnitude] {
                let look = Look {
                    tone,
                    view,
                    ..Look::default()
                };
                assert_eq!(mark(&look, [0.0, nan, 0.0, 0.0]), Some(Mark::NotANumber));
                assert_eq!(mark(&look, [0.0, infinite, 0.0, 0.0]), Some(Mark::Infinite));
                let both = [infinite, nan, 0.0, 0.0];
                assert_eq!(mark(&look, both), Some(Mark::NotANumber));
                // What is not shown marks nothing.
                assert_eq!(mark(&look, [0.0, 0.0, 0.0, nan]), None);
            }
        }
        // A finite number is none of these, whatever the scale makes of it.
        let large = Look {
            scale: 1e30,
            ..Look::default()
        };
        assert_eq!(color(&large, [1e30, -1e30, 0.0, 0.0]), [255, 0, 0]);
    }

    #[test]
    fn the_range_is_marked_where_it_is_asked_for() {
        let marking = |tone| Look {
            tone,
            marks_range: true,
            scale: 2.0,
            ..Look::default()
        };
        // The bounds themselves are in the range.
        assert_eq!(mark(&marking(Tone::Plain), [0.5, 0.0, 0.0, 9.0]), None);
        assert_eq!(
            mark(&marking(Tone::Plain), [0.51, -1.0, 0.0, 0.0]),
            Some(Mark::Above)
        );
        assert_eq!(
            mark(&marking(Tone::Plain), [0.5, -0.01, 0.0, 0.0]),
            Some(Mark::Below)
        );
        assert_eq!(mark(&marking(Tone::Absolute), [-0.5, 0.0, 0.0, 0.0]), None);
        assert_eq!(mark(&marking(Tone::Signed), [-0.5, 0.5, 0.0, 0.0]), None);
        assert_eq!(
            mark(&marking(Tone::Signed), [-0.51, 0.0, 0.0, 0.0]),
            Some(Mark::Below)
        );
        assert_eq!(mark(&marking(Tone::Sign), [9.0, -9.0, 0.0, 0.0]), None);
    }

    /// Of 8 pixels in a row 2 are stripes if something is written, all of them if nothing is.
    #[test]
    fn what_is_not_written_is_marked() {
        let marked = |components, written| {
            let look = of(components);
            let written = WriteMask::from_bits(written);
            let pixels = (0..8).map(|x| look.color([0.2; 4], written, [x, 3]));
            let colors: Vec<_> = pixels.collect();
            assert!(
                (colors.iter())
                    .all(|(color, mark)| mark.is_some() != (*color != Mark::Unwritten.color()))
            );
            colors.iter().filter(|(_, mark)| mark.is_some()).count()
        };
        assert_eq!(marked(0b0111, 0b0111), 0);
        assert_eq!(marked(0b0111, 0b0011), 2);
        assert_eq!(marked(0b0111, 0b1000), 8);
        assert_eq!(marked(0b0010, 0b1101), 8);
        assert_eq!(marked(0b1111, 0b0111), 0);
        // Between the stripes what is not written counts as 0, whatever is in it.
        let (color, _) = of(0b0111).color([0.2, 0.2, f32::NAN, 0.2], WriteMask::XY, [4, 0]);
        assert_eq!(color, [51, 51, 0]);
    }

    /// The short way for a batch gives the same bytes as the long one, wherever it is taken.
    #[test]
    fn batches_have_the_colours_of_their_pixels() {
        let numbers = [
            0.0, -0.0, 0.25, -0.3, 0.7, 1.0, 1.5, -2.0, 1e-30, 0.499, 3e38,
        ];
        let register: Attribute =
            std::array::from_fn(|c| std::array::from_fn(|lane| numbers[(lane * 5 + c * 3) % 11]));
        let live: [bool; LANES] = std::array::from_fn(|lane| lane % 3 != 1);
        let mut taken = 0;
        for bits in 1..16 {
            for tone in [Tone::Plain, Tone::Absolute, Tone::Signed, Tone::Sign] {
                for view in [View::Color, View::Magnitude] {
                    let look = Look {
                        components: WriteMask::from_bits(bits),
                        view,
                        tone,
                        scale: -1.7,
                        marks_range: false,
                    };
                    let mut channels = [[0.0; LANES]; 4];
                    if look
                        .channels(&register, WriteMask::ALL, &live, &mut channels)
                        .is_none()
                    {
                        assert!(tone == Tone::Sign && look.is_grey());
                        continue;
                    }
                    taken += 1;
                    for lane in 0..LANES {
                        let expected = color(&look, register.map(|component| component[lane]));
                        let bytes =
                            channels.map(|channel| to_byte(crate::raster::unit(channel[lane])));
                        let [r, g, b] = expected;
                        assert_eq!(bytes, [r, g, b, 255], "{look:?}");
                    }
                }
            }
        }
        assert!(taken > 80, "{taken}");
        // A NaN in a pixel that is not live, or that is not shown, is no reason for the long way.
        let look = Look::default();
        let mut channels = [[0.0; LANES]; 4];
        let mut with_nan = register;
        (with_nan[0][1], with_nan[3][0]) = (f32::NAN, f32::NAN);
        let mut ask = |register: &Attribute, written| {
            (look.channels(register, written, &live, &mut channels)).is_some()
        };
        assert!(ask(&with_nan, WriteMask::ALL));
        assert!(!ask(&register, WriteMask::XY));
        with_nan[1][0] = f32::INFINITY;
        assert!(!ask(&with_nan, WriteMask::ALL));
    }

    #[test]
    fn sets_of_marks() {
        let mut set = MarkSet::default();
        set.insert(Mark::Killed);
        set.insert(Mark::NotANumber);
        let marks: Vec<_> = set.iter().collect();
        assert_eq!(marks, [Mark::NotANumber, Mark::Killed]);
        assert_eq!(MarkSet::from_bits(set.bits()), set);
        let mut colors = Mark::ALL.map(Mark::color).to_vec();
        colors.sort_unstable();
        colors.dedup();
        assert_eq!(colors.len(), Mark::ALL.len(), "no two look the same");
    }
}

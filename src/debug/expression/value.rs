//! Values, and how they are written.

use crate::semantics;
use std::fmt;
use std::str::FromStr;

/// What an expression comes to: one to four numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Value {
    /// The numbers; those from `count` on are 0.
    pub numbers: [f32; 4],
    /// How many there are, 1 to 4.
    pub count: usize,
}

/// How a value is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Format {
    /// Decimal numbers, as short as they can be read back.
    #[default]
    Float,
    /// The 32 bits of each.
    Hex,
    /// What the hardware of the time would have kept: 9 bits of the GeForce 3 (−1 to 1 in steps of 1/255) and 16 bits of the
    /// Radeon 8500 (−8 to 8 in steps of 1/4096).
    Fixed,
    /// `#rrggbb`, clamped to 0…1.
    Colour,
}

/// A letter that names no format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UnknownFormat;

impl fmt::Display for UnknownFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("formats are /f float, /x the 32 bits, /q fixed point, /c colour")
    }
}

impl std::error::Error for UnknownFormat {}

impl FromStr for Format {
    type Err = UnknownFormat;

    /// The letter behind the slash of `print`: f, x, q, c.
    fn from_str(text: &str) -> Result<Self, UnknownFormat> {
        match text {
            "f" => Ok(Self::Float),
            "x" => Ok(Self::Hex),
            "q" => Ok(Self::Fixed),
            "c" => Ok(Self::Colour),
            _ => Err(UnknownFormat),
        }
    }
}

impl Format {
    /// The letter that names it.
    pub fn letter(self) -> char {
        match self {
            Self::Float => 'f',
            Self::Hex => 'x',
            Self::Fixed => 'q',
            Self::Colour => 'c',
        }
    }
}

impl Value {
    /// One number.
    pub fn scalar(number: f32) -> Self {
        Self {
            numbers: [number, 0.0, 0.0, 0.0],
            count: 1,
        }
    }

    /// Four numbers.
    pub fn vector(numbers: [f32; 4]) -> Self {
        Self { numbers, count: 4 }
    }

    /// Whether any component is not zero. NaN is not.
    pub fn is_true(&self) -> bool {
        self.components().iter().any(|x| *x != 0.0)
    }

    /// The numbers that there are.
    pub fn components(&self) -> &[f32] {
        self.numbers.get(..self.count).unwrap_or(&self.numbers)
    }

    /// Each component through a function.
    #[must_use]
    pub(super) fn map(self, f: impl Fn(f32) -> f32) -> Self {
        let mut result = self;
        for number in result.numbers.iter_mut().take(self.count) {
            *number = f(*number);
        }
        result
    }

    /// A single number for all of `count` components; others are as they are.
    #[must_use]
    pub fn widened(self, count: usize) -> Self {
        if self.count != 1 {
            return self;
        }
        let mut numbers = [0.0; 4];
        numbers
            .iter_mut()
            .take(count)
            .for_each(|number| *number = self.numbers[0]);
        Self {
            numbers,
            count: count.clamp(1, 4),
        }
    }

    /// Red, green, blue as 8 bits each, clamped. One number is a grey, of two blue is 0.
    pub fn colour(&self) -> [u8; 3] {
        let [r, g, b, _] = match self.count {
            1 => [self.numbers[0]; 4],
            _ => self.numbers,
        };
        // A cast takes what is left to a whole number of 0 to 255.
        [r, g, b].map(|x| (semantics::saturate(x) * 255.0).round_ties_even() as u8)
    }

    /// The value as a person reads it, on one line.
    pub fn text(&self, format: Format) -> String {
        match format {
            Format::Float => self.joined(number_text),
            Format::Hex => self.joined(|x| format!("0x{:08x}", x.to_bits())),
            Format::Fixed => format!(
                "gf3 {}; r200 {}",
                self.joined(|x| fixed(x, 1.0, 255.0)),
                self.joined(|x| fixed(x, 8.0, 4096.0))
            ),
            Format::Colour => {
                let [r, g, b] = self.colour();
                format!("#{r:02x}{g:02x}{b:02x}")
            }
        }
    }

    fn joined(&self, text: impl Fn(f32) -> String) -> String {
        let texts: Vec<String> = self.components().iter().map(|x| text(*x)).collect();
        texts.join(", ")
    }
}

/// The shortest decimal text that reads back to the same 32 bits; very large and very small numbers with an exponent.
pub fn number_text(x: f32) -> String {
    let usual = 1e-5..1e16;
    if x == 0.0 || !x.is_finite() || usual.contains(&x.abs()) {
        x.to_string()
    } else {
        format!("{x:e}")
    }
}

/// A fixed point number as its fraction: `128/255`. What does not fit is clamped, and said to be.
fn fixed(x: f32, most: f32, steps: f32) -> String {
    if x.is_nan() {
        return "NaN".to_string();
    }
    let code = (x.clamp(-most, most) * steps).round_ties_even();
    let clamped = if x.abs() > most { " (clamped)" } else { "" };
    format!("{code}/{steps}{clamped}")
}

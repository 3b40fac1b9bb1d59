//! Texture formats: one row each, and the decoding and encoding that reads the rows.

use std::fmt;
use std::str::FromStr;

use super::{TextureError, UnknownName};

/// What the codes of signed channels stand for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Signed {
    /// max(code / (2^(bits−1) − 1), −1): from −1 to 1, with a code for each of them.
    #[default]
    Symmetric,
    /// code / 2^(bits−1): from −1 to a little less than 1, as on the GeForce 3.
    Lopsided,
}

impl Signed {
    /// What the codes of so many bits are divided by.
    fn divisor(self, bits: u32) -> f32 {
        match self {
            Self::Symmetric => snorm_max(bits),
            Self::Lopsided => snorm_max(bits) + 1.0,
        }
    }

    fn decode(self, code: i32, bits: u32) -> f32 {
        (code as f32 / self.divisor(bits)).max(-1.0)
    }

    /// The nearest code. Symmetric codes leave the lowest one out.
    fn encode(self, value: f32, bits: u32) -> i32 {
        let code = (value.clamp(-1.0, 1.0) * self.divisor(bits)).round() as i32;
        code.min(snorm_max(bits) as i32)
    }
}

/// Where one of the r, g, b, a that a shader reads comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Channel {
    /// `bits` bits from bit `shift` on, unsigned: code / (2^bits − 1).
    Unorm { shift: u32, bits: u32 },
    /// The same, two's complement, as [`Signed`] says.
    Snorm { shift: u32, bits: u32 },
    /// Not stored: reads as 0.
    Zero,
    /// Not stored: reads as 1.
    One,
    /// Not stored: sqrt(1 − r² − g²), the third component of a unit vector; 0 where r² + g² exceeds 1.
    UnitZ,
}

/// How texels lie in memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Layout {
    /// One little-endian word of `bytes` bytes a texel; r, g, b, a from its bits.
    Word { bytes: u32, channels: [Channel; 4] },
    /// Four little-endian 32-bit floats a texel: r, g, b, a.
    Float,
    /// 4×4 texels in a block of this many bytes (DXT).
    Block { bytes: u32 },
}

struct Row {
    format: Format,
    name: &'static str,
    d3d: Option<u32>,
    layout: Layout,
}

const fn unorm(shift: u32, bits: u32) -> Channel {
    Channel::Unorm { shift, bits }
}
const fn snorm(shift: u32, bits: u32) -> Channel {
    Channel::Snorm { shift, bits }
}
const fn word(bytes: u32, channels: [Channel; 4]) -> Layout {
    Layout::Word { bytes, channels }
}
const fn four_cc(code: &[u8; 4]) -> u32 {
    u32::from_le_bytes(*code)
}
const ONE: Channel = Channel::One;
const ZERO: Channel = Channel::Zero;

/// Declares the enum and its table together, so that a row's place in the table is the enum's number.
macro_rules! formats {
    ($($(#[$doc:meta])* $id:ident $name:literal $d3d:expr, $layout:expr;)*) => {
        /// A texture format by its Direct3D name; channels are named from the high bits to the low bits.
        ///
        /// What a shader reads follows the Direct3D 8 rule: unsigned code / (2^bits − 1), signed
        /// max(code / (2^(bits−1) − 1), −1), channels that the format lacks as each variant says.
        /// Parses from and prints as the Direct3D name in lower case (`a8r8g8b8`, `v8u8`, `dxt1`).
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        pub enum Format { $($(#[$doc])* $id,)* }

        const ROWS: &[Row] = &[$(Row { format: Format::$id, name: $name, d3d: $d3d, layout: $layout },)*];
    };
}

formats! {
    /// 8 bits each of alpha, red, green, blue.
    A8R8G8B8 "a8r8g8b8" Some(21), word(4, [unorm(16, 8), unorm(8, 8), unorm(0, 8), unorm(24, 8)]);
    /// As `A8R8G8B8` with the high byte unused; alpha 1.
    X8R8G8B8 "x8r8g8b8" Some(22), word(4, [unorm(16, 8), unorm(8, 8), unorm(0, 8), ONE]);
    /// Three bytes: blue, green, red; alpha 1.
    R8G8B8 "r8g8b8" Some(20), word(3, [unorm(16, 8), unorm(8, 8), unorm(0, 8), ONE]);
    /// 5, 6, 5 bits; alpha 1.
    R5G6B5 "r5g6b5" Some(23), word(2, [unorm(11, 5), unorm(5, 6), unorm(0, 5), ONE]);
    /// 5 bits a colour, high bit unused; alpha 1.
    X1R5G5B5 "x1r5g5b5" Some(24), word(2, [unorm(10, 5), unorm(5, 5), unorm(0, 5), ONE]);
    /// 5 bits a colour, 1 bit alpha.
    A1R5G5B5 "a1r5g5b5" Some(25), word(2, [unorm(10, 5), unorm(5, 5), unorm(0, 5), unorm(15, 1)]);
    /// 4 bits each.
    A4R4G4B4 "a4r4g4b4" Some(26), word(2, [unorm(8, 4), unorm(4, 4), unorm(0, 4), unorm(12, 4)]);
    /// 8 bits luminance: (L, L, L, 1).
    L8 "l8" Some(50), word(1, [unorm(0, 8), unorm(0, 8), unorm(0, 8), ONE]);
    /// 8 bits alpha, 8 bits luminance: (L, L, L, A).
    A8L8 "a8l8" Some(51), word(2, [unorm(0, 8), unorm(0, 8), unorm(0, 8), unorm(8, 8)]);
    /// 4 bits alpha, 4 bits luminance: (L, L, L, A).
    A4L4 "a4l4" Some(52), word(1, [unorm(0, 4), unorm(0, 4), unorm(0, 4), unorm(4, 4)]);
    /// 8 bits alpha: (0, 0, 0, A).
    A8 "a8" Some(28), word(1, [ZERO, ZERO, ZERO, unorm(0, 8)]);
    /// 4×4 blocks of 8 bytes, colours and one punch-through transparent black.
    Dxt1 "dxt1" Some(four_cc(b"DXT1")), Layout::Block { bytes: 8 };
    /// As `Dxt3`; the colours are meant to be multiplied by alpha already, which decoding does not undo.
    Dxt2 "dxt2" Some(four_cc(b"DXT2")), Layout::Block { bytes: 16 };
    /// 4×4 blocks of 16 bytes, 4 bits of alpha a texel.
    Dxt3 "dxt3" Some(four_cc(b"DXT3")), Layout::Block { bytes: 16 };
    /// As `Dxt5`; the colours are meant to be multiplied by alpha already, which decoding does not undo.
    Dxt4 "dxt4" Some(four_cc(b"DXT4")), Layout::Block { bytes: 16 };
    /// 4×4 blocks of 16 bytes, alpha interpolated between two ends.
    Dxt5 "dxt5" Some(four_cc(b"DXT5")), Layout::Block { bytes: 16 };
    /// Signed U in the low byte, V in the high byte: (U, V, 1, 1).
    V8U8 "v8u8" Some(60), word(2, [snorm(0, 8), snorm(8, 8), ONE, ONE]);
    /// Signed U and V, unsigned luminance: (U, V, L, 1).
    L6V5U5 "l6v5u5" Some(61), word(2, [snorm(0, 5), snorm(5, 5), unorm(10, 6), ONE]);
    /// Signed U and V, unsigned luminance: (U, V, L, 1).
    X8L8V8U8 "x8l8v8u8" Some(62), word(4, [snorm(0, 8), snorm(8, 8), unorm(16, 8), ONE]);
    /// Four signed bytes: (U, V, W, Q).
    Q8W8V8U8 "q8w8v8u8" Some(63), word(4, [snorm(0, 8), snorm(8, 8), snorm(16, 8), snorm(24, 8)]);
    /// Two signed 16-bit numbers: (U, V, 1, 1).
    V16U16 "v16u16" Some(64), word(4, [snorm(0, 16), snorm(16, 16), ONE, ONE]);
    /// Signed, 10, 11 and 11 bits from the low end: (U, V, W, 1). Direct3D 8 only.
    W11V11U10 "w11v11u10" Some(65), word(4, [snorm(0, 10), snorm(10, 11), snorm(21, 11), ONE]);
    /// Signed, 10 bits each, and 2 bits of unsigned alpha: (U, V, W, A).
    A2W10V10U10 "a2w10v10u10" Some(67), word(4, [snorm(0, 10), snorm(10, 10), snorm(20, 10), unorm(30, 2)]);
    /// Two signed bytes of a unit vector: (U, V, sqrt(1 − U² − V²), 1).
    CxV8U8 "cxv8u8" Some(117), word(2, [snorm(0, 8), snorm(8, 8), Channel::UnitZ, ONE]);
    /// Four bytes in the order red, green, blue, alpha (Direct3D's `A8B8G8R8`).
    Rgba8 "rgba8" Some(32), word(4, [unorm(0, 8), unorm(8, 8), unorm(16, 8), unorm(24, 8)]);
    /// Four 32-bit floats: red, green, blue, alpha; values are kept as they are.
    Rgba32F "rgba32f" Some(116), Layout::Float;
}

impl Format {
    /// Every format, in the order of the declaration.
    pub fn all() -> impl Iterator<Item = Self> {
        ROWS.iter().map(|row| row.format)
    }

    fn row(self) -> &'static Row {
        &ROWS[self as usize]
    }

    /// The Direct3D name in lower case.
    pub fn name(self) -> &'static str {
        self.row().name
    }

    /// The format with this `D3DFORMAT` number (for DXT, and in DDS files, a four-character code).
    pub fn from_d3d(code: u32) -> Option<Self> {
        ROWS.iter()
            .find(|row| row.d3d == Some(code))
            .map(|row| row.format)
    }

    /// The `D3DFORMAT` number.
    pub fn d3d(self) -> Option<u32> {
        self.row().d3d
    }

    pub(super) fn layout(self) -> Layout {
        self.row().layout
    }

    /// Whether texels are 4×4 compressed blocks (DXT).
    pub fn is_compressed(self) -> bool {
        matches!(self.layout(), Layout::Block { .. })
    }

    /// Whether every value that the format can hold is a whole number of 1/255, so that four bytes keep it exactly.
    pub fn is_packed(self) -> bool {
        match self.layout() {
            Layout::Word { channels, .. } => channels.iter().all(|channel| {
                matches!(
                    channel,
                    Channel::Unorm { bits: 8, .. } | Channel::Zero | Channel::One
                )
            }),
            Layout::Float => false,
            Layout::Block { .. } => true,
        }
    }

    /// Bytes that `width`×`height`×`depth` texels take in memory, rows and slices tightly packed.
    pub fn byte_count(self, width: u32, height: u32, depth: u32) -> u64 {
        let [w, h, d] = [width, height, depth].map(u64::from);
        match self.layout() {
            Layout::Word { bytes, .. } => w * h * d * u64::from(bytes),
            Layout::Float => w * h * d * 16,
            Layout::Block { bytes } => w.div_ceil(4) * h.div_ceil(4) * d * u64::from(bytes),
        }
    }

    /// What a shader reads for a border texel: channels that the format lacks keep the format's own value.
    pub fn with_fill(self, mut border: [f32; 4]) -> [f32; 4] {
        if let Layout::Word { channels, .. } = self.layout() {
            for (value, channel) in border.iter_mut().zip(channels) {
                match channel {
                    Channel::Zero => *value = 0.0,
                    Channel::One => *value = 1.0,
                    Channel::Unorm { .. } | Channel::Snorm { .. } | Channel::UnitZ => {}
                }
            }
            fill_unit_z(&mut border, &channels);
        }
        border
    }

    /// The value nearest to `texel` that the format holds, as a shader reads it. Formats without fixed steps
    /// (floats) return it unchanged; DXT, which has no steps of a single texel, rounds to 1/255.
    pub(super) fn quantize(self, texel: [f32; 4], signed: Signed) -> [f32; 4] {
        match self.layout() {
            Layout::Word { channels, .. } => {
                decode_word(encode_word(texel, &channels, signed), &channels, signed)
            }
            Layout::Float => texel,
            Layout::Block { .. } => unpack8(pack8(texel)).map(|code| code / 255.0),
        }
    }
}

impl fmt::Display for Format {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(self.name())
    }
}

impl FromStr for Format {
    type Err = UnknownName;

    fn from_str(name: &str) -> Result<Self, UnknownName> {
        let row = ROWS.iter().find(|row| row.name.eq_ignore_ascii_case(name));
        row.map(|row| row.format).ok_or_else(|| {
            UnknownName::new("texture format", name, ROWS.iter().map(|row| row.name))
        })
    }
}

/// Four channels of 0 to 1 as bytes, red lowest; rounded to nearest.
pub(super) fn pack8(texel: [f32; 4]) -> u32 {
    u32::from_le_bytes(texel.map(|value| unorm_code(value, 8) as u8))
}

/// The four byte codes of a packed texel, 0 to 255.
#[inline(always)]
pub(super) fn unpack8(texel: u32) -> [f32; 4] {
    [
        texel & 0xff,
        texel >> 8 & 0xff,
        texel >> 16 & 0xff,
        texel >> 24,
    ]
    .map(|code| code as f32)
}

fn mask(bits: u32) -> u32 {
    u32::MAX >> (32 - bits)
}

fn unorm_code(value: f32, bits: u32) -> u32 {
    // The cast turns NaN into 0.
    (value.clamp(0.0, 1.0) * mask(bits) as f32).round() as u32
}

fn snorm_max(bits: u32) -> f32 {
    mask(bits - 1) as f32
}

pub(super) fn decode_word(word: u32, channels: &[Channel; 4], signed: Signed) -> [f32; 4] {
    let mut texel = channels.map(|channel| match channel {
        Channel::Unorm { shift, bits } => (word >> shift & mask(bits)) as f32 / mask(bits) as f32,
        Channel::Snorm { shift, bits } => {
            let code = (word << (32 - shift - bits)) as i32 >> (32 - bits);
            signed.decode(code, bits)
        }
        Channel::Zero | Channel::UnitZ => 0.0,
        Channel::One => 1.0,
    });
    fill_unit_z(&mut texel, channels);
    texel
}

fn fill_unit_z(texel: &mut [f32; 4], channels: &[Channel; 4]) {
    let [u, v, ..] = *texel;
    for (value, channel) in texel.iter_mut().zip(channels) {
        if *channel == Channel::UnitZ {
            *value = (1.0 - u * u - v * v).max(0.0).sqrt();
        }
    }
}

/// The nearest word. Where several channels share a field (luminance), red is the one that is stored.
pub(super) fn encode_word(texel: [f32; 4], channels: &[Channel; 4], signed: Signed) -> u32 {
    let mut word = 0;
    for (value, channel) in texel.into_iter().zip(channels).rev() {
        let (shift, bits, code) = match *channel {
            Channel::Unorm { shift, bits } => (shift, bits, unorm_code(value, bits)),
            Channel::Snorm { shift, bits } => {
                let code = signed.encode(value, bits);
                (shift, bits, code as u32 & mask(bits))
            }
            Channel::Zero | Channel::One | Channel::UnitZ => continue,
        };
        word = word & !(mask(bits) << shift) | code << shift;
    }
    word
}

/// Turns stored words, as a text file lists them, into the bytes that [`super::Texture::from_raw`] takes.
///
/// One word is one texel of the format (1 to 4 bytes). For `rgba32f` four words are a texel, each the bits of a
/// float; for DXT a word is 32 bits of a block, in memory order.
///
/// # Errors
/// [`TextureError::Words`] when a word has more bits than a texel.
pub fn words_to_bytes(format: Format, words: &[u32]) -> Result<Vec<u8>, TextureError> {
    let bytes = match format.layout() {
        Layout::Word { bytes, .. } => bytes,
        Layout::Float | Layout::Block { .. } => 4,
    };
    let mut out = Vec::with_capacity(words.len() * bytes as usize);
    for &word in words {
        if word > mask(bytes * 8) {
            let problem = format!("{word:#x} does not fit into {} bits", bytes * 8);
            return Err(TextureError::Words { format, problem });
        }
        out.extend(word.to_le_bytes().into_iter().take(bytes as usize));
    }
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(format: Format, word: u32) -> [f32; 4] {
        match format.layout() {
            Layout::Word { channels, .. } => decode_word(word, &channels, Signed::Symmetric),
            _ => panic!("{format} has no words"),
        }
    }

    /// Expected values: codes put into the bits that section 9 of the specification lists, divided by hand.
    #[test]
    fn every_word_format_decodes() {
        use Format::*;
        let cases: &[(Format, u32, [f32; 4])] = &[
            (
                A8R8G8B8,
                0x8033_66ff,
                [51.0 / 255.0, 102.0 / 255.0, 1.0, 128.0 / 255.0],
            ),
            (
                X8R8G8B8,
                0x0033_66ff,
                [51.0 / 255.0, 102.0 / 255.0, 1.0, 1.0],
            ),
            (R8G8B8, 0x0033_66ff, [51.0 / 255.0, 102.0 / 255.0, 1.0, 1.0]),
            (
                R5G6B5,
                1 << 11 | 2 << 5 | 3,
                [1.0 / 31.0, 2.0 / 63.0, 3.0 / 31.0, 1.0],
            ),
            (
                X1R5G5B5,
                1 << 10 | 2 << 5 | 3,
                [1.0 / 31.0, 2.0 / 31.0, 3.0 / 31.0, 1.0],
            ),
            (
                A1R5G5B5,
                1 << 10 | 2 << 5 | 3,
                [1.0 / 31.0, 2.0 / 31.0, 3.0 / 31.0, 0.0],
            ),
            (A1R5G5B5, 0x8000, [0.0, 0.0, 0.0, 1.0]),
            (
                A4R4G4B4,
                0x4123,
                [1.0 / 15.0, 2.0 / 15.0, 3.0 / 15.0, 4.0 / 15.0],
            ),
            (L8, 0x33, [0.2, 0.2, 0.2, 1.0]),
            (A8L8, 0x6633, [0.2, 0.2, 0.2, 0.4]),
            (A4L4, 0x63, [0.2, 0.2, 0.2, 0.4]),
            (A8, 0x33, [0.0, 0.0, 0.0, 0.2]),
            (V8U8, 0x7f80, [-1.0, 1.0, 1.0, 1.0]),
            (V8U8, 0x8101, [1.0 / 127.0, -1.0, 1.0, 1.0]),
            (V8U8, 0xc000, [0.0, -64.0 / 127.0, 1.0, 1.0]),
            (L6V5U5, 63 << 10 | 0x10 << 5 | 15, [1.0, -1.0, 1.0, 1.0]),
            (
                L6V5U5,
                21 << 10 | 0x1f << 5 | 1,
                [1.0 / 15.0, -1.0 / 15.0, 21.0 / 63.0, 1.0],
            ),
            (X8L8V8U8, 0xaaff_8001, [1.0 / 127.0, -1.0, 1.0, 1.0]),
            (Q8W8V8U8, 0x807f_81fe, [-2.0 / 127.0, -1.0, 1.0, -1.0]),
            (V16U16, 0xc000_8000, [-1.0, -16384.0 / 32767.0, 1.0, 1.0]),
            (V16U16, 0x7fff_0001, [1.0 / 32767.0, 1.0, 1.0, 1.0]),
            (
                W11V11U10,
                0x400 << 21 | 0x3ff << 10 | 0x3ff,
                [-1.0 / 511.0, 1.0, -1.0, 1.0],
            ),
            (
                A2W10V10U10,
                2 << 30 | 0x200 << 20 | 0x1ff << 10 | 1,
                [1.0 / 511.0, 1.0, -1.0, 2.0 / 3.0],
            ),
            // 0² + (−64/127)²: 1 − 4096/16129 = 12033/16129.
            (
                CxV8U8,
                0xc000,
                [0.0, -64.0 / 127.0, (12033.0f32 / 16129.0).sqrt(), 1.0],
            ),
            // U = V = 1: nothing is left under the root.
            (CxV8U8, 0x7f7f, [1.0, 1.0, 0.0, 1.0]),
            (
                Rgba8,
                0x8033_66ff,
                [1.0, 102.0 / 255.0, 51.0 / 255.0, 128.0 / 255.0],
            ),
        ];
        for &(format, word, expected) in cases {
            for (got, want) in read(format, word).into_iter().zip(expected) {
                assert!(
                    (got - want).abs() < 1e-7,
                    "{format} {word:#x}: {got} instead of {want}"
                );
            }
        }
        for format in Format::all().filter(|format| matches!(format.layout(), Layout::Word { .. }))
        {
            assert!(
                cases.iter().any(|case| case.0 == format),
                "{format} has no case"
            );
        }
    }

    #[test]
    fn minus_128_and_minus_127_are_both_exactly_minus_one() {
        assert_eq!(read(Format::V8U8, 0x8081), [-1.0, -1.0, 1.0, 1.0]);
    }

    /// Codes divided by 2^(bits−1), as the specification says of the GeForce 3.
    #[test]
    fn lopsided_codes_reach_minus_one_but_not_one() {
        let read = |format: Format, word| match format.layout() {
            Layout::Word { channels, .. } => decode_word(word, &channels, Signed::Lopsided),
            _ => panic!("{format} has no words"),
        };
        assert_eq!(read(Format::V8U8, 0x7f80), [-1.0, 127.0 / 128.0, 1.0, 1.0]);
        assert_eq!(
            read(Format::V16U16, 0x7fff_c000),
            [-0.5, 32767.0 / 32768.0, 1.0, 1.0]
        );
        // Luminance stays unsigned: 63/63.
        assert_eq!(
            read(Format::L6V5U5, 63 << 10 | 0x10 << 5 | 15),
            [15.0 / 16.0, -1.0, 1.0, 1.0]
        );
        // Nearest to 1 is the largest code; −1 has one of its own.
        assert_eq!(
            Format::V8U8.quantize([1.0, -1.0, 0.0, 0.0], Signed::Lopsided),
            [127.0 / 128.0, -1.0, 1.0, 1.0]
        );
    }

    #[test]
    fn numbers_are_rounded_to_what_the_format_holds() {
        // 0.5·255 = 127.5 rounds to 128; 0.5·127 = 63.5 rounds to 64 (away from zero on both sides).
        assert_eq!(
            Format::Rgba8.quantize([0.5, 2.0, -1.0, f32::NAN], Signed::Symmetric),
            [128.0 / 255.0, 1.0, 0.0, 0.0]
        );
        assert_eq!(
            Format::V8U8.quantize([0.5, -0.5, 0.3, 0.3], Signed::Symmetric),
            [64.0 / 127.0, -64.0 / 127.0, 1.0, 1.0]
        );
        // Luminance takes red.
        assert_eq!(
            Format::A8L8.quantize([1.0, 0.0, 0.5, 0.0], Signed::Symmetric),
            [1.0, 1.0, 1.0, 0.0]
        );
        // 0.5·31 = 15.5 → 16, 0.5·63 = 31.5 → 32.
        assert_eq!(
            Format::R5G6B5.quantize([0.5, 0.5, 0.0, 0.0], Signed::Symmetric),
            [16.0 / 31.0, 32.0 / 63.0, 0.0, 1.0]
        );
    }

    #[test]
    fn words_survive_decoding_and_encoding() {
        for format in Format::all() {
            let Layout::Word { bytes, channels } = format.layout() else {
                continue;
            };
            for seed in 0..2000u32 {
                let word = seed.wrapping_mul(0x9e37_79b9) & mask(bytes * 8);
                for signed in [Signed::Symmetric, Signed::Lopsided] {
                    let once = decode_word(word, &channels, signed);
                    let again = encode_word(once, &channels, signed);
                    assert_eq!(
                        decode_word(again, &channels, signed),
                        once,
                        "{format} {word:#x}"
                    );
                }
            }
        }
    }

    #[test]
    fn the_table_lies_in_the_order_of_the_enum_and_names_parse() {
        for (index, row) in ROWS.iter().enumerate() {
            assert_eq!(row.format as usize, index);
            assert_eq!(row.name.parse::<Format>(), Ok(row.format));
            assert_eq!(row.name.to_uppercase().parse::<Format>(), Ok(row.format));
            assert_eq!(
                Format::from_d3d(row.format.d3d().unwrap()),
                Some(row.format)
            );
        }
        let message = "v8u9".parse::<Format>().unwrap_err().to_string();
        assert!(
            message.contains("v8u9") && message.contains("v8u8"),
            "{message}"
        );
    }

    #[test]
    fn words_become_little_endian_bytes_of_the_texel_size() {
        assert_eq!(
            words_to_bytes(Format::V8U8, &[0x1234, 0xff]),
            Ok(vec![0x34, 0x12, 0xff, 0])
        );
        assert_eq!(
            words_to_bytes(Format::R8G8B8, &[0x0012_3456]),
            Ok(vec![0x56, 0x34, 0x12])
        );
        assert!(words_to_bytes(Format::L8, &[256]).is_err());
    }
}

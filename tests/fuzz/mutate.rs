//! Changes that a seed and a generator of random numbers make: the same seed, the same mutants.

use crate::seeds::Seeds;
use texcrd::generate::Random;
use texcrd::isa::{Opcode, SourceModifier, Version};

/// The most changes to one input.
const MOST_CHANGES: u32 = 8;
/// Texts and streams are not made longer than this many bytes or words.
const LONGEST: usize = 1 << 16;

/// A mutated text.
pub fn text(random: &mut Random, seeds: &Seeds) -> Vec<u8> {
    let mut text = one_of(random, &seeds.texts).to_vec();
    for _ in 0..changes(random) {
        change_text(random, &mut text, seeds);
    }
    text
}

/// A mutated stream.
pub fn stream(random: &mut Random, seeds: &Seeds) -> Vec<u32> {
    let mut words = match random.chance(80) {
        true => one_of(random, &seeds.streams).to_vec(),
        false => likely(random),
    };
    for _ in 0..changes(random) {
        change_stream(random, &mut words, seeds);
    }
    words
}

/// A version and words of which streams are made, so that random ones get far.
fn likely(random: &mut Random) -> Vec<u32> {
    let versions: Vec<Version> = Version::all().collect();
    let mut words: Vec<u32> = random
        .pick(&versions)
        .map(Version::token)
        .into_iter()
        .collect();
    for _ in 0..random.below(60) {
        words.extend(random.pick(&TOKENS));
    }
    words
}

/// One change, so that much of what was valid stays so, or several.
fn changes(random: &mut Random) -> u32 {
    match random.chance(50) {
        true => 1,
        false => 1 + random.below(MOST_CHANGES),
    }
}

fn one_of<'a, T>(random: &mut Random, items: &'a [Vec<T>]) -> &'a [T] {
    let at = random.below(items.len() as u32) as usize;
    items.get(at).map_or(&[], Vec::as_slice)
}

/// A place in a list of this length, its end included.
fn place(random: &mut Random, length: usize) -> usize {
    random.below(length as u32 + 1) as usize
}

/// A range of a list of this length, more often a short one.
fn range(random: &mut Random, length: usize) -> std::ops::Range<usize> {
    let start = place(random, length);
    let longest = if random.chance(70) { 12 } else { length };
    let end = start + place(random, longest);
    start..end.min(length)
}

/// One change to a text.
pub fn change_text(random: &mut Random, text: &mut Vec<u8>, seeds: &Seeds) {
    let at = place(random, text.len());
    match random.below(16) {
        0 => flip(random, text),
        1 => insert(text, at, &[random.bits() as u8]),
        2 => drop(text.drain(range(random, text.len()))),
        3 => {
            let copied = text[range(random, text.len())].to_vec();
            insert(text, at, &copied);
        }
        4..=6 => change_lines(random, text, seeds),
        7..=9 => replace_word(random, text),
        10 => {
            let word = word(random);
            insert(text, at, word.as_bytes());
        }
        11 => replace_number(random, text),
        12 => {
            let piece = random.pick(&PIECES).unwrap_or_default();
            insert(text, at, piece.as_bytes());
        }
        13 => {
            let directive = directive(random);
            let start = text[..at].iter().rposition(|b| *b == b'\n');
            insert(text, start.map_or(0, |n| n + 1), directive.as_bytes());
        }
        14 => text.truncate(at),
        _ => {
            let other = one_of(random, &seeds.texts);
            let piece = other[range(random, other.len())].to_vec();
            insert(text, at, &piece);
        }
    }
    text.truncate(LONGEST);
}

fn insert<T: Copy>(list: &mut Vec<T>, at: usize, piece: &[T]) {
    list.splice(at..at, piece.iter().copied());
}

fn flip(random: &mut Random, text: &mut [u8]) {
    let at = random.below(text.len() as u32) as usize;
    let bit = 1 << random.below(8);
    if let Some(byte) = text.get_mut(at) {
        *byte ^= bit;
    }
}

/// Whole lines change places, are doubled, go, or come from another text.
fn change_lines(random: &mut Random, text: &mut Vec<u8>, seeds: &Seeds) {
    let mut lines: Vec<&[u8]> = text.split_inclusive(|b| *b == b'\n').collect();
    let (a, b) = (place(random, lines.len()), place(random, lines.len()));
    let within = a < lines.len() && b < lines.len();
    match random.below(6) {
        0 if within => lines.swap(a, b),
        1 if within => drop(lines.remove(a)),
        2 if within => {
            let count = if random.chance(90) { 1 } else { 150 };
            lines.splice(b..b, std::iter::repeat_n(lines[a], count));
        }
        3 if within => lines[a.min(b)..=a.max(b)].reverse(),
        // The line loses its end.
        4 if within => lines[a] = lines[a].strip_suffix(b"\n").unwrap_or(lines[a]),
        _ => {
            let other = one_of(random, &seeds.texts);
            let others: Vec<&[u8]> = other.split_inclusive(|b| *b == b'\n').collect();
            let from = random.below(others.len() as u32) as usize;
            lines.splice(a..a, others.get(from).copied());
        }
    }
    *text = lines.concat();
}

/// Where words of letters, digits and `_` stand.
fn words_of(text: &[u8], inside: impl Fn(&u8) -> bool) -> Vec<std::ops::Range<usize>> {
    let mut words = Vec::new();
    let mut start = None;
    for at in 0..=text.len() {
        match (text.get(at).is_some_and(&inside), start) {
            (true, None) => start = Some(at),
            (false, Some(from)) => {
                words.push(from..at);
                start = None;
            }
            _ => {}
        }
    }
    words
}

fn pick_range(
    random: &mut Random,
    ranges: &[std::ops::Range<usize>],
) -> Option<std::ops::Range<usize>> {
    ranges
        .get(random.below(ranges.len() as u32) as usize)
        .cloned()
}

fn replace_word(random: &mut Random, text: &mut Vec<u8>) {
    let words = words_of(text, |b| b.is_ascii_alphanumeric() || *b == b'_');
    if let Some(range) = pick_range(random, &words) {
        text.splice(range, word(random).into_bytes());
    }
}

fn replace_number(random: &mut Random, text: &mut Vec<u8>) {
    let numbers = words_of(text, u8::is_ascii_digit);
    if let Some(range) = pick_range(random, &numbers) {
        let number = match random.chance(60) {
            true => random.below(20).to_string(),
            false => random.pick(&NUMBERS).unwrap_or_default().to_string(),
        };
        text.splice(range, number.into_bytes());
    }
}

/// A word of the language.
fn word(random: &mut Random) -> String {
    let number = random.below(16);
    let file = ["r", "v", "c", "t", "oT", "oD", "a"];
    match random.below(8) {
        0 | 1 => {
            let all: Vec<Opcode> = Opcode::all().collect();
            random.pick(&all).map_or("", Opcode::mnemonic).to_string()
        }
        2 | 3 => format!("{}{}", random.pick(&file).unwrap_or("r"), number % 8),
        4 => format!("c{}", random.pick(&NUMBERS).unwrap_or("0")),
        5 => {
            let all: Vec<&str> = SourceModifier::suffixes().collect();
            format!("r{}{}", number % 6, random.pick(&all).unwrap_or(""))
        }
        6 => {
            let all: Vec<Version> = Version::all().collect();
            random.pick(&all).map_or("", Version::name).to_string()
        }
        _ => random.pick(&WORDS).unwrap_or("mov").to_string(),
    }
}

/// Lines for the preprocessor, among them macros that grow by doubling and macros that call themselves.
fn directive(random: &mut Random) -> String {
    let depth = random.below(24);
    match random.below(8) {
        0 => {
            let mut text = String::from("#define m0 mov r0, r1\n");
            for at in 0..depth {
                text += &format!("#define m{} m{at} \\\n m{at}\n", at + 1);
            }
            text + &format!("m{depth}\n")
        }
        1 => format!(
            "#define f(x) g(x, x)\n#define g(x, y) f(x) x y\n{}r0{}\n",
            "f(".repeat(depth as usize),
            ")".repeat(depth as usize)
        ),
        2 => format!("#define {} {}\n", word(random), word(random)),
        3 => format!("#if {}\n", "(1 + ".repeat(depth as usize * 4)),
        _ => random.pick(&DIRECTIVES).unwrap_or("#\n").to_string(),
    }
}

/// One change to a stream.
pub fn change_stream(random: &mut Random, words: &mut Vec<u32>, seeds: &Seeds) {
    let at = place(random, words.len());
    let there = random.below(words.len() as u32) as usize;
    match random.below(12) {
        0..=2 => {
            let bit = 1 << random.below(32);
            if let Some(word) = words.get_mut(there) {
                *word ^= bit;
            }
        }
        3 => {
            let bits = random.bits();
            if let Some(word) = words.get_mut(there) {
                *word = bits;
            }
        }
        4 => {
            let token = random.pick(&TOKENS).unwrap_or_default();
            insert(words, at, &[token]);
        }
        5 => {
            // An operand, or an instruction by number.
            let bits = random.bits();
            let word = match random.chance(50) {
                true => bits | 1 << 31,
                false => bits & 0x4000_005F,
            };
            insert(words, at, &[word]);
        }
        6 => drop(words.drain(range(random, words.len()))),
        7 => {
            let copied = words[range(random, words.len())].to_vec();
            insert(words, at, &copied);
        }
        8 => words.truncate(at),
        9 => {
            let all: Vec<Version> = Version::all().collect();
            let version = random.pick(&all).map_or(0, Version::token);
            if let Some(word) = words.first_mut() {
                *word = version;
            }
        }
        10 => {
            // A comment, of any length that its token can say.
            let longest = if random.chance(80) { 8 } else { 0x8000 };
            insert(words, at, &[0xFFFE | random.below(longest) << 16]);
        }
        _ => {
            let other = one_of(random, &seeds.streams);
            let piece = other[range(random, other.len())].to_vec();
            insert(words, at, &piece);
        }
    }
    words.truncate(LONGEST);
}

const NUMBERS: [&str; 20] = [
    "0",
    "1",
    "2",
    "8",
    "15",
    "16",
    "31",
    "32",
    "95",
    "96",
    "127",
    "128",
    "255",
    "2047",
    "2048",
    "65536",
    "4294967295",
    "4294967296",
    "99999999999999999999",
    "1e39",
];

const WORDS: [&str; 36] = [
    "a0.x",
    "oPos",
    "oFog",
    "oPts",
    "x",
    "xyzw",
    "rgb",
    "wzyx",
    "_x2",
    "_sat",
    "_d8",
    "_bx2",
    "mov_x2_sat",
    "dcl_",
    "dcl_color16",
    "1rp",
    "rl",
    "c[a0.x + 3]",
    "c[1 + 2]",
    "c[a0.x - 1]",
    "c[",
    "-",
    "1-",
    "+",
    "asm",
    "technique",
    "pass",
    "0x7FC00000",
    "1.5f",
    "-.5",
    "D3DVSD_REG",
    "0xFFFFFFFF",
    "FFFF0101",
    "DWORD",
    "defined",
    "phase",
];

const PIECES: [&str; 30] = [
    "/*",
    "*/",
    "//",
    ";",
    "\"",
    "'",
    "\\",
    "\\\n",
    "\r",
    "\r\n",
    "\n",
    "\0",
    "\u{FEFF}",
    "\u{2013}",
    "\t",
    "(",
    ")",
    "{",
    "}",
    "[",
    "]",
    ",",
    "#",
    "##",
    "+",
    ";@comment \"",
    ";@ 00000000\n",
    "asm {",
    "};",
    "\x1A",
];

const DIRECTIVES: [&str; 16] = [
    "#include \"own.h\"\n",
    "#include <self.h>\n",
    "#include \"none.h\"\n",
    "#include \"",
    "#ifdef A\n",
    "#ifndef A\n",
    "#else\n",
    "#elif 1/0\n",
    "#endif\n",
    "#undef r0\n",
    "#line 4294967295\n",
    "#error x\n",
    "#pragma x\n",
    "#define\n",
    "#define r0 r0 r0\n",
    "#if 1 ? 2 : 3 << 99 || defined\n",
];

#[rustfmt::skip]
const TOKENS: [u32; 24] = [
    0xFFFF, 0xFFFD, 0xFFFE, 0x0001_FFFE, 0x7FFF_FFFE, 0, 1, 4, 0x1F, 0x40,
    0x42, 0x51, 0x4000_0001, 0x800F_0000, 0x8000_0000, 0x80E4_0000, 0xA0E4_2000, 0xB0E4_0000, 0xC00F_0001, 0xFFFF_FFFF,
    0x2000_0000, 0x4002_0000, 0x8200_000A, 0xA100_0000,
];

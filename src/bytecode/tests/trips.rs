//! Round trips: of generated shaders, and of streams of random tokens.

use super::*;
use crate::generate::{Options, Random, Textures, shader};
use crate::isa::{ShaderKind, Version};
use crate::listing;
use proptest::prelude::*;

/// The stream is read without a word, its listing is a fixed point, and gives the stream again, in the way of
/// `asm --unchecked`.
#[track_caller]
fn comes_back(words: &[u32]) {
    let text = listed(words);
    let mut sources = SourceMap::new();
    let file = sources.add("listing", text.as_str()).unwrap().span();
    let unchecked = listing::Options {
        unchecked: true,
        ..Default::default()
    };
    let read = listing::read(&mut sources, file, &unchecked);
    assert_eq!(read.diagnostics, [], "{text}");
    let program = read.program.unwrap();
    assert_eq!(syntax::print(&program), text);
    assert_eq!(encode(&program).unwrap(), words, "{text}");
}

#[test]
fn generated_shaders() {
    let textures = Textures::new().unwrap();
    for version in Version::all() {
        for (seed, comparable) in (0..40).flat_map(|seed| [(seed, true), (seed, false)]) {
            let options = Options {
                comparable,
                ..Options::new(version)
            };
            let made = shader(&mut Random::new(seed), &options, &textures);
            comes_back(&encode(&made.program).unwrap());
        }
    }
}

/// The streams with the longest listings: as many instructions as there may be, with as much text for each as possible,
/// and comments of which every byte takes two characters.
#[test]
fn the_longest_streams() {
    let relative = 0xA11B_27FF; // -c[a0.x + 2047].wzyx
    let mut words = vec![0xFFFE_0101];
    words.extend([4, 0xE007_0007, relative, relative, relative].repeat(MOST_ITEMS));
    words.push(0xFFFF);
    comes_back(&words);
    // `def c2047` with numbers of many digits, then 4 comments of line ends up to the longest stream.
    let mut words = vec![0xFFFE_0101];
    let numbers = [0x8080_0001; 4];
    words.extend(
        [&[0x51, 0xA00F_07FF][..], &numbers]
            .concat()
            .repeat(MOST_ITEMS - 5),
    );
    for _ in 0..5 {
        words.push(0x7FFF_FFFE);
        words.extend([0x0A0A_0A0A; 0x7FFF]);
    }
    words.push(0xFFFF);
    assert!(words.len() > MOST_TOKENS * 99 / 100);
    comes_back(&words);
}

/// Operand counts of every opcode number: destination and sources, from the list of the specification. The numbers that
/// versions share are those of 1.0 to 1.3, then of 1.4.
#[rustfmt::skip]
const COUNTS: [(u32, u32, u32); 53] = [
    (0, 0, 0), (1, 1, 1), (2, 1, 2), (3, 1, 2), (4, 1, 3), (5, 1, 2), (6, 1, 1), (7, 1, 1),
    (8, 1, 2), (9, 1, 2), (0xA, 1, 2), (0xB, 1, 2), (0xC, 1, 2), (0xD, 1, 2), (0xE, 1, 1), (0xF, 1, 1),
    (0x10, 1, 1), (0x11, 1, 2), (0x12, 1, 3), (0x13, 1, 1), (0x14, 1, 2), (0x15, 1, 2), (0x16, 1, 2), (0x17, 1, 2),
    (0x18, 1, 2), (0x40, 1, 0), (0x41, 1, 0), (0x42, 1, 0), (0x43, 1, 1), (0x44, 1, 1), (0x45, 1, 1), (0x46, 1, 1),
    (0x47, 1, 1), (0x48, 1, 1), (0x49, 1, 1), (0x4A, 1, 1), (0x4C, 1, 2), (0x4D, 1, 1), (0x4E, 1, 1), (0x4F, 1, 1),
    (0x50, 1, 3), (0x52, 1, 1), (0x53, 1, 1), (0x54, 1, 1), (0x55, 1, 1), (0x56, 1, 1), (0x57, 1, 0), (0x58, 1, 3),
    (0x59, 1, 2), (0xFFFD, 0, 0), (0x40, 1, 1), (0x42, 1, 1), (0x1F, 0, 0),
];

/// How many registers each type has, from 0 on: the table of registers.md, section 1. Any constant of a vertex shader that a
/// token has room for can be named; the a0 that vs.1.0 lacks is the validator's.
fn counts(version: Version) -> &'static [u32] {
    match version {
        Version::Vs10 | Version::Vs11 => &[12, 16, 2048, 1, 3, 2, 8],
        Version::Ps14 => &[6, 2, 8, 6],
        _ => &[2, 2, 8, 4],
    }
}

/// A register that a version has.
fn register(bits: u32, version: Version) -> u32 {
    let counts = counts(version);
    let file = (bits >> 28) % counts.len() as u32;
    let number = (bits & 0x7FF) % counts[file as usize];
    0x8000_0000 | file << 28 | number
}

/// A valid destination made of random bits.
fn destination(bits: u32, version: Version) -> u32 {
    let mask = (bits >> 16 & 0xF).max(1);
    let shifts = [0, 1, 2, 3, 0xD, 0xE, 0xF];
    let result = match version.kind() {
        ShaderKind::Vertex => 0,
        ShaderKind::Pixel => bits & 1 << 20 | shifts[(bits >> 24) as usize % 7] << 24,
    };
    register(bits, version) | mask << 16 | result
}

/// A valid source made of random bits.
fn source(bits: u32, version: Version) -> u32 {
    let register = register(bits, version);
    let kind = version.kind();
    let modifiers = match kind {
        ShaderKind::Vertex => 2,
        ShaderKind::Pixel => 11,
    };
    let is_constant = register >> 28 == 0xA && kind == ShaderKind::Vertex;
    let relative = if is_constant { bits & 1 << 13 } else { 0 };
    register | bits & 0x00FF_0000 | relative | ((bits >> 24) % modifiers) << 24
}

/// What follows the version: which, co-issue, and bits for operands, numbers and comments.
type Part = (u32, bool, Vec<u32>);

/// A valid stream.
fn stream(version: Version, parts: &[Part]) -> Vec<u32> {
    let kind = version.kind();
    let mut words = vec![version.token()];
    for (what, co_issue, bits) in parts {
        let bit = |at: usize| bits.get(at).copied().unwrap_or(0xABCD_1234);
        let co_issue = u32::from(*co_issue && kind == ShaderKind::Pixel) << 30;
        match what % 60 {
            53 | 54 => {
                // Of any constant, or of a register that the version has.
                let constant = 0xA000_0000 | bit(0) & 0x7FF;
                let register = match bit(0) & 0x800 {
                    0 => constant,
                    _ => register(bit(0), version),
                };
                words.extend([0x51 | co_issue, register | 0xF_0000]);
                words.extend((1..5).map(bit));
            }
            55 => {
                let usage = 0x8000_0000 | (bit(0) % 14) | bit(0) & 0xF_0000;
                let mask = (bit(1) >> 16 & 0xF).max(1) << 16;
                words.extend([0x1F, usage, register(bit(1), version) | mask]);
            }
            56..=58 => {
                words.push(0xFFFE | (bits.len() as u32) << 16);
                words.extend(bits);
            }
            59 => {
                // Text, with its zeros.
                let text = b"px \"a\\b\" \n\t~";
                let bytes: Vec<u8> = bits
                    .iter()
                    .map(|b| text[*b as usize % text.len()])
                    .collect();
                let (whole, _) = bytes.as_chunks::<4>();
                words.push(0xFFFE | (whole.len() as u32 + 1) << 16);
                words.extend(whole.iter().map(|b| u32::from_le_bytes(*b)));
                words.push(bit(0) & 0x7F);
            }
            at => {
                let (number, destinations, sources) = COUNTS[at as usize];
                let other = version == Version::Ps14;
                let shared = matches!(number, 0x40 | 0x42);
                let fits = !shared || kind == ShaderKind::Pixel && (sources == 1) == other;
                let subtracts = number == 3 && kind == ShaderKind::Vertex;
                if number == 0x1F || !fits || subtracts {
                    continue;
                }
                words.push(number | co_issue);
                words.extend((0..destinations).map(|_| destination(bit(0), version)));
                words.extend((0..sources).map(|i| source(bit(1 + i as usize), version)));
            }
        }
    }
    words.push(0xFFFF);
    words
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    #[test]
    fn random_streams(
        version in proptest::sample::select(Version::all().collect::<Vec<_>>()),
        parts in proptest::collection::vec(
            (any::<u32>(), any::<bool>(), proptest::collection::vec(any::<u32>(), 0..40)),
            0..60,
        ),
    ) {
        comes_back(&stream(version, &parts));
    }

    #[test]
    fn random_declarations(
        parts in proptest::collection::vec(
            (0_u32..9, any::<u32>(), proptest::collection::vec(any::<u32>(), 60)),
            0..40,
        ),
    ) {
        let mut words = Vec::new();
        for (what, bits, rest) in parts {
            match what {
                0 => words.push(0),
                1 => words.push(0x2000_0000 | bits & 0xF),
                2 => words.push(0x3000_0000),
                3 => words.push(0x4000_0000 | bits & 0x7_001F),
                4 => words.push(0x5000_0000 | bits & 0xF_0000),
                5 => words.push(0x6002_0000 | bits & 0x00F0_001F),
                6 => words.push(0x7001_0000 | bits & 0x1F),
                7 => {
                    words.push(0x8000_0000 | bits & 0x1E00_007F);
                    words.extend(&rest[..(bits >> 25 & 0xF) as usize * 4]);
                }
                _ => {
                    words.push(0xA000_0000 | bits & 0x1FFF_FFFF);
                    words.extend(&rest[..(bits >> 24 & 0x1F) as usize]);
                }
            }
        }
        words.push(0xFFFF_FFFF);
        let (declaration, found) = Declaration::decode(&words);
        prop_assert_eq!(found, []);
        prop_assert_eq!(&declaration.encode().unwrap(), &words);
        let text = declaration.print();
        let input = read(&mut SourceMap::new(), "text", text.as_bytes()).unwrap().unwrap();
        prop_assert_eq!(&input.streams[0].words, &words, "{}", text);
        let again = Declaration::decode(&input.streams[0].words).0.print();
        prop_assert_eq!(again, text);
    }
}

//! What the fuzz targets have in common with the tests: what inputs are made of, and what they must survive.

#[path = "../../tests/fuzz/judge.rs"]
pub mod judge;
#[path = "../../tests/fuzz/mutate.rs"]
pub mod mutate;
#[path = "../../tests/fuzz/seeds.rs"]
pub mod seeds;

use seeds::Seeds;
use std::sync::OnceLock;
use texcrd::generate::Random;

fn seeds() -> &'static Seeds {
    static SEEDS: OnceLock<Seeds> = OnceLock::new();
    SEEDS.get_or_init(Seeds::default)
}

/// How many of a hundred inputs libFuzzer changes itself, with what it has learned of the branches.
const LIBFUZZER: u32 = 50;

/// Changes `data`, of which the first `size` bytes count: as libFuzzer does, or with knowledge of the language. The new size.
pub fn mutated_text(data: &mut [u8], size: usize, most: usize, seed: u32) -> usize {
    let mut random = Random::new(seed.into());
    if random.chance(LIBFUZZER) {
        return libfuzzer_sys::fuzzer_mutate(data, size, most);
    }
    let mut text = data.get(..size).unwrap_or_default().to_vec();
    // libFuzzer begins with next to nothing.
    match text.len() < 2 {
        true => text = mutate::text(&mut random, seeds()),
        false => mutate::change_text(&mut random, &mut text, seeds()),
    }
    replaced(data, &text, most)
}

/// As [`mutated_text`], of tokens.
pub fn mutated_stream(data: &mut [u8], size: usize, most: usize, seed: u32) -> usize {
    let mut random = Random::new(seed.into());
    if random.chance(LIBFUZZER) {
        return libfuzzer_sys::fuzzer_mutate(data, size, most);
    }
    let mut stream = words(data.get(..size).unwrap_or_default());
    match stream.is_empty() {
        true => stream = mutate::stream(&mut random, seeds()),
        false => mutate::change_stream(&mut random, &mut stream, seeds()),
    }
    replaced(data, &texcrd::bytecode::to_bytes(&stream), most)
}

/// Puts bytes into `data`, as many as fit.
fn replaced(data: &mut [u8], bytes: &[u8], most: usize) -> usize {
    let size = bytes.len().min(most).min(data.len());
    data[..size].copy_from_slice(&bytes[..size]);
    size
}

/// Bytes as tokens; what is no whole token is left out.
pub fn words(bytes: &[u8]) -> Vec<u32> {
    let (whole, _) = bytes.as_chunks::<4>();
    whole.iter().map(|word| u32::from_le_bytes(*word)).collect()
}

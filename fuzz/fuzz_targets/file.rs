//! A file of whatever: a listing, an effect, a source of C, tokens.
#![no_main]

use libfuzzer_sys::{fuzz_mutator, fuzz_target};
use texcrd_fuzz::{judge, mutated_text};

fuzz_target!(|bytes: &[u8]| {
    judge::file(bytes);
});

fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
    mutated_text(data, size, max_size, seed)
});

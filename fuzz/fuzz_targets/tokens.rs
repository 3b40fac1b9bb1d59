//! Words as a shader and as a vertex declaration.
#![no_main]

use libfuzzer_sys::{fuzz_mutator, fuzz_target};
use texcrd_fuzz::{judge, mutated_stream, words};

fuzz_target!(|bytes: &[u8]| {
    judge::words(&words(bytes));
});

fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
    mutated_stream(data, size, max_size, seed)
});

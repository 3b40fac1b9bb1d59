//! A listing in a block of an effect, in a string of C, and as what stands around them.
#![no_main]

use libfuzzer_sys::{fuzz_mutator, fuzz_target};
use texcrd_fuzz::{judge, mutated_text};

fuzz_target!(|bytes: &[u8]| {
    let (before, behind) = bytes.split_at(bytes.len() / 2);
    let listing = b"PixelShader = asm { ps.1.1 tex t0 mov r0, t0 };";
    judge::file(
        &[
            b"technique T { pass P { PixelShader = asm {",
            bytes,
            b"}; } }",
        ]
        .concat(),
    );
    judge::file(&[b"char s[] = \"ps.1.1\\n\" \"", bytes, b"\";"].concat());
    judge::file(&[before, listing, behind].concat());
});

fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
    mutated_text(data, size, max_size, seed)
});

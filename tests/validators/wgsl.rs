//! WGSL through Tint, the compiler of Chromium.

use super::tools::{Input, Tool, skipped};
use super::translations;

/// Tint as a program of its own, or inside Dawn's package for Node.
fn tint() -> Option<Tool> {
    let alone = Tool::find("TEXCRD_TINT", "tint", &["--format", "wgsl"], 1);
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/validators/dawn.mjs");
    alone.or_else(|| Tool::find("TEXCRD_NODE", "node", &[script], 100).filter(Tool::works))
}

#[test]
fn a_second_compiler_takes_the_wgsl() {
    let Some(tint) = tint() else {
        return skipped(
            "no second WGSL compiler checks the translations",
            "A program `tint` on the path, or `npm install webgpu` in tests/validators, would do.",
        );
    };
    let inputs: Vec<Input> = (translations::all().iter())
        .map(|named| Input {
            name: named.name.clone(),
            extension: "wgsl",
            content: named.translation.source.clone().into_bytes(),
        })
        .collect();
    tint.accept_all("tint", &inputs);
}

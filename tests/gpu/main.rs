//! The CPU path against the GPU path.
//!
//! A Vulkan adapter is needed, software or real. `TEXCRD_GPU=off` skips these tests, and each says so.
#![allow(clippy::expect_used, reason = "a test that cannot go on has failed")]

mod arithmetic;
mod around;
mod cases;
mod exact;
mod frames;
mod gallery;
mod matching;
mod models;
mod pictures;
mod policies;
mod registers;
mod sampling;
mod states;
#[path = "../conformance/suite.rs"]
mod suite;
mod textures;
mod trouble;

use texcrd::gpu::Device;

/// The adapter that the tests use; none if they are switched off.
///
/// Mesa's software adapter must run under `GALLIVM_PERF=no_aos_sampling`: without it bilinear weights have 8 bits, which
/// is worth 1.5 steps of 1/255 in a single sample.
fn device() -> Option<Device> {
    if std::env::var("TEXCRD_GPU").is_ok_and(|value| value == "off") {
        eprintln!("SKIPPED: TEXCRD_GPU=off");
        return None;
    }
    let device = match Device::open(None) {
        Ok(device) => device,
        Err(error) => panic!(
            "{error}\nOn Debian or Ubuntu: apt-get install mesa-vulkan-drivers libvulkan1. \
             To go without these tests: TEXCRD_GPU=off."
        ),
    };
    let adapter = device.adapter();
    if adapter.name.contains("llvmpipe") {
        let set = std::env::var("GALLIVM_PERF").is_ok_and(|v| v.contains("no_aos_sampling"));
        assert!(
            set,
            "{adapter} filters textures with 8 bits unless GALLIVM_PERF=no_aos_sampling is set, as .cargo/config.toml does"
        );
    }
    Some(device)
}

//! Translations through compilers and validators that are not ours and not `naga`: WGSL through Tint, SPIR-V through
//! `spirv-val`, GLSL and HLSL through `glslangValidator`, HLSL through `dxc`, MSL through Apple's compiler.
//!
//! Each is used where it is installed; a test without its tool says so on standard error and passes. How to get them is
//! in `README.md` beside this file. `TEXCRD_GENERATED=N` changes how many shaders of each version are generated.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may panic")]

mod accepted;
mod languages;
mod tools;
mod translations;
mod wgsl;

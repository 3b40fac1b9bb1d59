//! Whatever the validator lets pass translates, be it as odd as it may.

use super::translations::Named;
use texcrd::diagnostic::SourceMap;
use texcrd::generate::Random;
use texcrd::isa::{Opcode, ShaderKind, Version};
use texcrd::kernel::Kernel;
use texcrd::languages::validate;
use texcrd::policy::Dialect;
use texcrd::program::Program;
use texcrd::texture::TextureKind;
use texcrd::wgsl::{Options, Stage, StageOptions, translate};
use texcrd::{kernel, listing};

const PREFIXES: &[&str] = &["", "", "", "", "", "-", "1-"];
const SUFFIXES: &[&str] = &["", "", "", "", "", "_bx2", "_bias", "_x2", "_dz", "_dw"];
const SELECTORS: &[&str] = &[
    "", "", "", "", ".a", ".b", ".r", ".xyz", ".xyw", ".wzyx", ".xy",
];
const MASKS: &[&str] = &[
    "", "", "", "", ".rgb", ".a", ".rg", ".xyz", ".x", ".yw", ".xyw",
];
const RESULTS: &[&str] = &["", "", "", "", "", "_sat", "_x2", "_x8", "_d2", "_d8_sat"];
const VERTEX: &[&str] = &[
    "r0",
    "r1",
    "r11",
    "r0",
    "v0",
    "v3",
    "c0",
    "c5",
    "c[a0.x]",
    "c[a0.x + 3]",
    "a0.x",
    "oPos",
    "oD0",
    "oT0",
    "oFog",
    "oPts",
];
const PIXEL: &[&str] = &[
    "r0", "r0", "r1", "t0", "t0", "t1", "t2", "t3", "v0", "v1", "c1", "c7",
];
const PIXEL_14: &[&str] = &[
    "r0", "r0", "r1", "r2", "r5", "t0", "t1", "t5", "v0", "c1", "c7",
];

fn one(random: &mut Random, from: &[&'static str]) -> &'static str {
    random.pick(from).unwrap_or_default()
}

/// An instruction of the version with operands of about the right kind.
fn line(random: &mut Random, version: Version) -> String {
    let opcodes: Vec<Opcode> = Opcode::all()
        .filter(|opcode| opcode.form(version).is_some())
        .filter(|opcode| !matches!(opcode, Opcode::Def | Opcode::Dcl))
        .collect();
    let opcode = random.pick(&opcodes).unwrap();
    let form = opcode.form(version).unwrap();
    let (registers, results) = match version {
        Version::Vs10 | Version::Vs11 => (VERTEX, &[""][..]),
        Version::Ps14 => (PIXEL_14, RESULTS),
        _ => (PIXEL, RESULTS),
    };
    let pair = if random.chance(10) { "+" } else { "" };
    let mut text = format!("{pair}{}{}", opcode.mnemonic(), one(random, results));
    let mut separator = " ";
    if form.destination.is_some() {
        text += &format!(" {}{}", one(random, registers), one(random, MASKS));
        separator = ", ";
    }
    for _ in form.sources {
        let (prefix, suffix) = match version.kind() {
            ShaderKind::Vertex => (one(random, &["", "-"]), ""),
            ShaderKind::Pixel => (one(random, PREFIXES), one(random, SUFFIXES)),
        };
        let (register, selector) = (one(random, registers), one(random, SELECTORS));
        text += &format!("{separator}{prefix}{register}{suffix}{selector}");
        separator = ", ";
    }
    text
}

/// Any stages, the same in all of a shader, or each its own.
fn options(random: &mut Random) -> Options {
    let kinds = [
        None,
        Some(TextureKind::Texture2D),
        Some(TextureKind::Cube),
        Some(TextureKind::Volume),
    ];
    Options {
        stages: std::array::from_fn(|_| StageOptions {
            seamless: random.chance(50),
            ..StageOptions::with_texture(random.pick(&kinds).flatten())
        }),
        ..Options::default()
    }
}

/// Listings grown line by line: each line stays that the validator lets pass in the lenient dialect, which takes most.
/// What it lets pass can be lowered, which is checked on the way.
pub(crate) fn grown(count: u64) -> Vec<Named> {
    let versions: Vec<Version> = Version::all().collect();
    (0..count)
        .map(|seed| {
            let mut random = Random::new(seed);
            let version = random.pick(&versions).unwrap();
            let mut text = format!("{}\ndef c1, 0.5, 1, -1, 0\n", version.name());
            for _ in 0..30 {
                let longer = format!("{text}{}\n", line(&mut random, version));
                if lowered(&longer).is_some() {
                    text = longer;
                }
            }
            translated(&text, &mut random).unwrap()
        })
        .collect()
}

/// The listing with its program and kernel, if the validator takes it.
fn lowered(text: &str) -> Option<(SourceMap, Program, Kernel)> {
    let mut source = SourceMap::new();
    let checked = listing::check(source.add("grown", text).unwrap(), Dialect::Lenient);
    let program = checked.accepted()?.clone();
    let kernel = kernel::lower(&program, &kernel::Options::default());
    let kernel = kernel.unwrap_or_else(|error| panic!("{}\n{text}", error.message));
    Some((source, program, kernel))
}

fn translated(text: &str, random: &mut Random) -> Option<Named> {
    let (source, program, kernel) = lowered(text)?;
    let stage = Stage {
        program: &program,
        kernel: &kernel,
        source: &source,
    };
    let (vertex, pixel) = match program.version.kind() {
        ShaderKind::Vertex => (Some(stage), None),
        ShaderKind::Pixel => (None, Some(stage)),
    };
    Some(Named {
        name: text.to_string(),
        translation: translate(vertex, pixel, &options(random)).unwrap(),
    })
}

#[test]
fn what_the_validator_takes_translates() {
    let grown = grown(1000);
    for Named { name, translation } in &grown {
        validate(translation).unwrap_or_else(|error| panic!("{error}\n{name}"));
    }
    let lines: usize = grown.iter().map(|named| named.name.lines().count()).sum();
    assert!(lines > 8000, "only {lines} lines were taken");
}

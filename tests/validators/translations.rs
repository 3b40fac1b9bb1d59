//! What is given to the validators: the scenes' pairs, the shaders of all conformance cases, generated shaders with
//! any options, and listings that are just about accepted.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;
use texcrd::case::Case;
use texcrd::diagnostic::SourceMap;
use texcrd::generate::{self, Generated, Random, Textures};
use texcrd::isa::{ShaderKind, Version};
use texcrd::kernel::{self, Kernel};
use texcrd::listing;
use texcrd::policy::Dialect;
use texcrd::program::Program;
use texcrd::raster::{Compare, FogDistance, FogMode};
use texcrd::scene::{DirectoryResolver, LoadOptions};
use texcrd::texture::{AddressMode, Filter, MipFilter, Texture, TextureKind, Weights};
use texcrd::wgsl::{Fog, Options, Points, Stage, StageOptions, Translation, translate};

/// A translation and where it came from.
pub(crate) struct Named {
    pub(crate) name: String,
    pub(crate) translation: Translation,
}

/// All translations. They are made once for all tests of a run.
pub(crate) fn all() -> &'static [Named] {
    static ALL: LazyLock<Vec<Named>> = LazyLock::new(|| {
        let mut all = scenes();
        all.extend(cases());
        all.extend(generated());
        all.extend(super::accepted::grown(2 * count()));
        all
    });
    &ALL
}

fn add(
    all: &mut Vec<Named>,
    name: String,
    vertex: Option<Stage<'_>>,
    pixel: Option<Stage<'_>>,
    options: &Options,
) {
    let translation = translate(vertex, pixel, options).unwrap_or_else(|e| panic!("{name}: {e}"));
    all.push(Named { name, translation });
}

/// A listing and its source map.
struct Listing {
    program: Program,
    kernel: Kernel,
    source: SourceMap,
}

impl Listing {
    fn new(name: &str, text: &str) -> Self {
        let mut source = SourceMap::new();
        let checked = listing::check(source.add(name, text).unwrap(), Dialect::D3d8);
        let program = checked.accepted().expect(name).clone();
        let kernel = kernel::lower(&program, &kernel::Options::default()).unwrap();
        Self {
            program,
            kernel,
            source,
        }
    }

    fn stage(&self) -> Stage<'_> {
        Stage {
            program: &self.program,
            kernel: &self.kernel,
            source: &self.source,
        }
    }
}

fn scenes() -> Vec<Named> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("asm/stained_glass");
    let mut all = Vec::new();
    for (name, cubes) in [("stained_glass", &[2, 4][..]), ("room", &[])] {
        let read = |extension: &str| {
            let path = root.join(name).with_extension(extension);
            Listing::new(name, &fs::read_to_string(path).unwrap())
        };
        let (vertex, pixel) = (read("vsh"), read("psh"));
        for seamless in [false, true] {
            let mut options = Options::default();
            for &stage in cubes {
                options.stages[stage].texture = Some(TextureKind::Cube);
                options.stages[stage].seamless = seamless;
            }
            let name = format!("{name}, seamless {seamless}");
            let (vertex, pixel) = (vertex.stage(), pixel.stage());
            add(&mut all, name, Some(vertex), Some(pixel), &options);
        }
    }
    all
}

fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files(&path, found);
        } else if path.extension().is_some_and(|e| e == "toml" || e == "json") {
            found.push(path);
        }
    }
}

fn cases() -> Vec<Named> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/conformance");
    let mut paths = Vec::new();
    files(&root, &mut paths);
    paths.sort();
    let mut all = Vec::new();
    for path in paths {
        let name = path.strip_prefix(&root).unwrap().display().to_string();
        let bytes = fs::read(&path).unwrap();
        let resolver = DirectoryResolver::new(path.parent().unwrap());
        let case = Case::load(&name, &bytes, &resolver, &LoadOptions::default()).unwrap();
        let [vertex, pixel] = [&case.vertex, &case.pixel].map(|shader| {
            shader.as_ref().map(|shader| Stage {
                program: &shader.program,
                kernel: &shader.kernel,
                source: case.sources(),
            })
        });
        let options = Options {
            stages: case.stages.each_ref().map(|stage| StageOptions {
                texture: stage.texture.as_ref().map(Texture::kind),
                seamless: stage.sampler.seamless,
                address: stage.sampler.address,
                mag: stage.sampler.mag,
                min: stage.sampler.min,
                mip: stage.sampler.mip,
                max_mip_level: stage.sampler.max_mip_level,
                max_anisotropy: stage.sampler.max_anisotropy,
                lod_bias: stage.sampler.lod_bias != 0.0,
                ..StageOptions::default()
            }),
            fog: case.state.fog.enable.then_some(Fog {
                table: case.state.fog.table,
                distance: case.state.fog.distance,
            }),
            alpha_test: (case.state.alpha_test.enable).then_some(case.state.alpha_test.func),
            ..Options::default()
        };
        add(&mut all, name, vertex, pixel, &options);
    }
    all
}

/// How many shaders of each version are generated.
fn count() -> u64 {
    let wanted = std::env::var("TEXCRD_GENERATED").ok();
    wanted.map_or(40, |count| {
        count.parse().expect("TEXCRD_GENERATED is a number")
    })
}

/// Every other shader has infinities and NaN among its constants.
fn make(version: Version, seed: u64, textures: &Textures) -> (Generated, Listing) {
    let options = generate::Options {
        comparable: seed.is_multiple_of(2),
        ..generate::Options::new(version)
    };
    let made = generate::shader(&mut Random::new(seed), &options, textures);
    let mut source = SourceMap::new();
    source.add("generated", made.listing.as_str()).unwrap();
    let listing = Listing {
        kernel: made.lower(&made.program).unwrap(),
        program: made.program.clone(),
        source,
    };
    (made, listing)
}

/// Any options; the textures mostly of the kinds that the shader was generated for.
fn options(random: &mut Random, made: &Generated) -> Options {
    const KINDS: [Option<TextureKind>; 4] = [
        None,
        Some(TextureKind::Texture2D),
        Some(TextureKind::Cube),
        Some(TextureKind::Volume),
    ];
    const MODES: [AddressMode; 5] = [
        AddressMode::Wrap,
        AddressMode::Mirror,
        AddressMode::Clamp,
        AddressMode::Border,
        AddressMode::MirrorOnce,
    ];
    let tables = [FogMode::None, FogMode::Exp, FogMode::Exp2, FogMode::Linear];
    let stages = std::array::from_fn(|i| StageOptions {
        texture: match random.chance(20) {
            true => random.pick(&KINDS).flatten(),
            false => Some(made.stages[i].kind),
        },
        seamless: random.chance(30),
        address: std::array::from_fn(|_| match random.chance(40) {
            true => random.pick(&MODES).unwrap(),
            false => AddressMode::Wrap,
        }),
        mag: random.pick(Filter::ALL).unwrap(),
        min: random.pick(Filter::ALL).unwrap(),
        mip: random.pick(MipFilter::ALL).unwrap(),
        max_mip_level: random.pick(&[0, 1]).unwrap(),
        max_anisotropy: random.pick(&[1, 4]).unwrap(),
        byte_texels: random.chance(50),
        lod_bias: random.chance(20),
        wide_texels: random.chance(20),
        weights: match random.chance(20) {
            true => Weights::EightBits,
            false => Weights::Full,
        },
    });
    Options {
        stages,
        fog: random.chance(40).then(|| Fog {
            table: random.pick(&tables).unwrap(),
            distance: random.pick(&[FogDistance::Z, FogDistance::W]).unwrap(),
        }),
        alpha_test: (random.chance(40))
            .then(|| Compare::ALL[random.below(Compare::ALL.len() as u32) as usize]),
        overridable_definitions: random.chance(15),
        half_pixel: random.chance(80),
        flat_shading: random.chance(20),
        points: random
            .pick(&[Points::None, Points::None, Points::Quads, Points::Sprites])
            .unwrap(),
        clip_planes: match random.chance(30) {
            true => random.below(7) as u8,
            false => 0,
        },
        exact_dots: random.chance(30),
        ..Options::default()
    }
}

fn generated() -> Vec<Named> {
    let textures = Textures::new().unwrap();
    let mut all = Vec::new();
    let versions = |kind| Version::all().filter(move |version| version.kind() == kind);
    for seed in 0..count() {
        let mut random = Random::new(seed);
        let shaders = |kind| -> Vec<_> {
            versions(kind)
                .map(|v| (v, make(v, seed, &textures)))
                .collect()
        };
        let (vertex, pixel) = (shaders(ShaderKind::Vertex), shaders(ShaderKind::Pixel));
        for (version, (made, listing)) in &vertex {
            let options = options(&mut random, made);
            let name = format!("{version} seed {seed}");
            add(&mut all, name, Some(listing.stage()), None, &options);
        }
        for (i, (version, (made, listing))) in pixel.iter().enumerate() {
            let options = options(&mut random, made);
            let name = format!("{version} seed {seed}");
            // Half of them linked with a vertex shader.
            let (_, (_, other)) = &vertex[i % vertex.len()];
            let linked = random.chance(50).then(|| other.stage());
            add(&mut all, name, linked, Some(listing.stage()), &options);
        }
    }
    all
}

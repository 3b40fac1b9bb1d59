//! What `translate` bakes into a translation: texture stages and render states.

use super::{Failure, Outcome};
use clap::ValueEnum;
use std::str::FromStr;
use texcrd::isa::{Opcode, RegisterFile, SourceModifier, Version};
use texcrd::kernel::{self, Projection};
use texcrd::policy::Model;
use texcrd::program::Program;
use texcrd::raster::{Compare, FogDistance, FogMode};
use texcrd::texture::{AddressMode, Filter, MipFilter, Sampler, TextureKind, Weights};
use texcrd::wgsl::{self, Fog, Options, Stage};

/// Options of the command line.
#[derive(clap::Args)]
#[command(next_help_heading = "What is baked in")]
pub(super) struct Baked {
    /// The kind of texture that is bound to a stage: 2d, cube, volume or none. Without it 2d, or cube where texm3x3tex
    /// and its kin sample.
    #[arg(long = "texture", value_name = "STAGE=KIND", value_parser = texture)]
    pub(super) textures: Vec<(usize, Option<TextureKind>)>,
    /// Divide the coordinates of a stage by their fourth component, as D3DTTFF_PROJECTED does (up to ps.1.3).
    #[arg(long, value_name = "STAGE", value_parser = stage)]
    projected: Vec<usize>,
    /// Let filters on the cube of a stage reach across its edges, which they did not in Direct3D 8.
    #[arg(long, value_name = "STAGE", value_parser = stage)]
    seamless: Vec<usize>,
    /// The address mode of a stage: wrap, mirror, clamp, border or mirror_once. The last two become shader code, as do
    /// filters with the weights of a hardware model; the others are up to the sampler.
    #[arg(long = "address", value_name = "STAGE=MODE", value_parser = address)]
    addresses: Vec<(usize, AddressMode)>,
    /// The filter of a stage, where it becomes shader code: point, linear (as without it) or anisotropic.
    #[arg(long = "filter", value_name = "STAGE=FILTER", value_parser = filter)]
    filters: Vec<(usize, Filter)>,
    /// The filter between levels of a stage, where it becomes shader code: none (as without it), point or linear.
    #[arg(long = "mip", value_name = "STAGE=FILTER", value_parser = mip)]
    mips: Vec<(usize, MipFilter)>,
    /// The most probes of an anisotropic filter, 1 to 16, which becomes shader code from 2 on.
    #[arg(long = "max-anisotropy", value_name = "STAGE=N", value_parser = anisotropy)]
    anisotropies: Vec<(usize, u32)>,
    /// Take the level-of-detail bias of a stage from the uniform block.
    #[arg(long, value_name = "STAGE", value_parser = stage)]
    lod_bias: Vec<usize>,
    /// Bake fog in: none takes it from the vertices, exp, exp2 and linear from the distance.
    #[arg(long, value_name = "MODE")]
    fog: Option<FogMode>,
    /// The distance of table fog: z or w.
    #[arg(long, value_name = "Z", default_value = "w", requires = "fog")]
    fog_distance: FogDistance,
    /// Bake an alpha test in: less, greaterequal, …
    #[arg(long, value_name = "FUNC")]
    alpha_test: Option<Compare>,
    /// Colours come from the first vertex of a triangle, as with D3DSHADE_FLAT.
    #[arg(long)]
    flat_shading: bool,
    /// The vertex shader draws points, which become quads; with sprites the coordinates run across them.
    #[arg(long, value_name = "HOW")]
    points: Option<Points>,
    /// How many user clip planes are on; their equations are in the uniform block.
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u8).range(..=6))]
    clip_planes: u8,
}

/// How points are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Points {
    Quads,
    Sprites,
}

/// The value parser of a stage.
fn stage(text: &str) -> Result<usize, String> {
    let stage = text.parse().ok().filter(|stage| *stage < 8);
    stage.ok_or_else(|| format!("`{text}` is no stage: there are stages 0 to 7"))
}

/// A stage and something behind `=`.
fn of_stage<T>(
    text: &str,
    example: &str,
    value: impl FnOnce(&str) -> Result<T, String>,
) -> Result<(usize, T), String> {
    let wrong = || format!("`{text}`: write {example}; there are stages 0 to 7");
    let (number, rest) = text.split_once('=').ok_or_else(wrong)?;
    let number = stage(number).map_err(|_| wrong())?;
    Ok((number, value(rest)?))
}

/// The stages that something was said of.
fn stages_of<T>(said: &[(usize, T)]) -> Vec<usize> {
    said.iter().map(|(stage, _)| *stage).collect()
}

/// What was said of a stage last.
fn last_of<T: Copy>(said: &[(usize, T)], stage: usize) -> Option<T> {
    let mut of_stage = said.iter().filter(|(of, _)| *of == stage);
    of_stage.next_back().map(|(_, value)| *value)
}

/// The value parser of `--texture`.
fn texture(text: &str) -> Result<(usize, Option<TextureKind>), String> {
    of_stage(text, "3=cube", |kind| match kind {
        "none" => Ok(None),
        kind => TextureKind::from_str(kind)
            .map(Some)
            .map_err(|error| format!("{error}, none")),
    })
}

/// The value parser of `--address`.
fn address(text: &str) -> Result<(usize, AddressMode), String> {
    of_stage(text, "3=border", |mode| {
        AddressMode::from_str(mode).map_err(|error| error.to_string())
    })
}

/// The value parser of `--filter`.
fn filter(text: &str) -> Result<(usize, Filter), String> {
    of_stage(text, "3=linear", |filter| {
        Filter::from_str(filter).map_err(|error| error.to_string())
    })
}

/// The value parser of `--mip`.
fn mip(text: &str) -> Result<(usize, MipFilter), String> {
    of_stage(text, "3=linear", |filter| {
        MipFilter::from_str(filter).map_err(|error| error.to_string())
    })
}

/// The value parser of `--max-anisotropy`.
fn anisotropy(text: &str) -> Result<(usize, u32), String> {
    of_stage(text, "3=16", |number| {
        let range = Sampler::ANISOTROPY;
        let most = number.parse().ok().filter(|most| range.contains(most));
        most.ok_or_else(|| format!("`{number}`: {} to {}", range.start(), range.end()))
    })
}

impl Baked {
    /// These options with what is baked into kernels.
    pub(super) fn lowering(&self, mut options: kernel::Options) -> kernel::Options {
        for stage in &self.projected {
            if let Some(place) = options.projection.get_mut(*stage) {
                *place = Projection::Fourth;
            }
        }
        options
    }

    /// Refuses options that contradict each other or have no shader to work on, and says what was guessed or has no
    /// effect.
    pub(super) fn fits(&self, vertex: Option<&Stage<'_>>, pixel: Option<&Stage<'_>>) -> Outcome {
        let mut given = 0u8;
        for (stage, _) in &self.textures {
            if given >> stage & 1 == 1 {
                let message = format!("--texture says twice what is bound to stage {stage}");
                return Err(Failure::Io(message));
            }
            given |= 1 << stage;
        }
        for (is_given, name, there, kind) in [
            (self.alpha_test.is_some(), "--alpha-test", pixel, "pixel"),
            (given != 0, "--texture", pixel, "pixel"),
            (!self.projected.is_empty(), "--projected", pixel, "pixel"),
            (!self.seamless.is_empty(), "--seamless", pixel, "pixel"),
            (!self.addresses.is_empty(), "--address", pixel, "pixel"),
            (!self.filters.is_empty(), "--filter", pixel, "pixel"),
            (!self.mips.is_empty(), "--mip", pixel, "pixel"),
            (
                !self.anisotropies.is_empty(),
                "--max-anisotropy",
                pixel,
                "pixel",
            ),
            (!self.lod_bias.is_empty(), "--lod-bias", pixel, "pixel"),
            (self.points.is_some(), "--points", vertex, "vertex"),
            (self.clip_planes > 0, "--clip-planes", vertex, "vertex"),
        ] {
            if is_given && there.is_none() {
                return Err(Failure::Io(format!("{name} needs a {kind} shader")));
            }
        }
        let Some(pixel) = pixel else {
            return Ok(());
        };
        if pixel.program.version == Version::Ps14 && !self.projected.is_empty() {
            let message = "--projected: ps.1.4 says itself what is divided, by _dw and _dz";
            return Err(Failure::Io(message.into()));
        }
        let read = pixel.kernel.stages();
        let of = |stages: &[usize]| stages.iter().fold(0u8, |set, stage| set | 1 << stage);
        for (name, stages) in [
            ("--texture", given),
            ("--projected", of(&self.projected)),
            ("--seamless", of(&self.seamless)),
            ("--address", of(&stages_of(&self.addresses))),
            ("--filter", of(&stages_of(&self.filters))),
            ("--mip", of(&stages_of(&self.mips))),
            ("--max-anisotropy", of(&stages_of(&self.anisotropies))),
            ("--lod-bias", of(&self.lod_bias)),
        ] {
            for stage in (0..8).filter(|stage| (stages & !read) >> stage & 1 == 1) {
                anstream::eprintln!("note: stage {stage} is not read: {name} has no effect on it");
            }
        }
        self.note_guesses(pixel, read & !given);
        Ok(())
    }

    /// What `texld` reads from a register may be a direction as well as a place; projections are places.
    fn note_guesses(&self, pixel: &Stage<'_>, guessed: u8) {
        let open = (pixel.program.instructions())
            .filter(|instruction| instruction.opcode == Opcode::TexLd)
            .filter(|instruction| {
                (instruction.sources.iter()).any(|source| {
                    source.register.file == RegisterFile::Temp
                        && source.modifier == SourceModifier::None
                })
            })
            .filter_map(|instruction| instruction.destination);
        let open = open.fold(0u8, |open, to| open | 1 << (to.register.index & 7));
        for stage in (0..8).filter(|stage| (open & guessed) >> stage & 1 == 1) {
            anstream::eprintln!(
                "note: stage {stage}: taken for a 2D texture; if a cube map is bound: --texture {stage}=cube"
            );
        }
    }

    /// What belongs to the translation.
    pub(super) fn options(&self, pixel: Option<&Program>, model: Model) -> Options {
        let mut options = Options {
            fog: self.fog.map(|table| Fog {
                table,
                distance: self.fog_distance,
            }),
            alpha_test: self.alpha_test,
            flat_shading: self.flat_shading,
            points: match self.points {
                None => wgsl::Points::None,
                Some(Points::Quads) => wgsl::Points::Quads,
                Some(Points::Sprites) => wgsl::Points::Sprites,
            },
            clip_planes: self.clip_planes,
            ..Options::default()
        };
        // What these make is a direction, and nearly always it is a cube that they look it up in.
        let directions = [
            Opcode::TexM3x3Tex,
            Opcode::TexM3x3Spec,
            Opcode::TexM3x3VSpec,
        ];
        let cubes = (pixel.into_iter().flat_map(Program::instructions))
            .filter(|instruction| directions.contains(&instruction.opcode))
            .filter_map(|instruction| instruction.destination)
            .map(|destination| (destination.register.index as usize, Some(TextureKind::Cube)));
        for (stage, kind) in cubes.chain(self.textures.iter().copied()) {
            if let Some(place) = options.stages.get_mut(stage) {
                place.texture = kind;
            }
        }
        for (number, stage) in options.stages.iter_mut().enumerate() {
            stage.seamless = self.seamless.contains(&number);
            stage.lod_bias = self.lod_bias.contains(&number);
            if model.has_coarse_filters() {
                stage.weights = Weights::EightBits;
            }
            if let Some(mode) = last_of(&self.addresses, number) {
                stage.address = [mode; 3];
            }
            if let Some(filter) = last_of(&self.filters, number) {
                (stage.mag, stage.min) = (filter, filter);
            }
            stage.mip = last_of(&self.mips, number).unwrap_or(stage.mip);
            let most = last_of(&self.anisotropies, number);
            stage.max_anisotropy = most.unwrap_or(stage.max_anisotropy);
        }
        options
    }
}

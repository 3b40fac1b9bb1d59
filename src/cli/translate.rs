//! `translate`: listings to WGSL and other shading languages.

use super::{Failure, Outcome, diagnostics, dialect, files, print, print_json, reflect};
use std::path::{Path, PathBuf};
use std::str::FromStr;
use texcrd::diagnostic::{SourceMap, any_error};
use texcrd::isa::{Opcode, RegisterFile, ShaderKind, SourceModifier};
use texcrd::kernel::{self, Kernel};
use texcrd::languages::{self, Language};
use texcrd::listing;
use texcrd::policy::Dialect;
use texcrd::program::Program;
use texcrd::raster::{Compare, FogDistance, FogMode};
use texcrd::texture::TextureKind;
use texcrd::wgsl::{Fog, Options, Stage, translate};

/// Translates one listing, or a vertex and a pixel shader linked into one module.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  texcrd translate shader.psh
  texcrd translate asm/stained_glass/stained_glass.vsh asm/stained_glass/stained_glass.psh --texture 2=cube --texture 4=cube
  texcrd translate shader.psh --texture 3=cube --reflect
  texcrd translate shader.vsh shader.psh --to glsl -o shader       writes shader.vert and shader.frag")]
pub(super) struct Arguments {
    /// The listings: one, or two of which one is a vertex and one a pixel shader; `-` is standard input.
    #[arg(required = true, num_args = 1..=2, value_name = "FILE")]
    files: Vec<String>,
    /// The language: wgsl, spirv, glsl, hlsl or msl.
    #[arg(long, value_name = "LANGUAGE", default_value = "wgsl")]
    to: Target,
    /// Where the result goes; without it standard output.
    #[arg(short, long, value_name = "OUT")]
    output: Option<PathBuf>,
    /// Print what binds where as JSON instead, or beside the file that `-o` names.
    #[arg(long)]
    reflect: bool,
    /// The kind of texture that is bound to a stage: 2d, cube, volume or none. Without it 2d, or cube where texm3x3tex
    /// and its kin sample.
    #[arg(long = "texture", value_name = "STAGE=KIND", value_parser = texture)]
    textures: Vec<(usize, Option<TextureKind>)>,
    /// Bake fog in: none takes it from the vertices, exp, exp2 and linear from the distance.
    #[arg(long, value_name = "MODE")]
    fog: Option<FogMode>,
    /// The distance of table fog: z or w.
    #[arg(long, value_name = "Z", default_value = "w", requires = "fog")]
    fog_distance: FogDistance,
    /// Bake an alpha test in: less, greaterequal, …
    #[arg(long, value_name = "FUNC")]
    alpha_test: Option<Compare>,
    /// Whose rules the listings are judged by: d3d8, d3d9 or lenient.
    #[arg(long, value_parser = dialect, default_value = "d3d8")]
    dialect: Dialect,
}

/// A language on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Target {
    Wgsl,
    Other(Language),
}

impl FromStr for Target {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text.eq_ignore_ascii_case("wgsl") {
            true => Ok(Self::Wgsl),
            false => text.parse().map(Self::Other),
        }
    }
}

/// The value parser of `--texture`.
fn texture(text: &str) -> Result<(usize, Option<TextureKind>), String> {
    let wrong = || format!("`{text}`: write 3=cube; there are stages 0 to 7");
    let (stage, kind) = text.split_once('=').ok_or_else(wrong)?;
    let stage = stage
        .parse()
        .ok()
        .filter(|stage| *stage < 8)
        .ok_or_else(wrong)?;
    let kind = match kind {
        "none" => None,
        kind => Some(kind.parse().map_err(|error| format!("{error}, none"))?),
    };
    Ok((stage, kind))
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    let mut sources = SourceMap::new();
    let mut shaders = Vec::new();
    for path in &arguments.files {
        shaders.push(read(path, arguments.dialect, &mut sources)?);
    }
    let stage_of = |kind: ShaderKind| {
        let found = shaders.iter().find(|(p, _)| p.version.kind() == kind)?;
        Some(Stage {
            program: &found.0,
            kernel: &found.1,
            source: &sources,
        })
    };
    let (vertex, pixel) = (stage_of(ShaderKind::Vertex), stage_of(ShaderKind::Pixel));
    if shaders.len() == 2 && (vertex.is_none() || pixel.is_none()) {
        let message = "two listings are linked if one is a vertex and one a pixel shader";
        return Err(Failure::Io(message.into()));
    }
    fits(arguments, pixel.as_ref())?;
    let options = options(arguments, pixel.as_ref().map(|stage| stage.program));
    let translation =
        translate(vertex, pixel, &options).map_err(|error| Failure::Input(error.to_string()))?;
    if arguments.reflect {
        print_json(&reflect::reflection(&translation.reflection))?;
        if arguments.output.is_none() {
            return Ok(());
        }
    }
    let Target::Other(language) = arguments.to else {
        let path = arguments.output.as_deref();
        return write(
            arguments,
            &[(path.map(Path::to_owned), translation.source.as_bytes())],
        );
    };
    let written = languages::write(&translation, language)
        .map_err(|error| Failure::Input(error.to_string()))?;
    let several = written.len() > 1;
    let mut files = Vec::new();
    for shader in &written {
        let path = match (&arguments.output, shader.stage) {
            (Some(path), Some(stage)) if several => Some(path.with_extension(match stage {
                ShaderKind::Vertex => "vert",
                ShaderKind::Pixel => "frag",
            })),
            (None, _) if several => {
                let message = format!(
                    "{language} has one file a stage: -o NAME writes NAME.vert and NAME.frag"
                );
                return Err(Failure::Io(message));
            }
            (path, _) => path.clone(),
        };
        files.push((path, shader.code.bytes()));
    }
    write(arguments, &files)
}

/// Writes all files, or none if one of them cannot be.
fn write(arguments: &Arguments, written: &[(Option<PathBuf>, &[u8])]) -> Outcome {
    for path in written.iter().filter_map(|(path, _)| path.as_deref()) {
        files::is_no_input(path, &arguments.files)?;
        files::can_be_written(path)?;
    }
    for (path, bytes) in written {
        match (path, std::str::from_utf8(bytes)) {
            (None, Ok(text)) => print(text)?,
            (path, _) => files::write(path.as_deref().unwrap_or(Path::new("-")), bytes)?,
        }
    }
    Ok(())
}

/// Reads and lowers a listing.
fn read(
    path: &str,
    dialect: Dialect,
    sources: &mut SourceMap,
) -> Result<(Program, Kernel), Failure> {
    let bytes = files::read(path)?;
    let file = sources
        .add(files::name(path), bytes)
        .map_err(|e| Failure::Input(e.to_string()))?;
    let checked = listing::check(file, dialect);
    if any_error(&checked.diagnostics) {
        anstream::eprint!("{}", diagnostics::render(sources, &checked.diagnostics));
    }
    let Some(program) = checked.accepted() else {
        let summary = diagnostics::summary(&checked.diagnostics).unwrap_or_default();
        return Err(Failure::Input(format!("{}: {summary}", files::name(path))));
    };
    let kernel = kernel::lower(program, &kernel::Options::default())
        .map_err(|e| Failure::Input(format!("{}: {e}", files::name(path))))?;
    Ok((program.clone(), kernel))
}

/// Refuses options that contradict each other or have no shader to work on, and says what was guessed or has no effect.
fn fits(arguments: &Arguments, pixel: Option<&Stage<'_>>) -> Outcome {
    let mut given = 0u8;
    for (stage, _) in &arguments.textures {
        if given >> stage & 1 == 1 {
            let message = format!("--texture says twice what is bound to stage {stage}");
            return Err(Failure::Io(message));
        }
        given |= 1 << stage;
    }
    let Some(pixel) = pixel else {
        let without = match (arguments.alpha_test, given) {
            (Some(_), _) => "--alpha-test",
            (None, 1..) => "--texture",
            (None, 0) => return Ok(()),
        };
        return Err(Failure::Io(format!("{without} needs a pixel shader")));
    };
    let read = pixel.kernel.stages();
    for stage in (0..8).filter(|stage| (given & !read) >> stage & 1 == 1) {
        anstream::eprintln!("note: stage {stage} is not read: --texture has no effect on it");
    }
    // What texld reads from a register may be a direction as well as a place; projections are places.
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
    for stage in (0..8).filter(|stage| (open & read & !given) >> stage & 1 == 1) {
        anstream::eprintln!(
            "note: stage {stage}: taken for a 2D texture; if a cube map is bound: --texture {stage}=cube"
        );
    }
    Ok(())
}

fn options(arguments: &Arguments, pixel: Option<&Program>) -> Options {
    let mut options = Options {
        fog: arguments.fog.map(|table| Fog {
            table,
            distance: arguments.fog_distance,
        }),
        alpha_test: arguments.alpha_test,
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
    for (stage, kind) in cubes.chain(arguments.textures.iter().copied()) {
        if let Some(place) = options.stages.get_mut(stage) {
            place.texture = kind;
        }
    }
    options
}

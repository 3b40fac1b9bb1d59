//! `translate`: listings to WGSL and other shading languages.

use super::baked::Baked;
use super::computing::Computing;
use super::shaders::{Reading, not_one};
use super::{Failure, Outcome, diagnostics, files, print, print_json, reflect};
use serde_json::json;
use std::path::{Path, PathBuf};
use std::str::FromStr;
use texcrd::diagnostic::{SourceMap, any_error};
use texcrd::isa::ShaderKind;
use texcrd::kernel::{self, Kernel};
use texcrd::languages::{self, Code, Language, Written};
use texcrd::program::Program;
use texcrd::wgsl::{Stage, translate};

/// Translates one listing, or a vertex and a pixel shader linked into one module.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  texcrd translate shader.psh
  texcrd translate asm/stained_glass/stained_glass.vsh asm/stained_glass/stained_glass.psh --texture 2=cube --texture 4=cube
  texcrd translate shader.psh --texture 3=cube --reflect
  texcrd translate shader.vsh shader.psh --to glsl -o shader       writes shader.vert and shader.frag")]
pub(super) struct Arguments {
    /// The listings: one, or two of which one is a vertex and one a pixel shader; or a file with shaders in it. Of such a file
    /// the two shaders of a pass are linked, and all others translated one after the other; --shader picks. `-` is standard
    /// input.
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
    #[command(flatten)]
    computing: Computing,
    #[command(flatten)]
    baked: Baked,
    #[command(flatten)]
    reading: Reading,
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

pub(super) fn run(arguments: &Arguments) -> Outcome {
    let mut sources = SourceMap::new();
    let mut shaders = Vec::new();
    for path in &arguments.files {
        shaders.extend(read(path, arguments, &mut sources)?);
    }
    let modules = modules(&shaders, arguments.files.len() > 1)?;
    if let [shaders] = modules.as_slice() {
        return translate_module(arguments, &sources, shaders, None);
    }
    if arguments.output.is_some() {
        return Err(Failure::Io(format!(
            "{}: this file holds several shaders: pick one for -o with --shader, of {}",
            arguments.files.join(", "),
            names(&shaders)
        )));
    }
    for shaders in modules {
        translate_module(arguments, &sources, shaders, Some(&names(shaders)))?;
    }
    Ok(())
}

/// A shader that can be translated.
struct Lowered {
    name: String,
    program: Program,
    kernel: Kernel,
}

fn names(shaders: &[Lowered]) -> String {
    let names: Vec<&str> = shaders.iter().map(|shader| shader.name.as_str()).collect();
    names.join(", ")
}

/// Which shaders go into one module: two listings that were given together, the vertex and the pixel shader of one pass
/// of an effect, the only two of a file; otherwise each goes alone.
fn modules(shaders: &[Lowered], together: bool) -> Result<Vec<&[Lowered]>, Failure> {
    let kind = |shader: &Lowered| shader.program.version.kind();
    let fit = |a: &Lowered, b: &Lowered| kind(a) != kind(b);
    match shaders {
        [a, b] if fit(a, b) => return Ok(vec![shaders]),
        _ if together => {
            let message = "two listings are linked if one is a vertex and one a pixel shader";
            return Err(Failure::Io(message.into()));
        }
        _ => {}
    }
    let pass = |shader: &Lowered| Some(shader.name.rsplit_once('/')?.0.to_string());
    let mut modules = Vec::new();
    let mut rest = shaders;
    while let [first, behind @ ..] = rest {
        let second = behind.first();
        let pair = second
            .is_some_and(|b| fit(first, b) && pass(b).is_some_and(|p| Some(p) == pass(first)));
        let (module, others) = rest.split_at(1 + usize::from(pair));
        modules.push(module);
        rest = others;
    }
    Ok(modules)
}

/// Translates one or two shaders and writes what came out; `name`: what they are called, if the file has others.
fn translate_module(
    arguments: &Arguments,
    sources: &SourceMap,
    shaders: &[Lowered],
    name: Option<&str>,
) -> Outcome {
    let stage_of = |kind: ShaderKind| {
        let found = shaders.iter().find(|s| s.program.version.kind() == kind)?;
        Some(Stage {
            program: &found.program,
            kernel: &found.kernel,
            source: sources,
        })
    };
    let (vertex, pixel) = (stage_of(ShaderKind::Vertex), stage_of(ShaderKind::Pixel));
    let baked = &arguments.baked;
    baked.fits(vertex.as_ref(), pixel.as_ref())?;
    let options = baked.options(
        pixel.as_ref().map(|stage| stage.program),
        arguments.computing.model(),
    );
    let translation =
        translate(vertex, pixel, &options).map_err(|error| Failure::Input(error.to_string()))?;
    if arguments.reflect {
        let mut reflection = reflect::reflection(&translation.reflection);
        if let Some(name) = name {
            reflection["shader"] = json!(name);
        }
        print_json(&reflection)?;
        if arguments.output.is_none() {
            return Ok(());
        }
    }
    let heading = |text: &str| match name {
        Some(name) => format!("// {name}\n{text}\n"),
        None => text.to_string(),
    };
    let Target::Other(language) = arguments.to else {
        let path = arguments.output.as_deref();
        let text = heading(&translation.source);
        return write(arguments, &[(path.map(Path::to_owned), text.as_bytes())]);
    };
    let written = languages::write(&translation, language)
        .map_err(|error| Failure::Input(error.to_string()))?;
    if let Some(name) = name {
        let [
            Written {
                code: Code::Text(text),
                ..
            },
        ] = written.as_slice()
        else {
            return Err(Failure::Io(format!(
                "{name}: {language} goes into files of its own: pick the shaders with --shader, and name the file with -o"
            )));
        };
        return print(&heading(text));
    }
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

/// Reads and lowers the shaders of a file that are meant: of two files one each.
fn read(
    path: &str,
    arguments: &Arguments,
    sources: &mut SourceMap,
) -> Result<Vec<Lowered>, Failure> {
    let opened = arguments.reading.open(sources, path)?;
    let too_many = arguments.files.len() > 1 && opened.shaders.len() > 1;
    if (opened.shaders.is_empty() || too_many) && !any_error(&opened.file.diagnostics) {
        return Err(not_one(&opened, path));
    }
    let (all, found) = arguments.reading.check_all(sources, path, &opened, false)?;
    if any_error(&found) {
        anstream::eprint!("{}", diagnostics::render(sources, &found));
        let summary = diagnostics::summary(&found).unwrap_or_default();
        return Err(Failure::Input(format!("{}: {summary}", files::name(path))));
    }
    let lowering = arguments.baked.lowering(arguments.computing.lowering());
    let mut lowered = Vec::new();
    for ((name, _), checked) in opened.shaders.iter().zip(all) {
        let Some(program) = checked.program else {
            anstream::eprint!("{}", diagnostics::render(sources, &found));
            return Err(Failure::Input(format!(
                "{}: this is no whole shader",
                files::name(path)
            )));
        };
        let kernel = kernel::lower(&program, &lowering)
            .map_err(|e| Failure::Input(format!("{}: {e}", files::name(path))))?;
        lowered.push(Lowered {
            name: name.clone(),
            program,
            kernel,
        });
    }
    Ok(lowered)
}

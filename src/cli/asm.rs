//! `asm`: listings to tokens.

use super::shaders::{Opened, Reading, not_one};
use super::{Failure, Format, Outcome, diagnostics, files, print, print_json};
use serde_json::json;
use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use texcrd::bytecode::{self, Declaration, StreamKind};
use texcrd::diagnostic::{Diagnostic, SourceMap, any_error};
use texcrd::extract::{Shader, Text};

/// Makes tokens of a listing, as Direct3D took them: little-endian words of 32 bits.
///
/// Vertex declarations are written as in C: D3DVSD_STREAM(0), D3DVSD_REG(0, D3DVSDT_FLOAT3), D3DVSD_END().
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  texcrd asm water.psh -o water.pso
  texcrd asm water.psh --hex
  texcrd asm water.fx --hex                   the tokens of every shader of an effect
  texcrd asm water.fx --shader T0/P0/PixelShader -o water.pso
  texcrd asm water.vsh -o water.vso --constants water.inc      its defs as D3DVSD_CONST, as Direct3D 8 had them
  texcrd asm water.fx --format json           one object a diagnostic and one a shader
  texcrd asm --unchecked odd.psh --hex        tokens of whatever has some, as the old assembler could")]
pub(super) struct Arguments {
    /// A listing, a vertex declaration, a file of tokens, or a file with shaders in it; `-` is standard input.
    #[arg(value_name = "FILE")]
    file: String,
    /// Where the tokens go; without it standard output.
    #[arg(short, long, value_name = "OUT")]
    output: Option<PathBuf>,
    /// Write text: one token of eight hexadecimal digits a line.
    #[arg(long)]
    hex: bool,
    /// Leave the defs of a vertex shader out of its tokens and write them to this file instead, as the D3DVSD_CONST elements
    /// of a vertex declaration. `dis --constants` takes them back.
    #[arg(long, value_name = "FILE")]
    constants: Option<PathBuf>,
    /// Ask only for what has no token, not for the rules of the shader model.
    #[arg(long)]
    unchecked: bool,
    /// How diagnostics and tokens are told. As JSON both go to standard output; -o writes its file all the same.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
    #[command(flatten)]
    reading: Reading,
}

/// The tokens of a shader or of a vertex declaration.
struct Made {
    name: String,
    /// What was assembled: a version, or `declaration`.
    what: &'static str,
    words: Vec<u32>,
    /// The constants that are not among its tokens, if they were asked for.
    constants: Option<Declaration>,
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    let json = arguments.format == Format::Json;
    let output = arguments.output.as_deref().filter(|o| *o != Path::new("-"));
    let constants = arguments.constants.as_deref();
    let binary = !json && !arguments.hex && output.is_none();
    if binary && std::io::stdout().is_terminal() {
        let message = "tokens are no text: write them to a file with -o, or print them with --hex";
        return Err(Failure::Io(message.into()));
    }
    for path in output.iter().chain(&constants) {
        files::can_be_written(path)?;
        files::is_no_input(path, [&arguments.file])?;
    }
    if constants.is_some_and(|path| path == Path::new("-") || Some(path) == output) {
        let message = "the constants go to a file of their own: --constants FILE";
        return Err(Failure::Io(message.into()));
    }
    let mut sources = SourceMap::new();
    let opened = arguments.reading.open(&mut sources, &arguments.file)?;
    report(arguments, &sources, &opened.file.diagnostics)?;
    // Several in one file of words would be one stream that ends too early.
    let several = opened.shaders.len() > 1;
    let separable = arguments.hex || (json && output.is_none());
    if opened.shaders.is_empty() || (several && (!separable || constants.is_some())) {
        return Err(not_one(&opened, &arguments.file));
    }
    let (made, complete) = assemble_all(arguments, &mut sources, &opened)?;
    if json {
        for shader in &made {
            print_json(&to_json(files::name(&arguments.file), shader))?;
        }
    }
    if !complete && (!several || output.is_some()) {
        return Err(Failure::Rejected);
    }
    let bytes = match (arguments.hex, made.first()) {
        (false, Some(shader)) => bytecode::to_bytes(&shader.words),
        _ => to_hex(&made, several).into_bytes(),
    };
    if let (Some(path), Some(shader)) = (constants, made.first()) {
        let declared = shader.constants.as_ref();
        let text = declared.map(Declaration::print_fragment);
        files::write(path, text.unwrap_or_default().as_bytes())?;
    }
    match output {
        Some(output) => files::write(output, &bytes)?,
        None if json => {}
        None if arguments.hex => print(&String::from_utf8_lossy(&bytes))?,
        None => files::write(Path::new("-"), &bytes)?,
    }
    match complete {
        true => Ok(()),
        false => Err(Failure::Rejected),
    }
}

/// The tokens in digits, each shader behind a line with its name if there are several.
fn to_hex(made: &[Made], several: bool) -> String {
    let name = |shader: &Made| match several {
        true => format!("// {}\n", shader.name),
        false => String::new(),
    };
    let one = |shader: &Made| name(shader) + &bytecode::to_hex(&shader.words);
    made.iter().map(one).collect()
}

fn to_json(file: &str, made: &Made) -> serde_json::Value {
    let mut object = json!({
        "file": file,
        "shader": made.name,
        "version": made.what,
        "tokens": made.words,
    });
    if let Some(constants) = &made.constants {
        // What take_constants made fits.
        object["constants"] = json!(constants.encode_fragment().unwrap_or_default());
    }
    object
}

/// The tokens of the shaders that have some, and whether all have.
fn assemble_all(
    arguments: &Arguments,
    sources: &mut SourceMap,
    opened: &Opened,
) -> Result<(Vec<Made>, bool), Failure> {
    let mut made = Vec::new();
    for (name, shader) in &opened.shaders {
        match assemble(arguments, sources, name, shader) {
            Ok(one) => made.push(one),
            Err(Failure::Rejected) => {}
            Err(failure) => return Err(failure),
        }
    }
    let complete = made.len() == opened.shaders.len();
    Ok((made, complete))
}

/// The tokens of one shader.
fn assemble(
    arguments: &Arguments,
    sources: &mut SourceMap,
    name: &str,
    shader: &Shader,
) -> Result<Made, Failure> {
    let path = &arguments.file;
    let checked = arguments
        .reading
        .check(sources, path, shader, arguments.unchecked)?;
    report(arguments, sources, &checked.diagnostics)?;
    let refused = |found: Vec<Diagnostic>| match report(arguments, sources, &found) {
        Ok(()) => Failure::Rejected,
        Err(failure) => failure,
    };
    let mut made = Made {
        name: name.to_string(),
        what: "declaration",
        words: Vec::new(),
        constants: None,
    };
    match (checked.program, &shader.text) {
        (Some(mut program), _) => {
            made.what = program.version.name();
            if arguments.constants.is_some() {
                let taken = bytecode::take_constants(&mut program).map_err(refused)?;
                made.constants = Some(taken);
            }
            made.words = bytecode::encode(&program).map_err(refused)?;
        }
        (None, Text::Tokens(stream)) if stream.kind == StreamKind::Declaration => {
            let (declaration, _) = Declaration::decode(&stream.words);
            made.words = declaration.encode().map_err(refused)?;
        }
        (None, _) => return Err(Failure::Rejected),
    }
    Ok(made)
}

/// Says diagnostics; an error among them ends the command.
fn report(arguments: &Arguments, sources: &SourceMap, found: &[Diagnostic]) -> Outcome {
    diagnostics::tell(arguments.format, sources, found)?;
    match any_error(found) {
        true => Err(Failure::Rejected),
        false => Ok(()),
    }
}

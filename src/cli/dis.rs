//! `dis`: tokens to listings.

use super::shaders::{pick, too_large};
use super::{Failure, Format, Outcome, diagnostics, files, print, print_json};
use serde_json::json;
use texcrd::bytecode::{self, Declaration, Stream, StreamKind};
use texcrd::diagnostic::{SourceMap, any_error};
use texcrd::extract::{self, File, Text};
use texcrd::isa::Version;
use texcrd::preprocess;

/// Makes a listing of tokens: one that assembles back to the same tokens.
///
/// Binary files of the old tools, hexadecimal text and arrays in C sources are told apart by themselves; so are shaders and
/// vertex declarations, which become lists of D3DVSD_ macros.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  texcrd dis water.pso
  texcrd dis shaders.h                        every array of tokens in a C source
  texcrd dis shaders.h --shader dwWaterPS
  texcrd dis water.vso --constants water.inc  a vertex shader with what D3DVSD_CONST loads for it
  echo ffff0101 00000042 b00f0000 00000001 800f0000 b0e40000 0000ffff | texcrd dis -")]
pub(super) struct Arguments {
    /// A file of tokens; `-` is standard input.
    #[arg(value_name = "FILE")]
    file: String,
    /// Of a file with several, only this one: the name of its array, or its number from 1.
    #[arg(long, value_name = "NAME|N")]
    shader: Vec<String>,
    /// Take the tokens for a vertex declaration, whatever they begin with.
    #[arg(long)]
    declaration: bool,
    /// Say what is wrong with a vertex declaration that is used without a vertex shader, too (rule D5).
    #[arg(long)]
    fixed_function: bool,
    /// The vertex declaration that a vertex shader is used with, or the piece of it that `asm --constants` wrote: what its
    /// D3DVSD_CONST elements load becomes defs of the shader.
    #[arg(long, value_name = "FILE")]
    constants: Option<String>,
    /// How diagnostics and listings are told.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    let mut sources = SourceMap::new();
    let constants = match &arguments.constants {
        Some(path) => Some(constants(arguments.format, &mut sources, path)?),
        None => None,
    };
    let file = open(arguments.format, &mut sources, &arguments.file)?;
    let mut rejected = false;
    let mut text = String::new();
    let opened = pick(file, &arguments.shader, &arguments.file)?;
    let several = opened.shaders.len() > 1;
    for (name, shader) in opened.shaders {
        let Text::Tokens(mut stream) = shader.text else {
            continue;
        };
        if arguments.declaration {
            stream.kind = StreamKind::Declaration;
        }
        let made = bytecode::disassemble(&stream, constants.as_ref(), &mut sources);
        let mut made = made.map_err(too_large)?;
        if arguments.fixed_function && stream.kind == StreamKind::Declaration {
            let (declaration, _) = Declaration::decode(&stream.words);
            let found = stream.placed(declaration.check_fixed_function());
            made.diagnostics.extend(found);
        }
        diagnostics::tell(arguments.format, &sources, &made.diagnostics)?;
        rejected |= any_error(&made.diagnostics);
        match (made.listing, arguments.format) {
            (None, _) => {}
            (Some(listing), Format::Json) => print_json(&json!({
                "file": files::name(&arguments.file),
                "shader": name,
                "version": version(&stream),
                "listing": listing,
            }))?,
            (Some(listing), Format::Text) if several => {
                let gap = if text.is_empty() { "" } else { "\n" };
                text += &format!("{gap}// {name}\n{listing}");
            }
            (Some(listing), Format::Text) => text = listing,
        }
    }
    print(&text)?;
    match rejected {
        true => Err(Failure::Rejected),
        false => Ok(()),
    }
}

/// What a stream is, in the words of `asm --format json`.
fn version(stream: &Stream) -> &'static str {
    match (stream.kind, stream.words.first()) {
        (StreamKind::Shader, Some(word)) => Version::from_token(*word).map_or("", Version::name),
        _ => "declaration",
    }
}

/// The tokens of a file.
fn open(format: Format, sources: &mut SourceMap, path: &str) -> Result<File, Failure> {
    let name = files::name(path);
    let bytes = files::read(path)?;
    let mut file =
        extract::open(sources, name, bytes, &preprocess::Options::default()).map_err(too_large)?;
    file.shaders
        .retain(|shader| matches!(shader.text, Text::Tokens(_)));
    if file.shaders.is_empty() {
        let found = [bytecode::no_tokens(file.span.at_start())];
        diagnostics::tell(format, sources, &found)?;
        return Err(Failure::Rejected);
    }
    Ok(file)
}

/// The one vertex declaration of a file, or the piece of one.
fn constants(format: Format, sources: &mut SourceMap, path: &str) -> Result<Declaration, Failure> {
    let name = files::name(path);
    let bytes = files::read(path)?;
    // A shader without constants has an empty piece.
    if bytes.trim_ascii().is_empty() {
        return Ok(Declaration::default());
    }
    let file =
        extract::open(sources, name, bytes, &preprocess::Options::default()).map_err(too_large)?;
    let mut streams = file.shaders.iter().filter_map(|shader| match &shader.text {
        Text::Tokens(stream) if stream.kind == StreamKind::Declaration => Some(stream),
        _ => None,
    });
    let (Some(stream), None) = (streams.next(), streams.next()) else {
        let message = format!("{name}: this is not one vertex declaration, or a piece of one");
        return Err(Failure::Input(message));
    };
    let (declaration, found) = stream.decode_fragment();
    diagnostics::tell(format, sources, &found)?;
    match any_error(&found) {
        true => Err(Failure::Rejected),
        false => Ok(declaration),
    }
}

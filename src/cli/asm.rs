//! `asm`: listings to tokens.

use super::{Failure, Outcome, diagnostics, dialect, files, print, streams};
use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use texcrd::bytecode::{self, Declaration, Input, StreamKind};
use texcrd::diagnostic::{Diagnostic, SourceMap, any_error};
use texcrd::policy::Dialect;
use texcrd::program::Program;
use texcrd::{listing, syntax};

/// Makes tokens of a listing, as Direct3D took them: little-endian words of 32 bits.
///
/// Vertex declarations are written as in C: D3DVSD_STREAM(0), D3DVSD_REG(0, D3DVSDT_FLOAT3), D3DVSD_END().
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  texcrd asm water.psh -o water.pso
  texcrd asm water.psh --hex
  texcrd asm --unchecked odd.psh --hex        tokens of whatever has some, as the old assembler could")]
pub(super) struct Arguments {
    /// A listing, a vertex declaration, or a file of tokens; `-` is standard input.
    #[arg(value_name = "FILE")]
    file: String,
    /// Where the tokens go; without it standard output.
    #[arg(short, long, value_name = "OUT")]
    output: Option<PathBuf>,
    /// Write text: one token of eight hexadecimal digits a line.
    #[arg(long)]
    hex: bool,
    /// Ask only for what has no token, not for the rules of the shader model.
    #[arg(long)]
    unchecked: bool,
    /// Of a file with several shaders, this one: the name of its array, or its number from 1.
    #[arg(long, value_name = "NAME|N")]
    shader: Option<String>,
    /// Whose rules: d3d8, d3d9 or lenient.
    #[arg(long, value_parser = dialect, default_value = "d3d8")]
    dialect: Dialect,
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    let output = arguments.output.as_deref().filter(|o| *o != Path::new("-"));
    let to_terminal = output.is_none() && std::io::stdout().is_terminal();
    if to_terminal && !arguments.hex {
        let message = "tokens are no text: write them to a file with -o, or print them with --hex";
        return Err(Failure::Io(message.into()));
    }
    if let Some(output) = output {
        files::can_be_written(output)?;
        files::is_no_input(output, [&arguments.file])?;
    }
    let bytes = files::read(&arguments.file)?;
    let name = files::name(&arguments.file);
    let mut sources = SourceMap::new();
    let too_large = |e: texcrd::diagnostic::TooLarge| Failure::Input(e.to_string());
    let input = bytecode::read(&mut sources, name, &bytes).map_err(too_large)?;
    let words = match input {
        Some(input) => stream(arguments, &mut sources, input)?,
        None => {
            sources.add(name, bytes).map_err(too_large)?;
            shader(arguments, &sources)?
        }
    };
    match (output, arguments.hex) {
        (Some(output), true) => files::write(output, bytecode::to_hex(&words).as_bytes()),
        (Some(output), false) => files::write(output, &bytecode::to_bytes(&words)),
        (None, true) => print(&bytecode::to_hex(&words)),
        (None, false) => files::write(Path::new("-"), &bytecode::to_bytes(&words)),
    }
}

/// The tokens of the last source, a listing.
fn shader(arguments: &Arguments, sources: &SourceMap) -> Result<Vec<u32>, Failure> {
    let Some(file) = sources.files().last() else {
        return Err(Failure::Rejected);
    };
    let (program, found) = if arguments.unchecked {
        let options = syntax::Options {
            lenient: arguments.dialect == Dialect::Lenient,
            ..Default::default()
        };
        let parsed = syntax::parse_with(file, options);
        (parsed.program, parsed.diagnostics)
    } else {
        let checked = listing::check(file, arguments.dialect);
        (checked.program, checked.diagnostics)
    };
    report(sources, &found)?;
    let encoded = program
        .as_ref()
        .map(|program: &Program| bytecode::encode(program));
    written(sources, encoded.ok_or(Failure::Rejected)?)
}

/// The tokens of the one stream that is meant.
fn stream(
    arguments: &Arguments,
    sources: &mut SourceMap,
    input: Input,
) -> Result<Vec<u32>, Failure> {
    let names = streams::names(&input.streams).join(", ");
    let picked = streams::pick(input, arguments.shader.as_deref())?;
    let [stream] = &picked[..] else {
        return Err(Failure::Io(format!(
            "this file holds several: pick one with --shader, of {names}"
        )));
    };
    let made = bytecode::disassemble(stream, sources);
    let made = made.map_err(|e| Failure::Input(e.to_string()))?;
    report(sources, &made.diagnostics)?;
    match stream.kind {
        StreamKind::Shader => shader(arguments, sources),
        StreamKind::Declaration => {
            let (declaration, _) = Declaration::decode(&stream.words);
            if !arguments.unchecked {
                report(sources, &stream.placed(declaration.check()))?;
            }
            written(sources, declaration.encode())
        }
    }
}

/// Prints diagnostics; an error among them ends the command.
fn report(sources: &SourceMap, found: &[Diagnostic]) -> Outcome {
    anstream::eprint!("{}", diagnostics::render(sources, found));
    match any_error(found) {
        true => Err(Failure::Rejected),
        false => Ok(()),
    }
}

/// The tokens, or what has none.
fn written(
    sources: &SourceMap,
    encoded: Result<Vec<u32>, Vec<Diagnostic>>,
) -> Result<Vec<u32>, Failure> {
    encoded.or_else(|found| report(sources, &found).map(|()| Vec::new()))
}

//! `asm`: listings to tokens.

use super::shaders::{Opened, Reading, not_one};
use super::{Failure, Outcome, diagnostics, files, print};
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
    /// Ask only for what has no token, not for the rules of the shader model.
    #[arg(long)]
    unchecked: bool,
    #[command(flatten)]
    reading: Reading,
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
    let mut sources = SourceMap::new();
    let opened = arguments.reading.open(&mut sources, &arguments.file)?;
    report(&sources, &opened.file.diagnostics)?;
    // Several in one file of words would be one stream that ends too early.
    let several = opened.shaders.len() > 1;
    if opened.shaders.is_empty() || (several && !arguments.hex) {
        return Err(not_one(&opened, &arguments.file));
    }
    let (made, complete) = assemble_all(arguments, &mut sources, &opened);
    let text = || -> String {
        let name = |name: &str| {
            if several {
                format!("// {name}\n")
            } else {
                String::new()
            }
        };
        let all = made.iter();
        all.map(|(shader, words)| name(shader) + &bytecode::to_hex(words))
            .collect()
    };
    let words = made.first().map_or(&[][..], |(_, words)| words);
    if !complete && !several {
        return Err(Failure::Rejected);
    }
    match (output, arguments.hex) {
        _ if !complete && output.is_some() => {}
        (Some(output), true) => files::write(output, text().as_bytes())?,
        (Some(output), false) => files::write(output, &bytecode::to_bytes(words))?,
        (None, true) => print(&text())?,
        (None, false) => files::write(Path::new("-"), &bytecode::to_bytes(words))?,
    }
    match complete {
        true => Ok(()),
        false => Err(Failure::Rejected),
    }
}

/// The tokens of the shaders that have some, by name, and whether all have.
fn assemble_all(
    arguments: &Arguments,
    sources: &mut SourceMap,
    opened: &Opened,
) -> (Vec<(String, Vec<u32>)>, bool) {
    let mut made = Vec::new();
    for (name, shader) in &opened.shaders {
        match assemble(arguments, sources, shader) {
            Ok(words) => made.push((name.clone(), words)),
            Err(Failure::Rejected) => {}
            Err(failure) => anstream::eprintln!("error: {failure}"),
        }
    }
    let complete = made.len() == opened.shaders.len();
    (made, complete)
}

/// The tokens of one shader.
fn assemble(
    arguments: &Arguments,
    sources: &mut SourceMap,
    shader: &Shader,
) -> Result<Vec<u32>, Failure> {
    let path = &arguments.file;
    let checked = arguments
        .reading
        .check(sources, path, shader, arguments.unchecked)?;
    report(sources, &checked.diagnostics)?;
    let encoded = match (&checked.program, &shader.text) {
        (Some(program), _) => bytecode::encode(program),
        (None, Text::Tokens(stream)) if stream.kind == StreamKind::Declaration => {
            let (declaration, _) = Declaration::decode(&stream.words);
            declaration.encode()
        }
        (None, _) => return Err(Failure::Rejected),
    };
    encoded.or_else(|found| report(sources, &found).map(|()| Vec::new()))
}

/// Prints diagnostics; an error among them ends the command.
fn report(sources: &SourceMap, found: &[Diagnostic]) -> Outcome {
    anstream::eprint!("{}", diagnostics::render(sources, found));
    match any_error(found) {
        true => Err(Failure::Rejected),
        false => Ok(()),
    }
}

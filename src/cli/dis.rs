//! `dis`: tokens to listings.

use super::shaders::{pick, too_large};
use super::{Failure, Outcome, diagnostics, files, print};
use texcrd::bytecode::{self, StreamKind};
use texcrd::diagnostic::SourceMap;
use texcrd::extract::{self, Text};
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
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    let bytes = files::read(&arguments.file)?;
    let name = files::name(&arguments.file);
    let mut sources = SourceMap::new();
    let file = extract::open(&mut sources, name, bytes, &preprocess::Options::default());
    let mut file = file.map_err(too_large)?;
    file.shaders
        .retain(|shader| matches!(shader.text, Text::Tokens(_)));
    if file.shaders.is_empty() {
        return Err(Failure::Input(format!(
            "{name}: this holds no tokens; `dis` takes binary files, hexadecimal text and arrays in C sources \
             (`asm` makes tokens of a listing)"
        )));
    }
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
        let made = bytecode::disassemble(&stream, None, &mut sources);
        let made = made.map_err(too_large)?;
        anstream::eprint!("{}", diagnostics::render(&sources, &made.diagnostics));
        match made.listing {
            None => rejected = true,
            Some(listing) if several => {
                let gap = if text.is_empty() { "" } else { "\n" };
                text += &format!("{gap}// {name}\n{listing}");
            }
            Some(listing) => text = listing,
        }
    }
    print(&text)?;
    match rejected {
        true => Err(Failure::Rejected),
        false => Ok(()),
    }
}

//! Streams to listings.

use super::{Declaration, Stream, StreamKind, decode, put_constants};
use crate::diagnostic::{Diagnostic, SourceMap, TooLarge, any_error};
use crate::program::Program;
use crate::syntax;

/// What became of a stream.
#[derive(Clone, Debug)]
pub struct Disassembly {
    /// The listing of a shader, or the elements of a vertex declaration as C has them; `None` if something refuses the
    /// stream.
    pub listing: Option<String>,
    /// The shader. Its spans point into the listing, which is the last of the sources.
    pub program: Option<Program>,
    /// What is wrong with the stream, with spans where its tokens stand.
    pub diagnostics: Vec<Diagnostic>,
}

/// Writes the listing of a stream and adds it to the sources, so that what is said of its program can point into it:
/// with [`crate::listing::check`], say, on the last of them.
///
/// `constants`: the declaration that a vertex shader is used with, whose `D3DVSD_CONST` elements become `def`s; see
/// [`put_constants`].
///
/// # Errors
/// [`TooLarge`] if the sources cannot take the listing.
pub fn disassemble(
    stream: &Stream,
    constants: Option<&Declaration>,
    sources: &mut SourceMap,
) -> Result<Disassembly, TooLarge> {
    let (text, reports) = match stream.kind {
        StreamKind::Shader => {
            let mut decoded = decode(&stream.words);
            if let (Some(program), Some(constants)) = (&mut decoded.program, constants) {
                put_constants(program, constants);
            }
            let text = decoded.program.as_ref().map(syntax::print);
            (text, decoded.diagnostics)
        }
        StreamKind::Declaration => {
            let (declaration, reports) = Declaration::decode(&stream.words);
            (Some(declaration.print()), reports)
        }
    };
    let diagnostics = stream.with_fault(reports);
    let listing = text.filter(|_| !any_error(&diagnostics));
    let mut program = None;
    if let Some(text) = listing
        .as_ref()
        .filter(|_| stream.kind == StreamKind::Shader)
    {
        let of = sources.file_of(stream.place(Default::default()).start);
        let name = format!("{} (listing)", of.map_or("tokens", |file| file.name()));
        program = syntax::parse(sources.add(name, text.as_str())?).program;
    }
    Ok(Disassembly {
        listing,
        program,
        diagnostics,
    })
}

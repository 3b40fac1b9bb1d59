//! The front door: text and tokens in, programs, tokens and text out, without a [`SourceMap`] of one's own.
//!
//! Each function is a short way through the rooms behind it. Who needs more of them (included files, macros from
//! outside, effects and sources of C, programs with their places) goes there: [`listing::read`], [`extract::open`],
//! [`bytecode`].
//!
//! [`extract::open`]: crate::extract::open

use crate::bytecode::{self, Stream};
use crate::diagnostic::{Diagnostic, Location, SourceMap, any_error};
use crate::listing::{self, Checked};
use crate::policy::Dialect;
use crate::program::Program;
use crate::syntax;
use std::fmt;

/// What is said of a listing or of a stream of tokens: errors and warnings, in their order.
///
/// As an error it prints all of them, one or two lines each:
///
/// ```
/// let report = texcrd::assemble("ps.1.1\nmov r0, t9").unwrap_err();
/// assert!(report.to_string().starts_with("2:9: error[O1]: "));
/// ```
#[derive(Clone, Debug)]
pub struct Report {
    sources: SourceMap,
    diagnostics: Vec<Diagnostic>,
    /// Whether it is about a text. Messages about tokens name them by number.
    of_text: bool,
}

impl Report {
    /// Whether nothing refuses the shader; there may be warnings.
    pub fn is_accepted(&self) -> bool {
        !any_error(&self.diagnostics)
    }

    /// Everything that is said, by position.
    pub fn diagnostics(&self) -> &[Diagnostic] {
        &self.diagnostics
    }

    /// Line and column of a diagnostic: in a listing those that a person wrote, of a stream of tokens the number of the
    /// token, from 1, as the line.
    pub fn place(&self, diagnostic: &Diagnostic) -> Option<Location<'_>> {
        self.sources.locate(diagnostic.span)
    }

    /// The texts that the diagnostics point into: the first is the listing, or the tokens in hexadecimal digits, one a
    /// line.
    pub fn sources(&self) -> &SourceMap {
        &self.sources
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (at, diagnostic) in self.diagnostics.iter().enumerate() {
            if at > 0 {
                f.write_str("\n")?;
            }
            if let Some(place) = self.place(diagnostic).filter(|_| self.of_text) {
                write!(f, "{}:{}: ", place.line, place.column)?;
            }
            let (severity, code) = (diagnostic.severity.name(), diagnostic.rule.id);
            write!(f, "{severity}[{code}]: {}", diagnostic.message)?;
            if let Some(help) = &diagnostic.help {
                write!(f, "\n    help: {help}")?;
            }
        }
        Ok(())
    }
}

impl std::error::Error for Report {}

/// Reads a listing: directives, grammar, and whether the version has its instructions and registers. The other rules of
/// the shader model are left to [`validate`].
///
/// ```
/// let program = texcrd::parse("ps.1.4\ntexld r0, t0\nmul r0.rgb, r0, c1 ; tinted")?;
/// let mnemonics: Vec<_> = program.instructions().map(|i| i.opcode.mnemonic()).collect();
/// assert_eq!(mnemonics, ["texld", "mul"]);
/// # Ok::<(), texcrd::Report>(())
/// ```
///
/// Spans of the program count bytes of the text, if it has no directives (`#define`). Files cannot be included:
/// [`listing::read`] is given them.
///
/// # Errors
/// [`Report`] with everything that cannot be read, and what was only warned of beside it.
pub fn parse(text: impl AsRef<[u8]>) -> Result<Program, Report> {
    let (checked, sources) = read(text.as_ref(), Dialect::default(), true)?;
    accepted(checked, sources).map(|(program, _)| program)
}

/// Judges a listing by the rules of a dialect. Everything that is wrong with it is told at once, that it cannot be
/// read included.
///
/// ```
/// use texcrd::policy::Dialect;
///
/// // Read before it is written, and an argument too much.
/// let report = texcrd::validate("ps.1.1\nadd r0, r1, c0\nmov r0, v0, v1", Dialect::D3d8);
/// assert!(!report.is_accepted());
/// let lines = report.diagnostics().iter().map(|d| report.place(d).unwrap().line);
/// assert_eq!(lines.collect::<Vec<_>>(), [2, 3]);
/// ```
///
/// [`crate::validate::validate`] judges a [`Program`], wherever it is from.
pub fn validate(text: impl AsRef<[u8]>, dialect: Dialect) -> Report {
    match read(text.as_ref(), dialect, false) {
        Ok((checked, sources)) => Report {
            sources,
            diagnostics: checked.diagnostics,
            of_text: true,
        },
        Err(report) => report,
    }
}

/// The tokens of a listing that Direct3D 8 accepts: what its assembler made of it.
///
/// ```
/// let tokens = texcrd::assemble("ps.1.1\nmov r0, v0.a")?;
/// assert_eq!(tokens, [0xFFFF0101, 0x00000001, 0x800F0000, 0x90FF0000, 0x0000FFFF]);
/// # Ok::<(), texcrd::Report>(())
/// ```
///
/// Vertex shaders keep their `def`s as tokens, as in Direct3D 9; [`bytecode::take_constants`] makes of them what the
/// assembler of Direct3D 8 gave back beside the stream.
///
/// # Errors
/// [`Report`] with everything that is wrong with the listing.
pub fn assemble(text: impl AsRef<[u8]>) -> Result<Vec<u32>, Report> {
    let (checked, sources) = read(text.as_ref(), Dialect::default(), false)?;
    let (program, sources) = accepted(checked, sources)?;
    bytecode::encode(&program).map_err(|diagnostics| Report {
        sources,
        diagnostics,
        of_text: true,
    })
}

/// The listing of tokens, which assembles to the same tokens. Of a vertex declaration, its elements as C has them.
///
/// ```
/// let listing = texcrd::disassemble(&[0xFFFF0101, 0x00000001, 0x800F0000, 0x90FF0000, 0x0000FFFF])?;
/// assert_eq!(listing, "ps.1.1\nmov r0, v0.a\n");
/// # Ok::<(), texcrd::Report>(())
/// ```
///
/// # Errors
/// [`Report`] with everything that is wrong with the stream. Warnings alone (bits that mean nothing, tokens behind the
/// end) are no error; [`bytecode::decode`] tells them.
pub fn disassemble(tokens: &[u32]) -> Result<String, Report> {
    let mut sources = SourceMap::new();
    let made = Stream::of_words(&mut sources, "tokens", tokens)
        .and_then(|stream| bytecode::disassemble(&stream, None, &mut sources));
    let (listing, diagnostics) = match made {
        Ok(made) => (made.listing, made.diagnostics),
        Err(error) => (None, vec![syntax::too_long(&error)]),
    };
    listing.ok_or(Report {
        sources,
        diagnostics,
        of_text: false,
    })
}

/// Reads a listing as the only text of its sources.
fn read(text: &[u8], dialect: Dialect, unchecked: bool) -> Result<(Checked, SourceMap), Report> {
    let mut sources = SourceMap::new();
    let span = match sources.add("listing", text) {
        Ok(file) => file.span(),
        Err(error) => {
            return Err(Report {
                sources,
                diagnostics: vec![syntax::too_long(&error)],
                of_text: false,
            });
        }
    };
    let options = listing::Options {
        dialect,
        unchecked,
        ..Default::default()
    };
    let checked = listing::read(&mut sources, span, &options);
    Ok((checked, sources))
}

/// The program, if nothing refuses it.
fn accepted(checked: Checked, sources: SourceMap) -> Result<(Program, SourceMap), Report> {
    match checked.program {
        Some(program) if !any_error(&checked.diagnostics) => Ok((program, sources)),
        _ => Err(Report {
            sources,
            diagnostics: checked.diagnostics,
            of_text: true,
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What was wrong, as it is printed.
    fn told<T: fmt::Debug>(result: Result<T, Report>) -> String {
        result.unwrap_err().to_string()
    }

    #[test]
    fn everything_is_told_with_its_place() {
        let report = assemble("ps.1.1\nmov r0, t9\n#define T t8\nmov r1, T").unwrap_err();
        let text = report.to_string();
        let places: Vec<_> = (text.lines())
            .filter(|line| !line.starts_with(' '))
            .map(|line| line.split(' ').next().unwrap())
            .collect();
        // The second stands where the macro is used.
        assert_eq!(places, ["2:9:", "4:9:"], "{text}");
        assert_eq!(report.sources().files()[0].name(), "listing");
    }

    #[test]
    fn warnings_do_not_refuse() {
        // A def behind an instruction is S2, a warning in Direct3D 8 and an error in Direct3D 9.
        let text = "ps.1.1\ntex t0\ndef c0, 1, 1, 1, 1\nmul r0, t0, c0";
        let report = validate(text, Dialect::D3d8);
        assert!(report.is_accepted());
        assert_eq!(report.diagnostics()[0].rule.id, "S2");
        assert!(!validate(text, Dialect::D3d9).is_accepted());
        // Version, tex with its operand, def with six words behind it in all, mul with three, end.
        assert_eq!(assemble(text).unwrap().len(), 1 + 2 + 6 + 4 + 1);
    }

    #[test]
    fn only_the_text_counts_for_parse() {
        // r1 is read and nothing has been written to it, which is the validator's business.
        let program = parse("ps.1.1\nmov r0, r1").unwrap();
        assert!(!validate("ps.1.1\nmov r0, r1", Dialect::D3d8).is_accepted());
        assert_eq!(program.instructions().count(), 1);
        assert!(told(parse("ps.1.1\nfoo r0")).starts_with("2:1: error[P8]"));
        assert!(told(parse("")).contains("error[S1]"));
    }

    #[test]
    fn broken_streams() {
        assert!(told(disassemble(&[])).starts_with("error[S13]: token 0"));
        let text = told(disassemble(&[0xFFFF_0101, 0x0000_0001, 0x8000_0000]));
        assert!(text.starts_with("error[K8]: token 2 (byte 8)"), "{text}");
        let long = vec![0; bytecode::MOST_TOKENS * 4];
        assert!(told(disassemble(&long)).contains("error[S13]"));
        let declaration = disassemble(&[0x2000_0001, 0xFFFF_FFFF]).unwrap();
        assert_eq!(declaration, "D3DVSD_STREAM(1),\nD3DVSD_END()\n");
    }

    #[test]
    fn a_text_that_is_too_long() {
        let text = told(parse(vec![b' '; SourceMap::MAX_BYTES + 1]));
        assert!(
            text.starts_with("error[P1]: listing: 4194305 bytes"),
            "{text}"
        );
    }
}

//! What stands before the first instruction: the version, or what is there in its place.

use super::confuse::alike;
use super::lexer::{self, Kind, Token};
use super::names::{self, Found, VersionText};
use super::parser::Parser;
use super::report::quote;
use super::rules;
use crate::diagnostic::{Diagnostic, Fix, Span};
use crate::isa::{RegisterFile, ShaderKind, Version};
use crate::preprocess::scan::without_nul;
use crate::rules::model;

/// Where the version was found.
pub(super) struct Heading {
    pub(super) version: Version,
    pub(super) span: Span,
    /// Whether the version was only guessed, so that there is no shader to give back.
    pub(super) guessed: bool,
}

/// Longest text that is read as a version, blanks included.
const LONGEST: usize = 12;

impl Parser<'_> {
    /// Finds the version and goes behind it. `assumed` is the version if the listing has none. `None` if there is
    /// nothing to read on.
    pub(super) fn heading(&mut self, assumed: Option<Version>) -> Option<Heading> {
        let mut instruction_reported = false;
        loop {
            let line = self.at;
            let first = self.peek();
            if first.kind == Kind::End || self.reports.full() {
                break;
            }
            if let Some((reading, behind)) = self.version_here() {
                self.lines_before(line, &mut instruction_reported);
                return self.version(reading, line, behind);
            }
            self.skip_line();
        }
        self.at = 0;
        let start = self.peek();
        let span = self.span(start).at_start();
        if let Some(version) = assumed {
            return Some(Heading {
                version,
                span,
                guessed: false,
            });
        }
        self.no_version(start)
    }

    /// The version at the start of this line, with the number of the token behind it.
    fn version_here(&self) -> Option<(VersionText, usize)> {
        let first = self.peek();
        if first.kind == Kind::Version {
            let reading = names::version(self.bytes(first));
            let longer = || self.longer_version(self.at + 1);
            let found = (reading == VersionText::Unknown).then(longer).flatten();
            return Some(found.unwrap_or((reading, self.at + 1)));
        }
        let starts_so = |b: &u8| alike(*b, b'v') || alike(*b, b'p');
        if first.kind != Kind::Word || !self.bytes(first).first().is_some_and(starts_so) {
            return None;
        }
        self.longer_version(self.at)
    }

    /// The version that the tokens of this line up to one from `from` on are, with the number of the token behind it.
    fn longer_version(&self, from: usize) -> Option<(VersionText, usize)> {
        let first = self.peek();
        (from..self.at + 5).find_map(|at| {
            let token = self.token(at);
            let text = self.between(first, token);
            let same_line = at == self.at || !token.first;
            let longest = token.kind != Kind::End && same_line && text.len() <= LONGEST;
            // A name that goes on, such as a label, is no version.
            let reading = names::version(if longest { text } else { b"" });
            (longest && reading != VersionText::Unknown).then_some((reading, at + 1))
        })
    }

    /// Reports the lines before the version, which is at token `version`.
    fn lines_before(&mut self, version: usize, reported: &mut bool) {
        self.at = 0;
        while self.at < version && !self.reports.full() {
            let at = self.at;
            let first = self.peek();
            let mnemonic = at + usize::from(first.kind == Kind::Plus);
            let instruction = self.mnemonic(self.token(mnemonic)).is_some()
                && (self.is_register(self.token(mnemonic + 1)) || self.token(mnemonic + 1).first);
            if !instruction {
                self.stray_text(true);
            } else {
                if !*reported {
                    let message = "this stands before the version instruction";
                    let help = "move the version instruction to the front";
                    self.error(&model::S1, self.span(first), message, help);
                }
                *reported = true;
                self.skip_line();
                // It will stand somewhere behind the version.
                self.damage(self.span_from(first), None);
            }
        }
        self.at = version;
    }

    fn version(&mut self, reading: VersionText, first: usize, behind: usize) -> Option<Heading> {
        self.at = behind;
        let span = self.span_from(self.token(first));
        let text = self.text_of(span);
        let quoted = || quote(text);
        let version = match reading {
            VersionText::Exact(version) => version,
            VersionText::Mixed(version) => {
                let message = format!("{} mixes the two spellings of the version", quoted());
                self.misread(&rules::VERSION_UNKNOWN, span, message, version.name());
                version
            }
            VersionText::Misread(version) => {
                let message = format!("{} is no version", quoted());
                self.misread(&rules::VERSION_UNKNOWN, span, message, version.name());
                version
            }
            VersionText::Unknown => {
                let message = format!("{} is no version of Direct3D 8", quoted());
                let help = if text.starts_with(b"x") || text.starts_with(b"X") {
                    "it is of the Xbox, whose instructions are not all those of Direct3D 8"
                } else if text.get(3).is_some_and(|b| (b'2'..=b'9').contains(b)) {
                    "it is of a later shader model; Direct3D 8 has vs.1.0, vs.1.1 and ps.1.0 to ps.1.4"
                } else {
                    "Direct3D 8 has vs.1.0, vs.1.1 and ps.1.0 to ps.1.4"
                };
                self.error(&rules::VERSION_UNKNOWN, span, message, help);
                return None;
            }
        };
        Some(Heading {
            version,
            span,
            guessed: false,
        })
    }

    fn no_version(&mut self, start: Token) -> Option<Heading> {
        let span = self.span(start);
        if start.kind == Kind::End {
            // The version may stand in the comment without end, of which was spoken.
            if !self.damaged.is_empty() {
                return None;
            }
            let message = match self.text.iter().all(u8::is_ascii_whitespace) {
                true => "the text is empty: the version instruction is missing",
                false => "the text holds only comments: the version instruction is missing",
            };
            let help = "begin with one of vs.1.0, vs.1.1, ps.1.0 to ps.1.4";
            self.error(&model::S1, span.at_start(), message, help);
            return None;
        }
        let end = self.line_end(1);
        let line = self.between(start, self.token(end.saturating_sub(1)));
        let message = format!(
            "the version instruction is missing: the listing begins with {}",
            quote(line)
        );
        let mut report = Diagnostic::error(&model::S1, span, message);
        let guess = self.likely_version();
        report = match guess {
            Some(version) => report
                .with_help(format!(
                    "what follows would fit {version}: write it in the first line"
                ))
                .with_fix(Fix {
                    span: span.at_start(),
                    replacement: format!("{version}\n"),
                    certain: false,
                }),
            None => {
                report.with_help("no line of it is an instruction either: this is hardly a listing")
            }
        };
        self.report(report);
        // What stands in the place of the version was reported with it.
        while self.peek().kind != Kind::End && self.mnemonic(self.peek()).is_none() {
            self.skip_line();
        }
        guess.map(|version| Heading {
            version,
            span: span.at_start(),
            guessed: true,
        })
    }

    /// The version that has most of the instructions and registers which are written; `None` if none is.
    fn likely_version(&self) -> Option<Version> {
        const LOOKED_AT: usize = 2000;
        let mut points: Vec<(u32, Version)> = Version::all().map(|v| (0, v)).collect();
        for (at, &token) in self.tokens.iter().take(LOOKED_AT).enumerate() {
            let register = match self.registers(self.token(at + 1)) {
                Found::Exact(names::Name::Register(file, index)) => Some((file, index)),
                _ => None,
            };
            let Some((opcode, register)) = self.mnemonic(token).zip(register) else {
                continue;
            };
            let is_output = matches!(
                register.0,
                RegisterFile::RastOut | RegisterFile::AttrOut | RegisterFile::TexCrdOut
            );
            for (points, version) in &mut points {
                *points += u32::from(opcode.form(*version).is_some());
                *points += u32::from(register.1 < register.0.count(*version));
                *points += 4 * u32::from(is_output && version.kind() == ShaderKind::Vertex);
            }
        }
        // Of equals the later version: it has more room.
        let best = points.into_iter().max_by_key(|(points, _)| *points)?;
        (best.0 > 0).then_some(best.1)
    }
}

/// Whether a text begins with a version instruction and more behind it; comments, blank lines and lines for the
/// preprocessor may stand before it.
pub(crate) fn begins_with_version(text: &[u8]) -> bool {
    let mut reports = super::report::Reports::default();
    // A version stands near the beginning of its text, or behind comments.
    let tokens = lexer::lex_some(text, 2, &mut reports);
    match &tokens[..] {
        [version, behind, ..] => version.kind == Kind::Version && behind.kind != Kind::End,
        _ => false,
    }
}

/// Whether bytes are text of two bytes a character: by its mark, or by what its first characters are.
pub(crate) fn is_utf16(bytes: &[u8]) -> bool {
    let text = |b: u8| b.is_ascii_graphic() || b.is_ascii_whitespace();
    match *bytes {
        [0xFF, 0xFE, ..] | [0xFE, 0xFF, ..] => true,
        [a, 0, b, 0, ..] | [0, a, 0, b, ..] => text(a) && text(b),
        _ => false,
    }
}

/// Says what a text is that is no text.
pub(crate) fn not_text(bytes: &[u8]) -> Option<(&'static str, &'static str)> {
    const KNOWN: [(&[u8], &str, &str); 7] = [
        (b"\x89PNG", "a PNG picture", ""),
        (b"\xFF\xD8\xFF", "a JPEG picture", ""),
        (b"GIF8", "a GIF picture", ""),
        (b"DDS ", "a DDS texture", ""),
        (b"PK\x03\x04", "a ZIP archive", "unpack it first"),
        (b"\x7FELF", "a program", ""),
        (b"MZ", "a program", ""),
    ];
    if is_utf16(bytes) {
        return Some(("text in UTF-16", "save it as plain text or UTF-8"));
    }
    // The token of a version: 0xFFFE01mm or 0xFFFF01mm, lowest byte first.
    if let [minor, major, 0xFE | 0xFF, 0xFF, ..] = bytes
        && *minor < 16
        && (1..4).contains(major)
    {
        return Some((
            "a compiled shader (tokens)",
            "disassemble it to get a listing",
        ));
    }
    if let Some((_, what, help)) = KNOWN
        .iter()
        .find(|(magic, ..)| bytes.starts_with(magic) && (magic != b"MZ" || bytes.contains(&0)))
    {
        return Some((what, help));
    }
    let bytes = without_nul(bytes);
    let head = bytes.get(..1024).unwrap_or(bytes);
    head.contains(&0).then_some(("binary data", ""))
}

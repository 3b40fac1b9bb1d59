//! Macros.

use super::scan::{Kind as Lexical, Language, Scanner};
use super::token::{Kind, Token, trimmed};
use super::{Open, Output, Preprocessor, rules};
use crate::diagnostic::{Diagnostic, SourceMap, Span};
use std::fmt;

/// A macro.
#[derive(Debug)]
pub(super) struct Macro {
    pub(super) name: String,
    /// The names of its parameters; `None` if it is used without parentheses.
    pub(super) parameters: Option<Vec<Vec<u8>>>,
    /// What it stands for; white space at the ends left out, `##` one sign.
    pub(super) body: Vec<Token>,
    /// Whether what it became is being read: it does not stand for itself there.
    pub(super) active: bool,
    /// Where it is defined.
    pub(super) at: Span,
}

/// A macro that is defined before a text, as `-D` gives it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Definition {
    name: String,
    value: String,
}

/// A text that defines no macro.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BadDefinition {
    /// The text.
    pub text: String,
}

impl fmt::Display for BadDefinition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "`{}` defines no macro: write NAME or NAME=VALUE",
            self.text
        )
    }
}

impl std::error::Error for BadDefinition {}

impl std::str::FromStr for Definition {
    type Err = BadDefinition;

    /// Reads `NAME`, which stands for 1, `NAME=VALUE` or `NAME(A,B)=VALUE`.
    fn from_str(text: &str) -> Result<Self, BadDefinition> {
        let (name, value) = text.split_once('=').unwrap_or((text, "1"));
        let mut scanner = Scanner::new(name.as_bytes().into(), 0, Language::Listing);
        let first = scanner.next();
        let behind = name.get(first.span.end as usize..).unwrap_or("");
        let parameters = behind.is_empty() || (behind.starts_with('(') && behind.ends_with(')'));
        if first.kind != Lexical::Name || !parameters || text.contains(['\n', '\r', '\0']) {
            return Err(BadDefinition { text: text.into() });
        }
        Ok(Self {
            name: name.into(),
            value: value.into(),
        })
    }
}

impl Preprocessor<'_, '_> {
    /// Defines what was given from outside, as if it stood before the first line.
    pub(super) fn define_all(&mut self, definitions: &[Definition], file: Span) {
        if definitions.is_empty() {
            return;
        }
        let one = |d: &Definition| format!("#define {} {}\n", d.name, d.value);
        let text: String = definitions.iter().map(one).collect();
        match self.sources.add("<definitions>", text) {
            Err(error) => self.stop(file.at_start(), error.to_string()),
            Ok(added) => {
                let scanner =
                    Scanner::new(added.shared_bytes(), added.span().start, Language::Listing);
                self.open.push(Open {
                    scanner,
                    path: None,
                    conditions: 0,
                });
                self.read();
                self.output = Output::default();
            }
        }
    }

    /// `#define` behind its word.
    pub(super) fn define(&mut self, line: &[Token], word: &Token) {
        let line = trimmed(line);
        let Some((name, behind)) = line
            .split_first()
            .filter(|(name, _)| name.kind == Kind::Name)
        else {
            let at = line.first().unwrap_or(word).span();
            return self.error(
                &rules::DIRECTIVE,
                at,
                "#define has no name",
                "write #define NAME text",
            );
        };
        let key = name.text(self.sources).into_owned();
        if key == b"defined" {
            let message = "`defined` cannot be defined";
            return self.error(&rules::DIRECTIVE, name.span(), message, "it belongs to #if");
        }
        let opens = behind.first().is_some_and(|t| t.is(self.sources, b"("));
        let (parameters, body) = match opens {
            false => (None, behind),
            true => match self.parameters(behind) {
                Some((parameters, length)) => {
                    (Some(parameters), behind.get(length..).unwrap_or(&[]))
                }
                // Later languages have more of them, which no listing uses.
                None if self.language == Language::Host => return,
                None => {
                    let message = "the parameters of this macro are no list of names";
                    let help = "write #define NAME(A, B) text";
                    return self.error(&rules::DIRECTIVE, name.span(), message, help);
                }
            },
        };
        let made = Macro {
            name: String::from_utf8_lossy(&key).into_owned(),
            parameters,
            body: body_of(trimmed(body), self.sources),
            active: false,
            at: name.span(),
        };
        if let Some(before) = self.names.get(&key).and_then(|at| self.macros.get(*at))
            && !self.same(before, &made)
        {
            let place = self.sources.locate(before.at);
            let place = place.map_or(String::new(), |at| format!(" ({}:{})", at.file, at.line));
            let message = format!(
                "`{}` is defined again, otherwise than before{place}",
                made.name
            );
            let report = Diagnostic::warning(&rules::REDEFINED, made.at, message);
            self.report(report.with_help(
                "from here on this definition holds; write #undef before it if that is meant",
            ));
        }
        self.names.insert(key, self.macros.len());
        self.macros.push(made);
    }

    /// The names between parentheses, and how many tokens they take, both parentheses included.
    fn parameters(&self, tokens: &[Token]) -> Option<(Vec<Vec<u8>>, usize)> {
        let close = tokens.iter().position(|t| t.is(self.sources, b")"))?;
        let inner = trimmed(tokens.get(1..close)?);
        let mut names: Vec<Vec<u8>> = Vec::new();
        if inner.is_empty() {
            return Some((names, close + 1));
        }
        for part in inner.split(|t| t.is(self.sources, b",")) {
            let [name] = trimmed(part) else {
                return None;
            };
            let text = name.text(self.sources).into_owned();
            if name.kind != Kind::Name || names.contains(&text) {
                return None;
            }
            names.push(text);
        }
        Some((names, close + 1))
    }

    fn same(&self, a: &Macro, b: &Macro) -> bool {
        let text = |t: &Token| match t.is_space() {
            true => b" ".to_vec(),
            false => t.text(self.sources).into_owned(),
        };
        a.parameters == b.parameters
            && a.body.len() == b.body.len()
            && a.body.iter().zip(&b.body).all(|(a, b)| text(a) == text(b))
    }

    /// `#undef` behind its word.
    pub(super) fn undefine(&mut self, line: &[Token], word: &Token) {
        match trimmed(line).first() {
            Some(name) if name.kind == Kind::Name => {
                let key = name.text(self.sources).into_owned();
                self.names.remove(&key);
            }
            other => {
                let at = other.unwrap_or(word).span();
                self.error(
                    &rules::DIRECTIVE,
                    at,
                    "#undef has no name",
                    "write #undef NAME",
                );
            }
        }
    }
}

/// The text of a macro: each run of white space is one blank, or a line end where a continued line begins with a word, so
/// that the instructions of a macro stand on lines of their own.
fn body_of(tokens: &[Token], sources: &SourceMap) -> Vec<Token> {
    let mut body: Vec<Token> = Vec::with_capacity(tokens.len());
    let mut rest = tokens.iter().peekable();
    while let Some(token) = rest.next() {
        let mut token = token.clone();
        token.first = false;
        if token.is_space() {
            let mut broken = token.kind == Kind::Break;
            while let Some(more) = rest.next_if(|t| t.is_space()) {
                broken |= more.kind == Kind::Break;
            }
            let begins = rest
                .peek()
                .is_some_and(|t| t.kind == Kind::Name || t.is(sources, b"+"));
            token.kind = if broken && begins {
                Kind::Break
            } else {
                Kind::Space
            };
        } else if token.is(sources, b"#")
            && let Some(second) =
                rest.next_if(|t| t.is(sources, b"#") && t.span().start == token.span().end)
        {
            token.part.source.end = second.span().end;
        }
        body.push(token);
    }
    body
}

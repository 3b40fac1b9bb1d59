//! Lines that begin with `#`.

use super::scan::{Language, Scanner};
use super::token::{Kind, Token, trimmed};
use super::{MOST_DEPTH, MOST_INCLUDES, Open, Preprocessor, rules};
use crate::diagnostic::{Diagnostic, SourceMap, Span};

/// An `#if` whose `#endif` has not come yet.
#[derive(Clone, Copy, Debug)]
pub(super) struct Condition {
    /// Where it stands.
    pub(super) at: Span,
    /// Whether its lines are read.
    active: bool,
    /// Whether a part of it was read.
    taken: bool,
    /// Whether what it stands in is read.
    outer: bool,
    /// Whether its `#else` has come.
    otherwise: bool,
}

impl Preprocessor<'_, '_> {
    /// Whether what comes next is read.
    pub(super) fn active(&self) -> bool {
        self.conditions.last().is_none_or(|c| c.active)
    }

    /// Reads the rest of the line behind its `#`.
    pub(super) fn directive(&mut self, hash: &Token) {
        let line = self.line();
        let line = trimmed(&line);
        let Some((word, rest)) = line.split_first() else {
            return;
        };
        let name = word.text(self.sources).into_owned();
        let at = hash.span().to(word.span());
        match &name[..] {
            b"if" | b"ifdef" | b"ifndef" => self.begin(&name, rest, at),
            b"elif" | b"else" | b"endif" => self.go_on(&name, rest, at),
            _ if !self.active() => {}
            b"define" => self.define(rest, word),
            b"undef" => self.undefine(rest, word),
            b"include" => self.include(rest, at),
            b"error" => {
                let line = trimmed(rest);
                let (first, last) = (line.first(), line.last());
                let whole = first
                    .zip(last)
                    .map(|(first, last)| first.span().to(last.span()));
                let text = whole.map_or("".into(), |span| self.sources.text(span));
                let message = match text.trim() {
                    "" => "#error: the listing is not to be assembled so".to_string(),
                    text => format!("#error: {}", text.chars().take(200).collect::<String>()),
                };
                self.error(
                    &rules::STOPPED,
                    whole.map_or(at, |whole| at.to(whole)),
                    message,
                    "",
                );
                self.stopped = true;
            }
            b"line" | b"pragma" => {}
            // `# 12 "file"`, as preprocessors leave it behind.
            _ if word.kind == Kind::Number => {}
            // Effects and C have more of them.
            _ if self.language == Language::Host => {}
            _ => {
                let text = self.sources.text(word.span()).into_owned();
                let message = format!("`#{text}` is no directive");
                self.error(
                    &rules::DIRECTIVE,
                    at,
                    message,
                    "a line of a comment begins with `;`",
                );
            }
        }
    }

    /// The words and signs up to the end of the line, which is left.
    fn line(&mut self) -> Vec<Token> {
        let mut line = Vec::new();
        let Some(open) = self.open.last_mut() else {
            return line;
        };
        open.scanner.directive = true;
        let mut unclosed = None;
        loop {
            let lexeme = open.scanner.next();
            let token = Token::of(lexeme);
            if lexeme.open {
                unclosed = Some(lexeme.span);
            }
            if matches!(token.kind, Kind::NewLine | Kind::End) {
                open.scanner.put_back(lexeme);
                break;
            }
            line.push(token);
        }
        open.scanner.directive = false;
        if let Some(span) = unclosed.filter(|_| self.active()) {
            let at = Span::new(span.start, span.start + 2);
            let message = "this comment has no end: everything behind it is lost";
            self.error(
                &rules::DIRECTIVE,
                at,
                message,
                "write */ where the comment ends",
            );
        }
        line
    }

    fn begin(&mut self, name: &[u8], rest: &[Token], at: Span) {
        let outer = self.active();
        let holds = outer && self.holds(name, rest, at);
        self.conditions.push(Condition {
            at,
            active: holds,
            taken: holds,
            outer,
            otherwise: false,
        });
    }

    /// What a condition says; one that cannot be read does not hold.
    fn holds(&mut self, name: &[u8], rest: &[Token], at: Span) -> bool {
        if matches!(name, b"if" | b"elif") {
            return self.condition(rest, at);
        }
        match trimmed(rest).first() {
            Some(token) if token.kind == Kind::Name => {
                let known = self.names.contains_key(&token.text(self.sources)[..]);
                known == (name == b"ifdef")
            }
            other => {
                let at = other.map_or(at, Token::span);
                let message = format!("#{} has no name", String::from_utf8_lossy(name));
                self.error(
                    &rules::CONDITIONAL,
                    at,
                    message,
                    "write the name of a macro behind it",
                );
                self.lose();
                false
            }
        }
    }

    /// `#elif`, `#else`, `#endif`.
    fn go_on(&mut self, name: &[u8], rest: &[Token], at: Span) {
        let own = self
            .open
            .last()
            .is_some_and(|open| self.conditions.len() > open.conditions);
        let text = String::from_utf8_lossy(name).into_owned();
        let condition = if own { self.conditions.pop() } else { None };
        let Some(mut condition) = condition else {
            let message = format!("no #if stands before this #{text}");
            return self.error(
                &rules::CONDITIONAL,
                at,
                message,
                "remove it, or write the #if that it belongs to",
            );
        };
        if name == b"endif" {
            return;
        }
        if condition.otherwise && condition.outer {
            let message = format!("this #{text} stands behind the #else of its #if");
            self.error(
                &rules::CONDITIONAL,
                at,
                message,
                "#else is the last part before #endif",
            );
        }
        let open = condition.outer && !condition.taken && !condition.otherwise;
        condition.active = open && (name == b"else" || self.holds(name, rest, at));
        condition.taken |= condition.active;
        condition.otherwise |= name == b"else";
        self.conditions.push(condition);
    }

    fn include(&mut self, rest: &[Token], at: Span) {
        let mut line = trimmed(rest).to_vec();
        let mut found = self.included_path(&line);
        if found.is_none() {
            // The file may be named by a macro.
            line = self.expanded(&line);
            found = self.included_path(trimmed(&line));
        }
        let whole = match (trimmed(rest).first(), trimmed(rest).last()) {
            (Some(first), Some(last)) => first.span().to(last.span()),
            _ => at,
        };
        let Some((path, angled)) = found else {
            if !self.stopped {
                let help = "write #include \"file\" or #include <file>";
                self.error(&rules::INCLUDE, whole, "#include names no file", help);
                self.lose();
            }
            return;
        };
        if self.open.len() > MOST_DEPTH {
            let again = |open: &Open| {
                open.path
                    .as_deref()
                    .is_some_and(|p| p == path || p.ends_with(&format!("/{path}")))
            };
            let message = match self.open.iter().any(again) {
                true => format!(
                    "`{path}` includes itself again and again: {MOST_DEPTH} files are open within each other"
                ),
                false => format!("more than {MOST_DEPTH} files are open within each other"),
            };
            let help = "put what may be read only once between #ifndef, #define and #endif";
            self.error(&rules::BOUNDS, whole, message, help);
            self.stopped = true;
            return;
        }
        if self.included == MOST_INCLUDES {
            return self.stop(
                whole,
                format!("more than {MOST_INCLUDES} files are included"),
            );
        }
        self.included += 1;
        let from = self.open.last().and_then(|open| open.path.clone());
        match self.resolver.include(&path, angled, from.as_deref()) {
            Ok(file) => self.enter(file, whole),
            Err(error) => {
                // An effect brings files with it that its listings need not know.
                let report = match self.language {
                    Language::Listing => Diagnostic::error,
                    Language::Host => Diagnostic::warning,
                };
                let report = report(
                    &rules::INCLUDE,
                    whole,
                    format!("`{path}` cannot be read: {error}"),
                );
                self.report(report.with_help("name the folder that it lies in with -I"));
                self.lose();
            }
        }
    }

    /// The file that the rest of a line names.
    fn included_path(&self, line: &[Token]) -> Option<(String, bool)> {
        let text = |tokens: &[Token]| -> Vec<u8> {
            tokens
                .iter()
                .flat_map(|t| t.text(self.sources).into_owned())
                .collect()
        };
        let first = line.first()?;
        let (path, angled) = if first.kind == Kind::Text {
            let quoted = text(std::slice::from_ref(first));
            let inner = quoted.strip_prefix(b"\"")?.strip_suffix(b"\"")?;
            (inner.to_vec(), false)
        } else {
            let close = line.iter().position(|t| t.is(self.sources, b">"))?;
            first
                .is(self.sources, b"<")
                .then(|| (text(line.get(1..close).unwrap_or(&[])), true))?
        };
        let path = String::from_utf8(path).ok()?;
        let path = path.trim();
        (!path.is_empty()).then(|| (path.to_string(), angled))
    }

    fn enter(&mut self, file: super::Included, at: Span) {
        self.included_bytes = self.included_bytes.saturating_add(file.bytes.len());
        if self.included_bytes > SourceMap::MAX_BYTES {
            let most = SourceMap::MAX_BYTES;
            return self.stop(at, format!("more than {most} bytes are included"));
        }
        let filled = file
            .bytes
            .iter()
            .rposition(|b| *b != 0)
            .map_or(0, |last| last + 1);
        if file
            .bytes
            .get(..filled)
            .is_some_and(|text| text.contains(&0))
        {
            let message = format!("`{}` is no text", file.name);
            self.error(&rules::INCLUDE, at, message, "");
            return self.lose();
        }
        match self.sources.add_included(file.name, file.bytes, at) {
            Err(error) => self.stop(at, error.to_string()),
            Ok(added) => {
                let scanner = Scanner::new(added.shared_bytes(), added.span().start, self.language);
                self.open.push(Open {
                    scanner,
                    path: Some(file.path),
                    conditions: self.conditions.len(),
                });
            }
        }
    }
}

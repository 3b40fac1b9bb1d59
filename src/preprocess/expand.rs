//! Uses of macros and what becomes of them.

use super::token::{Kind, Part, Token, trimmed};
use super::{Item, MOST_NESTING, Preprocessor, rules};
use crate::diagnostic::Span;
use crate::isa::SourceModifier;

impl Preprocessor<'_, '_> {
    /// The next word or sign that is no use of a macro.
    pub(super) fn next_expanded(&mut self) -> Token {
        loop {
            let mut token = self.next();
            if token.kind != Kind::Name || !self.expand(&mut token) {
                return token;
            }
        }
    }

    /// What a list of tokens becomes when all macros in it are expanded.
    pub(super) fn expanded(&mut self, tokens: &[Token]) -> Vec<Token> {
        let names = tokens.iter().any(|t| t.kind == Kind::Name);
        if !names || self.stopped {
            return tokens.to_vec();
        }
        if self.nesting == MOST_NESTING {
            let at = tokens.first().map_or(Span::default(), |t| self.place(t));
            self.stop(
                at,
                format!("macros are used more than {MOST_NESTING} deep in arguments of macros"),
            );
            return Vec::new();
        }
        self.nesting += 1;
        let list = tokens.iter().rev().cloned().map(Item::Token).collect();
        let outside = std::mem::replace(&mut self.pending, list);
        let isolated = std::mem::replace(&mut self.isolated, true);
        let mut out = Vec::new();
        loop {
            let token = self.next_expanded();
            if token.kind == Kind::End {
                break;
            }
            out.push(token);
        }
        self.pending = outside;
        self.isolated = isolated;
        self.nesting -= 1;
        out
    }

    /// Puts what a name stands for in its place; false if it is no use of a macro.
    fn expand(&mut self, token: &mut Token) -> bool {
        if token.painted || self.names.is_empty() {
            return false;
        }
        let text = token.text(self.sources);
        let Some(&number) = self.names.get(&text[..]) else {
            let stem = self.macro_stem(token, &text);
            return stem.is_some_and(|(number, length)| self.replace_stem(number, token, length));
        };
        let Some(used) = self.macros.get(number) else {
            return false;
        };
        if used.active {
            token.painted = true;
            return false;
        }
        let Some(parameters) = used.parameters.clone() else {
            return self.replace(number, token, token.span(), None, &[], &[]);
        };
        if !self.parenthesis_follows() {
            return false;
        }
        let Some((arguments, at)) = self.arguments(token, &parameters) else {
            // What is wrong was said; something belongs here.
            self.lose();
            return true;
        };
        self.replace(number, token, at, None, &parameters, &arguments)
    }

    /// `NAME_bx2`, where `NAME` is a macro: its number and the length of its name.
    fn macro_stem(&self, token: &Token, text: &[u8]) -> Option<(usize, usize)> {
        if !token.more.is_empty() || !text.contains(&b'_') {
            return None;
        }
        let stem = SourceModifier::suffixes().find_map(|suffix| {
            let at = text.len().checked_sub(suffix.len())?;
            let (stem, end) = text.split_at_checked(at)?;
            end.eq_ignore_ascii_case(suffix.as_bytes()).then_some(stem)
        })?;
        let number = *self.names.get(stem)?;
        let used = self.macros.get(number)?;
        let usable = used.parameters.is_none() && !used.active;
        usable.then_some((number, stem.len()))
    }

    /// Puts a macro in the place of the first part of a name. Always true.
    fn replace_stem(&mut self, number: usize, token: &Token, length: usize) -> bool {
        let whole = token.span();
        let middle = whole.start + length as u32;
        let suffix = Token {
            part: Part {
                source: Span::new(middle, whole.end),
                ..token.part
            },
            painted: true,
            glued: true,
            first: false,
            ..token.clone()
        };
        let at = Span::new(whole.start, middle);
        self.replace(number, token, at, Some(suffix), &[], &[])
    }

    /// Whether the next sign is `(`.
    fn parenthesis_follows(&self) -> bool {
        for item in self.pending.iter().rev() {
            match item {
                Item::Token(token) if !token.is_space() => return token.is(self.sources, b"("),
                _ => {}
            }
        }
        let Some(open) = self.open.last().filter(|_| !self.isolated) else {
            return false;
        };
        let mut ahead = open.scanner.clone();
        loop {
            let token = Token::of(ahead.next());
            if !token.is_space() {
                return token.is(self.sources, b"(");
            }
        }
    }

    /// The arguments of a use, and where the use stands with them.
    fn arguments(
        &mut self,
        name: &Token,
        parameters: &[Vec<u8>],
    ) -> Option<(Vec<Vec<Token>>, Span)> {
        let mut arguments: Vec<Vec<Token>> = vec![Vec::new()];
        let mut depth = 0usize;
        let end = loop {
            let mut token = self.next();
            let directive = token.first && token.is(self.sources, b"#");
            if token.kind == Kind::End || directive || !self.count(1, self.place(name)) {
                if directive {
                    self.pending.push(Item::Token(token));
                }
                if !self.stopped {
                    let at = self.place(name);
                    let message = format!(
                        "the arguments of `{}` have no end",
                        self.sources.text(name.span())
                    );
                    self.error(
                        &rules::ARGUMENTS,
                        at,
                        message,
                        "write ) behind the last one",
                    );
                }
                return None;
            }
            token.first = false;
            let opens = token.is(self.sources, b"(");
            let closes = token.is(self.sources, b")");
            if opens {
                depth += 1;
                if depth == 1 {
                    continue;
                }
            } else if closes {
                depth = depth.saturating_sub(1);
                if depth == 0 {
                    break token;
                }
            }
            let Some(last) = arguments.last_mut().filter(|_| depth > 0) else {
                continue;
            };
            if token.is(self.sources, b",") && depth == 1 {
                arguments.push(Vec::new());
            } else if !token.is_space() {
                last.push(token);
            } else if last.last().is_some_and(|t| !t.is_space()) {
                token.kind = Kind::Space;
                last.push(token);
            }
        };
        let together = end.part.expansion == name.part.expansion
            && end.span().start >= name.span().start
            && self
                .sources
                .file_of(end.span().start)
                .map(|f| f.span().start)
                == self
                    .sources
                    .file_of(name.span().start)
                    .map(|f| f.span().start);
        let at = if together {
            name.span().to(end.span())
        } else {
            name.span()
        };
        let none = parameters.is_empty() && matches!(&arguments[..], [only] if only.is_empty());
        if none {
            arguments.clear();
        }
        if arguments.len() == parameters.len() {
            return Some((arguments, at));
        }
        let counted = |count: usize| match count {
            1 => "1 argument".to_string(),
            _ => format!("{count} arguments"),
        };
        let message = format!(
            "`{}` takes {}, but is used with {}",
            self.sources.text(name.span()),
            counted(parameters.len()),
            arguments.len()
        );
        let at = match name.part.expansion {
            Some(_) => self.place(name),
            None => at,
        };
        self.error(&rules::ARGUMENTS, at, message, "");
        None
    }

    /// Puts the text of a macro in the place of its use, with a suffix behind it. Always true.
    fn replace(
        &mut self,
        number: usize,
        name: &Token,
        at: Span,
        suffix: Option<Token>,
        parameters: &[Vec<u8>],
        arguments: &[Vec<Token>],
    ) -> bool {
        let Some(used) = self.macros.get(number) else {
            return true;
        };
        let place = self.place(name);
        let (macro_name, body) = (used.name.clone(), used.body.clone());
        if !self.count(body.len().max(1), place) {
            return true;
        }
        let expansion = self.output.expansion(macro_name, at, name.part.expansion);
        let made = self.substituted(&body, expansion, parameters, arguments, place);
        if let Some(used) = self.macros.get_mut(number) {
            used.active = true;
        }
        self.pending.extend(suffix.map(Item::Token));
        self.pending.push(Item::Leave(number));
        self.pending.extend(made.into_iter().rev().map(Item::Token));
        true
    }

    /// The text of a macro with arguments for parameters.
    fn substituted(
        &mut self,
        body: &[Token],
        expansion: u32,
        parameters: &[Vec<u8>],
        arguments: &[Vec<Token>],
        place: Span,
    ) -> Vec<Token> {
        let pastes =
            |sources: &_, token: &Token| token.is(sources, b"##") && !parameters.is_empty();
        let mut expanded: Vec<Option<Vec<Token>>> = vec![None; parameters.len()];
        let mut out: Vec<Token> = Vec::new();
        // Whether the next token is joined to the last one.
        let mut joins = false;
        // Whether there is something to join to.
        let mut joinable = false;
        for (i, token) in body.iter().enumerate() {
            let mut token = token.clone();
            token.part.expansion = Some(expansion);
            if pastes(self.sources, &token) {
                while out.last().is_some_and(Token::is_space) {
                    out.pop();
                }
                joins = true;
                continue;
            }
            if token.is_space() {
                if !joins {
                    out.push(token);
                }
                continue;
            }
            let text = token.text(self.sources);
            let parameter = match token.kind {
                Kind::Name => parameters.iter().position(|p| p[..] == text[..]),
                _ => None,
            };
            let next = body.iter().skip(i + 1).find(|t| !t.is_space());
            let raw = joins || next.is_some_and(|t| pastes(self.sources, t));
            let made = match parameter.and_then(|at| Some((at, arguments.get(at)?))) {
                None => vec![token],
                Some((_, argument)) if raw => trimmed(argument).to_vec(),
                Some((at, argument)) => match expanded.get(at).cloned().flatten() {
                    Some(done) => done,
                    None => {
                        let done = self.expanded(trimmed(argument));
                        if let Some(slot) = expanded.get_mut(at) {
                            *slot = Some(done.clone());
                        }
                        done
                    }
                },
            };
            // A name that was put together counts as much as its parts.
            let words = made.iter().map(|t| 1 + t.more.len()).sum();
            if !self.count(words, place) {
                return Vec::new();
            }
            let empty = made.is_empty();
            let mut made = made.into_iter();
            if joins
                && joinable
                && let Some(last) = out.last_mut()
                && let Some(first) = made.next()
            {
                last.more.extend(first.parts());
                last.painted = false;
            }
            out.extend(made);
            joinable = !empty || (joins && joinable);
            joins = false;
        }
        out
    }
}

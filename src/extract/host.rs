//! Effects and sources of C: where the shaders are in them, and what they are called.

use super::string::Joined;
use crate::diagnostic::{Derivation, Piece, SourceMap, Span};
use crate::preprocess::scan::{Kind, Language, Lexeme, Scanner};
use crate::syntax;

/// A shader that was found in a text.
#[derive(Debug)]
pub(super) struct Found {
    pub(super) name: Option<String>,
    place: Place,
}

/// Where it stands, in bytes of the text.
#[derive(Debug)]
enum Place {
    /// Between the braces of `asm { … }`.
    Block(Span),
    /// String literals.
    Strings(Vec<Span>),
}

impl Found {
    /// Where its text stands, if it is a block.
    pub(super) fn block(&self) -> Option<Span> {
        match self.place {
            Place::Block(block) => Some(block),
            Place::Strings(_) => None,
        }
    }

    /// Its text, made of the text at `base` of the sources.
    pub(super) fn taken_out(&self, base: u32, sources: &SourceMap) -> (Vec<u8>, Derivation) {
        let at = |span: Span| Span::new(base + span.start, base + span.end);
        match &self.place {
            Place::Block(block) => {
                let derivation = Derivation {
                    pieces: vec![Piece {
                        start: 0,
                        source: at(*block),
                        expansion: None,
                    }],
                    expansions: Vec::new(),
                };
                (sources.bytes(at(*block)).to_vec(), derivation)
            }
            Place::Strings(literals) => {
                let mut joined = Joined::default();
                for literal in literals {
                    joined.add(sources.bytes(at(*literal)), base + literal.start);
                }
                joined.finish()
            }
        }
    }
}

/// What a brace encloses.
#[derive(Debug)]
enum Scope {
    Technique(String),
    Pass(String),
    Other,
}

/// The shaders of a text, in their order.
pub(super) fn scan(text: &[u8]) -> Vec<Found> {
    let mut walk = Walk {
        text,
        scanner: Scanner::new(text.into(), 0, Language::Host),
        scopes: Vec::new(),
        announced: None,
        techniques: 0,
        passes: 0,
        last: Last::Other,
        variable: None,
        before_angle: None,
        annotated: false,
        assigned: None,
        elements: None,
        looking: 8 * text.len(),
        found: Vec::new(),
    };
    while walk.step() {}
    walk.found
}

/// What was read last, as far as it tells what a shader is called.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Last {
    /// A name.
    Name(Span),
    /// The end of the size of an array, or of an annotation, behind a name.
    Behind,
    Other,
}

struct Walk<'a> {
    text: &'a [u8],
    scanner: Scanner,
    scopes: Vec<Scope>,
    /// A technique or pass whose brace has not come yet.
    announced: Option<Scope>,
    techniques: usize,
    passes: usize,
    last: Last,
    /// The name before a size or annotation.
    variable: Option<Span>,
    /// The name before the last `<`.
    before_angle: Option<Span>,
    /// Whether the annotations of what was announced are read.
    annotated: bool,
    /// What the last `=` assigns to, and how many scopes are around it.
    assigned: Option<(Span, usize)>,
    /// How many strings were found in the braces behind `=`, if there are braces.
    elements: Option<usize>,
    /// How many more bytes may be looked at behind strings in vain; without a bound, conditions within each other would be
    /// gone through again and again.
    looking: usize,
    found: Vec<Found>,
}

impl Walk<'_> {
    fn bytes(&self, span: Span) -> &[u8] {
        self.text
            .get(span.start as usize..span.end as usize)
            .unwrap_or(&[])
    }

    fn string(&self, span: Span) -> String {
        String::from_utf8_lossy(self.bytes(span)).into_owned()
    }

    /// Reads on; false at the end.
    fn step(&mut self) -> bool {
        let lexeme = self.scanner.next();
        match lexeme.kind {
            Kind::End => return false,
            Kind::Blank | Kind::NewLine | Kind::Splice => {}
            Kind::Sign if lexeme.first && self.bytes(lexeme.span) == b"#" => {
                directive(&mut self.scanner, self.text);
            }
            Kind::Name => self.name(lexeme.span),
            Kind::Text => self.strings(lexeme.span),
            Kind::Number => {}
            Kind::Sign => {
                let sign = self.bytes(lexeme.span).first().copied().unwrap_or(0);
                self.sign(sign, lexeme.span);
            }
        }
        true
    }

    fn name(&mut self, span: Span) {
        let is = |walk: &Self, word: &str| walk.bytes(span).eq_ignore_ascii_case(word.as_bytes());
        if is(self, "technique") {
            self.techniques += 1;
            self.passes = 0;
            self.announced = Some(Scope::Technique(self.techniques.to_string()));
        } else if is(self, "pass") {
            self.passes += 1;
            self.announced = Some(Scope::Pass(self.passes.to_string()));
        } else if matches!(self.last, Last::Name(_))
            && !self.annotated
            && let Some(Scope::Technique(name) | Scope::Pass(name)) = &mut self.announced
        {
            let text = self.text.get(span.start as usize..span.end as usize);
            *name = String::from_utf8_lossy(text.unwrap_or(&[])).into_owned();
        }
        self.last = Last::Name(span);
    }

    fn sign(&mut self, sign: u8, span: Span) {
        let last = std::mem::replace(&mut self.last, Last::Other);
        match sign {
            b'<' if self.announced.is_some() => self.annotated = true,
            b'>' if self.annotated => self.annotated = false,
            b'{' => {}
            _ if !self.annotated => self.announced = None,
            _ => {}
        }
        match sign {
            b'{' if self.scanner.inside_block() => self.block(span),
            b'{' => {
                let scope = self.announced.take().unwrap_or(Scope::Other);
                self.scopes.push(scope);
                self.elements = self.assigned.map(|_| 0);
            }
            b'}' => {
                self.scopes.pop();
            }
            // Within the declaration before a shader there are more of them.
            b';' if self
                .assigned
                .is_some_and(|(_, depth)| self.scopes.len() <= depth) =>
            {
                self.assigned = None;
                self.elements = None;
            }
            b'<' => {
                if let Last::Name(name) = last {
                    self.before_angle = Some(name);
                }
            }
            b'>' => {
                self.variable = self.before_angle.take();
                self.last = Last::Behind;
            }
            b'[' => {
                if let Last::Name(name) = last {
                    self.variable = Some(name);
                }
            }
            b']' => self.last = Last::Behind,
            b'=' => {
                let name = match last {
                    Last::Name(name) => Some(name),
                    Last::Behind => self.variable,
                    Last::Other => None,
                };
                self.assigned = name.map(|name| (name, self.scopes.len()));
                self.elements = None;
            }
            _ => {}
        }
    }

    /// What encloses this place, and what it is assigned to.
    fn called(&mut self) -> Option<String> {
        let mut parts: Vec<String> = Vec::new();
        for scope in &self.scopes {
            if let Scope::Technique(name) | Scope::Pass(name) = scope {
                parts.push(name.clone());
            }
        }
        parts.extend(self.assigned.map(|(name, _)| self.string(name)));
        (!parts.is_empty()).then(|| parts.join("/"))
    }

    /// A block of assembly behind its brace.
    fn block(&mut self, open: Span) {
        let mut end = open.end;
        while self.scanner.inside_block() {
            let lexeme = self.scanner.next();
            end = lexeme.span.start;
            if lexeme.kind == Kind::End {
                break;
            }
        }
        let block = Span::new(open.end, end);
        let shader = self.assigned.is_some() || syntax::begins_with_version(self.bytes(block));
        if shader {
            let name = self.called();
            let place = Place::Block(block);
            self.found.push(Found { name, place });
        }
        self.assigned = None;
    }

    /// A string with those that follow it.
    fn strings(&mut self, first: Span) {
        self.last = Last::Other;
        if self.bytes(first).first() == Some(&b'\'') {
            return;
        }
        let mut literals = vec![first];
        loop {
            let mut ahead = self.scanner.clone();
            let next = match self.looking {
                0 => behind_blanks(&mut ahead),
                _ => behind_directives(&mut ahead, self.text),
            };
            if next.kind != Kind::Text || self.bytes(next.span).first() == Some(&b'\'') {
                let looked_at = next.span.end.saturating_sub(first.end) as usize;
                self.looking = self.looking.saturating_sub(looked_at);
                break;
            }
            literals.push(next.span);
            self.scanner = ahead;
        }
        let mut joined = Joined::default();
        for literal in &literals {
            joined.add(self.bytes(*literal), literal.start);
        }
        let element = self.elements;
        if let Some(elements) = &mut self.elements {
            *elements += 1;
        }
        if !syntax::is_listing(&joined.bytes) {
            return;
        }
        let name = self.called().map(|name| match element {
            Some(element) => format!("{name}[{element}]"),
            None => name,
        });
        let place = Place::Strings(literals);
        self.found.push(Found { name, place });
    }
}

/// Reads the line of a directive behind its `#`, and says what it does with the lines behind it.
fn directive(scanner: &mut Scanner, text: &[u8]) -> Directive {
    let at = |span: Span| text.get(span.start as usize..span.end as usize);
    let mut words = Vec::new();
    scanner.directive = true;
    loop {
        let lexeme = scanner.next();
        match lexeme.kind {
            Kind::NewLine | Kind::End => break,
            Kind::Blank | Kind::Splice => {}
            _ if words.len() < 2 => words.push(at(lexeme.span).unwrap_or(&[])),
            _ => {}
        }
    }
    scanner.directive = false;
    match words[..] {
        [b"if", b"0"] => Directive::IfNot,
        [b"if" | b"ifdef" | b"ifndef", ..] => Directive::If,
        [b"elif" | b"else", ..] => Directive::Else,
        [b"endif", ..] => Directive::End,
        _ => Directive::Other,
    }
}

/// What a directive does with the lines behind it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Directive {
    If,
    /// `#if 0`.
    IfNot,
    Else,
    End,
    Other,
}

/// What stands behind directives between two literals. Of the parts of a condition the first one that can hold is read, as
/// nobody knows here what is defined; a part with a shader of its own is none of these.
fn behind_directives(scanner: &mut Scanner, text: &[u8]) -> Lexeme {
    loop {
        let next = behind_blanks(scanner);
        if !begins_directive(next, text) {
            return next;
        }
        match directive(scanner, text) {
            Directive::IfNot => skip_part(scanner, text, true),
            Directive::Else => {
                let first = behind_blanks(&mut scanner.clone());
                let span = first.span.start as usize..first.span.end as usize;
                let mut joined = Joined::default();
                joined.add(text.get(span).unwrap_or(&[]), 0);
                if first.kind == Kind::Text && syntax::begins_with_version(&joined.bytes) {
                    return next;
                }
                skip_part(scanner, text, false);
            }
            _ => {}
        }
    }
}

fn behind_blanks(scanner: &mut Scanner) -> Lexeme {
    loop {
        let next = scanner.next();
        if !matches!(next.kind, Kind::Blank | Kind::NewLine | Kind::Splice) {
            return next;
        }
    }
}

fn begins_directive(lexeme: Lexeme, text: &[u8]) -> bool {
    lexeme.kind == Kind::Sign && lexeme.first && text.get(lexeme.span.start as usize) == Some(&b'#')
}

/// Skips a part of a condition with the directive that ends it: the end of the condition or, with `to_else`, its next part.
fn skip_part(scanner: &mut Scanner, text: &[u8], to_else: bool) {
    let mut inner = 0_usize;
    loop {
        let lexeme = scanner.next();
        if lexeme.kind == Kind::End {
            return;
        }
        if begins_directive(lexeme, text) {
            match directive(scanner, text) {
                Directive::If | Directive::IfNot => inner += 1,
                Directive::End if inner == 0 => return,
                Directive::Else if inner == 0 && to_else => return,
                Directive::End => inner -= 1,
                _ => {}
            }
        }
    }
}

//! The state of reading one text: a cursor over its tokens.

use super::lexer::{Kind, Token};
use super::names::{Found, Name, Stem, exact_register, register};
use super::report::{Reports, alternatives, quote};
use super::{Damage, rules};
use crate::diagnostic::{Diagnostic, Fix, Rule, Span};
use crate::isa::{Opcode, RegisterFile, Version};
use crate::program::{Register, Statement};

/// Reads the statements of one text.
pub(super) struct Parser<'a> {
    pub(super) text: &'a [u8],
    /// The same as text, of the same length: words and numbers as they are, of which all bytes are ASCII.
    pub(super) words: &'a str,
    pub(super) base: u32,
    pub(super) tokens: Vec<Token>,
    /// The last of them.
    pub(super) end: Token,
    pub(super) at: usize,
    pub(super) version: Version,
    /// Whether names may have been defined that are not known here.
    pub(super) names_missing: bool,
    pub(super) reports: Reports,
    pub(super) statements: Vec<Statement>,
    pub(super) damaged: Vec<Damage>,
    /// Operands without mnemonic, to be matched with `strays`.
    pub(super) lost: Vec<Lost>,
    pub(super) strays: Vec<Stray>,
    /// What [`super::Options::lenient`] says.
    pub(super) lenient: bool,
}

/// Operands whose mnemonic is lost.
pub(super) struct Lost {
    /// Number of their diagnostic.
    pub(super) report: Option<usize>,
    pub(super) line: u32,
    pub(super) destination: Option<Register>,
    /// Instructions that take them.
    pub(super) takers: Vec<Opcode>,
}

/// A mnemonic whose operands are lost.
pub(super) struct Stray {
    pub(super) opcode: Opcode,
    pub(super) line: u32,
    pub(super) report: Option<usize>,
}

impl<'a> Parser<'a> {
    /// The next token; [`Kind::End`] at the end.
    pub(super) fn peek(&self) -> Token {
        self.token(self.at)
    }

    /// Token number `at`; [`Kind::End`] behind the last.
    pub(super) fn token(&self, at: usize) -> Token {
        self.tokens.get(at).copied().unwrap_or(self.end)
    }

    /// Takes the next token; stays at the end.
    pub(super) fn bump(&mut self) -> Token {
        let token = self.peek();
        if token.kind != Kind::End {
            self.at += 1;
        }
        token
    }

    /// The token before the next one.
    pub(super) fn previous(&self) -> Token {
        self.token(self.at.saturating_sub(1))
    }

    pub(super) fn bytes(&self, token: Token) -> &'a [u8] {
        self.between(token, token)
    }

    /// The text from the start of one token to the end of another.
    pub(super) fn between(&self, from: Token, to: Token) -> &'a [u8] {
        self.text
            .get(from.start as usize..to.end as usize)
            .unwrap_or(&[])
    }

    /// The text of a word or a number.
    pub(super) fn word(&self, token: Token) -> &'a str {
        let range = token.start as usize..token.end as usize;
        self.words.get(range).unwrap_or("")
    }

    pub(super) fn quoted(&self, token: Token) -> String {
        quote(self.bytes(token))
    }

    pub(super) fn span(&self, token: Token) -> Span {
        self.span_of(token, token)
    }

    /// From the start of one token to the end of another.
    pub(super) fn span_of(&self, from: Token, to: Token) -> Span {
        Span::new(self.base + from.start, self.base + to.end.max(from.start))
    }

    /// From a token to the last one that was taken.
    pub(super) fn span_from(&self, from: Token) -> Span {
        self.span_of(from, self.previous())
    }

    /// Whether two tokens have nothing between them.
    pub(super) fn glued(&self, before: Token, after: Token) -> bool {
        before.end == after.start
    }

    pub(super) fn report(&mut self, diagnostic: Diagnostic) -> Option<usize> {
        self.reports.push(diagnostic)
    }

    /// Reports an error without repair.
    pub(super) fn error(
        &mut self,
        rule: &'static Rule,
        span: Span,
        message: impl Into<String>,
        help: &str,
    ) -> Option<usize> {
        self.report(Diagnostic::error(rule, span, message).with_help(help))
    }

    /// Reports a misreading whose repair is certain.
    pub(super) fn misread(
        &mut self,
        rule: &'static Rule,
        span: Span,
        message: impl Into<String>,
        meant: &str,
    ) -> Option<usize> {
        let fix = Fix {
            span,
            replacement: meant.to_string(),
            certain: true,
        };
        let help = format!("it must be `{meant}`");
        self.report(
            Diagnostic::error(rule, span, message)
                .with_help(help)
                .with_fix(fix),
        )
    }

    /// Reports a misreading that has these repairs, of which none is certain. Nothing is said of the second and further
    /// ones but that they are possible.
    pub(super) fn unsure(
        &mut self,
        rule: &'static Rule,
        span: Span,
        message: impl Into<String>,
        meant: &[String],
    ) -> Option<usize> {
        let help = format!("did you mean {}?", alternatives(meant));
        let mut report = Diagnostic::error(rule, span, message).with_help(help);
        if let Some(first) = meant.first() {
            report = report.with_fix(Fix {
                span,
                replacement: first.clone(),
                certain: false,
            });
        }
        self.report(report)
    }

    /// Notes a statement that is not in the program.
    pub(super) fn damage(&mut self, span: Span, destination: Option<Register>) {
        self.damaged.push(Damage { span, destination });
    }

    /// Goes to the next line.
    pub(super) fn skip_line(&mut self) {
        if self.peek().kind != Kind::End {
            self.at = self.line_end(self.at + 1);
        }
    }

    /// Number of the first token from `at` on that begins a line.
    pub(super) fn line_end(&self, mut at: usize) -> usize {
        while !self.token(at).first {
            at += 1;
        }
        at
    }

    /// The opcode of a word that is a mnemonic, with or without suffixes.
    pub(super) fn mnemonic(&self, token: Token) -> Option<Opcode> {
        token.stem.opcode
    }

    /// A word before its first underscore, and from there on.
    pub(super) fn stem(&self, token: Token) -> (&'a str, &'a str) {
        let word = self.word(token);
        word.split_at_checked(token.stem.length as usize)
            .unwrap_or((word, ""))
    }

    /// Whether a word names a register, or can only be a misreading of one.
    pub(super) fn registers(&self, token: Token) -> Found<Name> {
        match (token.stem.register, token.kind) {
            (Some(name), _) => Found::Exact(name),
            (None, Kind::Word) => register(self.stem(token).0, self.version),
            (None, _) => Found::No,
        }
    }

    /// Whether a word names a register as it should.
    pub(super) fn is_register(&self, token: Token) -> bool {
        self.named_register(token).is_some()
    }

    /// Whether a word names a register that the version has.
    pub(super) fn has_register(&self, token: Token) -> bool {
        self.named_register(token)
            .is_some_and(|(file, index)| index < file.count(self.version))
    }

    /// The register that a word names as it should, whether the version has it or not.
    fn named_register(&self, token: Token) -> Option<(RegisterFile, u32)> {
        match token.stem.register {
            Some(Name::Register(file, index)) => Some((file, index)),
            _ => None,
        }
    }

    /// How many of the words from `from` to the end of the line belong to no instruction; only the first few are
    /// looked at, so that a line without end costs no more than another.
    pub(super) fn words_of_prose(&self, from: usize) -> usize {
        const LOOKED_AT: usize = 32;
        (from..from + LOOKED_AT)
            .take_while(|&at| at == from || !self.token(at).first)
            .filter(|&at| self.is_prose(self.token(at)))
            .count()
    }

    fn is_prose(&self, token: Token) -> bool {
        let word = self.word(token);
        token.kind == Kind::Word
            && word.len() > 1
            && word.bytes().all(|b| b.is_ascii_alphabetic())
            && self.mnemonic(token).is_none()
            && exact_register(word).is_none()
            && !super::names::is_source_suffix_stem(word)
            && !matches!(
                super::names::letters(word),
                super::names::Letters::Exact(_) | super::names::Letters::Mixed
            )
    }

    /// Reports the rest of the line as a comment that has lost its mark, or as something that is no instruction.
    /// `heading`: the line is before the version, where no instruction can stand.
    pub(super) fn stray_text(&mut self, heading: bool) {
        let first = self.peek();
        let at = self.at;
        if !heading && self.sign_before_instruction() {
            return;
        }
        let prose = self.words_of_prose(at);
        let half_before = !first.first
            && self
                .damaged
                .last()
                .is_some_and(|d| d.span.end == self.span(self.previous()).end);
        let end = self.line_end(self.at + 1);
        let span = self.span_of(first, self.token(end.saturating_sub(1)));
        self.at = end;
        let word = self.bytes(first);
        if first.kind == Kind::Colon {
            let meant = format!(
                "the scan has `:` where a comment begins with `;`: {}",
                quote(self.text_of(span))
            );
            self.misread(&rules::COMMENT, self.span(first), meant, ";");
            return;
        }
        let is_slash = first.kind == Kind::Junk && word == b"/";
        let operands_follow =
            prose < 2 && (self.begins_operand(at + 1) || self.token(at + 1).kind == Kind::Number);
        let sign = !matches!(first.kind, Kind::Word);
        if prose == 0 && !sign {
            let message = format!("{} is no instruction", self.quoted(first));
            self.report(Diagnostic::error(&rules::INSTRUCTION, span, message));
            self.damage(span, None);
            return;
        }
        if prose == 0 && first.kind == Kind::Junk && !is_slash {
            let message = format!(
                "{} stands where an instruction should",
                quote(self.text_of(span))
            );
            let help = match word.first() {
                Some(b'"' | b'\'') => "take the listing out of the string that it stands in",
                _ => "remove it, or write `;` before it if it is a comment",
            };
            self.error(&rules::STRAY, span, message, help);
            return;
        }
        let fix = Fix {
            span: self.span(first).at_start(),
            replacement: if is_slash { "/" } else { "; " }.to_string(),
            certain: if is_slash {
                // Behind half an instruction, or before an operand, a stroke may stand for anything.
                heading || !(half_before || operands_follow)
            } else {
                heading || prose > 1 || (prose == 1 && sign)
            },
        };
        if !fix.certain {
            self.damage(span, None);
        }
        let message = format!(
            "this is no instruction: {} reads like a comment that has lost its `;`",
            quote(self.text_of(span))
        );
        let help = "write `;` before it";
        self.report(
            Diagnostic::error(&rules::COMMENT, span, message)
                .with_help(help)
                .with_fix(fix),
        );
    }

    /// A stray sign at the start of a line whose second word is an instruction: takes the sign alone.
    fn sign_before_instruction(&mut self) -> bool {
        let sign = self.peek();
        let bytes = self.bytes(sign);
        let is_sign = match sign.kind {
            Kind::Junk => bytes != b"/",
            Kind::Dot | Kind::Comma | Kind::Close | Kind::Open => true,
            _ => false,
        };
        let next = self.token(self.at + 1);
        let instruction = !next.first
            && self.mnemonic(next).is_some()
            && (self.begins_operand(self.at + 2) || self.token(self.at + 2).first);
        // A string of another language around the line is another fault.
        let end = self.line_end(self.at + 1);
        let line = self.between(next, self.token(end.saturating_sub(1)));
        let quotes = |b: &u8| matches!(b, b'"' | b'\'');
        let in_string = bytes.first().is_some_and(quotes) && line.iter().any(quotes);
        if !sign.first || !is_sign || !instruction || in_string {
            return false;
        }
        self.bump();
        // Specks of dirt look like quotes; the other signs may mean that the line is not to run.
        let quote_marks = [
            "\"", "'", "`", "\u{2018}", "\u{2019}", "\u{201C}", "\u{201D}", "\u{B4}",
        ];
        let speck = sign.kind != Kind::Junk
            || quote_marks.iter().any(|mark| mark.as_bytes() == bytes)
            || matches!(bytes, [0x91..=0x94 | 0xB4]);
        let span = self.span(sign);
        let message = format!("{} stands before an instruction", quote(bytes));
        let report = Diagnostic::error(&rules::STRAY, span, message)
            .with_help("remove it")
            .with_fix(Fix {
                span,
                replacement: String::new(),
                certain: speck,
            });
        self.report(report);
        true
    }

    /// A dash of typesetting that is read as a minus.
    pub(super) fn dash(&mut self, token: Token) {
        let span = self.span(token);
        let message = "this dash is not the minus of the keyboard; it is read as one";
        let report = Diagnostic::warning(&rules::SPELLING, span, message)
            .with_help("write `-`")
            .with_fix(Fix {
                span,
                replacement: "-".to_string(),
                certain: true,
            });
        self.report(report);
    }

    /// Makes two tokens of the next one, the first of `length` bytes.
    pub(super) fn split_token(&mut self, length: usize) {
        let whole = self.peek();
        let (mut first, mut rest) = (whole, whole);
        first.end = whole.start + length as u32;
        (rest.start, rest.first) = (first.end, false);
        first.stem = Stem::of(self.bytes(first));
        rest.stem = Stem::of(self.bytes(rest));
        if let Some(token) = self.tokens.get_mut(self.at) {
            *token = first;
            self.tokens.insert(self.at + 1, rest);
        }
    }

    pub(super) fn text_of(&self, span: Span) -> &'a [u8] {
        let range = (span.start - self.base) as usize..(span.end - self.base) as usize;
        self.text.get(range).unwrap_or(&[])
    }
}

//! Operands as they are written, before it is known which is the destination.

use super::lexer::{Kind, Token};
use super::names::{self, Components, Found, Letters, Name, ResultSuffix};
use super::parser::Parser;
use super::report::{names as listed, quote};
use super::rules;
use crate::diagnostic::{Diagnostic, Span};
use crate::isa::{RegisterFile, ShaderKind, SourceModifier};
use crate::program::{Register, Statement};
use crate::rules::model;

/// An operand as it is written.
#[derive(Clone, Debug)]
pub(super) enum Written {
    /// A register with what belongs to it.
    Register(WrittenRegister),
    /// A number, where it stands.
    Number(Span),
    /// Something that was reported.
    Damaged,
}

/// A register as it is written.
#[derive(Clone, Debug)]
pub(super) struct WrittenRegister {
    pub(super) span: Span,
    /// Whether it stands where a destination does.
    pub(super) first: bool,
    /// Nothing, `-` or `1-`.
    pub(super) prefix: &'static str,
    pub(super) register: Register,
    /// Nothing or a source suffix.
    pub(super) suffix: &'static str,
    /// The letters behind the dot.
    pub(super) components: Option<Components>,
    /// Where they stand.
    pub(super) components_span: Span,
    /// Whether something in it was reported that cannot be repaired.
    pub(super) damaged: bool,
}

/// The suffix in the word of a register, with its place.
type Suffix<'a> = Option<(&'a str, Span)>;

impl<'a> Parser<'a> {
    /// Reads one operand, the first of its statement or another; tells also whether a comma behind it was read that is written otherwise.
    pub(super) fn operand(&mut self, is_first: bool) -> (Written, bool) {
        let first = self.peek();
        let Some((prefix, prefix_damaged)) = self.prefix() else {
            return (Written::Damaged, false);
        };
        let token = self.peek();
        if token.kind == Kind::Number && (!token.first || self.previous().kind == Kind::Comma) {
            self.bump();
            return (Written::Number(self.span_from(first)), false);
        }
        if token.kind != Kind::Word {
            let message = match token.kind {
                Kind::End => "the listing ends where a register should stand".to_string(),
                _ => format!("{} stands where a register should", self.quoted(token)),
            };
            let span = self.span(token);
            self.report(Diagnostic::error(&rules::REGISTER, span, message));
            self.skip_to_comma();
            return (Written::Damaged, false);
        }
        self.bump();
        let Some((register, suffix, sure)) = self.register(token, is_first) else {
            self.skip_to_comma();
            return (Written::Damaged, false);
        };
        let mut operand = WrittenRegister {
            span: Span::default(),
            first: is_first,
            prefix,
            register,
            suffix: "",
            components: None,
            components_span: Span::default(),
            damaged: prefix_damaged || !sure,
        };
        if let Some((suffix, at)) = suffix {
            self.suffix(&mut operand, suffix, at);
        }
        let next = self.peek();
        // Most operands end here.
        let ends = next.kind == Kind::Comma || next.kind == Kind::Word && next.first;
        let comma_read = !ends && self.behind_register(&mut operand);
        operand.span = match comma_read {
            true => self.span_of(first, self.token(self.at.saturating_sub(2))),
            false => self.span_from(first),
        };
        (Written::Register(operand), comma_read)
    }

    /// What follows the word of a register: index, suffix, components. True if a comma behind them was read that is
    /// written otherwise.
    fn behind_register(&mut self, operand: &mut WrittenRegister) -> bool {
        self.index(operand);
        let next = self.peek();
        if next.kind == Kind::Word
            && self.glued(self.previous(), next)
            && self.word(next).starts_with('_')
        {
            self.bump();
            self.suffix(operand, self.word(next), self.span(next));
        }
        self.lost_underscore(operand);
        let mut comma_read = self.selector(operand);
        self.lost_underscore(operand);
        let (dot, next) = (self.peek(), self.token(self.at + 1));
        let stands_for_comma = dot.kind == Kind::Dot && !dot.first && !next.first;
        if !comma_read && stands_for_comma && self.has_register(next) {
            self.bump();
            let message = "the scan has a point where a comma belongs";
            self.misread(&rules::SEPARATOR, self.span(dot), message, ",");
            comma_read = true;
        }
        comma_read
    }

    /// `-` and `1-`, and whether something else was found and reported. `None` if no operand can follow.
    fn prefix(&mut self) -> Option<(&'static str, bool)> {
        let first = self.peek();
        if first.kind == Kind::Word {
            return Some(("", false));
        }
        let mut minuses = 0;
        loop {
            let token = self.peek();
            match token.kind {
                Kind::Minus => {}
                Kind::Dash => self.dash(token),
                _ => break,
            }
            self.bump();
            minuses += 1;
        }
        let one = self.peek();
        let minus = self.token(self.at + 1);
        if one.kind == Kind::Number
            && matches!(minus.kind, Kind::Minus | Kind::Dash)
            && !minus.first
        {
            self.bump();
            self.bump();
            if minus.kind == Kind::Dash {
                self.dash(minus);
            }
            let span = self.span_of(first, minus);
            let text = self.word(one);
            let value: Option<f32> = text.trim_end_matches(['f', 'F']).parse().ok();
            let extra = matches!(self.peek().kind, Kind::Minus | Kind::Dash);
            while matches!(self.peek().kind, Kind::Minus | Kind::Dash) {
                self.bump();
            }
            if value != Some(1.0) {
                let message = format!("`{text} -` is no modifier: only `1-` is");
                let help = "define the number with `def` and use `sub`";
                self.error(&rules::SOURCE_MODIFIER, span, message, help);
            } else if minuses > 0 || extra {
                let message = "`1-` and `-` stand before one register";
                let help =
                    "`1-` goes with no other modifier; compute one of them into a register first";
                self.error(&model::M4, span, message, help);
            } else {
                if text != "1" {
                    let message = format!("`{text}-` is read as `1-`");
                    self.report(
                        Diagnostic::warning(&rules::SPELLING, span, message)
                            .with_help("write `1-`"),
                    );
                }
                return Some(("1-", false));
            }
            return Some(("1-", true));
        }
        if minuses > 1 {
            let span = self.span_from(first);
            let message = format!("{minuses} minus signs stand before one register");
            let help = "two cancel out: write one or none";
            self.error(&rules::SOURCE_MODIFIER, span, message, help);
            if self.peek().kind != Kind::Word || self.peek().first {
                self.skip_to_comma();
                return None;
            }
        }
        Some((if minuses > 0 { "-" } else { "" }, minuses > 1))
    }

    /// Goes to the next comma of the line, or to its end.
    fn skip_to_comma(&mut self) {
        while !self.peek().first && self.peek().kind != Kind::Comma {
            self.at += 1;
        }
    }

    /// The register of a word, with the suffix in the same word and whether it was certainly meant.
    fn register(&mut self, token: Token, is_first: bool) -> Option<(Register, Suffix<'a>, bool)> {
        let (stem, suffix) = self.stem(token);
        let suffix_start = self.base + token.start + stem.len() as u32;
        let suffix_span = Span::new(suffix_start, self.base + token.end);
        let suffix = (!suffix.is_empty()).then_some((suffix, suffix_span));
        let stem_span = Span::new(self.base + token.start, suffix_start);
        let mut sure = true;
        let name = match self.registers(token) {
            Found::Exact(name) => name,
            Found::Misread(name, meant) => {
                let message = format!("`{stem}` is no register");
                if let Name::Register(file, index) = name
                    && !is_first
                    && !self.may_be_written(Register::new(file, index))
                {
                    sure = false;
                    let report = self.unsure(&rules::REGISTER, stem_span, message, &[meant]);
                    if let Some(report) = report {
                        let hint = "nothing before it writes that register";
                        self.reports.add_help(report, hint);
                    }
                } else {
                    self.misread(&rules::REGISTER, stem_span, message, &meant);
                }
                name
            }
            Found::No => {
                self.unknown_register(stem, stem_span);
                return None;
            }
        };
        match name {
            Name::Register(file, index) => Some((Register::new(file, index), suffix, sure)),
            Name::File(file) if self.peek().kind == Kind::Open && suffix.is_none() => {
                Some((Register::new(file, 0), None, sure))
            }
            Name::File(file) => self
                .apart(token, file)
                .map(|(register, sure)| (register, None, sure)),
            Name::TooLarge => {
                let message = format!(
                    "{} has a number that no register has",
                    quote(stem.as_bytes())
                );
                self.report(Diagnostic::error(&rules::REGISTER, stem_span, message));
                None
            }
        }
    }

    /// Whether a register can have a value here: a temporary has one only if an instruction before wrote it.
    fn may_be_written(&self, register: Register) -> bool {
        let writes = |statement: &Statement| match statement {
            Statement::Instruction(i) => i.destination.is_some_and(|d| d.register == register),
            Statement::Def(_) | Statement::Dcl(_) => false,
        };
        register.file != RegisterFile::Temp
            || self
                .damaged
                .iter()
                .any(|d| d.destination.is_none_or(|r| r == register))
            || self.statements.iter().any(writes)
    }

    /// `c 12`: a register whose number stands apart.
    fn apart(&mut self, token: Token, file: RegisterFile) -> Option<(Register, bool)> {
        let next = self.peek();
        let digits = self.word(next);
        let number = digits
            .parse()
            .ok()
            .filter(|_| !next.first && matches!(next.kind, Kind::Number | Kind::Word));
        let Some(number) = number else {
            let message = format!("{} has no number", self.quoted(token));
            let help = format!("write which one: `{}`", file.register_name(0));
            self.error(&rules::REGISTER, self.span(token), message, &help);
            return None;
        };
        self.bump();
        let meant = file.register_name(number);
        let message = format!("the number of `{meant}` stands apart");
        let span = self.span_of(token, next);
        let sure = number < file.count(self.version);
        if sure {
            self.misread(&rules::REGISTER, span, message, &meant);
        } else {
            self.unsure(&rules::REGISTER, span, message, &[meant]);
        }
        Some((Register::new(file, number), sure))
    }

    fn unknown_register(&mut self, stem: &str, span: Span) {
        let macro_name = self.names_missing
            && stem.bytes().any(|b| b.is_ascii_alphabetic())
            && names::foreign_register(stem).is_none();
        if macro_name {
            return;
        }
        let quoted = quote(stem.as_bytes());
        let possible = names::possible_registers(stem, self.version);
        if !possible.is_empty() {
            let message = format!("{quoted} is no register");
            self.unsure(&rules::REGISTER, span, message, &possible);
            return;
        }
        let report = match names::foreign_register(stem) {
            Some(what) => Diagnostic::error(&rules::REGISTER, span, format!("{quoted} is {what}")),
            None => {
                let report =
                    Diagnostic::error(&rules::REGISTER, span, format!("{quoted} is no register"));
                // `mov r0, rgb, r1`: the letters of a mask with a comma before them.
                let letters = matches!(names::letters(stem), Letters::Exact(_));
                if letters && stem.len() > 1 {
                    report.with_help(format!(
                        "the comma before it may stand for a point: `.{stem}`"
                    ))
                } else {
                    let of_version: Vec<&str> = RegisterFile::all()
                        .filter(|f| f.count(self.version) > 0 && *f != RegisterFile::RastOut)
                        .map(|f| f.row().prefix)
                        .collect();
                    let named = if RegisterFile::RastOut.count(self.version) > 0 {
                        ", and oPos, oFog, oPts"
                    } else {
                        ""
                    };
                    report.with_help(format!(
                        "registers of {} begin with {} and have a number{named}",
                        self.version,
                        of_version.join(", ")
                    ))
                }
            }
        };
        self.report(report);
    }

    /// One source suffix; a second one, or an unknown one, is reported.
    fn suffix(&mut self, operand: &mut WrittenRegister, text: &str, span: Span) {
        // More than one: `_bx2_x2`.
        let parts = text.split('_').filter(|p| !p.is_empty()).count();
        if parts > 1 || !operand.suffix.is_empty() {
            operand.damaged = true;
            let message = format!(
                "{} are two modifiers on one register",
                quote(text.as_bytes())
            );
            let help = "one register takes one modifier";
            self.error(&rules::SOURCE_MODIFIER, span, message, help);
            return;
        }
        match names::source_suffix(text) {
            Found::Exact(suffix) => operand.suffix = suffix,
            Found::Misread(suffix, meant) => {
                operand.suffix = suffix;
                let message = format!("{} is no source modifier", quote(text.as_bytes()));
                self.misread(&rules::SOURCE_MODIFIER, span, message, &meant);
            }
            Found::No
                if !operand.first
                    && names::has_source_suffixes(self.version)
                    && names::exact_result_suffix(text) == Some(ResultSuffix::Saturate) =>
            {
                let message = "a source cannot be saturated; the suffix is passed over";
                let report = if self.lenient {
                    Diagnostic::warning(&rules::SOURCE_MODIFIER, span, message)
                } else {
                    Diagnostic::error(&rules::SOURCE_MODIFIER, span, message)
                };
                let help = "saturate where the register is written: `_sat` belongs to the mnemonic";
                self.report(report.with_help(help));
            }
            Found::No => {
                operand.damaged = true;
                let message = format!("{} is no source modifier", quote(text.as_bytes()));
                let help = if names::exact_result_suffix(text).is_some() {
                    "it belongs to the mnemonic, where it modifies the result".to_string()
                } else if names::has_source_suffixes(self.version) {
                    format!("the modifiers are {}", listed(SourceModifier::suffixes()))
                } else {
                    "a source of a vertex shader takes only `-`".to_string()
                };
                self.error(&rules::SOURCE_MODIFIER, span, message, &help);
            }
        }
    }

    /// The dot with its letters. True if the dot stands for a comma.
    fn selector(&mut self, operand: &mut WrittenRegister) -> bool {
        let dot = self.peek();
        let digits = dot.kind == Kind::Number
            && self.bytes(dot).starts_with(b".")
            && self.glued(self.previous(), dot);
        if dot.first || !(dot.kind == Kind::Dot || digits) {
            return false;
        }
        self.bump();
        let token = if digits { dot } else { self.peek() };
        let text = if digits {
            self.word(dot).trim_start_matches('.')
        } else if token.kind == Kind::Word && !token.first {
            if self.has_register(token) {
                let message = "the scan has a point where a comma belongs";
                self.misread(&rules::SEPARATOR, self.span(dot), message, ",");
                return true;
            }
            self.bump();
            self.word(token)
        } else {
            let message = "no letters follow this point";
            let help = "write which components: letters of xyzw or of rgba";
            self.error(&rules::SELECTOR, self.span(dot), message, help);
            operand.damaged = true;
            return false;
        };
        let start = self.base + dot.start + 1;
        let start = start.max(self.base + token.start);
        let underscore = text.bytes().position(|b| b == b'_');
        let (text, suffix) = text.split_at(underscore.unwrap_or(text.len()));
        let end = start + text.len() as u32;
        let span = Span::new(start, end);
        operand.components_span = span;
        let letters = names::letters(text);
        // `r4.x2`: the suffix of a modifier, behind a dot instead of an underscore.
        if !matches!(letters, Letters::Exact(_))
            && names::has_source_suffixes(self.version)
            && names::is_source_suffix_stem(text)
            && suffix.is_empty()
        {
            let meant = format!("_{}", text.to_ascii_lowercase());
            let whole = Span::new(self.base + dot.start, end);
            let message = format!("`.{text}` are no components but a modifier");
            self.misread(&rules::SOURCE_MODIFIER, whole, message, &meant);
            self.suffix(operand, &meant, span);
            return false;
        }
        if suffix.is_empty() && self.split_mask(operand, text, span) {
            return false;
        }
        self.components(operand, letters, text, span);
        if !suffix.is_empty() {
            let at = Span::new(end, end + suffix.len() as u32);
            if operand.suffix.is_empty() && names::source_suffix(suffix) != Found::No {
                let message = "the modifier stands behind the components";
                let help = "write the modifier first: `r0_bx2.a`";
                self.report(
                    Diagnostic::warning(&rules::SPELLING, span.to(at), message).with_help(help),
                );
            }
            self.suffix(operand, suffix, at);
        }
        false
    }

    /// `.rg b`: letters with a blank between them. Certain where a comma follows; else the second part may be a word
    /// of a comment.
    fn split_mask(&mut self, operand: &mut WrittenRegister, text: &str, span: Span) -> bool {
        let (next, behind) = (self.peek(), self.token(self.at + 1));
        let comma = behind.kind == Kind::Comma && !behind.first;
        if next.kind != Kind::Word || next.first || !(comma || behind.first) {
            return false;
        }
        let joined = [text, self.word(next)].concat();
        let Letters::Exact(components) = names::letters(&joined) else {
            return false;
        };
        let any_order = !operand.first && self.version.kind() == ShaderKind::Vertex;
        if !(any_order || components.in_order()) {
            return false;
        }
        self.bump();
        let span = span.to(self.span(next));
        operand.components_span = span;
        operand.components = Some(components);
        let message = format!("a blank splits the letters `{joined}`");
        if comma {
            self.misread(&rules::SELECTOR, span, message, &joined);
        } else {
            operand.damaged = true;
            self.unsure(&rules::SELECTOR, span, message, &[joined]);
        }
        true
    }

    /// What the letters behind the dot, which are `text`, name.
    fn components(
        &mut self,
        operand: &mut WrittenRegister,
        mut found: Letters,
        text: &str,
        span: Span,
    ) {
        let quoted = || quote(text.as_bytes());
        let (message, help) = match &mut found {
            Letters::Exact(components) => {
                operand.components = Some(*components);
                return;
            }
            Letters::Misread(readings) => {
                // Only sources of vertex shaders name components in any order.
                let any_order = !operand.first && self.version.kind() == ShaderKind::Vertex;
                readings.retain(|(letters, _)| any_order || letters.in_order());
                let message = format!("{} are no components", quoted());
                match &readings[..] {
                    [] => (message, "components are letters of xyzw or of rgba"),
                    // A lone q may as well be the last of stpq.
                    [(_, meant)] if text.eq_ignore_ascii_case("q") => {
                        operand.damaged = true;
                        self.unsure(
                            &rules::SELECTOR,
                            span,
                            message,
                            &[meant.clone(), "a".to_string()],
                        );
                        return;
                    }
                    [(components, meant)] => {
                        operand.components = Some(*components);
                        self.misread(&rules::SELECTOR, span, message, meant);
                        return;
                    }
                    _ => {
                        operand.damaged = true;
                        const MOST: usize = 4;
                        let meant = readings.iter_mut().map(|(_, meant)| std::mem::take(meant));
                        let meant: Vec<String> = meant.take(MOST).collect();
                        self.unsure(&rules::SELECTOR, span, message, &meant);
                        return;
                    }
                }
            }
            Letters::Mixed => (
                format!("{} mixes the letters xyzw and rgba", quoted()),
                "take all letters from one of the two",
            ),
            Letters::TooMany => (
                format!("{} has more than four letters", quoted()),
                "a register has four components",
            ),
            Letters::OtherLanguage => (
                format!("{} are components of another language", quoted()),
                "Direct3D 8 has xyzw and rgba",
            ),
            Letters::No => (
                format!("{} are no components", quoted()),
                "components are letters of xyzw or of rgba",
            ),
        };
        operand.damaged = true;
        // More than four letters are not in order.
        let of_mask = operand.first && matches!(found, Letters::Mixed | Letters::TooMany);
        let rule = if of_mask {
            &model::O24
        } else {
            &rules::SELECTOR
        };
        self.error(rule, span, message, help);
    }

    /// `r4 x2`: a suffix whose underscore is lost.
    fn lost_underscore(&mut self, operand: &mut WrittenRegister) {
        let next = self.peek();
        if next.first || next.kind != Kind::Word {
            return;
        }
        let (before, word) = (self.previous(), self.word(next));
        if !names::is_source_suffix_stem(word) {
            return;
        }
        self.bump();
        let meant = format!("_{}", word.to_ascii_lowercase());
        let span = Span::new(self.base + before.end, self.base + next.end);
        let message = format!("the underscore before {} is lost", self.quoted(next));
        self.misread(&rules::SOURCE_MODIFIER, span, message, &meant);
        self.suffix(operand, &meant, self.span(next));
    }
}

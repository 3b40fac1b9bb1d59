//! `def` and `dcl`.

use super::lexer::{Kind, number};
use super::names::{self, Found};
use super::operand::Written;
use super::parser::Parser;
use super::report::{counted, names as listed, quote};
use super::rules;
use super::statement::Head;
use crate::diagnostic::{Diagnostic, Fix, Span};
use crate::isa::WriteMask;
use crate::program::{Dcl, Def, Register, Statement, Usage};
use crate::rules::model;

impl Parser<'_> {
    /// `def` behind its mnemonic.
    pub(super) fn definition(&mut self, head: Head) {
        if !self.begins_operands() {
            return self.no_operands(head, 5);
        }
        let (operand, comma_read) = self.operand(true);
        let register = match &operand {
            Written::Register(r) if r.prefix.is_empty() && r.suffix.is_empty() => {
                (!r.damaged && r.components.is_none()).then_some((r.register, r.span))
            }
            _ => None,
        };
        if register.is_none()
            && let Written::Register(r) = &operand
            && !r.damaged
        {
            let message = "`def` sets a whole register";
            let help = "write the register alone, without modifier and components";
            self.error(&model::O25, r.span, message, help);
        }
        let named = match &operand {
            Written::Register(r) => Some(r.register),
            _ => None,
        };
        if self.peek().kind == Kind::Comma {
            self.bump();
        } else if !comma_read && self.begins_number() && named.is_some() {
            let at = self.span(self.previous()).at_end();
            let message = "no comma behind the register of `def`";
            let fix = Fix {
                span: at,
                replacement: ",".to_string(),
                certain: true,
            };
            self.report(
                Diagnostic::warning(&rules::SPELLING, at, message)
                    .with_help("write one")
                    .with_fix(fix),
            );
        }
        let (values, whole) = self.numbers();
        let span = self.span_from(head.token);
        if whole && values.len() != 4 {
            let verb = if values.len() == 1 { "is" } else { "are" };
            let message = format!(
                "`def` takes a register and 4 numbers, but {} {verb} written",
                counted(values.len(), "number")
            );
            let help = if values.len() > 4 {
                "a comma may stand for a decimal point"
            } else {
                "write all four components"
            };
            self.error(&model::O25, span, message, help);
        }
        match (register, <[f32; 4]>::try_from(values)) {
            (Some((register, register_span)), Ok(value)) if whole && !head.damaged => {
                self.statements.push(Statement::Def(Def {
                    register,
                    value,
                    co_issue: head.co_issue,
                    span,
                    register_span,
                }));
            }
            _ => self.damage(span, named),
        }
    }

    fn begins_number(&self) -> bool {
        let next = self.peek();
        match next.kind {
            Kind::Number => true,
            Kind::Minus | Kind::Plus | Kind::Dash => {
                let after = self.token(self.at + 1);
                after.kind == Kind::Number && !after.first
            }
            _ => false,
        }
    }

    /// Numbers with commas between them, and whether all could be read.
    fn numbers(&mut self) -> (Vec<f32>, bool) {
        const MOST: usize = 64;
        let (mut values, mut whole) = (Vec::new(), true);
        while values.len() < MOST {
            let ends = match self.peek().kind {
                Kind::End | Kind::Version => true,
                Kind::Word => {
                    self.mnemonic(self.peek()).is_some()
                        || self.peek().first && self.is_register(self.peek())
                }
                _ => false,
            };
            if ends {
                break;
            }
            if self.is_register(self.peek()) {
                let message = format!("{} is no number", self.quoted(self.peek()));
                let help = "`def` takes 4 numbers; registers are joined by instructions";
                self.error(&model::O25, self.span(self.peek()), message, help);
                whole = false;
                self.at = self.line_end(self.at + 1);
                break;
            }
            match self.number() {
                Some(value) => values.push(value),
                None => {
                    whole = false;
                    // What follows without a comma is no number of this list.
                    if !matches!(self.peek().kind, Kind::Comma | Kind::End) && !self.peek().first {
                        self.at = self.line_end(self.at);
                        break;
                    }
                }
            }
            let next = self.peek();
            if next.kind == Kind::Comma {
                self.bump();
            } else if let Some(joined) = self.split_number() {
                match self.join_number(&joined, values.len()) {
                    Some(value) if whole => {
                        values.pop();
                        values.push(value);
                    }
                    Some(_) => {}
                    None => whole = false,
                }
                if self.peek().kind == Kind::Comma {
                    self.bump();
                } else {
                    break;
                }
            } else if next.kind == Kind::Junk && !next.first && values.len() < 4 {
                whole = false;
                let message = format!("{} stands in a number", self.quoted(next));
                let help = "nothing is computed here: write the value in digits with a point";
                self.error(&rules::NUMBER, self.span(next), message, help);
                self.at = self.line_end(self.at);
                break;
            } else if !next.first
                && values.len() < 4
                && self.begins_number()
                && next.kind != Kind::Plus
            {
                let at = self.span(self.previous()).at_end();
                let fix = Fix {
                    span: at,
                    replacement: ",".to_string(),
                    certain: next.kind == Kind::Number,
                };
                let message = format!("no comma before {}", self.quoted(next));
                self.report(
                    Diagnostic::error(&rules::SEPARATOR, at.to(self.span(next)), message)
                        .with_help("write a comma between the two numbers")
                        .with_fix(fix),
                );
            } else {
                break;
            }
        }
        (values, whole)
    }

    /// The number that the last and the next token are halves of: `0. 5`, `0 .5`.
    fn split_number(&self) -> Option<String> {
        let (before, after) = (self.previous(), self.peek());
        if before.kind != Kind::Number || after.kind != Kind::Number || after.first {
            return None;
        }
        let (before, after) = (self.word(before), self.word(after));
        let points = before.ends_with('.') != after.starts_with('.')
            && before.matches('.').count() + after.matches('.').count() == 1;
        let joined = [before, after].concat();
        (points && decimal(&joined).is_some()).then_some(joined)
    }

    /// Takes the second half of a number. It is certain to be one if the list, of which `read` numbers with the first
    /// half were read, has four numbers then; otherwise a comma may be missing, and there is no value.
    fn join_number(&mut self, joined: &str, read: usize) -> Option<f32> {
        let (before, next) = (self.previous(), self.bump());
        let mut commas = 0;
        let mut at = self.at;
        while !self.token(at).first && commas <= 4 {
            match self.token(at).kind {
                Kind::Comma => commas += 1,
                Kind::Number | Kind::Minus | Kind::Plus | Kind::Dash | Kind::Word | Kind::Dot => {}
                _ => break,
            }
            at += 1;
        }
        let span = self.span_of(before, next);
        let message = format!("a blank splits the number `{joined}`");
        if read + commas != 4 {
            self.unsure(&rules::NUMBER, span, message, &[joined.to_string()]);
            return None;
        }
        self.misread(&rules::NUMBER, span, message, joined);
        let sign = self.token(self.at.saturating_sub(3)).kind;
        let value = decimal(joined)?;
        let negative = matches!(sign, Kind::Minus | Kind::Dash);
        Some(if negative { -value } else { value })
    }

    /// One number with its sign; `None` if it was reported.
    fn number(&mut self) -> Option<f32> {
        let first = self.peek();
        let mut negative = false;
        match first.kind {
            Kind::Minus => negative = true,
            Kind::Dash => {
                self.dash(first);
                negative = true;
            }
            _ => {}
        }
        if matches!(first.kind, Kind::Minus | Kind::Dash | Kind::Plus) {
            self.bump();
        }
        // A damaged number may be several tokens: `O.5` is a word and a number.
        let start = self.peek();
        if !matches!(start.kind, Kind::Number | Kind::Word | Kind::Dot) {
            let message = match start.kind {
                Kind::End => "the listing ends where a number should stand".to_string(),
                _ => format!("{} stands where a number should", self.quoted(start)),
            };
            let span = self.span(start);
            self.report(Diagnostic::error(&rules::NUMBER, span, message));
            return None;
        }
        let mut last = self.bump();
        while !self.peek().first
            && matches!(self.peek().kind, Kind::Number | Kind::Word | Kind::Dot)
            && self.glued(last, self.peek())
        {
            last = self.bump();
        }
        let span = self.span_of(start, last);
        let text = self.text_of(span);
        let text = std::str::from_utf8(text).unwrap_or("");
        let quoted = || quote(text.as_bytes());
        let mut value = decimal(text);
        if let Some(bits) = hexadecimal(text) {
            return self.bits(bits, span, negative);
        }
        if value.is_none() {
            let mut meant = numbers_for(text);
            meant.retain(|meant| decimal(meant).is_some());
            let message = format!("{} is no number", quoted());
            match &meant[..] {
                [] => {}
                [only] => {
                    self.misread(&rules::NUMBER, span, message, only);
                    value = decimal(only);
                }
                _ => {
                    self.unsure(&rules::NUMBER, span, message, &meant);
                    return None;
                }
            }
        }
        match value {
            None if self.names_missing && text.starts_with(|c: char| c.is_ascii_alphabetic()) => {
                None
            }
            None => {
                let message = format!("{} is no number", quoted());
                let help = "write it in digits with a point, such as 0.5 or -2";
                self.error(&rules::NUMBER, span, message, help);
                None
            }
            Some(value) if !value.is_finite() => {
                let message = format!("{} is larger than any 32-bit float", quoted());
                let help = "the largest is about 3.4e38";
                self.error(&rules::NUMBER, span, message, help);
                None
            }
            Some(value) => Some(if negative { -value } else { value }),
        }
    }

    /// A number by its bits; only those that no digits can write.
    fn bits(&mut self, value: f32, span: Span, negative: bool) -> Option<f32> {
        if value.is_finite() {
            let message = "only infinities and NaNs are written by their bits";
            let help = format!("as a number this is {value:?}");
            self.error(&rules::NUMBER, span, message, &help);
            None
        } else if negative {
            let message = "a sign stands before the bits of a number, which have their own";
            let help = format!("write 0x{:08X}", (-value).to_bits());
            self.error(&rules::NUMBER, span, message, &help);
            None
        } else {
            Some(value)
        }
    }

    /// `dcl` behind its mnemonic, with the usage that stood in the same word.
    pub(super) fn declaration(&mut self, head: Head, usage_text: &str) {
        let start = self.base + head.token.end - (usage_text.len() as u32).min(head.token.end);
        let usage_span = Span::new(start, self.base + head.token.end);
        let quoted = || quote(usage_text.as_bytes());
        let usage = match names::usage(usage_text) {
            Found::Exact(found) => Some(found),
            Found::Misread(found, meant) => {
                let message = format!("{} is no usage", quoted());
                self.misread(&rules::DECLARATION, usage_span, message, &meant);
                Some(found)
            }
            Found::No => {
                let message = match usage_text {
                    "" => "`dcl` has no usage".to_string(),
                    _ => format!("{} is no usage", quoted()),
                };
                let help = format!("usages are {}", listed(Usage::all().map(|(_, name)| name)));
                self.error(&rules::DECLARATION, head.span, message, &help);
                None
            }
        };
        if let Some((_, None)) = usage {
            let message = format!("{} has an index above 15", quoted());
            self.report(Diagnostic::error(&rules::DECLARATION, usage_span, message));
        }
        if head.co_issue {
            let message = "a declaration is not the second instruction of a pair";
            let help = "remove the `+`";
            self.error(&rules::CO_ISSUE, head.span, message, help);
        }
        if !self.begins_operands() {
            return self.no_operands(head, 1);
        }
        let list = self.operand_list(Some(1));
        let register: Option<Register> = list.destination();
        let span = self.span_from(head.token);
        if let [operand] = &list.operands[..]
            && !list.broken
        {
            let destination = self.destination(operand);
            if let (Some((usage, Some(usage_index))), Some(destination), false) =
                (usage, destination, head.co_issue)
            {
                let mask: WriteMask = destination.mask;
                self.statements.push(Statement::Dcl(Dcl {
                    usage,
                    usage_index,
                    register: destination.register,
                    mask,
                    span,
                }));
                return;
            }
        } else if !list.broken {
            let message = format!(
                "`dcl` takes one register, but {} are written",
                list.operands.len()
            );
            self.report(Diagnostic::error(&rules::OPERAND_COUNT, span, message));
        }
        self.damage(span, register);
    }
}

/// A number without sign as the grammar has it.
fn decimal(text: &str) -> Option<f32> {
    match number(text.as_bytes()) {
        Ok(([], _)) => text.trim_end_matches(['f', 'F']).parse().ok(),
        _ => None,
    }
}

/// The number whose bits are written as eight hexadecimal digits behind `0x`.
fn hexadecimal(text: &str) -> Option<f32> {
    let digits = text
        .strip_prefix("0x")
        .or_else(|| text.strip_prefix("0X"))?;
    let all = digits.len() == 8 && digits.bytes().all(|b| b.is_ascii_hexdigit());
    let bits = u32::from_str_radix(digits, 16).ok().filter(|_| all)?;
    Some(f32::from_bits(bits))
}

/// The numbers that a text with letters for digits can be, a few; an `f` at the end stays.
fn numbers_for(text: &str) -> Vec<String> {
    let (digits, end) = match text.strip_suffix(['f', 'F', 't']) {
        Some(digits) => (digits, "f"),
        None => (text, ""),
    };
    let mut meant = names::digit_readings(digits);
    meant.iter_mut().for_each(|number| number.push_str(end));
    meant
}

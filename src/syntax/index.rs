//! The index in the brackets of a register.

use super::lexer::Kind;
use super::names::{self, Found, Name};
use super::operand::WrittenRegister;
use super::parser::Parser;
use super::rules;
use crate::diagnostic::Diagnostic;
use crate::isa::RegisterFile;
use crate::rules::model;

/// A sum with one more term; out of range of any register it stays out of range.
fn added(sum: i64, number: u32, minus: bool) -> i64 {
    let number = i64::from(number);
    sum.saturating_add(if minus { -number } else { number })
}

impl Parser<'_> {
    /// The brackets behind `c` or `c12`.
    pub(super) fn index(&mut self, operand: &mut WrittenRegister) {
        if self.peek().kind != Kind::Open {
            return;
        }
        let open = self.bump();
        let mut sum = i64::from(operand.register.index);
        let mut relative = false;
        let mut minus = None;
        let problem = loop {
            let term = self.bump();
            match term.kind {
                Kind::Number => match self.word(term).parse::<u32>() {
                    Ok(number) => sum = added(sum, number, minus.is_some()),
                    Err(_) => {
                        break Some((&rules::INDEX, "is no whole number that an index can have"));
                    }
                },
                Kind::Word
                    if minus.is_some() && names::whole_numbers(self.word(term)).is_empty() =>
                {
                    break Some((&rules::INDEX, "is subtracted: only numbers can be"));
                }
                Kind::Word => match names::register(self.word(term), self.version) {
                    found @ (Found::Exact(Name::Register(RegisterFile::Addr, 0))
                    | Found::Misread(Name::Register(RegisterFile::Addr, 0), _)) => {
                        if let Found::Misread(_, meant) = found {
                            let message = format!("{} is no register", self.quoted(term));
                            self.misread(&rules::INDEX, self.span(term), message, &meant);
                        }
                        let (dot, letter) = (self.peek(), self.token(self.at + 1));
                        if dot.kind != Kind::Dot || !self.word(letter).eq_ignore_ascii_case("x") {
                            break Some((&model::O6, "must be `a0.x`"));
                        }
                        self.at += 2;
                        if relative {
                            break Some((&rules::INDEX, "stands twice in one index"));
                        }
                        relative = true;
                    }
                    _ if self.names_missing => {
                        operand.damaged = true;
                        self.skip_index();
                        return;
                    }
                    _ => match &names::whole_numbers(self.word(term))[..] {
                        [] if self.is_register(term) => break Some((&model::O6, "must be `a0.x`")),
                        [] => break Some((&rules::INDEX, "is neither a whole number nor `a0.x`")),
                        [only] => {
                            let message = format!("{} is no number", self.quoted(term));
                            self.misread(&rules::INDEX, self.span(term), message, only);
                            let number = only.parse().unwrap_or(u32::MAX);
                            sum = added(sum, number, minus.is_some());
                        }
                        several => {
                            operand.damaged = true;
                            let message = format!("{} is no number", self.quoted(term));
                            self.unsure(&rules::INDEX, self.span(term), message, several);
                        }
                    },
                },
                Kind::Close => break Some((&rules::INDEX, "closes an index without a number")),
                _ => break Some((&rules::INDEX, "stands where a number or `a0.x` should")),
            }
            let next = self.peek();
            match next.kind {
                Kind::Close => {
                    self.bump();
                    break None;
                }
                Kind::Plus => {
                    self.bump();
                    minus = None;
                }
                Kind::Minus | Kind::Dash => minus = Some(self.bump()),
                _ if self.index_goes_on() => {
                    let message = format!("{} stands where `+` or `]` should", self.quoted(next));
                    let help = "an index is a sum of whole numbers and at most one a0.x";
                    self.error(&rules::INDEX, self.span_of(open, next), message, help);
                    operand.damaged = true;
                    self.skip_index();
                    return;
                }
                _ => {
                    let message = "this index has no `]`";
                    let help = "write `]` behind the index";
                    self.error(&rules::INDEX, self.span(open), message, help);
                    operand.damaged = true;
                    return;
                }
            }
        };
        if let Some((rule, problem)) = problem {
            let term = self.previous();
            let message = format!("{} {problem}", self.quoted(term));
            let help = "an index is written like c[12], c[a0.x + 12] or c12[a0.x]";
            self.error(rule, self.span_of(open, term), message, help);
            operand.damaged = true;
            if term.kind != Kind::Close {
                self.skip_index();
            }
        } else if let Ok(index) = u32::try_from(sum) {
            operand.register.index = index;
            operand.register.relative = relative;
        } else {
            let message = match sum < 0 {
                true => "the numbers in this index add up to less than 0, which no token can say",
                false => "the sum in this index is larger than any register number",
            };
            let span = self.span_from(open);
            self.report(Diagnostic::error(&rules::INDEX, span, message));
            operand.damaged = true;
        }
    }

    /// Whether a `]` stands near in this line, in front of the next operand.
    fn index_goes_on(&self) -> bool {
        const NEAR: usize = 16;
        (self.at..self.at + NEAR)
            .map(|at| self.token(at))
            .take_while(|t| !t.first && !matches!(t.kind, Kind::Comma | Kind::Open | Kind::End))
            .any(|t| t.kind == Kind::Close)
    }

    /// Behind the `]`, if the line has one.
    fn skip_index(&mut self) {
        while !self.peek().first && !matches!(self.peek().kind, Kind::Close | Kind::Comma) {
            self.at += 1;
        }
        if self.peek().kind == Kind::Close && !self.peek().first {
            self.bump();
        }
    }
}

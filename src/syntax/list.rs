//! Lists of operands, and what stands between operands when a list is damaged.

use super::lexer::Kind;
use super::names::{Found, Name};
use super::operand::Written;
use super::parser::Parser;
use super::rules;
use crate::diagnostic::{Diagnostic, Fix};
use crate::program::Register;

/// Operands with commas between them.
#[derive(Debug, Default)]
pub(super) struct List {
    pub(super) operands: Vec<Written>,
    /// Whether what follows the list, or a place between its operands, was reported: then its length says nothing.
    pub(super) broken: bool,
}

impl List {
    /// The register that the first operand names.
    pub(super) fn destination(&self) -> Option<Register> {
        match self.operands.first() {
            Some(Written::Register(r)) => Some(r.register),
            _ => None,
        }
    }

    /// Whether an operand was reported and not repaired.
    pub(super) fn damaged(&self) -> bool {
        let damaged = |o: &Written| match o {
            Written::Register(r) => r.damaged,
            Written::Number(_) => false,
            Written::Damaged => true,
        };
        self.broken || self.operands.iter().any(damaged)
    }
}

/// More operands than any instruction has; bounds what one list can hold.
const MOST_OPERANDS: usize = 64;

impl Parser<'_> {
    /// Whether a token can begin an operand.
    pub(super) fn begins_operand(&self, at: usize) -> bool {
        let token = self.token(at);
        match token.kind {
            Kind::Minus | Kind::Dash => {
                let next = self.token(at + 1);
                !next.first && (next.kind == Kind::Number || self.names_register(at + 1))
            }
            Kind::Number => matches!(self.token(at + 1).kind, Kind::Minus | Kind::Dash),
            Kind::Word => self.names_register(at),
            _ => false,
        }
    }

    /// Whether a word begins a register, read letter by letter or by its shape.
    fn names_register(&self, at: usize) -> bool {
        let (token, next) = (self.token(at), self.token(at + 1));
        if self.mnemonic(token).is_some() {
            return false;
        }
        match self.registers(token) {
            Found::Exact(Name::File(_)) => {
                let digits = self.word(next).bytes().all(|b| b.is_ascii_digit());
                next.kind == Kind::Open || (next.kind == Kind::Number && !next.first && digits)
            }
            Found::Exact(_) => true,
            Found::Misread(..) => true,
            Found::No => false,
        }
    }

    /// Reads operands and the commas between them. `expected` is how many the mnemonic takes, if there is one.
    pub(super) fn operand_list(&mut self, expected: Option<usize>) -> List {
        let mut list = List::default();
        list.operands.reserve(expected.unwrap_or(0));
        loop {
            let (operand, comma_read) = self.operand(list.operands.is_empty());
            list.operands.push(operand);
            if list.operands.len() == MOST_OPERANDS {
                self.skip_line();
                return list;
            }
            if comma_read {
                continue;
            }
            let token = self.peek();
            match token.kind {
                Kind::Comma => {
                    if !self.commas() {
                        list.broken = true;
                        return list;
                    }
                }
                Kind::End | Kind::Plus | Kind::Version => return list,
                _ if token.first => return list,
                Kind::Word if self.mnemonic(token).is_some() => return list,
                _ => {
                    let enough = expected.is_none_or(|n| list.operands.len() >= n);
                    if self.is_register(token) || (!enough && self.begins_operand(self.at)) {
                        self.missing_comma();
                        continue;
                    }
                    if !enough && self.words_of_prose(self.at) < 2 {
                        list.broken = true;
                        let span = self.span(token);
                        let message = format!(
                            "{} stands where a comma and an operand should",
                            self.quoted(token)
                        );
                        self.report(Diagnostic::error(&rules::SEPARATOR, span, message));
                        self.skip_line();
                    }
                    return list;
                }
            }
        }
    }

    /// Takes a comma and tells whether an operand can follow.
    fn commas(&mut self) -> bool {
        let comma = self.bump();
        let again = self.peek();
        if again.kind == Kind::Comma {
            while self.peek().kind == Kind::Comma {
                self.bump();
            }
            let span = self.span_from(again);
            let message = "a comma too many, or an operand is missing between two commas";
            let help = "write one comma, or the operand";
            self.error(&rules::SEPARATOR, span, message, help);
        }
        let next = self.peek();
        let ends = match next.kind {
            Kind::End | Kind::Version | Kind::Plus => true,
            Kind::Word => {
                self.mnemonic(next).is_some() || next.first && self.registers(next) == Found::No
            }
            // A line that does not begin like an operand belongs to what follows.
            Kind::Junk | Kind::Colon | Kind::Close => next.first,
            _ => false,
        };
        if ends {
            let message = "no operand follows this comma";
            let help = "write the operand, or remove the comma";
            self.error(&rules::SEPARATOR, self.span(comma), message, help);
        }
        !ends
    }

    fn missing_comma(&mut self) {
        let next = self.peek();
        let at = self.span(self.previous()).at_end();
        let fix = Fix {
            span: at,
            replacement: ",".to_string(),
            // With a sign, an operator may have been meant.
            certain: next.kind == Kind::Word,
        };
        let message = format!("no comma before {}", self.quoted(next));
        self.report(
            Diagnostic::error(&rules::SEPARATOR, at.to(self.span(next)), message)
                .with_help("write a comma between the two operands")
                .with_fix(fix),
        );
    }
}

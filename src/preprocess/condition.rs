//! The expressions of `#if` and `#elif`.

use super::token::{Kind, Token};
use super::{Preprocessor, rules};
use crate::diagnostic::{SourceMap, Span};
use std::collections::HashMap;

/// How deep parentheses and signs may stand within each other.
const MOST_DEPTH: usize = 64;

/// Operators of two operands with their precedence; longer ones first.
const OPERATORS: [(&[u8], u8); 18] = [
    (b"||", 1),
    (b"&&", 2),
    (b"==", 6),
    (b"!=", 6),
    (b"<=", 7),
    (b">=", 7),
    (b"<<", 8),
    (b">>", 8),
    (b"|", 3),
    (b"^", 4),
    (b"&", 5),
    (b"<", 7),
    (b">", 7),
    (b"+", 9),
    (b"-", 9),
    (b"*", 10),
    (b"/", 10),
    (b"%", 10),
];

impl Preprocessor<'_, '_> {
    /// Whether an expression is not 0. One that cannot be read is, and is reported.
    pub(super) fn condition(&mut self, line: &[Token], at: Span) -> bool {
        let mut line: Vec<Token> = line.iter().filter(|t| !t.is_space()).cloned().collect();
        // What stands behind `defined` is not expanded.
        let mut asked = false;
        for token in &mut line {
            let name = token.kind == Kind::Name;
            let defined = name && self.sources.bytes(token.span()) == b"defined";
            token.painted = defined || (name && asked);
            asked = defined || (asked && token.is(self.sources, b"("));
        }
        let mut tokens = self.expanded(&line);
        tokens.retain(|t| !t.is_space());
        if self.stopped {
            return false;
        }
        let mut reader = Reader {
            tokens: &tokens,
            at: 0,
            sources: self.sources,
            names: &self.names,
            depth: 0,
        };
        match reader.whole() {
            Ok(value) => value != 0,
            Err((token, message)) => {
                let at = tokens.get(token).map_or(at, |token| self.place(token));
                let help = "write a comparison of whole numbers and macros, or defined(NAME)";
                self.error(&rules::EXPRESSION, at, message, help);
                // What belongs here depends on it.
                self.lose();
                false
            }
        }
    }
}

/// What is wrong, with the number of the token where it is.
type Fault = (usize, String);

struct Reader<'a> {
    tokens: &'a [Token],
    at: usize,
    sources: &'a SourceMap,
    names: &'a HashMap<Vec<u8>, usize>,
    depth: usize,
}

impl Reader<'_> {
    fn whole(&mut self) -> Result<i64, Fault> {
        let value = self.choice(true)?;
        match self.tokens.get(self.at) {
            None => Ok(value),
            Some(token) => {
                let text = String::from_utf8_lossy(&token.text(self.sources)).into_owned();
                Err((
                    self.at,
                    format!("`{text}` stands behind the end of the expression"),
                ))
            }
        }
    }

    fn deeper<T>(&mut self, read: impl FnOnce(&mut Self) -> Result<T, Fault>) -> Result<T, Fault> {
        if self.depth == MOST_DEPTH {
            return Err((self.at, "this expression is nested too deeply".to_string()));
        }
        self.depth += 1;
        let result = read(self);
        self.depth -= 1;
        result
    }

    /// `a ? b : c`. `needed`: whether the value is asked for; a division by zero is no fault in what is not.
    fn choice(&mut self, needed: bool) -> Result<i64, Fault> {
        let value = self.binary(0, needed)?;
        if !self.take(b"?") {
            return Ok(value);
        }
        self.deeper(|reader| {
            let yes = reader.choice(needed && value != 0)?;
            if !reader.take(b":") {
                return Err((reader.at, "no `:` follows this `?`".to_string()));
            }
            let no = reader.choice(needed && value == 0)?;
            Ok(if value != 0 { yes } else { no })
        })
    }

    fn binary(&mut self, least: u8, needed: bool) -> Result<i64, Fault> {
        let mut left = self.unary(needed)?;
        while let Some((operator, precedence)) = self.operator().filter(|(_, p)| *p > least) {
            let at = self.at;
            self.at += operator.len();
            let asked = match operator {
                b"&&" => needed && left != 0,
                b"||" => needed && left == 0,
                _ => needed,
            };
            let right = self.deeper(|reader| reader.binary(precedence, asked))?;
            if right == 0 && needed && matches!(operator, b"/" | b"%") {
                return Err((at, "this divides by zero".to_string()));
            }
            left = applied(operator, left, right);
        }
        Ok(left)
    }

    /// The operator that comes next, with its precedence; each of its signs is a token.
    fn operator(&self) -> Option<(&'static [u8], u8)> {
        OPERATORS
            .into_iter()
            .find(|(operator, _)| self.comes(operator))
    }

    fn comes(&self, operator: &[u8]) -> bool {
        let signs = self.tokens.get(self.at..self.at + operator.len());
        let each = |(i, token): (usize, &Token)| {
            token.kind == Kind::Sign
                && operator
                    .get(i..=i)
                    .is_some_and(|sign| self.sources.bytes(token.span()) == sign)
        };
        let Some(signs) = signs.filter(|signs| signs.iter().enumerate().all(each)) else {
            return false;
        };
        signs
            .windows(2)
            .all(|w| matches!(w, [a, b] if a.span().end == b.span().start))
    }

    fn take(&mut self, sign: &[u8]) -> bool {
        let found = self.comes(sign);
        self.at += if found { sign.len() } else { 0 };
        found
    }

    fn unary(&mut self, needed: bool) -> Result<i64, Fault> {
        for sign in [b"!", b"-", b"+", b"~"] {
            if self.take(sign) {
                let value = self.deeper(|reader| reader.unary(needed))?;
                return Ok(match sign {
                    b"!" => i64::from(value == 0),
                    b"-" => value.wrapping_neg(),
                    b"+" => value,
                    _ => !value,
                });
            }
        }
        if self.take(b"(") {
            let open = self.at - 1;
            let value = self.deeper(|reader| reader.choice(needed))?;
            return match self.take(b")") {
                true => Ok(value),
                false => Err((open, "this parenthesis is not closed".to_string())),
            };
        }
        let at = self.at;
        let Some(token) = self.tokens.get(at) else {
            let last = at.saturating_sub(1);
            return Err((
                last,
                "the expression ends where a value should stand".to_string(),
            ));
        };
        self.at += 1;
        let text = token.text(self.sources);
        match token.kind {
            Kind::Name if text[..] == b"defined"[..] => self.defined(at),
            // A name that is no macro is 0.
            Kind::Name => Ok(0),
            Kind::Number => number(&text).ok_or_else(|| {
                let text = String::from_utf8_lossy(&text);
                (at, format!("`{text}` is no whole number"))
            }),
            _ => {
                let text = String::from_utf8_lossy(&text);
                Err((at, format!("`{text}` stands where a value should")))
            }
        }
    }

    /// `NAME` or `(NAME)` behind `defined`.
    fn defined(&mut self, word: usize) -> Result<i64, Fault> {
        let open = self.take(b"(");
        let name = self.tokens.get(self.at).filter(|t| t.kind == Kind::Name);
        let Some(name) = name else {
            return Err((word, "no name follows `defined`".to_string()));
        };
        let known = self.names.contains_key(&name.text(self.sources)[..]);
        self.at += 1;
        if open && !self.take(b")") {
            return Err((
                word,
                "the parenthesis behind `defined` is not closed".to_string(),
            ));
        }
        Ok(i64::from(known))
    }
}

fn applied(operator: &[u8], a: i64, b: i64) -> i64 {
    let shift = |b: i64| (b & 63) as u32;
    match operator {
        b"||" => i64::from(a != 0 || b != 0),
        b"&&" => i64::from(a != 0 && b != 0),
        b"==" => i64::from(a == b),
        b"!=" => i64::from(a != b),
        b"<=" => i64::from(a <= b),
        b">=" => i64::from(a >= b),
        b"<" => i64::from(a < b),
        b">" => i64::from(a > b),
        b"<<" => a.wrapping_shl(shift(b)),
        b">>" => a.wrapping_shr(shift(b)),
        b"|" => a | b,
        b"^" => a ^ b,
        b"&" => a & b,
        b"+" => a.wrapping_add(b),
        b"-" => a.wrapping_sub(b),
        b"*" => a.wrapping_mul(b),
        b"/" => a.checked_div(b).unwrap_or(0),
        _ => a.checked_rem(b).unwrap_or(0),
    }
}

/// A whole number of C: decimal, octal behind `0`, hexadecimal behind `0x`.
fn number(text: &[u8]) -> Option<i64> {
    let text = std::str::from_utf8(text).ok()?;
    let digits = text.trim_end_matches(['u', 'U', 'l', 'L']);
    let hexadecimal = digits
        .strip_prefix("0x")
        .or_else(|| digits.strip_prefix("0X"));
    let (digits, radix) = match hexadecimal {
        Some(digits) => (digits, 16),
        None if digits.len() > 1 && digits.starts_with('0') => (digits, 8),
        None => (digits, 10),
    };
    let value = u64::from_str_radix(digits, radix)
        .ok()
        .filter(|_| !digits.starts_with('+'))?;
    Some(value as i64)
}

//! Texts with expressions in them.

use super::value::Format;
use super::{Expression, ExpressionError, Scope};
use std::fmt;
use std::ops::Range;
use std::str::FromStr;

/// A text with expressions between braces: `r2 is {r2.rgb} here`. A letter behind a colon says how the value is written
/// (`{r2:x}`, as in `print/x`); `{{` and `}}` are braces.
#[derive(Clone, Debug, PartialEq)]
pub struct LogMessage {
    text: String,
    parts: Vec<Part>,
}

#[derive(Clone, Debug, PartialEq)]
enum Part {
    Text(String),
    Value(Expression, Format),
}

impl LogMessage {
    /// The text for a moment. An expression that has no value there is told in its place.
    pub fn text(&self, scope: &Scope<'_>) -> String {
        let parts = self.parts.iter().map(|part| match part {
            Part::Text(text) => text.clone(),
            Part::Value(expression, format) => match expression.evaluate(scope) {
                Ok(value) => value.text(*format),
                Err(why) => format!("<{why}>"),
            },
        });
        parts.collect()
    }
}

impl FromStr for LogMessage {
    type Err = ExpressionError;

    fn from_str(text: &str) -> Result<Self, ExpressionError> {
        let mut parts = Vec::new();
        let mut plain = String::new();
        let mut rest = text;
        while let Some(at) = rest.find(['{', '}']) {
            let (before, brace) = rest.split_at(at);
            plain.push_str(before);
            let place = text.len() - brace.len();
            if let Some(after) = brace.strip_prefix("{{") {
                plain.push('{');
                rest = after;
            } else if let Some(after) = brace.strip_prefix("}}") {
                plain.push('}');
                rest = after;
            } else if let Some(inner) = brace.strip_prefix('{') {
                let (inside, after) = inner
                    .split_once('}')
                    .ok_or_else(|| ExpressionError::new(place..text.len(), "a `}` is missing"))?;
                if !plain.is_empty() {
                    parts.push(Part::Text(std::mem::take(&mut plain)));
                }
                parts.push(value(inside, place + 1)?);
                rest = after;
            } else {
                let message = "no `{` is open; `}}` is a brace";
                return Err(ExpressionError::new(place..place + 1, message));
            }
        }
        plain.push_str(rest);
        if !plain.is_empty() {
            parts.push(Part::Text(plain));
        }
        Ok(Self {
            text: text.to_string(),
            parts,
        })
    }
}

/// What stands between braces, `start` bytes into the message.
fn value(inside: &str, start: usize) -> Result<Part, ExpressionError> {
    let moved = |at: Range<usize>| at.start + start..at.end + start;
    let (expression, format) = match inside.rsplit_once(':') {
        Some((expression, letter)) => {
            let format = letter.trim().parse().map_err(|why| {
                let end = start + inside.len();
                ExpressionError::new(end - letter.len()..end, format!("`{letter}`: {why}"))
            })?;
            (expression, format)
        }
        None => (inside, Format::default()),
    };
    let expression = expression
        .parse()
        .map_err(|why: ExpressionError| ExpressionError::new(moved(why.at), why.message))?;
    Ok(Part::Value(expression, format))
}

impl fmt::Display for LogMessage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

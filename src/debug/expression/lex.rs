//! Text to tokens.
//!
//! Optional runs of letters are `opt` of a run that is not empty: of one that may be, nom 8.0.0 gives the rest at the wrong place
//! when it ends a `&str`, and `recognize` then cuts it off.

use super::{Expression, ExpressionError};
use nom::branch::alt;
use nom::bytes::complete::{tag, take_while, take_while1};
use nom::character::complete::{char, digit1, one_of};
use nom::combinator::{map, opt, peek, recognize, value, verify};
use nom::sequence::{pair, preceded};
use nom::{IResult, Parser};
use std::ops::Range;

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Token<'t> {
    Number(f32),
    Word(&'t str),
    /// The letters behind a dot, with all that hangs on them.
    Components(&'t str),
    /// An operator, a bracket or a comma.
    Sign(&'static str),
    /// Behind the last token.
    End,
}

/// The tokens with their places; [`Token::End`] is the last.
pub(super) fn lex(text: &str) -> Result<Vec<(Token<'_>, Range<usize>)>, ExpressionError> {
    let mut tokens = Vec::new();
    let mut rest = text;
    loop {
        rest = rest.trim_start();
        let start = text.len() - rest.len();
        let Some(first) = rest.chars().next() else {
            tokens.push((Token::End, start..start));
            return Ok(tokens);
        };
        if tokens.len() == Expression::MOST_TOKENS {
            return Err(ExpressionError::new(
                start..text.len(),
                "the expression is too long",
            ));
        }
        let Ok((after, token)) = token(rest) else {
            let end = start + first.len_utf8();
            return Err(ExpressionError::new(start..end, meaning_of(first)));
        };
        tokens.push((token, start..text.len() - after.len()));
        rest = after;
    }
}

/// What to say about a character that begins no token.
fn meaning_of(first: char) -> String {
    match first {
        '=' => "`=` stands in no expression; `==` compares".to_string(),
        '&' => "write `&&`".to_string(),
        '|' => "write `||`".to_string(),
        '.' | '0'..='9' => "this is no number".to_string(),
        other => format!("`{other}` has no meaning here"),
    }
}

fn token(text: &str) -> IResult<&str, Token<'_>> {
    alt((
        map(number, Token::Number),
        map(word, Token::Word),
        map(preceded(char('.'), word), Token::Components),
        map(sign, Token::Sign),
    ))
    .parse(text)
}

/// A number as listings write it, also with an `f` behind; no sign.
fn number(text: &str) -> IResult<&str, f32> {
    let exponent = || recognize((one_of("eE"), opt(one_of("+-")), digit1));
    let whole = recognize((digit1, opt(pair(char('.'), opt(digit1))), opt(exponent())));
    let fraction = recognize((char('.'), digit1, opt(exponent())));
    let (rest, digits) = alt((whole, fraction)).parse(text)?;
    let (rest, _) = opt(one_of("fF")).parse(rest)?;
    // `2r0` is no number and a register; `1.x` neither.
    let letter = |c: char| c.is_alphanumeric() || c == '_' || c == '.';
    verify(peek(take_while(letter)), |after: &str| after.is_empty()).parse(rest)?;
    let (_, number) = nom::combinator::map_res(nom::combinator::rest, str::parse).parse(digits)?;
    Ok((rest, number))
}

fn word(text: &str) -> IResult<&str, &str> {
    recognize(pair(
        take_while1(|c: char| c.is_ascii_alphabetic() || c == '_'),
        opt(take_while1(|c: char| c.is_ascii_alphanumeric() || c == '_')),
    ))
    .parse(text)
}

fn sign(text: &str) -> IResult<&str, &'static str> {
    fn of<'t>(
        sign: &'static str,
    ) -> impl Parser<&'t str, Output = &'static str, Error = nom::error::Error<&'t str>> {
        value(sign, tag(sign))
    }
    alt((
        alt((of("||"), of("&&"), of("=="), of("!="), of("<="), of(">="))),
        alt((
            of("<"),
            of(">"),
            of("!"),
            of("+"),
            of("-"),
            of("*"),
            of("/"),
        )),
        alt((of("("), of(")"), of("["), of("]"), of(","))),
    ))
    .parse(text)
}

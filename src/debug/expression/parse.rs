//! Tokens to a tree.

use super::lex::{Token, lex};
use super::{Binary, ExpressionError, Kind, Name, Node, function};
use crate::isa::operand::{RGBA, XYZW};
use crate::isa::{RegisterFile, SourceModifier};
use std::ops::Range;

/// Binary operators with their strength, as in C.
const OPERATORS: [(&str, u8, Binary); 12] = [
    ("||", 1, Binary::Or),
    ("&&", 2, Binary::And),
    ("==", 3, Binary::Equal),
    ("!=", 3, Binary::Unequal),
    ("<", 4, Binary::Less),
    ("<=", 4, Binary::LessEqual),
    (">", 4, Binary::Greater),
    (">=", 4, Binary::GreaterEqual),
    ("+", 5, Binary::Add),
    ("-", 5, Binary::Subtract),
    ("*", 6, Binary::Multiply),
    ("/", 6, Binary::Divide),
];

type Parsed = Result<Node, ExpressionError>;

pub(super) fn parse(text: &str) -> Parsed {
    let mut parser = Parser {
        tokens: lex(text)?,
        next: 0,
    };
    let tree = parser.list()?;
    match parser.peek() {
        (Token::End, _) => Ok(tree),
        (token, at) => Err(ExpressionError::new(
            at,
            format!("an operator should stand before {}", quoted(token)),
        )),
    }
}

/// A token in a message.
fn quoted(token: Token<'_>) -> String {
    match token {
        Token::Number(number) => format!("`{number}`"),
        Token::Word(word) => format!("`{word}`"),
        Token::Components(letters) => format!("`.{letters}`"),
        Token::Sign(sign) => format!("`{sign}`"),
        Token::End => "the end".to_string(),
    }
}

struct Parser<'t> {
    /// The last is [`Token::End`], which is never taken.
    tokens: Vec<(Token<'t>, Range<usize>)>,
    next: usize,
}

impl<'t> Parser<'t> {
    fn peek(&self) -> (Token<'t>, Range<usize>) {
        let token = self.tokens.get(self.next).or(self.tokens.last());
        token.map_or((Token::End, 0..0), |(token, at)| (*token, at.clone()))
    }

    fn take(&mut self) -> (Token<'t>, Range<usize>) {
        let token = self.peek();
        self.next += 1;
        token
    }

    /// Takes a sign if it comes next.
    fn sign(&mut self, sign: &str) -> bool {
        let here = matches!(self.peek().0, Token::Sign(next) if next == sign);
        self.next += usize::from(here);
        here
    }

    fn expect(&mut self, sign: &str) -> Result<usize, ExpressionError> {
        let (token, at) = self.peek();
        if self.sign(sign) {
            return Ok(at.end);
        }
        let message = match token {
            Token::End => format!("a `{sign}` is missing"),
            other => format!("`{sign}` should stand before {}", quoted(other)),
        };
        Err(ExpressionError::new(at, message))
    }

    /// One value, or several with commas between them, which are put together.
    fn list(&mut self) -> Parsed {
        let first = self.binary(0)?;
        if self.peek().0 != Token::Sign(",") {
            return Ok(first);
        }
        let start = first.at.start;
        let mut parts = vec![first];
        while self.sign(",") {
            parts.push(self.binary(0)?);
        }
        let end = parts.last().map_or(start, |last| last.at.end);
        Ok(Node {
            kind: Kind::List(parts),
            at: start..end,
        })
    }

    /// Operators that bind more strongly than `strength`.
    fn binary(&mut self, strength: u8) -> Parsed {
        let mut left = self.unary()?;
        loop {
            let (Token::Sign(sign), _) = self.peek() else {
                return Ok(left);
            };
            let found = OPERATORS
                .iter()
                .find(|(text, binds, _)| *text == sign && *binds > strength);
            let Some((_, binds, operator)) = found else {
                return Ok(left);
            };
            self.next += 1;
            let right = self.binary(*binds)?;
            left = Node {
                at: left.at.start..right.at.end,
                kind: Kind::Binary(*operator, Box::new(left), Box::new(right)),
            };
        }
    }

    fn unary(&mut self) -> Parsed {
        let (token, at) = self.peek();
        let wrap = match token {
            Token::Sign("-") => Kind::Negate,
            Token::Sign("!") => Kind::Not,
            _ => return self.postfix(),
        };
        self.next += 1;
        let inner = self.unary()?;
        Ok(Node {
            at: at.start..inner.at.end,
            kind: wrap(Box::new(inner)),
        })
    }

    /// What components hang on.
    fn postfix(&mut self) -> Parsed {
        let mut node = self.primary()?;
        while let (Token::Components(text), at) = self.peek() {
            self.next += 1;
            let (letters, suffix) = split_suffix(text);
            let components = components(letters, &at)?;
            let whole = node.at.start..at.end;
            // `r0_dw.xyw`: the swizzle comes first, whatever the order of writing.
            node = match node.kind {
                Kind::Modifier(inner, modifier) => Node {
                    kind: Kind::Modifier(Box::new(swizzled(*inner, components, at.end)), modifier),
                    at: whole,
                },
                kind => swizzled(Node { kind, at: node.at }, components, at.end),
            };
            node = modified(node, suffix, at)?;
        }
        Ok(node)
    }

    fn primary(&mut self) -> Parsed {
        let (token, at) = self.take();
        match token {
            Token::Number(number) => Ok(Node {
                kind: Kind::Number(number),
                at,
            }),
            Token::Word(word) => self.word(word, at),
            Token::Sign("(") => {
                let inner = self.list()?;
                let end = self.expect(")")?;
                Ok(Node {
                    kind: inner.kind,
                    at: at.start..end,
                })
            }
            Token::End => Err(ExpressionError::new(
                at,
                "the expression ends where a register or a number should stand",
            )),
            other => Err(ExpressionError::new(
                at,
                format!(
                    "{} stands where a register or a number should",
                    quoted(other)
                ),
            )),
        }
    }

    fn word(&mut self, word: &str, at: Range<usize>) -> Parsed {
        if self.sign("(") {
            return self.call(word, at);
        }
        if word.eq_ignore_ascii_case("c") && self.sign("[") {
            let index = self.binary(0)?;
            let end = self.expect("]")?;
            return Ok(Node {
                kind: Kind::Indexed(Box::new(index)),
                at: at.start..end,
            });
        }
        let (stem, suffix) = split_suffix(word);
        let kind = match stem.to_ascii_lowercase().as_str() {
            "depth" => Kind::Name(Name::Depth),
            "killed" => Kind::Name(Name::Killed),
            "nan" => Kind::Number(f32::NAN),
            "inf" => Kind::Number(f32::INFINITY),
            lower => match (coordinates(lower), RegisterFile::named(stem)) {
                (Some(stage), _) => Kind::Name(Name::Coordinates(stage)),
                (_, Some((file, index))) => Kind::Name(Name::Register(file, index)),
                _ if function::named(word).is_some() => {
                    let message =
                        format!("`{word}` is a function: its arguments stand in parentheses");
                    return Err(ExpressionError::new(at, message));
                }
                _ => {
                    let message = format!("`{stem}` is no register, and no function");
                    return Err(ExpressionError::new(at, message));
                }
            },
        };
        let node = Node {
            kind,
            at: at.clone(),
        };
        modified(node, suffix, at)
    }

    fn call(&mut self, word: &str, at: Range<usize>) -> Parsed {
        let Some(function) = function::named(word) else {
            let names: Vec<_> = function::function_names().collect();
            let message = format!(
                "there is no function `{word}`; there are {}",
                names.join(", ")
            );
            return Err(ExpressionError::new(at, message));
        };
        let mut arguments = Vec::new();
        if self.peek().0 != Token::Sign(")") {
            arguments.push(self.binary(0)?);
            while self.sign(",") {
                arguments.push(self.binary(0)?);
            }
        }
        let end = self.expect(")")?;
        let at = at.start..end;
        if arguments.len() != function.arguments() {
            let message = format!(
                "{} takes {}; there are {}",
                function.name,
                match function.arguments() {
                    1 => "one argument".to_string(),
                    count => format!("{count} arguments"),
                },
                arguments.len()
            );
            return Err(ExpressionError::new(at, message));
        }
        Ok(Node {
            kind: Kind::Call(function, arguments),
            at,
        })
    }
}

/// The stage of `tc#`.
fn coordinates(word: &str) -> Option<u32> {
    let digits = word.strip_prefix("tc")?;
    let plain = digits.bytes().all(|b| b.is_ascii_digit());
    digits.parse().ok().filter(|_| plain)
}

/// `r0_bx2` → `r0` and `_bx2`.
fn split_suffix(word: &str) -> (&str, &str) {
    word.find('_').map_or((word, ""), |at| word.split_at(at))
}

fn swizzled(node: Node, components: Vec<u8>, end: usize) -> Node {
    Node {
        at: node.at.start..end,
        kind: Kind::Swizzle(Box::new(node), components),
    }
}

fn modified(node: Node, suffix: &str, at: Range<usize>) -> Parsed {
    if suffix.is_empty() {
        return Ok(node);
    }
    let modifier = SourceModifier::from_text("", &suffix.to_ascii_lowercase());
    let Some(modifier) = modifier else {
        let known: Vec<_> = SourceModifier::suffixes().collect();
        let message = format!(
            "`{suffix}` is no source modifier; there are {}",
            known.join(", ")
        );
        return Err(ExpressionError::new(at, message));
    };
    Ok(Node {
        at: node.at.start..at.end,
        kind: Kind::Modifier(Box::new(node), modifier),
    })
}

/// The components that letters name: one to four of one alphabet.
fn components(letters: &str, at: &Range<usize>) -> Result<Vec<u8>, ExpressionError> {
    let lower = letters.to_ascii_lowercase();
    let of = |alphabet: [char; 4]| -> Option<Vec<u8>> {
        let place = |letter| alphabet.iter().position(|known| *known == letter);
        lower
            .chars()
            .map(|letter| place(letter).map(|i| i as u8))
            .collect()
    };
    let found = of(XYZW).or_else(|| of(RGBA));
    found
        .filter(|found| (1..=4).contains(&found.len()))
        .ok_or_else(|| {
            let message =
                format!("`.{letters}`: components are one to four of x, y, z, w or of r, g, b, a");
            ExpressionError::new(at.clone(), message)
        })
}

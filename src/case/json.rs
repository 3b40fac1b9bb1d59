//! JSON as the tree that TOML is read into, so that one reader with one set of messages serves both.
//!
//! JSON has no infinities and no NaN: the texts `"inf"`, `"-inf"` and `"nan"` are these numbers, wherever they stand, and
//! so are the words `Infinity`, `-Infinity` and `NaN`, which many writers of JSON put there. A member that is `null` is
//! not there.

use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

use crate::scene::error::{Problems, rules};
use crate::scene::include::MAX_NESTING;

/// How the numbers that JSON does not have may be written, and how TOML writes them.
const SPECIAL: [(&str, &str); 6] = [
    ("nan", "nan"),
    ("inf", "inf"),
    ("-inf", "-inf"),
    ("NaN", "nan"),
    ("Infinity", "inf"),
    ("-Infinity", "-inf"),
];

/// The object that a JSON text is; `None`, and the problem, if it is none.
pub(super) fn parse<'t>(text: &'t str, problems: &mut Problems) -> Option<DeTable<'t>> {
    let mut parser = Parser { text, at: 0 };
    match parser.document() {
        Ok(table) => Some(table),
        Err(wrong) => {
            // A place of no width is widened to the character that stands there.
            let width = text[wrong.at..].chars().next().map_or(0, char::len_utf8);
            let place = problems.span(wrong.at..wrong.at + width);
            problems.error(&rules::SYNTAX, place, wrong.message);
            None
        }
    }
}

struct Wrong {
    /// A byte of the text that begins a character, or its end.
    at: usize,
    message: String,
}

type Parsed<T> = Result<T, Wrong>;

struct Parser<'t> {
    text: &'t str,
    at: usize,
}

impl<'t> Parser<'t> {
    fn rest(&self) -> &'t str {
        &self.text[self.at..]
    }

    fn wrong<T>(&self, message: impl Into<String>) -> Parsed<T> {
        let (at, message) = (self.at, message.into());
        Err(Wrong { at, message })
    }

    /// Skips white space and tells what stands there.
    fn peek(&mut self) -> Option<char> {
        let rest = self.rest();
        self.at += rest.len() - rest.trim_start_matches([' ', '\t', '\n', '\r']).len();
        self.rest().chars().next()
    }

    fn expect(&mut self, wanted: char, where_: &str) -> Parsed<()> {
        if self.peek() == Some(wanted) {
            self.at += wanted.len_utf8();
            return Ok(());
        }
        let found = self.found();
        self.wrong(format!("`{wanted}` must stand {where_}, not {found}"))
    }

    fn found(&mut self) -> String {
        match self.peek() {
            Some(c) => format!("`{c}`"),
            None => "the end of the file".to_owned(),
        }
    }

    fn document(&mut self) -> Parsed<DeTable<'t>> {
        self.expect('{', "at the beginning of a JSON case")?;
        let table = self.members(1)?;
        match self.peek() {
            None => Ok(table),
            Some(c) => self.wrong(format!("`{c}` stands behind the end of the case")),
        }
    }

    /// The members of an object whose brace has been read.
    fn members(&mut self, depth: usize) -> Parsed<DeTable<'t>> {
        let mut table = DeTable::new();
        if self.peek() == Some('}') {
            self.at += 1;
            return Ok(table);
        }
        loop {
            if self.peek() != Some('"') {
                let found = self.found();
                return self.wrong(format!("a key between quotes must stand here, not {found}"));
            }
            let start = self.at;
            let key = self.string()?;
            let key = Spanned::new(start..self.at, key.into());
            if table.contains_key(&key) {
                let (at, key) = (start, key.get_ref());
                let message = format!("the key `{key}` is given twice");
                return Err(Wrong { at, message });
            }
            self.expect(':', "behind a key")?;
            if !self.null() {
                let value = self.value(depth)?;
                table.insert(key, value);
            }
            if self.peek() == Some(',') {
                self.at += 1;
                continue;
            }
            self.expect('}', "at the end of an object")?;
            return Ok(table);
        }
    }

    /// The entries of a list whose bracket has been read.
    fn entries(&mut self, depth: usize) -> Parsed<DeArray<'t>> {
        let mut list = DeArray::new();
        if self.peek() == Some(']') {
            self.at += 1;
            return Ok(list);
        }
        loop {
            list.push(self.value(depth)?);
            if self.peek() == Some(',') {
                self.at += 1;
                continue;
            }
            self.expect(']', "at the end of a list")?;
            return Ok(list);
        }
    }

    fn value(&mut self, depth: usize) -> Parsed<Spanned<DeValue<'t>>> {
        let first = self.peek();
        let start = self.at;
        let value = match first {
            Some('{' | '[') if depth >= MAX_NESTING => {
                return self.wrong(format!("brackets nest more than {MAX_NESTING} deep"));
            }
            Some('{') => {
                self.at += 1;
                DeValue::Table(self.members(depth + 1)?)
            }
            Some('[') => {
                self.at += 1;
                DeValue::Array(self.entries(depth + 1)?)
            }
            Some('"') => {
                let text = self.string()?;
                match SPECIAL.into_iter().find(|(name, _)| *name == text) {
                    Some((_, number)) => self.as_toml(number, start)?,
                    None => DeValue::String(text.into()),
                }
            }
            Some('-') if !self.rest().starts_with("-I") => self.number()?,
            Some('0'..='9') => self.number()?,
            Some('-' | 'a'..='z' | 'A'..='Z') => self.word()?,
            _ => {
                let found = self.found();
                return self.wrong(format!("a value must stand here, not {found}"));
            }
        };
        Ok(Spanned::new(start..self.at, value))
    }

    /// The word that begins here; a minus may belong to it.
    fn letters(&self) -> &'t str {
        let rest = self.rest();
        let end = |(at, c): (usize, char)| !c.is_ascii_alphanumeric() && (at, c) != (0, '-');
        let length = rest.char_indices().find(|found| end(*found));
        &rest[..length.map_or(rest.len(), |(at, _)| at)]
    }

    /// Skips `null`, if it stands here.
    fn null(&mut self) -> bool {
        let found = self.peek() == Some('n') && self.letters() == "null";
        if found {
            self.at += "null".len();
        }
        found
    }

    /// `true`, `false`, or a number that has a name.
    fn word(&mut self) -> Parsed<DeValue<'t>> {
        let word = self.letters();
        let length = word.len();
        let value = match word {
            "true" => DeValue::Boolean(true),
            "false" => DeValue::Boolean(false),
            "null" => return self.wrong("`null` has no meaning in a list"),
            // As numbers outside quotes only the words that begin with a capital are in use.
            _ => match SPECIAL[3..].iter().find(|(name, _)| *name == word) {
                Some((_, number)) => self.as_toml(number, self.at)?,
                None => return self.wrong(format!("`{word}` is no JSON")),
            },
        };
        self.at += length;
        Ok(value)
    }

    fn number(&mut self) -> Parsed<DeValue<'t>> {
        let rest = self.rest();
        let length = rest
            .find(|c: char| !matches!(c, '0'..='9' | '+' | '-' | '.' | 'e' | 'E'))
            .unwrap_or(rest.len());
        let start = self.at;
        self.at += length;
        let number = &rest[..length];
        self.as_toml(number, start)
    }

    /// A number, which TOML writes as JSON does.
    fn as_toml(&self, number: &'t str, at: usize) -> Parsed<DeValue<'t>> {
        match DeValue::parse(number).map(Spanned::into_inner) {
            Ok(value @ (DeValue::Integer(_) | DeValue::Float(_))) => Ok(value),
            _ => Err(Wrong {
                at,
                message: format!("`{number}` is no number"),
            }),
        }
    }

    /// A text between quotes.
    fn string(&mut self) -> Parsed<String> {
        self.at += 1;
        let mut text = String::new();
        loop {
            let rest = self.rest();
            let Some(stop) = rest.find(['"', '\\', '\n']) else {
                return self.wrong("this text has no closing quote");
            };
            text.push_str(&rest[..stop]);
            self.at += stop;
            match rest.as_bytes().get(stop) {
                Some(b'"') => {
                    self.at += 1;
                    return Ok(text);
                }
                Some(b'\\') => text.push(self.escape()?),
                _ => return self.wrong("a text ends in its line; a new line in it is `\\n`"),
            }
        }
    }

    /// What a backslash and what follows it stand for.
    fn escape(&mut self) -> Parsed<char> {
        let plain = match self.rest().as_bytes().get(1) {
            Some(b'"') => '"',
            Some(b'\\') => '\\',
            Some(b'/') => '/',
            Some(b'b') => '\u{8}',
            Some(b'f') => '\u{c}',
            Some(b'n') => '\n',
            Some(b'r') => '\r',
            Some(b't') => '\t',
            Some(b'u') => return self.unicode(),
            _ => return self.wrong("JSON has no such escape"),
        };
        self.at += 2;
        Ok(plain)
    }

    /// `\uXXXX`, or two of them for a character beyond 16 bits.
    fn unicode(&mut self) -> Parsed<char> {
        let unit = |at: usize| -> Option<u16> {
            let digits = self.rest().get(at..)?.strip_prefix("\\u")?.get(..4)?;
            let plain = digits.bytes().all(|b| b.is_ascii_hexdigit());
            u16::from_str_radix(digits, 16).ok().filter(|_| plain)
        };
        let units = [unit(0), unit(6)];
        let decoded = char::decode_utf16(units.into_iter().flatten()).next();
        match (units[0], decoded) {
            (Some(_), Some(Ok(c))) => {
                self.at += 6 * c.len_utf16();
                Ok(c)
            }
            _ => self.wrong("this escape is no character"),
        }
    }
}

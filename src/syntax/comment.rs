//! Comments that belong to the tokens of a shader, as lines of its listing.
//!
//! What people write behind `;` is no part of a shader, and no assembler put it into tokens. What tools left in comment
//! tokens (debug text, tables of constants) has a form of its own, which every other reader of a listing passes over:
//!
//! ```text
//! ;@comment "CTAB" 0000001C 00000023 FFFE0101
//! ;@        "Direct3D shader\n"
//! ```
//!
//! A string stands for its bytes, the first in the lowest bits of a token, filled up with zeros to a whole token. What is
//! no text stands as tokens of eight hexadecimal digits.

use super::report::quote;
use crate::program::Comment;

/// What begins a comment.
const FIRST: &[u8] = b";@comment";
/// What begins a line that continues one.
const NEXT: &[u8] = b";@";
/// The same with blanks, so that both begin in the same column.
const NEXT_PRINTED: &str = ";@       ";

/// How many tokens stand in one line, at most: strings of 64 characters, or eight tokens in digits.
const STRING_WORDS: usize = 16;
const DIGIT_WORDS: usize = 8;

/// Which line of a comment it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Line {
    First,
    Next,
}

/// The content of a line comment that belongs to the tokens; `open`: the line before belongs to one, too.
pub(super) fn line(text: &[u8], open: bool) -> Option<(Line, &[u8])> {
    let content = |begin: &[u8]| {
        let rest = text.strip_prefix(begin)?;
        let apart = rest.first().is_none_or(u8::is_ascii_whitespace);
        apart.then_some(rest.trim_ascii())
    };
    let first = content(FIRST).map(|rest| (Line::First, rest));
    first.or_else(|| {
        content(NEXT)
            .filter(|_| open)
            .map(|rest| (Line::Next, rest))
    })
}

/// What is wrong with the content of a comment.
pub(super) struct Fault {
    /// How many bytes of the content are left where it is.
    pub(super) left: usize,
    /// How many of them it is.
    pub(super) length: usize,
    pub(super) message: String,
    pub(super) help: &'static str,
}

/// Reads the content of one line and adds it to the words of its comment.
pub(super) fn read(content: &[u8], words: &mut Vec<u32>) -> Result<(), Fault> {
    let mut rest = content.trim_ascii_start();
    while let Some(first) = rest.first() {
        let length = match first {
            b'"' => read_string(rest, words)?,
            _ => read_digits(rest, words)?,
        };
        if words.len() > Comment::MOST_WORDS {
            return Err(Fault {
                left: rest.len(),
                length,
                message: format!("this comment has more than {} tokens", Comment::MOST_WORDS),
                help: "write it as several",
            });
        }
        rest = rest.get(length..).unwrap_or(&[]).trim_ascii_start();
    }
    Ok(())
}

/// Reads a token in digits; gives its length in bytes.
fn read_digits(rest: &[u8], words: &mut Vec<u32>) -> Result<usize, Fault> {
    let ends = |b: &u8| b.is_ascii_whitespace() || *b == b'"';
    let length = rest.iter().position(ends).unwrap_or(rest.len());
    let text = rest.get(..length).unwrap_or(rest);
    let digits = std::str::from_utf8(text).unwrap_or("");
    let all = length == 8 && digits.bytes().all(|b| b.is_ascii_hexdigit());
    match u32::from_str_radix(digits, 16) {
        Ok(word) if all => words.push(word),
        _ => {
            return Err(Fault {
                left: rest.len(),
                length,
                message: format!("{} is no token", quote(text)),
                help: "a comment of the tokens holds strings in quotes and tokens of eight hexadecimal digits",
            });
        }
    }
    Ok(length)
}

/// Reads a string; gives its length in bytes, quotes included.
fn read_string(rest: &[u8], words: &mut Vec<u32>) -> Result<usize, Fault> {
    let mut bytes = Vec::new();
    let mut at = 1;
    let fault = |at: usize, length: usize, message: &str, help: &'static str| Fault {
        left: rest.len().saturating_sub(at),
        length,
        message: message.to_string(),
        help,
    };
    loop {
        let byte = match rest.get(at) {
            None => return Err(fault(0, 1, "this string has no end", "write \" behind it")),
            Some(b'"') => break,
            Some(b'\\') => {
                at += 1;
                match rest.get(at) {
                    Some(b'n') => b'\n',
                    Some(b'r') => b'\r',
                    Some(b't') => b'\t',
                    Some(same @ (b'"' | b'\\')) => *same,
                    _ => {
                        let help = "behind \\ stands one of n, r, t, \" and \\";
                        return Err(fault(at - 1, 1, "nothing is written so", help));
                    }
                }
            }
            Some(byte) => *byte,
        };
        bytes.push(byte);
        at += 1;
    }
    words.extend(bytes.chunks(4).map(|chunk| {
        let mut word = [0; 4];
        word.iter_mut().zip(chunk).for_each(|(w, b)| *w = *b);
        u32::from_le_bytes(word)
    }));
    Ok(at + 1)
}

/// A comment as it stands in a listing, without the last line end.
pub(super) fn print(words: &[u32]) -> String {
    let mut text = String::from_utf8_lossy(FIRST).into_owned();
    let mut rest = words;
    // How many tokens the line can still take.
    let mut room = STRING_WORDS;
    while !rest.is_empty() {
        let (item, length, weight) = match string_length(rest) {
            0 => {
                let digits = rest.first().map_or(String::new(), |w| format!("{w:08X}"));
                (digits, 1, STRING_WORDS / DIGIT_WORDS)
            }
            length => {
                let string = rest.get(..length).map_or(String::new(), print_string);
                (string, length, length)
            }
        };
        if weight > room {
            text.push('\n');
            text += NEXT_PRINTED;
            room = STRING_WORDS;
        }
        room -= weight;
        text.push(' ');
        text += &item;
        rest = rest.get(length..).unwrap_or(&[]);
    }
    text
}

/// How many of the words from the first on are text, filled up with zeros at its end, as far as a line goes; 0 if they are
/// none.
fn string_length(words: &[u32]) -> usize {
    let words = words.get(..STRING_WORDS).unwrap_or(words);
    let full = |word: &u32| word.to_le_bytes().into_iter().all(is_text);
    let length = words.iter().take_while(|w| full(w)).count();
    let ends = words.get(length).is_some_and(|word| {
        let bytes = word.to_le_bytes();
        let letters = bytes.iter().take_while(|b| is_text(**b)).count();
        letters > 0 && bytes.iter().skip(letters).all(|b| *b == 0)
    });
    // A few letters alone are as likely a number.
    match length {
        0 => 0,
        _ => length + usize::from(ends),
    }
}

fn is_text(byte: u8) -> bool {
    matches!(byte, b' '..=b'~' | b'\t' | b'\n' | b'\r')
}

/// A string in quotes; zeros at its end are not written.
fn print_string(words: &[u32]) -> String {
    let mut text = String::from("\"");
    for byte in words.iter().flat_map(|w| w.to_le_bytes()) {
        match byte {
            0 => break,
            b'\n' => text += "\\n",
            b'\r' => text += "\\r",
            b'\t' => text += "\\t",
            b'"' | b'\\' => {
                text.push('\\');
                text.push(char::from(byte));
            }
            _ => text.push(char::from(byte)),
        }
    }
    text.push('"');
    text
}

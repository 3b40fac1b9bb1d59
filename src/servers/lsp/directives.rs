//! Lines for the preprocessor as an editor looks at them: all of them, also those that conditions leave out.

use super::text::Lines;
use std::ops::Range;

/// A line that begins with `#`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Directive {
    /// The word behind `#`.
    pub name: String,
    /// From `#` to the end, with the lines that it is continued on.
    pub at: Range<usize>,
    /// What stands behind the word, blanks and comments at the end left out.
    pub rest: Range<usize>,
}

/// A macro as its `#define` gives it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Macro {
    pub name: String,
    pub name_at: Range<usize>,
    /// All of the directive.
    pub at: Range<usize>,
    /// Whether it takes arguments.
    pub arguments: bool,
}

/// The directives of a text. Those in block comments are none.
pub(super) fn all(text: &[u8]) -> Vec<Directive> {
    let mut found = Vec::new();
    let (mut at, mut first) = (0, true);
    while let Some(rest) = text.get(at..).filter(|rest| !rest.is_empty()) {
        let line = || rest.iter().position(|b| *b == b'\n').unwrap_or(rest.len());
        at += match rest {
            [b'#', ..] if first => {
                let length = continued(rest);
                found.extend(directive(text, at..at + length));
                length
            }
            [b'\n', ..] => {
                first = true;
                1
            }
            [b'/', b'*', ..] => {
                let end = rest.windows(2).skip(2).position(|w| w == b"*/");
                end.map_or(rest.len(), |end| end + 4)
            }
            [b'/', b'/', ..] | [b';', ..] => line(),
            [b, ..] => {
                first &= b.is_ascii_whitespace();
                1
            }
            [] => break,
        };
    }
    found
}

/// The length of a directive with the lines that it goes on in.
fn continued(rest: &[u8]) -> usize {
    let mut at = 0;
    while let Some(length) = rest
        .get(at..)
        .and_then(|r| r.iter().position(|b| *b == b'\n'))
    {
        let line = rest.get(at..at + length).unwrap_or(&[]).trim_ascii_end();
        if !line.ends_with(b"\\") {
            return at + line.len();
        }
        at += length + 1;
    }
    rest.trim_ascii_end().len()
}

fn directive(text: &[u8], at: Range<usize>) -> Option<Directive> {
    let line = text.get(at.clone())?;
    let blanks = line
        .get(1..)?
        .iter()
        .take_while(|b| b.is_ascii_whitespace())
        .count();
    let word = line.get(1 + blanks..)?;
    let length = word
        .iter()
        .take_while(|b| b.is_ascii_alphanumeric())
        .count();
    let name = String::from_utf8_lossy(word.get(..length)?).into_owned();
    let behind = word.get(length..)?;
    let comment = |at: &usize| {
        let rest = behind.get(*at..).unwrap_or(&[]);
        rest.starts_with(b";") || rest.starts_with(b"//") || rest.starts_with(b"/*")
    };
    // Of a macro in several lines a comment ends only its own.
    let end = match behind.contains(&b'\n') {
        true => behind.len(),
        false => (0..behind.len()).find(comment).unwrap_or(behind.len()),
    };
    let rest = behind.get(..end)?;
    let start = at.start + 1 + blanks + length + (rest.len() - rest.trim_ascii_start().len());
    let end = start + rest.trim_ascii().len();
    Some(Directive {
        name,
        at,
        rest: start..end,
    })
}

impl Directive {
    /// The macro that it defines.
    pub(super) fn defines(&self, text: &[u8]) -> Option<Macro> {
        let rest = text
            .get(self.rest.clone())
            .filter(|_| self.name == "define")?;
        let length = rest
            .iter()
            .take_while(|b| b.is_ascii_alphanumeric() || **b == b'_')
            .count();
        let name = String::from_utf8_lossy(rest.get(..length)?).into_owned();
        (length > 0).then_some(Macro {
            name,
            name_at: self.rest.start..self.rest.start + length,
            at: self.at.start..self.rest.end,
            arguments: rest.get(length) == Some(&b'('),
        })
    }

    /// The file that it includes, and whether its name stands in `<` `>`.
    pub(super) fn includes(&self, text: &[u8]) -> Option<(String, bool)> {
        let rest = text
            .get(self.rest.clone())
            .filter(|_| self.name == "include")?;
        let (open, inner) = rest.split_first()?;
        let (close, angled) = match open {
            b'"' => (b'"', false),
            b'<' => (b'>', true),
            _ => return None,
        };
        let length = inner.iter().position(|b| *b == close)?;
        let path = String::from_utf8(inner.get(..length)?.to_vec()).ok()?;
        Some((path.trim().to_string(), angled))
    }
}

/// The lines from each `#if` to its `#endif`, from 0.
pub(super) fn conditions(text: &[u8], lines: &Lines) -> Vec<(u32, u32)> {
    let line = |directive: &Directive| lines.position(text, directive.at.start).line;
    let (mut open, mut found) = (Vec::new(), Vec::new());
    for directive in all(text) {
        match directive.name.as_str() {
            "if" | "ifdef" | "ifndef" => open.push(line(&directive)),
            "endif" => found.extend(open.pop().map(|start| (start, line(&directive)))),
            _ => {}
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::super::text::Encoding;
    use super::*;

    const TEXT: &[u8] =
        b"#include \"a.inc\" ; c\n ps.1.1\n/*\n#define no\n*/\n # define F(a) \\\n mul a, a, a\n\
        #ifdef A // c\n#define B 1\n#endif\nmov r0, #x\n#include <b>";

    #[test]
    fn directives_begin_their_lines() {
        let found = all(TEXT);
        let text =
            |range: &Range<usize>| String::from_utf8_lossy(&TEXT[range.clone()]).into_owned();
        let shown: Vec<_> = found
            .iter()
            .map(|d| (d.name.as_str(), text(&d.rest)))
            .collect();
        let expected = [
            ("include", "\"a.inc\""),
            ("define", "F(a) \\\n mul a, a, a"),
            ("ifdef", "A"),
            ("define", "B 1"),
            ("endif", ""),
            ("include", "<b>"),
        ];
        assert_eq!(shown, expected.map(|(name, rest)| (name, rest.to_string())));
        let macros: Vec<_> = found.iter().filter_map(|d| d.defines(TEXT)).collect();
        assert_eq!((macros[0].name.as_str(), macros[0].arguments), ("F", true));
        assert_eq!(
            (text(&macros[1].name_at), macros[1].arguments),
            ("B".into(), false)
        );
        let files: Vec<_> = found.iter().filter_map(|d| d.includes(TEXT)).collect();
        assert_eq!(
            files,
            [("a.inc".to_string(), false), ("b".to_string(), true)]
        );
        let lines = Lines::new(TEXT, Encoding::Utf8);
        assert_eq!(conditions(TEXT, &lines), [(7, 9)]);
    }

    #[test]
    fn broken_directives_are_no_trouble() {
        for text in [
            b"#".as_slice(),
            b"#define",
            b"#include \"",
            b"#include <a\n",
            b"#define 1",
            b"# \\",
            b"#\\\n",
            b"/*#",
        ] {
            for directive in all(text) {
                assert!(directive.includes(text).is_none(), "{text:?}");
                directive.defines(text);
            }
        }
    }
}

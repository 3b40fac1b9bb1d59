//! The examples of rules, which stand in one line of the table each.

use crate::diagnostic::Span;

/// A short listing, declaration or stream of tokens that shows a rule.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Example {
    /// Its text, one line an instruction.
    pub text: String,
    /// What of the text breaks the rule, as bytes from its start. Empty for what breaks nothing, and for tokens.
    pub marks: Vec<Span>,
}

impl Example {
    /// Reads an example as the table has it: `|` ends a line, `*3` behind a line repeats it, braces stand around what
    /// breaks the rule.
    pub fn new(written: &str) -> Self {
        let mut example = Self::default();
        for line in written.split('|') {
            let times = line.rsplit_once('*');
            let times = times.and_then(|(line, times)| Some((line, times.trim().parse().ok()?)));
            let (line, times): (&str, usize) = times.unwrap_or((line, 1));
            for _ in 0..times.min(MOST_TIMES) {
                example.push(line.trim());
            }
        }
        example
    }

    fn push(&mut self, line: &str) {
        let mut start = 0;
        for letter in line.chars() {
            let here = self.text.len() as u32;
            match letter {
                '{' => start = here,
                '}' => self.marks.push(Span::new(start, here)),
                other => self.text.push(other),
            }
        }
        self.text.push('\n');
    }
}

/// More often than any limit of a version asks for.
const MOST_TIMES: usize = 1000;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_example_is_read_line_by_line() {
        let example = Example::new("ps.1.1 | mov r0, v0 *2 | {mul} r0, {t0}, v0");
        assert_eq!(
            example.text,
            "ps.1.1\nmov r0, v0\nmov r0, v0\nmul r0, t0, v0\n"
        );
        // The third instruction begins at byte 7 + 2 × 11.
        assert_eq!(example.marks, [Span::new(29, 32), Span::new(37, 39)]);
        // What is no number behind the star is text.
        assert_eq!(Example::new("a * b").text, "a * b\n");
    }
}

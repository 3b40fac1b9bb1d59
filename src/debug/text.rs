//! Text for people, with styles: each front shows them as it can.

use std::fmt;

/// Some lines.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Text {
    /// The lines, without their ends.
    pub lines: Vec<Line>,
}

/// A line.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Line {
    /// Its pieces, from left to right.
    pub pieces: Vec<Piece>,
}

/// A piece of a line in one style.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Piece {
    /// The text, without line ends. Of a swatch none: a front that can show colours draws a field of it.
    pub text: String,
    /// How it looks.
    pub style: Style,
}

/// How a piece of text looks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Style {
    /// As text does.
    #[default]
    Plain,
    /// Less important than the rest.
    Dim,
    /// A heading, a name.
    Strong,
    /// A value that has just changed.
    Changed,
    /// The next instruction.
    Marked,
    /// Something to look at: NaN, infinity, a clamp.
    Remarkable,
    /// What could not be done, and why.
    Error,
    /// A field of this colour: red, green, blue.
    Swatch([u8; 3]),
}

impl Text {
    /// Adds a line.
    pub fn line(&mut self, line: impl Into<Line>) {
        self.lines.push(line.into());
    }

    /// Adds the lines of another text.
    pub fn append(&mut self, other: Text) {
        self.lines.extend(other.lines);
    }

    /// Whether there is no line.
    pub fn is_empty(&self) -> bool {
        self.lines.is_empty()
    }
}

impl Line {
    /// A line of one style.
    pub fn styled(text: impl Into<String>, style: Style) -> Self {
        Self::default().and(text, style)
    }

    /// The line with one more piece.
    #[must_use]
    pub fn and(mut self, text: impl Into<String>, style: Style) -> Self {
        self.pieces.push(Piece {
            text: text.into(),
            style,
        });
        self
    }

    /// The line with more plain text.
    #[must_use]
    pub fn plain(self, text: impl Into<String>) -> Self {
        self.and(text, Style::Plain)
    }

    /// The line with the pieces of another behind it.
    #[must_use]
    pub fn joined(mut self, other: Line) -> Self {
        self.pieces.extend(other.pieces);
        self
    }

    /// The line with a field of a colour.
    #[must_use]
    pub fn swatch(self, colour: [u8; 3]) -> Self {
        self.and("", Style::Swatch(colour))
    }
}

impl From<&str> for Line {
    fn from(text: &str) -> Self {
        Self::styled(text, Style::Plain)
    }
}

impl From<String> for Line {
    fn from(text: String) -> Self {
        Self::styled(text, Style::Plain)
    }
}

/// Without styles; blanks at the end are left out.
impl fmt::Display for Line {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text: String = self
            .pieces
            .iter()
            .map(|piece| piece.text.as_str())
            .collect();
        f.write_str(text.trim_end())
    }
}

/// Every line with its end.
impl fmt::Display for Text {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.lines.iter().try_for_each(|line| writeln!(f, "{line}"))
    }
}

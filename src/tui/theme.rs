//! Colours, as far as the terminal has them. Whatever a colour says, a character says, too.

use ratatui::style::{Color, Modifier, Style};
use texcrd::debug::Style as Meaning;

/// How many colours there are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Colours {
    /// None: brightness is told by characters.
    None,
    /// The 16 of ANSI.
    Sixteen,
    /// 256 with a cube of 6×6×6.
    Indexed,
    /// All.
    True,
}

/// How things look.
#[derive(Clone, Copy, Debug)]
pub(super) struct Theme {
    /// The colours there are.
    pub colours: Colours,
}

/// Terminals that have all colours and say so by their name alone, which is all that comes through `ssh`.
const TRUE_COLOUR_TERMINALS: [&str; 7] = [
    "direct",
    "kitty",
    "ghostty",
    "foot",
    "alacritty",
    "wezterm",
    "contour",
];

/// Characters from dark to bright.
const RAMP: &[u8; 10] = b" .:-=+*#%@";

/// The colours of ANSI as xterm has them.
const SIXTEEN: [[u8; 3]; 16] = [
    [0, 0, 0],
    [205, 0, 0],
    [0, 205, 0],
    [205, 205, 0],
    [0, 0, 238],
    [205, 0, 205],
    [0, 205, 205],
    [229, 229, 229],
    [127, 127, 127],
    [255, 0, 0],
    [0, 255, 0],
    [255, 255, 0],
    [92, 92, 255],
    [255, 0, 255],
    [0, 255, 255],
    [255, 255, 255],
];

/// The levels of the cube of 256 colours.
const CUBE: [u8; 6] = [0, 95, 135, 175, 215, 255];

impl Theme {
    /// What the environment says of the terminal: `NO_COLOR`, `COLORTERM`, `TERM`.
    pub(super) fn of_environment(variable: impl Fn(&str) -> Option<String>) -> Self {
        let set = |name: &str| variable(name).filter(|value| !value.is_empty());
        let term = set("TERM").unwrap_or_default();
        let deep = set("COLORTERM").is_some_and(|value| value == "truecolor" || value == "24bit");
        let monochrome = term.starts_with("vt") || term == "dumb" || term.ends_with("-m");
        let colours = if set("NO_COLOR").is_some() || monochrome {
            Colours::None
        } else if deep || TRUE_COLOUR_TERMINALS.iter().any(|name| term.contains(name)) {
            Colours::True
        } else if term.contains("256") {
            Colours::Indexed
        } else if term.is_empty() && cfg!(windows) {
            Colours::True
        } else {
            Colours::Sixteen
        };
        Self { colours }
    }

    /// The nearest colour that there is.
    pub(super) fn colour(self, rgb: [u8; 3]) -> Option<Color> {
        let [red, green, blue] = rgb;
        match self.colours {
            Colours::None => None,
            Colours::True => Some(Color::Rgb(red, green, blue)),
            Colours::Indexed => {
                let step = |channel: u8| {
                    let distance = |level: &u8| level.abs_diff(channel);
                    (0..6).min_by_key(|i| distance(&CUBE[*i])).unwrap_or(0) as u8
                };
                Some(Color::Indexed(
                    16 + 36 * step(red) + 6 * step(green) + step(blue),
                ))
            }
            Colours::Sixteen => {
                let distance = |other: &[u8; 3]| -> u32 {
                    let squares = rgb.iter().zip(other);
                    squares.map(|(a, b)| u32::from(a.abs_diff(*b)).pow(2)).sum()
                };
                let nearest = (0..16).min_by_key(|i| distance(&SIXTEEN[*i]));
                Some(Color::Indexed(nearest.unwrap_or(0) as u8))
            }
        }
    }

    /// The look of a piece of text.
    pub(super) fn style(self, meaning: &Meaning) -> Style {
        let style = Style::default();
        match meaning {
            Meaning::Plain => style,
            Meaning::Dim => style.add_modifier(Modifier::DIM),
            Meaning::Strong => style.add_modifier(Modifier::BOLD),
            Meaning::Changed => self.coloured(Color::Yellow).add_modifier(Modifier::BOLD),
            Meaning::Marked => self.coloured(Color::Green).add_modifier(Modifier::BOLD),
            Meaning::Remarkable => self.coloured(Color::Magenta).add_modifier(Modifier::BOLD),
            Meaning::Error => self.coloured(Color::Red).add_modifier(Modifier::BOLD),
            Meaning::Swatch(rgb) => match self.colour(*rgb) {
                Some(colour) => style.bg(colour),
                None => style,
            },
        }
    }

    fn coloured(self, colour: Color) -> Style {
        match self.colours {
            Colours::None => Style::default(),
            _ => Style::default().fg(colour),
        }
    }

    /// The heading of a pane.
    pub(super) fn heading(self, focused: bool) -> Style {
        if focused {
            self.coloured(Color::Cyan).add_modifier(Modifier::BOLD)
        } else {
            Style::default().add_modifier(Modifier::DIM)
        }
    }

    /// The line that the cursor is on.
    pub(super) fn cursor(self) -> Style {
        Style::default().add_modifier(Modifier::REVERSED)
    }
}

/// How bright a colour looks, 0 to 255: the weights of BT.709, without undoing the curve of the screen.
pub(super) fn brightness([red, green, blue]: [u8; 3]) -> u8 {
    let sum = 2126 * u32::from(red) + 7152 * u32::from(green) + 722 * u32::from(blue);
    (sum / 10_000) as u8
}

/// A character as bright as a colour.
pub(super) fn shade(rgb: [u8; 3]) -> char {
    let step = usize::from(brightness(rgb)) * (RAMP.len() - 1) + 127;
    char::from(RAMP[step / 255])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn colours(variables: &[(&str, &str)]) -> Colours {
        let variable = |name: &str| {
            let found = variables.iter().find(|(other, _)| *other == name);
            found.map(|(_, value)| value.to_string())
        };
        Theme::of_environment(variable).colours
    }

    #[test]
    fn the_environment_says_how_many_colours_there_are() {
        assert_eq!(colours(&[("TERM", "xterm")]), Colours::Sixteen);
        assert_eq!(colours(&[("TERM", "tmux-256color")]), Colours::Indexed);
        assert_eq!(colours(&[("TERM", "xterm-kitty")]), Colours::True);
        let deep = ("COLORTERM", "truecolor");
        assert_eq!(colours(&[("TERM", "xterm-256color"), deep]), Colours::True);
        assert_eq!(colours(&[deep, ("NO_COLOR", "1")]), Colours::None);
        // no-color.org: only if it is not empty.
        assert_eq!(colours(&[deep, ("NO_COLOR", "")]), Colours::True);
        assert_eq!(colours(&[("TERM", "vt220")]), Colours::None);
    }

    #[test]
    fn the_nearest_colour() {
        let colour = |colours, rgb| Theme { colours }.colour(rgb);
        // 100 is nearest to 95, the second level; 255 is the sixth.
        let expected = Some(Color::Indexed(16 + 36 + 5));
        assert_eq!(colour(Colours::Indexed, [100, 0, 255]), expected);
        let expected = Some(Color::Indexed(9));
        assert_eq!(colour(Colours::Sixteen, [250, 10, 10]), expected);
        assert_eq!(colour(Colours::None, [250, 10, 10]), None);
    }

    #[test]
    fn brightness_is_told_by_characters() {
        assert_eq!(shade([0; 3]), ' ');
        assert_eq!(shade([255; 3]), '@');
        // 0.7152 of 9 steps is 6.4.
        assert_eq!(shade([0, 255, 0]), '*');
    }
}

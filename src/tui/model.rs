//! The state of the screen: what has the focus, what is scrolled where, what was said. It knows nothing of the session.

use super::layout::{Pane, VIEWS};
use super::prompt::Prompt;
use texcrd::debug::{Line, Piece, Style, Text};

/// How many lines the output keeps.
const MOST_LINES: usize = 5000;

/// The deepest that a picture is zoomed into.
const MOST_ZOOM: u32 = 256;

/// The state of the screen.
#[derive(Clone, Debug)]
pub(super) struct Model {
    /// The pane that the arrow keys are for.
    pub focus: Pane,
    /// Whether what is typed goes into the command line.
    pub typing: bool,
    /// What the shared place shows.
    pub view: Pane,
    /// The line of the listing, from 1, that the cursor is on.
    pub cursor: usize,
    /// The first register that is shown; `None` keeps in sight what changed last.
    pub registers: Option<usize>,
    /// The first watch that is shown.
    pub watches: usize,
    /// How many lines of the output are below what is shown.
    pub output_below: usize,
    /// What was said, the latest last.
    pub output: Vec<Line>,
    /// The command line.
    pub prompt: Prompt,
    /// How often the frame is enlarged, from 1.
    pub frame_zoom: u32,
    /// How often the texture is enlarged, from 1.
    pub texture_zoom: u32,
    /// Whether the help is shown, and its first line.
    pub help: Option<usize>,
}

impl Model {
    /// A fresh screen, with the frame in the shared place if there is one.
    pub(super) fn new(has_frame: bool) -> Self {
        Self {
            focus: Pane::Listing,
            typing: false,
            view: if has_frame {
                Pane::Frame
            } else {
                Pane::Watches
            },
            cursor: 1,
            registers: None,
            watches: 0,
            output_below: 0,
            output: Vec::new(),
            prompt: Prompt::default(),
            frame_zoom: 1,
            texture_zoom: 1,
            help: None,
        }
    }

    /// Something was entered.
    pub(super) fn echo(&mut self, line: &str) {
        self.push(Line {
            pieces: vec![Piece {
                text: format!("> {line}"),
                style: Style::Dim,
            }],
        });
    }

    /// Something was said.
    pub(super) fn say(&mut self, text: Text) {
        text.lines.into_iter().for_each(|line| self.push(line));
    }

    /// Something went wrong.
    pub(super) fn complain(&mut self, text: impl Into<String>) {
        self.push(Line {
            pieces: vec![Piece {
                text: text.into(),
                style: Style::Error,
            }],
        });
    }

    fn push(&mut self, line: Line) {
        self.output_below = 0;
        self.output.push(line);
        if self.output.len() > MOST_LINES {
            self.output.remove(0);
        }
    }

    /// Moves the focus among the panes there are, round and round.
    pub(super) fn cycle(&mut self, panes: &[Pane], forward: bool) {
        let count = panes.len().max(1);
        let here = panes.iter().position(|pane| *pane == self.focus);
        let next = match (here, forward) {
            (Some(here), true) => here + 1,
            (Some(here), false) => here + count - 1,
            (None, _) => 0,
        };
        if let Some(pane) = panes.get(next % count) {
            self.focus = *pane;
        }
        self.typing = false;
    }

    /// Shows a pane and gives it the focus.
    pub(super) fn show(&mut self, pane: Pane) {
        if VIEWS.contains(&pane) {
            self.view = pane;
        }
        self.focus = pane;
        self.typing = false;
    }

    /// Enlarges or shrinks the picture of a pane.
    pub(super) fn zoom(&mut self, pane: Pane, closer: bool) {
        let zoom = match pane {
            Pane::Frame => &mut self.frame_zoom,
            Pane::Texture => &mut self.texture_zoom,
            _ => return,
        };
        *zoom = if closer { *zoom * 2 } else { *zoom / 2 }.clamp(1, MOST_ZOOM);
    }
}

/// A number of lines on from a place, not beyond `0..=most`.
pub(super) fn scrolled(from: usize, lines: isize, most: usize) -> usize {
    from.saturating_add_signed(lines).min(most)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_focus_goes_round() {
        let panes = [Pane::Listing, Pane::Registers, Pane::Output];
        let mut model = Model::new(false);
        let mut cycled = |forward| {
            model.cycle(&panes, forward);
            model.focus
        };
        assert_eq!(cycled(true), Pane::Registers);
        assert_eq!(cycled(false), Pane::Listing);
        assert_eq!(cycled(false), Pane::Output);
        assert_eq!(cycled(true), Pane::Listing);
        model.focus = Pane::Quad;
        model.cycle(&panes, true);
        assert_eq!(model.focus, Pane::Listing);
        model.cycle(&[], true);
        assert_eq!(model.focus, Pane::Listing);
    }

    #[test]
    fn the_output_does_not_grow_without_end() {
        let mut model = Model::new(false);
        for number in 0..MOST_LINES + 10 {
            model.echo(&number.to_string());
        }
        assert_eq!(model.output.len(), MOST_LINES);
        assert_eq!(model.output[0].pieces[0].text, "> 10");
    }

    #[test]
    fn zoom_has_ends() {
        let mut model = Model::new(true);
        model.zoom(Pane::Frame, false);
        assert_eq!(model.frame_zoom, 1);
        for _ in 0..40 {
            model.zoom(Pane::Frame, true);
        }
        assert_eq!(model.frame_zoom, MOST_ZOOM);
        assert_eq!(model.texture_zoom, 1);
    }
}

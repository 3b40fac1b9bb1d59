//! Which pane stands where.

use ratatui::layout::Rect;

/// A part of the screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Pane {
    /// The listing.
    Listing,
    /// The registers.
    Registers,
    /// What the commands said.
    Output,
    /// The watches.
    Watches,
    /// The frame with the pixel.
    Frame,
    /// The texture that was sampled last.
    Texture,
    /// The four pixels that run together.
    Quad,
}

/// The panes that share a place where the screen is small, in the order of their keys, from `1`.
pub(super) const VIEWS: [Pane; 4] = [Pane::Watches, Pane::Frame, Pane::Texture, Pane::Quad];

impl Pane {
    /// Its heading.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Listing => "Listing",
            Self::Registers => "Registers",
            Self::Output => "Output",
            Self::Watches => "Watches",
            Self::Frame => "Frame",
            Self::Texture => "Texture",
            Self::Quad => "Quad",
        }
    }
}

/// The smallest screen there is room on.
pub(super) const SMALLEST: [u16; 2] = [72, 18];

/// From here on there are three columns.
const WIDE: [u16; 2] = [112, 28];

/// A name, four numbers and a swatch, which the quad has as well.
const REGISTERS: u16 = 39;

/// Where everything stands. The first row of a pane is its heading; between columns there is one of lines.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Layout {
    /// The panes from the left to the right, from above.
    pub panes: Vec<(Pane, Rect)>,
    /// The line above all.
    pub status: Rect,
    /// The command line.
    pub prompt: Rect,
    /// The columns of lines between panes.
    pub rules: Vec<Rect>,
}

impl Layout {
    /// Divides the screen; `view` is what the shared place shows. Without pictures there is no column for them. `None` if there is
    /// too little room.
    pub(super) fn new(area: Rect, view: Pane, pictures: bool) -> Option<Self> {
        if area.width < SMALLEST[0] || area.height < SMALLEST[1] {
            return None;
        }
        let row = |y: u16| Rect {
            y,
            height: 1,
            ..area
        };
        let inner = Rect {
            y: area.y + 1,
            height: area.height - 2,
            ..area
        };
        let mut layout = Self {
            panes: Vec::new(),
            status: row(area.y),
            prompt: row(area.bottom() - 1),
            rules: Vec::new(),
        };
        if pictures && area.width >= WIDE[0] && area.height >= WIDE[1] {
            layout.divide_widely(inner, view);
        } else {
            layout.divide_narrowly(inner, view);
        }
        Some(layout)
    }

    fn divide_narrowly(&mut self, inner: Rect, view: Pane) {
        let (left, right) = self.split(inner, inner.width - REGISTERS - 1);
        // The listing and the registers get the larger half.
        let upper = inner.height - (inner.height * 2 / 5).max(7);
        let ([listing, output], [registers, below]) = (stack(left, upper), stack(right, upper));
        self.panes = vec![
            (Pane::Listing, listing),
            (Pane::Registers, registers),
            (Pane::Output, output),
            (view, below),
        ];
    }

    fn divide_widely(&mut self, inner: Rect, view: Pane) {
        let pictures = (inner.width * 3 / 10).max(REGISTERS);
        let (rest, right) = self.split(inner, inner.width - pictures - 1);
        let (left, middle) = self.split(rest, rest.width - REGISTERS - 1);
        let [listing, output] = stack(left, inner.height * 3 / 5);
        let [registers, watches] = stack(middle, inner.height - (inner.height / 4).max(7));
        let [frame, below] = stack(right, inner.height / 2);
        let view = match view {
            Pane::Quad => Pane::Quad,
            _ => Pane::Texture,
        };
        self.panes = vec![
            (Pane::Listing, listing),
            (Pane::Registers, registers),
            (Pane::Frame, frame),
            (Pane::Output, output),
            (Pane::Watches, watches),
            (view, below),
        ];
    }

    fn split(&mut self, area: Rect, left: u16) -> (Rect, Rect) {
        let x = area.x + left;
        self.rules.push(Rect {
            x,
            width: 1,
            ..area
        });
        let right = Rect {
            x: x + 1,
            width: area.width - left - 1,
            ..area
        };
        (
            Rect {
                width: left,
                ..area
            },
            right,
        )
    }

    /// The place of a pane, without its heading.
    pub(super) fn body(&self, pane: Pane) -> Option<Rect> {
        let found = self.panes.iter().find(|(other, _)| *other == pane);
        found.map(|(_, area)| body(*area))
    }

    /// The pane under a cell.
    pub(super) fn at(&self, x: u16, y: u16) -> Option<Pane> {
        let found = self.panes.iter().find(|(_, a)| a.contains((x, y).into()));
        found.map(|(pane, _)| *pane)
    }

    /// The pane in the place that several share.
    pub(super) fn shared(&self) -> Option<(Pane, Rect)> {
        self.panes.last().copied()
    }

    /// The views that the shared place can show with this layout.
    pub(super) fn shares(&self) -> impl Iterator<Item = (usize, Pane)> {
        let elsewhere = |pane: &Pane| {
            let others = self
                .panes
                .split_last()
                .map_or(&[][..], |(_, others)| others);
            others.iter().any(|(other, _)| other == pane)
        };
        (VIEWS.into_iter().enumerate()).filter(move |(_, pane)| !elsewhere(pane))
    }
}

fn stack(area: Rect, upper: u16) -> [Rect; 2] {
    let lower = Rect {
        y: area.y + upper,
        height: area.height - upper,
        ..area
    };
    [
        Rect {
            height: upper,
            ..area
        },
        lower,
    ]
}

/// A pane without its heading.
pub(super) fn body(area: Rect) -> Rect {
    Rect {
        y: area.y + 1,
        height: area.height.saturating_sub(1),
        ..area
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_cell_belongs_to_one_part() {
        let sizes = (SMALLEST[0]..260)
            .step_by(7)
            .zip((SMALLEST[1]..90).step_by(3));
        let sizes = sizes.chain([(80, 24), (80, 23), (120, 40), (SMALLEST[0], SMALLEST[1])]);
        for (width, height) in sizes {
            for (view, pictures) in VIEWS.into_iter().flat_map(|v| [(v, false), (v, true)]) {
                let area = Rect::new(0, 0, width, height);
                let layout = Layout::new(area, view, pictures).unwrap();
                let panes = layout.panes.iter().map(|(_, area)| *area);
                let parts: Vec<Rect> = panes
                    .chain(layout.rules.iter().copied())
                    .chain([layout.status, layout.prompt])
                    .collect();
                for position in area.positions() {
                    let covered = parts.iter().filter(|part| part.contains(position)).count();
                    assert_eq!(covered, 1, "{position} of {width}×{height}");
                }
                assert!(
                    layout
                        .panes
                        .iter()
                        .all(|(_, a)| a.height >= 7 && a.width >= 32)
                );
                assert_eq!(layout.body(Pane::Registers).unwrap().width, REGISTERS);
            }
        }
        assert_eq!(
            Layout::new(Rect::new(0, 0, 71, 24), Pane::Frame, true),
            None
        );
        assert_eq!(
            Layout::new(Rect::new(0, 0, 80, 17), Pane::Frame, true),
            None
        );
    }

    #[test]
    fn small_screens_share_a_place() {
        let shares = |width, height, pictures| {
            let area = Rect::new(0, 0, width, height);
            let layout = Layout::new(area, Pane::Texture, pictures).unwrap();
            assert_eq!(layout.shared().unwrap().0, Pane::Texture);
            layout.shares().map(|(_, pane)| pane).collect::<Vec<_>>()
        };
        assert_eq!(shares(80, 24, true), VIEWS);
        assert_eq!(shares(120, 40, false), VIEWS);
        assert_eq!(shares(120, 40, true), [Pane::Texture, Pane::Quad]);
    }
}

//! The screens as they look, compared with files in `tests/screens`: form only. Where one differs, what is drawn is written beside
//! the file, as `NAME.actual.txt`; look at it, and rename it if it is right.

use super::*;
use ratatui::style::Color;
use std::fs;
use std::path::Path;
use texcrd::debug::{Line, Style, Text};

#[track_caller]
fn check(name: &str, buffer: &Buffer) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/screens");
    let file = folder.join(format!("{name}.txt"));
    let actual = folder.join(format!("{name}.actual.txt"));
    let (shown, expected) = (text(buffer), fs::read_to_string(&file).unwrap_or_default());
    if shown == expected {
        let _ = fs::remove_file(actual);
    } else {
        fs::write(&actual, &shown).unwrap();
        panic!(
            "{} differs from {}:\n{shown}",
            actual.display(),
            file.display()
        );
    }
}

/// What the commands answered is theirs to word: in its place stands a text of all styles, longer than a row.
fn stand_in(app: &mut App<'_>) {
    let styles = [
        Style::Strong,
        Style::Dim,
        Style::Changed,
        Style::Marked,
        Style::Remarkable,
        Style::Error,
        Style::Swatch([255, 128, 0]),
    ];
    let line = |style| Line::styled("an answer of ", style).plain("0.25, 0.125, 0.0625, 0.03125");
    app.model.output.clear();
    app.model.echo("a command");
    app.model.say(Text {
        lines: styles.into_iter().map(line).collect(),
    });
}

const VALUES: [(&str, &[f32]); 2] = [("t0", &[0.5, 1.5, -2.0]), ("c0", &[0.5, 1.0, 0.25, 1.0])];

#[test]
fn the_start() {
    let owned = Owned::new(LISTING);
    let mut app = owned.app(&VALUES);
    stand_in(&mut app);
    check("start_80x24", &drawn(&app, SMALL, Colours::True));
    check("start_120x40", &drawn(&app, LARGE, Colours::True));
}

#[test]
fn after_steps() {
    let owned = Owned::new(LISTING);
    let mut app = owned.app(&VALUES);
    keys(&mut app, ":break 9\ndisplay r0.rgb * 2\nprint r1\n\x1bccb1");
    stand_in(&mut app);
    check("steps_80x24", &drawn(&app, SMALL, Colours::True));
    check("steps_120x40", &drawn(&app, LARGE, Colours::True));
}

#[test]
fn without_colours_everything_is_said_by_characters() {
    let owned = Owned::new(LISTING);
    let mut app = owned.app(&VALUES);
    keys(&mut app, "nn");
    let (plain, deep) = (
        drawn(&app, SMALL, Colours::None),
        drawn(&app, SMALL, Colours::True),
    );
    // Swatches are fields of blanks at the ends of lines: the characters are the same.
    assert_eq!(text(&plain), text(&deep));
    let colours = |buffer: &Buffer| {
        let cells = buffer.content().iter();
        cells
            .filter(|c| c.fg != Color::Reset || c.bg != Color::Reset)
            .count()
    };
    assert_eq!(colours(&plain), 0);
    assert!(colours(&deep) > 0);

    let scene = scene();
    let rendering = rendering(&scene);
    let mut app = pixel_app(&rendering, [1, 4]);
    stand_in(&mut app);
    let plain = drawn(&app, SMALL, Colours::None);
    assert_eq!(colours(&plain), 0);
    check("frame_colourless_80x24", &plain);
}

#[test]
fn nan_is_told() {
    let owned = Owned::new(
        "vs.1.1\nrcp r0, v0.x\nsub r1, r0, r0\nmul r2, r0, r0\nsub r3, r2, r2\nmov oPos, r3\n",
    );
    let mut app = owned.app(&[("v0", &[0.0])]);
    keys(&mut app, ":until nan\n");
    stand_in(&mut app);
    check("nan_80x24", &drawn(&app, SMALL, Colours::True));
}

#[test]
fn the_help() {
    let owned = Owned::new(LISTING);
    let mut app = owned.app(&VALUES);
    stand_in(&mut app);
    keys(&mut app, "?");
    check("help_80x24", &drawn(&app, SMALL, Colours::True));
    check(
        "help_120x80",
        &drawn(&app, Rect::new(0, 0, 120, 80), Colours::True),
    );
    press(&mut app, KeyCode::End, KeyModifiers::NONE);
    let end = text(&drawn(&app, SMALL, Colours::True));
    assert!(end.contains("wheel"), "{end}");
    keys(&mut app, "\x1b");
    check("start_80x24", &drawn(&app, SMALL, Colours::True));
}

#[test]
fn there_is_too_little_room() {
    let owned = Owned::new(LISTING);
    let app = owned.app(&VALUES);
    check(
        "small_40x10",
        &drawn(&app, Rect::new(0, 0, 40, 10), Colours::True),
    );
    // Whatever the size, something is drawn and nothing panics.
    let scene = scene();
    let rendering = rendering(&scene);
    let mut pixel = pixel_app(&rendering, [3, 3]);
    keys(&mut pixel, "nn");
    for view in ['1', '2', '3', '4'] {
        keys(&mut pixel, &view.to_string());
        let edges = (0..100).step_by(11).chain([72, 112]);
        for (width, height) in edges.flat_map(|w| [(w, w / 4), (w, 30), (113, w)]) {
            let area = Rect::new(0, 0, width, height);
            let mut buffer = Buffer::empty(area);
            let theme = Theme {
                colours: Colours::Indexed,
            };
            for cell in [None, Some([9, 19])] {
                pixel.screen(theme, cell).draw(&mut buffer);
            }
        }
    }
}

#[test]
fn a_pixel_of_a_scene() {
    let scene = scene();
    let rendering = rendering(&scene);
    let mut app = pixel_app(&rendering, [1, 4]);
    stand_in(&mut app);
    check("frame_80x24", &drawn(&app, SMALL, Colours::True));
    keys(&mut app, "n3");
    stand_in(&mut app);
    check("texture_80x24", &drawn(&app, SMALL, Colours::True));
    keys(&mut app, "n4");
    stand_in(&mut app);
    check("quad_80x24", &drawn(&app, SMALL, Colours::True));
    keys(&mut app, "3");
    check("pixel_120x40", &drawn(&app, LARGE, Colours::True));
}

#[test]
fn pictures_of_real_pixels_leave_their_cells_empty() {
    let scene = scene();
    let rendering = rendering(&scene);
    let app = pixel_app(&rendering, [1, 4]);
    let mut buffer = Buffer::empty(SMALL);
    let theme = Theme {
        colours: Colours::True,
    };
    let (pictures, _) = app.screen(theme, Some([10, 20])).draw(&mut buffer);
    let [picture] = &pictures[..] else {
        panic!("{} pictures", pictures.len());
    };
    // 8:6 in the seven rows of the pane, 20 pixels each: 140 of them, and 140 · 8 / 6 across, 19 cells of 10.
    assert_eq!(picture.image.dimensions(), (186, 140));
    assert_eq!((picture.area.width, picture.area.height), (19, 7));
    for position in picture.area.positions() {
        assert_eq!(buffer[position].symbol(), " ");
    }
}

//! `include`: what several scenes share, written once.

use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

use super::error::{Problems, rules};
use super::files::Files;
use super::section::{At, Section};
use crate::diagnostic::Span;

/// Most files that a scene may include.
pub const MAX_INCLUDES: usize = 64;

/// A text whose TOML brackets nest deeper is refused before it is parsed.
pub(crate) const MAX_NESTING: usize = 64;

/// The tables that an included file may hold: those whose entries have names.
const SHARED: [&str; 3] = ["meshes", "textures", "targets"];

/// A range of a file that begins at `base` of the source map.
fn place(base: u32, range: std::ops::Range<usize>) -> Span {
    // Source maps hold less than 4 GiB, so that no offset in them is larger.
    let at = |offset: usize| base.saturating_add(offset as u32);
    Span::new(at(range.start), at(range.end))
}

/// The text of a file that begins at `base` of the source map.
pub(crate) fn utf8<'t>(bytes: &'t [u8], base: u32, problems: &mut Problems) -> Option<&'t str> {
    match std::str::from_utf8(bytes) {
        Ok(text) => Some(text),
        Err(error) => {
            let at = error.valid_up_to();
            problems.error(&rules::SYNTAX, place(base, at..at + 1), "this is not UTF-8");
            None
        }
    }
}

/// Parses a TOML file that begins at `base` of the source map. The ranges of the result are places in the map.
pub(crate) fn parse<'t>(
    bytes: &'t [u8],
    base: u32,
    problems: &mut Problems,
) -> Option<DeTable<'t>> {
    let place = |range| place(base, range);
    let text = utf8(bytes, base, problems)?;
    if nesting(text) > MAX_NESTING {
        let message = format!("brackets nest more than {MAX_NESTING} deep");
        problems.error(&rules::LIMIT, place(0..0), message);
        return None;
    }
    let (table, errors) = DeTable::parse_recoverable(text);
    let broken = !errors.is_empty();
    for error in errors {
        let range = error.span().unwrap_or(0..0);
        problems.error(&rules::SYNTAX, place(range), error.message());
    }
    if broken {
        return None;
    }
    Some(moved_table(table.into_inner(), base as usize))
}

/// How deep brackets nest at most, those in texts and comments included.
fn nesting(text: &str) -> usize {
    let (mut depth, mut most) = (0_usize, 0);
    for byte in text.bytes() {
        match byte {
            b'[' | b'{' => depth += 1,
            b']' | b'}' => depth = depth.saturating_sub(1),
            _ => {}
        }
        most = most.max(depth);
    }
    most
}

/// An included file.
pub(crate) struct Included {
    bytes: Vec<u8>,
    /// Where it begins in the source map.
    base: u32,
}

/// Reads the files that `include` names.
pub(crate) fn read(
    root: &mut Section<'_>,
    files: &mut Files<'_>,
    problems: &mut Problems,
) -> Vec<Included> {
    let Some(list) = root.at::<Vec<Spanned<String>>>("include", problems) else {
        return Vec::new();
    };
    if list.value.len() > MAX_INCLUDES {
        let message = format!("a scene includes at most {MAX_INCLUDES} files");
        problems.error(&rules::LIMIT, list.span, message);
        return Vec::new();
    }
    let mut read = |path: Spanned<String>| {
        let span = problems.span(path.span());
        let path = At {
            value: path.into_inner(),
            span,
        };
        let bytes = files.read(&path, problems)?;
        let name = files.resolver.display_name(&path.value);
        match files.sources.add(name, bytes.clone()) {
            Ok(file) => {
                let base = file.span().start;
                Some(Included { bytes, base })
            }
            Err(error) => {
                problems.error(&rules::LIMIT, path.span, error.to_string());
                None
            }
        }
    };
    list.value.into_iter().filter_map(&mut read).collect()
}

/// Adds what included files hold. Their draws come before those of the scene file.
pub(crate) fn merge<'t>(root: &mut Section<'t>, included: &'t [Included], problems: &mut Problems) {
    let mut draws = DeArray::new();
    for file in included {
        let Some(table) = parse(&file.bytes, file.base, problems) else {
            continue;
        };
        for (key, value) in table {
            let key_span = problems.span(key.span());
            let range = value.span();
            match (key.get_ref().as_ref(), value.into_inner()) {
                ("draw", DeValue::Array(list)) => {
                    list.into_iter().for_each(|draw| draws.push(draw))
                }
                (name, DeValue::Table(table)) if SHARED.contains(&name) => {
                    root.add_entries(name, table, range, problems);
                }
                (name, _) => {
                    let message = format!("an included file cannot have `{name}`");
                    let help = "it may have `meshes`, `textures`, `targets` and `draw`";
                    problems.error_with(&rules::KEY, key_span, message, Some(help.to_owned()));
                }
            }
        }
    }
    root.put_before("draw", draws);
}

fn moved<T>(value: Spanned<T>, by: usize, inner: impl FnOnce(T) -> T) -> Spanned<T> {
    let range = value.span();
    let moved = range.start.saturating_add(by)..range.end.saturating_add(by);
    Spanned::new(moved, inner(value.into_inner()))
}

fn moved_table(table: DeTable<'_>, by: usize) -> DeTable<'_> {
    (table.into_iter())
        .map(|(key, value)| {
            let key = moved(key, by, |key| key);
            (key, moved(value, by, |value| moved_value(value, by)))
        })
        .collect()
}

fn moved_value(value: DeValue<'_>, by: usize) -> DeValue<'_> {
    match value {
        DeValue::Table(table) => DeValue::Table(moved_table(table, by)),
        DeValue::Array(list) => {
            let mut moved_list = DeArray::new();
            for entry in list {
                moved_list.push(moved(entry, by, |value| moved_value(value, by)));
            }
            DeValue::Array(moved_list)
        }
        plain => plain,
    }
}

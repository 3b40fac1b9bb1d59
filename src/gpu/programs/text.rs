//! Translations as parts of one module.
//!
//! The text of a translation is taken over as it stands, but for what makes it an entry point: names that all translations
//! share get a number, bound variables are those of the batch, and `oPts`, of which a module without points makes no use, is
//! kept.

use std::fmt::Write;

/// Names at the top level of a translation that each program has for itself.
const OWN: [&str; 6] = [
    "PixelUniforms",
    "VertexUniforms",
    "Varyings",
    "VertexInput",
    "PixelOutput",
    "constant_at",
];

/// Where a bound variable of a translation is found in the module of the batch.
pub(super) struct Renamed<'a> {
    /// The name in the translation.
    pub(super) name: &'a str,
    /// What stands for it in the module.
    pub(super) instead: String,
}

/// The items of a translation: comments in front of an item belong to it.
pub(super) fn items(source: &str) -> Vec<String> {
    let mut items = Vec::new();
    let mut item = String::new();
    for line in source.lines() {
        let open = !item.is_empty();
        if !open && (line.is_empty() || line.starts_with("//")) {
            // Headings, and what a helper does.
            continue;
        }
        item.push_str(line);
        item.push('\n');
        let indented = line.starts_with([' ', '}']) && line != "}";
        if !indented && (line == "}" || line.ends_with(';')) {
            items.push(std::mem::take(&mut item));
        }
    }
    items
}

/// The item with other names, and without what only an entry point may have.
pub(super) fn embedded(item: &str, number: usize, entry: &str, renamed: &[Renamed<'_>]) -> String {
    let plain = (item.trim_start_matches("@fragment\n"))
        .trim_start_matches("@vertex\n")
        .replace("-> @location(0) vec4f", "-> vec4f");
    let mut text = String::with_capacity(plain.len() + plain.len() / 4);
    let mut member = false;
    for piece in pieces(&plain) {
        let bound = renamed.iter().find(|renamed| renamed.name == piece);
        match bound {
            // What follows a dot is a member of something else.
            _ if member => text.push_str(piece),
            Some(renamed) => text.push_str(&renamed.instead),
            None if piece == entry || OWN.contains(&piece) => {
                let _ = write!(text, "{piece}_{number}");
            }
            None => text.push_str(piece),
        }
        member = piece == ".";
    }
    text
}

/// Names, and what stands between them, a character at a time; comments as a whole.
fn pieces(text: &str) -> impl Iterator<Item = &str> {
    let mut rest = text;
    std::iter::from_fn(move || {
        let letter = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let first = rest.chars().next()?;
        let length = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if letter(first) {
            rest.find(|c| !letter(c)).unwrap_or(rest.len())
        } else {
            first.len_utf8()
        };
        let (piece, after) = rest.split_at(length);
        rest = after;
        Some(piece)
    })
}

/// The function with a statement in front of its last one, which returns the result.
pub(super) fn before_return(function: &str, statement: &str) -> String {
    let at = function.rfind("    return ").unwrap_or(function.len());
    let (before, last) = function.split_at(at);
    format!("{before}    {statement}\n{last}")
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOURCE: &str = "\
// ps.1.1 a.psh, translated by texcrd.
//
// What binds where:

struct PixelUniforms {
    c: array<vec4f, 2>, // c0, c1, …
}

@group(0) @binding(1) var<uniform> ps: PixelUniforms;
@group(1) @binding(0) var texture0: texture_2d<f32>;

struct Varyings {
    @location(0) t0: vec4f,
}

// a + b.
fn helper(a: f32) -> f32 {
    return a;
}

@fragment
fn ps_main(in: Varyings) -> @location(0) vec4f {
    // 1: ps.1.1, with ps and texture0 in a comment
    let c1 = clamp(ps.c[1], vec4f(-1.0), vec4f(1.0));

    let texture0_too = in.ps;
    if killed {
        discard;
    }
    return r0;
}
";

    #[test]
    fn items_are_what_stands_at_the_top() {
        let starts: Vec<String> = items(SOURCE)
            .iter()
            .map(|item| item.lines().next().unwrap_or_default().to_owned())
            .collect();
        assert_eq!(
            starts,
            [
                "struct PixelUniforms {",
                "@group(0) @binding(1) var<uniform> ps: PixelUniforms;",
                "@group(1) @binding(0) var texture0: texture_2d<f32>;",
                "struct Varyings {",
                "fn helper(a: f32) -> f32 {",
                "@fragment",
            ]
        );
    }

    #[test]
    fn names_change_and_nothing_else() {
        let renamed = [
            Renamed {
                name: "ps",
                instead: "blocks.p7".into(),
            },
            Renamed {
                name: "texture0",
                instead: "view3".into(),
            },
        ];
        let all = items(SOURCE);
        let function = embedded(&all[5], 7, "ps_main", &renamed);
        let function = before_return(&function, "kept = r1;");
        assert_eq!(
            function,
            "\
fn ps_main_7(in: Varyings_7) -> vec4f {
    // 1: ps.1.1, with ps and texture0 in a comment
    let c1 = clamp(blocks.p7.c[1], vec4f(-1.0), vec4f(1.0));

    let texture0_too = in.ps;
    if killed {
        discard;
    }
    kept = r1;
    return r0;
}
"
        );
        let structure = embedded(&all[0], 7, "ps_main", &renamed);
        assert!(structure.starts_with("struct PixelUniforms_7 {\n    c: array<vec4f, 2>,"));
    }
}

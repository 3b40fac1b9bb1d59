//! The listings of a draw.

use std::io;
use std::sync::Arc;

use super::error::{Problems, rules};
use super::files::Files;
use super::resolve::Resolver;
use super::section::{At, Section};
use crate::diagnostic::{Diagnostic, Rule, Span, TooLarge, any_error};
use crate::extract::{self, Text};
use crate::isa::ShaderKind;
use crate::kernel::{Kernel, Options, Plan, lower};
use crate::listing::{self, Checked};
use crate::preprocess::{self, Included};
use crate::program::Program;

/// A shader of a draw: what was written and what runs.
#[derive(Clone, Debug)]
pub struct Shader {
    /// The listing; its spans lie in the source map of the scene.
    pub program: Arc<Program>,
    /// The same, ready to run, for the texture stages of this draw.
    pub kernel: Kernel,
    /// The kernel, ready for many vertices or pixels at a time.
    pub plan: Plan,
}

/// The keys of one kind of shader in `[[draw]]`.
pub(crate) struct Keys {
    pub(crate) kind: ShaderKind,
    pub(crate) file: &'static str,
    pub(crate) text: &'static str,
    pub(crate) name: &'static str,
}

/// `vs` or `vs_text`.
pub(crate) const VERTEX: Keys = Keys {
    kind: ShaderKind::Vertex,
    file: "vs",
    text: "vs_text",
    name: "vertex shader",
};

/// `ps` or `ps_text`.
pub(crate) const PIXEL: Keys = Keys {
    kind: ShaderKind::Pixel,
    file: "ps",
    text: "ps_text",
    name: "pixel shader",
};

/// A listing of the right kind, and where the scene file names it.
pub(crate) type Named = At<Arc<Program>>;

/// Reads, parses and judges a listing. What is wrong with it is reported at its own places, once for each file.
pub(crate) fn read(
    section: &mut Section<'_>,
    keys: &Keys,
    files: &mut Files<'_>,
    problems: &mut Problems,
) -> Option<Named> {
    if !section.has(keys.file) && !section.has(keys.text) {
        let what = format!("a {}, `{}` or `{}`", keys.name, keys.file, keys.text);
        section.missing(&what, problems);
    }
    let file = section.at::<String>(keys.file, problems);
    let text = section.at::<String>(keys.text, problems);
    let (span, program) = match (file, text) {
        (Some(file), None) => (file.span, from_file(&file, files, problems)?),
        (None, Some(text)) => {
            // The places in a text are counted from its first line, so it needs a name of its own.
            let name = format!("{}, `{}`", section.title, keys.text);
            let bytes = text.value.into_bytes();
            (
                text.span,
                program("", name, bytes, text.span, files, problems)?,
            )
        }
        (Some(_), Some(text)) => {
            let message = format!("`{}` already gives the {}", keys.file, keys.name);
            problems.error(&rules::TWICE, text.span, message);
            return None;
        }
        (None, None) => return None,
    };
    if program.version.kind() == keys.kind {
        let value = program;
        return Some(At { value, span });
    }
    let message = format!(
        "this is a {} listing, where a {} must stand",
        program.version, keys.name
    );
    problems.error(&rules::SHADER, span, message);
    None
}

fn from_file(
    path: &At<String>,
    files: &mut Files<'_>,
    problems: &mut Problems,
) -> Option<Arc<Program>> {
    if let Some(known) = files.programs.get(&path.value) {
        return known.clone();
    }
    let name = files.resolver.display_name(&path.value);
    let found = files
        .read(path, problems)
        .and_then(|bytes| program(&path.value, name, bytes, path.span, files, problems));
    files.programs.insert(path.value.clone(), found.clone());
    found
}

/// Files that a listing includes, beside it.
struct Includes<'a> {
    resolver: &'a dyn Resolver,
    /// The path of the listing as the scene file writes it; empty for one in the scene file itself.
    listing: &'a str,
}

impl preprocess::Resolver for Includes<'_> {
    fn include(&self, path: &str, _: bool, from: Option<&str>) -> io::Result<Included> {
        let from = from.unwrap_or(self.listing);
        let folder = from
            .rfind(['/', '\\'])
            .map_or("", |at| from.get(..=at).unwrap_or(""));
        let path = format!("{folder}{path}");
        Ok(Included {
            name: self.resolver.display_name(&path),
            bytes: self.resolver.read(&path)?,
            path,
        })
    }
}

/// `listing`: its path, for the files that it includes.
fn program(
    listing: &str,
    name: String,
    bytes: Vec<u8>,
    span: Span,
    files: &mut Files<'_>,
    problems: &mut Problems,
) -> Option<Arc<Program>> {
    let resolver = Includes {
        resolver: files.resolver,
        listing,
    };
    let options = listing::Options {
        dialect: files.options.dialect,
        preprocess: preprocess::Options {
            definitions: &[],
            resolver: &resolver,
        },
        ..Default::default()
    };
    let checked = match only_shader(&name, bytes, &options, files) {
        Ok(checked) => checked,
        Err((rule, message)) => {
            problems.error(rule, span, message);
            return None;
        }
    };
    let accepted = checked.accepted().cloned().map(Arc::new);
    for diagnostic in checked.diagnostics {
        problems.push(diagnostic);
    }
    accepted
}

/// Reads and judges the one shader of a file: a listing, tokens, or an effect or source of C with one shader in it.
fn only_shader(
    name: &str,
    bytes: Vec<u8>,
    options: &listing::Options<'_>,
    files: &mut Files<'_>,
) -> Result<Checked, (&'static Rule, String)> {
    let told = |error: TooLarge| (&rules::LIMIT, error.to_string());
    let sources = &mut files.sources;
    let file = extract::open(sources, name, bytes, &options.preprocess).map_err(told)?;
    let [shader] = &file.shaders[..] else {
        let names = file.names().join(", ");
        let message = match file.shaders.len() {
            0 => format!("{name}: there is no shader in this file"),
            _ => format!("{name}: one shader is meant, and this file has several: {names}"),
        };
        return Err((&rules::SHADER, message));
    };
    let mut checked = extract::check(sources, shader, options).map_err(told)?;
    checked.diagnostics.splice(0..0, file.diagnostics);
    if checked.program.is_none() && !any_error(&checked.diagnostics) {
        let what = match shader.text {
            Text::Tokens(_) => "this is a vertex declaration, no shader",
            Text::Listing { .. } => "lines of it may be macros of a file that could not be read",
        };
        return Err((&rules::SHADER, format!("{name}: {what}")));
    }
    Ok(checked)
}

/// Lowers a listing for the stages of a draw.
pub(crate) fn lowered(named: &Named, options: &Options, problems: &mut Problems) -> Option<Shader> {
    match lower(&named.value, options) {
        Ok(kernel) => Some(Shader {
            program: Arc::clone(&named.value),
            plan: Plan::new(&kernel),
            kernel,
        }),
        Err(error) => {
            let place = error.span;
            let diagnostic = Diagnostic::error(&rules::SHADER, place, error.message);
            problems.push(diagnostic);
            None
        }
    }
}

//! Shaders where they live: in files of their own, in effects, in sources of C and C++, as tokens.
//!
//! [`open`] decides what a file is and finds its shaders; [`check`] reads one of them. All commands go this way.
//!
//! | file | what it looks like | its shaders |
//! | --- | --- | --- |
//! | listing | begins with a version, or is none of the others | one |
//! | tokens | see [`bytecode::recognize`] | one, or one an array |
//! | effect | has blocks `asm { … }` | one a block, named by technique, pass and state, or by variable |
//! | source of C | has strings that begin with a version, or arrays of tokens | one each, named by variable |
//!
//! Listings that were taken out of a file are texts of their own among the sources, which know where each part stands in
//! the file.

mod host;
mod repair;
mod string;

#[cfg(test)]
mod tests;

pub use repair::repair;

use crate::bytecode::{self, Declaration, Stream, StreamKind};
use crate::diagnostic::{Diagnostic, SourceFile, SourceMap, Span, TooLarge, any_error};
use crate::listing::{self, Checked};
use crate::preprocess;
use crate::preprocess::scan::Language;
use crate::rules::{model, text as text_rules};
use crate::syntax;
use std::fmt;

/// What a file is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// One listing.
    Listing,
    /// Tokens: a binary file, hexadecimal text, elements of a vertex declaration.
    Tokens(bytecode::Form),
    /// An effect.
    Effect,
    /// A source of C or C++.
    Source,
}

/// A shader of a file.
#[derive(Clone, Debug)]
pub struct Shader {
    /// What it is called: `technique/pass/state`, or its variable. Several may have the same name.
    pub name: Option<String>,
    /// Where it is.
    pub text: Text,
}

/// A shader as it stands in its file.
#[derive(Clone, Debug)]
pub enum Text {
    /// A listing.
    Listing {
        /// All of its text, which is one of the sources.
        text: Span,
        /// Whether the preprocessor has seen it, as part of its file.
        preprocessed: bool,
        /// Whether names may be missing that an included file defines which could not be read.
        names_missing: bool,
    },
    /// Tokens.
    Tokens(Stream),
}

/// A file with its shaders.
#[derive(Clone, Debug)]
pub struct File {
    /// What it is.
    pub form: Form,
    /// The whole file among the sources. Of a binary file that is its tokens as text.
    pub span: Span,
    /// Its shaders, in their order.
    pub shaders: Vec<Shader>,
    /// What the preprocessor says of an effect.
    pub diagnostics: Vec<Diagnostic>,
}

impl File {
    /// What the shaders are called, in their order: their names, those that are not the first of theirs with a number
    /// behind it (`shader#2`), and numbers from 1 for those without names.
    pub fn names(&self) -> Vec<String> {
        let mut seen: std::collections::HashMap<&str, usize> = std::collections::HashMap::new();
        let name = |(at, shader): (usize, &'_ Shader)| match shader.name.as_deref() {
            None => (at + 1).to_string(),
            Some(_) => String::new(),
        };
        let mut names: Vec<String> = self.shaders.iter().enumerate().map(name).collect();
        for (shader, name) in self.shaders.iter().zip(&mut names) {
            if let Some(own) = shader.name.as_deref() {
                let count = seen.entry(own).or_default();
                *count += 1;
                *name = match *count {
                    1 => own.to_string(),
                    n => format!("{own}#{n}"),
                };
            }
        }
        names
    }

    /// What can be picked: `1 (name), 2 (name)`.
    pub fn list(&self) -> String {
        let all = self.names().into_iter().enumerate();
        let one = |(at, name): (usize, String)| match (at + 1).to_string() {
            number if number == name => number,
            number => format!("{number} ({name})"),
        };
        all.map(one).collect::<Vec<_>>().join(", ")
    }

    /// The only shader, or the only one that `wanted` names (see [`Self::find`]).
    ///
    /// # Errors
    /// [`NotOne`] with the shaders that there are.
    pub fn one(&self, wanted: Option<&str>) -> Result<&Shader, NotOne> {
        let found = match wanted {
            Some(wanted) => self.find(wanted),
            None => (0..self.shaders.len()).collect(),
        };
        match (&found[..], wanted) {
            ([at], _) => self.shaders.get(*at).ok_or(NotOne::Nothing),
            _ if self.shaders.is_empty() => Err(NotOne::Nothing),
            ([], Some(wanted)) => Err(NotOne::Unknown {
                wanted: wanted.to_string(),
                list: self.list(),
            }),
            _ => Err(NotOne::Several { list: self.list() }),
        }
    }

    /// The numbers of the shaders that `wanted` names: by name, by the number from 1, or by the first parts of their names
    /// (`technique/pass` are all shaders of a pass, `variable` all strings of an array). Letters may be of either case if that leaves no doubt.
    pub fn find(&self, wanted: &str) -> Vec<usize> {
        let names = self.names();
        let those = |fits: &dyn Fn(&str) -> bool| -> Vec<usize> {
            let all = names.iter().enumerate();
            all.filter(|(_, name)| fits(name))
                .map(|(at, _)| at)
                .collect()
        };
        let number = wanted.parse::<usize>().ok().and_then(|n| n.checked_sub(1));
        let within = |name: &str| {
            name.strip_prefix(wanted)
                .is_some_and(|rest| rest.starts_with(['/', '[']))
        };
        let mut found = those(&|name| name == wanted);
        if found.is_empty() {
            found = number.filter(|n| *n < names.len()).into_iter().collect();
        }
        if found.is_empty() {
            found = those(&within);
        }
        if found.is_empty() {
            found = those(&|name| name.eq_ignore_ascii_case(wanted));
        }
        found
    }
}

/// Why no shader of a file is meant alone.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NotOne {
    /// The file has none.
    Nothing,
    /// Several are meant.
    Several {
        /// Those that the file has.
        list: String,
    },
    /// None is called so.
    Unknown {
        /// What was asked for.
        wanted: String,
        /// Those that the file has.
        list: String,
    },
}

impl fmt::Display for NotOne {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Nothing => write!(f, "there is no shader in this file"),
            Self::Several { list } => {
                write!(
                    f,
                    "several shaders of this file are meant: pick one of {list}"
                )
            }
            Self::Unknown { wanted, list } => {
                write!(f, "there is no shader `{wanted}`; it is one of {list}")
            }
        }
    }
}

impl std::error::Error for NotOne {}

/// Adds a file to the sources and finds its shaders.
///
/// An effect goes through the preprocessor first, whose directives may stand outside of the listings.
///
/// # Errors
/// [`TooLarge`] if it is longer than [`SourceMap::MAX_BYTES`], or its texts are more than the sources can take.
pub fn open(
    sources: &mut SourceMap,
    name: &str,
    bytes: Vec<u8>,
    options: &preprocess::Options<'_>,
) -> Result<File, TooLarge> {
    let bytes = with_line_ends(bytes);
    let (tokens, found) = recognized(&bytes);
    if let Some(form) = tokens.filter(|form| *form != bytecode::Form::Arrays) {
        let before = sources.files().len();
        let read = bytecode::read(sources, name, &bytes)?;
        let streams = read.map_or(Vec::new(), |input| input.streams);
        let span = sources
            .files()
            .get(before)
            .map_or(Span::default(), SourceFile::span);
        let shaders = streams.into_iter().map(of_stream).collect();
        return Ok(File {
            form: Form::Tokens(form),
            span,
            shaders,
            diagnostics: Vec::new(),
        });
    }
    if !found.is_empty() || tokens.is_some() {
        return of_host(sources, name, bytes, options, found);
    }
    let source = syntax::is_source(&bytes);
    let span = sources.add(name, bytes)?.span();
    if source {
        return Ok(File {
            form: Form::Source,
            span,
            shaders: Vec::new(),
            diagnostics: vec![syntax::no_shader(span.at_start())],
        });
    }
    let text = Text::Listing {
        text: span,
        preprocessed: false,
        names_missing: false,
    };
    Ok(File {
        form: Form::Listing,
        span,
        shaders: vec![Shader { name: None, text }],
        diagnostics: Vec::new(),
    })
}

/// A text whose lines end in nothing but a carriage return, as those of old Macs do, with line feeds instead; everything else
/// as it is.
fn with_line_ends(mut bytes: Vec<u8>) -> Vec<u8> {
    let text = bytes.contains(&b'\r') && !bytes.contains(&b'\n');
    if text && syntax::not_text(&bytes).is_none() {
        for byte in bytes.iter_mut().filter(|b| **b == b'\r') {
            *byte = b'\n';
        }
    }
    bytes
}

/// Says what a file is: how tokens are written in it, and the listings that stand in it among other things.
fn recognized(bytes: &[u8]) -> (Option<bytecode::Form>, Vec<host::Found>) {
    if syntax::begins_with_version(bytes) {
        return (None, Vec::new());
    }
    let tokens = bytecode::recognize(bytes);
    let host = tokens.is_none_or(|form| form == bytecode::Form::Arrays);
    let text = host && bytes.len() <= SourceMap::MAX_BYTES && syntax::not_text(bytes).is_none();
    (tokens, if text { host::scan(bytes) } else { Vec::new() })
}

/// What became of a file that was to be laid out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Layout {
    /// The file with its listings laid out.
    Done(Vec<u8>),
    /// Its listings stay as they are, and why.
    AsItIs(&'static str),
    /// It is nothing that has a layout, and why.
    Nothing(&'static str),
}

/// Lays out the listing, or the blocks of an effect, as [`syntax::format`] does.
pub fn format(bytes: &[u8]) -> Layout {
    let bytes = &with_line_ends(bytes.to_vec())[..];
    let (tokens, found) = recognized(bytes);
    if found.is_empty() {
        return match tokens {
            Some(_) => Layout::Nothing("these are tokens; `dis` makes a listing of them"),
            None if bytes.len() > SourceMap::MAX_BYTES => {
                Layout::Nothing("this is longer than a listing can be")
            }
            None if syntax::not_text(bytes).is_some() => Layout::Nothing("this is no listing"),
            None if syntax::is_source(bytes) => Layout::Nothing("no listing stands in it"),
            None => Layout::Done(syntax::format(bytes)),
        };
    }
    let blocks: Vec<Span> = found.iter().filter_map(host::Found::block).collect();
    if blocks.is_empty() {
        return Layout::AsItIs("its listings stand in strings, which are left as they are");
    }
    let mut text = Vec::with_capacity(bytes.len());
    let mut done = 0;
    for block in blocks {
        let (start, end) = (block.start as usize, block.end as usize);
        text.extend_from_slice(bytes.get(done..start).unwrap_or(&[]));
        text.extend(syntax::format_block(bytes.get(start..end).unwrap_or(&[])));
        done = end;
    }
    text.extend_from_slice(bytes.get(done..).unwrap_or(&[]));
    Layout::Done(text)
}

fn of_stream(stream: Stream) -> Shader {
    Shader {
        name: stream.name.clone(),
        text: Text::Tokens(stream),
    }
}

/// The shaders of a file in which there are some.
fn of_host(
    sources: &mut SourceMap,
    name: &str,
    bytes: Vec<u8>,
    options: &preprocess::Options<'_>,
    mut found: Vec<host::Found>,
) -> Result<File, TooLarge> {
    let effect = found.iter().any(|f| f.block().is_some());
    let needed = effect && preprocess::is_needed(&bytes, options);
    let streams = bytecode::read(sources, name, &bytes)?.map_or(Vec::new(), |input| input.streams);
    let span = match streams.is_empty() {
        // It has not been added.
        true => sources.add(name, bytes)?.span(),
        false => sources
            .files()
            .last()
            .map_or(Span::default(), SourceFile::span),
    };
    let (mut base, mut diagnostics, mut names_missing) = (span.start, Vec::new(), false);
    if needed {
        let preprocessed = preprocess::run(sources, span, options, Language::Host);
        diagnostics = preprocessed.diagnostics;
        names_missing = !preprocessed.lost.is_empty();
        let text = preprocessed
            .text
            .and_then(|text| sources.file_of(text.start));
        found = text.map_or(Vec::new(), |text| host::scan(text.bytes()));
        base = text.map_or(base, |text| text.span().start);
    }
    let mut shaders = Vec::new();
    for one in found {
        let (text, derivation) = one.taken_out(base, sources);
        let text = sources.add_derived(name, text, derivation)?.span();
        let text = Text::Listing {
            text,
            preprocessed: needed,
            names_missing,
        };
        shaders.push(Shader {
            name: one.name,
            text,
        });
    }
    shaders.extend(streams.into_iter().map(of_stream));
    let start = |shader: &Shader| match &shader.text {
        Text::Listing { text, .. } => sources.written(text.at_start()).start,
        Text::Tokens(stream) => stream.place(Span::new(0, 1)).start,
    };
    shaders.sort_by_key(start);
    leave_out_later(sources, &mut shaders, &mut diagnostics);
    let form = if effect { Form::Effect } else { Form::Source };
    Ok(File {
        form,
        span,
        shaders,
        diagnostics,
    })
}

/// Takes away the shaders of later models if there are others: files of the time hold a shader for each generation of
/// hardware.
fn leave_out_later(
    sources: &SourceMap,
    shaders: &mut Vec<Shader>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let all: Vec<_> = shaders.iter().map(|s| of_later_model(sources, s)).collect();
    if all.iter().all(Option::is_some) {
        return;
    }
    let mut one = all.iter();
    shaders.retain(|_| one.next().is_none_or(Option::is_none));
    diagnostics.extend(all.into_iter().flatten());
}

/// What is said of a shader that is left out because it is of a later model.
fn of_later_model(sources: &SourceMap, shader: &Shader) -> Option<Diagnostic> {
    const HELP: &str = "the others are read; Direct3D 8 has vs.1.0, vs.1.1 and ps.1.0 to ps.1.4";
    match &shader.text {
        Text::Listing { text, .. } => {
            let version = syntax::later_model(sources.bytes(*text))?;
            let span = Span::new(text.start + version.start, text.start + version.end);
            let name = sources.text(span);
            let message = format!("`{name}` begins a shader of a later model, which is left out");
            Some(Diagnostic::warning(&text_rules::VERSION_UNKNOWN, span, message).with_help(HELP))
        }
        Text::Tokens(stream) => {
            let word = *stream.words.first()?;
            let later = word >= 0xFFFE_0000 && matches!(word >> 8 & 0xFF, 2..=5);
            let message =
                format!("0x{word:08X} begins a shader of a later model, which is left out");
            let report = Diagnostic::warning(&model::S13, Span::new(0, 1), message);
            stream
                .placed(vec![report.with_help(HELP)])
                .pop()
                .filter(|_| later)
        }
    }
}

/// Reads a shader of a file: its text, or its tokens by way of their listing, which is added to the sources.
///
/// # Errors
/// [`TooLarge`] if the sources cannot take the listing.
pub fn check(
    sources: &mut SourceMap,
    shader: &Shader,
    options: &listing::Options<'_>,
) -> Result<Checked, TooLarge> {
    let stream = match &shader.text {
        Text::Listing {
            text,
            preprocessed,
            names_missing,
        } => {
            let mut options = *options;
            options.names_missing |= names_missing;
            if *preprocessed {
                options.preprocess = preprocess::Options::default();
            }
            return Ok(listing::read(sources, *text, &options));
        }
        Text::Tokens(stream) => stream,
    };
    let made = bytecode::disassemble(stream, None, sources)?;
    let mut checked = Checked {
        program: None,
        diagnostics: made.diagnostics,
    };
    if any_error(&checked.diagnostics) {
        return Ok(checked);
    }
    match stream.kind {
        StreamKind::Declaration if !options.unchecked => {
            let (declaration, _) = Declaration::decode(&stream.words);
            checked
                .diagnostics
                .extend(stream.placed(declaration.check()));
        }
        StreamKind::Declaration => {}
        StreamKind::Shader => {
            if let Some(file) = sources.files().last() {
                let of_listing = listing::check_around(file, options, &[]);
                checked.program = of_listing.program;
                checked.diagnostics.extend(of_listing.diagnostics);
            }
        }
    }
    Ok(checked)
}

//! What is known of a document: its shaders, what is wrong with them, and where everything stands.

use super::documents::{Document, Documents};
use super::settings::Settings;
use super::text::{Encoding, Lines, Range as Places};
use super::uri;
use std::cell::{OnceCell, RefCell};
use std::collections::HashMap;
use std::io;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use texcrd::diagnostic::{Diagnostic, SourceFile, SourceMap, Span};
use texcrd::extract::{self, Form, Text};
use texcrd::listing;
use texcrd::preprocess::{self, Folders, Included, Resolver};
use texcrd::program::Program;
use texcrd::validate::{self, Use};

/// The client's name of the language of listings.
const LANGUAGE: &str = "d3d8asm";
/// How files of listings are named.
const LISTINGS: [&str; 6] = ["vsh", "psh", "vsa", "psa", "nvv", "nvp"];
/// Languages that clients give to files of which they know nothing.
const LOOSE: [&str; 5] = ["", "text", "plaintext", "asm", "asm_x86_64"];

/// What documents are looked at with.
pub(super) struct World<'a> {
    pub documents: &'a Documents,
    pub settings: &'a Settings,
    /// The folder of the workspace.
    pub folder: Option<&'a Path>,
}

/// A shader of a document.
pub(super) struct Shader {
    /// Its name, or its number in the file.
    pub name: String,
    /// As far as it could be read.
    pub program: Option<Program>,
    /// Where it stands in the document.
    pub region: Range<usize>,
    /// Whether it is a listing, and not tokens.
    pub listing: bool,
    uses: OnceCell<Vec<Use>>,
}

impl Shader {
    /// The uses of its registers.
    pub(super) fn uses(&self) -> &[Use] {
        let uses = || {
            self.program
                .as_ref()
                .filter(|_| self.listing)
                .map(validate::uses)
        };
        self.uses.get_or_init(|| uses().unwrap_or_default())
    }
}

/// A document, read.
pub(super) struct Analysis {
    pub sources: SourceMap,
    pub form: Form,
    pub shaders: Vec<Shader>,
    pub diagnostics: Vec<Diagnostic>,
    /// Why it could not be read at all.
    pub problem: Option<String>,
    /// Whether it is one that this server should speak of.
    pub ours: bool,
    /// Addresses of the files that it includes, by the names they have in the sources.
    pub included: HashMap<String, String>,
    /// Whether it tries to include something.
    pub includes: bool,
    uri: String,
    /// The document's text among the sources; empty if that is another, as of tokens.
    root: Span,
    encoding: Encoding,
    lines: RefCell<HashMap<u32, Rc<Lines>>>,
}

/// Gives included files, and keeps which they were.
struct Files<'a> {
    world: &'a World<'a>,
    file: &'a str,
    folders: Vec<PathBuf>,
    included: RefCell<HashMap<String, String>>,
    tried: std::cell::Cell<bool>,
}

impl Resolver for Files<'_> {
    fn include(&self, path: &str, angled: bool, from: Option<&str>) -> io::Result<Included> {
        self.tried.set(true);
        let open = |path: &Path| {
            let document = self.world.documents.at(path)?;
            Some(document.text.clone().into_bytes())
        };
        let folders = Folders {
            file: self.file,
            folders: &self.folders,
        };
        let found = folders.include_beside(path, angled, from, &open)?;
        let place = uri::plain(Path::new(&found.path));
        let open = self.world.documents.at(&place);
        let address = open.map_or_else(|| uri::of_path(&place), |document| document.uri.clone());
        self.included
            .borrow_mut()
            .insert(found.name.clone(), address);
        Ok(found)
    }
}

impl<'a> World<'a> {
    fn files(&'a self, file: &'a str) -> Files<'a> {
        let folder = self.folder.unwrap_or(Path::new(""));
        let folders = self.settings.includes.iter().map(|i| folder.join(i));
        Files {
            world: self,
            file,
            folders: folders.collect(),
            included: RefCell::default(),
            tried: std::cell::Cell::new(false),
        }
    }

    /// Where the files of a document are looked for from: it, or a file of the workspace if it is none itself.
    fn place(&self, document: &Document) -> String {
        let unnamed = || self.folder.map(|folder| folder.join("untitled"));
        let path = document.path.clone().or_else(unnamed).unwrap_or_default();
        path.display().to_string()
    }

    /// The address of a file that a document includes.
    pub(super) fn included(&self, document: &Document, path: &str, angled: bool) -> Option<String> {
        let place = self.place(document);
        let files = self.files(&place);
        files.include(path, angled, None).ok()?;
        files.included.into_inner().into_values().next()
    }

    /// Reads a document.
    pub(super) fn analyse(&self, document: &Document) -> Analysis {
        let place = self.place(document);
        let files = self.files(&place);
        let options = listing::Options {
            dialect: self.settings.dialect,
            preprocess: preprocess::Options {
                definitions: &self.settings.defines,
                resolver: &files,
            },
            ..Default::default()
        };
        let mut analysis = Analysis::empty(document);
        if let Err(error) = analysis.read(document, &options) {
            analysis.problem = Some(error.to_string());
        }
        analysis.ours = analysis.is_ours(document);
        analysis.includes = files.tried.get();
        analysis.included = files.included.into_inner();
        analysis
    }

    /// The text of a document with every certain repair.
    pub(super) fn repaired(&self, document: &Document) -> Option<Vec<u8>> {
        let place = self.place(document);
        let files = self.files(&place);
        let options = listing::Options {
            dialect: self.settings.dialect,
            unchecked: true,
            preprocess: preprocess::Options {
                definitions: &self.settings.defines,
                resolver: &files,
            },
            ..Default::default()
        };
        let read = |sources: &mut SourceMap, bytes: Vec<u8>| {
            let file = extract::open(sources, &document.name(), bytes, &options.preprocess)?;
            let mut found = file.diagnostics.clone();
            for shader in &file.shaders {
                found.extend(extract::check(sources, shader, &options)?.diagnostics);
            }
            Ok::<_, texcrd::diagnostic::TooLarge>((file, found))
        };
        let (bytes, count) = extract::repair(document.text.clone().into_bytes(), read).ok()?;
        (count > 0).then_some(bytes)
    }
}

impl Analysis {
    fn empty(document: &Document) -> Self {
        Self {
            sources: SourceMap::new(),
            form: Form::Listing,
            shaders: Vec::new(),
            diagnostics: Vec::new(),
            problem: None,
            ours: false,
            included: HashMap::new(),
            includes: false,
            uri: document.uri.clone(),
            root: Span::default(),
            encoding: Encoding::default(),
            lines: RefCell::default(),
        }
    }

    fn read(
        &mut self,
        document: &Document,
        options: &listing::Options<'_>,
    ) -> Result<(), texcrd::diagnostic::TooLarge> {
        self.encoding = document.lines.encoding();
        let (sources, bytes) = (&mut self.sources, document.text.clone().into_bytes());
        let file = extract::open(sources, &document.name(), bytes, &options.preprocess)?;
        self.form = file.form;
        let own = sources.file_of(file.span.start);
        if own.is_some_and(|own| own.bytes() == document.text.as_bytes()) {
            self.root = file.span;
            let lines = Rc::new(document.lines.clone());
            self.lines.get_mut().insert(file.span.start, lines);
        }
        self.diagnostics = file.diagnostics.clone();
        for (shader, name) in file.shaders.iter().zip(file.names()) {
            let checked = extract::check(sources, shader, options)?;
            // Files that several shaders share are told of once.
            for diagnostic in checked.diagnostics {
                if !self.diagnostics.contains(&diagnostic) {
                    self.diagnostics.push(diagnostic);
                }
            }
            let (region, listing) = match &shader.text {
                _ if file.form == Form::Listing => (file.span, true),
                Text::Listing { text, .. } => {
                    let end = |span| sources.written(span);
                    (end(text.at_start()).to(end(text.at_end())), true)
                }
                Text::Tokens(stream) => {
                    let last = stream.words.len().max(1) as u32;
                    (stream.place(Span::new(0, last)), false)
                }
            };
            let base = file.span.start;
            let region = region.start.saturating_sub(base) as usize
                ..region.end.saturating_sub(base) as usize;
            self.shaders.push(Shader {
                name,
                program: checked.program,
                region: region.start..region.end.min(document.text.len()).max(region.start),
                listing,
                uses: OnceCell::new(),
            });
        }
        Ok(())
    }

    /// Whether anything should be said of a document: files of other languages are left alone unless shaders are in them.
    fn is_ours(&self, document: &Document) -> bool {
        let named = LISTINGS.contains(&document.extension().as_str());
        let loose = LOOSE.contains(&document.language.as_str());
        let certain = document.language == LANGUAGE || (named && loose);
        let has_version = |shader: &Shader| shader.program.is_some();
        match self.form {
            Form::Listing => certain || self.shaders.iter().any(has_version),
            Form::Effect | Form::Source => !self.shaders.is_empty(),
            Form::Tokens(_) => certain,
        }
    }

    /// The shader that stands at a byte of the document.
    pub(super) fn shader_at(&self, offset: usize) -> Option<&Shader> {
        let holds = |shader: &&Shader| shader.region.start <= offset && offset <= shader.region.end;
        self.shaders.iter().find(holds)
    }

    /// Whether listings stand in strings here.
    pub(super) fn in_strings(&self) -> bool {
        self.form == Form::Source
    }

    /// Where in the document a span was written; `None` if that is another text.
    pub(super) fn written(&self, span: Span) -> Option<Range<usize>> {
        self.in_root(self.sources.written(span))
    }

    /// Where in the document the text of a span can be changed.
    pub(super) fn editable(&self, span: Span) -> Option<Range<usize>> {
        self.in_root(self.sources.editable(span)?)
    }

    fn in_root(&self, span: Span) -> Option<Range<usize>> {
        let within = self.root.start <= span.start && span.end <= self.root.end;
        let start = span.start.checked_sub(self.root.start)? as usize;
        let length = span.end.saturating_sub(span.start) as usize;
        (within && self.root.end > self.root.start).then_some(start..start + length)
    }

    /// The span of a range of the document.
    pub(super) fn span(&self, range: &Range<usize>) -> Span {
        let base = self.root.start;
        Span::new(base + range.start as u32, base + range.end as u32)
    }

    /// Where a span was written: the address of the text, and the place in it. `None` if that is no file.
    pub(super) fn place(&self, span: Span) -> Option<(String, Places)> {
        let span = self.sources.written(span);
        let file = self.sources.file_of(span.start)?;
        let address = match file.span().start == self.root.start {
            true => self.uri.clone(),
            false => self.included.get(file.name())?.clone(),
        };
        let base = file.span().start as usize;
        let range = (span.start as usize - base)..(span.end.max(span.start) as usize - base);
        Some((address, self.lines_of(file).range(file.bytes(), &range)))
    }

    fn lines_of(&self, file: &SourceFile) -> Rc<Lines> {
        let mut lines = self.lines.borrow_mut();
        let new = || Rc::new(Lines::new(file.bytes(), self.encoding));
        Rc::clone(lines.entry(file.span().start).or_insert_with(new))
    }

    /// The texts that people wrote: the document, and those that it includes.
    pub(super) fn texts(&self) -> impl Iterator<Item = &SourceFile> {
        let known = |file: &&SourceFile| {
            file.span().start == self.root.start || self.included.contains_key(file.name())
        };
        self.sources.files().iter().filter(known)
    }

    /// The document's own text among [`Self::texts`].
    pub(super) fn is_root(&self, file: &SourceFile) -> bool {
        file.span().start == self.root.start
    }
}

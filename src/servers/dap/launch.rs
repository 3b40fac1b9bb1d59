//! From launch arguments to something that a session can be about.

use super::Tools;
use super::client::Client;
use super::protocol::{Category, Event, LaunchArguments, Output, Refusal};
use super::sources::Sources;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use texcrd::debug::{
    Given, Listing, ListingSubject, PixelSubject, Session, Subject, VertexSubject, Which,
};
use texcrd::diagnostic::{Diagnostic, Severity, SourceMap, any_error};
use texcrd::extract::{self, NotOne};
use texcrd::kernel::{self, Kernel};
use texcrd::listing;
use texcrd::policy::{Dialect, Model, Policies};
use texcrd::preprocess::{self, Definition, Folders};
use texcrd::program::Program;
use texcrd::scene::{DirectoryResolver, LoadOptions, RenderOptions, Scene};

/// The most diagnostics that are told of one program.
const MOST_TOLD: usize = 100;

/// A program that was read, with everything that a session borrows from.
pub(super) struct Loaded {
    /// What it was asked for with.
    pub arguments: LaunchArguments,
    what: What,
}

enum What {
    Listing(Box<ByHand>),
    Scene(Box<Scene>),
}

/// A listing with the values that it is run with.
struct ByHand {
    sources: SourceMap,
    /// What is allowed and yet worth telling.
    warnings: Vec<Diagnostic>,
    program: Program,
    kernel: Kernel,
    given: Given,
}

/// Why a program cannot be debugged.
pub(super) struct Problem {
    /// In one line.
    pub refusal: Refusal,
    /// In full: the texts, and what is wrong with them.
    pub diagnostics: Option<(SourceMap, Vec<Diagnostic>)>,
}

impl From<String> for Problem {
    fn from(message: String) -> Self {
        Self {
            refusal: Refusal::launch(message),
            diagnostics: None,
        }
    }
}

impl Problem {
    /// What is wrong with the texts, as events.
    pub(super) fn events(&self, client: &Client, tools: Tools) -> Vec<Event> {
        let (sources, diagnostics) = match &self.diagnostics {
            Some((sources, diagnostics)) => (sources, diagnostics.as_slice()),
            None => return Vec::new(),
        };
        told(sources, diagnostics, client, tools)
    }
}

impl Loaded {
    /// Reads what the arguments name.
    ///
    /// # Errors
    /// [`Problem`].
    pub(super) fn new(arguments: LaunchArguments) -> Result<Self, Problem> {
        let path = path(&arguments);
        let dialect = match &arguments.dialect {
            Some(name) => name.parse().map_err(|e| format!("dialect: {e}"))?,
            None => Dialect::default(),
        };
        let model = match &arguments.model {
            Some(name) => name.parse().map_err(|e| format!("model: {e}"))?,
            None => Model::default(),
        };
        let mut policies = Policies::default();
        for (name, value) in arguments.policies.iter().flatten() {
            let set = policies.set(&format!("{name}={value}"));
            set.map_err(|e| format!("policies: {e}"))?;
        }
        let options = LoadOptions {
            dialect,
            model,
            policies,
        };
        match is_scene(&path) {
            true => Self::scene(arguments, &path, &options),
            false => Self::listing(arguments, &path, &options),
        }
    }

    fn scene(
        arguments: LaunchArguments,
        path: &Path,
        options: &LoadOptions,
    ) -> Result<Self, Problem> {
        let name = path.display().to_string();
        let one = match (arguments.pixel, arguments.vertex) {
            (Some(_), None) => Ok(()),
            (None, Some(_)) if arguments.primitive.is_some() => Err("a vertex has no `primitive`"),
            (None, Some(_)) => Ok(()),
            (None, None) => Err("say which `pixel` or which `vertex` of the scene is debugged"),
            (Some(_), Some(_)) => Err("give a `pixel` or a `vertex`, not both"),
        };
        one.map_err(|why| format!("{name}: {why}"))?;
        let of_listings = [
            ("set", arguments.set.as_ref().is_some_and(|s| !s.is_empty())),
            ("shader", arguments.shader.is_some()),
            ("defines", arguments.defines.is_some()),
            ("includes", arguments.includes.is_some()),
        ];
        if let Some((argument, _)) = of_listings.into_iter().find(|(_, given)| *given) {
            let why = format!("{name}: `{argument}` is for listings; a scene has its own values");
            return Err(why.into());
        }
        let folder = path.parent().unwrap_or(Path::new(""));
        let resolver = DirectoryResolver::new(folder);
        let scene = Scene::load(&name, &read(path)?, &resolver, options);
        let scene = scene.map_err(|error| refused(&name, error.sources, error.diagnostics))?;
        Ok(Self {
            arguments,
            what: What::Scene(Box::new(scene)),
        })
    }

    fn listing(
        arguments: LaunchArguments,
        path: &Path,
        loading: &LoadOptions,
    ) -> Result<Self, Problem> {
        let of_scenes = [
            ("pixel", arguments.pixel.is_some()),
            ("vertex", arguments.vertex.is_some()),
            ("draw", arguments.draw.is_some()),
            ("primitive", arguments.primitive.is_some()),
            ("size", arguments.size.is_some()),
        ];
        if let Some((name, _)) = of_scenes.into_iter().find(|(_, given)| *given) {
            let message = format!("{}: a listing has no `{name}`, a scene has", path.display());
            return Err(message.into());
        }
        let name = path.display().to_string();
        let mut sources = SourceMap::new();
        let (program, warnings) = shader(
            &arguments,
            &name,
            read(path)?,
            loading.dialect,
            &mut sources,
        )
        .map_err(|why| match why {
            Refused::Words(why) => format!("{name}: {why}").into(),
            Refused::Diagnostics(found) => refused(&name, std::mem::take(&mut sources), found),
        })?;
        let options = kernel::Options {
            model: loading.model,
            policies: loading.policies,
            ..kernel::Options::default()
        };
        let kernel =
            kernel::lower(&program, &options).map_err(|error| format!("{name}: {error}"))?;
        let mut given = Given::default();
        for (register, numbers) in arguments.set.iter().flatten() {
            (given.set(program.version, register, numbers.list()))
                .map_err(|error| format!("set {register}: {error}"))?;
        }
        Ok(Self {
            arguments,
            what: What::Listing(Box::new(ByHand {
                sources,
                warnings,
                program,
                kernel,
                given,
            })),
        })
    }

    /// The texts.
    pub(super) fn sources(&self) -> &SourceMap {
        match &self.what {
            What::Listing(by_hand) => &by_hand.sources,
            What::Scene(scene) => scene.sources(),
        }
    }

    /// What is allowed and yet worth telling, as events.
    pub(super) fn warnings(&self, client: &Client, tools: Tools) -> Vec<Event> {
        let warnings = match &self.what {
            What::Listing(by_hand) => &by_hand.warnings,
            What::Scene(scene) => scene.warnings(),
        };
        told(self.sources(), warnings, client, tools)
    }

    /// Records the program and hands the session to `use_it`.
    ///
    /// # Errors
    /// [`Problem`] if there is nothing to record.
    pub(super) fn open<T>(&self, use_it: impl FnOnce(Session<'_>) -> T) -> Result<T, Problem> {
        match &self.what {
            What::Listing(by_hand) => {
                let listing = Listing {
                    program: &by_hand.program,
                    kernel: &by_hand.kernel,
                    sources: &by_hand.sources,
                };
                let given = by_hand.given.clone();
                let subject = Subject::Listing(ListingSubject { listing, given });
                Ok(use_it(Session::new(subject)))
            }
            What::Scene(scene) => {
                let LaunchArguments {
                    pixel,
                    vertex,
                    draw,
                    primitive,
                    size,
                    ..
                } = &self.arguments;
                let options = RenderOptions {
                    size: *size,
                    show: None,
                };
                let rendering = scene.rendering(&options, &|_| ());
                let rendering = rendering.map_err(|error| self.failed(&error))?;
                let which = Which {
                    draw: draw.clone(),
                    primitive: *primitive,
                };
                let subject = match (pixel, vertex) {
                    (Some(pixel), _) => {
                        PixelSubject::new(&rendering, *pixel, &which).map(Subject::Pixel)
                    }
                    (None, vertex) => {
                        let vertex = vertex.unwrap_or_default();
                        VertexSubject::new(&rendering, vertex, draw.as_deref()).map(Subject::Vertex)
                    }
                };
                let subject = subject.map_err(|error| self.failed(&error))?;
                Ok(use_it(Session::new(subject)))
            }
        }
    }
}

impl Loaded {
    /// Why there is nothing to debug, with what was asked for.
    fn failed(&self, error: &dyn std::error::Error) -> String {
        let program = &self.arguments.program;
        match &self.arguments.draw {
            Some(draw) => format!("{program}, draw `{draw}`: {error}"),
            None => format!("{program}: {error}"),
        }
    }
}

/// Why a file gives no shader to debug.
enum Refused {
    Words(String),
    Diagnostics(Vec<Diagnostic>),
}

/// The shader of a file that is meant, and what is worth telling of it.
fn shader(
    arguments: &LaunchArguments,
    name: &str,
    bytes: Vec<u8>,
    dialect: Dialect,
    sources: &mut SourceMap,
) -> Result<(Program, Vec<Diagnostic>), Refused> {
    let words = |why: &dyn std::error::Error| Refused::Words(why.to_string());
    let cwd = Path::new(arguments.cwd.as_deref().unwrap_or_default());
    let folders = arguments.includes.iter().flatten();
    let folders: Vec<PathBuf> = folders.map(|folder| cwd.join(folder)).collect();
    let definitions = arguments.defines.iter().flatten();
    let definitions: Result<Vec<Definition>, _> = definitions.map(|text| text.parse()).collect();
    let options = listing::Options {
        dialect,
        preprocess: preprocess::Options {
            definitions: &definitions.map_err(|why| words(&why))?,
            resolver: &Folders {
                file: name,
                folders: &folders,
            },
        },
        ..Default::default()
    };
    let file = extract::open(sources, name, bytes, &options.preprocess);
    let file = file.map_err(|why| words(&why))?;
    let shader = match file.one(arguments.shader.as_deref()) {
        Ok(shader) => shader,
        Err(NotOne::Nothing) if any_error(&file.diagnostics) => {
            return Err(Refused::Diagnostics(file.diagnostics));
        }
        Err(why) => return Err(words(&why)),
    };
    let checked = extract::check(sources, shader, &options).map_err(|why| words(&why))?;
    let accepted = checked.accepted().cloned();
    let mut found = file.diagnostics;
    found.extend(checked.diagnostics);
    match accepted {
        Some(program) if !any_error(&found) => Ok((program, found)),
        _ => Err(Refused::Diagnostics(found)),
    }
}

/// Where the program lies.
fn path(arguments: &LaunchArguments) -> PathBuf {
    let folder = arguments.cwd.as_deref().unwrap_or_default();
    Path::new(folder).join(&arguments.program)
}

/// Scenes are told from listings by their ending.
fn is_scene(path: &Path) -> bool {
    let ending = path.extension().unwrap_or_default();
    ending.eq_ignore_ascii_case("toml")
}

/// Reads a file. Of one that is longer than any listing only so much is read as shows that it is.
fn read(path: &Path) -> Result<Vec<u8>, String> {
    let most = SourceMap::MAX_BYTES as u64 + 1;
    let mut bytes = Vec::new();
    let read = File::open(path).and_then(|file| file.take(most).read_to_end(&mut bytes));
    match read {
        Ok(_) => Ok(bytes),
        Err(error) => Err(format!("{}: {error}", path.display())),
    }
}

/// A text is refused for what is wrong with it; the first error stands for all.
fn refused(name: &str, sources: SourceMap, diagnostics: Vec<Diagnostic>) -> Problem {
    let first = diagnostics.iter().find(|d| d.severity == Severity::Error);
    let why = first.map_or_else(
        || format!("{name}: there is no shader in it"),
        |error| {
            let line = sources.locate(error.span).map_or(0, |at| at.line);
            let file = sources.file_of(error.span.start);
            let file = file.map_or(name, |file| file.name());
            format!("{file}:{line}: {}", error.message)
        },
    );
    Problem {
        refusal: Refusal::launch(why),
        diagnostics: Some((sources, diagnostics)),
    }
}

/// Diagnostics as output that leads to their places.
fn told(map: &SourceMap, diagnostics: &[Diagnostic], client: &Client, tools: Tools) -> Vec<Event> {
    let sources = Sources::new(map);
    let tell = |diagnostic: &Diagnostic| {
        let range = sources.range(diagnostic.span, client);
        let category = match diagnostic.severity {
            Severity::Error => Category::Stderr,
            Severity::Warning => Category::Console,
        };
        let output = Output {
            category,
            output: (tools.rendered)(map, diagnostic, client.colours),
            source: sources.source(diagnostic.span),
            line: Some(range.line),
            column: Some(range.column),
        };
        Event::new("output", &output)
    };
    let mut events: Vec<Event> = diagnostics.iter().take(MOST_TOLD).map(tell).collect();
    if diagnostics.len() > MOST_TOLD {
        let text = format!("and {} more\n", diagnostics.len() - MOST_TOLD);
        events.push(Event::output(Category::Console, text));
    }
    events
}

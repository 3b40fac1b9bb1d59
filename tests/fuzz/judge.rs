//! What every input must survive: read, judged, repaired, laid out, written, run and translated, whatever it is.
//!
//! A panic is a finding, and so is what the assertions say: of valid streams and of accepted listings the round trips are
//! exact, and what is said of an input points into it.

use std::io;
use texcrd::bytecode::{self, Declaration, Stream};
use texcrd::diagnostic::{Diagnostic, SourceMap, Span};
use texcrd::exec::{Environment, Machine, bind_constants};
use texcrd::extract::{self, Layout, Text};
use texcrd::kernel::{self, Slot};
use texcrd::policy::Dialect;
use texcrd::preprocess::{self, Included, Resolver};
use texcrd::program::Program;
use texcrd::{listing, syntax, validate, wgsl};

/// How far inputs got.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Seen {
    /// Shaders that were found, each once a dialect.
    pub shaders: usize,
    /// Those that nothing refuses.
    pub accepted: usize,
    /// Streams of which nothing is said.
    pub valid: usize,
}

impl Seen {
    /// Adds what another input did.
    pub fn add(&mut self, other: Self) {
        self.shaders += other.shaders;
        self.accepted += other.accepted;
        self.valid += other.valid;
    }
}

/// What included files hold; `self.h` runs in a circle.
struct Headers;

impl Resolver for Headers {
    fn include(&self, path: &str, _: bool, _: Option<&str>) -> io::Result<Included> {
        let text = match path {
            "own.h" => "#define OWN c1\ndef c2, 1, 2, 3, 4\n",
            "self.h" => "#include \"self.h\"\n",
            _ => return Err(io::ErrorKind::NotFound.into()),
        };
        Ok(Included {
            path: path.to_string(),
            name: path.to_string(),
            bytes: text.as_bytes().to_vec(),
        })
    }
}

/// A file of whatever, in every dialect.
pub fn file(bytes: &[u8]) -> Seen {
    let mut seen = Seen::default();
    for dialect in Dialect::all() {
        seen.add(file_in(bytes, dialect));
    }
    laid_out(bytes);
    seen
}

fn file_in(bytes: &[u8], dialect: Dialect) -> Seen {
    let mut seen = Seen::default();
    let mut sources = SourceMap::new();
    let preprocess = preprocess::Options {
        definitions: &[],
        resolver: &Headers,
    };
    let Ok(file) = extract::open(&mut sources, "file", bytes.to_vec(), &preprocess) else {
        assert!(
            bytes.len() > SourceMap::MAX_BYTES / 2,
            "a short file is not too large"
        );
        return seen;
    };
    points_into(&sources, &file.diagnostics);
    let options = listing::Options {
        dialect,
        preprocess,
        ..Default::default()
    };
    let mut all = file.diagnostics.clone();
    for shader in &file.shaders {
        let Ok(checked) = extract::check(&mut sources, shader, &options) else {
            continue;
        };
        points_into(&sources, &checked.diagnostics);
        seen.shaders += 1;
        if let Some(program) = checked.accepted() {
            seen.accepted += 1;
            accepted(program, &sources, dialect);
        } else if let Some(program) = &checked.program {
            refused(program);
        }
        if let Text::Tokens(stream) = &shader.text {
            seen.valid += usize::from(words(&stream.words));
        }
        all.extend(checked.diagnostics);
    }
    if let Some(written) = sources.file_of(file.span.start) {
        syntax::apply_fixes(&sources, written, &all);
    }
    seen
}

/// Every place that is named lies in one of the texts.
fn points_into(sources: &SourceMap, diagnostics: &[Diagnostic]) {
    for diagnostic in diagnostics {
        let fix = diagnostic.fix.iter().map(|fix| fix.span);
        for span in std::iter::once(diagnostic.span).chain(fix) {
            let written = sources.written(span);
            for span in [span, written] {
                let whole = sources.file_of(span.start).map(|file| file.span());
                let within = |whole: Span| span.start <= span.end && span.end <= whole.end;
                assert!(
                    whole.is_some_and(within),
                    "{diagnostic:?} outside of {whole:?}"
                );
            }
            assert!(sources.locate(span).is_some());
        }
        sources.notes(diagnostic.span);
        // What people wrote is told shortened.
        assert!(diagnostic.message.len() < 1000, "{diagnostic:?}");
    }
}

/// A listing is laid out once, and keeps its meaning.
fn laid_out(bytes: &[u8]) {
    let Layout::Done(once) = extract::format(bytes) else {
        return;
    };
    let twice = extract::format(&once);
    assert!(
        twice == Layout::Done(once.clone()),
        "laid out twice: {:?}",
        Readable(&once)
    );
    assert_eq!(tokens_of(bytes), tokens_of(&once), "{:?}", Readable(&once));
}

/// Bytes of a text, readable in a message.
struct Readable<'a>(&'a [u8]);

impl std::fmt::Debug for Readable<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        std::fmt::Debug::fmt(&String::from_utf8_lossy(self.0), f)
    }
}

/// The tokens of a listing that is accepted.
fn tokens_of(bytes: &[u8]) -> Option<Vec<u32>> {
    let mut sources = SourceMap::new();
    let span = sources.add("listing", bytes).ok()?.span();
    let checked = listing::read(&mut sources, span, &listing::Options::default());
    bytecode::encode(checked.accepted()?).ok()
}

/// A shader that nothing refuses has tokens, comes back, runs and translates.
fn accepted(program: &Program, sources: &SourceMap, dialect: Dialect) {
    validate::statistics(program);
    let encoded = bytecode::encode(program);
    match &encoded {
        Ok(words) => comes_back(words, Some(dialect)),
        Err(found) => {
            points_into(sources, found);
            // `lenient` takes shaders of any length. An operand relative to a0.x may have any offset, but its token has
            // 11 bits for it.
            let excused = dialect == Dialect::Lenient || largest(program) > 2047;
            assert!(excused, "{found:?}");
        }
    }
    let kernel = kernel::lower(program, &kernel::Options::default());
    let kernel = kernel.unwrap_or_else(|error| panic!("{error}: {}", syntax::print(program)));
    run(&kernel, &encoded.unwrap_or_default());
    let stage = wgsl::Stage {
        program,
        kernel: &kernel,
        source: sources,
    };
    let (vertex, pixel) = match program.version.kind() {
        texcrd::isa::ShaderKind::Vertex => (Some(stage), None),
        texcrd::isa::ShaderKind::Pixel => (None, Some(stage)),
    };
    let translated = wgsl::translate(vertex, pixel, &wgsl::Options::default());
    if let Err(error) = translated {
        panic!("{error}: {}", syntax::print(program));
    }
}

/// The largest number of a register.
fn largest(program: &Program) -> u32 {
    let sources = program.instructions().flat_map(|i| &i.sources);
    let numbers = sources.map(|source| source.register.index);
    numbers.max().unwrap_or(0)
}

/// A shader that is refused may go on all the same.
fn refused(program: &Program) {
    validate::statistics(program);
    let _ = bytecode::encode(program);
    if let Ok(kernel) = kernel::lower(program, &kernel::Options::default()) {
        run(&kernel, &[]);
    }
}

/// Runs a quad with numbers that are made of the tokens, so that infinities and NaNs are among them.
fn run(kernel: &kernel::Kernel, words: &[u32]) {
    let number = |at: usize| {
        let word = words
            .get(at % words.len().max(1))
            .copied()
            .unwrap_or(0x3F80_0000);
        f32::from_bits(word.rotate_left(at as u32))
    };
    let mut machine = Machine::<4>::new();
    let slots = (0..)
        .map_while(Slot::input)
        .chain((0..).map_while(Slot::texcoord));
    for (at, slot) in slots.enumerate() {
        for lane in 0..4 {
            machine.set_lane(
                slot,
                lane,
                std::array::from_fn(|c| number(at * 16 + lane * 4 + c)),
            );
        }
    }
    let set: Vec<(u32, [f32; 4])> = (0..8)
        .map(|at| (at, std::array::from_fn(|c| number(at as usize * 4 + c))))
        .collect();
    let environment = Environment {
        constants: bind_constants(kernel, &set),
        ..Default::default()
    };
    machine.run(kernel, &environment);
}

/// The stream is read without a word, its listing is as the formatter leaves it, and gives the stream again. In the dialect
/// in which the stream was accepted, the listing is, too.
fn comes_back(words: &[u32], dialect: Option<Dialect>) {
    let decoded = bytecode::decode(words);
    assert_eq!(decoded.diagnostics, [], "{words:08X?}");
    let Some(program) = &decoded.program else {
        panic!("no program of {words:08X?}");
    };
    let listing = syntax::print(program);
    let laid_out = syntax::format(listing.as_bytes());
    assert!(
        laid_out == listing.as_bytes(),
        "{listing}\nis laid out as\n{:?}",
        Readable(&laid_out)
    );
    let mut sources = SourceMap::new();
    let Ok(text) = sources.add("listing", listing.as_str()) else {
        panic!("the listing of {} words is too long", words.len());
    };
    let file = text.span();
    if let Some(dialect) = dialect {
        let again = listing::check(text, dialect);
        assert!(
            again.accepted().is_some(),
            "{listing}\n{:?}",
            again.diagnostics
        );
    }
    // What `asm --unchecked` does.
    let unchecked = listing::Options {
        unchecked: true,
        ..Default::default()
    };
    let read = listing::read(&mut sources, file, &unchecked);
    let Some(program) = read.accepted() else {
        panic!("{listing}\n{:?}", read.diagnostics);
    };
    assert_eq!(syntax::print(program), listing);
    assert_eq!(bytecode::encode(program).as_deref(), Ok(words), "{listing}");
}

/// Words as a shader, as a vertex declaration, and as a file. Whether nothing is said of them as a shader.
pub fn words(words: &[u32]) -> bool {
    let decoded = bytecode::decode(words);
    bounded(&decoded.diagnostics, words);
    let valid = decoded.program.is_some() && decoded.diagnostics.is_empty();
    if let Some(program) = &decoded.program {
        assert!(program.statements.len() + program.comments.len() <= words.len());
        match valid {
            true => comes_back(words, None),
            // What is left of a damaged stream has tokens all the same.
            false => assert!(bytecode::encode(program).is_ok()),
        }
        for dialect in Dialect::all() {
            validate::validate(program, dialect);
        }
        refused(program);
    }
    declaration(words);
    valid
}

/// A few diagnostics, which point at tokens.
fn bounded(diagnostics: &[Diagnostic], words: &[u32]) {
    assert!(diagnostics.len() <= 101);
    for diagnostic in diagnostics {
        assert!(
            diagnostic.span.start as usize <= words.len(),
            "{diagnostic:?}"
        );
    }
}

/// Words as a vertex declaration.
pub fn declaration(words: &[u32]) {
    let (declaration, found) = Declaration::decode(words);
    bounded(&found, words);
    declaration.check();
    let text = declaration.print();
    let Ok(encoded) = declaration.encode() else {
        panic!("no tokens of {declaration:?}");
    };
    if found.is_empty() {
        assert_eq!(encoded, words);
        let again = elements(&text);
        // Of nothing but its end nobody can tell what it is.
        if words.iter().any(|word| !matches!(word, 0 | 0xFFFF_FFFF)) {
            assert_eq!(
                again.map(|stream| stream.words).as_deref(),
                Some(words),
                "{text}"
            );
        }
    }
}

/// The first stream of a text.
fn elements(text: &str) -> Option<Stream> {
    let mut sources = SourceMap::new();
    let input = bytecode::read(&mut sources, "elements", text.as_bytes()).ok()??;
    input.streams.into_iter().next()
}

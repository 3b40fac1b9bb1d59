//! The preprocessor: what lines that begin with `#` say about the lines behind them.
//!
//! The assembler of Direct3D ran the preprocessor of C before it read a listing; so does [`preprocess`]. What comes out is
//! a text of its own in the [`SourceMap`], which knows of each of its bytes where it was written, so that whatever is said
//! of it leads back there, through macros and included files.
//!
//! The way of a text: `scan` (bytes to words and signs), `directive` (the lines with `#`, `condition` for their
//! expressions, `define` for their macros), `expand` (uses of macros), `output` (the text with its origins). What stands
//! where it was written, comments included, is copied as it is.
//!
//! It differs from the preprocessor of C where listings do: `;` begins a comment to the end of its line, also behind
//! `#define`; macros are not looked for in comments; a name that is no macro but a macro with the suffix of a source
//! modifier (`TEX_NORMALMAP_bx2`) is that macro with the suffix behind it; a line end within a macro stays one where a word
//! follows it; lines are continued only within directives; `#` does not make strings.

mod condition;
mod define;
mod directive;
mod expand;
mod folders;
mod output;
mod resolve;
pub(crate) mod scan;
mod token;

#[cfg(test)]
mod tests;

pub use define::{BadDefinition, Definition};
pub use folders::Folders;
pub use resolve::{Included, NoFiles, Resolver};

use crate::diagnostic::{Diagnostic, Rule, SourceMap, Span};
use crate::rules::text as rules;
use define::Macro;
use directive::Condition;
use output::Output;
use scan::{Language, Scanner};
use std::collections::HashMap;
use token::{Kind, Token};

/// Files that may be open within each other.
pub const MOST_DEPTH: usize = 32;
/// Files that one text may include, each time counted.
pub const MOST_INCLUDES: usize = 1000;
/// Words and signs that macros may make of one text.
pub const MOST_WORDS: usize = 1 << 18;

/// How many diagnostics a text gets before the rest is left out.
const MOST_REPORTS: usize = 100;
/// How deep uses of macros may stand in the arguments of others.
const MOST_NESTING: usize = 64;

/// What a text is preprocessed with.
#[derive(Clone, Copy)]
pub struct Options<'a> {
    /// Macros that are defined before the first line.
    pub definitions: &'a [Definition],
    /// Gives the files that are included.
    pub resolver: &'a dyn Resolver,
}

impl Default for Options<'_> {
    /// No macros and no files.
    fn default() -> Self {
        Self {
            definitions: &[],
            resolver: &NoFiles,
        }
    }
}

/// What came out.
#[derive(Clone, Debug)]
pub struct Preprocessed {
    /// The text to read on, among the sources; `None` if there is no sense in reading on.
    pub text: Option<Span>,
    /// What is wrong, with spans where it was written.
    pub diagnostics: Vec<Diagnostic>,
    /// Empty places in the text where something is missing: a file that could not be included, a macro that could not be
    /// expanded, what stands behind a condition that cannot be read. Names may have been defined there.
    pub lost: Vec<Span>,
}

/// Whether a text has anything for a preprocessor: without a `#` and without definitions it is as it stands.
pub fn is_needed(text: &[u8], options: &Options<'_>) -> bool {
    !options.definitions.is_empty() || text.contains(&b'#')
}

/// Runs the preprocessor over a listing, one of the sources, and adds what comes out to them.
///
/// Never fails: whatever is wrong is a diagnostic. Time and memory are bounded by the length of the text, of what it
/// includes, and by [`MOST_WORDS`].
pub fn preprocess(sources: &mut SourceMap, file: Span, options: &Options<'_>) -> Preprocessed {
    run(sources, file, options, Language::Listing)
}

/// As [`preprocess`], for a listing or for a text with listings in it.
pub(crate) fn run(
    sources: &mut SourceMap,
    file: Span,
    options: &Options<'_>,
    language: Language,
) -> Preprocessed {
    let Some(root) = sources.file_of(file.start) else {
        return Preprocessed {
            text: None,
            diagnostics: Vec::new(),
            lost: Vec::new(),
        };
    };
    let (name, text, start) = (
        root.name().to_string(),
        root.shared_bytes(),
        root.span().start,
    );
    let mut preprocessor = Preprocessor {
        sources,
        resolver: options.resolver,
        language,
        open: Vec::new(),
        macros: Vec::new(),
        names: HashMap::new(),
        pending: Vec::new(),
        isolated: false,
        nesting: 0,
        conditions: Vec::new(),
        output: Output::default(),
        reports: Vec::new(),
        lost: Vec::new(),
        words: 0,
        included: 0,
        included_bytes: 0,
        stopped: false,
    };
    preprocessor.define_all(options.definitions, file);
    preprocessor.open.push(Open {
        scanner: Scanner::new(text, start, language),
        path: None,
        conditions: 0,
    });
    preprocessor.read();
    let Preprocessor {
        output,
        stopped,
        lost,
        mut reports,
        ..
    } = preprocessor;
    let (bytes, derivation) = output.finish();
    let mut text = None;
    if !stopped {
        match sources.add_derived(name, bytes, derivation) {
            Ok(file) => text = Some(file.span()),
            Err(error) => reports.push(Diagnostic::error(
                &rules::BOUNDS,
                file.at_start(),
                error.to_string(),
            )),
        }
    }
    let base = text.map_or(0, |text| text.start);
    let place = |at: u32| Span::new(base + at, base + at);
    Preprocessed {
        text,
        diagnostics: reports,
        lost: lost.into_iter().map(place).collect(),
    }
}

/// A text that is being read.
struct Open {
    scanner: Scanner,
    /// How the resolver knows it; `None` for the first one.
    path: Option<String>,
    /// How many conditions were open where it begins.
    conditions: usize,
}

/// What is read before the text goes on.
enum Item {
    Token(Token),
    /// Behind what a macro became: it can be used again.
    Leave(usize),
}

struct Preprocessor<'s, 'o> {
    sources: &'s mut SourceMap,
    resolver: &'o dyn Resolver,
    language: Language,
    /// The texts that are being read, each included by the one before it.
    open: Vec<Open>,
    macros: Vec<Macro>,
    /// The numbers of the macros that are defined.
    names: HashMap<Vec<u8>, usize>,
    /// What is read next, the last one first.
    pending: Vec<Item>,
    /// Whether only `pending` is read.
    isolated: bool,
    nesting: usize,
    conditions: Vec<Condition>,
    output: Output,
    reports: Vec<Diagnostic>,
    /// Places in the output.
    lost: Vec<u32>,
    /// Counted towards [`MOST_WORDS`].
    words: usize,
    included: usize,
    included_bytes: usize,
    /// Whether nothing more is read.
    stopped: bool,
}

impl Preprocessor<'_, '_> {
    /// Reads everything that is open.
    fn read(&mut self) {
        while !self.stopped {
            let token = match self.active() {
                true => self.next_expanded(),
                false => self.next(),
            };
            match token.kind {
                Kind::End if self.close() => {}
                Kind::End => return,
                Kind::Sign if token.first && token.is(self.sources, b"#") => self.directive(&token),
                _ if self.active() => self.emit(&token),
                _ => {}
            }
        }
    }

    /// Ends the innermost text; false if it was the only one.
    fn close(&mut self) -> bool {
        let Some(closed) = self.open.pop() else {
            return false;
        };
        for condition in self
            .conditions
            .drain(closed.conditions.min(self.conditions.len())..)
        {
            let message = "this condition has no #endif";
            let report = Diagnostic::error(&rules::CONDITIONAL, condition.at, message);
            self.reports
                .push(report.with_help("write #endif where it ends"));
        }
        !self.open.is_empty()
    }

    /// The next word or sign as it is written, or as macros made it.
    fn next(&mut self) -> Token {
        loop {
            match self.pending.pop() {
                Some(Item::Token(token)) => return token,
                Some(Item::Leave(number)) => {
                    if let Some(left) = self.macros.get_mut(number) {
                        left.active = false;
                    }
                }
                None => break,
            }
        }
        match self.open.last_mut() {
            Some(open) if !self.isolated && !self.stopped => Token::of(open.scanner.next()),
            _ => Token::of(scan::Lexeme {
                kind: scan::Kind::End,
                span: Span::default(),
                open: false,
                first: false,
            }),
        }
    }

    fn emit(&mut self, token: &Token) {
        if self.output.bytes.len() > SourceMap::MAX_BYTES {
            let span = self.place(token);
            let most = SourceMap::MAX_BYTES;
            self.stop(
                span,
                format!("more than {most} bytes come out of the preprocessor"),
            );
            return;
        }
        self.output.push(token, self.sources);
    }

    /// Counts words that macros make; false beyond the most, which ends everything.
    fn count(&mut self, words: usize, at: Span) -> bool {
        self.words = self.words.saturating_add(words);
        if self.words > MOST_WORDS && !self.stopped {
            self.stop(
                at,
                format!("macros make more than {MOST_WORDS} words of this text"),
            );
        }
        !self.stopped
    }

    /// Where a token was written: of what a macro made, where the macro is used.
    fn place(&self, token: &Token) -> Span {
        match token.part.expansion {
            Some(expansion) => self.output.outermost(expansion).unwrap_or(token.span()),
            None => token.span(),
        }
    }

    /// Ends everything because of a limit.
    fn stop(&mut self, at: Span, message: String) {
        let help = "a macro or a file may lead back to itself";
        self.error(&rules::BOUNDS, at, message, help);
        self.stopped = true;
    }

    fn error(&mut self, rule: &'static Rule, at: Span, message: impl Into<String>, help: &str) {
        let mut report = Diagnostic::error(rule, at, message);
        if !help.is_empty() {
            report = report.with_help(help);
        }
        self.report(report);
    }

    fn report(&mut self, report: Diagnostic) {
        if self.reports.len() < MOST_REPORTS {
            self.reports.push(report);
        }
    }

    /// Notes that something is missing here.
    fn lose(&mut self) {
        if self.lost.len() < MOST_REPORTS {
            self.lost.push(self.output.bytes.len() as u32);
        }
    }
}

//! Pages of rules.

use super::names::subjects;
use super::page::{Fact, Page};
use super::subject::Subject;
use crate::bytecode::{Declaration, StreamKind};
use crate::diagnostic::{Diagnostic, Severity, SourceMap};
use crate::extract::{self, Text};
use crate::listing;
use crate::policy::Dialect;
use crate::preprocess;
use crate::rules::{self, Entry, Example, Group};

/// What a rule says, how severe a breach is in each dialect, a listing that breaks it with what is said of that, and one beside it
/// that does not.
pub fn rule(rule: &'static Entry) -> Page {
    let mut page = Page::new(rule.rule.id, rule.rule.rule);
    page.paragraph(rule.note);
    let mut facts = vec![Fact::new("about", rule.group().title())];
    facts.extend(severities(|dialect| rule.severity(dialect)));
    page.facts(facts);
    if !rule.breaks.is_empty() {
        page.heading("Breaks it");
        shown(&mut page, rule.breaks, rule.rule.id);
        page.heading("Keeps it");
        page.listing(shortened(&Example::new(rule.keeps).text));
    }
    for case in rule.cases {
        page.heading(format!("Otherwise: {}", case.when));
        page.facts(severities(|dialect| case.severity(dialect)));
        if !case.breaks.is_empty() {
            shown(&mut page, case.breaks, rule.rule.id);
        }
    }
    page.see = mentioned(rule);
    page
}

/// What a breach is in each dialect.
fn severities(of: impl Fn(Dialect) -> Option<Severity>) -> Vec<Fact> {
    let said = |dialect| of(dialect).map_or("nothing is said", Severity::name);
    let facts = Dialect::all().map(|dialect| Fact::new(dialect.name(), said(dialect)));
    facts.collect()
}

/// Adds an example that breaks a rule, with what is said of it in the first dialect that says something.
fn shown(page: &mut Page, written: &str, id: &str) {
    let example = Example::new(written);
    page.listing(shortened(&example.text));
    let said = Dialect::all().find_map(|dialect| judged(&example.text, dialect, id));
    page.facts(said.unwrap_or_default());
}

/// What `check` says of the first breach of a rule in an example; `None` if it says nothing.
fn judged(text: &str, dialect: Dialect, id: &str) -> Option<Vec<Fact>> {
    let mut sources = SourceMap::new();
    let none = preprocess::Options::default();
    let file = extract::open(&mut sources, "example", text.as_bytes().to_vec(), &none).ok()?;
    let options = listing::Options {
        dialect,
        ..Default::default()
    };
    let mut found: Vec<Diagnostic> = file.diagnostics;
    for shader in &file.shaders {
        found.extend(
            extract::check(&mut sources, shader, &options)
                .ok()?
                .diagnostics,
        );
    }
    // D5 holds without a shader, which examples of declarations do not have.
    for shader in &file.shaders {
        if let Text::Tokens(stream) = &shader.text
            && stream.kind == StreamKind::Declaration
        {
            let (declaration, _) = Declaration::decode(&stream.words);
            found.extend(stream.placed(declaration.check_fixed_function()));
        }
    }
    let breach = found
        .into_iter()
        .find(|diagnostic| diagnostic.rule.id == id)?;
    let line = sources.locate(breach.span).map_or(0, |at| at.line);
    let message = format!("line {line}: {}", breach.message);
    let mut facts = vec![Fact::new(breach.severity.name(), message)];
    facts.extend(breach.help.map(|help| Fact::new("help", help)));
    Some(facts)
}

/// A listing with what stands in it many times over said once.
fn shortened(text: &str) -> String {
    const MOST: usize = 4;
    let lines: Vec<&str> = text.lines().collect();
    let mut out = Vec::new();
    for alike in lines.chunk_by(|a, b| a == b) {
        match alike {
            [line, ..] if alike.len() > MOST => {
                out.push(line.to_string());
                out.push(format!("; and {} times more", alike.len() - 1));
            }
            few => out.extend(few.iter().map(ToString::to_string)),
        }
    }
    out.join("\n")
}

/// The names in the sentences of a rule that have pages.
fn mentioned(rule: &Entry) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for word in words(rule.rule.rule).chain(words(rule.note)) {
        // Single letters are words of English as well.
        let found = Some(word).filter(|word| word.len() > 1);
        let found = found
            .and_then(|word| subjects(word).ok())
            .unwrap_or_default();
        for name in found.iter().map(Subject::name) {
            if name != rule.rule.id && !names.contains(&name) {
                names.push(name);
            }
        }
    }
    names
}

/// Adds the rules of the shader model whose sentences name this word.
pub(super) fn mention(page: &mut Page, name: &str) {
    let model = |entry: &&Entry| !matches!(entry.group(), Group::Text | Group::Tokens);
    let names = |entry: &&Entry| {
        words(entry.rule.rule).any(|word| name.split(", ").any(|name| name == word))
    };
    let entries = rules::all().filter(model).filter(names);
    let facts: Vec<Fact> = entries
        .map(|entry| Fact::new(entry.rule.id, entry.rule.rule))
        .collect();
    if !facts.is_empty() {
        page.heading("Rules");
        page.facts(facts);
    }
}

/// The words of a sentence, `t#` and `_x2` among them.
fn words(sentence: &str) -> impl Iterator<Item = &str> {
    sentence.split(|c: char| !c.is_ascii_alphanumeric() && !matches!(c, '_' | '#'))
}

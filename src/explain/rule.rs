//! Pages of rules.

use super::page::{Fact, Page, Part};
use crate::diagnostic::Rule;

/// Every rule.
pub(super) fn all() -> impl Iterator<Item = &'static Rule> {
    crate::validate::RULES
        .iter()
        .chain(crate::syntax::RULES)
        .chain(crate::bytecode::RULES)
        .copied()
}

/// What a rule says.
pub fn rule(rule: &'static Rule) -> Page {
    Page::new(rule.id, rule.rule)
}

/// Adds the rules whose sentences name this word.
pub(super) fn mention(page: &mut Page, name: &str) {
    let names = |rule: &&Rule| words(rule.rule).any(|word| name.split(", ").any(|n| n == word));
    let facts: Vec<Fact> = all()
        .filter(names)
        .map(|rule| Fact::new(rule.id, rule.rule))
        .collect();
    if !facts.is_empty() {
        page.heading("Rules");
        page.parts.push(Part::Facts(facts));
    }
}

/// The words of a sentence, `t#` and `_x2` among them.
fn words(sentence: &str) -> impl Iterator<Item = &str> {
    sentence.split(|c: char| !c.is_ascii_alphanumeric() && !matches!(c, '_' | '#'))
}

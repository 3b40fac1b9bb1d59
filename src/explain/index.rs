//! What can be asked for.

use super::page::{Fact, Page};
use super::subject::Subject;
use crate::isa::Class;
use crate::rules::Group;

/// Everything that has a page, by groups.
pub fn index() -> Page {
    let mut page = Page::new("explain", "what can be asked for");
    let mut groups: Vec<(&str, Vec<String>)> = Vec::new();
    for subject in Subject::all() {
        let group = group(&subject);
        match groups.iter_mut().find(|(other, _)| *other == group) {
            Some((_, names)) => names.push(subject.name()),
            None => groups.push((group, vec![subject.name()])),
        }
    }
    let facts = groups.into_iter();
    page.facts(
        facts
            .map(|(group, names)| Fact::new(group, names.join(", ")))
            .collect(),
    );
    page
}

fn group(subject: &Subject) -> &'static str {
    match subject {
        Subject::Instruction(opcode) => match opcode.row().forms.first().map(|form| form.class) {
            Some(Class::Texture) => "texture",
            Some(Class::Declaration) => "before all",
            _ => "arithmetic",
        },
        Subject::Declaration(_) => "before all",
        Subject::Register(..) => "registers",
        Subject::Modifier(_) => "sources",
        Subject::Result(_) => "results",
        Subject::Notation(_) => "notation",
        Subject::Version(_) => "versions",
        Subject::Macro(_) => "macros",
        Subject::Model(_) => "models",
        Subject::Policy(_) => "policies",
        Subject::Rule(entry) => match entry.group() {
            Group::Text => "text",
            Group::Tokens => "tokens",
            _ => "rules",
        },
    }
}

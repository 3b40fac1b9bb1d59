//! The rule list: every rule of the shader model, of the text and of the tokens, in one table.
//!
//! A rule is checked where it can be seen: in `preprocess`, `syntax`, `bytecode`, `validate`, or beside the shader. What
//! it is called, what it says, how severe a breach is in which [`Dialect`], and an example on either side of it stand
//! here and nowhere else. Identifiers are stable; those that are given up ([`RETIRED`]) are not used again.

mod example;
pub(crate) mod model;
mod severity;
pub(crate) mod text;
pub(crate) mod tokens;

#[cfg(test)]
mod tests;

pub use example::Example;

use crate::diagnostic::{Rule, Severity};
use crate::policy::Dialect;
use severity::Severities;

/// A rule with all that is to be said of it.
#[derive(Debug)]
pub struct Entry {
    /// The rule itself.
    pub rule: &'static Rule,
    severities: Severities,
    /// What breaks it and nothing else, as [`Example::new`] takes it; empty if there is no such thing.
    pub breaks: &'static str,
    /// What is next to that and breaks nothing; empty if `breaks` is.
    pub keeps: &'static str,
    /// What else is to be known of it, in sentences: of a rule without an example why it has none, and which rule
    /// speaks instead. May be empty.
    pub note: &'static str,
    /// Breaches that are judged otherwise than the rest.
    pub cases: &'static [Case],
}

/// Breaches of a rule that are judged otherwise than the rest.
#[derive(Debug)]
pub struct Case {
    /// Which ones, in a few words.
    pub when: &'static str,
    severities: Severities,
    /// One of them, as [`Example::new`] takes it; may be empty.
    pub breaks: &'static str,
}

impl Entry {
    /// How severe a breach is; `None` if nothing is said of it in this dialect.
    pub fn severity(&self, dialect: Dialect) -> Option<Severity> {
        self.severities.of(dialect)
    }

    /// What the rule is about.
    pub fn group(&self) -> Group {
        let letter = self.rule.id.chars().next();
        let of = |(group, _): &&(Group, &str)| letter == Some(group.letter());
        GROUPS
            .iter()
            .find(of)
            .map_or(Group::Text, |(group, _)| *group)
    }
}

impl Case {
    /// How severe such a breach is; `None` if nothing is said of it in this dialect.
    pub fn severity(&self, dialect: Dialect) -> Option<Severity> {
        self.severities.of(dialect)
    }
}

/// What rules are about; the first letter of their identifiers says it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    /// `B…`
    Budgets,
    /// `S…`
    Structure,
    /// `O…`
    Operands,
    /// `M…`
    Modifiers,
    /// `R…`
    ReadPorts,
    /// `T…`
    Stages,
    /// `I…`
    Initialisation,
    /// `C…`
    CoIssue,
    /// `D…`
    Declarations,
    /// `P…`
    Text,
    /// `K…`
    Tokens,
}

static GROUPS: [(Group, &str); 11] = [
    (Group::Budgets, "how much a shader may hold"),
    (Group::Structure, "which instructions stand where"),
    (Group::Operands, "which registers an operand may name"),
    (Group::Modifiers, "modifiers, masks and selectors"),
    (Group::ReadPorts, "how many registers are read at once"),
    (Group::Stages, "the texture stages"),
    (Group::Initialisation, "what holds a value"),
    (Group::CoIssue, "instructions that run together"),
    (Group::Declarations, "vertex declarations"),
    (Group::Text, "the text of a listing"),
    (Group::Tokens, "tokens"),
];

impl Group {
    /// Every group, in the order of [`all`].
    pub fn all() -> impl Iterator<Item = Group> {
        GROUPS.iter().map(|(group, _)| *group)
    }

    /// What it is about, in a few words.
    pub fn title(self) -> &'static str {
        GROUPS[self as usize].1
    }

    /// The letter that the identifiers of its rules begin with.
    pub fn letter(self) -> char {
        match self {
            Group::Budgets => 'B',
            Group::Structure => 'S',
            Group::Operands => 'O',
            Group::Modifiers => 'M',
            Group::ReadPorts => 'R',
            Group::Stages => 'T',
            Group::Initialisation => 'I',
            Group::CoIssue => 'C',
            Group::Declarations => 'D',
            Group::Text => 'P',
            Group::Tokens => 'K',
        }
    }
}

/// Identifiers that were given up, with the rules that speak now. They are never used again.
pub static RETIRED: [(&str, &str); 4] = [("P2", "S1"), ("P4", "S1"), ("K1", "S13"), ("K2", "S12")];

/// Every rule: those of the shader model, of the text, of the tokens, each group in the order of its numbers.
pub fn all() -> impl Iterator<Item = &'static Entry> {
    let tables = [model::ENTRIES, text::ENTRIES, tokens::ENTRIES];
    tables.into_iter().flatten()
}

/// The rule with this identifier, in any case of letters; of an identifier that was given up, the one that speaks now.
pub fn find(id: &str) -> Option<&'static Entry> {
    let retired = RETIRED.iter().find(|(old, _)| old.eq_ignore_ascii_case(id));
    let id = retired.map_or(id, |(_, new)| new);
    all().find(|entry| entry.rule.id.eq_ignore_ascii_case(id))
}

/// Makes rules with names of their own, and their table.
macro_rules! named {
    ($($name:ident $id:literal $severities:ident $rule:literal
        $(breaks $breaks:literal)?
        $(keeps $keeps:literal)?
        $(note $note:literal)?
        $(case $of_case:ident $when:literal $(breaks $example:literal)?)*;)*
    ) => {
        $(pub(crate) static $name: crate::diagnostic::Rule =
            crate::diagnostic::Rule { id: $id, rule: $rule };)*

        /// One entry a rule.
        pub(super) static ENTRIES: &[super::Entry] = &[$(super::Entry {
            rule: &$name,
            severities: $severities,
            breaks: concat!($($breaks)?),
            keeps: concat!($($keeps)?),
            note: concat!($($note)?),
            cases: &[$(super::Case {
                when: $when,
                severities: $of_case,
                breaks: concat!($($example)?),
            }),*],
        }),*];
    };
}
use named;

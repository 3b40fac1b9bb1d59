//! What a line can be completed to.

use super::table::{COMMANDS, Takes};
use super::{Console, export, info, table};
use crate::debug::expression::function_names;
use crate::debug::session::Session;
use crate::debug::stops::Occurrence;

impl Console {
    /// The words that the last word of a line can become, sorted. What stands before that word stays as it is: it begins at
    /// [`Self::word_start`].
    pub fn complete(&self, session: &Session<'_>, line: &str) -> Vec<String> {
        let start = Self::word_start(line);
        let (before, word) = line.split_at(start);
        let names: Vec<String> = match before.split_whitespace().next() {
            None => COMMANDS
                .iter()
                .map(|command| command.name.to_string())
                .collect(),
            Some(command) => {
                let command = command.split('/').next().unwrap_or(command);
                let Ok(command) = table::find(command) else {
                    return Vec::new();
                };
                arguments(session, command.takes)
            }
        };
        let mut names: Vec<String> = (names.into_iter())
            .filter(|name| name.starts_with(word))
            .collect();
        names.sort();
        names.dedup();
        names
    }

    /// Where the last word of a line begins, in bytes.
    pub fn word_start(line: &str) -> usize {
        let inside = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-');
        // The name of a command may hold a `-`; in an expression that is a minus.
        let first = line.trim_start();
        if !first.contains(char::is_whitespace) && !first.contains('/') {
            return line.len() - first.len();
        }
        let word = line.rfind(|c: char| !inside(c) || c == '-');
        word.map_or(0, |at| {
            at + line[at..].chars().next().map_or(0, char::len_utf8)
        })
    }
}

fn arguments(session: &Session<'_>, takes: Takes) -> Vec<String> {
    let owned = |names: &mut dyn Iterator<Item = &'static str>| names.map(str::to_string).collect();
    match takes {
        Takes::Nothing => Vec::new(),
        Takes::Expression => {
            let functions = function_names().map(str::to_string);
            functions.chain(info::register_names(session)).collect()
        }
        Takes::Topic => owned(&mut info::TOPICS.iter().map(|topic| topic.name)),
        Takes::Occurrence => owned(&mut Occurrence::all().map(Occurrence::name)),
        Takes::Command => owned(&mut COMMANDS.iter().map(|command| command.name)),
        Takes::ExportFormat => owned(&mut export::formats()),
    }
}

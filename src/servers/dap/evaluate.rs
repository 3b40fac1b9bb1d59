//! Expressions: watches, hovers, the console of the debugger, and what they may be completed to.

use super::adapter::{Adapter, expression};
use super::protocol::{
    Answer, Completion, Completions, CompletionsArguments, EvaluateArguments, Event, Handled,
    Refusal, Valued,
};
use super::travel::stopped;
use super::values;
use super::variables::Container;
use texcrd::debug::{Console, Effect, Reply, RunKind, Session, Value, command_help};
use texcrd::isa::WriteMask;

impl Adapter<'_, '_> {
    pub(super) fn evaluate(&mut self, arguments: &EvaluateArguments) -> Handled {
        let hex = arguments.format.and_then(|f| f.hex).unwrap_or(false);
        match arguments.context.as_deref() {
            Some("repl") => self.command(&arguments.expression),
            // What goes to the clipboard is to be pasted somewhere: numbers alone.
            Some("clipboard") => self.value(arguments, |value| value.text(values::format(hex))),
            _ => self.value(arguments, |value| values::with_marks(value, hex, &[])),
        }
    }

    fn value(&mut self, arguments: &EvaluateArguments, text: impl Fn(&Value) -> String) -> Handled {
        let view = self.view_of(arguments.frame_id)?;
        let (run, lane) = (view.number, view.run.lane);
        let scope = view.scope(lane);
        let read = expression(&arguments.expression)?;
        let value = read
            .evaluate(&scope)
            .map_err(|error| Refusal::text(format!("`{read}`: {error}")))?;
        let whole = read
            .target_here(&scope)
            .filter(|(_, mask)| *mask == WriteMask::ALL);
        let content = match whole {
            Some((target, _)) => Some(Container::Register { run, target, lane }),
            None if value.count > 1 => Some(Container::Numbers {
                bits: value.numbers.map(f32::to_bits),
                count: value.count,
            }),
            None => None,
        };
        let kinds = ["float", "float", "float2", "float3", "float4"];
        let kind = kinds.get(value.count).copied();
        let content = content.filter(|_| value.count > 1);
        let result = Valued {
            result: Some(text(&value)),
            kind: kind.filter(|_| self.client.types),
            named_variables: content.map(|_| value.count),
            variables_reference: content.map_or(0, |content| self.containers.reference(content)),
            ..Valued::default()
        };
        Ok(Answer::of(&result))
    }
}

impl Adapter<'_, '_> {
    /// What is typed into the console of the debugger: an expression, or a command.
    fn command(&mut self, line: &str) -> Handled {
        let asked = EvaluateArguments {
            expression: line.to_string(),
            frame_id: None,
            context: None,
            format: None,
        };
        let value = self.value(&asked, |value| values::with_marks(value, false, &[]));
        if value.is_ok() || !names_command(line) {
            return value;
        }
        self.execute(line)
    }

    fn execute(&mut self, line: &str) -> Handled {
        let runs = |session: &Session<'_>| -> Vec<RunKind> {
            session.runs().iter().map(|run| run.kind).collect()
        };
        let (place, kinds) = (self.session.position(), runs(&self.session));
        let (edits, registers) = (self.session.edits().len(), self.session.registers().clone());
        let Reply {
            text,
            quit,
            failed,
            effect,
        } = self.wanted.console.execute(&mut self.session, line);
        let mut text = text.to_string().trim_end().to_string();
        if failed {
            return Err(Refusal::text(text));
        }
        let mut events = self.deleted();
        let elsewhere = runs(&self.session) != kinds;
        if elsewhere {
            // Another pixel may run other shaders.
            events.extend(self.resolve());
        }
        let moved = self.session.position() != place || self.session.edits().len() != edits;
        if elsewhere || moved {
            self.before = Some((place.run, registers)).filter(|_| !elsewhere);
            self.occurred = None;
            self.renew();
            events.push(stopped("step", None));
        }
        match effect {
            Some(Effect::Write {
                path,
                text: content,
            }) => {
                let path = self.folder().join(path);
                (self.tools.write)(&path, content.as_bytes()).map_err(Refusal::text)?;
            }
            Some(Effect::Picture { .. }) => {
                let why =
                    "pictures are drawn by the terminal's debugger and by `texcrd run --show`";
                return Err(Refusal::here(why));
            }
            None => {}
        }
        if quit {
            events.push(Event::bare("terminated"));
        }
        if text.is_empty() {
            text.push_str("done");
        }
        let result = Valued {
            result: Some(text),
            ..Valued::default()
        };
        Ok(Answer::then(&result, events))
    }

    /// What the line can be completed to where the caret stands.
    pub(super) fn completions(&mut self, arguments: &CompletionsArguments) -> Handled {
        let number = arguments.line.map_or(1, |line| self.client.line_of(line));
        let line = arguments.text.lines().nth(number.saturating_sub(1));
        let caret = self.client.column_of(arguments.column).saturating_sub(1);
        let before = first_units(line.unwrap_or_default(), caret);
        // What is no command is an expression, as `print` takes it.
        let printed = format!("print {before}");
        let mut targets = Vec::new();
        for line in [before, &printed] {
            let word = line.get(Console::word_start(line)..).unwrap_or_default();
            let length = word.encode_utf16().count();
            let start = before.encode_utf16().count().saturating_sub(length);
            for label in self.wanted.console.complete(&self.session, line) {
                targets.push(Completion {
                    label,
                    start: self.client.column(start + 1),
                    length,
                });
            }
        }
        Ok(Answer::of(&Completions { targets }))
    }
}

/// Whether a line begins with the name of a command, or the beginning of one.
fn names_command(line: &str) -> bool {
    let line = line.trim_start();
    let word = line
        .split(|c: char| c.is_whitespace() || c == '/')
        .next()
        .unwrap_or_default();
    let known = |name: &str| name.starts_with(word);
    word.is_empty()
        || command_help()
            .any(|help| known(help.name) || help.aliases.iter().any(|alias| known(alias)))
}

/// The beginning of a text that has at most so many units of UTF-16.
fn first_units(text: &str, most: usize) -> &str {
    let mut units = 0;
    let end = text.char_indices().find(|(_, c)| {
        units += c.len_utf16();
        units > most
    });
    let (first, _) = text.split_at(end.map_or(text.len(), |(at, _)| at));
    first
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_caret_counts_units_of_utf_16() {
        // U+1D11E has two.
        assert_eq!(first_units("a\u{1d11e}b", 1), "a");
        assert_eq!(first_units("a\u{1d11e}b", 2), "a");
        assert_eq!(first_units("a\u{1d11e}b", 3), "a\u{1d11e}");
        assert_eq!(first_units("a", usize::MAX), "a");
    }
}

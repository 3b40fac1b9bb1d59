//! The command line: a line that is edited, with what was entered before and with completion.

/// How many lines are remembered.
const MOST_REMEMBERED: usize = 1000;

/// The longest line that is taken, in characters.
const LONGEST: usize = 1000;

/// A line that is edited.
#[derive(Clone, Debug, Default)]
pub(super) struct Prompt {
    text: Vec<char>,
    cursor: usize,
    /// What was entered, the latest last; nothing twice in a row.
    history: Vec<String>,
    /// The line of the history that is shown, and what had been typed before.
    recalled: Option<(usize, String)>,
    /// What the last Tab found: where the word begins, the candidates, which one stands there.
    completion: Option<Completion>,
}

#[derive(Clone, Debug)]
struct Completion {
    candidates: Vec<String>,
    chosen: Option<usize>,
}

/// A change of the line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Edit {
    /// A character at the cursor.
    Insert(char),
    /// Away with the character before the cursor.
    Backspace,
    /// Away with the character at the cursor.
    Delete,
    /// Away with the word before the cursor.
    DeleteWord,
    /// Away with everything.
    Clear,
    /// Away with everything from the cursor on.
    ClearRight,
    /// One character to the left.
    Left,
    /// One to the right.
    Right,
    /// To the beginning.
    Home,
    /// To the end.
    End,
    /// The line entered before.
    Earlier,
    /// The line entered after it.
    Later,
}

impl Prompt {
    /// The line.
    pub(super) fn text(&self) -> String {
        self.text.iter().collect()
    }

    /// The characters before the cursor.
    pub(super) fn before_cursor(&self) -> String {
        self.text.iter().take(self.cursor).collect()
    }

    /// What the last Tab found, if it was more than one.
    pub(super) fn candidates(&self) -> &[String] {
        match &self.completion {
            Some(completion) if completion.candidates.len() > 1 => &completion.candidates,
            _ => &[],
        }
    }

    /// Which of the candidates stands in the line.
    pub(super) fn chosen(&self) -> Option<usize> {
        self.completion.as_ref().and_then(|found| found.chosen)
    }

    /// Changes the line.
    pub(super) fn edit(&mut self, edit: Edit) {
        self.completion = None;
        match edit {
            Edit::Insert(c) if self.text.len() < LONGEST && !c.is_control() => {
                self.text.insert(self.cursor, c);
                self.cursor += 1;
            }
            Edit::Insert(_) => {}
            Edit::Backspace if self.cursor > 0 => {
                self.cursor -= 1;
                self.text.remove(self.cursor);
            }
            Edit::Delete if self.cursor < self.text.len() => {
                self.text.remove(self.cursor);
            }
            Edit::Backspace | Edit::Delete => {}
            Edit::DeleteWord => {
                let before = &self.text[..self.cursor];
                let spaces = before
                    .iter()
                    .rev()
                    .take_while(|c| c.is_whitespace())
                    .count();
                let word = before.iter().rev().skip(spaces);
                let count = spaces + word.take_while(|c| !c.is_whitespace()).count();
                self.text.drain(self.cursor - count..self.cursor);
                self.cursor -= count;
            }
            Edit::Clear => self.replace(""),
            Edit::ClearRight => self.text.truncate(self.cursor),
            Edit::Left => self.cursor = self.cursor.saturating_sub(1),
            Edit::Right => self.cursor = (self.cursor + 1).min(self.text.len()),
            Edit::Home => self.cursor = 0,
            Edit::End => self.cursor = self.text.len(),
            Edit::Earlier => self.earlier(),
            Edit::Later => self.later(),
        }
    }

    fn replace(&mut self, text: &str) {
        self.text = text.chars().collect();
        self.cursor = self.text.len();
    }

    fn earlier(&mut self) {
        let (number, typed) = match self.recalled.take() {
            Some((number, typed)) => (number.saturating_sub(1), typed),
            None => (self.history.len().saturating_sub(1), self.text()),
        };
        if let Some(line) = self.history.get(number).cloned() {
            self.replace(&line);
            self.recalled = Some((number, typed));
        }
    }

    fn later(&mut self) {
        let Some((number, typed)) = self.recalled.take() else {
            return;
        };
        match self.history.get(number + 1).cloned() {
            Some(line) => {
                self.replace(&line);
                self.recalled = Some((number + 1, typed));
            }
            None => self.replace(&typed),
        }
    }

    /// Takes the line away and remembers it.
    pub(super) fn enter(&mut self) -> String {
        let line = self.text();
        self.edit(Edit::Clear);
        self.recalled = None;
        if !line.trim().is_empty() && self.history.last() != Some(&line) {
            self.history.push(line.clone());
            if self.history.len() > MOST_REMEMBERED {
                self.history.remove(0);
            }
        }
        line
    }

    /// Completes the line: `candidates` are the lines that can come of what stands before the cursor. What they have in common
    /// is filled in; if that is nothing new, each further call fills in the next one.
    pub(super) fn complete(&mut self, candidates: impl FnOnce(&str) -> Vec<String>) {
        if let Some(mut completion) = self.completion.take() {
            let next = completion.chosen.map_or(0, |chosen| chosen + 1);
            let next = next % completion.candidates.len().max(1);
            if let Some(line) = completion.candidates.get(next).cloned() {
                self.fill_in(&line);
                completion.chosen = Some(next);
            }
            self.completion = Some(completion);
            return;
        }
        let before = self.before_cursor();
        let found = candidates(&before);
        let Some(common) = common_start(&found) else {
            return;
        };
        if common.chars().count() > self.cursor {
            self.fill_in(&common);
        }
        if found.len() > 1 {
            self.completion = Some(Completion {
                candidates: found,
                chosen: None,
            });
        }
    }

    fn fill_in(&mut self, line: &str) {
        let rest: Vec<char> = self.text.split_off(self.cursor);
        self.replace(line);
        self.text.extend(rest);
        self.text.truncate(LONGEST);
        self.cursor = self.cursor.min(self.text.len());
    }
}

fn common_start(lines: &[String]) -> Option<String> {
    let (first, others) = lines.split_first()?;
    let mut common: &str = first;
    for line in others {
        let same = common.chars().zip(line.chars()).take_while(|(a, b)| a == b);
        let length = same.map(|(a, _)| a.len_utf8()).sum();
        common = &common[..length];
    }
    Some(common.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn typed(prompt: &mut Prompt, text: &str) {
        text.chars().for_each(|c| prompt.edit(Edit::Insert(c)));
    }

    #[test]
    fn a_line_is_edited() {
        let mut prompt = Prompt::default();
        typed(&mut prompt, "print r0");
        for edit in [Edit::Left, Edit::Backspace, Edit::Insert('c'), Edit::Delete] {
            prompt.edit(edit);
        }
        assert_eq!(prompt.text(), "print c");
        prompt.edit(Edit::DeleteWord);
        assert_eq!(prompt.text(), "print ");
        prompt.edit(Edit::DeleteWord);
        assert_eq!(prompt.text(), "");
        for edit in [
            Edit::Backspace,
            Edit::Delete,
            Edit::Left,
            Edit::Right,
            Edit::DeleteWord,
        ] {
            prompt.edit(edit);
        }
        typed(&mut prompt, "é\u{1b}∞");
        assert_eq!(prompt.text(), "é∞");
        prompt.edit(Edit::Home);
        prompt.edit(Edit::Right);
        assert_eq!(prompt.before_cursor(), "é");
        prompt.edit(Edit::ClearRight);
        assert_eq!(prompt.text(), "é");
    }

    #[test]
    fn what_was_entered_comes_back() {
        let mut prompt = Prompt::default();
        for line in ["next", "next", "print r0"] {
            typed(&mut prompt, line);
            assert_eq!(prompt.enter(), line);
        }
        typed(&mut prompt, "wat");
        let mut recalled = |edit| {
            prompt.edit(edit);
            prompt.text()
        };
        assert_eq!(recalled(Edit::Earlier), "print r0");
        assert_eq!(recalled(Edit::Earlier), "next");
        assert_eq!(recalled(Edit::Earlier), "next");
        assert_eq!(recalled(Edit::Later), "print r0");
        assert_eq!(recalled(Edit::Later), "wat");
        assert_eq!(recalled(Edit::Later), "wat");
    }

    #[test]
    fn tab_fills_in_what_is_certain_then_goes_round() {
        let mut prompt = Prompt::default();
        typed(&mut prompt, "re");
        let lines = |_: &str| vec!["reverse-next".to_string(), "reverse-step".to_string()];
        prompt.complete(lines);
        assert_eq!(prompt.text(), "reverse-");
        assert_eq!(prompt.candidates().len(), 2);
        let mut tab = || {
            prompt.complete(|_| panic!("what was found is remembered"));
            prompt.text()
        };
        assert_eq!(tab(), "reverse-next");
        assert_eq!(tab(), "reverse-step");
        assert_eq!(tab(), "reverse-next");
        prompt.edit(Edit::Insert(' '));
        assert!(prompt.candidates().is_empty());
        prompt.complete(|before| {
            assert_eq!(before, "reverse-next ");
            Vec::new()
        });
        assert_eq!(prompt.text(), "reverse-next ");
    }
}

//! Pages and what becomes of them: lines of text, Markdown.

/// What is said of one thing.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Page {
    /// What the thing is called: `lrp`, `r#`, `_bx2`, `ps.1.4`, `B3`.
    pub name: String,
    /// What it is in a few words, or in the one sentence of a rule.
    pub title: String,
    /// What there is to say, from the most to the least important.
    pub parts: Vec<Part>,
    /// Names of other pages.
    pub see: Vec<String>,
}

/// A part of a page. Texts are plain, with names between backticks only where they come from diagnostics.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Part {
    /// What the parts behind it are about.
    Heading(String),
    /// Sentences.
    Paragraph(String),
    /// Short answers.
    Facts(Vec<Fact>),
    /// A listing, or what stands in one.
    Listing(String),
}

/// A short answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fact {
    /// What is answered: `slots`, `s0`, a token.
    pub label: String,
    /// The answer.
    pub text: String,
}

impl Fact {
    /// The answer `text` to the question `label`.
    pub fn new(label: impl Into<String>, text: impl Into<String>) -> Self {
        Self {
            label: label.into(),
            text: text.into(),
        }
    }
}

/// What a piece of a page is, for those who show it in colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// The name of the page.
    Name,
    /// What heads parts.
    Heading,
    /// What an answer answers.
    Label,
    /// A line of a listing.
    Listing,
    /// Everything else.
    Plain,
}

/// The least width that text is laid out in: room for a label and a word.
pub const LEAST_WIDTH: usize = 32;
/// How far parts behind their heading, and listings, are moved in.
const INDENT: usize = 2;
/// The longest label that the answers of a part are moved behind.
const LABEL: usize = 16;

impl Page {
    pub(super) fn new(name: impl Into<String>, title: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            title: title.into(),
            ..Self::default()
        }
    }

    pub(super) fn heading(&mut self, text: impl Into<String>) {
        self.parts.push(Part::Heading(text.into()));
    }

    /// Adds sentences, if there are any.
    pub(super) fn paragraph(&mut self, text: impl Into<String>) {
        let text = text.into();
        if !text.is_empty() {
            self.parts.push(Part::Paragraph(text));
        }
    }

    /// Adds answers, if there are any.
    pub(super) fn facts(&mut self, facts: Vec<Fact>) {
        if !facts.is_empty() {
            self.parts.push(Part::Facts(facts));
        }
    }

    pub(super) fn listing(&mut self, text: impl Into<String>) {
        self.parts.push(Part::Listing(text.into()));
    }

    /// The page as lines of at most `width` characters, or [`LEAST_WIDTH`] if that is more. Lines of listings are not broken.
    pub fn text(&self, width: usize) -> String {
        self.styled(width, |_, text| text.to_string())
    }

    /// As [`Page::text`], with every piece as `style` makes it look; what `style` adds takes no room.
    pub fn styled(&self, width: usize, style: impl Fn(Role, &str) -> String) -> String {
        let width = width.max(LEAST_WIDTH);
        let mut out = Lines {
            text: String::new(),
            style: &style,
        };
        let head = [&*self.name, &*self.title].join("  ");
        for (i, line) in wrap(&head, width).into_iter().enumerate() {
            match line.strip_prefix(&*self.name) {
                Some(rest) if i == 0 => out.line(&[(Role::Name, &self.name), (Role::Plain, rest)]),
                _ => out.line(&[(Role::Plain, &line)]),
            }
        }
        let mut indent = 0;
        for part in &self.parts {
            out.text.push('\n');
            match part {
                Part::Heading(text) => {
                    indent = INDENT;
                    for line in wrap(text, width) {
                        out.line(&[(Role::Heading, &line)]);
                    }
                    // What it heads follows at once.
                    out.heads();
                }
                Part::Paragraph(text) => {
                    for line in wrap(text, width - indent) {
                        out.line(&[(Role::Plain, &format!("{:indent$}{line}", ""))]);
                    }
                }
                Part::Facts(facts) => out.facts(facts, indent, width),
                Part::Listing(text) => {
                    for line in text.lines() {
                        let line = format!("{:1$}{line}", "", indent + INDENT);
                        out.line(&[(Role::Listing, line.trim_end())]);
                    }
                }
            }
        }
        if !self.see.is_empty() {
            out.text.push('\n');
            let text = format!("See also: {}", self.see.join(", "));
            for line in wrap(&text, width) {
                out.line(&[(Role::Plain, &line)]);
            }
        }
        // A heading takes the empty line behind it away.
        out.text.replace(HEADED, "")
    }

    /// The page in Markdown (CommonMark).
    pub fn markdown(&self) -> String {
        let mut out = format!("### {}  {}\n", code(&self.name), escape(&self.title));
        for part in &self.parts {
            out.push('\n');
            match part {
                Part::Heading(text) => out += &format!("**{}**\n", escape(text)),
                Part::Paragraph(text) => out += &format!("{}\n", escape(text)),
                Part::Facts(facts) => {
                    for Fact { label, text } in facts {
                        out += &format!("- **{}**: {}\n", escape(label), escape(text));
                    }
                }
                Part::Listing(text) => out += &format!("```asm\n{}\n```\n", text.trim_end()),
            }
        }
        if !self.see.is_empty() {
            let names: Vec<String> = self.see.iter().map(|name| code(name)).collect();
            out += &format!("\nSee also: {}\n", names.join(", "));
        }
        out
    }
}

/// Stands at the end of a heading until the page is whole; no text holds it.
const HEADED: &str = "\u{0}\n";

struct Lines<'a, F> {
    text: String,
    style: &'a F,
}

impl<F: Fn(Role, &str) -> String> Lines<'_, F> {
    fn line(&mut self, pieces: &[(Role, &str)]) {
        for (role, text) in pieces.iter().filter(|(_, text)| !text.is_empty()) {
            self.text += &match role {
                Role::Plain => text.to_string(),
                _ => (self.style)(*role, text),
            };
        }
        self.text.push('\n');
    }

    fn heads(&mut self) {
        self.text.push('\u{0}');
    }

    /// Answers behind their labels, all from the same column on.
    fn facts(&mut self, facts: &[Fact], indent: usize, width: usize) {
        let longest = facts.iter().map(|fact| fact.label.chars().count()).max();
        let label = longest.unwrap_or(0).min(LABEL);
        let column = indent + INDENT + label + 2;
        for Fact { label, text } in facts {
            let used = indent + INDENT + label.chars().count();
            let mut lines = wrap(text, width - column).into_iter();
            let before = format!("{:1$}", "", indent + INDENT);
            // A label that is too long has a line for itself.
            if used + 2 <= column {
                let gap = format!("{:1$}", "", column - used);
                let first = lines.next().unwrap_or_default();
                let pieces = [
                    (Role::Plain, &*before),
                    (Role::Label, label),
                    (Role::Plain, &*gap),
                    (Role::Plain, &*first),
                ];
                self.line(&pieces);
            } else {
                for line in wrap(label, width - indent - INDENT) {
                    self.line(&[(Role::Plain, &before), (Role::Label, &line)]);
                }
            }
            for line in lines {
                self.line(&[(Role::Plain, &format!("{:column$}{line}", ""))]);
            }
        }
    }
}

/// The words of a text in lines of at most `width` characters; a word that is longer is cut.
fn wrap(text: &str, width: usize) -> Vec<String> {
    let mut lines = Vec::new();
    let mut line = String::new();
    let mut room = width;
    for (i, word) in text.split(' ').enumerate() {
        let length = word.chars().count();
        if i > 0 {
            if length < room {
                line.push(' ');
                room -= 1;
            } else {
                lines.push(std::mem::take(&mut line));
                room = width;
            }
        }
        for letter in word.chars() {
            if room == 0 {
                lines.push(std::mem::take(&mut line));
                room = width;
            }
            line.push(letter);
            room -= 1;
        }
    }
    lines.push(line);
    for line in &mut lines {
        line.truncate(line.trim_end().len());
    }
    lines
}

/// Text that Markdown shows as it stands, but for what stands between backticks.
fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    // An odd backtick begins nothing.
    let spans = text.matches('`').count() / 2 * 2;
    let mut ticks = 0;
    for letter in text.chars() {
        match letter {
            '`' if ticks < spans => ticks += 1,
            '\\' | '`' | '*' | '_' | '<' | '>' | '[' | ']' | '#' | '|' | '~' | '&'
                if ticks % 2 == 0 =>
            {
                out.push('\\');
            }
            _ => {}
        }
        out.push(letter);
    }
    // At the start of a line these would begin a list.
    match out.chars().next() {
        Some('-' | '+') => format!("\\{out}"),
        _ => out,
    }
}

/// A name between backticks.
fn code(name: &str) -> String {
    format!("`{name}`")
}

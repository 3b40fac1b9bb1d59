//! Tables of a scene file, read key by key, so that every problem of a table is found and each has its place.

use serde::Deserialize;
use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue, ValueDeserializer};

use super::error::{Problems, advice, advice_from, rules};
use crate::diagnostic::Span;

/// A value with its place.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct At<T> {
    pub(crate) value: T,
    pub(crate) span: Span,
}

/// A value of the file as TOML has it, with the key that it stands under.
#[derive(Clone, Debug)]
pub(crate) struct Node<'i> {
    pub(crate) key: String,
    pub(crate) key_span: Span,
    pub(crate) value: Spanned<DeValue<'i>>,
}

/// A list of exactly `N` entries. (`serde` itself takes longer lists for an array and leaves the rest out.)
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Exactly<T, const N: usize>(pub(crate) [T; N]);

impl<'de, T: Deserialize<'de>, const N: usize> Deserialize<'de> for Exactly<T, N> {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let list = Vec::<T>::deserialize(deserializer)?;
        let count = list.len();
        <[T; N]>::try_from(list)
            .map(Self)
            .map_err(|_| serde::de::Error::custom(wrong_count(count, N)))
    }
}

fn wrong_count(count: usize, wanted: usize) -> String {
    format!("there are {count} entries where {wanted} must be")
}

/// A table whose keys are taken out one by one. What is left at the end is unknown.
#[derive(Debug)]
pub(crate) struct Section<'i> {
    /// The table as messages call it, such as `[camera]`.
    pub(crate) title: String,
    /// Where a key that is missing is reported.
    pub(crate) span: Span,
    nodes: Vec<Node<'i>>,
    asked: Vec<&'static str>,
    /// Whether it is the outermost table.
    outermost: bool,
}

/// Reads a name. It may also be written in capitals, with `_` between its words, and as the constant of Direct3D:
/// `srcalpha`, `SrcAlpha`, `src_alpha` and `D3DBLEND_SRCALPHA` are one.
pub(crate) fn parse_name<T: std::str::FromStr>(text: &str) -> Result<T, T::Err> {
    text.parse().or_else(|error| {
        let constant = text.split_once('_').filter(|(prefix, _)| {
            let first = prefix.get(..3);
            first.is_some_and(|first| first.eq_ignore_ascii_case("d3d"))
        });
        let name = constant.map_or(text, |(_, name)| name);
        let plain = name.replace('_', "").to_ascii_lowercase();
        plain.parse().map_err(|_| error)
    })
}

/// What a kind of TOML value is called.
fn kind(value: &DeValue<'_>) -> &'static str {
    match value {
        DeValue::String(_) => "a text",
        DeValue::Integer(_) | DeValue::Float(_) => "a number",
        DeValue::Boolean(_) => "true or false",
        DeValue::Datetime(_) => "a date",
        DeValue::Array(_) => "a list",
        DeValue::Table(_) => "a table",
    }
}

impl<'i> Section<'i> {
    /// A table; `span` is what a missing key is reported at.
    pub(crate) fn new(
        title: impl Into<String>,
        table: DeTable<'i>,
        span: Span,
        problems: &Problems,
    ) -> Self {
        let mut nodes: Vec<_> = table
            .into_iter()
            .map(|(key, value)| Node {
                key_span: problems.span(key.span()),
                key: key.into_inner().into_owned(),
                value,
            })
            .collect();
        // The order of the file.
        nodes.sort_by_key(|node| node.key_span);
        Self {
            title: title.into(),
            span,
            nodes,
            asked: Vec::new(),
            outermost: false,
        }
    }

    /// The outermost table; `title` is what messages call the file.
    pub(crate) fn outermost(
        title: impl Into<String>,
        table: DeTable<'i>,
        problems: &Problems,
    ) -> Self {
        Self {
            outermost: true,
            ..Self::new(title, table, problems.span(0..0), problems)
        }
    }

    /// Takes a value out as it stands in the file.
    pub(crate) fn node(&mut self, key: &'static str) -> Option<Node<'i>> {
        self.asked.push(key);
        let at = self.nodes.iter().position(|node| node.key == key)?;
        Some(self.nodes.remove(at))
    }

    /// Adds entries to the table under a key, in front of those that are there; a name that is there already is told.
    /// If there is no such table, it comes into being at `range`.
    pub(crate) fn add_entries(
        &mut self,
        key: &str,
        entries: DeTable<'i>,
        range: std::ops::Range<usize>,
        problems: &mut Problems,
    ) {
        let Some(node) = self.nodes.iter_mut().find(|node| node.key == key) else {
            self.nodes.push(Node {
                key: key.to_owned(),
                key_span: problems.span(range.clone()),
                value: Spanned::new(range, DeValue::Table(entries)),
            });
            return;
        };
        // A value of another kind is told when it is read.
        let DeValue::Table(table) = node.value.get_mut() else {
            return;
        };
        for (name, entry) in entries {
            if let Some((own, _)) = table.get_key_value(name.get_ref().as_ref()) {
                let message = format!("`{}` is in an included file already", name.get_ref());
                problems.error(&rules::TWICE, problems.span(own.span()), message);
                continue;
            }
            table.insert(name, entry);
        }
    }

    /// Puts entries in front of a list of tables.
    pub(crate) fn put_before(&mut self, key: &str, mut entries: DeArray<'i>) {
        let Some(first) = entries.first().map(Spanned::span) else {
            return;
        };
        let own = self.nodes.iter().position(|node| node.key == key);
        let (key_span, range) = match own.map(|at| self.nodes.remove(at)) {
            Some(node) => {
                let range = node.value.span();
                match node.value.into_inner() {
                    DeValue::Array(list) => list.into_iter().for_each(|entry| entries.push(entry)),
                    // Told when it is read: the list is what there is.
                    other => entries.push(Spanned::new(range.clone(), other)),
                }
                (node.key_span, range)
            }
            None => (self.span, first),
        };
        self.nodes.push(Node {
            key: key.to_owned(),
            key_span,
            value: Spanned::new(range, DeValue::Array(entries)),
        });
    }

    /// The value of a key that is still there.
    pub(crate) fn peek(&self, key: &str) -> Option<&DeValue<'i>> {
        let node = self.nodes.iter().find(|node| node.key == key)?;
        Some(node.value.get_ref())
    }

    /// Whether a key is still there.
    pub(crate) fn has(&self, key: &str) -> bool {
        self.nodes.iter().any(|node| node.key == key)
    }

    /// Whether there are keys left that nobody has asked for.
    pub(crate) fn has_unknown(&self) -> bool {
        !self.nodes.is_empty()
    }

    /// Takes out everything that is left, for tables whose keys are names.
    pub(crate) fn rest(&mut self) -> Vec<Node<'i>> {
        std::mem::take(&mut self.nodes)
    }

    /// Takes a value out, with its place.
    pub(crate) fn at<T: DeserializeOwned>(
        &mut self,
        key: &'static str,
        problems: &mut Problems,
    ) -> Option<At<T>> {
        self.node(key)?.read(problems)
    }

    /// Takes a value out.
    pub(crate) fn get<T: DeserializeOwned>(
        &mut self,
        key: &'static str,
        problems: &mut Problems,
    ) -> Option<T> {
        self.at(key, problems).map(|at| at.value)
    }

    /// Takes a value out, or gives a default.
    pub(crate) fn or<T: DeserializeOwned>(
        &mut self,
        key: &'static str,
        default: T,
        problems: &mut Problems,
    ) -> T {
        self.get(key, problems).unwrap_or(default)
    }

    /// Takes a list of exactly `N` entries out, with its place.
    pub(crate) fn array<T: DeserializeOwned, const N: usize>(
        &mut self,
        key: &'static str,
        problems: &mut Problems,
    ) -> Option<At<[T; N]>> {
        let At { value, span } = self.at::<Exactly<T, N>>(key, problems)?;
        let value = value.0;
        Some(At { value, span })
    }

    /// Takes a list of exactly `N` entries out, or gives a default.
    pub(crate) fn array_or<T: DeserializeOwned, const N: usize>(
        &mut self,
        key: &'static str,
        default: [T; N],
        problems: &mut Problems,
    ) -> [T; N] {
        self.array(key, problems).map_or(default, |at| at.value)
    }

    /// Takes out lists of exactly `N` entries.
    pub(crate) fn arrays<T: DeserializeOwned, const N: usize>(
        &mut self,
        key: &'static str,
        problems: &mut Problems,
    ) -> Option<At<Vec<[T; N]>>> {
        let At { value, span } = self.at::<Vec<Spanned<Vec<T>>>>(key, problems)?;
        let mut lists = Vec::with_capacity(value.len());
        for list in value {
            let place = problems.span(list.span());
            match <[T; N]>::try_from(list.into_inner()) {
                Ok(list) => lists.push(list),
                Err(list) => {
                    let count = list.len();
                    let message = format!("`{key}`: {}", wrong_count(count, N));
                    problems.error(&rules::VALUE, place, message);
                    // One is enough: the others are probably wrong in the same way.
                    return None;
                }
            }
        }
        let value = lists;
        Some(At { value, span })
    }

    /// Takes out a number that must lie in a range.
    pub(crate) fn ranged<T>(
        &mut self,
        key: &'static str,
        range: std::ops::RangeInclusive<T>,
        default: T,
        problems: &mut Problems,
    ) -> T
    where
        T: DeserializeOwned + PartialOrd + std::fmt::Display,
    {
        let Some(At { value, span }) = self.at::<T>(key, problems) else {
            return default;
        };
        if range.contains(&value) {
            return value;
        }
        let message = format!(
            "`{key}` is {value}; it must be {} to {}",
            range.start(),
            range.end()
        );
        problems.error(&rules::VALUE, span, message);
        default
    }

    /// Takes out a text that is one of a set of names.
    pub(crate) fn named<T>(&mut self, key: &'static str, default: T, problems: &mut Problems) -> T
    where
        T: std::str::FromStr,
        T::Err: std::fmt::Display,
    {
        let Some(At { value, span }) = self.at::<String>(key, problems) else {
            return default;
        };
        parse_name(&value).unwrap_or_else(|error: T::Err| {
            problems.error(&rules::VALUE, span, format!("`{key}`: {error}"));
            default
        })
    }

    /// Takes a colour out: a list of its channels, or a number that all of them have. An alpha that is left out is that
    /// of the default.
    pub(crate) fn color_or<const N: usize>(
        &mut self,
        key: &'static str,
        default: [f32; N],
        problems: &mut Problems,
    ) -> [f32; N] {
        match self.peek(key) {
            Some(DeValue::Integer(_) | DeValue::Float(_)) => {
                let channel = self.get(key, problems);
                channel.map_or(default, |channel| [channel; N])
            }
            Some(DeValue::Array(list)) if N == 4 && list.len() == 3 => {
                let given: [f32; 3] = self.array_or(key, [0.0; 3], problems);
                let mut color = default;
                color
                    .iter_mut()
                    .zip(given)
                    .for_each(|(to, from)| *to = from);
                color
            }
            _ => self.array_or(key, default, problems),
        }
    }

    /// Takes out a table within this one.
    pub(crate) fn table(
        &mut self,
        key: &'static str,
        problems: &mut Problems,
    ) -> Option<Section<'i>> {
        let node = self.node(key)?;
        let title = self.inner_title(key);
        node.into_section(title, problems)
    }

    /// What a table within this one is called.
    pub(crate) fn inner_title(&self, key: &str) -> String {
        match self.title.strip_suffix(']') {
            Some(outer) => format!("{outer}.{key}]"),
            None if self.outermost => format!("[{key}]"),
            None => format!("{}, [{key}]", self.title),
        }
    }

    /// Reports that something must be there.
    pub(crate) fn missing(&self, what: &str, problems: &mut Problems) {
        let message = format!("{} needs {what}", self.title);
        problems.error(&rules::MISSING, self.span, message);
    }

    /// Reports every key that nobody asked for.
    pub(crate) fn finish(self, problems: &mut Problems) {
        for node in &self.nodes {
            if problems.full() {
                return;
            }
            let message = format!("{} has no key `{}`", self.title, node.key);
            let help = advice(&node.key, self.asked.iter().copied());
            problems.error_with(&rules::KEY, node.key_span, message, help);
        }
    }
}

impl<'i> Node<'i> {
    /// Where the value stands.
    pub(crate) fn span(&self, problems: &Problems) -> Span {
        problems.span(self.value.span())
    }

    /// The value as a type of ours.
    pub(crate) fn read<T: DeserializeOwned>(self, problems: &mut Problems) -> Option<At<T>> {
        let span = self.span(problems);
        match T::deserialize(ValueDeserializer::from(self.value)) {
            Ok(value) => Some(At { value, span }),
            Err(error) => {
                let place = error.span().map_or(span, |range| problems.span(range));
                let message = format!("`{}`: {}", self.key, error.message());
                let help = advice_from(error.message());
                problems.error_with(&rules::VALUE, place, message, help);
                None
            }
        }
    }

    /// The value as a table.
    pub(crate) fn into_section(
        self,
        title: impl Into<String>,
        problems: &mut Problems,
    ) -> Option<Section<'i>> {
        let span = self.span(problems);
        match self.value.into_inner() {
            DeValue::Table(table) => Some(Section::new(title, table, self.key_span, problems)),
            other => {
                let message = format!("`{}` must be a table, not {}", self.key, kind(&other));
                problems.error(&rules::VALUE, span, message);
                None
            }
        }
    }

    /// The entries of a list, each with the key of the list and the place of its first line. Anything but a list is
    /// refused as not being what is `expected`.
    pub(crate) fn into_list(self, expected: &str, problems: &mut Problems) -> Vec<Node<'i>> {
        if !matches!(self.value.get_ref(), DeValue::Array(_)) {
            self.refuse(expected, problems);
        }
        let DeValue::Array(list) = self.value.into_inner() else {
            return Vec::new();
        };
        list.into_iter()
            .map(|value| Node {
                key: self.key.clone(),
                // The header of a table, without the rest of its lines.
                key_span: match value.span() {
                    range if range.is_empty() => self.key_span,
                    range => problems.span(range),
                },
                value,
            })
            .collect()
    }

    /// The entries of a list of tables; one table without a list is the only one.
    pub(crate) fn into_tables(self, expected: &str, problems: &mut Problems) -> Vec<Node<'i>> {
        match self.value.get_ref() {
            DeValue::Table(_) => vec![self],
            _ => self.into_list(expected, problems),
        }
    }

    /// Reports that the value is of none of the kinds that it may be.
    pub(crate) fn refuse(&self, expected: &str, problems: &mut Problems) {
        let (key, found) = (&self.key, kind(self.value.get_ref()));
        let message = format!("`{key}` must be {expected}, not {found}");
        problems.error(&rules::VALUE, self.span(problems), message);
    }
}

//! The messages of the debug adapter protocol, as far as they are used here: version 1.68 of its published description.
//!
//! `arguments` is what clients send, `types` what they get. Names and meanings are those of the description; a field stands here
//! only if it is read or written.

mod arguments;
mod types;

pub(in crate::servers) use arguments::*;
pub(in crate::servers) use types::*;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

/// A request of the client.
#[derive(Clone, Debug, Deserialize)]
pub(in crate::servers) struct Request {
    /// The client's number of the message.
    pub seq: i64,
    /// What is asked for.
    pub command: String,
    /// With what.
    #[serde(default)]
    pub arguments: Value,
}

impl Request {
    /// The arguments as what they must be.
    ///
    /// # Errors
    /// [`Refusal`] if they are not.
    pub(in crate::servers) fn read<T: DeserializeOwned>(&self) -> Result<T, Refusal> {
        // Some clients leave out arguments that are all optional, some write an empty list for an empty table.
        let nothing = self.arguments.is_null() || self.arguments == json!([]);
        let arguments = match nothing {
            true => json!({}),
            false => self.arguments.clone(),
        };
        serde_json::from_value(arguments)
            .map_err(|error| Refusal::request(format!("{}: {error}", self.command)))
    }
}

/// Why a request is not done.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::servers) struct Refusal {
    /// Its kind; see [`Refusal::request`] and what follows it.
    pub id: i64,
    /// Why, for people.
    pub message: String,
    /// Whether a person should be told although nobody may be looking at the answer.
    pub show: bool,
}

impl Refusal {
    /// The request makes no sense.
    pub(in crate::servers) fn request(message: impl Into<String>) -> Self {
        Self::new(1, message, false)
    }

    /// The program cannot be debugged.
    pub(in crate::servers) fn launch(message: impl Into<String>) -> Self {
        Self::new(2, message, true)
    }

    /// It cannot be done here and now.
    pub(in crate::servers) fn here(message: impl Into<String>) -> Self {
        Self::new(3, message, false)
    }

    /// An expression or a value that a person wrote is wrong.
    pub(in crate::servers) fn text(message: impl Into<String>) -> Self {
        Self::new(4, message, false)
    }

    fn new(id: i64, message: impl Into<String>, show: bool) -> Self {
        let message = message.into();
        Self { id, message, show }
    }
}

/// What the adapter says without being asked.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::servers) struct Event {
    /// Its name.
    pub name: &'static str,
    /// What it says; null: nothing.
    pub body: Value,
}

impl Event {
    /// An event that says something.
    pub(in crate::servers) fn new(name: &'static str, body: &impl Serialize) -> Self {
        let body = value(body);
        Self { name, body }
    }

    /// An event that says nothing but its name.
    pub(in crate::servers) fn bare(name: &'static str) -> Self {
        let body = Value::Null;
        Self { name, body }
    }

    /// A text for the person.
    pub(in crate::servers) fn output(category: Category, text: impl Into<String>) -> Self {
        let output = Output {
            category,
            output: text.into(),
            ..Output::default()
        };
        Self::new("output", &output)
    }
}

/// A body as JSON. What is written here has keys that are texts and no numbers that JSON has not, so that nothing can fail.
pub(in crate::servers) fn value(body: &impl Serialize) -> Value {
    serde_json::to_value(body).unwrap_or_default()
}

/// What comes of a request: its result, then the events that follow from it.
pub(in crate::servers) type Handled = Result<Answer, Refusal>;

/// The result of a request that was done.
#[derive(Debug, Default)]
pub(in crate::servers) struct Answer {
    /// The body of the response; null: none.
    pub body: Value,
    /// What is told behind the response, in order.
    pub events: Vec<Event>,
}

impl Answer {
    /// A result and nothing else.
    pub(in crate::servers) fn of(body: &impl Serialize) -> Self {
        Self::then(body, Vec::new())
    }

    /// A result, and then events.
    pub(in crate::servers) fn then(body: &impl Serialize, events: Vec<Event>) -> Self {
        let body = value(body);
        Self { body, events }
    }

    /// It is done; then events.
    pub(in crate::servers) fn done(events: Vec<Event>) -> Self {
        let body = Value::Null;
        Self { body, events }
    }
}

//! Messages of JSON-RPC 2.0: requests and notifications come in, responses, requests and notifications go out.

use crate::servers::frame::{self, Broken};
use serde::de::DeserializeOwned;
use serde_json::{Value, json};
use std::io::{self, BufRead, Write};
use std::sync::mpsc::{Receiver, sync_channel};

/// How many messages may wait between the stream and the server.
const WAITING: usize = 8;

/// What the client sent.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Incoming {
    /// It waits for an answer.
    Request(Request),
    /// It does not.
    Notification { method: String, params: Value },
    /// An answer to a request of the server.
    Response { id: Value, result: Value },
    /// What is no message, and what to call it; `id` if it seems to be a request.
    Wrong { id: Value, error: Refusal },
}

/// A request of the client.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Request {
    /// A number or a text.
    pub id: Value,
    pub method: String,
    pub params: Value,
}

/// Why a request is not done, with one of the codes of the protocol.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Refusal {
    pub code: i64,
    pub message: String,
}

impl Refusal {
    /// What came is no JSON.
    pub(super) fn no_json(message: impl Into<String>) -> Self {
        Self::new(-32700, message)
    }

    /// What came is no request, or none that can be made now.
    pub(super) fn request(message: impl Into<String>) -> Self {
        Self::new(-32600, message)
    }

    /// There is no such method.
    pub(super) fn method(method: &str) -> Self {
        Self::new(-32601, format!("there is no method `{method}` here"))
    }

    /// The method cannot be called with this.
    pub(super) fn params(message: impl Into<String>) -> Self {
        Self::new(-32602, message)
    }

    /// The server has not been initialized.
    pub(super) fn not_initialized() -> Self {
        Self::new(-32002, "the first request must be `initialize`")
    }

    /// The client does not want it any more.
    pub(super) fn cancelled() -> Self {
        Self::new(-32800, "cancelled")
    }

    /// It cannot be done, and why.
    pub(super) fn failed(message: impl Into<String>) -> Self {
        Self::new(-32803, message)
    }

    fn new(code: i64, message: impl Into<String>) -> Self {
        let message = message.into();
        Self { code, message }
    }
}

/// The parameters of a method as what they must be.
///
/// # Errors
/// [`Refusal`] if they are not.
pub(super) fn read<T: DeserializeOwned>(params: Value) -> Result<T, Refusal> {
    serde_json::from_value(params).map_err(|error| Refusal::params(error.to_string()))
}

/// Reads a stream on a thread of its own, up to its end or to `exit`. What is broken for good ends it.
pub(super) fn listen(mut input: impl BufRead + Send + 'static) -> Receiver<(Incoming, usize)> {
    let (sender, receiver) = sync_channel(WAITING);
    std::thread::spawn(move || {
        loop {
            let (incoming, size, last) = match frame::read(&mut input) {
                Ok(None) => return,
                Ok(Some(bytes)) => {
                    let incoming = incoming(&bytes);
                    let is_exit = |i: &Incoming| matches!(i, Incoming::Notification { method, .. } if method == "exit");
                    let last = is_exit(&incoming);
                    (incoming, bytes.len(), last)
                }
                Err(broken) => {
                    let last = matches!(broken, Broken::Stream(_));
                    let error = Refusal::no_json(broken.to_string());
                    let id = Value::Null;
                    (Incoming::Wrong { id, error }, 0, last)
                }
            };
            if sender.send((incoming, size)).is_err() || last {
                return;
            }
        }
    });
    receiver
}

/// What a message says.
fn incoming(bytes: &[u8]) -> Incoming {
    let wrong = |id: Value, error| Incoming::Wrong { id, error };
    let mut message: Value = match serde_json::from_slice(bytes) {
        Ok(message) => message,
        Err(error) => return wrong(Value::Null, Refusal::no_json(error.to_string())),
    };
    let id = message.get("id").cloned();
    let id_fits = id
        .as_ref()
        .is_none_or(|id| id.is_string() || id.is_i64() || id.is_u64());
    let method = message
        .get("method")
        .map(|m| m.as_str().map(str::to_string));
    let mut take = |name| message.get_mut(name).map_or(Value::Null, Value::take);
    match (method, id) {
        (Some(Some(method)), Some(id)) if id_fits => Incoming::Request(Request {
            id,
            method,
            params: take("params"),
        }),
        (Some(Some(method)), None) => Incoming::Notification {
            method,
            params: take("params"),
        },
        (None, Some(id)) if id_fits => Incoming::Response {
            id,
            result: take("result"),
        },
        (_, id) => {
            let id = id.filter(|_| id_fits).unwrap_or_default();
            wrong(id, Refusal::request("this is no message of JSON-RPC 2.0"))
        }
    }
}

/// Where messages go out.
pub(super) struct Outgoing<W> {
    output: W,
    /// How many requests were sent.
    requests: u64,
}

impl<W: Write> Outgoing<W> {
    pub(super) fn new(output: W) -> Self {
        Self {
            output,
            requests: 0,
        }
    }

    /// Answers a request.
    ///
    /// # Errors
    /// What the output says.
    pub(super) fn respond(&mut self, id: &Value, result: Result<Value, Refusal>) -> io::Result<()> {
        self.send(match result {
            Ok(result) => json!({ "jsonrpc": "2.0", "id": id, "result": result }),
            Err(Refusal { code, message }) => {
                json!({ "jsonrpc": "2.0", "id": id, "error": { "code": code, "message": message } })
            }
        })
    }

    /// Sends a notification.
    ///
    /// # Errors
    /// What the output says.
    pub(super) fn notify(&mut self, method: &str, params: Value) -> io::Result<()> {
        self.send(json!({ "jsonrpc": "2.0", "method": method, "params": params }))
    }

    /// Sends a request; gives its number, which the response will have.
    ///
    /// # Errors
    /// What the output says.
    pub(super) fn request(&mut self, method: &str, params: Value) -> io::Result<Value> {
        self.requests += 1;
        let id = json!(self.requests);
        self.send(json!({ "jsonrpc": "2.0", "id": id, "method": method, "params": params }))?;
        Ok(id)
    }

    fn send(&mut self, message: Value) -> io::Result<()> {
        frame::write(&mut self.output, message.to_string().as_bytes())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_are_told_apart_by_what_they_have() {
        let read = |text: &str| incoming(text.as_bytes());
        let request = read(r#"{"jsonrpc":"2.0","id":"a","method":"m","params":[1]}"#);
        assert_eq!(
            request,
            Incoming::Request(Request {
                id: json!("a"),
                method: "m".into(),
                params: json!([1]),
            })
        );
        let notification = read(r#"{"method":"m"}"#);
        assert!(matches!(notification, Incoming::Notification { params, .. } if params.is_null()));
        let response = read(r#"{"id":7,"result":null}"#);
        assert!(matches!(response, Incoming::Response { id, .. } if id == 7));
    }

    #[test]
    fn what_is_no_message_is_refused_with_the_code_of_the_protocol() {
        for (text, code, id) in [
            ("{", -32700, Value::Null),
            ("[]", -32600, Value::Null),
            ("7", -32600, Value::Null),
            (r#"{"id":{},"method":"m"}"#, -32600, Value::Null),
            (r#"{"id":1,"method":3}"#, -32600, json!(1)),
            ("{}", -32600, Value::Null),
        ] {
            match incoming(text.as_bytes()) {
                Incoming::Wrong { id: of, error } => {
                    assert_eq!((error.code, of), (code, id), "{text}");
                }
                other => panic!("{text}: {other:?}"),
            }
        }
    }
}

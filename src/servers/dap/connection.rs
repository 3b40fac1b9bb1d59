//! The client at the other end: requests come in, responses and events go out, numbered.

use super::protocol::{Category, Event, Handled, Request};
use crate::servers::frame::{self, Broken};
use serde_json::{Value, json};
use std::io::{self, BufRead, Write};

/// A stream in each direction.
pub(super) struct Connection<R, W> {
    input: R,
    output: W,
    /// How many messages were sent.
    sent: i64,
}

impl<R: BufRead, W: Write> Connection<R, W> {
    pub(super) fn new(input: R, output: W) -> Self {
        Self {
            input,
            output,
            sent: 0,
        }
    }

    /// The next request; `None` when there is nothing more to come. What is no request is told to the person and passed over.
    ///
    /// # Errors
    /// What the output says.
    pub(super) fn next(&mut self) -> io::Result<Option<Request>> {
        loop {
            let why = match frame::read(&mut self.input) {
                Ok(None) => return Ok(None),
                Ok(Some(bytes)) => match request(&bytes) {
                    Ok(Some(request)) => return Ok(Some(request)),
                    Ok(None) => continue,
                    Err(why) => why,
                },
                Err(Broken::Message(why)) => why,
                Err(broken @ Broken::Stream(_)) => {
                    self.tell_broken(&broken.to_string())?;
                    return Ok(None);
                }
            };
            self.tell_broken(&why)?;
        }
    }

    fn tell_broken(&mut self, why: &str) -> io::Result<()> {
        let text = format!("the client sent what is no message: {why}\n");
        self.tell(&Event::output(Category::Stderr, text))
    }

    /// Responds to a request, and tells what follows from it. Says whether the request was done.
    ///
    /// # Errors
    /// What the output says.
    pub(super) fn respond(&mut self, request: &Request, handled: Handled) -> io::Result<bool> {
        let mut response = json!({
            "type": "response",
            "request_seq": request.seq,
            "success": handled.is_ok(),
            "command": request.command,
        });
        let (body, events, done) = match handled {
            Ok(answer) => (answer.body, answer.events, true),
            Err(refusal) => {
                response["message"] = json!(refusal.message);
                let error = json!({
                    "id": refusal.id,
                    "format": refusal.message,
                    "showUser": refusal.show,
                });
                (json!({ "error": error }), Vec::new(), false)
            }
        };
        if !body.is_null() {
            response["body"] = body;
        }
        self.send(response)?;
        for event in &events {
            self.tell(event)?;
        }
        Ok(done)
    }

    /// Sends an event.
    ///
    /// # Errors
    /// What the output says.
    pub(super) fn tell(&mut self, event: &Event) -> io::Result<()> {
        let mut message = json!({ "type": "event", "event": event.name });
        if !event.body.is_null() {
            message["body"] = event.body.clone();
        }
        self.send(message)
    }

    fn send(&mut self, mut message: Value) -> io::Result<()> {
        self.sent += 1;
        message["seq"] = json!(self.sent);
        frame::write(&mut self.output, message.to_string().as_bytes())
    }
}

/// Reads a message; `None` if it is no request and nothing is to be said about it.
fn request(bytes: &[u8]) -> Result<Option<Request>, String> {
    let message: Value = serde_json::from_slice(bytes).map_err(|error| error.to_string())?;
    match message.get("type").and_then(Value::as_str) {
        Some("request") => {}
        // The adapter asks nothing, so that nothing waits for an answer.
        Some("response" | "event") => return Ok(None),
        _ => return Err("it has no `type` of the protocol".to_string()),
    }
    let request = serde_json::from_value(message).map_err(|error| error.to_string())?;
    Ok(Some(request))
}

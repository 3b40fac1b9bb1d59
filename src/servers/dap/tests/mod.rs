//! Whole conversations, in the process.

mod listing;
mod robust;
mod scene;

use super::{Tools, serve};
use crate::servers::frame;
use serde_json::{Value, json};
use std::path::PathBuf;
use std::sync::atomic::{AtomicU32, Ordering};
use texcrd::diagnostic::{Diagnostic, SourceMap};

/// A client that asks one thing after the other. The adapter is asked everything again each time: it says the same again.
struct Client {
    requests: Vec<Value>,
    /// How many messages came so far.
    heard: usize,
}

/// What came of a request.
struct Heard {
    response: Value,
    events: Vec<Value>,
}

impl Client {
    /// A client that says hello.
    fn new() -> Self {
        Self::like(json!({ "adapterID": "texcrd", "supportsVariableType": true }))
    }

    fn like(arguments: Value) -> Self {
        let mut client = Self {
            requests: Vec::new(),
            heard: 0,
        };
        assert_eq!(
            client.ask("initialize", arguments).response["success"],
            true
        );
        client
    }

    fn ask(&mut self, command: &str, arguments: Value) -> Heard {
        let seq = self.requests.len() + 1;
        let request =
            json!({ "seq": seq, "type": "request", "command": command, "arguments": arguments });
        self.requests.push(request);
        let all = messages(&said(&stream(&self.requests)));
        let new = all.get(self.heard..).unwrap().to_vec();
        self.heard = all.len();
        let is_it = |m: &Value| m["type"] == "response" && m["request_seq"] == seq;
        let response = new.iter().find(|m| is_it(m)).cloned().unwrap();
        let events = new.into_iter().filter(|m| m["type"] == "event").collect();
        Heard { response, events }
    }

    /// What is asked for is done.
    fn done(&mut self, command: &str, arguments: Value) -> Heard {
        let heard = self.ask(command, arguments);
        assert_eq!(
            heard.response["success"], true,
            "{command}: {}",
            heard.response
        );
        heard
    }

    /// What is asked for is refused, with these words among others.
    fn refused(&mut self, command: &str, arguments: Value, words: &str) {
        let response = self.ask(command, arguments).response;
        assert_eq!(response["success"], false, "{command}");
        let message = response["message"].as_str().unwrap();
        assert!(message.contains(words), "{message}");
        assert_eq!(response["body"]["error"]["format"], message);
    }

    fn body(&mut self, command: &str, arguments: Value) -> Value {
        self.done(command, arguments).response["body"].clone()
    }

    /// Launches and configures nothing else; the events of both.
    fn launched(&mut self, arguments: Value) -> Vec<Value> {
        let mut events = self.done("launch", arguments).events;
        events.extend(self.done("configurationDone", json!({})).events);
        events
    }

    /// Line of the first frame, and its name.
    fn place(&mut self) -> (i64, String) {
        let body = self.body("stackTrace", json!({ "threadId": 1 }));
        let frame = &body["stackFrames"][0];
        (frame["line"].as_i64().unwrap(), text(&frame["name"]))
    }

    /// The reference of a scope of the first frame.
    fn scope(&mut self, name: &str) -> i64 {
        let frame =
            self.body("stackTrace", json!({ "threadId": 1 }))["stackFrames"][0]["id"].clone();
        let scopes = self.body("scopes", json!({ "frameId": frame }));
        let scopes = scopes["scopes"].as_array().unwrap().clone();
        let scope = scopes.iter().find(|scope| scope["name"] == name);
        scope.unwrap()["variablesReference"].as_i64().unwrap()
    }

    /// Names and values of a container.
    fn values(&mut self, reference: i64) -> Vec<(String, String)> {
        let body = self.body("variables", json!({ "variablesReference": reference }));
        let variables = body["variables"].as_array().unwrap();
        let pair = |variable: &Value| (text(&variable["name"]), text(&variable["value"]));
        variables.iter().map(pair).collect()
    }

    /// The value of a variable of a scope of the first frame.
    fn value(&mut self, scope: &str, name: &str) -> String {
        let reference = self.scope(scope);
        let values = self.values(reference);
        values
            .into_iter()
            .find(|(other, _)| other == name)
            .unwrap()
            .1
    }

    /// The value of an expression, as a watch shows it.
    fn watch(&mut self, expression: &str) -> String {
        let arguments = json!({ "expression": expression, "context": "watch" });
        text(&self.body("evaluate", arguments)["result"])
    }
}

impl Heard {
    /// The names of the events, with the reason where they give one.
    fn told(&self) -> Vec<String> {
        told(&self.events)
    }
}

fn told(events: &[Value]) -> Vec<String> {
    let name = |event: &Value| match event["body"]["reason"].as_str() {
        Some(reason) => format!("{}: {reason}", text(&event["event"])),
        None => text(&event["event"]),
    };
    events.iter().map(name).collect()
}

fn text(value: &Value) -> String {
    value.as_str().unwrap().to_string()
}

/// What the adapter says to a stream of bytes.
fn said(input: &[u8]) -> Vec<u8> {
    let mut output = Vec::new();
    let write = |_: &std::path::Path, _: &[u8]| Err("tests write nothing".to_string());
    serve(input, &mut output, Tools { rendered, write }).unwrap();
    output
}

fn rendered(sources: &SourceMap, diagnostic: &Diagnostic, _: bool) -> String {
    let line = sources.locate(diagnostic.span).map_or(0, |at| at.line);
    format!("line {line}: {}\n", diagnostic.message)
}

fn stream(requests: &[Value]) -> Vec<u8> {
    let mut stream = Vec::new();
    for request in requests {
        frame::write(&mut stream, request.to_string().as_bytes()).unwrap();
    }
    stream
}

/// The messages of a stream; their numbers count from 1.
fn messages(mut stream: &[u8]) -> Vec<Value> {
    let mut messages: Vec<Value> = Vec::new();
    while let Some(message) = frame::read(&mut stream).unwrap() {
        messages.push(serde_json::from_slice(&message).unwrap());
        assert_eq!(messages.last().unwrap()["seq"], messages.len());
    }
    messages
}

/// A folder with files, gone when it is dropped.
struct Folder(PathBuf);

impl Folder {
    fn new(files: &[(&str, &str)]) -> Self {
        static NUMBER: AtomicU32 = AtomicU32::new(0);
        let number = NUMBER.fetch_add(1, Ordering::Relaxed);
        let name = format!("texcrd-dap-{}-{number}", std::process::id());
        let folder = Self(std::env::temp_dir().join(name));
        std::fs::create_dir_all(&folder.0).unwrap();
        for (name, text) in files {
            folder.write(name, text);
        }
        folder
    }

    fn write(&self, name: &str, text: &str) {
        std::fs::write(self.0.join(name), text).unwrap();
    }

    fn path(&self, name: &str) -> String {
        self.0.join(name).display().to_string()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

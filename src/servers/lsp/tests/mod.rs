//! Whole conversations with a server on a thread.

mod completion;
mod features;
mod lifecycle;
mod robust;

use super::{serve, uri};
use crate::servers::frame;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::io::{self, BufReader, PipeReader, PipeWriter};
use std::thread::JoinHandle;

/// The address of the document that most tests have open.
const DOCUMENT: &str = "file:///shaders/a.psh";

/// A client that talks to a server.
struct Client {
    input: Option<PipeWriter>,
    output: BufReader<PipeReader>,
    server: JoinHandle<io::Result<bool>>,
    requests: i64,
    versions: BTreeMap<String, i64>,
    /// The document that [`Client::at`] and [`Client::of`] ask about.
    document: String,
    /// What the server said of its own accord.
    heard: Vec<Value>,
}

/// What most clients can do.
fn able() -> Value {
    json!({
        "workspace": { "workspaceEdit": { "documentChanges": true } },
        "textDocument": {
            "hover": { "contentFormat": ["markdown", "plaintext"] },
            "completion": { "completionItem": { "snippetSupport": true } },
            "codeAction": { "codeActionLiteralSupport": { "codeActionKind": { "valueSet": [] } } },
            "documentSymbol": { "hierarchicalDocumentSymbolSupport": true },
            "publishDiagnostics": { "relatedInformation": true, "versionSupport": true },
        },
    })
}

impl Client {
    /// A client that has not said anything.
    fn silent() -> Self {
        let (from_client, input) = io::pipe().unwrap();
        let (output, to_client) = io::pipe().unwrap();
        let server = std::thread::spawn(move || serve(BufReader::new(from_client), to_client));
        Self {
            input: Some(input),
            output: BufReader::new(output),
            server,
            requests: 0,
            versions: BTreeMap::new(),
            document: DOCUMENT.to_string(),
            heard: Vec::new(),
        }
    }

    /// A client that has said hello, with these options and capabilities.
    fn like(options: Value, capabilities: Value) -> Self {
        let mut client = Self::silent();
        let params = json!({
            "processId": null,
            "rootUri": "file:///shaders",
            "capabilities": capabilities,
            "initializationOptions": options,
        });
        client.ask("initialize", params);
        client.notify("initialized", json!({}));
        client
    }

    fn new() -> Self {
        Self::like(Value::Null, able())
    }

    /// A client that has a document open.
    fn with(text: &str) -> Self {
        let mut client = Self::new();
        client.open(DOCUMENT, "d3d8asm", text);
        client
    }

    fn send(&mut self, message: &Value) {
        let input = self.input.as_mut().unwrap();
        frame::write(input, message.to_string().as_bytes()).unwrap();
    }

    fn receive(&mut self) -> Option<Value> {
        let message = frame::read(&mut self.output).unwrap()?;
        Some(serde_json::from_slice(&message).unwrap())
    }

    /// Sends a request and waits for what comes of it.
    fn answer(&mut self, method: &str, params: Value) -> Value {
        self.requests += 1;
        let id = self.requests;
        self.send(&json!({ "jsonrpc": "2.0", "id": id, "method": method, "params": params }));
        self.response(&json!(id))
    }

    /// Waits for the answer to a request.
    fn response(&mut self, id: &Value) -> Value {
        loop {
            let message = self.receive().unwrap();
            if message.get("method").is_none() && &message["id"] == id {
                return message;
            }
            self.heard.push(message);
        }
    }

    /// What a request that is done gives.
    fn ask(&mut self, method: &str, params: Value) -> Value {
        let answer = self.answer(method, params);
        assert!(answer.get("error").is_none(), "{method}: {answer}");
        answer["result"].clone()
    }

    /// The code of the error of a request that is not done.
    fn refused(&mut self, method: &str, params: Value) -> i64 {
        let answer = self.answer(method, params);
        answer["error"]["code"]
            .as_i64()
            .unwrap_or_else(|| panic!("{method}: {answer}"))
    }

    fn notify(&mut self, method: &str, params: Value) {
        self.send(&json!({ "jsonrpc": "2.0", "method": method, "params": params }));
    }

    fn open(&mut self, uri: &str, language: &str, text: &str) {
        self.versions.insert(uri.to_string(), 1);
        let document = json!({ "uri": uri, "languageId": language, "version": 1, "text": text });
        self.notify("textDocument/didOpen", json!({ "textDocument": document }));
    }

    fn change(&mut self, uri: &str, changes: Value) {
        let version = self.versions.get_mut(uri).unwrap();
        *version += 1;
        let document = json!({ "uri": uri, "version": *version });
        let params = json!({ "textDocument": document, "contentChanges": changes });
        self.notify("textDocument/didChange", params);
    }

    /// Waits for what is told of the last version of an open document; of others for what is told next.
    fn diagnostics(&mut self, uri: &str) -> Vec<Value> {
        let version = self.versions.get(uri).copied();
        let fits = |message: &Value| {
            let params = &message["params"];
            message["method"] == "textDocument/publishDiagnostics"
                && params["uri"] == uri
                && version.is_none_or(|version| params["version"] == version)
        };
        loop {
            if let Some(at) = self.heard.iter().position(fits) {
                let message = self.heard.remove(at);
                return message["params"]["diagnostics"].as_array().unwrap().clone();
            }
            let message = self.receive().unwrap();
            self.heard.push(message);
        }
    }

    /// Asks about a place of the document.
    fn at(&mut self, method: &str, line: u32, character: u32) -> Value {
        let params = json!({
            "textDocument": { "uri": self.document },
            "position": { "line": line, "character": character },
            "context": { "includeDeclaration": true },
        });
        self.ask(&format!("textDocument/{method}"), params)
    }

    /// Asks about all of the document.
    fn of(&mut self, method: &str) -> Value {
        let params = json!({ "textDocument": { "uri": self.document }, "options": {} });
        self.ask(&format!("textDocument/{method}"), params)
    }

    /// Says goodbye; what the server made of it.
    fn leave(mut self) -> bool {
        self.ask("shutdown", Value::Null);
        self.notify("exit", Value::Null);
        self.gone()
    }

    /// Waits for the end of the server.
    fn gone(mut self) -> bool {
        self.input = None;
        while self.receive().is_some() {}
        self.server.join().unwrap().unwrap()
    }
}

/// `line:character-line:character` of a range.
fn range(range: &Value) -> String {
    let at = |end: &str| format!("{}:{}", range[end]["line"], range[end]["character"]);
    format!("{}-{}", at("start"), at("end"))
}

/// Code, severity and range of diagnostics.
fn told(diagnostics: &[Value]) -> Vec<String> {
    let one = |d: &Value| {
        format!(
            "{} {} {}",
            d["code"].as_str().unwrap(),
            d["severity"],
            range(&d["range"])
        )
    };
    diagnostics.iter().map(one).collect()
}

/// The text with edits in it, of UTF-16 places in ASCII.
fn applied(text: &str, edits: &Value) -> String {
    let lines: Vec<usize> = std::iter::once(0)
        .chain(text.match_indices('\n').map(|(at, _)| at + 1))
        .collect();
    let offset = |place: &Value| {
        lines[place["line"].as_u64().unwrap() as usize]
            + place["character"].as_u64().unwrap() as usize
    };
    let mut edits: Vec<&Value> = edits.as_array().unwrap().iter().collect();
    edits.sort_by_key(|edit| std::cmp::Reverse(offset(&edit["range"]["start"])));
    let mut text = text.to_string();
    for edit in edits {
        let (start, end) = (
            offset(&edit["range"]["start"]),
            offset(&edit["range"]["end"]),
        );
        text.replace_range(start..end, edit["newText"].as_str().unwrap());
    }
    text
}

/// A folder with files, gone when it is dropped.
struct Folder(std::path::PathBuf);

impl Folder {
    fn new(files: &[(&str, &[u8])]) -> Self {
        static NUMBER: std::sync::atomic::AtomicU32 = std::sync::atomic::AtomicU32::new(0);
        let number = NUMBER.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
        let name = format!("texcrd-lsp-{}-{number}", std::process::id());
        let folder = Self(std::env::temp_dir().join(name));
        std::fs::create_dir_all(&folder.0).unwrap();
        for (name, text) in files {
            std::fs::write(folder.0.join(name), text).unwrap();
        }
        folder
    }

    /// The address of a file in it.
    fn uri(&self, name: &str) -> String {
        uri::of_path(&self.0.join(name))
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

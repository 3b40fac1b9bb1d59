//! The language server: `texcrd lsp`, the language server protocol 3.17 on a pair of streams.
//!
//! The library reads listings and knows what is wrong with them; the server keeps the texts that a client has open and says
//! where in them things stand. It reads a document when something is asked of it, or when nothing more is waiting, so that
//! typing never waits for what nobody will see. All requests are answered in their order, on one thread; another one reads the
//! stream, so that what is cancelled while it waits is not done.
//!
//! Files: `message` (JSON-RPC), `client` (what the client can do), `settings`, `documents` (open texts) with `text` (places) and
//! `uri`, `analysis` (a document, read) with `publish` (what is wrong with it), `requests` (what is asked for), and what is asked for by
//! kinds: `hover`, `complete` and `signature` with `words`, `navigate` with `registers`, `macros` and `directives`, `outline`,
//! `hints`, `actions`.

mod actions;
mod analysis;
mod client;
mod complete;
mod directives;
mod documents;
mod hints;
mod hover;
mod macros;
mod message;
mod navigate;
mod outline;
mod publish;
mod registers;
mod requests;
mod settings;
mod signature;
#[cfg(test)]
mod tests;
mod text;
mod uri;
mod words;

use analysis::{Analysis, World};
use client::Client;
use documents::{Change, Documents, Opened};
use message::{Incoming, Outgoing, Refusal, Request, listen, read};
use serde::Deserialize;
use serde_json::{Value, json};
use settings::Settings;
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet, HashMap, VecDeque};
use std::io::{self, BufRead, Write};
use std::rc::Rc;
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::time::Duration;

/// How much may wait to be handled, in bytes of messages, before the stream is left waiting.
const MOST_WAITING: usize = 32 << 20;

/// From which length on a document is only read when the client has been still for a moment, in bytes.
const LONG: usize = 64 << 10;
const A_MOMENT: Duration = Duration::from_millis(300);

/// Serves a client until it says `exit`, or goes away. Whether it has gone as the protocol wants it: after `shutdown`.
///
/// # Errors
/// What the output says.
pub(crate) fn serve(input: impl BufRead + Send + 'static, output: impl Write) -> io::Result<bool> {
    let mut server = Server {
        output: Outgoing::new(output),
        state: State::new(),
        phase: Phase::Silent,
        configuration: None,
        published: HashMap::new(),
    };
    let mut waiting = Waiting::new(listen(input));
    while let Some(incoming) = waiting.next(&mut server)? {
        if server.handle(incoming)? == Go::Away {
            break;
        }
    }
    Ok(server.phase == Phase::ShutDown)
}

/// Messages that have come and are not handled yet.
struct Waiting {
    receiver: Receiver<(Incoming, usize)>,
    queue: VecDeque<(Incoming, usize)>,
    bytes: usize,
    ended: bool,
}

impl Waiting {
    fn new(receiver: Receiver<(Incoming, usize)>) -> Self {
        Self {
            receiver,
            queue: VecDeque::new(),
            bytes: 0,
            ended: false,
        }
    }

    /// The next message; `None` if there is none any more. While there is none yet, documents are read.
    fn next<W: Write>(&mut self, server: &mut Server<W>) -> io::Result<Option<Incoming>> {
        loop {
            while self.bytes < MOST_WAITING && !self.ended {
                match self.receiver.try_recv() {
                    Ok(message) => self.push(message, server)?,
                    Err(std::sync::mpsc::TryRecvError::Empty) => break,
                    Err(std::sync::mpsc::TryRecvError::Disconnected) => self.ended = true,
                }
            }
            if let Some((message, size)) = self.queue.pop_front() {
                self.bytes -= size;
                return Ok(Some(message));
            }
            if self.ended {
                server.publish_all()?;
                return Ok(None);
            }
            let Some(patience) = server.state.patience() else {
                match self.receiver.recv() {
                    Ok(message) => self.push(message, server)?,
                    Err(_) => self.ended = true,
                }
                continue;
            };
            match self.receiver.recv_timeout(patience) {
                Ok(message) => self.push(message, server)?,
                Err(RecvTimeoutError::Timeout) => server.publish_one()?,
                Err(RecvTimeoutError::Disconnected) => self.ended = true,
            }
        }
    }

    /// Takes a message. What it cancels is answered now.
    fn push<W: Write>(
        &mut self,
        message: (Incoming, usize),
        server: &mut Server<W>,
    ) -> io::Result<()> {
        if let Incoming::Notification { method, params } = &message.0
            && method == "$/cancelRequest"
        {
            let id = params.get("id").cloned().unwrap_or_default();
            let is_it = |m: &(Incoming, usize)| matches!(&m.0, Incoming::Request(r) if r.id == id);
            if let Some(at) = self.queue.iter().position(is_it)
                && let Some((_, size)) = self.queue.remove(at)
            {
                self.bytes -= size;
                server.output.respond(&id, Err(Refusal::cancelled()))?;
            }
            return Ok(());
        }
        self.bytes += message.1;
        self.queue.push_back(message);
        Ok(())
    }
}

/// How far the conversation is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Phase {
    /// `initialize` has not come.
    Silent,
    Talking,
    ShutDown,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Go {
    On,
    Away,
}

struct Server<W> {
    output: Outgoing<W>,
    state: State,
    phase: Phase,
    /// The number of the request for the configuration that waits for its answer.
    configuration: Option<Value>,
    /// What was told of each text, by the document that it was found in.
    published: HashMap<String, BTreeMap<String, Vec<Value>>>,
}

/// What the server knows.
pub(super) struct State {
    client: Client,
    settings: Settings,
    documents: Documents,
    analyses: RefCell<HashMap<String, Rc<Analysis>>>,
    /// Documents of which has to be told what is wrong with them.
    stale: BTreeSet<String>,
}

impl State {
    fn new() -> Self {
        Self {
            client: Client::default(),
            settings: Settings::default(),
            documents: Documents::default(),
            analyses: RefCell::default(),
            stale: BTreeSet::new(),
        }
    }

    fn world(&self) -> World<'_> {
        World {
            documents: &self.documents,
            settings: &self.settings,
            folder: self.client.folder.as_deref(),
        }
    }

    /// What is known of a document that is open.
    fn analysis(&self, uri: &str) -> Option<Rc<Analysis>> {
        if let Some(known) = self.analyses.borrow().get(uri) {
            return Some(Rc::clone(known));
        }
        let document = self.documents.get(uri).filter(|document| !document.lost)?;
        let analysis = Rc::new(self.world().analyse(document));
        let mut analyses = self.analyses.borrow_mut();
        analyses.insert(uri.to_string(), Rc::clone(&analysis));
        Some(analysis)
    }

    /// A document has changed: what is known of it and of those that include it is no more. Where a file comes or goes, all
    /// that include anything may find something else.
    fn forget(&mut self, uri: &str, comes_or_goes: bool) {
        self.stale.insert(uri.to_string());
        let stale = &mut self.stale;
        self.analyses.get_mut().retain(|address, analysis| {
            let names = analysis.included.values().any(|included| included == uri);
            let keep = address != uri && !names && !(comes_or_goes && analysis.includes);
            if !keep {
                stale.insert(address.clone());
            }
            keep
        });
    }

    /// Nothing is known any more.
    fn forget_all(&mut self) {
        self.analyses.get_mut().clear();
        self.stale.extend(self.documents.uris().map(str::to_string));
    }

    /// How long to wait for a message before a document is read; `None` if none has to be.
    fn patience(&self) -> Option<Duration> {
        let uri = self.stale.first()?;
        let length = self
            .documents
            .get(uri)
            .map_or(0, |document| document.text.len());
        Some(if length > LONG {
            A_MOMENT
        } else {
            Duration::ZERO
        })
    }

    /// Whether another document includes this one, which is no shader by itself then.
    fn is_part(&self, uri: &str) -> bool {
        let analyses = self.analyses.borrow();
        let shaders = analyses
            .get(uri)
            .is_some_and(|own| own.shaders.iter().any(|s| s.program.is_some()));
        let included = |(other, analysis): (&String, &Rc<Analysis>)| {
            other != uri && analysis.included.values().any(|included| included == uri)
        };
        !shaders && analyses.iter().any(included)
    }
}

#[derive(Deserialize)]
struct Identifier {
    uri: String,
    #[serde(default)]
    version: i64,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct DidOpen {
    text_document: Opened,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct DidChange {
    text_document: Identifier,
    content_changes: Vec<Change>,
}

/// What names only a document.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Named {
    text_document: Identifier,
}

impl<W: Write> Server<W> {
    fn handle(&mut self, incoming: Incoming) -> io::Result<Go> {
        match incoming {
            Incoming::Request(request) => self.request(request)?,
            Incoming::Notification { method, .. } if method == "exit" => return Ok(Go::Away),
            Incoming::Notification { method, params } if self.phase == Phase::Talking => {
                self.notification(&method, params)?;
            }
            // The protocol has them dropped.
            Incoming::Notification { .. } => {}
            Incoming::Response { id, result } => {
                if self.configuration.as_ref() == Some(&id) {
                    self.configuration = None;
                    self.configure(result.get(0).unwrap_or(&Value::Null))?;
                }
            }
            Incoming::Wrong { id, error } => self.output.respond(&id, Err(error))?,
        }
        Ok(Go::On)
    }

    fn request(&mut self, request: Request) -> io::Result<()> {
        let Request { id, method, params } = request;
        let result = match (self.phase, method.as_str()) {
            (Phase::Silent, "initialize") => return self.initialize(&id, &params),
            (Phase::Silent, _) => Err(Refusal::not_initialized()),
            (Phase::Talking, "shutdown") => {
                self.phase = Phase::ShutDown;
                Ok(Value::Null)
            }
            (Phase::Talking, "initialize") => Err(Refusal::request("`initialize` comes only once")),
            (Phase::Talking, _) => self.state.request(&method, params),
            (Phase::ShutDown, _) => Err(Refusal::request("the server has been shut down")),
        };
        self.output.respond(&id, result)
    }

    fn initialize(&mut self, id: &Value, params: &Value) -> io::Result<()> {
        self.phase = Phase::Talking;
        self.state.client = Client::new(params);
        self.state.documents.encoding = self.state.client.encoding;
        self.output.respond(id, Ok(self.state.client.greeting()))?;
        let options = params.get("initializationOptions").unwrap_or(&Value::Null);
        self.configure(options)
    }

    fn notification(&mut self, method: &str, params: Value) -> io::Result<()> {
        let done = match method {
            "initialized" => return self.begin(),
            "workspace/didChangeConfiguration" => return self.reconfigure(&params),
            "workspace/didChangeWatchedFiles" => {
                self.state.forget_all();
                Ok(())
            }
            "textDocument/didOpen" => read::<DidOpen>(params).map(|opened| {
                let uri = opened.text_document.uri().to_string();
                self.state.documents.open(opened.text_document);
                self.state.forget(&uri, true);
            }),
            "textDocument/didChange" => read::<DidChange>(params).and_then(|changed| {
                let Identifier { uri, version } = changed.text_document;
                let done = self
                    .state
                    .documents
                    .change(&uri, version, changed.content_changes);
                self.state.forget(&uri, false);
                done
            }),
            // What others include is read from the disk when nobody has it open.
            "textDocument/didSave" => read::<Named>(params).map(|saved| {
                self.state.forget(&saved.text_document.uri, true);
            }),
            "textDocument/didClose" => match read::<Named>(params) {
                Ok(closed) => return self.close(&closed.text_document.uri),
                Err(refusal) => Err(refusal),
            },
            // Others need no answer.
            _ => Ok(()),
        };
        match done {
            Ok(()) => Ok(()),
            Err(refusal) => self.tell(&format!("{method}: {}", refusal.message)),
        }
    }

    /// The client is ready to be asked.
    fn begin(&mut self) -> io::Result<()> {
        if self.state.client.watches {
            let watcher = json!({ "globPattern": "**/*.{h,inc,i,vsi,psi,vsh,psh,vsa,psa,nvv,nvp,fx,fxh,txt}" });
            let registration = json!({
                "id": "watch",
                "method": "workspace/didChangeWatchedFiles",
                "registerOptions": { "watchers": [watcher] },
            });
            let params = json!({ "registrations": [registration] });
            self.output.request("client/registerCapability", params)?;
        }
        self.ask_configuration()
    }

    fn ask_configuration(&mut self) -> io::Result<()> {
        if self.state.client.configuration {
            let params = json!({ "items": [{ "section": "texcrd" }] });
            let id = self.output.request("workspace/configuration", params)?;
            self.configuration = Some(id);
        }
        Ok(())
    }

    fn reconfigure(&mut self, params: &Value) -> io::Result<()> {
        match self.state.client.configuration {
            true => self.ask_configuration(),
            false => self.configure(params.get("settings").unwrap_or(&Value::Null)),
        }
    }

    fn configure(&mut self, given: &Value) -> io::Result<()> {
        let before = self.state.settings.clone();
        for wrong in self.state.settings.take(given) {
            self.tell(&wrong)?;
        }
        if self.state.settings != before {
            self.state.forget_all();
            if self.state.client.refresh_hints {
                self.output
                    .request("workspace/inlayHint/refresh", Value::Null)?;
            }
        }
        Ok(())
    }

    fn close(&mut self, uri: &str) -> io::Result<()> {
        self.state.documents.close(uri);
        self.state.forget(uri, true);
        self.state.stale.remove(uri);
        self.publish(uri, BTreeMap::new())
    }

    /// Tells a person something that is no fault of a listing.
    fn tell(&mut self, message: &str) -> io::Result<()> {
        // 2: a warning.
        let params = json!({ "type": 2, "message": format!("texcrd: {message}") });
        self.output.notify("window/showMessage", params)
    }

    fn publish_all(&mut self) -> io::Result<()> {
        while !self.state.stale.is_empty() {
            self.publish_one()?;
        }
        Ok(())
    }

    /// Tells what is wrong with the first document of which that is not known.
    fn publish_one(&mut self) -> io::Result<()> {
        let Some(uri) = self.state.stale.pop_first() else {
            return Ok(());
        };
        let Some(analysis) = self.state.analysis(&uri) else {
            return Ok(());
        };
        let mut found = publish::diagnostics(&analysis, &uri, &self.state.client);
        if self.state.is_part(&uri) {
            found = BTreeMap::from([(uri.clone(), Vec::new())]);
        }
        // A file that this one includes may have been told of as a shader before.
        for part in analysis.included.values() {
            let told = self
                .published
                .get(part)
                .is_some_and(|told| told.contains_key(part));
            if told && self.state.is_part(part) {
                self.state.stale.insert(part.clone());
            }
        }
        self.publish(&uri, found)
    }

    /// Tells what was found by way of a document, and takes back what it does not find any more.
    fn publish(&mut self, by: &str, found: BTreeMap<String, Vec<Value>>) -> io::Result<()> {
        let told = self
            .published
            .iter()
            .filter(|(_, by_document)| by_document.contains_key(by));
        let mut texts: BTreeSet<String> = told.map(|(text, _)| text.clone()).collect();
        texts.extend(found.keys().cloned());
        for text in texts {
            let by_document = self.published.entry(text.clone()).or_default();
            match found.get(&text) {
                Some(diagnostics) => by_document.insert(by.to_string(), diagnostics.clone()),
                None => by_document.remove(by),
            };
            let mut all: Vec<&Value> = Vec::new();
            for diagnostic in by_document.values().flatten() {
                if !all.contains(&diagnostic) {
                    all.push(diagnostic);
                }
            }
            let mut params = json!({ "uri": text, "diagnostics": all });
            let document = self.state.documents.get(&text);
            if let Some(document) = document.filter(|_| self.state.client.diagnostic_version) {
                params["version"] = json!(document.version);
            }
            if by_document.is_empty() {
                self.published.remove(&text);
            }
            self.output
                .notify("textDocument/publishDiagnostics", params)?;
        }
        Ok(())
    }
}

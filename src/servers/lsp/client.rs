//! What the client can do, and what it is told that the server can.

use super::text::Encoding;
use super::uri;
use serde_json::{Value, json};
use std::path::PathBuf;
use texcrd::explain::Page;

/// The client as it has introduced itself. What it does not say it cannot do.
#[derive(Clone, Debug, Default)]
pub(super) struct Client {
    pub encoding: Encoding,
    /// The folder of its workspace.
    pub folder: Option<PathBuf>,
    /// Whether hovers and documentation may be Markdown.
    pub markdown: bool,
    /// Whether completions may have places to fill in.
    pub snippets: bool,
    /// Whether code actions may be anything but commands.
    pub action_literals: bool,
    /// Whether edits may name the version of a document.
    pub versioned_edits: bool,
    /// Whether symbols may stand within each other.
    pub nested_symbols: bool,
    /// Whether diagnostics may point to other places.
    pub related: bool,
    /// Whether diagnostics may say of which version they are.
    pub diagnostic_version: bool,
    /// Whether it can be asked for its configuration.
    pub configuration: bool,
    /// Whether it can be asked to tell when inlay hints are to be asked for again.
    pub refresh_hints: bool,
    /// Whether it can be asked to tell of files that change.
    pub watches: bool,
}

impl Client {
    /// What a client says in `initialize`.
    pub(super) fn new(params: &Value) -> Self {
        let capabilities = params.get("capabilities").unwrap_or(&Value::Null);
        let can = |path: &str| {
            capabilities
                .pointer(path)
                .and_then(Value::as_bool)
                .unwrap_or(false)
        };
        let has = |path: &str| capabilities.pointer(path).is_some_and(|v| !v.is_null());
        let contains = |path: &str, what: &str| {
            let list = capabilities.pointer(path).and_then(Value::as_array);
            list.is_some_and(|list| list.iter().any(|v| v == what))
        };
        // The client's favourite comes first.
        let encodings = capabilities
            .pointer("/general/positionEncodings")
            .and_then(Value::as_array);
        let encoding =
            encodings.and_then(|all| all.iter().find_map(|e| Encoding::named(e.as_str()?)));
        let folders = params
            .get("workspaceFolders")
            .and_then(|folders| folders.get(0));
        let folder = folders
            .and_then(|folder| folder.get("uri"))
            .or(params.get("rootUri"));
        Self {
            encoding: encoding.unwrap_or_default(),
            folder: folder.and_then(Value::as_str).and_then(uri::path_of),
            markdown: contains("/textDocument/hover/contentFormat", "markdown"),
            snippets: can("/textDocument/completion/completionItem/snippetSupport"),
            action_literals: has("/textDocument/codeAction/codeActionLiteralSupport"),
            versioned_edits: can("/workspace/workspaceEdit/documentChanges"),
            nested_symbols: can("/textDocument/documentSymbol/hierarchicalDocumentSymbolSupport"),
            related: can("/textDocument/publishDiagnostics/relatedInformation"),
            diagnostic_version: can("/textDocument/publishDiagnostics/versionSupport"),
            configuration: can("/workspace/configuration"),
            refresh_hints: can("/workspace/inlayHint/refreshSupport"),
            watches: can("/workspace/didChangeWatchedFiles/dynamicRegistration"),
        }
    }

    /// The answer to `initialize`.
    pub(super) fn greeting(&self) -> Value {
        json!({
            "serverInfo": { "name": "texcrd", "version": env!("CARGO_PKG_VERSION") },
            "capabilities": {
                "positionEncoding": self.encoding.name(),
                // 2: changes come as ranges.
                "textDocumentSync": { "openClose": true, "change": 2, "save": true },
                "hoverProvider": true,
                "completionProvider": {
                    "triggerCharacters": [".", "_", "#", ",", "+", " "],
                    "resolveProvider": true,
                },
                "signatureHelpProvider": { "triggerCharacters": [" ", ","] },
                "definitionProvider": true,
                "referencesProvider": true,
                "documentHighlightProvider": true,
                "documentSymbolProvider": true,
                "foldingRangeProvider": true,
                "inlayHintProvider": true,
                "codeActionProvider": { "codeActionKinds": ["quickfix", super::actions::FIX_ALL] },
                "documentFormattingProvider": true,
                "documentRangeFormattingProvider": true,
            },
        })
    }

    /// A page as it is shown.
    pub(super) fn page(&self, page: &Page) -> String {
        const WIDTH: usize = 80;
        match self.markdown {
            true => page.markdown(),
            false => page.text(WIDTH),
        }
    }

    /// Text for people, which is Markdown: as that, or as it stands where that is not shown.
    pub(super) fn markup(&self, text: &str) -> Value {
        let kind = if self.markdown {
            "markdown"
        } else {
            "plaintext"
        };
        json!({ "kind": kind, "value": text })
    }
}

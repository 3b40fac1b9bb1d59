//! What a client asks for, and which part of the server knows it.

use super::analysis::Analysis;
use super::documents::Document;
use super::message::{Refusal, read};
use super::text::{Position, Range as Places};
use super::{State, actions, complete, hints, hover, navigate, outline, signature};
use serde::Deserialize;
use serde_json::{Value, json};
use std::ops::Range;
use std::rc::Rc;

#[derive(Deserialize)]
struct Identifier {
    uri: String,
}

/// What requests have in common: a document, and most a place in it.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Asked {
    text_document: Identifier,
    position: Option<Position>,
    range: Option<Places>,
    #[serde(default)]
    context: Context,
}

#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase")]
struct Context {
    include_declaration: Option<bool>,
    #[serde(default)]
    only: Option<Vec<String>>,
}

/// A document that is asked about.
struct View<'a> {
    document: &'a Document,
    analysis: Rc<Analysis>,
    asked: Asked,
}

impl View<'_> {
    /// The byte that is asked about.
    fn offset(&self) -> Result<usize, Refusal> {
        let position = self.asked.position;
        let position = position.ok_or_else(|| Refusal::params("`position` is missing"))?;
        let text = self.document.text.as_bytes();
        Ok(self.document.lines.offset(text, position))
    }

    /// The bytes that are asked about; all if no part is named.
    fn part(&self) -> Range<usize> {
        let text = self.document.text.as_bytes();
        let offset = |position| self.document.lines.offset(text, position);
        match self.asked.range {
            Some(range) => offset(range.start)..offset(range.end),
            None => 0..text.len(),
        }
    }
}

impl State {
    /// Answers a request.
    ///
    /// # Errors
    /// There is no such method, or it cannot be done with this.
    pub(super) fn request(&self, method: &str, params: Value) -> Result<Value, Refusal> {
        let client = &self.client;
        match method {
            "completionItem/resolve" => Ok(complete::resolve(params, client)),
            "textDocument/hover" => {
                let view = self.view(params)?;
                Ok(hover::hover(
                    &view.analysis,
                    view.document,
                    view.offset()?,
                    client,
                ))
            }
            "textDocument/completion" => {
                let view = self.view(params)?;
                Ok(complete::complete(
                    &view.analysis,
                    view.document,
                    view.offset()?,
                    client,
                ))
            }
            "textDocument/signatureHelp" => {
                let view = self.view(params)?;
                Ok(signature::signature(
                    &view.analysis,
                    view.document,
                    view.offset()?,
                    client,
                ))
            }
            "textDocument/definition" => {
                let view = self.view(params)?;
                let (world, offset) = (self.world(), view.offset()?);
                Ok(navigate::definition(
                    &world,
                    &view.analysis,
                    view.document,
                    offset,
                ))
            }
            "textDocument/references" => {
                let view = self.view(params)?;
                let declarations = view.asked.context.include_declaration.unwrap_or(true);
                let offset = view.offset()?;
                Ok(navigate::references(
                    &view.analysis,
                    view.document,
                    offset,
                    declarations,
                ))
            }
            "textDocument/documentHighlight" => {
                let view = self.view(params)?;
                Ok(navigate::highlights(
                    &view.analysis,
                    view.document,
                    view.offset()?,
                ))
            }
            "textDocument/documentSymbol" => {
                let view = self.view(params)?;
                Ok(outline::symbols(&view.analysis, view.document, client))
            }
            "textDocument/foldingRange" => {
                let view = self.view(params)?;
                Ok(outline::folds(&view.analysis, view.document))
            }
            "textDocument/inlayHint" => {
                let view = self.view(params)?;
                let (part, which) = (view.part(), self.settings.hints);
                Ok(json!(hints::hints(
                    &view.analysis,
                    view.document,
                    &part,
                    which
                )))
            }
            "textDocument/codeAction" => {
                let view = self.view(params)?;
                let only = view.asked.context.only.as_deref().unwrap_or_default();
                let (world, part) = (self.world(), view.part());
                let found =
                    actions::actions(&world, &view.analysis, view.document, &part, only, client);
                Ok(json!(found))
            }
            "textDocument/formatting" | "textDocument/rangeFormatting" => {
                let view = self.view(params)?;
                let edits = actions::format(&view.analysis, view.document, &view.part());
                Ok(actions::text_edits(view.document, &edits))
            }
            _ => Err(Refusal::method(method)),
        }
    }

    /// The document that is asked about, read.
    fn view(&self, params: Value) -> Result<View<'_>, Refusal> {
        let asked: Asked = read(params)?;
        let uri = &asked.text_document.uri;
        let missing = || Refusal::params(format!("{uri} is not open"));
        let document = self.documents.get(uri).ok_or_else(missing)?;
        let analysis = self.analysis(uri).ok_or_else(missing)?;
        Ok(View {
            document,
            analysis,
            asked,
        })
    }
}

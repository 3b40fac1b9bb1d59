//! Diagnostics as the client gets them.

use super::analysis::Analysis;
use super::client::Client;
use super::text::Range;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use texcrd::diagnostic::{Diagnostic, Severity};

/// What is wrong with a document, by the address of the text in which it is told: the document, or a file that it includes.
pub(super) fn diagnostics(
    analysis: &Analysis,
    uri: &str,
    client: &Client,
) -> BTreeMap<String, Vec<Value>> {
    let mut all: BTreeMap<String, Vec<Value>> = BTreeMap::new();
    // What was told before and is no more has to be taken back.
    let own = all.entry(uri.to_string()).or_default();
    if let Some(problem) = &analysis.problem {
        let range = Range::default();
        own.push(json!({ "range": range, "severity": 1, "source": "texcrd", "message": problem }));
    }
    if !analysis.ours {
        return all;
    }
    for diagnostic in &analysis.diagnostics {
        let (place, range) = analysis
            .place(diagnostic.span)
            .unwrap_or_else(|| (uri.to_string(), Range::default()));
        let told = one(analysis, diagnostic, range, client);
        all.entry(place).or_default().push(told);
    }
    all
}

/// A diagnostic at a place.
pub(super) fn one(
    analysis: &Analysis,
    diagnostic: &Diagnostic,
    range: Range,
    client: &Client,
) -> Value {
    let mut message = diagnostic.message.clone();
    if let Some(help) = &diagnostic.help {
        message.push_str(&format!("\nhelp: {help}"));
    }
    message.push_str(&format!("\nrule: {}", diagnostic.rule.rule));
    let mut related = Vec::new();
    for note in analysis.sources.notes(diagnostic.span) {
        match note.span.and_then(|span| analysis.place(span)) {
            Some((uri, range)) if client.related => {
                related.push(
                    json!({ "location": { "uri": uri, "range": range }, "message": note.message }),
                );
            }
            Some((uri, range)) => {
                let file = uri.rsplit('/').next().unwrap_or_default();
                message.push_str(&format!(
                    "\nnote: {} ({file}:{})",
                    note.message,
                    range.start.line + 1
                ));
            }
            None => message.push_str(&format!("\nnote: {}", note.message)),
        }
    }
    let severity = match diagnostic.severity {
        Severity::Error => 1,
        Severity::Warning => 2,
    };
    let mut told = json!({
        "range": range,
        "severity": severity,
        "code": diagnostic.rule.id,
        "source": "texcrd",
        "message": message,
    });
    if !related.is_empty() {
        told["relatedInformation"] = json!(related);
    }
    told
}

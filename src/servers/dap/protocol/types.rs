//! What clients get.

use serde::{Deserialize, Serialize};

/// What the adapter can do. Every flag is true; what it cannot do is not mentioned.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::servers) struct Capabilities {
    #[serde(flatten)]
    pub flags: std::collections::BTreeMap<&'static str, bool>,
    pub exception_breakpoint_filters: Vec<ExceptionFilter>,
    pub completion_trigger_characters: Vec<&'static str>,
}

/// A kind of occurrence that a person can stop at.
#[derive(Clone, Debug, Serialize)]
pub(in crate::servers) struct ExceptionFilter {
    pub filter: &'static str,
    pub label: &'static str,
    pub description: &'static str,
    pub default: bool,
}

/// A text, by path or by number.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::servers) struct Source {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub path: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub source_reference: Option<i64>,
}

/// A place in a text, in the client's counting.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::servers) struct Range {
    pub line: i64,
    pub column: i64,
    pub end_line: i64,
    pub end_column: i64,
}

#[derive(Clone, Debug, Default, Serialize)]
pub(in crate::servers) struct Breakpoints {
    pub breakpoints: Vec<Breakpoint>,
}

/// What became of a breakpoint.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub(in crate::servers) struct Breakpoint {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub id: Option<u32>,
    pub verified: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub message: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub source: Option<Source>,
    #[serde(flatten)]
    pub range: Option<Range>,
}

#[derive(Clone, Debug, Serialize)]
pub(in crate::servers) struct BreakpointEvent {
    pub reason: &'static str,
    pub breakpoint: Breakpoint,
}

#[derive(Clone, Debug, Serialize)]
pub(in crate::servers) struct BreakpointLocations {
    pub breakpoints: Vec<Range>,
}

#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::servers) struct DataBreakpointInfo {
    /// `null` if there can be none.
    pub data_id: Option<String>,
    pub description: String,
    pub access_types: Vec<&'static str>,
    pub can_persist: bool,
}

#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::servers) struct Continued {
    pub all_threads_continued: bool,
}

#[derive(Clone, Debug, Default, Serialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::servers) struct Stopped {
    pub reason: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub description: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub text: Option<String>,
    pub thread_id: i64,
    pub all_threads_stopped: bool,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub hit_breakpoint_ids: Vec<u32>,
}

#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::servers) struct Exited {
    pub exit_code: i64,
}

/// Who speaks in an output event.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub(in crate::servers) enum Category {
    /// The debugger.
    #[default]
    Console,
    /// The program that is debugged: log points, results.
    Stdout,
    /// What is wrong.
    Stderr,
}

#[derive(Clone, Debug, Default, Serialize)]
pub(in crate::servers) struct Output {
    pub category: Category,
    pub output: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub source: Option<Source>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line: Option<i64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub column: Option<i64>,
}

#[derive(Clone, Debug, Serialize)]
pub(in crate::servers) struct Invalidated {
    pub areas: Vec<&'static str>,
}

#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::servers) struct ExceptionInfo {
    pub exception_id: &'static str,
    pub description: String,
    pub break_mode: &'static str,
    pub details: ExceptionDetails,
}

#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::servers) struct ExceptionDetails {
    pub message: String,
    pub type_name: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub evaluate_name: Option<String>,
}

#[derive(Clone, Debug, Serialize)]
pub(in crate::servers) struct Threads {
    pub threads: Vec<Thread>,
}

#[derive(Clone, Debug, Serialize)]
pub(in crate::servers) struct Thread {
    pub id: i64,
    pub name: String,
}

#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::servers) struct StackTrace {
    pub stack_frames: Vec<StackFrame>,
    pub total_frames: usize,
}

#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::servers) struct StackFrame {
    pub id: i64,
    pub name: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub source: Option<Source>,
    #[serde(flatten)]
    pub range: Range,
    pub can_restart: bool,
    pub instruction_pointer_reference: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub presentation_hint: Option<&'static str>,
}

#[derive(Clone, Debug, Serialize)]
pub(in crate::servers) struct Scopes {
    pub scopes: Vec<Scope>,
}

#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::servers) struct Scope {
    pub name: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub presentation_hint: Option<&'static str>,
    pub variables_reference: i64,
    pub named_variables: usize,
    pub expensive: bool,
}

#[derive(Clone, Debug, Serialize)]
pub(in crate::servers) struct Variables {
    pub variables: Vec<Variable>,
}

#[derive(Clone, Debug, Default, Serialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::servers) struct Variable {
    pub name: String,
    pub value: String,
    #[serde(rename = "type", skip_serializing_if = "Option::is_none")]
    pub kind: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub presentation_hint: Option<PresentationHint>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub evaluate_name: Option<String>,
    pub variables_reference: i64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub named_variables: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub indexed_variables: Option<usize>,
}

#[derive(Clone, Debug, Default, Serialize)]
pub(in crate::servers) struct PresentationHint {
    pub kind: &'static str,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub attributes: Vec<&'static str>,
}

/// What was set, or what an expression comes to. The response to `evaluate` calls the value its result.
#[derive(Clone, Debug, Default, Serialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::servers) struct Valued {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub value: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub result: Option<String>,
    #[serde(rename = "type", skip_serializing_if = "Option::is_none")]
    pub kind: Option<&'static str>,
    pub variables_reference: i64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub named_variables: Option<usize>,
}

#[derive(Clone, Debug, Serialize)]
pub(in crate::servers) struct GotoTargets {
    pub targets: Vec<GotoTarget>,
}

#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::servers) struct GotoTarget {
    pub id: i64,
    pub label: String,
    #[serde(flatten)]
    pub range: Range,
    pub instruction_pointer_reference: String,
}

#[derive(Clone, Debug, Serialize)]
pub(in crate::servers) struct Completions {
    pub targets: Vec<Completion>,
}

#[derive(Clone, Debug, Serialize)]
pub(in crate::servers) struct Completion {
    pub label: String,
    pub start: i64,
    pub length: usize,
}

#[derive(Clone, Debug, Serialize)]
pub(in crate::servers) struct LoadedSources {
    pub sources: Vec<Source>,
}

#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::servers) struct SourceText {
    pub content: String,
    pub mime_type: &'static str,
}

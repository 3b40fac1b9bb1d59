//! What the client is like: how it counts, what it understands.

use super::protocol::{Capabilities, ExceptionFilter, InitializeArguments, Refusal};
use super::travel::filters;

/// The client as it has introduced itself.
#[derive(Clone, Debug)]
pub(super) struct Client {
    /// The number of the first line.
    first_line: i64,
    /// The number of the first column.
    first_column: i64,
    /// Whether it shows types of variables.
    pub types: bool,
    /// Whether it can be told that values have changed.
    pub invalidated: bool,
    /// Whether it shows colours of a terminal.
    pub colours: bool,
}

impl Client {
    /// What a client says in `initialize`.
    ///
    /// # Errors
    /// It names files by something else than paths.
    pub(super) fn new(arguments: &InitializeArguments) -> Result<Self, Refusal> {
        if let Some(format) = &arguments.path_format
            && format != "path"
        {
            let message = format!("files are named by paths here, not as `{format}`");
            return Err(Refusal::request(message));
        }
        let first = |at_one: Option<bool>| i64::from(at_one.unwrap_or(true));
        Ok(Self {
            first_line: first(arguments.lines_start_at1),
            first_column: first(arguments.columns_start_at1),
            types: arguments.supports_variable_type.unwrap_or(false),
            invalidated: arguments.supports_invalidated_event.unwrap_or(false),
            colours: arguments.supports_ansi_styling.unwrap_or(false),
        })
    }

    /// A line from 1 as the client counts it.
    pub(super) fn line(&self, line: usize) -> i64 {
        counted(line, self.first_line)
    }

    /// A column from 1 as the client counts it.
    pub(super) fn column(&self, column: usize) -> i64 {
        counted(column, self.first_column)
    }

    /// A line of the client, counted from 1; 0 for one that there cannot be.
    pub(super) fn line_of(&self, line: i64) -> usize {
        uncounted(line, self.first_line)
    }

    /// A column of the client, counted from 1; 0 for one that there cannot be.
    pub(super) fn column_of(&self, column: i64) -> usize {
        uncounted(column, self.first_column)
    }
}

fn counted(number: usize, first: i64) -> i64 {
    i64::try_from(number).unwrap_or(i64::MAX) - 1 + first
}

fn uncounted(number: i64, first: i64) -> usize {
    usize::try_from(number.saturating_add(1 - first)).unwrap_or(0)
}

/// What the adapter can do: each of these requests and options is served.
pub(super) fn capabilities() -> Capabilities {
    let flags = [
        "supportsConfigurationDoneRequest",
        "supportsConditionalBreakpoints",
        "supportsHitConditionalBreakpoints",
        "supportsLogPoints",
        "supportsBreakpointLocationsRequest",
        "supportsDataBreakpoints",
        "supportsExceptionInfoRequest",
        "supportsStepBack",
        "supportsSteppingGranularity",
        "supportsGotoTargetsRequest",
        "supportsRestartFrame",
        "supportsRestartRequest",
        "supportsTerminateRequest",
        "supportsSetVariable",
        "supportsSetExpression",
        "supportsEvaluateForHovers",
        "supportsClipboardContext",
        "supportsCompletionsRequest",
        "supportsValueFormattingOptions",
        "supportsLoadedSourcesRequest",
        "supportsDelayedStackTraceLoading",
        "supportsANSIStyling",
    ];
    Capabilities {
        flags: flags.into_iter().map(|flag| (flag, true)).collect(),
        exception_breakpoint_filters: filters().collect::<Vec<ExceptionFilter>>(),
        completion_trigger_characters: vec![".", "_", " "],
    }
}

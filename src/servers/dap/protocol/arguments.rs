//! What clients send.

use super::types::Source;
use serde::Deserialize;
use std::collections::BTreeMap;

/// What the client is like.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::servers) struct InitializeArguments {
    pub lines_start_at1: Option<bool>,
    pub columns_start_at1: Option<bool>,
    pub path_format: Option<String>,
    pub supports_variable_type: Option<bool>,
    pub supports_invalidated_event: Option<bool>,
    #[serde(rename = "supportsANSIStyling")]
    pub supports_ansi_styling: Option<bool>,
}

/// What is debugged. This is the contract with those who write launch configurations.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::servers) struct LaunchArguments {
    /// A listing, or a scene (`.toml`).
    pub program: String,
    /// Column and row of a pixel of the scene.
    pub pixel: Option<[u32; 2]>,
    /// A vertex of the scene by its number in the mesh.
    pub vertex: Option<u32>,
    /// A draw of the scene by name.
    pub draw: Option<String>,
    /// A primitive of the draw by number.
    pub primitive: Option<usize>,
    /// Width and height of the picture.
    pub size: Option<[u32; 2]>,
    /// Values of the listing's inputs and constants by name.
    pub set: Option<BTreeMap<String, Numbers>>,
    /// By whose rules.
    pub dialect: Option<String>,
    /// With which numbers pixel shaders compute.
    pub model: Option<String>,
    /// Numeric choices, value by name.
    pub policies: Option<BTreeMap<String, String>>,
    /// Of a file with several listings, the one that is meant: its name, or its number from 1.
    pub shader: Option<String>,
    /// Macros, each `NAME` or `NAME=VALUE`.
    pub defines: Option<Vec<String>>,
    /// Folders in which included files are looked for, too.
    pub includes: Option<Vec<String>>,
    /// Whether to stop before the first instruction; true if not given.
    pub stop_on_entry: Option<bool>,
    /// The folder that a relative `program` starts from.
    pub cwd: Option<String>,
    /// Run without debugging.
    pub no_debug: Option<bool>,
}

/// The numbers of a register.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged, expecting = "one to four numbers stand behind a register")]
pub(in crate::servers) enum Numbers {
    One(f32),
    Some(Vec<f32>),
}

impl Numbers {
    /// As a list.
    pub(in crate::servers) fn list(&self) -> &[f32] {
        match self {
            Self::One(number) => std::slice::from_ref(number),
            Self::Some(numbers) => numbers,
        }
    }
}

#[derive(Clone, Debug, Default, Deserialize)]
pub(in crate::servers) struct RestartArguments {
    pub arguments: Option<LaunchArguments>,
}

#[derive(Clone, Debug, Deserialize)]
pub(in crate::servers) struct SetBreakpointsArguments {
    pub source: Source,
    pub breakpoints: Option<Vec<SourceBreakpoint>>,
    pub lines: Option<Vec<i64>>,
}

/// A breakpoint as it is asked for.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::servers) struct SourceBreakpoint {
    pub line: i64,
    pub column: Option<i64>,
    pub condition: Option<String>,
    pub hit_condition: Option<String>,
    pub log_message: Option<String>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::servers) struct BreakpointLocationsArguments {
    pub source: Source,
    pub line: i64,
    pub end_line: Option<i64>,
}

#[derive(Clone, Debug, Deserialize)]
pub(in crate::servers) struct SetExceptionBreakpointsArguments {
    pub filters: Vec<String>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::servers) struct DataBreakpointInfoArguments {
    pub variables_reference: Option<i64>,
    pub name: String,
    pub frame_id: Option<i64>,
}

#[derive(Clone, Debug, Deserialize)]
pub(in crate::servers) struct SetDataBreakpointsArguments {
    pub breakpoints: Vec<DataBreakpoint>,
}

/// A data breakpoint as it is asked for.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::servers) struct DataBreakpoint {
    pub data_id: String,
    pub access_type: Option<String>,
    pub condition: Option<String>,
    pub hit_condition: Option<String>,
}

/// How far a step goes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::servers) enum Granularity {
    /// An instruction of the listing, with all its rows.
    #[default]
    Statement,
    /// All instructions of a line.
    Line,
    /// What happens at once: a row of a macro.
    Instruction,
}

#[derive(Clone, Debug, Default, Deserialize)]
pub(in crate::servers) struct StepArguments {
    pub granularity: Option<Granularity>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::servers) struct FrameArguments {
    pub frame_id: i64,
}

#[derive(Clone, Debug, Deserialize)]
pub(in crate::servers) struct GotoTargetsArguments {
    pub source: Source,
    pub line: i64,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::servers) struct GotoArguments {
    pub target_id: i64,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::servers) struct StackTraceArguments {
    pub start_frame: Option<i64>,
    pub levels: Option<i64>,
}

/// How values are written.
#[derive(Clone, Copy, Debug, Default, Deserialize)]
pub(in crate::servers) struct ValueFormat {
    pub hex: Option<bool>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::servers) struct VariablesArguments {
    pub variables_reference: i64,
    pub filter: Option<String>,
    pub start: Option<i64>,
    pub count: Option<i64>,
    pub format: Option<ValueFormat>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::servers) struct SetVariableArguments {
    pub variables_reference: i64,
    pub name: String,
    pub value: String,
    pub format: Option<ValueFormat>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::servers) struct SetExpressionArguments {
    pub expression: String,
    pub value: String,
    pub frame_id: Option<i64>,
    pub format: Option<ValueFormat>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::servers) struct EvaluateArguments {
    pub expression: String,
    pub frame_id: Option<i64>,
    pub context: Option<String>,
    pub format: Option<ValueFormat>,
}

#[derive(Clone, Debug, Deserialize)]
pub(in crate::servers) struct CompletionsArguments {
    pub text: String,
    pub column: i64,
    pub line: Option<i64>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(in crate::servers) struct SourceArguments {
    pub source: Option<Source>,
    pub source_reference: i64,
}

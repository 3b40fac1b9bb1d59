//! The debugger: what a shader did to one vertex, one pixel or one set of values, moment by moment, forwards and backwards.
//!
//! A [`Run`] is a recorded invocation: its registers before the first moment, and a row of [`Moment`]s, each with what it read
//! and the value of what it wrote before and after. So a step back costs what a step forward costs, and nobody who shows a run
//! has to know what an instruction means. The moments before the first instruction tell where the inputs came from, those
//! behind the last one what becomes of the outputs.
//!
//! A [`Session`] holds the runs of one [`Subject`], for a pixel those of its three vertices and its own, and a [`Position`] in
//! them. Every front (command line, terminal, editor) drives a session; none has knowledge of its own about shaders.
//!
//! What one asks is an [`Expression`] over the registers of a moment.
//!
//! Files: `moment` (what happens), `run` (a recorded invocation and its registers), `record` (how it is recorded), `subject`
//! (what can be debugged), `pixel` (a pixel or a vertex of a scene), `session` (where one is, and how one moves), `expression` (the
//! language of `print`, of conditions and of log messages), `stops` (breakpoints, and running until something happens), `why`
//! (what made a value), `commands` (the command language), `text` (what is answered, with styles).

mod commands;
mod expression;
mod given;
mod moment;
#[cfg(feature = "scene")]
mod pixel;
mod record;
mod run;
mod session;
mod stops;
mod subject;
#[cfg(test)]
mod tests;
mod text;
mod why;

pub use commands::{
    Account, CommandHelp, Console, Display, Effect, Reply, account, command_help, occasion,
};
pub use expression::{
    Expression, ExpressionError, Format, LogMessage, Scope, Value, function_names, number_text,
};
pub use given::{Given, GivenError};
pub use moment::{
    Change, Event, Flags, InputSource, MergeStage, Moment, Quad, Read, Sample, Target,
};
#[cfg(feature = "scene")]
pub(crate) use pixel::tell_merge;
#[cfg(feature = "scene")]
pub use pixel::{PixelError, PixelSubject, VertexSubject, Which};
pub use record::{Edit, Input, Invocation, record};
pub use run::{Listing, Registers, Run, RunKind};
pub use session::{Direction, Position, Session};
pub use stops::{
    Action, Breakpoint, HitCount, NotUnderstood, Occurrence, Reason, Stops, Travel, Until,
    Watchpoint,
};
pub use subject::{ListingSubject, Subject};
pub use text::{Line, Piece, Style, Text};
pub use why::{Cause, Slice, why};

//! The rules of the runtime: what a shader may not hold, and why.
//!
//! A rule is a function in the file of its group; the facts it compares with are rows of [`crate::isa`]. How
//! severe a breach is in which [`Dialect`] stands in one table, in [`crate::rules`]. Every breach is found in one pass over
//! the program, and one fault is named once, where it shows first.

mod budgets;
mod flow;
mod listing;
mod modifiers;
mod operands;
mod pairing;
mod ports;
mod report;
mod stages;
mod statistics;
mod structure;
mod unset;
mod uses;

#[cfg(test)]
mod tests;

pub use statistics::{
    Coordinates, FileUsage, FullPorts, PhaseSlots, PossiblePair, SlotUse, Stage, Statistics, Usage,
    slots, statistics,
};
pub use unset::unset_constants;
pub use uses::{Use, UseKind, origins, uses};

use crate::diagnostic::{Diagnostic, Span};
use crate::policy::Dialect;
use crate::program::{Program, Register};
use listing::Listing;
use report::Report;

/// Judges a program by the rules of a dialect. Returns every breach, by position, but of one rule no more than 100,
/// so that a file that is no shader does not drown in them.
///
/// The time is linear in the length of the program. A program without an error can be lowered and run.
pub fn validate(program: &Program, dialect: Dialect) -> Vec<Diagnostic> {
    validate_around(program, dialect, &[])
}

/// Judges only what the assembler itself refused, whether it was asked to validate or not: registers that are written out and
/// that the version does not have (O1, of a `def` O25), and `+` in a vertex shader (C1). What else it never took is no text
/// of a program. The rows of a matrix that are not written out are the validator's.
pub fn assembles(program: &Program) -> Vec<Diagnostic> {
    let listing = Listing::new(program, &[]);
    let mut report = Report::new(Dialect::D3d8);
    operands::can_be_named(&listing, &mut report);
    pairing::vertex_shaders_have_no_pairs(&listing, &mut report);
    report.finish()
}

/// Judges a program of which some statements could not be read.
///
/// `unread` says where they stand and which register each seems to write, if that is known. What would follow from
/// their absence alone (a register that is read and not written, a result that is missing, a `+` or a matrix that
/// lost its first half) is not told: the damage has been.
pub fn validate_around(
    program: &Program,
    dialect: Dialect,
    unread: &[(Span, Option<Register>)],
) -> Vec<Diagnostic> {
    let listing = Listing::new(program, unread);
    let mut report = Report::new(dialect);
    budgets::check(&listing, &mut report);
    structure::check(&listing, &mut report);
    operands::check(&listing, &mut report);
    modifiers::check(&listing, &mut report);
    ports::check(&listing, &mut report);
    stages::check(&listing, &mut report);
    flow::check(&listing, &mut report);
    pairing::check(&listing, &mut report);
    report.finish()
}

//! The interpreter: runs a kernel over one or many invocations and lets an observer see every write.
//!
//! A [`Machine`] holds the registers of `N` invocations, *lanes*, and takes each step for all of them. One lane is a
//! vertex or a listing run by hand; four lanes are the 2×2 quad of pixels whose differences choose the mip level;
//! more lanes are several quads at once. The meanings are those of [`crate::semantics`], whatever `N` is.

mod batch;
mod environment;
mod machine;
#[cfg(test)]
mod tests;
mod trace;

pub use batch::Batch;
pub use environment::{
    Environment, STAGES, Stage, bind_constants, bind_constants_over, overrides_definitions,
};
pub use machine::{Lanes, Machine, Observer};
pub use trace::{Change, Trace};

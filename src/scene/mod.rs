//! The scene room: so far the texture generators.

pub mod generate;

//! The program `texcrd`.
fn main() {}

//! The isa room (to be filled).

//! The semantics room (to be filled).

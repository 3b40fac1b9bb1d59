//! The policy room (to be filled).

//! The kernel room (to be filled).

//! The syntax room (to be filled).

//! The scene room (to be filled).

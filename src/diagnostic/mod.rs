//! The diagnostic room (to be filled).

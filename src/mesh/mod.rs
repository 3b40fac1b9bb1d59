//! The mesh room (to be filled).

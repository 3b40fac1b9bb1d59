//! The validate room (to be filled).

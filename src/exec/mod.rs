//! The exec room (to be filled).

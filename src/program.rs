//! The program room (to be filled).

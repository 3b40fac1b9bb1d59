//! The texture room (to be filled).

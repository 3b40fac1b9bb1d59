//! Arithmetic alone, as 32-bit floats.

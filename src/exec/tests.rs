//! Tests of the interpreter (to come).

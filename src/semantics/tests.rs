//! Tests of the meanings (to come).

//! Tests of the tables (to come).

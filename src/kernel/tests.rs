//! Tests of the lowering (to come).

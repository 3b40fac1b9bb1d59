//! Tests of the translator.

mod contract;
mod generated;
mod models;
mod opcodes;
mod readable;
mod show;
mod support;
mod texels;

//! Every thing has a page, every example keeps all rules, every formula is what the machine computes.

mod examples;
mod formulas;
mod names;
mod pages;

//! Pages of the macros of `d3d8types.h`.

use super::page::{Fact, Page};
use super::rule;
use crate::bytecode::Macro;

/// What a macro of `d3d8types.h` makes.
pub fn token_macro(of: &'static Macro) -> Page {
    let mut page = Page::new(of.name(), "macro that makes a token");
    page.paragraph(of.meaning());
    let (written, token) = of.example();
    page.facts(vec![
        Fact::new("written", written),
        Fact::new("its token", format!("{token:08X}")),
    ]);
    let types: Vec<Fact> = of
        .types()
        .map(|(name, bytes)| Fact::new(name, format!("{bytes} bytes")))
        .collect();
    if !types.is_empty() {
        page.heading("Types of data");
        page.facts(types);
    }
    rule::mention(&mut page, of.name());
    page
}

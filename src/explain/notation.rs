//! Pages of notations.

use super::encoding;
use super::page::{Fact, Page};
use crate::isa::{Notation, Version, VersionSet};

/// What a notation means; with `version` only as this one has it, if it does.
pub fn notation(notation: Notation, version: Option<Version>) -> Page {
    let row = notation.row();
    let mut page = Page::new(row.names.first().copied().unwrap_or_default(), row.title);
    page.paragraph(row.meaning);
    let all = (row.forms.iter()).fold(VersionSet::NONE, |all, form| all.and(form.versions));
    page.facts(vec![
        Fact::new("versions", all.to_string()),
        Fact::new("token", row.token),
    ]);
    let only = version.filter(|version| all.contains(*version));
    let forms = row.forms.iter();
    for form in forms.filter(|form| only.is_none_or(|v| form.versions.contains(v))) {
        page.heading(form.versions.to_string());
        page.paragraph(form.meaning);
        if let Some(shown) = only.or_else(|| form.versions.iter().last()) {
            page.listing(encoding::listing(shown, form.example).trim_end());
        }
    }
    let others = Notation::all().filter(|other| *other != notation);
    page.see = others
        .filter_map(|other| other.row().names.first().map(|name| name.to_string()))
        .collect();
    page
}

//! Pages of modifiers of sources and results.

use super::page::{Fact, Page};
use super::{encoding, rule};
use crate::isa::modifier::{ResultSuffix, SourceModifierRow};
use crate::isa::opcode::ModifierRule;
use crate::isa::{Opcode, RegisterFile, SourceModifier, VersionSet, enumerate};

/// What a source modifier is called: `-`, `1-`, `_bx2`, `-_bx2`.
pub(super) fn name(modifier: SourceModifier) -> String {
    modifier.row().around("")
}

/// The modifier on a register that takes it.
pub(super) fn written(row: &SourceModifierRow) -> String {
    row.around(&row.divides.unwrap_or(RegisterFile::Temp).any_name())
}

/// What a source modifier does.
pub fn modifier(modifier: SourceModifier) -> Page {
    let row = modifier.row();
    let mut page = Page::new(name(modifier), "modifier of a source");
    page.paragraph(row.meaning);
    let mut facts = vec![
        Fact::new("written", written(row)),
        Fact::new("formula", format!("{}, where x is the source", row.formula)),
        Fact::new("versions", row.versions().to_string()),
    ];
    if !row.alias.is_empty() {
        facts.push(Fact::new("also", row.alias));
    }
    let mut places = Vec::new();
    if row.arithmetic != VersionSet::NONE {
        places.push(format!("arithmetic of {}", row.arithmetic));
    }
    places.extend(instructions_with(modifier));
    facts.push(Fact::new("on", places.join("; ")));
    facts.push(Fact::new("slots", "none"));
    let token = format!("{} in bits 27:24 of the source token", row.code);
    facts.push(Fact::new("token", token));
    page.facts(facts);
    if let Some(version) = row.versions().iter().last() {
        page.listing(encoding::listing(version, row.example).trim_end());
    }
    // Rules that name it are about results where results have it as well.
    if row.prefix.is_empty() && ResultSuffix::all().all(|other| other.suffix != row.suffix) {
        rule::mention(&mut page, row.suffix);
    }
    let alike = |other: &SourceModifier| {
        let other = other.row();
        other.modifier != modifier
            && (!row.suffix.is_empty() && other.suffix == row.suffix
                || row.suffix.is_empty() && other.suffix.is_empty() && !other.prefix.is_empty())
    };
    page.see = SourceModifier::all().filter(alike).map(name).collect();
    page
}

/// The instructions whose rows name the modifier, with the versions in which they take it.
fn instructions_with(modifier: SourceModifier) -> Vec<String> {
    let row = modifier.row();
    let mut groups: Vec<(VersionSet, Vec<&str>)> = Vec::new();
    for opcode in Opcode::all() {
        for form in opcode.row().forms {
            for source in form.sources {
                let versions = match source.modifiers {
                    ModifierRule::Bx2(versions) if modifier == SourceModifier::Bx2 => versions,
                    ModifierRule::Coordinates
                        if row.divides.is_some_and(|file| source.files.contains(file)) =>
                    {
                        row.coordinates
                    }
                    _ => continue,
                };
                let here = versions.both(form.versions);
                if here == VersionSet::NONE {
                    continue;
                }
                match groups.iter_mut().find(|(versions, _)| *versions == here) {
                    Some((_, names)) => names.push(opcode.mnemonic()),
                    None => groups.push((here, vec![opcode.mnemonic()])),
                }
            }
        }
    }
    let told = |(versions, names): (VersionSet, Vec<&str>)| {
        format!("{} of {versions}", enumerate(&names, "and"))
    };
    groups.into_iter().map(told).collect()
}

/// What a suffix of a mnemonic does.
pub fn result(row: &'static ResultSuffix) -> Page {
    let mut page = Page::new(row.suffix, "modifier of a result");
    page.paragraph(row.meaning);
    let token = match row.shift {
        0 => "bit 20 of the destination token".to_string(),
        shift => format!("{} in bits 27:24 of the destination token", shift & 0xF),
    };
    page.facts(vec![
        Fact::new("written", format!("mul{} d, s0, s1", row.suffix)),
        Fact::new("formula", format!("{}, where x is the result", row.formula)),
        Fact::new("versions", row.versions.to_string()),
        Fact::new("on", "arithmetic; one shift, with or without _sat"),
        Fact::new("slots", "none"),
        Fact::new("token", token),
    ]);
    if let Some(version) = row.versions.iter().last() {
        page.listing(encoding::listing(version, row.example).trim_end());
    }
    rule::mention(&mut page, row.suffix);
    page.see = (ResultSuffix::all())
        .filter(|other| other.suffix != row.suffix)
        .map(|other| other.suffix.to_string())
        .collect();
    page
}

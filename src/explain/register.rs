//! Pages of registers.

use super::page::{Fact, Page};
use super::{encoding, rule};
use crate::isa::register::{Access, FileForm};
use crate::isa::{RegisterFile, ShaderKind, Version, VersionSet};
use crate::program::Usage;

/// What a register file holds, or one register of it: with `version` only as this one has it, if it does.
///
/// `index` may be a number that no version has, which is said then.
pub fn register(file: RegisterFile, index: Option<u32>, version: Option<Version>) -> Page {
    let row = file.row();
    let name = match index {
        Some(index) => file.register_name(index),
        None => file.any_name(),
    };
    let mut page = Page::new(name, format!("{} register", row.name));
    let in_file = file.versions();
    let has = |version: &Version| index.is_none_or(|index| index < file.count(*version));
    let there = (in_file.iter().filter(has)).fold(VersionSet::NONE, |all, v| all.and(v.only()));
    let mut facts = vec![Fact::new(
        "versions",
        match there == VersionSet::NONE {
            true => "none has this number".to_string(),
            false => there.to_string(),
        },
    )];
    // Of a number that no version has the file is told.
    let told = if there == VersionSet::NONE {
        in_file
    } else {
        there
    };
    let only = version.filter(|version| told.contains(*version));
    let versions = only.map_or(told, Version::only);
    let count = |version| match file.count(version) {
        1 => "1".to_string(),
        count => format!(
            "{count}, {} to {}",
            file.register_name(0),
            file.register_name(count - 1)
        ),
    };
    if file != RegisterFile::RastOut || index.is_none() {
        facts.push(Fact::new("registers", by_version(versions, count)));
    }
    let access = |version| {
        let access = match file.access(version) {
            Access::Read => "read",
            Access::Write => "written",
            Access::ReadWrite => "read and written",
        };
        access.to_string()
    };
    facts.push(Fact::new("access", by_version(versions, access)));
    let read = versions.iter().any(|version| file.read_ports(version) > 0);
    if read {
        let ports = |version| file.read_ports(version).to_string();
        let text = by_version(versions, ports);
        facts.push(Fact::new(
            "read ports",
            format!("{text} (how many different ones one instruction reads)"),
        ));
    }
    if let Some(index) = index
        && file == RegisterFile::Input
        && versions.iter().any(|v| v.kind() == ShaderKind::Vertex)
        && let Some(element) = element(index)
    {
        facts.push(Fact::new("element", element));
    }
    let number = match index {
        Some(index) => format!("number {index}"),
        None => "the number".to_string(),
    };
    let token = format!(
        "register type {} in bits 30:28, {number} in bits 10:0",
        row.code
    );
    facts.push(Fact::new("token", token));
    page.facts(facts);
    let of_these = |form: &&FileForm| form.versions.both(versions) != VersionSet::NONE;
    for form in file.forms(index).filter(of_these) {
        page.heading(form.versions.both(told).to_string());
        page.paragraph(form.meaning);
        page.facts(vec![
            Fact::new("holds", form.range),
            Fact::new("unwritten", form.before),
        ]);
        if let Some(shown) = only.or_else(|| form.versions.both(told).iter().last()) {
            page.listing(encoding::listing(shown, form.example).trim_end());
        }
    }
    let name = page.name.clone();
    match (file, index) {
        (RegisterFile::RastOut, Some(_)) => rule::mention(&mut page, &name),
        _ => rule::mention(&mut page, &file.any_name()),
    }
    let others = RegisterFile::all().filter(|other| *other != file);
    let together = others.filter(|other| other.versions().both(in_file) != VersionSet::NONE);
    page.see = together.map(RegisterFile::any_name).collect();
    page
}

/// What holds in which of these versions: `12 in vs.1.0 and vs.1.1; 6 in ps.1.4`, or `12` if it is the same in all.
fn by_version(versions: VersionSet, of: impl Fn(Version) -> String) -> String {
    let mut groups: Vec<(String, VersionSet)> = Vec::new();
    for version in versions.iter() {
        let text = of(version);
        match groups.iter_mut().find(|(other, _)| *other == text) {
            Some((_, all)) => *all = all.and(version.only()),
            None => groups.push((text, version.only())),
        }
    }
    match &groups[..] {
        [(only, _)] => only.clone(),
        _ => {
            let told = groups.iter().map(|(text, all)| format!("{text} in {all}"));
            told.collect::<Vec<_>>().join("; ")
        }
    }
}

/// The element that an input register has when nothing is declared.
fn element(register: u32) -> Option<String> {
    let all = Usage::all().flat_map(|(usage, name)| (0..16).map(move |i| (usage, name, i)));
    let mut fed = all.filter(|(usage, _, index)| usage.default_register(*index) == Some(register));
    let (_, name, index) = fed.next()?;
    let index = if index == 0 {
        String::new()
    } else {
        index.to_string()
    };
    Some(format!(
        "{name}{index} in a vertex shader, where nothing is declared"
    ))
}

//! Pages of versions.

use super::encoding;
use super::page::{Fact, Page};
use crate::isa::modifier::ResultSuffix;
use crate::isa::{Class, Opcode, RegisterFile, ShaderKind, SourceModifier, Version};

/// What a version has: budget, registers, instructions, modifiers.
pub fn version(version: Version) -> Page {
    let row = version.row();
    let kind = match row.kind {
        ShaderKind::Vertex => "vertex shader",
        ShaderKind::Pixel => "pixel shader",
    };
    let mut page = Page::new(row.name, kind);
    page.paragraph(row.meaning);
    let within = match row.phases {
        1 => String::new(),
        phases => format!(" in each of {phases} phases"),
    };
    let slots = match row.kind {
        ShaderKind::Vertex => row.arithmetic_slots.to_string(),
        ShaderKind::Pixel => format!(
            "{} texture and {} arithmetic{within}",
            row.texture_slots, row.arithmetic_slots
        ),
    };
    page.facts(vec![
        Fact::new(
            "written",
            format!("{} or {}", row.name, row.name.replace('.', "_")),
        ),
        Fact::new("token", format!("0x{:08X}", version.token())),
        Fact::new("slots", slots),
    ]);
    page.listing(encoding::listing(version, row.example).trim_end());
    page.heading("Registers");
    let files = RegisterFile::all().filter(|file| file.count(version) > 0);
    page.facts(files.map(|file| of_file(file, version)).collect());
    page.heading("Instructions");
    let groups = [
        ("arithmetic", Class::Arithmetic),
        ("texture", Class::Texture),
        ("other", Class::Phase),
        ("before all", Class::Declaration),
    ];
    let facts = groups.into_iter().filter_map(|(label, class)| {
        let in_class =
            |opcode: &Opcode| opcode.form(version).is_some_and(|form| form.class == class);
        let names: Vec<&str> = Opcode::all()
            .filter(in_class)
            .map(Opcode::mnemonic)
            .collect();
        (!names.is_empty()).then(|| Fact::new(label, names.join(", ")))
    });
    page.facts(facts.collect());
    page.heading("Modifiers");
    let sources = SourceModifier::all().filter(|modifier| {
        *modifier != SourceModifier::None && modifier.row().versions().contains(version)
    });
    let sources: Vec<String> = sources
        .map(|modifier| super::modifier::written(modifier.row()))
        .collect();
    let mut facts = vec![Fact::new("of sources", sources.join(", "))];
    let results = ResultSuffix::all().filter(|row| row.versions.contains(version));
    let results: Vec<&str> = results.map(|row| row.suffix).collect();
    if !results.is_empty() {
        facts.push(Fact::new("of results", results.join(", ")));
    }
    page.facts(facts);
    let others = Version::all().filter(|other| other.kind() == row.kind && *other != version);
    page.see = others.map(|other| other.name().to_string()).collect();
    page
}

/// How many registers of a file a version has, and how many of them an instruction reads.
fn of_file(file: RegisterFile, version: Version) -> Fact {
    let count = file.count(version);
    let text = match file.read_ports(version) {
        0 => count.to_string(),
        ports => format!("{count}, of which one instruction reads {ports}"),
    };
    Fact::new(file.any_name(), text)
}

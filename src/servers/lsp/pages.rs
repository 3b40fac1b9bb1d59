//! What there is to say of words, in Markdown, out of the tables of the instruction set.

use std::fmt::Write;
use texcrd::isa::modifier::SHIFTS;
use texcrd::isa::register::Access;
use texcrd::isa::{Form, Opcode, RegisterFile, ShaderKind, SourceModifier, Version, VersionSet};

fn names(versions: VersionSet) -> String {
    let names: Vec<&str> = versions.iter().map(Version::name).collect();
    names.join(", ")
}

/// An instruction; with its form in a version, if there is one.
pub(super) fn instruction(opcode: Opcode, version: Option<Version>) -> String {
    let mut page = format!("**{}** — {}\n", opcode.mnemonic(), names(opcode.versions()));
    let here = version.and_then(|version| opcode.form(version));
    let forms: Vec<&Form> = match here {
        Some(form) => vec![form],
        None => opcode.row().forms.iter().collect(),
    };
    for form in forms {
        let _ = write!(
            page,
            "\n```\n{}\n{}\n```\n",
            usage(opcode, form),
            form.formula
        );
        let slots = form.arithmetic_slots + form.texture_slots;
        let plural = if slots == 1 { "" } else { "s" };
        let _ = writeln!(page, "{slots} slot{plural} ({})", names(form.versions));
    }
    if let (Some(version), None) = (version, here) {
        let _ = writeln!(page, "\n{version} does not have it.");
    }
    page
}

/// How an instruction is written: `mad d, s0, s1, s2`.
pub(super) fn usage(opcode: Opcode, form: &Form) -> String {
    let operands = operands(opcode, form).join(", ");
    format!("{} {operands}", opcode.mnemonic())
        .trim_end()
        .to_string()
}

/// The operands of an instruction by the names that its formula has for them.
pub(super) fn operands(opcode: Opcode, form: &Form) -> Vec<String> {
    if opcode == Opcode::Def {
        return ["c#", "x", "y", "z", "w"].map(str::to_string).to_vec();
    }
    if opcode == Opcode::Dcl {
        return vec!["v#".to_string()];
    }
    let destination = form.destination.map(|_| match form.formula {
        formula if formula.contains("t(m)") || formula.contains("TC[m]") => "t(m)",
        formula if formula.contains("r(m)") => "r(m)",
        _ => "d",
    });
    let sources = (0..form.sources.len()).map(|i| format!("s{i}"));
    destination
        .map(str::to_string)
        .into_iter()
        .chain(sources)
        .collect()
}

/// A register.
pub(super) fn register(file: RegisterFile, index: u32, version: Option<Version>) -> String {
    let mut page = format!(
        "**{}** — {} register\n",
        file.register_name(index),
        file.row().name
    );
    if let Some(version) = version {
        let count = file.count(version);
        let access = match file.access(version) {
            Access::Read => "read only",
            Access::Write => "write only",
            Access::ReadWrite => "read and written",
        };
        let _ = match count {
            0 => writeln!(page, "\n{version} has none."),
            _ => writeln!(page, "\n{version} has {count}, {access}."),
        };
        let ports = file.read_ports(version);
        if count > 0 && ports > 0 {
            let _ = writeln!(page, "\nAn instruction reads at most {ports} of them.");
        }
    }
    page
}

/// A source modifier by its suffix.
pub(super) fn source_modifier(suffix: &str) -> Option<String> {
    let modifier = SourceModifier::from_text("", suffix)?;
    let row = modifier.row();
    let versions = row.arithmetic.and(row.coordinates);
    Some(format!(
        "**{suffix}** — source modifier: {}\n\n{}\n",
        row.formula,
        names(versions)
    ))
}

/// The result modifiers of a mnemonic, by their suffixes.
pub(super) fn result_modifier(suffix: &str) -> Option<String> {
    if suffix == texcrd::isa::modifier::SATURATE_SUFFIX {
        let versions = names(VersionSet::PS);
        return Some(format!(
            "**{suffix}** — the result is clamped to 0…1\n\n{versions}\n"
        ));
    }
    let row = SHIFTS.iter().find(|row| row.suffix == suffix)?;
    let factor = match row.shift {
        shift if shift < 0 => format!("divided by {}", 1u32 << shift.unsigned_abs()),
        shift => format!("multiplied by {}", 1u32 << shift.unsigned_abs()),
    };
    Some(format!(
        "**{suffix}** — the result is {factor}\n\n{}\n",
        names(row.versions)
    ))
}

/// A version.
pub(super) fn version(version: Version) -> String {
    let row = version.row();
    let mut page = format!("**{version}**\n\n");
    let _ = match row.kind {
        ShaderKind::Vertex => writeln!(page, "{} slots", row.arithmetic_slots),
        ShaderKind::Pixel => {
            let phases = if row.phases > 1 {
                " in each of two phases"
            } else {
                ""
            };
            writeln!(
                page,
                "{} texture and {} arithmetic slots{phases}",
                row.texture_slots, row.arithmetic_slots
            )
        }
    };
    let files = RegisterFile::all().filter(|file| file.count(version) > 0);
    for file in files {
        let last = file.register_name(file.count(version) - 1);
        let first = file.register_name(0);
        let range = if first == last {
            first
        } else {
            format!("{first} … {last}")
        };
        let _ = writeln!(page, "* `{range}` — {}", file.row().name);
    }
    page
}

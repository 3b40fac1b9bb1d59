//! The listings of the tables.

use crate::diagnostic::SourceMap;
use crate::explain::encoding;
use crate::isa::modifier::ResultSuffix;
use crate::isa::{Notation, Opcode, RegisterFile, SourceModifier, Version, VersionSet};
use crate::listing;
use crate::policy::Dialect;
use crate::program::{Program, Register, Source, Statement};

/// The program of an example, after nothing was said of it.
#[track_caller]
fn accepted(version: Version, example: &str) -> Program {
    let mut sources = SourceMap::new();
    let text = encoding::listing(version, example);
    let checked = listing::check(sources.add("example", text).unwrap(), Dialect::D3d8);
    let said: Vec<_> = (checked.diagnostics.iter())
        .map(|d| (d.rule.id, &d.message))
        .collect();
    assert!(said.is_empty(), "{version}: {example}\n{said:?}");
    checked.program.unwrap()
}

fn sources(program: &Program) -> impl Iterator<Item = &Source> {
    program.instructions().flat_map(|i| &i.sources)
}

/// Whether a register of a file stands in the program, as `t#` of `tex` does.
fn names(program: &Program, fits: impl Fn(Register) -> bool) -> bool {
    let destinations = program.instructions().filter_map(|i| i.destination);
    let mut all = (destinations.map(|d| d.register)).chain(sources(program).map(|s| s.register));
    all.any(fits)
}

#[test]
fn instructions_stand_in_their_examples() {
    for opcode in Opcode::all() {
        for form in opcode.row().forms {
            for version in form.versions.iter() {
                let program = accepted(version, form.example);
                let is = |s: &Statement| crate::explain::instruction::is(s, opcode);
                assert!(program.statements.iter().any(is), "{opcode:?} in {version}");
            }
        }
    }
}

#[test]
fn registers_stand_in_their_examples() {
    for file in RegisterFile::all() {
        let mut told = VersionSet::NONE;
        for form in file.row().forms {
            assert_eq!(told.both(form.versions), VersionSet::NONE, "{file:?}");
            told = told.and(form.versions);
            for version in form.versions.iter() {
                let program = accepted(version, form.example);
                let there = match file {
                    RegisterFile::Addr => sources(&program).any(|s| s.register.relative),
                    _ => names(&program, |register| register.file == file),
                };
                assert!(there, "{file:?} in {version}");
            }
        }
        assert_eq!(told, file.versions(), "{file:?}");
    }
    for (i, row) in crate::isa::register::RAST_OUT.iter().enumerate() {
        let program = accepted(Version::Vs11, row.form.example);
        let register = Register::new(RegisterFile::RastOut, i as u32);
        assert!(names(&program, |other| other == register), "{}", row.name);
    }
}

#[test]
fn modifiers_stand_in_their_examples() {
    for modifier in SourceModifier::all() {
        let row = modifier.row();
        let version = row.versions().iter().last().unwrap();
        let program = accepted(version, row.example);
        let there = sources(&program).any(|source| source.modifier == modifier);
        assert!(there, "{modifier:?}");
    }
    for row in ResultSuffix::all() {
        let version = row.versions.iter().last().unwrap();
        let program = accepted(version, row.example);
        let has = |i: &crate::program::Instruction| i.result.text() == row.suffix;
        assert!(program.instructions().any(has), "{}", row.suffix);
    }
}

#[test]
fn notations_and_versions_have_examples() {
    for notation in Notation::all() {
        let row = notation.row();
        assert_eq!(row.notation, notation, "the rows stand in order");
        let mut told = VersionSet::NONE;
        for form in row.forms {
            assert_eq!(told.both(form.versions), VersionSet::NONE);
            told = told.and(form.versions);
            for version in form.versions.iter() {
                let program = accepted(version, form.example);
                let there = match notation {
                    Notation::WriteMask => program
                        .instructions()
                        .any(|i| i.destination.is_some_and(|d| d.mask.count() < 4)),
                    Notation::Swizzle => {
                        let plain = crate::isa::Swizzle::IDENTITY;
                        sources(&program).any(|s| s.swizzle != plain)
                    }
                    Notation::CoIssue => program.instructions().any(|i| i.co_issue),
                    Notation::Relative => sources(&program).any(|s| s.register.relative),
                };
                assert!(there, "{notation:?} in {version}");
            }
        }
    }
    for version in Version::all() {
        accepted(version, version.row().example);
    }
}

#[test]
fn rows_are_written_in_sentences() {
    let sentences = |text: &str, of: &str| {
        assert!(text.ends_with('.') && !text.contains("  "), "{of}: {text}");
        assert!(text.is_ascii() && !text.contains('`'), "{of}: {text}");
    };
    for opcode in Opcode::all() {
        let row = opcode.row();
        sentences(row.meaning, row.mnemonic);
        assert!(!row.title.is_empty() && !row.title.ends_with('.'));
        assert!(!row.see.contains(&opcode), "{opcode:?}");
        for form in row.forms.iter().filter(|form| !form.note.is_empty()) {
            sentences(form.note, row.mnemonic);
        }
    }
    for file in RegisterFile::all() {
        let forms = file.row().forms.iter();
        forms.for_each(|form| sentences(form.meaning, file.row().name));
    }
    SourceModifier::all().for_each(|m| sentences(m.row().meaning, m.row().suffix));
    ResultSuffix::all().for_each(|row| sentences(row.meaning, row.suffix));
    Version::all().for_each(|version| sentences(version.row().meaning, version.name()));
    for notation in Notation::all() {
        sentences(notation.row().meaning, notation.row().names[0]);
        let forms = notation.row().forms.iter();
        forms.for_each(|form| sentences(form.meaning, notation.row().names[0]));
    }
    crate::bytecode::Macro::all().for_each(|of| sentences(of.meaning(), of.name()));
}

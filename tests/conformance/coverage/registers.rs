//! Every register of every version, as what is read and as what is written.

use super::Checklist;
use super::probe::lines;
use texcrd::isa::opcode::Class;
use texcrd::isa::register::Access;
use texcrd::isa::{RegisterFile, Version};

fn registers(version: Version) -> impl Iterator<Item = (RegisterFile, u32)> {
    RegisterFile::all()
        .flat_map(move |file| (0..file.count(version)).map(move |index| (file, index)))
}

fn item(version: Version, file: RegisterFile, index: u32, what: &str) -> String {
    format!("{version} {} {what}", file.register_name(index))
}

#[test]
fn every_register_is_read() {
    let wanted = Version::all().flat_map(|version| {
        registers(version)
            .filter(move |(file, _)| file.access(version) != Access::Write)
            .map(move |(file, index)| item(version, file, index, "read"))
    });
    let mut list = Checklist::new("registers that are read", wanted);
    for line in lines() {
        for (i, source) in line.instruction.sources.iter().enumerate() {
            let register = source.register;
            if register.relative {
                continue;
            }
            list.tick(
                &item(line.version, register.file, register.index, "read"),
                || {
                    let count = register.file.count(line.version);
                    // A neighbour instead of it.
                    line.notices(|instruction| {
                        instruction.sources[i].register.index = (register.index + 1) % count;
                    })
                },
            );
        }
        // Before ps.1.4 the coordinates of a texture instruction are those of its destination.
        let form = line.opcode().form(line.version).expect("it has one");
        if let Some(destination) = line.instruction.destination
            && form.class == Class::Texture
        {
            let register = destination.register;
            list.tick(
                &item(line.version, register.file, register.index, "read"),
                || line.is_seen(),
            );
        }
    }
    list.finish();
}

#[test]
fn every_register_is_written() {
    let wanted = Version::all().flat_map(|version| {
        registers(version)
            .filter(move |(file, _)| file.access(version) != Access::Read)
            .map(move |(file, index)| item(version, file, index, "written"))
    });
    let mut list = Checklist::new("registers that are written", wanted);
    for line in lines() {
        let Some(destination) = line.instruction.destination else {
            continue;
        };
        let register = destination.register;
        list.tick(
            &item(line.version, register.file, register.index, "written"),
            || line.is_seen(),
        );
    }
    list.finish();
}

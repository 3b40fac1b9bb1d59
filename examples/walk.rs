//! Walks along a shader and lists what each instruction reads and writes: where to begin with a tool of one's own.
//!
//! `cargo run --no-default-features --example walk water.psh`

use std::error::Error;
use texcrd::isa::{Version, WriteMask};
use texcrd::program::{Instruction, letters};

/// The sources with the components that the instruction takes of them.
fn reads(instruction: &Instruction, version: Version) -> Vec<String> {
    // Some instructions look at other components than they write: dp3 at three, rcp at one. Their row says which.
    let form = instruction.opcode.form(version);
    let mask = instruction
        .destination
        .map_or(WriteMask::ALL, |destination| destination.mask);
    let all = instruction.sources.iter().enumerate();
    all.map(|(at, source)| {
        let slots = form.map_or(mask, |form| form.slots_read(at, mask));
        let components = source.swizzle.reads(slots);
        format!(
            "{}{}",
            source.register,
            components.text(letters(version.kind()))
        )
    })
    .collect()
}

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("which listing?")?;
    let program = texcrd::parse(std::fs::read(&path)?)?;
    println!("{}", program.version);
    for definition in program.definitions() {
        println!("{:<12} defines {}", "def", definition.register);
    }
    for instruction in program.instructions() {
        let reads = reads(instruction, program.version);
        let writes = instruction.destination.map(|destination| {
            let mask = destination.mask.text(program.letters());
            format!(" -> {}{mask}", destination.register)
        });
        println!(
            "{:<12} {}{}",
            instruction.opcode.mnemonic(),
            reads.join(", "),
            writes.unwrap_or_default()
        );
    }
    Ok(())
}

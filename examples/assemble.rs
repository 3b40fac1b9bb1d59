//! Makes a C array of the tokens of a listing, as programs of the time had them in their sources.
//!
//! `cargo run --no-default-features --example assemble water.psh`

use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("which listing?")?;
    let tokens = texcrd::assemble(std::fs::read(&path)?)?;
    println!("const DWORD dwShader[] =\n{{");
    for line in tokens.chunks(8) {
        let line: Vec<String> = line.iter().map(|token| format!("0x{token:08x}")).collect();
        println!("    {},", line.join(", "));
    }
    println!("}};");
    Ok(())
}
